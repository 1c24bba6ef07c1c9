"""Every test asserts something, whatever its examples are: no assertion stands under an `if` alone."""

from __future__ import annotations

import ast
import re
import subprocess
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent
FILES = sorted(FOLDER.rglob("test_*.py"))
NAMES = frozenset({"raises", "warns", "fail", "exit"})  # of pytest
LEAVES = (ast.Return, ast.Continue, ast.Break)

# What need not assert, with the reason.
EXCEPTIONS = {"base/test_doors.py::test_the_good_call_is_good": "that the call raises nothing is all that it says"}

Function = ast.FunctionDef | ast.AsyncFunctionDef
Helpers = frozenset[str]


def functions(tree: ast.AST) -> list[Function]:
    return [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]


def always(block: Sequence[ast.stmt], helpers: Helpers) -> bool:
    """Whether a block asserts on every way through it; loops are taken to run, `assume` and skips to let it go on."""
    for node in block:
        if _asserts(node, helpers):
            return True
        if any(_leaves(way) and not always(way, helpers) for way in _ways(node)):
            return False
    return False


def _ways(node: ast.stmt) -> list[list[ast.stmt]]:
    """The blocks of which one is run."""
    match node:
        case ast.If(_, body, orelse):
            return [body, orelse]
        case ast.Match(_, cases):
            return [case.body for case in cases]
        case ast.Try(body, handlers, orelse):
            return [[*body, *orelse], *(handler.body for handler in handlers)]
    return []


def _leaves(block: list[ast.stmt]) -> bool:
    return any(isinstance(node, LEAVES) for statement in block for node in ast.walk(statement))


def _asserts(node: ast.stmt, helpers: Helpers) -> bool:
    match node:
        case ast.Assert():
            return True
        case ast.Expr(value) | ast.Assign(value=value) | ast.Return(value=ast.expr() as value):
            return any(name in NAMES or name in helpers or name.startswith("assert_") for name in _called_in(value))
        case ast.With(items, body):
            return any(_called(item.context_expr) & NAMES for item in items) or always(body, helpers)
        case ast.For(body=body) | ast.While(body=body):
            return always(body, helpers)
        case ast.Try(finalbody=final) if always(final, helpers):
            return True
    ways = _ways(node)
    return bool(ways) and all(always(way, helpers) for way in ways)


def _called(node: ast.AST) -> Helpers:
    """The last word of what a call calls."""
    if not isinstance(node, ast.Call):
        return frozenset()
    return frozenset({getattr(node.func, "attr", "") or getattr(node.func, "id", "")})


@cache
def _called_in(value: ast.expr) -> Helpers:
    """What an expression calls; asked again in each round of `asserting`."""
    return frozenset[str]().union(*map(_called, ast.walk(value)))


def asserting(trees: Mapping[Path, ast.Module]) -> dict[Path, Helpers]:
    """For each file the names of functions that always assert: its own ones, then those of all others."""
    own = {path: [each for each in functions(tree) if each.name[:5] != "test_"] for path, tree in trees.items()}
    known: dict[Path, Helpers] = dict.fromkeys(trees, frozenset())
    while True:
        found = {
            path: frozenset(each.name for each in made if always(each.body, known[path])) for path, made in own.items()
        }
        every = frozenset[str]().union(*found.values())
        more = {path: found[path] | (every - {each.name for each in made}) for path, made in own.items()}
        if more == known:
            return known
        known = more


def test_every_test_asserts_always() -> None:
    trees = {path: ast.parse(path.read_text("utf-8")) for path in sorted(FOLDER.rglob("*.py"))}
    helpers = asserting(trees)
    found = [
        f"{path.relative_to(FOLDER).as_posix()}::{function.name}"
        for path in FILES
        for function in functions(trees[path])
        if function.name.startswith("test_") and not always(function.body, helpers[path])
    ]
    assert len(FILES) > 100
    assert [name for name in found if name not in EXCEPTIONS] == []
    assert sorted(EXCEPTIONS) == sorted(name for name in found if name in EXCEPTIONS)


@pytest.mark.parametrize(
    ("body", "wanted"),
    [
        ("assert x", True),
        ("with pytest.raises(ValueError):\n    f()", True),
        ("for y in (1, 2):\n    assert y", True),
        ("check(x)", True),
        ("np.testing.assert_allclose(x, 1)", True),
        ("if x:\n    assert x\nelse:\n    check(x)", True),
        ("assume(x)\nassert x", True),
        ("f(x)", False),
        ("if x:\n    assert x", False),
        ("for y in (1, 2):\n    if y:\n        assert y", False),
        ("if x:\n    return\nassert x", False),
        ("if x:\n    assert x\n    return\nassert not x", True),
        ("for y in (1, 2):\n    if y:\n        continue\n    assert y", False),
        ("try:\n    f()\nexcept ValueError:\n    assert x", False),
    ],
)
def test_what_always_asserts(body: str, wanted: bool) -> None:
    assert always(ast.parse(body).body, frozenset({"check"})) == wanted


def test_what_make_and_ci_run_is_there():
    """A path that is not there would be an error of pytest only on the day when that part runs."""
    root = FOLDER.parent
    made = subprocess.run(["make", "-pn", "help"], cwd=root, capture_output=True, text=True, check=False).stdout
    words = set(re.findall(r"tests/[\w/.]+", made + (root / ".ci/run").read_text(encoding="utf-8")))
    assert {"tests/mechanics", "tests/structure/mobility", "tests/files/test_dxf.py"} <= words
    assert sorted(word for word in words if not (root / word).exists()) == []


def test_what_the_workflows_make_stands_in_the_makefile():
    root = FOLDER.parent
    if not (root / ".github").is_dir():
        pytest.skip("the workflows are not part of a source distribution")
    known = re.findall(r"^([a-z-]+):", (root / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    texts = [path.read_text(encoding="utf-8") for path in sorted((root / ".github" / "workflows").glob("*.yml"))]
    called = {name for text in texts for name in re.findall(r"- run: make ([a-z-]+)", text)}
    called |= {name for text in texts for row in re.findall(r"target: \[(.+)\]", text) for name in row.split(", ")}
    assert len(called) > 5
    assert called <= {*known}


def test_mutants_are_tried_in_every_room():
    """A wing whose tests lie in one folder is one room."""
    workflow = FOLDER.parent / ".github" / "workflows" / "scheduled.yml"
    if not workflow.exists():
        pytest.skip("the workflows are not part of a source distribution")
    doors = (FOLDER.parent / "src" / "gruebler").glob("*/**/__init__.py")
    rooms = {path.parent.relative_to(FOLDER.parent / "src" / "gruebler") for path in doors}
    tried = {(room if (FOLDER / room).is_dir() else room.parent).as_posix() for room in rooms}
    tried -= {room.split("/")[0] for room in tried if "/" in room}
    assert sorted(tried - set(workflow.read_text(encoding="utf-8").split())) == []
    assert len(tried) > 20
