"""Print the kernels that numpy's OpenBLAS chooses on this processor, e.g. `Haswell`; nothing if it cannot be asked."""

import ctypes
from pathlib import Path

import numpy as np

for library in (Path(np.__file__).parents[1] / "numpy.libs").glob("*openblas*"):
    name = getattr(ctypes.CDLL(str(library)), "scipy_openblas_get_corename64_", None)
    if name is not None:
        name.restype = ctypes.c_char_p
        print(name().decode())
