"""Verdicts of every kind of task against a simulation by another hand: accepted and rejected designs alike.

The simulation is in `simulation`; four-bars of positions have one of their own in `test_simulated_verdicts`. A target
counts as met within 1e-9 of the size of linkage and task, divided by the sine of the angle at which the last group
transmits there: so much a change of its lengths by 1e-9 moves it.
"""

from collections import Counter
from contextlib import suppress

import numpy as np
import pytest

from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    FunctionTask,
    PathTask,
    PositionTask,
    synthesise,
    synthesise_orientations,
    synthesise_path,
)
from gruebler.design.synthesis.dyad_families import guiding_dyads, sliding_family
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import BLOCK, SLIDER
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.targets import body_targets

from .simulation import (
    LAP,
    dead_centres,
    followed,
    least_angle,
    loop_of_lengths,
    plane_loop,
    simulated,
    sphere_loop,
)

_RATIO = 50.0
NEAR = np.radians(1e-4)
"""What lies nearer to a demanded angle is not compared."""
ANGLE = 1e-7
"""Sines of transmission angles agree to this: the verdict follows them by a parabola between fine steps."""


def _demands(rng):
    chosen = rng.integers(0, 5)
    return Demands(
        size_ratio=_RATIO,
        crank=bool(chosen == 1),
        transmission=np.radians(20.0) if chosen == 2 else 0.0,
        in_order=bool(chosen != 3),
    )


def _body(task):
    """Where pins of the body are wanted."""
    turns = task.turns / task.turns[0]
    return lambda _, pin, __, led: tuple(task.origins + (at - task.origins[0]) * turns for at in (pin, led))


def _positions(rng):
    """Linkages that slide of three positions, and of four all dyads together."""
    count = int(rng.integers(3, 5))
    angles = np.cumsum(rng.uniform(-0.2, 0.8, count))
    z = np.cumsum(rng.uniform(0.2, 1, count) * np.exp(1j * rng.uniform(0, 2.5, count)))
    rows = list(zip(z.real, z.imag, angles, strict=True))
    demands = _demands(rng)
    task = PositionTask(rows)
    if count == 3:
        pivots = [tuple(row) for row in rng.uniform(-2, 3, (2, 2))]
        cranks = guiding_dyads(PositionTask(rows, moving_pivots=pivots))
        along = [complex(np.exp(1j * each)) for each in rng.uniform(0, np.pi, 2)]
        slides = [dyad for kind in (SLIDER, BLOCK) for dyad in sliding_family(task, kind, along)]
    else:
        dyads = guiding_dyads(task, 8)
        cranks, slides = ([dyad for dyad in dyads if dyad.slides == each] for each in (False, True))
    for crank in cranks[:4]:
        for slide in slides:
            with suppress(LinkageError):
                linkage = linkage_of_dyads(crank, slide, complex(z[0]), "mm")
                form = f"{crank.kind.form}-{slide.kind.form}"
                design = judge_design(linkage, body_targets(task, linkage), demands, form)
                yield design, plane_loop(design, task.size, _body(task)), demands


def _functions(rng):
    travels, free = bool(rng.integers(0, 2)), int(rng.integers(0, 3))
    count = (3 if not free or travels else int(rng.integers(2, 4))) + free
    count = count if free == 2 else 3 + free
    inputs = np.cumsum(rng.uniform(0.15, 0.7, count))
    outputs = np.cumsum(rng.uniform(0.1, 0.7, count)) * rng.choice([-1, 1])
    if rng.integers(0, 3) == 0:
        outputs = rng.permutation(outputs)
    demands = _demands(rng)
    starts = {"start_input": free == 0, "start_output": free < 2}
    task = FunctionTask(tuple(inputs), outputs=tuple(outputs), output="travel" if travels else "angle", **starts)
    turned, moved = np.exp(1j * (inputs - inputs[0])), outputs - outputs[0]

    def poses(a0, pin, b0, led):
        return a0 + (pin - a0) * turned, led + moved if travels else b0 + (led - b0) * np.exp(1j * moved)

    found = synthesise(task, demands=demands)
    for design in (*found.designs, *found.rejected):
        yield design, plane_loop(design, float(np.ptp(outputs)) if travels else 0.0, poses), demands


