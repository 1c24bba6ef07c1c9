"""The bodies of the links of a linkage, each in its own coordinates: bars and polygons, blocks, guides, slots.

A picture transforms them to the pose of the links; an animation moves them unchanged.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gruebler.base.convex_hull import convex_hull
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import LinkPoint
from gruebler.pictures.canvas.free_space import distance_between, is_inside
from gruebler.pictures.canvas.shapes import (
    CircleShape,
    Point,
    Polylines,
    Shape,
    bounds,
    placed_shape,
)
from gruebler.pictures.canvas.styles import BAR
from gruebler.pictures.canvas.symbols import DOWN, FOOT, JointMember, joint_sign, pedestal, ticks
from gruebler.pictures.linkage.element_pictures import round_parts
from gruebler.pictures.linkage.posed_linkage import PosedLinkage
from gruebler.pictures.linkage.slides import BEYOND, BLOCK, FLAT, Slide, along_block, outline_extent, pins_of, slides

FRAME, BODIES, BLOCKS, PINS = range(4)
"""Layers, from below."""

_BARREL = 9.0  # half the width of a cylinder
_SLOT_END = 9.0  # pixels by which a slot extends beyond the pin
_SLOT_HALF = 8.5  # half the width of a slot between rails
_WALL = 1.2  # halves of its length by which a cylinder reaches beyond the middle of its piston
_RAIL = 2.5  # pixels between a block and its rail
_LEAST_HEIGHT = 1e-3  # pixels: corners that are flatter are not seen
_SIDES = (DOWN, Point(1.0, 0.0), Point(0.0, -1.0), Point(-1.0, 0.0))  # of pedestals, by right angles
_SELDOM = 0.05  # the part of the path in which what lies over a pedestal is no matter
_DISCS = 300.0  # pixels of cams and wheels
_WIDEST = 520.0  # pixels of an outline


@dataclass(frozen=True, slots=True)
class BodyPart:
    """Shapes of a link, in pixels and coordinates of the link."""

    layer: int
    link: str
    shapes: tuple[Shape, ...]


class CarriedLine(NamedTuple):
    """A line that a link carries."""

    link: str
    points: tuple[complex, ...]
    """In coordinates of the link."""
    style: str = "help"


# --- bodies --------------------------------------------------------------------------------------


def body_parts(posed: PosedLinkage) -> tuple[BodyPart, ...]:
    """All parts of the linkage, from the lowest layer up."""
    joint_slides = slides(posed)
    frame = posed.lower.mechanism.frame
    links = [link for link in posed.lower.mechanism.chain.links if link != frame]
    bodies = {link: _body(posed, link, joint_slides) for link in links}
    parts = [BodyPart(FRAME, part.link, part.shapes) for part in round_parts(posed)]
    parts += [BodyPart(FRAME, frame, tuple(_ground(posed, joint_slides)))]
    parts += [
        BodyPart(BODIES, link, tuple(bodies[link])) for link in sorted(links, key=lambda link: -_extent(bodies[link]))
    ]
    hidden = [pin for pin in _covered(posed, joint_slides) if not _in_frame(posed, pin)]
    sides = bearing_sides(posed)
    parts += [BodyPart(BODIES, frame, tuple(pedestal(posed.local(pin), sides[pin]))) for pin in hidden]
    parts += [_block(posed, slide) for slide in joint_slides if slide.sign != "slot"]
    parts += _pin_parts(posed)
    return tuple(part for part in parts if part.shapes)


def room_for(posed: PosedLinkage, outlines: Sequence[CarriedLine]) -> PosedLinkage:
    """The linkage in a scale in which no disc and none of the outlines it carries is too large for the picture."""
    spread = max((abs(z - points[0]) for _, points, _ in outlines for z in points), default=0.0)
    parts = () if posed.linkage.outlines else round_parts(posed)  # else discs are among outlines of any size
    discs = [shape for part in parts for shape in shapes_at_pose(posed, BodyPart(FRAME, part.link, part.shapes))]
    of_discs = max(bounds(discs, 0.0)[1]) if discs else 0.0
    scales = [_WIDEST / spread] if spread > 0 else []
    scales += [posed.scale * _DISCS / of_discs] if of_discs > 0 else []
    return replace(posed, scale=min([posed.scale, *scales]))


def outline_parts(posed: PosedLinkage, outlines: Sequence[CarriedLine]) -> tuple[BodyPart, ...]:
    """Outlines as parts that move with their links, above the bodies."""
    return tuple(
        BodyPart(BODIES, link, (Polylines((tuple(posed.local(z) for z in points),), style),))
        for link, points, style in outlines
    )


def corners_of(posed: PosedLinkage, link: str, joint_slides: tuple[Slide, ...]) -> tuple[Point, ...]:
    """The corners of a link's body: one, two for a bar, or those of a polygon; in its coordinates, in pixels."""
    nodes = _nodes(posed, link, joint_slides)
    for slide in joint_slides:
        if slide.guide == link and slide.sign != "cylinder":
            nodes.append(_nearest_of_guide(posed, slide, nodes))
    flat = max(FLAT * posed.lower.size * posed.scale, _LEAST_HEIGHT)
    places = [posed.local(z) for z in nodes]
    hull = convex_hull([complex(round(p.x, 6), round(p.y, 6)) for p in places], flat)
    return tuple(Point(z.real, z.imag) for z in hull)


