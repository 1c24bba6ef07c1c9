"""Places of attachment, new names and removed links, shared by all transformations.

A *place* is a link, given by its name, that gets a new joint; or a joint, given by its number, which a further
link joins, so that it becomes a multiple joint.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import count

from gruebler.base.errors import TransformationError, naming
from gruebler.base.text import Message, joined_by_or, message
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import PAIRS, Alphabet, Pair
from gruebler.structure.chain.spaces import Space

Attachment = str | int

_PAIRS = {p.symbol(): p for p in PAIRS if Space.PLANAR in p.freedoms and p.f(Space.PLANAR) == 1}
_GERMAN = {p.symbol(Alphabet.GERMAN): letter for letter, p in _PAIRS.items()}


def check_counting(chain: Chain) -> None:
    """Raise for spatial chains: there a dyad or a coupler of joints with one freedom changes F by other numbers."""
    if chain.space.b != 3:
        raise TransformationError(
            "dyads, couplers and groups keep F by a count with three freedoms a link; this chain is {space}",
            space=chain.space.adjective,
        )


def pairs_from_letters(letters: str, number: int, subject: Message) -> tuple[Pair, ...]:
    """The pairs of letters such as RRP (German DDS), all with one freedom."""
    symbols = "".join(_GERMAN.get(letter, letter) for letter in letters.strip().upper())
    if len(symbols) != number or not set(symbols) <= set(_PAIRS):
        raise TransformationError(
            "{letters!r} is not the form of a {thing}: expected {number} letters, each {known} (German {german})",
            letters=letters,
            thing=subject,
            number=number,
            known=joined_by_or([*_PAIRS]),
            german=joined_by_or([*_GERMAN]),
        )
    return tuple(_PAIRS[letter] for letter in symbols)


def letters_of_pairs(pairs: Iterable[Pair]) -> str | None:
    """The letters of these pairs, or None if one of them has no letter here."""
    letters = [p.symbol() for p in pairs]
    return "".join(letters) if set(letters) <= set(_PAIRS) else None


def links_at(chain: Chain, place: Attachment) -> tuple[str, ...]:
    """The links to which a place belongs; `TransformationError` for a joint that the chain does not have."""
    if isinstance(place, str):
        chain.index(place)
        return (place,)
    return chain.joints[chain.joint_number(place, error=TransformationError)].links


def check_not_on_one_link(chain: Chain, places: Sequence[Attachment], subject: Message) -> None:
    """Raise for places that all lie on one link: anything attached there is rigid against it."""
    joints = [place for place in places if not isinstance(place, str)]
    if len(set(joints)) < len(joints):
        raise TransformationError(
            "two places of the {thing} are the same joint; attach them to links or other joints", thing=subject
        )
    shared = set.intersection(*(set(links_at(chain, place)) for place in places))
    if shared:
        link = next(link for link in chain.links if link in shared)
        raise TransformationError(
            "the places of the {thing} all lie on the link {link!r}: it would be rigid against it",
            thing=subject,
            link=link,
        )


def new_link_names(chain: Chain, number: int, requested: Sequence[str] | None) -> list[str]:
    """Names for new links: the requested ones, which must be new; by default the lowest free whole numbers."""
    if requested is None:
        free = (str(k) for k in count() if str(k) not in chain.links)
        return [next(free) for _ in range(number)]
    names = list(requested)
    if len(names) != number or len(set(names)) != number:
        raise TransformationError(
            "expected {number} different names for the new links, found {names}",
            number=number,
            names=", ".join(names) or message("none"),
        )
    duplicate = next((name for name in names if name in chain.links), None)
    if duplicate is not None:
        raise TransformationError(
            "the chain has a link {taken!r} already; name the new link otherwise", taken=duplicate
        )
    return names


class ChainBuilder:
    """A chain under construction: a list of joints that can still change."""

    def __init__(self, chain: Chain) -> None:
        self.chain = chain
        self.joints: list[tuple[Pair, list[str]]] = [(j.pair, list(j.links)) for j in chain.joints]
        self.new: list[str] = []

    def add(self, kind: Pair, links: Iterable[str]) -> None:
        """A new joint."""
        self.joints.append((kind, list(links)))

    def attach(self, place: Attachment, kind: Pair, links: Sequence[str], *, last: bool = False) -> None:
        """Join new links to a place: by a new joint with a link, written first or last, or as more links of a joint."""
        if isinstance(place, str):
            self.add(kind, [*links, place] if last else [place, *links])
            return
        joint = self.chain.joints[place]
        if joint.pair != kind or not kind.is_group:
            raise TransformationError(
                "a {pair} joint is to be attached, but no further link can join {joint} with it",
                pair=kind.title,
                joint=joint,
            )
        self.joints[place][1].extend(links)

    def done(self, new: Sequence[str]) -> Chain:
        """The chain, its new links last."""
        return Chain(self.joints, links=[*self.chain.links, *new], space=self.chain.space)


def without_links(chain: Chain, links: Sequence[str]) -> tuple[Chain, dict[int, int]]:
    """The chain without these links, and the new number of each remaining joint.

    Raises `TransformationError` if the remainder is not a chain.
    """
    removed = set(links)
    joints: list[Joint] = []
    number: dict[int, int] = {}
    for k, joint in enumerate(chain.joints):
        remaining = tuple(link for link in joint.links if link not in removed)
        if len(remaining) > 1:
            number[k] = len(joints)
            joints.append(Joint(joint.pair, remaining))
    with naming(message("without {links} there is no chain left", links=", ".join(links)), TransformationError):
        remainder = Chain(joints, links=[link for link in chain.links if link not in removed], space=chain.space)
    return remainder, number
