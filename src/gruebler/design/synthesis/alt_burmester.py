"""Alt-Burmester problems: all four-bars through so many positions and points, by following stored generic solutions.

`Problem` is one of the finite ones. Its generic solutions were found once by monodromy (tests/design/synthesis) and are
data of the package; `solutions` carries them to a task, tries paths again that failed, and certifies each end by an
interval Newton step, so that the answer says how many of how many are accounted for. docs/theory/synthesis-points.md.
"""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from io import BytesIO
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Integers
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis.endgame import path_ends
from gruebler.design.synthesis.results import Progress
from gruebler.design.synthesis.six_bar_guidance import unknowns_of_guides

ARRIVED = 0
"""The status of a path that ended at a finite solution."""
QUICK, CAREFUL = 1e-3, 1e-6
"""How far the corrector may change a prediction: at first, and when paths are followed again."""
_BLOCK = 8  # paths that one thread follows before another may go on: some 10 ms
_ASIDE = 1e-7  # from where a solution is looked for again; a task has the size 1, dyads may be a millionth apart
_REGULAR = 1e-8  # the last relative step of Newton's method at a regular solution; far out rounding leaves so much
_BENDS = (0.02, 0.1, 0.4)
"""How far bent ways lead aside, relative to the task; the last is for all solutions, not only those that were lost."""
_FEW = 0.05  # where more than this part of the paths is lost, the task itself is special, not the way to it
_SAME = 1e-7  # relative: solutions nearer to each other are one
_NEAR = 1e-4  # an end that arrived and one of the endgame are the same
_TOGETHER = 1e-6  # the same for ends of the endgame, which knows singular ones to nine digits or so


@dataclass(frozen=True, kw_only=True)
class Problem:
    """So many positions (besides the first point or position) and so many points, and its number of solutions."""

    name: str
    poses: int
    points: int
    classes: int
    """How many classes of solutions a general task has."""
    members: int
    """How many solutions, with the order of the dyads, a class has."""
    family: str = ""
    """Of linkages, by the name that the core knows; four-bars without one."""
    one_angle: bool = False
    """Whether the body has the same angle in all positions."""

    @property
    def unknowns(self) -> int:
        """Eight, two more of six-bars through eleven pairs; 10 or 14 of those that guide a body."""
        return unknowns_of_guides(self.poses) if self.guides else max(8, self.points)

    @property
    def guides(self) -> bool:
        """Whether six-bars guide a body through the positions."""
        return self.family == "Watt I"

    @property
    def given_pivots(self) -> bool:
        """Whether the fixed pivots are given."""
        return 2 * self.poses + self.points < 8

    def marks(self, z: Complexes) -> Complexes:
        """Numbers that are the same for all members of a class and differ between classes: (solutions, marks)."""
        if self.family:
            return z
        x, xc, y, yc, a, ac, b, bc = z.T
        if self.given_pivots:
            return np.stack([x, y, xc, yc], axis=1)
        if self.poses:  # the dyads can be exchanged
            return np.stack([a + b, a * b, x + y, x * y, xc * yc, a * x + b * y], axis=1)
        # Roberts: the three fixed pivots are those of the three cognates.
        with np.errstate(all="ignore"):
            c, cc = (a * y - b * x) / (y - x), (ac * yc - bc * xc) / (yc - xc)
        return np.stack([a + b + c, a * b + b * c + c * a, ac + bc + cc], axis=1)


PROBLEMS = (
    Problem(name="nine points", poses=0, points=8, classes=1442, members=6),
    Problem(name="two positions and six points", poses=1, points=6, classes=1112, members=2),
    Problem(name="three positions and four points", poses=2, points=4, classes=201, members=2),
    Problem(name="four positions and two points", poses=3, points=2, classes=30, members=2),
    Problem(name="five points and two fixed pivots", poses=0, points=4, classes=36, members=1),
)
"""The finite problems with stored solutions; five positions are solved in closed form."""


