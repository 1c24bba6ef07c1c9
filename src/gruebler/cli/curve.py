"""`gruebler curve`: the path of a point, how straight it is, its cognates; straight-line linkages by name."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.columns import Column
from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, joined_by_or, message, number, translate
from gruebler.cli import curve_cognates, curve_guidance, curve_straight
from gruebler.cli.arguments import take
from gruebler.cli.drive_rows import driven_path
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import linkage_of_word
from gruebler.cli.output import print_json, write_table
from gruebler.cli.parser import Parser
from gruebler.cli.point_inputs import point_of
from gruebler.cli.printed_file import is_table
from gruebler.cli.tables import Cell, print_table
from gruebler.mechanics.analysis.drive_cycles import PathCycle
from gruebler.mechanics.analysis.measure_units import length_message
from gruebler.mechanics.geometry import CouplerCurve, TangentContact, coupler_curve
from gruebler.mechanics.geometry.double_points import DoublePoint
from gruebler.mechanics.geometry.path_events import Cusp, Inflection, TurningPoint, Vertex

_MODES: Mapping[str, Callable[[argparse.Namespace], int]] = {
    "straight": curve_straight.run,
    "cognates": curve_cognates.run,
    "guidance": curve_guidance.run,
}
_PATH = ""
_GIVEN_WITH: Mapping[str, tuple[str, ...]] = {
    "range": (_PATH,),
    "contact": (_PATH,),
    "tolerance": (_PATH,),
    "direction": (_PATH, "straight"),
    "branch": (_PATH, "straight", "cognates"),
    "band": ("straight", "guidance"),
    "window": ("straight",),
    "ratio": ("straight",),
    "centre": ("straight",),
    "at": ("cognates",),
    "length": ("guidance",),
    "lambda": ("guidance",),
    "phi0": ("guidance",),
    "kappa": ("guidance",),
    "diameter": ("guidance",),
}
"""Options, and what they go with: the path itself, or one of the questions about it."""

_CROSSED = message(
    "The path is closed: length {length}, area {area}; what is run through clockwise counts as negative."
)
_CLOCKWISE = message("The path is closed: length {length}, area {area}, run through clockwise.")
_COUNTERCLOCKWISE = message("The path is closed: length {length}, area {area}, run through counter-clockwise.")


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="The path of a point over the whole motion of a linkage: length, area, cusps, inflections, "
        "vertices, double points. --straight: the straight part of the path. --cognates: the other linkages that trace "
        "the same path. --guidance: straight-line linkages by name, without LINKAGE and POINT.",
        epilog="Examples: gruebler curve four-bar:25,70,40,70 coupler:45,40; gruebler curve lambda C --contact 180; "
        "gruebler curve 20,50,50,40 coupler:100,0 --straight --band 0.2; gruebler curve 25,70,40,70 45,40 --cognates; "
        "gruebler curve --guidance lambda --length 15cm --band 0.75mm. Exit status: 0 success, 1 no part is straight "
        "enough, 2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        linkage LINKAGE ?  a .toml or .json file, a catalog entry with dimensions, or lengths: four-bar:A,B,C,D,
            slider-crank:A,B[,E], inverted-slider-crank:A,D[,E], A,B,C,D
        point POINT ?  a named point, a joint, or LINK:X,Y in the coordinates of the link; X,Y alone: on the coupler
        """
    )
    take(
        parser.add_mutually_exclusive_group(),
        """
        --straight  the part of the path with a relative deviation Q_G = deviation/length (--ratio), in a band (--band)
            or between two drive values (--window)
        --cognates  the cognates of a four-bar or slider-crank (Roberts, Chebyshev)
        --guidance NAME ? :  a straight-line linkage such as watt; alone: all
        """,
    )
    parser.take(
        """
        --range
        --branch
        --direction DEG float  turning points in this direction (default: x and y); with --straight: the direction of
            the line (default: the tangent, or the best line)
        --contact VALUE float ...  the order of contact with the tangent at this drive value; repeatable
        --tolerance LENGTH float  error of the polygon (default: 1e-4 of the size)
        """
    )
    take(
        parser.add_argument_group(title="with --straight"),
        """
        --ratio Q float  the window about --centre with this Q_G
        --band WIDTH  the longest part in a band of this width; with --guidance: 0.75mm
        --window FROM TO float  the part between two drive values
        --centre DEG float  the middle of the window (default: 180)
        """,
    )
    take(parser.add_argument_group(title="with --cognates"), "--at DEG float  crank angle of the pose shown")
    take(
        parser.add_argument_group(title="with --guidance"),
        """
        --length L  length of the straight line, with or without unit: 15cm; needs --band
        --lambda X float  construct Meyer zur Capellen's double rocker: distance of the coupler from the tangent by the
            diameter, 0.5 to 1.5
        --phi0 DEG float  with --lambda: an angle other than that of six-point contact
        --kappa DEG float  construct it for this angle between line and frame (two solutions)
        --diameter D float  with --lambda or --kappa: of the inflection circle (default: 1)
        """,
    )
    parser.add_printed(help="print an object; with --guidance and no name, a list", table=True)


