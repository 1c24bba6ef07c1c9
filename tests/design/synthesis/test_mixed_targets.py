"""Targets of several kinds at once: met exactly, within a band, nearly; by `move`, and by another optimiser."""

from dataclasses import replace
from math import cos, radians, sin

import numpy as np
import pytest
from scipy.optimize import minimize

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PathTask, synthesise_path
from gruebler.design.synthesis import mixed_targets as mixed
from gruebler.design.synthesis.curves import limits_of
from gruebler.design.synthesis.four_bar_kinds import FOUR_BAR
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.proposals import propose
from gruebler.design.synthesis.specification import Specification
from gruebler.design.synthesis.targets import point_targets
from gruebler.files.tasks import read_task, task_from_json, task_to_json, write_task
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move

PHI = np.radians([10, 40, 75, 110, 150, 190])
MOTION = move(FourBar(1, 3, 2.5, 3.5).linkage({"P": (1.2, 0.8)}), PHI)
Z, COUPLER, ROCKER = MOTION.complex_point("P"), MOTION.angle("coupler"), MOTION.angle("rocker")
NOISE = 0.03 * np.array([1, -0.5 + 1j, -1j, 0.7 - 0.6j, -0.8 + 0.2j, 0.3 + 0.9j])


def points(z):
    return [(w.real, w.imag) for w in z]


def misses(design, task):
    """How far each target is missed, by the motion alone: places, and angles as arcs of the task's size."""
    motion = move(design.linkage, design.drives)
    place = np.abs(motion.complex_point("P") - task.z)
    total = np.where(np.isnan(place), 0, place) ** 2
    for link, wanted in (
        ("coupler", task.angles),
        ("crank", task.crank_angles),
        ("rocker", task.output_angles),
    ):
        given = [k for k, angle in enumerate(wanted) if angle is not None]
        if given:
            gaps = motion.angle(link)[given] - np.array([wanted[k] for k in given])
            constant = np.angle(np.exp(1j * gaps[0]))  # that of the first exact target: only differences count
            total[given] += (task.size * np.angle(np.exp(1j * (gaps - constant)))) ** 2
    return np.sqrt(total)


MIXED = {
    "positions with timing": PathTask(
        points(Z[:4]), angles=COUPLER[:4], crank_angles=PHI[:4], tolerances=[0, 0, 0, 0.02]
    ),
    "points, positions, outputs": PathTask(
        points(Z[:4]),
        angles=[COUPLER[0], None, COUPLER[2], None],
        output_angles=[ROCKER[0], ROCKER[1], None, ROCKER[3]],
        tolerances=[0, 0, 0, 0],
    ),
    "angles without a point": PathTask(
        [*points(Z[:2]), None, *points(Z[3:5])],
        crank_angles=PHI[:5],
        output_angles=ROCKER[:5],
        tolerances=[0, 0.02, 0, 0.02, 0],
    ),
    "bands about noisy points": PathTask(
        points(Z + NOISE), crank_angles=PHI, tolerances=[0, 0.05, 0.05, 0.05, 0.05, 0]
    ),
}


@pytest.mark.parametrize("task", MIXED.values(), ids=MIXED)
def test_designs_meet_each_target_within_its_own_tolerance(task):
    """Targets that a four-bar met: its places, coupler, crank and output angles, by `move`."""
    found = synthesise_path(task, number=3)
    assert len(found.designs) == 3
    for design in found.designs:
        assert (misses(design, task) <= np.array(task.tolerances) + 2e-9 * task.size).all()
        assert 1 - 1e-9 < design.verdict.size_ratio <= 20


@pytest.mark.parametrize("demands", [Demands(crank=True), Demands(region=(-1, -2, 5, 2), transmission=radians(30))])
def test_demands_are_kept_in_the_search(demands):
    found = synthesise_path(MIXED["bands about noisy points"], demands, number=3)
    assert found.designs
    assert all(design.verdict.accepted and design.verdict.inside for design in found.designs)
    assert len(found.rejected) <= 3


def test_two_positions_with_crank_angles_have_many_four_bars():
    task = PathTask(points(Z[:2]), angles=COUPLER[:2], crank_angles=PHI[:2])
    found = synthesise_path(task, number=4)
    assert len(found.designs) == 4
    assert max(misses(design, task).max() for design in found.designs) < 1e-8


def test_a_given_frame_is_kept():
    """Points and crank angles with both pivots, refused before: the pivots of the four-bar that met them."""
    task = PathTask(points(Z[:3]), crank_angles=PHI[:3], fixed_pivots=[(0, 0), (3.5, 0)])
    found = synthesise_path(task, number=2)
    assert found.designs
    for design in found.designs:
        frame = [complex(e.x, e.y) for (_, link), e in design.linkage.elements.items() if link == "frame"]
        assert sorted(frame, key=abs) == pytest.approx([0, 3.5], abs=1e-12)


