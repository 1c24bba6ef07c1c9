"""Diagrams over a turn below the picture of a machine, with a cursor if the machine moves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.text import number
from gruebler.pictures.canvas.axes import Axis, angles, decimals
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.moving_picture import Body, Shift, at_time
from gruebler.pictures.canvas.panels import AxisMarker, Panel, PlottedCurve, draw_panels
from gruebler.pictures.canvas.shapes import Point, Polylines, Shape, bounds, moved_shape
from gruebler.pictures.canvas.styles import LINES

_PANEL = Point(460.0, 120.0)
_GAP = 22.0  # pixels between a machine and its diagram


def turn_diagram(x: Reals, rows: Sequence[tuple[str, Reals]], at: float | None, title: str, lang: str) -> Figure:
    """Panels one below the other over the angle phi from 0 to a turn.

    Args:
        x: angles in radians.
        rows: the name of the quantity and the values of each panel.
        at: an angle in radians that is marked.
        title: of the figure.
        lang: language of its numbers.
    """
    marks: tuple[AxisMarker, ...] = ()
    if at is not None:
        degrees = round(math.degrees(at % math.tau), 2)
        marks = (AxisMarker(degrees, number(degrees, lang, "g") + "°"),)
    panels = []
    for k, (text, y) in enumerate(rows):
        axis = Axis(text, decimals(float(y.min()), float(y.max()), few=4))
        shown = tuple(replace(mark, text=mark.text if k == 0 else "") for mark in marks)
        curves = (PlottedCurve(x=np.degrees(x), y=y, name="", style=LINES[0]),)
        panels.append(
            Panel(across=Axis("φ in °", angles(0.0, 360.0, few=12)), up=axis, curves=curves, marks=shown, size=_PANEL)
        )
    return draw_panels(panels, title, "", lang)


def beneath(diagram: Figure, bodies: Sequence[Body]) -> list[Shape]:
    """The shapes of a diagram below bodies, left-aligned with the fixed ones."""
    reach = [shape for k in range(8) for shape in at_time(bodies, k / 8)]
    corner, size = bounds(reach, 0.0)
    return [moved_shape(shape, Point(corner.x, corner.y + size.y + _GAP)) for shape in diagram.shapes]


def running(diagram: list[Shape]) -> list[Body]:
    """The diagram and a cursor that moves evenly through all of its panels."""
    frames = [shape.parts[0] for shape in diagram if isinstance(shape, Polylines) and shape.style == "axis"]
    corner, right = frames[0][1], frames[0][2]
    lines = tuple((Point(0.0, frame[0].y), Point(0.0, frame[1].y)) for frame in frames)
    run = Shift((Point(corner.x, 0.0), Point(right.x, 0.0)))
    return [Body(tuple(diagram)), Body((Polylines(lines, "drive"),), (run,))]
