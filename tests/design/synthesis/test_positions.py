"""Guiding a body: dyads, curves, linkages, verdicts."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PositionTask, synthesise_positions
from gruebler.design.synthesis.burmester import burmester_curves
from gruebler.design.synthesis.dyad_families import guiding_dyads
from gruebler.design.synthesis.dyads import CRANK, SLIDER, Displacements, all_dyads, misfit
from gruebler.design.synthesis.six_bar_positions import synthesise_guiding_six_bars
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.kinematics.solve import move_quietly


def task_of(rows):
    return PositionTask([(x, y, np.radians(a)) for x, y, a in rows])


def positions_of(linkage, drives):
    """The positions of the coupler with the point P, and the pivots in the first of them."""
    motion = move(linkage, drives)
    if not motion.complete:
        return None
    return PositionTask([(*p, a) for p, a in zip(motion.point("P"), motion.angle("coupler"), strict=True)]), motion


FOUR_REAL = task_of([(0, 0, 0), (-2, 3.8, 81), (-0.1, 3.4, -16), (1.5, 0.8, -32), (-1.8, 2.2, 55)])
KNOWN = FourBar(1, 3, 2.5, 3.5).linkage({"P": (1.2, 0.8)})


def test_the_worked_example_with_four_real_dyads():
    """Values of an independent computation with two cubics (plain numpy), to the digits printed there."""
    dyads = guiding_dyads(FOUR_REAL)
    wanted = {
        1.820418987: (-0.90796419 + 0.31456977j, -0.82707024 + 2.13319052j),
        164.276983456: (143.88978088 + 65.44000633j, -5.24289868 - 3.45390618j),
        49.102142399: (2.92442635 - 1.78460313j, -44.87561726 - 13.01742199j),
        2.215083196: (-3.04262351 - 0.90375208j, -3.72938834 + 1.20217946j),
    }
    assert len(dyads) == 4
    for dyad in dyads:
        length = min(wanted, key=lambda r: abs(r - dyad.length))
        assert dyad.length == pytest.approx(length, abs=5e-9 * max(1, length))
        assert [dyad.moving, dyad.fixed] == pytest.approx(list(wanted[length]), abs=1e-7)
    found = synthesise_positions(FOUR_REAL)
    assert (found.count.theorem, found.count.found, found.count.real) == (4, 4, 4)
    assert len(found.designs) + len(found.rejected) == 6
    assert all(design.verdict.reasons for design in found.rejected)


def test_a_body_that_is_only_shifted_is_carried_by_parallelograms():
    """Each of its points is on a circle of the same radius a b c / (4 area), that about the three positions."""
    task = task_of([(-40, 0, 30), (0, 25, 30), (35, 10, 30)])
    one, two, three = (complex(x, y) for x, y, _ in task.positions)
    area = abs(((two - one).conjugate() * (three - one)).imag) / 2
    radius = abs(one - two) * abs(two - three) * abs(three - one) / (4 * area)
    found = synthesise_positions(task)
    assert {design.form for design in found.designs} == {"RR-RR"}
    for design in found.designs:
        length = design.linkage.length
        crank = length("crank", "R(frame-crank)", "R(crank-coupler)")
        coupler = length("coupler", "R(crank-coupler)", "R(rocker-coupler)")
        rocker = length("rocker", "R(rocker-coupler)", "R(frame-rocker)")
        frame = length("frame", "R(frame-crank)", "R(frame-rocker)")
        assert [crank, rocker, coupler] == pytest.approx([radius, radius, frame], rel=1e-9)


def test_five_positions_of_a_four_bar_give_exactly_that_one():
    task, motion = positions_of(KNOWN, np.radians([10.0, 35.0, 60.0, 85.0, 110.0]))
    found = synthesise_positions(task)
    assert (found.count.found, found.count.real, len(found.designs), len(found.rejected)) == (4, 2, 1, 0)
    design = found.designs[0]
    assert np.degrees(design.drives) == pytest.approx([10, 35, 60, 85, 110], abs=1e-9)
    assert design.linkage.length("coupler", 1, 2) == pytest.approx(3, rel=1e-10)
    assert design.verdict.error < 1e-13
    assert design.verdict.turns_fully
    assert motion.complete


lengths = st.floats(0.6, 3.0)
coordinates = st.floats(-2.0, 2.0)


@st.composite
def guided(draw, count=5):
    """A linkage with a point P, and drive values that it reaches."""
    kind = draw(st.sampled_from([FourBar, SliderCrank, InvertedSliderCrank]))
    if kind is FourBar:
        linkage = FourBar(*draw(st.tuples(*[lengths] * 4))).linkage({"P": (draw(coordinates), draw(coordinates))})
    else:
        linkage = kind(draw(lengths), draw(st.floats(3.2, 6.0)), draw(st.floats(-0.5, 0.5))).linkage(
            {"P": (draw(coordinates), draw(coordinates))}
        )
    start, step = draw(st.floats(0, 6)), draw(st.floats(0.2, 0.5))
    return linkage, start + step * np.arange(count) * draw(st.floats(0.7, 1.0))


@settings(max_examples=40, deadline=None)
@given(guided())
def test_positions_of_a_linkage_give_its_dyads_back(case):
    linkage, drives = case
    made = positions_of(linkage, drives)
    assume(made is not None)
    task, motion = made
    given_, origin, size = Displacements.of(task.origins, task.turns)
    assume(size > 0.2)
    try:
        dyads = guiding_dyads(task)
    except SynthesisError:
        assume(False)  # a linkage that guides its body along circles, such as a parallelogram
    pivots = [motion.complex_point(name)[0] for name in ("R(frame-crank)", "R(crank-coupler)")]
    gaps = [abs(d.fixed - pivots[0]) + abs(d.moving - pivots[1]) for d in dyads if d.kind is CRANK]
    assert min(gaps, default=np.inf) < 1e-5
    if "slider" in linkage.mechanism.chain.links:
        assert any(d.kind is SLIDER for d in dyads)
    for dyad in dyads:
        reduced = dyad.moved(1 / size, -origin / size)
        assert misfit(given_, reduced) < 1e-9 * (1 + abs(reduced.moving) + abs(reduced.fixed))


@settings(max_examples=8, deadline=None)
@given(guided())
def test_the_linkage_itself_is_among_the_accepted_designs(case):
    linkage, drives = case
    made = positions_of(linkage, drives)
    assume(made is not None and made[0].size > 0.3)
    mu = np.abs(np.diff(made[1].angle("coupler")))
    assume(mu.max() > 0.05)
    try:
        found = synthesise_positions(made[0], Demands(one_branch=False))
    except SynthesisError:
        assume(False)
    pivots = [made[1].complex_point(name)[0] for name in ("R(frame-crank)", "R(crank-coupler)")]

    def has(design, pivot):
        return (
            min(abs(complex(e.x, e.y) - pivot) for (_, k), e in design.linkage.elements.items() if k == "frame") < 1e-4
        )

    mine = [d for d in (*found.designs, *found.rejected) if has(d, pivots[0])]
    assert mine
    for design in found.designs:
        assert design.verdict.error < 1e-9 or not design.verdict.one_branch


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**6))
def test_four_solutions_of_any_five_positions(seed):
    """Second method: Newton's method in complex numbers from random starts finds the same four and no other."""
    rng = np.random.default_rng(seed)
    q = np.exp(1j * rng.uniform(-np.pi, np.pi, 4))
    t = rng.normal(size=4) + 1j * rng.normal(size=4)
    found = all_dyads(Displacements(q, t))
    assert found.found == 4
    assert len(found.real) in (0, 2, 4)
    solutions = []
    for _ in range(60):
        v = rng.normal(size=4) * 2 + 1j * rng.normal(size=4)
        for _ in range(60):
            x, xc, m, mc = v
            f = x * mc * (1 - q) + xc * m * (1 - q.conj()) - m * t.conj() - mc * t + q * x * t.conj()
            f = f + q.conj() * xc * t + t * t.conj()
            jac = np.stack(
                [
                    mc * (1 - q) + q * t.conj(),
                    m * (1 - q.conj()) + q.conj() * t,
                    xc * (1 - q.conj()) - t.conj(),
                    x * (1 - q) - t,
                ],
                axis=1,
            )
            step = np.linalg.solve(jac, f)
            v = v - step
            if np.abs(step).max() < 1e-13 * (1 + np.abs(v).max()):
                break
        new = all(np.abs(v - o).max() > 1e-6 * (1 + np.abs(o).max()) for o in solutions)
        if new and np.abs(step).max() < 1e-10 and np.abs(v).max() < 1e4:
            solutions.append(v)
    assert len(solutions) <= 4
    real = [v for v in solutions if abs(v[0] - v[1].conj()) + abs(v[2] - v[3].conj()) < 1e-8 * (1 + np.abs(v).max())]
    for v in real:
        gaps = [abs(d.moving - v[0]) + abs(d.fixed - v[2]) for d in found.real]
        assert min(gaps, default=np.inf) < 1e-6 * (1 + np.abs(v).max())


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10**6), st.floats(-3, 3), st.floats(0.01, 100), st.booleans())
def test_moved_tasks_have_moved_dyads(seed, angle, scale, mirror):
    rng = np.random.default_rng(seed)
    rows = np.column_stack([rng.uniform(-2, 2, (5, 2)), rng.uniform(-2, 2, 5)])
    turn, shift = scale * np.exp(1j * angle), scale * (3 - 2j)
    z = rows[:, 0] + 1j * rows[:, 1]
    a = rows[:, 2]
    other, b = (z.conj(), -a) if mirror else (z, a)
    other, b = turn * other + shift, b + angle
    plain = guiding_dyads(PositionTask([tuple(r) for r in rows]))
    moved = guiding_dyads(PositionTask([(w.real, w.imag, c) for w, c in zip(other, b, strict=True)]))
    assert len(plain) == len(moved)
    for dyad in plain:
        image = [turn * (p.conjugate() if mirror else p) + shift for p in (dyad.moving, dyad.fixed)]
        gap = min(abs(d.moving - image[0]) + abs(d.fixed - image[1]) for d in moved)
        assert gap < 1e-5 * (scale + abs(image[0]) + abs(image[1]))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_burmesters_curves_pass_through_the_dyads_of_five_positions(seed):
    """The dyads of five positions lie on the curves of the first four; the curves hold nothing but dyads."""
    rng = np.random.default_rng(seed)
    rows = [tuple(r) for r in np.column_stack([rng.uniform(-2, 2, (5, 2)), rng.uniform(-2, 2, 5)])]
    task = PositionTask(rows[:4])
    curves = burmester_curves(task, points=2000)
    moving = np.concatenate([piece.moving for piece in curves.pieces])
    fixed = np.concatenate([piece.fixed for piece in curves.pieces])
    given_, origin, size = Displacements.of(task.origins, task.turns)
    images = given_.q * ((moving - origin) / size)[:, None] + given_.t
    centres = ((fixed - origin) / size)[:, None]
    wrong = np.abs(np.abs(images - centres) - np.abs((moving - origin) / size - centres[:, 0])[:, None]).max(axis=1)
    assert np.median(wrong) < 1e-9
    for dyad in guiding_dyads(PositionTask(rows)):
        if max(abs(dyad.moving), abs(dyad.fixed)) < 20:
            assert abs(curves.nearest(dyad.moving).moving - dyad.moving) < 1e-6 * (1 + abs(dyad.moving))
            assert abs(curves.nearest(dyad.fixed, fixed=True).fixed - dyad.fixed) < 1e-6 * (1 + abs(dyad.fixed))
    assert len(curves.sliding) == 2
    for dyad in curves.sliding:
        assert misfit(given_, dyad.moved(1 / size, -origin / size)) < 1e-8 * (1 + abs(dyad.moving) / size)


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 10**6), st.floats(0, 1), st.floats(0, 1))
def test_any_pair_of_burmesters_curves_can_be_picked(seed, one, two):
    """By its places along the curve, and then by its pivots: the same exact dyads."""
    rng = np.random.default_rng(seed)
    rows = [tuple(r) for r in np.column_stack([rng.uniform(-2, 2, (4, 2)), rng.uniform(-2, 2, 4)])]
    curves = burmester_curves(PositionTask(rows))
    picked = guiding_dyads(PositionTask(rows, curve_parameters=[one, two]))
    given_, origin, size = Displacements.of(curves.task.origins, curves.task.turns)
    spans = curves.parameters()
    assert (spans[0][0], spans[-1][-1]) == (0, pytest.approx(1))
    for at, dyad in zip((one, two), picked, strict=True):
        unit = dyad.moved(1 / size, -origin / size)
        reach = 1 + abs(unit.moving) + abs(unit.fixed)
        assert misfit(given_, unit) < 1e-9 * reach
        piece = next(k for k, span in enumerate(spans) if at <= span[-1] + 1e-12)
        near = np.abs(curves.pieces[piece].moving - dyad.moving).min()
        assert near < 0.1 * size * (1 + abs(unit.moving)) ** 2
        if reach < 30:
            chosen = [(dyad.moving.real, dyad.moving.imag)], [(dyad.fixed.real, dyad.fixed.imag)]
            again = guiding_dyads(PositionTask(rows, moving_pivots=chosen[0], fixed_pivots=chosen[1]))
            assert abs(again[0].moving - dyad.moving) < 1e-7 * size * reach
            assert abs(again[1].fixed - dyad.fixed) < 1e-7 * size * reach