def test_nearly_and_exactly_against_another_optimiser():
    """Ends exactly, the rest as nearly as possible: sequential quadratic programming from the four-bar itself.

    It starts where the noise was added, the best start that there is; the places by intersecting circles.
    """
    task = PathTask(points(Z + NOISE), angles=COUPLER, tolerances=[0, None, None, None, None, 0])
    best = synthesise_path(task, number=6).designs

    def gaps(x):
        a0, b0, (a, b, c), w = complex(*x[:2]), complex(*x[2:4]), x[4:7], complex(*x[7:9])
        pin = a0 + a * np.exp(1j * x[10:])
        gap = b0 - pin
        along = (b * b - c * c + np.abs(gap) ** 2) / (2 * np.abs(gap))
        turned = gap / np.abs(gap) * (along + 1j * np.sqrt(np.maximum(b * b - along**2, 0))) / b
        return np.stack(
            [np.abs(pin + w * turned - task.z), task.size * np.angle(turned * np.exp(1j * (x[9] - COUPLER)))]
        )

    start = np.array([0, 0, 3.5, 0, 1, 3, 2.5, 1.2, 0.8, 0, *PHI])
    assert np.abs(gaps(start)[1]).max() < 1e-9
    ends = {"type": "eq", "fun": lambda x: (1e3 * gaps(x)[:, [0, -1]] ** 2).ravel()}
    other = minimize(lambda x: np.sum(gaps(x) ** 2), start, constraints=ends, method="SLSQP", options={"maxiter": 200})
    costs = [np.sum(misses(design, task) ** 2) for design in best]
    assert min(costs) <= 1.01 * other.fun


def test_the_derivatives_against_differences():
    task = MIXED["bands about noisy points"]
    angles = np.stack([COUPLER, PHI, ROCKER])
    wanted = replace(mixed._wanted(task, task.size, complex(task.z.mean())), angles=angles)
    limits = next(limits_of(None, (), (FOUR_BAR,), False, (complex(task.z.mean()), task.size)))
    state = mixed._starts(wanted, limits).at([0, 7, 90])
    slopes, step = mixed._rest(wanted, state).slopes, 1e-6
    for k in range(slopes.shape[-1]):
        ends = []
        for sign in (1, -1):
            rows, phi = state.rows.copy(), state.phi.copy()
            if k < len(rows):
                rows[k] += sign * step
            else:
                phi += sign * step
            ends.append(mixed._rest(wanted, mixed._State(rows, phi, state.side)).errors)
        differences = (ends[0] - ends[1]) / (2 * step)
        assert slopes[..., k] == pytest.approx(differences, rel=1e-6, abs=1e-6 * (1 + np.abs(differences).max()))


def test_a_target_beyond_its_own_tolerance_is_named():
    """The third place lies 0.02 off what the four-bar draws, its tolerance is a quarter of that."""
    four_bar = MOTION.linkage.with_reference_pose(MOTION.pose(0))
    size = float(np.abs(Z - Z[0]).max())
    reasons = {}
    for share in (0.25, 1.01):
        allowed = np.array([np.inf, np.inf, share * 0.02 / size, np.inf, np.inf, np.inf])
        normal = 1j * (Z[3] - Z[1]) / abs(Z[3] - Z[1])
        z = Z + 0.02 * normal * (np.arange(6) == 2)
        targets = replace(point_targets("P", z, size), allowed=allowed)
        reasons[share] = judge_design(four_bar, targets, Demands(tolerance=0.05), "four-bar").verdict.reasons
    assert reasons[1.01] == ()
    assert "target 3 is missed by" in str(reasons[0.25][0])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"tolerances": [0, -1, 0]}, "tolerances 2: expected at least 0, but found -1"),
        ({"tolerances": [0, 1]}, "tolerances: expected one for each of the 3 points, but found 2"),
        ({"weights": [1, 2, "x"]}, "weights 3: expected a number, but found 'x'"),
        ({"output_angles": [1, 2]}, "output_angles: expected one for each of the 3 points, but found 2"),
        ({"points": [(0, 0), None, None]}, "points: expected at least two, but found 1"),
        ({"crank_angles": [0, None, 7]}, "all points lie within one turn"),
    ],
)
def test_bad_mixes_are_told_in_one_sentence(given, message):
    with pytest.raises(SynthesisError) as caught:
        PathTask(**{"points": [(0, 0), (1, 1), (2, 0)], **given})
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_more_exact_conditions_than_numbers_are_refused():
    """Nine positions: 27 conditions; nine numbers, nine crank angles and the constant of the coupler angle are 19."""
    z = [(cos(k / 3), sin(k / 2)) for k in range(9)]
    with pytest.raises(SynthesisError, match="27 conditions, but a four-bar can meet 19 of this kind"):
        synthesise_path(PathTask(z, angles=np.linspace(0, 1, 9), tolerances=[0] * 9))


@pytest.mark.parametrize("ending", ["toml", "json", "csv"])
def test_files_keep_mixed_tasks(tmp_path, ending):
    task = PathTask(
        [(0, 0), None, (3, 1.5)],
        angles=[0.1, None, 0.7],
        crank_angles=[0, 0.5, None],
        output_angles=[None, 0.2, 0.3],
        tolerances=[0, 0.25, None],
        weights=[1, 1, 2.5],
    )
    write_task(tmp_path / f"task.{ending}", task)
    assert read_task(tmp_path / f"task.{ending}") == task
    assert task_from_json(task_to_json(task)) == task


def test_a_specification_of_mixed_targets_tries_four_bars():
    found = propose(Specification(MIXED["angles without a point"], demands=Demands(crank=True)))
    assert [each.mechanism for each in found.tried] == [None]
    assert found.best
