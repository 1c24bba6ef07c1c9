"""The closing conditions of a pair, as functions of the second link's joint frame seen from the first link's.

Let E be that 4 x 4 matrix, the identity in the reference pose. A row is a function of E that is zero on the motions of
the pair and has, in the reference pose, independent differentials with the others: u rows for u motions taken away.
Most rows are linear in E:

- a shift along d taken away: the component d of the translation;
- all turns taken away: the skew part of the rotation; all but the turn about d: d keeps its direction; the turn about
  one axis only: the first link's u axis stays at right angles to the second's v axis, u and v being the free turns.

Screws, crossed cylinders and round contacts have rows of their own.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, inf, sin, tan
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.joint_places import JointPlace
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.chain.spaces import Freedom, Space

_PARALLEL = 1e-9  # the sine of the angle of axes

Bent = Callable[[Reals], tuple[float, Reals]]
"""From E to the value of a row and its derivatives by the entries of E, (4, 4)."""
Row = Reals | Bent
"""Weights (4, 4) of the entries of E, or a function."""


class WheelAxes(NamedTuple):
    """Axes of two wheels in space in the frame of their contact, point and direction (2, 3); speeds of teeth."""

    first: Reals
    second: Reals
    first_speed: float
    second_speed: float


def joint_rows(pair: Pair, space: Space, place: JointPlace, wheels: WheelAxes | None = None) -> list[Row]:
    """The rows of a joint, u of them."""
    free = pair.freedoms[space]
    if wheels is not None:
        return [_mesh(wheels)]
    if pair.has_contours and space is not Space.SPATIAL:
        on_sphere = space is Space.SPHERICAL
        touch, arcs = (_cone_touch, _cone_arcs) if on_sphere else (_touch, _arcs)
        if pair.rolls:
            return [touch(*_radii(place)), arcs(*_radii(place))]
        return [_cone_contact(place) if on_sphere else _contact(place)]
    rows: list[Row] = _turns([freedom.axis for freedom in free if freedom.turns], space)
    for direction in space.directions:
        if direction.travels and direction not in free:
            rows.append(_shift(direction, pair, place))
    return rows


def _radii(place: JointPlace) -> tuple[float, float]:
    assert place.radii is not None
    return place.radii


def _entry(i: int, j: int, weight: float = 1.0) -> Reals:
    gradient = np.zeros((4, 4))
    gradient[i, j] = weight
    return gradient


def _turns(free: list[str], space: Space) -> list[Row]:
    """The rows that take turns away; ``free`` are the axes about which turning stays possible."""
    turning = [direction.axis for direction in space.directions if direction.turns]
    taken = [axis for axis in turning if axis not in free]
    place = "xyz".index
    if len(free) == 1:
        return [_entry(place(axis), place(free[0])) for axis in taken]
    if len(free) == 2:
        return [_entry(place(free[0]), place(free[1]))]
    rows: list[Row] = []
    for axis in taken:
        i, j = (place(axis) + 1) % 3, (place(axis) + 2) % 3
        rows.append(_entry(j, i, 0.5) - _entry(i, j, 0.5))
    return rows


def _shift(direction: Freedom, pair: Pair, place: JointPlace) -> Row:
    """The row that takes a shift away."""
    if any(freedom.has_pitch and freedom.travel == direction for freedom in pair.motion):
        return _screw(place.pitch)
    if pair.has_body_between:
        return _crossed
    if pair.has_contours and direction is Freedom.TRAVEL_Y:
        return _contact(place)
    return _entry("xyz".index(direction.axis), 3)


def _screw(pitch: float) -> Bent:
    def row(e: Reals) -> tuple[float, Reals]:
        c, s = e[0, 0], e[1, 0]
        gradient = _entry(2, 3)
        gradient[1, 0], gradient[0, 0] = -pitch * c / (c * c + s * s), pitch * s / (c * c + s * s)
        gap = float(e[2, 3] - pitch * np.arctan2(s, c))
        lead = 2 * np.pi * pitch
        return gap - (lead * round(gap / lead) if lead else 0.0), gradient  # whole turns more are the same position

    return row


def _crossed(e: Reals) -> tuple[float, Reals]:
    """The distance of the first link's x axis from the second's y axis: p · (x × R y)."""
    gradient = np.zeros((4, 4))
    gradient[1, 3], gradient[2, 3] = -e[2, 1], e[1, 1]
    gradient[2, 1], gradient[1, 1] = -e[1, 3], e[2, 3]
    return float(e[2, 3] * e[1, 1] - e[1, 3] * e[2, 1]), gradient


# --- round contacts in a plane: y goes from the first centre (0, -r) to the second (0, s) --------------------------


def _contact(place: JointPlace) -> Row:
    first, second = _radii(place)
    return _touch(first, second) if place.pressure is None else _arcs(first, second, place.pressure)


def _touch(r: float, s: float) -> Bent:
    """The distance of two contours along their common normal."""
    if inf in (r, s):
        return _touch_flat(r, s)
    centre = np.array([0.0, s, 0.0, 1.0])

    def row(e: Reals) -> tuple[float, Reals]:
        between = (e @ centre)[:2] + np.array([0.0, r])
        distance = float(np.hypot(*between))
        gradient = np.zeros((4, 4))
        gradient[:2] = np.outer(between / distance, centre)
        return distance - abs(r + s), gradient

    return row


def _touch_flat(r: float, s: float) -> Bent:
    def on_first(e: Reals) -> tuple[float, Reals]:
        return float(e[1, 1] * s + e[1, 3] - s), _entry(1, 1, s) + _entry(1, 3)

    def on_second(e: Reals) -> tuple[float, Reals]:
        between = np.array([0.0, -r]) - e[:2, 3]
        gradient = np.zeros((4, 4))
        gradient[:2, 1], gradient[:2, 3] = between, -e[:2, 1]
        return float(e[:2, 1] @ between + r), gradient

    return on_first if r == inf else on_second


def _arcs(r: float, s: float, pressure: float = 0.0) -> Bent:
    """The way by which two pitch circles, or the base circles of involute teeth, have slipped on each other."""
    centre, sign = np.array([0.0, s, 0.0, 1.0]), np.sign(r + s)
    base = abs(r + s) * cos(pressure)

    def row(e: Reals) -> tuple[float, Reals]:
        u = sign * ((e @ centre)[:2] + np.array([0.0, r]))
        w = e[:2, :2].T @ u
        square = float(u @ u)
        value = cos(pressure) * (r * np.arctan2(u[0], u[1]) + s * np.arctan2(w[0], w[1]))
        from_u = cos(pressure) * np.array([u[1], -u[0]]) / square
        from_w = cos(pressure) * np.array([w[1], -w[0]]) / square
        by_u = r * from_u + s * (e[:2, :2] @ from_w)
        if pressure:
            angle = np.arccos(min(1.0, base / square**0.5)) * np.sign(pressure)
            value += base * ((tan(angle) - angle) - (tan(pressure) - pressure))
            by_u = by_u + sin(angle) * base / (cos(angle) * square) * u
        gradient = np.zeros((4, 4))
        gradient[:2] = sign * np.outer(by_u, centre)
        gradient[:2, :2] += s * np.outer(u, from_w)
        return float(value), gradient

    return row


def _mesh(wheels: WheelAxes) -> Bent:
    """By how much the teeth of two wheels have slipped: each axis shows how far the other wheel has turned.

    Seen from a wheel that turns by an angle about its axis the other axis turns back by it.
    """
    (start, along), (end, across) = wheels.first, wheels.second
    aside = end - start - ((end - start) @ along) * along
    crossed = bool(np.linalg.norm(np.cross(along, across)) > _PARALLEL)
    mark = across - (across @ along) * along if crossed else aside
    back = along - (along @ across) * across if crossed else (aside @ across) * across - aside
    q, s = mark / np.linalg.norm(mark), back / np.linalg.norm(back)
    p, r = np.cross(along, q), np.cross(across, s)

    def row(e: Reals) -> tuple[float, Reals]:
        turn, gradient = e[:3, :3], np.zeros((4, 4))
        m = turn @ across if crossed else turn @ end + e[:3, 3] - start
        n = turn.T @ along if crossed else turn.T @ (start - e[:3, 3]) - end
        a, b, c, d = p @ m, q @ m, r @ n, s @ n
        by_m = -wheels.first_speed * (b * p - a * q) / (a * a + b * b)
        by_n = wheels.second_speed * (d * r - c * s) / (c * c + d * d)
        gradient[:3, :3] = np.outer(by_m, across if crossed else end)
        gradient[:3, :3] += np.outer(along if crossed else start - e[:3, 3], by_n)
        if not crossed:
            gradient[:3, 3] = by_m - turn @ by_n
        return float(wheels.second_speed * np.arctan2(c, d) - wheels.first_speed * np.arctan2(a, b)), gradient

    return row


# --- cones on a sphere: z is the ray of contact, y goes from the first axis to the second ----------------------------


def _cones(r: float, s: float) -> tuple[Reals, Reals]:
    return np.array([0.0, -sin(r), cos(r)]), np.array([0.0, sin(s), cos(s)])


def _cone_contact(place: JointPlace) -> Row:
    return _cone_touch(*_radii(place)) if place.pressure is None else _cone_arcs(*_radii(place))


def _cone_touch(r: float, s: float) -> Bent:
    first, second = _cones(r, s)

    def row(e: Reals) -> tuple[float, Reals]:
        gradient = np.zeros((4, 4))
        gradient[:3, :3] = -np.outer(first, second) / sin(r + s)
        return float(cos(r + s) - first @ e[:3, :3] @ second) / sin(r + s), gradient

    return row


def _cone_arcs(r: float, s: float) -> Bent:
    first, second = _cones(r, s)
    x = np.array([1.0, 0.0, 0.0])
    ahead, back = np.array([0.0, cos(r), sin(r)]), np.array([0.0, -cos(s), sin(s)])
    sign = np.sign(sin(r + s))

    def row(e: Reals) -> tuple[float, Reals]:
        turn = e[:3, :3]
        m, n = sign * (turn @ second), sign * (turn.T @ first)
        a, b, c, d = m @ x, m @ ahead, -n @ x, n @ back
        gradient = np.zeros((4, 4))
        gradient[:3, :3] = sign * sin(r) * np.outer(b * x - a * ahead, second) / (a * a + b * b)
        gradient[:3, :3] += sign * sin(s) * np.outer(first, -d * x - c * back) / (c * c + d * d)
        return float(sin(r) * np.arctan2(a, b) + sin(s) * np.arctan2(c, d)), gradient

    return row
