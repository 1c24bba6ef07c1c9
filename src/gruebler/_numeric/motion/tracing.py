"""The curve of all positions of a linkage with one freedom, followed by pseudo-arclength continuation.

The unknowns are x, y and angle of each body, lengths in units of the linkage's size; no drive is imposed. Rows of the
Jacobian are orthonormalised, the longest remaining row first, so that a row that depends on others (a redundant
constraint, or one that is lost at a change point) is seen by its length and left out. docs/theory/circuits.md has the
theorems and tolerances.
"""

from __future__ import annotations

from math import asin, floor, pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.lanes import dot, give_back, subtract, taken
from gruebler._numeric.motion.closure import EQUATIONS, Conditions, closing
from gruebler._numeric.motion.newton import factor

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]

CLOSED, FULL, LONG, LOST, FLIP = range(5)
"""How `trace_curve` ended: back at the start; no room for more samples; at the longest length; no step succeeds; the
bordered determinant has changed its sign from the last sample to the one behind it, which is not counted yet."""

DEPENDENT = 1e-7  # a row shorter than this, after what it shares with others is taken away, depends on them
SHORTEST = 1e-10  # the shortest step
_AWAY = 1e-6  # no sample is taken where an independent row is shorter
_OPEN = 1e-11  # a sample is open by less
_BEND = 0.98  # the least cosine between the tangents of neighbouring samples
_SKEW = 0.02  # chord and mean tangent of a step differ by less
_SAME = 1e-8  # the curve is closed when it comes back as near as that
_CORRECTIONS = 12  # Newton's method arrives in 3 to 5; a row that is nearly dependent takes some more
_TORN = 1e3  # sizes: a residual that large comes of a pose that is lost
_ASTRAY = 1.0  # squared length of a step, in sizes and radians: it leads away from the curve
_ARRIVED = 1e-16  # squared length of a step: the next would be below rounding
_NO_TANGENT = 1e-6  # a direction of length 1 that keeps less in the null space has no part of it but rounding
_START_AHEAD = 1.2  # steps: the start is looked for a little farther than one step ahead
_START_ASIDE = 0.04  # squared, of the way to the start: how far it may lie aside of the tangent, 0.2
_BEFORE_START = 0.999  # of the way to the start: from there Newton's method has to arrive at it
_STRAIGHT = 1e-6  # half the difference of tangents: asin(x) = x below
_SHORTER, _LONGER = 0.6, 1.5  # the next step after one that failed, and after one that did not


class SampleBuffer(NamedTuple):
    """Samples, as many as there is room for."""

    arcs: Reals
    """(samples,) length from the first one."""
    poses: Reals
    """(samples, n)"""
    tangents: Reals
    """(samples, n) of length 1."""
    gauges: Reals
    """(samples,) the shortest independent row, with the sign of the bordered determinant if no row is redundant."""


class TraceScratch(NamedTuple):
    """Room to work in, for so many rows (equations, and one more) and n unknowns."""

    residual: Reals
    """(rows,)"""
    rows: Reals
    """(rows, n) the Jacobian, and the normal of a plane."""
    work: Reals
    """(rows, n) what is left of the rows after the basis is taken off."""
    shares: Reals
    """(rows, n) of the basis in each row."""
    basis: Reals
    """(n, n) orthonormal rows."""
    order: Ints
    """(rows,) from which row each of the basis was made."""
    free: Ints
    """(rows,) 1 for rows that have none in the basis yet."""
    trial: Reals
    """(n,) a pose."""
    normal: Reals
    """(n,) the normal of a plane, or the start as it is seen from a pose."""
    lengths: Reals
    """(rows,) squared, of what is left of the rows."""


