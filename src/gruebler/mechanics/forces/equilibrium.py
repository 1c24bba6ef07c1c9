"""The equations of equilibrium of all links of a linkage with turning and sliding joints, solved at every row."""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.forces.acting import Wrench
from gruebler.mechanics.kinematics import Motion
from gruebler.structure.chain.spaces import Space

_GROWTH = 1e6  # an answer larger than this by its load (lengths in sizes): the links are not held in this pose
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
    chain = motion.lower_linkage.mechanism.chain
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


def reactions(motion: Motion, cases: Sequence[Iterable[Wrench]]) -> tuple[Reactions, ...]:
    """The forces of all joints and drives that hold each case of loads, from three equations for each link.

    Cost: a linear system of three rows for each moving link, at each row, once for all cases.
    """
    loads = [tuple(wrenches) for wrenches in cases]
    blocks = [_block(motion, loads, slice(first, first + _BLOCK)) for first in range(0, max(len(motion), 1), _BLOCK)]
    return tuple(
        Reactions(*(np.concatenate(column) for column in zip(*parts, strict=True)))
        for parts in zip(*blocks, strict=True)
    )


def _block(motion: Motion, cases: Sequence[tuple[Wrench, ...]], rows: slice) -> list[Reactions]:
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
    loads = [_loads(motion, wrenches, rows)[:, bodies] for wrenches in cases]
    probe = np.random.default_rng(0).uniform(0.5, 1.0, (len(matrix), len(bodies)))
    answer = _solved(matrix, np.stack([probe, *(-load for load in loads)], axis=2))
    with np.errstate(invalid="ignore"):
        singular = ~(np.abs(answer[..., 0]).max(axis=1, initial=0.0) < _GROWTH)
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
    lower, z = motion.lower_linkage, motion.places[0, rows]
    links = lower.mechanism.chain.links
    acts = _Actions(z / lower.size, np.zeros((len(z), 3 * len(links), 2 * len(held) + len(lower.mechanism.drives))))
    directions = np.ones((len(z), len(held)), np.complex128)
    for k, contact in enumerate(held):
        at, line = _meeting(motion, contact.joint, links[contact.first], links[contact.second], rows)
        if contact.slides:
            directions[:, k] = 1j * line
            acts.force(contact, 2 * k, 1j * line, at)
            acts.couple(contact, 2 * k + 1)
        else:
            acts.force(contact, 2 * k, np.ones_like(line), at)
            acts.force(contact, 2 * k + 1, 1j * np.ones_like(line), at)
    for k, drive in enumerate(lower.mechanism.drives):
        first, second = lower.reference(k)
        pair = JointConnection(drive.joint, links.index(first), links.index(second), False)
        if drive.turning:
            acts.couple(pair, 2 * len(held) + k)
        else:
            at, line = _meeting(motion, drive.joint, first, second, rows)
            acts.force(pair, 2 * len(held) + k, line, at)
    return acts.columns, directions


class _Actions(NamedTuple):
    """Columns being filled: each action on the other link, its reaction on the first."""

    places: Complexes
    columns: Reals

    def force(self, pair: JointConnection, column: int, direction: Complexes, at: Complexes) -> None:
        for link, sign in ((pair.second, 1), (pair.first, -1)):
            self.columns[:, 3 * link, column] += sign * direction.real
            self.columns[:, 3 * link + 1, column] += sign * direction.imag
            arm = at - self.places[:, link]
            self.columns[:, 3 * link + 2, column] += sign * (np.conj(arm) * direction).imag

    def couple(self, pair: JointConnection, column: int) -> None:
        self.columns[:, 3 * pair.second + 2, column] += 1
        self.columns[:, 3 * pair.first + 2, column] -= 1


def _meeting(motion: Motion, joint: int, first: str, second: str, rows: slice) -> tuple[Complexes, Complexes]:
    """Where the other link's point of a joint lies, in sizes, and the direction of the first one's line."""
    lower = motion.lower_linkage
    links, near, far = lower.mechanism.chain.links, lower.elements[joint, first], lower.elements[joint, second]
    k, m = links.index(first), links.index(second)
    at = (motion.places[0, rows, m] + motion.turns[rows, m] * complex(far.x, far.y)) / lower.size
    return at, motion.turns[rows, k] * rect(1, near.direction)


def _loads(motion: Motion, wrenches: tuple[Wrench, ...], rows: slice) -> Reals:
    """The loads on each link: x, y and the moment about its origin by the size; (rows, 3 links)."""
    lower, turns = motion.lower_linkage, motion.turns[rows]
    totals = np.zeros((len(turns), 3 * turns.shape[1]))
    for wrench in wrenches:
        k = lower.mechanism.chain.links.index(wrench.place.link)
        force, arm = wrench.force[rows], turns[:, k] * complex(wrench.place.x, wrench.place.y)
        totals[:, 3 * k] += force.real
        totals[:, 3 * k + 1] += force.imag
        totals[:, 3 * k + 2] += ((np.conj(arm) * force).imag + wrench.moment[rows]) / lower.size
    return totals


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
