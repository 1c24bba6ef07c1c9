"""Transformations of arbitrary chains: what they do to mobility, and that they can be undone and done again."""

import json
from contextlib import suppress

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler import Chain
from gruebler.base.errors import TransformationError
from gruebler.structure.assur import DYADS, AssurError, AssurGroup
from gruebler.structure.mobility import counted, generic, generic_mobility
from gruebler.structure.mobility.placement import LockedFreedom
from gruebler.structure.transformations import (
    Derivation,
    contract,
    derive,
    expand,
    insert_coupler,
    insert_dyad,
    insert_group,
    remove_coupler,
    remove_dyad,
    remove_group,
    replace_roll_slide,
    replay,
    restore_roll_slide,
)
from tests.strategies import GROUPS, PLANAR, SPATIAL, SPHERICAL, chains

ANY = chains(pairs=PLANAR, most_links=6)
FORMS = sorted({*DYADS, *(form[::-1] for form in DYADS)})


@st.composite
def two_places(draw, chain, ends):
    """Two places for joints of these pairs on different links: links, or joints that a further link can join."""
    places = []
    for letter in ends:
        name = {"R": "revolute", "P": "prismatic"}[letter]
        joints = [k for k, joint in enumerate(chain.joints) if joint.pair.name == name]
        places.append(draw(st.sampled_from([*chain.links, *joints])))
    links = [{place} if isinstance(place, str) else set(chain.joints[place].links) for place in places]
    assume(links[0].isdisjoint(links[1]))
    return places


def done_again(step):
    """The record of a step, through JSON too, leads to the same chain."""
    where = json.loads(json.dumps(step.to_json()["where"]))
    return replay(step.before, step.kind, where) == step and step.explain() != step.explain("de")


@given(ANY, st.sampled_from(FORMS), st.data())
def test_a_dyad_keeps_counted_and_generic_mobility_and_can_be_taken_out(chain, form, data):
    step = insert_dyad(chain, form, data.draw(two_places(chain, form[0] + form[2])))
    assert counted(step.chain) == counted(chain)
    assert generic_mobility(step.chain) == generic_mobility(chain)
    assert step.chain.n == chain.n + 2
    out = remove_dyad(step.chain, step.where["links"])
    assert out.chain == chain
    assert done_again(step)
    assert done_again(out)


@given(chains(pairs=SPHERICAL, space="spherical", most_links=6), st.data())
@settings(max_examples=30)
def test_a_dyad_on_the_sphere(chain, data):
    step = insert_dyad(chain, "RRR", data.draw(two_places(chain, "RR")))
    assert counted(step.chain) == counted(chain)
    assert generic_mobility(step.chain) == generic_mobility(chain)


@given(ANY, st.sampled_from(["RR", "RP", "PR", "PP", "WR"]), st.data())
@settings(max_examples=200)
def test_a_coupler_lowers_counted_by_one_and_generic_where_the_links_can_move(chain, pairs, data):
    links = data.draw(st.lists(st.sampled_from(chain.links), min_size=2, max_size=2, unique=True))
    step = insert_coupler(chain, links, pairs)
    assert counted(step.chain) == counted(chain) - 1
    a, b = map(chain.index, links)
    against = generic(chain).motions
    against = against[:, b] - against[:, a]
    moves = (against[:, 0] if pairs == "PP" else against).any()  # the turn comes first
    assert generic_mobility(step.chain) == generic_mobility(chain) - int(moves)
    out = remove_coupler(step.chain, step.where["link"])
    assert out.chain == chain
    assert done_again(step)
    assert done_again(out)


@given(ANY, st.sampled_from(["RR", "RP", "PP"]), st.data())
@settings(max_examples=40)
def test_a_coupler_at_joints_can_be_taken_out(chain, pairs, data):
    step = insert_coupler(chain, data.draw(two_places(chain, pairs)), pairs)
    assert counted(step.chain) == counted(chain) - 1
    assert remove_coupler(step.chain, step.where["link"]).chain == chain
    assert done_again(step)


@given(ANY, st.sampled_from(GROUPS), st.data())
def test_a_group_keeps_counted_and_generic_mobility_and_can_be_taken_out(chain, text, data):
    group = AssurGroup.parse(text)
    at = data.draw(st.lists(st.sampled_from(chain.links), min_size=len(group.places), max_size=len(group.places)))
    assume(len(set(at)) > 1)
    step = insert_group(chain, group, at)
    assert counted(step.chain) == counted(chain)
    assert generic_mobility(step.chain) == generic_mobility(chain)
    out = remove_group(step.chain, step.where["links"])
    assert out.chain == chain
    assert done_again(step)
    assert done_again(out)


