"""Graphs that have no drawing without crossings: a crossing becomes a vertex, until an embedding exists.

A search among pairs of bars, first one pair, then two, finds the least number of crossings. Where it fails, edges
are inserted into an embedding of the others along shortest paths through its faces, which is not proved to be minimal.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Any

from gruebler.pictures.structure.embedding import is_planar

Edge = tuple[int, int]
_SEARCHED = 2  # crossings; the search for more takes too long
_TRIES = 600
_COST = 5  # of crossing a spoke, where crossing a bar costs 1: a bar over a polygon is uglier than two bars


@dataclass(frozen=True, slots=True)
class PlanarisedGraph:
    """A planar graph in which the vertices from ``first`` on are crossings; the strand through each edge."""

    graph: tuple[tuple[int, ...], ...]
    first: int
    strands: tuple[tuple[int, ...], ...]
    """The crossed edges of the old graph as paths through crossings."""

    def is_crossing(self, rotation: list[list[int]]) -> bool:
        """Whether the strands cross, not touch, at each crossing of an embedding."""
        through: dict[int, list[set[int]]] = {}
        for path in self.strands:
            for u, v, w in zip(path, path[1:], path[2:], strict=False):
                through.setdefault(v, []).append({u, w})
        return all({rotation[v][0], rotation[v][2]} in pairs for v, pairs in through.items())


def planarised_graph(graph: list[list[int]], bars: list[Edge]) -> list[PlanarisedGraph]:
    """All planar graphs with the fewest crossings of bars, or one with any necessary crossings."""
    if is_planar(graph):
        return [PlanarisedGraph(tuple(map(tuple, graph)), len(graph), ())]
    pairs = [(e, f) for e, f in combinations(bars, 2) if not set(e) & set(f)]
    led = _inserted(graph, bars)
    for number in range(1, min(_SEARCHED, len(led.graph) - led.first) + 1):
        chosen = list(combinations(pairs, number))
        if len(chosen) > _TRIES:
            break
        if planarised_graphs := [
            c for crossings in chosen if (c := _with_crossings(graph, crossings)) and is_planar(c.graph)
        ]:
            return planarised_graphs
    return [led]


def _with_crossings(graph: list[list[int]], crossings: tuple[tuple[Edge, Edge], ...]) -> PlanarisedGraph | None:
    """The graph with a vertex on both edges for each crossing; None if an edge is crossed twice (ambiguous order)."""
    edges = [e for pair in crossings for e in pair]
    if len(set(edges)) < len(edges):
        return None
    planar = [list(around) for around in graph]
    strands = []
    for pair in crossings:
        middle = len(planar)
        planar.append([])
        for u, v in pair:
            planar[u][planar[u].index(v)] = middle
            planar[v][planar[v].index(u)] = middle
            planar[middle] += [u, v]
            strands.append((u, middle, v))
    return PlanarisedGraph(tuple(map(tuple, planar)), len(graph), tuple(strands))


def _inserted(graph: list[list[int]], bars: list[Edge]) -> PlanarisedGraph:
    """A planar part of the graph, with every other edge inserted through its faces over as few edges as possible."""
    import networkx as nx

    easy = {frozenset(bar) for bar in bars}
    edges = [(u, v) for u, around in enumerate(graph) for v in around if u < v]
    edges.sort(key=lambda e: frozenset(e) in easy)  # spokes first, so that bars are omitted rather than spokes
    net = nx.Graph()
    net.add_nodes_from(range(len(graph)))
    omitted = []
    for u, v in edges:
        net.add_edge(u, v, strand=(u, v))
        if not nx.check_planarity(net)[0]:
            net.remove_edge(u, v)
            omitted.append((u, v))
    for u, v in omitted:
        _lead(net, u, v, easy)
    strands = _strands(net)
    return PlanarisedGraph(tuple(tuple(sorted(net[v])) for v in range(len(net))), len(graph), strands)


def _lead(net: Any, u: int, v: int, easy: set[frozenset[int]]) -> None:
    """Add the edge from u to v along a shortest path through the faces of an embedding of the net."""
    path, over = _way(net, u, v, easy)
    before = u
    for step in pairwise(path[1:-1]):
        a, b = over[step]
        strand = net[a][b]["strand"]
        middle = len(net)
        net.remove_edge(a, b)
        net.add_edge(a, middle, strand=strand)
        net.add_edge(middle, b, strand=strand)
        net.add_edge(before, middle, strand=(u, v))
        before = middle
    net.add_edge(before, v, strand=(u, v))


def _way(net: Any, u: int, v: int, easy: set[frozenset[int]]) -> tuple[list[int], dict[Edge, Edge]]:
    """Faces from u to v, between the ends -1 and -2, and the edge that each step crosses."""
    import networkx as nx

    _, embedding = nx.check_planarity(net)
    face: dict[Edge, int] = {}
    for number, dart in enumerate(sorted(embedding.edges)):
        if dart not in face:
            walk: set[Edge] = set()
            embedding.traverse_face(*dart, mark_half_edges=walk)
            face |= dict.fromkeys(walk, number)
    dual = nx.DiGraph()
    over: dict[Edge, Edge] = {}
    for (a, b), f in sorted(face.items()):
        step, cost = (f, face[b, a]), 1 if frozenset(net[a][b]["strand"]) in easy else _COST
        if step not in over or cost < dual.edges[step]["weight"]:
            over[step] = (a, b)
            dual.add_edge(*step, weight=cost)
        if a == u:
            dual.add_edge(-1, f, weight=0)
        if a == v:
            dual.add_edge(f, -2, weight=0)
    return nx.shortest_path(dual, -1, -2, weight="weight"), over


def _strands(net: Any) -> tuple[tuple[int, ...], ...]:
    """The edges that cross others, as paths."""
    import networkx as nx

    parts: dict[Edge, list[Edge]] = {}
    for a, b, strand in net.edges(data="strand"):
        parts.setdefault(strand, []).append((a, b))
    return tuple(
        tuple(nx.shortest_path(nx.Graph(some), *strand)) for strand, some in sorted(parts.items()) if len(some) > 1
    )
