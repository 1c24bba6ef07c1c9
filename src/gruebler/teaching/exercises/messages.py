"""Exercises and solutions as texts, with the decimal sign of the language."""

from __future__ import annotations

import re
from functools import partial

from gruebler.base.text import Message, Readable, decimal_sign_in, in_every_language, message, number, translate
from gruebler.files import Exercise
from gruebler.files.catalog_records import source_text
from gruebler.teaching.exercises.grading import ascii_key
from gruebler.teaching.exercises.solution import (
    Check,
    PartHeading,
    Result,
    Solution,
    SolutionStep,
    TeachingTable,
    Value,
    figure,
)
from gruebler.teaching.exercises.solving import Comparison, compare

_INDENT = "     "


def value_text(value: Value, unit: str, lang: str) -> str:
    """A value with its unit.

    >>> value_text(78.46304096718453, "°", "de"), value_text(True, "", "de")
    ('78,463°', 'ja')
    """
    if isinstance(value, bool):
        return translate("yes" if value else "no", lang)
    if isinstance(value, Readable):
        return value.in_language(lang)
    if isinstance(value, str):
        return value
    return figure(value).in_language(lang) + (unit if unit in ("", "°") else f" {unit}")


def task_text(exercise: Exercise, lang: str = "en", solution: Solution | None = None) -> str:
    """Title, source and task; with a solution also the names of the results."""
    title = f"{exercise.name.in_language(lang)} ({exercise.id})"
    lines = [title, "-" * len(title)]
    if exercise.source:
        lines.append(translate("Source: {source}", lang, source=source_text(exercise.source, lang)))
    lines.append(translate("Task: {task}", lang, task=exercise.task))
    if solution is not None and exercise.asked:
        results = [solution.results[question.key] for question in exercise.asked]
        lines.append(translate("Asked:", lang))
        lines += [f"  {ascii_key(result.key)}: {asked_text(result, lang)}" for result in results]
    if exercise.remark is not None:
        lines.append(translate("Remark: {remark}", lang, remark=exercise.remark))
    return "\n".join(lines)


def asked_text(result: Result, lang: str) -> str:
    """The name of a result and its unit."""
    if not _is_number(result.value):
        return result.name.in_language(lang)
    if result.unit:
        return translate("{quantity} (in {unit})", lang, quantity=result.name, unit=result.unit)
    return translate("{quantity} (a number)", lang, quantity=result.name)


def solution_text(exercise: Exercise, solution: Solution, lang: str = "en") -> str:
    """The complete solution: task, steps, tables, results with the printed answers, checks."""
    lines = [task_text(exercise, lang), "", translate("Solution:", lang)]
    count = 0
    for part in solution.parts:
        if isinstance(part, PartHeading):
            count = 0
            lines += ["", f"  {part.text.in_language(lang)}"]
        elif isinstance(part, TeachingTable):
            lines += ["", *(_INDENT + line for line in lines_of_table(part, lang)), ""]
        else:
            count += 1
            lines += step_lines(part, count, lang)
    answers = answer_lines(exercise, solution, lang)
    if answers:
        lines += ["", translate("Results:", lang), *(f"  {line}" for line in answers)]
    if solution.checks:
        checks = (f"  {check_text(check, lang)}" for check in solution.checks)
        lines += ["", translate("Check by a second method:", lang), *checks]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines))


def step_lines(step: SolutionStep, count: int, lang: str) -> list[str]:
    """A step with its number, and its formula with numbers and value in a line below."""
    numbers = "" if step.numbers in step.formula else decimal_sign_in(step.numbers, lang)
    value = "" if step.value is None else "± " * step.either_sign + value_text(step.value, step.unit, lang)
    sides = [side for side in (decimal_sign_in(step.formula, lang), numbers, value) if side]
    if sides[1:] and sides[-1] == sides[-2]:
        sides.pop()
    is_relation = step.value is None and " = " not in step.formula
    lines = [f"{count:3}. {with_capital(step.text.in_language(lang))}"]
    return [*lines, _INDENT + (": " if is_relation else " = ").join(sides)] if sides else lines


def with_capital(text: str) -> str:
    """The text with a capital first letter, unless it begins with a symbol such as d or v_B."""
    first = re.match(r"[^\W\d_]{2,}(?!_)\b", text)
    return text[:1].upper() + text[1:] if first is not None and first[0].islower() else text


def named_answer(result: Result, lang: str) -> tuple[str, str]:
    """The name of a result, and its symbol with its value."""
    symbol = f"{result.symbol} = " if result.symbol and _is_number(result.value) else ""
    return with_capital(result.name.in_language(lang)), f"{symbol}{result_text(result, lang)}"


