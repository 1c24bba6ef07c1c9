"""The directions from which space is seen: what is right, down and near on paper, after ISO 5456-3."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, pi, sqrt

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import GrueblerError, nearest
from gruebler.base.text import Message, message


@dataclass(frozen=True, slots=True)
class View:
    """A parallel projection."""

    title: Message
    rows: tuple[tuple[float, float, float], ...]
    """What a vector moves to the right, down and towards the eye; lines of sight move only the last, by their
    length."""

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
"""The first is the usual one."""


def view_named(name: str) -> View:
    """The view of a name; `GrueblerError` offers the nearest."""
    if name not in VIEWS:
        raise GrueblerError(
            "there is no view {name!r}{suggestion}; there are {known}",
            name=name,
            suggestion=nearest(name, VIEWS),
            known=", ".join(VIEWS),
        )
    return VIEWS[name]
