"""Points and mixed tasks: counts of the theorems, linkages that come back, certified solutions."""

import json
import re
from fractions import Fraction
from functools import cache
from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gruebler import _core
from gruebler.base.errors import SynthesisError
from gruebler.cli import main
from gruebler.design.synthesis import Demands, PathTask, PositionTask, synthesise, synthesise_path
from gruebler.design.synthesis.alt_burmester import PROBLEMS, Problem, load_generic_solutions, parameters, solutions
from gruebler.design.synthesis.endgame import path_ends
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.geometry import cognates
from gruebler.mechanics.kinematics import move
from tests.core.four_bar_equations import evaluate
from tests.design.synthesis.monodromy import find_generic
from tests.design.synthesis.test_simulated_verdicts import cut_circles, pivots_of

NINE, TWO, THREE, FOUR, GIVEN = PROBLEMS
KNOWN = FourBar(25, 70, 40, 70).linkage({"P": (45, 40)})
WAMPLER = [
    (0.8961867, -0.09802917),
    (1.2156535, -1.18749100),
    (1.5151435, -0.85449808),
    (1.6754775, -0.48768058),
    (1.7138690, -0.30099232),
    (1.7215236, 0.03269953),
    (1.6642029, 0.33241088),
    (1.4984171, 0.74435576),
    (1.3011834, 0.92153806),
]


def random_parameters(problem, seed):
    rng = np.random.default_rng(seed)
    count = problem.poses + problem.points
    pivots = tuple(complex(*row) for row in rng.normal(size=(2, 2))) if problem.given_pivots else None
    d = rng.normal(size=count) + 1j * rng.normal(size=count)
    return parameters(d, np.exp(1j * rng.uniform(-3, 3, problem.poses)), pivots)


def values(problem, z, p):
    f, jac = _core.evaluate_equations(z[None], p, problem.poses, problem.points)
    return f[0], jac[0]


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda p: p.name)
def test_the_derivatives_of_the_equations(problem):
    p = random_parameters(problem, 1)
    rng = np.random.default_rng(2)
    z = rng.normal(size=8) + 1j * rng.normal(size=8)
    dp = np.where(p != 0, rng.normal(size=p.shape) + 1j * rng.normal(size=p.shape), 0)
    _, jac = values(problem, z, p)
    for k in range(8):
        step = np.zeros(8, complex)
        step[k] = 1e-6
        slope = (values(problem, z + step, p)[0] - values(problem, z - step, p)[0]) / 2e-6
        assert jac[:, k] == pytest.approx(slope, rel=1e-6, abs=1e-6)
    _, _, ft = evaluate(z, p, dp, problem.poses, problem.points)
    slope = (values(problem, z, p + 1e-6 * dp)[0] - values(problem, z, p - 1e-6 * dp)[0]) / 2e-6
    assert ft == pytest.approx(slope, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda p: p.name)
def test_the_stored_solutions_are_complete_and_proved(problem):
    p, z = load_generic_solutions(problem)
    assert len(z) == problem.classes
    assert _core.certify(z, p, problem.poses, problem.points).all()
    assert problem.classes * problem.members in (8652, 2224, 402, 60, 36)


