"""The equation of the four-bar's coupler curve."""

import numpy as np
from hypothesis import given

from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.linkages.branch import branch_of_side

from .sextic_oracle import coupler_sextic
from .test_cognates import four_bars


@given(four_bars())
def test_it_vanishes_on_both_branches(drawn):
    bar, u, v, phi, _ = drawn
    sextic = coupler_sextic(bar, u, v)
    for side in (1, -1):
        x, y = bar.motion(phi, branch=branch_of_side(side)).point(u, v).value.T
        large = np.maximum(np.hypot(x, y), max(bar.a, bar.b, bar.c, bar.d, abs(u), abs(v)))
        assert np.all(np.abs(sextic.value(x + 1j * y)) < 1e-11 * (2 * large) ** 6)


def test_oracle_elimination():
    """Sylvester's resultant of the two circles' conditions in tan(theta/2), at single points."""
    bar, arm = FourBar(2.5, 7, 4, 7), 4.5 + 4.0j
    sextic = coupler_sextic(bar, arm.real, arm.imag)
    points = np.array([1.0 + 2.0j, -2.0 + 5.0j, 3.0 - 1.0j, 6.0 + 2.0j])
    resultants = []
    for k in points:
        rows = []
        for centre, length, lever in ((0, bar.a, arm), (bar.d, bar.c, arm - bar.b)):
            # abs(K - centre - lever e)^2 = length^2 with e = (1 + i t)^2/(1 + t^2)
            away = np.conj(k - centre) * lever
            rest = abs(k - centre) ** 2 + abs(lever) ** 2 - length**2
            rows.append([rest + 2 * away.real, 4 * away.imag, rest - 2 * away.real])
        (a, b, c), (d, e, f) = rows
        resultants.append(np.linalg.det([[a, b, c, 0], [0, a, b, c], [d, e, f, 0], [0, d, e, f]]))
    ratio = np.array(resultants) / sextic.value(points)
    assert np.allclose(ratio, ratio[0], rtol=1e-9)


def test_no_change_of_sign_on_the_focal_circle():
    """The circle through the three pivots meets the curve in its double points only: there the sextic is a square."""
    bar, arm = FourBar(25, 70, 40, 70), 45 + 40j
    sextic = coupler_sextic(bar, arm.real, arm.imag)
    c0 = bar.d * arm / bar.b
    middle = complex(bar.d / 2, (abs(c0) ** 2 - bar.d * c0.real) / (2 * c0.imag))
    circle = middle + abs(middle) * np.exp(1j * np.linspace(0, 6.28, 400))
    values = sextic.value(circle)
    assert values.min() >= -1e-9 * np.abs(values).max() or values.max() <= 1e-9 * np.abs(values).max()


def test_gradient():
    sextic = coupler_sextic(FourBar(25, 70, 40, 70), 45, 40)
    at, step = 12 + 31j, 1e-4
    slopes = [(sextic.value(at + s) - sextic.value(at - s)) / (2 * step) for s in (step, 1j * step)]
    assert np.isclose(sextic.gradient(at), complex(*slopes), rtol=1e-6)
