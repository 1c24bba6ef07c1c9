"""How long kernels take if they are interpreted, in seconds: the estimates for `compiling.for_work`.

Measured on one core with Python 3.11; right to a factor of two or three, which is
all that the choice of a tier needs. A graph of the enumeration about 300 us for each of its automorphisms.
"""

from __future__ import annotations


def labelling(n: int, m: int) -> float:
    """A canonical labelling of a graph of n vertices and m edges."""
    return 1.5e-5 * (n + m)
