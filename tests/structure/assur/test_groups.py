"""Assur groups as values: which there are, their forms and classes, and what is none."""

import random
from collections import Counter

import networkx as nx
import pytest

from gruebler import Chain, code
from gruebler.base.errors import ChainError
from gruebler.structure.assur import DYADS, AssurError, AssurGroup, assur_groups, count_assur_groups
from gruebler.structure.assur.forms import roman
from gruebler.structure.assur.listing import group_rows
from gruebler.structure.enumeration import chains
from gruebler.structure.isomorphism import symmetry
from tests.structure.assur.oracles import closed_chains, group_of_truss

TETRAD = "R(a-1) R(1-2) R(2-3) R(3-4) R(4-1) R(3-b)"
SHARED = "R(a-1-3) R(b-2) R(c-4) R(1-5) R(2-5) R(3-6) R(4-6) R(5-6)"  # two legs on one pin


@pytest.mark.parametrize(("links", "number"), [(2, 1), (4, 2), (6, 10), (8, 173)])
def test_numbers_of_groups(links, number):
    """2, 4, 6 links: COUNTS.md of the project's reference; 8: Peisach 2007."""
    found = list(assur_groups(links))
    assert all(AssurGroup(group.chain) == group for group in found)  # the check that listing leaves out
    assert len(found) == number
    assert len({group.code for group in found}) == number
    assert all(len(group.links) == links for group in found)


@pytest.mark.parametrize("links", [2, 4, 6, pytest.param(8, marks=pytest.mark.slow)])
def test_rows_against_one_truss_after_another(links):
    """Text, class and order of every group from the chain of its truss, in the same order."""
    one_by_one = [
        group_of_truss(truss, orbit[0]).canonical()
        for truss in chains(links + 1, 0)
        for orbit in symmetry(truss).link_orbits
    ]
    rows = list(group_rows(links))
    assert [row.text() for row in rows] == [str(group) for group in one_by_one]
    assert [(row.class_number, row.order) for row in rows] == [(g.class_number, g.order) for g in one_by_one]
    assert [row.group() for row in rows] == one_by_one
    assert count_assur_groups(links) == len(rows)


def test_counts_and_lists_of_ten_links():
    rows = list(group_rows(10))
    assert len(rows) == len({row.joints for row in rows}) == count_assur_groups(10) == 5438
    for row in random.Random(1).sample(rows, 40):
        group = AssurGroup(row.group().chain)
        assert group.canonical() == row.group()
        assert (group.class_number, group.order) == (row.class_number, row.order)


@pytest.mark.parametrize("links", [3, 5, 7, 9])
def test_trusses_and_groups_two_ways(links):
    """The enumeration's trusses are those grown link by link, and their groups those of all links of all trusses."""
    grown = closed_chains(links, 0)
    assert {code(truss) for truss in chains(links, 0)} == {code(truss) for truss in grown}
    by_links = {group_of_truss(truss, link).code for truss in grown for link in truss.links}
    assert by_links == {group.code for group in assur_groups(links - 1)}


def test_trusses_of_seven_links_are_in_the_graph_atlas():
    found = []
    for graph in nx.graph_atlas_g():
        if graph.number_of_nodes() != 7 or graph.number_of_edges() != 9 or not nx.is_connected(graph):
            continue
        chain = Chain.from_edges(graph.edges)
        try:
            groups = [group_of_truss(chain, link) for link in chain.links]
        except (AssurError, ChainError):
            continue
        found.append((chain, groups))
    assert {code(chain) for chain, _ in found} == {code(truss) for truss in closed_chains(7, 0)}
    assert len({group.code for _, groups in found for group in groups}) == 10


def test_classes_and_orders():
    """Dyad II.2; 3-RR III.3 and the loop of four IV.2; with six links one of class III, two ternary links in a row."""
    assert [(g.class_number, g.order) for g in assur_groups(2)] == [(2, 2)]
    assert sorted((g.class_number, g.order) for g in assur_groups(4)) == [(3, 3), (4, 2)]
    six = Counter((g.class_number, g.order) for g in assur_groups(6))
    assert six == {(3, 4): 1, (4, 2): 2, (4, 3): 3, (5, 2): 2, (5, 3): 1, (6, 3): 1}


