"""What is extreme in the motion of a crank linkage: limits of the crank, dead centres, transmission angles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from gruebler.errors import LinkageError
from gruebler.linkages.quantities import as_finite
from gruebler.text import Message, joined, joined_by_or, message

__all__ = [
    "CrankRange",
    "DeadCentre",
    "DeadCentres",
    "StrokeTimes",
    "Transmission",
    "TransmissionAngle",
    "cannot_assemble",
    "clipped_cosine",
    "crank_ranges",
    "triangle_angle",
]

TURN = 2 * math.pi
Mask = npt.NDArray[np.bool_]


class CrankRange(NamedTuple):
    """Crank angles from start to end, in the positive sense, in which a linkage can be assembled."""

    start: float
    end: float

    @property
    def full(self) -> bool:
        """Whether it is the whole circle."""
        return self.end - self.start >= TURN

    @property
    def width(self) -> float:
        """The angle from start to end."""
        return self.end - self.start

    def __contains__(self, phi: object) -> bool:
        return self.full or (as_finite("phi", phi) - self.start) % TURN <= self.width


def clipped_cosine(cosine: float) -> float:
    """A cosine or sine put right where rounding has carried it past 1.

    >>> clipped_cosine(1.0000000000000002)
    1.0
    """
    return max(-1.0, min(1.0, cosine))


def crank_ranges(a: float, d: float, least: float, most: float) -> tuple[CrankRange, ...]:
    """The crank angles for which A, at radius a about A0, lies between ``least`` and ``most`` from B0 = (d, 0)."""
    close = 1e-14 * (a + d)
    inner, outer = abs(d - a) >= least - close, a + d <= most + close
    if a + d < least - close or abs(d - a) > most + close:
        return ()
    first = 0.0 if inner else triangle_angle(a, d, least)
    last = math.pi if outer else triangle_angle(a, d, most)
    if inner and outer:
        return (CrankRange(0.0, TURN),)
    if inner:
        return (CrankRange(-last, last),)
    if outer:
        return (CrankRange(first, TURN - first),)
    return (CrankRange(first, last), CrankRange(TURN - last, TURN - first))


def triangle_angle(x: float, y: float, opposite: float) -> float:
    """The angle between the sides x and y of a triangle; right to rounding also where it is small or nearly flat.

    >>> math.degrees(triangle_angle(3, 4, 5))
    90.0
    """
    near = max(0.0, (opposite - x + y) * (opposite + x - y))
    far = max(0.0, (x + y - opposite) * (x + y + opposite))
    return 2 * math.atan2(math.sqrt(near), math.sqrt(far))


class StrokeTimes(NamedTuple):
    """How long the output takes at a constant speed of the crank, in seconds."""

    forward: float
    """From the inner to the outer dead centre."""
    back: float
    """From the outer to the inner dead centre."""

    @property
    def period(self) -> float:
        """One turn of the crank."""
        return self.forward + self.back

    @property
    def longest(self) -> float:
        """The slower of the two ways."""
        return max(self)

    @property
    def shortest(self) -> float:
        """The quicker of the two ways."""
        return min(self)

    @property
    def difference(self) -> float:
        """How much longer the slower way takes."""
        return self.longest - self.shortest


@dataclass(frozen=True, slots=True)
class DeadCentre:
    """A position in which the output turns back."""

    phi: float
    """The crank's angle, in 0..2 pi."""
    output: float
    """The output: its angle psi, or the slider's way s."""
    line: float
    """The direction of the coupler's line: from A0 to B for four-bar and slider-crank (there phi_i, phi_a)."""


