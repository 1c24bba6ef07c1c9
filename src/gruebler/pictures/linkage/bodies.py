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
from gruebler.mechanics.linkages import Element, Linkage, LinkPoint
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
from gruebler.pictures.canvas.symbols import FOOT, JointMember, joint_sign, pedestal, ticks
from gruebler.pictures.linkage.element_pictures import round_parts
from gruebler.pictures.linkage.posed_linkage import PosedLinkage

FRAME, BODIES, BLOCKS, PINS = range(4)
"""Layers, from below."""

_BLOCK = (14.0, 8.5)  # half sides of a block
_BARREL = 9.0  # half the width of a cylinder
_BEYOND = 5.0  # pixels by which a guide extends beyond the block
_SLOT_END = 9.0  # pixels by which a slot extends beyond the pin
_SLOT_HALF = 8.5  # half the width of a slot between rails
_RAIL = 2.5  # pixels between a block and its rail
_FLAT = 1e-6  # sizes: points nearer to a line lie on it
_LEAST_HEIGHT = 1e-3  # pixels: corners that are flatter are not seen
_CALLED_BLOCKS = ("block", "slider", "piston", "stein", "kolben")
_DISCS = 300.0  # pixels of cams and wheels
_STILL = 24.0  # pixels of a slide to both sides in a picture without a motion
_WIDEST = 520.0  # pixels of an outline
_LONGEST = 1.8  # times its shortest length: the largest length of a cylinder


@dataclass(frozen=True, slots=True)
class BodyPart:
    """Shapes of a link, in pixels and coordinates of the link."""

    layer: int
    link: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Slide:
    """The sign of a sliding joint."""

    joint: int
    guide: str
    block: str
    sign: str
    """``block``, ``slot`` (a pin in a slot) or ``cylinder``."""
    middle: complex
    """The middle of the block, in its own coordinates."""
    along: complex
    """The direction of the guide, in its coordinates."""
    low: complex
    """The ends of the path of the middle, in the guide's coordinates."""
    high: complex


class CarriedLine(NamedTuple):
    """A line that a link carries."""

    link: str
    points: tuple[complex, ...]
    """In coordinates of the link."""
    style: str = "help"


# --- sliding joints ------------------------------------------------------------------------------


def slides(posed: PosedLinkage) -> tuple[Slide, ...]:
    """The sliding joints, with the travel of their blocks on the path of the linkage."""
    chain = posed.lower.mechanism.chain
    return tuple(_slide(posed, k) for k, joint in enumerate(chain.joints) if joint.pair.is_sliding)


def _slide(posed: PosedLinkage, number: int) -> Slide:
    lower = posed.lower
    guide, block = _guide_and_block(posed, number)
    line, block_line = lower.elements[number, guide], lower.elements[number, block]
    middle = _foot(lower, block, block_line)
    start, along = complex(line.x, line.y), cmath.rect(1, line.direction)
    places = np.concatenate([_seen(motion, guide, block, middle) for motion in (posed.path, posed.pose)])
    offsets = ((places - start) * along.conjugate()).real
    low, high = float(offsets.min()), float(offsets.max())
    beyond = _beyond_roller(posed, block, block_line.direction, high - low)
    middle, low, high = middle + beyond * cmath.rect(1, block_line.direction), low + beyond, high + beyond
    sign = "block"
    if high - low < _FLAT * lower.size and len(posed.path) == 1:  # nothing moves in the picture: how far is not known
        low, high = low - _STILL / posed.scale, high + _STILL / posed.scale
    if block not in posed.linkage.mechanism.chain.links and pins_of(lower, block):
        sign = "slot"
    elif _is_cylinder(lower, number, guide, start, along, low, high):
        sign = "cylinder"
    return Slide(
        joint=number,
        guide=guide,
        block=block,
        sign=sign,
        middle=middle,
        along=along,
        low=start + low * along,
        high=start + high * along,
    )


