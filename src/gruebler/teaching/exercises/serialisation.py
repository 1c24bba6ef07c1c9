"""Exercises, solutions and grades as plain data, with texts in all languages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gruebler.base.text import LANGUAGES, Readable
from gruebler.files import Exercise
from gruebler.teaching.exercises.grading import Grade, ascii_key
from gruebler.teaching.exercises.solution import Part, PartHeading, Solution, SolutionStep, TeachingTable, Value
from gruebler.teaching.exercises.solving import Comparison, compare


def task_as_dict(exercise: Exercise) -> dict[str, Any]:
    """The task without its solution."""
    return {
        "id": exercise.id,
        "name": _value(exercise.name),
        "source": exercise.source,
        "task": _value(exercise.task),
        "method": exercise.method,
        "given": dict(exercise.given),
        "asked": [ascii_key(question.key) for question in exercise.asked],
        "remark": None if exercise.remark is None else _value(exercise.remark),
    }


def solution_as_dict(exercise: Exercise, solution: Solution) -> dict[str, Any]:
    """The task with its steps, results, printed answers and checks."""
    return task_as_dict(exercise) | {
        "steps": [_part(part) for part in solution.parts],
        "results": {
            ascii_key(r.key): {"symbol": r.symbol, "name": _value(r.name), "value": _value(r.value), "unit": r.unit}
            for r in solution.results.values()
        },
        "printed": [
            _comparison(comparison)
            for comparison in compare(exercise, solution)
            if comparison.asked.printed is not None
        ],
        "checks": [
            {"text": _value(c.text), "first": c.first, "second": c.second, "unit": c.unit, "holds": c.holds}
            for c in solution.checks
        ],
    }


def table_as_dict(table: TeachingTable) -> dict[str, Any]:
    """A table: title, headers, rows."""
    return {
        "title": _value(table.title),
        "headers": [_value(header) for header in table.headers],
        "rows": [[_value(value) for value in row] for row in table.rows],
    }


def grades_as_list(marks: Sequence[Grade]) -> list[dict[str, Any]]:
    """The graded answers."""
    return [
        {
            "key": ascii_key(grade.key),
            "name": grade.name,
            "answer": grade.answer,
            "mark": grade.mark.value,
            "hint": None if grade.hint is None else _value(grade.hint),
        }
        for grade in marks
    ]


def _part(part: Part) -> dict[str, Any]:
    if isinstance(part, TeachingTable):
        return {"table": table_as_dict(part)}
    if isinstance(part, PartHeading):
        return {"heading": _value(part.text)}
    return _step(part)


def _step(step: SolutionStep) -> dict[str, Any]:
    value = None if step.value is None else _value(step.value)
    return {
        "text": _value(step.text),
        "formula": step.formula,
        "numbers": step.numbers,
        "value": value,
        "unit": step.unit,
    }


def _comparison(comparison: Comparison) -> dict[str, Any]:
    return {
        "key": ascii_key(comparison.asked.key),
        "printed": comparison.asked.printed,
        "unit": comparison.asked.unit or comparison.result.unit,
        "value": _value(comparison.result.value),
        "agrees": comparison.agrees,
        "reason": None if comparison.asked.reason is None else _value(comparison.asked.reason),
    }


def _value(value: Value) -> Any:
    return {lang: value.in_language(lang) for lang in LANGUAGES} if isinstance(value, Readable) else value
