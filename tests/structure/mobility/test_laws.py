"""Laws of mobility, and the roads to it set against each other."""

import networkx as nx
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from gruebler import Chain
from gruebler.base.errors import ChainError
from gruebler.structure.isomorphism import find_isomorphism
from gruebler.structure.mobility import (
    counted,
    generic,
    generic_mobility,
    mobility_report,
    overconstrained,
    pebble_mobility,
    theorem,
)
from tests.strategies import LICENSED, PLANAR, REVOLUTE, SPATIAL, SPHERICAL, chains, renumbered

ANY = st.one_of(
    chains(pairs=PLANAR),
    chains(pairs=SPHERICAL, space="spherical"),
    chains(pairs=SPATIAL, space="spatial", most_links=6),
)


@given(ANY)
def test_generic_is_at_least_counted_and_the_difference_is_the_redundancy(chain):
    rank = generic(chain)
    assert rank.mobility == counted(chain) + rank.redundancy
    assert rank.redundancy >= 0
    assert rank.mobility >= max(counted(chain), 0)


@given(ANY, st.data())
def test_mobility_is_blind_to_numbering(chain, data):
    other = data.draw(renumbered(chain))
    one, two = mobility_report(chain), mobility_report(other)
    assert (one.counted, one.generic, one.verdict) == (two.counted, two.generic, two.verdict)
    names = find_isomorphism(chain, other)
    assert names is not None
    assert sorted((len(p.links), len(p.joints), p.redundancy) for p in one.overconstrained) == sorted(
        (len(p.links), len(p.joints), p.redundancy) for p in two.overconstrained
    )
    assert sorted(map(len, one.rigid_clusters)) == sorted(map(len, two.rigid_clusters))
    assert len(one.immobile_joints) == len(two.immobile_joints)


@given(chains(pairs=LICENSED))
def test_pebble_game_on_points_agrees_with_the_rank_in_the_plane(chain):
    assert theorem(chain).points
    assert pebble_mobility(chain, points=True) == generic_mobility(chain)


@given(chains(pairs=LICENSED, multiple=False))
def test_pebble_game_on_bodies_agrees_with_the_rank_in_the_plane(chain):
    assert pebble_mobility(chain, points=False) == pebble_mobility(chain, points=True) == generic_mobility(chain)


@given(chains(pairs=SPHERICAL, space="spherical"))
def test_pebble_game_agrees_with_the_rank_on_the_sphere(chain):
    assert pebble_mobility(chain) == generic_mobility(chain)


@given(chains(pairs=("revolute", "revolute", "ball_plane"), space="spatial", multiple=False))
def test_pebble_game_agrees_with_the_rank_in_space(chain):
    assert pebble_mobility(chain) == generic_mobility(chain)


@given(chains(pairs=("revolute", "prismatic", "double_slide")))
def test_the_pebble_game_never_guesses(chain):
    assume(any(j.pair.name != "revolute" for j in chain.joints))
    assert not theorem(chain)
    with pytest.raises(ChainError, match=r"no theorem covers"):
        pebble_mobility(chain)


def test_one_theorem_is_enough():
    """With a multiple joint in the plane that of points (Laman) holds, and none of bodies."""
    licence = theorem(Chain.parse("R(0-1-2) R(1-3) R(2-3) R(0-3)"))
    assert (licence.bodies, licence.points, bool(licence)) == (False, True, True)


def test_multiple_joints_in_space_are_refused_by_the_pebble_game():
    chain = Chain.parse("spatial: R(a-b-c) R(a-d) R(b-d)")
    with pytest.raises(ChainError, match=r"multiple joints in space"):
        pebble_mobility(chain)


@given(ANY, st.data())
def test_removing_a_joint_never_lowers_generic_mobility(chain, data):
    number = data.draw(st.integers(0, len(chain.joints) - 1))
    try:
        less = chain.without_joint(number)
    except ChainError:
        assume(False)
    assert generic_mobility(less) >= generic_mobility(chain)


@given(chains(pairs=REVOLUTE), st.data())
def test_a_further_joint_never_raises_it(chain, data):
    links = data.draw(st.lists(st.sampled_from(chain.links), min_size=2, max_size=2, unique=True))
    assert generic_mobility(chain.with_joint("revolute", links)) <= generic_mobility(chain)


