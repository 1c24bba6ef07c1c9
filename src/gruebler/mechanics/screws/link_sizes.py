"""What is measured on the links of a linkage in space: how far apart two joints are, and how their axes are crossed."""

from __future__ import annotations

from math import atan2, degrees
from typing import NamedTuple

import numpy as np

from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.structure.chain.pairs import Pair

_NONE = 1e-9  # of the size of the linkage: joints that are less apart are at one place
_PARALLEL = 1e-9  # the sine of the angle between axes that are taken as parallel


class LinkSize(NamedTuple):
    """Of a link with two joints: how far these are apart, and the angle of their axes in degrees if both have one."""

    link: str
    distance: float
    angle: float | None


def link_sizes(linkage: SpatialLinkage) -> list[LinkSize]:
    """The sizes of the links with two joints that stand on an axis or at a point, in the order of the links.

    Between two axes the distance is that of their common normal, the angle the one of Denavit and Hartenberg between 0
    and 180 degrees.

    >>> from gruebler.teaching.catalog import entry
    >>> bennett = entry("bennett").placed()  # lengths of 120 and 60 with twists of 90 and 30 degrees
    >>> [(size.link, round(size.distance), round(size.angle)) for size in link_sizes(bennett)[:2]]
    [('frame', 120, 90), ('driver', 60, 30)]
    """
    sizes = []
    for link, joints in sized_links(linkage).items():
        distance, angle = _between(linkage, *joints)
        sizes.append(LinkSize(link, distance if distance > _NONE * linkage.size else 0.0, angle))
    return sizes


def sized_links(linkage: SpatialLinkage) -> dict[str, tuple[int, int]]:
    """The two joints of each link that has sizes."""
    chain = linkage.mechanism.chain
    ends = {}
    for link in chain.links:
        joints = [k for k, joint in enumerate(chain.joints) if link in joint.links]
        pairs = [chain.joints[k].pair for k in joints]
        if len(joints) == 2 and all(has_axis(pair) or pair.is_ball or pair.is_cross for pair in pairs):
            ends[link] = joints[0], joints[1]
    return ends


def has_axis(pair: Pair) -> bool:
    """Whether all that a pair lets go is about and along one axis of the joint, its z axis."""
    return pair.is_lower and {freedom.axis for freedom in pair.motion} == {"z"}


def _between(linkage: SpatialLinkage, first: int, second: int) -> tuple[float, float | None]:
    gap = linkage.frames[second, :3, 3] - linkage.frames[first, :3, 3]
    straight = [has_axis(linkage.mechanism.chain.joints[k].pair) for k in (first, second)]
    axes = [linkage.frames[k, :3, 2] for k, has in zip((first, second), straight, strict=True) if has]
    if not axes:
        return float(np.linalg.norm(gap)), None
    off = float(np.linalg.norm(gap - (gap @ axes[0]) * axes[0]))
    if len(axes) == 1:
        return off, None
    normal = np.cross(axes[0], axes[1])
    sine = float(np.linalg.norm(normal))
    angle = degrees(atan2(sine, float(axes[0] @ axes[1])))
    return (off if sine < _PARALLEL else abs(float(gap @ normal)) / sine), angle
