"""Plots of curves over axes: panels one below the other, a list of lines beside them; and the diagram of Q_G."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import GrueblerError
from gruebler.base.text import decimal_sign_in, translate
from gruebler.pictures.canvas.axes import Axis, Scale, angles, decades, decimals
from gruebler.pictures.canvas.figure import Figure, figure_of
from gruebler.pictures.canvas.free_space import Obstacles, complexes
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape, TextShape, moved_shape, text_width
from gruebler.pictures.canvas.simplification import FINE, simplified

_SIZE = Point(520.0, 300.0)
_TICK = 5.0
_ABOVE = 17.0  # from a panel to the name of its axis, and once more where marks have texts
_MARGINS = (10.0, 24.0, 38.0, 52.0, 66.0)  # beside a panel, kept free of the names of points
_BETWEEN = 62.0  # pixels from panel to panel
_BESIDE = 20.0  # from the panels to the list of lines
_ROW, _SAMPLE = 22.0, 34.0  # of the list


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class PlottedCurve:
    """A line through points; NaN breaks it."""

    x: Reals
    y: Reals
    name: str
    """The name in the list of lines; empty for no row there."""
    style: str
    right: bool = False
    """Whether it is read at the axis on the right."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PointMarker:
    """A point with a name."""

    x: float
    y: float
    text: str
    right: bool = False
    style: str = "dot"


@dataclass(frozen=True, slots=True)
class Band:
    """A shaded range of heights, with a text in it."""

    low: float
    high: float
    text: str


@dataclass(frozen=True, slots=True)
class AxisMarker:
    """A place on the axis below that is marked by a line upwards."""

    x: float
    text: str


@dataclass(frozen=True, slots=True)
class DwellMarker:
    """A shaded range of the axis below: a dwell, with a text above it."""

    low: float
    high: float
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Panel:
    """One pair of axes, or one with a second axis on the right, and what is in it."""

    across: Axis
    up: Axis
    curves: tuple[PlottedCurve, ...]
    right: Axis | None = None
    bands: tuple[Band, ...] = ()
    marks: tuple[AxisMarker, ...] = ()
    spots: tuple[PointMarker, ...] = ()
    dwells: tuple[DwellMarker, ...] = ()
    size: Point = _SIZE
    marked: str = ""
    """The name of the marks in the list of lines."""
    top: Axis | None = None
    """A second scale across, at the upper edge; its ticks are at the same places as those of the first."""

    def place(self, x: float, y: float, right: bool = False) -> Point:
        """A pair of values in pixels; the lower left corner is the origin."""
        axis = self.right if right and self.right is not None else self.up
        return Point(self.size.x * self.across.scale.part(x), -self.size.y * axis.scale.part(y))


def draw_panels(panels: Sequence[Panel], title: str, description: str, lang: str = "en") -> Figure:
    """The figure of panels one below the other; all lines with a name are listed on the right.

    >>> x = np.linspace(0, 360, 100)
    >>> sine = PlottedCurve(x=x, y=np.sin(x), name="", style="line-1")
    >>> panel = Panel(across=Axis("x", angles(0, 360)), up=Axis("y", decimals(-1, 1)), curves=(sine,))
    >>> draw_panels([panel], "sine", "A wave.").title
    'sine'
    """
    shapes: list[Shape] = []
    top = 0.0
    for panel in panels:
        shapes += [moved_shape(shape, Point(0.0, top + panel.size.y)) for shape in _painted(panel)]
        top += panel.size.y + _BETWEEN
    named = {curve.name: curve.style for panel in panels for curve in panel.curves if curve.name}
    named |= {panel.marked: "dead" for panel in panels if panel.marks and panel.marked}
    wide = max(panel.size.x + (_right_margin(panel.right) if panel.right else 0.0) for panel in panels)
    shapes += _listed(named, wide + _BESIDE)
    return figure_of([_localised(shape, lang) for shape in shapes], title, description, margin=14.0)


def _localised(shape: Shape, lang: str) -> Shape:
    """A shape whose numbers have the decimal sign of a language."""
    if isinstance(shape, TextShape) and shape.style in ("tick", "value"):
        return replace(shape, text=decimal_sign_in(shape.text, lang))
    return shape


