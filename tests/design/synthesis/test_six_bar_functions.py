"""Six-bars of Watt's second kind through nine pairs of angles: against six-bars chosen first, and by motion."""

import numpy as np
import pytest

from gruebler import _core
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import FunctionTask, function_task, synthesise, synthesise_six_bars
from gruebler.design.synthesis.alt_burmester import load_generic_solutions
from gruebler.design.synthesis.formulas import FunctionLaw
from gruebler.design.synthesis.six_bar_functions import NINE_PAIRS, common_turns, keeps_modes
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism


def unit(x):
    return np.exp(1j * np.asarray(x))


def random_task(rng):
    """Complex numbers as arms, and how the ternary rocker turns; then the turns of crank and output. By hand."""
    z, turns = (rng.normal(size=shape) + 1j * rng.normal(size=shape) for shape in (8, 8))
    a, ac, f, fc, p, pc, q, qc = z
    task = np.zeros((4, 8), complex)
    for j, t in enumerate(turns):
        for row, x, xc, y, yc in ((0, a, ac, p, pc), (1, f, fc, q, qc)):
            # (1 - x X + y T)(1 - xc / X + yc / T) = (1 - x + y)(1 - xc + yc), a quadratic in X.
            near, far, first = 1 + y * t, 1 + yc / t, (1 - x + y) * (1 - xc + yc)
            task[row, j] = np.roots([-x * far, near * far + x * xc - first, -near * xc])[rng.integers(2)]
    return z, task


def test_every_six_bar_is_among_the_generic_solutions():
    """Carried to the generic task each of sixty ends at a stored one: if a tenth were missing, 1 in 500 would pass."""
    base = load_generic_solutions(NINE_PAIRS)
    assert len(base.z) == NINE_PAIRS.classes
    arrived = 0
    for seed in range(60):
        z, task = random_task(np.random.default_rng(seed))
        end, status, _ = _core.track(z[None], task, base.parameters, 0, 8, 1e-3, family="Watt II")
        end, _ = _core.refine_solutions(end, base.parameters, 0, 8, family="Watt II")
        if status[0] == 0:
            arrived += 1
            assert np.abs(base.z - end).max(axis=1).min() < 1e-6 * (1 + np.abs(end).max())
    assert arrived > 55


ARMS = np.array([-0.07 + 0.46j, 0.45 - 0.17j, 0.39 - 0.44j, -0.4 + 0.37j])  # a, f, p, q


def linkage():
    """The six-bar of these arms; its second frame, from the output to the ternary rocker, is -1."""
    a, f, p, q = ARMS
    pins = (0, a, 1 + p, 1, 1 - q, 2 - f, 2)
    names = ["R(0-1)", "R(1-2)", "R(2-3)", "R(0-3)", "R(3-4)", "R(4-5)", "R(0-5)"]
    mechanism = Mechanism.parse(f"{' '.join(names)}; frame=0; drive=R(0-1)")
    places = {name: (complex(z).real, complex(z).imag) for name, z in zip(names, pins, strict=True)}
    return Linkage.from_drawing(mechanism, places, outputs=["5"])


def pairs_of_motion():
    drawn = linkage()
    start = np.angle(ARMS[0])
    motion = move(drawn, start + np.linspace(0, 1.3, 9) ** 1.1)
    turned = {link: motion.angle(link) - motion.angle(link)[0] for link in "135"}
    return turned["1"], turned["5"], turned["3"]


def test_the_ternary_rocker_turns_as_in_the_motion():
    phi, output, ternary = pairs_of_motion()
    p = np.zeros((4, 8), complex)
    p[0], p[1] = unit(phi[1:]), unit(output[1:])
    assert common_turns(ARMS[None], p)[0] == pytest.approx(unit(ternary), abs=1e-9)
    assert keeps_modes(ARMS[None], p)[0]
    # The second four-bar in its other mode: its output arm mirrored at the line from the output to the ternary's pin.
    line = 1 + ARMS[3] * unit(ternary[5])
    p[1, 4] = line / np.conj(line) * np.conj(ARMS[1] * p[1, 4]) / ARMS[1]
    assert common_turns(ARMS[None], p)[0] == pytest.approx(unit(ternary), abs=1e-9)
    assert not keeps_modes(ARMS[None], p)[0]


@pytest.mark.parametrize(
    ("task", "words"),
    [
        (FunctionTask(np.linspace(0, 1, 9), outputs=np.linspace(0, 2, 9)), "whose starts are free"),
        (FunctionTask([0, 0.1, 0.2], outputs=[0, 1, 2], start_input=False, start_output=False), "the task has 3"),
    ],
)
def test_other_tasks_are_refused(task, words):
    with pytest.raises(SynthesisError, match=words):
        synthesise_six_bars(task)


def test_other_options_are_refused():
    task = FunctionTask(np.linspace(0, 1, 9), outputs=np.linspace(0, 2, 9), start_input=False, start_output=False)
    with pytest.raises(SynthesisError, match="has no option 'minimax'"):
        synthesise(task, six_bars=True, minimax=True)
    with pytest.raises(SynthesisError, match="only of functions"):
        synthesise(task, six_bars=True, structures=[linkage().mechanism])


@pytest.mark.slow
def test_a_six_bar_is_found_again():
    phi, output, _ = pairs_of_motion()
    task = FunctionTask(phi, outputs=output, start_input=False, start_output=False)
    found = synthesise(task, six_bars=True)
    assert found.count.real > 100
    cranks = [design.linkage.length("crank", 0, 1) for design in (*found.designs, *found.rejected)]
    assert min(abs(length - abs(ARMS[0])) for length in cranks) < 1e-8
    for design in found.designs:
        motion = move(design.linkage, design.drives)
        assert motion.angle("rocker") - motion.angle("rocker")[0] == pytest.approx(output, abs=1e-8)


@pytest.mark.slow
def test_the_logarithm():
    """The best four-bar errs by 0.00697 degrees, at its minimax optimum; nine points of a six-bar leave far less."""
    law = FunctionLaw("log10(x)", interval=(1, 2), input_swing=np.radians(60), output_swing=np.radians(60))
    found = synthesise(function_task(law, 9), six_bars=True)
    best = found.designs[0]
    assert best.verdict.error < 1e-8
    x = np.linspace(1, 2, 7)
    motion = move(best.linkage, best.drives[0] + law.inputs(x) - found.task.inputs[0])
    output = motion.angle("rocker") - motion.angle("rocker")[0]
    assert output == pytest.approx(np.radians(60) * np.log10(x) / np.log10(2), abs=2e-8)
