"""Slow and obvious ways to what the library finds otherwise."""

from __future__ import annotations

from functools import cache
from itertools import combinations

from gruebler import Chain, code
from gruebler.structure.assur import AssurGroup
from gruebler.structure.mechanism import Mechanism

Edges = tuple[tuple[int, int], ...]


@cache
def sound_graphs(links: int, mobility: int) -> tuple[Edges, ...]:
    """All connected graphs with 3(|S| - 1) - 2 e(S) >= 1 for every proper S of two or more vertices, and F for all.

    Grown vertex by vertex: such a graph has a vertex with one or two edges that is no cut vertex (count the edges of an
    end block), and without it the same holds.
    """
    if links == 1:
        return ((),) if mobility == 0 else ()
    if mobility < 0 or mobility > links - 1 or (links == 2 and mobility != 1):
        return ()
    found: dict[str, Edges] = {}
    for before, joints in ((mobility + 1, 2), (mobility - 1, 1)):
        for old in sound_graphs(links - 1, before):
            for ends in combinations(range(links - 1), joints):
                edges = (*old, *((end, links - 1) for end in ends))
                if _is_sound(links, edges):
                    found.setdefault(code(Chain.from_edges(edges)) if links > 2 else "", edges)
    return tuple(found.values())


def _is_sound(links: int, edges: Edges) -> bool:
    return all(
        3 * (size - 1) - 2 * sum(a in chosen and b in chosen for a, b in edges) >= 1
        for size in range(2, links)
        for chosen in map(set, combinations(range(links), size))
    )


def closed_chains(links: int, mobility: int) -> list[Chain]:
    """The chains of these graphs in which every link has two joints or more."""
    made = [Chain.from_edges(edges) for edges in sound_graphs(links, mobility)]
    return [chain for chain in made if min(chain.degrees.values()) > 1]


def blocks_by_subsets(mechanism: Mechanism) -> set[frozenset[str]]:
    """The links of each group against the frame, from all sets of links whose subchain is tight once drives are locked.

    For drives of joints with one freedom only. A group is what the same tight sets contain.
    """
    chain = mechanism.chain
    others = [link for link in chain.links if link != mechanism.frame]
    tight = []
    for size in range(len(others) + 1):
        for chosen in combinations(others, size):
            inside = {mechanism.frame, *chosen}
            free = 3 * size
            for joint in chain.joints:
                free -= joint.pair.u(chain.space) * max(0, len(inside.intersection(joint.links)) - 1)
            free -= sum(inside.issuperset(drive.between) for drive in mechanism.drives)
            if free == 0:
                tight.append(inside)
    classes: dict[frozenset[int], set[str]] = {}
    for link in others:
        classes.setdefault(frozenset(k for k, inside in enumerate(tight) if link in inside), set()).add(link)
    return {frozenset(links) for where, links in classes.items() if where}


def group_of_truss(truss: Chain, link: str) -> AssurGroup:
    """The group of a truss without this link; each of the link's joints gets a place of its own.

    >>> print(group_of_truss(Chain.parse("R(0-1) R(1-2) R(2-0)"), "0"))
    R(place1-1) R(1-2) R(2-place2)
    """
    joints, place = [], 0
    for joint in truss.joints:
        place += link in joint.links
        joints.append((joint.pair, [f"place{place}" if other == link else other for other in joint.links]))
    return AssurGroup(Chain(joints, space=truss.space))
