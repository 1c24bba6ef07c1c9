"""The fractionation of a chain: whether it falls apart at a link or at a joint.

docs/theory/fractionation.md has the classes, docs/theory/multiple-joints.md the joints of more than two links.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from gruebler.structure.chain import Chain

Fractionation = Literal["none", "link", "joint"]
CLASSES: tuple[Fractionation, ...] = ("none", "link", "joint")


def joint_masks(chain: Chain) -> list[int]:
    """Every joint as a set of link numbers, encoded in bits."""
    return [sum(1 << chain.index(link) for link in joint.links) for joint in chain.joints]


def fractionation(chain: Chain) -> Fractionation:
    """Whether the chain falls apart into chains that move independently of each other, at a link or at a joint.

    ``joint``: the links fall apart when one joint is removed (for a simple joint: a bridge of the link graph).
    ``link``: not so, but they fall apart when one link is removed together with its joints (for simple joints: a
    cut vertex). ``none``: neither. Cost O(joints² · links).

    >>> fractionation(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-6) R(6-0)"))
    'link'
    """
    joints = joint_masks(chain)
    everything = (1 << chain.n) - 1
    if any(_parts(everything, joints[:k] + joints[k + 1 :]) > 1 for k in range(len(joints))):
        return "joint"
    for link in range(chain.n):
        bit = 1 << link
        if _parts(everything & ~bit, [joint for joint in joints if not joint & bit]) > 1:
            return "link"
    return "none"


def _parts(links: int, joints: Sequence[int]) -> int:
    """The number of connected parts of these links, with only these joints."""
    number = 0
    while links:
        part = links & -links
        waiting = joints
        while True:
            touching = [joint for joint in waiting if joint & part]
            if not touching:
                break
            waiting = [joint for joint in waiting if not joint & part]
            for joint in touching:
                part |= joint
        links &= ~part
        number += 1
    return number
