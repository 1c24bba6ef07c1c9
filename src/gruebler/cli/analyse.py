"""`gruebler analyse`: what a linkage does: measures first, then a table of poses and rates."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gruebler.analysis import motion_roles, rotatability
from gruebler.analysis.outputs import Output, find_output
from gruebler.analysis.transmission import transmission_angle
from gruebler.arrays import Reals
from gruebler.cli.analysis_table import Column, as_csv, check_csv, columns, shown
from gruebler.cli.drive_rows import default_rows, given_rows, turning_drives
from gruebler.cli.linkage_inputs import linkage_of
from gruebler.cli.output import print_json, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.point_inputs import point_of
from gruebler.cli.tables import print_table, print_text
from gruebler.errors import GrueblerError, LinkageError
from gruebler.formats.linkages import linkage_to_json
from gruebler.kinematics import Motion, move
from gruebler.kinematics.branches import read_branch
from gruebler.kinematics.solve import all_branches, cached_plan
from gruebler.linkages import Linkage, LinkPoint
from gruebler.text import error_in_language

if TYPE_CHECKING:
    from gruebler.analysis.measures import Measures
    from gruebler.analysis.rotatability import Rotatability
    from gruebler.kinematics.circuits import Circuit

__all__ = ["add", "run"]


_MOST_BRANCHES = 16
_WORDS = {
    "en": {
        "roles": "Roles: {roles}.",
        "pairs": "Neighbours against each other: {pairs}.",
        "full": "full turns",
        "unknown": "Roles and rotatability are not known: {why}",
        "branch": "Assembly mode: {branch}.",
        "others": "Other assembly modes there: {others}.",
        "mu": "transmission angle",
    },
    "de": {
        "roles": "Rollen: {roles}.",
        "pairs": "Nachbarn gegeneinander: {pairs}.",
        "full": "volle Umläufe",
        "unknown": "Rollen und Umlauffähigkeit sind nicht bekannt: {why}",
        "branch": "Einbaulage: {branch}.",
        "others": "Andere Einbaulagen dort: {others}.",
        "mu": "Übertragungswinkel",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Measures of a linkage with one drive, then a table of poses, rates and transmission angles; of "
        "several drives the table.",
        epilog="Examples: gruebler analyse four-bar:25,70,40,70 --speed 60; gruebler analyse lambda --point C "
        "--drive 90:270:10. Exit status: 0 all well, 1 it cannot be assembled or not be moved all the way, 2 wrong "
        "usage or unreadable input.",
    )
    parser.add_argument(
        "linkage",
        metavar="FILE|ID|LENGTHS",
        help="a .toml or .json file, the id of a catalog entry with dimensions, or four-bar:A,B,C,D, "
        "slider-crank:A,B[,E], inverted-slider-crank:A,D[,E]",
    )
    parser.add_argument(
        "--drive",
        action="append",
        default=[],
        metavar="FROM:TO:STEP",
        help="rows of the table, in degrees or the unit; for several drives once each, one number holds a drive still "
        "(default: a full turn by 15 degrees, or the whole range)",
    )
    parser.add_argument("--at", action="append", type=float, default=[], metavar="VALUE", help="one row only")
    parser.add_argument(
        "--speed",
        action="append",
        type=float,
        default=[],
        metavar="N",
        help="turns a minute; of a slide, lengths a second; of several drives once each",
    )
    for option, unit, order in (("--acceleration", "s²", "second"), ("--jerk", "s³", "third")):
        parser.add_argument(
            option,
            action="append",
            type=float,
            default=[],
            metavar="A" if order == "second" else "J",
            help=f"with --speed: radians per {unit}; of a slide, lengths per {unit}; of several drives once each"
            + ("; rates of the third order are told too" if order == "third" else ""),
        )
    parser.add_argument("--branch", metavar="B", help="the assembly mode, such as + or +-; write --branch=- for minus")
    parser.add_argument(
        "--point", action="append", default=[], metavar="K", help="a named point, a joint, or LINK:X,Y; repeatable"
    )
    parser.add_argument("--output", action="append", default=[], metavar="LINK", help="the link looked at; repeatable")
    parser.add_argument(
        "--poles", action="store_true", help="the instant centres of all pairs of links; with --at a list"
    )
    parser.add_argument(
        "--curvature", action="store_true", help="radius and centre of curvature of each --point; inflection circles"
    )
    parser.add_argument("--json", action="store_true", help="an object with linkage, measures, columns and rows")
    parser.add_argument("-o", dest="csv", type=Path, metavar="FILE", help="the table as CSV, units in its header")


def run(arguments: argparse.Namespace) -> int:
    """Measures and table; 1 if the linkage cannot be assembled, or not be moved all the way."""
    check_csv(arguments.csv)
    linkage, shown_range = linkage_of(arguments.linkage)
    added = {
        text: (point.link, point.x, point.y)
        for text in arguments.point
        if isinstance(point := point_of(text), LinkPoint)
    }
    linkage = linkage.with_points(added) if added else linkage
    turning = turning_drives(linkage)
    plan = cached_plan(linkage)
    speeds = _speeds(arguments, turning)
    accelerations = _higher("--acceleration", arguments.acceleration, speeds)
    jerks = _higher("--jerk", arguments.jerk, speeds)
    order = 3 if arguments.jerk else 2
    outputs = [find_output(linkage, name) for name in arguments.output or linkage.outputs or [None]]
    for name in arguments.point:
        linkage.points_named(name)
    if arguments.branch is not None:
        read_branch(plan, arguments.branch)
    given = given_rows(arguments.drive, arguments.at, turning)
    if len(turning) > 1:
        if arguments.poles or arguments.curvature:
            raise GrueblerError("--poles and --curvature are those of linkages with one drive")
        if given is None:
            raise GrueblerError("{count} drives: give --drive FROM:TO:STEP or --at once for each", count=len(turning))
        if speeds:
            motion = move(
                linkage,
                given,
                branch=arguments.branch,
                speed=speeds,
                acceleration=accelerations,
                jerk=jerks,
                order=order,
            )
        else:
            motion = move(linkage, given, branch=arguments.branch)
        made = columns(motion, outputs, arguments.point) if len(motion) else []
        return _tell(linkage, None, motion, made, arguments)
    try:
        measures = _measured(linkage, outputs[0], turning[0], arguments)
    except LinkageError as error:
        text = error_in_language(error, arguments.lang)
        message = text[:1].upper() + text[1:] + "." * (not text.endswith("."))
        if arguments.json:
            none = {"columns": [], "rows": [], "complete": False, "message": message}
            print_json({"linkage": linkage_to_json(linkage), **none})
        else:
            print(message)
        return 1
    rows = default_rows(measures.span, shown_range, turning[0]) if given is None else given
    motion, before = _moved(linkage, measures, rows, arguments.branch, order)
    made = []
    if len(motion):
        angle = None if measures.transmission is None else transmission_angle(motion, measures.output.name)
        rates = (speeds[0], accelerations[0], jerks[0]) if speeds else None
        made = columns(motion, outputs, arguments.point, rates, angle, _WORDS[arguments.lang]["mu"])
        made += _geometry(motion, outputs, arguments)
    return _tell(linkage, measures, motion, [column.without(before) for column in made], arguments)


# --- what was asked for ----------------------------------------------------------------------------


def _speeds(arguments: argparse.Namespace, turning: Sequence[bool]) -> list[float]:
    """Of the drives, in radians a second, or lengths a second; given in revolutions a minute, or lengths a second."""
    given, from_rest = arguments.speed, bool(arguments.acceleration or arguments.jerk)
    if given and len(given) != len(turning):
        raise GrueblerError(
            "--speed is given once for each drive: {count} times, not {count_2}", count=len(turning), count_2=len(given)
        )
    for speed in given:
        if not math.isfinite(speed) or not abs(speed) < 1e12 or (speed == 0 and len(given) == 1 and not from_rest):
            raise GrueblerError("--speed: expected a number that is not 0, but found {speed:g}", speed=speed)
    return [speed * math.pi / 30 if turns else speed for speed, turns in zip(given, turning, strict=bool(given))]


def _higher(option: str, given: Sequence[float], speeds: Sequence[float]) -> list[float]:
    """Accelerations or jerks of the drives, in radians or lengths; 0 if they are not given."""
    if not given:
        return [0.0] * len(speeds)
    if len(given) != len(speeds):
        wanted = f"once for each --speed: {len(speeds)} times, not {len(given)}" if speeds else "together with --speed"
        raise GrueblerError("{option} is given {wanted}", option=option, wanted=wanted)
    for value in given:
        if not math.isfinite(value) or not abs(value) < 1e12:
            raise GrueblerError(
                "{option}: expected a finite number below 1e12, but found {value:g}", option=option, value=value
            )
    return list(given)


# --- what is found ---------------------------------------------------------------------------------


def _measured(linkage: Linkage, output: Output, turning: bool, arguments: argparse.Namespace) -> Measures:
    from gruebler.analysis.measures import measures

    rpm = (arguments.speed[0] or None) if turning and arguments.speed else None
    return measures(linkage, rpm, arguments.branch, output.name)


def _moved(linkage: Linkage, measures: Measures, rows: Reals, branch: str | None, order: int) -> tuple[Motion, int]:
    """The rows on the branch of the measures, reached from where these begin; else, if it can be, from the first row.

    Second comes how many rows at the beginning were not asked for.
    """
    motion = move(linkage, np.concatenate([[[measures.start]], rows]), branch=measures.branch, speed=1.0, order=order)
    return (motion, 1) if len(motion) > 1 else (move(linkage, rows, branch=branch, speed=1.0, order=order), 0)


def _geometry(motion: Motion, outputs: Sequence[Output], arguments: argparse.Namespace) -> list[Column]:
    """The columns of --poles and --curvature."""
    from gruebler.cli.geometry_columns import curvature_columns, pole_columns

    out = pole_columns(motion, arguments.lang) if arguments.poles and not _listed(arguments) else []
    if arguments.curvature:
        out += curvature_columns(motion, arguments.point, [output.link for output in outputs], arguments.lang)
    return out


def _listed(arguments: argparse.Namespace) -> bool:
    """Whether the poles are told as a list below the table."""
    return bool(arguments.poles and arguments.at and not arguments.json and arguments.csv is None)


def _others(linkage: Linkage, measures: Measures) -> list[str]:
    branches = all_branches(cached_plan(linkage), np.array([measures.start]))
    others = [_label(branch) for branch in islice(branches, _MOST_BRANCHES) if branch != tuple(measures.branch)]
    return [*others, "…"] if next(branches, None) is not None else others


def _label(branch: Sequence[str]) -> str:
    return "".join(branch) if set(branch) <= {"+", "-"} else ",".join(branch)


# --- what is said ----------------------------------------------------------------------------------


def _tell(
    linkage: Linkage, found: Measures | None, motion: Motion, made: Sequence[Column], arguments: argparse.Namespace
) -> int:
    if arguments.csv is not None:
        write_file(arguments.csv, as_csv(made).encode("utf-8"), arguments.lang)
    if arguments.json:
        print_json(_document(linkage, found, motion, made, arguments.lang))
    else:
        if found is not None:
            _say(linkage, found, _WORDS[arguments.lang], arguments.lang)
        if made and arguments.csv is None:
            print_table([column.header for column in made], shown(made), numbers=range(len(made)))
        if made and _listed(arguments):
            from gruebler.cli.geometry_columns import pole_list

            headers, rows = pole_list(motion, len(motion) - 1, arguments.lang)
            print()
            print_table(headers, rows)
        if not motion.complete:
            print(motion.message(arguments.lang))
    return 0 if motion.complete else 1


def _say(linkage: Linkage, measures: Measures, words: dict[str, str], lang: str) -> None:
    print_text(measures.explain(lang))
    made = _circuit(linkage, measures)
    if isinstance(made, LinkageError):
        print(words["unknown"].format(why=error_in_language(made, lang)))
    else:
        roles = motion_roles(made).items()
        moving = (f"{link} = {role.in_language(lang)}" for link, role in roles if link != linkage.mechanism.frame)
        print(words["roles"].format(roles=", ".join(moving)))
        pairs = (f"{row.joint} {_extent(row, linkage.unit, words)}" for row in rotatability(made))
        print(words["pairs"].format(pairs=", ".join(pairs)))
    if measures.branch:
        print(words["branch"].format(branch=_label(measures.branch)))
        if others := _others(linkage, measures):
            print(words["others"].format(others=", ".join(others)))
    print()


def _circuit(linkage: Linkage, measures: Measures) -> Circuit | LinkageError:
    """The circuit of the measures' branch, or why it cannot be followed."""
    from gruebler.kinematics.circuits import circuit

    try:
        return circuit(linkage, branch=measures.branch)
    except LinkageError as error:
        return error


