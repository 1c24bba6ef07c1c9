"""Curves under limits: region, given pivots and lengths, size ratio, transmission angle, a crank that turns."""

from itertools import combinations, pairwise
from math import cos, degrees, hypot, radians, sin

import numpy as np
import pytest

from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis import Demands, PathTask, synthesise_path
from gruebler.design.synthesis.curves import fit_curve, linkages_of
from gruebler.design.synthesis.fit_limits import FourBarLimits
from gruebler.design.synthesis.four_bar_curves import curve_points
from gruebler.design.synthesis.four_bar_kinds import FOUR_BAR, SLIDER_CRANK

ROWS = {
    FOUR_BAR: np.array([0.1, 0.2, 3.1, 0.4, 1, 3, 2.5, 1.2, 0.8]),
    SLIDER_CRANK: np.array([0.1, 0.2, 0.3, 0.4, 1, 3, 1.2, 0.8]),
}
REGION = (-2.0, -3.0, 2.0, -1.0)
ANGLES = np.linspace(0, 2 * np.pi, 60, endpoint=False)
TEARDROP = [(cos(t), sin(t) * sin(t / 2) ** 3) for t in ANGLES.tolist()]


def _paths(linkage):
    """Second method: both closed paths of P by intersecting circles (own few lines)."""
    pins = {key: complex(element.x, element.y) for key, element in linkage.elements.items()}
    length = {
        link: abs(pins[k, link] - pins[m, link])
        for link, (k, m) in zip(("crank", "coupler", "rocker", "frame"), ((0, 1), (1, 2), (2, 3), (0, 3)), strict=True)
    }
    own, far = pins[0, "frame"], pins[3, "frame"]
    point = linkage.points["P"]
    seen = (complex(point.x, point.y) - pins[1, "coupler"]) / (pins[2, "coupler"] - pins[1, "coupler"])
    turn = np.linspace(0, 2 * np.pi, 1440, endpoint=False)
    for side in (1, -1):
        pin = own + length["crank"] * np.exp(1j * turn)
        gap = far - pin
        along = (length["coupler"] ** 2 - length["rocker"] ** 2 + np.abs(gap) ** 2) / (2 * np.abs(gap))
        height = length["coupler"] ** 2 - along**2
        assert (height > 0).all()  # the crank turns fully
        other = pin + gap / np.abs(gap) * (along + 1j * side * np.sqrt(height))
        yield pin + seen * (other - pin)


def _ordered_miss(linkage, targets):
    """The largest miss of targets in order: they go to places that do not go back.

    The bottleneck of the best choice, by dynamic programming from several starting places of the closed path.
    """
    best = np.inf
    for path in _paths(linkage):
        for places in (path, path[::-1]):
            first = int(np.abs(places - targets[0]).argmin())
            for shift in range(-40, 41, 4):
                lap = np.abs(np.roll(places, -first - shift)[None, :] - targets[:, None])
                least = lap[0]
                for row in lap[1:]:
                    least = np.maximum(np.minimum.accumulate(least), row)
                best = min(best, least.min())
    return best


def test_a_region_is_kept_while_a_curve_is_fitted():
    """Another program (bounded least squares of scipy, 75 s) came to a largest miss of 2.87 %."""
    z = np.array([complex(*p) for p in TEARDROP])
    fits = fit_curve(z, closed=True, kinds=(FOUR_BAR,), starts=240, demands=Demands(region=REGION), power=8)
    linkage = linkages_of(fits[0])[0]
    frame = [e for (_, link), e in linkage.elements.items() if link == "frame"]
    assert all(REGION[0] <= e.x <= REGION[2] and REGION[1] <= e.y <= REGION[3] for e in frame)
    assert _ordered_miss(linkage, z) / 2 <= 0.0287


@pytest.mark.slow
def test_designs_for_a_region_are_judged_as_another_method_does():
    """The best four-bar goes beyond the tip between two targets: another program saw the targets only."""
    found = synthesise_path(PathTask(TEARDROP, closed=True), Demands(region=REGION))
    best = next(design for design in found.rejected if design.form == "four-bar")
    assert best.verdict.turns_fully
    z = np.array([complex(*p) for p in TEARDROP])
    miss = _ordered_miss(best.linkage, z)
    assert miss / 2 == pytest.approx(best.verdict.error, rel=0.02)
    assert best.verdict.error <= 0.0287
    dense = np.concatenate([a + (b - a) * np.linspace(0, 1, 20) for a, b in pairwise([*z, z[0]])])
    beyond = min(np.abs(path[:, None] - dense).min(axis=1).max() for path in _paths(best.linkage))
    assert beyond / 2 == pytest.approx(best.verdict.between, rel=0.02)
    assert all(design.verdict.between < 0.05 for design in found.designs)
    shapes = [sorted(_bars(design.linkage)) for design in found.designs if design.form == "slider-crank"]
    assert len(shapes) > 1
    for first, second in combinations(shapes, 2):  # the same slide, its direction reversed, was another design
        assert max(abs(a / b - 1) for a, b in zip(first, second, strict=True)) > 5e-3


