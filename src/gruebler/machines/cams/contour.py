"""The motion of a follower on a given contour, with rates, from the contact and the curvature there.

A contour is anything with ``touch``, which gives the contacts with a follower at given angles of the cam. Rates follow
from the contact and the radius of curvature there; docs/theory/cams.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.immutable import settle
from gruebler.base.text import message
from gruebler.machines.cams.follower import Flat, Follower, Roller
from gruebler.machines.cams.laws import CamError, finite_array


class ContactSamples(NamedTuple):
    """Contacts at cam's angles: the follower's coordinate, and the contour's outward normal in the fixed frame.

    ``radius`` is the contour's radius of curvature at the contact: 0 at a corner, infinite on a straight line.
    ``along`` is its place on a flat face, from the foot of the normal through the axis.
    """

    coordinate: Reals
    normal: Complexes
    radius: Reals
    along: Reals


class FollowerMotion(NamedTuple):
    """The follower's coordinate (height of roller or face above the axis, or angle) with two derivatives per radian."""

    coordinate: Reals
    velocity: Reals
    acceleration: Reals


class Contour(Protocol):
    """A closed contour around the cam's axis."""

    def touch(self, follower: Follower, angle: Reals) -> ContactSamples:
        """The outermost contact at each angle."""
        ...


def follower_motion(contour: Contour, follower: Follower, angle: ArrayLike) -> FollowerMotion:
    """The motion of a follower on a contour, at cam's angles of any shape.

    Where the curvature jumps the acceleration is that of one side. Raises CamError if the follower misses the contour.

    >>> eccentric = ArcContour([ContourArc(0.0, 10 + 0j, 30.0)])
    >>> moved = follower_motion(eccentric, Flat(), [0.0, math.pi / 2])  # 30 + 10 sin(phi)
    >>> [values.round(9).tolist() for values in moved]
    [[30.0, 40.0], [10.0, 0.0], [0.0, -10.0]]
    """
    phi = finite_array(angle, message("the cam's angles"))
    touch = contour.touch(follower, phi.ravel())
    if not np.isfinite(touch.coordinate).all():
        lost = math.degrees(phi.ravel()[~np.isfinite(touch.coordinate)][0])
        raise CamError("the follower does not meet the contour at {lost:.6g} degrees", lost=lost)
    with np.errstate(divide="ignore", invalid="ignore"):
        rates = _roller_rates(follower, touch) if isinstance(follower, Roller) else _flat_rates(follower, touch)
    if not np.isfinite(rates).all():
        stuck = math.degrees(phi.ravel()[~np.isfinite(rates).all(axis=0)][0])
        raise CamError(
            "the follower jams at {stuck:.6g} degrees: the normal lies across its motion, or a corner", stuck=stuck
        )
    return FollowerMotion(*(values.reshape(phi.shape) for values in (touch.coordinate, *rates)))


def _roller_rates(roller: Roller, touch: ContactSamples) -> tuple[Reals, Reals]:
    """From c = e^(i phi) z(sigma), z the offset curve by arc length: c' = w s', c'' = w s'' + w2 s'^2."""
    path, n = roller.path(touch.coordinate), touch.normal
    bend = 1 / (touch.radius + roller.radius)
    along = np.real(np.conj(n) * path.first)
    first = np.real(np.conj(n) * 1j * path.at) / along
    sigma = np.real(np.conj(1j * n) * (path.first * first - 1j * path.at))
    normal_acceleration = np.real(np.conj(n) * (path.at + path.second * first**2))
    return first, -(normal_acceleration + 2 * sigma + bend * sigma**2) / along


def _flat_rates(flat: Flat, touch: ContactSamples) -> tuple[Reals, Reals]:
    """From the support function of the contour: p = dh/dtheta and radius = h + dp/dtheta."""
    line, p = flat.line(touch.coordinate), touch.along
    first = -p / (line.first - p * line.turn)
    turn = line.turn * first - 1
    return first, (line.second * first**2 * turn - (touch.radius - line.distance) * turn**3) / line.first


