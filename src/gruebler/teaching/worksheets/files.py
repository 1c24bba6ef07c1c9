"""A document as a file: PDF, HTML, LaTeX, Markdown; pictures stand in the file itself."""

from __future__ import annotations

import base64
from collections.abc import Callable, Iterator, Sequence
from html import escape

from gruebler.base.errors import GrueblerError
from gruebler.base.text import joined_by_or
from gruebler.pictures.canvas.page_policy import policy_element
from gruebler.pictures.canvas.shapes import split_subscripts
from gruebler.pictures.canvas.svg import style_sheet
from gruebler.pictures.canvas.tikz import colour_definitions, latex_text, tikz
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
from gruebler.teaching.worksheets.paged import document_pages, pages_as_pdf


def document_bytes(document: Document, suffix: str) -> bytes:
    """The content of a file; `GrueblerError` for another ending, or if matplotlib is needed and missing."""
    if suffix not in _WRITERS:
        raise GrueblerError(
            "expected a file name that ends with {endings}, but found {found!r}",
            endings=joined_by_or([f".{ending}" for ending in _WRITERS]),
            found=f".{suffix}",
        )
    return _WRITERS[suffix](document)


def _pdf(document: Document) -> bytes:
    return pages_as_pdf(document.title, document_pages(document))


# --- HTML --------------------------------------------------------------------------------------------

_HTML_WIDTH = 740.0
_HTML_STYLE = (
    "body{max-width:50rem;margin:1rem auto;padding:0 1rem;font:15px/1.45 sans-serif;color:#22262b;background:#fff}"
    "h1{font-size:1.5rem}h2{font-size:1.15rem;break-after:avoid}h3{font-size:1rem;break-after:avoid}"
    ".logo{float:right;height:2.2rem}"
    ".row{display:flex;gap:1rem;align-items:end;break-inside:avoid}figure{margin:.3rem 0;flex:1 1 0}"
    "figcaption,.small{font-size:.82rem;color:#5c636b}svg{max-width:100%;height:auto}"
    "table{border-collapse:collapse;margin:.5rem 0}th,td{padding:.1rem .8rem .1rem "
    "0;text-align:left;vertical-align:top}"
    "th{border-bottom:1px solid #22262b}.answer{break-inside:avoid}.line{display:inline-block;width:11rem;"
    "border-bottom:1px solid #22262b;margin-left:.6rem}.break{break-before:page}"
    "@page{size:A4;margin:16mm}@media print{body{margin:0;padding:0;max-width:none}}"
)


def _html(document: Document) -> bytes:
    used = {
        shape.style
        for block in document.blocks
        if isinstance(block, Pictures)
        for figure in block.figures
        for shape in figure.shapes
    }
    rules = style_sheet(sorted({"ground", *used})).partition("@media")[0]
    body = "\n".join(part for block in document.blocks for part in _html_block(block))
    title = escape(document.title)
    logo = f'<img class="logo" alt="" src="{document.logo.link}">' if document.logo else ""
    return (
        f'<!doctype html>\n<html lang="{document.lang}"><head><meta charset="utf-8">{policy_element()}'
        f"<title>{title}</title>"
        f"<style>{rules}{_HTML_STYLE}</style></head><body>\n{logo}<h1>{title}</h1>\n"
        f'<p class="small">{escape(document.subtitle)}</p>\n{body}\n</body></html>\n'
    ).encode()


def _markup(text: str) -> str:
    """Text for HTML, with subscripts."""
    return "".join(f"<sub>{escape(part)}</sub>" if low else escape(part) for part, low in split_subscripts(text))


def _html_block(block: Block) -> Iterator[str]:
    match block:
        case Heading(text, level, key):
            anchor = f' id="{escape(key)}"' if key else ""
            yield f"<h{level + 1}{anchor}>{_markup(text)}</h{level + 1}>"
        case Paragraph(text, small):
            yield f"<p{' class=small' if small else ''}>{'<br>'.join(map(_markup, text.split(chr(10))))}</p>"
        case Pictures(figures, captions):
            items = []
            for k, (figure, scale) in enumerate(zip(figures, block.scales(_HTML_WIDTH), strict=True)):
                wide = scale * figure.width
                caption = f"<figcaption>{_markup(captions[k])}</figcaption>" if k < len(captions) else ""
                style = f"flex-grow:{wide:.0f};max-width:{wide:.0f}px"
                items.append(f'<figure style="{style}">{figure.svg(styled=False)}{caption}</figure>')
            yield f'<div class="row">{"".join(items)}</div>'
        case Rows(headers, rows):
            yield f"<table><tr>{''.join(f'<th>{_markup(cell)}</th>' for cell in headers)}</tr>"
            for row in rows:
                yield f"<tr>{''.join(f'<td>{_markup(cell)}</td>' for cell in row)}</tr>"
            yield "</table>"
        case Contents():
            for line, row in zip(_html_block(block.without_pages), (("", ""), *block.rows, ("", "")), strict=True):
                cell = f"<td>{_markup(row[0])}</td>"
                yield line.replace(cell, f'<td><a href="#{escape(row[0])}">{_markup(row[0])}</a></td>', 1)
        case AnswerLines(asked, space):
            lines = "".join(f'<p>{_markup(name)}<span class="line"></span></p>' for name in asked)
            yield f'<div class="answer" style="padding-top:{space:.0f}px">{lines}</div>'
        case PageBreak():
            yield '<div class="break"></div>'