def _right_margin(axis: Axis) -> float:
    return 2 * _TICK + max(map(text_width, axis.scale.names), default=0.0)


def _painted(panel: Panel) -> list[Shape]:
    """Everything in a panel; the names of its points avoid lines, not the grid."""
    drawn: list[Shape] = [Polylines(lines, c.style) for c in panel.curves if (lines := tuple(_pieces(panel, c)))]
    drawn += [*_frame(panel), *_marks(panel)]
    sides = [x for off in _MARGINS for x in (-off, panel.size.x + off)]
    margins = Polylines(tuple((Point(x, 0.0), Point(x, -panel.size.y)) for x in sides), "grid")
    for spot in panel.spots:
        at = panel.place(spot.x, spot.y, spot.right)
        drawn.append(CircleShape(at, 3.2, spot.style))
        drawn += [note_near(at, spot.text, "value", [*drawn, margins])] if spot.text else []
    shaded = [shape for band in panel.bands for shape in _shaded(panel, band, drawn)]
    dwells = [_dwell(panel, dwell) for dwell in panel.dwells]
    return [*dwells, *shaded, *_grid(panel), *drawn]


def _dwell(panel: Panel, dwell: DwellMarker) -> Shape:
    """A dwell, shaded from below to above."""
    start, end = (panel.size.x * panel.across.scale.part(x) for x in (dwell.low, dwell.high))
    high = panel.size.y
    return Polylines(
        ((Point(start, 0.0), Point(end, 0.0), Point(end, -high), Point(start, -high)),), "rest", closed=True
    )


# --- axes ------------------------------------------------------------------------------------------


def _grid(panel: Panel) -> Iterator[Shape]:
    wide, high = panel.size
    across, up = panel.across.scale, panel.up.scale
    columns = [Point(wide * across.part(x), 0.0) for x in across.ticks]
    rows = [Point(0.0, -high * up.part(y)) for y in up.ticks]
    lines = [(p, Point(p.x, -high)) for p in columns] + [(p, Point(wide, p.y)) for p in rows]
    if lines:
        yield Polylines(tuple(lines), "grid")


def _frame(panel: Panel) -> Iterator[Shape]:
    """The axes with ticks, their numbers, and the names of the quantities."""
    wide, high = panel.size
    corner = Point(0.0, 0.0)
    ends = [Point(0.0, -high), corner, Point(wide, 0.0), *([Point(wide, -high)] if panel.right else [])]
    strokes: list[tuple[Point, ...]] = [tuple(ends)]
    texts: list[TextShape] = []
    across = panel.across.scale
    for x, name in zip(across.ticks, across.names, strict=True):
        at = Point(wide * across.part(x), 0.0)
        strokes.append((at, at.plus(Point(0, 1), _TICK if name else _TICK / 2)))
        texts += [TextShape(at.plus(Point(0, 1), _TICK + 10.0), name, "tick")] if name else []
    for axis, edge, outward in ((panel.up, 0.0, -1.0), *([(panel.right, wide, 1.0)] if panel.right else [])):
        for y, name in zip(axis.scale.ticks, axis.scale.names, strict=True):
            at = Point(edge, -high * axis.scale.part(y))
            strokes.append((at, at.plus(Point(outward, 0.0), _TICK if name else _TICK / 2)))
            beside = at.plus(Point(outward, 0.0), _TICK + 4.0)
            texts += [TextShape(beside, name, "tick", "end" if outward < 0 else "start")] if name else []
    yield Polylines(tuple(strokes), "axis")
    yield from texts
    yield TextShape(Point(wide, _TICK + 27.0), panel.across.text, "value", "end")
    rows = 2 if any([*(mark.text for mark in panel.marks), *(dwell.text for dwell in panel.dwells)]) else 1
    if panel.top:
        yield from _top_axis(panel, panel.top)
        rows = 3
    above = -high - _ABOVE * rows
    yield TextShape(Point(0.0, above), panel.up.text, "value", "start")
    if panel.right:
        yield TextShape(Point(wide, above), panel.right.text, "value", "end")


