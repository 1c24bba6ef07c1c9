"""Where along a motion a cam or a Geneva drive passes from one piece of its law to the next; docs/theory/events.md."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy as np

from gruebler.kinematics.contacts import MESH, POLAR, Condition
from gruebler.kinematics.motion import Complexes, Motion, Reals
from gruebler.kinematics.zeros import bracketed

if TYPE_CHECKING:
    from gruebler.kinematics.course import Course

__all__ = ["law_joints"]

_SAME = 1e-9  # of the range: joints of two laws that are nearer are one


def law_joints(course: Course) -> tuple[float, ...]:
    """Drive values at which derivatives may jump, in rising order; of full turns in the period from the grid on."""
    laws = [c for group in course.plan.conditions for c in group if c.law.joints]
    if not laws:
        return ()
    grid = course.grid
    motion = course.at(grid, 0)
    found: list[float] = []
    for condition in laws:
        seen = _direction(motion, condition)
        for angle in sorted({joint % (2 * pi) for joint in condition.law.joints}):
            against = seen * np.exp(-1j * angle)
            above = against.imag >= 0
            cells = np.flatnonzero((above[:-1] != above[1:]) & (against.real[:-1] > 0))
            low, high = grid[cells], grid[cells + 1]

            def off(drives: Reals, condition: Condition = condition, angle: float = angle) -> Reals:
                return np.asarray((_direction(course.at(drives, 0), condition) * np.exp(-1j * angle)).imag)

            found += bracketed(off, low, high).tolist() if len(cells) else []
    return _merged(sorted(found), _SAME * course.span.width, course.span.period)


def _merged(places: list[float], near: float, period: float) -> tuple[float, ...]:
    out: list[float] = []
    for place in places:
        if not out or place - out[-1] > near:
            out.append(place)
    if len(out) > 1 and out[0] + period - out[-1] <= near:
        out.pop()
    return tuple(out)


def _direction(motion: Motion, condition: Condition) -> Complexes:
    """The argument of a law as a direction, as in the kernel `closure`."""
    plan, chain = motion.plan, motion.plan.lower.mechanism.chain
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
