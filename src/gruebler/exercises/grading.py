"""A student's answers marked: right, nearly right, or wrong with a hint at the likely mistake."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

from gruebler.errors import GrueblerError, nearest
from gruebler.exercises.answers import GivenAnswer, read_answer
from gruebler.exercises.solution import Mistake, Result, Value
from gruebler.exercises.solving import scale_of, solve
from gruebler.formats import Exercise
from gruebler.formats.catalog_records import Question
from gruebler.text import LANGUAGES, Readable, message

__all__ = ["Grade", "Mark", "ascii_key", "grade", "plain_name"]

_FINE = 1e-3  # relative difference of an answer that is right whatever its digits
_NEAR = 0.02  # of one that is nearly right: rounded on the way
_WORDS = {"yes": True, "ja": True, "true": True, "no": False, "nein": False, "false": False}


class Mark(StrEnum):
    """What an answer is worth."""

    RIGHT = "right"
    NEAR = "near"
    WRONG = "wrong"


@dataclass(frozen=True, slots=True)
class Grade:
    """One answer beside the result."""

    key: str
    answer: str
    result: Result
    mark: Mark
    hint: Readable | None = None
    """What may have gone wrong."""


# What goes wrong with any measured number: the answer as a function of the right one, where it applies (by unit), hint.
_ANYWHERE = (
    (lambda x: -x, "", message("Look at the sign.")),
    (
        math.radians,
        "°",
        message("That is the angle in radians; degrees are asked for."),
    ),
    (
        lambda x: math.degrees(math.sin(math.radians(x))) if abs(x) < 360 else math.nan,
        "°",
        message("The inverse function is missing (arcsin, arccos)."),
    ),
    (
        lambda x: 180 - x,
        "°",
        message("That is the supplementary angle, 180° less it."),
    ),
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
    that of the result or of the printed answer. Raises `GrueblerError` for a key that is not asked, an answer that is
    no number where one is asked, and an exercise that is answered by a table.

    >>> from gruebler.exercises.generation import generate
    >>> [m.mark.value for m in grade(generate("dead-centre", 7), {"H": "60", "l_a": "130"})]
    ['right', 'right']
    >>> print(grade(generate("dead-centre", 7), {"H": "30"})[0].hint)
    The stroke is twice the crank, not once.
    """
    solution = solve(exercise)
    if not solution.results:
        raise GrueblerError("{id} is answered by a table, which `gruebler exercise solve {id}` shows", id=exercise.id)
    grades: list[Grade] = []
    for word, answer in answers.items():
        key = _asked_for(word, exercise, solution.results)
        if key in (one.key for one in grades):
            raise GrueblerError("{word} is answered twice: give one answer for each", word=word)
        printed = [m for asked in exercise.asked if asked.key == key for m in _misprint(asked, solution.results[key])]
        known = [*printed, *(m for m in solution.mistakes if m.key == key)]
        result = solution.results[key]
        scales = [1.0, *(scale_of(asked, result) for asked in exercise.asked if asked.key == key)]
        grades.append(_marked(known, result, answer.strip(), scales))
    return grades


def _asked_for(word: str, exercise: Exercise, results: Mapping[str, Result]) -> str:
    """The key of the result that a word names: by the key, or by the symbol that the solution prints."""
    wanted = _bare(word)
    named = [key for key in results if _bare(key) == wanted] or [
        key for key, result in results.items() if _bare(result.symbol) == wanted
    ]
    if len(named) == 1:
        return named[0]
    if named:
        raise GrueblerError(
            "{word} stands for several results of {id}: {named}",
            word=word,
            id=exercise.id,
            named=", ".join(map(ascii_key, named)),
        )
    asked = [plain_name(results[key]) for key in ([a.key for a in exercise.asked] or results)]
    raise GrueblerError(
        "{id} does not ask for {word!r}{suggestion}; it asks for {asked}",
        id=exercise.id,
        word=word,
        suggestion=nearest(word, asked),
        asked=", ".join(asked),
    )


def _bare(word: str) -> str:
    return "".join(ascii_key(word).split())


def plain_name(result: Result) -> str:
    """What a result is called: its key, and its symbol where that is another word, in letters of every keyboard."""
    key, symbol = ascii_key(result.key), ascii_key(result.symbol)
    return f"{key} ({symbol})" if symbol and symbol != key and "." not in key else key


