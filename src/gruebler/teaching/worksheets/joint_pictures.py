"""The kinds of joints of figure 2.2 as pictures: two bodies in oblique view, with arrows for the motions left.

Every picture is of a ball, a cylinder or a block on or in another one; docs/glossary.md has the names.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

from gruebler.base.convex_hull import convex_hull
from gruebler.base.text import translate
from gruebler.pictures.canvas.figure import Figure, figure_of
from gruebler.pictures.canvas.shapes import Point, Polylines, Shape, TextShape
from gruebler.pictures.canvas.symbols import arrow
from gruebler.structure.chain.pairs import PAIRS, Alphabet, Pair
from gruebler.structure.chain.spaces import Space

_X, _Y, _Z = Point(0.88, 0.26), Point(0.62, -0.34), Point(0.0, -1.0)  # of the axes, on paper
_SIDES = 48

Space3 = tuple[float, float, float]


def joint_pictures(lang: str = "en") -> tuple[tuple[Pair, Figure], ...]:
    """A picture for every pair of space, by degree of freedom.

    >>> [pair.name for pair, _ in joint_pictures()][:3]
    ['revolute', 'prismatic', 'helical']
    """
    spatial = [pair for pair in PAIRS if Space.SPATIAL in pair.freedoms]
    spatial.sort(key=lambda pair: len(pair.freedoms[Space.SPATIAL]))
    return tuple((pair, _figure(pair, lang)) for pair in spatial)


def _figure(pair: Pair, lang: str) -> Figure:
    shapes = list(DRAWINGS[pair.name].bodies())
    shapes += _motions(pair)
    name = pair.full_name(lang).replace("_", " ")
    about = translate("{name}, f = {f}", lang, name=name, f=pair.f(Space.SPATIAL))
    symbol = pair.symbols.get(Alphabet.of_language(lang), "")
    if symbol:
        shapes.append(TextShape(Point(-66, -74), symbol, "name", "start"))
    return figure_of(shapes, about, about)


def _at(place: Space3) -> Point:
    x, y, z = place
    return Point(x * _X.x + y * _Y.x + z * _Z.x, x * _X.y + y * _Y.y + z * _Z.y)


def _face(*corners: Space3, style: str = "block") -> Polylines:
    return Polylines((tuple(map(_at, corners)),), style, closed=True)


def _block(centre: Space3, size: Space3, style: str = "block") -> Iterator[Shape]:
    """The three visible faces of a block: in front, on the right, above."""
    (x, y, z), (a, b, c) = centre, tuple(part / 2 for part in size)
    yield _face((x - a, y - b, z - c), (x + a, y - b, z - c), (x + a, y - b, z + c), (x - a, y - b, z + c), style=style)
    yield _face((x + a, y - b, z - c), (x + a, y + b, z - c), (x + a, y + b, z + c), (x + a, y - b, z + c), style=style)
    yield _face((x - a, y - b, z + c), (x + a, y - b, z + c), (x + a, y + b, z + c), (x - a, y + b, z + c), style=style)


def _round(centre: Space3, radius: float, axis: str) -> list[Point]:
    """A circle across an axis."""
    x, y, z = centre
    rim = []
    for k in range(_SIDES):
        c, s = radius * math.cos(2 * math.pi * k / _SIDES), radius * math.sin(2 * math.pi * k / _SIDES)
        place = {"x": (x, y + c, z + s), "y": (x + c, y, z + s), "z": (x + c, y + s, z)}[axis]
        rim.append(_at(place))
    return rim


def _cylinder(begin: Space3, end: Space3, radius: float, axis: str, style: str = "block") -> Iterator[Shape]:
    """The silhouette of a cylinder and its visible end."""
    first, last = _round(begin, radius, axis), _round(end, radius, axis)
    corners = convex_hull(complex(*p) for p in (*first, *last))
    yield Polylines((tuple(Point(z.real, z.imag) for z in corners),), style, closed=True)
    yield Polylines((tuple(last),), style, closed=True)


def _ball(centre: Space3, radius: float, style: str = "block") -> Iterator[Shape]:
    from gruebler.pictures.canvas.shapes import CircleShape

    yield CircleShape(_at(centre), radius, style)
    ring = _round(centre, radius, "z")
    yield Polylines((tuple(ring[_SIDES // 2 - 4 :] + ring[:1]),), "ghost")


def _rod(begin: Space3, end: Space3, style: str = "block") -> Iterator[Shape]:
    a, b = _at(begin), _at(end)
    side = b.minus(a).unit.across
    yield Polylines(((a.plus(side, 5), b.plus(side, 5), b.plus(side, -5), a.plus(side, -5)),), style, closed=True)


def _revolute() -> Iterator[Shape]:
    yield from _cylinder((-62, 0, 0), (-18, 0, 0), 10, "x")
    yield from _cylinder((-24, 0, 0), (24, 0, 0), 24, "x", "block-frame")
    yield from _cylinder((24, 0, 0), (30, 0, 0), 16, "x")
    yield from _cylinder((30, 0, 0), (62, 0, 0), 10, "x")


def _prismatic() -> Iterator[Shape]:
    yield from _block((-46, 0, 0), (34, 18, 18))
    yield from _block((0, 0, 0), (56, 46, 46), "block-frame")
    yield from _block((48, 0, 0), (40, 18, 18))


def _helical() -> Iterator[Shape]:
    yield from _cylinder((-62, 0, 0), (-18, 0, 0), 11, "x")
    yield from _block((0, 0, 0), (48, 46, 46), "block-frame")
    yield from _cylinder((24, 0, 0), (64, 0, 0), 11, "x")
    for k in range(5):
        yield Polylines((tuple(_round((30 + 7.0 * k, 0, 0), 11, "x")[30:44]),), "edge")


def _cylindrical() -> Iterator[Shape]:
    yield from _cylinder((-66, 0, 0), (-18, 0, 0), 12, "x")
    yield from _cylinder((-24, 0, 0), (24, 0, 0), 25, "x", "block-frame")
    yield from _cylinder((24, 0, 0), (66, 0, 0), 12, "x")


def _roll_slide() -> Iterator[Shape]:
    yield from _block((0, 0, -27), (110, 56, 14), "block-frame")
    yield from _cylinder((0, 24, 0), (0, -24, 0), 20, "y")


def _double_slide() -> Iterator[Shape]:
    yield from _block((0, 0, -20), (110, 70, 12), "block-frame")
    yield from _block((0, 0, -8), (46, 34, 12))
    yield from _block((0, 0, 8), (20, 16, 20))


def _universal() -> Iterator[Shape]:
    yield from _cylinder((0, 30, 0), (0, -30, 0), 6, "y")
    yield from _cylinder((0, 0, -30), (0, 0, 30), 6, "z", "block-frame")
    yield from _ball((0, 0, 0), 10)
    yield from _rod((-64, 0, 0), (-30, 0, 0))
    yield from _rod((-30, 0, 0), (0, 30, 0))
    yield from _rod((-30, 0, 0), (0, -30, 0))
    yield from _rod((64, 0, 0), (30, 0, 0), "block-frame")
    yield from _rod((30, 0, 0), (0, 0, 30), "block-frame")
    yield from _rod((30, 0, 0), (0, 0, -30), "block-frame")


def _spherical() -> Iterator[Shape]:
    yield from _ball((0, 0, 0), 26)
    yield from _rod((18, 0, 18), (56, 0, 44))
    yield from _cup((0, 0, 0), 31)
    yield from _rod((-30, 0, -10), (-66, 0, -10), "block-frame")


def _cup(centre: Space3, radius: float) -> Iterator[Shape]:
    """The lower part of a socket around a ball."""
    at = _at(centre)
    turns = [math.pi * (0.12 + 0.76 * k / 24) for k in range(25)]
    outer = [Point(at.x + radius * math.cos(x), at.y + radius * math.sin(x)) for x in turns]
    inner = [Point(at.x + (radius - 7) * math.cos(x), at.y + (radius - 7) * math.sin(x)) for x in turns[::-1]]
    yield Polylines(((*outer, *inner),), "block-frame", closed=True)


def _planar() -> Iterator[Shape]:
    yield from _block((0, 0, -20), (116, 76, 12), "block-frame")
    yield from _block((-8, 0, -4), (52, 36, 18))


def _ball_groove() -> Iterator[Shape]:
    yield from _block((0, 0, -32), (116, 60, 16), "block-frame")
    yield _face((-58, -10, -24), (58, -10, -24), (58, 10, -24), (-58, 10, -24), style="rest")
    yield from _ball((0, 0, -4), 22)
    yield from _rod((0, 0, 16), (0, 0, 50))


def _ball_cylinder() -> Iterator[Shape]:
    yield from _cylinder((-58, 0, 0), (58, 0, 0), 27, "x", "block-frame")
    yield from _ball((58, 0, 0), 21)
    yield from _rod((66, 0, 0), (98, 0, 0))


def _cylinder_plane() -> Iterator[Shape]:
    yield from _block((0, 0, -30), (116, 76, 12), "block-frame")
    yield from _cylinder((0, 34, -4), (0, -34, -4), 20, "y")


def _double_cylindrical() -> Iterator[Shape]:
    yield from _cylinder((-60, 0, -12), (60, 0, -12), 11, "x", "block-frame")
    yield from _block((0, 0, 0), (30, 30, 46), "joint")
    yield from _cylinder((0, 62, 12), (0, 15, 12), 11, "y")
    yield from _cylinder((0, -15, 12), (0, -62, 12), 11, "y")


def _ball_plane() -> Iterator[Shape]:
    yield from _block((0, 0, -32), (116, 76, 12), "block-frame")
    yield from _ball((0, 0, -4), 22)
    yield from _rod((0, 0, 16), (0, 0, 50))


@dataclass(frozen=True, slots=True)
class Drawing:
    """A pair in perspective: its bodies, and the axes of the picture along which the motions of the joint are seen."""

    bodies: Callable[[], Iterator[Shape]]
    axes: Mapping[str, str] = field(default_factory=dict)
    """Those that differ from the joint's own: its axis is drawn along x, or across the plane."""


