"""Parts of a picture in space: bars, sleeves, balls and plates of links, and how each looks on paper.

A part has points in space that move with its link. The first two are the ends of its *spine*, by which parts are
painted in order (`painting`); the others determine its outline. On paper a point has three numbers: right, down, near.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import atan2, pi

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.convex_hull import convex_hull
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape
from gruebler.pictures.canvas.simplification import FINE, simplified
from gruebler.pictures.canvas.styles import LINE, ROD
from gruebler.pictures.canvas.symbols import ticks

_SIDES, _SIDES_OF_WHEEL = 32, 64
_SOCKET = 0.62 * pi  # of the arc around a ball, to both sides
_GROUND = 11.0
_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


@dataclass(frozen=True, eq=False, kw_only=True)
class SpatialPart:
    """What is painted at once."""

    link: str
    look: str
    """A row of `LOOKS`."""
    points: Reals
    """(points, 3), in space or on paper: the two ends of the spine, then the outline."""
    reach: float
    """Pixels by which it is seen around its spine."""
    fixed: bool = False
    """Whether it belongs to the frame."""
    cut: tuple[bool, bool] = (False, False)
    """Whether the bar goes on at its ends as another part."""

    def at(self, points: Reals) -> SpatialPart:
        """The part with its points elsewhere."""
        return replace(self, points=points)


def link_bar(link: str, start: Reals, end: Reals) -> SpatialPart:
    """A straight piece of a link."""
    return SpatialPart(link=link, look="bar", points=np.array([start, end]), reach=ROD / 2 + LINE)


def line(link: str, points: Reals, look: str = "line") -> SpatialPart:
    """A line through points: a shaft, the arm of a fork, a thread."""
    points = np.asarray(points)
    return SpatialPart(link=link, look=look, points=np.concatenate([points[[0, -1]], points]), reach=2.0)


def sleeve(link: str, start: Reals, end: Reals, radius: float) -> SpatialPart:
    """A cylinder."""
    return _turned("sleeve", link, start, end, (radius, radius), _SIDES)


def wheel(link: str, start: Reals, end: Reals, radius: float, last: float | None = None) -> SpatialPart:
    """A disc, or a cone's piece with another radius at its end; what is behind it is seen through it."""
    return _turned("wheel", link, start, end, (radius, radius if last is None else last), _SIDES_OF_WHEEL)


def _turned(look: str, link: str, start: Reals, end: Reals, radii: tuple[float, float], sides: int) -> SpatialPart:
    u, v = across(end - start)
    turns = np.linspace(0, 2 * pi, sides, endpoint=False)[:, None]
    ring = np.cos(turns) * u + np.sin(turns) * v
    rims = [start + radii[0] * ring, end + radii[1] * ring]
    return SpatialPart(link=link, look=look, points=np.concatenate([[start, end], *rims]), reach=radii[0])


