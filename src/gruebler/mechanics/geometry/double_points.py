"""Where a path meets itself: pairs of a polygon's sides first, then Newton's method on the two parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals, cross_product, scalar_product
from gruebler.mechanics.geometry.point_path import PointPath
from gruebler.mechanics.geometry.sampling import PathPolygon

_CLOSED = 1e-11  # sizes: two places that are nearer are one point
_TOUCH = 1e-9  # the same, and tangents parallel
_FLAT = 1e-5  # sine of the angle of the tangents: below it they touch
_APART = 1e-6  # of the parameter: nearer places are neighbours
_SAME = 1e-6
_ROUNDS = 25
_MOST_TOUCHES = 20  # more: the path is gone twice


@dataclass(frozen=True, slots=True)
class DoublePoint:
    """A point that the path passes twice."""

    drives: tuple[float, float]
    """The smaller first."""
    at: complex
    angle: float
    """The angle between the two tangents as lines, in radians from 0 to pi/2."""
    touching: bool
    """Whether both ways touch there."""


_Step = Callable[[Complexes, Complexes], tuple[Reals, Reals]]


class _Pairs(NamedTuple):
    """Two parameters of each candidate."""

    first: Reals
    second: Reals

    def pick(self, which: Flags) -> _Pairs:
        return _Pairs(self.first[which], self.second[which])


def double_points(point_path: PointPath, samples: PathPolygon, pad: float) -> tuple[DoublePoint, ...] | None:
    """The double points of a path; None if it is gone twice (everything is double).

    Args:
        point_path: the path.
        samples: its polygon.
        pad: by how much the polygon may be off.

    Two crossings nearer to one another than the polygon's tolerance may be taken for one, or for none; loops that lie
    within it may be missed. Error: of crossings some roundings by the sine of their angle; of touches the root of that.
    """
    near = _near_sides(samples, point_path.closed, pad)
    if not len(near.first):
        return ()
    crossing, crossed = _newton(point_path, near, _crossing_step)
    z, w = point_path.at(crossing.first, 1), point_path.at(crossing.second, 1)
    sine = np.abs(cross_product(z[1], w[1])) / np.maximum(np.abs(z[1] * w[1]), 1e-300)
    crossed &= (np.abs(z[0] - w[0]) <= _CLOSED * point_path.size) & (sine > _FLAT) & _apart(point_path, crossing)
    points = _double_points(point_path, crossing.pick(crossed), touching=False)
    rest = near.pick(~crossed)
    if len(rest.first):
        touch, touched = _newton(point_path, rest, _touching_step)
        gap = np.abs(point_path.at(touch.first, 0)[0] - point_path.at(touch.second, 0)[0])
        touched &= (gap <= _TOUCH * point_path.size) & _apart(point_path, touch)
        touches = _double_points(point_path, touch.pick(touched), touching=True)
        if len(touches) > _MOST_TOUCHES:
            return None
        points += [
            double_point
            for double_point in touches
            if not any(_equal(point_path, double_point.drives, other.drives) for other in points)
        ]
    return tuple(sorted(points, key=lambda double_point: double_point.drives))


# --- sides that come near to one another ---------------------------------------------------------------


def _near_sides(samples: PathPolygon, closed: bool, pad: float) -> _Pairs:
    """Pairs of sides, not neighbours, nearer than the pad; sweeping over x."""
    p, q = samples.points[:-1], samples.points[1:]
    low, high = np.minimum(p.real, q.real) - pad, np.maximum(p.real, q.real) + pad
    order = np.argsort(low)
    until = np.searchsorted(low[order], high[order], side="right")
    counts = np.maximum(until - np.arange(len(p)) - 1, 0)
    first = np.repeat(np.arange(len(p)), counts)
    offset = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    i, j = order[first], order[first + 1 + offset]
    bottom, top = np.minimum(p.imag, q.imag) - pad, np.maximum(p.imag, q.imag) + pad
    apart = np.abs(i - j)
    if closed:
        apart = np.minimum(apart, len(p) - apart)
    kept = (apart > 1) & (bottom[i] <= top[j]) & (bottom[j] <= top[i])
    i, j = i[kept], j[kept]
    gap, t, u = _between(p[i], q[i], p[j], q[j])
    kept = gap <= 2 * pad
    i, j, t, u = i[kept], j[kept], t[kept], u[kept]
    s, width = samples.parameters[:-1], np.diff(samples.parameters)
    return _Pairs(s[i] + t * width[i], s[j] + u * width[j])


def _between(p: Complexes, q: Complexes, a: Complexes, b: Complexes) -> tuple[Reals, Reals, Reals]:
    """The distance of sides pq and ab, and where on both it is."""
    first, second = q - p, b - a
    sine = cross_product(first, second)
    with np.errstate(divide="ignore", invalid="ignore"):
        t, u = cross_product(a - p, second) / sine, cross_product(a - p, first) / sine
    inside = (t >= 0) & (t <= 1) & (u >= 0) & (u <= 1)
    best = np.where(inside, 0.0, np.inf)
    t, u = np.where(inside, t, 0.0), np.where(inside, u, 0.0)
    for end, side, swap in ((p, 0.0, False), (q, 1.0, False), (a, 0.0, True), (b, 1.0, True)):
        start, segment = (p, first) if swap else (a, second)
        square = np.maximum(np.abs(segment) ** 2, 1e-300)
        foot = np.clip((np.conj(segment) * (end - start)).real / square, 0, 1)
        gap = np.abs(end - start - foot * segment)
        nearer = gap < best
        best = np.where(nearer, gap, best)
        t, u = np.where(nearer, foot if swap else side, t), np.where(nearer, side if swap else foot, u)
    return best, t, u


# --- Newton's method ------------------------------------------------------------------------------------


def _newton(point_path: PointPath, start: _Pairs, step: _Step) -> tuple[_Pairs, Flags]:
    """Where it arrives, and whether it has come to rest."""
    s, t = start.first.copy(), start.second.copy()
    still = np.zeros(len(s), bool)
    for _ in range(_ROUNDS):
        ds, dt = step(point_path.at(s, 2), point_path.at(t, 2))
        most = np.maximum(np.abs(ds), np.abs(dt))
        scale = np.minimum(1.0, 0.1 / np.maximum(most, 1e-300))
        s, t = _kept(point_path, s + scale * ds), _kept(point_path, t + scale * dt)
        still = most < 1e-11
        if still.all():
            break
    return _Pairs(s, t), still | (most < 1e-7)


def _crossing_step(z: Complexes, w: Complexes) -> tuple[Reals, Reals]:
    """Towards z(s) = w(t)."""
    sine = cross_product(z[1], w[1])
    sine = np.where(sine == 0, 1e-300, sine)
    gap = z[0] - w[0]
    return _finite(-cross_product(gap, w[1]) / sine), _finite(-cross_product(gap, z[1]) / sine)


def _touching_step(z: Complexes, w: Complexes) -> tuple[Reals, Reals]:
    """Towards parallel tangents and a gap at right angles to them."""
    gap = z[0] - w[0]
    f, g = scalar_product(gap, z[1]), cross_product(z[1], w[1])
    fs, ft = np.abs(z[1]) ** 2 + scalar_product(gap, z[2]), -scalar_product(w[1], z[1])
    gs, gt = cross_product(z[2], w[1]), cross_product(z[1], w[2])
    det = fs * gt - ft * gs
    det = np.where(det == 0, 1e-300, det)
    with np.errstate(over="ignore"):  # what has no bounds is no step
        return _finite(-(f * gt - g * ft) / det), _finite(-(fs * g - gs * f) / det)


def _finite(step: Reals) -> Reals:
    return np.clip(np.nan_to_num(step, posinf=1.0, neginf=-1.0), -1.0, 1.0)


def _kept(point_path: PointPath, s: Reals) -> Reals:
    """Within the path; of a closed one in its period."""
    if point_path.closed:
        return np.asarray(point_path.start + (s - point_path.start) % (point_path.end - point_path.start))
    return np.clip(s, point_path.start, point_path.end)


# --- what is told ---------------------------------------------------------------------------------------


def _apart(point_path: PointPath, pairs: _Pairs) -> Flags:
    gap = np.abs(pairs.first - pairs.second)
    if point_path.closed:
        gap = np.minimum(gap, point_path.end - point_path.start - gap)
    return np.asarray(gap > _APART)


def _double_points(point_path: PointPath, pairs: _Pairs, touching: bool) -> list[DoublePoint]:
    """Each once."""
    if not len(pairs.first):
        return []
    z, w = point_path.at(pairs.first, 1), point_path.at(pairs.second, 1)
    angle = np.abs(np.arctan2(cross_product(z[1], w[1]), scalar_product(z[1], w[1])))
    angle = np.minimum(angle, np.pi - angle)
    drives = np.sort(np.stack([point_path.drive(pairs.first), point_path.drive(pairs.second)]), axis=0)
    points: list[DoublePoint] = []
    for k in np.lexsort(drives[::-1]):
        both = (float(drives[0, k]), float(drives[1, k]))
        if not any(_equal(point_path, both, double_point.drives) for double_point in points):
            points.append(DoublePoint(both, complex(z[0, k]), float(angle[k]), touching))
    return points


def _equal(point_path: PointPath, first: tuple[float, float], second: tuple[float, float]) -> bool:
    """Whether two pairs of drive values are the same, also across the seam."""
    period = point_path.cycle.span.period

    def near(a: float, b: float) -> bool:
        gap = abs(a - b)
        return bool(min(gap, abs(period - gap)) < _SAME * 100)

    (a, b), (c, d) = first, second
    return (near(a, c) and near(b, d)) or (near(a, d) and near(b, c))
