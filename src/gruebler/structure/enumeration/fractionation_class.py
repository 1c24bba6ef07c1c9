"""The definition of an enumerated chain as a direct test, and the fractionation of a chain.

For a set S of links let d(S) = 3(|S| - 1) - 2 Σ max(0, |J ∩ S| - 1), the sum over the joints J. A planar chain of
revolute joints counts as a chain of mobility F if d(all links) = F, d(S) >= 1 for every proper set S of two or
more links, every link carries at least two joints and no two joints share two links.
docs/theory/fractionation.md has the classes, docs/theory/multiple-joints.md the joints of more than two links.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from gruebler.structure.chain import Chain
from gruebler.structure.chain.spaces import Space

Fractionation = Literal["none", "link", "joint"]
CLASSES: tuple[Fractionation, ...] = ("none", "link", "joint")


def joint_masks(chain: Chain) -> list[int]:
    """Every joint as a set of link numbers, encoded in bits."""
    return [sum(1 << chain.index(link) for link in joint.links) for joint in chain.joints]


def freedoms_of_sets(links: int, joints: Iterable[int]) -> NDArray[np.int32]:
    """d(S) for every set S of links, the sets numbered by their bits; the entry of the empty set is meaningless.

    Cost O(2^links · joints) time, 8 bytes · 2^links of memory.

    >>> freedoms_of_sets(3, [0b011, 0b110, 0b101])[0b111]
    np.int32(0)
    """
    sets = np.arange(1 << links, dtype=np.int64)
    freedoms = 3 * (np.bitwise_count(sets).astype(np.int32) - 1)
    for joint in joints:
        freedoms -= 2 * np.maximum(np.bitwise_count(sets & joint).astype(np.int32) - 1, 0)
    return freedoms


def is_constrained(chain: Chain, mobility: int) -> bool:
    """Whether the enumeration contains the chain: the definition above, tested over all sets of links.

    >>> four_bar = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
    >>> is_constrained(four_bar, 1), is_constrained(four_bar.with_joint("revolute", ["0", "2"]), -1)
    (True, False)
    """
    if chain.space is not Space.PLANAR or any(not joint.pair.is_turning for joint in chain.joints):
        return False
    joints = joint_masks(chain)
    if min(chain.degrees.values()) < 2 or any((a & b).bit_count() > 1 for a, b in combinations(joints, 2)):
        return False
    freedoms = freedoms_of_sets(chain.n, joints)
    if freedoms[-1] != mobility:
        return False
    several = np.bitwise_count(np.arange(1 << chain.n, dtype=np.int64)) > 1
    several[-1] = False
    return bool((freedoms[several] >= 1).all())


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
