"""Words with which the same source is quick in both tiers: interpreted, and compiled by numba.

`for i in lanes(n)` is `for i in range(n)` where it is compiled. Interpreted, its body runs once, `i` being the array of
all indices: `x[at + i]` is an array then, a copy, and numpy does the work. So bodies do not branch on elements (they
use `choose`), and no pass needs the result of an earlier one.

Where passes do need one another, Python is three times as quick on lists as on arrays: `rows = taken(array)` is a list
of lists of numbers then, which `give_back(array, rows)` writes into the array; compiled, `rows` is the array itself.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cache
from typing import Any

import numpy as np

from gruebler._numeric.compiling import compiled, instead, njit


@cache
def _indices(n: int) -> Any:
    indices = np.arange(n)
    indices.setflags(write=False)
    return indices


@instead(lambda: range)
def lanes(n: int) -> Iterable[int]:
    """The indices 0 to n - 1: one after another in compiled code, all at once in interpreted code."""
    return (_indices(n),)


@instead(lambda: math.sqrt)
def square_root(x: float) -> float:
    """The square root of a number or, interpreted, of an array; NaN of what is negative."""
    return np.sqrt(x)  # type: ignore[no-any-return]


@instead(lambda: complex)
def complex_number(real: float, imag: float) -> complex:
    """The complex number with these parts, or an array of them."""
    number: Any = np.empty(np.shape(real), np.complex128)
    number.real, number.imag = real, imag
    return number  # type: ignore[no-any-return]


@instead(lambda: int)
def tally(truth: bool) -> int:
    """1 if it is true; of an array, how many are."""
    return int(np.count_nonzero(truth))


def _itself() -> Any:
    """The form that numba knows of a function that returns its argument; the caller may count references or not."""
    from numba.core.imputils import impl_ret_borrowed
    from numba.extending import intrinsic

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        result = signature.return_type
        return impl_ret_borrowed(context, builder, result, arguments[0])  # type: ignore[no-untyped-call, unused-ignore]

    return intrinsic(lambda _typing, array: (array(array), emit))


@njit(forceinline=True, _nrt=False)
def _nothing(_array: Any, _rows: Any) -> None:
    return


@njit(error_model="numpy", forceinline=True, _nrt=False)
def _dot(first: Any, second: Any) -> float:
    total = 0.0
    for k in range(len(first)):
        total += first[k] * second[k]
    return total


@njit(error_model="numpy", forceinline=True, _nrt=False)
def _subtract(row: Any, share: float, other: Any) -> None:
    for k in range(len(row)):
        row[k] -= share * other[k]


@njit(error_model="numpy", forceinline=True, _nrt=False)
def _either(truth: bool, if_true: float, if_false: float) -> float:
    return if_true if truth else if_false


@instead(_itself)
def taken(array: Any) -> Any:
    """A matrix or vector to work on: the array itself or, interpreted, a list with its rows or numbers."""
    return array.tolist()


@instead(lambda: compiled(_nothing))
def give_back(array: Any, rows: Any) -> None:
    """Write what has become of `taken(array)` into the array."""
    array[:] = rows


@instead(lambda: compiled(_dot))
def dot(first: Any, second: Any) -> float:
    """The scalar product of two vectors, added up from the first element on."""
    total = 0.0
    for x, y in zip(first, second, strict=True):
        total += x * y
    return total


@instead(lambda: compiled(_subtract))
def subtract(row: Any, share: float, other: Any) -> None:
    """Take a multiple of another vector from one, in place."""
    row[:] = [x - share * y for x, y in zip(row, other, strict=True)]


@instead(lambda: compiled(_either))
def choose(truth: bool, if_true: float, if_false: float) -> float:
    """One value where something is true, another where it is not; both are computed."""
    return np.where(truth, if_true, if_false)  # type: ignore[return-value]
