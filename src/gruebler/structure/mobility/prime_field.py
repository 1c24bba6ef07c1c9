"""Exact linear algebra over the field of integers modulo P = 2^31 - 1: rank and null space of sparse matrices.

The matrices of mechanisms are sparse and stay so under a good order of elimination, until a dense core is
left (for chains with many cross-connected loops). The core (`gruebler._core`) eliminates both; sizes are judged here.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core

P = 2**31 - 1

Row = dict[int, int]
"""One sparse row: column -> residue, zeros left out."""

_SECONDS = 5e-10  # for each rows * columns * min(rows, columns) of the core
_LONG = 60.0
_LARGE = 1e9
_BYTES = 4  # an entry of the core
_DENSE_BASIS = 16_000_000  # entries of a basis of the null space that is kept as one array: 128 MB
_SMALL_PRODUCT = 500_000  # multiplications up to which whole numbers are quicker than four products of doubles
_SPARSE_STEPS = 20_000_000  # products of entries spent on a larger one: about ten seconds


class CoreTooLarge(Exception):
    """An elimination that takes long or much memory, refused before it is begun: equations, seconds, bytes."""

    def __init__(self, rows: int, seconds: float, size: float) -> None:
        super().__init__(f"{rows} equations, {seconds:.0f} s, {size:.0f} bytes")
        self.rows, self.seconds, self.size = rows, seconds, size


class Echelon(NamedTuple):
    """Rows in order of elimination: each knows only its own pivot column, later pivot columns and free ones."""

    arrays: tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]
    """Pivot columns; where each row starts; other columns; their coefficients after division by the pivot."""
    columns: int

    @property
    def rank(self) -> int:
        """The rank of the matrix."""
        return len(self.arrays[0])

    @property
    def pivots(self) -> list[tuple[int, NDArray[np.int64], NDArray[np.int64]]]:
        """(pivot column, other columns, their coefficients) of each row."""
        pivot, start, column, value = self.arrays
        ends = start[1:-1]
        return (
            list(zip(pivot.tolist(), np.split(column, ends), np.split(value, ends), strict=True)) if len(pivot) else []
        )


def modular_inverse(a: int) -> int:
    """1/a modulo P; a must not be 0 modulo P.

    >>> modular_inverse(7) * 7 % P
    1
    """
    return pow(a, -1, P)


def transposed(rows: list[Row], columns: int) -> Iterator[Row]:
    """The rows of the transpose, each freed by the iterator as it is handed out."""
    columns_left: list[Row] = [{} for _ in range(columns)]
    for i, row in enumerate(rows):
        for j, value in row.items():
            columns_left[j][i] = value
    columns_left.reverse()
    while columns_left:
        yield columns_left.pop()


def echelon(rows: Iterable[Row], columns: int, *, large: bool = False) -> Echelon:
    """Eliminate; the input is left as it is.

    Raises `CoreTooLarge` where the dense core would take more than about a minute or 1 GB, unless ``large``.

    Cost: linear in practice for chains built dyad by dyad; cubic in the size of the dense core otherwise.

    >>> echelon([{0: 1, 1: 2}, {0: 2, 1: 4}, {1: 1}], 2).rank
    2
    """
    start, column, value = array("q", [0]), array("q"), array("q")
    for row in rows:
        column.extend(row)
        value.extend(row.values())
        start.append(len(column))
    most = (np.inf, np.inf) if large else (_LONG / _SECONDS, _LARGE / _BYTES)
    packed = np.array(start, np.int64), np.array(column, np.int64), np.array(value, np.int64)
    done, core_rows, core_columns, *form = _core.eliminate(*packed, columns, *most)
    if not done:
        area = core_rows * core_columns
        raise CoreTooLarge(core_rows, _SECONDS * area * min(core_rows, core_columns), _BYTES * area)
    return Echelon((form[0], form[1], form[2], form[3]), columns)


def random_solutions(form: Echelon, number: int) -> NDArray[np.int64]:
    """So many random vectors x with A x = 0, as the columns of an array (columns, number); always the same ones.

    What holds for all x holds for these; what fails for some x fails for one of these, except with a chance of
    P^-number for each thing that is asked. Cost: the entries of the echelon form.

    >>> random_solutions(echelon([{0: 1, 1: P - 1}], 2), 3).shape
    (2, 3)
    """
    random = np.random.Generator(np.random.PCG64(form.columns))
    solution = random.integers(1, P, (form.columns, number), np.int64)
    return np.zeros_like(solution) if form.rank == form.columns else _core.solve_back(*form.arrays, solution)


Support = tuple[NDArray[np.int64], NDArray[np.int64]]
"""Which basis vectors have an entry at one place, ascending, and these entries."""


def null_space_by_column(form: Echelon) -> dict[int, Support] | None:
    """The basis of `null_space` by columns, zeros left out; None if it has too many entries to be written down.

    >>> null_space_by_column(echelon([{0: 1, 1: P - 1}], 3))
    {1: (array([0]), array([1])), 2: (array([1]), array([1])), 0: (array([0]), array([1]))}
    """
    taken = {pivot for pivot, _, _ in form.pivots}
    free = [c for c in range(form.columns) if c not in taken]
    entries_by_column = {c: (np.array([k], np.int64), np.ones(1, np.int64)) for k, c in enumerate(free)}
    if len(free) * form.rank <= _DENSE_BASIS:
        basis = np.zeros((form.rank, len(free)), np.int64)
        place = np.zeros(form.columns, np.int64)
        place[free] = -1 - np.arange(len(free))
        for k, (pivot, columns, values) in enumerate(reversed(form.pivots)):
            place[pivot] = k
            at = place[columns]
            known = at >= 0
            if known.any():
                basis[k] = (values[known, None] * basis[at[known]] % P).sum(axis=0)
            basis[k, -1 - at[~known]] += values[~known]
            basis[k] = -basis[k] % P
            members = np.flatnonzero(basis[k])
            if len(members):
                entries_by_column[pivot] = members, basis[k, members]
        return entries_by_column
    sparse = {c: {k: 1} for k, c in enumerate(free)}
    left = _SPARSE_STEPS
    for pivot, columns, values in reversed(form.pivots):
        entries: dict[int, int] = {}
        for c, value in zip(columns.tolist(), values.tolist(), strict=True):
            for k, x in sparse.get(c, {}).items():
                entries[k] = (entries.get(k, 0) - value * x) % P
                left -= 1
        if left < 0:
            return None
        entries = {k: x for k, x in sorted(entries.items()) if x}
        if entries:
            sparse[pivot] = entries
            entries_by_column[pivot] = np.array(list(entries), np.int64), np.array(list(entries.values()), np.int64)
    return entries_by_column


def null_space(form: Echelon) -> NDArray[np.int64]:
    """A basis of all x with A x = 0, as the rows of an array (dimension, columns).

    Each basis vector has a 1 in a free column of its own and a 0 in the others, so the basis is of the form [I | D]
    up to the order of columns. Cost: dimension times the entries of the echelon form.

    >>> null_space(echelon([{0: 1, 1: P - 1}], 2)).tolist()
    [[1, 1]]
    """
    free = np.setdiff1d(np.arange(form.columns), form.arrays[0])
    solution = np.zeros((form.columns, len(free)), np.int64)
    solution[free, np.arange(len(free))] = 1
    return _core.solve_back(*form.arrays, solution).T


def reduced_echelon(matrix: NDArray[np.int64]) -> NDArray[np.int64]:
    """The reduced row echelon form of a small dense matrix without its zero rows: equal for equal row spaces.

    >>> reduced_echelon(np.array([[2, 4], [1, 2]])).tolist()
    [[1, 2]]
    """
    return _core.reduce(np.ascontiguousarray(matrix))


def left_null_space(matrix: NDArray[np.int64]) -> NDArray[np.int64]:
    """The basis of all y with y A = 0 for a small dense A, as the rows of an array in reduced echelon form.

    >>> left_null_space(np.array([[1, 2], [2, 4]])).tolist()
    [[1, 1073741823]]
    """
    width = matrix.shape[1]
    both = _core.reduce(np.hstack([matrix, np.eye(len(matrix), dtype=np.int64)]))
    return both[~both[:, :width].any(axis=1), width:]


def modular_product(a: NDArray[np.int64], b: NDArray[np.int64]) -> NDArray[np.int64]:
    """The matrix product modulo P of two arrays of residues; the inner dimension must stay below 2^16.

    >>> modular_product(np.array([[P - 1, 2]]), np.array([[3], [5]]))
    array([[7]])
    """
    product: NDArray[np.int64]
    if a.size * b.shape[1] < _SMALL_PRODUCT:
        product = (a @ (b >> 16) % P * 65536 + a @ (b & 0xFFFF)) % P
        return product
    # Halves of 16 bits: products of doubles are exact below 2^53, whatever the order of their sums.
    a1, a0, b1, b0 = (half.astype(np.float64) for half in (a >> 16, a & 0xFFFF, b >> 16, b & 0xFFFF))
    high, low = a1 @ b1, a0 @ b0
    middle = (a1 + a0) @ (b1 + b0) - high - low
    product = high.astype(np.int64) % P * 2  # 2^32 = 2 modulo P
    product += middle.astype(np.int64) % P * 65536
    product += low.astype(np.int64)
    return product % P