class Exact:
    """A complex number with rational parts, for the same equations without rounding."""

    def __init__(self, re, im=0):
        self.re, self.im = Fraction(re), Fraction(im)

    @staticmethod
    def of(value):
        return value if isinstance(value, Exact) else Exact(complex(value).real, complex(value).imag)

    def __neg__(self):
        return Exact(-self.re, -self.im)

    def __add__(self, other):
        other = Exact.of(other)
        return Exact(self.re + other.re, self.im + other.im)

    def __sub__(self, other):
        return self + -Exact.of(other)

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        other = Exact.of(other)
        return Exact(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def __truediv__(self, other):
        size = other.re**2 + other.im**2
        return self * Exact(other.re / size, -other.im / size)

    def __complex__(self):
        return complex(float(self.re), float(self.im))

    __radd__, __rmul__ = __add__, __mul__


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda p: p.name)
@pytest.mark.parametrize("size", [1.0, 1e5])
def test_residuals_with_twice_the_digits_are_the_exact_ones(problem, size):
    """Against rational numbers; x close to a and y close to b, so that double precision alone would lose all digits."""
    p = random_parameters(problem, 3)
    rng = np.random.default_rng(4)
    z = size * np.repeat(rng.normal(size=4) + 1j * rng.normal(size=4), 2)[[0, 2, 1, 3, 0, 2, 1, 3]]
    z += 1e-6 * rng.normal(size=8)
    f, _ = _core.evaluate_equations(z[None], p, problem.poses, problem.points, sharp=True)

    def exact(values):
        out = np.empty(np.shape(values), object)
        out.ravel()[:] = [Exact.of(v) for v in np.ravel(values)]
        return out

    true, _, _ = evaluate(exact(z), exact(p), exact(np.zeros((4, 8))), problem.poses, problem.points)
    assert f[0] == pytest.approx(true.astype(complex), rel=1e-15)


@pytest.mark.parametrize("seed", [45, 1009])
def test_solutions_far_out_and_nearly_singular_are_reached(seed):
    """Seed 45 has a solution whose dyads nearly coincide, seed 1009 one with pivots 300,000 sizes away."""
    found = solutions(NINE, random_parameters(NINE, seed))
    assert (len(found.z), found.missing, found.infinite) == (1442, 0, 0)
    assert found.certified.mean() > 0.999


UPPER = [(-1.6, 0.4), (-1.3, 0.7), (-0.2, 1.7), (0.8, 0.5)]
MIRROR = [*UPPER, (2.5, 0), *((x, -y) for x, y in reversed(UPPER))]
# A symmetric coupler curve: coupler, rocker and the distance of the coupler point from the rocker's pin are equal.
SYMMETRIC = FourBar(1, 2.5, 2.5, 2).linkage({"P": (2.5 + 2.5 * np.cos(2), 2.5 * np.sin(2))})


def reduced(points):
    z = np.array([complex(*point) for point in points])
    others = (z - z[3])[np.arange(len(z)) != 3]
    return parameters(others / np.abs(others).mean(), np.array([]))


@pytest.mark.slow
def test_points_symmetric_about_a_line_are_resolved_to_the_last_path():
    """Some paths go to infinity, some end at singular solutions: none is left over, whatever the order of points."""
    found = solutions(NINE, reduced(MIRROR))
    assert found.missing == 0
    assert len(found.z) + found.infinite + found.singular == 1442
    assert 0 < len(found.multiple) <= found.singular
    order = [2, 5, 7, 3, 0, 8, 1, 4, 6]
    again = solutions(NINE, reduced([MIRROR[k] for k in order]))
    assert again.missing == 0
    # The six cognates of a linkage with a link of length zero are none: their paths may end elsewhere.
    first, second = proper(found.z), proper(again.z)
    assert len(first) == len(second) > 1300
    gaps = np.abs(NINE.marks(first)[:, None] - NINE.marks(second)).max(axis=2)
    assert (gaps.min(axis=1) < 1e-6 * np.abs(NINE.marks(first)).max(axis=1)).all()


def proper(z):
    """Solutions without links of length zero."""
    lengths = np.stack(
        [np.abs(z[:, i] - z[:, j]) for i, j in ((0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7))]
    )
    return z[lengths.min(axis=0) > 1e-6]


def test_nine_points_of_a_symmetric_linkage_give_it_back():
    motion = move(SYMMETRIC, np.radians(np.arange(0, 360, 40)))
    found = synthesise_path(PathTask(motion.point("P")))
    assert found.count.found == 1442
    assert not any("not resolved" in str(note) for note in found.notes)
    assert any("special" in str(note) for note in found.notes)
    gaps = [
        np.abs(np.sort([d.linkage.length(*row) for row in _ROWS]) - [1, 2, 2.5, 2.5]).max()
        for d in (*found.designs, *found.rejected)
    ]
    assert min(gaps) < 1e-6
    for design in found.designs:
        assert design.verdict.error < 1e-9


