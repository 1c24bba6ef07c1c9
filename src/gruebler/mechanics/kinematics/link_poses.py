"""Where links and points are, and how they move, read from arrays of poses.

All holders of poses have the same axes: first the order of the derivative, last the link (or body), and between them
the design, if there are many, and the row: ``places[order, row, link]``. Places are x + iy; `LinkPoses.point` gives
(rows, 2), `LinkPoses.complex_point` the complex numbers.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from cmath import rect

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError, unknown
from gruebler.base.jets import turn_derivative, turned_derivative
from gruebler.base.text import message
from gruebler.mechanics.linkages import Linkage, LinkPoint, Pose2D
from gruebler.mechanics.linkages.points import PointLike, place_of
from gruebler.mechanics.linkages.wheels import sliding_joint


class LinkPoses(ABC):
    """Poses of one linkage in rows, with derivatives by the time (`Motion`) or by the arc of a circuit (`Poses`)."""

    linkage: Linkage
    places: Complexes
    """(order + 1, rows, links): origins of the links and their derivatives, as x + iy."""
    turns: Complexes
    """(rows, links): cosine + i sine of the angles."""
    rates: Reals
    """(order, rows, links): first and higher derivatives of the angles."""

    @property
    @abstractmethod
    def lower_linkage(self) -> Linkage:
        """The linkage as it was solved: with lower pairs, and the links that replace higher ones."""

    @abstractmethod
    def angle(self, link: str) -> Reals:
        """The angle of a link's x axis against the frame's, in radians, continuous; (rows,)."""

    @abstractmethod
    def check_order(self, order: int) -> None:
        """`LinkageError` for an order of derivatives that is not there."""

    @property
    def links(self) -> tuple[str, ...]:
        """The links in the order of the arrays' last axis."""
        return self.lower_linkage.mechanism.chain.links

    @property
    def size(self) -> float:
        """A length of the order of the linkage as it was solved."""
        return self.lower_linkage.size

    def link_index(self, link: str) -> int:
        """Where a link is in the arrays' last axis; `LinkageError` offers the nearest name."""
        if link not in self.links:
            known = self.linkage.mechanism.chain.links
            raise LinkageError("there is no link {word!r}{suggestion}; the links are {known}", **unknown(link, known))
        return self.links.index(link)

    def point(self, name: PointLike, *, order: int = 0) -> Reals:
        """A named point or a joint, or a derivative of its position; (rows, 2).

        A joint is seen as a point of its link at the frame, else of the link named first.
        """
        z = self.complex_point(name, order=order)
        return np.stack([z.real, z.imag], axis=1)

    def complex_point(self, name: PointLike, *, order: int = 0) -> Complexes:
        """`point` as x + iy; (rows,)."""
        self.check_order(order)
        place = place_of(self.linkage, name)
        k = self.link_index(place.link)
        arm = self.turns[:, k] * complex(place.x, place.y)
        return np.asarray(self.places[order, :, k] + turn_derivative(self.rates[:, :, k], order) * arm)

    def displacement(self, joint: str | int, *, order: int = 0, across: bool = False) -> Reals:
        """The way of a sliding joint along its line, from the first link's point to the second's; (rows,).

        First is the frame, else the link named first, but a pin slides along the line of the other link. With
        ``across`` the way at right angles to the line is seen: the second freedom of a double slide.
        """
        mechanism, elements = self.linkage.mechanism, self.linkage.elements
        number = joint if isinstance(joint, int) else mechanism.chain.find_joint(joint)
        if number is None or not sliding_joint(self.linkage, number):
            sliding = [name for k, name in enumerate(mechanism.chain.joint_names()) if sliding_joint(self.linkage, k)]
            raise LinkageError(
                "{joint!r} is not a sliding joint; there are {joints}",
                joint=joint,
                joints=", ".join(sliding) or message("none"),
            )
        first, other = mechanism.chain.joints[number].links[:2]
        if not elements[number, first].is_line or (other == mechanism.frame and elements[number, other].is_line):
            first, other = other, first
        return self._along_line(self.linkage, number, first, other, order, 1j if across else 1)

    def pose(self, row: int = 0) -> dict[str, Pose2D]:
        """Where the links lie in a row, as a reference pose for `Linkage.with_reference_pose`."""
        return {
            link: Pose2D(float(z.real), float(z.imag), float(self.angle(link)[row]))
            for link in self.linkage.mechanism.chain.links
            for z in [self.places[0, row, self.link_index(link)]]
        }

    def _along_line(self, linkage: Linkage, joint: int, first: str, other: str, order: int, along: complex) -> Reals:
        """The way from the first link's point to the other's, seen along (or across) the first link's line."""
        line, far = linkage.elements[joint, first], linkage.elements[joint, other]
        self.check_order(order)
        gaps = [
            self.complex_point(LinkPoint(other, far.x, far.y), order=k)
            - self.complex_point(LinkPoint(first, line.x, line.y), order=k)
            for k in range(order + 1)
        ]
        k = self.link_index(first)
        seen = turned_derivative(-self.rates[:, :, k], gaps, order)
        return np.real(np.conj(self.turns[:, k] * rect(1, line.direction) * along) * seen)
