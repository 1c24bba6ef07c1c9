"""`gruebler analyse`: the measures of a linkage, then a table of poses and their derivatives."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from dataclasses import asdict
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.columns import Column, Table, shown
from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import Message, error_in_language, joined, message, translate
from gruebler.cli.drive_rows import given_rows, given_speeds, times, titles_of_drives, turning_drives
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import linkage_of_word, spatial_of_word, with_points
from gruebler.cli.output import print_json, write_table
from gruebler.cli.parser import Parser
from gruebler.cli.printed_file import is_table
from gruebler.cli.tables import print_table, print_text
from gruebler.files.linkages import linkage_to_json
from gruebler.mechanics.analysis import motion_roles, rotatability
from gruebler.mechanics.analysis.circuit_ranges import slide_directions
from gruebler.mechanics.analysis.measure_units import length_message
from gruebler.mechanics.analysis.outputs import Output, find_output
from gruebler.mechanics.analysis.table import default_rows, motion_table
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.branches import read_branch
from gruebler.mechanics.kinematics.drive_rows import rpm as per_minute
from gruebler.mechanics.kinematics.solve import all_branches, cached_plan, move_quietly, possible_modes
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import branch_text
from gruebler.structure.chain.pairs import Alphabet

if TYPE_CHECKING:
    from gruebler.mechanics.analysis.circuit_ranges import Rotatability
    from gruebler.mechanics.analysis.link_planes import LinkPlanes
    from gruebler.mechanics.analysis.measuring import Measures
    from gruebler.mechanics.kinematics.circuits import Circuit

_MOST_BRANCHES = 16


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Analyse the motion of a linkage. With one drive: dead centres, times, transmission angle and "
        "other measures, then a table of poses and their derivatives. With several drives: the table.",
        epilog="Examples: gruebler analyse four-bar:25,70,40,70 --speed 60; gruebler analyse lambda --point C "
        "--range 90:270:10. Exit status: 0 success, 1 the linkage cannot be assembled or cannot reach all rows, "
        "2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        linkage
        --range
        --at VALUE[,VALUE] ...  a row of the table: the values of all drives (repeatable)
        --speed N float ...  speed of the drive in rpm, of a slide in lengths per second; repeat it for each drive
        --acceleration A float ...  with --speed: acceleration in rad/s² or lengths per s²; repeat it for each drive
        --jerk J float ...  with --speed: jerk in rad/s³ or lengths per s³, repeat it for each drive; adds the third
            derivatives
        --branch
        --point POINT ...  a named point, a joint, or LINK:X,Y: its position and derivatives (repeatable)
        --output LINK ...  the output: a link or a sliding joint (repeatable)
        --wheel C,A,T  in space: camber, toe, half track and wheelbase of a wheel by its centre, an outer point of its
            axis and its contact with the ground; x points outwards, y forwards, z upwards
        --poles  the instant centres of all pairs of links; with --at as a list
        --curvature  radius and centre of curvature of each --point; inflection circles
        --planes  the planes in which the links, as plates, do not collide over the whole motion, or over the rows of
            --range
        """
    )
    parser.add_printed(help="print an object with linkage, measures, columns and rows", table=True)


def run(arguments: argparse.Namespace) -> int:
    """Measures and table; 1 if the linkage cannot be assembled, or not be moved all the way."""
    spatial = spatial_of_word(arguments.linkage, language_of_names(arguments))
    if spatial is not None:
        from gruebler.cli.analyse_space import analyse_in_space

        return analyse_in_space(arguments, spatial)
    linkage, shown_range = _in_plane(arguments)
    linkage = with_points(linkage, arguments.point)
    turning = turning_drives(linkage)
    plan = cached_plan(linkage)
    speeds = given_speeds(arguments.speed, turning, from_rest=bool(arguments.acceleration or arguments.jerk))
    accelerations = _higher("--acceleration", arguments.acceleration, speeds)
    jerks = _higher("--jerk", arguments.jerk, speeds)
    order = 3 if arguments.jerk else 2
    outputs = [find_output(linkage, name) for name in arguments.output or linkage.outputs or [None]]
    if arguments.branch is not None:
        read_branch(plan, arguments.branch)
    given = given_rows(arguments.range, arguments.at, linkage.mechanism)
    if len(turning) > 1:
        if arguments.poles or arguments.curvature or arguments.planes:
            raise GrueblerError("--poles, --curvature and --planes need a linkage with one drive")
        if given is None:
            raise GrueblerError(
                "the linkage has {count} drives: give --range FROM:TO:STEP for each, in the order {drives}, or --at "
                "VALUE,VALUE",
                count=len(turning),
                drives=titles_of_drives(linkage.mechanism),
            )
        if speeds:
            motion = move_quietly(
                linkage,
                given,
                branch=arguments.branch,
                speed=speeds,
                acceleration=accelerations,
                jerk=jerks,
                order=order,
            )
        else:
            motion = move_quietly(linkage, given, branch=arguments.branch)
        table = (
            motion_table(motion, outputs, arguments.point, lang=language_of_names(arguments)) if len(motion) else None
        )
        return _report(linkage, None, motion, list(table or ()), arguments)
    try:
        measures = _measured(linkage, outputs[0], turning[0], arguments)
    except LinkageError as error:
        text = error_in_language(error, arguments.lang)
        sentence = text[:1].upper() + text[1:] + "." * (not text.endswith("."))
        if arguments.json:
            empty = {"columns": [], "rows": [], "complete": False, "message": sentence}
            print_json({"linkage": linkage_to_json(linkage), **empty})
        else:
            print(sentence)
        return 1
    rows = default_rows(measures.span, shown_range, turning[0]) if given is None else given
    motion, before = _moved(linkage, measures, rows, arguments.branch, order)
    columns = []
    if len(motion):
        table = motion_table(
            motion,
            outputs,
            arguments.point,
            rates=(speeds[0], accelerations[0], jerks[0]) if speeds else None,
            transmission=None if measures.transmission is None else measures.output.name,
            lang=language_of_names(arguments),
        )
        columns = [*table, *_geometry(motion, outputs, arguments)]
    return _report(linkage, measures, motion, [column.without(before) for column in columns], arguments)


