"""A picture as a value: shapes in painting order, independent of the file format.

Lengths are pixels, y points down. Every shape names a row of `styles.STYLES`, which alone determines its look.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import KW_ONLY, dataclass

from gruebler.base.notebook import brief
from gruebler.pictures.canvas.shapes import Point, Shape, bounds, moved_shape
from gruebler.pictures.canvas.styles import STYLES, TEXTBOOK
from gruebler.pictures.canvas.svg import style_sheet, svg_element, svg_number, with_attributes, xml_text


@brief
@dataclass(frozen=True, slots=True, repr=False)
class Figure:
    """Shapes within 0 <= x <= width, 0 <= y <= height, with a title and a description for those who cannot see."""

    shapes: tuple[Shape, ...]
    _: KW_ONLY
    width: float
    height: float
    title: str
    description: str
    notes: tuple[str, ...] = ()
    """Sentences about requested elements that could not be shown."""

    def svg(self, *, styled: bool = True) -> str:
        """The picture as SVG; unstyled for a page that has the style rules."""
        return svg(self, styled=styled)

    def _repr_svg_(self) -> str:
        return self.svg()


MARGIN = 16.0
"""Pixels around pictures of linkages; half the width of a link with a slot is less."""


def figure_of(
    shapes: Iterable[Shape], title: str, description: str, margin: float = 10.0, notes: Iterable[str] = ()
) -> Figure:
    """The smallest figure around the shapes."""
    all_shapes = tuple(shapes)
    corner, size = bounds(all_shapes, margin)
    placed = tuple(moved_shape(shape, Point(-corner.x, -corner.y)) for shape in all_shapes)
    return Figure(placed, width=size.x, height=size.y, title=title, description=description, notes=tuple(notes))


def svg(figure: Figure, *, styled: bool = True) -> str:
    """The document; with ``styled`` it includes the rules of its styles, so it does not depend on the page.

    A figure in the style of a textbook, which is for paper, has them as attributes, which Word takes as well.

    >>> from gruebler.pictures.canvas.shapes import CircleShape, Point
    >>> svg(figure_of([CircleShape(Point(0, 0), 5, "joint")], "one < two", "a circle"), styled=False).splitlines()[1]
    '<title>one &lt; two</title><desc>a circle</desc>'
    """
    used = [shape.style for shape in figure.shapes]
    if styled and any(style.startswith(TEXTBOOK) for style in used):
        return with_attributes(svg_document(figure, None, map(svg_element, figure.shapes)))
    return svg_document(figure, used if styled else None, map(svg_element, figure.shapes))


def svg_document(page: Figure, used: Iterable[str] | None, lines: Iterable[str]) -> str:
    """A page of the size of a figure, with its title and description, around elements that use these styles."""
    width, height = svg_number(page.width), svg_number(page.height)
    styles = None if used is None else sorted({"ground", *used}, key=list(STYLES).index)
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" class="gr" role="img" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}">',
            f"<title>{xml_text(page.title)}</title><desc>{xml_text(page.description)}</desc>",
            *([] if styles is None else [f"<style>{style_sheet(styles)}</style>"]),
            f'<rect class="gr-ground" width="{width}" height="{height}" rx="6"/>',
            *lines,
            "</svg>\n",
        ]
    )
