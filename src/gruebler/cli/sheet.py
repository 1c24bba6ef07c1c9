"""`gruebler sheet`: collection sheets, listed, told, drawn, sized."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

from gruebler.cli.measured import length_of, same_unit
from gruebler.cli.output import print_json, print_svg, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError, LinkageError
from gruebler.sheets import Sheet, SizedMechanism, StatedValue, sheet, sheets
from gruebler.sheets.messages import explanation_paragraphs, typeset_number

__all__ = ["add", "run"]

_WORDS: dict[str, dict[str, Any]] = {
    "en": {
        "list": ("id", "title", "source"),
        "source": "Source",
        "values": ("symbol", "meaning", "exact", "computed", "printed", ""),
        "of": "length {of}",
        "right": "as printed",
        "wrong": "WRONG",
        "size": "L = {length}{unit} within {tolerance}{unit}: Q_G = {ratio}, φ_G = {width}°, from φ_A = {start}° to "
        "φ_E = {end}°, L/{scale} = {factor}.",
        "printed": "Printed: {text}.",
    },
    "de": {
        "list": ("Kennung", "Titel", "Quelle"),
        "source": "Quelle",
        "values": ("Zeichen", "Bedeutung", "exakt", "berechnet", "gedruckt", ""),
        "of": "Länge {of}",
        "right": "wie gedruckt",
        "wrong": "FALSCH",
        "size": "L = {length}{unit} innerhalb von {tolerance}{unit}: Q_G = {ratio}, φ_G = {width}°, von φ_A = {start}° "
        "bis φ_E = {end}°, L/{scale} = {factor}.",
        "printed": "Gedruckt: {text}.",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A collection sheet tells one mechanism: task, structure, access features, dimensions, how "
        "straight a point runs. Everything but the words is derived from the model.",
        epilog="Example: gruebler sheet draw mzc -o sheet.pdf --lang de; gruebler sheet size mzc --length 15cm "
        "--ratio 0.005. Exit status: 0 all well, 1 a printed value differs (show) or no piece is so straight (size), "
        "2 wrong usage or unreadable input.",
    )
    listing = parser.add_command("list", help="all sheets")
    show = parser.add_command("show", help="one sheet in words: features, dimensions, what is printed and what is so")
    show.add_argument("id", metavar="ID", help="of a sheet")
    draw = parser.add_command("draw", help="one sheet as a page to be printed on A4")
    draw.add_argument("id", metavar="ID", help="of a sheet")
    draw.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="a file .svg, .html, .pdf or .png (default: SVG to output)"
    )
    size = parser.add_command("size", help="all lengths for a straight line of a length within a tolerance")
    size.add_argument("id", metavar="ID", help="of a sheet")
    size.add_argument("--length", required=True, metavar="L", help="with or without unit: 15cm")
    wanted = size.add_mutually_exclusive_group(required=True)
    wanted.add_argument("--ratio", type=float, metavar="Q", help="relative deviation Q_G: tolerance/length")
    wanted.add_argument("--tolerance", metavar="DY", help="the band allowed across the line: 0.75mm")

    for action in (listing, show, size):
        action.add_argument("--json", action="store_true", help="as JSON")


def run(arguments: argparse.Namespace) -> int:
    """List, show, draw or size."""
    match arguments.action:
        case "list":
            _list(arguments)
            return 0
        case "show":
            return _show(sheet(arguments.id), arguments)
        case "draw":
            _draw(sheet(arguments.id), arguments)
            return 0
    return _size(sheet(arguments.id), arguments)


def _list(arguments: argparse.Namespace) -> None:
    if arguments.json:
        items = [
            {
                "id": one.id,
                "title": {lang: one.record.title.in_language(lang) for lang in ("en", "de")},
                "source": one.record.source.in_language("en"),
            }
            for one in sheets().values()
        ]
        print_json(items)
        return
    rows = [
        (one.id, one.record.title.in_language(arguments.lang), one.record.source.in_language(arguments.lang))
        for one in sheets().values()
    ]
    print_table(_WORDS[arguments.lang]["list"], rows)


def _draw(one: Sheet, arguments: argparse.Namespace) -> None:
    from gruebler.drawing.canvas.files import suffix_of
    from gruebler.sheets.layout import page
    from gruebler.sheets.page import SUFFIXES

    suffix = "svg" if arguments.output is None else suffix_of(arguments.output, SUFFIXES)
    made = page(one, arguments.lang)
    if arguments.output is None:
        print_svg(made.svg())
    else:
        write_file(arguments.output, made.written(suffix), arguments.lang)


# --- show -------------------------------------------------------------------------------------------


def _show(one: Sheet, arguments: argparse.Namespace) -> int:
    """The sheet in words; status 1 if a value does not hold."""
    if arguments.json:
        print_json(_item(one, arguments.lang))
        return int(bool(one.wrong))
    lang, words = arguments.lang, _WORDS[arguments.lang]
    title = f"{one.record.title.in_language(lang)} ({one.id})"
    print(title, "-" * len(title), f"{words['source']}: {one.record.source.in_language(lang)}", sep="\n")
    for task in one.record.tasks:
        print(f"- {task.in_language(lang)}")
    print()
    for label, value in one.features.described(lang):
        print(f"{label}: {value}")
    print()
    values = [*one.dimensions, *one.quantities, *one.example_values]
    print_table(words["values"], [_row(value, lang) for value in values], numbers=(3,))
    for text in explanation_paragraphs(one, lang):
        print(f"\n{text}")
    print()
    _say_size(one, one.example, one.record.guide.unit, lang)
    return int(bool(one.wrong))


def _row(value: StatedValue, lang: str) -> tuple[str, ...]:
    words = _WORDS[lang]
    meaning = value.name.in_language(lang) if value.name else words["of"].format(of="".join(value.of))
    remark = "" if value.printed is None or value.of else words["right"]
    if value.reason is not None:
        remark = value.reason.in_language(lang)
    elif value.remark is not None:
        remark += f"; {value.remark.in_language(lang)}"
    whole = value.exact is not None and value.exact.text.isdigit()
    printed = value.printed.typeset if value.printed and not value.of else ""
    return (
        value.symbol,
        meaning,
        value.exact.typeset if value.exact else "",
        typeset_number(value.derived, lang, "g" if whole else ".6f") + value.unit,
        printed.replace(".", ",") if lang == "de" else printed,
        remark if value.holds else words["wrong"],
    )


def _item(one: Sheet, lang: str) -> dict[str, Any]:
    features = one.features
    return {
        "id": one.id,
        "title": one.record.title.in_language(lang),
        "source": one.record.source.in_language("en"),
        "tasks": [task.in_language(lang) for task in one.record.tasks],
        "mechanism": str(one.linkage.mechanism),
        "features": {
            "drive_joints": features.drive_joints,
            "drive_joints_at_frame": features.drive_joints_at_frame,
            "output_links": features.output_links,
            "output_links_at_frame": features.output_links_at_frame,
            "links": features.links,
            "links_by_joints": {str(k): count for k, count in features.links_by_joints},
            "joints": features.joints,
            "joints_by_symbol": dict(features.by_symbol("german" if lang == "de" else "international")),
        },
        "dimensions": [_value(value) for value in one.dimensions],
        "quantities": [_value(told) for told in (*one.quantities, *one.example_values)],
        "explanation": explanation_paragraphs(one, lang),
        "diagram": {
            "phi_G_deg": [math.degrees(angle) for angle in one.curve.widths],
            "ratio": one.curve.ratios.tolist(),
            "length": one.curve.lengths.tolist(),
        },
        "example": _sized_item(one.example, one.record.guide.unit),
        "literature": list(one.record.literature),
    }


def _value(value: StatedValue) -> dict[str, Any]:
    return {
        "symbol": value.symbol,
        "exact": value.exact.text if value.exact else None,
        "computed": value.derived,
        "printed": value.printed.text if value.printed else None,
        "as_printed": value.is_as_printed,
        "holds": value.holds,
    }


# --- size -------------------------------------------------------------------------------------------


def _size(one: Sheet, arguments: argparse.Namespace) -> int:
    """All lengths for a task; status 1 if no piece of the path is so straight."""
    length, unit = length_of("length", arguments.length)
    if arguments.ratio is None:
        tolerance = same_unit(*length_of("tolerance", arguments.tolerance), unit)
    elif math.isfinite(arguments.ratio) and 0 < arguments.ratio < 1:
        tolerance = arguments.ratio * length
    else:
        raise GrueblerError("--ratio: expected a number between 0 and 1, but found {ratio!r}", ratio=arguments.ratio)
    try:
        sized_mechanism = one.sized(length, tolerance)
    except LinkageError as error:
        print(error)
        return 1
    if arguments.json:
        print_json(_sized_item(sized_mechanism, unit))
    else:
        _say_size(one, sized_mechanism, unit, arguments.lang)
    return 0


def _say_size(one: Sheet, found: SizedMechanism, unit: str, lang: str) -> None:
    start, end = (math.degrees(angle) for angle in found.sizing.piece[:2])
    behind = f" {unit}" if unit else ""

    def said(value: float, form: str) -> str:
        return typeset_number(value, lang, form)

    text = _WORDS[lang]["size"].format(
        length=said(found.length, "g"),
        tolerance=said(found.tolerance, "g"),
        unit=behind,
        ratio=said(found.tolerance / found.length, "g"),
        width=said(end - start, ".4f"),
        start=said(start, ".4f"),
        end=said(end, ".4f"),
        scale=found.lengths[0][0],
        factor=said(found.ratio, ".6f"),
    )
    print(text)
    for (symbol, value), told in zip(found.lengths, one.dimensions, strict=True):
        exact = "" if told.exact is None or told.exact.text == "1" else f"{told.exact.typeset}·{found.lengths[0][0]} = "
        print(f"{symbol} = {exact}{said(value, '.4f')}{behind}")


def _sized_item(found: SizedMechanism, unit: str) -> dict[str, Any]:
    start, end = (math.degrees(angle) for angle in found.sizing.piece[:2])
    return {
        "length": found.length,
        "tolerance": found.tolerance,
        "unit": unit,
        "ratio": found.sizing.piece.ratio,
        "phi_G_deg": end - start,
        "phi_A_deg": start,
        "phi_E_deg": end,
        "length_by_scale": found.ratio,
        "lengths": dict(found.lengths),
    }