DRAWINGS = {
    "revolute": Drawing(_revolute, {"Rz": "x"}),
    "prismatic": Drawing(_prismatic, {"Tx": "x"}),
    "helical": Drawing(_helical, {"Hz": "x"}),
    "cylindrical": Drawing(_cylindrical, {"Rz": "x", "Tz": "x"}),
    "roll_slide": Drawing(_roll_slide, {"Rz": "y", "Tx": "x"}),
    "double_slide": Drawing(_double_slide),
    "universal": Drawing(_universal, {"Rx": "y", "Ry": "z"}),
    "spherical": Drawing(_spherical),
    "planar": Drawing(_planar),
    "ball_groove": Drawing(_ball_groove),
    "ball_cylinder": Drawing(_ball_cylinder),
    "cylinder_plane": Drawing(_cylinder_plane, {"Ry": "z", "Rz": "y", "Tx": "x", "Tz": "y"}),
    "double_cylindrical": Drawing(_double_cylindrical),
    "ball_plane": Drawing(_ball_plane, {"Rx": "x", "Ry": "z", "Rz": "y", "Tx": "x", "Tz": "y"}),
}
"""The drawing of each pair that exists in space, by its name."""


def _motions(pair: Pair) -> Iterator[Shape]:
    """A straight arrow for each sliding, a curved one for each turning, beside the bodies."""
    axes = DRAWINGS[pair.name].axes
    for freedom in pair.freedoms[Space.SPATIAL]:
        axis = axes.get(freedom, freedom.axis)
        direction = {"x": _X, "y": _Y, "z": _Z}[axis].unit
        foot = {"x": Point(0, 74), "y": Point(70, 26), "z": Point(-84, 20)}[axis]
        if freedom.travels or freedom.has_pitch:
            for sign in (1, -1):
                yield from arrow(foot, foot.plus(direction, sign * 15), "velocity", "velocity-head")
        if freedom.turns:
            centre = foot.plus(direction, 30)
            side = direction.across
            curve = [
                centre.plus(side, 13 * math.sin(x)).plus(direction, 5 * math.cos(x))
                for x in (math.radians(20 + 12 * k) for k in range(26))
            ]
            yield Polylines((tuple(curve[:-1]),), "drive")
            yield arrow(curve[-2], curve[-1], "drive", "head")[1]
