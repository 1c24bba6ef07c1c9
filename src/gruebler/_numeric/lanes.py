"""Words for loops that Python runs on all elements at once and numba one by one, from the same source.

`for i in lanes(n)` is `for i in range(n)` where it is compiled. Interpreted, its body runs once, `i` being the array of
all indices: `x[at + i]` is an array then, a copy, and numpy does the work. So bodies do not branch on elements (they
use `choose`), and no pass needs the result of an earlier one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

import numpy as np

from gruebler._numeric.compiling import compiled, instead, njit

__all__ = ["choose", "lanes", "number", "square_root", "tally"]


@cache
def _indices(n: int) -> Any:
    found = np.arange(n)
    found.setflags(write=False)
    return found


@instead(lambda: range)
def lanes(n: int) -> Iterable[int]:
    """The indices 0 to n - 1: one after another in compiled code, all at once in interpreted code."""
    return (_indices(n),)


@instead(lambda: math.sqrt)
def square_root(x: float) -> float:
    """The square root of a number or, interpreted, of an array; NaN of what is negative."""
    return np.sqrt(x)  # type: ignore[no-any-return]


@instead(lambda: complex)
def number(real: float, imag: float) -> complex:
    """The complex number with these parts, or an array of them."""
    out: Any = np.empty(np.shape(real), np.complex128)
    out.real, out.imag = real, imag
    return out  # type: ignore[no-any-return]


@instead(lambda: int)
def tally(truth: bool) -> int:
    """1 if it is true; of an array, how many are."""
    return int(np.count_nonzero(truth))


def _either(truth: bool, one: float, other: float) -> float:
    return one if truth else other


njit(error_model="numpy", forceinline=True, _nrt=False)(_either)


@instead(lambda: compiled(_either))
def choose(truth: bool, one: float, other: float) -> float:
    """One value where something is true, another where it is not; both are computed."""
    return np.where(truth, one, other)  # type: ignore[return-value]
