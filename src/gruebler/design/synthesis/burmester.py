"""Burmester's curves: the pivots of all dyads that guide a body through four positions, traced completely.

The circle-point curve (pivots on the body) and the centre-point curve (on the frame) are cubics. Each is seen from a
point of itself: a line through that point meets the cubic in two others, the roots of a quadratic, and the directions
in which they are real end at the roots of a quartic. So no part of the curve is missed. See
docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis.dyads import (
    CRANK,
    Displacements,
    GuidingDyad,
    circle_point_cubics,
    misfit,
    sliding_dyads,
)
from gruebler.design.synthesis.tasks import PositionTask

_STEPS = 30  # along a curve to the point nearest to a place
_LONGEST = 0.05  # of the pivots' distances: the longest of these steps
_NOTHING = 1e-13  # a cubic whose coefficients are all smaller is no condition


class CurvePiece(NamedTuple):
    """A connected piece of both curves, point by point: pivots that belong together."""

    moving: Complexes
    """(points,) pivots on the body, where they lie in the first position."""
    fixed: Complexes
    """(points,) pivots on the frame; far away where the dyad is nearly a slide."""


@dataclass(frozen=True)
class BurmesterCurves:
    """The dyads of four positions: a one-parameter family of RR dyads, and single PR and RP dyads."""

    task: PositionTask
    pieces: tuple[CurvePiece, ...]
    sliding: tuple[GuidingDyad, ...]

    def dyads(self, number: int, region: tuple[float, float, float, float] | None = None) -> tuple[GuidingDyad, ...]:
        """So many RR dyads spread over the pieces, and the sliding ones.

        Those are left out whose pivots lie further away than 30 sizes of the task, and those whose fixed pivots lie
        outside the region, if the curve passes through it.
        """
        origin, size = complex(*self.task.positions[0][:2]), self.task.size
        moving = np.concatenate([piece.moving for piece in self.pieces])
        fixed = np.concatenate([piece.fixed for piece in self.pieces])
        near = (np.abs(moving - origin) < 30 * size) & (np.abs(fixed - origin) < 30 * size)
        apart = np.abs(moving - fixed) > 1e-6 * size
        chosen = np.flatnonzero(near & apart)
        if region is not None:
            x, y = fixed[chosen].real, fixed[chosen].imag
            inside = (region[0] <= x) & (x <= region[2]) & (region[1] <= y) & (y <= region[3])
            chosen = chosen[inside] if inside.any() else chosen
        chosen = chosen[np.unique(np.linspace(0, len(chosen) - 1, min(number, len(chosen))).astype(int))]
        # A closed piece ends in its first point.
        given, *_ = Displacements.of(self.task.origins, self.task.turns)
        exact = (_sharpened(given, *(complex(side[k]) for side in self._points)) for k in chosen)
        return (*dict.fromkeys(dyad.moved(size, origin) for dyad in exact), *self.sliding)

    @cached_property
    def _points(self) -> CurvePiece:
        """All pieces one after the other, in units of the task's size about the first origin."""
        origin, size = self._unit
        moving, fixed = (np.concatenate(side) for side in zip(*self.pieces, strict=True))
        return CurvePiece((moving - origin) / size, (fixed - origin) / size)

    @property
    def _unit(self) -> tuple[complex, float]:
        return complex(*self.task.positions[0][:2]), self.task.size

    def nearest(self, pivot: complex, *, fixed: bool = False) -> GuidingDyad:
        """The dyad whose pivot on the body, or on the frame, is nearest to a place, exact. Cost: 1 ms."""
        origin, size = self._unit
        side, target = int(fixed), (pivot - origin) / size
        k = int(np.argmin(np.abs(self._points[side] - target)))
        displacements, *_ = Displacements.of(self.task.origins, self.task.turns)
        pivots = complex(self._points.moving[k]), complex(self._points.fixed[k])
        return _nearest_dyad(displacements, *pivots, target, side).moved(size, origin)

    def parameters(self) -> list[Reals]:
        """Of each piece where its points lie along the circle-point curve: from 0 to 1 through all pieces.

        The curve is measured on a sphere (stereographically, about the first origin, the radius half the task's size),
        where it has a finite length.
        """
        origin, size = self._unit
        lengths = []
        for piece in self.pieces:
            z = (piece.moving - origin) / size
            near = np.sqrt(1 + np.abs(z) ** 2)
            steps = np.abs(np.diff(z)) / (near[:-1] * near[1:])  # the chord on the sphere
            lengths.append(np.concatenate([[0.0], np.cumsum(steps)]))
        ends = np.cumsum([0.0, *(length[-1] for length in lengths)])
        return [(length + begin) / ends[-1] for length, begin in zip(lengths, ends[:-1], strict=True)]

    def at(self, parameter: float) -> GuidingDyad:
        """The dyad at a place along the circle-point curve, from 0 to 1; exact.

        Raises `SynthesisError` for another number.
        """
        if not 0 <= parameter <= 1:
            raise SynthesisError(
                "a place along the circle-point curve: expected 0 to 1, but found {found:g}", found=parameter
            )
        places = np.concatenate(self.parameters())
        after = int(np.clip(np.searchsorted(places, parameter), 1, len(places) - 1))
        width = float(places[after] - places[after - 1])
        share = (parameter - float(places[after - 1])) / width if width > 0 else 0.0
        x, m = (complex((1 - share) * side[after - 1] + share * side[after]) for side in self._points)
        origin, size = self._unit
        displacements, *_ = Displacements.of(self.task.origins, self.task.turns)
        return _sharpened(displacements, x, m).moved(size, origin)


