"""The symbols of joints in space after ISO 3952-1: sleeves on shafts, blocks on rods, balls in sockets, forks, plates.

A symbol is a list of parts, each on one link of the joint, and for each link the place where its bars end.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import cos, isfinite, pi, sin

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.crosses import UniversalCross
from gruebler.mechanics.screws.joint_places import JointPlace
from gruebler.pictures.space.parts import SpatialPart, across, ball, block, line, link_bar, sleeve, socket, wheel
from gruebler.structure.chain.pairs import Pair

_HALF, _RADIUS, _STOP = 11.0, 6.5, 19.0
_ROD = 30.0  # pixels of a rod beyond what slides on it
_THREAD = 5.0
_ON_AXIS = 1.0  # pixels from an axis
_BALL, _SOCKET = 6.5, 9.5
_FORK, _ARM = 14.0, 8.0
_WIDE = 34.0  # half the width of a fork about a cross that is a link, and its length
_PLATE, _GAP = 15.0, 3.0
_SMALL = 3.0  # a contour of a smaller radius is drawn as a ball
SPHERE = 130.0
"""Pixels: the radius of the sphere on which spherical linkages are drawn."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PlacedJoint:
    """A joint in pixels, in the reference pose."""

    pair: Pair
    links: tuple[str, ...]
    """The one on the shaft, or with the socket, first; the frame has the sleeve."""
    at: Reals
    axes: Reals
    """(3, 3): its axes as columns."""
    middles: Mapping[str, Reals]
    """The middle of each link."""
    place: JointPlace
    scale: float
    spherical: bool
    travel: tuple[float, float] = (0.0, 0.0)
    """Between which values it slides, in pixels."""

    def towards(self, link: str, normal: Reals | None = None) -> Reals:
        """The direction from the joint to the middle of a link, at right angles to a normal; of length 1."""
        heading = self.middles[link] - self.at
        if normal is not None:
            heading = heading - (heading @ normal) * normal
        size = float(np.linalg.norm(heading))
        if size > 1.0:
            return np.asarray(heading / size)
        return across(self.axes[:, 2] if normal is None else normal)[0]


@dataclass(frozen=True, eq=False, kw_only=True)
class SlidingRod:
    """A shaft or rod on which a sleeve slides: it is seen on both sides of the sleeve."""

    link: str
    sleeve: str
    """The link of the sleeve."""
    at: Reals
    axis: Reals
    outer: float
    """Half the length of the sleeve."""
    ends: tuple[float, float]
    """From the joint's place along the axis."""
    thread: bool

    def parts(self, shift: float = 0.0) -> list[SpatialPart]:
        """Its pieces with the sleeve shifted along the axis."""
        low, high = self.ends
        pieces = [(low, shift - self.outer), (shift + self.outer, high)]
        parts = [line(self.link, np.array([self.at + a * self.axis, self.at + b * self.axis])) for a, b in pieces]
        if self.thread:
            u = 1.2 * _THREAD * across(self.axis)[0]
            rows = [np.arange(a + 2.0, b - 2.0, 0.7 * _THREAD) for a, b in pieces if b - a > 3 * _THREAD]
            winding = [[self.at + s * self.axis + (u if k % 2 else -u) for k, s in enumerate(row)] for row in rows]
            parts += [line(self.link, np.array(points), "thread") for points in winding]
        return parts


@dataclass(frozen=True, eq=False, kw_only=True)
class Symbol:
    """The parts of a joint, and where the bars of its links end."""

    parts: list[SpatialPart]
    holds: dict[str, Reals]
    clear: dict[str, float] = field(default_factory=dict)
    """Pixels by which bars begin outside of these places."""
    rods: tuple[SlidingRod, ...] = ()
    axis: tuple[Reals, Reals] | None = None
    """The ends of the axis that is drawn."""


def _on_shaft(joint: PlacedJoint, stops: bool, thread: bool = False) -> Symbol:
    """A shaft in sleeves, one for each further link; the stops keep it from travelling."""
    z, first, others = joint.axes[:, 2], joint.links[0], joint.links[1:]
    half = _HALF if len(others) == 1 else 7.0
    middles = [joint.at + (2 * k - len(others) + 1) * (half + 1.0) * z for k in range(len(others))]
    parts = [sleeve(link, m - half * z, m + half * z, _RADIUS) for link, m in zip(others, middles, strict=True)]
    outer = len(others) * (half + 1.0) - 1.0
    rod = _rod_of(joint, z, outer, _STOP - _HALF if stops else (2 * _ROD if thread else _ROD) - _HALF, thread)
    if stops:
        parts += [sleeve(first, joint.at + (e - 1.5) * z, joint.at + (e + 1.5) * z, 5.0) for e in rod.ends]
    side = int((joint.middles[first] - joint.at) @ z >= 0)
    return Symbol(
        parts=parts,
        rods=(rod,),
        holds={first: joint.at + rod.ends[side] * z, **dict(zip(others, middles, strict=True))},
        clear=dict.fromkeys(others, _RADIUS),
        axis=(joint.at + (rod.ends[0] - 12.0) * z, joint.at + (rod.ends[1] + 12.0) * z),
    )


