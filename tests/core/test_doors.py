"""Whatever a door of the core is called with, it answers or raises in words: fuzz_doors.py in a process of its own."""

import os
import subprocess
import sys

import pytest

from tests.core.test_building import ROOT, in_module

if not sys.platform.startswith("linux"):
    pytest.skip("limits memory and sends signals as Linux does", allow_module_level=True)

from tests.core import fuzz_doors


def test_every_door_has_a_sound_call(core):
    doors = {name.split(".")[0] for name, _ in in_module(core)}
    assert {name for name, _ in fuzz_doors.good_calls()} == doors


@pytest.mark.skipif(
    "asan" in os.environ.get("LD_PRELOAD", ""), reason="where memory is refused, the sanitizer ends the process itself"
)
def test_no_call_makes_a_door_crash():
    """A crash ends the process: its return code and its last line tell which call it was."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.core.fuzz_doors", "20"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=600,
        check=False,
    )
    assert done.returncode == 0, (done.stdout.splitlines()[-1:], done.stderr[-2000:])
    finished = {line.split()[0]: line for line in done.stdout.splitlines() if not line.startswith(" ")}
    assert finished.keys() == {name for name, _ in fuzz_doors.good_calls()}
    assert all(" 0 answered" not in line for line in finished.values())