def test_a_place_beside_the_curve_takes_the_nearest_point_of_it():
    rows = [(0, 0, 0), (2.1, 0.9, 0.35), (3.2, 1.0, 0.8), (4.0, 0.2, 1.5)]
    curves = burmester_curves(PositionTask(rows), points=4000)
    for place in (1 + 1j, -2j, 3 - 1j):
        for fixed in (False, True):
            nearest = curves.nearest(place, fixed=fixed)
            all_ = np.concatenate([piece[fixed] for piece in curves.pieces])
            own = nearest.fixed if fixed else nearest.moving
            assert abs(own - place) == pytest.approx(np.abs(all_ - place).min(), abs=1e-4)


def test_chosen_pivots_of_three_positions():
    rows = [(0, 0, 0), (2, 1, 20), (3, 3, 60)]
    task = PositionTask([(x, y, np.radians(a)) for x, y, a in rows], moving_pivots=[(1, 0)], fixed_pivots=[(4, -1)])
    by_body, by_frame = guiding_dyads(task)
    assert by_body.moving == pytest.approx(1)
    assert by_frame.fixed == pytest.approx(4 - 1j)
    displacements, origin, size = Displacements.of(task.origins, task.turns)
    for dyad in (by_body, by_frame):
        assert misfit(displacements, dyad.moved(1 / size, -origin / size)) < 1e-12
    found = synthesise_positions(task)
    assert found.count.theorem is None
    assert "Every point of the body is the pivot of one dyad" in str(found.notes[0])