def _top_axis(panel: Panel, top: Axis) -> Iterator[Shape]:
    wide, high = panel.size
    ends = [Point(wide * panel.across.scale.part(x), -high) for x in panel.across.scale.ticks]
    yield Polylines(
        ((Point(0.0, -high), Point(wide, -high)), *((at, at.plus(Point(0, -1), _TICK)) for at in ends)), "axis"
    )
    for at, name in zip(ends, top.scale.names, strict=True):
        yield TextShape(at.plus(Point(0, -1), _TICK + 9.0), name, "tick")
    yield TextShape(Point(wide / 2, -high - 2 * _ABOVE), top.text, "value")


def _shaded(panel: Panel, band: Band, drawn: Sequence[Shape]) -> Iterator[Shape]:
    """A range of heights, with its text where most space is free."""
    low, high = (panel.place(panel.across.scale.low, y) for y in (band.low, band.high))
    wide = Point(panel.size.x, 0.0)
    yield Polylines(((low, low.plus(wide), high.plus(wide), high),), "warning", closed=True)
    half = text_width(band.text, 11.0) / 2
    places = [Point(x, y) for y in (high.y + 11.0, low.y - 11.0) for x in (wide.x - half - 6.0, half + 6.0, wide.x / 2)]
    free = Obstacles(drawn).free(complexes(places), 2 * half)
    yield TextShape(places[int(free.argmax())], band.text, "tick")


def _marks(panel: Panel) -> Iterator[Shape]:
    """Lines upwards; their texts and those of dwells are side by side above the panel, if there is space."""
    last = -math.inf
    dwells = [AxisMarker((dwell.low + dwell.high) / 2, dwell.text) for dwell in panel.dwells]
    for mark in sorted([*panel.marks, *dwells], key=lambda mark: (mark.x, mark.text)):
        foot = panel.place(mark.x, panel.up.scale.low)
        top = Point(foot.x, -panel.size.y)
        if mark not in dwells:
            yield Polylines(((foot, top),), "dead")
        half = text_width(mark.text, 11.0) / 2
        if mark.text and foot.x - half > last:
            yield TextShape(top.plus(Point(0.0, -13.0)), mark.text, "tick")
            last = foot.x + half + 4.0


# --- lines -----------------------------------------------------------------------------------------


def _pieces(panel: Panel, curve: PlottedCurve) -> list[tuple[Point, ...]]:
    """The parts of a line within the panel, with fewer points."""
    axis = panel.right if curve.right and panel.right is not None else panel.up
    drawable = np.isfinite(curve.x) & np.isfinite(curve.y)
    if axis.scale.logarithmic:
        drawable &= curve.y > 0
    places = [
        panel.place(x, y, curve.right) if shown else None
        for x, y, shown in zip(curve.x.tolist(), curve.y.tolist(), drawable.tolist(), strict=True)
    ]
    parts: list[list[Point]] = []
    for start, end in pairwise(places):
        if start is None or end is None:
            continue
        inside = _clipped(start, end, panel.size)
        if inside is None:
            continue
        if parts and parts[-1][-1] == inside[0]:
            parts[-1].append(inside[1])
        else:
            parts.append(list(inside))
    return [tuple(simplified(part, FINE)) for part in parts]


def _clipped(a: Point, b: Point, size: Point) -> tuple[Point, Point] | None:
    """The part of a segment within a panel (Liang and Barsky 1984); None if there is none."""
    if all(0.0 <= p.x <= size.x and -size.y <= p.y <= 0.0 for p in (a, b)):
        return a, b
    along = b.minus(a)
    first, last = 0.0, 1.0
    for step, low, high in ((along.x, -a.x, size.x - a.x), (along.y, -size.y - a.y, -a.y)):
        if not step:
            if low > 1e-9 or high < -1e-9:
                return None
            continue
        enters, leaves = sorted((low / step, high / step))
        first, last = max(first, enters), min(last, leaves)
    if first > last:
        return None
    return a if first == 0.0 else a.plus(along, first), b if last == 1.0 else a.plus(along, last)


