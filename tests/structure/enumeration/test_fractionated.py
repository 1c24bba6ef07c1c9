"""Fractionated chains: the counts of the literature, and three ways to the same sets."""

from itertools import combinations

import networkx as nx
import pytest

from gruebler import Chain, code, mobility_report
from gruebler.structure.enumeration.fractionated import block_additions, composed
from gruebler.structure.enumeration.fractionation_class import CLASSES, fractionation
from gruebler.structure.enumeration.listing import chains, count_chains
from tests.structure.enumeration.definition_oracle import is_constrained
from tests.structure.enumeration.fractionated_oracle import count_fractionated


def fractionated_chains(links, mobility, kind):
    for part in block_additions(links, mobility, kind):
        yield from (compound.chain for compound in composed(chains, part))


def fractionated_list(links, mobility, kind):
    return list(fractionated_chains(links, mobility, kind))


def plain_count(links, mobility):
    found = count_chains(links, mobility, orbits=True)
    return found.chains, found.inversions


def by_class(links, mobility):
    return tuple(sum(1 for _ in chains(links, mobility, fractionated=kind)) for kind in CLASSES)


@pytest.mark.parametrize(
    ("links", "mobility", "numbers"),
    [
        (5, 2, (1, 0, 0)),
        (7, 2, (3, 1, 0)),
        (9, 2, (35, 5, 0)),
        (11, 2, (753, 86, 0)),
        (6, 3, (1, 0, 0)),
        (8, 3, (5, 1, 1)),
        (10, 3, (74, 19, 5)),
        (8, 1, (16, 0, 0)),
        (9, 0, (28, 0, 0)),
        (8, 2, (0, 0, 0)),
    ],
)
def test_known_numbers(links, mobility, numbers):
    assert by_class(links, mobility) == numbers


@pytest.mark.parametrize(
    ("links", "mobility"), [(7, 2), (9, 2), (11, 2), (8, 3), (10, 3), (12, 3), (9, 4), (11, 4), (12, 5)]
)
def test_composition_agrees_with_counting_by_polya(links, mobility):
    built = {kind: len(fractionated_list(links, mobility, kind)) for kind in ("link", "joint")}
    assert built == count_fractionated(links, mobility, chains, plain_count)


@pytest.mark.parametrize(("links", "number"), [(13, 2189), (15, 87123)])
def test_one_joint_link_is_an_unordered_pair_of_inversions(links, number):
    """F = 2: two chains with F = 1, each at one of its link orbits."""
    orbits = {n: count_chains(n, 1, orbits=True).inversions for n in range(4, links - 2, 2)}
    ordered = sum(orbits[n] * orbits[links + 1 - n] for n in orbits)
    twice = orbits.get((links + 1) // 2, 0)
    assert (ordered + twice) // 2 == number
    assert count_fractionated(links, 2, chains, plain_count) == {"link": number, "joint": 0}


@pytest.mark.parametrize(("links", "mobility"), [(9, 2), (8, 3), (10, 3), (9, 4)])
def test_every_composed_chain_is_one(links, mobility):
    seen = set()
    for kind in ("link", "joint"):
        for chain in fractionated_list(links, mobility, kind):
            graph = nx.Graph(chain.link_graph())
            assert nx.has_bridges(graph) == (kind == "joint")
            assert not nx.is_biconnected(graph)
            assert fractionation(chain) == kind
            assert is_constrained(chain, mobility)
            report = mobility_report(chain)
            assert (report.counted, report.generic) == (mobility, mobility)
            assert not report.rigid_clusters
            assert not report.overconstrained
            assert not report.immobile_joints
            seen.add(code(chain))
    assert len(seen) == sum(by_class(links, mobility)[1:])


def obvious(graph, mobility):
    """The definition, written for networkx and for subsets of links one by one."""
    n = graph.number_of_nodes()
    if not nx.is_connected(graph) or min(d for _, d in graph.degree) < 2:
        return False
    return 3 * (n - 1) - 2 * graph.number_of_edges() == mobility and all(
        3 * (size - 1) - 2 * graph.subgraph(some).number_of_edges() >= 1
        for size in range(2, n)
        for some in combinations(graph, size)
    )


def obvious_class(graph):
    if nx.has_bridges(graph):
        return "joint"
    return "none" if nx.is_biconnected(graph) else "link"


def coded(found):
    """{class: codes}, doubles an error."""
    out = {kind: [] for kind in CLASSES}
    for kind, name in found:
        out[kind].append(name)
    assert all(len(set(names)) == len(names) for names in out.values())
    return {kind: set(names) for kind, names in out.items()}


@pytest.mark.parametrize(("links", "mobility"), [(4, 1), (5, 0), (5, 2), (6, 1), (6, 3), (7, 0), (7, 2), (7, 4)])
def test_the_atlas_of_graphs_holds_the_same_chains(links, mobility):
    joints = (3 * (links - 1) - mobility) // 2
    atlas = [
        graph
        for graph in nx.graph_atlas_g()
        if graph.number_of_nodes() == links and graph.number_of_edges() == joints and obvious(graph, mobility)
    ]
    expected = coded((obvious_class(graph), code(Chain.from_edges(graph.edges))) for graph in atlas)
    assert expected == coded(
        (kind, code(chain)) for kind in CLASSES for chain in chains(links, mobility, fractionated=kind)
    )


def trees_with_edges(links, edges):
    """Every connected graph with so many edges more than a tree and no end, with doubles."""
    for tree in nx.nonisomorphic_trees(links):
        ends = {v for v, degree in tree.degree if degree == 1}
        missing = list(nx.non_edges(tree))
        for some in combinations(missing, edges):
            if ends <= {v for edge in some for v in edge}:
                graph = tree.copy()
                graph.add_edges_from(some)
                yield graph


@pytest.mark.parametrize(("links", "mobility"), [(8, 3), (9, 4), pytest.param(9, 2, marks=pytest.mark.slow)])
def test_brute_force_holds_the_same_chains(links, mobility):
    classes = {}
    for graph in trees_with_edges(links, (links - 1 - mobility) // 2):
        name = code(Chain.from_edges(graph.edges))
        if name not in classes:
            classes[name] = obvious_class(graph) if obvious(graph, mobility) else None
    expected = coded((kind, name) for name, kind in classes.items() if kind is not None)
    assert expected == coded(
        (kind, code(chain)) for kind in CLASSES for chain in chains(links, mobility, fractionated=kind)
    )


def test_lazy_and_always_in_the_same_order():
    first = next(fractionated_chains(15, 2, "link"))
    assert fractionation(first) == "link"
    assert fractionated_list(11, 2, "link") == fractionated_list(11, 2, "link")
    assert list(chains(9, 2, fractionated="all")) == [
        chain for kind in CLASSES for chain in chains(9, 2, fractionated=kind)
    ]


def test_classes_of_multiple_joints():
    """Two four-bars: sharing a link, sharing a pin only, sharing a link at the same pin."""
    four = "R(0-1) R(1-2) R(2-3)"
    assert fractionation(Chain.parse(f"{four} R(3-0) R(0-4) R(4-5) R(5-6) R(6-0)")) == "link"
    assert fractionation(Chain.parse(f"{four} R(3-0-4-7) R(4-5) R(5-6) R(6-7)")) == "joint"
    assert fractionation(Chain.parse(f"{four} R(3-0-4) R(4-5) R(5-6) R(6-0)")) == "link"
    assert fractionation(Chain.parse("R(0-1) R(0-2-4) R(2-3) R(3-1) R(4-5) R(5-1)")) == "none"