def _nodes(posed: PosedLinkage, link: str, joint_slides: tuple[Slide, ...]) -> list[complex]:
    """The pins, points and blocks of a link."""
    nodes = pins_of(posed.lower, link) + [complex(p.x, p.y) for p in posed.lower.points.values() if p.link == link]
    return nodes + [slide.middle for slide in joint_slides if slide.block == link and slide.sign != "cylinder"]


def _nearest_of_guide(posed: PosedLinkage, slide: Slide, nodes: list[complex]) -> complex:
    """Where a guide is nearest to the middle of what else its link has."""
    middle = sum(nodes) / len(nodes) if nodes else slide.low
    offset = ((middle - slide.low) * slide.along.conjugate()).real
    more = _reach(slide) / posed.scale
    return slide.low + slide.along * min(max(offset, -more), abs(slide.high - slide.low) + more)


def guide_corners(posed: PosedLinkage) -> dict[str, complex]:
    """By links that are guides and more where they are joined to the guide."""
    joint_slides = slides(posed)
    return {
        slide.guide: _nearest_of_guide(posed, slide, _nodes(posed, slide.guide, joint_slides))
        for slide in joint_slides
        if slide.guide != posed.lower.mechanism.frame and _nodes(posed, slide.guide, joint_slides)
    }


def _body(posed: PosedLinkage, link: str, joint_slides: tuple[Slide, ...]) -> list[Shape]:
    """A bar or polygon through the joints, and bars for its guides; outlines first, so that they merge."""
    corners = corners_of(posed, link, joint_slides)
    outlines: list[Shape] = []
    fills: list[Shape] = []
    slots: list[Shape] = []
    if len(corners) > 1:
        suffix = "-bar" if len(corners) == 2 else ""
        outlines.append(Polylines((corners,), "outline" + suffix, closed=len(corners) > 2))
        fills.append(Polylines((corners,), "body" + suffix, closed=len(corners) > 2))
    for slide in joint_slides:
        if slide.sign == "cylinder":
            if link in (slide.guide, slide.block):
                line, wide = _cylinder(posed, slide, link)
                outlines.append(Polylines(line, f"outline-{wide}"))
                fills.append(Polylines(line, f"body-{wide}"))
        elif slide.guide == link:
            line = (_guide_line(posed, slide, _reach(slide)),)
            wide = "wide" if slide.sign == "slot" else "bar"
            outlines.append(Polylines(line, f"outline-{wide}"))
            fills.append(Polylines(line, f"body-{wide}"))
            if slide.sign == "slot":
                slots += [Polylines(line, "slot-rim"), Polylines(line, "slot")]
    return [*outlines, *fills, *slots]


