"""Dimension lines: the distances of the pins and points of every link, offsets of slides, lengths of cylinders."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.convex_hull import convex_hull
from gruebler.mechanics.linkages import LinkPoint
from gruebler.pictures.canvas.axes import as_text
from gruebler.pictures.canvas.free_space import HALF, Obstacles, complexes
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.shapes import Point, Polylines, Shape, TextShape, text_width
from gruebler.pictures.canvas.styles import STYLES
from gruebler.pictures.linkage.layer_context import LayerContext
from gruebler.pictures.linkage.posed_linkage import PosedLinkage
from gruebler.pictures.linkage.slides import pins_of, slides

_OFFSETS = (21.0, 26.0, 32.0, 39.0, 47.0, 56.0, 66.0, 78.0, 92.0, 108.0, 126.0, 146.0)  # pixels to a dimension line
_PARTS = (0.5, 0.36, 0.64)  # of a dimension line: the candidate places of its number
_CLEAR = 4.0  # pixels around a dimension line; more does not improve a place
_STEP = 0.05  # the cost of a pixel of distance
_TOUCHED, _HIDDEN, _ON_BODY, _ASIDE = (
    6.0,
    12.0,
    3.0,
    0.4,
)  # the costs of a line that touches, a number that touches, a line on a body, ...
_CROSSED = 0.5  # the cost of each stroke that an extension line crosses
_START, _BEYOND = 8.0, 4.0  # of the extension lines: their beginning, and their length beyond the dimension line
_STARTS = (_START, 18.0, 28.0, 38.0, 48.0, 60.0)
_HEAD = (8.0, 2.2)
_GAP = 4.0  # pixels between a number and its line
_AXIS = 16.0  # pixels by which the axis of a slide goes on at both ends
_SAME = 1e-9  # sizes: dimensions are not drawn below, lengths that differ by less are equal


class _Measure(NamedTuple):
    """Two points with a dimensioned distance."""

    first: LinkPoint
    second: LinkPoint
    length: float


def dimension_lines(context: LayerContext) -> list[Shape]:
    """A dimension line for every length of every link, clear of bodies and of each other where there is space.

    The axis of a slide with an offset is drawn too. As in technical drawings (ISO 129), millimetres are not written.
    Thin positions of the links do not drive the lines away: they stop at the numbers.
    """
    posed = context.posed
    solid = [shape for shape in context.drawn if shape.style not in ("ghost", "ghost-pin")]
    shapes: list[Shape] = [*_axes(posed)]
    unit = "" if posed.linkage.unit == "mm" else posed.linkage.unit
    for measure in _measures(posed):
        text = as_text(measure.length, unit, context.lang)
        shapes += _dimension(posed.place(measure.first), posed.place(measure.second), text, [*solid, *shapes])
    thin = len(solid) < len(context.drawn)
    return [*(_ground(shape) for shape in shapes if thin and isinstance(shape, TextShape)), *shapes]


def offset_letters(context: LayerContext) -> list[Shape]:
    """The axis of each slide that misses a pin of its guide, and e at the dimension of that offset."""
    posed = context.posed
    shapes: list[Shape] = [*_axes(posed)]
    for link in posed.linkage.mechanism.chain.links:
        for foot, pin in _beside(posed, link):
            first, last = (posed.place(_named(link, z)) for z in (foot, pin))
            shapes += _dimension(first, last, "e", [*context.drawn, *shapes], "name")
    return shapes


# --- dimensioned lengths ---------------------------------------------------------------------------


def _measures(posed: PosedLinkage) -> list[_Measure]:
    """Lengths of the links as given, the short ones first: their dimension lines are nearest."""
    linkage = posed.linkage
    least = _SAME * linkage.size
    pairs = [
        (link, first, second)
        for link in linkage.mechanism.chain.links
        for first, second in (*_sides(posed, link), *_beside(posed, link))
    ]
    measures = [_Measure(_named(link, a), _named(link, b), abs(b - a)) for link, a, b in pairs]
    measures += _cylinders(posed)
    drawn = (measure for measure in measures if measure.length > least)
    return sorted(drawn, key=lambda measure: round(measure.length / least))  # equal lengths in the order of the links


def _named(link: str, z: complex) -> LinkPoint:
    return LinkPoint(link, z.real, z.imag)


def _sides(posed: PosedLinkage, link: str) -> Iterator[tuple[complex, complex]]:
    """From pin to pin along a line, or around a polygon; from pins within a polygon to its two nearest corners."""
    linkage = posed.linkage
    joints = linkage.mechanism.chain.joints
    nodes = [e for (n, owner), e in linkage.elements.items() if owner == link and joints[n].pair.is_turning]
    points = [point for point in linkage.points.values() if point.link == link]
    places = list(dict.fromkeys([*(complex(e.x, e.y) for e in nodes), *(complex(p.x, p.y) for p in points)]))
    flat = 1e-6 * linkage.size
    corners = convex_hull(places, flat)
    rim = list(pairwise([*corners, corners[0]])) if len(corners) > 2 else list(pairwise(corners))
    inner = [z for z in places if min((abs(z - corner) for corner in corners), default=0.0) > flat]
    for a, b in rim:
        along = (b - a) / abs(b - a)
        on_it = [z for z in inner if abs(((z - a) * along.conjugate()).imag) <= flat]
        yield from pairwise([a, *sorted(on_it, key=lambda z: ((z - a) * along.conjugate()).real), b])
        inner = [z for z in inner if z not in on_it]
    for z in inner:
        yield from ((corner, z) for corner in sorted(corners, key=lambda corner: abs(corner - z))[:2])


def _beside(posed: PosedLinkage, link: str) -> Iterator[tuple[complex, complex]]:
    """From pins to the line of a slide on the same link: the offset, if there is one."""
    linkage = posed.linkage
    joints = linkage.mechanism.chain.joints
    link_elements = [(n, e) for (n, owner), e in linkage.elements.items() if owner == link]
    for number, line in link_elements:
        if line.is_line and joints[number].pair.is_sliding:
            start, along = complex(line.x, line.y), cmath.rect(1.0, line.direction)
            for other, e in link_elements:
                if joints[other].pair.is_turning:
                    pin = complex(e.x, e.y)
                    foot = start + ((pin - start) * along.conjugate()).real * along
                    if abs(foot - pin) > 1e-6 * linkage.size:
                        yield foot, pin


def _axes(posed: PosedLinkage) -> Iterator[Polylines]:
    """A chain line along each slide whose axis misses a pin of its guide: from the foot of the offset over the path."""
    for slide in slides(posed):
        feet = [foot for foot, _ in _beside(posed, slide.guide)]
        if feet and slide.sign == "block":
            ends = sorted([slide.low, slide.high, *feet], key=lambda z: (z * slide.along.conjugate()).real)
            first, last = (posed.place(_named(slide.guide, z)) for z in (ends[0], ends[-1]))
            beyond = last.minus(first).unit
            yield Polylines(((first.plus(beyond, -_AXIS), last.plus(beyond, _AXIS)),), "pitch")


def _cylinders(posed: PosedLinkage) -> Iterator[_Measure]:
    """The lengths of cylinders in this pose, from pin to pin."""
    for slide in slides(posed):
        if slide.sign == "cylinder":
            ends = _named(slide.guide, pins_of(posed.lower, slide.guide)[0]), _named(slide.block, slide.middle)
            a, b = (complex(posed.pose.complex_point(end)[0]) for end in ends)
            yield _Measure(*ends, abs(b - a))


# --- placement -------------------------------------------------------------------------------------


class _LinePlacement(NamedTuple):
    """A candidate placement of a dimension line: side, distance, and the relative place of its number."""

    side: int
    off: float
    part: float


def _dimension(a: Point, b: Point, text: str, drawn: Sequence[Shape], style: str = "value") -> list[Shape]:
    """Two extension lines, the line between them with a head at both ends, and the number in it, or beside it."""
    along = b.minus(a)
    u, v = along.unit, along.unit.across
    wide = text_width(text, STYLES[style].size)
    half = _gap(u, wide)
    number_fits = along.length > 2 * (half + _HEAD[0])
    shift = max(0.0, 0.5 - (half + _HEAD[0] + 2.0) / max(along.length, 1.0))
    parts = sorted({min(max(part, 0.5 - shift), 0.5 + shift) for part in _PARTS}) if number_fits else [0.5]
    placements = [_LinePlacement(*choice) for choice in product((1, -1), _OFFSETS, parts)]
    room = Obstacles(drawn)
    best = placements[int(_costs(a, b, placements, wide if number_fits else None, room).argmin())]
    outward = Point(best.side * v.x, best.side * v.y)
    first, last = a.plus(outward, best.off), b.plus(outward, best.off)
    lines = [_extension(p, outward, best.off, room) for p in (a, b)]
    heads = [(first, u), (last, Point(-u.x, -u.y))]
    inside = along.length > 2.5 * _HEAD[0]
    middle = first.plus(along, best.part)
    if number_fits:
        lines += [(first, middle.plus(u, -half)), (middle.plus(u, half), last)]
    else:
        beyond = 0.0 if inside else 2 * _HEAD[0]
        lines.append((first.plus(u, -beyond), last.plus(u, beyond)))
        heads = heads if inside else [(at, Point(-direction.x, -direction.y)) for at, direction in heads]
    shapes: list[Shape] = [Polylines(tuple(lines), "dimension"), *(_head(at, direction) for at, direction in heads)]
    number = TextShape(middle, text, style) if number_fits else note_near(middle, text, style, [*drawn, *shapes])
    return [*shapes, number]


def _ground(number: TextShape) -> Polylines:
    """Paper below a number."""
    x, y = text_width(number.text, STYLES[number.style].size) / 2 + 1.0, HALF
    corners = tuple(number.at.plus(Point(a * x, b * y)) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    return Polylines((corners,), "ground", closed=True)


def _extension(foot: Point, outward: Point, off: float, room: Obstacles) -> tuple[Point, Point]:
    """From a measured point to beyond its dimension line; it begins after texts that it would cross."""
    starts = [start for start in _STARTS if start < off] or [_START]
    end = foot.plus(outward, off + _BEYOND)
    feet = [foot.plus(outward, start) for start in starts]
    gaps = room.texts.gap(complexes(feet), complexes([end] * len(feet)))
    return next((p for p, gap in zip(feet, gaps, strict=True) if gap > 0), feet[0]), end


def _costs(a: Point, b: Point, placements: Sequence[_LinePlacement], wide: float | None, room: Obstacles) -> Reals:
    """The cost of each placement: docs/theory/drawing.md. Without a width the number is not in the line."""
    start, along = complex(*a), complex(*b.minus(a))
    unit = along / abs(along)
    outward = np.array([1j * placement.side for placement in placements]) * unit
    off = np.array([placement.off for placement in placements])
    first = start + off * outward
    last = first + along
    cost = _STEP * off + _touched(room, first, last, _TOUCHED)
    for foot in (start, start + along):
        begin, end = foot + _START * outward, foot + (off + _BEYOND) * outward
        cost += _CROSSED * (room.lines.gaps(begin, end) < 0).sum(axis=1)
        cost += 5 * _CROSSED * (room.texts.gaps(begin, end) < 0).sum(axis=1)
    for part in (0.1, 0.5, 0.9):
        cost += _ON_BODY / 3 * room.covered(first + part * along)
    if wide is not None:
        after = np.array([placement.part for placement in placements])
        free = room.free(first + after * along, wide)
        cost += _HIDDEN * np.clip(1.0 - free / _CLEAR, 0.0, 1.5) + _ASIDE * (after != 0.5)
    return cost


def _touched(room: Obstacles, first: Complexes, last: Complexes, price: float) -> Reals:
    """The cost of shapes nearer to lines than the clearance, full where they touch."""
    gaps = np.concatenate([room.lines.gaps(first, last), room.texts.gaps(first, last)], axis=1)
    nearest = np.clip(1.0 - gaps / _CLEAR, 0.0, 1.0).max(axis=1, initial=0.0)
    return np.asarray(price * nearest + (gaps < 0).sum(axis=1))


def _gap(u: Point, wide: float) -> float:
    """Half of the length of a line that a level number covers."""
    across, up = wide / 2 + _GAP, HALF + _GAP / 2
    return min(across / max(abs(u.x), 1e-9), up / max(abs(u.y), 1e-9))


def _head(at: Point, direction: Point) -> Polylines:
    long, half = _HEAD
    back, side = at.plus(direction, long), direction.across
    return Polylines(((at, back.plus(side, half), back.plus(side, -half)),), "dimension-head", closed=True)
