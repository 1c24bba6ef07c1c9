"""Changes lines of rooms, one at a time in a copy, and runs the fast tests of the room: do they notice?

    $ make mutants ROOM=mobility
    $ python -m tests.mutation geometry cams --number 15 --seed 3

Printed are a row for each room and the changes that no test of the room noticed. Tests of other rooms are not asked.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from tests.mutation.mutants import Mutant, mutants

ROOT = Path(__file__).parents[2]
COPIED = ("src", "tests", "catalogs", "docs", "benchmarks", "pyproject.toml", "README.md", "CHANGELOG.md")
PATIENCE = 10  # times as long as without a change; an endless loop is noticed


def place(room: str) -> str:
    """Where a room lies below the package: mobility, or structure/mobility, is structure/mobility."""
    package = ROOT / "src" / "gruebler"
    for folder in (package, *sorted(path for path in package.iterdir() if path.is_dir())):
        if (folder / room).is_dir() or (folder / f"{room}.py").is_file():
            return (folder / room).relative_to(package).as_posix()
    raise SystemExit(f"there is no room {room!r} in {package}")


def sources(room: str) -> list[Path]:
    """The files of a room, from the root."""
    path = ROOT / "src" / "gruebler" / place(room)
    files = sorted(path.rglob("*.py")) if path.is_dir() else [path.with_suffix(".py")]
    return [path.relative_to(ROOT) for path in files]


def to_run(room: str) -> list[str]:
    """What pytest runs for a room: its tests and its doctests."""
    path = Path(place(room))
    tests = [Path("tests", path), Path("tests", path.parent, f"test_{path.name}.py")]
    own = [*tests, Path("src", "gruebler", path), Path("src", "gruebler", path).with_suffix(".py")]
    return [path.as_posix() for path in own if (ROOT / path).exists()]


def passes(copy: Path, room: str, seconds: float | None = None) -> bool:
    """Whether the tests of a room pass in a copy; not if they take too long."""
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-n", "0", "-p", "no:cacheprovider", *to_run(room)]
    paths = {"PYTHONPATH": str(copy / "src"), "PYTHONDONTWRITEBYTECODE": "1"}
    try:
        done = subprocess.run(
            command, check=False, cwd=copy, env=os.environ | paths, capture_output=True, timeout=seconds
        )
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def survivors(copy: Path, room: str, number: int, seed: int) -> tuple[int, list[str]]:
    """How many mutants were tried, and those that the tests of the room did not notice."""
    every: list[tuple[Path, Mutant]] = [
        (path, each) for path in sources(room) for each in mutants((ROOT / path).read_text("utf-8"))
    ]
    chosen = random.Random(f"{seed} {room}").sample(every, min(number, len(every)))
    begun = time.monotonic()
    if not passes(copy, room):
        raise SystemExit(f"{room}: its tests fail without any change")
    seconds = 30 + PATIENCE * (time.monotonic() - begun)
    lived = []
    for path, each in sorted(chosen):
        whole = (copy / path).read_text("utf-8")
        (copy / path).write_text(each.text, "utf-8")
        if passes(copy, room, seconds):
            lived.append(f"{path.as_posix()}:{each.line}: {each.before} -> {each.after}")
        (copy / path).write_text(whole, "utf-8")
        print(".", end="", flush=True, file=sys.stderr)
    return len(chosen), lived


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__.split("\n")[0])
    parser.add_argument("rooms", nargs="+", help="folders or files of src/gruebler, such as mobility or geneva")
    parser.add_argument("--number", type=int, default=20, help="mutants of each room, chosen at random")
    parser.add_argument("--seed", type=int, default=1, help="of the choice")
    chosen = parser.parse_args(arguments)
    for room in chosen.rooms:
        if not sources(room) or not to_run(room):
            parser.error(f"no room {room} with tests")
    rows, lines = ["| room | mutants | killed | survived |", "|---|---|---|---|"], []
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder)
        for name in COPIED:
            if (ROOT / name).is_dir():
                shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__", "_pictures"))
            else:
                shutil.copy(ROOT / name, copy / name)
        for room in chosen.rooms:
            count, lived = survivors(copy, room, chosen.number, chosen.seed)
            rows.append(f"| `{room}` | {count} | {count - len(lived)} | {len(lived)} |")
            lines += lived
    print("", *rows, "", *lines, sep="\n")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
