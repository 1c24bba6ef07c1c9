"""`gruebler inversions`: the mechanisms that a chain gives with another frame, or with another frame and drive."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message, translate
from gruebler.cli.inputs import chain_from_word
from gruebler.cli.link_names import language_of_names
from gruebler.cli.output import print_items, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.mechanics.fourbar import SizedInversion, double_slide_inversions, sized_inversions
from gruebler.mechanics.fourbar.length_texts import is_lengths, size_of
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism.inversion import DrivenMechanism, driven_mechanisms, family, inversions

_DOUBLE_SLIDE = "double-slide:"
_PICTURES = (".html", ".pdf")
_HEADERS = {
    "frame": message("frame"),
    "drive": message("drive"),
    "output": message("output"),
    "family": message("family"),
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="List the mechanisms of a chain: one for each frame, or for each frame and drive. Choices that are "
        "equal by the symmetry of the chain are listed once.",
        epilog="Examples: gruebler inversions 'R(0-1) R(1-2) R(2-3) P(0-3)'; gruebler inversions four-bar:2,5,4,5 "
        "-o inversions.html; gruebler inversions wiper --drives "
        "--with-output --text | gruebler check -.",
    )
    parser.take(
        """
        chain CHAIN  a chain such as 'R(0-1) R(1-2) R(2-3) R(3-0)', a code, g6:CODE or a catalog entry; or lengths:
            four-bar:2,5,4,5, slider-crank:20,50, double-slide:40
        --space
        --drives  choose frame and drives
        --anywhere  also drives between moving links
        --number D int =1  number of drives (default: 1)
        --with-output  choose an output link as well
        --text  one mechanism per line, as other commands read it
        --count
        """
    )
    parser.add_json(help="print an object with count and items")
    parser.add_out(
        help="write into a file instead: every inversion drawn to scale, .html or .pdf; or what is printed: .txt, or "
        ".json as with --json"
    )
    parser.set_defaults(written=_PICTURES)


def run(arguments: argparse.Namespace) -> int:
    """List or count the inversions of one chain."""
    word = arguments.chain
    if is_lengths(word) or word.startswith(_DOUBLE_SLIDE):
        return _sized(word, arguments)
    _check(arguments)
    chain = chain_from_word(arguments.chain, arguments.space, language_of_names(arguments))
    if arguments.drives:
        drivens = list(
            driven_mechanisms(
                chain, drives=arguments.number, at_frame=not arguments.anywhere, output=arguments.with_output
            )
        )
    else:
        drivens = [DrivenMechanism(mechanism) for mechanism in inversions(chain)]
    show = _print_texts if arguments.text else _print
    print_items(arguments, drivens, item, lambda: show(drivens, arguments.lang))
    if not any((arguments.drives, arguments.text, arguments.count, arguments.json, arguments.out)):
        _print_forms(chain, arguments.lang)
    return 0


def _print_forms(chain: Chain, lang: str) -> None:
    """Which forms the mechanisms have, by their lengths."""
    from gruebler.teaching.exercises import forms_of_chain, lines_of_table

    for table in forms_of_chain(chain):
        print("", *lines_of_table(table, lang), sep="\n")


def _check(arguments: argparse.Namespace) -> None:
    """Raise `GrueblerError` for options that do not go together."""
    if arguments.out is not None and arguments.out.suffix.lower() in _PICTURES:
        raise GrueblerError(
            "pictures to scale need lengths, such as four-bar:2,5,4,5; gruebler gallery draws the structures"
        )
    if arguments.drives:
        return
    for option, given in (
        ("--with-output", arguments.with_output),
        ("--anywhere", arguments.anywhere),
        ("--number", arguments.number != 1),
    ):
        if given:
            raise GrueblerError("{option} needs --drives", option=option)


def _sized(word: str, arguments: argparse.Namespace) -> int:
    """The mechanisms of a chain of given lengths: each frame with each drive there."""
    for option in ("drives", "anywhere", "with_output", "text"):
        if getattr(arguments, option):
            raise GrueblerError(
                "{option} lists mechanisms of a chain without lengths", option="--" + option.replace("_", "-")
            )
    if word.startswith(_DOUBLE_SLIDE):
        sized = double_slide_inversions(*_one_length(word.removeprefix(_DOUBLE_SLIDE)))
    else:
        size = size_of(word)
        assert size is not None  # is_lengths
        sized = sized_inversions(size)
    lang, path = arguments.lang, arguments.out
    if path is not None and path.suffix.lower() in _PICTURES:
        write_file(path, _page(word, sized, path, lang), lang)
        return 0
    headers = (message("frame"), message("drive"), message("mechanism"))
    print_items(
        arguments,
        sized,
        lambda each: {"frame": each.frame, "drive": each.drive, "type": each.type.in_language(lang)},
        lambda: print_table(headers, [(each.frame, each.drive, each.type) for each in sized], lang=lang),
    )
    return 0


def _one_length(text: str) -> tuple[float]:
    try:
        return (float(text),)
    except ValueError:
        raise GrueblerError("double-slide: expected a length, but found {text!r}", text=text) from None


def _page(word: str, sized: Sequence[SizedInversion], path: Path, lang: str) -> bytes:
    """The mechanisms to scale, one picture for each frame, drives that give the same mechanism together."""
    from gruebler.pictures.canvas import gallery_html
    from gruebler.pictures.canvas.gallery import Item, Section
    from gruebler.pictures.linkage.picture import draw_linkage

    items = []
    for each in sized:
        name = each.type.in_language(lang)
        caption = translate("frame {frame}, drive {drive}: {name}", lang, frame=each.frame, drive=each.drive, name=name)
        items.append(Item(draw_linkage(each.linkage, labels=True, lang=lang, name=name), caption))
    title = translate("Inversions of {chain}", lang, chain=word)
    sections = [Section("", tuple(items), wide=True)]
    if path.suffix.lower() == ".html":
        return gallery_html(title, sections, lang=lang).encode("utf-8")
    from gruebler.pictures.canvas.matplotlib_files import gallery_pdf

    return gallery_pdf(title, sections)


def item(driven: DrivenMechanism) -> dict[str, object]:
    """One item of a JSON list: code, text, and family and output if there are any."""
    mechanism = driven.mechanism
    document: dict[str, object] = {"code": mechanism.code(), "text": driven.text()}
    if (name := family(mechanism)) is not None:
        document["family"] = name
    if driven.output is not None:
        document["output"] = driven.output
    return document


def _row(driven: DrivenMechanism, lang: str) -> dict[str, str]:
    mechanism = driven.mechanism
    return {
        "frame": mechanism.frame,
        "drive": ", ".join(mechanism.drive_names(Alphabet.of_language(lang))),
        "output": driven.output or "",
        "family": family(mechanism, lang) or "",
    }


def _print_texts(drivens: Sequence[DrivenMechanism], _: str) -> None:
    for driven in drivens:
        print(driven)


def _print(drivens: Sequence[DrivenMechanism], lang: str) -> None:
    """The table, without a column that is empty in every row."""
    rows = [_row(driven, lang) for driven in drivens]
    keys = [key for key in _HEADERS if key == "frame" or any(row[key] for row in rows)]
    print_table([_HEADERS[key].in_language(lang) for key in keys], [[row[key] for key in keys] for row in rows])
