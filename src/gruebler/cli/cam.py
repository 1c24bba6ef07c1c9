"""`gruebler cam`: a cam for a lift, the laws of motion, or what a given contour does."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import GrueblerError
from gruebler.base.events import Extremum
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, message, number
from gruebler.cli.machine_pictures import add_picture_options, angle_of, refuse_picture, write_machine_picture
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import Cell, print_table
from gruebler.cli.turn_table import print_turn, records, turn_degrees
from gruebler.files.text_files import read_text
from gruebler.machines.cams import (
    LAWS,
    Cam,
    CamReport,
    Flat,
    Follower,
    LiftSegment,
    Roller,
    SmoothContour,
    follower_motion,
    motion_law,
    read_lift,
)

_LAWS = (message("name"), message("law"), "C_v", "C_a", "C_j", "C_v·C_a")
_PARTS = (message("part"), message("from"), message("to"), message("lift"), message("law"))
_FIGURES = (message("quantity"), message("value"), message("at"))
_MOTION = (message("velocity per rad"), message("acceleration per rad²"))
_TABLE = (message("cam"), message("lift"), *_MOTION, message("pressure angle"), message("radius"), "x", "y")
_CONTOUR = (message("cam"), message("follower"), *_MOTION)
_JUMPS = {
    1: message("At {angle:n}° the velocity jumps by {size:n}{unit} per radian: an impact."),
    2: message("At {angle:n}° the acceleration jumps by {size:n}{unit} per radian²: infinite jerk."),
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A disc cam that turns counter-clockwise. LIFT lists its parts: 'rise LIFT ANGLE [LAW]', 'fall "
        "LIFT ANGLE [LAW]' and 'dwell [ANGLE]', angles in degrees (and the lift of a swinging follower too). Boundary "
        "values per radian, such as v0=0 a0=0 v1=5 a1=0, can replace the law. Velocity and acceleration are "
        "derivatives by the cam angle in radians.",
        epilog="Example: gruebler cam 'rise 20 60 3-4-5; dwell 30; fall 20 90 cycloidal; dwell' --base 40 --roller 10 "
        "-o cam.svg --plot. Exit status: 0 good, 1 undercut, 2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        lift LIFT ?  the lift over a turn; one dwell may omit its angle
        --laws  list the laws of motion with C_v, C_a, C_j
        --contour FILE  the points x y of a given contour, one per line: its follower motion
        --base R float  radius of the base circle
        --roller R float  roller follower with this radius
        --knife  knife-edge follower
        --flat E float ? :0.0  flat-faced follower; E: its distance from the pivot
        --offset E float =0  distance of the guide to the right of the cam's axis
        --swing ARM D float  swinging follower: length of its arm (0 for a flat face) and distance of its pivot
        --step DEG float  also a table over the turn with this step
        """
    )
    parser.add_printed(help="print an object; with --laws a list", pictures=True)
    parser.take(
        """
        --at DEG float  with -o: the cam angle shown (default: greatest pressure angle)
        --plot  with -o: add diagrams of lift, velocity and acceleration
        """
    )
    add_picture_options(parser, help="with --animate: seconds for a turn (default: 4)")


def run(arguments: argparse.Namespace) -> int:
    """Print laws, a cam's figures (1 if it is undercut), or the motion that a contour gives."""
    if arguments.laws + (arguments.lift is not None) + (arguments.contour is not None) != 1:
        example = "'rise 20 60; dwell 30; fall 20 90; dwell'"
        raise GrueblerError("expected one of: a lift such as {example}, --laws, --contour FILE", example=example)
    if arguments.lift is None:
        refuse_picture(arguments, message("a picture needs a cam given by its lift"))
    if arguments.laws:
        return _laws(arguments.json, arguments.lang)
    follower = _follower(arguments)
    if arguments.contour is not None:
        return _contour(arguments, follower)
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
        _print(cam, table, arguments.lang)
    return int(cam.findings().undercut)


def _picture(arguments: argparse.Namespace, cam: Cam) -> None:
    from gruebler.pictures.machines.cam_picture import animate_cam, draw_cam

    at, plot, lang = angle_of(arguments), arguments.plot, arguments.lang
    write_machine_picture(
        arguments,
        lambda: draw_cam(cam, at=at, plot=plot, lang=lang),
        lambda seconds: animate_cam(cam, plot=plot, seconds=seconds, lang=lang),
    )


def _laws(as_json: bool, lang: str) -> int:
    names = list(dict.fromkeys(motion_law(name).name for name in LAWS))
    peaks_by_law = [(name, motion_law(name).peaks()) for name in names]
    if as_json:
        print_json([{"law": name, **peaks._asdict()} for name, peaks in peaks_by_law])
    else:
        rows: list[list[Cell]] = [
            [name, motion_law(name).title, *(number(peak, lang, "n") for peak in peaks)] for name, peaks in peaks_by_law
        ]
        print_table(_LAWS, rows, numbers=range(2, 6), lang=lang)
    return 0