def series(t, winding, poles):
    """A path with a known end: z = 1 + s + s^2 with s = (1 - t)^(1/c), or with 1/s besides."""
    s = (1 - t) ** (1 / winding)
    return 1 + s + s * s + (0.3 / s if poles else 0)


@pytest.mark.parametrize("winding", [1, 2, 3, 5])
@pytest.mark.parametrize("poles", [False, True])
def test_the_endgame_knows_limit_winding_number_and_infinity(winding, poles):
    """On paths whose end is known; each is carried on from branch to branch by the nearest root."""

    def follow(z, first, second):
        t0, t1 = first[0, 0], second[0, 0]
        out = z.copy()
        for t in t0 + (t1 - t0) * np.linspace(0, 1, 40)[1:]:
            s = (1 - t + 0j) ** (1 / winding) * np.exp(2j * np.pi * np.arange(winding) / winding)
            branches = 1 + s + s * s + (0.3 / s if poles else 0)
            out = branches[np.abs(branches[:, None] - out[:, 0]).argmin(axis=0)][:, None] * np.ones(8)
        return out, np.ones(len(z), bool)

    begin, end = np.zeros((4, 8), complex), np.ones((4, 8), complex)
    ends = path_ends(np.full((2, 8), series(0, winding, poles), complex), begin, end, follow)
    assert ends.winding.tolist() == [winding] * 2
    assert ends.infinite.tolist() == [poles] * 2
    if not poles:
        assert ends.z == pytest.approx(np.ones((2, 8)), abs=1e-6)


def test_a_wrong_solution_is_not_certified():
    p, z = load_generic_solutions(FOUR)
    assert not _core.certify(z + 0.3, p, FOUR.poses, FOUR.points).any()
    assert not _core.certify(np.repeat(z[:1], 2, axis=0), p, FOUR.poses, FOUR.points).any()


@pytest.mark.parametrize("problem", [FOUR, GIVEN], ids=lambda p: p.name)
@settings(max_examples=12, deadline=None)
@given(st.integers(0, 10**6))
def test_every_random_task_has_all_its_solutions(problem, seed):
    found = solutions(problem, random_parameters(problem, seed), threads=1)
    assert (len(found.z), found.missing) == (problem.classes, 0)
    assert found.certified.mean() > 0.9


@pytest.mark.slow
@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda p: p.name)
def test_many_random_tasks_have_all_their_solutions(problem):
    for seed in range(100 if problem.classes > 1000 else 300):
        found = solutions(problem, random_parameters(problem, seed))
        assert (len(found.z), found.infinite) == (problem.classes, 0), seed
        # Nearly singular solutions far away are left: at most three in a thousand, and it is said.
        assert np.count_nonzero(~found.certified) <= max(1, 3 * problem.classes // 1000), seed


def test_five_positions_are_sixteen_ordered_pairs_of_four_dyads():
    """The entry (5, 0) of the table, by the equations and the tracker of the other entries.

    Monodromy goes from pairs of different dyads to such pairs: six classes, twelve in order. The dyads that these are
    made of, each paired with itself, are the other four: solutions, too.
    """
    problem = Problem(name="five positions", poses=4, points=0, classes=6, members=2)
    p, z = find_generic(problem, seed=3)
    assert len(z) == 6
    dyads = np.concatenate([z[:, [0, 1, 4, 5]], z[:, [2, 3, 6, 7]]])  # x, x*, a, a*
    different = [d for k, d in enumerate(dyads) if all(np.abs(d - other).max() > 1e-6 for other in dyads[:k])]
    assert len(different) == 4
    pairs = 0
    for one in different:
        for two in different:
            both = np.array([one[0], one[1], two[0], two[1], one[2], one[3], two[2], two[3]])
            assert np.abs(values(problem, both, p)[0]).max() < 1e-6 * (1 + np.abs(both).max()) ** 3
            pairs += 1
    assert pairs == 16
    rng = np.random.default_rng(1)
    rows = [(*rng.normal(size=2), a) for a in rng.uniform(-2, 2, 5)]
    assert "4 complex dyads are 16 solutions as ordered pairs" in str(synthesise(PositionTask(rows)).notes[0])


@pytest.mark.slow
@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda p: p.name)
def test_monodromy_finds_the_count_of_the_theorem_again(problem):
    """The program that made the stored solutions, from another random task."""
    assert len(find_generic(problem, seed=23).z) == problem.classes


