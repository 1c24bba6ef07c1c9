"""`gruebler statics`: drive torque and joint forces of a linkage under loads."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.columns import Column, Table, shown
from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.base.text import message, number, translate
from gruebler.cli.drive_rows import turning_drives
from gruebler.cli.driven_motion import driven_motion
from gruebler.cli.friction_options import add_friction, friction_of, option_numbers
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import acts, linkage_with_loads
from gruebler.cli.output import print_json, write_table
from gruebler.cli.parser import Parser
from gruebler.cli.point_inputs import point_of
from gruebler.cli.printed_file import is_table
from gruebler.cli.tables import print_table
from gruebler.mechanics.forces import Loads, Statics, component_table, statics, statics_table


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Drive torques and joint forces under forces at points and moments on links, from the equilibrium "
        "of every link; the drive torque is checked by virtual work. Torques are in N times the unit of length. "
        "The table [loads] of a file or catalog entry acts, too; an option replaces what it has for the same point or "
        "link. Its dampers and laws of the speed see each drive at 1 rad/s or one unit of length a second. "
        "Inertia is neglected. Coulomb friction in slides and pins is solved together with the joint forces; joint "
        "forces are then those with friction. A row in which the linkage is self-locking has no torque; the message "
        "names the joint and the factor of safety.",
        epilog="Example: gruebler statics slider-crank:20,50 --load 'R(coupler-slider)=-100,0' --friction 0.1 "
        "--pin-radius 5 --guide-length 40. "
        "Exit status: 0 success, 1 the linkage cannot move through all rows, or in some its forces are undetermined "
        "or it is self-locking, 2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        linkage
        --load POINT=FX,FY ...  a force at a named point, a joint or LINK:X,Y; repeatable
        --moment LINK=M ...  a moment on a link, counter-clockwise; repeatable
        --mass POINT=M ...  a mass of M kg with its weight; repeatable
        --gravity GX,GY  acceleration of gravity (default: that of the file, else 0,-9.80665)
        """
    )
    add_friction(parser)
    parser.take(
        """
        --range FROM:TO:STEP ...  drive values in degrees or the unit, once per drive (default: a full turn, or the
            whole range)
        --at
        --branch
        """
    )
    parser.add_printed(help="print an object with columns and rows", table=True)


def run(arguments: argparse.Namespace) -> int:
    """A table over the rows, or all forces of one row; 1 if it stops or is not held somewhere."""
    linkage, own, _, shown_range = linkage_with_loads(arguments.linkage, language_of_names(arguments))
    turning_drives(linkage)  # it has some
    lang = arguments.lang
    loads = _loads(arguments, own)
    if not acts(loads):
        raise GrueblerError(
            "no load is given: use --load, --moment or --mass, or the table [loads] of the linkage's file"
        )
    friction = friction_of(arguments)
    motion = driven_motion(linkage, shown_range, spans=arguments.range, at=arguments.at, branch=arguments.branch)
    if not len(motion):
        print(motion.message(lang))
        return 1
    held = statics(motion, loads, friction=friction)
    columns_lang = language_of_names(arguments)
    table = statics_table(held, lang=columns_lang)
    if is_table(arguments.out):
        write_table(
            arguments.out, [*table, *component_table(held, columns_lang)], lang, decimal_comma=arguments.decimal_comma
        )
    if arguments.json:
        print_json(_document(held, [*table, *component_table(held, columns_lang)], lang))
    elif not is_table(arguments.out):
        _print(held, table.columns, lang)
    return 0 if motion.complete and not (held.singular | held.locked).any() else 1


# --- what was asked for ----------------------------------------------------------------------------


def _loads(arguments: argparse.Namespace, own: Loads) -> Loads:
    """Those of the file or the entry, and those of the options, which replace them where both name the same."""
    forces, moments, masses = (
        _added(option, given, count)
        for option, given, count in (
            ("--load", arguments.load, 2),
            ("--moment", arguments.moment, 1),
            ("--mass", arguments.mass, 1),
        )
    )
    gravity = own.gravity
    if arguments.gravity is not None:
        x, y = option_numbers("--gravity", arguments.gravity, 2)
        gravity = x, y
    return replace(
        own,
        forces={**own.forces, **forces},
        moments={**own.moments, **moments},
        masses={**own.masses, **masses},
        gravity=gravity,
    )


