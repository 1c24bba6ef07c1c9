"""Inversions and driven mechanisms: orbits against codes, families against what is known."""

import pytest
from hypothesis import given, settings

from gruebler import Chain, code
from gruebler.base.errors import ChainError
from gruebler.structure.mechanism import Mechanism, check_drives
from gruebler.structure.mechanism.inversion import driven_mechanisms, family, inversions, of_family
from tests.strategies import chains

FOUR = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
SLIDER_CRANK = Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)")
DOUBLE_SLIDER = Chain.parse("R(0-1) R(1-2) P(2-3) P(3-0)")
WATT = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)")
STEPHENSON = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)")


@given(chains(pairs=("revolute", "prismatic"), most_links=6, multiple=False))
@settings(max_examples=60)
def test_orbits_against_codes(chain):
    """One mechanism for each different code, whatever the group does."""
    every = {code(chain, frame=link) for link in chain.links}
    found = [m.code() for m in inversions(chain)]
    assert len(found) == len(set(found))
    assert set(found) == every
    every = {
        code(chain, frame=link, drives=[k])
        for k, joint in enumerate(chain.joints)
        for link in chain.links
        if link in joint.links
    }
    found = [d.mechanism.code() for d in driven_mechanisms(chain)]
    assert len(found) == len(set(found))
    assert set(found) == every
    anywhere = [d.mechanism.code() for d in driven_mechanisms(chain, at_frame=False)]
    assert len(anywhere) == len(set(anywhere))
    assert set(anywhere) == {code(chain, frame=x, drives=[k]) for x in chain.links for k in range(len(chain.joints))}


@pytest.mark.parametrize(
    ("chain", "frames", "driven"), [(FOUR, 1, 1), (WATT, 2, 4), (STEPHENSON, 3, 5), (SLIDER_CRANK, 2, 4)]
)
def test_known_numbers(chain, frames, driven):
    assert len(inversions(chain)) == frames
    assert len(list(driven_mechanisms(chain))) == driven


def test_outputs():
    """In the four-bar the output may be the coupler or the far link; the driven crank is input."""
    found = list(driven_mechanisms(FOUR, output=True))
    assert len(found) == 2
    assert {d.output for d in found} == {"2", "3"}
    assert all(d.mechanism.drives[0].between == ("0", "1") for d in found)


def test_two_drives_and_those_that_fix_the_motion():
    five = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)")
    assert len(list(driven_mechanisms(five, drives=2))) == 1
    assert len(list(driven_mechanisms(five, drives=2, at_frame=False))) == 6
    # Watt's chain has F = 1: two drives always work against each other
    assert list(driven_mechanisms(WATT, drives=2, fixed_only=True)) == []
    with pytest.raises(ChainError, match=r"at least one drive, not 0"):
        next(driven_mechanisms(FOUR, drives=0))


@pytest.mark.parametrize(
    ("chain", "names"),
    [
        (FOUR, {"four-bar linkage"}),
        (
            SLIDER_CRANK,
            {
                "slider-crank",
                "inverted slider-crank (turning or swinging block)",
            },
        ),
        (
            DOUBLE_SLIDER,
            {"Scotch yoke", "elliptic trammel (double slider)", "Oldham coupling (double slotted lever)"},
        ),
        (WATT, {"Watt I", "Watt II"}),
        (STEPHENSON, {"Stephenson I", "Stephenson II", "Stephenson III"}),
    ],
)
def test_families_by_name(chain, names):
    assert {family(m) for m in inversions(chain)} == names
    assert all(family(m, "de") for m in inversions(chain))


def test_frames_of_watt_and_stephenson():
    assert {family(m): WATT.degrees[m.frame] for m in inversions(WATT)} == {"Watt I": 2, "Watt II": 3}
    degrees = {family(m): STEPHENSON.degrees[m.frame] for m in inversions(STEPHENSON)}
    assert degrees == {"Stephenson I": 2, "Stephenson II": 2, "Stephenson III": 3}
    first = next(m for m in inversions(STEPHENSON) if family(m) == "Stephenson I")
    near = {STEPHENSON.degrees[x] for j in STEPHENSON.joints_of(first.frame) for x in j.links if x != first.frame}
    assert near == {3}  # its frame lies between the two ternary links


def test_multiple_joints_and_joints_of_several_freedoms():
    vee = Chain.parse("R(frame-crank) R(crank-rod1-rod2) R(rod1-p1) R(rod2-p2) P(frame-p1) P(frame-p2)")
    assert len(inversions(vee)) == 4
    # at the frame "crank": the bearing, or the pin against one of the two rods, which are alike
    crank = [d.mechanism for d in driven_mechanisms(vee) if d.mechanism.frame == "crank"]
    assert len(crank) == 2
    gears = Chain.parse("R(0-1) R(0-2) G(1-2)")
    assert len(list(driven_mechanisms(gears))) == 4  # frame 0: a gear; frame 1: bearing, turn or slide of the contact


def test_every_driven_mechanism_of_the_six_links_is_fixed_by_its_drive():
    for chain in (WATT, STEPHENSON):
        for driven in driven_mechanisms(chain, at_frame=False):
            assert check_drives(driven.mechanism).fixed


@pytest.mark.parametrize(
    ("word", "name"),
    [
        ("watt ii", "Watt II"),
        ("Stephenson III", "Stephenson III"),
        ("Kreuzschubkurbel", "Scotch yoke"),
        ("Elliptic trammel", "elliptic trammel (double slider)"),
        ("four-bar", "four-bar linkage"),
        ("Viergelenk", "four-bar linkage"),
        ("kurbelschleife", "inverted slider-crank (turning or swinging block)"),
    ],
)
def test_mechanisms_by_the_name_of_their_family(word, name):
    assert family(of_family(word)) == name
    assert of_family(f"{word} I") is None


def test_unknown_families_have_no_name():
    assert family(Mechanism.parse("R(0-1) R(1-2) R(2-0)")) is None


def test_the_four_rows_of_the_seeds_inversion_table_are_one_structure():
    """Table 2.3: fixing b, d, a or c of a four-bar gives two crank-rockers, a double crank, a double rocker.

    The names come from lengths; in structure the four frames are one.
    """
    four = Chain.parse("R(a-b) R(b-c) R(c-d) R(d-a)")
    assert len({Mechanism(four, frame).code() for frame in "bdac"}) == 1
    assert len(inversions(four)) == 1
