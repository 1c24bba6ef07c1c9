"""The signs of joints, links, frames and drives at given places, for structure and scale pictures.

The sign of a joint, for its place and the directions of its links, consists of the shapes below and above the links and
of the point at which each link is attached. Signs: docs/theory/drawing.md.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from gruebler.pictures.canvas.contacts import CONTACTS, WHEEL, TouchingBody
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape, TextShape
from gruebler.pictures.canvas.styles import BAR
from gruebler.structure.chain.pairs import Pair

RADIUS = 6.2
"""Of a turning joint."""
FOOT = Point(13.0, 21.0)
"""Half the width and the height of a pedestal."""
DOWN = Point(0.0, 1.0)
_RING = 3.6
_BLOCK = Point(12.5, 7.0)
_GUIDE = Point(20.0, 10.0)
_DISC = 8.0
_HATCH = 6.0
_STEEP = 0.35  # of 1: hatching leaves its line at this angle's sine at least


@dataclass(frozen=True, slots=True)
class JointMember:
    """A link at a joint: the direction in which it lies, and whether it is the frame."""

    towards: Point
    is_frame: bool = False
    centre: Point | None = None
    """Of a round body that has a bearing: its place."""
    is_new: bool = True
    """Whether the round body is not drawn at another joint."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JointSign:
    """The sign of a joint."""

    below: tuple[Shape, ...]
    above: tuple[Shape, ...]
    holds: tuple[Point, ...]
    """The point of attachment of each member."""
    axis: Point
    """The direction of sliding, or the common tangent; for turning joints without meaning."""
    reach: float
    """The greatest distance of the sign from its middle."""
    wheels: tuple[tuple[float, tuple[Shape, ...]], ...] = ()
    """Round bodies on their bearings, below all links, with their sizes: the larger ones are drawn first."""


def joint_sign(
    pair: Pair, at: Point, members: Sequence[JointMember], *, letter: str = "", shapes: Sequence[str] = ()
) -> JointSign:
    """The sign of a pair; a letter where the pair has no sign of its own in the plane.

    ``shapes`` says for each member of a higher pair what it is, by the keys of `CONTACTS`; without them the sign is the
    general one of the pair.
    """
    if len(shapes) == len(members) == 2 and {*shapes} <= {*CONTACTS}:
        return _contact(at, members, shapes)
    if letter or pair.name not in SIGNS:
        return _lettered(at, members, letter)
    return SIGNS[pair.name](at, members)


def _turning(at: Point, members: Sequence[JointMember]) -> JointSign:
    """An open circle; one ring more for each link beyond two."""
    rings = len(members) - 2
    radius = RADIUS + _RING * rings
    above = (CircleShape(at, radius, "joint"), *(CircleShape(at, RADIUS + _RING * k, "ring") for k in range(rings)))
    return JointSign(below=(), above=above, holds=(at,) * len(members), axis=Point(1, 0), reach=radius)


def _lettered(at: Point, members: Sequence[JointMember], letter: str) -> JointSign:
    """A circle with the symbol of the pair, wide enough for it; one ring more for each link beyond two."""
    inner = 5.0 + 3.6 * max(1, len(letter))
    rings = range(len(members) - 2)
    above = [
        CircleShape(at, inner + _RING * len(rings), "joint"),
        *(CircleShape(at, inner + _RING * k, "ring") for k in rings),
    ]
    return JointSign(
        below=(),
        above=(*above, TextShape(at, letter, "letter")),
        holds=(at,) * len(members),
        axis=Point(1, 0),
        reach=inner + _RING * len(rings),
    )


