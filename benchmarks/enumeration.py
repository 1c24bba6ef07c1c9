"""Chains counted and listed, against stock geng, which makes a superset without any test of mobility."""

import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from gruebler.structure.enumeration import count_chains, graph6_blocks
from gruebler.structure.enumeration.contracted import packed_graphs
from gruebler.structure.enumeration.pieces import count_piece, pieces

LINKS = (12, 14, 16)
GENG = shutil.which("nauty-geng") or shutil.which("geng")
COUNT = "from gruebler.structure.enumeration import count_chains; count_chains({})"


def seconds(call: Callable[[], object], runs: int = 3) -> float:
    """The best of a few runs."""
    best = float("inf")
    for _ in range(runs):
        start = time.perf_counter()
        call()
        best = min(best, time.perf_counter() - start)
    return best


def command(links: int) -> None:
    subprocess.run([sys.executable, "-c", COUNT.format(links)], check=True)


def geng(links: int, *options: str) -> float | None:
    """Seconds of stock geng for all two-connected graphs of so many links and joints; triangle-free, no pendant."""
    if GENG is None:
        return None
    joints = (3 * links - 4) // 2
    call = [GENG, "-q", "-Ctd2", *options, str(links), f"{joints}:{joints}"]
    return seconds(lambda: subprocess.run(call, check=True, capture_output=True), 1 if links > 14 else 2)


def ratio(theirs: float | None, ours: float) -> str:
    return "" if theirs is None else f"{theirs:9.2f} s{theirs / ours:9.1f} times"


def counting() -> None:
    print(f"{'counted':<24}{'chains':>14}{'here':>11}{'per chain':>12}{'geng -u':>11}{'ratio':>9}")
    for links in LINKS:
        chains = count_chains(links).chains
        ours = seconds(lambda links=links: count_chains(links))
        line = f"{links:>3} links{'':<16}{chains:>14}{ours:>9.3f} s{ours / chains * 1e9:>9.0f} ns"
        print(line, ratio(geng(links, "-u"), ours), flush=True)


def eighteen() -> None:
    """The largest count, as a process of its own, with its peak memory in MB."""
    code = "import resource; from gruebler import count_chains; print(count_chains(18).chains); "
    code += "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)"
    start = time.perf_counter()
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    took = time.perf_counter() - start
    chains, memory = map(int, done.stdout.split())
    print(f" 18 links{'':<16}{chains:>14}{took:>9.1f} s{took / chains * 1e9:>9.1f} ns   {memory} MB", flush=True)


def listing() -> None:
    def write(path: str) -> None:
        with open(path, "wb") as file:  # noqa: PTH123
            for block in graph6_blocks(14):
                block.tofile(file)

    with tempfile.NamedTemporaryFile() as file:
        ours = seconds(lambda: write(file.name))
    print(f"{' 14 links as graph6':<24}{'':>14}{ours:>9.3f} s{'':>12}", ratio(geng(14), ours), flush=True)


def commands() -> None:
    for links in LINKS:
        print(f"whole command, {links} links: {seconds(lambda links=links: command(links)):.2f} s")


def profile() -> None:
    """Where the time of 16 links goes, and how far listing is from copying the same bytes."""
    graphs = seconds(lambda: [None for _ in packed_graphs(7)])
    cut = seconds(lambda: list(pieces(16, 1)))
    work = list(pieces(16, 1))
    counted = seconds(lambda: [count_piece(piece) for piece in work])
    with_orbits = seconds(lambda: [count_piece(piece, True) for piece in work])
    print(f"16 links: contracted graphs {graphs:.3f} s, cut into pieces {cut - graphs:.3f} s,")
    print(f"          chains {counted:.3f} s, with orbits {with_orbits:.3f} s")
    start = time.perf_counter()
    size = sum(block.nbytes for block in graph6_blocks(16))
    listed = time.perf_counter() - start
    with ThreadPoolExecutor(2) as two:
        start = time.perf_counter()
        assert size == sum(block.nbytes for block in graph6_blocks(16, executor=two))
        by_two = time.perf_counter() - start
    lines = np.zeros(size, np.uint8)
    copied = seconds(lines.copy)
    print(f"16 links as graph6, {size / 1e6:.0f} MB: {listed:.1f} s, with two threads {by_two:.1f} s;")
    print(f"          copying as many bytes in memory {copied:.2f} s")


def main() -> None:
    if GENG is None:
        print("geng is not on the PATH: no comparison (Debian: package nauty)")
    counting()
    eighteen()
    listing()
    commands()
    profile()


if __name__ == "__main__":
    main()
