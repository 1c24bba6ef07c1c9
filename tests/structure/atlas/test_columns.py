"""Every column of the atlas against another hand: igraph, networkx, and the library's own rooms for single chains."""

import random
from itertools import combinations, product
from math import prod

import igraph
import networkx as nx
import pyarrow as pa
import pyarrow.compute as pc
import pytest

import gruebler as gr
from gruebler.structure.assur import decompose
from gruebler.structure.atlas import columns_of
from gruebler.structure.atlas.chain_table import arrays_of_chains, chain_table
from gruebler.structure.atlas.mechanism_tables import bulk_tables, driven_table, mechanism_table
from gruebler.structure.atlas.parts import AtlasTask, PartWriter, _slices, parts
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration import contracted_graphs, fractionation
from gruebler.structure.isomorphism import decode
from gruebler.structure.mechanism import Mechanism
from gruebler.structure.mechanism.inversion import driven_mechanisms, family, inversions
from gruebler.structure.transformations import derive


def rows_of(tmp_path, task):
    """The rows of the chains of a task."""
    writer = PartWriter(tmp_path, task, "test")
    return [row for part in parts(task) for row in writer._chains(part).to_pylist()]


def link_graph(chain):
    """The links, and the multiple joints as vertices of their own: (graph, number of links)."""
    graph = nx.Graph()
    graph.add_nodes_from(range(chain.n))
    for number, joint in enumerate(chain.joints):
        links = [chain.index(link) for link in joint.links]
        if len(links) == 2:
            graph.add_edge(*links)
        else:
            graph.add_edges_from((("joint", number), link) for link in links)
    return graph


def automorphisms(chain):
    """All of them, as maps of links, by igraph on the graph of links and joints."""
    kinds = [0] * chain.n + [1 + (joint.pair.name == "prismatic") for joint in chain.joints]
    edges = [(chain.index(link), chain.n + k) for k, joint in enumerate(chain.joints) for link in joint.links]
    graph = igraph.Graph(len(kinds), edges)
    return graph.get_automorphisms_vf2(color=kinds)


def orbit_number(items, maps):
    graph = nx.Graph()
    graph.add_nodes_from(items)
    graph.add_edges_from((item, image(item)) for image in maps for item in items)
    return nx.number_connected_components(graph)


def crossings(graph):
    """0, 1, or None, tried on the graph itself."""
    if nx.check_planarity(graph)[0]:
        return 0
    for (a, b), (c, d) in combinations(list(graph.edges), 2):
        if len({a, b, c, d}) == 4:
            crossed = graph.copy()
            crossed.remove_edges_from([(a, b), (c, d)])
            crossed.add_edges_from(("x", v) for v in (a, b, c, d))
            if nx.check_planarity(crossed)[0]:
                return 1
    return None


def circuits(chain):
    """The numbers of links of all circuits."""
    graph = link_graph(chain)
    return [sum(isinstance(v, int) for v in cycle) for cycle in nx.simple_cycles(graph)]


def distances(chain):
    graph = nx.Graph()
    for joint in chain.joints:
        graph.add_edges_from(combinations(joint.links, 2))
    return nx.diameter(graph)


def contracted(chain):
    graph = nx.MultiGraph(tuple(joint.links) for joint in chain.joints)
    for link, degree in chain.degrees.items():
        if degree == 2:
            ends = [other for _, other in graph.edges(link)]
            graph.remove_node(link)
            graph.add_edge(*ends)
    return graph


def grows_by_dyads(chain):
    growth = derive(chain)
    assert growth.exact
    return growth.from_loop


