"""Dimensions in exact form, such as ``5/2*sqrt(3)``: read safely and evaluated exactly.

Numbers, ``+ - * / **``, parentheses, ``sqrt`` and ``pi``; whole exponents only. The value is known as a sum of square
roots with rational factors wherever it is one (`surds`), and in any case to more digits than a double can be small.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from decimal import Context, Decimal, localcontext
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from gruebler.base.errors import LinkageError
from gruebler.base.immutable import settle
from gruebler.base.text import Message, message
from gruebler.teaching.sheets import surds
from gruebler.teaching.sheets.surds import Surd

_LONGEST = 300  # characters
_DEEPEST = 30  # parentheses, signs and powers within one another
_MOST_TIMES = 64  # exponent
_RANGE = 900  # bits before the point
_DIGITS = 1300
_NOTHING = Decimal("1e-600")  # a value that is not known exactly is zero if it is smaller
_SAME = Decimal(2) ** -1000
_TOKEN = re.compile(r"\s*(?:([0-9]+(?:\.[0-9]*)?|\.[0-9]+)|(\*\*|[-+*/()√π])|([^\W\d]\w*)|(\S))")
_ALIKE = str.maketrans("−·×", "-**")


@dataclass(frozen=True)
class Expression:
    """A number with its text. Two expressions are equal if their texts are; `same` compares the values.

    Raises `LinkageError` for a text that is no such number, naming the column.

    >>> side = Expression("5/2*sqrt(3)")
    >>> print(side, float(side), side.same(Expression("sqrt(75)/2")), side.printed)
    5/2*sqrt(3) 4.330127018922194 True 5/2·√3
    >>> Expression("5/2*sqr(3)")
    Traceback (most recent call last):
        ...
    gruebler.base.errors.LinkageError: '5/2*sqr(3)', column 5: unknown name 'sqr'; known are sqrt and pi
    """

    text: str
    value: float = field(init=False, repr=False, compare=False)
    """The nearest double."""
    exact: Surd | None = field(init=False, repr=False, compare=False)
    """The value as a sum of roots, factors by radicand; None if it is not known as one."""
    digits: Decimal = field(init=False, repr=False, compare=False)
    """The value to 1300 digits, less what subtractions take."""

    def __post_init__(self) -> None:
        if not isinstance(self.text, str) or len(self.text) > _LONGEST:
            description = f"one of {len(self.text)}" if isinstance(self.text, str) else repr(self.text)[:40]
            raise LinkageError(
                "an expression is a text of at most {longest} characters, not {found}",
                longest=_LONGEST,
                found=description,
            )
        with localcontext(Context(prec=_DIGITS)):
            number = _Reader(self.text).whole()
        settle(self, value=float(number.digits) + 0.0, exact=number.exact, digits=number.digits)  # no minus zero

    def __str__(self) -> str:
        return self.text

    def __float__(self) -> float:
        return self.value

    @property
    def printed(self) -> str:
        """The value in print, as a sum of roots (``5/2·√3``) if it is known as one, else the text."""
        return self.text if self.exact is None else surds.surd_text(self.exact)

    @property
    def typeset(self) -> str:
        """The text in print, not simplified.

        >>> Expression("1/3*sqrt(2)*(5*sqrt(11)-9*sqrt(3))").typeset
        '1/3·√2·(5·√11 − 9·√3)'
        """
        plain = re.sub(r"sqrt\((\d+)\)", r"√\1", self.text).replace("sqrt", "√").replace("pi", "π")
        plain = re.sub(r"(?<=[\w)])\s*([-+])\s*", r" \1 ", plain.replace("**", "^").replace("*", "·"))
        return plain.replace("-", "−")

    def same(self, other: Expression) -> bool:
        """Whether the values are equal: exactly if both are known as sums of roots, else to 1000 binary places."""
        if self.exact is not None and other.exact is not None:
            return dict(self.exact) == dict(other.exact)
        with localcontext(Context(prec=_DIGITS)):
            return abs(self.digits - other.digits) <= _SAME


class _Number(NamedTuple):
    """A value that is read: its digits, and the sum of roots that it is, if it is known as one."""

    digits: Decimal
    exact: Surd | None

    @property
    def is_zero(self) -> bool:
        return abs(self.digits) < _NOTHING if self.exact is None else not self.exact


def _rational(value: Fraction) -> _Number:
    return _Number(Decimal(value.numerator) / value.denominator, surds.rational_surd(value))


@cache
def _pi() -> Decimal:
    """Machin's formula, 16 arctan(1/5) - 4 arctan(1/239), with ten digits to spare."""
    unit: int = 10 ** (_DIGITS + 10)
    return Decimal(16 * _arctan_of_inverse(5, unit) - 4 * _arctan_of_inverse(239, unit)) / unit


