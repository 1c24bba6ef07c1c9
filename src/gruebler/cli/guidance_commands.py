"""The parser of the command about straight-line linkages by name. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from typing import Any

__all__ = ["add"]


def add(commands: Any) -> None:
    """Add `guidance` to the parser of all commands."""
    guidance: argparse.ArgumentParser = commands.add_parser(
        "guidance",
        help="straight-line linkages by name: exact or approximate, length, band, order of contact, size for a task",
        description="Straight-line linkages named after their finders. Without a name all of them; with one its "
        "proportions, and with --length and --tolerance the size that is straight within the tolerance over the "
        "length. With --lambda or --kappa Meyer zur Capellen's double rocker and the four-bar that replaces it.",
        epilog="Example: gruebler guidance lambda --length 15cm --tolerance 0.75mm; gruebler guidance --kappa 20. Exit "
        "status: 0, 1 no piece is so straight, 2 wrong usage.",
    )
    guidance.add_argument("name", nargs="?", metavar="NAME", help="such as watt, lambda, peaucellier")
    guidance.add_argument("--length", metavar="L", help="of the straight line wanted, with or without unit: 15cm")
    guidance.add_argument("--tolerance", metavar="DY", help="the band allowed across the line: 0.75mm")
    guidance.add_argument(
        "--lambda",
        dest="ratio",
        type=float,
        metavar="X",
        help="0.5 to 1.5: distance of the coupler from the tangent, by D",
    )
    guidance.add_argument(
        "--phi0", type=float, metavar="DEG", help="with --lambda: another angle than that of contact in six points"
    )
    guidance.add_argument("--kappa", type=float, metavar="DEG", help="the line's angle against the frame: both lambda")
    guidance.add_argument(
        "--diameter", type=float, metavar="D", help="with --lambda or --kappa: of the inflection circle (default: 1)"
    )
    guidance.add_argument("--json", action="store_true", help="as JSON")
    guidance.add_argument("--lang", choices=("en", "de"), default="en", help="language of the output (default: en)")
    guidance.set_defaults(run="gruebler.cli.guidance")