@dataclass(frozen=True, slots=True)
class DeadCentres:
    """Both dead centres and how the crank's turn is divided between them."""

    inner: DeadCentre
    """Crank and coupler overlapping."""
    outer: DeadCentre
    """Crank and coupler stretched."""

    @property
    def travel(self) -> float:
        """How far the output goes: the slider's stroke, the rocker's swing."""
        return abs(self.outer.output - self.inner.output)

    @property
    def phi_forward(self) -> float:
        """The crank angle from the inner to the outer dead centre, in the positive sense."""
        return (self.outer.phi - self.inner.phi) % TURN

    @property
    def phi_back(self) -> float:
        """The crank angle from the outer to the inner dead centre, in the positive sense."""
        return TURN - self.phi_forward

    @property
    def phi_max(self) -> float:
        """The larger of the two."""
        return max(self.phi_forward, self.phi_back)

    @property
    def phi_min(self) -> float:
        """The smaller of the two."""
        return min(self.phi_forward, self.phi_back)

    @property
    def delta_phi(self) -> float:
        """By how much the larger is more than half a turn; 0 for a central linkage."""
        return (self.phi_max - self.phi_min) / 2

    @property
    def time_ratio(self) -> float:
        """The larger crank angle by the smaller, the ratio of times at constant speed; 1 for a central linkage."""
        return self.phi_max / self.phi_min

    def times(self, rpm: float) -> StrokeTimes:
        """The times of both ways in seconds at a speed in turns a minute; a negative one turns the other way."""
        speed = as_finite("rpm", rpm)
        if speed == 0:
            raise LinkageError("rpm must not be 0: a crank that stands still takes no time to speak of")
        angles = (self.phi_forward, self.phi_back) if speed > 0 else (self.phi_back, self.phi_forward)
        return StrokeTimes(*(angle / TURN * 60 / abs(speed) for angle in angles))


class Transmission(NamedTuple):
    """The transmission angle at one crank angle."""

    phi: float
    mu: float
    """The angle between coupler and output, in 0..pi."""

    @property
    def folded(self) -> float:
        """The transmission angle, at most pi/2."""
        return min(self.mu, math.pi - self.mu)

    @property
    def deviation(self) -> float:
        """The deviation angle alpha, pi/2 less the transmission angle."""
        return math.pi / 2 - self.folded


@dataclass(frozen=True, slots=True)
class TransmissionAngle:
    """Both extremes of the angle between coupler and output, and what follows for the transmission angle."""

    first: Transmission
    second: Transmission

    @property
    def worst(self) -> Transmission:
        """The extreme with the smaller transmission angle."""
        return min(self.first, self.second, key=lambda extreme: extreme.folded)

    @property
    def smallest(self) -> float:
        """The smallest transmission angle mu_min."""
        return self.worst.folded

    @property
    def largest(self) -> float:
        """The largest transmission angle: pi/2 if the angle passes through a right one."""
        low, high = sorted((self.first.mu, self.second.mu))
        return math.pi / 2 if low <= math.pi / 2 <= high else max(self.first.folded, self.second.folded)

    @property
    def largest_deviation(self) -> float:
        """The largest deviation angle alpha_max."""
        return self.worst.deviation

    def is_good(self, least: float = math.radians(40)) -> bool:
        """Whether it never falls below ``least``: by the rule of thumb, 40 degrees."""
        return self.smallest >= as_finite("least", least)


def cannot_assemble(arcs: Sequence[CrankRange], missing: Mask, undetermined: Mask, singular: Mask) -> Message | None:
    """What is said of poses and rates that are NaN; None if there are none."""
    parts = []
    if missing.any() and arcs:
        text = message("{count} of {poses} poses cannot be assembled: the crank angle must lie in {ranges}")
        ranges = joined_by_or(
            [message("{low:.6g}..{high:.6g} deg", low=math.degrees(a.start), high=math.degrees(a.end)) for a in arcs]
        )
        parts.append(text.filled(count=int(missing.sum()), ranges=ranges))
    elif missing.any():
        text = message("{count} of {poses} poses cannot be assembled: the linkage is not assemblable")
        parts.append(text.filled(count=int(missing.sum())))
    if undetermined.any():
        text = message("in {count} of {poses} poses A lies on B0 and the position is not determined")
        parts.append(text.filled(count=int(undetermined.sum())))
    if singular.any():
        text = message("in {count} of {poses} poses the crank does not determine the rates (transmission angle 0)")
        parts.append(text.filled(count=int(singular.sum())))
    return joined([part.filled(poses=missing.size) for part in parts], "; ") if parts else None
