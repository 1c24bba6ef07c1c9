"""Poses in which the joints can only just be closed, found from sizes alone; and poses that are only near to such."""

from math import atan2

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import Evidence, SpatialLinkage, freedoms, joint_value
from gruebler.mechanics.screws.closed_poses import closed_pose
from gruebler.mechanics.screws.double_roots import refined_at_double_root
from gruebler.mechanics.screws.finite_mobility import finite_mobility
from gruebler.mechanics.screws.instant_mobility import instant_mobility
from gruebler.structure.mechanism import Mechanism
from tests.mechanics.screws import machines as m

ON_ONE_LINE = [
    FourBar(1, 2, 3, 6),
    FourBar(3, 4, 5, 12),
    FourBar(2, 2, 3, 7),
    FourBar(1, 1, 1, 3),
    FourBar(10, 20, 30, 60),
    FourBar(6, 1, 2, 3),
    FourBar(25, 70, 40, 135),
    SliderCrank(2, 3, 5),
    InvertedSliderCrank(2, 5, 7),
]


def triangle(*lengths):
    """A triangle of bars with these sides, without a home."""
    chain = Mechanism.parse("R(0-1) R(1-2) R(0-2); frame=0")
    a, b, c = lengths
    return Linkage(chain, {"0": {0: (0, 0), 2: (c, 0)}, "1": {0: (0, 0), 1: (a, 0)}, "2": {1: (0, 0), 2: (b, 0)}})


@pytest.mark.parametrize("size", ON_ONE_LINE, ids=repr)
def test_a_four_bar_on_one_line_has_one_position(size):
    """Two velocities, no motion: the frame is as long as all other links together."""
    found = freedoms(size.linkage())
    assert (found.instant.mobility, found.mobility, found.finite.evidence) == (2, 0, Evidence.STRESSED)
    assert found.instant.gap[1] < 1e-14  # the pose is exact, not one within the tolerance of the rank
    assert "proved" not in found.explain()


@given(st.lists(st.floats(0.1, 10), min_size=3, max_size=3))
@example([2.0, 3.0, 0.125])
@settings(max_examples=15, deadline=None)
def test_any_four_bar_on_one_line(lengths):
    found = freedoms(FourBar(*lengths, sum(lengths)).linkage())
    assert (found.instant.mobility, found.mobility) == (2, 0)


def test_two_such_four_bars_on_one_frame():
    """Two constraints become redundant at once."""
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3) R(0-4) R(4-5) R(5-6) R(0-6); frame=0")
    elements = {"0": {0: (0, 0), 3: (6, 0), 4: (0, 2), 7: (12, 2)}}
    for link, (first, length) in {"1": (0, 1), "2": (1, 2), "3": (2, 3), "4": (4, 3), "5": (5, 4), "6": (6, 5)}.items():
        elements[link] = {first: (0, 0), first + 1: (length, 0)}
    found = freedoms(Linkage(mechanism, elements))
    assert (found.instant.mobility, found.mobility, found.finite.evidence) == (4, 0, Evidence.STRESSED)


def test_a_stretched_triangle_is_shaky():
    found = freedoms(triangle(1, 2, 3))
    assert (found.instant.mobility, found.mobility, found.finite.evidence) == (1, 0, Evidence.STRESSED)
    assert freedoms(triangle(1, 2, 2.9)).finite.evidence is Evidence.RIGID


def test_a_rounded_home_of_a_stretched_linkage():
    """A drawing that is off by 1e-7 is settled to the position there is."""
    home = {"0": (0, 0, 0), "1": (0, 0, 1e-7), "2": (1, 1e-7, -5e-8)}
    stretched = triangle(1, 2, 3).with_reference_pose(home)
    assert freedoms(stretched).instant.mobility == 1


