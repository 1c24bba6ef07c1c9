"""What may be given as a length, an angle or a rate, and the sentence when it is something else."""

from __future__ import annotations

import math
from decimal import Decimal
from numbers import Real

import numpy as np
import numpy.typing as npt

from gruebler.base.errors import LinkageError
from gruebler.base.text import message

FloatArray = npt.NDArray[np.float64]


def as_finite(name: str, value: object) -> float:
    """A finite number.

    >>> as_finite("e", "2")
    Traceback (most recent call last):
        ...
    gruebler.base.errors.LinkageError: e must be a finite number, not '2'
    """
    number = math.nan
    if isinstance(value, (Real, Decimal)) and not isinstance(value, bool):
        try:
            number = float(value)
        except (OverflowError, ValueError):
            number = math.nan
    if not math.isfinite(number):
        raise LinkageError("{name} must be a finite number, not {value!r}", name=name, value=value)
    return number


def as_positive(name: str, value: object) -> float:
    """A finite positive number, neither so small nor so large that its square is lost.

    >>> as_positive("a", -2)
    Traceback (most recent call last):
        ...
    gruebler.base.errors.LinkageError: a must be positive, not -2
    """
    number = as_finite(name, value)
    if number <= 0:
        raise LinkageError("{name} must be positive, not {value!r}", name=name, value=value)
    if not 1e-70 < number < 1e70:
        raise LinkageError(
            "{name} must lie between 1e-70 and 1e70, not {value!r}: choose another unit", name=name, value=value
        )
    return number


def as_lengths(**lengths: object) -> dict[str, float]:
    """Several lengths by name, checked, of sizes that can stand in one sum."""
    checked = {name: as_positive(name, value) for name, value in lengths.items()}
    small, large = min(checked, key=checked.__getitem__), max(checked, key=checked.__getitem__)
    if checked[large] > 1e9 * checked[small]:
        raise LinkageError(
            "lengths of one linkage may differ by a factor of 1e9 at most: {small} = {least:g}, {large} = {greatest:g}",
            small=small,
            least=checked[small],
            large=large,
            greatest=checked[large],
        )
    return checked


def as_eccentricity(e: object, *lengths: float) -> float:
    """An eccentricity of any sign, not out of all proportion to the lengths."""
    number = as_finite("e", e)
    if abs(number) > 1e9 * max(lengths):
        raise LinkageError("the eccentricity e = {e:g} is more than 1e9 times any length", e=number)
    return number


def as_numbers(name: str, value: npt.ArrayLike) -> FloatArray:
    """An array of finite numbers, of any shape."""
    try:
        numbers = np.asarray(value)
        sound = numbers.dtype.kind in "iuf" and bool(np.isfinite(numbers).all())
    except (TypeError, ValueError):
        sound = False
    if not sound:
        shown = repr(value)
        raise LinkageError(
            "{name} must be finite numbers, not {shown}",
            name=name,
            shown=shown if len(shown) < 60 else shown[:57] + "...",
        )
    return numbers.astype(np.float64)


def given_and_missing(**lengths: float | None) -> tuple[dict[str, float], str]:
    """The lengths that are given, checked, and the name of the one that is not.

    >>> given_and_missing(a=3, b=None)
    ({'a': 3.0}, 'b')
    """
    missing = [name for name, value in lengths.items() if value is None]
    if len(missing) != 1:
        raise LinkageError(
            "exactly one of {lengths} must be left out, not {missing}",
            lengths=", ".join(lengths),
            missing=", ".join(missing) or message("none"),
        )
    return as_lengths(**{name: value for name, value in lengths.items() if value is not None}), missing[0]
