"""Overconstrained linkages: an independent part of their closing conditions, chosen in the reference pose.

The conditions that the others imply there are released, so that what is left can be solved group by group; `move` looks
at each row whether the released joints are closed. docs/theory/kinematics.md has definition and theorem.
"""

from __future__ import annotations

import itertools
from cmath import phase, rect
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import joined, message
from gruebler.mechanics.linkages import Element, Line, Linkage, Pin, with_lower_pairs
from gruebler.mechanics.linkages.model import NEAR_REFERENCE
from gruebler.mechanics.linkages.wheels import round_joints
from gruebler.structure.assur import decompose
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import Pair, pair
from gruebler.structure.chain.spaces import Freedom, Space
from gruebler.structure.mechanism import Drive, Mechanism

_RANK = 1e-8  # of the largest singular value: the same threshold as that of `screws.freedoms`
_CLOSED = 1e-9  # sizes and radians: joints that are open by more in the reference pose are not closed there
_ROUNDING = 1e-14  # sizes and radians: a step of Newton's method that is shorter changes nothing
_STRESSED = 1e-7  # of a unit vector of forces: a null space decided at 1e-8 is known to some 1e-16/1e-8
_WELL = 0.1  # of the largest share in the redundancy: conditions with less are not released
_TRIALS = 200  # exchanges that are looked at: 1 ms each
_EQUAL = 1 - 1e-6  # shares that differ by less are equal: then the first one counts, on every machine


class Independent(NamedTuple):
    """A linkage without its redundant conditions, and where these are."""

    linkage: Linkage
    released: tuple[int, ...]
    """The joints, by number in the linkage as it was given, that the independent part does not close by itself."""


