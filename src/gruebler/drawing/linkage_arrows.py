"""Velocities and accelerations as arrows, and bars that tell the scale."""

from __future__ import annotations

import math

from gruebler.drawing.figure import Lines, Point, Shape, Text, bounds
from gruebler.drawing.sheet import Sheet
from gruebler.drawing.stage import Stage
from gruebler.drawing.symbols import arrow
from gruebler.linkages import Named

__all__ = ["acceleration_arrows", "length_bar", "velocity_arrows"]

_LONGEST = 74.0  # pixels of the longest arrow
_LEAST = 0.02  # of the longest: shorter ones are left out
_REST = 1e-9  # sizes, for a drive of speed 1
_RIGHT, _DOWN = Point(1.0, 0.0), Point(0.0, 1.0)


def velocity_arrows(sheet: Sheet) -> list[Shape]:
    """Velocities of joints and named points for a drive of speed 1, with a scale below."""
    return _arrows(sheet, 1, "velocity")


def acceleration_arrows(sheet: Sheet) -> list[Shape]:
    """Accelerations of joints and named points for a drive of even speed 1, with a scale below."""
    return _arrows(sheet, 2, "acceleration")


def _arrows(sheet: Sheet, order: int, style: str) -> list[Shape]:
    stage, course, lower = sheet.stage, sheet.stage.driven(), sheet.stage.lower
    pairs = {}
    for place in _moving_points(stage):
        at, rate = (complex(stage.pose.complex_point(place, k)[0]) for k in (0, order))
        pairs[round(at.real, 9), round(at.imag, 9)] = at, rate
    longest = max((abs(rate) for _, rate in pairs.values()), default=0.0)
    if not _REST * lower.size < longest < math.inf:
        return []
    factor = _LONGEST / longest
    shapes: list[Shape] = []
    for at, rate in pairs.values():
        if abs(rate) > _LEAST * longest:
            way = Point(factor * rate.real, -factor * rate.imag)
            tip = stage.local(at).plus(way.unit, max(way.length - 7.0, 1.0))
            shapes += arrow(stage.local(at), tip, style, f"{style}-head")
    power = "" if order == 1 else "²"
    unit = f"{stage.linkage.unit}/{'rad' if course.turning_drive else stage.linkage.unit}{power}"
    return [*shapes, *_bar(sheet, factor, longest, unit, style)]


def _moving_points(stage: Stage) -> list[Named]:
    """Named points, and turning joints away from the frame."""
    lower, mechanism = stage.lower, stage.lower.mechanism
    places = list(lower.points.values())
    for number, joint in enumerate(mechanism.chain.joints):
        if joint.pair.name == "revolute" and mechanism.frame not in joint.links:
            e = lower.elements[number, joint.links[0]]
            places.append(Named(joint.links[0], e.x, e.y))
    return places


def length_bar(sheet: Sheet) -> list[Shape]:
    """A length to compare with."""
    stage = sheet.stage
    return _bar(sheet, stage.scale, 90.0 / stage.scale, stage.linkage.unit, "measure")


def _bar(sheet: Sheet, factor: float, most: float, unit: str, style: str) -> list[Shape]:
    """A bar of a round number of units, below all that the linkage reaches and all that is drawn."""
    round_number = _round(most)
    upper, lower = sheet.stage.reach
    corner, size = bounds(sheet.drawn, 0.0)
    left = Point(upper.x, max(lower.y + 52.0, corner.y + size.y + 14.0))
    right = left.plus(_RIGHT, round_number * factor)
    ends = [(p.plus(_DOWN, -4.0), p.plus(_DOWN, 4.0)) for p in (left, right)]
    words = Text(right.plus(_RIGHT, 9.0), f"{round_number:g} {unit}", "value", "start")
    return [Lines(((left, right), *ends), style), words]


def _round(most: float) -> float:
    """The largest number of 1, 2, 5 times a power of ten that is not larger.

    >>> _round(0.3), _round(7.0)
    (0.2, 5.0)
    """
    power = math.floor(math.log10(most))
    return float(f"{max(k for k in (1, 2, 5) if k * 10.0**power <= most * (1 + 1e-9))}e{power}")
