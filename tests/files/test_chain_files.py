"""Chains as graphs in files: what a form can carry comes back, the rest is refused, many chains are streamed."""

import gzip

import networkx
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import GrueblerError
from gruebler.files import values as files
from gruebler.files.chain_files import GRAPHS, LINES, chain_from_graph_text, graph_text, read_lines, write_lines
from gruebler.structure.chain import Chain
from gruebler.structure.enumeration import chains as all_chains
from gruebler.structure.isomorphism import code
from tests.strategies import PLANAR, REVOLUTE, SPATIAL, SPHERICAL, chains, renumbered


@st.composite
def named(draw):
    """Any chain in any space, its links with names of several words."""
    space, pairs = draw(st.sampled_from([("planar", PLANAR), ("spherical", SPHERICAL), ("spatial", SPATIAL)]))
    return draw(renumbered(draw(chains(pairs=pairs, space=space))))


@settings(deadline=None)
@given(chain=named())
@pytest.mark.parametrize("form", ["graphml", "gml", "dot"])
def test_graphs_carry_every_chain(form, chain):
    assert chain_from_graph_text(graph_text(chain, form, []), form) == chain


@given(chain=chains(multiple=False))
def test_edge_lists_carry_simple_joints(chain):
    assert chain_from_graph_text(graph_text(chain, "edge-list", []), "edge-list") == chain


@given(chain=chains(pairs=REVOLUTE, multiple=False))
def test_matrices_and_codes_carry_simple_revolute_joints(chain):
    assert chain_from_graph_text(graph_text(chain, "matrix", []), "matrix") == chain
    read, write = LINES["sparse6"]
    assert code(read(write(chain))) == code(chain)


@given(chain=chains(pairs=REVOLUTE, multiple=False))
def test_codes_are_those_of_networkx(chain):
    graph = networkx.from_sparse6_bytes(LINES["sparse6"][1](chain).encode())
    assert sorted(map(sorted, networkx.MultiGraph(graph).edges())) == sorted(
        sorted(map(chain.index, joint.links)) for joint in chain.joints
    )


def test_graphs_of_others_are_revolute_chains():
    graph = networkx.cycle_graph(5)
    for form, text in {
        "graphml": "\n".join(networkx.generate_graphml(graph)),
        "gml": "\n".join(networkx.generate_gml(graph)),
        "dot": 'strict graph "" {\n# five links\n0 -- 1;\n1 -- 2 -- 3;\n3 -- 4;\n0 -- 4 [weight=2];\n}',
        "edge-list": "0 1\n1 2 # a comment\n\n2 3\n3 4\n4 0\n",
        "matrix": "[[0,1,0,0,1],\n[1,0,1,0,0],\n[0,1,0,1,0],\n[0,0,1,0,1],\n[1,0,0,1,0]]",
    }.items():
        assert code(chain_from_graph_text(text, form)) == code(Chain.from_edges(graph.edges())), form


MULTIPLE = Chain.parse("R(0-1-2) R(0-3) R(1-3) R(2-3)")
SLIDER = Chain.parse("R(0-1) R(1-2) R(2-3) P(0-3)")


@pytest.mark.parametrize(("chain", "form"), [(MULTIPLE, "edge-list"), (MULTIPLE, "matrix"), (SLIDER, "matrix")])
def test_what_a_form_cannot_hold_is_refused(chain, form):
    with pytest.raises(GrueblerError, match="joints only"):
        graph_text(chain, form, [])


@pytest.mark.parametrize("chain", [MULTIPLE, SLIDER])
@pytest.mark.parametrize("form", ["graph6", "sparse6"])
def test_codes_refuse_other_joints(form, chain):
    with pytest.raises(GrueblerError, match="simple revolute joints only"):
        LINES[form][1](chain)


HOSTILE = {
    "graphml": ['<!DOCTYPE g [<!ENTITY a "b">]><graphml/>', "<graphml>", "<a/>", "<graphml><graph/></graphml>"],
    "gml": ["graph [", "graph [ node [ id 1 ] ]", "x", "graph [ edge [ source 1 target 2 ] ]"],
    "dot": [
        "graph {",
        "digraph { a -> b }",
        "graph { a -> b }",
        "graph { subgraph x { a } }",
        "graph { a -- a }",
        "{",
        "",
    ],
    "edge-list": ["a", "a b c d", "a a", "a b nonsense"],
    "matrix": ["0 1", "0 1\n0 0", "1 0\n0 1", "0 nan\nnan 0", "x"],
}


