"""The closing conditions of any linkage of turning and sliding joints, differentiated by poses and by dimensions.

C(q, p) = 0 with the places and angles q of the moving links and the coordinates p of all joints on their links; so a
pose changes with the dimensions by dq = -C_q^+ C_p dp (theorem of implicit functions). docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import SynthesisError
from gruebler.mechanics.kinematics import Poses
from gruebler.mechanics.linkages import Linkage, with_lower_pairs
from gruebler.mechanics.linkages.elements import Pose2D


@dataclass(frozen=True, slots=True, kw_only=True)
class _Joined:
    """Both sides of all joints at poses. Each condition is the real part of a factor times the gap, or an angle."""

    turns: tuple[Complexes, Complexes]
    """Of the first and the second link of each joint, (poses, joints)."""
    arms: tuple[Complexes, Complexes]
    """How fast the joint's point moves when its link turns, (poses, joints)."""
    gap: Complexes
    factors: tuple[Complexes, Complexes]
    """Of the two conditions of each joint; the second of a slide has none."""
    between: Complexes
    """(poses, slides) the direction of a slide on the second link seen from the first."""
    along: Reals
    """(poses, slides) the gap along the slide."""

    def __getitem__(self, poses: NDArray[np.bool_]) -> _Joined:
        own, far = (turn[poses] for turn in self.turns)
        first, second = (arm[poses] for arm in self.arms)
        upper, lower = (factor[poses] for factor in self.factors)
        return _Joined(
            turns=(own, far),
            arms=(first, second),
            gap=self.gap[poses],
            factors=(upper, lower),
            between=self.between[poses],
            along=self.along[poses],
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class PoseDerivatives:
    """Poses, and how they change with one factorised Jacobian for each."""

    closure: DesignClosure
    joined: _Joined
    weights: Reals
    """(unknowns,) how much of each unknown counts as one."""
    across: Reals
    """(poses, unknowns, equations) orthonormal directions in which the conditions change."""
    triangle: Reals
    """(poses, equations, equations) the rest of the factorisation."""
    motion: Reals
    """(poses, unknowns, freedoms) how the poses move while no dimension changes."""

    def correction(self, gaps: Reals) -> Reals:
        """The least change of each pose that makes up for gaps: (poses, unknowns)."""
        part = np.linalg.solve(self.triangle.transpose(0, 2, 1), gaps[..., None])
        return np.asarray(self.weights * (self.across @ part)[..., 0])

    def gradient(self, by_pose: Reals) -> Reals:
        """How quantities of the poses change with the dimensions, while the poses do not move along their freedom.

        Args:
            by_pose: (poses, quantities, unknowns) the derivatives of the quantities by the pose.

        Returns (poses, quantities, dimensions): by the transposed Jacobian, so that the cost grows with the number of
        quantities and hardly with the number of dimensions.
        """
        right = self.across.transpose(0, 2, 1) @ (by_pose * self.weights).transpose(0, 2, 1)
        multipliers = np.asarray(np.linalg.solve(self.triangle, right), np.float64).transpose(0, 2, 1)
        return -self.closure.weighted_by_sizes(self.joined, multipliers)


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
        self.frame_column = 3 * len(self.links)
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
        sides = [[joint[side] for joint in joints] for side in (0, 1)]
        self._bodies = [np.array([self.column.get(key[1], self.frame_column) // 3 for key in keys]) for keys in sides]
        self._slides = np.flatnonzero([chain.joints[number].pair.is_sliding for (number, _), _ in joints])
        starts = [np.array([self.start[key] for key in keys], np.int64) for keys in sides]
        self._starts = starts
        moves = [np.flatnonzero(bodies < len(self.links)) for bodies in self._bodies]
        sliding = [np.flatnonzero(bodies[self._slides] < len(self.links)) for bodies in self._bodies]
        self._moves, self._sliding = moves, sliding
        self._lines = [start[self._slides] + 2 for start in starts]
        columns = np.concatenate([starts[0], starts[0] + 1, starts[1], starts[1] + 1, *self._lines])
        self._scatter = np.zeros((len(columns), len(sizes)))
        self._scatter[np.arange(len(columns)), columns] = 1.0
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

    def joined(self, q: Reals, p: Reals) -> _Joined:
        """Both sides of all joints. Cost: about 1 us a pose."""
        count = len(q)
        rows = q.reshape(count, -1, 3)
        place = np.zeros((count, len(self.links) + 1), np.complex128)
        place[:, :-1] = rows[:, :, 0] + 1j * rows[:, :, 1]
        turn = np.ones_like(place)
        turn[:, :-1] = np.exp(1j * rows[:, :, 2])
        own, far = turn[:, self._bodies[0]], turn[:, self._bodies[1]]
        locals_ = [p[start] + 1j * p[start + 1] for start in self._starts]
        arms = own * locals_[0], far * locals_[1]
        gap = place[:, self._bodies[1]] + arms[1] - place[:, self._bodies[0]] - arms[0]
        upper = np.ones_like(gap)
        lower = -1j * upper
        slides = self._slides
        directions = own[:, slides] * np.exp(1j * p[self._lines[0]]), far[:, slides] * np.exp(1j * p[self._lines[1]])
        upper[:, slides] = -1j * np.conj(directions[0])  # across the slide
        lower[:, slides] = 0
        between = np.conj(directions[0]) * directions[1]
        along = np.real(np.conj(directions[0]) * gap[:, slides])
        return _Joined(
            turns=(own, far),
            arms=(1j * arms[0], 1j * arms[1]),
            gap=gap,
            factors=(upper, lower),
            between=between,
            along=along,
        )

    def gaps(self, joined: _Joined) -> Reals:
        """(poses, equations) how far the joints are from closed."""
        gaps = np.empty((len(joined.gap), self.equations))
        for k, factor in enumerate(joined.factors):
            gaps[:, k::2] = np.real(factor * joined.gap)
        gaps[:, 2 * self._slides + 1] = joined.between.imag
        return gaps

    def by_pose(self, joined: _Joined) -> Reals:
        """(poses, equations, unknowns) the derivatives of the gaps by the pose."""
        slopes = np.zeros((len(joined.gap), self.equations, self.unknowns))
        for side, sign in ((0, -1.0), (1, 1.0)):
            moving = self._moves[side]
            column = 3 * self._bodies[side][moving]
            for k, factor in enumerate(joined.factors):
                signed = sign * factor[:, moving]
                row = 2 * moving + k
                slopes[:, row, column] = signed.real
                slopes[:, row, column + 1] = -signed.imag
                slopes[:, row, column + 2] = np.real(signed * joined.arms[side][:, moving])
            slides = self._sliding[side]
            row, column = 2 * self._slides[slides], 3 * self._bodies[side][self._slides[slides]] + 2
            slopes[:, row + 1, column] = sign * joined.between.real[:, slides]
            if side == 0:
                slopes[:, row, column] -= joined.along[:, slides]
        return slopes

    def weighted_by_sizes(self, joined: _Joined, weights: Reals) -> Reals:
        """(poses, sums, dimensions) the derivatives by the dimensions of weighted sums of gaps.

        Args:
            joined: the poses.
            weights: (poses, sums, equations).
        """
        upper, lower = (factor[:, None, :] for factor in joined.factors)
        force = weights[:, :, 0::2] * upper + weights[:, :, 1::2] * lower
        first, second = (force * turn[:, None, :] for turn in joined.turns)
        across, turned = weights[:, :, 2 * self._slides], weights[:, :, 2 * self._slides + 1]
        other = turned * joined.between.real[:, None, :]
        own = -other - across * joined.along[:, None, :]
        return np.asarray(
            np.concatenate([-first.real, first.imag, second.real, -second.imag, own, other], axis=2) @ self._scatter
        )

    def derivatives(self, q: Reals, p: Reals, *, size: float) -> PoseDerivatives:
        """How poses change. Cost: 10 us a pose of a six-bar.

        Args:
            q: (poses, unknowns).
            p: (dimensions,).
            size: at this distance from its link's origin a point moves as far as the link turns.
        """
        return self._derivatives(self.joined(q, p), size)

    def _derivatives(self, joined: _Joined, size: float) -> PoseDerivatives:
        weights = np.tile([size, size, 1.0], len(self.links))
        basis, rest = np.linalg.qr((self.by_pose(joined) * weights).transpose(0, 2, 1), mode="complete")
        triangle = rest[:, : self.equations]
        # A redundant condition leaves a zero in the diagonal: it is left out.
        diagonal = np.abs(np.einsum("nkk->nk", triangle))
        pose, row = np.nonzero(diagonal <= 1e-10 * diagonal.max(axis=1, keepdims=True))
        triangle[pose, row, row] = 1e10 * diagonal.max(axis=1)[pose]
        free = basis[:, :, -max(1, self.unknowns - self.equations) :]
        return PoseDerivatives(
            closure=self,
            joined=joined,
            weights=weights,
            across=basis[:, :, : self.equations],
            triangle=triangle,
            motion=weights[:, None] * free,
        )

    def closed(self, q: Reals, p: Reals, *, size: float, steps: int = 12) -> tuple[Reals, NDArray[np.bool_]]:
        """The nearest closed poses, by Newton's method with least steps; and which of them were reached."""
        q = q.copy()
        open_ = np.arange(len(q))
        for _ in range(steps):
            joined = self.joined(q[open_], p)
            gaps = self.gaps(joined)
            still = np.abs(gaps).max(axis=1) >= 1e-12 * size
            open_, gaps = open_[still], gaps[still]
            if not len(open_) or not np.isfinite(gaps).all():
                break
            q[open_] -= self._derivatives(joined if still.all() else joined[still], size).correction(gaps)
        good = np.ones(len(q), bool)
        good[open_] = False
        return q, good

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
