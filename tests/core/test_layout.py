"""Layouts in the core: against the energy written down, known shapes, and steps of the kernel in Python before."""

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

ALONE, PLANE = np.arange(9)[None], np.eye(2)[None]


def example(seed, n=9):
    """A ring of n points with some chords, all points watched: layout, segments, pull, watched."""
    rng = np.random.default_rng(seed)
    angles = 2 * np.pi * np.arange(n) / n
    x = np.stack([np.cos(angles), np.sin(angles)], axis=1) + rng.normal(scale=0.05, size=(n, 2))
    segments = np.array([*((k, (k + 1) % n) for k in range(n)), (0, 3), (3, 6)])
    pull = rng.uniform(0.5, 4, len(segments)) * (rng.random(len(segments)) < 0.9)
    watched = np.array([(s, p) for s, ends in enumerate(segments) for p in range(n) if p not in ends])
    return x, segments, pull, watched


def energy(x, segments, pull, watched, power):
    """Sum of pull |segment|^2 and of distance^-power."""
    total = sum(k * np.sum((x[b] - x[a]) ** 2) for k, (a, b) in zip(pull, segments, strict=True))
    for s, p in watched:
        a, b = x[segments[s]]
        t = np.clip((x[p] - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        total += np.linalg.norm(x[p] - a - t * (b - a)) ** -power
    return total


@pytest.mark.parametrize(
    ("power", "rounds", "least", "place"),
    [
        (2, 1, 92.7793163665289, (-1.1092297074330597, 0.4668145643878994)),
        (2, 30, 61.28399150949331, (-1.2864920352316602, 0.9422137724878022)),
        (6, 1, 431.62634139910716, (-1.111133198597643, 0.47315688618329266)),
        (6, 30, 42.80576621376917, (-1.2417866689031098, 0.9342579678229246)),
    ],
)
def test_the_same_steps_as_in_python(core, power, rounds, least, place):
    """Not the same bits: there powers were those of the library of C, here they are products."""
    relaxed, found = core.relax(*example(3), ALONE, PLANE, power, rounds)
    assert found == pytest.approx(least, rel=1e-12)
    assert relaxed[4] == pytest.approx(place, rel=1e-10)


@pytest.mark.parametrize("power", [2, 6])
def test_relaxation_lowers_the_energy_to_a_minimum(core, power):
    x, segments, pull, watched = example(5)
    task = segments, pull, watched
    before = x.copy()
    relaxed, least = core.relax(x, *task, ALONE, PLANE, power, 5000)
    assert (x == before).all()
    assert least == pytest.approx(energy(relaxed, *task, power), rel=1e-12)
    assert least < energy(x, *task, power)
    rng = np.random.default_rng(6)
    for _ in range(50):  # no place near by is better by more than the last step was
        assert energy(relaxed + 1e-3 * rng.normal(size=x.shape), *task, power) > least * (1 - 1e-4)


def test_a_square_keeps_its_symmetry(core):
    """Of side a the energy is 4 a^2 + 8/a^2: least at a^4 = 2."""
    turns = np.array([[[1, 0], [0, 1]], [[0, -1], [1, 0]], [[-1, 0], [0, -1]], [[0, 1], [-1, 0]]], float)
    images = (np.arange(4) + np.arange(4)[:, None]) % 4
    segments = np.array([(0, 1), (1, 2), (2, 3), (3, 0)])
    watched = np.array([(s, p) for s in range(4) for p in range(4) if p not in segments[s]])
    start = np.random.default_rng(1).normal(size=(4, 2))
    x, least = core.relax(start, segments, np.ones(4), watched, images, turns, 2, 500)
    assert least == pytest.approx(2 * 32**0.5, rel=1e-6)
    assert np.linalg.norm(x[1] - x[0]) == pytest.approx(2**0.25, rel=1e-3)
    for image, turn in zip(images, turns, strict=True):
        assert x[image] @ turn == pytest.approx(x, abs=1e-12)
    assert core.closest(x, segments, watched) == pytest.approx(2**0.25, rel=1e-3)


@given(st.integers(0, 2**32), st.integers(0, 14))
def test_distances_and_crossings_by_rational_numbers(core, seed, m):
    rng = np.random.default_rng(seed)
    x = rng.integers(-6, 7, (8, 2)).astype(float)
    pairs = list(combinations(range(8), 2))
    segments = np.array([pairs[k] for k in rng.permutation(len(pairs))[:m]], np.int64).reshape(-1, 2)
    watched = np.array([(s, p) for s in range(m) for p in range(8) if p not in segments[s]], np.int64).reshape(-1, 2)

    def side(a, b, c):
        return (x[b][0] - x[a][0]) * (x[c][1] - x[a][1]) - (x[b][1] - x[a][1]) * (x[c][0] - x[a][0])

    crossing = [
        [j, i]
        for i in range(m)
        for j in range(i)
        if len({*segments[i], *segments[j]}) == 4
        and side(*segments[i], segments[j][0]) * side(*segments[i], segments[j][1]) < 0
        and side(*segments[j], segments[i][0]) * side(*segments[j], segments[i][1]) < 0
    ]
    assert core.crossing_segments(x, segments).tolist() == crossing
    least = np.inf
    for s, p in watched:
        (ax, ay), (bx, by), (px, py) = ([Fraction(v) for v in x[k]] for k in (*segments[s], p))
        ux, uy, wx, wy = bx - ax, by - ay, px - ax, py - ay
        square = ux * ux + uy * uy
        t = min(max((ux * wx + uy * wy) / square, 0), 1) if square else 0
        least = min(least, float((wx - t * ux) ** 2 + (wy - t * uy) ** 2))
    assert core.closest(x, segments, watched) == pytest.approx(least**0.5, rel=1e-12, abs=1e-12)
