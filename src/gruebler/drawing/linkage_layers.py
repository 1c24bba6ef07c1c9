"""What a linkage picture may show beside the bodies: curves, dead centres, transmission angle, velocities, poles.

Each layer is a function of the stage; `LAYERS` names those that are asked for by name.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.drawing.figure import Arc, Circle, Lines, Point, Shape, Text
from gruebler.drawing.labels import noted
from gruebler.drawing.linkage_bodies import Part, at_pose, corners_of, slides
from gruebler.drawing.stage import Stage
from gruebler.drawing.symbols import RADIUS, arrow, straight_drive, turning_drive
from gruebler.errors import LinkageError
from gruebler.kinematics import Motion, circuit
from gruebler.kinematics.events import dead_centres
from gruebler.kinematics.outputs import find_output
from gruebler.kinematics.transmission import Leg, driving_legs
from gruebler.linkages import Line, Named

__all__ = ["LAYERS", "Sheet", "coupler_curve", "drive_arrows", "layer", "point_names", "thinned"]

Complexes = NDArray[np.complex128]


_FINE = 0.12  # pixels by which a drawn curve may be off
_SAMPLES = 720  # poses of a curve
_STEP = 0.03  # between samples of a circuit, in sizes
_RAY = 46.0  # pixels of the legs of an angle
_ARC = 34.0
_FASTEST = 74.0  # pixels of the longest velocity
_SLOW = 0.02  # of the fastest: slower points have no arrow
_AT_REST = 1e-7  # sizes for a drive of speed 1: below, a point leaves in the direction of its acceleration
_AWAY = 0.4  # of the figure's longer side: poles farther away from it are not shown


class Sheet(NamedTuple):
    """What a layer is drawn on."""

    stage: Stage
    output: str | None
    """The link or joint that is looked at; None for the linkage's own."""
    drawn: Sequence[Shape]
    """What is there already; texts keep clear of it."""


Layer = Callable[[Sheet], list[Shape]]


# --- curves --------------------------------------------------------------------------------------


def coupler_curve(stage: Stage, name: str) -> list[Shape]:
    """The path of a point through the range of the drive; where that is limited, the rest of its circuit thinly.

    Raises `LinkageError` for a name that is no point or joint, and with several drives.
    """
    point = stage.linkage.named(name)[-1]
    course = stage.driven()
    if stage.goes_round:
        drives = np.linspace(course.span.low, course.span.high, _SAMPLES * course.span.turns + 1)
        return [_curve(stage, course.at(drives, 0).complex_point(point), "curve")]
    rest = circuit(stage.linkage, branch=course.start.branch, drive=float(course.start.drives[0, 0]), step=_STEP)
    return [
        _curve(stage, rest.samples.complex_point(point), "curve-rest"),
        _curve(stage, stage.path.complex_point(point), "curve"),
    ]


def _curve(stage: Stage, z: Complexes, style: str) -> Lines:
    points = [stage.local(complex(one)) for one in z]
    closed = points[0].minus(points[-1]).length < 1e-3
    line = thinned(points, _FINE)
    return Lines((tuple(line[:-1] if closed and len(line) > 2 else line),), style, closed)


def thinned(points: Sequence[Point], most: float) -> list[Point]:
    """Fewer points of a line, so that it stays within a distance of the others (Douglas and Peucker 1973).

    >>> thinned([Point(0, 0), Point(1, 0.01), Point(2, 0)], 0.1)
    [Point(x=0, y=0), Point(x=2, y=0)]
    """
    xy = np.array(points, np.float64)
    kept = {0, len(xy) - 1}
    open_parts = [(0, len(xy) - 1)]
    while open_parts:
        a, b = open_parts.pop()
        if b - a < 2:
            continue
        along, inner = xy[b] - xy[a], xy[a + 1 : b] - xy[a]
        square = float(along @ along)
        part = np.clip(inner @ along / square, 0, 1) if square > 1e-12 else np.zeros(len(inner))
        far = np.hypot(*(inner - part[:, None] * along).T)
        k = int(far.argmax())
        if far[k] > most:
            middle = a + 1 + k
            kept.add(middle)
            open_parts += [(a, middle), (middle, b)]
    return [points[k] for k in sorted(kept)]


