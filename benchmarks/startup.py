"""How long it takes to start: whole processes, in seconds of CPU and by the clock."""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.house import NINE
from benchmarks.motion import class_three
from gruebler.files import values

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
    ["analyse", "geneva"],
    ["curve", "lambda", "C"],
]


def timed(arguments: list[str]) -> tuple[float, float]:
    """Seconds of CPU and by the clock of one process."""
    before, start = os.times(), time.perf_counter()
    subprocess.run(
        [sys.executable, *arguments],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=True,
    )
    wall, after = time.perf_counter() - start, os.times()
    return after.children_user - before.children_user, wall


def middle(arguments: list[str], runs: int = 5) -> tuple[float, float]:
    found = [timed(arguments) for _ in range(runs)]
    return statistics.median(cpu for cpu, _ in found), statistics.median(wall for _, wall in found)


def main() -> None:
    for title, code in (("python -c pass", "pass"), ("import gruebler", "import gruebler")):
        cpu, wall = middle(["-c", code])
        print(f"{title:45} {cpu:7.2f} s CPU {wall:7.2f} s")
    with tempfile.TemporaryDirectory() as folder:
        six, nine = Path(folder, "class-III.toml"), Path(folder, "nine.csv")
        values.write(class_three(), six)
        nine.write_text(NINE, encoding="utf-8")
        for command in [*COMMANDS, ["analyse", str(six)], ["synthesise", "path", str(nine)]]:
            cpu, wall = middle(["-m", "gruebler", *command], 3)
            print(f"{' '.join(command).replace(folder, '')[:45]:45} {cpu:7.2f} s CPU {wall:7.2f} s")


if __name__ == "__main__":
    main()
