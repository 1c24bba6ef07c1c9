"""What compass and ruler do: lines and circles that meet, perpendiculars, middles; places are complex numbers."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.pictures.canvas.construction import Construction, ConstructionStep, Drawn, Segment

_PARALLEL = 1e-12  # sine of an angle: lines at a smaller angle do not meet on paper


class Board:
    """A construction while it is made."""

    def __init__(self, title: Message) -> None:
        self.title = title
        self.steps: list[ConstructionStep] = []

    def step(self, text: str | Message, *drawn: Drawn, **values: object) -> None:
        """A step: what is done, with the values in its gaps, and what it adds."""
        self.steps.append(ConstructionStep(message(text, **values) if isinstance(text, str) else text, drawn))

    def done(self, **values: float) -> Construction:
        """The construction with the values measured in it."""
        return Construction(self.title, tuple(self.steps), values)


def segments(style: str, *places: complex) -> tuple[Segment, ...]:
    """The lines from each place to the next."""
    return tuple(Segment(begin, end, style) for begin, end in pairwise(places))


def coordinates(**places: complex) -> dict[str, float]:
    """The values x and y of places, each by its name.

    >>> coordinates(P=1 + 2j)
    {'x_P': 1.0, 'y_P': 2.0}
    """
    return {f"{axis}_{name}": part for name, z in places.items() for axis, part in (("x", z.real), ("y", z.imag))}


def meet_left(centre: complex, radius: float, other: complex, other_radius: float) -> complex:
    """Where two circles meet, to the left of the line from the first centre to the other.

    Raises `LinkageError` if they do not meet.

    >>> meet_left(0j, 5, 6 + 0j, 5)
    (3+4j)
    """
    line = other - centre
    d = abs(line)
    x = (d**2 + radius**2 - other_radius**2) / (2 * d)
    height = radius**2 - x**2
    if height < -1e-12 * radius**2:
        raise LinkageError("two circles of the construction do not meet: these lengths form no triangle")
    return centre + line / d * complex(x, math.sqrt(max(height, 0.0)))


def lines_meet(at: complex, direction: complex, other: complex, other_direction: complex) -> complex:
    """Where the lines through two places in given directions meet; `LinkageError` if they are parallel.

    >>> lines_meet(0j, 1 + 1j, 4 + 0j, -1 + 1j)
    (2+2j)
    """
    sine = (direction.conjugate() * other_direction).imag
    if abs(sine) <= _PARALLEL * abs(direction) * abs(other_direction):
        raise LinkageError("two lines of the construction are parallel: their point lies at infinity")
    return at + direction * ((other - at).conjugate() * other_direction).imag / sine


def line_meets_circle(at: complex, direction: complex, centre: complex, radius: float) -> tuple[complex, complex]:
    """Where a line meets a circle, in the order of its direction; `LinkageError` if it does not.

    >>> line_meets_circle(-9 + 3j, 1 + 0j, 0j, 5)
    ((-4+3j), (4+3j))
    """
    unit = direction / abs(direction)
    local = (centre - at) / unit
    half = radius**2 - local.imag**2
    if half < -1e-12 * radius**2:
        raise LinkageError("a line and a circle of the construction do not meet: these lengths form no triangle")
    half = math.sqrt(max(half, 0.0))
    return at + unit * (local.real - half), at + unit * (local.real + half)


def along(begin: complex, end: complex, length: float) -> complex:
    """The place at a distance from one place towards another."""
    return begin + length * (end - begin) / abs(end - begin)


def circle_through(a: complex, b: complex, c: complex) -> complex:
    """The centre of the circle through three places: where two perpendicular bisectors meet.

    >>> circle_through(0j, 4 + 0j, 4 + 2j)
    (2+1j)
    """
    return lines_meet((a + b) / 2, 1j * (b - a), (b + c) / 2, 1j * (c - b))


def mirrored(z: complex, at: complex, direction: complex) -> complex:
    """The mirror image in the line through a place."""
    return at + direction / direction.conjugate() * (z - at).conjugate()


def parallel(z: complex, begin: complex, end: complex) -> complex:
    """The place shifted by the vector between two others."""
    return z + end - begin


def turned_angle(begin: complex, end: complex) -> float:
    """The angle by which one vector is turned into another, between -pi and pi."""
    return cmath.phase(end / begin)


def degrees_between(begin: complex, end: complex) -> float:
    """The angle between two vectors in degrees, without sign.

    >>> degrees_between(1 + 0j, 1j)
    90.0
    """
    return abs(math.degrees(turned_angle(begin, end)))
