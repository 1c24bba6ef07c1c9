"""`gruebler exercise`: tasks listed, shown, solved, made and marked."""

from __future__ import annotations

import argparse

from gruebler.cli.output import print_json
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.exercises import (
    Grade,
    Mark,
    all_exercises,
    ascii_key,
    exercise,
    generate,
    grade,
    grades_as_list,
    plain_name,
    solution_as_dict,
    solution_text,
    solve,
    source_text,
    task_as_dict,
    task_text,
    value_text,
)
from gruebler.formats import Exercise
from gruebler.text import message, translate

__all__ = ["run"]

_HEADERS = (message("id"), message("name"), message("source"))
_MARKS = {
    Mark.RIGHT: message("right"),
    Mark.NEAR: message("nearly right"),
    Mark.WRONG: message("wrong"),
}
_MOST = 1000


def run(arguments: argparse.Namespace) -> int:
    """List, show, solve, make or mark; 1 if an answer is wrong."""
    match arguments.action:
        case "list":
            _list(arguments)
        case "show":
            _tell([exercise(id) for id in arguments.ids], arguments, solved=False)
        case "solve":
            _tell([exercise(id) for id in arguments.ids], arguments, solved=True)
        case "new":
            if not 1 <= arguments.count <= _MOST:
                raise GrueblerError(
                    "--count is a number from 1 to {most}, not {count}", most=_MOST, count=arguments.count
                )
            seeds = range(arguments.seed, arguments.seed + arguments.count)
            exercises = [generate(arguments.kind, seed, arguments.level) for seed in seeds]
            _tell(exercises, arguments, solved=arguments.solutions)
        case "check":
            return _mark(exercise(arguments.id), arguments)
    return 0


def _list(arguments: argparse.Namespace) -> None:
    found = all_exercises().values()
    if arguments.json:
        print_json([task_as_dict(one) for one in found])
        return
    lang = arguments.lang
    print_table(
        [header.in_language(lang) for header in _HEADERS],
        [(one.id, one.name.in_language(lang), source_text(one.source, lang)) for one in found],
    )


def _tell(found: list[Exercise], arguments: argparse.Namespace, *, solved: bool) -> None:
    if arguments.json:
        print_json([solution_as_dict(one, solve(one)) if solved else task_as_dict(one) for one in found])
        return
    texts = [
        solution_text(one, solve(one), arguments.lang) if solved else task_text(one, arguments.lang, solve(one))
        for one in found
    ]
    print("\n\n".join(texts))


def _mark(task: Exercise, arguments: argparse.Namespace) -> int:
    answers: dict[str, str] = {}
    for word in arguments.answers:
        key, equals, answer = word.partition("=")
        if not equals or not key.strip() or not answer.strip():
            raise GrueblerError("an answer is written KEY=ANSWER, such as H=40, not {word!r}", word=word)
        if key.strip() in answers:
            raise GrueblerError("{word} is answered twice: give one answer for each", word=key.strip())
        answers[key.strip()] = answer
    marks = grade(task, answers)
    right = all(one.mark is Mark.RIGHT for one in marks)
    if arguments.json:
        print_json({"id": task.id, "right": right, "answers": grades_as_list(marks)})
    else:
        _say(task, marks, arguments.lang)
    return 0 if right else 1


def _say(task: Exercise, marks: list[Grade], lang: str) -> None:
    for one in marks:
        line = f"{ascii_key(one.key)} = {one.answer}: {_MARKS[one.mark].in_language(lang)}"
        if one.mark is Mark.RIGHT:
            line += f" ({value_text(one.result.value, one.result.unit, lang)})"
        print(line + (f". {one.hint.in_language(lang)}" if one.hint else ""))
    answered = {one.key for one in marks}
    results = solve(task).results
    missing = [plain_name(results[asked.key]) for asked in task.asked if asked.key not in answered]
    if missing:
        print(translate("Not answered: {results}", lang, results=", ".join(missing)))
    right = sum(one.mark is Mark.RIGHT for one in marks)
    print(translate("{right} of {all} answers right.", lang, right=right, all=len(marks)))
