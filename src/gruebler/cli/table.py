"""`gruebler table`: teaching tables."""

from __future__ import annotations

import argparse

from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.exercises import lines_of_table, table_as_dict, teaching_table

__all__ = ["add", "run"]


_TABLES = ("joints", "links", "inversions", "grashof", "transfer")


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Tables for teaching, computed when they are printed: joints by degrees of freedom, links by "
        "joints and motion, the four inversions of a four-bar chain, four-bars by Grashof's condition with the "
        "smallest integer lengths, transfer functions of gears, linkages, cams and Geneva drives.",
        epilog="Example: gruebler table grashof --lang de",
    )
    parser.add_argument("name", choices=_TABLES, metavar="NAME", help="joints, links, inversions, grashof or transfer")
    parser.add_printed(help="print a list of objects with title, headers and rows")


def run(arguments: argparse.Namespace) -> int:
    """Print the tables of a name."""
    tables = teaching_table(arguments.name)
    if arguments.json:
        print_json([table_as_dict(table) for table in tables])
    else:
        print("\n\n".join("\n".join(lines_of_table(table, arguments.lang)) for table in tables))
    return 0
