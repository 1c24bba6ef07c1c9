"""The canonical labelling against brute force, networkx, igraph and the groups the literature knows."""

from collections import Counter
from collections.abc import Callable
from hashlib import sha256
from itertools import permutations
from math import factorial

import igraph
import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from gruebler import _core
from gruebler.structure.isomorphism.labelling import CanonicalResult, canonical_form, relabelled

Form = tuple[tuple[int, ...], tuple[tuple[int, int, int], ...]]
Array = NDArray[np.int64]


class Graph:
    """A coloured multigraph as four plain arrays."""

    def __init__(self, n: int, edges: object, vertex_colour: object = None, edge_colour: object = None) -> None:
        self.n = n
        self.edges: Array = np.array(edges, np.int64).reshape(-1, 2)
        self.vertex_colour: Array = np.zeros(n, np.int64)
        self.edge_colour: Array = np.zeros(len(self.edges), np.int64)
        if vertex_colour is not None:
            self.vertex_colour[:] = np.array(vertex_colour, np.int64)
        if edge_colour is not None:
            self.edge_colour[:] = np.array(edge_colour, np.int64)

    @classmethod
    def of(cls, graph: nx.Graph) -> "Graph":
        plain = nx.convert_node_labels_to_integers(graph)
        return cls(len(plain), list(plain.edges()))

    def shuffled(self, rng: np.random.Generator) -> "Graph":
        name = rng.permutation(self.n)
        colour = np.empty(self.n, np.int64)
        colour[name] = self.vertex_colour
        order = rng.permutation(len(self.edges))
        ends = rng.permuted(name[self.edges[order]], axis=1)
        return Graph(self.n, ends, colour, self.edge_colour[order])

    def solve(self) -> CanonicalResult:
        return canonical_form(self.n, self.vertex_colour, self.edges, self.edge_colour)

    def under(self, labelling: NDArray[np.int32]) -> Form:
        return relabelled(labelling, self.vertex_colour, self.edges, self.edge_colour)

    def form(self) -> Form:
        return self.under(self.solve().labelling)

    def networkx(self) -> nx.MultiGraph:
        graph = nx.MultiGraph()
        graph.add_nodes_from((v, {"colour": int(c)}) for v, c in enumerate(self.vertex_colour))
        for (u, v), c in zip(self.edges.tolist(), self.edge_colour.tolist(), strict=True):
            graph.add_edge(u, v, colour=c)
        return graph

    def matrix(self) -> Array:
        """Number every multiset of colours between two vertices: the graph as one matrix."""
        between: dict[tuple[int, int], list[int]] = {}
        for (u, v), c in zip(self.edges.tolist(), self.edge_colour.tolist(), strict=True):
            between.setdefault((min(u, v), max(u, v)), []).append(c)
        number: dict[tuple[int, ...], int] = {}
        table = np.diag(-1 - self.vertex_colour)
        for (u, v), colours in between.items():
            table[u, v] = table[v, u] = number.setdefault(tuple(sorted(colours)), len(number) + 1)
        return table


def same_colours(first: dict[int, dict[str, int]], second: dict[int, dict[str, int]]) -> bool:
    """Compare parallel edges as multisets (the ready-made matcher of networkx compares sets)."""
    return sorted(e["colour"] for e in first.values()) == sorted(e["colour"] for e in second.values())


def isomorphic(first: Graph, second: Graph) -> bool:
    match = nx.isomorphism.categorical_node_match("colour", -1)
    return bool(nx.is_isomorphic(first.networkx(), second.networkx(), node_match=match, edge_match=same_colours))


def brute_automorphisms(graph: Graph) -> Array:
    every = np.array(list(permutations(range(graph.n))), np.int64).reshape(factorial(graph.n), graph.n)
    table = graph.matrix()
    keeps = (table[every[:, :, None], every[:, None, :]] == table).all(axis=(1, 2))
    return every[keeps]


