"""Paths of modes and motions: a hand and a rod by hand; wrong calls raise."""

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


# A slide along x at 1 + h, tied by a rod of the length sqrt(2) to a hand (0, 1, 0) that turns about z.
ROD = {
    "nodes": np.array(
        [[-1, 0, 0, 1, -1, -1], [0, 0, 0, 1, -1, -1], [1, 2, 0, 1, 0, -1], [0, 1, 2, 1, 1, -1], [3, 0, 0, 1, -1, -1]]
    ),
    "rows": np.array([[2, 2, 4, 0, 0]]),
    "frames": np.tile(np.eye(4), (5, 1, 1)),
    "pitches": np.zeros(5),
    "lengths": np.array([np.sqrt(2)]),
    "gears": np.zeros((0, 2)),
}
ROD["frames"][1, 0, 3] = ROD["frames"][4, 1, 3] = 1
DRIVEN = {
    "start": np.zeros(2),
    "turns": np.zeros((0, 3, 3)),
    "passive": np.array([1]),
    "drives": np.array([0]),
    "links": np.array([4, -1, 2]),
    "rods": np.array([[1, 2, 0]]),  # between the origins of the slide and of the hand: it is seen along x at first
    "balls_of_rods": np.array([[[0, 0, 0], [0, 0, 0], [0, 0, 0], [np.sqrt(2), 0, 0], [0, 1.0, 0]]]),
    "unit": np.array([1.0, 0, 0, 0]),
    "values": np.array([[0.0], [0.5], [1.0]]),
    "rates": np.array([[[1.0]], [[0.3]], [[-0.1]]]).repeat(3, axis=1),
}


def turn_of_the_hand(h):
    """sin q = (1 - (1 + h)^2) / 2 (1 + h)"""
    return np.arcsin((1 - (1 + h) ** 2) / (2 * (1 + h)))


def test_the_rod_turns_the_hand_by_the_law_of_cosines_with_its_rates():
    series, poses, derivatives, passed, rows, part, gap, last, turns = _core.follow_linkage(**ROD | DRIVEN)
    assert (rows, part) == (3, 1)
    assert gap < 1e-14
    q = turn_of_the_hand(DRIVEN["values"][:, 0])
    np.testing.assert_allclose(series[0, :, 1], q, atol=1e-14)
    np.testing.assert_allclose(poses[0, :, 0, :2, 3], np.array([-np.sin(q), np.cos(q)]).T, atol=1e-14)
    slide = np.array([1 + DRIVEN["values"][:, 0], 0 * q]).T
    np.testing.assert_allclose(poses[0, :, 1, :2, 3], slide, atol=1e-14)
    rod = (poses[0, :, 0, :2, 3] - slide) / np.sqrt(2)
    np.testing.assert_allclose(poses[0, :, 1, :2, 0], rod, atol=1e-14)
    np.testing.assert_allclose(poses[0, :, 1, 2, :3], np.tile([0, 0, 1], (3, 1)), atol=1e-14)  # it turns about z
    assert not passed.any()
    assert derivatives.shape == (3, 1, 1)
    assert last.tolist() == series[0, -1].tolist()
    assert turns.shape == (0, 3, 3)
    # Cauchy's integral around the row by 32 points: the coefficients of Taylor without differences.
    t = 0.1 * np.exp(2j * np.pi * np.arange(32) / 32)
    for row, h in enumerate(DRIVEN["values"][:, 0]):
        taylor = np.fft.fft(turn_of_the_hand(h + t + 0.3 * t**2 - 0.1 * t**3)).real / 32 / 0.1 ** np.arange(32)
        np.testing.assert_allclose(series[:, row, 1], taylor[:4], atol=1e-11)


def test_a_path_may_begin_anywhere():
    whole = _core.follow_linkage(**ROD | DRIVEN)
    later = {"start": whole[0][0, 1], "values": np.array([[0.5], [1.0]]), "rates": DRIVEN["rates"][:, 1:].copy()}
    part = _core.follow_linkage(**ROD | DRIVEN | later)
    np.testing.assert_allclose(part[0], whole[0][:, 1:], atol=1e-13)
    np.testing.assert_allclose(part[1], whole[1][:, 1:], atol=1e-13)


def test_the_rod_is_open_by_what_it_misses():
    place = np.array([0.2, 0.1]), np.zeros((0, 3, 3))
    value, derivative = _core.open_linkage(**ROD, at=place[0], turns=place[1])

    def square(h, q):
        return (1 + h + np.sin(q)) ** 2 + np.cos(q) ** 2

    length = np.sqrt(2)
    np.testing.assert_allclose(value, [(square(0.2, 0.1) - 2) / (2 * length)], atol=1e-15)
    wanted = [(square(0.2 + 1e-20j, 0.1)).imag, (square(0.2, 0.1 + 1e-20j)).imag]
    np.testing.assert_allclose(derivative, [np.array(wanted) / (2 * length * 1e-20)], atol=1e-15)


def test_the_rod_ends_where_it_lies_in_line():
    *_, rows, part, _, last, _ = _core.follow_linkage(**ROD | DRIVEN | {"values": np.array([[0.0], [0.3], [2.5]])})
    assert rows == 2
    assert part == pytest.approx((np.sqrt(2) - 0.3) / 2.2, abs=1e-5)
    assert last[0] == pytest.approx(np.sqrt(2), abs=1e-5)


@pytest.mark.parametrize(
    "wrong",
    [
        {"nodes": ROD["nodes"] + np.eye(6, dtype=np.int64)[0]},
        {"nodes": ROD["nodes"] * 4},
        {"rows": np.array([[2, 2, 5, 0, 0]])},
        {"rows": np.array([[3, 2, 4, 0, 0]])},
        {"frames": np.zeros((4, 4, 4))},
        {"pitches": np.zeros(4)},
        {"lengths": np.zeros(2)},
        {"gears": np.zeros((0, 3))},
        {"start": np.zeros(1)},
        {"start": np.full(2, np.nan)},
        {"turns": np.eye(3)[None]},
        {"passive": np.array([2])},
        {"passive": np.array([1, 1])},
        {"drives": np.array([-1])},
        {"drives": np.array([0, 1])},
        {"links": np.array([5])},
        {"rods": np.array([[1, 3, 0]])},
        {"rods": np.zeros((0, 3), np.int64)},
        {"balls_of_rods": np.zeros((1, 4, 3))},
        {"unit": np.zeros(3)},
        {"values": np.zeros((3, 2))},
        {"values": np.zeros((2, 1))},
        {"values": np.full((3, 1), np.nan)},
        {"values": np.full((3, 1), np.inf)},
        {"values": np.full((3, 1), 1e300)},
        {"rates": np.zeros((4, 3, 1))},
        {"rates": np.zeros((1, 3, 1), complex)},
    ],
)
def test_wrong_calls_of_motions_raise(wrong):
    with pytest.raises((TypeError, ValueError)):
        _core.follow_linkage(**ROD | DRIVEN | wrong)