def _follower(arguments: argparse.Namespace) -> Follower:
    chosen = (arguments.flat is not None) + arguments.knife + (arguments.roller is not None)
    if chosen != 1:
        raise GrueblerError("expected one follower: --roller RADIUS, --knife or --flat")
    arm, distance = arguments.swing or (0.0, 0.0)
    if arguments.flat is not None:
        if arguments.offset:
            raise GrueblerError("--offset has no effect on a flat follower; leave it out")
        if arm:
            raise GrueblerError("a swinging flat face has no arm: give --swing 0 DISTANCE, and --flat FACE")
        return Flat(distance, arguments.flat)
    return Roller(arguments.roller or 0.0, arguments.offset, arm, distance)


def _contour(arguments: argparse.Namespace, follower: Follower) -> int:
    degrees = turn_degrees(10 if arguments.step is None else arguments.step)
    motion = follower_motion(
        SmoothContour.through(_contour_points(Path(arguments.contour))), follower, np.radians(degrees)
    )
    scale = 180 / math.pi if follower.swings else 1.0
    rows = np.stack([degrees, *(values * scale for values in motion)], axis=1).tolist()
    if arguments.json:
        keys = ("cam_deg", "follower", "velocity", "acceleration")
        print_json({"motion": records(keys, rows)})
    else:
        unit = "°" if follower.swings else ""
        print_turn(_CONTOUR, rows, (("n", "°"), ("n", unit), ("n", ""), ("n", "")), arguments.lang)
    return 0


def _contour_points(path: Path) -> list[tuple[float, float]]:
    """The points of a file with two numbers a line; `#` begins a comment."""
    points = []
    for line_number, line in enumerate(read_text(path).splitlines(), 1):
        cells = line.partition("#")[0].replace(",", " ").replace(";", " ").split()
        if not cells:
            continue
        try:
            x, y = (float(cell) for cell in cells)
        except ValueError:
            raise GrueblerError(
                "{path}, line {line_number}: expected two numbers, x and y, not {line!r}",
                path=path,
                line_number=line_number,
                line=line,
            ) from None
        points.append((x, y))
    return points


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


def _print(cam: Cam, table: list[list[float]] | None, lang: str) -> None:
    unit, scale = ("°", 180 / math.pi) if cam.follower.swings else ("", 1.0)
    rows = []
    for segment, start, change in _parts(cam):
        span = (_degrees(start, lang), _degrees(start + segment.angle, lang))
        lift = number(change, lang, "+.6g") + unit if segment.law else ""
        kind = message("motion") if segment.law else message("dwell")
        rows.append((kind, *span, lift, segment.law.title if segment.law else ""))
    print_table(_PARTS, rows, numbers=(1, 2, 3), lang=lang)
    for jump in cam.lift.jumps():
        text = _JUMPS[jump.order].filled(angle=math.degrees(jump.at), size=jump.size * scale, unit=unit)
        print(text.in_language(lang))
    print()
    report = cam.findings()
    figures: list[tuple[Message, Extremum | None, bool]] = [
        (message("least pressure angle"), report.pressure[0], True),
        (message("greatest pressure angle"), report.pressure[1], True),
        (message("least convex radius of curvature"), report.convex, False),
        (message("least concave radius of curvature"), report.hollow, False),
    ]
    if cam.follower.has_face:
        figures += [
            (message("face needed, one side"), report.face[0], False),
            (message("face needed, other side"), report.face[1], False),
        ]
    cells = [
        (name, _degrees(figure.value, lang) if angle else number(figure.value, lang, "n"), _degrees(figure.at, lang))
        for name, figure, angle in figures
        if figure
    ]
    print_table(_FIGURES, cells, numbers=(1, 2), lang=lang)
    print(_undercut_text(cam, report).in_language(lang))
    if table is not None:
        print()
        units = ("°", unit, "", "", "°", "", "", "")
        print_turn(_TABLE, table, [("n", each) for each in units], lang)


def _undercut_text(cam: Cam, report: CamReport) -> Message:
    if not report.undercut:
        return message("No undercut.")
    angle = math.degrees(report.room.at)
    if cam.follower.radius:
        return message(
            "Undercut: the profile crosses itself near {angle:n}°. A larger base circle or a smaller roller helps.",
            angle=angle,
        )
    return message("Undercut: the profile crosses itself near {angle:n}°. A larger base circle helps.", angle=angle)


def _degrees(angle: float, lang: str) -> str:
    return number(math.degrees(angle), lang, "n") + "°"


def _document(cam: Cam, table: list[list[float]] | None) -> dict[str, Any]:
    report = cam.findings()
    extremum = "value at_deg"
    document: dict[str, Any] = {
        "parts": [_part(segment, start, change) for segment, start, change in _parts(cam)],
        "jumps": plain([*cam.lift.jumps()], "at_deg order size"),
        "start": math.degrees(cam.start) if cam.follower.swings else cam.start,
        "pressure_angle_deg": plain([*report.pressure], extremum, units={"value": math.degrees}),
        "convex_radius": plain(report.convex, extremum),
        "hollow_radius": plain(report.hollow, extremum),
        "face": plain([*report.face], extremum) if cam.follower.has_face else None,
        "undercut": report.undercut,
    }
    if table is not None:
        keys = ("cam_deg", "lift", "velocity", "acceleration", "pressure_angle_deg", "radius", "x", "y")
        document["table"] = records(keys, table)
    return document


def _part(segment: LiftSegment, start: float, change: float) -> dict[str, Any]:
    name = segment.law.name if segment.law else None
    return {"from_deg": math.degrees(start), "angle_deg": math.degrees(segment.angle), "lift": change, "law": name}
