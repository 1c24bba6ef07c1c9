"""`gruebler cam`: a cam for a lift, the laws of motion, or what a given contour does."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.cams import (
    LAWS,
    Cam,
    CamExtremum,
    Flat,
    Follower,
    LiftSegment,
    Roller,
    SmoothContour,
    follower_motion,
    motion_law,
    read_lift,
)
from gruebler.cli.machine_pictures import add_picture_options, angle_of, refuse_picture, write_picture
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.cli.turn_table import print_turn, records, turn_degrees
from gruebler.errors import GrueblerError
from gruebler.text import message

__all__ = ["add", "run"]

_WORDS = {
    "en": {
        "laws": ("law", "C_v", "C_a", "C_j", "C_v·C_a"),
        "parts": ("part", "from", "to", "lift", "law"),
        "dwell": "dwell",
        "motion": "motion",
        "jump": "At {at}° the {what} jumps by {size} per radian{square}: {effect}.",
        "orders": {1: ("velocity", "", "a blow"), 2: ("acceleration", "²", "infinite jerk")},
        "finding": ("quantity", "value", "at"),
        "pressure_least": "least pressure angle",
        "pressure_greatest": "greatest pressure angle",
        "convex": "least convex radius of curvature",
        "hollow": "least hollow radius of curvature",
        "face_least": "face needed, one side",
        "face_greatest": "face needed, other side",
        "undercut": "Undercut: the profile crosses itself near {at}°; a larger base circle{roller} helps.",
        "smaller": " or a smaller roller",
        "fine": "No undercut.",
        "table": ("cam", "lift", "velocity", "acceleration", "pressure angle", "radius", "x", "y"),
        "contour": ("cam", "follower", "velocity", "acceleration"),
    },
    "de": {
        "laws": ("Gesetz", "C_v", "C_a", "C_j", "C_v·C_a"),
        "parts": ("Abschnitt", "von", "bis", "Hub", "Gesetz"),
        "dwell": "Rast",
        "motion": "Bewegung",
        "jump": "Bei {at}° springt die {what} um {size} je Radiant{square}: {effect}.",
        "orders": {1: ("Geschwindigkeit", "", "Stoß"), 2: ("Beschleunigung", "²", "unendlicher Ruck")},
        "finding": ("Größe", "Wert", "bei"),
        "pressure_least": "kleinster Druckwinkel",
        "pressure_greatest": "größter Druckwinkel",
        "convex": "kleinster Krümmungsradius, konvex",
        "hollow": "kleinster Krümmungsradius, hohl",
        "face_least": "nötige Tellerbreite, eine Seite",
        "face_greatest": "nötige Tellerbreite, andere Seite",
        "undercut": "Unterschnitt: Das Profil überschneidet sich bei {at}°; ein größerer Grundkreis{roller} hilft.",
        "smaller": " oder eine kleinere Rolle",
        "fine": "Kein Unterschnitt.",
        "table": ("Kurve", "Hub", "Geschwindigkeit", "Beschleunigung", "Druckwinkel", "Radius", "x", "y"),
        "contour": ("Kurve", "Abtrieb", "Geschwindigkeit", "Beschleunigung"),
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A disc cam that turns counter-clockwise. LIFT is a row of 'rise LIFT ANGLE [LAW]', 'fall LIFT "
        "ANGLE [LAW]', 'dwell [ANGLE]' with angles in degrees (the lift of a swinging follower too); instead of a law "
        "boundary values per radian, such as v0=0 a0=0 v1=5 a1=0. Rates are told per radian of the cam.",
        epilog="Example: gruebler cam 'rise 20 60 3-4-5; dwell 30; fall 20 90 cycloidal; dwell' --base 40 --roller 10 "
        "-o cam.svg --plot. Exit status: 0 good, 1 undercut, 2 wrong usage or unreadable input.",
    )
    parser.add_argument("lift", nargs="?", metavar="LIFT", help="the lift over a turn; one dwell may take the rest")
    parser.add_argument("--laws", action="store_true", help="the laws of motion with C_v, C_a, C_j")
    parser.add_argument(
        "--contour", metavar="FILE", help="points x y of a given contour, one a line: the motion it gives"
    )
    parser.add_argument("--base", type=float, metavar="R", help="radius of the base circle")
    parser.add_argument("--roller", type=float, metavar="R", help="a roller with this radius")
    parser.add_argument("--knife", action="store_true", help="a knife edge")
    parser.add_argument(
        "--flat", type=float, nargs="?", const=0.0, metavar="E", help="a flat face; E: how far from its pivot"
    )
    parser.add_argument(
        "--offset", type=float, default=0.0, metavar="E", help="the guide lies so far right of the axis"
    )
    parser.add_argument(
        "--swing", type=float, nargs=2, metavar=("ARM", "D"), help="arm length (0 for a face) and distance of the pivot"
    )
    parser.add_argument("--step", type=float, metavar="DEG", help="a table of the turn in such steps")
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.add_argument(
        "--at", type=float, metavar="DEG", help="with -o: the cam's angle (default: greatest pressure angle)"
    )
    parser.add_argument("--plot", action="store_true", help="with -o: lift, velocity and acceleration beneath")
    add_picture_options(parser, "a turn")


def run(arguments: argparse.Namespace) -> int:
    """Print laws, a cam's figures (1 if it is undercut), or the motion that a contour gives."""
    words: dict[str, Any] = _WORDS[arguments.lang]
    if arguments.laws + (arguments.lift is not None) + (arguments.contour is not None) != 1:
        example = "'rise 20 60; dwell 30; fall 20 90; dwell'"
        raise GrueblerError("expected one of: a lift such as {example}, --laws, --contour FILE", example=example)
    if arguments.lift is None:
        refuse_picture(arguments, message("a picture is drawn of a cam for a lift"))
    if arguments.laws:
        return _laws(arguments.json, words)
    follower = _follower(arguments)
    if arguments.contour is not None:
        return _contour(arguments, follower, words)
    if arguments.base is None:
        raise GrueblerError("a cam needs --base RADIUS, the radius of its base circle")
    lift = read_lift(arguments.lift)
    if follower.swings:
        lift = lift.scaled(math.pi / 180)
    cam = Cam(lift, arguments.base, follower)
    table = _table(cam, turn_degrees(arguments.step)) if arguments.step is not None else None
    _picture(arguments, cam)
    if arguments.json:
        print_json(_document(cam, table))
    else:
        _print(cam, table, words)
    return int(cam.findings().undercut)


