"""The followers of cams as moving bodies, and their guides."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from gruebler.base.arrays import Reals
from gruebler.machines.cams import Cam, Flat, Roller
from gruebler.pictures.canvas.moving_picture import Body, Shift, Turn
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape
from gruebler.pictures.canvas.symbols import ticks

_ROD = 7.0  # half the width of a rod, pixels
_BEYOND = 12.0  # pixels by which a face extends beyond its contacts
_THICK = 9.0  # pixels: a flat face
_WEDGE = Point(8.0, 20.0)
_GUIDE = Point(_ROD + 2.5, 34.0)  # half the width and the length of a guide
_FOOT = Point(11.0, 20.0)


def follower_body(cam: Cam, scale: float, phi: Reals) -> Body:
    """The follower at keys of the cam's angle (radians); ``scale`` is pixels to a unit."""
    s = cam.start + cam.lift.at(phi)
    if cam.follower.swings:
        side = math.copysign(1.0, cam.follower.distance)
        arm = tuple((math.pi - s if side > 0 else s).tolist())
        pivot = Shift((Point(scale * cam.follower.distance, 0.0),))
        return Body(tuple(_swinging(cam, scale, side)), (pivot, Turn(arm)))
    x = scale * cam.follower.offset
    return Body(tuple(_translating(cam, scale)), (Shift(tuple(Point(x, -scale * y) for y in s.tolist())),))


def _translating(cam: Cam, scale: float) -> list[Shape]:
    """A rod with its origin at the roller's centre, the edge or the face."""
    low = _travel(cam, scale)[0]
    top = -(_above(cam, scale) - low) - _GUIDE.y - 22.0  # the rod is longer than its guide in the lowest position
    return _TIPS[type(cam.follower)].of_rod(cam, cam.follower, scale, top)


def _swinging(cam: Cam, scale: float, side: float) -> list[Shape]:
    """An arm with its origin at the pivot, along its own x axis."""
    pin = CircleShape(Point(0.0, 0.0), 6.2, "joint")
    return [*_TIPS[type(cam.follower)].of_arm(cam, cam.follower, scale, side), pin]


def _rod_with_face(cam: Cam, _follower: Flat, scale: float, top: float) -> list[Shape]:
    face = cam.findings().face
    left, right = (scale * face[0].value - _BEYOND, scale * face[1].value + _BEYOND)
    return [_block(_box(-_ROD, _ROD, top, -_THICK)), _block(_box(left, right, -_THICK, 0.0))]


def _rod_with_roller(_cam: Cam, follower: Roller, scale: float, top: float) -> list[Shape]:
    r = scale * follower.radius
    if not r:
        edge = (Point(0, 0), Point(_ROD, -_WEDGE.y), Point(_ROD, top), Point(-_ROD, top), Point(-_ROD, -_WEDGE.y))
        return [_block(edge)]
    return [_block(_box(-_ROD, _ROD, top, 0.0)), *_roller(Point(0.0, 0.0), r)]


def _arm_with_face(cam: Cam, follower: Flat, scale: float, side: float) -> list[Shape]:
    face = scale * follower.face
    reach = scale * max(extremum.value for extremum in cam.findings().face) + _BEYOND
    # The face lies on the side of the cam, its body on the other: upwards for a pivot on the left.
    edge, far = (face, face - _THICK) if side < 0 else (-face, -face + _THICK)
    return [_block(_box(-_ROD, _ROD, *sorted((0.0, far)))), _block(_box(-_ROD, reach, *sorted((edge, far))))]


def _arm_with_roller(_cam: Cam, follower: Roller, scale: float, side: float) -> list[Shape]:
    length, r = scale * follower.arm, scale * follower.radius
    if not r:
        back = Point(length, side * _WEDGE.y)
        wedge = Point(length, 0.0), back.plus(Point(-1, 0), 7.0), back.plus(Point(1, 0), 7.0)
        return [_block(wedge), *_bar(Point(0.0, 0.0), back)]
    return [*_bar(Point(0.0, 0.0), Point(length, 0.0)), *_roller(Point(length, 0.0), r)]


class _Tip(NamedTuple):
    """What draws a kind of follower: of the cam, the follower, the scale, and the rod's top or the pivot's side."""

    of_rod: Callable[..., list[Shape]]
    of_arm: Callable[..., list[Shape]]


_TIPS = {Flat: _Tip(_rod_with_face, _arm_with_face), Roller: _Tip(_rod_with_roller, _arm_with_roller)}


def _roller(at: Point, r: float) -> list[Shape]:
    return [CircleShape(at, r, "node"), CircleShape(at, min(3.0, r / 2), "dot")]


def _bar(a: Point, b: Point) -> list[Shape]:
    return [Polylines(((a, b),), "outline-bar"), Polylines(((a, b),), "body-bar")]


def _box(left: float, right: float, top: float, bottom: float) -> tuple[Point, ...]:
    return Point(left, top), Point(right, top), Point(right, bottom), Point(left, bottom)


def _block(corners: tuple[Point, ...]) -> Polylines:
    return Polylines((corners,), "block", closed=True)


# --- fixed parts -----------------------------------------------------------------------------------


def ground(cam: Cam, scale: float) -> list[Shape]:
    """The guide of a rod, or the pedestal of a pivot."""
    if cam.follower.swings:
        at = Point(scale * cam.follower.distance, 0.0)
        left, right = (Point(at.x + side * _FOOT.x, _FOOT.y) for side in (-1, 1))
        return [Polylines(((at, left, right),), "block-frame", closed=True), ticks(left, right, Point(0.0, 1.0))]
    x, bottom = scale * cam.follower.offset, -_above(cam, scale)
    shapes: list[Shape] = []
    for side in (-1.0, 1.0):
        rail = Point(x + side * _GUIDE.x, bottom), Point(x + side * _GUIDE.x, bottom - _GUIDE.y)
        shapes += [Polylines((rail,), "rail"), ticks(*rail, Point(side, 0.0))]
    return shapes


def _travel(cam: Cam, scale: float) -> tuple[float, float]:
    """The lowest and the highest position of the follower's point above the axis, in pixels."""
    heights = [scale * (cam.start + value) for _, value in cam.lift.extremes(0)]
    return min(heights), max(heights)


def _above(cam: Cam, scale: float) -> float:
    """The height of the guide's lower end above the axis: above the roller or the face in the highest position."""
    return _travel(cam, scale)[1] + max(scale * cam.follower.radius, _WEDGE.y) + 8.0
