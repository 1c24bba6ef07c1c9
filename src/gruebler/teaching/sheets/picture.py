"""The mechanism of a sheet to scale, with its coupler curve, the axis of symmetry and the tangent."""

from __future__ import annotations

import cmath
import math

import numpy as np

from gruebler.base.text import translate
from gruebler.pictures.canvas.figure import Figure, figure_of
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape, TextShape, moved_shape
from gruebler.pictures.canvas.simplification import FINE, simplified
from gruebler.pictures.canvas.symbols import arrow
from gruebler.pictures.linkage.picture import draw_linkage
from gruebler.pictures.linkage.posed_linkage import PosedLinkage, posed_linkage
from gruebler.teaching.sheets.messages import with_subscripts
from gruebler.teaching.sheets.model import Sheet

_BEYOND = 22.0  # pixels
_DASH, _GAP = 9.0, 4.0
_LONG, _BAND = 190.0, 26.0  # pixels of L and Δy in the picture of the definition
_SAMPLES = 241
_MORE = 0.06  # of the window: how much of the curve is drawn beyond it


def scale_picture(sheet: Sheet, lang: str = "en") -> Figure:
    """The linkage in the sheet's pose with joints and marked points by their names, tangent g and axis of symmetry."""
    pose = math.radians(sheet.record.picture.pose)
    point = sheet.record.names[sheet.record.point]
    plain = draw_linkage(sheet.linkage, at=pose, curves=[point], lang=lang, name=sheet.record.title.in_language(lang))
    posed = posed_linkage(sheet.linkage, pose)
    by = _offset(plain, posed)
    shapes = [*plain.shapes, *(moved_shape(shape, by) for shape in _lines(sheet, posed))]
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


def definition_picture(sheet: Sheet, lang: str = "en") -> tuple[Figure, float]:
    """The piece of the curve that the example uses, with g, L and Δy, and how many times it is enlarged across g.

    The drawing is the definition of Q_G = Δy/L: L between the ends K_A and K_E of the piece, along g; Δy the width of
    the band parallel to g that holds the piece.
    """
    piece, window = sheet.example.sizing.piece, sheet.window
    wide = piece.end - piece.start
    beyond = np.linspace(0.0, _MORE * wide, 20)[1:]
    used = np.linspace(piece.start, piece.end, _SAMPLES)
    values = np.concatenate([piece.start - beyond[::-1], used, piece.end + beyond])
    touch = sheet.place(sheet.motion(math.degrees(window.centre)), sheet.record.point)
    local = (sheet.path(values) * sheet.unit_length - touch) * cmath.exp(-1j * window.direction)
    inside = (values >= piece.start) & (values <= piece.end)
    along, across = _LONG / np.ptp(local[inside].real), _BAND / np.ptp(local[inside].imag)
    places = [Point(along * z.real, -across * z.imag) for z in local.tolist()]
    kept = [place for place, here in zip(places, inside, strict=True) if here]
    begin, end = kept[0], kept[-1]
    left, right = min(kept).x, max(kept).x
    top, bottom = min(place.y for place in kept), max(place.y for place in kept)
    shapes: list[Shape] = [
        *(_dashed(Point(left - _BEYOND, y), Point(right + _BEYOND, y)) for y in (top, bottom)),
        Polylines(((Point(left - 2 * _BEYOND, 0.0), Point(right + 2 * _BEYOND, 0.0)),), "measure"),
        Polylines((tuple(simplified(places, FINE)),), "curve"),
        *(CircleShape(at, 3.0, "dot") for at in (begin, end, Point(0.0, 0.0))),
    ]
    level = bottom + 34.0
    for at in (begin, end):
        shapes.append(Polylines(((at.plus(Point(0.0, 1.0), 5.0), Point(at.x, level + 5.0)),), "dimension"))
    shapes += _dimension_line(Point(left, level), Point(right, level))
    shapes.append(TextShape(Point((left + right) / 2, level - 9.0), "L", "value"))
    beside = right + 1.4 * _BEYOND
    shapes += _dimension_line(Point(beside, top - 24.0), Point(beside, top), single_arrow=True)
    shapes += _dimension_line(Point(beside, bottom + 24.0), Point(beside, bottom), single_arrow=True)
    shapes.append(TextShape(Point(beside + 8.0, top - 16.0), "Δy", "value", "start"))
    shapes.append(TextShape(Point(left - 2 * _BEYOND - 9.0, 0.0), "g", "value"))
    name = sheet.record.point
    for at, text in ((begin, f"{name}_A"), (end, f"{name}_E"), (Point(0.0, 0.0), f"{name}_I")):
        shapes.append(note_near(at, text, "value", shapes))
    title = translate("Definition of the relative deviation Q_G = Δy/L", lang)
    return figure_of(shapes, title, title), float(across / along)


def _dimension_line(a: Point, b: Point, *, single_arrow: bool = False) -> list[Shape]:
    """A line with a head at its end, or at both."""
    forward = b.minus(a).unit
    heads = arrow(a if single_arrow else a.plus(forward, 7.0), b.plus(forward, -7.0), "dimension", "dimension-head")
    if single_arrow:
        return heads
    return [*heads, *arrow(a.plus(forward, 8.0), a.plus(forward, 7.0), "dimension", "dimension-head")]


def _offset(figure: Figure, posed: PosedLinkage) -> Point:
    """The shift of the figure relative to the posed linkage, from the places of its turning joints."""
    chain = posed.linkage.mechanism.chain
    named = zip(chain.joint_names(), chain.joints, strict=True)
    pins = [posed.place(posed.linkage.points_named(name)[0]) for name, joint in named if joint.pair.is_turning]
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