def parameters(
    displacements: Complexes, rotations: Complexes, pivots: tuple[complex, complex] | None = None
) -> Complexes:
    """The parameters of a real task: displacements of all positions, then points; rotations of the positions."""
    p = np.zeros((4, 8), np.complex128)
    p[0, : len(displacements)] = displacements
    p[1, : len(displacements)] = np.conj(displacements)
    p[2, : len(rotations)] = rotations - 1
    if pivots is not None:
        p[3, 4:] = pivots[0], np.conj(pivots[0]), pivots[1], np.conj(pivots[1])
    return p


class GenericSolutions(NamedTuple):
    """A generic task and all its solutions, one of each class."""

    parameters: Complexes
    z: Complexes


def stored_solutions(problem: Problem) -> GenericSolutions:
    """The generic task and its solutions as they are stored: complex[4, 8], complex64[classes, 8]."""
    name = problem.name.replace(" ", "_")
    raw = (files("gruebler.design.synthesis") / "data" / f"{name}.npz").read_bytes()
    with np.load(BytesIO(raw)) as stored:
        return GenericSolutions(stored["parameters"], stored["solutions"])


@cache
def load_generic_solutions(problem: Problem) -> GenericSolutions:
    """The stored solutions, sharpened to full precision."""
    p, stored = stored_solutions(problem)
    z = stored.astype(np.complex128)
    z, steps = _core.refine_solutions(z, p, problem.poses, problem.points, family=problem.family)
    if not (steps < 1e-10).all():
        raise SynthesisError("the stored solutions of {name} are damaged", name=problem.name)
    return GenericSolutions(p, z)


@dataclass(frozen=True, slots=True, kw_only=True)
class Solutions:
    """The complex solutions of a task, one of each class."""

    z: Complexes
    """(found, 8) finite and regular ones."""
    certified: NDArray[np.bool_]
    """(found,) which of them are proved to be solutions, each a different one."""
    multiple: Complexes
    """(distinct, 8) singular ones, known to about half the digits."""
    infinite: int
    """How many paths go to infinity."""
    singular: int
    """How many paths end at singular solutions: several at one of them, or at one of infinitely many."""
    missing: int
    """How many paths are not resolved: they could not be followed, and where they end is not known."""

    @property
    def real(self) -> Complexes:
        """(real, 8) those that are real linkages."""
        z = np.concatenate([self.z, self.multiple])
        gaps = np.abs(z[:, 1::2] - np.conj(z[:, ::2])).max(axis=1)
        return np.asarray(z[gaps <= 1e-7 * (1 + np.abs(z).max(axis=1))])