def _sliding(at: Point, members: Sequence[JointMember]) -> JointSign:
    """A block in a guide; the guide belongs to the first member (the frame, if it is one), the block to the others."""
    u = members[0].towards.unit
    u = Point(-u.x, -u.y)
    v = u.across
    back = at.plus(u, -_GUIDE.x)
    hold = back.plus(u, -BAR / 2)
    corners = [back.plus(v, s * _GUIDE.y) for s in (-1, 1)]
    ends = [corner.plus(u, 2 * _GUIDE.x) for corner in corners]
    below: list[Shape] = [Polylines(((ends[0], corners[0], corners[1], ends[1]),), "rail")]
    if members[0].is_frame:
        below += [ticks(corners[0], ends[0], Point(-v.x, -v.y)), ticks(corners[1], ends[1], v)]
    style = "block-frame" if members[1].is_frame else "block"
    block = tuple(at.plus(u, a * _BLOCK.x).plus(v, b * _BLOCK.y) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    above: list[Shape] = [Polylines((block,), style, closed=True)]
    for k in range(len(members) - 2):
        part = 1 - (k + 1) / (len(members) - 1)
        above.append(Polylines((tuple(at.plus(p.minus(at), part) for p in block),), "ring", closed=True))
    return JointSign(
        below=tuple(below), above=tuple(above), holds=(hold,) + (at,) * (len(members) - 1), axis=u, reach=_GUIDE.x
    )


def _double_slide(at: Point, members: Sequence[JointMember]) -> JointSign:
    """A plate with a cross: it slides in two directions."""
    half = 10.0 + _RING * (len(members) - 2)
    square = tuple(Point(at.x + a * half, at.y + b * half) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    h = 6.5
    cross = ((Point(at.x - h, at.y), Point(at.x + h, at.y)), (Point(at.x, at.y - h), Point(at.x, at.y + h)))
    above = (Polylines((square,), "joint", closed=True), Polylines(cross, "ring"))
    return JointSign(below=(), above=above, holds=(at,) * len(members), axis=Point(1, 0), reach=half)


def _normal(members: Sequence[JointMember]) -> Point:
    """From the first member to the second: the common normal of a contact."""
    return members[1].towards.unit.minus(members[0].towards.unit).unit


def _rolling(at: Point, members: Sequence[JointMember]) -> JointSign:
    """Two discs that touch."""
    n = _normal(members)
    middles = (at.plus(n, -_DISC), at.plus(n, _DISC))
    above = tuple(
        CircleShape(middle, _DISC - 0.5, "block-frame" if member.is_frame else "block")
        for middle, member in zip(middles, members, strict=True)
    )
    return JointSign(below=(), above=above, holds=middles, axis=n.across, reach=2 * _DISC)


def _roll_slide(at: Point, members: Sequence[JointMember]) -> JointSign:
    """A disc on a flat; the flat belongs to the first member."""
    n = _normal(members)
    t = n.across
    flat = tuple(at.plus(t, a * 14.0).plus(n, b) for a, b in ((-1, -7.0), (1, -7.0), (1, -0.5), (-1, -0.5)))
    middle = at.plus(n, _DISC)
    styles = ["block-frame" if member.is_frame else "block" for member in members]
    above = (Polylines((flat,), styles[0], closed=True), CircleShape(middle, _DISC - 0.5, styles[1]))
    return JointSign(below=(), above=above, holds=(at.plus(n, -5.0), middle), axis=t, reach=2 * _DISC)


def _contact(at: Point, members: Sequence[JointMember], shapes: Sequence[str]) -> JointSign:
    """Two bodies that touch, each as what it is: wheels, cam and roller, driver and cross, pin and slot.

    A body whose centre is given is as large as its distance, and lies below the links.
    """
    to_centre = [None if member.centre is None else member.centre.minus(at) for member in members]
    n = _normal(members)
    for side, arm in zip((-1.0, 1.0), to_centre, strict=True):
        n = n if arm is None else Point(side * arm.unit.x, side * arm.unit.y)
    sizes = [0.0 if arm is None else arm.length for arm in to_centre]
    belt = "belt" in shapes or "crossed" in shapes
    apart = 0.0 if not belt else _BELT * min(sizes) if all(sizes) else 5.0
    holds: list[Point] = []
    above: list[Shape] = []
    wheels: list[tuple[float, tuple[Shape, ...]]] = []
    for number, (shape, member, arm, size) in enumerate(zip(shapes, members, to_centre, sizes, strict=True)):
        side = -1.0 if number == 0 else 1.0
        towards = Point(n.x * side, n.y * side) if arm is None else arm.unit
        if arm is not None and shape == "ring":
            towards = Point(-towards.x, -towards.y)
        is_second = number == 1 if abs(sizes[0] - sizes[1]) < 1e-6 * sum(sizes) else size == max(sizes)
        style = "block-frame" if member.is_frame else "block"
        body = TouchingBody(
            at=at.plus(towards, apart),
            towards=towards,
            style=style,
            size=max(0.0, size - apart),
            is_second=is_second,
        )
        hold, parts = CONTACTS[shape](body)
        holds.append(hold)
        if arm is None:
            above += parts
        elif member.is_new:
            wheels.append((size, tuple(parts)))
    if belt:
        radius = min(sizes) - apart if all(sizes) else WHEEL
        turn = -1.0 if "crossed" in shapes else 1.0
        t = n.across
        above.append(
            Polylines(
                tuple((holds[0].plus(t, s * radius), holds[1].plus(t, turn * s * radius)) for s in (1, -1)), "edge"
            )
        )
    # Rings and slots lie below what runs in them.
    above.sort(key=lambda shape: _DOWN.get(shape.style, len(_DOWN)))
    return JointSign(
        below=(),
        above=tuple(above),
        holds=tuple(holds),
        axis=n.across,
        reach=2 * WHEEL + apart,
        wheels=tuple(wheels),
    )


_DOWN = {"ring-body": 0, "ring-hole": 1}
_BELT = 0.4  # of half the distance of two bearings: between a wheel of a belt and the middle


SIGNS = {
    "revolute": _turning,
    "prismatic": _sliding,
    "double_slide": _double_slide,
    "rolling": _rolling,
    "roll_slide": _roll_slide,
}
"""The sign of each pair that exists in the plane, by its name."""


def bar(points: Sequence[Point], *, is_frame: bool = False, halo: bool = False) -> list[Shape]:
    """A link of even width along points; a halo separates it from shapes that it crosses."""
    line = (tuple(points),)
    kind = "frame-bar" if is_frame else "body-bar"
    shapes: list[Shape] = [Polylines((_shortened(points),), "halo-bar")] if halo else []
    shapes += [Polylines(line, "outline-bar"), Polylines(line, kind)]
    return [*shapes, _bar_hatching(points)] if is_frame else shapes


def _shortened(points: Sequence[Point]) -> tuple[Point, ...]:
    """A line shortened at both ends so that its halo does not cover the shapes that meet there."""
    first, last = points[1].minus(points[0]), points[-2].minus(points[-1])
    ends = [
        points[0].plus(first.unit, min(16.0, first.length / 3)),
        points[-1].plus(last.unit, min(16.0, last.length / 3)),
    ]
    return (ends[0], *points[1:-1], ends[1])


def polygon(corners: Sequence[Point], *, is_frame: bool = False, halo: bool = False) -> list[Shape]:
    """A link with three joints or more: a shaded polygon with rounded corners."""
    line = (tuple(corners),)
    shapes: list[Shape] = [Polylines(line, "halo", closed=True)] if halo else []
    shapes += [Polylines(line, "outline", closed=True), Polylines(line, "frame" if is_frame else "body", closed=True)]
    return [*shapes, hatching(corners)] if is_frame else shapes


def _bar_hatching(points: Sequence[Point]) -> Polylines:
    """Slanted strokes across a bar."""
    strokes = []
    half = BAR / 2
    for a, b in pairwise(points):
        along = b.minus(a)
        u, v = along.unit, along.unit.across
        number = max(1, int(along.length / _HATCH))
        for k in range(number):
            foot = a.plus(u, (k + 0.5) * along.length / number)
            strokes.append((foot.plus(v, half).plus(u, -half / 2), foot.plus(v, -half).plus(u, half / 2)))
    return Polylines(tuple(strokes), "hatch-bar")


def hatching(corners: Sequence[Point]) -> Polylines:
    """Strokes at 45 degrees inside a polygon and its rim."""
    spread = [p.x + p.y for p in corners]
    first, last = math.ceil((min(spread) - BAR / 2) / 8.0), math.floor((max(spread) + BAR / 2) / 8.0)
    strokes = []
    for k in range(first, last + 1):
        cuts = _cuts(corners, 8.0 * k)
        strokes += [(_stretched(a, b), _stretched(b, a)) for a, b in zip(cuts[::2], cuts[1::2], strict=False)]
    return Polylines(tuple(strokes), "hatch")


def _cuts(corners: Sequence[Point], level: float) -> list[Point]:
    """The intersections of the line x + y = level with the rim, from left to right."""
    cuts = []
    for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
        da, db = a.x + a.y - level, b.x + b.y - level
        if (da < 0) != (db < 0):
            cuts.append(a.plus(b.minus(a), da / (da - db)))
    return sorted(cuts)


def _stretched(a: Point, b: Point) -> Point:
    return a.plus(a.minus(b).unit, BAR / 2 - 1)


def ticks(a: Point, b: Point, outward: Point) -> Polylines:
    """The strokes on a line of the frame, on its outer side."""
    along = b.minus(a)
    number = max(2, round(along.length / _HATCH))
    places = [a.plus(along, (k + 0.5) / number) for k in range(number)]
    lean = _slant(outward.unit)
    return Polylines(tuple((p.plus(outward, 1.3), p.plus(outward, 1.3).plus(lean, 6.5)) for p in places), "hatch")


def foot(at: Point, side: Point = DOWN) -> tuple[Point, Point]:
    """The ends of the line on which the support of a bearing stands, below or on another side of it."""
    middle = at.plus(side, FOOT.y)
    return middle.plus(side.across, FOOT.x + 5.0), middle.plus(side.across, -FOOT.x - 5.0)


def pedestal(at: Point, side: Point = DOWN) -> list[Shape]:
    """The support of a bearing of the frame, hatched on that side."""
    base = foot(at, side)
    left, right = base[0].plus(side.across, -5.0), base[1].plus(side.across, 5.0)
    return [
        Polylines(((at, right, left),), "block-frame", closed=True),
        Polylines((base,), "rail"),
        ticks(*base, side),
    ]


def _slant(outward: Point) -> Point:
    """The direction of hatching: one for all lines, at 45 degrees, except for lines that nearly have it themselves."""
    rising, falling = Point(-1.0, 1.0).unit, Point(1.0, 1.0).unit
    slant = rising if abs(outward.dot(rising)) > _STEEP else falling
    return slant if outward.dot(slant) > 0 else Point(-slant.x, -slant.y)


def widest_gap(angles: Sequence[float]) -> float:
    """The middle of the widest gap between directions, as an angle in radians.

    >>> widest_gap([0.0, 1.0]) - 1.0 == (2 * math.pi - 1.0) / 2
    True
    """
    around = sorted(angles)
    gaps = [(b - a, a) for a, b in pairwise([*around, around[0] + 2 * math.pi])]
    width, begin = max(gaps)
    return begin + width / 2


def turning_drive(at: Point, radius: float, away: float, extent: float = math.radians(-230)) -> list[Shape]:
    """A curved arrow around a joint, its middle in the direction given by an angle."""
    arc = ArcShape(at, radius=radius, begin=away - extent / 2, extent=extent, style="drive")
    return [arc, arrow_head(arc)]


def arrow_head(arc: ArcShape) -> Polylines:
    """The head at the end of an arc."""
    tip = arc.place(1.0)
    forward = tip.minus(arc.at).unit.across
    return _head(tip, forward if arc.extent > 0 else Point(-forward.x, -forward.y))


def straight_drive(at: Point, axis: Point, side: Point) -> list[Shape]:
    """A straight arrow along an axis, at one side of the joint."""
    middle = at.plus(side.unit, 22.0)
    return arrow(middle.plus(axis, -17.0), middle.plus(axis, 13.0))


def arrow(tail: Point, tip: Point, line: str = "drive", head: str = "head") -> list[Shape]:
    """A straight arrow; its head extends 7 pixels beyond the tip of the line."""
    return [Polylines(((tail, tip),), line), _head(tip, tip.minus(tail).unit, head)]


def _head(at: Point, forward: Point, style: str = "head") -> Polylines:
    side = forward.across
    back = at.plus(forward, -1.5)
    return Polylines(((at.plus(forward, 7.0), back.plus(side, 4.6), back.plus(side, -4.6)),), style, closed=True)