def burmester_curves(task: PositionTask, points: int = 400) -> BurmesterCurves:
    """Both curves of four positions, with about so many points. Cost: about 3 ms.

    Raises `SynthesisError` for another number of positions, and where every point of the body is a pivot.
    """
    if len(task) != 4:
        raise SynthesisError("Burmester's curves belong to four positions, not to {count}", count=len(task))
    displacements, origin, size = Displacements.of(task.origins, task.turns)
    cubic = circle_point_cubics(displacements)[0]
    if np.abs(cubic).max() < _NOTHING:
        raise SynthesisError(
            "every point of the body can be a pivot: the four positions belong to a rotation, a translation or "
            "repeat one another"
        )
    real = _real_cubic(cubic)
    pieces = []
    for curve in _traced(real, _known_point(displacements, real), points):
        fixed, good = _centres(displacements, curve)
        for part in _runs(good):
            moving = curve[part]
            if len(moving) > 1:
                pieces.append(CurvePiece(moving * size + origin, fixed[part] * size + origin))
    sliding = tuple(dyad.moved(size, origin) for dyad in sliding_dyads(displacements))
    return BurmesterCurves(task, tuple(pieces), sliding)


def _real_cubic(cubic: Complexes) -> Reals:
    """The coefficients of x^i y^j in Cartesian coordinates: (4, 4)."""
    from math import comb

    from gruebler.design.synthesis.dyads import _CUBIC

    cartesian = np.zeros((4, 4), np.complex128)
    for value, (m, n) in zip(cubic, _CUBIC, strict=True):
        for a in range(m + 1):
            for b in range(n + 1):
                i, j = m + n - a - b, a + b
                cartesian[i, j] += value * comb(m, a) * comb(n, b) * (1j) ** a * (-1j) ** b
    # Real up to a common factor of modulus one.
    largest = cartesian.ravel()[np.argmax(np.abs(cartesian))]
    return np.asarray((cartesian / largest).real)


