"""Disc cams from a lift: profile, pressure angle, curvature, undercut; docs/theory/cams.md."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.events import Extremum
from gruebler.base.notebook import Drawn, brief
from gruebler.base.text import message
from gruebler.machines.cams.extremes import extremes
from gruebler.machines.cams.follower import Flat, Follower, Roller
from gruebler.machines.cams.laws import CamError, finite_array
from gruebler.machines.cams.lift import Lift


@dataclass(frozen=True, slots=True, kw_only=True)
class _Contact:
    """The contact in the cam's frame: contact point, curvature of the profile there, and signed pressure angle."""

    point: Complexes
    shape: Reals
    """For a roller the curvature of the pitch curve, for a face the radius of the profile: both without poles."""
    curvature: Reals
    pressure: Reals
    face: Reals
    """The place of the contact along a flat face, from the foot of the normal through the axis, or from the pivot."""
    centre: Complexes
    """The pitch curve: the roller's centre; for a face the contact itself."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CamReport:
    """The quality measures of a cam; extremes are exact, with one-sided values at jumps of acceleration."""

    pressure: tuple[Extremum, Extremum]
    """The least and the greatest signed pressure angle in radians: from the follower's motion to the normal."""
    convex: Extremum | None
    """The smallest radius of curvature where the profile is convex."""
    hollow: Extremum | None
    """The smallest radius of curvature where it is hollow, if it is: the greatest radius of a grinding wheel."""
    room: Extremum
    """Not positive: undercut. 1 - r k for a roller on a pitch curve of curvature k; for a face the radius."""
    face: tuple[Extremum, Extremum]
    """The length of a flat face that is needed to both sides (0 for rollers)."""

    @property
    def undercut(self) -> bool:
        """Whether the profile crosses itself, so that the follower cannot follow the lift."""
        return self.room.value <= 0


@door_that_raises(CamError)
@brief
@dataclass(frozen=True, slots=True, repr=False)
class Cam(Drawn):
    """A disc cam for a lift of a follower; the lift is a length, or radians for a swinging follower.

    >>> from gruebler.machines.cams import read_lift
    >>> cam = Cam(read_lift("rise 20 90; dwell 90; fall 20 90; dwell"), base=40, follower=Roller(10, offset=5))
    >>> report = cam.findings()
    >>> round(math.degrees(report.pressure[1].value), 3), round(report.convex.value, 3), report.undercut
    (17.693, 30.382, False)

    See Also:
        `draw`, `animate`, `Geneva`, `Train`

    Theory:
        docs/theory/cams.md
    """

    lift: Lift
    base: float
    follower: Follower

    def __post_init__(self) -> None:
        if isinstance(self.base, bool) or not isinstance(self.base, int | float) or not 1e70 > self.base > 0:
            raise CamError("the base circle has a positive radius below 1e70, not {base!r}", base=self.base)
        lowest = min(value for _, value in self.lift.extremes(0))
        highest = max(value for _, value in self.lift.extremes(0))
        if not self.follower.swings and highest - lowest > 1e9 * self.base:
            raise CamError(
                "a lift of {highest:g} is more than 1e9 times the base circle's {base:g}",
                highest=highest - lowest,
                base=self.base,
            )
        low, high = self.start + lowest, self.start + highest
        if not self.follower.swings and low <= 0:
            raise CamError("the lift goes down to {lowest:g}, beyond the cam's axis", lowest=lowest)
        limit = self.follower.largest_angle
        if self.follower.swings and not (low > 0 and high < limit):
            raise CamError(
                "the follower swings from {low:.6g} to {high:.6g} degrees against the line of centres; between 0 "
                "and {limit:g} is possible",
                low=math.degrees(low),
                high=math.degrees(high),
                limit=math.degrees(limit),
            )

    @property
    def start(self) -> float:
        """The follower's coordinate at lift 0."""
        return self.follower.coordinate(self.base + self.follower.radius)

    def profile(self, angle: ArrayLike) -> Reals:
        """The contact points in the cam's frame for cam's angles of shape (...): shape (..., 2)."""
        return _pairs(self._at(angle).point)

    def pitch(self, angle: ArrayLike) -> Reals:
        """The path of the roller's centre in the cam's frame, shape (..., 2); for a flat face the profile."""
        return _pairs(self._at(angle).centre)

    def pressure_angle(self, angle: ArrayLike) -> Reals:
        """Signed angle from the motion of the follower's point to the common normal, radians."""
        return self._at(angle).pressure

    def curvature(self, angle: ArrayLike) -> Reals:
        """Curvature of the profile at the contact, positive where convex; infinite at a cusp."""
        return self._at(angle).curvature

    def contact_on_face(self, angle: ArrayLike) -> Reals:
        """The place of the contact along a flat face (length)."""
        return self._at(angle).face

    def findings(self) -> CamReport:
        """All extremes over a turn."""

        def both(pick: Callable[[_Contact], Reals], scale: float = 0.0) -> tuple[Extremum, Extremum]:
            places: list[tuple[float, float]] = []
            for span in self.lift.spans():

                def value(phi: Reals, span: object = span) -> Reals:
                    return pick(self._contact(phi, *(order(phi) for order in span.orders[:3])))  # type: ignore[attr-defined]

                places += [(y, x) for x, y in extremes(value, span.start, span.end, scale)]
            (least, low_at), (most, high_at) = min(places), max(places)
            return Extremum(low_at, least, "minimum"), Extremum(high_at, most, "maximum")

        low, high = both(lambda contact: contact.shape)
        convex, hollow, room = _radii(self.follower, low, high)
        return CamReport(
            pressure=both(lambda contact: contact.pressure, scale=1.0),
            convex=convex,
            hollow=hollow,
            room=room,
            face=both(lambda contact: contact.face),
        )

    def _at(self, angle: ArrayLike) -> _Contact:
        phi = finite_array(angle, message("the cam's angles"))
        return self._contact(phi, *(self.lift.at(phi, order) for order in range(3)))

    def _contact(self, phi: Reals, s: Reals, s1: Reals, s2: Reals) -> _Contact:
        with np.errstate(divide="ignore", invalid="ignore"):
            if isinstance(self.follower, Roller):
                return _roller_contact(self.follower, phi, self.start + s, s1, s2)
            return _flat_contact(self.follower, phi, self.start + s, s1, s2)


