"""Contracted graphs: the graphs of chains with every string of binary links contracted to an edge.

A contracted graph is a loopless two-connected multigraph whose nodes all have three edges or more; its nodes
are the links of a chain with three joints or more, its edges the strings of binary links between them. There
are 1, 4, 17, 118, 1198, 17133, 311757 with 2, 3, ..., 8 loops.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import GrueblerError
from gruebler.base.immutable import settle

if TYPE_CHECKING:
    import networkx as nx

MOST_LOOPS = 10
"""Contracted graphs of more loops have more nodes than the kernels' 18; there are some thousand million of them."""

_NODES = 18
_BLOCK = 8192  # graphs in a block

Packed = NDArray[np.int64]
"""int64[k, 18]: a graph in each row, four bits for the number of edges between two nodes; three from 17 nodes on."""


@dataclass(frozen=True)
class ContractedGraph:
    """A contracted graph, its nodes numbered from 0.

    Args:
        bundles: (node, node, number of parallel strings), in any order; kept as graph6 orders its bits: by the
            greater node, then by the smaller one.

    Raises:
        GrueblerError: a loop, a repeated bundle or one of no strings, nodes not numbered 0, 1, ..., a node of
            fewer than three strings, a disconnected graph or one with a cut vertex.

    >>> graph = ContractedGraph(((0, 1, 2), (1, 2, 2), (0, 2, 1)))
    >>> graph.nodes, graph.loops, graph.degrees
    (3, 3, (3, 4, 3))
    """

    bundles: tuple[tuple[int, int, int], ...]

    def __post_init__(self) -> None:
        whole = sorted(((min(u, v), max(u, v), k) for u, v, k in self.bundles), key=lambda b: (b[1], b[0]))
        settle(self, bundles=tuple(whole))
        _check(self)

    @property
    def nodes(self) -> int:
        """The number of nodes."""
        return len(self.degrees)

    @property
    def strings(self) -> int:
        """The number of strings, parallel ones counted separately."""
        return sum(k for _, _, k in self.bundles)

    @property
    def loops(self) -> int:
        """The number of independent loops, strings - nodes + 1."""
        return self.strings - self.nodes + 1

    @cached_property
    def degrees(self) -> tuple[int, ...]:
        """The number of strings at every node."""
        degrees = [0] * (1 + max(v for _, v, _ in self.bundles))
        for u, v, k in self.bundles:
            degrees[u] += k
            degrees[v] += k
        return tuple(degrees)

    @cached_property
    def automorphisms(self) -> tuple[tuple[int, ...], ...]:
        """All symmetries as images of the nodes 0, 1, ..., sorted; the identity is the first.

        >>> ContractedGraph(((0, 1, 3),)).automorphisms
        ((0, 1), (1, 0))
        """
        from gruebler import _core

        return tuple(sorted(tuple(image) for image in _core.find_automorphisms(self._packed()).tolist()))

    @cached_property
    def is_planar(self) -> bool:
        """Whether it can be drawn without crossings; its chains then can, and only then."""
        import networkx as nx

        return bool(nx.check_planarity(nx.Graph((u, v) for u, v, _ in self.bundles))[0])

    def canonical(self) -> ContractedGraph:
        """The isomorphic graph that `contracted_graphs` yields; equal for isomorphic graphs."""
        from gruebler import _core

        return unpacked(_core.canonical_rows(self._packed()))

    def multigraph(self) -> nx.MultiGraph:
        """The graph for networkx, an edge for each string."""
        import networkx as nx

        return nx.MultiGraph((u, v) for u, v, k in self.bundles for _ in range(k))

    def _packed(self) -> Packed:
        """int64[18]; `GrueblerError` if the graph is too large for it."""
        field = _field(self.nodes)
        if self.nodes > _NODES or max(k for _, _, k in self.bundles) >= 1 << field:
            raise GrueblerError(
                "only contracted graphs of at most {most} nodes and {strings} parallel strings can be processed, this "
                "one has {nodes} nodes",
                most=_NODES,
                strings=(1 << field) - 1,
                nodes=self.nodes,
            )
        rows = np.zeros(_NODES, np.uint64)
        for u, v, k in self.bundles:
            rows[u] |= np.uint64(k << field * v)
            rows[v] |= np.uint64(k << field * u)
        return rows.view(np.int64)


