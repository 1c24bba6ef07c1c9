"""The parser of `gruebler freedoms`. Nothing heavy is imported."""

from __future__ import annotations

from typing import Any

__all__ = ["add"]


def add(commands: Any) -> None:
    """Add it to the parser of all commands."""
    freedoms = commands.add_parser(
        "freedoms",
        help="mobility with dimensions: counted, generic, at a pose, and finite",
        description="Mobility of a linkage with its dimensions, in a plane, on a sphere or in space: by formula, for "
        "almost all sizes, at a pose (rank, redundant joints) and finite (velocities followed), with the geometric "
        "reason where it is known.",
        epilog="Examples: gruebler freedoms winch_screw; gruebler freedoms four-bar:2,5,2,5 --at 0. Exit status: 0 it "
        "moves, 1 it does not (rigid, or only shaky), 2 wrong usage or unreadable input.",
    )
    freedoms.add_argument(
        "linkage",
        metavar="FILE|ID|LENGTHS",
        help="a .toml or .json file with sizes or joint screws, a catalog entry that has either, or "
        "four-bar:A,B,C,D, slider-crank:A,B[,E], inverted-slider-crank:A,D[,E]",
    )
    freedoms.add_argument(
        "--at",
        action="append",
        type=float,
        metavar="VALUE",
        help="the pose at this drive value, in degrees or the unit, of joint screws counted from home; for several "
        "drives once each (default: home, else a regular pose)",
    )
    freedoms.add_argument("--branch", metavar="B", help="the assembly mode, such as +-; write --branch=- for minus")
    freedoms.add_argument(
        "--tolerance",
        type=float,
        default=1e-8,
        metavar="T",
        help="singular values below that times the largest count as zero (default: 1e-8)",
    )
    freedoms.add_argument("--json", action="store_true", help="as JSON, with all singular values")
    freedoms.add_argument("--lang", choices=("en", "de"), default="en", help="language of the answer (default: en)")
    freedoms.set_defaults(run="gruebler.cli.freedoms")
