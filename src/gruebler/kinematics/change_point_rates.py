"""Rates in exact change points, where their linear equations fail: limits of the rates on both sides."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gruebler.arrays import Reals
from gruebler.kinematics.kernel_calls import run_rows
from gruebler.kinematics.motion import Motion
from gruebler.kinematics.plan import Plan

__all__ = ["set_change_point_rates"]

_SINGULAR = 1e-5  # below this root the linear equations of the rates lose too many digits
_STEP = 0.04  # radians (or part of the size): how far from a change point rates are taken to find those at it


def set_change_point_rates(plan: Plan, motion: Motion, path: Reals, speeds: Reals, signs: Reals) -> tuple[int, ...]:
    """Put the limits of the rates where the linkage passes an exact change point: the linear equations fail there.

    Along a branch the rates are analytic in the drive. They are found at eight places around the row and interpolated
    by a polynomial of degree 7: relative error of the order of 1e-12 for motions that are smooth over 0.16 radians.
    Returns the rows without finite limits (the drive stands at its limit); their rates are NaN.
    """
    branching = [dyad.number for dyad in plan.dyads if dyad.branching]
    small = np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0) < _SINGULAR
    broken = ~np.isfinite(motion.rates).all(axis=(0, 2))
    unbounded = []
    for row in np.flatnonzero(small | broken):
        found = _limit(plan, motion, path, speeds, signs, int(row))
        if found is not None:
            motion.places[1:, row], motion.rates[:, row] = found
        else:
            motion.places[1:, row] = motion.rates[:, row] = np.nan
            unbounded.append(int(row))
    return tuple(unbounded)


def _limit(
    plan: Plan, motion: Motion, path: Reals, speeds: Reals, signs: Reals, row: int
) -> tuple[NDArray[np.complex128], Reals] | None:
    way = speeds[0, row].copy()
    scale = np.array([1.0 if d.turning else plan.lower.size for d in plan.linkage.mechanism.drives])
    if not way.any():  # at rest: any direction does
        way = scale.copy()
    length = float(np.abs(way / scale).max())
    branching = [dyad.number for dyad in plan.dyads if dyad.branching]
    sound = (np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0) > _SINGULAR) & (path != path[row]).any(axis=1)[
        : len(motion)
    ]
    behind, before = np.flatnonzero(sound[row + 1 :]), np.flatnonzero(sound[:row])
    neighbour = row + 1 + int(behind[0]) if len(behind) else int(before[-1]) if len(before) else -1
    if neighbour >= 0:
        towards = path[neighbour] - path[row]
        state, unknowns = np.where(motion.roots[neighbour] < 0, -1.0, 1.0), motion.unknowns[neighbour]
        side = -1.0 if float((towards / scale) @ (way / scale)) < 0 else 1.0
    else:
        state, unknowns, side = signs, motion.unknowns[row], 1.0
    offsets = side * np.array([4, 3, 2, 1, -1, -2, -3, -4.0])
    around = path[row] + offsets[:, None] * _STEP * way / length
    beside = path[neighbour : neighbour + 1] if neighbour >= 0 else around[:1]
    around = np.concatenate([beside, around])
    still = np.repeat(speeds[:, row : row + 1], len(around), axis=1)
    rows = run_rows(plan.program, plan, around, still, len(speeds), state, unknowns)
    if rows.reached < len(around):
        return None
    weights = np.array([-1, 8, -28, 56, 56, -28, 8, -1]) / 70
    places = np.tensordot(weights, rows.places[1:, 1:], (0, 1))
    rates = np.tensordot(weights, rows.rates[:, 1:], (0, 1))
    return places, rates
