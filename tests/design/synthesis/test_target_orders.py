"""The order of targets, one by one: against the exact angles at which they are passed, and against all sequences."""

from itertools import product

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PathTask, PositionTask, synthesise_path, synthesise_positions
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.ordered_matching import SmoothCurve, TargetDistances
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.design.synthesis.targets import Targets, position_targets
from gruebler.files.tasks import read_task, write_task
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move

from .test_ordered_matching import Wave, least_in_order


def random_ranks(rng, count):
    return tuple(None if rank == 0 else int(rank) for rank in rng.integers(0, 4, count))


def kept_by_angles(ranks, angles, *, turns):
    """Whether angles of a crank are passed in order, in one sense or the other; a lap may begin anywhere."""
    along = [ranks[k] for k in np.argsort(angles) if ranks[k] is not None]
    laps = [along[k:] + along[:k] for k in range(len(along))] if turns else [along]
    return any(lap in (sorted(lap), sorted(lap)[::-1]) for lap in laps) or not along


FOUR_BARS = {True: FourBar(1, 3, 2.5, 3.5), False: FourBar(3, 2, 2.5, 4)}  # the first crank turns fully


@pytest.mark.parametrize("tolerance", [1e-9, 1e-3], ids=["met", "approached"])
@pytest.mark.parametrize("turns", [True, False])
def test_verdicts_against_the_angles_of_passing(turns, tolerance):
    """Positions of a coupler at known crank angles; no position occurs at a second one."""
    rng = np.random.default_rng(3)
    linkage = FOUR_BARS[turns].linkage({"P": (1.2, 0.8)})
    found = []
    for _ in range(30):
        count = int(rng.integers(4, 8))
        rising = np.sort(rng.uniform(0, 2 * np.pi, count) if turns else rng.uniform(0.3, 1.1, count))
        if np.diff(rising).min() < 0.02 or np.diff(rising).max() > 3:
            continue
        ranks, rows = random_ranks(rng, count), rng.permutation(count)
        angles, motion = rising[rows], move(linkage, rising)
        held = linkage.with_reference_pose(motion.pose(int(rows[0])))
        place, angle = motion.complex_point("P")[rows], motion.angle("coupler")[rows]
        placed = position_targets("P", "coupler", place, angle, 1.0)
        targets = Targets(placed.probes, placed.values, 1.0, ranks=ranks)
        design = judge_design(held, targets, Demands(tolerance=tolerance), "four-bar")
        expected = kept_by_angles(ranks, angles, turns=turns)
        assert design.verdict.accepted == expected, (ranks, angles)
        found.append(expected)
        if expected:  # the drives lead to each target, all within a lap
            assert np.cos(np.array(design.drives) - angles) == pytest.approx(1, abs=1e-6)
            assert np.ptp(design.drives) < 2 * np.pi
    assert 3 < sum(found) < len(found) - 3


@pytest.mark.parametrize("closed", [True, False])
def test_the_distance_in_an_order_is_the_least_over_all_sequences(closed):
    """Of dense samples: never less, and more by half a step at most."""
    for seed in range(8):
        wave = Wave(seed, closed=closed)
        count = 3 + seed % 3
        targets = wave(wave.rng.uniform(0, 2 * np.pi, count)) + 0.2 * wave.rng.normal(size=count)
        ranks = random_ranks(wave.rng, count)
        order = TargetOrder.of(ranks, count)
        order = TargetOrder.of((), count) if order.demands_nothing else order
        curve = SmoothCurve(wave.samples, wave(wave.samples)[:, None], wave(wave.samples, 1)[:, None], closed)
        match = TargetDistances(curve, targets[:, None], 1.0).best_in_order(order=order)
        dense = np.linspace(0, 2 * np.pi, 600, endpoint=not closed)
        gaps = np.abs(wave(dense) - targets[:, None])
        other = min(least_in_order(gaps[list(sequence)], closed=closed) for sequence in order.sequences())
        assert -wave.rounding <= other - match.error <= wave.rounding + wave.fastest * (dense[1] - dense[0]) / 2
        assert match.span <= curve.length * (1 + 1e-9)
        assert np.abs(wave(match.arcs) - targets).max() == pytest.approx(match.error, abs=2 * wave.rounding)


ROWS = [(0, 0, 0), (-1, 2, np.radians(25)), (-1, 3, np.radians(50)), (-2, 3, np.radians(40))]
"""The fourth position lies between the second and the third: in order there is none; some pass 3, 1, 2, 4."""


@pytest.mark.parametrize("order", [(1, 2, 1, 3), (1, 2, None, 3)])
def test_positions_are_found_in_the_order_of_their_ranks(order):
    """By the drives at the positions alone: those of the linkages that `move` carries through."""
    assert not synthesise_positions(PositionTask(ROWS), number=4).designs
    found = synthesise_positions(PositionTask(ROWS, order=order), number=8)
    assert len(found.designs) > 1
    for design in found.designs:
        assert design.verdict.accepted
        turns = design.verdict.turns_fully
        assert kept_by_angles(order, np.array(design.drives), turns=turns)
        assert not kept_by_angles((1, 2, 3, 4), np.array(design.drives), turns=turns)


def lengths_of(linkage):
    """The distances of the pins of the four links, in order of size."""
    pins = {}
    for (_, link), element in linkage.elements.items():
        pins.setdefault(link, []).append(complex(element.x, element.y))
    return sorted(abs(one - other) for one, other in pins.values())


