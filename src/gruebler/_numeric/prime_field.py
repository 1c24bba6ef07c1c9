"""Exact linear algebra over the field of integers modulo P = 2^31 - 1: rank and null space of sparse matrices.

The matrices of mechanisms are sparse and stay so under a good order of elimination, until a dense core is
left (for chains with many cross-connected loops). The sparse head is eliminated row by row in plain Python
after Markowitz's rule (a short row, in it a rare column); the core by numpy. Products of two residues stay
below 2^62.
"""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Echelon", "P", "echelon", "inverse", "left_null_space", "null_space", "product", "reduced", "transposed"]

P = 2**31 - 1

Row = dict[int, int]
"""One sparse row: column -> residue, zeros left out."""

_DENSE_AT = 0.3  # the share of entries from which a dense core is cheaper than dictionaries
_DENSE_FROM = 40  # ... provided that it has at least so many rows


class Echelon(NamedTuple):
    """Pivots in order of elimination: each row knows only its own column, later pivot columns and free ones."""

    pivots: list[tuple[int, NDArray[np.int64], NDArray[np.int64]]]
    """(pivot column, other columns, their coefficients after division by the pivot)."""
    columns: int

    @property
    def rank(self) -> int:
        """The rank of the matrix."""
        return len(self.pivots)


def inverse(a: int) -> int:
    """1/a modulo P, by Fermat's little theorem; a must not be 0 modulo P.

    >>> inverse(7) * 7 % P
    1
    """
    return pow(a, P - 2, P)


def transposed(rows: list[Row], columns: int) -> list[Row]:
    """The rows of the transpose."""
    out: list[Row] = [{} for _ in range(columns)]
    for i, row in enumerate(rows):
        for j, value in row.items():
            out[j][i] = value
    return out


def echelon(rows: list[Row], columns: int) -> Echelon:
    """Eliminate; the input is left as it is.

    Cost: linear in practice for chains built dyad by dyad; cubic in the size of the dense core otherwise.

    >>> echelon([{0: 1, 1: 2}, {0: 2, 1: 4}, {1: 1}], 2).rank
    2
    """
    active = {i: {c: v % P for c, v in row.items() if v % P} for i, row in enumerate(rows)}
    active = {i: row for i, row in active.items() if row}
    where: dict[int, set[int]] = {}
    for i, row in active.items():
        for c in row:
            where.setdefault(c, set()).add(i)
    heap = [(len(row), i) for i, row in active.items()]
    heapify(heap)
    entries = sum(len(row) for row in active.values())
    pivots: list[tuple[int, NDArray[np.int64], NDArray[np.int64]]] = []
    while heap:
        size, i = heappop(heap)
        if i not in active or len(active[i]) != size:
            continue
        if len(active) >= _DENSE_FROM and entries > _DENSE_AT * len(active) * len(where):
            pivots += _dense(list(active.values()))
            break
        row = active.pop(i)
        entries -= size
        for c in row:
            where[c].discard(i)
        pivot = min(row, key=lambda c: (len(where[c]), c))
        scale = inverse(row[pivot])
        rest = [(c, v * scale % P) for c, v in row.items() if c != pivot]
        pivots.append((pivot, *_arrays(rest)))
        for k in where.pop(pivot):
            target = active[k]
            entries -= len(target)
            factor = target.pop(pivot)
            for c, v in rest:
                value = (target.get(c, 0) - factor * v) % P
                if value:
                    if c not in target:
                        where[c].add(k)
                    target[c] = value
                elif c in target:
                    del target[c]
                    where[c].discard(k)
            if target:
                entries += len(target)
                heappush(heap, (len(target), k))
            else:
                del active[k]
        for c, _ in rest:
            if not where[c]:
                del where[c]
    return Echelon(pivots, columns)


