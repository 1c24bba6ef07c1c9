"""Mobility at a pose: the rank of the closing conditions there, and which of them are redundant."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.notebook import brief
from gruebler.mechanics.screws.closing import TINY, Closing

_STILL = 1e-7  # shares of unit vectors: a null space whose rank is decided at 1e-8 is known to some 1e-16/1e-8


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class InstantMobility:
    """The singular values of the constraints at a pose, and the spaces on either side of the gap among them."""

    closing: Closing
    pose: Reals
    """(n, 4, 4), lengths in sizes."""
    values: Reals
    """All singular values, the largest first: as many as the smaller of constraints and unknowns."""
    left: Reals
    right: Reals
    """The singular vectors: (constraints, constraints) by columns, (unknowns, unknowns) by rows."""
    tolerance: float
    """A singular value below tolerance times the largest counts as zero."""

    @cached_property
    def rank(self) -> int:
        """Independent constraints."""
        return int(np.sum(self.values > self.tolerance * max(self.values[0], TINY)))

    @property
    def constraints(self) -> int:
        """All constraints, the sum of u over the joints."""
        return self.closing.equations

    @property
    def mobility(self) -> int:
        """Independent velocities: b (n - 1) - rank."""
        return self.closing.unknowns - self.rank

    @property
    def redundancy(self) -> int:
        """Constraints that follow from the others."""
        return self.constraints - self.rank

    @property
    def gap(self) -> tuple[float, float]:
        """The smallest singular value that counts and the largest that does not, against the largest of all.

        The second is 0 if none is missing.
        """
        relative = self.values / max(self.values[0], TINY)
        below = float(relative[self.rank]) if self.rank < len(relative) else 0.0
        return (float(relative[self.rank - 1]) if self.rank else 0.0), below

    @property
    def motions(self) -> Reals:
        """An orthonormal basis of the velocities, (mobility, unknowns)."""
        return self.right[self.rank :]

    @property
    def stresses(self) -> Reals:
        """An orthonormal basis of the self-stresses, (redundancy, constraints)."""
        return self.left[:, self.rank :].T

    @cached_property
    def redundant(self) -> dict[int, int]:
        """For each joint that holds redundant constraints, how many of its own could be left out."""
        redundant = {}
        for joint in np.unique(self.closing.joint_of_row).tolist():
            stresses = self.stresses[:, self.closing.joint_of_row == joint]
            many = int(np.linalg.matrix_rank(stresses, tol=_STILL)) if stresses.size else 0
            if many:
                redundant[joint] = many
        return redundant

    @cached_property
    def immobile(self) -> tuple[int, ...]:
        """The joints between links that have the same velocity in every motion."""
        immobile = []
        twists = np.array([self.closing.twists(motion) for motion in self.motions])
        for joint in range(len(self.closing.mechanism.chain.joints)):
            ties = [tie for tie in self.closing.ties if tie.joint == joint]
            if not len(twists) or all(abs(twists[:, t.first] - twists[:, t.second]).max() < _STILL for t in ties):
                immobile.append(joint)
        return tuple(immobile)

    def stands_with(self, joints: Collection[int]) -> bool:
        """Whether nothing has a velocity while these joints are locked."""
        ties = [tie for tie in self.closing.ties if tie.joint in joints]
        twists = [self.closing.twists(motion) for motion in self.motions]
        across = [[tw[tie.first] - tw[tie.second] for tie in ties] for tw in twists]
        rates = np.array(across).reshape(len(twists), -1)
        return not twists or (rates.size > 0 and int(np.linalg.matrix_rank(rates, tol=_STILL)) == len(twists))


def instant_mobility(closing: Closing, pose: Reals, tolerance: float) -> InstantMobility:
    """The mobility at a pose. Cost cubic in the unknowns."""
    _, by_twist = closing.linearised(pose)
    left, values, right = np.linalg.svd(by_twist)
    return InstantMobility(closing=closing, pose=pose, values=values, left=left, right=right, tolerance=tolerance)
