"""Rows of fractions brought to reduced echelon form: exact elimination, no pivoting needed."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import TypeVar

__all__ = ["Row", "echelon", "reduced"]

K = TypeVar("K", bound=Hashable)
Row = dict[K, Fraction]
"""A linear form: column to coefficient, zeros left out."""


def echelon(rows: Iterable[Mapping[K, Fraction]], columns: Sequence[K]) -> dict[K, Row[K]]:
    """The reduced echelon form: each pivot column with its row (coefficient 1 there, 0 in the other rows).

    Pivots are sought in the order of ``columns``; cost O(rows^2 * columns) operations on fractions.

    >>> one = Fraction(1)
    >>> echelon([{"x": one, "y": one}, {"x": one, "y": -one}], "xy")
    {'x': {'x': Fraction(1, 1)}, 'y': {'y': Fraction(1, 1)}}
    """
    found: dict[K, Row[K]] = {}
    for row in rows:
        rest = reduced(row, found)
        pivot = next((column for column in columns if column in rest), None)
        if pivot is None:
            continue
        rest = {column: value / rest[pivot] for column, value in rest.items()}
        for other, known in found.items():
            if pivot in known:
                found[other] = _minus(known, known[pivot], rest)
        found[pivot] = rest
    return found


def reduced(row: Mapping[K, Fraction], basis: Mapping[K, Row[K]]) -> Row[K]:
    """What is left of a row when an echelon form is subtracted from it; nothing exactly if the row depends on it."""
    rest = {column: value for column, value in row.items() if value}
    for pivot, known in basis.items():
        if pivot in rest:
            rest = _minus(rest, rest[pivot], known)
    return rest


def _minus(row: Row[K], factor: Fraction, other: Row[K]) -> Row[K]:
    left = dict(row)
    for column, value in other.items():
        new = left.get(column, Fraction(0)) - factor * value
        if new:
            left[column] = new
        else:
            left.pop(column, None)
    return left
