"""Derivatives of turned vectors in the plane, written with complex numbers: of e^{i phi} b, for NumPy arrays.

The kernels have the same formulas in `core/src/motion/jets.hpp`.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb
from typing import Any

from gruebler.base.arrays import Complexes, Reals

Derivatives = Sequence[Any] | Reals | Complexes
"""Numbers or arrays of one shape, one for each order."""


def turn_derivative(rates: Derivatives, order: int) -> Any:
    """The derivative of e^{i phi} of an order up to 3, divided by e^{i phi}.

    ``rates`` are phi', phi'', phi''', at least as many as the order asks for.

    >>> turn_derivative([2.0], 1), turn_derivative([2.0, 0.5], 2)
    (2j, (-4+0.5j))
    """
    if order == 0:
        return 1.0
    if order == 1:
        return 1j * rates[0]
    if order == 2:
        return 1j * rates[1] - rates[0] ** 2
    return 1j * (rates[2] - rates[0] ** 3) - 3 * rates[0] * rates[1]


def turned_derivative(rates: Derivatives, vector: Derivatives, order: int) -> Any:
    """The derivative of e^{i phi} b of an order up to 3, divided by e^{i phi}: the rule of Leibniz.

    ``vector`` is b with its derivatives up to the order. With the rates negative it is what a turning observer sees.

    >>> turned_derivative([2.0], [1.0, 5.0], 1)
    (5+2j)
    """
    return sum(comb(order, k) * turn_derivative(rates, k) * vector[order - k] for k in range(order + 1))
