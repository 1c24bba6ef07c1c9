"""Verdicts against the motion itself: accepted designs carry out their task, rejected ones fail as is said of them."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.kinematics import circuit, move
from gruebler.synthesis import PathTask, synthesise_path


def dense_path(linkage):
    """Places of the point along the whole circuit, and the farthest two neighbours are apart."""
    z = circuit(linkage, step=0.01).samples.complex_point("P")
    return z, np.abs(np.diff(z)).max()


@settings(max_examples=4, deadline=None)
@given(st.integers(0, 10**6))
def test_verdicts_of_five_points_with_given_pivots(seed):
    rng = np.random.default_rng(seed)
    turn = np.sort(rng.uniform(0, 4, 5))
    z = 2 * np.cos(turn) + 1j * np.sin(turn) + 0.1 * (rng.normal(size=5) + 1j * rng.normal(size=5))
    pivots = [(float(x), float(y)) for x, y in rng.normal(size=(2, 2)) * 2]
    task = PathTask([(w.real, w.imag) for w in z], fixed_pivots=pivots)
    found = synthesise_path(task)
    for design in found.designs:
        steps = np.diff(design.drives)
        assert (steps > 0).all() or (steps < 0).all()
        between = np.concatenate(
            [np.linspace(a, b, 20) for a, b in zip(design.drives, design.drives[1:], strict=False)]
        )
        motion = move(design.linkage, between)
        assert motion.complete
        at = [*range(0, len(between), 20), len(between) - 1]
        assert np.abs(motion.complex_point("P")[at] - z).max() < 1e-9 * task.size
    for design in found.rejected:
        path, gap = dense_path(design.linkage)
        nearest = np.abs(path[:, None] - z)
        missed = nearest.min(axis=0) > gap
        reached = not any("cannot be reached" in str(reason) for reason in design.verdict.reasons)
        assert design.verdict.reasons
        if reached:  # the circuit passes all points, in another order or on two branches
            assert not missed.any()
        else:  # it misses the worst point by what is said
            assert abs(nearest.min(axis=0).max() - design.verdict.error * task.size) <= gap
