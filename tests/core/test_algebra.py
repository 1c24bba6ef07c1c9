"""Four-bars through positions and points in the core: against plain Python, small steps, and steps counted before."""

import signal

import numpy as np
import pytest

from gruebler.design.synthesis.alt_burmester import PROBLEMS, load_generic_solutions
from tests.core.four_bar_equations import evaluate
from tests.design.synthesis.test_points import random_parameters

NINE, TWO, THREE, FOUR, GIVEN = PROBLEMS
STILL = np.zeros((4, 8), complex)
each_problem = pytest.mark.parametrize("problem", PROBLEMS, ids=lambda problem: problem.name)


@each_problem
def test_the_equations_as_they_stand_in_the_theory(core, problem):
    rng = np.random.default_rng(3)
    p = random_parameters(problem, 1)
    z = rng.normal(size=(20, 8)) + 1j * rng.normal(size=(20, 8))
    values, derivatives = core.evaluate_equations(z, p, problem.poses, problem.points)
    sharp, _ = core.evaluate_equations(z, p, problem.poses, problem.points, sharp=True)
    assert sharp == pytest.approx(values, rel=1e-10, abs=1e-12)
    for k, unknowns in enumerate(z):
        f, jac, _ = evaluate(unknowns, p, STILL, problem.poses, problem.points)
        assert values[k] == pytest.approx(f, rel=1e-12, abs=1e-12)
        assert derivatives[k] == pytest.approx(jac, rel=1e-12, abs=1e-12)


# Of the first twelve paths to the task of seed 7, quick and careful: counted by the tracker in Python, after which this
# one was written.
STEPS = {
    NINE: (1920, 6963),
    TWO: (1628, 6137),
    THREE: (1634, 6263),
    FOUR: (1311, 5114),
    GIVEN: (936, 3523),
}


@each_problem
@pytest.mark.parametrize("careful", [False, True])
def test_paths_end_at_solutions_after_known_numbers_of_steps(core, problem, careful):
    """And every level has the same bits."""
    base = load_generic_solutions(problem)
    z, p = base.z[:12], random_parameters(problem, 7)
    shape, loose = (problem.poses, problem.points), 1e-6 if careful else 1e-3
    found = core.track(z, base.parameters, p, *shape, loose)
    ends, status, steps = found
    assert status.tolist() == [0] * len(z)
    assert steps.sum() == STEPS[problem][careful]
    for end in ends:
        f, jac, _ = evaluate(end, p, STILL, *shape)
        assert np.abs(np.linalg.solve(jac, f)).max() < 1e-8 * (1 + np.abs(end).max())
    assert len(np.unique(np.round(ends, 6), axis=0)) == len(z)
    for level in core.level_names():
        for array, other in zip(core.track(z, base.parameters, p, *shape, loose, level=level), found, strict=True):
            assert array.tobytes() == other.tobytes()


@pytest.mark.parametrize("problem", [THREE, GIVEN], ids=lambda problem: problem.name)
def test_paths_by_many_small_steps(core, problem):
    """Euler's method with Newton's after each of 500 steps comes to the same ends."""
    base = load_generic_solutions(problem)
    begin, end = base.parameters, base.parameters + 0.05 * (random_parameters(problem, 8) - base.parameters)
    ends, status, _ = core.track(base.z[:3], begin, end, problem.poses, problem.points, 1e-3)
    assert status.tolist() == [0] * 3
    for start, found in zip(base.z, ends, strict=False):
        z = start
        for time in np.arange(500) / 500:
            p, dp = begin + time * (end - begin), (end - begin) / 500
            _, jac, ft = evaluate(z, p, dp, problem.poses, problem.points)
            z = z - np.linalg.solve(jac, ft)
            for _ in range(2):
                f, jac, _ = evaluate(z, p + dp, STILL, problem.poses, problem.points)
                z = z - np.linalg.solve(jac, f)
        assert found == pytest.approx(z, rel=1e-9)


@each_problem
def test_newton_comes_back(core, problem):
    p, z = load_generic_solutions(problem)
    refined, last = core.refine_solutions(z[:30] * (1 + 1e-5), p, problem.poses, problem.points)
    assert refined == pytest.approx(z[:30], rel=1e-10)
    assert (last < 1e-12).all()


@each_problem
def test_what_is_no_solution_and_what_is_there_twice_is_not_proved(core, problem):
    p, z = load_generic_solutions(problem)
    shape = problem.poses, problem.points
    assert core.certify(z, p, *shape).all()
    wrong = np.arange(30) % 3 == 0
    assert core.certify(z[:30] + np.where(wrong, 0.1, 0)[:, None], p, *shape).tolist() == (~wrong).tolist()
    twice = np.repeat(z[:3], [1, 2, 1], axis=0)
    assert core.certify(twice, p, *shape).tolist() == [True, False, False, True]


def test_a_path_to_infinity_and_a_singular_matrix(core):
    """Two unknowns that are fixed at the begin grow beyond every bound; of no equation for x a matrix is singular."""
    begin, end = STILL.copy(), STILL.copy()
    end[3] = 1e12
    ends, status, _ = core.track(np.zeros((1, 8), complex), begin, end, 0, 0, 1e-3)
    assert status.tolist() == [2]
    assert np.abs(ends).max() > 1e8
    refined, last = core.refine_solutions(np.zeros((1, 8), complex), STILL, 0, 8)
    assert last.tolist() == [np.inf]
    assert not refined.any()


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="Windows has no interval timer")
def test_a_signal_ends_a_long_call(core):
    base = load_generic_solutions(NINE)
    starts, p = np.tile(base.z, (20, 1)), random_parameters(NINE, 7)

    def stop(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(KeyboardInterrupt):
            core.track(starts, base.parameters, p, 0, 8, 1e-6)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
