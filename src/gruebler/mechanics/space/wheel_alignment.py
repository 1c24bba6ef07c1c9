"""How a wheel of a vehicle stands while its suspension moves: camber, toe, track, after ISO 8855."""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.columns import Column, Table
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.text import translate
from gruebler.mechanics.space.motion import SpatialMotion

_LYING = 1e-6  # cosine of the angle between the axis and the vertical: a wheel that lies has no camber


@door_that_raises(LinkageError)
def wheel_alignment(
    motion: SpatialMotion, centre: str, axle: str, contact: str | None = None, *, lang: str = "en"
) -> Table:
    """Travel, camber, toe, and how far half the track and the wheelbase change, row by row.

    In the linkage's coordinates x points outwards, y forwards and z upwards. Camber is positive where the wheel leans
    outwards at its top, toe where it points inwards at its front (toe-in); a steered wheel has its steering angle as
    toe. Travel, half track and wheelbase count from the reference pose; the wheel stands on its lowest point.
    docs/theory/space.md

    Args:
        motion: of any order.
        centre: the point at the middle of the wheel.
        axle: a point of its axis farther outwards, on the same link.
        contact: a point on the ground below the centre in the reference pose, which gives the wheel's radius; without
            it there are no columns of the track.
        lang: of the names of the columns.

    Returns:
        a `Table`: angles in degrees, lengths in the linkage's unit.

    Raises:
        LinkageError: points on different links or at one place, a wheel that lies.

    >>> from gruebler.mechanics.space import move
    >>> from gruebler.teaching.catalog import entry
    >>> bump = move(entry("susp_spatial").placed(), [0.0, 0.1])
    >>> [column.header for column in wheel_alignment(bump, "C", "A", "T")][:3]
    ['travel [mm]', 'camber [°]', 'toe [°]']
    """
    linkage = motion.linkage
    places = {name: linkage.point(name) for name in (centre, axle, contact) if name is not None}
    if len({link for link, _ in places.values()}) > 1:
        raise LinkageError("{points}: expected points of one link, the wheel carrier", points=", ".join(places))
    along = motion.point(axle) - motion.point(centre)
    lengths = np.linalg.norm(along, axis=1)
    if not (lengths > _LYING * linkage.size).all():
        raise LinkageError("{centre} and {axle} are one place, so that the wheel has no axis", centre=centre, axle=axle)
    axis = along / lengths[:, None]
    level = np.hypot(axis[:, 0], axis[:, 1])
    if not (level > _LYING).all():
        raise LinkageError("the axis from {centre} to {axle} stands upright", centre=centre, axle=axle)
    middle = motion.point(centre)
    start = np.array(places[centre][1])
    at_rest = np.array(places[axle][1]) - start
    at_rest /= np.linalg.norm(at_rest)
    unit, usual = linkage.unit, linkage.size
    columns = [
        Column(translate("travel", lang), unit=unit, values=middle[:, 2] - start[2], natural=usual),
        Column(translate("camber", lang), unit="°", values=np.degrees(np.arctan2(-axis[:, 2], level)), natural=90.0),
        Column(translate("toe", lang), unit="°", values=np.degrees(np.arctan2(axis[:, 1], axis[:, 0])), natural=90.0),
    ]
    if contact is not None:
        radius = float(start[2] - places[contact][1][2]) / float(np.hypot(*at_rest[:2]))
        moved = _lowest(middle, axis, radius) - _lowest(start, at_rest, radius)
        names = translate("half track", lang), translate("wheelbase", lang)
        columns += [Column(n, unit=unit, values=moved[:, k], natural=usual) for k, n in enumerate(names)]
    return Table(tuple(columns))


def _lowest(middle: Reals, axis: Reals, radius: float) -> Reals:
    """The lowest point of a circle about an axis of length 1, (..., 3)."""
    up = np.array([0.0, 0.0, 1.0])
    steepest = up - axis[..., 2:] * axis
    return np.asarray(middle - radius * steepest / np.linalg.norm(steepest, axis=-1, keepdims=True))
