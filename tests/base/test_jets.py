"""Derivatives of turned vectors: against power series and against plain complex numbers."""

from __future__ import annotations

from math import factorial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler.base.jets import turn_derivative, turned_derivative
from tests.core.plain.planar_jets import rotated_derivative

number = st.floats(-5, 5)
rates = st.tuples(number, number, number)
vectors = st.tuples(*[st.builds(complex, number, number)] * 4)


def exponential(series: list[complex], order: int) -> list[complex]:
    """Taylor coefficients of exp of a series without a constant term, by its sum of powers."""
    out, power = [1.0 + 0j] + [0j] * order, np.array([1.0 + 0j])
    for n in range(1, order + 1):
        power = np.polynomial.polynomial.polymul(power, series)[: order + 1]
        for k, value in enumerate(power):
            out[k] += value / factorial(n)
    return out


@given(rates, vectors, st.integers(0, 3))
def test_a_turned_vector_is_the_product_of_two_series(spins, vector, order):
    turned = exponential([0j, *(1j * rate / factorial(k) for k, rate in enumerate(spins, 1))], 3)
    expected = np.polynomial.polynomial.polymul(turned, [b / factorial(k) for k, b in enumerate(vector)])[order]
    scale = 1 + sum(map(abs, vector)) * (1 + sum(map(abs, spins))) ** 3
    assert abs(turned_derivative(spins, vector, order) - expected * factorial(order)) < 1e-13 * scale
    assert abs(turn_derivative(spins, order) - turned[order] * factorial(order)) < 1e-13 * scale


@given(rates, vectors, st.integers(0, 3))
def test_plain_complex_numbers_give_the_same(spins, vector, order):
    scale = 1 + sum(map(abs, vector)) * (1 + sum(map(abs, spins))) ** 3
    kernel = rotated_derivative(order, 1 + 0j, *spins, *vector)
    assert abs(turned_derivative(spins, vector, order) - kernel) < 1e-13 * scale


def test_arrays_of_rates_give_arrays():
    spins = np.array([[1.0, 2.0], [0.5, 0.0], [0.0, 3.0]])
    columns = [turn_derivative(spins[:, k], 3) for k in range(2)]
    assert turn_derivative(spins, 3) == pytest.approx(np.array(columns))
