"""`gruebler construct`: the classical constructions with compass and ruler, step by step."""

from __future__ import annotations

import argparse

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message, number
from gruebler.cli.output import print_json, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.mechanics.fourbar.length_texts import is_lengths, size_of
from gruebler.pictures.canvas.construction_files import CONSTRUCTION_SUFFIXES, construction_bytes
from gruebler.teaching.constructions import CONSTRUCTIONS, construction, construction_forms

_HEADERS = (message("name"), message("construction"), message("chapter"), message("quantities"))


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Draw a construction step by step: dead centres, transmission angle, instant centres, polygons of "
        "velocities and accelerations, coupler curve, curvature, cognates, positions, Geneva drive, cam. Without a "
        "name: "
        "list them with their quantities. The values of the last step are measured in the drawing.",
        epilog="Examples: gruebler construct dead-centres four-bar:25,70,40,70 -o dead.html; gruebler construct "
        "accelerations inverted-slider-crank:30,50 phi=70 omega=10 -o plan.pdf --lang de; gruebler construct cam "
        "'lift=rise 20 90; dwell 90; fall 20 90; dwell' --step 3 -o cam.svg.",
    )
    parser.take(
        """
        name NAME ?  such as dead-centres, velocities or roberts
        values KEY=VALUE|LENGTHS|FORM *  quantities, such as a=25 phi=55, and lengths, such as four-bar:25,70,40,70, or
            a form, such as scotch-yoke (default: an example)
        --step N int  only this step, in a picture
        """
    )
    parser.add_json(help="print an object with title, steps and values")
    parser.add_out(
        help="write into a file instead: .html with a slider for the steps, .pdf with one step a page, .svg, .png or "
        ".tex with the steps side by side; or the steps as text: .txt, or .json as with --json"
    )
    parser.set_defaults(written=tuple(f".{ending}" for ending in CONSTRUCTION_SUFFIXES))


def run(arguments: argparse.Namespace) -> int:
    """List the constructions, or make one."""
    if arguments.name is None:
        _list(arguments)
        return 0
    form, values = _given(arguments.values, [form for form in construction_forms(arguments.name) if form])
    whole = construction(arguments.name, form, **values)
    lang, path = arguments.lang, arguments.out
    suffix = "" if path is None else path.suffix.lower().removeprefix(".")
    if path is not None and suffix in CONSTRUCTION_SUFFIXES:
        write_file(path, construction_bytes(whole, suffix, lang, step=arguments.step), lang)
    elif arguments.json:
        print_json(
            {
                "title": whole.title.in_language(lang),
                "steps": [step.text.in_language(lang) for step in whole.steps],
                "values": dict(whole.values),
            }
        )
    else:
        print(whole.title.in_language(lang))
        for k, step in enumerate(whole.steps, 1):
            print(f"{k:3}. {step.text.in_language(lang)}")
    return 0


def _given(words: list[str], forms: list[str]) -> tuple[str, dict[str, float | str]]:
    """The form of linkage, among those of the construction, and the quantities that words give."""
    form = ""
    values: dict[str, float | str] = {}
    for word in words:
        key, equals, value = word.partition("=")
        if equals and key.strip() and value.strip():
            if key.strip() in values:
                raise GrueblerError("{key} is given twice; give one value for each key", key=key.strip())
            values[key.strip()] = value.strip()
        elif word in forms:
            form = word
        elif is_lengths(word):
            form, lengths = _lengths(word)
            values |= lengths
        else:
            raise GrueblerError(
                "expected KEY=VALUE or lengths such as four-bar:25,70,40,70, but found {word!r}", word=word
            )
    return form, values


def _lengths(word: str) -> tuple[str, dict[str, float | str]]:
    size = size_of(word)
    assert size is not None
    kind = word.partition(":")[0] if ":" in word else "four-bar"
    # Of inverted slider-cranks only central ones are constructed: these have no e.
    return kind, {name: value for name, value in size.named.items() if value or kind != "inverted-slider-crank"}


def _list(arguments: argparse.Namespace) -> None:
    lang = arguments.lang
    rows = [
        (row.name, row.title.in_language(lang), row.chapter, _quantities(form, known, lang))
        for row in CONSTRUCTIONS.values()
        for form, known in construction_forms(row.name).items()
    ]
    if arguments.json:
        print_json(
            [
                {"name": row.name, "title": row.title.in_language(lang), "forms": construction_forms(row.name)}
                for row in CONSTRUCTIONS.values()
            ]
        )
    else:
        print_table(_HEADERS, rows, lang=lang)


def _quantities(form: str, known: dict[str, float | str], lang: str) -> str:
    """The form and the quantities with their defaults."""
    shown = " ".join(
        f"{key}={number(value, lang, '.4g')}" if isinstance(value, int | float) else f"'{key}={value}'"
        for key, value in known.items()
    )
    return f"{form}: {shown}" if form else shown
