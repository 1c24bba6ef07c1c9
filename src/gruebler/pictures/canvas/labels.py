"""Names of links beside their bodies; where there is no space for them, numbers and a list below the picture."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from gruebler.pictures.canvas.free_space import HALF, Obstacles, complexes
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape, TextShape, bounds, text_width
from gruebler.pictures.canvas.styles import BAR, STYLES

_ENOUGH = 7.0  # pixels around a text; more does not improve a place
_LEAST = 1.5
_CLEAR = BAR / 2 + 4.0  # pixels from the middle of a link to outside of it
_BESIDE = 4.0  # pixels between a link and its name
_APART = 12.0  # pixels to any other link, so that a name is read as that of its own
_OUTSIDE = 5.0  # pixels of free space that a place far from the middle is worth
_PARTS = (0.5, 0.4, 0.6, 0.3, 0.7)  # of an edge
_FARTHER = (12.0, 22.0, 34.0, 48.0, 64.0, 82.0, 102.0)  # pixels between a link and its number at the end of a line
_NEAR = 3  # the number of these distances that long names may use too
_WIDE = 30.0  # pixels: lines of wider names do not cross other lines
_COLUMN = 18.0  # from line to line of the list
_SHORT = 3  # names of at most this many letters are used like numbers


def labels_or_numbers(
    outlines: Mapping[str, Sequence[Point]],
    closed: Mapping[str, bool],
    shapes: Sequence[Shape],
    names: Mapping[str, str] | None = None,
) -> list[Shape]:
    """The shapes with a name beside the outline of every link; ``names`` may give links other names.

    If there is no space for a long name, numbers replace the long names, with a list of their meanings.
    """
    texts, rows = labels_with_names(outlines, closed, shapes, names)
    points = [point for outline in outlines.values() for point in outline]
    labelled = [*shapes, *texts]
    return [*labelled, *(legend(rows, points, labelled) if rows else ())]


def labels_with_names(
    outlines: Mapping[str, Sequence[Point]],
    closed: Mapping[str, bool],
    shapes: Sequence[Shape],
    names: Mapping[str, str] | None = None,
    *,
    larger: float = 1.0,
    heads: Sequence[Shape] = (),
    most: int = 99,
) -> tuple[list[Shape], dict[str, str]]:
    """The names alone, and the entries of the list: names with their numbers, which may be set ``larger``.

    Numbers are beside ``heads``, the arrows of drives, too. More than ``most`` long names are numbers in any case.
    """
    called = {link: (names or {}).get(link, link) for link in outlines}
    few = sum(len(name) > _SHORT for name in called.values()) <= most
    texts = _placed(outlines, closed, shapes, called, larger) if few else None
    if texts is not None:
        return texts, {}
    numbers = short_names(list(called.values()))
    around = [*shapes, *heads]
    texts = _placed(outlines, closed, around, {link: numbers[name] for link, name in called.items()}, larger)
    assert texts is not None  # numbers are short
    return texts, {name: number for name, number in numbers.items() if name != number}


def note_near(at: Point, text: str, style: str, shapes: Sequence[Shape], others: Sequence[Point] = ()) -> TextShape:
    """A text near a point, where the shapes leave most space; above and to the right if there is no obstacle.

    Where it can, it stays nearer to its point than to the ``others``, so that it is not read as their name.
    """
    room, wide = Obstacles(shapes), text_width(text, STYLES[style].size)
    places = [
        Point(at.x + (off + wide / 2) * math.cos(turn), at.y - (off + HALF) * math.sin(turn))
        for off in (8.0, 14.0, 22.0, 32.0, 44.0, 58.0)
        for turn in (math.pi * k / 8 for k in (2, 6, 14, 10, 0, 8, 4, 12, 1, 3, 5, 7, 9, 11, 13, 15))
    ]
    free = room.free(complexes(places), wide)

    def own(place: Point) -> bool:
        return all(place.minus(at).length < place.minus(other).length for other in others)

    best = max(range(len(places)), key=lambda k: (min(float(free[k]), _LEAST), own(places[k]), -k))
    return TextShape(places[best], text, style)


def short_names(links: Sequence[str]) -> dict[str, str]:
    """Names of up to three letters unchanged; if there is a longer one, numbers for all that are not numbers.

    The numbers are the places from 1, if these are not names.

    >>> short_names(["a", "arm"]), short_names(["1", "2", "diagonal"]), short_names(["3", "long", "arm", "2"])
    ({'a': 'a', 'arm': 'arm'}, {'1': '1', '2': '2', 'diagonal': '3'}, {'3': '3', 'long': '1', 'arm': '4', '2': '2'})
    """
    short = {link: link for link in links if link.isdigit() or max(map(len, links)) <= _SHORT}
    used = set(short)
    for place, link in enumerate(links, 1):
        if link not in short:
            short[link] = next(str(k) for k in (place, *range(1, 2 * len(links) + 1)) if str(k) not in used)
            used.add(short[link])
    return {link: short[link] for link in links}


@dataclass(frozen=True, slots=True, kw_only=True)
class _LabelPlace:
    """A candidate place of a name: the point of the edge, the direction, and the distance from the edge's middle."""

    at: Point
    beside: Point
    normal: Point
    away: float
    farther: float


