"""The house in numbers: lines of each wing, files that a walk through it enters, imports and registrations apart."""

import sys
import tempfile
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path

import gruebler as gr
from gruebler.cli import main as command

PACKAGE = Path(gr.__file__).parent
# Nine places of a smooth curve, none of them special.
NINE = "x,y\n0.25,0\n0.52,0.1\n0.8,0.7\n1.2,1\n1.4,1.3\n1.1,1.48\n0.7,1.4\n0.2,1\n0.02,0.4\n"


def entered(words: list[str]) -> set[Path]:
    """The files of the package in which a function runs when a command runs for the second time."""
    names: set[str] = set()

    def seen(frame, event, _) -> None:
        if event == "call":
            names.add(frame.f_code.co_filename)

    with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
        command(words)
        sys.setprofile(seen)
        try:
            command(words)
        finally:
            sys.setprofile(None)
    return {path.relative_to(PACKAGE) for path in map(Path, names) if path.is_relative_to(PACKAGE)}


def main() -> None:
    total = 0
    for wing in sorted(path for path in PACKAGE.iterdir() if any(path.glob("*.py"))):
        lines = sum(len(path.read_text(encoding="utf-8").splitlines()) for path in wing.rglob("*.py"))
        total += lines
        print(f"{wing.name:12} {lines:7,} lines")
    print(f"{'together':12} {total:7,} lines")
    with tempfile.TemporaryDirectory() as folder:
        linkage = gr.write(gr.FourBar(25, 70, 40, 70), Path(folder, "four-bar.toml"))
        nine = Path(folder, "nine.csv")
        nine.write_text(NINE, encoding="utf-8")
        for name, words in {
            "the text of a chain to its mobility": ["check", "R(0-1) R(1-2) R(2-3) R(3-0)"],
            "a file to the table of its motion": ["analyse", str(linkage)],
            "all chains of 12 links to a file": ["enumerate", "--links", "12", "-o", str(Path(folder, "chains.g6"))],
            "nine points to designs": ["synthesise", "path", str(nine)],
        }.items():
            files = entered(words)
            wings = {path.parts[0] for path in files}
            print(f"{name:36} {len(files):3} files in {len({path.parent for path in files})} rooms, {len(wings)} wings")
