"""How chains grow by dyads: backward and forward ways agree; the exercises of the seeds."""

from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler import Chain, code, is_isomorphic
from gruebler.structure.enumeration import chains
from gruebler.structure.mobility import counted, generic_mobility
from gruebler.structure.transformations import derive, extend
from gruebler.structure.transformations.growth import is_loop, removable_dyads
from tests.strategies import renumbered
from tests.structure.assur.oracles import closed_chains

FOUR_BAR = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
FIVE_BAR = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)")
WATT = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)")
STEPHENSON = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)")


def grown_by_dyads(start, links):
    """All chains with this number of links that grow from a chain by dyads of turning joints, each structure once."""
    level = {code(start): start}
    for _ in range(start.n, links, 2):
        level = {grown.code: grown.chain for chain in level.values() for grown in extend(chain, dyad="RRR")}
    return level.values()


@pytest.mark.parametrize(("links", "all_chains", "from_four_bar"), [(4, 1, 1), (6, 2, 2), (8, 16, 12)])
def test_which_chains_grow_from_the_four_bar(links, all_chains, from_four_bar):
    _two_ways(links, all_chains, from_four_bar)


@pytest.mark.slow
def test_which_ten_link_chains_grow_from_the_four_bar():
    _two_ways(10, 230, 140)


def _two_ways(links, all_chains, from_four_bar):
    every = list(chains(links))
    backward = {code(chain) for chain in every if derive(chain).from_loop}
    assert len(every) == all_chains
    assert len(backward) == from_four_bar
    assert backward == {code(chain) for chain in grown_by_dyads(FOUR_BAR, links)}
    assert all(derive(chain).exact for chain in every)


@pytest.mark.parametrize("links", [5, 7, 9])
def test_with_two_freedoms_the_order_matters_and_both_ways_agree(links):
    forward = {code(chain) for chain in grown_by_dyads(FIVE_BAR, links)}
    every = {code(chain): chain for chain in closed_chains(links, 2)}
    assert forward <= set(every)
    assert {key for key, chain in every.items() if derive(chain).from_loop} == forward


@cache
def _loops_by_trying_everything(chain):
    return is_loop(chain) or any(_loops_by_trying_everything(dyad.remainder) for dyad in removable_dyads(chain))


@given(st.sampled_from([STEPHENSON, WATT, *closed_chains(7, 2), *closed_chains(8, 1)]), st.data())
@settings(max_examples=60)
def test_the_verdict_is_blind_to_numbering(chain, data):
    other = data.draw(renumbered(chain))
    one, two = derive(chain), derive(other)
    assert one.from_loop == two.from_loop == _loops_by_trying_everything(chain)
    if counted(chain) == 1:
        assert code(one.core) == code(two.core)
    assert one.derivation.chain == chain
    assert two.derivation.chain == other


def test_exercise_3_a_dyad_gives_watt_between_neighbours_and_stephenson_between_opposite_links():
    found = extend(FOUR_BAR, dyad="RRR")
    assert len(found) == 2
    neighbours = {("0", "1"), ("1", "2"), ("2", "3"), ("0", "3")}
    for one in found:
        same = WATT if set(one.places) == neighbours else STEPHENSON
        assert is_isomorphic(one.chain, same)
        assert counted(one.chain) == generic_mobility(one.chain) == 1
    assert {place for one in found for place in one.places} == neighbours | {("0", "2"), ("1", "3")}


def test_exercise_4_a_coupler_in_the_five_bar_gives_one_freedom():
    found = extend(FIVE_BAR, coupler="RR")
    assert [len(one.places) for one in found] == [5, 5]
    assert all(counted(one.chain) == generic_mobility(one.chain) == 1 for one in found)
    assert is_isomorphic(found[1].chain, STEPHENSON)


@pytest.mark.parametrize(("form", "number"), [("RRR", 2), ("RRP", 2), ("RPR", 2), ("PRP", 2), ("RPP", 2), ("DDS", 2)])
def test_extensions_of_the_four_bar(form, number):
    assert len(extend(FOUR_BAR, dyad=form)) == number


def test_extensions_are_all_places_up_to_isomorphism():
    """Each place once (in order for a form that is not symmetric), none without its result."""
    for form, ordered in (("RRR", False), ("RRP", True)):
        found = extend(WATT, dyad=form)
        places = [place for one in found for place in one.places]
        assert len(places) == len(set(places)) == (30 if ordered else 15)
        assert len({one.code for one in found}) == len(found)
        for one in found:
            assert code(one.chain) == one.code
            assert one.step.where["between"] == list(one.places[0])


def test_extensions_at_joints_give_multiple_joints():
    found = extend(FOUR_BAR, dyad="RRR", at_joints=True)
    assert sorted(len(one.chain.multiple_joints) for one in found) == [0, 0, 1, 2]
    assert all(generic_mobility(one.chain) == 1 for one in found)
    sliders = extend(Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)"), dyad="PRP", at_joints=True)
    assert all(joint.pair.name == "prismatic" for one in sliders for joint in one.chain.multiple_joints)


def test_derive_tells_why_not():
    rigid = next(chain for chain in chains(8) if not derive(chain).from_loop)
    growth = derive(rigid)
    assert growth.core == rigid
    assert growth.derivation.steps == ()
    assert "no" in growth.explain()
    assert code(rigid) in growth.explain("de")
    more = extend(rigid, dyad="RRR")[0].chain
    growth = derive(more)
    assert code(growth.core) == code(rigid)
    assert len(growth.derivation.steps) == 1
    assert growth.derivation.chain == more
    assert "in which no dyad can be removed" in growth.explain().replace("\n", " ")


def test_multiple_joints_and_sliders_grow_too():
    compressor = Chain.parse("R(f-c) R(c-r1-r2) R(r1-p1) R(r2-p2) P(f-p1) P(f-p2)")
    growth = derive(compressor)
    assert growth.from_loop
    assert growth.core.n == 4
    assert growth.derivation.chain == compressor
    assert "joint" in growth.explain()
    assert "Gelenk" in growth.explain("de")


def test_a_loop_is_its_own_start_and_other_chains_keep_a_core():
    assert derive(FIVE_BAR).explain() == "The chain is one closed loop of 5 links."
    gears = Chain.parse("R(0-1) R(0-2) G(1-2)")
    assert derive(gears).core == gears
    assert derive(gears).from_loop  # a closed loop of three links, one joint a contact
    braced = Chain.from_graph6("C~")
    assert not derive(braced).from_loop


def test_long_chains_are_answered():
    ladder = [(str(k), str(k + 1)) for k in range(60)] + [(str(k), str(k + 3)) for k in range(0, 58, 3)] + [("60", "0")]
    growth = derive(Chain.from_edges(ladder))
    assert growth.derivation.chain == Chain.from_edges(ladder)


@pytest.mark.parametrize(
    ("text", "dyads"),
    [
        ("R(0-1) R(1-2) R(2-0) R(0-3) R(3-4) R(4-1)", [("3", "4")]),  # a triangle is left, the smallest chain of all
        ("R(0-1) R(1-2) R(2-3) R(3-4) R(4-5) R(5-0)", []),  # of a loop two links would be left with one joint
        ("R(0-1) R(1-2) R(2-3) R(3-0)", []),
    ],
)
def test_what_is_left_without_a_dyad_is_closed(text, dyads):
    assert [dyad.links for dyad in removable_dyads(Chain.parse(text))] == dyads
