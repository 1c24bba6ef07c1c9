"""The split of independent constraints into groups: tight sets, their lattice, rigid parts within a group.

All on numbers: bodies, and joints that bind them. Definitions and proofs: docs/theory/assur.md.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from typing import NamedTuple

from gruebler.structure.assur.forms import GroupJoint, class_number
from gruebler.structure.assur.matching import components, dependencies, orientation
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mobility import pebble_rank


@dataclass(frozen=True, slots=True)
class BodyJoint:
    """A joint between bodies: the number of the chain's joint, the pair with its drives locked, the bodies."""

    joint: int
    pair: Pair
    bodies: tuple[int, ...]

    @property
    def constraints(self) -> int:
        """The number of freedoms that each further body loses by it."""
        return self.pair.u(Space.PLANAR)


@dataclass(frozen=True)
class BodyGroup:
    """A group among numbered bodies."""

    elements: tuple[tuple[int, ...], ...]
    """Its rigid parts: a body alone, or a body with those that earlier parts have fixed against it."""
    base: int
    """The body relative to which it is solved: the frame's, or the first body of a rigid part of a later group."""
    members: tuple[tuple[int, GroupJoint], ...]
    """Its joints: number of the chain's joint, and the elements that carry it."""
    after: tuple[int, ...]
    """The parts (by place) on which it depends directly."""


class GroupSplit(NamedTuple):
    """Parts in solving order, and the undetermined bodies."""

    parts: list[BodyGroup]
    loose: list[int]


def split_into_groups(
    joints: Sequence[BodyJoint], bodies: Collection[int], base: int, first: Mapping[int, int], driven: Collection[int]
) -> GroupSplit:
    """Split these bodies, relative to one of them.

    Args:
        joints: generically independent joints; only their bodies among `bodies` count.
        bodies: the bodies.
        base: the body that is known.
        first: a rank for each body; of parts that may be solved in any order the one with the least comes first.
        driven: bodies of links that a drive locks together: preferred as bases of rigid parts.
    """
    inner = _restricted(joints, bodies)
    blocks, loose = _blocks(inner, bodies, base)
    owner = {body: k for k, block in enumerate(blocks) for body in block}
    before: list[set[int]] = [set() for _ in blocks]
    for joint in inner:
        meeting = {owner[body] for body in joint.bodies if body in owner}
        for k in meeting:
            before[k] |= {other for other in meeting if other < k}
    known = {base}
    place: dict[int, int] = {}
    parts: list[BodyGroup] = []
    ready = [(min(first[b] for b in blocks[k]), k) for k in range(len(blocks)) if not before[k]]
    heapify(ready)
    while ready:
        k = heappop(ready)[1]
        elements, below = _elements(inner, blocks[k], first, driven)
        after = {place[other] for other in before[k]} | {len(parts) + end for end in _ends(below)}
        parts += [_moved(part, len(parts)) for part in below]
        place[k] = len(parts)
        parts.append(BodyGroup(elements, base, _members(inner, elements, known), tuple(sorted(after))))
        known.update(blocks[k])
        for other in range(k + 1, len(blocks)):
            if k in before[other] and before[other] <= place.keys():
                heappush(ready, (min(first[b] for b in blocks[other]), other))
    return GroupSplit(parts, loose)


def _restricted(joints: Sequence[BodyJoint], bodies: Collection[int]) -> list[BodyJoint]:
    """The joints among these bodies."""
    inside = bodies if isinstance(bodies, set | frozenset) else set(bodies)
    restricted = []
    for joint in joints:
        members = tuple(body for body in joint.bodies if body in inside)
        if len(members) == len(joint.bodies):
            restricted.append(joint)
        elif len(members) > 1:
            restricted.append(BodyJoint(joint.joint, joint.pair, members))
    return restricted


