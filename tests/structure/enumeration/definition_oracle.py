"""The definition of an enumerated chain as a direct test over all sets of links: slow, and obvious.

For a set S of links let d(S) = 3(|S| - 1) - 2 Σ max(0, |J ∩ S| - 1), the sum over the joints J. A planar chain of
revolute joints counts as a chain of mobility F if d(all links) = F, d(S) >= 1 for every proper set S of two or
more links, every link carries at least two joints and no two joints share two links.
"""

from itertools import combinations

import numpy as np

from gruebler.structure.chain.spaces import Space
from gruebler.structure.enumeration.fractionation_class import joint_masks


def freedoms_of_sets(links, joints):
    """d(S) for every set S of links, the sets numbered by their bits; the entry of the empty set is meaningless."""
    sets = np.arange(1 << links, dtype=np.int64)
    freedoms = 3 * (np.bitwise_count(sets).astype(np.int32) - 1)
    for joint in joints:
        freedoms -= 2 * np.maximum(np.bitwise_count(sets & joint).astype(np.int32) - 1, 0)
    return freedoms


def is_constrained(chain, mobility):
    """Whether the enumeration contains the chain: the definition above, tested over all sets of links."""
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
