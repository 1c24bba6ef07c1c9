"""The parts of a solution: steps with formula and numbers, tables, results by key, checks by a second method.

A solution is computed from the given quantities, in the units in which they are given, angles in degrees. A
`SolutionBuilder` collects it: one call of `SolutionBuilder.find` is a step and, if it has a key, a result.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.text import Message, Readable, in_every_language, message
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.linkages.quantities import as_finite

Value = float | bool | str | Readable
"""A number, yes or no, a name that is the same in all languages, or one that is not."""

_SYMBOL = re.compile(r"[^\W\d_][^\W²³]*(?:\*|''|')?")


@dataclass(frozen=True, slots=True, kw_only=True)
class SolutionStep:
    """One step: its text, the formula, the formula with its numbers, the value."""

    text: Readable
    formula: str = ""
    numbers: str = ""
    value: Value | None = None
    unit: str = ""
    either_sign: bool = False


@dataclass(frozen=True, slots=True)
class TeachingTable:
    """Rows of values under headers."""

    title: Message
    headers: tuple[str | Readable, ...]
    rows: tuple[tuple[Value, ...], ...]
    decimals: int = 3
    """Decimals of the numbers that are not whole."""


@dataclass(frozen=True, slots=True)
class PartHeading:
    """The heading of a new part of the solution, with steps counted from 1 again."""

    text: Readable


Part = SolutionStep | TeachingTable | PartHeading


@dataclass(frozen=True, slots=True, kw_only=True)
class Result:
    """A quantity that the solution computes."""

    key: str
    name: Readable
    value: Value
    unit: str = ""
    symbol: str = ""
    either_sign: bool = False
    """Whether the value is valid with both signs, + and -."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """One quantity computed by two methods."""

    text: Readable
    first: float
    second: float
    unit: str = ""
    tolerance: float = 1e-8
    """Largest difference allowed, relative to the larger of the two (and to 1)."""

    @property
    def holds(self) -> bool:
        """Whether both methods agree."""
        size = max(1.0, abs(self.first), abs(self.second))
        return abs(self.first - self.second) <= self.tolerance * size


@dataclass(frozen=True, slots=True)
class Mistake:
    """A frequent wrong answer, and the hint for it."""

    key: str
    value: Value
    hint: Readable


@brief
@dataclass(frozen=True, slots=True, repr=False)
class Solution:
    """The steps of a solution, its results by key, and its checks."""

    parts: tuple[Part, ...]
    results: Mapping[str, Result]
    checks: tuple[Check, ...] = ()
    mistakes: tuple[Mistake, ...] = ()

    def __getitem__(self, key: str) -> Value:
        """The value of a result."""
        return self.results[key].value

    def number(self, key: str) -> float:
        """The value of a result that is a number; TypeError for any other."""
        value = self.results[key].value
        if not isinstance(value, int | float):
            raise TypeError(f"{key} is {value!r}, not a number")
        return float(value)

    @property
    def tables(self) -> tuple[TeachingTable, ...]:
        """The tables among the parts."""
        return tuple(part for part in self.parts if isinstance(part, TeachingTable))


def formula_number(value: float) -> str:
    """A number with up to six digits, as people write it in a formula.

    >>> formula_number(40.0), formula_number(78.46304096718453), formula_number(-1e-14), formula_number(2024475.3)
    ('40', '78.463', '0', '2024475')
    """
    if abs(value) < 5e-10:
        return "0"
    return f"{value:.0f}" if abs(value) >= 1e5 else f"{value:.6g}"


def figure(value: float) -> Message:
    """The number of `formula_number` for a text, with the decimal sign of its language.

    >>> figure(78.46304096718453).in_language("de")
    '78,463'
    """
    if abs(value) < 5e-10:
        return message("0")
    return message("{value:.0f}" if abs(value) >= 1e5 else "{value:.6g}", value=value)


def angle(value: float) -> str:
    """An angle in degrees with its sign.

    >>> angle(50.478803)
    '50.4788°'
    """
    return f"{formula_number(value)}°"


def as_step(step: object) -> float:
    """The step of a table of crank angles, in degrees.

    >>> as_step(0)
    Traceback (most recent call last):
        ...
    gruebler.base.errors.LinkageError: the step of the table must lie from 0.1 to 360 degrees, not 0
    """
    number = as_finite("step", step)
    if not 0.1 <= number <= 360:
        raise LinkageError("the step of the table must lie from 0.1 to 360 degrees, not {step!r}", step=step)
    return number


def with_turning_crank(a: float, b: float, c: float, d: float) -> FourBar:
    """The four-bar of these lengths.

    Raises `LinkageError` if its crank does not turn fully.

    >>> with_turning_crank(25, 70, 40, 70).turning
    ('a',)
    """
    size = FourBar(a, b, c, d)
    if "a" not in size.turning:
        raise LinkageError(
            "the crank of the four-bar {a:g}, {b:g}, {c:g}, {d:g} does not turn fully: {type}",
            a=a,
            b=b,
            c=c,
            d=d,
            type=in_every_language(size.type.name),
        )
    return size


def fill_template(formula: str, values: Mapping[str, float | str]) -> str:
    """The formula with numbers in place of its symbols; a negative one in brackets if it is not the first.

    >>> fill_template("√((a + b)² - e²)", {"a": 1.7, "b": 6, "e": -1.5})
    '√((1.7 + 6)² - (-1.5)²)'
    """

    def put(match: re.Match[str]) -> str:
        if match[0] not in values:
            return match[0]
        value = values[match[0]]
        text = value if isinstance(value, str) else formula_number(value)
        before, after = formula[: match.start()].rstrip()[-1:], formula[match.end() : match.end() + 1]
        return f"({text})" if text.startswith("-") and (before not in ("", "(", "|") or after == "²") else text

    return _SYMBOL.sub(put, formula)


def _told(text: str | Readable, values: Mapping[str, object]) -> Readable:
    return message(text, **values) if isinstance(text, str) else text


@dataclass(slots=True, kw_only=True)
class SolutionBuilder:
    """A solution under construction."""

    unit: str = ""
    parts: list[Part] = field(default_factory=list)
    results: dict[str, Result] = field(default_factory=dict)
    checks: list[Check] = field(default_factory=list)
    mistakes: list[Mistake] = field(default_factory=list)

    def find(
        self,
        key: str,
        name: Readable,
        formula: str,
        value: float,
        *,
        unit: str | None = None,
        symbol: str | None = None,
        text: Readable | None = None,
        values: Mapping[str, float | str] | None = None,
        either_sign: bool = False,
        **more: float | str,
    ) -> float:
        """A step with a result: ``symbol = formula = formula with numbers = value``; returns the value.

        ``text`` replaces the name in the step; ``values`` and ``more`` are the numbers for the symbols of the formula;
        with ``either_sign`` the value is valid with both signs.
        """
        shown = self.unit if unit is None else unit
        sign = key if symbol is None else symbol
        value = float(value)
        numbers = fill_template(formula, {**(values or {}), **more})
        self.parts.append(
            SolutionStep(
                text=text or name,
                formula=f"{sign} = {formula}",
                numbers=numbers,
                value=value,
                unit=shown,
                either_sign=either_sign,
            )
        )
        self.keep(key, name, value, unit=shown, symbol=sign, either_sign=either_sign)
        return value

    def keep(
        self, key: str, name: Readable, value: Value, *, unit: str = "", symbol: str = "", either_sign: bool = False
    ) -> None:
        """A result without a step of its own."""
        self.results[key] = Result(
            key=key, name=name, value=value, unit=unit, symbol=symbol or key, either_sign=either_sign
        )

    def number(self, key: str) -> float:
        """The value of an earlier result that is a number."""
        return self.done().number(key)

    def say(self, text: str | Readable, formula: str = "", **values: object) -> None:
        """A step in words, with the values in their gaps."""
        self.parts.append(SolutionStep(text=_told(text, values), formula=formula))

    def table(
        self, title: Message, headers: Sequence[str | Readable], rows: Iterable[Sequence[Value]], *, decimals: int = 3
    ) -> None:
        """A table."""
        self.parts.append(TeachingTable(title, tuple(headers), tuple(tuple(row) for row in rows), decimals))

    def check(
        self,
        text: str | Readable,
        first: float,
        second: float,
        unit: str | None = None,
        tolerance: float = 1e-8,
        **values: object,
    ) -> None:
        """A check: the same quantity by the steps above and by a second method."""
        self.checks.append(
            Check(
                text=_told(text, values),
                first=first,
                second=second,
                unit=self.unit if unit is None else unit,
                tolerance=tolerance,
            )
        )

    def mistake(self, key: str, value: Value, hint: Readable) -> None:
        """A frequent wrong answer; left out where it happens to be right."""
        correct = self.results[key].value
        alike = isinstance(correct, float | int) and isinstance(value, float | int) and abs(correct - value) < 1e-9
        if correct != value and not alike:
            value = float(value) if isinstance(correct, float) and isinstance(value, int) else value
            self.mistakes.append(Mistake(key, value, hint))

    def done(self) -> Solution:
        """The solution."""
        return Solution(
            tuple(self.parts), MappingProxyType(dict(self.results)), tuple(self.checks), tuple(self.mistakes)
        )
