"""Drawings for CAD and laser cutting (DXF of release 2000): a plate for each link, with holes, in the drawn position.

Every link has a layer of its own name with its outline, which keeps a margin around the pins, and the holes of its
turning joints at their true diameter; SLIDES has the lines along which links slide, CURVES the paths of named points,
POINTS the points themselves. The origin is the first pin of the frame, the unit stands in the header.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from math import atan2, cos, hypot, pi, remainder, sin, tan
from typing import Any

import numpy as np

from gruebler.analysis.rotatability import drive_range
from gruebler.errors import GrueblerError
from gruebler.formats.pin_drawings import DrawnJoint, drawing_of, lower_linkage
from gruebler.kinematics import move
from gruebler.linkages import Linkage
from gruebler.text import Message, message

__all__ = ["dxf_from_linkage", "plate_outline"]

_UNITS = {"in": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6, "dm": 14}
_ROWS = 361
_FORBIDDEN = dict.fromkeys(map(ord, '<>/\\":;?*|=`'), "_")  # in names of layers
_COLOURS = (7, 1, 3, 5, 4, 6, 30, 150)
_HOLES = 30  # the size of the linkage over the diameter of a hole


def dxf_from_linkage(
    linkage: Linkage, left_out: list[Message], *, hole: float | None = None, margin: float | None = None
) -> str:
    """The text of a DXF file; needs ezdxf.

    Args:
        linkage: with turning and sliding joints only.
        left_out: gets a message for each thing that the drawing does not have.
        hole: the diameter of the holes, in the linkage's unit; a thirtieth of its size if not given.
        margin: from the centre of a hole to the edge of the plate; the diameter of a hole if not given.

    Raises `GrueblerError` for wheels and cams, for lengths that are not positive, and without ezdxf.
    """
    try:
        from ezdxf.filemanagement import new
    except ImportError:
        raise GrueblerError('DXF needs ezdxf: pip install "gruebler[cad]"') from None
    hole = linkage.size / _HOLES if hole is None else hole
    margin = hole if margin is None else margin
    if not 0 < hole / 2 < margin < float("inf"):
        raise GrueblerError(
            "a hole of {hole:g} needs a margin of more than its radius, not {margin:g}", hole=hole, margin=margin
        )
    drawing = drawing_of(linkage, left_out)
    pins = [joint for joint in drawing.joints if len(joint.links) > 1]
    origin = next((joint for joint in pins if drawing.frame in joint.links), pins[0])
    document = new("R2000")
    document.header["$INSUNITS"] = _UNITS.get(drawing.unit, 0)
    if drawing.unit not in _UNITS:
        left_out.append(message("the unit {unit}", unit=drawing.unit))
    document.header["$MEASUREMENT"] = 0 if drawing.unit in ("in", "ft") else 1
    space = document.modelspace()
    links = list(dict.fromkeys([drawing.frame, *(link for joint in drawing.joints for link in joint.links)]))
    layers = _layers(links)
    for number, link in enumerate(links):
        document.layers.add(layers[link], color=_COLOURS[number % len(_COLOURS)])
        joints = [joint for joint in drawing.joints if link in joint.links]
        outline = plate_outline([(joint.x - origin.x, joint.y - origin.y) for joint in joints], margin)
        space.add_lwpolyline(outline, format="xyb", close=True, dxfattribs={"layer": layers[link]})
        for joint in joints:
            if len(joint.links) > 1 and (joint.slot is None or (joint.turns and link != joint.links[0])):
                at = (joint.x - origin.x, joint.y - origin.y)
                space.add_circle(at, hole / 2, dxfattribs={"layer": layers[link]})
    for name in ("SLIDES", "CURVES", "POINTS"):
        document.layers.add(name, color=8)
    _add_slides(space, drawing.joints, origin, linkage.size)
    for joint in drawing.joints:
        if len(joint.links) == 1:
            space.add_point((joint.x - origin.x, joint.y - origin.y), dxfattribs={"layer": "POINTS"})
    _add_curves(space, linkage, origin, left_out)
    left_out.append(message("drives"))
    out = io.StringIO()
    document.write(out)
    return out.getvalue()


def _layers(links: Sequence[str]) -> dict[str, str]:
    """A layer name for each link: its own, without the signs that DXF forbids."""
    layers: dict[str, str] = {}
    for link in links:
        name = link.translate(_FORBIDDEN)
        while name.lower() in (used.lower() for used in (*layers.values(), "0", "slides", "curves", "points")):
            name += "_"
        layers[link] = name
    return layers


def _add_slides(space: Any, joints: Sequence[DrawnJoint], origin: DrawnJoint, size: float) -> None:
    for joint in joints:
        if joint.slot is not None:
            dx, dy = size / 2 * cos(joint.slot), size / 2 * sin(joint.slot)
            x, y = joint.x - origin.x, joint.y - origin.y
            space.add_line((x - dx, y - dy), (x + dx, y + dy), dxfattribs={"layer": "SLIDES"})


def _add_curves(space: Any, linkage: Linkage, origin: DrawnJoint, left_out: list[Message]) -> None:
    """The paths of the named points over the whole range of the drive."""
    if not linkage.points:
        return
    if len(linkage.mechanism.drives) != 1:
        left_out.append(message("paths of points: they need one drive"))
        return
    lower = lower_linkage(linkage)
    way = drive_range(lower)
    path = np.linspace(0, 2 * pi, _ROWS) if way.full else np.linspace(way.lowest, way.highest, _ROWS)[1:-1]
    motion = move(lower, path)
    for name in linkage.points:
        if len(motion):
            places = motion.point(name) - (origin.x, origin.y)
            space.add_lwpolyline(places.tolist(), close=way.full, dxfattribs={"layer": "CURVES"})


def plate_outline(places: Sequence[tuple[float, float]], margin: float) -> list[tuple[float, float, float]]:
    """The edge of a plate with a margin around places: x, y and bulge of each corner, counter-clockwise.

    The bulge is the tangent of a quarter of the angle of the arc to the next corner. Cost: O(n log n).

    >>> [tuple(round(v, 9) for v in corner) for corner in plate_outline([(0, 0), (4, 0)], 1)]
    [(0.0, -1.0, 0.0), (4.0, -1.0, 1.0), (4.0, 1.0, 0.0), (0.0, 1.0, 1.0)]
    """
    hull = _hull(places)
    if len(hull) == 1:
        x, y = hull[0]
        return [(x - margin, y, 1.0), (x + margin, y, 1.0)]
    out = []
    for k, (x, y) in enumerate(hull):
        to_x, to_y = hull[(k + 1) % len(hull)]
        next_x, next_y = hull[(k + 2) % len(hull)]
        along, after = atan2(to_y - y, to_x - x), atan2(next_y - to_y, next_x - to_x)
        turn = remainder(after - along, 2 * pi)
        nx, ny = margin * sin(along), -margin * cos(along)
        out.append((x + nx, y + ny, 0.0))
        out.append((to_x + nx, to_y + ny, tan(abs(turn) / 4)))
    return out


def _hull(places: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """The corners of the convex hull, counter-clockwise; places that are nearly on an edge are left out."""
    points = sorted(set(places))
    size = max(hypot(x - points[0][0], y - points[0][1]) for x, y in points)
    points = [
        points[0],
        *(p for p, q in zip(points[1:], points, strict=False) if hypot(p[0] - q[0], p[1] - q[1]) > 1e-9 * size),
    ]
    if len(points) < 3:
        return points

    def half(ordered: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
        chain: list[tuple[float, float]] = []
        for x, y in ordered:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2:]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 1e-9 * size**2:
                    break
                chain.pop()
            chain.append((x, y))
        return chain[:-1]

    return half(points) + half(points[::-1])