def test_a_four_bar_with_given_pivots_comes_back():
    motion = move(KNOWN, np.radians([15.0, 60, 100, 150, 220]))
    found = synthesise_path(PathTask(motion.point("P"), fixed_pivots=[(0, 0), (70, 0)]))
    assert found.count.found == 36
    lengths = [(d.linkage.length("crank", 0, 1), d.linkage.length("coupler", 1, 2)) for d in found.designs]
    assert min(abs(a - 25) + abs(b - 70) for a, b in lengths) < 1e-8


def test_ends_at_infinity_are_no_linkages(tmp_path, capsys):
    """Five points on a line: of the 36 solutions 4 lie at infinity.

    The numbers are those of Newton's method in other unknowns (both pins, the coupler's rotations eliminated) from
    80,000 random complex starts: 32 different finite solutions, none beyond 10 lengths, 14 of them real.
    """
    points, pivots = [(0, 0), (1, 0), (2, 0), (3, 0), (4.5, 0)], [(1, 2), (3, -2)]
    count = synthesise_path(PathTask(points, fixed_pivots=pivots)).count
    assert (count.theorem, count.finite, count.infinite, count.real) == (36, 32, 4, 14)
    task = tmp_path / "line.json"
    task.write_text(json.dumps({"points": points, "fixed_pivots": pivots}), encoding="utf-8")
    main(["synthesise", "path", str(task)])
    said = "36 found: 32 finite, 14 of them real, and 4 at infinity, which are no linkages."
    assert said in capsys.readouterr().out


@st.composite
def crank_rockers(draw):
    """A four-bar whose crank turns fully, with a coupler point, in a task of its own size."""
    b, c = draw(st.floats(1.5, 3)), draw(st.floats(1.5, 3))
    d = draw(st.floats(abs(b - c) + 1.15, b + c - 1.15))
    point = (draw(st.floats(-2, 3)), draw(st.floats(0.3, 2)))
    return FourBar(1, b, c, d).linkage({"P": point})


@settings(max_examples=6, deadline=None)
@given(crank_rockers(), st.floats(0, 6), st.floats(0.5, 0.9), st.booleans())
def test_a_four_bar_of_a_mixed_task_comes_back(known, start, step, mirrored):
    motion = move(known.mirrored() if mirrored else known, start + step * np.arange(6) * (-1 if mirrored else 1))
    angles = [a if k in (0, 1, 3, 4) else None for k, a in enumerate(motion.angle("coupler"))]
    found = synthesise_path(PathTask(motion.point("P"), angles=tuple(angles)))
    assert found.count.found == 30
    wanted = known.length("coupler", 1, 2)
    assert min(abs(d.linkage.length("coupler", 1, 2) - wanted) for d in found.designs) < 1e-5
    for design in found.designs:
        assert design.verdict.error < 1e-9