def ascii_key(key: str) -> str:
    """A key in letters that every keyboard has.

    >>> ascii_key("Δφ"), ascii_key("μ_I*"), ascii_key("H")
    ('Deltaphi', 'mu_I*', 'H')
    """
    return "".join(_GREEK.get(letter, letter) for letter in key)


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


def _misprint(asked: Question, result: Result) -> Iterator[Mistake]:
    """The printed answer as a mistake, where it is one."""
    if asked.printed is not None and asked.reason is not None:
        hint = message("That is the printed answer. {reason}", reason=asked.reason)
        yield Mistake(asked.key, float(asked.printed) * scale_of(asked, result), hint)


def _marked(known: Sequence[Mistake], result: Result, answer: str, scales: Sequence[float]) -> Grade:
    if isinstance(result.value, int | float) and not isinstance(result.value, bool):
        return _marked_number(known, result, answer, scales)
    worth = _worth_of_words(result.value, answer)
    hints = [m.hint for m in known if worth is Mark.WRONG and _worth_of_words(m.value, answer) is Mark.RIGHT]
    return Grade(result.key, answer, result, worth, hints[0] if hints else None)


def _marked_number(known: Sequence[Mistake], result: Result, answer: str, scales: Sequence[float]) -> Grade:
    given, value = read_answer(answer, result), float(result.value)  # type: ignore[arg-type]
    if result.either_sign:
        given = given._replace(number=math.copysign(given.number, value))
    if not given.has_unit:  # in the unit of the print, if it is right in that one
        read = [GivenAnswer(given.number * scale, given.place * scale, False) for scale in scales]
        given = next((one for one in read if _worth(result.value, one) is Mark.RIGHT), given)
    worth = _worth(result.value, given)
    if worth is Mark.RIGHT and not any(_rather(m.value, value, given) for m in known):
        return Grade(result.key, answer, result, worth)
    hints = [m.hint for m in known if _worth(m.value, given) is Mark.RIGHT]
    if not hints and isinstance(result.value, float):
        hints = [
            hint
            for change, unit, hint in _ANYWHERE
            if result.unit and (not unit or unit == result.unit) and _worth(change(value), given) is Mark.RIGHT
        ]
    if hints:
        return Grade(result.key, answer, result, Mark.WRONG, hints[0])
    near = message("Right in principle; carry more digits on the way.")
    return Grade(result.key, answer, result, worth, near if worth is Mark.NEAR else None)


def _rather(mistake: Value, right: float, given: GivenAnswer) -> bool:
    """Whether an answer that rounding would excuse is just that of a known mistake, such as H = 50 for 50.3."""
    if not isinstance(mistake, float):
        return False
    return abs(given.number - mistake) <= 1e-5 * abs(mistake) and abs(given.number - right) > _FINE * abs(right)


def _worth(value: Value, given: GivenAnswer) -> Mark:
    if isinstance(value, str | Readable | bool):
        return Mark.WRONG
    off, size = abs(given.number - value), abs(value)
    if isinstance(value, int):
        return Mark.RIGHT if off == 0 else Mark.WRONG
    if off <= _FINE * size or (off <= 0.5 * given.place * (1 + 1e-9) and off <= _NEAR * size) or off < 1e-9:
        return Mark.RIGHT
    return Mark.NEAR if off <= _NEAR * size else Mark.WRONG


def _worth_of_words(value: Value, answer: str) -> Mark:
    if isinstance(value, bool):
        if answer.casefold() not in _WORDS:
            raise GrueblerError("expected yes or no (ja, nein), not {answer!r}", answer=answer)
        return Mark.RIGHT if _WORDS[answer.casefold()] == value else Mark.WRONG
    names = [value.in_language(lang) for lang in LANGUAGES] if isinstance(value, Readable) else [str(value)]
    return Mark.RIGHT if _plain(answer) in map(_plain, names) else Mark.WRONG


def _plain(name: str) -> str:
    """A name as it is compared: what stands in brackets, hyphens and capitals do not count."""
    return " ".join(name.partition("(")[0].casefold().replace("-", " ").split())
