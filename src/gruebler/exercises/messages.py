"""Exercises and solutions in words, in English and German; German numbers have a decimal comma."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from gruebler.exercises.grading import ascii_key
from gruebler.exercises.solution import Check, Heading, Result, Solution, SolutionStep, Table, Value, number
from gruebler.exercises.solving import Comparison, compare
from gruebler.formats import Exercise
from gruebler.text import Text

__all__ = ["lines_of_table", "solution_text", "source_text", "task_text", "value_text"]

_WORDS = {
    "source": ("Source", "Quelle"),
    "task": ("Task", "Aufgabe"),
    "given": ("Given", "Gegeben"),
    "asked": ("Asked", "Gesucht"),
    "way": ("Solution", "Lösungsweg"),
    "answers": ("Results", "Ergebnisse"),
    "checks": ("Check by a second way", "Probe auf einem zweiten Weg"),
    "agrees": ("agrees", "stimmt überein"),
    "differs": ("DIFFERS", "WEICHT AB"),
    "printed": ("printed {}: agrees", "gedruckt {}: stimmt"),
    "misprint": ("printed {}: differs. {}", "gedruckt {}: abweichend. {}"),
    "unexplained": ("printed {}: differs, unexplained", "gedruckt {}: abweichend, ungeklärt"),
    "yes": ("yes", "ja"),
    "no": ("no", "nein"),
    "unit": ("in {}", "in {}"),
    "plain": ("a number", "eine Zahl"),
    "remark": ("Remark", "Bemerkung"),
}
_INDENT = "     "


def _word(key: str, lang: str) -> str:
    return _WORDS[key][lang == "de"]


def _local(text: str, lang: str) -> str:
    """Decimal commas in German; the comma between numbers with decimals becomes a semicolon."""
    if lang != "de":
        return text
    text = re.sub(r"(\d\.\d+), (?=[-\d])|(?<=\d), (?=-?\d+\.\d)", r"\1; ", text)
    return re.sub(r"(?<=\d)\.(?=\d)", ",", text)


def value_text(value: Value, unit: str, lang: str) -> str:
    """A value with its unit.

    >>> value_text(78.46304096718453, "°", "de"), value_text(True, "", "de")
    ('78,463°', 'ja')
    """
    if isinstance(value, bool):
        return _word("yes" if value else "no", lang)
    if isinstance(value, Text):
        return value.in_language(lang)
    if isinstance(value, str):
        return value
    return _local(number(value), lang) + (unit if unit in ("", "°") else f" {unit}")


def source_text(source: str, lang: str) -> str:
    """Where it stands in the documents.

    >>> source_text("000/003, sections 2.3 and 2.6", "de")
    '000/003, Abschnitte 2.3 und 2.6'
    """
    if lang == "de":
        for english, german in _SOURCES.items():
            source = re.sub(rf"\b{english}\b", german, source)
    return source


_SOURCES = {
    "sections": "Abschnitte",
    "section": "Abschnitt",
    "first exercise": "erste Aufgabe",
    "second exercise": "zweite Aufgabe",
    "exercise": "Aufgabe",
    "and": "und",
}


def task_text(exercise: Exercise, lang: str = "en", solution: Solution | None = None) -> str:
    """Title, source and task, with what is given and, if the solution's names are at hand, what is asked."""
    title = f"{exercise.name.in_language(lang)} ({exercise.id})"
    lines = [title, "-" * len(title)]
    if exercise.source:
        lines.append(f"{_word('source', lang)}: {source_text(exercise.source, lang)}")
    lines.append(f"{_word('task', lang)}: {exercise.task.in_language(lang)}")
    if solution is not None and exercise.asked:
        results = [solution.results[asked.key] for asked in exercise.asked]
        lines.append(f"{_word('asked', lang)}:")
        lines += [f"  {ascii_key(result.key)}: {_asked(result, lang)}" for result in results]
    if exercise.remark is not None:
        lines.append(f"{_word('remark', lang)}: {exercise.remark.in_language(lang)}")
    return "\n".join(lines)


def _asked(result: Result, lang: str) -> str:
    """The name, and in which unit it is wanted."""
    name = _local(result.name.in_language(lang), lang)
    if not _is_number(result.value):
        return name
    return f"{name} ({_word('unit', lang).format(result.unit) if result.unit else _word('plain', lang)})"