def _in_plane(arguments: argparse.Namespace) -> tuple[Linkage, tuple[float, float] | None]:
    """The linkage and the drive values between which it is shown."""
    if arguments.wheel is not None:
        raise GrueblerError("--wheel goes with a linkage in space")
    unit = "mm" if arguments.json else ""  # the linkage as JSON must have a unit, lengths have none
    return linkage_of_word(arguments.linkage, language_of_names(arguments), unit=unit)


# --- what was asked for ----------------------------------------------------------------------------


def _higher(option: str, given: Sequence[float], speeds: Sequence[float]) -> list[float]:
    """Accelerations or jerks of the drives, in radians or lengths; 0 if they are not given."""
    if not given:
        return [0.0] * len(speeds)
    if len(given) != len(speeds):
        if not speeds:
            raise GrueblerError("{option} needs --speed", option=option)
        raise GrueblerError(
            "expected {option} once for each --speed, {speeds}, but found it {count}",
            option=option,
            speeds=times(len(speeds)),
            count=times(len(given)),
        )
    for value in given:
        if not math.isfinite(value) or not abs(value) < 1e12:
            raise GrueblerError(
                "{option}: expected a finite number below 1e12, but found {value:g}", option=option, value=value
            )
    return list(given)


# --- what is computed ---------------------------------------------------------------------------------


def _measured(linkage: Linkage, output: Output, turning: bool, arguments: argparse.Namespace) -> Measures:
    from gruebler.mechanics.analysis.measuring import measures

    rpm = (arguments.speed[0] or None) if turning and arguments.speed else None
    return measures(
        linkage, speed=None if rpm is None else per_minute(rpm), branch=arguments.branch, output=output.name
    )


def _moved(linkage: Linkage, measures: Measures, rows: Reals, branch: str | None, order: int) -> tuple[Motion, int]:
    """The rows on the branch of the measures, from where these begin; if that fails, from the first row.

    Returns the motion and how many rows at its beginning were not asked for.
    """
    motion = move_quietly(
        linkage, np.concatenate([[[measures.start]], rows]), branch=measures.branch, speed=1.0, order=order
    )
    return (motion, 1) if len(motion) > 1 else (move_quietly(linkage, rows, branch=branch, speed=1.0, order=order), 0)


def _geometry(motion: Motion, outputs: Sequence[Output], arguments: argparse.Namespace) -> list[Column]:
    """The columns of --poles and --curvature."""
    from gruebler.mechanics.geometry.columns import curvature_columns, pole_columns

    columns = pole_columns(motion, language_of_names(arguments)) if arguments.poles and not _listed(arguments) else []
    if arguments.curvature:
        columns += curvature_columns(
            motion, arguments.point, [output.link for output in outputs], language_of_names(arguments)
        )
    return columns


def _planes(linkage: Linkage, arguments: argparse.Namespace) -> LinkPlanes:
    """The planes over the rows of --range, else over the whole motion."""
    from gruebler.mechanics.analysis.link_planes import link_planes

    rows = given_rows(arguments.range, [], linkage.mechanism)
    between = None if rows is None else (float(np.min(rows)), float(np.max(rows)))
    return link_planes(linkage, between=between)


def _listed(arguments: argparse.Namespace) -> bool:
    """Whether the poles are printed as a list below the table."""
    return bool(arguments.poles and arguments.at and not arguments.json and not is_table(arguments.out))


def _others(linkage: Linkage, measures: Measures) -> list[str]:
    branches = all_branches(cached_plan(linkage), np.array([measures.start]))
    others = [branch_text(branch) for branch in islice(branches, _MOST_BRANCHES) if branch != tuple(measures.branch)]
    return [*others, "…"] if next(branches, None) is not None else others


