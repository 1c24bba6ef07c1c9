"""Straight-line guides: lambda linkage, Watt's linkage, the crane's double rocker, Scott Russell's linkage."""

from __future__ import annotations

import cmath
from math import atan2, cos, degrees, hypot, pi, radians, sin, sqrt

import numpy as np

from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.geometry import Path, PathPiece, coupler_path, linkage_path, path_piece
from gruebler.mechanics.geometry.contact import tangent_contact
from gruebler.mechanics.geometry.lever_contact import lever_contact
from gruebler.mechanics.kinematics import from_degrees
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.teaching.exercises.coupler_points import BY_SOLVER, PATH, STRIP, check_path
from gruebler.teaching.exercises.solution import Solution, SolutionBuilder, as_step, figure


def lambda_linkage(a: float, b: float, c: float, d: float, e: float, step: float = 30, unit: str = "mm") -> Solution:
    """The Chebyshev lambda linkage with b = c = e: path of C beyond B, its height h, and its straightness.

    >>> solution = lambda_linkage(20, 50, 50, 40, 50)
    >>> round(solution.number("h"), 9), round(solution.number("band"), 6)
    (80.0, 0.195075)
    """
    if not b == c == e or a + d >= 2 * b:
        raise LinkageError("the lambda linkage has b = c = e and a + d < 2 b, not {b:g}, {c:g}, {e:g}", b=b, c=c, e=e)
    size = FourBar(a, b, c, d)
    builder = SolutionBuilder(unit=unit)
    builder.say(
        "B is equally far from A, B0 and C (b = c = e): by Thales the angle A-B0-C is a right one.",
        "|B0C| = √((b + e)² - |AB0|²)",
    )
    text = message("height of C at φ = 180°, where A lies on the frame line and C straight above B0")
    name = message("height of C above the frame line")
    height = builder.find(
        "h", name, "√((b + e)² - (a + d)²)", sqrt((b + e) ** 2 - (a + d) ** 2), text=text, a=a, b=b, d=d, e=e
    )
    drives = from_degrees(0, 360, as_step(step))
    motion = size.motion(drives)
    points = motion.point(b + e).value
    rows = [
        (round(degrees(p), 9), *map(float, (*c_, *b_)))
        for p, c_, b_ in zip(drives, points, motion.B.value, strict=True)
    ]
    builder.table(PATH, ("φ [°]", "C_x", "C_y", "B_x", "B_y"), rows)
    _add_straight(builder, size, b + e)
    _check_piece(
        builder, path_piece(linkage_path(size.linkage({"C": (b + e, 0)}), "C"), pi / 2, 3 * pi / 2, direction=0)
    )
    check_path(builder, size.linkage({"C": (b + e, 0)}), drives, points, "+")
    builder.check("h, from the path at φ = 180°", height, float(coupler_path(size, b + e, 0)(np.array([pi]))[0].imag))
    builder.mistake(
        "h", sqrt((b + e) ** 2 - (d - a) ** 2), message("That is the height at φ = 0°, where the path is not straight.")
    )
    builder.mistake("h", b + e, message("C is not vertically above A but above B0."))
    return builder.done()


def _check_piece(builder: SolutionBuilder, again: PathPiece) -> None:
    """Check length and width of the straight part against the path of the general solver."""
    builder.check("{quantity}, by the general solver", builder.number("length"), again.length, quantity="L")
    builder.check(
        "{quantity}, by the general solver", builder.number("band"), again.band, tolerance=STRIP, quantity="Δ"
    )


def _add_straight(builder: SolutionBuilder, size: FourBar, reach: float) -> None:
    """The straight part of the lambda linkage's path, over half a turn of the crank."""
    half = path_piece(coupler_path(size, reach, 0), pi / 2, 3 * pi / 2, direction=0)
    text = message("straight part: from φ = 90° to 270° C runs along a length of")
    builder.find(
        "length", message("length of the straight part"), "|C_x(90°) - C_x(270°)|", half.length, symbol="L", text=text
    )
    name = message("deviation from the straight line there")
    builder.find("band", name, "max C_y - min C_y", half.band, symbol="Δ")
    name = message("deviation by length")
    builder.find("ratio", name, "Δ/L", half.ratio, unit="", symbol="Q", Δ=half.band, L=half.length)
    turn = coupler_path(size, reach, 0)(from_degrees(0, 360, 1))
    whole = message("That holds for the whole turn; the straight part takes half of it, from φ = 90° to 270°.")
    builder.mistake("length", float(np.ptp(turn.real)), whole)
    builder.mistake("band", float(np.ptp(turn.imag)), whole)
    builder.mistake("length", 2 * size.a, message("C does not follow A: read its own coordinates at φ = 90° and 270°."))


