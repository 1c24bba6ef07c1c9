"""From a linkage file to the printed table: each room is entered once, in the order of the layers."""

import sys
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

import gruebler as gr
from gruebler.cli import main
from tests.test_floors import PACKAGE, depth, room

WORKING = {"files", "mechanics/kinematics", "mechanics/analysis", "base/columns", "cli"}  # the others hold values


class Walk:
    """Calls between the files of the package, as they happen."""

    def __init__(self):
        self.entered, self.upward, self.calls = [], [], Counter()

    def __enter__(self):
        sys.setprofile(self._seen)
        return self

    def __exit__(self, *_):
        sys.setprofile(None)

    def _seen(self, frame, event, _):
        code = frame.f_code
        if event != "call" or code.co_name == "<module>" or (module := module_of(code.co_filename)) is None:
            return
        self.calls[f"{module}.{code.co_qualname}"] += 1
        if room(module) in WORKING and room(module) not in self.entered:
            self.entered.append(room(module))
        caller = frame.f_back
        while caller is not None and module_of(caller.f_code.co_filename) in (None, *PASSING_ON):
            caller = caller.f_back
        if caller is not None:
            calling = module_of(caller.f_code.co_filename)
            if (
                room(calling) != room(module)
                and depth(calling) < depth(module)
                and module
                and not room(module).startswith("base/")
            ):
                self.upward.append(f"{calling} calls {module}.{code.co_qualname}")


PASSING_ON = {"base.doors", "base.errors", "base.immutable"}
"""A door checks arguments, what is unwarned is called without warnings, equality asks for keys: they go on."""


@cache
def module_of(path):
    path = Path(path)
    if not path.is_relative_to(PACKAGE):
        return None
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return gr.write(gr.FourBar(25, 70, 40, 70), tmp_path_factory.mktemp("walk") / "four-bar.toml")


def test_the_library_enters_each_room_once(path):
    def table():
        return gr.move(gr.read(path), gr.from_degrees(0, 90, 30)).table().csv()

    table()  # what is imported or compiled once is not part of the walk
    with Walk() as walk:
        table()
    assert walk.entered == ["files", "mechanics/kinematics", "mechanics/analysis", "base/columns"]
    assert walk.upward == []


def test_a_command_does_everything_once(path, capsys):
    arguments = ["analyse", str(path), "--range", "0:90:30"]
    assert main(arguments) == 0
    with Walk() as walk:
        assert main(arguments) == 0
    assert capsys.readouterr().out
    assert walk.entered == ["cli", "files", "mechanics/analysis", "mechanics/kinematics", "base/columns"]
    # Functions that are given to a solver come back; values that hold others ask them for their hash and equality.
    passed = [call for call in walk.upward if "<locals>" not in call and not call.endswith(("__hash__", "__eq__"))]
    assert passed == []
    once = (
        "files.linkages.read_linkage",
        "mechanics.linkages.lower_pairs.with_lower_pairs",
        "mechanics.analysis.drive_cycles.drive_cycle",
        "mechanics.kinematics.circuits.circuit",
        "mechanics.analysis.table.motion_table",
    )
    assert {name: walk.calls[name] for name in once} == dict.fromkeys(once, 1)
