"""The ordered distance of a curve from targets: against exhaustive search, its laws, and verdicts on whole curves."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler.design.synthesis import Demands, PathTask, synthesise_path
from gruebler.design.synthesis.curves import Fit, linkages_of
from gruebler.design.synthesis.four_bar_kinds import FOUR_BAR
from gruebler.design.synthesis.judging import judge_design
from gruebler.design.synthesis.ordered_matching import SmoothCurve, TargetDistances
from gruebler.design.synthesis.ordered_places import Places
from gruebler.design.synthesis.targets import Probe, Targets, point_targets
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics import circuit, move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

# --- other methods ---------------------------------------------------------------------------------------


def least_in_order(distances, *, closed):
    """The bottleneck distance over samples: of all rising or falling choices the one with the least largest entry.

    Args:
        distances: (targets, samples) of the samples of a curve, a closed one without its first sample again.
        closed: then from every first sample once around.
    """
    least, count = np.inf, distances.shape[1]
    for rows in (distances, distances[::-1]):
        if not closed:
            reached = np.zeros(count)
            for row in rows:
                reached = np.maximum(np.minimum.accumulate(reached), row)
            least = min(least, reached.min())
            continue
        for start in np.argsort(rows[0]):
            if rows[0, start] >= least:
                break
            around = np.roll(rows, -start, axis=1)
            around = np.concatenate([around, around[:, :1]], axis=1)
            reached = np.full(count + 1, around[0, 0])
            for row in around[1:]:
                reached = np.maximum(np.minimum.accumulate(reached), row)
            least = min(least, reached.min())
    return least


def least_of_all_choices(distances, *, closed):
    """The same by looking at every choice there is, rising or falling."""
    count = distances.shape[1]
    least = np.inf
    for rows in (distances, distances[::-1]):
        for start in range(count) if closed else (0,):
            around = np.roll(rows, -start, axis=1)
            if closed:
                around = np.concatenate([around, around[:, :1]], axis=1)
            index = np.indices((around.shape[1],) * len(rows)).reshape(len(rows), -1)
            if closed:
                index = index[:, index[0] == 0]
            index = index[:, (np.diff(index, axis=0) >= 0).all(axis=0)]
            least = min(least, np.max([row[at] for row, at in zip(around, index, strict=True)], axis=0).min())
    return least


class Wave:
    """A sum of turning vectors, on a whole turn; closed if all turn a whole number of times."""

    def __init__(self, seed, *, closed, samples=120):
        rng = np.random.default_rng(seed)
        self.closed = closed
        self.turns = np.array([1, -1, 2, -2, 3]) if closed else np.array([0.5, -0.7, 1.3, -1.6, 0.2])
        self.arms = (rng.normal(size=5) + 1j * rng.normal(size=5)) / (1 + np.abs(self.turns))
        self.samples = np.linspace(0, 2 * np.pi, samples)
        self.rng = rng

    def __call__(self, at, order=0):
        return np.exp(1j * np.multiply.outer(at, self.turns)) @ (self.arms * (1j * self.turns) ** order)

    def curve(self):
        return SmoothCurve(self.samples, self(self.samples)[:, None], self(self.samples, 1)[:, None], self.closed)

    def distance(self, targets):
        return TargetDistances(self.curve(), np.asarray(targets)[:, None], 1.0).best_in_order()

    @property
    def fastest(self):
        return np.abs(self(np.linspace(0, 2 * np.pi, 2000), 1)).max()

    @property
    def rounding(self):
        """How far the cubic pieces are from the curve, at most: h^4 / 384 of the fourth derivative."""
        h = self.samples[1]
        return h**4 / 384 * np.abs(self(np.linspace(0, 2 * np.pi, 2000), 4)).max() * 1.01


def test_both_other_methods_agree():
    rng = np.random.default_rng(1)
    for closed in (True, False):
        for count in (1, 2, 3):
            distances = rng.uniform(size=(count, 8))
            assert least_in_order(distances, closed=closed) == least_of_all_choices(distances, closed=closed)


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("seed", range(20))
def test_the_ordered_distance_against_the_best_choice_of_dense_samples(seed, closed):
    """The samples' is never less, and more by half a step at most; targets near the curve in order, or anywhere."""
    wave = Wave(seed, closed=closed)
    rng, count = wave.rng, 2 + seed % 7
    places = rng.uniform(0, 2 * np.pi, count)
    targets = wave(np.sort(places) if seed % 3 else places) + 0.25 * (
        rng.normal(size=count) + 1j * rng.normal(size=count)
    )
    match = wave.distance(targets)
    dense = np.linspace(0, 2 * np.pi, 1200, endpoint=not closed)
    other = least_in_order(np.abs(wave(dense) - targets[:, None]), closed=closed)
    assert -wave.rounding <= other - match.error <= wave.rounding + wave.fastest * (dense[1] - dense[0]) / 2
    steps = np.diff(match.arcs)
    assert (steps >= 0).all() or (steps <= 0).all()
    assert match.span <= (2 * np.pi if closed else dense[-1]) * (1 + 1e-9)
    assert np.abs(wave(match.arcs) - targets).max() == pytest.approx(match.error, abs=2 * wave.rounding)


