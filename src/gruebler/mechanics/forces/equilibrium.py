"""The equations of equilibrium of all links of a linkage with turning and sliding joints, solved at every row."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.forces.acting import Wrench
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
from gruebler.structure.chain import Chain
from gruebler.structure.chain.spaces import Space

_BLOCK = 2048  # rows solved at once


class JointConnection(NamedTuple):
    """Two links that a joint holds together, by number: ``force`` and ``couple`` are those on the second."""

    joint: int
    first: int
    second: int
    slides: bool


class Reactions(NamedTuple):
    """What joints and drives exert; NaN in rows where it is not determined."""

    forces: Complexes
    """(rows, contacts): on the other link, at its point of the joint."""
    couples: Reals
    """(rows, contacts): on the other link, of slides about its point; of pins by friction."""
    drives: Reals
    """(rows, drives): torques, or forces along slides, on the link that is moved."""
    singular: Flags
    """(rows,): whether the links are not held in this pose."""


def joint_connections(motion: Motion) -> tuple[JointConnection, ...]:
    """Those of the linkage with lower pairs. `LinkageError` for other joints than turning and sliding ones."""
    return _connections(motion.lower_linkage.mechanism.chain)


@lru_cache(maxsize=64)
def _connections(chain: Chain) -> tuple[JointConnection, ...]:
    connections = []
    for number, joint in enumerate(chain.joints):
        if not joint.pair.is_basic:
            raise LinkageError(
                "joint forces are known for turning and sliding joints; {joint} is neither",
                joint=chain.joint_title(number),
            )
        for second in joint.links[1:]:
            first = chain.links.index(joint.links[0])
            connections.append(JointConnection(number, first, chain.links.index(second), joint.pair.is_sliding))
    return tuple(connections)


def joint_of_connection(motion: Motion) -> tuple[int, ...]:
    """For each joint as it was solved the joint of the linkage: one of two freedoms stands for two in a row."""
    joints = motion.linkage.mechanism.chain.joints
    return tuple(number for number, joint in enumerate(joints) for _ in range(joint.pair.f(Space.PLANAR)))


def joints_left_out(motion: Motion) -> bool:
    """Whether contacts of wheels were left out that say nothing new: what they carry, and others less, is not known."""
    connections = {connection.joint for connection in joint_connections(motion)}
    return len(connections) < len(joint_of_connection(motion))


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


def reactions(motion: Motion, cases: Sequence[LinkLoads]) -> tuple[Reactions, ...]:
    """The forces of all joints and drives that hold each case of loads, from three equations for each link.

    Cost: 0.1 us for each dyad at each row; where links are not all dyads and driven ones, a linear system of three rows
    for each moving link, at each row, once for all cases.
    """
    joint_connections(motion)  # that all joints turn or slide
    steps = removal_steps(motion.lower_linkage)
    force, moment = (np.stack(parts) for parts in zip(*cases, strict=True))
    blocks = []
    for first in range(0, max(len(motion), 1), _BLOCK):
        rows = slice(first, first + _BLOCK)
        loads = LinkLoads(force[..., rows], moment[..., rows] / motion.size)
        blocks.append(_at_once(motion, loads, rows) if steps is None else _link_by_link(motion, steps, loads, rows))
    if len(blocks) == 1:
        return tuple(blocks[0])
    return tuple(
        Reactions(*(np.concatenate(column) for column in zip(*parts, strict=True)))
        for parts in zip(*blocks, strict=True)
    )


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
    return [Reactions(*parts, nowhere) for parts in zip(forces, couples, efforts, strict=True)]


def _at_once(motion: Motion, given: LinkLoads, rows: slice) -> list[Reactions]:
    lower, held = motion.lower_linkage, joint_connections(motion)
    columns, directions = _columns(motion, held, rows)
    frame = lower.mechanism.chain.links.index(lower.mechanism.frame)
    bodies = [3 * k + part for k in range(len(lower.mechanism.chain.links)) if k != frame for part in range(3)]
    matrix = columns[:, bodies]
    if matrix.shape[1] != matrix.shape[2]:
        raise LinkageError(
            "joint forces are not determined by statics: {unknowns} unknowns in {equations} equations",
            unknowns=matrix.shape[2],
            equations=matrix.shape[1],
        )
    each = np.stack([given.force.real, given.force.imag, given.moment], axis=2)  # cases, links, parts, rows
    loads = each.reshape(len(each), -1, len(matrix))[:, bodies].transpose(2, 1, 0)
    probe = np.random.default_rng(0).uniform(0.5, 1.0, (len(matrix), len(bodies), 1))
    answer = _solved(matrix, np.concatenate([probe, -loads], axis=2))
    with np.errstate(invalid="ignore"):
        singular = ~(np.abs(answer[..., 0]).max(axis=1, initial=0.0) < GROWTH)
    slides = np.array([contact.slides for contact in held], bool)
    turning = np.array([drive.turning for drive in lower.mechanism.drives], bool)
    parts = []
    for case in range(1, answer.shape[2]):
        unknown_forces = np.where(singular[:, None], np.nan, answer[..., case])
        first, second = unknown_forces[:, 0 : 2 * len(held) : 2], unknown_forces[:, 1 : 2 * len(held) : 2]
        forces = np.where(slides, directions * first, first + 1j * second)
        drives = unknown_forces[:, 2 * len(held) :] * np.where(turning, lower.size, 1.0)
        parts.append(Reactions(forces, np.where(slides, second * lower.size, 0.0), drives, singular))
    return parts


def _columns(motion: Motion, held: tuple[JointConnection, ...], rows: slice) -> tuple[Reals, Complexes]:
    """What each unknown does to each link (x, y, moment about its origin): (rows, 3 links, unknowns).

    Unknowns: x, y of a pin's force, normal force and couple of a slide, then the drives. Second come the directions of
    the slides' normal forces, (rows, contacts).
    """
    lower, (places, turns) = motion.lower_linkage, _pose(motion, rows)
    links, count = places.shape
    drives = [_drive(lower, k) for k in range(len(lower.mechanism.drives))]
    acts = _Actions(places, np.zeros((count, 3 * links, 2 * len(held) + len(drives))))
    directions = np.ones((count, len(held)), np.complex128)
    for k, contact in enumerate(held):
        at, line = _meeting(lower, places, turns, contact)
        if contact.slides:
            directions[:, k] = 1j * line
            acts.force(contact, 2 * k, 1j * line, at)
            acts.couple(contact, 2 * k + 1)
        else:
            acts.force(contact, 2 * k, np.ones_like(line), at)
            acts.force(contact, 2 * k + 1, 1j * np.ones_like(line), at)
    for column, drive in enumerate(drives, 2 * len(held)):
        if drive.slides:
            at, line = _meeting(lower, places, turns, drive)
            acts.force(drive, column, line, at)
        else:
            acts.couple(drive, column)
    return acts.columns, directions


class _Actions(NamedTuple):
    """Columns being filled: each action on the other link, its reaction on the first."""

    places: Complexes
    columns: Reals

    def force(self, pair: JointConnection, column: int, direction: Complexes, at: Complexes) -> None:
        for link, sign in ((pair.second, 1), (pair.first, -1)):
            self.columns[:, 3 * link, column] += sign * direction.real
            self.columns[:, 3 * link + 1, column] += sign * direction.imag
            arm = at - self.places[link]
            self.columns[:, 3 * link + 2, column] += sign * (np.conj(arm) * direction).imag

    def couple(self, pair: JointConnection, column: int) -> None:
        self.columns[:, 3 * pair.second + 2, column] += 1
        self.columns[:, 3 * pair.first + 2, column] -= 1


def _pose(motion: Motion, rows: slice) -> tuple[Complexes, Complexes]:
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
