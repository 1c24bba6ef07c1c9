"""Wrong calls of the layout raise; nothing that stands in an array makes it crash."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

X, SEGMENTS, WATCHED = np.array([[0.0, 0], [1, 0], [0, 1]]), np.array([[0, 1], [1, 2]]), np.array([[0, 2], [1, 0]])
GOOD = {
    "layout": X,
    "segments": SEGMENTS,
    "pull": np.ones(2),
    "watched": WATCHED,
    "images": np.arange(3)[None],
    "turns": np.eye(2)[None],
    "power": 2,
    "rounds": 5,
}


@pytest.mark.parametrize(
    "wrong",
    [
        {"layout": None},
        {"layout": X.tolist()},
        {"layout": X.astype(np.float32)},
        {"layout": X[0]},
        {"layout": np.zeros((3, 3))},
        {"layout": np.asfortranarray(X)},
        {"segments": SEGMENTS.astype(np.int32)},
        {"segments": SEGMENTS.astype(float)},
        {"segments": SEGMENTS.ravel()},
        {"pull": np.ones((2, 1))},
        {"pull": np.ones(2, int)},
        {"watched": WATCHED.astype(np.uint64)},
        {"images": np.arange(3)},
        {"turns": np.eye(2)},
        {"turns": np.ones((1, 2, 3))},
        {"power": 2.0},
        {"power": 2**31},
        {"rounds": 2**63},
        {"rounds": None},
    ],
    ids=str,
)
def test_wrong_kinds(core, wrong):
    with pytest.raises(TypeError, match="incompatible function arguments"):
        core.relax(**{**GOOD, **wrong})


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"segments": SEGMENTS + 1}, "a segment ends at a point that is none"),
        ({"segments": SEGMENTS - 1}, "a segment ends at a point that is none"),
        ({"layout": X[:0]}, "a segment ends at a point that is none"),
        ({"watched": WATCHED + np.array([1, 0])}, "a watched pair is a segment and a point"),
        ({"watched": WATCHED + np.array([0, 1])}, "a watched pair is a segment and a point"),
        ({"watched": -WATCHED}, "a watched pair is a segment and a point"),
        ({"pull": np.ones(3)}, "pull must have a number for each segment"),
        ({"images": np.arange(2)[None]}, "images must have a row for each turn and a column for each point"),
        ({"turns": np.ones((2, 2, 2))}, "images must have a row for each turn"),
        ({"images": np.array([[0, 1, 3]])}, "an image is a point that is none"),
        ({"power": 3}, "the power is an even number from 2 to 20"),
        ({"power": 0}, "the power is an even number"),
        ({"power": 22}, "the power is an even number"),
        ({"rounds": -1}, "the number of rounds is not negative"),
    ],
    ids=lambda value: value if isinstance(value, str) else str(*value),
)
def test_wrong_values(core, wrong, words):
    with pytest.raises(ValueError, match=words):
        core.relax(**{**GOOD, **wrong})


def test_wrong_pairs_of_the_others(core):
    for call in (core.closest, core.crossing_segments):
        arguments = (WATCHED,) if call is core.closest else ()
        with pytest.raises(ValueError, match="a segment ends at a point that is none"):
            call(X, SEGMENTS + 1, *arguments)
        with pytest.raises(TypeError, match="incompatible function arguments"):
            call(X[:, :1], SEGMENTS, *arguments)
    with pytest.raises(ValueError, match="a watched pair is a segment and a point"):
        core.closest(X, SEGMENTS, WATCHED + 2)


def test_nothing(core):
    none = np.zeros((0, 2), np.int64)
    x, energy = core.relax(X[:0], none, np.zeros(0), none, none[:, :0], np.zeros((0, 2, 2)), 2, 10**9)
    assert x.shape == (0, 2)
    assert energy == 0
    assert core.closest(X, none, none) == np.inf
    assert core.crossing_segments(X[:0], none).shape == (0, 2)


ODD = st.sampled_from([0.0, 1.0, -2.5, 1e-300, 1e160, 1e308, np.inf, -np.inf, np.nan])


@given(
    st.lists(ODD, min_size=6, max_size=6), st.lists(ODD, min_size=2, max_size=2), st.lists(ODD, min_size=4, max_size=4)
)
def test_any_numbers(core, layout, pull, turns):
    x = np.array(layout).reshape(3, 2)
    images, plane = np.array([[0, 1, 2], [1, 2, 0]]), np.array([np.eye(2), np.array(turns).reshape(2, 2)])
    relaxed, _ = core.relax(x, SEGMENTS, np.array(pull), WATCHED, images, plane, 6, 100)
    assert relaxed.shape == (3, 2)
    assert not core.closest(x, SEGMENTS, WATCHED) < 0
    assert len(core.crossing_segments(x, SEGMENTS)) == 0
