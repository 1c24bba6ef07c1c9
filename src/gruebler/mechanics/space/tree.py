"""A spatial linkage cut open: a tree of joints, each a few turns and shifts, and rows that close what was cut."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import isfinite
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.screws.rigid_motions import inverse_motion
from gruebler.mechanics.screws.wheels import GearRow, gear_rows, is_gear
from gruebler.mechanics.space.bodies import Bodies, Rod, motions
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism.model import Drive

OFFSET, ACROSS, LENGTH = range(3)
"""Kinds of rows: a point offset along an axis of the first frame, an axis at right angles to an axis of the first
frame, the distance of two balls."""


Dimension = tuple[int, int]
"""A joint and a link that has it: where it lies on the link is free to choose. A body that rods hold has joint -1."""


class Tie(NamedTuple):
    """A joint between two of its links; rods between two balls are a tie of their own, without freedoms."""

    joint: int
    first: int
    second: int


@dataclass(frozen=True, eq=False, kw_only=True)
class TreeNode:
    """One turn, shift or screw of a joint in the tree."""

    parent: int
    still: Reals
    """The frame (4, 4) before it moves, seen from its parent's."""
    axis: int
    """0, 1, 2 for x, y, z."""
    turn: float
    """1 if it turns; 0."""
    travel: float
    """How far it shifts along its axis, in sizes for a unit of its value."""
    sign: float
    dimension: Dimension | None
    """Of which joint on which link `still` is a dimension; None where it is the identity for any dimensions."""


class FrameOn(NamedTuple):
    """A frame on a link: the node that carries it, where it is seen from there, and which dimension that is."""

    node: int
    at: Reals
    dimension: Dimension | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class ClosingRow:
    """A closing condition between frames on two links."""

    kind: int
    first: FrameOn
    second: FrameOn
    axis: int = 0
    other: int = 0
    length: float = 0.0


@dataclass(frozen=True, eq=False, kw_only=True)
class ClosureTree:
    """The nodes and rows of a linkage; lengths in units of its size, from its centre. TreeNode 0 is the frame."""

    linkage: SpatialLinkage
    nodes: tuple[TreeNode, ...]
    rows: tuple[ClosingRow, ...]
    gears: tuple[GearRow, ...]
    links: tuple[FrameOn | None, ...]
    """Where each link is; None for a rod."""
    rods: tuple[Rod, ...]
    bodies: Bodies
    unknown: dict[tuple[int, str], int]
    """The unknown of each freedom (joint, direction) in the tree, of the joint's first other link."""
    folds: tuple[int, ...]
    """The first nodes of balls and free bodies: three turns that are counted from where the path is."""
    drives: tuple[int, ...]
    """The unknowns of the drives."""
    signs: Reals
    """(drives,) 1, or -1 where the frame is the second link of the drive's joint."""

    @property
    def unknowns(self) -> int:
        """How many values the tree has."""
        return len(self.nodes) - 1

    @property
    def scale(self) -> float:
        """The length of a unit."""
        return self.linkage.size


@lru_cache(maxsize=64)
def closure_tree(linkage: SpatialLinkage) -> ClosureTree:
    """The tree of a linkage, in which drives, wheels and screws stay and joints with many freedoms are cut.

    Raises `LinkageError` for contacts that roll without being wheels on one carrier, for cones that slide on each other
    on a sphere, and for drives of joints that no tree holds together.

    Cost O(joints²).
    """
    return _Builder(linkage, {}, counted=False).tree()


def locked_tree(linkage: SpatialLinkage, locked: Mapping[int, float]) -> ClosureTree:
    """The tree with joints of one freedom held at values, in radians and sizes: their links are one body each.

    A leg between a cross joint and a ball is a rod there, since its positions are counted once.
    """
    return _Builder(linkage, locked, counted=True).tree()


