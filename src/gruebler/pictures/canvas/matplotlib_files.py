"""Figures as PNG and PDF, painted by matplotlib, which is in the extra ``[plot]`` and is imported only here."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Sequence
from textwrap import wrap
from typing import Any, BinaryIO

from gruebler.base.errors import GrueblerError
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.gallery import Item, Section
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Polylines, Shape, TextShape, split_subscripts
from gruebler.pictures.canvas.styles import COLOURS, STYLES

_POINTS = 72 / 96  # of print, to a pixel


def save_figure(figure: Figure, file: BinaryIO, suffix: str, *, zoom: float = 3.0, dark: bool = False) -> None:
    """Write a figure as ``png`` (``zoom`` times the pixels) or ``pdf``, on light or dark ground.

    Raises `GrueblerError` if matplotlib is not installed.
    """
    canvas = matplotlib_figure(figure, dark=dark)
    canvas.savefig(file, format=suffix, dpi=96 * zoom, metadata=_METADATA[suffix] | {"Title": figure.title})


_METADATA: dict[str, dict[str, Any]] = {"png": {"Software": None}, "pdf": {"CreationDate": None, "Creator": None}}


def matplotlib_figure(figure: Figure, *, dark: bool = False) -> Any:
    """The figure as one of matplotlib's, without pyplot, 96 pixels to the inch."""
    paper = COLOURS["paper"][dark]
    canvas = _library().Figure(figsize=(figure.width / 96, figure.height / 96), facecolor=paper)
    axes = canvas.add_axes((0, 0, 1, 1))
    paint_shapes(axes, figure, dark=dark)
    return canvas


def _library() -> Any:
    try:
        from matplotlib import figure
        from matplotlib.backends import backend_agg, backend_pdf  # noqa: F401
    except ImportError:
        raise GrueblerError(
            "pixel images and PDF need matplotlib, which is not installed: pip install 'gruebler[plot]'; .svg and "
            ".html need no further package"
        ) from None
    return figure


def paint_shapes(axes: Any, figure: Figure, *, scale: float = 1.0, dark: bool = False) -> None:
    """Paint a figure on axes; ``scale`` is the size of a pixel there, at 96 to the inch."""
    axes.set_xlim(0, figure.width)
    axes.set_ylim(figure.height, 0)
    axes.set_aspect("equal")
    axes.axis("off")
    for order, shape in enumerate(figure.shapes):
        _paint(axes, shape, order, scale * _POINTS, dark)


def _paint(axes: Any, shape: Shape, order: int, point: float, dark: bool) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    style = STYLES[shape.style]
    if isinstance(shape, TextShape):
        text, has_subscripts = math_text(shape.text)
        axes.text(
            *shape.at,
            text,
            fontsize=style.size * point,
            color=COLOURS[style.fill][dark],
            ha={"start": "left", "middle": "center", "end": "right"}[shape.anchor],
            va="center_baseline",
            zorder=order,
            parse_math=has_subscripts,
        )
        return
    match shape:
        case Polylines(parts, _, closed):
            outline = (
                Outline.make_compound_path(*(_line(part, closed) for part in parts)) if parts else Outline([(0, 0)])
            )
        case CircleShape(at, radius):
            outline = Outline.circle(at, radius)
        case ArcShape():
            steps = max(2, math.ceil(abs(shape.extent) / 0.05))
            outline = Outline([shape.place(k / steps) for k in range(steps + 1)])
    axes.add_patch(
        PathPatch(
            outline,
            facecolor=(COLOURS[style.fill][dark], style.opacity) if style.fill else "none",
            edgecolor=COLOURS[style.stroke][dark] if style.stroke else "none",
            linewidth=style.width * point,
            linestyle=(0, [length / style.width for length in style.dash]) if style.dash else "-",
            capstyle="round",
            joinstyle="round",
            zorder=order,
        )
    )


def math_text(text: str) -> tuple[str, bool]:
    """Text in the notation of matplotlib, with upright subscripts; and whether there are subscripts."""
    pieces = split_subscripts(text)
    if len(pieces) == 1:
        return text, False
    plain = [(piece.replace("$", r"\$"), low) for piece, low in pieces]
    return "".join(rf"$_\mathregular{{{piece}}}$" if low else piece for piece, low in plain), True


def _line(part: Sequence[tuple[float, float]], closed: bool) -> Any:
    from matplotlib.path import Path as Outline

    return Outline([*part, part[0]], closed=True) if closed else Outline(part)


