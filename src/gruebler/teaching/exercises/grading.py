"""Grades of a student's answers: right, nearly right, or wrong with a hint at the likely mistake."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.text import LANGUAGES, Readable, message, translate_in_context
from gruebler.files import Exercise
from gruebler.files.catalog_records import Question
from gruebler.teaching.exercises.answers import GivenAnswer, read_answer
from gruebler.teaching.exercises.solution import Mistake, Result, Value
from gruebler.teaching.exercises.solving import scale_of, solve

FINE = 1e-3  # relative difference of an answer that is right whatever its digits
NEARLY = 0.02  # of one that is nearly right: intermediate results rounded, of which whole results have none
_WORDS = {"yes": True, "ja": True, "true": True, "no": False, "nein": False, "false": False}


class Mark(StrEnum):
    """The mark of an answer."""

    RIGHT = "right"
    NEAR = "near"
    WRONG = "wrong"


@dataclass(frozen=True, slots=True, kw_only=True)
class Grade:
    """One answer with the result and its mark."""

    key: str
    answer: str
    result: Result
    mark: Mark
    hint: Readable | None = None
    """A hint at the likely mistake."""
    name: str = ""
    """The name under which it was answered: the key, or the symbol that the solution prints."""


NEARLY_RIGHT = message("Right in principle; carry more digits on the way.")

# Mistakes possible with any measured number: the answer as a function of the right one, the unit, the hint.
_ANYWHERE = (
    (lambda x: -x, "", message("Look at the sign.")),
    (math.radians, "°", message("That is the angle in radians; degrees are asked for.")),
    (
        lambda x: math.degrees(math.sin(math.radians(x))) if abs(x) < 360 else math.nan,
        "°",
        message("The inverse function is missing (arcsin, arccos)."),
    ),
    (lambda x: 180 - x, "°", message("That is the supplementary angle, 180° less it.")),
    (lambda x: 90 - x, "°", message("That is the complement, 90° less it.")),
    (lambda x: x / 10, "", message("Look at the unit: a factor of 10.")),
    (lambda x: 10 * x, "", message("Look at the unit: a factor of 10.")),
    (lambda x: x / 1000, "", message("Look at the unit: a factor of 1000.")),
    (lambda x: 1000 * x, "", message("Look at the unit: a factor of 1000.")),
    (lambda x: 2 * x, "", message("That is twice as much.")),
    (lambda x: x / 2, "", message("That is half of it.")),
)


def grade(exercise: Exercise, answers: Mapping[str, str]) -> list[Grade]:
    """Mark the answers, given as texts by the keys of the results or by the symbols that the solution prints.

    A number is right within half a unit of its last digit or a thousandth; decimal comma or point, with a unit or in
    that of the result or of the printed answer. Raises `GrueblerError` for an unknown key, an answer without a number
    where one is expected, and an exercise whose solution is a table.

    >>> from gruebler.teaching.exercises.generation import generate
    >>> [m.mark.value for m in grade(generate("dead-centre", 7), {"H": "60", "l_a": "130"})]
    ['right', 'right']
    >>> print(grade(generate("dead-centre", 7), {"H": "30"})[0].hint)
    The stroke is twice the crank, not once.
    """
    solution = solve(exercise)
    grades: list[Grade] = []
    for name, answer in answers.items():
        key = _key_of(name, exercise, solution.results)
        if key in (entry.key for entry in grades):
            raise GrueblerError("{word} is answered twice: give one answer for each", word=name)
        printed = [
            m for question in exercise.asked if question.key == key for m in _misprint(question, solution.results[key])
        ]
        mistakes = [*printed, *(m for m in solution.mistakes if m.key == key)]
        result = solution.results[key]
        scales = [1.0, *(scale_of(question, result) for question in exercise.asked if question.key == key)]
        grades.append(replace(_marked(mistakes, result, answer.strip(), scales), name=name.strip()))
    return grades


def _key_of(name: str, exercise: Exercise, results: Mapping[str, Result]) -> str:
    """The key of the result with this name: its key, or the symbol that the solution prints."""
    bare_name = _bare(name)
    named = [key for key in results if bare_name in {_bare(key_in_language(key, lang)) for lang in LANGUAGES}] or [
        key for key, result in results.items() if _bare(result.symbol) == bare_name
    ]
    if len(named) == 1:
        return named[0]
    if named:
        raise GrueblerError(
            "{word} stands for several results of {id}: {named}",
            word=name,
            id=exercise.id,
            named=", ".join(map(ascii_key, named)),
        )
    names = [plain_name(results[key]) for key in ([a.key for a in exercise.asked] or results)]
    raise GrueblerError(
        "{id} does not ask for {word!r}{suggestion}; it asks for {known}", id=exercise.id, **unknown(name, names)
    )


def key_in_language(key: str, lang: str) -> str:
    """The key of a result, which is an English word where there is no symbol, in a language.

    >>> key_in_language("good", "de"), key_in_language("μ_min", "de")
    ('gut', 'μ_min')
    """
    match key:
        case "good":
            return translate_in_context("answer", "good", lang)
        case "turns":
            return translate_in_context("answer", "turns", lang)
        case "type":
            return translate_in_context("answer", "type", lang)
    return key


def _bare(name: str) -> str:
    """Without spaces and underscores: la and l_a are the same."""
    return "".join(ascii_key(name).split()).replace("_", "")


def plain_name(result: Result) -> str:
    """The name of a result: its key, and its symbol where that differs, in letters of every keyboard."""
    key, symbol = ascii_key(result.key), ascii_key(result.symbol)
    return f"{key} ({symbol})" if symbol and symbol != key and "." not in key else key


def ascii_key(key: str) -> str:
    """A key in letters that every keyboard has.

    >>> ascii_key("Δφ"), ascii_key("μ_I*"), ascii_key("H"), ascii_key("g₁")
    ('Deltaphi', 'mu_I*', 'H', 'g1')
    """
    return "".join(_GREEK.get(letter, letter) for letter in key).translate(_INDICES)


_INDICES = {0x2080 + k: str(k) for k in range(10)}


_GREEK = {
    "α": "alpha",
    "β": "beta",
    "δ": "delta",
    "Δ": "Delta",
    "ε": "epsilon",
    "θ": "theta",
    "λ": "lambda",
    "μ": "mu",
    "φ": "phi",
    "ψ": "psi",
    "ω": "omega",
}


def _misprint(question: Question, result: Result) -> Iterator[Mistake]:
    """The printed answer as a mistake, where it is one."""
    if question.printed is not None and question.reason is not None:
        hint = message("That is the printed answer. {reason}", reason=question.reason)
        yield Mistake(question.key, float(question.printed) * scale_of(question, result), hint)


def _marked(mistakes: Sequence[Mistake], result: Result, answer: str, scales: Sequence[float]) -> Grade:
    if isinstance(result.value, int | float) and not isinstance(result.value, bool):
        return _marked_number(mistakes, result, answer, scales)
    mark = _mark_of_words(result.value, answer)
    hints = [m.hint for m in mistakes if mark is Mark.WRONG and _mark_of_words(m.value, answer) is Mark.RIGHT]
    return Grade(key=result.key, answer=answer, result=result, mark=mark, hint=hints[0] if hints else None)


def _marked_number(mistakes: Sequence[Mistake], result: Result, answer: str, scales: Sequence[float]) -> Grade:
    reading, value = read_answer(answer, result), float(result.value)  # type: ignore[arg-type]
    if result.either_sign:
        reading = replace(reading, number=math.copysign(reading.number, value))
    if not reading.has_unit:  # in the unit of the print, if it is right in that one
        read = [GivenAnswer(reading.number * scale, reading.place * scale, False) for scale in scales]
        reading = next((candidate for candidate in read if _mark_of(result.value, candidate) is Mark.RIGHT), reading)
    mark = _mark_of(result.value, reading)
    if mark is Mark.RIGHT and not any(_is_mistake(m.value, value, reading) for m in mistakes):
        return Grade(key=result.key, answer=answer, result=result, mark=mark)
    hints = [m.hint for m in mistakes if _mark_of(m.value, reading) is Mark.RIGHT]
    if not hints:
        hints = [m.hint for m in common_mistakes(result) if _mark_of(m.value, reading) is Mark.RIGHT]
    if hints:
        return Grade(key=result.key, answer=answer, result=result, mark=Mark.WRONG, hint=hints[0])
    near = NEARLY_RIGHT if mark is Mark.NEAR else None
    return Grade(key=result.key, answer=answer, result=result, mark=mark, hint=near)


def common_mistakes(result: Result) -> list[Mistake]:
    """The mistakes that are possible with any measured number: sign, unit, angle, half and double."""
    if not isinstance(result.value, float) or not result.unit:
        return []
    changed = [(change(result.value), hint) for change, unit, hint in _ANYWHERE if unit in ("", result.unit)]
    return [Mistake(result.key, value, hint) for value, hint in changed if math.isfinite(value)]


def _is_mistake(mistake: Value, correct: float, reading: GivenAnswer) -> bool:
    """Whether an answer within the rounding tolerance is exactly that of a known mistake, such as H = 50 for 50.3."""
    if not isinstance(mistake, float):
        return False
    return abs(reading.number - mistake) <= 1e-5 * abs(mistake) and abs(reading.number - correct) > FINE * abs(correct)


def _mark_of(value: Value, reading: GivenAnswer) -> Mark:
    """What an answer is worth, whatever the last bit of the result is.

    >>> [str(_mark_of(wanted, GivenAnswer(123.0, 1.0, False))) for wanted in (125.0, math.nextafter(125.0, 126.0))]
    ['wrong', 'wrong']
    """
    if isinstance(value, str | Readable | bool):
        return Mark.WRONG
    off, size = abs(reading.number - value), abs(value)
    if isinstance(value, int):
        return Mark.RIGHT if off == 0 else Mark.WRONG
    if off <= FINE * size or (off <= 0.5 * reading.place * (1 + 1e-9) and off <= NEARLY * size) or off < 1e-9:
        return Mark.RIGHT
    is_whole = abs(value - round(value)) <= 1e-9 * size  # but for rounding
    return Mark.NEAR if off <= NEARLY * size and not is_whole else Mark.WRONG


def _mark_of_words(value: Value, answer: str) -> Mark:
    if isinstance(value, bool):
        if answer.casefold() not in _WORDS:
            raise GrueblerError("expected yes or no (ja, nein), not {answer!r}", answer=answer)
        return Mark.RIGHT if _WORDS[answer.casefold()] == value else Mark.WRONG
    names = [value.in_language(lang) for lang in LANGUAGES] if isinstance(value, Readable) else [str(value)]
    return Mark.RIGHT if _plain(answer) in map(_plain, names) else Mark.WRONG


def _plain(name: str) -> str:
    """A name for comparisons: text in brackets, hyphens and capitals are ignored."""
    return " ".join(name.partition("(")[0].casefold().replace("-", " ").split())
