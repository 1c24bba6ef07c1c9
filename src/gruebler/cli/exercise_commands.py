"""The parsers of the commands for teaching. Nothing heavy is imported."""

from __future__ import annotations

import argparse
from typing import Any

__all__ = ["add"]

_Commands = Any  # argparse's own type of a parser's commands is private
_KINDS = ("mobility", "grashof", "dead-centre", "transmission-angle", "dyad", "velocity")
_TABLES = ("joints", "links", "inversions", "grashof", "transfer")


def add(commands: _Commands) -> None:
    """Add them to the parser of all commands."""
    _add_exercise(commands)
    _add_table(commands)


def _add_exercise(commands: _Commands) -> None:
    exercise = commands.add_parser(
        "exercise",
        help="exercises of the seeds and fresh tasks: listed, solved step by step, answers checked",
        description="Exercises and worked examples, solved step by step and compared with what is printed; fresh "
        "tasks from the enumeration and random dimensions.",
        epilog="Example: gruebler exercise solve 15 --lang de; gruebler exercise new --kind mobility --level 2 "
        "--seed 7; gruebler exercise check mobility-2-7 n=8 F=1. Exit status: 0 all well, 1 an answer is wrong, 2 "
        "wrong usage.",
    )
    actions = exercise.add_subparsers(dest="action", metavar="list|show|solve|new|check", required=True)
    listing = actions.add_parser("list", help="all exercises and worked examples")
    show = actions.add_parser("show", help="the task alone")
    solve = actions.add_parser("solve", help="the way to the answer, step by step, with a check by a second way")
    for action in (show, solve):
        action.add_argument(
            "ids", nargs="+", metavar="ID", help="such as 15, exercise-15 or grashof-1-7 (a fresh task)"
        )
    new = actions.add_parser("new", help="fresh tasks; the same seed gives the same task")
    new.add_argument("--kind", choices=_KINDS, required=True, help="the theory")
    new.add_argument("--level", type=int, choices=(1, 2, 3), default=1, help="1 easy to 3 (default: 1)")
    new.add_argument("--seed", type=int, default=0, metavar="S", help="of the first task (default: 0)")
    new.add_argument("--count", type=int, default=1, metavar="K", help="so many, with seeds S, S + 1, ... (default: 1)")
    new.add_argument("--solutions", action="store_true", help="with their solutions")
    check = actions.add_parser("check", help="mark answers, with a hint on the likely mistake")
    check.add_argument("id", metavar="ID")
    check.add_argument("answers", nargs="+", metavar="KEY=ANSWER", help="such as H=40 phi_max=189,4 turns=yes")
    for action in (listing, show, solve, new, check):
        action.add_argument("--json", action="store_true", help="as JSON, both languages")
        _finish(action, "exercise")


def _add_table(commands: _Commands) -> None:
    table = commands.add_parser(
        "table",
        help="teaching tables: joints, links, inversions, Grashof's types, transfer functions",
        description="Tables for teaching, computed from the library: joints by freedom, links by joints and motion, "
        "the four inversions of a four-bar chain, four-bars by Grashof's condition with the smallest whole lengths, "
        "transfer functions of gears, linkages, cams and Geneva drives.",
        epilog="Example: gruebler table grashof --lang de",
    )
    table.add_argument("name", choices=_TABLES, metavar="NAME", help=", ".join(_TABLES))
    table.add_argument("--json", action="store_true", help="a list of objects with title, headers and rows")
    _finish(table, "table")


def _finish(parser: argparse.ArgumentParser, module: str) -> None:
    parser.add_argument("--lang", choices=("en", "de"), default="en", help="language of the answer (default: en)")
    parser.set_defaults(run=f"gruebler.cli.{module}")
