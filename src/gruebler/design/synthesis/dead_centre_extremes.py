"""Where in a family with given dead centres something changes: algebra in place of a search.

The squares of all lengths are linear in that of the coupler, so that limits of the demands and extremes of the
transmission angle are zeros of polynomials. docs/theory/synthesis-dead-centres.md, "The best member".
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import permutations
from math import cos, pi, sin, sqrt, tan

import numpy as np
from numpy.polynomial import Polynomial

from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.tasks import DeadCentreTask

LONGEST = 20.5
"""Chords: couplers of dead centres half a turn apart are taken up to this length."""
_ONE = Polynomial([1.0])
_SAME = 1e-10  # of a zero: nearer ones are one
_NEARLY_REAL = 1e-5  # of a zero: rounding parts a double one into two that are conjugate


@dataclass(frozen=True, slots=True, kw_only=True)
class LengthSquares:
    """Lengths of the members, with rocker or stroke 1, by t, the square of the coupler."""

    squares: dict[str, Polynomial]
    """Of crank, coupler, rocker, frame: linear in t."""
    difference: Polynomial
    """N, so that (|N| + 2 sqrt(W)) / (2 b) is the largest cosine of a transmission angle."""
    product: Polynomial
    """W."""
    low: float
    high: float
    """All members lie between these values of t, and each value between them has one."""

    @classmethod
    def of(cls, task: DeadCentreTask) -> LengthSquares:
        """Those of a family; see the theory for the equations."""
        half, swing = (task.angle - pi) / 2, task.swing or 0.0
        turned, t = half - swing / 2, Polynomial([0.0, 1.0])
        chord = 1.0 if task.swing is None else 2 * sin(swing / 2)
        crank, coupler = (chord**2 / 4 - t * sin(half) ** 2) / cos(half) ** 2, t
        low, high = chord**2 / 4, (LONGEST * chord) ** 2
        if not is_half_turn(task):
            least = tan(half) * tan(turned)  # a/b where the pin lies on the frame line in a dead centre
            high = low / ((least * cos(half)) ** 2 + sin(half) ** 2)
        if task.swing is None:
            squares = {"crank": crank, "coupler": coupler}
            eccentricity = (coupler - crank) * abs(sin(2 * half))
            return cls(squares=squares, difference=2 * eccentricity, product=crank, low=low, high=high)
        frame = (crank * cos(turned) ** 2 + coupler * sin(turned) ** 2) / sin(swing / 2) ** 2
        return cls(
            squares={"crank": crank, "coupler": coupler, "rocker": _ONE, "frame": frame},
            difference=coupler + _ONE - crank - frame,
            product=crank * frame,
            low=low,
            high=high,
        )

    def crank_and_coupler(self, t: float) -> tuple[float, float]:
        """Of a member."""
        return sqrt(max(0.0, self.squares["crank"](t))), sqrt(t)

    def extremes(self) -> list[float]:
        """Where the least transmission angle can have an extreme, between the ends."""
        return self._inside(self._stationary)

    def limits(self, demands: Demands) -> list[float]:
        """The same, and where a demand begins or ceases to be met, or one length to be longer than another.

        Between two of these values the same demands are met, and transmission angle, size and size ratio rise or fall.

        Args:
            demands: size ratio and transmission angle.
        """
        n, w, square = self.difference, self.product, self.squares["coupler"]
        least = n * n + 4 * w - 4 * cos(demands.transmission) ** 2 * square
        conditions = [*self._stationary, least * least - 16 * n * n * w]
        conditions += [
            first - ratio**2 * second
            for first, second in permutations(self.squares.values(), 2)
            for ratio in (1.0, demands.size_ratio)
        ]
        return self._inside(conditions)

    def with_ratio(self, first: str, second: str, ratio: float) -> list[float]:
        """Where the first length is so many times the second, 1 if that is no link."""
        return self._inside([self.squares[first] - ratio**2 * self.squares.get(second, _ONE)])

    @property
    def _stationary(self) -> list[Polynomial]:
        """F = (n + 2 sqrt(w)) / (2 b) and F = (-n + 2 sqrt(w)) / (2 b) have the same equation of their extremes."""
        n, w, square = self.difference, self.product, self.squares["coupler"]
        slope = square.deriv()
        return [(n.deriv() * square - n * slope / 2) ** 2 * w - (w.deriv() * square - w * slope) ** 2, n]

    def _inside(self, conditions: Iterable[Polynomial]) -> list[float]:
        """The real zeros between the ends, in order."""
        zeros: list[float] = []
        for condition in conditions:
            parts = np.array(condition.coef, np.float64) * self.low ** np.arange(len(condition.coef))
            roots = np.roots(np.trim_zeros(parts, "b")[::-1]) * self.low
            zeros += [float(root.real) for root in roots if abs(root.imag) <= _NEARLY_REAL * abs(root)]
        apart: list[float] = []
        for zero in sorted(zeros):
            if (apart[-1] if apart else self.low) * (1 + _SAME) < zero < self.high * (1 - _SAME):
                apart.append(zero)
        return apart


def is_half_turn(task: DeadCentreTask) -> bool:
    """Whether the dead centres are half a turn apart."""
    return abs(task.angle - pi) < 2e-12
