"""A printable document as a value: headings, paragraphs, pictures, tables, space for answers, one below the other."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, replace

from gruebler.pictures.canvas.figure import Figure
from gruebler.teaching.sheets.page import Logo

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
    blocks: tuple[Block, ...]
    _: KW_ONLY
    subtitle: str = ""
    lang: str = "en"
    logo: Logo | None = None
    """In the head of each page, or above the title where there are none."""

    def typeset(self) -> Document:
        """With indices and minus signs as in print."""
        return replace(self, title=typeset(self.title), blocks=tuple(map(_typeset_block, self.blocks)))


_NUMBERED = re.compile(r"(?<![\w=])([^\W\d_])([0-9])(?:_(\w)(?!\w))?(?![\w])")
_PIVOTS = re.compile(r"(?<!\w)(?=[A-Z0]*[A-Z]0)(?:[A-Z]0?){2,}(?!\w)")
_PRIMES = re.compile(r"(?<=(?<!\w)[^\W\d_])'{1,2}(?!\w)")
_MINUS = re.compile(
    r"(?<=\s)-(?=\s)|(?<![\w)\]…-])-(?=[\d(√∞])|(?:(?<=\()|(?<==\s)|(?<=;\s)|(?<=,\s)(?=-\w\b))-(?=[^\W\d_])"
)


def typeset(text: str) -> str:
    """Numbered letters get an index, and what is a minus becomes one; hyphens of words and joints stay.

    >>> typeset("3n - 4 - 2 g1 = -φ/2 at K1_x of D(1-2), and exercise-1"), typeset("Zug- und Druckkraft (-0,5)")
    ('3n − 4 − 2 g₁ = −φ/2 at K_1x of D(1-2), and exercise-1', 'Zug- und Druckkraft (−0,5)')
    >>> typeset("|B0B| = |AB0| at (a; -c/2)")
    '|B₀B| = |AB₀| at (a; −c/2)'
    """

    def index(match: re.Match[str]) -> str:
        letter, digit, of = match.groups()
        return f"{letter}_{digit}{of}" if of else letter + chr(0x2080 + int(digit))

    text = _PIVOTS.sub(lambda match: match[0].replace("0", "₀"), text)
    return _MINUS.sub("−", _NUMBERED.sub(index, text))


def with_signs(text: str) -> str:
    """What is a minus becomes one, and quotation marks after a letter alone become primes.

    >>> with_signs("s2 = l' + l'' = -ω·a, Grashof's 3(n - 1)")
    "s2 = l′ + l″ = −ω·a, Grashof's 3(n − 1)"
    """
    return _PRIMES.sub(lambda match: "′″"[len(match[0]) - 1], _MINUS.sub("−", text))


def _typeset_block(block: Block) -> Block:
    match block:
        case Heading(text) | Paragraph(text):
            return replace(block, text=typeset(text))
        case Pictures(captions=captions):
            return replace(block, captions=tuple(map(typeset, captions)))
        case Rows(headers, rows):
            return Rows(tuple(map(typeset, headers)), tuple(tuple(map(typeset, row)) for row in rows))
        case AnswerLines(asked):
            return replace(block, asked=tuple(map(typeset, asked)))
        case Contents() | PageBreak():
            return block
