"""Round bodies of links in space, such as a wheel of a car: for pictures only, they change no motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import hypot, inf, isfinite
from typing import Any, final

from gruebler.base.errors import LinkageError
from gruebler.mechanics.linkages.points import link_number
from gruebler.mechanics.screws.joint_places import Vector


@final
@dataclass(frozen=True, kw_only=True)
class TurnedBody:
    """A cylinder on a link, in the reference pose.

    >>> TurnedBody(link="knuckle", at=(760, 0, 320), z=(1, 0, 0), radius=320, length=200).radius
    320
    """

    link: str
    at: Vector
    """Its middle."""
    z: Vector
    """Its axis, of any length."""
    radius: float
    length: float
    """Along the axis."""


def read_bodies(given: Mapping[str, TurnedBody | Mapping[str, Any]], links: tuple[str, ...]) -> dict[str, TurnedBody]:
    """Bodies by their names; `LinkageError` names the first that does not fit.

    >>> read_bodies({"wheel": {"link": "0", "at": (0, 0), "z": (0, 0, 1), "radius": 3, "length": 1}}, ("0", "1"))
    Traceback (most recent call last):
    gruebler.base.errors.LinkageError: wheel: at: expected three finite numbers, but found (0, 0)
    """
    bodies = {}
    for name, raw in given.items():
        body = raw if isinstance(raw, TurnedBody) else _read(name, raw)
        link_number(body.link, links)
        for key in ("radius", "length"):
            value = getattr(body, key)
            if isinstance(value, bool) or not isinstance(value, int | float) or not 0 < value < inf:
                raise LinkageError(
                    "{name}: {key}: expected a positive number, but found {value!r}", name=name, key=key, value=value
                )
        at, z = _three(name, "at", body.at), _three(name, "z", body.z)
        if hypot(*z) == 0:
            raise LinkageError("{name}: z: expected a direction, but found {value!r}", name=name, value=body.z)
        bodies[name] = TurnedBody(link=body.link, at=at, z=z, radius=float(body.radius), length=float(body.length))
    return bodies


def _read(name: str, raw: Mapping[str, Any]) -> TurnedBody:
    wanted = ("link", "at", "z", "radius", "length")
    if set(raw) != set(wanted):
        raise LinkageError("{name}: expected the keys {keys}", name=name, keys=", ".join(wanted))
    return TurnedBody(**raw)


def _three(name: str, key: str, value: Any) -> Vector:
    numbers = [float(x) for x in value if isinstance(x, int | float) and isfinite(x)]
    if len(numbers) != 3 or len(value) != 3:
        raise LinkageError(
            "{name}: {key}: expected three finite numbers, but found {value!r}", name=name, key=key, value=value
        )
    return numbers[0], numbers[1], numbers[2]
