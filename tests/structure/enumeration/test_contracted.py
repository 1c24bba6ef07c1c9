"""Contracted graphs: the numbers, another way to make them, and laws of the labelling."""

from collections import Counter
from itertools import combinations, combinations_with_replacement, permutations

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.base.errors import GrueblerError
from gruebler.structure.enumeration import ContractedGraph, contracted_graphs
from gruebler.structure.enumeration.contracted import pack, packed_graphs
from gruebler.structure.enumeration.pieces import strings_of_graphs

NUMBERS = {2: 1, 3: 4, 4: 17, 5: 118, 6: 1198}
MORE_NUMBERS = {7: 17133, 8: 311757}
GRAPHS = [graph for loops in (2, 3, 4, 5) for graph in contracted_graphs(loops)]


def weighted(bundles):
    graph = nx.Graph()
    graph.add_weighted_edges_from(bundles)
    return graph


def is_isomorphic(a, b):
    return nx.is_isomorphic(a, b, edge_match=lambda x, y: x["weight"] == y["weight"])


def classes(graphs):
    """One of each isomorphism class, by networkx alone."""
    by_hash = {}
    for graph in graphs:
        key = nx.weisfeiler_lehman_graph_hash(graph, edge_attr="weight")
        if not any(is_isomorphic(graph, other) for other in by_hash.setdefault(key, [])):
            by_hash[key].append(graph)
    return [graph for group in by_hash.values() for graph in group]


@pytest.mark.parametrize("loops", NUMBERS)
def test_numbers_and_no_two_alike(loops):
    packed = np.concatenate(list(packed_graphs(loops)))
    assert len(packed) == NUMBERS[loops]
    assert len(np.unique(packed, axis=0)) == len(packed)


@pytest.mark.slow
@pytest.mark.parametrize("loops", MORE_NUMBERS)
def test_numbers_of_more_loops(loops):
    packed = np.concatenate(list(packed_graphs(loops)))
    assert len(packed) == MORE_NUMBERS[loops]
    assert len(np.unique(packed, axis=0)) == len(packed)


@pytest.mark.parametrize("loops", [2, 3, 4])
def test_against_all_multigraphs(loops):
    """Oracle: every way to put V + L - 1 edges between V nodes, sorted out by networkx."""
    found = []
    for nodes in range(2, 2 * loops - 1):
        pairs = list(combinations(range(nodes), 2))
        extra = nodes + loops - 1
        for simple in range(nodes - 1, extra + 1):
            for chosen in combinations(pairs, simple):
                near = Counter(v for pair in chosen for v in pair)
                if len(near) < nodes or max(near.values()) > loops + 1:
                    continue
                # With smaller nodes having no fewer neighbours every class still has a member.
                if any(near[v] < near[v + 1] for v in range(nodes - 1)):
                    continue
                if nodes > 2 and not nx.is_biconnected(nx.Graph(chosen)):
                    continue
                for more in combinations_with_replacement(chosen, extra - simple):
                    number = Counter(chosen) + Counter(more)
                    degree = Counter()
                    for (u, v), k in number.items():
                        degree[u] += k
                        degree[v] += k
                    if min(degree.values()) >= 3:
                        found.append(weighted((u, v, k) for (u, v), k in number.items()))
    ours = [weighted(graph.bundles) for graph in contracted_graphs(loops)]
    theirs = classes(found)
    assert len(theirs) == len(ours) == len(classes(ours))
    assert all(any(is_isomorphic(a, b) for b in ours) for a in theirs)


@pytest.mark.parametrize("loops", [3, 4, 5])
def test_contracting_a_single_string_stays_within_the_list(loops):
    """Where two nodes do not separate the graph, contracting the one string between them gives another."""
    known = set(contracted_graphs(loops))
    reached = set()
    for graph in known:
        for u, v, k in graph.bundles:
            merged = Counter()
            for *ends, m in graph.bundles:
                a, b = sorted(u if x == v else x for x in ends)
                merged[a, b] += m
            del merged[u, u]
            numbers = {x: i for i, x in enumerate(sorted({x for pair in merged for x in pair}))}
            simple = nx.Graph(merged.keys())
            if k == 1 and (len(numbers) == 2 or nx.is_biconnected(simple)):
                bundles = tuple((numbers[a], numbers[b], m) for (a, b), m in merged.items())
                reached.add(ContractedGraph(bundles).canonical())
    assert reached <= known
    cubic = {graph for graph in known if graph.nodes == 2 * loops - 2}
    assert reached | cubic == known  # every other graph comes from one with a node more


