"""Whether a body stays clear of an outline on its way through the targets: docs/theory/synthesis-types.md."""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.design.synthesis.results import Design
from gruebler.design.synthesis.specification import Clearance
from gruebler.mechanics.kinematics.solve import move_quietly

_ROWS, _MOST_ROWS = 65, 4097  # poses on the way: doubled until the answer is certain


def guided_link(design: Design) -> str:
    """The link that carries the point of the task."""
    return design.linkage.points["P"].link


def stays_clear(design: Design, clearance: Clearance) -> bool:
    """Whether the lines of the body come nowhere nearer to those of the obstacle than the demanded distance.

    Between two poses no point of the body goes further than twice the longest way of one of its points from pose to
    pose, a straight line. Poses are added until this bound decides; what is not decided with 4,097 poses counts as not
    clear, so an answer of True is certain for motions that do not turn back between two poses.
    """
    count = _ROWS
    while count <= _MOST_ROWS:
        lines = _on_the_way(design, clearance, count)
        if lines is None:
            return False
        gaps = _distances(lines, clearance.outlines[1])
        if gaps.min() < clearance.distance or gaps.min() <= 0:
            return False
        steps = np.abs(np.diff(lines, axis=0)).max(axis=1)
        if (np.minimum(gaps[1:], gaps[:-1]) - steps > clearance.distance).all():
            return True
        count = 2 * count - 1
    return False


def _drive_values(design: Design) -> Reals:
    """At the targets; where the drive turns on to the first one, also there."""
    values = np.array(design.drives)
    if design.targets is None or not design.targets.all_round or not design.verdict.turns_fully:
        return values
    travel = values[-1] - values[0]
    turns = np.copysign(np.ceil(np.abs(travel) / (2 * np.pi)), travel)
    return np.append(values, values[0] + 2 * np.pi * turns)


def _on_the_way(design: Design, clearance: Clearance, count: int) -> Complexes | None:
    """(poses, points) the outline of the body from the first target to the last; None if it does not get there."""
    if not design.drives:
        return None
    drives = _drive_values(design)
    values = np.interp(np.linspace(0, 1, count), np.linspace(0, 1, len(drives)), drives)
    link = guided_link(design)
    try:
        motion = move_quietly(design.linkage, values)
        if not motion.complete:
            return None
    except LinkageError:
        return None
    origin, turn = motion.complex_point("P"), np.exp(1j * (motion.angle(link) - motion.angle(link)[0]))
    body = clearance.outlines[0]
    return np.asarray(origin[:, None] + turn[:, None] * (body - origin[0]), np.complex128)


def _distances(lines: Complexes, obstacle: Complexes) -> Reals:
    """(poses,) the distance of two lines through points; 0 where they cross."""
    a, b = lines[:, :-1, None], lines[:, 1:, None]
    p, q = obstacle[None, None, :-1], obstacle[None, None, 1:]
    ends = [_to_segment(a, p, q), _to_segment(b, p, q), _to_segment(p, a, b), _to_segment(q, a, b)]
    crossing = (_side(a, b, p) * _side(a, b, q) <= 0) & (_side(p, q, a) * _side(p, q, b) <= 0)
    gaps = np.where(crossing & (_side(a, b, p) != _side(a, b, q)), 0.0, np.minimum.reduce(np.broadcast_arrays(*ends)))
    return np.asarray(gaps.min(axis=(1, 2)), np.float64)


def _to_segment(point: Complexes, begin: Complexes, end: Complexes) -> Reals:
    """The distance of points from segments."""
    along = end - begin
    length = np.maximum(np.abs(along) ** 2, 1e-300)
    part = np.clip(np.real((point - begin) * np.conj(along)) / length, 0, 1)
    return np.asarray(np.abs(point - begin - part * along), np.float64)


def _side(begin: Complexes, end: Complexes, point: Complexes) -> Reals:
    """On which side of a line points lie: the sign."""
    return np.asarray(np.sign(np.imag(np.conj(end - begin) * (point - begin))), np.float64)