@pytest.mark.parametrize(("form", "text"), [(form, text) for form, texts in HOSTILE.items() for text in texts])
def test_what_is_no_chain_is_one_sentence(form, text, tmp_path):
    path = tmp_path / f"a.{form}"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(GrueblerError) as caught:
        files.read(path, format_name=form)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("suffix", [".g6", ".s6", ".txt", ".g6.gz", ".s6.gz", ".txt.gz"])
def test_many_chains_in_one_file(suffix, tmp_path):
    wanted = list(all_chains(8))
    path = files.write(wanted, tmp_path / f"chains{suffix}")
    assert [code(chain) for chain in files.read(path)] == [code(chain) for chain in wanted]
    target = tmp_path / "other.s6.gz"
    assert files.convert(path, target) == []
    assert [code(chain) for chain in files.read(target)] == [code(chain) for chain in wanted]
    if suffix.endswith(".gz"):
        assert gzip.decompress(path.read_bytes()).count(b"\n") == len(wanted)


def test_chains_are_read_and_written_one_by_one(tmp_path):
    """Neither the reader nor the writer takes more chains than have been asked for."""
    path = tmp_path / "chains.g6"
    path.write_text("Cr\n" * 3 + "not a code\n", encoding="utf-8")
    stream = read_lines(path, "graph6")
    assert [next(stream).n for _ in range(3)] == [4, 4, 4]
    with pytest.raises(GrueblerError, match="line 4"):
        next(stream)
    taken = []

    def source():
        for chain in all_chains(6):
            taken.append(chain)
            yield chain
        raise GrueblerError("the source ends")

    with pytest.raises(GrueblerError, match="the source ends"):
        write_lines(source(), tmp_path / "out.g6", "graph6")
    assert len(taken) == 2
    assert not (tmp_path / "out.g6").exists()  # complete or not at all


def test_packed_files_that_are_none_and_lines_without_end(tmp_path):
    path = tmp_path / "a.g6.gz"
    path.write_bytes(b"Cr\n")
    with pytest.raises(GrueblerError, match="cannot be read"):
        files.read(path)
    path.write_bytes(gzip.compress(b"a" * 50_000_000))  # small when packed
    with pytest.raises(GrueblerError, match="unpacks to more than 100 times its size"):
        files.read(path)
    path.write_bytes(gzip.compress(b"R(0-1) R(1-2) R(2-0)\n" * 1_000_000))  # chains, but all the same
    with pytest.raises(GrueblerError, match="unpacks to more than 100 times its size"):
        files.read(path.rename(tmp_path / "a.txt.gz"))
    path.write_bytes(gzip.compress(b"Cr\n" * 1000)[:-20])
    with pytest.raises(GrueblerError, match="cannot be read"):
        files.read(path)


def test_the_table_of_forms_and_the_table_of_formats_agree():
    assert {form.name for form in files.FORMATS} >= set(GRAPHS) | set(LINES)
    endings = [ending for form in files.FORMATS for ending in form.suffixes]
    assert len(endings) == len(set(endings))
    for form in files.FORMATS:
        assert form.carries.in_language("de")


WATT = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)")
LETTERS = '"<>[]{}()=-;,&#/\\ \n\t0aé\x00'


@settings(max_examples=150, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 10**6), st.integers(0, 12), st.sampled_from(LETTERS)), min_size=1, max_size=4))
@pytest.mark.parametrize("form", [*GRAPHS, *LINES])
def test_damaged_texts_are_a_chain_or_one_sentence(form, damages):
    """What the parsers raise for letters lost and put in is a refusal, whatever its kind."""
    text = LINES[form][1](WATT) if form in LINES else graph_text(WATT, form, [])
    for number, lost, letter in damages:
        place = number % (len(text) + 1)
        text = text[:place] + letter + text[place + lost :]
    said = ""
    try:
        chain = LINES[form][0](text) if form in LINES else chain_from_graph_text(text, form)
    except GrueblerError as error:
        said = str(error)
    assert len(said.splitlines()) == 1 if said else chain.n >= 3


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.adj", "\n".join(" ".join("0" if i == j else "999" for j in range(12)) for i in range(12))),
        ("a.edgelist", "".join(f"{k} {k + 1}\n{k} {k + 1}\n" for k in range(30_000))),
    ],
)
def test_more_joints_than_a_chain_has_are_refused(name, text, tmp_path):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    with pytest.raises(GrueblerError, match=r"at most 50,000 joints"):
        files.read(path)