def test_three_positions_are_met_by_many_linkages_moved_by_the_solver():
    task = task_of([(0, 0, 0), (1, 0.5, 20), (2, 0.4, 45)])
    found = synthesise_positions(task)
    assert len(found.designs) > 10
    for design in found.designs:
        motion = move_quietly(design.linkage, design.drives)  # targets may lie more than half a turn apart
        assert np.abs(motion.complex_point("P") - task.origins).max() < 1e-9
        turned = motion.angle("coupler") - motion.angle("coupler")[0]
        assert np.abs(np.exp(1j * turned) - task.turns / task.turns[0]).max() < 1e-9


@pytest.mark.slow
def test_more_than_five_positions_come_back_too():
    task, _ = positions_of(KNOWN, np.radians(np.linspace(10, 150, 9)))
    found = synthesise_positions(task)
    assert found.designs[0].verdict.error < 1e-9
    assert "least squares" in str(found.notes[0])


@pytest.mark.slow
def test_far_pivots_do_not_crowd_out_the_other_dyads():
    """Positions near a line, drawn by hand: a dyad that slides is good, and ever larger circles approach it."""
    rows = [(0, 0, 0), (1, 0.2, 10), (2, 0.3, 22), (3, 0.3, 31), (4, 0.1, 45), (5, -0.3, 52), (6, -0.8, 60)]
    task = task_of(rows)
    assert {dyad.kind.form for dyad in guiding_dyads(task)} == {"RR", "PR", "RP"}
    found = synthesise_positions(task)
    assert found.designs[0].verdict.error < 0.03