# --- drives --------------------------------------------------------------------------------------


def drive_arrows(stage: Stage) -> list[Shape]:
    """A curved arrow at every turning drive, a straight one beside every sliding one, in their positive sense."""
    lower = stage.lower
    shapes: list[Shape] = []
    for number, drive in enumerate(lower.mechanism.drives):
        first, other = lower.reference(number)
        e, f = lower.elements[drive.joint, first], lower.elements[drive.joint, other]
        at = stage.place(Named(other, f.x, f.y))
        if isinstance(e, Line):
            angle = e.angle + float(stage.pose.angle(first)[0])
            axis = Point(math.cos(angle), -math.sin(angle))
            if any(slide.joint == drive.joint and slide.sign == "cylinder" for slide in slides(stage)):
                at = at.plus(stage.place(Named(first, e.x, e.y)).minus(at), 0.5)
            shapes += straight_drive(at, axis, axis.across if axis.x < 0 else Point(0, 0).minus(axis.across))
        else:
            shapes += turning_drive(at, RADIUS + 10.0, _free_direction(stage, drive.joint, at))
    return shapes


def _free_direction(stage: Stage, joint: int, at: Point) -> float:
    """The middle of the widest gap between the bodies at a joint, the pedestal of the frame among them."""
    lower = stage.lower
    angles = []
    for link in lower.mechanism.chain.joints[joint].links:
        if link == lower.mechanism.frame:
            angles.append(math.pi / 2)
            continue
        pins = [(n, e) for (n, own), e in lower.elements.items() if own == link and n != joint]
        angles += [math.atan2(p.y - at.y, p.x - at.x) for n, e in pins if (p := stage.place(Named(link, e.x, e.y)))]
    angles = sorted(angles or [math.pi / 2])
    gaps = [(b - a, a) for a, b in zip(angles, [*angles[1:], angles[0] + 2 * math.pi], strict=True)]
    width, begin = max(gaps)
    return begin + width / 2


# --- layers by name ------------------------------------------------------------------------------


def _dead_centres(sheet: Sheet) -> list[Shape]:
    """The links as thin lines where the output stops."""
    stage = sheet.stage
    course = stage.driven()
    found = [centre.drive for centre in dead_centres(course, find_output(stage.linkage, sheet.output))]
    if not stage.goes_round:
        low, high = stage.path.drives[0, 0], stage.path.drives[-1, 0]
        found = [drive for drive in found if low <= drive <= high]
    if not found:
        return []
    motion = course.at(np.array(found), 0)
    return [shape for row in range(len(found)) for shape in _ghost(stage, motion, row)]


def _ghost(stage: Stage, motion: Motion, row: int) -> list[Shape]:
    """The outlines of all moving links, their guides and their joints."""
    lower, found = stage.lower, slides(stage)
    lines: list[tuple[Point, ...]] = []
    joints: dict[tuple[float, float], Point] = {}
    for link in lower.mechanism.chain.links:
        if link == lower.mechanism.frame:
            continue

        def moved(points: Iterable[Point], link: str = link) -> tuple[Point, ...]:
            shape = at_pose(stage, Part(0, link, (Lines((tuple(points),), "ghost"),)), motion, row)[0]
            assert isinstance(shape, Lines)
            return shape.parts[0]

        corners = moved(corners_of(stage, link, found))
        if len(corners) > 1:
            lines.append((*corners, corners[0]) if len(corners) > 2 else corners)
        guides = [slide for slide in found if slide.guide == link and slide.sign != "cylinder"]
        lines += [moved(map(stage.local, (slide.low, slide.high))) for slide in guides]
        own = [stage.local(complex(e.x, e.y)) for (_, holder), e in lower.elements.items() if holder == link]
        joints |= {(round(p.x, 1), round(p.y, 1)): p for p in moved(own)}
    return [Lines(tuple(lines), "ghost"), *(Circle(at, 4.0, "ghost-pin") for at in joints.values())]