_A4 = (210 / 25.4, 297 / 25.4)
_LEFT, _TOP, _BOTTOM = 0.05, 0.95, 0.04
_ROW, _HEADING, _TITLE = 0.15, 0.022, 0.012  # of the height of a page
_COLUMNS = (5, 3, 2, 1)
_LEGIBLE = 0.62  # of their size: pictures are reduced to this at most, otherwise a row has fewer of them
_CODE = 5.0  # points


def gallery_pdf(title: str, sections: Iterable[Section], *, note: str = "") -> bytes:
    """The gallery on A4 pages, up to five pictures in a row, fewer where texts in them would be illegible.

    Raises `GrueblerError` if matplotlib is not installed.
    """
    library = _library()
    from matplotlib.backends.backend_pdf import PdfPages

    memory = io.BytesIO()
    with PdfPages(memory, metadata=_METADATA["pdf"] | {"Title": title}) as pages:
        page, top = library.Figure(figsize=_A4), _TOP - _TITLE
        page.text(_LEFT, _TOP, f"{title}. {note}", fontsize=11, va="center", parse_math=False)
        for section in sections:
            columns = _columns(section)
            high = _ROW * _COLUMNS[0] / columns if columns > 1 else _TALL
            rows = [section.items[k : k + columns] for k in range(0, len(section.items), columns)]
            for number, row in enumerate(rows):
                headed = number == 0 and bool(section.heading)
                if top - high - _HEADING * headed < _BOTTOM:
                    pages.savefig(page)
                    page, top = library.Figure(figsize=_A4), _TOP + _HEADING
                if headed:
                    page.text(_LEFT, top - _HEADING / 2, section.heading, fontsize=9, va="center", parse_math=False)
                    top -= _HEADING
                for k, item in enumerate(row):
                    wide = (1 - 2 * _LEFT) / columns
                    _paint_item(page, item, (_LEFT + k * wide, top), (wide, high))
                top -= high
        pages.savefig(page)
    return memory.getvalue()


def pages_pdf(title: str, figures: Iterable[Figure]) -> bytes:
    """Figures on pages of A4 in landscape, each as large as it fits; `GrueblerError` if matplotlib is not installed."""
    library = _library()
    from matplotlib.backends.backend_pdf import PdfPages

    high, wide = _A4
    memory = io.BytesIO()
    with PdfPages(memory, metadata=_METADATA["pdf"] | {"Title": title}) as pages:
        for figure in figures:
            page = library.Figure(figsize=(wide, high))
            scale = 96 * (1 - 2 * _LEFT) * min(wide / figure.width, high / figure.height)
            across, up = scale * figure.width / 96 / wide, scale * figure.height / 96 / high
            axes = page.add_axes(((1 - across) / 2, (1 - up) / 2, across, up))
            paint_shapes(axes, figure, scale=scale)
            pages.savefig(page)
    return memory.getvalue()


_TALL = 0.42  # of the height of a page, for one picture in a row


def _columns(section: Section) -> int:
    """The number of pictures in a row of a section."""
    for columns in _COLUMNS:
        wide, high = (1 - 2 * _LEFT) / columns, _ROW * _COLUMNS[0] / columns
        if all(_scale(item.figure, wide, high) >= _least_scale(item.figure) for item in section.items):
            return columns
    return _COLUMNS[-1]


def _least_scale(figure: Figure) -> float:
    """To what a picture may be reduced: one without texts further."""
    return _LEGIBLE if any(isinstance(shape, TextShape) for shape in figure.shapes) else _LEGIBLE / 3


def _scale(figure: Figure, wide: float, high: float) -> float:
    """The scale of a picture in a cell of a page."""
    return min(1.0, 96 * min((wide - 0.016) * _A4[0] / figure.width, (high - 0.046) * _A4[1] / figure.height))


def _paint_item(page: Any, item: Item, corner: tuple[float, float], size: tuple[float, float]) -> None:
    """A picture in its cell, caption and code below it."""
    (left, top), (column, row) = corner, size
    box = (left + 0.008, top - row + 0.042, column - 0.016, row - 0.046)
    scale = _scale(item.figure, column, row)
    wide, high = scale * item.figure.width / 96 / _A4[0], scale * item.figure.height / 96 / _A4[1]
    middle = left + column / 2
    axes = page.add_axes((middle - wide / 2, box[1] + (box[3] - high) / 2, wide, high))
    paint_shapes(axes, item.figure, scale=scale)
    lines = wrap(item.caption, round(150 * column))
    page.text(middle, box[1] - 0.003, "\n".join(lines), fontsize=7, ha="center", va="top", parse_math=False)
    code = "\n".join(wrap(item.code, round(190 * column)))
    below = box[1] - 0.005 - 0.0105 * len(lines)
    page.text(middle, below, code, fontsize=_CODE, ha="center", va="top", parse_math=False)
