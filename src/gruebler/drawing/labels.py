"""Names of links beside their bodies; where there is no room for them, numbers and a list below the picture."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from gruebler.drawing.figure import Arc, Circle, Lines, Point, Shape, Text, bounds, text_width
from gruebler.drawing.styles import BAR, STYLES

__all__ = ["Room", "Segment", "core", "distance", "labelled", "legend", "noted", "obstacles", "short_names"]

_HALF = 7.0  # half the height of a text
_ENOUGH = 7.0  # pixels around a text; more is no better
_LEAST = 1.5
_OUTSIDE = 5.0  # pixels of free space that are given up for a place at the border of the picture
_COLUMN = 18.0  # from line to line of the list
_SHORT = 3  # names of so many letters are taken as numbers: they stand beside their links in any case

_FROM_ANCHOR = {"start": 0.5, "middle": 0.0, "end": -0.5}

Segment = tuple[Point, Point]


def labelled(
    outlines: Mapping[str, Sequence[Point]],
    closed: Mapping[str, bool],
    shapes: Sequence[Shape],
    names: Mapping[str, str] | None = None,
) -> list[Shape]:
    """The shapes with a name beside the outline of every link; ``names`` may call links otherwise.

    If a long name finds no room, the links are numbered and a list says what the numbers mean.
    """
    called = {link: (names or {}).get(link, link) for link in outlines}
    points = [point for outline in outlines.values() for point in outline]
    drawn = [*obstacles(shapes)]
    found = _placed(outlines, closed, Room(drawn, points), called)
    if found is not None:
        return [*shapes, *found]
    numbers = {link: str(k) for k, link in enumerate(outlines, 1)}
    found = _placed(outlines, closed, Room(drawn, points), numbers)
    assert found is not None  # numbers are short
    return [*shapes, *found, *legend({called[link]: number for link, number in numbers.items()}, points, shapes)]


def noted(at: Point, words: str, style: str, shapes: Sequence[Shape]) -> Text:
    """A text near a point, where the shapes leave most room for it; above and to the right if nothing is in the way."""
    room, wide = Room([*obstacles(shapes)], [at]), text_width(words, STYLES[style].size)
    places = [
        Point(at.x + (off + wide / 2) * math.cos(turn), at.y - (off + _HALF) * math.sin(turn))
        for off in (8.0, 14.0, 22.0, 32.0)
        for turn in (math.pi * k / 8 for k in (2, 6, 14, 10, 0, 8, 4, 12, 1, 3, 5, 7, 9, 11, 13, 15))
    ]
    best = max(range(len(places)), key=lambda k: (min(room.free(places[k], wide), _LEAST), -k))
    return Text(places[best], words, style)


def short_names(links: Sequence[str]) -> dict[str, str]:
    """The names themselves if all of them are short, else numbers from 1."""
    if all(len(link) <= _SHORT for link in links):
        return {link: link for link in links}
    return {link: str(k) for k, link in enumerate(links, 1)}


def _placed(
    outlines: Mapping[str, Sequence[Point]], closed: Mapping[str, bool], room: Room, names: Mapping[str, str]
) -> list[Shape] | None:
    """A text for every link, the longest first; None if a long one would touch something."""
    texts: list[Shape] = []
    for link in sorted(outlines, key=lambda link: -len(names[link])):
        candidates = _candidates(outlines[link], closed[link], text_width(names[link], STYLES["name"].size))
        tried = [(room.free(at, wide), room.outside(at) - 6 * off, at, wide) for at, wide, off in candidates]
        free, _, place, wide = max(tried, key=lambda one: (one[0] >= _LEAST, one[0] + one[1]))
        if free < _LEAST and len(names[link]) > _SHORT:
            return None
        room.taken.append(core(place, wide))
        texts.append(Text(place, names[link], "name"))
    return texts


def _candidates(outline: Sequence[Point], closed: bool, wide: float) -> Iterator[tuple[Point, float, float]]:
    """Places beside the edges, outside of a polygon, with the width and how far from the middle of the edge."""
    corners = [*outline, outline[0]] if closed else list(outline)
    area = sum(a.x * b.y - b.x * a.y for a, b in pairwise(corners))
    for a, b in pairwise(corners):
        along = b.minus(a)
        normal = along.unit.across
        for side in (-1 if area > 0 else 1,) if closed else (-1, 1):
            n = Point(side * normal.x, side * normal.y)
            off = BAR / 2 + 4.0 + abs(n.x) * wide / 2 + abs(n.y) * _HALF
            for part in (0.5, 0.4, 0.6, 0.3, 0.7):
                yield a.plus(along, part).plus(n, off), wide, abs(part - 0.5)


def core(at: Point, wide: float) -> Segment:
    """The middle line of a text; all of the text is within half its height."""
    half = max(0.0, wide / 2 - _HALF)
    return Point(at.x - half, at.y), Point(at.x + half, at.y)


@dataclass
class Room:
    """Where there is room for a text: segments drawn, with half their width, points of the figure, and texts."""

    drawn: list[tuple[Segment, float]]
    points: list[Point]
    taken: list[Segment] = field(default_factory=list)

    def free(self, at: Point, wide: float) -> float:
        """How many pixels are free around a text, up to what is enough."""
        middle = core(at, wide)
        space = _ENOUGH
        for segment, half in [*self.drawn, *((text, _HALF) for text in self.taken)]:
            if _gap(middle, segment) < space + half + _HALF:
                space = min(space, distance(middle, segment) - half - _HALF)
        return space

    def outside(self, at: Point) -> float:
        """Something for a place far from the middle of the figure."""
        middle = Point(*(sum(axis) / len(self.points) for axis in zip(*self.points, strict=True)))
        most = max(p.minus(middle).length for p in self.points)
        return _OUTSIDE * min(1.2, at.minus(middle).length / max(most, 1.0))


def obstacles(shapes: Sequence[Shape]) -> Iterator[tuple[Segment, float]]:
    """The segments of shapes, with half their width."""
    for shape in shapes:
        match shape:
            case Lines(parts, style, closed) if not style.startswith("halo"):
                half = STYLES[style].width / 2
                for part in parts:
                    ends = [*part, part[0]] if closed else list(part)
                    yield from (((a, b), half) for a, b in pairwise(ends))
            case Circle(at, radius) | Arc(at, radius):
                yield (at, at), radius
            case Text(at, words, style, anchor):
                wide = text_width(words, STYLES[style].size)
                yield core(Point(at.x + _FROM_ANCHOR[anchor] * wide, at.y), wide), _HALF


def _gap(level: Segment, other: Segment) -> float:
    """A lower bound of the distance from a level segment: the larger of the gaps in x and in y."""
    (a, b), (c, d) = level, other
    beside = max(min(c.x, d.x) - b.x, a.x - max(c.x, d.x))
    return max(beside, min(c.y, d.y) - a.y, a.y - max(c.y, d.y))


def distance(one: Segment, other: Segment) -> float:
    """Between two segments; 0 if they cross."""
    if _cross(one, other):
        return 0.0
    return min(_from(one[0], other), _from(one[1], other), _from(other[0], one), _from(other[1], one))


def _from(p: Point, segment: Segment) -> float:
    a, b = segment
    ab, ap = b.minus(a), p.minus(a)
    square = ab.dot(ab)
    t = min(1.0, max(0.0, ap.dot(ab) / square)) if square else 0.0
    return p.minus(a.plus(ab, t)).length


def _cross(one: Segment, other: Segment) -> bool:
    (a, b), (c, d) = one, other

    def side(p: Point, q: Point, r: Point) -> float:
        return q.minus(p).across.dot(r.minus(p))

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def legend(names: Mapping[str, str], points: Sequence[Point], shapes: Sequence[Shape] = ()) -> Iterator[Text]:
    """Numbers and names in columns below points and shapes, about as wide as the points."""
    left, right = min(p.x for p in points), max(p.x for p in points)
    top = max(p.y for p in points) + 44.0
    if shapes:
        corner, size = bounds(shapes, 0.0)
        top = max(top, corner.y + size.y + 14.0)
    entries = [f"{number}  {link}" for link, number in names.items()]
    widest = max(map(text_width, entries)) + 18.0
    columns = max(1, int((right - left + 40.0) / widest))
    rows = math.ceil(len(entries) / columns)
    for k, entry in enumerate(entries):
        yield Text(Point(left + widest * (k // rows), top + _COLUMN * (k % rows)), entry, "name", "start")
