"""Epicyclic trains against printed numbers, against counting without symmetries and against their own speeds."""

import json
from dataclasses import replace
from itertools import combinations
from random import Random

import networkx as nx
import numpy as np
import pytest

from gruebler.base.errors import GrueblerError
from gruebler.cli import main
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration.epicyclic import (
    EpicyclicCount,
    _free_sets,
    _symmetries,
    _triples,
    count_epicyclic_trains,
    epicyclic_trains,
    hypertrees,
)
from gruebler.structure.isomorphism import code
from tests.structure.enumeration.train_oracle import count_by_speeds, link_axis_trees


@pytest.mark.parametrize(
    ("links", "displacement", "rotation"),
    [(3, 1, 1), (4, 3, 2), (5, 13, 6), (6, 81, 27)],
)
def test_small_trains(links, displacement, rotation):
    assert count_epicyclic_trains(links) == EpicyclicCount(displacement, rotation)


@pytest.mark.parametrize(
    ("links", "mobility", "displacement", "rotation"),
    [
        (5, 2, 7, 3),
        (6, 2, 45, 12),
        (6, 3, 6, 1),
        (7, 1, 647, 152),
        pytest.param(7, 2, 441, 81, marks=pytest.mark.slow),
        (7, 3, 103, 13),
        pytest.param(8, 1, 6360, 1070, marks=pytest.mark.slow),
        pytest.param(8, 2, 4361, 559, marks=pytest.mark.slow),
        pytest.param(8, 3, 1289, 103, marks=pytest.mark.slow),
    ],
)
def test_numbers_of_the_table_by_two_methods(links, mobility, displacement, rotation):
    """F = 1 with six to eight links is in print: Yang, Ding et al., J. Mech. Des. 141(4) 043301 (2019)."""
    assert count_epicyclic_trains(links, mobility) == EpicyclicCount(displacement, rotation)
    assert count_by_speeds(links, mobility) == (displacement, rotation)


@pytest.mark.slow
def test_nine_links():
    """The print has 71,837 and 8,654; docs/theory/epicyclic-trains.md."""
    assert count_epicyclic_trains(9) == EpicyclicCount(71833, 8652)


