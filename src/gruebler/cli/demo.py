"""`gruebler demo`: the main job shown on the whole catalog and four machines."""

from __future__ import annotations

import argparse

from gruebler.cli.check import explanation, print_checked
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_text
from gruebler.teaching.catalog import check_all, check_entry, entry

_EXPLAINED = ("vcomp", "diff", "loco3", "quad_strut")


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Check the whole catalog and explain a V-compressor, a differential, a locomotive and a braced "
        "four-bar."
    )


def run(arguments: argparse.Namespace) -> int:
    """Print the catalog's table, then the four explanations; 1 if a claim fails."""
    checked_entries = check_all()
    print_checked(checked_entries, arguments.lang)
    for id in _EXPLAINED:
        print_text("\n" + explanation(check_entry(entry(id).in_language(arguments.lang)), arguments.lang))
    return int(any(not checked_entry.holds for checked_entry in checked_entries))
