"""Four-bars on the sphere: dyads by two methods, designs by `move`, the plane as the limit."""

import itertools

import numpy as np
import pytest
from scipy.optimize import fsolve
from scipy.spatial.transform import Rotation

import gruebler as gr
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands
from gruebler.design.synthesis.dyads import Displacements, all_dyads
from gruebler.design.synthesis.spherical import synthesise_orientations
from gruebler.design.synthesis.spherical_dyads import displacements, five_orientation_dyads
from gruebler.design.synthesis.spherical_functions import synthesise_spherical_function
from gruebler.mechanics.space import SphericalFourBar


def _random_task(seed, count=5):
    rng = np.random.default_rng(seed)
    steps = rng.normal(0, 0.4, (count, 3))
    return Rotation.from_rotvec(np.cumsum(steps, axis=0)).as_matrix()


def _coupler_task(bar, phi, branch="+"):
    """Orientations of the coupler of a four-bar, and its four axes in the first of them."""
    psi = bar.motion(phi, branch=branch).output.value
    a, c, d = bar.a, bar.c, bar.d
    pin = np.stack([np.sin(a) * np.cos(phi), np.sin(a) * np.sin(phi), np.full(len(phi), np.cos(a))], axis=1)
    b0 = np.array([np.sin(d), 0, np.cos(d)])
    far = np.array([np.cos(d), 0, -np.sin(d)]) * np.cos(psi)[:, None] + np.array([0, 1.0, 0]) * np.sin(psi)[:, None]
    far = np.cos(c) * b0 + np.sin(c) * far
    third = np.cross(pin, far)
    third /= np.linalg.norm(third, axis=1, keepdims=True)
    frames = np.stack([pin, third, np.cross(pin, third)], axis=2)
    return frames, np.array([[0, 0, 1], pin[0], far[0], b0])


@pytest.mark.parametrize("seed", range(4))
def test_all_real_dyads_against_newtons_method_from_many_starts(seed):
    """Second method: w . (A g - g) = 0 with both axes as points of a chart, from 400 random starts."""
    turns = displacements(_random_task(seed))
    dyads, found = five_orientation_dyads(turns)
    assert found == 6
    for dyad in dyads:
        assert np.abs((turns - np.eye(3)) @ dyad.moving @ dyad.fixed).max() < 1e-13
    rng = np.random.default_rng(seed)
    other = []
    for _ in range(400):
        w, g = rng.normal(size=(2, 3))

        def gaps(x, w=w, g=g):
            return [*((turns - np.eye(3)) @ x[3:] @ x[:3]), x[:3] @ w - w @ w, x[3:] @ g - g @ g]

        x, _, ended, _ = fsolve(gaps, [*w, *g], full_output=True, xtol=1e-13)
        axis = x[3:] / np.linalg.norm(x[3:])
        clean = ended == 1 and np.abs(gaps(x)).max() < 1e-10 and np.abs(x).max() < 1e4
        if clean and all(abs(axis @ known) < 1 - 1e-8 for known in other):
            other.append(axis)
    assert len(other) == len(dyads)
    assert len(dyads) % 2 == 0
    assert all(any(abs(axis @ dyad.moving) > 1 - 1e-10 for axis in other) for dyad in dyads)


@pytest.mark.parametrize("arcs", [(30, 80, 60, 70), (40, 100, 95, 60), (75, 60, 80, 30)])
def test_orientations_of_a_four_bar_give_it_back(arcs):
    bar = SphericalFourBar(*np.radians(arcs))
    phi = np.radians([20, 50, 95, 130, 170.0])
    task, axes = _coupler_task(bar, phi)
    found = synthesise_orientations(task)
    lines = [np.abs(np.sum(design.axes * axes, axis=1)) for design in found.designs]
    lines += [np.abs(np.sum(design.axes[::-1] * axes, axis=1)) for design in found.designs]
    assert max(line.min() for line in lines) > 1 - 1e-9


def _moved_through(design, task):
    """The largest miss of the orientations by `move`, which knows closing conditions only."""
    drives = np.array(design.drives) - design.drives[0]
    steps = np.arange(len(drives) * 8 - 7) / 8
    motion = gr.move(design.linkage, np.interp(steps, np.arange(len(drives)), drives))
    assert motion.complete
    turns = motion.pose("coupler")[::8, :3, :3]
    return np.abs(turns - task @ task[0].T).max()


