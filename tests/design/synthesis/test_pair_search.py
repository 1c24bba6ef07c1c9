"""Families of dyads: closed forms of all pairs against the verdict by motion, and the best pairs by a measure."""

from math import degrees, radians

import numpy as np
import pytest

from gruebler.design.synthesis import Demands, PositionTask, synthesise_positions
from gruebler.design.synthesis.dyad_families import guiding_dyads, sliding_sample
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, Displacements, misfit
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.pair_facts import pair_facts
from gruebler.design.synthesis.targets import body_targets, point_targets
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move

FOUR = [(2.071235, -0.032527, 19.8126), (2.036152, 1.429641, 44.4843), (0.706012, 1.606846, 68.1715)]
FOUR += [(0.329970, 2.223983, 92.2134)]
TASK = PositionTask([(x, y, np.radians(a)) for x, y, a in FOUR])


def _against_motion(seed, count, samples, kind=CRANK, *, in_order=True):
    """How often the closed form says yes, where `move` and the circuit of the linkage say the same."""
    rng = np.random.default_rng(seed)
    demands = Demands(in_order=in_order, size_ratio=60)
    angles = np.cumsum(rng.uniform(0.1, 0.5, count))
    z = np.cumsum(rng.uniform(0.2, 1, count) * np.exp(1j * rng.uniform(0, 2, count)))
    task = PositionTask(list(zip(z.real, z.imag, angles, strict=True)))
    family = guiding_dyads(task, 60)
    dyads = [dyad for dyad in family if not dyad.slides]
    second = dyads
    if kind != CRANK:
        second = [dyad for dyad in family if dyad.kind == kind] if count == 4 else sliding_sample(task, kind, Demands())
    facts = pair_facts(task, dyads, second, demands)
    met = facts.moves if in_order else facts.branch
    moving = np.argwhere(met & (facts.size_ratio < 50))
    others = np.argwhere(~met & (facts.size_ratio < 50))
    for pairs in (moving, others):
        for i, j in rng.permutation(pairs)[:samples]:
            linkage = linkage_of_dyads(dyads[i], second[j], complex(task.origins[0]), "mm")
            verdict = judge_design(linkage, body_targets(task, linkage), demands, "RR-RR").verdict
            assert verdict.accepted == met[i, j], (seed, i, j, verdict.reasons)
            if verdict.accepted:
                assert verdict.turns_fully == facts.turns[i, j]
                assert verdict.transmission == pytest.approx(facts.transmission[i, j], abs=2e-3)
                assert verdict.size_ratio == pytest.approx(facts.size_ratio[i, j], rel=1e-9)
    return len(moving)


@pytest.mark.parametrize(("count", "kind"), [(3, CRANK), (4, CRANK), (2, SLIDER), (3, SLIDER), (2, BLOCK), (3, BLOCK)])
def test_closed_forms_of_pairs_against_the_verdict_by_motion(count, kind):
    assert sum(_against_motion(seed, count, 2, kind) for seed in range(5)) > 100


@pytest.mark.parametrize(("count", "kind"), [(3, CRANK), (4, CRANK), (3, SLIDER), (3, BLOCK)])
def test_closed_forms_in_any_order_against_the_verdict_by_motion(count, kind):
    """Pairs that meet the positions on one branch: the angle on the shortest way through all."""
    assert sum(_against_motion(seed, count, 2, kind, in_order=False) for seed in range(5)) > 20


def test_the_shortest_way_in_any_order_by_hand():
    """A crank-rocker at crank angles 60, 200, 100, 150 degrees: its crank need not pass 0, where the angle is least.

    cos(mu) = (b^2 + c^2 - f^2)/(2 b c), f^2 = a^2 + d^2 - 2 a d cos(phi) from A to B0; at 60 degrees 5.5/15, most
    of the way from 60 to 200.
    """
    linkage = FourBar(1, 3, 2.5, 3.5).linkage({"P": (1.2, 0.8)})
    motion = move(linkage, np.radians([60, 100, 150, 200]))
    targets = point_targets("P", motion.complex_point("P")[[0, 3, 1, 2]], 1.0)
    design = judge_design(linkage.with_reference_pose(motion.pose(0)), targets, Demands(in_order=False), "RR-RR")
    assert np.diff(design.drives) == pytest.approx(np.radians([140, -100, 50]), abs=1e-6)
    assert np.cos(design.verdict.transmission) == pytest.approx(5.5 / 15, abs=1e-6)


@pytest.mark.parametrize("demands", [Demands(in_order=False), Demands()])
def test_the_shortest_way_is_taken_though_the_list_has_a_way_by_hand(demands):
    """At 60, 200 and 120 degrees: backwards 60, -160, -240 is a lap in the order of the list, 300 degrees and over 0.

    Where any order will do the crank goes from 60 to 200 only; cos(mu) as above, over 0 it is
    (b^2 + c^2 - (d - a)^2)/(2 b c) = 9/15.
    """
    linkage = FourBar(1, 3, 2.5, 3.5).linkage({"P": (1.2, 0.8)})
    motion = move(linkage, np.radians([60, 120, 200]))
    targets = point_targets("P", motion.complex_point("P")[[0, 2, 1]], 1.0)
    verdict = judge_design(linkage.with_reference_pose(motion.pose(0)), targets, demands, "RR-RR").verdict
    assert np.cos(verdict.transmission) == pytest.approx(9 / 15 if demands.in_order else 5.5 / 15, abs=1e-6)
    assert verdict.in_order  # of three on a lap the order is always kept


