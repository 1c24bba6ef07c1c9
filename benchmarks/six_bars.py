"""How many six-bars turn through pairs of angles: by monodromy, with a trace test; docs/theory/synthesis-functions.md.

`python -m benchmarks.six_bars FAMILY PAIRS FOLDER SEED` keeps what is found in a folder and goes on from there.
"""

import sys
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import combinations
from pathlib import Path

import numpy as np

from gruebler import _core

TASKS, BLOCK, PIECE, FEW = 4, 64, 2048, 500
SAME = 1e-6  # relative: solutions nearer to each other are one
QUICK, CAREFUL = 1e-3, 1e-6
LINEAR = 1e-6  # a sum that is as linear as that is of all
MARK = np.exp(1.234j * np.arange(1, 9) ** 2)  # weights of the numbers of a solution
LOOPS = {  # of both loops: a constant, the signs of the unknown vectors; what each of those turns with
    "Watt II": ((1, 1), ((-1, 0), (0, -1)), "QU"),
    "Stephenson II": ((-1, -1), ((1, 0, -1), (0, 1, -1)), "QQU"),
    "Stephenson III": ((-1, 0), ((1, 0, 0), (1, -1, -1)), "QU1"),
}

ARM = {family: slice(4, 6) if family == "Watt II" else slice(6, 8) for family in LOOPS}  # of the first loop


def random(rng: np.random.Generator, *shape: int) -> np.ndarray:
    return rng.normal(size=shape) + 1j * rng.normal(size=shape)


def lengths(family: str, z: np.ndarray, ratio: np.ndarray, turn: complex, out: complex, common: complex) -> np.ndarray:
    """The squared lengths of the last links of both loops, in isotropic coordinates."""
    constants, signs, turned = LOOPS[family]
    arms = z[4:].reshape(2, 2) if family == "Watt II" else np.array([z[6:], ratio * z[6:]])
    squares = []
    for constant, sign, arm in zip(constants, signs, arms, strict=True):
        w = np.array([constant, constant], complex) + arm * [common, 1 / common]
        for k, (s, name) in enumerate(zip(sign, turned, strict=True)):
            x = {"Q": turn, "U": out, "1": 1.0}[name]
            w += s * z[2 * k : 2 * k + 2] * [x, 1 / x]
        squares.append(w[0] * w[1])
    return np.array(squares)


