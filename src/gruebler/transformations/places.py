"""Where something is attached, taken away or named: what all transformations share.

A *place* is a link, given by its name, on which a new joint is put; or a joint, given by its number, which a further
link joins, so that it becomes a multiple joint.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import count

from gruebler.chain import Chain, Joint
from gruebler.chain.pairs import Pair, pair
from gruebler.errors import ChainError, TransformationError
from gruebler.text import Message, message

__all__ = [
    "Attachment",
    "ChainBuilder",
    "check_counting",
    "check_not_on_one_link",
    "letters_of_pairs",
    "links_at",
    "new_link_names",
    "pairs_from_letters",
    "without_links",
]

Attachment = str | int

_PAIRS = {"R": "revolute", "P": "prismatic", "W": "rolling"}
_GERMAN = {"D": "R", "S": "P"}


def check_counting(chain: Chain) -> None:
    """Refuse spatial chains: there a dyad or a coupler of joints with one freedom changes F by other numbers."""
    if chain.space.b != 3:
        raise TransformationError(
            "dyads, couplers and groups keep F by a count with three freedoms a link; this chain is {space}",
            space=chain.space.adjective,
        )


def pairs_from_letters(letters: str, number: int, thing: Message) -> tuple[Pair, ...]:
    """The pairs of a word such as RRP (German DDS), all with one freedom."""
    word = "".join(_GERMAN.get(letter, letter) for letter in letters.strip().upper())
    if len(word) != number or not set(word) <= set(_PAIRS):
        raise TransformationError(
            "{letters!r} is not the form of a {thing}: expected {number} letters, each R, P or W (German D, S or W)",
            letters=letters,
            thing=thing,
            number=number,
        )
    return tuple(pair(_PAIRS[letter]) for letter in word)


def letters_of_pairs(pairs: Iterable[Pair]) -> str | None:
    """The word of these pairs, or None if one of them has no letter here."""
    known = {name: letter for letter, name in _PAIRS.items()}
    letters = [known.get(p.name) for p in pairs]
    return "".join(letter for letter in letters if letter) if all(letters) else None


def links_at(chain: Chain, place: Attachment) -> tuple[str, ...]:
    """The links to which a place belongs; `TransformationError` for a joint that the chain does not have."""
    if isinstance(place, str):
        chain.index(place)
        return (place,)
    if not 0 <= place < len(chain.joints):
        raise TransformationError(
            "there is no joint number {place}; the chain has joints 0 to {count}",
            place=place,
            count=len(chain.joints) - 1,
        )
    return chain.joints[place].links


def check_not_on_one_link(chain: Chain, places: Sequence[Attachment], thing: Message) -> None:
    """Refuse places that all lie on one link: what is attached there cannot move against it."""
    joints = [place for place in places if not isinstance(place, str)]
    if len(set(joints)) < len(joints):
        raise TransformationError(
            "two places of the {thing} are the same joint; attach them to links or other joints", thing=thing
        )
    shared = set.intersection(*(set(links_at(chain, place)) for place in places))
    if shared:
        link = next(link for link in chain.links if link in shared)
        raise TransformationError(
            "the places of the {thing} all lie on the link {link!r}: it would be rigid against it",
            thing=thing,
            link=link,
        )


def new_link_names(chain: Chain, number: int, wished: Sequence[str] | None) -> list[str]:
    """Names for new links: those wished for if they are new, else the lowest whole numbers that no link has."""
    if wished is None:
        free = (str(k) for k in count() if str(k) not in chain.links)
        return [next(free) for _ in range(number)]
    names = list(wished)
    if len(names) != number or len(set(names)) != number:
        raise TransformationError(
            "expected {number} different names for the new links, found {names}",
            number=number,
            names=", ".join(names) or message("none"),
        )
    taken = next((name for name in names if name in chain.links), None)
    if taken is not None:
        raise TransformationError("the chain has a link {taken!r} already; name the new link otherwise", taken=taken)
    return names


class ChainBuilder:
    """A chain on its way to the next one: joints that can still change."""

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
    """The chain without these links, and the new number of each joint that is left.

    Raises `TransformationError` if what is left is not a chain.
    """
    gone = set(links)
    joints: list[Joint] = []
    number: dict[int, int] = {}
    for k, joint in enumerate(chain.joints):
        left = tuple(link for link in joint.links if link not in gone)
        if len(left) > 1:
            number[k] = len(joints)
            joints.append(Joint(joint.pair, left))
    try:
        rest = Chain(joints, links=[link for link in chain.links if link not in gone], space=chain.space)
    except ChainError as error:
        raise TransformationError(
            "without {links} there is no chain left: {error}", links=", ".join(links), error=error
        ) from None
    return rest, number
