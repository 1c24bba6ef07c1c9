"""The mass of a link: how much, where its centre lies, how it resists turning."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np

from gruebler.base.arrays import Complexes, cross_product
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.immutable import settle
from gruebler.base.text import message
from gruebler.base.units import metres_of

Place = tuple[float, float]

_NAMES = {
    "mass": message("the mass"),
    "inertia": message("the moment of inertia"),
    "density": message("the density"),
    "radius": message("the radius"),
}


@door_that_raises(LinkageError)
@dataclass(frozen=True)
class RigidBody:
    """Mass (kg), centre of mass in the link's coordinates, moment of inertia about it (kg times the unit squared).

    >>> RigidBody.bar(2.0, (0, 0), (60, 0))
    RigidBody(mass=2.0, centre=(30.0, 0.0), inertia=600.0)
    >>> RigidBody(1.0, (10, 0)) + RigidBody(1.0, (30, 0))  # two points: 2 · 10² about their centre
    RigidBody(mass=2.0, centre=(20.0, 0.0), inertia=200.0)

    See Also:
        `Loads`, `inverse_dynamics`

    Theory:
        docs/theory/dynamics.md
    """

    mass: float
    centre: Place = (0.0, 0.0)
    inertia: float = 0.0

    def __post_init__(self) -> None:
        for name in ("mass", "inertia"):
            value = getattr(self, name)
            if not 0 <= value < 1e100:
                raise LinkageError(
                    "{name} must be a finite number that is not negative, not {value!r}", name=_NAMES[name], value=value
                )
            settle(self, **{name: float(value)})
        if not all(map(isfinite, self.centre)):
            raise LinkageError("the centre of mass has finite coordinates, not {value!r}", value=self.centre)
        settle(self, centre=(float(self.centre[0]), float(self.centre[1])))

    @classmethod
    @door_that_raises(LinkageError)
    def about(cls, place: Place, mass: float, centre: Place, inertia: float) -> RigidBody:
        """The body whose moment of inertia is known about a place, such as the pin on which it was swung.

        Raises `LinkageError` for an inertia smaller than the mass at its centre would have.

        >>> RigidBody.about((0, 0), 2.0, (30, 0), 2400.0)
        RigidBody(mass=2.0, centre=(30.0, 0.0), inertia=600.0)
        """
        cls(mass, centre, max(inertia, 0.0))
        least = mass * abs(complex(*centre) - complex(*place)) ** 2
        if not least <= inertia * (1 + 1e-12):
            raise LinkageError(
                "about {place} the moment of inertia is at least mass times distance squared, {least:g}, not "
                "{inertia:g}",
                place=f"({place[0]:g}, {place[1]:g})",
                least=least,
                inertia=inertia,
            )
        return cls(mass, centre, max(inertia - least, 0.0))

    @classmethod
    @door_that_raises(LinkageError)
    def bar(cls, mass: float, start: Place, end: Place) -> RigidBody:
        """A thin rod of even mass between two places."""
        along = complex(*end) - complex(*start)
        return cls(mass, ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2), mass * abs(along) ** 2 / 12)

    @classmethod
    @door_that_raises(LinkageError)
    def disc(cls, mass: float, radius: float, *, centre: Place = (0.0, 0.0)) -> RigidBody:
        """A disc of even thickness.

        >>> RigidBody.disc(2.0, 10.0).inertia
        100.0
        """
        if not 0 <= radius < 1e100:
            raise LinkageError(
                "{name} must be a finite number that is not negative, not {value!r}",
                name=_NAMES["radius"],
                value=radius,
            )
        return cls(mass, centre, mass * radius**2 / 2)

    @classmethod
    @door_that_raises(LinkageError)
    def plate(cls, outline: Sequence[Place], thickness: float, density: float, *, unit: str = "mm") -> RigidBody:
        """A plate of even thickness with straight edges; either sense of the outline.

        Args:
            outline: Its corners in order, in the linkage's unit.
            thickness: In the linkage's unit.
            density: In kg for each cubic metre: steel has 7850.
            unit: The linkage's unit.

        >>> RigidBody.plate([(0, 0), (30, 0), (30, 20), (0, 20)], 10, 7850.0)
        RigidBody(mass=0.0471, centre=(15.0, 10.0), inertia=5.1025)
        """
        if not (0 < thickness < 1e100 and 0 < density < 1e100):
            raise LinkageError(
                "a plate has a positive thickness and density, not {t!r} and {d!r}", t=thickness, d=density
            )
        area, centre, inertia = _polygon(outline)
        mass = density * area * thickness * metres_of(unit) ** 3
        return cls(mass, (centre.real, centre.imag), mass * inertia)

    def __add__(self, other: RigidBody) -> RigidBody:
        """Both bodies as one."""
        if not isinstance(other, RigidBody):
            return NotImplemented
        mass = self.mass + other.mass
        if not mass:
            return RigidBody(0.0, self.centre, self.inertia + other.inertia)
        apart = complex(*self.centre) - complex(*other.centre)
        centre = (self.mass * complex(*self.centre) + other.mass * complex(*other.centre)) / mass
        inertia = self.inertia + other.inertia + self.mass * other.mass / mass * abs(apart) ** 2
        return RigidBody(mass, (centre.real, centre.imag), inertia)


def _crossing(corners: Complexes) -> tuple[int, int] | None:
    """Two edges, from 1, that cross; edges that only touch, as at the way to a hole, do not."""
    ends = np.roll(corners, -1)
    least = 1e-12 * float(np.abs(corners).max()) ** 2
    for k, (start, end) in enumerate(zip(corners, ends, strict=True)):
        sides = cross_product(end - start, corners - start)
        others = [cross_product(ends - corners, place - corners) for place in (start, end)]
        pairs = np.array([[sides, np.roll(sides, -1)], others])
        across = (pairs.prod(axis=1) < 0).all(axis=0) & (np.abs(pairs).min(axis=(0, 1)) > least)
        if across.any():
            return k + 1, int(across.argmax()) + 1
    return None


def _polygon(outline: Sequence[Place]) -> tuple[float, complex, float]:
    """Area, centre, and the polar moment of area about it by the area (radius of gyration squared)."""
    corners = np.array([complex(*corner) for corner in outline])
    if len(corners) < 3 or not np.isfinite(corners).all():
        raise LinkageError("an outline has three corners or more, with finite coordinates")
    origin = corners.mean()
    a = corners - origin
    b = np.roll(a, -1)
    cross = cross_product(a, b)
    area = float(cross.sum() / 2)
    if not abs(area) > 1e-12 * float(np.abs(a).max()) ** 2:
        raise LinkageError("the outline of a plate surrounds no area")
    if (crossed := _crossing(a)) is not None:
        raise LinkageError(
            "the outline of a plate crosses itself: edges {one} and {other}", one=crossed[0], other=crossed[1]
        )
    centre = complex((cross * (a + b)).sum() / (6 * area))
    polar = float((cross * (np.abs(a) ** 2 + (np.conj(a) * b).real + np.abs(b) ** 2)).sum() / 12) / area
    return abs(area), complex(origin) + centre, polar - abs(centre) ** 2
