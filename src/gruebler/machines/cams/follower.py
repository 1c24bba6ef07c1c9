"""Followers: their guide and the element that touches the cam; docs/theory/cams.md.

Points of the plane are complex numbers, the cam's axis is 0. A follower's coordinate is its height above the axis or
its angle (radians). The cam turns counter-clockwise; for the other sense use the mirror image: the opposite offset,
the pivot on the other side.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import ClassVar, NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.machines.cams.laws import CamError


class Path(NamedTuple):
    """A point of the follower as a function of its coordinate, with two derivatives."""

    at: Complexes
    first: Complexes
    second: Complexes


@dataclass(frozen=True, slots=True, kw_only=True)
class FaceLine:
    """The face: its normal's angle away from the cam, its distance from the axis, and their derivatives."""

    angle: Reals
    turn: float
    """Derivative of the angle by the coordinate: 0 for a translating face, -1 or 1 for a swinging one."""
    distance: Reals
    first: Reals
    second: Reals


def _check(follower: Roller | Flat) -> None:
    for field in fields(follower):
        value = getattr(follower, field.name)
        if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e70:
            raise CamError(
                "{name} of a follower: expected a number below 1e70, not {value!r}", name=field.name, value=value
            )


@dataclass(frozen=True, slots=True)
class Roller:
    """A roller, or a knife edge if the radius is 0.

    Without an arm it moves along the line x = offset; with an arm it swings about a pivot on the x axis at ``distance``
    (negative: on the left).
    """

    radius: float = 0.0
    offset: float = 0.0
    arm: float = 0.0
    distance: float = 0.0

    has_face: ClassVar[bool] = False
    largest_angle: ClassVar[float] = math.pi
    """To which it may swing."""

    def __post_init__(self) -> None:
        _check(self)
        if self.radius < 0 or self.arm < 0:
            raise CamError("radius and arm of a follower are not negative: {follower}", follower=self)
        if (self.arm == 0) != (self.distance == 0) or (self.arm and self.offset):
            raise CamError("a swinging follower has an arm and a distance of its pivot, and no offset")

    @property
    def swings(self) -> bool:
        """Whether its coordinate is an angle."""
        return self.arm != 0

    def coordinate(self, radius: float) -> float:
        """The coordinate at which the centre has a distance from the axis."""
        if not self.swings:
            if abs(self.offset) >= radius:
                raise CamError(
                    "the offset {offset:g} must be smaller than base radius and roller together, {radius:g}",
                    offset=self.offset,
                    radius=radius,
                )
            return math.sqrt(radius**2 - self.offset**2)
        d = abs(self.distance)
        cosine = (self.arm**2 + d**2 - radius**2) / (2 * self.arm * d)
        if not -1 < cosine < 1:
            raise CamError(
                "arm {arm:g}, pivot distance {distance:g} and base circle {radius:g} form no triangle",
                arm=self.arm,
                distance=d,
                radius=radius,
            )
        return math.acos(cosine)

    def gain(self, start: float, lift: Reals) -> Reals:
        """The increase of the square of the centre's distance from the axis by a lift; without cancellation."""
        if not self.swings:
            return np.asarray(lift * (2 * start + lift))
        return np.asarray(4 * self.arm * abs(self.distance) * np.sin(start + lift / 2) * np.sin(lift / 2))

    def reach(self, s: Reals) -> Reals:
        """The distance of the centre from the axis."""
        return np.abs(self.path(s).at)

    def bearing(self, s: Reals) -> tuple[Reals, Reals]:
        """The direction of the centre as seen from the axis, and its derivative by the coordinate."""
        path = self.path(s)
        return np.angle(path.at), np.imag(path.first / path.at)

    def path(self, s: Reals) -> Path:
        """The centre."""
        if not self.swings:
            zero: Complexes = np.zeros(np.shape(s), dtype=np.complex128)
            return Path(zero + self.offset + 1j * s, zero + 1j, zero)
        side = math.copysign(1.0, self.distance)
        arm = np.asarray(-side * self.arm * np.exp(-1j * side * s), dtype=np.complex128)
        return Path(np.asarray(self.distance + arm), np.asarray(-1j * side * arm), -arm)


@dataclass(frozen=True, slots=True)
class Flat:
    """A flat face across the motion; or, with a pivot on the x axis at ``distance``, one that swings.

    ``face`` is the distance of the swinging face from its pivot, towards the cam.
    """

    distance: float = 0.0
    face: float = 0.0

    has_face: ClassVar[bool] = True
    largest_angle: ClassVar[float] = math.pi / 2
    radius: ClassVar[float] = 0.0
    offset: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        _check(self)
        if self.face and not self.swings:
            raise CamError("only a swinging flat follower has a face apart from its pivot")

    @property
    def swings(self) -> bool:
        """Whether its coordinate is an angle."""
        return self.distance != 0

    def coordinate(self, radius: float) -> float:
        """The coordinate at which the face touches a circle about the axis."""
        if not self.swings:
            return radius
        if not abs(radius + self.face) < abs(self.distance):
            raise CamError(
                "a face {face:g} from its pivot at {distance:g} reaches no circle of {radius:g}",
                face=self.face,
                distance=self.distance,
                radius=radius,
            )
        return math.asin((radius + self.face) / abs(self.distance))

    def gain(self, start: float, lift: Reals) -> Reals:
        """The increase of the face's distance from the axis by a lift; without cancellation."""
        if not self.swings:
            return np.asarray(lift)
        return np.asarray(2 * abs(self.distance) * np.cos(start + lift / 2) * np.sin(lift / 2))

    def reach(self, s: Reals) -> Reals:
        """The distance of the face from the axis."""
        return self.line(s).distance

    def bearing(self, s: Reals) -> tuple[Reals, Reals | float]:
        """The direction of the face's normal, and its derivative by the coordinate."""
        line = self.line(s)
        return line.angle, line.turn

    def line(self, s: Reals) -> FaceLine:
        """The face."""
        if not self.swings:
            ones = np.ones_like(s)
            return FaceLine(angle=math.pi / 2 * ones, turn=0.0, distance=s, first=ones, second=0 * ones)
        side, d = math.copysign(1.0, self.distance), abs(self.distance)
        return FaceLine(
            angle=math.pi / 2 - side * s,
            turn=-side,
            distance=d * np.sin(s) - self.face,
            first=d * np.cos(s),
            second=-d * np.sin(s),
        )


Follower = Roller | Flat
