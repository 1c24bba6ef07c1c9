"""How many six-bars turn through pairs of angles: by monodromy, with a trace test; docs/theory/synthesis-functions.md.

Of Watt I: how many carry a body through 6 positions, or 7. Through eleven pairs, or eight positions: estimated from how
often random ones are the same, until the 95 % are within 2 %; `--jobs N` shares that with processes, `--scheduler
ADDRESS` (or `local`) by Dask.

`python -m benchmarks.six_bars FAMILY PAIRS FOLDER SEED` keeps what is found in a folder and goes on from there. The
family "Watt I, one angle": those that turn the body between 6 positions of one angle. `--plane`: of nine pairs and
seven positions those of a general plane, which takes longer and has a trace test; the others always have one.
"""

import argparse
import time
from collections.abc import Callable
from concurrent.futures import Executor
from itertools import combinations
from pathlib import Path

import numpy as np

from gruebler.cli.executors import executor_of
from gruebler.design.synthesis.alt_burmester import Problem
from gruebler.design.synthesis.six_bar_census import EIGHT_POSITIONS, ELEVEN, Census
from gruebler.design.synthesis.six_bar_monodromy import Search, follow, known_solutions, merged, on_special_plane, trace
from gruebler.design.synthesis.six_bar_starts import FEW, LINEAR


def recapture(search: Search, count: int) -> tuple[int, int]:
    """Of six-bars that are chosen at random and followed to the first task: how many arrive, how many are known."""
    rng, ends = np.random.default_rng(7), [search.found[0][:0]]
    for z, task in zip(*known_solutions(search.problem, rng, count), strict=True):
        there, good = follow(search.problem, z[None], task, search.tasks[0])
        ends.append(there[good])
    new = np.concatenate(ends)
    _, where = merged(search.found[0], new)
    return len(new), int((where < len(search.found[0])).sum())


def estimate(problem: Problem, folder: str, seed: int, executor: Callable[[], Executor] | None) -> None:
    """How many six-bars turn through eleven pairs, or carry a body through eight positions."""
    targets = problem.points + problem.poses + 1
    census, file = (
        Census(problem, seed),
        Path(folder or ".") / f"{problem.family.replace(' ', '_')}_{targets}_{seed}.npz",
    )
    file.parent.mkdir(parents=True, exist_ok=True)
    if folder and file.exists():
        census.load(file)
    for _ in census.pieces_followed(executor):
        if folder:
            census.save(file)
        now = census.estimate()
        arrived = f"{census.count:,} arrived, {census.lost} lost, {len(census.z):,} different"
        print(f"{problem.family}, {problem.name}: {arrived}", end="; ")
        told = f"about {now.number:,.0f}, with 95 % {now.least:,.0f} to {now.most:,.0f}; thrice {now.unlike:+.3f}"
        print(told, f"{time.process_time():.0f} s of processor", sep="; ", flush=True)
        if now.most - now.least < 0.04 * now.number:
            break


def is_linear(search: Search, node: int) -> bool:
    """Whether the trace test of a task passes; it is printed."""
    tested = trace(search, node)
    told = f"trace test: {tested.residual:.1e}, without one solution {tested.without_one:.1e}"
    print(f"{told}; {tested.lost} paths lost", flush=True)
    return tested.residual < LINEAR


def main(family: str, pairs: int, folder: str, seed: int, tasks: int, plane: bool) -> None:
    kind, _, one_angle = family.partition(", ")
    poses, points = (pairs - 1, 0) if kind == "Watt I" else (0, pairs - 1)
    problem = Problem(
        name=f"{pairs} targets",
        poses=poses,
        points=points,
        classes=0,
        members=1,
        family=kind,
        one_angle=bool(one_angle),
    )
    general = plane or pairs in (6, 8)
    search = Search(problem, seed, tasks=tasks, general=general)
    between = list(combinations(range(tasks), 2))

    def begin() -> None:
        search.begin_again()
        while len(search.ways) < 3:
            search.add_way(0, 1)

    begin()
    name = f"{family.replace(', ', '_').replace(' ', '_')}_{pairs}{'_plane' * plane}_{seed}.npz"
    file = Path(folder or ".") / name
    file.parent.mkdir(parents=True, exist_ok=True)
    if folder and file.exists():
        search.load(file)
    saved = time.time()
    while True:
        while search.step():
            if folder and time.time() - saved > 30:
                saved = time.time()
                search.save(file)
                print(search, flush=True)
        if len(search.found[0]) < FEW:
            begin()
            continue
        if folder:
            search.save(file)
        print(search, flush=True)
        if not general:
            break
        if is_linear(search, 0) and search.alike and all(is_linear(search, node) for node in range(1, tasks)):
            print(f"with the arm, or all targets, given: {len(on_special_plane(search)[1]):,} finite", flush=True)
            break
        search.add_way(*between[len(search.ways) % len(between)])
    print(search, f"{time.process_time():.0f} s of processor", sep="; ")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m benchmarks.six_bars")
    parser.add_argument("family", nargs="?", default="Watt II")
    parser.add_argument("pairs", nargs="?", type=int, default=8)
    parser.add_argument("folder", nargs="?", default="")
    parser.add_argument("seed", nargs="?", type=int, default=1)
    parser.add_argument("--tasks", type=int)
    parser.add_argument("--plane", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--scheduler")
    parser.set_defaults(lang="en")
    given = parser.parse_args()
    if given.pairs == 11 or (given.family, given.pairs) == ("Watt I", 8):
        problem = EIGHT_POSITIONS if given.family == "Watt I" else ELEVEN[given.family]
        estimate(problem, given.folder, given.seed, executor_of(given))
    else:
        main(
            given.family,
            given.pairs,
            given.folder,
            given.seed,
            given.tasks or (2 if given.pairs == 7 else 4),
            given.plane,
        )
