"""How far a tree of joints is open, with its derivatives, and where its links are.

Every row is a wrench, every unknown a twist about the origin: the derivative of a row by an unknown is the product of
the two if the joint lies between the row's frames (docs/theory/space.md).
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.mechanics.space.power_series import vector_product
from gruebler.mechanics.space.rods import place_rods
from gruebler.mechanics.space.tree import ACROSS, LENGTH, ClosureTree, whole_numbers


class ClosingConditions:
    """The rows of a tree as a function of its unknowns (n,), and of where the turns of balls are counted from."""

    def __init__(self, tree: ClosureTree) -> None:
        nodes, rows = tree.nodes, tree.rows
        self.tree = tree
        self.parent = whole_numbers([node.parent for node in nodes])
        self.still = np.array([node.still for node in nodes])
        self.axis = whole_numbers([node.axis for node in nodes])
        self.turn = np.array([node.turn for node in nodes])
        self.travel = np.array([node.travel for node in nodes])
        self.sign = np.array([node.sign for node in nodes])
        self.folds = tree.folds
        self._kind = whole_numbers([row.kind for row in rows])
        self._nodes = whole_numbers([row.first.node for row in rows]), whole_numbers([row.second.node for row in rows])
        self.marks = tuple(
            np.array([frame.at for frame in frames]).reshape(-1, 4, 4)
            for frames in ([row.first for row in rows], [row.second for row in rows])
        )
        self._axis = whole_numbers([row.axis for row in rows])
        self._other = whole_numbers([row.other for row in rows])
        self._length = np.array([row.length for row in rows])
        self._every = np.arange(len(rows))
        above = np.eye(len(nodes), dtype=bool)
        for k, parent in enumerate(self.parent.tolist()):
            if parent >= 0:
                above[k] |= above[parent]
        self._between = above[self._nodes[1]].astype(float) - above[self._nodes[0]]
        self.gears = np.zeros((len(tree.gears), tree.unknowns))
        for k, gear in enumerate(tree.gears):
            for joint, weight in gear.turns:
                self.gears[k, tree.unknown[joint, "Rz"]] += weight

    @property
    def unknowns(self) -> int:
        """How many values the tree has."""
        return len(self.parent) - 1

    @property
    def nodes_of_rows(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The nodes that carry the frames of each row, (rows,) each."""
        return self._nodes

    @cached_property
    def kinds(self) -> list[tuple[int, int, int, float]]:
        """Of each row its kind, its axes and its length."""
        return [(row.kind, row.axis, row.other, row.length) for row in self.tree.rows]

    def frames(self, q: Reals, still: Reals) -> Reals:
        """The frame (4, 4) of each node, (nodes, 4, 4)."""
        values = np.append(0.0, q) * self.sign
        cosines, sines = np.cos(values * self.turn), np.sin(values * self.turn)
        g = np.empty_like(still)
        g[0] = still[0]
        for k in range(1, len(g)):
            h = g[self.parent[k]] @ still[k]
            m = self.axis[k]
            if self.travel[k]:
                h[:3, 3] += self.travel[k] * values[k] * h[:3, m]
            if self.turn[k]:
                a, b = (m + 1) % 3, (m + 2) % 3
                first, second = h[:3, a].copy(), h[:3, b].copy()
                h[:3, a] = cosines[k] * first + sines[k] * second
                h[:3, b] = cosines[k] * second - sines[k] * first
            g[k] = h
        return g

    def twists(self, g: Reals) -> Reals:
        """The twist (6,) of each unknown about the origin, (unknowns, 6)."""
        axes = g[np.arange(len(g)), :3, self.axis] * self.sign[:, None]
        turns = axes * self.turn[:, None]
        return np.concatenate([turns, vector_product(g[:, :3, 3], turns) + axes * self.travel[:, None]], axis=1)[1:]

    def linearised(self, q: Reals, still: Reals) -> tuple[Reals, Reals, Reals]:
        """By how much the rows are open (rows,), the derivatives (rows, unknowns), the frames of the nodes."""
        g = self.frames(q, still)
        first, second = g[self._nodes[0]] @ self.marks[0], g[self._nodes[1]] @ self.marks[1]
        u = first[self._every, :3, self._axis]
        v = second[self._every, :3, self._other]
        gap = second[:, :3, 3] - first[:, :3, 3]
        across, length = (self._kind == ACROSS)[:, None], (self._kind == LENGTH)[:, None]
        scale = np.where(length, self._length[:, None], 1.0)
        force = np.where(across, 0.0, np.where(length, gap / scale, u))
        value = np.sum(np.where(across, u * v, force * gap), axis=1)
        value = np.where(self._kind == LENGTH, (value - self._length) / 2, value)
        moment = np.where(across, vector_product(v, u), vector_product(second[:, :3, 3], force))
        by_unknown = np.concatenate([moment, force], axis=1) @ self.twists(g).T * self._between[:, 1:]
        return np.append(value, self.gears @ q), np.vstack([by_unknown, self.gears]), g

    def folded(self, q: Reals, still: Reals) -> tuple[Reals, Reals]:
        """The same position, with the turns of balls and free bodies counted from here."""
        if not self.folds:
            return q, still
        g = self.frames(q, still)
        q, still = q.copy(), still.copy()
        for start in self.folds:
            above = g[self.parent[start]]
            still[start, :3, :3] = above[:3, :3].T @ g[start + 2, :3, :3]
            q[start - 1 : start + 2] = 0.0
        return q, still

    def poses(self, g: Reals) -> Reals:
        """The pose of each link, (..., links, 4, 4), from the frames of the nodes (..., nodes, 4, 4).

        A rod between two balls goes from the reference pose to where its ends are by the shortest turn.
        """
        tree = self.tree
        poses = np.zeros((*g.shape[:-3], len(tree.links), 4, 4))
        for link, place in enumerate(tree.links):
            if place is not None:
                poses[..., link, :, :] = g[..., place.node, :, :] @ place.at
        if tree.rods:
            place_rods(tree, poses)
        return poses
