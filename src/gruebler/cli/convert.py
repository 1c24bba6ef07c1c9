"""`gruebler convert`: a file, a catalog entry or lengths in the format of another program."""

from __future__ import annotations

import argparse
from pathlib import Path

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.cli.inputs import chain_from_word
from gruebler.cli.left_out import say_left_out
from gruebler.cli.linkage_inputs import linkage_of_word, spatial_of_word
from gruebler.cli.output import say_written
from gruebler.cli.parser import Parser
from gruebler.cli.tables import Cell, print_table
from gruebler.mechanics.fourbar.length_texts import is_lengths

_HEADERS = (message("format"), message("endings"), message("program"), message("what it holds"), message("lengths in"))


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Read a file in one format and write it in another: linkages of other programs, chains as graphs. "
        "What a format cannot hold is listed on standard error.",
        epilog="Example: gruebler convert leg.linkage2 leg.toml; gruebler convert wiper wiper.dxf; gruebler convert "
        "four-bar:25,70,40,70 four-bar.mjcf; gruebler convert chains.g6.gz chains.txt; gruebler convert --formats. "
        "Exit status: 0, 2 wrong usage or a file that cannot be read.",
    )
    parser.take(
        """
        source IN ?  the file to read, a catalog entry, lengths such as four-bar:25,70,40,70, or the text of a chain
        target OUT ?  the file to write
        --from FORMAT >source_format  the format of IN (default: its ending)
        --to FORMAT >target_format  the format of OUT (default: its ending)
        --formats  list the formats, their endings and what they hold
        """
    )
    parser.add_out(help="the file to write, in place of OUT")


def _is_file(word: str) -> bool:
    """Whether a word is the name of a file: one that is there, or by its ending or folder."""
    path = Path(word)
    if path.is_file() or "(" in word or ":" in word:
        return path.is_file()
    return not is_lengths(word) and (path.suffix != "" or len(path.parts) > 1)


def _write_value(word: str, target: str, form: str | None, notes: list[Message]) -> None:
    """The linkage of lengths or of a catalog entry with dimensions and loads, else the chain of a text or an entry."""
    from gruebler.files.structures import is_structure_text
    from gruebler.files.values import format_of, write, write_loaded
    from gruebler.teaching.catalog import entry

    if (spatial := spatial_of_word(word)) is not None:
        moves = format_of(target, form).write_between is not None
        write(spatial.linkage, target, between=spatial.range if moves else None, format_name=form, left_out=notes)
        return
    lengths = is_lengths(word) or (":" in word and "(" not in word)
    if is_structure_text(word) or not (lengths or entry(word).dimensions is not None):
        write(chain_from_word(word), target, format_name=form, left_out=notes)
    elif lengths or entry(word).loads is None:
        write(linkage_of_word(word, unit="mm")[0], target, format_name=form, left_out=notes)
    else:
        write_loaded(*entry(word).loaded(), Path(target), form, notes)


def run(arguments: argparse.Namespace) -> int:
    """The file written, and what was left out; or the table of formats."""
    from gruebler.files.formats import FORMATS
    from gruebler.files.values import convert

    lang = arguments.lang
    if arguments.formats:
        rows: list[list[Cell]] = [
            [form.name, " ".join(form.suffixes), form.title, form.carries, form.lengths or ""] for form in FORMATS
        ]
        print_table(_HEADERS, rows, lang=lang)
        return 0
    targets = [each for each in (arguments.target, arguments.out) if each is not None]
    if arguments.source is None or len(targets) != 1:
        raise GrueblerError("name the file to read and the file to write, or --formats for the list of formats")
    (target,) = targets
    if arguments.source_format is not None or _is_file(arguments.source):
        notes = convert(arguments.source, target, arguments.source_format, arguments.target_format)
    else:
        notes = []
        _write_value(arguments.source, target, arguments.target_format, notes)
    say_written(Path(target), lang)
    say_left_out(notes, lang)
    return 0
