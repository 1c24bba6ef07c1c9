"""Contracted graphs and chains counted by other methods: sums of 1/|Aut| from generating functions, a pebble game."""

from collections import defaultdict
from fractions import Fraction
from math import factorial, prod

import pytest

from benchmarks.evidence import check_chains, sums_of_graphs
from gruebler.structure.enumeration import contracted_graphs, count_chains
from tests.structure.enumeration.mass_oracle import contracted_masses


def test_sums_over_contracted_graphs():
    sums = defaultdict(Fraction)
    for loops in range(2, 6):
        for graph in contracted_graphs(loops):
            degrees = tuple(graph.degrees.count(k) for k in range(3, max(graph.degrees) + 1))
            parallel = prod(factorial(strings) for _, _, strings in graph.bundles)
            sums[degrees] += Fraction(1, len(graph.automorphisms) * parallel)
    assert sums == contracted_masses(5)


@pytest.mark.slow
def test_sums_over_contracted_graphs_of_more_loops():
    masses = contracted_masses(7)
    sums = dict(item for loops in range(2, 8) for item in sums_of_graphs(loops)[1].items())
    assert sums == masses


@pytest.mark.slow
@pytest.mark.parametrize("links", [6, 8, 10, 12, 14])
def test_all_chains_by_pebbles(links):
    checked = list(check_chains(links, most=10**9))
    assert all(row.graphs == row.checked for row in checked)
    count = count_chains(links)
    assert {row.assortment: row.chains for row in checked if row.chains} == count.by_assortment


@pytest.mark.slow
def test_some_chains_of_eighteen_links_by_pebbles():
    checked = list(check_chains(18, most=20_000))
    assert len(checked) > 100
    assert sum(row.checked for row in checked) > 250
