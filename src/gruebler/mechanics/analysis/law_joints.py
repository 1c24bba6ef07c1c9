"""Where the laws of cams and Geneva drives pass from one piece to the next."""

from __future__ import annotations

from math import pi

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.kinematics.contacts import Condition
from gruebler.mechanics.kinematics.kernel_records import MESH, POLAR
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.root_finding import bracketed_root

_SAME = 1e-9  # of the range: joints of two laws that are nearer are one


def law_joints(cycle: Course) -> tuple[float, ...]:
    """Drive values at which derivatives may jump, in rising order; of full turns in the period from the grid on."""
    laws = [c for group in cycle.plan.conditions for c in group if c.law.joints]
    if not laws:
        return ()
    grid = cycle.grid
    motion = cycle.at(grid, 0)
    joints: list[float] = []
    for condition in laws:
        seen = _direction(motion, condition)
        for angle in sorted({joint % (2 * pi) for joint in condition.law.joints}):
            against = seen * np.exp(-1j * angle)
            above = against.imag >= 0
            cells = np.flatnonzero((above[:-1] != above[1:]) & (against.real[:-1] > 0))
            low, high = grid[cells], grid[cells + 1]

            def off(drives: Reals, condition: Condition = condition, angle: float = angle) -> Reals:
                return np.asarray((_direction(cycle.at(drives, 0), condition) * np.exp(-1j * angle)).imag)

            joints += bracketed_root(off, low, high).tolist() if len(cells) else []
    return _merged(sorted(joints), _SAME * cycle.span.width, cycle.span.period)


def _merged(places: list[float], near: float, period: float) -> tuple[float, ...]:
    merged: list[float] = []
    for place in places:
        if not merged or place - merged[-1] > near:
            merged.append(place)
    if len(merged) > 1 and merged[0] + period - merged[-1] <= near:
        merged.pop()
    return tuple(merged)


def _direction(motion: Motion, condition: Condition) -> Complexes:
    """The argument of a law as a direction, as in the kernel `closure`."""
    plan, chain = motion.plan, motion.lower_linkage.mechanism.chain
    points, lines = plan.element_arrays(plan.lower)
    turns, places, along = [], [], []
    for side in condition.sides:
        k = chain.index(plan.keys[side][1])
        turns.append(motion.turns[:, k])
        places.append(motion.places[0, :, k] + motion.turns[:, k] * points[side])
        along.append(motion.turns[:, k] * lines[side])
    gap = places[1] - places[0]
    if condition.kind == MESH:
        return np.asarray(along[0] * np.conj(gap) / np.abs(gap))
    if condition.kind == POLAR:
        return np.asarray(np.conj(along[0]) * gap / np.abs(gap))
    return np.asarray(-condition.values[1] * 1j * along[0] * np.conj(along[1]))
