"""A path as a polygon that stays near to it, its length and its area."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.geometry.point_path import PointPath
from gruebler.mechanics.linkages.quantities import as_positive

_FIRST = 64  # cells for each turn before any is halved
_LEVELS = 24
_FINEST = 1e-10  # of the reach: no tolerance below
_NODES = 8


class PathPolygon(NamedTuple):
    """Corners of the polygon."""

    parameters: Reals
    points: Complexes


def path_polygon(trail: PointPath, tolerance: float) -> PathPolygon:
    """Corners of a polygon, from the path's beginning to its end, no further from the path than the tolerance.

    A cell is halved where the cubic through its ends, with their tangents, leaves the chord by more; by how much the
    cubic misses the path in the middle counts as well.

    Raises `LinkageError` for a tolerance below 1e-10 of the reach of linkage and path, or above it.
    """
    bow = as_positive("tolerance", tolerance)
    if not _FINEST * trail.reach <= bow <= trail.reach:
        raise LinkageError(
            "the tolerance must lie between {finest:.3g} and {reach:.3g} for this path, but is {tolerance!r}",
            finest=_FINEST * trail.reach,
            reach=trail.reach,
            tolerance=tolerance,
        )
    turns = max(trail.cycle.span.turns, 1)
    s = np.linspace(trail.start, trail.end, _FIRST * turns + 1)
    z = trail.at(s, 1)
    suspect = np.ones(len(s) - 1, bool)
    for _ in range(_LEVELS):
        cells = np.flatnonzero(suspect)
        middles = (s[cells] + s[cells + 1]) / 2
        between = trail.at(middles, 1)
        bent = _bows(z[:, cells], z[:, cells + 1], between[0], np.diff(s)[cells]) > bow
        halved = cells[bent]
        if not len(halved):
            break
        suspect = np.zeros(len(s) - 1, bool)
        suspect[halved] = True
        parts = np.where(suspect, 2, 1)
        s = np.insert(s, halved + 1, middles[bent])
        z = np.insert(z, halved + 1, between[:, bent], axis=1)
        suspect = np.repeat(suspect, parts)
    return PathPolygon(s, z[0])


def _bows(left: Complexes, right: Complexes, middle: Complexes, width: Reals) -> Reals:
    """How far the path leaves the chord of each cell."""
    chord = right[0] - left[0]
    size = np.abs(chord)
    along = np.where(size > 0, chord / np.where(size > 0, size, 1), 0)
    bows = np.zeros(len(width))
    for part in (0.25, 0.5, 0.75):
        rest = 1 - part
        offset = part * part * (3 - 2 * part) * chord + part * rest * width * (rest * left[1] - part * right[1])
        away = np.where(size > 0, np.abs((np.conj(along) * offset).imag), np.abs(offset))
        bows = np.maximum(bows, away)
        if part == 0.5:
            miss = np.abs(left[0] + offset - middle)
    return np.asarray(bows + miss)


def path_length(point_path: PointPath, samples: PathPolygon, cusps: Reals) -> tuple[float, float]:
    """The length of a path, and about its error: Gauss's rule between corners and cusps, with 8 nodes and with 5."""
    corners = np.union1d(samples.parameters, cusps)
    whole, less = (_integral(point_path, corners, nodes, speed=True) for nodes in (_NODES, 5))
    return whole, abs(whole - less) + 1e-15 * whole


def path_area(point_path: PointPath, samples: PathPolygon) -> float:
    """The area that a closed path goes round, counter-clockwise positive; each part as often as round it."""
    return _integral(point_path, samples.parameters, _NODES, speed=False)


def _integral(point_path: PointPath, corners: Reals, count: int, speed: bool) -> float:
    nodes, weights = np.polynomial.legendre.leggauss(count)
    half = np.diff(corners)[:, None] / 2
    s = corners[:-1, None] + half * (1 + nodes)
    z, velocity = point_path.at(s.ravel(), 1)
    values = np.abs(velocity) if speed else (np.conj(z) * velocity).imag / 2
    return float((half * weights * values.reshape(s.shape)).sum())
