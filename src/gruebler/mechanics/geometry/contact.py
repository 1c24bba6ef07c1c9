"""Of what order a path touches its tangent: from its Taylor series."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis.courses import motion_rows
from gruebler.mechanics.geometry.series import taylor_series
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages.points import PointLike
from gruebler.mechanics.linkages.quantities import as_positive


@dataclass(frozen=True, kw_only=True)
class TangentContact:
    """How a path leaves its tangent: with x along the tangent and y to its left, y = coefficient x^points + ..."""

    points: int | None
    """How many points the tangent has in common with the path there: 2 ordinarily, 3 in an inflection, 6 in a six-point
    contact; None where it does not leave the tangent up to the order looked at (a straight line)."""
    coefficient: float
    """Of x^points; 0 for None. Units of length to the power 1 - points."""
    at: complex
    direction: float
    """The angle of the tangent, in radians, the way in which the point goes."""
    remainder: float
    """The largest of the coefficients that are taken for zero, times the linkage's size to the power k - 1."""

    @property
    def order(self) -> int | None:
        """The order of contact: how many derivatives curve and tangent have in common; points - 1."""
        return None if self.points is None else self.points - 1


def tangent_contact(
    motion: Motion, point: PointLike, row: int = 0, highest: int = 10, tolerance: float = 1e-8
) -> TangentContact:
    """The order of contact of a point's path with its tangent at one row of a motion.

    Coefficients of y by powers of x are exact up to roundings, some 1e-15 times the linkage's size by the radius of
    convergence to the power k. In units of the size they are zero if smaller than the tolerance: a drive value that is
    off by d spoils contact of order n by the order of d.

    Raises `LinkageError` in a cusp, where there is no such order, and as `taylor_series`.

    >>> from gruebler.mechanics.kinematics import move
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> bar = FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4).linkage({"K": (8.018753738744802, 2.268046058132576)})
    >>> found = tangent_contact(move(bar, np.pi), "K")
    >>> found.points, round(abs(found.coefficient), 15)
    (6, 0.000155006772785)
    """
    if not -len(motion) <= row < len(motion):
        raise LinkageError("the motion has {count} rows, but row {row} was asked for", count=len(motion), row=row)
    if isinstance(highest, bool) or not isinstance(highest, int) or not 2 <= highest <= 30:
        raise LinkageError("highest must be a whole number from 2 to 30, not {highest!r}", highest=highest)
    least, size = as_positive("tolerance", tolerance), motion.size
    z = taylor_series(motion_rows(motion, np.array([row])), highest).complex_point(point)[:, 0]
    speed = abs(z[1])
    if speed <= 1e-9 * max(float(np.abs(z[1:4]).max()), 1e-9 * size):
        raise LinkageError("the point stands still there: a cusp has no order of contact")
    seen = np.conj(z[1]) / speed * z
    powers = np.arange(2, highest + 1)
    # y starts with the power m of the drive, so it starts with x^m, and the drive is x/speed to the first order
    scaled = np.abs(seen.imag[2:]) / speed**powers * size ** (powers - 1.0)
    large = np.flatnonzero(scaled > least)
    direction = float(np.angle(z[1]))
    if not len(large):
        return TangentContact(
            points=None, coefficient=0.0, at=complex(z[0]), direction=direction, remainder=float(scaled.max())
        )
    m = int(large[0]) + 2
    return TangentContact(
        points=m,
        coefficient=float(seen.imag[m] / speed**m),
        at=complex(z[0]),
        direction=direction,
        remainder=float(scaled[: large[0]].max(initial=0.0)),
    )
