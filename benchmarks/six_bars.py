"""How many six-bars turn through pairs of angles: by monodromy, with a trace test; docs/theory/synthesis-functions.md.

`python -m benchmarks.six_bars FAMILY PAIRS FOLDER SEED` keeps what is found in a folder and goes on from there.
"""

import sys
import time
from pathlib import Path

import numpy as np

from gruebler.design.synthesis.alt_burmester import Problem
from gruebler.design.synthesis.six_bar_monodromy import Search, follow, known_solution, merged, trace, with_arm_given
from gruebler.design.synthesis.six_bar_starts import FEW, LINEAR


def recapture(search: Search, count: int) -> tuple[int, int]:
    """Of six-bars that are chosen at random and followed to the first task: how many arrive, how many are known."""
    rng, ends = np.random.default_rng(7), [search.found[0][:0]]
    for _ in range(count):
        z, task = known_solution(search.problem, rng)
        there, good = follow(search.problem, z, task, search.tasks[0])
        ends.append(there[good])
    new = np.concatenate(ends)
    _, where = merged(search.found[0], new)
    return len(new), int((where < len(search.found[0])).sum())


def main(family: str = "Watt II", pairs: int = 8, folder: str = "", seed: int = 1) -> None:
    problem = Problem(name=f"{pairs} pairs", poses=0, points=pairs - 1, classes=0, members=1, family=family)
    search = Search(problem, seed)
    file = Path(folder or ".") / f"{family.replace(' ', '_')}_{pairs}_{seed}.npz"
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
        if pairs == 9:
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
                print(f"with the arm alone given: {len(with_arm_given(search)[1]):,} finite", flush=True)
                break
            search.add_way(*search.ways[len(search.ways) % 6][:2])
    print(search, f"{time.process_time():.0f} s of processor", sep="; ")


if __name__ == "__main__":
    family, pairs, folder, seed = [*sys.argv[1:], *["Watt II", "8", "", "1"][len(sys.argv) - 1 :]]
    main(family, int(pairs), folder, int(seed))
