"""The group of motions that a linkage never leaves: the smallest Lie algebra that holds the screws of its joints.

A chain all of whose pairs generate motions of one group of dimension d moves within it, and the count with b = d is
the one that may be right. The groups in space: J. M. Hervé, Analyse structurelle des mécanismes par groupe des
déplacements, Mechanism and Machine Theory 13 (1978) 437-450.
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.closing import Closing
from gruebler.mechanics.screws.rigid_motions import adjoint, lie_bracket
from gruebler.structure.chain.spaces import Space

_SAME = 1e-9  # directions and shares of twists that differ by less are one: poses are closed to 1e-12


class MotionGroupKind(StrEnum):
    """The sorts of groups that matter here."""

    SCREW = "screw"
    """One turn, shift or screw."""
    TRANSLATIONS = "translations"
    CYLINDER = "cylinder"
    """Turns about one line and shifts along it."""
    PLANE = "plane"
    """Motions parallel to a plane."""
    SCREWS = "screws"
    """Screws of one pitch about parallel axes: plane motion with a way along the normal that goes with the turn."""
    SPHERE = "sphere"
    """Turns about one point."""
    PARALLEL = "parallel"
    """All shifts, and turns about one direction (Schoenflies)."""
    OTHER = "other"
    SPACE = "space"


class MotionGroup(NamedTuple):
    """A group of motions and its dimension."""

    kind: MotionGroupKind
    dimension: int


def screws_of(closing: Closing, pose: Reals, joint: int) -> Reals:
    """The screws of a joint in a pose, (f, 6), one row for each freedom, in the axes of its first link."""
    chain = closing.mechanism.chain
    tie = next(tie for tie in closing.ties if tie.joint == joint)
    frame = pose[tie.first] @ tie.on_first
    screws = []
    for freedom in chain.joints[joint].pair.freedoms[chain.space]:
        screws.append(adjoint(frame) @ np.array(freedom.twist(tie.place.pitch)))
    return np.array(screws)


def smallest_algebra(twists: Reals) -> Reals:
    """An orthonormal basis (d, 6) of the smallest Lie algebra that holds the twists (k, 6)."""
    basis = _basis(twists)
    while True:
        brackets = np.einsum("aij,bj->abi", lie_bracket(basis), basis).reshape(-1, 6)
        larger = _basis(np.vstack([basis, brackets]))
        if len(larger) == len(basis):
            return basis
        basis = larger


def _basis(twists: Reals) -> Reals:
    _, values, vectors = np.linalg.svd(twists, full_matrices=False)
    basis: Reals = vectors[values > _SAME * max(1.0, values[0])]
    return basis


def common_group(closing: Closing, pose: Reals) -> MotionGroup:
    """The group that holds all motions of the links; of pairs that are no group, those near the pose.

    >>> from gruebler.structure.mechanism import Mechanism
    >>> from gruebler.mechanics.screws import SpatialLinkage
    >>> winch = Mechanism.parse("spatial: R(frame-spindle) H(spindle-nut) P(frame-nut)")
    >>> z = (0, 0, 1)
    >>> made = SpatialLinkage(winch, {0: {"z": z}, 1: {"z": z, "pitch": 0.8}, 2: {"x": z, "at": (0, 5, 0)}})
    >>> closing = Closing.of(made)
    >>> common_group(closing, closing.reference)
    MotionGroup(kind=<MotionGroupKind.CYLINDER: 'cylinder'>, dimension=2)
    """
    chain = closing.mechanism.chain
    if chain.space is Space.SPHERICAL:
        return MotionGroup(MotionGroupKind.SPHERE, 3)
    return _named(smallest_algebra(np.vstack([screws_of(closing, pose, k) for k in range(len(chain.joints))])))


def _named(basis: Reals) -> MotionGroup:
    dimension = len(basis)
    turning = int(np.linalg.matrix_rank(basis[:, :3], tol=_SAME))
    kinds = {
        (0, 1): MotionGroupKind.SCREW,
        (1, 1): MotionGroupKind.SCREW,
        (0, 2): MotionGroupKind.TRANSLATIONS,
        (0, 3): MotionGroupKind.TRANSLATIONS,
        (1, 2): MotionGroupKind.CYLINDER,
        (1, 3): MotionGroupKind.PLANE,
        (3, 3): MotionGroupKind.SPHERE,
        (1, 4): MotionGroupKind.PARALLEL,
        (3, 6): MotionGroupKind.SPACE,
    }
    kind = kinds.get((turning, dimension), MotionGroupKind.OTHER)
    if kind is MotionGroupKind.PLANE and not _plane(basis):
        kind = MotionGroupKind.SCREWS
    return MotionGroup(kind, dimension)


def _plane(basis: Reals) -> bool:
    """Whether the shifts of a group with one direction of turning are at right angles to it: no screw is among them."""
    axis = np.linalg.svd(basis[:, :3])[2][0]
    return bool(abs(basis[:, 3:] @ axis).max() < _SAME)
