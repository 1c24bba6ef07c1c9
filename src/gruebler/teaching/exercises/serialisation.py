"""Exercises, solutions and grades as plain data, with texts in all languages."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

from gruebler.base.plain_data import plain
from gruebler.base.text import LANGUAGES, Readable
from gruebler.files import Exercise
from gruebler.teaching.exercises.grading import Grade, ascii_key
from gruebler.teaching.exercises.solution import Part, PartHeading, Solution, TeachingTable
from gruebler.teaching.exercises.solving import Comparison, compare


def task_as_dict(exercise: Exercise) -> dict[str, Any]:
    """The task without its solution."""
    asked = [ascii_key(question.key) for question in exercise.asked]
    return {**_plain(exercise, "id name source task method given remark"), "asked": asked}


def solution_as_dict(exercise: Exercise, solution: Solution) -> dict[str, Any]:
    """The task with its steps, results, printed answers and checks."""
    return task_as_dict(exercise) | {
        "steps": [_part(part) for part in solution.parts],
        "results": {ascii_key(r.key): _plain(r, "symbol name value unit") for r in solution.results.values()},
        "printed": [
            _comparison(comparison)
            for comparison in compare(exercise, solution)
            if comparison.asked.printed is not None
        ],
        "checks": [_plain(check, "text first second unit holds") for check in solution.checks],
    }


def table_as_dict(table: TeachingTable) -> dict[str, Any]:
    """A table: title, headers, rows."""
    return dict(_plain(table, "title headers rows"))


def grades_as_list(marks: Sequence[Grade]) -> list[dict[str, Any]]:
    """The graded answers."""
    return [_plain(grade, "key name answer mark hint", units={"key": ascii_key}) for grade in marks]


def _part(part: Part) -> dict[str, Any]:
    if isinstance(part, TeachingTable):
        return {"table": table_as_dict(part)}
    if isinstance(part, PartHeading):
        return {"heading": _in_all_languages(part.text)}
    return dict(_plain(part, "text formula numbers value unit"))


def _comparison(comparison: Comparison) -> dict[str, Any]:
    asked, result = comparison.asked, comparison.result
    return {
        **_plain(asked, "key printed reason", units={"key": ascii_key}),
        "unit": asked.unit or result.unit,
        **_plain(result, "value"),
        **_plain(comparison, "agrees"),
    }


def _in_all_languages(text: Readable) -> dict[str, str]:
    return {lang: text.in_language(lang) for lang in LANGUAGES}


_plain = partial(plain, text=_in_all_languages)
