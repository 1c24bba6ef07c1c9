"""Compiled kernels are never older than any of the sources that went into them."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import gruebler
from gruebler._numeric.compiling import cache_folder

NUMERIC = Path(gruebler.__file__).parent / "_numeric"


def test_every_kernel_is_compiled_by_our_decorator():
    for path in NUMERIC.glob("*.py"):
        text = path.read_text(encoding="utf-8")
        if path.name != "compiling.py":
            assert not re.search(r"^from numba import .*njit|^import numba|numba\.njit", text, re.MULTILINE), path.name
        assert "@njit" not in text or "cache=True" in text, path.name


def test_another_source_gives_another_folder(tmp_path):
    """Changing any kernel file, even one that others only call, leads to a fresh cache."""
    shutil.copytree(NUMERIC.parent, tmp_path / "gruebler", ignore=shutil.ignore_patterns("__pycache__"))
    ask = "from gruebler._numeric.compiling import cache_folder as f; print(f())"

    def folder():
        done = subprocess.run([sys.executable, "-c", ask], cwd=tmp_path, capture_output=True, text=True, check=True)
        return Path(done.stdout.strip())

    first = folder()
    assert first == folder()
    assert first.name.startswith("kernels-")
    assert first.name == cache_folder().name
    with (tmp_path / "gruebler" / "_numeric" / "partition.py").open("a", encoding="utf-8") as file:
        file.write("# changed\n")
    assert folder() != first
