"""The position that a linkage remembers of its drawing, as a start for the solver."""

from __future__ import annotations

from cmath import rect
from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.contacts import reference_angles
from gruebler.mechanics.kinematics.dyad_forms import DyadJoint
from gruebler.mechanics.kinematics.plan import Dyad, Plan
from gruebler.mechanics.linkages.model import NEAR_REFERENCE


class ReferencePose(NamedTuple):
    """Drive values, signs of dyads and unknowns of larger groups in the reference pose."""

    drives: Reals
    signs: Reals
    unknowns: Reals


def pose_at_reference(plan: Plan, near: Reals) -> ReferencePose:
    """The reference pose; turning drives by whole turns as near as possible to given values, but not with wheels."""
    drives = np.array([_drive(plan, k) for k in range(len(plan.linkage.mechanism.drives))])
    for k, drive in enumerate(plan.linkage.mechanism.drives):
        if drive.turning and not plan.wheels:
            drives[k] += 2 * pi * round((near[k] - drives[k]) / (2 * pi))
    signs = np.array([_sign(plan, dyad) for dyad in plan.dyads])
    unknowns = [_against(plan, root, part.base) for part in plan.higher_groups for root in part.roots]
    windings = [reference_angles(plan.lower, plan.keys, condition) for condition in plan.windings]
    return ReferencePose(drives, signs, np.concatenate([np.array(unknowns).ravel(), np.array(windings).ravel()]))


def check_reference(plan: Plan, places: NDArray[np.complex128], turns: NDArray[np.complex128]) -> None:
    """`LinkageError` if a solved pose is far from the reference pose: then the joints are not closed there."""
    for k, link in enumerate(plan.lower.mechanism.chain.links):
        reference = plan.lower.required_pose[link]
        gap = max(
            abs(places[k] - complex(reference.x, reference.y)) / plan.lower.size,
            abs(turns[k] - rect(1, reference.angle)),
        )
        if gap > NEAR_REFERENCE:
            raise LinkageError(
                "reference pose: the joints are not closed there; {link!r} would have to lie elsewhere", link=link
            )


def _put(plan: Plan, element: int) -> complex:
    number, link = plan.keys[element]
    e = plan.lower.elements[number, link]
    return complex(*plan.lower.required_pose[link].put(e.x, e.y))


def _line(plan: Plan, element: int) -> complex:
    number, link = plan.keys[element]
    e = plan.lower.elements[number, link]
    return rect(1, plan.lower.required_pose[link].angle + e.direction)


def _drive(plan: Plan, k: int) -> float:
    first, other = plan.lower.reference(k)
    drive = plan.lower.mechanism.drives[k]
    if drive.turning:
        return plan.lower.required_pose[other].angle - plan.lower.required_pose[first].angle
    near, far = plan.keys.index((drive.joint, first)), plan.keys.index((drive.joint, other))
    return float((_line(plan, near).conjugate() * (_put(plan, far) - _put(plan, near))).real)


def _sign(plan: Plan, dyad: Dyad) -> float:
    _, outer, _, inner, _, _, other, *_ = plan.operation(dyad)
    joints = (DyadJoint(_put(plan, element), _line(plan, element)) for element in (outer, inner, other))
    return -1.0 if dyad.form.side is not None and dyad.form.side(*joints) < 0 else 1.0


def _against(plan: Plan, link: str, base: str) -> tuple[float, float, float]:
    pose2_d, other = plan.lower.required_pose[link], plan.lower.required_pose[base]
    return (*other.to_local(pose2_d.x, pose2_d.y), pose2_d.angle - other.angle)