def _picture(arguments: argparse.Namespace, cam: Cam) -> None:
    from gruebler.drawing.machines.cam_picture import animate_cam, draw_cam

    at, plot, lang = angle_of(arguments), arguments.plot, arguments.lang
    write_picture(
        arguments,
        lambda: draw_cam(cam, at, plot=plot, lang=lang),
        lambda seconds: animate_cam(cam, plot=plot, seconds=seconds, lang=lang),
    )


def _laws(as_json: bool, words: dict[str, Any]) -> int:
    names = list(dict.fromkeys(motion_law(name).name for name in LAWS))
    found = [(name, motion_law(name).peaks()) for name in names]
    if as_json:
        print_json([{"law": name, **peaks._asdict()} for name, peaks in found])
    else:
        rows = [(name, *(f"{peak + 0.0:.6g}" for peak in peaks)) for name, peaks in found]
        print_table(words["laws"], rows, numbers=range(1, 5))
    return 0


def _follower(arguments: argparse.Namespace) -> Follower:
    chosen = (arguments.flat is not None) + arguments.knife + (arguments.roller is not None)
    if chosen != 1:
        raise GrueblerError("expected one follower: --roller RADIUS, --knife or --flat")
    arm, distance = arguments.swing or (0.0, 0.0)
    if arguments.flat is not None:
        if arguments.offset:
            raise GrueblerError("--offset changes nothing for a flat follower and is not taken")
        if arm:
            raise GrueblerError("a swinging flat face has no arm: give --swing 0 DISTANCE, and --flat FACE")
        return Flat(distance, arguments.flat)
    return Roller(arguments.roller or 0.0, arguments.offset, arm, distance)


def _contour(arguments: argparse.Namespace, follower: Follower, words: dict[str, Any]) -> int:
    path = Path(arguments.contour)
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise GrueblerError(
            "{path}: cannot be read: {value}", path=path, value=getattr(error, "strerror", None) or error
        ) from None
    points = []
    for number, line in enumerate(lines, 1):
        cells = line.partition("#")[0].replace(",", " ").replace(";", " ").split()
        if cells:
            try:
                points.append([float(cell) for cell in cells])
            except ValueError:
                raise GrueblerError(
                    "{path}, line {number}: expected two numbers, x and y, not {line!r}",
                    path=path,
                    number=number,
                    line=line,
                ) from None
            if len(cells) != 2:
                raise GrueblerError(
                    "{path}, line {number}: expected two numbers, x and y, not {line!r}",
                    path=path,
                    number=number,
                    line=line,
                )
    degrees = turn_degrees(10 if arguments.step is None else arguments.step)
    found = follower_motion(SmoothContour.through(points), follower, np.radians(degrees))
    scale = 180 / math.pi if follower.swings else 1.0
    rows = np.stack([degrees, *(one * scale for one in found)], axis=1).tolist()
    if arguments.json:
        keys = ("cam_deg", "follower", "velocity", "acceleration")
        print_json({"motion": records(keys, rows)})
    else:
        unit = "°" if follower.swings else ""
        print_turn(words["contour"], rows, ("{:g}°", f"{{:.6f}}{unit}", "{:.6f}", "{:.6f}"))
    return 0


