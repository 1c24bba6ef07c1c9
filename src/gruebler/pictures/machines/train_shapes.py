"""The wheels, carriers, belts, racks, ropes and screws of a stage as bodies that turn and slide."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.pictures.canvas.moving_picture import Body, Shift, Turn
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape, TextShape, text_width
from gruebler.pictures.canvas.symbols import ticks
from gruebler.pictures.machines.teeth import toothed_outline
from gruebler.pictures.machines.train_layout import FRAME, GearStage, PlacedMesh, StageWheel
from gruebler.pictures.machines.train_motion import TrainMotion

Steps = tuple[Shift | Turn, ...]

_RIM = 15.0  # pixels around an internal wheel
_PIN = 5.0
_KEYS = 72  # of a motion to and fro
_BAR = 16.0  # pixels: the thickness of a rack
_LOAD = Point(13.0, 18.0)
_SCREW = Point(150.0, 9.0)
_NUT = Point(15.0, 17.0)


class PaintOptions(NamedTuple):
    """Pixels to a unit, and whether wheels have teeth."""

    scale: float
    teeth: bool

    def place(self, z: complex) -> Point:
        """In pixels."""
        return Point(self.scale * z.real, -self.scale * z.imag)

    def line(self, points: Complexes) -> tuple[Point, ...]:
        """In pixels."""
        return tuple(self.place(z) for z in points.tolist())


class _Moves:
    """Steps of the links of a stage; all zero without a motion."""

    def __init__(self, stage: GearStage, motion: TrainMotion | None) -> None:
        self.stage, self.motion = stage, motion

    def turn(self, link: str, against: str = FRAME, sign: int = 1) -> Turn:
        """The angle of a link against another, evenly or to and fro."""
        if self.motion is None:
            return Turn((0.0,))
        turns = sign * (self.motion.turns(link) - self.motion.turns(against))
        return Turn(self._keys(math.tau * turns))

    def slide(self, link: str, scale: float, along: Point) -> Shift:
        """The displacement of a link along a direction on the page."""
        if self.motion is None or not self.motion.displacement(link):
            return Shift((Point(0.0, 0.0),))
        return Shift(
            tuple(Point(0, 0).plus(along, travel) for travel in self._keys(scale * self.motion.displacement(link)))
        )

    def _keys(self, whole: float) -> tuple[float, ...]:
        if not whole:
            return (0.0,)
        if self.motion is None or not self.motion.slides:
            return (0.0, whole)
        return tuple(whole * math.sin(math.pi * k / _KEYS) ** 2 for k in range(_KEYS + 1))

    def on_carrier(self, paint: PaintOptions) -> Steps:
        """The steps of all parts on the carrier."""
        carrier = self.stage.carrier
        if carrier == FRAME or self.stage.is_bevel:
            return ()
        if self.motion is not None and carrier in self.motion.slides:
            return (self.slide(carrier, paint.scale, Point(1.0, 0.0)),)
        return (self.turn(carrier),)

    def of_wheel(self, wheel: StageWheel, paint: PaintOptions) -> Steps:
        """The steps of a wheel about its axis, which may revolve."""
        carrier, shift = self.stage.carrier, Shift((paint.place(wheel.at),))
        if self.stage.is_bevel:
            side = -1 if wheel.size < 0 else 1
            relative = any(wheel.link == mesh.b for mesh in self.stage.meshes) and carrier != FRAME
            return shift, self.turn(wheel.link, FRAME if relative else carrier, side)
        sliding = self.motion is not None and carrier in self.motion.slides
        if sliding:
            return (*self.on_carrier(paint), shift, self.turn(wheel.link))
        if wheel.planet:
            return (*self.on_carrier(paint), shift, self.turn(wheel.link, carrier))
        return shift, self.turn(wheel.link)


def stage_bodies(stage: GearStage, paint: PaintOptions, motion: TrainMotion | None) -> list[Body]:
    """All bodies of a stage in painting order, its first axis or hub at the origin."""
    moves = _Moves(stage, motion)
    order = sorted(stage.wheels, key=lambda wheel: (not _hollow(stage, wheel), -wheel.radius))
    bodies = [Body(tuple(_wheel(stage, wheel, paint)), moves.of_wheel(wheel, paint)) for wheel in order]
    for placed in stage.placed:
        if between := BETWEEN.get(placed.mesh.kind):
            bodies += between(placed, moves, paint)
    bodies += _carrier(stage, moves, paint)
    bodies += _pins(stage, moves, paint)
    return [*bodies, *_names(stage, moves, paint)]


def _hollow(stage: GearStage, wheel: StageWheel) -> bool:
    return wheel.internal and not stage.is_bevel


# --- wheels ----------------------------------------------------------------------------------------


def _wheel(stage: GearStage, wheel: StageWheel, paint: PaintOptions) -> Iterator[Shape]:
    """A disc or ring with its pitch circle, optional teeth, and marks that show its rotation."""
    radius = paint.scale * wheel.radius
    style = "block-frame" if wheel.link == FRAME else "area"
    geared = any(mesh.traits.spur and wheel.link in (mesh.a, mesh.b) for mesh in stage.meshes)
    whole = wheel.size == round(wheel.size) and 4 <= abs(wheel.size) <= 400
    toothy = paint.teeth and geared and whole
    module = 2 * wheel.radius / abs(wheel.size)
    middle = Point(0.0, 0.0)
    if toothy:
        rim = paint.line(
            toothed_outline(round(abs(wheel.size)), module, internal=_hollow(stage, wheel), phase=wheel.phase)
        )
    if _hollow(stage, wheel):
        inner = rim if toothy else _circle(radius)
        outer = _circle(radius + (1.25 * module * paint.scale if toothy else 0.0) + _RIM)
        yield Polylines((outer, inner[::-1]), style, closed=True)
        yield CircleShape(Point(outer[0].x - _RIM / 2, 0.0), 2.6, "node")
    else:
        yield Polylines((rim,), style, closed=True) if toothy else CircleShape(middle, radius, style)
        arm = 0.8 * radius
        yield Polylines(((Point(-arm, 0), Point(arm, 0)), (Point(0, -arm), Point(0, arm))), "hatch")
        if radius > 16:
            yield CircleShape(Point(0.62 * radius, 0.0), min(4.0, radius / 8), "node")
    if toothy:
        yield CircleShape(middle, radius, "dead")


def _circle(radius: float) -> tuple[Point, ...]:
    count = max(36, min(144, round(radius)))
    return tuple(Point(radius * math.cos(t), -radius * math.sin(t)) for t in np.linspace(0, math.tau, count + 1)[:-1])


def _carrier(stage: GearStage, moves: _Moves, paint: PaintOptions) -> list[Body]:
    """Bars from the hub to the planets."""
    hub = Point(0.0, 0.0)
    ends = dict.fromkeys(paint.place(wheel.at) for wheel in stage.wheels if wheel.planet)
    if not ends:
        return []
    bars = tuple((hub, end) for end in ends)
    return [Body((Polylines(bars, "outline-rod"), Polylines(bars, "body-rod")), moves.on_carrier(paint))]


def _pins(stage: GearStage, moves: _Moves, paint: PaintOptions) -> list[Body]:
    """A circle on every axis."""
    axes = dict.fromkeys(wheel.at for wheel in stage.wheels if wheel.planet or not stage.central)
    steps = moves.on_carrier(paint)
    bodies = [Body(tuple(CircleShape(paint.place(at), _PIN, "joint") for at in axes), steps)] if axes else []
    return [*bodies, Body((CircleShape(Point(0.0, 0.0), _PIN, "joint"),))] if stage.central else bodies


def _names(stage: GearStage, moves: _Moves, paint: PaintOptions) -> Iterator[Body]:
    """Names of links in their wheels where there is space; they remain level."""
    used_radii: dict[complex, float] = {}
    named: set[tuple[str, complex]] = set()
    for wheel in sorted(stage.wheels, key=lambda wheel: wheel.radius):
        inner = used_radii.get(wheel.at, 0.0)
        radius = paint.scale * wheel.radius
        used_radii[wheel.at] = max(inner, radius)
        down = max(inner, _PIN) + 11.0
        has_space = down + 8.0 < radius and text_width(wheel.link) / 2 < math.sqrt(
            max(radius**2 - (down + 6) ** 2, 0.0)
        )
        if _hollow(stage, wheel) or not has_space or (wheel.link, wheel.at) in named:
            continue
        named.add((wheel.link, wheel.at))
        steps: Steps = (Shift((paint.place(wheel.at),)),)
        if wheel.planet:
            carried = moves.on_carrier(paint)
            back = (Turn(tuple(-angle for angle in step.angles)) for step in carried if isinstance(step, Turn))
            steps = (*carried, *steps, *back)
        wide, high = text_width(wheel.link) / 2 + 2.0, 8.0
        corners = tuple(Point(x, down + y) for x, y in ((-wide, -high), (wide, -high), (wide, high), (-wide, high)))
        plate = Polylines((corners,), "plate", closed=True)  # no line runs through the name
        yield Body((plate, TextShape(Point(0.0, down), wheel.link, "name")), steps)


# --- belts, racks, ropes and screws ----------------------------------------------------------------


def _loop(placed: PlacedMesh, moves: _Moves, paint: PaintOptions) -> Iterator[Body]:
    """A belt, or a chain."""
    traits = placed.mesh.traits
    line = paint.line(_belt(placed, traits.belt == "crossed"))
    yield Body((Polylines((line,), "rail" if traits.toothed else "edge", closed=True),), moves.on_carrier(paint))


def _belt(placed: PlacedMesh, crossed: bool) -> Complexes:
    """The closed line around two wheels, along their common tangents."""
    (ra, rb), axis = placed.radii, placed.b - placed.a
    towards, d = cmath.phase(axis), abs(axis)
    beta = math.acos((ra + rb if crossed else ra - rb) / d)
    first = np.linspace(towards + beta, towards + math.tau - beta, 49)
    second = np.linspace(towards - beta, towards + beta, 49)
    if crossed:
        second = np.linspace(towards + math.pi - beta, towards - math.pi + beta, 49)
    outline: Complexes = np.concatenate([placed.a + ra * np.exp(1j * first), placed.b + rb * np.exp(1j * second)])
    return outline


def _rack(placed: PlacedMesh, moves: _Moves, paint: PaintOptions) -> Iterator[Body]:
    """A bar along x below the wheel, above it for a negative radius."""
    mesh, scale = placed.mesh, paint.scale
    radius = placed.radii[0]
    side = -1.0 if mesh.size_a < 0 else 1.0
    at = paint.place(placed.a).plus(Point(0.0, side * scale * radius))
    travel = scale * abs(moves.motion.displacement(mesh.b)) if moves.motion else 0.0
    half = max(1.6 * scale * radius, 40.0)
    left, right = at.x - half - travel, at.x + half + travel
    box = (Point(left, at.y), Point(right, at.y), Point(right, at.y + side * _BAR), Point(left, at.y + side * _BAR))
    pieces: list[Shape] = [Polylines((box,), "block", closed=True)]
    pieces.append(ticks(Point(left, at.y + side * 4), Point(right, at.y + side * 4), Point(0.0, side * 0.8)))
    yield Body(tuple(pieces), (moves.slide(mesh.b, scale, Point(1.0, 0.0)),))


def _rope(placed: PlacedMesh, moves: _Moves, paint: PaintOptions) -> Iterator[Body]:
    """A rope from the right side of a drum with its load; a mask hides the rope below the load."""
    mesh, scale = placed.mesh, paint.scale
    radius = placed.radii[0]
    top = paint.place(placed.a + radius)
    travel = scale * moves.motion.displacement(mesh.b) if moves.motion else 0.0
    low = top.plus(Point(0.0, scale * radius + 30.0 + abs(travel)))
    yield Body((Polylines(((top, low.plus(Point(0.0, max(-travel, 0.0)))),), "edge"),))
    hidden = _box(low.plus(Point(0.0, _LOAD.y / 2 + abs(travel))), 4.0, _LOAD.y / 2 + abs(travel))
    load = _box(low.plus(Point(0.0, _LOAD.y)), _LOAD.x, _LOAD.y)
    shapes = (Polylines((hidden,), "ground", closed=True), Polylines((load,), "block", closed=True))
    yield Body(shapes, (moves.slide(mesh.b, scale, Point(0.0, -1.0)),))


def _screw(placed: PlacedMesh, moves: _Moves, _: PaintOptions) -> Iterator[Body]:
    """A spindle from the side with its nut; a turn moves the nut by one drawn thread, not to scale."""
    mesh, lead = placed.mesh, 14.0
    middle = Point(0.0, 0.0)
    threads = tuple(
        (Point(x, _SCREW.y), Point(x + math.copysign(lead / 2, float(mesh.size_a)), -_SCREW.y))
        for x in np.arange(-_SCREW.x + lead / 2, _SCREW.x - lead / 2, lead).tolist()
    )
    yield Body((Polylines((_box(middle, _SCREW.x, _SCREW.y),), "block", closed=True), Polylines(threads, "hatch")))
    per = lead / abs(float(mesh.size_a))
    yield Body((Polylines((_box(middle, *_NUT),), "block", closed=True),), (moves.slide(mesh.b, per, Point(1.0, 0.0)),))


def _box(at: Point, half: float, high: float) -> tuple[Point, ...]:
    return tuple(Point(at.x + a * half, at.y + b * high) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))


BETWEEN: Mapping[str, Callable[[PlacedMesh, _Moves, PaintOptions], Iterator[Body]]] = {
    "belt": _loop,
    "chain": _loop,
    "crossed": _loop,
    "rack": _rack,
    "rack by pitch": _rack,
    "winch": _rope,
    "screw": _screw,
}
"""What is drawn between the links of a mesh besides its wheels."""
