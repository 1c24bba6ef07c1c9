"""`gruebler convert`: a file in the format of another program."""

from __future__ import annotations

import argparse
from pathlib import Path

from gruebler.cli.output import say_left_out, say_written
from gruebler.cli.parser import Parser
from gruebler.cli.tables import Cell, print_table
from gruebler.errors import GrueblerError
from gruebler.text import message

__all__ = ["add", "run"]

_HEADERS = (message("format"), message("endings"), message("program"), message("what it holds"), message("lengths in"))


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Read a file in one format and write it in another: linkages of other programs, chains as graphs. "
        "What a format cannot hold is listed on standard error.",
        epilog="Example: gruebler convert leg.linkage2 leg.toml; gruebler convert chains.g6.gz chains.txt; "
        "gruebler convert --formats. Exit status: 0, 2 wrong usage or a file that cannot be read.",
    )
    parser.add_argument("source", nargs="?", metavar="IN", help="the file to read")
    parser.add_argument("target", nargs="?", metavar="OUT", help="the file to write")
    parser.add_argument("--from", dest="source_format", metavar="FORMAT", help="the format of IN (default: its ending)")
    parser.add_argument("--to", dest="target_format", metavar="FORMAT", help="the format of OUT (default: its ending)")
    parser.add_argument("--formats", action="store_true", help="list the formats, their endings and what they hold")


def run(arguments: argparse.Namespace) -> int:
    """The file written, and what was left out; or the table of formats."""
    from gruebler.files import FORMATS, convert

    lang = arguments.lang
    if arguments.formats:
        rows: list[list[Cell]] = [
            [form.name, " ".join(form.suffixes), form.title, form.carries, form.lengths or ""] for form in FORMATS
        ]
        print_table(_HEADERS, rows, lang=lang)
        return 0
    if arguments.source is None or arguments.target is None:
        raise GrueblerError("name the file to read and the file to write, or --formats for the list of formats")
    notes = convert(arguments.source, arguments.target, arguments.source_format, arguments.target_format)
    say_written(Path(arguments.target), lang)
    say_left_out(notes, lang)
    return 0
