"""Paths of coupler points in tables, checked against the general solver."""

from __future__ import annotations

import cmath
from math import acos, asin, atan, degrees, isclose, pi

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, joined, message
from gruebler.mechanics.analysis import measures
from gruebler.mechanics.fourbar import InvertedSliderCrank
from gruebler.mechanics.fourbar.crank_motion import CrankMotion
from gruebler.mechanics.geometry import Path, coupler_path, linkage_path, path_piece
from gruebler.mechanics.geometry.sizing import longest_in_band
from gruebler.mechanics.kinematics import from_degrees
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.teaching.exercises.solution import Solution, SolutionBuilder, angle, as_step, figure, with_turning_crank

STRIP = 1e-6
"""Tolerance of the width of a strip: its direction comes from samples."""
PATH = message("Path of the coupler point")
_RIGHT_ANGLE = message("The right angle lies at A, between crank and coupler: d is the hypotenuse.")
BY_SOLVER = message("Largest distance of the path from that of the general solver")


def check_path(builder: SolutionBuilder, linkage: Linkage, drives: Reals, points: Reals, branch: str) -> None:
    """Check the path against that of the general solver, whose point is ``C``."""
    moved = move_quietly(linkage, drives, branch=branch)
    apart = (
        float(np.abs(moved.complex_point("C") - (points[:, 0] + 1j * points[:, 1])).max()) if moved.complete else 1.0
    )
    builder.check(BY_SOLVER, 0.0, apart)


def read_points(points: str) -> list[tuple[float, float]]:
    """Coupler points as an exercise writes them, ``u,v; u,v``; `LinkageError` for any other text."""
    try:
        pairs = [tuple(float(x) for x in text.split(",")) for text in points.split(";")]
    except ValueError:
        pairs = []
    if not pairs or any(len(pair) != 2 for pair in pairs):
        raise LinkageError("coupler points are written u,v; u,v; ... in numbers, not {points!r}", points=points)
    return [(u, v) for u, v in pairs]


def four_bar(a: float, b: float, c: float, d: float, points: str, step: float = 15, unit: str = "mm") -> Solution:
    """The paths of coupler points ``u,v; u,v`` of a four-bar over a turn, B above the line A-B0.

    >>> solution = four_bar(30, 90, 100, 120, "45,40")
    >>> [round(x, 6) for x in solution.tables[0].rows[0]]
    [0.0, 10.267581, 56.882613]
    """
    size = with_turning_crank(a, b, c, d)
    chosen = read_points(points)
    as_step(step)
    builder = SolutionBuilder(unit=unit)
    builder.say(
        "A0 = (0, 0), B0 = (d, 0). The crank gives A; B is where the circle of radius b about A meets that "
        "of radius c about B0, above the line A-B0:",
        "A = a·(cos φ, sin φ), |AB| = b, |B0B| = c",
    )
    builder.say(
        "The coupler point lies u along A-B and v to its left; θ is the direction from A to B:",
        "K = A + u·(cos θ, sin θ) + v·(-sin θ, cos θ)",
    )
    drives = from_degrees(0, 360, step)
    motion = size.motion(drives)
    paths = [motion.point(u, v).value for u, v in chosen]
    names = [f"K{k}" if len(chosen) > 1 else "K" for k in range(1, len(chosen) + 1)]
    places = [
        message("{name}: u = {u}, v = {v} {unit}", name=name, u=figure(u), v=figure(v), unit=unit)
        for name, (u, v) in zip(names, chosen, strict=True)
    ]
    builder.say(joined(places, "; "))
    columns = ["φ [°]", *(f"{name}_{axis}" for name in names for axis in "xy")]
    rows = [(round(degrees(phi), 9), *(float(x) for path in paths for x in path[k])) for k, phi in enumerate(drives)]
    builder.table(PATH, columns, rows)
    upright = size.motion([pi / 2])
    for name, (u, v), path in zip(names, chosen, paths, strict=True):
        _add_upright(builder, name, upright, u, v)
        check_path(builder, size.linkage({"C": (u, v)}), drives, path, "+")
    return builder.done()


def _add_upright(builder: SolutionBuilder, name: str, motion: CrankMotion, u: float, v: float) -> None:
    """One place of the path: with the crank at right angles to the frame."""
    places = [[float(x) for x in motion.point(*where).value[0]] for where in ((u, v), (u, -v), (0.0, 0.0))]
    for axis, right, other_side, joint in zip("xy", *places, strict=True):
        key = f"{name}_{axis}"
        quantity = message("{axis} of {name} at φ = 90°", axis=axis, name=name)
        builder.keep(key, quantity, right, unit=builder.unit)
        builder.mistake(key, other_side, message("That lies on the other side of A-B: v counts to the left of it."))
        builder.mistake(key, right - joint, message("That is counted from A; the path is counted from A0."))


