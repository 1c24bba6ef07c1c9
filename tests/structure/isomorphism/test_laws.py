"""The code is equal exactly for chains of one structure; networkx and igraph are the judges."""

from itertools import permutations
from math import factorial

import networkx as nx
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from networkx.algorithms.isomorphism import categorical_node_match

from gruebler import Chain
from gruebler.base.errors import ChainError, NotationError
from gruebler.structure.isomorphism import CODE_PREFIX, code, decode, find_isomorphism, is_isomorphic, symmetry
from tests.strategies import PLANAR, SPATIAL, chains, renumbered

ANY = st.one_of(chains(pairs=PLANAR), chains(pairs=("revolute",)), chains(pairs=SPATIAL, space="spatial"))
SMALL = chains(pairs=("revolute", "prismatic"), most_links=5)


def same_by_networkx(one, other):
    match = categorical_node_match(["kind", "pair"], [None, None])
    return one.space == other.space and nx.is_isomorphic(one.incidence_graph(), other.incidence_graph(), match)


def respects(one, other, found):
    """Whether the witness sends every joint to one with the same pair and the corresponding links."""
    return (
        sorted(found.links) == sorted(one.links)
        and sorted(found.links.values()) == sorted(other.links)
        and sorted(found.joints) == list(range(len(other.joints)))
        and all(
            joint.pair == other.joints[found.joints[k]].pair
            and {found.links[link] for link in joint.links} == set(other.joints[found.joints[k]].links)
            for k, joint in enumerate(one.joints)
        )
    )


@given(ANY, st.data())
def test_code_is_blind_to_numbering_and_the_correspondence_is_one(chain, data):
    other = data.draw(renumbered(chain))
    assert code(chain) == code(other)
    found = find_isomorphism(chain, other)
    assert found is not None
    assert respects(chain, other, found)


@given(SMALL, SMALL)
@settings(max_examples=150)
def test_equal_codes_exactly_if_isomorphic(one, other):
    same = same_by_networkx(one, other)
    assert (code(one) == code(other)) == is_isomorphic(one, other) == same


@given(ANY)
def test_a_code_is_decoded_to_the_same_structure_and_coded_again(chain):
    text = code(chain)
    assert text.startswith(CODE_PREFIX)
    back = decode(text)
    assert back.frame is None
    assert back.drives == ()
    assert same_by_networkx(back.chain, chain)
    assert code(back.chain) == text


@given(ANY, st.data())
def test_marks_belong_to_the_structure(chain, data):
    frame = data.draw(st.sampled_from(chain.links))
    drives = data.draw(st.sets(st.integers(0, len(chain.joints) - 1), max_size=2))
    other = data.draw(renumbered(chain))
    names = find_isomorphism(chain, other)
    text = code(chain, frame=frame, drives=drives)
    assert text == code(other, frame=names.links[frame], drives={names.joints[k] for k in drives})
    back = decode(text)
    assert code(back.chain, frame=back.frame, drives=back.drives) == text
    assert len(back.drives) == len(drives)
    alike = next(orbit for orbit in symmetry(chain).link_orbits if frame in orbit)
    same = {link for link in chain.links if code(chain, frame=link) == code(chain, frame=frame)}
    assert same == set(alike)


def automorphisms_by_permutations(chain):
    """All pairs of a link permutation and a joint permutation that keep the chain."""
    joints = [(j.pair.name, frozenset(map(chain.index, j.links))) for j in chain.joints]
    found = []
    for links in permutations(range(chain.n)):
        images = [(name, frozenset(links[i] for i in ends)) for name, ends in joints]
        if sorted(images, key=str) != sorted(joints, key=str):
            continue
        found += [
            (links, order)
            for order in permutations(range(len(joints)))
            if all(joints[order[k]] == images[k] for k in range(len(joints)))
        ]
    return found


