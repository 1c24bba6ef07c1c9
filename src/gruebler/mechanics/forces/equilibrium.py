"""The equations of equilibrium of all links of a linkage, solved at every row."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.mechanics.forces.acting import Rows, Wrench
from gruebler.mechanics.forces.contact_forces import contact_forces
from gruebler.mechanics.forces.taking_apart import (
    GROWTH,
    HeldDyad,
    HeldLink,
    JointForces,
    JointPlaces,
    LinkLoads,
    removal_steps,
)
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.linkages.lower_pairs import joints_before

_BLOCK = 2048  # rows solved at once
_LOOKS = 7  # rows in which it is looked whether wheels that press each other apart would do work
_WORKLESS = 1e-7  # of a force of one, lengths in sizes


class JointConnection(NamedTuple):
    """Two links that a joint holds together, by number: ``force`` and ``couple`` are those on the second."""

    joint: int
    first: int
    second: int
    slides: bool


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class Reactions:
    """What joints and drives exert; NaN in rows where it is not determined."""

    forces: Complexes
    """(rows, contacts): on the other link, at its point of the joint."""
    couples: Reals
    """(rows, contacts): on the other link, of slides and contacts about its point; of pins by friction."""
    drives: Reals
    """(rows, drives): torques, or forces along slides, on the link that is moved."""
    singular: Flags
    """(rows,): whether the links are not held in this pose."""
    carried: Reals
    """(rows, pairs): what each pair of teeth or belt that presses its wheels apart or together transmits, with sign."""

    def plus(self, parts: Iterable[tuple[Reals, Reactions]]) -> Reactions:
        """The sum with sizes, (rows,) each, times other reactions."""
        total = self
        for size, part in parts:
            names = ("forces", "couples", "drives", "carried")
            more = {name: getattr(total, name) + size[:, None] * getattr(part, name) for name in names}
            total = replace(total, **more)
        return total


def joint_connections(motion: Motion) -> tuple[JointConnection, ...]:
    """Those of the linkage as it was solved."""
    return _connections(motion.lower_linkage)


@lru_cache(maxsize=64)
def _connections(linkage: Linkage) -> tuple[JointConnection, ...]:
    chain = linkage.mechanism.chain
    return tuple(
        JointConnection(number, chain.links.index(joint.links[0]), chain.links.index(second), joint.pair.is_sliding)
        for number, joint in enumerate(chain.joints)
        for second in joint.links[1:]
    )


@lru_cache(maxsize=64)
def _before(linkage: Linkage) -> tuple[int, ...]:
    return joints_before(linkage)


def joint_of_connection(motion: Motion) -> tuple[int, ...]:
    """For each joint as it was solved the joint of the linkage: one of two freedoms stands for two in a row."""
    return _before(motion.linkage)


def pressed_apart(motion: Motion) -> tuple[set[int], set[int]]:
    """The joints of the linkage whose teeth or belts press wheels apart or together, and those whose distance varies.

    The latter are taken as pitch circles, whose force goes along their common tangent.
    """
    if removal_steps(motion.lower_linkage) is not None:
        return set(), set()
    held, before, units = joint_connections(motion), joint_of_connection(motion), _unit_forces(motion)
    pressing = [(own, left) for own, left in zip(units, _held_apart(motion, units), strict=True) if own.presses]
    joints = [(before[held[own.number].joint], left.presses) for own, left in pressing]
    return {joint for joint, apart in joints if apart}, {joint for joint, apart in joints if not apart}


def link_loads(motion: Motion, wrenches: Iterable[Wrench]) -> LinkLoads:
    """All loads of each link together, moments about its origin; (links, rows)."""
    shape = motion.turns.shape[::-1]
    total = LinkLoads(np.zeros(shape, np.complex128), np.zeros(shape))
    forces = dict[LinkPoint, Complexes]()  # weight and inertia act at the same places
    for wrench in wrenches:
        total.moment[motion.links.index(wrench.place.link)] += wrench.moment
        known = forces.get(wrench.place)
        forces[wrench.place] = wrench.force if known is None else known + wrench.force
    for place, force in forces.items():
        k = motion.links.index(place.link)
        total.force[k] += force
        if place.x or place.y:
            total.moment[k] += (np.conj(motion.turns[:, k] * complex(place.x, place.y)) * force).imag
    return total


def reactions(motion: Motion, loads: LinkLoads) -> Reactions:
    """The forces of all joints and drives that hold loads, without friction. Cost: as `responses`."""
    (free,), pressing = responses(motion, [loads])
    return free.plus((np.abs(free.carried[:, k]), part) for k, part in enumerate(pressing))


def responses(motion: Motion, cases: Sequence[LinkLoads]) -> tuple[list[Reactions], list[Reactions]]:
    """What holds each case of loads if teeth and belts do not press wheels apart or together, linear in the loads.

    Second, for each pair that presses, in the order of `Reactions.carried`, what one unit of the size that it transmits
    adds by pressing.

    Cost: 0.1 us for each dyad at each row; where links are not all dyads and driven ones, a linear system of three rows
    for each moving link, at each row, once for all cases.
    """
    steps = removal_steps(motion.lower_linkage)
    units = [] if steps is not None else _held_apart(motion, _unit_forces(motion))
    force, moment = (np.stack(parts) for parts in zip(*cases, strict=True))
    blocks = []
    for first in range(0, max(len(motion), 1), _BLOCK):
        rows = slice(first, first + _BLOCK)
        loads = LinkLoads(force[..., rows], moment[..., rows] / motion.size)
        own = [unit.of_rows(rows) for unit in units]
        blocks.append(
            _at_once(motion, own, loads, rows) if steps is None else _link_by_link(motion, steps, loads, rows)
        )
    joined = [
        Reactions(**{f.name: np.concatenate([getattr(part, f.name) for part in parts]) for f in fields(Reactions)})
        for parts in zip(*blocks, strict=True)
    ]
    return joined[: len(cases)], joined[len(cases) :]


def _link_by_link(
    motion: Motion, steps: tuple[HeldLink | HeldDyad, ...], loads: LinkLoads, rows: slice
) -> list[Reactions]:
    lower, held = motion.lower_linkage, joint_connections(motion)
    places, turns = _pose(motion, rows)
    joints = JointPlaces([], [], [])
    for connection in held:
        if connection.joint == len(joints.at):
            at, line = _meeting(lower, places, turns, connection)
            joints.slides.append(connection.slides)
            joints.at.append(at - places[0])
            joints.lines.append(line)
    about = LinkLoads(loads.force, loads.moment + (np.conj(places - places[0]) * loads.force).imag)
    joint_forces = JointForces(joints, about)
    efforts = np.zeros((*loads.moment[:, 0].shape, len(lower.mechanism.drives)))
    for step in steps:
        with np.errstate(divide="ignore", invalid="ignore"):  # where links are not held
            load = joint_forces.take_off(step)
        if isinstance(step, HeldLink):
            drive = _drive(lower, step.drive)
            sign = -1.0 if step.link == drive.second else 1.0
            if drive.slides:
                _, line = _meeting(lower, places, turns, drive)
                efforts[..., step.drive] = sign * (np.conj(line) * load.force).real
            else:
                efforts[..., step.drive] = sign * lower.size * joint_forces.moment_at(step.joint, load)
    forces = np.stack([joint_forces.forces[c.joint, c.second] for c in held], axis=-1)
    couples = np.zeros(forces.shape)
    for k, connection in enumerate(held):
        if connection.slides:
            couples[..., k] = joint_forces.couples[connection.joint, connection.second] * lower.size
    nowhere = ~joint_forces.held
    for array in (forces, couples, efforts):
        array[:, nowhere] = np.nan
    carried = np.zeros((len(nowhere), 0))
    return [
        Reactions(forces=force, couples=couple, drives=effort, singular=nowhere, carried=carried)
        for force, couple, effort in zip(forces, couples, efforts, strict=True)
    ]


@dataclass(frozen=True, eq=False, kw_only=True)
class _UnitForce:
    """What an unknown of one is: a force at the second link's point of a joint, and a couple; (rows,) each."""

    number: int
    """Of the connection."""
    at: Complexes
    """The point, in sizes."""
    force: Complexes
    couple: Reals
    apart: Complexes
    """What acts there besides for each unit of the unknown's size: teeth and belts press wheels apart or together."""
    apart_couple: Reals
    presses: bool
    """Whether there is such a thing in any row of the motion."""

    def of_rows(self, rows: slice | Rows) -> _UnitForce:
        arrays = ("at", "force", "couple", "apart", "apart_couple")
        return replace(self, **{name: getattr(self, name)[rows] for name in arrays})


