"""The equations that close the joints of a linkage, with their Jacobian; without unit, in any of the three spaces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value, same
from gruebler.mechanics.screws.closing_rows import Bent, WheelAxes, joint_rows
from gruebler.mechanics.screws.joint_places import JointPlace
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.screws.rigid_motions import exponential, exponential_rate, inverse_motion
from gruebler.mechanics.screws.wheels import mesh_row
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism

CLOSED = 1e-12
"""Sizes and radians: joints that are open by less are closed.

Newton's method leaves some 1e-15, and at a double root, where the pose is known to 1e-8 only, its square: so 1e-12 is
rounding, and 1e-9 is a gap.
"""
RANK = 1e-9
"""Of the largest singular value: on the way to a closed pose equations that add less are taken as repetitions.

Redundant constraints repeat others up to what is still open, and a step along smaller singular values would be longer
than the way that is left.
"""
TINY = 1e-300
"""What a divisor is at least, so that 0/0 is 0."""
_SETTLED = 1e-13  # sizes and radians: one step more would change rounding only

_COLUMNS = {Space.PLANAR: [2, 3, 4], Space.SPHERICAL: [0, 1, 2], Space.SPATIAL: [0, 1, 2, 3, 4, 5]}


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class JointFrames:
    """A joint between two of its links, with its frame on each; lengths in units of the linkage's size."""

    joint: int
    first: int
    second: int
    on_first: Reals
    on_second: Reals
    place: JointPlace
    """Pitch and radii, in units of the linkage's size."""
    wheels: WheelAxes | None = None
    """Of a contact of teeth in space."""


