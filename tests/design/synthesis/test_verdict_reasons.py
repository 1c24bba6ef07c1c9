"""What a rejected design is said to do: whether its drive turns fully, how near it comes, and no reason that is untrue.

Against Grashof's inequality and the law of cosines by hand, and against poses close to each other.
"""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from gruebler.design.synthesis import Demands, PathTask, synthesise_path
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.targets import Probe, Targets, point_targets
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics.solve import move_quietly

CRANK_ROCKER, DOUBLE_ROCKER = FourBar(1, 3, 2.5, 3.5), FourBar(3, 2, 2.5, 4)
"""1 + 3.5 < 3 + 2.5, the crank being the shortest; 2 + 4 > 3 + 2.5: no link turns fully."""


def posed(four_bar, angles, branch="+"):
    """A four-bar at the first of some crank angles, and the places of its coupler point there."""
    linkage = four_bar.linkage({"P": (1.2, 0.8)})
    motion = move_quietly(linkage, np.radians(angles), branch=branch)
    return linkage.with_reference_pose(motion.pose(0)), motion.complex_point("P")


@pytest.mark.parametrize(("four_bar", "turns"), [(CRANK_ROCKER, True), (DOUBLE_ROCKER, False)])
@pytest.mark.parametrize("fault", ["another order", "cannot be reached"])
def test_a_drive_turns_fully_whatever_becomes_of_the_targets(four_bar, turns, fault):
    linkage, z = posed(four_bar, [20, 30, 40, 50, 60])
    z = z[[0, 2, 1, 4, 3]] if fault == "another order" else z + np.array([0, 0, 0.5, 0, 0])
    verdict = judge_design(linkage, point_targets("P", z, 1.0), Demands(), "four-bar").verdict
    assert [fault in str(reason) for reason in verdict.reasons] == [True]
    assert verdict.turns_fully == turns


def test_cranks_of_cognates_turn_by_their_own_lengths():
    """Nine points of a wave: each class of cognates is judged by one path, each crank by Grashof's inequality."""
    turn = np.array([0.3, 0.7, 1.1, 1.8, 2.2, 2.9, 3.3, 4.1, 4.6])
    z = 2 * np.cos(turn) + 1j * np.sin(turn) + 0.1 * np.cos(5 * turn)
    found = synthesise_path(PathTask([(w.real, w.imag) for w in z]), Demands(size_ratio=1e6))
    turning = []
    for design in found.rejected:
        linkage = design.linkage
        crank, coupler, rocker, frame = (
            abs(complex(*np.subtract(*[(e.x, e.y) for (_, owner), e in linkage.elements.items() if owner == link])))
            for link in ("crank", "coupler", "rocker", "frame")
        )
        lengths = sorted([crank, coupler, rocker, frame])
        turns = lengths[0] + lengths[3] < lengths[1] + lengths[2] and min(crank, frame) == lengths[0]
        assert design.verdict.turns_fully == turns
        turning.append(turns)
    assert 5 < sum(turning) < len(turning) - 5


def test_a_way_that_ends_has_no_second_reason_that_is_untrue():
    """Beyond the limit of the crank the linkage goes on in its other mode: two branches."""
    linkage, z = posed(DOUBLE_ROCKER, [20, 40])
    other = posed(DOUBLE_ROCKER, [40], "-")[1]
    targets = point_targets("P", np.append(z, other), 1.0)
    verdict = judge_design(linkage, targets, Demands(transmission=radians(10)), "four-bar").verdict
    assert list(map(str, verdict.reasons)) == ["the drive has to turn back between the targets (two branches)"]
    free = Demands(transmission=radians(10), one_branch=False)
    verdict = judge_design(linkage, targets, free, "four-bar").verdict
    assert list(map(str, verdict.reasons)) == ["where the drive turns back there is no transmission angle"]


def test_how_near_a_target_comes_is_the_least_distance():
    """Against places of the coupler point so close to each other that their chords bend by less than 1e-11 of it."""
    linkage, z = posed(CRANK_ROCKER, [20, 60, 100])
    wanted = np.array([z[0], z[1], z[2] + 1.2 + 1j])  # beyond the bend of the curve
    verdict = judge_design(linkage, point_targets("P", wanted, 1.0), Demands(), "four-bar").verdict
    turn = radians(20) + np.linspace(0, 2 * np.pi, 40_001)
    k = int(np.abs(move_quietly(linkage, turn).complex_point("P") - wanted[2]).argmin())
    finer = np.append(turn[0], np.linspace(turn[k - 1], turn[k + 1], 201))
    distances = np.abs(move_quietly(linkage, finer).complex_point("P")[1:] - wanted[2])
    assert verdict.error == pytest.approx(distances.min(), abs=1e-9)


def test_the_least_transmission_angle_beside_the_first_target():
    """The crank stands over the frame just after the first target, where mu is least: the law of cosines."""
    linkage, z = posed(CRANK_ROCKER, [-0.1, 30, 60, -40])
    verdict = judge_design(linkage, point_targets("P", z, 1.0), Demands(in_order=False), "four-bar").verdict
    cosine = (3**2 + 2.5**2 - (3.5 - 1) ** 2) / (2 * 3 * 2.5)
    assert verdict.accepted
    assert verdict.transmission == pytest.approx(np.arccos(cosine), abs=1e-9)


@pytest.mark.parametrize("seed", [0, 2, 12, 15, 19])
def test_exact_targets_among_others_are_met_in_any_order(seed):
    """A crank-rocker meets two targets exactly, three within 0.3, which are farther in the order of the list.

    The places are the circuit's: from polynomials between its samples exact targets were missed by up to 1e-8 (15, 19).
    """
    rng = np.random.default_rng(seed)
    linkage = FourBar(1, 1.6, 1.7, 1.9).linkage({"P": (1.5, 1.5)})
    motion = move_quietly(linkage, np.radians(rng.uniform(0, 360, 5)))
    z = motion.complex_point("P")
    z[2:] += 0.05 * (rng.normal(size=3) + 1j * rng.normal(size=3))
    targets = replace(point_targets("P", z, 1.0), allowed=np.array([0, 0, 0.3, 0.3, 0.3]))
    demands = Demands(in_order=False, tolerance=0.3)
    design = judge_design(linkage.with_reference_pose(motion.pose(0)), targets, demands, "four-bar")
    assert design.verdict.accepted
    misses = np.abs(move_quietly(design.linkage, design.drives).complex_point("P") - z)
    assert (misses <= [1e-9, 1e-9, 0.3, 0.3, 0.3]).all()


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-9])
def test_a_linkage_that_begins_at_a_dead_centre_goes_on_on_the_branch_of_its_targets(side, tolerance):
    """Frame 4, crank 3: at 90 degrees coupler and rocker lie in the line of 5. The outputs are those of two circles."""
    phi = np.radians([90, 80, 65, 50, 30])
    gap = 3 * np.exp(1j * phi) - 4
    angle = np.arccos(np.clip((9 + np.abs(gap) ** 2 - 4) / (6 * np.abs(gap)), -1, 1))
    values = np.stack([np.exp(1j * phi), gap / np.abs(gap) * np.exp(1j * side * angle)], axis=1)
    linkage, _ = posed(FourBar(3, 2, 3, 4), [90])
    targets = Targets((Probe(link="crank"), Probe(link="rocker")), values, 1.0)
    verdict = judge_design(linkage, targets, Demands(tolerance=tolerance), "four-bar").verdict
    assert verdict.reasons == ()
    assert verdict.error < max(tolerance / 100, 1e-9)
