"""What a joint is on one of its links: a pin, or a line along which something slides.

Circles and contours of gears and cams are further kinds of elements; each kind is one row of `_WANTED`.
"""

from __future__ import annotations

from math import cos, hypot, isfinite, sin
from typing import NamedTuple

from gruebler.errors import LinkageError
from gruebler.pairs import Pair

__all__ = ["Element", "Line", "Named", "Pin", "Place", "fitting", "read_element"]


class Pin(NamedTuple):
    """The axis of a turning joint: a point of the link."""

    x: float
    y: float


class Line(NamedTuple):
    """A slide: a line of the link through a point; ways are counted from the point, in the direction of the angle."""

    x: float
    y: float
    angle: float


Element = Pin | Line


class Named(NamedTuple):
    """A point of a link that has a name, such as a coupler point."""

    link: str
    x: float
    y: float


class Place(NamedTuple):
    """Where a link lies: its origin, and the angle of its x axis."""

    x: float
    y: float
    angle: float

    def put(self, x: float, y: float) -> tuple[float, float]:
        """Where a point of the link lies.

        >>> Place(1.0, 0.0, 0.0).put(2.0, 3.0)
        (3.0, 3.0)
        """
        c, s = cos(self.angle), sin(self.angle)
        return self.x + c * x - s * y, self.y + s * x + c * y

    def seen(self, x: float, y: float) -> tuple[float, float]:
        """The coordinates in the link of a point that lies there."""
        c, s = cos(self.angle), sin(self.angle)
        return c * (x - self.x) + s * (y - self.y), c * (y - self.y) - s * (x - self.x)


_WANTED: dict[str, tuple[tuple[type, ...], str]] = {
    "revolute": ((Pin, Pin), "a pin [x, y] on each of its links"),
    "prismatic": ((Line, Line), "a line [x, y, angle] on each of its links"),
    "roll_slide": ((Line, Pin), "a line [x, y, angle] on one of its links and a pin [x, y] on the other"),
    "double_slide": ((Line, Line), "a line [x, y, angle] on each of its links"),
}


def fitting(pair: Pair, name: str, elements: dict[str, Element]) -> None:
    """Check that a joint has the elements of its pair; `LinkageError` names the joint."""
    if pair.name not in _WANTED:
        raise LinkageError(f"{name}: dimensions of this kind of joint ({pair.name}) are not known here")
    kinds, wanted = _WANTED[pair.name]
    made = sorted((type(e) for e in elements.values()), key=lambda kind: kind.__name__)
    asked = [kinds[0]] * len(made) if kinds[0] is kinds[1] else sorted(kinds, key=lambda kind: kind.__name__)
    if made != asked:
        raise LinkageError(f"{name} needs {wanted}")


def read_element(raw: object, where: str) -> Element:
    """The element that two or three numbers stand for; angles in radians.

    >>> read_element([3, 4], "crank")
    Pin(x=3.0, y=4.0)
    """
    if isinstance(raw, Pin | Line):
        numbers: tuple[object, ...] = tuple(raw)
    elif isinstance(raw, list | tuple):
        numbers = tuple(raw)
    else:
        raise LinkageError(f"{where}: expected [x, y] or [x, y, angle], but found {raw!r}")
    if len(numbers) not in (2, 3):
        raise LinkageError(f"{where}: expected two or three numbers, but found {len(numbers)}")
    made = []
    for value in numbers:
        if isinstance(value, bool) or not isinstance(value, int | float) or not _usable(value):
            raise LinkageError(f"{where}: expected finite numbers, but found {value!r}")
        made.append(float(value))
    return Pin(*made) if len(made) == 2 else Line(*made)


def _usable(value: float) -> bool:
    try:
        return isfinite(value) and hypot(value) < 1e100
    except OverflowError:
        return False
