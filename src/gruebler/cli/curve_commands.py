"""The parser of the command about coupler curves. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

__all__ = ["add"]


def add(commands: Any) -> None:
    """Add `curve` to the parser of all commands."""
    curve: argparse.ArgumentParser = commands.add_parser(
        "curve",
        help="the path of a point: length, area, cusps, inflections, vertices, double points",
        description="The path of a point over a whole turn of the drive, or its whole range, with all that is on it; "
        "drive values, places, radii.",
        epilog="Example: gruebler curve four-bar:25,70,40,70 coupler:45,40; gruebler curve lambda C --contact 180. "
        "A point whose link has another name is written LINK:X,Y in the coordinates of its link.",
    )
    curve.add_argument(
        "linkage", metavar="FILE|ID|LENGTHS", help="a file, a catalog entry, or lengths such as four-bar:25,70,40,70"
    )
    curve.add_argument("point", metavar="POINT|LINK:X,Y", help="a named point, a joint, or a point of a link")
    curve.add_argument(
        "--drive",
        action="append",
        default=[],
        metavar="FROM:TO:STEP",
        help="a straight path of the drives, in degrees or the unit, for several drives once each with as many steps; "
        "one number holds a drive still (default: the whole motion of one drive)",
    )
    curve.add_argument("--branch", metavar="B", help="the assembly mode, such as + or +-; write --branch=- for minus")
    curve.add_argument("--direction", type=float, metavar="DEG", help="turning points along this, not along x and y")
    curve.add_argument(
        "--contact", type=float, action="append", default=[], metavar="VALUE", help="how the tangent touches there"
    )
    curve.add_argument("--tolerance", type=float, metavar="LENGTH", help="of the polygon (default: 1e-4 of the reach)")
    curve.add_argument("--json", action="store_true", help="as JSON")
    curve.add_argument("-o", dest="csv", type=Path, metavar="FILE", help="the polygon as CSV: drive, x, y, way")
    curve.add_argument("--lang", choices=("en", "de"), default="en", help="language of the answer (default: en)")
    curve.set_defaults(run="gruebler.cli.curve")