# --- Markdown ----------------------------------------------------------------------------------------


def _markdown(document: Document) -> bytes:
    lines = [f"![]({document.logo.link})", ""] if document.logo else []
    lines += [f"# {document.title}", "", *([document.subtitle, ""] if document.subtitle else [])]
    for block in document.blocks:
        lines += [*_markdown_block(block), ""]
    return ("\n".join(lines).rstrip() + "\n").encode()


def _indexed(text: str) -> str:
    """Text for Markdown, which has HTML for subscripts."""
    return "".join(f"<sub>{part}</sub>" if low else part for part, low in split_subscripts(text))


def _markdown_block(block: Block) -> Iterator[str]:
    match block:
        case Heading(text, level, _):
            yield f"{'#' * (level + 1)} {_indexed(text)}"
        case Paragraph(text):
            yield "  \n".join(map(_indexed, text.split("\n")))
        case Pictures(figures, captions):
            for k, figure in enumerate(figures):
                data = base64.b64encode(figure.svg().encode("utf-8")).decode("ascii")
                caption = captions[k] if k < len(captions) else figure.title
                yield f"![{caption.replace('[', '(').replace(']', ')')}](data:image/svg+xml;base64,{data})"
        case Rows(headers, rows):
            for number, row in enumerate([headers, *rows]):
                yield f"| {' | '.join(_indexed(cell).replace('|', chr(92) + '|') for cell in row)} |"
                if number == 0:
                    yield "|" + "---|" * len(headers)
        case Contents():
            yield from _markdown_block(block.without_pages)
        case AnswerLines(asked):
            yield from (f"- {_indexed(name)} ________" for name in asked)
        case PageBreak():
            yield "---"


# --- LaTeX -------------------------------------------------------------------------------------------

_LATEX_WIDTH = 620.0  # of the lines on A4 with margins of 20 mm
_POINTS = 170 / 25.4 * 72.27 / _LATEX_WIDTH  # of LaTeX in a pixel
_LINE = 14.0  # points
_KEPT_ROWS = 14  # a table of so many rows is not divided
_NEED_SPACE = r"""\makeatletter
\newcommand{\needspace}[1]{\par\begingroup\setlength{\dimen@}{#1}\vskip\z@\@plus\dimen@\penalty-100\vskip\z@\@plus-\dimen@
\vskip\dimen@\penalty9999\vskip-\dimen@\vskip\z@skip\endgroup}
\makeatother"""
"""As the package needspace has it, which is not in every installation."""


def _latex(document: Document) -> bytes:
    babel = {"de": "ngerman"}.get(document.lang, "english")
    colours = "\n".join(colour_definitions())
    body = "\n".join(
        part
        for k, block in enumerate(document.blocks)
        for part in (_latex_space(document.blocks[k:]), *_latex_block(block))
        if part
    )
    name = document.logo.name if document.logo else ""  # a file beside this one
    logo = f"\\IfFileExists{{{name}}}{{\\hfill\\includegraphics[height=10mm]{{{name}}}\\par}}{{}}\n" if name else ""
    return (
        "\\documentclass[a4paper,11pt]{article}\n\\usepackage[T1]{fontenc}\n\\usepackage[utf8]{inputenc}\n"
        "\\IfFileExists{lmodern.sty}{\\usepackage{lmodern}}{}\n"
        f"\\usepackage[{babel}]{{babel}}\n\\usepackage[margin=20mm]{{geometry}}\n\\usepackage{{tikz}}\n"
        "\\usepackage{longtable}\n\\setlength{\\parindent}{0pt}\n\\setlength{\\parskip}{6pt}\\setlength{\\emergencystretch}{3em}\n"
        f"{_NEED_SPACE}\n{colours}\n\\begin{{document}}\n{logo}\\section*{{{latex_text(document.title)}}}\n"
        f"{{\\small {latex_text(document.subtitle)}\\par}}\n\n{body}\n\\end{{document}}\n"
    ).encode()


def _latex_space(blocks: Sequence[Block]) -> str:
    """What asks for the space of blocks that stay together: a heading with what it begins, a table with its title."""
    first, *others = blocks
    high = _LINE
    match first, *others[:1]:
        case Heading(), *_:
            for block in others[:3]:
                high += _latex_height(block)
                if isinstance(block, Pictures):
                    break
        case Paragraph(text), Rows() as table if len(text) < 2 * _LATEX_LETTERS:
            high += _latex_height(table)
        case _:
            return ""
    return f"\\needspace{{{high:.0f}pt}}"


