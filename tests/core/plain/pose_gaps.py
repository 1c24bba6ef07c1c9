"""How far the joints of a linkage are from closed in one pose, joint by joint, in plain Python."""

from __future__ import annotations

import cmath

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]


def pose_gaps(joints: NDArray[np.int64], q: Reals, p: Reals) -> Reals:
    """(equations,) of joints as `_core.close_poses` takes them: the points meet, or the lines lie on one another."""
    rows = []
    for *sides, slides in ((row[[0, 2]], row[[1, 3]], row[4]) for row in joints):
        points, lines = [], []
        for body, at in sides:
            x, y, angle = q[3 * body : 3 * body + 3] if 3 * body < len(q) else (0.0, 0.0, 0.0)
            points.append(complex(x, y) + cmath.rect(1, angle) * complex(p[at], p[at + 1]))
            lines.append(cmath.rect(1, angle + p[at + 2]) if slides else 1)
        gap = points[1] - points[0]
        between = lines[1] / lines[0]
        rows += [(gap / lines[0]).imag, between.imag] if slides else [gap.real, gap.imag]
    return np.array(rows)


def pose_slopes(joints: NDArray[np.int64], q: Reals, p: Reals) -> tuple[Reals, Reals]:
    """(equations, unknowns) and (equations, dimensions), by differences on both sides."""

    def by(count: int, moved: object) -> Reals:
        steps = 1e-6 * np.eye(count)
        return np.stack([(moved(step) - moved(-step)) / 2e-6 for step in steps], axis=1)  # type: ignore[operator]

    return (
        by(len(q), lambda step: pose_gaps(joints, q + step, p)),
        by(len(p), lambda step: pose_gaps(joints, q, p + step)),
    )