def known_solution(family: str, pairs: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """A random complex task of one solution that is chosen, and how the output turns; the rest by Newton's method."""
    z, ratio, task = random(rng, 8), random(rng, 2), np.zeros((4, 8), complex)
    if family == "Watt II":
        ratio[:] = 1
    wanted = lengths(family, z, ratio, 1, 1, 1)
    j = 0
    while j < pairs - 1:
        out, x = random(rng), random(rng, 2)
        for _ in range(60):
            value = lengths(family, z, ratio, x[0], out, x[1]) - wanted
            h = 1e-7
            columns = [lengths(family, z, ratio, x[0] + a, out, x[1] + b) - wanted for a, b in ((h, 0), (0, h))]
            step = np.linalg.solve((np.array(columns) - value).T / h, value)
            x -= step
            if np.abs(step).max() < 1e-15 * np.abs(x).max():
                break
        if np.abs(value).max() < 1e-12 and np.abs(x).min() > 0.05 and np.abs(x).max() < 20:
            task[:2, j] = x[0], out
            j += 1
    task[3, 2:4] = ratio
    if pairs == 8:
        arm = ARM[family]
        task[2, arm], task[3, 1] = random(rng, 2), 1
        task[3, 0] = task[2, arm] @ z[arm] + np.prod(z[arm])
    return z[None], task


def follow(
    family: str, pairs: int, starts: np.ndarray, begin: np.ndarray, end: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The ends of paths, sharpened, and which arrived at regular solutions; the lost ones once more with fine steps."""
    ends, good = np.empty_like(starts), np.zeros(len(starts), bool)

    def run(some: np.ndarray, loose: float) -> None:
        there, status, _ = _core.track(starts[some], begin, end, 0, pairs - 1, loose, family=family)
        ends[some], steps = _core.refine_solutions(there, end, 0, pairs - 1, family=family)
        good[some] = (status == 0) & (steps < 1e-9)

    with ThreadPoolExecutor(2) as pool:
        for loose in (QUICK, CAREFUL):
            left = np.flatnonzero(~good)
            list(pool.map(partial(run, loose=loose), np.array_split(left, len(left) // BLOCK + 1)))
    return ends, good


def places(known: np.ndarray, more: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Known solutions with those of others that are not among them, and where each of the others is in them.

    Sorted by a mark that few have in common.
    """
    both = np.concatenate([known, more])
    mark = np.real(both / (1 + np.abs(both)) @ MARK)
    order = np.argsort(mark, kind="stable")
    first = np.arange(len(both))  # the same solution's first place
    for _ in range(2):
        for behind in range(1, 8):
            a, b = order[:-behind], order[behind:]
            close = mark[b] - mark[a] < 1e-7
            a, b = a[close], b[close]
            near = np.abs(both[a] - both[b]).max(axis=1) < SAME * (1e-3 + np.abs(both[a]).max(axis=1))
            a, b = a[near], b[near]
            np.minimum.at(first, a, first[b])
            np.minimum.at(first, b, first[a])
    kept = first == np.arange(len(both))
    number = np.cumsum(kept) - 1
    return both[kept], number[first[len(known) :]]


class Search:
    """Solutions of some tasks, found along ways between them.

    A way from task u to task v, each solution of u to one of v, is followed once for each pair of ends, from either of
    them; first on the six ways between four tasks. Of eight pairs the last equation of v may have any factor, with the
    same solutions: another way.
    """

    def __init__(self, family: str, pairs: int, seed: int) -> None:
        rng = np.random.default_rng(seed)
        z, task = known_solution(family, pairs, rng)
        self.family, self.pairs, self.lost, self.clashes, self.paths = family, pairs, 0, 0, 0
        used = np.abs(task) > 0
        used[3, 2:4] = family != "Watt II"
        self.tasks = [task] + [np.where(used, random(rng, 4, 8), task) for _ in range(TASKS - 1)]
        self.found = [z] + [z[:0]] * (TASKS - 1)
        self.ways: list[tuple[int, int, complex]] = []
        self.matched: list[list[np.ndarray]] = []
        self.rng = rng
        self.begin_again()

    def begin_again(self) -> None:
        """With six new ways: of few solutions all may be closed under those that there are."""
        self.ways, self.matched = [], []
        for u, v in combinations(range(TASKS), 2):
            self.add_way(u, v)

    def add_way(self, u: int, v: int) -> None:
        self.ways.append((u, v, complex(random(self.rng)) if self.pairs == 8 else 1.0))
        self.matched.append([np.zeros(len(self.found[k]), bool) for k in (u, v)])

    def left(self) -> list[tuple[int, int, int]]:
        """Of each way and end: how many solutions have not been followed."""
        return [(int((~ends[side]).sum()), way, side) for way, ends in enumerate(self.matched) for side in (0, 1)]

    def step(self) -> bool:
        """Follows some of the solutions where the most are left; False if there are none."""
        most, way, side = max(self.left())
        if most == 0:
            return False
        begin, end = self.ways[way][side], self.ways[way][1 - side]
        some = np.flatnonzero(~self.matched[way][side])[:PIECE]
        tasks = [self.tasks[self.ways[way][0]], self.scaled(way)]
        ends, good = follow(self.family, self.pairs, self.found[begin][some], tasks[side], tasks[1 - side])
        self.matched[way][side][some] = True
        known = len(self.found[end])
        self.found[end], where = places(self.found[end], ends[good])
        for (u, v, _), matched in zip(self.ways, self.matched, strict=True):
            for k in np.flatnonzero([u == end, v == end]):
                matched[k] = np.concatenate([matched[k], np.zeros(len(self.found[end]) - known, bool)])
        arrived = self.matched[way][1 - side]
        self.clashes += int(arrived[where].sum()) + len(where) - len(np.unique(where))
        arrived[where] = True
        self.lost += int((~good).sum())
        self.paths += len(some)
        return True

    def scaled(self, way: int) -> np.ndarray:
        """The second task of a way, its last equation times the factor of the way."""
        _, v, factor = self.ways[way]
        task = self.tasks[v].copy()
        task[2] *= factor
        task[3, :2] *= factor
        return task

    def recapture(self, count: int) -> tuple[int, int]:
        """Of six-bars that are chosen at random and followed to the first task: how many arrive, how many are known."""
        rng, ends = np.random.default_rng(7), [self.found[0][:0]]
        for _ in range(count):
            z, task = known_solution(self.family, self.pairs, rng)
            there, good = follow(self.family, self.pairs, z, task, self.tasks[0])
            ends.append(there[good])
        new = np.concatenate(ends)
        _, where = places(self.found[0], new)
        return len(new), int((where < len(self.found[0])).sum())

    def save(self, file: Path) -> None:
        rows = {f"z{k}": z for k, z in enumerate(self.found)}
        rows |= {f"m{k}_{s}": end for k, ends in enumerate(self.matched) for s, end in enumerate(ends)}
        beside = file.with_suffix(".new.npz")
        np.savez(beside, ways=self.ways, counts=[self.lost, self.clashes, self.paths], **rows)
        beside.replace(file)

    def load(self, file: Path) -> None:
        with np.load(file) as stored:
            self.found = [stored[f"z{k}"] for k in range(TASKS)]
            self.ways = [(int(u.real), int(v.real), factor) for u, v, factor in stored["ways"].tolist()]
            self.matched = [[stored[f"m{k}_{s}"] for s in (0, 1)] for k in range(len(self.ways))]
            self.lost, self.clashes, self.paths = stored["counts"].tolist()

    def __str__(self) -> str:
        counts = ", ".join(f"{len(z):,}" for z in self.found)
        text = f"{self.family}, {self.pairs} pairs: {counts} solutions; {self.paths:,} paths on {len(self.ways)} ways, "
        return f"{text}{self.lost} lost, {self.clashes} to one end"


def trace(search: Search, node: int) -> tuple[float, float, int]:
    """How far the sum of all arms is from linear as the last equation moves; without one of them; lost paths."""
    task, z, arm = search.tasks[node], search.found[node], ARM[search.family]
    step, sets, kept = 0.3j * abs(task[3, 0]), [], np.ones(len(z), bool)
    for sign in (-1, 1):
        moved = task.copy()
        moved[3, 0] += sign * step
        ends, good = follow(search.family, search.pairs, z, task, moved)
        sets.append(ends)
        kept &= good
    before, now, after = (row[kept][:, arm] @ MARK[:2] for row in (sets[0], z, sets[1]))
    bends, ways = before + after - 2 * now, after - before
    whole = abs(bends.sum()) / abs(ways.sum())
    return whole, abs(bends[1:].sum()) / abs(ways[1:].sum()), int((~kept).sum())


def with_arm_given(search: Search) -> tuple[int, int]:
    """How many solutions of the first task stay finite, and how many of these differ, as its plane becomes p p* = r."""
    task = search.tasks[0].copy()
    task[2], task[3, 0] = 0, complex(random(search.rng))
    ends, good = follow(search.family, search.pairs, search.found[0], search.tasks[0], task)
    different, _ = places(ends[:0], ends[good])
    return int(good.sum()), len(different)


def main(family: str = "Watt II", pairs: int = 8, folder: str = "", seed: int = 1) -> None:
    search = Search(family, pairs, seed)
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
            whole, less, lost = trace(search, 0)
            print(f"trace test: {whole:.1e}, without one solution {less:.1e}; {lost} paths lost", flush=True)
            if whole < LINEAR:
                finite, different = with_arm_given(search)
                print(f"with the arm alone given: {finite:,} finite, {different:,} different", flush=True)
                break
            search.add_way(*search.ways[len(search.ways) % 6][:2])
    print(search, f"{time.process_time():.0f} s of processor", sep="; ")


if __name__ == "__main__":
    family, pairs, folder, seed = [*sys.argv[1:], *["Watt II", "8", "", "1"][len(sys.argv) - 1 :]]
    main(family, int(pairs), folder, int(seed))