class ContourArc(NamedTuple):
    """A part of a convex contour: an arc about a centre (complex), its outward normals beginning at an angle.

    It ends where the next arc begins; a gap between the two is a straight line. Radius 0 is a corner.
    """

    start: float
    centre: complex
    radius: float


@dataclass(frozen=True, slots=True)
class ArcContour:
    """A convex contour of arcs and straight lines, counter-clockwise; every contact in closed form.

    >>> contour = ArcContour.hull([(0j, 20.0), (25 + 0j, 8.0)])
    >>> [(round(math.degrees(arc.start), 3), arc.radius) for arc in contour.arcs]
    [(-61.315, 8.0), (61.315, 20.0)]
    """

    arcs: tuple[ContourArc, ...]

    def __init__(self, arcs: Iterable[ContourArc]) -> None:
        settle(self, arcs=tuple(ContourArc(float(s), complex(c), float(r)) for s, c, r in arcs))
        if not self.arcs:
            raise CamError("a contour has at least one arc")
        for arc in self.arcs:
            if not all(map(math.isfinite, (arc.start, arc.centre.real, arc.centre.imag, arc.radius))) or arc.radius < 0:
                raise CamError("an arc has finite numbers and no negative radius, not {arc}", arc=tuple(arc))
        starts = [arc.start for arc in self.arcs]
        if any(b <= a for a, b in pairwise(starts)) or starts[-1] - starts[0] >= math.tau:
            raise CamError("the arcs of a contour follow one another counter-clockwise within one turn")
        scale = max(abs(arc.centre) + arc.radius for arc in self.arcs)
        for before, after in self._neighbours():
            gap = (after.centre - before.centre) * np.exp(-1j * after.start)
            if abs(gap.real + after.radius - before.radius) > 1e-9 * scale or gap.imag < -1e-9 * scale:
                degrees = math.degrees(after.start)
                raise CamError(
                    "the arcs that meet at the normal of {degrees:.6g} degrees have no common tangent there",
                    degrees=degrees,
                )

    def _neighbours(self) -> Iterator[tuple[ContourArc, ContourArc]]:
        return zip(self.arcs, (*self.arcs[1:], self.arcs[0]), strict=True)

    @classmethod
    def hull(cls, circles: Sequence[tuple[complex, float]]) -> ArcContour:
        """The convex hull of circles (centre, radius): two circles give a tangent cam."""
        if not circles:
            raise CamError("a contour around circles has at least one circle")
        finite_array([(c.real, c.imag, r) for c, r in circles], message("circles (centre, radius)"))
        angles: set[float] = set()
        for k, (m, r) in enumerate(circles):
            for n, q in circles[k + 1 :]:
                if abs(m - n) > abs(r - q):
                    half = math.acos((q - r) / abs(m - n))
                    angles |= {math.remainder(np.angle(m - n) + sign * half, math.tau) for sign in (-1, 1)}
        places = sorted(angles) or [0.0]
        arcs: list[ContourArc] = []
        for start, end in zip(places, [*places[1:], places[0] + math.tau], strict=True):
            direction = np.exp(-1j * (start + end) / 2)
            m, r = max(circles, key=lambda circle: (circle[0] * direction).real + circle[1])
            if not arcs or (arcs[-1].centre, arcs[-1].radius) != (m, r):
                arcs.append(ContourArc(start, m, r))
        if len(arcs) > 1 and arcs[0][1:] == arcs[-1][1:]:
            arcs = arcs[1:]
        return cls(arcs)

    def touch(self, follower: Follower, angle: Reals) -> ContactSamples:
        """The outermost contact at each angle; -inf where there is none."""
        turn = np.exp(1j * angle)
        outermost = ContactSamples(
            *(np.full(angle.shape, -np.inf, dtype=kind) for kind in (float, complex, float, float))
        )
        for arc, after in self._neighbours():
            span = (after.start - arc.start) % math.tau or math.tau
            for samples in _arc_contacts(follower, turn, arc):
                turned = np.mod(np.angle(samples.normal / turn) - arc.start + 1e-9, math.tau)
                outermost = _higher(outermost, samples, turned <= span + 2e-9)
            normal = complex(np.exp(1j * after.start))
            ends = arc.centre + arc.radius * normal, after.centre + after.radius * normal
            if isinstance(follower, Roller) and ends[0] != ends[1]:
                for samples, place in _line_contacts(follower, turn, ends, normal):
                    outermost = _higher(outermost, samples, (place >= -1e-9) & (place <= 1 + 1e-9))
        return outermost