def new_trace_scratch(c: Conditions) -> TraceScratch:
    """Room for m equations (and one more) and n unknowns."""
    m, n = sum(EQUATIONS[kind] for kind in c.kinds), 3 * (int(c.owners.max()) + 1)
    rows = max(m + 1, n)
    return TraceScratch(
        np.zeros(rows),
        np.zeros((rows, n)),
        np.zeros((rows, n)),
        np.zeros((rows, n)),
        np.zeros((n, n)),
        np.zeros(rows, np.int64),
        np.zeros(rows, np.int64),
        np.zeros(n),
        np.zeros(n),
        np.zeros(rows),
    )


@njit(error_model="numpy", forceinline=True, _nrt=False)
def _equations(kinds: Ints) -> int:
    m = 0
    for kind in kinds:
        m += 2 if kind <= 1 else 1
    return m


@njit(error_model="numpy", cache=True, _nrt=False)
def _reduce(count: int, n: int, first: int, s: TraceScratch) -> int:
    """Orthonormalise the rows, the longest remaining one first, after ``first`` if that is not -1; returns the rank.

    row order[j] = sum of shares[order[j], i] basis[i] over i <= j.
    """
    for i in range(count):
        s.free[i] = 1
        for k in range(n):
            s.work[i, k] = s.rows[i, k]
    work, basis, shares, free, lengths = taken(s.work), taken(s.basis), taken(s.shares), taken(s.free), taken(s.lengths)
    rank = min(count, n)
    for i in range(count):
        lengths[i] = dot(work[i], work[i])
    for j in range(rank):
        best, longest = -1, DEPENDENT * DEPENDENT
        for i in range(count):
            if free[i] == 1 and (j > 0 or first < 0 or i == first) and lengths[i] > longest:
                best, longest = i, lengths[i]
        if best < 0:
            rank = j
            break
        free[best], s.order[j] = 0, best
        row = work[best]
        for i in range(j):  # a second time: rows that are nearly dependent have lost digits
            share = dot(row, basis[i])
            shares[best][i] += share
            subtract(row, share, basis[i])
        length = sqrt(dot(row, row))
        shares[best][j] = length
        for k in range(n):
            basis[j][k] = row[k] / length
        for i in range(count):
            if free[i] == 1:
                share = dot(work[i], basis[j])
                shares[i][j] = share
                if share != 0:
                    subtract(work[i], share, basis[j])
                    lengths[i] = dot(work[i], work[i])
    give_back(s.basis, basis)
    give_back(s.shares, shares)
    return rank


@njit(error_model="numpy", cache=True, _nrt=False)
def _correct(c: Conditions, x: Reals, normal: Reals, level: float, in_plane: bool, s: TraceScratch) -> bool:
    """Newton's method in place: onto the curve by shortest steps, or in the plane ``normal @ x = level``."""
    m, n = _equations(c.kinds), len(x)
    for _ in range(_CORRECTIONS):
        miss = closing(c, x, s.residual, s.rows)
        if not miss < _TORN:
            return False
        count = m
        if in_plane:
            count = m + 1
            s.residual[m] = -level
            for k in range(n):
                s.rows[m, k] = normal[k]
                s.residual[m] += normal[k] * x[k]
        rank = _reduce(count, n, m if in_plane else -1, s)
        moved = 0.0
        for j in range(rank):
            row = s.order[j]
            share = s.residual[row]
            for i in range(j):
                share -= s.shares[row, i] * s.residual[s.order[i]]
            share /= s.shares[row, j]
            s.residual[row] = share
            moved += share * share
            for k in range(n):
                x[k] -= share * s.basis[j, k]
        if not moved < _ASTRAY:
            return False
        if moved < _ARRIVED:
            return True
    return False