def _known_point(given: Displacements, cubic: Reals) -> complex:
    """A finite point of the circle-point curve: a pole of the body, else any."""
    poles = [complex(t / (1 - q)) for q, t in zip(*given, strict=True) if abs(q - 1) > 1e-6]
    if poles:
        return min(poles, key=abs)
    for angle in (0.3, 1.1, 1.9, 2.7):  # a line through the origin meets a cubic at least once
        line = np.exp(1j * angle)
        along = [sum(cubic[i, n - i] * line.real**i * line.imag ** (n - i) for i in range(n + 1)) for n in range(4)]
        roots = np.polynomial.polynomial.polyroots(np.trim_zeros(along, "b"))
        real = roots[np.abs(roots.imag) < 1e-9 * (1 + np.abs(roots))].real
        if len(real):
            return complex(line * real[np.argmin(np.abs(real))])
    raise SynthesisError("the circle-point curve has no finite point")


def _traced(cubic: Reals, start: complex, points: int) -> list[Complexes]:
    """The curve as connected pieces; a piece that runs to infinity is open."""
    # About the start: along the direction (c, s) the cubic is r (A2 r^2 + A1 r + A0), A0 = 0 up to rounding.
    moved = _shifted(cubic, start)

    def forms(angle: Reals) -> tuple[Reals, Reals, Reals]:
        c, s = np.cos(angle), np.sin(angle)
        parts = [sum(moved[i, n - i] * c**i * s ** (n - i) for i in range(n + 1)) for n in (1, 2, 3)]
        return parts[0], parts[1], parts[2]

    def discriminant(angle: Reals) -> Reals:
        linear, square, cube = forms(angle)
        return np.asarray(square**2 - 4 * cube * linear)

    cuts = _zeros_of_form(discriminant)
    loops: list[Complexes] = []
    spans = [(0.0, np.pi)] if not len(cuts) else list(zip(cuts, [*cuts[1:], cuts[0] + np.pi], strict=True))
    for low, high in spans:
        if discriminant(np.array([(low + high) / 2]))[0] <= 0:
            continue
        # Dense where the two roots meet at the ends.
        share = (1 - np.cos(np.linspace(0, np.pi, points))) / 2
        angle = low + (high - low) * share
        linear, square, _ = forms(angle)
        root = np.sqrt(np.maximum(discriminant(angle), 0.0))
        direction = np.exp(1j * angle)
        # The quadratic's roots without cancellation, as 2 A0 / (-A1 -+ root).
        with np.errstate(divide="ignore", invalid="ignore"):
            first, second = 2 * linear / (-square + root), 2 * linear / (-square - root)
        loop = np.concatenate([start + direction * first, (start + direction * second)[::-1]])
        if not len(cuts):
            loops += [start + direction * first, start + direction * second]
        else:
            loops.append(loop)
    return [piece for loop in loops for piece in _finite(loop)]


def _shifted(cubic: Reals, start: complex) -> Reals:
    """The coefficients about another origin."""
    from math import comb

    shifted = np.zeros((4, 4))
    for i in range(4):
        for j in range(4 - i):
            for a in range(i + 1):
                for b in range(j + 1):
                    shifted[a, b] += (
                        cubic[i, j] * comb(i, a) * comb(j, b) * start.real ** (i - a) * start.imag ** (j - b)
                    )
    return shifted


def _zeros_of_form(form: object) -> Reals:
    """The zeros of a quartic form in cosine and sine, in [0, pi): from nine values by its Fourier coefficients."""
    count = 9
    angles = np.pi * np.arange(count) / count
    values = form(angles)  # type: ignore[operator]
    # A form of degree four is a trigonometric polynomial of degree two in the doubled angle.
    coefficients = np.fft.fft(values) / count
    polynomial = np.concatenate([coefficients[-2:], coefficients[:3]])
    largest = np.abs(polynomial).max()
    if largest == 0:
        return np.zeros(0)
    roots = np.polynomial.polynomial.polyroots(polynomial)
    on_circle = roots[np.abs(np.abs(roots) - 1) < 1e-6]
    return np.sort(np.angle(on_circle) / 2 % np.pi)


