"""Mechanisms taken apart: laws, brute force over tight sets, known mechanisms."""

from itertools import product

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler import Chain, symmetry
from gruebler.structure.assur import AssurError, AssurGroup, assur_groups, decompose, drive_choices
from gruebler.structure.isomorphism import find_isomorphism
from gruebler.structure.mechanism import Drive, Mechanism, check_drives
from gruebler.structure.mobility import generic
from gruebler.structure.mobility.placement import LockedFreedom
from gruebler.structure.transformations import insert_group
from tests.strategies import PLANAR, built_mechanisms, chains, renumbered
from tests.structure.assur.oracles import blocks_by_subsets, closed_chains

WATT = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"
STEPHENSON = "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)"


def is_the_mechanism(found):
    """Every link has one place: frame, drives, a group, the rest; every joint is shared out, wholly if complete."""
    chain = found.mechanism.chain
    links = [found.mechanism.frame, *found.driven, *(x for g in found.groups for x in g.links), *found.rest]
    counts = [0] * len(chain.joints)
    for share in found.shares:
        assert share.count > 0
        counts[share.joint] += share.count
    whole = [joint.count for joint in chain.joints]
    shared = counts == whole if found.complete else all(map(int.__le__, counts, whole))
    return sorted(links) == sorted(chain.links) and shared


def against_the_frame(found):
    """The sets of links between neighbouring tight sets, with the rigid parts that the groups carry."""
    return {
        frozenset(x for body in (*group.bodies, *group.carried) for x in body)
        for group in found.groups
        if found.mechanism.frame in group.base
    }


def in_solving_order(found):
    """Every group finds what it hangs on before it, and its outer joints lead there."""
    chain = found.mechanism.chain
    for place, group in enumerate(found.groups):
        assert all(earlier < place for earlier in group.after)
        near = set(group.base) | {x for k in group.after for x in found.groups[k].links}
        near |= {x for k in group.after for body in found.groups[k].carried for x in body}
        own = {*group.links, *(x for body in group.carried for x in body)}
        for number in group.outer:
            outside = set(chain.joints[number].links) - own
            assert outside & near or outside & {found.mechanism.frame, *found.driven}
        for number in group.inner:
            assert len(set(chain.joints[number].links) & own) > 1
    return True


def moved_to(mechanism, other, names):
    """The mechanism on a renumbered chain."""
    drives = [
        Drive(names.joints[d.joint], d.direction, tuple(names.links[x] for x in d.between)) for d in mechanism.drives
    ]
    return Mechanism(other, names.links[mechanism.frame], drives)


@given(built_mechanisms())
def test_groups_that_were_put_together_are_found_again(built):
    found = decompose(built.mechanism)
    assert found.complete
    assert check_drives(built.mechanism).fixed
    assert set(found.driven) == built.driven
    assert {frozenset(group.links) for group in found.groups} == set(built.groups)
    assert is_the_mechanism(found)
    assert in_solving_order(found)


@given(built_mechanisms(), st.data())
def test_any_order_of_work_gives_the_same_groups(built, data):
    one = decompose(built.mechanism)
    other_chain = data.draw(renumbered(built.mechanism.chain))
    names = find_isomorphism(built.mechanism.chain, other_chain)
    other = decompose(moved_to(built.mechanism, other_chain, names))
    assert {frozenset(names.links[x] for x in g.links) for g in one.groups} == {
        frozenset(g.links) for g in other.groups
    }
    assert sorted(g.shape.code for g in one.groups) == sorted(g.shape.code for g in other.groups)
    assert one.class_number == other.class_number


@given(built_mechanisms(most_groups=2))
@settings(max_examples=40)
def test_against_all_sets_of_links(built):
    assume(built.mechanism.chain.n <= 9)
    found = decompose(built.mechanism)
    cranks = {frozenset({crank}) for crank in built.driven}
    assert against_the_frame(found) | cranks == blocks_by_subsets(built.mechanism)