@njit(error_model="numpy", cache=True, _nrt=False)
def _set_tangent(c: Conditions, x: Reals, tangent: Reals, s: TraceScratch) -> tuple[float, float, int]:
    """Turn a direction into the tangent: its part in the null space of the Jacobian, of length 1.

    Returns how far the joints are open, the gauge (`SampleBuffer`) and the rank.
    """
    m, n = _equations(c.kinds), len(x)
    miss = closing(c, x, s.residual, s.rows)
    rank = _reduce(m, n, -1, s)
    for _ in range(2):
        for j in range(rank):
            share = 0.0
            for k in range(n):
                share += tangent[k] * s.basis[j, k]
            for k in range(n):
                tangent[k] -= share * s.basis[j, k]
    length = 0.0
    for k in range(n):
        length += tangent[k] * tangent[k]
    length = sqrt(length)
    if not length > _NO_TANGENT or rank == 0:
        return np.inf, 0.0, rank
    for k in range(n):
        tangent[k] /= length
    gauge = s.shares[s.order[rank - 1], rank - 1]
    if m == n - 1:
        for k in range(n):
            s.rows[m, k] = tangent[k]
        if factor(s.rows, n, s.order) < 0:
            gauge = -gauge
    return miss, gauge, rank


@njit(error_model="numpy", cache=True, _nrt=False)
def settle_on_curve(c: Conditions, x: Reals, tangent: Reals, s: TraceScratch) -> tuple[bool, float, float, int]:
    """Put a pose on the curve, by the nearest way, and a direction along it; both are changed in place.

    Returns whether it arrived, how far the joints are open, the gauge and the rank of the Jacobian there.
    """
    arrived = _correct(c, x, tangent, 0.0, False, s)
    miss, gauge, rank = _set_tangent(c, x, tangent, s)
    return arrived, miss, gauge, rank


@njit(error_model="numpy", cache=True, _nrt=False)
def jacobian(c: Conditions, x: Reals, s: TraceScratch) -> int:
    """Write residual and Jacobian into the scratch; returns how many equations there are."""
    closing(c, x, s.residual, s.rows)
    return _equations(c.kinds)


@njit(error_model="numpy", cache=True, _nrt=False)
def _start_ahead(curve: SampleBuffer, k: int, step: float, s: TraceScratch) -> bool:
    """Whether the start lies one step ahead of sample k; writes it, turned on by whole turns, into ``s.normal``."""
    here, tangent, n = curve.poses[k], curve.tangents[k], len(s.trial)
    along = same = 0.0
    for i in range(n):
        gap = curve.poses[0, i] - here[i]
        if i % 3 == 2:
            gap -= 2 * pi * floor(gap / (2 * pi) + 0.5)
        s.normal[i] = gap
        along += gap * tangent[i]
        same += curve.tangents[0, i] * tangent[i]
    if not (0 < along <= _START_AHEAD * step and same > _BEND):
        return False
    aside = 0.0
    for i in range(n):
        off = s.normal[i] - along * tangent[i]
        aside += off * off
        s.normal[i] += here[i]
    return aside < _START_ASIDE * along * along


