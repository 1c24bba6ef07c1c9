"""The options of friction, for commands that ask what joints carry."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import message
from gruebler.cli.parser import Parser
from gruebler.mechanics.forces import Friction


def add_friction(parser: Parser) -> None:
    """The options that `friction_of` reads."""
    parser.take(
        """
        --friction [JOINT=]MU ...  coefficient of friction of all joints, or of one; repeatable
        --pin-radius [JOINT=]R ...  radius of the pins, in the linkage's unit; without it pins do not rub; repeatable
        --guide-length [JOINT=]L ...  length of the guides, between the edges at which a tilted block bears (default:
            long, blocks do not tilt); repeatable
        --guide-height [JOINT=]H ...  distance of the two faces of the guides (default: 0); repeatable
        --guide-on JOINT=LINK ...  the link with which the guide of a slide moves: the frame for a short bush through
            which a rod runs (default: the link that moves); repeatable
        --sleeve JOINT ...  a slide whose moving link surrounds the other one; matters with --guide-height; repeatable
        --backward  friction while the drive goes backward
        """
    )


def friction_of(arguments: argparse.Namespace) -> Friction | None:
    """What is said of friction; None if nothing is."""
    options = {
        "--pin-radius": arguments.pin_radius,
        "--guide-length": arguments.guide_length,
        "--guide-height": arguments.guide_height,
        "--guide-on": arguments.guide_on,
        "--sleeve": arguments.sleeve,
        "--backward": arguments.backward,
    }
    if not arguments.friction:
        for option, given in options.items():
            if given:
                raise GrueblerError("{option} needs --friction", option=option)
        return None
    sizes = {
        name: _by_joint(option, options[option])
        for name, option in (
            ("pin_radius", "--pin-radius"),
            ("guide_length", "--guide-length"),
            ("guide_height", "--guide-height"),
        )
        if options[option]
    }
    try:
        return Friction(
            _by_joint("--friction", arguments.friction),
            **sizes,
            guide_on=dict(_pair("--guide-on", text) for text in arguments.guide_on),
            sleeves=tuple(arguments.sleeve),
            backward=arguments.backward,
        )
    except LinkageError as error:
        key = error.values.get("name")
        option = "--friction" if key == "coefficient" else f"--{str(key).replace('_', '-')}"
        raise LinkageError(error.text, **{**error.values, "name": option}) from None


def _by_joint(option: str, given: Sequence[str]) -> dict[str, float]:
    """Numbers by joint, that of all others as ``*``; the last one for each joint counts."""
    numbers = {}
    for text in given:
        name, equals, value = text.rpartition("=")
        numbers[name.strip() if equals else "*"] = option_numbers(option, value, 1)[0]
    return numbers


def _pair(option: str, text: str) -> tuple[str, str]:
    joint, equals, link = text.rpartition("=")
    if not equals:
        raise GrueblerError(
            "{option}: expected {expected}, but found {found!r}", option=option, expected="JOINT=LINK", found=text
        )
    return joint.strip(), link.strip()


def option_numbers(option: str, text: str, count: int) -> list[float]:
    """So many finite numbers with commas between; `GrueblerError` names the option."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise GrueblerError(
            "{option}: expected {expected}, but found {found!r}",
            option=option,
            expected=message("two numbers X,Y") if count == 2 else message("a number"),
            found=text,
        )
    return numbers
