"""Curvature of paths: inflection circle, Euler-Savary, centres of curvature. docs/theory/geometry.md."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.mechanics.geometry.relative import RelativeMotion, relative_motion
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import LinkPoint
from gruebler.mechanics.linkages.points import PointLike, point_name

_POINT = 1e-10  # sizes of the linkage: a smaller inflection circle is a point, its tangent unknown
_CUSP = 1e-10  # of the links' velocities: below it the point stands still and its path has no tangent


@compared_by_value
@dataclass(frozen=True, eq=False)
class InflectionCircle:
    """What the motion of a link against another one is at an instant, up to the second order.

    Points are x + iy in coordinates of the reference link (for the frame: of the plane); all arrays are (rows,).
    NaN where the links translate against one another: the pole is at infinity.
    """

    pole: Complexes
    shift: Complexes
    """dP/d theta: how the pole moves along the fixed centrode, per radian of the link's turn."""

    @property
    def diameter(self) -> Reals:
        """The diameter D of the inflection circle; 0 for a link that turns about a point at rest."""
        return np.abs(self.shift)

    @property
    def inflection_pole(self) -> Complexes:
        """W, opposite to the pole on the inflection circle: P - i dP/d theta."""
        return self.pole - 1j * self.shift

    @property
    def normal(self) -> Complexes:
        """The pole normal n: unit, from the pole to the inflection pole; NaN where they are one point."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.shift == 0, np.nan, -1j * self.shift / self.diameter)

    @property
    def tangent(self) -> Complexes:
        """The pole tangent t, unit: a quarter turn clockwise of the normal, so that t, n are axes x, y."""
        return -1j * self.normal

    def centre(self, point: Complexes | complex) -> Complexes:
        """The centre of curvature of the path of the point that is there now, by Euler and Savary; (rows,).

        Infinite for a point on the inflection circle; for the pole itself, which has a cusp, the pole.
        """
        ray = point - self.pole
        inner = (np.conj(ray) * -1j * self.shift).real
        square = np.abs(ray) ** 2
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(square == 0, self.pole, self.pole + ray * (inner / (inner - square)))


@compared_by_value
@dataclass(frozen=True, eq=False)
class PathCurvature:
    """The path of a point at each row, in coordinates of the reference link; all arrays are (rows,).

    NaN where the point is at rest (a cusp of its path).
    """

    point: Complexes
    tangent: Complexes
    """The unit vector along the velocity."""
    curvature: Reals
    """1/radius, positive where the path bends to the left."""
    change: Reals | None
    """The curvature's derivative along the way; None for a motion without jerks. Zero in a vertex, where a circle
    touches with four points."""

    @property
    def radius(self) -> Reals:
        """The signed radius of curvature; infinite in an inflection."""
        with np.errstate(divide="ignore"):
            return 1 / self.curvature

    @property
    def centre(self) -> Complexes:
        """The centre of curvature; infinite or NaN in an inflection."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.point + 1j * self.tangent / self.curvature


def inflection_circle(motion: Motion, link: str, reference: str | None = None) -> InflectionCircle:
    """Pole, inflection circle, pole tangent and normal of a link against another one (without a name: the frame).

    Needs a motion with accelerations. Error: that of the pole times the link's turn in the time of one radian.

    >>> from gruebler.mechanics.kinematics import move
    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> found = inflection_circle(move(SliderCrank(1, 1).linkage(), np.radians([20, 40]), speed=1), "coupler")
    >>> found.diameter.round(12).tolist()  # a Cardan circle: points on it move on straight lines
    [2.0, 2.0]
    """
    seen = relative_motion(motion, link, reference, order=2)
    pole = seen.pole
    (_, velocity, acceleration), (rate, angular) = seen.places, seen.rates
    with np.errstate(divide="ignore", invalid="ignore"):
        shift = velocity / rate + 1j * (acceleration - velocity * angular / rate) / rate**2
    shift = np.where(np.abs(shift) <= _POINT * seen.size, 0, shift)
    return InflectionCircle(pole, np.where(np.isfinite(pole), shift, np.nan))


def path_curvature(motion: Motion, point: PointLike, reference: str | None = None) -> PathCurvature:
    """Tangent, curvature and its change of the path of a named point, joint or `LinkPoint`, against a link.

    Needs a motion with accelerations.

    >>> from gruebler.mechanics.kinematics import move
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> motion = move(FourBar(25, 70, 40, 70).linkage(), np.radians([0, 55]), speed=10)
    >>> path_curvature(motion, "R(coupler-rocker)").centre.round(9).tolist()  # a circle about B0
    [(70+0j), (70+0j)]
    """
    place = _moving(motion, point, reference)
    seen = relative_motion(motion, place.link, reference, order=2 if motion.order < 3 else 3)
    arm = complex(place.x, place.y)
    at, velocity, acceleration = (seen.complex_point(arm, order=k) for k in range(3))
    speed = np.abs(velocity)
    speed = np.where(speed <= _CUSP * seen.swiftest, np.nan, speed)
    bend = (np.conj(velocity) * acceleration).imag
    with np.errstate(invalid="ignore"):
        return PathCurvature(at, velocity / speed, bend / speed**3, _change(seen, arm, speed, bend))


def _change(seen: RelativeMotion, arm: complex, speed: Reals, bend: Reals) -> Reals | None:
    """The derivative of bend/speed^3 in time, by the speed."""
    if len(seen.rates) < 3:
        return None
    velocity, acceleration, jerk = (seen.complex_point(arm, order=k) for k in (1, 2, 3))
    faster = (np.conj(velocity) * acceleration).real / speed
    change: Reals = ((np.conj(velocity) * jerk).imag - 3 * bend * faster / speed) / speed**4
    return change


def _moving(motion: Motion, name: PointLike, reference: str | None) -> LinkPoint:
    """The point as one of a link that is not the reference."""
    fixed = motion.linkage.mechanism.frame if reference is None else reference
    for place in reversed(motion.linkage.points_named(name)):
        if place.link != fixed or isinstance(name, LinkPoint):
            return place
    raise LinkageError(
        "the point {name!r} lies on {fixed!r}: it does not move against it", name=point_name(name), fixed=fixed
    )
