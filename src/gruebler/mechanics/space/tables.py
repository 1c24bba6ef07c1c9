"""A closure tree as tables for the core: what moves what, what closes, and the dimensions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.mechanics.space.tree import ACROSS, LENGTH, OFFSET, ClosureTree, Dimension, FrameOn


@dataclass(frozen=True, eq=False, kw_only=True)
class TreeTables:
    """The nodes and rows of a tree; a dimension is a node of its own, which stands still."""

    nodes: NDArray[np.int64]
    """(nodes, 6): parent; 0 stands still, 1 turns, 2 shifts, 3 screws; axis; sign; unknown or -1; ball or -1."""
    rows: NDArray[np.int64]
    """(rows, 5): 0 offset, 1 across, 2 length; first and second node; axis; other axis."""
    frames: Reals
    """(nodes, 4, 4) of the nodes that stand still."""
    lengths: Reals
    """(rows,)"""
    dimension: tuple[Dimension | None, ...]
    """Of each node the joint and link whose place it is."""
    node_of: tuple[int, ...]
    """The node of each node of the tree."""
    balls: int


def tables_of(tree: ClosureTree, held: frozenset[int]) -> TreeTables:
    """The tables of a tree; unknowns that are held are none, and the others are numbered anew."""
    passive = [k for k in range(tree.unknowns) if k not in held]
    column = {k: i for i, k in enumerate(passive)}
    rows: list[tuple[int, ...]] = []
    nodes: list[tuple[int, ...]] = [(-1, 0, 0, 1, -1, -1)]
    frames: list[Reals] = [np.eye(4)]
    dimension: list[Dimension | None] = [None]
    node_of, balls = [0], 0
    marks: dict[tuple[int, Dimension], int] = {}

    def still(parent: int, at: Reals, what: Dimension | None) -> int:
        if what is None:
            return parent
        nodes.append((parent, 0, 0, 1, -1, -1))
        frames.append(at)
        dimension.append(what)
        return len(nodes) - 1

    for k, node in enumerate(tree.nodes[1:], 1):
        parent = still(node_of[node.parent], node.still, node.dimension)
        begins_ball = k in tree.folds and all(j in column for j in range(k - 1, k + 2))
        kind = int(node.turn) + 2 * bool(node.travel)
        nodes.append((parent, kind, node.axis, int(node.sign), column.get(k - 1, -1), balls if begins_ball else -1))
        frames.append(np.eye(4))
        dimension.append(None)
        balls += begins_ball
        node_of.append(len(nodes) - 1)

    def mark(frame: FrameOn) -> int:
        if frame.dimension is None:
            return node_of[frame.node]
        key = (frame.node, frame.dimension)
        if key not in marks:
            marks[key] = still(node_of[frame.node], frame.at, frame.dimension)
        return marks[key]

    kinds = {OFFSET: 0, ACROSS: 1, LENGTH: 2}
    for row in tree.rows:
        rows.append((kinds[row.kind], mark(row.first), mark(row.second), row.axis, row.other))
    return TreeTables(
        nodes=np.array(nodes, np.int64),
        rows=np.array(rows, np.int64).reshape(-1, 5),
        frames=np.array(frames),
        lengths=np.array([row.length for row in tree.rows], float),
        dimension=tuple(dimension),
        node_of=tuple(node_of),
        balls=balls,
    )
