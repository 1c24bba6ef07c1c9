"""Tables: drawn by rich on a terminal, plain aligned columns anywhere else."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence

__all__ = ["print_long_table", "print_table"]


def print_table(headers: Sequence[str], rows: Sequence[Sequence[str]], numbers: Sequence[int] = ()) -> None:
    """Print rows under headers; ``numbers`` are the columns set flush right.

    >>> print_table(["name", "n"], [["four-bar", "4"], ["five-bar", "5"]], numbers=[1])
    name      n
    four-bar  4
    five-bar  5
    """
    if sys.stdout.isatty():
        _print_rich(headers, rows, numbers)
        return
    widths = [max(len(cell) for cell in column) for column in zip(headers, *rows, strict=True)]
    for row in (headers, *rows):
        cells = [
            cell.rjust(width) if k in numbers else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        print("  ".join(cells).rstrip())


def print_long_table(headers: Sequence[str], rows: Iterable[Sequence[int]], largest: int) -> None:
    """Print rows of numbers as they come, none of them above ``largest``, which sets the widths beforehand.

    >>> print_long_table(["binary", "ternary"], [(4, 2), (5, 0)], 6)
    binary  ternary
         4        2
         5        0
    """
    widths = [max(len(header), len(str(largest))) for header in headers]
    print("  ".join(header.rjust(width) for header, width in zip(headers, widths, strict=True)))
    for row in rows:
        print("  ".join(str(number).rjust(width) for number, width in zip(row, widths, strict=True)))


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
