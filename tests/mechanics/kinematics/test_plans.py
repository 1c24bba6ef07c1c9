"""The plan of a linkage is its own: linkages that differ in kind, order or sense never share one."""

from cmath import exp, rect
from math import pi

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics import designs, move
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Circle, Line, Linkage
from gruebler.structure.mechanism import Mechanism

DISC_AND_ARM = Mechanism.parse("R(frame-disc) G(disc-arm) R(arm-frame); drive=R(frame-disc)")
ON_DISC, ON_ARM, BASE = (1.5, 0.8547, 0.4), (1.3057, -0.5, 1.1), 3.0
"""Three numbers each: with a radius or with an angle, so that both linkages have the same pose 0.3, 1.9."""


def disc_and_arm(on_disc: type, on_arm: type) -> Linkage:
    """A circle on one link touches a line on the other; both turn about fixed pins, the arm's at (3, 0)."""
    return Linkage(
        DISC_AND_ARM,
        {
            "frame": {0: (0.0, 0.0), 2: (BASE, 0.0)},
            "disc": {0: (0.0, 0.0), 1: on_disc(*ON_DISC)},
            "arm": {1: on_arm(*ON_ARM), 2: (0.0, 0.0)},
        },
        reference_pose={"disc": (0.0, 0.0, 0.3), "arm": (BASE, 0.0, 1.9)},
    )


def touching(circle_on_disc: bool, disc: float, arm: float) -> float:
    """Distance of the circle's centre from the line less the radius, on the side where the circle lies at 0.3, 1.9."""
    on_disc, on_arm = exp(1j * disc) * complex(*ON_DISC[:2]), BASE + exp(1j * arm) * complex(*ON_ARM[:2])
    if circle_on_disc:
        return ((on_disc - on_arm) * rect(1, -arm - ON_ARM[2])).imag - ON_DISC[2]
    return -((on_arm - on_disc) * rect(1, -disc - ON_DISC[2])).imag - ON_ARM[2]


def arm_by_newton(circle_on_disc: bool, disc: float) -> float:
    """The arm's angle from the contact alone, from 1.9 on."""
    arm = 1.9
    for _ in range(50):
        slope = (touching(circle_on_disc, disc, arm + 1e-6) - touching(circle_on_disc, disc, arm - 1e-6)) / 2e-6
        arm -= touching(circle_on_disc, disc, arm) / slope
    return arm


def test_circle_and_line_exchanged_make_another_linkage():
    disc = [0.30, 0.35, 0.40]
    one, other = disc_and_arm(Circle, Line), disc_and_arm(Line, Circle)
    assert one != other
    expected = [[arm_by_newton(circle_on_disc, angle) for angle in disc] for circle_on_disc in (True, False)]
    assert abs(expected[0][0] - 1.9) < 1e-3 > abs(expected[1][0] - 1.9)  # both start where they are drawn
    assert abs(expected[0][2] - expected[1][2]) > 0.2  # and then they part
    found = [move(linkage, disc).angle("arm") for linkage in (one, other)]  # one after the other, plans kept
    np.testing.assert_allclose(found, expected, atol=1e-9)


def four_bar_driven_at_the_coupler(joint: str, first: str = "R(0-1)") -> Linkage:
    """Drawn with the crank at right angles to the frame; the drive is the joint of crank and coupler."""
    mechanism = Mechanism.parse(f"{first} {joint} R(2-3) R(0-3); drive={joint}")
    return Linkage.from_drawing(mechanism, {first: (0, 0), joint: (0, 20), "R(2-3)": (60, 40), "R(0-3)": (60, 0)})


def test_the_sense_of_a_drive_is_that_of_its_writing():
    """R(1-2) as a drive is link 2 against link 1, R(2-1) the other way round: opposite numbers are the same pose."""
    one, other = four_bar_driven_at_the_coupler("R(1-2)"), four_bar_driven_at_the_coupler("R(2-1)")
    assert one.mechanism == other.mechanism
    assert one != other
    forward, backward = move(one, [-1.2, -1.1]), move(other, [1.2, 1.1])
    for motion, sense in ((forward, 1), (backward, -1)):
        turned = motion.angle("2") - motion.angle("1")
        np.testing.assert_allclose(np.mod(turned + pi, 2 * pi) - pi, sense * motion.drives[:, 0], atol=1e-12)
    np.testing.assert_allclose(forward.angle("3"), backward.angle("3"), atol=1e-12)


def test_columns_of_a_motion_stand_in_the_order_of_the_links():
    """The same numbers of joints, the same elements: only the order in which the links are named differs."""
    one = four_bar_driven_at_the_coupler("R(1-2)")
    chain = one.mechanism.chain
    named_otherwise = type(chain)(chain.joints, links=chain.links[::-1], space=chain.space)
    other = Linkage(
        Mechanism(named_otherwise, "0", one.mechanism.drives), one._by_link(), reference_pose=one.reference_pose
    )
    assert one.mechanism == other.mechanism
    first, second = move(one, [-1.2]), move(other, [-1.2])
    assert second.linkage.mechanism.chain.links == chain.links[::-1]
    np.testing.assert_allclose(first.places[0, 0], second.places[0, 0, ::-1], atol=1e-12)


def test_the_same_sizes_are_not_given_to_joints_in_another_order():
    one = four_bar_driven_at_the_coupler("R(1-2)")
    with pytest.raises(LinkageError, match="the same chain"):
        one.with_mechanism(Mechanism.parse("R(0-1) R(2-1) R(2-3) R(0-3); drive=R(2-1)"))


def test_a_plan_is_found_again():
    one, again = disc_and_arm(Circle, Line), disc_and_arm(Circle, Line)
    assert one == again
    assert hash(one) == hash(again)
    assert cached_plan(one) is cached_plan(again)


def slotted(slot_on: str) -> Linkage:
    """An oscillating lever: the pin of one link in the slot of the other."""
    mechanism = Mechanism.parse("R(0-1) G(1-2) R(0-2); drive=R(0-1)")
    return Linkage.from_drawing(mechanism, {"R(0-1)": (0, 0), "G(1-2)": (0, 20, 0.5, slot_on), "R(0-2)": (50, 0)})


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (four_bar_driven_at_the_coupler("R(1-2)"), four_bar_driven_at_the_coupler("R(2-1)")),
        (slotted("1"), slotted("2")),
    ],
    ids=["sense of the drive", "pin and slot exchanged"],
)
def test_designs_are_of_one_kind(first, second):
    """Many designs share one plan, so their joints, drives and kinds of elements are the same."""
    with pytest.raises(LinkageError, match="design 1"):
        designs([first, second])
