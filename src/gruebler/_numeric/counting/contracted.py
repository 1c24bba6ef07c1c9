"""Contracted graphs with one loop more: loopless two-connected multigraphs, all degrees at least 3.

Every one of them has an edge whose removal, followed by the suppression of vertices of degree 2, leaves such a
graph with one loop less (the last ear of an ear decomposition). McKay's canonical augmentation turns this into
a generator without doubles and without memory: a graph is kept when the edge just added lies in the orbit of
that removable edge of the result which an isomorphism-blind rule prefers.

Theorem and proof: docs/theory/enumeration.md, "Contracted graphs". Source: B. D. McKay, Isomorph-free
exhaustive generation, J. Algorithms 26 (1998) 306-324.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.counting.bits import lowest
from gruebler._numeric.counting.packed_graph import (
    GROUP,
    MIX,
    NODES,
    LabelMemory,
    bundle_strings,
    is_removable,
    label_packed,
    make_label_memory,
    order_of,
    set_bundle_strings,
    survey_graph,
)

Int64 = NDArray[np.int64]

BUNDLES: Final = 40  # pairs of adjacent vertices there is room for; nine loops need 24
CHILDREN: Final = 1024  # graphs that one graph can grow into; 21 bundles and 14 vertices give at most 651


class GrowthMemory(NamedTuple):
    """Memory of `add_loop`: the parent, its bundles and their symmetry, and the child under trial."""

    rows: Int64
    near: Int64
    degree: Int64
    ends: Int64  # (2, bundle)
    number: Int64  # edges of the bundle
    kept: Int64  # 1 if the bundle is removable
    at: Int64  # (vertex, vertex): the bundle between them
    images: Int64  # (automorphism, place): where it goes; places are vertices, then bundles
    child: Int64
    child_near: Int64
    child_degree: Int64
    hash: Int64  # (2, vertex)
    rivals: Int64  # (2, rival): other edges that the rule likes as well as the new one
    labels: LabelMemory


def make_growth_memory() -> GrowthMemory:
    """Memory for `add_loop`."""
    return GrowthMemory(
        rows=np.zeros(NODES, np.int64),
        near=np.zeros(NODES, np.int64),
        degree=np.zeros(NODES, np.int64),
        ends=np.zeros((2, BUNDLES), np.int64),
        number=np.zeros(BUNDLES, np.int64),
        kept=np.zeros(BUNDLES, np.int64),
        at=np.zeros((NODES, NODES), np.int64),
        images=np.zeros((GROUP, NODES + BUNDLES), np.int64),
        child=np.zeros(NODES, np.int64),
        child_near=np.zeros(NODES, np.int64),
        child_degree=np.zeros(NODES, np.int64),
        hash=np.zeros((2, NODES), np.int64),
        rivals=np.zeros((2, BUNDLES), np.int64),
        labels=make_label_memory(),
    )


@njit(cache=True)
def _prepare(n: int, memory: GrowthMemory) -> tuple[int, int]:
    """Bundles and automorphisms of the parent; returns the numbers of both."""
    rows, ends, at, images, leaves = memory.rows, memory.ends, memory.at, memory.images, memory.labels.leaves
    survey_graph(n, rows, memory.near, memory.degree)
    bundles = 0
    for v in range(n):
        for u in range(v):
            if bundle_strings(rows, u, v):
                ends[0, bundles] = u
                ends[1, bundles] = v
                memory.number[bundles] = bundle_strings(rows, u, v)
                memory.kept[bundles] = 1 if is_removable(n, memory.near, rows, u, v) else 0
                at[u, v] = bundles
                at[v, u] = bundles
                bundles += 1
    group = label_packed(n, memory.near, rows, memory.labels)
    for g in range(group):
        for i in range(n):
            images[g, leaves[0, i]] = leaves[g, i]
        for b in range(bundles):
            images[g, n + b] = n + at[images[g, ends[0, b]], images[g, ends[1, b]]]
    return bundles, group


@njit(cache=True)
def _rank(number: int, degrees: int) -> int:
    """What the rule looks at first: the edges between the two ends, then the sum of their degrees."""
    return number * 64 + degrees


@njit(cache=True)
def _outranked(n: int, bundles: int, p: int, q: int, rank: int, memory: GrowthMemory) -> bool:
    """Whether an old edge that the new one leaves alone is removable and preferred, seen without building.

    An edge removable before stays removable after an edge is added.
    """
    ends, degree = memory.ends, memory.degree
    for b in range(bundles):
        if memory.kept[b] and n + b != p and n + b != q and not (ends[0, b] == p and ends[1, b] == q):
            degrees = degree[ends[0, b]] + degree[ends[1, b]]
            if p < n and (ends[0, b] == p or ends[1, b] == p):
                degrees += 1
            if q < n and (ends[0, b] == q or ends[1, b] == q):
                degrees += 1
            if _rank(memory.number[b], degrees) > rank:
                return True
    return False


@njit(cache=True)
def _halve(h: int, u: int, v: int, rows: Int64) -> None:
    """Put the new vertex h on one edge between u and v."""
    rows[h] = 0
    set_bundle_strings(rows, u, v, bundle_strings(rows, u, v) - 1)
    set_bundle_strings(rows, u, h, 1)
    set_bundle_strings(rows, h, v, 1)


@njit(cache=True)
def _build(n: int, p: int, q: int, same_string: bool, memory: GrowthMemory) -> tuple[int, int, int]:
    """Join two places by an edge; returns the order of the child and the ends of the new edge.

    A place is a vertex or a bundle, on which a vertex is put first. With p = q a bundle, the two new vertices
    lie on one of its edges or on two.
    """
    child, ends = memory.child, memory.ends
    for v in range(n):
        child[v] = memory.rows[v]
    h, x, y = n, p, q
    if p >= n:
        x = h
        h += 1
        _halve(x, ends[0, p - n], ends[1, p - n], child)
    if q >= n:
        y = h
        h += 1
        _halve(y, x if p == q and same_string else ends[0, q - n], ends[1, q - n], child)
    set_bundle_strings(child, x, y, bundle_strings(child, x, y) + 1)
    survey_graph(h, child, memory.child_near, memory.child_degree)
    return h, x, y


@njit(cache=True)
def _hash_vertices(n: int, memory: GrowthMemory) -> None:
    """A word for every vertex of the child that sees two steps far; isomorphic places get equal words."""
    child, near, words, spare = memory.child, memory.child_near, memory.hash[0], memory.hash[1]
    for v in range(n):
        words[v] = MIX[memory.child_degree[v] & 255]
    for _ in range(2):
        for v in range(n):
            total = 0
            bits = near[v]
            while bits:
                u = lowest(bits)
                bits &= bits - 1
                mixed = (words[u] ^ MIX[bundle_strings(child, u, v)]) * 0x1F58476D1CE4E5B9
                total += mixed ^ ((mixed >> 29) & 0x7FFFFFFFF)
            spare[v] = words[v] * 31 + total
        for v in range(n):
            words[v] = spare[v]


@njit(cache=True)
def _rivals(h: int, x: int, y: int, rank: int, memory: GrowthMemory) -> int:
    """The number of other edges as good as the new one by rank and hash; -1 if one of them is better."""
    child, near, degree, rivals = memory.child, memory.child_near, memory.child_degree, memory.rivals
    found = 0
    for v in range(h):
        for u in range(v):
            number = bundle_strings(child, u, v)
            if number == 0 or (u == x and v == y) or (u == y and v == x):
                continue
            other = _rank(number, degree[u] + degree[v])
            if other > rank and is_removable(h, near, child, u, v):
                return -1
            if other == rank:
                rivals[0, found] = u
                rivals[1, found] = v
                found += 1
    if found == 0:
        return 0
    _hash_vertices(h, memory)
    words = memory.hash[0]
    mine = words[x] + words[y]
    kept = 0
    for i in range(found):
        u, v = rivals[0, i], rivals[1, i]
        if words[u] + words[v] >= mine and is_removable(h, near, child, u, v):
            if words[u] + words[v] > mine:
                return -1
            rivals[0, kept] = u
            rivals[1, kept] = v
            kept += 1
    return kept


@njit(cache=True)
def _preferred(h: int, x: int, y: int, rivals: int, group: int, memory: GrowthMemory) -> bool:
    """Whether the new edge can be carried by an automorphism to the canonically first of its rivals."""
    leaves, place = memory.labels.leaves, memory.hash[1]
    for i in range(h):
        place[leaves[0, i]] = i
    best = min(place[x], place[y]) * NODES + max(place[x], place[y])
    u, v = x, y
    for i in range(rivals):
        a, b = memory.rivals[0, i], memory.rivals[1, i]
        code = min(place[a], place[b]) * NODES + max(place[a], place[b])
        if code < best:
            best, u, v = code, a, b
    px, py = place[x], place[y]
    for g in range(group):
        a, b = leaves[g, px], leaves[g, py]
        if (a == u and b == v) or (a == v and b == u):
            return True
    return False


@njit(cache=True)
def _least(p: int, q: int, group: int, images: Int64) -> bool:
    """Whether no automorphism of the parent sends these two places to an earlier pair."""
    for g in range(1, group):
        a, b = images[g, p], images[g, q]
        if a > b:
            a, b = b, a
        if a < p or (a == p and b < q):
            return False
    return True


@njit(cache=True, nogil=True)
def add_loop(parents: Int64, first: int, out: Int64, memory: GrowthMemory) -> tuple[int, int]:
    """The contracted graphs with one loop more that have their canonical parent in a list.

    Args:
        parents: int64[k, nodes], packed graphs of L loops, each isomorphism class once.
        first: the parent to begin with.
        out: int64[m, 16], filled with canonical rows; room for CHILDREN graphs at least.
        memory: from `make_growth_memory`.

    Returns:
        The number of graphs written, and the parent to go on with when `out` became too full for another one.

    The order depends on the order of the parents only, and a parent's children do not depend on its
    numbering once it is canonical. Cost: about 1.7 us for each graph of nine loops.
    """
    total = 0
    for k in range(first, parents.shape[0]):
        if out.shape[0] - total < CHILDREN:
            return total, k
        n = order_of(parents[k])
        for v in range(n):
            memory.rows[v] = parents[k, v]
        bundles, group = _prepare(n, memory)
        degree, ends, number = memory.degree, memory.ends, memory.number
        for p in range(n + bundles):
            for q in range(p, n + bundles):
                if p == q and q < n:
                    continue
                if not _least(p, q, group, memory.images):
                    continue
                for kind in range(2 if p == q and number[q - n] > 1 else 1):
                    if q < n:
                        rank = _rank(bundle_strings(memory.rows, p, q) + 1, degree[p] + degree[q] + 2)
                    elif p < n:
                        touches = ends[0, q - n] == p or ends[1, q - n] == p
                        rank = _rank(2 if touches else 1, degree[p] + 4)
                    else:
                        rank = _rank(2 if p == q and kind == 0 else 1, 6)
                    if _outranked(n, bundles, p, q, rank, memory):
                        continue
                    h, x, y = _build(n, p, q, kind == 0, memory)
                    rivals = _rivals(h, x, y, rank, memory)
                    if rivals < 0:
                        continue
                    symmetries = label_packed(h, memory.child_near, memory.child, memory.labels)
                    if rivals and not _preferred(h, x, y, rivals, symmetries, memory):
                        continue
                    for i in range(NODES):
                        out[total, i] = memory.labels.best[i] if i < h else 0
                    total += 1
    return total, parents.shape[0]
