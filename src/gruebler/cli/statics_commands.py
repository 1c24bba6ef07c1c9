"""The parser of the command about forces. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

__all__ = ["add"]


def add(commands: Any) -> None:
    """Add `statics` to the parser of all commands."""
    statics: argparse.ArgumentParser = commands.add_parser(
        "statics",
        help="drive torque and joint forces of a linkage under loads",
        description="What the drive and the joints carry when forces act at points and moments on links: equilibrium "
        "of every link, and the drive's torque once more by virtual work. Torques are in force times the unit of the "
        "linkage. Without inertia; friction of slides as an estimate.",
        epilog="Example: gruebler statics slider-crank:20,50 --load 'R(coupler-slider)=-100,0' --friction 0.1. "
        "Exit status: 0 all well, 1 it cannot be moved all the way or is not held in some pose, 2 wrong usage or "
        "unreadable input.",
    )
    statics.add_argument(
        "linkage", metavar="FILE|ID|LENGTHS", help="a file, a catalog entry, or lengths such as four-bar:25,70,40,70"
    )
    statics.add_argument(
        "--load",
        action="append",
        default=[],
        metavar="POINT=FX,FY",
        help="a force at a point, a joint or LINK:X,Y; repeatable",
    )
    statics.add_argument(
        "--moment", action="append", default=[], metavar="LINK=M", help="a moment on a link, left about; repeatable"
    )
    statics.add_argument(
        "--mass", action="append", default=[], metavar="POINT=M", help="a mass that weighs M times 9.80665; repeatable"
    )
    statics.add_argument("--gravity", metavar="GX,GY", help="other than 0,-9.80665")
    statics.add_argument("--friction", type=float, metavar="MU", help="coefficient: friction of slides, an estimate")
    statics.add_argument(
        "--drive",
        action="append",
        default=[],
        metavar="FROM:TO:STEP",
        help="rows, in degrees or the unit; for several drives once each (default: a full turn, or the whole range)",
    )
    statics.add_argument("--at", action="append", type=float, default=[], metavar="VALUE", help="one row only")
    statics.add_argument("--branch", metavar="B", help="the assembly mode, such as + or +-; write --branch=- for minus")
    statics.add_argument("--json", action="store_true", help="an object with columns and rows, forces by components")
    statics.add_argument("-o", dest="csv", type=Path, metavar="FILE", help="the columns as CSV, units in its header")
    statics.add_argument("--lang", choices=("en", "de"), default="en", help="language of the answer (default: en)")
    statics.set_defaults(run="gruebler.cli.statics")
