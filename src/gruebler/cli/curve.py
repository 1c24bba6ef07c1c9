"""`gruebler curve`: the path of a point, with all that is on it."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np

from gruebler.analysis.drive_cycle import PathCycle
from gruebler.arrays import Reals
from gruebler.cli.analysis_table import Column, as_csv, check_csv
from gruebler.cli.drive_rows import driven_path
from gruebler.cli.linkage_inputs import linkage_of
from gruebler.cli.output import print_json, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.point_inputs import point_of
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.geometry import CouplerCurve, TangentContact, coupler_curve

__all__ = ["add", "run"]


_WORDS = {
    "en": {
        "closed": "The path is closed: length {length:.9g} {unit}, area {area:.9g} {unit}².",
        "open": "The path goes from {low} to {high}: length {length:.9g} {unit}.",
        "retraced": "The point goes back on its own way.",
        "contact": "At {drive} the tangent touches with {points} points: y = {coefficient:.9g} x^{points}.",
        "straight": "At {drive} the path does not leave its tangent up to the order 10.",
        "what": "what",
        "drive": "drive",
        "note": "",
        "none": "Nothing is on it.",
        "cusp": "cusp",
        "inflection": "inflection",
        "flat": "flat point",
        "vertex": "vertex",
        "double": "double point",
        "touch": "touches itself",
        "turn": "extreme along {direction:g}°",
        "tangent": "tangent {direction:.6g}°",
        "radius": "radius {radius:.6g} {unit}",
        "angle": "angle {angle:.6g}°",
    },
    "de": {
        "closed": "Die Bahn ist geschlossen: Länge {length:.9g} {unit}, Fläche {area:.9g} {unit}².",
        "open": "Die Bahn reicht von {low} bis {high}: Länge {length:.9g} {unit}.",
        "retraced": "Der Punkt läuft auf seiner eigenen Bahn zurück.",
        "contact": "Bei {drive} berührt die Tangente {points}punktig: y = {coefficient:.9g} x^{points}.",
        "straight": "Bei {drive} verlässt die Bahn ihre Tangente bis zur Ordnung 10 nicht.",
        "what": "was",
        "drive": "Antrieb",
        "note": "",
        "none": "Es liegt nichts darauf.",
        "cusp": "Spitze",
        "inflection": "Wendepunkt",
        "flat": "Flachpunkt",
        "vertex": "Scheitel",
        "double": "Doppelpunkt",
        "touch": "berührt sich selbst",
        "turn": "Umkehrpunkt längs {direction:g}°",
        "tangent": "Tangente {direction:.6g}°",
        "radius": "Radius {radius:.6g} {unit}",
        "angle": "Winkel {angle:.6g}°",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="The path of a point over a whole turn of the drive, or its whole range, with all that is on it; "
        "drive values, places, radii.",
        epilog="Example: gruebler curve four-bar:25,70,40,70 coupler:45,40; gruebler curve lambda C --contact 180. "
        "A point whose link has another name is written LINK:X,Y in the coordinates of its link.",
    )
    parser.add_argument(
        "linkage", metavar="FILE|ID|LENGTHS", help="a file, a catalog entry, or lengths such as four-bar:25,70,40,70"
    )
    parser.add_argument("point", metavar="POINT|LINK:X,Y", help="a named point, a joint, or a point of a link")
    parser.add_argument(
        "--drive",
        action="append",
        default=[],
        metavar="FROM:TO:STEP",
        help="a straight path of the drives, in degrees or the unit, for several drives once each with as many steps; "
        "one number holds a drive still (default: the whole motion of one drive)",
    )
    parser.add_argument("--branch", metavar="B", help="the assembly mode, such as + or +-; write --branch=- for minus")
    parser.add_argument("--direction", type=float, metavar="DEG", help="turning points along this, not along x and y")
    parser.add_argument(
        "--contact", type=float, action="append", default=[], metavar="VALUE", help="how the tangent touches there"
    )
    parser.add_argument("--tolerance", type=float, metavar="LENGTH", help="of the polygon (default: 1e-4 of the reach)")
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.add_argument("-o", dest="csv", type=Path, metavar="FILE", help="the polygon as CSV: drive, x, y, way")


def run(arguments: argparse.Namespace) -> int:
    """Length, area, contact, then a table of what is on the path."""
    check_csv(arguments.csv)
    linkage, _ = linkage_of(arguments.linkage)
    path = driven_path(arguments.drive, linkage)
    if path is not None and arguments.contact:
        raise GrueblerError("--contact is for the whole motion of one drive: leave --drive away")
    found = coupler_curve(
        linkage, point_of(arguments.point), branch=arguments.branch, tolerance=arguments.tolerance, drives=path
    )
    turning = found.point_path.cycle.turning_drive
    drives = [math.radians(value) if turning else value for value in arguments.contact]
    contacts = [found.contact(drive) for drive in drives]
    directions = (0.0, 90.0) if arguments.direction is None else (arguments.direction,)
    if arguments.csv is not None:
        write_file(arguments.csv, as_csv(_polygon(found)).encode("utf-8"), arguments.lang)
    if arguments.json:
        print_json(_document(found, contacts, directions))
    else:
        _say(found, list(zip(drives, contacts, strict=True)), directions, arguments.lang)
    return 0


def _polygon(found: CouplerCurve) -> list[Column]:
    linkage, z = found.point_path.cycle.linkage, found.points
    values = _values(found, found.drives)
    units = ["°" if drive.turning else linkage.unit for drive in linkage.mechanism.drives]
    return [
        *(map(Column, linkage.mechanism.drive_names(), units, values.T)),
        Column("x", linkage.unit, z.real),
        Column("y", linkage.unit, z.imag),
        Column("s", linkage.unit, found.arcs),
    ]


def _values(found: CouplerCurve, at: Reals) -> Reals:
    """The values of all drives, turning ones in degrees; (n, drives)."""
    course = found.point_path.cycle
    values = course.values(at) if isinstance(course, PathCycle) else np.asarray(at)[:, None]
    turning = [drive.turning for drive in course.linkage.mechanism.drives]
    return np.where(turning, np.degrees(values), values)


# --- what is said ----------------------------------------------------------------------------------


def _say(
    found: CouplerCurve, contacts: list[tuple[float, TangentContact]], directions: tuple[float, ...], lang: str
) -> None:
    words, unit = _WORDS[lang], found.point_path.cycle.linkage.unit
    if found.area is not None:
        print(words["closed"].format(length=found.length, area=round(found.area, 9) + 0.0, unit=unit))
    else:
        low, high = (_drive(found, value) for value in found.point_path.cycle.span[:2])
        print(words["open"].format(low=low, high=high, length=found.length, unit=unit))
    if found.retraced:
        print(words["retraced"])
    for drive, contact in contacts:
        key = "straight" if contact.points is None else "contact"
        print(words[key].format(drive=_drive(found, drive), points=contact.points, coefficient=contact.coefficient))
    rows = _rows(found, directions, words)
    print()
    if rows:
        print_table([words["what"], words["drive"], "x", "y", words["note"]], rows, numbers=[1, 2, 3])
    else:
        print(words["none"])


def _rows(found: CouplerCurve, directions: tuple[float, ...], words: dict[str, str]) -> list[list[str]]:
    unit = found.point_path.cycle.linkage.unit
    rows = []

    def add(what: str, drives: tuple[float, ...], at: complex, note: str) -> None:
        noise = 1e-9 * found.point_path.size
        places = [f"{value if abs(value) > noise else 0.0:.6g}" for value in (at.real, at.imag)]
        rows.append([what, ", ".join(_drive(found, drive) for drive in drives), *places, note])

    for cusp in found.cusps:
        add(words["cusp"], (cusp.drive,), cusp.at, words["tangent"].format(direction=_axis(cusp.direction)))
    for inflection in found.inflections:
        what = words["flat" if inflection.flat else "inflection"]
        add(what, (inflection.drive,), inflection.at, words["tangent"].format(direction=_axis(inflection.direction)))
    for top in found.vertices:
        straight = abs(top.curvature) * found.point_path.size < 1e-9
        radius = math.inf if straight else 1 / top.curvature
        add(words["vertex"], (top.drive,), top.at, words["radius"].format(radius=radius, unit=unit).replace("inf", "∞"))
    for double in found.double_points:
        what = words["touch" if double.touching else "double"]
        add(what, double.drives, double.at, words["angle"].format(angle=math.degrees(double.angle)))
    for direction in directions:
        for turn in found.turning_points(math.radians(direction)):
            add(words["turn"].format(direction=direction), (turn.drive,), turn.at, turn.kind[:3])
    return rows


def _axis(angle: float) -> float:
    """The angle of a line in degrees, 0 up to 180."""
    return round(math.degrees(angle), 9) % 180


def _drive(found: CouplerCurve, value: float) -> str:
    linkage = found.point_path.cycle.linkage
    said = []
    for drive, one in zip(linkage.mechanism.drives, _values(found, np.array([value]))[0], strict=True):
        turning = drive.turning
        said.append(f"{round(one, 9) + 0.0:.6f}°" if turning else f"{one:.9g} {linkage.unit}")
    return " / ".join(said)


def _document(found: CouplerCurve, contacts: list[TangentContact], directions: tuple[float, ...]) -> dict[str, Any]:
    path = isinstance(found.point_path.cycle, PathCycle)

    def told(one: Any) -> dict[str, Any]:
        """An event as its fields, drives in degrees."""
        fields = {key: value for key, value in one._asdict().items() if key != "parameter"}
        for key in ("drive", "drives"):
            if key in fields:
                values = _values(found, np.atleast_1d(fields[key]))
                rows = values.tolist() if path else values[:, 0].tolist()
                fields[key] = rows if key == "drives" else rows[0]
        for key in ("direction", "angle"):
            if key in fields:
                fields[f"{key}_deg"] = math.degrees(fields.pop(key))
        return fields | {"at": [one.at.real, one.at.imag]}

    return {
        "closed": found.closed,
        "length": found.length,
        "area": found.area,
        "retraced": found.retraced,
        "cusps": [told(cusp) for cusp in found.cusps],
        "inflections": [told(inflection) for inflection in found.inflections],
        "vertices": [told(vertex) for vertex in found.vertices],
        "double_points": [told(double_point) for double_point in found.double_points],
        "turning_points": {
            f"{direction:g}": [told(turning_point) for turning_point in found.turning_points(math.radians(direction))]
            for direction in directions
        },
        "contacts": [{"points": contact.points, "coefficient": contact.coefficient} for contact in contacts],
    }
