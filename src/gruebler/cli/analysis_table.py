"""Columns of numbers as commands print and write them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from gruebler.analysis.table import Column, as_csv
from gruebler.errors import GrueblerError
from gruebler.text import number

__all__ = ["Column", "as_csv", "check_csv", "shown"]


def shown(columns: Sequence[Column], lang: str = "en") -> list[list[str]]:
    """The rows as texts of six digits, rounding noise as 0, an infinite radius as ∞."""
    cells = []
    for column in columns:
        finite = np.abs(column.values[np.isfinite(column.values)])
        noise = 1e-12 * max(finite.max(initial=0.0), column.natural)
        values = np.where(np.abs(column.values) <= noise, 0.0, column.values)
        cells.append([_cell(value, lang) for value in values])
    return [list(row) for row in zip(*cells, strict=True)]


def _cell(value: float, lang: str) -> str:
    if np.isfinite(value):
        return number(value + 0.0, lang)
    return "∞" if np.isinf(value) else "–"


def check_csv(path: Path | None) -> None:
    """`GrueblerError` if the ending of the file is not that of a table."""
    if path is not None and path.suffix.lower() not in ("", ".csv", ".txt"):
        raise GrueblerError("-o {path}: a table is written as CSV; end the name with .csv", path=path)