@pytest.mark.parametrize("count", [3, 4, 5])
def test_accepted_designs_take_the_orientations_by_another_solver(count):
    accepted = 0
    rng = np.random.default_rng(count)
    for seed in range(6):
        task = _random_task(seed, count)
        if count == 5:  # of random ones hardly any is met on one branch
            bar = SphericalFourBar(*np.radians([30, 80, 60, 70]) + rng.uniform(-0.1, 0.1, 4))
            task, _ = _coupler_task(bar, np.sort(rng.uniform(0.3, 5, 5)))
        for design in synthesise_orientations(task, number=3).designs[:3]:
            assert _moved_through(design, task) < 1e-7
            accepted += 1
    assert accepted >= 3


def test_demands_are_met_within_the_family():
    task = _random_task(1, 3)
    found = synthesise_orientations(task, Demands(crank=True, transmission=np.radians(30)), number=4)
    assert len(found.designs) == 4
    for design in found.designs:
        assert design.four_bar.limits[0].full
        assert design.verdict.transmission >= np.radians(30)
        way = np.linspace(min(design.drives), max(design.drives), 400)
        least = design.four_bar.motion(way, branch=design.branch).transmission_angle.min()
        assert least == pytest.approx(design.verdict.transmission, abs=1e-3)


@pytest.mark.parametrize("count", [3, 4])
@pytest.mark.parametrize("arcs", [(40, 68, 62, 78), (38, 75, 66, 60), (36, 60, 72, 55)])
def test_a_known_member_of_a_family_is_not_better_than_those_that_are_found(arcs, count):
    """Its ratio of arcs and its transmission angle, by the law of cosines at the ends of the way, are demanded."""
    a, b, c, d = np.radians(arcs)
    phi = np.radians([40, 75, 110, 140][:count])
    task, _ = _coupler_task(SphericalFourBar(a, b, c, d), phi)
    across = np.cos(a) * np.cos(d) + np.sin(a) * np.sin(d) * np.cos(phi)
    least = np.arccos(np.abs((across - np.cos(b) * np.cos(c)) / (np.sin(b) * np.sin(c))).max())
    ratio = max(arcs) / min(arcs)
    assert a + max(arcs) * np.pi / 180 < sum(np.radians(sorted(arcs)[1:3]))  # Grashof: its crank turns fully
    demands = Demands(crank=True, size_ratio=ratio + 1e-6, transmission=least - 1e-6)
    found = synthesise_orientations(task, demands, number=4)
    assert found.designs
    for design in found.designs:
        assert design.verdict.transmission >= least - 1e-6
        assert design.verdict.size_ratio <= ratio + 1e-6


def test_small_caps_are_the_plane():
    """The worked example with four real planar dyads (README) on a sphere of 10,000 times its size: four of six."""
    rows = [(0, 0, 0), (-2, 3.8, 81), (-0.1, 3.4, -16), (1.5, 0.8, -32), (-1.8, 2.2, 55)]
    far = 1e-4
    task = [
        Rotation.from_rotvec([-far * y, far * x, 0]).as_matrix()
        @ Rotation.from_euler("z", angle, degrees=True).as_matrix()
        for x, y, angle in rows
    ]
    origins = np.array([complex(x, y) for x, y, _ in rows])
    given, _, size = Displacements.of(origins, np.exp(1j * np.radians([angle for *_, angle in rows])))
    plane = [dyad for dyad in all_dyads(given).real if not dyad.slides]
    sphere = five_orientation_dyads(displacements(task)).real
    places = [complex(*(dyad.moving[:2] / dyad.moving[2])) / far / size for dyad in sphere]
    assert len(plane) == 4
    for dyad in plane:
        assert min(abs(dyad.moving - place) for place in places) < 1e-3 * (1 + abs(dyad.moving))


@pytest.mark.parametrize("branch", ["+", "-"])
@pytest.mark.parametrize("arcs", [(30, 80, 60, 70), (40, 100, 95, 60), (25, 120, 70, 130)])
def test_pairs_of_a_four_bar_give_it_back(arcs, branch):
    bar = SphericalFourBar(*np.radians(arcs))
    phi = np.radians([15, 60, 110, 160.0])
    psi = bar.motion(phi, branch=branch).output.value
    (design,) = synthesise_spherical_function(phi, psi).designs
    assert [getattr(design.four_bar, arc) for arc in "abcd"] == pytest.approx(np.radians(arcs), abs=1e-9)
    assert design.branch == branch
    (same,) = synthesise_spherical_function(phi[:3], psi[:3], frame=bar.d).designs
    assert same.four_bar.b == pytest.approx(bar.b, abs=1e-9)


