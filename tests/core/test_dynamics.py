"""Free motion of one freedom in the core: series against numpy, steps against scipy's DOP853, wrong calls."""

import numpy as np
import pytest
from numpy.polynomial import chebyshev
from scipy.integrate import DOP853, solve_ivp

ENDS = np.array([[-1.0, 0.5, -0.25, 0.75], [0.5, 2.5, 1.5, 1.0], [3.0, 4.0, 3.5, 0.5]])
SERIES = np.random.default_rng(0).normal(size=(3, 9, 6)) / np.arange(1, 10)[:, None] ** 3
SERIES[:, 0, 0] = 5.0  # the mass is positive
METHOD = (np.ascontiguousarray(DOP853.A), DOP853.B, DOP853.E3, DOP853.E5)
LENGTHS, ERRORS = (0.05, 1.0), (1e-10, np.full(3, 1e-10))


def by_numpy(piece, q, v):
    _, _, middle, half = ENDS[piece]
    mass, slope, force, damped, lost, lost_by_speed = chebyshev.chebval((q - middle) / half, SERIES[piece])
    return mass, force + v * (damped - v * slope), lost + v * lost_by_speed


@pytest.mark.parametrize(("piece", "q"), [(0, -1.0), (0, 0.3), (1, 0.7), (1, 2.5), (2, 3.2)])
def test_forces_are_the_series(core, piece, q):
    assert core.reduced_forces(ENDS, SERIES, np.nan, q, -0.7) == pytest.approx(by_numpy(piece, q, -0.7), rel=1e-13)


def test_a_turn_leads_back(core):
    turned = core.reduced_forces(ENDS, SERIES, -1.0, 0.3 - 4 * np.pi, 2.0)
    assert turned == pytest.approx(by_numpy(0, 0.3, 2.0), rel=1e-12)


@pytest.mark.parametrize("q", [-1.1, 2.7, 4.2, np.nan, np.inf])
def test_where_no_piece_lies(core, q):
    assert core.reduced_forces(ENDS, SERIES, np.nan, q, 1.0) is None


@pytest.mark.parametrize("length", [0.05, 0.6])
def test_a_step_is_that_of_scipy(core, length):
    """The longer one is refused and taken shorter."""

    def rate(_, y):
        mass, force, power = by_numpy(0 if y[0] <= 0.5 else 1, y[0], y[1])
        return [y[1], force / mass, power * y[1]]

    start = np.array([0.55, 2.0, 0.0])
    solver = DOP853(rate, 0.0, start, 1.0, rtol=1e-10, atol=1e-10, first_step=length)
    first = np.array(solver.f)
    solver.step()
    time, following, state, rates, evaluations = core.free_step(
        ENDS, SERIES, np.nan, *METHOD, 0.0, start, first, length, *LENGTHS[1:], *ERRORS
    )
    assert (time, following) == pytest.approx((solver.t, solver.h_abs), rel=1e-6)  # by errors near rounding
    later = (time - solver.t) * np.array(solver.f)
    assert state == pytest.approx(solver.y + later, rel=1e-10)
    assert rates == pytest.approx(solver.K, rel=1e-8, abs=1e-8)  # their places in the step are by these errors, too
    assert evaluations == solver.nfev - 1  # the first one is the rate at the start


def test_a_step_that_leaves_the_pieces(core):
    leaving = np.array([2.4, 50.0, 0.0])
    assert core.free_step(ENDS, SERIES, np.nan, *METHOD, 0.0, leaving, leaving, *LENGTHS, *ERRORS) is None


BETWEEN = (DOP853.A_EXTRA, DOP853.D)
CALM = np.ones(3, np.uint8)


def run_of(core, calm=CALM, until=0.6, stops=(), most=1000, start=(0.55, 2.0, 0.0)):
    start = np.array(start)
    mass, force, power = by_numpy(0 if start[0] <= 0.5 else 1, *start[:2])
    rate = np.array([start[1], force / mass, power * start[1]])
    stops = np.array(stops, np.float64)
    return core.free_run(
        ENDS, SERIES, np.nan, *METHOD, *BETWEEN, calm, 0.0, start, rate, 0.05, until, *ERRORS, most, stops
    )


def test_a_run_is_the_steps_of_scipy_and_its_rows_those_of_the_dense_output(core):
    def rate(_, y):
        mass, force, power = by_numpy(0 if y[0] <= 0.5 else 1, y[0], y[1])
        return [y[1], force / mass, power * y[1]]

    stops = [0.01, 0.012, 0.3, 0.6]
    expected = solve_ivp(rate, (0.0, 0.6), [0.55, 2.0, 0.0], "DOP853", stops, rtol=1e-12, atol=1e-12)
    steps, passed, _, _, evaluations = run_of(core, stops=stops)
    assert passed == pytest.approx(expected.y.T, rel=1e-9, abs=1e-9)
    assert steps[-1] == pytest.approx([0.6, *expected.y[:, -1]], rel=1e-9)
    assert (np.diff(steps[:, 0]) > 0).all()
    assert evaluations >= 12 * len(steps)


def test_a_run_ends_after_so_many_steps_after_one_that_is_not_calm_and_before_one_that_leaves_the_pieces(core):
    assert len(run_of(core, most=2)[0]) == 2
    wild = CALM.copy()
    wild[1] = 0
    assert len(run_of(core, calm=wild)[0]) == 1
    steps, _, _, _, _ = run_of(core, until=9.0, start=(1.0, 5.0, 0.0))
    assert steps[-1, 0] < 9.0
    assert steps[-1, 1] < 2.5


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"calm": CALM[:2]}, "calm must have a flag for each piece"),
        ({"stops": (0.3, 0.1)}, "stops are in order"),
        ({"stops": (0.0,)}, "stops are in order"),
        ({"stops": (0.7,)}, "stops are in order"),
        ({"until": np.nan}, "the time ends after it begins"),
        ({"most": -1}, "at most a million steps"),
    ],
    ids=str,
)
def test_wrong_numbers_of_a_run(core, wrong, words):
    with pytest.raises(ValueError, match=words):
        run_of(core, **wrong)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"ends": ENDS[:2]}, "ends must have a row for each piece"),
        ({"coefficients": SERIES[:, :0]}, "a series has one coefficient at least"),
        ({"until": 0.0}, "the time ends after it begins"),
        ({"until": np.inf}, "the time ends after it begins"),
        ({"time": np.nan}, "the time ends after it begins"),
        ({"length": 0.0}, "a step has a positive length"),
        ({"length": np.nan}, "a step has a positive length"),
    ],
    ids=str,
)
def test_wrong_numbers(core, wrong, words):
    state = np.array([0.1, 0.2, 0.0])
    names = ("a", "b", "e3", "e5")
    sound = {
        "ends": ENDS,
        "coefficients": SERIES,
        "closed": np.nan,
        **dict(zip(names, METHOD, strict=True)),
        "time": 0.0,
        "state": state,
        "rate": state,
        "length": 0.05,
        "until": 1.0,
        "relative": 1e-9,
        "absolute": np.full(3, 1e-9),
    }
    assert core.free_step(**sound) is not None
    with pytest.raises(ValueError, match=words):
        core.free_step(**{**sound, **wrong})
    with pytest.raises(TypeError, match="incompatible function arguments"):
        core.free_step(**{**sound, "state": state[:2]})
