"""All cranks of two and three positions in cells: every point of the body is a pivot.

docs/theory/synthesis-positions.md, "Proofs for two and three positions".
"""

from __future__ import annotations

from itertools import combinations, pairwise, product

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.design.synthesis.dyad_cells import FAR, DyadCurve, DyadFamily, Links, links_to
from gruebler.design.synthesis.dyads import Displacements
from gruebler.design.synthesis.enclosures import Enclosure

_POLES_APART = 1e-3
"""Sizes: poles nearer to each other are nearly one, and what lies between them is lost in rounding."""
_FARTHEST_POLE = 100.0
_STEPS = ((0, 1), (0, 2), (1, 2))  # between the places of a pivot
_ROUNDING = 1e-12


def crank_family(given: Displacements) -> DyadFamily | None:
    """The cranks of two to four positions, or None where their equations are nearly singular."""
    if len(given.q) == 3:
        return DyadCurve(given)
    poles = _poles(given)
    if len(given.q) == 1:
        return DyadPencil(given, *poles.values()) if poles else None
    gaps = [abs(first - second) for first, second in combinations(poles.values(), 2)]
    together = [abs(t) for q, t in zip(*_steps(given), strict=True) if abs(q) < _POLES_APART]
    return DyadPlane(given, poles) if min(gaps + together, default=1.0) > _POLES_APART else None


def _steps(given: Displacements) -> tuple[list[complex], list[complex]]:
    q, t = given.with_first
    chosen = list(combinations(range(len(q)), 2))
    return [complex(q[k] - q[j]) for j, k in chosen], [complex(t[k] - t[j]) for j, k in chosen]


def _poles(given: Displacements) -> dict[tuple[int, int], complex]:
    """The points of the body that lie at one place in two positions, as far as they are at hand."""
    pairs = combinations(range(len(given.q) + 1), 2)
    poles = {pair: -t / q for pair, q, t in zip(pairs, *_steps(given), strict=True) if q}
    return {pair: pole for pair, pole in poles.items() if abs(pole) < _FARTHEST_POLE}


def _ranges(cells: Reals) -> list[Enclosure]:
    """The parameters of cells."""
    none = np.zeros(len(cells))
    count = (cells.shape[1] - 2) // 2
    parameters = []
    for k in range(count):
        low, high = cells[:, 2 + 2 * k], cells[:, 3 + 2 * k]
        slopes = [none] * count
        slopes[k] = (high - low) / 2
        parameters.append(Enclosure((low + high) / 2, tuple(slopes), none))
    return parameters


def _turn(angle: Enclosure) -> Enclosure:
    value = np.exp(1j * angle.value)
    return angle.mapped(value, 1j * value, 1.0)


