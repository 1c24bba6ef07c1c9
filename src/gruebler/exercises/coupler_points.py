"""Paths of coupler points in tables, checked against the general solver."""

from __future__ import annotations

import cmath
from math import acos, asin, degrees, pi

import numpy as np
from numpy.typing import NDArray

from gruebler.catalog import Text
from gruebler.errors import LinkageError
from gruebler.exercises.solution import Solution, Way, angle, number
from gruebler.geometry import coupler_path, longest_piece
from gruebler.kinematics import degrees as turns
from gruebler.kinematics import measures, move
from gruebler.linkages import FourBar, InvertedSliderCrank, Linkage

__all__ = ["conchoid", "four_bar"]

Reals = NDArray[np.float64]

PATH = Text("Path of the coupler point", "Koppelkurve")
BY_SOLVER = (
    "Largest distance of the path from that of the general solver",
    "Größter Abstand der Koppelkurve von der des allgemeinen Lösers",
)


def headers(*names: str) -> list[Text]:
    """Headers that are the same in both languages."""
    return [Text(name, name) for name in names]


def check_path(way: Way, linkage: Linkage, drives: Reals, points: Reals, branch: str) -> None:
    """The path against the general solver's, whose point is ``C``."""
    moved = move(linkage, drives, branch=branch)
    apart = (
        float(np.abs(moved.complex_point("C") - (points[:, 0] + 1j * points[:, 1])).max()) if moved.complete else 1.0
    )
    way.check(*BY_SOLVER, 0.0, apart)


def _read_points(points: str) -> list[tuple[float, float]]:
    try:
        pairs = [tuple(float(x) for x in word.split(",")) for word in points.split(";")]
    except ValueError:
        pairs = []
    if not pairs or any(len(pair) != 2 for pair in pairs):
        raise LinkageError(f"coupler points are written u,v; u,v; ... in numbers, not {points!r}")
    return [(u, v) for u, v in pairs]


def four_bar(a: float, b: float, c: float, d: float, points: str, step: float = 15, unit: str = "mm") -> Solution:
    """The paths of coupler points ``u,v; u,v`` of a four-bar over a turn, B above the line A-B0.

    >>> found = four_bar(30, 90, 100, 120, "45,40")
    >>> [round(x, 6) for x in found.tables[0].rows[0]]
    [0.0, 10.267581, 56.882613]
    """
    size = FourBar(a, b, c, d)
    if "a" not in size.turning:
        raise LinkageError(f"the crank of the four-bar {a:g}, {b:g}, {c:g}, {d:g} does not turn fully: {size.type}")
    chosen = _read_points(points)
    way = Way(unit)
    way.say(
        "A0 = (0, 0), B0 = (d, 0). The crank gives A; B is where the circle of radius b about A meets that of radius "
        "c about B0, above the line A-B0:",
        "A0 = (0; 0), B0 = (d; 0). Die Kurbel bestimmt A; B liegt auf dem Kreis um A mit Radius b und dem um B0 mit "
        "Radius c, oberhalb der Geraden A-B0:",
        "A = a·(cos φ, sin φ), |AB| = b, |B0B| = c",
    )
    way.say(
        "The coupler point lies u along A-B and v to its left; θ is the direction from A to B:",
        "Der Koppelpunkt liegt um u längs A-B und um v links davon; θ ist die Richtung von A nach B:",
        "K = A + u·(cos θ, sin θ) + v·(-sin θ, cos θ)",
    )
    drives = turns(0, 360, step)
    motion = size.motion(drives)
    paths = [motion.point(u, v).value for u, v in chosen]
    names = [f"K{k}" if len(chosen) > 1 else "K" for k in range(1, len(chosen) + 1)]
    for name, (u, v) in zip(names, chosen, strict=True):
        way.say(f"{name}: u = {number(u)}, v = {number(v)} {unit}", f"{name}: u = {number(u)}, v = {number(v)} {unit}")
    columns = ["φ [°]", *(f"{name}_{axis}" for name in names for axis in "xy")]
    rows = [(round(degrees(phi), 9), *(float(x) for path in paths for x in path[k])) for k, phi in enumerate(drives)]
    way.table(PATH, headers(*columns), rows)
    for (u, v), path in zip(chosen, paths, strict=True):
        check_path(way, size.linkage({"C": (u, v)}), drives, path, "+")
    return way.done()


