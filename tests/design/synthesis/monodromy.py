"""How the stored generic solutions of Alt-Burmester problems are found: by monodromy.

One solution of a random complex task is known by choosing the linkage first. Followed around closed ways in the space
of tasks, it comes back as another solution, and each new one again; when several ways in a row bring nothing new, all
are there: their number is compared with the theorem.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from gruebler import _core
from gruebler.base.arrays import Complexes
from gruebler.design.synthesis.alt_burmester import (
    ARRIVED,
    QUICK,
    GenericSolutions,
    Problem,
    distinct,
    follow_from_generic,
)

_IDLE = 4  # so many ways without anything new: enough
_SHARP = 1e-8  # a last Newton step above it: no solution, or a nearly singular one


def known_solution(problem: Problem, rng: np.random.Generator) -> GenericSolutions:
    """A random complex task with one solution: linkage and rotations are chosen, the displacements follow."""

    def random(*shape: int) -> Complexes:
        return np.asarray(rng.normal(size=shape) + 1j * rng.normal(size=shape))

    z = random(8)
    x, xc, y, yc, a, ac, b, bc = z
    p = np.zeros((4, 8), np.complex128)
    for j in range(problem.poses + problem.points):
        g = complex(random(1)[0])
        h = -g / (1 + g)
        # Both dyads: d k + d* l - d d* + m = 0; their difference is linear.
        k1, l1, m1 = ac - xc - xc * h, a - x - x * g, ac * x * g + a * xc * h
        k2, l2, m2 = bc - yc - yc * h, b - y - y * g, bc * y * g + b * yc * h
        slope, rest = -(k1 - k2) / (l1 - l2), -(m1 - m2) / (l1 - l2)
        roots = np.roots([-slope, k1 + slope * l1 - rest, rest * l1 + m1])
        p[0, j] = roots[rng.integers(2)]
        p[1, j] = slope * p[0, j] + rest
        if j < problem.poses:
            p[2, j] = g
    if problem.given_pivots:
        p[3, 4:] = z[4:]
    return GenericSolutions(p, z[None, :])


def find_generic(
    problem: Problem, seed: int, *, report: Callable[[int, int], None] | None = None, most: int = 200
) -> GenericSolutions:
    """All solutions of a random task; ``report`` gets the number of the way and how many solutions there are."""
    rng = np.random.default_rng(seed)
    p, z = known_solution(problem, rng)
    used = np.abs(p) > 0
    size = 0.7 * np.abs(p[:2][used[:2]]).mean()
    idle = 0
    for trial in range(most):
        corners = [np.where(used, size * (rng.normal(size=p.shape) + 1j * rng.normal(size=p.shape)), 0) for _ in "ab"]
        for corner in corners:
            corner[2] /= size
        ends = z
        for begin, end in zip([p, *corners], [*corners, p], strict=True):
            ends, status = follow_from_generic(problem, ends, begin, end, QUICK)
            ends = ends[status == ARRIVED]
        count = len(z)
        z = distinct(problem, np.concatenate([z, ends]))
        z, steps = _core.refine_solutions(z, p, problem.poses, problem.points)
        z = z[steps < _SHARP]
        idle = idle + 1 if len(z) == count else 0
        if report is not None:
            report(trial, len(z))
        if idle == _IDLE and len(z) > 1:
            break
    return GenericSolutions(p, z)


def write_generic(folder: Path, problem: Problem, solutions: GenericSolutions) -> Path:
    """Store generic solutions as data of the package: in single precision, since reading sharpens them."""
    path = folder / f"{problem.name.replace(' ', '_')}.npz"
    np.savez_compressed(path, parameters=solutions.parameters, solutions=solutions.z.astype(np.complex64))
    return path
