"""Dimension lines: the distances of the pins and points of every link, and how far pins lie beside slides."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from gruebler.drawing.figure import Lines, Point, Shape, Text, text_width
from gruebler.drawing.labels import Segment, core, distance, noted, obstacles
from gruebler.drawing.linkage_bodies import hull
from gruebler.drawing.sheet import Sheet
from gruebler.drawing.stage import Stage
from gruebler.drawing.styles import STYLES
from gruebler.linkages import Line, Named

__all__ = ["dimension_lines"]

_OFFSETS = (21.0, 30.0, 40.0, 52.0, 66.0, 82.0, 100.0)  # pixels from what is measured to its dimension line
_CLEAR = 4.0  # pixels around a dimension line; more is no better
_STEP = 0.05  # pixels of clearance that a pixel of distance costs
_START, _BEYOND = 8.0, 4.0  # of the extension lines: where they begin, how far they go on
_HEAD = (8.0, 2.2)
_GAP = 4.0  # pixels between a number and its line
_HALF = 7.0  # half the height of a number
_SAME = 1e-9  # sizes: dimensions are not drawn below


class _Measure(NamedTuple):
    """Two points of a link whose distance is told."""

    link: str
    first: complex
    second: complex

    @property
    def length(self) -> float:
        return abs(self.second - self.first)


def dimension_lines(sheet: Sheet) -> list[Shape]:
    """A dimension line for every length of every link, clear of bodies and of each other where there is room."""
    stage = sheet.stage
    taken = [*obstacles(sheet.drawn), *_insides(sheet.drawn)]
    shapes: list[Shape] = []
    for measure in _measures(stage):
        a, b = (stage.place(Named(measure.link, z.real, z.imag)) for z in (measure.first, measure.second))
        made = _dimension(a, b, f"{measure.length:.4g} {stage.linkage.unit}", taken, [*sheet.drawn, *shapes])
        shapes += made
        taken += obstacles(made)
    return shapes


def _insides(drawn: Sequence[Shape]) -> Iterator[tuple[Segment, float]]:
    """Strokes over the inside of polygons: from their middle to their corners and the middles of their sides."""
    for shape in drawn:
        if isinstance(shape, Lines) and shape.style == "body" and shape.closed:
            for corners in shape.parts:
                middle = Point(*(sum(axis) / len(corners) for axis in zip(*corners, strict=True)))
                for a, b in pairwise([*corners, corners[0]]):
                    yield (middle, a), 0.0
                    yield (middle, a.plus(b.minus(a), 0.5)), 0.0


# --- what is measured ------------------------------------------------------------------------------


def _measures(stage: Stage) -> Iterator[_Measure]:
    """Lengths of the links as they were given, the short ones first: their dimension lines stand nearest."""
    linkage = stage.linkage
    least = _SAME * linkage.size
    found = [
        measure for link in linkage.mechanism.chain.links for measure in (*_sides(stage, link), *_beside(stage, link))
    ]
    yield from sorted((one for one in found if one.length > least), key=lambda one: one.length)


def _sides(stage: Stage, link: str) -> Iterator[_Measure]:
    """From pin to pin: along a line, or around a polygon."""
    linkage = stage.linkage
    joints = linkage.mechanism.chain.joints
    nodes = [e for (n, own), e in linkage.elements.items() if own == link and joints[n].pair.name == "revolute"]
    points = [point for point in linkage.points.values() if point.link == link]
    places = dict.fromkeys([*(complex(e.x, e.y) for e in nodes), *(complex(p.x, p.y) for p in points)])
    flat = 1e-6 * linkage.size
    corners = [complex(p.x, p.y) for p in hull([Point(z.real, z.imag) for z in places], flat)]
    if len(corners) == 2:
        along = corners[1] - corners[0]
        in_order = sorted(places, key=lambda z: ((z - corners[0]) * along.conjugate()).real)
        yield from (_Measure(link, a, b) for a, b in pairwise(in_order))
    elif len(corners) > 2:
        yield from (_Measure(link, a, b) for a, b in pairwise([*corners, corners[0]]))


def _beside(stage: Stage, link: str) -> Iterator[_Measure]:
    """From pins to the line of a slide on the same link: the offset, if there is one."""
    linkage = stage.linkage
    joints = linkage.mechanism.chain.joints
    mine = [(n, e) for (n, own), e in linkage.elements.items() if own == link]
    for number, line in mine:
        if isinstance(line, Line) and joints[number].pair.name == "prismatic":
            start, along = complex(line.x, line.y), cmath.rect(1.0, line.angle)
            for other, e in mine:
                if joints[other].pair.name == "revolute":
                    pin = complex(e.x, e.y)
                    foot = start + ((pin - start) * along.conjugate()).real * along
                    if abs(foot - pin) > 1e-6 * linkage.size:
                        yield _Measure(link, foot, pin)


# --- how it is drawn -------------------------------------------------------------------------------


def _dimension(
    a: Point, b: Point, words: str, taken: Sequence[tuple[Segment, float]], drawn: Sequence[Shape]
) -> list[Shape]:
    """Two extension lines, the line between them with a head at both ends, and the number in it, or beside it."""
    along = b.minus(a)
    u, v = along.unit, along.unit.across
    wide = text_width(words, STYLES["value"].size)
    best = max(
        ((side, off) for off in _OFFSETS for side in (1, -1)),
        key=lambda one: (
            min(_room(a.plus(v, one[0] * one[1]), b.plus(v, one[0] * one[1]), wide, taken), _CLEAR) - _STEP * one[1]
        ),
    )
    out = Point(best[0] * v.x, best[0] * v.y)
    first, last = a.plus(out, best[1]), b.plus(out, best[1])
    lines = [(p.plus(out, _START), q.plus(out, _BEYOND)) for p, q in ((a, first), (b, last))]
    heads = [(first, u), (last, Point(-u.x, -u.y))]
    half = _gap(u, wide)
    middle = first.plus(along, 0.5)
    fits = along.length > 2 * (half + _HEAD[0])
    inside = along.length > 2.5 * _HEAD[0]
    if fits:
        lines += [(first, middle.plus(u, -half)), (middle.plus(u, half), last)]
    else:
        beyond = 0.0 if inside else 2 * _HEAD[0]
        lines.append((first.plus(u, -beyond), last.plus(u, beyond)))
        heads = heads if inside else [(at, Point(-way.x, -way.y)) for at, way in heads]
    shapes: list[Shape] = [Lines(tuple(lines), "dimension"), *(_head(at, way) for at, way in heads)]
    text = Text(middle, words, "value") if fits else noted(middle, words, "value", [*drawn, *shapes])
    return [*shapes, text]


def _gap(u: Point, wide: float) -> float:
    """Half of what a level number takes of a line."""
    across, up = wide / 2 + _GAP, _HALF + _GAP / 2
    return min(across / max(abs(u.x), 1e-9), up / max(abs(u.y), 1e-9))


def _head(at: Point, way: Point) -> Lines:
    long, half = _HEAD
    back, side = at.plus(way, long), way.across
    return Lines(((at, back.plus(side, half), back.plus(side, -half)),), "dimension-head", closed=True)


def _room(a: Point, b: Point, wide: float, taken: Sequence[tuple[Segment, float]]) -> float:
    """How far a dimension line and its number are from all that is there."""
    number = core(a.plus(b.minus(a), 0.5), wide)
    return min(
        (min(distance((a, b), one), distance(number, one) - _HALF) - half for one, half in taken), default=_CLEAR
    )
