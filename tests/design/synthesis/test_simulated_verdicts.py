"""Verdicts against a simulation by another hand: circles cut by circles, in small steps of the crank, nothing else.

Tasks are random positions of a body; what the simulation needs of a design are its four pivots in the first position.
It shares no code with `circuit` or `move`, and asks for no sign, limit or order by theorem: the pin follows its own
way, and is compared with the place that the task gives it. Every second task gives each position a place in the order.
"""

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PositionTask, synthesise_positions

from .test_target_orders import kept_by_angles, random_ranks

_RATIO = 50

STEP = np.radians(0.05)
"""Of the crank; shorter where its pin would go by more than `SHARE` of coupler or rocker, so that no fold is jumped."""
SHARE = 0.02
MET = 1e-9
"""Sizes, by which a place may be missed, divided by the sine of the transmission angle: so much lengths that are off by
1e-9 move it."""
MOST = 1e-6
"""Near a fold both places of the pin lie nearer to each other than that; by so much no place may be missed."""


def pivots_of(design):
    """A0, A, B, B0 of an RR-RR design in its first position."""
    linkage = design.linkage
    pose = linkage.required_pose
    joints = linkage.mechanism.chain.joints
    places = {}
    for (joint, link), element in linkage.elements.items():
        at = complex(element.x, element.y)
        if link in pose:
            at = complex(pose[link].x, pose[link].y) + np.exp(1j * pose[link].angle) * at
        places[frozenset(joints[joint].links)] = at
    return [
        places[frozenset(links.split())] for links in ("frame crank", "crank coupler", "coupler rocker", "frame rocker")
    ]


def cut_circles(pin, centre, coupler, rocker):
    """Both places of B for places of A; NaN where the circles do not meet."""
    line = centre - pin
    distance = np.abs(line)
    along = (coupler**2 - rocker**2 + distance**2) / (2 * distance)
    with np.errstate(invalid="ignore"):
        across = np.sqrt(coupler**2 - along**2)
    return [pin + line / distance * (along + side * 1j * across) for side in (1, -1)]


def _nearest(candidates, wanted):
    first, second = candidates
    return np.where(np.abs(first - wanted) <= np.abs(second - wanted), first, second)


def simulated(pivots, moved):
    """How far the crank turns to each target, forward and backward; NaN where it is not reached within a lap.

    Args:
        pivots: (4, designs) in the first position.
        moved: (2, designs, targets) where the task has the pins A and B in each position.
    """
    a0, a, b, b0 = pivots
    crank, coupler, rocker = np.abs(a - a0), np.abs(b - a), np.abs(b - b0)
    size = np.maximum.reduce([crank, coupler, rocker, np.abs(b0 - a0)])
    step = np.minimum(STEP, SHARE * np.minimum(coupler, rocker) / crank)
    turns = np.angle((moved[0] - a0[:, None]) / (a - a0)[:, None])
    answers = []
    for sense in (1, -1):
        due = (sense * turns) % (2 * np.pi)
        reached = np.full(due.shape, np.nan)
        reached[:, 0] = 0
        last, here, alive = b, b, np.ones(len(a), bool)
        at = np.zeros(len(a))
        while (alive & (at < due.max(axis=1))).any():
            now = (due > at[:, None]) & (due <= (at + step)[:, None])
            for j in range(1, due.shape[1]):
                rows = np.flatnonzero(now[:, j] & alive)
                pins = a0[rows] + (a - a0)[rows] * np.exp(1j * sense * due[rows, j])
                share = (due[rows, j] - at[rows]) / step[rows]
                wanted = here[rows] + share * (here - last)[rows]
                there = _nearest(cut_circles(pins, b0[rows], coupler[rows], rocker[rows]), wanted)
                area = np.imag(np.conj(there - pins) * (there - b0[rows]))
                sine = np.abs(area) / (coupler[rows] * rocker[rows])
                hit = np.abs(there - moved[1][rows, j]) < np.minimum(MET / sine, MOST) * size[rows]
                reached[rows[hit], j] = due[rows[hit], j]
            pins = a0 + (a - a0) * np.exp(1j * sense * (at + step))
            there = _nearest(cut_circles(pins, b0, coupler, rocker), 2 * here - last)
            alive &= np.isfinite(there)
            last, here = np.where(alive, here, last), np.where(alive, there, here)
            at = at + step
        answers.append(reached)
    return answers


def _verdicts(seeds):
    """Pivots, moved pins and the verdict of each RR-RR design of random tasks; how many tasks there were."""
    rows = []
    tasks = 0
    for seed in seeds:
        rng = np.random.default_rng(seed)
        count = int(rng.integers(3, 6))
        angles = np.cumsum(rng.uniform(-0.2, 0.8, count))
        z = np.cumsum(rng.uniform(0.2, 1, count) * np.exp(1j * rng.uniform(0, 2.5, count)))
        chosen = {}
        if count == 3:
            chosen["moving_pivots"] = [tuple(row) for row in rng.uniform(-2, 3, (3, 2))]
        elif count == 4:
            chosen["curve_parameters"] = tuple(rng.uniform(0, 1, 3))
        ranks = random_ranks(rng, count) if seed % 2 else ()
        try:
            task = PositionTask(list(zip(z.real, z.imag, angles, strict=True)), order=ranks, **chosen)
            found = synthesise_positions(task, Demands(size_ratio=_RATIO))
        except SynthesisError:
            continue
        tasks += 1
        for design in (*found.designs, *found.rejected):
            if design.form == "RR-RR" and design.verdict.size_ratio < _RATIO:
                pivots = np.array(pivots_of(design))
                moved = z + (pivots[1:3, None] - z[0]) * np.exp(1j * (angles - angles[0]))
                rows.append((seed, pivots, moved, design.verdict.accepted, ranks or tuple(range(count))))
    return rows, tasks


def passes(onward, back, ranks):
    """Whether a crank reaches all targets, in order; onward and back it turns to each by so much, or NaN."""
    if np.isnan(np.fmin(onward, back)).any():
        return False
    turns = not np.isnan(onward + back).any()
    return kept_by_angles(ranks, np.where(np.isnan(onward), -back, onward), turns=turns)


def _disagreements(seeds):
    """The seeds of designs on which verdict and simulation differ; accepted ones, rejected ones, tasks."""
    rows, tasks = _verdicts(seeds)
    wrong = []
    for count in (3, 4, 5):
        same = [row for row in rows if row[2].shape[1] == count]
        if not same:
            continue
        pivots = np.array([row[1] for row in same]).T
        moved = np.array([row[2] for row in same]).transpose(1, 0, 2)
        reached = zip(*simulated(pivots, moved), strict=True)
        passed = [passes(*both, row[4]) for both, row in zip(reached, same, strict=True)]
        wrong += [(row[0], row[3]) for row, moves in zip(same, passed, strict=True) if row[3] != moves]
    accepted = sum(row[3] for row in rows)
    return wrong, accepted, len(rows) - accepted, tasks


def test_verdicts_of_random_tasks_are_those_of_a_simulation():
    wrong, accepted, rejected, _ = _disagreements(range(16))
    assert wrong == []
    assert min(accepted, rejected) > 3


@pytest.mark.slow
def test_verdicts_of_a_thousand_random_tasks_are_those_of_a_simulation():
    wrong, accepted, rejected, tasks = _disagreements(range(1000, 2010))
    assert wrong == []
    assert tasks >= 1000
    assert min(accepted, rejected) > 300
