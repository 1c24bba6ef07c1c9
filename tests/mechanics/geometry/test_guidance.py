"""Straight-line linkages by name: what is exact, length and band, order of contact, sizes."""

import math
from bisect import bisect_left
from functools import partial

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank
from gruebler.mechanics.geometry import coupler_path, longest_piece, path_piece, piece_of_ratio
from gruebler.mechanics.geometry.contact import tangent_contact
from gruebler.mechanics.geometry.guidance import GUIDANCES, guidance
from gruebler.mechanics.geometry.sizing import Window, longest_in_band, ratio_curve, scale_for, widest_piece
from gruebler.mechanics.kinematics import move

KAPPA = math.radians(15.79316904826399)
LENKER = coupler_path(FourBar(1, 75**0.5 / 2, 75**0.5 / 2, 4), 8.018753738744802, 2.268046058132576)
WHOLE = Window(0, math.pi, 2 * math.pi, KAPPA)
LEVER = coupler_path(FourBar(20, 50, 50, 40), 100, 0)

# Q_G, window in degrees, L/l1 of the sheet 001.
QG_TABLE = [
    (1e-06, 29.41365915, 0.834615432),
    (1e-05, 46.656141647, 1.314814296),
    (0.0001, 74.089500889, 2.050372978),
    (0.0005, 102.488237713, 2.753253004),
    (0.001, 117.905805725, 3.099352087),
    (0.002, 135.669166983, 3.457838562),
    (0.003, 147.28144515, 3.664443871),
    (0.004, 156.115155231, 3.804739226),
    (0.005, 163.32477378, 3.907352348),
    (0.006, 169.455607921, 3.985561965),
    (0.008, 179.581961783, 4.095101238),
    (0.01, 187.827377087, 4.164803775),
]

# exact, number of links, points of contact
KINDS = {
    "watt": (False, 4, 5),
    "evans": (False, 4, 5),
    "chebyshev": (False, 4, 2),
    "roberts": (False, 4, 2),
    "lambda": (False, 4, 2),
    "scott-russell": (True, 4, None),
    "conchoid": (False, 4, 3),
    "peaucellier": (True, 8, None),
    "hart": (True, 6, None),
    "meyer-zur-capellen": (False, 4, 6),
    "isosceles": (False, 4, 6),
}


@pytest.mark.parametrize("key", KINDS)
def test_exact_or_approximate(key):
    one = guidance(key)
    exact, links, points = KINDS[key]
    assert one.is_exact is exact
    assert one.linkage.mechanism.chain.n == links
    assert (one.contact.points if one.contact else None) == points
    assert one.piece.length > 1
    assert one.piece.band < 0.05 * one.piece.length


@pytest.mark.parametrize("key", [key for key, (exact, _, _) in KINDS.items() if not exact])
def test_order_of_contact_rivals(key):
    """By power series of the closed form, and by those of all closing conditions."""
    one = guidance(key)
    motion = move(one.linkage, one.window.centre, speed=1)
    rival = tangent_contact(motion, "K")
    assert rival.points == one.contact.points
    assert math.isclose(abs(rival.coefficient), abs(one.contact.coefficient), rel_tol=1e-7)


def test_every_row_is_looked_at():
    assert {one.key for one in GUIDANCES} == set(KINDS)


def test_watt():
    """E18: rockers 60, coupler 30, Fx = 30 t^5 with Fy = 60 t, so Fx = 30 (Fy/60)^5."""
    watt = guidance("watt")
    assert math.isclose(abs(watt.contact.coefficient), 1 / 2**5, rel_tol=1e-12)
    z = watt.path(np.radians([-20.0, -10.0, 10.0, 20.0])) * 30
    assert np.allclose(np.abs(z.imag), (20.113523, 10.391461, 10.446915, 21.010924), atol=5e-7)
    assert np.allclose(np.abs(z.real), (0.145064, 0.004823, 0.004955, 0.183090), atol=5e-7)


def test_chebyshev_and_his_lambda_are_cognates():
    """4 : 5 : 5 : 2 and 1 : 2.5 : 2.5 : 2 in the same size: one curve, 4 long in half a turn."""
    first, second = guidance("chebyshev"), guidance("lambda")
    for one in (first, second):
        assert math.isclose(one.piece.length, 4, rel_tol=1e-9)
        assert math.isclose(one.piece.band, 0.195075 / 20, rel_tol=1e-5)
        assert math.isclose(abs(one.contact.coefficient), 1 / 64, rel_tol=1e-10)
    x = first.path(np.linspace(first.window.start, first.window.end, 5))
    assert np.allclose(x[[0, -1]], (4 + 4j, 4j))  # on the line again at both ends
    assert np.isclose(first.path(np.array([first.window.centre]))[0], 2 + 4j)


def test_roberts():
    """Legs 1.2: band 0.01 for x from 0.4846 to 1.5157, and nearly through the pivots."""
    roberts = guidance("roberts")
    z = roberts.path(np.linspace(roberts.window.start, roberts.window.end, 4001))
    within = z[(z.imag > -0.009999104592637642) & (np.abs(z.real - 1) < 0.8)]
    assert abs(within.real.min() - 0.48461644056144065) < 1e-3
    assert abs(within.real.max() - 1.515739032905362) < 1e-3
    assert np.abs(z).min() < 0.0006673601455245322  # the figure is that of samples
    assert roberts.contact.points == 2


