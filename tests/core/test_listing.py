"""Chains written out by the core, and the symmetry of one packed graph: against print and networkx.

Other methods: tests/structure/enumeration/test_listing.py and test_contracted.py.
"""

from functools import cache
from itertools import permutations

import networkx as nx
import numpy as np
import pytest

from gruebler.structure.enumeration.contracted import contracted_graphs
from tests.core.test_counting import THETA, loops_of
from tests.structure.enumeration.test_counts import NUMBERS


@cache
def grown(core, loops):
    rows = THETA
    for more in range(2, loops):
        rows, _ = core.add_loop(rows, more, 0, 1 << 62)
    return rows


@pytest.mark.parametrize(("mobility", "links"), [(f, n) for f, row in NUMBERS.items() for n in row if f + 3 < n < 14])
def test_numbers_in_print(core, mobility, links):
    loops = loops_of(links, mobility)
    lines = core.list_graph6(grown(core, loops), loops, mobility)
    assert len(lines) == NUMBERS[mobility][links]


def test_lines_as_networkx(core):
    edges = core.list_chains(grown(core, 4), 4, 1)
    for pairs, line in zip(edges.tolist(), core.list_graph6(grown(core, 4), 4, 1), strict=True):
        graph = nx.Graph()
        graph.add_nodes_from(range(10))
        graph.add_edges_from(pairs)
        assert nx.to_graph6_bytes(graph, header=False) == line.tobytes()


@pytest.mark.parametrize("links", [1, 2, 5, 62, 63, 100, 255])
def test_a_ring_as_networkx(core, links):
    ring = nx.cycle_graph(links) if links > 2 else nx.path_graph(links)
    edges = np.array(list(ring.edges), np.uint8).reshape(1, -1, 2)
    assert core.write_graph6(edges, links).tobytes() == nx.to_graph6_bytes(ring, header=False)


def as_rows(multigraph):
    """int64[18]: the packed graph of a multigraph."""
    rows = [0] * 16
    for u, v in multigraph.edges():
        rows[u] += 1 << 4 * v
        rows[v] += 1 << 4 * u
    return np.array(rows, np.uint64).view(np.int64)


def test_longest_chains(core):
    """Two nodes, three strings and 24 freedoms: 27 binary links in strings."""
    edges = core.list_chains(THETA, 2, 24)
    assert len(edges)
    for pairs in edges.tolist():
        graph = nx.Graph(pairs)
        assert (len(graph), graph.number_of_edges()) == (29, 30)
        assert sorted(dict(graph.degree).values(), reverse=True)[:3] == [3, 3, 2]


@pytest.mark.parametrize("loops", [2, 3, 4])
def test_symmetry_by_all_permutations(core, loops):
    for graph in contracted_graphs(loops):
        n, strings = graph.nodes, {frozenset((u, v)): k for u, v, k in graph.bundles}
        own = as_rows(graph.multigraph())
        images = {
            image
            for image in permutations(range(n))
            if all(strings.get(frozenset((image[u], image[v]))) == k for u, v, k in graph.bundles)
        }
        assert set(map(tuple, core.find_automorphisms(own).tolist())) == images
        turned = nx.relabel_nodes(graph.multigraph(), {v: n - 1 - v for v in range(n)})
        assert (core.canonical_rows(as_rows(turned)) == core.canonical_rows(own)).all()


@pytest.mark.parametrize(
    ("graph", "order"), [(nx.petersen_graph(), 120), (nx.complete_bipartite_graph(4, 4), 1152), (nx.path_graph(2), 2)]
)
def test_known_groups(core, graph, order):
    rows = np.zeros(16, np.uint64)
    for u, v in graph.edges:
        rows[u] |= np.uint64(1 << 4 * v)
        rows[v] |= np.uint64(1 << 4 * u)
    images = core.find_automorphisms(rows.view(np.int64))
    assert len(images) == len({tuple(image) for image in images.tolist()}) == order
    assert images[0].tolist() == list(range(len(graph)))
    for image in images.tolist():
        assert all(graph.has_edge(image[u], image[v]) for u, v in graph.edges)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda core: core.list_chains(THETA, 1, 1), "2 to 10 loops"),
        (lambda core: core.list_chains(THETA, 2, 25), "0 to 24"),
        (lambda core: core.list_graph6(THETA, 3, 1), "graph 0 is not a connected graph of this number"),
        (lambda core: core.list_graph6(THETA[:, :1].copy(), 2, 1), "2 to 18 rows"),
        (lambda core: core.canonical_rows(np.zeros(16, np.int64)), "not those of a packed graph"),
        (lambda core: core.canonical_rows(np.full(16, -1)), "not those of a packed graph"),
        (lambda core: core.canonical_rows(np.zeros(0, np.int64)), "1 to 18 rows"),
        (lambda core: core.canonical_rows(np.zeros(19, np.int64)), "1 to 18 rows"),
        (lambda core: core.write_graph6(np.zeros((1, 1, 2), np.uint8), 3), "graph 0 has an edge"),
        (lambda core: core.write_graph6(np.array([[[0, 3]]], np.uint8), 3), "graph 0 has an edge"),
        (lambda core: core.write_graph6(np.zeros((0, 1, 2), np.uint8), 256), "0 to 255 links"),
    ],
)
def test_wrong_values(core, call, words):
    with pytest.raises(ValueError, match=words):
        call(core)


def test_too_many_automorphisms(core):
    """16 vertices, each joined to each."""
    rows = np.array([0x1111111111111111 & ~(15 << 4 * v) for v in range(16)], np.uint64).view(np.int64)
    with pytest.raises(ValueError, match="more automorphisms than there is room for"):
        core.find_automorphisms(rows)


def test_wrong_kinds(core):
    for wrong in (None, THETA.astype(np.int32), THETA[0], "graphs"):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            core.list_chains(wrong, 2, 1)
    for wrong in (np.zeros((1, 4, 3), np.uint8), np.zeros((1, 4, 2), np.int64)):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            core.write_graph6(wrong, 4)


def test_nothing(core):
    none = np.zeros((0, 16), np.int64)
    assert core.list_chains(none, 5, 1).shape == (0, 16, 2)
    assert core.list_graph6(none, 5, 1).shape == (0, 13)
    assert core.write_graph6(np.zeros((0, 0, 2), np.uint8), 5).shape == (0, 4)