def watt_linkage(
    rocker: float, coupler: float, start: float = -35, stop: float = 25, step: float = 5, unit: str = "mm"
) -> Solution:
    """Watt's linkage, equal rockers level in the mid position, coupler upright: path of the coupler's middle F.

    >>> solution = watt_linkage(60, 30)
    >>> [round(x, 6) for x in solution.tables[0].rows[0]]
    [-35.0, -1.848841, -31.413059, 28.263391]
    """
    width, height = 2 * rocker, coupler
    size = FourBar(rocker, coupler, rocker, hypot(width, height))
    tilt = -atan2(height, width)
    left_pivot = complex(-rocker, height / 2)
    builder = SolutionBuilder(unit=unit)
    builder.say(
        "Mid position: both rockers level, pivots A0 = (-a, c/2) and B0 = (a, -c/2), the coupler upright with its "
        "middle F in the origin."
    )
    builder.say(
        "For each angle t of the left rocker: A by t, B on both circles, F in the middle.",
        "A = A0 + a·(cos t, sin t), |AB| = c, |B0B| = a, F = (A + B)/2",
    )
    values = from_degrees(start, stop, as_step(step))
    motion = size.motion(values - tilt, branch="-")
    if not motion.complete:
        raise LinkageError("the left rocker cannot reach these angles: {reason}", reason=motion.message)
    local = motion.point(coupler / 2).value
    path = left_pivot + (local[:, 0] + 1j * local[:, 1]) * cmath.exp(1j * tilt)
    right_angles = np.degrees(motion.output.value + tilt) % 360 - 180
    rows = [
        (round(degrees(t), 9), float(z.real), float(z.imag), float(r))
        for t, z, r in zip(values, path, right_angles, strict=True)
    ]
    last = message("right rocker [°]")
    builder.table(PATH, ["t [°]", "F_x", "F_y", last], rows)
    _add_watt_stroke(builder, size, tilt, left_pivot, coupler)
    _check_watt(builder, size, tilt, left_pivot, coupler)
    moved = move_quietly(size.linkage({"C": (coupler / 2, 0)}), values - tilt, branch="-")
    builder.check(BY_SOLVER, 0.0, float(np.abs(moved.complex_point("C") - local @ np.array([1, 1j])).max()))
    return builder.done()


def _add_watt_stroke(builder: SolutionBuilder, size: FourBar, tilt: float, left_pivot: complex, coupler: float) -> None:
    """The stroke of F within a strip about the straight line, of half-width rocker / 600."""
    from scipy.optimize import brentq

    side = size.a / 600
    path = coupler_path(size, coupler / 2, 0, branch="-")

    def at(t: float) -> complex:
        return left_pivot + complex(path(np.array([t - tilt]))[0]) * cmath.exp(1j * tilt)

    excess = {sign: lambda t, s=sign: s * at(t).real - side for sign in (-1, 1)}
    reach = next((t for t in np.radians(np.arange(1.0, 60.0)) if all(excess[s](s * t) > 0 for s in (-1, 1))), None)
    if reach is None:
        raise LinkageError(
            "F does not leave the strip of {side:g} {unit} at both ends within 60 degrees", side=side, unit=builder.unit
        )
    ends = [float(brentq(excess[sign], 0, sign * reach, xtol=1e-14)) for sign in (-1, 1)]
    low, high = (at(t).imag for t in ends)
    name = message("stroke with |F_x| ≤ {side} {unit}", side=figure(side), unit=builder.unit)
    builder.find("stroke", name, "F_y2 - F_y1", high - low, symbol="H", F_y1=low, F_y2=high)
    builder.keep("t_low", message("rocker at the lower end"), degrees(ends[0]), unit="°")
    builder.keep("t_high", message("rocker at the upper end"), degrees(ends[1]), unit="°")
    builder.mistake("stroke", high, message("That is the way from the middle to one end only."))
    contact = lever_contact(size, coupler / 2, 0, -tilt, branch="-")
    name = message("points that path and tangent have in common in the middle")
    builder.keep("n", name, contact.points)
    builder.say(
        "About the middle F_x grows with the power {points} of F_y only: path and tangent have {points} "
        "points in common there.",
        points=contact.points,
    )


