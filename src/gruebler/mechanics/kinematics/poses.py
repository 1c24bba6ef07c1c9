"""Positions of a linkage along a curve: where links and points are, and how they move along it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.mechanics.kinematics.link_poses import LinkPoses
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.points import PointLike


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Poses(LinkPoses):
    """Positions on a circuit; ``order`` 0 is a value, 1 its derivative by the arc."""

    linkage: Linkage
    lower: Linkage
    arcs: Reals
    """(rows,) where on the circuit they are."""
    places: Complexes
    """(2, rows, links): origins of the links and their derivatives."""
    turns: Complexes
    """(rows, links): cosine + i sine of the angles."""
    rates: Reals
    """(1, rows, links): derivatives of the angles."""
    angles: Reals
    """(rows, links): the angles, continuous along the circuit."""
    turned: float

    def __len__(self) -> int:
        return len(self.arcs)

    @property
    def lower_linkage(self) -> Linkage:
        """The linkage as it was solved: with lower pairs, and the links that replace higher ones."""
        return self.lower

    def angle(self, link: str, order: int = 0) -> Reals:
        """The angle of a link against the frame, or its derivative; (rows,)."""
        self.check_order(order)
        k = self.link_index(link)
        return self.rates[0, :, k] if order else self.angles[:, k]

    def check_order(self, order: int) -> None:
        """`LinkageError` for an order other than 0 and 1."""
        if order not in (0, 1):
            raise LinkageError(
                "along a circuit there are values (0) and first derivatives (1), not {order!r}", order=order
            )

    def distance(self, first: PointLike, second: PointLike, order: int = 0) -> Reals:
        """The distance of two points, or its derivative (not where they coincide); (rows,)."""
        gap = self.complex_point(second) - self.complex_point(first)
        self.check_order(order)
        if order == 0:
            return np.abs(gap)
        rate = self.complex_point(second, order=1) - self.complex_point(first, order=1)
        return np.real(np.conj(gap) * rate) / np.abs(gap)

    def drive(self, order: int = 0) -> Reals:
        """The value of the drive; (rows,). `LinkageError` without a drive."""
        if not self.lower.mechanism.drives:
            raise LinkageError("this linkage has no drive")
        drive = self.lower.mechanism.drives[0]
        first, other = self.lower.reference(0)
        if drive.turning:
            return self.angle(other, order) - self.angle(first, order) + (self.turned if order == 0 else 0.0)
        return self._along_line(self.lower, drive.joint, first, other, order, 1)

    def tangents(self, bodies: Sequence[str]) -> Reals:
        """The derivatives of x, y (in sizes) and angle of links by the arc; (rows, 3 links)."""
        slopes = np.empty((len(self), 3 * len(bodies)))
        for body, link in enumerate(bodies):
            k = self.link_index(link)
            z = self.places[1, :, k] / self.lower.size
            slopes[:, 3 * body], slopes[:, 3 * body + 1], slopes[:, 3 * body + 2] = z.real, z.imag, self.rates[0, :, k]
        return slopes
