"""The complex assembly modes of a planar truss by another method: solutions followed round loops of the dimensions.

Nothing here knows of matroids: the loops are closed by linear equations in the turns z and in 1/z, one solution is made
with its dimensions, and closed paths of the dimensions lead from it to others. What is found is a lower bound until it
stands still.
"""

from __future__ import annotations

import networkx as nx
import numpy as np

STEPS = 150


class Truss:
    """Links 0, 1, ..., simple joints, and the loops of a cycle basis."""

    def __init__(self, links: int, joints: list[tuple[int, int]]) -> None:
        self.links, self.joints = links, joints
        number = {frozenset(joint): k for k, joint in enumerate(joints)}
        self.signs = []
        for cycle in nx.cycle_basis(nx.Graph(joints)):
            row = np.zeros(len(joints))
            for u, v in zip(cycle, cycle[1:] + cycle[:1], strict=True):
                k = number[frozenset((u, v))]
                row[k] = 1 if joints[k] == (u, v) else -1
            self.signs.append(row)
        self.signs = np.array(self.signs)

    def closing(self, points):
        """The matrix of the loops for the points of each joint on its two links."""
        rows = np.zeros((len(self.joints), self.links), complex)
        for k, (u, v) in enumerate(self.joints):
            rows[k, u], rows[k, v] = points[k, 0], -points[k, 1]
        return self.signs @ rows

    def closed_points(self, turns, rng):
        """Random points with which the loops are closed at these turns."""
        ends = np.array(self.joints)
        slope = np.concatenate([self.signs * turns[ends[:, 0]], -self.signs * turns[ends[:, 1]]], axis=1)
        points = noise(rng, 2 * len(ends))
        points -= np.linalg.lstsq(slope, slope @ points)[0]
        return points.reshape(2, -1).T


def noise(rng, *shape):
    return rng.normal(size=shape) + 1j * rng.normal(size=shape)


def newton_step(first, second, turns, right=None):
    """One step for all solutions at once, with other matrices on the right where ``right`` gives them.

    turns: (solutions, links - 1), link 0 is not turned.
    """
    whole = np.concatenate([np.ones((len(turns), 1)), turns], axis=1)
    one, other = right or (first, second)
    miss = np.concatenate([whole @ one.T, (1 / whole) @ other.T], axis=1)
    slope = np.empty((len(turns), 2 * len(first), turns.shape[1]), complex)
    slope[:, : len(first)] = first[:, 1:]
    slope[:, len(first) :] = -second[:, 1:] / turns[:, None, :] ** 2
    return np.linalg.solve(slope, miss[:, :, None])[:, :, 0], miss


def follow(start, end, turns):
    """Solutions carried along a segment of the dimensions; those that arrive."""
    for k in range(1, STEPS + 1):
        first, second = ((1 - k / STEPS) * a + k / STEPS * b for a, b in zip(start, end, strict=True))
        with np.errstate(all="ignore"):
            for _ in range(3):
                turns = turns - newton_step(first, second, turns)[0]
                sizes = np.abs(turns)
                turns = turns[((sizes > 1e-6) & (sizes < 1e6)).all(axis=1)]
    return turns[np.abs(newton_step(first, second, turns)[1]).max(axis=1) < 1e-9]


def count_by_monodromy(links, joints, seed=1, quiet=12):
    """How many solutions loops of the dimensions lead to, until ``quiet`` loops in turn bring none."""
    rng = np.random.default_rng(seed)
    truss = Truss(links, [tuple(map(int, joint)) for joint in joints])
    turns = np.exp(noise(rng, links) / 2)
    turns[0] = 1
    home = tuple(truss.closing(truss.closed_points(z, rng)) for z in (turns, 1 / turns))
    known = turns[None, 1:]
    idle = 0
    while idle < quiet:
        away = [tuple(truss.closing(noise(rng, len(joints), 2)) for _ in range(2)) for _ in range(2)]
        found = follow(away[1], home, follow(away[0], away[1], follow(home, away[0], known)))
        fresh = [z for z in found if np.abs(known - z).max(axis=1).min() > 1e-6]
        distinct = []
        for z in fresh:
            if all(np.abs(z - other).max() > 1e-6 for other in distinct):
                distinct.append(z)
        known = np.concatenate([known, np.array(distinct)]) if distinct else known
        idle = 0 if distinct else idle + 1
    return len(known)
