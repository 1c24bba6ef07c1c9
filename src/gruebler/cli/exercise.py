"""`gruebler exercise`: list, show, solve and generate tasks, and mark answers."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message, translate
from gruebler.cli.output import print_json, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.files import Exercise
from gruebler.files.catalog_records import source_text
from gruebler.teaching.exercises import (
    Grade,
    Mark,
    all_exercises,
    exercise,
    faults,
    generate,
    grade,
    grades_as_list,
    plain_name,
    solution_as_dict,
    solution_text,
    solve,
    task_as_dict,
    task_text,
    value_text,
    with_values,
)

_MARKS = {Mark.RIGHT: message("right"), Mark.NEAR: message("nearly right"), Mark.WRONG: message("wrong")}
_MOST = 1000


_DOCUMENTS = (".pdf", ".html", ".tex", ".md")
_KINDS = (
    "mobility",
    "grashof",
    "dead-centre",
    "transmission-angle",
    "dyad",
    "velocity",
    "universal-joint",
    "spherical-grashof",
    "differential",
)


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Exercises and worked examples, solved step by step and compared with the printed answers; "
        "generated tasks with structures of the enumeration and random dimensions.",
        epilog="Examples: gruebler exercise solve 15 --set a=40 --set b=120; gruebler exercise new --kind mobility "
        "--level 2 --seed 7; gruebler exercise check mobility-2-7 n=8 F=1. Exit status: 0 success, 1 an answer is "
        "wrong, or a solution differs unexplained from the printed answer, 2 wrong usage.",
    )
    listing = parser.add_command("list", help="list all exercises and worked examples")
    show = parser.add_command("show", help="show a task without its solution")
    solve = parser.add_command("solve", help="solve a task step by step, checked by a second method")
    for action in (show, solve):
        action.take(
            """
            ids ID +  such as 15, exercise-15 or grashof-1-7 (a generated task)
            --set KEY=VALUE ...  another value of a given quantity, such as a=40 (repeatable)
            """
        )
    new = parser.add_command("new", help="generate tasks; the same seed gives the same task")
    new.add_argument("--kind", choices=_KINDS, required=True, help="topic of the task")
    check = parser.add_command("check", help="mark answers, with hints at likely mistakes")
    check.take(
        """
        id ID  such as 15, exercise-15 or grashof-1-7 (a generated task)
        answers KEY=ANSWER +  such as H=40 phi_max=189.4 turns=yes
        """
    )
    sheet = parser.add_command(
        "sheet",
        help="write a sheet of generated tasks with figures, and a second file with solutions and marking key",
        description="Generated tasks with figures and space for answers; beside FILE a second one, FILE-solutions, "
        "with the solutions, constructions and a marking key.",
        epilog="Example: gruebler exercise sheet --kind mobility,grashof,dead-centre --count 6 --level 2 --seed 7 "
        "--lang de -o sheet.pdf. PDF needs matplotlib: pip install 'gruebler[plot]'.",
    )
    sheet.take("--kind KIND,... !  topics that take turns, as those of `exercise new`")
    for action in (new, sheet):
        action.take(
            """
            --level int {1,2,3} =1  from 1 (easy) to 3 (default: 1)
            --seed S int =0  seed of the first task (default: 0)
            """
        )
    new.take(
        """
        --count K int =1  number of tasks, with seeds S, S + 1, ... (default: 1)
        --solutions  with solutions
        """
    )
    sheet.take(
        """
        --count K int =6  number of tasks (default: 6)
        --heading TEXT =  heading of the sheet, such as that of the course
        --logo FILE path  a PNG picture in the head of every page
        """
    )
    sheet.add_out(
        help="the sheet: .pdf, .html, .tex or .md; or questions for Moodle with answers and tolerances: .xml, or .gift",
        required=True,
        endings=("pdf", "html", "tex", "md", "xml", "gift"),
    )
    for action in (listing, show, new, check):
        action.add_printed(help="print JSON, with texts in both languages")
    solve.add_json(help="print JSON, with texts in both languages")
    solve.add_out(
        help="write into a file instead: with figures .pdf, .html, .tex or .md; as text .txt, or .json as with --json"
    )
    solve.set_defaults(written=_DOCUMENTS)


def run(arguments: argparse.Namespace) -> int:
    """List, show, solve, make or mark; 1 if an answer is wrong or a solution does not agree with what is printed."""
    match arguments.action:
        case "list":
            _list(arguments)
        case "show":
            _print([_task(id, arguments) for id in arguments.ids], arguments, solved=False)
        case "solve":
            return _solve([_task(id, arguments) for id in arguments.ids], arguments)
        case "new":
            if not 1 <= arguments.count <= _MOST:
                raise GrueblerError(
                    "--count is a number from 1 to {most}, not {count}", most=_MOST, count=arguments.count
                )
            seeds = range(arguments.seed, arguments.seed + arguments.count)
            exercises = [generate(arguments.kind, seed, arguments.level) for seed in seeds]
            _print(exercises, arguments, solved=arguments.solutions)
        case "sheet":
            _sheet(arguments)
        case "check":
            return _mark(exercise(arguments.id), arguments)
    return 0


def _task(id: str, arguments: argparse.Namespace) -> Exercise:
    """An exercise, with own values of its given quantities."""
    values = _pairs(arguments.set, message("expected a value KEY=VALUE such as a=40, but found {word!r}"))
    return with_values(exercise(id), values) if values else exercise(id)


def _pairs(words: Sequence[str], problem: Message) -> dict[str, str]:
    """The values of words KEY=VALUE; `GrueblerError` for any other word, and for a key that comes twice."""
    values: dict[str, str] = {}
    for word in words:
        key, equals, value = (part.strip() for part in word.partition("="))
        if not equals or not key or not value:
            raise GrueblerError("{problem}", problem=problem.filled(word=word))
        if key in values:
            raise GrueblerError("{key} is given twice; give one value for each key", key=key)
        values[key] = value
    return values


def _solve(tasks: list[Exercise], arguments: argparse.Namespace) -> int:
    """Print the solutions, or write them with figures; 1 and a sentence for each answer that is not right."""
    suffix = "" if arguments.out is None else arguments.out.suffix.lower()
    if suffix in _DOCUMENTS:
        from gruebler.teaching.worksheets import document_bytes, solution_document

        content = document_bytes(solution_document(tasks, lang=arguments.lang), suffix.removeprefix("."))
        write_file(arguments.out, content, arguments.lang)
    else:
        _print(tasks, arguments, solved=True)
    sentences = [fault for task in tasks for fault in faults(task, solve(task))]
    for sentence in sentences:
        print(f"gruebler exercise: {sentence.in_language(arguments.lang)}", file=sys.stderr)
    return int(bool(sentences))


def _sheet(arguments: argparse.Namespace) -> None:
    """Write the sheet and its solutions."""
    from gruebler.teaching.worksheets import document_bytes, worksheet

    kinds = [word.strip() for word in arguments.kind.split(",") if word.strip()]
    sheet = worksheet(
        kinds,
        arguments.count,
        level=arguments.level,
        seed=arguments.seed,
        lang=arguments.lang,
        heading=arguments.heading,
        logo=arguments.logo,
    )
    path = arguments.out
    suffix = path.suffix.lower().removeprefix(".")
    if suffix in ("xml", "gift"):
        write_file(path, sheet.moodle() if suffix == "xml" else sheet.gift(), arguments.lang)
        return
    beside = path.with_name(f"{path.stem}-{translate('solutions', arguments.lang)}{path.suffix}")
    write_file(path, document_bytes(sheet.tasks, suffix), arguments.lang)
    write_file(beside, document_bytes(sheet.solutions, suffix), arguments.lang)


def _list(arguments: argparse.Namespace) -> None:
    tasks = all_exercises().values()
    if arguments.json:
        print_json([task_as_dict(task) for task in tasks])
        return
    lang = arguments.lang
    headers = [translate("id", lang), translate("name", lang), translate("source", lang)]
    print_table(headers, [(task.id, task.name.in_language(lang), source_text(task.source, lang)) for task in tasks])


def _print(tasks: list[Exercise], arguments: argparse.Namespace, *, solved: bool) -> None:
    if arguments.json:
        print_json([solution_as_dict(task, solve(task)) if solved else task_as_dict(task) for task in tasks])
        return
    texts = [
        solution_text(task, solve(task), arguments.lang) if solved else task_text(task, arguments.lang, solve(task))
        for task in tasks
    ]
    print("\n\n".join(texts))


def _mark(task: Exercise, arguments: argparse.Namespace) -> int:
    answers = _pairs(arguments.answers, message("expected an answer KEY=ANSWER such as H=40, but found {word!r}"))
    marks = grade(task, answers)
    right = all(each.mark is Mark.RIGHT for each in marks)
    if arguments.json:
        print_json({"id": task.id, "right": right, "answers": grades_as_list(marks)})
    else:
        _print_marks(task, marks, arguments.lang)
    return 0 if right else 1


def _print_marks(task: Exercise, marks: list[Grade], lang: str) -> None:
    for each in marks:
        line = f"{each.name} = {each.answer}: {_MARKS[each.mark].in_language(lang)}"
        if each.mark is Mark.RIGHT:
            line += f" ({value_text(each.result.value, each.result.unit, lang)})"
        print(line + (f". {each.hint.in_language(lang)}" if each.hint else ""))
    answered = {each.key for each in marks}
    results = solve(task).results
    missing = [plain_name(results[asked.key]) for asked in task.asked if asked.key not in answered]
    if missing:
        print(translate("Not answered: {keys}", lang, keys=", ".join(missing)))
    right = sum(each.mark is Mark.RIGHT for each in marks)
    print(translate("{right} of {count} answers right.", lang, right=right, count=len(marks)))