def _parts(cam: Cam) -> list[tuple[LiftSegment, float, float]]:
    scale = 180 / math.pi if cam.follower.swings else 1.0
    return [
        (segment, start, segment.change * scale)
        for segment, start in zip(cam.lift.segments, cam.lift.starts, strict=True)
    ]


def _table(cam: Cam, degrees: NDArray[np.float64]) -> list[list[float]]:
    """Rows of the table; the lift of a swinging follower in degrees, rates per radian of the cam."""
    phi, scale = np.radians(degrees), 180 / math.pi if cam.follower.swings else 1.0
    rates = (cam.lift.at(phi, order) * scale for order in range(3))
    with np.errstate(divide="ignore"):
        radius = 1 / cam.curvature(phi)
    table = np.column_stack([degrees, *rates, np.degrees(cam.pressure_angle(phi)), radius, cam.profile(phi)])
    noise = 1e-13 * np.abs(np.where(np.isfinite(table), table, 0)).max(axis=0)
    rows: list[list[float]] = np.where(np.abs(table) <= noise, 0.0, table).tolist()
    return rows


def _print(cam: Cam, table: list[list[float]] | None, words: dict[str, Any]) -> None:
    unit, scale = ("°", 180 / math.pi) if cam.follower.swings else ("", 1.0)
    rows = []
    for one, start, change in _parts(cam):
        span = (f"{math.degrees(start):.6g}°", f"{math.degrees(start + one.angle):.6g}°")
        named = words["motion" if one.law else "dwell"]
        rows.append((named, *span, f"{change:+.6g}{unit}" if one.law else "", one.law.name if one.law else ""))
    print_table(words["parts"], rows, numbers=(1, 2, 3))
    for jump in cam.lift.jumps():
        what, square, effect = words["orders"][jump.order]
        size = f"{jump.size * scale:+.6g}{unit}"
        print(words["jump"].format(at=_degrees(jump.at), what=what, size=size, square=square, effect=effect))
    print()
    report = cam.findings()
    lines: list[tuple[str, CamExtremum | None, bool]] = [
        ("pressure_least", report.pressure[0], True),
        ("pressure_greatest", report.pressure[1], True),
        ("convex", report.convex, False),
        ("hollow", report.hollow, False),
    ]
    if isinstance(cam.follower, Flat):
        lines += [("face_least", report.face[0], False), ("face_greatest", report.face[1], False)]
    cells = [(words[key], _said(one.value, angle), f"{_degrees(one.at)}°") for key, one, angle in lines if one]
    print_table(words["finding"], cells, numbers=(1, 2))
    roller = words["smaller"] if isinstance(cam.follower, Roller) and cam.follower.radius else ""
    print(words["undercut"].format(at=_degrees(report.room.at), roller=roller) if report.undercut else words["fine"])
    if table is not None:
        print()
        marks = ("°", unit, "", "", "°", "", "", "")
        print_turn(words["table"], table, [f"{{:.6g}}{mark}" for mark in marks])


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.6g}"


def _said(value: float, angle: bool) -> str:
    return f"{math.degrees(value) + 0.0:.6g}°" if angle else f"{value + 0.0:.6g}"


def _document(cam: Cam, table: list[list[float]] | None) -> dict[str, Any]:
    report = cam.findings()

    def told(one: CamExtremum | None, angle: bool = False) -> dict[str, float] | None:
        return one and {"value": math.degrees(one.value) if angle else one.value, "at_deg": math.degrees(one.at)}

    document: dict[str, Any] = {
        "parts": [_part(segment, start, change) for segment, start, change in _parts(cam)],
        "jumps": [
            {"at_deg": math.degrees(jump.at), "order": jump.order, "size": jump.size} for jump in cam.lift.jumps()
        ],
        "start": math.degrees(cam.start) if cam.follower.swings else cam.start,
        "pressure_angle_deg": [told(extremum, angle=True) for extremum in report.pressure],
        "convex_radius": told(report.convex),
        "hollow_radius": told(report.hollow),
        "face": [told(one) for one in report.face] if isinstance(cam.follower, Flat) else None,
        "undercut": report.undercut,
    }
    if table is not None:
        keys = ("cam_deg", "lift", "velocity", "acceleration", "pressure_angle_deg", "radius", "x", "y")
        document["table"] = records(keys, table)
    return document


def _part(segment: LiftSegment, start: float, change: float) -> dict[str, Any]:
    name = segment.law.name if segment.law else None
    return {"from_deg": math.degrees(start), "angle_deg": math.degrees(segment.angle), "lift": change, "law": name}
