"""Linkages that are followed, against closed forms of the literature."""

from math import cos, pi, sin, tan

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.screws import Closing, SpatialLinkage, exponential, joint_value
from gruebler.structure.mechanism import Mechanism
from tests.mechanics.screws import machines
from tests.mechanics.screws.following import follow_joint

TURNS = np.linspace(0.2, 2 * pi + 0.2, 14)


def values(linkage, poses, joint):
    closing = Closing.of(linkage)
    return np.array([joint_value(closing, pose, joint) for pose in poses])


def same_angle(a, b):
    return abs((np.asarray(a) - b + pi) % (2 * pi) - pi).max() < 1e-9


@pytest.mark.parametrize("bend", [0.2, 0.7, 1.2])
def test_hookes_joint(bend):
    """tan β = tan α / cos δ with the driving fork in the plane of the shafts at home."""
    joint = machines.hooke(bend)
    out = values(joint, follow_joint(joint, "R(0-in)", TURNS), 3)
    assert same_angle(out, np.arctan2(np.sin(TURNS), np.cos(TURNS) * cos(bend)))


def test_two_cross_joints_with_equal_angles_keep_the_speed():
    even = machines.cardan(0.5, 0.5)
    assert same_angle(values(even, follow_joint(even, 0, TURNS), 3), TURNS)
    uneven = machines.cardan(0.5, 0.3)
    out = values(uneven, follow_joint(uneven, 0, TURNS), 3)
    assert not same_angle(out, TURNS)
    shaft = np.arctan2(np.sin(TURNS), np.cos(TURNS) * cos(0.5))  # Hooke's joint, then one the other way round
    assert same_angle(out, np.arctan2(np.sin(shaft) * cos(0.3), np.cos(shaft)))


@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_oldhams_coupling_keeps_the_angle(space):
    coupling = machines.oldham(space)
    assert same_angle(values(coupling, follow_joint(coupling, 0, TURNS), 3), TURNS)


def test_bennetts_linkage():
    """tan(θ1/2) tan(θ2/2) is constant: G. T. Bennett, A new mechanism, Engineering 76 (1903) 777-778."""
    alpha, beta = 0.7, 1.1
    linkage, end = machines.bennett(alpha=alpha, beta=beta, turn=1.0)
    assert end == pytest.approx(np.eye(4), abs=1e-12)
    turns = np.linspace(0.1, 1.5, 6)
    poses = follow_joint(linkage, 0, turns)
    ratio = sin((beta + alpha) / 2) / sin((beta - alpha) / 2)
    home = 2 * np.arctan(ratio / tan(0.5))
    # the first joint angle of the table is that of the joint that stands first, R(0-1)
    one = 1.0 + values(linkage, poses, 0)
    other = home + values(linkage, poses, 1)
    assert np.tan(one / 2) * np.tan(other / 2) == pytest.approx(ratio, rel=1e-9)


def test_sarrus_plate_moves_on_a_straight_line():
    linkage = machines.sarrus()
    poses = follow_joint(linkage, 0, [0.1, 0.3, 0.5])
    plate = poses[:, linkage.mechanism.chain.index("3")]
    assert abs(plate[:, :3, :3] - np.eye(3)).max() < 1e-10
    assert abs(plate[:, :2, 3]).max() < 1e-10
    assert abs(plate[:, 2, 3]).min() > 0.01


def test_a_screw_advances_by_its_lead():
    winch = machines.winch()
    pose = follow_joint(winch, 0, [30.0])[0]
    assert pose[2, 2, 3] * winch.size == pytest.approx(-0.8 * 30, abs=1e-9)  # the spindle turns forward in the nut


def test_a_four_bar_as_its_closed_form():
    bar = FourBar(25, 70, 40, 70)
    joints = {0: (0, 0), 1: (25, 0), 2: (0, 0), 3: (70, 0)}
    linkage = bar.linkage()
    from gruebler.mechanics.kinematics import move

    home = move(linkage, [0.0]).point("R(coupler-rocker)")[0]
    joints[2] = tuple(home)
    made = SpatialLinkage(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3)"), joints)
    turned = values(made, follow_joint(made, 0, TURNS), 3)
    expected = move(linkage, [0.0, *TURNS]).angle("rocker")
    assert same_angle(turned, expected[1:] - expected[0])


def test_what_cannot_be_reached_or_driven():
    locked = machines.toolbox(0.05)
    with pytest.raises(LinkageError, match=r"R\(0-1\) does not reach"):
        follow_joint(locked, 0, [0.3])
    with pytest.raises(LinkageError, match="only a revolute or prismatic joint"):
        follow_joint(machines.winch(), 1, [0.3])


def test_the_whole_moved_elsewhere_goes_the_same_way():
    joint = machines.hooke(0.6)
    moved = joint.moved(exponential([0.3, -0.5, 1.0, 2.0, 0.1, -3.0]))
    assert values(moved, follow_joint(moved, 0, TURNS), 3) == pytest.approx(
        values(joint, follow_joint(joint, 0, TURNS), 3)
    )