def _unit_forces(motion: Motion) -> list[_UnitForce]:
    """The unknowns of all joints, in the order of the connections."""
    lower, links = motion.lower_linkage, motion.links
    places, turns = _pose(motion, slice(None))
    zero, along = np.zeros(len(motion), np.complex128), np.ones(len(motion), np.complex128)
    none, units = zero.real, list[_UnitForce]()
    for k, connection in enumerate(joint_connections(motion)):
        at, line = _meeting(lower, places, turns, connection)
        if lower.mechanism.chain.joints[connection.joint].pair.is_basic:
            both = ((1j * line, none), (zero, along.real)) if connection.slides else ((along, none), (1j * along, none))
            units += [
                _UnitForce(number=k, at=at, force=force, couple=couple, apart=zero, apart_couple=none, presses=False)
                for force, couple in both
            ]
            continue
        (_, second), pressing = contact_forces(motion, joint_of_connection(motion)[connection.joint])
        sign = 1 if second == links[connection.second] else -1
        for its in pressing:
            arm = np.conj(its.at / lower.size - at)
            units.append(
                _UnitForce(
                    number=k,
                    at=at,
                    force=sign * its.force,
                    couple=sign * ((arm * its.force).imag + its.couple / lower.size),
                    apart=sign * its.apart,
                    apart_couple=sign * (arm * its.apart).imag,
                    presses=bool(its.apart.any()),
                )
            )
    return units


