"""`gruebler sheet`: collection sheets, listed, explained, drawn, sized."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, Any

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.plain_data import plain
from gruebler.base.text import decimal_sign_in, error_in_language, joined, message, number, translate
from gruebler.cli.arguments import take
from gruebler.cli.linkage_inputs import linkage_of_word, spatial_of_word
from gruebler.cli.output import print_json, print_svg, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.tables import Cell, print_table
from gruebler.files.measured_lengths import length_of, same_unit
from gruebler.mechanics.fourbar.length_texts import size_of
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.sheets import Sheet, SizedMechanism, StatedValue, all_sheets, sheet
from gruebler.teaching.sheets.messages import explanation_paragraphs, typeset_number

if TYPE_CHECKING:
    from gruebler.teaching.worksheets import Document

_LIST = (message("id"), message("title"), message("source"))
_VALUES = (message("symbol"), message("meaning"), message("exact"), message("computed"), message("printed"), "")


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A collection sheet describes one mechanism: task, structure, access features, dimensions, how "
        "straight a point moves. All values are derived from the model.",
        epilog="Examples: gruebler sheet draw mzc -o sheet.pdf --lang de; gruebler sheet draw slider-crank:20,50 -o "
        "sheet.pdf; gruebler sheet book -o book.pdf; gruebler sheet size mzc --length 15cm --ratio 0.005. Exit "
        "status: 0 success, 1 a printed value differs (show) or no part of the path is straight "
        "enough (size), 2 wrong usage or unreadable input.",
    )
    listing = parser.add_command("list", help="list all sheets")
    show = parser.add_command("show", help="explain a sheet: features, dimensions, printed and computed values")
    show.take("id ID  id of a sheet")
    draw = parser.add_command("draw", help="draw a sheet as an A4 page")
    draw.take(
        """
        id ID|FILE|LENGTHS  id of a sheet; or any machine: a catalog entry, a file, lengths such as
            four-bar:25,70,40,70
        """
    )
    draw.add_out(
        help="a file: .svg, .html, .pdf or .png, of other machines .pdf, .html, .tex or .md (default: SVG, or "
        "Markdown, to standard output)",
        endings=("svg", "html", "pdf", "png", "tex", "md"),
    )
    book = parser.add_command("book", help="all machines of the catalog in one document, with an index by feature")
    book.take("ids ID *  only these machines (default: all)")
    book.add_out(help="a file: .pdf, .html, .tex or .md", required=True, endings=("pdf", "html", "tex", "md"))
    size = parser.add_command("size", help="all lengths for a straight line of a length within a band")
    size.take(
        """
        id ID  id of a sheet
        --length L !  length of the line, with or without unit: 15cm
        """
    )
    take(
        size.add_mutually_exclusive_group(required=True),
        """
        --ratio Q float  relative deviation Q_G = band/length
        --band WIDTH  allowed deviation across the line: 0.75mm
        """,
    )
    listing.add_printed(help="print a list of objects")
    show.add_printed(help="print an object with all values")
    size.add_printed(help="print an object with all lengths")


def run(arguments: argparse.Namespace) -> int:
    """List, show, draw or size."""
    match arguments.action:
        case "list":
            _list(arguments)
            return 0
        case "show":
            return _show(sheet(arguments.id), arguments)
        case "draw":
            if arguments.id in all_sheets():
                _draw(sheet(arguments.id), arguments)
            else:
                _draw_machine(arguments)
            return 0
        case "book":
            _book(arguments)
            return 0
    return _size(sheet(arguments.id), arguments)


def _list(arguments: argparse.Namespace) -> None:
    records = [each.record for each in all_sheets().values()]
    items = [
        {
            "id": record.id,
            "title": {lang: record.title.in_language(lang) for lang in ("en", "de")},
            "source": record.source.in_language("en"),
        }
        for record in records
    ]
    lang = arguments.lang
    rows = [(record.id, record.title.in_language(lang), record.source.in_language(lang)) for record in records]
    if arguments.json:
        print_json(items)
    else:
        print_table(_LIST, rows, lang=lang)


def _draw(mechanism_sheet: Sheet, arguments: argparse.Namespace) -> None:
    if arguments.out is not None and arguments.out.suffix.lower() in (".tex", ".md"):
        raise GrueblerError("this sheet has a page of its own: end the name with .svg, .html, .pdf or .png")
    from gruebler.teaching.sheets.layout import page

    sheet_page = page(mechanism_sheet, arguments.lang)
    if arguments.out is None:
        print_svg(sheet_page.svg())
    else:
        suffix = arguments.out.suffix.lower().removeprefix(".")
        write_file(arguments.out, sheet_page.written(suffix), arguments.lang)


def _draw_machine(arguments: argparse.Namespace) -> None:
    """The sheet of any machine."""
    if arguments.out is not None and arguments.out.suffix.lower() in (".svg", ".png"):
        raise GrueblerError(
            "the sheet of a machine has several pages: end the name with .pdf, .html, .tex or .md, not with {suffix}",
            suffix=arguments.out.suffix,
        )
    from gruebler.teaching.catalog import entries
    from gruebler.teaching.worksheets import machine_document

    word, lang = arguments.id, arguments.lang
    if word in entries():
        document = machine_document(entries()[word], lang=lang)
    elif "(" in word:
        document = machine_document(Mechanism.parse(word), lang=lang)
    elif (spatial := spatial_of_word(word, lang)) is not None:
        document = machine_document(spatial.linkage, lang=lang)
    else:
        linkage, between = linkage_of_word(word, lang)
        size = size_of(word)
        name = "" if size is None else size.type.name(lang)
        document = machine_document(linkage, between=between, lang=lang, name=name)
    _write(document, arguments)


def _book(arguments: argparse.Namespace) -> None:
    from gruebler.teaching.catalog import entry
    from gruebler.teaching.worksheets import catalog_book

    for id in arguments.ids:
        entry(id)
    _write(catalog_book(lang=arguments.lang, ids=arguments.ids), arguments)


def _write(document: Document, arguments: argparse.Namespace) -> None:
    from gruebler.teaching.worksheets import document_bytes

    if arguments.out is None:
        print_svg(document_bytes(document, "md").decode("utf-8"))
    else:
        suffix = arguments.out.suffix.lower().removeprefix(".")
        write_file(arguments.out, document_bytes(document, suffix), arguments.lang)


# --- show -------------------------------------------------------------------------------------------


def _show(mechanism_sheet: Sheet, arguments: argparse.Namespace) -> int:
    """Explain the sheet; status 1 if a value does not hold."""
    if arguments.json:
        print_json(_item(mechanism_sheet, arguments.lang))
    else:
        _print(mechanism_sheet, arguments.lang)
    return int(bool(mechanism_sheet.wrong))


def _print(mechanism_sheet: Sheet, lang: str) -> None:
    title = f"{mechanism_sheet.record.title.in_language(lang)} ({mechanism_sheet.id})"
    print(title, "-" * len(title), sep="\n")
    print(translate("Source: {source}", lang, source=mechanism_sheet.record.source.in_language(lang)))
    for task in mechanism_sheet.record.tasks:
        print(f"- {task.in_language(lang)}")
    print()
    for label, value in mechanism_sheet.features.described(lang):
        print(f"{label}: {value}")
    print()
    values = [*mechanism_sheet.dimensions, *mechanism_sheet.quantities, *mechanism_sheet.example_values]
    print_table(_VALUES, [_row(value, lang) for value in values], numbers=(3,), lang=lang)
    for text in explanation_paragraphs(mechanism_sheet, lang):
        print(f"\n{text}")
    print()
    _print_size(mechanism_sheet, mechanism_sheet.example, mechanism_sheet.record.guide.unit, lang)


def _row(value: StatedValue, lang: str) -> tuple[Cell, ...]:
    name = value.name.in_language(lang) if value.name else translate("length {points}", lang, points="".join(value.of))
    whole = value.exact is not None and value.exact.text.isdigit()
    printed = value.printed.typeset if value.printed and not value.of else ""
    return (
        value.symbol,
        name,
        value.exact.typeset if value.exact else "",
        typeset_number(value.derived, lang, "g" if whole else ".6f") + value.unit,
        decimal_sign_in(printed, lang),
        _remark(value, lang),
    )


def _remark(value: StatedValue, lang: str) -> Cell:
    if not value.holds:
        return message("WRONG")
    if value.reason is not None:
        return value.reason.in_language(lang)
    as_printed = "" if value.printed is None or value.of else message("as printed")
    return joined(filter(None, [as_printed, value.remark.in_language(lang)]), "; ") if value.remark else as_printed


def _item(mechanism_sheet: Sheet, lang: str) -> dict[str, Any]:
    features = mechanism_sheet.features
    return {
        "id": mechanism_sheet.id,
        "title": mechanism_sheet.record.title.in_language(lang),
        "source": mechanism_sheet.record.source.in_language("en"),
        "tasks": [task.in_language(lang) for task in mechanism_sheet.record.tasks],
        "mechanism": str(mechanism_sheet.linkage.mechanism),
        "features": {
            **plain(features, "drive_joints drive_joints_at_frame output_links output_links_at_frame links"),
            "links_by_joints": {str(k): count for k, count in features.links_by_joints},
            "joints": features.joints,
            "joints_by_symbol": dict(features.by_symbol(Alphabet.of_language(lang))),
        },
        "dimensions": [_value(value) for value in mechanism_sheet.dimensions],
        "quantities": [_value(value) for value in (*mechanism_sheet.quantities, *mechanism_sheet.example_values)],
        "explanation": explanation_paragraphs(mechanism_sheet, lang),
        "diagram": {
            "phi_G_deg": [math.degrees(angle) for angle in mechanism_sheet.curve.widths],
            "ratio": mechanism_sheet.curve.ratios.tolist(),
            "length": mechanism_sheet.curve.lengths.tolist(),
        },
        "example": _sized_item(mechanism_sheet.example, mechanism_sheet.record.guide.unit),
        "literature": list(mechanism_sheet.record.literature),
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


def _size(mechanism_sheet: Sheet, arguments: argparse.Namespace) -> int:
    """All lengths for a task; status 1 if no piece of the path is so straight."""
    length, unit = length_of("--length", arguments.length)
    if arguments.ratio is None:
        tolerance = same_unit(*length_of("--band", arguments.band), unit)
    elif math.isfinite(arguments.ratio) and 0 < arguments.ratio < 1:
        tolerance = arguments.ratio * length
    else:
        raise GrueblerError("--ratio: expected a number between 0 and 1, but found {ratio!r}", ratio=arguments.ratio)
    try:
        sized = mechanism_sheet.sized(length, tolerance)
    except LinkageError as error:
        print(error_in_language(error, arguments.lang))
        return 1
    if arguments.json:
        print_json(_sized_item(sized, unit))
    else:
        _print_size(mechanism_sheet, sized, unit, arguments.lang)
    return 0


def _print_size(mechanism_sheet: Sheet, sized: SizedMechanism, unit: str, lang: str) -> None:
    start, end = (math.degrees(angle) for angle in (sized.sizing.piece.start, sized.sizing.piece.end))
    unit, scale = f" {unit}" if unit else "", sized.lengths[0][0]
    print(
        translate(
            "L = {length:g}{unit} within {band:g}{unit}: Q_G = {ratio:g}, φ_G = {width:.4f}°, from φ_A = {start:.4f}° "
            "to φ_E = {end:.4f}°, L/{scale} = {factor:.6f}.",
            lang,
            length=sized.length,
            band=sized.tolerance,
            unit=unit,
            ratio=sized.tolerance / sized.length,
            width=end - start,
            start=start,
            end=end,
            scale=scale,
            factor=sized.ratio,
        )
    )
    for (symbol, length), stated in zip(sized.lengths, mechanism_sheet.dimensions, strict=True):
        exact = stated.exact
        product = "" if exact is None or exact.text == "1" else f"{exact.typeset}·{scale} = "
        print(f"{symbol} = {product}{number(length, lang, '.4f')}{unit}")


def _sized_item(sized: SizedMechanism, unit: str) -> dict[str, Any]:
    start, end = (math.degrees(angle) for angle in (sized.sizing.piece.start, sized.sizing.piece.end))
    return {
        **plain(sized, "length tolerance"),
        "unit": unit,
        "ratio": sized.sizing.piece.ratio,
        "phi_G_deg": end - start,
        "phi_A_deg": start,
        "phi_E_deg": end,
        "length_by_scale": sized.ratio,
        "lengths": dict(sized.lengths),
    }