def solution_text(exercise: Exercise, solution: Solution, lang: str = "en") -> str:
    """The whole way: task, steps, tables, results beside what is printed, checks."""
    lines = [task_text(exercise, lang), "", f"{_word('way', lang)}:"]
    count = 0
    for part in solution.parts:
        if isinstance(part, Heading):
            count = 0
            lines += ["", f"  {part.text.in_language(lang)}"]
        elif isinstance(part, Table):
            lines += ["", *(_INDENT + line for line in lines_of_table(part, lang)), ""]
        else:
            count += 1
            lines += _step(part, count, lang)
    answers = list(_answers(compare(exercise, solution), lang))
    if answers:
        lines += ["", f"{_word('answers', lang)}:", *answers]
    if solution.checks:
        lines += ["", f"{_word('checks', lang)}:", *(_check(check, lang) for check in solution.checks)]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines))


def _step(step: SolutionStep, count: int, lang: str) -> list[str]:
    numbers = "" if step.numbers in step.formula else _local(step.numbers, lang)
    value = "" if step.value is None else "± " * step.either_sign + value_text(step.value, step.unit, lang)
    sides = [side for side in (_local(step.formula, lang), numbers, value) if side]
    if sides[1:] and sides[-1] == sides[-2]:
        sides.pop()
    is_relation = step.value is None and " = " not in step.formula
    lines = [f"{count:3}. {_local(_capital(step.text.in_language(lang)), lang)}"]
    return [*lines, _INDENT + (": " if is_relation else " = ").join(sides)] if sides else lines


def _capital(text: str) -> str:
    """With a capital letter in front, unless a symbol such as d or v_B stands there."""
    return text[:1].upper() + text[1:] if re.match(r"[a-zäöüß]{2,}(?!_)\b", text) else text


def _answers(comparisons: Sequence[Comparison], lang: str) -> Iterator[str]:
    for comparison in comparisons:
        result, asked = comparison.result, comparison.asked
        symbol = f"{result.symbol} = " if result.symbol and _is_number(result.value) else ""
        line = (
            f"  {_capital(_local(result.name.in_language(lang), lang))}: {symbol}{'± ' * result.either_sign}"
            f"{value_text(result.value, result.unit, lang)}"
        )
        if asked.printed is not None:
            printed = _printed(asked.printed, asked.unit or result.unit, lang)
            if isinstance(result.value, Text) and comparison.agrees:
                printed = result.value.in_language(lang)
            if comparison.agrees:
                note = _word("printed", lang).format(printed)
            elif asked.reason is None:
                note = _word("unexplained", lang).format(printed)
            else:
                note = _word("misprint", lang).format(printed, asked.reason.in_language(lang))
            line += f"   [{note}]"
        yield line


def _printed(text: str, unit: str, lang: str) -> str:
    if text in ("yes", "no"):
        return _word(text, lang)
    return _local(text, lang) + (unit if unit in ("", "°") else f" {unit}")


def _check(check: Check, lang: str) -> str:
    first, second = (value_text(value, check.unit, lang) for value in (check.first, check.second))
    verdict = _word("agrees" if check.holds else "differs", lang)
    return f"  {_local(check.text.in_language(lang), lang)}: {first} | {second}: {verdict}"


def lines_of_table(table: Table, lang: str) -> list[str]:
    """The table as aligned lines under its title; columns of numbers are flush right."""
    cells = [[header.in_language(lang) for header in table.headers]]
    places = [0 if all(map(_is_whole, column)) else table.decimals for column in zip(*table.rows, strict=True)]
    cells += [[_cell(value, k, lang) for value, k in zip(row, places, strict=True)] for row in table.rows]
    flush = [all(_is_number(row[k]) for row in table.rows) for k in range(len(table.headers))]
    widths = [max(len(row[k]) for row in cells) for k in range(len(table.headers))]
    lines = [table.title.in_language(lang)]
    for row in cells:
        shown = (c.rjust(w) if right else c.ljust(w) for c, w, right in zip(row, widths, flush, strict=True))
        lines.append("  ".join(shown).rstrip())
    return lines


def _is_number(value: Value) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_whole(value: Value) -> bool:
    return not _is_number(value) or abs(float(value) - round(float(value))) < 1e-9  # type: ignore[arg-type]


def _cell(value: Value, decimals: int, lang: str) -> str:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value_text(value, "", lang)
    text = f"{value:.{decimals}f}"
    return _local(re.sub(r"^-(0\.?0*)$", r"\1", text), lang)