def test_pairs_of_a_universal_joint_give_it_back():
    """tan(output) cos(30°) = tan(input), as textbooks have it of Hooke's joint, whose fork is a right angle ahead."""
    turns, bend = np.radians([10.0, 30, 50, 80]), np.radians(30)
    outputs = np.pi / 2 + _hooke(turns)
    (design,) = synthesise_spherical_function(turns, outputs).designs
    assert [getattr(design.four_bar, arc) for arc in "abcd"] == pytest.approx(np.radians([90, 90, 90, 30]), abs=1e-9)
    (same,) = synthesise_spherical_function(turns[:3], outputs[:3], frame=bend).designs
    assert same.four_bar.b == pytest.approx(np.pi / 2, abs=1e-9)
    free = synthesise_spherical_function(
        [0, 0.3, 0.7, 1.2, 1.4], [0, *_hooke([0.3, 0.7, 1.2, 1.4])], frame=bend, free_starts=True
    )
    assert free.count.theorem == 5
    arcs = [[getattr(each.four_bar, arc) for arc in "abc"] for each in free.designs]
    assert min(np.abs(np.array(arcs) - np.pi / 2).max(axis=1)) < 1e-7


def _hooke(turns):
    return np.arctan2(np.sin(turns), np.cos(turns) * np.cos(np.radians(30)))


def _random_pairs(seed):
    """Five pairs of a random four-bar, counted from the first one; its arcs."""
    rng = np.random.default_rng(seed)
    bar = SphericalFourBar(*np.radians([30, 80, 60, 70]) + rng.uniform(-0.15, 0.15, 4))
    phi = np.sort(rng.uniform(0, 5.5, 5))
    psi = bar.motion(phi).output.value
    return phi - phi[0], psi - psi[0], bar


def _coupler_arcs(phi, psi, d, starts=400):
    """Second method: arcs of all real linkages by Newton's method on A . B = cos b, the starts unknown, too."""
    rng = np.random.default_rng(0)
    found = []
    for _ in range(starts):

        def gaps(x):
            k0, k1, k2, first, second = x
            u, v = phi + first, psi + second
            return k0 * np.cos(u) + k1 * np.cos(v) + k2 + np.cos(d) * np.cos(u) * np.cos(v) + np.sin(u) * np.sin(v)

        begin = [*rng.normal(0, 1, 3), *rng.uniform(0, 2 * np.pi, 2)]
        x, _, ended, _ = fsolve(gaps, begin, full_output=True, xtol=1e-13)
        if ended != 1 or np.abs(gaps(x)).max() > 1e-11 or np.abs(x[:3]).max() > 1e3:
            continue
        a, c = np.arctan2(np.sin(d), -x[1]), np.arctan2(np.sin(d), x[0])
        cosine = np.cos(a) * np.cos(c) * np.cos(d) - x[2] * np.sin(a) * np.sin(c)
        row = np.array([min(a, np.pi - a), min(c, np.pi - c), abs(cosine)])  # opposite axes are the same ones
        if abs(cosine) < 1 and all(np.abs(row - other).max() > 1e-6 for other in found):
            found.append(row)
    return np.array(found)


@pytest.mark.parametrize("seed", range(4))
def test_free_starts_against_newtons_method_from_many_starts(seed):
    phi, psi, bar = _random_pairs(seed)
    result = synthesise_spherical_function(phi, psi, frame=bar.d, free_starts=True)
    assert (result.count.theorem, result.count.found) == (5, 5)
    own = [design.four_bar for design in (*result.designs, *result.rejected)]
    assert len(own) == result.count.real
    assert len(own) % 2 == 1  # the frame is the sixth dyad, and real ones are even in number
    assert min(np.abs(np.array([each.a, each.b, each.c]) - [bar.a, bar.b, bar.c]).max() for each in own) < 1e-8
    rows = np.array([[min(arc, np.pi - arc) for arc in (each.a, each.c)] + [abs(np.cos(each.b))] for each in own])
    other = _coupler_arcs(phi, psi, bar.d)
    assert len(other) == len(rows)
    assert np.abs(other[:, None] - rows).max(axis=2).min(axis=1).max() < 1e-7


