"""Several figures as one: side by side, one below the other, with captions, with the sections of a gallery."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from textwrap import wrap

from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.gallery import Section
from gruebler.pictures.canvas.shapes import Point, Shape, TextShape, moved_shape, text_width
from gruebler.pictures.canvas.styles import STYLES

_LETTER, _LINE = 6.5, 16.0  # pixels of a letter and of a line of a caption
_BESIDE = 8.0  # pixels on each side of a caption that is wider than its picture
_HEADING = 34.0  # pixels of the heading of a section
_WIDE = 1400.0  # pixels of a page, about


def pictures_in_one(figures: Sequence[Figure], title: str, columns: int = 2) -> Figure:
    """Pictures in reading order, each in the middle of its cell; columns and rows are as large as needed."""
    columns = min(columns, len(figures))
    wide = [max(figure.width for figure in figures[k::columns]) for k in range(columns)]
    rows = [figures[k : k + columns] for k in range(0, len(figures), columns)]
    shapes: list[Shape] = []
    top = 0.0
    for row in rows:
        high = max(figure.height for figure in row)
        for k, figure in enumerate(row):
            left = sum(wide[:k]) + (wide[k] - figure.width) / 2
            shapes += [moved_shape(shape, Point(left, top + (high - figure.height) / 2)) for shape in figure.shapes]
        top += high
    return Figure(
        tuple(shapes), width=sum(wide), height=top, title=title, description=" ".join(f.description for f in figures)
    )


def captioned(figure: Figure, caption: str) -> Figure:
    """A figure with its caption below, in lines as wide as the figure, and room for longer ones.

    >>> from gruebler.pictures.canvas.shapes import CircleShape, bounds
    >>> dot = Figure((CircleShape(Point(4, 4), 4, "dot"),), width=8, height=8, title="", description="")
    >>> named = captioned(dot, "4.1 Four-bar chain")
    >>> corner, size = bounds(named.shapes, 0.0)
    >>> corner.x >= 0 and corner.x + size.x <= named.width
    True
    """
    lines = wrap(caption, max(20, int(figure.width / _LETTER)))
    wide = max(figure.width, *(text_width(line, STYLES["value"].size) + 2 * _BESIDE for line in lines), 0.0)
    shapes = [moved_shape(shape, Point((wide - figure.width) / 2, 0.0)) for shape in figure.shapes]
    texts = [TextShape(Point(wide / 2, figure.height + _LINE * k), line, "value") for k, line in enumerate(lines)]
    return replace(figure, shapes=(*shapes, *texts), width=wide, height=figure.height + _LINE * (len(lines) + 1))


def stacked(figures: Sequence[Figure], title: str) -> Figure:
    """Figures one below the other."""
    shapes: list[Shape] = []
    top = 0.0
    for figure in figures:
        shapes += [moved_shape(shape, Point(0.0, top)) for shape in figure.shapes]
        top += figure.height
    about = " ".join(figure.description for figure in figures)
    return Figure(
        tuple(shapes), width=max(figure.width for figure in figures), height=top, title=title, description=about
    )


def _rows(figures: Sequence[Figure]) -> list[list[Figure]]:
    """The figures in reading order, as many in a row as its width holds."""
    rows: list[list[Figure]] = [[]]
    for figure in figures:
        if rows[-1] and sum(other.width for other in rows[-1]) + figure.width > _WIDE:
            rows.append([])
        rows[-1].append(figure)
    return rows


def gallery_figure(title: str, sections: Sequence[Section]) -> Figure:
    """A gallery as one picture: each section under its heading, as many pictures side by side as fit."""
    parts = []
    for section in sections:
        figures = [captioned(item.figure, item.caption) for item in section.items]
        columns = max(1, int(_WIDE / max(figure.width for figure in figures)))
        page = pictures_in_one(figures, section.heading or title, columns)
        rows = _rows(figures)
        if len(rows) < -(-len(figures) // columns):  # of pictures of unlike width
            page = stacked([pictures_in_one(row, "", len(row)) for row in rows], section.heading or title)
        if section.heading:
            heading = TextShape(Point(10.0, _HEADING / 2), section.heading, "name", "start")
            shapes = (heading, *(moved_shape(shape, Point(0.0, _HEADING)) for shape in page.shapes))
            page = replace(page, shapes=shapes, height=page.height + _HEADING)
        parts.append(page)
    return stacked(parts, title)
