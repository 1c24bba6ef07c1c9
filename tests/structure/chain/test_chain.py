import copy
import json
import pickle

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler import Chain, GrueblerError, Linkage, Mechanism, SpatialLinkage, code
from gruebler.base.errors import ChainError, NotationError, PairError
from gruebler.base.text import error_in_language
from gruebler.structure.chain.notation import link_text
from gruebler.structure.chain.pairs import Alphabet
from tests.strategies import PLANAR, SPATIAL, chains

VEE = "R(frame-crank) R(crank-conrod1-conrod2) R(conrod1-piston1) R(conrod2-piston2) P(frame-piston1) P(frame-piston2)"


def test_counts_of_the_v_compressor():
    vee = Chain.parse(VEE)
    assert (vee.n, vee.g, vee.loops) == (6, 7, 2)
    assert vee.joints_by_freedom == {1: 7}
    assert vee.link_kinds == {2: 5, 3: 1}
    assert vee.degrees["frame"] == 3
    assert [str(j) for j in vee.multiple_joints] == ["R(crank-conrod1-conrod2)"]
    assert str(vee) == VEE


@given(st.one_of(chains(), chains(pairs=SPATIAL, space="spatial"), chains(pairs=("revolute",), space="spherical")))
def test_text_json_pickle_and_copy_come_back(chain):
    for alphabet in Alphabet:
        assert Chain.parse(chain.text(alphabet)) == chain
    assert Chain.from_json(json.dumps(chain.to_json())) == chain
    assert Chain.from_json(chain.to_json()) == chain
    assert pickle.loads(pickle.dumps(chain)) == chain
    assert copy.deepcopy(chain) is copy.copy(chain) is chain
    assert eval(repr(chain), {"Chain": Chain}) == chain
    assert hash(pickle.loads(pickle.dumps(chain))) == hash(chain)


@given(st.text(st.characters(exclude_categories=["C", "Z"]), min_size=1, max_size=12))
def test_any_visible_name_comes_back(name):
    chain = Chain([("revolute", [name, "a a"]), ("revolute", ["a a", '"b']), ("prismatic", ['"b', name])])
    assert Chain.parse(str(chain)) == chain
    assert link_text(name).strip('"')


def test_order_of_writing_does_not_matter_and_names_do():
    chain = Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)")
    assert chain == Chain.parse("P(0-3) R(2-1) R(3-2) R(1-0)")
    assert hash(chain) == hash(Chain.parse("P(0-3) R(2-1) R(3-2) R(1-0)"))
    assert chain != Chain.parse("R(0-1) R(1-2) P(2-3) R(3-0)")
    assert chain != "R(0-1) R(1-2) R(2-3) P(3-0)"
    assert Chain.parse("D(0-1) D(1-2) D(2-3) S(3-0)") == chain


def test_a_chain_does_not_change():
    chain = Chain.parse("R(0-1) R(1-2) R(2-0)")
    with pytest.raises(AttributeError, match="cannot assign"):
        chain.links = ("0",)
    with pytest.raises(AttributeError, match="cannot delete"):
        del chain.space
    assert chain.degrees == {"0": 2, "1": 2, "2": 2}