def _check_watt(builder: SolutionBuilder, size: FourBar, tilt: float, left_pivot: complex, coupler: float) -> None:
    """Both ends of the stroke and the order of contact, by the general solver."""
    linkage = size.linkage({"F": (coupler / 2, 0)})
    ends = [radians(builder.number(key)) for key in ("t_low", "t_high")]
    moved = left_pivot + move_quietly(linkage, [t - tilt for t in ends], branch="-").complex_point("F") * cmath.exp(
        1j * tilt
    )

    def solved(quantity: Message) -> Message:
        return message("{quantity}, by the general solver", quantity=quantity)

    builder.check(solved(message("Stroke")), builder.number("stroke"), float(np.ptp(moved.imag)))
    for name, place in zip(("F_y1", "F_y2"), moved, strict=True):
        builder.check(solved(message("|F_x| at {end}", end=name)), size.a / 600, float(abs(place.real)))
    met = tangent_contact(move_quietly(linkage, -tilt, speed=1, branch="-"), "F").points
    builder.check(solved(message("Points in common")), builder.number("n"), float(met or 0), "")


def double_rocker(
    a: float,
    b: float,
    c: float,
    d: float,
    ac: float,
    frame: float,
    start: float = 10,
    stop: float = 30,
    step: float = 5,
    unit: str = "mm",
) -> Solution:
    """The crane's double rocker: coupler a, rockers b and d, frame c at an angle; C on the coupler, ac from A.

    >>> solution = double_rocker(30, 80, 60, 100, 60, frame=-47)
    >>> [round(x, 6) for x in solution.tables[0].rows[0][5:]]
    [84.071616, 43.677859]
    """
    size = FourBar(d, a, b, c)
    builder = SolutionBuilder(unit=unit)
    builder.say(
        "Pivot of the rocker d in the origin, of the rocker b at ({x}, {y}): the frame c lies at {angle}° to the "
        "horizontal. D is the joint of d, A that of b; C lies beyond D on the line A-D.",
        x=figure(c * cos(radians(frame))),
        y=figure(c * sin(radians(frame))),
        angle=figure(frame),
    )
    builder.say(
        "D follows from φ; A lies on the circle of radius a about D and that of radius b about the other pivot:",
        "D = d·(cos φ, sin φ), C = A + AC·(D - A)/a",
    )
    values = from_degrees(start, stop, as_step(step))
    tilt = radians(frame)
    motion = size.motion(values - tilt)
    if not motion.complete:
        raise LinkageError("the rocker d cannot reach these angles: {reason}", reason=motion.message)
    spin = cmath.exp(1j * tilt)
    local = motion.point(a - ac).value
    columns = [spin * (z[:, 0] + 1j * z[:, 1]) for z in (motion.B.value, motion.A.value, local)]
    rows = [
        (round(degrees(phi), 9), *(float(x) for column in columns for x in (column[k].real, column[k].imag)))
        for k, phi in enumerate(values)
    ]
    builder.table(PATH, ("φ [°]", "A_x", "A_y", "D_x", "D_y", "C_x", "C_y"), rows)
    ends = radians(start) - tilt, radians(stop) - tilt
    _add_strip(builder, size, coupler_path(size, a - ac, 0), ends, frame)
    _check_piece(builder, path_piece(linkage_path(size.linkage({"C": (a - ac, 0)}), "C", branch="+"), *ends))
    _check_limits(builder, size)
    check_path(builder, size.linkage({"C": (a - ac, 0)}), values - tilt, local, "+")
    return builder.done()