def _timed(rng):
    count = int(rng.integers(3, 6))
    turn = np.cumsum(rng.uniform(0.2, 0.9, count))
    z = (2 * np.cos(turn) + 1j * np.sin(turn)) + 0.3 * (rng.normal(size=count) + 1j * rng.normal(size=count))
    timing = np.cumsum(rng.uniform(0.2, 0.9, count))
    task = PathTask([(w.real, w.imag) for w in z], crank_angles=tuple(timing))
    demands = _demands(rng)
    found = synthesise_path(task, demands, number=3)

    def poses(a0, pin, _, led):
        pins = a0 + (pin - a0) * np.exp(1j * (timing - timing[0]))
        return pins, pins + (led - pin) * (z - pins) / (z[0] - pin)

    for design in (*found.designs, *found.rejected):
        yield design, plane_loop(design, task.size, poses), demands


def _points(rng):
    turn = np.sort(rng.uniform(0, 4, 5))
    z = 2 * np.cos(turn) + 1j * np.sin(turn) + 0.2 * (rng.normal(size=5) + 1j * rng.normal(size=5))
    pivots = [tuple(row) for row in rng.normal(size=(2, 2)) * 2]
    task = PathTask([(w.real, w.imag) for w in z], fixed_pivots=pivots)
    demands = _demands(rng)
    found = synthesise_path(task, demands)
    for design in (*found.designs, *found.rejected):
        point = design.linkage.points["P"]
        pose = design.linkage.required_pose[point.link]
        at = complex(pose.x, pose.y) + complex(point.x, point.y) * np.exp(1j * pose.angle)
        yield design, plane_loop(design, task.size, points=z, point=at), demands


def _orientations(rng):
    count = int(rng.integers(3, 6))
    turns = [np.eye(3)]
    for _ in range(count - 1):
        axis = rng.normal(size=3)
        x, y, z = axis / np.linalg.norm(axis)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        angle = rng.uniform(0.2, 0.8)
        turns.append((np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross) @ turns[-1])
    demands = _demands(rng)
    found = synthesise_orientations(np.array(turns), demands, number=3)
    for design in (*found.designs, *found.rejected):
        if min(design.four_bar.a, design.four_bar.b, design.four_bar.c, design.four_bar.d) > 1e-3:
            yield design, sphere_loop(design.axes, np.array(turns[1:])), demands


KINDS = {
    "positions with slides": _positions,
    "pairs of a function": _functions,
    "points with crank angles": _timed,
    "points and two pivots": _points,
    "orientations on the sphere": _orientations,
}


def _expected(seen, verdict, demands):
    """What the simulation says of a design; none where it is too near to a demanded angle to tell."""
    if demands.transmission and abs(seen.transmission - demands.transmission) < NEAR:
        return None
    allowed = not demands.transmission or seen.transmission >= demands.transmission
    turns = seen.turns or not demands.crank
    return seen.passes and allowed and turns and verdict.size_ratio <= demands.size_ratio


def _compared(kind, seeds):
    """What differs, and how many tasks, accepted and rejected designs there were."""
    wrong, count = [], Counter()
    for seed in seeds:
        rng = np.random.default_rng([*map(ord, kind[:8]), seed])
        judged = []
        with suppress(SynthesisError):
            judged = [*KINDS[kind](rng)]
        count["tasks"] += bool(judged)
        for number, (design, loop, demands) in enumerate(judged):
            verdict = design.verdict
            if loop is None or not verdict.assembles or verdict.size_ratio > _RATIO:
                count["left out"] += 1
                continue
            seen = simulated(loop, in_order=demands.in_order)
            expected = _expected(seen, verdict, demands)
            count["accepted" if verdict.accepted else "rejected"] += 1
            told = (seed, number, design.form if hasattr(design, "form") else "", seen, str(verdict))
            if expected is not None and expected != verdict.accepted:
                wrong.append(("accepted", *told))
            if verdict.one_circuit != seen.circuit and kind != "orientations on the sphere":
                wrong.append(("circuit", *told))
            if verdict.one_branch and verdict.turns_fully != seen.turns:
                wrong.append(("turns", *told))
            if (
                verdict.accepted
                and seen.passes
                and abs(np.sin(verdict.transmission) - np.sin(seen.transmission)) > ANGLE
            ):
                wrong.append(("transmission", *told, verdict.transmission))
    return wrong, count


def _dead_centre_task(rng):
    if rng.integers(0, 2):
        swing = rng.uniform(15, 140)
        return DeadCentreTask(
            swing=np.radians(swing), crank_angle=np.radians(90 + swing / 2 + 180 * rng.uniform(0.1, 0.9))
        )
    return DeadCentreTask(stroke=float(rng.uniform(1, 90)), crank_angle=np.radians(90 + 180 * rng.uniform(0.1, 0.9)))