def check(row, *, dyads=True):
    """Every column of a row, from its code alone."""
    chain = decode(row["code"]).chain
    n, simple = chain.n, not chain.multiple_joints
    assert gr.code(chain) == row["code"]
    assert n == row["links"]
    assert gr.mobility_report(chain).generic == row["mobility"]
    assert row["loops"] == sum(joint.count for joint in chain.joints) - n + 1
    assert row["joints"] == len(chain.joints)
    assert row["multiple_joints"] == len(chain.multiple_joints)
    assert row["prismatic"] == sum(joint.pair.name == "prismatic" for joint in chain.joints)
    assert row["fractionated"] == fractionation(chain)
    degrees = list(chain.degrees.values())
    assert row["assortment"] == ",".join(str(degrees.count(k)) for k in range(2, max(degrees) + 1))
    if simple and not row["prismatic"]:
        assert gr.code(Chain.from_graph6(row["graph6"])) == row["code"]
        assert {frozenset(j.links) for j in Chain.from_graph6(row["graph6"]).joints} == {
            frozenset(j.links) for j in chain.joints
        }
        assert len(row["certificate"]) == len(chain.joints)
        for digit in "012":
            rest = [j.links for j, class_ in zip(chain.joints, row["certificate"], strict=True) if class_ != digit]
            assert nx.is_forest(nx.Graph(rest))
    else:
        assert row["graph6"] is row["certificate"] is None
    if simple and row["fractionated"] == "none" and row["loops"] > 1:
        number = row["contracted_graph"]
        graph = next(g for k, g in enumerate(contracted_graphs(row["loops"])) if k == number)
        assert nx.is_isomorphic(graph.multigraph(), contracted(chain))
        bundles = [(*map(int, part.split("x")[0].split("-")), int((part + "x1").split("x")[1])) for part in
                   row["contracted_code"].split()]  # fmt: skip
        assert tuple(bundles) == graph.bundles
    else:
        assert row["contracted_graph"] is row["contracted_code"] is None
    maps = automorphisms(chain)
    assert row["group_order"] == len(maps)
    assert row["inversions"] == orbit_number(range(n), [m.__getitem__ for m in maps])
    joints = range(n, n + len(chain.joints))
    assert row["joint_orbits"] == orbit_number(joints, [m.__getitem__ for m in maps])
    drives = [
        (i, n + k, j)
        for k, joint in enumerate(chain.joints)
        for i in map(chain.index, joint.links)
        for j in map(chain.index, joint.links)
        if i != j
    ]
    assert row["drives"] == orbit_number(drives, [lambda d, m=m: tuple(m[v] for v in d) for m in maps])
    least = crossings(link_graph(chain))
    assert row["crossings"] == least
    assert row["planar"] == (least == 0)
    lengths = circuits(chain)
    assert (row["smallest_circuit"], row["largest_circuit"]) == (min(lengths), max(lengths))
    assert row["diameter"] == distances(chain)
    if dyads:
        assert row["dyadic"] == grows_by_dyads(chain)


def test_all_chains_to_eight_links(tmp_path):
    rows = rows_of(tmp_path, AtlasTask(links="4-8", mobility="0-3", fractionated="all"))
    assert len(rows) == sum(
        gr.count_chains(request.links, request.mobility, fractionated="all").chains
        for request in AtlasTask(links="4-8", mobility="0-3").requests()
    )
    for row in rows:
        check(row)


@pytest.mark.parametrize(
    ("task", "number"),
    [
        (AtlasTask(links="10"), 10),
        (AtlasTask(links="9", mobility="2", fractionated="all"), 15),
        (AtlasTask(links="7", mobility="0", multiple_joints="any"), 6),
        (AtlasTask(links="8", mobility="1", multiple_joints="any"), 20),
        (AtlasTask(links="8", mobility="3", fractionated="all", multiple_joints="1-2"), 20),
        (AtlasTask(links="6", mobility="1", prismatic="1-3"), 20),
    ],
    ids=lambda value: value.command()[21:-4] if isinstance(value, AtlasTask) else "",
)
def test_random_rows(tmp_path, task, number):
    rows = rows_of(tmp_path, task)
    for row in random.Random(1).sample(rows, min(number, len(rows))):
        check(row)


@pytest.mark.slow
def test_a_thousand_rows_of_14_links(tmp_path):
    task = AtlasTask(links="14")
    writer = PartWriter(tmp_path, task, "test")
    chosen = random.Random(2)
    for part in parts(task):
        table = writer._chains(part)
        for k in chosen.sample(range(table.num_rows), min(130, table.num_rows)):
            check(table.slice(k, 1).to_pylist()[0])


def test_sums_are_the_counts_of_the_enumeration(tmp_path):
    rows = rows_of(tmp_path, AtlasTask(links="9", mobility="2", fractionated="all"))
    count = gr.count_chains(9, 2, fractionated="all", orbits=True)
    assert len(rows) == count.chains
    for name in ("inversions", "joint_orbits", "drives"):
        assert sum(row[name] for row in rows) == getattr(count, name)


