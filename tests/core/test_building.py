"""What the object files of the kernels hold."""

import re
import shutil
import subprocess

import pytest


def symbols(file):
    """The symbols that a linker may take from an object file, with their kinds."""
    lines = subprocess.run(["nm", "-C", "--defined-only", file], capture_output=True, text=True, check=True).stdout
    found = [line.split(maxsplit=2)[1:] for line in lines.splitlines()]
    return {(kind, name) for kind, name in found if (kind.isupper() and kind not in "BDR") or kind in "uvw"}


@pytest.mark.skipif(not shutil.which("nm"), reason="no nm")
@pytest.mark.parametrize("level", ["v3", "v4"])
def test_levels_share_no_function(build_folder, level):
    """Of two functions of one name the linker keeps one: it could be the one that the processor does not know."""
    files = sorted((build_folder / "CMakeFiles" / f"kernels_{level}.dir").rglob("*.o*"))
    if not files:
        pytest.skip("no levels here")
    shared = {
        name
        for file in files
        for _, name in symbols(file)
        if not re.search(rf"gruebler::\w+::{level}::", name) and "personality" not in name
    }
    assert shared == set()
