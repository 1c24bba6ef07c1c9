"""Rates of any order of a closed linkage: its unknowns as power series in time, one matrix for every order.

Put q = q_0 + q_1 t + q_2 t^2 + ... through the closing conditions: the coefficient of t^k is J q_k and what lower
orders leave. So each order is one product with the same inverse of J, and no formula for accelerations or jerks is
needed. All rows of a motion are taken at once.
"""

from __future__ import annotations

from math import factorial

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.mechanics.space.closure import ClosingConditions
from gruebler.mechanics.space.power_series import cosine_and_sine, product
from gruebler.mechanics.space.rods import place_rods_of_series
from gruebler.mechanics.space.tree import ACROSS, LENGTH


def frames_of_series(closure: ClosingConditions, q: Reals, still: Reals) -> Reals:
    """Frames of the nodes, (orders, rows, nodes, 4, 4), for unknowns (orders, rows, unknowns)."""
    orders, rows, _ = q.shape
    g = np.zeros((orders, rows, len(closure.parent), 4, 4))
    g[0, :, 0] = np.eye(4)
    for k in range(1, g.shape[2]):
        h = g[:, :, closure.parent[k]] @ still[:, k]
        value = q[:, :, k - 1] * closure.sign[k]
        m = int(closure.axis[k])
        step = np.zeros((orders, rows, 4, 4))
        step[0] = np.eye(4)
        if closure.turn[k]:
            c, s = cosine_and_sine(value)
            a, b = (m + 1) % 3, (m + 2) % 3
            step[..., a, a], step[..., b, b], step[..., b, a], step[..., a, b] = c, c, s, -s
        step[..., m, 3] = closure.travel[k] * value
        g[:, :, k] = product(h, step, np.matmul)
    return g


def _dot(a: Reals, b: Reals) -> Reals:
    return np.asarray(np.sum(a * b, axis=-1))


def openings_of_series(closure: ClosingConditions, q: Reals, g: Reals) -> Reals:
    """By how much the rows are open, (orders, rows of the motion, rows of the closure)."""
    first_nodes, second_nodes = closure.nodes_of_rows
    first, second = g[:, :, first_nodes] @ closure.marks[0], g[:, :, second_nodes] @ closure.marks[1]
    gap = second[..., :3, 3] - first[..., :3, 3]
    value = np.zeros(gap.shape[:-1])
    for row, (kind, axis, other, length) in enumerate(closure.kinds):
        if kind == LENGTH:
            value[..., row] = product(gap[..., row, :], gap[..., row, :], _dot) / (2 * length)
        else:
            other_vector = second[..., row, :3, other] if kind == ACROSS else gap[..., row, :]
            value[..., row] = product(first[..., row, :3, axis], other_vector, _dot)
    return np.concatenate([value, q @ closure.gears.T], axis=-1)


def series_of_motion(
    closure: ClosingConditions, q: Reals, still: Reals, drives: Reals, solve: Reals, passive: NDArray[np.intp]
) -> Reals:
    """The unknowns as power series, (orders, rows, unknowns).

    Args:
        closure: the closing conditions.
        q: (rows, unknowns) closed positions.
        still: (rows, nodes, 4, 4) from where the turns of balls are counted.
        drives: (orders, rows, unknowns) the series of the unknowns that are given, 0 for the others.
        solve: (rows, passive unknowns, rows of the closure) the inverses of the derivatives.
        passive: the numbers of the other unknowns.
    """
    series = drives.copy()
    series[0] = q
    for k in range(1, len(series)):
        g = frames_of_series(closure, series[: k + 1], still)
        left = openings_of_series(closure, series[: k + 1], g)[k]
        series[k][:, passive] = -np.einsum("rpe,re->rp", solve, left)
    return series


def poses_of_series(closure: ClosingConditions, series: Reals, still: Reals) -> Reals:
    """The poses of all links and their time derivatives, (orders, rows, links, 4, 4)."""
    tree = closure.tree
    g = frames_of_series(closure, series, still)
    poses = np.zeros((*g.shape[:2], len(tree.links), 4, 4))
    for link, place in enumerate(tree.links):
        if place is not None:
            poses[:, :, link] = g[:, :, place.node] @ place.at
    if tree.rods:
        place_rods_of_series(tree, poses)
    for k in range(2, len(poses)):
        poses[k] *= factorial(k)
    return poses
