"""A printable document as a value: headings, paragraphs, pictures, tables, space for answers, one below the other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gruebler.pictures.canvas.figure import Figure

_LEGIBLE = 0.8  # names of 13 pixels are then printed with 7.8 points, the smallest texts with 6.6


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading; level 1 is that of a part."""

    text: str
    level: int = 2
    key: str = ""
    """What `Contents` names it by."""


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A text."""

    text: str
    small: bool = False


@dataclass(frozen=True, slots=True)
class Pictures:
    """Pictures side by side, about so many pixels high, with a caption for each."""

    figures: tuple[Figure, ...]
    captions: tuple[str, ...] = ()
    height: float = 230.0

    def scales(self, width: float) -> list[float]:
        """Their scales: to the height, but no text becomes too small to read, and all fit side by side into a width.

        >>> wide = Figure((), width=600, height=400, title="", description="")
        >>> Pictures((wide,), height=200).scales(700), Pictures((wide, wide), height=400).scales(600)
        ([0.8], [0.5, 0.5])
        """
        scales = [min(1.0, max(self.height / figure.height, _LEGIBLE)) for figure in self.figures]
        by_width = sorted(range(len(scales)), key=lambda k: scales[k] * self.figures[k].width)
        for place, k in enumerate(by_width):  # where they do not fit, the widest give way
            wanted = scales[k] * self.figures[k].width
            given = min(wanted, width / (len(scales) - place))
            scales[k] *= given / wanted
            width -= given
        return scales


@dataclass(frozen=True, slots=True)
class Rows:
    """A table."""

    headers: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, slots=True)
class Contents:
    """A table of contents: each row begins with the key of a heading, and ends with its page where there are pages."""

    headers: tuple[str, ...]
    """The last one stands over the pages."""
    rows: tuple[tuple[str, ...], ...]

    @property
    def without_pages(self) -> Rows:
        """The table of a document that is not divided into pages."""
        return Rows(self.headers[:-1], self.rows)

    def with_pages(self, pages: Mapping[str, int]) -> Rows:
        """The table with the page of each heading; empty for one that is not there."""
        return Rows(self.headers, tuple((*row, str(pages.get(row[0], ""))) for row in self.rows))


@dataclass(frozen=True, slots=True)
class AnswerLines:
    """Space for an answer: what is asked, with a line after each, and empty space for the calculation."""

    asked: tuple[str, ...]
    space: float = 90.0
    """In pixels."""


@dataclass(frozen=True, slots=True)
class PageBreak:
    """What follows begins a page."""


Block = Heading | Paragraph | Pictures | Rows | Contents | AnswerLines | PageBreak


@dataclass(frozen=True, slots=True)
class Document:
    """Blocks under a title."""

    title: str
    subtitle: str
    blocks: tuple[Block, ...]
    lang: str = "en"