def _reach(slide: Slide) -> float:
    """Pixels by which the bar of a guide extends beyond the path of the block's middle."""
    return 0.0 if slide.sign == "slot" else BLOCK[0] + BEYOND


def _guide_line(posed: PosedLinkage, slide: Slide, beyond: float) -> tuple[Point, Point]:
    more = max(beyond, 1.0) / posed.scale * slide.along
    return posed.local(slide.low - more), posed.local(slide.high + more)


def barrel(posed: PosedLinkage, slide: Slide) -> tuple[Point, Point]:
    """The middle line of a barrel: from near its pin to the end at the shortest length."""
    pin = posed.local(pins_of(posed.lower, slide.guide)[0])
    ends = sorted((posed.local(slide.low), posed.local(slide.high)), key=lambda end: end.minus(pin).length)
    along = ends[0].minus(pin)
    return pin.plus(along.unit, 11.0), pin.plus(along, 0.93)


def _cylinder(posed: PosedLinkage, slide: Slide, link: str) -> tuple[tuple[tuple[Point, ...]], str]:
    """The support of the barrel, or the rod from its pin into the barrel, long enough for the longest cylinder."""
    lower = posed.lower
    pin = pins_of(lower, slide.guide)[0]
    if link == slide.guide:
        return ((posed.local(pin), barrel(posed, slide)[0]),), "bar"
    line = lower.elements[slide.joint, link]
    forward = ((slide.low - pin) * slide.along.conjugate()).real > 0
    length = 0.9 * min(abs(slide.low - pin), abs(slide.high - pin)) * (-1 if forward else 1)
    return ((posed.local(slide.middle), posed.local(slide.middle + cmath.rect(length, line.direction))),), "rod"


def _extent(shapes: list[Shape]) -> float:
    points = [p for shape in shapes if isinstance(shape, Polylines) for part in shape.parts for p in part]
    return max((math.dist(a, b) for a in points for b in points), default=0.0)


def _block(posed: PosedLinkage, slide: Slide) -> BodyPart:
    """A rectangle: a block along its guide, or the barrel of a cylinder."""
    if slide.sign == "cylinder":
        a, b = barrel(posed, slide)
        return BodyPart(BLOCKS, slide.guide, (_box(a, b, _BARREL),))
    at, u = posed.local(slide.middle), along_block(posed, slide)
    if outline_extent(posed, slide) is not None:
        return BodyPart(BLOCKS, slide.block, ())
    return BodyPart(BLOCKS, slide.block, (_box(at.plus(u, -BLOCK[0]), at.plus(u, BLOCK[0]), BLOCK[1]),))


def _box(a: Point, b: Point, half: float) -> Polylines:
    side = b.minus(a).unit.across
    corners = a.plus(side, -half), b.plus(side, -half), b.plus(side, half), a.plus(side, half)
    return Polylines((corners,), "block", closed=True)


# --- the frame and the pins ----------------------------------------------------------------------