def run(arguments: argparse.Namespace) -> int:
    """The path of a point, or what is asked about it; status 1 if no part of it is straight enough."""
    question = next((name for name in _MODES if getattr(arguments, name) not in (None, False)), _PATH)
    _check(arguments, question)
    if question and is_table(arguments.out):
        raise GrueblerError("-o {path}: only the path of a point is written as .csv", path=arguments.out)
    return _MODES[question](arguments) if question else _path(arguments)


def _check(arguments: argparse.Namespace, question: str) -> None:
    """An option that does not go with the question is an error, not ignored."""
    for option, questions in _GIVEN_WITH.items():
        if question not in questions and getattr(arguments, option) not in (None, []):
            given_with = [f"--{name}" if name else message("the path of a point") for name in questions]
            raise GrueblerError("--{option} goes with {questions}", option=option, questions=joined_by_or(given_with))
    if question == "guidance":
        if arguments.linkage is not None:
            raise GrueblerError("--guidance takes one name and no linkage, but found {word!r}", word=arguments.linkage)
    elif arguments.point is None:
        raise GrueblerError("expected a linkage and a point, such as four-bar:25,70,40,70 coupler:45,40")


def _path(arguments: argparse.Namespace) -> int:
    """Length, area, contact, then a table of what is on the path."""
    unit = "mm" if arguments.json else ""  # the linkage as JSON must have a unit, lengths have none
    linkage, _ = linkage_of_word(arguments.linkage, language_of_names(arguments), unit=unit)
    path = driven_path(arguments.range, linkage)
    if path is not None and arguments.contact:
        raise GrueblerError("--contact needs the whole motion of one drive: leave --range out")
    curve = coupler_curve(
        linkage, point_of(arguments.point), branch=arguments.branch, tolerance=arguments.tolerance, drives=path
    )
    turning = curve.point_path.cycle.turning_drive
    drives = [math.radians(value) if turning else value for value in arguments.contact]
    contacts = [curve.contact(drive) for drive in drives]
    directions = (0.0, 90.0) if arguments.direction is None else (arguments.direction,)
    if is_table(arguments.out):
        write_table(arguments.out, _polygon(curve), arguments.lang, decimal_comma=arguments.decimal_comma)
    if arguments.json:
        print_json(_document(curve, contacts, directions))
    elif not is_table(arguments.out):
        _print(curve, list(zip(drives, contacts, strict=True)), directions, arguments.lang)
    return 0


def _polygon(curve: CouplerCurve) -> list[Column]:
    linkage, z = curve.point_path.cycle.linkage, curve.points
    values = _values(curve, curve.drives)
    drives = zip(linkage.mechanism.drive_names(), linkage.mechanism.drives, values.T, strict=True)
    return [
        *(Column(name, unit="°" if drive.turning else linkage.unit, values=own) for name, drive, own in drives),
        Column("x", unit=linkage.unit, values=z.real),
        Column("y", unit=linkage.unit, values=z.imag),
        Column("s", unit=linkage.unit, values=curve.arcs),
    ]


def _values(curve: CouplerCurve, at: Reals) -> Reals:
    """The values of all drives, turning ones in degrees; (n, drives)."""
    cycle = curve.point_path.cycle
    values = cycle.values(at) if isinstance(cycle, PathCycle) else np.asarray(at)[:, None]
    turning = [drive.turning for drive in cycle.linkage.mechanism.drives]
    return np.where(turning, np.degrees(values), values)


# --- output ----------------------------------------------------------------------------------------


