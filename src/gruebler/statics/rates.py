"""The velocities of a motion for other speeds of its drives."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gruebler.kinematics import Motion, move
from gruebler.kinematics.branches import branch_of
from gruebler.statics.loads import Reals, Rows

__all__ = ["again"]


def again(motion: Motion, speed: Reals) -> Iterator[tuple[Rows, Motion]]:
    """The poses of a motion once more, with velocities: from the row that is best assembled to its end, and back.

    Yields rows and their motion. A row at a limit of the drive tells no assembly mode, so it is not begun there.
    """
    branching = [dyad.number for dyad in motion.plan.dyads if dyad.branching]
    best = int(np.argmax(np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0)))
    branch = branch_of(motion.plan, motion.roots[best], motion.unknowns[best], motion.drives[best])
    for rows in (np.arange(best, len(motion)), np.arange(best, -1, -1)):
        moved = move(motion.plan, motion.drives[rows], speed=speed, order=1, branch=branch)
        yield rows[: len(moved)], moved
