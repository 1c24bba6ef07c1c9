"""Number synthesis: how many binary, ternary, ... links a chain of n links and mobility F can have.

Planar chains of revolute joints, simple ones (two links each). With n_i links of i joints and g joints,

    sum n_i = n,   sum i n_i = 2g,   F = 3(n - 1) - 2g,

hence n_2 = F + 3 + n_4 + 2 n_5 + 3 n_6 + ... The bound on the degree of a link is derived in
docs/theory/enumeration.md, "Numbers".
"""

from __future__ import annotations

from collections.abc import Iterator

from gruebler.errors import GrueblerError

__all__ = ["Assortment", "assortments", "joint_number", "largest_degree", "loop_number"]

Assortment = tuple[int, ...]
"""(n_2, n_3, n_4, ...): how many links have two, three, four ... joints, without zeros at the end."""


def loop_number(links: int, mobility: int) -> int | None:
    """The number of independent loops, L = (n - 1 - F)/2; None if no closed chain has these numbers.

    Raises:
        GrueblerError: links < 1 or mobility < 0.

    >>> loop_number(8, 1), loop_number(8, 2), loop_number(4, 3)
    (3, None, None)
    """
    if links < 1 or mobility < 0:
        raise GrueblerError(
            f"a chain has at least one link and a mobility of at least 0: got links={links}, mobility={mobility}"
        )
    twice = links - 1 - mobility
    return twice // 2 if twice >= 2 and twice % 2 == 0 else None


def joint_number(links: int, mobility: int) -> int | None:
    """The number of joints, g = (3(n - 1) - F)/2; None if no closed chain has these numbers.

    >>> joint_number(8, 1)
    10
    """
    loops = loop_number(links, mobility)
    return None if loops is None else links - 1 + loops


def largest_degree(links: int, mobility: int, *, fractionated: bool = False) -> int | None:
    """The largest number of joints that a link can have; None if no closed chain has these numbers.

    (n - F + 1)/2 in a chain that is not fractionated. At a link that joins k parts every part may have its own
    such link, which gives L + k for k <= min(L, F) parts.

    >>> largest_degree(8, 1), largest_degree(9, 2), largest_degree(9, 2, fractionated=True)
    (4, 4, 5)
    """
    loops = loop_number(links, mobility)
    if loops is None:
        return None
    return loops + (max(1, min(loops, mobility)) if fractionated else 1)


def assortments(links: int, mobility: int = 1, *, fractionated: bool = False) -> list[Assortment]:
    """All link assortments of chains with simple joints, sorted.

    Args:
        links: number of links, n.
        mobility: F >= 0.
        fractionated: whether to allow the larger degrees that only fractionated chains (F >= 2) have.

    Every assortment in the list has a contracted graph; whether it has a chain that is nowhere rigid only the
    enumeration tells (with F = 0 often not).

    Raises:
        GrueblerError: links < 1 or mobility < 0.

    >>> assortments(8)
    [(4, 4), (5, 2, 1), (6, 0, 2)]
    >>> assortments(5, 2), assortments(8, 2)
    ([(5,)], [])
    """
    largest = largest_degree(links, mobility, fractionated=fractionated)
    if largest is None:
        return []
    found = []
    for higher in _higher(links, largest, 4):
        binary = mobility + 3 + sum((i - 3) * k for i, k in enumerate(higher, 4))
        ternary = links - binary - sum(higher)
        if ternary >= 0:
            whole = [binary, ternary, *higher]
            while whole[-1] == 0:
                whole.pop()
            found.append(tuple(whole))
    return sorted(found)


def _higher(room: int, largest: int, degree: int) -> Iterator[tuple[int, ...]]:
    """(n_4, n_5, ...): a link of i joints brings i - 3 binary links, so it takes i - 2 places."""
    if degree > largest:
        yield ()
        return
    for k in range(room // (degree - 2) + 1):
        for rest in _higher(room - k * (degree - 2), largest, degree + 1):
            yield (k, *rest)
