"""A stage of bevel wheels in two views: from the side through all axes, and along the axis of the central wheels.

The pitch cones have their tips in the middle. A wheel is what the cone leaves between two circles: a trapezoid from the
side, two circles along its axis. The second view leaves the near central wheel out; docs/theory/drawing.md.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from gruebler.pictures.canvas.labels import labels_or_numbers
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape
from gruebler.pictures.machines.train_layout import FRAME, GearStage

_LARGE = 66.0  # pixels: the larger one of the largest radii
_FACE = 0.36  # width of the teeth by the length of the cone
_SLEEVE = Point(6.0, 10.0)  # half of it, across and along the shaft
_OUT = 12.0  # pixels from a wheel to the next sleeve
_STUB = 5.0  # pixels of the shaft beyond it
_AXIS = 40.0  # of the axis beyond a wheel
_HUB = 15.0  # half the length of the carrier's hub
_BETWEEN = 60.0  # pixels between both views


@dataclass(kw_only=True)
class _Cones:
    """The wheels of a stage about two axes that cross, in pixels."""

    central: list[tuple[str, float, float, float]] = field(default_factory=list)
    """Link, side (1 or -1), radius, distance of its pitch circle from the tip."""
    planets: list[tuple[str, float, float, float]] = field(default_factory=list)


def bevel_shapes(stage: GearStage) -> list[Shape] | None:
    """Both views; None for wheels that do not lie on two axes in turn, which have no such view.

    >>> from gruebler.machines.gears import read_train
    >>> from gruebler.pictures.machines.train_layout import gear_stages
    >>> (stage,) = gear_stages(read_train("bevel left:16 star:10 right:-16 on case").train, {})
    >>> bevel_shapes(stage) is None
    False
    """
    cones = _cones(stage)
    if cones is None:
        return None
    high = max(distance + radius for _, _, radius, distance in (*cones.central, *cones.planets))
    section = _Section(stage, cones)
    middle = section.right + _BETWEEN + high
    axis = Polylines(((Point(-section.right - _STUB, 0), Point(middle + high, 0)),), "pitch")
    outlines = section.outlines
    return [
        *labels_or_numbers(outlines, dict.fromkeys(outlines, True), [axis, *section.shapes]),
        *_along(stage, cones, middle),
    ]


def _cones(stage: GearStage) -> _Cones | None:
    """Wheels on their sides: z_a z_b is positive for a central wheel on the right, planets count outwards."""
    central = dict.fromkeys(mesh.a for mesh in stage.meshes)
    planets = list(dict.fromkeys(mesh.b for mesh in stage.meshes))
    if set(central) & set(planets):
        return None
    unit = 2 * _LARGE / max(abs(float(size)) for mesh in stage.meshes for size in (mesh.size_a, mesh.size_b))
    cones = _Cones()
    for mesh in stage.meshes:
        a, b = float(mesh.size_a), float(mesh.size_b)
        turned = 1.0 if planets.index(mesh.b) % 2 == 0 else -1.0
        radii = abs(a) * unit / 2, abs(b) * unit / 2
        for wheels, wheel in (
            (cones.central, (mesh.a, math.copysign(1.0, a * b), *radii)),
            (cones.planets, (mesh.b, turned, *radii[::-1])),
        ):
            if wheel not in wheels:
                wheels.append(wheel)
    sides = {link: {side for other, side, _, _ in cones.central if other == link} for link in central}
    return cones if all(len(each) == 1 for each in sides.values()) else None


def _frustum(radius: float, distance: float, turn: complex, middle: float = 0.0) -> tuple[Point, ...]:
    """The trapezoid of a wheel whose axis points in a direction."""
    corners = [
        complex(distance * k, radius * k * side) for k, side in ((1, 1), (1 - _FACE, 1), (1 - _FACE, -1), (1, -1))
    ]
    return tuple(Point(middle + (turn * z).real, -(turn * z).imag) for z in corners)


def _box(at: complex, along: complex, half: Point) -> tuple[Point, ...]:
    corners = (complex(a * half.y, b * half.x) * along for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    return tuple(Point((at + z).real, -(at + z).imag) for z in corners)


def _ground(sleeve: Sequence[Point], along: complex, half: float) -> Iterator[Shape]:
    """A hatched line beside the middle of a sleeve: below a level shaft, to the right of an upright one."""
    level = abs(along.real) > 0.5
    at = Point(sum(p.x for p in sleeve) / 4, sum(p.y for p in sleeve) / 4)
    across, ahead = (Point(0.0, 1.0), Point(1.0, 0.0)) if level else (Point(1.0, 0.0), Point(0.0, 1.0))
    at = at.plus(across, max(p.y - at.y if level else p.x - at.x for p in sleeve))
    yield Polylines(((at.plus(ahead, -half), at.plus(ahead, half)),), "rail")
    ends = (at.plus(ahead, -half + 6.0 * k) for k in range(int(2 * half // 6) + 1))
    yield Polylines(tuple((end, end.plus(across, 6.0).plus(ahead, -5.0)) for end in ends), "hatch")


class _Section:
    """The view from the side: wheels, shafts in their bearings, the carrier's cage."""

    def __init__(self, stage: GearStage, cones: _Cones) -> None:
        self.carrier, self.shapes = stage.carrier, list[Shape]()
        self.outlines: dict[str, Sequence[Point]] = {}
        moving = stage.carrier != FRAME
        reach = max(distance for _, _, _, distance in cones.central)
        height = max(distance for _, _, _, distance in cones.planets)
        self.right = reach + 2 * (_OUT + _SLEEVE.y + _HUB) + _STUB
        shown = (1.0, -1.0) if stage.copies % 2 == 0 else (1.0,)
        planets = [(link, side * turn, r, d) for link, side, r, d in cones.planets for turn in shown]
        self.shapes.append(_axis(0.0, height))
        near = min(side for _, side, _, _ in cones.central)  # the side of the carrier's hub
        if moving:
            self._cage(near, reach + _OUT, height + _OUT + _SLEEVE.y, sorted({side for _, side, _, _ in planets}))
        for link, side, radius, distance in cones.central:
            through = 2 * _HUB + _OUT / 2 if moving and side == near else 0.0
            self._wheel(link, radius, distance, complex(side), reach + _OUT + through, "block-frame")
        for link, side, radius, distance in planets:
            self._wheel(link, radius, distance, 1j * side, height + _OUT, "block" if moving else "block-frame")
        if moving:
            self._hub(near, reach + _OUT + _HUB)

    def _wheel(self, link: str, radius: float, distance: float, axis: complex, to: float, bearing: str) -> None:
        """A wheel with its shaft in a bearing of the frame or of the carrier."""
        rim = _frustum(radius, distance, axis)
        self.shapes += _on_shaft(link, rim, distance, axis, to, bearing)
        self.outlines.setdefault(link, rim)

    def _cage(self, near: float, start: float, up: float, sides: Sequence[float]) -> None:
        """Bars of the carrier from the planets' bearings around the wheels to its hub."""
        x = near * (start + _HUB / 2)
        bars = tuple((Point(0, -up * side), Point(x, -up * side), Point(x, -_SLEEVE.x * side)) for side in sides)
        self.shapes += [Polylines(bars, "outline-rod"), Polylines(bars, "body-rod")]
        self.outlines[self.carrier] = bars[-1]

    def _hub(self, near: float, middle: float) -> None:
        """The carrier's hub around the shaft, borne by the frame outside of its bars."""
        half = Point(_SLEEVE.x + 3.0, _HUB)
        self.shapes.append(Polylines((_box(near * middle, 1, half),), "block", closed=True))
        self.shapes += _ground(_box(near * (middle + _HUB / 2), 1, half), 1, _HUB / 2)


