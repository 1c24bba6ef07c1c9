"""Determinants of the larger groups in poses: one that goes through zero along a branch is a change point."""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.mechanics.kinematics.kernel_records import PIN
from gruebler.mechanics.kinematics.plan import HigherGroup, Plan


def determinants(plan: Plan, places: Complexes, turns: Complexes) -> Reals:
    """(rows, groups): of closing conditions by unknowns, lengths in sizes; from (rows, links) origins and turns.

    Groups with contacts are left out.
    """
    groups = [group for group in plan.higher_groups if not group.contacts]
    each = [np.linalg.det(_slopes(plan, group, places / plan.lower.size, turns)) for group in groups]
    return np.array(each).reshape(len(groups), len(places)).T


def _slopes(plan: Plan, group: HigherGroup, places: Complexes, turns: Complexes) -> Reals:
    """(rows, conditions, unknowns): how the conditions of a group change with x, y and angle of each body."""
    chain, (points, lines) = plan.lower.mechanism.chain, plan.element_arrays(plan.lower)
    count = len(group.roots)
    origins = np.append(places[:, [chain.index(root) for root in group.roots]], 0 * places[:, :1], axis=1)
    equations = []
    for condition in plan.conditions[group.number]:
        near, far = condition.sides
        first, second = (chain.index(plan.keys[side][1]) for side in condition.sides)
        there = places[:, second] + turns[:, second] * points[far] / plan.lower.size
        across = 1j * turns[:, first] * lines[near]
        for measure, turn in ((1, 0), (1j, 0)) if condition.kind == PIN else ((across, 0), (0 * across, 1)):
            row = np.zeros((len(places), count + 1, 3))  # the last is what is known
            for owner, sign in zip(condition.owners, (-1, 1), strict=True):
                row[:, owner, 0] = sign * np.real(measure)
                row[:, owner, 1] = sign * np.imag(measure)
                row[:, owner, 2] = sign * ((np.conj(measure) * 1j * (there - origins[:, owner])).real + turn)
            equations.append(row[:, :-1].reshape(len(places), -1))
    return np.stack(equations, axis=1)