def test_points_and_mixed_targets_keep_an_order():
    """Places of a four-bar, the second and third exchanged in the list: all of the solutions, and by least squares."""
    motion = move(FOUR_BARS[True].linkage({"P": (1.2, 0.8)}), np.radians([10, 40, 75, 110, 150]))
    rows = [0, 2, 1, 3, 4]
    points = [(w.real, w.imag) for w in motion.complex_point("P")[rows]]
    frame = {"fixed_pivots": [(0, 0), (3.5, 0)]}
    listed, given = (synthesise_path(PathTask(points, order=order, **frame)) for order in ((), (1, 3, 2, 4, 5)))
    assert not listed.designs
    assert given.designs
    free = synthesise_path(PathTask(points, **frame), Demands(in_order=False)).designs
    known = [lengths_of(each.linkage) for each in listed.rejected]  # whichever link drives
    alike = sum(any(lengths_of(each.linkage) == pytest.approx(own, rel=1e-6) for own in known) for each in free)
    assert f"Designs rejected only for the order of the targets: {alike}." in map(str, listed.notes)
    angles = [*motion.angle("coupler")[rows[:3]], None, None]
    mixed = {"angles": angles, "tolerances": [0] * 5}
    task = PathTask(points, order=(1, 2, 2, 3, None), **mixed)
    found = synthesise_path(task, number=2)
    assert found.designs
    for design in found.designs:
        assert kept_by_angles(task.order, np.array(design.drives), turns=design.verdict.turns_fully)
        along = np.argsort(design.drives)
        motion = move(design.linkage, np.array(design.drives)[along])
        assert np.abs(motion.complex_point("P") - task.z[along]).max() < 1e-7


@pytest.mark.parametrize("angles", [[20, 75, 140, 210, 300], [20, 75, 140, 190, 250, 310]], ids=["5", "6"])
def test_points_are_sought_in_an_order_of_their_own(angles):
    """Places of a four-bar, listed at random: by the drives alone, each in turn of another sequence of the ranks."""
    motion = move(FOUR_BARS[True].linkage({"P": (1.2, 0.8)}), np.radians(angles))
    rows = np.random.default_rng(5).permutation(len(angles))
    points = [(w.real, w.imag) for w in motion.complex_point("P")[rows]]
    order = tuple(None if rank == 2 else int(rank) for rank in rows)
    found = synthesise_path(PathTask(points, order=order), number=2, sliders=False)
    assert found.designs
    for design in found.designs:
        assert kept_by_angles(order, np.array(design.drives), turns=design.verdict.turns_fully)
        along = np.argsort(design.drives)
        motion = move(design.linkage, np.array(design.drives)[along])
        assert np.abs(motion.complex_point("P") - found.task.z[along]).max() < 1e-7


@pytest.mark.parametrize("lap", [1.0, np.inf])
def test_places_along_a_curve_against_all_sequences(lap):
    """Sorted by their places, begun anywhere if the curve is closed, in either sense."""
    rng, kept = np.random.default_rng(2), 0
    for _ in range(60):
        order, places = TargetOrder.of(random_ranks(rng, 5), 5), rng.permutation(5) / 5
        begins = range(5) if np.isfinite(lap) else [0]
        laps = [np.roll(np.argsort(places), k)[::sense] for k in begins for sense in (1, -1)]
        expected = any(order.keeps(sequence) for sequence in laps)
        assert order.kept_along(places[None], lap)[0] == expected
        kept += expected
    assert 3 < kept < 57


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"order": [1, 2]}, "order: expected one for each of the 3 targets, but found 2"),
        ({"order": [1, "x", 2]}, "order 2: expected a whole number, or nothing, but found 'x'"),
        (
            {"order": [1, 2, 3], "closed": True},
            "order: the points of a whole curve are passed in the order of the list",
        ),
        ({"order": [1, 2, 3], "crank_angles": [0, 1, 2]}, "order: the crank angles of all points give it already"),
    ],
)
def test_orders_that_say_nothing_are_refused_in_one_sentence(given, message):
    with pytest.raises(SynthesisError) as caught:
        PathTask([(0, 0), (1, 1), (2, 0)], **given)
    assert str(caught.value) == message


@pytest.mark.parametrize("sense", [1, -1])
def test_crank_angles_of_some_points_refuse_the_orders_in_which_no_lap_passes_them(sense):
    """All ranks of five points, four with crank angles, against all laps; three can always be passed in one."""
    points, angles = [(0, 0), (1, 1), (2, 0), (3, 1), (4, 5)], sense * np.array([0.1, 0.4, 2.0, 3.5])
    count = 0
    for ranks in product((1, 2, 3, 4, None), repeat=4):
        task = {"crank_angles": [*angles, None], "order": [*ranks, 1]}
        if kept_by_angles(ranks, angles, turns=True):
            assert PathTask(points, **task).order == (*ranks, 1)
            continue
        count += 1
        with pytest.raises(SynthesisError, match="order: the crank angles of some points give"):
            PathTask(points, **task)
    assert count > 10


@pytest.mark.parametrize("ending", ["toml", "json", "csv"])
@pytest.mark.parametrize("task", [PositionTask(ROWS, order=(1, 2, 2, None)), PathTask([(0, 0), (1, 2)], order=(2, 1))])
def test_files_keep_the_order(tmp_path, task, ending):
    write_task(tmp_path / f"task.{ending}", task)
    assert read_task(tmp_path / f"task.{ending}") == task
