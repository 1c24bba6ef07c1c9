"""Poses and rates in exact change points, where equations fail: limits of those on both sides."""

from __future__ import annotations

import numpy as np

from gruebler.arrays import Reals
from gruebler.kinematics.kernel_calls import SolvedRows, run_rows
from gruebler.kinematics.motion import Motion
from gruebler.kinematics.plan import Plan
from gruebler.kinematics.reference_pose import ReferencePose

__all__ = ["set_change_point_rows"]

_SINGULAR = 1e-5  # below this root the linear equations of the rates lose too many digits
_STEP = 0.04  # radians (or part of the size): how far from a change point poses are taken to find that at it
_OFFSETS = np.array([4, 3, 2, 1, -1, -2, -3, -4.0])
_WEIGHTS = np.array([-1, 8, -28, 56, 56, -28, 8, -1]) / 70  # of values at these offsets, for the value between them
_FEWER_WEIGHTS = np.array([0, 1, -6, 15, 15, -6, 1, 0]) / 20
_LEAST = 1e-11  # of the size: interpolated poses are no better
_SURE = 3  # so many times its doubt a limit differs from a pose that was found, if it replaces that


def set_change_point_rows(
    plan: Plan, motion: Motion, path: Reals, speeds: Reals, start: ReferencePose
) -> tuple[int, ...]:
    """Put limits where the linkage passes an exact change point: of the rates, and of poses that it leaves open.

    The linear equations of the rates fail there, and a dyad whose outer joints meet may have any direction. Along a
    branch poses and rates are analytic in the drive. They are found at eight places around the row and interpolated by
    a polynomial of degree 7: relative error of the order of 1e-12 for motions that are smooth over 0.16 radians.
    Where all rows are such points, the branch is that of a pose at the start or before it. Returns the rows without
    finite limits of the rates (the drive stands at its limit); their rates are NaN.
    """
    branching = [dyad.number for dyad in plan.dyads if dyad.branching]
    small = np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0) < _SINGULAR
    broken = ~np.isfinite(motion.rates).all(axis=(0, 2))
    unbounded = []
    for row in np.flatnonzero(small | broken):
        around = _rows_around(plan, motion, path, speeds, start, int(row))
        if around is None:
            motion.places[1:, row] = motion.rates[:, row] = np.nan
            unbounded.append(int(row))
            continue
        motion.places[1:, row] = np.tensordot(_WEIGHTS, around.places[1:, 1:], (0, 1))
        motion.rates[:, row] = np.tensordot(_WEIGHTS, around.rates[:, 1:], (0, 1))
        _set_pose(motion, int(row), around)
    return tuple(unbounded) if len(speeds) else ()


def _set_pose(motion: Motion, row: int, around: SolvedRows) -> None:
    """Put the limit of the poses if it is in less doubt than the pose that was found.

    By how much the polynomial of degree 7 differs from that of degree 5 is more than its error.
    """
    size = motion.plan.lower.size
    poses = np.array([around.places[0, 1:] / size, around.turns[1:]])
    limit, other = np.tensordot(poses, _WEIGHTS, (1, 0)), np.tensordot(poses, _FEWER_WEIGHTS, (1, 0))
    now = np.array([motion.places[0, row] / size, motion.turns[row]])
    if not np.abs(now - limit).max() > _LEAST + _SURE * np.abs(other - limit).max():  # or there is no limit
        return
    places, turns = limit
    angles = np.angle(motion.turns[row]) + 2 * np.pi * motion.whole[row]
    motion.places[0, row] = places * size
    motion.turns[row] = turns / np.abs(turns)
    motion.whole[row] = np.round((angles - np.angle(turns)) / (2 * np.pi))


def _rows_around(
    plan: Plan, motion: Motion, path: Reals, speeds: Reals, start: ReferencePose, row: int
) -> SolvedRows | None:
    """A row beside the change point, where the branch is known, and eight around it; None if one cannot be reached."""
    scale = np.array([1.0 if d.turning else plan.lower.size for d in plan.linkage.mechanism.drives])
    branching = [dyad.number for dyad in plan.dyads if dyad.branching]
    sound = np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0) > _SINGULAR
    sound &= (path != path[row]).any(axis=1)[: len(motion)]
    behind, before = np.flatnonzero(sound[row + 1 :]), np.flatnonzero(sound[:row])
    if len(behind) or len(before):
        k = row + 1 + int(behind[0]) if len(behind) else int(before[-1])
        start = ReferencePose(path[k], np.where(motion.roots[k] < 0, -1.0, 1.0), motion.unknowns[k])
    towards = start.drives - path[row]
    velocity = speeds[0, row] if len(speeds) else towards
    if not velocity.any():  # at rest: any direction does
        velocity = scale
    length = float(np.abs(velocity / scale).max())
    side = -1.0 if float((towards / scale) @ (velocity / scale)) < 0 else 1.0
    around = path[row] + side * _OFFSETS[:, None] * _STEP * velocity / length
    around = np.concatenate([start.drives[None] if towards.any() else around[:1], around])
    still = np.repeat(speeds[:, row : row + 1], len(around), axis=1)
    rows = run_rows(plan.program, plan, around, still, len(speeds), start.signs, start.unknowns)
    return rows if rows.reached == len(around) else None