def test_inversors_over_their_windows():
    for key in ("peaucellier", "hart", "scott-russell"):
        one = guidance(key)
        z = one.path(np.linspace(one.window.start, one.window.end, 101))
        assert np.ptp(z.real) < 1e-13
        assert np.ptp(z.imag) > 2


def test_meyer_zur_capellen_and_its_replacement_draw_one_curve():
    rocker, crank = guidance("meyer-zur-capellen"), guidance("isosceles")
    assert math.isclose(abs(rocker.contact.coefficient), 1.55006772785498e-4, rel_tol=1e-9)
    assert math.isclose(abs(crank.contact.coefficient), 1.55006772785498e-4, rel_tol=1e-9)


def test_the_sizing_of_the_sheet():
    """L = 15 cm within 0.75 mm: Q_G = 0.005, phi_G = 163.3248, phi_A = 98.3376, L/l1 = 3.907352, l1 = 3.8389 cm."""
    found = scale_for(LENKER, WHOLE, 15, 0.075)
    assert abs(math.degrees(found.piece.end - found.piece.start) - 163.32477378) < 2e-7
    assert abs(math.degrees(found.piece.start) - 98.33761311) < 1e-7
    assert abs(found.piece.length - 3.907352348) < 5e-9
    assert abs(found.factor - 3.838916653) < 5e-9
    assert abs(guidance("isosceles").sized(150, 0.75).factor - 38.38916653) < 5e-8


@pytest.mark.parametrize(("ratio", "window", "length"), QG_TABLE)
def test_the_widest_piece_is_the_first_where_there_is_only_one(ratio, window, length):
    found = widest_piece(LENKER, WHOLE, ratio)
    rival = piece_of_ratio(LENKER, math.pi, ratio)
    assert abs(math.degrees(found.end - found.start) - window) < 2e-7
    assert abs(found.length - length) < 5e-9
    assert math.isclose(found.start, rival.start, abs_tol=1e-9)


def test_other_readings_of_the_deviation():
    """Twice the band, or half of it, give windows that the sheet does not have."""
    for ratio, window in ((0.0025, 141.94), (0.01, 187.83)):
        found = widest_piece(LENKER, WHOLE, ratio)
        assert abs(math.degrees(found.end - found.start) - window) < 0.005


def test_the_widest_piece_lies_beyond_the_first():
    """Near its middle the lambda linkage bends more than over half a turn."""
    window = Window(0, math.pi, 2 * math.pi, 0.0)
    found, first = widest_piece(LEVER, window, 0.003), piece_of_ratio(LEVER, math.pi, 0.003, 0.0)
    assert found.length > 2 * first.length
    assert math.isclose(found.ratio, 0.003, rel_tol=1e-6)
    assert math.isclose(first.ratio, 0.003, rel_tol=1e-6)


def test_the_curve_of_the_sheet():
    curve = ratio_curve(LENKER, WHOLE)
    rows = {
        0.001: (117.905805725, 3.099352087),
        0.005: (163.32477378, 3.907352348),
        0.0001: (74.089500889, 2.050372978),
    }
    for ratio, (width, length) in rows.items():
        assert abs(np.degrees(np.interp(math.log(ratio), np.log(curve.ratios), curve.widths)) - width) < 0.01
        assert abs(np.interp(math.radians(width), curve.widths, curve.lengths) - length) < 1e-4
    assert np.allclose(curve.starts, math.pi - curve.widths / 2)


def test_refusals():
    with pytest.raises(LinkageError, match="did you mean 'watt'"):
        guidance("wat")
    with pytest.raises(LinkageError, match="tolerance must be positive"):
        guidance("watt").sized(10, 0)
    with pytest.raises(LinkageError, match="length must be a finite number"):
        guidance("watt").sized(math.inf, 1)
    with pytest.raises(LinkageError, match=r"1e-30 or less"):
        widest_piece(LENKER, WHOLE, 1e-30)
    with pytest.raises(LinkageError, match="no point"):
        ratio_curve(coupler_path(FourBar(40, 70, 25, 70), 45, 40), WHOLE)


def test_the_longest_piece_between_samples():
    """Conchoid of exercise 17: just fills the band, and begins where neither earlier nor later is better."""
    path = coupler_path(InvertedSliderCrank(30, 50), 90, 0)
    found, sampled = longest_in_band(path, 0.0, math.pi, 0.5), longest_piece(path, 0.0, math.pi, 0.5, 361)
    assert math.isclose(found.band, 0.5, rel_tol=1e-6)
    assert sampled.length < found.length < sampled.length * 1.01
    assert abs(found.length - 32.559) < 1e-3
    for off in (-1e-3, 1e-3):  # as long from elsewhere is wider
        piece = partial(path_piece, path, found.start + off, samples=201)
        stops = np.arange(found.end - 0.01, found.end + 0.02, 2e-5)
        other = piece(stops[bisect_left(stops, found.length, key=lambda stop: piece(stop).length)])
        assert found.length <= other.length < found.length + 0.01
        assert other.band > 0.5
