"""Pictures as in a textbook: black, one thick line a link, widths of lines in millimetres after ISO 128.

A pixel is 1/96 inch, in SVG, PDF and TikZ alike, so that a width in pixels is one in millimetres. Each style is
replaced by a row of the same table, each shape stays where it is: docs/theory/drawing.md.
"""

from __future__ import annotations

from dataclasses import replace

from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.shapes import Point, Polylines, Shape
from gruebler.pictures.canvas.styles import SLOT, STYLES, Style

MILLIMETRE = 96 / 25.4
"""Pixels."""
THICK, THIN = 0.7 * MILLIMETRE, 0.35 * MILLIMETRE
_NOT_DRAWN = ("body-bar", "frame-bar", "body", "frame", "outline-wide", "body-wide", "body-rod", "warning", "rest")
_LINK = Style(stroke="ink", width=THICK)
_PLATE = Style(fill="paper", stroke="ink", width=THICK)
_OWN = {
    "outline-bar": _LINK,
    "outline-rod": _LINK,
    "outline": _PLATE,
    "halo": Style(stroke="paper", width=THICK + 2 * MILLIMETRE),
    "halo-bar": Style(stroke="paper", width=THICK + 2 * MILLIMETRE),
    "area": _PLATE,
    "rail": _LINK,
    "slot-rim": Style(stroke="ink", width=SLOT + 2 * THIN),
    "slot": STYLES["slot"],
    "grid": STYLES["grid"],
    "given": _LINK,
}
"""Styles whose look is not that of the others: fills white, every coloured line thin and black."""


def _black(style: Style) -> Style:
    """Its dashes and its size of text, lines thin and black; white where a body had a colour."""
    fill = style.fill and ("paper" if style.fill in ("paper", "body", "frame", "warning") else "ink")
    return replace(style, fill=fill, stroke=style.stroke and "ink", width=THIN if style.stroke else 0.0)


PREFIX = "textbook-"
STYLES.update(
    {PREFIX + name: _OWN.get(name) or _black(style) for name, style in [*STYLES.items()] if name not in _NOT_DRAWN}
)


def textbook(figure: Figure) -> Figure:
    """The figure in the style of a textbook.

    >>> from gruebler.pictures.canvas.figure import figure_of
    >>> bar = [Polylines(((Point(0, 0), Point(50, 0)),), style) for style in ("outline-bar", "body-bar")]
    >>> [shape.style for shape in textbook(figure_of(bar, "a bar", "")).shapes]
    ['textbook-outline-bar']
    """
    shapes = tuple(_half(replace(shape, style=PREFIX + shape.style)) for shape in figure.shapes if _is_drawn(shape))
    return replace(figure, shapes=shapes)


def _is_drawn(shape: Shape) -> bool:
    return shape.style not in _NOT_DRAWN


def _half(shape: Shape) -> Shape:
    """Hatching across a bar of the frame lies on one side of its line, the lower one."""
    if not isinstance(shape, Polylines) or shape.style != PREFIX + "hatch-bar":
        return shape
    return replace(shape, parts=tuple(_lower_half(*part) for part in shape.parts))


def _lower_half(a: Point, b: Point) -> tuple[Point, Point]:
    low, high = (a, b) if (a.y, a.x) > (b.y, b.x) else (b, a)
    return low.plus(high.minus(low), 0.5), low.plus(low.minus(high), 0.2)