def _radii(follower: Follower, low: Extremum, high: Extremum) -> tuple[Extremum | None, Extremum | None, Extremum]:
    """The least convex and hollow radius and the clearance, from the extremes of the shape."""
    if isinstance(follower, Flat):
        return (low if low.value > 0 else None), None, low
    # The radius 1 / k - r of the profile grows as the pitch curve's curvature k falls, on either side of k = 0.
    r, room = follower.radius, Extremum(high.at, 1 - follower.radius * high.value, "minimum")
    convex = Extremum(high.at, 1 / high.value - r, "minimum") if high.value > 0 and room.value > 0 else None
    hollow = Extremum(low.at, r - 1 / low.value, "minimum") if low.value < -1e-12 * abs(high.value) else None
    return convex, hollow, room


def _roller_contact(roller: Roller, phi: Reals, s: Reals, s1: Reals, s2: Reals) -> _Contact:
    path = roller.path(s)
    back = np.exp(-1j * phi)
    c, c1, c2 = path.at, path.first * s1, path.first * s2 + path.second * s1**2
    z, z1, z2 = c * back, (c1 - 1j * c) * back, (c2 - 2j * c1 - c) * back
    # The pitch curve is clockwise: its outward normal lies to the left of the tangent.
    normal = 1j * z1 / np.abs(z1)
    bend = -np.imag(np.conj(z1) * z2) / np.abs(z1) ** 3
    pressure = np.angle(normal / back / path.first)
    return _Contact(
        point=z - roller.radius * normal,
        shape=bend,
        curvature=bend / (1 - roller.radius * bend),
        pressure=pressure,
        face=np.zeros_like(s),
        centre=z,
    )


def _flat_contact(flat: Flat, phi: Reals, s: Reals, s1: Reals, s2: Reals) -> _Contact:
    line = flat.line(s)
    h, h1, h2 = line.distance, line.first * s1, line.first * s2 + line.second * s1**2
    turn, bend = line.turn * s1 - 1, line.turn * s2
    # Support function h(theta), theta the normal's angle in the cam's frame: p = dh/dtheta, radius = h + dp/dtheta.
    p = h1 / turn
    radius = h + (h2 * turn - h1 * bend) / turn**3
    normal = np.exp(1j * line.angle)
    contact = h * normal + 1j * p * normal
    lever = contact - flat.distance
    motion = -1j * math.copysign(1.0, flat.distance) * lever / np.abs(lever) if flat.swings else normal
    point = contact * np.exp(-1j * phi)
    along = np.real(contact) if not flat.swings else np.sqrt(np.maximum(np.abs(lever) ** 2 - flat.face**2, 0))
    # Where the face turns back against the cam there is no regular profile, whatever the radius.
    shape = np.where(turn < 0, radius, -np.abs(radius)) if flat.swings else radius
    return _Contact(
        point=point, shape=shape, curvature=1 / radius, pressure=np.angle(normal / motion), face=along, centre=point
    )


def _pairs(points: Complexes) -> Reals:
    return np.stack([points.real, points.imag], axis=-1)
