"""Poses and rates in exact change points, where equations fail: limits of those on both sides."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals, angles_of_turns, whole_turns
from gruebler.mechanics.kinematics.kernel_calls import SolvedRows, run_rows
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose

_SINGULAR = 1e-5  # below this root the linear equations of the rates lose too many digits
_AT_LIMIT = 1e-7  # above this root the equations still give some digits of rates where there are no limits to take
_STEP = 0.04  # radians (or part of the size): how far from a change point poses are taken to find that at it
_OFFSETS = np.array([4, 3, 2, 1, -1, -2, -3, -4.0])
_WEIGHTS = np.array([-1, 8, -28, 56, 56, -28, 8, -1]) / 70  # of values at these offsets, for the value between them
_FEWER_WEIGHTS = np.array([0, 1, -6, 15, 15, -6, 1, 0]) / 20
_LEAST = 1e-11  # of the size: interpolated poses are no better
_SURE = 3  # so many times its doubt a limit differs from a pose that was found, if it replaces that
_KINK = 0.01  # of the roots around: a root that keeps its sign and is interpolated with more has a kink, not a zero
_MISSED = 1e-14  # a pose that was replaced, further from its limit times the root than this, was not off by rounding


class ChangePointRows(NamedTuple):
    """The rows of a motion in which the equations of a dyad fail or nearly fail."""

    unbounded: tuple[int, ...]
    """Without finite limits of the rates: the drive stands at its limit; their rates are NaN."""
    taken_for_exact: tuple[int, ...]
    """Of a linkage that misses the change point by less than the solver tells apart: they have the poses and rates of
    one that meets it."""


def set_change_point_rows(
    plan: Plan, motion: Motion, path: Reals, speeds: Reals, start: Callable[[], ReferencePose]
) -> ChangePointRows:
    """Put limits where the linkage passes an exact change point: of the rates, and of poses that it leaves open.

    The linear equations of the rates fail there, and a dyad whose outer joints meet may have any direction. Along a
    branch poses and rates are analytic in the drive. They are found at eight places around the row and interpolated by
    a polynomial of degree 7: relative error of the order of 1e-12 for motions that are smooth over 0.16 radians.
    Where all rows are such points, the branch is that of a pose at the start or before it, which ``start`` gives. A
    linkage that only passes near a change point keeps what the equations give.
    """
    branching = np.array(plan.branching, dtype=np.int64)
    small = np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0) < _SINGULAR
    broken = np.asarray(~np.isfinite(motion.rates).all(axis=(0, 2)))
    unbounded, taken = list[int](), list[int]()
    for row in map(int, np.flatnonzero(small | broken)):
        around = _rows_around(plan, motion, path, speeds, start, row)
        if around is None:
            if not broken[row] and np.abs(motion.roots[row, branching]).min(initial=1.0) > _AT_LIMIT:
                continue
            motion.places[1:, row] = motion.rates[:, row] = np.nan
            unbounded.append(row)
            continue
        roots = motion.roots[row, branching]
        if not broken[row] and _only_passes_near(roots, around.roots[1:, branching]):
            continue
        motion.places[1:, row] = np.tensordot(_WEIGHTS, around.places[1:, 1:], (0, 1))
        motion.rates[:, row] = np.tensordot(_WEIGHTS, around.rates[:, 1:], (0, 1))
        if _set_pose(motion, row, around) * np.abs(roots).min(initial=1.0) > _MISSED:
            taken.append(row)
    return ChangePointRows(tuple(unbounded) if len(speeds) else (), tuple(taken))


def _only_passes_near(roots: Reals, around: Reals) -> bool:
    """Whether a root that is small in a row has no zero there.

    In an exact change point a root is smooth, with the value that those around it give. Passed near by, it is like the
    square root of s^2 + m^2, which has a kink as seen from afar.
    """
    small = np.abs(roots) < _SINGULAR
    kept = around[0, small] * around[-1, small] > 0
    smooth = np.abs(_WEIGHTS @ around[:, small])
    return bool((kept & (smooth > _KINK * np.abs(around[:, small]).max(axis=0, initial=0.0))).any())


def _set_pose(motion: Motion, row: int, around: SolvedRows) -> float:
    """Put the limit of the poses if it is in less doubt than the pose that was found; how far they differ then, or 0.

    By how much the polynomial of degree 7 differs from that of degree 5 is more than its error. A pose that is off by
    rounding is so by some 1e-16 over the root; one of a linkage that misses the change point by m (in the root) by m^2
    over the root or more.
    """
    size = motion.plan.lower.size
    poses = np.array([around.places[0, 1:] / size, around.turns[1:]])
    limit, other = np.tensordot(poses, _WEIGHTS, (1, 0)), np.tensordot(poses, _FEWER_WEIGHTS, (1, 0))
    now = np.array([motion.places[0, row] / size, motion.turns[row]])
    off = float(np.abs(now - limit).max())
    if not off > _LEAST + _SURE * np.abs(other - limit).max():  # or there is no limit
        return 0.0
    places, turns = limit
    angles = angles_of_turns(motion.turns[row], motion.whole[row])
    motion.places[0, row] = places * size
    motion.turns[row] = turns / np.abs(turns)
    motion.whole[row] = whole_turns(angles, turns)
    return off


def _rows_around(
    plan: Plan, motion: Motion, path: Reals, speeds: Reals, begin: Callable[[], ReferencePose], row: int
) -> SolvedRows | None:
    """A row beside the change point, where the branch is known, and eight around it; None if one cannot be reached."""
    scale = np.array([1.0 if d.turning else plan.lower.size for d in plan.linkage.mechanism.drives])
    branching = plan.branching
    sound = np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0) > _SINGULAR
    sound &= (path != path[row]).any(axis=1)[: len(motion)]
    behind, before = np.flatnonzero(sound[row + 1 :]), np.flatnonzero(sound[:row])
    if len(behind) or len(before):
        k = row + 1 + int(behind[0]) if len(behind) else int(before[-1])
        start = ReferencePose(path[k], np.where(motion.roots[k] < 0, -1.0, 1.0), motion.unknowns[k])
    else:
        start = begin()
    towards = start.drives - path[row]
    velocity = speeds[0, row] if len(speeds) else towards
    if not velocity.any():  # at rest: any direction does
        velocity = scale
    length = float(np.abs(velocity / scale).max())
    side = -1.0 if float((towards / scale) @ (velocity / scale)) < 0 else 1.0
    around = path[row] + side * _OFFSETS[:, None] * _STEP * velocity / length
    around = np.concatenate([start.drives[None] if towards.any() else around[:1], around])
    still = np.repeat(speeds[:, row : row + 1], len(around), axis=1)
    rows = run_rows(plan, around, still, start.signs, start.unknowns)
    return rows if rows.reached == len(around) else None
