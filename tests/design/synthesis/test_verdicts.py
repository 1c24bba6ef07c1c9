"""Verdicts against the motion itself: accepted designs carry out their task, rejected ones fail as is said of them."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.base.errors import LinkageError
from gruebler.design.realisation import realise
from gruebler.design.synthesis import (
    DeadCentreTask,
    Demands,
    FunctionTask,
    PathTask,
    PositionTask,
    judging,
    synthesise,
    synthesise_path,
)
from gruebler.design.synthesis.dyad_families import sliding_family
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, GuidingDyad
from gruebler.design.synthesis.judging import circuit_near, judge_design
from gruebler.design.synthesis.results import Design, DesignVerdict
from gruebler.design.synthesis.targets import GuidedCurve, body_targets, point_targets
from gruebler.mechanics.analysis.transmission import transmission_angle
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.geometry.roberts import cognates
from gruebler.mechanics.kinematics import circuit, move
from gruebler.pictures.designs.picture import design_figure
from gruebler.structure.mechanism import Mechanism


def dense_path(linkage):
    """Places of the point along the whole circuit, and the farthest two neighbours are apart."""
    z = circuit(linkage, step=0.01).samples.complex_point("P")
    return z, np.abs(np.diff(z)).max()


@settings(max_examples=4, deadline=None)
@given(st.integers(0, 10**6))
def test_verdicts_of_five_points_with_given_pivots(seed):
    rng = np.random.default_rng(seed)
    turn = np.sort(rng.uniform(0, 4, 5))
    z = 2 * np.cos(turn) + 1j * np.sin(turn) + 0.1 * (rng.normal(size=5) + 1j * rng.normal(size=5))
    pivots = [(float(x), float(y)) for x, y in rng.normal(size=(2, 2)) * 2]
    task = PathTask([(w.real, w.imag) for w in z], fixed_pivots=pivots)
    found = synthesise_path(task)
    for design in found.designs:
        steps = np.diff(design.drives)
        assert (steps > 0).all() or (steps < 0).all()
        between = np.concatenate(
            [np.linspace(a, b, 20) for a, b in zip(design.drives, design.drives[1:], strict=False)]
        )
        motion = move(design.linkage, between)
        assert motion.complete
        at = [*range(0, len(between), 20), len(between) - 1]
        assert np.abs(motion.complex_point("P")[at] - z).max() < 1e-9 * task.size
    for design in found.rejected:
        path, gap = dense_path(design.linkage)
        nearest = np.abs(path[:, None] - z)
        missed = nearest.min(axis=0) > gap
        reached = not any("cannot be reached" in str(reason) for reason in design.verdict.reasons)
        assert design.verdict.reasons
        if reached:  # the circuit passes all points, in another order or on two branches
            assert not missed.any()
        else:  # it misses the worst point by what is said
            assert abs(nearest.min(axis=0).max() - design.verdict.error * task.size) <= gap


def angle_gap(angles, wanted):
    return np.abs(np.exp(1j * np.asarray(angles)) - np.exp(1j * np.asarray(wanted)))


def position_gaps(task):
    """How far rows of a motion are from each position; (rows, positions), relative to the size."""

    def gaps(rows, linkage):
        turned = rows.angle("coupler")[:, None] - linkage.reference_pose["coupler"].angle
        near = np.abs(rows.complex_point("P")[:, None] - task.origins) / task.size
        return np.hypot(near, angle_gap(turned, np.angle(task.turns / task.turns[0])))

    return gaps


def timed_gaps(task):
    z, timing = np.array([complex(*p) for p in task.points]), np.array(task.crank_angles)

    def gaps(rows, linkage):
        start = linkage.reference_pose["crank"].angle  # the first point's
        crank = rows.angle("crank")[:, None] - start
        near = np.abs(rows.complex_point("P")[:, None] - z) / task.size
        return np.hypot(near, angle_gap(crank, timing - timing[0]))

    return gaps


def function_gaps(task):
    inputs, outputs = (np.array(v) - v[0] for v in (task.inputs, task.outputs))

    def gaps(rows, linkage):
        pose = linkage.reference_pose
        crank = angle_gap(rows.angle("crank")[:, None] - pose["crank"].angle, inputs)
        if task.output == "angle":
            return np.hypot(crank, angle_gap(rows.angle("rocker")[:, None] - pose["rocker"].angle, outputs))
        return np.hypot(crank, np.abs(rows.displacement(3)[:, None] - outputs) / np.ptp(outputs))

    return gaps


def assert_verdicts(result, gaps_of):
    """Accepted designs meet all targets in order without a turn of the drive; rejected ones fail as said.

    Returns how many designs were accepted, and how many were rejected because a target is out of reach.
    """
    for design in result.designs:
        steps = np.diff(design.drives)
        assert (steps > 0).all() or (steps < 0).all()
        between = np.concatenate(
            [np.linspace(*pair, 15) for pair in zip(design.drives, design.drives[1:], strict=False)]
        )
        motion = move(design.linkage, between)
        assert motion.complete
        at = np.minimum(15 * np.arange(len(design.drives)), len(between) - 1)
        assert np.diag(gaps_of(motion, design.linkage)[at]).max() < 1e-8
    out_of_reach = 0
    for design in result.rejected:
        reasons = [str(reason) for reason in design.verdict.reasons]
        assert reasons
        if any("followed" in reason for reason in reasons):
            continue
        gaps = gaps_of(circuit(design.linkage, step=0.01).samples, design.linkage)
        spread = np.abs(np.diff(gaps, axis=0)).max()
        nearest = gaps.min(axis=0)
        if any("cannot be reached" in reason for reason in reasons):
            out_of_reach += 1
            assert abs(nearest.max() - design.verdict.error) <= spread
        else:
            assert nearest.max() <= spread
            assert any("order" in reason or "branches" in reason or "differ" in reason for reason in reasons)
    return len(result.designs), out_of_reach


def of_random_four_bar(rng, count):
    """Rows of a random four-bar at drive values in order, with its coupler point; None if it does not pass them."""
    lengths = rng.uniform(1, 4, 4)
    if 2 * lengths.max() >= lengths.sum():
        return None
    linkage = FourBar(*lengths).linkage({"P": tuple(rng.uniform(-2, 3, 2))})
    drive = circuit(linkage, step=0.05).drive
    values = drive[len(drive) // 3] + np.cumsum(rng.uniform(0.15, 0.5, count))
    try:
        motion = move(linkage, values)
    except LinkageError:
        return None
    return motion if motion.complete else None


def verdicts_of_drawn_tasks(kind, wanted):
    """All verdicts of so many tasks; how many designs were accepted and how many targets were out of reach."""
    rng, tried, accepted, out_of_reach = np.random.default_rng(11), 0, 0, 0
    while tried < wanted:
        motion = of_random_four_bar(rng, 5)
        if motion is None:
            continue
        if kind == "positions":
            rows = zip(motion.point("P"), motion.angle("coupler"), strict=True)
            task = PositionTask(tuple((*p, a) for p, a in rows))
            gaps = position_gaps(task)
        elif kind == "timed points":
            task = PathTask(motion.point("P"), crank_angles=tuple(motion.angle("crank")))
            gaps = timed_gaps(task)
        else:
            free = kind == "function, free starts"
            count = 5 if free else 3
            inputs, outputs = motion.angle("crank")[:count], np.unwrap(motion.angle("rocker"))[:count]
            if free:
                inputs, outputs = inputs - 0.3, outputs + 0.4
            task = FunctionTask(tuple(inputs), outputs=tuple(outputs), start_input=not free, start_output=not free)
            gaps = function_gaps(task)
        good, missed = assert_verdicts(synthesise(task), gaps)
        tried, accepted, out_of_reach = tried + 1, accepted + good, out_of_reach + missed
    return accepted, out_of_reach


@pytest.mark.parametrize("kind", ["positions", "timed points", "function", "function, free starts"])
def test_verdicts_of_tasks_taken_from_four_bars(kind):
    tasks = {"positions": 8, "timed points": 4}.get(kind, 12)
    accepted, out_of_reach = verdicts_of_drawn_tasks(kind, tasks)
    assert accepted >= tasks / 2  # the four-bar of the task itself, where the drive is not asked for otherwise
    assert out_of_reach > 0 or kind.startswith("function")


def mixed_gaps(task):
    z = np.array([complex(*p) for p in task.points])
    given = np.array([a is not None for a in task.angles]) if task.angles else np.zeros(len(z), bool)
    wanted = np.array([0.0 if a is None else a for a in task.angles]) if task.angles else np.zeros(len(z))

    def gaps(rows, linkage):
        near = np.abs(rows.complex_point("P")[:, None] - z) / task.size
        if not given.any():
            return near
        first = int(np.argmax(given))
        # The coupler's angle is compared where the point of the first given one lies on the circuit.
        start = rows.angle("coupler")[int(np.argmin(near[:, first]))] - wanted[first]
        return np.where(given, np.hypot(near, angle_gap(rows.angle("coupler")[:, None] - start, wanted)), near)

    return gaps


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["nine points", "mixed"])
@pytest.mark.parametrize("seed", range(3))
def test_verdicts_of_nine_points_and_mixed_tasks(kind, seed):
    """Accepted designs pass in order, by `move`; rejected ones miss a point by what is said, or meet all of them."""
    rng = np.random.default_rng(seed)
    count = 9 if kind == "nine points" else 6
    turn = np.sort(rng.uniform(0, 4, count))
    z = 2 * np.cos(turn) + 1j * np.sin(turn) + 0.1 * (rng.normal(size=count) + 1j * rng.normal(size=count))
    angles = () if kind == "nine points" else tuple(0.3 * a if k in (0, 1, 3, 4) else None for k, a in enumerate(turn))
    task = PathTask([(w.real, w.imag) for w in z], angles=angles)
    result = synthesise(task)
    gaps = mixed_gaps(task)
    for design in result.designs:
        way = np.concatenate([np.linspace(*pair, 15) for pair in zip(design.drives, design.drives[1:], strict=False)])
        motion = move(design.linkage, way)
        assert motion.complete
        at = np.minimum(15 * np.arange(count), len(way) - 1)
        assert np.diag(gaps(motion, design.linkage)[at]).max() < 1e-7
    told = 0
    for design in result.rejected:
        reasons = [str(reason) for reason in design.verdict.reasons]
        assert reasons
        if any("followed" in reason for reason in reasons):
            continue
        path, spread = dense_path(design.linkage)
        nearest = np.abs(path[:, None] - z).min(axis=0) / task.size
        if any("cannot be reached" in reason for reason in reasons):
            # A target may be missed by the angle alone: the points are no farther than is said.
            assert nearest.max() <= design.verdict.error + spread / task.size
            told += kind == "mixed" or abs(nearest.max() - design.verdict.error) <= spread / task.size
        else:
            assert nearest.max() <= spread / task.size
            assert any("order" in reason or "branches" in reason or "differ" in reason for reason in reasons)
            told += 1
    assert told == sum(not any("followed" in str(r) for r in d.verdict.reasons) for d in result.rejected)


@pytest.mark.parametrize(
    ("demands", "reason"),
    [
        (Demands(transmission=np.radians(60)), "the transmission angle falls to"),
        (Demands(size_ratio=1.5), "its lengths differ too much"),
    ],
)
def test_rejected_dead_centre_designs_fail_as_said(demands, reason):
    """No crank-rocker of this family meets these demands: its best transmission angle is 47.3 degrees."""
    result = synthesise(DeadCentreTask(swing=1, time_ratio=1.1), demands=demands, number=8)
    assert result.rejected
    for design in result.rejected:
        reasons = " ".join(map(str, design.verdict.reasons))
        mu = transmission_angle(move(design.linkage, np.linspace(0, 2 * np.pi, 721), order=2)).min()
        assert mu == pytest.approx(design.verdict.transmission, abs=1e-4)
        assert reason in reasons
        assert (mu < demands.transmission) == ("transmission" in reasons)
    assert not result.designs


@pytest.mark.parametrize("demands", [Demands(transmission=np.radians(38)), Demands(size_ratio=3)])
def test_dead_centre_designs_meet_demands_that_part_of_the_family_meets(demands):
    result = synthesise(DeadCentreTask(swing=1, time_ratio=1.1), demands=demands, number=8)
    assert len(result.designs) == 8
    for design in result.designs:
        mu = transmission_angle(move(design.linkage, np.linspace(0, 2 * np.pi, 721), order=2)).min()
        assert mu >= demands.transmission - 1e-4
        assert design.verdict.size_ratio <= demands.size_ratio


@pytest.mark.slow
def test_rejected_curve_designs_fail_as_said():
    """A triangle is met by no four-bar: each says by how much its circuit misses the worst place."""
    corners = [0, 3, 1.5 + 2.6j, 0]
    z = np.concatenate([a + (b - a) * np.linspace(0, 1, 8, endpoint=False) for a, b in pairwise(corners)])
    task = PathTask([(w.real, w.imag) for w in z], closed=True)
    result = synthesise(task, demands=Demands(tolerance=2e-3), number=3)
    extent = max(np.ptp(z.real), np.ptp(z.imag))
    assert result.rejected
    assert not result.designs
    for design in result.rejected:
        path, spread = dense_path(design.linkage)
        nearest = np.abs(path[:, None] - z).min(axis=0).max()
        assert nearest > 2e-3 * extent
        assert any("cannot be reached" in str(reason) for reason in design.verdict.reasons)
        assert abs(nearest - design.verdict.error * extent) <= spread


def test_targets_are_marked_where_links_have_numbers():
    """A target's number would be a link's name: it is P1 then."""
    four_bar = FourBar(25, 70, 40, 70).linkage({"P": (45, 40)})
    numbered = realise(Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)")).linkage
    for own, mark in ((four_bar, ">2<"), (numbered, ">P2<")):
        design = Design(linkage=own, verdict=DesignVerdict(assembles=True), form="four-bar")
        assert mark in design_figure(PathTask([(0, 0), (9, 4), (14, 3), (20, 1), (30, 5)]), design).svg()


def test_a_task_far_from_the_origin_is_judged_all_the_same():
    """At 3e4 sizes from the origin rounding ends some circuits: their linkages are rejected, without an error."""
    rows = [(0, 0, 0), (200, 90, np.radians(20)), (320, 100, np.radians(46))]
    near, middle, far = (
        synthesise(PositionTask([(x + off, y + off, a) for x, y, a in rows]), number=9) for off in (0, 1e6, 1e7)
    )
    assert len(far.designs) + len(far.rejected) == len(near.designs) + len(near.rejected)
    assert len(far.designs) >= 1
    assert len(middle.designs) == len(near.designs)
    assert len(near.designs) >= 9
    ratios = [sorted(design.verdict.size_ratio for design in result.designs) for result in (middle, near)]
    assert ratios[0] == pytest.approx(ratios[1], rel=1e-6)


def test_a_curve_that_leaves_its_targets_between_two_of_them_is_rejected():
    """Targets on one loop of a figure eight: from the last to the first the point draws the other loop.

    The crossing by a search over all pairs of places of the curve, the distance of the other loop by hand.
    """
    four_bar = FourBar(1, 1.34, 3.5, 3.76).linkage({"P": (1.64, 1.38)})
    motion = move(four_bar, np.radians(np.arange(0, 361, 3)))
    z = motion.complex_point("P")
    line = z[85] + (z[1] - z[85]) * np.linspace(0, 1, 50)
    other_loop = np.abs(np.append(z[85:], z[:1])[:, None] - line).min(axis=1).max()
    task = PathTask([(w.real, w.imag) for w in z[1:86]])
    verdicts = {}
    for closed in (False, True):
        curve = GuidedCurve.of(replace(task, closed=closed))
        targets = replace(point_targets("P", task.z, 3.0), curve=curve)
        start = four_bar.with_reference_pose(motion.pose(1))
        verdicts[closed] = judge_design(start, targets, Demands(tolerance=0.05), "four-bar").verdict
    assert verdicts[False].accepted
    assert not verdicts[True].accepted
    assert verdicts[True].error < 1e-9
    assert "between targets 85 and 1 the point leaves the curve" in str(verdicts[True].reasons[0])
    assert verdicts[True].between * 3 == pytest.approx(other_loop, rel=1e-3)
    assert verdicts[False].between < 1e-3


@pytest.mark.parametrize(("order", "expected"), [([0, 1, 2, 3, 4, 5], True), ([0, 3, 1, 4, 2, 5], False)])
def test_the_order_on_a_circuit_is_that_of_all_cognates_and_drives(order, expected):
    """So one verdict tells it for six linkages; each is asked alone here, with Roberts' theorem for the cognates."""
    rocker, arcs = FourBar(30, 30, 50, 60), np.array([0.0, 0.13, 0.31, 0.52, 0.7, 0.88])[order]
    found = []
    for cognate in cognates(rocker, 20, 15, phi=0.2):
        a0, a, b, b0 = cognate.pins
        point = a + (cognate.u + 1j * cognate.v) * (b - a) / abs(b - a)
        for sides in (((a, a0), (b, b0)), ((b, b0), (a, a0))):
            linkage = linkage_of_dyads(*(GuidingDyad(CRANK, *pins) for pins in sides), point, "mm")
            if not found:
                course = circuit(linkage)
                z = course.at(course.length * arcs).complex_point("P")
            verdict = judge_design(linkage, point_targets("P", z, 30.0), Demands(in_order=False), "RR-RR").verdict
            found.append((verdict.one_circuit, verdict.in_order))
    assert found == [(True, expected)] * 6
    verdict = judge_design(linkage, point_targets("P", z, 30.0), Demands(), "RR-RR").verdict
    assert verdict.in_order == expected
    assert expected or str(verdict.reasons[0]) == "the targets are met in another order"


