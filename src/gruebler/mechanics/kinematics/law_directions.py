"""Where the laws of cams, Geneva drives and non-circular wheels are looked up in poses."""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Complexes
from gruebler.mechanics.kinematics.contacts import Condition
from gruebler.mechanics.kinematics.kernel_records import MESH, POLAR
from gruebler.mechanics.kinematics.plan import Plan


def law_direction(plan: Plan, places: Complexes, turns: Complexes, condition: Condition) -> Complexes:
    """The argument of a law as a direction, as in the kernel `closure`; from (rows, links) origins and turns."""
    chain, (points, lines) = plan.lower.mechanism.chain, plan.element_arrays(plan.lower)
    links = [chain.index(plan.keys[side][1]) for side in condition.sides]
    at = [places[:, k] + turns[:, k] * points[side] for k, side in zip(links, condition.sides, strict=True)]
    along = [turns[:, k] * lines[side] for k, side in zip(links, condition.sides, strict=True)]
    gap = at[1] - at[0]
    if condition.kind == MESH:
        return np.asarray(along[0] * np.conj(gap) / np.abs(gap))
    if condition.kind == POLAR:
        return np.asarray(np.conj(along[0]) * gap / np.abs(gap))
    return np.asarray(-condition.values[1] * 1j * along[0] * np.conj(along[1]))