def tangent_cam(base: float, nose: float, distance: float) -> ArcContour:
    """A base circle and a nose circle at a distance on the x axis, joined by straight flanks."""
    return ArcContour.hull([(0j, base), (complex(distance), nose)])


def _higher(outermost: ContactSamples, samples: ContactSamples, valid: NDArray[np.bool_]) -> ContactSamples:
    with np.errstate(invalid="ignore"):
        higher = valid & (samples.coordinate > outermost.coordinate)
    return ContactSamples(
        *(np.where(higher, candidate, current) for candidate, current in zip(samples, outermost, strict=True))
    )


def _arc_contacts(follower: Follower, turn: Complexes, arc: ContourArc) -> Iterator[ContactSamples]:
    """Contacts with the whole circle."""
    middle = arc.centre * turn
    radius = np.full(turn.shape, arc.radius)
    if isinstance(follower, Flat):
        s = face_coordinate(follower, middle, arc.radius)
        normal = np.exp(1j * follower.line(s).angle)
        yield ContactSamples(s, normal, radius, np.imag(np.conj(normal) * middle))
        return
    reach = arc.radius + follower.radius
    if reach > 0:
        for s in _guide_circle(follower, middle, reach):
            yield ContactSamples(s, (follower.path(s).at - middle) / reach, radius, np.zeros(turn.shape))


def face_coordinate(flat: Flat, point: Complexes, radius: float) -> Reals:
    """The coordinate at which the face touches a circle about a point."""
    if not flat.swings:
        return np.asarray(point.imag + radius)
    side, d = math.copysign(1.0, flat.distance), abs(flat.distance)
    lever = d - side * point.real + 1j * point.imag
    with np.errstate(invalid="ignore"):
        return np.asarray(np.angle(lever) + np.arcsin((flat.face + radius) / np.abs(lever)))


def _guide_circle(roller: Roller, middle: Complexes, reach: float) -> Iterator[Reals]:
    """The coordinates at which the roller's centre lies on a circle."""
    with np.errstate(invalid="ignore"):
        if not roller.swings:
            yield middle.imag + np.sqrt(reach**2 - (roller.offset - middle.real) ** 2)
            return
        lever = middle - roller.distance
        length = np.abs(lever)
        along = (roller.arm**2 - reach**2 + length**2) / (2 * length)
        across = np.sqrt(roller.arm**2 - along**2)
        for sign in (1j, -1j):
            yield arm_coordinate(roller, (along + sign * across) * lever / length)


def arm_coordinate(roller: Roller, arm: Complexes) -> Reals:
    """The coordinate of a swinging follower with this vector of its arm; NaN below the line of centres."""
    side = math.copysign(1.0, roller.distance)
    angle = -side * np.angle(-side * arm)
    return np.where(angle > 0, angle, np.nan)


def _line_contacts(
    roller: Roller, turn: Complexes, ends: tuple[complex, complex], normal: complex
) -> Iterator[tuple[ContactSamples, Reals]]:
    """Contacts with a straight line and their places on it, 0 to 1."""
    start, direction = (ends[0] + roller.radius * normal) * turn, (ends[1] - ends[0]) * turn
    flat, zero = np.full(turn.shape, np.inf), np.zeros(turn.shape)
    with np.errstate(invalid="ignore", divide="ignore"):
        if not roller.swings:
            place = (roller.offset - start.real) / direction.real
            yield ContactSamples((start + place * direction).imag, normal * turn, flat, zero), place
            return
        lever, length = start - roller.distance, abs(ends[1] - ends[0])
        foot = -np.real(np.conj(direction) * lever) / length**2
        across = np.sqrt(roller.arm**2 - np.abs(lever + foot * direction) ** 2) / length
        for place in (foot + across, foot - across):
            yield ContactSamples(arm_coordinate(roller, lever + place * direction), normal * turn, flat, zero), place
