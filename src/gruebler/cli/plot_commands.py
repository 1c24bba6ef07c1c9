"""The parser of `gruebler plot`. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

__all__ = ["add"]

_Commands = Any  # argparse's own type of a parser's commands is private


def add(commands: _Commands) -> None:
    """Add it to the parser of all commands."""
    plot = commands.add_parser(
        "plot",
        help="curves of a linkage: transfer functions, transmission angle, hodograph, coupler curves, Q_G",
        description="Plots of a linkage with one drive. transfer: the output and its derivatives of order 1 and 2, "
        "with dead centres. transmission: the transmission angle, with the band below 40 degrees. hodograph: the tips "
        "of velocity vectors. curves: paths of points. family: paths of points on a line of one link. ratio: Q_G and "
        "L/l1 of a straight-line guidance over its crank angle.",
        epilog="Examples: gruebler plot four-bar:25,70,40,70 --kind transmission -o mu.svg; gruebler plot lambda "
        "--kind family --count 7; gruebler plot mzc --kind ratio --ratio 0.005. Without -o the SVG goes to standard "
        "output. PNG and PDF need matplotlib: pip install 'gruebler[plot]'.",
    )
    plot.add_argument(
        "linkage", metavar="FILE|ID|LENGTHS", help="a file, a catalog entry, or lengths such as four-bar:25,70,40,70"
    )
    plot.add_argument(
        "--kind",
        choices=("transfer", "transmission", "hodograph", "curves", "family", "ratio"),
        default="transfer",
        help="what is plotted (default: transfer)",
    )
    plot.add_argument("--output", metavar="LINK", help="transfer, transmission: the link or sliding joint looked at")
    plot.add_argument(
        "--point",
        action="append",
        default=[],
        metavar="K",
        help="hodograph, curves, ratio: a named point or joint (default: all named points, for ratio the first); "
        "repeatable",
    )
    plot.add_argument("--speed", type=float, metavar="N", help="hodograph: turns a minute; of a slide, lengths by s")
    plot.add_argument("--link", metavar="LINK", help="family: the link that carries the points (default: a coupler)")
    plot.add_argument("--from", dest="start", metavar="U,V", help="family: the first point, write --from=-10,5")
    plot.add_argument("--to", dest="end", metavar="U,V", help="family: the last point (default: on a line of two pins)")
    plot.add_argument("--count", type=int, default=5, metavar="K", help="family: points, 2 to 8 (default: 5)")
    plot.add_argument(
        "--centre", type=float, default=180.0, metavar="DEG", help="ratio: the middle of the windows (default: 180)"
    )
    plot.add_argument("--ratio", type=float, metavar="Q", help="ratio: mark the window with this Q_G")
    plot.add_argument("--branch", metavar="LABELS", help="the assembly mode, such as +- (write --branch=-+)")
    plot.add_argument("--dark", action="store_true", help="PNG and PDF on dark ground; an SVG is on the reader's")
    plot.add_argument("-o", dest="file", type=Path, metavar="FILE", help="a file .svg, .png or .pdf")
    _finish(plot)


def _finish(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language of the answer (default: en)")
    parser.set_defaults(run="gruebler.cli.plot")