def _listed(named: dict[str, str], edge: float) -> Iterator[Shape]:
    """The names of the lines, one below the other, each beside a sample of its line."""
    for k, (name, style) in enumerate(named.items()):
        at = Point(edge, 8.0 + _ROW * k)
        yield Polylines(((at, at.plus(Point(_SAMPLE, 0.0))),), style)
        yield TextShape(at.plus(Point(_SAMPLE + 8.0, 0.0)), name, "value", "start")


# --- straight-line guidance ------------------------------------------------------------------------


def ratio_diagram(
    angle: Iterable[float],
    ratio: Iterable[float],
    length: Iterable[float],
    *,
    at: tuple[float, float, float] | None = None,
    begin: Callable[[float], float] | None = None,
    lang: str = "en",
    title: str = "",
    size: tuple[float, float] = _SIZE,
) -> Figure:
    """The diagram of a straight-line guidance: Q_G and L/l₁ over its crank angle.

    Args:
        angle: the window phi_G of the crank, in radians, ascending.
        ratio: Q_G, the deviation by the length; its scale, on the left, is logarithmic.
        length: L/l₁, the length by that of the crank; its scale is on the right.
        at: phi_G, Q_G and L/l₁ of an example, marked as P₁ and P₂.
        begin: the crank angle phi_A at the beginning of the window phi_G, both in radians: a scale at the top.
        lang: ``en`` or ``de``.
        title: of the picture; by default the kind of diagram.
        size: of the field between the axes, in pixels.

    Raises `GrueblerError` for lists of different lengths, less than two values, or ratios that are not positive.

    >>> figure = ratio_diagram([0.5, 1.6, 2.9], [1e-6, 1e-4, 5e-3], [0.8, 2.0, 3.9], at=(2.85, 0.005, 3.9))
    >>> [shape.text for shape in figure.shapes if isinstance(shape, TextShape)][-4:]
    ['P₁', 'P₂', 'Q_G', 'L/l₁']
    """
    phi, q, lengths = (np.array(list(values), np.float64) for values in (angle, ratio, length))
    if not len(phi) == len(q) == len(lengths) >= 2:
        raise GrueblerError(
            "expected three lists of the same length, but found {angles}, {ratios}, {lengths} values",
            angles=len(phi),
            ratios=len(q),
            lengths=len(lengths),
        )
    if not (np.isfinite([phi, q, lengths]).all() and (q > 0).all()):
        raise GrueblerError("expected finite values with ratios above 0")
    degrees = np.degrees(phi)
    spots: tuple[PointMarker, ...] = ()
    about = translate(
        "Relative deviation Q_G, logarithmic, and length L by crank length l₁ over the crank angle φ_G of "
        "the guidance.",
        lang,
    )
    if at is not None:
        x = math.degrees(at[0])
        spots = PointMarker(x=x, y=at[1], text="P₁"), PointMarker(x=x, y=at[2], text="P₂", right=True)
        point = translate(
            "At φ_G = {angle:.4g}°: Q_G = {ratio:.4g}, L/l₁ = {length:.4g}.", lang, angle=x, ratio=at[1], length=at[2]
        )
        about = f"{about} {point}"

    def axis(text: str, scale: Scale) -> Axis:
        return Axis(text, replace(scale, names=tuple(decimal_sign_in(name, lang) for name in scale.names)))

    across = angles(0.0, float(degrees.max()), tight=True)
    top = None
    if begin is not None:
        starts = tuple(math.degrees(begin(math.radians(x))) for x in across.ticks)
        names = tuple(f"{start:.4g}" for start in starts)
        top = axis(translate("φ_A in °", lang), replace(across, ticks=starts, names=names))
    panel = Panel(
        across=axis(translate("φ_G in °", lang), across),
        up=axis("Q_G", decades(float(q.min()), float(q.max()))),
        curves=(
            PlottedCurve(x=degrees, y=q, name="Q_G", style="line-1"),
            PlottedCurve(x=degrees, y=lengths, name="L/l₁", style="line-2", right=True),
        ),
        right=axis("L/l₁", decimals(0.0, float(lengths.max()))),
        marks=(AxisMarker(spots[0].x, ""),) if spots else (),
        spots=spots,
        size=Point(*size),
        top=top,
    )
    return draw_panels([panel], title or translate("Relative deviation of a straight-line guidance", lang), about)
