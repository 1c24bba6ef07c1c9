"""Verdicts on six-bars, structures of class III, curves, mixed targets, rests, obstacles against a simulation.

The simulation follows any plane linkage by Newton's method in small steps (`traced_linkage`) and shares nothing with
the library but the linkage, its targets and its drive values. Accepted, circuit, full turn, deviation, least
transmission angle are compared, and every reason for which a design is rejected has to be true.
"""

import numpy as np
import pytest

from gruebler.design.synthesis import Demands, DwellTask, PositionTask, SolutionCount, SynthesisResult
from gruebler.design.synthesis.dwells import synthesise_dwells
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.proposals import _kept_clear
from gruebler.design.synthesis.specification import Clearance, Specification
from gruebler.design.synthesis.targets import Probe, point_targets

from .simulated_tasks import KINDS, on_course, some_poses
from .simulated_verdict import Compared, faults_of_rest, least_gap
from .traced_linkage import values_of


def compared(kind, seeds):
    """All designs of random tasks of a kind, with what differs."""
    found = Compared(kind)
    for seed in seeds:
        rng = np.random.default_rng([*map(ord, kind[:12]), seed])
        before = found.accepted + found.rejected
        if kind in KINDS:
            for number, (design, *more) in enumerate(KINDS[kind](rng)):
                found.add((seed, number), design, *more)
        else:
            OTHERS[kind](rng, seed, found)
        found.tasks += found.accepted + found.rejected > before
    return found


def rests(rng, seed, found):
    """Six-bars with a dwell: a rest within a share of the swing or stroke, a least transmission angle over the turn."""
    dwell = np.radians(rng.uniform(40, 140))
    size = {"swing": np.radians(rng.uniform(15, 50))} if rng.integers(0, 2) else {"stroke": float(rng.uniform(5, 80))}
    task, chosen = DwellTask(dwell=dwell, **size), rng.integers(0, 3)
    demands = Demands(
        tolerance=float(10 ** rng.uniform(-4, -2)),
        transmission=np.radians(35.0) if chosen == 1 else 0.0,
        size_ratio=float(rng.choice([6.0, 20.0])),
    )
    result = synthesise_dwells(task, demands, number=3)
    for number, design in enumerate((*result.designs, *result.rejected)):
        found.count((seed, number), design.verdict, *faults_of_rest(design, task, demands, demands.tolerance))


def obstacles(rng, seed, found):
    """A body on a branch of a four-bar, beside lines that stand still: rejected for the first it comes too near."""
    course = on_course(rng)
    poses = some_poses(rng, course, 3)
    z = values_of(course.closing, (Probe("P"),), poses, 0 * poses)[0][:, 0]
    targets = point_targets("P", z, float(np.abs(z - z[0]).max()))
    design = judge_design(course.closing.linkage, targets, Demands(size_ratio=200.0), "four-bar")
    if not design.verdict.accepted:
        return
    task = PositionTask([(w.real, w.imag, 0.1 * k) for k, w in enumerate(z)])

    def line(count, middle, spread):
        return [(w.real, w.imag) for w in middle + spread * (rng.normal(size=count) + 1j * rng.normal(size=count))]

    body = line(3, z[0], 0.3)
    clear = [
        Clearance(
            body, obstacle=line(4, z.mean() + 2 * np.exp(1j * rng.uniform(0, 6)), 0.3), distance=rng.uniform(0, 0.3)
        )
        for _ in range(3)
    ]
    count = SolutionCount(what="linkages", theorem=0, found=1, real=1)
    result = SynthesisResult(task=task, designs=(design,), rejected=(), count=count)
    kept = _kept_clear(result, Specification(task, clear=clear))
    gaps = [least_gap(design, each) for each in clear]
    near = any(abs(gap - each.distance) < 2e-3 for gap, each in zip(gaps, clear, strict=True))
    hit = next((k for k, gap in enumerate(gaps, 1) if gap < clear[k - 1].distance or gap == 0), None)
    judged = (*kept.designs, *kept.rejected)[0]
    said = [] if hit is None else [f"the body comes too near to obstacle {hit}"]
    wrong = [("obstacle", gaps)] * ([*map(str, judged.verdict.reasons)] != said and not near)
    found.count((seed, 0), judged.verdict, wrong, near)


OTHERS = {"outputs that rest": rests, "obstacles": obstacles}


def assert_confirmed(kind, seeds):
    found = compared(kind, seeds)
    assert found.wrong == []
    assert found.lost <= found.tasks
    return found


@pytest.mark.parametrize(
    ("kind", "seeds"),
    [
        ("six-bars for eight pairs", [0, 1, 1010]),  # 1010: the transmission angle goes through zero
        ("six-bars for six positions", range(2)),
        ("structures, class III, outputs off the frame", range(6)),
        ("structures fitted", range(1)),
        ("mixed targets, bands, orders", [0, 1, 2, 8]),  # 8: the least transmission angle lies beside the first target
        ("whole curves", range(3)),
        ("obstacles", range(5)),
    ],
)
def test_verdicts_are_those_of_a_simulation(kind, seeds):
    found = assert_confirmed(kind, seeds)
    assert found.accepted + found.rejected >= len(seeds)


SEEDS = {
    "six-bars for eight pairs": range(1000, 1040),
    "six-bars for six positions": range(1000, 1050),
    "structures, class III, outputs off the frame": range(1000, 1050),
    "structures fitted": range(1000, 1020),
    "mixed targets, bands, orders": range(1000, 1040),
    "mixed targets, by the search": range(4),
    "whole curves": range(1000, 1040),
    "whole curves, by the search": range(4),
    "nine points": range(1000, 1008),
    "outputs that rest": range(1000, 1008),
    "obstacles": range(1000, 1050),
}
"""More than 300 tasks; of obstacles some seeds have none."""


@pytest.mark.slow
@pytest.mark.parametrize("kind", SEEDS)
def test_verdicts_of_many_tasks_are_those_of_a_simulation(kind):
    found = assert_confirmed(kind, SEEDS[kind])
    assert found.accepted > 0
    assert found.rejected > 0