def _rod_of(joint: PlacedJoint, axis: Reals, outer: float, beyond: float, thread: bool = False) -> SlidingRod:
    low, high = joint.travel
    ends = (low - outer - beyond, high + outer + beyond)
    if thread:  # up to the bearing of the screw on its axis
        middle = joint.middles[joint.links[0]] - joint.at
        other = float(2.0 * middle @ axis)
        if np.linalg.norm(middle - (middle @ axis) * axis) < _ON_AXIS:
            ends = min(ends[0], other + _STOP), max(ends[1], other - _STOP)
    return SlidingRod(
        link=joint.links[0],
        sleeve=joint.links[1],
        at=joint.at,
        axis=axis,
        outer=outer,
        ends=ends,
        thread=thread,
    )


def _revolute(joint: PlacedJoint) -> Symbol:
    return _on_shaft(joint, stops=True)


def _cylindrical(joint: PlacedJoint) -> Symbol:
    return _on_shaft(joint, stops=False)


def _helical(joint: PlacedJoint) -> Symbol:
    return _on_shaft(joint, stops=False, thread=True)


def _prismatic(joint: PlacedJoint) -> Symbol:
    """Blocks on a rod without turning."""
    x, first, others = joint.axes[:, 0], joint.links[0], joint.links[1:]
    parts, holds = [], {}
    for k, link in enumerate(others):
        middle = joint.at + (2 * k - len(others) + 1) * (_HALF + 1.0) * x
        parts.append(block(link, middle, joint.axes, (_HALF, _RADIUS, _RADIUS)))
        holds[link] = middle
    rod = _rod_of(joint, x, len(others) * (_HALF + 1.0) - 1.0, _ROD - _HALF)
    holds[first] = joint.at + rod.ends[int((joint.middles[first] - joint.at) @ x >= 0)] * x
    return Symbol(parts=parts, rods=(rod,), holds=holds, clear=dict.fromkeys(others, _RADIUS))


def _spherical(joint: PlacedJoint) -> Symbol:
    """A ball in a socket; with more links, more sockets."""
    *sockets, last = joint.links
    parts, holds = [ball(last, joint.at, _BALL)], {last: joint.at}
    for k, link in enumerate(sockets):
        radius = _SOCKET + 3.0 * k
        heading = joint.towards(link)
        parts.append(socket(link, joint.at, heading, radius))
        holds[link] = joint.at + radius * heading
    return Symbol(parts=parts, holds=holds, clear={last: _BALL})


def _universal(joint: PlacedJoint) -> Symbol:
    """Two forks on a cross; its arms are the x axis of the first link and the y axis of the second."""
    parts, holds = [], {}
    directions: dict[str, Reals] = {}
    for link, arm in zip(joint.links, joint.axes[:, :2].T, strict=True):
        heading = joint.towards(link, arm)
        if directions:  # forks on opposite sides where the middles do not say
            other = next(iter(directions.values()))
            heading = heading if heading @ other < 0.9 else -heading
        directions[link] = heading
        ends = [joint.at - _ARM * arm, joint.at + _ARM * arm]
        feet = [end + _FORK * heading for end in ends]
        parts += [line(link, np.array(ends)), line(link, np.array([ends[0], feet[0]]))]
        parts += [line(link, np.array(feet)), line(link, np.array([ends[1], feet[1]]))]
        holds[link] = joint.at + _FORK * heading
    return Symbol(parts=parts, holds=holds)


def held_cross(joint: PlacedJoint, cross: UniversalCross, link: str, middle: Reals) -> Symbol:
    """A fork with two eyes about the arm of a link that is a cross."""
    assert cross.body is not None
    arm = joint.axes[:, 2]
    heading = joint.middles[link] - middle
    heading = heading - (heading @ arm) * arm
    size = float(np.linalg.norm(heading))
    heading = heading / size if size > 1.0 else next(other for of, (_, other) in cross.arms.items() if of != link)
    ends = [middle - _WIDE * arm, middle + _WIDE * arm]
    feet = [end + _WIDE * heading for end in ends]
    parts = [link_bar(cross.body, middle - (_WIDE + _STOP / 2) * arm, middle + (_WIDE + _STOP / 2) * arm)]
    parts += [link_bar(link, a, b) for a, b in ((ends[0], feet[0]), (feet[0], feet[1]), (feet[1], ends[1]))]
    parts += [sleeve(link, end - _HALF / 2 * arm, end + _HALF / 2 * arm, _RADIUS) for end in ends]
    return Symbol(parts=parts, holds={link: middle + _WIDE * heading, cross.body: middle})


