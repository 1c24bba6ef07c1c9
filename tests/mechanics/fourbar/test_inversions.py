"""The mechanisms of a chain of given lengths: the same relative motion, names from the motion on every frame."""

import numpy as np
import pytest

from gruebler import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.base.errors import LinkageError
from gruebler.mechanics.analysis import motion_roles
from gruebler.mechanics.fourbar import double_slide_inversions, sized_inversions
from gruebler.mechanics.kinematics import circuit
from gruebler.structure.mechanism.inversion import family


def test_the_example_of_the_documents():
    german = {(each.frame, each.drive): each.type.in_language("de") for each in sized_inversions(FourBar(2, 5, 4, 5))}
    assert german[("d", "a")] == german[("b", "a")] == "Kurbelschwinge"
    assert german[("a", "b")] == german[("a", "d")] == "Doppelkurbel"
    assert german[("c", "b")].startswith("Doppelschwinge")


@pytest.mark.parametrize("lengths", [(2, 5, 4, 5), (25, 70, 40, 70), (40, 50, 45, 60), (7, 4, 6, 6)])
def test_four_bar_types_agree_with_the_motion(lengths):
    for each in sized_inversions(FourBar(*lengths)):
        roles = {link: str(role) for link, role in motion_roles(each.linkage).items()}
        other = next(
            link
            for joint in each.linkage.mechanism.chain.joints
            for link in joint.links
            if each.frame in joint.links and link not in (each.frame, each.drive)
        )
        moved = (roles[each.drive], roles[other])
        expected = {
            "crank-rocker": ("crank", "rocker"),
            "crank-rocker driven at the rocker": ("rocker", "crank"),
            "double crank": ("crank", "crank"),
            "Grashof double rocker (the coupler turns fully)": ("rocker", "rocker"),
            "triple rocker (no link turns fully)": ("rocker", "rocker"),
        }
        assert moved == expected[str(each.type)], (each.frame, each.drive)


@pytest.mark.parametrize("size", [SliderCrank(20, 50), SliderCrank(50, 20, 5), InvertedSliderCrank(30, 50, 4)])
def test_slider_crank_chain(size):
    a, b = size.a, getattr(size, "b", None) or size.d
    for each in sized_inversions(size):
        roles = {link: str(role) for link, role in motion_roles(each.linkage).items()}
        turns = {link for link in "ab" if roles[link] == "crank"}
        if each.frame == "a":
            assert ("turning guide" in str(each.type)) == (a < b)
        if each.frame == "b":
            assert ("turning guide" in str(each.type)) == (b < a)
        if each.frame == "d":
            assert (str(each.type) == "slider-crank") == (a < b) == ("a" in turns)
        assert family(each.linkage.mechanism) is not None


@pytest.mark.parametrize(
    "made",
    [*sized_inversions(FourBar(2, 5, 4, 5)), *sized_inversions(SliderCrank(20, 50)), *double_slide_inversions(40)],
)
def test_neighbours_move_against_each_other_as_in_the_chain(made):
    # The angle between two neighbouring links has the same range, whichever link is held.
    chain = made.linkage.mechanism.chain
    turning = [joint for joint in chain.joints if joint.pair.name == "revolute"]
    assert len(turning) >= 2
    for joint in turning:
        first, second = joint.links
        spans = []
        for linkage in (made.linkage, made.linkage.with_frame(first, second)):
            around = circuit(linkage)
            angle = around.angle(second) - around.angle(first)
            spans.append(np.ptp(angle))
        assert min(spans[0], 2 * np.pi) == pytest.approx(min(spans[1], 2 * np.pi), abs=2e-2)  # samples, not extremes


def test_with_frame_refuses_links_without_a_joint():
    with pytest.raises(LinkageError, match="coupler is not jointed to frame"):
        FourBar(25, 70, 40, 70).linkage().with_frame("frame", "coupler")


def test_double_slides_are_named_as_their_structures():
    for each in double_slide_inversions(40):
        assert family(each.linkage.mechanism) == str(each.type)


def test_lengths_that_cannot_be_assembled():
    with pytest.raises(LinkageError, match="cannot be assembled"):
        sized_inversions(FourBar(1, 2, 3, 10))
    with pytest.raises(LinkageError, match="cannot be assembled"):
        sized_inversions(SliderCrank(1, 2, 10))