def _beyond_roller(posed: PosedLinkage, block: str, along: float, travel: float) -> float:
    """How far a block stands off its pin, along its line, so that the guide ends before a roller on that pin."""
    linkage, pose = posed.linkage, posed.pose
    joints = linkage.mechanism.chain.joints
    if block not in linkage.mechanism.chain.links or len(pins_of(posed.lower, block)) != 1:
        return 0.0
    rollers = {link for joint in joints if block in joint.links and joint.pair.is_turning for link in joint.links}
    for number, joint in enumerate(joints):
        for roller in (rollers - {block, linkage.mechanism.frame}) & set(joint.links):
            wheel = linkage.elements[number, roller]
            partner = next(link for link in joint.links if link != roller)
            touched = linkage.elements[number, partner]
            if wheel.rim > 0 and partner != block:
                away = pose.complex_point(LinkPoint(roller, wheel.x, wheel.y))
                away = away - pose.complex_point(LinkPoint(partner, touched.x, touched.y))
                line = pose.turns[0, pose.link_index(block)] * cmath.rect(1, along)
                side = math.copysign(1.0, (complex(away[0]) * line.conjugate()).real)
                return side * (wheel.rim + travel + (_BLOCK[0] + 2 * _BEYOND) / posed.scale)
    return 0.0


def _guide_and_block(posed: PosedLinkage, number: int) -> tuple[str, str]:
    """The frame is the guide, a link that represents a pin in a slot is the block; else the one with fewer joints is.

    Of two equal links the one with a name such as "block" is the block, else the second.
    """
    mechanism, links = posed.lower.mechanism, posed.linkage.mechanism.chain.links
    chain = mechanism.chain

    def rank(link: str) -> tuple[bool, bool, int, bool]:
        joints = sum(link in joint.links for joint in chain.joints)
        points = sum(point.link == link for point in posed.lower.points.values())
        return (
            link not in links,
            link != mechanism.frame,
            -joints - points,
            any(name in link.lower() for name in _CALLED_BLOCKS),
        )

    first, second = sorted(chain.joints[number].links, key=rank)
    return first, second


def pins_of(lower: Linkage, link: str) -> list[complex]:
    """The pins of a link, in its coordinates."""
    elements = [e for (_, owner), e in lower.elements.items() if owner == link and e.is_pin]
    return [complex(e.x, e.y) for e in elements]


def _foot(lower: Linkage, link: str, line: Element) -> complex:
    """The middle of a block: its single pin if that is on its line, else the origin of the displacement."""
    start, pins = complex(line.x, line.y), pins_of(lower, link)
    if len(pins) != 1:
        return start
    along = cmath.rect(1, line.direction)
    return start + ((pins[0] - start) * along.conjugate()).real * along


def _seen(path: Motion, link: str, other: str, point: complex) -> np.ndarray:
    """A point of another link in coordinates of a link, along a path."""
    k, m = (path.link_index(name) for name in (link, other))
    place = path.places[0, :, m] + path.turns[:, m] * point
    relative: np.ndarray = (place - path.places[0, :, k]) * path.turns[:, k].conj()
    return relative


def _is_cylinder(
    lower: Linkage, number: int, guide: str, start: complex, along: complex, low: float, high: float
) -> bool:
    """Whether a driven slide between two moving links has the proportions of a cylinder with its rod."""
    mechanism = lower.mechanism
    if all(drive.joint != number for drive in mechanism.drives) or guide == mechanism.frame:
        return False
    pins = [(pin - start) * along.conjugate() for pin in pins_of(lower, guide)]
    if len(pins) != 1 or abs(pins[0].imag) > _FLAT * lower.size:
        return False
    distances = sorted(abs(end - pins[0].real) for end in (low, high))
    return (low - pins[0].real) * (high - pins[0].real) > 0 and distances[1] <= _LONGEST * distances[0]


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
    parts += [BodyPart(BODIES, frame, tuple(pedestal(posed.local(pin)))) for pin in hidden]
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
    lower = posed.lower
    nodes = pins_of(lower, link) + [complex(p.x, p.y) for p in lower.points.values() if p.link == link]
    nodes += [slide.middle for slide in joint_slides if slide.block == link and slide.sign != "cylinder"]
    for slide in joint_slides:
        if slide.guide == link and slide.sign != "cylinder":
            middle = sum(nodes) / len(nodes) if nodes else slide.low
            offset = ((middle - slide.low) * slide.along.conjugate()).real
            more = _reach(slide) / posed.scale
            nodes.append(slide.low + slide.along * min(max(offset, -more), abs(slide.high - slide.low) + more))
    flat = max(_FLAT * lower.size * posed.scale, _LEAST_HEIGHT)
    places = [posed.local(z) for z in nodes]
    hull = convex_hull([complex(round(p.x, 6), round(p.y, 6)) for p in places], flat)
    return tuple(Point(z.real, z.imag) for z in hull)


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
    return 0.0 if slide.sign == "slot" else _BLOCK[0] + _BEYOND


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
    at, u = posed.local(slide.middle), _along(posed, slide)
    if _outline_extent(posed, slide) is not None:
        return BodyPart(BLOCKS, slide.block, ())
    return BodyPart(BLOCKS, slide.block, (_box(at.plus(u, -_BLOCK[0]), at.plus(u, _BLOCK[0]), _BLOCK[1]),))