class _Builder:
    """Makes a tree; used once."""

    def __init__(self, linkage: SpatialLinkage, locked: Mapping[int, float], *, counted: bool) -> None:
        mechanism = linkage.mechanism
        self.linkage, self.mechanism, self.chain = linkage, mechanism, mechanism.chain
        self.space = self.chain.space
        self.frames = linkage.frames.copy()
        if self.space is not Space.SPHERICAL:
            self.frames[:, :3, 3] = (self.frames[:, :3, 3] - linkage.centre) / linkage.size
        self.gears = gear_rows(linkage)
        self.bodies = Bodies(linkage, self.frames, locked)
        self.rods = self.bodies.rods(crosses=counted)
        root = TreeNode(parent=-1, still=np.eye(4), axis=0, turn=0.0, travel=0.0, sign=1.0, dimension=None)
        self.nodes: list[TreeNode] = [root]
        self.entries: dict[int, int] = {}
        self.places: list[FrameOn | None] = [None] * self.chain.n
        self.unknown: dict[tuple[int, str], int] = {}
        self.folds: list[int] = []

    def tree(self) -> ClosureTree:
        kept, cut = self._split()
        frame = self.chain.index(self.mechanism.frame)
        self.places[frame] = FrameOn(0, np.eye(4))
        self._grow(kept)
        rows = [row for tie in cut for row in self._closing(tie)]
        rows += [self._length(rod) for rod in self.rods]
        drives = [self._driven(drive) for drive in self.mechanism.drives if drive.joint not in self.bodies.held]
        return ClosureTree(
            linkage=self.linkage,
            nodes=tuple(self.nodes),
            rows=tuple(rows),
            gears=self.gears,
            links=tuple(self.places),
            rods=self.rods,
            bodies=self.bodies,
            unknown=self.unknown,
            folds=tuple(self.folds),
            drives=tuple(unknown for unknown, _ in drives),
            signs=np.array([sign for _, sign in drives]),
        )

    # --- what is cut -----------------------------------------------------------------------------------------------

    def _ties(self) -> list[Tie]:
        left_out = self.bodies.links_of_rods(self.rods)
        ties = []
        for number, joint in enumerate(self.chain.joints):
            if is_gear(self.linkage, number):
                continue
            first = self.chain.index(joint.links[0])
            for name in joint.links[1:]:
                second = self.chain.index(name)
                if not left_out & {first, second}:
                    ties.append(Tie(number, first, second))
        return ties

    def _split(self) -> tuple[list[Tie], list[Tie]]:
        """The ties of the tree, and those that are cut (Kruskal's method)."""
        held = {drive.joint for drive in self.mechanism.drives}
        held |= {joint for gear in self.gears for joint, _ in gear.turns}

        def cost(tie: Tie) -> tuple[bool, bool, bool, int]:
            pair = self.chain.joints[tie.joint].pair
            return tie.joint not in self.bodies.held, tie.joint not in held, not pair.has_pitch, pair.f(self.space)

        group = list(range(self.chain.n))
        kept: list[Tie] = []
        ties = self._ties()
        cut = [tie for tie in ties if self.chain.joints[tie.joint].pair.has_contours]
        for tie in sorted((tie for tie in ties if tie not in cut), key=cost):
            a, b = group[tie.first], group[tie.second]
            (cut if a == b else kept).append(tie)
            group = [a if g == b else g for g in group]
        for tie in cut:
            if tie.joint in held:
                raise LinkageError(
                    "{joint}: the drives and the bearings of wheels make a loop of their own; one of them follows from "
                    "the others",
                    joint=self.chain.joint_title(tie.joint),
                )
        return kept, cut

    # --- the tree --------------------------------------------------------------------------------------------------

    def _grow(self, kept: list[Tie]) -> None:
        left = list(kept)
        rod_links = self.bodies.links_of_rods(self.rods)
        while True:
            while True:
                reached = [t for t in left if (self.places[t.first] is None) != (self.places[t.second] is None)]
                if not reached:
                    break
                left.remove(reached[0])
                self._join(reached[0])
            free = [k for k, place in enumerate(self.places) if place is None and k not in rod_links]
            if not free:
                return
            self._float(free[0])

    def _join(self, tie: Tie) -> None:
        forward = self.places[tie.first] is not None
        link, other = (tie.first, tie.second) if forward else (tie.second, tie.first)
        start = self._on(link, tie.joint)
        if (held := self.bodies.held.get(tie.joint)) is not None:
            end = FrameOn(start.node, start.at @ (held if forward else inverse_motion(held)))
        else:
            end = self._moved(tie.joint, start, forward, known=True)
            self.entries[other] = tie.joint
        self.places[other] = FrameOn(end.node, end.at @ inverse_motion(self.frames[tie.joint]))

    def _moved(self, joint: int, start: FrameOn, forward: bool, known: bool) -> FrameOn:
        """Nodes for the freedoms of a joint; the frame that they carry."""
        pair = self.chain.joints[joint].pair
        steps = motions(pair, self.space)
        pitch = self.linkage.places[joint].pitch / self.linkage.size
        node, still, dimension = start
        for freedom in steps if forward else steps[::-1]:
            travel = 1.0 if freedom.travels else pitch if freedom.has_pitch else 0.0
            self.nodes.append(
                TreeNode(
                    parent=node,
                    still=still,
                    axis="xyz".index(freedom.axis),
                    turn=float(freedom.turns),
                    travel=travel,
                    sign=1.0 if forward else -1.0,
                    dimension=dimension,
                )
            )
            node, still, dimension = len(self.nodes) - 1, np.eye(4), None
            if known:
                self.unknown.setdefault((joint, str(freedom)), node - 1)
        if pair.is_ball:
            self.folds.append(node - 2)
        return FrameOn(node, still, dimension)

    def _float(self, link: int) -> None:
        """A body that only rods hold: free, from where it is."""
        joints = [k for k, joint in enumerate(self.chain.joints) if self.chain.links[link] in joint.links]
        at = np.eye(4)
        at[:3, 3] = np.mean(self.frames[joints, :3, 3], axis=0)
        still, node = at, 0
        dimension: Dimension | None = (-1, link)
        for axis, turn in ((0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)):
            self.nodes.append(
                TreeNode(
                    parent=node,
                    still=still,
                    axis=axis,
                    turn=float(turn),
                    travel=1.0 - turn,
                    sign=1.0,
                    dimension=dimension,
                )
            )
            node, still, dimension = len(self.nodes) - 1, np.eye(4), None
        self.folds.append(node - 2)
        self.places[link] = FrameOn(node, inverse_motion(at))

    # --- rows ------------------------------------------------------------------------------------------------------

    def _on(self, link: int, joint: int) -> FrameOn:
        place = self.places[link]
        assert place is not None  # every link but the rods is in the tree
        dimension = None if self.entries.get(link) == joint else (joint, link)
        return FrameOn(place.node, place.at @ self.frames[joint], dimension)

    def _closing(self, tie: Tie) -> Iterable[ClosingRow]:
        pair = self.chain.joints[tie.joint].pair
        first, second = self._on(tie.first, tie.joint), self._on(tie.second, tie.joint)
        free = pair.freedoms[self.space]
        if pair.has_contours:
            yield from self._contact(tie, first, second)
            return
        if pair.has_pitch or pair.has_body_between:  # their values are unknowns, and then nothing may move
            first, free = self._moved(tie.joint, first, True, known=False), ()
        turns = ["xyz".index(freedom.axis) for freedom in free if freedom.turns]
        shifts = {"xyz".index(freedom.axis) for freedom in free if freedom.travels}
        if self.space is Space.PLANAR:  # no joint leaves the plane
            shifts.add(2)
            across = [] if turns else [(0, 1)]
        elif not turns:
            across = [(0, 1), (0, 2), (1, 2)]
        elif len(turns) == 1:
            across = [(axis, turns[0]) for axis in range(3) if axis != turns[0]]
        else:
            across = [(turns[0], turns[1])] if len(turns) == 2 else []
        for axis, other in across:
            yield ClosingRow(kind=ACROSS, first=first, second=second, axis=axis, other=other)
        if self.space is not Space.SPHERICAL:
            for axis in range(3):
                if axis not in shifts:
                    yield ClosingRow(kind=OFFSET, first=first, second=second, axis=axis)

    def _contact(self, tie: Tie, first: FrameOn, second: FrameOn) -> Iterable[ClosingRow]:
        """Two round contours that slide on each other in a plane, or a round and a flat one.

        Two circles keep the distance of their centres; a flat contour keeps the other's centre at its height.
        """
        radii = self.linkage.places[tie.joint].radii
        assert radii is not None  # checked with the linkage
        r, s = (radius / self.linkage.size for radius in radii)
        at = -r if isfinite(r) else s  # along y: the centre of the first contour, else that of the second
        first = _shifted(first, at)
        second = _shifted(second, s if isfinite(s) else at)
        if not isfinite(s):
            first, second = second, first
        if self.space is Space.SPATIAL:
            for axis in (0, 1):
                yield ClosingRow(kind=ACROSS, first=first, second=second, axis=axis, other=2)
            yield ClosingRow(kind=OFFSET, first=first, second=second, axis=2)
        if isfinite(r) and isfinite(s):
            yield ClosingRow(kind=LENGTH, first=first, second=second, length=abs(r + s))
        else:
            yield ClosingRow(kind=OFFSET, first=first, second=second, axis=1)

    def _length(self, rod: Rod) -> ClosingRow:
        first, second = self._on(rod.first, rod.joints[0]), self._on(rod.second, rod.joints[1])
        length = float(np.linalg.norm(np.subtract(*rod.balls)))
        return ClosingRow(kind=LENGTH, first=first, second=second, length=length)

    # --- drives ----------------------------------------------------------------------------------------------------

    def _driven(self, drive: Drive) -> tuple[int, float]:
        joint = self.chain.joints[drive.joint]
        unknown = self.unknown.get((drive.joint, drive.direction))
        if unknown is None or joint.count > 1:
            raise LinkageError(
                "{joint}: only a joint of two links that is no rod's ball and no contact is driven in space",
                joint=self.chain.joint_title(drive.joint),
            )
        return unknown, -1.0 if joint.links[1] == self.mechanism.frame else 1.0


def _shifted(frame: FrameOn, along: float) -> FrameOn:
    """A frame moved along its y axis."""
    step = np.eye(4)
    step[1, 3] = along
    return FrameOn(frame.node, frame.at @ step, frame.dimension)
