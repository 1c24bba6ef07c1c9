"""Four-bars through positions and points in the core: against plain Python, step by step, and small steps."""

import signal

import numpy as np
import pytest
from scipy.interpolate import KroghInterpolator

from gruebler.design.synthesis.alt_burmester import PROBLEMS, Problem, load_generic_solutions
from gruebler.design.synthesis.six_bar_guidance import random_guides
from gruebler.design.synthesis.six_bar_monodromy import known_solutions, merged, random_numbers
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


@each_problem
@pytest.mark.parametrize("loose", [1e-3, 1e-6], ids=["quick", "careful"])
def test_paths_end_at_solutions(core, problem, loose):
    """And every level has the same bits."""
    base = load_generic_solutions(problem)
    z, p, shape = base.z[:12], random_parameters(problem, 7), (problem.poses, problem.points)
    found = core.track(z, base.parameters, p, *shape, loose)
    ends, status, _ = found
    assert status.tolist() == [0] * len(z)
    for end in ends:
        f, jac, _ = evaluate(end, p, STILL, *shape)
        assert np.abs(np.linalg.solve(jac, f)).max() < 1e-8 * (1 + np.abs(end).max())
    assert len(np.unique(np.round(ends, 6), axis=0)) == len(z)
    for level in core.level_names():
        for array, other in zip(core.track(z, base.parameters, p, *shape, loose, level=level), found, strict=True):
            assert array.tobytes() == other.tobytes()


def followed(z, begin, end, poses, points, loose):
    """A path as the theory says it, in double precision: where it ends, and after how many steps, those refused too."""
    times, rows, step, steps = [0.0], [], 0.02, 0

    def corrections(z, time):
        f, jac, ft = evaluate(z, begin + time * (end - begin), end - begin, poses, points)
        return np.linalg.solve(jac, np.stack([f, -ft], axis=1)).T

    def relative(change, z):
        return (np.abs(change) / (np.abs(z) + 1e-3 * np.abs(z).max())).max()

    def is_far(z):
        return np.abs(z).max() > 30

    def corrected(z, time):
        """The place and the slope there, and the first correction; None if the corrections do not fall."""
        changes = []
        for _ in range(3):
            change, slope = corrections(z, time)
            z = z - change
            changes.append(relative(change, z))
            part = changes[-1] / changes[-2] if len(changes) > 1 else 1.0
            if not changes[-1] < loose or (len(changes) > 1 and part > 0.1):
                return None
            if changes[-1] * (part if is_far(z) else part**2) < 1e-9:
                return z, slope, changes[0]
        return None

    rows = [z, corrections(z, 0.0)[1]]
    while times[-1] < 1:
        steps += 1
        step = min(step, 1 - times[-1])
        time = times[-1] + step if step < 1 - times[-1] else 1.0
        known = 2 if is_far(rows[-2]) else 4
        new = corrected(KroghInterpolator(np.repeat(times[-known:], 2), rows[-2 * known :])(time), time)
        if new is None:
            step *= 0.4
            continue
        times, rows, part = [*times, time], [*rows, *new[:2]], new[2] / loose
        step *= 0.7 if part > 0.3 else 1 if part > 0.1 else 1.3 if part > 0.02 else 1.6
    return rows[-2], steps


@each_problem
def test_paths_in_plain_python(core, problem):
    """The same ends after the same steps; rounding may let one more or fewer be refused."""
    base = load_generic_solutions(problem)
    p, shape = random_parameters(problem, 7), (problem.poses, problem.points)
    ends, _, steps = core.track(base.z[:12], base.parameters, p, *shape, 1e-3)
    for k in np.argsort(steps)[:3]:  # the shortest paths: where double precision is nearly enough
        end, number = followed(base.z[k], base.parameters, p, *shape, 1e-3)
        assert ends[k] == pytest.approx(end, rel=1e-8)
        assert steps[k] == pytest.approx(number, rel=0.03)


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


def common_turns(family, z, task, pairs):
    """(pairs, 2) T and T* of the link that both loops have, from their two linear equations."""
    rows, (k, kc), two_arms = [], task[3, 2:4], family == "Watt II" or pairs == 11
    outputs = task[1, : pairs - 1].copy()
    if pairs > 8:
        outputs[-1] -= task[2, 0] * z[0]
    for turn, out in zip(task[0], outputs, strict=False):

        def vectors(own, x, y):  # of one of two conjugate worlds
            first, second, third, *_ = own
            return {
                "Watt II": (1 - first * x, 1 - second * y),
                "Stephenson II": (first * x - 1 - third * y, second * x - 1 - third * y),
                "Stephenson III": (first * x - 1, first * x - third - second * y),
            }[family]

        now, nowc = vectors(z[::2], turn, out), vectors(z[1::2], 1 / turn, 1 / out)
        then, thenc = vectors(z[::2], 1, 1), vectors(z[1::2], 1, 1)
        (p, pc), (q, qc) = (z[-4:-2], z[-2:]) if two_arms else (z[6:], (k * z[6], kc * z[7]))
        left = [[arm * wc, armc * w] for arm, armc, w, wc in zip((p, q), (pc, qc), now, nowc, strict=True)]
        right = [
            (w0 + arm) * (w0c + armc) - arm * armc - w * wc
            for arm, armc, w, wc, w0, w0c in zip((p, q), (pc, qc), now, nowc, then, thenc, strict=True)
        ]
        rows.append(np.linalg.solve(left, right))
    return np.array(rows)


def of_pairs(family, pairs):
    return Problem(name="pairs", poses=0, points=pairs - 1, classes=0, members=1, family=family)


SIX_BARS = [(family, pairs) for family in ("Watt II", "Stephenson II", "Stephenson III") for pairs in (8, 9)]