@njit(error_model="numpy", cache=True, _nrt=False)
def _attempt(c: Conditions, curve: SampleBuffer, k: int, step: float, s: TraceScratch) -> tuple[bool, bool]:
    """Write sample k + 1, one step on or at the start; returns whether it is good, and whether it is the start."""
    n = len(s.trial)
    before, here, after = curve.poses[max(k - 1, 0)], curve.poses[k], curve.poses[k + 1]
    old, tangent, new = curve.tangents[max(k - 1, 0)], curve.tangents[k], curve.tangents[k + 1]
    level = past = 0.0
    for i in range(n):
        past += (here[i] - before[i]) ** 2
    bend = 0.0 if k == 0 else step * step / 2 / sqrt(past)
    for i in range(n):
        s.trial[i] = here[i] + step * tangent[i] + bend * (tangent[i] - old[i])
        level += tangent[i] * s.trial[i]
    back = _start_ahead(curve, k, step, s)
    if back:
        level = 0.0
        for i in range(n):
            after[i] = s.normal[i]
            level += curve.tangents[0, i] * after[i]
            s.trial[i] = here[i] + (after[i] - here[i]) * _BEFORE_START
        back = _correct(c, s.trial, curve.tangents[0], level, True, s)
        for i in range(n):
            back = back and abs(s.trial[i] - after[i]) < _SAME
    if not back and not _correct(c, s.trial, tangent, level, True, s):
        return False, False
    for i in range(n):
        if not back:
            after[i] = s.trial[i]
        new[i] = curve.tangents[0, i] if back else tangent[i]
    miss, gauge, rank = _set_tangent(c, after, new, s)
    curve.gauges[k + 1] = gauge
    if not (miss < _OPEN and rank == n - 1 and abs(gauge) > _AWAY):
        return False, False
    cosine = chord = mean = skew = turned = 0.0
    for i in range(n):
        cosine += new[i] * tangent[i]
        chord += (after[i] - here[i]) ** 2
        mean += (new[i] + tangent[i]) ** 2
        turned += (new[i] - tangent[i]) ** 2
    chord, mean = sqrt(chord), sqrt(mean)
    for i in range(n):
        skew += ((after[i] - here[i]) / chord - (new[i] + tangent[i]) / mean) ** 2
    if not (cosine > _BEND and skew < _SKEW * _SKEW and chord < 2 * step):
        return False, False
    half = sqrt(turned) / 2
    curve.arcs[k + 1] = curve.arcs[k] + chord * (asin(half) / half if half > _STRAIGHT else 1.0)
    return True, back


@njit(error_model="numpy", cache=True, _nrt=False)
def trace_curve(
    c: Conditions, curve: SampleBuffer, count: int, step: float, longest: float, most: float, s: TraceScratch
) -> tuple[int, int, float]:
    """Follow the curve from the last of ``count`` samples until something happens.

    Args:
        c: the closing conditions.
        curve: the samples, written.
        count: how many there are.
        step: the first step to try.
        longest: the longest step.
        most: the length at which to end.
        s: room to work in.

    Returns what happened, how many samples there are now, and the step.
    """
    while True:
        k = count - 1
        if count == len(curve.arcs):
            return FULL, count, step
        if curve.arcs[k] >= most:
            return LONG, count, step
        good, back = _attempt(c, curve, k, step, s)
        if not good:
            step *= _SHORTER
            if step < SHORTEST:
                return LOST, count, step
            continue
        if curve.gauges[k] * curve.gauges[k + 1] < 0:
            return FLIP, count, step
        count += 1
        if back:
            return CLOSED, count, step
        step = min(_LONGER * step, longest)


@njit(error_model="numpy", cache=True, _nrt=False)
def evaluate_pose(
    c: Conditions, curve: SampleBuffer, at: Reals, segments: Ints, poses: Reals, tangents: Reals, s: TraceScratch
) -> int:
    """Poses and tangents at given lengths, each between samples k and k + 1; returns how many were found.

    A cubic through both samples predicts the pose; Newton's method puts it on the curve in the plane across the chord.
    """
    n = poses.shape[1]
    for row in range(len(at)):
        k = segments[row]
        long = curve.arcs[k + 1] - curve.arcs[k]
        u = (at[row] - curve.arcs[k]) / long
        chord = level = 0.0
        for i in range(n):
            start, end = curve.poses[k, i], curve.poses[k + 1, i]
            leave, arrive = long * curve.tangents[k, i], long * curve.tangents[k + 1, i]
            change = end - start
            bent, skewed = 3 * change - 2 * leave - arrive, leave + arrive - 2 * change
            poses[row, i] = start + u * (leave + u * (bent + u * skewed))
            tangents[row, i] = (leave + u * (2 * bent + 3 * u * skewed)) / long
            s.normal[i] = change
            chord += change * change
        chord = sqrt(chord)
        for i in range(n):
            s.normal[i] /= chord
            level += s.normal[i] * poses[row, i]
        if not _correct(c, poses[row], s.normal, level, True, s):
            return row
        miss, _, _ = _set_tangent(c, poses[row], tangents[row], s)
        if not miss < _OPEN:
            return row
    return len(at)
