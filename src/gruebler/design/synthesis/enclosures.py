"""Enclosures: numbers that depend on parameters, to first order, with a bound on the rest.

A proof over a whole family needs bounds, not samples. docs/theory/synthesis-positions.md uses them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Flags, Reals

Numbers = NDArray[Any]
"""Real or complex ones."""


@dataclass(frozen=True, slots=True, eq=False)
class Enclosure:
    """value + sum of slope_k d_k + e for all -1 <= d_k <= 1 and some |e| <= rest; arrays of real or complex numbers.

    Source: first-order Taylor models; M. Berz, K. Makino, Verified integration of ODEs and flows using differential
    algebraic methods on high-order Taylor models, Reliable Computing 4 (1998).

    >>> x = Enclosure(np.array([2.0]), (np.array([0.1]),), np.zeros(1))
    >>> square = x * x
    >>> square.value, square.slopes, square.rest.round(9)
    (array([4.]), (array([0.4]),), array([0.01]))
    """

    value: Numbers
    slopes: tuple[Numbers, ...]
    rest: Reals
    __array_ufunc__ = None

    @classmethod
    def exact(cls, value: Numbers, parameters: int) -> Enclosure:
        """Numbers that depend on none of so many parameters."""
        return cls(value, (np.zeros_like(value),) * parameters, np.zeros(value.shape))

    @property
    def count(self) -> int:
        """Of the parameters."""
        return len(self.slopes)

    @property
    def reach(self) -> Reals:
        """How far it can be from its value."""
        total = self.rest
        for slope in self.slopes:
            total = total + np.abs(slope)
        return total

    @property
    def low(self) -> Reals:
        """A lower bound of a real number."""
        return np.asarray(self.value - self.reach)

    @property
    def high(self) -> Reals:
        """An upper bound of a real number."""
        return np.asarray(self.value + self.reach)

    @property
    def least(self) -> Reals:
        """A lower bound of the absolute value."""
        return np.maximum(np.abs(self.value) - self.reach, 0)

    @property
    def most(self) -> Reals:
        """An upper bound of the absolute value."""
        return np.asarray(np.abs(self.value) + self.reach)

    def __add__(self, other: Enclosure | Numbers | complex) -> Enclosure:
        if not isinstance(other, Enclosure):
            return Enclosure(self.value + other, self.slopes, self.rest)
        slopes = tuple(a + b for a, b in zip(self.slopes, other.slopes, strict=True))
        return Enclosure(self.value + other.value, slopes, self.rest + other.rest)

    __radd__ = __add__

    def __neg__(self) -> Enclosure:
        return Enclosure(-self.value, tuple(-slope for slope in self.slopes), self.rest)

    def __sub__(self, other: Enclosure | Numbers | complex) -> Enclosure:
        return self + (-other)

    def __rsub__(self, other: Numbers | complex) -> Enclosure:
        return (-self) + other

    def __mul__(self, other: Enclosure | Numbers | complex) -> Enclosure:
        if not isinstance(other, Enclosure):
            slopes = tuple(slope * other for slope in self.slopes)
            return Enclosure(self.value * other, slopes, np.asarray(self.rest * np.abs(other)))
        slopes = tuple(self.value * b + other.value * a for a, b in zip(self.slopes, other.slopes, strict=True))
        rest = np.abs(self.value) * other.rest + np.abs(other.value) * self.rest + self.reach * other.reach
        return Enclosure(self.value * other.value, slopes, rest)

    __rmul__ = __mul__

    @property
    def conjugate(self) -> Enclosure:
        """Of a complex number."""
        return Enclosure(np.conj(self.value), tuple(np.conj(slope) for slope in self.slopes), self.rest)

    @property
    def real(self) -> Enclosure:
        """The real part."""
        return Enclosure(self.value.real, tuple(slope.real for slope in self.slopes), self.rest)

    @property
    def imaginary(self) -> Enclosure:
        """The imaginary part."""
        return Enclosure(self.value.imag, tuple(slope.imag for slope in self.slopes), self.rest)

    def mapped(self, value: Numbers, derivative: Numbers, curvature: float | Reals) -> Enclosure:
        """A function of it, from value and derivative at its value, and a bound of the second derivative."""
        rest = np.abs(derivative) * self.rest + 0.5 * curvature * self.reach**2
        return Enclosure(value, tuple(derivative * slope for slope in self.slopes), np.asarray(rest))

    def _usual(self, size: Numbers) -> tuple[Flags, Numbers]:
        """Where its reach is below its size, and the value there, 1 elsewhere: zero is not divided by."""
        usual = np.asarray(self.reach < size)
        return usual, np.where(usual, self.value, 1)

    @property
    def inverse(self) -> Enclosure:
        """1/x, with an infinite rest where x may be zero: 1/(c + e) = 1/c - e/c² + e²/(c² (c + e))."""
        usual, value = self._usual(np.abs(self.value))
        reach = np.where(usual, self.reach, 0)
        size, inverse = np.abs(value), 1 / value
        rest = self.rest / size**2 + reach**2 / (size**2 * (size - reach))
        slopes = tuple(-(inverse**2) * slope for slope in self.slopes)
        return Enclosure(inverse, slopes, np.where(usual, rest, np.inf))

    @property
    def root(self) -> Enclosure:
        """The square root of a real number that is not negative; the remainder is at most e²/(2 c sqrt(c))."""
        usual, value = self._usual(self.value)
        root, half = np.sqrt(value), np.sqrt(np.maximum(self.high, 0)) / 2
        rest = self.rest / (2 * root) + self.reach**2 / (2 * value * root)
        slopes = tuple(np.where(usual, slope / (2 * root), 0) for slope in self.slopes)
        return Enclosure(np.where(usual, root, half), slopes, np.where(usual, rest, half))

    @property
    def modulus(self) -> Enclosure:
        """The absolute value of a complex number: |c + e| - |c| - Re(c* e)/|c| lies in [0, |e|²/2(|c| - |e|)]."""
        usual, value = self._usual(np.abs(self.value))
        size, reach, half = np.abs(value), np.where(usual, self.reach, 0), self.most / 2
        bend = reach**2 / (4 * (size - reach))
        slopes = tuple(np.where(usual, (np.conj(value) * slope).real / size, 0) for slope in self.slopes)
        return Enclosure(np.where(usual, size + bend, half), slopes, np.where(usual, self.rest + bend, half))

    @property
    def angle(self) -> Enclosure:
        """The argument of a complex number, with an infinite rest where it may be zero."""
        usual, value = self._usual(np.abs(self.value))
        size = np.abs(value)
        share = np.where(usual, self.reach, 0) / size  # |log(1 + w) - w| <= |w|²/2(1 - |w|)
        rest = np.where(usual, self.rest / size + share**2 / (2 * (1 - share)), np.inf)
        return Enclosure(np.angle(value), tuple((slope / value).imag for slope in self.slopes), rest)

    def at(self, rows: Any) -> Enclosure:
        """Those of some rows."""
        return Enclosure(self.value[rows], tuple(slope[rows] for slope in self.slopes), self.rest[rows])

    @property
    def column(self) -> Enclosure:
        """Each as a row of one, to be combined with several."""
        return self.at((slice(None), None))

    def placed(self, side: int, others: int) -> Enclosure:
        """With so many parameters more on which it does not depend: behind its own for side 0, before them for 1."""
        none = (np.zeros_like(self.value),) * others
        return Enclosure(self.value, none + self.slopes if side else self.slopes + none, self.rest)

    def widened(self, by: Reals) -> Enclosure:
        """With a larger rest."""
        return Enclosure(self.value, self.slopes, self.rest + by)

    def where(self, chosen: Flags, other: Enclosure) -> Enclosure:
        """These numbers where they are chosen, others elsewhere."""
        slopes = tuple(np.where(chosen, a, b) for a, b in zip(self.slopes, other.slopes, strict=True))
        value, rest = np.where(chosen, self.value, other.value), np.where(chosen, self.rest, other.rest)
        return Enclosure(value, slopes, np.asarray(rest))

    def or_narrower(self, other: Enclosure) -> Enclosure:
        """Of two enclosures of the same numbers the one with the smaller rest."""
        return self.where(~(other.rest < self.rest) & ~np.isnan(self.rest), other)
