"""The motion kernels beside those of numba and Python: the same bits, the same decisions."""

import signal
from copy import deepcopy

import numpy as np
import pytest

import gruebler as gr
from gruebler._numeric.motion import batch, closure, newton, path, program, tracing
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics.assembly_modes import GroupSolver, conditions
from gruebler.mechanics.kinematics.batch import four_bars, move_many
from gruebler.mechanics.kinematics.circuits import circuit
from gruebler.mechanics.kinematics.triads import all_modes
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.samples import CLASS_III, CYLINDER, parallel_legs

STEADY = {"speed": 1.0, "acceleration": 2.0, "jerk": 3.0, "order": 3}
SLIDING = [
    ("R(0-1) P(1-2) R(2-3) P(0-3); frame=0; drive=R(0-1)", [(0, 0), (2, 1, 0.5), (4, 2), (4, 2.2, 1.4)]),
    ("R(0-1) R(1-2) P(2-3) P(0-3); frame=0; drive=R(0-1)", [(0, 0), (1, 1), (3, 1.5, 1.3), (6, 2, 0.2)]),
]
FIVE_BAR = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)")


def five_bar():
    return Linkage.from_drawing(FIVE_BAR, {0: (0, 0), 1: (1, 0.5), 2: (2.5, 7), 3: (4, 0.6), 4: (5, 0)})


def sliding(text, places):
    return Linkage.from_drawing(Mechanism.parse(text), dict(enumerate(places)))


# Turning drives and dyads over many rows (swept) and few (walked), limits, change points, pushes, carried links, larger
# groups, wheels, belts and cams.
MOTIONS = {
    "crank-rocker": lambda: gr.move(FourBar(25, 70, 40, 70).linkage(), gr.from_degrees(-3, 723, 2), **STEADY),
    "crank-rocker, position": lambda: gr.move(FourBar(25, 70, 40, 70).linkage(), gr.from_degrees(0, 360, 3), order=0),
    "crank-rocker, other mode": lambda: gr.move(
        FourBar(25, 70, 40, 70).linkage(), gr.from_degrees(0, 360, 7), branch="-", speed=2.0, order=1
    ),
    "limit": lambda: gr.move(FourBar(50, 70, 40, 70).linkage(), gr.from_degrees(60, 360, 3), speed=1.0),
    "parallelogram": lambda: gr.move(FourBar(25, 70, 25, 70).linkage(), gr.from_degrees(0, 400, 3), **STEADY),
    "kite": lambda: gr.move(FourBar(30, 50, 50, 30).linkage(), gr.from_degrees(-30, 400, 10), **STEADY),
    "rhombus": lambda: gr.move(FourBar(20, 20, 20, 20).linkage(), np.radians([64.0, 104, 144, 184, 144, 104, 64])),
    "slider-crank": lambda: gr.move(SliderCrank(20, 70, 8).linkage(), gr.from_degrees(0, 400, 2), **STEADY),
    "turning block": lambda: gr.move(InvertedSliderCrank(50, 30, 3).linkage(), gr.from_degrees(0, 400, 2), **STEADY),
    "swinging block": lambda: gr.move(InvertedSliderCrank(30, 50, -4).linkage(), gr.from_degrees(0, 400, 9), **STEADY),
    "PRP": lambda: gr.move(sliding(*SLIDING[0]), gr.from_degrees(0, 20, 2), **STEADY),
    "RPP": lambda: gr.move(sliding(*SLIDING[1]), gr.from_degrees(0, 20, 2), **STEADY),
    "cylinder": lambda: gr.move(CYLINDER, np.linspace(3.0, 4.0, 12), **STEADY),
    "two drives": lambda: gr.move(
        five_bar(), np.stack([np.linspace(0.5, 3, 200), np.linspace(2.5, 6, 200)], axis=1), speed=[1, 2]
    ),
    "class III": lambda: gr.move(CLASS_III, gr.from_degrees(40, 140, 5), **STEADY),
    "three parallel cranks": lambda: gr.move(parallel_legs(), np.radians([53.13, 100, 180 + 1e-5, 250]), order=0),
    "row in a change point": lambda: gr.move(parallel_legs(), np.radians([150, 180, 210]), speed=1.0),
    **{
        name: lambda name=name: gr.move(entry(name).linkage(), gr.from_degrees(0, 30, 5), **STEADY)
        for name in ("cam", "cam_roller", "geneva", "belt", "friction_forced", "winch_plane")
    },
    "crane": lambda: gr.move(entry("crane_cyl").linkage(), np.linspace(34.5, 47, 6), **STEADY),
}

