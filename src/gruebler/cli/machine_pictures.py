"""What `gruebler cam`, `geneva` and `gears` do with -o: the machine as a picture, or moving."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from pathlib import Path

from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, message
from gruebler.cli.output import write_file
from gruebler.cli.parser import Parser
from gruebler.pictures.canvas import Figure
from gruebler.pictures.canvas.files import SUFFIXES, picture_bytes, suffix_of
from gruebler.pictures.canvas.moving_files import MOVING, moving_bytes
from gruebler.pictures.canvas.moving_picture import MovingPicture

_OPTIONS = ("at", "plot", "teeth", "animate", "seconds", "dark")
_FEW = ("gif", "webp", "png")


def add_picture_options(machine: Parser, *, help: str) -> None:
    """Options for the picture of a machine and for what is printed; ``help`` explains ``--seconds``."""
    machine.take("--animate  with -o: a moving picture")
    machine.add_argument("--seconds", type=float, metavar="S", help=help)
    machine.take("--dark  with -o: a dark background for PNG, GIF, WebP and PDF")


def refuse_picture(arguments: argparse.Namespace, why: Message) -> None:
    """`GrueblerError` with the reason if an option for pictures is given."""
    for option in ("out", *_OPTIONS):
        value = getattr(arguments, option, None)
        if option == "out" and is_printed(value):
            continue
        if value is not None and value is not False:
            raise GrueblerError("--{option}: {why}", option=option, why=why)


def angle_of(arguments: argparse.Namespace) -> float | None:
    """The angle of --at in radians."""
    if arguments.at is not None and not math.isfinite(arguments.at):
        raise GrueblerError("--at: expected a finite number of degrees, not {at}", at=arguments.at)
    return None if arguments.at is None else math.radians(arguments.at)


def is_few(arguments: argparse.Namespace) -> bool:
    """Whether the file holds single frames, which must not be too many."""
    return arguments.out is not None and arguments.out.suffix.lower().removeprefix(".") in _FEW


def is_printed(path: Path | None) -> bool:
    """Whether what is printed goes to standard output or into a file of text, not into a picture."""
    return path is None or path.suffix.lower() in (".txt", ".json")


def write_machine_picture(
    arguments: argparse.Namespace, still: Callable[[], Figure], moving: Callable[[float], MovingPicture]
) -> None:
    """Write the picture if a file is named; ``moving`` takes the seconds."""
    if is_printed(arguments.out):
        refuse_picture(arguments, message("needs a file for the picture: -o FILE"))
        return
    if not arguments.animate:
        if arguments.seconds is not None:
            raise GrueblerError("--seconds goes with --animate")
        suffix = suffix_of(arguments.out, SUFFIXES)
        write_file(arguments.out, picture_bytes(still(), suffix, dark=arguments.dark), arguments.lang)
        return
    if getattr(arguments, "at", None) is not None:
        raise GrueblerError("--at does not go with --animate, which shows all positions")
    suffix = suffix_of(arguments.out, MOVING)
    shown = moving(4.0 if arguments.seconds is None else arguments.seconds)
    write_file(arguments.out, moving_bytes(shown, suffix, dark=arguments.dark, lang=arguments.lang), arguments.lang)
