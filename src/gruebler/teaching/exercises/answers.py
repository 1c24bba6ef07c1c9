"""Answers as people write them: 60, 7,2 cm, 78.5°, ± 78,5; read, and converted to the unit of the result."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import isfinite, pi

from gruebler.base.errors import GrueblerError
from gruebler.teaching.exercises.solution import Result
from gruebler.teaching.exercises.solving import last_place

_NUMBER = re.compile(r"\s*(±?)\s*([-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][-+]?\d{1,2})?)\s*(.*?)\s*", re.ASCII)
_SPELT = {"deg": "°", "degree": "°", "degrees": "°", "grad": "°", "rad/s": "1/s", "s^-1": "1/s", "rad/s²": "1/s²"}
_UNITS = {
    **{f"{name}{per}": (worth, f"length{per}") for name, worth in (("mm", 1.0), ("cm", 10.0), ("m", 1000.0))
       for per in ("", "/s", "/s²")},
    "°": (1.0, "angle"),
    "rad": (180 / pi, "angle"),
    "ms": (1.0, "time"),
    "s": (1000.0, "time"),
    "1/s": (1.0, "rate"),
    "1/s²": (1.0, "rate of a rate"),
}  # fmt: skip
"""Each unit in the first unit of its kind, and the kind."""


@dataclass(frozen=True, slots=True)
class GivenAnswer:
    """The number of an answer, in the unit of the result."""

    number: float
    place: float
    """The value of one unit of the last written digit."""
    has_unit: bool


def read_answer(answer: str, result: Result) -> GivenAnswer:
    """The number of an answer; without a unit it has that of the result.

    Raises `GrueblerError` for an answer without a number and for a unit of another kind.

    >>> from gruebler.base.text import message
    >>> read_answer("7,2 cm", Result(key="H", name=message("stroke"), value=72.0, unit="mm")).number
    72.0
    """
    form = _NUMBER.fullmatch(answer)
    if form is None or (form[1] and not result.either_sign) or not isfinite(float(form[2].replace(",", "."))):
        raise GrueblerError(
            "expected a number in {unit}, not {answer}" if result.unit else "expected a number, not {answer}",
            unit=result.unit,
            answer=answer,
        )
    text = form[2].replace(",", ".")
    scale = unit_scale(form[3], result.unit) if form[3] else 1.0
    if scale is None:
        raise GrueblerError(
            "expected a number in {unit}, not {answer}"
            if result.unit
            else "expected a number without a unit, not {answer}",
            unit=result.unit,
            answer=answer,
        )
    return GivenAnswer(float(text) * scale, last_place(text) * scale, bool(form[3]))


def unit_scale(unit: str, target: str) -> float | None:
    """A unit in terms of another one of the same kind; None if it is of another kind, or unknown.

    >>> unit_scale("cm/s^2", "mm/s²"), unit_scale("s", "mm")
    (10.0, None)
    """
    plain = re.sub(r"\^?2$", "²", unit.replace(" ", ""))
    plain = _SPELT.get(plain.casefold(), plain)
    source_unit, target_unit = _UNITS.get(plain), _UNITS.get(target)
    if source_unit is None or target_unit is None or source_unit[1] != target_unit[1]:
        return None
    return source_unit[0] / target_unit[0]


def units_for(target: str) -> dict[str, float]:
    """The units in which an answer may be given instead of another one, in terms of that one.

    >>> units_for("s")
    {'ms': 0.001, 's': 1.0}
    """
    return {unit: scale for unit in (*_UNITS, *_SPELT) if (scale := unit_scale(unit, target)) is not None}