@given(st.sampled_from(GRAPHS), st.randoms())
def test_canonical_form_is_blind_to_numbering(graph, random):
    order = list(range(graph.nodes))
    random.shuffle(order)
    bundles = [(order[u], order[v], k) for u, v, k in graph.bundles]
    random.shuffle(bundles)
    other = ContractedGraph(tuple(bundles))
    assert graph.canonical() == graph == other.canonical()
    assert len(other.automorphisms) == len(graph.automorphisms)


@pytest.mark.parametrize("graph", [g for g in GRAPHS if g.nodes <= 6])
def test_automorphisms_by_trying_all_permutations(graph):
    number = {frozenset((u, v)): k for u, v, k in graph.bundles}
    expected = [
        p
        for p in permutations(range(graph.nodes))
        if all(number.get(frozenset((p[u], p[v]))) == k for u, v, k in graph.bundles)
    ]
    assert list(graph.automorphisms) == expected


def test_a_graph_of_great_symmetry():
    """K(3,5), eight loops, 3! 5! automorphisms; Heawood's graph, eight loops, 336."""
    bipartite = tuple((a, b, 1) for a in range(3) for b in range(3, 8))
    assert len(ContractedGraph(bipartite).automorphisms) == 720
    heawood = ContractedGraph(tuple((u, v, 1) for u, v in nx.heawood_graph().edges))
    assert heawood.loops == 8
    assert len(heawood.automorphisms) == 336


@pytest.mark.parametrize("graph", GRAPHS[:23])
def test_properties(graph):
    multigraph = graph.multigraph()
    assert multigraph.number_of_edges() == graph.strings
    assert [multigraph.degree(v) for v in range(graph.nodes)] == list(graph.degrees)
    assert sorted(graph.degrees, reverse=True) == list(graph.degrees)
    assert graph.loops == graph.strings - graph.nodes + 1
    assert graph.is_planar == nx.check_planarity(nx.Graph(multigraph))[0]
    assert eval(repr(graph)) == graph


def test_the_first_graph_that_is_not_planar():
    assert [graph.is_planar for graph in contracted_graphs(4)].count(False) == 1  # K(3,3)


@pytest.mark.parametrize(
    ("bundles", "message"),
    [
        ((), "bundle"),
        (((0, 0, 3),), "bundle"),
        (((0, 1, 3), (1, 2, 0)), "bundle"),
        (((0, 1, 2),), "three strings"),
        (((0, 1, 2), (1, 0, 2)), "two bundles"),
        (((0, 1, 3), (2, 3, 3)), "disconnected"),
        (((0, 1, 3), (1, 2, 3)), "falls apart at node 1"),
        (((0, 2, 3),), "three strings"),
    ],
)
def test_what_is_no_contracted_graph(bundles, message):
    with pytest.raises(GrueblerError, match=message):
        ContractedGraph(bundles)


def test_limits():
    for loops in (1, 11):
        with pytest.raises(GrueblerError, match="2 to 10 loops"):
            packed_graphs(loops)
    ring = tuple((v, (v + 1) % 20, 1 + v % 2) for v in range(20))
    with pytest.raises(GrueblerError, match="at most 18 nodes and 7 parallel strings"):
        ContractedGraph(ring).canonical()
    thick = ContractedGraph(tuple((v, (v + 1) % 17, 8 if v == 0 else 2) for v in range(17)))
    with pytest.raises(GrueblerError, match="7 parallel strings"):
        thick.canonical()


@pytest.mark.parametrize(
    ("graph", "symmetries"),
    [(nx.pappus_graph(), 216), (nx.complete_bipartite_graph(3, 6), 6 * 720), (nx.complete_graph(6), 720)],
)
def test_symmetry_with_ten_loops(graph, symmetries):
    """The most symmetric ones have their room; the order of the group of Pappus' graph, 18 nodes: Coxeter 1950."""
    one = ContractedGraph(tuple((u, v, 1) for u, v in graph.edges))
    place = np.random.default_rng(2).permutation(one.nodes).tolist()
    other = ContractedGraph(tuple((place[u], place[v], 1) for u, v in graph.edges))
    assert one.loops == 10
    assert len(one.automorphisms) == symmetries
    assert strings_of_graphs(pack([one])).sum(axis=(0, 2)).tolist()[: one.nodes] == list(one.canonical().degrees)
    assert one.canonical() == other.canonical() == one.canonical().canonical()
    assert is_isomorphic(weighted(one.canonical().bundles), weighted(one.bundles))


def test_packing():
    theta = ContractedGraph(((1, 0, 3),))
    assert pack([theta]).tolist() == next(iter(packed_graphs(2))).tolist()
    assert pack([]).shape == (0, 18)