def _blocks(joints: Sequence[BodyJoint], bodies: Collection[int], base: int) -> tuple[list[list[int]], list[int]]:
    """The differences of neighbouring tight sets that contain the base, in solving order; and the undetermined bodies.

    The vertices of the orientation are the bodies and the joints of more than two bodies.
    """
    number = {body: k for k, body in enumerate(bodies)}
    capacities = [3 * (body != base) for body in bodies]
    edges: list[tuple[int, int]] = []
    for joint in joints:
        ends = [number[body] for body in joint.bodies]
        if len(ends) == 2:
            edges += [(ends[0], ends[1])] * joint.constraints
        else:
            edges += [(len(capacities), end) for end in ends for _ in range(joint.constraints)]
            capacities.append(joint.constraints)
    taker = orientation(capacities, edges)
    if taker is None:
        raise AssertionError("independent constraints can always be distributed among the bodies")
    needs = dependencies(len(capacities), edges, taker)
    names = list(bodies)
    blocks: list[list[int]] = []
    loose: set[int] = set()
    for component in components(needs):
        if any(len(needs[v]) < capacities[v] or not loose.isdisjoint(needs[v]) for v in component):
            loose.update(component)
            continue
        block = [names[v] for v in component if v < len(names) and names[v] != base]
        if block:
            blocks.append(block)
    return blocks, [names[v] for v in sorted(loose) if v < len(names)]


def _elements(
    joints: Sequence[BodyJoint], block: list[int], first: Mapping[int, int], driven: Collection[int]
) -> tuple[tuple[tuple[int, ...], ...], list[BodyGroup]]:
    """The maximal rigid parts of a block, and the split of each relative to one of its bodies."""
    inner = _restricted(joints, block)
    if len(block) < 2 or _nowhere_tight(inner, block):
        return tuple((body,) for body in block), []
    elements: list[tuple[int, ...]] = []
    below: list[BodyGroup] = []
    done: set[int] = set()
    for body in block:
        if body in done:
            continue
        loose = set(_blocks(inner, block, body)[1])
        rigid = [b for b in block if b not in loose]
        done.update(rigid)
        if len(rigid) == 1:
            elements.append((body,))
            continue
        candidates = [b for b in rigid if b in driven] or rigid
        splits = {b: split_into_groups(inner, rigid, b, first, driven).parts for b in candidates}
        chosen = min(candidates, key=lambda b: (_effort(splits[b]), first[b]))
        elements.append((chosen, *(b for b in rigid if b != chosen)))
        below += [_moved(part, len(below)) for part in splits[chosen]]
    return tuple(elements), below


def _nowhere_tight(joints: Sequence[BodyJoint], block: list[int]) -> bool:
    """Whether surely no two or more of these bodies are rigid: then v of them have 3v - 4 constraints at most.

    Joints of more than two bodies are left to the search.
    """
    if any(len(joint.bodies) > 2 for joint in joints):
        return False
    if len(block) == 2:
        return sum(joint.constraints for joint in joints) < 3
    number = {body: k for k, body in enumerate(block)}
    edges = [(number[j.bodies[0]], number[j.bodies[1]]) for j in joints for _ in range(j.constraints)]
    return pebble_rank(len(block), edges, 3, 4) == len(edges)


def _effort(parts: Sequence[BodyGroup]) -> list[tuple[int, int]]:
    """Classes and sizes, the highest first: the criterion for the best base of a rigid part."""
    efforts = (
        (class_number(len(part.elements), [member for _, member in part.members]), len(part.elements)) for part in parts
    )
    return sorted(efforts, reverse=True)


def _members(
    joints: Sequence[BodyJoint], elements: Sequence[tuple[int, ...]], known: Collection[int]
) -> tuple[tuple[int, GroupJoint], ...]:
    element = {body: k for k, bodies in enumerate(elements) for body in bodies}
    members = []
    for joint in joints:
        carriers = tuple(dict.fromkeys(element[body] for body in joint.bodies if body in element))
        outer = bool(carriers) and any(body in known for body in joint.bodies)
        if outer or len(carriers) > 1:
            members.append((joint.joint, GroupJoint(joint.pair, carriers, outer)))
    return tuple(members)


def _ends(parts: Sequence[BodyGroup]) -> set[int]:
    """The parts on which no other part depends."""
    return set(range(len(parts))) - {other for part in parts for other in part.after}


def _moved(part: BodyGroup, by: int) -> BodyGroup:
    """The same part with its places shifted."""
    return BodyGroup(part.elements, part.base, part.members, tuple(k + by for k in part.after)) if by else part
