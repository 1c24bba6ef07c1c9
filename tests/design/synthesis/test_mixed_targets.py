"""Targets of several kinds at once: met exactly, within a band, nearly; by `move`, and by another optimiser."""

from dataclasses import replace
from math import cos, radians, sin

import numpy as np
import pytest
from scipy.optimize import minimize

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PathTask, synthesise, synthesise_path
from gruebler.design.synthesis import mixed_targets as mixed
from gruebler.design.synthesis.curve_starts import transformed
from gruebler.design.synthesis.curves import limits_of
from gruebler.design.synthesis.four_bar_kinds import FOUR_BAR, SLIDER_CRANK
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.proposals import propose
from gruebler.design.synthesis.specification import Specification
from gruebler.design.synthesis.targets import point_targets
from gruebler.files.tasks import read_task, task_from_json, task_to_json, write_task
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

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


def test_one_crank_angle_alone_says_nothing():
    task = PathTask(points(Z[:3]), crank_angles=[None, 0.3, None], tolerances=[0, 0, 0])
    assert len(synthesise_path(task, number=2).designs) == 2


def test_two_positions_with_crank_angles_have_many_four_bars():
    task = PathTask(points(Z[:2]), angles=COUPLER[:2], crank_angles=PHI[:2])
    found = synthesise_path(task, number=4)
    assert len(found.designs) == 4
    assert max(misses(design, task).max() for design in found.designs) < 1e-8
    alone = synthesise_path(task, number=2, sliders=False)
    assert {design.form for design in alone.designs} == {"four-bar"}
    assert "slider-crank" not in alone.explain()


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


@pytest.mark.parametrize("kind", [FOUR_BAR, SLIDER_CRANK], ids=lambda kind: kind.name)
def test_the_derivatives_against_differences(kind):
    task = MIXED["bands about noisy points"]
    angles = np.stack([COUPLER, PHI, ROCKER])
    wanted = replace(mixed._wanted(task, task.size, complex(task.z.mean())), angles=angles)
    limits = next(limits_of(None, (), (kind,), False, (complex(task.z.mean()), task.size)))
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
            ends.append(mixed._rest(wanted, state._replace(rows=rows, phi=phi)).errors)
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


def cut(p, q, first, second, side):
    """Where circles about p and q meet, to the left of the way from p to q or to its right."""
    gap = q - p
    along = (first**2 - second**2 + np.abs(gap) ** 2) / (2 * np.abs(gap))
    return p + gap / np.abs(gap) * (along + side * 1j * np.sqrt(first**2 - along**2))


def moved_by_hand(seed):
    """A random four-bar, or a slider-crank, by cutting circles; where it is after steps of its crank, some very small.

    Returns its kind, numbers, branch and crank angles, then its point, the directions of coupler, crank and output, and
    that across the path of the point.
    """
    rng = np.random.default_rng(seed)
    while True:
        side, (a, b, c), (u, v, h) = rng.choice([-1, 1]), np.exp(rng.uniform(-0.9, 0.9, 3)), rng.normal(size=3)
        a0, b0, slide = rng.normal() + 1j * rng.normal(), 2 * rng.normal() + 2j * rng.normal(), rng.uniform(0, 6)
        steps = rng.choice([0.003, 0.05, 1], 5) * rng.uniform(0.3, 1.2, 5)
        phi = rng.uniform(0, 7) + rng.choice([-1, 1]) * np.cumsum(np.append(0, steps))
        dense = np.concatenate([phi, phi + 1e-5, np.linspace(phi[0] - 0.01, phi[-1] + 0.01, 2000)])
        crank = np.exp(1j * dense)
        pin = a0 + 0.6 * a * crank
        with np.errstate(invalid="ignore"):
            if seed % 3:
                kind, far = FOUR_BAR, cut(pin, b0, b, c, side)
                output, row = (far - b0) / c, [a0.real, a0.imag, b0.real, b0.imag, 0.6 * a, b, c, u, v]
            else:
                rise = h - np.imag(pin * np.exp(-1j * slide))
                far = pin + np.exp(1j * slide) * (side * np.sqrt(b**2 - rise**2) + 1j * rise)
                kind, output, row = SLIDER_CRANK, np.ones_like(far), [a0.real, a0.imag, slide, h, 0.6 * a, b, u, v]
        if not np.isnan(far).any():
            turned = (far - pin) / b
            z = pin + (u + 1j * v) * turned
            across = 1j * (z[6:12] - z[:6]) / np.abs(z[6:12] - z[:6])
            return kind, np.array(row), side, phi, [each[:6] for each in (z, turned, crank, output, across)]


