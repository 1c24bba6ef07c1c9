"""How long it takes to start: whole processes, cold and warm, in seconds of CPU and by the clock."""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CHAIN = "R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)"
COMMANDS = [
    ["check", "R(0-1) R(1-2) R(2-0)"],
    ["check"],
    ["inversions", "vcomp"],
    ["enumerate", "--links", "10", "--count"],
    ["enumerate", "--links", "14", "--count"],
    ["enumerate", "--links", "16", "--count"],
    ["draw", "vcomp"],
    ["realise", CHAIN],
    ["analyse", "four-bar:25,70,40,70"],
    ["analyse", "wiper"],
    ["analyse", "lambda"],
    ["analyse", "cam"],
    ["curve", "lambda", "C"],
]


def timed(arguments: list[str], folder: Path) -> tuple[float, float]:
    """Seconds of CPU and by the clock of one process whose compiled kernels lie in the folder."""
    environment = {name: value for name, value in os.environ.items() if name != "GRUEBLER_KERNELS"}
    before, start = os.times(), time.perf_counter()
    subprocess.run(
        [sys.executable, *arguments],
        env=environment | {"NUMBA_CACHE_DIR": str(folder)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=True,
    )
    wall, after = time.perf_counter() - start, os.times()
    return after.children_user - before.children_user, wall


def middle(arguments: list[str], folder: Path, runs: int = 5) -> tuple[float, float]:
    found = [timed(arguments, folder) for _ in range(runs)]
    return statistics.median(cpu for cpu, _ in found), statistics.median(wall for _, wall in found)


def main() -> None:
    with tempfile.TemporaryDirectory() as made:
        for title, code in (("python -c pass", "pass"), ("import gruebler", "import gruebler")):
            cpu, wall = middle(["-c", code], Path(made))
            print(f"{title:45} {cpu:7.2f} s CPU {wall:7.2f} s")
        for command in COMMANDS:
            arguments, name = ["-m", "gruebler", *command], " ".join(command)
            folder = Path(made) / str(COMMANDS.index(command))
            folder.mkdir(mode=0o700)
            cold = timed(arguments, folder)
            warm = middle(arguments, folder, 3)
            print(
                f"{name[:45]:45} cold {cold[0]:6.2f} s CPU {cold[1]:6.2f} s, warm {warm[0]:5.2f} s CPU {warm[1]:5.2f} s"
            )


if __name__ == "__main__":
    main()