@pytest.mark.slow
@pytest.mark.parametrize("kind", [CRANK, SLIDER, BLOCK])
@pytest.mark.parametrize("count", [2, 3, 4])
def test_closed_forms_of_a_thousand_pairs_against_the_verdict_by_motion(count, kind):
    assert sum(_against_motion(seed, count, 5, kind) for seed in range(100, 200)) > 300


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("kind", [SLIDER, BLOCK])
def test_families_of_sliding_dyads_guide_the_body(count, kind):
    task = PositionTask([(0, 0, 0), (2, 1, 0.4), (3, 1, 0.9)][:count])
    given, origin, size = Displacements.of(task.origins, task.turns)
    dyads = sliding_sample(task, kind, Demands())
    assert len(dyads) > 50
    assert max(misfit(given, dyad.moved(1 / size, -origin / size)) for dyad in dyads) < 1e-11 * 1000


def test_sliding_dyads_are_found_by_the_demands():
    """Three positions have a slider-crank that turns fully at 40 degrees or more: a family of cranks by slides."""
    task = PositionTask([(0, 0, 0), (2, 1, 0.4), (3, 1, 0.9)])
    found = synthesise_positions(task, Demands(crank=True, transmission=np.radians(40)), number=8)
    forms = {design.form for design in found.designs}
    assert "RR-PR" in forms
    assert not [design for design in found.rejected if design.form == "RR-PR"]


def test_a_crank_is_found_where_a_grid_of_dyads_had_none():
    """Another program (900 points of the curves, all pairs, ratio below 20) came to 19.3 degrees over the full turn."""
    found = synthesise_positions(TASK, Demands(crank=True), number=4)
    best = found.designs[0]
    assert best.verdict.turns_fully
    assert best.verdict.size_ratio <= 20
    assert np.degrees(best.transmission_over_range) >= 19.3
    assert not [design for design in found.rejected if design.form == "RR-RR"]


def test_the_measure_that_is_asked_for_steers_the_search():
    by_angle = synthesise_positions(TASK, number=4).designs[0]
    by_size = synthesise_positions(TASK, number=4, sort=["size-ratio"]).sorted_by("size-ratio").designs[0]
    assert by_size.verdict.size_ratio < min(3.0, by_angle.verdict.size_ratio)


def test_where_there_is_none_the_tightest_demand_is_named():
    found = synthesise_positions(TASK, Demands(crank=True, transmission=np.radians(40)), number=4)
    assert not found.designs
    notes = " ".join(map(str, found.notes))
    assert "Four-bars that meet all demands: 0 of 89,102" in notes
    assert "Designs that meet all but the demand of a transmission angle of 40°: " in notes


def test_positions_in_any_order_lie_on_one_branch():
    """The fourth position lies between the second and the third: in order there is none. By `move` along the drive."""
    task = PositionTask([(0, 0, 0), (-1, 2, np.radians(25)), (-1, 3, np.radians(50)), (-2, 3, np.radians(40))])
    listed = synthesise_positions(task, number=4)
    assert not listed.designs
    found = synthesise_positions(task, Demands(in_order=False), number=16)
    meet = next(note.values["count"] for note in found.notes if "meet all demands" in note.text)
    assert f"Designs that meet all but the demand of the order of the targets: {meet:,}." in map(str, listed.notes)
    assert len(found.designs) > 2
    for design in found.designs:
        drives = np.array(design.drives)
        order = np.argsort(drives)
        assert (np.diff(order) < 0).any()
        assert (np.diff(order) > 0).any()
        assert design.linkage.mechanism.drives[0].turning
        first = int(np.flatnonzero(order == 0)[0])
        for targets in (order[first:], order[: first + 1][::-1]):  # from the first position to both ends
            places = np.arange(10 * len(targets) - 9) / 10
            motion = move(design.linkage, np.interp(places, np.arange(len(targets)), drives[targets]))
            assert motion.complete
            assert np.abs(motion.complex_point("P")[::10] - task.origins[targets]).max() < 1e-9 * task.size


def _best_of_forms(seed, count):
    """A random task, and the largest transmission angle that is found for each form without any demand."""
    rng = np.random.default_rng(seed)
    z = np.cumsum(rng.uniform(0.2, 1, count) * np.exp(1j * rng.uniform(0, 2.5, count)))
    angles = np.cumsum(rng.uniform(-0.2, 0.8, count))
    task = PositionTask(list(zip(z.real, z.imag, angles, strict=True)))
    best = {}
    for design in synthesise_positions(task).designs:
        best[design.form] = max(best.get(design.form, 0.0), design.verdict.transmission)
    return task, {form: angle for form, angle in best.items() if radians(5) < angle < radians(89.5)}


def _found_again(seed, count, forms=None):
    task, best = _best_of_forms(seed, count)
    for form, angle in list(best.items())[:forms]:
        found = synthesise_positions(task, Demands(transmission=angle - radians(0.1)))
        assert form in {design.form for design in found.designs}, (form, degrees(angle))
    return len(best)


def test_what_is_found_without_a_demand_is_found_with_it():
    """A demand just below the best angle: of the sample hardly one meets it, and those beside it do."""
    assert _found_again(10, 3, forms=2) >= 2


@pytest.mark.slow
@pytest.mark.parametrize("count", [2, 3, 4])
def test_what_is_found_for_random_tasks_is_found_with_a_demand(count):
    assert sum(_found_again(seed, count) for seed in range(10, 20)) >= 10
