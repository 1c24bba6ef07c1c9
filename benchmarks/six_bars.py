"""How many six-bars turn through pairs of angles: by monodromy, with a trace test; docs/theory/synthesis-functions.md.

Of Watt I: how many carry a body through 6 positions, or 7, without a trace test. Through eleven pairs, or eight
positions: estimated from how often random ones are the same, until the 95 % are within 2 %.

`python -m benchmarks.six_bars FAMILY PAIRS FOLDER SEED` keeps what is found in a folder and goes on from there. The
family "Watt I, one angle": those that turn the body between 6 positions of one angle.
"""

import sys
import time
from pathlib import Path

import numpy as np

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


def estimate(problem: Problem, folder: str, seed: int) -> None:
    """How many six-bars turn through eleven pairs, or carry a body through eight positions."""
    targets = problem.points + problem.poses + 1
    census, file = (
        Census(problem, seed),
        Path(folder or ".") / f"{problem.family.replace(' ', '_')}_{targets}_{seed}.npz",
    )
    file.parent.mkdir(parents=True, exist_ok=True)
    if folder and file.exists():
        census.load(file)
    while True:
        census.step()
        if folder:
            census.save(file)
        now = census.estimate()
        arrived = f"{census.count:,} arrived, {census.lost} lost, {len(census.z):,} different"
        print(f"{problem.family}, {problem.name}: {arrived}", end="; ")
        told = f"about {now.number:,.0f}, with 95 % {now.least:,.0f} to {now.most:,.0f}; thrice {now.unlike:+.3f}"
        print(told, f"{time.process_time():.0f} s of processor", sep="; ", flush=True)
        if now.most - now.least < 0.04 * now.number:
            break


def main(family: str = "Watt II", pairs: int = 8, folder: str = "", seed: int = 1) -> None:
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
    plane = (kind, pairs) != ("Watt I", 7)
    search = Search(problem, seed) if plane else Search(problem, seed, tasks=2, general=False)
    for _ in range(0 if plane else 2):
        search.add_way(0, 1)
    file = Path(folder or ".") / f"{family.replace(', ', '_').replace(' ', '_')}_{pairs}_{seed}.npz"
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
        if pairs == 9 or (not plane and len(search.found[0]) >= FEW):
            break
        if len(search.found[0]) < FEW:
            search.begin_again()
        else:
            if folder:
                search.save(file)
            print(search, flush=True)
            tested = trace(search)
            told = f"trace test: {tested.residual:.1e}, without one solution {tested.without_one:.1e}"
            print(f"{told}; {tested.lost} paths lost", flush=True)
            if tested.residual < LINEAR and search.alike:
                print(f"with the arm, or the positions, given: {len(on_special_plane(search)[1]):,} finite", flush=True)
                break
            search.add_way(*search.ways[len(search.ways) % 6][:2])
    print(search, f"{time.process_time():.0f} s of processor", sep="; ")


if __name__ == "__main__":
    family, pairs, folder, seed = [*sys.argv[1:], *["Watt II", "8", "", "1"][len(sys.argv) - 1 :]]
    if pairs == "11" or (family, pairs) == ("Watt I", "8"):
        estimate(EIGHT_POSITIONS if family == "Watt I" else ELEVEN[family], folder, int(seed))
    else:
        main(family, int(pairs), folder, int(seed))
