"""The shapes of a picture.

Lengths are pixels, y points down. Every shape names a row of `styles.STYLES`, which alone determines its look.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import KW_ONLY, dataclass, replace
from typing import NamedTuple

from gruebler.pictures.canvas.styles import STYLES


class Point(NamedTuple):
    """A place or a vector."""

    x: float
    y: float

    def plus(self, other: Point, factor: float = 1.0) -> Point:
        """The place moved by a multiple of a vector."""
        return Point(self.x + factor * other.x, self.y + factor * other.y)

    def minus(self, other: Point) -> Point:
        """The vector from the other place."""
        return Point(self.x - other.x, self.y - other.y)

    def dot(self, other: Point) -> float:
        """The scalar product."""
        return self.x * other.x + self.y * other.y

    @property
    def length(self) -> float:
        """The length of the vector."""
        return math.hypot(self.x, self.y)

    @property
    def unit(self) -> Point:
        """The vector of length 1 in the same direction; to the right for the zero vector."""
        size = self.length
        return Point(self.x / size, self.y / size) if size > 1e-9 else Point(1.0, 0.0)

    @property
    def across(self) -> Point:
        """The vector turned by a right angle, as x is turned to y."""
        return Point(-self.y, self.x)


@dataclass(frozen=True, slots=True)
class Polylines:
    """One or several lines through points, closed or open."""

    parts: tuple[tuple[Point, ...], ...]
    style: str
    closed: bool = False


@dataclass(frozen=True, slots=True)
class CircleShape:
    """A circle."""

    at: Point
    radius: float
    style: str


@dataclass(frozen=True, slots=True)
class ArcShape:
    """An arc of a circle from an angle over an extent of less than a full turn; positive from x to y."""

    at: Point
    _: KW_ONLY
    radius: float
    begin: float
    extent: float
    style: str

    def place(self, part: float) -> Point:
        """The point after this part of the extent."""
        angle = self.begin + part * self.extent
        return Point(self.at.x + self.radius * math.cos(angle), self.at.y + self.radius * math.sin(angle))


@dataclass(frozen=True, slots=True)
class TextShape:
    """A text at a place, its middle at the height of the place; the anchor is start, middle or end."""

    at: Point
    text: str
    style: str
    anchor: str = "middle"


Shape = Polylines | CircleShape | ArcShape | TextShape


def bounds(shapes: Iterable[Shape], margin: float = 10.0) -> tuple[Point, Point]:
    """The upper left corner of shapes with a margin around them, and their width and height."""
    corners = [corner for shape in shapes for corner in _corners(shape)]
    left, top = (min(axis) - margin for axis in zip(*corners, strict=True))
    right, bottom = (max(axis) + margin for axis in zip(*corners, strict=True))
    return Point(left, top), Point(right - left, bottom - top)


_LOWERED = re.compile(r"(?<![^\W₀-₉])([^\W\d_])_([^\W²³]{1,4})(?![^\W²³])")


def split_subscripts(text: str) -> list[tuple[str, bool]]:
    """A text in pieces, each with whether it is a subscript: up to four signs after a letter and an underscore.

    >>> split_subscripts("μ_min = 3°, left_arm")
    [('μ', False), ('min', True), (' = 3°, left_arm', False)]
    >>> split_subscripts("ω_b²")
    [('ω', False), ('b', True), ('²', False)]
    >>> split_subscripts("B₀K_I")
    [('B₀K', False), ('I', True)]
    """
    pieces = _LOWERED.split(text)
    in_order = [(pieces[0], False)]
    for letter, low, following in zip(pieces[1::3], pieces[2::3], pieces[3::3], strict=True):
        in_order[-1] = in_order[-1][0] + letter, False
        in_order += [(low, True), (following, False)]
    return [piece for piece in in_order if piece[0]]


def text_width(text: str, size: float = 13.0) -> float:
    """The approximate width of a text; fonts differ, and this is that of a wide one (DejaVu Sans)."""
    return size * sum(_letter_width(letter) for letter in text)


def _letter_width(letter: str) -> float:
    if letter in "iIjlt.,:;|!'() ":
        return 0.33
    return 0.91 if letter in "mwMW" else 0.68 if letter.isupper() else 0.6


def _corners(shape: Shape) -> Iterator[Point]:
    match shape:
        case Polylines(parts):
            yield from (point for part in parts for point in part)
        case CircleShape(at, radius) | ArcShape(at, radius=radius):
            yield from (Point(at.x - radius, at.y - radius), Point(at.x + radius, at.y + radius))
        case TextShape(at, text, style, anchor):
            wide = text_width(text, STYLES[style].size)
            left = at.x - wide * {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor]
            yield from (Point(left, at.y - 8), Point(left + wide, at.y + 8))


def moved_shape(shape: Shape, by: Point) -> Shape:
    """The shape shifted by a vector."""
    return placed_shape(shape, by.plus)


def placed_shape(shape: Shape, place: Callable[[Point], Point], turn: float = 0.0) -> Shape:
    """The shape moved rigidly: where each of its points comes to, and by how much it turns; texts remain level."""
    match shape:
        case Polylines(parts, style, closed):
            return Polylines(tuple(tuple(map(place, part)) for part in parts), style, closed)
        case ArcShape(at, begin=begin):
            return replace(shape, at=place(at), begin=begin - turn)
        case CircleShape(at) | TextShape(at):
            return replace(shape, at=place(at))


def wrapped_text(text: str, wide: float, size: float) -> list[str]:
    """Lines that are not wider than so many pixels, broken at spaces."""
    lines, line = [], ""
    for word in text.split(" "):
        longer = f"{line} {word}".strip()
        if line and text_width(longer, size) > wide:
            lines.append(line)
            line = word
        else:
            line = longer
    return [*lines, line]
