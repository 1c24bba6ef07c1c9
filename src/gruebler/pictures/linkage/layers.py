"""Additional content of a linkage picture: curves, other positions, and layers by name.

Each layer is a function of a `LayerContext`; `LAYERS` has them by name.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError, unknown
from gruebler.base.text import message, translate
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.analysis.drive_cycles import PathCycle
from gruebler.mechanics.analysis.events import stops
from gruebler.mechanics.analysis.link_planes import link_planes
from gruebler.mechanics.analysis.outputs import find_output
from gruebler.mechanics.analysis.plates import plates_of
from gruebler.mechanics.analysis.transmission import PushingLink, lines_of, push_of, pushing_links
from gruebler.mechanics.kinematics import Motion, circuit
from gruebler.mechanics.linkages import LinkPoint
from gruebler.mechanics.linkages.points import PointLike, place_of
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.shapes import ArcShape, CircleShape, Point, Polylines, Shape, TextShape
from gruebler.pictures.canvas.simplification import FINE, simplified
from gruebler.pictures.canvas.symbols import RADIUS, straight_drive, turning_drive, widest_gap
from gruebler.pictures.linkage.arrows import acceleration_arrows, velocity_arrows
from gruebler.pictures.linkage.bodies import BodyPart, bearing_sides, corners_of, in_link, shapes_at_pose
from gruebler.pictures.linkage.dimensions import dimension_lines, offset_letters
from gruebler.pictures.linkage.instant_centres import pole_marks
from gruebler.pictures.linkage.layer_context import Layer, LayerContext
from gruebler.pictures.linkage.letters import angle_marks, joint_letters, joint_names, length_letters
from gruebler.pictures.linkage.poles import centrode_lines, inflection_lines
from gruebler.pictures.linkage.posed_linkage import PosedLinkage
from gruebler.pictures.linkage.slides import slides

_SAMPLES = 720  # poses of a curve
_CHORD, _HALVINGS = 0.01, 12  # of a curve's width and height: farther poses get others between them, so many times
_STEP = 0.03  # between samples of a circuit, in sizes
_RAY = 46.0  # pixels of the legs of an angle
_ARC = 34.0
_SIDES = {"inner": message("{letter}_i"), "outer": message("{letter}_o")}  # German: innere und äußere Totlage
_AT_REST = 1e-7  # sizes for a drive of speed 1: below, a point leaves in the direction of its acceleration


# --- curves --------------------------------------------------------------------------------------


def coupler_curve_lines(posed: PosedLinkage, name: PointLike) -> list[Shape]:
    """The path of a point through the range of the drive; where that is limited, with its full circuit as a thin line.

    Raises `LinkageError` for a name that is no point or joint, and with several drives.
    """
    point = place_of(posed.linkage, name)
    cycle = posed.driven()
    if posed.repeats:
        drives = np.linspace(cycle.span.low, cycle.span.high, _SAMPLES * cycle.span.turns + 1)
        return [curve_of(posed, _evenly_dense(cycle, drives, point), "curve")]
    if isinstance(cycle, PathCycle):
        return [curve_of(posed, _evenly_dense(cycle, np.linspace(0, 1, _SAMPLES + 1), point), "curve")]
    whole_circuit = circuit(posed.linkage, branch=cycle.start.branch, at=float(cycle.start.drives[0, 0]), step=_STEP)
    return [
        curve_of(posed, whole_circuit.samples.complex_point(point), "curve-rest"),
        curve_of(posed, posed.path.complex_point(point), "curve"),
    ]


def _evenly_dense(cycle: Course, drives: Reals, point: LinkPoint) -> Complexes:
    """The path of a point at drive values, and between them where it moves far: a linkage may snap over in a degree."""
    z = cycle.at(drives, 0).complex_point(point)
    longest = _CHORD * float(np.ptp(z.real) + np.ptp(z.imag))
    for _ in range(_HALVINGS):
        far = np.flatnonzero(np.abs(np.diff(z)) > longest)
        if not len(far):
            break
        between = (drives[far] + drives[far + 1]) / 2
        drives = np.insert(drives, far + 1, between)
        z = np.insert(z, far + 1, cycle.at(between, 0).complex_point(point))
    return z


def curve_of(posed: PosedLinkage, z: Complexes, style: str) -> Polylines:
    """A line through places, simplified."""
    points = [posed.local(complex(place)) for place in z]
    closed = points[0].minus(points[-1]).length < 1e-3
    line = simplified(points, FINE)
    return Polylines((tuple(line[:-1] if closed and len(line) > 2 else line),), style, closed)


# --- drives --------------------------------------------------------------------------------------


def drive_arrows(posed: PosedLinkage, measured: int | None = None) -> list[Shape]:
    """A curved arrow at every turning drive, a straight one beside every sliding one, in their positive sense.

    None stands at the joint whose angle is ``measured``: the arrow of the angle takes its place.
    """
    return [shape for part in drive_parts(posed, measured) for shape in shapes_at_pose(posed, part)]


def drive_parts(posed: PosedLinkage, measured: int | None = None) -> list[BodyPart]:
    """The arrows of the drives, each as a part of a link of its joint; none at a roller, which turns idly."""
    lower = posed.lower
    body_parts: list[BodyPart] = []
    for number, drive in enumerate(lower.mechanism.drives if posed.linkage.mechanism.drives else ()):
        if drive.joint == measured or _is_roller(posed, drive.joint):
            continue
        first, other = lower.reference(number)
        e, f = lower.elements[drive.joint, first], lower.elements[drive.joint, other]
        at = posed.place(LinkPoint(other, f.x, f.y))
        if e.is_line:
            angle = e.direction + float(posed.pose.angle(first)[0])
            axis = Point(math.cos(angle), -math.sin(angle))
            cylinder = [s for s in slides(posed) if s.joint == drive.joint and s.sign == "cylinder"]
            if cylinder:
                at = at.plus(posed.place(LinkPoint(first, e.x, e.y)).minus(at), 0.5)
            arrow = straight_drive(at, axis, axis.across if axis.x < 0 else Point(0, 0).minus(axis.across))
            body_parts.append(in_link(posed, cylinder[0].guide if cylinder else other, arrow))
        else:
            arrow = turning_drive(at, RADIUS + 10.0, _free_direction(posed, drive.joint, at))
            body_parts.append(in_link(posed, first, arrow))
    return body_parts


def _is_roller(posed: PosedLinkage, joint: int) -> bool:
    """Whether a link of a turning joint away from the frame only rolls on another one."""
    linkage, mechanism = posed.linkage, posed.linkage.mechanism
    links = mechanism.chain.joints[joint].links if joint < len(mechanism.chain.joints) else ()
    if mechanism.frame in links:
        return False
    others = [[(n, e) for (n, owner), e in linkage.elements.items() if owner == link and n != joint] for link in links]
    return any(len(own) == 1 and own[0][1].is_smooth and own[0][1].rim > 0 for own in others)


def _free_direction(posed: PosedLinkage, joint: int, at: Point) -> float:
    """The middle of the widest gap between the bodies at a joint, the pedestal of the frame among them."""
    lower = posed.lower
    angles = []
    for link in lower.mechanism.chain.joints[joint].links:
        if link == lower.mechanism.frame:
            pin = lower.elements[joint, link]
            side = bearing_sides(posed)[complex(pin.x, pin.y)]
            angles.append(math.atan2(side.y, side.x))
            continue
        pins = [(n, e) for (n, owner), e in lower.elements.items() if owner == link and n != joint]
        angles += [math.atan2(p.y - at.y, p.x - at.x) for n, e in pins if (p := posed.place(LinkPoint(link, e.x, e.y)))]
    return widest_gap(angles or [math.pi / 2])


# --- layers by name ------------------------------------------------------------------------------


def _dead_centres(context: LayerContext) -> list[Shape]:
    """The links as thin lines in the dead centres and dwells of the output, their joints with letters."""
    posed = context.posed
    cycle = posed.driven()
    centres, dwells = stops(cycle, find_output(posed.linkage, context.output))
    drives = [centre.drive for centre in centres] + [drive for dwell in dwells for drive in (dwell.begin, dwell.end)]
    if not posed.repeats:
        low, high = posed.path.drives[0, 0], posed.path.drives[-1, 0]
        drives = [drive for drive in drives if low <= drive <= high]
    if not drives:
        return []
    motion = cycle.at(np.array(drives), 0)
    shapes = [shape for row in range(len(drives)) for shape in ghost(posed, motion, row)]
    sides = {centre.drive: _SIDES[centre.side] for centre in centres if centre.side in _SIDES}
    for row, drive in enumerate(drives):
        for letter, place in _free_joints(posed, motion, row) if drive in sides else ():
            text = sides[drive].filled(letter=letter).in_language(context.lang)
            shapes.append(note_near(place, text, "value", [*context.drawn, *shapes]))
    return shapes


def _free_joints(posed: PosedLinkage, motion: Motion, row: int) -> Iterator[tuple[str, Point]]:
    """The letters and places of the joints that the links at the frame have with other moving links."""
    mechanism = posed.lower.mechanism
    letters = joint_letters(posed)
    for number, letter in letters.items():
        links = mechanism.chain.joints[number].links
        if f"{letter}_0" in letters.values():
            element = posed.lower.elements[number, links[0]]
            yield letter, posed.local(complex(motion.complex_point(LinkPoint(links[0], element.x, element.y))[row]))


def ghosts(posed: PosedLinkage, count: int) -> list[Shape]:
    """``count`` other positions, evenly through the turns of the drive or through its range."""
    first, last = (float(posed.path.drives[k, 0]) for k in (0, -1))
    shown = float(posed.pose.drives[0, 0])
    if posed.repeats:
        steps = np.arange(1, count + 1) / (count + 1)
        places = np.sort(first + (shown - first + steps * (last - first)) % (last - first))
    else:  # of one more, that next to the pose itself is left out
        places = np.linspace(first, last, count + 1)
        places = np.delete(places, np.argmin(abs(places - shown)))
    motion = posed.driven().at(places, 0)
    return [shape for row in range(count) for shape in ghost(posed, motion, row)]


def ghost(posed: PosedLinkage, motion: Motion, row: int) -> list[Shape]:
    """The outlines of all moving links, their guides and their joints."""
    lower, joint_slides = posed.lower, slides(posed)
    lines: list[tuple[Point, ...]] = []
    joints: dict[tuple[float, float], Point] = {}
    for link in lower.mechanism.chain.links:
        if link == lower.mechanism.frame:
            continue

        def moved(points: Iterable[Point], link: str = link) -> tuple[Point, ...]:
            shape = shapes_at_pose(posed, BodyPart(0, link, (Polylines((tuple(points),), "ghost"),)), motion, row)[0]
            assert isinstance(shape, Polylines)
            return shape.parts[0]

        corners = moved(corners_of(posed, link, joint_slides))
        if len(corners) > 1:
            lines.append((*corners, corners[0]) if len(corners) > 2 else corners)
        guides = [slide for slide in joint_slides if slide.guide == link and slide.sign != "cylinder"]
        lines += [moved(map(posed.local, (slide.low, slide.high))) for slide in guides]
        pins = [posed.local(complex(e.x, e.y)) for (_, holder), e in lower.elements.items() if holder == link]
        pins += [posed.local(complex(p.x, p.y)) for p in lower.points.values() if p.link == link]
        joints |= {(round(p.x, 1), round(p.y, 1)): p for p in moved(pins)}
    return [Polylines(tuple(lines), "ghost"), *(CircleShape(at, 4.0, "ghost-pin") for at in joints.values())]


def _transmission(context: LayerContext) -> list[Shape]:
    """The angle between the force on the output and the normal of its path, with its value."""
    posed = context.posed
    posed.driven()
    pushed = [_push(posed, leg) for leg in pushing_links(posed.pose.plan, find_output(posed.linkage, context.output))]
    at, force, normal = min(pushed, key=lambda push: abs(cmath.phase(push[2] / push[1])))
    apex = posed.local(at)
    begin, extent = -cmath.phase(force), -cmath.phase(normal / force)
    inner, arc, outer = (
        ArcShape(apex, radius=radius, begin=begin, extent=extent, style="measure") for radius in (RADIUS, _ARC, _RAY)
    )
    rays = [(inner.place(part), outer.place(part)) for part in (0, 1)]
    shapes: list[Shape] = [Polylines(tuple(rays), "measure"), arc]
    value = translate("μ = {angle:.1f}°", context.lang, angle=math.degrees(abs(extent)))
    return [*shapes, note_near(arc.place(0.5), value, "value", [*context.drawn, *shapes])]


def _push(posed: PosedLinkage, leg: PushingLink) -> tuple[complex, complex, complex]:
    """The point where a leg pushes, the direction (from there back to the leg), and the nearer normal of the path."""
    push, lines = push_of(posed.pose, leg), lines_of(posed.pose, leg)
    force = complex(-push.force[0] if leg.slide is None else push.force[0])
    normal = 1j * complex(lines.direction[0])
    return complex(push.at[0]), force, normal if (force.conjugate() * normal).real >= 0 else -normal


def _planes(context: LayerContext) -> list[Shape]:
    """At every link the number of its plane, counted from below."""
    posed, shapes = context.posed, list(context.drawn)
    posed.driven()
    planes, plates = link_planes(posed.linkage).planes, plates_of(posed.pose).plates
    texts: list[Shape] = []
    for link, plane in (planes or {}).items():
        ends = plates[link].places[: 1 if link == posed.lower.mechanism.frame else 2]
        middle = sum(ends) / len(ends)
        at = posed.place(LinkPoint(link, middle.real, middle.imag))
        texts.append(note_near(at, str(plane), "value", [*shapes, *texts]))
    return texts


def point_names(posed: PosedLinkage, shapes: Sequence[Shape]) -> Iterable[TextShape]:
    """The names of points, beside them."""
    drawn = list(shapes)
    pins = [shape.at for shape in drawn if isinstance(shape, CircleShape) and shape.style == "joint"]
    for name, point in posed.lower.points.items():
        at = posed.place(point)
        text = note_near(at, name, "name", drawn, [pin for pin in pins if pin.minus(at).length > RADIUS])
        drawn.append(text)
        yield text


def _later(_: LayerContext) -> list[Shape]:
    """No shapes: scale bars are drawn last, below all others."""
    return []


LAYERS: Mapping[str, Layer] = {
    "dead-centres": Layer(message("dead centres"), _dead_centres),
    "centrodes": Layer(message("fixed centrode p, moving centrode q"), centrode_lines),
    "inflection": Layer(message("inflection circle"), inflection_lines),
    "transmission": Layer(message("transmission angle"), _transmission),
    "velocities": Layer(message("velocities"), velocity_arrows),
    "accelerations": Layer(message("accelerations"), acceleration_arrows),
    "poles": Layer(message("instant centres"), pole_marks),
    "planes": Layer(message("planes of the links"), _planes),
    "dimensions": Layer(message("dimensions"), dimension_lines),
    "scale": Layer(message("scale"), _later),
    "joints": Layer(message("letters of the joints"), joint_names),
    "angles": Layer(message("angles of drive and output"), angle_marks),
    "lengths": Layer(message("letters of the lengths"), length_letters),
    "offset": Layer(message("letter of the eccentricity"), offset_letters),
}
BELOW = ("dead-centres", "centrodes", "inflection")
"""Layers below the bodies, except their marks and texts."""


def layer(name: str) -> Layer:
    """A layer by name; `LinkageError` for an unknown name."""
    if name not in LAYERS:
        raise LinkageError("there is no layer {word!r}{suggestion}; there are {known}", **unknown(name, LAYERS))
    return LAYERS[name]
