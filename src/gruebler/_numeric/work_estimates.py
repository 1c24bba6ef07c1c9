"""How long kernels take if they are interpreted, in seconds: the estimates for `compiling.for_work`.

Measured on one core with Python 3.11; right to a factor of two or three, which is
all that the choice of a tier needs. A row that a sweep places costs 4 us for each dyad, one that is walked to 25 us;
an orthonormalisation of n rows 2 n^2 us; a graph of the enumeration about 300 us for each of its automorphisms.
"""

from __future__ import annotations

from gruebler._numeric.motion.program import Program
from gruebler._numeric.motion.sweep import SWEPT_ROWS, swept_links


def walking(program: Program, rows: int, order: int) -> float:
    """`motion.walk` over so many rows, with so many derivatives."""
    operations, conditions = len(program.operations), len(program.kinds)
    if rows > SWEPT_ROWS and swept_links(program):
        return 1e-3 + 4e-6 * rows * operations
    unknowns = 3 * len(program.roots)
    dearer = 1 + order / 3
    return 1e-3 + rows * dearer * (2.5e-5 * operations + 4e-5 * conditions + 4e-7 * unknowns**3)


def closing_work(unknowns: int) -> float:
    """Residual and Jacobian of all joints, once."""
    return 1e-5 * unknowns


def newton_work(unknowns: int) -> float:
    """Newton's method on the conditions of a group."""
    return 5 * (closing_work(unknowns) + 2e-7 * unknowns**3)


def sampling(unknowns: int, places: int) -> float:
    """Poses on a circuit."""
    return 1.5e-5 * unknowns**2 * places


def labelling(n: int, m: int) -> float:
    """A canonical labelling of a graph of n vertices and m edges."""
    return 1.5e-5 * (n + m)
