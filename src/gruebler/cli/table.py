"""`gruebler table`: teaching tables."""

from __future__ import annotations

import argparse

from gruebler.base.errors import GrueblerError
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.fourbar.length_texts import size_of
from gruebler.teaching.exercises import lines_of_table, table_as_dict, teaching_table


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Tables for teaching, computed when they are printed: joints by degrees of freedom, links by "
        "joints and motion, the four inversions of a four-bar chain, four-bars by Grashof's condition with the "
        "smallest integer lengths, transfer functions of gears, linkages, cams and Geneva drives.",
        epilog="Examples: gruebler table grashof --lang de; gruebler table inversions 25,70,40,70",
    )
    parser.take(
        """
        name NAME {joints,links,inversions,grashof,transfer}  joints, links, inversions, grashof or transfer
        lengths LENGTHS ?  of the table inversions: other lengths a,b,c,d, such as 25,70,40,70
        """
    )
    parser.add_printed(help="print a list of objects with title, headers and rows")


def run(arguments: argparse.Namespace) -> int:
    """Print the tables of a name."""
    lengths: tuple[float, ...] = ()
    if arguments.lengths is not None:
        size = size_of(arguments.lengths)
        if not isinstance(size, FourBar):
            raise GrueblerError("expected four lengths such as 25,70,40,70, but found {word!r}", word=arguments.lengths)
        lengths = tuple(size.named.values())
    tables = teaching_table(arguments.name, lengths)
    if arguments.json:
        print_json([table_as_dict(table) for table in tables])
    else:
        print("\n\n".join("\n".join(lines_of_table(table, arguments.lang)) for table in tables))
    return 0
