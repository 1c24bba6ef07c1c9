"""What `gruebler cam`, `geneva` and `gears` do with -o: the machine as a picture, or moving."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from pathlib import Path

from gruebler.cli.output import write_file
from gruebler.cli.parser import Parser
from gruebler.drawing.canvas import Figure
from gruebler.drawing.canvas.files import SUFFIXES, picture_bytes, suffix_of
from gruebler.drawing.canvas.moving_files import MOVING, moving_bytes
from gruebler.drawing.canvas.moving_picture import MovingPicture
from gruebler.errors import GrueblerError
from gruebler.text import Message, message

__all__ = ["add_picture_options", "angle_of", "is_few", "refuse_picture", "write_picture"]

_OPTIONS = ("at", "plot", "teeth", "animate", "seconds", "dark")
_FEW = ("gif", "webp", "png")


def add_picture_options(machine: Parser, time: str) -> None:
    """Options for the picture of a machine, besides its table."""
    machine.add_argument("-o", "--output", type=Path, metavar="FILE", help="also a picture: .svg, .png or .pdf")
    machine.add_argument(
        "--animate", action="store_true", help="with -o: moving, as .svg, .html, .gif, .webp or .png (APNG)"
    )
    machine.add_argument("--seconds", type=float, metavar="S", help=f"with --animate: for {time} (default: 4)")
    machine.add_argument("--dark", action="store_true", help="with -o: pictures and PDF on dark ground")


def refuse_picture(arguments: argparse.Namespace, why: Message) -> None:
    """`GrueblerError` if there is an option for pictures, with the reason ."""
    for option in ("output", *_OPTIONS):
        value = getattr(arguments, option, None)
        if value is not None and value is not False:
            raise GrueblerError("--{option}: {why}", option=option, why=why)


def angle_of(arguments: argparse.Namespace) -> float | None:
    """The angle of --at in radians."""
    if arguments.at is not None and not math.isfinite(arguments.at):
        raise GrueblerError("--at: expected a finite number of degrees, not {at}", at=arguments.at)
    return None if arguments.at is None else math.radians(arguments.at)


def is_few(arguments: argparse.Namespace) -> bool:
    """Whether the file is of pictures one after another, of which there are not many."""
    return arguments.output is not None and arguments.output.suffix.lower().removeprefix(".") in _FEW


def write_picture(
    arguments: argparse.Namespace, still: Callable[[], Figure], moving: Callable[[float], MovingPicture]
) -> None:
    """Write the picture if a file is named; ``moving`` is told the seconds."""
    if arguments.output is None:
        refuse_picture(arguments, message("needs a file for the picture: -o FILE"))
        return
    if not arguments.animate:
        if arguments.seconds is not None:
            raise GrueblerError("--seconds goes with --animate")
        suffix = suffix_of(arguments.output, SUFFIXES)
        write_file(arguments.output, picture_bytes(still(), suffix, dark=arguments.dark), arguments.lang)
        return
    if getattr(arguments, "at", None) is not None:
        raise GrueblerError("--at does not go with --animate, which shows all positions")
    suffix = suffix_of(arguments.output, MOVING)
    shown = moving(4.0 if arguments.seconds is None else arguments.seconds)
    write_file(arguments.output, moving_bytes(shown, suffix, dark=arguments.dark, lang=arguments.lang), arguments.lang)
