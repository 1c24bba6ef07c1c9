"""`gruebler exercise`: tasks listed, shown, solved, made and marked."""

from __future__ import annotations

import argparse

from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
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

__all__ = ["add", "run"]

_HEADERS = (message("id"), message("name"), message("source"))
_MARKS = {
    Mark.RIGHT: message("right"),
    Mark.NEAR: message("nearly right"),
    Mark.WRONG: message("wrong"),
}
_MOST = 1000


_KINDS = ("mobility", "grashof", "dead-centre", "transmission-angle", "dyad", "velocity")


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Exercises and worked examples, solved step by step and compared with what is printed; fresh "
        "tasks from the enumeration and random dimensions.",
        epilog="Example: gruebler exercise solve 15 --lang de; gruebler exercise new --kind mobility --level 2 "
        "--seed 7; gruebler exercise check mobility-2-7 n=8 F=1. Exit status: 0 all well, 1 an answer is wrong, 2 "
        "wrong usage.",
    )
    listing = parser.add_command("list", help="all exercises and worked examples")
    show = parser.add_command("show", help="the task alone")
    solve = parser.add_command("solve", help="the way to the answer, step by step, with a check by a second way")
    for action in (show, solve):
        action.add_argument(
            "ids", nargs="+", metavar="ID", help="such as 15, exercise-15 or grashof-1-7 (a fresh task)"
        )
    new = parser.add_command("new", help="fresh tasks; the same seed gives the same task")
    new.add_argument("--kind", choices=_KINDS, required=True, help="the theory")
    new.add_argument("--level", type=int, choices=(1, 2, 3), default=1, help="1 easy to 3 (default: 1)")
    new.add_argument("--seed", type=int, default=0, metavar="S", help="of the first task (default: 0)")
    new.add_argument("--count", type=int, default=1, metavar="K", help="so many, with seeds S, S + 1, ... (default: 1)")
    new.add_argument("--solutions", action="store_true", help="with their solutions")
    check = parser.add_command("check", help="mark answers, with a hint on the likely mistake")
    check.add_argument("id", metavar="ID")
    check.add_argument("answers", nargs="+", metavar="KEY=ANSWER", help="such as H=40 phi_max=189,4 turns=yes")
    for action in (listing, show, solve, new, check):
        action.add_argument("--json", action="store_true", help="as JSON, both languages")


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
