"""Arithmetic with power series: coefficients along the first axis, any shape behind it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gruebler.base.arrays import Reals


def product(a: Reals, b: Reals, times: Callable[[Reals, Reals], Reals]) -> Reals:
    """The product of two series, cut off at the length of the shorter one.

    >>> product(np.array([1.0, 1.0, 0.0]), np.array([1.0, 2.0, 1.0]), np.multiply).tolist()
    [1.0, 3.0, 3.0]
    """
    terms = []
    for k in range(min(len(a), len(b))):
        term = times(a[0], b[k])
        for i in range(1, k + 1):
            term = term + times(a[i], b[k - i])
        terms.append(term)
    return np.array(terms)


def reciprocal(a: Reals) -> Reals:
    """One over a series.

    >>> reciprocal(np.array([2.0, 2.0, 0.0])).tolist()
    [0.5, -0.5, 0.5]
    """
    b = np.zeros_like(a)
    b[0] = 1 / a[0]
    for k in range(1, len(a)):
        b[k] = -b[0] * sum(a[i] * b[k - i] for i in range(1, k + 1))
    return b


def cosine_and_sine(a: Reals) -> tuple[Reals, Reals]:
    """Cosine and sine of a series: exp(i a) by k e_k = i Σ j a_j e_(k - j).

    >>> [x.tolist() for x in cosine_and_sine(np.array([0.0, 1.0, 0.0]))]
    [[1.0, 0.0, -0.5], [0.0, 1.0, 0.0]]
    """
    e = np.zeros(a.shape, complex)
    e[0] = np.exp(1j * a[0])
    for k in range(1, len(a)):
        e[k] = 1j / k * sum(j * a[j] * e[k - j] for j in range(1, k + 1))
    return e.real, e.imag