# --- what is printed ----------------------------------------------------------------------------------


def _report(
    linkage: Linkage,
    measures: Measures | None,
    motion: Motion,
    columns: Sequence[Column],
    arguments: argparse.Namespace,
) -> int:
    if is_table(arguments.out):
        write_table(arguments.out, columns, arguments.lang, decimal_comma=arguments.decimal_comma)
    if arguments.json:
        planes = {}
        if arguments.planes:
            arrangement = _planes(linkage, arguments)
            planes = {"planes": arrangement.planes, "planes_message": arrangement.explain(arguments.lang)}
        print_json(_document(linkage, measures, motion, columns, arguments.lang) | planes)
    else:
        if measures is not None:
            _print_measures(linkage, measures, arguments.lang)
        if arguments.planes:
            print_text(_planes(linkage, arguments).explain(arguments.lang))
            print()
        if columns and not is_table(arguments.out):
            rows = shown(columns, arguments.lang)
            print_table([column.header for column in columns], rows, numbers=range(len(columns)))
        if columns and _listed(arguments):
            from gruebler.mechanics.geometry.columns import pole_list

            headers, rows = pole_list(motion, len(motion) - 1, arguments.lang)
            print()
            print_table(headers, rows)
        if not motion.complete:
            print(motion.message(arguments.lang))
    return 0 if motion.complete else 1


def _print_measures(linkage: Linkage, measures: Measures, lang: str) -> None:
    print_text(measures.explain(lang))
    around = _circuit(linkage, measures)
    if isinstance(around, LinkageError):
        print(translate("Roles and rotatability are not known: {reason}", lang, reason=around))
    else:
        named = {link: role.in_language(lang) for link, role in motion_roles(around).items()}
        moving = [f"{link} = {role}" for link, role in named.items() if role != link != linkage.mechanism.frame]
        if moving:
            print(translate("Roles: {roles}.", lang, roles=", ".join(moving)))
        chain = linkage.mechanism.chain
        names = dict(zip(chain.joint_names(), chain.joint_names(Alphabet.of_language(lang)), strict=True))
        pairs = joined(
            message("{joint} {range}", joint=names[row.joint], range=_extent(row, linkage.unit))
            for row in rotatability(around)
        )
        print(translate("Relative motion at the joints: {pairs}.", lang, pairs=pairs))
        for name, turns in slide_directions(around).items():
            if turns:
                print(translate("The direction of the slide {joint} turns.", lang, joint=names[name]))
            else:
                print(translate("The direction of the slide {joint} is fixed.", lang, joint=names[name]))
    if measures.branch:
        print(translate("Assembly mode: {branch}.", lang, branch=branch_text(measures.branch)))
        if others := _others(linkage, measures):
            print(translate("Other assembly modes there: {others}.", lang, others=", ".join(others)))
        possible = possible_modes(linkage)
        if possible is not None and "…" not in others:
            print(
                translate(
                    "These are {found} of at most {possible} assembly modes, complex ones included.",
                    lang,
                    found=len(others) + 1,
                    possible=possible,
                )
            )
    print()


def _circuit(linkage: Linkage, measures: Measures) -> Circuit | LinkageError:
    """The circuit of the measures' branch, or why it cannot be followed."""
    from gruebler.mechanics.kinematics.circuits import circuit

    try:
        return circuit(linkage, branch=measures.branch)
    except LinkageError as error:
        return error


def _extent(row: Rotatability, unit: str) -> Message:
    if row.full:
        return message("full turns")
    if row.freedom == "turn":
        return message("{angle:n}°", angle=round(math.degrees(row.range), 6) + 0)
    return length_message(row.range, unit)


def _plain_row(row: Rotatability, unit: str) -> dict[str, Any]:
    """A row of the rotatability; the keys of angles end in ``_deg``."""
    document = asdict(row)
    angles = {key: document.pop(key) for key in ("lowest", "highest")} | {"range": row.range}
    if row.freedom == "turn":
        return document | {f"{key}_deg": math.degrees(value) for key, value in angles.items()}
    return document | angles | {"unit": unit}


def _document(
    linkage: Linkage, measures: Measures | None, motion: Motion, columns: Sequence[Column], lang: str
) -> dict[str, Any]:
    document: dict[str, Any] = {"linkage": linkage_to_json(linkage)}
    if measures is not None:
        document |= {"measures": measures.to_json(), "other_branches": _others(linkage, measures)}
        document["possible_modes"] = possible_modes(linkage)
        around = _circuit(linkage, measures)
        if isinstance(around, LinkageError):
            document |= {"roles": None, "rotatability": None}
        else:
            document["roles"] = {link: str(role) for link, role in motion_roles(around).items()}
            document["rotatability"] = [_plain_row(row, linkage.unit) for row in rotatability(around)]
    return document | {
        **Table(tuple(columns)).to_json(),
        "complete": motion.complete,
        "message": motion.message(lang),
    }
