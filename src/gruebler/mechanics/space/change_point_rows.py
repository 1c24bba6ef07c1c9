"""Rows of a path that are change points themselves, where the conditions lose their rank: limits of both sides."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.space.closure import FollowedRows, Place
from gruebler.mechanics.space.following import Setting

_AT = 1e-5  # radians and sizes: a path that ends so near a row has met something in it
_STEP = 0.04  # radians and sizes of the drives: how far from such a row positions are taken to find that in it
_OFFSETS = np.array([-4.0, -3, -2, -1, 1, 2, 3, 4])
_WEIGHTS = np.array([-1, 8, -28, 56, 56, -28, 8, -1]) / 70  # of values at these offsets, for the value between them


class RowsThrough(NamedTuple):
    """Rows of a path, and which of them are change points."""

    rows: FollowedRows
    changes: tuple[int, ...]


def follow_through(set_up: Setting, values: Reals, rates: Reals) -> RowsThrough:
    """As `ClosingConditions.follow`, but going straight on in rows in which two assembly modes meet.

    Along a mode all quantities are analytic in the drives: in such a row they are those of the polynomial of degree 7
    through eight positions around it, on the line of the drives' velocity; relative error of the order of 1e-12 for
    motions that are smooth over 0.16 radians. Turns of balls are not interpolated: there the path ends.
    """
    around: dict[int, Reals] = {}
    followed = set_up.closure.follow(set_up.passive, set_up.drives, values, rates)
    while followed.end is not None and not set_up.closure.balls:
        row = _count(followed, around)
        if row in around or abs(followed.last.q[set_up.drives] - values[row]).max() > _AT:
            break
        before = values[row - 1] if row else np.zeros(values.shape[1])
        trial = around | {row: _eight(values, rates, row, before)}
        further = _followed(set_up, values, rates, trial)
        if len(further.derivatives) < _first_of(row, around) + len(_OFFSETS):
            break
        around, followed = trial, further
    if not around:
        return RowsThrough(followed, ())
    merged = _merged(set_up, followed, values, around)
    return RowsThrough(merged, tuple(sorted(row for row in around if row < len(merged.derivatives))))


def _eight(values: Reals, rates: Reals, row: int, before: Reals) -> Reals:
    """Drive values around a row, along the velocity there, in the order in which the path comes along."""
    towards = values[row] - before
    velocity = rates[0, row] if len(rates) and rates[0, row].any() else towards
    if not velocity.any():
        velocity = np.ones(values.shape[1])
    side = -1.0 if towards @ velocity < 0 else 1.0
    return np.asarray(values[row] + side * _OFFSETS[:, None] * _STEP * velocity / abs(velocity).max())


def _first_of(row: int, around: dict[int, Reals]) -> int:
    """Where a row begins in the path with eight rows for each that is a change point."""
    return row + sum(len(_OFFSETS) - 1 for other in around if other < row)


def _count(followed: FollowedRows, around: dict[int, Reals]) -> int:
    """How many rows of the path were reached."""
    reached = len(followed.derivatives)
    return reached - sum(min(len(_OFFSETS) - 1, max(reached - _first_of(row, around) - 1, 0)) for row in around)


def _followed(set_up: Setting, values: Reals, rates: Reals, around: dict[int, Reals]) -> FollowedRows:
    count = [len(_OFFSETS) if row in around else 1 for row in range(len(values))]
    path = np.concatenate([around.get(row, values[row : row + 1]) for row in range(len(values))])
    return set_up.closure.follow(set_up.passive, set_up.drives, path, np.repeat(rates, count, axis=1))


def _merged(set_up: Setting, followed: FollowedRows, values: Reals, around: dict[int, Reals]) -> FollowedRows:
    rows = _count(followed, around)
    starts = [_first_of(row, around) for row in range(rows)]
    series, poses = followed.series[:, starts].copy(), followed.poses[:, starts].copy()
    derivatives, gap = followed.derivatives[starts].copy(), followed.gap
    for row in around:
        if row >= rows:
            continue
        eight = slice(starts[row], starts[row] + len(_OFFSETS))
        series[:, row] = np.tensordot(followed.series[:, eight], _WEIGHTS, (1, 0))
        poses[:, row] = np.tensordot(followed.poses[:, eight], _WEIGHTS, (1, 0))
        turn = poses[0, row, :, :3, :3]
        poses[0, row, :, :3, :3] = 1.5 * turn - 0.5 * turn @ np.swapaxes(turn, -1, -2) @ turn
        place = Place(series[0, row], set_up.closure.reference.turns)
        opened, by_unknown = set_up.closure.linearised(place)
        derivatives[row], gap = by_unknown[:, set_up.passive], max(gap, float(abs(opened).max(initial=0.0)))
    at = [start + (len(_OFFSETS) - 1) * (row in around) for row, start in enumerate(starts)]
    return replace(
        followed,
        series=series,
        poses=poses,
        derivatives=derivatives,
        passed=[row for row in range(rows) if (starts[row] in followed.passed) != _comes_back(values, row, around)],
        end=None if followed.end is None else rows - 1 + (followed.end - at[-1] if rows else followed.end + 1),
        gap=gap,
    )


def _comes_back(values: Reals, row: int, around: dict[int, Reals]) -> bool:
    """Whether the path turns in the row before, a change point, so that this was passed once more on the way."""
    if row - 1 not in around:
        return False
    ahead = around[row - 1][-1] - around[row - 1][0]
    target = around[row][0] if row in around else values[row]
    return bool((target - values[row - 1]) @ ahead < 0)