def _latex_height(block: Block) -> float:
    """About the height of what is not divided of a block, in points."""
    match block:
        case Paragraph(text):
            return _LINE * min(3, 1 + len(text) // _LATEX_LETTERS)
        case Pictures(figures):
            scales = block.scales(_LATEX_WIDTH)
            return _POINTS * max(s * figure.height for s, figure in zip(scales, figures, strict=True)) + 2 * _LINE
        case Rows(_, rows):
            return _LINE * (1 + (len(rows) if len(rows) <= _KEPT_ROWS else 2))
        case AnswerLines(asked, space):
            return 0.75 * space + 1.6 * _LINE * len(asked)
        case _:
            return 2 * _LINE


def _latex_block(block: Block) -> Iterator[str]:
    match block:
        case Heading(text, level, key):
            command = {1: "section", 2: "subsection", 3: "subsubsection"}[level]
            label = f"\\label{{{key}}}" if key else ""
            yield f"\\{command}*{{{latex_text(text)}}}{label}"
        case Paragraph(text, small):
            lines = r"\\ ".join(map(latex_text, text.split("\n")))
            yield f"{{\\small {lines}\\par}}\n" if small else f"{lines}\\par\n"
        case Pictures(figures, captions):
            scales = block.scales(_LATEX_WIDTH)
            every = sum(scale * figure.width for scale, figure in zip(scales, figures, strict=True))
            for k, (figure, scale) in enumerate(zip(figures, scales, strict=True)):
                caption = rf"\\ {{\footnotesize {latex_text(captions[k])}}}" if k < len(captions) else ""
                wide = 0.98 * scale * figure.width / every
                picture = tikz(figure, scale)
                yield f"\\begin{{minipage}}[b]{{{wide:.2f}\\linewidth}}{picture}{caption}\\end{{minipage}}%"
            yield "\\par\n"
        case Rows(headers, rows):
            short = len(rows) <= _KEPT_ROWS
            table = "tabular}" if short else "longtable}[l]"
            yield f"\\begin{{{table}{{@{{}}{_latex_columns(headers, rows)}@{{}}}}"
            yield " & ".join(map(latex_text, headers)) + r" \\ \hline" + ("" if short else r" \endhead")
            for number, row in enumerate(rows, 1):
                # The first two rows stay with the head, the last two together, and below the last one no page begins.
                kept = "*" if number in (1, len(rows) - 1) else ""
                yield " & ".join(map(latex_text, row)) + (r" \\" + kept if number < len(rows) else "")
            yield f"\\end{{{'tabular' if short else 'longtable'}}}\\par\n"
        case Contents(headers, rows):
            paragraphs = r"p{0.4\linewidth}" * (len(headers) - 2)
            yield f"\\begin{{longtable}}[l]{{@{{}}l{paragraphs}r@{{}}}}"
            yield " & ".join(map(latex_text, headers)) + r" \\ \hline"
            yield from (" & ".join(map(latex_text, row)) + rf" & \pageref{{{row[0]}}} \\" for row in rows)
            yield "\\end{longtable}\n"
        case AnswerLines(asked, space):
            yield f"\\vspace{{{space * 0.75:.0f}pt}}\n"
            yield from (f"{latex_text(name)}\\enspace\\underline{{\\hspace{{40mm}}}}\\par\n" for name in asked)
        case PageBreak():
            yield "\\newpage"


_LATEX_LETTERS = 86  # in a line of A4 with these margins, a little less than there are
_LATEX_CELL = 24  # letters of a cell that is never wrapped


def _latex_columns(headers: tuple[str, ...], rows: tuple[tuple[str, ...], ...]) -> str:
    r"""As wide as their cells; where these do not fit, those of sentences share what the others leave.

    >>> _latex_columns(("a", "b"), (("1", "2"),)), _latex_columns(("a", "b"), (("1", 100 * "x"),))
    ('ll', 'lp{0.92\\linewidth}')
    """
    widths = [max(len(row[k]) for row in (headers, *rows)) + 3 for k in range(len(headers))]
    spare = _LATEX_LETTERS - sum(width for width in widths if width <= _LATEX_CELL)
    wide = sum(width for width in widths if width > _LATEX_CELL)
    if wide <= spare:
        return "l" * len(widths)
    parts = (
        f"p{{{(width / wide * spare - 3) / _LATEX_LETTERS:.2f}\\linewidth}}" if width > _LATEX_CELL else "l"
        for width in widths
    )
    return "".join(parts)


_WRITERS: dict[str, Callable[[Document], bytes]] = {"pdf": _pdf, "html": _html, "tex": _latex, "md": _markdown}
DOCUMENT_SUFFIXES = tuple(_WRITERS)
"""Endings of the files that a document can be written into."""