def test_mechanisms_and_driven_mechanisms(tmp_path):
    rows = rows_of(tmp_path, AtlasTask(links="4-8"))
    codes = [row["code"] for row in rows]
    table = mechanism_table(codes, 1).to_pylist()
    assert len(table) == sum(row["inversions"] for row in rows)
    for row in table:
        mechanism = Mechanism(decode(row["chain"]).chain, str(row["frame"]))
        assert mechanism in inversions(mechanism.chain)
        assert row["family"] == family(mechanism)
        assert row["frame_joints"] == len(mechanism.chain.joints_of(mechanism.frame))
    by_chain = {code: sum(row["orbit"] for row in table if row["chain"] == code) for code in codes}
    assert all(total == decode(code).chain.n for code, total in by_chain.items())
    driven = driven_table(codes, 1, at_frame=True).to_pylist()
    assert len(driven) == sum(row["drives"] for row in rows)
    for row in random.Random(3).sample(driven, 30):
        chain = decode(row["chain"]).chain
        mechanism = next(
            each.mechanism
            for each in driven_mechanisms(chain)
            if each.mechanism.frame == str(row["frame"])
            and set(each.mechanism.drives[0].between) == set(row["drives"].split("-"))
        )
        groups = decompose(mechanism).groups
        assert row["groups"] == [group.shape.form for group in groups]
        assert row["classes"] == [group.shape.class_number for group in groups]
        assert row["orders"] == [group.shape.order for group in groups]
        assert row["highest_class"] == max(row["classes"])
        assert row["dyads_only"] == (row["highest_class"] == 2)
        assert row["at_frame"]
        assert row["family"] == family(mechanism)
        # Printed numbers: two intersections of circles; 6 for the triads (class III and IV); 14, 16, 18 for six links.
        printed = [{2: (2,), 4: (6,), 6: (14, 16, 18)}[len(group.bodies)] for group in groups]
        assert row["assembly_modes"] in map(prod, product(*printed))


@pytest.mark.parametrize("links", [8, pytest.param(10, marks=pytest.mark.slow)])
def test_mechanisms_in_bulk_are_those_made_one_by_one(tmp_path, links):
    task = AtlasTask(links=str(links), inversions=True, drives="frame")
    table = PartWriter(tmp_path, task, "test")._chains(next(iter(parts(task))))
    bulk = bulk_tables(table, driven=True)
    assert bulk["driven"].num_rows == sum(table["drives"].to_pylist())
    assert bulk["mechanisms"].num_rows == sum(table["inversions"].to_pylist())
    some = [k for k in range(table.num_rows) if links == 8 or k % 20 == 0]
    codes = table["code"].take(some).to_pylist()
    for name, one_by_one in (
        ("mechanisms", mechanism_table(codes, 1)),
        ("driven", driven_table(codes, 1, at_frame=True)),
    ):
        chosen = bulk[name].filter(pc.is_in(bulk[name]["chain"], pa.array(codes)))
        assert chosen.equals(one_by_one)


def test_mechanisms_in_slices_are_those_made_at_once(tmp_path, monkeypatch):
    task = AtlasTask(links="8", inversions=True, drives="frame")
    writer = PartWriter(tmp_path, task, "test")
    part = next(iter(parts(task)))
    table = writer._chains(part)
    drives = table["drives"].to_pylist()
    for size in (1, max(drives), 100):
        monkeypatch.setattr("gruebler.structure.atlas.parts._DRIVES", size)
        slices = list(_slices(table))
        assert pa.concat_tables(slices).equals(table)
        assert all(len(each) == 1 or sum(each["drives"].to_pylist()) <= size for each in slices)
        assert 1 < len(slices) <= table.num_rows
        assert writer._mechanisms(part.request, table) == bulk_tables(table, driven=True)
    assert list(_slices(table.slice(0, 0))) == []


def test_every_column_is_defined_and_filled(tmp_path):
    rows = rows_of(tmp_path, AtlasTask(links="8"))
    assert list(rows[0]) == [column.name for column in columns_of("chains")]
    assert all(column.definition and column.origin for column in columns_of("chains"))


def test_a_ring_and_its_largest_numbers():
    ring = Chain.from_edges([(i, (i + 1) % 30) for i in range(30)])
    row = chain_table(arrays_of_chains(30, 27, [ring]), "none").to_pylist()[0]
    assert (row["group_order"], row["smallest_circuit"], row["largest_circuit"]) == (60, 30, 30)
    assert (row["diameter"], row["inversions"], row["dyadic"], row["planar"]) == (15, 1, True, True)
