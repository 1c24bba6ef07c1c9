"""Where a free motion starts."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.branches import Unassembled
from gruebler.mechanics.kinematics.drive_rows import drive_path, warn_of_path
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose, pose_at_reference
from gruebler.mechanics.kinematics.solve import starting_configuration
from gruebler.mechanics.linkages.branch import Branch


def starting_pose(plan: Plan, branch: Branch, at: ArrayLike | None) -> tuple[Reals, ReferencePose]:
    """The drives at the start, and a pose of their branch from which the kernel can walk on."""
    if at is None and plan.lower.reference_pose is None:
        raise LinkageError("say where the free motion starts: at=, the values of the drives")
    if at is None:
        drives = pose_at_reference(plan, np.zeros(len(plan.linkage.mechanism.drives))).drives
    else:
        path = drive_path(plan, at)
        if not (np.abs(path) < 1e100).all():
            raise LinkageError("{name}: expected finite numbers, but found {value!r}", name="at", value=at)
        warn_of_path(plan, path)
        drives = path[0]
    try:
        signs, unknowns = starting_configuration(plan, drives, branch)
    except Unassembled:
        values = drive_values(plan.linkage, tuple(map(float, drives)))
        raise LinkageError("at {values} the linkage cannot be assembled", values=values) from None
    return drives, ReferencePose(drives, signs, unknowns)
