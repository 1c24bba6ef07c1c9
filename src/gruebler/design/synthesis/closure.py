"""The closing conditions of any linkage of turning and sliding joints, differentiated by poses and by dimensions.

C(q, p) = 0 with the places and angles q of the moving links and the coordinates p of all joints on their links; so a
pose changes with the dimensions by dq = -C_q^+ C_p dp (theorem of implicit functions). docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import SynthesisError
from gruebler.mechanics.kinematics import Poses
from gruebler.mechanics.linkages import Linkage, with_lower_pairs
from gruebler.mechanics.linkages.elements import Pose2D


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class PoseDerivatives:
    """Poses, and how they change."""

    program: tuple[NDArray[np.int64], Reals, Reals, float]
    """What the core takes: joints, poses, dimensions, and at which distance a point moves as far as its link turns."""
    motion: Reals
    """(poses, unknowns, freedoms) how the poses move while no dimension changes."""

    def gradient(self, by_pose: Reals) -> Reals:
        """How quantities of the poses change with the dimensions, while the poses do not move along their freedom.

        Args:
            by_pose: (poses, quantities, unknowns) the derivatives of the quantities by the pose.

        Returns (poses, quantities, dimensions): by the transposed Jacobian, so that the cost grows with the number of
        quantities and hardly with the number of dimensions.
        """
        every = np.broadcast_to(by_pose, (len(self.motion), *by_pose.shape[1:]))
        return _core.pose_gradients(*self.program, np.ascontiguousarray(every))


class DesignClosure:
    """The conditions of a linkage; lengths are in the units of the linkage.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> closure = DesignClosure(FourBar(25, 70, 40, 70).linkage())
    >>> closure.equations, closure.unknowns, len(closure.sizes)
    (8, 9, 16)
    """

    def __init__(self, linkage: Linkage) -> None:
        lower = with_lower_pairs(linkage)
        chain, frame = lower.mechanism.chain, lower.mechanism.frame
        wrong = [joint.pair.name for joint in chain.joints if not joint.pair.is_basic]
        if wrong:
            raise SynthesisError(
                "linkages of turning and sliding joints are fitted, not those with {wrong} joints", wrong=wrong[0]
            )
        self.linkage = lower
        self.links = tuple(link for link in chain.links if link != frame)
        self.column = {link: 3 * k for k, link in enumerate(self.links)}
        self.keys = tuple(sorted(lower.elements, key=lambda key: (key[0], chain.index(key[1]))))
        self.start: dict[tuple[int, str], int] = {}
        sizes: list[float] = []
        for key in self.keys:
            element = lower.elements[key]
            self.start[key] = len(sizes)
            sizes += element.place
        self.sizes = np.array(sizes)
        joints = [
            ((number, joint.links[0]), (number, other))
            for number, joint in enumerate(chain.joints)
            for other in joint.links[1:]
        ]
        frame_body = len(self.links)
        self.joints = np.array(
            [
                [
                    *(self.column.get(link, 3 * frame_body) // 3 for _, link in both),
                    *(self.start[key] for key in both),
                    chain.joints[both[0][0]].pair.is_sliding,
                ]
                for both in joints
            ],
            np.int64,
        )
        """(joints, 5) two bodies, the frame last; the dimensions that are x on them; whether it slides."""
        self.equations = 2 * len(joints)
        self.unknowns = 3 * len(self.links)

    def poses(self, solved: Poses) -> Reals:
        """(rows, unknowns) of positions on a circuit."""
        unknowns = np.empty((len(solved), self.unknowns))
        for link, c in self.column.items():
            k = solved.lower.mechanism.chain.links.index(link)
            z = solved.places[0, :, k]
            unknowns[:, c], unknowns[:, c + 1], unknowns[:, c + 2] = z.real, z.imag, solved.angles[:, k]
        return unknowns

    def drive_values(self, q: Reals, p: Reals) -> Reals:
        """(poses, drives) the values of all drives as `move` takes them, turning ones without jumps from row to row."""
        columns = []
        chain = self.linkage.mechanism.chain
        for number, drive in enumerate(self.linkage.mechanism.drives):
            first, other = self.linkage.reference(number)
            if drive.turning:
                angles = [q[:, self.column[link] + 2] if link in self.column else 0.0 for link in (first, other)]
                columns.append(np.unwrap(angles[1] - angles[0]))
                continue
            joint = chain.joints[drive.joint]
            own, far = (self._line(q, p, drive.joint, link) for link in (first, other))
            assert joint.pair.is_sliding
            columns.append(np.real(np.conj(own[1]) * (far[0] - own[0])))
        return np.stack(columns, axis=1)

    def _line(self, q: Reals, p: Reals, joint: int, link: str) -> tuple[Complexes, Complexes]:
        """The point and the direction of a link's line in a sliding joint, at poses."""
        at = self.start[joint, link]
        point, direction = np.full(len(q), complex(p[at], p[at + 1])), np.full(len(q), np.exp(1j * p[at + 2]))
        if link not in self.column:
            return point, direction
        c = self.column[link]
        turn = np.exp(1j * q[:, c + 2])
        return q[:, c] + 1j * q[:, c + 1] + turn * point, turn * direction

    def derivatives(self, q: Reals, p: Reals, *, size: float) -> PoseDerivatives:
        """How poses change. Cost: 1 us a pose of a six-bar.

        Args:
            q: (poses, unknowns).
            p: (dimensions,).
            size: at this distance from its link's origin a point moves as far as the link turns.
        """
        program = self.joints, np.ascontiguousarray(q), p, float(size)
        return PoseDerivatives(program=program, motion=_core.move_poses(*program))

    def closed(self, q: Reals, p: Reals, *, size: float, steps: int = 12) -> tuple[Reals, NDArray[np.bool_]]:
        """The nearest closed poses, by Newton's method with least steps; and which of them were reached.

        Cost: 4 us a pose of a six-bar.
        """
        return _core.close_poses(self.joints, np.ascontiguousarray(q), p, float(size), steps)

    def with_sizes(self, p: Reals, points: dict[str, tuple[str, float, float]], pose: Reals) -> Linkage:
        """The linkage of other dimensions, standing in a pose."""
        elements: dict[str, dict[str | int, object]] = {link: {} for link in self.linkage.mechanism.chain.links}
        for key in self.keys:
            at = self.start[key]
            element = self.linkage.elements[key]
            elements[key[1]][key[0]] = element.placed(*p[at : at + len(element.place)].tolist())
        places = {link: Pose2D(*(float(v) for v in pose[c : c + 3])) for link, c in self.column.items()}
        places[self.linkage.mechanism.frame] = Pose2D(0.0, 0.0, 0.0)
        return Linkage(
            self.linkage.mechanism,
            elements,
            points=points,
            unit=self.linkage.unit,
            reference_pose={link: tuple(place) for link, place in places.items()},  # type: ignore[misc]
            outputs=self.linkage.outputs,
        )
