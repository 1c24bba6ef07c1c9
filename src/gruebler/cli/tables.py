"""Tables: drawn by rich on a terminal, plain aligned columns anywhere else."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from itertools import islice
from shutil import get_terminal_size
from textwrap import fill

from gruebler.base.errors import visible
from gruebler.base.text import LANGUAGES, Readable, translate

Cell = str | Readable
"""A text of a table; messages are translated."""


def print_table(
    headers: Sequence[Cell], rows: Sequence[Sequence[Cell]], numbers: Sequence[int] = (), lang: str = LANGUAGES[0]
) -> None:
    """Print rows under headers; ``numbers`` are the columns set flush right, messages are translated.

    A table wider than the terminal, or than 160 columns elsewhere, gets its long headers in several lines. On a
    terminal, what is still wider is split into blocks, each with the first column.

    >>> print_table(["name", "n"], [["four-bar", "4"], ["five-bar", "5"]], numbers=[1])
    name      n
    four-bar  4
    five-bar  5
    """
    terminal = sys.stdout.isatty()
    width = terminal_width() if terminal else _WIDE
    whole = len(rows)
    rows = rows[: shown_of(whole)]
    columns = [[_text(cell, lang) for cell in column] for column in zip(headers, *rows, strict=True)]
    if _width(columns) > width:
        longest = 0 if terminal else _HEADER
        columns = [[_folded(head, cells) if len(head) > longest else head, *cells] for head, *cells in columns]
    blocks = _blocks(columns, width) if terminal else [list(range(len(columns)))]
    for number, block in enumerate(blocks):
        if number:
            print()
        chosen = [columns[k] for k in block]
        right = [place for place, k in enumerate(block) if k in numbers]
        if terminal:
            _print_rich([head for head, *_ in chosen], list(zip(*(cells for _, *cells in chosen), strict=True)), right)
        else:
            _print_plain(chosen, right)
    _say_cut(whole - len(rows))


def shown_of(rows: int) -> int:
    """How many of so many rows are printed."""
    return CUT_TO if _cut_in.get() is not None and rows > CUT_ABOVE else rows


def _say_cut(rows: int) -> None:
    lang = _cut_in.get()
    if rows and lang is not None:
        print(translate("... and {count:,} more rows: --all prints them.", lang, count=rows))


@contextmanager
def cut_tables(arguments: argparse.Namespace) -> Iterator[None]:
    """Within, tables of commands that have --all are cut unless it is given, or a file takes what is printed."""
    cut = not (getattr(arguments, "all", True) or getattr(arguments, "out", None))
    before = _cut_in.set(str(arguments.lang) if cut else None)
    try:
        yield
    finally:
        _cut_in.reset(before)


CUT_ABOVE, CUT_TO = 25, 20
"""Longer tables are cut to so many rows; a whole turn in steps of 15°, which has 25, stays whole."""
_cut_in: ContextVar[str | None] = ContextVar("cut_in", default=None)
"""The language in which what is cut is said; None where tables stay whole."""


def _text(cell: Cell, lang: str) -> str:
    return visible(cell.in_language(lang) if isinstance(cell, Readable) else cell, keep="\n")


def terminal_width() -> int:
    """The columns of the terminal; the variable COLUMNS wins."""
    return get_terminal_size().columns


def print_text(text: str) -> None:
    """Print lines; on a terminal long ones are folded at its width, with the indent of the line."""
    if not sys.stdout.isatty():
        print(text)
        return
    width = max(min(terminal_width(), _WIDEST), 30)
    for line in text.split("\n"):
        indent = line[: len(line) - len(line.lstrip())]
        folded = fill(line, width, subsequent_indent=indent + "  ", break_long_words=False, break_on_hyphens=False)
        print(folded if len(line) > width else line)


_WIDEST = 100  # of a paragraph that is read easily
_WIDE = 160  # of a table in a file or a pipe
_HEADER = 24  # of a header that is left in one line there
_BETWEEN = 3  # columns of a terminal for each column of a table


def _width(columns: Sequence[Sequence[str]]) -> int:
    """Of a table of these columns, with what rich puts between and beside them."""
    widths = [max(len(line) for cell in column for line in cell.split("\n")) for column in columns]
    return sum(widths) + _BETWEEN * len(widths)


def _folded(header: str, cells: Sequence[str]) -> str:
    """The header in lines as wide as its longest word or the widest cell."""
    width = max(len(part) for part in (*cells, *header.split(), "-"))
    return fill(header, width, break_long_words=False, break_on_hyphens=False)


def _blocks(columns: Sequence[Sequence[str]], width: int) -> list[list[int]]:
    """The numbers of the columns that stand side by side; the first column leads every block."""
    blocks = [[0]] if columns else []
    for k in range(1, len(columns)):
        if len(blocks[-1]) > 1 and _width([columns[j] for j in (*blocks[-1], k)]) > width:
            blocks.append([0])
        blocks[-1].append(k)
    return blocks


def _print_plain(columns: Sequence[Sequence[str]], numbers: Sequence[int]) -> None:
    """Aligned columns; headers of several lines stand on their last one."""
    headers = [column[0].split("\n") for column in columns]
    height = max(map(len, headers), default=0)
    filled = [[*[""] * (height - len(head)), *head, *column[1:]] for head, column in zip(headers, columns, strict=True)]
    widths = [max(map(len, column)) for column in filled]
    for row in zip(*filled, strict=True):
        cells = [
            cell.rjust(width) if k in numbers else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        print("  ".join(cells).rstrip())


def print_long_table(headers: Sequence[str], rows: Iterable[Sequence[int]], largest: int, count: int) -> None:
    """Print rows of numbers as they come, none of them above ``largest``, which sets the widths beforehand.

    >>> print_long_table(["binary", "ternary"], [(4, 2), (5, 0)], 6, 2)
    binary  ternary
         4        2
         5        0
    """
    widths = [max(len(header), len(str(largest))) for header in headers]
    print("  ".join(header.rjust(width) for header, width in zip(headers, widths, strict=True)))
    for row in islice(rows, shown_of(count)):
        print("  ".join(str(number).rjust(width) for number, width in zip(row, widths, strict=True)))
    _say_cut(count - shown_of(count))


def _print_rich(headers: Sequence[str], rows: Sequence[Sequence[str]], numbers: Sequence[int]) -> None:
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for k, header in enumerate(headers):
        table.add_column(header, justify="right" if k in numbers else "left", overflow="fold")
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    Console().print(table)
