"""Linkages that follow many pairs most nearly: against linkages that drew them, and against a search by triangles."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

from gruebler.design.synthesis import Demands, FunctionTask, function_task, synthesise
from gruebler.design.synthesis.coordination import KINDS
from gruebler.design.synthesis.formulas import FunctionLaw
from gruebler.design.synthesis.functions import synthesise_function
from gruebler.design.synthesis.judging import distances_of_pins
from gruebler.design.synthesis.nearest_functions import nearest_linkages

FOUR_BAR, SLIDER_CRANK = KINDS[:2]


def rockers(a, b, c, angles, side):
    """The angles of the rocker of a frame of 1 by the triangle of coupler and rocker; NaN where it does not close."""
    pin = a * np.exp(1j * angles)
    gap = 1 - pin
    far = abs(gap)
    along = (b * b - c * c + far**2) / (2 * far)
    with np.errstate(invalid="ignore"):
        beside = np.sqrt(b * b - along**2)
    return np.angle(pin + gap / far * (along + 1j * side * beside) - 1)


def sliders(a, b, e, angles, side):
    with np.errstate(invalid="ignore"):
        return a * np.cos(angles) + side * np.sqrt(b * b - (e - a * np.sin(angles)) ** 2)


@pytest.mark.parametrize("seed", range(8))
def test_the_linkage_that_drew_the_pairs_is_found(seed):
    rng = np.random.default_rng(seed)
    kind, output_of = ((FOUR_BAR, rockers), (SLIDER_CRANK, sliders))[seed % 2]
    while True:
        lengths, start, side = rng.uniform(0.3, 3, 3), rng.uniform(0, 2 * np.pi), rng.choice([1, -1])
        angles = start + np.linspace(0, rng.uniform(0.7, 2.5), 12)
        drawn = output_of(*lengths, angles, side)
        if np.isfinite(drawn).all() and np.ptp(np.unwrap(drawn)) > 0.3:
            break
    if kind is FOUR_BAR:
        drawn = np.unwrap(drawn)
    turned, moved = angles - start, drawn - drawn[0]
    for given in ({}, {"start_input": True}, {"start_input": True, "start_output": True}):
        found = nearest_linkages(
            kind,
            angles if "start_input" in given else turned,
            drawn if "start_output" in given else moved,
            **given,
        )[0]
        own = found.lengths
        assert own[:3] == pytest.approx(lengths, rel=1e-5), given
        assert np.exp(1j * found.input_start) == pytest.approx(np.exp(1j * start), abs=1e-5)


def least_largest_error(law, seed):
    """By 40,000 random four-bars and Nelder and Mead's simplex from the best of them: an upper bound, in radians."""
    rng = np.random.default_rng(seed)

    def largest(logs, start, side, places=60):
        x = np.linspace(*law.interval, places)
        phi, psi = law.inputs(x), law.outputs(x)
        moved = np.unwrap(rockers(*np.exp(logs)[..., None], start[..., None] + phi, side)) - psi
        return np.nan_to_num(np.ptp(moved, axis=-1) / 2, nan=np.inf)

    best = np.inf
    for side in (1, -1):
        logs, starts = rng.uniform(np.log(0.08), np.log(8), (3, 20_000)), rng.uniform(0, 2 * np.pi, 20_000)
        errors = largest(logs, starts, side)
        for k in np.argsort(errors)[:4]:
            z = np.append(logs[:, k], starts[k])
            for _ in range(3):
                z = minimize(
                    lambda z, side=side: min(float(largest(z[:3], z[3], side)), 1e3),
                    z,
                    method="Nelder-Mead",
                    options={"maxiter": 900, "xatol": 1e-9, "fatol": 1e-12},
                ).x
            best = min(best, float(largest(z[:3], z[3], side, 4000)))
    return best


LAWS = [
    # of both, the one four-bar through five pairs meets them in another order
    pytest.param("x**1.5", (0, 1), 64, -105, marks=pytest.mark.slow),
    ("x**1.5", (0, 1), 81, -118),
    pytest.param("exp(x)", (0, 1), 105, -81, marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("formula", "interval", "input_swing", "output_swing"), LAWS)
def test_no_search_by_triangles_betters_the_minimax_optimum(formula, interval, input_swing, output_swing):
    swings = {"input_swing": np.radians(input_swing), "output_swing": np.radians(output_swing)}
    law = FunctionLaw(formula, interval=interval, **swings)
    best = synthesise_function(function_task(law, 5), minimax=True).designs[0]
    assert best.optimum.certificate.optimum
    assert best.optimum.error <= 1.001 * least_largest_error(law, 1)


def test_a_table_is_met_though_no_exact_linkage_keeps_its_order():
    """Of the four-bar of the first law above, whose largest error is 0.6017 degrees; least squares come near that."""
    law = FunctionLaw("x**1.5", interval=(0, 1), input_swing=np.radians(64), output_swing=np.radians(-105))
    pairs = function_task(law, 9)
    table = FunctionTask(pairs.inputs, outputs=pairs.outputs, start_input=False, start_output=False)
    best = synthesise(table).designs[0]
    assert best.verdict.error < np.radians(0.6017)
    a, b, c, d = (distances_of_pins(best.linkage, link)[0] for link in ("crank", "coupler", "rocker", "frame"))
    errors = []
    for side in (1, -1):
        moved = np.unwrap(rockers(a / d, b / d, c / d, np.array(best.drives), side)) - pairs.outputs
        errors.append(abs(moved - np.mean([moved.min(), moved.max()])).max())
    assert min(errors) <= best.verdict.error + 1e-9


def test_a_linkage_that_begins_at_a_dead_centre_is_passed_over():
    """Rounding parts some of the nearest at their first pair; the others have their errors, by the triangle."""
    inputs, outputs = np.radians([0, 20, 45, 60, 75, 90]), np.radians([0, 8, 25, 38, 48, 60])
    table = FunctionTask(tuple(inputs), outputs=tuple(outputs), start_input=False, start_output=False)
    found = synthesise(table, demands=Demands(crank=False, transmission=0.0))
    designs = found.designs
    assert designs
    (note,) = (note for note in found.notes if note.text.startswith("Linkages that begin at a dead centre"))
    assert note.values["count"] >= 1
    assert note.values["error"] > 0
    for design in designs:
        a, b, c, d = (distances_of_pins(design.linkage, link)[0] for link in ("crank", "coupler", "rocker", "frame"))
        sides = [rockers(a / d, b / d, c / d, np.array(design.drives), side) for side in (1, -1)]
        errors = [np.unwrap(one) - outputs for one in sides]
        # the start of the output is free: the largest error is at least half of what errors differ by
        assert min(np.ptp(one) / 2 for one in errors) <= design.verdict.error + 1e-9
        assert min(np.ptp(one) for one in errors) >= design.verdict.error - 1e-9
