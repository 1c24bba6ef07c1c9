"""Exact elimination with fractions for sparse rows."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Generic, TypeVar

K = TypeVar("K", bound=Hashable)
Row = dict[K, Fraction]
"""A linear form: column to coefficient, zeros left out."""


class Elimination(Generic[K]):
    """Rows in echelon form, added one by one: the pivot of a row is its first column in the order given.

    A row is reduced only until its first column is a new pivot. So adding the rows of a train takes about linear
    time; `full` completes the reduction at a cost of its entries.
    """

    def __init__(self, columns: Iterable[K]) -> None:
        self.place = {column: k for k, column in enumerate(columns)}
        self.rows: dict[K, Row[K]] = {}
        """For each pivot column its row, with 1 there and zeros before it; in the order in which they were added."""

    def add(self, row: Mapping[K, Fraction]) -> bool:
        """Add a row; False if it depends on those before it."""
        remainder = {column: value for column, value in row.items() if value}
        while remainder:
            pivot = min(remainder, key=self.place.__getitem__)
            pivot_row = self.rows.get(pivot)
            if pivot_row is None:
                scale = remainder[pivot]
                self.rows[pivot] = {column: value / scale for column, value in remainder.items()}
                return True
            _subtract(remainder, remainder[pivot], pivot_row)
        return False

    def full(self) -> dict[K, Row[K]]:
        """The reduced echelon form: each pivot column occurs in its own row only."""
        reduced: dict[K, Row[K]] = {}
        for pivot in sorted(self.rows, key=self.place.__getitem__, reverse=True):
            row = dict(self.rows[pivot])
            for other in [column for column in row if column in reduced]:
                _subtract(row, row[other], reduced[other])
            reduced[pivot] = row
        return {pivot: reduced[pivot] for pivot in self.rows}

    def left(self, row: Mapping[K, Fraction]) -> Row[K]:
        """The remainder of a row after reduction by the rows; empty if it depends on them."""
        remainder = {column: value for column, value in row.items() if value}
        pivots = [column for column in remainder if column in self.rows]
        while pivots:
            pivot = min(pivots, key=self.place.__getitem__)
            _subtract(remainder, remainder[pivot], self.rows[pivot])
            pivots = [column for column in remainder if column in self.rows]
        return remainder


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


def _subtract(row: Row[K], factor: Fraction, other: Row[K]) -> None:
    """Subtract the factor times another row, in place."""
    for column, value in other.items():
        new = row.get(column, 0) - factor * value
        if new:
            row[column] = new
        else:
            row.pop(column, None)