# NumPy divides complex numbers by multiplying with the inverse, and its squares of numbers are powers: in a few places
# the last bits of what Python runs differ from what is compiled.
CLOSE = 1e-12


def equal(one, other, *, exact=True):
    one, other = np.asarray(one), np.asarray(other)
    assert one.shape == other.shape
    if exact or one.dtype.kind in "iub":
        assert np.array_equal(one, other, equal_nan=one.dtype.kind in "fc")
    else:
        size = np.abs(np.where(np.isfinite(other), other, 0)).max(initial=1e-3)
        assert np.allclose(one, other, rtol=CLOSE, atol=CLOSE * size, equal_nan=True)


def contiguous(arrays):
    return tuple(np.ascontiguousarray(array) if isinstance(array, np.ndarray) else array for array in arrays)


def empty(arrays):
    return tuple(np.full_like(array, 7) for array in arrays)


def recorded(kernel_module, name, work):
    """The calls of a kernel: its arguments before and after, and what it returned."""
    calls = []
    kernel = getattr(kernel_module, name)

    def record(*arguments):
        before = deepcopy(arguments)
        result = kernel(*arguments)
        calls.append((before, deepcopy(arguments), result))
        return result

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(kernel_module, name, record)
        work()
    assert calls
    return calls


@pytest.mark.parametrize("name", MOTIONS)
def test_motions(core, name):
    for before, after, (status, reached, at, fault) in recorded(path, "run_path", MOTIONS[name]):
        *inputs, poses = *contiguous(before[:5]), after[5]
        out = empty(poses)
        end = core.run_path(*inputs, out)
        assert (end[0], end[1], end[3]) == (status, reached, fault)
        assert end[2] == pytest.approx(at, rel=1e-12)
        for mine, theirs in zip(out, poses, strict=True):
            equal(mine[..., :reached], theirs[..., :reached], exact=False)


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "turning block", "two drives", "limit"])
def test_levels_give_the_same_bits(core, name):
    for before, after, (_, reached, _, _) in recorded(path, "run_path", MOTIONS[name]):
        inputs = contiguous(before[:5])
        found = {level: empty(after[5]) for level in core.level_names()}
        ends = [core.run_path(*inputs, out, level=level) for level, out in found.items()]
        assert all(end == ends[0] for end in ends)
        for arrays in found.values():
            for mine, least in zip(arrays, found["baseline"], strict=True):
                equal(mine[..., :reached], least[..., :reached])


def test_a_sweep_finds_what_a_walk_finds(core):
    """Eight rows are walked, more are swept."""
    linkage = FourBar(25, 70, 40, 70).linkage()
    for before, after, _ in recorded(path, "run_path", lambda: gr.move(linkage, gr.from_degrees(0, 400, 1), **STEADY)):
        plan, drives, speeds, signs, start = contiguous(before[:5])
        for row in range(0, len(drives) - 8, 40):
            part = slice(row, row + 8)
            out = [np.ascontiguousarray(array[..., part]) for array in empty(after[5])]
            assert (
                core.run_path(plan, drives[part], np.ascontiguousarray(speeds[:, part]), signs, start, tuple(out))[1]
                == 8
            )
            for walked, swept in zip(out[:3], after[5][:3], strict=True):
                assert np.allclose(walked, swept[..., part], rtol=1e-12, atol=1e-10)


def test_designs(core):
    def work():
        move_many(
            four_bars([25, 30, 200], 70, 40, 70), gr.from_degrees(0, 60, 5), speed=1.0, threads=1, branch="+", order=2
        )

    for before, after, _ in recorded(batch, "run_designs", work):
        plan, designs, drives, speeds, kept, _, part = before
        out = empty(after[5])
        core.run_designs(plan, contiguous(designs), *contiguous((drives, speeds, kept)), out, part)
        assert out[3].tolist() == after[5].reached.tolist()
        for mine, theirs in zip(out, after[5], strict=True):
            equal(mine, theirs, exact=False)


