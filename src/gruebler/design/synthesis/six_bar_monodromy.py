"""All complex six-bars that turn through pairs of angles, listed by monodromy, with a trace test.

A way from one random task to another maps the solutions of one onto those of the other; from one six-bar that is
chosen the ways between four tasks lead to the others. docs/theory/synthesis-functions.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any, NamedTuple
from zipfile import BadZipFile

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Integers
from gruebler.base.atomic_files import atomic_file
from gruebler.design.synthesis.alt_burmester import ARRIVED, CAREFUL, QUICK, Problem, follow_from_generic, sharpened
from gruebler.design.synthesis.six_bar_guidance import TILT, random_guides

UNUSABLE = (OSError, ValueError, KeyError, EOFError, RuntimeError, BadZipFile)
"""What is raised where a file of the cache is damaged, or has something else."""
_TASKS, _PIECE = 4, 2048
_STEPS = 0.3j, 0.3, 0.2 - 0.1j  # of planes in a trace test, relative
_SAME = 1e-6  # relative: solutions nearer to each other are one
_MARK = np.exp(1.234j * np.arange(1, 15) ** 2)  # weights of the numbers of a solution


class Loops(NamedTuple):
    """Of both loops: a constant, the signs of the unknown vectors; what each of those turns with."""

    constants: tuple[int, int]
    signs: tuple[tuple[int, ...], tuple[int, ...]]
    turned: str
    """Q with the input, U with the output, 1 not at all."""

    @property
    def vectors(self) -> int:
        """How many vectors are unknown besides the arms."""
        return len(self.turned)


LOOPS = {
    "Watt II": Loops((1, 1), ((-1, 0), (0, -1)), "QU"),
    "Stephenson II": Loops((-1, -1), ((1, 0, -1), (0, 1, -1)), "QQU"),
    "Stephenson III": Loops((-1, 0), ((1, 0, 0), (1, -1, -1)), "QU1"),
}


@dataclass(frozen=True, kw_only=True)
class LoopVectors:
    """A loop of six-bars in pairs of angles: w + p T has a constant length, T the turn of the shared link."""

    w: Complexes
    """(solutions, pairs)"""
    arm: Complexes
    """(solutions, 1) p"""
    by_output: Complexes
    """(solutions, pairs) the part of w that turns with the output."""


def loop_vectors(
    family: str, vectors: Complexes, ratio: complex, inputs: Complexes, outputs: Complexes
) -> tuple[LoopVectors, LoopVectors]:
    """Both loops of real six-bars (solutions, vectors), in pairs (pairs,) of turns; the ratio for one arm alone."""
    constants, signs, turned = LOOPS[family]
    columns = vectors.T[:, :, None]
    first, *other = columns[len(turned) :]
    turns = {"Q": inputs, "U": outputs, "1": np.ones_like(inputs)}
    loops = []
    arms = first, other[0] if other else ratio * first
    for constant, row, arm in zip(constants, signs, arms, strict=True):
        parts = [sign * each * turns[name] for sign, each, name in zip(row, columns, turned, strict=False)]
        of_output = [part for part, name in zip(parts, turned, strict=True) if name == "U"]
        loops.append(LoopVectors(w=constant + sum(parts), arm=arm, by_output=sum(of_output) + 0 * arm))
    return loops[0], loops[1]


def random_numbers(rng: np.random.Generator, *shape: int) -> Complexes:
    """Complex normal numbers."""
    return np.asarray(rng.normal(size=shape) + 1j * rng.normal(size=shape))


def _lengths(family: str, z: Complexes, ratio: Complexes, turns: Complexes) -> Complexes:
    """The squared lengths of the last links of both loops in a pair each, in isotropic coordinates; (pairs, 2).

    z: (pairs, unknowns); ratio: (pairs, 2), of six-bars with one arm; turns: (pairs, 3) of input, output, shared link.
    """
    constants, signs, turned = LOOPS[family]
    first, *other = np.moveaxis(z[:, 2 * len(turned) :].reshape(len(z), -1, 2), 1, 0)
    with_back = np.stack([turns, 1 / turns], axis=2)
    squares = []
    for constant, sign, arm in zip(constants, signs, (first, other[0] if other else ratio * first), strict=True):
        w = constant + arm * with_back[:, 2]
        for k, (s, name) in enumerate(zip(sign, turned, strict=True)):
            if s:
                w = w + s * z[:, 2 * k : 2 * k + 2] * (1 if name == "1" else with_back[:, "QU".index(name)])
        squares.append(w.prod(axis=1))
    return np.stack(squares, axis=1)


def known_solutions(
    problem: Problem, rng: np.random.Generator, count: int, *, general: bool = False
) -> tuple[Complexes, Complexes]:
    """Random complex tasks of one solution each that is chosen, and how outputs turn; the rest by Newton's method.

    In a general plane, if that is wanted: the last displacement, or the last turn of the output where the pairs leave
    nothing free, depends on the solution.
    Returns (count, unknowns) and the tasks, complex[count, 4, unknowns] as `_core.track` takes them.
    """
    if problem.guides:
        return random_guides(rng, count, problem.poses, tilted=general, one_angle=problem.one_angle)
    family, unknowns = problem.family, problem.unknowns
    z, ratio = random_numbers(rng, count, unknowns), random_numbers(rng, count, 2)
    tasks, filled = np.zeros((count, 4, unknowns), np.complex128), np.zeros(count, np.int64)
    while (missing := problem.points - filled).any():
        own = np.repeat(np.arange(count), missing)
        parts = rng.normal(size=(len(own), 6))
        turns = (parts[:, [0, 2, 3]] + 1j * parts[:, [1, 4, 5]])[:, [1, 0, 2]]
        wanted = _lengths(family, z[own], ratio[own], np.ones_like(turns))
        h = 1e-7
        with np.errstate(all="ignore"):
            for _ in range(60):
                value = _lengths(family, z[own], ratio[own], turns) - wanted
                by_turn, by_shared = (
                    (_lengths(family, z[own], ratio[own], turns + h * np.eye(3)[k]) - wanted - value) / h
                    for k in (0, 2)
                )
                scale = by_turn[:, 0] * by_shared[:, 1] - by_turn[:, 1] * by_shared[:, 0]
                turns[:, 0] -= (value[:, 0] * by_shared[:, 1] - value[:, 1] * by_shared[:, 0]) / scale
                turns[:, 2] -= (by_turn[:, 0] * value[:, 1] - by_turn[:, 1] * value[:, 0]) / scale
            size = np.abs(turns[:, ::2])
            met = (np.abs(value).max(axis=1) < 1e-12) & (size.min(axis=1) > 0.05) & (size.max(axis=1) < 20)
        for k, turn in zip(own[met], turns[met], strict=True):
            tasks[k, :2, filled[k]] = turn[:2]
            filled[k] += 1
    if family != "Watt II" and unknowns == 8:
        tasks[:, 3, 2:4] = ratio
    if problem.points == 7:
        arm = arm_of(problem)
        tasks[:, 2, arm], tasks[:, 3, 1] = random_numbers(rng, count, 2), 1
        tasks[:, 3, 0] = (tasks[:, 2, arm] * z[:, arm]).sum(axis=1) + z[:, arm].prod(axis=1)
    elif general:
        tasks[:, 2, 0] = random_numbers(rng, count)
        tasks[:, 1, problem.points - 1] += tasks[:, 2, 0] * z[:, 0]
    return z, tasks


def arm_of(problem: Problem) -> slice:
    """Which unknowns are the arm of the first loop and its conjugate."""
    at = 2 * LOOPS[problem.family].vectors
    return slice(at, at + 2)


class Plane(NamedTuple):
    """What of a task is a plane that cuts the curve of the six-bars through its other targets."""

    moved: tuple[int, int]
    """The place of the number by which it moves parallel to itself."""
    slopes: tuple[int, ...]
    """The place of what is zero of a task with given targets, or with the length of the arm given."""
    summed: slice
    """The unknowns whose sum over all solutions is linear in that number."""


def plane_of(problem: Problem) -> Plane:
    """Of positions the last displacement's conjugate moves, of pairs that leave nothing free the last output."""
    moved, summed = (2, problem.poses - 1), slice(0, 1)
    slopes: tuple[int, ...] = 0, TILT
    if problem.points == 7:
        moved, slopes, summed = (3, 0), (2,), arm_of(problem)
    elif not problem.guides:
        moved, slopes = (1, problem.points - 1), (2, 0)
    return Plane(moved, slopes, summed)


