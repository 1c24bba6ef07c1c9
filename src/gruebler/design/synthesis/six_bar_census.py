"""How many six-bars turn through eleven pairs of angles, or carry a body through seven or eight positions.

Listing all would take days. Six-bars are made at random, each with its own pairs, and followed to the pairs of one
task. The fewer solutions this has, the more often two of them end alike. docs/theory/synthesis-functions.md.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from itertools import count
from os import cpu_count
from pathlib import Path

import numpy as np

from gruebler.base.arrays import Complexes, Integers
from gruebler.base.atomic_files import atomic_file
from gruebler.base.errors import SynthesisError
from gruebler.base.private_folder import goes_on_from, private_folder
from gruebler.design.synthesis.alt_burmester import Problem, sharpened
from gruebler.design.synthesis.results import Progress
from gruebler.design.synthesis.six_bar_monodromy import UNUSABLE, follow, known_solutions, merged, random_numbers
from gruebler.structure.enumeration.worker_pool import run_work

ELEVEN = {
    family: Problem(name="eleven pairs", poses=0, points=10, classes=0, members=1, family=family)
    for family in ("Stephenson II", "Stephenson III")
}
"""Six-bars through eleven pairs, by their type; how many there are is estimated only."""
SEVEN_POSITIONS, EIGHT_POSITIONS = (
    Problem(name=name, poses=poses, points=0, classes=classes, members=1, family="Watt I")
    for name, poses, classes in (("seven positions", 6, 35_618), ("eight positions", 7, 0))
)
"""Six-bars that carry a body through positions, of seven with the rocker's pivot given, so many as monodromy listed; of
eight their number is estimated."""
START_SOLUTIONS = 20_000
"""So many are followed to a task unless it is said how many."""
_MOST = 500_000  # of more of them most would be found again
_PIECE = 2048  # six-bars at a time
_AHEAD = 4  # pieces that executors have at first: what is on its way when enough are known is lost
_SEED = 1


def as_start_solutions(number: int) -> int:
    """How many are followed to a task. Raises `SynthesisError` for none or more than half a million."""
    if not 1 <= number <= _MOST:
        raise SynthesisError(
            "start solutions: expected a whole number from 1 to {most:,}, but found {found}", most=_MOST, found=number
        )
    return number


@dataclass(frozen=True, kw_only=True)
class CountEstimate:
    """A number of solutions, from how often two random ones of them were the same."""

    number: float
    least: float
    """With 95 % there are as many, if each is met alike."""
    most: float
    unlike: float
    """How much more often three were the same than if each is met alike, relative: nearly the variance of how often
    each is met by the square of its mean, and the part by which the number is too small."""


class Census:
    """Solutions of a random task where random six-bars arrive, and how often each was met."""

    damaged: Path | None = None
    """A file of an earlier one that was of no use, so that this one began anew."""

    def __init__(self, problem: Problem, seed: int, threads: int | None = None) -> None:
        self.problem, self.seed, self.threads = problem, seed, threads
        rng = np.random.default_rng([seed, 0])
        self.task = np.zeros((4, problem.unknowns), np.complex128)
        rows, targets = (3, problem.poses) if problem.guides else (2, problem.points)
        self.task[:rows, :targets] = random_numbers(rng, rows, targets)
        free = slice(2 * problem.poses, problem.unknowns if problem.guides else 0)
        self.task[3, free] = random_numbers(rng, *self.task[3, free].shape)
        self.z: Complexes = np.zeros((0, problem.unknowns), np.complex128)
        self.met: Integers = np.zeros(0, np.int64)
        self.pieces = 0
        self.lost = 0

    def pieces_followed(self, executor: Executor | Callable[[], Executor] | None = None) -> Generator[None]:
        """Some more six-bars at a time, as long as more are asked for; always the same ones after as many pieces.

        An executor shares the pieces; they are taken up in their order, so that the answer is the same.
        """
        threads = 1 if executor is not None else self.threads or cpu_count() or 1
        ends_of = partial(_ends_of_piece, self.problem, self.seed, self.task, _PIECE, threads)
        with closing(run_work(ends_of, count(self.pieces + 1), executor, ahead=_AHEAD)) as followed:
            for ends in followed:
                self.pieces += 1
                self.lost += _PIECE - len(ends)
                self.z, where = merged(self.z, ends)
                self.met = np.bincount(where, minlength=len(self.z)) + np.pad(
                    self.met, (0, len(self.z) - len(self.met))
                )
                yield

    @property
    def count(self) -> int:
        """How many arrived."""
        return int(self.met.sum())

    def estimate(self) -> CountEstimate:
        """The number of solutions; infinite as long as none was met twice."""
        from scipy.stats import chi2

        arrived, twice = self.count, float((self.met * (self.met - 1)).sum() / 2)
        pairs = arrived * (arrived - 1) / 2
        thrice = float((self.met * (self.met - 1) * (self.met - 2)).sum() / 6)
        with np.errstate(divide="ignore", invalid="ignore"):
            least, most = pairs / (chi2.ppf([0.975, 0.025], [2 * twice + 2, 2 * twice]) / 2)
            number = np.float64(pairs) / twice
            unlike = thrice * number**2 / (pairs * (arrived - 2) / 3) - 1
        return CountEstimate(number=float(number), least=float(least), most=float(most), unlike=float(unlike))

    def save(self, file: Path) -> None:
        """What was met, to go on from."""
        with atomic_file(file, durable=False) as stream:
            np.savez(stream, z=self.z, met=self.met, counts=[self.pieces, self.lost])

    def load(self, file: Path) -> None:
        """What an earlier census with the same seed saved."""
        with np.load(file) as stored:
            z, met, (pieces, lost) = stored["z"], stored["met"], stored["counts"].tolist()
        if met.shape != z.shape[:1] or not sharpened(self.problem, z, self.task).all():
            raise ValueError("no census of this task")
        self.z, self.met, self.pieces, self.lost = z, met, pieces, lost


def _ends_of_piece(problem: Problem, seed: int, task: Complexes, size: int, threads: int, number: int) -> Complexes:
    """Where the six-bars of a piece arrive; the lost ones are missing. Of plain data, so that any process can do it."""
    starts, tasks = known_solutions(problem, np.random.default_rng([seed, number]), size)

    def arrived(k: int) -> Complexes:
        ends, good = follow(problem, starts[k : k + 1], tasks[k], task, threads=1)
        return ends[good]

    with ThreadPoolExecutor(threads) as pool:
        return np.concatenate([starts[:0], *pool.map(arrived, range(size))])


def kept_census(
    problem: Problem,
    solutions: int,
    *,
    threads: int | None = None,
    executor: Executor | Callable[[], Executor] | None = None,
    progress: Progress | None = None,
) -> Census:
    """A census with so many solutions or more, of which one at least was met twice; kept in the user's cache folder.

    It goes on from what is kept there. An executor, if there is one, shares the work: see `worker_pool.run_work`. Cost:
    4 ms of processor time for each solution that is new.
    """
    census, folder = Census(problem, _SEED, threads), private_folder()
    name = f"six_bars_{problem.family} {problem.name.split()[0]}.npz".replace(" ", "_")
    file = None if folder is None else folder / name
    if file is not None and file.exists():
        try:
            census.load(file)
        except UNUSABLE:
            census.damaged = file
            file.unlink()
    with goes_on_from(file), closing(census.pieces_followed(executor)) as more:
        while len(census.z) < solutions or census.met.max() < 2:
            next(more)
            if file is not None:
                census.save(file)
            if progress is not None:
                progress(min(len(census.z), solutions), solutions)
    return census
