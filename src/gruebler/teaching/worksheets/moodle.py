"""Tasks as questions of Moodle: one for each quantity asked, with figure, unit, tolerance and hints at likely mistakes.

Elements of the XML as https://docs.moodle.org/en/Moodle_XML_format describes them, the text as
https://docs.moodle.org/en/GIFT_format does.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from html import escape
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

from gruebler.base.text import LANGUAGES, Readable, message
from gruebler.files import Exercise
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.files import picture_bytes
from gruebler.teaching.exercises import Result, Solution, solve
from gruebler.teaching.exercises.grading import FINE, NEARLY
from gruebler.teaching.exercises.messages import asked_text
from gruebler.teaching.worksheets.blocks import typeset

_NEAR = message("Right in principle; carry more digits on the way.")
_UNIT_OPTIONAL, _WITHOUT_UNITS = "0", "3"  # qtype_numerical::UNITOPTIONAL and UNITNONE of Moodle

Task = tuple[Exercise, str, Figure | None]
"""An exercise with its text and its figure."""


class _Answer(NamedTuple):
    """An answer, its marks in percent, what is said to it, and by how much a number may differ from it."""

    text: str
    fraction: int
    hint: str = ""
    tolerance: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Question:
    """A question about one quantity; ``kind`` is ``numerical``, ``truefalse`` or ``shortanswer``."""

    name: str
    kind: str
    paragraphs: tuple[str, str]
    picture: bytes | None
    answers: tuple[_Answer, ...]
    """In the order in which Moodle tries them: right, likely mistakes, nearly right."""
    unit: str


def moodle_xml(tasks: Iterable[Task], lang: str = "en") -> bytes:
    """The questions of tasks as a file that Moodle imports.

    >>> from gruebler.teaching.exercises import exercise
    >>> moodle_xml([(exercise("dead-centre-1-7"), "Find the stroke.", None)]).count(b'<question type="numerical">')
    3
    """
    quiz = Element("quiz")
    for asked in _questions(tasks, lang):
        question = SubElement(quiz, "question", type=asked.kind)
        _text(SubElement(question, "name"), asked.name)
        body = SubElement(question, "questiontext", format="html")
        _text(body, _html(asked, "@@PLUGINFILE@@/figure.svg"))
        if asked.picture is not None:
            file = SubElement(body, "file", name="figure.svg", path="/", encoding="base64")
            file.text = base64.b64encode(asked.picture).decode("ascii")
        SubElement(question, "defaultgrade").text = "1"
        for each in asked.answers:
            answer = SubElement(question, "answer", fraction=str(each.fraction), format="moodle_auto_format")
            _text(answer, each.text)
            _text(SubElement(answer, "feedback", format="html"), escape(typeset(each.hint)))
            if each.tolerance:
                SubElement(answer, "tolerance").text = each.tolerance
        if asked.unit:
            unit = SubElement(SubElement(question, "units"), "unit")
            SubElement(unit, "multiplier").text = "1"
            SubElement(unit, "unit_name").text = asked.unit
        for key, setting in _settings(asked).items():
            SubElement(question, key).text = setting
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(quiz, encoding="unicode").encode("utf-8")


def _settings(asked: _Question) -> dict[str, str]:
    """The elements that belong to a kind of question."""
    if asked.kind == "numerical":
        shown = _UNIT_OPTIONAL if asked.unit else _WITHOUT_UNITS
        return {"unitgradingtype": "0", "unitpenalty": "0.1", "showunits": shown, "unitsleft": "0"}
    return {"usecase": "0"} if asked.kind == "shortanswer" else {}


def gift(tasks: Iterable[Task], lang: str = "en") -> bytes:
    """The questions of tasks as GIFT, a text format of Moodle without units; figures stand in the text.

    >>> from gruebler.teaching.exercises import exercise
    >>> print(gift([(exercise("grashof-1-9"), "Judge it.", None)]).decode().partition("{")[0])
    ::grashof-1-9 (1/4)::[html]<p>Judge it.</p><p>sum of the shortest and the longest length (in mm)</p>
    """
    return "\n\n".join(_gift_question(asked) for asked in _questions(tasks, lang)).encode("utf-8") + b"\n"


def _gift_question(asked: _Question) -> str:
    image = "" if asked.picture is None else f"data:image/svg+xml;base64,{base64.b64encode(asked.picture).decode()}"
    if asked.kind == "truefalse":
        answers = next(answer.text for answer in asked.answers if answer.fraction == 100).upper()
    else:
        answers = "#" * (asked.kind == "numerical") + "".join(
            f"\n=%{answer.fraction}%{_literal(answer.text)}{answer.tolerance and f':{answer.tolerance}'}"
            f"{answer.hint and f'#{_literal(typeset(answer.hint))}'}"
            for answer in asked.answers
        )
    return f"::{_literal(asked.name)}::[html]{_literal(_html(asked, image))}{{{answers}}}"


def _literal(text: str) -> str:
    """A text without signs that mean something in GIFT."""
    return re.sub(r"([\\~=#{}:])", r"\\\1", text)


def _text(parent: Element, text: str) -> None:
    SubElement(parent, "text").text = text


def _html(asked: _Question, image: str) -> str:
    lines = [f"<p>{escape(paragraph)}</p>" for paragraph in asked.paragraphs]
    if asked.picture is not None:
        lines.insert(1, f'<p><img src="{image}" alt=""></p>')
    return "".join(lines)


def _questions(tasks: Iterable[Task], lang: str) -> Iterator[_Question]:
    for exercise, text, figure in tasks:
        solution = solve(exercise)
        picture = None
        if figure is not None:  # without title and description, which count links and name the mechanism
            picture = picture_bytes(replace(figure, title="", description=""), "svg")
        for number, asked in enumerate(exercise.asked, 1):
            result = solution.results[asked.key]
            kind, answers = _answers(solution, result, lang)
            yield _Question(
                name=f"{exercise.id} ({number}/{len(exercise.asked)})",
                kind=kind,
                paragraphs=(typeset(text), typeset(asked_text(result, lang))),
                picture=picture,
                answers=tuple(answers),
                unit=result.unit if kind == "numerical" else "",
            )


def _answers(solution: Solution, result: Result, lang: str) -> tuple[str, list[_Answer]]:
    """The kind of question, and its answers."""
    value = result.value
    if isinstance(value, bool):
        return "truefalse", [_Answer(word, 100 if (word == "true") == value else 0) for word in ("true", "false")]
    if not isinstance(value, int | float):
        names = [value.in_language(each) for each in LANGUAGES] if isinstance(value, Readable) else [str(value)]
        forms = dict.fromkeys(form for name in names for form in (name, name.partition(" (")[0]))
        return "shortanswer", [_Answer(form, 100) for form in forms]
    answers = [_Answer(repr(value), 100, tolerance=_allowed(value, FINE))]
    for mistake in solution.mistakes:
        if mistake.key == result.key and isinstance(mistake.value, int | float):
            hint = mistake.hint.in_language(lang)
            answers.append(_Answer(repr(mistake.value), 0, hint, _allowed(mistake.value, FINE)))
    if value % 1:
        answers.append(_Answer(repr(value), 50, _NEAR.in_language(lang), _allowed(value, NEARLY)))
    return "numerical", answers


def _allowed(value: float, part: float) -> str:
    return "0" if isinstance(value, int) else f"{part * abs(value):.4g}"