@pytest.mark.parametrize(
    "rows",
    [
        [(k, 2 * k, 0) for k in range(5)],  # a translation along a line
        [(np.cos(k / 3), np.sin(k / 3), np.degrees(k / 3)) for k in range(5)],  # a rotation
    ],
)
def test_motions_of_infinitely_many_dyads_say_so(rows):
    with pytest.raises(SynthesisError, match="infinitely many"):
        guiding_dyads(task_of(rows))


def lengths_of(linkage):
    """The distances of pins on each link."""
    by_link = [[complex(e.x, e.y) for (_, o), e in linkage.elements.items() if o == k and e.is_pin] for k in LINKS]
    return np.array([abs(p - q) for pins in by_link for k, p in enumerate(pins) for q in pins[:k]])


LINKS = ("frame", "crank", "coupler", "rocker", "link", "body")


def on_a_grid(*rows):
    """Rows of numbers rounded so that they have no more digits far away and magnified."""
    return [tuple(np.round(np.multiply(row[:2], 2.0**30)) / 2**30) + tuple(row[2:]) for row in rows]


@pytest.mark.parametrize("size", [1.0, 2.0**20])
@pytest.mark.parametrize("solve", [synthesise_positions, synthesise_guiding_six_bars])
def test_a_task_far_away_and_large_has_the_same_designs(solve, size):
    """A million times its size from the origin, its coordinates have ten digits left."""
    if solve is synthesise_positions:
        task, _ = positions_of(KNOWN, np.radians([10.0, 35.0, 60.0, 85.0, 110.0]))
        task = PositionTask(on_a_grid(*task.positions))
    else:
        places = [(0.5, 0.25, 0), (-0.18, 1.22, 0.6), (-0.87, 1.43, 0.78), (-1.48, 1.26, 0.93), (-1.86, 0.85, 1.13)]
        pivots = on_a_grid((-1.5, 0), (0, 0), (-0.46, -0.77))
        task = PositionTask(on_a_grid(*places), fixed_pivots=pivots[:2], moving_pivots=pivots[2:])
    shift = complex(2**20, -(2**19))

    def moved(rows):
        return [(size * (x + shift.real), size * (y + shift.imag), *angle) for x, y, *angle in rows]

    pivots = {name: moved(getattr(task, name)) for name in ("fixed_pivots", "moving_pivots")}
    far = PositionTask(moved(task.positions), **pivots)
    near, found = solve(task), solve(far)
    assert found.task == far
    assert len(found.designs) == len(near.designs) > 0
    assert len(found.rejected) == len(near.rejected)
    for design, other in zip(found.designs + found.rejected, near.designs + near.rejected, strict=True):
        assert design.form == other.form
        wanted = size * lengths_of(other.linkage)
        limit = 1e-9 * wanted.max()
        assert lengths_of(design.linkage) == pytest.approx(wanted, abs=limit)
        pose = other.linkage.required_pose
        for link in pose.keys() - {"frame"}:
            place = moved([pose[link][:2]])[0]
            assert design.linkage.required_pose[link][:2] == pytest.approx(place, abs=limit)
        assert design.relative_sensitivity == pytest.approx(other.relative_sensitivity, rel=1e-7, nan_ok=True)


