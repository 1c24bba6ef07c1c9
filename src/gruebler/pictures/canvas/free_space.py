"""Free space in a picture: the distances of texts and lines from existing shapes, for many places at once."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TypeVar

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Integers, Reals
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape, TextShape, text_width
from gruebler.pictures.canvas.styles import STYLES

HALF = 7.0
"""Half the height of a text."""
_FILLED = ("body", "frame", "area", "block", "block-frame")
_ROUND = ("area", "block-frame")
_ARC_STEP = 0.2  # radians
_RIM = 36  # edges of a circle
_FAR = 1e5
_FROM_ANCHOR = {"start": 0.5, "middle": 0.0, "end": -0.5}

_Stroke = tuple[complex, complex, float]
_Z = TypeVar("_Z", complex, Complexes)


class Obstacles:
    """The drawn shapes: strokes with half their width, texts as horizontal strokes, and filled polygons.

    With ``inside`` a text may stand on a wheel, cam or other round part, and only its outline is in the way.
    """

    def __init__(self, shapes: Sequence[Shape], *, inside: bool = False) -> None:
        self.filled = [
            complexes(part)
            for shape in shapes
            if isinstance(shape, Polylines) and shape.closed and shape.style in _FILLED
            for part in shape.parts
            if not (inside and shape.style in _ROUND)
        ]
        outlined = [_rim(shape) if inside and shape.style in _ROUND else shape for shape in shapes]
        self.lines = _Strokes([stroke for shape in outlined for stroke in _strokes(shape)])
        self.texts = _Strokes([_text(shape) for shape in shapes if isinstance(shape, TextShape)])

    def take(self, at: Point, wide: float, leader: Sequence[Point] = ()) -> None:
        """Add a text to the obstacles, and the line that leads to it."""
        self.texts = self.texts.plus((*_core(complex(*at), wide), HALF))
        for a, b in pairwise(leader):
            self.lines = self.lines.plus((complex(*a), complex(*b), 0.5))

    def free(self, places: Complexes, wide: float) -> Reals:
        """The free pixels around a text at each of some places; negative where it would touch a shape."""
        first, last = _core(places, wide)
        gap = np.minimum(self.lines.gap(first, last), self.texts.gap(first, last)) - HALF
        covered = self.covered(first) | self.covered(last) | self.covered(places)
        return np.where(covered, np.minimum(gap, -HALF), gap)

    def covered(self, places: Complexes) -> Flags:
        """Whether places lie on a filled polygon."""
        covered = np.zeros(len(places), bool)
        for corners in self.filled:
            covered |= is_inside(places, corners)
        return covered

    def open(self, places: Complexes, directions: Complexes) -> Flags:
        """Whether the places are at the rim of the picture: no shape lies beyond them in the given directions."""
        return self.lines.gap(places, places + _FAR * directions) > 0


class _Strokes:
    """Segments with half their width, as arrays."""

    def __init__(self, strokes: Sequence[_Stroke]) -> None:
        self.rows = list(strokes)
        strokes_table = np.array(self.rows, np.complex128).reshape(-1, 3)
        self.a, self.b, self.half = strokes_table[:, 0], strokes_table[:, 1], strokes_table[:, 2].real

    def plus(self, stroke: _Stroke) -> _Strokes:
        return _Strokes([*self.rows, stroke])

    def gaps(self, first: Complexes, last: Complexes) -> Reals:
        """Pixels between lines (rows) and all strokes (columns); negative where they overlap."""
        return np.asarray(distance_between(first[:, None], last[:, None], self.a[None, :], self.b[None, :]) - self.half)

    def crossed(self, first: Complexes, last: Complexes) -> Integers:
        """How many of the strokes each of some lines crosses."""
        return np.asarray((self.gaps(first, last) < 0).sum(axis=1))

    def gap(self, first: Complexes, last: Complexes) -> Reals:
        """The smallest of the gaps; infinite without strokes."""
        return np.asarray(np.min(self.gaps(first, last), axis=1, initial=np.inf))


def _strokes(shape: Shape) -> Iterator[_Stroke]:
    match shape:
        case Polylines(parts, style, closed) if not style.startswith("halo"):
            half = STYLES[style].width / 2
            for part in parts:
                ends = [*part, part[0]] if closed else list(part)
                yield from ((complex(*a), complex(*b), half) for a, b in pairwise(ends))
        case ArcShape(style="measure"):  # of an angle: beside it there is room
            steps = max(2, math.ceil(abs(shape.extent) / _ARC_STEP))
            places = [shape.place(k / steps) for k in range(steps + 1)]
            yield from ((complex(*a), complex(*b), STYLES["measure"].width / 2) for a, b in pairwise(places))
        case CircleShape(at, radius) | ArcShape(at, radius=radius):
            yield complex(*at), complex(*at), radius


def _rim(shape: Shape) -> Shape:
    """A circle as the line around it; any other shape as it is."""
    if not isinstance(shape, CircleShape):
        return shape
    turns = (math.tau * k / _RIM for k in range(_RIM))
    return Polylines(
        (tuple(shape.at.plus(Point(math.cos(t), math.sin(t)), shape.radius) for t in turns),), shape.style, closed=True
    )


def _text(text: TextShape) -> _Stroke:
    wide = text_width(text.text, STYLES[text.style].size)
    return *_core(complex(text.at.x + _FROM_ANCHOR[text.anchor] * wide, text.at.y), wide), HALF


def _core(at: _Z, wide: float) -> tuple[_Z, _Z]:
    """The middle line of a text; the text lies within half its height of it."""
    half = max(0.0, wide / 2 - HALF)
    return at - half, at + half


def complexes(points: Sequence[Point]) -> Complexes:
    """Points as x + iy."""
    return np.array([complex(*p) for p in points], np.complex128)


def from_segment(p: Complexes, a: Complexes, b: Complexes) -> Reals:
    """The distance of points from segments; arrays of compatible shapes.

    >>> from_segment(np.array([1j, 3 + 0j]), np.array([0j]), np.array([2 + 0j])).tolist()
    [1.0, 1.0]
    """
    along = b - a
    square = np.abs(along) ** 2
    t = np.clip(((p - a) * along.conj()).real / np.where(square > 0, square, 1.0), 0.0, 1.0)
    return np.asarray(np.abs(p - a - t * along))


def distance_between(a: Complexes, b: Complexes, c: Complexes, d: Complexes) -> Reals:
    """The distance of the segments a-b from the segments c-d; 0 where they cross."""

    def side(p: Complexes, q: Complexes, r: Complexes) -> Reals:
        return np.asarray(((q - p).conj() * (r - p)).imag)

    crossing = (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)
    ends = (from_segment(a, c, d), from_segment(b, c, d), from_segment(c, a, b), from_segment(d, a, b))
    return np.where(crossing, 0.0, np.minimum.reduce(np.broadcast_arrays(*ends)))


def is_inside(places: Complexes, corners: Complexes) -> Flags:
    """Whether places lie inside a polygon.

    >>> is_inside(np.array([1 + 1j, 3 + 1j]), np.array([0, 2, 2 + 2j, 2j])).tolist()
    [True, False]
    """
    p, a, b = places[:, None], corners[None, :], np.roll(corners, -1)[None, :]
    spans = (a.imag > p.imag) != (b.imag > p.imag)
    rise = np.where(spans, b.imag - a.imag, 1.0)
    cuts = spans & (p.real < a.real + (p.imag - a.imag) / rise * (b.real - a.real))
    return np.asarray(cuts.sum(axis=1) % 2 == 1)
