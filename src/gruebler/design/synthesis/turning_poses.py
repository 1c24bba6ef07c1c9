"""A crank that turns fully as one more wish of a fit, of linkages with larger groups: poses all round the turn.

docs/theory/synthesis-any.md. Of a crank and dyads `size_limits` asks their cosines; of larger groups nothing says how
far they are from being assembled. So a fit has poses at angles of the crank all round, beside those at its targets. One
that the crank cannot reach stands at its limit, and what the angle lacks is its error, which changes with the
dimensions as exactly as any other.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.dyad_structures import dyad_structure
from gruebler.design.synthesis.fitting import FitState, FitTargets
from gruebler.mechanics.kinematics import circuit
from gruebler.structure.mechanism import Mechanism

_POSES = 24  # all round
_SAMPLES = 720  # of the circuit


def turns_by_poses(mechanism: Mechanism) -> bool:
    """Whether a full turn of its crank is asked of poses: one drive that turns at the frame, with a larger group."""
    drives, frame = mechanism.drives, mechanism.frame
    turning = len(drives) == 1 and drives[0].turning and frame in drives[0].between
    return turning and dyad_structure(mechanism, sliding=True) is None


def with_turn(closure: DesignClosure, state: FitState, targets: FitTargets) -> tuple[FitState, FitTargets]:
    """A state and targets with more of both, for the turn of the crank; unchanged where the linkage does not move."""
    (drive,) = closure.linkage.mechanism.drives
    crank = next(link for link in drive.between if link in closure.column)
    poses = _round_the_turn(closure, state, crank)
    if poses is None:
        return state, targets
    angles, q = poses
    more = np.full(len(angles), np.nan)
    count = len(targets)
    point = 2 * (targets.z is not None) + (targets.angles is not None)
    free, inputs = state.free, targets.inputs
    if inputs is None:
        free, inputs = np.insert(free, point, 0.0), np.full(count, np.nan)
    state = replace(state, q=np.concatenate([state.q, q]), crank=crank, free=free)
    return state, replace(
        targets,
        z=None if targets.z is None else np.append(targets.z, more.astype(np.complex128)),
        angles=None if targets.angles is None else np.append(targets.angles, more),
        inputs=np.append(inputs, angles - free[point]),
        outputs=None if targets.outputs is None else np.append(targets.outputs, more),
    )


def without_turn(state: FitState, targets: FitTargets) -> FitState:
    """The state at the targets alone, as they were before."""
    if len(state.q) == len(targets):
        return state
    point = 2 * (targets.z is not None) + (targets.angles is not None)
    free = state.free if targets.inputs is not None else np.delete(state.free, point)
    return replace(state, q=state.q[: len(targets)], free=free)


def _round_the_turn(closure: DesignClosure, state: FitState, crank: str) -> tuple[Reals, Reals] | None:
    """Angles of the crank all round, and the poses nearest to them on the way from the first target to its limits."""
    try:
        course = circuit(closure.with_sizes(state.p, {}, state.q[0]))
    except LinkageError:
        return None
    arcs = np.linspace(0, course.length, _SAMPLES + 1)[: -1 if course.closed else None]
    q = closure.poses(course.at(arcs))
    turned = np.unwrap(q[:, closure.column[crank] + 2])
    # On from the first target, and back from it, as long as the crank goes one way.
    sense = np.sign(turned[1] - turned[0])
    on = _one_way(sense * (turned - turned[0]))
    rows = np.arange(on + 1)
    if course.closed and on < len(turned) - 1:
        back = np.roll(turned[::-1], 1)
        behind = _one_way(sense * (turned[0] - np.unwrap(back)))
        rows = np.append(-np.arange(behind, 0, -1), rows)
    passed = np.unwrap(turned[rows])
    angles = turned[0] + 2 * np.pi * np.arange(_POSES) / _POSES
    laps = angles[:, None] + 2 * np.pi * np.arange(-1, 2)
    nearest = np.abs(laps[:, :, None] - passed).min(axis=1).argmin(axis=1)
    return angles, q[rows[nearest]]


def _one_way(passed: Reals) -> int:
    """The last row up to which an angle grows."""
    back = np.flatnonzero(np.diff(passed) <= 0)
    return int(back[0]) if len(back) else len(passed) - 1
