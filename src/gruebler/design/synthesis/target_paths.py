"""The way along a circuit through all targets: in order and without a limit of the drive, if there is one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.design.synthesis.ordered_matching import Places, preferred
from gruebler.design.synthesis.target_places import Piece, TargetPlaces
from gruebler.mechanics.kinematics import Circuit


class TargetPath(NamedTuple):
    """A way along the circuit through all targets."""

    arcs: Reals
    """The arc of each target, monotonic if ``in_order``."""
    in_order: bool
    one_branch: bool
    error: float = np.nan
    """How far the farthest target is missed in order, relative to the size; NaN if no way in order is known."""


def path_through(course: Circuit, met: TargetPlaces, limit: float) -> TargetPath:
    """The best way through the targets: in order and without a limit of the drive if there is one within a limit."""
    branches, whole = _branches(course), None if course.closed else (0.0, course.length)
    ways = [match for branch in branches if (match := met.in_order(branch)) is not None]
    if ways and (best := preferred(ways, 1.0)).error <= limit:
        return TargetPath(best.arcs, True, True, best.error)
    match = met.in_order(whole) if branches != [whole] else ways[0] if ways else None
    if match is not None and match.error <= limit:
        return TargetPath(match.arcs, True, False, match.error)
    return _unordered(course, met.places, np.nan if match is None else match.error)


def limit_before(course: Circuit, arc: float) -> bool:
    """Whether a limit of the drive lies between the position that a circuit was followed from and a place of it."""
    inside = [
        piece.start <= start <= piece.end
        for piece in course.monotone_pieces
        if any(piece.start <= arc + lap <= piece.end for lap in _laps(course))
        for start in (course.start + lap for lap in _laps(course))
    ]
    return bool(course.drive_limits) and not any(inside)


def _laps(course: Circuit) -> tuple[float, ...]:
    return (-course.length, 0.0, course.length) if course.closed else (0.0,)


def _branches(course: Circuit) -> list[Piece]:
    """The pieces of the circuit between limits of the drive; None for all of a closed one."""
    if course.closed and not course.drive_limits:
        return [None]
    return [(piece.start, piece.end) for piece in course.monotone_pieces]


def _unordered(course: Circuit, places: Places, error: float) -> TargetPath:
    """The shortest way through the targets in any order, without a limit of the drive if there is one."""
    limits = np.array([extreme.at for extreme in course.drive_limits])
    laps = (-1, 0, 1) if course.closed else (0,)
    met = places.best_of_each
    ways = []
    for start in met[0]:
        arcs = _nearest(course, met, float(start), limits)
        low, high = arcs.min(), arcs.max()
        free = all(not ((limits + k * course.length > low) & (limits + k * course.length < high)).any() for k in laps)
        ways.append((not free, float(high - low), arcs))
    crosses, _, arcs = min(ways, key=lambda each: each[:2])
    return TargetPath(arcs, False, not crosses, error)


def _nearest(course: Circuit, met: list[Reals], start: float, limits: Reals) -> Reals:
    """An arc of each target without order: on the branch of the start if possible."""
    low, high = -np.inf, np.inf
    shifted = np.concatenate([limits + k * course.length for k in ((-1, 0, 1) if course.closed else (0,))])
    if len(shifted):
        low = max([v for v in shifted if v <= start], default=-np.inf)
        high = min([v for v in shifted if v > start], default=np.inf)
    chosen_arcs = [start]
    for arcs in met[1:]:
        laps = (-1, 0, 1) if course.closed else (0,)
        all_arcs = np.concatenate([arcs + k * course.length for k in laps])
        within = all_arcs[(all_arcs >= low) & (all_arcs <= high)]
        chosen = within if len(within) else all_arcs
        chosen_arcs.append(float(chosen[np.argmin(np.abs(chosen - start))]))
    return np.array(chosen_arcs)
