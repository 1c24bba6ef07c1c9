"""A page of paper: texts, rules and pictures at places; as SVG, HTML, PDF and PNG, always on light ground."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

from gruebler.base.errors import GrueblerError
from gruebler.base.text import reason_of
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.page_policy import policy_element
from gruebler.pictures.canvas.styles import COLOURS
from gruebler.pictures.canvas.svg import style_sheet, svg_element, svg_number, svg_text

WIDTH, HEIGHT = 793.7, 1122.5
"""Of A4, in pixels of 1/96 inch."""
SUFFIXES = ("svg", "html", "pdf", "png")
_POINTS = 72 / 96


@dataclass(frozen=True, slots=True, kw_only=True)
class TextLine:
    """A line of text; ``y`` is its base line, the role one of the colours."""

    x: float
    y: float
    text: str
    size: float = 11.5
    bold: bool = False
    role: str = "ink"
    anchor: str = "start"


@dataclass(frozen=True, slots=True)
class HorizontalRule:
    """A level line."""

    x: float
    y: float
    length: float
    width: float = 0.8


@dataclass(frozen=True, slots=True)
class PlacedPicture:
    """A picture with the place of its upper left corner."""

    x: float
    y: float
    scale: float
    figure: Figure


@dataclass(frozen=True, slots=True)
class Logo:
    """A picture of somebody's own, as a PNG file."""

    name: str
    """Of the file."""
    png: bytes

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in its own pixels."""
        return int.from_bytes(self.png[16:20]), int.from_bytes(self.png[20:24])

    @property
    def link(self) -> str:
        """The picture itself as an address."""
        return f"data:image/png;base64,{base64.b64encode(self.png).decode('ascii')}"


def read_logo(path: str | Path) -> Logo:
    """The logo in a file; `GrueblerError` if it cannot be read or is no PNG."""
    try:
        png = Path(path).read_bytes()
    except OSError as error:
        raise GrueblerError("{path}: cannot be read ({reason})", path=path, reason=reason_of(error)) from None
    if not png.startswith(_PNG) or 0 in Logo("", png).size:
        raise GrueblerError("{path}: expected a logo as a PNG picture", path=path)
    return Logo(Path(path).name, png)


_PNG = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"


@dataclass(frozen=True, slots=True)
class PlacedLogo:
    """A logo with the place of its upper right corner."""

    x: float
    y: float
    height: float
    logo: Logo

    @property
    def width(self) -> float:
        """On the page."""
        wide, high = self.logo.size
        return self.height * wide / high


@dataclass(frozen=True, slots=True)
class Page:
    """Items on a page of A4."""

    items: tuple[TextLine | HorizontalRule | PlacedPicture | PlacedLogo, ...]
    title: str
    description: str
    lang: str

    def svg(self) -> str:
        """The page as SVG of the size of the paper, with text as text elements."""
        used = sorted({shape.style for item in self._pictures() for shape in item.figure.shapes})
        rules = style_sheet(used).partition("@media")[0]
        return "\n".join(
            [
                f'<svg xmlns="http://www.w3.org/2000/svg" class="gr" role="img" lang="{self.lang}" width="210mm" '
                f'height="297mm" viewBox="0 0 {WIDTH} {HEIGHT}">',
                f"<title>{escape(self.title)}</title><desc>{escape(self.description)}</desc>",
                f"<style>{rules}</style>",
                f'<rect width="{WIDTH}" height="{HEIGHT}" fill="{COLOURS["paper"][0]}"/>',
                *(_SVG[type(item)](item) for item in self.items),
                "</svg>\n",
            ]
        )

    def html(self) -> str:
        """A document with the page alone, printed on A4 without margins."""
        return (
            f'<!DOCTYPE html>\n<html lang="{self.lang}"><head><meta charset="utf-8">{policy_element()}'
            f"<title>{escape(self.title)}</title>"
            "<style>@page{size:A4;margin:0}body{margin:0;background:#fff}"
            "svg{display:block;margin:0 auto;max-width:100%;height:auto}"
            "@media print{svg{width:210mm;height:297mm}}</style></head><body>\n"
            f"{self.svg()}</body></html>\n"
        )

    def written(self, suffix: str) -> bytes:
        """The content of a file of this kind; `GrueblerError` if matplotlib is needed and missing."""
        if suffix in ("svg", "html"):
            return (self.svg() if suffix == "svg" else self.html()).encode("utf-8")
        canvas = painted(self)
        memory = io.BytesIO()
        metadata: dict[str, Any] = {"Title": self.title}
        metadata |= {"CreationDate": None, "Creator": None} if suffix == "pdf" else {"Software": None}
        canvas.savefig(memory, format=suffix, dpi=192, metadata=metadata)
        return memory.getvalue()

    def _pictures(self) -> Iterable[PlacedPicture]:
        return (item for item in self.items if isinstance(item, PlacedPicture))


# --- SVG --------------------------------------------------------------------------------------------


def _words_svg(item: TextLine) -> str:
    style = f'font-size="{item.size:g}" fill="{COLOURS[item.role][0]}"' + ' font-weight="bold"' * item.bold
    text = svg_text(item.text, item.size)
    anchor = "" if item.anchor == "start" else f' text-anchor="{item.anchor}"'
    return f'<text x="{svg_number(item.x)}" y="{svg_number(item.y)}" {style}{anchor}>{text}</text>'


def _rule_svg(item: HorizontalRule) -> str:
    line = f"M{svg_number(item.x)} {svg_number(item.y)}h{svg_number(item.length)}"
    return f'<path d="{line}" stroke="{COLOURS["ink"][0]}" stroke-width="{item.width:g}" fill="none"/>'


def _placed_svg(item: PlacedPicture) -> str:
    place = f"translate({svg_number(item.x)} {svg_number(item.y)}) scale({item.scale:.4g})"
    shapes = "\n".join(map(svg_element, item.figure.shapes))
    return f'<g transform="{place}"><title>{escape(item.figure.title)}</title>\n{shapes}\n</g>'


def _logo_svg(item: PlacedLogo) -> str:
    place = f'x="{svg_number(item.x - item.width)}" y="{svg_number(item.y)}"'
    size = f'width="{svg_number(item.width)}" height="{svg_number(item.height)}"'
    return f'<image {place} {size} href="{item.logo.link}"/>'


_SVG: dict[type, Any] = {
    TextLine: _words_svg,
    HorizontalRule: _rule_svg,
    PlacedPicture: _placed_svg,
    PlacedLogo: _logo_svg,
}


# --- matplotlib -------------------------------------------------------------------------------------


def painted(page: Page) -> Any:
    """The page as a figure of matplotlib; `GrueblerError` if it is not installed."""
    from gruebler.pictures.canvas.matplotlib_files import matplotlib_figure

    canvas = matplotlib_figure(Figure((), width=WIDTH, height=HEIGHT, title=page.title, description=page.description))
    for item in page.items:
        _PAINT[type(item)](canvas, item)
    return canvas


def _paint_words(canvas: Any, item: TextLine) -> None:
    from gruebler.pictures.canvas.matplotlib_files import math_text

    text, has_subscripts = math_text(item.text)
    canvas.text(
        item.x / WIDTH,
        1 - item.y / HEIGHT,
        text,
        fontsize=item.size * _POINTS,
        fontweight="bold" if item.bold else "normal",
        color=COLOURS[item.role][0],
        ha={"start": "left", "middle": "center", "end": "right"}[item.anchor],
        va="baseline",
        parse_math=has_subscripts,
    )


def _paint_rule(canvas: Any, item: HorizontalRule) -> None:
    from matplotlib.lines import Line2D

    ends, level = (item.x / WIDTH, (item.x + item.length) / WIDTH), 1 - item.y / HEIGHT
    canvas.add_artist(Line2D(ends, (level, level), linewidth=item.width * _POINTS, color=COLOURS["ink"][0]))


def _paint_placed(canvas: Any, item: PlacedPicture) -> None:
    from gruebler.pictures.canvas.matplotlib_files import paint_shapes

    wide, high = item.scale * item.figure.width, item.scale * item.figure.height
    axes = canvas.add_axes((item.x / WIDTH, 1 - (item.y + high) / HEIGHT, wide / WIDTH, high / HEIGHT))
    paint_shapes(axes, item.figure, scale=item.scale)


def _paint_logo(canvas: Any, item: PlacedLogo) -> None:
    from matplotlib.image import imread

    left, low = (item.x - item.width) / WIDTH, 1 - (item.y + item.height) / HEIGHT
    axes = canvas.add_axes((left, low, item.width / WIDTH, item.height / HEIGHT))
    axes.imshow(imread(io.BytesIO(item.logo.png)), aspect="auto", cmap="gray")
    axes.set_axis_off()


_PAINT: dict[type, Any] = {
    TextLine: _paint_words,
    HorizontalRule: _paint_rule,
    PlacedPicture: _paint_placed,
    PlacedLogo: _paint_logo,
}