def _at_once(motion: Motion, units: Sequence[_UnitForce], given: LinkLoads, rows: slice) -> list[Reactions]:
    lower, count, cases = motion.lower_linkage, len(units), len(given.force)
    each = np.stack([given.force.real, given.force.imag, given.moment], axis=2)  # cases, links, parts, rows
    loads = each.reshape(cases, -1, each.shape[-1]).transpose(2, 1, 0)
    answer, singular = _responses(motion, units, loads, rows)
    turning = np.array([drive.turning for drive in lower.mechanism.drives], bool)
    pressing, driven = [k for k, unit in enumerate(units) if unit.presses], len(motion.linkage.mechanism.drives)
    parts = []
    for column in range(answer.shape[2]):
        unknowns = answer[..., column]
        forces = np.zeros((len(unknowns), len(joint_connections(motion))), np.complex128)
        couples = np.zeros(forces.shape)
        for k, unit in enumerate(units):
            forces[:, unit.number] += unknowns[:, k] * unit.force
            couples[:, unit.number] += unknowns[:, k] * unit.couple
        if column >= cases:
            unit = units[pressing[column - cases]]
            forces[:, unit.number] += unit.apart
            couples[:, unit.number] += unit.apart_couple
        drives = unknowns[:, count:] * np.where(turning, lower.size, 1.0)
        parts.append(
            Reactions(
                forces=forces,
                couples=couples * lower.size,
                drives=drives[:, :driven],
                singular=singular,
                carried=unknowns[:, pressing],
            )
        )
    return parts


def _responses(motion: Motion, units: Sequence[_UnitForce], loads: Reals, rows: slice | Rows) -> tuple[Reals, Flags]:
    """The unknowns for each case of loads, (rows, 3 links, cases), then for what presses apart; where none are."""
    lower = motion.lower_linkage
    columns, sideways = _columns(motion, units, rows)
    frame = lower.mechanism.chain.links.index(lower.mechanism.frame)
    bodies = [3 * k + part for k in range(len(lower.mechanism.chain.links)) if k != frame for part in range(3)]
    matrix = columns[:, bodies]
    if matrix.shape[1] != matrix.shape[2]:
        raise LinkageError(
            "joint forces are not determined by statics: {unknowns} unknowns in {equations} equations",
            unknowns=matrix.shape[2],
            equations=matrix.shape[1],
        )
    probe = np.random.default_rng(0).uniform(0.5, 1.0, (len(matrix), len(bodies), 1))
    answer = _solved(matrix, np.concatenate([probe, -loads[:, bodies], -sideways[:, bodies]], axis=2))
    with np.errstate(invalid="ignore"):
        singular = ~(np.abs(answer[..., 0]).max(axis=1, initial=0.0) < GROWTH)
    answer[singular] = np.nan
    return answer[..., 1:], singular