@pytest.mark.parametrize("general", [False, True], ids=["given", "general"])
@pytest.mark.parametrize(("family", "pairs"), [*SIX_BARS, ("Stephenson II", 11), ("Stephenson III", 11)])
def test_six_bars_turn_through_pairs(core, family, pairs, general):
    """Paths from a known six-bar to another task, in which both loops have one link that turns; all levels alike."""
    rng = np.random.default_rng(5)
    z, (task,) = known_solutions(of_pairs(family, pairs), rng, 1, general=general)
    assert (task[2] != 0).any() == (general or pairs == 8)
    other = np.where(np.abs(task) > 0, task + 0.3 * random_numbers(rng, *task.shape), 0)
    found = core.track(z, task, other, 0, pairs - 1, 1e-3, family=family)
    assert found[1].tolist() == [0]
    sharp, steps = core.refine_solutions(found[0], other, 0, pairs - 1, family=family)
    assert steps.max() < 1e-12
    for end, given in ((z[0], task), (sharp[0], other)):
        turns = common_turns(family, end, given, pairs)
        assert np.abs(turns[:, 0] * turns[:, 1] - 1).max() < 1e-8
        if pairs == 8:
            arm = end[4:6] if family == "Watt II" else end[6:]
            assert given[2] @ end + given[3, 1] * arm[0] * arm[1] == pytest.approx(given[3, 0])
    for level in core.level_names():
        same = core.track(z, task, other, 0, pairs - 1, 1e-3, family=family, level=level)
        assert [row.tobytes() for row in same] == [row.tobytes() for row in found]


@pytest.mark.parametrize("poses", [4, 5, 6, 7])
@pytest.mark.parametrize("general", [False, True], ids=["given", "general"])
def test_six_bars_guide_a_body(core, poses, general):
    """Paths from a known six-bar to another task, in which three lengths stay as the rocker turns; all levels alike."""
    rng = np.random.default_rng(5)
    z, (task,) = random_guides(rng, 1, poses, tilted=general)
    other = np.where(np.abs(task) > 0, task + 0.3 * random_numbers(rng, *task.shape), 0)
    found = core.track(z, task, other, poses, 0, 1e-3, family="Watt I")
    assert found[1].tolist() == [0]
    sharp, steps = core.refine_solutions(found[0], other, poses, 0, family="Watt I")
    assert steps.max() < 1e-12
    for end, given in ((z[0], task), (sharp[0], other)):
        numbers = np.concatenate([end, given[3, :4]]) if len(end) == 10 else end
        assert end[2 * poses :] == pytest.approx(given[3, 2 * poses : len(end)])
        ratio, d, f, g, h, base, pivot = numbers.reshape(7, 2)
        for j in range(poses):
            turn, shift = np.array([given[0, j], 1 / given[0, j]]), given[1:3, j].copy()
            if j == poses - 1:
                shift[1] -= given[0, 9] * ratio[0]
            pin, link = shift + turn * h - pivot, shift + turn * g - pivot  # from the rocker's pivot
            ways = [(pin, -d), (link, -f), (base + ratio * pin, (1 - ratio) * d)]
            first = [h - pivot - d, g - pivot - f, base + ratio * (h - pivot) + (1 - ratio) * d]
            rows = [[p[0] * w[1], p[1] * w[0]] for w, p in ways]
            right = [then.prod() - w.prod() - p.prod() for (w, p), then in zip(ways, first, strict=True)]
            rocker = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)[0]
            assert np.array(rows) @ rocker == pytest.approx(np.array(right), abs=1e-8)
            assert rocker.prod() == pytest.approx(1, abs=1e-8)
    for level in core.level_names():
        same = core.track(z, task, other, poses, 0, 1e-3, family="Watt I", level=level)
        assert [row.tobytes() for row in same] == [row.tobytes() for row in found]


def test_solutions_that_are_known_are_known_again():
    known, new = random_numbers(np.random.default_rng(1), 5, 8), random_numbers(np.random.default_rng(2), 8)
    both, where = merged(
        known, np.array([known[3] * (1 + 1e-9), new, known[0], new * (1 - 1e-9), known[4] * (1 + 1e-3)])
    )
    assert where.tolist() == [3, 5, 0, 5, 6]
    assert both[:6] == pytest.approx(np.concatenate([known, new[None]]))


def test_families_that_are_none(core):
    z, (task,) = known_solutions(of_pairs("Watt II", 8), np.random.default_rng(0), 1)
    with pytest.raises(ValueError, match="no family Watt"):
        core.refine_solutions(z, task, 0, 7, family="Watt")
    with pytest.raises(ValueError, match="7 or 8 points"):
        core.refine_solutions(z, task, 0, 5, family="Watt II")
    z, (task,) = known_solutions(of_pairs("Stephenson II", 11), np.random.default_rng(0), 1)
    for family in ("", "Watt II"):
        with pytest.raises(ValueError, match="Stephenson II or Stephenson III"):
            core.track(z, task, task, 0, 10, 1e-3, family=family)
    with pytest.raises(ValueError, match="10 points"):
        core.refine_solutions(z, task, 0, 8, family="Stephenson II")
    with pytest.raises(ValueError, match="up to 5 positions"):
        core.refine_solutions(z, task, 6, 0, family="Watt I")
    with pytest.raises(ValueError, match="fourteen unknowns have Watt I"):
        core.refine_solutions(np.zeros((1, 14), complex), np.zeros((4, 14), complex), 7, 0, family="Stephenson II")
    with pytest.raises(TypeError, match="incompatible function arguments"):
        core.track(z, task[:, :8].copy(), task, 0, 10, 1e-3, family="Stephenson II")
