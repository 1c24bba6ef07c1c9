"""Tables over a turn: the angles of their rows, as text, as JSON."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Readable, number
from gruebler.cli.tables import Cell, print_table


def turn_degrees(step: float, *, closed: bool = False) -> NDArray[np.float64]:
    """Angles from 0 with this step, the full turn included if it is closed.

    >>> turn_degrees(120).tolist(), turn_degrees(120, closed=True).tolist()
    ([0.0, 120.0, 240.0], [0.0, 120.0, 240.0, 360.0])
    """
    if not 0.001 <= step <= 360:
        raise GrueblerError("--step: expected degrees from 0.001 to 360, not {step:g}", step=step)
    return np.arange(0, 360 + (step / 2 if closed else -step / 1e6), step)


def print_turn(
    headers: Sequence[Cell], rows: Sequence[Sequence[float | Readable]], formats: Sequence[tuple[str, str]], lang: str
) -> None:
    """Print rows of numbers, each column with its format and unit."""
    cells = [
        [value if isinstance(value, Readable) else number(value, lang, form) + unit for value, (form, unit) in row]
        for row in (zip(values, formats, strict=True) for values in rows)
    ]
    print_table(headers, cells, numbers=range(len(headers)), lang=lang)


def records(keys: Sequence[str], rows: Sequence[Sequence[Any]]) -> list[dict[str, Any]]:
    """The rows as objects; null for what is not finite.

    >>> records(["a", "b"], [[1.0, float("inf")]])
    [{'a': 1.0, 'b': None}]
    """
    return [dict(zip(keys, (value if math.isfinite(value) else None for value in row), strict=True)) for row in rows]
