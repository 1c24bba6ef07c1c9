"""Closing conditions of wheels and circles, their numbers taken from the reference pose; docs/theory/wheels.md."""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import degrees, floor, pi

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.motion.closure import FACE, MESH, POLAR, RACK, REACH, RIDE
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.contours import COEFFICIENTS, PiecewiseLaw, cam_law, turn_law
from gruebler.mechanics.kinematics.noncircular import transfer_of
from gruebler.mechanics.linkages import CamDisc, Circle, Element, GenevaDriver, Line, Linkage, NonCircular, Wheel
from gruebler.mechanics.linkages.elements import INVERSE, RoundElement, direction
from gruebler.mechanics.linkages.wheels import rolling_factors
from gruebler.structure.chain.pairs import Pair

Keys = tuple[tuple[int, str], ...]
_NO_LAW = PiecewiseLaw(())
_MESHES = 1e-6  # radians: angles of a drawing with six digits fit


@dataclass(frozen=True, slots=True)
class Condition:
    """One closing condition of a group."""

    kind: int
    sides: tuple[int, int]
    """Its two elements, by number."""
    owners: tuple[int, int]
    """The bodies of the group that carry them, -1 for what is known."""
    values: tuple[float, float, float] = (0.0, 0.0, 0.0)
    law: PiecewiseLaw = _NO_LAW

    @property
    def winds(self) -> bool:
        """Whether it counts whole turns."""
        return self.kind in (MESH, RACK)


def contact_conditions(
    lower: Linkage, pair: Pair, keys: Keys, sides: tuple[int, int], owners: tuple[int, int]
) -> list[Condition]:
    """What a roll-slide or rolling pair of wheels, circles and lines asks for."""
    first, second = (lower.elements[keys[side]] for side in sides)
    if _rank(second) < _rank(first):
        first, second, sides, owners = second, first, sides[::-1], owners[::-1]
    if isinstance(first, CamDisc):
        return [Condition(POLAR, sides, owners, (first.base * first.scale, 0.0, 0.0), cam_law(first))]
    if isinstance(second, CamDisc):
        return [Condition(FACE, sides, owners, (0.0, float(side_of(lower, keys, sides)), 0.0), cam_law(second))]
    if isinstance(first, GenevaDriver | NonCircular):
        raw = Condition(MESH, sides, owners, (lower.size, -lower.size, 0.0), turn_law(first, second))
        condition = _phased(lower, keys, raw)
        if isinstance(first, NonCircular):
            _check_phase(lower, keys, condition)
        return [condition]
    conditions = []
    if isinstance(second, Wheel):
        if isinstance(first, Line):
            raw = Condition(RACK, sides, owners, (second.radius * side_of(lower, keys, sides), 1.0, 0.0))
        else:
            assert isinstance(first, Wheel)
            raw = Condition(MESH, sides, owners, (*rolling_factors(first, second), 0.0))
        conditions.append(_phased(lower, keys, raw))
    if pair.rolls or isinstance(second, Circle):
        assert isinstance(second, RoundElement)
        if isinstance(first, Line):
            offset = second.radius * side_of(lower, keys, sides)
            conditions.append(Condition(RIDE, sides, owners, (0.0, 0.0, offset)))
        else:
            assert isinstance(first, RoundElement)
            conditions.append(Condition(REACH, sides, owners, (0.0, 0.0, abs(first.radius + second.radius))))
    return conditions


def _rank(element: Element) -> int:
    """Which element comes first in a condition."""
    if isinstance(element, NonCircular):
        return 3 if element.transfer == INVERSE else 2
    return next((k for k, kind in enumerate((Line, CamDisc, GenevaDriver)) if isinstance(element, kind)), 3)


def _check_phase(lower: Linkage, keys: Keys, condition: Condition) -> None:
    """Refuse non-circular wheels that do not touch there; the second may start in any of its equal parts."""
    first, second = (lower.elements[keys[side]] for side in condition.sides)
    assert isinstance(first, NonCircular)
    assert isinstance(second, NonCircular)
    part = 2 * pi / transfer_of(first, second).mean.denominator
    off = condition.values[2] / lower.size + pi
    off -= part * floor(off / part + 0.5)
    if abs(off) > _MESHES:
        raise LinkageError(
            "the non-circular wheels do not mesh in the reference pose: turn {keys!r}, or its direction, by {off:.9g}°",
            keys=keys[condition.sides[1]][1],
            off=degrees(off),
        )


def _phased(lower: Linkage, keys: Keys, raw: Condition) -> Condition:
    """The condition as it holds in the reference pose."""
    a, b, _ = raw.values
    first, second = reference_angles(lower, keys, raw)
    if raw.kind == RACK:
        second = _way(lower, keys, raw.sides).real
    elif raw.law.pieces:
        first = law_at(raw.law, first)
    return replace(raw, values=(a, b, a * first + b * second))


def law_at(law: PiecewiseLaw, angle: float) -> float:
    """The value of a law."""
    turns = floor((angle - law.pieces[0][0] + law.pieces[0][1]) / (2 * pi))
    place = angle - 2 * pi * turns
    middle, half, *coefficients = next(p for p in reversed(law.pieces) if place >= p[0] - p[1] or p is law.pieces[0])
    value = 0.0
    for c in reversed(coefficients):
        value = value * (place - middle) / half + c
    return value + turns * law.advance


def reference_angles(lower: Linkage, keys: Keys, condition: Condition) -> tuple[float, float]:
    """The angles of a condition that counts whole turns, in the reference pose."""
    angles = [
        lower.required_pose[keys[side][1]].angle + direction(lower.elements[keys[side]]) for side in condition.sides
    ]
    if condition.kind == MESH:
        here, there = (_put(lower, keys, side) for side in condition.sides)
        along = phase(there - here)
        return angles[0] - along, angles[1] - along
    return angles[1] - angles[0], 0.0


def law_tables(laws: Sequence[PiecewiseLaw]) -> tuple[list[tuple[float, float, float]], NDArray[np.float64]]:
    """For each law its first piece, the number of pieces and the advance; and all pieces."""
    rows: list[tuple[float, ...]] = []
    entries = []
    for law in laws:
        entries.append((float(len(rows)), float(len(law.pieces)), law.advance))
        rows += law.pieces
    return entries, np.array(rows).reshape(-1, 2 + COEFFICIENTS)


def side_of(lower: Linkage, keys: Keys, sides: tuple[int, int]) -> int:
    """On which side of a line a centre lies in the reference pose: 1 if on the left, seen along the line."""
    return -1 if _way(lower, keys, sides).imag < 0 else 1


def _way(lower: Linkage, keys: Keys, sides: tuple[int, int]) -> complex:
    """A centre in the reference pose, seen from a line: along it, and to the left of it."""
    number, link = keys[sides[0]]
    line = lower.elements[number, link]
    assert isinstance(line, Line)
    gap = _put(lower, keys, sides[1]) - _put(lower, keys, sides[0])
    return gap * rect(1, -lower.required_pose[link].angle - line.angle)


def _put(lower: Linkage, keys: Keys, side: int) -> complex:
    number, link = keys[side]
    element = lower.elements[number, link]
    return complex(*lower.required_pose[link].put(element.x, element.y))