@settings(max_examples=8, deadline=None)
@given(crank_rockers(), st.floats(0, 6), st.floats(0.3, 0.9))
def test_a_four_bar_with_timing_comes_back(known, start, step):
    drives = start + step * np.arange(5)
    motion = move(known, drives)
    found = synthesise_path(PathTask(motion.point("P"), crank_angles=tuple(drives)))
    mine = [d for d in found.designs if abs(d.linkage.length("crank", 0, 1) - 1) < 1e-4]
    assert mine
    for design in found.designs:
        assert np.diff(design.drives) == pytest.approx(np.full(4, step), abs=1e-7)


def test_nine_points_give_the_four_bar_and_its_cognates_back():
    motion = move(KNOWN, np.radians([10.0, 45, 80, 120, 155, 195, 240, 280, 330]))
    found = synthesise_path(PathTask(motion.point("P")))
    assert found.count.found == found.count.theorem == 1442
    raw = [(c.size.a, c.size.b, c.size.c, c.size.d) for c in cognates(FourBar(25, 70, 40, 70), 45, 40)]
    wanted = [sorted(row) for row in raw]
    assert len(wanted) == 3
    # Of the three the double rocker, whose coupler turns, cannot be driven through all points at the frame.
    for lengths, accepted in zip(wanted, [FourBar(*row).turning not in ((), ("b",)) for row in raw], strict=True):
        designs = found.designs if accepted else found.rejected
        have = [sorted(d.linkage.length(*row) for row in _ROWS) for d in designs]
        assert min(np.abs(np.subtract(lengths, row)).max() for row in have) < 1e-6
    for design in found.designs:
        assert design.verdict.error < 1e-9
        assert design.verdict.in_order
        assert design.verdict.one_branch


_ROWS = (("crank", 0, 1), ("coupler", 1, 2), ("rocker", 2, 3), ("frame", 0, 3))


@pytest.mark.slow
def test_wamplers_nine_points():
    """The real triples of the published example, counted here; each design is verified by the solver of motion."""
    found = synthesise_path(PathTask(WAMPLER))
    assert found.count.found == 1442
    assert found.count.real == REAL_TRIPLES
    assert len(found.designs) + len(found.rejected) == 3 * REAL_TRIPLES
    assert len(found.designs) == ACCEPTED


REAL_TRIPLES, ACCEPTED = 21, 0


OPEN = {
    "arc": [(0, 0), (1, 0.6), (2, 0.8), (3, 0.6), (4, 0.1)],
    "corners": [(0, 0), (30, 0), (30, 30), (0, 30), (-10, 10)],
    "zigzag": [(0, 0), (10, 3), (20, 1), (28, 9)],
    "three": [(0, 0), (1, 1), (2, 0)],
    "two": [(0, 0), (1, 1)],
    "six on a wave": [(6 * s, np.sin(6 * s)) for s in np.linspace(0, 1, 6)],
    "seven round a corner": [(3 * min(s, 0.6), 3 * max(s - 0.6, 0)) for s in np.linspace(0, 1, 7)],
    "eight on an arc": [(4 * s, 1.3 * np.sin(2.5 * s)) for s in np.linspace(0, 1, 8)],
}
SLOW = ("arc", "zigzag", "three", "seven round a corner", "eight on an arc")


@cache
def solved_open(name):
    return synthesise_path(PathTask(OPEN[name]))


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow) if name in SLOW else name for name in OPEN]
)
def test_few_open_points_are_met_by_some_of_a_family(name):
    """As many parameters are free as are left of the nine of a coupler curve; every design passes in order."""
    points, found = OPEN[name], solved_open(name)
    assert f"(free parameters: {9 - len(points)})" in str(found.notes[0])
    assert found.count.theorem is None
    z = np.array([complex(*p) for p in points])
    assert len(found.designs) >= 3
    for design in found.designs[:12]:
        way = np.concatenate([np.linspace(*pair, 12) for pair in pairwise(design.drives)])
        motion = move(design.linkage, way)
        assert motion.complete
        places = motion.complex_point("P")
        passed = [int(np.argmin(np.abs(places - w))) for w in z]
        assert passed == sorted(passed)
        assert np.abs(places[passed] - z).max() < 1e-8 * np.abs(z - z[0]).max()


