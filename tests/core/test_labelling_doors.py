"""Wrong calls of the labelling raise; nothing that stands in an array makes it crash."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

EDGES = np.array([[0, 1], [1, 2]], np.int32)
VERTICES, COLOURS = np.zeros(3, np.int64), np.zeros(2, np.int32)
BOUNDS = np.array([0, 1, 2])


@pytest.mark.parametrize(
    "arguments",
    [
        (3, VERTICES.astype(np.int32), EDGES, COLOURS),
        (3, VERTICES, EDGES.astype(np.int64), COLOURS),
        (3, VERTICES, EDGES, COLOURS.astype(np.int64)),
        (3, VERTICES, EDGES.astype(float), COLOURS),
        (3, VERTICES, EDGES.ravel(), COLOURS),
        (3, VERTICES, EDGES[:, :1], COLOURS),
        (3, VERTICES, np.asfortranarray(EDGES), COLOURS),
        (3, np.zeros(6, np.int64)[::2], EDGES, COLOURS),
        (3, None, EDGES, COLOURS),
        (3, [0, 0, 0], EDGES, COLOURS),
        (2**31, VERTICES, EDGES, COLOURS),
        (3.0, VERTICES, EDGES, COLOURS),
        (float("nan"), VERTICES, EDGES, COLOURS),
    ],
)
def test_wrong_kinds(core, arguments):
    with pytest.raises(TypeError, match="incompatible function arguments"):
        core.canonical_form(*arguments)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((-1, VERTICES, EDGES, COLOURS), "not negative"),
        ((2, VERTICES[:2], EDGES, COLOURS), "edge 1 ends at a vertex beyond 0..1"),
        ((3, VERTICES, -EDGES, COLOURS), "edge 0 ends"),
        ((3, VERTICES, EDGES // 2, COLOURS), "edge 0 is a loop"),
        ((3, VERTICES[:2], EDGES, COLOURS), r"vertex_colour must have the shape \(3,\)"),
        ((3, VERTICES, EDGES, COLOURS[:1]), r"edge_colour must have the shape \(2,\)"),
        ((3, VERTICES - 1, EDGES, COLOURS), "vertex_colour must lie in"),
        ((3, VERTICES + 2**31, EDGES, COLOURS), "vertex_colour must lie in"),
        ((3, VERTICES, EDGES, COLOURS - 1), "edge_colour must lie in"),
    ],
)
def test_wrong_values(core, arguments, words):
    with pytest.raises(ValueError, match=words):
        core.canonical_form(*arguments)


@pytest.mark.parametrize("bounds", [[], [0], [0, 1], [1, 2], [0, 3], [0, 2, 1, 2], [0, -1, 2], [0, 2**62, 2]])
def test_wrong_bounds(core, bounds):
    with pytest.raises(ValueError, match="bounds must ascend"):
        core.canonical_bulk(3, EDGES, np.array(bounds, np.int64))


def test_largest_colours(core):
    most = 2**31 - 1
    places, _, _, _ = core.canonical_form(3, np.array([most, 0, most]), EDGES, np.full(2, most, np.int32))
    assert places[1] == 0


def test_nothing(core):
    none = np.zeros((0, 2), np.int32)
    shapes = [array.shape for array in core.canonical_form(0, VERTICES[:0], none, COLOURS[:0])]
    assert shapes == [(0,), (0, 0), (0,), (0,)]
    assert core.canonical_bulk(0, none, BOUNDS[:1]).shape == (0, 0)
    assert sorted(core.canonical_bulk(3, none, np.zeros(2, np.int64))[0].tolist()) == [0, 1, 2]


@given(st.integers(0, 9), st.lists(st.tuples(st.integers(-1, 9), st.integers(-1, 9)), max_size=20))
def test_any_edges(core, n, edges):
    ends = np.array(edges, np.int32).reshape(-1, 2)
    fit = all(0 <= v < n for edge in edges for v in edge) and all(u != v for u, v in edges)
    try:
        places, _, orbits, _ = core.canonical_form(n, np.zeros(n, np.int64), ends, np.zeros(len(ends), np.int32))
    except ValueError:
        assert not fit
    else:
        assert fit
        assert sorted(places.tolist()) == list(range(n))
        assert (orbits <= np.arange(n)).all()
