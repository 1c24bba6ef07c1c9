"""What the motion kernels of the core take and write, field by field; `gruebler._core` has the doors.

The numbers of kinds and ends are those of `core/src/motion`. All arrays are C-contiguous.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]

TURN, PUSH, RRR, RRP, RPR, PRP, RPP, GROUP, CARRY = range(9)
"""What an operation does: a driven turn or push, a dyad, a larger group; a link that is carried along by its body."""

PIN, SLIDE, RIDE, REACH, MESH, RACK, POLAR, FACE, TRAIN, TRAVEL = range(10)
"""The kinds of closing conditions; `core/src/motion/closure.hpp` says what each demands."""

EQUATIONS = (2, 2, 1, 1, 1, 1, 1, 1, 1, 1)
"""How many equations each kind has."""

CLOSED, FULL, LONG, LOST, FLIP = range(5)
"""How `trace_curve` ended: back at the start; no room for more samples; at the longest length; no step succeeds; the
bordered determinant has changed its sign from the last sample to the one behind it, which is not counted yet."""

SHORTEST = 1e-10
"""The shortest step of `trace_curve`."""


class Program(NamedTuple):
    """What a linkage is to the kernel."""

    operations: Ints
    """(operations, 10) whole numbers: what to do, then its arguments."""
    links: Ints
    """(elements,) the link of each joint element."""
    points: Complexes
    """(elements,) complex: the element's point in its link."""
    lines: Complexes
    """(elements,) complex of modulus 1: the element's direction in its link."""
    conditions: Ints
    """(groups + 1,) where the closing conditions of each larger group start."""
    kinds: Ints
    """(conditions,) their kinds."""
    sides: Ints
    """(2 conditions,) their elements."""
    owners: Ints
    """(2 conditions,) the body of the group that carries the element, -1 for what is known."""
    bodies: Ints
    """(groups + 1,) where the bodies of each larger group start."""
    roots: Ints
    """(bodies,) the link that stands for the body."""
    most: Reals
    """(drives,) the longest step of each drive."""
    size: float
    """A length of the order of the linkage."""
    values: Reals
    """(conditions, 6) numbers of each closing condition: 0 to 2 and 5 to 7 of `Conditions.values`."""
    windings: Ints
    """(conditions,) where the angles of a condition that counts whole turns stand among the unknowns, else -1."""
    pieces: Reals
    """(pieces, 2 + coefficients) of the laws: middle, half the width, a polynomial on [-1, 1]."""


class PoseBuffer(NamedTuple):
    """What `run_path` writes, a column for each row of the path."""

    places: Complexes
    """(order + 1, links, rows)"""
    turns: Complexes
    """(links, rows)"""
    rates: Reals
    """(order, links, rows)"""
    whole: NDArray[np.int32]
    """(links, rows) whole turns since the first row, for angles without jumps."""
    roots: Reals
    """(dyads, rows) signed roots"""
    unknowns: Reals
    """(3 bodies of larger groups, then two angles of each condition that counts whole turns; rows)"""


class DesignInputs(NamedTuple):
    """In what designs of one program differ."""

    points: Complexes
    """(designs, elements)"""
    lines: Complexes
    """(designs, elements)"""
    most: Reals
    """(designs, drives) longest steps."""
    sizes: Reals
    """(designs,)"""
    signs: Reals
    """(designs, dyads); NaN for a design that is not to be moved."""
    starts: Reals
    """(designs, 3 bodies of larger groups)"""


class DesignPoses(NamedTuple):
    """What `run_designs` writes of each design, NaN in rows that were not reached."""

    places: Complexes
    """(order + 1, designs, kept, rows)"""
    turns: Complexes
    """(designs, kept, rows)"""
    rates: Reals
    """(order, designs, kept, rows)"""
    reached: Ints
    """(designs,) how many rows."""


class Conditions(NamedTuple):
    """Closing conditions of joints between bodies."""

    kinds: Ints
    """(conditions,)"""
    values: Reals
    """(conditions, 8): two factors, the value, two angles near by (of a train its arm and an offset), then of the law
    the first piece, how many, and what it grows by in a turn."""
    pieces: Reals
    """(pieces, 2 + coefficients) of the laws, as in `Program`."""
    owners: Ints
    """(2 conditions,) the body that carries the element, -1 for what is known."""
    points: Complexes
    """(2 conditions, 1) each element's point: against its body or, of what is known, where it is."""
    lines: Complexes
    """(2 conditions,) the element's direction."""
    spins: Reals
    """(0, 3): nothing is derived."""
    size: float
    """A length of the order of the linkage."""


class SampleBuffer(NamedTuple):
    """Samples of a circuit, as many as there is room for."""

    arcs: Reals
    """(samples,) length from the first one."""
    poses: Reals
    """(samples, n)"""
    tangents: Reals
    """(samples, n) of length 1."""
    gauges: Reals
    """(samples,) the shortest independent row, with the sign of the bordered determinant if no row is redundant."""
