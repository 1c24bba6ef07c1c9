"""Chains with multiple joints, grown from the chains with simple joints by merging joints.

Splitting a joint of k >= 3 links into one of k - 1 and a simple one that shares a link with it keeps every condition,
so every chain with multiple joints is reached from a chain with simple ones by repeatedly merging a joint with a simple
joint at one of its links. Each chain is kept only where it grows from its canonical split, so the search is a
tree: nothing is stored, and the branches of different simple chains are independent pieces of work.

Theorems and proofs: docs/theory/multiple-joints.md. The tree is the canonical construction path of B. D. McKay,
Isomorph-free exhaustive generation, J. Algorithms 26 (1998) 306-324.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby, islice

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.errors import GrueblerError
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration.fractionation_class import joint_masks

_MANY = 99  # no limit: more than a chain can have
_AT_ONCE = 64  # chains with simple joints that are grown together
_BLOCK = 16384  # chains in a block
_MOST_LINKS = 20  # the search needs 2^links bytes for each joint


def with_multiple_joints(
    simple: Iterable[Chain], *, fewest: int = 0, most: int | None = None, largest: int | None = None
) -> Iterator[Chain]:
    """The chains with multiple joints that grow from chains with simple ones, each once.

    Args:
        simple: planar chains of simple revolute joints. If these are all chains of n links and mobility F
            (fractionated ones included), each once, so is the answer, with multiple joints.
        fewest: leave out chains with fewer joints of more than two links than this; with 0 the given chains
            themselves are part of the answer.
        most: leave out chains with more of them.
        largest: leave out chains with a joint of more links than this.

    Order: every chain before those that grow from it. Cost: some 20 us for a chain of 12 links, and 60 us for the chain
    as a value.

    Raises:
        GrueblerError: a chain of more than 20 links.

    >>> stephenson = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)")
    >>> len(list(with_multiple_joints([stephenson], fewest=1)))
    0
    """
    for _, alike in groupby(simple, key=lambda chain: (chain.n, len(chain.joints))):
        while some := list(islice(alike, _AT_ONCE)):
            masks = [joint_masks(chain) for chain in some]
            for block in grown_joints(some[0].n, masks, fewest=fewest, most=most, largest=largest):
                for number, *joints in block.tolist():
                    yield _chain(some[number], joints)


def _chain(simple: Chain, joints: Sequence[int]) -> Chain:
    links = simple.links
    members = [[links[i] for i in range(simple.n) if joint >> i & 1] for joint in joints if joint]
    return Chain([("revolute", names) for names in members], links=links)


def grown_joints(
    links: int,
    simple: Sequence[Sequence[int]],
    *,
    fewest: int = 0,
    most: int | None = None,
    largest: int | None = None,
) -> Iterator[NDArray[np.int64]]:
    """The chains of `with_multiple_joints` in bulk, without a `Chain` for each.

    Args:
        links: number of links of all chains.
        simple: the joints of each chain with simple ones, each joint as a set of link numbers in bits.
        fewest: as for `with_multiple_joints`; likewise the others.
        most: see there.
        largest: see there.

    Yields:
        int64[k, 1 + joints]: the number of the chain that it grows from, and its joints, zeros behind.

    >>> [block[:, 1:].tolist() for block in grown_joints(4, [[0b0011, 0b0110, 0b1100, 0b1001]])]
    [[[3, 6, 12, 9]]]
    """
    if links > _MOST_LINKS:
        raise GrueblerError(
            "chains with multiple joints are enumerated up to {most} links, not {links}", most=_MOST_LINKS, links=links
        )
    if not simple:
        return
    limits = fewest, _MANY if most is None else most, _MANY if largest is None else largest
    search = _core.MultipleJoints(links, np.array(simple, np.int64), *limits)
    while True:
        block = search.next(_BLOCK)
        yield block
        if len(block) < _BLOCK:
            return
