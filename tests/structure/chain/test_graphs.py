"""Graphs of networkx: what `link_graph` and `incidence_graph` give comes back, through files too; nothing else does."""

import json
from io import BytesIO

import networkx as nx
import numpy as np
import pytest
from hypothesis import given

from gruebler import Chain, Mechanism
from gruebler.base.errors import ChainError
from tests.strategies import SPATIAL, SPHERICAL, built_mechanisms, chains

CHAINS = chains() | chains(pairs=SPHERICAL, space="spherical") | chains(pairs=SPATIAL, space="spatial")


def by_json(graph):
    return nx.node_link_graph(json.loads(json.dumps(nx.node_link_data(graph, edges="edges"))), edges="edges")


def by_graphml(graph):
    file = BytesIO()
    nx.write_graphml(graph, file)
    file.seek(0)
    return nx.read_graphml(file, force_multigraph=graph.is_multigraph())


def by_gml(graph):
    return nx.parse_gml("\n".join(nx.generate_gml(graph, stringizer=str)))


def other_order(graph):
    """The graph with nodes and edges put in backwards; nodes numbered where their attributes name them."""
    other = type(graph)(**graph.graph)
    named = graph.is_multigraph()
    new = {node: node if named else place for place, node in enumerate(graph)}
    other.add_nodes_from((new[node], graph.nodes[node]) for node in reversed(list(graph)))
    other.add_edges_from((new[b], new[a], marks) for a, b, marks in reversed(list(graph.edges(data=True))))
    return other


WAYS = [lambda graph: graph, by_json, by_graphml, by_gml, other_order]
NAMES = ["itself", "node-link JSON", "GraphML", "GML", "another order"]


def written(value):
    """Everything of a chain or mechanism that has an order, which equality of chains leaves out."""
    chain = getattr(value, "chain", value)
    return chain.joints, getattr(value, "drives", None), getattr(value, "frame", None), chain.space


@pytest.mark.parametrize("way", WAYS, ids=NAMES)
@given(chain=CHAINS)
def test_the_graphs_of_a_chain_come_back(way, chain):
    for graph in (chain.link_graph(), chain.incidence_graph()):
        again = Chain.from_networkx(way(graph))
        assert again == chain
        assert written(again) == written(chain)
        assert again.links == (chain.links[::-1] if way is other_order else chain.links)


@pytest.mark.parametrize("way", WAYS, ids=NAMES)
@given(built=built_mechanisms())
def test_the_graphs_of_a_mechanism_come_back_with_frame_and_drives(way, built):
    mechanism = built.mechanism
    for graph in (mechanism.link_graph(), mechanism.incidence_graph()):
        again = Mechanism.from_networkx(way(graph))
        assert again == mechanism
        assert written(again) == written(mechanism)


def test_drives_of_several_freedoms_and_links_come_back():
    for text in (
        'spatial: C("a; b"-c) R(c-d) R(d-"a; b"); frame="a; b"; drive=C("a; b"-c):Rz; drive=C("a; b"-c):Tz',
        "R(a-b-c) R(a-d) R(d-b) R(b-c) R(b-c); frame=d; drive=R(a-b-c):b-c; drive=R(b-c)#2",
    ):
        mechanism = Mechanism.parse(text)
        assert written(Mechanism.from_networkx(by_graphml(mechanism.incidence_graph()))) == written(mechanism)


QUAD = Chain.parse("R(0-1) R(1-2) P(2-3) R(3-0)")
DRIVEN = Mechanism(QUAD, "0", [0])


def changed(graph, change):
    change(graph)
    return graph


REFUSED = [
    (lambda: Chain("R(0-1) R(1-2)"), "Chain.parse reads a text, Chain.from_edges takes edges"),
    (lambda: Chain([(0, 1), (1, 2), (2, 0)]), "each a pair and the names of its links, not (0, 1)"),
    (lambda: Chain([("revolute", 3)]), "not ('revolute', 3)"),
    (lambda: Chain(7), "not 7; Chain.parse reads a text"),
    (lambda: Chain({"revolute": ["a", "b"]}), "Chain.parse"),
    (lambda: Chain(["R(0-1)", "R(1-2)"]), "not 'R(0-1)'; Chain.parse reads a text"),
    (lambda: Chain.from_edges(QUAD.incidence_graph().edges), "Chain.from_networkx takes a graph with its pairs"),
    (lambda: Chain.from_edges(QUAD.link_graph().edges(data=True)), "Chain.from_networkx"),
    (lambda: Chain.from_edges(QUAD.link_graph()), "expected edges, each two names of links, not '0'"),
    (lambda: Chain.from_edges("01 12"), "expected edges, each two names of links, not '01 12'"),
    (lambda: Chain.from_networkx(nx.cycle_graph(4)), "Chain.from_edges(graph.edges)"),
    (lambda: Chain.from_networkx(nx.DiGraph(QUAD.link_graph())), "expected an undirected graph of networkx"),
    (lambda: Chain.from_networkx("R(0-1)"), "expected an undirected graph of networkx"),
    (lambda: Chain.from_networkx(DRIVEN.link_graph()), "Mechanism.from_networkx(graph) takes it"),
    (lambda: Mechanism.from_networkx(QUAD.link_graph()), "Chain.from_networkx(graph) takes it"),
    (lambda: Chain.from_networkx(changed(QUAD.incidence_graph(), lambda g: g.add_node(5))), "the node 5 is neither"),
    (
        lambda: Chain.from_networkx(
            changed(QUAD.incidence_graph(), lambda g: g.add_edge(("link", "0"), ("link", "1")))
        ),
        "does not join a link with a joint",
    ),
    (
        lambda: Chain.from_networkx(
            changed(QUAD.link_graph(), lambda g: g.add_edge("0", "2", joint=0, pair="revolute"))
        ),
        "joint 0 joins 0, 1, 2, but has no edge between every two of them",
    ),
    (
        lambda: Chain.from_networkx(
            changed(QUAD.link_graph(), lambda g: g.add_edge("0", "1", joint=0, pair="revolute"))
        ),
        "joint 0 has two edges 0-1",
    ),
    (
        lambda: Chain.from_networkx(changed(QUAD.link_graph(), lambda g: g.add_edge("0", "2", joint="x", pair="slot"))),
        "edge 0-2: joint: expected a whole number, not 'x'",
    ),
    (lambda: Chain.from_networkx(nx.contracted_nodes(QUAD.link_graph(), "0", "1")), "joint 0"),
]


@pytest.mark.parametrize(("call", "words"), REFUSED, ids=[words for _, words in REFUSED])
def test_what_is_no_chain_is_refused_in_a_sentence(call, words):
    with pytest.raises(ChainError, match=r"^[^\n]+$") as caught:
        call()
    assert words in str(caught.value)


def test_edges_of_other_graphs_and_arrays_are_simple_joints():
    ring = Chain.parse("R(0-1) R(1-2) R(2-3) R(0-3)")
    assert Chain.from_edges(nx.cycle_graph(4).edges) == ring
    assert Chain.from_edges(np.array([[0, 1], [1, 2], [2, 3], [0, 3]])) == ring
