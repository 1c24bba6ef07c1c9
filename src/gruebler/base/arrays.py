"""Types of arrays, named once for all rooms, products and angles of plane vectors, equality of values with arrays.

Shapes stand in second docstrings.
"""

from cmath import isnan
from collections.abc import Mapping
from dataclasses import fields
from decimal import Decimal
from numbers import Real
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Class = TypeVar("_Class", bound=type)

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]


def real_numbers(values: ArrayLike) -> Reals | None:
    """A new array of real numbers; None for anything else, texts of numbers among them."""
    try:
        given = np.asarray(values)
        numbers = given.dtype.kind in "iuf" or (given.dtype.kind == "O" and all(map(_is_real, given.ravel())))
        return np.array(given, np.float64) if numbers or not given.size else None
    except (TypeError, ValueError, OverflowError):
        return None


def _is_real(value: object) -> bool:
    return isinstance(value, Real | Decimal) and not isinstance(value, bool)


def scalar_product(a: Complexes | complex, b: Complexes | complex) -> Reals:
    """The scalar product of plane vectors x + iy."""
    return np.asarray((np.conj(a) * b).real)


def cross_product(a: Complexes | complex, b: Complexes | complex) -> Reals:
    """The area that plane vectors x + iy span, positive if b lies to the left of a."""
    return np.asarray((np.conj(a) * b).imag)


def angles_of_turns(turns: Complexes, whole: NDArray[np.int32] | int = 0) -> Reals:
    """The angles of turns (cosine + i sine) after so many whole ones; that of -1 is pi, whatever the sign of its zero.

    The kernels that count whole turns take a turn of exactly -1 for the end of an upper half.

    >>> angles_of_turns(np.array([complex(-1, 0.0), complex(-1, -0.0)])).tolist()
    [3.141592653589793, 3.141592653589793]
    """
    return np.asarray(np.angle(turns + 0.0) + 2 * np.pi * whole, np.float64)


def whole_turns(angles: Reals, turns: Complexes) -> NDArray[np.int32]:
    """How many whole turns angles have more than those of `angles_of_turns`."""
    return np.asarray(np.round((angles - angles_of_turns(turns)) / (2 * np.pi)), np.int32)


def compared_by_value(cls: _Class) -> _Class:
    """A dataclass (with ``eq=False``) whose values are equal if they are of first class and `same` in every field.

    For classes whose fields may hold arrays, or numbers that may be NaN: there the equality that `dataclass` writes
    raises an error, or tells a value from its own copy. The hash leaves out what arrays hold.

    >>> from dataclasses import dataclass
    >>> @compared_by_value
    ... @dataclass(frozen=True, eq=False)
    ... class Samples:
    ...     at: Reals
    ...     error: float
    >>> first, second = (Samples(np.array([1.0, 2.0]), float("nan")) for _ in range(2))
    >>> first == second, hash(first) == hash(second), first == Samples(np.array([1.0, 3.0]), float("nan"))
    (True, True, False)
    """

    def equal(self: object, second: object) -> bool:
        if second.__class__ is not self.__class__:
            return False
        return all(same(getattr(self, name), getattr(second, name)) for name in _compared(self))

    def hashed(self: object) -> int:
        return hash((self.__class__.__name__, *(_outline(getattr(self, name)) for name in _compared(self))))

    cls.__eq__ = equal  # type: ignore[assignment,method-assign]
    cls.__hash__ = hashed  # type: ignore[assignment,method-assign]
    return cls


def _compared(value: Any) -> list[str]:
    return [field.name for field in fields(value) if field.compare]


def same(first: object, second: object) -> bool:
    """Whether two values are the same: arrays and containers by what they hold, NaN like NaN.

    >>> same((np.array([1.0, np.nan]), {"a": [2]}), (np.array([1.0, np.nan]), {"a": [2]}))
    True
    >>> same([1.0], (1.0,))
    False
    """
    if first is second:
        return True
    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return first.dtype == second.dtype and np.array_equal(first, second, equal_nan=first.dtype.kind in "fc")
    if isinstance(first, list | tuple) and first.__class__ is second.__class__:
        return len(first) == len(second) and all(map(same, first, second))
    if isinstance(first, Mapping) and isinstance(second, Mapping):
        return first.keys() == second.keys() and all(same(value, second[key]) for key, value in first.items())
    if isinstance(first, np.ndarray) or isinstance(second, np.ndarray):
        return False
    return bool(first == second) or (_is_nan(first) and _is_nan(second))


def _outline(value: object) -> object:
    """What the hash takes of a value: the shape of an array, the keys of a mapping, nothing of NaN."""
    if isinstance(value, np.ndarray):
        return value.shape
    if isinstance(value, list | tuple):
        return tuple(map(_outline, value))
    if isinstance(value, Mapping):
        return frozenset(value)
    return None if _is_nan(value) else value


def _is_nan(value: object) -> bool:
    return isinstance(value, float | complex) and isnan(value)
