"""Distances from smooth curves, places evenly along them, steps within limits: against scipy and by hand."""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq, linprog, minimize

NONE = np.zeros(0)


def ellipse(count=40):
    """Samples of an ellipse with rates by the parameter, which stands for the arc; the first one again at the end."""
    turn = np.linspace(0, 2 * np.pi, count + 1)
    return turn, (3 * np.cos(turn) + 1j * np.sin(turn))[:, None], (-3 * np.sin(turn) + 1j * np.cos(turn))[:, None]


def test_levels_and_extremes_of_distances_against_another_program(core):
    arcs, values, rates = ellipse()
    spline = CubicHermiteSpline(arcs, values[:, 0], rates[:, 0])
    target = 0.4 + 0.3j

    def half_square(t):
        return abs(spline(t) - target) ** 2 / 2

    def slope(t):
        return np.real(np.conj(spline(t) - target) * spline(t, 1))

    low, high = np.array([1.2]), np.array([3.0])  # the distance grows from the top of the ellipse to its left end
    level = half_square(2.2)
    call = arcs, values, rates, True, np.array([[target]]), np.zeros(1, np.int64)
    found = core.settle_arcs(*call, low, high, (low + high) / 2, np.array([level]), 1.0)
    assert found == pytest.approx([brentq(lambda t: half_square(t) - level, 1.6, 3.0, xtol=1e-14)], abs=1e-11)
    assert found == pytest.approx([2.2], abs=1e-11)
    for a, b, rises in ((0.8, 2.2, 1.0), (2.5, 4.0, -1.0)):
        ends = np.array([a]), np.array([b])
        at = core.settle_arcs(*call, *ends, (ends[0] + ends[1]) / 2, NONE, rises)
        assert at == pytest.approx([brentq(slope, a, b, xtol=1e-14)], abs=1e-11)
        lap = 2 * np.pi  # the same a lap later, since arcs wrap around
        later = core.settle_arcs(*call, ends[0] + lap, ends[1] + lap, (ends[0] + ends[1]) / 2 + lap, NONE, rises)
        assert later - lap == pytest.approx(at, abs=1e-11)


def test_free_parts_do_not_count_and_empty_brackets_stay(core):
    arcs, values, rates = ellipse()
    both = np.concatenate([values, 1j * values], axis=1), np.concatenate([rates, 1j * rates], axis=1)
    targets = np.array([[0.4 + 0.3j, np.nan], [0.4 + 0.3j, 2j]])
    low, high = np.array([0.8, 0.8, 1.0]), np.array([2.2, 2.2, 1.0])
    start = np.array([1.5, 1.5, 1.0])
    at = core.settle_arcs(arcs, *both, True, targets, np.array([0, 1, 1]), low, high, start, NONE, 1.0)
    alone = core.settle_arcs(
        arcs, values, rates, True, targets[:, :1].copy(), np.zeros(1, np.int64), low[:1], high[:1], start[:1], NONE, 1.0
    )
    assert at[0] == alone[0]
    assert at[1] != alone[0]
    assert at[2] == 1.0


def test_places_evenly_along_curves_against_another_program(core):
    rng = np.random.default_rng(4)
    phi = np.linspace(0, 2 * np.pi, 33)
    z = np.cumsum(rng.normal(size=(5, 33)) + 1j * rng.normal(size=(5, 33)), axis=1)
    z[2, 5:8] = z[2, 5]  # it rests there
    for row, own in zip(z, core.spread_evenly(z, phi, 20), strict=True):
        arcs = np.append(0, np.cumsum(np.abs(np.diff(row))))
        assert own == pytest.approx(np.interp(np.arange(20) / 20 * arcs[-1], arcs, phi), abs=1e-12)


