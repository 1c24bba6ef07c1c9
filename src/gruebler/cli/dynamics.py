"""`gruebler dynamics`: drive torque, power and joint forces of a linkage whose masses are moved."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.columns import Column, Table, shown
from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.cli.drive_rows import given_rows, given_speeds, turning_drives
from gruebler.cli.friction_options import add_friction, friction_of
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import add_loaded, loaded_linkage
from gruebler.cli.output import print_json, write_table
from gruebler.cli.parser import Parser
from gruebler.cli.printed_file import is_table
from gruebler.cli.tables import print_table, print_text
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.analysis.table import default_rows
from gruebler.mechanics.dynamics import InverseDynamics, inverse_dynamics
from gruebler.mechanics.dynamics.tables import dynamics_table
from gruebler.mechanics.forces import component_table
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="What the drives and joints of a linkage carry while its masses are moved: efforts by two methods, "
        "the equilibrium of every link and the equations of motion; joint forces, power, shaking force and moment. "
        "Masses and loads stand in the table [loads] of the file or the catalog entry. Drives run at constant speed; "
        "torques are in N times the unit of length.",
        epilog="Examples: gruebler dynamics compressor; gruebler dynamics press.toml --speed 300. "
        "Exit status: 0 success, 1 the linkage cannot move through all rows, or in some its forces are undetermined "
        "or it is self-locking, 2 wrong usage or unreadable input.",
    )
    add_loaded(parser)
    parser.take(
        """
        --speed N float ...  speed of the drive in rpm, of a slide in lengths per second; repeat it for each drive
            (default: that of the loads)
        """
    )
    add_friction(parser)
    parser.take(
        """
        --range FROM:TO:STEP ...  drive values in degrees or the unit, once per drive (default: a full turn)
        --at
        --branch
        """
    )
    parser.add_printed(help="print an object with columns and rows", table=True)


def run(arguments: argparse.Namespace) -> int:
    """A table over the rows; 1 if it stops or is not held somewhere."""
    linkage, loads, usual, between = loaded_linkage(arguments.linkage, language_of_names(arguments))
    lang = arguments.lang
    speeds = given_speeds(arguments.speed, turning_drives(linkage)) or ([] if usual is None else [usual])
    if not speeds:
        raise GrueblerError("--speed is missing: the forces of inertia grow with its square")
    motion = move_quietly(linkage, _rows(linkage, between, arguments), branch=arguments.branch, speed=speeds, order=2)
    if not len(motion):
        print(motion.message(lang))
        return 1
    result = inverse_dynamics(motion, loads, times=_times(motion, speeds), friction=friction_of(arguments))
    table = dynamics_table(result, lang=language_of_names(arguments))
    every = [*table, *component_table(result.statics, language_of_names(arguments))]
    if is_table(arguments.out):
        write_table(arguments.out, every, lang, decimal_comma=arguments.decimal_comma)
    if arguments.json:
        print_json(_document(result, every, lang))
    elif not is_table(arguments.out):
        _print(result, table.columns, lang)
    return 0 if motion.complete and not (result.statics.singular | result.statics.locked).any() else 1


def _rows(linkage: Linkage, between: tuple[float, float] | None, arguments: argparse.Namespace) -> Reals:
    """The rows that were asked for, or a full turn."""
    turning = turning_drives(linkage)
    rows = given_rows(arguments.range, arguments.at, linkage.mechanism)
    if rows is not None:
        return rows
    if len(turning) > 1:
        raise GrueblerError("{count} drives: give --range FROM:TO:STEP once for each, or --at", count=len(turning))
    span = drive_cycle(linkage, branch=arguments.branch).span
    if not span.full and between is None:
        raise GrueblerError(
            "the drive does not turn fully and cannot keep its speed at its limits: give --range or --at"
        )
    return default_rows(span, between, turning[0])


def _times(motion: Motion, speeds: Sequence[float]) -> Reals:
    """The time at each row: 0 at the first, by the first drive that moves."""
    moving = next((k for k, speed in enumerate(speeds) if speed), None)
    if moving is None:
        return np.zeros(len(motion))
    return np.asarray((motion.drives[:, moving] - motion.drives[0, moving]) / speeds[moving])


def _print(result: InverseDynamics, table: Sequence[Column], lang: str) -> None:
    print_text(result.explain(lang))
    print()
    print_table([column.header for column in table], shown(table, lang), numbers=range(len(table)))


def _document(result: InverseDynamics, columns: Sequence[Column], lang: str) -> dict[str, object]:
    return {
        **Table(tuple(columns)).to_json(),
        **plain(result, "peak root_mean_square disagreement"),
        "singular": np.flatnonzero(result.statics.singular).tolist(),
        "locked": np.flatnonzero(result.statics.locked).tolist(),
        "complete": result.motion.complete,
        "message": " ".join(filter(None, (result.motion.message(lang), result.statics.message(lang)))),
    }
