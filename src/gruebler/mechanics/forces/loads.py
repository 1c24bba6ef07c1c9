"""Loads on a linkage: forces at points, moments on links, weights."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError, nearest
from gruebler.base.text import Message, message
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import LinkPoint
from gruebler.mechanics.linkages.points import PointLike, place_of, point_name

Rows = NDArray[np.int64]

_STANDARD = 9.80665


@door_that_raises(LinkageError)
@dataclass(frozen=True)
class Loads:
    """What acts on a linkage from outside, in coordinates of the plane.

    A force at a joint acts on the link of that joint that `Motion.point` looks at; to choose the link give a
    `LinkPoint`.

    >>> Loads(forces={"K": (0, -100)}, moments={"rocker": 5}).moments
    {'rocker': 5}
    """

    forces: Mapping[PointLike, ArrayLike] = field(default_factory=dict)
    """By point or joint: (x, y), or one for each row, (rows, 2)."""
    moments: Mapping[str, ArrayLike] = field(default_factory=dict)
    """By link, counter-clockwise, in force times the linkage's unit: a number, or (rows,)."""
    _: KW_ONLY
    masses: Mapping[PointLike, ArrayLike] = field(default_factory=dict)
    """By point or joint: each weighs its mass times ``gravity``."""
    gravity: tuple[float, float] = (0.0, -_STANDARD)
    """Force for each unit of mass: metres a second squared for kilograms and newtons."""


@compared_by_value
@dataclass(frozen=True, eq=False)
class Wrench:
    """A force on a link at each row, and a moment beside it."""

    place: LinkPoint
    force: Complexes
    """(rows,)."""
    moment: Reals
    """(rows,): a free moment."""


def loads_over_rows(motion: Motion, loads: Loads) -> tuple[Wrench, ...]:
    """The loads over the rows of a motion.

    Raises `LinkageError` for a point or link that is not there and for numbers that are not finite.
    """
    wrenches = []
    none = np.zeros(len(motion))
    for name, given in loads.forces.items():
        force = _over_rows(message("the force at {point}", point=_point_text(name)), given, (len(motion), 2))
        wrenches.append(Wrench(_place(motion, name), np.ascontiguousarray(force).view(np.complex128)[:, 0], none))
    gravity = _over_rows(message("gravity"), loads.gravity, (2,))
    for name, given in loads.masses.items():
        mass = _over_rows(message("the mass at {point}", point=_point_text(name)), given, (len(motion),))
        if (mass < 0).any():
            raise LinkageError("the mass at {point} is negative: {mass:g}", point=_point_text(name), mass=mass.min())
        wrenches.append(Wrench(_place(motion, name), (mass * complex(*gravity)).astype(np.complex128), none))
    links = motion.linkage.mechanism.chain.links
    for link, given in loads.moments.items():
        if link not in links:
            raise LinkageError(
                "a moment acts on a link, but there is no link {link!r}{suggestion}; the links are {links}",
                link=link,
                suggestion=nearest(str(link), links),
                links=", ".join(links),
            )
        moment = _over_rows(message("the moment on {link!r}", link=link), given, (len(motion),))
        wrenches.append(Wrench(LinkPoint(link, 0.0, 0.0), np.zeros(len(motion), np.complex128), moment))
    return tuple(wrenches)


def _place(motion: Motion, name: PointLike) -> LinkPoint:
    place = place_of(motion.linkage, name)
    links = motion.linkage.mechanism.chain.links
    if place.link not in links:
        raise LinkageError(
            "a force acts on a link, but there is no link {link!r}; they are {links}",
            link=place.link,
            links=", ".join(links),
        )
    return place


def _point_text(name: PointLike) -> Message:
    return message("{name!r}", name=point_name(name))


def _over_rows(what: Message, given: ArrayLike, shape: tuple[int, ...]) -> Reals:
    each_row = len(shape) == 1
    wanted = message("one number for each row" if each_row else "x and y, for each row if they change")
    try:
        numbers = np.asarray(given, np.float64)
        values: Reals = np.broadcast_to(numbers, shape)
    except (TypeError, ValueError):
        raise LinkageError(
            "{what}: expected {wanted}, but found {given!r}", what=what, wanted=wanted, given=given
        ) from None
    if numbers.ndim == 0 and len(shape) == 2:
        raise LinkageError("{what}: expected {wanted}, but found {given!r}", what=what, wanted=wanted, given=given)
    if not (np.abs(numbers) < 1e100).all():
        raise LinkageError("{what}: expected finite numbers, but found {given!r}", what=what, given=given)
    return values
