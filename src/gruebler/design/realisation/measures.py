"""The distance of the poses of a linkage from singular ones: a number for each row, 0 where assembly modes meet.

For a dyad it is the sine of its transmission angle, or its equivalent; for a larger group the smallest singular
value of its closing conditions (docs/theory/realisation.md).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.mechanics.kinematics.contacts import Condition
from gruebler.mechanics.kinematics.kernel_records import PIN
from gruebler.mechanics.kinematics.plan import Plan

if TYPE_CHECKING:
    from gruebler.mechanics.kinematics.kernel_records import Program

_ARM = 0.3  # the length by which angles are multiplied, in parts of the size
_SCALE = 2.0  # a larger group: singular value to sine
_SHORT = 1 / 3  # distances of a dyad below this part of the size count as short


def conditioning(plan: Plan, program: Program, places: Complexes, turns: Complexes, roots: Reals) -> Reals:
    """The smallest measure of all groups in each row, 0 to 1; (rows,).

    Args:
        plan: the order of solving.
        program: its arrays, with the dimensions.
        places: (rows, links) origins, as x + iy.
        turns: (rows, links) cosine + i sine of the angles.
        roots: (rows, dyads) as `Motion.roots`.
    """
    worst = np.ones(len(turns))
    for dyad in plan.dyads:
        sines = np.abs(roots[:, dyad.number])
        worst = np.minimum(worst, sines / _SHORT if dyad.form.root_is_distance else sines)
    if plan.conditions:
        points = places[:, program.links] + turns[:, program.links] * program.points
        lines = turns[:, program.links] * program.lines
        for conditions, group in zip(plan.conditions, plan.higher_groups, strict=True):
            matrix = _closing(conditions, len(group.roots), points, lines, _ARM * program.size)
            worst = np.minimum(worst, _SCALE * np.linalg.svd(matrix, compute_uv=False)[:, -1])
    return worst


def _closing(conditions: Sequence[Condition], bodies: int, points: Complexes, lines: Complexes, arm: float) -> Reals:
    """The derivative of the closing conditions by the motion of the bodies: (rows, 3 bodies, 3 bodies).

    A body moves by the velocity of the mean of its joints and by its angular velocity times `arm`.
    """
    sides = [pair for c in conditions for pair in zip(c.owners, c.sides, strict=True)]
    centres = [np.mean([points[:, e] for body, e in sides if body == k], axis=0) for k in range(bodies)]
    matrix = np.zeros((len(points), 3 * bodies, 3 * bodies))
    row = 0
    for condition in conditions:
        kind, (a, b), (first, second) = condition.kind, condition.sides, condition.owners
        for body, sign in ((first, -1.0), (second, 1.0)):
            if body < 0:
                continue
            lever = (points[:, a if kind != PIN else b] - centres[body]) * 1j / arm
            if kind == PIN:
                matrix[:, row, 3 * body] = matrix[:, row + 1, 3 * body + 1] = sign
                matrix[:, row, 3 * body + 2], matrix[:, row + 1, 3 * body + 2] = sign * lever.real, sign * lever.imag
                continue
            normal = 1j * lines[:, a]
            matrix[:, row, 3 * body], matrix[:, row, 3 * body + 1] = sign * normal.real, sign * normal.imag
            matrix[:, row, 3 * body + 2] = sign * (normal.conjugate() * lever).real
            matrix[:, row + 1, 3 * body + 2] = sign
        row += 2
    return matrix
