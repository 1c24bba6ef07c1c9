"""Closing conditions of wheels and circles, their numbers taken from the home position; docs/theory/wheels.md."""

from __future__ import annotations

from cmath import phase, rect
from typing import NamedTuple

from gruebler.linkages import Circle, Line, Linkage, Wheel
from gruebler.linkages.wheels import factors

__all__ = ["PIN", "SLIDE", "Condition", "contact_conditions", "home_angles", "side_of"]

PIN, SLIDE, RIDE, REACH, MESH, RACK = range(6)
"""Kinds of closing conditions, as in the kernel `closure`."""

Keys = tuple[tuple[int, str], ...]


class Condition(NamedTuple):
    """One closing condition of a group."""

    kind: int
    sides: tuple[int, int]
    """Its two elements, by number."""
    owners: tuple[int, int]
    """The bodies of the group that carry them, -1 for what is known."""
    values: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def winds(self) -> bool:
        """Whether it counts whole turns."""
        return self.kind in (MESH, RACK)


def contact_conditions(
    lower: Linkage, pair: str, keys: Keys, sides: tuple[int, int], owners: tuple[int, int]
) -> list[Condition]:
    """What a roll-slide or rolling pair of wheels, circles and lines asks for."""
    one, other = (lower.elements[keys[side]] for side in sides)
    if isinstance(other, Line):
        one, other, sides, owners = other, one, sides[::-1], owners[::-1]
    out = []
    if isinstance(other, Wheel):
        if isinstance(one, Line):
            raw = Condition(RACK, sides, owners, (other.radius * side_of(lower, keys, sides), 1.0, 0.0))
        else:
            assert isinstance(one, Wheel)
            raw = Condition(MESH, sides, owners, (*factors(one, other), 0.0))
        first, second, _ = raw.values
        near = home_angles(lower, keys, raw)
        value = first * near[0] + second * (near[1] if raw.kind == MESH else _way(lower, keys, sides).real)
        out.append(raw._replace(values=(first, second, value)))
    if pair == "rolling" or isinstance(other, Circle):
        assert isinstance(other, Wheel | Circle)
        if isinstance(one, Line):
            offset = other.radius * side_of(lower, keys, sides)
            out.append(Condition(RIDE, sides, owners, (0.0, 0.0, offset)))
        else:
            assert isinstance(one, Wheel | Circle)
            out.append(Condition(REACH, sides, owners, (0.0, 0.0, abs(one.radius + other.radius))))
    return out


def home_angles(lower: Linkage, keys: Keys, condition: Condition) -> tuple[float, float]:
    """The angles of a condition that counts whole turns, at home."""
    assert lower.home is not None
    angles = [lower.home[keys[side][1]].angle for side in condition.sides]
    if condition.kind == MESH:
        here, there = (_put(lower, keys, side) for side in condition.sides)
        along = phase(there - here)
        return angles[0] - along, angles[1] - along
    line = lower.elements[keys[condition.sides[0]]]
    assert isinstance(line, Line)
    return angles[1] - angles[0] - line.angle, 0.0


def side_of(lower: Linkage, keys: Keys, sides: tuple[int, int]) -> int:
    """On which side of a line a centre lies at home: 1 if on the left, seen along the line."""
    return -1 if _way(lower, keys, sides).imag < 0 else 1


def _way(lower: Linkage, keys: Keys, sides: tuple[int, int]) -> complex:
    """A centre at home, seen from a line: along it, and to the left of it."""
    assert lower.home is not None
    number, link = keys[sides[0]]
    line = lower.elements[number, link]
    assert isinstance(line, Line)
    gap = _put(lower, keys, sides[1]) - _put(lower, keys, sides[0])
    return gap * rect(1, -lower.home[link].angle - line.angle)


def _put(lower: Linkage, keys: Keys, side: int) -> complex:
    assert lower.home is not None
    number, link = keys[side]
    element = lower.elements[number, link]
    return complex(*lower.home[link].put(element.x, element.y))
