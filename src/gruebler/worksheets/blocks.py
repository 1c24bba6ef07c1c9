"""A printable document as a value: headings, paragraphs, pictures, tables, space for answers, one below the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from gruebler.drawing.canvas.figure import Figure

__all__ = ["AnswerLines", "Block", "Document", "Heading", "PageBreak", "Paragraph", "Pictures", "Rows"]


class Heading(NamedTuple):
    """A heading; level 1 is that of a part."""

    text: str
    level: int = 2


class Paragraph(NamedTuple):
    """A text."""

    text: str
    small: bool = False


class Pictures(NamedTuple):
    """Pictures side by side, at most so many pixels high, with a caption for each."""

    figures: tuple[Figure, ...]
    captions: tuple[str, ...] = ()
    height: float = 230.0


class Rows(NamedTuple):
    """A table."""

    headers: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


class AnswerLines(NamedTuple):
    """Space for an answer: what is asked, with a line after each, and empty space for the calculation."""

    asked: tuple[str, ...]
    space: float = 90.0
    """In pixels."""


class PageBreak(NamedTuple):
    """What follows begins a page."""


Block = Heading | Paragraph | Pictures | Rows | AnswerLines | PageBreak


@dataclass(frozen=True, slots=True)
class Document:
    """Blocks under a title."""

    title: str
    subtitle: str
    blocks: tuple[Block, ...]
    lang: str = "en"
