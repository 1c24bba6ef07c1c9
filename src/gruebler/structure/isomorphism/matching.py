"""Whether two chains have the same structure, with the correspondence as witness."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gruebler.base.doors import door_that_raises
from gruebler.base.errors import ChainError, expect
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism.codes import canonical_order, code


@dataclass(frozen=True, slots=True)
class Isomorphism:
    """The link and the joint of the second chain that correspond to each of the first."""

    links: Mapping[str, str]
    joints: tuple[int, ...]
    """joints[k] is the number, in the second chain, of the joint that corresponds to joint k."""


def find_isomorphism(first: Chain, second: Chain) -> Isomorphism | None:
    """A correspondence of links and joints that keeps space, pairs and incidence, or None if there is none.

    >>> find_isomorphism(Chain.parse("R(a-b) R(b-c) P(c-a)"), Chain.parse("P(0-1) R(1-2) R(2-0)")).links["b"]
    '2'
    """
    for chain in (first, second):
        expect(chain, Chain)
    if first.space is not second.space or first.n != second.n or len(first.joints) != len(second.joints):
        return None
    if code(first) != code(second):
        return None
    first_order, second_order = canonical_order(first), canonical_order(second)
    links = {first.links[a]: second.links[b] for a, b in zip(first_order.links, second_order.links, strict=True)}
    joints = dict(zip(first_order.joints, second_order.joints, strict=True))
    return Isomorphism(links, tuple(joints[k] for k in range(len(first.joints))))


@door_that_raises(ChainError)
def is_isomorphic(first: Chain, second: Chain) -> bool:
    """Whether two chains have the same structure, whatever the links are called.

    Args:
        first: any chain.
        second: another one.

    Returns:
        Whether the canonical codes are equal, which is exact.

    Raises:
        GrueblerError: something else than two chains.

    Cost:
        That of two canonical codes, some milliseconds for ten links.

    Example:
        >>> is_isomorphic(Chain.parse("R(a-b) R(b-c) P(c-a)"), Chain.parse("P(0-1) R(1-2) R(2-0)"))
        True

    See Also:
        `code`, `symmetry`

    Theory:
        docs/theory/canonical-code.md
    """
    return find_isomorphism(first, second) is not None