def _check(graph: ContractedGraph) -> None:
    pairs = [(u, v) for u, v, _ in graph.bundles]
    wrong = next(((u, v, k) for u, v, k in graph.bundles if u < 0 or u == v or k < 1), None)
    if wrong is not None or not pairs:
        raise GrueblerError("a bundle is (node, other node, number of strings >= 1), not {found}", found=wrong)
    if len(set(pairs)) < len(pairs):
        raise GrueblerError("two bundles between the same nodes: give the number of all their strings in one")
    poor = next((v for v, degree in enumerate(graph.degrees) if degree < 3), None)
    if poor is not None:
        raise GrueblerError(
            "every node has three strings or more, node {node} has {degree}", node=poor, degree=graph.degrees[poor]
        )
    near: list[set[int]] = [set() for _ in graph.degrees]
    for u, v in pairs:
        near[u].add(v)
        near[v].add(u)
    for missing in range(-1, graph.nodes if graph.nodes > 2 else 0):
        start = 1 if missing == 0 else 0
        visited = {start, missing}
        front = [start]
        while front:
            fresh = near[front.pop()] - visited
            visited |= fresh
            front.extend(fresh)
        if len(visited - {-1}) < graph.nodes:
            raise GrueblerError(
                "a contracted graph is two-connected, this one is disconnected"
                if missing < 0
                else "a contracted graph is two-connected, this one falls apart at node {node}",
                node=missing,
            )


def _field(nodes: int) -> int:
    """Bits for the number of edges between two nodes."""
    return 3 if nodes > 16 else 4


def unpacked(rows: Packed) -> ContractedGraph:
    """The value of one packed graph, without a check."""
    numbers = [int(row) & (2**64 - 1) for row in rows if row]
    field = _field(len(numbers))
    strings = [[row >> field * v & (1 << field) - 1 for v in range(len(numbers))] for row in numbers]
    bundles = tuple((u, v, strings[u][v]) for v in range(len(numbers)) for u in range(v) if strings[u][v])
    graph = object.__new__(ContractedGraph)
    settle(graph, bundles=bundles)
    return graph


def packed_graphs(loops: int) -> Iterator[Packed]:
    """All contracted graphs with this number of loops, canonically labelled, in blocks of int64[k, 18].

    Order: the theta graph; then the graphs that grow from each graph of one loop less, in turn. Within a
    graph the nodes have falling degrees. Memory: a block for each number of loops. Cost: 0.6 s for all 311757 graphs
    of 8 loops, on one core.

    Raises:
        GrueblerError: loops < 2 or more than MOST_LOOPS.
    """
    if not 2 <= loops <= MOST_LOOPS:
        raise GrueblerError(
            "contracted graphs are available for 2 to {most_loops} loops, not for {loops}",
            most_loops=MOST_LOOPS,
            loops=loops,
        )
    return _grown(loops)


def _grown(loops: int) -> Iterator[Packed]:
    """The blocks of `packed_graphs`."""
    if loops == 2:
        theta = np.zeros((1, _NODES), np.int64)
        theta[0, :2] = 3 << 4, 3
        yield theta
        return
    from gruebler import _core

    for parents in _grown(loops - 1):
        k = 0
        while k < len(parents):
            children, k = _core.add_loop(parents, loops - 1, k, _BLOCK)
            if len(children):
                yield children.view(np.int64)  # a `long long` of C; numpy would print it otherwise once sent


def contracted_graphs(loops: int) -> Iterator[ContractedGraph]:
    """All contracted graphs with this number of loops, each once, canonical, in the order of `packed_graphs`.

    Raises:
        GrueblerError: loops < 2 or more than MOST_LOOPS.

    >>> for graph in contracted_graphs(3):
    ...     print(graph.bundles)
    ((0, 1, 4),)
    ((0, 1, 2), (0, 2, 2), (1, 2, 1))
    ((0, 1, 1), (0, 2, 2), (1, 3, 2), (2, 3, 1))
    ((0, 1, 1), (0, 2, 1), (1, 2, 1), (0, 3, 1), (1, 3, 1), (2, 3, 1))
    """
    return (unpacked(rows) for block in packed_graphs(loops) for rows in block)


def pack(graphs: Iterable[ContractedGraph]) -> Packed:
    """The canonical packed form of graphs, int64[k, 18]."""
    rows = [graph.canonical()._packed() for graph in graphs]
    return np.array(rows, np.int64).reshape(-1, _NODES)
