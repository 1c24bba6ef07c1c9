"""Convex hulls, against Qhull and against what a hull is."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from gruebler.base.convex_hull import convex_hull


@pytest.mark.parametrize("seed", range(5))
def test_the_corners_are_those_of_qhull(seed):
    places = np.random.default_rng(seed).normal(size=(60, 2))
    corners = convex_hull(complex(x, y) for x, y in places)
    expected = places[ConvexHull(places).vertices]  # counter-clockwise
    first = int(np.argmin(expected[:, 0]))
    assert corners == [complex(x, y) for x, y in np.roll(expected, -first, axis=0)]


@given(st.lists(st.tuples(st.integers(-4, 4), st.integers(-4, 4)), min_size=1))
def test_every_place_is_inside_and_every_corner_is_sharp(numbers):
    places = [complex(x, y) for x, y in numbers]
    corners = convex_hull(places)
    assert set(corners) <= set(places)
    if len(corners) < 3:
        start, end = corners[0], corners[-1]
        assert all(((end - start).conjugate() * (z - start)).imag == 0 for z in places)
        return
    for a, b, c in zip(corners, corners[1:] + corners[:1], corners[2:] + corners[:2], strict=True):
        assert ((b - a).conjugate() * (c - b)).imag > 0
        assert all(((b - a).conjugate() * (z - a)).imag >= 0 for z in places)


def test_flat_corners_are_left_out():
    square = [0, 1, 1 + 1j, 1j]
    assert convex_hull([*square, 0.5 - 1e-12j, 1 + 1e-12]) == [0, 1, 1 + 1j, 1j]
    assert convex_hull([*square, 0.5 - 0.01j], 0.02) == [0, 1, 1 + 1j, 1j]
    assert len(convex_hull([*square, 0.5 - 0.01j], 0.005)) == 5
    assert convex_hull([3j]) == [3j]
    assert convex_hull([]) == []
