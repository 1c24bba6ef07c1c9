"""Idle freedoms: motions of a part alone that change nothing else, such as the spin of a rod between two balls.

There are two kinds. *Certain*: with all its neighbours fixed, the constraints at a link's joints leave it a
freedom at a random placement; or several connected links lie between two balls, such as the rod and the barrel of a
hydraulic cylinder, and turn as one body about the line through the two centres, whatever joins them. *If round*: a
binary link on one revolute and one roll-slide joint (a cam roller) spins idly when its contour is a circle about the
pin. The structure does not determine that: a planet wheel has the same structure. The condition is therefore reported
with the freedom, only where the chain has a mobility of two or more and only for links whose pin is not on the frame.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.structure.chain import Chain
from gruebler.structure.mobility.prime_field import P, modular_inverse
from gruebler.structure.mobility.rank import Generic


class IdleCondition(StrEnum):
    """The condition under which a freedom is idle."""

    ALWAYS = "always"
    ROUND = "round"


@dataclass(frozen=True, slots=True)
class IdleFreedom:
    """Freedoms of one link alone, or of several links that move as one body."""

    links: tuple[str, ...]
    freedoms: int
    when: IdleCondition


def idle_freedoms(rank: Generic, frame: str) -> tuple[IdleFreedom, ...]:
    """The idle freedoms, in the order of the links. Links on a single joint are not idle: they move freely.

    >>> from gruebler.structure.chain import Chain
    >>> from gruebler.structure.mobility.rank import generic
    >>> rod = Chain.parse("spatial: R(frame-arm1) S(arm1-rod) S(rod-arm2) R(arm2-frame)")
    >>> idle_freedoms(generic(rod), "frame")
    (IdleFreedom(links=('rod',), freedoms=1, when=<IdleCondition.ALWAYS: 'always'>),)
    >>> ram = Chain.parse("spatial: R(frame-arm) S(arm-rod) P(rod-barrel) S(barrel-frame)")
    >>> idle_freedoms(generic(ram), "frame")
    (IdleFreedom(links=('rod', 'barrel'), freedoms=1, when=<IdleCondition.ALWAYS: 'always'>),)
    """
    chain = rank.chain
    joints: dict[str, list[int]] = {link: [] for link in chain.links}
    for k, joint in enumerate(chain.joints):
        for link in joint.links:
            joints[link].append(k)
    freedoms = []
    for link, numbers in joints.items():
        if len(numbers) < 2 or link == frame:
            continue
        remaining = chain.space.b - _rank((f for k in numbers for f in rank.placement.functionals[k]), chain.space.b)
        if remaining:
            freedoms.append(IdleFreedom((link,), remaining, IdleCondition.ALWAYS))
        elif rank.mobility >= 2 and _may_be_roller(rank, numbers, frame):
            freedoms.append(IdleFreedom((link,), 1, IdleCondition.ROUND))
    freedoms += [IdleFreedom(part, 1, IdleCondition.ALWAYS) for part, _ in between_balls(chain, frame)]
    return tuple(sorted(freedoms, key=lambda idle: chain.index(idle.links[0])))


def between_balls(chain: Chain, frame: str) -> list[tuple[tuple[str, ...], tuple[int, int]]]:
    """The parts of several links, joined by other pairs than balls, that two balls join to two links outside.

    Each part with the numbers of its two balls. Cost O(joint elements).
    """
    balls = [k for k, joint in enumerate(chain.joints) if joint.pair.is_ball]
    sets = DisjointSets(chain.links)
    for joint in chain.joints:
        if not joint.pair.is_ball:
            for other in joint.links[1:]:
                sets.unite(joint.links[0], other)
    members = {sets.find(links[0]): links for links in sets.classes()}
    at: dict[str, list[int]] = {}
    for k in balls:
        for link in chain.joints[k].links:
            at.setdefault(sets.find(link), []).append(k)
    parts = []
    for root, links in members.items():
        part_balls = at.get(root, [])
        if len(links) < 2 or frame in links or len(part_balls) != 2 or part_balls[0] == part_balls[1]:
            continue
        outside = {link for k in part_balls for link in chain.joints[k].links} - set(links)
        if len(outside) > 1:  # both balls on the same link are a hinge, and its rotation is not idle
            parts.append((tuple(links), (part_balls[0], part_balls[1])))
    return parts


def _rank(rows: Iterable[tuple[int, ...]], most: int) -> int:
    """The rank of short rows; the iteration ends when it reaches ``most``."""
    basis: list[tuple[int, list[int]]] = []
    for row in rows:
        remainder = list(row)
        for pivot, known in basis:
            if factor := remainder[pivot]:
                remainder = [(a - factor * b) % P for a, b in zip(remainder, known, strict=True)]
        if any(remainder):
            pivot = next(k for k, value in enumerate(remainder) if value)
            scale = modular_inverse(remainder[pivot])
            basis.append((pivot, [value * scale % P for value in remainder]))
            if len(basis) == most:
                break
    return len(basis)


def _may_be_roller(rank: Generic, joints: list[int], frame: str) -> bool:
    own = [rank.chain.joints[k] for k in joints]
    pins = [joint for joint in own if joint.pair.is_turning]
    touching = [joint for joint in own if joint.pair.rolls_and_slides]
    return len(own) == 2 and len(pins) == len(touching) == 1 and frame not in pins[0].links