def _arctan_of_inverse(x: int, unit: int) -> int:
    total, term, n, sign = 0, unit // x, 1, 1
    while term:
        total += sign * (term // n)
        term, n, sign = term // (x * x), n + 2, -sign
    return total


class _Reader:
    """From a text to its value, by recursive descent; powers bind more than signs, and to the right."""

    def __init__(self, text: str) -> None:
        self.text = text
        matches = _TOKEN.finditer(text.translate(_ALIKE))
        self.tokens = [
            (token, match.start(match.lastindex or 0) + 1) for match in matches if (token := match[0].strip())
        ]
        self.tokens.append(("", len(text) + 1))
        self.depth = 0

    # --- reading -------------------------------------------------------------------------------------

    def whole(self) -> _Number:
        number = self.sum()
        if self.tokens[0][0]:
            raise self.unexpected(message("an operator"))
        return number

    def sum(self) -> _Number:
        return self.chained("+-", lambda: self.chained("*/", self.signed))

    def chained(self, signs: str, operand: Callable[[], _Number]) -> _Number:
        """Operands with signs between them, from left to right."""
        number = operand()
        while (sign := self.tokens[0][0]) and sign in signs:
            at = self.taken()
            number = self.combined(sign, number, operand(), at)
        return number

    def signed(self) -> _Number:
        sign = self.tokens[0][0]
        if sign not in ("+", "-"):
            return self.power()
        at = self.deeper()
        number = self.signed()
        self.depth -= 1
        return self.combined("-", _rational(Fraction(0)), number, at) if sign == "-" else number

    def power(self) -> _Number:
        base = self.atom()
        if self.tokens[0][0] != "**":
            return base
        at = self.deeper()
        times = self.whole_number(self.signed(), at)
        self.depth -= 1
        return self.raised(base, times, at)

    def whole_number(self, number: _Number, at: int) -> int:
        """An exponent, to be known exactly."""
        exact = number.exact
        times = None if exact is None or not set(exact) <= {1} else exact.get(1, Fraction(0))
        if times is None or times.denominator != 1 or abs(times) > _MOST_TIMES:
            raise self.wrong(at, message("an exponent is a whole number from -{limit} to {limit}", limit=_MOST_TIMES))
        return int(times)

    def atom(self) -> _Number:
        token, at = self.tokens[0]
        if token[:1] in tuple("0123456789.") and token != ".":
            self.taken()
            return self.checked(_rational(Fraction(token)), at)
        if token in ("pi", "π"):
            self.taken()
            return _Number(+_pi(), None)
        if token in ("sqrt", "√"):
            self.deeper()
            if token == "sqrt" and self.tokens[0][0] != "(":
                raise self.unexpected(message("a parenthesis"))
            number = self.atom()
            self.depth -= 1
            return self.root(number, at)
        if token == "(":
            self.deeper()
            number = self.sum()
            if self.tokens[0][0] != ")":
                raise self.unexpected(message("a closing parenthesis"))
            self.taken()
            self.depth -= 1
            return number
        if token.isidentifier():
            raise self.wrong(at, message("unknown name {name!r}; known are sqrt and pi", name=token[:20]))
        raise self.unexpected(message("a number"))

    def taken(self) -> int:
        """Advance to the next token; returns the column of the previous one."""
        return self.tokens.pop(0)[1]

    def deeper(self) -> int:
        self.depth += 1
        if self.depth > _DEEPEST:
            raise self.wrong(self.tokens[0][1], message("more than {limit} nested levels", limit=_DEEPEST))
        return self.taken()

    # --- values --------------------------------------------------------------------------------------

    def combined(self, sign: str, first: _Number, second: _Number, at: int) -> _Number:
        if sign == "/" and second.is_zero:
            raise self.wrong(at, message("a division by zero"))
        known, other = first.exact, second.exact
        exact = None if known is None or other is None else surds.OPERATIONS[sign](known, other)
        return self.checked(_Number(_OPERATIONS[sign](first.digits, second.digits), exact), at)

    def raised(self, base: _Number, times: int, at: int) -> _Number:
        if times < 0 and base.is_zero:
            raise self.wrong(at, message("a division by zero"))
        exact = None if base.exact is None else surds.surd_power(base.exact, times)
        return self.checked(_Number(base.digits**times if times else Decimal(1), exact), at)

    def root(self, under: _Number, at: int) -> _Number:
        if under.digits < 0 and not under.is_zero:
            raise self.wrong(at, message("the root of a negative number"))
        exact = None if under.exact is None else surds.surd_sqrt(under.exact)
        return _Number(max(under.digits, Decimal(0)).sqrt(), exact)

    def checked(self, number: _Number, at: int) -> _Number:
        if abs(number.digits) >= 1 << _RANGE:
            raise self.wrong(at, message("a number beyond 2^{power}", power=_RANGE))
        return number

    # --- errors --------------------------------------------------------------------------------------

    def wrong(self, at: int, problem: Message) -> LinkageError:
        shown = self.text if len(self.text) <= 60 else f"{self.text[:57]}..."
        return LinkageError("{expression!r}, column {column}: {problem}", expression=shown, column=at, problem=problem)

    def unexpected(self, expected: Message) -> LinkageError:
        token, at = self.tokens[0]
        if token == "^":
            problem = message("expected {wanted}, but found '^'; powers are written **", wanted=expected)
        elif token:
            problem = message("expected {wanted}, but found {found!r}", wanted=expected, found=token[:20])
        else:
            problem = message("expected {wanted}, but the text ends", wanted=expected)
        return self.wrong(at, problem)


_OPERATIONS: dict[str, Callable[[Decimal, Decimal], Decimal]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