def longest_relevant_loop(chain):
    """By networkx's minimum cycle basis on links and joints."""
    basis = nx.minimum_cycle_basis(nx.convert_node_labels_to_integers(chain.incidence_graph()))
    return max((len(cycle) // 2 for cycle in basis), default=0)


@pytest.mark.parametrize("links", [4, 6, 8])
def test_contours_against_networkx(links):
    for group in assur_groups(links):
        inner = Counter(k for j in group.joints if not j.outer for k in j.links)
        assert group.class_number == max(2, *inner.values(), longest_relevant_loop(group.chain))


@pytest.mark.parametrize(
    ("text", "form", "german", "number", "order"),
    [
        *((dyad, dyad, dyad.replace("R", "D").replace("P", "S"), 2, 2) for dyad in DYADS),
        ("PRR", "RRP", "DDS", 2, 2),
        ("PPR", "RPP", "DSS", 2, 2),
        ("W(a-1) R(1-2) R(2-b)", "RRW", "DDW", 2, 2),
        ("R(a-1) G(1-b)", "RG", "DG", 2, 2),
        ("P(a-1) G(1-b)", "PG", "SG", 2, 2),
        ("G(a-1) G(b-1) G(c-1)", "GGG", "GGG", 3, 3),
        ("R(a-1) G(1-2) G(1-2) R(2-b)", "R-GG-R", "D-GG-D", 4, 2),
        ("R(a-1) R(1-2) R(2-3) R(3-b) R(2-4) R(4-c)", "3-RR", "3-DD", 3, 3),
        ("R(a-1) P(1-2) R(2-3) R(3-b) R(2-4) R(4-c)", "2-RR+RP", "2-DD+DS", 3, 3),
        ("R(a-1) R(1-2) R(2-3) R(3-b) G(2-c)", "2-RR+G", "2-DD+G", 3, 3),
    ],
)
def test_forms(text, form, german, number, order):
    group = AssurGroup.parse(text)
    assert (group.form, group.named("german"), group.class_number, group.order) == (form, german, number, order)


def test_other_groups_go_by_their_code():
    tetrad = AssurGroup.parse(TETRAD)
    assert tetrad.form == tetrad.code
    assert AssurGroup.parse(tetrad.code).code == tetrad.code
    shared = AssurGroup.parse(SHARED)
    assert shared.form == shared.code
    assert shared.order == 4


@pytest.mark.parametrize("text", [*DYADS, TETRAD, "R(x-7) G(7-y)", SHARED])
def test_the_canonical_form_is_the_same_group_and_stays(text):
    group = AssurGroup.parse(text)
    other = group.canonical()
    assert other.code == group.code
    assert other.canonical() == other
    assert AssurGroup.parse(str(other)) == other
    assert set(other.places).isdisjoint(map(str, range(10)))
    assert set(other.links) == {str(k + 1) for k in range(len(group.links))}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("P(a-1) P(1-2) P(2-b)", "not rigid"),
        ("R(a-1) R(1-2) R(2-3) R(3-b)", "9 freedoms, but the joints remove 8"),
        ("R(a-1) R(1-2) R(2-b) R(1-3) R(3-4) R(4-c)", "the links 1, 2 can be solved without the others"),
        ("R(a-1) R(1-2) R(2-3) R(3-1) R(3-4) R(4-b)", "can be solved without the others"),
        ("R(0-1) R(1-2) R(2-0)", "no outer joints"),
        ("R(a-b-1) R(1-2) R(2-c)", "more than one place"),
        ("spherical: R(a-1) R(1-2) R(2-b)", "spherical"),
    ],
)
def test_what_is_no_group_is_refused(text, words):
    with pytest.raises(AssurError, match=words):
        AssurGroup.parse(text)


@pytest.mark.parametrize("links", [-2, 0, 1, 7])
def test_groups_have_an_even_number_of_links(links):
    with pytest.raises(AssurError, match=r"2, 4, 6"):
        list(assur_groups(links))


def test_roman_figures():
    assert ", ".join(roman(k) for k in range(1, 15)) == "I, II, III, IV, V, VI, VII, VIII, IX, X, XI, XII, XIII, XIV"
