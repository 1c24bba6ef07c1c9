"""The bodies of higher pairs in structure pictures: wheels, racks, cams, rollers, Geneva drives, pins in slots.

Each is drawn from the point of contact, with the point at which a link holds it. On a bearing a round body has the size
that is given; elsewhere it has the size of a sign.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape

WHEEL = 12.0
"""Radius of wheels and cams in a sign, in pixels."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TouchingBody:
    """Where a body touches another one."""

    at: Point
    towards: Point
    """The common normal, into the body; of a ring away from its middle."""
    style: str
    size: float = 0.0
    """From the contact to the bearing, in pixels; 0: the size of a sign."""
    is_second: bool = False
    """Whether it is the second body of its joint, of two on bearings the larger one."""

    def middle(self, usual: float) -> Point:
        """The middle of a round body."""
        return self.at.plus(self.towards, self.size or usual)

    def rim(self, middle: Point, turn: float, along: float, across: float) -> Point:
        """A point about the middle, at an angle from the contact."""
        back = Point(-self.towards.x, -self.towards.y)
        return middle.plus(back, along * math.cos(turn)).plus(back.across, across * math.sin(turn))


_Part = tuple[Point, list[Shape]]


def _wheel(body: TouchingBody) -> _Part:
    """A smooth wheel: of a friction drive or a belt."""
    middle = body.middle(WHEEL)
    return middle, [CircleShape(middle, (body.size or WHEEL) - 0.7, body.style)]


def _gear(body: TouchingBody) -> _Part:
    """A toothed wheel with its pitch circle; a tooth of the first one meets a gap of the second one."""
    middle, radius = body.middle(WHEEL), body.size or WHEEL
    teeth = max(8, round(radius / (1.0 if radius <= WHEEL else 1.3)))
    deep = 2.0 if radius <= WHEEL else 2.8
    rim = []
    for k in range(teeth):
        for part, height in ((-0.3, -1.1 * deep), (-0.18, deep), (0.18, deep), (0.3, -1.1 * deep)):
            turn = math.tau * (k + part + (0.5 if body.is_second else 0.0)) / teeth
            rim.append(body.rim(middle, turn, radius + height, radius + height))
    return middle, [Polylines((tuple(rim),), body.style, closed=True), CircleShape(middle, radius, "pitch")]


def _ring_gear(body: TouchingBody) -> _Part:
    """An internal wheel around the other one, which lies on the far side of the contact; hatched if it is held."""
    radius = body.size or 1.6 * WHEEL
    middle = body.at.plus(body.towards, -radius)
    parts: list[Shape] = [
        CircleShape(middle, radius + 6.0, "ring-body"),
        CircleShape(middle, radius, "ring-hole"),
        CircleShape(middle, radius, "pitch"),
    ]
    if body.style == "block-frame":
        number = round(1.6 * (radius + 6.0) / 1.3)
        outer = [Point(math.cos(x), math.sin(x)) for x in (math.tau * k / number for k in range(number))]
        strokes = [(middle.plus(u, radius + 6), middle.plus(u, radius + 10).plus(u.across, 3)) for u in outer]
        parts.append(Polylines(tuple(strokes), "hatch"))
    return body.at.plus(body.towards, 3.0), parts


def _rack(body: TouchingBody) -> _Part:
    """A toothed rod along the common tangent."""
    at, towards, t = body.at, body.towards, body.towards.across
    top = [at.plus(t, -18 + 3.0 * k).plus(towards, 2.2 if k % 4 in (0, 3) else -1.6) for k in range(13)]
    foot = [at.plus(t, s * 18.0).plus(towards, 12.5) for s in (1, -1)]
    return at.plus(towards, 6.5), [Polylines(((*top, *foot),), body.style, closed=True)]


def _cam(body: TouchingBody) -> _Part:
    """A cam: an egg, its nose at the contact."""
    size = body.size / 1.35 if body.size else WHEEL
    middle = body.middle(1.35 * WHEEL)
    rim = []
    for k in range(72):
        turn = math.tau * k / 72
        radius = 0.85 * size + 0.5 * size * max(0.0, math.cos(turn)) ** 2
        rim.append(body.rim(middle, turn, radius, radius))
    return middle, [Polylines((tuple(rim),), body.style, closed=True)]


