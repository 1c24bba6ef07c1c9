"""The parser of the commands about collection sheets. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

__all__ = ["add"]


def add(commands: Any) -> None:
    """Add `sheet` to the parser of all commands."""
    sheet: argparse.ArgumentParser = commands.add_parser(
        "sheet",
        help="collection sheets: a mechanism on one page, with access features, dimensions, diagram",
        description="A collection sheet tells one mechanism: task, structure, access features, dimensions, how "
        "straight a point runs. Everything but the words is derived from the model.",
        epilog="Example: gruebler sheet draw mzc -o sheet.pdf --lang de; gruebler sheet size mzc --length 15cm "
        "--ratio 0.005. Exit status: 0 all well, 1 a printed value differs (show) or no piece is so straight (size), "
        "2 wrong usage or unreadable input.",
    )
    actions = sheet.add_subparsers(dest="action", metavar="ACTION", required=True)
    _finish(actions.add_parser("list", help="all sheets"))
    show = actions.add_parser("show", help="one sheet in words: features, dimensions, what is printed and what is so")
    show.add_argument("id", metavar="ID", help="of a sheet")
    _finish(show)
    draw = actions.add_parser("draw", help="one sheet as a page to be printed on A4")
    draw.add_argument("id", metavar="ID", help="of a sheet")
    draw.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="a file .svg, .html, .pdf or .png (default: SVG to output)"
    )
    _finish(draw, json=False)
    size = actions.add_parser("size", help="all lengths for a straight line of a length within a tolerance")
    size.add_argument("id", metavar="ID", help="of a sheet")
    size.add_argument("--length", required=True, metavar="L", help="with or without unit: 15cm")
    wanted = size.add_mutually_exclusive_group(required=True)
    wanted.add_argument("--ratio", type=float, metavar="Q", help="relative deviation Q_G: tolerance/length")
    wanted.add_argument("--tolerance", metavar="DY", help="the band allowed across the line: 0.75mm")
    _finish(size)


def _finish(action: argparse.ArgumentParser, *, json: bool = True) -> None:
    if json:
        action.add_argument("--json", action="store_true", help="as JSON")
    action.add_argument("--lang", choices=("en", "de"), default="en", help="language of the output (default: en)")
    action.set_defaults(run="gruebler.cli.sheet")
