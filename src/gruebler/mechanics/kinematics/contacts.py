"""Round elements that touch: their closing conditions, and how well a motion meets them; docs/theory/wheels.md.

One row for each two kinds. The numbers of conditions are taken from the reference pose.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import degrees, floor, pi
from typing import Any, Generic

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.contours import COEFFICIENTS, PiecewiseLaw, cam_law, geneva_law, noncircular_law
from gruebler.mechanics.kinematics.kernel_records import FACE, MESH, POLAR, RACK, REACH, RIDE
from gruebler.mechanics.kinematics.link_poses import LinkPoses
from gruebler.mechanics.kinematics.noncircular import transfer_of
from gruebler.mechanics.linkages import (
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    Linkage,
    NonCircular,
    Pin,
    Wheel,
)
from gruebler.mechanics.linkages.contacts import Disc, First_co, Second_co, contact_of, in_order
from gruebler.mechanics.linkages.elements import INVERSE
from gruebler.mechanics.linkages.wheels import carriers, rolling_factors
from gruebler.structure.chain.pairs import Pair

Keys = tuple[tuple[int, str], ...]
_NO_LAW = PiecewiseLaw(())
_MESHES = 1e-6  # radians: angles of a drawing with six digits fit


@dataclass(frozen=True, slots=True, kw_only=True)
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Touch(Generic[First_co, Second_co]):
    """A joint of a linkage with lower pairs whose elements touch, in the order of their row."""

    lower: Linkage
    rolls: bool
    keys: Keys
    sides: tuple[int, int]
    owners: tuple[int, int]

    @property
    def first(self) -> First_co:
        """The element of the kind that the row names first."""
        element: First_co = self.lower.elements[self.keys[self.sides[0]]]  # type: ignore[assignment]
        return element

    @property
    def second(self) -> Second_co:
        """The other element."""
        element: Second_co = self.lower.elements[self.keys[self.sides[1]]]  # type: ignore[assignment]
        return element

    @property
    def turned(self) -> Touch[Second_co, First_co]:
        """The same, seen from the other side."""
        return Touch(
            lower=self.lower, rolls=self.rolls, keys=self.keys, sides=self.sides[::-1], owners=self.owners[::-1]
        )

    @property
    def side(self) -> int:
        """On which side of the first element, a line, the centre of the other lies: 1 on the left, seen along it."""
        return -1 if _way(self.lower, self.keys, self.sides).imag < 0 else 1

    def condition(
        self, kind: int, values: tuple[float, float, float], law: PiecewiseLaw = _NO_LAW, *, phased: bool = False
    ) -> Condition:
        """A condition between them; one that is phased holds as it does in the reference pose."""
        raw = Condition(kind=kind, sides=self.sides, owners=self.owners, values=values, law=law)
        return _phased(self.lower, self.keys, raw) if phased else raw


@dataclass(frozen=True, slots=True)
class MovingTouch(Generic[First_co, Second_co]):
    """Elements of a linkage that touch, in all rows of a motion."""

    poses: LinkPoses
    joint: int
    links: tuple[str, str]
    rolls: bool

    @property
    def first(self) -> First_co:
        """The element of the kind that the row names first."""
        element: First_co = self.poses.linkage.elements[self.joint, self.links[0]]  # type: ignore[assignment]
        return element

    @property
    def second(self) -> Second_co:
        """The other element."""
        element: Second_co = self.poses.linkage.elements[self.joint, self.links[1]]  # type: ignore[assignment]
        return element

    @property
    def turned(self) -> MovingTouch[Second_co, First_co]:
        """The same, seen from the other side."""
        return MovingTouch(self.poses, self.joint, self.links[::-1], self.rolls)

    @property
    def gap(self) -> Complexes:
        """From the first element's point to the other's; (rows,)."""
        return self.turned.centre - self.centre

    @property
    def centre(self) -> Complexes:
        """The first element's point; (rows,)."""
        return point_at(self.poses, self.links[0], self.first.x, self.first.y)

    @property
    def directions(self) -> Complexes:
        """That of the first element in the plane; (rows,)."""
        turns = self.poses.turns[:, self.poses.link_index(self.links[0])]
        return turns * rect(1, self.first.direction)


