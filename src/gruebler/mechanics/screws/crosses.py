"""Crosses: where two links are held on two axes that meet at a right angle, as those of a universal joint."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.structure.chain.spaces import Space

_SAME = 1e-9  # of the size of the linkage, and cosines


@dataclass(frozen=True, eq=False, kw_only=True)
class UniversalCross:
    """A cross with its two arms, each of which a link holds."""

    at: Reals
    """Where its arms meet."""
    arms: Mapping[str, tuple[int, Reals]]
    """The links that hold it, each with the joint in which it does and the direction of the arm."""
    body: str | None
    """The link that is the cross; None of a joint with two axes, which has none."""

    def holds(self, joint: int, link: str) -> bool:
        """Whether it is in this joint that the link holds it, or is the cross."""
        joints = [number for number, _ in self.arms.values()]
        return joint in joints and (link == self.body or joint == self.arms.get(link, (None, 0))[0])


def crosses_of(linkage: SpatialLinkage) -> list[UniversalCross]:
    """The joints with two axes, and the moving links between two turning joints whose axes meet at a right angle.

    No link that is a cross holds another one.

    >>> from gruebler.teaching.catalog import entry
    >>> [(cross.body, *cross.arms) for cross in crosses_of(entry("universal_joint").placed())]
    [('cross', 'input', 'output')]
    >>> [(cross.body, *cross.arms) for cross in crosses_of(entry("cardan_shaft").placed())]
    [(None, 'input', 'shaft'), (None, 'shaft', 'output')]
    """
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    crosses = []
    for number, joint in enumerate(chain.joints):
        if joint.pair.is_cross and len(joint.links) == 2:
            axes = linkage.frames[number, :3, :2].T
            arms = {link: (number, axis) for link, axis in zip(joint.links, axes, strict=True)}
            crosses.append(UniversalCross(at=linkage.frames[number, :3, 3], arms=arms, body=None))
    for link in chain.links:
        numbers = [k for k, joint in enumerate(chain.joints) if link in joint.links]
        if len(numbers) != 2 or any(link == of for of, _ in linkage.points.values()):
            continue
        joints = [chain.joints[k] for k in numbers]
        holders = [next(other for other in joint.links if other != link) for joint in joints]
        plain = all(joint.pair.is_turning and len(joint.links) == 2 for joint in joints)
        held = {cross.body for cross in crosses} | {of for cross in crosses if cross.body for of in cross.arms}
        if not plain or frame in (link, *holders) or held & {link, *holders} or holders[0] == holders[1]:
            continue
        at = _meeting(linkage, *numbers)
        if at is not None:
            arms = {of: (k, linkage.frames[k, :3, 2]) for of, k in zip(holders, numbers, strict=True)}
            crosses.append(UniversalCross(at=at, arms=arms, body=link))
    return crosses


def _meeting(linkage: SpatialLinkage, first: int, second: int) -> Reals | None:
    """Where the axes of two joints meet at a right angle, if they do."""
    a, b = linkage.frames[first], linkage.frames[second]
    if abs(float(a[:3, 2] @ b[:3, 2])) > _SAME:
        return None
    if linkage.mechanism.chain.space is Space.SPHERICAL:
        return np.zeros(3)
    gap = b[:3, 3] - a[:3, 3]
    if abs(float(gap @ np.cross(a[:3, 2], b[:3, 2]))) > _SAME * linkage.size:
        return None
    return np.asarray(a[:3, 3] + (gap @ a[:3, 2]) * a[:3, 2])


def put_apart(linkage: SpatialLinkage, cross: UniversalCross, places: list[Reals], middle: Reals) -> None:
    """Put the bearings of the two shafts of a cross on both sides of its middle, among places of joints."""
    first, second = (_shaft(linkage, cross, link) for link in cross.arms)
    if first is None or second is None:
        return
    if (places[first] - middle) @ (places[second] - middle) > 0:
        places[second] = 2 * middle - places[second]


def _shaft(linkage: SpatialLinkage, cross: UniversalCross, link: str) -> int | None:
    """The other joint of a link that holds a cross, if it turns about an axis through the middle of the cross."""
    joints = linkage.mechanism.chain.joints
    others = [k for k, joint in enumerate(joints) if link in joint.links and k != cross.arms[link][0]]
    if len(others) != 1 or not joints[others[0]].pair.is_turning:
        return None
    frame = linkage.frames[others[0]]
    if linkage.mechanism.chain.space is Space.SPHERICAL:
        return others[0]
    off = np.linalg.norm(np.cross(frame[:3, 3] - cross.at, frame[:3, 2]))
    return others[0] if off < _SAME * linkage.size else None
