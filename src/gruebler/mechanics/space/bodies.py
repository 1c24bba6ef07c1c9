"""Links that locked joints make one body of, and bodies that are nothing but a rod between two balls.

Where positions are counted a leg between a cross joint and a ball is a rod, too, if the axis of the cross that is fixed
on it is at right angles to its line: then wherever its ends are at their distance, the cross closes (in two ways).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.screws.rigid_motions import exponential, inverse_motion
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.chain.spaces import Freedom, Space

_SQUARE = 1e-9  # the cosine of a right angle
_SHORTEST = 1e-9  # sizes: two balls nearer to each other than that are in one point, and no rod has its direction


@dataclass(frozen=True, eq=False, kw_only=True)
class Rod:
    """A body that only holds the distance of two balls: its first link, neighbours, joints."""

    link: int
    first: int
    second: int
    joints: tuple[int, int]
    balls: tuple[Reals, Reals]
    """Where the balls are in the coordinates of its first link."""
    cross: Cross | None = None
    """The cross joint at its first end, if that is no ball."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Cross:
    """A cross joint between a body and a rod."""

    frame: Reals
    """Of the joint on the body, in the coordinates of the reference pose."""
    on_rod: Reals
    """Of the joint on the rod, in the coordinates of its first link."""
    is_first: bool
    """Whether the rod is the joint's first link, so that the axis x of the joint is fixed on it; else y is."""


def motions(pair: Pair, space: Space) -> tuple[Freedom, ...]:
    """The freedoms of a pair in the order in which they follow each other from the first link to the second.

    Shifts are those along axes of the first link and come first; a pair with a body between its links has them one
    axis after the other.
    """
    free = pair.freedoms[space]
    if pair.has_body_between:
        return tuple(sorted(free, key=lambda freedom: freedom.axis))
    turns = tuple(freedom for freedom in free if freedom.turns)
    return tuple(freedom for freedom in free if freedom.travels) + turns


class Bodies:
    """The bodies of a linkage whose joints of these numbers are held at values, in radians and sizes."""

    def __init__(self, linkage: SpatialLinkage, frames: Reals, locked: Mapping[int, float]) -> None:
        self.linkage, self.frames = linkage, frames
        self.chain = linkage.mechanism.chain
        self.held = {joint: self._held_at(joint, value) for joint, value in locked.items()}
        """The motion of each locked joint from its first link to its second, in its own frame."""
        self.of = list(range(self.chain.n))
        """The body of each link: the lowest number of its links."""
        self.poses = np.tile(np.eye(4), (self.chain.n, 1, 1))
        """The pose of each link against the first link of its body, in the coordinates of the reference pose."""
        for joint, held in self.held.items():
            self._unite(joint, self.frames[joint] @ held @ inverse_motion(self.frames[joint]))

    def _held_at(self, joint: int, value: float) -> Reals:
        (freedom,) = motions(self.chain.joints[joint].pair, self.chain.space)
        axis, twist = "xyz".index(freedom.axis), np.zeros(6)
        twist[axis] = value * freedom.turns
        pitch = self.linkage.places[joint].pitch / self.linkage.size
        twist[3 + axis] = value * (1.0 if freedom.travels else pitch if freedom.has_pitch else 0.0)
        return exponential(twist)

    def _unite(self, joint: int, motion: Reals) -> None:
        first, second = (self.chain.index(name) for name in self.chain.joints[joint].links)
        a, b = self.of[first], self.of[second]
        if a == b:  # a loop of locked joints: the tree refuses it
            return
        between = self.poses[first] @ motion @ inverse_motion(self.poses[second])
        if a > b:
            a, b, between = b, a, inverse_motion(between)
        for link in range(self.chain.n):
            if self.of[link] == b:
                self.of[link], self.poses[link] = a, between @ self.poses[link]

    def rods(self, *, crosses: bool) -> tuple[Rod, ...]:
        """Bodies with two balls and nothing else, whose neighbours are other bodies than themselves and no rods.

        With ``crosses`` a cross joint at right angles to the rod counts as a ball.
        """
        if self.chain.space is not Space.SPATIAL:
            return ()
        driven = {drive.joint for drive in self.linkage.mechanism.drives} - {*self.held}
        frame = self.of[self.chain.index(self.linkage.mechanism.frame)]
        rods: dict[int, Rod] = {}
        for body in sorted({*self.of} - {frame}):
            rod = self._rod(body, crosses)
            if rod and not driven & {*rod.joints} and not {self.of[rod.first], self.of[rod.second]} & {*rods}:
                rods[body] = rod
        return tuple(rods.values())

    def _rod(self, body: int, crosses: bool) -> Rod | None:
        joints = [
            (k, [self.chain.index(name) for name in joint.links])
            for k, joint in enumerate(self.chain.joints)
            if k not in self.held and any(self.of[self.chain.index(name)] == body for name in joint.links)
        ]
        pairs = [self.chain.joints[k].pair for k, links in joints if len(links) == 2]
        if (
            len(joints) != 2
            or len(pairs) != 2
            or not all(pair.is_ball or (crosses and pair.is_cross) for pair in pairs)
        ):
            return None
        if pairs[1].is_cross:
            joints = joints[::-1]
        own, others = zip(*(sorted(links, key=lambda link: self.of[link] != body) for _, links in joints), strict=True)
        first, second = ((self.poses[link] @ self.frames[k])[:3, 3] for (k, _), link in zip(joints, own, strict=True))
        if self.of[others[0]] == self.of[others[1]] or np.linalg.norm(first - second) < _SHORTEST:
            return None
        numbers = (joints[0][0], joints[1][0])
        cross = None
        if self.chain.joints[numbers[0]].pair.is_cross:
            on_rod = self.poses[own[0]] @ self.frames[numbers[0]]
            is_first = joints[0][1][0] == own[0]
            slope = on_rod[:3, 0 if is_first else 1] @ (second - first) / np.linalg.norm(second - first)
            if self.chain.joints[numbers[1]].pair.is_cross or abs(slope) > _SQUARE:
                return None
            cross = Cross(frame=self.frames[numbers[0]], on_rod=on_rod, is_first=is_first)
        return Rod(link=body, first=others[0], second=others[1], joints=numbers, balls=(first, second), cross=cross)

    def links_of_rods(self, rods: Iterable[Rod]) -> set[int]:
        """All links of these bodies."""
        bodies = {rod.link for rod in rods}
        return {link for link, body in enumerate(self.of) if body in bodies}