def point_at(poses: LinkPoses, link: str, x: float, y: float) -> Complexes:
    """Where a point of a link lies; (rows,)."""
    k = poses.link_index(link)
    return poses.places[0, :, k] + poses.turns[:, k] * complex(x, y)


@dataclass(frozen=True, slots=True)
class ContactMotion:
    """What two kinds of elements that touch ask of a motion."""

    conditions: Callable[[Touch[Any, Any]], list[Condition]]
    """The closing conditions of the solver."""
    opening: Callable[[MovingTouch[Any, Any]], float]
    """How far they leave each other in a motion, or turn against each other since its first row; a length."""


# --- wheels and circles ---------------------------------------------------------------------------------


def _wheels(touch: Touch[Wheel, Wheel]) -> list[Condition]:
    mesh = touch.condition(MESH, (*rolling_factors(touch.first, touch.second), 0.0), phased=True)
    return [mesh, *_circles(touch)] if touch.rolls else [mesh]


def _rack(touch: Touch[Wheel, Line]) -> list[Condition]:
    seen = touch.turned
    rack = seen.condition(RACK, (touch.first.radius * seen.side, 1.0, 0.0), phased=True)
    return [rack, *_circle_on_line(touch)] if touch.rolls else [rack]


def _circles(touch: Touch[Disc, Disc]) -> list[Condition]:
    return [touch.condition(REACH, (0.0, 0.0, abs(touch.first.radius + touch.second.radius)))]


def _circle_on_line(touch: Touch[Disc, Line]) -> list[Condition]:
    seen = touch.turned
    return [seen.condition(RIDE, (0.0, 0.0, touch.first.radius * seen.side))]


def _wheels_opening(touch: MovingTouch[Wheel, Wheel]) -> float:
    poses, (a, b) = touch.poses, touch.links
    arm = carriers(poses.linkage.mechanism, poses.linkage.elements).get(touch.joint)
    along = np.unwrap(np.angle(touch.gap)) if arm is None else poses.angle(arm.link)
    first, second = rolling_factors(touch.first, touch.second)
    slip = _since_first(first * (poses.angle(a) - along) + second * (poses.angle(b) - along))
    return max(_circles_opening(touch), slip) if touch.rolls else slip


def _circles_opening(touch: MovingTouch[Disc, Disc]) -> float:
    return float(np.abs(np.abs(touch.gap) - abs(touch.first.radius + touch.second.radius)).max())


def _rack_opening(touch: MovingTouch[Wheel, Line]) -> float:
    poses, (wheel, line) = touch.poses, touch.links
    far, radius, along = _on_line(touch.turned)
    slip = _since_first(radius * (poses.angle(wheel) - poses.angle(line)) + along)
    return max(float(far.max()), slip) if touch.rolls else slip


def _circle_on_line_opening(touch: MovingTouch[Circle, Line]) -> float:
    return float(_on_line(touch.turned)[0].max())


def _on_line(touch: MovingTouch[Line, Disc]) -> tuple[Reals, Reals, Reals]:
    """How far a disc is from its line; its radius with the sign of its side; how far along the line it is."""
    gap = touch.gap * np.conj(touch.directions)
    radius = np.copysign(touch.second.radius, gap.imag)
    return np.abs(gap.imag - radius), radius, gap.real


def _since_first(values: Reals) -> float:
    return float(np.abs(values - values[0]).max())


# --- cams -----------------------------------------------------------------------------------------------


def _cam_and_roller(touch: Touch[CamDisc, Element]) -> list[Condition]:
    disc = touch.first
    return [touch.condition(POLAR, (disc.base * disc.scale, 0.0, 0.0), cam_law(disc))]


