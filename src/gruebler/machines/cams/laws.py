"""Laws of motion from rest to rest, normalised to a unit of angle and a unit of lift; docs/theory/cams.md.

Every law is a sequence of pieces; on a piece the lift is a polynomial plus one sine wave. So all derivatives, integrals
and continuity conditions are exact in closed form.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache, partial
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.text import Message, message
from gruebler.machines.cams.extremes import extremes


class CamError(GrueblerError):
    """An impossible cam, law or contour."""


def finite_array(values: ArrayLike, quantity: Message) -> Reals:
    """Numbers of any shape as an array; CamError if one is not finite, or none at all."""
    try:
        numbers = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        numbers = np.array(np.nan)
    if not np.isfinite(numbers).all():
        raise CamError("{quantity}: expected finite numbers, not {values!r}", quantity=quantity, values=values)
    return numbers


@dataclass(frozen=True, slots=True, kw_only=True)
class LawPiece:
    """From ``start`` on: sum of ``polynomial[k] t^k`` plus ``amplitude * sin(frequency t + phase)``, t = x - start."""

    start: float
    polynomial: tuple[float, ...]
    amplitude: float = 0.0
    frequency: float = 0.0
    phase: float = 0.0

    def at(self, x: Reals, order: int) -> Reals:
        """The derivative of an order at places of any shape."""
        t = x - self.start
        wave = self.amplitude * self.frequency**order * np.sin(self.frequency * t + self.phase + order * math.pi / 2)
        return np.asarray(np.polynomial.polynomial.polyval(t, _derived(self.polynomial, order)) + wave)


@lru_cache(maxsize=1024)
def _derived(polynomial: tuple[float, ...], order: int) -> Reals:
    return np.asarray(np.polynomial.polynomial.polyder(polynomial, order), dtype=np.float64)


class LawPeaks(NamedTuple):
    """The greatest magnitudes of the normalised law's derivatives: C_v, C_a, C_j, and of C_a C_v, the torque."""

    velocity: float
    acceleration: float
    jerk: float
    torque: float


@dataclass(frozen=True, slots=True)
class MotionLaw:
    """A normalised lift on [0, 1], written as pieces in order.

    >>> cycloid = motion_law("cycloidal")
    >>> [round(float(cycloid.at(0.25, order)), 6) for order in range(4)]
    [0.090845, 1.0, 6.283185, 0.0]
    >>> [round(peak, 4) for peak in cycloid.peaks()]
    [2.0, 6.2832, 39.4784, 8.1621]
    """

    name: str
    pieces: tuple[LawPiece, ...]

    @property
    def title(self) -> Message:
        """What a reader calls it.

        >>> motion_law("cycloidal").title.in_language("de")
        'geneigte Sinuslinie (Bestehorn)'
        """
        return _TITLES.get(self.name) or message("polynomial {powers}", powers=self.name)

    def at(self, x: ArrayLike, order: int = 0) -> Reals:
        """The lift (order 0) or a derivative at places in [0, 1], of any shape; at a joint of pieces the right one."""
        places = finite_array(x, message("places on a law"))
        values = np.zeros(places.shape)
        index = np.searchsorted([piece.start for piece in self.pieces[1:]], places, side="right")
        for k, piece in enumerate(self.pieces):
            values[index == k] = piece.at(places[index == k], order)
        return values

    @property
    def joints(self) -> tuple[float, ...]:
        """The places where its pieces begin and end."""
        return (*(piece.start for piece in self.pieces), 1.0)

    def end(self, order: int) -> float:
        """A derivative at x = 1."""
        return float(self.pieces[-1].at(np.array(1.0), order))

    def peaks(self) -> LawPeaks:
        """C_v, C_a, C_j and the peak of C_a C_v (the torque of a mass); without jumps of acceleration."""

        def greatest(function: Callable[[LawPiece, Reals], Reals]) -> float:
            spans = zip(self.pieces, self.joints, self.joints[1:], strict=False)
            piece_extremes = (extremes(partial(function, piece), a, b) for piece, a, b in spans)
            return max(abs(value) for places in piece_extremes for _, value in places)

        return LawPeaks(
            velocity=greatest(lambda piece, x: piece.at(x, 1)),
            acceleration=greatest(lambda piece, x: piece.at(x, 2)),
            jerk=greatest(lambda piece, x: piece.at(x, 3)),
            torque=greatest(lambda piece, x: piece.at(x, 1) * piece.at(x, 2)),
        )


