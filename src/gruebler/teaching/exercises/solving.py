"""The method of an exercise, and the comparison of its results with the printed answers."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib import import_module
from inspect import isfunction

from gruebler.base.errors import CatalogError, unknown
from gruebler.base.text import LANGUAGES, Readable, in_every_language, joined, message
from gruebler.files import Exercise
from gruebler.files.catalog_records import Question
from gruebler.teaching.exercises.solution import Result, Solution, Value, figure

Method = Callable[..., Solution]

_THEORIES = (
    "mobility",
    "dyads",
    "grashof",
    "dead_centres",
    "transmission_angle",
    "coupler_points",
    "straight_guides",
    "velocities",
    "transfer",
    "in_space",
)


@cache
def methods() -> dict[str, Method]:
    """Every method by the name that exercises use: theory and public function that gives a solution."""
    theories = {theory: vars(import_module(f"gruebler.teaching.exercises.{theory}")) for theory in _THEORIES}
    return {
        f"{theory}.{name}": value
        for theory, names in theories.items()
        for name, value in names.items()
        if isfunction(value) and not name.startswith("_") and value.__annotations__.get("return") == "Solution"
    }


_SCALE = {("cm", "mm"): 10.0, ("mm", "cm"): 0.1, ("m", "mm"): 1000.0, ("s", "ms"): 1000.0}


def solve(exercise: Exercise) -> Solution:
    """The solution of an exercise, computed from its given quantities and cached.

    Raises `CatalogError` for an unknown method or unsuitable given quantities, and any error of the method.

    >>> from gruebler.teaching.catalog import exercises
    >>> solve(exercises()["exercise-6"])["F"]
    1
    """
    machines = tuple(case.machine for case in exercise.cases)
    return _solve(exercise.id, exercise.method or "", tuple(exercise.given.items()), machines)


@lru_cache(maxsize=256)
def _solve(id: str, name: str, quantities: tuple[tuple[str, float | str], ...], machines: tuple[str, ...]) -> Solution:
    if name not in methods():
        raise CatalogError("{id}: unknown method {word!r}{suggestion}", id=id, **unknown(name, methods()))
    method, arguments = methods()[name], dict(quantities)
    if name == "mobility.machines" and not arguments:
        arguments = {"machines": " ".join(machines)}
    try:
        inspect.signature(method).bind(**arguments)
    except TypeError as error:
        raise CatalogError("{id}: given: {error} of {method}", id=id, error=error, method=name) from None
    return method(**arguments)


_ALTERNATIVES = ({"b", "ratio"},)
"""Quantities of which only one is given: giving one leaves out the others."""


def with_values(exercise: Exercise, values: Mapping[str, float | str]) -> Exercise:
    """The exercise with other given quantities, and without the printed answers and remarks to the former ones.

    Raises `CatalogError` for a quantity that the method of the exercise does not take, or that is no number.

    >>> from gruebler.teaching.catalog import catalog_folder
    >>> from gruebler.files import read_exercise
    >>> eleven = read_exercise(catalog_folder() / "solved" / "exercise-11.toml")
    >>> solve(with_values(eleven, {"a": 30}))["H"]
    60.0
    """
    parameters = inspect.signature(methods()[exercise.method or ""]).parameters
    given = dict(exercise.given)
    for key, value in values.items():
        if key not in parameters:
            raise CatalogError(
                "{id} has no quantity {word!r}{suggestion}; it has {known}", id=exercise.id, **unknown(key, parameters)
            )
        for other in set().union(*(group for group in _ALTERNATIVES if key in group)) - {key, *values}:
            given.pop(other, None)
        given[key] = _number(key, value) if "float" in str(parameters[key].annotation) else value
    shown = [(key, given[key]) for key in values]
    changed = joined(
        [
            message("{name} = {value}", name=key, value=value if isinstance(value, str) else figure(value))
            for key, value in shown
        ],
        ", ",
    )
    task = message("{task} Here with other values: {values}.", task=exercise.task, values=changed)
    asked = tuple(Question(question.key) for question in exercise.asked)
    return Exercise(
        id=exercise.id,
        name=exercise.name,
        source=exercise.source,
        task=in_every_language(task.in_language),
        method=exercise.method,
        given=given,
        cases=exercise.cases,
        asked=asked,
    )


def _number(key: str, value: float | str) -> float:
    """A quantity as a number; `CatalogError` if it is none."""
    if not isinstance(value, str):
        return value
    try:
        return float(value.replace(",", "."))
    except ValueError:
        raise CatalogError("{key}: expected a number, but found {value!r}", key=key, value=value) from None


@dataclass(frozen=True, slots=True)
class Comparison:
    """A printed answer with the computed one."""

    asked: Question
    result: Result
    agrees: bool | None
    """Whether they agree within the printed digits; None if nothing is printed."""

    @property
    def explained(self) -> bool:
        """Whether they agree without a reason, or differ with a reason."""
        return self.agrees is None or self.agrees != (self.asked.reason is not None)


def compare(exercise: Exercise, solution: Solution) -> list[Comparison]:
    """Every requested result with its printed answer.

    Raises `CatalogError` for a key that the solution does not have.
    """
    comparisons = []
    for question in exercise.asked:
        if question.key not in solution.results:
            keys = ", ".join(solution.results)
            raise CatalogError(
                "{id}: asked: the solution has no result {key!r}; it has {keys}",
                id=exercise.id,
                key=question.key,
                keys=keys,
            )
        result = solution.results[question.key]
        comparisons.append(
            Comparison(question, result, None if question.printed is None else _agrees(question, result))
        )
    return comparisons


def _agrees(question: Question, result: Result) -> bool:
    assert question.printed is not None
    value: Value = result.value
    if isinstance(value, bool):
        return question.printed == ("yes" if value else "no")
    if isinstance(value, Readable):
        return question.printed in [value.in_language(lang) for lang in LANGUAGES]
    if isinstance(value, str):
        return question.printed == value
    scale = scale_of(question, result)
    return abs(float(question.printed) * scale - value) <= last_place(question.printed) * scale * (0.5 + 1e-9)


def scale_of(asked: Question, result: Result) -> float:
    """One unit of the printed number in units of the result."""
    return _SCALE.get((asked.unit, result.unit), 1.0) if asked.unit else 1.0


def last_place(text: str) -> float:
    """The value of one unit of the last written digit.

    >>> last_place("66.4"), last_place("40"), last_place("2e3")
    (0.1, 1.0, 1000.0)
    """
    match = re.fullmatch(r"\s*[-+]?\d*\.?(\d*)(?:[eE]([-+]?\d+))?\s*", text)
    if match is None:
        raise ValueError(text)
    return float(10.0 ** (int(match[2] or 0) - len(match[1] if "." in text else "")))
