"""The mechanism of a sheet to scale, with its coupler curve, the axis of symmetry and the tangent."""

from __future__ import annotations

import cmath
import math

from gruebler.drawing.canvas.figure import Figure, figure_of
from gruebler.drawing.canvas.labels import note_near
from gruebler.drawing.canvas.shapes import CircleShape, Point, Polylines, Shape, TextShape
from gruebler.drawing.linkage.picture import draw_linkage
from gruebler.drawing.linkage.posed_linkage import PosedLinkage, posed_linkage
from gruebler.sheets.messages import with_subscripts
from gruebler.sheets.model import Sheet

__all__ = ["scale_picture"]

_BEYOND = 22.0  # pixels
_DASH, _GAP = 9.0, 4.0


def scale_picture(sheet: Sheet, lang: str = "en") -> Figure:
    """The linkage in the sheet's pose with joints and marked points by their names, tangent g and axis of symmetry."""
    pose = math.radians(sheet.record.picture.pose)
    point = sheet.record.names[sheet.record.point]
    plain = draw_linkage(sheet.linkage, pose, curves=[point], lang=lang, name=sheet.record.title.in_language(lang))
    posed = posed_linkage(sheet.linkage, pose)
    by = _offset(plain, posed)
    shapes = [*plain.shapes, *(_moved(shape, by) for shape in _lines(sheet, posed))]
    motion = sheet.motion(sheet.record.picture.pose)
    for name in sheet.record.names:
        if name != sheet.record.point:
            at = posed.local(sheet.place(motion, name)).plus(by)
            shapes.append(note_near(at, with_subscripts(name), "value", shapes))
    for name, degrees in sheet.record.picture.marks.items():
        at = posed.local(sheet.place(sheet.motion(degrees), sheet.record.point)).plus(by)
        shapes.append(CircleShape(at, 3.0, "dot"))
        shapes.append(note_near(at, name, "value", shapes))
    return figure_of(shapes, plain.title, plain.description)


def _offset(figure: Figure, posed: PosedLinkage) -> Point:
    """The shift of the figure relative to the posed linkage, from the places of its turning joints."""
    names = posed.linkage.mechanism.chain.joint_names()
    pins = [posed.place(posed.linkage.points_named(name)[0]) for name in names if name.startswith("R")]
    rings = [shape.at for shape in figure.shapes if isinstance(shape, CircleShape) and shape.style == "joint"]
    return Point(
        min(ring.x for ring in rings) - min(pin.x for pin in pins),
        min(ring.y for ring in rings) - min(pin.y for pin in pins),
    )


def _lines(sheet: Sheet, posed: PosedLinkage) -> list[Shape]:
    """The tangent g along the piece of the example, and the axis across it."""
    piece, window = sheet.example.sizing.piece, sheet.window
    touch = sheet.place(sheet.motion(math.degrees(window.centre)), sheet.record.point)
    along = cmath.rect(1.0, window.direction)
    half = 0.75 * piece.length * sheet.unit_length
    ends = [posed.local(touch + side * half * along) for side in (-1, 1)]
    shapes: list[Shape] = [
        Polylines((tuple(ends),), "measure"),
        TextShape(ends[1].plus(ends[1].minus(ends[0]).unit, 9.0), "g", "value"),
    ]
    name = sheet.record.picture.axis_through
    if name is not None:
        foot = sheet.place(sheet.motion(math.degrees(window.centre)), name)
        marks = [sheet.place(sheet.motion(at), sheet.record.point) for at in sheet.record.picture.marks.values()]
        low, high = posed.local(foot), posed.local(max([touch, *marks], key=lambda z: abs(z - foot)))
        direction = high.minus(low).unit
        shapes.insert(0, _dashed(low.plus(direction, -_BEYOND), high.plus(direction, _BEYOND)))
    return shapes


def _dashed(a: Point, b: Point) -> Polylines:
    """A line of dashes as separate strokes, like a centre line."""
    direction, length = b.minus(a).unit, b.minus(a).length
    starts = [k * (_DASH + _GAP) for k in range(int(length / (_DASH + _GAP)) + 1)]
    return Polylines(
        tuple((a.plus(direction, s), a.plus(direction, min(s + _DASH, length))) for s in starts), "measure"
    )


def _moved(shape: Shape, by: Point) -> Shape:
    match shape:
        case Polylines(parts, style, closed):
            return Polylines(tuple(tuple(point.plus(by) for point in part) for part in parts), style, closed)
        case TextShape(at, words, style, anchor):
            return TextShape(at.plus(by), words, style, anchor)
    return shape