def test_steps_within_limits_against_another_program(core):
    """More limits than numbers: some steps have no way to keep to all of them, and stay as they are."""
    rng = np.random.default_rng(5)
    kept = []
    for trial in range(60):
        many = 5 if trial < 30 else 9
        root, normal, values = rng.normal(size=(5, 5)), rng.normal(size=(many, 5)), rng.uniform(-1, 1, many)
        gram, step = root @ root.T + 0.1 * np.eye(5), rng.normal(size=5)
        (mine,), (changed,) = core.limit_steps(
            gram[None], step[None], values[:, None], normal[:, :, None].copy(), 1e-12
        )
        assert changed == (values + normal @ step > 0).any()
        conditions = {"type": "ineq", "fun": lambda s, n=normal, v=values: -(v + n @ s)}
        other = minimize(
            lambda s, g=gram, a=step: (s - a) @ g @ (s - a), step, constraints=conditions, tol=1e-13, method="SLSQP"
        )
        possible = linprog(np.zeros(5), A_ub=normal, b_ub=-values, bounds=(None, None)).status == 0
        kept.append(possible)
        if not possible:
            assert mine == pytest.approx(step)
            continue
        assert (values + normal @ mine < 1e-9).all()
        cost, least = ((s - step) @ gram @ (s - step) for s in (mine, other.x))
        assert cost == pytest.approx(least, rel=1e-5, abs=1e-9)
    assert kept.count(True) > 30
    assert kept.count(False) > 3


def test_limits_concern_the_first_numbers_and_steps_inside_stay(core):
    """By hand: x + y + 1 may not be positive; the nearest step, with z as dear as x and y, leaves z alone."""
    step = np.array([[1.0, 0, 5], [-2, 0, 5]])
    values, slopes = np.ones((1, 2)), np.ones((1, 2, 2))
    gram = np.tile(np.eye(3), (2, 1, 1))
    moved, changed = core.limit_steps(gram, step, values, slopes, 1e-9)
    assert changed.tolist() == [True, False]
    assert moved == pytest.approx(np.array([[0, -1, 5], [-2, 0, 5]]))
    gram[0, 0, 2] = gram[0, 2, 0] = 0.5  # now z goes along with x
    assert core.limit_steps(gram, step, values, slopes, 1e-9)[0][0] == pytest.approx([1 - 8 / 7, -6 / 7, 5 + 4 / 7])
    for wrong in (np.full((1, 2), np.nan), np.full((1, 2), -9.0)):
        assert np.array_equal(core.limit_steps(gram, step, wrong, slopes, 1e-9)[0], step)


def test_wrong_calls_are_refused(core):
    arcs, values, rates = ellipse()
    row, one = np.zeros(1), np.zeros(1, np.int64)
    target = np.zeros((1, 1), complex)
    for call, words in (
        ((arcs[:1], values[:1], rates[:1], True, target, one, row, row, row, NONE, 1.0), "two samples"),
        ((arcs, values, rates, True, np.zeros((1, 2), complex), one, row, row, row, NONE, 1.0), "parts of the curve"),
        ((arcs, values, rates, True, target, one + 1, row, row, row, NONE, 1.0), "a target is none"),
        ((arcs, values, rates, True, target, one, row, np.zeros(2), row, NONE, 1.0), "two ends and a start"),
        ((arcs, values, rates, True, target, one, row, row, row, np.zeros(2), 1.0), "levels must be"),
    ):
        with pytest.raises(ValueError, match=words):
            core.settle_arcs(*call)
    with pytest.raises(ValueError, match="with its parameter"):
        core.spread_evenly(values.T.copy(), np.zeros(3), 5)
    with pytest.raises(ValueError, match="must not be negative"):
        core.spread_evenly(values.T.copy(), arcs, -1)
    gram, step = np.eye(2)[None], np.zeros((1, 2))
    with pytest.raises(ValueError, match="square for each step"):
        core.limit_steps(gram, np.zeros((1, 3)), np.zeros((1, 1)), np.zeros((1, 2, 1)), 0.0)
    with pytest.raises(ValueError, match="a value and slopes"):
        core.limit_steps(gram, step, np.zeros((2, 1)), np.zeros((1, 2, 1)), 0.0)
    with pytest.raises(ValueError, match="no more unknowns"):
        core.limit_steps(gram, step, np.zeros((1, 1)), np.zeros((1, 3, 1)), 0.0)