def _arrays(items: list[tuple[int, int]]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    return np.array([c for c, _ in items], np.int64), np.array([v for _, v in items], np.int64)


def _dense(rows: list[Row]) -> list[tuple[int, NDArray[np.int64], NDArray[np.int64]]]:
    """Eliminate the core: full columns in ascending order, one numpy update a pivot."""
    columns = np.array(sorted({c for row in rows for c in row}), np.int64)
    place = {int(c): k for k, c in enumerate(columns)}
    matrix = np.zeros((len(rows), len(columns)), np.int64)
    for i, row in enumerate(rows):
        for c, v in row.items():
            matrix[i, place[c]] = v
    pivots = []
    top = 0
    for k in range(len(columns)):
        found = np.flatnonzero(matrix[top:, k])
        if len(found) == 0:
            continue
        if found[0]:
            matrix[[top, top + found[0]]] = matrix[[top + found[0], top]]
        pivot = matrix[top, k:] * inverse(int(matrix[top, k])) % P
        below = top + 1 + np.flatnonzero(matrix[top + 1 :, k])
        matrix[below, k:] = (matrix[below, k:] - matrix[below, k][:, None] * pivot) % P
        others = np.flatnonzero(pivot[1:]) + 1
        pivots.append((int(columns[k]), columns[k + others], pivot[others]))
        top += 1
        if top == len(rows):
            break
    return pivots


def null_space(form: Echelon) -> NDArray[np.int64]:
    """A basis of all x with A x = 0, as the rows of an array (dimension, columns).

    Each basis vector has a 1 in a free column of its own and a 0 in the others, so the basis is of the form [I | D]
    up to the order of columns. Cost: dimension times the entries of the echelon form.

    >>> null_space(echelon([{0: 1, 1: P - 1}], 2))
    array([[1, 1]])
    """
    taken = {pivot for pivot, _, _ in form.pivots}
    free = [c for c in range(form.columns) if c not in taken]
    solution = np.zeros((form.columns, len(free)), np.int64)
    for k, c in enumerate(free):
        solution[c, k] = 1
    if free:
        for pivot, columns, values in reversed(form.pivots):
            if len(columns):
                solution[pivot] = -(values[:, None] * solution[columns] % P).sum(axis=0) % P
    return solution.T


def reduced(matrix: NDArray[np.int64]) -> NDArray[np.int64]:
    """The reduced row echelon form of a small dense matrix without its zero rows: equal for equal row spaces.

    >>> reduced(np.array([[2, 4], [1, 2]]))
    array([[1, 2]])
    """
    work = matrix % P
    top = 0
    for k in range(work.shape[1]):
        if top == len(work):
            break
        found = np.flatnonzero(work[top:, k])
        if len(found) == 0:
            continue
        if found[0]:
            work[[top, top + found[0]]] = work[[top + found[0], top]]
        work[top] = work[top] * inverse(int(work[top, k])) % P
        others = np.flatnonzero(work[:, k])
        others = others[others != top]
        if len(others):
            work[others] = (work[others] - work[others, k, None] * work[top]) % P
        top += 1
    return work[:top]


def left_null_space(matrix: NDArray[np.int64]) -> NDArray[np.int64]:
    """The basis of all y with y A = 0 for a small dense A, as the rows of an array in reduced echelon form.

    >>> left_null_space(np.array([[1, 2], [2, 4]]))
    array([[         1, 1073741823]])
    """
    width = matrix.shape[1]
    both = reduced(np.hstack([matrix, np.eye(len(matrix), dtype=np.int64)]))
    return both[~both[:, :width].any(axis=1), width:]


def product(a: NDArray[np.int64], b: NDArray[np.int64]) -> NDArray[np.int64]:
    """The matrix product modulo P of two arrays of residues; the inner dimension must stay below 65,536.

    >>> product(np.array([[P - 1, 2]]), np.array([[3], [5]]))
    array([[7]])
    """
    high, low = b >> 16, b & 0xFFFF
    out: NDArray[np.int64] = ((a @ high) % P * 65536 + a @ low) % P
    return out
