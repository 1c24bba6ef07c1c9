"""Where the laws of cams and Geneva drives pass from one piece to the next."""

from __future__ import annotations

from math import pi

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.kinematics.contacts import Condition
from gruebler.mechanics.kinematics.law_directions import law_direction
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
    plan = cycle.plan
    for condition in laws:
        seen = law_direction(plan, motion.places[0], motion.turns, condition)
        for angle in sorted({joint % (2 * pi) for joint in condition.law.joints}):
            against = seen * np.exp(-1j * angle)
            above = against.imag >= 0
            cells = np.flatnonzero((above[:-1] != above[1:]) & (against.real[:-1] > 0))
            low, high = grid[cells], grid[cells + 1]

            def off(drives: Reals, condition: Condition = condition, angle: float = angle) -> Reals:
                there = cycle.at(drives, 0)
                seen = law_direction(plan, there.places[0], there.turns, condition)
                return np.asarray((seen * np.exp(-1j * angle)).imag)

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
