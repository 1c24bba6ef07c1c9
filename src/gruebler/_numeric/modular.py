"""Exact linear algebra over the field of integers modulo P = 2^31 - 1: rank and null space of sparse matrices.

The matrices of mechanisms are sparse and stay so under a good order of elimination, until a dense core is
left (for chains with many cross-connected loops). The sparse head is eliminated row by row in plain Python
after Markowitz's rule (a short row, in it a rare column); the core by numpy. Products of two residues stay
below 2^62.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from heapq import heapify, heappop, heappush
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

P = 2**31 - 1

Row = dict[int, int]
"""One sparse row: column -> residue, zeros left out."""

_DENSE_AT = 0.1  # the share of entries from which a dense core is cheaper than dictionaries
_DENSE_FROM = 40  # ... provided that it has at least so many rows
_MOST_ENTRIES = 4_000_000  # entries in dictionaries, about 400 MB, from which the core is taken as dense
_SECONDS = 5e-10  # for each rows * columns * min(rows, columns) of the core
_LONG = 60.0
_LARGE = 1e9
_PANEL = 96  # columns of the core eliminated together; the rest of the core follows by one product
_STRIPE = 512  # rows of one such product
_DENSE_BASIS = 16_000_000  # entries of a basis of the null space that is kept as one array: 128 MB
_SMALL_PRODUCT = 500_000  # multiplications up to which whole numbers are quicker than four products of doubles
_FEW = 12  # matrices from which elimination side by side is quicker than one after the other
_FEW_INVERSES = 300
_CHUNK = 1_000_000  # entries of the matrices that are eliminated side by side
_SPARSE_STEPS = 20_000_000  # products of entries spent on a larger one: about ten seconds


class CoreTooLarge(Exception):
    """An elimination that takes long or much memory, refused before it is begun: equations, seconds, bytes."""

    def __init__(self, rows: int, seconds: float, size: float) -> None:
        super().__init__(f"{rows} equations, {seconds:.0f} s, {size:.0f} bytes")
        self.rows, self.seconds, self.size = rows, seconds, size


class Echelon(NamedTuple):
    """Pivots in order of elimination: each row knows only its own column, later pivot columns and free ones."""

    pivots: list[tuple[int, NDArray[np.int64], NDArray[np.int64]]]
    """(pivot column, other columns, their coefficients after division by the pivot)."""
    columns: int

    @property
    def rank(self) -> int:
        """The rank of the matrix."""
        return len(self.pivots)


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
        if len(active) >= _DENSE_FROM and entries > min(_DENSE_AT * len(active) * len(where), _MOST_ENTRIES):
            if not large:
                _refuse_too_large(len(active), len(where))
            pivots += _dense(list(active.values()))
            break
        row = active.pop(i)
        entries -= size
        for c in row:
            where[c].discard(i)
        pivot = min(row, key=lambda c: (len(where[c]), c))
        scale = modular_inverse(row[pivot])
        rest = [(c, v * scale % P) for c, v in row.items() if c != pivot]
        pivots.append((pivot, *_arrays(rest)))
        for k in where.pop(pivot):
            target = active[k]
            before = len(target)
            entries -= before
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
                if len(target) != before:
                    heappush(heap, (len(target), k))
            else:
                del active[k]
        for c, _ in rest:
            if not where[c]:
                del where[c]
    return Echelon(pivots, columns)


def _refuse_too_large(rows: int, columns: int) -> None:
    seconds = _SECONDS * rows * columns * min(rows, columns)
    size = 16 * rows * columns + 64 * _STRIPE * columns  # the matrix and its result; the parts of a product
    if seconds > _LONG or size > _LARGE:
        raise CoreTooLarge(rows, seconds, size)


def _arrays(items: list[tuple[int, int]]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    return np.array([c for c, _ in items], np.int64), np.array([v for _, v in items], np.int64)


def _dense(rows: list[Row]) -> list[tuple[int, NDArray[np.int64], NDArray[np.int64]]]:
    """Eliminate the core: columns in ascending order, a panel of them at a time, the rest by exact products."""
    columns = np.array(sorted({c for row in rows for c in row}), np.int64)
    place = {int(c): k for k, c in enumerate(columns)}
    matrix = np.zeros((len(rows), len(columns)), np.int64)
    for i, row in enumerate(rows):
        matrix[i, [place[c] for c in row]] = list(row.values())
    pivots: list[int] = []
    for left in range(0, len(columns), _PANEL):
        top = len(pivots)
        if top == len(rows):
            break
        right = min(left + _PANEL, len(columns))
        new_pivots, factors = _panel(matrix, top, left, right)
        pivots += new_pivots
        done = top + len(new_pivots)
        if not new_pivots or right == len(columns):
            continue
        # The rows of the panel's pivots, then the rows below: A12 = L11^-1 A12, A22 -= L21 A12.
        within = _inverse_of_unit_lower(factors[: len(new_pivots)])
        matrix[top:done, right:] = modular_product(within, matrix[top:done, right:])
        for start in range(done, len(rows), _STRIPE):
            stripe = slice(start, start + _STRIPE)
            less = modular_product(factors[start - top : start - top + _STRIPE], matrix[top:done, right:])
            matrix[stripe, right:] = (matrix[stripe, right:] - less) % P
    reduced = []
    for top, k in enumerate(pivots):
        others = k + 1 + np.flatnonzero(matrix[top, k + 1 :])
        scale = modular_inverse(int(matrix[top, k]))
        reduced.append((int(columns[k]), columns[others], matrix[top, others] * scale % P))
    return reduced


def _panel(matrix: NDArray[np.int64], top: int, left: int, right: int) -> tuple[list[int], NDArray[np.int64]]:
    """Eliminate within the columns from left to right: the pivot columns, and for each row from top its factors.

    Rows of the whole matrix change places; the factors say how often each pivot row is to be taken from a row.
    """
    work = matrix[top:, left:right].copy()
    factors = np.zeros_like(work)
    pivots: list[int] = []
    for k in range(right - left):
        done = len(pivots)
        nonzero = np.flatnonzero(work[done:, k])
        if len(nonzero) == 0:
            continue
        if nonzero[0]:
            swap, back = [done, done + nonzero[0]], [done + nonzero[0], done]
            work[swap], factors[swap] = work[back], factors[back]
            matrix[[top + i for i in swap]] = matrix[[top + i for i in back]]
        below = done + 1 + np.flatnonzero(work[done + 1 :, k])
        factor = work[below, k] * modular_inverse(int(work[done, k])) % P
        factors[below, done] = factor
        work[below, k:] = (work[below, k:] - factor[:, None] * work[done, k:]) % P
        pivots.append(left + k)
        if top + len(pivots) == len(matrix):
            break
    matrix[top:, left:right] = work
    return pivots, factors[:, : len(pivots)]


def _inverse_of_unit_lower(factors: NDArray[np.int64]) -> NDArray[np.int64]:
    """The inverse of the lower triangular matrix with ones on the diagonal and these factors below it."""
    inverse = np.eye(len(factors), dtype=np.int64)
    for i in range(1, len(factors)):
        inverse[i, :i] = -modular_product(factors[i : i + 1, :i], inverse[:i, :i])[0] % P
    return inverse


def random_solutions(form: Echelon, number: int) -> NDArray[np.int64]:
    """So many random vectors x with A x = 0, as the columns of an array (columns, number); always the same ones.

    What holds for all x holds for these; what fails for some x fails for one of these, except with a chance of
    P^-number for each thing that is asked. Cost: the entries of the echelon form.

    >>> random_solutions(echelon([{0: 1, 1: P - 1}], 2), 3).shape
    (2, 3)
    """
    random = np.random.Generator(np.random.PCG64(form.columns))
    solution = random.integers(1, P, (form.columns, number), np.int64)
    if form.rank == form.columns:
        solution[:] = 0
    else:
        for pivot, columns, values in reversed(form.pivots):
            solution[pivot] = -(values[:, None] * solution[columns] % P).sum(axis=0) % P
    return solution


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
            entries_by_column[pivot] = _arrays(list(entries.items()))
    return entries_by_column


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


def reduced_echelon(matrix: NDArray[np.int64]) -> NDArray[np.int64]:
    """The reduced row echelon form of a small dense matrix without its zero rows: equal for equal row spaces.

    >>> reduced_echelon(np.array([[2, 4], [1, 2]]))
    array([[1, 2]])
    """
    work = matrix % P
    top = 0
    for k in range(work.shape[1]):
        if top == len(work):
            break
        nonzero = work[top:, k].nonzero()[0]
        if len(nonzero) == 0:
            continue
        if nonzero[0]:
            work[[top, top + nonzero[0]]] = work[[top + nonzero[0], top]]
        work[top] = work[top] * modular_inverse(int(work[top, k])) % P
        others = work[:, k].nonzero()[0]
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
    both = reduced_echelon(np.hstack([matrix, np.eye(len(matrix), dtype=np.int64)]))
    return both[~both[:, :width].any(axis=1), width:]


def left_null_spaces(matrices: list[NDArray[np.int64]]) -> list[NDArray[np.int64]]:
    """`left_null_space` of many matrices with the same number of rows, eliminated side by side.

    >>> [len(kernel) for kernel in left_null_spaces([np.array([[1], [2]]), np.array([[0, 0], [0, 0]])])]
    [1, 2]
    """
    bases: list[NDArray[np.int64]] = [np.zeros((0, 0), np.int64)] * len(matrices)
    by_width: dict[int, list[int]] = {}
    for k, matrix in enumerate(matrices):
        # Columns of zeros change no kernel, and so widths that are nearly equal go together.
        by_width.setdefault(1 << (matrix.shape[1] - 1).bit_length(), []).append(k)
    for width, members in by_width.items():
        height = len(matrices[members[0]])
        chunk = max(1, _CHUNK // (height * (width + height)))
        if min(len(members), chunk) < _FEW:
            for k in members:
                bases[k] = left_null_space(matrices[k])
            continue
        for start in range(0, len(members), chunk):
            some = members[start : start + chunk]
            both = np.zeros((len(some), height, width + height), np.int64)
            for matrix, k in zip(both, some, strict=True):
                matrix[:, : matrices[k].shape[1]] = matrices[k]
            both[:, :, width:] = np.eye(height, dtype=np.int64)
            _reduce_side_by_side(both)
            kernels: NDArray[np.bool_] = ~np.any(both[:, :, :width], axis=2)
            for k, whole, rows in zip(some, both, kernels, strict=True):
                bases[k] = whole[rows, width:]
    return bases


def _reduce_side_by_side(stack: NDArray[np.int64]) -> None:
    """Bring each matrix of a stack to reduced row echelon form."""
    many, height, width = stack.shape
    everyone, numbers = np.arange(many), np.arange(height)
    top = np.zeros(many, np.int64)
    for k in range(width):
        candidates = (stack[:, :, k] != 0) & (numbers >= top[:, None])
        has = candidates.any(axis=1)
        if not has.any():
            continue
        who, row = everyone[has], candidates.argmax(axis=1)[has]
        at = top[has]
        pivots = stack[who, row]
        stack[who, row] = stack[who, at]
        pivots = pivots * _inverses(pivots[:, k])[:, None] % P
        factors = stack[who, :, k]
        factors[np.arange(len(who)), at] = 0
        stack[who] = (stack[who] - factors[:, :, None] * pivots[:, None, :] % P) % P
        stack[who, at] = pivots
        top[has] += 1


def _inverses(values: NDArray[np.int64]) -> NDArray[np.int64]:
    """1/a modulo P for each entry, by Fermat's little theorem: P - 2 has ones in all its 31 bits but the second."""
    if len(values) < _FEW_INVERSES:
        return np.array([modular_inverse(value) for value in values.tolist()], np.int64)
    inverses = np.ones_like(values)
    for bit in range(30, -1, -1):
        inverses = inverses * inverses % P
        if P - 2 >> bit & 1:
            inverses = inverses * values % P
    return inverses


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
