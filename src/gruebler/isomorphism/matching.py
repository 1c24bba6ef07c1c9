"""Whether two chains have the same structure, with the correspondence as witness."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gruebler.chain import Chain
from gruebler.isomorphism.codes import canonical_order, code

__all__ = ["Isomorphism", "find_isomorphism", "is_isomorphic"]


@dataclass(frozen=True, slots=True)
class Isomorphism:
    """Which link and which joint of the other chain corresponds to each of the one."""

    links: Mapping[str, str]
    joints: tuple[int, ...]
    """joints[k] is the number, in the other chain, of the joint that corresponds to joint k."""


def find_isomorphism(one: Chain, other: Chain) -> Isomorphism | None:
    """A correspondence of links and joints that keeps space, pairs and incidence, or None if there is none.

    >>> find_isomorphism(Chain.parse("R(a-b) R(b-c) P(c-a)"), Chain.parse("P(0-1) R(1-2) R(2-0)")).links["b"]
    '2'
    """
    if one.space is not other.space or one.n != other.n or len(one.joints) != len(other.joints):
        return None
    if code(one) != code(other):
        return None
    mine, yours = canonical_order(one), canonical_order(other)
    links = {one.links[a]: other.links[b] for a, b in zip(mine.links, yours.links, strict=True)}
    joints = dict(zip(mine.joints, yours.joints, strict=True))
    return Isomorphism(links, tuple(joints[k] for k in range(len(one.joints))))


def is_isomorphic(one: Chain, other: Chain) -> bool:
    """Whether two chains have the same structure, names aside.

    >>> is_isomorphic(Chain.parse("R(a-b) R(b-c) P(c-a)"), Chain.parse("P(0-1) R(1-2) R(2-0)"))
    True
    """
    return find_isomorphism(one, other) is not None
