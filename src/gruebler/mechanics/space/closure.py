"""How far a tree of joints is open, with its derivatives, and its motion: what the core computes.

Every row is a wrench, every unknown a twist about the origin: the derivative of a row by an unknown is the product of
the two if the joint lies between the row's frames. Rates of any order come from power series with the same derivatives
(docs/theory/space.md).
"""

from __future__ import annotations

from collections.abc import Collection
from copy import copy
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Reals
from gruebler.mechanics.space.rods import rod_tables
from gruebler.mechanics.space.tables import tables_of
from gruebler.mechanics.space.tree import ClosureTree


class Place(NamedTuple):
    """A position: unknowns, and from where the turns of balls are counted, (balls, 3, 3)."""

    q: Reals
    turns: Reals


@dataclass(frozen=True, eq=False, kw_only=True)
class FollowedRows:
    """What the core tells of the rows of a path; rows that were not reached are left out."""

    series: Reals
    """(orders + 1, rows, unknowns) of the unknowns, power series in time."""
    poses: Reals
    """(orders + 1, rows, links, 4, 4) and their time derivatives."""
    derivatives: Reals
    """(rows, conditions, passive unknowns)"""
    passed: list[int]
    """Rows before which a change of mode was passed: the determinant of the derivatives has changed its sign."""
    end: float | None
    """Where on the path it ended, in rows; None if all of it was followed."""
    gap: float
    """By how much a row is open at most."""
    last: Place


class ClosingConditions:
    """The conditions of a tree as a function of its unknowns (n,), and of where the turns of balls are counted from."""

    def __init__(self, tree: ClosureTree, held: Collection[int] = ()) -> None:
        tables = tables_of(tree, frozenset())
        nodes, frames = tables.nodes, list(tables.frames)
        still = [(-1, 0, 0, 1, -1, -1)] * sum(place is not None for place in tree.links)
        self.links = np.full(len(tree.links), -1, np.int64)
        for link, place in enumerate(tree.links):
            if place is not None:
                self.links[link] = len(frames)
                still[len(frames) - len(nodes)] = (tables.node_of[place.node], 0, 0, 1, -1, -1)
                frames.append(place.at)
        pitches = np.zeros(len(frames))
        pitches[list(tables.node_of)] = [node.travel for node in tree.nodes]
        gears = np.zeros((len(tree.gears), tree.unknowns))
        for k, gear in enumerate(tree.gears):
            for joint, weight in gear.turns:
                gears[k, tree.unknown[joint, "Rz"]] += weight
        nodes = np.concatenate([nodes, np.array(still, np.int64).reshape(-1, 6)])
        starts = [k for k, row in enumerate(nodes) if row[5] >= 0 and not {*range(row[4], row[4] + 3)} & {*held}]
        nodes[:, 5] = -1
        nodes[starts, 5] = np.arange(len(starts))
        self.tree = tree
        self.balls = [int(nodes[k, 4]) for k in starts]
        """The first unknown of each ball whose turns are counted anew on the way."""
        self._rods = rod_tables(tree)
        self._tables = (nodes, tables.rows, np.array(frames), pitches, tables.lengths, gears)

    @property
    def reference(self) -> Place:
        """The reference pose."""
        return Place(np.zeros(self.tree.unknowns), np.tile(np.eye(3), (len(self.balls), 1, 1)))

    @property
    def units(self) -> Reals:
        """What a unit of each unknown is: a radian, or the size."""
        return np.array([1.0 if node.turn else self.tree.scale for node in self.tree.nodes[1:]])

    def shrunk(self) -> ClosingConditions | None:
        """With all dimensions shrunk to 0: of lengths only shifts are left. None with rods and round contours."""
        nodes, rows, frames, pitches, lengths, gears = self._tables
        if lengths.any():
            return None
        at_origin = frames.copy()
        at_origin[:, :3, 3] = 0.0
        other = copy(self)
        other._tables = (nodes, rows, at_origin, 0.0 * pitches, lengths, gears)
        return other

    @property
    def conditions(self) -> int:
        """How many rows there are, those of wheels too."""
        return len(self._tables[1]) + len(self.tree.gears)

    def linearised(self, place: Place) -> tuple[Reals, Reals]:
        """By how much the conditions are open (conditions,), the derivatives (conditions, unknowns)."""
        return _core.open_linkage(*self._tables, place.q, place.turns)

    def follow(
        self,
        passive: NDArray[np.intp],
        drives: NDArray[np.intp],
        values: Reals,
        rates: Reals,
        start: Place | None = None,
    ) -> FollowedRows:
        """Follow values (rows, drives) from a position; rates are coefficients (orders, rows, drives)."""
        start = self.reference if start is None else start
        series, poses, derivatives, passed, rows, part, gap, *last = _core.follow_linkage(
            *self._tables,
            start.q,
            start.turns,
            passive.astype(np.int64),
            drives.astype(np.int64),
            self.links,
            *self._rods,
            np.array([self.tree.scale, *self.tree.linkage.centre]),
            np.ascontiguousarray(values),
            np.ascontiguousarray(rates),
        )
        return FollowedRows(
            series=series[:, :rows],
            poses=poses[:, :rows],
            derivatives=derivatives[:rows],
            passed=np.flatnonzero(passed).tolist(),
            end=None if rows == len(values) else rows - 1 + part,
            gap=gap,
            last=Place(*last),
        )
