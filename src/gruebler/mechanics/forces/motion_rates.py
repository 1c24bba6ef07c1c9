"""The velocities of a motion for other speeds of its drives."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.forces.acting import Rows
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.branches import branch_of
from gruebler.mechanics.kinematics.solve import move_quietly

_TELLS = 1e-9  # a smaller root does not tell the assembly mode: its sign is rounding


def with_velocities(motion: Motion, speed: Reals, order: int = 1) -> Iterator[tuple[Rows, Motion]]:
    """The poses of a motion once more, with rates for other speeds, (drives,) or (rows, drives).

    They go from the row that is best assembled to its end, and back.

    Yields rows and their motion. A row at a limit of the drive tells no assembly mode, so it is not begun there;
    nothing is yielded if all rows are such, or change points.
    """
    branching = motion.plan.branching
    margins = np.abs(motion.roots[:, branching]).min(axis=1, initial=1.0)
    best = int(np.argmax(margins))
    if not margins[best] > _TELLS:
        return
    branch = branch_of(motion.plan, motion.roots[best], motion.unknowns[best], motion.drives[best])
    for rows in (np.arange(best, len(motion)), np.arange(best, -1, -1)):
        own = speed[rows] if speed.ndim == 2 else speed
        moved = move_quietly(motion.plan, motion.drives[rows], speed=own, order=order, branch=branch)
        yield rows[: len(moved)], moved