def closure(n: int, generators: NDArray[np.int32]) -> set[tuple[int, ...]]:
    start = tuple(range(n))
    seen = {start}
    frontier = [start]
    while frontier:
        grown = []
        for element in frontier:
            for g in generators.tolist():
                product = tuple(g[i] for i in element)
                if product not in seen:
                    seen.add(product)
                    grown.append(product)
        frontier = grown
    return seen


def check_symmetry(graph: Graph, result: CanonicalResult) -> None:
    """What can be said of every answer: generators are automorphisms, orbits are theirs, places are a numbering."""
    assert sorted(result.labelling.tolist()) == list(range(graph.n))
    here = graph.under(np.arange(graph.n, dtype=np.int32))
    links = nx.Graph()
    links.add_nodes_from(range(graph.n))
    for g in result.generators:
        assert sorted(g.tolist()) == list(range(graph.n))
        assert graph.under(g) == here
        links.add_edges_from(enumerate(g.tolist()))
    least = {v: min(part) for part in nx.connected_components(links) for v in part}
    assert result.orbits.tolist() == [least[v] for v in range(graph.n)]
    assert len(result.generators) < max(graph.n, 1)


@st.composite
def graphs(draw: st.DrawFn, most: int = 7) -> Graph:
    n = draw(st.integers(0, most))
    colours = st.integers(0, draw(st.integers(0, 2)))
    pairs = [(u, v) for u in range(n) for v in range(u)]
    edges = draw(st.lists(st.sampled_from(pairs), max_size=2 * n)) if pairs else []
    vertex_colour = draw(st.lists(colours, min_size=n, max_size=n))
    edge_colour = draw(st.lists(colours, min_size=len(edges), max_size=len(edges)))
    return Graph(n, edges, vertex_colour, edge_colour)


@given(graphs(12), st.integers(0, 2**32 - 1))
def test_form_is_blind_to_numbering(graph: Graph, seed: int) -> None:
    result = graph.solve()
    check_symmetry(graph, result)
    form = graph.under(result.labelling)
    assert list(form[0]) == sorted(form[0])
    other = graph.shuffled(np.random.default_rng(seed))
    assert other.form() == form
    assert other.solve().order == result.order


@given(graphs(6), st.data())
def test_equal_forms_mean_isomorphic(graph: Graph, data: st.DataObject) -> None:
    other = graph.shuffled(np.random.default_rng(data.draw(st.integers(0, 99))))
    if graph.n > 1 and data.draw(st.booleans()):
        v = data.draw(st.integers(0, graph.n - 1))
        other.vertex_colour[[v, v - 1]] = other.vertex_colour[[v - 1, v]]
    if len(graph.edges) > 1 and data.draw(st.booleans()):
        e = data.draw(st.integers(0, len(graph.edges) - 1))
        other.edge_colour[[e, e - 1]] = other.edge_colour[[e - 1, e]]
    if len(graph.edges) and data.draw(st.booleans()):
        e = data.draw(st.integers(0, len(graph.edges) - 1))
        u, v = data.draw(st.permutations(range(graph.n)))[:2]
        other.edges[e] = u, v
    assert (graph.form() == other.form()) == isomorphic(graph, other)


@given(graphs(6))
@settings(max_examples=60)
def test_group_is_the_group(graph: Graph) -> None:
    result = graph.solve()
    every = brute_automorphisms(graph)
    assert result.order == len(every)
    assert result.orbits.tolist() == every.min(axis=0).tolist()
    assert closure(graph.n, result.generators) == set(map(tuple, every.tolist()))


def test_atlas_has_one_form_for_each_graph() -> None:
    rng = np.random.default_rng(1)
    forms: Counter[Form] = Counter()
    atlas = nx.graph_atlas_g()
    for entry in atlas:
        graph = Graph.of(entry)
        form = graph.form()
        forms[form] += 1
        for _ in range(3):
            assert graph.shuffled(rng).form() == form
    assert len(forms) == len(atlas) == 1253
    assert set(forms.values()) == {1}


