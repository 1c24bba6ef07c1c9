"""Columns of numbers as commands print and write them."""

from __future__ import annotations

from pathlib import Path

from gruebler.columns import Column, as_csv, shown
from gruebler.errors import GrueblerError

__all__ = ["Column", "as_csv", "check_csv", "shown"]


def check_csv(path: Path | None) -> None:
    """`GrueblerError` if the ending of the file is not that of a table."""
    if path is not None and path.suffix.lower() not in ("", ".csv", ".txt"):
        raise GrueblerError("-o {path}: a table is written as CSV; end the name with .csv", path=path)
