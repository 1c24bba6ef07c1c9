"""How far the drive of a linkage in space goes: a full turn, or to where the motion ends on both sides."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.following import setting
from gruebler.mechanics.space.motion import SpatialMotion, SpatialStop
from gruebler.mechanics.space.moving import moved

RANGE_OF_ONE = message("a range needs one drive, but the mechanism has {count}: {drives}")
_ROWS = 72  # of a turn, or of as many sizes of a slide


@dataclass(frozen=True, kw_only=True)
class SpatialRange:
    """Between which values the drive moves from the reference pose, and why it ends there."""

    low: float
    high: float
    """Radians or lengths."""
    full: bool
    """Whether the drive turns fully."""
    stops: tuple[SpatialStop | None, SpatialStop | None]
    """Where it ends below and above; None where it was not followed farther: a slide to three sizes of the linkage."""

    def inside(self, count: int, share: float = 1e-3) -> Reals:
        """Values evenly from end to end, ends that are stops left out by a share of the range."""
        gap = share * (self.high - self.low)
        low, high = (0.0 if stop is None else gap for stop in self.stops)
        return np.linspace(self.low + low, self.high - high, count)


def spatial_range(linkage: SpatialLinkage) -> SpatialRange:
    """The range of the one drive of a linkage, followed from its reference pose upwards and downwards.

    Raises `LinkageError` for a linkage with several drives or none, or whose drive does not fix the motion.
    """
    drives = linkage.mechanism.drives
    if len(drives) != 1:
        raise LinkageError(RANGE_OF_ONE.filled(count=len(drives), drives=", ".join(linkage.mechanism.drive_names())))
    turning = drives[0].turning
    most = 2 * pi if turning else 3 * linkage.size
    steps = np.linspace(0.0, most, _ROWS + 1)[:, None]
    still = np.zeros((0, *steps.shape))
    up = moved(setting(linkage), steps, still)
    if turning and up.complete:
        return SpatialRange(low=0.0, high=2 * pi, full=True, stops=(None, None))
    down = moved(setting(linkage), -steps, still)
    ends = [-most if down.stop is None else down.stop.drives[0], most if up.stop is None else up.stop.drives[0]]
    return SpatialRange(low=ends[0], high=ends[1], full=False, stops=(down.stop, up.stop))


def followed(linkage: SpatialLinkage, values: Reals, order: int = 0, speed: ArrayLike = 1.0) -> SpatialMotion:
    """The motion over values of the drives, (rows, drives), reached from the reference pose; only those rows.

    Derivatives up to the order are those by the drives' common time, in which each has the speed, a number for all or
    for each.

    Raises `LinkageError` if one of them cannot be reached.
    """
    path = np.concatenate([np.zeros((1, values.shape[1])), values])
    rates = np.zeros((order, *path.shape))
    rates[:1] = speed
    motion = moved(setting(linkage), path, rates)
    if motion.stop is not None:
        raise LinkageError("{reason}", reason=motion.stop.message)
    return replace(
        motion,
        drives=motion.drives[1:],
        poses=motion.poses[:, 1:],
        unknowns={key: each[:, 1:] for key, each in motion.unknowns.items()},
        derivatives=motion.derivatives[1:],
        passed=tuple(row - 1 for row in motion.passed if row),
    )