# --- laws -------------------------------------------------------------------------------------------------

seeds, counts = st.integers(0, 10**6), st.integers(2, 12)


def near(seed, count, *, closed, noise):
    """A curve and targets near it, in order along it."""
    wave = Wave(seed, closed=closed)
    places = np.sort(wave.rng.uniform(0, 2 * np.pi, count))
    shift = noise * np.exp(2j * np.pi * wave.rng.uniform(size=count))
    return wave, places, wave(places) + shift


@settings(max_examples=15, deadline=None)
@given(seeds, counts, st.booleans(), st.floats(0, 1))
def test_noise_of_a_size_gives_at_most_that_size(seed, count, closed, noise):
    """And points on the curve itself give nothing."""
    wave, _, targets = near(seed, count, closed=closed, noise=noise)
    assert wave.distance(targets).error <= noise + wave.rounding + 1e-9


@settings(max_examples=15, deadline=None)
@given(seeds, counts, st.booleans(), st.integers(0, 11))
def test_it_does_not_depend_on_the_sense_or_on_the_first_target_of_a_closed_curve(seed, count, closed, first):
    wave, _, targets = near(seed, count, closed=closed, noise=0.4)
    plain = wave.distance(targets).error
    assert wave.distance(targets[::-1]).error == pytest.approx(plain, abs=3e-10)
    if closed:
        targets = np.roll(targets, first)
    assert wave.distance(targets).error == pytest.approx(plain, abs=3e-10)


@settings(max_examples=15, deadline=None)
@given(seeds, counts, st.booleans(), st.floats(-3, 3), st.floats(0.01, 100), st.booleans())
def test_moved_and_scaled_together_it_is_scaled(seed, count, closed, angle, scale, mirror):
    wave, _, targets = near(seed, count, closed=closed, noise=0.4)
    plain, curve = wave.distance(targets).error, wave.curve()

    def image(z, shift=0.0):
        return scale * np.exp(1j * angle) * ((np.conj(z) if mirror else z) + shift)

    moved = SmoothCurve(curve.arcs, image(curve.values, 5 - 2j), image(curve.rates), closed)
    match = TargetDistances(moved, image(targets, 5 - 2j)[:, None], scale).best_in_order()
    assert match.error == pytest.approx(scale * plain, abs=1e-9 * scale)


@settings(max_examples=15, deadline=None)
@given(seeds, counts, st.booleans(), st.integers(0, 12), st.complex_numbers(max_magnitude=2))
def test_another_target_never_lowers_it(seed, count, closed, place, target):
    wave, _, targets = near(seed, count, closed=closed, noise=0.4)
    more = np.insert(targets, min(place, count), target)
    assert wave.distance(more).error >= wave.distance(targets).error - 3e-10


