"""How many six-bars turn through eleven pairs of angles, or carry a body through seven or eight positions.

Listing all would take days. Six-bars are made at random, each with its own pairs, and followed to the pairs of one
task. The fewer solutions this has, the more often two of them end alike. docs/theory/synthesis-functions.md.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
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

    def step(self) -> None:
        """Some more six-bars; always the same ones after as many pieces."""
        self.pieces += 1
        starts, tasks = known_solutions(self.problem, np.random.default_rng([self.seed, self.pieces]), _PIECE)

        def arrived(k: int) -> tuple[Complexes, bool]:
            ends, good = follow(self.problem, starts[k : k + 1], tasks[k], self.task, threads=1)
            return ends, bool(good[0])

        with ThreadPoolExecutor(self.threads or cpu_count() or 1) as pool:
            followed = list(pool.map(arrived, range(_PIECE)))
        ends = np.concatenate([self.z[:0], *(end for end, good in followed if good)])
        self.lost += _PIECE - len(ends)
        self.z, where = merged(self.z, ends)
        self.met = np.bincount(where, minlength=len(self.z)) + np.pad(self.met, (0, len(self.z) - len(self.met)))

    @property
    def count(self) -> int:
        """How many arrived."""
        return int(self.met.sum())

    def estimate(self) -> CountEstimate:
        """The number of solutions; infinite as long as none was met twice."""
        from scipy.stats import chi2

        count, twice = self.count, float((self.met * (self.met - 1)).sum() / 2)
        pairs = count * (count - 1) / 2
        thrice = float((self.met * (self.met - 1) * (self.met - 2)).sum() / 6)
        with np.errstate(divide="ignore", invalid="ignore"):
            least, most = pairs / (chi2.ppf([0.975, 0.025], [2 * twice + 2, 2 * twice]) / 2)
            number = np.float64(pairs) / twice
            unlike = thrice * number**2 / (pairs * (count - 2) / 3) - 1
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


def kept_census(
    problem: Problem, solutions: int, *, threads: int | None = None, progress: Progress | None = None
) -> Census:
    """A census with so many solutions or more, of which one at least was met twice; kept in the user's cache folder.

    It goes on from what is kept there. Cost: 4 ms of processor time for each solution that is new.
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
    with goes_on_from(file):
        while len(census.z) < solutions or census.met.max() < 2:
            census.step()
            if file is not None:
                census.save(file)
            if progress is not None:
                progress(min(len(census.z), solutions), solutions)
    return census