def test_a_region_without_solutions():
    task, _ = positions_of(KNOWN, np.radians([10.0, 35.0, 60.0, 85.0, 110.0]))
    found = synthesise_positions(task, Demands(region=(10, 10, 20, 20)))
    assert not found.designs
    assert list(map(str, found.rejected[0].verdict.reasons)) == ["a fixed pivot lies outside the region"]


@pytest.mark.parametrize(
    ("count", "region"), [(2, (0, 0, 1, 1)), (3, (-3, 0, 3, 4)), pytest.param(4, (1, 2, 3, 6), marks=pytest.mark.slow)]
)
def test_dyads_of_an_infinite_family_are_taken_from_the_region(count, region):
    """Their pivots lie in it, and the body keeps its distance from them in all positions."""
    task = task_of([(0, 0, 0), (1, 0.5, 20), (2, 0.4, 45), (3, 0, 60)][:count])
    found = synthesise_positions(task, Demands(region=region))
    turning = [d for d in guiding_dyads(task, 16, region) if d.kind is CRANK]
    assert len(turning) >= 12
    for dyad in turning:
        assert region[0] <= dyad.fixed.real <= region[2]
        assert region[1] <= dyad.fixed.imag <= region[3]
        images = task.origins + task.turns / task.turns[0] * (dyad.moving - task.origins[0])
        assert np.abs(images - dyad.fixed) == pytest.approx(dyad.length)
    outside = [d for d in found.rejected if "a fixed pivot lies outside the region" in map(str, d.verdict.reasons)]
    assert not [design for design in outside if design.form == "RR-RR"]  # slides are no family: each is judged
    assert found.designs


