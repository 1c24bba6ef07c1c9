"""Types of arrays, named once for all rooms, and products of plane vectors; shapes stand in other docstrings."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["Complexes", "Flags", "Integers", "Reals", "cross_product", "scalar_product"]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]


def scalar_product(a: Complexes | complex, b: Complexes | complex) -> Reals:
    """The scalar product of plane vectors x + iy."""
    return np.asarray((np.conj(a) * b).real)


def cross_product(a: Complexes | complex, b: Complexes | complex) -> Reals:
    """The area that plane vectors x + iy span, positive if b lies to the left of a."""
    return np.asarray((np.conj(a) * b).imag)