@pytest.mark.parametrize(
    ("joints", "options", "words"),
    [
        ([("revolute", ["a", "b"])], {}, "at least three links, this one has 2 links"),
        ([], {}, "no links"),
        ([("revolute", ["ab", "c", "d"]), ("revolute", ["c"])], {}, "R(c) has one link"),
        ([("revolute", ["a", "b"]), ("revolute", ["b", "b"])], {}, "names the link 'b' twice"),
        ([("revolute", ["a", "b"]), ("revolute", ["b", "c"])], {"links": "abcd"}, "'d' has no joint"),
        ([("revolute", ["a", "b"]), ("revolute", ["b", "c"])], {"links": "abca"}, "two links are called 'a'"),
        (
            [("revolute", ["crank", "rod"]), ("revolute", ["rod", "cranck"])],
            {"links": ["crank", "rod"]},
            "did you mean",
        ),
        ([("revolute", ["a", "b"]), ("revolute", ["c", "d"])], {}, "2 parts"),
        ([("roll_slide", ["a", "b", "c"])], {}, "joins exactly two"),
        ([("revolute", ["a", "b"]), ("revolute", ["b", " "])], {}, "visible"),
        ([("revolute", ["a", "b"]), ("revolute", ["b", "x" * 201])], {}, "at most 200"),
        ([("revolute", ["a", "b"]), ("revolute", ["b", True])], {}, "not by True"),
        ([("revolute", "ab"), ("revolute", "bc")], {}, "not the text 'ab'"),
    ],
)
def test_an_unsound_chain_is_not_constructed(joints, options, words):
    with pytest.raises(ChainError) as caught:
        Chain(joints, **options)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("joints", "space", "words"),
    [
        ([("hinge", ["a", "b"])], "planar", "unknown pair 'hinge'"),
        ([("spherical", ["a", "b"]), ("revolute", ["b", "c"])], "planar", "S(a-b) is not possible"),
        ([("prismatic", ["a", "b"]), ("revolute", ["b", "c"])], "spherical", "P(a-b) is not possible"),
    ],
)
def test_a_pair_that_the_space_does_not_have_is_refused(joints, space, words):
    with pytest.raises(PairError) as caught:
        Chain(joints, space=space)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "names no joint"),
        ("R(0-1", "')' at character 6, but the text ends"),
        ("R(0-1) R(1-2) nonsense", "expected a joint such as R(frame-crank) at character 15"),
        ("R(0--1)", "the name of a link at character 5"),
        ("R 0-1", "a joint"),
        ('R("a-b)', "the name of a link"),
        (r'R("a\q"-b)', "quoted name"),
        ("flat: R(0-1) R(1-2) R(2-0)", "unknown space 'flat'"),
        ("g6:", "graph6"),
        ("g6:zzzz", "graph6"),
        ("g6:ÄÖ", "graph6"),
    ],
)
def test_a_text_that_cannot_be_read_says_where(text, words):
    with pytest.raises(GrueblerError) as caught:
        Chain.parse(text)
    assert words in str(caught.value)


def test_space_prefix_and_argument():
    assert Chain.parse("spatial: R(a-b) S(b-c) R(c-a)").space == "spatial"
    assert Chain.parse("R(a-b) S(b-c) R(c-a)", space="spatial") == Chain.parse("Spatial : R(a-b) S(b-c) R(c-a)")
    with pytest.raises(NotationError, match=r"says spatial, but planar"):
        Chain.parse("spatial: R(a-b) S(b-c) R(c-a)", space="planar")


@pytest.mark.parametrize(
    "document",
    [
        "{",
        "[]",
        '{"joints": []}',
        '{"joints": "R"}',
        '{"joints": [{"pair": "revolute"}]}',
        '{"joints": [{"pair": "revolute", "links": [1, 2]}]}',
        '{"joints": [{"pair": "revolute", "links": ["a", "b"], "x": 1}]}',
        '{"joints": [], "frame": "a"}',
        '{"joints": [{"pair": "revolute", "links": ["a", "b"]}], "links": "ab"}',
        '{"space": 3, "joints": []}',
    ],
)
def test_bad_json_is_refused_in_a_sentence(document):
    with pytest.raises(GrueblerError, match=r"^[^\n]+$"):
        Chain.from_json(document)


