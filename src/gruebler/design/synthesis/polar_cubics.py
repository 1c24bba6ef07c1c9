"""The circle-point curve of four positions along directions about one of its points, where it is a quadratic.

docs/theory/synthesis-positions.md, "Tracing the curves".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis.dyads import CUBIC, Displacements, circle_point_cubics


@dataclass(frozen=True)
class PolarCubic:
    """Along the direction (c, s) from the start the cubic is r (A2 r^2 + A1 r + A0)."""

    start: complex
    """A point of the curve, so that the constant term is zero up to rounding."""
    coefficients: Reals
    """(4, 4) of x^i y^j about the start."""

    @classmethod
    def of(cls, given: Displacements) -> PolarCubic:
        """That of three displacements. Raises `SynthesisError` where the curve has no finite point."""
        cubic = _real_cubic(circle_point_cubics(given)[0])
        start = _known_point(given, cubic)
        return cls(start, _shifted(cubic, start))

    def forms(self, angle: Reals) -> tuple[Reals, Reals, Reals]:
        """A0, A1 and A2, forms of degree one, two and three in cosine and sine."""
        c, s = np.cos(angle), np.sin(angle)
        parts = [sum(self.coefficients[i, n - i] * c**i * s ** (n - i) for i in range(n + 1)) for n in (1, 2, 3)]
        return parts[0], parts[1], parts[2]

    def discriminant(self, angle: Reals) -> Reals:
        """A1^2 - 4 A2 A0, a form of degree four: directions where it is not negative meet the curve."""
        linear, square, cube = self.forms(angle)
        return np.asarray(square**2 - 4 * cube * linear)

    @cached_property
    def _cuts(self) -> Reals:
        return _zeros_of_form(self.discriminant)

    @property
    def closes(self) -> bool:
        """Whether the two points of a direction meet at the ends of its span; else every direction has two."""
        return len(self._cuts) > 0

    @cached_property
    def spans(self) -> list[tuple[float, float]]:
        """The directions that meet the curve, as intervals; all of the half turn where the discriminant has no zero."""
        if not self.closes:
            return [(0.0, float(np.pi))] if self.discriminant(np.zeros(1))[0] > 0 else []
        cuts = self._cuts
        spans = zip(cuts.tolist(), [*cuts[1:].tolist(), float(cuts[0] + np.pi)], strict=True)
        return [span for span in spans if self.discriminant(np.array([sum(span) / 2]))[0] > 0]


def _real_cubic(cubic: Complexes) -> Reals:
    """The coefficients of x^i y^j in Cartesian coordinates: (4, 4)."""
    cartesian = np.zeros((4, 4), np.complex128)
    for value, (m, n) in zip(cubic, CUBIC, strict=True):
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


def _shifted(cubic: Reals, start: complex) -> Reals:
    """The coefficients about another origin."""
    shifted = np.zeros((4, 4))
    for i in range(4):
        for j in range(4 - i):
            for a in range(i + 1):
                for b in range(j + 1):
                    shifted[a, b] += (
                        cubic[i, j] * comb(i, a) * comb(j, b) * start.real ** (i - a) * start.imag ** (j - b)
                    )
    return shifted


def _zeros_of_form(form: Callable[[Reals], Reals]) -> Reals:
    """The zeros of a quartic form in cosine and sine, in [0, pi): from nine values by its Fourier coefficients."""
    count = 9
    angles = np.pi * np.arange(count) / count
    values = form(angles)
    # A form of degree four is a trigonometric polynomial of degree two in the doubled angle.
    coefficients = np.fft.fft(values) / count
    polynomial = np.concatenate([coefficients[-2:], coefficients[:3]])
    largest = np.abs(polynomial).max()
    if largest == 0:
        return np.zeros(0)
    roots = np.polynomial.polynomial.polyroots(polynomial)
    on_circle = roots[np.abs(np.abs(roots) - 1) < 1e-6]
    return np.sort(np.angle(on_circle) / 2 % np.pi)
