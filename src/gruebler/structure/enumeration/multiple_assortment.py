"""Number synthesis with multiple joints: the numbers of links by degree and of joints by their number of links."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from gruebler.structure.enumeration.assortment import Assortment, joint_count, largest_degree, numbers_of
from gruebler.structure.enumeration.partitions import Partition, partition_numbers, partitions, running_sums


class JointAssortment(NamedTuple):
    """The numbers of links by degree and of joints by size."""

    links: Assortment
    """(n_2, n_3, ...): how many links have two, three, ... joints, a multiple joint being one joint of its links."""
    joints: Assortment
    """(g_2, g_3, ...): how many joints have two, three, ... links."""


def joint_assortments(links: int, mobility: int = 1, *, fractionated: bool = False) -> list[JointAssortment]:
    """All link and joint assortments of chains with joints of two or more links, the simple ones first.

    Sum n_i = n, sum (k - 1) g_k = g, sum i n_i = sum k g_k; no link has more joints, and no joint more links, than a
    link of a simple chain can have joints. Only the enumeration shows whether such a chain exists.

    >>> for assortment in joint_assortments(6):
    ...     print(assortment.links, assortment.joints)
    (4, 2) (7,)
    (5, 1) (5, 1)
    (6,) (3, 2)
    """
    return list(each_joint_assortment(links, mobility, fractionated=fractionated))


def each_joint_assortment(links: int, mobility: int = 1, *, fractionated: bool = False) -> Iterator[JointAssortment]:
    """The assortments of `joint_assortments` one by one, in the same order, in constant memory.

    >>> next(each_joint_assortment(6))
    JointAssortment(links=(4, 2), joints=(7,))
    """
    joints, largest = joint_count(links, mobility), largest_degree(links, mobility, fractionated=fractionated)
    if joints is None or largest is None:
        return
    total = 2 * (joints - links)
    for merged in range(total + 1):
        for together in partitions(merged, largest - 2):
            simple = joints - merged - _length(together)
            if simple < 0:
                continue
            # Every link has two joints; the remaining elements of the joints are distributed one by one.
            for more in partitions(total - merged, largest - 2):
                yield JointAssortment(numbers_of(links - _length(more), more), numbers_of(simple, together))


def joint_assortment_number(links: int, mobility: int = 1, *, fractionated: bool = False) -> int:
    """The number of assortments that `joint_assortments` lists, counted directly; docs/theory/multiple-joints.md.

    >>> joint_assortment_number(6), joint_assortment_number(100)
    (3, 930512111350)
    """
    joints, largest = joint_count(links, mobility), largest_degree(links, mobility, fractionated=fractionated)
    if joints is None or largest is None:
        return 0
    total = 2 * (joints - links)
    numbers = partition_numbers(total)
    sums = running_sums(numbers)

    def above(of: int, bound: int) -> int:
        """Partitions with a part (or, by conjugation, a number of parts) above the bound, at least half of ``of``."""
        return sums[max(0, of - bound)]

    number = 0
    for merged in range(total + 1):
        unmerged = total - merged
        together = numbers[merged] - above(merged, largest - 2) - above(merged, joints - merged)
        number += together * (numbers[unmerged] - above(unmerged, largest - 2))
    return number


def _length(partition: Partition) -> int:
    return sum(times for _, times in partition)
