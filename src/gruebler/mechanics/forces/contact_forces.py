"""Along which line elements that touch press on each other: a row for each two kinds; docs/theory/statics.md."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.contacts import MovingTouch, law_at, moving_touch
from gruebler.mechanics.kinematics.contours import cam_law, geneva_law, noncircular_law
from gruebler.mechanics.linkages import (
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    NonCircular,
    Pin,
    Wheel,
)
from gruebler.mechanics.linkages.contacts import Disc, contact_of
from gruebler.mechanics.linkages.elements import INVERSE, PRESSURE_ANGLE
from gruebler.mechanics.linkages.wheels import carriers, rolling_factors


class ContactForce(NamedTuple):
    """The force of a contact on its second element, for an unknown of one; arrays are (rows,)."""

    at: Complexes
    """A place on its line."""
    force: Complexes
    couple: Reals
    """About that place."""
    apart: Complexes
    """What pushes the second element through that place besides, for each unit of the unknown's size."""


Touching = MovingTouch[Any, Any]


def contact_forces(motion: Motion, joint: int) -> tuple[tuple[str, str], list[ContactForce]]:
    """The links of a joint of the linkage whose elements touch, and the unknown forces on the second of them."""
    touch = moving_touch(motion, joint)
    return touch.links, CONTACT_FORCES[contact_of(touch.first, touch.second).kinds](touch)


def _pressing(at: Complexes, force: Complexes, apart: Complexes | float = 0.0) -> ContactForce:
    none = np.zeros(len(at))
    return ContactForce(at, force, none, apart + none.astype(np.complex128))


def _unit(vectors: Complexes) -> Complexes:
    return np.asarray(vectors / np.abs(vectors))


# --- wheels and circles ---------------------------------------------------------------------------------


def _wheels(touch: MovingTouch[Wheel, Wheel]) -> list[ContactForce]:
    first, second = rolling_factors(touch.first, touch.second)
    along, total = _unit(touch.gap), first + second
    if touch.first.belt:  # on one of the two strands, which pull the wheels together
        across = np.clip(total / np.abs(touch.gap), -1.0, 1.0)
        couple = np.full(len(along), first)
        return [ContactForce(touch.centre, across * 1j * along, couple, -np.sqrt(1 - across**2) * along)]
    at = touch.centre + touch.gap * (first / total)
    if touch.rolls and not _has_arm(touch):
        return [_pressing(at, 1j * along), _pressing(at, along)]
    return [_pressing(at, 1j * along, np.sign(total) * _slope(touch, touch.first) * along)]


def _has_arm(touch: Touching) -> bool:
    linkage = touch.poses.linkage
    return touch.joint in carriers(linkage.mechanism, linkage.elements)


def _slope(touch: Touching, wheel: Wheel) -> float:
    """The tangent of the pressure angle; 0 of friction wheels, which something else presses together."""
    return 0.0 if touch.rolls and not wheel.teeth else float(np.tan(wheel.pressure_angle))


def _rack(touch: MovingTouch[Wheel, Line]) -> list[ContactForce]:
    line = touch.turned
    along = line.directions
    to_wheel = 1j * along * np.sign((np.conj(along) * line.gap).imag)
    at = touch.centre - touch.first.radius * to_wheel
    if touch.rolls:
        return [_pressing(at, along), _pressing(at, to_wheel)]
    return [_pressing(at, along, -_slope(touch, touch.first) * to_wheel)]


def _circles(touch: MovingTouch[Disc, Disc]) -> list[ContactForce]:
    away = np.sign(touch.first.radius + touch.second.radius)  # a hole holds its disc towards its centre
    return [_pressing(touch.centre, away * _unit(touch.gap))]


def _circle_on_line(touch: MovingTouch[Circle, Line]) -> list[ContactForce]:
    across = 1j * touch.turned.directions
    return [_pressing(touch.centre, across * np.sign((np.conj(across) * touch.gap).real))]


