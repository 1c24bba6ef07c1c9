"""Scales: round ticks that cover what they are asked to cover."""

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.pictures.canvas.axes import angles, decades, decimals, tick_labels

values = st.floats(-1e6, 1e6, allow_subnormal=False)


@given(values, values, st.integers(3, 12), st.booleans(), st.sampled_from([decimals, angles]))
def test_ticks_lie_on_the_scale_with_one_step(a, b, few, tight, make):
    low, high = sorted((a, b))
    scale = make(low, high, few=few, tight=tight)
    slack = 1e-6 * (scale.high - scale.low)
    assert scale.low <= low + slack
    assert scale.high >= high - slack
    assert all(scale.low - slack <= tick <= scale.high + slack for tick in scale.ticks)
    steps = [q - p for p, q in pairwise(scale.ticks)]
    assert 1 <= len(scale.ticks) <= few + 3
    assert all(math.isclose(step, steps[0], rel_tol=1e-4) for step in steps)
    assert len(scale.names) == len(scale.ticks)
    assert len(set(scale.names)) == len(scale.ticks)


@pytest.mark.parametrize(
    ("low", "high", "few", "step"), [(0, 360, 9, 45), (0, 90, 6, 15), (0, 720, 9, 90), (0, 4, 9, 0.5)]
)
def test_angles_are_divided_as_circles_are(low, high, few, step):
    ticks = angles(low, high, few=few).ticks
    assert ticks[1] - ticks[0] == step


@given(st.floats(1e-9, 1e6), st.floats(1.0, 1e5))
def test_decades_go_from_power_to_power(low, factor):
    scale = decades(low, low * factor)
    assert scale.low <= low * (1 + 1e-8)
    assert scale.high >= low * factor * (1 - 1e-8)
    assert all(math.log10(end) == pytest.approx(round(math.log10(end)), abs=1e-12) for end in (scale.low, scale.high))
    named = [tick for tick, name in zip(scale.ticks, scale.names, strict=True) if name]
    assert all(b / a == pytest.approx(10) for a, b in pairwise(named))
    assert scale.part(math.sqrt(scale.low * scale.high)) == pytest.approx(0.5)


def test_numbers_are_told_with_the_places_of_their_step():
    assert tick_labels((0.0, 0.5, 1.0), 0.5) == ("0.0", "0.5", "1.0")
    assert tick_labels((-20.0, 0.0), 20.0) == ("−20", "0")
    assert tick_labels((0.0, 5e-6), 5e-6) == ("0", "5×10⁻⁶")