def test_hypertrees_are_the_connected_graphs_whose_blocks_are_complete():
    counts = dict.fromkeys(range(2, 8), 0)
    for graph in nx.graph_atlas_g():
        if 2 <= len(graph) <= 7 and nx.is_connected(graph):
            blocks = [graph.subgraph(block) for block in nx.biconnected_components(graph)]
            counts[len(graph)] += all(b.number_of_edges() == len(b) * (len(b) - 1) // 2 for b in blocks)
    assert {n: len(hypertrees(n)) for n in counts} == counts
    assert {n: sum(1 for _ in link_axis_trees(n)) for n in counts} == counts


def speeds_of(links, gears, random):
    """The rank of the equations with random tooth numbers, and a basis of the speeds: (rows, links)."""
    rows = []
    for a, b, carrier in gears:
        one, other = random.uniform(0.2, 2), random.uniform(0.2, 2)
        row = [0.0] * links
        row[a], row[b], row[carrier] = one, other, -one - other
        rows.append(row)
    _, values, vectors = np.linalg.svd(np.array(rows))
    rank = int((values > 1e-9 * values[0]).sum())
    return rank, vectors[rank:]


def is_free(links, gears, random):
    """Independent equations, and no part of three or more links that turn alike."""
    rank, basis = speeds_of(links, gears, random)
    alike = any(np.allclose(basis[:, a], basis[:, b], atol=1e-9) for a, b in combinations(range(links), 2))
    return rank == len(gears) and not alike


@pytest.mark.parametrize(("links", "mobility"), [(4, 1), (5, 1), (5, 2), (6, 2), (6, 3)])
def test_all_sets_of_pairs_judged_by_their_speeds(links, mobility):
    """Every set of pairs on every hypertree, kept if its own equations leave it free; equal ones by their codes."""
    random, codes = Random(1), set()
    trains = list(epicyclic_trains(links, mobility))
    for axes in hypertrees(links):
        for gears in combinations(_triples(links, axes), links - 1 - mobility):
            if len({v for gear in gears for v in gear}) == links and is_free(links, gears, random):
                codes.add(code(replace(trains[0], axes=axes, gears=gears).chain()))
    own = [code(train.chain()) for train in trains]
    assert len(own) == len(set(own))
    assert set(own) == codes


def labelled_sets(links, triples, pairs):
    """How many sets of pairs have no locked part, without symmetries: triples added in ascending order."""
    parts = [set(part) for size in range(3, links + 1) for part in combinations(range(links), size)]
    inside = np.array([[set(triple) <= part for part in parts] for triple in triples])
    limit = np.array([len(part) - 2 for part in parts])
    level = [(0, np.zeros(len(parts), int))]
    for _ in range(pairs):
        level = [
            (k + 1, count + inside[k])
            for start, count in level
            for k in range(start, len(triples))
            if (count + inside[k] <= limit).all()
        ]
    return len(level)


@pytest.mark.parametrize("links", [4, 5, 6])
def test_orbits_have_together_all_sets(links):
    for axes in hypertrees(links):
        triples = _triples(links, axes)
        symmetries = _symmetries(links, axes, triples)
        total = 0
        for mask in _free_sets(links, triples, symmetries, links - 2):
            images = {sum(1 << int(row[k]) for k in range(len(triples)) if mask >> k & 1) for row in symmetries}
            total += len(images)
        assert total == labelled_sets(links, triples, links - 2)


def test_the_planetary_train_is_one_of_four_links():
    chains = {code(train.chain()) for train in epicyclic_trains(4)}
    assert code(Chain.parse("R(sun-ring-arm) R(arm-planet) G(sun-planet) G(planet-ring)")) in chains


@pytest.mark.parametrize(("links", "mobility", "words"), [(2, 1, "3 to"), (40, 1, "3 to"), (5, 0, "at least 1")])
def test_wrong_sizes_are_one_sentence(links, mobility, words):
    with pytest.raises(GrueblerError, match=words):
        list(epicyclic_trains(links, mobility))


def test_more_mobility_than_pairs():
    assert list(epicyclic_trains(4, 3)) == []


def test_the_command_lists_what_check_reads(tmp_path, capsys):
    path = tmp_path / "trains.txt"
    assert main(["enumerate", "--links", "5", "--trains", "-o", str(path)]) == 0
    assert len(path.read_text().splitlines()) == 13
    assert main(["check", "--json", *path.read_text().splitlines()]) == 0
    reports = json.loads(capsys.readouterr().out)
    assert [(report["counted"], report["generic"]) for report in reports] == [(1, 1)] * 13
    assert main(["enumerate", "--links", "5", "--trains", "--count"]) == 0
    assert capsys.readouterr().out == "displacement graphs: 13\nrotation graphs: 6\n"
    assert main(["enumerate", "--links", "4", "--trains", "--json"]) == 0
    first = json.loads(capsys.readouterr().out)[0]
    assert str(Chain.parse(first["chain"])) == first["chain"]
    assert {pair["carrier"] for pair in first["gears"]} <= set(range(4))


@pytest.mark.parametrize("words", ["--orbits", "--multiple-joints any", "--format graph6", "--assortment 4,2"])
def test_other_options_do_not_go_with_trains(words, capsys):
    assert main(["enumerate", "--links", "5", "--trains", *words.split()]) == 2
    assert "--trains" in capsys.readouterr().err or "graph6" in words


def test_links_that_no_option_allows_are_not_offered(capsys):
    assert main(["enumerate", "--links", "11", "--trains"]) == 2
    assert "listed for 3 to 10 links" in capsys.readouterr().err
