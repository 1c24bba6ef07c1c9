"""Where a joint lies in the reference pose: its point, its axes, and what else its pair needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, fields
from math import hypot, inf, isfinite

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import joined_by_and, joined_by_or
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.chain.spaces import Space

Vector = tuple[float, float, float]

_SQUARE = 1e-9  # axes that should be at right angles may miss it by so much


@dataclass(frozen=True, slots=True)
class JointPlace:
    """A joint in the reference pose, in coordinates common to all links.

    Attributes:
        at: a point of the joint: of its axis, the centre of a ball, the point of contact. On a sphere its centre.
        x, y, z: those axes of the joint that its pair needs, as in the table of pairs; of any length.
        pitch: of a screw, the way along z for a radian of turning; right-handed if positive.
        radii: of round contacts, the first link's and the second's. The y axis goes from the first centre to the
            second; a contour that the other touches from inside has a negative radius, a flat one ``inf``, a pin in
            a slot 0. On a sphere the angles of the cones.
        pressure: of gear teeth the pressure angle, the radii being those of the pitch circles. None: the contours
            themselves touch.
    """

    at: Vector = (0.0, 0.0, 0.0)
    _: KW_ONLY
    x: Vector | None = None
    y: Vector | None = None
    z: Vector | None = None
    pitch: float = 0.0
    radii: tuple[float, float] | None = None
    pressure: float | None = None


def read_place(raw: object, pair: Pair, space: Space, where: str) -> JointPlace:
    """The place that a mapping or a point stands for, checked for a pair; `LinkageError` says what is needed."""
    if isinstance(raw, JointPlace):
        given = {f.name: getattr(raw, f.name) for f in fields(raw)}
    elif isinstance(raw, Mapping):
        given = dict(raw)
    else:
        given = {"at": raw}
    known = [f.name for f in fields(JointPlace)]
    for key in given:
        if key not in known:
            raise LinkageError(
                "{where}: unknown key {key!r}; the keys are {known}", where=where, key=key, known=", ".join(known)
            )
    given = {key: value for key, value in given.items() if value is not None}
    joint_place = JointPlace(
        _vector(given.get("at", (0.0, 0.0, 0.0)), space, f"{where}, at"),
        x=_direction(given.get("x"), space, f"{where}, x"),
        y=_direction(given.get("y"), space, f"{where}, y"),
        z=_direction(given.get("z"), Space.SPATIAL, f"{where}, z"),
        pitch=_number(given.get("pitch", 0.0), f"{where}, pitch"),
        radii=_radii(given.get("radii"), f"{where}, radii"),
        pressure=None if "pressure" not in given else _number(given["pressure"], f"{where}, pressure"),
    )
    _fitting(joint_place, pair, space, where)
    return joint_place


def _fitting(place: JointPlace, pair: Pair, space: Space, where: str) -> None:
    needed = pair.axes[space]
    present = "".join(axis for axis in "xyz" if getattr(place, axis) is not None)
    turned = space is Space.PLANAR and bool(set(present) & set("xy"))
    enough = needed in present or turned if len(needed) < 2 else len(present) >= 2
    if not enough:
        raise LinkageError(
            "{where}: a {pair} joint needs its {needed} axis",
            where=where,
            pair=pair.title,
            needed=joined_by_and(needed),
        )
    joint_axes(place, space, where)
    if space is Space.SPHERICAL and any(place.at):
        raise LinkageError("{where}: on a sphere every joint is at its centre, the origin", where=where)
    if place.pitch and not pair.has_pitch:
        raise LinkageError("{where}: a {pair} joint has no pitch", where=where, pair=pair.title)
    if not pair.has_contours:
        if place.radii is not None or place.pressure is not None:
            raise LinkageError(
                "{where}: a {pair} joint has no radii and no pressure angle", where=where, pair=pair.title
            )
        return
    if place.radii is None:
        raise LinkageError(
            "{where}: a {pair} joint needs the two radii of its contact, inf for a flat one",
            where=where,
            pair=pair.title,
        )
    _check_contact(place, pair, space, where)


def _check_contact(place: JointPlace, pair: Pair, space: Space, where: str) -> None:
    assert place.radii is not None
    first, second = place.radii
    if first + second == 0 or first == second == inf:
        raise LinkageError(
            "{where}: contours with the radii {first:g} and {second:g} touch all along, not in a point",
            where=where,
            first=first,
            second=second,
        )
    toothed = pair.rolls or place.pressure is not None
    if toothed and not isfinite(first + second):
        raise LinkageError(
            "{where}: wheels that roll on each other need finite radii, not {first:g} and {second:g}",
            where=where,
            first=first,
            second=second,
        )
    if place.pressure is not None and (pair.rolls or not abs(place.pressure) < 1.5):
        raise LinkageError(
            "{where}: a pressure angle, below 1.5 radians, is for the teeth of a roll_slide joint", where=where
        )
    if space is Space.SPHERICAL and not all(0 < abs(r) < np.pi for r in place.radii):
        raise LinkageError("{where}: on a sphere the radii are angles of cones between 0 and pi", where=where)


def joint_axes(place: JointPlace, space: Space, where: str = "joint") -> Reals:
    """The axes as columns of a rotation; those that are not given are chosen to complete it.

    >>> joint_axes(JointPlace(x=(0, 2, 0)), Space.PLANAR).tolist()
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    given = {k: np.array(v) / hypot(*v) for k, axis in enumerate("xyz") if (v := getattr(place, axis)) is not None}
    if space is Space.PLANAR:
        given[2] = np.array([0.0, 0.0, 1.0])
    if not given:
        return np.eye(3)
    if len(given) == 1:
        ((k, axis),) = given.items()
        other = np.eye(3)[int(np.argmin(abs(axis)))]
        aside = other - (other @ axis) * axis
        given[(k + 1) % 3] = aside / np.linalg.norm(aside)
    missing = next((k for k in range(3) if k not in given), None)
    if missing is not None:
        given[missing] = np.cross(given[(missing + 1) % 3], given[(missing + 2) % 3])
    axes = np.stack([given[k] for k in range(3)], axis=1)
    if abs(axes.T @ axes - np.eye(3)).max() > _SQUARE or np.linalg.det(axes) < 0:
        raise LinkageError(
            "{where}: the axes x, y, z of a joint are at right angles, in right-handed order", where=where
        )
    return axes


