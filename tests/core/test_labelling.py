"""The labelling of the core against the one of numba, array by array, against known groups and stored forms."""

import math
import signal
from functools import cache
from hashlib import sha256

import networkx as nx
import numpy as np
import pytest
from hypothesis import given

from gruebler._numeric.labelling.canonical import CanonicalResult, canonical_bulk, canonical_form
from gruebler.structure.enumeration import edge_blocks
from tests._numeric.test_canonical import KNOWN, Graph, check_symmetry, copies, graphs, plane, rook


def solve(core, graph):
    """What the core finds, in the form that the library gives it."""
    ends, edge_colour = graph.edges.astype(np.int32), graph.edge_colour.astype(np.int32)
    labelling, generators, orbits, factors = core.canonical_form(graph.n, graph.vertex_colour, ends, edge_colour)
    return CanonicalResult(labelling, generators, orbits, math.prod(factors.tolist()))


def assert_equal(first, second):
    assert first.labelling.tolist() == second.labelling.tolist()
    assert first.generators.tolist() == second.generators.tolist()
    assert first.orbits.tolist() == second.orbits.tolist()
    assert first.order == second.order


@given(graph=graphs(12))
def test_random_graphs_as_numba(core, graph):
    assert_equal(solve(core, graph), canonical_form(graph.n, graph.vertex_colour, graph.edges, graph.edge_colour))


@pytest.mark.parametrize(("make", "order", "orbits"), [row[1:] for row in KNOWN], ids=[row[0] for row in KNOWN])
def test_known_groups(core, make, order, orbits):
    graph = Graph.of(make())
    other = graph.shuffled(np.random.default_rng(5))
    result = solve(core, other)
    check_symmetry(other, result)
    assert result.order == order
    assert len(set(result.orbits.tolist())) == orbits
    assert other.under(result.labelling) == graph.under(solve(core, graph).labelling)


@pytest.mark.parametrize("make", [row[1] for row in KNOWN], ids=[row[0] for row in KNOWN])
def test_known_graphs_as_numba(core, make):
    graph = Graph.of(make()).shuffled(np.random.default_rng(6))
    assert_equal(solve(core, graph), canonical_form(graph.n, graph.vertex_colour, graph.edges, graph.edge_colour))


def test_the_numbering_is_kept(core):
    """Codes are stored: the same digest as in tests/_numeric/test_canonical.py."""
    known = [make() for _, make, _, _ in KNOWN]
    ladder = [nx.circular_ladder_graph(k) for k in range(3, 9)]
    uneven = [copies(*ladder), nx.frucht_graph(), nx.tutte_graph(), plane(3)]
    coloured = Graph(5, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0), (0, 1)], [7, 0, 0, 1, 7], [1, 0, 2, 0, 0, 3])
    every = [*(Graph.of(graph) for graph in [*nx.graph_atlas_g(), *known, *uneven]), coloured]
    forms = [graph.under(solve(core, graph).labelling) for graph in every]
    digest = sha256(repr(forms).encode()).hexdigest()
    assert digest == "7f367f7badc81edabe172b94e59947ecab8a9c105d5f933bbea4776332357a1a"


@cache
def chains(links, mobility):
    """uint8[k, joints, 2]: at most 20,000 chains."""
    return next(iter(edge_blocks(links, mobility)))[:20_000]


@pytest.mark.parametrize(("links", "mobility"), [(12, 1), (13, 2), (14, 1), (12, 3)])
def test_chains_as_numba(core, links, mobility):
    edges = chains(links, mobility).astype(np.int32)
    bounds = np.arange(len(edges) + 1) * edges.shape[1]
    places = core.canonical_bulk(links, edges.reshape(-1, 2), bounds)
    assert (places == canonical_bulk(links, edges)).all()


def test_graphs_of_different_lengths_in_one_call(core):
    edges = np.array([[0, 1], [1, 2], [0, 1], [0, 2], [1, 2], [1, 2]], np.int32)
    places = core.canonical_bulk(3, edges, np.array([0, 2, 2, 5, 6]))
    assert places.shape == (4, 3)
    assert sorted(map(sorted, places.tolist())) == [[0, 1, 2]] * 4
    assert (places == canonical_bulk(3, edges, np.array([0, 2, 2, 5, 6]))).all()


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timer of this system")
def test_a_signal_ends_a_long_call(core):
    edges = Graph.of(nx.line_graph(nx.complete_bipartite_graph(10, 10))).edges.astype(np.int32)
    many, bounds = np.tile(edges, (3000, 1)), np.arange(3001) * len(edges)

    def stop(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(KeyboardInterrupt):
            core.canonical_bulk(100, many, bounds)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_rook_and_square(core):
    assert solve(core, Graph.of(rook())).order == 2 * math.factorial(4) ** 2
    assert solve(core, Graph.of(nx.cycle_graph(4))).order == 8
