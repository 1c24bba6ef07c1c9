"""What is extreme in the motion of a crank linkage: limits of the crank, dead centres, transmission angles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from gruebler.base.errors import LinkageError
from gruebler.base.events import DeadCentre, Transmission, TransmissionExtremes
from gruebler.base.text import Message, joined, joined_by_or, message
from gruebler.mechanics.linkages.quantities import as_finite

TURN = 2 * math.pi
_LEG = ("coupler",)
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

    @property
    def title(self) -> Message:
        """From where to where, in degrees."""
        if self.full:
            return message("full turn")
        return message("{start:n}°..{end:n}°", start=math.degrees(self.start), end=math.degrees(self.end))

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
    return mirrored_ranges(
        None if inner else triangle_angle(a, d, least), None if outer else triangle_angle(a, d, most)
    )


def mirrored_ranges(first: float | None, last: float | None) -> tuple[CrankRange, ...]:
    """The crank angles from ``first`` to ``last``, in 0..pi, and their mirror images; None is no limit on that side.

    >>> mirrored_ranges(None, 1.0)
    (CrankRange(start=-1.0, end=1.0),)
    """
    if last is None:
        return (CrankRange(0.0, TURN),) if first is None else (CrankRange(first, TURN - first),)
    if first is None:
        return (CrankRange(-last, last),)
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
class DeadCentres:
    """Both dead centres and how the crank's turn is divided between them."""

    inner: DeadCentre
    """Crank and coupler overlapping."""
    outer: DeadCentre
    """Crank and coupler stretched."""
    inner_line: float
    """The direction of the coupler's line in the inner one: from A0 to B for four-bar and slider-crank (phi_i)."""
    outer_line: float
    """The same in the outer one (phi_a)."""

    @classmethod
    def between(cls, inner: tuple[float, float, float], outer: tuple[float, float, float]) -> DeadCentres:
        """Both from crank angle, output and direction of the coupler's line.

        >>> both = DeadCentres.between((3.2, 4.0, 0.1), (0.2, 7.5, 0.2))
        >>> both.inner.kind, both.outer.kind
        ('minimum', 'maximum')
        """
        kinds = ("minimum", "maximum") if inner[1] < outer[1] else ("maximum", "minimum")
        near, far = (
            DeadCentre(drive=at[0], output=at[1], kind=kind, side=side)
            for at, kind, side in ((inner, kinds[0], "inner"), (outer, kinds[1], "outer"))
        )
        return cls(near, far, inner[2], outer[2])

    @property
    def travel(self) -> float:
        """How far the output goes: the slider's stroke, the rocker's swing."""
        return abs(self.outer.output - self.inner.output)

    @property
    def phi_forward(self) -> float:
        """The crank angle from the inner to the outer dead centre, in the positive sense."""
        return (self.outer.drive - self.inner.drive) % TURN

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
            raise LinkageError("rpm must not be 0: the times of a crank at rest are undefined")
        angles = (self.phi_forward, self.phi_back) if speed > 0 else (self.phi_back, self.phi_forward)
        return StrokeTimes(*(angle / TURN * 60 / abs(speed) for angle in angles))


def transmission_extremes(
    first: tuple[float, float], second: tuple[float, float], right: float = math.nan
) -> TransmissionExtremes:
    """The extremes of the transmission angle from the two of the angle between coupler and output, (phi, angle) each.

    If that angle passes through a right one between them, at the crank angle ``right``, that is the largest.

    >>> found = transmission_extremes((0.0, 1.0), (3.0, 1.8), 2.2)
    >>> found.smallest.mu, round(found.largest.mu, 6), found.largest.drive
    (1.0, 1.570796, 2.2)
    """
    extremes = [Transmission(*first, _LEG), Transmission(*second, _LEG)]
    if min(first[1], second[1]) < math.pi / 2 < max(first[1], second[1]):
        extremes.append(Transmission(right, math.pi / 2, _LEG))
    smallest, largest = (choice(extremes, key=lambda extreme: extreme.mu) for choice in (min, max))
    ordered = tuple(sorted(extremes, key=lambda extreme: extreme.drive))
    return TransmissionExtremes(extremes=ordered, smallest=smallest, largest=largest, legs=(_LEG,))


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
