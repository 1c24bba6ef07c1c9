"""Epicyclic trains by another method: trees of links and axes from networkx, sets of pairs judged by their speeds."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from itertools import combinations
from random import Random

import networkx as nx
import numpy as np
from numpy.typing import NDArray

__all__ = ["count_by_speeds", "link_axis_trees", "trains_by_speeds"]

Triples = list[tuple[int, int, int]]

_PRIME = 2**31 - 1  # tooth numbers are drawn below it; products of two residues fit into 64 bits


def count_by_speeds(links: int, mobility: int) -> tuple[int, int]:
    """The numbers of displacement graphs and rotation graphs."""
    trains = list(trains_by_speeds(links, mobility))
    return len(trains), _classes(trains)


def trains_by_speeds(links: int, mobility: int) -> Iterator[Triples]:
    """The gear pairs (gear, gear, carrier) of each displacement graph once."""
    for tree in link_axis_trees(links):
        pairs = [
            (a, b, path[2])
            for a, b in combinations(range(links), 2)
            if len(path := nx.shortest_path(tree, a, b)) == 5  # gear, axis, carrier, axis, gear
        ]
        sets = _movable_sets(links, pairs, links - 1 - mobility)
        spans = np.array([sum(1 << link for link in pair) for pair in pairs], np.int64)
        sets = sets[np.bitwise_or.reduce(spans[sets], axis=1) == 2**links - 1] if len(sets) else sets
        for row in _one_of_each_orbit(sets, _images(tree, links, pairs)):
            yield [pairs[k] for k in row]


def link_axis_trees(links: int) -> Iterator[nx.Graph]:
    """Links 0, 1, ... and the axes they lie on, connected without a loop; at each axis there are two links or more.

    These are the trees whose leaves all belong to the same class of the two-colouring, the class of the links.
    """
    if links == 1:
        yield nx.empty_graph(1)
    for axes in range(1, links):
        for tree in nx.nonisomorphic_trees(links + axes):
            leaf = next(v for v in tree if tree.degree(v) == 1)
            distance = nx.single_source_shortest_path_length(tree, leaf)
            inner = [v for v in tree if distance[v] % 2]
            if len(inner) == axes and all(tree.degree(v) > 1 for v in inner):
                order = [v for v in tree if distance[v] % 2 == 0] + inner
                yield nx.relabel_nodes(tree, {v: k for k, v in enumerate(order)})


def _movable_sets(links: int, pairs: Triples, size: int) -> NDArray[np.int64]:
    """The sets of so many pairs that leave no two links turning alike: rows of places in `pairs`.

    A pair's equation has random entries of sum 0. For every set there is a basis of the speeds that satisfy its
    equations, int64[links, ...] modulo a prime; a further pair must make it smaller, and no two links may have the
    same row.
    """
    random = Random(20)
    entries = [(random.randrange(1, _PRIME), random.randrange(1, _PRIME)) for _ in pairs]
    sets = np.zeros((1, 0), np.int64)
    bases = np.eye(links, dtype=np.int64)[None]
    for _ in range(size):
        grown, smaller = [np.zeros((0, sets.shape[1] + 1), np.int64)], [bases[:0, :, 1:]]
        for place, (a, b, carrier) in enumerate(pairs):
            below = sets[:, -1] < place if sets.shape[1] else np.ones(1, np.bool_)
            rest = bases[below]
            one, other = entries[place]
            third = -(one + other) % _PRIME
            value = rest[:, a] * one % _PRIME + rest[:, b] * other % _PRIME + rest[:, carrier] * third % _PRIME
            value %= _PRIME
            counts = value.any(axis=1)
            rest, value, before = rest[counts], value[counts], sets[below][counts]
            pivot = value.argmax(axis=1)
            every = np.arange(len(rest))
            scale, column = value[every, pivot], rest[every, :, pivot]
            rest = (rest * scale[:, None, None] % _PRIME - column[:, :, None] * value[:, None, :] % _PRIME) % _PRIME
            left = np.arange(rest.shape[2] - 1)
            rest = np.take_along_axis(rest, (left + (left >= pivot[:, None]))[:, None, :], axis=2)
            free = np.ones(len(rest), np.bool_)
            for u, v in combinations(range(links), 2):
                free &= (rest[:, u] != rest[:, v]).any(axis=1)
            grown.append(np.column_stack([before[free], np.full(free.sum(), place)]))
            smaller.append(rest[free])
        sets, bases = np.concatenate(grown), np.concatenate(smaller)
    return sets


def _images(tree: nx.Graph, links: int, pairs: Triples) -> NDArray[np.int64]:
    """int64[symmetries, pairs]: the image of each pair under each symmetry of the tree."""
    place = {frozenset(pair[:2]): k for k, pair in enumerate(pairs)}
    for v in tree:
        tree.nodes[v]["axis"] = v >= links
    symmetries = nx.isomorphism.GraphMatcher(
        tree, tree, node_match=nx.isomorphism.categorical_node_match("axis", None)
    ).isomorphisms_iter()
    return np.array([[place[frozenset((image[a], image[b]))] for a, b, _ in pairs] for image in symmetries])


def _one_of_each_orbit(sets: NDArray[np.int64], images: NDArray[np.int64]) -> Iterator[list[int]]:
    """A set of each orbit of the symmetries; whole orbits are marked."""
    masks = (np.int64(1) << sets).sum(axis=1)
    order = np.argsort(masks)
    masks, sets = masks[order], sets[order]
    fresh = np.ones(len(masks), np.bool_)
    for k, row in enumerate(sets):
        if fresh[k]:
            orbit = (np.int64(1) << images[:, row]).sum(axis=1)
            place = np.searchsorted(masks, orbit)
            assert (masks[place] == orbit).all()
            fresh[place] = False
            yield row.tolist()


def _classes(trains: list[Triples]) -> int:
    """How many classes of isomorphic sets of triples there are: networkx compares those of equal invariants."""
    classes: dict[object, list[nx.Graph]] = defaultdict(list)
    for pairs in trains:
        graph = nx.Graph()
        for number, (a, b, carrier) in enumerate(pairs):
            for link, role in ((a, "gear"), (b, "gear"), (carrier, "carrier")):
                graph.add_edge(("pair", number), link, role=role)
        like = classes[_invariant(pairs)]
        same = nx.isomorphism.categorical_edge_match("role", None)
        if not any(nx.is_isomorphic(graph, other, edge_match=same) for other in like):
            like.append(graph)
    return sum(map(len, classes.values()))


def _invariant(pairs: Triples) -> object:
    """Numbers for each link that do not depend on names: what it does, and what the links beside it do."""
    kind = dict.fromkeys({link for pair in pairs for link in pair}, 0)
    for _ in range(3):
        around: dict[int, list[object]] = {link: [] for link in kind}
        for a, b, carrier in pairs:
            seen = (*sorted((kind[a], kind[b])), kind[carrier])
            around[a].append((0, kind[a], *seen))
            around[b].append((0, kind[b], *seen))
            around[carrier].append((1, kind[carrier], *seen))
        kind = {link: hash(tuple(sorted(rows))) for link, rows in around.items()}
    return tuple(sorted(kind.values()))
