"""Cusps, inflections, vertices and turning points of a path, as roots of exact functions of its derivatives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Reals, cross_product, scalar_product
from gruebler.base.errors import LinkageError
from gruebler.mechanics.geometry.point_path import PointPath
from gruebler.mechanics.geometry.series import taylor_series
from gruebler.mechanics.kinematics.root_finding import Zero, find_zeros
from gruebler.mechanics.linkages.quantities import as_finite

_STILL = 1e-8  # of the usual velocity: slower, in the minimum, the point stands still
_PARALLEL = 1e-7  # sine of the angle between the second and the third derivative in a cusp
_BESIDE = np.array([0.02, 0.03, 0.05])  # of the parameter: places from which a path is looked for on its other side
_BACK = 1e-9  # sizes: so near it is then
_NEAR = 1e-3  # of the parameter: zeros nearer to a cusp are its own
_ORDER = 9  # of the series by which multiple inflections are settled
_MANIFOLD = 1e-8  # coefficients of the bend, by its natural size, that are zero in a multiple one
_LEAST = 1e-9  # a function that is hardly ever larger than that, by its natural size, is zero


@dataclass(frozen=True, slots=True, kw_only=True)
class Cusp:
    """Where the point stands still."""

    drive: float
    at: complex
    direction: float
    """The angle of the tangent, the way in which the point leaves; in radians."""
    flat: bool
    """The third derivative lies in the tangent too: the point goes back on the side it came from, or on its own way
    (the pin of a rocker in a dead centre)."""
    parameter: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Inflection:
    """Where the curvature is zero."""

    drive: float
    at: complex
    direction: float
    """The angle of the tangent in radians."""
    points: int
    """How many points path and tangent have in common there: 3 ordinarily, 6 in a six-point contact."""
    parameter: float

    @property
    def flat(self) -> bool:
        """Whether the curvature does not change its sign: the tangent touches with 4 or 6 points."""
        return self.points % 2 == 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Vertex:
    """Where the curvature is extreme: a circle touches with four points or more."""

    drive: float
    at: complex
    curvature: float
    """1/radius, positive where the path bends to the left."""
    kind: str
    """``maximum`` or ``minimum`` of the signed curvature."""
    parameter: float


@dataclass(frozen=True, slots=True)
class TurningPoint:
    """Where the path goes farthest in a direction, locally."""

    drive: float
    at: complex
    kind: str
    """``maximum`` or ``minimum``; ``flat``: it only pauses."""
    parameter: float


def cusps(point_path: PointPath) -> tuple[Cusp, ...]:
    """Where the velocity is zero, found as roots of its square's derivative: error of some roundings.

    >>> from gruebler.mechanics.geometry.point_path import point_path
    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> [round(found.drive, 9) for found in cusps(point_path(SliderCrank(2, 5).linkage(), "R(coupler-slider)"))]
    [0.0, 3.141592654]
    """

    def slowing(s: Reals) -> Reals:
        _, v, a, j = point_path.at(s)
        return np.stack([scalar_product(v, a), np.abs(a) ** 2 + scalar_product(v, j)])

    usual = _usual(point_path)
    zeros = find_zeros(slowing, point_path.grid, _LEAST * usual**2)
    cusps = []
    for zero, z in _seen(point_path, zeros):
        if abs(z[1]) <= _STILL * usual:
            sine = abs(cross_product(z[2], z[3])) / (abs(z[2]) * max(abs(z[3]), abs(z[2])) or 1.0)
            cusps.append(
                Cusp(
                    drive=_drive(point_path, zero),
                    at=z[0],
                    direction=float(np.angle(z[2])),
                    flat=bool(sine <= _PARALLEL),
                    parameter=zero.at,
                )
            )
    return tuple(sorted(cusps, key=lambda cusp: cusp.drive))


def goes_back(point_path: PointPath, cusp: Cusp) -> bool:
    """Whether the point goes back on its own way from a cusp: feet of perpendiculars onto the other side."""
    before, behind = point_path.at(cusp.parameter - _BESIDE, 0)[0], cusp.parameter + _BESIDE
    for _ in range(20):
        z, v, a = point_path.at(behind, 2)
        slope = np.abs(v) ** 2 + scalar_product(z - before, a)
        behind = behind - np.clip(scalar_product(z - before, v) / np.where(slope == 0, 1e-300, slope), -0.01, 0.01)
    return bool((np.abs(point_path.at(behind, 0)[0] - before) <= _BACK * point_path.size).all())


def inflections(point_path: PointPath, known: tuple[Cusp, ...]) -> tuple[Inflection, ...]:
    """Zeros of Im(conj(z') z''), multiple ones settled by the Taylor series; none of a straight path."""

    def bend(s: Reals) -> Reals:
        _, v, a, j = point_path.at(s)
        return np.stack([cross_product(v, a), cross_product(v, j)])

    zeros = _away(point_path, find_zeros(bend, point_path.grid, _LEAST * _usual(point_path) ** 2), known)
    settled = tuple(_settled(point_path, zero) for zero in zeros)
    events = [
        Inflection(
            drive=_drive(point_path, zero),
            at=z[0],
            direction=float(np.angle(z[1])),
            points=zero.multiplicity + 2,
            parameter=zero.at,
        )
        for zero, z in _seen(point_path, settled)
    ]
    return tuple(sorted(events, key=lambda event: event.drive))


def _settled(point_path: PointPath, zero: Zero) -> Zero:
    """The zero of the bend with its true multiplicity m: in the middle of m close ones, -g_(m-1)/(m g_m) from here."""
    try:
        drive, g = float(point_path.drive(np.array([zero.at]))[0]), _bend_series(point_path, zero.at)
        for m in range(6, 1, -1):
            step = -g[m - 1] / (m * g[m]) if g[m] else 1.0
            if abs(step) < _NEAR and (m - zero.multiplicity) % 2 == 0:
                at = point_path.parameter(drive + step, zero.at)
                there = np.abs(_bend_series(point_path, at))
                if there[:m].max() <= _MANIFOLD and there[m] > 1e3 * _MANIFOLD:
                    return Zero(at, m, zero.rises)
    except LinkageError:  # no series: a change point
        pass
    return zero


def _bend_series(point_path: PointPath, s: float) -> Reals:
    """Coefficients of Im(conj(z') z'') by the drive, in its natural size |z'| (|z'| + |z''|)."""
    z = taylor_series(point_path.cycle.at(point_path.drive(np.array([s])), 0), _ORDER).complex_point(point_path.place)[
        :, 0
    ]
    v = np.polynomial.polynomial.polyder(z)
    a = np.polynomial.polynomial.polyder(v)
    return np.asarray(np.convolve(np.conj(v), a).imag[: _ORDER - 1] / (abs(v[0]) * (abs(v[0]) + abs(a[0]))))


def vertices(point_path: PointPath, known: tuple[Cusp, ...], flat: tuple[Inflection, ...] = ()) -> tuple[Vertex, ...]:
    """Sign changes of the curvature's derivative, flat inflections among them; none of a circle or a straight line."""

    def change(s: Reals) -> Reals:
        _, v, a, j = point_path.at(s)
        return np.stack([np.abs(v) ** 2 * cross_product(v, j) - 3 * cross_product(v, a) * scalar_product(v, a)])

    _, v, a, j = point_path.at(point_path.grid)
    natural = float(np.median(np.abs(v) ** 2 * (np.abs(v) * np.abs(j) + 3 * np.abs(a) ** 2)))
    zeros = _away(point_path, find_zeros(change, point_path.grid, _LEAST * natural), known)
    zeros = tuple(zero._replace(at=_nearest(zero.at, flat)) for zero in zeros)
    events = [
        Vertex(
            drive=_drive(point_path, zero),
            at=z[0],
            curvature=float(cross_product(z[1], z[2]) / abs(z[1]) ** 3),
            kind="minimum" if zero.rises else "maximum",
            parameter=zero.at,
        )
        for zero, z in _seen(point_path, zeros)
    ]
    return tuple(sorted(events, key=lambda event: event.drive))


def _nearest(at: float, flat: tuple[Inflection, ...]) -> float:
    """The flat inflection that this place is, exactly."""
    return next(
        (inflection.parameter for inflection in flat if inflection.flat and abs(inflection.parameter - at) < _NEAR), at
    )


def turning_points(point_path: PointPath, direction: float = 0.0) -> tuple[TurningPoint, ...]:
    """Where the path turns back along a direction (radians; 0: in x, pi/2: in y)."""
    turn = np.exp(-1j * as_finite("direction", direction))

    def along(s: Reals) -> Reals:
        return np.asarray((point_path.at(s)[1:] * turn).real)

    zeros = find_zeros(along, point_path.grid, _LEAST * _usual(point_path))
    kinds = {(1, True): "minimum", (1, False): "maximum", (3, True): "minimum", (3, False): "maximum"}
    events = [
        TurningPoint(_drive(point_path, zero), z[0], kinds.get((zero.multiplicity, zero.rises), "flat"), zero.at)
        for zero, z in _seen(point_path, zeros)
    ]
    return tuple(sorted(events, key=lambda event: event.drive))


def _usual(point_path: PointPath) -> float:
    """The usual velocity of the point."""
    return max(float(np.median(np.abs(point_path.at(point_path.grid, 1)[1]))), 1e-12 * point_path.size)


def _seen(point_path: PointPath, zeros: tuple[Zero, ...]) -> list[tuple[Zero, list[complex]]]:
    """Zeros with the point and its derivatives there."""
    if not zeros:
        return []
    z = point_path.at(np.array([zero.at for zero in zeros]))
    return [(zero, [complex(value) for value in z[:, k]]) for k, zero in enumerate(zeros)]


def _away(point_path: PointPath, zeros: tuple[Zero, ...], known: tuple[Cusp, ...]) -> tuple[Zero, ...]:
    period = point_path.end - point_path.start

    def near(zero: Zero, cusp: Cusp) -> bool:
        gap = abs(zero.at - cusp.parameter)
        return min(gap, period - gap if point_path.closed else gap) < _NEAR

    return tuple(zero for zero in zeros if not any(near(zero, cusp) for cusp in known))


def _drive(point_path: PointPath, zero: Zero) -> float:
    value = float(point_path.drive(np.array([zero.at]))[0])
    return point_path.cycle.span.wrapped(value)
