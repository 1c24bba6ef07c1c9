"""Whatever a door of the core is called with, it answers or raises in words: fuzz_doors.py in a process of its own."""

import os
import subprocess
import sys

import numpy as np
import pytest

from tests.core.test_building import ROOT, in_module

if not sys.platform.startswith("linux"):
    pytest.skip("limits memory and sends signals as Linux does", allow_module_level=True)

from tests.core import fuzz_doors


def test_every_door_has_a_sound_call(core):
    doors = {name.split(".")[0] for name, _ in in_module(core)}
    assert {name for name, _ in fuzz_doors.good_calls()} == doors


def between_numbers(value):
    """An array of the same numbers that begins one byte late, for arguments that are arrays."""
    if not isinstance(value, np.ndarray) or not value.size:
        return value
    place = np.frombuffer(bytearray(b"\0" + value.tobytes()), value.dtype, offset=1).reshape(value.shape)
    assert not place.flags.aligned or value.itemsize == 1
    return place


def same(one, other):
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    return np.array_equal(one, other, equal_nan=isinstance(one, np.ndarray) and one.dtype.kind in "fc")


REFUSED_MEMORY = "exceeds maximum supported size"

WRITING = {"closing", "newton", "close_near_singular", "settle_on_curve", "evaluate_pose", "place_rods"}
"""Doors that write into arrays of the caller."""


def test_arrays_that_are_written_begin_at_a_number(core):
    calls = [(name, arguments) for name, arguments in fuzz_doors.good_calls() if name in WRITING]
    assert {name for name, _ in calls} == WRITING
    for name, arguments in calls:
        with pytest.raises(TypeError, match="incompatible function arguments"):
            getattr(core, name)(*map(between_numbers, arguments))


def test_arrays_that_begin_between_numbers_give_the_same(core):
    """Doors copy them; a sanitizer ends the process where one reads a number across two words."""
    apart = WRITING | {"MultipleJoints"}  # which answers an object
    calls = [(name, arguments) for name, arguments in fuzz_doors.good_calls() if name not in apart]
    late = [tuple(map(between_numbers, arguments)) for _, arguments in calls]
    doors = [getattr(core, name) for name, _ in calls]
    assert [
        name
        for door, (name, sound), shifted in zip(doors, calls, late, strict=True)
        if not same(door(*sound), door(*shifted))
    ] == []


def fuzzed(behind):
    """Calls of all doors but the first `behind`, of which the sound ones, in a process of their own."""
    options = {"ASAN_OPTIONS": f"{os.environ.get('ASAN_OPTIONS', '')}:max_allocation_size_mb=512"}
    return subprocess.run(
        [sys.executable, "-m", "tests.core.fuzz_doors", "20", str(behind)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=600,
        check=False,
        env=os.environ | options,
    )


def test_no_call_makes_a_door_crash():
    """A crash ends the process: its return code and its last line tell which call it was.

    Where memory is refused a sanitizer ends the process, too: then the next call is the first of another process.
    """
    done = fuzzed(0)
    printed = done.stdout.splitlines()
    while fuzz_doors.SANITIZED and REFUSED_MEMORY in done.stderr:
        done = fuzzed(behind=int(printed[-1].split(":")[0]))
        printed += done.stdout.splitlines()
    assert done.returncode == 0, (printed[-1:], done.stderr[-2000:])
    finished = {line.split()[0]: line for line in reversed(printed) if not line.startswith(" ")}
    assert finished.keys() == {name for name, _ in fuzz_doors.good_calls()}
    assert [line for line in finished.values() if " 0 answered" in line] == []