def _bars(linkage):
    """The distances of the pins of crank and coupler."""
    pins = {key: complex(element.x, element.y) for key, element in linkage.elements.items() if element.is_pin}
    return [abs(pins[0, "crank"] - pins[1, "crank"]), abs(pins[1, "coupler"] - pins[2, "coupler"])]


@pytest.mark.parametrize(("count", "starts", "part"), [(1, 40, 1.0), (2, 2, 1.0), (2, 2, 0.4)])
def test_a_curve_comes_back_from_its_own_pivots(count, starts, part):
    """All of it or a piece; with both pivots the two best starts are enough."""
    z = curve_points(FOUR_BAR, ROWS[FOUR_BAR][:, None], part * ANGLES, 1).z
    pivots = (3.1 + 0.4j, 0.1 + 0.2j)[:count]
    best = fit_curve(z, closed=part == 1, pivots=pivots, kinds=(FOUR_BAR,), starts=starts)[0]
    assert best.error < 1e-6
    r = dict(zip(FOUR_BAR.unknowns, best.row.tolist(), strict=True))
    given = [(3.1, 0.4), (0.1, 0.2)][:count]
    own = [(r["a0x"], r["a0y"]), (r["b0x"], r["b0y"])]
    assert all(min(hypot(x - p, y - q) for p, q in own) < 1e-12 for x, y in given)


def test_given_lengths_size_ratio_and_transmission_angle_are_kept():
    wanted = Demands(lengths={"crank": 0.7, "frame": 2.0}, transmission=radians(35), size_ratio=3)
    z = np.array([complex(*p) for p in TEARDROP])
    best = linkages_of(fit_curve(z, closed=True, kinds=(FOUR_BAR,), starts=40, demands=wanted)[0], named=True)[0]
    lengths = [best.length(*row) for row in (("crank", 0, 1), ("coupler", 1, 2), ("rocker", 2, 3), ("frame", 0, 3))]
    assert lengths[0] == pytest.approx(0.7, rel=1e-9)
    assert lengths[3] == pytest.approx(2.0, rel=1e-9)
    assert max(lengths) <= 3 * min(lengths)
    a, b, c, d = lengths  # by the closed form: where crank and frame are in line
    assert all(35 <= degrees(np.arccos((b * b + c * c - f * f) / (2 * b * c))) <= 145 for f in (d - a, d + a))
    assert _ordered_miss(best, z) / 2 < 0.05


@pytest.mark.slow
def test_points_with_both_pivots_and_with_one():
    """More than five with both are approached, of fewer than seven with one some of infinitely many are exact."""
    points = [(0, 0), (1, 0.6), (2, 0.8), (3, 0.6), (4, 0.1), (4, -0.5), (3, -1)]
    z, pivots = np.array([complex(*p) for p in points]), (-3j, 3 - 3j)
    fits = fit_curve(z, closed=False, pivots=pivots, starts=40, power=8)
    assert {(round(f.row[0], 9), round(f.row[2], 9)) for f in fits} <= {(0, 3), (3, 0)}
    assert min(fit.error for fit in fits) < 0.02
    exact = fit_curve(z[:5], closed=False, pivots=pivots[:1], starts=40)
    assert all(fit.error < 1e-9 for fit in exact)


@pytest.mark.slow
def test_three_points_and_a_pivot_have_judged_designs():
    points = [(0, 0), (1, 0.6), (2, 0.8)]
    found = synthesise_path(PathTask(points, fixed_pivots=[(0, -3)]), number=1)
    assert found.designs[0].verdict.error < 1e-9
    assert "free parameters: 4" in str(found.notes[0])


@pytest.mark.parametrize("kind", ROWS, ids=lambda kind: kind.name)
def test_slopes_of_limits_against_differences(kind):
    rows = ROWS[kind][:, None] + np.random.default_rng(7).uniform(-0.4, 0.4, (len(ROWS[kind]), 200))
    phi = np.linspace(0, 2, 5) + np.zeros((200, 1))
    frame = {"frame": 3.0, "frame_direction": 0.3} if kind is FOUR_BAR else {}
    for turning in (True, False):
        limits = FourBarLimits(kind=kind, turning=turning, region=REGION, size_ratio=2, transmission=0.6, **frame)
        slope = limits.linearised(rows, phi)[1]
        for k in range(len(rows)):
            step = np.zeros((len(rows), 1))
            step[k] = 1e-7
            ends = [limits.values(rows + s * step, phi) for s in (1, -1)]
            assert slope[:, k] == pytest.approx((ends[0] - ends[1]) / 2e-7, abs=1e-5)


def test_lengths_that_no_link_can_have_are_refused():
    for wrong in ({"crank": 0.0}, {"crank": "long"}, (("crank", 1.0), ("crank", 2.0)), ("crank",), 3, "crank"):
        with pytest.raises(SynthesisError, match="lengths"):
            Demands(lengths=wrong)
    with pytest.raises(SynthesisError, match="one or two"):
        PathTask([(0, 0), (1, 1), (2, 0)], fixed_pivots=[(0, 1), (1, 2), (3, 3)])
