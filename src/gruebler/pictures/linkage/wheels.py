"""Shapes of the wheels, smooth circles, cams, Geneva and non-circular wheels of a linkage on their links."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from gruebler.mechanics.linkages import elements
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape
from gruebler.pictures.linkage.posed_linkage import PosedLinkage
from gruebler.pictures.machines.geneva_shape import GenevaShape

_RIM = 9.0  # pixels: the thickness of the rim of an internal wheel
_ARM = 0.8  # of the radius: the cross that shows the rotation of a wheel
_STEPS = 361  # points of the contour of a cam


class RoundPart(NamedTuple):
    """Shapes of a link, in pixels and coordinates of the link."""

    link: str
    shapes: tuple[Shape, ...]
    between: tuple[complex, complex] | None = None
    """Of a belt: the centres of its wheels, in the unit of the linkage; its shapes go with them."""


def round_parts(posed: PosedLinkage) -> Iterator[RoundPart]:
    """The round parts of a linkage, the larger first, each once for each link and centre."""
    parts: dict[tuple[object, ...], RoundPart] = {}
    for (joint, link), element in posed.linkage.elements.items():
        if isinstance(element, elements.RoundElement):
            key = (link, element.x, element.y, element.radius)
            parts.setdefault(key, _disc(posed, link, element))
        elif isinstance(element, elements.CamDisc):
            parts[link, joint] = RoundPart(link, tuple(_cam(posed, element)))
        elif isinstance(element, elements.NonCircular):
            parts[link, joint] = _noncircular(posed, joint, link, element)
        elif isinstance(element, elements.GenevaDriver | elements.GenevaWheel):
            parts[link, joint] = _geneva(posed, joint, link, element)
    for (joint, link), element in posed.linkage.elements.items():
        if isinstance(element, elements.Line) and (ends := _face(posed, joint, link, element)):
            parts[link, joint] = RoundPart(link, tuple(_flat(posed, link, element, ends)))
    yield from sorted(parts.values(), key=lambda part: -_size(part))
    yield from _belts(posed)


def _size(part: RoundPart) -> float:
    shape = part.shapes[0]
    if isinstance(shape, CircleShape):
        return shape.radius
    return max(math.hypot(p.x, p.y) for p in shape.parts[0]) if isinstance(shape, Polylines) else 0.0


def _disc(posed: PosedLinkage, link: str, element: elements.RoundElement) -> RoundPart:
    """A disc with a cross, or a ring for an internal wheel; fixed wheels in the style of the frame."""
    centre, radius = complex(element.x, element.y), posed.scale * abs(element.radius)
    at = posed.local(centre)
    style = "block-frame" if link == posed.linkage.mechanism.frame else "area"
    if element.radius < 0:
        rings = tuple(_ring(at, r)[:: 1 if r > radius else -1] for r in (radius + _RIM, radius))
        return RoundPart(link, (Polylines(rings, style, closed=True),))
    shapes: list[Shape] = [CircleShape(at, radius, style)]
    if isinstance(element, elements.Wheel) or radius > 12:
        arm = _ARM * radius
        cross = ((at.x - arm, at.y, at.x + arm, at.y), (at.x, at.y - arm, at.x, at.y + arm))
        shapes.append(Polylines(tuple((Point(a, b), Point(c, d)) for a, b, c, d in cross), "hatch"))
    return RoundPart(link, tuple(shapes))


def _face(posed: PosedLinkage, joint: int, link: str, line: elements.Line) -> tuple[float, float] | None:
    """The extent of a face or rack along its line where it touches a round part; None without one.

    The face of a swinging follower extends from its point to beyond the cam's axis.
    """
    for (number, owner), element in posed.linkage.elements.items():
        if number == joint and isinstance(element, elements.CamDisc):
            wide = 0.7 * element.base * element.scale
            if not element.distance:
                return -wide, wide
            k = posed.pose.link_index(link)
            axis = complex(posed.pose.complex_point(elements.LinkPoint(owner, element.x, element.y))[0])
            relative = (axis - posed.pose.places[0, 0, k]) / posed.pose.turns[0, k] - complex(line.x, line.y)
            offset = float((relative * cmath.rect(1, -line.angle)).real)
            return min(0.0, offset - wide), max(0.0, offset + wide)
        if number == joint and isinstance(element, elements.RoundElement):
            return -1.5 * abs(element.radius), 1.5 * abs(element.radius)
    return None


def _flat(posed: PosedLinkage, link: str, line: elements.Line, ends: tuple[float, float]) -> Iterator[Shape]:
    """A face or rack, and the rods that support it."""
    foot, along = complex(line.x, line.y), cmath.rect(1, line.angle)
    if link != posed.linkage.mechanism.frame:
        for (_, owner), other in posed.lower.elements.items():
            if owner == link and isinstance(other, elements.Pin | elements.Line):
                rod = (posed.local(foot), posed.local(complex(other.x, other.y)))
                yield from (Polylines((rod,), "outline-rod"), Polylines((rod,), "body-rod"))
    yield Polylines((tuple(posed.local(foot + offset * along) for offset in ends),), "rail")


def _ring(at: Point, radius: float) -> tuple[Point, ...]:
    count = max(36, min(144, round(radius)))
    turns = np.linspace(0, math.tau, count + 1)[:-1]
    return tuple(Point(at.x + radius * math.cos(t), at.y - radius * math.sin(t)) for t in turns)


def _contour(posed: PosedLinkage, centre: complex, angle: float, points: np.ndarray) -> tuple[Point, ...]:
    turn = cmath.rect(1, angle)
    return tuple(posed.local(centre + turn * complex(z)) for z in points)


def _cam(posed: PosedLinkage, disc: elements.CamDisc) -> Iterator[Shape]:
    """The profile of a cam, its base circle dashed."""
    from gruebler.mechanics.kinematics.contours import cam_of

    points = cam_of(disc).profile(np.linspace(0, math.tau, _STEPS)[:-1])
    centre, scaled = complex(disc.x, disc.y), disc.scale * (points[:, 0] + 1j * points[:, 1])
    yield Polylines((_contour(posed, centre, disc.angle, scaled),), "area", closed=True)
    yield CircleShape(posed.local(centre), posed.scale * disc.scale * disc.base, "dead")


def _noncircular(posed: PosedLinkage, joint: int, link: str, wheel: elements.NonCircular) -> RoundPart:
    """The curve of a non-circular wheel, with its direction from the axis."""
    from gruebler.mechanics.kinematics.noncircular import transfer_of

    of_joint = [(owner, e) for (number, owner), e in posed.linkage.elements.items() if number == joint]
    pair = [(owner, e) for owner, e in of_joint if isinstance(e, elements.NonCircular)]
    (near, non_circular), (far, other) = sorted(pair, key=lambda end: end[1].transfer == elements.INVERSE)
    near_axis, far_axis = (
        posed.pose.complex_point(elements.LinkPoint(owner, e.x, e.y))[0]
        for owner, e in ((near, non_circular), (far, other))
    )
    curve = transfer_of(non_circular, other).curves()[wheel is other] * abs(far_axis - near_axis)
    contour = _contour(posed, complex(wheel.x, wheel.y), wheel.angle, curve)
    ends = _contour(posed, complex(wheel.x, wheel.y), wheel.angle, np.array([0, _ARM * curve[0]]))
    style = "block-frame" if link == posed.linkage.mechanism.frame else "area"
    return RoundPart(link, (Polylines((contour,), style, closed=True), Polylines((ends,), "hatch")))


def _geneva(
    posed: PosedLinkage, joint: int, link: str, element: elements.GenevaDriver | elements.GenevaWheel
) -> RoundPart:
    """The driver's arm with its pins and locking disc, or the wheel with its slots."""
    from gruebler.machines.geneva import Geneva

    of_joint = {type(e): (owner, e) for (number, owner), e in posed.linkage.elements.items() if number == joint}
    (near, driver), (far, cross) = of_joint[elements.GenevaDriver], of_joint[elements.GenevaWheel]
    assert isinstance(driver, elements.GenevaDriver)
    assert isinstance(cross, elements.GenevaWheel)
    geneva = Geneva(cross.slots, internal=cross.internal, pins=driver.pins)
    shape = GenevaShape(geneva)
    ends = (elements.LinkPoint(owner, e.x, e.y) for owner, e in ((near, driver), (far, cross)))
    driver_axis, wheel_axis = (posed.pose.complex_point(end)[0] for end in ends)
    size, centre = abs(wheel_axis - driver_axis), complex(element.x, element.y)
    if isinstance(element, elements.GenevaWheel):
        contour = _contour(posed, centre, element.angle, shape.sign * size * shape.wheel())
        outer = (_ring(posed.local(centre), posed.scale * size * shape.rim), contour[::-1])
        return RoundPart(link, (Polylines(outer if cross.internal else (contour,), "area", closed=True),))
    shapes: list[Shape] = [
        Polylines((_contour(posed, centre, element.angle, size * lock),), "area", closed=True)
        for lock in shape.locking()
    ]
    pins = [
        centre + size * shape.crank * cmath.rect(1, element.angle + math.tau * k / driver.pins)
        for k in range(driver.pins)
    ]
    for pin in pins:
        bar = (posed.local(centre), posed.local(pin))
        shapes += [Polylines((bar,), "outline-bar"), Polylines((bar,), "body-bar")]
    shapes += [CircleShape(posed.local(pin), posed.scale * size * shape.pin, "node") for pin in pins]
    return RoundPart(link, tuple(shapes))