@pytest.mark.parametrize("sides", [(1, 2.31, 2.87, 3.13), (1, 3.2, 2.2, 3.9), (1, 3.62, 3.31, 2.17)])
@pytest.mark.parametrize("ends", [(-23, 31), (-3.1, 40.7), (-51, 1.9)])
def test_the_least_transmission_angle_lies_between_targets_too(sides, ends):
    """It is where crank and frame are in line, by the law of cosines; poses of the circuit lay 0.007 degrees beside."""
    a, b, c, d = sides
    bar = FourBar(*sides).linkage({"P": (1.2, 0.8)})
    motion = move(bar, np.radians([ends[0], 0.4 * ends[1], ends[1]]))
    targets = point_targets("P", motion.complex_point("P"), 1.0)
    verdict = judge_design(bar.with_reference_pose(motion.pose(0)), targets, Demands(), "four-bar").verdict
    least = np.degrees(np.arccos(abs(b**2 + c**2 - (d - a) ** 2) / (2 * b * c)))
    assert np.degrees(verdict.transmission) == pytest.approx(least, abs=1e-5)


def test_a_slide_that_leaves_its_targets_for_good_is_followed_near_them(monkeypatch):
    """A guide that turns about the frame, along a line of the body, lets it slide away; a narrow wedge comes back."""
    task = PositionTask([(0, 0.1, 0), (40, 20.1, np.radians(20)), (60, 50.1, np.radians(40))])
    sliders, blocks = (sliding_family(task, kind, [1, 1j, np.exp(0.4j)]) for kind in (SLIDER, BLOCK))
    linkages = [linkage_of_dyads(one, other, 0.1j, "mm") for one in sliders for other in blocks]
    longest = [circuit(each, step=0.05).length for each in linkages]
    assert max(longest) > 1900  # both ways to the end of what is followed
    near = [circuit_near(each, body_targets(task, each)) for each in linkages]
    assert max(each.length for each in near) < max(longest) / 2
    ways = [np.hypot(*np.ptp(each.samples.complex_point("P").view(float).reshape(-1, 2), axis=0)) for each in near]
    assert max(ways) > 20 * task.size

    def verdicts():
        demands = Demands(crank=True)
        return [judge_design(each, body_targets(task, each), demands, "").verdict for each in linkages]

    shorter = verdicts()
    monkeypatch.setattr(judging, "circuit_near", lambda linkage, _: circuit(linkage, step=0.05))
    for part, whole in zip(shorter, verdicts(), strict=True):
        assert (part.accepted, [*map(str, part.reasons)]) == (whole.accepted, [*map(str, whole.reasons)])
    wedge = [sliding_family(task, SLIDER, [np.exp(1j * angle)])[0] for angle in (0.5, 0.65)]
    linkage = linkage_of_dyads(*wedge, 0.1j, "mm")
    assert circuit_near(linkage, body_targets(task, linkage)).closed
