"""Velocities and accelerations as arrows, and scale bars."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from gruebler.mechanics.linkages import LinkPoint
from gruebler.pictures.canvas.axes import as_text, rate_unit
from gruebler.pictures.canvas.labels import note_near
from gruebler.pictures.canvas.shapes import CircleShape, Point, Polylines, Shape, TextShape, bounds
from gruebler.pictures.canvas.symbols import arrow
from gruebler.pictures.linkage.layer_context import LayerContext
from gruebler.pictures.linkage.letters import joint_letters
from gruebler.pictures.linkage.posed_linkage import PosedLinkage

_LONGEST = 74.0  # pixels of the longest arrow
_LEAST = 0.02  # of the longest: shorter ones are left out
_REST = 1e-9  # sizes, for a drive of speed 1
_LENGTH = 90.0  # pixels of the scale bar of lengths, at most
_BELOW, _ROW = 20.0, 22.0  # pixels to the first bar, and from bar to bar
_READ_AS = {"dm": (0.1, "m")}  # units that hardly anybody reads, as others
_SYMBOLS = {1: "v", 2: "a"}
_NAMED = 8  # arrows: more of them have no names
_AWAY = 26.0  # pixels from a joint: the name of an arrow that ends nearer to one stands at its middle
_RIGHT, _DOWN = Point(1.0, 0.0), Point(0.0, 1.0)


def velocity_arrows(context: LayerContext) -> list[Shape]:
    """Velocities of joints and named points for a drive of speed 1."""
    return _arrows(context, 1, "velocity")


def acceleration_arrows(context: LayerContext) -> list[Shape]:
    """Accelerations of joints and named points for a drive of even speed 1."""
    return _arrows(context, 2, "acceleration")


class _Rate(NamedTuple):
    """The velocity or acceleration of a joint or named point."""

    letter: str
    at: complex
    value: complex


def _rates(posed: PosedLinkage, order: int) -> list[_Rate]:
    """Joints and named points, each place once, with their velocities or accelerations."""
    posed.driven()
    rates = {}
    for letter, place in _moving_points(posed):
        at, value = (complex(posed.pose.complex_point(place, order=k)[0]) for k in (0, order))
        rates[round(at.real, 9), round(at.imag, 9)] = _Rate(letter, at, value)
    return list(rates.values())


def _longest(posed: PosedLinkage, rates: Sequence[_Rate]) -> float:
    """The length of the longest one; 0 if all are zero or one is infinite."""
    longest = max((abs(rate.value) for rate in rates), default=0.0)
    return longest if _REST * posed.lower.size < longest < math.inf else 0.0


def _arrows(context: LayerContext, order: int, style: str) -> list[Shape]:
    """Arrows with their names: v or a with the letter of the joint or point."""
    posed = context.posed
    rates = _rates(posed, order)
    longest = _longest(posed, rates)
    pins = [shape.at for shape in context.drawn if isinstance(shape, CircleShape) and shape.style == "joint"]
    shapes: list[Shape] = []
    names = []
    for letter, at, rate in rates if longest else ():
        if abs(rate) > _LEAST * longest:
            vector = Point(_LONGEST * rate.real / longest, -_LONGEST * rate.imag / longest)
            tip = posed.local(at).plus(vector.unit, max(vector.length - 7.0, 1.0))
            shapes += arrow(posed.local(at), tip, style, f"{style}-head")
            end = posed.local(at).plus(vector)
            free = min((pin.minus(end).length for pin in pins), default=_AWAY) >= _AWAY
            names.append((end if free else posed.local(at).plus(vector, 0.5), f"{_SYMBOLS[order]}_{letter}"))
    for end, name in names if len(names) <= _NAMED else ():
        shapes.append(note_near(end, name, "value", [*context.drawn, *shapes]))
    return shapes


def _moving_points(posed: PosedLinkage) -> Iterator[tuple[str, LinkPoint]]:
    """Named points, and turning joints away from the frame, with their letters."""
    lower, mechanism, letters = posed.lower, posed.lower.mechanism, joint_letters(posed)
    yield from lower.points.items()
    for number, joint in enumerate(mechanism.chain.joints):
        if joint.pair.is_turning and mechanism.frame not in joint.links:
            e = lower.elements[number, joint.links[0]]
            yield letters[number], LinkPoint(joint.links[0], e.x, e.y)


class _ScaleBar(NamedTuple):
    """A scale bar: the largest number of pixels and its number of units."""

    pixels: float
    most: float
    unit: str
    style: str


def scale_bars(context: LayerContext, layers: Sequence[str]) -> list[Shape]:
    """Bars of round numbers of units for arrows and lengths, one below the other, below all drawn shapes."""
    corner, size = bounds(context.drawn, 0.0)
    shapes: list[Shape] = []
    bars = [bar for key in layers if (bar := _bar(context.posed, key)) is not None]
    for k, bar in enumerate(bars):
        number = _round(bar.most)
        start = Point(corner.x, corner.y + size.y + _BELOW + _ROW * k)
        end = start.plus(_RIGHT, number * bar.pixels / bar.most)
        ends = [(p.plus(_DOWN, -4.0), p.plus(_DOWN, 4.0)) for p in (start, end)]
        text = as_text(number, bar.unit, context.lang)
        shapes += [
            Polylines(((start, end), *ends), bar.style),
            TextShape(end.plus(_RIGHT, 9.0), text, "value", "start"),
        ]
    return shapes


def _bar(posed: PosedLinkage, key: str) -> _ScaleBar | None:
    unit = posed.linkage.unit
    if key == "scale":
        most, shown = _LENGTH / posed.scale, _READ_AS.get(unit, (1.0, unit))
        return _ScaleBar(_LENGTH, most * shown[0], shown[1], "measure")
    order = {"velocities": 1, "accelerations": 2}.get(key, 0)
    longest = _longest(posed, _rates(posed, order)) if order else 0.0
    if not longest:
        return None
    by = f"{'rad' if posed.driven().turning_drive else unit}{'²' if order == 2 else ''}"
    return _ScaleBar(_LONGEST, longest, rate_unit(unit, by), ("velocity", "acceleration")[order - 1])


def _round(most: float) -> float:
    """The largest number of 1, 2, 5 times a power of ten that is not larger.

    >>> _round(0.3), _round(7.0)
    (0.2, 5.0)
    """
    power = math.floor(math.log10(most))
    return float(f"{max(k for k in (1, 2, 5) if k * 10.0**power <= most * (1 + 1e-9))}e{power}")