def test_atlas_groups_by_brute_force() -> None:
    for entry in nx.graph_atlas_g()[::7]:
        graph = Graph.of(entry).shuffled(np.random.default_rng(2))
        result = graph.solve()
        check_symmetry(graph, result)
        every = brute_automorphisms(graph)
        assert result.order == len(every)
        assert result.orbits.tolist() == every.min(axis=0).tolist()
        if result.order <= 240:
            assert len(closure(graph.n, result.generators)) == result.order


def theta(strings: int) -> nx.Graph:
    graph = nx.Graph()
    for i in range(strings):
        nx.add_path(graph, ["a", (i, 0), (i, 1), "b"])
    return graph


def plane(q: int) -> nx.Graph:
    """Points and lines of the projective plane over the integers modulo a prime q."""
    points = [(1, a, b) for a in range(q) for b in range(q)] + [(0, 1, a) for a in range(q)] + [(0, 0, 1)]
    return nx.Graph(
        (("point", i), ("line", j))
        for i, x in enumerate(points)
        for j, y in enumerate(points)
        if sum(s * t for s, t in zip(x, y, strict=True)) % q == 0
    )


def shrikhande() -> nx.Graph:
    steps = [(1, 0), (0, 1), (1, 1)]
    return nx.Graph(((a, b), ((a + c) % 4, (b + d) % 4)) for a in range(4) for b in range(4) for c, d in steps)


def rook() -> nx.Graph:
    return nx.line_graph(nx.complete_bipartite_graph(4, 4))


def copies(*parts: nx.Graph) -> nx.Graph:
    return nx.disjoint_union_all(parts)


KNOWN: list[tuple[str, Callable[[], nx.Graph], int, int]] = [
    ("petersen", nx.petersen_graph, 120, 1),
    ("cube", lambda: nx.hypercube_graph(3), 48, 1),
    ("5-cube", lambda: nx.hypercube_graph(5), 3840, 1),
    ("8-cube", lambda: nx.hypercube_graph(8), 2**8 * factorial(8), 1),
    ("dodecahedron", nx.dodecahedral_graph, 120, 1),
    ("hoffman-singleton", nx.hoffman_singleton_graph, 252_000, 1),
    ("kneser 7,3", lambda: nx.kneser_graph(7, 3), 5040, 1),
    ("theta 2", lambda: theta(2), 12, 1),
    ("theta 3", lambda: theta(3), 12, 2),
    ("theta 7", lambda: theta(7), 10_080, 2),
    ("theta 12", lambda: theta(12), 2 * factorial(12), 2),
    ("theta 40", lambda: theta(40), 2 * factorial(40), 2),
    ("K3,3", lambda: nx.complete_bipartite_graph(3, 3), 72, 1),
    ("K2,9", lambda: nx.complete_bipartite_graph(2, 9), 2 * factorial(9), 2),
    ("K2,400", lambda: nx.complete_bipartite_graph(2, 400), 2 * factorial(400), 2),
    ("K30,30", lambda: nx.complete_bipartite_graph(30, 30), 2 * factorial(30) ** 2, 1),
    ("K60", lambda: nx.complete_graph(60), factorial(60), 1),
    ("star", lambda: nx.star_graph(300), factorial(300), 2),
    ("no edges", lambda: nx.empty_graph(80), factorial(80), 1),
    ("300-cycle", lambda: nx.cycle_graph(300), 600, 1),
    ("5-cycle", lambda: nx.cycle_graph(5), 10, 1),
    ("path", lambda: nx.path_graph(1500), 2, 750),
    ("3-prism", lambda: nx.circular_ladder_graph(3), 12, 1),
    ("7-prism", lambda: nx.circular_ladder_graph(7), 28, 1),
    ("100-prism", lambda: nx.circular_ladder_graph(100), 400, 1),
    ("torus", lambda: nx.grid_graph((7, 7), periodic=True), 8 * 49, 1),
    ("rook 4", rook, 1152, 1),
    ("shrikhande", shrikhande, 192, 1),
    ("rook 10", lambda: nx.line_graph(nx.complete_bipartite_graph(10, 10)), 2 * factorial(10) ** 2, 1),
    ("paley 61", lambda: nx.paley_graph(61).to_undirected(), 61 * 30, 1),
    ("plane of order 2", lambda: plane(2), 336, 1),
    ("plane of order 7", lambda: plane(7), 2 * 7**3 * (7**3 - 1) * (7**2 - 1), 1),
    ("binary tree", lambda: nx.balanced_tree(2, 6), 2**63, 7),
    ("petersens", lambda: copies(*[nx.petersen_graph()] * 12), 120**12 * factorial(12), 1),
    ("cycles", lambda: copies(*[nx.cycle_graph(k) for k in range(3, 16)] * 2), 8**13 * factorial(15) ** 2 // 4, 13),
    ("one parameter set", lambda: copies(rook(), shrikhande(), rook()), 1152**2 * 2 * 192, 2),
]


@pytest.mark.parametrize(("make", "order", "orbits"), [row[1:] for row in KNOWN], ids=[row[0] for row in KNOWN])
def test_known_groups(make: Callable[[], nx.Graph], order: int, orbits: int) -> None:
    graph = Graph.of(make())
    rng = np.random.default_rng(3)
    form = graph.form()
    for _ in range(3):
        other = graph.shuffled(rng)
        result = other.solve()
        check_symmetry(other, result)
        assert other.under(result.labelling) == form
        assert result.order == order
        assert len(set(result.orbits.tolist())) == orbits


def test_the_numbering_is_kept() -> None:
    """Codes are stored: who changes this digest changes the prefix of the codes (docs/theory/canonical-code.md)."""
    known = [make() for _, make, _, _ in KNOWN]
    ladder = [nx.circular_ladder_graph(k) for k in range(3, 9)]
    uneven = [copies(*ladder), nx.frucht_graph(), nx.tutte_graph(), plane(3)]
    coloured = Graph(5, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0), (0, 1)], [7, 0, 0, 1, 7], [1, 0, 2, 0, 0, 3])
    forms = [Graph.of(graph).form() for graph in [*nx.graph_atlas_g(), *known, *uneven]]
    digest = sha256(repr([*forms, coloured.form()]).encode()).hexdigest()
    assert digest == "7f367f7badc81edabe172b94e59947ecab8a9c105d5f933bbea4776332357a1a"