def _compared_dead_centres(seeds):
    """The same of dead centres: two of them, swing or stroke, the crank angle between them, demands."""
    wrong, count = [], Counter()
    for seed in seeds:
        rng = np.random.default_rng([100, seed])
        task = _dead_centre_task(rng)
        best = synthesise(task, number=1).designs or synthesise(task, number=1).rejected
        least = best[0].verdict.transmission * rng.uniform(0.3, 1.1)
        demands = Demands(size_ratio=rng.uniform(2, 20), transmission=min(least, 1.5) if seed % 2 else 0.0)
        found = synthesise(task, demands=demands, number=6)
        count["tasks"] += 1
        for number, design in enumerate((*found.designs, *found.rejected)):
            slides, elements = task.swing is None, design.linkage.elements
            lengths = [elements[1, "crank"].x, elements[2, "coupler"].x]
            if slides:
                loop = loop_of_lengths(*lengths, eccentricity=elements[3, "frame"].y)
            else:
                lengths += [elements[2, "rocker"].x, elements[3, "frame"].x]
                loop = loop_of_lengths(*lengths)

            def output(led, slides=slides, pivot=lengths[-1]):
                return np.real(led) if slides else np.angle(led - pivot)

            back = dead_centres(loop, output)
            count["accepted" if design.verdict.accepted else "rejected"] += 1
            told = (seed, number, task, back, str(design.verdict))
            if len(back) != 2:
                wrong.append(("dead centres", *told))
                continue
            (low_turn, low), (high_turn, high) = sorted(back, key=lambda row: row[1])
            reach, between = task.stroke if slides else task.swing, (high_turn - low_turn) % LAP
            if abs(high - low - reach) > 1e-9 * max(1.0, loop.size):
                wrong.append(("travel", *told))
            apart = min(abs(each - task.angle) for each in ((between, LAP - between) if slides else (between,)))
            if apart > 1e-7:
                wrong.append(("crank angle", *told, apart))
            least = least_angle(loop, {1: followed(loop, 1)}, 0.0, LAP)
            meets = max(lengths) <= demands.size_ratio * min(lengths) and least >= demands.transmission
            near = (
                abs(least - demands.transmission) < 1e-8
                or abs(max(lengths) / min(lengths) / demands.size_ratio - 1) < 1e-9
            )
            if not near and meets != design.verdict.accepted:
                wrong.append(("accepted", *told, np.degrees(least), max(lengths) / min(lengths)))
            if abs(np.sin(least) - np.sin(design.verdict.transmission)) > 1e-9:
                wrong.append(("transmission", *told, least - design.verdict.transmission))
    return wrong, count


SEEDS = {
    "positions with slides": range(1000, 1240),
    "pairs of a function": range(1000, 1240),
    "points with crank angles": range(1000, 1160),
    "points and two pivots": range(1000, 1160),
    "orientations on the sphere": range(1000, 1140),
}
"""With 140 of dead centres 1,000 tasks and more; some seeds have none."""


@pytest.mark.parametrize(
    ("kind", "seeds"),
    [
        ("positions with slides", range(4)),
        ("pairs of a function", [*range(8), 192]),  # 192: the least transmission angle lies just before the last pair
        ("points with crank angles", range(2)),
        ("points and two pivots", range(2)),
        ("orientations on the sphere", [0, 1, 1081]),  # 1081: any order, whose shortest way is another one
    ],
)
def test_verdicts_are_those_of_a_simulation(kind, seeds):
    wrong, count = _compared(kind, seeds)
    assert wrong == []
    assert count["accepted"] + count["rejected"] > 5


def test_dead_centres_are_those_of_a_simulation():
    wrong, count = _compared_dead_centres(range(3))
    assert wrong == []
    assert count["accepted"] > 5


@pytest.mark.slow
@pytest.mark.parametrize("kind", SEEDS)
def test_verdicts_of_many_tasks_are_those_of_a_simulation(kind):
    wrong, count = _compared(kind, SEEDS[kind])
    assert wrong == []
    assert min(count["accepted"], count["rejected"]) > 50


@pytest.mark.slow
def test_dead_centres_of_many_tasks_are_those_of_a_simulation():
    wrong, count = _compared_dead_centres(range(1000, 1140))
    assert wrong == []
    assert min(count["accepted"], count["rejected"]) > 50
