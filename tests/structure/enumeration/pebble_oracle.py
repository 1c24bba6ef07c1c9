"""Chains of a contracted graph by another method: every distribution of the binary links, judged by a pebble game.

No theorem about strings or bundles is used but that a chain is a contracted graph with its binary links: the joints of
a chain of mobility 1, each taken twice, are (3, 4)-tight (A. Lee and I. Streinu, Discrete Math. 308, 2008).
"""

from __future__ import annotations

from collections.abc import Sequence

import networkx as nx
import numba
import numpy as np
from numpy.typing import NDArray

__all__ = ["count_by_pebbles"]

Int64 = NDArray[np.int64]
Int8 = NDArray[np.int8]


def count_by_pebbles(bundles: Sequence[tuple[int, int, int]], links: int) -> int:
    """The number of chains with F = 1 and so many links that have this contracted graph: (node, node, strings)."""
    bundles = _dense_first(bundles)
    ends = np.array([(u, v) for u, v, k in bundles for _ in range(k)], np.int64)
    same = np.array([i > 0 for _, _, k in bundles for i in range(k)])
    nodes = int(ends.max()) + 1
    images = np.array(_bundle_symmetries(bundles), np.int64)
    first = np.cumsum([0, *(k for _, _, k in bundles)])
    return int(_count(nodes, links, ends, same, images, first))


def _dense_first(bundles: Sequence[tuple[int, int, int]]) -> list[tuple[int, int, int]]:
    """The bundles, those between earlier nodes first, so that what is too dense is seen early."""
    graph = nx.Graph()
    graph.add_weighted_edges_from(bundles)
    order = [max(graph, key=lambda v: graph.degree(v, "weight"))]
    while len(order) < len(graph):
        order.append(max(set(graph) - set(order), key=lambda v: (sum(w in order for w in graph[v]), -v)))
    place = {v: k for k, v in enumerate(order)}
    moved = [(min(place[u], place[v]), max(place[u], place[v]), k) for u, v, k in bundles]
    return sorted(moved, key=lambda bundle: (bundle[1], bundle[0]))


def _bundle_symmetries(bundles: Sequence[tuple[int, int, int]]) -> list[list[int]]:
    """The permutations of the bundles by all symmetries of the nodes, found by networkx."""
    graph = nx.Graph()
    graph.add_weighted_edges_from(bundles)
    place = {frozenset((u, v)): k for k, (u, v, _) in enumerate(bundles)}
    matcher = nx.isomorphism.GraphMatcher(graph, graph, edge_match=lambda a, b: a["weight"] == b["weight"])
    return [[place[frozenset((image[u], image[v]))] for u, v, _ in bundles] for image in matcher.isomorphisms_iter()]


@numba.njit
def _gather(vertices: int, u: int, v: int, free: Int8, out: Int8, before: Int64, queue: Int64) -> bool:
    """Bring one more free pebble to u, by a path along the edges, without taking one from v; False if there is none."""
    for w in range(vertices):
        before[w] = -1
    before[u] = u
    before[v] = v
    queue[0] = u
    count, k = 1, 0
    while k < count:
        x = queue[k]
        k += 1
        for w in range(vertices):
            if out[x, w] > 0 and before[w] < 0:
                before[w] = x
                if free[w] > 0:
                    free[w] -= 1
                    end = w
                    while end != u:
                        x = before[end]
                        out[x, end] -= 1
                        out[end, x] += 1
                        end = x
                    free[u] += 1
                    return True
                queue[count] = w
                count += 1
    return False


@numba.njit
def _add_joint(vertices: int, u: int, v: int, free: Int8, out: Int8, before: Int64, queue: Int64) -> bool:
    """Two edges between u and v; False if a part would have more than three times its vertices less four edges."""
    for _ in range(2):
        while free[u] + free[v] < 5:
            if free[u] < 3 and _gather(vertices, u, v, free, out, before, queue):
                continue
            if free[v] < 3 and _gather(vertices, v, u, free, out, before, queue):
                continue
            return False
        if free[u] > 0:
            free[u] -= 1
            out[u, v] += 1
        else:
            free[v] -= 1
            out[v, u] += 1
    return True


@numba.njit
def _is_first(weights: Int64, images: Int64, first: Int64, moved: Int64) -> bool:
    """Whether no symmetry makes the weights smaller; those of a bundle are in ascending order."""
    for g in range(images.shape[0]):
        for b in range(images.shape[1]):
            to = images[g, b]
            for i in range(first[b + 1] - first[b]):
                moved[first[to] + i] = weights[first[b] + i]
        for i in range(weights.size):
            if moved[i] != weights[i]:
                if moved[i] < weights[i]:
                    return False
                break
    return True


@numba.njit
def _count(nodes: int, links: int, ends: Int64, same: Int64, images: Int64, first: Int64) -> int:
    """All weights of the strings, one string after another, ascending within a bundle; up to symmetry."""
    strings = ends.shape[0]
    free = np.full((strings + 1, links), 3, np.int8)
    out = np.zeros((strings + 1, links, links), np.int8)
    used = np.full(strings + 1, nodes, np.int64)
    weights = np.full(strings, -1, np.int64)
    moved = np.zeros(strings, np.int64)
    before, queue = np.zeros(links, np.int64), np.zeros(links, np.int64)
    found = 0
    s = 0
    while s >= 0:
        if s == strings:
            if used[s] == links and _is_first(weights, images, first, moved):
                found += 1
            s -= 1
            continue
        weights[s] = weights[s] + 1 if weights[s] >= 0 else (weights[s - 1] if same[s] else 0)
        w = weights[s]
        if used[s] + w > links:
            weights[s] = -1
            s -= 1
            continue
        if s == strings - 1 and used[s] + w < links:
            continue
        free[s + 1] = free[s]
        out[s + 1] = out[s]
        here = ends[s, 0]
        good = True
        for i in range(w + 1):
            there = used[s] + i if i < w else ends[s, 1]
            good = good and _add_joint(links, here, there, free[s + 1], out[s + 1], before, queue)
            here = there
        if good:
            used[s + 1] = used[s] + w
            s += 1
            if s < strings:
                weights[s] = -1
    return found
