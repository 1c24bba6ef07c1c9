"""Joint types: the typed chains of a chain of revolutes, each assignment of pairs once up to the chain's symmetry.

An assignment counts only if, at almost all dimensions, the chain has the required mobility and every joint moves. No
rule of thumb replaces that test: forbidding two sliders on a binary link, for instance, is neither necessary (the
double slider moves) nor sufficient.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from gruebler.base.errors import ChainError
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import Pair, pair
from gruebler.structure.isomorphism import orbits, symmetry
from gruebler.structure.mobility import generic


def joint_types(
    chain: Chain, pairs: Mapping[str, int], *, mobility: int | None = None, conditions: bool = True
) -> Iterator[Chain]:
    """The chain with given numbers of its simple revolutes replaced by other pairs of one freedom.

    Args:
        chain: a chain of the plane or the sphere; only its simple revolute joints are replaced.
        pairs: the number of joints for each new pair, such as ``{"prismatic": 2}``; the others are kept.
        mobility: the required generic mobility; by default the chain's own.
        conditions: False gives every assignment up to symmetry, also those that cannot move.

    Raises `ChainError` for pairs with more than one freedom (see `contacts`) or more joints than there are.
    Cost: one generic rank for each orbit of assignments.

    >>> four_bar = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
    >>> [len(list(joint_types(four_bar, {"prismatic": k}))) for k in range(4)]
    [1, 1, 2, 0]
    """
    kinds = {pair(name): number for name, number in pairs.items() if number}
    for kind in kinds:
        if kind.f(chain.space) != 1:
            raise ChainError(
                "a {pair} joint has f = {f}; joint types exchange pairs with f = 1",
                pair=kind.title,
                f=kind.f(chain.space),
            )
    target = generic(chain).mobility if mobility is None else mobility
    for typed in assignments(chain, kinds):
        if not conditions or every_joint_moves(typed, target):
            yield typed


def assignments(chain: Chain, kinds: Mapping[Pair, int]) -> Iterator[Chain]:
    """Every assignment of the pairs to simple revolute joints, one for each orbit under the chain's symmetry."""
    places = [k for k, joint in enumerate(chain.joints) if joint.pair.is_turning and joint.count == 1]
    for kind, number in kinds.items():
        if number < 0:
            raise ChainError("the number of {name} joints is 0 or more, not {number}", name=kind.name, number=number)
    if sum(kinds.values()) > len(places):
        raise ChainError(
            "{wanted} joints cannot be exchanged: the chain has {count} simple revolutes",
            wanted=sum(kinds.values()),
            count=len(places),
        )
    plain = tuple(joint.pair for joint in chain.joints)
    choices = [tuple(choice) for choice in _choices(list(plain), places, list(kinds.items()))]
    images = []
    if len(choices) > 1:
        for g in symmetry(chain).generators:
            images.append({choice: _moved(choice, g.joints) for choice in choices})
    for orbit in orbits(choices, images):
        joints = [Joint(kind, joint.links) for kind, joint in zip(orbit[0], chain.joints, strict=True)]
        yield Chain(joints, links=chain.links, space=chain.space)


def _choices(current: list[Pair], places: Sequence[int], remaining: list[tuple[Pair, int]]) -> Iterator[list[Pair]]:
    """All assignments of the remaining pairs to the remaining places, in lexicographic order."""
    total = sum(number for _, number in remaining)
    if total == 0:
        yield current
        return
    if total > len(places):
        return
    first, later_places = places[0], places[1:]
    for k, (kind, number) in enumerate(remaining):
        if number:
            fewer = [*remaining[:k], (kind, number - 1), *remaining[k + 1 :]]
            yield from _choices([*current[:first], kind, *current[first + 1 :]], later_places, fewer)
    yield from _choices(current, later_places, remaining)


def _moved(choice: tuple[Pair, ...], joints: Sequence[int]) -> tuple[Pair, ...]:
    image_choice = list(choice)
    for k, image in enumerate(joints):
        image_choice[image] = choice[k]
    return tuple(image_choice)


def every_joint_moves(chain: Chain, mobility: int) -> bool:
    """Whether the generic mobility is the given one and no joint is immobile.

    >>> every_joint_moves(Chain.parse("R(0-1) P(1-2) P(2-3) P(3-0)"), 1)
    False
    """
    rank = generic(chain)
    if rank.mobility != mobility:
        return False
    cluster = {link: k for k, links in enumerate(rank.clusters) for link in links}
    return all(len({cluster[link] for link in j.links}) > 1 for j in chain.joints)
