"""Mechanisms as values, drives that fix or do not, and roles."""

import copy
import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler import Chain, GrueblerError
from gruebler.structure.mechanism import Mechanism, Role, check_drives, roles
from gruebler.structure.mobility import generic_mobility
from gruebler.teaching.catalog import entries
from tests.strategies import PLANAR, chains


@st.composite
def mechanisms(draw):
    chain = draw(chains(pairs=PLANAR, most_links=6))
    frame = draw(st.sampled_from(chain.links))
    drives = []
    for number in draw(st.sets(st.integers(0, len(chain.joints) - 1), max_size=2)):
        joint = chain.joints[number]
        direction = draw(st.sampled_from(joint.pair.freedoms[chain.space]))
        a, b = draw(st.permutations(joint.links))[:2]
        drives.append(f"{chain.joint_names()[number]}:{direction}:{a}-{b}")
    return Mechanism(chain, frame, drives)


@given(mechanisms())
def test_text_json_pickle_and_copies_come_back(mechanism):
    assert Mechanism.parse(str(mechanism)) == mechanism
    assert Mechanism.parse(mechanism.text("german")) == mechanism
    assert Mechanism.from_json(mechanism.to_json()) == mechanism
    assert pickle.loads(pickle.dumps(mechanism)) == mechanism
    assert copy.deepcopy(mechanism) == mechanism
    assert hash(Mechanism.parse(str(mechanism))) == hash(mechanism)
    assert eval(repr(mechanism), {"Mechanism": Mechanism}) == mechanism


@given(mechanisms())
def test_locking_drives_takes_away_as_much_as_they_are_independent(mechanism):
    report = check_drives(mechanism)
    assert report.mobility == generic_mobility(mechanism.chain)
    assert report.mobility - report.drives <= report.remaining <= report.mobility
    assert (report.remaining == 0) == (report.free_links == ())
    if not report.redundant_drives:
        assert report.remaining == report.mobility - report.drives
    assert mechanism.frame not in report.free_links


def test_a_drive_may_sit_between_moving_links():
    loader = Mechanism.parse("R(boom-cylinder) P(cylinder-rod) R(rod-bell) R(bell-boom); drive=P(cylinder-rod)")
    assert check_drives(loader).fixed
    assert [str(r) for r in roles(loader).values()] == ["frame", "rocker", "coupler", "rocker"]


def test_one_part_free_while_another_is_driven_twice():
    # a four-bar and a five-bar on one frame: F = 1 + 2, three drives, two of them on the four-bar
    text = "R(0-1) R(1-2) R(2-3) R(3-0) R(0-a) R(a-b) R(b-c) R(c-d) R(d-0)"
    wrong = check_drives(Mechanism(Chain.parse(text), "0", ["R(0-1)", "R(0-3)", "R(0-a)"]))
    assert (wrong.mobility, wrong.drives, wrong.remaining) == (3, 3, 1)
    assert set(wrong.redundant_drives) == {0, 1}
    assert set(wrong.free_links) == {"b", "c", "d"}
    assert "still moving: b, c, d" in wrong.explain()
    assert "widersprechen: D(0-1), D(3-0)." in wrong.explain("de")
    right = check_drives(Mechanism(Chain.parse(text), "0", ["R(0-1)", "R(0-a)", "R(0-d)"]))
    assert right.fixed
    assert right.explain("de") == "Laufgrad 3 und 3 Antriebe: Die Bewegung ist bestimmt."


def test_roles_of_the_seeds_machines():
    piston = entries()["compressor"]
    found = roles(Mechanism(piston.chain(), piston.frame, piston.drives))
    assert [r.in_language("de") for r in found.values()] == ["Gestell", "Kurbel", "Koppel", "Schieber"]
    gears = entries()["geartrain"]
    found = roles(Mechanism(gears.chain(), gears.frame, gears.drives))
    assert list(found.values()) == [Role.FRAME, Role.CRANK, Role.ROLLER]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("R(0-1) R(1-2) R(2-0); drive=R(0-5)", "not one of the joints (did you mean 'R(0-1)'?); they are R(0-1)"),
        ("R(0-1-2) R(1-3) R(3-0); drive=R(0-1-2)", "say which two"),
        ("R(0-1-2) R(1-3) R(3-0); drive=R(0-1-2):0-3", "between two of its links"),
        ("G(0-1) R(1-2) R(2-0); drive=G(0-1)", "say which is driven: G(0-1):Rz"),
        ("G(0-1) R(1-2) R(2-0); drive=G(0-1):Ty", "'Ty' is not a freedom of G(0-1)"),
        ("R(0-1) R(1-2) R(2-0); drive=R(0-1); drive=R(1-0)", "named twice"),
        ("R(0-1) R(1-2) R(2-0); frame=7", "no link '7'"),
        ("R(0-1) R(1-2) R(2-0); farme=0", "not a mark of a mechanism"),
        ("R(0-1) R(1-2) R(2-0); frame=a b", "name of a link"),
        ("R(0-1) R(1-2) R(2-0); output=7", "no link '7'"),
        ("R(0-1) R(1-2) R(2-0); frame=1; output=1", "the output '1' is the frame"),
        ("gr1:R(0-1-2)R(0-3)R(1-3);frame=0;drives=0:0-3", "joint 0 is R(0-1-2)"),
        ("gr1:R(0-1)R(1-2)R(0-2);frame=0;drives=3:Rz", "the code has joints 0 to 2"),
        ("gr1:R(0-1)R(1-2)R(0-2);frame=0;drives=0:Tx", "'Tx' is not a freedom"),
        ("gr1:R(0-1)R(1-2)R(2-0)", "marks no frame"),
    ],
)
def test_mistakes_one_by_one(text, words):
    with pytest.raises(GrueblerError) as caught:
        Mechanism.parse(text)
    assert words in str(caught.value)


def test_a_mechanism_does_not_change():
    mechanism = Mechanism.parse("R(0-1-2) R(1-3) R(3-0) R(2-3); drive=R(0-1-2):0-1")
    with pytest.raises(AttributeError, match=r"cannot assign"):
        mechanism.frame = "1"


def test_drives_keep_their_order_which_equality_and_code_leave_out():
    text = "R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); drive={}; drive={}"
    one, other = Mechanism.parse(text.format("R(4-0)", "R(0-1)")), Mechanism.parse(text.format("R(0-1)", "R(4-0)"))
    assert one.drive_names() == ("R(4-0)", "R(0-1)")
    assert other.drive_names() == ("R(0-1)", "R(4-0)")
    assert (one == other, one.code() == other.code(), one.written_form == other.written_form) == (True, True, False)
