"""Exercises of the static site: tasks with all that their marks need, so that a page marks them by itself.

Words are marked beforehand, each choice with its hint; for numbers the page has the right value, those of the likely
mistakes and the units, and applies the tolerances of `gruebler.teaching.exercises.grade`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gruebler.base.text import Readable
from gruebler.files import Exercise
from gruebler.page.site_structures import structure_pack
from gruebler.page.structures import mechanism_of_text
from gruebler.page.tasks import marked_task, solution_parts, task_record, tried_task, way
from gruebler.teaching.exercises import Result, ascii_key, exercise, solve
from gruebler.teaching.exercises.answers import units_for
from gruebler.teaching.exercises.grading import FINE, NEARLY, NEARLY_RIGHT, common_mistakes
from gruebler.teaching.exercises.solution import Value
from gruebler.teaching.worksheets.blocks import with_signs

TOLERANCES = {"fine": FINE, "nearly": NEARLY}
"""Relative differences of right and of nearly right answers."""


def task_pack(id: str, langs: Sequence[str]) -> dict[str, Any]:
    """A task, its solution, what is right and what is wrong in which way, and its linkages or its chain to try.

    >>> answers = task_pack("grashof-1-3", ["en"])["answers"]
    >>> answers["turns"]["en"]["no"]["mark"], answers["sum_ends"]["value"]
    ('wrong', 110.0)
    """
    task = exercise(id)
    solution = solve(task)
    records = {lang: task_record(id, lang) for lang in langs}
    answers = {}
    for question in task.asked:
        result = solution.results[question.key]
        key = ascii_key(result.key)
        choices = {
            lang: next(row["choices"] for row in record["asked"] if row["key"] == key)
            for lang, record in records.items()
        }
        if any(choices.values()):
            answers[key] = {lang: _marked_words(task, key, words, lang) for lang, words in choices.items()}
        else:
            known = [(m.value, m.hint) for m in solution.mistakes if m.key == result.key]
            answers[key] = _number_record(result, known, langs) | {"way": _said(way(task, solution, result), langs)}
    tried = tried_task(id)
    chains = [structure_pack(mechanism_of_text(each["text"]), langs) for each in tried if "text" in each]
    if chains:
        tried = [{"text": pack["text"]} for pack in chains]
    return {
        "records": records,
        "solutions": {lang: solution_parts(task, solution, lang) for lang in langs},
        "answers": answers,
        "try": tried,
        "structures": chains,
    }


def _marked_words(task: Exercise, key: str, words: Sequence[str], lang: str) -> dict[str, Any]:
    return {word: marked_task(task.id, {key: word}, lang)["marks"][0] for word in words}


def _number_record(result: Result, known: Sequence[tuple[Value, Readable]], langs: Sequence[str]) -> dict[str, Any]:
    """The right value, the units in which it may be given, and the values of mistakes with their hints."""
    return {
        "value": result.value,
        "whole": isinstance(result.value, int),
        "unit": result.unit,
        "units": units_for(result.unit),
        "mistakes": [[value, _said(hint, langs)] for value, hint in known],
        "common": [[m.value, _said(m.hint, langs)] for m in common_mistakes(result)],
        "near": _said(NEARLY_RIGHT, langs),
    }


def _said(text: Readable, langs: Sequence[str]) -> dict[str, str]:
    return {lang: with_signs(text.in_language(lang)) for lang in langs}
