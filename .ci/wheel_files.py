"""Compare the files of a wheel with those of the source tree: python .ci/wheel_files.py WHEEL.

The wheel must hold every tracked file of the package, of the catalogs and of the tables of counts, byte for byte, and
beside them the compiled module alone: then what the tests say of the source tree holds for what is installed. Catalogs
of translators (.po) are left out: programs read the .mo beside them.
"""

import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
FOLDERS = {"src/gruebler": "gruebler", "catalogs": "gruebler/catalogs", "docs/tables": "gruebler/tables"}


def expected_files() -> dict[str, Path]:
    """Where each file of the source tree lies in a wheel."""
    tracked = subprocess.run(["git", "ls-files", *FOLDERS], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    files = {"gruebler_command.py": ROOT / "src" / "gruebler_command.py"}
    for name in tracked.split("\n")[:-1]:
        if name.endswith(".po"):
            continue
        folder = next(folder for folder in FOLDERS if name.startswith(f"{folder}/"))
        files[FOLDERS[folder] + name.removeprefix(folder)] = ROOT / name
    return files


def faults(wheel: Path) -> list[str]:
    """What the wheel lacks, has changed, or has too much; nothing if it is whole."""
    expected = expected_files()
    with zipfile.ZipFile(wheel) as archive:
        found = {name for name in archive.namelist() if ".dist-info/" not in name and not name.endswith("/")}
        modules = {name for name in found if name.startswith("gruebler/_core.") and name.endswith((".so", ".pyd"))}
        return [
            *(f"missing: {name}" for name in sorted(expected.keys() - found)),
            *(f"not tracked: {name}" for name in sorted(found - expected.keys() - modules)),
            *(f"changed: {n}" for n in sorted(expected.keys() & found) if archive.read(n) != expected[n].read_bytes()),
            *([] if len(modules) == 1 else [f"expected one compiled module, but found {len(modules)}"]),
        ]


if __name__ == "__main__":
    found = faults(Path(sys.argv[1]))
    print(*found, sep="\n")
    sys.exit(bool(found))