def _cam_and_face(touch: Touch[CamDisc, Line]) -> list[Condition]:
    seen = touch.turned
    return [seen.condition(FACE, (0.0, float(seen.side), 0.0), cam_law(touch.first))]


def _roller_opening(touch: MovingTouch[CamDisc, Element]) -> float:
    law, gap = cam_law(touch.first), touch.gap
    wanted = np.exp(law_at(law, np.angle(gap / touch.directions)))
    return float(np.abs(np.abs(gap) - wanted).max())


def _face_opening(touch: MovingTouch[CamDisc, Line]) -> float:
    law, normal = cam_law(touch.first), 1j * touch.turned.directions
    height = (np.conj(normal) * touch.gap).real
    normal, height = normal * np.sign(height), np.abs(height)
    wanted = law_at(law, np.angle(normal / touch.directions))
    return float(np.abs(height - wanted).max())


# --- Geneva drives and non-circular wheels ----------------------------------------------------------------


def _geneva(touch: Touch[GenevaDriver, GenevaWheel]) -> list[Condition]:
    size = touch.lower.size
    return [touch.condition(MESH, (size, -size, 0.0), geneva_law(touch.first, touch.second), phased=True)]


def _geneva_opening(touch: MovingTouch[GenevaDriver, GenevaWheel]) -> float:
    return _law_opening(touch, geneva_law(touch.first, touch.second))


def _noncircular(touch: Touch[NonCircular, NonCircular]) -> list[Condition]:
    if touch.first.transfer == INVERSE:
        return _noncircular(touch.turned)
    size = touch.lower.size
    law = noncircular_law(touch.first, touch.second)
    condition = touch.condition(MESH, (size, -size, 0.0), law, phased=True)
    _check_phase(touch, condition)
    return [condition]


def _noncircular_opening(touch: MovingTouch[NonCircular, NonCircular]) -> float:
    if touch.first.transfer == INVERSE:
        return _noncircular_opening(touch.turned)
    return _law_opening(touch, noncircular_law(touch.first, touch.second))


def _law_opening(touch: MovingTouch[Element, Element], law: PiecewiseLaw) -> float:
    """How far the second wheel is from the angle of its law, times a length."""
    poses, (a, b), gap = touch.poses, touch.links, touch.gap
    bearing = np.unwrap(np.angle(gap))
    turned = poses.angle(a) + touch.first.direction - bearing
    turned += np.angle(touch.directions[0] / gap[0] * abs(gap[0])) - turned[0]
    wheel = poses.angle(b) - bearing
    off = law_at(law, turned) - wheel
    return _since_first(off) * poses.linkage.size


CONTACT_MOTIONS: dict[tuple[type[Element], type[Element]], ContactMotion] = {
    (Wheel, Wheel): ContactMotion(_wheels, _wheels_opening),
    (Wheel, Line): ContactMotion(_rack, _rack_opening),
    (Circle, Circle): ContactMotion(_circles, _circles_opening),
    (Circle, Line): ContactMotion(_circle_on_line, _circle_on_line_opening),
    (CamDisc, Circle): ContactMotion(_cam_and_roller, _roller_opening),
    (CamDisc, Pin): ContactMotion(_cam_and_roller, _roller_opening),
    (CamDisc, Line): ContactMotion(_cam_and_face, _face_opening),
    (GenevaDriver, GenevaWheel): ContactMotion(_geneva, _geneva_opening),
    (NonCircular, NonCircular): ContactMotion(_noncircular, _noncircular_opening),
}
"""One row for each row of `gruebler.mechanics.linkages.contacts.CONTACTS` with a round element. The others are lower
pairs, or become such (`gruebler.mechanics.linkages.with_lower_pairs`)."""


