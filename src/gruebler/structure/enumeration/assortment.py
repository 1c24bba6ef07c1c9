"""Number synthesis: how many binary, ternary, ... links a chain of n links and mobility F can have.

Planar chains of revolute joints, simple ones (two links each). With n_i links of i joints and g joints,

    sum n_i = n,   sum i n_i = 2g,   F = 3(n - 1) - 2g,

hence n_2 = F + 3 + n_4 + 2 n_5 + 3 n_6 + ... The bound on the degree of a link is derived in
docs/theory/enumeration.md, "Numbers".
"""

from __future__ import annotations

from collections.abc import Iterator

from gruebler.base.errors import GrueblerError
from gruebler.structure.enumeration.partitions import Partition, partition_numbers, partitions_of_length

Assortment = tuple[int, ...]
"""(n_2, n_3, n_4, ...): how many links have two, three, four ... joints, without zeros at the end."""


def loop_count(links: int, mobility: int) -> int | None:
    """The number of independent loops, L = (n - 1 - F)/2; None if no closed chain has these numbers.

    Raises:
        GrueblerError: links < 1 or mobility < 0.

    >>> loop_count(8, 1), loop_count(8, 2), loop_count(4, 3)
    (3, None, None)
    """
    if links < 1 or mobility < 0:
        raise GrueblerError(
            "a chain has at least one link and a mobility of at least 0: got links={links}, mobility={mobility}",
            links=links,
            mobility=mobility,
        )
    twice = links - 1 - mobility
    return twice // 2 if twice >= 2 and twice % 2 == 0 else None


def joint_count(links: int, mobility: int) -> int | None:
    """The number of joints, g = (3(n - 1) - F)/2; None if no closed chain has these numbers.

    >>> joint_count(8, 1)
    10
    """
    loops = loop_count(links, mobility)
    return None if loops is None else links - 1 + loops


def largest_degree(links: int, mobility: int, *, fractionated: bool = False) -> int | None:
    """The largest number of joints that a link can have; None if no closed chain has these numbers.

    (n - F + 1)/2 in a chain that is not fractionated. At a link that joins k parts every part may have its own
    such link, which gives L + k for k <= min(L, F) parts.

    >>> largest_degree(8, 1), largest_degree(9, 2), largest_degree(9, 2, fractionated=True)
    (4, 4, 5)
    """
    loops = loop_count(links, mobility)
    if loops is None:
        return None
    return loops + (max(1, min(loops, mobility)) if fractionated else 1)


def assortments(links: int, mobility: int = 1, *, fractionated: bool = False) -> list[Assortment]:
    """All link assortments of chains with simple joints, sorted.

    Args:
        links: number of links, n.
        mobility: F >= 0.
        fractionated: whether to allow the larger degrees that only fractionated chains (F >= 2) have.

    Every assortment in the list has a contracted graph; only the enumeration shows whether it has a chain without a
    rigid part (with F = 0 often not). Their number grows like exp(2.6 sqrt(n)): `assortment_number` computes it
    directly, and `each_assortment` yields them one by one.

    Raises:
        GrueblerError: links < 1 or mobility < 0.

    >>> assortments(8)
    [(4, 4), (5, 2, 1), (6, 0, 2)]
    >>> assortments(5, 2), assortments(8, 2)
    ([(5,)], [])
    """
    return list(each_assortment(links, mobility, fractionated=fractionated))


def each_assortment(links: int, mobility: int = 1, *, fractionated: bool = False) -> Iterator[Assortment]:
    """The assortments of `assortments` one by one, in the same order, in constant memory.

    >>> next(each_assortment(1000))[:2]
    (4, 996)
    """
    loops, largest = loop_count(links, mobility), largest_degree(links, mobility, fractionated=fractionated)
    if loops is None or largest is None:
        return
    # A link of i joints is a part i - 2 of 2(L - 1); a link without a part is binary.
    total = 2 * (loops - 1)
    for length in range(total, -1, -1):
        for partition in partitions_of_length(total, length, largest - 2):
            yield numbers_of(links - length, partition)


def numbers_of(first: int, partition: Partition) -> Assortment:
    """The number ``first``, then the multiplicity of each part 1, 2, ...

    >>> numbers_of(7, ((1, 1), (3, 2)))
    (7, 1, 0, 2)
    """
    counts = [first] + [0] * (partition[-1][0] if partition else 0)
    for part, times in partition:
        counts[part] = times
    return tuple(counts)


def assortment_number(links: int, mobility: int = 1, *, fractionated: bool = False) -> int:
    """The number of assortments that `assortments` lists, as a number of partitions; O(n^1.5).

    >>> assortment_number(8), assortment_number(100)
    (3, 117343357)
    """
    loops, largest = loop_count(links, mobility), largest_degree(links, mobility, fractionated=fractionated)
    if loops is None or largest is None:
        return 0
    total = 2 * (loops - 1)
    numbers = partition_numbers(total)
    # At most one part can be too large, since the largest allowed one is at least half of the total.
    return numbers[total] - sum(numbers[: max(0, total - largest + 2)])
