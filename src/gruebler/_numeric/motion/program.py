"""What the kernels that move a linkage share: the program, the memory of the last poses, scratch arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.motion.newton import new_newton_scratch
from gruebler._numeric.motion.planar_jets import BodyJets, ElementJets

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]

TURN, PUSH, RRR, RRP, RPR, PRP, RPP, GROUP, CARRY = range(9)
"""What an operation does: a driven turn or push, a dyad, a larger group; a link that is carried along by its body."""

DONE, LIMIT, SINGULAR, START = range(4)
"""How a run ended: at its last row; where a dyad cannot be assembled any more; where a larger group cannot be followed;
or at its first row already."""

GOOD, APPROACH, APART, LOST, MEET = range(5)
"""What a trial pose is: to be trusted; near a zero of a dyad's root; without a dyad that closes; with a larger group
that is not where it should be; with outer joints of a dyad that meet, its direction still unknown."""

FLAT = 1e-12  # a squared root below this is zero: an exact change point
NEAR = 1e-3  # below this root a change point is looked for
KEPT = 0.25  # of its last value: a root that keeps less may have come through zero, the step is halved
EXPECTED = 0.5  # of its last value: a root that is expected to keep less falls to a zero, which is looked for
LEAST = 1e-14  # the smallest step, in rows
NEAREST = 1e-8  # of the longest step: nearer to a singular position of a larger group it is taken for a limit
FARTHEST = 1.0  # radians: a step that turns a wheel further is not taken, so that no whole turn is missed


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
    """(conditions, 6) numbers of each closing condition: 0 to 2 and 5 to 7 of its values."""
    windings: Ints
    """(conditions,) where the angles of a condition that counts whole turns stand among the unknowns, else -1."""
    pieces: Reals
    """(pieces, 2 + coefficients) of the laws, see `closure.evaluate_law`."""


class PoseBuffer(NamedTuple):
    """What is written, a column for each row of the path."""

    places: Complexes
    """(order + 1, links, rows)"""
    turns: Complexes
    """(links, rows)"""
    rates: Reals
    """(order, links, rows)"""
    whole: NDArray[np.int32]
    """(links, rows) whole turns since the first row, for angles without jumps; 0 beforehand"""
    roots: Reals
    """(dyads, rows) signed roots"""
    unknowns: Reals
    """(3 bodies of larger groups, then two angles of each condition that counts whole turns; rows)"""


class PoseMemory(NamedTuple):
    """What the last poses were, newest first; index 3 is the trial."""

    at: Reals  # (4,) their places on the path
    filled: Ints  # (1,) how many there are
    roots: Reals  # (4, dyads) signed roots
    unknowns: Reals  # (4, 3 bodies and windings)
    determinants: Reals  # (4, groups)
    signs: Reals  # (dyads,) the sign that holds from here on
    change: Reals  # (dyads,) where the root goes through zero, NaN if that is not known
    after: Reals  # (dyads,) the sign behind that; 0 if it is not known
    met: Reals  # (dyads,) the place on the path where the outer joints meet
    direction: Complexes  # (dyads,) the turn of the first body there
    singular: Ints  # (1,) 1 + the group whose singular place is jumped; -1 - the group that is placed at it; else 0
    unit: Reals  # (1,) the longest step of the drives, in rows
    which: Ints  # (1,) the dyad or group that spoils the trial


class MotionScratch(NamedTuple):
    """What one pose is placed in: arrays by what they serve; kernels put them together as the tuples named here."""

    drives: Reals
    """(4, drives) values and their three derivatives."""

    # the links, as `BodyJets`
    places: Complexes
    turns: Complexes
    rates: Reals
    last_turns: Complexes
    """(links,) the turns of the pose accepted last."""
    whole_turns: Ints
    """(links,) whole turns since the first row."""

    # the six elements of a dyad, as `ElementJets`; a drive uses the first
    points: Complexes
    lines: Complexes
    spins: Reals

    # the conditions of a larger group, as `Conditions`, with room for those of the largest group
    group_points: Complexes
    group_lines: Complexes
    group_spins: Reals
    values: Reals
    predicted: Reals
    """(unknowns,) of its bodies, from the last poses."""
    ends: Complexes
    """(2,) where the points of one condition lie."""
    directions: Complexes
    """(2,) the directions there."""

    # the bodies of a larger group, as `BodyJets`
    body_places: Complexes
    body_turns: Complexes
    body_rates: Reals

    # its linear equations, as `NewtonScratch`
    residual: Reals
    jacobian: Reals
    normal: Reals
    pivots: Ints

    # one condition after another, as `RateScratch`
    gap: Complexes
    gap_spins: Reals


def new_pose_memory(dyads: int, unknowns: int, groups: int) -> PoseMemory:
    return PoseMemory(
        np.zeros(4),
        np.zeros(1, np.int64),
        np.zeros((4, dyads)),
        np.zeros((4, unknowns)),
        np.zeros((4, groups)),
        np.ones(dyads),
        np.full(dyads, np.nan),
        np.ones(dyads),
        np.full(dyads, np.nan),
        np.ones(dyads, np.complex128),
        np.zeros(1, np.int64),
        np.ones(1),
        np.zeros(1, np.int64),
    )


def new_motion_scratch(links: int, conditions: int, bodies: int, drives: int) -> MotionScratch:
    c, b = max(conditions, 1), max(bodies, 1)
    dyad, group, newton = _element_jets(6), _element_jets(2 * c), new_newton_scratch(3 * b)
    return MotionScratch(
        np.zeros((4, drives)),
        *_body_jets(links),
        np.ones(links, np.complex128),
        np.zeros(links, np.int64),
        *dyad,
        *group,
        np.zeros((c, 8)),
        np.zeros(3 * b),
        np.zeros(2, np.complex128),
        np.ones(2, np.complex128),
        *_body_jets(b),
        newton.residual,
        newton.jacobian,
        newton.normal,
        newton.pivots,
        np.zeros(4, np.complex128),
        np.zeros((2, 3)),
    )


def _body_jets(bodies: int) -> BodyJets:
    return BodyJets(np.zeros((bodies, 4), np.complex128), np.ones(bodies, np.complex128), np.zeros((bodies, 3)))


def _element_jets(slots: int) -> ElementJets:
    return ElementJets(np.zeros((slots, 4), np.complex128), np.ones(slots, np.complex128), np.zeros((slots, 3)))