# --- cams, Geneva drives, non-circular wheels --------------------------------------------------------------


def _cam_and_roller(touch: MovingTouch[CamDisc, Element]) -> list[ContactForce]:
    slope = law_at(cam_law(touch.first), np.angle(touch.gap / touch.directions), 1)
    return [_pressing(touch.turned.centre, _unit(touch.gap * (1 - 1j * slope)))]


def _cam_and_face(touch: MovingTouch[CamDisc, Line]) -> list[ContactForce]:
    normal = 1j * touch.turned.directions
    normal = normal * np.sign((np.conj(normal) * touch.gap).real)
    slope = law_at(cam_law(touch.first), np.angle(normal / touch.directions), 1)
    return [_pressing(touch.centre + 1j * normal * slope, normal)]


def _geneva(touch: MovingTouch[GenevaDriver, GenevaWheel]) -> list[ContactForce]:
    driver, wheel = touch.first, touch.second
    drive, along = Geneva(wheel.slots, internal=wheel.internal, pins=driver.pins), _unit(touch.gap)
    resting = law_at(geneva_law(driver, wheel), np.angle(touch.directions / along), 1) == 0
    pitch = 2 * np.pi / driver.pins
    pin = touch.directions * np.exp(-1j * pitch * np.round(np.angle(touch.directions / along) / pitch))
    side = -1 if wheel.internal else 1  # inside the wheel a pin steps on the far side of its axis
    at = touch.centre + side * drive.sizes(1.0).crank * np.abs(touch.gap) * pin
    across = 1j * _unit(at - touch.turned.centre)
    return [_pressing(np.where(resting, touch.centre, at), np.where(resting, 1j * along, across))]


def _noncircular(touch: MovingTouch[NonCircular, NonCircular]) -> list[ContactForce]:
    if touch.first.transfer == INVERSE:
        return [force._replace(force=-force.force, apart=-force.apart) for force in _noncircular(touch.turned)]
    law, along = noncircular_law(touch.first, touch.second), _unit(touch.gap)
    angles = np.angle(touch.directions / along)
    ratio, change = -law_at(law, angles, 1), -law_at(law, angles, 2)
    slant = np.arctan(-change / (ratio * (1 + ratio)))  # of the common tangent, against the line across the centres
    pressure = 0.0 if touch.rolls and not touch.first.teeth else PRESSURE_ANGLE
    forward, back = np.tan(slant + pressure), np.tan(slant - pressure)
    at = touch.centre + touch.gap * (ratio / (1 + ratio))
    return [_pressing(at, (1j + (forward + back) / 2) * along, (forward - back) / 2 * along)]


CONTACT_FORCES: dict[tuple[type[Element], type[Element]], Callable[[Touching], list[ContactForce]]] = {
    (Wheel, Wheel): _wheels,
    (Wheel, Line): _rack,
    (Circle, Circle): _circles,
    (Circle, Line): _circle_on_line,
    (CamDisc, Circle): _cam_and_roller,
    (CamDisc, Pin): _cam_and_roller,
    (CamDisc, Line): _cam_and_face,
    (GenevaDriver, GenevaWheel): _geneva,
    (NonCircular, NonCircular): _noncircular,
}
"""One row for each row of `gruebler.mechanics.kinematics.contacts.CONTACT_MOTIONS`."""


_PUSHING = {(Circle, Circle), (Circle, Line), (CamDisc, Circle), (CamDisc, Pin), (CamDisc, Line)}
"""Kinds whose elements can only push each other: the unknown is positive where they do."""


def pushing(motion: Motion, joint: int) -> tuple[str, Complexes] | None:
    """The second link of a joint whose elements can only push each other, and the direction in which it is pushed."""
    touch = moving_touch(motion, joint)
    if contact_of(touch.first, touch.second).kinds not in _PUSHING or touch.rolls or touch.first.closed:
        return None
    return touch.links[1], contact_forces(motion, joint)[1][0].force
