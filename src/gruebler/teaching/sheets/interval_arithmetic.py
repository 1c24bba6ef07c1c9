"""Real numbers between two bounds: arithmetic that always encloses the true value, at any precision.

A bracket (low, high) at the precision p means low/2^p <= x <= high/2^p; every operation rounds outwards.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import isqrt

Bracket = tuple[int, int]


class PrecisionTooLowError(Exception):
    """The precision does not exclude a zero divisor; ``at`` is its column."""

    def __init__(self, at: int = 0) -> None:
        super().__init__(at)
        self.at = at


def interval_of_fraction(value: Fraction, p: int) -> Bracket:
    """A rational number."""
    low, remainder = divmod(value.numerator << p, value.denominator)
    return low, low + (remainder > 0)


def interval_pi(p: int) -> Bracket:
    """Machin's formula, 16 arctan(1/5) - 4 arctan(1/239), with 32 bits to spare."""
    near = 16 * _arctan_of_inverse(5, p + 32) - 4 * _arctan_of_inverse(239, p + 32)
    return (near >> 32) - 1, (near >> 32) + 2


def _arctan_of_inverse(x: int, p: int) -> int:
    total, term, n, sign = 0, (1 << p) // x, 1, 1
    while term:
        total += sign * (term // n)
        term, n, sign = term // (x * x), n + 2, -sign
    return total


def _sum(a: Bracket, b: Bracket, _: int) -> Bracket:
    return a[0] + b[0], a[1] + b[1]


def _difference(a: Bracket, b: Bracket, _: int) -> Bracket:
    return a[0] - b[1], a[1] - b[0]


def _product(a: Bracket, b: Bracket, p: int) -> Bracket:
    ends = [x * y for x in a for y in b]
    return min(ends) >> p, -(-max(ends) >> p)


def _quotient(a: Bracket, b: Bracket, p: int) -> Bracket:
    if b[0] <= 0 <= b[1]:
        raise PrecisionTooLowError
    ends = [Fraction(x << p, y) for x in a for y in b]
    return min(ends).__floor__(), max(ends).__ceil__()


def interval_sqrt(a: Bracket, p: int) -> Bracket:
    """The square root; of a bracket with negative values, the root of its non-negative part."""
    low, high = isqrt(max(a[0], 0) << p), isqrt(a[1] << p)
    return low, high + (high * high < a[1] << p)


OPERATIONS: dict[str, Callable[[Bracket, Bracket, int], Bracket]] = {
    "+": _sum,
    "-": _difference,
    "*": _product,
    "/": _quotient,
}


def interval_power(a: Bracket, exponent: int, p: int) -> Bracket:
    """A whole power."""
    result: Bracket = (1 << p, 1 << p)
    for _ in range(abs(exponent)):
        result = _product(result, a, p)
    return result if exponent >= 0 else _quotient((1 << p, 1 << p), result, p)