def mix_of(seed):
    """Targets that such a linkage meets, each exactly or within a band: places and angles; how a point may miss it."""
    kind, row, side, phi, (z, *turned, across) = moved_by_hand(seed)
    rng = np.random.default_rng([seed, 1])
    placed, given = rng.random(6) < 0.8, rng.random((3, 6)) < 0.4
    placed[rng.permutation(6)[:2]], given[2] = True, given[2] & (kind is FOUR_BAR)
    given[0] |= ~placed
    size = np.abs(z[placed] - z[placed][0]).max()
    band = rng.choice([0, 1, 1], 6) * rng.uniform(0.002, 0.08, 6)
    noise = rng.normal(size=(5, 6)) * np.array([placed, placed, *given])
    noise *= 0.9 * band * rng.uniform(0, 1, 6) / np.maximum(np.linalg.norm(noise, axis=0), 1e-9)
    constants = np.where(given.any(axis=1), rng.uniform(-3, 3, 3), 0)
    angles = np.angle(turned)
    angles[1] = phi
    angles += constants[:, None] + noise[2:]
    rows = [
        [float(x) if own else None for x, own in zip(*pair, strict=True)] for pair in zip(angles, given, strict=True)
    ]
    shifted = z + size * (noise[0] + 1j * noise[1])
    task = PathTask(
        [(w.real, w.imag) if own else None for w, own in zip(shifted, placed, strict=True)],
        **{
            name: tuple(own)
            for name, own in zip(("angles", "crank_angles", "output_angles"), rows, strict=True)
            if own != [None] * 6
        },
        tolerances=(1.02 * size * band).tolist(),
    )
    return task, 1e-6 * size * across, (kind, row, side, phi, constants)


def verdict_on(task, kind, row, side, phi, constants):
    """What is said of a linkage that is known, by its numbers and the constants of its angles."""
    middle = complex(np.nanmean(task.z))
    row = transformed(kind, row, complex(1 / task.size), -middle / task.size)
    state = mixed._State(kind, np.append(row, constants)[:, None], phi[None], np.array([side]))
    wanted = mixed._wanted(task, task.size, middle)
    (design,) = mixed._judged(task, Demands(size_ratio=1e9), wanted, state, (middle, task.size))
    return design.verdict


def test_a_linkage_that_meets_its_targets_is_never_rejected():
    """Targets closer to each other than their bands, too; but a millionth of the size across the path is too far."""
    accepted = rejected = 0
    for seed in range(20):
        try:
            task, aside, known = mix_of(seed)
        except SynthesisError:  # crank angles that noise turns back
            continue
        assert verdict_on(task, *known).accepted, seed
        accepted += 1
        exact = next((k for k in range(6) if task.tolerances[k] == 0 and task.points[k]), None)
        if exact is not None and seed < 10:
            z = task.z + aside * (np.arange(6) == exact)
            other = replace(task, points=[None if np.isnan(w) else (w.real, w.imag) for w in z])
            assert not verdict_on(other, *known).accepted, seed
            rejected += 1
    assert accepted > 15
    assert rejected > 3


def drawn(linkage):
    """Joints by the two links that they join, and P, in the reference pose, x + iy."""
    pose, chain = linkage.required_pose, linkage.mechanism.chain
    places = {}
    for (joint, link), element in linkage.elements.items():
        frame = link == linkage.mechanism.frame
        at = (0, 0, 0) if frame else pose[link]
        places[tuple(sorted(chain.joints[joint].links)), link] = complex(at[0], at[1]) + np.exp(1j * at[2]) * complex(
            element.x, element.y
        )
    point = linkage.points["P"]
    x, y, turn = pose[point.link]
    return places, complex(x, y) + np.exp(1j * turn) * complex(point.x, point.y)


def carried(z, first, second, at_first, at_second):
    """A point of a bar whose two pins have moved."""
    return at_first + (z - first) * (at_second - at_first) / (second - first)