def _finite(loop: Complexes) -> list[Complexes]:
    """The loop cut where it goes through infinity; pieces that meet at its ends are joined."""
    jump = np.abs(np.diff(np.append(loop, loop[0])))
    far = np.abs(loop)
    limit = 1e4
    good = np.isfinite(loop.real) & (far < limit)
    cut = jump > 0.5 * limit
    good &= ~cut
    if good.all():
        return [np.append(loop, loop[0])]
    first = int(np.argmin(good))
    rolled, ok = np.roll(loop, -first), np.roll(good, -first)
    return [rolled[part] for part in _runs(ok)]


def _runs(good: NDArray[np.bool_]) -> list[slice]:
    """Slices of consecutive true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(int)))
    return [slice(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _centres(given: Displacements, x: Complexes) -> tuple[Complexes, NDArray[np.bool_]]:
    """The pivots on the frame, and where they are finite."""
    q, t = given
    places = q * x[:, None] + t
    gaps = places - x[:, None]
    right = (np.abs(places) ** 2 - np.abs(x[:, None]) ** 2) / 2
    gram = np.einsum("ni,ni->n", gaps.real, gaps.real), np.einsum("ni,ni->n", gaps.imag, gaps.imag)
    mixed = np.einsum("ni,ni->n", gaps.real, gaps.imag)
    first, second = np.einsum("ni,ni->n", gaps.real, right), np.einsum("ni,ni->n", gaps.imag, right)
    det = gram[0] * gram[1] - mixed**2
    with np.errstate(divide="ignore", invalid="ignore"):
        m = ((gram[1] * first - mixed * second) + 1j * (gram[0] * second - mixed * first)) / det
    good = (det > 1e-14 * (gram[0] + gram[1]) ** 2) & (np.abs(m) < 1e4)
    return m, good


def _conditions(given: Displacements, x: complex, m: complex) -> tuple[Reals, Reals]:
    """How far a dyad is from guiding the body, and the derivatives by both pivots: (3,), (3, 4)."""
    gap = given.q * x + given.t - m
    residual = np.abs(gap) ** 2 - abs(x - m) ** 2
    by_x, by_m = 2 * (np.conj(given.q) * gap - (x - m)), -2 * (gap - (x - m))
    return residual, np.stack([by_x.real, by_x.imag, by_m.real, by_m.imag], axis=1)


def _sharpened(given: Displacements, x: complex, m: complex) -> GuidingDyad:
    """The nearest exact dyad of three displacements, by Gauss and Newton."""
    for _ in range(20):
        residual, matrix = _conditions(given, x, m)
        step, *_ = np.linalg.lstsq(matrix, -residual, rcond=1e-13)
        x, m = x + complex(step[0], step[1]), m + complex(step[2], step[3])
        if np.abs(step).max() < 1e-15 * (1 + abs(x) + abs(m)):
            break
    dyad = GuidingDyad(CRANK, x, m)
    if misfit(given, dyad) > 1e-10 * (1 + abs(x) + abs(m)):
        raise SynthesisError("no dyad of the four positions lies near this place")
    return dyad


def _nearest_dyad(given: Displacements, x: complex, m: complex, target: complex, side: int) -> GuidingDyad:
    """From a dyad along the curve to where its pivot (0: on the body, 1: on the frame) is nearest to a place."""
    for _ in range(_STEPS):
        tangent = np.linalg.svd(_conditions(given, x, m)[1])[2][-1]
        own = complex(tangent[2 * side], tangent[2 * side + 1])
        along = float(np.real(np.conj(own) * (target - (x, m)[side]))) / max(abs(own) ** 2, 1e-12)
        longest = _LONGEST * (1 + abs(x) + abs(m))
        along = float(np.clip(along, -longest, longest))
        dyad = _sharpened(given, x + along * complex(*tangent[:2]), m + along * complex(*tangent[2:]))
        moved = abs(dyad.moving - x) + abs(dyad.fixed - m)
        x, m = dyad.moving, dyad.fixed
        if moved < 1e-13 * (1 + abs(x) + abs(m)):
            break
    return GuidingDyad(CRANK, x, m)
