"""All chains that one dyad or one coupler more gives, each structure once, and families grown by dyads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import permutations

from gruebler.chain import Chain
from gruebler.errors import TransformationError, expect
from gruebler.isomorphism import code
from gruebler.transformations.dyads import insert_coupler, insert_dyad
from gruebler.transformations.places import Attachment, links_at
from gruebler.transformations.steps import Step

__all__ = ["Extension", "extend", "grow_family"]


@dataclass(frozen=True)
class Extension:
    """One structure that an extension gives, and all pairs of places that give it."""

    code: str
    step: Step
    """The first of the ways to it."""
    places: tuple[tuple[Attachment, Attachment], ...]

    @property
    def chain(self) -> Chain:
        """The new chain."""
        return self.step.chain


def extend(
    chain: Chain, *, dyad: str | None = None, coupler: str | None = None, at_joints: bool = False
) -> list[Extension]:
    """All different chains that one more dyad of this form, or one more coupler with these joints, gives.

    Args:
        chain: a planar or spherical chain.
        dyad: the form, RRR, RRP, RPR, PRP or RPP; or
        coupler: the joints, such as RR.
        at_joints: whether new links may also join the joints that are there, which become multiple joints.

    Different up to isomorphism, by canonical code, in the order of their first places. Cost: one code for each pair of
    places.

    >>> four_bar = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
    >>> [len(found.places) for found in extend(four_bar, dyad="RRR")]  # Watt between neighbours, Stephenson
    [4, 2]
    """
    expect(chain, Chain)
    if (dyad is None) == (coupler is None):
        raise TransformationError("say what extends the chain: a dyad of some form, or a coupler")
    word = (dyad or coupler or "").upper()
    places: list[Attachment] = [*chain.links]
    if at_joints:
        places += [k for k, joint in enumerate(chain.joints) if joint.pair.is_group]
    found: dict[str, tuple[Step, list[tuple[Attachment, Attachment]]]] = {}
    number = {place: k for k, place in enumerate(places)}
    for one, other in permutations(places, 2):
        if (word == word[::-1] and number[one] > number[other]) or _share_a_link(chain, one, other):
            continue
        try:
            step = insert_coupler(chain, [one, other], word) if dyad is None else insert_dyad(chain, word, [one, other])
        except TransformationError:
            if isinstance(one, str) and isinstance(other, str):
                raise  # the form, not the place, is wrong: a joint may only not take this pair
            continue
        found.setdefault(code(step.chain), (step, []))[1].append((one, other))
    return [Extension(key, step, tuple(where)) for key, (step, where) in found.items()]


def _share_a_link(chain: Chain, one: Attachment, other: Attachment) -> bool:
    return not set(links_at(chain, one)).isdisjoint(links_at(chain, other))


def grow_family(start: Chain, links: int, forms: Iterable[str] = ("RRR",)) -> Iterator[Chain]:
    """All chains with so many links that grow from a chain by dyads of these forms, each structure once.

    >>> four_bar = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
    >>> [len(list(grow_family(four_bar, n))) for n in (4, 6, 7, 8)]
    [1, 2, 0, 12]
    """
    wanted = list(forms)
    level = {code(start): start}
    while level and min(chain.n for chain in level.values()) < links:
        following: dict[str, Chain] = {}
        for chain in level.values():
            for form in wanted:
                for extension in extend(chain, dyad=form):
                    following.setdefault(extension.code, extension.chain)
        level = following
    yield from (chain for chain in level.values() if chain.n == links)