def test_slider_cranks_meet_mixed_targets():
    """Places, coupler angles and timing of a slider-crank in closed form; designs are moved in closed form, too."""
    phi = np.radians([15, 60, 100, 160, 230])
    pin = np.exp(1j * phi)
    turned = np.exp(-1j * np.arcsin((np.imag(pin) - 0.3) / 2.8))
    z, angle = pin + (1.1 + 0.9j) * turned, np.angle(turned)
    task = PathTask(
        points(z),
        angles=[angle[0], None, angle[2], None, None],
        crank_angles=[*phi[:3], None, None],
        tolerances=[0] * 5,
    )
    found = [each for each in synthesise_path(task, number=8).designs if each.form == "slider-crank"]
    assert found
    for design in found:
        places, point = drawn(design.linkage)
        own, a, b = (
            places[key]
            for key in (
                (("crank", "frame"), "frame"),
                (("coupler", "crank"), "crank"),
                (("coupler", "slider"), "coupler"),
            )
        )
        line = next(e for (_, link), e in design.linkage.elements.items() if link == "frame" and e.is_line)
        along = np.exp(1j * line.angle)
        height = np.imag(np.conj(along) * (b - 1j * 0))
        side = np.sign(np.real(np.conj(along) * (b - a)))
        turn = np.array(design.drives) - design.linkage.required_pose["crank"].angle
        pins = own + (a - own) * np.exp(1j * turn)
        rise = height - np.imag(np.conj(along) * pins)
        far = pins + along * (side * np.sqrt(abs(b - a) ** 2 - rise**2) + 1j * rise)
        gaps = np.abs(carried(point, a, b, pins, far) - z)
        assert gaps.max() < 1e-8
        bars = np.unwrap(np.angle((far - pins) / (b - a)))
        assert np.cos(bars[2] - bars[0] - angle[2] + angle[0]) == pytest.approx(1, abs=1e-12)
        assert np.cos(np.diff(design.drives)[:2] - np.diff(phi)[:2]) == pytest.approx(1, abs=1e-12)


def test_six_bars_meet_mixed_targets():
    """All kinds at once, as a six-bar had them; designs are moved by cutting circles."""
    six_bar = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive=R(0-1)")
    places = {0: (0, 0), 1: (1, 0), 2: (2.2, 2.1), 3: (3, 0), 4: (1.7, 2.9), 5: (3.6, 3.2), 6: (4.3, 0.6)}
    motion = move(
        Linkage.from_drawing(six_bar, places, points={"P": ("4", 2.6, 3.6)}), np.radians([0, 35, 70, 110, 150])
    )
    z, coupler, crank, output = motion.complex_point("P"), *(motion.angle(link) for link in "415")
    task = PathTask(
        points(z),
        angles=[coupler[0], None, coupler[2], None, None],
        crank_angles=[crank[0], crank[1], None, crank[3], crank[4]],
        output_angles=[None, output[1], output[2], None, output[4]],
        tolerances=[0, 0, 0, 0, 0.05],
    )
    found = synthesise(task, structures=[six_bar], starts=4, link="4", demands=Demands(size_ratio=100))
    assert found.designs
    for design in found.designs:
        at, point = drawn(design.linkage)
        pins = [at[tuple(key), key[0]] for key in ("01", "12", "23", "03", "24", "45", "05")]
        turn = np.exp(1j * (np.array(design.drives) - design.linkage.required_pose["1"].angle))
        a0, a, b, b0, c, d, d0 = pins
        moved_a = a0 + (a - a0) * turn

        def side(p, q, r):
            return np.sign(np.imag(np.conj(q - p) * (r - p)))

        moved_b = cut(moved_a, b0, abs(b - a), abs(b - b0), side(a, b0, b))
        moved_c = carried(c, a, b, moved_a, moved_b)
        moved_d = cut(moved_c, d0, abs(d - c), abs(d - d0), side(c, d0, d))
        swings = {"3": (moved_b - b0) / (b - b0), "5": (moved_d - d0) / (d - d0)}  # links that turn at the frame
        gaps = np.abs(carried(point, c, d, moved_c, moved_d) - z)
        assert gaps[:4].max() < 1e-7
        assert gaps[4] < 0.05
        for bar, wanted, rows in (
            ((moved_d - moved_c) / (d - c), coupler, [0, 2]),
            (turn, crank, [0, 1, 3]),
            (swings[design.linkage.outputs[0]], output, [1, 2]),
        ):
            turned = np.angle(bar[rows] * np.exp(-1j * wanted[rows]))
            assert np.cos(turned - turned[0]) == pytest.approx(1, abs=1e-12)


def test_a_slider_has_no_output_angle():
    task = MIXED["angles without a point"]
    slider_crank = Mechanism.parse("R(0-1) R(1-2) R(2-3) P(3-0); frame=0; drive=R(0-1)")
    with pytest.raises(SynthesisError, match="but the driven one turns at the frame"):
        synthesise(task, structures=[slider_crank])
    assert {design.form for design in synthesise_path(task, number=3).designs} == {"four-bar"}


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
    found = propose(Specification(MIXED["angles without a point"], demands=Demands(crank=True), links=4))
    assert [each.mechanism for each in found.tried] == [None]
    assert found.best
