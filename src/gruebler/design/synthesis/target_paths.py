"""The way along a circuit through all targets: in order and without a limit of the drive, if there is one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.design.synthesis.ordered_matching import preferred
from gruebler.design.synthesis.ordered_places import Places
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.design.synthesis.target_places import Piece, TargetPlaces
from gruebler.mechanics.kinematics import Circuit

_LONGER = 1 + 1e-6
"""Times: a way is longer than another one, and not just found less exactly."""
_AT_LIMIT = 1e-6  # of the length, as far as targets are kept from limits


class TargetPath(NamedTuple):
    """A way along the circuit through all targets."""

    arcs: Reals
    """The arc of each target, monotonic if ``in_order``."""
    in_order: bool
    one_branch: bool
    error: float = np.nan
    """How far the farthest target is missed in order, relative to the size; NaN if no way in order is known."""


def path_through(
    course: Circuit, met: TargetPlaces, limit: float, *, in_order: bool = True, shortest: TargetOrder | None = None
) -> TargetPath:
    """The best way through the targets: in order and without a limit of the drive if there is one within a limit.

    Where there is none and the order is free, a way in another order without a limit of the drive is better. Where the
    shortest way is wanted, it is the best in any case; of it is told whether it keeps that order.
    """
    branches, whole = _branches(course), None if course.closed else (0.0, course.length)
    ways = [match for branch in branches if (match := met.in_order(branch)) is not None]
    best = preferred(ways, 1.0) if ways else None
    best = None if best is None or best.error > limit else best
    if shortest is not None and (free := _unordered(course, met.places, np.nan)).one_branch:
        lap = course.length if course.closed else np.inf
        free = free._replace(in_order=bool(shortest.kept_along(free.arcs[None], lap)[0]))
        if best is None or _travel(course, best.arcs) > _LONGER * _travel(course, free.arcs):
            return free
    if best is not None:
        return TargetPath(best.arcs, True, True, best.error)
    match = met.in_order(whole) if branches != [whole] else ways[0] if ways else None
    through = None
    if match is not None and match.error <= limit:
        through = TargetPath(match.arcs, True, False, match.error)
        if in_order:
            return through
    free = _unordered(course, met.places, np.nan if match is None else match.error)
    return free if free.one_branch or through is None else through


def place_on_branch(course: Circuit, path: TargetPath) -> float | None:
    """The arc from which a linkage goes through a path on one branch; None if it does from where it was followed.

    At a limit of the drive two branches meet, so that a position there does not tell on which of them the path lies.
    """
    if not course.drive_limits:
        return None
    near, middle = _AT_LIMIT * course.length, (path.arcs.min() + path.arcs.max()) / 2
    ends = [
        (piece.start - lap, piece.end - lap)
        for piece in course.monotone_pieces
        for lap in _laps(course)
        if piece.start <= middle + lap <= piece.end
    ]
    if any(low + near < course.start + lap < high - near for low, high in ends for lap in _laps(course)):
        return None
    low, high = ends[0]
    return float(np.clip(path.arcs[0], low + near, high - near))


def _laps(course: Circuit) -> tuple[float, ...]:
    return (-course.length, 0.0, course.length) if course.closed else (0.0,)


def _branches(course: Circuit) -> list[Piece]:
    """The pieces of the circuit between limits of the drive; None for all of a closed one."""
    if course.closed and not course.drive_limits:
        return [None]
    return [(piece.start, piece.end) for piece in course.monotone_pieces]


def _unordered(course: Circuit, places: Places, error: float) -> TargetPath:
    """The way through the targets in any order on which the drive travels least, without a limit of it if there is one.

    From each place of a target on to the next places of all others.
    """
    met, laps = places.best_of_each, _laps(course)
    starts = np.sort(np.concatenate(met))
    arcs = np.full((len(met), len(starts)), np.inf)
    for target, own in enumerate(met):
        there = np.append(np.sort(np.concatenate([own + lap for lap in laps])), np.inf)
        arcs[target] = there[np.searchsorted(there, starts)]
    low, high = starts, arcs.max(axis=0)
    starts, low, high, arcs = (part[..., np.isfinite(high)] for part in (starts, low, high, arcs))
    limits = np.array([extreme.at + lap for extreme in course.drive_limits for lap in laps])
    crosses = np.asarray(((limits[:, None] > low) & (limits[:, None] < high)).any(axis=0))
    travel = np.where(crosses, high - low, _travel(course, np.stack([low, high])))
    best = np.lexsort([np.round(travel, 9), crosses])[0]
    chosen = arcs[:, best]
    return TargetPath(
        chosen - (chosen[0] // course.length) * course.length * course.closed, False, not crosses[best], error
    )


def _travel(course: Circuit, arcs: Reals) -> Reals:
    """How far the drive goes between the first and the last of arcs, (targets, ...), without a limit of it between."""
    return np.abs(_drive_at(course, arcs.max(axis=0)) - _drive_at(course, arcs.min(axis=0)))


def _drive_at(course: Circuit, arcs: Reals) -> Reals:
    """The drive there between samples, to compare ways with; each lap goes on where the one before ended."""
    laps = np.floor(arcs / course.length) if course.closed else np.zeros_like(arcs)
    drive = course.drive
    return np.asarray(np.interp(arcs - laps * course.length, course.arcs, drive) + laps * (drive[-1] - drive[0]))
