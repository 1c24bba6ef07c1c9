"""Places of joints: what is accepted, and what is refused in one sentence."""

import pickle
from math import inf, nan, pi

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import Closing, JointPlace, SpatialLinkage, common_group
from gruebler.mechanics.screws.motion_groups import MotionGroupKind
from gruebler.structure.mechanism import Mechanism
from tests.mechanics.screws import machines

WINCH = Mechanism.parse("spatial: R(frame-spindle) H(spindle-nut) P(frame-nut)")
GOOD = {0: {"z": (0, 0, 1)}, 1: {"z": (0, 0, 1), "pitch": 0.8}, 2: {"x": (0, 0, 2), "at": (0, 5, 0)}}
FRICTION = Mechanism.parse("R(0-1) R(0-2) W(1-2)")
WHEELS = {0: (0, 0), 1: (5, 0), 2: {"at": (3, 0), "y": (1, 0), "radii": (3, 2)}}


@pytest.mark.parametrize(
    ("mechanism", "change", "words"),
    [
        (WINCH, {2: None}, r"P\(frame-nut\) has no place"),
        (WINCH, {0: {"at": (0, 0, 0)}}, r"R\(frame-spindle\): a revolute joint needs its z axis"),
        (WINCH, {0: {"z": (0, 0, 0)}}, "a direction is not zero"),
        (WINCH, {0: {"z": (0, 0, nan)}}, "expected a number below 1e100"),
        (WINCH, {0: {"z": (0, 1)}}, "expected 3 numbers"),
        (WINCH, {0: {"z": "up"}}, "expected 3 numbers"),
        (WINCH, {0: {"z": (0, 0, 1), "pitch": 1}}, "a revolute joint has no pitch"),
        (WINCH, {0: {"z": (0, 0, 1), "y": (0, 1, 1)}}, "at right angles"),
        (WINCH, {0: {"z": (0, 0, 1), "pich": 1}}, "unknown key 'pich'"),
        (WINCH, {0: {"z": (0, 0, 1), "radii": (1, 2)}}, "has no radii"),
        (WINCH, {"R(frame-nut)": {}}, "is not one of the joints"),
        (FRICTION, {0: (0, 0, 1)}, "a plane has two coordinates"),
        (FRICTION, {2: {"at": (3, 0), "y": (1, 0)}}, "needs the two radii"),
        (FRICTION, {2: {"at": (3, 0), "radii": (3, 2)}}, "needs its y axis"),
        (FRICTION, {2: {"at": (3, 0), "y": (1, 0), "radii": (3, -3)}}, "touch all along"),
        (FRICTION, {2: {"at": (3, 0), "y": (1, 0), "radii": (3, inf)}}, "need finite radii"),
        (FRICTION, {2: {"at": (3, 0), "y": (1, 0), "radii": 3}}, "expected two numbers"),
        (FRICTION, {2: {"at": (3, 0), "y": (1, 0), "radii": (3, 2), "pressure": 0.3}}, "pressure angle"),
    ],
)
def test_refusals(mechanism, change, words):
    joints = (GOOD if mechanism is WINCH else WHEELS) | change
    with pytest.raises(LinkageError, match=words):
        SpatialLinkage(mechanism, {k: v for k, v in joints.items() if v is not None})


def test_a_value():
    one, other = SpatialLinkage(WINCH, GOOD), SpatialLinkage(WINCH, dict(reversed(GOOD.items())))
    assert one == other
    assert hash(one) == hash(other)
    assert pickle.loads(pickle.dumps(one)) == one
    assert repr(one).startswith("<spatial linkage spatial: R(frame-spindle)")
    assert one.places[1] == JointPlace(z=(0, 0, 1), pitch=0.8)
    with pytest.raises(LinkageError, match="rigid motion"):
        one.moved(2 * np.eye(4))
    with pytest.raises(LinkageError, match="positive number"):
        one.scaled(0.0)


GROUPS = {
    "winch": (machines.winch(), MotionGroupKind.CYLINDER, 2),
    "tilted winch": (machines.winch(0.1), MotionGroupKind.PARALLEL, 4),
    "hooke": (machines.hooke(), MotionGroupKind.SPHERE, 3),
    "oldham": (machines.oldham(), MotionGroupKind.PLANE, 3),
    "bennett": (machines.bennett()[0], MotionGroupKind.SPACE, 6),
    "sarrus": (machines.sarrus(), MotionGroupKind.SPACE, 6),
    "locomotive": (machines.locomotive(2), MotionGroupKind.PLANE, 3),
    "bevel": (machines.bevel(1), MotionGroupKind.SPHERE, 3),
}


@pytest.mark.parametrize("name", GROUPS)
def test_the_group_of_all_motions(name):
    linkage, kind, dimension = GROUPS[name]
    for made in (linkage, machines.elsewhere(linkage), linkage.scaled(7)):
        closing = Closing.of(made)
        assert common_group(closing, closing.reference) == (kind, dimension)


def test_shifts_are_a_group():
    wedges = SpatialLinkage(
        Mechanism.parse("spatial: P(0-1) P(1-2) P(2-3) P(3-0)"),
        {k: {"x": x} for k, x in enumerate([(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)])},
    )
    closing = Closing.of(wedges)
    assert common_group(closing, closing.reference) == (MotionGroupKind.TRANSLATIONS, 3)
    assert pi > closing.unknowns / 6 == 3
