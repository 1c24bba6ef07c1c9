"""Pictures of bodies that shift and turn by keys at even times: one instant as shapes, all of them as animated SVG.

Lengths are pixels and y points down, as in every figure; angles are radians, counter-clockwise on the screen.
Between two keys all values are interpolated linearly, so that even motions need only two keys and are exact.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from gruebler.base.errors import GrueblerError
from gruebler.pictures.canvas.figure import Figure, figure_of, svg_document
from gruebler.pictures.canvas.shapes import (
    Point,
    Polylines,
    Shape,
    TextShape,
    bounds,
    moved_shape,
    placed_shape,
)
from gruebler.pictures.canvas.svg import svg_element, svg_number

_MARGIN = 16.0
_LONGEST = 3600.0  # seconds
_ROW, _SAMPLE = 20.0, 30.0  # of a list of lines
_LOOKS = 32  # instants that determine the size of a moving picture


@dataclass(frozen=True, slots=True)
class Shift:
    """A displacement at keys; one key is valid for all times."""

    places: tuple[Point, ...]


@dataclass(frozen=True, slots=True)
class Turn:
    """An angle about the body's own origin, at keys."""

    angles: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Body:
    """Shapes that move together; the first step is applied last, as in SVG."""

    shapes: tuple[Shape, ...]
    steps: tuple[Shift | Turn, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Clock:
    """The period in seconds, and the motion of the drive in it, in the given unit."""

    seconds: float
    low: float
    high: float
    unit: str
    round: bool = True
    """Evenly from low to high; else to and fro, as low + (high - low) sin²."""


@dataclass(frozen=True, slots=True)
class MovingPicture:
    """Bodies in painting order."""

    bodies: tuple[Body, ...]
    clock: Clock
    corner: Point
    """The upper left corner of all that is ever seen."""
    page: Figure
    """Without shapes: size, title and description."""

    def _repr_svg_(self) -> str:
        return moving_svg(self)


def moving(bodies: Iterable[Body], clock: Clock, title: str, description: str) -> MovingPicture:
    """The smallest moving picture around its bodies at all times."""
    parts = tuple(body for body in bodies if body.shapes)
    restless = [body for body in parts if body.steps]
    visible = [shape for k in range(_LOOKS if restless else 0) for shape in at_time(restless, k / _LOOKS)]
    visible += [shape for body in parts if not body.steps for shape in body.shapes]
    corner, size = bounds(visible, _MARGIN)
    return MovingPicture(
        parts, clock, corner, Figure((), width=size.x, height=size.y, title=title, description=description)
    )


def always(seconds: float) -> float:
    """The time, if it is a positive number of seconds up to an hour; else `gruebler.GrueblerError`."""
    if not 0 < seconds <= _LONGEST:
        raise GrueblerError(
            "the time is a number of seconds up to {longest:g}, not {seconds!r}", longest=_LONGEST, seconds=seconds
        )
    return seconds


def still_picture(bodies: Iterable[Body], title: str, description: str) -> Figure:
    """The figure of bodies at their first key."""
    return figure_of(at_time(bodies, 0.0), title, description, margin=_MARGIN)


def even_keys(turns: float, start: float = 0.0) -> Turn:
    """A motion by a number of turns at an even speed."""
    return Turn((start, start + math.tau * turns)) if turns else Turn((start,))


def key_list(rows: Iterable[tuple[str, str]], at: Point) -> list[Shape]:
    """The legend of lines: pairs of a style and a text, one below the other, each beside a sample of its line."""
    shapes: list[Shape] = []
    for k, (style, text) in enumerate(rows):
        start = at.plus(Point(0.0, _ROW * k))
        shapes += [Polylines(((start, start.plus(Point(_SAMPLE, 0.0))),), style)]
        shapes += [TextShape(start.plus(Point(_SAMPLE + 8.0, 0.0)), text, "value", "start")]
    return shapes


# --- one instant -----------------------------------------------------------------------------------


def at_time(bodies: Iterable[Body], time: float) -> list[Shape]:
    """The shapes of all bodies after a part of the time (0 to 1).

    >>> from gruebler.pictures.canvas.shapes import CircleShape
    >>> body = Body((CircleShape(Point(10, 0), 2, "joint"),), (Shift((Point(5, 5),)), even_keys(1)))
    >>> at = at_time([body], 0.25)[0].at  # a quarter turn upwards
    >>> round(at.x, 9), round(at.y, 9)
    (5.0, -5.0)
    """
    shapes: list[Shape] = []
    for body in bodies:
        turn, place = complex(1.0), Point(0.0, 0.0)
        for step in reversed(body.steps):
            if isinstance(step, Shift):
                place = place.plus(_between(step.places, time))
            else:
                by = cmath.rect(1.0, float(np.interp(time, np.linspace(0, 1, len(step.angles)), step.angles)))
                turn, place = turn * by, _turned(place, by)
        shapes += [_put(shape, turn, place) for shape in body.shapes]
    return shapes


def _between(places: Sequence[Point], time: float) -> Point:
    keys = np.linspace(0, 1, len(places))
    return Point(*(float(np.interp(time, keys, axis)) for axis in zip(*places, strict=True)))


def _turned(p: Point, turn: complex) -> Point:
    return Point(turn.real * p.x + turn.imag * p.y, turn.real * p.y - turn.imag * p.x)


def _put(shape: Shape, turn: complex, place: Point) -> Shape:
    """The shape turned about the origin (e^(i angle)) and then shifted."""
    return placed_shape(shape, lambda p: place.plus(_turned(p, turn)), cmath.phase(turn))


def figure_at(picture: MovingPicture, time: float) -> Figure:
    """One instant of a moving picture, in its frame."""
    by, page = Point(-picture.corner.x, -picture.corner.y), picture.page
    shapes = tuple(moved_shape(shape, by) for shape in at_time(picture.bodies, time))
    return Figure(shapes, width=page.width, height=page.height, title=page.title, description=page.description)


# --- SVG -------------------------------------------------------------------------------------------


def moving_svg(picture: MovingPicture) -> str:
    """The picture as animated SVG (SMIL), repeated without end, without script."""
    used = [shape.style for body in picture.bodies for shape in body.shapes]
    shift = f"{svg_number(-picture.corner.x)} {svg_number(-picture.corner.y)}"
    groups = (_group(body, picture.clock.seconds) for body in picture.bodies)
    return svg_document(picture.page, used, [f'<g transform="translate({shift})">', *groups, "</g>"])


def _group(body: Body, seconds: float) -> str:
    shapes = "".join(map(svg_element, body.shapes))
    if not body.steps:
        return shapes
    written = [_keys(step) for step in body.steps]
    first = " ".join(f"{kind}({values[0]})" for kind, values in written)
    if all(len(set(values)) == 1 for _, values in written):
        return f'<g transform="{first}">{shapes}</g>'
    return f'<g transform="{first}">{"".join(_moves(written, seconds))}{shapes}</g>'


def _moves(written: Sequence[tuple[str, list[str]]], seconds: float) -> Iterator[str]:
    """The transforms in order: the first replaces the transform of the group, the others are added."""
    for k, (kind, values) in enumerate(written):
        shown = ";".join(values[:1] * 2 if len(set(values)) == 1 else values)
        attributes = f'attributeName="transform" type="{kind}" additive="{"sum" if k else "replace"}"'
        yield f'<animateTransform {attributes} dur="{seconds:g}s" repeatCount="indefinite" values="{shown}"/>'


def _keys(step: Shift | Turn) -> tuple[str, list[str]]:
    if isinstance(step, Shift):
        return "translate", [f"{svg_number(place.x)} {svg_number(place.y)}" for place in step.places]
    return "rotate", [f"{round(-math.degrees(angle), 2) + 0.0:.10g}" for angle in step.angles]