def _placed(
    outlines: Mapping[str, Sequence[Point]],
    closed: Mapping[str, bool],
    shapes: Sequence[Shape],
    names: Mapping[str, str],
    larger: float,
) -> list[Shape] | None:
    """A text for every link, the longest first; None if a long one would touch a shape."""
    room, inside = Obstacles(shapes), Obstacles(shapes, inside=True)
    points = [point for outline in outlines.values() for point in outline]
    texts: list[Shape] = []
    for link in sorted(outlines, key=lambda link: -len(names[link])):
        wide = text_width(names[link], STYLES["name"].size) * (1.0 if len(names[link]) > _SHORT else larger)
        others = Obstacles([_edges(outlines[other], closed[other]) for other in outlines if other != link])
        own = (outlines[link], closed[link], others)
        free, place = _best(room, points, *own, wide, (0.0,))
        if free < _LEAST:
            long = len(names[link]) > _SHORT
            farther = _best(room, points, *own, wide, _FARTHER[: _NEAR if long else None])
            if farther[0] < _LEAST and long:
                return None
            if farther[0] < _LEAST:  # of a number: on a wheel, if that is free
                farther = _best(inside, points, *own, wide, (0.0, *_FARTHER))
            place = farther[1] if farther[0] >= _LEAST else place
        leader = _leader(place, wide)
        for obstacles in (room, inside):
            obstacles.take(place.at, wide, leader)
        texts += [Polylines((leader,), "measure"), CircleShape(place.beside, 2.0, "dot")] if leader else []
        texts.append(TextShape(place.at, names[link], "name"))
    return texts


def _edges(outline: Sequence[Point], closed: bool) -> Polylines:
    return Polylines((tuple(outline),), "outline-bar", closed=closed)


def _best(
    room: Obstacles,
    points: Sequence[Point],
    outline: Sequence[Point],
    closed: bool,
    others: Obstacles,
    wide: float,
    farther: Sequence[float],
) -> tuple[float, _LabelPlace]:
    """The best place (free, at the rim if possible, near the middle of an edge) and its free pixels."""
    places = list(_candidates(outline, closed, wide, farther))
    at = complexes([place.at for place in places])
    beside, directions = complexes([place.beside for place in places]), complexes([place.normal for place in places])
    free, rim, apart = room.free(at, wide), room.open(at, directions), others.free(at, wide)
    crossed, written = (lines.crossed(at, beside + _CLEAR * directions) for lines in (room.lines, room.texts))
    free = np.where((written > 0) | (crossed > 0) & (wide > _WIDE), np.minimum(free, 0.0), free)
    middle = Point(*(sum(axis) / len(points) for axis in zip(*points, strict=True)))
    most = max(*(p.minus(middle).length for p in points), 1.0)

    def worth(k: int) -> tuple[bool, int, float, bool, float]:
        outside = _OUTSIDE * min(1.2, places[k].at.minus(middle).length / most)
        is_free = bool(free[k] >= _LEAST)
        quality = min(float(free[k]), _ENOUGH) + min(float(apart[k]), _APART) + outside - 6 * places[k].away
        return is_free, -int(crossed[k]), -places[k].farther if is_free else 0.0, bool(rim[k]), quality

    best = max(range(len(places)), key=worth)
    return float(free[best]), places[best]


def _candidates(outline: Sequence[Point], closed: bool, wide: float, farther: Sequence[float]) -> Iterator[_LabelPlace]:
    """Places beside the edges, outside of a polygon; the distance of text and edge is the same in every direction."""
    corners = [*outline, outline[0]] if closed else list(outline)
    area = sum(a.x * b.y - b.x * a.y for a, b in pairwise(corners))
    for a, b in pairwise(corners):
        along = b.minus(a)
        normal = along.unit.across
        for side in (-1 if area > 0 else 1,) if closed else (-1, 1):
            n = Point(side * normal.x, side * normal.y)
            off = BAR / 2 + _BESIDE + HALF + abs(n.x) * max(0.0, wide / 2 - HALF)
            for more in farther:
                for part in _PARTS:
                    beside = a.plus(along, part)
                    yield _LabelPlace(
                        at=beside.plus(n, off + more), beside=beside, normal=n, away=abs(part - 0.5), farther=more
                    )


def _leader(place: _LabelPlace, wide: float) -> tuple[Point, ...]:
    """The ends of a line from a link to the next point of its name, where there is a distance between them."""
    if not place.farther:
        return ()
    half = max(0.0, wide / 2 - HALF)
    near = Point(min(max(place.beside.x, place.at.x - half), place.at.x + half), place.at.y)
    return place.beside, near.plus(place.beside.minus(near).unit, HALF)


def legend(names: Mapping[str, str], points: Sequence[Point], shapes: Sequence[Shape] = ()) -> Iterator[TextShape]:
    """Numbers and names in columns below points and shapes, of about the same total width."""
    left, right = min(p.x for p in points), max(p.x for p in points)
    top = max(p.y for p in points) + 44.0
    if shapes:
        corner, size = bounds(shapes, 0.0)
        left, right = corner.x, max(right, corner.x + size.x)
        top = max(top, corner.y + size.y + 14.0)
    entries = [f"{number}  {link}" for link, number in names.items()]
    widest = max(map(text_width, entries)) + 18.0
    columns = max(1, int((right - left + 40.0) / widest))
    rows = math.ceil(len(entries) / columns)
    for k, entry in enumerate(entries):
        yield TextShape(Point(left + widest * (k // rows), top + _COLUMN * (k % rows)), entry, "name", "start")
