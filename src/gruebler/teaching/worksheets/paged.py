"""A document on pages of A4."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import takewhile

from gruebler.base.text import translate
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.shapes import text_width, wrapped_text
from gruebler.teaching.sheets.page import HEIGHT, WIDTH, HorizontalRule, Page, PlacedLogo, PlacedPicture, TextLine
from gruebler.teaching.worksheets.blocks import (
    AnswerLines,
    Block,
    Contents,
    Document,
    Heading,
    PageBreak,
    Paragraph,
    Pictures,
    Rows,
)

_LEFT, _RIGHT, _TOP, _BOTTOM = 60.0, WIDTH - 60.0, 86.0, HEIGHT - 66.0
_BODY, _LEAD = 11.5, 16.0
_SIZES = {1: 17.0, 2: 13.5, 3: 12.0}
_GAP = 12.0
_HEAD = 10.0
_LOGO, _LOGO_WIDTH = 26.0, 220.0  # at most, above the head of a page
_KEPT = 0.33 * HEIGHT  # what is higher than that may be divided
_KEPT_TASK = 0.45 * HEIGHT  # with the space for its answers
_WHOLE_TABLE = 0.2 * HEIGHT
_PASSES = 4
_SMALLEST = 0.62  # scale of a picture that would else begin a page: names of 13 pixels are then 6 points high
_FILL = 1.04  # texts are set a little wider than estimated

Item = TextLine | HorizontalRule | PlacedPicture


def document_pages(document: Document) -> tuple[Page, ...]:
    """The pages, with title and number on each."""
    numbers: dict[str, int] = {}
    for _ in range(_PASSES):
        pages, later = _divided(document, numbers)
        if later == numbers:
            break
        numbers = later  # the contents with these numbers may be a line longer
    return tuple(_page(document, items, k, len(pages)) for k, items in enumerate(pages, 1))


def _divided(document: Document, numbers: Mapping[str, int]) -> tuple[list[list[Item]], dict[str, int]]:
    """The items of each page, and the pages of the headings that have a key; the contents with such pages."""
    pages: list[list[Item]] = [[]]
    y = _TOP
    page_of: dict[str, int] = {}
    blocks = tuple(b.with_pages(numbers) if isinstance(b, Contents) else b for b in document.blocks)
    if _shortened(document) != document.title and not any(
        isinstance(block, Heading) and block.level == 1 for block in blocks[:1]
    ):
        blocks = (Heading(document.title, 1), *blocks)
    for number, block in enumerate(blocks):
        if isinstance(block, PageBreak):
            if pages[-1]:
                pages.append([])
                y = _TOP
            continue
        # A heading stays with all that it heads, or with the beginning if that is much.
        more = _headed(blocks[number:]) if isinstance(block, Heading) else _entitled(blocks[number : number + 2])
        for part, whole in enumerate(_parts(block)):
            items, high = whole
            if isinstance(block, Pictures) and y + high > _BOTTOM and pages[-1]:
                items, high = _smaller(block, whole, _BOTTOM - y)
            if y + high + more > _BOTTOM and pages[-1]:
                pages.append([])
                y = _TOP
                if part and items and isinstance(block, Rows):
                    head, y = _table_lines(block)[0][0], _TOP + _table_lines(block)[0][1]
                    pages[-1] += [item.at(_TOP) for item in head]
            pages[-1] += [item.at(y) for item in items]
            y += high
        if isinstance(block, Heading) and block.key:
            page_of[block.key] = len(pages)
    return pages, page_of


class _Lowered:
    """An item whose y is counted from the top of its part."""

    def __init__(self, item: Item) -> None:
        self.item = item

    def at(self, y: float) -> Item:
        """The item on a page, its part beginning at y."""
        match self.item:
            case TextLine() as line:
                return replace(line, y=y + line.y)
            case HorizontalRule(x, below, length, width):
                return HorizontalRule(x, y + below, length, width)
            case PlacedPicture(x, below, scale, figure):
                return PlacedPicture(x, y + below, scale, figure)
        raise AssertionError(self.item)


Part = tuple[list[_Lowered], float]


def _parts(block: Block) -> Iterator[Part]:
    """The pieces of a block that are not divided, each with its height."""
    match block:
        case Heading(text, level, _):
            yield _heading(text, _SIZES[level])
        case Paragraph(text, small):
            size, lead = (9.5, 13.0) if small else (_BODY, _LEAD)
            lines = [
                line for paragraph in text.split("\n") for line in wrapped_text(paragraph, _RIGHT - _LEFT, size * _FILL)
            ]
            role = "faint" if small else "ink"
            placed = [
                _Lowered(TextLine(x=_LEFT, y=size + k * lead, text=line, size=size, role=role))
                for k, line in enumerate(lines[:2])
            ]
            yield placed, lead * len(placed)  # the first line is never left alone
            for line in lines[2:]:
                yield [_Lowered(TextLine(x=_LEFT, y=size, text=line, size=size, role=role))], lead
            yield [], _GAP / 2
        case Pictures():
            yield _pictures(block)
        case Rows():
            yield from _table(block)
        case AnswerLines(asked, space):
            ruled = _LEFT + max((text_width(name, _BODY) for name in asked), default=0.0) + 14
            items = [_Lowered(TextLine(x=_LEFT, y=space + _BODY + 22.0 * k, text=name)) for k, name in enumerate(asked)]
            rules = [_Lowered(HorizontalRule(ruled, space + _BODY + 22.0 * k + 2, 150.0)) for k in range(len(asked))]
            yield [*items, *rules], space + 22.0 * len(asked) + _GAP


def _heading(text: str, size: float) -> Part:
    lines = wrapped_text(text, _RIGHT - _LEFT, size * 1.08)
    items = [
        _Lowered(TextLine(x=_LEFT, y=_GAP + size * (1 + 1.25 * k), text=line, size=size, bold=True))
        for k, line in enumerate(lines)
    ]
    return items, _GAP + 1.25 * size * len(lines) + 6


def _pictures(block: Pictures, part: float = 1.0) -> Part:
    scales = [part * scale for scale in block.scales(_RIGHT - _LEFT - _GAP * (len(block.figures) - 1))]
    sizes = [(scale * figure.width, scale * figure.height) for scale, figure in zip(scales, block.figures, strict=True)]
    spare = (_RIGHT - _LEFT - sum(wide for wide, _ in sizes)) / len(sizes) - _GAP  # given to all captions alike
    high = max(height for _, height in sizes)
    items: list[_Lowered] = []
    left, below = _LEFT, 0.0
    for k, (figure, scale, (wide, height)) in enumerate(zip(block.figures, scales, sizes, strict=True)):
        items.append(_Lowered(PlacedPicture(left, high - height, scale, figure)))
        if k < len(block.captions):
            lines = wrapped_text(block.captions[k], wide + max(spare, 0.0), 9.5 * _FILL)
            items += [
                _Lowered(TextLine(x=left, y=high + 13 + 12.5 * row, text=line, size=9.5, role="faint"))
                for row, line in enumerate(lines)
            ]
            below = max(below, 12.5 * len(lines) + 4)
        left += wide + _GAP + max(spare, 0.0)
    return items, high + below + _GAP


def _smaller(block: Pictures, whole: Part, room: float) -> Part:
    """Pictures made a little smaller where that lets them stand on the page; else as they are."""
    scales = block.scales(_RIGHT - _LEFT - _GAP * (len(block.figures) - 1))
    tall = max(scale * figure.height for scale, figure in zip(scales, block.figures, strict=True))
    part = 1 - (whole[1] - room) / tall
    return _pictures(block, part) if part * min(scales) >= _SMALLEST else whole


def _table(block: Rows) -> Iterator[Part]:
    """A short table is not divided; of others the head stays with the first rows, and the last ones stay together."""
    lines = _table_lines(block)
    if sum(high for _, high in lines) <= _WHOLE_TABLE:
        yield _below_one_another(lines)
    else:
        yield _below_one_another(lines[:3])
        yield from lines[3:-2]
        yield _below_one_another(lines[max(3, len(lines) - 2) :])
    yield [], _GAP


def _table_lines(block: Rows) -> list[Part]:
    """The head and the rows, each as high as its highest cell; the widest column is wrapped where they do not fit."""
    cells = [block.headers, *block.rows]
    widths = [max(text_width(row[k], 10 * _FILL) for row in cells) + 14 for k in range(len(block.headers))]
    excess = sum(widths) - (_RIGHT - _LEFT)
    if excess > 0:
        widest = max(range(len(widths)), key=widths.__getitem__)
        widths[widest] = max(widths[widest] - excess, 90.0)
    parts: list[Part] = []
    for number, row in enumerate(cells):
        items: list[_Lowered] = []
        x, high = _LEFT, 0.0
        for cell, width in zip(row, widths, strict=True):
            lines = wrapped_text(cell, width - 10, 10 * _FILL)
            items += [
                _Lowered(TextLine(x=x, y=10 + 13 * k, text=line, size=10, bold=number == 0))
                for k, line in enumerate(lines)
            ]
            x, high = x + width, max(high, 13.0 * len(lines))
        if number == 0:
            items.append(_Lowered(HorizontalRule(_LEFT, high + 2, min(sum(widths), _RIGHT - _LEFT))))
        parts.append((items, high + (6 if number == 0 else 3)))
    return parts


def _below_one_another(parts: Sequence[Part]) -> Part:
    """Parts as one that is not divided."""
    items: list[_Lowered] = []
    y = 0.0
    for each, high in parts:
        items += [_Lowered(item.at(y)) for item in each]
        y += high
    return items, y


def _headed(blocks: Sequence[Block]) -> float:
    """The height of what a heading heads, down to the next one of its level; of much, that of the first part."""
    heading, *others = blocks

    def belongs(block: Block) -> bool:
        ends = isinstance(block, Heading) and isinstance(heading, Heading) and block.level <= heading.level
        return not ends and not isinstance(block, PageBreak)

    headed = list(takewhile(belongs, others))
    heights = [[high for _, high in _parts(block)] for block in headed]
    whole = sum(map(sum, heights))
    if whole <= (_KEPT_TASK if any(isinstance(block, AnswerLines) for block in headed) else _KEPT):
        return whole
    # A picture that follows at once, or after one paragraph, stays there too.
    first = next((k + 1 for k, block in enumerate(others[:2]) if isinstance(block, Pictures)), 0)
    beginning = sum(map(sum, heights[:first])) or next((high for part in heights for high in part), 0.0)
    return min(beginning, _KEPT)


def _shortened(document: Document) -> str:
    """The title as far as the head of a page has space for it."""
    wide = _RIGHT - _LEFT - text_width(document.subtitle, _HEAD * _FILL) - 2 * _GAP
    first, *others = wrapped_text(document.title, wide, _HEAD * _FILL)
    return f"{first.rstrip(',')} …" if others else first


def _entitled(blocks: Sequence[Block]) -> float:
    """The height of the beginning of a table whose title is the paragraph before it."""
    if len(blocks) < 2 or not isinstance(blocks[0], Paragraph) or not isinstance(blocks[1], Rows):
        return 0.0
    title, table = (list(_parts(block)) for block in blocks)
    return table[0][1] + title[-1][1] if len(title) == 2 else 0.0  # one or two lines


def _page(document: Document, items: list[Item], number: int, count: int) -> Page:
    lang, logo = document.lang, document.logo
    head: list[Item | PlacedLogo] = [
        TextLine(x=_LEFT, y=50, text=_shortened(document), size=_HEAD, role="faint"),
        TextLine(x=_RIGHT, y=50, text=document.subtitle, size=_HEAD, role="faint", anchor="end"),
        HorizontalRule(_LEFT, 57, _RIGHT - _LEFT),
        TextLine(
            x=WIDTH / 2,
            y=HEIGHT - 34,
            text=translate("page {number} of {count}", lang, number=number, count=count),
            size=9,
            role="faint",
            anchor="middle",
        ),
    ]
    if logo is not None:
        wide, high = logo.size
        head.append(PlacedLogo(_RIGHT, 10.0, min(_LOGO, _LOGO_WIDTH * high / wide), logo))
    return Page((*head, *items), document.title, document.subtitle, lang)


def pages_as_pdf(title: str, pages: tuple[Page, ...]) -> bytes:
    """The pages in one PDF; `GrueblerError` if matplotlib is not installed."""
    from gruebler.pictures.canvas.matplotlib_files import matplotlib_figure
    from gruebler.teaching.sheets.page import painted

    memory = io.BytesIO()
    matplotlib_figure(Figure((), width=10, height=10, title=title, description=""))  # says what is missing
    from matplotlib.backends.backend_pdf import PdfPages

    with PdfPages(memory, metadata={"Title": title, "CreationDate": None, "Creator": None}) as file:
        for page in pages:
            file.savefig(painted(page))
    return memory.getvalue()
