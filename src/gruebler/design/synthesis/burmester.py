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
    guiding_conditions,
    misfit,
    sliding_dyads,
)
from gruebler.design.synthesis.polar_cubics import PolarCubic
from gruebler.design.synthesis.tasks import PositionTask

_STEPS = 30  # along a curve to the point nearest to a place
_HALVINGS = 40  # of a step that leads away from it
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
        near_curve = np.stack([side[chosen] for side in self._points], axis=1)
        near_curve = np.array(list(dict.fromkeys(map(tuple, near_curve))))  # a closed piece ends in its first point
        given, *_ = Displacements.of(self.task.origins, self.task.turns)
        return (*(dyad.moved(size, origin) for dyad in _sharpened(given, near_curve)), *self.sliding)

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
        return _sharpened(displacements, np.array([[x, m]]))[0].moved(size, origin)


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
    pieces = []
    for curve in _traced(PolarCubic.of(displacements), points):
        fixed, good = _centres(displacements, curve)
        for part in _runs(good):
            moving = curve[part]
            if len(moving) > 1:
                pieces.append(CurvePiece(moving * size + origin, fixed[part] * size + origin))
    sliding = tuple(dyad.moved(size, origin) for dyad in sliding_dyads(displacements))
    return BurmesterCurves(task, tuple(pieces), sliding)


def _traced(cubic: PolarCubic, points: int) -> list[Complexes]:
    """The curve as connected pieces; a piece that runs to infinity is open."""
    loops: list[Complexes] = []
    for low, high in cubic.spans:
        # Dense where the two roots meet at the ends.
        share = (1 - np.cos(np.linspace(0, np.pi, points))) / 2
        angle = low + (high - low) * share
        linear, square, _ = cubic.forms(angle)
        root = np.sqrt(np.maximum(cubic.discriminant(angle), 0.0))
        direction = np.exp(1j * angle)
        # The quadratic's roots without cancellation, as 2 A0 / (-A1 -+ root).
        with np.errstate(divide="ignore", invalid="ignore"):
            first, second = 2 * linear / (-square + root), 2 * linear / (-square - root)
        if cubic.closes:
            loops.append(np.concatenate([cubic.start + direction * first, (cubic.start + direction * second)[::-1]]))
        else:
            loops += [cubic.start + direction * first, cubic.start + direction * second]
    return [piece for loop in loops for piece in _finite(loop)]


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


def _sharpened(given: Displacements, pivots: Complexes) -> list[GuidingDyad]:
    """The nearest exact dyads of three displacements, by Gauss and Newton.

    Args:
        given: displacements.
        pivots: (dyads, 2) those on the body and those on the frame, near to dyads.
    """
    pivots, left = pivots.copy(), np.arange(len(pivots))
    for _ in range(20):
        residual, matrix = guiding_conditions(given, pivots[left, 0], pivots[left, 1])
        step = -(np.linalg.pinv(matrix, rcond=1e-13) @ residual[..., None])[..., 0]
        pivots[left] += step.view(np.complex128)
        left = left[np.abs(step).max(axis=1) >= 1e-15 * (1 + np.abs(pivots[left]).sum(axis=1))]
        if not len(left):
            break
    dyads = [GuidingDyad(CRANK, complex(x), complex(m)) for x, m in pivots]
    if any(misfit(given, dyad) > 1e-10 * (1 + abs(dyad.moving) + abs(dyad.fixed)) for dyad in dyads):
        raise SynthesisError("no dyad of the four positions lies near this place")
    return dyads


def _nearest_dyad(given: Displacements, x: complex, m: complex, target: complex, side: int) -> GuidingDyad:
    """From a dyad along the curve to where its pivot (0: on the body, 1: on the frame) is nearest to a place."""
    for _ in range(_STEPS):
        tangent = np.linalg.svd(guiding_conditions(given, np.complex128(x), np.complex128(m))[1])[2][-1]
        own = complex(tangent[2 * side], tangent[2 * side + 1])
        along = float(np.real(np.conj(own) * (target - (x, m)[side]))) / max(abs(own) ** 2, 1e-12)
        longest = _LONGEST * (1 + abs(x) + abs(m))
        along = float(np.clip(along, -longest, longest))
        for _ in range(_HALVINGS):  # where the curve bends about the place, a whole step leads past the nearest point
            (dyad,) = _sharpened(given, np.array([[x, m]]) + along * tangent.view(np.complex128))
            if abs((dyad.moving, dyad.fixed)[side] - target) <= abs((x, m)[side] - target):
                break
            along /= 2
        moved = abs(dyad.moving - x) + abs(dyad.fixed - m)
        x, m = dyad.moving, dyad.fixed
        if moved < 1e-13 * (1 + abs(x) + abs(m)):
            break
    return GuidingDyad(CRANK, x, m)
