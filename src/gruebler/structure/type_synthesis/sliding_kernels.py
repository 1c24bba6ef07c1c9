"""Which choices of sliding joints leave a chain movable in all its joints: counted up to symmetry, on bare arrays.

Theorem and definitions: docs/theory/joint-types.md.
"""

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit

Int64 = NDArray[np.int64]

PRIME = 2**31 - 1


@njit(cache=True)
def _residue(value: int) -> int:
    """The residue of a number from 0 to (PRIME - 1) PRIME.

    The residue of 2^31 is 1, so the two digits of that base add up. Their sum is at most 2^32 - 4, so
    one subtraction is enough.
    """
    value = (value & PRIME) + (value >> 31)
    return value - PRIME if value >= PRIME else value


@njit(cache=True)
def _inverse(value: int) -> int:
    """The inverse modulo the prime."""
    a, b = value, PRIME
    x, y = 1, 0
    while b:
        q = a // b
        a, b = b, a - q * b
        x, y = y, x - q * y
    return x % PRIME


@njit(cache=True)
def _support(depth: int, factors: Int64, inverses: Int64, free: Int64, left: Int64) -> int:
    """The columns of the dependence that the column at this depth closes, as bits."""
    for b in range(depth):
        left[b] = (PRIME - factors[depth, b]) % PRIME
    support = 1 << depth
    for b in range(depth - 1, -1, -1):
        if free[b] or left[b] == 0:
            continue
        support |= 1 << b
        own = _residue(left[b] * inverses[b])
        for c in range(b):
            if factors[b, c]:
                left[c] = _residue(left[c] + (PRIME - own) * factors[b, c])
    return support


@njit(cache=True)
def _fixing(choice: int, columns: int, group: Int64) -> int:
    """The number of automorphisms that leave a set of columns as it is."""
    number = 1
    for g in range(1, group.shape[0]):  # the first one moves nothing
        image = 0
        for k in range(columns):
            if choice >> k & 1:
                image |= 1 << group[g, k]
        if image == choice:
            number += 1
    return number


@njit(cache=True, nogil=True)
def count_sliding(vectors: Int64, simple: int, joint: Int64, mobility: int, group: Int64, sums: Int64) -> None:
    """Add up, for each number of sliding joints, the automorphisms that fix a choice, over all choices that move.

    Args:
        vectors: int64[2, columns, rows]: each column of the closure equations modulo the prime, as a turning joint and
            as a sliding one; the first `simple` columns can be chosen, the others turn.
        simple: the number of columns that can be chosen.
        joint: int64[columns]: the joint of each column.
        mobility: F, the dimension of the solutions that is required.
        group: int64[automorphisms, simple]: images of the first columns.
        sums: int64[simple + 1], to which the numbers are added; divided by the number of automorphisms they are numbers
            of orbits (Burnside's lemma in the form of a sum over all choices).

    All choices are gone through as a tree, column by column, with the columns before it in echelon form. Cost: less
    than a microsecond for each of the 2^simple choices.
    """
    columns, rows = vectors.shape[1], vectors.shape[2]
    joints = joint.max() + 1
    basis = np.zeros((columns, rows), np.int64)
    factors = np.zeros((columns, columns), np.int64)
    inverses = np.zeros(columns, np.int64)
    pivot = np.zeros(columns, np.int64)
    free = np.zeros(columns, np.int64)  # 1 where a column depends on those before it
    support = np.zeros(columns, np.int64)
    left = np.zeros(columns, np.int64)
    chosen = np.full(columns, -1, np.int64)
    depth, nulls = 0, 0
    choice, slides = 0, 0
    while depth >= 0:
        if chosen[depth] >= 0:  # undo
            nulls -= free[depth]
            if chosen[depth] == 1:
                choice &= ~(1 << depth)
                slides -= 1
        chosen[depth] += 1
        if chosen[depth] == (2 if depth < simple else 1):
            chosen[depth] = -1
            depth -= 1
            continue
        if chosen[depth] == 1:
            choice |= 1 << depth
            slides += 1
        vector = basis[depth]
        for r in range(rows):
            vector[r] = vectors[chosen[depth], depth, r]
        for b in range(depth):
            factors[depth, b] = 0
            if free[b]:
                continue
            factor = vector[pivot[b]]
            if factor:
                factors[depth, b] = factor
                other = PRIME - factor
                for r in range(rows):
                    vector[r] = _residue(vector[r] + other * basis[b, r])
        at = 0
        while at < rows and vector[at] == 0:
            at += 1
        if at == rows:
            free[depth] = 1
            nulls += 1
            support[depth] = _support(depth, factors, inverses, free, left)
        else:
            free[depth] = 0
            pivot[depth] = at
            inverses[depth] = _inverse(vector[at])
            for r in range(at, rows):
                vector[r] = _residue(vector[r] * inverses[depth])
        if nulls > mobility or (nulls == mobility == 1 and depth < simple - 1):
            continue  # a simple joint behind would stay at rest
        if depth < columns - 1:
            depth += 1
            continue
        if nulls < mobility:
            continue
        moving = 0
        for d in range(columns):
            if free[d]:
                for k in range(columns):
                    if support[d] >> k & 1:
                        moving |= 1 << joint[k]
        if moving == (1 << joints) - 1:
            sums[slides] += _fixing(choice, simple, group)