def _extent(row: Rotatability, unit: str, words: dict[str, str]) -> str:
    if row.full:
        return words["full"]
    if row.freedom == "turn":
        return f"{round(math.degrees(row.range), 6) + 0:.6g}°"
    return f"{row.range:.6g} {unit}"


def _plain_row(row: Rotatability, unit: str) -> dict[str, Any]:
    """A row of the rotatability; the keys of angles end in ``_deg``."""
    out = row._asdict()
    angles = {key: out.pop(key) for key in ("lowest", "highest")} | {"range": row.range}
    if row.freedom == "turn":
        return out | {f"{key}_deg": math.degrees(value) for key, value in angles.items()}
    return out | angles | {"unit": unit}


def _document(
    linkage: Linkage, found: Measures | None, motion: Motion, made: Sequence[Column], lang: str
) -> dict[str, Any]:
    document: dict[str, Any] = {"linkage": linkage_to_json(linkage)}
    if found is not None:
        document |= {"measures": found.to_json(), "other_branches": _others(linkage, found)}
        around = _circuit(linkage, found)
        if isinstance(around, LinkageError):
            document |= {"roles": None, "rotatability": None}
        else:
            document["roles"] = {link: str(role) for link, role in motion_roles(around).items()}
            document["rotatability"] = [_plain_row(row, linkage.unit) for row in rotatability(around)]
    rows = zip(*(column.values for column in made), strict=True)
    return document | {
        "columns": [{"name": column.name, "unit": column.unit} for column in made],
        "rows": [[float(value) if math.isfinite(value) else None for value in row] for row in rows],
        "complete": motion.complete,
        "message": motion.message(lang),
    }