def block(link: str, middle: Reals, axes: Reals, halves: tuple[float, float, float]) -> SpatialPart:
    """A box along the columns of a rotation; its spine is along the first."""
    x, y, z = (axes[:, k] * half for k, half in enumerate(halves))
    corners = [middle + a * x + b * y + c * z for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    return SpatialPart(
        link=link, look="block", points=np.array([middle - x, middle + x, *corners]), reach=min(halves[1:])
    )


def ball(link: str, middle: Reals, radius: float) -> SpatialPart:
    """A ball; it is drawn round in every view."""
    return SpatialPart(link=link, look="ball", points=np.array([middle, middle]), reach=radius)


def socket(link: str, middle: Reals, towards: Reals, radius: float) -> SpatialPart:
    """An arc around a ball, its middle towards a direction."""
    return SpatialPart(link=link, look="socket", points=np.array([middle, middle, middle + towards]), reach=radius)


def ground_support(link: str, start: Reals, end: Reals) -> SpatialPart:
    """A support: a line to the hatched ground."""
    return SpatialPart(link=link, look="ground", points=np.array([start, end]), reach=2.0)


def across(axis: Reals) -> tuple[Reals, Reals]:
    """Two unit vectors at right angles to an axis and to each other."""
    unit = axis / np.linalg.norm(axis)
    other = np.eye(3)[int(np.argmin(np.round(abs(unit), 6)))]
    u = other - (other @ unit) * unit
    u /= np.linalg.norm(u)
    return u, np.cross(unit, u)


# --- on paper ----------------------------------------------------------------------------------------


def points_on_paper(places: Reals) -> tuple[Point, ...]:
    """The points of places, (points, 3)."""
    return tuple(Point(x, y) for x, y in places[:, :2].tolist())


def outline_on_paper(places: Reals, style: str) -> Polylines:
    """The convex outline of places on paper."""
    hull = convex_hull(complex(x, y) for x, y in np.round(places[:, :2], 3).tolist())
    return Polylines((_fewer([Point(z.real, z.imag) for z in hull]),), style, closed=True)


def _fewer(points: Sequence[Point]) -> tuple[Point, ...]:
    return tuple(simplified(points, FINE))


def _bar(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    ends = points_on_paper(part.points)
    along = ends[1].minus(ends[0])
    short = min(1.5, along.length / 3)  # where a bar goes on, its outline has no round end
    first, last = (
        end.plus(along.unit, sign * short if cut else 0.0)
        for end, sign, cut in zip(ends, (1, -1), part.cut, strict=True)
    )
    return [Polylines(((first, last),), "outline-rod")], [Polylines((ends,), "body-rod")]


def _line(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    return [], [Polylines((points_on_paper(part.points[2:]),), "rail")]


def _thread(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    return [], [Polylines((points_on_paper(part.points[2:]),), "hatch")]


def _sleeve(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    """The outline of a cylinder and the end that is seen."""
    return [], _cylinder(part, _filled(part), _filled(part))


def _wheel(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    return [], _cylinder(part, "wheel", "axis")


def _cylinder(part: SpatialPart, style: str, end: str) -> list[Shape]:
    points = np.round(part.points, 3)  # which of many places are corners hangs on no last bit
    rims = points[2:].reshape(2, -1, 3)
    near = rims[int(points[1, 2] > points[0, 2])]
    return [outline_on_paper(points[2:], style), Polylines((_fewer(points_on_paper(near)),), end, closed=True)]


def _block(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    """The faces that are seen: their corners go round as seen from outside."""
    corners = part.points[2:]
    seen = []
    for face in _FACES:
        a, b, c = corners[list(face[:3]), :2]
        if (b - a)[0] * (c - b)[1] - (b - a)[1] * (c - b)[0] < 0:
            seen.append(points_on_paper(corners[list(face)]))
    return [], [Polylines((face,), _filled(part), closed=True) for face in seen]


def _ball(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    return [], [CircleShape(points_on_paper(part.points)[0], part.reach, _filled(part))]


def _socket(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    middle, towards = points_on_paper(part.points[1:])
    away = towards.minus(middle)
    arc = ArcShape(middle, radius=part.reach, begin=atan2(away.y, away.x) - _SOCKET, extent=2 * _SOCKET, style="rail")
    return [], [arc]


def _ground(part: SpatialPart) -> tuple[list[Shape], list[Shape]]:
    start, end = points_on_paper(part.points)
    outward = end.minus(start).unit
    corners = end.plus(outward.across, -_GROUND), end.plus(outward.across, _GROUND)
    return [], [Polylines(((start, end), corners), "rail"), ticks(*corners, outward)]


def _filled(part: SpatialPart) -> str:
    return "block-frame" if part.fixed else "block"


LOOKS: Mapping[str, Callable[[SpatialPart], tuple[list[Shape], list[Shape]]]] = {
    "bar": _bar,
    "line": _line,
    "thread": _thread,
    "sleeve": _sleeve,
    "wheel": _wheel,
    "block": _block,
    "ball": _ball,
    "socket": _socket,
    "ground": _ground,
}
"""Shapes of a part on paper: those below all bars of its link that meet it, and those above."""