class Closing:
    """The rows of all joints as a function of where the links are.

    A *pose* is an array (n, 4, 4), the frame's link in its place. A *motion* of the links is a vector of b numbers for
    each moving link: its twist about the origin, velocities divided by the size.
    """

    def __init__(self, mechanism: Mechanism, ties: Sequence[JointFrames], reference: Reals) -> None:
        chain = mechanism.chain
        self.mechanism = mechanism
        self.reference = reference
        self.columns = np.array(_COLUMNS[chain.space])
        self.ties = tuple(ties)
        self.moving = np.array([k for k, link in enumerate(chain.links) if link != mechanism.frame])
        self._first = np.array([tie.first for tie in ties])
        self._second = np.array([tie.second for tie in ties])
        self._on_first = np.stack([tie.on_first for tie in ties])
        self._on_second = np.stack([tie.on_second for tie in ties])
        owners: list[int] = []
        weights: list[Reals] = []
        self._bent: list[tuple[int, Bent]] = []
        for k, tie in enumerate(ties):
            for row in joint_rows(chain.joints[tie.joint].pair, chain.space, tie.place, tie.wheels):
                if callable(row):
                    self._bent.append((len(owners), row))
                owners.append(k)
                weights.append(np.zeros((4, 4)) if callable(row) else row)
        self._owner = np.array(owners)
        self._weights = np.stack(weights)
        self.joint_of_row = np.array([ties[k].joint for k in owners])

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Closing):
            return NotImplemented
        return self.mechanism.written_form == other.mechanism.written_form and same(
            (self.ties, self.reference), (other.ties, other.reference)
        )

    def __hash__(self) -> int:
        return hash((self.mechanism, self.reference.shape))

    @classmethod
    def of(cls, linkage: SpatialLinkage) -> Closing:
        """The equations of a linkage with joint screws; a pose in the reference pose is n identities."""
        chain = linkage.mechanism.chain
        size = linkage.size
        frames = linkage.frames.copy()
        if chain.space is not Space.SPHERICAL:
            frames[:, :3, 3] = (frames[:, :3, 3] - linkage.centre) / size
        ties = []
        for number, (joint, place) in enumerate(zip(chain.joints, linkage.places, strict=True)):
            radii = place.radii
            if radii is not None and chain.space is not Space.SPHERICAL:
                radii = radii[0] / size, radii[1] / size
            scaled = JointPlace(pitch=place.pitch / size, radii=radii, pressure=place.pressure)
            first = chain.index(joint.links[0])
            for link in joint.links[1:]:
                ties.append(
                    JointFrames(
                        joint=number,
                        first=first,
                        second=chain.index(link),
                        on_first=frames[number],
                        on_second=frames[number],
                        place=scaled,
                        wheels=mesh_row(linkage, number, size),
                    )
                )
        return cls(linkage.mechanism, ties, np.tile(np.eye(4), (chain.n, 1, 1)))

    @property
    def unknowns(self) -> int:
        """The number b (n - 1)."""
        return len(self.moving) * len(self.columns)

    @property
    def equations(self) -> int:
        """The number of rows, the sum of u over the joints."""
        return len(self._owner)

    def seen(self, pose: Reals) -> Reals:
        """For each tie the second link's joint frame as seen from the first link's, (ties, 4, 4)."""
        relative: Reals = inverse_motion(pose[self._first] @ self._on_first) @ (pose[self._second] @ self._on_second)
        return relative

    def _evaluated(self, pose: Reals) -> tuple[Reals, Reals]:
        e = self.seen(pose)[self._owner]
        weights = self._weights
        value = np.einsum("cij,cij->c", weights, e)
        if self._bent:
            weights = weights.copy()
            for k, row in self._bent:
                value[k], weights[k] = row(e[k])
        return value, weights

    def residual(self, pose: Reals) -> Reals:
        """By how much the joints are open, (equations,)."""
        return self._evaluated(pose)[0]

    def linearised(self, pose: Reals) -> tuple[Reals, Reals]:
        """Residual (equations,) and its derivative by the motion of the links, (equations, unknowns)."""
        value, weights = self._evaluated(pose)
        left = inverse_motion(pose[self._first] @ self._on_first)[self._owner]
        right = (pose[self._second] @ self._on_second)[self._owner]
        m = np.swapaxes(left, 1, 2) @ weights @ np.swapaxes(right, 1, 2)
        turn = np.stack([m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]], axis=1)
        by_twist = np.concatenate([turn, m[:, :3, 3]], axis=1)[:, self.columns]
        gradients = np.zeros((self.equations, len(pose), len(self.columns)))
        every = np.arange(self.equations)
        gradients[every, self._second[self._owner]] = by_twist
        gradients[every, self._first[self._owner]] -= by_twist
        return value, gradients[:, self.moving].reshape(self.equations, self.unknowns)

    def twists(self, motion: Reals) -> Reals:
        """The twists (n, 6) of all links in a motion (unknowns,)."""
        twists = np.zeros((len(self.reference), 6))
        twists[np.ix_(self.moving, self.columns)] = motion.reshape(len(self.moving), len(self.columns))
        return twists

    def moved(self, pose: Reals, motion: Reals) -> Reals:
        """The pose after every link has moved along its own twist for a unit of time."""
        moved: Reals = exponential(self.twists(motion)) @ pose
        return moved

    def along(self, pose: Reals, motion: Reals) -> tuple[Reals, Reals]:
        """Residual at `moved(pose, motion)`, and its derivative by the motion's numbers: (equations, unknowns)."""
        value, by_twist = self.linearised(self.moved(pose, motion))
        rate = exponential_rate(self.twists(motion))[np.ix_(self.moving, self.columns, self.columns)]
        blocks = by_twist.reshape(self.equations, len(self.moving), len(self.columns))
        return value, np.einsum("cmi,mij->cmj", blocks, rate).reshape(self.equations, self.unknowns)

    def settled(self, pose: Reals, *, tolerance: float = _SETTLED, most: int = 30) -> Reals:
        """The nearest closed pose by Gauss and Newton's method; what it reached if the joints cannot be closed."""
        best, least = pose, np.inf
        for _ in range(most):
            value, by_twist = self.linearised(pose)
            gap = float(abs(value).max(initial=0.0))
            if gap < least:
                best, least = pose, gap
            if gap <= tolerance or not np.isfinite(gap):
                break
            step = np.linalg.lstsq(by_twist, -value, rcond=RANK)[0]
            pose = self.moved(pose, step * min(1.0, 1.0 / max(abs(step).max(), TINY)))
        return best
