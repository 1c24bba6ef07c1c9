"""The closing conditions of any linkage of turning and sliding joints, differentiated by poses and by dimensions.

C(q, p) = 0 with the places and angles q of the moving links and the coordinates p of all joints on their links; so a
pose changes with the dimensions by dq = -C_q^+ C_p dp (theorem of implicit functions). docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.arrays import Complexes, Reals
from gruebler.errors import SynthesisError
from gruebler.kinematics import Poses
from gruebler.linkages import Line, Linkage, with_lower_pairs
from gruebler.linkages.elements import Element, Pin, Pose2D

__all__ = ["ClosureSlopes", "DesignClosure"]


class ClosureSlopes(NamedTuple):
    """A pose and how it changes."""

    gaps: Reals
    """(poses, equations) how far the joints are from closed."""
    by_pose: Reals
    """(poses, equations, unknowns)"""
    by_sizes: Reals
    """(poses, equations, dimensions)"""


class DesignClosure:
    """The conditions of a linkage; lengths are in the units of the linkage.

    >>> from gruebler.fourbar import FourBar
    >>> closure = DesignClosure(FourBar(25, 70, 40, 70).linkage())
    >>> closure.equations, closure.unknowns, len(closure.sizes)
    (8, 9, 16)
    """

    def __init__(self, linkage: Linkage) -> None:
        lower = with_lower_pairs(linkage)
        chain, frame = lower.mechanism.chain, lower.mechanism.frame
        wrong = [joint.pair.name for joint in chain.joints if joint.pair.name not in ("revolute", "prismatic")]
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
            sizes += [element.x, element.y, *([element.angle] if isinstance(element, Line) else [])]
        self.sizes = np.array(sizes)
        self.joints = [
            (joint.pair.name == "prismatic", (number, joint.links[0]), (number, other))
            for number, joint in enumerate(chain.joints)
            for other in joint.links[1:]
        ]
        self.equations = 2 * len(self.joints)
        self.unknowns = 3 * len(self.links)

    def poses(self, found: Poses) -> Reals:
        """(rows, unknowns) of positions on a circuit."""
        out = np.empty((len(found), self.unknowns))
        for link, c in self.column.items():
            k = found.lower.mechanism.chain.links.index(link)
            z = found.places[0, :, k]
            out[:, c], out[:, c + 1], out[:, c + 2] = z.real, z.imag, found.angles[:, k]
        return out

    def _carried(self, key: tuple[int, str], q: Reals, p: Reals) -> tuple[Complexes, Complexes, Complexes]:
        """A joint's point on a link: where it is; the link's turn; the point in the link."""
        at = self.start[key]
        local = complex(p[at], p[at + 1])
        if key[1] not in self.column:
            one = np.ones(len(q), np.complex128)
            return local * one, one, local * one
        c = self.column[key[1]]
        turn = np.exp(1j * q[:, c + 2])
        return q[:, c] + 1j * q[:, c + 1] + turn * local, turn, np.full(len(q), local)

    def slopes(self, q: Reals, p: Reals) -> ClosureSlopes:
        """Residuals and both Jacobians at poses. Cost: about 20 us and 2 us a pose and joint."""
        count = len(q)
        gaps = np.zeros((count, self.equations))
        by_pose = np.zeros((count, self.equations, self.unknowns))
        by_sizes = np.zeros((count, self.equations, len(p)))
        for number, (sliding, one, two) in enumerate(self.joints):
            row = 2 * number
            (w1, t1, e1), (w2, t2, e2) = self._carried(one, q, p), self._carried(two, q, p)
            gap = w2 - w1
            if sliding:
                own, far = self.start[one] + 2, self.start[two] + 2
                turned = t1 * np.exp(1j * p[own])
                other = t2 * np.exp(1j * p[far])
                factor = -1j * np.conj(turned)  # the part across the slide is the real part of factor * gap
                between = np.conj(turned) * other
                gaps[:, row], gaps[:, row + 1] = np.real(factor * gap), between.imag
                across = np.real(np.conj(turned) * gap)  # minus the derivative of the first by the slide's angle
                for key, sign, place in ((one, -1.0, own), (two, 1.0, far)):
                    by_sizes[:, row + 1, place] = sign * between.real
                    if key[1] in self.column:
                        by_pose[:, row + 1, self.column[key[1]] + 2] = sign * between.real
                by_sizes[:, row, own] -= across
                if one[1] in self.column:
                    by_pose[:, row, self.column[one[1]] + 2] -= across
                parts = (np.real,)
                factors = (factor,)
            else:
                gaps[:, row], gaps[:, row + 1] = gap.real, gap.imag
                parts = (np.real, np.imag)  # type: ignore[assignment]
                factors = (np.ones(count, np.complex128),) * 2  # type: ignore[assignment]
            for k, (part, by) in enumerate(zip(parts, factors, strict=True)):
                for key, sign, turn, local in ((one, -1.0, t1, e1), (two, 1.0, t2, e2)):
                    at = self.start[key]
                    by_sizes[:, row + k, at] += sign * part(by * turn)
                    by_sizes[:, row + k, at + 1] += sign * part(by * 1j * turn)
                    if key[1] in self.column:
                        c = self.column[key[1]]
                        by_pose[:, row + k, c] += sign * part(by)
                        by_pose[:, row + k, c + 1] += sign * part(by * 1j)
                        by_pose[:, row + k, c + 2] += sign * part(by * 1j * turn * local)
        return ClosureSlopes(gaps, by_pose, by_sizes)

    def closed(self, q: Reals, p: Reals, *, size: float, steps: int = 12) -> tuple[Reals, NDArray[np.bool_]]:
        """The nearest closed poses, by Newton's method with least steps; and which of them were reached."""
        weights = self._weights(size)
        good = np.zeros(len(q), bool)
        for _ in range(steps):
            closure_slopes = self.slopes(q, p)
            good = np.abs(closure_slopes.gaps).max(axis=1) < 1e-12 * size
            if good.all():
                break
            step = self._least(closure_slopes.by_pose * weights, closure_slopes.gaps)
            q = q - weights * step
        return q, good

    def _weights(self, size: float) -> Reals:
        """An angle counts as the way of a point at the distance of the size."""
        return np.tile([size, size, 1.0], len(self.links))

    @staticmethod
    def _least(matrix: Reals, right: Reals) -> Reals:
        return np.asarray((np.linalg.pinv(matrix, rcond=1e-10) @ right[..., None])[..., 0])

    def tangents(self, q: Reals, p: Reals, *, size: float) -> tuple[Reals, Reals]:
        """How the poses move by the one freedom, (rows, unknowns), and with the dimensions, (rows, unknowns, sizes)."""
        weights = self._weights(size)
        closure_slopes = self.slopes(q, p)
        matrix = closure_slopes.by_pose * weights
        by_sizes = -weights[:, None] * (np.linalg.pinv(matrix, rcond=1e-10) @ closure_slopes.by_sizes)
        _, _, basis = np.linalg.svd(matrix)
        return weights * basis[:, -1, :], np.asarray(by_sizes)

    def with_sizes(self, p: Reals, points: dict[str, tuple[str, float, float]], home: Reals) -> Linkage:
        """The linkage of other dimensions, standing in a pose."""
        elements: dict[str, dict[str | int, object]] = {link: {} for link in self.linkage.mechanism.chain.links}
        for key in self.keys:
            at = self.start[key]
            element: Element = self.linkage.elements[key]
            x, y = float(p[at]), float(p[at + 1])
            made: Element = Line(x, y, float(p[at + 2])) if isinstance(element, Line) else Pin(x, y)
            elements[key[1]][key[0]] = made
        places = {link: Pose2D(*(float(v) for v in home[c : c + 3])) for link, c in self.column.items()}
        places[self.linkage.mechanism.frame] = Pose2D(0.0, 0.0, 0.0)
        return Linkage(
            self.linkage.mechanism,
            elements,
            points,
            unit=self.linkage.unit,
            reference_pose={link: tuple(place) for link, place in places.items()},  # type: ignore[misc]
            outputs=self.linkage.outputs,
        )