def _planar(joint: PlacedJoint) -> Symbol:
    """Two plates on each other."""
    z = joint.axes[:, 2]
    turned = joint.axes[:, [2, 0, 1]]
    parts, holds = [], {}
    first, second = joint.links[:2]
    side = -1.0 if (joint.middles[first] - joint.middles[second]) @ z < 0 else 1.0
    for link, sign, size in ((first, side, _PLATE - 4.0), (second, -side, _PLATE)):
        middle = joint.at + sign * _GAP * z
        parts.append(block(link, middle, turned, (_GAP - 0.6, size, size)))
        holds[link] = middle + sign * _GAP * z
    return Symbol(parts=parts, holds=holds)


def _contact(joint: PlacedJoint) -> Symbol:
    """The wheels or contours of a higher pair: discs, in a plane or on cones; a flat one is a plate."""
    assert joint.place.radii is not None
    y, z = joint.axes[:, 1], joint.axes[:, 2]
    parts, holds = [], {}
    for link, radius, sign in zip(joint.links, joint.place.radii, (-1.0, 1.0), strict=True):
        if joint.spherical:
            axis = cos(radius) * z + sign * sin(radius) * y
            end = SPHERE * cos(radius) * axis
            parts.append(wheel(link, 0.82 * end, end, 0.82 * SPHERE * sin(radius), SPHERE * sin(radius)))
        elif not isfinite(radius):
            end = joint.at + sign * _GAP * y
            parts.append(block(link, end, joint.axes[:, [1, 2, 0]], (_GAP, 8.0, 2 * _PLATE)))
        elif abs(radius) * joint.scale < _SMALL:
            end = joint.at
            parts.append(ball(link, end, _SMALL))
        else:
            end = joint.at + sign * radius * joint.scale * y
            parts.append(wheel(link, end - 3.0 * z, end + 3.0 * z, abs(radius) * joint.scale))
        holds[link] = end
    return Symbol(parts=parts, holds=holds)


def _body_between(joint: PlacedJoint) -> Symbol:
    """A ball or roller between two links: a ball on a rail."""
    first, second = joint.links[:2]
    x = joint.axes[:, 0]
    rail = line(first, np.array([joint.at - _ROD * x, joint.at + _ROD * x]))
    return Symbol(
        parts=[rail, ball(second, joint.at, _BALL)],
        holds={first: joint.at - _ROD * x, second: joint.at},
        clear={second: _BALL},
    )


SOLIDS: Mapping[str, Callable[[PlacedJoint], Symbol]] = {
    "revolute": _revolute,
    "prismatic": _prismatic,
    "helical": _helical,
    "cylindrical": _cylindrical,
    "rolling": _contact,
    "roll_slide": _contact,
    "double_slide": _planar,
    "universal": _universal,
    "spherical": _spherical,
    "planar": _planar,
    "ball_groove": _body_between,
    "ball_cylinder": _body_between,
    "cylinder_plane": _body_between,
    "double_cylindrical": _body_between,
    "ball_plane": _body_between,
}
"""The symbol of each pair, by its name."""


def drive_arrow(joint: PlacedJoint, sight: Reals) -> tuple[Reals, Reals]:
    """An arrow in space around the axis of a turning drive or along that of a sliding one: its line, its head.

    That of a sliding one lies beside it as seen along the line of sight.
    """
    if joint.pair.motion[0].turns:
        z, radius = joint.axes[:, 2], 15.0
        u, v = across(z)
        middle = joint.at + (_STOP + 6.0) * z
        turns = np.linspace(0.0, 1.4 * pi, 24)[:, None]
        ring = middle + radius * (np.cos(turns) * u + np.sin(turns) * v)
        along = -np.sin(turns[-1]) * u + np.cos(turns[-1]) * v
        wide = np.cos(turns[-1]) * u + np.sin(turns[-1]) * v
    else:
        along = joint.axes[:, 0]
        wide = np.cross(along, sight)
        size = float(np.linalg.norm(wide))
        wide = joint.axes[:, 2] if size < _SMALL / SPHERE else wide / size
        ring = joint.at + 15.0 * wide + np.linspace(-18, 14, 2)[:, None] * along
    tip = ring[-1]
    return ring, np.array([tip + 7.0 * along, tip + 4.0 * wide, tip - 4.0 * wide])