def _axis(x: float, height: float) -> Shape:
    return Polylines(((Point(x, height + _AXIS), Point(x, -height - _AXIS)),), "pitch")


def _on_shaft(
    link: str, rim: tuple[Point, ...], distance: float, axis: complex, to: float, bearing: str, middle: float = 0.0
) -> Iterator[Shape]:
    """A shaft with its wheel and its bearing, which begins at a distance from the middle."""
    start, end = (z * axis + middle for z in (distance * (1 - _FACE), to + 2 * _SLEEVE.y + _STUB))
    yield Polylines(((Point(start.real, -start.imag), Point(end.real, -end.imag)),), "rail")
    yield Polylines((rim,), "block-frame" if link == FRAME else "area", closed=True)
    sleeve = _box((to + _SLEEVE.y) * axis + middle, axis, _SLEEVE)
    yield Polylines((sleeve,), bearing, closed=True)
    if bearing == "block-frame":
        yield from _ground(sleeve, axis, 12.0)


def _along(stage: GearStage, cones: _Cones, middle: float) -> Iterator[Shape]:
    """The view along the central axis: behind the carrier, then the far central wheel, before it the planets."""
    moving = stage.carrier != FRAME
    far = min(side for _, side, _, _ in cones.central)
    height = max(distance for _, _, _, distance in cones.planets)
    turns = [cmath.exp(2j * math.pi * k / stage.copies) for k in range(stage.copies)]
    planets = [(link, r, d, 1j * side * turn) for link, side, r, d in cones.planets for turn in turns]
    at, up = Point(middle, 0.0), height + _OUT + _SLEEVE.y
    if moving:
        bars = tuple((at, Point(middle + up * axis.real, -up * axis.imag)) for *_, axis in planets)
        yield from (Polylines(bars, "outline-rod"), Polylines(bars, "body-rod"))
    for link, side, radius, _ in cones.central:
        if side == far:
            style = "block-frame" if link == FRAME else "area"
            yield from (CircleShape(at, radius, style), CircleShape(at, radius * (1 - _FACE), style))
    yield _axis(middle, height)
    for link, radius, distance, axis in planets:
        rim = _frustum(radius, distance, axis, middle)
        bearing = "block" if moving else "block-frame"
        yield from _on_shaft(link, rim, distance, axis, height + _OUT, bearing, middle)
    yield CircleShape(at, 3.2, "dot")