def answer_lines(exercise: Exercise, solution: Solution, lang: str) -> list[str]:
    """What is asked with its result, a line each, and what the source prints."""
    lines = []
    for comparison in compare(exercise, solution):
        line = ": ".join(named_answer(comparison.result, lang))
        note = printed_note(comparison, lang)
        lines.append(f"{line}   [{note}]" if note else line)
    return lines


def result_text(result: Result, lang: str) -> str:
    """The value of a result with its unit, and ± before one that is valid with both signs."""
    return "± " * result.either_sign + value_text(result.value, result.unit, lang)


def printed_note(comparison: Comparison, lang: str) -> str:
    """What the source prints, whether the result agrees with it, and the reason if not; empty if nothing is printed."""
    result, question = comparison.result, comparison.asked
    if question.printed is None:
        return ""
    printed = printed_text(comparison, lang)
    if question.reason is not None:
        return translate(
            "printed {printed}: agrees. {reason}" if comparison.agrees else "printed {printed}: differs. {reason}",
            lang,
            printed=printed,
            reason=question.reason,
        )
    if not comparison.agrees:
        return translate("printed {printed}: differs, unexplained", lang, printed=printed)
    if isinstance(result.value, Readable):
        printed = result.value.in_language(lang)
    return translate("printed {printed}: agrees", lang, printed=printed)


def faults(exercise: Exercise, solution: Solution) -> list[Message]:
    """What is not right: printed answers that differ unexplained or agree in spite of a reason, checks that fail."""
    sentences = [
        message(
            "{id}: {key}: the source prints {printed} and the solution gives {value}; they agree, but the exercise "
            "names a reason for a difference"
            if each.agrees
            else "{id}: {key}: the source prints {printed}, the solution gives {value}; the exercise names no reason "
            "for the difference",
            id=exercise.id,
            key=ascii_key(each.asked.key),
            printed=in_every_language(partial(printed_text, each)),
            value=in_every_language(partial(result_text, each.result)),
        )
        for each in compare(exercise, solution)
        if not each.explained
    ]
    return sentences + [
        message("{id}: {check}", id=exercise.id, check=in_every_language(partial(check_text, check)))
        for check in solution.checks
        if not check.holds
    ]


def printed_text(comparison: Comparison, lang: str) -> str:
    """The printed answer with its unit."""
    text, unit = comparison.asked.printed or "", comparison.asked.unit or comparison.result.unit
    if text in ("yes", "no"):
        return translate("yes" if text == "yes" else "no", lang)
    return decimal_sign_in(text, lang) + (unit if unit in ("", "°") else f" {unit}")


def check_text(check: Check, lang: str) -> str:
    """The quantity by both methods, and whether they agree; or the sentence that the second one confirms."""
    first, second = (value_text(value, check.unit, lang) for value in (check.first, check.second))
    if not check.holds:
        sentence = message("{what}: {first} and {second} DIFFER")
    elif isinstance(check.first, bool):
        return check.text.in_language(lang)
    elif first == second and not check.first:  # of a difference
        sentence = message("{what}: {first}")
    elif first == second:
        sentence = message("{what}: both methods give {first}")
    else:
        sentence = message("{what}: {first} and {second} agree")
    return with_capital(sentence.filled(what=check.text, first=first, second=second).in_language(lang))


def check_cells(check: Check, lang: str) -> tuple[str, str]:
    """A check as a row: what the second method tells, and its value; of a sentence none."""
    value = "" if isinstance(check.first, bool) else value_text(check.second, check.unit, lang)
    return with_capital(check.text.in_language(lang)), value


def cells_of_table(table: TeachingTable, lang: str) -> list[list[str]]:
    """The headers and the rows of a table as texts."""
    cells = [[value_text(header, "", lang) for header in table.headers]]
    places = [0 if all(map(_is_whole, column)) else table.decimals for column in zip(*table.rows, strict=True)]
    return [*cells, *([_cell(v, k, lang) for v, k in zip(row, places, strict=True)] for row in table.rows)]


def lines_of_table(table: TeachingTable, lang: str) -> list[str]:
    """The table as aligned lines under its title; columns of numbers are flush right."""
    cells = cells_of_table(table, lang)
    flush = [all(_is_number(row[k]) for row in table.rows) for k in range(len(table.headers))]
    widths = [max(len(row[k]) for row in cells) for k in range(len(table.headers))]
    lines = [table.title.in_language(lang)]
    for row in cells:
        shown = (c.rjust(w) if is_number else c.ljust(w) for c, w, is_number in zip(row, widths, flush, strict=True))
        lines.append("  ".join(shown).rstrip())
    return lines


def _is_number(value: Value) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_whole(value: Value) -> bool:
    return not _is_number(value) or abs(float(value) - round(float(value))) < 1e-9  # type: ignore[arg-type]


def _cell(value: Value, decimals: int, lang: str) -> str:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value_text(value, "", lang)
    return number(round(value, decimals) + 0.0, lang, f".{decimals}f")
