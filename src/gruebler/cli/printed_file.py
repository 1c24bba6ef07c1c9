"""What a command prints, written into the file that -o names."""

from __future__ import annotations

import argparse
import io
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from pathlib import Path

from gruebler.base.errors import GrueblerError
from gruebler.base.text import joined_by_or

TABLES = (".csv", ".parquet")
"""Endings of files with tables."""

_ENDINGS = (".txt", ".json")


def is_table(path: Path | None) -> bool:
    """Whether a file is named for a table."""
    return path is not None and path.suffix.lower() in TABLES


@contextmanager
def printed_to_file(arguments: argparse.Namespace) -> Iterator[None]:
    """Standard output goes into the file ``out`` of a command with `Parser.add_printed`, if one is given.

    The file appears when the command has ended, whole or not at all; files with endings in ``written`` are written by
    the command itself. `GrueblerError` for other endings than these, .txt and .json, and if ``--json`` does not agree.
    """
    written: tuple[str, ...] = getattr(arguments, "written", ())
    path = arguments.out if hasattr(arguments, "written") else None
    ending = "" if path is None else path.suffix.lower()
    if getattr(arguments, "decimal_comma", False) and ending != ".csv":
        raise GrueblerError("--decimal-comma goes with -o and a name that ends with .csv")
    if path is None or ending in written:
        yield
        return
    if ending not in _ENDINGS or (arguments.json and ending != ".json"):
        known = [".json"] if arguments.json else [*_ENDINGS, *written]
        raise GrueblerError(
            "-o {path}: expected a name that ends with {endings}", path=path, endings=joined_by_or(known)
        )
    arguments.json = ending == ".json"
    from gruebler.base.atomic_files import atomic_file
    from gruebler.cli.output import say_written

    with atomic_file(path, durable=False) as file:
        printed = io.TextIOWrapper(file, encoding="utf-8", write_through=True)
        try:
            with redirect_stdout(printed):
                yield
        finally:
            printed.detach()
    say_written(path, arguments.lang)
