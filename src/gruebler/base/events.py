"""Special positions of a motion as values, the same whatever method found them: docs/theory/events.md.

Closed forms (`fourbar`), root finding along the drive (`analysis`), circuits followed by their arc (`kinematics`) and
cams (`cams`) all return these.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians

GOOD = radians(40)
"""The rule of thumb: the transmission angle should not fall below."""
JAMMING = radians(5)
"""Below this transmission angle friction and play may let a linkage jam, as beside a dead centre."""


@dataclass(frozen=True, slots=True)
class Extremum:
    """Where something is largest or smallest."""

    at: float
    """The place: the arc on a circuit, the angle of a cam in radians."""
    value: float
    kind: str
    """``maximum`` or ``minimum``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeadCentre:
    """Where the output stops: it turns back there, or (``flat``, not a maximum or minimum) only pauses."""

    drive: float
    """The drive's value; of full turns in 0 to the period."""
    output: float
    """The output's value: radians, or a length."""
    kind: str
    """``maximum`` or ``minimum`` of the output, or ``flat``: it goes on in the same direction."""
    side: str = ""
    """``inner`` or ``outer`` for the two extreme ones, else empty."""
    flat: bool = False
    """Whether the second derivative vanishes as well, so that the output dwells."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChangePoint:
    """Where two assembly modes meet and the motion goes on through: another curve of positions crosses."""

    drive: float
    """The drive's value; NaN without a drive."""
    links: tuple[str, ...] = ()
    """The group whose assembly modes meet; empty where the linkage was followed as a whole."""
    form: str = ""
    """The form of that group, such as ``RRR``."""
    several: bool = False
    """Whether more than two curves of positions meet there, or two that touch one another."""
    arc: float | None = None
    """The place on the circuit, if it was followed along one."""


@dataclass(frozen=True, slots=True)
class Transmission:
    """The transmission angle at one value of the drive."""

    drive: float
    angle: float
    """The angle between the line of the force and the path of the driven point, in 0..pi.

    For four-bars and slider-cranks that between coupler and output; a general linkage has no sign for it, so that it is
    at most pi/2.
    """
    links: tuple[str, ...]
    """The driving leg."""

    @property
    def mu(self) -> float:
        """The transmission angle mu, at most pi/2."""
        return min(self.angle, pi - self.angle)

    @property
    def deviation(self) -> float:
        """The deviation angle alpha, pi/2 less the transmission angle."""
        return pi / 2 - self.mu


@dataclass(frozen=True, slots=True, kw_only=True)
class TransmissionExtremes:
    """The extremes of the transmission angle.

    >>> worst, right = Transmission(0.0, radians(37), ("coupler",)), Transmission(1.4, pi / 2, ("coupler",))
    >>> TransmissionExtremes(extremes=(worst, right), smallest=worst, largest=right, legs=(("coupler",),)).good
    False
    """

    extremes: tuple[Transmission, ...]
    """All local extremes and the values at the ends of a range, leg by leg, in the order of the drive."""
    smallest: Transmission
    largest: Transmission
    """The largest for the leg that has the smallest."""
    legs: tuple[tuple[str, ...], ...]
    """The legs on the way from the drive to the output, from the output on; the smallest angle counts."""
    cams: tuple[tuple[str, ...], ...] = ()
    """Those of the legs that are cams: their deviation angle is the pressure angle."""
    undefined: tuple[str, ...] = ()
    """The links on that way in whose group no transmission angle is defined."""

    @property
    def good(self) -> bool:
        """Whether it nowhere falls below 40 degrees."""
        return self.smallest.mu >= GOOD
