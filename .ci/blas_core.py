"""Print the kernels of OpenBLAS, other than those chosen here by itself, with which this processor can run the tests.

Haswell and SkylakeX round differently from each other. A processor without AVX-512 stops at the kernels for SkylakeX
with an illegal instruction; where neither is left, those for Nehalem, which any x86-64 of today has, take their place.
"""

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

PRODUCT = "import numpy as np; a = np.eye(200) + 1; np.linalg.solve(a @ a, a)"


def chosen_kernels() -> str:
    """The kernels that numpy's OpenBLAS chooses on this processor, e.g. `Haswell`; empty if it cannot be asked."""
    for library in (Path(np.__file__).parents[1] / "numpy.libs").glob("*openblas*"):
        name = getattr(ctypes.CDLL(str(library)), "scipy_openblas_get_corename64_", None)
        if name is not None:
            name.restype = ctypes.c_char_p
            return str(name().decode())
    return ""


def can_run(kernels: str) -> bool:
    """Whether this processor knows all instructions of these kernels."""
    environment = os.environ | {"OPENBLAS_CORETYPE": kernels}
    return subprocess.run([sys.executable, "-c", PRODUCT], env=environment, check=False).returncode == 0


others = [kernels for kernels in ("Haswell", "SkylakeX") if kernels != chosen_kernels() and can_run(kernels)]
print(*(others or ["Nehalem"]))
