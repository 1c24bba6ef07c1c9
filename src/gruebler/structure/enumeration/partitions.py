"""Partitions of whole numbers: counted by Euler's recurrence, listed one by one in two orders.

A partition is a tuple of (part, multiplicity), the parts ascending. Assortments correspond to partitions:
docs/theory/enumeration.md, "Numbers".
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate

Partition = tuple[tuple[int, int], ...]


def partition_numbers(total: int) -> list[int]:
    """p(0), p(1), ..., p(total), the numbers of partitions; O(total^1.5) additions (Euler 1750).

    >>> partition_numbers(8)
    [1, 1, 2, 3, 5, 7, 11, 15, 22]
    """
    # p(n) = sum of -(-1)^k p(n - k(3k - 1)/2) over k = 1, -1, 2, -2, ...; plus for odd k, minus for even.
    steps: list[tuple[int, bool]] = []
    k = 1
    while k * (3 * k - 1) // 2 <= total:
        steps += [(k * (3 * k - 1) // 2, k % 2 == 1), (k * (3 * k + 1) // 2, k % 2 == 1)]
        k += 1
    numbers = [1]
    for n in range(1, total + 1):
        value = 0
        for step, plus in steps:
            if step > n:
                break
            value = value + numbers[n - step] if plus else value - numbers[n - step]
        numbers.append(value)
    return numbers


def running_sums(numbers: list[int]) -> list[int]:
    """The sums of the first 0, 1, 2, ... numbers.

    >>> running_sums([1, 1, 2])
    [0, 1, 2, 4]
    """
    return [0, *accumulate(numbers)]


def partitions(total: int, largest: int) -> Iterator[Partition]:
    """The partitions of a number into parts of at most ``largest``, those with the smallest largest part first.

    Sorted by the multiplicities of the parts ``largest``, ``largest`` - 1, ..., 1. No branch of the search fails.

    >>> list(partitions(4, 3))
    [((1, 4),), ((1, 2), (2, 1)), ((2, 2),), ((1, 1), (3, 1))]
    """
    if total == 0:
        yield ()
    for part in range(1, min(total, largest) + 1):
        for times in range(1 if part > 1 else total, total // part + 1):
            for smaller_parts in partitions(total - part * times, part - 1):
                yield (*smaller_parts, (part, times))


def partitions_of_length(total: int, length: int, largest: int, smallest: int = 1) -> Iterator[Partition]:
    """The partitions of a number into ``length`` parts from ``smallest`` to ``largest``.

    Sorted by the multiplicities of the parts ``smallest``, ``smallest`` + 1, ... No branch of the search fails.

    >>> list(partitions_of_length(6, 3, 4))
    [((2, 3),), ((1, 1), (2, 1), (3, 1)), ((1, 2), (4, 1))]
    """
    if length == 0:
        if total == 0:
            yield ()
        return
    room = length * largest - total  # the sum of the distances of the parts from the largest
    if room < 0:
        return
    for part in range(min(total // length, largest), smallest - 1, -1):
        # The remaining parts lie between part + 1 and the largest: both bounds solved for the multiplicity.
        fewest = max(1, length * (part + 1) - total)
        most = min(length, room // (largest - part)) if part < largest else length
        for times in range(fewest, most + 1):
            for larger_parts in partitions_of_length(total - part * times, length - times, largest, part + 1):
                yield ((part, times), *larger_parts)