def follow(
    problem: Problem,
    starts: Complexes,
    begin: Complexes,
    end: Complexes,
    threads: int | None = None,
    *,
    steps: Sequence[float] = (QUICK, CAREFUL),
) -> tuple[Complexes, Flags]:
    """The ends of paths, sharpened, and which arrived at regular solutions; the lost ones once more with fine steps."""
    ends, good = np.empty_like(starts), np.zeros(len(starts), bool)
    for loose in steps:
        left = np.flatnonzero(~good)
        there, status = follow_from_generic(problem, starts[left], begin, end, loose, threads=threads)
        good[left] = sharpened(problem, there, end) & (status == ARRIVED)
        ends[left] = there
    return ends, good


def merged(known: Complexes, more: Complexes) -> tuple[Complexes, Integers]:
    """Known solutions with those of others that are not among them, and where each of the others is in them.

    Sorted by a mark that few have in common.
    """
    both = np.concatenate([known, more])
    mark = np.real(both / (1 + np.abs(both)) @ _MARK[: both.shape[1]])
    order = np.argsort(mark, kind="stable")
    first = np.arange(len(both))  # the same solution's first place
    for _ in range(2):
        for behind in range(1, 8):
            a, b = order[:-behind], order[behind:]
            close = mark[b] - mark[a] < 1e-7
            a, b = a[close], b[close]
            near = np.abs(both[a] - both[b]).max(axis=1) < _SAME * (1e-3 + np.abs(both[a]).max(axis=1))
            a, b = a[near], b[near]
            np.minimum.at(first, a, first[b])
            np.minimum.at(first, b, first[a])
    kept = first == np.arange(len(both))
    number = np.cumsum(kept) - 1
    return both[kept], number[first[len(known) :]]


