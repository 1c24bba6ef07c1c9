"""The motion of one link as another link sees it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.jets import turn_derivative, turned_derivative
from gruebler.base.text import message
from gruebler.mechanics.kinematics import Motion

_FAR = 1e10  # sizes of the linkage: poles further off have lost ten of their digits, and are told as directions
_STILL = 1e-12  # velocities below this part of the largest in the row are roundings
_ORDERS = (message("positions"), message("velocities"), message("accelerations"), message("jerks"))


@dataclass(frozen=True, slots=True, kw_only=True)
class RelativeMotion:
    """Places of a link in the coordinates of another one, with time derivatives; points are x + iy."""

    places: Complexes
    """(order + 1, rows): the link's origin and its derivatives."""
    turn: Complexes
    """(rows,): cosine + i sine of the link's angle."""
    rates: Reals
    """(order, rows): angular velocity, acceleration, jerk."""
    size: float
    """A length of the order of the linkage."""
    swiftest: Reals
    """(rows,): the largest velocity of the two links, of their origins or of points one size away."""

    def complex_point(self, arm: complex, *, order: int = 0) -> Complexes:
        """A point of the link, or a derivative, as x + iy; (rows,)."""
        return np.asarray(self.places[order] + turn_derivative(self.rates, order) * self.turn * arm)

    @property
    def pole(self) -> Complexes:
        """The instant centre; NaN where it lies at infinity (further than 1e10 sizes of the linkage) or is no point."""
        velocity, rate = self.places[1], self.rates[0]
        resting, far = resting_and_translating(np.abs(velocity), np.abs(rate) * self.size, self.swiftest)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(np.where(resting | far, np.nan, self.places[0] + 1j * velocity / rate))


def relative_motion(motion: Motion, link: str, reference: str | None = None, order: int = 1) -> RelativeMotion:
    """How a link moves against another one (without a name: the frame), up to an order of derivatives.

    >>> from gruebler.mechanics.kinematics import move
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> seen = relative_motion(move(FourBar(25, 70, 40, 70).linkage(), [0.0, 0.1], speed=10), "frame", "crank")
    >>> seen.rates[0].tolist()
    [-10.0, -10.0]
    """
    if motion.order < order:
        raise LinkageError(
            "this needs {derivatives}, but the motion was solved up to order {solved}: call move(..., speed=..., "
            "order={order})",
            derivatives=_ORDERS[order],
            solved=motion.order,
            order=order,
        )
    fixed = motion.linkage.mechanism.frame if reference is None else reference
    m, r = (motion.link_index(name) for name in (link, fixed))
    if m == r:
        raise LinkageError("a link does not move against itself: {link!r} is given twice", link=link)
    back = np.conj(motion.turns[:, r])
    gaps = motion.places[:, :, m] - motion.places[:, :, r]
    places = [back * turned_derivative(-motion.rates[:, :, r], gaps, k) for k in range(order + 1)]
    rates = motion.rates[:order, :, m] - motion.rates[:order, :, r]
    size, both = motion.linkage.size, [m, r]
    swiftest = np.maximum(np.abs(motion.places[1][:, both]), np.abs(motion.rates[0][:, both]) * size).max(axis=1)
    return RelativeMotion(
        places=np.array(places), turn=motion.turns[:, m] * back, rates=rates, size=size, swiftest=swiftest
    )


def resting_and_translating(speed: Reals, turning: Reals, swiftest: Reals) -> tuple[Flags, Flags]:
    """Which relative velocities of links are roundings only, and which are translations; all in length per time."""
    resting = np.maximum(speed, turning) <= _STILL * swiftest
    return resting, ~resting & (turning * _FAR <= speed)