@settings(max_examples=15, deadline=None)
@given(seeds, counts, st.booleans(), st.integers(1, 119))
def test_it_does_not_depend_on_where_a_closed_curve_begins(seed, count, mirror, begin):
    wave, _, targets = near(seed, count, closed=True, noise=0.4)
    curve = wave.curve()

    def turned(column):
        return np.concatenate([column[begin:-1], column[: begin + 1]])

    arcs = np.concatenate(
        [curve.arcs[begin:-1] - curve.arcs[begin], curve.length - curve.arcs[begin] + curve.arcs[: begin + 1]]
    )
    moved = SmoothCurve(arcs, turned(curve.values), turned(curve.rates), True)
    if mirror:
        moved = SmoothCurve(curve.length - arcs[::-1], moved.values[::-1], -moved.rates[::-1], True)
    match = TargetDistances(moved, targets[:, None], 1.0).best_in_order()
    assert match.error == pytest.approx(wave.distance(targets).error, abs=1e-8)


def test_a_target_at_the_same_distance_from_the_whole_curve():
    """The centre of a circle: its distance neither falls nor rises."""
    at = np.linspace(0, 2 * np.pi, 100)
    circle = SmoothCurve(at, np.exp(1j * at)[:, None], 1j * np.exp(1j * at)[:, None], True)
    targets = np.array([1, 0, 1j, 0, -1.1, -1j])
    match = TargetDistances(circle, targets[:, None], 1.0).best_in_order()
    assert match.error == pytest.approx(1, abs=1e-6)
    apart = TargetDistances(circle, np.array([[1.1], [1.2j], [-1.3]]), 1.0).best_in_order()
    assert apart.error == pytest.approx(0.3, abs=1e-6)
    assert apart.arcs == pytest.approx([0, np.pi / 2, np.pi], abs=1e-6)


def test_a_free_part_of_a_target_counts_nothing():
    at = np.linspace(0, 1, 11)
    line = SmoothCurve(at, np.stack([at, 0 * at], axis=1) + 0j, np.tile([1.0 + 0j, 0], (11, 1)), False)
    targets = np.array([[0.2, 3.0], [0.6, np.nan]])
    match = TargetDistances(line, targets + 0j, 1.0).best_in_order()
    assert (match.error, match.arcs[0]) == pytest.approx((3, 0.2))
    assert match.arcs[1] == pytest.approx(0.6)


@pytest.mark.parametrize(
    ("order", "ways"),
    [([0, 1, 2, 3], 1), ([2, 3, 0, 1], 1), ([3, 2, 1, 0], 1), ([0, 2, 1, 3], 0), ([0, 2, 3, 1], 0)],
)
def test_places_in_order_lie_within_one_lap(order, ways):
    """Four places around a closed curve: two laps would lead through them in any order."""
    places = Places.of_points([[0.1 + 0.25 * k] for k in order], 1.0, closed=True)
    assert len(list(places.matches(None))) == ways


def test_from_several_places_of_a_target_the_shortest_way_is_among_those_found():
    places = Places.of_points([[0.1, 0.55], [0.6], [0.7]], 1.0, closed=True)
    spans = sorted(abs(arcs[-1] - arcs[0]) for arcs in places.matches(None))
    assert spans == pytest.approx([0.15, 0.6])


# --- verdicts ---------------------------------------------------------------------------------------------


def evenly(z, count):
    """Places evenly along the closed polygon through points."""
    z = np.append(z, z[0])
    arcs = np.concatenate([[0], np.cumsum(np.abs(np.diff(z)))])
    at = np.linspace(0, arcs[-1], count, endpoint=False)
    return np.interp(at, arcs, z.real) + 1j * np.interp(at, arcs, z.imag)