def test_designs_of_six_points_are_different():
    """They come from as many curves: no two have the same lengths."""
    linkages = [design.linkage for design in solved_open("six on a wave").designs]
    shapes = [
        np.array(
            [own.length("crank", 0, 1), own.length("coupler", 1, 2), abs(own.points["P"].x), abs(own.points["P"].y)]
        )
        for own in linkages
    ]
    assert len(linkages) >= 12
    assert all(np.abs(np.log(one / other)).max() > 1e-3 for one, other in combinations(shapes, 2))


@pytest.mark.slow
def test_points_that_no_linkage_was_found_for_show_the_nearest():
    found = synthesise_path(PathTask([(6 * s, np.sin(6 * s)) for s in np.linspace(0, 1, 8)]), number=2)
    assert "(free parameters: 1)" in str(found.notes[0])
    assert "led to none" in str(found.notes[0])
    assert (found.count.real, len(found.designs)) == (0, 0)
    assert all(1e-4 < design.verdict.error < 0.1 for design in found.rejected)


SIX_POINTS = ((-50, -5), (-30, 10), (-10, 18), (12, 19), (30, 12), (50, -8))


@pytest.mark.parametrize(
    ("points", "angle", "ratio", "named"),
    [
        pytest.param(SIX_POINTS, 88, 20, "a transmission angle of 88°", marks=pytest.mark.slow),
        (SIX_POINTS[::2], 89.9, 1.05, "a transmission angle of 89.9° and a size ratio of 1.05"),
    ],
    ids=["six", "three"],
)
def test_of_points_without_a_design_the_tightest_demand_is_named(points, angle, ratio, named):
    """Without it there are designs, as a search with the other demands alone tells."""
    task = PathTask(points)
    none = synthesise(task, demands=Demands(crank=True, transmission=np.radians(angle), size_ratio=ratio))
    assert not none.designs
    (count,) = re.findall(rf"all but the demand of {named}: ([0-9,]+)\.", " ".join(map(str, none.notes)))
    others = synthesise(task, demands=Demands(crank=True)).designs
    assert int(count) > 0
    assert any(design.verdict.turns_fully for design in others)


def test_fewer_points_with_both_pivots_are_met_by_many_four_bars():
    """Each curve, drawn by cutting circles, passes the points in order from the given pivots; all are different."""
    points, pivots = np.array([0, 1 + 0.6j, 2 + 0.8j, 3 + 0.6j]), np.array([-3j, 4 - 2j])
    task = PathTask([(p.real, p.imag) for p in points], fixed_pivots=[(p.real, p.imag) for p in pivots])
    found = synthesise_path(task)
    assert found.count.theorem is None
    assert "(free parameters: 1)" in str(found.notes[0])
    assert len(found.designs) >= 6
    turn = np.exp(1j * np.linspace(-np.pi, np.pi, 40_001))
    shapes = []
    for design in found.designs:
        ends = np.array(pivots_of(design))
        assert np.abs(ends[[0, 3], None] - pivots).min(axis=1) == pytest.approx(0, abs=1e-9)
        a0, a, b, b0 = ends
        pins = a0 + (a - a0) * turn
        arm = (points[0] - a) / (b - a)
        gaps = []
        for far in cut_circles(pins, b0, abs(b - a), abs(b0 - b)):
            curve = pins + arm * (far - pins)
            chords = np.diff(curve)
            with np.errstate(invalid="ignore"):
                part = np.real((points[:, None] - curve[:-1]) / chords).clip(0, 1)
            away = np.abs(curve[:-1] + part * chords - points[:, None])
            gaps.append(np.nan_to_num(away, nan=9.0).min(axis=1).max())
        assert min(gaps) < 1e-3, gaps
        shapes.append(sorted(abs(x - y) for x, y in pairwise((*ends, a0))))
    assert all(np.abs(np.log(np.divide(one, other))).max() > 1e-3 for one, other in combinations(shapes, 2))


