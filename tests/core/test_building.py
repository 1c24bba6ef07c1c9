"""What the compiled module and its object files hold."""

import ast
import json
import os
import re
import shlex
import shutil
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from gruebler import _core

ROOT = Path(__file__).parents[2]
STUB = Path(_core.__file__).with_name("_core.pyi")


def parameters(door):
    """The parameters of a door, the kinds of numbers in each, and their defaults."""
    arguments = door.args
    kinds = {
        each.arg: re.findall(r"\b(?:bool|u?int\d*|float\d*|complex\d*|str)\b", ast.unparse(each.annotation))
        for each in (*arguments.args, *arguments.kwonlyargs)
        if each.annotation
    }
    defaults = [ast.unparse(each) for each in (*arguments.defaults, *arguments.kw_defaults)]
    return kinds, len(arguments.kwonlyargs), defaults


def in_stub(members):
    """The doors of a stub, those of its classes by Class.method."""
    for node in members:
        if isinstance(node, ast.FunctionDef):
            yield node.name, parameters(node)
        elif isinstance(node, ast.ClassDef):
            yield from ((f"{node.name}.{name}", door) for name, door in in_stub(node.body))


def in_module(owner):
    """The doors of the module, by the signatures that nanobind keeps: a default is a number of a table."""
    for name, door in vars(owner).items():
        if isinstance(door, type):
            yield from ((f"{name}.{method}", parameters) for method, parameters in in_module(door))
        elif hasattr(door, "__nb_signature__"):
            doors = []
            for signature, _, defaults in door.__nb_signature__:
                head = re.sub(r"numpy\.ndarray\[dtype=(\w+)[^]]*\]", r"NDArray[\1]", signature.split(" -> ")[0])
                for number, default in enumerate(defaults or ()):
                    head = head.replace(f"\\{number}", repr(default))
                doors.append(parameters(ast.parse(f"{head}: ...").body[0]))
            assert doors.count(doors[0]) == len(doors)  # overloads differ in the shapes of arrays alone
            yield name, doors[0]


def test_the_stub_says_what_the_module_has(core):
    stub = ast.parse(STUB.read_text(encoding="utf-8"))
    assert dict(in_stub(stub.body)) == dict(in_module(core))


def symbols(file):
    """The symbols that a linker may take from an object file, with their kinds."""
    lines = subprocess.run(["nm", "-C", "--defined-only", file], capture_output=True, text=True, check=True).stdout
    found = [line.split(maxsplit=2)[1:] for line in lines.splitlines()]
    return {(kind, name) for kind, name in found if (kind.isupper() and kind not in "BDR") or kind in "uvw"}


@pytest.mark.skipif(not shutil.which("nm"), reason="needs nm")
@pytest.mark.parametrize("level", ["v3", "v4"])
def test_levels_share_no_function(level):
    """Of two functions of one name the linker keeps one: it could be the one that the processor does not know."""
    files = sorted((ROOT / "build" / "core" / "CMakeFiles" / f"kernels_{level}.dir").rglob("*.o*"))
    if not files:
        pytest.skip("no levels here, or not built here")
    shared = {
        name
        for file in files
        for _, name in symbols(file)
        if not re.search(rf"gruebler::\w+::{level}::", name) and "personality" not in name
    }
    assert shared == set()


@pytest.mark.skipif(not shutil.which("objdump"), reason="needs objdump")
@pytest.mark.parametrize("level", ["", "_v3", "_v4"])
def test_no_product_is_fused_with_a_sum(level):
    """It would be rounded once, not twice: other bits than elsewhere. `-ffp-contract=off` alone does not prevent it."""
    files = sorted((ROOT / "build" / "core" / "CMakeFiles" / f"kernels{level}.dir").rglob("*.o"))
    if not files:
        pytest.skip("no such level here, or not built here")
    for file in files:
        code = subprocess.run(["objdump", "-d", file], capture_output=True, text=True, check=True).stdout
        assert not re.findall(r"\b(?:vfn?m(?:add|sub)|fn?m(?:add|sub|la|ls))\w*\s", code), file


SWEEP = ROOT / "core" / "src" / "motion" / "sweep.cpp"
DYADS = ROOT / "core" / "src" / "design" / "lanes.cpp"
TRACKER = ROOT / "core" / "src" / "algebra" / "tracking.cpp"


def lane_loops(source):
    """The line of each loop marked EACH_LANE, and how often it is compiled: templates for four orders."""
    copies, found = 1, {}
    for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith(("template", "}")):
            copies = 4 if line.startswith("template <int order>") else 1
        elif line.strip() == "EACH_LANE":
            found[number + 1] = copies
    return found


def compilation(source, level):
    """The command that compiles a source for a level, with the folder in which it is called; skips without it."""
    try:
        commands = json.loads((ROOT / "build" / "core" / "compile_commands.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        pytest.skip("not built here")
    for each in commands:
        if Path(each["file"]) == source and f"/kernels{level}.dir/" in each["command"]:
            return shlex.split(each["command"]), each["directory"]
    pytest.skip("no such level here, or built from another folder")


def vectorised(source, level, file, width):
    """How often each line of a file is a loop over vectors of so many bytes, by GCC's own report."""
    command, folder = compilation(source, level)
    version = subprocess.run([command[0], "--version"], capture_output=True, text=True, check=False).stdout
    if "Free Software Foundation" not in version or "-O3" not in command:
        pytest.skip("asks GCC, and what it optimises")
    command[command.index("-o") + 1] = os.devnull
    report = subprocess.run(
        [*command, "-S", "-fopt-info-vec-optimized"], cwd=folder, capture_output=True, text=True, check=True
    ).stderr
    where = rf"{re.escape(file.name)}:(\d+):\d+: optimized: +loop vectorized using {width} byte vectors"
    return Counter(map(int, re.findall(where, report)))


@pytest.mark.parametrize("source", [SWEEP, DYADS], ids=lambda source: source.stem)
@pytest.mark.parametrize(("level", "width"), [("", 16), ("_v3", 32), ("_v4", 64)])
def test_loops_over_lanes_are_vectorised(source, level, width):
    """A branch or a call too many in a lane, and they go one by one."""
    seen = vectorised(source, level, source, width)
    loops = lane_loops(source)
    assert loops
    assert {line: copies for line, copies in loops.items() if seen[line] < copies} == {}


@pytest.mark.slow
@pytest.mark.parametrize(("level", "width"), [("", 16), ("_v3", 32), ("_v4", 64)])
def test_the_elimination_of_the_tracker_is_vectorised(level, width):
    """Rows are taken from all columns behind a pivot: the innermost loop of paths, for one right side and for two."""
    lanes = TRACKER.with_name("lanes.hpp")
    text = lanes.read_text(encoding="utf-8").splitlines()
    (call,) = [number for number, line in enumerate(text, 1) if "matrix.column[c].subtract(" in line]
    (body,) = [number for number, line in enumerate(text, 1) if "void subtract(" in line]
    seen = vectorised(TRACKER, level, lanes, width)
    assert seen[call] + seen[body + 1] >= 2  # compilers differ in which line they name
