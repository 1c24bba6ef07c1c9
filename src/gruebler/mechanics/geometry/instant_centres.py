"""Instant centres of all pairs of links, and the centrodes that they draw."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.mechanics.geometry.relative import relative_motion, resting_and_translating
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages.points import link_number


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False)
class Poles:
    """The instant centres of all pairs of links, in coordinates of the frame as x + iy.

    A pair has a pole (``at``), or one at infinity (``direction``: the links translate against one another, at right
    angles to it), or none (both NaN: the links are at rest against one another, or no rates are known at the row).
    """

    links: tuple[str, ...]
    at: Complexes
    """(rows, links, links); NaN where the pole is no finite point."""
    direction: Complexes
    """(rows, links, links): unit; NaN where the pole is not at infinity. Its sign has no meaning."""

    def of(self, first: str, second: str) -> Complexes:
        """The pole of a pair of links; (rows,).

        >>> from gruebler.mechanics.kinematics import move
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> found = poles(move(FourBar(25, 70, 40, 70).linkage(), np.radians([55]), speed=10))
        >>> found.of("frame", "coupler").round(6)[0], found.of("crank", "rocker").round(6)[0]
        (np.complex128(127.802871+182.521416j), np.complex128(-64.233472+0j))
        """
        return self.at[:, link_number(first, self.links), link_number(second, self.links)]

    def towards(self, first: str, second: str) -> Complexes:
        """The direction of the pole of a pair of links where it lies at infinity, else NaN; (rows,)."""
        return self.direction[:, link_number(first, self.links), link_number(second, self.links)]

    @property
    def at_infinity(self) -> NDArray[np.bool_]:
        """(rows, links, links): which pairs translate against one another."""
        return np.isfinite(self.direction)


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False)
class Centrodes:
    """The curves that the pole of two links draws on each of them; they roll on one another without slip."""

    fixed: Complexes
    """(rows,): in coordinates of the reference link; NaN where the pole is at infinity."""
    moving: Complexes
    """(rows,): in coordinates of the moving link."""


def poles(motion: Motion, links: Sequence[str] | None = None) -> Poles:
    """The instant centres of all pairs of links at every row of a motion with velocities.

    Error: a pole at the distance R is as wrong as 1e-15 R/size of the rates are. Cost: about 0.1 us a pair and row.

    Raises `LinkageError` for a motion without velocities (give `move` a speed).
    """
    chosen = tuple(motion.linkage.mechanism.chain.links if links is None else links)
    numbers = [motion.link_index(link) for link in chosen]
    if not numbers:
        raise LinkageError("poles need at least one link, but none was named")
    if motion.order < 1:
        raise LinkageError("poles need velocities, but the motion has positions only: call move(..., speed=...)")
    z, velocity, rate = motion.places[0][:, numbers], motion.places[1][:, numbers], motion.rates[0][:, numbers]
    middle = z.mean(axis=1, keepdims=True)
    # The velocities of the points of all links that are at the middle: the pole is as far from it as they differ.
    there = velocity + 1j * rate * (middle - z)
    size = motion.linkage.size
    apart = there[:, :, None] - there[:, None, :]
    turning = rate[:, :, None] - rate[:, None, :]
    speed = np.abs(apart)
    swiftest = np.maximum(np.abs(there), np.abs(rate) * size).max(axis=1, initial=0.0)[:, None, None]
    resting, far = resting_and_translating(speed, np.abs(turning) * size, swiftest)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = np.where(resting | far, np.nan, middle[:, :, None] + 1j * apart / turning)
        direction = np.where(far, 1j * apart / speed, np.nan)
    return Poles(chosen, at, direction)


def centrodes(motion: Motion, link: str, reference: str | None = None) -> Centrodes:
    """The fixed and the moving centrode of a link against another one (without a name: the frame).

    >>> from gruebler.mechanics.kinematics import move
    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> cardan = move(SliderCrank(1, 1).linkage(), np.radians([20, 40]), speed=1)  # circle of 2 a, circle of a
    >>> found = centrodes(cardan, "coupler")
    >>> abs(found.fixed).round(12).tolist(), abs(found.moving).round(12).tolist()
    ([2.0, 2.0], [1.0, 1.0])
    """
    seen = relative_motion(motion, link, reference)
    return Centrodes(seen.pole, np.conj(seen.turn) * (seen.pole - seen.places[0]))