def _numbers(raw: object, where: str, counts: tuple[int, ...]) -> tuple[float, ...]:
    if isinstance(raw, str) or not isinstance(raw, Sequence | np.ndarray) or len(raw) not in counts:
        raise LinkageError(
            "{where}: expected {counts} numbers, but found {found!r}",
            where=where,
            counts=joined_by_or(counts),
            found=str(raw)[:40],
        )
    return tuple(_number(value, where) for value in raw)


def _number(value: object, where: str, greatest: float = 1e100) -> float:
    fits = isinstance(value, int | float | np.number) and not isinstance(value, bool)
    if not fits or not abs(float(value)) <= greatest:  # type: ignore[arg-type]
        raise LinkageError(
            "{where}: expected a number below 1e100, but found {found!r}", where=where, found=str(value)[:40]
        )
    return float(value)  # type: ignore[arg-type]


def _vector(raw: object, space: Space, where: str) -> Vector:
    counts = (2, 3) if space is Space.PLANAR else (3,)
    x, y, *rest = _numbers(raw, where, counts)
    if space is Space.PLANAR and any(rest):
        raise LinkageError("{where}: a plane has two coordinates; the third is 0", where=where)
    return x, y, rest[0] if rest else 0.0


def _direction(raw: object, space: Space, where: str) -> Vector | None:
    if raw is None:
        return None
    vector = _vector(raw, space, where)
    if not hypot(*vector) > 0:
        raise LinkageError("{where}: a direction is not zero", where=where)
    return vector


def _radii(raw: object, where: str) -> tuple[float, float] | None:
    if raw is None:
        return None
    if isinstance(raw, str) or not isinstance(raw, Sequence | np.ndarray) or len(raw) != 2:
        raise LinkageError("{where}: expected two numbers, but found {found!r}", where=where, found=str(raw)[:40])
    first, second = (_number(value, where, inf) for value in raw)
    return first, second
