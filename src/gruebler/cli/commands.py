"""All commands by what they are for, and what `gruebler` alone and `gruebler help` show. It imports nothing heavy."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from shutil import get_terminal_size
from typing import Any

from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.text import Message, message, translate
from gruebler.cli.parser import Parser, british


@dataclass(frozen=True, slots=True)
class Command:
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
            Command("check", message("mobility of chains and linkages: counted, checked, and explained")),
            Command("enumerate", message("all chains with a given number of links, listed or counted")),
            Command(
                "inversions",
                message("the mechanisms of a chain: each frame, drive and output link that makes a difference"),
            ),
            Command("variants", message("all chains and mechanisms with given kinds of joints, drives and outputs")),
            Command("atlas", message("all chains and mechanisms with their properties in files: build, query")),
            Command("assur", message("decompose a mechanism into Assur groups, or list all groups")),
            Command("extend", message("add a dyad or coupler to a chain, or show how the chain is built from dyads")),
        ),
    ),
    (
        message("Dimensions and motion"),
        (
            Command("analyse", message("analyse a motion: dead centres, times, transmission angle, poses, velocities")),
            Command("synthesise", message("design linkages for given positions, functions, paths or dead centres")),
            Command(
                "design", message("from what a machine has to do to machines of several types, the best ones listed")
            ),
            Command("realise", message("find dimensions with which a mechanism can move")),
            Command(
                "grashof", message("type and rotatability of a four-bar or slider-crank, and the limits of its lengths")
            ),
            Command("statics", message("drive torque and joint forces under loads")),
            Command(
                "dynamics", message("drive torque, power and joint forces of masses in motion, from a file with loads")
            ),
            Command("simulate", message("how a linkage moves by itself under its loads, springs, weights and motors")),
            Command(
                "balance", message("counterweights, springs, flywheels for masses in motion, or why there are none")
            ),
            Command("curve", message("the path of a point and its special points, straight parts, cognates")),
        ),
    ),
    (
        message("Wheels and cams"),
        (
            Command("gears", message("speeds, ratios, torques and power of a gear train")),
            Command("cam", message("a cam for a given lift: profile, pressure angle, curvature, undercutting")),
            Command("geneva", message("a Geneva drive: dwell, transmission ratio, acceleration")),
        ),
    ),
    (
        message("Pictures"),
        (
            Command("draw", message("draw a chain, a mechanism or a linkage to scale")),
            Command("explore", message("open a page on which a mechanism moves and its joints are dragged")),
            Command("animate", message("animate a linkage: SVG, HTML page with a slider, GIF, WebP, APNG")),
            Command("plot", message("plot transfer functions, transmission angle, hodographs, coupler curves")),
            Command("gallery", message("draw many chains, mechanisms or machines on one page")),
        ),
    ),
    (
        message("Teaching"),
        (
            Command(
                "construct",
                message("constructions with compass and ruler, step by step: dead centres, polygons, curvature, cams"),
            ),
            Command("exercise", message("exercises and generated tasks: list, solve step by step, mark answers")),
            Command("sheet", message("data sheets of a collection: a mechanism on one page")),
            Command("table", message("teaching tables: joints, links, inversions, Grashof types")),
        ),
    ),
    (
        message("Catalog"),
        (
            Command("catalog", message("list, show and search the machines that come with the library")),
            Command("demo", message("check the whole catalog and explain four machines")),
        ),
    ),
    (message("Files"), (Command("convert", message("convert files: formats of other programs, chains as graphs")),)),
    (
        message("Shell"),
        (
            Command("completion", message("print the completion script of bash, zsh or fish")),
            Command("man", message("print the manual page")),
        ),
    ),
)

FIRST_STEPS = (
    (message("Check a chain"), 'gruebler check "R(0-1) R(1-2) R(2-3) R(3-0)" --explain'),
    (message("List all chains of a size"), "gruebler enumerate --links 8"),
    (message("Analyse a motion"), "gruebler analyse four-bar:25,70,40,70"),
    (message("See it move"), "gruebler animate wiper -o wiper.html"),
    (message("Design a linkage"), "gruebler synthesise dead-centres --swing 60 --time-ratio 1.2"),
)
"""What `gruebler` alone shows: what one can do, with a command that does it."""


def _commands() -> Iterator[Command]:
    for _, commands in GROUPS:
        yield from commands


def command_names() -> list[str]:
    """The names of all commands."""
    return [each.name for each in _commands()]


def command(name: str) -> Command:
    """The command of a name; `GrueblerError` with the nearest one if there is none."""
    for each in _commands():
        if each.name == british(name):
            return each
    raise GrueblerError(
        "there is no command {word!r}{suggestion}; see gruebler --help", **unknown(name, command_names())
    )


def welcome(lang: str = "en") -> str:
    """Five things to begin with, and where the rest is."""
    titles = [title.in_language(lang) for title, _ in FIRST_STEPS]
    indent = max(map(len, titles)) + 2
    lines = [f"  {title:{indent}}{example}" for title, (_, example) in zip(titles, FIRST_STEPS, strict=True)]
    return "\n".join(
        [
            translate("gruebler: structural synthesis of mechanisms. Five things to begin with:", lang),
            "",
            *lines,
            "",
            translate("gruebler --help lists all commands, gruebler help COMMAND explains one.", lang),
            translate("--lang de or GRUEBLER_LANG=de switches to German.", lang),
        ]
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
                "Structural synthesis of mechanisms: enumerate and check kinematic chains; analyse, draw and design "
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
    lines += ["", translate("gruebler help COMMAND explains a command; --lang de switches to German.", lang)]
    return "\n".join(lines)
