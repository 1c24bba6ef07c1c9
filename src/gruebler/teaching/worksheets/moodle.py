"""Tasks as questions of Moodle: one for each quantity asked, with figure, unit, tolerance and hints at likely mistakes.

Elements as https://docs.moodle.org/en/Moodle_XML_format describes them.
"""

from __future__ import annotations

import base64
from collections.abc import Iterable
from dataclasses import replace
from html import escape
from xml.etree.ElementTree import Element, SubElement, tostring

from gruebler.base.text import LANGUAGES, Readable, message
from gruebler.files import Exercise
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.files import picture_bytes
from gruebler.teaching.exercises import Result, Solution, solve
from gruebler.teaching.exercises.grading import FINE, NEARLY
from gruebler.teaching.exercises.messages import asked_text

_NEAR = message("Right in principle; carry more digits on the way.")
_UNIT_FIELDS = {"unitgradingtype": "0", "unitpenalty": "0.1", "showunits": "3", "unitsleft": "0"}  # a unit is optional


def moodle_xml(tasks: Iterable[tuple[Exercise, str, Figure | None]], lang: str = "en") -> bytes:
    """The questions of tasks, each with the text and the figure given beside it, as a file that Moodle imports.

    >>> from gruebler.teaching.exercises import exercise
    >>> moodle_xml([(exercise("dead-centre-1-7"), "Find the stroke.", None)]).count(b'<question type="numerical">')
    3
    """
    quiz = Element("quiz")
    for exercise, text, figure in tasks:
        solution = solve(exercise)
        for number, asked in enumerate(exercise.asked, 1):
            result = solution.results[asked.key]
            question = SubElement(quiz, "question")
            _text(SubElement(question, "name"), f"{exercise.id} ({number}/{len(exercise.asked)})")
            _add_body(question, [text, asked_text(result, lang)], figure)
            _add_answers(question, solution, result, lang)
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(quiz, encoding="unicode").encode("utf-8")


def _text(parent: Element, text: str) -> None:
    SubElement(parent, "text").text = text


def _add_body(question: Element, paragraphs: Iterable[str], figure: Figure | None) -> None:
    body = SubElement(question, "questiontext", format="html")
    lines = [f"<p>{escape(paragraph)}</p>" for paragraph in paragraphs]
    if figure is not None:
        figure = replace(figure, title="", description="")  # they count links and name the mechanism
        lines.insert(1, '<p><img src="@@PLUGINFILE@@/figure.svg" alt=""></p>')
    _text(body, "".join(lines))
    if figure is not None:
        file = SubElement(body, "file", name="figure.svg", path="/", encoding="base64")
        file.text = base64.b64encode(picture_bytes(figure, "svg")).decode("ascii")
    SubElement(question, "defaultgrade").text = "1"


def _add_answers(question: Element, solution: Solution, result: Result, lang: str) -> None:
    """The answers in the order in which Moodle tries them: right, likely mistakes, nearly right."""
    value = result.value
    if isinstance(value, bool):
        question.set("type", "truefalse")
        for word in ("true", "false"):
            _add_answer(question, 100 if (word == "true") == value else 0, word)
    elif isinstance(value, int | float):
        question.set("type", "numerical")
        _add_answer(question, 100, repr(value), tolerance=_allowed(value, FINE))
        for mistake in solution.mistakes:
            if mistake.key == result.key and isinstance(mistake.value, int | float):
                hint = mistake.hint.in_language(lang)
                _add_answer(question, 0, repr(mistake.value), hint, _allowed(mistake.value, FINE))
        if isinstance(value, float):
            _add_answer(question, 50, repr(value), _NEAR.in_language(lang), _allowed(value, NEARLY))
        if result.unit:
            unit = SubElement(SubElement(question, "units"), "unit")
            SubElement(unit, "multiplier").text = "1"
            SubElement(unit, "unit_name").text = result.unit
        for key, setting in _UNIT_FIELDS.items():
            SubElement(question, key).text = setting
    else:
        question.set("type", "shortanswer")
        SubElement(question, "usecase").text = "0"
        names = [value.in_language(each) for each in LANGUAGES] if isinstance(value, Readable) else [str(value)]
        for answer in dict.fromkeys(form for name in names for form in (name, name.partition(" (")[0])):
            _add_answer(question, 100, answer)


def _allowed(value: float, part: float) -> str:
    return "0" if isinstance(value, int) else repr(part * abs(value))


def _add_answer(question: Element, fraction: int, text: str, hint: str = "", tolerance: str = "") -> None:
    answer = SubElement(question, "answer", fraction=str(fraction), format="moodle_auto_format")
    _text(answer, text)
    _text(SubElement(answer, "feedback", format="html"), escape(hint))
    if tolerance:
        SubElement(answer, "tolerance").text = tolerance