def conchoid(a: float, d: float, b: float, step: float = 30, unit: str = "mm") -> Solution:
    """The conchoid linkage: a coupler of length b through a block that swivels at B0, path of its end C.

    >>> found = conchoid(30, 50, 90)
    >>> [round(x, 6) for x in found.tables[0].rows[1][:4]]
    [30.0, 102.317779, -32.672422, 28.318259]
    """
    size = InvertedSliderCrank(a, d)
    way = Way(unit)
    way.say(
        "The coupler always points from A through the block at B0 = (d, 0); C lies at its end, b from A:",
        "Die Koppel zeigt stets von A durch den Gleitstein in B0 = (d; 0); C liegt an ihrem Ende, um b von A entfernt:",
        "C = A + b·(B0 - A)/|AB0|, |AB0| = √(a² + d² - 2·a·d·cos φ)",
    )
    drives = turns(0, 360, step)
    rows = []
    for phi in drives.tolist():
        joint = a * cmath.exp(1j * phi)
        way_out = d - joint
        end = joint + b * way_out / abs(way_out)
        rows.append((round(degrees(phi), 9), end.real, end.imag, abs(way_out), degrees(cmath.phase(way_out))))
    way.table(PATH, [*headers("φ [°]", "C_x", "C_y", "|AB0|"), Text("direction [°]", "Richtung [°]")], rows)
    if a < d:
        _add_swing(way, size)
    found = longest_piece(coupler_path(size, b, 0), 0.0, pi, band=b / 180, samples=721)
    en, de = f"a band of {number(b / 180)} {unit}", f"einem Streifen von {number(b / 180)} {unit}"
    way.say(
        f"Nearly straight: within {en} C runs {number(found.length)} {unit} far, from φ = {degrees(found.start):.2f}° "
        f"to {degrees(found.end):.2f}°.",
        f"Angenähert gerade: In {de} Breite läuft C {number(found.length)} {unit} weit, von φ = "
        f"{degrees(found.start):.2f}° bis {degrees(found.end):.2f}°.",
    )
    way.keep(
        "length",
        Text("length of the nearly straight stretch", "Länge des angenähert geraden Stücks"),
        found.length,
        unit=unit,
    )
    points = np.array([row[1:3] for row in rows])
    check_path(way, size.linkage({"C": (b, 0)}), drives, points, "+")
    return way.done()


def _add_swing(way: Way, size: InvertedSliderCrank) -> None:
    a, d = size.a, size.d
    name = Text("swing of the coupler", "Schwingwinkel der Koppel")
    text = Text(
        "swing: in the dead centres the crank is at right angles to the coupler",
        "Schwingwinkel: In den Totlagen steht die Kurbel senkrecht auf der Koppel",
    )
    swing = way.find(
        "swing", name, "2·arcsin(a/d)", 2 * degrees(asin(a / d)), unit="°", symbol="ψ_H", text=text, a=a, d=d
    )
    name = Text("crank angle of the dead centres", "Kurbelwinkel der Totlagen")
    dead = way.find("φ_T", name, "± arccos(a/d)", degrees(acos(a / d)), unit="°", a=a, d=d)
    name = Text("ratio of the times of both swings", "Zeitverhältnis der beiden Schwingungen")
    way.find("time_ratio", name, "(360° - 2·φ_T)/(2·φ_T)", (180 - dead) / dead, unit="", symbol="k", φ_T=angle(dead))
    found = measures(size.linkage())
    en, de = "between the dead centres of the solved motion", "zwischen den Totlagen der durchgerechneten Bewegung"
    way.check(f"Swing, {en}", f"Schwingwinkel, {de}", swing, degrees(found.travel or 0.0), "°")
