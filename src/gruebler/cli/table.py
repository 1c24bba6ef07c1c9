"""`gruebler table`: teaching tables."""

from __future__ import annotations

import argparse

from gruebler.cli.output import print_json
from gruebler.exercises import lines_of_table, table_as_dict, teaching_table

__all__ = ["run"]


def run(arguments: argparse.Namespace) -> int:
    """Print the tables of a name."""
    tables = teaching_table(arguments.name)
    if arguments.json:
        print_json([table_as_dict(table) for table in tables])
    else:
        print("\n\n".join("\n".join(lines_of_table(table, arguments.lang)) for table in tables))
    return 0