class Search:
    """Solutions of some tasks, found along ways between them.

    A way from task u to task v, each solution of u to one of v, is followed once for each pair of ends, from either of
    them; first on the ways between all tasks. Other ways lead to equivalents of v: of eight pairs its last equation may
    have any factor; positions may be turned by any complex angle, and their six-bars with them. Where v has none, they
    lead aside. Lines across one curve would take a quarter of the time, but ways between them do not reach the few
    six-bars that are a hundred times as large as others.
    """

    def __init__(
        self,
        problem: Problem,
        seed: int,
        threads: int | None = None,
        *,
        tasks: int = _TASKS,
        general: bool = True,
    ) -> None:
        rng = np.random.default_rng(seed)
        z, (task,) = known_solutions(problem, rng, 1, general=general)
        self.problem, self.threads, self.lost, self.clashes, self.paths = problem, threads, 0, 0, 0
        self.aside = problem.points == problem.unknowns
        used = np.abs(task) > 0
        used[0, : problem.poses * problem.one_angle] = False
        self.tasks: list[Complexes] = [task] + [
            np.where(used, random_numbers(rng, *task.shape), task) for _ in range(tasks - 1)
        ]
        self.found: list[Complexes] = [z] + [z[:0]] * (tasks - 1)
        self.ways: list[tuple[int, int, complex]] = []
        self.matched: list[list[Flags]] = []
        self.rng = rng
        self.begin_again()

    def begin_again(self) -> None:
        """With six new ways: of few solutions all may be closed under those that there are."""
        self.ways, self.matched = [], []
        for u, v in combinations(range(len(self.tasks)), 2):
            self.add_way(u, v)

    def add_way(self, u: int, v: int) -> None:
        """One more way from task u to task v."""
        again = self.paths > 0 or any((a, b) == (u, v) for a, b, _ in self.ways)
        factor = again or self.problem.points == 7
        far = 10 ** self.rng.uniform(0, 2) if self.aside else 1.0  # large solutions are moved by wide ways only
        self.ways.append((u, v, far * complex(random_numbers(self.rng)) if factor else 1.0))
        self.matched.append([np.zeros(len(self.found[k]), bool) for k in (u, v)])

    def left(self) -> list[tuple[int, int, int]]:
        """Of each way and end: how many solutions have not been followed."""
        return [(int((~ends[side]).sum()), number, side) for number, ends in enumerate(self.matched) for side in (0, 1)]

    def step(self) -> bool:
        """Follows some of the solutions where the most are left; False if there are none."""
        most, number, side = max(self.left())
        if most == 0:
            return False
        begin, end = (self.ways[number][:2][k] for k in (side, 1 - side))
        some = np.flatnonzero(~self.matched[number][side])[:_PIECE]
        stops, by = self._way(number)
        unit = np.ones_like(by)
        ends, good = self.found[begin][some] * (by if side else unit), np.ones(len(some), bool)
        for here, there in pairwise(stops[::-1] if side else stops):
            ends[good], good[good] = follow(self.problem, ends[good], here, there, self.threads)
        ends = ends / (unit if side else by)
        self.matched[number][side][some] = True
        known = len(self.found[end])
        self.found[end], where = merged(self.found[end], ends[good])
        for (u, v, _), matched in zip(self.ways, self.matched, strict=True):
            for k in np.flatnonzero([u == end, v == end]):
                matched[k] = np.concatenate([matched[k], np.zeros(len(self.found[end]) - known, bool)])
        arrived = self.matched[number][1 - side]
        self.clashes += int(arrived[where].sum()) + len(where) - len(np.unique(where))
        arrived[where] = True
        self.lost += int((~good).sum())
        self.paths += len(some)
        return True

    @property
    def followed(self) -> int:
        """Of all ways together, how many pairs of ends are known."""
        return sum(int(ends[0].sum()) for ends in self.matched)

    def _way(self, number: int) -> tuple[list[Complexes], Complexes]:
        """The tasks of a way in turn, and what multiplies solutions of its end where that is an equivalent."""
        u, v, factor = self.ways[number]
        first, task, by = self.tasks[u], self.tasks[v].copy(), np.ones(self.problem.unknowns, np.complex128)
        if self.aside:
            return [first, *([first + factor * (task - first)] if factor != 1 else []), task], by
        if self.problem.guides:
            by[2::2], by[3::2] = factor, 1 / factor
            task[1] *= factor
            task[2] /= factor
            task[0, TILT] /= factor
            task[3, ::2] *= factor
            task[3, 1::2] /= factor
        else:
            task[2] *= factor
            task[3, :2] *= factor
        return [first, task], by

    def save(self, file: Path) -> None:
        """What is found and followed, to go on from."""
        rows: dict[str, Any] = {f"z{k}": z for k, z in enumerate(self.found)}
        rows |= {f"m{k}_{s}": end for k, ends in enumerate(self.matched) for s, end in enumerate(ends)}
        rows |= {"ways": self.ways, "counts": [self.lost, self.clashes, self.paths]}
        with atomic_file(file, durable=False) as stream:
            np.savez(stream, **rows)

    def load(self, file: Path) -> None:
        """What an earlier search with the same seed saved; one of `UNUSABLE` is raised where the file has none."""
        with file.open("rb") as stream, np.load(stream) as stored:
            listed = [stored[f"z{k}"] for k in range(len(self.tasks))]
            ways = [(int(u.real), int(v.real), factor) for u, v, factor in stored["ways"].tolist()]
            matched = [[stored[f"m{k}_{s}"] for s in (0, 1)] for k in range(len(ways))]
            lost, clashes, paths = stored["counts"].tolist()
        known = all(sharpened(self.problem, z, task).all() for z, task in zip(listed, self.tasks, strict=True))
        ends = [
            (row, listed[k])
            for (u, v, _), two in zip(ways, matched, strict=True)
            for row, k in zip(two, (u, v), strict=True)
        ]
        if not known or any(len(row) != len(z) for row, z in ends):
            raise ValueError("no search of these tasks")
        self.found, self.ways, self.matched = listed, ways, matched
        self.lost, self.clashes, self.paths = lost, clashes, paths

    @property
    def alike(self) -> bool:
        """Whether all tasks have as many solutions, as they must when all are known."""
        return len({len(z) for z in self.found}) == 1

    def __str__(self) -> str:
        counts = ", ".join(f"{len(z):,}" for z in self.found)
        problem = self.problem
        targets = f"{problem.poses + 1} positions" if problem.guides else f"{problem.points + 1} pairs"
        text = f"{problem.family}, {targets}: {counts} solutions; {self.paths:,} paths on "
        return f"{text}{len(self.ways)} ways, {self.lost} lost, {self.clashes} to one end"