@given(chains(pairs=PLANAR, most_links=6), st.data())
@settings(max_examples=150)
def test_complete_exactly_if_the_drives_fix_the_motion_and_nothing_is_redundant(chain, data):
    frame = data.draw(st.sampled_from(chain.links))
    simple = [k for k, joint in enumerate(chain.joints) if joint.count == 1]
    assume(simple)
    chosen = data.draw(st.lists(st.sampled_from(simple), max_size=4, unique=True))
    drives = [
        Drive(k, data.draw(st.sampled_from(chain.joints[k].pair.freedoms[chain.space])), chain.joints[k].links)
        for k in chosen
    ]
    mechanism = Mechanism(chain, frame, drives)
    found = decompose(mechanism)
    rank = generic(chain, [LockedFreedom(d.joint, d.direction, d.between) for d in drives])
    assert found.complete == (rank.mobility == 0 and rank.redundancy == 0)
    assert found.overconstrained == (rank.redundancy > 0)
    if found.overconstrained:
        assert found.groups == ()
    else:
        assert is_the_mechanism(found)
        assert in_solving_order(found)
        assert all(g.shape.class_number == g.class_number and g.shape.order == g.order for g in found.groups)
    assert found.complete == (found.message() == "")
    if not found.complete:
        assert set(found.report.free_links) <= set(found.rest)
        assert found.explain("de") != found.explain()


def test_every_driven_mechanism_of_up_to_eight_links():
    """All frames, all drives anywhere; the union is the mechanism, the blocks are those of all tight sets."""
    for links in (4, 6, 8):
        for number, chain in enumerate(closed_chains(links, 1)):
            for frame, drive in product(chain.links, range(len(chain.joints))):
                found = decompose(Mechanism(chain, frame, [drive]))
                assert found.complete
                assert is_the_mechanism(found)
                if links < 8 or number == drive:
                    ends = chain.joints[drive].links
                    driven = {frozenset(ends) - {frame}} if frame in ends else set()
                    assert against_the_frame(found) | driven == blocks_by_subsets(found.mechanism)


@pytest.mark.slow
def test_every_driven_mechanism_of_ten_links():
    number = 0
    for chain in closed_chains(10, 1):
        for orbit in symmetry(chain).flag_orbits:
            found = decompose(Mechanism(chain, orbit[0][0], [orbit[0][1]]))
            assert found.complete
            assert is_the_mechanism(found)
            number += 1
    assert number == 4506


def test_every_typing_of_the_four_bar():
    """Three sliders cannot turn the fourth joint, so it cannot be driven; four have a freedom too many."""
    refused = 0
    for pairs in product("RP", repeat=4):
        chain = Chain.parse("{}(0-1) {}(1-2) {}(2-3) {}(3-0)".format(*pairs))
        for drive in range(4):
            found = decompose(Mechanism(chain, "0", [drive]))
            assert found.complete == (pairs.count("P") < 3 or (pairs.count("P") == 3 and pairs[drive] == "P"))
            refused += not found.complete
    assert refused == 8


@pytest.mark.parametrize(
    "text", [str(group) for links in (2, 4, 6) for group in assur_groups(links)] + ["GGG", "2-RR+G"]
)
def test_a_group_put_on_a_four_bar_is_found_again(text):
    own = {"GGG": "G(a-1) G(b-1) G(c-1)", "2-RR+G": "R(a-1) R(1-2) R(2-3) R(3-b) G(2-c)"}
    group = AssurGroup.parse(own.get(text, text))
    places = (["1", "3", "2", "0"] * 2)[: len(group.places)]
    chain = insert_group(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), group, places).chain
    found = decompose(Mechanism(chain, "0", [0]))
    assert found.groups[0].links == ("2", "3")
    assert [set(g.links) for g in found.groups][1:] == [set(chain.links[4:])]
    assert found.groups[1].shape.code == group.code
    assert (found.groups[1].class_number, found.groups[1].order) == (group.class_number, group.order)


