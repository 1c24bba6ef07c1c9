"""The kernels of core/ by level, in turns in one process.

Seconds are those of the processor, which other work on the machine disturbs least; the least of some rounds is printed.
Every answer is compared.
"""

from collections.abc import Callable
from time import process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler import _core

ROUNDS = 9

Calls = dict[str, Callable[[], Any]]


def main() -> None:
    """Print the table."""
    print("| warm | ms |\n|---|---|")
    for name, calls in [*counting(), *labelling()]:
        for level, seconds in measured(calls).items():
            print(f"| {name}, {level} | {1000 * seconds:.2f} |")


def measured(calls: Calls) -> dict[str, float]:
    """The least seconds of each; all must answer the same."""
    answers = [call() for call in calls.values()]
    assert all(np.array_equal(answers[0], answer) for answer in answers[1:])
    least = dict.fromkeys(calls, float("inf"))
    for _ in range(ROUNDS):
        for name, call in calls.items():
            begun = process_time()
            call()
            least[name] = min(least[name], process_time() - begun)
    return least


def counting() -> list[tuple[str, Calls]]:
    """Census and growth of 14 and 16 links."""
    from gruebler.structure.enumeration.contracted import packed_graphs

    rows: list[tuple[str, Calls]] = []
    for links, loops in ((14, 6), (16, 7)):
        graphs, parents = (np.concatenate([block.copy() for block in packed_graphs(k)]) for k in (loops, loops - 1))
        for orbits in (False, True):
            calls: Calls = {}
            for level in _core.level_names():
                calls[level] = lambda g=graphs, k=loops, o=orbits, n=level: _core.take_census(g, k, 1, o, level=n)  # type: ignore[misc]
            rows.append((f"census of {links} links" + (" with orbits" if orbits else ""), calls))
        growth: Calls = {"core": lambda p=parents, k=loops: _core.add_loop(p, k - 1, 0, 1 << 62)[0]}  # type: ignore[misc]
        rows.append((f"growth to {loops} loops", growth))
    return rows


def labelling() -> list[tuple[str, Calls]]:
    """Chains in bulk, and graphs with much symmetry."""
    import networkx as nx

    from gruebler.structure.enumeration import edge_blocks

    rows: list[tuple[str, Calls]] = []
    symmetric = {
        "the 8-cube": nx.hypercube_graph(8),
        "K2,400": nx.complete_bipartite_graph(2, 400),
        "12 Petersen graphs": nx.disjoint_union_all([nx.petersen_graph()] * 12),
    }
    named: dict[str, tuple[int, NDArray[np.integer]]] = {}
    for links in (12, 14):
        chains = next(iter(edge_blocks(links)))
        named[f"{len(chains)} chains of {links} links"] = links, chains
    for name, graph in symmetric.items():
        plain = nx.convert_node_labels_to_integers(graph)
        named[name] = len(plain), np.array([list(plain.edges())])
    for name, (n, edges) in named.items():
        ends, bounds = edges.astype(np.int32), np.arange(len(edges) + 1) * edges.shape[1]
        whole: Calls = {"core": lambda n=n, e=ends, b=bounds: _core.canonical_bulk(n, e.reshape(-1, 2), b)}  # type: ignore[misc]
        rows.append((f"labelling {name}", whole))
    return rows


if __name__ == "__main__":
    main()