def _add_strip(builder: SolutionBuilder, size: FourBar, path: Path, ends: tuple[float, float], frame: float) -> None:
    """The straightness of the path of C, and the angles that the rocker can reach with a horizontal frame."""
    unit = builder.unit
    piece = path_piece(path, *ends)
    name = message("width of the strip in which C stays")
    builder.keep("band", name, piece.band, unit=unit, symbol="Δ")
    builder.keep("length", message("length of the path along it"), piece.length, unit=unit, symbol="L")
    direction = (degrees(piece.direction) + frame) % 180
    run = path(np.linspace(*ends, 201)) * cmath.exp(1j * radians(frame))
    for extent in (float(np.ptp(run.real)), float(np.ptp(run.imag))):
        builder.mistake(
            "band", extent, message("The width is measured at right angles to the strip, not along x or y.")
        )
    chord = 2 * size.a * abs(sin((ends[1] - ends[0]) / 2))
    builder.mistake("length", chord, message("That is how far the joint D comes; C lies beyond it."))
    builder.keep("direction", message("direction of the strip"), direction, unit="°")
    builder.say(
        "C stays in a strip of {band} {unit} over {length} {unit}, at {direction}° to the horizontal. Turned by "
        "a right angle that is the horizontal path of the load.",
        band=figure(piece.band),
        unit=unit,
        length=figure(piece.length),
        direction=figure(direction),
    )
    arc = size.limits[0]
    builder.keep("lowest", message("smallest angle of rocker and frame"), degrees(arc.start), unit="°")
    builder.keep("highest", message("largest angle of rocker and frame"), degrees(arc.end), unit="°")
    builder.say(
        "With a horizontal frame the chain would close only for φ from {start}° to {end}°.",
        start=figure(degrees(arc.start)),
        end=figure(degrees(arc.end)),
    )


def _check_limits(builder: SolutionBuilder, size: FourBar) -> None:
    """Check the limits of the rocker: the general solver has a position just inside and none just beyond."""
    linkage = size.linkage()
    for key, side in (("lowest", -1), ("highest", 1)):
        limit = builder.number(key)
        inside, beyond = (
            move_quietly(linkage, [radians(limit + off)], branch="+").complete for off in (-side * 1e-6, side * 1e-6)
        )
        builder.check(
            "By the general solver: {limit}° is the limit, it has no position beyond.",
            True,
            inside and not beyond,
            "",
            limit=figure(limit),
        )


def scott_russell(a: float, b: float, e: float, step: float = 15, unit: str = "mm") -> Solution:
    """The slider-crank with a = b = e: C, beyond A on the line B-A, moves exactly on the line through A0.

    >>> scott_russell(1, 1, 1).number("deviation")
    0.0
    """
    if not a == b == e:
        raise LinkageError("an exact straight line needs a = b = e, not {a:g}, {b:g}, {e:g}", a=a, b=b, e=e)
    size = SliderCrank(a, b)
    builder = SolutionBuilder(unit=unit)
    builder.say(
        "A is equally far from A0, B and C: by Thales the angle B-A0-C is a right one, so C lies on the line "
        "through A0 at right angles to the slider's path.",
        "C = A - e·(B - A)/b, C_x = 0, C_y = 2·a·sin φ",
    )
    drives = from_degrees(-60, 60, as_step(step))
    points = size.motion(drives).point(-e).value
    rows = [(round(degrees(p), 9), round(float(z[0]), 12), float(z[1])) for p, z in zip(drives, points, strict=True)]
    builder.table(PATH, ("φ [°]", "C_x", "C_y"), rows)
    name = message("largest deviation from the straight line")
    builder.find("deviation", name, "max |C_x|", max(abs(row[1]) for row in rows), symbol="Δ")
    check_path(builder, size.linkage({"C": (-e, 0)}), drives, points, "+")
    expected = max(abs(z[1] - 2 * a * sin(p)) for p, z in zip(drives.tolist(), points.tolist(), strict=True))
    builder.check("Largest difference from 2a·sin φ", 0.0, expected)
    return builder.done()