@pytest.mark.parametrize("count", [3, 4, 5])
def test_accepted_functions_by_another_solver(count):
    """The output link turns by the wanted angles when `move`, which knows closing conditions only, turns the crank."""
    judged = 0
    for seed in range(5):
        phi, psi, bar = (part[:count] if k < 2 else part for k, part in enumerate(_random_pairs(seed)))
        for design in synthesise_spherical_function(phi, psi, frame=bar.d, free_starts=True, number=3).designs[:3]:
            assert np.diff(design.drives) % (2 * np.pi) == pytest.approx(np.diff(phi), abs=1e-9)
            steps = np.interp(
                np.arange(count * 8 - 7) / 8, np.arange(count), np.array(design.drives) - design.drives[0]
            )
            motion = gr.move(design.linkage, steps)
            assert motion.complete
            turns = Rotation.from_matrix(motion.pose("rocker")[::8, :3, :3])
            wanted = Rotation.from_rotvec(psi[:, None] * design.axes[3])
            assert (turns * wanted.inv()).magnitude().max() < 1e-7
            judged += 1
    assert judged >= 4


@pytest.mark.parametrize(
    ("phi", "psi", "frame"),
    [
        ([0, 0.124, 0.682], [0, 0.266, 0.149], 1.196),  # the best of the sample has 48.8 degrees
        ([0, 0.922, 1.387], [0, 0.954, 0.972], 0.982),  # none of 150 samples has a crank that turns fully
    ],
)
def test_a_function_with_free_starts_is_as_good_as_a_sweep_of_both_starts(phi, psi, frame):
    """Second method: linear equations for every pair of starts of a grid, 7.5 and 15 degrees apart."""
    swept = []
    for start, begin in itertools.product(np.pi * np.arange(24) / 24, 2 * np.pi * np.arange(24) / 24):
        found = synthesise_spherical_function(np.array(phi) + start, np.array(psi) + begin, frame=frame)
        swept += found.designs
    free = synthesise_spherical_function(phi, psi, frame=frame, free_starts=True).designs
    best, other = (
        max((each.verdict.turns_fully, each.verdict.transmission) for each in designs) for designs in (free, swept)
    )
    assert best > other
    arcs = np.array([[each.four_bar.a, each.four_bar.b, each.four_bar.c] for each in free])
    apart = np.abs(arcs[:, None] - arcs).max(axis=2)
    assert apart[~np.eye(len(free), dtype=bool)].min() >= 0.02  # none is listed twice


def test_pairs_without_a_real_linkage_say_so():
    found = synthesise_spherical_function([0.1, 0.5, 0.9, 1.4], [0.1, 2.5, -1.0, 2.0])
    assert not found.designs + found.rejected or found.rejected
    assert found.notes or found.rejected[0].verdict.reasons


@pytest.mark.parametrize(
    ("task", "words"),
    [
        ([np.eye(3)] * 2, "three to five matrices"),
        ([np.eye(3), np.eye(3), -np.eye(3)], "orientation 3 is no rotation"),
        ([np.eye(3), np.eye(3), np.eye(3)], "orientations 1 and 2 are equal"),
        (Rotation.from_euler("z", [[0], [10], [30], [50], [70]], degrees=True).as_matrix(), "infinitely many dyads"),
        (Rotation.from_euler("z", [[0], [20], [40]], degrees=True).as_matrix(), "infinitely many dyads"),
    ],
)
def test_tasks_that_cannot_be_solved_say_why(task, words):
    with pytest.raises(SynthesisError, match=words):
        synthesise_orientations(task)


@pytest.mark.parametrize(
    ("pairs", "options", "words"),
    [
        (4, {"free_starts": True}, "need the arc of the frame"),
        (4, {"frame": 1.0}, "expected 3 pairs of angles, but found 4 inputs"),
        (6, {"frame": 1.0, "free_starts": True}, "expected 3, 4 or 5 pairs"),
        (3, {"frame": 3.2}, "between 0 and 180 degrees, but found 183.346"),
    ],
)
def test_functions_that_cannot_be_solved_say_why(pairs, options, words):
    with pytest.raises(SynthesisError, match=words):
        synthesise_spherical_function(np.arange(pairs) / 3, np.arange(pairs) / 4, **options)


def test_demands_for_the_plane_are_refused():
    with pytest.raises(SynthesisError, match="demands for the plane"):
        synthesise_orientations(_random_task(0), Demands(region=(0, 0, 1, 1)))