def beyond(p, q, from_p, from_q, side):
    """The corner of a triangle over p and q with these sides, left (1) or right (-1) of the way from p to q."""
    gap = q - p
    along = (from_p**2 - from_q**2 + abs(gap) ** 2) / (2 * abs(gap))
    return p + gap / abs(gap) * (along + side * 1j * np.sqrt(from_p**2 - along**2))


def coupler_path(row, branch, count=4000):
    """The coupler path of a four-bar of `curves.Fit`, by intersecting circles."""
    ax, ay, bx, by, a, b, c, u, v = row
    pin = ax + 1j * ay + a * np.exp(1j * np.linspace(0, 2 * np.pi, count, endpoint=False))
    far = beyond(pin, bx + 1j * by, b, c, branch)
    return pin + (far - pin) / b * (u + 1j * v)


def noisy_crank_rocker():
    """300 places of a crank-rocker's coupler curve, each shifted by about 0.5 % of the size."""
    crank = np.exp(1j * np.linspace(0, 2 * np.pi, 3000, endpoint=False))
    path = crank + (0.7 + 0.5j) * (beyond(crank, 3 + 0j, 2.8, 2.2, 1) - crank)
    rng = np.random.default_rng(3)
    return evenly(path, 300) + 0.005 * np.ptp(path.real) * (rng.normal(size=300) + 1j * rng.normal(size=300))


def jansen_foot():
    """60 places of the foot of a leg with Jansen's lengths but for three: m 12, k 58, b 44; 54.7 by 2.8."""
    a, b, c, d, e, f, g, h, i, j, k, l, m = 38, 44, 39.3, 40.1, 55.8, 39.4, 36.7, 65.7, 49, 50, 58, 7.8, 12  # noqa: E741
    crank = m * np.exp(1j * np.linspace(0, 2 * np.pi, 3000, endpoint=False))
    pivot = np.full(3000, -a - 1j * l)
    upper, lower = beyond(crank, pivot, j, b, -1), beyond(crank, pivot, k, c, 1)
    corner = beyond(beyond(upper, pivot, e, d, -1), lower, f, g, -1)
    return evenly(beyond(corner, lower, h, i, -1), 60)


def klann_foot():
    """60 places of the foot of Klann's leg, with the places of the joints in the example of Linkage by D. Rector."""
    pivot, pin = 471.970983 - 296.009544j, 470.517568 - 332.484023j
    low_pivot, low = 374.33583 - 342.08981j, 376.117415 - 281.360534j
    high_pivot, high = 384.18812 - 263.389741j, 389.964056 - 172.445336j
    knee, foot = 313.573392 - 224.432992j, 158.277169 - 418.544812j
    crank = pivot + (pin - pivot) * np.exp(1j * np.linspace(0, 2 * np.pi, 3000, endpoint=False))
    corner = beyond(crank, low_pivot, abs(low - pin), abs(low - low_pivot), -1)
    knees = crank + (corner - crank) * (knee - pin) / (low - pin)
    highs = beyond(knees, high_pivot, abs(high - knee), abs(high - high_pivot), 1)
    return evenly(knees + (highs - knees) * (foot - knee) / (high - knee), 60) * 25.4 / 96


def extent(z):
    return max(np.ptp(z.real), np.ptp(z.imag))


ON_CURVES = {
    "noisy": (noisy_crank_rocker, (0, 0, 3, 0, 1, 2.8, 2.2, 1.96, 1.4), 1, 0.2),
    "jansen": (
        jansen_foot,
        (
            -76.13593915,
            -247.5205243,
            -58.32366465,
            -254.8551262,
            15.96635258,
            17.42252549,
            20.7193871,
            43.2683747,
            147.6195714,
        ),
        1,
        0.272,
    ),
    "klann": (
        klann_foot,
        (182.278, -27.2576, 57.5452, 181.6103, 16.13962, 141.55647, 117.95059, 20.75011, 162.83283),
        1,
        0.305,
    ),
}
"""Targets, the lengths of a four-bar whose curve comes near, its branch and a crank angle."""


