"""Types of arrays, named once for all rooms; shapes stand in the docstrings of what takes or returns them."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["Complexes", "Flags", "Integers", "Reals"]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]
