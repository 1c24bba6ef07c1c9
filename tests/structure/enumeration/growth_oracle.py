"""Multiple joints another way: codes of all chains and their splits, tables of all sets of links, no kernel."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from gruebler.structure.chain import Chain, Joint
from gruebler.structure.enumeration.fractionation_class import joint_masks
from gruebler.structure.isomorphism import canonical_order, code
from tests.structure.enumeration.definition_oracle import freedoms_of_sets

__all__ = ["grown_one_by_one", "merge_joints", "split_multiple_joints"]


def grown_one_by_one(
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

    Order: every chain before those that grow from it, these in the order of their codes. Cost: a table of 2^n
    numbers and three canonical forms for each chain visited.

    """
    for chain in simple:
        yield from _grown(chain, code(chain), fewest, most, largest)


def _grown(chain: Chain, name: str, fewest: int, most: int | None, largest: int | None) -> Iterator[Chain]:
    if len(chain.multiple_joints) >= fewest:
        yield chain
    children: dict[str, Chain] = {}
    for child in merge_joints(chain, preferred=True):
        if most is not None and len(child.multiple_joints) > most:
            continue
        if largest is not None and max(len(joint.links) for joint in child.joints) > largest:
            continue
        children.setdefault(code(child), child)
    for child_name, child in sorted(children.items()):
        if code(split_multiple_joints(child)) == name:
            yield from _grown(child, child_name, fewest, most, largest)


def merge_joints(chain: Chain, *, preferred: bool = False) -> Iterator[Chain]:
    """The valid chains after merging a joint with a simple joint at one of its links; may contain duplicates.

    Merging the joint J with the simple joint {a, b}, a in J, takes two from d(S) exactly where S contains b and a link
    of J but not a, so these sets need d(S) >= 3. With `preferred`, merges are left out that undo a split which
    `split_multiple_joints` would certainly not choose. Cost O(2^n) for each two joints that share a link.
    """
    n = chain.n
    joints = joint_masks(chain)
    near = _neighbours(n, joints)
    freedoms = freedoms_of_sets(n, joints)
    sets = np.arange(1 << n, dtype=np.int64)
    for k, big in enumerate(joints):
        for m, small in enumerate(joints):
            if k == m or small.bit_count() > 2 or (big & small).bit_count() != 1:
                continue
            a, b = (big & small).bit_length() - 1, (small & ~big).bit_length() - 1
            if chain.degrees[chain.links[a]] < 3 or near[b] & big & ~small:
                continue
            if not _room(sets, freedoms, big, a, b):
                continue
            after = [big | small if i == k else joint for i, joint in enumerate(joints) if i != m]
            if not preferred or (big | small, a, b) in _best_splits(n, after):
                yield _merge(chain, k, m, chain.links[b])


def _room(sets: NDArray[np.int64], freedoms: NDArray[np.int32], big: int, a: int, b: int) -> bool:
    """Whether d(S) >= 3 for every S that contains link b and a link of the joint, but not link a."""
    concerned = (sets & (1 << a | 1 << b) == 1 << b) & (sets & big != 0)
    return int(freedoms.min(where=concerned, initial=3)) >= 3


def _neighbours(n: int, joints: Sequence[int]) -> list[int]:
    """For each link the set of the links that share a joint with it."""
    near = [0] * n
    for joint in joints:
        for i in _members(joint):
            near[i] |= joint & ~(1 << i)
    return near


def _members(links: int) -> list[int]:
    return [i for i in range(links.bit_length()) if links >> i & 1]


def _merge(chain: Chain, k: int, m: int, link: str) -> Chain:
    """The chain with a link of the simple joint m put into joint k."""
    joints = [
        Joint(joint.pair, (*joint.links, link)) if i == k else joint for i, joint in enumerate(chain.joints) if i != m
    ]
    return Chain(joints, links=chain.links)


def _best_splits(n: int, joints: Sequence[int]) -> list[tuple[int, int, int]]:
    """The preferred splits (joint, link a that keeps both joints, link b that leaves the joint).

    The preference counts links and joints only, so it does not depend on the numbering.
    """
    members = [_members(joint) for joint in joints]
    degree = [0] * n
    for links in members:
        for i in links:
            degree[i] += 1
    around = [0] * n
    for links in members:
        square = sum(degree[i] * degree[i] for i in links)
        for i in links:
            around[i] += square
    best_key: tuple[int, ...] = ()
    splits: list[tuple[int, int, int]] = []
    for joint, links in zip(joints, members, strict=True):
        if len(links) < 3:
            continue
        for a, b in permutations(links, 2):
            key = (len(links), degree[a], around[a], degree[b], around[b])
            if key > best_key:
                best_key, splits = key, []
            if key == best_key:
                splits.append((joint, a, b))
    return splits


def split_multiple_joints(chain: Chain) -> Chain:
    """The canonical split of a chain with multiple joints: the same structure gives the same split structure.

    One link leaves a multiple joint for a simple joint with another link of it.

    """
    rank = {link: place for place, link in enumerate(canonical_order(chain).links)}
    joints = joint_masks(chain)

    def canonical(choice: tuple[int, int, int]) -> tuple[list[int], int, int]:
        joint, a, b = choice
        return sorted(rank[i] for i in _members(joint)), rank[a], rank[b]

    joint, a, b = min(_best_splits(chain.n, joints), key=canonical)
    k = joints.index(joint)
    kind, leaving = chain.joints[k].pair, chain.links[b]
    reduced_joint = Joint(kind, tuple(link for link in chain.joints[k].links if link != leaving))
    changed = [reduced_joint if i == k else joint for i, joint in enumerate(chain.joints)]
    return Chain([*changed, Joint(kind, (chain.links[a], leaving))], links=chain.links)
