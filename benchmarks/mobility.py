"""The mobility report of chains with 10 to 100,000 links, and how its time grows."""

import math
import random
import resource
import statistics
import time
from collections.abc import Callable

import networkx as nx

from gruebler import Chain, mobility_report
from gruebler.structure.mobility import pebble_mobility

SIZES = (10, 100, 1_000, 10_000, 100_000)
_LARGEST_TANGLED = 10_000  # its dense core grows with the links, and the time with the core's cube


def by_dyads(n: int) -> list[tuple[int, int]]:
    """A four-bar grown by dyads between random links."""
    choose = random.Random(n)
    edges = [(0, 1), (1, 2), (2, 3), (3, 0)]
    for k in range(4, n, 2):
        a, b = choose.sample(range(k), 2)
        edges += [(a, k), (k, k + 1), (k + 1, b)]
    return edges


def tangled(n: int) -> list[tuple[int, int]]:
    """A random cubic graph with four joints split by binary links: one freedom, no dyad anywhere."""
    graph = nx.random_regular_graph(3, n - 4, seed=n)
    edges = list(graph.edges)
    split = set(random.Random(n).sample(range(len(edges)), 4))
    new = iter(range(n - 4, n))
    out = []
    for k, (a, b) in enumerate(edges):
        if k in split:
            v = next(new)
            out += [(a, v), (v, b)]
        else:
            out.append((a, b))
    return out


def overbraced(n: int) -> list[tuple[int, int]]:
    """`by_dyads` with three joints too many."""
    return by_dyads(n) + [tuple(random.Random(n + k).sample(range(n), 2)) for k in range(3)]  # type: ignore[misc]


def ring(n: int) -> list[tuple[int, int]]:
    """One loop: n - 3 freedoms."""
    return [(k, (k + 1) % n) for k in range(n)]


def paths(n: int) -> list[tuple[int, int]]:
    """n - 2 binary links between the same two: nearly as many constraints too many."""
    return [edge for k in range(2, n) for edge in ((0, k), (k, 1))]


def seconds(call: Callable[[], object], runs: int = 5) -> float:
    times = []
    for _ in range(runs):
        start = time.process_time()  # of the processor: other work on the machine does not count
        call()
        times.append(time.process_time() - start)
    return statistics.median(times)


def main() -> None:
    print(f"{'chain':12} " + " ".join(f"{n:>9,} links" for n in SIZES) + "   exponent 1,000 to 10,000")
    for make in (by_dyads, tangled, overbraced, ring, paths):
        sizes = [n for n in SIZES if make is not tangled or n <= _LARGEST_TANGLED]
        chains = [Chain.from_edges(make(n)) for n in sizes]
        times = [
            seconds(lambda chain=chain: mobility_report(chain), runs=5 if chain.n <= 1000 else 1) for chain in chains
        ]
        growth = math.log10(times[3] / times[2])
        print(f"{make.__name__:12} " + " ".join(f"{t:13.4f} s" for t in times) + f"   {growth:.2f}")
    print(f"memory at the largest: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6:.2f} GB")
    chain = Chain.from_edges(by_dyads(1000))
    ratio = seconds(lambda: mobility_report(chain)) / seconds(lambda: pebble_mobility(chain))
    print(f"report with all evidence / pebble game alone, 1,000 links: {ratio:.0f}")


if __name__ == "__main__":
    main()