class DyadPlane:
    """Three positions: x and y of the pivot on the body; about each pole its distance and direction from it.

    A pole lies at one place in two positions. Their bisector is then perpendicular to the direction in which the pivot
    left the pole, so that there is one dyad for each direction.
    """

    def __init__(self, given: Displacements, poles: dict[tuple[int, int], complex]) -> None:
        self.given, self.poles = given, poles
        places = list(poles.values())
        self.radii = [
            min([0.3, *(0.3 * abs(place - other) for other in places if other is not place)]) for place in places
        ]

    def first_cells(self) -> Reals:
        """The square at hand, and a disc about each pole."""
        rows = [(0, 1, -FAR, FAR, -FAR, FAR)]
        rows += [(1 + k, 1, 0, radius, 0, 2 * np.pi) for k, radius in enumerate(self.radii)]
        return np.array(rows, np.float64)

    def moving_pivots(self, cells: Reals) -> tuple[Enclosure, Reals]:
        """The pivots on the body; those of the square are infinitely far where the disc of a pole has them."""
        first, second = _ranges(cells)
        pivots, least, turn = first + 1j * second, np.zeros(len(cells)), _turn(second)
        for k, (pole, radius) in enumerate(zip(self.poles.values(), self.radii, strict=True), 1):
            pivots = (first * turn + pole).where(cells[:, 0] == k, pivots)
            beyond = (cells[:, 0] == 0) & (np.abs(pivots.value - pole) + pivots.reach < radius)
            least = np.where(beyond, np.inf, least)
        return pivots, least

    def links(self, cells: Reals, moving: Enclosure) -> Links:
        """The links: three products of the steps from place to place, and the area that these enclose as their weight.

        With the steps g_jk = (q_k - q_j)(x - P_jk) the links are g_01 g_02 g_12*, g_01 g_02* g_12 and g_01* g_02 g_12,
        each times -i/2, and the weight is Im(g_01* g_02). About a pole all are divided by the distance r from it.
        """
        q, t = self.given.with_first
        first, second = _ranges(cells)
        turn, about = _turn(second), moving.value
        steps, rest = {}, moving - about
        for j, k in _STEPS:
            steps[j, k] = rest * (q[k] - q[j]) + (about * (q[k] - q[j]) + t[k] - t[j])
        # Im(g_01* g_02) = bend |x|² + Im(slope x) + constant
        bend = float(np.imag(np.conj(q[1]) * q[2] - np.conj(q[1]) - q[2]))
        slope = np.conj(t[1]) * (q[2] - 1) - np.conj(t[2] * (np.conj(q[1]) - 1))
        grown = slope + 2j * bend * np.conj(about)
        area = Enclosure(
            np.imag(np.conj(steps[0, 1].value) * steps[0, 2].value),
            tuple(np.imag(grown * each) for each in moving.slopes),
            np.abs(grown) * moving.rest + abs(bend) * moving.reach**2,
        )
        for number, ((j, k), pole) in enumerate(self.poles.items(), 1):
            there = cells[:, 0] == number
            steps[j, k] = (turn * (q[k] - q[j])).where(there, steps[j, k])
            area = ((turn * (slope + 2j * bend * np.conj(pole))).imaginary + first * bend).where(there, area)
        near, far, last = (steps[pair] for pair in _STEPS)
        products = [near * far * last.conjugate, near * far.conjugate * last, near.conjugate * far * last]
        arms = Enclosure(
            np.stack([each.value for each in products], axis=1) * -0.5j,
            tuple(np.stack(parts, axis=1) * -0.5j for parts in zip(*(each.slopes for each in products), strict=True)),
            np.stack([each.rest for each in products], axis=1) / 2,
        )
        link = arms.at((slice(None), 0))
        beyond = (moving * area - link).least / area.most
        return Links(moving - link * area.inverse, arms, area.widened(_ROUNDING * area.most), beyond)


class DyadPencil:
    """Two positions: distance and direction of the pivot on the body from the pole, and the distance of the other.

    The bisector of the places of x = P + r exp(i v) passes the pole P, turned by half the angle of the body.
    """

    def __init__(self, given: Displacements, pole: complex) -> None:
        self.given, self.pole = given, pole
        self.half = complex(np.exp(0.5j * np.angle(given.q[0])))

    def first_cells(self) -> Reals:
        """All within reach."""
        far = FAR + abs(self.pole)
        ends = [np.linspace(low, high, 5) for low, high in ((0, far), (0, 2 * np.pi), (-far, far))]
        return np.array([(0, 1, *np.ravel(cell)) for cell in product(*map(pairwise, ends))], np.float64)

    def moving_pivots(self, cells: Reals) -> tuple[Enclosure, Reals]:
        """The pivots on the body."""
        distance, angle, _ = _ranges(cells)
        return distance * _turn(angle) + self.pole, np.zeros(len(cells))

    def links(self, cells: Reals, moving: Enclosure) -> Links:
        """The links to pivots on the bisectors."""
        _, angle, distance = _ranges(cells)
        fixed = distance * _turn(angle) * self.half + self.pole
        return links_to(fixed, np.zeros(len(cells)), moving, self.given)
