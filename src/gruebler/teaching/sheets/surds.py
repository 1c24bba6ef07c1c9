"""Sums of square roots with rational factors, exactly: the numbers q1 sqrt(d1) + q2 sqrt(d2) + ... .

A number is a table from whole numbers without square factors to rational factors that are not zero; 1 is the key of the
rational part. The roots of different such numbers are linearly independent over the rationals (Besicovitch 1940), so
two numbers are equal if, and only if, their tables are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from math import gcd, isqrt

Surd = Mapping[int, Fraction]

_LARGEST = 10**10  # under a root: its factors are found by trial
_MOST = 16  # terms
_LONGEST = 4000  # bits of a factor


def rational_surd(value: Fraction) -> Surd:
    """A rational number."""
    return {1: value} if value else {}


def surd_product(a: Surd, b: Surd) -> Surd | None:
    """The product a b; None if it is too large.

    >>> surd_product({2: Fraction(1)}, {6: Fraction(1), 1: Fraction(3)})
    {3: Fraction(2, 1), 2: Fraction(3, 1)}
    """
    return _collected(
        (d // common * (e // common), p * q * common)
        for d, p in a.items()
        for e, q in b.items()
        for common in [gcd(d, e)]
    )


def surd_power(a: Surd, exponent: int) -> Surd | None:
    """A whole power; negative exponents only for numbers that are not zero."""
    power: Surd | None = {1: Fraction(1)}
    for _ in range(abs(exponent)):
        power = None if power is None else surd_product(power, a)
    return power if exponent >= 0 or power is None else surd_inverse(power)


def surd_inverse(a: Surd) -> Surd | None:
    """1/a for a that is not zero: multiplied by conjugates until no root remains.

    >>> surd_inverse({1: Fraction(1), 2: Fraction(1)})
    {1: Fraction(-1, 1), 2: Fraction(1, 1)}
    """
    roots = [d for d in a if d > 1]
    if not roots:
        return {1: 1 / a[1]}
    prime = _least_factor(roots[0])
    conjugate = {d: -q if d % prime == 0 else q for d, q in a.items()}
    norm = surd_product(a, conjugate)
    inverse = None if norm is None else surd_inverse(norm)
    return None if inverse is None else surd_product(conjugate, inverse)


def surd_sqrt(a: Surd) -> Surd | None:
    """The square root of a rational number that is not negative; None of any other.

    >>> surd_sqrt({1: Fraction(8, 3)})
    {6: Fraction(2, 3)}
    """
    if not a:
        return {}
    if set(a) != {1} or a[1] < 0:
        return None
    under = a[1].numerator * a[1].denominator
    whole = isqrt(under)
    if whole * whole == under:
        return {1: Fraction(whole, a[1].denominator)}
    if under > _LARGEST:
        return None
    outside, free = _square_free(under)
    return {free: Fraction(outside, a[1].denominator)}


def _quotient(a: Surd, b: Surd) -> Surd | None:
    over = surd_inverse(b)
    return None if over is None else surd_product(a, over)


OPERATIONS: dict[str, Callable[[Surd, Surd], Surd | None]] = {
    "+": lambda a, b: _collected([*a.items(), *b.items()]),
    "-": lambda a, b: _collected([*a.items(), *((d, -q) for d, q in b.items())]),
    "*": surd_product,
    "/": _quotient,
}
"""None where a number would be too large."""


def surd_text(a: Surd) -> str:
    """The number in print, the largest root first.

    >>> surd_text({22: Fraction(5, 3), 6: Fraction(-3)})
    '5/3·√22 − 3·√6'
    """
    terms = sorted(a.items(), reverse=True)
    text = ""
    for d, q in terms:
        sign = ("− " if q < 0 else "+ ") if text else ("−" if q < 0 else "")
        size = abs(q)
        term = str(size) if d == 1 else f"√{d}" if size == 1 else f"{size}·√{d}"
        text += (" " if text else "") + sign + term
    return text or "0"


def _collected(terms: Iterable[tuple[int, Fraction]]) -> Surd | None:
    """The number of these terms; None if it would be too large."""
    factors: dict[int, Fraction] = {}
    for d, q in terms:
        factors[d] = factors.get(d, Fraction(0)) + q
    factors = {d: q for d, q in factors.items() if q}
    long = any(max(q.numerator.bit_length(), q.denominator.bit_length()) > _LONGEST for q in factors.values())
    return None if long or len(factors) > _MOST or max(factors, default=1) > _LARGEST else factors


def _least_factor(number: int) -> int:
    return next((p for p in range(2, isqrt(number) + 1) if number % p == 0), number)


def _square_free(number: int) -> tuple[int, int]:
    """(s, f) with number = s^2 f and no square in f."""
    outside, free, p = 1, number, 2
    while p * p <= free:
        while free % (p * p) == 0:
            outside, free = outside * p, free // (p * p)
        p += 1
    return outside, free
