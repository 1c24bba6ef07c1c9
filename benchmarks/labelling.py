"""Canonical labelling: the core and igraph (the program bliss), side by side in one run on the same graphs."""

import time
from collections.abc import Callable
from typing import NamedTuple

import igraph
import networkx as nx
import numpy as np
from numpy.typing import NDArray

from gruebler import _core

GRAPHS = 20_000
JUDGED = 2_000  # of them igraph labels so many


class Row(NamedTuple):
    """One line of the table: times in microseconds for one graph."""

    name: str
    ours: float
    igraph: float

    @property
    def ratio(self) -> float:
        return self.igraph / self.ours


def random_chain(n: int, rng: np.random.Generator) -> NDArray[np.int32]:
    """A four-bar with (n - 4) / 2 strings of two links between random links, shuffled: int32[m, 2]."""
    edges = [(0, 1), (1, 2), (2, 3), (3, 0)]
    for link in range(4, n, 2):
        u, v = rng.choice(link, 2, replace=False)
        edges += [(int(u), link), (link, link + 1), (link + 1, int(v))]
    return rng.permutation(rng.permutation(n)[np.array(edges)]).astype(np.int32)


def theta(strings: int) -> nx.Graph:
    """Two links joined by strings of two links."""
    graph = nx.Graph()
    for i in range(strings):
        nx.add_path(graph, ["a", (i, 0), (i, 1), "b"])
    return graph


FAMILIES: dict[str, Callable[[], nx.Graph]] = {
    "theta graph, 7 strings": lambda: theta(7),
    "theta graph, 12 strings": lambda: theta(12),
    "K(2,50)": lambda: nx.complete_bipartite_graph(2, 50),
    "K(50,50)": lambda: nx.complete_bipartite_graph(50, 50),
    "cycle, 300": lambda: nx.cycle_graph(300),
    "prism, 2 x 50": lambda: nx.circular_ladder_graph(50),
    "Petersen": nx.petersen_graph,
    "30 Petersen graphs": lambda: nx.disjoint_union_all([nx.petersen_graph()] * 30),
    "cube, 5 dimensions": lambda: nx.hypercube_graph(5),
    "Hoffman-Singleton": nx.hoffman_singleton_graph,
    "rook, 10 x 10": lambda: nx.line_graph(nx.complete_bipartite_graph(10, 10)),
    "Paley, 101": lambda: nx.paley_graph(101).to_undirected(),
    "binary tree, 1023": lambda: nx.balanced_tree(2, 9),
    "random cubic, 100": lambda: nx.random_regular_graph(3, 100, seed=1),
    "random cubic, 1000": lambda: nx.random_regular_graph(3, 1000, seed=1),
}


def microseconds(call: Callable[[], object], graphs: int = 1, runs: int = 5) -> float:
    """The least of some runs, for one graph."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times) / graphs * 1e6


def labellings(n: int, packed: NDArray[np.int32]) -> NDArray[np.int32]:
    """Those of int32[graphs, m, 2]."""
    return _core.canonical_bulk(n, packed.reshape(-1, 2), np.arange(len(packed) + 1) * packed.shape[1])


def chains(n: int) -> Row:
    rng = np.random.default_rng(n)
    packed = np.array([random_chain(n, rng) for _ in range(GRAPHS)])
    judged = [igraph.Graph(n=n, edges=edges.tolist()) for edges in packed[:JUDGED]]
    return Row(
        f"random chains, {n} links",
        microseconds(lambda: labellings(n, packed), GRAPHS),
        microseconds(lambda: [graph.canonical_permutation() for graph in judged], JUDGED),
    )


def forms(n: int) -> Row:
    """From edge lists to sorted canonical edge lists, as one who compares chains needs them."""
    rng = np.random.default_rng(n)
    packed = np.array([random_chain(n, rng) for _ in range(GRAPHS)])
    lists = [edges.tolist() for edges in packed[:JUDGED]]

    def ours() -> NDArray[np.int32]:
        labels = labellings(n, packed)
        ends = np.sort(labels[np.arange(GRAPHS)[:, None, None], packed], axis=2)
        return np.sort(ends[:, :, 0] * np.int32(n) + ends[:, :, 1], axis=1)

    def theirs() -> list[list[tuple[int, int]]]:
        graphs = (igraph.Graph(n=n, edges=edges) for edges in lists)
        return [sorted(graph.permute_vertices(graph.canonical_permutation()).get_edgelist()) for graph in graphs]

    return Row(f"edge list to form, {n} links", microseconds(ours, GRAPHS), microseconds(theirs, JUDGED))


def family(name: str) -> Row:
    graph = nx.convert_node_labels_to_integers(FAMILIES[name]())
    n = len(graph)
    edges = np.array(graph.edges(), np.int32)
    edges = np.random.default_rng(0).permutation(n).astype(np.int32)[edges]
    judged = igraph.Graph(n=n, edges=edges.tolist())
    return Row(
        name,
        microseconds(lambda: labellings(n, edges[None])),
        microseconds(judged.canonical_permutation),
    )


def run() -> list[Row]:
    """Measure everything: some seconds."""
    sizes = (10, 12, 14, 16)
    return [chains(n) for n in sizes] + [forms(n) for n in sizes] + [family(name) for name in FAMILIES]


def main() -> None:
    print(f"{'microseconds for one graph':28} {'ours':>10} {'igraph':>10} {'igraph / ours':>14}")
    for row in run():
        print(f"{row.name:28} {row.ours:10.2f} {row.igraph:10.2f} {row.ratio:14.1f}")


if __name__ == "__main__":
    main()