def polynomial_law(*powers: int) -> MotionLaw:
    """The rest-to-rest polynomial with these powers: as many derivatives as possible vanish at both ends.

    For m powers, the lift at the end is 1 and its first m - 1 derivatives vanish there (at the beginning all below the
    lowest power do): coefficients c_i = prod over j != i of p_j / (p_j - p_i). 3-4-5 and 4-5-6-7 are the usual ones.

    >>> [round(c, 9) for c in polynomial_law(3, 4, 5).pieces[0].polynomial]
    [0.0, 0.0, 0.0, 10.0, -15.0, 6.0]
    """
    if not powers or any(not isinstance(p, int) or isinstance(p, bool) or not 1 <= p <= 15 for p in powers):
        raise CamError("a polynomial law has whole powers from 1 to 15, such as 3-4-5, not {powers!r}", powers=powers)
    if len(set(powers)) < len(powers):
        raise CamError("the powers of a polynomial law are different, not {powers!r}", powers=powers)
    polynomial = [0.0] * (max(powers) + 1)
    for p in powers:
        polynomial[p] = math.prod(q / (q - p) for q in powers if q != p)
    return MotionLaw("-".join(map(str, sorted(powers))), (LawPiece(start=0.0, polynomial=tuple(polynomial)),))


def boundary_law(start: Sequence[float], end: Sequence[float]) -> MotionLaw:
    """The polynomial of least degree with given lift, velocity, acceleration, ... at both ends (of the unit of angle).

    >>> [round(c, 9) for c in boundary_law((0, 0, 0), (1, 0, 0)).pieces[0].polynomial]
    [0.0, 0.0, 0.0, 10.0, -15.0, 6.0]
    """
    values = [*start, *end]
    if not start or not end or not all(isinstance(v, int | float) and math.isfinite(v) for v in values):
        raise CamError("boundary values are finite numbers: lift, then velocity, acceleration, ... at each end")
    if len(values) > 16:
        raise CamError("at most 16 boundary values are taken, not {count}", count=len(values))
    coefficients = _hermite([Fraction(v) for v in start], [Fraction(v) for v in end])
    return MotionLaw("polynomial", (LawPiece(start=0.0, polynomial=tuple(map(float, coefficients))),))


def _hermite(start: Sequence[Fraction], end: Sequence[Fraction]) -> list[Fraction]:
    """The polynomial of least degree with derivatives 0, 1, ... at 0 and at 1, in closed form; docs/theory/cams.md."""
    m, n = len(start), len(end)
    coefficients = [Fraction(0)] * (m + n)
    for k, value in enumerate(start):
        for j in range(m - k):
            for power, c in _bernstein(k + j, n):
                coefficients[power] += value / math.factorial(k) * math.comb(n - 1 + j, j) * c
    for k, value in enumerate(end):
        for j in range(n - k):
            for power, c in _bernstein(m, k + j):
                coefficients[power] += (-1) ** k * value / math.factorial(k) * math.comb(m - 1 + j, j) * c
    return coefficients


def _bernstein(power: int, complement: int) -> list[tuple[int, int]]:
    """The terms (power, coefficient) of t^power (1 - t)^other."""
    return [(power + i, (-1) ** i * math.comb(complement, i)) for i in range(complement + 1)]


