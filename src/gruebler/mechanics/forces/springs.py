"""Springs and dampers between two points, or between two links that turn."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any, Protocol

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.mechanics.linkages.points import Dimensioned, PointLike, place_of, point_name


class Characteristic(Protocol):
    """The force of a spring over its length, or the moment over its angle: `Curve`, `Gas`."""

    def value(self, at: Any) -> Reals:
        """The tension, or the moment that draws the angle back."""

    def area(self, at: Any) -> Reals:
        """Its integral: the energy, up to a constant."""


@door_that_raises(LinkageError)
@dataclass(frozen=True, kw_only=True)
class Gas:
    """A gas spring: the force when extended, and how it grows to the end of its stroke, at even temperature.

    >>> lift = Gas(force=400.0, extended=500.0, stroke=200.0, growth=1.25)
    >>> lift.value(np.array([500.0, 300.0])).round(9).tolist()  # it pushes
    [-400.0, -500.0]

    See Also:
        `Spring`, `TorsionSpring`, `Loads`

    Theory:
        docs/theory/dynamics.md
    """

    force: float
    extended: float
    """The length when extended."""
    stroke: float
    growth: float = 1.3
    """The force at the end of the stroke by that when extended; 1.2 to 1.5 in practice."""

    def __post_init__(self) -> None:
        if not (0 < self.force < 1e100 and 0 < self.stroke < self.extended < 1e100 and 1 < self.growth < 100):
            raise LinkageError(
                "a gas spring has a positive force, a stroke shorter than its extended length, and a force that grows "
                "by a factor above 1"
            )

    @property
    def column(self) -> float:
        """The stroke after which no gas would be left."""
        return self.stroke / (1 - 1 / self.growth)

    def value(self, at: Any) -> Reals:
        """The tension: negative, since it pushes."""
        with np.errstate(divide="ignore"):
            return np.asarray(-self.force / (1 - (self.extended - np.asarray(at)) / self.column))

    def area(self, at: Any) -> Reals:
        """The energy: 0 when extended."""
        with np.errstate(divide="ignore", invalid="ignore"):
            left = 1 - (self.extended - np.asarray(at)) / self.column
            return np.asarray(-self.force * self.column * np.log(left))


@door_that_raises(LinkageError)
@dataclass(frozen=True)
class Spring:
    """A spring, or a damper, between two points: it pulls with preload + stiffness (length - free length) + ...

    >>> Spring(("frame:0,40", "K"), stiffness=2.0, free_length=30.0, preload=5.0).tension(32.0, 0.0).item()
    9.0

    See Also:
        `TorsionSpring`, `Gas`, `Loads`

    Theory:
        docs/theory/dynamics.md
    """

    between: tuple[PointLike, PointLike]
    """Points of two different links, as `Linkage.points_named` takes them."""
    _: KW_ONLY
    stiffness: float = 0.0
    """Force by the linkage's unit."""
    free_length: float = 0.0
    """At which only the preload pulls; 0 makes the ideal spring of static balance."""
    preload: float = 0.0
    """The pull at the free length."""
    damping: float = 0.0
    """Force by speed."""
    law: Characteristic | None = None
    """A further force over the length."""

    def __post_init__(self) -> None:
        _check(message("a spring"), stiffness=self.stiffness, free_length=self.free_length, damping=self.damping)
        if not abs(self.preload) < 1e100:
            raise LinkageError("the preload of a spring is a finite number, not {value!r}", value=self.preload)

    def tension(self, length: Any, rate: Any) -> Reals:
        """The pull at lengths that grow at rates."""
        pull = self.preload + self.stiffness * (np.asarray(length) - self.free_length) + self.damping * np.asarray(rate)
        return np.asarray(pull if self.law is None else pull + self.law.value(length))

    def energy(self, length: Any) -> Reals:
        """What is stored at lengths."""
        drawn = np.asarray(length) - self.free_length
        stored = self.preload * drawn + self.stiffness * drawn**2 / 2
        return np.asarray(stored if self.law is None else stored + self.law.area(length))


@door_that_raises(LinkageError)
@dataclass(frozen=True)
class TorsionSpring:
    """A torsion spring, or damper, between two links: it draws their angle back to its free one.

    >>> TorsionSpring(("frame", "crank"), stiffness=10.0, free_angle=0.5).moment(np.array([0.7]), 0.0).round(9).tolist()
    [2.0]

    See Also:
        `Spring`, `Loads`

    Theory:
        docs/theory/dynamics.md
    """

    between: tuple[str, str]
    """Two links; the angle is that of the second against the first."""
    _: KW_ONLY
    stiffness: float = 0.0
    """Moment by radian."""
    free_angle: float = 0.0
    """Radians."""
    preload: float = 0.0
    """The moment at the free angle."""
    damping: float = 0.0
    """Moment by angular velocity."""
    law: Characteristic | None = None
    """A further moment over the angle."""

    def __post_init__(self) -> None:
        _check(message("a torsion spring"), stiffness=self.stiffness, damping=self.damping)
        if self.between[0] == self.between[1]:
            raise LinkageError(
                "a torsion spring is between two links, not from {link!r} to itself", link=self.between[0]
            )
        for value in (self.free_angle, self.preload):
            if not abs(value) < 1e100:
                raise LinkageError(
                    "angle and preload of a torsion spring are finite numbers, not {value!r}", value=value
                )

    def moment(self, angle: Any, rate: Any) -> Reals:
        """The moment that draws back, at angles that grow at rates."""
        moment = self.preload + self.stiffness * (np.asarray(angle) - self.free_angle) + self.damping * np.asarray(rate)
        return np.asarray(moment if self.law is None else moment + self.law.value(angle))

    def energy(self, angle: Any) -> Reals:
        """What is stored at angles."""
        drawn = np.asarray(angle) - self.free_angle
        stored = self.preload * drawn + self.stiffness * drawn**2 / 2
        return np.asarray(stored if self.law is None else stored + self.law.area(angle))


def check_between_links(linkage: Dimensioned, spring: Spring, where: str) -> None:
    """Refuse a spring whose ends are points of one link: it does nothing. `LinkageError` begins with ``where``."""
    first, second = (_links_at(linkage, end) for end in spring.between)
    shared = next((link for link in first if link in second), None)
    if shared is not None:
        raise LinkageError(
            "{where}: {one!r} and {other!r} are points of one link, {link!r}; a spring or damper is between two links",
            where=where,
            one=point_name(spring.between[0]),
            other=point_name(spring.between[1]),
            link=shared,
        )


def _links_at(linkage: Dimensioned, end: PointLike) -> tuple[str, ...]:
    """The links that a point belongs to: both of a turning joint."""
    chain = linkage.mechanism.chain
    number = chain.find_joint(end) if isinstance(end, str) and end not in linkage.points else None
    if number is not None and chain.joints[number].pair.is_turning:
        return chain.joints[number].links
    return (place_of(linkage, end).link,)


_NAMES = {"stiffness": message("stiffness"), "free_length": message("free length"), "damping": message("damping")}


def _check(what: Message, **numbers: float) -> None:
    for name, value in numbers.items():
        if not 0 <= value < 1e100:
            raise LinkageError(
                "the {name} of {what} is a finite number that is not negative, not {value!r}",
                name=_NAMES[name],
                what=what,
                value=value,
            )
