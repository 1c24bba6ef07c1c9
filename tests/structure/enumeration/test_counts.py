"""The numbers of COUNTS (computed once by another program), and each by a second way."""

from collections import Counter
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from itertools import product
from math import comb
from multiprocessing import get_context
from random import Random

import networkx as nx
import numpy as np
import pytest

from gruebler import _core
from gruebler.base.errors import GrueblerError
from gruebler.structure.enumeration import (
    ContractedGraph,
    Request,
    chains,
    contracted_graphs,
    count_chains,
    edge_blocks,
)
from gruebler.structure.enumeration.contracted import pack
from gruebler.structure.enumeration.pieces import count_piece, list_piece, pieces, work_of_graphs
from gruebler.structure.enumeration.work_units import add_tallies

# mobility -> {links: chains}, non-fractionated. Sources: unfiltered generation with a test of all subsets of links;
# for mobility 1 also OEIS A233288.
NUMBERS = {
    0: {3: 1, 5: 1, 7: 3, 9: 28},
    1: {4: 1, 6: 2, 8: 16, 10: 230, 12: 6856, 14: 318162},
    2: {5: 1, 7: 3, 9: 35, 11: 753},
    3: {6: 1, 8: 5, 10: 74},
}
# links -> inversions, drives, joint orbits, for mobility 1
ORBITS = {4: (1, 1, 1), 6: (5, 9, 6), 8: (71, 153, 84), 10: (1834, 4506, 2307)}


@pytest.mark.parametrize(("mobility", "links"), [(f, n) for f, row in NUMBERS.items() for n in row])
def test_numbers(mobility, links):
    assert count_chains(links, mobility).chains == NUMBERS[mobility][links]


@pytest.mark.slow
def test_sixteen_links():
    found = count_chains(16, orbits=True)
    assert found.chains == 19_819_281
    assert sum(found.by_assortment.values()) == found.chains


@pytest.mark.slow
def test_eighteen_links():
    with ProcessPoolExecutor(2, get_context("spawn")) as executor:
        assert count_chains(18, executor=executor).chains == 1_535_380_884


@pytest.mark.parametrize("links", ORBITS)
def test_orbits(links):
    found = count_chains(links, orbits=True)
    assert (found.inversions, found.drives, found.joint_orbits) == ORBITS[links]


@pytest.mark.parametrize(("links", "mobility"), [(10, 1), (12, 1), (11, 2), (12, 3)])
def test_by_assortment_against_the_degrees_of_the_listed_chains(links, mobility):
    expected = Counter()
    for block in edge_blocks(links, mobility):
        for edges in block:
            degrees = np.bincount(edges.ravel(), minlength=links)
            expected[tuple(np.bincount(degrees)[2:].tolist())] += 1
    found = count_chains(links, mobility).by_assortment
    assert found == expected
    assert list(found) == sorted(found)


@pytest.mark.parametrize(("links", "mobility"), [(12, 1), (11, 2), (9, 0)])
def test_one_assortment_alone(links, mobility):
    whole = count_chains(links, mobility, orbits=True)
    parts = [count_chains(links, mobility, assortment=a, orbits=True) for a in whole.by_assortment]
    assert [part.chains for part in parts] == list(whole.by_assortment.values())
    assert sum(part.inversions for part in parts) == whole.inversions
    assert sum(part.drives for part in parts) == whole.drives
    assert count_chains(links, mobility, assortment=(links,)).chains == 0


def orbits_by_search(graph):
    """Links, joints and (link, joint) up to symmetry, by listing every automorphism with networkx."""
    matcher = nx.isomorphism.GraphMatcher(graph, graph)
    links, joints, flags = nx.utils.UnionFind(), nx.utils.UnionFind(), nx.utils.UnionFind()
    for image in matcher.isomorphisms_iter():
        for v in graph:
            links.union(v, image[v])
        for u, v in graph.edges:
            joints.union(frozenset((u, v)), frozenset((image[u], image[v])))
            for a, b in ((u, v), (v, u)):
                flags.union((a, b), (image[a], image[b]))
    return Counter(
        inversions=len(list(links.to_sets())),
        drives=len(list(flags.to_sets())),
        joint_orbits=len(list(joints.to_sets())),
    )


@pytest.mark.parametrize(
    ("links", "mobility"),
    [(3, 0), (5, 0), (7, 0), (9, 0), (4, 1), (6, 1), (8, 1), (5, 2), (7, 2), (9, 2), (6, 3), (8, 3), (9, 4), (10, 3)],
)
def test_orbits_against_every_automorphism(links, mobility):
    found = count_chains(links, mobility, orbits=True)
    expected = Counter()
    for block in edge_blocks(links, mobility):
        for edges in block.tolist():
            expected += orbits_by_search(nx.Graph(edges))
    assert (found.inversions, found.drives, found.joint_orbits) == (
        expected["inversions"],
        expected["drives"],
        expected["joint_orbits"],
    )


def is_sound(nodes, strings, mobility):
    """Conditions of the theorem on strings, taken literally: (node, node, weight) for every string."""
    if sum(w - 2 for _, _, w in strings) + 3 * (nodes - 1) != mobility:
        return False
    if mobility == 0 and any(w > 1 for _, _, w in strings):
        return False
    if mobility >= 1 and sum(max(w - 2, 0) for _, _, w in strings) >= mobility:
        return False
    for subset in range(1, 2**nodes - 1):
        size = subset.bit_count()
        inside = [w for u, v, w in strings if subset >> u & subset >> v & 1]
        if size > 1 and sum(2 - min(w, 2) for w in inside) > 3 * size - 4:
            return False
    return True