@pytest.mark.parametrize(
    ("text", "formula", "number"),
    [
        ("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1)", "drive R(0-1) -> RRR{2, 3}", 2),
        ("R(0-1) R(1-2) R(2-3) P(3-0); drive=R(0-1)", "drive R(0-1) -> RRP{2, 3}", 2),
        ("R(0-1) R(1-2) R(2-3) P(3-0); frame=1; drive=R(0-1)", "drive R(0-1) -> RRP{2, 3}", 2),
        ("R(0-1) R(1-2) P(2-3) R(3-0); drive=R(0-1)", "drive R(0-1) -> RPR{2, 3}", 2),
        ("R(0-1) R(1-2) R(2-3) P(3-0); drive=P(3-0)", "drive P(3-0) -> RRR{1, 2}", 2),
        (f"{WATT}; frame=0; drive=R(0-1)", "drive R(0-1) -> RRR{2, 3} -> RRR{4, 5}", 2),
        (f"{WATT}; frame=4; drive=R(0-1)", "drive R(0-1) -> RRR{2, 3; on 0+1} -> RRR{0+1[2, 3], 5}", 2),
        (f"{STEPHENSON}; frame=4; drive=R(0-4)", "drive R(0-4) -> 3-RR{1, 2, 3, 5}", 3),
        ("R(f-a) G(a-b) R(b-f); drive=R(f-a)", "drive R(f-a) -> RG{b}", 2),
        ("R(f-a) R(f-b) G(a-b); drive=G(a-b):Rz", "drive G(a-b):Rz -> RPR{a, b}", 2),
        ("R(f-a) R(f-b) G(a-b); drive=G(a-b):Tx", "drive G(a-b):Tx -> RWR{a, b}", 2),
        ("R(f-a) double_slide(a-b) R(b-f); drive=R(f-a)", "drive R(f-a) -> RS2{b}", 2),
        ("R(f-a) P(a-b) R(b-c) R(c-f); drive=P(a-b)", "drive P(a-b) -> RRR{a+b, c}", 2),
        (
            "R(f-c) R(c-r1-r2) R(r1-p1) R(r2-p2) P(f-p1) P(f-p2); drive=R(f-c)",
            "drive R(f-c) -> RRP{r1, p1} -> RRP{r2, p2}",
            2,
        ),
        (
            "R(0-1-2) R(1-3) R(3-2); drive=R(0-1-2):0-1; drive=R(0-1-2):0-2",
            "drive R(0-1-2):0-1, R(0-1-2):0-2 -> ?{3}",
            1,
        ),
        ("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); drive=R(0-1)", "drive R(0-1) -> ?{2, 3, 4}", 1),
        ("R(0-1) R(1-2) R(2-0)", "no drive -> RRR{1, 2}", 2),
        ("R(0-1) R(1-2); drive=R(0-1); drive=R(1-2)", "drive R(0-1), R(1-2)", 1),
    ],
)
def test_known_mechanisms(text, formula, number):
    found = decompose(Mechanism.parse(text))
    assert found.formula() == formula
    assert found.class_number == number
    assert is_the_mechanism(found) or found.overconstrained


def test_drives_that_conflict():
    found = decompose(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); drive=R(0-1); drive=R(1-2)"))
    assert not found.complete
    assert found.overconstrained
    assert "conflict: R(0-1), R(1-2)." in found.explain()
    braced = decompose(Mechanism(Chain.from_graph6("C~"), "0"))
    assert braced.message() == (
        "Constraints or drives conflict: there are no Assur groups. "
        "Overconstrained: 0, 1, 2, 3 (redundant constraints: 3)."
    )
    assert "überzählige Bindungen: 3" in braced.message("de")
    assert "widersprechen" in found.explain("de")


def test_a_rigid_part_of_the_chain_counts_as_one_body():
    """A triangle of links as coupler: found by itself against one of its links, then one body of a dyad."""
    chain = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-2) R(4-5) R(5-0)")
    found = decompose(Mechanism(chain, "0", [0]))
    assert found.complete
    assert [(g.form(), len(g.links)) for g in found.groups] == [("RRR", 2), ("RRR", 2)]
    assert [len(carried) for carried in found.groups[1].carried] in ([2, 0], [0, 2])
    assert is_the_mechanism(found)


def test_the_formula_in_german():
    slider_crank = Mechanism.parse("R(f-c) R(c-r) R(r-p) P(p-f); drive=R(f-c)")
    assert decompose(slider_crank).formula("de") == "Antrieb D(f-c) -> DDS{r, p}"


def test_classes_change_with_the_drive():
    chain = Chain.parse(STEPHENSON)
    assert [found.class_number for found in drive_choices(chain, "4")] == [3, 4]
    assert [found.class_number for found in drive_choices(chain, "4", anywhere=True)] == [2, 2, 2, 2, 3, 4, 4]
    five = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)")
    assert [found.complete for found in drive_choices(five, "0")] == [True]
    assert len(list(drive_choices(five, "0", anywhere=True))) == 10
    with pytest.raises(AssurError, match=r"does not move"):
        list(drive_choices(Chain.parse("R(0-1) R(1-2) R(2-0)"), "0"))


def test_what_has_no_assur_groups_is_refused():
    with pytest.raises(AssurError, match=r"spherical"):
        decompose(Mechanism(Chain.parse("spherical: R(0-1) R(1-2) R(2-3) R(3-0)"), "0", [0]))
    shared = Mechanism.parse("double_slide(a-b-c) R(b-d) R(c-d); drive=double_slide(a-b-c):Tx:a-b")
    with pytest.raises(AssurError, match=r"joint of its own"):
        decompose(shared)