@pytest.mark.parametrize("name", ON_CURVES)
def test_whole_curves_are_judged_by_the_ordered_distance(name):
    """Points closer together than the misfit are nearest to the curve in another order, though places in order are as
    near. Expected: the best choice of 4000 samples of the path by intersecting circles; it is more by half a step at
    most. Of the noisy curve the true one is judged, of both feet a four-bar fitted to it.
    """
    make, row, branch, crank = ON_CURVES[name]
    z = make()
    path = coupler_path(row, branch)
    expected = least_in_order(np.abs(path - z[:, None]), closed=True) / extent(z)
    step = np.abs(np.diff(path)).max() / extent(z)
    linkage = linkages_of(Fit(kind=FOUR_BAR, row=np.array(row), side=branch, phi=np.array([crank]), error=0.0))[0]
    verdict = judge_design(linkage, point_targets("P", z, extent(z)), Demands(tolerance=0.05), "four-bar").verdict
    assert verdict.accepted
    assert verdict.in_order
    assert -1e-6 <= expected - verdict.error <= step / 2
    assert expected < 0.02


@pytest.mark.slow
@pytest.mark.parametrize(("name", "error"), [("noisy", 0.0145), ("jansen", 0.0025), ("klann", 0.02)])
def test_whole_curves_have_accepted_designs(name, error):
    z = ON_CURVES[name][0]()
    found = synthesise_path(PathTask([(w.real, w.imag) for w in z], closed=True))
    assert len(found.designs) == 6
    assert found.designs[0].verdict.error < error
    for design in found.designs[:3]:
        path = move(design.linkage, np.linspace(0, 2 * np.pi, 3001)[:-1] + design.drives[0]).complex_point("P")
        expected = least_in_order(np.abs(path - z[:, None]), closed=True) / extent(z)
        assert -1e-6 <= expected - design.verdict.error <= np.abs(np.diff(path)).max() / extent(z) / 2


KNOWN = FourBar(1, 2.8, 2.2, 3).linkage({"P": (1.96, 1.4)})


def verdict_of(z, tolerance, linkage=KNOWN, **demands):
    """Of a linkage in a position on its way, on points."""
    held = linkage.with_reference_pose(move(linkage, [0.2]).pose(0))
    targets = Targets((Probe("P"),), np.asarray(z)[:, None], 3.0)
    return judge_design(held, targets, Demands(tolerance=tolerance, **demands), "four-bar").verdict


@pytest.mark.parametrize("tolerance", [1e-9, 0.01])
def test_four_points_of_a_curve_that_two_laps_would_lead_through(tolerance):
    """In the order of the crank angles 10, 190, 100, 280 degrees they are not met within one lap."""
    z = move(KNOWN, np.radians([10, 100, 190, 280])).complex_point("P")
    assert verdict_of(z, tolerance).accepted
    for order in ([0, 2, 1, 3], [1, 0, 2, 3]):
        verdict = verdict_of(z[order], tolerance)
        assert not verdict.in_order
        assert "the targets are met in another order" in str(verdict.reasons[0])
    assert verdict_of(z[[0, 2, 1, 3]], tolerance, in_order=False).accepted


def test_the_miss_in_order_is_told():
    """Two targets exchanged that lie 5 degrees of the crank apart: in order both share a place between them."""
    path = move(KNOWN, np.radians(np.arange(0, 360, 0.05))).complex_point("P")
    z = path[[0, 1000, 2100, 2000, 3000, 4000, 5000, 6000, 7000]]
    verdict = verdict_of(z, 0.005)
    expected = least_in_order(np.abs(path - z[:, None]), closed=True) / 3
    assert expected == pytest.approx(abs(z[2] - z[3]) / 2 / 3, rel=1e-2)
    (reason,) = map(str, verdict.reasons)
    assert (
        reason
        == f"the targets are met in another order; in that of the task one is missed by {verdict.error:.3g} of the size"
    )
    assert -1e-6 <= expected - verdict.error <= np.abs(np.diff(path)).max() / 3 / 2


