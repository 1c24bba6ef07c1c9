"""Exact elimination with fractions for sparse rows."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Generic, TypeVar

__all__ = ["Elimination", "Row", "rational_echelon", "reduce_row"]

K = TypeVar("K", bound=Hashable)
Row = dict[K, Fraction]
"""A linear form: column to coefficient, zeros left out."""


class Elimination(Generic[K]):
    """Rows in echelon form, added one by one: the pivot of a row is its first column in the order given.

    A row is reduced only as far as its first column needs it. So adding the rows of a train takes about linear
    time; `full` finishes the form at a cost of its entries.
    """

    def __init__(self, columns: Iterable[K]) -> None:
        self.place = {column: k for k, column in enumerate(columns)}
        self.rows: dict[K, Row[K]] = {}
        """For each pivot column its row, 1 there and nothing before it; in the order in which they were added."""

    def add(self, row: Mapping[K, Fraction]) -> bool:
        """Add a row; False if it depends on those before it."""
        rest = {column: value for column, value in row.items() if value}
        while rest:
            pivot = min(rest, key=self.place.__getitem__)
            known = self.rows.get(pivot)
            if known is None:
                scale = rest[pivot]
                self.rows[pivot] = {column: value / scale for column, value in rest.items()}
                return True
            _subtract(rest, rest[pivot], known)
        return False

    def full(self) -> dict[K, Row[K]]:
        """The reduced echelon form: each pivot column occurs in its own row only."""
        found: dict[K, Row[K]] = {}
        for pivot in sorted(self.rows, key=self.place.__getitem__, reverse=True):
            row = dict(self.rows[pivot])
            for other in [column for column in row if column in found]:
                _subtract(row, row[other], found[other])
            found[pivot] = row
        return {pivot: found[pivot] for pivot in self.rows}

    def left(self, row: Mapping[K, Fraction]) -> Row[K]:
        """What is left of a row when the rows are subtracted as often as they can be; empty if it depends on them."""
        rest = {column: value for column, value in row.items() if value}
        pivots = [column for column in rest if column in self.rows]
        while pivots:
            pivot = min(pivots, key=self.place.__getitem__)
            _subtract(rest, rest[pivot], self.rows[pivot])
            pivots = [column for column in rest if column in self.rows]
        return rest


def rational_echelon(rows: Iterable[Mapping[K, Fraction]], columns: Sequence[K]) -> dict[K, Row[K]]:
    """The reduced echelon form: each pivot column with its row (coefficient 1 there, 0 in the other rows).

    Pivots are sought in the order of ``columns``; cost about linear in the entries for the rows of a gear train.

    >>> one = Fraction(1)
    >>> rational_echelon([{"x": one, "y": one}, {"x": one, "y": -one}], "xy")
    {'x': {'x': Fraction(1, 1)}, 'y': {'y': Fraction(1, 1)}}
    """
    form = Elimination(columns)
    for row in rows:
        form.add(row)
    return form.full()


def reduce_row(row: Mapping[K, Fraction], basis: Mapping[K, Row[K]]) -> Row[K]:
    """What is left of a row when a reduced echelon form is subtracted; nothing exactly if the row depends on it."""
    rest = {column: value for column, value in row.items() if value}
    for pivot in [column for column in rest if column in basis]:
        _subtract(rest, rest[pivot], basis[pivot])
    return rest


def _subtract(row: Row[K], factor: Fraction, other: Row[K]) -> None:
    """Change a row by minus the factor times another."""
    for column, value in other.items():
        new = row.get(column, 0) - factor * value
        if new:
            row[column] = new
        else:
            row.pop(column, None)