def _print(
    curve: CouplerCurve, contacts: list[tuple[float, TangentContact]], directions: tuple[float, ...], lang: str
) -> None:
    unit = curve.point_path.cycle.linkage.unit
    if curve.area is not None:
        closed = _CROSSED if curve.double_points else _CLOCKWISE if curve.area < 0 else _COUNTERCLOCKWISE
        length = length_message(curve.length, unit)
        area = length_message(
            round(curve.area if curve.double_points else abs(curve.area), 9) + 0.0, f"{unit}²" if unit else ""
        )
        print(closed.filled(length=length, area=area).in_language(lang))
    else:
        span = curve.point_path.cycle.span
        low, high = (_drive(curve, value, lang) for value in (span.low, span.high))
        print(
            translate(
                "The path goes from {low} to {high}: length {length}.",
                lang,
                low=low,
                high=high,
                length=length_message(curve.length, unit),
            )
        )
    if curve.retraced:
        print(translate("The point returns on the same path.", lang))
    for drive, contact in contacts:
        print(_contact_text(_drive(curve, drive, lang), contact).in_language(lang))
    rows = _rows(curve, directions, lang)
    print()
    if rows:
        headers = (message("feature"), message("drive"), "x", "y", "")
        print_table(headers, rows, numbers=[1, 2, 3], lang=lang)
    else:
        print(translate("The path has no special points.", lang))


def _contact_text(drive: str, contact: TangentContact) -> Message:
    if contact.points is None:
        return message("At {drive} the path agrees with its tangent up to order 10.", drive=drive)
    return message(
        "At {drive} path and tangent have {points} points in common: y = {coefficient:n} x^{points}.",
        drive=drive,
        points=contact.points,
        coefficient=contact.coefficient,
    )


def _rows(curve: CouplerCurve, directions: tuple[float, ...], lang: str) -> list[list[Cell]]:
    unit, size = curve.point_path.cycle.linkage.unit, curve.point_path.size
    rows: list[list[Cell]] = []

    def add(feature: Message, drives: tuple[float, ...], at: complex, note: Cell) -> None:
        places = [number(value if abs(value) > 1e-9 * size else 0.0, lang, "n") for value in (at.real, at.imag)]
        rows.append([feature, ", ".join(_drive(curve, drive, lang) for drive in drives), *places, note])

    for cusp in curve.cusps:
        add(message("cusp"), (cusp.drive,), cusp.at, _tangent(cusp.direction))
    for inflection in curve.inflections:
        feature = message("flat point") if inflection.flat else message("inflection")
        add(feature, (inflection.drive,), inflection.at, _tangent(inflection.direction))
    for vertex in curve.vertices:
        straight = abs(vertex.curvature) * size < 1e-9
        radius = "∞" if straight else number(1 / vertex.curvature, lang, "n")
        add(
            message("vertex"),
            (vertex.drive,),
            vertex.at,
            message("radius {radius}", radius=f"{radius} {unit}".rstrip()),
        )
    for double in curve.double_points:
        feature = message("self-contact") if double.touching else message("double point")
        add(feature, double.drives, double.at, message("angle {angle:n}°", angle=math.degrees(double.angle)))
    for direction in directions:
        for turn in curve.turning_points(math.radians(direction)):
            feature = message("extreme along {direction:g}°", direction=direction)
            add(feature, (turn.drive,), turn.at, message("min") if turn.kind.startswith("min") else message("max"))
    return rows


def _tangent(direction: float) -> Message:
    """The direction of a line in degrees, 0 up to 180."""
    return message("tangent {direction:n}°", direction=round(math.degrees(direction), 9) % 180)


def _drive(curve: CouplerCurve, value: float, lang: str) -> str:
    linkage = curve.point_path.cycle.linkage
    texts = []
    for drive, at in zip(linkage.mechanism.drives, _values(curve, np.array([value]))[0], strict=True):
        texts.append(
            number(at, lang, "n") + "°" if drive.turning else f"{number(at, lang, 'n')} {linkage.unit}".rstrip()
        )
    return " / ".join(texts)


_EVENTS = {
    Cusp: "drive at direction_deg flat",
    Inflection: "drive at direction_deg points",
    Vertex: "drive at curvature kind",
    DoublePoint: "drives at angle_deg touching",
    TurningPoint: "drive at kind",
}


def _document(curve: CouplerCurve, contacts: list[TangentContact], directions: tuple[float, ...]) -> dict[str, Any]:
    def drive(at: float) -> Any:
        """The value of the drive, along a path those of all drives."""
        values = _values(curve, np.array([at]))[0].tolist()
        return values if isinstance(curve.point_path.cycle, PathCycle) else values[0]

    units = {"drive": drive, "drives": drive}
    keys = "closed length area retraced cusps inflections vertices double_points"
    turning = {f"{angle:g}": curve.turning_points(math.radians(angle)) for angle in directions}
    return {
        **plain(curve, keys, units=units, shown=_EVENTS),
        "turning_points": plain(turning, units=units, shown=_EVENTS),
        "contacts": plain(contacts, "points coefficient"),
    }