def test_pairs_that_refinement_cannot_tell_apart() -> None:
    assert Graph.of(rook()).form() != Graph.of(shrikhande()).form()
    six = Graph.of(nx.cycle_graph(6))
    assert six.form() != Graph.of(copies(nx.cycle_graph(3), nx.cycle_graph(3))).form()
    assert Graph.of(nx.circular_ladder_graph(6)).form() != Graph.of(nx.circulant_graph(12, [1, 6])).form()


def igraph_form(graph: Graph) -> Form:
    """Label by the program bliss in igraph; `permute_vertices` knows which way its permutation runs."""
    judge = igraph.Graph(n=graph.n, edges=graph.edges.tolist())
    judge.vs["colour"] = graph.vertex_colour.tolist()
    there = judge.permute_vertices(judge.canonical_permutation(color=judge.vs["colour"]))
    edges = sorted((min(e), max(e), 0) for e in there.get_edgelist())
    return tuple(there.vs["colour"]), tuple(edges)


def test_same_classes_as_igraph() -> None:
    rng = np.random.default_rng(4)
    pairs: set[tuple[Form, Form]] = set()
    drawn = 0
    for n in (6, 8, 10):
        for seed in range(60):
            graph = Graph.of(nx.random_regular_graph(3, n, seed=seed))
            if seed % 2:
                graph.vertex_colour[:] = rng.integers(0, 2) * (np.arange(n) < 2)
            graph = graph.shuffled(rng)
            pairs.add((graph.form(), igraph_form(graph)))
            drawn += 1
    assert len({ours for ours, _ in pairs}) == len({theirs for _, theirs in pairs}) == len(pairs) < drawn