def _held_apart(motion: Motion, units: Sequence[_UnitForce]) -> list[_UnitForce]:
    """The unknowns, without what presses apart where the distance is not held: pitch circles, which do no work so."""
    if not any(unit.presses for unit in units):
        return list(units)
    rows = np.unique(np.linspace(0, len(motion) - 1, _LOOKS).astype(int))
    nothing = np.zeros((len(rows), 3 * len(motion.links), 0))
    answer, _ = _responses(motion, [unit.of_rows(rows) for unit in units], nothing, rows)
    pressing = [k for k, unit in enumerate(units) if unit.presses]
    working = np.abs(answer[:, [*pressing, *range(len(units), answer.shape[1])]]).max(axis=1, initial=0.0)
    freed = {k for k, size in zip(pressing, np.nan_to_num(working).max(axis=0), strict=True) if size > _WORKLESS}
    return [replace(unit, presses=False) if k in freed else unit for k, unit in enumerate(units)]


def _columns(motion: Motion, units: Sequence[_UnitForce], rows: slice | Rows) -> tuple[Reals, Reals]:
    """What each unknown does to each link (x, y, moment about its origin): (rows, 3 links, unknowns).

    Unknowns: those of the joints, then the drives. Second comes what acts besides where something presses apart.
    """
    lower, (places, turns) = motion.lower_linkage, _pose(motion, rows)
    links, count = places.shape
    held, drives = joint_connections(motion), range(len(lower.mechanism.drives))
    pressing = [unit for unit in units if unit.presses]
    acts = _Actions(places, np.zeros((count, 3 * links, len(units) + len(drives))))
    sideways = _Actions(places, np.zeros((count, 3 * links, len(pressing))))
    for column, unit in enumerate(units):
        acts.act(held[unit.number], column, unit.at, unit.force, unit.couple)
    for column, unit in enumerate(pressing):
        sideways.act(held[unit.number], column, unit.at, unit.apart, unit.apart_couple)
    for column, drive in enumerate((_drive(lower, k) for k in drives), len(units)):
        at, line = _meeting(lower, places, turns, drive)
        if drive.slides:
            acts.act(drive, column, at, line, 0.0)
        else:
            acts.act(drive, column, at, 0 * line, 1.0)
    return acts.columns, sideways.columns


class _Actions(NamedTuple):
    """Columns being filled: each action on the other link, its reaction on the first."""

    places: Complexes
    columns: Reals

    def act(self, pair: JointConnection, column: int, at: Complexes, force: Complexes, couple: Reals | float) -> None:
        for link, sign in ((pair.second, 1), (pair.first, -1)):
            self.columns[:, 3 * link, column] += sign * force.real
            self.columns[:, 3 * link + 1, column] += sign * force.imag
            arm = np.conj(at - self.places[link])
            self.columns[:, 3 * link + 2, column] += sign * ((arm * force).imag + couple)


def _pose(motion: Motion, rows: slice | Rows) -> tuple[Complexes, Complexes]:
    """Origins in sizes and turns of the links; (links, rows) each."""
    places = motion.places[0, rows].T / motion.lower_linkage.size
    return places, np.ascontiguousarray(motion.turns[rows].T)


def _drive(lower: Linkage, number: int) -> JointConnection:
    """The links between which a drive acts, as those of a joint."""
    drive, links = lower.mechanism.drives[number], lower.mechanism.chain.links
    first, second = (links.index(link) for link in lower.reference(number))
    return JointConnection(drive.joint, first, second, slides=not drive.turning)


def _meeting(lower: Linkage, places: Complexes, turns: Complexes, pair: JointConnection) -> tuple[Complexes, Complexes]:
    """Where the other link's point of a joint lies, in sizes, and the direction of the first one's line."""
    links = lower.mechanism.chain.links
    near, far = (lower.elements[pair.joint, links[k]] for k in (pair.first, pair.second))
    at = places[pair.second] + turns[pair.second] * (complex(far.x, far.y) / lower.size)
    return at, turns[pair.first] * rect(1, near.direction)


def _solved(matrix: Reals, right: Reals) -> Reals:
    """Of a row that cannot be solved, infinities."""
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        solutions = np.full(right.shape, np.inf)
        for row, (system, side) in enumerate(zip(matrix, right, strict=True)):
            if np.linalg.matrix_rank(system) == len(system):
                solutions[row] = np.linalg.solve(system, side)
        return solutions
