"""Where a cam pushes its follower, along the motion, and its contour: docs/theory/events.md, "Transmission angle"."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.jets import turn_derivative
from gruebler.mechanics.kinematics.contours import cam_of
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.linkages.elements import CamDisc, Element
from gruebler.structure.assur import SolvedGroup

LinkPlace = tuple[str, complex, complex]
"""A joint on a link: the link, the point, the direction."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CamContact:
    """A cam on a link that moves, and what it pushes."""

    joint: int
    body: int
    """The number in its group of the body that is pushed."""
    cam: LinkPlace
    """Its axis."""
    follower: LinkPlace
    """The roller's centre, or the flat face."""
    flat: bool

    def reach(self, motion: Motion) -> Reals:
        """How far roller or face lie from the cam's axis: they rise with the lift; (rows,)."""
        gap = joint_motion(motion, self.follower)[0] - joint_motion(motion, self.cam)[0]
        face = motion.turns[:, motion.link_index(self.follower[0])] * self.follower[2]
        return np.abs((np.conj(face) * gap).imag) if self.flat else np.abs(gap)


def cam_contacts(plan: Plan, group: SolvedGroup) -> Iterator[CamContact]:
    """The cams on other links, but the frame, that push bodies of a group."""
    chain, elements = plan.lower.mechanism.chain, plan.lower.elements
    for number, member in group.joints:
        inside = [link for body in member.links for link in bodies_of(group)[body]]
        own = {link: elements.get((number, link)) for link in chain.joints[number].links}
        cams = [link for link, element in own.items() if type(element) in _CONTOURS and link not in inside]
        if member.outer and cams and cams[0] != plan.lower.mechanism.frame:
            cam, follower = link_place(plan, number, (cams[0],)), link_place(plan, number, tuple(inside))
            flat = plan.lower.elements[number, follower[0]].is_line
            yield CamContact(joint=number, body=member.links[0], cam=cam, follower=follower, flat=flat)


def bodies_of(group: SolvedGroup) -> list[tuple[str, ...]]:
    """The links of each body of a group, with those that it carries."""
    return [(*own, *carried) for own, carried in zip(group.bodies, group.carried, strict=True)]


def link_place(plan: Plan, joint: int, links: tuple[str, ...]) -> LinkPlace:
    """A joint on that of its links which is one of some."""
    link = next(link for link in plan.lower.mechanism.chain.joints[joint].links if link in links)
    e = plan.lower.elements[joint, link]
    return link, complex(e.x, e.y), complex(np.exp(1j * e.direction))


@dataclass(frozen=True, slots=True, kw_only=True)
class CamContour:
    """The radii of a cam, in the unit of its linkage."""

    link: str
    base: float
    """That of its base circle."""
    convex: float
    """The smallest radius of curvature where the contour is convex."""
    hollow: float | None
    """The smallest one where it is hollow: the greatest radius of a grinding wheel."""


def cam_contours(linkage: Linkage) -> tuple[CamContour, ...]:
    """Those of all its cams."""
    cams = [(link, e) for (_, link), e in linkage.elements.items() if type(e) in _CONTOURS]
    return tuple(_CONTOURS[type(e)](link, e) for link, e in cams)


def _disc_contour(link: str, disc: CamDisc) -> CamContour:
    report, scale = cam_of(disc).findings(), disc.scale
    assert report.convex is not None  # what closes around its axis is convex somewhere
    hollow = None if report.hollow is None else scale * report.hollow.value
    return CamContour(link=link, base=scale * disc.base, convex=scale * report.convex.value, hollow=hollow)


_CONTOURS: dict[type[Element], Callable[[str, Any], CamContour]] = {CamDisc: _disc_contour}
"""By the kind of an element: the contour with which it pushes a follower."""


class Push(NamedTuple):
    """The force on the follower and the point where it acts, with their derivatives; complex, (rows,)."""

    force: Complexes
    force_rate: Complexes
    at: Complexes
    velocity: Complexes


def roller_push(motion: Motion, cam: LinkPlace, roller: LinkPlace) -> Push:
    """At the roller's centre, normal to its path on the cam, which is the pitch curve; the motion is of order 2."""
    at, velocity, _ = joint_motion(motion, roller)
    slip, slip_rate = _against(motion, cam, roller)
    return Push(1j * slip, 1j * slip_rate, at, velocity)


def face_push(motion: Motion, cam: LinkPlace, face: LinkPlace) -> Push:
    """Normal to the face, through the relative pole of cam and follower: there the face slides along itself.

    At F + z t, with t along the face, the velocity against the cam is that at F and i w z t; w is the relative turning.
    """
    turn, turn_rate = (_turning(motion, face[0], k) - _turning(motion, cam[0], k) for k in (0, 1))
    along = motion.turns[:, motion.link_index(face[0])] * face[2]
    along_rate = turn_derivative(motion.rates[:, :, motion.link_index(face[0])], 1) * along
    origin, velocity, _ = joint_motion(motion, face)
    slip, slip_rate = _against(motion, cam, face)
    across, across_rate = 1j * along, 1j * along_rate
    lift = (np.conj(across) * slip).real
    lift_rate = (np.conj(across_rate) * slip + np.conj(across) * slip_rate).real
    z = -lift / turn
    z_rate = -(lift_rate + z * turn_rate) / turn
    return Push(across, across_rate, origin + z * along, velocity + z * along_rate + z_rate * along)


def joint_motion(motion: Motion, place: LinkPlace) -> tuple[Complexes, Complexes, Complexes]:
    """Position, velocity and acceleration of a joint on a link."""
    point = LinkPoint(place[0], place[1].real, place[1].imag)
    position, velocity, acceleration = (motion.complex_point(point, order=order) for order in range(3))
    return position, velocity, acceleration


def _turning(motion: Motion, link: str, order: int) -> Reals:
    return motion.rates[order, :, motion.link_index(link)]


def _against(motion: Motion, cam: LinkPlace, place: LinkPlace) -> tuple[Complexes, Complexes]:
    """The velocity of a joint against the cam, in the frame, and its derivative."""
    k = motion.link_index(cam[0])
    w, spin = (_turning(motion, cam[0], order) for order in (0, 1))
    origin, speed, change = (motion.places[m, :, k] for m in range(3))
    at, velocity, acceleration = joint_motion(motion, place)
    slip = velocity - speed - 1j * w * (at - origin)
    return slip, acceleration - change - 1j * spin * (at - origin) - 1j * w * (velocity - speed)