def _ground(posed: PosedLinkage, joint_slides: tuple[Slide, ...]) -> list[Shape]:
    """Rails with hatching along the guides of the frame, a pedestal below each of its pins.

    A block stands on one rail: what is hinged to it swings over the other side. One with an outline runs between two,
    as a piston does in its cylinder.
    """
    frame = posed.lower.mechanism.frame
    shapes: list[Shape] = []
    for slide in joint_slides:
        if slide.guide == frame:
            own = outline_extent(posed, slide)
            long, wide = own or BLOCK
            reach = _WALL * long if own else long + BEYOND
            a, b = _guide_line(posed, slide, _SLOT_END if slide.sign == "slot" else reach)
            half = _SLOT_HALF if slide.sign == "slot" else wide + _RAIL
            sides = (b.minus(a).unit.across, a.minus(b).unit.across)
            both = slide.sign == "slot" or own
            for side in sides if both else (max(sides, key=lambda side: (round(side.y, 9), side.x)),):
                rail = a.plus(side, half), b.plus(side, half)
                shapes += [Polylines((rail,), "rail"), ticks(*rail, side)]
    shapes += ground_hatching(posed)
    covered = set(_covered(posed, joint_slides))
    for pin, side in bearing_sides(posed).items():
        if pin not in covered and not _in_frame(posed, pin):
            shapes += pedestal(posed.local(pin), side)
    return shapes


def ground_hatching(posed: PosedLinkage) -> list[Polylines]:
    """Strokes on the lines that the frame has as outlines, such as a ground or the head of a cylinder."""
    outlines = [outline.places for outline in posed.linkage.outlines.get(posed.linkage.mechanism.frame, ())]
    lines = [[posed.local(complex(*place)) for place in places] for places in outlines if len(places) == 2]
    return [ticks(a, b, b.minus(a).unit.across) for a, b in lines]


def bearing_sides(posed: PosedLinkage) -> dict[complex, Point]:
    """By pins of the frame the side on which their pedestals stand, one for the whole path.

    Below, or away from what the links at the pin, and what slides in them, reach to. The page has the same rule
    (`explorer/src/ground.ts`).
    """
    lower, frame, joint_slides = posed.lower, posed.lower.mechanism.frame, slides(posed)
    links = lower.mechanism.chain.links
    reached = {link: _nodes(posed, link, joint_slides) for link in links}
    for slide in joint_slides:
        reached[slide.guide] += [slide.low, slide.high]
    beside = {link: {link} for link in links}
    for slide in joint_slides:
        beside[slide.guide].add(slide.block)
        beside[slide.block].add(slide.guide)
    sides: dict[complex, Point] = {}
    for number, joint in enumerate(lower.mechanism.chain.joints):
        pin = lower.elements.get((number, frame))
        if pin is None or not pin.is_pin:
            continue
        at = complex(pin.x, pin.y)
        near = {other for link in joint.links if link != frame for other in beside[link]} - {frame}
        places = [LinkPoint(link, z.real, z.imag) for link in sorted(near) for z in reached[link]]
        arms = np.array([posed.path.complex_point(place) - at for place in places]).ravel()
        arms = arms[np.abs(arms) > FLAT * lower.size]
        quarters = np.round(np.angle(1j * arms) / (np.pi / 2) + FLAT).astype(int) % len(_SIDES)
        over = np.bincount(quarters, minlength=len(_SIDES)).tolist()
        clear = over[0] <= max(2 * min(over), _SELDOM * len(arms))
        sides.setdefault(at, _SIDES[0 if clear else min((2, 1, 3), key=over.__getitem__)])
    return sides


def _in_frame(posed: PosedLinkage, pin: complex) -> bool:
    """Whether a pin of the frame lies in an outline of the frame, which supports it in the place of a pedestal."""
    outlines = (o.places for o in posed.linkage.outlines.get(posed.lower.mechanism.frame, ()) if len(o.places) > 2)
    return any(_inside(pin, [complex(*place) for place in places]) for places in outlines)


def _inside(place: complex, corners: Sequence[complex]) -> bool:
    return bool(is_inside(np.array([place]), np.array(corners))[0])


