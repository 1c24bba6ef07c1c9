"""All commands by what they are for, and what `gruebler` alone and `gruebler help` show. It imports nothing heavy."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from importlib import import_module
from shutil import get_terminal_size
from typing import Any, NamedTuple

from gruebler.cli.parser import Parser
from gruebler.errors import GrueblerError, nearest
from gruebler.text import Message, message, translate

__all__ = ["GROUPS", "Command", "command", "command_names", "overview"]


class Command(NamedTuple):
    """A command: its module has `add`, which gives a parser its arguments, and `run`."""

    name: str
    summary: Message

    def module(self) -> Any:
        """The module, which may take some time to import."""
        return import_module(f"gruebler.cli.{self.name.replace('-', '_')}")

    def parser(self, lang: str = "en") -> Parser:
        """A parser of its arguments."""
        parser = Parser(prog=f"gruebler {self.name}", lang=lang)
        self.module().add(parser)
        return parser


GROUPS: tuple[tuple[Message, tuple[Command, ...]], ...] = (
    (
        message("Structure"),
        (
            Command("check", message("count the freedoms of chains and check the count")),
            Command("freedoms", message("mobility with dimensions: counted, generic, at a pose, and finite")),
            Command("enumerate", message("every chain of so many links, each once")),
            Command("assortments", message("how many binary, ternary, ... links a chain can have")),
            Command("inversions", message("the mechanisms that a chain gives with another frame or drive")),
            Command("variants", message("every typed chain or mechanism that answers requirements")),
            Command("assur", message("take a mechanism apart into Assur groups, or list all groups")),
            Command("derive", message("how a chain grows from a closed loop by dyads, or why not")),
            Command("extend", message("all different chains that one more dyad or coupler gives")),
        ),
    ),
    (
        message("Dimensions and motion"),
        (
            Command("analyse", message("what a linkage does: dead centres, times, transmission angle, poses, rates")),
            Command("synthesise", message("linkages for a wanted motion: positions, a function, points, dead centres")),
            Command("realise", message("find dimensions with which a mechanism moves")),
            Command("grashof", message("the type of a four-bar, which links turn fully, and for which lengths")),
            Command("statics", message("drive torque and joint forces of a linkage under loads")),
            Command("curve", message("the path of a point: length, area, cusps, inflections, double points")),
            Command("cognates", message("the other linkages that trace the same coupler curve (Roberts, Chebyshev)")),
            Command(
                "straight", message("how straight a coupler curve is: relative deviation, longest piece in a band")
            ),
            Command("guidance", message("straight-line linkages by name, and their size for a task")),
        ),
    ),
    (
        message("Wheels and cams"),
        (
            Command("gears", message("speeds, ratios, torques and power of a gear train")),
            Command("cam", message("a cam for a lift: profile, pressure angle, curvature, undercut")),
            Command("geneva", message("a Geneva drive: dwell, ratio, acceleration")),
        ),
    ),
    (
        message("Pictures"),
        (
            Command("draw", message("draw a chain, a mechanism, or a linkage to scale")),
            Command("explore", message("a page to pick a mechanism, drag its joints and see what that does")),
            Command("animate", message("a linkage that moves: SVG, an HTML page with a slider, GIF, WebP, APNG")),
            Command("plot", message("transfer functions, transmission angle, hodograph, coupler curves")),
            Command("gallery", message("draw all chains or mechanisms of a request on one page")),
        ),
    ),
    (
        message("Teaching"),
        (
            Command("exercise", message("exercises and fresh tasks: listed, solved step by step, answers marked")),
            Command("sheet", message("collection sheets: a mechanism on one page")),
            Command("table", message("teaching tables: joints, links, inversions, Grashof's types")),
            Command("coverage", message("which command does each concept and machine of the teaching documents")),
        ),
    ),
    (
        message("Catalog"),
        (
            Command("catalog", message("list, show and search the machines that come with the library")),
            Command("demo", message("check the whole catalog and explain four machines")),
        ),
    ),
)


def _commands() -> Iterator[Command]:
    for _, commands in GROUPS:
        yield from commands


def command_names() -> list[str]:
    """The names of all commands."""
    return [each.name for each in _commands()]


def command(name: str) -> Command:
    """The command of a name; `GrueblerError` with the nearest one if there is none."""
    for each in _commands():
        if each.name == name:
            return each
    raise GrueblerError(
        "there is no command {name!r}{suggestion} (see gruebler --help)",
        name=name,
        suggestion=nearest(name, command_names()),
    )


def overview(lang: str = "en") -> str:
    """All commands by group, a line each."""
    width = min(get_terminal_size().columns, 100)
    indent = max(map(len, command_names())) + 4
    lines = [
        translate("usage: gruebler COMMAND ...", lang),
        "",
        *textwrap.wrap(
            translate(
                "Structural synthesis of mechanisms: enumerate and check kinematic chains; move, draw and design "
                "linkages.",
                lang,
            ),
            width,
        ),
    ]
    for title, commands in GROUPS:
        lines += ["", title.in_language(lang)]
        for each in commands:
            first, *more = textwrap.wrap(each.summary.in_language(lang), width - indent) or [""]
            lines += [f"  {each.name:{indent - 2}}{first}", *(" " * indent + line for line in more)]
    lines += ["", translate("gruebler help COMMAND explains a command; --lang de answers in German.", lang)]
    return "\n".join(lines)