def _added(option: str, given: Sequence[str], count: int) -> dict[Any, ArrayLike]:
    """What is given for each name; several times the same name add up."""
    totals: dict[Any, ArrayLike] = {}
    for text in given:
        name, numbers = _named(option, text, count)
        key = name if option == "--moment" else point_of(name)
        totals[key] = np.add(totals.get(key, 0.0), numbers)
    return totals


def _named(option: str, text: str, count: int) -> tuple[str, list[float] | float]:
    name, equals, values = text.rpartition("=")
    if not equals or not name:
        raise GrueblerError(
            "{option}: expected {expected}, but found {found!r}",
            option=option,
            expected="POINT=FX,FY" if count == 2 else "NAME=NUMBER",
            found=text,
        )
    numbers = option_numbers(option, values, count)
    return name.strip(), numbers if count > 1 else numbers[0]


# --- output ----------------------------------------------------------------------------------------


def _print(held: Statics, table: Sequence[Column], lang: str) -> None:
    motion, drives = held.motion, len(held.motion.linkage.mechanism.drives)
    if len(motion) > 1:
        for column in table[drives : 2 * drives]:
            if np.isfinite(column.values).any():
                print(_largest(column, table[0], lang, rubbing=False))
        for column in table[2 * drives : 3 * drives] if held.friction else ():
            if held.friction and np.isfinite(column.values).any():
                rests = (held.friction.directions == 0).any(axis=1)  # a row without some of its friction stands alone
                moving = np.where(rests, np.nan, column.values)
                shown_rows = replace(column, values=moving) if np.isfinite(moving).any() else column
                print(_largest(shown_rows, table[0], lang, rubbing=True))
        if held.friction and np.isfinite(held.friction.locking_factor).any():
            print(_safety(held, table[0], lang))
    if math.isfinite(held.disagreement):
        print(
            translate(
                "Equilibrium and virtual work agree to {part:.1e} of the largest load.", lang, part=held.disagreement
            )
        )
    if len(motion) > 1 or math.isfinite(held.disagreement):
        print()
    if len(motion) > 1:
        print_table([column.header for column in table], shown(table, lang), numbers=range(len(table)))
    else:
        columns = [*table, *component_table(held, lang, reactions=False)]
        cells = [[c.name, value, c.unit] for c, value in zip(columns, shown(columns, lang)[0], strict=True)]
        print_table(["", "", ""], cells, [1])
    for text in (motion.message(lang), held.message(lang)):
        if text:
            print(text)


def _largest(effort: Column, drive: Column, lang: str, *, rubbing: bool) -> str:
    """The largest effort of a drive and where it is."""
    row = int(np.nanargmax(np.abs(effort.values)))
    if not effort.values[row]:
        return translate("The drive carries no load: {name} = 0.", lang, name=effort.name)
    text = (
        message("Largest effort: {name} = {value:n} {unit} at {place}.")
        if rubbing
        else message("Largest effort, without friction: {name} = {value:n} {unit} at {place}.")
    )
    return text.filled(
        name=effort.name, value=effort.values[row], unit=effort.unit, place=_place(drive, row, lang)
    ).in_language(lang)


def _safety(held: Statics, drive: Column, lang: str) -> str:
    """The least factor of safety against self-locking, and where it is."""
    assert held.friction is not None
    factors, chain = held.friction.locking_factor, held.motion.linkage.mechanism.chain
    row = int(np.nanargmin(factors))
    joint = held.friction.locking_joint(row)
    assert joint is not None  # its factor is finite
    return translate(
        "Least safety against self-locking: {factor:n} at {place}, by {joint}.",
        lang,
        factor=factors[row],
        place=_place(drive, row, lang),
        joint=chain.joint_title(joint),
    )


def _place(drive: Column, row: int, lang: str) -> str:
    return f"{number(drive.values[row], lang, 'n')}{drive.unit if drive.unit == '°' else f' {drive.unit}'}"


def _document(held: Statics, columns: Sequence[Column], lang: str) -> dict[str, object]:
    return {
        **Table(tuple(columns)).to_json(),
        **plain(held, "disagreement"),
        "singular": np.flatnonzero(held.singular).tolist(),
        "locked": np.flatnonzero(held.locked).tolist(),
        "complete": held.motion.complete,
        "message": " ".join(filter(None, (held.motion.message(lang), held.message(lang)))),
    }
