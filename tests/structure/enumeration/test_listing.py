"""The chains themselves, against brute force over all graphs and all subsets of links."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from functools import cache
from itertools import combinations, islice
from multiprocessing import get_context

import networkx as nx
import numpy as np
import pytest

from gruebler import Chain, code, mobility_report
from gruebler.structure.enumeration import (
    chains,
    chains_of,
    contracted_graphs,
    count_chains,
    edge_blocks,
    graph6_blocks,
)
from gruebler.structure.enumeration.pieces import list_piece, pieces


def freedoms(links, edges):
    """3(|T| - 1) - 2 e(T) for every set T of links."""
    sets = np.arange(1, 2**links)
    found = 3 * (np.bitwise_count(sets).astype(int) - 1)
    for u, v in edges:
        found -= 2 * ((sets >> u) & (sets >> v) & 1)
    return sets, found


def is_chain(links, edges, mobility):
    """The definition, word for word, for chains that are not fractionated."""
    graph = nx.Graph(edges)
    if len(graph) < links or len(set(map(frozenset, edges))) < len(edges) or not nx.is_biconnected(graph):
        return False
    sets, found = freedoms(links, edges)
    proper = found[(np.bitwise_count(sets) > 1) & (sets < 2**links - 1)]
    return bool(found[-1] == mobility and (proper >= 1).all())


@cache
def atlas():
    """Every graph of at most seven vertices, as the atlas of Read and Wilson has them."""
    return nx.graph_atlas_g()


def eight_vertices(joints):
    """Every graph of eight vertices with a vertex of degree 2, doubles included.

    With at most eleven edges there is a vertex of degree less than 3, and chains have none of degree less than 2.
    """
    for graph in atlas():
        if graph.number_of_nodes() == 7 and graph.number_of_edges() == joints - 2:
            for u, v in combinations(range(7), 2):
                yield [*graph.edges, (u, 7), (v, 7)]


def codes(graphs):
    return {code(Chain.from_edges(edges)) for edges in graphs}


def listed(links, mobility):
    return [edges for block in edge_blocks(links, mobility) for edges in block.tolist()]


@pytest.mark.parametrize("links", [3, 4, 5, 6, 7])
def test_against_the_atlas(links):
    """All mobilities at once: every graph of the atlas that is a chain of some mobility is listed."""
    for mobility in range(7):
        expected = [
            list(graph.edges)
            for graph in atlas()
            if graph.number_of_nodes() == links
            and 3 * (links - 1) - 2 * graph.number_of_edges() == mobility
            and is_chain(links, list(graph.edges), mobility)
        ]
        found = listed(links, mobility)
        assert len(found) == len(expected)
        assert codes(found) == codes(expected)


@pytest.mark.parametrize(("mobility", "number"), [(1, 16), (3, 5), (5, 1)])
def test_against_all_graphs_of_eight_vertices(mobility, number):
    joints = (21 - mobility) // 2
    expected = codes(edges for edges in eight_vertices(joints) if is_chain(8, edges, mobility))
    assert len(expected) == number
    assert codes(listed(8, mobility)) == expected


ALL = [(n, f) for n in range(3, 10) for f in range(5) if (n - 1 - f) % 2 == 0 and n >= f + 3]


@pytest.mark.parametrize(("links", "mobility"), [*ALL, (10, 1), (10, 3), (11, 0)])
def test_every_chain_is_one_and_no_two_are_alike(links, mobility):
    found = listed(links, mobility)
    assert all(is_chain(links, edges, mobility) for edges in found)
    assert len(codes(found)) == len(found) == count_chains(links, mobility).chains
    by_hash = {}
    if links <= 9:
        for edges in found:
            graph = nx.Graph(edges)
            nx.set_node_attributes(graph, dict(graph.degree), "degree")
            key = nx.weisfeiler_lehman_graph_hash(graph, node_attr="degree")
            others = by_hash.setdefault(key, [])
            assert not any(nx.is_isomorphic(graph, other) for other in others)
            others.append(graph)


@pytest.mark.parametrize("mobility", range(5))
@pytest.mark.parametrize("links", range(3, 11))
def test_the_structure_core_agrees(links, mobility):
    """Every chain of up to ten links by the report of the structure core, and no two with one code."""
    codes = set()
    for chain in chains(links, mobility):
        report = mobility_report(chain)
        assert (report.counted, report.generic) == (mobility, mobility)
        assert not report.overconstrained
        assert mobility == 0 or not report.immobile_joints
        codes.add(code(chain))
        assert mobility == 0 or not report.rigid_clusters
    assert len(codes) == sum(1 for _ in chains(links, mobility))


@pytest.mark.parametrize(("links", "mobility"), [(4, 1), (10, 1), (11, 2), (9, 0), (8, 3)])
def test_the_forms_agree(links, mobility):
    edges = np.concatenate(list(edge_blocks(links, mobility)))
    lines = b"".join(block.tobytes() for block in graph6_blocks(links, mobility))
    expected = [nx.Graph() for _ in edges]
    for graph, joints in zip(expected, edges.tolist(), strict=True):
        graph.add_nodes_from(range(links))
        graph.add_edges_from(joints)
    assert lines == b"".join(nx.to_graph6_bytes(graph, header=False) for graph in expected)
    for chain, joints in zip(chains(links, mobility), edges.tolist(), strict=True):
        assert chain == Chain([("revolute", joint) for joint in joints], links=range(links))
        assert chain.links == tuple(map(str, range(links)))


def test_links_stand_in_order():
    """Nodes by falling degree, then binary links, each string of them in a row."""
    for block in edge_blocks(12):
        for edges in block:
            degrees = np.bincount(edges.ravel())
            assert (np.diff(degrees) <= 0).all()
            binary = [v for v in edges.ravel() if degrees[v] == 2]
            assert binary == sorted(binary)


def test_order_does_not_depend_on_the_work():
    whole = b"".join(block.tobytes() for block in graph6_blocks(12))
    for size in (1, 30_000):
        parts = [list_piece(piece, "graph6").tobytes() for piece in pieces(12, 1, size=size)]
        assert len(parts) > 1
        assert b"".join(parts) == whole
    with ThreadPoolExecutor(3) as threads, ProcessPoolExecutor(2, get_context("spawn")) as processes:
        for executor in (threads, processes):
            assert b"".join(block.tobytes() for block in graph6_blocks(12, executor=executor)) == whole


def test_chains_of_each_contracted_graph_make_up_the_whole():
    parts = [chain for graph in contracted_graphs(4) for chain in chains_of(graph, 2)]
    assert parts == list(chains(11, 2))


def test_one_assortment():
    chosen = list(chains(10, assortment=(5, 4, 1)))
    assert chosen == [chain for chain in chains(10) if chain.link_kinds == {2: 5, 3: 4, 4: 1}]
    assert next(chains(7, 4, assortment=(7,))).g == 7
    assert list(chains(7, 4, assortment=(6, 1))) == []


def test_lazy():
    """The first chains of a task of 1.5 thousand million come without the others."""
    first = list(islice(chains(18), 3))
    assert [chain.n for chain in first] == [18, 18, 18]
    assert len(set(first)) == 3


@pytest.mark.parametrize("links", [62, 63, 70])
def test_a_long_loop(links):
    (line,) = graph6_blocks(links, links - 3)
    assert nx.is_isomorphic(nx.from_graph6_bytes(line.tobytes().strip()), nx.cycle_graph(links))


def test_planarity_of_a_chain_is_that_of_its_contracted_graph():
    """Eleven of the 230 chains of ten links are not planar; other programs have lost just these."""
    crossing = 0
    for graph in contracted_graphs(4):
        for chain in chains_of(graph):
            assert nx.check_planarity(nx.Graph(chain.link_graph()))[0] == graph.is_planar
            crossing += not graph.is_planar
    assert crossing == 11
