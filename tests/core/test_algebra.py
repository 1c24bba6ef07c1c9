"""Four-bars through positions and points in the core: against numba, against plain Python, against small steps."""

import signal

import numpy as np
import pytest

from gruebler._numeric import homotopy
from gruebler._numeric.compiling import compiled
from gruebler.design.synthesis.alt_burmester import PROBLEMS, load_generic_solutions
from gruebler.design.synthesis.discs import certified
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
    for k, unknowns in enumerate(z):
        f, jac, _ = evaluate(unknowns, p, STILL, problem.poses, problem.points)
        assert values[k] == pytest.approx(f, rel=1e-12, abs=1e-12)
        assert derivatives[k] == pytest.approx(jac, rel=1e-12, abs=1e-12)
        numba = np.empty(8, complex)
        homotopy.sharp_residuals(unknowns, p, problem.poses, problem.points, numba)
        assert sharp[k] == pytest.approx(numba, rel=1e-15, abs=1e-28)


@each_problem
@pytest.mark.parametrize("loose", [1e-3, 1e-6])
def test_paths_as_numba(core, problem, loose):
    """The same steps on every path, and every level the same bits."""
    base = load_generic_solutions(problem)
    z, p = base.z[:12], random_parameters(problem, 7)
    ends, status, work = np.empty_like(z), np.empty(len(z), np.int64), np.empty(len(z), np.int64)
    shape = problem.poses, problem.points
    compiled(homotopy.track)(z, base.parameters, p, *shape, loose, ends, status, work)
    found = core.track(z, base.parameters, p, *shape, loose)
    assert found[1].tolist() == status.tolist()
    assert found[2].tolist() == work.tolist()
    assert found[0] == pytest.approx(ends, rel=1e-12, abs=1e-11)
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
def test_newton_as_numba(core, problem):
    p, z = load_generic_solutions(problem)
    z = z[:50] * (1 + 1e-5)
    own, steps = z.copy(), np.empty(len(z))
    compiled(homotopy.refine_solutions)(own, p, problem.poses, problem.points, steps)
    refined, last = core.refine_solutions(z, p, problem.poses, problem.points)
    assert refined == pytest.approx(own, rel=1e-12)
    assert (last < 1e-12).all()
    assert (np.abs(refined - z) > 0).any()


@each_problem
def test_proofs_as_in_python(core, problem):
    p, z = load_generic_solutions(problem)
    shape = problem.poses, problem.points
    assert core.certify(z, p, *shape).all()
    mixed = z[:30] + np.where(np.arange(30) % 3 == 0, 1e-3, 0)[:, None]
    assert core.certify(mixed, p, *shape).tolist() == certified(*shape, mixed, p).tolist()
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


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timer of this system")
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
