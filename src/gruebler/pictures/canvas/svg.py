"""Figures as SVG: small, reproducible, with title and description, with text as text elements."""

from __future__ import annotations

import math
import re
from xml.sax.saxutils import escape

from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape, TextShape, split_subscripts
from gruebler.pictures.canvas.styles import COLOURS, STYLES, USUAL, Style

_CONTROLS = dict.fromkeys((*range(9), 11, 12, *range(14, 32), 65534, 65535, *range(55296, 57344)))


def style_sheet(used: list[str] | None = None) -> str:
    """The rules of these styles, or of all, on light and dark ground; every class begins with ``gr``."""
    names = USUAL if used is None else used
    rules = [".gr{stroke-linecap:round;stroke-linejoin:round;font-family:sans-serif}"]
    rules += [f".gr-{name}{{{_declarations(STYLES[name], 0)}}}" for name in names]
    dark = "".join(f".gr-{name}{{{_declarations(STYLES[name], 1)}}}" for name in names)
    return "".join(rules) + "@media(prefers-color-scheme:dark){" + dark + "}"


def _declarations(style: Style, ground: int) -> str:
    parts = [f"fill:{COLOURS[style.fill][ground] if style.fill else 'none'}"]
    if style.stroke:
        parts.append(f"stroke:{COLOURS[style.stroke][ground]}")
    if ground == 0 and style.stroke:
        parts.append(f"stroke-width:{style.width:g}")
    if ground == 0 and style.dash:
        parts.append(f"stroke-dasharray:{' '.join(f'{length:g}' for length in style.dash)}")
    if ground == 0 and style.opacity < 1:
        parts.append(f"fill-opacity:{style.opacity:g}")
    if ground == 0 and style.size:
        parts.append(f"font-size:{style.size:g}px")
    return ";".join(parts if ground == 0 else [p for p in parts if p != "fill:none"])


_CLASS = re.compile(r' class="gr(?:-([\w-]+))?"')


def with_attributes(document: str) -> str:
    """A document with the look of each class in attributes, on light ground: for programs that read no style rules.

    >>> with_attributes('<path class="gr-dot" d="M0 0"/>')
    '<path fill="#22262b" d="M0 0"/>'
    """

    def look(match: re.Match[str]) -> str:
        if match[1] is None:
            return ' stroke-linecap="round" stroke-linejoin="round" font-family="Arial, Helvetica, sans-serif"'
        declared = (part.split(":") for part in _declarations(STYLES[match[1]], 0).split(";"))
        return "".join(f' {name}="{value}"' for name, value in declared)

    return _CLASS.sub(look, document)


def svg_element(shape: Shape) -> str:
    """A shape as an element of SVG."""
    match shape:
        case Polylines(style=style):
            return f'<path class="gr-{style}" d="{svg_path(shape)}"/>'
        case CircleShape(at, radius, style):
            return (
                f'<circle class="gr-{style}" cx="{svg_number(at.x)}" cy="{svg_number(at.y)}" r="{svg_number(radius)}"/>'
            )
        case ArcShape(radius=radius, extent=extent, style=style):
            size = svg_number(radius)
            flags = f"{int(abs(extent) > math.pi)} {int(extent > 0)}"
            ends = _pair(shape.place(0)), _pair(shape.place(1))
            return f'<path class="gr-{style}" d="M{ends[0]}A{size} {size} 0 {flags} {ends[1]}"/>'
        case TextShape(at, text, style, anchor):
            position = f'x="{svg_number(at.x)}" y="{svg_number(at.y + 0.35 * STYLES[style].size)}"'
            anchored = "" if anchor == "start" else f' text-anchor="{anchor}"'
            return f'<text class="gr-{style}" {position}{anchored}>{svg_text(text, STYLES[style].size)}</text>'


def svg_path(lines: Polylines) -> str:
    """Lines as the data of a path."""
    return "".join("M" + "L".join(map(_pair, part)) + "Z" * lines.closed for part in lines.parts)


def _pair(point: Point) -> str:
    return f"{svg_number(point.x)} {svg_number(point.y)}"


def svg_number(value: float) -> str:
    """Tenths of a pixel; no minus zero."""
    return f"{round(value, 1) + 0.0:g}" if abs(value) < 1e5 else f"{value:.0f}"


def svg_text(text: str, size: float) -> str:
    """Text with subscripts, after which the base line is restored; the size is that of the letters."""
    pieces = split_subscripts(text)
    if len(pieces) == 1:
        return xml_text(text)
    markup, was_low = "", False
    for piece, low in pieces:
        shift = 0.25 * size * (low - was_low)
        small = f' font-size="{svg_number(0.75 * size)}"' if low else ""
        visible = piece.lstrip(" ")
        markup += " " * (
            len(piece) - len(visible)
        )  # before the tspan: in it, some viewers drop spaces at its beginning
        markup += (
            f'<tspan dy="{svg_number(shift)}"{small}>{xml_text(visible)}</tspan>'
            if shift or small
            else xml_text(visible)
        )
        was_low = low
    return markup


def xml_text(text: str) -> str:
    """Text escaped for XML, without control characters."""
    return escape(text.translate(_CONTROLS))