@pytest.mark.parametrize("seed", range(20))
def test_same_order_as_igraph(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(5, 60))
    m = int(rng.integers(n // 2, 2 * n))
    plain = nx.gnm_random_graph(n, m, seed=seed)
    graph = Graph(n, list(plain.edges()), rng.integers(0, 2, n) if seed % 2 else None)
    judge = igraph.Graph(n=n, edges=graph.edges.tolist())
    result = graph.solve()
    check_symmetry(graph, result)
    assert result.order == judge.count_automorphisms(color=graph.vertex_colour.tolist())
    assert graph.shuffled(rng).form() == graph.under(result.labelling)


def test_colours_and_parallel_edges_count() -> None:
    square = [(0, 1), (1, 2), (2, 3), (3, 0)]
    assert Graph(4, square).solve().order == 8
    assert Graph(4, square, [1, 0, 0, 0]).solve().order == 2
    assert Graph(4, square, None, [0, 1, 0, 1]).solve().order == 4
    assert Graph(4, [*square, (0, 1)]).solve().order == 2
    double = Graph(3, [(0, 1), (0, 1), (1, 2), (1, 2)], None, [1, 2, 2, 1])
    assert double.solve().order == 2
    assert double.form() != Graph(3, [(0, 1), (0, 1), (1, 2), (1, 2)], None, [1, 1, 2, 2]).form()


def test_wide_colours() -> None:
    colour = [2**31 - 1, 5, 0, 5]
    path = Graph(4, [(0, 1), (1, 2), (2, 3)], colour, [2**31 - 1, 0, 7])
    form = path.form()
    assert form[0] == (0, 5, 5, 2**31 - 1)
    assert path.shuffled(np.random.default_rng(5)).form() == form


@pytest.mark.parametrize("n", [0, 1, 2, 5])
def test_without_edges(n: int) -> None:
    result = canonical_form(n, None, np.empty((0, 2), np.int32))
    assert result.order == factorial(n)
    assert result.orbits.tolist() == [0] * n
    assert result.generators.shape == (max(n - 1, 0), n)


def random_chain(n: int, rng: np.random.Generator) -> Array:
    edges = [(0, 1), (1, 2), (2, 3), (3, 0)]
    for link in range(4, n, 2):
        u, v = rng.choice(link, 2, replace=False)
        edges += [(u, link), (link, link + 1), (link + 1, v)]
    return np.array(edges, np.int64)


def test_bulk_agrees_with_one_at_a_time() -> None:
    rng = np.random.default_rng(8)
    n = 12
    packed = [random_chain(n, rng) for _ in range(200)]
    packed[1] = packed[1][:5]
    bounds = np.cumsum([0, *map(len, packed)])
    labellings = _core.canonical_bulk(n, np.concatenate(packed).astype(np.int32), bounds)
    for edges, labelling in zip(packed, labellings, strict=True):
        assert labelling.tolist() == Graph(n, edges).solve().labelling.tolist()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: canonical_form(2, None, np.array([[0, 2]])), "edges must lie in 0..1"),
        (lambda: canonical_form(2, None, np.array([[-1, 0]])), "edges must lie in 0..1"),
        (lambda: canonical_form(3, None, np.array([[0, 1], [2, 2]])), "edge 1 is a loop at 2"),
        (lambda: canonical_form(3, None, np.array([0, 1])), "shape"),
        (lambda: canonical_form(3, None, np.array([[0.0, 1.0]])), "integers"),
        (lambda: canonical_form(3, np.array([0, 1]), np.array([[0, 1]])), "vertex_colour must have the shape"),
        (lambda: canonical_form(2, np.array([0, 2**31]), np.array([[0, 1]])), "vertex_colour must lie in"),
        (lambda: canonical_form(2, None, np.array([[0, 1]]), np.array([-1])), "edge_colour must lie in"),
        (lambda: canonical_form(2, None, np.array([[0, 1]]), np.array([0, 0])), "edge_colour must have the shape"),
    ],
)
def test_wrong_calls_are_refused(call: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