def _belts(posed: PosedLinkage) -> Iterator[RoundPart]:
    """The two straight runs of a belt whose wheels turn about points of the frame."""
    mechanism, link_elements = posed.linkage.mechanism, posed.linkage.elements
    fixed = {link for joint in mechanism.chain.joints if mechanism.frame in joint.links for link in joint.links}
    for number, joint in enumerate(mechanism.chain.joints):
        ends = [(link, link_elements[number, link]) for link in joint.links]
        wheels = [(link, e) for link, e in ends if isinstance(e, elements.Wheel) and e.belt and link in fixed]
        if len(wheels) != 2:
            continue
        (a, r), (b, s) = (
            (complex(posed.pose.complex_point(elements.LinkPoint(link, e.x, e.y))[0]), abs(e.radius))
            for link, e in wheels
        )
        crossed = wheels[0][1].belt == "crossed"
        along, gap = (b - a) / abs(b - a), abs(b - a)
        lean = math.acos(max(-1.0, min(1.0, (r + s if crossed else r - s) / gap)))
        runs = []
        for side in (1, -1):
            touch = along * cmath.rect(1, side * lean)
            runs.append((posed.local(a + r * touch), posed.local(b + (-s if crossed else s) * touch)))
        yield RoundPart(mechanism.frame, (Polylines(tuple(runs), "rail"),), (a, b))