def _from_acceleration(name: str, parts: Sequence[tuple[float, float, float, float, float]]) -> MotionLaw:
    """A law from its acceleration: parts (length, constant, amplitude, frequency, phase), integrated, scaled to 1."""
    pieces, start, lift, velocity = [], 0.0, 0.0, 0.0
    for length, constant, amplitude, frequency, phase in parts:
        wave = -amplitude / frequency**2 if frequency else 0.0
        piece = LawPiece(
            start=start, polynomial=(0.0, 0.0, constant / 2), amplitude=wave, frequency=frequency, phase=phase
        )
        begin = np.array(start)
        polynomial = (lift - float(piece.at(begin, 0)), velocity - float(piece.at(begin, 1)), constant / 2)
        pieces.append(replace(piece, polynomial=polynomial))
        start += length
        lift, velocity = (float(pieces[-1].at(np.array(start), order)) for order in (0, 1))
    return MotionLaw(
        name,
        tuple(
            replace(piece, polynomial=tuple(c / lift for c in piece.polynomial), amplitude=piece.amplitude / lift)
            for piece in pieces
        ),
    )


_QUARTER = math.pi / 2
# Parts of the acceleration, up to scale: length, constant, amplitude, frequency, phase.
_ACCELERATIONS = {
    "parabolic": ((0.5, 1, 0, 0, 0), (0.5, -1, 0, 0, 0)),
    "harmonic": ((1.0, 0, 1, math.pi, _QUARTER),),
    "cycloidal": ((1.0, 0, 1, math.tau, 0),),
    "modified-sine": (
        (1 / 8, 0, 1, 4 * math.pi, 0),
        (3 / 4, 0, 1, 4 * math.pi / 3, _QUARTER),
        (1 / 8, 0, -1, 4 * math.pi, _QUARTER),
    ),
    "modified-trapezoid": (
        (1 / 8, 0, 1, 4 * math.pi, 0),
        (1 / 4, 1, 0, 0, 0),
        (1 / 4, 0, 1, 4 * math.pi, _QUARTER),
        (1 / 4, -1, 0, 0, 0),
        (1 / 8, 0, -1, 4 * math.pi, _QUARTER),
    ),
}
_POLYNOMIALS = ("linear", "3-4-5", "4-5-6-7", "5-6-7-8-9")
_ALIASES = {
    "poly345": "3-4-5",
    "poly4567": "4-5-6-7",
    "sine": "cycloidal",
    "parabola": "parabolic",
    "modsine": "modified-sine",
    "modtrap": "modified-trapezoid",
    "uniform": "linear",
}

_TITLES = {
    "parabolic": message("parabolic"),
    "harmonic": message("harmonic"),
    "cycloidal": message("cycloidal"),
    "modified-sine": message("modified sine"),
    "modified-trapezoid": message("modified trapezoid"),
    "linear": message("linear"),
}
"""Of laws that are no polynomials by their powers, as VDI 2143 names them in German."""

LAWS = MappingProxyType({name: name for name in (*_ACCELERATIONS, *_POLYNOMIALS)} | _ALIASES)
"""Names of laws and their synonyms; any powers such as 3-4-5-6 also name a polynomial."""


@lru_cache(maxsize=64)
def motion_law(name: str) -> MotionLaw:
    """The law with a name: cycloidal (inclined sine), modified-sine, harmonic, 3-4-5, ...

    >>> motion_law("poly345") == motion_law("3-4-5")
    True
    """
    if not isinstance(name, str):
        raise CamError("a law has a name such as 3-4-5 or cycloidal, not {name!r}", name=name)
    known = LAWS.get(name.lower(), name.lower())
    if known in _ACCELERATIONS:
        return _from_acceleration(known, _ACCELERATIONS[known])
    if known == "linear":
        return replace(polynomial_law(1), name=known)
    parts = known.split("-")
    if all(part.isascii() and part.isdigit() and len(part) < 3 for part in parts):
        return polynomial_law(*map(int, parts))
    raise CamError("no law is called {word!r}: {known}{suggestion}", **unknown(name, LAWS))
