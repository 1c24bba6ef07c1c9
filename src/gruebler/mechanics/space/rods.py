"""Rods between two balls: their spin is idle, and is fixed by a rule, the shortest turn from the reference pose.

With the directions u of the rod in the reference pose and v now, w = u × v and c = u · v, that turn is
1 + [w] + [w]² / (1 + c). It depends on v alone, not on the way there, and is not defined where v = -u.
"""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.space.power_series import product, reciprocal, vector_product
from gruebler.mechanics.space.tree import ClosureTree

_OPPOSITE = 1e-12


def place_rods(tree: ClosureTree, poses: Reals) -> None:
    """Put the rods into poses (..., links, 4, 4) of the other links."""
    place_rods_of_series(tree, poses[None])


def place_rods_of_series(tree: ClosureTree, poses: Reals) -> None:
    """Put the rods into power series of poses, (orders, ..., links, 4, 4)."""
    for rod in tree.rods:
        a, b = _ball(tree, rod.joints[0]), _ball(tree, rod.joints[1])
        now = [_seen(poses[..., link, :, :], p) for link, p in ((rod.first, a), (rod.second, b))]
        poses[..., rod.link, :, :] = _turned(*rod.balls, now[0], now[1])


def _ball(tree: ClosureTree, joint: int) -> Reals:
    at = (np.array(tree.linkage.places[joint].at) - tree.linkage.centre) / tree.linkage.size
    return np.asarray(at)


def _seen(poses: Reals, point: Reals) -> Reals:
    return np.asarray(poses[..., :3, :3] @ point + poses[..., :3, 3])


def _turned(a: Reals, b: Reals, first: Reals, second: Reals) -> Reals:
    """The series of poses that takes a and b to these points, (orders, ..., 3) each."""
    length = float(np.linalg.norm(b - a))
    u, v = (b - a) / length, (second - first) / length
    c = v @ u
    w = vector_product(np.broadcast_to(u, v.shape), v)
    below = c.copy()
    below[0] += 1
    below[0] = np.where(below[0] < _OPPOSITE, np.nan, below[0])
    k = np.zeros((*w.shape, 3))
    k[..., 2, 1], k[..., 0, 2], k[..., 1, 0] = w[..., 0], w[..., 1], w[..., 2]
    k = k - np.swapaxes(k, -1, -2)
    turn = k + product(product(k, k, np.matmul), reciprocal(below)[..., None, None], np.multiply)
    turn[0] += np.eye(3)
    pose = np.zeros((*w.shape[:-1], 4, 4))
    pose[..., :3, :3] = turn
    pose[..., :3, 3] = first - turn @ a
    pose[0, ..., 3, 3] = 1
    return pose