@given(chains(pairs=("revolute", "prismatic"), most_links=4))
@settings(max_examples=40)
def test_symmetry_against_all_permutations(chain):
    assume(len(chain.joints) <= 6)
    every = automorphisms_by_permutations(chain)
    found = symmetry(chain)
    assert found.order == len(every)
    assert {(g.links, g.joints) for g in found.generators} <= set(every)

    def orbits(items, act):
        return {frozenset(act(a, item) for a in every) for item in items}

    assert {frozenset(map(chain.index, o)) for o in found.link_orbits} == orbits(range(chain.n), lambda a, i: a[0][i])
    assert {frozenset(o) for o in found.joint_orbits} == orbits(range(len(chain.joints)), lambda a, k: a[1][k])
    flags = [(chain.index(link), k) for k, joint in enumerate(chain.joints) for link in joint.links]
    assert {frozenset((chain.index(i), k) for i, k in o) for o in found.flag_orbits} == orbits(
        flags, lambda a, f: (a[0][f[0]], a[1][f[1]])
    )


ATLAS = [g for g in nx.graph_atlas_g() if g.number_of_nodes() >= 3 and nx.is_connected(g)]


def test_all_connected_graphs_of_seven_links_have_different_codes():
    codes = {code(Chain.from_edges(graph.edges)) for graph in ATLAS}
    assert len(codes) == len(ATLAS)


@pytest.mark.parametrize(
    ("graph", "order"),
    [
        (nx.petersen_graph(), 120),
        (nx.complete_bipartite_graph(2, 40), 2 * factorial(40)),
        (nx.circular_ladder_graph(50), 200),
        (nx.cycle_graph(300), 600),
        (nx.hypercube_graph(5), 3840),
        (nx.complete_graph(12), factorial(12)),
    ],
)
def test_highly_symmetric_chains(graph, order):
    chain = Chain.from_edges(nx.convert_node_labels_to_integers(graph).edges)
    assert symmetry(chain).order == order


@pytest.mark.parametrize("strings", [7, 12])
def test_theta_chains(strings):
    """Two links joined by strings of two binary links each: 2 k! automorphisms."""
    edges = [(a, b) for k in range(strings) for a, b in ((0, 2 + 2 * k), (2 + 2 * k, 3 + 2 * k), (3 + 2 * k, 1))]
    chain = Chain.from_edges(edges)
    found = symmetry(chain)
    assert found.order == 2 * factorial(strings)
    assert len(found.link_orbits) == 2


def test_multiple_and_parallel_joints_are_told_apart():
    triple = Chain.parse("R(0-1-2) R(0-3) R(1-3) R(2-3)")
    pairwise = Chain.parse("R(0-1) R(1-2) R(0-3) R(1-3) R(2-3)")
    assert code(triple) != code(pairwise)
    assert symmetry(triple).order == 6
    twice = Chain.parse("R(0-1) R(0-1) R(1-2) R(2-0)")
    assert symmetry(twice).order == 4
    assert code(twice) != code(Chain.parse("R(0-1) P(0-1) R(1-2) R(2-0)"))
    assert code(Chain.parse("spherical: R(0-1) R(1-2) R(2-0)")) != code(Chain.parse("R(0-1) R(1-2) R(2-0)"))


@pytest.mark.parametrize(
    "text",
    [
        "R(0-1)R(1-2)R(2-0)",
        "gr0:R(0-1)R(1-2)R(2-0)",
        "gr2:R(0-1)R(1-2)R(2-0)",
        "gr1:R(a-b)R(b-c)R(c-a)",
        "gr1:R(0-1)R(1-2)R(2-0);frame=x",
        "gr1:R(0-1)R(1-2)R(2-0);drives=3",
        "gr1:R(0-1)R(1-2)R(2-0);color=3",
    ],
)
def test_what_is_no_code_is_refused(text):
    with pytest.raises(NotationError, match=r"^[^\n]+$"):
        decode(text)


def test_marks_that_do_not_exist_are_refused():
    chain = Chain.parse("R(0-1) R(1-2) R(2-0)")
    with pytest.raises(ChainError, match=r"no link '9'"):
        code(chain, frame="9")
    with pytest.raises(ChainError, match=r"joints 0 to 2"):
        code(chain, drives=[3])
    with pytest.raises(ChainError, match=r"no link '7'"):
        decode("gr1:R(0-1)R(1-2)R(2-0);frame=7")
