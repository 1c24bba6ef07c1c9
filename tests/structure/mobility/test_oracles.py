"""Slow and obvious methods by another hand, against the report."""

import dataclasses
from fractions import Fraction
from itertools import combinations, pairwise
from random import Random

import networkx as nx
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gruebler import Chain
from gruebler.base.errors import ChainError
from gruebler.structure.mobility import (
    counted,
    generic,
    generic_mobility,
    mobility_report,
    overconstrained,
    prime_field,
)
from gruebler.structure.mobility.idle import IdleCondition
from tests.strategies import PLANAR, SPATIAL, SPHERICAL, chains
from tests.structure.mobility import slow_circuits

ATLAS = [g for g in nx.graph_atlas_g() if g.number_of_nodes() >= 3 and nx.is_connected(g)]


def rank(rows):
    """Plain Gauss elimination over the rationals."""
    rows = [[Fraction(v) for v in row] for row in rows]
    done = 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((i for i in range(done, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[done], rows[pivot] = rows[pivot], rows[done]
        for i in range(done + 1, len(rows)):
            factor = rows[i][column] / rows[done][column]
            if factor:
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[done], strict=True)]
        done += 1
    return done


def constraints(joints, links, seed):
    """Planar constraint rows written down afresh: integers as coordinates, twists (turn, shift x, shift y)."""
    random = Random(seed)
    place = {link: 3 * k for k, link in enumerate(links)}
    rows = []

    def row(a, b, functional):
        out = [0] * (3 * len(links))
        for k in range(3):
            out[place[a] + k] += functional[k]
            out[place[b] + k] -= functional[k]
        rows.append(out)

    for name, ends in joints:
        x, y, p, q = (random.randrange(-(10**6), 10**6) for _ in range(4))
        functionals = {
            "revolute": [(-y, 1, 0), (x, 0, 1)],
            "rolling": [(-y, 1, 0), (x, 0, 1)],
            "prismatic": [(1, 0, 0), (0, p, q)],
            "roll_slide": [(x * q - y * p, p, q)],
            "double_slide": [(1, 0, 0)],
        }[name]
        for a, b in pairwise(ends):
            for functional in functionals:
                row(a, b, functional)
    return rows


def redundancy(chain, links):
    joints = [(j.pair.name, [link for link in j.links if link in links]) for j in chain.joints]
    rows = constraints([j for j in joints if len(j[1]) > 1], links, seed=len(links))
    return len(rows) - rank(rows)


@given(chains(pairs=PLANAR, most_links=6))
@settings(max_examples=50)
def test_overconstrained_subchains_against_all_link_subsets(chain):
    minimal = []
    for size in range(2, chain.n + 1):
        for links in combinations(chain.links, size):
            if not any(set(found) <= set(links) for found, _ in minimal) and (r := redundancy(chain, links)):
                minimal.append((links, r))
    report = mobility_report(chain)
    assert all(part.minimal for part in report.overconstrained)
    assert sorted((part.links, part.redundancy) for part in report.overconstrained) == sorted(minimal)
    assert report.redundancy == redundancy(chain, chain.links)


def bars_held_by_no_set_in_excess(graph):
    """The largest set of joints no subset of links of which holds more than it may, grown joint by joint."""
    kept = nx.MultiGraph()
    kept.add_nodes_from(graph)
    bars = 0
    for edge in graph.edges:
        for _ in range(2):  # a turning pair is worth two bars
            kept.add_edge(*edge)
            if all(
                kept.subgraph(links).number_of_edges() <= 3 * (len(links) - 1)
                for size in range(2, len(graph) + 1)
                for links in combinations(graph, size)
                if set(edge) <= set(links)
            ):
                bars += 1
            else:
                kept.remove_edge(*edge)
    return bars


@pytest.mark.parametrize("size", range(3, 7))
def test_mobility_of_all_connected_graphs_against_all_link_subsets(size):
    """By Tay's theorem the bars that no subset of links holds in excess are the rank."""
    for graph in (g for g in ATLAS if len(g) == size):
        chain = Chain.from_edges(graph.edges)
        assert generic_mobility(chain) == 3 * (size - 1) - bars_held_by_no_set_in_excess(graph), graph.edges


@pytest.mark.parametrize("size", [*range(3, 7), pytest.param(7, marks=pytest.mark.slow)])
def test_soundness_of_all_connected_graphs_against_all_link_subsets(size):
    """Nothing is redundant exactly if every set of links has a count of at least 0; the minimal others are named."""
    for graph in (g for g in ATLAS if len(g) == size):
        joints = [1 << a | 1 << b for a, b in graph.edges]
        counts = {
            links: 3 * (links.bit_count() - 1) - 2 * sum(joint & links == joint for joint in joints)
            for links in range(1, 1 << size)
            if links.bit_count() > 1
        }
        least = min(counts.values())
        report = mobility_report(Chain.from_edges(graph.edges))
        assert (report.redundancy == 0) == (least >= 0)
        assert report.counted == counts[(1 << size) - 1]
        bad = [links for links, count in counts.items() if count < 0]
        worst = {(s, -counts[s]) for s in bad if not any(t != s and s & t == t for t in bad)}
        named = {(sum(1 << int(link) for link in p.links), p.redundancy) for p in report.overconstrained if p.minimal}
        assert named == worst if all(p.minimal for p in report.overconstrained) else named <= worst
        if least >= 0:
            tight = [links for links, count in counts.items() if count == 0]
            maximal = [s for s in tight if not any(s != t and s & t == s for t in tight)]
            found = [sum(1 << int(link) for link in cluster) for cluster in report.rigid_clusters]
            assert sorted(found) == sorted(maximal)


def test_immobile_joints_by_locking_them():
    """A joint that cannot move takes no mobility away when it is welded."""
    judged = 0
    for graph in (g for g in ATLAS if len(g) == 6):
        chain = Chain.from_edges(graph.edges)
        immobile = set(mobility_report(chain).immobile_joints)
        for number, joint in enumerate(chain.joints):
            a, b = joint.links
            welded = [[a if link == b else link for link in j.links] for j in chain.joints]
            merged = [("revolute", links) for links in welded if links[0] != links[1]]
            try:
                still = generic_mobility(Chain(merged))
            except ChainError:
                continue
            assert (still == generic_mobility(chain)) == (number in immobile)
            judged += 1
    assert judged > 500


def test_counts_by_hand():
    assert counted(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")) == 1
    assert counted(Chain.parse("spatial: R(0-1) H(1-2) P(2-0)"), b=2) == 1
    with pytest.raises(ChainError, match=r"f = 2, which leaves nothing"):
        counted(Chain.parse("spatial: R(0-1) C(1-2) P(2-0)"), b=2)
    with pytest.raises(ChainError, match=r"1 to 6, not 7"):
        counted(Chain.parse("R(0-1) R(1-2) R(2-0)"), b=7)


ANY = st.one_of(
    chains(pairs=PLANAR, most_links=12),
    chains(pairs=SPHERICAL, space="spherical"),
    chains(pairs=SPATIAL, space="spatial", most_links=7),
)


@given(ANY)
@settings(max_examples=60)
def test_circuits_and_clusters_against_whole_bases(chain):
    rank = generic(chain)
    fast = [dataclasses.astuple(part) for part in overconstrained(rank)]
    assert fast == slow_circuits.supports(rank)
    assert rank.clusters == slow_circuits.clusters(rank)


@pytest.mark.parametrize("limit", ["_DENSE_BASIS", "_SPARSE_STEPS"])
@given(chains(pairs=PLANAR, most_links=9))
@settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_circuits_with_a_sparse_basis_and_without_any(monkeypatch, limit, chain):
    """A sparse basis changes nothing; without a basis parts may stay together, but nothing is lost or invented."""
    rank = generic(chain)
    slow = slow_circuits.supports(rank)
    monkeypatch.setattr(prime_field, "_DENSE_BASIS", -1)
    if limit == "_DENSE_BASIS":
        assert [dataclasses.astuple(part) for part in overconstrained(rank)] == slow
        return
    monkeypatch.setattr(prime_field, "_SPARSE_STEPS", -1)
    found = overconstrained(rank)
    assert sum(part.redundancy for part in found) == rank.redundancy
    links, joints = slow_circuits.loaded(rank)
    assert {link for part in found for link in part.links} == links
    assert {joint for part in found for joint in part.joints} == joints
    for part in found:
        inside = [one for one in slow if set(one[0]) <= set(part.links) and set(one[1]) <= set(part.joints)]
        assert inside
        if part.minimal:
            assert dataclasses.astuple(part) in slow


@given(ANY)
@settings(max_examples=60)
def test_idle_freedoms_by_the_rank_of_all_constraints_of_a_link(chain):
    functionals = generic(chain).placement.functionals
    idle = mobility_report(chain).idle_freedoms
    always = {f.links[0]: f.freedoms for f in idle if f.when is IdleCondition.ALWAYS and len(f.links) == 1}
    for link in chain.links[1:]:  # the first one is the frame
        mine = [k for k, joint in enumerate(chain.joints) if link in joint.links]
        rows = [dict(enumerate(f)) for k in mine for f in functionals[k]]
        left = chain.space.b - prime_field.echelon(rows, chain.space.b).rank
        assert always.get(link, 0) == (left if len(mine) > 1 else 0)