def _transmission(sheet: Sheet) -> list[Shape]:
    """The angle between the force on the output and the normal of its way, with its value."""
    stage = sheet.stage
    stage.driven()
    pushed = [_push(stage, leg) for leg in driving_legs(stage.pose.plan, find_output(stage.linkage, sheet.output))]
    at, force, normal = min(pushed, key=lambda one: abs(cmath.phase(one[2] / one[1])))
    apex = stage.local(at)
    begin, extent = -cmath.phase(force), -cmath.phase(normal / force)
    rays = [(apex, Arc(apex, _RAY, begin, extent, "measure").place(part)) for part in (0, 1)]
    arc = Arc(apex, _ARC, begin, extent, "measure")
    shapes: list[Shape] = [Lines(tuple(rays), "measure"), arc]
    return [*shapes, noted(arc.place(0.5), f"μ = {math.degrees(abs(extent)):.1f}°", "value", [*sheet.drawn, *shapes])]


def _push(stage: Stage, leg: Leg) -> tuple[complex, complex, complex]:
    """Where a leg pushes, in which direction (from there back to the leg), and the nearer normal of the way there."""
    pose, chain = stage.pose, stage.lower.mechanism.chain

    def point(element: tuple[str, complex, complex]) -> complex:
        return complex(pose.complex_point(Named(element[0], element[1].real, element[1].imag))[0])

    def across(element: tuple[str, complex, complex]) -> complex:
        return 1j * complex(pose.turns[0, chain.index(element[0])]) * element[2]

    outer, inner = point(leg.outer), point(leg.inner)
    at = outer if leg.form == "RP" else inner
    force = outer - inner if leg.form == "RR" else across(leg.inner if leg.form == "RP" else leg.outer)
    if leg.guide is not None:
        kind, place = leg.guide
        way = place[2] if kind == "P" else 1j * (at - place[1])
    else:
        k = chain.index(leg.pushed)
        arm, w = at - pose.places[0, 0, k], float(pose.rates[0, 0, k])
        way = complex(pose.places[1, 0, k] + 1j * w * arm)
        if abs(way) < _AT_REST * stage.lower.size:
            way = complex(pose.places[2, 0, k] + (1j * pose.rates[1, 0, k] - w**2) * arm)
    normal = 1j * way
    return at, force, normal if (force.conjugate() * normal).real >= 0 else -normal


def _velocities(sheet: Sheet) -> list[Shape]:
    """Velocities of joints and named points for a drive of speed 1, with a scale below."""
    stage, course, lower = sheet.stage, sheet.stage.driven(), sheet.stage.lower
    mechanism = lower.mechanism
    places = list(lower.points.values())
    for number, joint in enumerate(mechanism.chain.joints):
        if joint.pair.name == "revolute" and mechanism.frame not in joint.links:
            e = lower.elements[number, joint.links[0]]
            places.append(Named(joint.links[0], e.x, e.y))
    pairs = {}
    for place in places:
        at, v = (complex(stage.pose.complex_point(place, order)[0]) for order in (0, 1))
        pairs[round(at.real, 9), round(at.imag, 9)] = at, v
    fastest = max((abs(v) for _, v in pairs.values()), default=0.0)
    if fastest < 1e-9 * lower.size:
        return []
    factor = _FASTEST / fastest
    shapes: list[Shape] = []
    for at, v in pairs.values():
        if abs(v) > _SLOW * fastest:
            way = Point(factor * v.real, -factor * v.imag)
            tip = stage.local(at).plus(way.unit, max(way.length - 7.0, 1.0))
            shapes += arrow(stage.local(at), tip, "velocity", "velocity-head")
    unit = f"{stage.linkage.unit}/{'rad' if course.turning_drive else stage.linkage.unit}"
    return [*shapes, *_bar(stage, factor, fastest, unit, "velocity", 0)]


