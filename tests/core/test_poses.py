"""Poses of one linkage closed, moved and differentiated, against plain Python with differences and pseudoinverses."""

import numpy as np
import pytest

from gruebler.design.realisation import realise
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.structure.mechanism import Mechanism
from tests.core.plain.pose_gaps import pose_gaps, pose_slopes

LINKAGES = (
    "R(0-1) R(1-2) R(2-3) R(0-3); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) P(0-3); drive=R(0-1)",
    "R(0-1) R(1-2) P(2-3) R(0-3); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); drive=R(0-1)",
    "R(0-1) R(1-2) R(2-3) R(3-4) R(4-0); drive=R(0-1); drive=R(4-0)",
)
# Three wedges that slide along each other: the last angle follows from both before, and one motion is left.
WEDGES = np.array([[2, 0, 0, 3, 1], [0, 1, 6, 9, 1], [1, 2, 12, 15, 1]])
WEDGE_SIZES = np.array([0, 0, 0.0, 0, 0, 0, 1, 0, 1.0, 0, 0, 1, 3, 0, np.pi / 2, 0, 0, np.pi / 2])
PIN = np.array([[1, 0, 0, 2, 0]])


def linkage_of(text, seed=1):
    """Joints, a closed pose, dimensions, size."""
    linkage = realise(Mechanism.parse(text), seed=seed, budget=300).linkage
    closure = DesignClosure(linkage)
    pose = np.array([value for link in closure.links for value in linkage.required_pose[link]])
    return closure.joints, pose, closure.sizes, linkage.size


def weighted(size, count):
    return np.tile([size, size, 1.0], count // 3)


@pytest.mark.parametrize("text", LINKAGES)
def test_poses_are_closed_by_the_least_change(core, text):
    """Second method: Gauss and Newton by a pseudoinverse with weights, slopes by differences."""
    joints, pose, p, size = linkage_of(text)
    rng = np.random.default_rng(2)
    weights = weighted(size, len(pose))
    near = pose + 0.03 * weights * rng.normal(size=(6, len(pose)))
    closed, reached = core.close_poses(joints, near, p, size, 12)
    assert reached.all()
    for q, start in zip(closed, near, strict=True):
        assert np.abs(pose_gaps(joints, q, p)).max() < 1e-12 * size
        other = start.copy()
        for _ in range(12):
            jacobian = pose_slopes(joints, other, p)[0] * weights
            other -= weights * (np.linalg.pinv(jacobian) @ pose_gaps(joints, other, p))
        # Both are closed; that differences are not exact moves the other one a little along its freedom.
        assert (q - other) / weights == pytest.approx(np.zeros(len(q)), abs=1e-6)


@pytest.mark.parametrize("text", LINKAGES)
def test_poses_move_and_change_as_derived(core, text):
    """Second method: null space and pseudoinverse of slopes by differences."""
    joints, pose, p, size = linkage_of(text, seed=2)
    weights = weighted(size, len(pose))
    by_pose = np.random.default_rng(3).normal(size=(1, 4, len(pose)))
    (motion,) = core.move_poses(joints, pose[None], p, size)
    (gradients,) = core.pose_gradients(joints, pose[None], p, size, by_pose)
    jacobian, by_sizes = pose_slopes(joints, pose, p)
    for exact, by_differences in zip(core.pose_slopes(joints, pose[None], p), (jacobian, by_sizes), strict=True):
        assert exact[0] == pytest.approx(by_differences, abs=1e-7 * size)
    freedoms = len(pose) - np.linalg.matrix_rank(jacobian, tol=1e-6)
    assert motion.shape == (len(pose), freedoms)
    assert np.abs(jacobian @ motion).max() < 1e-7 * size
    along = motion / weights[:, None]
    assert along.T @ along == pytest.approx(np.eye(freedoms))
    changes = -weights[:, None] * (np.linalg.pinv(jacobian * weights, rcond=1e-6) @ by_sizes)
    expected = by_pose[0] @ changes
    assert gradients == pytest.approx(expected, abs=1e-7 * (1 + np.abs(expected).max()))


def test_a_condition_that_follows_from_others_is_left_out(core):
    """By hand: the wedge on the floor goes along it by 1, and the one that is guided upright rises by tan 1."""
    start = np.zeros((1, 6))
    closed, reached = core.close_poses(WEDGES, start, WEDGE_SIZES, 1.0, 12)
    assert reached.all()
    motion = core.move_poses(WEDGES, closed, WEDGE_SIZES, 1.0)[0, :, 0]
    assert motion[[1, 2, 3, 5]] == pytest.approx(0, abs=1e-12)
    assert motion[4] / motion[0] == pytest.approx(-np.tan(1))
    jacobian, _ = pose_slopes(WEDGES, closed[0], WEDGE_SIZES)
    assert np.linalg.matrix_rank(jacobian, tol=1e-6) == 5  # of six conditions


def test_poses_that_cannot_be_closed_are_told(core):
    """Two rods of length 1 whose ends are to meet the frame 3 apart."""
    joints = np.array([[2, 0, 0, 2, 0], [0, 1, 4, 6, 0], [2, 1, 8, 10, 0]])
    p = np.array([0, 0, 0, 0, 1.0, 0, 0, 0, 3, 0, 1, 0])
    q = np.array([[0, 0, 0, 1, 0, 0], [0, 0, np.nan, 1, 0, 0]])
    assert not core.close_poses(joints, q, p, 1.0, 12)[1].any()
    p[8] = 1.0  # an equilateral triangle
    closed, reached = core.close_poses(joints, q[:1] + 0.5, p, 1.0, 40)
    assert reached.all()
    assert np.abs(np.sin(closed[0, 2])) == pytest.approx(np.sin(np.pi / 3))


@pytest.mark.parametrize(
    ("joints", "words"),
    [
        (np.array([[2, 0, 0, 2, 0]]), "joins a body that is none"),
        (np.array([[1, -1, 0, 2, 0]]), "joins a body that is none"),
        (np.array([[1, 0, 0, 3, 0]]), "dimensions that are none"),
        (np.array([[1, 0, 0, 2, 1]]), "dimensions that are none"),
        (np.array([[1, 0, 0, 2, 2]]), "neither turns nor slides"),
        (np.tile(PIN, (2, 1)), "more equations than unknowns"),
    ],
)
def test_wrong_linkages_are_refused(core, joints, words):
    with pytest.raises(ValueError, match=words):
        core.close_poses(joints, np.zeros((1, 3)), np.zeros(4), 1.0, 12)


def test_wrong_calls_are_refused(core):
    with pytest.raises(ValueError, match="three numbers for each body"):
        core.move_poses(PIN, np.zeros((1, 4)), np.zeros(4), 1.0)
    with pytest.raises(ValueError, match="a moving body"):
        core.move_poses(np.zeros((0, 5), np.int64), np.zeros((1, 0)), np.zeros(4), 1.0)
    with pytest.raises(ValueError, match="a block for each pose"):
        core.pose_gradients(PIN, np.zeros((1, 3)), np.zeros(4), 1.0, np.zeros((1, 2, 4)))
