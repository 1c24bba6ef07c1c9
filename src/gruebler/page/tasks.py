"""Exercises of the page: a task with its figure and its choices, answers marked with hints, its linkage to try."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, Readable, error_in_language, joined, joined_by_and, message, translate
from gruebler.files import Exercise
from gruebler.mechanics.fourbar.four_bar_types import FOUR_BAR_TYPES
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.shapes import TextShape
from gruebler.structure.chain import Chain
from gruebler.teaching.exercises import (
    KINDS,
    Mark,
    Result,
    Solution,
    SolutionStep,
    all_exercises,
    ascii_key,
    exercise,
    grade,
    plain_name,
    solve,
)
from gruebler.teaching.exercises.dyads import CHANGES
from gruebler.teaching.exercises.messages import cells_of_table, check_cells, named_answer, step_lines, with_capital
from gruebler.teaching.exercises.solution import Part, TeachingTable
from gruebler.teaching.worksheets.blocks import with_signs
from gruebler.teaching.worksheets.exercise_figures import exercise_linkages
from gruebler.teaching.worksheets.tasks import exercise_figure

_OF_THE_TEXT = "exercise"
_SIZE = 1.25  # pixels of the page to one of a figure, where there is room
_OTHERWISE = message("See the steps of the solution.")
_FIRST_STEPS = {
    "coupler_points.four_bar": message(
        "First A from the crank angle, then B where the circles about A and B0 meet; from A go u along A-B and v to "
        "its left."
    ),
    "straight_guides.double_rocker": message(
        "D follows from φ, A from the circles about D and the other pivot, C from both; the strip runs along the path "
        "of C."
    ),
}
"""What helps with methods whose answers have no formula of their own."""
_IN_STRUCTURE = message("Try it in Structure")
_IN_MOTION = message("Try it in Motion")


def task_kinds(lang: str) -> list[dict[str, Any]]:
    """The kinds of fresh tasks with their names, and the exercises of the text.

    >>> [(kind["kind"], len(kind["tasks"])) for kind in task_kinds("en")][-2:]
    [('differential', 0), ('exercise', 22)]
    """
    fresh = [{"kind": kind, "name": name.in_language(lang), "tasks": []} for kind, (name, _) in KINDS.items()]
    tasks = [
        {"id": task.id, "name": f"{task.id.partition('-')[2]}: {task.name.in_language(lang)}"}
        for task in all_exercises().values()
        if task.id.startswith(_OF_THE_TEXT)
    ]
    return [*fresh, {"kind": _OF_THE_TEXT, "name": translate("Numbered exercises", lang), "tasks": tasks}]


def task_record(id: str, lang: str) -> dict[str, Any]:
    """A task as plain data: its text, its figures, what is asked and between which words one chooses.

    >>> task = task_record("grashof-1-3", "en")
    >>> [(one["key"], len(one["choices"])) for one in task["asked"]], task["figures"][0]["picture"][:4]
    ([('sum_ends', 0), ('sum_others', 0), ('turns', 2), ('type', 9)], '<svg')
    """
    task = exercise(id)
    results = solve(task).results
    return {
        "id": task.id,
        "name": task.name.in_language(lang),
        "task": _prose(task.task.in_language(lang)),
        "remark": signed(task.remark.in_language(lang)) if task.remark else "",
        "figures": _figures(task, lang),
        "trial": f"{_IN_MOTION.in_language(lang)}:" if len(tries := _tries(task, lang)) > 1 else "",
        "tries": tries,
        "asked": [
            {
                "key": ascii_key(result.key),
                "name": signed(with_capital(result.name.in_language(lang))),
                "symbol": signed(result.symbol)
                if isinstance(result.value, int | float) and not _is_choice(result)
                else "",
                "unit": result.unit,
                "choices": _choices(result, lang),
            }
            for question in task.asked
            for result in [results[question.key]]
            if plain_name(result)
        ],
    }


def signed(text: str) -> str:
    r"""A text with its signs; pivots, points and sums have their number as an index, which ends before the next point.

    >>> signed("s1 = 5, K1_x of ring_gear"), signed("n_1 + n_2 = 2"), [*signed("A-B0")]
    ('s_1 = 5, K_1x of ring gear', 'n_1\xa0+ n_2 = 2', ['A', '-', '\u2060', 'B', '_', '0'])
    """
    text = re.sub(r"(?<=[a-z]{3})_(?=[a-z]{3})", " ", with_signs(text).replace("₀", "0"))
    text = re.sub(r"(?:(?<=\b[A-D])|(?<=\b[A-D]0))(-?)(?=[A-D]0?\b)", "\\1\u2060", text)
    text = re.sub(r"(?<!= )(\b\w_\w|(?<= )\w) (?=[+−] (?:\w_\w =|\w/\d))", "\\1\u00a0", text)
    text = re.sub(r"\b([A-Z]\()(?=[^()]*[^\W\d_])([^()]*-[^()]*)\)", _unbroken_joint, text)  # D(Gestell-Hohlrad)
    text = re.sub(r"(?<=\bK\d) (?=\()", "\u00a0", text)  # K1 (45, 0)
    text = re.sub(r"(\([^() ]+[,;]) (?=[^() ]+\))", "\\1\u00a0", text)  # (45, 0)
    text = re.sub(r"\b([AB](?=0)|s(?=[12]\b)|K(?=\d))(\d)_?(?!\d|[.,]\d)", r"\1_\2", text)
    return re.sub(r"\b(sin|cos|tan) (?=\w)", "\\1\u00a0", text)


def _prose(text: str) -> str:
    r"""The same in a sentence, which does not break within a short sum.

    >>> _prose("so d + b ≤ a + c")
    'so d\xa0+ b ≤ a\xa0+ c'
    """
    return re.sub(r"(?<=\b[a-z]) (?=[+−] [a-z]\b)", "\u00a0", signed(text))


def _unbroken_joint(match: re.Match[str]) -> str:
    kept = match[2].replace("-", "-\u2060").replace(" ", "\u00a0")
    return f"{match[1]}{kept})"


def _chain_of(task: Exercise) -> str:
    """The text of the chain that a task is about; empty where it is about linkages."""
    chain = task.given.get("chain")
    return chain if isinstance(chain, str) else ""


def _tries(task: Exercise, lang: str) -> list[str]:
    """What is written on the buttons that open what can be tried; tasks in space have none.

    >>> _tries(exercise("mobility-1-3"), "en"), _tries(exercise("exercise-5"), "en")[0]
    (['Try it in Structure'], 'Garage door without rail')
    """
    if _chain_of(task):
        return [_IN_STRUCTURE.in_language(lang)]
    return [(drawn.name or _IN_MOTION).in_language(lang) for drawn in exercise_linkages(task)]


def _figures(task: Exercise, lang: str) -> list[dict[str, str]]:
    """The pictures of a task, each with its name where there are several."""
    linkages = exercise_linkages(task)
    if not linkages:
        figure = exercise_figure(task, lang, named=True)
        return [] if figure is None else [{"name": "", "picture": _picture(figure, figure.width)}]
    drawings = [drawn.figure(lang) for drawn in linkages]
    widest = max(figure.width for figure in drawings)
    figures = []
    for drawn, figure in zip(linkages, drawings, strict=True):
        shapes = figure.shapes
        if drawn.source:  # small, and no task speaks of the points of a machine
            shapes = tuple(each for each in shapes if not isinstance(each, TextShape))
        name = drawn.name.in_language(lang) if drawn.name else ""
        figures.append({"name": name, "picture": _picture(replace(figure, shapes=shapes), widest)})
    return figures


def _picture(figure: Figure, width: float) -> str:
    """The SVG of a figure in the middle of this width, in the size in which all tasks have the same strokes."""
    size = f'width="{_SIZE * width:g}" height="{_SIZE * figure.height:g}"'
    box = f'viewBox="{(figure.width - width) / 2:g} 0 {width:g} {figure.height:g}"'
    return re.sub(r'width="\S+" height="\S+" viewBox=".*?"', f"{size} {box}", figure.svg(styled=False), count=1)


def _is_choice(result: Result) -> bool:
    return isinstance(result.value, bool | Readable)


def _choices(result: Result, lang: str) -> list[str]:
    """Yes and no, the changes of F, or the types of four-bars without equal links; none for a number."""
    if isinstance(result.value, bool):
        return [translate("yes", lang), translate("no", lang)]
    if not _is_choice(result):
        return []
    if result.key == "change":
        return [change.in_language(lang) for change in CHANGES.values()]
    places = (place for place in FOUR_BAR_TYPES if place[0] in "<=>" and len(place[1]) <= 1)
    return [_short(FOUR_BAR_TYPES[place].name(lang)) for place in places]


def _short(name: str) -> str:
    """The name of a type without what explains it."""
    return name.partition(" (")[0]


def marked_task(id: str, answers: dict[str, str], lang: str) -> dict[str, Any]:
    """The marks of the answers that were given, each wrong one with a hint, and the solution.

    >>> marked_task("dead-centre-1-7", {"H": "30", "l_a": "12"}, "en")["marks"][1]["hint"]
    'The formula is l_a = a + b.'
    >>> marked_task("mobility-1-3", {"F": "7"}, "en")["marks"][0]["hint"]
    'Check n, g_1 and g_2 first, then put them into F = 3(n − 1) − 2 g_1 − g_2.'
    """
    task = exercise(id)
    solution = solve(task)
    marks = [_mark(task, solution, key, given, lang) for key, given in answers.items() if given.strip()]
    return {"marks": marks, "solution": solution_parts(task, solution, lang)}


def solution_parts(task: Exercise, solution: Solution, lang: str) -> list[dict[str, Any]]:
    """The solution as parts that are set one below the other: headings, steps with formulas, tables, results, checks.

    >>> task = exercise("dead-centre-1-7")
    >>> for part in solution_parts(task, solve(task), "en")[:2]:
    ...     print(part["text"], "|", part["formula"])
    1. Outer dead centre, crank and coupler stretched | l_a = a + b = 30 + 100 = 130 mm
    2. Inner dead centre, crank and coupler overlapping | l_i = b − a = 100 − 30 = 70 mm
    """

    def part(text: str, formula: str = "", *, heading: bool = False, rows: Sequence[list[str]] = ()) -> dict[str, Any]:
        line = re.sub(r"\b(sin|cos|tan) \(", r"\1(", signed(chosen(formula.strip()))).replace(")/(", ")\u200b/(")
        cells = [[signed(chosen(cell)).replace(" = ", "\u00a0=\u00a0") for cell in row] for row in rows]
        return {"text": _prose(text.strip()), "formula": line, "heading": heading, "rows": cells}

    def chosen(text: str) -> str:
        """A type as among the choices."""
        return _short(text) if text in names else text

    names = [each.value.in_language(lang) for each in solution.results.values() if isinstance(each.value, Readable)]
    parts = []
    count = 0
    wanted = _as_asked(task, solution)
    for each in wanted.parts:
        if isinstance(each, TeachingTable):
            head, *rows = cells_of_table(each, lang)
            columns = [k for k in range(len(head)) if any(row[k] for row in rows)]  # chains may all have no name
            parts.append(part(each.title.in_language(lang), rows=[[row[k] for k in columns] for row in (head, *rows)]))
        elif isinstance(each, SolutionStep):
            count += 1
            parts.append(part(*step_lines(each, count, lang)))
        else:
            count = 0
            parts.append(part(each.text.in_language(lang), heading=True))
    if task.asked:
        answers = [named_answer(solution.results[question.key], lang) for question in task.asked]
        parts += [part(translate("Results:", lang), heading=True), part("", rows=[[], *map(list, answers)])]
    if wanted.checks:
        rows = [[], *map(list, dict.fromkeys(check_cells(check, lang) for check in wanted.checks))]
        parts += [part(translate("Check by a second method:", lang), heading=True), part("", rows=rows)]
    return parts


def _as_asked(task: Exercise, solution: Solution) -> Solution:
    """The solution without what is calculated behind the last step that is asked for, and without the checks of that.

    Exercises of the text keep it: it stands there.

    >>> task = exercise("velocity-1-5")  # without accelerations
    >>> [step.formula.partition(" = ")[0] for step in _as_asked(task, solve(task)).parts]
    ['β', 'v_A', 'ω_b', 'v_B']
    """
    asked = [solution.results[question.key].value for question in task.asked]
    wanted = [k for k, part in enumerate(solution.parts) if isinstance(part, SolutionStep) and part.value in asked]
    if not wanted or task.id.startswith(_OF_THE_TEXT):
        return solution
    more = {k: part for k, part in enumerate(solution.parts) if k > wanted[-1] and _is_calculated(part)}
    values = [part.value for part in more.values() if isinstance(part, SolutionStep)]
    parts = tuple(part for k, part in enumerate(solution.parts) if k not in more)
    return replace(solution, parts=parts, checks=tuple(each for each in solution.checks if each.first not in values))


def _is_calculated(part: Part) -> bool:
    return isinstance(part, SolutionStep) and bool(part.numbers)


def _mark(task: Exercise, solution: Solution, key: str, given: str, lang: str) -> dict[str, str]:
    try:
        graded = grade(task, {key: given})[0]
    except GrueblerError as error:
        said = error_in_language(error, lang)
        return {"key": key, "mark": str(Mark.WRONG), "hint": signed(said[:1].upper() + said[1:])}
    hint = graded.hint or (way(task, solution, graded.result) if graded.mark is Mark.WRONG else None)
    return {"key": key, "mark": str(graded.mark), "hint": signed(hint.in_language(lang)) if hint else ""}


def way(task: Exercise, solution: Solution, result: Result) -> Message:
    """What helps with a wrong answer that is no likely mistake: the formula, what is put into it, or what is counted.

    >>> task = exercise("mobility-1-3")  # a four-bar: R(2-3) R(3-4) R(4-1) R(1-2)
    >>> way(task, solve(task), solve(task).results["g1"]).in_language("en")
    'Each joint that joins two links counts once.'
    >>> task = exercise("transmission-angle-3-1")  # in frame position II the angle is obtuse
    >>> said = way(task, solve(task), solve(task).results["μ_II*"]).in_language("en")
    >>> said[said.index("),") :]
    '), μ_II* = 180° - μ_II. μ_II: angle between coupler and rocker, frame position II.'
    """
    steps = [part.formula for part in solution.parts if isinstance(part, SolutionStep) and part.numbers]
    symbols = dict.fromkeys([result.symbol.rstrip("*"), result.symbol])  # μ_I, of which μ_I* is the acute angle
    formulas = (next((step for step in steps if step.startswith(f"{symbol} = ")), "") for symbol in symbols)
    formula = ", ".join(filter(None, formulas))
    if formula:
        indexed = re.sub(r"\b([^\W\d_])(\d+)\b", r"\1_\2", formula)
        counts = _put_in(task, solution, result, formula)
        if any("=" in count for count in counts):
            return message("Put {counts} into {formula}.", counts=joined_by_and(counts), formula=indexed)
        if counts:
            counted = joined_by_and(counts)
            return message("Check {counts} first, then put them into {formula}.", counts=counted, formula=indexed)
        if named := _named_in(task, solution, result, formula):
            return message("The formula is {formula}. {quantities}.", formula=indexed, quantities=joined(named, "; "))
        return message("The formula is {formula}.", formula=indexed)
    return _counted(task).get(result.key) or _FIRST_STEPS.get(task.method or "", _OTHERWISE)


def _named_in(task: Exercise, solution: Solution, result: Result, formula: str) -> list[Message]:
    """What quantities of a formula are that are found on the way and neither given nor asked for.

    >>> task = exercise("dead-centre-2-7")
    >>> print(*_named_in(task, solve(task), solve(task).results["H"], "H = l_a - l_i"), sep="; ")
    l_a: outer dead centre, crank and coupler stretched; l_i: inner dead centre, crank and coupler overlapping
    """
    said = {result.key, *(question.key for question in task.asked)}
    symbols = set(re.findall(r"[^\W\d][^\W²³]*[*']*", formula.partition(" = ")[2]))
    return [
        message("{symbol}: {name}", symbol=each.symbol, name=each.name)
        for key, each in solution.results.items()
        if each.symbol in symbols and key not in said
    ]


def _put_in(task: Exercise, solution: Solution, result: Result, formula: str) -> list[str]:
    """What is put into the formula of a mobility, with its numbers where the task does not ask for them.

    >>> task = exercise("dyad-1-7")  # a chain of five links and five joints
    >>> result = solve(task).results["F_after"]
    >>> _put_in(task, solve(task), result, "F' = 3(n - 1) - 2 g1")
    ['n = 5 + 2', 'g_1 = 5 + 3']
    """
    key, dot, machine = result.key.partition(".")
    if key not in ("F", "F_before", "F_after"):
        return []
    symbols = [symbol for symbol in ("n", "g1", "g2") if re.search(rf"\b{symbol}\b", formula)]
    names = [symbol.replace("g", "g_") for symbol in symbols]
    numbers = [solution.results[f"{symbol}{dot}{machine}"].value for symbol in symbols]
    if key != "F":
        start = Chain.parse(_chain_of(task))
        before = {"n": start.n} | {f"g{f}": number for f, number in start.joints_by_freedom.items()}
        numbers = [f"{before[symbol]} + {solution.number(symbol) - before[symbol]:g}" for symbol in symbols]
        numbers = numbers if key == "F_after" else [before[symbol] for symbol in symbols]
    elif {question.key for question in task.asked} & {*symbols}:
        return names
    return [f"{name} = {number}" for name, number in zip(names, numbers, strict=True)]


def _counted(task: Exercise) -> dict[str, Message]:
    """What helps to count; of the joints only what the chain of the task has, if it has one."""
    text = _chain_of(task)
    joints = Chain.parse(text, space=str(task.given.get("space", "planar"))).joints if text else ()
    several = not text or any(len(joint.links) > 2 for joint in joints)
    sliding = not text or any(joint.pair.is_sliding for joint in joints)
    counts = [
        message("A joint of k links counts k - 1 times." if several else "Each joint that joins two links counts once.")
    ]
    freedom = message(
        "Joints that only turn or only slide have f = 1." if sliding else "Joints that only turn have f = 1."
    )
    if not text or any(joint.pair.is_higher for joint in joints):
        freedom = message("Only joints that roll and slide have f = 2.")
    if sliding:
        counts.append(message("Sliding joints are counted as well."))
    return {
        "n": message("Every link counts once, the frame too."),
        "g1": joined(counts, " "),
        "g2": freedom,
        "chains": message("Places that are alike up to the names of the links give the same chain: they count once."),
    }


def tried_task(id: str) -> list[dict[str, Any]]:
    """The linkages of a task, one for each figure, as models of the page; for a task about a chain its text.

    >>> tried_task("mobility-1-3")[0]["text"][:2], tried_task("grashof-2-3")[0]["model"]["links"][:2]
    ('R(', ['frame', 'crank'])
    """
    from gruebler.page.model import model_of

    task = exercise(id)
    if chain := _chain_of(task):
        return [{"text": chain}]
    return [
        {
            "model": model_of(drawn.linkage, name=drawn.name or task.name, source=drawn.source, between=drawn.between),
            "drive": drawn.drive,
        }
        for drawn in exercise_linkages(task)
    ]
