"""Number synthesis with multiple joints: how many links of which degree, how many joints of how many links."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from gruebler.enumeration.assortment import Assortment, joint_number, largest_degree

__all__ = ["JointAssortment", "joint_assortments"]


class JointAssortment(NamedTuple):
    """One way to share out links and joints."""

    links: Assortment
    """(n_2, n_3, ...): how many links have two, three, ... joints, a multiple joint being one joint of its links."""
    joints: Assortment
    """(g_2, g_3, ...): how many joints have two, three, ... links."""


def joint_assortments(links: int, mobility: int = 1, *, fractionated: bool = False) -> list[JointAssortment]:
    """All link and joint assortments of chains with joints of two or more links, the simple ones first.

    Sum n_i = n, sum (k - 1) g_k = g, sum i n_i = sum k g_k; no link has more joints, and no joint more links, than a
    link of a simple chain can have joints. Whether there is such a chain only the enumeration tells.

    >>> for found in joint_assortments(6):
    ...     print(found.links, found.joints)
    (4, 2) (7,)
    (5, 1) (5, 1)
    (6,) (3, 2)
    """
    joints, largest = joint_number(links, mobility), largest_degree(links, mobility, fractionated=fractionated)
    if joints is None or largest is None:
        return []
    found = []
    for merged in range(2 * (joints - links) + 1):
        for higher in _shared_out(merged, largest - 2):
            together = sum(k * (i + 1) for i, k in enumerate(higher, 1))
            simple = joints - together
            if simple < 0:
                continue
            # Every link has two joints; what is left of the joints' elements is shared out one by one.
            spare = 2 * joints - merged - 2 * links
            for more in _shared_out(spare, largest - 2):
                binary = links - sum(more)
                if binary >= 0:
                    found.append(JointAssortment(_trimmed(binary, *more), _trimmed(simple, *higher)))
    return found


def _shared_out(total: int, largest: int) -> Iterator[tuple[int, ...]]:
    """(k_1, k_2, ..., k_largest) with sum i k_i = total."""
    if largest < 1:
        if total == 0:
            yield ()
        return
    for k in range(total // largest + 1):
        for rest in _shared_out(total - k * largest, largest - 1):
            yield (*rest, k)


def _trimmed(*numbers: int) -> Assortment:
    kept = list(numbers)
    while len(kept) > 1 and kept[-1] == 0:
        kept.pop()
    return tuple(kept)
