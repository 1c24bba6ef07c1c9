"""The path of a point over the whole motion of a linkage, by a parameter in which it is smooth to the ends."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import asin, factorial, pi

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.analysis.drive_cycles import drive_cycle, path_cycle
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.points import PointLike, point_name

_CELLS = 360  # of the first grid, for each turn
_EDGE = 1e-3  # of the parameter: nearer to a limit of the drive the path is continued by its Taylor polynomial
_STILL = 1e-11  # sizes for each unit of the parameter: a point that is never faster does not move


@brief
@dataclass(frozen=True, repr=False)
class PointPath:
    """A path z(s). Of a drive that turns fully s is the drive's value, and the path is closed.

    Between limits it is s with drive = low + (high - low) sin^2(s/2), from 0 to pi: at a limit the pose grows as the
    square root of the drive's way, which is smooth in s.
    """

    cycle: Course
    place: LinkPoint

    @property
    def closed(self) -> bool:
        """Whether the drive turns fully and the path comes back."""
        return self.cycle.span.full

    @property
    def start(self) -> float:
        """The parameter at the beginning."""
        return float(self.cycle.grid[0]) if self.closed else 0.0

    @property
    def end(self) -> float:
        """The parameter at the end; of a closed path one period behind the beginning."""
        return self.start + self.cycle.span.period if self.closed else pi

    @property
    def size(self) -> float:
        """A length of the order of the linkage."""
        return self.cycle.size

    @cached_property
    def reach(self) -> float:
        """A length of the order of linkage and path: the larger of `size` and the path's extent."""
        z = self.at(self.grid, 0)[0]
        return max(self.size, float(np.ptp(z.real)), float(np.ptp(z.imag)))

    @cached_property
    def grid(self) -> Reals:
        """Parameters between which events are looked for."""
        if self.closed:
            return self.cycle.grid
        return pi * (np.arange(_CELLS) + 0.5) / _CELLS

    def drive(self, s: Reals) -> Reals:
        """The drive's values; of full turns from 0 to the period."""
        span = self.cycle.span
        if self.closed:
            return np.asarray(s % span.period)
        return np.asarray(span.low + span.width * np.sin(np.clip(s, 0, pi) / 2) ** 2)

    def parameter(self, drive: float, near: float) -> float:
        """The parameter of a drive value: of a closed path the one next to another parameter."""
        span = self.cycle.span
        if self.closed:
            return near + (drive - near + span.period / 2) % span.period - span.period / 2
        return 2 * asin(min(max((drive - span.low) / span.width, 0.0), 1.0) ** 0.5)

    def at(self, s: Reals, order: int = 3) -> Complexes:
        """The point and its derivatives by s; (order + 1, n)."""
        span = self.cycle.span
        if self.closed:
            motion = self.cycle.at(span.low + (s - span.low) % span.period, order)
            return np.array([motion.complex_point(self.place, order=k) for k in range(order + 1)])
        inside = np.clip(s, _EDGE, pi - _EDGE)
        beyond = s - inside
        upto = 3 if beyond.any() else order
        motion = self.cycle.at(self.drive(inside), upto)
        z = [motion.complex_point(self.place, order=k) for k in range(upto + 1)]
        derivatives = _by_parameter(z, span.width / 2 * np.sin(inside), span.width / 2 * np.cos(inside))
        for k in range(order + 1 if beyond.any() else 0):
            derivatives[k] = sum(derivatives[m] * beyond ** (m - k) / factorial(m - k) for m in range(k, upto + 1))
        return derivatives[: order + 1]


def _by_parameter(z: list[Complexes], first: Reals, second: Reals) -> Complexes:
    """The derivatives by s from those by the drive q; ``first`` is dq/ds, ``second`` its derivative."""
    derivatives = np.array(z)
    if len(z) > 1:
        derivatives[1] = z[1] * first
    if len(z) > 2:
        derivatives[2] = z[2] * first**2 + z[1] * second
    if len(z) > 3:
        derivatives[3] = z[3] * first**3 + 3 * z[2] * first * second - z[1] * first
    return derivatives


def point_path(
    linkage: Linkage, point: PointLike, *, branch: Branch = None, drives: ArrayLike | None = None
) -> PointPath:
    """The path of a point (`Linkage.points_named`) of a linkage with one drive, or along a path of its drives.

    Raises `LinkageError` for a point of the frame or one that does not move, and as
    `gruebler.mechanics.analysis.drive_cycle`.
    """
    frame = linkage.mechanism.frame
    places = [place for place in linkage.points_named(point) if place.link != frame]
    shown = repr(point_name(point))
    if not places:
        raise LinkageError("the point {point} lies on the frame {frame!r}: it has no path", point=shown, frame=frame)
    cycle = drive_cycle(linkage, branch=branch) if drives is None else path_cycle(linkage, drives, branch=branch)
    trail = PointPath(cycle, places[-1])
    if np.abs(trail.at(trail.grid, 1)[1]).max() <= _STILL * trail.size:
        raise LinkageError("the point {point} does not move: it has no path", point=shown)
    return trail