@pytest.mark.parametrize("mobility", [0, 1, 2, 3, 4])
@pytest.mark.parametrize("loops", [2, 3])
def test_chains_of_every_contracted_graph(loops, mobility):
    """Against all weights on all strings, counted by Burnside's lemma."""
    for graph in contracted_graphs(loops):
        ends = [(u, v) for u, v, k in graph.bundles for _ in range(k)]
        sound = set()
        for weights in product(range(mobility + 2), repeat=len(ends)):
            by_bundle = {}
            for pair, w in zip(ends, weights, strict=True):
                by_bundle.setdefault(pair, []).append(w)
            if all(row == sorted(row) for row in by_bundle.values()):
                strings = [(u, v, w) for (u, v), w in zip(ends, weights, strict=True)]
                if is_sound(graph.nodes, strings, mobility):
                    sound.add(tuple((frozenset(pair), tuple(row)) for pair, row in sorted(by_bundle.items())))
        fixed = sum(
            all(dict(a)[frozenset(image[v] for v in pair)] == row for pair, row in a)
            for image in graph.automorphisms
            for a in sound
        )
        ((_, chains, *_),) = _core.take_census(pack([graph]), loops, mobility, False)
        assert chains * len(graph.automorphisms) == fixed


# Chains of 22 links of one contracted graph with 10 loops and 18 nodes each; counted by `pebble_oracle`.
TEN_LOOPS = [(nx.pappus_graph(), 155), (nx.circular_ladder_graph(9), 826), (nx.LCF_graph(18, [5, -5], 9), 1554)]


def test_chains_of_22_links():
    """Against pebbles (fast: what they found once), and listed one by one."""
    for graph, chains_ in TEN_LOOPS:
        packed = pack([ContractedGraph(tuple((u, v, 1) for u, v in graph.edges))])
        assert _core.take_census(packed, 10, 1, True)[0, 1] == len(_core.list_chains(packed, 10, 1)) == chains_
        assert work_of_graphs(packed)[0] - 5000 == comb(27, 4) + 27 * comb(26, 2) + comb(27, 2)  # 2 - c adds up to 4


@pytest.mark.slow
def test_chains_of_22_links_by_pebbles():
    from tests.structure.enumeration.pebble_oracle import count_by_pebbles

    for graph, chains_ in TEN_LOOPS:
        assert count_by_pebbles([(min(e), max(e), 1) for e in graph.edges], 22) == chains_


@pytest.mark.parametrize(
    ("links", "mobility"),
    [(12, 1), (14, 1), (11, 0), (13, 0), (11, 2), (13, 2), (12, 3), (13, 4), (14, 5), (22, 15), (31, 24)],
)
def test_burnside_against_orderly_listing(links, mobility):
    """Two ways that share the contracted graphs and the critical sets, and nothing else."""
    counted = [count for piece in pieces(links, mobility) for count in count_piece(piece)]
    listed = sum(len(block) for block in edge_blocks(links, mobility))
    assert sum(count.chains for count in counted) == listed > 0


@pytest.mark.parametrize("size", [1, 30_000, 1_000_000])
def test_cutting_and_order_do_not_matter(size):
    work = list(pieces(12, 1, size=size))
    assert all(piece.work >= size for piece in work[:-1])
    Random(size).shuffle(work)
    tallies = [count_piece(piece, orbits=True) for piece in work]
    assert add_tallies(Request(12), True, tallies) == count_chains(12, orbits=True)
    assert len(work) == {1: 118, 30_000: 20, 1_000_000: 1}[size]


def test_executors():
    alone = count_chains(14, orbits=True)
    with ThreadPoolExecutor(3) as threads, ProcessPoolExecutor(2, get_context("spawn")) as processes:
        assert count_chains(14, orbits=True, executor=threads) == alone
        assert count_chains(12, executor=processes) == count_chains(12)


def test_graphs_that_begin_at_any_byte_of_a_message():
    """As dask sends them; the doors copy what begins between two words."""
    piece = next(iter(pieces(10, 1)))
    message = b"at" + piece.graphs.tobytes()
    sent = np.frombuffer(message, np.int64, offset=2).reshape(piece.graphs.shape)
    assert not sent.flags.aligned
    moved = replace(piece, graphs=sent)
    assert count_piece(moved) == count_piece(piece)
    assert np.array_equal(list_piece(moved), list_piece(piece))


def test_json():
    assert count_chains(8, orbits=True).to_json() == {
        "links": 8,
        "mobility": 1,
        "chains": 16,
        "by_assortment": {"4,4": 9, "5,2,1": 5, "6,0,2": 2},
        "inversions": 71,
        "drives": 153,
        "joint_orbits": 84,
    }


def test_numbers_that_no_chain_has():
    for links, mobility in ((5, 1), (7, 3), (4, 3)):
        found = count_chains(links, mobility, orbits=True)
        assert (found.chains, found.by_assortment, found.drives) == (0, {}, 0)
        assert list(chains(links, mobility)) == []
    for links, mobility in ((1, 0), (2, 1)):
        for answer in (chains, count_chains):
            with pytest.raises(GrueblerError, match=r"at least three links"):
                answer(links, mobility)
    assert count_chains(7, 4, assortment=(6, 1)).chains == 0


def test_refusals():
    with pytest.raises(GrueblerError, match="mobility 0 or more"):
        count_chains(4, -1)
    with pytest.raises(GrueblerError, match="11 loops"):
        count_chains(24)
    with pytest.raises(GrueblerError, match="mobility 24"):
        count_chains(30, 25)
