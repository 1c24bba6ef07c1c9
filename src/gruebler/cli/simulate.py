"""`gruebler simulate`: how a linkage moves by itself."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

import numpy as np

from gruebler.base.columns import Column, Table, shown
from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.cli.design_files import check_picture
from gruebler.cli.draw import write_picture
from gruebler.cli.drive_rows import given_speeds, pose_of, turning_drives
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import add_loaded, loaded_linkage
from gruebler.cli.output import print_json, write_table
from gruebler.cli.parser import Parser
from gruebler.cli.printed_file import is_table
from gruebler.cli.tables import print_table, print_text
from gruebler.mechanics.dynamics import Simulation, simulate
from gruebler.mechanics.dynamics.tables import simulation_table
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas.files import SUFFIXES, suffix_of

_MOST_ROWS = 100_000


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="How a linkage moves by itself under the loads, springs, weights and motors of the table "
        "[loads] of its file or catalog entry: positions, velocities and energies by time. By how much energy is not "
        "kept says how exact the motion is. A catalog entry stops at the ends of its range.",
        epilog="Example: gruebler simulate pendulum.toml --until 2 --at 30. Exit status: 0 success, 1 the motion ends "
        "before its time, 2 wrong usage or unreadable input.",
    )
    add_loaded(parser)
    parser.take(
        """
        --until T float !  the time to which the motion is followed, in seconds
        --at VALUE[,VALUE]  the drives at the start, in degrees or the unit (default: those of the file)
        --speed N float ...  their speeds at the start in rpm, of a slide in lengths per second; repeat it for each
            drive (default: at rest)
        --rows N int  how many times there are in the table (default: 21, with --draw 401)
        --tolerance E float =1e-10  of each step, relative
        --no-ends  past the ends of the range of a catalog entry
        --stiff  an implicit method, for springs or dampers far faster than the motion
        --branch
        --draw FILE path  draw the phase plane, the speed of the drive over its value: .svg, .png or .pdf
        """
    )
    parser.add_printed(help="print an object with columns and rows", table=True)


def run(arguments: argparse.Namespace) -> int:
    """A table over the times; 1 if the motion ends before."""
    linkage, loads, _, between = loaded_linkage(arguments.linkage, language_of_names(arguments))
    lang, turning = arguments.lang, turning_drives(linkage)
    if arguments.draw is not None:
        check_picture(arguments.draw, SUFFIXES)
        if len(linkage.mechanism.drives) != 1:
            raise GrueblerError("--draw: the phase plane has one drive, but there are {count}", count=len(turning))
    rows = arguments.rows if arguments.rows is not None else 21 if arguments.draw is None else 401
    if not 2 <= rows <= _MOST_ROWS:
        raise GrueblerError("--rows: expected a number from 2 to 100000, but found {count}", count=rows)
    if not 0 < arguments.until < math.inf:
        raise GrueblerError("--until: expected a time in seconds after 0, but found {until:g}", until=arguments.until)
    if arguments.at is None and linkage.reference_pose is None:
        raise GrueblerError("--at is missing: {word} has no position to start from", word=arguments.linkage)
    result = simulate(
        linkage,
        loads,
        until=arguments.until,
        branch=arguments.branch,
        at=None if arguments.at is None else pose_of(arguments.at, linkage.mechanism),
        speed=given_speeds(arguments.speed, turning, from_rest=True) or 0.0,
        times=np.linspace(0.0, arguments.until, rows),
        ends=_ends(linkage, None if arguments.no_ends else between),
        tolerance=arguments.tolerance,
        stiff=arguments.stiff,
    )
    table = simulation_table(result, lang=language_of_names(arguments))
    if is_table(arguments.out):
        write_table(arguments.out, list(table), lang, decimal_comma=arguments.decimal_comma)
    if arguments.json:
        print_json(_document(result, table.columns, lang))
    elif not is_table(arguments.out):
        print_text(result.explain(lang))
        print()
        print_table([column.header for column in table], shown(table.columns, lang), numbers=range(len(table.columns)))
    if arguments.draw is not None:
        from gruebler.pictures.linkage.force_plots import phase_plot

        figure = phase_plot(result, lang=lang)
        write_picture(figure, arguments.draw, suffix_of(arguments.draw, SUFFIXES), False, lang)
    return 0 if result.complete else 1


def _ends(linkage: Linkage, between: tuple[float, float] | None) -> dict[str, tuple[float, float]]:
    """The range of a catalog entry as the ends of its drive."""
    if between is None:
        return {}
    factor = math.pi / 180 if linkage.mechanism.drives[0].turning else 1.0
    return {linkage.mechanism.drive_names()[0]: (factor * between[0], factor * between[1])}


def _document(result: Simulation, columns: Sequence[Column], lang: str) -> dict[str, object]:
    return {
        **Table(tuple(columns)).to_json(),
        **plain(result, "defect steps evaluations complete"),
        "message": result.message(lang),
    }
