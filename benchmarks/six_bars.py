"""How many six-bars turn through pairs of angles: by monodromy, with a trace test; docs/theory/synthesis-functions.md.

`python -m benchmarks.six_bars FAMILY PAIRS LAST FILE` keeps what is found in a file and goes on from there.
"""

import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from gruebler import _core

NODES, BLOCK, PIECE = 4, 64, 10_000
SAME = 1e-6  # relative: solutions nearer to each other are one
QUICK, CAREFUL = 1e-3, 1e-6
MARK = np.exp(1.234j * np.arange(1, 9) ** 2)  # weights of the numbers of a solution


def random(rng: np.random.Generator, *shape: int) -> np.ndarray:
    return rng.normal(size=shape) + 1j * rng.normal(size=shape)


def known_solution(family: str, pairs: int, last: str, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """A random complex task of one solution that is chosen: arms, and how the common link turns; the pairs follow.

    Args:
        family: "Watt II" or "Stephenson III".
        pairs: 8 or 9.
        last: of eight pairs, what is given besides: the "arm" p p*, or a "line" through all unknowns.
        rng: of the choice.
    """
    z, task = random(rng, 8), np.zeros((4, 8), complex)
    a, ac, f, fc, p, pc, q, qc = z
    c, cc = task[3, 2:4] = random(rng, 2)

    def turn(t: complex, arm: tuple, w: tuple, v: tuple) -> complex:
        """The X with (w + v X + p T)(w* + v*/X + p*/T) as it is for X = T = 1; of each number the conjugate follows."""
        first, other = w[0] + v[0] + arm[0], w[1] + v[1] + arm[1]
        near, far = w[0] + arm[0] * t, w[1] + arm[1] / t
        roots = np.roots([v[0] * far, near * far + v[0] * v[1] - first * other, near * v[1]])
        return complex(roots[rng.integers(2)])

    task[:2] = 1
    for j in range(pairs - 1):
        t = complex(random(rng))
        if family == "Watt II":
            task[0, j] = turn(t, (p, pc), (1, 1), (-a, -ac))
            task[1, j] = turn(t, (q, qc), (1, 1), (-f, -fc))
            continue
        x = task[0, j] = turn(t, (p, pc), (-1, -1), (a, ac))
        # The crank turns, too: the loop of the output has other vectors in the first pair.
        near, far, first = a * x - c + q * t, ac / x - cc + qc / t, (a - c - f + q) * (ac - cc - fc + qc)
        task[1, j] = np.roots([-f * far, near * far + f * fc - first, -near * fc])[rng.integers(2)]
    if pairs == 8 and last == "arm":
        task[3, :2] = p * pc, 1
    elif pairs == 8:
        task[2] = random(rng, 8)
        task[3, 0] = task[2] @ z
    return z[None], task


def follow(
    family: str, pairs: int, starts: np.ndarray, begin: np.ndarray, end: np.ndarray, loose: float = QUICK
) -> tuple[np.ndarray, np.ndarray]:
    """The ends of paths, sharpened, and which arrived at regular solutions."""
    ends, good = np.empty_like(starts), np.zeros(len(starts), bool)

    def run(at: int) -> None:
        part = slice(at, at + BLOCK)
        there, status, _ = _core.track(starts[part], begin, end, 0, pairs - 1, loose, family=family)
        ends[part], steps = _core.refine_solutions(there, end, 0, pairs - 1, family=family)
        good[part] = (status == 0) & (steps < 1e-9)

    with ThreadPoolExecutor(2) as pool:
        list(pool.map(run, range(0, len(starts), BLOCK)))
    return ends, good


def with_new(z: np.ndarray, more: np.ndarray) -> np.ndarray:
    """Solutions, and those of others that are not among them; in the order of a mark that few have in common."""
    both = np.concatenate([z, more])
    mark = np.real(both / (1 + np.abs(both)) @ MARK)
    order = np.argsort(mark, kind="stable")
    new = np.arange(len(both)) >= len(z)
    repeated = np.zeros(len(both), bool)
    for behind in range(1, 8):
        first, second = order[:-behind], order[behind:]
        close = mark[second] - mark[first] < 1e-7
        first, second = first[close], second[close]
        near = np.abs(both[first] - both[second]).max(axis=1) < SAME * (1e-3 + np.abs(both[first]).max(axis=1))
        repeated[np.maximum(first[near], second[near])] = True
    return both[~(new & repeated)]


def find_all(family: str, pairs: int, last: str, seed: int, file: Path | None = None) -> tuple[list, list]:
    """All solutions of some tasks that monodromy reaches from one: tasks, and the solutions of each.

    Between any two tasks all solutions are followed, each once a way; when no way has any left, those of one task are
    closed under the loops through the others.
    """
    rng = np.random.default_rng(seed)
    z, task = known_solution(family, pairs, last, rng)
    used = np.abs(task) > 0
    used[:2, pairs - 1 :] = False
    tasks = [task] + [np.where(used, random(rng, 4, 8), task) for _ in range(NODES - 1)]
    for each in tasks:
        each[3, 1] = task[3, 1]
    found = [z] + [z[:0]] * (NODES - 1)
    done = {(u, v): 0 for u in range(NODES) for v in range(NODES) if u != v}
    if file is not None and file.exists():
        with np.load(file) as stored:
            found = [stored[f"z{k}"] for k in range(NODES)]
            done = dict(zip(done, stored["done"].tolist(), strict=True))
    lost, start = 0, time.time()
    while True:
        u, v = max(done, key=lambda way: len(found[way[0]]) - done[way])
        some = found[u][done[u, v] :][:PIECE]
        if not len(some):
            return tasks, found
        done[u, v] += len(some)
        ends, good = follow(family, pairs, some, tasks[u], tasks[v])
        lost += int((~good).sum())
        found[v] = with_new(found[v], ends[good])
        if file is not None and len(some) > 1000:
            np.savez(file, done=list(done.values()), **{f"z{k}": row for k, row in enumerate(found)})
            print(f"{time.time() - start:6.0f} s {[len(row) for row in found]}, {lost} paths lost", flush=True)


def trace(family: str, pairs: int, task: np.ndarray, z: np.ndarray) -> tuple[float, float, int]:
    """How far the sum of all solutions is from linear as the last plane moves; that without one of them; paths lost.

    Of all points in which a plane meets a curve the sum moves in a straight line when the plane moves parallel to
    itself; of a part of them it does not (Sommese, Verschelde, Wampler 2002). Only of a "line".
    """
    step, sets, kept = 0.3j * abs(task[3, 0]), [], np.ones(len(z), bool)
    for sign in (-1, 1):
        moved = task.copy()
        moved[3, 0] += sign * step
        ends, good = follow(family, pairs, z, task, moved)
        ends[~good], good[~good] = follow(family, pairs, z[~good], task, moved, CAREFUL)
        sets.append(ends)
        kept &= good
    before, after = (row[kept] @ MARK for row in sets)
    bends, ways = before + after - 2 * (z[kept] @ MARK), after - before
    whole = abs(bends.sum()) / abs(ways.sum())
    return whole, abs(bends[1:].sum()) / abs(ways[1:].sum()), int((~kept).sum())


def main(family: str = "Watt II", pairs: int = 8, last: str = "arm", file: str = "") -> None:
    start = time.process_time()
    tasks, found = find_all(family, pairs, last, 1, Path(file) if file else None)
    best = int(np.argmax([len(row) for row in found]))
    counts, seconds = [len(row) for row in found], time.process_time() - start
    print(f"{family}, {pairs} pairs, {last}: {counts} solutions of {NODES} tasks, {seconds:.0f} s of processor")
    if pairs == 8 and last == "line":
        whole, less, lost = trace(family, pairs, tasks[best], found[best])
        print(f"trace test: {whole:.1e}, without one solution {less:.1e}; {lost} paths lost")


if __name__ == "__main__":
    family, pairs, last, *rest = [*sys.argv[1:], "Watt II", "8", "arm"][: max(3, len(sys.argv) - 1)]
    main(family, int(pairs), last, *rest)