def test_modes_of_groups(core):
    """Newton's method from anywhere, and closing conditions."""
    group = conditions([(0, -1, 0, 0j, 1, 0j, 1), (0, 0, 1, 1, 1, 0j, 1), (0, 1, -1, 1, 1, 1.2, 1)])
    solver = GroupSolver(group)
    kept, scratch = solver._conditions, newton.new_newton_scratch(6)
    random = np.random.default_rng(1)
    arrived = 0
    for _ in range(50):
        x = random.normal(size=6)
        residual, slopes = np.zeros(6), np.zeros((6, 6))
        assert core.closing(kept, x, residual, slopes) == closure.closing(kept, x, scratch.residual, scratch.jacobian)
        equal(residual, scratch.residual)
        equal(slopes, scratch.jacobian)
        mine, theirs = x.copy(), x.copy()
        end = core.newton(kept, mine, 20)
        assert end == newton.newton(kept, theirs, 20, scratch)
        equal(mine, theirs)
        arrived += end[0] > 0
        mine, theirs = x.copy(), x.copy()
        core.close_near_singular(kept, mine)
        newton.close_near_singular(kept, theirs, scratch)
        equal(mine, theirs)
    assert arrived > 25
    assert len(all_modes(group)) == 2


@pytest.mark.parametrize("name", ["crank-rocker", "class III", "cam_roller", "geneva", "belt", "friction_forced"])
def test_circuits(core, name):
    """Every kind of closing condition, traced; the kernels of Python do the same work beside."""
    given = {"crank-rocker": FourBar(25, 70, 40, 70).linkage(), "class III": CLASS_III}
    system = circuit(given[name] if name in given else entry(name).linkage()).system
    kept, n = system.conditions, system.unknowns
    x = circuit(given[name] if name in given else entry(name).linkage()).traced.poses[0].copy()
    residual, slopes = core.jacobian(kept, x)
    m = tracing.jacobian(kept, x, system.room)
    equal(residual, system.room.residual[:m])
    equal(slopes, system.room.rows[:m])
    curves = []
    for kernels in "core", "python":
        curve = tracing.SampleBuffer(np.zeros(12), np.zeros((12, n)), np.zeros((12, n)), np.zeros(12))
        curve.poses[0], curve.tangents[0] = x, np.ones(n)
        near, slopes = np.zeros((2, 3, n))
        if kernels == "core":
            arrived, miss, gauge, rank, rows = core.settle_on_curve(kept, curve.poses[0], curve.tangents[0])
            assert len(rows) == rank
            curve.gauges[0] = gauge
            end = core.trace_curve(kept, curve, 1, 0.05, 0.2, 100.0)
            at, segments = curve.arcs[:3] + 0.3 * np.diff(curve.arcs[:4]), np.arange(3)
            count = core.evaluate_pose(kept, curve, at, segments, near, slopes)
        else:
            arrived, miss, gauge, rank = tracing.settle_on_curve(kept, curve.poses[0], curve.tangents[0], system.room)
            curve.gauges[0] = gauge
            end = tracing.trace_curve(kept, curve, 1, 0.05, 0.2, 100.0, system.room)
            at, segments = curve.arcs[:3] + 0.3 * np.diff(curve.arcs[:4]), np.arange(3)
            count = tracing.evaluate_pose(kept, curve, at, segments, near, slopes, system.room)
        curves.append((curve, near, slopes, (arrived, rank, end[:2], count), (miss, gauge, end[2])))
    (mine, near, slopes, counts, numbers), (theirs, near_2, slopes_2, counts_2, numbers_2) = curves
    assert counts == counts_2
    assert counts[2][1] > 3
    equal(numbers, numbers_2)
    for one, other in zip((*mine, near, slopes), (*theirs, near_2, slopes_2), strict=True):
        equal(one[: counts[2][1]], other[: counts[2][1]])


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no signals here")
def test_an_interrupt_ends_a_long_way(core):
    (call,) = recorded(path, "run_path", lambda: gr.move(FourBar(25, 70, 40, 70).linkage(), [0.3], order=0))
    plan, _, _, signs, start = contiguous(call[0][:5])
    drives = np.array([[0.3], [3e10]])
    poses = tuple(np.zeros((*array.shape[:-1], 2), array.dtype) for array in call[1][5])

    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    try:
        with pytest.raises(KeyboardInterrupt):
            core.run_path(plan, drives, np.zeros((0, 2, 1)), signs, start, poses)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_the_codes_are_those_of_python():
    """The numbers that both sides write down."""
    assert (program.DONE, program.LIMIT, program.SINGULAR, program.START) == (0, 1, 2, 3)
    assert (tracing.CLOSED, tracing.FULL, tracing.LONG, tracing.LOST, tracing.FLIP) == (0, 1, 2, 3, 4)