@given(chains(pairs=PLANAR))
def test_networkx_views_lose_nothing(chain):
    incidence = chain.incidence_graph()
    assert incidence.number_of_edges() == sum(len(j.links) for j in chain.joints)
    assert nx.is_connected(incidence)
    links = chain.link_graph()
    assert list(links.nodes) == list(chain.links)
    assert links.number_of_edges() == sum(len(j.links) * (len(j.links) - 1) // 2 for j in chain.joints)
    assert {link: incidence.degree(("link", link)) for link in chain.links} == chain.degrees
    assert sum(k * number for k, number in chain.link_kinds.items()) == chain.g + len(chain.joints)


def test_graph6_is_what_networkx_writes():
    watt = nx.Graph([(0, 1), (1, 2), (2, 3), (3, 0), (2, 4), (4, 5), (5, 3)])
    code = nx.to_graph6_bytes(watt, header=False).decode().strip()
    chain = Chain.parse(f"g6:{code}")
    assert nx.is_isomorphic(nx.Graph(chain.link_graph()), watt)
    assert chain.links == ("0", "1", "2", "3", "4", "5")


def test_other_chains():
    chain = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
    assert str(chain.renamed({"0": "frame"})) == "R(frame-1) R(1-2) R(2-3) R(3-frame)"
    with pytest.raises(ChainError, match="no link 'x'"):
        chain.renamed({"x": "y"})
    braced = chain.with_joint("revolute", ["0", "2"])
    assert braced.without_joint(4) == chain
    assert chain.with_joint("prismatic", ["3", "4"]).links == ("0", "1", "2", "3", "4")
    with pytest.raises(ChainError, match="joints 0 to 3"):
        chain.without_joint(4)
    with pytest.raises(ChainError, match="'4' has no joint"):
        chain.with_joint("prismatic", ["3", "4"]).without_joint(4)
    assert chain.with_joint("revolute", ["0", "1"]).joint_names()[-1] == "R(0-1)#2"
    assert chain.joints_of("2") == chain.joints[1:3]


def test_joints_are_found_as_they_are_written():
    chain = Chain.parse('R(0-1-2) P(0-3) R(3-1) R(1-3) R("a b"-3)')
    assert chain.find_joint("R(2-0-1)") == 0
    assert chain.find_joint(" S( 0 - 3 ) ") == 1
    assert chain.find_joint("prismatic(3-0)") == 1
    assert chain.find_joint("R(1-3)") == chain.find_joint("D(3-1)#1") == 2
    assert chain.find_joint("R(1-3)#2") == 3
    assert chain.find_joint('R(3-"a b")') == 4
    for wrong in ("P(0-1-2)", "nonsense", "R(1-3)#3", "R(1-3)#0", "R(1-3)#x", "R()", ""):
        assert chain.find_joint(wrong) is None
    assert [chain.find_joint(name) for name in chain.joint_names()] == [0, 1, 2, 3, 4]


def test_a_missing_joint_has_one_message_everywhere():
    quad = Chain.parse("R(0-1) R(1-2) P(2-3) R(3-0)")
    assert [quad.joint_number(name) for name in ("D(1-0)", "P(2-3)", 3)] == [0, 2, 3]
    mechanism = Mechanism(quad, "0")
    calls = [
        lambda: quad.joint_number("R(0-2)"),
        lambda: Mechanism(quad, "0", ["R(0-2)"]),
        lambda: SpatialLinkage(mechanism, {"R(0-2)": {}}),
        lambda: Linkage(mechanism, {"0": {"R(0-2)": (0, 0)}}),
    ]
    for call in calls:
        with pytest.raises(
            GrueblerError, match=r"'R\(0-2\)' is not one of the joints \(did you mean 'R\([01]-[12]\)'\?\)"
        ):
            call()
    for call in (lambda: quad.without_joint(4), lambda: Mechanism(quad, "0", [4]), lambda: code(quad, drives=[4])):
        with pytest.raises(ChainError, match="there is no joint number 4; the chain has joints 0 to 3"):
            call()


def test_a_missing_joint_is_said_in_the_letters_of_the_reader():
    chain = Chain.parse("R(0-1) R(1-2) P(2-0)")
    with pytest.raises(ChainError, match=r"they are R\(0-1\), R\(1-2\), P\(2-0\)$") as caught:
        chain.joint_number("S(1-3)")
    german = error_in_language(caught.value, "de")
    assert "D(0-1), D(1-2), S(2-0)" in german
    assert "R(" not in german
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)
