"""The parser of the command for dimensional synthesis. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

__all__ = ["add"]


def add(commands: Any) -> None:
    """Add `synthesise` with its kinds of tasks to the parser of all commands."""
    synthesise: argparse.ArgumentParser = commands.add_parser(
        "synthesise",
        help="linkages for a wanted motion: positions, a function, points, dead centres",
        description="All linkages for a task, each with its verdict: one circuit, one branch, the order of the task, "
        "full turn of the drive, minimum transmission angle.",
        epilog="Example: gruebler synthesise positions five.csv -o best.toml --draw designs.html. Exit status: 0 there "
        "is a design, 1 there is none, 2 wrong usage or unreadable input.",
    )
    kinds = synthesise.add_subparsers(dest="kind", metavar="KIND", required=True, parser_class=type(synthesise))
    file = "a .toml, .json or .csv file"
    positions = kinds.add_parser(
        "positions",
        help="a body carried through positions",
        description="Four-bars, slider-cranks and inverted slider-cranks that carry a body through positions x, y, "
        "angle: five and fewer exactly, more by least squares.",
    )
    positions.add_argument("task", metavar="TASK", help=f"{file}; CSV columns x,y,angle")
    function = kinds.add_parser(
        "function",
        help="input and output coordinated",
        description="Linkages whose output is a function of the crank angle: pairs of a table, or an expression.",
        epilog="Example: gruebler synthesise function 'log10(x)' --interval 1 2 --swings 60 60 --points 5 --minimax",
    )
    function.add_argument("task", metavar="TASK|EXPRESSION", help=f"{file} (CSV input,output), or such as 'log10(x)'")
    function.add_argument("--interval", type=float, nargs=2, metavar=("FROM", "TO"), help="of x, for an expression")
    function.add_argument(
        "--swings", type=float, nargs=2, metavar=("INPUT", "OUTPUT"), help="how far they turn, in degrees (or travel)"
    )
    function.add_argument("--starts", type=float, nargs=2, metavar=("INPUT", "OUTPUT"), help="fixed starts (free)")
    function.add_argument("--points", type=int, default=5, metavar="N", help="precision points (default: 5)")
    function.add_argument("--travel", action="store_true", help="the output is a slider")
    function.add_argument("--minimax", action="store_true", help="make the largest error as small as possible")
    path = kinds.add_parser(
        "path",
        help="a coupler point through points, or along a curve",
        description="Four-bars whose coupler point passes through points: nine points, five points and both fixed "
        "pivots, five points with crank angles, mixed tasks, each with all solutions; whole curves by least squares.",
    )
    path.add_argument("task", metavar="TASK", help=f"{file}; CSV columns x,y or x,y,crank or x,y,angle")
    path.add_argument("--closed", action="store_true", help="the points are a closed curve")
    path.add_argument("--structure", metavar="MECHANISM", help="fit this mechanism: a text or a catalog entry")
    path.add_argument("--link", default="", metavar="LINK", help="with --structure: the link that carries the point")
    dead = kinds.add_parser(
        "dead-centres",
        help="crank-rockers and slider-cranks with given dead centres",
        description="Crank-rockers of a swing, or slider-cranks of a stroke, whose dead centres lie a crank angle "
        "apart; the one with the best transmission angle first.",
        epilog="Example: gruebler synthesise dead-centres --swing 60 --time-ratio 1.2",
    )
    dead.add_argument("task", nargs="?", metavar="TASK", help=f"{file}, or options instead")
    dead.add_argument("--swing", type=float, metavar="DEG", help="of the rocker")
    dead.add_argument("--stroke", type=float, metavar="H", help="of the slider")
    dead.add_argument("--crank-angle", type=float, metavar="DEG", help="between the dead centres")
    dead.add_argument("--time-ratio", type=float, metavar="K", help="slow to quick travel")
    for kind in (positions, function, path, dead):
        kind.add_argument("--region", type=float, nargs=4, metavar=("X1", "Y1", "X2", "Y2"), help="for fixed pivots")
        kind.add_argument("--crank", action="store_true", help="only with a drive that turns fully")
        kind.add_argument("--transmission", type=float, default=0.0, metavar="DEG", help="minimum transmission angle")
        kind.add_argument("--size-ratio", type=float, default=1e4, metavar="R", help="longest by shortest length")
        kind.add_argument("--number", type=int, metavar="N", help="dyads or designs taken of infinitely many")
        kind.add_argument("--rejected", action="store_true", help="also print the rejected designs with their reasons")
        kind.add_argument("--json", action="store_true", help="as JSON, with all linkages")
        kind.add_argument("-o", "--output", type=Path, metavar="FILE", help="the best linkage as .toml or .json")
        kind.add_argument("--draw", type=Path, metavar="FILE", help="the designs: .html a page, .svg the best one")
        kind.add_argument("--lang", choices=("en", "de"), default="en", help="language of the answer (default: en)")
        kind.set_defaults(run="gruebler.cli.synthesise")