def test_a_target_beyond_a_limit_of_the_drive_is_approached_on_the_branch():
    """The crank turns back at 121.86 degrees, where a way on one branch ends: its last place is there."""
    rocker = FourBar(30, 30, 50, 60).linkage({"P": (20, 15)})
    way = circuit(rocker, at=0.2)
    limit = next(extreme for extreme in way.drive_limits if extreme.value > 0)
    sense = 1.0 if way.at([limit.at - 0.1]).drive(1)[0] > 0 else -1.0
    arcs = limit.at + sense * np.array([-0.8, -0.6, -0.4, -0.2, 0.05])
    z = way.at(arcs).complex_point("P")
    end = way.at([limit.at]).complex_point("P")[0]
    targets = Targets((Probe("P"),), z[:, None], 30.0)
    held = rocker.with_reference_pose(way.at(arcs[:1]).pose(0))
    exact = judge_design(held, targets, Demands(), "four-bar").verdict
    assert (exact.in_order, exact.one_branch) == (True, False)
    verdict = judge_design(held, targets, Demands(tolerance=0.1), "four-bar").verdict
    assert verdict.accepted
    assert verdict.one_branch
    assert verdict.error == pytest.approx(abs(z[-1] - end) / 30, rel=1e-3)
    assert 0.01 < verdict.error < 0.1


@pytest.mark.parametrize("tolerance", [1e-9, 0.01])
def test_targets_on_another_branch_than_the_first_position(tolerance):
    """The crank turns back between: the design begins at its first target, from where the drive leads to the last."""
    rocker = FourBar(30, 30, 50, 60).linkage({"P": (20, 15)})
    drives = np.array([0.2, 0.5, 0.8, 1.1])
    other = move(rocker, drives, branch="-").complex_point("P")
    assert np.abs(other - move(rocker, drives).complex_point("P")).min() > 10
    held = rocker.with_reference_pose(move(rocker, [0.2]).pose(0))
    design = judge_design(held, point_targets("P", other, 30.0), Demands(tolerance=tolerance), "four-bar")
    assert design.verdict.accepted
    assert design.drives == pytest.approx(drives, abs=1e-8)
    assert move(design.linkage, design.drives).complex_point("P") == pytest.approx(other, abs=1e-8)


def test_a_drive_that_gains_a_turn_but_backs_up_on_the_way_does_not_turn_fully():
    """A rocker on a coupler: its angle, by intersecting circles, gains a turn and falls meanwhile."""
    turn = np.linspace(0, 2 * np.pi, 2001)
    crank = np.exp(1j * turn)
    rocker = beyond(crank, 3 + 0j, 2.8, 2.2, 1)
    path, pivot = crank + (1.2 + 0.3j) * (rocker - crank), 1.83 + 2.88j
    pin = beyond(np.full(2001, pivot), path, 0.79, 0.79, 1)
    angle = np.unwrap(np.angle(pin - pivot))
    assert angle[-1] - angle[0] == pytest.approx(-2 * np.pi)
    assert np.diff(angle).max() > 1e-4  # it falls by a turn on the whole, and rises in between

    def place(z):
        return z.real, z.imag

    def verdict(drive):
        six_bar = Mechanism.parse(f"R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-0); frame=0; drive={drive}")
        joints = (0, crank[0], rocker[0], 3 + 0j, path[0], pin[0], pivot)
        places = {k: place(complex(z)) for k, z in enumerate(joints)}
        drawn = Linkage.from_drawing(six_bar, places, points={"P": ("4", *place(path[0]))})
        assert circuit(drawn).closed
        return judge_design(drawn, point_targets("P", path[[0, 10]], 3.0), Demands(crank=True), "six-bar").verdict

    assert verdict("R(0-1)").accepted
    refused = verdict("R(5-0)")
    assert refused.one_circuit
    assert not refused.turns_fully
    assert [str(reason) for reason in refused.reasons] == ["the drive does not turn fully"]