def test_a_pose_with_an_error_proves_nothing():
    """The same pose before it is sharpened: its smallest singular value is only the pose's error."""
    closing, pose = closed_pose(FourBar(1, 2, 3, 6).linkage())
    random = np.random.default_rng(1)
    shifted = closing.settled(closing.moved(pose, 1e-3 * random.normal(size=closing.unknowns)))
    beside = instant_mobility(closing, shifted, 1e-8)
    assert (beside.mobility, beside.redundancy) == (1, 0)
    assert finite_mobility(beside).evidence is Evidence.BLURRED
    assert instant_mobility(closing, refined_at_double_root(closing, shifted), 1e-8).mobility == 2


def test_poses_that_are_regular_stay_where_they_are():
    closing, pose = closed_pose(FourBar(25, 70, 40, 70).linkage())
    assert refined_at_double_root(closing, pose) is pose
    almost = freedoms(FourBar(2, 5, 2, 5).linkage(), at=1e-6)
    assert (almost.instant.mobility, almost.finite.evidence) == (1, Evidence.REGULAR)


def test_the_default_pose_is_one_in_which_every_joint_moves():
    """A rhombus has circuits on which two joints stay closed; its sizes alone do not ask for them."""
    assert freedoms(FourBar(1, 1, 1, 1).linkage()).instant.immobile == ()


def test_several_drives_are_followed_together():
    """Three parallel cranks and an arm on their rod: constraints that repeat others are no obstacle for two drives."""
    text = "R(0-1) R(0-2) R(0-3) R(1-p) R(2-p) R(3-p) R(p-arm); frame=0; drive=R(0-1); drive=R(p-arm)"
    places = [(0, 0), (3, 0), (6, 0), (0.6, 0.8), (3.6, 0.8), (6.6, 0.8), (8, 2)]
    drawn = Linkage.from_drawing(Mechanism.parse(text), dict(enumerate(places)))
    for at in ((atan2(0.8, 0.6), 0.0), (0.4, -1.1), (-0.7, 3.0)):
        found = freedoms(drawn, at=at)
        assert (found.instant.mobility, found.mobility) == (2, 2)
        closing, pose = found.instant.closing, found.instant.pose
        assert [joint_value(closing, pose, joint) for joint in (0, 6)] == pytest.approx(at)


def test_home_screws_with_several_drives():
    text = "R(0-1) R(0-2) R(1-3) R(2-3) R(3-4) R(3-5) R(4-6) R(5-6); frame=0; drive=R(0-1); drive=R(3-4)"
    made = SpatialLinkage(Mechanism.parse(text), m.drafting().places)
    found = freedoms(made, at=[0.2, -0.3])
    assert [joint_value(found.instant.closing, found.instant.pose, k) for k in (0, 4)] == pytest.approx([0.2, -0.3])
    assert found.mobility == 2
    with pytest.raises(LinkageError, match=r"expected 2 drive values, one for each, but found 1"):
        freedoms(made, at=0.2)


def test_values_for_each_drive():
    with pytest.raises(LinkageError, match="expected 1 drive value, but found 2"):
        freedoms(m.hooke(), at=[0.1, 0.2])


@pytest.mark.parametrize(
    "scale", [1, pytest.param(1e-6, marks=pytest.mark.slow), pytest.param(1e6, marks=pytest.mark.slow)]
)
@pytest.mark.parametrize(
    "gap", [pytest.param(1e-7, marks=pytest.mark.slow), pytest.param(1e-9, marks=pytest.mark.slow), 1e-10]
)
def test_a_small_gap_is_a_gap(gap, scale):
    """Bars of 1 and 1 between pins that are a little more than 2 apart: no rounding, in no unit."""
    home = {"0": (0, 0, 0), "1": (0, 0, 0), "2": (1, 0, 0)}
    for linkage in (triangle(1, 1, 2 + gap), triangle(1, 1, 2 + gap).with_reference_pose(home)):
        with pytest.raises(LinkageError, match=r"closed|assembled"):
            freedoms(linkage.scaled(scale))
    assert freedoms(triangle(1, 1, 2).with_reference_pose(home)).mobility == 0
