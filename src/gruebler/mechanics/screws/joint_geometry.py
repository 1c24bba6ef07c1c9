"""The joints of a linkage in a pose, as the recognisers of reasons see them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.instant_mobility import InstantMobility

SAME = 1e-8
"""Sizes and radians: places and directions that differ by less are one; a pose at a double root is known to that."""
"""Points and directions that differ by less, in sizes, are the same."""


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a linkage moves that should not, or more than it should."""

    kind: str
    """The key of its sentence in `gruebler.mechanics.screws.mobility_report`."""
    links: tuple[str, ...]
    """The links it speaks of, in the order of the sentence."""
    joints: tuple[int, ...] = ()
    number: int = 0
    """The sentence's number: a dimension, or how many there are."""


class JointGeometry:
    """The joints of a pose: kinds, points and axes."""

    def __init__(self, instant: InstantMobility) -> None:
        closing, pose = instant.closing, instant.pose
        self.instant = instant
        self.closing = closing
        self.chain = closing.mechanism.chain
        ties = {tie.joint: tie for tie in reversed(closing.ties)}
        self.frames = np.array([pose[ties[k].first] @ ties[k].on_first for k in range(len(self.chain.joints))])
        self.places = [ties[k].place for k in range(len(self.chain.joints))]
        pairs = [joint.pair for joint in self.chain.joints]
        self.turning = [k for k, pair in enumerate(pairs) if pair.is_turning]
        self.rolling = [k for k, pair in enumerate(pairs) if pair.rolls]
        self.contours = [k for k, pair in enumerate(pairs) if pair.has_contours]
        self.crosses = [k for k, pair in enumerate(pairs) if pair.is_cross]

    def at(self, joint: int) -> Reals:
        """The point of a joint."""
        return self.frames[joint, :3, 3]

    def axis(self, joint: int, name: str = "z") -> Reals:
        """One of its axes."""
        return self.frames[joint, :3, "xyz".index(name)]

    def on_axis(self, joint: int, point: Reals, name: str = "z") -> bool:
        """Whether the joint's axis passes through a point."""
        return bool(np.linalg.norm(np.cross(self.axis(joint, name), point - self.at(joint))) < SAME)

    def between(self, joints: Iterable[int], a: str, b: str) -> Iterator[int]:
        """Those of these joints that join two links."""
        return (k for k in joints if {a, b} <= set(self.chain.joints[k].links))

    def stressed(self, joints: list[int]) -> bool:
        """Whether all these joints hold redundant constraints."""
        return set(joints) <= set(self.instant.redundant)

    def ring(self) -> list[int] | None:
        """The joints in order, from the first link on, if the chain is one loop of binary links."""
        if any(k != 2 for k in self.chain.degrees.values()) or self.chain.multiple_joints:
            return None
        link = self.chain.links[0]
        ring: list[int] = []
        while len(ring) < len(self.chain.joints):
            number = next(k for k, j in enumerate(self.chain.joints) if link in j.links and k not in ring)
            ring.append(number)
            link = next(name for name in self.chain.joints[number].links if name != link)
        return ring
