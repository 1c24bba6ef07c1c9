"""Dimensions in exact form, such as ``5/2*sqrt(3)``: read safely and evaluated exactly.

Numbers, ``+ - * / **``, parentheses, ``sqrt`` and ``pi``; whole exponents only. The value is known as a sum of square
roots with rational factors wherever it is one (`surds`), and in any case to any number of digits
(`interval_arithmetic`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from gruebler.base.errors import LinkageError
from gruebler.base.immutable import settle
from gruebler.base.text import Message, message
from gruebler.teaching.sheets import interval_arithmetic, surds
from gruebler.teaching.sheets.interval_arithmetic import Bracket, PrecisionTooLowError
from gruebler.teaching.sheets.surds import Surd

_LONGEST = 300  # characters
_DEEPEST = 30  # parentheses, signs and powers within one another
_MOST_TIMES = 64  # exponent
_RANGE = 900  # bits before the point, and behind it
_PRECISIONS = (96, 256, 1024, 4096)  # bits behind the point
_TOKEN = re.compile(r"\s*(?:([0-9]+(?:\.[0-9]*)?|\.[0-9]+)|(\*\*|[-+*/()√π])|([^\W\d]\w*)|(\S))")
_ALIKE = str.maketrans("−·×", "-**")


class _Step(NamedTuple):
    """A step of the calculation, with the last results as operands; ``at`` is its column in the text."""

    kind: str
    at: int
    number: Fraction = Fraction(0)


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
    steps: tuple[_Step, ...] = field(init=False, repr=False, compare=False)
    value: float = field(init=False, repr=False, compare=False)
    """The nearest double."""
    exact: Surd | None = field(init=False, repr=False, compare=False)
    """The value as a sum of roots, factors by radicand; None if it is not known as one."""

    def __post_init__(self) -> None:
        if not isinstance(self.text, str) or len(self.text) > _LONGEST:
            description = f"one of {len(self.text)}" if isinstance(self.text, str) else repr(self.text)[:40]
            raise LinkageError(
                "an expression is a text of at most {longest} characters, not {found}",
                longest=_LONGEST,
                found=description,
            )
        settle(self, steps=tuple(_Reader(self.text).whole()))
        settle(self, value=_nearest(self.text, self.steps))
        settle(self, exact=_exactly(self.steps))

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
        first, second = (_bracketed(expression.text, expression.steps, 4096) for expression in (self, other))
        return first[0] - second[1] <= 1 << 3096 and second[0] - first[1] <= 1 << 3096


def _wrong(text: str, at: int, problem: Message) -> LinkageError:
    shown = text if len(text) <= 60 else f"{text[:57]}..."
    return LinkageError("{expression!r}, column {column}: {problem}", expression=shown, column=at, problem=problem)


# --- values -----------------------------------------------------------------------------------------


def _nearest(text: str, steps: tuple[_Step, ...]) -> float:
    """The nearest double, from narrower and narrower brackets; if none separates it from a midpoint of two, that."""
    for p in _PRECISIONS:
        try:
            low, high = (Fraction(end, 1 << p) for end in _bracketed(text, steps, p))
        except PrecisionTooLowError as stop:
            if p == _PRECISIONS[-1]:
                raise _wrong(text, stop.at, message("a division by zero")) from None
            continue
        if float(low) == float(high):
            return float(low) + 0.0  # no minus zero
    return float((low + high) / 2)


def _bracketed(text: str, steps: tuple[_Step, ...], p: int) -> Bracket:
    """The value between two bounds, p bits behind the point."""
    stack: list[Bracket] = []
    for step in steps:
        try:
            result = _bracket(step, stack, p)
        except PrecisionTooLowError:
            raise PrecisionTooLowError(step.at) from None
        if result is None:
            raise _wrong(text, step.at, message("the root of a negative number"))
        if max(abs(result[0]), abs(result[1])) >> p + _RANGE:
            raise _wrong(text, step.at, message("a number beyond 2^{power}", power=_RANGE))
        stack.append(result)
    return stack[0]


def _bracket(step: _Step, stack: list[Bracket], p: int) -> Bracket | None:
    """The result of a step, its operands taken from the stack; None for the root of a negative number."""
    match step.kind:
        case "number":
            return interval_arithmetic.interval_of_fraction(step.number, p)
        case "pi":
            return interval_arithmetic.interval_pi(p)
        case "negative":
            low, high = stack.pop()
            return -high, -low
        case "**":
            return interval_arithmetic.interval_power(stack.pop(), int(step.number), p)
        case "sqrt":
            under = stack.pop()
            return None if under[1] < 0 else interval_arithmetic.interval_sqrt(under, p)
    second, first = stack.pop(), stack.pop()
    return interval_arithmetic.OPERATIONS[step.kind](first, second, p)


def _exactly(steps: tuple[_Step, ...]) -> Surd | None:
    """The value as a sum of roots; None if it is not one. Invalid steps have raised in `_nearest`."""
    stack: list[Surd] = []
    for step in steps:
        result = _surd(step, stack)
        if result is None:
            return None
        stack.append(result)
    return stack[0]


def _surd(step: _Step, stack: list[Surd]) -> Surd | None:
    match step.kind:
        case "number":
            return surds.rational_surd(step.number)
        case "pi":
            return None
        case "negative":
            return {d: -q for d, q in stack.pop().items()}
        case "**":
            return surds.surd_power(stack.pop(), int(step.number))
        case "sqrt":
            return surds.surd_sqrt(stack.pop())
    second, first = stack.pop(), stack.pop()
    return surds.OPERATIONS[step.kind](first, second)


# --- reading ----------------------------------------------------------------------------------------


class _Reader:
    """From a text to steps, by recursive descent; powers bind more than signs, and to the right."""

    def __init__(self, text: str) -> None:
        self.text = text
        matches = _TOKEN.finditer(text.translate(_ALIKE))
        self.tokens = [
            (token, match.start(match.lastindex or 0) + 1) for match in matches if (token := match[0].strip())
        ]
        self.tokens.append(("", len(text) + 1))
        self.depth = 0

    def whole(self) -> Iterator[_Step]:
        yield from self.sum()
        if self.tokens[0][0]:
            raise self.unexpected(message("an operator"))

    def sum(self) -> Iterator[_Step]:
        yield from self.products("+-", lambda: self.products("*/", self.signed))

    def products(self, signs: str, operand: Callable[[], Iterator[_Step]]) -> Iterator[_Step]:
        """Operands with signs between them, from left to right."""
        yield from operand()
        while (sign := self.tokens[0][0]) and sign in signs:
            at = self.taken()
            yield from operand()
            yield _Step(sign, at)

    def signed(self) -> Iterator[_Step]:
        if self.tokens[0][0] not in ("+", "-"):
            yield from self.power()
            return
        sign, at = self.tokens[0][0], self.deeper()
        yield from self.signed()
        self.depth -= 1
        if sign == "-":
            yield _Step("negative", at)

    def power(self) -> Iterator[_Step]:
        yield from self.atom()
        if self.tokens[0][0] == "**":
            at = self.deeper()
            exponent = tuple(self.signed())
            self.depth -= 1
            yield _Step("**", at, self.whole_number(exponent, at))

    def whole_number(self, steps: tuple[_Step, ...], at: int) -> Fraction:
        """An exponent, to be known exactly."""
        _nearest(self.text, steps)
        exact = _exactly(steps)
        number = None if exact is None or not set(exact) <= {1} else exact.get(1, Fraction(0))
        if number is None or number.denominator != 1 or abs(number) > _MOST_TIMES:
            problem = message("an exponent is a whole number from -{limit} to {limit}", limit=_MOST_TIMES)
            raise _wrong(self.text, at, problem)
        return number

    def atom(self) -> Iterator[_Step]:
        token, at = self.tokens[0]
        if token[:1] in tuple("0123456789.") and token != ".":
            self.taken()
            yield _Step("number", at, Fraction(token))
        elif token in ("pi", "π"):
            self.taken()
            yield _Step("pi", at)
        elif token in ("sqrt", "√"):
            self.deeper()
            if token == "sqrt" and self.tokens[0][0] != "(":
                raise self.unexpected(message("a parenthesis"))
            yield from self.atom()
            self.depth -= 1
            yield _Step("sqrt", at)
        elif token == "(":
            self.deeper()
            yield from self.sum()
            if self.tokens[0][0] != ")":
                raise self.unexpected(message("a closing parenthesis"))
            self.taken()
            self.depth -= 1
        elif token.isidentifier():
            raise _wrong(self.text, at, message("unknown name {name!r}; known are sqrt and pi", name=token[:20]))
        else:
            raise self.unexpected(message("a number"))

    def taken(self) -> int:
        """Advance to the next token; returns the column of the previous one."""
        return self.tokens.pop(0)[1]

    def deeper(self) -> int:
        self.depth += 1
        if self.depth > _DEEPEST:
            problem = message("more than {limit} nested levels", limit=_DEEPEST)
            raise _wrong(self.text, self.tokens[0][1], problem)
        return self.taken()

    def unexpected(self, expected: Message) -> LinkageError:
        token, at = self.tokens[0]
        if token == "^":
            problem = message("expected {wanted}, but found '^'; powers are written **", wanted=expected)
        elif token:
            problem = message("expected {wanted}, but found {found!r}", wanted=expected, found=token[:20])
        else:
            problem = message("expected {wanted}, but the text ends", wanted=expected)
        return _wrong(self.text, at, problem)
