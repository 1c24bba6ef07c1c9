"""Wrong calls of the algebra raise; nothing that stands in an array makes it crash."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

Z, TASK = np.zeros((3, 8), complex), np.zeros((4, 8), complex)
WRONG_UNKNOWNS = [None, 3, [[0j] * 8], Z.real, Z.astype(np.complex64), Z[0], Z[:, :7], np.asfortranarray(Z), Z[:, None]]
WRONG_TASKS = [None, [[0j] * 8] * 4, TASK.real, TASK[:3], TASK[:, :4], TASK.T.copy(), np.asfortranarray(TASK), TASK[0]]


def calls(core):
    """The kernels, as functions of solutions, a task and its shape."""
    return [
        lambda z, p, *shape: core.track(z, p, TASK, *shape, 1e-3),
        lambda z, p, *shape: core.track(z, TASK, p, *shape, 1e-3),
        core.refine_solutions,
        core.certify,
        core.evaluate_equations,
    ]


@pytest.mark.parametrize("z", WRONG_UNKNOWNS, ids=lambda z: type(z).__name__)
def test_wrong_unknowns(core, z):
    for call in calls(core):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            call(z, TASK, 0, 8)


@pytest.mark.parametrize("task", WRONG_TASKS, ids=lambda task: type(task).__name__)
def test_wrong_tasks(core, task):
    for call in calls(core):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            call(Z, task, 0, 8)


@pytest.mark.parametrize("shape", [(-1, 0), (0, -1), (5, 0), (0, 9), (4, 1), (1, 7), (2**30, 2**30), (2**31 - 1, 2)])
def test_wrong_shapes(core, shape):
    for call in calls(core):
        with pytest.raises(ValueError, match="positions give two equations, points one"):
            call(Z, TASK, *shape)


@pytest.mark.parametrize("loose", [0.0, -1.0, np.nan])
def test_wrong_steps(core, loose):
    with pytest.raises(ValueError, match="loose must be positive"):
        core.track(Z, TASK, TASK, 0, 8, loose)


def test_unknown_level(core):
    for call in (core.track, core.refine_solutions):
        arguments = (Z, TASK, TASK, 0, 8, 1e-3) if call is core.track else (Z, TASK, 0, 8)
        with pytest.raises(ValueError, match="no level v9"):
            call(*arguments, level="v9")


def test_nothing(core):
    assert [array.shape for array in core.track(Z[:0], TASK, TASK, 0, 8, 1e-3)] == [(0, 8), (0,), (0,)]
    assert [array.shape for array in core.refine_solutions(Z[:0], TASK, 0, 8)] == [(0, 8), (0,)]
    assert core.certify(Z[:0], TASK, 0, 8).shape == (0,)
    assert [array.shape for array in core.evaluate_equations(Z[:0], TASK, 0, 8)] == [(0, 8), (0, 8, 8)]


ODD = st.sampled_from([0.0, 1.0, -2.5, 1e-300, 1e20, 1e160, 1e300, np.inf, -np.inf, np.nan])


@settings(max_examples=30, deadline=None)
@given(
    st.lists(ODD, min_size=64, max_size=64), st.lists(ODD, min_size=16, max_size=16), st.sampled_from([(0, 8), (3, 2)])
)
def test_any_numbers(core, task, z, shape):
    """An answer comes, and what is no solution is not proved."""
    p, unknowns = np.array(task).view(complex).reshape(4, 8), np.array(z).view(complex).reshape(1, 8)
    ends, status, _ = core.track(unknowns, TASK, p, *shape, 1e-3)
    assert 0 <= status[0] <= 2
    assert ends.shape == (1, 8)
    _, last = core.refine_solutions(unknowns, p, *shape)
    assert not last[0] < 0
    if not np.isfinite(unknowns).all() or not np.isfinite(p[:2, : sum(shape)]).all():
        assert not core.certify(unknowns, p, *shape).any()