@pytest.mark.parametrize("number", [16, 24, 40])
def test_dyads_of_four_positions_are_different(number):
    """A closed piece of Burmester's curve holds its first point twice."""
    rng = np.random.default_rng(5)
    for _ in range(6):
        rows = np.column_stack([rng.normal(size=(4, 2)), np.linspace(0, 1.2, 4) + 0.1 * rng.normal(size=4)])
        dyads = guiding_dyads(PositionTask(rows.tolist()), number)
        gaps = [
            abs(one.moving - two.moving) for k, one in enumerate(dyads) for two in dyads[:k] if one.kind == two.kind
        ]
        assert min(gaps) > 1e-6


@pytest.mark.parametrize(
    ("demands", "words"),
    [
        ({"region": (float("nan"), 0, 1, 1)}, "region: expected least x, least y"),
        ({"region": (5, 5, -5, -5)}, "region: expected least x, least y"),
        ({"region": (0, 1, 5)}, "region: expected least x, least y"),
        ({"transmission": float("nan")}, "transmission: expected a number"),
        ({"transmission": None}, "transmission: expected a number"),
        ({"transmission": np.radians(100)}, "transmission: expected an angle between 0 and 90 degrees, but found 100 "),
        ({"transmission": -0.1}, "transmission: expected an angle"),
        ({"size_ratio": 0.5}, "size_ratio: expected at least 1, but found 0.5"),
        ({"tolerance": -1}, "tolerance: expected a part of the size, at least 0, but found -1"),
        ({"tolerance": float("inf")}, "tolerance: expected a part of the size"),
        ({"crank": "no"}, "crank: expected True or False, but found 'no'"),
    ],
)
def test_demands_that_nothing_could_be_held_to_are_refused(demands, words):
    with pytest.raises(SynthesisError, match=words):
        Demands(**demands)


def test_demands_at_their_bounds():
    """A right angle, links of one length, no miss at all, a region that is one point."""
    made = Demands(transmission=np.pi / 2, size_ratio=1, tolerance=0, region=(2, 3, 2, 3))
    assert (made.size_ratio, made.region) == (1, (2, 3, 2, 3))


def test_designs_beyond_the_usual_size_ratio_are_rejected_and_counted():
    """The list stays whole; with a wider limit those that fail by nothing else are accepted. The pivots lie close."""
    pivots = [(2.35, -0.57), (2.38, -0.48), (0.69, -0.28), (0.65, -0.32)]
    task = PositionTask([(0, 0, 0), (2, 1, 0.4), (3, 1, 0.9)], moving_pivots=pivots)
    usual, wide = (synthesise_positions(task, demands) for demands in (None, Demands(size_ratio=1e4)))
    beyond = [design for design in wide.designs if design.verdict.size_ratio > 20]
    assert len(beyond) > 0
    assert len(usual.designs) + len(usual.rejected) == len(wide.designs) + len(wide.rejected)
    assert len(usual.designs) == len(wide.designs) - len(beyond)
    said = [str(remark) for remark in usual.remarks if "differ too much" in str(remark)]
    assert said == [f"Designs rejected only because their lengths differ too much: {len(beyond)}."]
    assert wide.remarks == wide.notes
