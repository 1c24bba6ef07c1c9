"""Exercises of the page: a task with its figure and its choices, answers marked with hints, its linkage to try."""

from __future__ import annotations

from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, Readable, error_in_language, message, translate
from gruebler.files import Exercise
from gruebler.mechanics.fourbar.four_bar_types import FOUR_BAR_TYPES
from gruebler.teaching.exercises import (
    KINDS,
    Mark,
    Result,
    Solution,
    SolutionStep,
    ascii_key,
    exercise,
    generate,
    grade,
    plain_name,
    solution_text,
    solve,
)
from gruebler.teaching.worksheets.exercise_figures import exercise_linkage
from gruebler.teaching.worksheets.tasks import exercise_figure

_COUNTED = {
    "n": message("Every link counts once, the frame too."),
    "g1": message("A joint of k links counts k - 1 times; sliding joints are counted as well."),
    "g2": message("Only joints that roll and slide have f = 2."),
}
_OTHERWISE = message("See the steps of the solution.")


def task_kinds(lang: str) -> list[dict[str, str]]:
    """The kinds of fresh tasks with their names."""
    return [{"kind": kind, "name": name.in_language(lang)} for kind, (name, _) in KINDS.items()]


def task_record(kind: str, level: int, seed: int, lang: str) -> dict[str, Any]:
    """A fresh task as plain data: its text, its figure, what is asked and between which words one chooses.

    >>> task = task_record("grashof", 1, 3, "en")
    >>> [(one["key"], len(one["choices"])) for one in task["asked"]], task["figure"][:4]
    ([('sum_ends', 0), ('sum_others', 0), ('turns', 2), ('type', 9)], '<svg')
    """
    task = generate(kind, seed, level)
    results = solve(task).results
    figure = exercise_figure(task, lang)
    return {
        "id": task.id,
        "name": task.name.in_language(lang),
        "task": task.task.in_language(lang),
        "figure": figure.svg(styled=False) if figure else "",
        "asked": [
            {
                "key": ascii_key(result.key),
                "name": result.name.in_language(lang),
                "symbol": result.symbol if isinstance(result.value, int | float) and not _is_choice(result) else "",
                "unit": result.unit,
                "choices": _choices(result, lang),
            }
            for question in task.asked
            for result in [results[question.key]]
            if plain_name(result)
        ],
    }


def _is_choice(result: Result) -> bool:
    return isinstance(result.value, bool | Readable)


def _choices(result: Result, lang: str) -> list[str]:
    """Yes and no, or the types of four-bars without equal links; none for a number."""
    if isinstance(result.value, bool):
        return [translate("yes", lang), translate("no", lang)]
    if not _is_choice(result):
        return []
    places = (place for place in FOUR_BAR_TYPES if place[0] in "<=>" and len(place[1]) <= 1)
    return [FOUR_BAR_TYPES[place].name(lang).partition(" (")[0] for place in places]


def marked_task(id: str, answers: dict[str, str], lang: str) -> dict[str, Any]:
    """The marks of the answers that were given, each wrong one with a hint, and the solution.

    >>> marked_task("dead-centre-1-7", {"H": "30", "l_a": "12"}, "en")["marks"][1]["hint"]
    'The formula is l_a = a + b.'
    """
    task = exercise(id)
    solution = solve(task)
    marks = [_mark(task, solution, key, given, lang) for key, given in answers.items() if given.strip()]
    return {"marks": marks, "solution": solution_text(task, solution, lang)}


def _mark(task: Exercise, solution: Solution, key: str, given: str, lang: str) -> dict[str, str]:
    try:
        graded = grade(task, {key: given})[0]
    except GrueblerError as error:
        return {"key": key, "mark": str(Mark.WRONG), "hint": error_in_language(error, lang)}
    hint = graded.hint or (way(solution, graded.result) if graded.mark is Mark.WRONG else None)
    return {"key": key, "mark": str(graded.mark), "hint": hint.in_language(lang) if hint else ""}


def way(solution: Solution, result: Result) -> Message:
    """What helps with a wrong answer that is no likely mistake: the formula without its numbers."""
    beginning = f"{result.symbol.rstrip('*')} = "
    steps = (part for part in solution.parts if isinstance(part, SolutionStep))
    formula = next((step.formula for step in steps if step.formula.startswith(beginning) and step.numbers), "")
    if formula:
        return message("The formula is {formula}.", formula=formula)
    return _COUNTED.get(result.key, _OTHERWISE)


def tried_task(id: str, lang: str) -> dict[str, Any]:
    """The linkage of a task as a model of the page; for a task about a chain its text.

    >>> tried_task("mobility-1-3", "en")["text"][:2], tried_task("grashof-2-3", "en")["model"]["links"][:2]
    ('R(', ['frame', 'crank'])
    """
    from gruebler.page.model import model_of

    task = exercise(id)
    if isinstance(chain := task.given.get("chain"), str):
        return {"text": chain}
    drawn = exercise_linkage(task)
    if drawn is None:
        raise GrueblerError("{id} has no linkage that moves", id=id)
    name = task.name.in_language(lang)
    return {"model": model_of(drawn.linkage, name=name, between=drawn.between), "drive": drawn.drive}