def _scale_bar(sheet: Sheet) -> list[Shape]:
    """A length to compare with."""
    stage = sheet.stage
    return _bar(stage, stage.scale, 90.0 / stage.scale, stage.linkage.unit, "measure", 1)


def _bar(stage: Stage, factor: float, most: float, unit: str, style: str, row: int) -> list[Shape]:
    """A bar of a round number of units, below all that the linkage reaches."""
    round_number = _round(most)
    upper, lower = stage.reach
    left = Point(upper.x, lower.y + 52.0 + 22.0 * row)
    right = left.plus(Point(1.0, 0.0), round_number * factor)
    ends = [(p.plus(Point(0, 1), -4.0), p.plus(Point(0, 1), 4.0)) for p in (left, right)]
    words = Text(right.plus(Point(1.0, 0.0), 9.0), f"{round_number:g} {unit}", "value", "start")
    return [Lines(((left, right), *ends), style), words]


def _round(most: float) -> float:
    """The largest number of 1, 2, 5 times a power of ten that is not larger.

    >>> _round(0.3), _round(7.0)
    (0.2, 5.0)
    """
    power = math.floor(math.log10(most))
    return float(f"{max(k for k in (1, 2, 5) if k * 10.0**power <= most * (1 + 1e-9))}e{power}")


def _poles(sheet: Sheet) -> list[Shape]:
    """The instant centres of the links against the frame, where they lie at no joint and not far away."""
    stage = sheet.stage
    stage.driven()
    pose, chain, frame = stage.pose, stage.lower.mechanism.chain, stage.lower.mechanism.frame
    given = stage.linkage.mechanism.chain.links
    upper, lower = stage.reach
    away = _AWAY * max(lower.x - upper.x, lower.y - upper.y)
    frame_pins = [complex(e.x, e.y) for (_, own), e in stage.lower.elements.items() if own == frame]
    shapes: list[Shape] = []
    for k, link in enumerate(chain.links):
        w = float(pose.rates[0, 0, k])
        if link == frame or link not in given or abs(w) < 1e-6:
            continue
        pole = complex(pose.places[0, 0, k] + 1j * pose.places[1, 0, k] / w)
        at = stage.local(pole)
        beyond = max(upper.x - at.x, at.x - lower.x, upper.y - at.y, at.y - lower.y)
        if beyond > away or min((abs(pole - pin) for pin in frame_pins), default=1.0) < 1e-6 * stage.lower.size:
            continue
        cross = tuple((at.plus(d, -5.0), at.plus(d, 5.0)) for d in (Point(1.0, 1.0).unit, Point(1.0, -1.0).unit))
        shapes.append(Lines(cross, "edge"))
        shapes.append(noted(at, f"P({frame}, {link})", "value", [*sheet.drawn, *shapes]))
    return shapes


def point_names(stage: Stage, shapes: Sequence[Shape]) -> Iterable[Text]:
    """The names of points, beside them."""
    drawn = list(shapes)
    for name, point in stage.lower.points.items():
        text = noted(stage.place(point), name, "name", drawn)
        drawn.append(text)
        yield text


LAYERS: Mapping[str, Layer] = {
    "dead-centres": _dead_centres,
    "transmission": _transmission,
    "velocities": _velocities,
    "poles": _poles,
    "scale": _scale_bar,
}


def layer(name: str) -> Layer:
    """A layer by name; `LinkageError` names those there are."""
    if name not in LAYERS:
        raise LinkageError(f"there is no {name!r} to be shown; there are {', '.join(LAYERS)}")
    return LAYERS[name]
