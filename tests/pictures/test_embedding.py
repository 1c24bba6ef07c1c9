"""Embeddings: every one once, against brute force and known numbers; planar graphs made of others."""

import math
from itertools import combinations, pairwise, permutations, product

import networkx as nx
import pytest

from gruebler.pictures.structure.embedding import an_embedding, ears, embeddings, faces, is_planar
from gruebler.pictures.structure.initial_layouts import initial_layouts
from gruebler.pictures.structure.planarisation import planarised_graph


def lists(graph):
    graph = nx.convert_node_labels_to_integers(graph)
    return [sorted(graph[v]) for v in range(len(graph))]


def genus_is_zero(rotation):
    darts = sum(map(len, rotation))
    return len(rotation) - darts // 2 + len(faces(rotation)) == 2


def turned_to_least(rotation):
    return tuple(
        tuple(around[around.index(min(around)) :] + around[: around.index(min(around))]) for around in rotation
    )


def brute_force(graph):
    """All planar rotation systems, by trying every order around every vertex."""
    choices = [[[a[0], *rest] for rest in permutations(a[1:])] for a in graph]
    return {turned_to_least(rotation) for rotation in product(*choices) if genus_is_zero(list(rotation))}


GRAPHS = {
    "K4": nx.complete_graph(4),
    "cube less a corner": nx.Graph(nx.hypercube_graph(3).subgraph(list(nx.hypercube_graph(3))[1:])),
    "theta": nx.Graph([(0, 2), (2, 1), (0, 3), (3, 1), (0, 4), (4, 1)]),
    "two triangles at a vertex": nx.Graph([(0, 1), (1, 2), (2, 0), (2, 3), (3, 4), (4, 2)]),
    "triangle with a tail": nx.Graph([(0, 1), (1, 2), (2, 0), (2, 3), (3, 4)]),
    "K(2,4)": nx.complete_bipartite_graph(2, 4),
}
# Nested closed ears are left out on purpose: a loop that comes back to one vertex stays in one corner.


@pytest.mark.parametrize("name", [name for name in GRAPHS if name != "two triangles at a vertex"])
def test_every_embedding_once(name):
    graph = lists(GRAPHS[name])
    found = [turned_to_least(rotation) for rotation in embeddings(graph)]
    assert len(found) == len(set(found))
    expected = brute_force(graph)
    assert set(found) <= expected
    mirrored = {turned_to_least([list(a)[::-1] for a in rotation]) for rotation in found}
    assert set(found) | mirrored == expected


@pytest.mark.parametrize("strings", [3, 4, 5])
def test_theta_graphs_have_as_many_embeddings_as_cyclic_orders(strings):
    graph = nx.Graph((end, 2 + k) for k in range(strings) for end in (0, 1))
    assert len(list(embeddings(lists(graph)))) == math.factorial(strings - 1)


def test_ears_use_every_edge_once():
    for graph in map(lists, GRAPHS.values()):
        used = [frozenset(edge) for path in ears(graph) for edge in pairwise(path)]
        assert len(used) == len(set(used)) == sum(map(len, graph)) // 2


def test_one_embedding_of_a_large_graph():
    graph = lists(nx.grid_2d_graph(7, 8))
    assert is_planar(graph)
    assert genus_is_zero(an_embedding(graph))


@pytest.mark.parametrize(
    ("graph", "crossings"),
    [(nx.complete_bipartite_graph(3, 3), 1), (nx.complete_graph(5), 1), (nx.petersen_graph(), 2)],
)
def test_crossing_numbers_of_the_literature(graph, crossings):
    """K(3,3) and K5 need one crossing (Kuratowski 1930), Petersen's graph two (Guy 1972)."""
    edges = [tuple(sorted(edge)) for edge in graph.edges]
    found = planarised_graph(lists(graph), edges)
    assert {len(one.graph) - one.first for one in found} == {crossings}
    assert all(is_planar(one.graph) for one in found)
    assert any(one.is_crossing(rotation) for one in found for rotation in embeddings(one.graph))


def test_many_crossings_are_led_through_faces():
    edges = list(combinations(range(7), 2))
    (found,) = planarised_graph(lists(nx.complete_graph(7)), edges)
    assert is_planar(found.graph)
    assert len(found.graph) - found.first >= 9  # the crossing number of K7
    assert all(len(found.graph[v]) == 4 for v in range(found.first, len(found.graph)))


def test_starts_know_their_symmetry():
    cube = lists(nx.hypercube_graph(3))
    (found,) = initial_layouts(embeddings(cube), [0] * 8)
    assert len(found.images) == 8
    for image in found.images:
        assert all(sorted(image[w] for w in cube[v]) == cube[image[v]] for v in range(8))
