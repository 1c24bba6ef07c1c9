"""How far dead centres move when lengths are wrong: swing or stroke, and the crank angle between, by exact derivatives.

docs/theory/synthesis-dead-centres.md, "Sensitivity".
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.sensitivity import (
    LENGTH_ERROR,
    Sensitivity,
    changed_lengths,
    drive_rates,
    joint_plays,
    reached_poses,
    travel_rates,
)
from gruebler.mechanics.analysis.outputs import Output
from gruebler.mechanics.linkages import Linkage


class _Direction(NamedTuple):
    """Changes of all unknowns of a pose, (unknowns, n), and of all dimensions, (dimensions, n)."""

    pose: Reals
    sizes: Reals


class _Bends(NamedTuple):
    """Second derivatives along two directions."""

    gaps: Reals
    """(equations, n) of the conditions."""
    along: Reals
    """(joints, n) of the gap along each slide; 0 for pins."""


def dead_centre_sensitivity(linkage: Linkage, output: Output, drives: tuple[float, float], size: float) -> Sensitivity:
    """How far swing or stroke and the drive's angle between the dead centres change with each length.

    Args:
        linkage: with one drive that turns.
        output: that has the dead centres.
        drives: the values of the drive there.
        size: as an arc of which the angle counts: the stroke, or 1.

    Of one target there are two quantities: swing or stroke, and the angle times the size. Raises `SynthesisError`
    where the pose is not determined there. Cost: 2 ms.

    The stroke of a centric slider-crank is twice its crank, 3 long, whatever its coupler is.

    >>> from gruebler.mechanics.analysis.outputs import find_output
    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> crank = SliderCrank(3, 5)
    >>> ends = (crank.dead_centres.outer.drive, crank.dead_centres.inner.drive)
    >>> found = dead_centre_sensitivity(crank.linkage(), find_output(crank.linkage()), ends, 6.0)
    >>> [(row.link, round(float(abs(move)), 9)) for row, move in zip(found.lengths, found.moves[0, 0], strict=True)]
    [('crank', 0.006), ('coupler', 0.0)]
    """
    closure = DesignClosure(linkage)
    if closure.unknowns - closure.equations != 1:
        raise SynthesisError("the drives do not fix the pose of this linkage")
    q = reached_poses(closure, np.array(drives)[:, None])
    lengths, changes, _ = changed_lengths(closure, ())
    changes = np.concatenate([changes, joint_plays(closure)], axis=1)
    ends = np.stack([_dead_centre(closure, q[k : k + 1], output, changes) for k in (0, 1)]) * np.array(
        [[[1.0], [size]]]
    )
    known = len(lengths)
    moves = (ends[1] - ends[0])[None, :, :known].astype(np.complex128)
    # In each dead centre a pin may lie in another direction: its plays there are as those of two joints.
    plays = np.concatenate([-ends[0, :, known:], ends[1, :, known:]], axis=1).reshape(1, 2, -1, 2)
    return Sensitivity(lengths=lengths, moves=LENGTH_ERROR * moves, plays=plays.astype(np.complex128))


def _dead_centre(closure: DesignClosure, q: Reals, output: Output, changes: Reals) -> Reals:
    """(2, changes) how fast output and drive change in one dead centre with each change of the dimensions."""
    by_pose, by_sizes = (part[0] for part in _core.pose_slopes(closure.joints, q, closure.sizes))
    of_drive, drive_itself = (part[0] for part in drive_rates(closure, q, changes))
    matrix = np.concatenate([by_pose, of_drive])
    moved = -np.linalg.solve(matrix, np.concatenate([by_sizes @ changes, drive_itself]))
    motion = np.linalg.solve(matrix, np.eye(closure.unknowns)[:, -1:])
    still = np.zeros((len(closure.sizes), 1))
    onward = _Direction(motion, still)
    bends = [_second(closure, q[0], onward, each) for each in (_Direction(moved, changes), onward)]
    bent = [-np.linalg.solve(matrix, np.concatenate([bend.gaps, np.zeros_like(bend.gaps[:1])])) for bend in bends]
    if output.joint is None:
        row = np.zeros(closure.unknowns)
        row[closure.column[output.link] + 2] = 1.0
        own, (mixed, twice) = np.zeros(changes.shape[1]), (np.zeros(1), np.zeros(1))
    else:
        row, own = (part[0] for part in travel_rates(closure, q, output.joint, changes))
        mixed, twice = (bend.along[output.joint] for bend in bends)
    # Where the output stands still it changes with the dimensions as if the drive stood still, too.
    return np.stack([row @ moved + own, -(row @ bent[0] + mixed) / (row @ bent[1] + twice)])


def _second(closure: DesignClosure, q: Reals, first: _Direction, other: _Direction) -> _Bends:
    """Second derivatives along two directions of a closed pose, the first of which changes no dimensions."""
    chain = closure.linkage.mechanism.chain
    ends = [(k, joint.links[0], far) for k, joint in enumerate(chain.joints) for far in joint.links[1:]]
    gaps = np.zeros((closure.equations, other.pose.shape[1]))
    along = np.zeros((len(chain.joints), other.pose.shape[1]))
    for n, (k, own, far) in enumerate(ends):
        near, away = (_point_rates(closure, q, k, link, first, other) for link in (own, far))
        place, by_first, by_other, twice = (b - a for a, b in zip(near, away, strict=True))
        if not chain.joints[k].pair.is_sliding:
            gaps[2 * n], gaps[2 * n + 1] = twice.real, twice.imag
            continue
        c = closure.column.get(own)
        turned, turn_first, turn_other = (
            (0.0, 0.0, 0.0) if c is None else (q[c + 2], first.pose[c + 2], other.pose[c + 2])
        )
        seen = np.exp(-1j * (turned + closure.sizes[closure.start[k, own] + 2]))
        bend = seen * (
            twice - 1j * turn_first * by_other - 1j * turn_other * by_first - turn_first * turn_other * place
        )
        gaps[2 * n], along[k] = bend.imag, bend.real  # the angle between both lines is zero or half a turn: no bend
    return _Bends(gaps, along)


def _point_rates(
    closure: DesignClosure, q: Reals, joint: int, link: str, first: _Direction, other: _Direction
) -> tuple[Complexes, Complexes, Complexes, Complexes]:
    """The place of a joint's point on a link, its derivatives along two directions, and along both."""
    at, c = closure.start[joint, link], closure.column.get(link)
    point = complex(*closure.sizes[at : at + 2])
    grown = other.sizes[at] + 1j * other.sizes[at + 1]
    if c is None:
        return np.array([point]), np.zeros(1, np.complex128), grown, np.zeros_like(grown)
    turn = np.exp(1j * q[c + 2])
    turn_first, turn_other = first.pose[c + 2], other.pose[c + 2]
    arm = turn * point
    return (
        np.array([q[c] + 1j * q[c + 1] + arm]),
        first.pose[c] + 1j * first.pose[c + 1] + 1j * turn_first * arm,
        other.pose[c] + 1j * other.pose[c + 1] + 1j * turn_other * arm + turn * grown,
        turn_first * (1j * turn * grown - turn_other * arm),
    )