def contact_conditions(
    lower: Linkage, pair: Pair, keys: Keys, sides: tuple[int, int], owners: tuple[int, int]
) -> list[Condition]:
    """What a joint with a round element asks for."""
    touch: Touch[Element, Element] = Touch(lower=lower, rolls=pair.rolls, keys=keys, sides=sides, owners=owners)
    contact = contact_of(touch.first, touch.second)
    return CONTACT_MOTIONS[contact.kinds].conditions(touch if in_order(contact, touch.first) else touch.turned)


def moving_touch(poses: LinkPoses, joint: int) -> MovingTouch[Element, Element]:
    """A joint of the linkage whose elements touch, in the order of their row."""
    chain = poses.linkage.mechanism.chain
    a, b = chain.joints[joint].links
    touch: MovingTouch[Element, Element] = MovingTouch(poses, joint, (a, b), chain.joints[joint].pair.rolls)
    return touch if in_order(contact_of(touch.first, touch.second), touch.first) else touch.turned


def contact_opening(poses: LinkPoses, joint: int) -> float:
    """How far round elements leave each other, or turn against each other since the first row; a length."""
    touch = moving_touch(poses, joint)
    return CONTACT_MOTIONS[contact_of(touch.first, touch.second).kinds].opening(touch)


def _check_phase(touch: Touch[NonCircular, NonCircular], condition: Condition) -> None:
    """Refuse non-circular wheels that do not touch there; the second may start in any of its equal parts."""
    lower = touch.lower
    part = 2 * pi / transfer_of(touch.first, touch.second).mean.denominator
    off = condition.values[2] / lower.size + pi
    off -= part * floor(off / part + 0.5)
    if abs(off) > _MESHES:
        raise LinkageError(
            "the non-circular wheels do not mesh in the reference pose: turn {keys!r}, or its direction, by {off:.9g}°",
            keys=touch.keys[condition.sides[1]][1],
            off=degrees(off),
        )


def _phased(lower: Linkage, keys: Keys, raw: Condition) -> Condition:
    """The condition as it holds in the reference pose."""
    a, b, _ = raw.values
    first, second = reference_angles(lower, keys, raw)
    if raw.kind == RACK:
        second = _way(lower, keys, raw.sides).real
    elif raw.law.pieces:
        first = float(law_at(raw.law, first))
    return replace(raw, values=(a, b, a * first + b * second))


def law_at(law: PiecewiseLaw, angles: ArrayLike, order: int = 0) -> Reals:
    """The values of a law, or a derivative by the angle, in the shape of the angles."""
    table, angles = np.array(law.pieces), np.asarray(angles, np.float64)
    starts = table[:, 0] - table[:, 1]
    turns = np.floor((angles - starts[0]) / (2 * pi))
    places = angles - 2 * pi * turns
    piece = np.maximum(np.searchsorted(starts, places, side="right") - 1, 0)
    middle, half, *coefficients = table[piece].T
    for _ in range(order):
        coefficients = [k * c / half for k, c in enumerate(coefficients)][1:]
    value = np.zeros_like(places)
    for c in reversed(coefficients):
        value = value * (places - middle) / half + c
    return np.asarray(value if order else value + turns * law.advance)


def reference_angles(lower: Linkage, keys: Keys, condition: Condition) -> tuple[float, float]:
    """The angles of a condition that counts whole turns, in the reference pose."""
    angles = [
        lower.required_pose[keys[side][1]].angle + lower.elements[keys[side]].direction for side in condition.sides
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


def _way(lower: Linkage, keys: Keys, sides: tuple[int, int]) -> complex:
    """A centre in the reference pose, seen from a line: along it, and to the left of it."""
    number, link = keys[sides[0]]
    line = lower.elements[number, link]
    gap = _put(lower, keys, sides[1]) - _put(lower, keys, sides[0])
    return gap * rect(1, -lower.required_pose[link].angle - line.direction)


def _put(lower: Linkage, keys: Keys, side: int) -> complex:
    number, link = keys[side]
    element = lower.elements[number, link]
    return complex(*lower.required_pose[link].put(element.x, element.y))