def _covered(posed: PosedLinkage, joint_slides: tuple[Slide, ...]) -> list[complex]:
    """The pins of the frame whose pedestals another link, no neighbour, would cover: they are drawn above it."""
    lower, frame = posed.lower, posed.lower.mechanism.frame
    joints = {link: set(lower.mechanism.chain.joints_of(link)) for link in lower.mechanism.chain.links}
    covered, sides = [], bearing_sides(posed)
    for number, joint in enumerate(lower.mechanism.chain.joints):
        element = lower.elements.get((number, frame))
        if element is None or not element.is_pin:
            continue
        side = sides[complex(element.x, element.y)]
        foot = complex(*posed.place(LinkPoint(frame, element.x, element.y)).plus(side, 0.5 * FOOT.y))
        for link in lower.mechanism.chain.links:
            if link == frame or joint in joints[link]:
                continue
            corners = [
                complex(*posed.place(LinkPoint(link, p.x / posed.scale, -p.y / posed.scale)))
                for p in corners_of(posed, link, joint_slides)
            ]
            bars = np.array([corners, corners[1:] + corners[:1]]) if len(corners) == 2 else np.empty((2, 0))
            crossed = distance_between(np.array([foot]), np.array([foot]), *bars) < (FOOT.y + BAR) / 2
            if crossed.any() or (len(corners) > 2 and _inside(foot, corners)):
                covered.append(complex(element.x, element.y))
                break
    return covered


def _pin_parts(posed: PosedLinkage) -> list[BodyPart]:
    """Turning joints, and dots for named points elsewhere."""
    lower = posed.lower
    parts, marked = [], set()
    for number, joint in enumerate(lower.mechanism.chain.joints):
        if not joint.pair.is_turning:
            continue
        link = min(joint.links, key=lambda member: member != lower.mechanism.frame)
        seen = ((member, lower.elements[number, member]) for member in joint.links)
        marked |= {(member, e.x, e.y) for member, e in seen}
        e = lower.elements[number, link]
        members = [JointMember(Point(1.0, 0.0))] * len(joint.links)
        parts.append(BodyPart(PINS, link, joint_sign(joint.pair, posed.local(complex(e.x, e.y)), members).above))
    for point in dict.fromkeys(lower.points.values()):
        if (point.link, point.x, point.y) not in marked:
            parts.append(BodyPart(PINS, point.link, (CircleShape(posed.local(complex(point.x, point.y)), 3.2, "dot"),)))
    return parts


# --- transformation to a pose ----------------------------------------------------------------------


def shapes_at_pose(posed: PosedLinkage, part: BodyPart, motion: Motion | None = None, row: int = 0) -> list[Shape]:
    """The shapes of a part in the pose of the linkage, or in a row of another motion."""
    poses = posed.pose if motion is None else motion
    k = posed.lower.mechanism.chain.index(part.link)
    turn, place = complex(poses.turns[row, k]), posed.local(complex(poses.places[0, row, k]))
    return [_put(shape, turn, place) for shape in part.shapes]


def layered(posed: PosedLinkage, pieces: Sequence[BodyPart], lowest: int, highest: int) -> list[Shape]:
    """The shapes of some layers in the pose of the linkage."""
    return [shape for part in pieces if lowest <= part.layer <= highest for shape in shapes_at_pose(posed, part)]


def in_link(posed: PosedLinkage, link: str, shapes: Sequence[Shape]) -> BodyPart:
    """Shapes given in the pose of the linkage, as a part that moves with a link above all others."""
    k = posed.lower.mechanism.chain.index(link)
    back = complex(posed.pose.turns[0, k]).conjugate()
    origin = _put(CircleShape(posed.local(complex(posed.pose.places[0, 0, k])), 0.0, "dot"), back, Point(0.0, 0.0))
    assert isinstance(origin, CircleShape)
    place = Point(-origin.at.x, -origin.at.y)
    return BodyPart(PINS + 1, link, tuple(_put(shape, back, place) for shape in shapes))


def _put(shape: Shape, turn: complex, place: Point) -> Shape:
    def put(p: Point) -> Point:
        return Point(place.x + turn.real * p.x + turn.imag * p.y, place.y - turn.imag * p.x + turn.real * p.y)

    return placed_shape(shape, put, cmath.phase(turn))
