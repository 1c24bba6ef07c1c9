"""Whether a graph can be drawn without crossings, or with one."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

Bundle = tuple[int, int, int]


def least_crossings(bundles: Iterable[Bundle]) -> int | None:
    """The fewest crossings of a drawing of a multigraph: 0, 1, or None for more.

    Args:
        bundles: (node, node, number of parallel edges), each two nodes once.

    One crossing suffices exactly if a new node in the middle of two edges without a common node makes the graph
    planar; edges that have parallels cannot be one of the two, since a parallel one would cross as well. Cost: a
    test of planarity for each two single edges.

    >>> five = list(combinations(range(5), 2))
    >>> least_crossings((u, v, 1) for u, v in five[1:]), least_crossings((u, v, 1) for u, v in five)
    (0, 1)
    >>> least_crossings((u, v, 2) for u, v in five)
    """
    import networkx as nx

    every = list(bundles)
    edges = [(u, v) for u, v, _ in every]
    graph = nx.Graph(edges)
    if nx.check_planarity(graph)[0]:
        return 0
    single = [(u, v) for u, v, k in every if k == 1]
    middle = 1 + max(v for edge in edges for v in edge)
    for first, second in combinations(single, 2):
        if set(first).isdisjoint(second):
            graph.remove_edges_from((first, second))
            graph.add_edges_from((middle, v) for v in first + second)
            planar = nx.check_planarity(graph)[0]
            graph.remove_node(middle)
            graph.add_edges_from((first, second))
            if planar:
                return 1
    return None