class Trace(NamedTuple):
    """The trace test of a list."""

    residual: float
    """How far the sum over all solutions is from linear as the plane moves, relative to its change."""
    without_one: float
    """The same without one of the solutions."""
    lost: int
    """Paths that were not followed."""


def trace(search: Search, node: int = 0) -> Trace:
    """The trace test of the list for one of the tasks: a list that lacks some has a sum that is not linear.

    The plane moves another way where a path is lost; three ways are tried.
    """
    tested = _trace(search, node, _STEPS[0])
    for step in _STEPS[1:]:
        if not tested.lost:
            break
        tested = min(tested, _trace(search, node, step), key=lambda each: each.lost)
    return tested


def _trace(search: Search, node: int, step: complex) -> Trace:
    """The trace test with the plane moved by a step, relative to where it is, both ways."""
    task, z, plane = search.tasks[node], search.found[node], plane_of(search.problem)
    sets, kept = [], np.ones(len(z), bool)
    for sign in (-1, 1):
        moved = task.copy()
        moved[plane.moved] += sign * step * abs(task[plane.moved])
        ends, good = follow(search.problem, z, task, moved, search.threads)
        sets.append(ends)
        kept &= good
    weights = _MARK[: plane.summed.stop - plane.summed.start]
    before, now, after = (row[kept][:, plane.summed] @ weights for row in (sets[0], z, sets[1]))
    bends, ways = before + after - 2 * now, after - before

    def of(part: slice) -> float:
        return float(abs(bends[part].sum()) / abs(ways[part].sum()))

    return Trace(of(slice(None)), of(slice(1, None)), int((~kept).sum()))


def on_special_plane(search: Search) -> tuple[Complexes, Complexes]:
    """The first task as its plane becomes p p* = r, or that of a given target, and its solutions that stay finite."""
    task, plane = search.tasks[0].copy(), plane_of(search.problem)
    task[plane.slopes], task[plane.moved] = 0, complex(random_numbers(search.rng))
    # Most paths to given targets go to infinity, the longer the finer the steps.
    steps = (QUICK, CAREFUL) if search.problem.points == 7 else (QUICK,)
    ends, good = follow(search.problem, search.found[0], search.tasks[0], task, search.threads, steps=steps)
    return task, merged(ends[:0], ends[good])[0]
