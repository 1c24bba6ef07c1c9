"""What is proved of two to four pairs with free starts: against random linkages by Freudenstein's equation."""

import numpy as np
import pytest

from gruebler.design.synthesis import Demands, FunctionTask, synthesise_function
from gruebler.design.synthesis.function_bounds import FunctionSearch
from gruebler.design.synthesis.functions import _facts_of_pivots
from gruebler.design.synthesis.partner_bounds import MARGIN

WISHES = (Demands(), Demands(crank=True), Demands(size_ratio=4.0), Demands(in_order=False))


def _task(rng, count, output):
    inputs, outputs = np.cumsum(rng.uniform(0.2, 0.8, count)), np.cumsum(rng.uniform(0.2, 0.6, count))
    if rng.integers(0, 3) == 0:
        outputs = rng.permutation(outputs)
    return FunctionTask(tuple(inputs), outputs=tuple(outputs), output=output, start_input=False, start_output=False)


def _members(rng, task, number):
    """Moving pivots of output and crank, (members,) each, of random linkages through the pairs.

    K1 cos psi - K2 cos phi + K3 = cos(phi - psi) with a = 1 / K1, c = 1 / K2; of sliders K1 s cos phi + K2 sin phi + K3
    = s² with a = K1 / 2, e = K2 / K1. Of four pairs a fourth one is met by the zero of a determinant, by bisection.
    """
    phi, output = (np.array(each) - each[0] for each in (task.inputs, task.outputs))
    angles, count = task.output == "angle", len(task)
    inputs = rng.uniform(0, 2 * np.pi, number)[:, None] + phi
    starts = rng.uniform(0, 2 * np.pi, number) if angles else np.sinh(rng.uniform(-4, 4, number)) * np.ptp(output)

    def columns(start):
        psi = start[:, None] + output
        rows = [np.cos(psi), -np.cos(inputs), 1 + 0 * psi, np.cos(inputs - psi)]
        return np.stack(rows if angles else [psi * np.cos(inputs), np.sin(inputs), 1 + 0 * psi, psi**2], axis=2)

    if count == 4:
        low, high = starts, starts + rng.uniform(0, np.pi / 2, number) * (1 if angles else np.ptp(output))
        begin = np.sign(np.linalg.det(columns(low)))
        keep = begin != np.sign(np.linalg.det(columns(high)))
        for _ in range(60):
            middle = (low + high) / 2
            same = np.sign(np.linalg.det(columns(middle))) == begin
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        starts, inputs = low[keep], inputs[keep]
    rows = columns(starts)[:, :3]
    factors = np.linalg.solve(rows[..., :3], rows[..., 3:])[..., 0]
    first = np.exp(1j * inputs[:, 0])
    if angles:
        return 1 + np.exp(1j * starts) / factors[:, 1], first / factors[:, 0]
    return starts + 1j * factors[:, 1] / factors[:, 0], first * factors[:, 0] / 2


def _never_better(seed, number):
    """For how many wishes something was proved that random members come near to, and how many were decided."""
    rng = np.random.default_rng(seed)
    near = decided = 0
    for count in (3, 4):
        for output in ("angle", "travel"):
            task, margin = _task(rng, count, output), MARGIN[count]
            members = _members(rng, task, number)
            for wish in WISHES:
                facts = _facts_of_pivots(task, *members)
                good = np.logical_and.reduce([flags for _, flags in facts.met(wish)]) & facts.branch
                best = float(facts.transmission[good].max(initial=-np.inf))
                search = FunctionSearch(task, wish, lambda *pivots, task=task: _facts_of_pivots(task, *pivots))
                coupler, bound, found = search.improved(-np.inf)
                if bound is None:
                    continue
                decided += 1
                far = max(abs(part[good[:, 0]]).max(initial=0) for part in members)
                if far < 30 * search.size:
                    assert best <= bound + 1e-9, (seed, count, output, wish)
                near += best > found - 20 * margin
                if coupler is not None:
                    at = _facts_of_pivots(task, np.array([coupler.moving]), np.array([coupler.fixed]))
                    assert at.transmission[0, 0] == pytest.approx(found, abs=margin + 1e-9)
    return near, decided


def test_no_random_linkage_beats_what_is_proved_of_a_family():
    near, decided = np.sum([_never_better(seed, 4000) for seed in range(2)], axis=0)
    assert decided > 24
    assert near > 6


@pytest.mark.slow
def test_no_random_linkage_of_forty_tasks_beats_what_is_proved():
    near, decided = np.sum([_never_better(seed, 40_000) for seed in range(10, 20)], axis=0)
    assert decided > 140
    assert near > 40


def test_the_answer_says_what_is_proved_and_no_design_beats_it():
    task = FunctionTask([0, 0.36, 0.59, 0.8], outputs=[0, 0.56, 1, 1.49], start_input=False, start_output=False)
    found = synthesise_function(task)
    (note,) = [str(note) for note in found.notes if str(note).startswith("Proved")]
    bound = float(note.split("above ")[1].split("°")[0])
    best = max(np.degrees(design.verdict.transmission) for design in found.designs if design.form == "four-bar")
    assert bound - 0.2 < best <= bound
    none = synthesise_function(task, Demands(transmission=np.radians(bound)))
    assert not [design for design in none.designs if design.form == "four-bar"]
    assert any(str(note).startswith("Proved: no four-bar of the family meets all demands") for note in none.notes)


def test_an_angle_near_a_right_one_is_said_to_be_so():
    """Two pairs of a slider-crank: nothing exceeds 90 degrees, and the best one is nearer to it than the margin."""
    task = FunctionTask([0, 1.0], outputs=[0, 0.6], output="travel", start_input=False, start_output=False)
    found = synthesise_function(task)
    best = max(np.degrees(design.verdict.transmission) for design in found.designs)
    assert best > 90 - np.degrees(MARGIN[2])
    (said,) = (str(note) for note in found.notes if "is a right angle to" in str(note))
    assert f"{best:.1f}°, is a right angle to {np.degrees(MARGIN[2]):g}°" in said