def _roller(body: TouchingBody) -> _Part:
    """A roller with its pin."""
    middle = body.middle(0.6 * WHEEL)
    disc = CircleShape(middle, (body.size or 0.6 * WHEEL) - 0.7, body.style if body.size else "joint")
    return middle, [disc] if body.size else [disc, CircleShape(middle, 1.8, "dot")]


def _flat(body: TouchingBody) -> _Part:
    """A flat face along the common tangent, thick enough to cover the end of its bar."""
    at, towards, t = body.at, body.towards, body.towards.across
    plate = tuple(at.plus(t, a * 15.0).plus(towards, b) for a, b in ((-1, 0.5), (1, 0.5), (1, 12.5), (-1, 12.5)))
    return at.plus(towards, 6.5), [Polylines((plate,), body.style, closed=True)]


def _geneva_driver(body: TouchingBody) -> _Part:
    """A disc with a pin; on a bearing the locking disc and an arm with the pin."""
    size = body.size or WHEEL + 3.0
    middle, pin = body.middle(size), body.at.plus(body.towards, 3.0)
    if not body.size:
        return middle, [CircleShape(middle, size - 3.0, body.style), CircleShape(pin, 3.0, "joint")]
    arm = [Polylines(((middle, pin),), style) for style in ("outline-bar", "body-bar")]
    return middle, [CircleShape(middle, 0.6 * size, body.style), *arm, CircleShape(pin, 4.5, "joint")]


def _geneva_wheel(body: TouchingBody) -> _Part:
    """A cross with four slots, one of them at the contact."""
    size = body.size or WHEEL
    middle = body.middle(WHEEL)
    slot = 5.5 / size if body.size else 0.2
    rim = []
    for k in range(4):
        u = Point(-body.towards.x, -body.towards.y)
        for _ in range(k):
            u = u.across
        v = u.across
        places = [(1, -0.35), (1, -slot), (0.3, -slot), (0.3, slot), (1, slot), (1, 0.35)]
        places += [(1 - 0.65 * math.sin(x), 1 - 0.65 * math.cos(x)) for x in (math.pi * k / 16 for k in range(1, 8))]
        rim += [middle.plus(u, a * size).plus(v, b * size) for a, b in places]
    return middle, [Polylines((tuple(rim),), body.style, closed=True)]


def _oval(body: TouchingBody) -> _Part:
    """A wheel that is not round: an ellipse about a focus, of the first one the near, of the second one the far one."""
    half = body.size / (1.3 if body.is_second else 0.7) if body.size else 0.0
    along, across = (half, 0.954 * half) if half else (0.8 * WHEEL, 1.25 * WHEEL)
    middle = body.at.plus(body.towards, along)
    rim = [body.rim(middle, math.tau * k / 72, along, across) for k in range(72)]
    return middle, [Polylines((tuple(rim),), body.style, closed=True)]


def _slot(body: TouchingBody) -> _Part:
    """A plate with a slot along the common tangent."""
    at, towards, t = body.at, body.towards, body.towards.across
    plate, slot = (
        tuple(at.plus(t, a * wide).plus(towards, b * half) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
        for wide, half in ((19.0, 8.0), (15.0, 4.2))
    )
    outer = Polylines((plate,), "ring-body", closed=True)
    return at.plus(towards, 6.0), [outer, Polylines((slot,), "ring-hole", closed=True)]


def _pin(body: TouchingBody) -> _Part:
    """A pin at the contact."""
    return body.at, [CircleShape(body.at, 4.0, "joint"), CircleShape(body.at, 1.6, "dot")]


CONTACTS: Mapping[str, Callable[[TouchingBody], _Part]] = {
    "gear": _gear,
    "ring": _ring_gear,
    "rack": _rack,
    "wheel": _wheel,
    "belt": _wheel,
    "crossed": _wheel,
    "cam": _cam,
    "roller": _roller,
    "flat": _flat,
    "geneva-driver": _geneva_driver,
    "geneva-wheel": _geneva_wheel,
    "oval": _oval,
    "slot": _slot,
    "pin": _pin,
}
"""What a body of a higher pair can be."""
