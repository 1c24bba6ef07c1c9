"""Where a motion in space ends, and why: a limit of the drive, shifts that grow without end, modes that meet.

Method: docs/theory/space.md.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.space.closure import Place
from gruebler.mechanics.space.curve import ConfigurationCurve, CurvePoint, directed
from gruebler.mechanics.space.following import Setting, is_limit
from gruebler.mechanics.space.motion import SpatialStop
from gruebler.mechanics.space.outputs import valued_freedoms
from gruebler.structure.chain.spaces import Freedom

_FAST = 0.5  # of the fastest joint: joints that move so fast in a last position are named
_ISOLATED = 1e-5  # radians and sizes: who moves less either way does so within what counts as closed
_TRIAL = 0.01  # radians and sizes: how far the other way is tried
_SHIFTS = 0.9  # the share of shifts in a tangent, from which on they may grow without end
_NEAR = 1e-2  # radians: how far from the last position that with shifts without end is looked for
_NEAR_DRIVE = 1e-4  # radians: and in the drive
_GROWS = 1e-6  # of the fastest: a shift that is slower stays finite


class Endless(NamedTuple):
    """A position at infinity: that of the linkage with its dimensions shrunk to 0, shifts growing along the tangent."""

    curve: ConfigurationCurve
    point: CurvePoint

    def value(self, joint: int, freedom: str) -> float | None:
        """The value of a joint's freedom there: infinite if it grows without end; None of another shift."""
        motion = self.curve.motion([self.point])
        if Freedom(freedom).turns:
            return float(motion.joint(joint, freedom)[0])
        rate = float(motion.joint(joint, freedom, 1)[0]) / motion.linkage.size
        return float(np.copysign(np.inf, rate)) if abs(rate) > _GROWS else None


def endless(set_up: Setting, drive: int, place: Place, sense: float) -> Endless | None:
    """The position at infinity just beyond a place in the sense of a drive's unknown; None if there is none.

    With all dimensions shrunk to 0 the closing conditions are those of directions and of shifts without end: there
    the position is one like any other, next to the place in all turns, its shifts those of the tangent.
    """
    shrunk = set_up.closure.shrunk()
    if shrunk is None:
        return None
    curve = ConfigurationCurve(set_up, drive)
    tangent = np.linalg.svd(set_up.closure.linearised(place)[1][:, curve.columns])[2][-1]
    tangent = tangent * (sense if tangent[0] > 0 else -sense)
    nodes = set_up.closure.tree.nodes[1:]
    shifts = np.array([not node.turn for node in nodes])
    own = np.where(shifts[curve.columns], tangent, 0.0)
    if shifts[curve.columns[0]] or not np.linalg.norm(own) > _SHIFTS:
        return None
    q = np.where(shifts, 0.0, place.q)
    q[curve.columns] += own / np.linalg.norm(own)
    far = ConfigurationCurve(replace(set_up, closure=shrunk), drive)
    point = far.near(Place(q, place.turns), own)
    if point is None or abs(point.place.q - q).max() > _NEAR:
        return None
    left = sense * float(point.place.q[curve.columns[0]] - q[curve.columns[0]])
    return Endless(far, directed(point, own)) if -_ISOLATED < left < _NEAR_DRIVE else None


def stop_of(set_up: Setting, last: Place, row: float, change: Reals) -> SpatialStop:
    """Why a path of drives that change so (drives,) ends next to a place."""
    tree = set_up.closure.tree
    moving = int(np.argmax(abs(change)))
    alone = np.count_nonzero(change) == 1
    reason, joints = "", tuple[str, ...]()
    values = last.q[set_up.drives]
    names = tree.linkage.mechanism.chain.joint_names()
    if _is_isolated(set_up, last, change):
        reason = "isolated"
        driven = {drive.joint for drive in tree.linkage.mechanism.drives}
        joints, values = tuple(name for joint, name in enumerate(names) if joint not in driven), np.zeros(len(values))
    elif (beyond := endless(set_up, moving, last, float(np.sign(change[moving])))) is not None:
        reason = "endless"
        freedoms = [each for each in valued_freedoms(tree.linkage) if Freedom(each[1]).travels]
        joints = tuple(dict.fromkeys(names[k] for k, f in freedoms if beyond.value(k, f) is not None))
        if alone:
            values = beyond.point.place.q[set_up.drives]
    else:
        reason, joints = "limit" if is_limit(set_up, last, change) else "singular", _fastest(set_up, last)
        if reason == "limit" and alone:
            last = _turning_point(set_up, last, change)
            values = last.q[set_up.drives]
    order = [set_up.drives.tolist().index(k) for k in tree.drives]
    values = values[order] * set_up.closure.units[list(tree.drives)] * tree.signs
    return SpatialStop(
        row=max(row, 0.0),
        drives=tuple(map(float, values)),
        joints=joints,
        reason=reason,
        linkage=tree.linkage,
        place=last,
    )


def _is_isolated(set_up: Setting, last: Place, change: Reals) -> bool:
    """Whether it ends in the reference pose, and the other way, too."""

    def stays(place: Place) -> bool:
        return bool(abs(place.q[set_up.drives]).max(initial=0.0) < _ISOLATED)

    if not stays(last) or not change.any():
        return False
    back = -_TRIAL * change / abs(change).max()
    tried = set_up.closure.follow(set_up.passive, set_up.drives, back[None], np.zeros((0, 1, len(back))))
    return tried.end is not None and stays(tried.last)


def _fastest(set_up: Setting, last: Place) -> tuple[str, ...]:
    """The joints that move fastest where the drives stand."""
    tree = set_up.closure.tree
    by_unknown = set_up.closure.linearised(last)[1]
    fast = np.linalg.svd(by_unknown[:, set_up.passive])[2][max(set_up.rank - 1, 0)]
    share = dict(zip(set_up.passive.tolist(), abs(fast), strict=True))
    names = tree.linkage.mechanism.chain.joint_names()
    joints = {names[joint]: share.get(k, 0.0) for (joint, _), k in tree.unknown.items()}
    most = max(joints.values(), default=0.0)
    return tuple(name for name, value in joints.items() if value > _FAST * most > 0)


def _turning_point(set_up: Setting, last: Place, change: Reals) -> Place:
    """Where the one drive that moves turns back, at most 0.1 along the curve; the last place if it is not found."""
    moving = int(np.argmax(abs(change)))
    curve = ConfigurationCurve(set_up, moving)
    start = curve.near(last)
    if start is None:
        return last
    fold = curve.fold(directed(start, np.sign(change[moving]) * np.eye(len(curve.columns))[0]))
    return last if fold is None else fold.place
