"""What a solver returns: where every link of a linkage is at each row of drive values, and how it moves there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gruebler import views
from gruebler.errors import LinkageError, nearest
from gruebler.kinematics.plan import Plan
from gruebler.linkages import Linkage, Named, Place
from gruebler.views import Brief

__all__ = ["Motion", "Stop"]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]


@dataclass(frozen=True)
class Stop:
    """Where a motion ended before the end of its path, and why."""

    row: float
    """The place on the path, in rows."""
    drives: tuple[float, ...]
    """The drive values there."""
    links: tuple[str, ...]
    """The group that can no longer be assembled, or no longer be followed."""
    form: str
    """The form of that group; for ``open`` the name of the joint."""
    reason: str
    """``limit`` (it can no longer be assembled), ``singular`` (it cannot be followed), ``start`` (not even begun),
    ``open`` (the redundant conditions of a joint are not met)."""


@dataclass(frozen=True, repr=False)
class Motion(Brief):
    """Poses of a linkage along a path of its drives, with derivatives.

    Points are returned as (rows, 2), angles as (rows,) in radians without jumps. Rows behind a `stop` are not there:
    ``len(motion)`` says how many are.
    """

    linkage: Linkage
    plan: Plan
    drives: Reals
    """(rows, drives) the drive values of the rows that were reached."""
    places: Complexes
    """(order + 1, rows, links): origins of the links and their time derivatives, as x + iy."""
    turns: Complexes
    """(rows, links): cosine + i sine of the angles."""
    rates: Reals
    """(order, rows, links): angular velocities, accelerations, jerks."""
    whole: NDArray[np.int32]
    """(rows, links): whole turns to add to the angle's principal value."""
    roots: Reals
    """(rows, dyads): the signed number of each dyad that is 0 where its assembly modes meet."""
    unknowns: Reals
    """(rows, 3 bodies of larger groups)."""
    stop: Stop | None
    unbounded: tuple[int, ...] = ()
    """Rows at a limit of the drive, where links would have to move infinitely fast: their rates are NaN."""

    def __len__(self) -> int:
        return len(self.drives)

    @property
    def complete(self) -> bool:
        """Whether the whole path was followed."""
        return self.stop is None

    @property
    def order(self) -> int:
        """The highest derivative: 0 positions, 1 velocities, 2 accelerations, 3 jerks."""
        return len(self.rates)

    def message(self, lang: str = "en") -> str:
        """Where and why it stopped, and in which rows rates are not finite; else empty."""
        from gruebler.kinematics.prose import stopped

        return stopped(self, lang)

    def angle(self, link: str) -> Reals:
        """The angle of a link's x axis against the frame's, in radians, continuous; (rows,)."""
        k = self._link(link)
        out: Reals = np.angle(self.turns[:, k] + 0.0) + 2 * np.pi * self.whole[:, k]  # -1 - 0j is counted as pi
        return out

    def angular(self, link: str, order: int = 1) -> Reals:
        """The angular velocity (1), acceleration (2) or jerk (3) of a link; (rows,)."""
        self._ordered(order)
        out: Reals = self.rates[order - 1, :, self._link(link)] if order else self.angle(link)
        return out

    def point(self, name: str | Named, order: int = 0) -> Reals:
        """A named point or a joint: its position, or its velocity (1), acceleration (2), jerk (3); (rows, 2).

        A joint is seen as a point of its link at the frame, else of the link named first.
        """
        z = self.complex_point(name, order)
        return np.stack([z.real, z.imag], axis=1)

    def complex_point(self, name: str | Named, order: int = 0) -> Complexes:
        """`point` as x + iy; (rows,)."""
        self._ordered(order)
        place = name if isinstance(name, Named) else self.linkage.named(name)[-1]
        k = self._link(place.link)
        arm = self.turns[:, k] * complex(place.x, place.y)
        if order == 0:
            return self.places[0, :, k] + arm
        w = self.rates[0, :, k]
        if order == 1:
            factor = 1j * w
        elif order == 2:
            factor = 1j * self.rates[1, :, k] - w**2
        else:
            factor = 1j * (self.rates[2, :, k] - w**3) - 3 * w * self.rates[1, :, k]
        return self.places[order, :, k] + factor * arm

    def slide(self, joint: str | int, order: int = 0) -> Reals:
        """The way of a sliding joint from the first link's point to the second's, or its derivative; (rows,)."""
        from gruebler.kinematics.ways import slide

        return slide(self, joint, order)

    def home(self, row: int = 0) -> dict[str, Place]:
        """Where the links lie in a row, as a home for `Linkage.with_home`."""
        return {
            link: Place(float(z.real), float(z.imag), float(self.angle(link)[row]))
            for link in self.linkage.mechanism.chain.links
            for z in [self.places[0, row, self._link(link)]]
        }

    @cached_property
    def closure(self) -> float:
        """The largest distance by which a joint of any pose is open, relative to the linkage's size."""
        from gruebler.kinematics.openness import openness

        return openness(self)

    @property
    def branch(self) -> tuple[str, ...]:
        """The assembly mode at the start, as `move` understands it."""
        from gruebler.kinematics.branches import branch_of

        return branch_of(self.plan, self.roots[0], self.unknowns[0], self.drives[0])

    def _repr_svg_(self) -> str | None:
        """The first pose with some others thinly, for notebooks."""
        return views.picture(self) if views.picture else None

    def _link(self, link: str) -> int:
        links: Sequence[str] = self.plan.lower.mechanism.chain.links
        if link not in links:
            known = self.linkage.mechanism.chain.links
            raise LinkageError(f"there is no link {link!r}{nearest(link, known)}; the links are {', '.join(known)}")
        return links.index(link)

    def _ordered(self, order: int) -> None:
        if not 0 <= order <= self.order:
            raise LinkageError(
                f"this motion was solved up to order {self.order}; for order {order} ask move(..., order={order})"
                if 0 <= order <= 3
                else f"the order of a derivative is 0, 1, 2 or 3, not {order!r}"
            )