BRACED = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-2) R(3-4) R(4-5) R(5-0)")


def alone(chain):
    """The overconstrained subchains of a chain, each with the chain that it makes alone, if it makes one."""
    parts = [(part, induced(chain, part.links)) for part in mobility_report(chain).overconstrained]
    return [(part, inner) for part, inner in parts if inner is not None]


def test_an_overconstrained_subchain_is_there():
    assert [(part.redundancy, inner.n, len(part.joints)) for part, inner in alone(BRACED)] == [(1, 4, 5)]


@given(chains(pairs=PLANAR))
@example(BRACED)
@settings(max_examples=60)
def test_what_is_said_to_mend_mends(chain):
    """Take the joint out of the subchain alone: nothing is redundant in it any more."""
    for part, inner in alone(chain):
        assert generic(inner).redundancy == part.redundancy
        for number in part.joints:
            joint = chain.joints[number]
            kept = [link for link in joint.links if link in part.links]
            position = next(k for k, j in enumerate(inner.joints) if j.pair == joint.pair and set(j.links) == set(kept))
            try:
                after = generic(inner.without_joint(position)).redundancy
            except ChainError:
                continue
            assert (after == 0) == (number in part.resolved_by_removing)


def induced(chain, links):
    """The subchain on these links, or None where they alone are not a chain (two links, several parts)."""
    joints = [(j.pair, [link for link in j.links if link in links]) for j in chain.joints]
    try:
        return Chain([j for j in joints if len(j[1]) > 1], links=links, space=chain.space)
    except ChainError:
        return None


def test_uncertain_answers_say_so_and_certain_ones_are_proved():
    sliders = mobility_report(Chain.parse("P(0-1) P(1-2) P(2-3) P(3-0)"))
    assert (sliders.counted, sliders.generic, sliders.exact) == (1, 2, False)
    assert 0 < sliders.error_bound < 1e-12
    assert mobility_report(Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)")).exact
    assert mobility_report(Chain.parse("g6:C~")).exact


def test_a_joint_with_just_as_many_constraints_as_are_redundant_resolves_them():
    """31 triangles on the frame need nothing more; 62 constraints of one joint of all are redundant, and no others."""
    triangles = " ".join(f"R(0-a{k}) R(a{k}-b{k}) R(b{k}-0)" for k in range(31))
    everywhere = "R(0-" + "-".join(f"a{k}" for k in range(31)) + ")"
    assert generic(Chain.parse(triangles)).redundancy == 0
    chain = Chain.parse(f"{triangles} {everywhere}")
    (part,) = overconstrained(generic(chain))
    assert (part.redundancy, part.minimal, len(part.joints)) == (62, False, len(chain.joints))
    assert part.resolved_by_removing == (len(chain.joints) - 1,)


@pytest.mark.parametrize("size", [200, 400])
def test_large_chains_are_answered_and_their_circuit_is_found(size):
    ring = nx.cycle_graph(size)
    ring.add_edges_from([(0, 2), (1, 3)])  # the links 0, 1, 2, 3 are braced once too often
    report = mobility_report(Chain.from_edges(ring.edges))
    assert report.generic == counted(report.chain) + 1
    assert [set(part.links) for part in report.overconstrained] == [{"0", "1", "2", "3"}]
    assert [set(cluster) for cluster in report.rigid_clusters] == [{"0", "1", "2", "3"}]
    assert overconstrained(generic(report.chain)) == report.overconstrained


@given(chains(pairs=REVOLUTE, multiple=False))
@example(BRACED)
@settings(max_examples=60)
def test_one_more_freedom_mends_where_it_is_said_to(chain):
    """Turn a revolute of the subchain into a roll-slide joint, which has one freedom more."""
    for part, inner in alone(chain):
        for number in part.joints:
            joint = chain.joints[number]
            position = next(k for k, j in enumerate(inner.joints) if set(j.links) == set(joint.links))
            freed = [("roll_slide" if k == position else j.pair, j.links) for k, j in enumerate(inner.joints)]
            after = generic(Chain(freed, links=inner.links)).redundancy
            assert (after == 0) == (number in part.resolved_by_freeing)
