"""`gruebler analyse` of a linkage in space: degree of freedom, measures of its drive, a table of its motion."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.columns import Table, shown
from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import Message, error_in_language, joined, message, translate
from gruebler.cli.drive_rows import given_rows, titles_of_drives
from gruebler.cli.linkage_inputs import SpatialWord
from gruebler.cli.output import print_json, write_table
from gruebler.cli.printed_file import is_table
from gruebler.cli.tables import print_table, print_text
from gruebler.files.catalog_records import Entry
from gruebler.files.screws import screws_to_json
from gruebler.mechanics.screws import SpatialLinkage, freedoms
from gruebler.mechanics.space import SpatialCircuit, SpatialMeasures, SpatialModes, assembly_modes, circuit, measures
from gruebler.mechanics.space.drive_ranges import followed
from gruebler.mechanics.space.motion_tables import spatial_table
from gruebler.mechanics.space.wheel_alignment import wheel_alignment
from gruebler.teaching.catalog import entries

_ONLY_IN_PLANE = ("speed", "acceleration", "jerk", "branch", "poles", "curvature", "planes")
_LONGEST = 100.0  # radians and sizes: how far the circuit is followed
_ROWS = 25  # of the table, where no rows are given


def analyse_in_space(arguments: argparse.Namespace, spatial: SpatialWord) -> int:
    """Print measures and table; the status is 0, or an error says which rows cannot be reached."""
    linkage = spatial.linkage
    for option in _ONLY_IN_PLANE:
        if getattr(arguments, option):
            raise GrueblerError("--{option} does not go with a linkage in space", option=option)
    drives = linkage.mechanism.drives
    rows = given_rows(arguments.range, arguments.at, linkage.mechanism)
    measured: SpatialMeasures | None = None
    if len(drives) == 1:
        measured = measures(linkage, output=arguments.output[0] if arguments.output else None)
        rows = measured.rows(_ROWS) if rows is None else rows
    table = _table(linkage, rows, arguments)
    if table is not None and is_table(arguments.out):
        write_table(arguments.out, table.columns, arguments.lang, decimal_comma=arguments.decimal_comma)
    freedom = freedoms(linkage)
    modes = _modes(linkage)
    around = None if measured is None else _circuit(measured)
    if arguments.json:
        document = {"linkage": screws_to_json(linkage), "freedoms": freedom.to_json()} | _found(measured, around, modes)
        print_json(document | (Table(()) if table is None else table).to_json())
        return 0
    print_text(freedom.summary(arguments.lang))
    if measured is not None:
        print_text(measured.explain(arguments.lang))
    if measured is not None and around is not None:
        print_text(_circuit_text(around, measured.range.full, arguments.lang))
    if modes is not None:
        print_text(_said(modes, arguments.lang))
    if table is None:
        print_text(_how_to_move(linkage, arguments.linkage).in_language(arguments.lang))
    elif not is_table(arguments.out):
        print()
        print_table(
            [column.header for column in table], shown(table.columns, arguments.lang), numbers=range(len(table.columns))
        )
    return 0


def _found(measured: SpatialMeasures | None, around: object, modes: object) -> dict[str, Any]:
    """What was found, as plain data."""
    document: dict[str, Any] = {}
    if measured is not None:
        document["measures"] = measured.to_json()
    if isinstance(around, SpatialCircuit):
        document["circuit"] = around.to_json()
    if isinstance(modes, SpatialModes):
        document["assembly_modes"] = {"found": modes.number, "real": len(modes), "exact": modes.exact}
        document["assembly_modes"] |= {"generic": modes.generic, "far": modes.far}
    return document


def _how_to_move(linkage: SpatialLinkage, word: str) -> Message:
    """What is missing for a motion: a drive, with those catalog entries of the linkage that have one, or rows."""
    mechanism = linkage.mechanism
    if mechanism.drives:
        return message(
            "For a table of its motion give --range FROM:TO:STEP for each drive, in the order {drives}, or --at "
            "VALUE,VALUE.",
            drives=titles_of_drives(mechanism),
        )
    chain = mechanism.chain
    names = [
        name
        for name, joint in zip(chain.joint_names(), chain.joints, strict=True)
        if not joint.pair.is_ball and not joint.pair.has_contours and joint.count == 1
    ]
    texts = [
        message("No joint is driven; name one in drives, such as {joint}.", joint=names[0])
        if names
        else message("No joint is driven, and a ball cannot be: a joint of another kind has to move one of the links.")
    ]
    driven = [name for name, entry in entries().items() if name.startswith(f"{word}_") and _is_driven(entry)]
    if driven:
        texts.append(message("With a drive: {entries}.", entries=", ".join(driven)))
    return joined(texts, " ")


def _is_driven(entry: Entry) -> bool:
    return entry.screws is not None and bool(entry.screws.shown_drives or entry.drives)


def _table(linkage: SpatialLinkage, rows: Reals | None, arguments: argparse.Namespace) -> Table | None:
    """The motion over the rows, with the columns of a wheel; None without rows."""
    if rows is None:
        if arguments.wheel is not None:
            raise GrueblerError("--wheel needs rows: give --range FROM:TO:STEP for each drive, or --at VALUE,VALUE")
        return None
    motion = followed(linkage, np.asarray(rows), order=2 if len(linkage.mechanism.drives) == 1 else 0)
    table = spatial_table(motion, arguments.output, arguments.point, by_drive=True, lang=arguments.lang)
    if arguments.wheel is None:
        return table
    return Table((*table, *wheel_alignment(motion, *_wheel_points(arguments.wheel), lang=arguments.lang)))


def _wheel_points(text: str) -> tuple[str, ...]:
    """Centre, point of the axis, and contact if it is given."""
    names = tuple(name.strip() for name in text.split(","))
    if len(names) not in (2, 3) or not all(names):
        raise GrueblerError(
            "--wheel {found!r}: expected the names of two or three points such as C,A,T: centre, outer point of the "
            "axis, contact with the ground",
            found=text[:40],
        )
    return names


def _circuit(measured: SpatialMeasures) -> SpatialCircuit | LinkageError | None:
    """The circuit, or why it cannot be followed; None for a slide without end."""
    if not measured.range.full and measured.range.stops == (None, None):
        return None
    try:
        around = circuit(measured.linkage, most=_LONGEST)
        around.to_json()  # its events are found, or not
        return around
    except LinkageError as error:
        return error


def _circuit_text(around: SpatialCircuit | LinkageError, full: bool, lang: str) -> str:
    """With a drive that turns fully nothing of its limits, and the dead centres are those of the measures."""
    if isinstance(around, SpatialCircuit):
        return around.summary(lang) if full else around.explain(lang)
    return translate("The circuit is not known: {reason}.", lang, reason=error_in_language(around, lang))


def _modes(linkage: SpatialLinkage) -> SpatialModes | LinkageError | None:
    """The assembly modes in the reference pose, or why there is no list of them; None without drives."""
    if not linkage.mechanism.drives:
        return None
    try:
        return assembly_modes(linkage, [np.zeros(len(linkage.mechanism.drives))])
    except LinkageError as error:
        return error


def _said(modes: SpatialModes | LinkageError, lang: str) -> str:
    if isinstance(modes, SpatialModes):
        return modes.explain(lang)
    return translate("Assembly modes are not known: {reason}.", lang, reason=error_in_language(modes, lang))
