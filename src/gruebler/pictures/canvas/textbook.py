"""Pictures as in a textbook: black, one thick line a link, widths of lines in millimetres after ISO 128.

A pixel is 1/96 inch, in SVG, PDF and TikZ alike, so that a width in pixels is one in millimetres. Each style is
replaced by a row of the same table, each shape stays where it is: docs/theory/drawing.md.
"""

from __future__ import annotations

from dataclasses import replace

from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.shapes import Point, Polylines, Shape
from gruebler.pictures.canvas.styles import TEXTBOOK, UNLIKE_TEXTBOOKS


def textbook(figure: Figure) -> Figure:
    """The figure in the style of a textbook.

    >>> from gruebler.pictures.canvas.figure import figure_of
    >>> bar = [Polylines(((Point(0, 0), Point(50, 0)),), style) for style in ("outline-bar", "body-bar")]
    >>> [shape.style for shape in textbook(figure_of(bar, "a bar", "")).shapes]
    ['textbook-outline-bar']
    """
    shapes = tuple(_half(replace(shape, style=TEXTBOOK + shape.style)) for shape in figure.shapes if _is_drawn(shape))
    return replace(figure, shapes=shapes)


def _is_drawn(shape: Shape) -> bool:
    return shape.style not in UNLIKE_TEXTBOOKS


def _half(shape: Shape) -> Shape:
    """Hatching across a bar of the frame lies on one side of its line, the lower one."""
    if not isinstance(shape, Polylines) or shape.style != TEXTBOOK + "hatch-bar":
        return shape
    return replace(shape, parts=tuple(_lower_half(*part) for part in shape.parts))


def _lower_half(a: Point, b: Point) -> tuple[Point, Point]:
    low, high = (a, b) if (a.y, a.x) > (b.y, b.x) else (b, a)
    return low.plus(high.minus(low), 0.5), low.plus(low.minus(high), 0.2)