class _ConditionRow(NamedTuple):
    """Where a closing condition belongs."""

    joint: int
    links: tuple[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Release:
    """What may be released, at one joint."""

    rank: int
    """The kind; lower ones are preferred, since they make no singular positions of their own."""
    joint: int
    link: str
    functional: Reals
    """(k, rows): the forces that the released conditions transmit, from those of all conditions."""
    pair: Pair | None
    """What the joint becomes; None if nothing is left."""
    along: float = 0.0
    """For a pin in a slot the direction of the slot on the link."""
    turned: bool = False
    """Whether only the direction of the largest force is released, which is still to be added to ``along``."""

    def directed(self, forces: Reals) -> _Release:
        """The same with its direction chosen."""
        if not self.turned:
            return self
        x, y = np.linalg.svd(self.functional @ forces)[0][:, 0]
        u = complex(x, y) if (x if abs(x) >= abs(y) else y) > 0 else -complex(x, y)
        functional = np.array([[u.real, u.imag]]) @ self.functional
        return replace(self, functional=functional, along=self.along + phase(u), turned=False)


def independent_part(linkage: Linkage) -> Independent:
    """The linkage with as many conditions released as are redundant in its reference pose.

    `LinkageError` says if it has no reference pose, if its joints are not closed there, or if they leave less than its
    drives need. Cost: singular values of a matrix of (conditions) x (3 links), 10 ms for ten links.
    """
    mechanism = linkage.mechanism
    if round_joints(mechanism, linkage.elements):
        raise LinkageError("redundant conditions are sought among pins and slides only, not where wheels touch")
    if linkage.reference_pose is None:
        raise LinkageError(
            "Conditions of its joints are redundant or block its drives. With a position in which its joints close "
            "([reference_pose] or [places]) it is moved along the conditions that are independent there. `gruebler "
            "check --explain` shows what its sizes allow."
        )
    conditions = ReferenceConditions(linkage)
    x = conditions.settled()
    _, matrix = conditions.linearised(x)
    drives = conditions.drives(x)
    forces, locked = _stresses(matrix), _stresses(np.vstack([matrix, drives]))
    freedoms = matrix.shape[1] - len(matrix) + forces.shape[1]
    if freedoms < len(drives):
        names = joined(mechanism.chain.joint_title(k) for k in sorted(_stressed(conditions, locked)))
        raise LinkageError(
            "In the given position its joints leave mobility {freedoms}, less than the number of drives "
            "({count}); the drives are blocked by {joints}. `gruebler check --explain` analyses its mobility with "
            "these dimensions.",
            freedoms=freedoms,
            count=len(drives),
            joints=names or message("one another"),
        )
    if len(matrix) + len(drives) - locked.shape[1] < matrix.shape[1]:
        raise LinkageError(
            "Its reference pose is a change point, or its drives do not fix everything there: choose "
            "another one. `gruebler check --explain` lists the possible velocities."
        )
    chosen = _simplest(linkage, list(_releases(conditions, x)), forces)
    return Independent(_released(linkage, chosen), tuple(sorted({_release.joint for _release in chosen})))


class ReferenceConditions:
    """The closing conditions of pins, slides, pins in slots and double slides, one joint after the other.

    The unknowns are x, y (in sizes) and angle of each link but the frame. `ClosureSystem` has those of lower pairs:
    the four of a pin, a slide and a block in place of the one of a pin in a slot, whose force is what is released.
    """

    def __init__(self, linkage: Linkage) -> None:
        self.linkage = linkage
        chain = linkage.mechanism.chain
        self.chain = chain
        self.bodies = tuple(link for link in chain.links if link != linkage.mechanism.frame)
        self.rows: list[_ConditionRow] = []
        for number, joint in enumerate(chain.joints):
            for other in joint.links[1:]:
                self.rows += [_ConditionRow(number, (joint.links[0], other))] * (joint.pair.u(Space.PLANAR))

    def of(self, joint: int) -> list[int]:
        """The numbers of a joint's conditions."""
        return [k for k, row in enumerate(self.rows) if row.joint == joint]

    def place(self, x: Reals, link: str) -> tuple[complex, float]:
        """Where a link lies."""
        if link == self.linkage.mechanism.frame:
            return 0j, 0.0
        k = 3 * self.bodies.index(link)
        return complex(x[k], x[k + 1]), float(x[k + 2])

    def linearised(self, x: Reals) -> tuple[Reals, Reals]:
        """Residual (rows,) and Jacobian (rows, unknowns)."""
        residual: list[float] = []
        rows: list[Reals] = []
        for number, joint in enumerate(self.chain.joints):
            for other in joint.links[1:]:
                for value, row in self._conditions(x, number, joint, (joint.links[0], other)):
                    residual.append(value)
                    rows.append(row)
        return np.array(residual), np.array(rows).reshape(-1, len(x))

    def drives(self, x: Reals) -> Reals:
        """The derivatives of the drive values, (drives, unknowns)."""
        gradients = []
        for k, drive in enumerate(self.linkage.mechanism.drives):
            first, other = self.linkage.reference(k)
            if drive.turning:
                gradients.append(self._turn(first, other))
                continue
            lined = first if self.linkage.elements[drive.joint, first].is_line else other
            across = drive.direction == Freedom.TRAVEL_Y
            if across:
                lined = self.chain.joints[drive.joint].links[1]
            along = self._line(x, drive.joint, lined) * (1j if across else 1)
            gradients.append(self._way(x, drive.joint, (first, other), along, first)[1])
        return np.array(gradients).reshape(-1, len(x))

    def settled(self) -> Reals:
        """The reference pose, closed."""
        reference = self.linkage.required_pose
        size = self.linkage.size
        start = np.array(
            [(reference[link].x / size, reference[link].y / size, reference[link].angle) for link in self.bodies]
        ).ravel()
        x = start
        for _ in range(10):
            residual, matrix = self.linearised(x)
            step = np.linalg.lstsq(matrix, -residual, rcond=_RANK)[0]
            x = x + step
            if np.abs(step).max(initial=0.0) < _ROUNDING:
                break
        residual = self.linearised(x)[0]
        far = np.abs(residual)
        if not far.max(initial=0.0) < _CLOSED or not np.abs(x - start).max() < NEAR_REFERENCE:
            worst = self.chain.joint_title(self.rows[int(np.argmax(far))].joint)
            raise LinkageError(
                "reference pose: the joints are not closed there; {worst} is open by {gap:.1e} of the linkage's size",
                worst=worst,
                gap=far.max(),
            )
        return x

    def _conditions(self, x: Reals, number: int, joint: Joint, links: tuple[str, str]) -> Iterator[tuple[float, Reals]]:
        first, other = links
        if joint.pair.is_turning:
            yield self._way(x, number, links, 1 + 0j, "")
            yield self._way(x, number, links, 1j, "")
            return
        lined = first if self.linkage.elements[number, first].is_line else other
        along = self._line(x, number, lined)
        if not joint.pair.slides_two_ways:
            yield self._way(x, number, links, 1j * along, lined)
        if not joint.pair.rolls_and_slides:
            turned = self._line(x, number, other) * self._line(x, number, first).conjugate()
            yield phase(turned), self._turn(first, other)

    def _line(self, x: Reals, number: int, link: str) -> complex:
        return rect(1, self.place(x, link)[1] + self.linkage.elements[number, link].direction)

    def _turn(self, first: str, other: str) -> Reals:
        gradient = np.zeros(3 * len(self.bodies))
        for link, sign in ((first, -1.0), (other, 1.0)):
            if link in self.bodies:
                gradient[3 * self.bodies.index(link) + 2] = sign
        return gradient

    def _way(self, x: Reals, number: int, links: tuple[str, str], along: complex, carried: str) -> tuple[float, Reals]:
        """The way from the first to the second link's point along a direction that a link carries, or none does."""
        size, gradient = self.linkage.size, np.zeros(3 * len(self.bodies))
        gap = 0j
        for link, sign in zip(links, (-1.0, 1.0), strict=True):
            element = self.linkage.elements[number, link]
            origin, angle = self.place(x, link)
            arm = rect(1, angle) * complex(element.x, element.y) / size
            gap += sign * (origin + arm)
            if link in self.bodies:
                k = 3 * self.bodies.index(link)
                gradient[k : k + 3] += (
                    sign * along.real,
                    sign * along.imag,
                    sign * (along.conjugate() * 1j * arm).real,
                )
        if carried in self.bodies:
            gradient[3 * self.bodies.index(carried) + 2] += (along.conjugate() * gap).imag
        return (along.conjugate() * gap).real, gradient


def _stresses(matrix: Reals) -> Reals:
    """The forces of the conditions that hold one another: an orthonormal basis (rows, s) of the left null space."""
    left, values, _ = np.linalg.svd(matrix)
    rank = int((values > _RANK * values[0]).sum()) if len(values) else 0
    stresses: Reals = left[:, rank:]
    return stresses


def _stressed(conditions: ReferenceConditions, forces: Reals) -> set[int]:
    """The joints that hold one another."""
    return {
        row.joint
        for row, force in zip(conditions.rows, forces, strict=False)
        if np.abs(force).max(initial=0) > _STRESSED
    }


def _releases(conditions: ReferenceConditions, x: Reals) -> Iterator[_Release]:
    """Everything that may be released; nothing at driven joints."""
    linkage = conditions.linkage
    joints = conditions.chain.joints
    driven = {drive.joint for drive in linkage.mechanism.drives}
    held = {link for drive in linkage.mechanism.drives for link in drive.between}
    slot, slides = pair("roll_slide"), pair("double_slide")
    for number, joint in enumerate(joints):
        if number in driven:
            continue
        for link in joint.links:
            force = _force(conditions, number, link)
            angle = conditions.place(x, link)[1]
            if joint.pair.is_turning:
                yield _Release(rank=2, joint=number, link=link, functional=force, pair=None)
                bar = None if link in held else _bar(linkage, number, link)
                if bar is not None:
                    u = rect(1, angle + bar)
                    yield _Release(
                        rank=0,
                        joint=number,
                        link=link,
                        functional=np.array([[u.real, u.imag]]) @ force,
                        pair=slot,
                        along=bar,
                    )
                yield _Release(rank=3, joint=number, link=link, functional=force, pair=slot, along=-angle, turned=True)
            elif len(joint.links) > 2 or link == joint.links[0]:
                continue
            elif joint.pair.is_sliding:
                yield _Release(rank=2, joint=number, link=link, functional=force, pair=None)
                yield _Release(rank=3, joint=number, link=link, functional=force[:1], pair=slides)
                yield _Release(rank=3, joint=number, link=link, functional=force[1:], pair=slot)
            else:
                yield _Release(rank=1, joint=number, link=link, functional=force, pair=None)


def _force(conditions: ReferenceConditions, number: int, link: str) -> Reals:
    """What a joint transmits to one of its links, (1 or 2, rows), from the forces of all conditions."""
    rows = conditions.of(number)
    each = conditions.chain.joints[number].pair.u(Space.PLANAR)
    force = np.zeros((each, len(conditions.rows)))
    for place, k in enumerate(rows):
        first, other = conditions.rows[k].links
        force[place % each, k] = 1.0 if link == other else -1.0 if link == first else 0.0
    return force


def _bar(linkage: Linkage, number: int, link: str) -> float | None:
    """The direction of a link with two pins on it, from the other pin to this one; None if it has other joints."""
    joints = linkage.mechanism.chain.joints
    ends = [n for n, joint in enumerate(joints) if link in joint.links]
    if len(ends) != 2 or any(not joints[n].pair.is_turning for n in ends) or link == linkage.mechanism.frame:
        return None
    here = linkage.elements[number, link]
    there = linkage.elements[next(n for n in ends if n != number), link]
    return phase(complex(here.x - there.x, here.y - there.y))


def _chosen(linkage: Linkage, releases: Sequence[_Release], forces: Reals) -> list[_Release]:
    """As many releases as leave the rest independent."""
    chosen: list[_Release] = []
    joints: dict[int, set[str]] = {}
    while forces.shape[1]:
        here = [release.directed(forces) for release in releases]
        share = {}
        for k, _release in enumerate(here):
            taken = joints.get(_release.joint, set())
            emptied = len(taken) + 1 >= len(linkage.mechanism.chain.joints[_release.joint].links)
            if _release.link in taken or emptied or len(_release.functional) > forces.shape[1]:
                continue
            share[k] = float(np.linalg.svd(_release.functional @ forces, compute_uv=False)[-1])
        largest = max(share.values(), default=0.0)
        if not largest > _RANK:
            raise LinkageError("Its redundant conditions are all at driven joints.")
        kind = min(here[k].rank for k, value in share.items() if value >= _WELL * largest)
        best = max(value for k, value in share.items() if here[k].rank == kind)
        k = min(k for k, value in share.items() if here[k].rank == kind and value >= _EQUAL * best)
        chosen.append(here[k])
        joints.setdefault(here[k].joint, set()).add(here[k].link)
        forces = forces @ np.linalg.svd(here[k].functional @ forces)[2][len(here[k].functional) :].T
    return chosen


def _simplest(linkage: Linkage, releases: Sequence[_Release], forces: Reals) -> list[_Release]:
    """As many releases as leave the rest independent, exchanged one by one as long as its groups get smaller."""
    chosen = _chosen(linkage, releases, forces)
    cost = _cost(linkage, chosen)
    others = [_release for _release in releases if not _release.turned]
    for _ in range(len(chosen)):
        best = chosen
        for place, second in itertools.islice(itertools.product(range(len(chosen)), others), _TRIALS):
            trial = [*chosen[:place], second, *chosen[place + 1 :]]
            if len({(first.joint, first.link) for first in trial}) < len(trial) or _links_taken(linkage, trial):
                continue
            together = np.vstack([first.functional for first in trial])
            if together.shape[0] != forces.shape[1]:
                continue
            if np.linalg.svd(together @ forces, compute_uv=False)[-1] < _WELL**2:
                continue
            if (now := _cost(linkage, trial)) < cost:
                best, cost = trial, now
        if best is chosen:
            break
        chosen = best
    return chosen


def _links_taken(linkage: Linkage, chosen: Sequence[_Release]) -> bool:
    """Whether a joint would lose all its links."""
    joints = linkage.mechanism.chain.joints
    taken = Counter(_release.joint for _release in chosen)
    return any(many >= len(joints[number].links) for number, many in taken.items())


def _cost(linkage: Linkage, chosen: Sequence[_Release]) -> int:
    """How much there is to solve together: the cubes of the groups' sizes."""
    parts = decompose(with_lower_pairs(_released(linkage, chosen)).mechanism)
    return sum(len(group.bodies) ** 3 for group in parts.groups)


def _released(linkage: Linkage, chosen: Sequence[_Release]) -> Linkage:
    """The linkage with these conditions left out; a pin that may slide becomes that of a block in a slot."""
    mechanism = linkage.mechanism
    names = mechanism.chain.joint_names()
    elements: dict[str, dict[str | int, object]] = {link: {} for link in mechanism.chain.links}
    reference = {link: tuple(at) for link, at in (linkage.reference_pose or {}).items()}
    joints: list[Joint] = []
    number_of: dict[int, int] = {}
    slots: list[tuple[str, str, Line]] = []
    for number, joint in enumerate(mechanism.chain.joints):
        members: dict[str, Element] = {link: linkage.elements[number, link] for link in joint.links}
        kind = joint.pair
        for _release in (release for release in chosen if release.joint == number):
            here = members.pop(_release.link)
            if _release.pair is not None and joint.pair.is_turning:
                block = f"block {names[number]} {_release.link}"
                members[block] = Pin(0, 0)
                elements[block] = {}
                slots.append((_release.link, block, Line(here.x, here.y, _release.along)))
                reference[block] = (
                    (*linkage.reference_pose[_release.link].put(here.x, here.y), reference[_release.link][2])
                    if linkage.reference_pose
                    else ()
                )
            elif _release.pair is not None:
                kind = _release.pair
                members[_release.link] = here if kind.slides_two_ways else Pin(here.x, here.y)
        if len(members) > 1:
            number_of[number] = len(joints)
            for link, element in members.items():
                elements[link][len(joints)] = element
            joints.append(Joint(kind, tuple(members)))
    for link, block, line in slots:
        elements[link][len(joints)], elements[block][len(joints)] = line, Line(0, 0, line.angle)
        joints.append(Joint(pair("prismatic"), (link, block)))
    drives = [Drive(number_of[d.joint], d.direction, d.between) for d in mechanism.drives]
    chain = Chain(joints, links=list(elements), space=mechanism.chain.space)
    return Linkage(
        Mechanism(chain, mechanism.frame, drives),
        elements,
        points={name: (point.link, point.x, point.y) for name, point in linkage.points.items()},
        unit=linkage.unit,
        reference_pose=reference,  # type: ignore[arg-type]
        outputs=linkage.outputs,
    )