@given(chains(pairs=SPATIAL, space="spatial", most_links=6) | ANY, st.data())
def test_contraction_lowers_counted_by_the_freedoms_and_locks_the_joint(chain, data):
    number = data.draw(st.integers(0, len(chain.joints) - 1))
    joint = chain.joints[number]
    links = data.draw(st.permutations(joint.links))[:2]
    try:
        step = contract(chain, number, links)
    except TransformationError:
        meeting = [j for j in chain.joints if set(links) <= set(j.links)]
        assert len(meeting) > 1 or chain.n == 3
        return
    freedoms = joint.pair.freedoms[chain.space]
    assert counted(step.chain) == counted(chain) - len(freedoms)
    assert (
        generic_mobility(step.chain)
        == generic(chain, [LockedFreedom(number, d, tuple(links)) for d in freedoms]).mobility
    )
    assert done_again(step)
    kept, gone = links
    moved = [k for k, j in enumerate(chain.joints) if gone in j.links and k != number]
    if joint.count == 1:
        back = expand(step.chain, kept, [k - (k > number) for k in moved], pair=joint.pair, new=gone)
    else:
        back = expand(step.chain, kept, moved, at=number, new=gone)
    assert back.chain == chain
    assert done_again(back)


@given(ANY, st.data())
def test_expansion_raises_counted_by_the_freedoms_and_contraction_undoes_it(chain, data):
    link = data.draw(st.sampled_from(chain.links))
    mine = [k for k, joint in enumerate(chain.joints) if link in joint.links]
    moved = data.draw(st.lists(st.sampled_from(mine), unique=True))
    pair = data.draw(st.sampled_from(["revolute", "prismatic", "roll_slide"]))
    step = expand(chain, link, moved, pair=pair)
    assert counted(step.chain) == counted(chain) + step.chain.joints[-1].pair.f(chain.space)
    assert generic_mobility(step.chain) >= generic_mobility(chain)
    assert contract(step.chain, len(chain.joints), [link, step.where["new"]]).chain == chain
    assert done_again(step)


@given(chains(pairs=("revolute", "roll_slide", "roll_slide"), most_links=6), st.sampled_from(["RR", "RP", "PR"]))
def test_a_roll_slide_joint_and_its_equivalent_have_the_same_mobility(chain, pairs):
    contacts = [k for k, joint in enumerate(chain.joints) if joint.pair.name == "roll_slide"]
    assume(contacts)
    step = replace_roll_slide(chain, contacts[0], pairs)
    assert counted(step.chain) == counted(chain)
    assert generic_mobility(step.chain) == generic_mobility(chain)
    back = restore_roll_slide(step.chain, step.where["link"])
    assert back.chain == chain
    assert done_again(step)
    assert done_again(back)


def removed(chain, links):
    """What can be taken away there, and by how much the mobility rises with it."""
    steps = []
    for remove, arguments in ((remove_dyad, links), (remove_group, links), (remove_coupler, links[0])):
        with suppress(TransformationError, AssurError):
            steps.append((remove(chain, arguments), int(remove is remove_coupler)))
    return steps


def test_the_dyad_of_a_six_bar_can_be_removed():
    watt = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)")
    assert [(step.chain.n, rise) for step, rise in removed(watt, ["4", "5"])] == [(4, 0), (4, 0), (5, 1)]


@given(ANY, st.data())
def test_what_is_removed_was_there(chain, data):
    """Any removal either undoes an insertion, or is refused."""
    links = data.draw(st.lists(st.sampled_from(chain.links), min_size=1, max_size=4, unique=True))
    for step, rise in removed(chain, links):
        assert counted(step.chain) == counted(chain) + rise
        assert generic_mobility(step.chain) in (
            {generic_mobility(chain)} | ({generic_mobility(chain) + 1} if rise else set())
        )


@given(chains(pairs=("revolute", "revolute", "prismatic"), most_links=5), st.data())
@settings(max_examples=60)
def test_a_derivation_is_done_again_and_derive_finds_its_chain(chain, data):
    way = Derivation(chain)
    for _ in range(data.draw(st.integers(1, 3))):
        form = data.draw(st.sampled_from(FORMS))
        way = way.then("insert_dyad", form=form, between=data.draw(two_places(way.chain, form[0] + form[2])))
    assert way.replayed() == way
    assert Derivation.from_json(json.dumps(way.to_json())) == way
    assert way.explain("de") != way.explain()
    growth = derive(way.chain)
    assert growth.exact
    assert growth.derivation.chain == way.chain
    assert counted(growth.core) == counted(way.chain)
    assert set(growth.core.links) <= set(way.chain.links)
    assert growth.explain("de") != growth.explain()


RECORD = insert_dyad(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), "RRR", ["0", 1], ["one", "two"])


def takes_record(chain):
    """Whether the dyad of the record has a place: on link 0, and in a turning joint of other links."""
    joint = chain.joints[1]
    return joint.pair.name == "revolute" and "0" not in joint.links


@given(ANY.filter(takes_record))
@settings(max_examples=50)
def test_replay_on_another_chain_with_these_places(chain):
    other = replay(chain, RECORD.kind, RECORD.where)
    assert counted(other.chain) == counted(chain)
    assert set(other.chain.links) == {*chain.links, "one", "two"}


@given(ANY.filter(lambda chain: not takes_record(chain)))
@settings(max_examples=50)
def test_replay_on_another_chain_without_these_places_is_refused(chain):
    with pytest.raises(TransformationError, match=r"places of the dyad|a further link|no further link"):
        replay(chain, RECORD.kind, RECORD.where)
