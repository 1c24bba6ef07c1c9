"""A fact of the teaching documents, and its comparison with what the program derives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gruebler.base.text import Readable
from gruebler.teaching.exercises import compare, exercise, solve
from gruebler.teaching.sheets import sheet

EXACT = 1e-9  # relative to the larger of 1 and the number: two ways to the same number in double precision
ROUNDING = 1e-9  # of half a unit of the last printed digit


@dataclass(frozen=True, kw_only=True)
class Fact:
    """One thing that a document states, written by hand from it, and what derives it."""

    place: str
    """Document and section, figure or exercise; of page numbers only that of page 28 of 003 came through (3.4)."""
    states: str
    """What is stated there, in own words."""
    derive: Callable[[], Any]
    """The program's answer."""
    printed: str = ""
    """The number digit for digit, with a decimal point; its last digit says how exact it is."""
    value: Any = None
    """The right value by an own computation (independent.py) or by hand; or the stated word, list or truth."""
    near: float = EXACT
    """How far the program may be from it: more than rounding where differences or samples are the own computation."""
    misprint: str = ""
    """Why the printed value is wrong; `value` is then the right one."""
    subject: str = ""
    """The exercise, machine or sheet of the catalog that it is about, if any."""
    key: str = ""
    """The result of the exercise or the quantity of the sheet."""
    word: str = ""
    """The printed answer where it is a word."""

    @property
    def name(self) -> str:
        """Place and statement."""
        return f"{self.place}: {self.states}"

    def fault(self) -> str | None:
        """What is wrong with the program's answer, or with the fact itself; None if they agree."""
        derived = plain(self.derive())
        if not self.printed and self.value is None:
            return "nothing is stated"
        if self.value is not None and not alike(derived, self.value, self.near):
            return f"derived {derived!r}, should be {self.value!r}"
        if not self.printed:
            return "a misprint of nothing" if self.misprint else None
        agrees = abs(float(derived) - float(self.printed)) <= half_place(self.printed) * (1 + ROUNDING)
        if self.misprint:
            return (
                f"derived {derived!r} agrees with the print {self.printed}, which is marked wrong" if agrees else None
            )
        return None if agrees else f"derived {derived!r}, printed {self.printed}"


def half_place(digits: str) -> float:
    """Half a unit of the last written digit: 0.05 for 91.2, 0.5 for 62."""
    return 0.5 * 10.0 ** -len(digits.partition(".")[2])


def plain(answer: Any) -> Any:
    """Texts of the library as English words, arrays as they are."""
    return answer.in_language("en") if isinstance(answer, Readable) else answer


def alike(derived: Any, value: Any, near: float) -> bool:
    """Equal words and truths; numbers and arrays of numbers that are near to each other."""
    if isinstance(value, str | bool) or isinstance(derived, str | bool) or derived is None:
        return type(derived) is type(value) and derived == value
    if isinstance(value, dict | set) or (isinstance(value, list | tuple) and value and not _numbers(value)):
        return bool(derived == value)
    first, second = np.asarray(derived), np.asarray(value)
    if first.shape != second.shape:
        return False
    size = np.maximum(1.0, np.maximum(abs(first), abs(second)))
    return bool((abs(first - second) <= near * size).all())


def _numbers(values: Any) -> bool:
    return np.asarray(values, dtype=object).ravel().tolist() != [] and all(
        isinstance(each, int | float | complex | np.number) and not isinstance(each, bool)
        for each in np.asarray(values, dtype=object).ravel().tolist()
    )


def answer_of(id: str, key: str, printed: str, reasoned: bool) -> Any:
    """A result of an exercise, in the unit of the print; refused unless the catalog has the same print and reason."""
    solved = solve(exercise(id))
    for each in compare(exercise(id), solved):
        if each.asked.key == key:
            kept = each.asked.printed or ""
            if kept != printed or (each.asked.reason is not None) != reasoned:
                beside = "no reason" if each.asked.reason is None else "a reason"
                return f"the catalog has the print {kept!r} for {key}, and {beside} beside it"
            in_cm = (each.asked.unit, each.result.unit) == ("cm", "mm")
            return each.result.value * 0.1 if in_cm and isinstance(each.result.value, float) else each.result.value
    return f"the catalog does not ask for {key}" if printed else solved[key]


def task(id: str, key: str, states: str, printed: str = "", value: Any = None, **more: Any) -> Fact:
    """A fact of an exercise or worked example; what is printed are digits or a word."""
    digits = printed if printed[:1].isdigit() else ""
    reasoned = bool(more.get("misprint"))
    return Fact(
        place=exercise_place(id),
        states=states,
        derive=lambda: answer_of(id, key, printed, reasoned),
        printed=digits,
        word="" if digits else printed,
        value=value,
        subject=id,
        key=key,
        **more,
    )


def exercise_place(id: str) -> str:
    """Where an exercise or example of the catalog stands."""
    kind, _, number = id.partition("-")
    number = number if kind == "exercise" else number.partition("-")[0]
    return f"000/003, {'exercise' if kind == 'exercise' else 'section'} {number}"


def on_sheet(key: str, states: str, printed: str = "", value: Any = None, **more: Any) -> Fact:
    """A quantity of collection sheet 001, by its id there; ``printed`` are decimal digits.

    What the catalog has as printed must be the same digits, or an expression of the value (of the print, if that is
    wrong), and the reason for a difference must be there if and only if the print is wrong.
    """

    def derive() -> Any:
        page = sheet("mzc")
        row = next(row for row in (*page.dimensions, *page.quantities, *page.example_values) if row.id == key)
        wrong = bool(more.get("misprint"))
        kept = None if row.printed is None else row.printed.text
        if kept is None or (row.reason is not None) != wrong or row.is_as_printed is wrong:
            return f"the catalog has the print {kept!r} for {key}, reason: {row.reason is not None}"
        if wrong or kept != printed:
            assert row.printed is not None
            shown = float(printed) if wrong or value is None else value
            if abs(row.printed.value - shown) > (half_place(printed) if wrong else EXACT):
                return f"the catalog has the print {kept!r} for {key}"
        return row.derived

    return Fact(place="001", states=states, derive=derive, printed=printed, value=value, subject="mzc", key=key, **more)
