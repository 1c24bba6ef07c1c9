"""Drawings for CAD and laser cutting (DXF of release 2000): a plate for each link, with holes and slots.

Every link has a layer of its own name with its outline, which keeps a margin around pins and slots, holes at their true
diameter, and slots as long as pins move in them. Cut-outs that are one are drawn once; of those that run into each
other the plate is named. CURVES has the paths of named points, POINTS the points themselves.
With all links in one drawing these lie where the reference pose has them; a link alone has its first hole at the
origin. Drawings are in millimetres, as CAD expects, those of inches and feet in inches; the header says so.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from functools import partial
from itertools import combinations
from math import atan2, cos, pi, remainder, sin, tan
from typing import Any, NamedTuple

import numpy as np

from gruebler.base.convex_hull import convex_hull
from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import Message, message
from gruebler.base.units import MILLIMETRES
from gruebler.files.linkage_drawings import lower_linkage
from gruebler.mechanics.analysis.link_planes import link_planes, plate_sizes
from gruebler.mechanics.analysis.plates import Plate, Plates, plates_of, whole_motion
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.kinematics.solve import cached_plan, move_quietly
from gruebler.mechanics.linkages import Linkage, Pose2D

_UNITS = {"in": 1, "mm": 4}
_DRAWN_IN = {unit: "in" if unit in ("in", "ft") else "mm" for unit in MILLIMETRES}
_FORBIDDEN = dict.fromkeys(map(ord, '<>/\\":;?*|=`'), "_")  # in names of layers
_COLOURS = (7, 1, 3, 5, 4, 6, 30, 150)
_POINTS, _CURVES = "POINTS", "CURVES"
_ONE = 1e-9  # of the plate: places nearer to one another are one
_NAMED = 4  # places at which cut-outs run into each other are named


def dxf_from_linkage(
    linkage: Linkage, left_out: list[Message], *, hole: float | None = None, margin: float | None = None
) -> str:
    """The text of a DXF file with all links in one position; needs ezdxf.

    The description of a layer names the plane of its link (`gruebler.mechanics.analysis.link_planes`), if there are
    planes in which nothing collides.

    Args:
        linkage: with turning and sliding joints only.
        left_out: gets a message for each thing that the drawing does not have.
        hole: the diameter of holes and the width of slots, in the linkage's unit; a thirtieth of its size if not given.
        margin: from the centre of a hole to the edge of the plate; the diameter of a hole if not given.

    Raises `GrueblerError` for wheels and cams, for lengths that do not fit, and without ezdxf.
    """
    linkage, hole, margin = _scaled_for_cad(linkage, hole, margin)
    document = _new_document(linkage.unit, left_out)
    plates, sizes, planes = _cut(linkage, left_out, hole, margin)
    lower = plates.linkage
    poses = lower.required_pose
    space = document.modelspace()
    for number, (link, layer) in enumerate(_layers(list(plates.plates)).items()):
        _add_plate(document, layer, plates.plates[link], sizes, partial(_posed, poses[link]), left_out)
        document.layers.get(layer).description = planes[link]
        document.layers.get(layer).color = _COLOURS[number % len(_COLOURS)]
    for name in (_CURVES, _POINTS):
        document.layers.add(name, color=8)
    for name, point in lower.points.items():
        space.add_point(poses[point.link].put(point.x, point.y), dxfattribs={"layer": _POINTS})
        path = plates.motion.complex_point(name)
        if len(path) > 1:
            closed = abs(path[-1] - path[0]) < 1e-9 * lower.size  # a whole turn ends where it began, but for rounding
            places = np.column_stack([path.real, path.imag])[: -1 if closed else None]
            space.add_lwpolyline(places.tolist(), close=closed, dxfattribs={"layer": _CURVES})
    return _text(document)


def dxf_of_links(
    linkage: Linkage, left_out: list[Message], *, hole: float | None = None, margin: float | None = None
) -> dict[str, str]:
    """The texts of DXF files of one link each, by names for the files: ``2 coupler`` for the coupler in the plane 2.

    Each plate has its first hole at the origin and its second on the x axis. Arguments and errors as those of
    `dxf_from_linkage`.
    """
    linkage, hole, margin = _scaled_for_cad(linkage, hole, margin)
    plates, sizes, planes = _cut(linkage, left_out, hole, margin)
    if linkage.points:
        left_out.append(message("paths of points"))
    files = {}
    for link, layer in _layers(list(plates.plates)).items():
        document = _new_document(linkage.unit, [])
        plate = plates.plates[link]
        first = plate.places[0]
        other = next((z for z in plate.places if abs(z - first) > 1e-9 * plates.linkage.size), first + 1)
        turn = (other - first).conjugate() / abs(other - first)
        _add_plate(document, layer, plate, sizes, partial(_laid, first, turn), left_out)
        document.layers.get(layer).description = planes[link]
        files[f"{planes[link].removeprefix(_PLANE)} {layer}".strip()] = _text(document)
    return files


_PLANE = "plane "


def _posed(pose: Pose2D, z: complex) -> complex:
    return complex(*pose.put(z.real, z.imag))


def _laid(first: complex, turn: complex, z: complex) -> complex:
    return (z - first) * turn


def _scaled_for_cad(
    linkage: Linkage, hole: float | None, margin: float | None
) -> tuple[Linkage, float | None, float | None]:
    """All lengths in millimetres or inches; the linkage still calls them by its unit."""
    factor = MILLIMETRES.get(linkage.unit, 1.0) / MILLIMETRES[_DRAWN_IN.get(linkage.unit, "mm")]
    if linkage.unit not in MILLIMETRES or factor == 1.0:
        return linkage, hole, margin
    hole, margin = (None if size is None else factor * size for size in (hole, margin))
    return linkage.scaled(factor), hole, margin


def _cut(
    linkage: Linkage, left_out: list[Message], hole: float | None, margin: float | None
) -> tuple[Plates, tuple[float, float], dict[str, str]]:
    """The plates, the diameter of holes and the margin, and the plane of each link as a text; without planes empty."""
    lower = lower_linkage(linkage)
    sizes = plate_sizes(lower.size, hole, margin)
    left_out.append(message("drives"))
    if linkage.outputs:
        left_out.append(message("which links are outputs: {links}", links=", ".join(linkage.outputs)))
    try:
        motion = whole_motion(lower)
    except LinkageError as error:
        drives = pose_at_reference(cached_plan(lower), np.zeros(len(lower.mechanism.drives))).drives
        plates = plates_of(move_quietly(lower, drives[None]))
        left_out.append(message("the lengths of slots, paths and planes ({reason})", reason=error))
        return plates, sizes, dict.fromkeys(plates.plates, "")
    plates = plates_of(motion)
    planes = link_planes(lower, hole=sizes[0], margin=sizes[1])
    if planes.planes is None:
        left_out.append(message("the planes of links ({reason})", reason=planes.message))
    return plates, sizes, {link: f"{_PLANE}{planes.planes[link]}" if planes.planes else "" for link in plates.plates}


def _new_document(unit: str, left_out: list[Message]) -> Any:
    try:
        from ezdxf.filemanagement import new
    except ImportError:
        raise GrueblerError('DXF needs ezdxf: pip install "gruebler[cad]"') from None
    document = new("R2000")
    drawn = _DRAWN_IN.get(unit, "")
    document.header["$INSUNITS"] = _UNITS.get(drawn, 0)
    if unit and not drawn:
        left_out.append(message("the unit {unit}", unit=unit))
    document.header["$MEASUREMENT"] = 0 if drawn == "in" else 1
    return document


def _text(document: Any) -> str:
    from ezdxf.bbox import extents

    box = extents(document.modelspace())
    document.modelspace().reset_extents(box.extmin, box.extmax)  # what programs show first
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


def _layers(links: Sequence[str]) -> dict[str, str]:
    """A layer name for each link: its own, without the signs that DXF forbids."""
    layers: dict[str, str] = {}
    for link in links:
        name = link.translate(_FORBIDDEN)
        while name.lower() in (used.lower() for used in (*layers.values(), "0", "curves", "points")):
            name += "_"
        layers[link] = name
    return layers


def _add_plate(
    document: Any,
    layer: str,
    plate: Plate,
    sizes: tuple[float, float],
    put: Callable[[complex], complex],
    left_out: list[Message],
) -> None:
    """The edge, the holes and the slots of a plate, put where it lies; the list names a plate without walls between."""
    document.layers.add(layer)
    space, (hole, margin) = document.modelspace(), sizes
    places = [put(z) for z in plate.places]
    edges = [plate_outline([(z.real, z.imag) for z in places], margin)]
    cuts = cut_outs(plate, hole)
    for slot in cuts.slots:
        edges.append(plate_outline([(z.real, z.imag) for z in map(put, slot)], hole / 2))
    for edge in edges:
        space.add_lwpolyline(edge, format="xyb", close=True, dxfattribs={"layer": layer})
    for z in map(put, cuts.holes):
        space.add_circle((z.real, z.imag), hole / 2, dxfattribs={"layer": layer})
    if cuts.clashes:
        at = ", ".join(f"({z.real:.6g}, {z.imag:.6g})" for z in map(put, cuts.clashes[:_NAMED]))
        left_out.append(
            message("walls of the plate {plate}: cut-outs run into each other at {places}", plate=layer, places=at)
        )


class CutOuts(NamedTuple):
    """What is cut out of a plate, in its coordinates."""

    holes: tuple[complex, ...]
    slots: tuple[tuple[complex, complex], ...]
    clashes: tuple[complex, ...]
    """Places at which two of them run into each other, so that a pin has no wall there."""


def cut_outs(plate: Plate, hole: float) -> CutOuts:
    """The holes and slots of a plate, those that are one united; a hole has a diameter, a slot that width.

    Holes at one place are one. Slots on one line are one if nothing is left between them: two pins of a slide run in
    it. All others that are nearer than the diameter run into each other. Cost: O(n²).

    >>> cut_outs(Plate((), (0j, 1e-12j, 9 + 0j), ((4 + 0j, 6 + 0j), (5 + 0j, 8 + 0j))), 2.0)
    CutOuts(holes=(0j, (9+0j)), slots=(((4+0j), (8+0j)),), clashes=((8+0j),))
    """
    near = _ONE * max([hole, *(abs(z - plate.places[0]) for z in plate.places)])
    holes: list[complex] = []
    for z in plate.holes:
        if all(abs(z - other) > near for other in holes):
            holes.append(z)
    slots: list[tuple[complex, complex]] = []
    for slot in plate.slots:
        joined = slot
        while (other := next((each for each in slots if _one_slot(each, joined, hole, near)), None)) is not None:
            slots.remove(other)
            joined = _longest(*other, *joined)
        slots.append(joined)
    lines = [*((z, z) for z in holes), *slots]
    clashes = []
    for k, first in enumerate(lines):
        for second in lines[:k]:
            gap, place = _gap(first, second)
            if gap < hole * (1 - _ONE):
                clashes.append(place)
    return CutOuts(tuple(holes), tuple(slots), tuple(clashes))


def _one_slot(first: tuple[complex, complex], second: tuple[complex, complex], hole: float, near: float) -> bool:
    """Whether two slots lie on one line, and no wall between them."""
    a, b = _longest(*first, *second)
    if abs(b - a) <= near:
        return True
    along = (b - a).conjugate() / abs(b - a)
    return _gap(first, second)[0] < hole and all(abs(((z - a) * along).imag) <= near for z in (*first, *second))


def _longest(*ends: complex) -> tuple[complex, complex]:
    """The two places that are farthest apart."""
    return max(combinations(ends, 2), key=lambda pair: abs(pair[1] - pair[0]))


def _gap(first: tuple[complex, complex], second: tuple[complex, complex]) -> tuple[float, complex]:
    """The distance of two straight lines between places, and the place on the first that is nearest."""
    (a, b), (c, d) = first, second
    turn = ((b - a).conjugate() * (d - c)).imag
    if turn:
        s, t = (((c - a).conjugate() * (d - c)).imag / turn, ((c - a).conjugate() * (b - a)).imag / turn)
        if 0 <= s <= 1 and 0 <= t <= 1:
            return 0.0, a + s * (b - a)
    feet = [(_foot(z, second), z) for z in first] + [(z, _foot(z, first)) for z in second]
    return min(((abs(p - q), q) for p, q in feet), key=lambda each: each[0])


def _foot(z: complex, line: tuple[complex, complex]) -> complex:
    """The place of a straight line that is nearest to another place."""
    a, b = line
    part = ((z - a) * (b - a).conjugate()).real / abs(b - a) ** 2 if b != a else 0.0
    return a + min(1.0, max(0.0, part)) * (b - a)


def plate_outline(places: Sequence[tuple[float, float]], margin: float) -> list[tuple[float, float, float]]:
    """The edge of a plate with a margin around places: x, y and bulge of each corner, counter-clockwise.

    The bulge is the tangent of a quarter of the angle of the arc to the next corner. Cost: O(n log n).

    >>> [tuple(round(v, 9) for v in corner) for corner in plate_outline([(0, 0), (4, 0)], 1)]
    [(0.0, -1.0, 0.0), (4.0, -1.0, 1.0), (4.0, 1.0, 0.0), (0.0, 1.0, 1.0)]
    """
    corners = [(z.real, z.imag) for z in convex_hull([complex(x, y) for x, y in places])]
    if len(corners) == 1:
        x, y = corners[0]
        return [(x - margin, y, 1.0), (x + margin, y, 1.0)]
    outline = []
    for k, (x, y) in enumerate(corners):
        to_x, to_y = corners[(k + 1) % len(corners)]
        next_x, next_y = corners[(k + 2) % len(corners)]
        along, after = atan2(to_y - y, to_x - x), atan2(next_y - to_y, next_x - to_x)
        turn = remainder(after - along, 2 * pi)
        nx, ny = margin * sin(along), -margin * cos(along)
        outline.append((x + nx, y + ny, 0.0))
        outline.append((to_x + nx, to_y + ny, tan(abs(turn) / 4)))
    return outline
