"""How long it takes to start: whole processes, against a bare interpreter in the same run."""

import statistics
import subprocess
import sys
import time

COMMANDS = {
    "python -c pass": ["-c", "pass"],
    "import gruebler": ["-c", "import gruebler"],
    "gruebler --help": ["-m", "gruebler", "--help"],
    "gruebler check 'R(0-1) R(1-2) R(2-0)'": ["-m", "gruebler", "check", "R(0-1) R(1-2) R(2-0)"],
    "gruebler check (the whole catalog)": ["-m", "gruebler", "check"],
    "gruebler analyse four-bar:25,70,40,70": ["-m", "gruebler", "analyse", "four-bar:25,70,40,70"],
}


def seconds(arguments: list[str], runs: int = 7) -> float:
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL)
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main() -> None:
    bare = seconds(COMMANDS["python -c pass"])
    for title, arguments in COMMANDS.items():
        t = seconds(arguments)
        print(f"{title:40} {t:6.3f} s   {t / bare:5.1f} times a bare interpreter")


if __name__ == "__main__":
    main()
