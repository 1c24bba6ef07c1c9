"""All dyads of a family in cells, enclosed with what follows from them: of four positions pieces of Burmester's curves.

docs/theory/synthesis-positions.md, "Proofs in the family of four positions".
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, partial
from itertools import combinations, pairwise
from typing import Any, NamedTuple, Protocol

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Integers, Reals
from gruebler.design.synthesis.dyads import Displacements, GuidingDyad
from gruebler.design.synthesis.enclosures import Enclosure
from gruebler.design.synthesis.polar_cubics import PolarCubic

FAR = 30.0
"""Sizes of the task: pivots farther away than this are left out."""
_SLACK = 1e-11  # by which discs are larger than computed, of the coordinates: far above rounding
_FITS = 1e-12  # of the discriminant: what may be left of it when its zeros are divided out
_FIRST = 24  # cells of a span to begin with
_SHORT = 0.3  # lengths of the dyad: no cell is longer
_MOST = 4000  # cells; a curve that needs more has a singular dyad
_HALVINGS = 40
_TINY = 1e-100


class DyadCurve:
    """The circle-point curve by parameters that leave out no point.

    Each span of directions is one loop, with the parameter from 0 to 2 pi: the direction goes from one end to the other
    and back as low + (high - low) (1 - cos)/2, so that the curve is smooth where the two points of a direction meet.
    Without ends there are two sheets with parameters from 0 to pi.
    """

    def __init__(self, given: Displacements) -> None:
        self.given = given
        self.cubic = PolarCubic.of(given)
        self.spans = np.array(self.cubic.spans).reshape(-1, 2)
        self.end = 2 * np.pi if self.cubic.closes else np.pi
        self._forms = [_harmonics(partial(self._form, k), k + 1) for k in range(3)]
        parts = [self._without_ends(low, high) for low, high in self.spans]
        self._parts = [part for part, _ in parts]
        self.fits = all(misfit <= _FITS for _, misfit in parts)
        """Whether the forms are those of the curve to the last digits."""

    def _form(self, k: int, angle: Reals) -> Reals:
        return self.cubic.forms(angle)[k]

    def first_cells(self) -> Reals:
        """Cells that cover the curve: rows of span, sheet (1 or -1), begin and end of the parameter."""
        ends = np.linspace(0, self.end, _FIRST + 1)
        sheets = (1.0,) if self.cubic.closes else (1.0, -1.0)
        rows = [
            (span, sheet, low, high)
            for span in range(len(self.spans))
            for sheet in sheets
            for low, high in pairwise(ends)
        ]
        return np.array(rows, np.float64).reshape(-1, 4)

    def _without_ends(self, low: float, high: float) -> tuple[_Harmonics, float]:
        """The discriminant by the sines of the angles from both ends of its span, and what is left of it."""
        angle = np.pi * np.arange(24) / 24
        given = self.cubic.discriminant(angle)
        if not self.cubic.closes:
            return _harmonics(self.cubic.discriminant, 4), 0.0
        ends = np.sin(angle - low) * np.sin(high - angle)
        columns = np.stack([np.ones_like(angle), np.cos(2 * angle), np.sin(2 * angle)], axis=1) * ends[:, None]
        (mean, c, s), *_ = np.linalg.lstsq(columns, given, rcond=None)
        rest = float(np.abs(columns @ np.array([mean, c, s]) - given).max() / np.abs(given).max())
        return (np.array([0.0, 2.0, -2.0]), np.array([mean, (c - 1j * s) / 2, (c + 1j * s) / 2])), rest

    def moving_pivots(self, cells: Reals) -> tuple[Enclosure, Reals]:
        """The pivots on the body, and a lower bound of their distances from the origin where they may be far."""
        span, sheet, begin, end = cells.T
        low, high = self.spans[span.astype(int)].T
        width, none = high - low, np.zeros(len(cells))
        middle = (begin + end) / 2
        at = Enclosure(middle, ((end - begin) / 2,), none)
        if self.cubic.closes:
            angle = at.mapped(low + width * (1 - np.cos(middle)) / 2, width * np.sin(middle) / 2, width / 2)
        else:
            angle = at + low
        linear, square, cube = (_valued(form, angle) for form in self._forms)
        part = Enclosure(none, (none,), none)
        for k, harmonics in enumerate(self._parts):
            part = _valued(harmonics, angle).where(span == k, part)
        if self.cubic.closes:
            between = part * _sinc(angle - low) * _sinc(high - angle)
            half = at.mapped(width / 2 * np.sin(middle), width / 2 * np.cos(middle), width / 2)
            root = between.root * half
        else:
            root = part.root * sheet
        below, above = root - square, -(root + square)
        along = (2 * linear * below.inverse).or_narrower(above * (2 * cube).inverse)
        least = np.fmax(2 * linear.least / below.most, above.least / (2 * cube.most))
        turn = np.exp(1j * angle.value)
        pivots = angle.mapped(turn, 1j * turn, 1.0) * along + self.cubic.start
        return pivots, np.asarray(least - abs(self.cubic.start))

    def links(self, _: Reals, moving: Enclosure) -> Links:
        """The links of the dyads, from two bisectors."""
        return links_to(*centres(moving, *self.given.with_first), moving, self.given)


class Links(NamedTuple):
    """Links from the fixed pivots to the moving ones, in all positions."""

    fixed: Enclosure
    arms: Enclosure
    """(cells, positions), times a real weight that may be zero: then the fixed pivot is infinitely far."""
    weight: Enclosure
    away: Reals
    """A lower bound of the distances of fixed pivots from the origin, where they may be far."""


def links_to(fixed: Enclosure, away: Reals, moving: Enclosure, given: Displacements) -> Links:
    """The links to pivots that are at hand."""
    q, t = given.with_first
    arms = moving.column * q + t - fixed.column
    return Links(fixed, arms, Enclosure.exact(np.ones(len(away)), len(moving.slopes)), away)


class DyadFamily(Protocol):
    """Dyads by parameters: rows of piece, sheet, and begin and end of each parameter."""

    given: Displacements

    def first_cells(self) -> Reals:
        """Cells that hold all dyads at hand."""

    def moving_pivots(self, cells: Reals) -> tuple[Enclosure, Reals]:
        """The pivots on the body, and a lower bound of their distances from the origin where they may be far."""

    def links(self, cells: Reals, moving: Enclosure) -> Links:
        """The links to the pivots on the frame."""


class OneDyad:
    """A dyad that is held, as a family with the parameters of another one, on which nothing depends."""

    def __init__(self, family: DyadFamily, dyad: GuidingDyad) -> None:
        self.given, self.dyad, self.first = family.given, dyad, family.first_cells()[:1]

    def first_cells(self) -> Reals:
        """The one cell."""
        return self.first

    def moving_pivots(self, cells: Reals) -> tuple[Enclosure, Reals]:
        """The pivot on the body."""
        return self._pivot(cells, self.dyad.moving), np.zeros(len(cells))

    def links(self, cells: Reals, moving: Enclosure) -> Links:
        """The link."""
        return links_to(self._pivot(cells, self.dyad.fixed), np.zeros(len(cells)), moving, self.given)

    def _pivot(self, cells: Reals, pivot: complex) -> Enclosure:
        return Enclosure.exact(np.full(len(cells), pivot), cells.shape[1] // 2 - 1)


class DyadCells:
    """The dyads of cells, enclosed: pivots, length, crank angles and more, in sizes of the task about its origin."""

    def __init__(self, family: DyadFamily, cells: Reals) -> None:
        self.cells = cells
        with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
            moving, far = family.moving_pivots(cells)
            at_hand = np.isfinite(moving.rest)
            moving = _finite(moving, at_hand)
            self.moving = moving.widened(_SLACK * (1 + np.abs(moving.value)))
            fixed, arms, weight, away = family.links(cells, self.moving)
            at_hand &= np.isfinite(weight.rest) & np.isfinite(arms.rest[:, 0])
            sign = np.where(weight.value < 0, -1.0, 1.0)
            self.arms, self.weight = _finite(arms * sign[:, None], at_hand[:, None]), _finite(weight * sign, at_hand)
            """(cells, positions) of the links from the fixed to the moving pivots, times a weight; the weight."""
            self.known: Flags = at_hand & np.isfinite(fixed.rest) & (self.weight.low > 0)
            """Whether both pivots are bounded."""
            fixed = _finite(fixed, self.known)
            self.fixed = fixed.widened(_SLACK * (1 + np.abs(fixed.value) + np.abs(moving.value)))
            away = np.fmax(away, np.where(self.known, self.fixed.least, 0))
            self.far: Flags = (np.fmax(self.moving.least, far) > FAR) | (away > FAR)
            """Whether a pivot certainly lies too far away."""
            self.length = (self.moving - self.fixed).modulus
            self.angle = self.arms.angle
            """(cells, positions) of the links, those of unknown weight up to half a turn."""
            self.back = -(self.arms * np.conj(family.given.with_first[0]))
            """(cells, positions) from the moving to the fixed pivot, as the body sees it, times the weight."""
            self.extent = self.moving.reach + self.fixed.reach
            """How far the pivots of a cell lie apart."""

    def halves(self, rows: Flags) -> Reals:
        """Some cells, each in two, one after the other: the parameter is halved on which the dyads depend most."""
        moving, link, weight = self.moving.at(rows), self.arms.at((rows, 0)), self.weight.at(rows)
        length, size = np.abs(link.value), np.maximum(np.abs(link.value) + np.abs(weight.value), _TINY)
        changes = [
            np.abs(x) / (1 + np.abs(moving.value)) + np.abs(arm) / size + np.abs(part) * length / size**2
            for x, arm, part in zip(moving.slopes, link.slopes, weight.slopes, strict=True)
        ]
        return halves(self.cells[rows], np.argmax(changes, axis=0))

    @cached_property
    def first_arm(self) -> Enclosure:
        """The link in the first position, times the weight."""
        return self.arms.at((slice(None), 0))

    @cached_property
    def steps(self) -> tuple[Reals, Reals]:
        """Angles from each position to the next, up to whole turns: in the middle, and how far they can be from it."""
        return _difference(self.angle, np.s_[:, 1:], np.s_[:, :-1])

    @cached_property
    def ways(self) -> tuple[Reals, Reals]:
        """Lower bounds of the angles through all positions in order, turning onward and back."""
        middle, reach = self.steps
        return _least_way(middle, reach), _least_way(-middle, reach)

    @property
    def keeps_no_order(self) -> Flags:
        """Whether a crank that turns fully certainly needs more than a lap for the positions in order."""
        return np.asarray(np.minimum(*self.ways) >= 2 * np.pi)

    def outside(self, region: Reals) -> Flags:
        """Whether the fixed pivots certainly lie outside a rectangle of least x, least y, greatest x, greatest y."""
        pivot, weight = self.moving * self.weight - self.first_arm, self.weight
        x, y = pivot.real, pivot.imaginary
        inward = (x - weight * region[0], y - weight * region[1], weight * region[2] - x, weight * region[3] - y)
        beyond, before = ([side.high < 0 for side in inward], [side.low > 0 for side in inward])
        return np.asarray(np.any(beyond, axis=0) & (np.any(before, axis=0) | (weight.low > 0)))


def halves(cells: Reals, parameters: Integers) -> Reals:
    """Each cell in two, by one of its parameters, one after the other."""
    rows, begin = np.arange(len(cells)), 2 + 2 * parameters
    first, second = cells.copy(), cells.copy()
    first[rows, begin + 1] = second[rows, begin] = (cells[rows, begin] + cells[rows, begin + 1]) / 2
    return np.stack([first, second], axis=1).reshape(-1, cells.shape[1])


def short_cells(curve: DyadCurve) -> tuple[Reals, Reals]:
    """Cells shorter than their dyads that cover all dyads whose pivots are at hand, but for the second ones."""
    good: list[Reals] = []
    cells, count = curve.first_cells(), 0
    for _ in range(_HALVINGS):
        seen = DyadCells(curve, cells)
        short = seen.known & (seen.extent < _SHORT * seen.length.low)
        good.append(cells[short & ~seen.far])
        count += len(good[-1])
        cells = seen.halves(~short & ~seen.far)
        if not len(cells) or count + len(cells) > _MOST:
            break
    return np.concatenate(good), cells


_Harmonics = tuple[Reals, Complexes]
"""Numbers of waves and their coefficients: the sum of c_k exp(i k angle) is real."""


def _harmonics(form: Callable[[Reals], Reals], degree: int) -> _Harmonics:
    """Of a form of so many degrees in cosine and sine."""
    count = 2 * degree + 2
    waves = np.fft.fftfreq(count, 1 / count)
    coefficients = np.fft.fft(form(2 * np.pi * np.arange(count) / count)) / count
    return waves[np.abs(waves) <= degree], coefficients[np.abs(waves) <= degree]


def _valued(harmonics: _Harmonics, angle: Enclosure) -> Enclosure:
    waves, coefficients = harmonics
    turns = np.exp(1j * np.multiply.outer(angle.value, waves))
    curvature = float(np.sum(waves**2 * np.abs(coefficients)))
    return angle.mapped((turns @ coefficients).real, (turns @ (1j * waves * coefficients)).real, curvature)


def _sinc(angle: Enclosure) -> Enclosure:
    """sin(u)/u, whose second derivative is at most 1/3."""
    u = angle.value
    value, small = np.sinc(u / np.pi), np.abs(u) < 1e-3
    derivative = np.where(small, -u / 3, (np.cos(u) - value) / np.where(small, 1, u))
    return angle.mapped(value, derivative, 1 / 3)


def _finite(pivots: Enclosure, known: Flags) -> Enclosure:
    """The same with huge rests where they are infinite, so that nothing becomes undefined."""
    none = np.zeros_like(pivots.value)
    return pivots.where(known, Enclosure(none, (none,) * len(pivots.slopes), np.full(none.shape, 1e30)))


def centres(
    moving: Enclosure,
    turns: Complexes,
    shifts: Complexes,
) -> tuple[Enclosure, Reals]:
    """The centres of the circles through the places of the pivots, from two bisectors, whichever two tell most.

    With them a lower bound of their distances from the origin. The centre m of the bisectors Re(g_j* m) = h_j is
    i (h_2 g_1 - h_1 g_2)/Im(g_1* g_2).
    """
    about = moving.value  # so that numbers are small
    places = about[:, None] * (turns - 1) + shifts
    moving = moving - about
    bisectors = []
    for j, k in combinations(range(len(turns)), 2):
        gap = moving * (turns[k] - turns[j]) + (places[:, k] - places[:, j])
        middle = moving * ((turns[k] + turns[j]) / 2) + (places[:, k] + places[:, j]) / 2
        bisectors.append((gap, (gap.conjugate * middle).real))
    none = np.zeros(len(about), np.complex128)
    centre = Enclosure(none, (none,) * len(moving.slopes), np.full(len(about), np.inf))
    least = np.zeros(len(about))
    for (gap, height), (other, high) in combinations(bisectors, 2):
        across, product = 1j * (high * gap - height * other), (gap.conjugate * other).imaginary
        centre = centre.or_narrower(across * product.inverse)
        least = np.fmax(least, across.least / product.most - np.abs(about))
    return centre + about, least


def _difference(angles: Enclosure, end: Any, begin: Any) -> tuple[Reals, Reals]:
    """Of angles of the same cells: in the middle, and how far they can be from it."""
    reach = angles.rest[end] + angles.rest[begin]
    for slope in angles.slopes:
        reach = reach + np.abs(slope[end] - slope[begin])
    return angles.value[end] - angles.value[begin], reach


def _least_way(steps: Reals, reach: Reals) -> Reals:
    """The sum of steps of less than a turn, at least: a step that may be none or a whole turn counts nothing."""
    middle = steps % (2 * np.pi)
    unsure = ~((middle - reach > 0) & (middle + reach < 2 * np.pi))
    return np.asarray(np.where(unsure, 0, middle - reach).sum(axis=1))
