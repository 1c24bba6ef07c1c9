"""Positions of a linkage along a curve: where links and points are, and how they move along it."""

from __future__ import annotations

from cmath import rect
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gruebler.arrays import Complexes, Reals
from gruebler.errors import LinkageError, nearest
from gruebler.linkages import Element, Line, Linkage, LinkPoint, Pose2D
from gruebler.linkages.wheels import sliding_joint
from gruebler.notebook import Brief

__all__ = ["Poses"]


@dataclass(frozen=True, eq=False, repr=False)
class Poses(Brief):
    """Positions on a circuit; ``order`` 0 is a value, 1 its derivative by the arc."""

    linkage: Linkage
    lower: Linkage
    arcs: Reals
    """(rows,) where on the circuit they are."""
    places: Complexes
    """(2, rows, links): origins of the links and their derivatives."""
    turns: Reals
    """(2, rows, links): angles, continuous along the circuit, and their derivatives."""
    turned: float

    def __len__(self) -> int:
        return len(self.arcs)

    def angle(self, link: str, order: int = 0) -> Reals:
        """The angle of a link against the frame; (rows,)."""
        return self.turns[_order(order), :, self._link(link)]

    def point(self, name: str | LinkPoint, order: int = 0) -> Reals:
        """A named point or a joint; (rows, 2)."""
        z = self.complex_point(name, order)
        return np.stack([z.real, z.imag], axis=1)

    def complex_point(self, name: str | LinkPoint, order: int = 0) -> Complexes:
        """`point` as x + iy; (rows,)."""
        place = name if isinstance(name, LinkPoint) else self.linkage.points_named(name)[-1]
        k = self._link(place.link)
        arm = np.exp(1j * self.turns[0, :, k]) * complex(place.x, place.y)
        factor = 1 if _order(order) == 0 else 1j * self.turns[1, :, k]
        out: Complexes = self.places[order, :, k] + factor * arm
        return out

    def distance(self, first: str | LinkPoint, second: str | LinkPoint, order: int = 0) -> Reals:
        """The distance of two points, or its derivative (not where they coincide); (rows,)."""
        gap = self.complex_point(second) - self.complex_point(first)
        if _order(order) == 0:
            return np.abs(gap)
        rate = self.complex_point(second, 1) - self.complex_point(first, 1)
        return np.real(np.conj(gap) * rate) / np.abs(gap)

    def displacement(self, joint: str | int, order: int = 0, *, across: bool = False) -> Reals:
        """The way of a sliding joint along its line, from the first link's point to the second's; (rows,).

        First is the frame, else the link named first, but a pin slides along the line of the other link. With
        ``across`` the way at right angles to the line is seen: the second freedom of a double slide.
        """
        chain, frame = self.linkage.mechanism.chain, self.linkage.mechanism.frame
        number = joint if isinstance(joint, int) else chain.find_joint(joint)
        if number is None or not sliding_joint(self.linkage, number):
            raise LinkageError("{joint!r} is no sliding joint", joint=joint)
        first, other = chain.joints[number].links[:2]
        if other == frame or not isinstance(self.linkage.elements[number, first], Line):
            first, other = other, first
        if not isinstance(self.linkage.elements[number, first], Line):
            first, other = other, first
        return self._way(self.linkage, number, first, other, order, 1j if across else 1)

    def drive(self, order: int = 0) -> Reals:
        """The value of the drive; (rows,). `LinkageError` without a drive."""
        if not self.lower.mechanism.drives:
            raise LinkageError("this linkage has no drive")
        drive = self.lower.mechanism.drives[0]
        first, other = self.lower.reference(0)
        if drive.turning:
            return self.angle(other, order) - self.angle(first, order) + (self.turned if order == 0 else 0.0)
        return self._way(self.lower, drive.joint, first, other, order, 1)

    def pose(self, row: int = 0) -> dict[str, Pose2D]:
        """Where the links lie in one position, as a home for `Linkage`."""
        z, angle = self.places[0, row], self.turns[0, row]
        chain = self.lower.mechanism.chain
        return {
            link: Pose2D(z[k].real, z[k].imag, float(angle[k]))
            for link in self.linkage.mechanism.chain.links
            for k in [chain.links.index(link)]
        }

    def tangents(self, bodies: Sequence[str]) -> Reals:
        """The derivatives of x, y (in sizes) and angle of links by the arc; (rows, 3 links)."""
        out = np.empty((len(self), 3 * len(bodies)))
        for body, link in enumerate(bodies):
            k = self._link(link)
            z = self.places[1, :, k] / self.lower.size
            out[:, 3 * body], out[:, 3 * body + 1], out[:, 3 * body + 2] = z.real, z.imag, self.turns[1, :, k]
        return out

    def _way(self, linkage: Linkage, joint: int, first: str, other: str, order: int, along: complex) -> Reals:
        line, far = linkage.elements[joint, first], linkage.elements[joint, other]
        k = self._link(first)
        direction = np.exp(1j * self.turns[0, :, k]) * along * _direction(line)
        point, there = LinkPoint(first, line.x, line.y), LinkPoint(other, far.x, far.y)
        gap = self.complex_point(there) - self.complex_point(point)
        if _order(order) == 1:
            rate = self.complex_point(there, 1) - self.complex_point(point, 1)
            gap = rate - 1j * self.turns[1, :, k] * gap
        return np.real(np.conj(direction) * gap)

    def _link(self, link: str) -> int:
        links = self.lower.mechanism.chain.links
        if link not in links:
            known = self.linkage.mechanism.chain.links
            raise LinkageError(
                "there is no link {link!r}{suggestion}; the links are {known}",
                link=link,
                suggestion=nearest(str(link), known),
                known=", ".join(known),
            )
        return links.index(link)


def _order(order: int) -> int:
    if order not in (0, 1):
        raise LinkageError("along a circuit there are values (0) and first derivatives (1), not {order!r}", order=order)
    return order


def _direction(element: Element) -> complex:
    return rect(1, element.angle) if isinstance(element, Line) else 1 + 0j
