"""Paths of modes: a hand by hand; wrong calls raise."""

import numpy as np
import pytest

from gruebler import _core

# A hand that turns about z at the origin, its end on a sphere: |(cos q, sin q, 0) - (2, 0, 0)| = length.
NODES = np.array([[-1, 0, 0, 1, -1, -1], [0, 1, 2, 1, 0, -1], [1, 0, 0, 1, -1, -1], [0, 0, 0, 1, -1, -1]])


def hand(**changes):
    frames = np.tile(np.eye(4, dtype=complex), (4, 1, 1))
    frames[2, 0, 3], frames[3, 0, 3] = 1, 2
    call = {
        "nodes": NODES,
        "rows": np.array([[2, 2, 3, 0, 0]]),
        "frames": frames,
        "twists": np.zeros((4, 6), complex),
        "lengths": np.array([[np.sqrt(5)], [1.2 - np.sqrt(5)]], complex),
        "given": np.zeros((2, 4), complex),
        "starts": np.array([[np.pi / 2], [-np.pi / 2]], complex),
        "turns": np.zeros((2, 0, 3, 3), complex),
        "loose": 1e-3,
    }
    return _core.follow_modes(**call | changes)


def test_the_hand_follows_the_law_of_cosines():
    ends, turns, frames, times, steps = hand()
    angle = np.arccos((1 + 4 - 1.2**2) / 4)
    np.testing.assert_allclose(ends, [[angle], [-angle]], atol=1e-14)
    np.testing.assert_allclose(frames[0, 2, :3, 3], [np.cos(angle), np.sin(angle), 0], atol=1e-14)
    assert times.tolist() == [1, 1]
    assert (steps > 1).all()
    assert turns.shape == (2, 0, 3, 3)


def test_where_the_law_of_cosines_has_none_the_modes_are_complex_and_on_the_border_no_path_arrives():
    angle = np.arccos((1 + 4 - 0.5**2 + 0j) / 4)
    start, length = np.array([[np.pi / 2]], complex), np.array([[np.sqrt(5)], [0.5 - np.sqrt(5)]], complex)
    single = {"turns": np.zeros((1, 0, 3, 3), complex), "starts": start}
    # Straight on the real line it meets a double mode; by a complex corner it does not.
    *_, times, _ = hand(lengths=length, **single)
    assert times[0] < 1
    corner = np.array([[np.sqrt(5)], [1 + 0.5j - np.sqrt(5)]], complex)
    ends, *_ = hand(lengths=corner, **single)
    ends, _, _, times, _ = hand(lengths=np.array([[1 + 0.5j], [-0.5 - 0.5j]], complex), **single | {"starts": ends})
    assert times[0] == 1
    assert abs(abs(ends[0, 0]) - abs(angle)) < 1e-13


def test_a_dimension_that_turns_takes_the_mode_along():
    twists = np.zeros((4, 6), complex)
    twists[0, 2] = 0.7  # all stands on the frame, which turns
    _, _, frames, _, _ = hand(twists=twists, lengths=np.array([[np.sqrt(5)], [0]], complex))
    np.testing.assert_allclose(frames[0, 2, :3, 3], [-np.sin(0.7), np.cos(0.7), 0], atol=1e-14)


@pytest.mark.parametrize(
    "wrong",
    [
        {"nodes": NODES.astype(float)},
        {"nodes": NODES[:, :5].copy()},
        {"nodes": NODES + np.eye(6, dtype=np.int64)[0]},
        {"nodes": NODES[[0, 1, 1, 3]]},
        {"nodes": NODES[:3]},
        {"rows": np.array([[2, 2, 4, 0, 0]])},
        {"rows": np.zeros((2, 5), np.int64)},
        {"frames": np.zeros((4, 4, 4))},
        {"frames": np.zeros((3, 4, 4), complex)},
        {"lengths": np.zeros((2, 2), complex)},
        {"given": np.zeros((2, 3), complex)},
        {"starts": np.zeros((2, 2), complex)},
        {"turns": np.zeros((1, 0, 3, 3), complex)},
        {"turns": np.zeros((2, 1, 3, 3), complex)},
        {"loose": 0.0},
    ],
)
def test_wrong_calls_raise(wrong):
    with pytest.raises((TypeError, ValueError)):
        hand(**wrong)


def test_numbers_that_are_none_end():
    *_, times, _ = hand(starts=np.full((2, 1), np.nan, complex))
    assert (times < 1).all()