def follow_from_generic(
    problem: Problem,
    starts: Complexes,
    begin: Complexes,
    end: Complexes,
    loose: float,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> tuple[Complexes, Integers]:
    """Ends and statuses of all paths; threads share them, the answer does not depend on how many there are."""
    ends, status = np.empty_like(starts), np.empty(len(starts), np.int64)
    blocks = [slice(k, k + _BLOCK) for k in range(0, len(starts), _BLOCK)]

    def run(part: slice) -> None:
        ends[part], status[part], _ = _core.track(
            starts[part], begin, end, problem.poses, problem.points, loose, family=problem.family
        )

    workers = max(1, min(threads or os.cpu_count() or 1, len(blocks)))
    done = 0
    with ThreadPoolExecutor(workers) as pool:
        for part, _ in zip(blocks, pool.map(run, blocks), strict=True):
            done = min(part.stop, len(starts))
            if progress is not None:
                progress(done, len(starts))
    return ends, status


def solutions(
    problem: Problem,
    p: Complexes,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Solutions:
    """All solutions of a task whose displacements are of the order of 1.

    Paths that fail, and those whose ends coincide, are followed again with fine steps, then to where an endgame says
    how they end. What is still missing is sought along other ways through the space of tasks. Cost: 1442 paths 1 s on
    one core, and some seconds where the endgame is needed.
    """
    base = load_generic_solutions(problem)
    ends, status = follow_from_generic(problem, base.z, base.parameters, p, QUICK, threads=threads, progress=progress)
    again = (status != ARRIVED) | repeated(problem, ends, status == ARRIVED)
    if again.any():
        ends[again], status[again] = follow_from_generic(
            problem, base.z[again], base.parameters, p, CAREFUL, threads=threads
        )
    arrived = status == ARRIVED
    lost = ~arrived | repeated(problem, ends, arrived)
    doubtful = ~lost
    doubtful[doubtful] = ~_core.certify(ends[doubtful], p, problem.poses, problem.points)
    if doubtful.any():  # paths end with residuals of double precision
        sharp = ends[doubtful]
        sharpened(problem, sharp, p)
        same = np.abs(sharp - ends[doubtful]).max(axis=1) < _NEAR
        ends[doubtful] = np.where(same[:, None], sharp, ends[doubtful])
        doubtful[doubtful] = ~_core.certify(ends[doubtful], p, problem.poses, problem.points)
    outcome = _outcome(problem, base, p, lost | doubtful, threads)
    # What arrived, though it is not certified, is believed if it is regular, unless the endgame finds others, or
    # branches, at its end.
    unsure = ends[lost | doubtful]
    near = np.abs(outcome.z - unsure).max(axis=1, initial=0.0) < _NEAR
    single = doubtful[lost | doubtful] & ~(outcome.several & near) & _regular(problem, unsure, p)
    lost |= doubtful
    lost[np.flatnonzero(lost)[single]] = False
    outcome = outcome.without(single)
    regular = np.concatenate([ends[~lost], outcome.z[outcome.regular]])
    sharpened(problem, regular, p)
    regular = distinct(problem, regular)
    missing = problem.classes - len(regular) - outcome.infinite - outcome.singular
    rng = np.random.default_rng(20_231_107)  # fixed: the same task has the same answer
    for bend in _BENDS:
        if missing <= 0 or missing > _FEW * problem.classes:
            break
        # A way that is bent a little meets no singular task that the straight one passes too closely.
        middle = (base.parameters + p) / 2 + bend * _random_task(base.parameters, p, rng)
        starts, loose = (base.z, QUICK) if bend == _BENDS[-1] else (base.z[lost], CAREFUL)
        halfway, status = follow_from_generic(problem, starts, base.parameters, middle, loose, threads=threads)
        ends, status = follow_from_generic(problem, halfway[status == ARRIVED], middle, p, loose, threads=threads)
        more = ends[status == ARRIVED]
        more = more[_regular(problem, more, p)]
        sharpened(problem, more, p)
        regular = distinct(problem, np.concatenate([regular, more]))
        missing = problem.classes - len(regular) - outcome.infinite - outcome.singular
    proved = _core.certify(regular, p, problem.poses, problem.points)
    multiple = distinct(problem, outcome.multiple)
    return Solutions(
        z=regular,
        certified=proved,
        multiple=multiple,
        infinite=outcome.infinite,
        singular=outcome.singular,
        missing=max(missing, 0),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Outcome:
    """How paths end that did not arrive, or may not have."""

    z: Complexes
    """(paths, 8)"""
    resolved: NDArray[np.bool_]
    """(paths,) whether the endgame knows how the path ends."""
    at_infinity: NDArray[np.bool_]
    regular: NDArray[np.bool_]
    several: NDArray[np.bool_]
    """(paths,) whether several paths, or several branches of one, end there."""

    @property
    def infinite(self) -> int:
        return int(np.count_nonzero(self.at_infinity))

    @property
    def multiple(self) -> Complexes:
        """The singular solutions where paths end, once for each path."""
        return self.z[self.resolved & ~self.at_infinity & ~self.regular]

    @property
    def singular(self) -> int:
        return len(self.multiple)

    def without(self, paths: NDArray[np.bool_]) -> _Outcome:
        kept = ~paths
        return _Outcome(
            z=self.z[kept],
            resolved=self.resolved[kept],
            at_infinity=self.at_infinity[kept],
            regular=self.regular[kept],
            several=self.several[kept],
        )


def _outcome(
    problem: Problem, base: GenericSolutions, p: Complexes, lost: NDArray[np.bool_], threads: int | None
) -> _Outcome:
    """The ends of paths by the endgame."""

    def follow(starts: Complexes, begin: Complexes, end: Complexes) -> tuple[Complexes, NDArray[np.bool_]]:
        ends, status = follow_from_generic(problem, starts, begin, end, CAREFUL, threads=threads)
        return ends, status == ARRIVED

    if not lost.any():
        none = np.zeros(0, bool)
        return _Outcome(z=base.z[:0], resolved=none, at_infinity=none, regular=none, several=none)
    ends = path_ends(base.z[lost], base.parameters, p, follow)
    resolved = ends.winding > 0
    finite = np.flatnonzero(resolved & ~ends.infinite)
    regular = np.zeros(len(resolved), bool)
    regular[finite] = _regular(problem, ends.z[finite], p)
    together = np.zeros(len(resolved), bool)
    together[finite[_pairs(problem, ends.z[finite], _TOGETHER).ravel()]] = True
    several = resolved & ~ends.infinite & (together | (ends.winding > 1))
    # Newton's method may converge where paths end together; such an end is singular all the same.
    return _Outcome(z=ends.z, resolved=resolved, at_infinity=ends.infinite, regular=regular & ~several, several=several)


def _regular(problem: Problem, z: Complexes, p: Complexes) -> NDArray[np.bool_]:
    """Which solutions are regular: from two places a little aside Newton's method comes to the same one.

    To a double solution it comes too slowly, half the way with each step; on a curve of solutions it ends elsewhere.
    """
    aside = _ASIDE * np.exp(2j * np.pi * np.arange(z.size).reshape(z.shape) / 7)
    first, second = z + aside, z - aside
    converged = sharpened(problem, first, p) & sharpened(problem, second, p)
    apart = np.abs(first - second).max(axis=1, initial=0.0)
    return np.asarray(
        converged & (apart <= 1e-3 * _ASIDE) & (np.abs(first - z).max(axis=1, initial=0.0) <= 10 * _ASIDE)
    )


def sharpened(problem: Problem, z: Complexes, p: Complexes) -> NDArray[np.bool_]:
    """Solutions by Newton's method, in place, and which of them are regular: it converges to the last digits."""
    z[:], steps = _core.refine_solutions(z, p, problem.poses, problem.points, family=problem.family)
    return np.asarray(steps < _REGULAR)


def _random_task(begin: Complexes, end: Complexes, rng: np.random.Generator) -> Complexes:
    """A random complex task of the size of two others, with the same parameters in use."""
    size = np.maximum(np.abs(begin), np.abs(end))
    return np.asarray(size * (rng.normal(size=size.shape) + 1j * rng.normal(size=size.shape)))


def _levelled(marks: Complexes) -> Complexes:
    """Marks with logarithmic modulus, so that equal gaps are equal relative differences, of large solutions too."""
    size = np.abs(marks)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where(size > 0, marks / size * np.log1p(size), 0))


def _pairs(problem: Problem, z: Complexes, near: float = _SAME) -> Integers:
    """Pairs of solutions of one class: (pairs, 2). In the order of their first mark, which few others are near to."""
    marks = _levelled(problem.marks(z))
    flat = np.nan_to_num(np.concatenate([marks.real, marks.imag], axis=1), nan=9.0)
    order = np.argsort(flat[:, 0], kind="stable")
    flat = flat[order]
    places = np.arange(len(flat))
    behind = np.searchsorted(flat[:, 0], flat[:, 0] + near, side="right") - places - 1
    first = np.repeat(places, behind)
    second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(behind) - behind, behind)
    close = np.linalg.norm(flat[first] - flat[second], axis=1) <= near
    return np.stack([order[first[close]], order[second[close]]], axis=1)


def repeated(problem: Problem, z: Complexes, arrived: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which of those that arrived are in the class of another one."""
    alike = np.zeros(len(z), bool)
    where = np.flatnonzero(arrived)
    alike[where[_pairs(problem, z[arrived]).ravel()]] = True
    return alike


def distinct(problem: Problem, z: Complexes) -> Complexes:
    """One solution of each class."""
    pairs = _pairs(problem, z)
    keep = np.ones(len(z), bool)
    if len(pairs):
        keep[pairs.max(axis=1)] = False
    return z[keep]
