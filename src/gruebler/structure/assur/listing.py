"""All Assur groups of turning joints with a given number of links, from the trusses with one link more.

With its places outside merged to one link, a group becomes a Baranov truss: a chain with F = 0 in which no smaller part
is rigid. Without any one of its links, a truss is an Assur group whose outer joints are that link's. Links that an
automorphism exchanges give the same group, others different ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gruebler import _core
from gruebler.base.doors import door
from gruebler.structure.assur.groups import AssurGroup, place_name
from gruebler.structure.assur.locking import AssurError
from gruebler.structure.chain import Chain

_GROUP = 1.5e-5  # seconds on one core


@dataclass(frozen=True, slots=True)
class GroupRow:
    """An Assur group of simple turning joints in canonical form, without an object for each joint."""

    class_number: int
    order: int
    joints: tuple[tuple[str, str], ...]
    """The two links of each joint; the outer ones first, each with a place of its own."""

    def text(self, symbol: str = "R") -> str:
        """The joints, as `chain.notation` writes them."""
        return " ".join(f"{symbol}({a}-{b})" for a, b in self.joints)

    def group(self) -> AssurGroup:
        """The group as a value."""
        return AssurGroup.known(Chain([("revolute", ends) for ends in self.joints]))


@door
def assur_groups(links: int) -> Iterator[AssurGroup]:
    """Every Assur group with this many links and simple turning joints, each once, in canonical form.

    Args:
        links: an even number.

    Returns:
        An iterator of `AssurGroup`, in a fixed order.

    Raises:
        AssurError: a number that is not even and positive (each link brings three constraints, each joint two).

    Cost:
        About 70 us for each group.

    Example:
        >>> [group.form for group in assur_groups(2)]
        ['RRR']

    See Also:
        `decompose`, `chains`

    Theory:
        docs/theory/assur.md
    """
    return (row.group() for row in group_rows(links))


def group_rows(links: int) -> Iterator[GroupRow]:
    """The groups of `assur_groups` as rows, in the same order; errors likewise. Cost: some 15 us for each group.

    >>> [(row.class_number, row.order, row.text()) for row in group_rows(2)]
    [(2, 2, 'R(a-1) R(b-2) R(1-2)')]
    """
    _check_number(links)
    return _rows(links)


def _rows(links: int) -> Iterator[GroupRow]:
    from gruebler.structure.enumeration import edge_blocks  # imported only here: the rooms import each other

    n = links + 1
    for block in edge_blocks(n, 0):
        for begin in range(0, len(block), 4096):
            trusses = np.ascontiguousarray(block[begin : begin + 4096])
            for class_number, order, *ends in _core.describe_groups(n, trusses).tolist():
                pairs = zip(ends[::2], ends[1::2], strict=True)
                named = tuple((str(a) if a else place_name(k), str(b)) for k, (a, b) in enumerate(pairs))
                yield GroupRow(class_number, order, named)


def _check_number(links: int) -> None:
    if links < 2 or links % 2:
        raise AssurError("an Assur group of turning joints has 2, 4, 6, ... links, not {links}", links=links)


def count_assur_groups(links: int) -> int:
    """The number of Assur groups with this many links and simple turning joints; errors as for `assur_groups`.

    Counted as the orbits of links of all trusses, by Burnside's lemma: a second for 14 links.

    >>> [count_assur_groups(links) for links in (2, 4, 6, 8, 10, 12)]
    [1, 2, 10, 173, 5438, 251638]
    """
    from gruebler.structure.enumeration import count_chains

    _check_number(links)
    number = count_chains(links + 1, 0, orbits=True).inversions
    assert number is not None
    return number


def expected_seconds_of_groups(links: int) -> float:
    """The estimated time of `assur_groups` for all groups, to a factor of three.

    >>> expected_seconds_of_groups(8) < 5, expected_seconds_of_groups(14) > 100
    (True, True)
    """
    from gruebler.structure.enumeration.estimates import expected_chains
    from gruebler.structure.enumeration.request import Request

    if links < 2 or links % 2:
        return 0.0
    trusses, _ = expected_chains(Request(links + 1, mobility=0))
    return trusses * (links + 1) * _GROUP
