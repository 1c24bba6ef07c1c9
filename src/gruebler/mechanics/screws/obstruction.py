"""What stays open of the redundant constraints near a pose, as a function of its velocities (Lyapunov and Schmidt)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.instant_mobility import InstantMobility

_SHORT, _ROUNDING = 1e-13, 1e-15  # sizes and radians: a step, and what is open, that are rounding
_NOISE = 1e-6  # second derivatives: differences of values known to some 1e-15 over steps of 1e-3 err by 1e-9 at most


class NearbyPose(NamedTuple):
    """A motion from the pose in which all but the redundant constraints are closed."""

    motion: Reals
    value: Reals
    """F: what is open of the redundant ones, (redundancy,)."""
    slope: Reals
    """dF/dk, (redundancy, mobility)."""


class ObstructionMap:
    """The map F: what stays open of the redundant constraints when all others are closed and k is held."""

    def __init__(self, instant: InstantMobility) -> None:
        self.instant = instant
        self._independent = instant.left[:, : instant.rank].T

    def __call__(self, k: Reals) -> NearbyPose | None:
        """The point over k, or None if Newton's method does not close the other constraints so far away."""
        instant = self.instant
        motion = k @ instant.motions
        for _ in range(15):
            value, by_motion = instant.closing.along(instant.pose, motion)
            matrix = np.vstack([self._independent @ by_motion, instant.motions])
            rest = np.append(self._independent @ value, np.zeros(instant.mobility))
            held = np.vstack([np.zeros((instant.rank, instant.mobility)), np.eye(instant.mobility)])
            try:
                solved = np.linalg.solve(matrix, np.column_stack([rest, held]))
            except np.linalg.LinAlgError:
                return None
            step = solved[:, 0]
            if abs(step).max() < _SHORT or abs(rest).max() < _ROUNDING:
                return NearbyPose(motion, instant.stresses @ value, instant.stresses @ by_motion @ solved[:, 1:])
            motion = motion - step
            if not abs(motion).max() < 3:
                return None
        return None

    def second(self, step: float = 1e-3) -> Reals | None:
        """The quadratic forms of the second order, (redundancy, mobility, mobility): F(k) = k·Q·k / 2 + ..."""
        ahead = [(self(step * k), self(-step * k)) for k in np.eye(self.instant.mobility)]
        if any(nearby_pose is None or second is None for nearby_pose, second in ahead):
            return None
        slopes = [(first.slope - second.slope) / (2 * step) for first, second in ahead if first and second]
        forms = np.stack(slopes, axis=2)
        forms = (forms + np.swapaxes(forms, 1, 2)) / 2
        forms[abs(forms) < _NOISE] = 0.0
        return forms