def conchoid(a: float, d: float, b: float, step: float = 30, unit: str = "mm") -> Solution:
    """The conchoid linkage: a coupler of length b through a block that swivels at B0, path of its end C.

    >>> solution = conchoid(30, 50, 90)
    >>> [round(x, 6) for x in solution.tables[0].rows[1][:4]]
    [30.0, 102.317779, -32.672422, 28.318259]
    """
    size = InvertedSliderCrank(a, d)
    if isclose(a, d):
        raise LinkageError("with a = d = {d:g} the joint A runs through B0, where the coupler has no direction", d=d)
    as_step(step)
    builder = SolutionBuilder(unit=unit)
    builder.say(
        "The coupler always points from A through the block at B0 = (d, 0); C lies at its end, b from A:",
        "C = A + b·(B0 - A)/|AB0|, |AB0| = √(a² + d² - 2·a·d·cos φ)",
    )
    drives = from_degrees(0, 360, step)
    rows = []
    for phi in drives.tolist():
        joint = a * cmath.exp(1j * phi)
        way_out = d - joint
        end = joint + b * way_out / abs(way_out)
        rows.append((round(degrees(phi), 9), end.real, end.imag, abs(way_out), degrees(cmath.phase(way_out))))
    builder.table(PATH, ["φ [°]", "C_x", "C_y", "|AB0|", message("direction [°]")], rows)
    if a < d:
        _add_swing(builder, size)
    points = np.array([row[1:3] for row in rows])
    check_path(builder, size.linkage({"C": (b, 0)}), drives, points, "+")
    _add_straight(builder, coupler_path(size, b, 0), linkage_path(size.linkage({"C": (b, 0)}), "C"), b / 180)
    return builder.done()


def _add_straight(builder: SolutionBuilder, path: Path, by_solver: Path, band: float) -> None:
    """The longest part of the path within a band."""
    unit = builder.unit
    piece = longest_in_band(path, 0.0, pi, band)
    builder.say(
        "Nearly straight: within a band of {band} {unit} C runs {length:.3f} {unit} far, from φ = {start:.2f}° to "
        "{end:.2f}°.",
        band=figure(band),
        length=piece.length,
        unit=unit,
        start=degrees(piece.start),
        end=degrees(piece.end),
    )
    builder.keep("length", message("length of the nearly straight part"), piece.length, unit=unit, symbol="L")
    again = path_piece(by_solver, piece.start, piece.end, piece.direction, samples=2001)
    builder.check("Length of this part, by the general solver", piece.length, again.length)
    width = message("Width of this part, by the general solver, and the band")
    builder.check(width, band, again.band, tolerance=STRIP)


def _add_swing(builder: SolutionBuilder, size: InvertedSliderCrank) -> None:
    a, d = size.a, size.d
    name = message("swing of the coupler")
    text = message("swing: in the dead centres the crank is at right angles to the coupler")
    swing = builder.find(
        "swing", name, "2·arcsin(a/d)", 2 * degrees(asin(a / d)), unit="°", symbol="ψ_H", text=text, a=a, d=d
    )
    name = message("crank angle of the dead centres")
    dead = builder.find("φ_T", name, "± arccos(a/d)", degrees(acos(a / d)), unit="°", either_sign=True, a=a, d=d)
    name = message("ratio of the times of both swings")
    builder.find(
        "time_ratio", name, "(360° - 2·φ_T)/(2·φ_T)", (180 - dead) / dead, unit="", symbol="k", φ_T=angle(dead)
    )
    builder.mistake("swing", 2 * degrees(atan(a / d)), _RIGHT_ANGLE)
    builder.mistake("swing", swing / 2, message("That is the swing to one side of the frame line only."))
    builder.mistake("φ_T", 90 - dead, message("That is the angle of the coupler; the crank is at right angles to it."))
    builder.mistake("φ_T", degrees(atan(d / a)), _RIGHT_ANGLE)
    builder.mistake("time_ratio", dead / (180 - dead), message("The longer time is divided by the shorter."))
    measured = measures(size.linkage())

    def between(quantity: Message) -> Message:
        return message("{quantity}, between the dead centres of the solved motion", quantity=quantity)

    builder.check(between(message("Swing")), swing, degrees(measured.travel or 0.0), "°")
    builder.check(between(message("Ratio of the times")), (180 - dead) / dead, measured.time_ratio or 0.0, "")
    half = 180 - degrees(measured.phi_max or 0.0) / 2
    builder.check(between(message("Crank angle of the dead centres")), dead, half, "°")