def _along(posed: PosedLinkage, slide: Slide) -> Point:
    """The direction of a slide in coordinates of its block, in pixels."""
    line = posed.lower.elements[slide.joint, slide.block]
    return Point(math.cos(line.direction), -math.sin(line.direction))


def _outline_extent(posed: PosedLinkage, slide: Slide) -> tuple[float, float] | None:
    """Half the length and half the width of a block that has an outline of its own; None without one."""
    at, u = posed.local(slide.middle), _along(posed, slide)
    outlines = posed.linkage.outlines.get(slide.block, ())
    corners = [posed.local(complex(*place)).minus(at) for o in outlines for place in o.places if len(o.places) > 2]
    if not corners:
        return None
    return max(abs(corner.dot(u)) for corner in corners), max(abs(corner.dot(u.across)) for corner in corners)


def _box(a: Point, b: Point, half: float) -> Polylines:
    side = b.minus(a).unit.across
    corners = a.plus(side, -half), b.plus(side, -half), b.plus(side, half), a.plus(side, half)
    return Polylines((corners,), "block", closed=True)


# --- the frame and the pins ----------------------------------------------------------------------


def _ground(posed: PosedLinkage, joint_slides: tuple[Slide, ...]) -> list[Shape]:
    """Rails with hatching along the guides of the frame, a pedestal below each of its pins.

    A block stands on one rail: what is hinged to it swings over the other side.
    """
    lower, frame = posed.lower, posed.lower.mechanism.frame
    shapes: list[Shape] = []
    for slide in joint_slides:
        if slide.guide == frame:
            long, wide = _outline_extent(posed, slide) or _BLOCK
            a, b = _guide_line(posed, slide, _SLOT_END if slide.sign == "slot" else long + _BEYOND)
            half = _SLOT_HALF if slide.sign == "slot" else wide + _RAIL
            sides = (b.minus(a).unit.across, a.minus(b).unit.across)
            for side in sides if slide.sign == "slot" else (max(sides, key=lambda side: (round(side.y, 9), side.x)),):
                rail = a.plus(side, half), b.plus(side, half)
                shapes += [Polylines((rail,), "rail"), ticks(*rail, side)]
    for outline in posed.linkage.outlines.get(frame, ()):
        if len(outline.places) == 2:
            a, b = (posed.local(complex(*place)) for place in outline.places)
            shapes.append(ticks(a, b, b.minus(a).unit.across))
    covered = set(_covered(posed, joint_slides))
    for pin in dict.fromkeys(pins_of(lower, frame)):
        if pin not in covered and not _in_frame(posed, pin):
            shapes += pedestal(posed.local(pin))
    return shapes


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
    covered = []
    for number, joint in enumerate(lower.mechanism.chain.joints):
        element = lower.elements.get((number, frame))
        if element is None or not element.is_pin:
            continue
        foot = complex(*posed.place(LinkPoint(frame, element.x, element.y))) + 0.5j * FOOT.y
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
