"""The directions from which space is seen: what is right, down and near on paper, after ISO 5456-3."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, pi, sqrt

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import GrueblerError, unknown
from gruebler.base.text import Message, message
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.structure.chain.spaces import Space


@dataclass(frozen=True, slots=True)
class View:
    """A parallel projection."""

    title: Message
    rows: tuple[tuple[float, float, float], ...]
    """What a vector moves to the right, down and towards the eye; lines of sight move only the last, by their
    length."""

    @property
    def sight(self) -> Reals:
        """The direction of the lines of sight."""
        right, down, near = np.array(self.rows)
        along = np.cross(right, down)
        return np.asarray(along / np.linalg.norm(along) * np.sign(along @ near))

    def on_paper(self, places: Reals) -> Reals:
        """Right, down and near of places, (..., 3)."""
        return np.asarray(places @ np.array(self.rows).T)


_HALF = cos(pi / 4) / 2  # depth is drawn at 45 degrees, half as long
_NEAR = 1 / (1 + 2 * _HALF**2)

VIEWS: Mapping[str, View] = {
    "isometric": View(
        message("Isometric view, z upwards."),
        (
            (-1 / sqrt(2), 1 / sqrt(2), 0.0),
            (1 / sqrt(6), 1 / sqrt(6), -2 / sqrt(6)),
            (1 / sqrt(3), 1 / sqrt(3), 1 / sqrt(3)),
        ),
    ),
    "oblique": View(
        message("Oblique view, x to the right, z upwards, y half as long to the back."),
        ((1.0, _HALF, 0.0), (0.0, -_HALF, -1.0), (_NEAR * _HALF, -_NEAR, _NEAR * _HALF)),
    ),
}
"""By their names."""


def usual_view(linkage: SpatialLinkage) -> str:
    """Oblique for bevel wheels, whose axes lie in the plane of the paper then, as in textbooks; else isometric."""
    chain = linkage.mechanism.chain
    wheels = chain.space is Space.SPHERICAL and any(joint.pair.has_contours for joint in chain.joints)
    return "oblique" if wheels else "isometric"


def view_named(name: str) -> View:
    """The view of a name; `GrueblerError` offers the nearest."""
    if name not in VIEWS:
        raise GrueblerError("there is no view {word!r}{suggestion}; there are {known}", **unknown(name, VIEWS))
    return VIEWS[name]