@settings(max_examples=6, deadline=None)
@given(st.floats(-3, 3), st.floats(0.01, 100), st.booleans())
def test_moved_points_have_moved_designs(angle, scale, mirror):
    points = np.array([0, 1 + 0.6j, 2 + 0.8j, 3 + 0.6j, 4 + 0.1j])
    pivots = np.array([-3j, 4 - 2j])
    assume(abs(angle) > 0.01)

    def image(z):
        return scale * np.exp(1j * angle) * (np.conj(z) if mirror else z) + (5 - 1j) * scale

    def solved(z, p):
        task = PathTask([(w.real, w.imag) for w in z], fixed_pivots=[(w.real, w.imag) for w in p])
        found = synthesise_path(task)
        cranks = [d.linkage.length("coupler", 1, 2) for d in (*found.designs, *found.rejected)]
        return np.sort(cranks), len(found.designs)

    plain, moved = solved(points, pivots), solved(image(points), image(pivots))
    assert moved[0] / scale == pytest.approx(plain[0], rel=1e-6)
    assert moved[1] == plain[1]


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        ([(k, 2 * k + 1) for k in range(9)], "9 of the points lie on one line"),
        ([(k, 0) for k in range(7)] + [(3, 1), (4, 2)], "7 of the points lie on one line"),
        ([(5 + np.cos(k), np.sin(k)) for k in range(9)], "9 of the points lie on one circle"),
    ],
)
def test_more_points_on_a_line_or_circle_than_a_coupler_curve_has(points, sentence):
    with pytest.raises(SynthesisError, match=sentence):
        synthesise_path(PathTask(points))


def test_five_points_on_a_line_are_no_special_task():
    found = synthesise_path(PathTask([(k + 0.1 * k * k, 0) for k in range(5)], fixed_pivots=[(0, -3), (4, -2)]))
    assert found.count.found > 0


def test_three_positions_with_crank_angles_give_their_crank_back():
    """A body position at a given crank angle: of a four-bar 1, 3, 2.5, 3.5 its own crank is the only one."""
    bar = FourBar(1, 3, 2.5, 3.5).linkage({"P": (1.2, 0.8)})
    phi = np.radians([10, 50, 100])
    motion = move(bar, phi)
    z, angles = motion.complex_point("P"), motion.angle("coupler")
    points = [(w.real, w.imag) for w in z]
    task = PathTask(points, angles=tuple(angles - angles[0]), crank_angles=tuple(phi))
    found = synthesise_path(task, Demands(crank=True))
    assert {design.form for design in found.designs} >= {"RR-RR", "RR-RP"}
    for design in found.designs:
        assert design.linkage.length("crank", 0, 1) == pytest.approx(1, rel=1e-9)
        again = move(design.linkage, np.array(design.drives))
        assert np.diff(design.drives) == pytest.approx(np.diff(phi), abs=1e-9)
        assert np.abs(again.complex_point("P") - z).max() < 1e-9
        assert again.angle("coupler") - again.angle("coupler")[0] == pytest.approx(angles - angles[0], abs=1e-9)


def test_each_four_bar_is_driven_where_it_does_best():
    """Five points and both pivots; the angles of both drives by circle intersections and the law of cosines.

    On the way through the points, driven at the first pivot or at the second: 53.374 or 13.789 degrees, 32.203 or
    80.475, 9.437 or 34.749, 23.515 or 34.154, all with cranks that turn fully, and 0.510 or 0.404.
    """
    task = PathTask([(0, 0), (1, 0.8), (2, 1.1), (3, 0.9), (4, 0.2)], fixed_pivots=[(0, -3), (4, -3)])
    angles = [np.degrees(design.verdict.transmission) for design in synthesise_path(task).designs]
    np.testing.assert_allclose(angles, [80.475, 53.374, 34.749, 34.154, 0.510], atol=2e-3)
