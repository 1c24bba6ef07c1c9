"""Kinds of elements, of linkages by their lengths, of fitted curves and of cam followers: no code outside their rooms
asks for one.

What a kind does stands in its class or in a row of a table by kinds. To refuse all kinds but one is no such question.
"""

import ast
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

import gruebler
from gruebler.machines.gears import KINDS as MESHES
from gruebler.mechanics.linkages import elements
from gruebler.mechanics.linkages.elements import Element
from gruebler.pictures.machines.train_shapes import BETWEEN

SOURCE = Path(gruebler.__file__).parent


def trees(words: Iterable[str]) -> Iterator[tuple[str, ast.Module]]:
    """The files in which one of the words stands, by their paths."""
    for path in sorted(SOURCE.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        if any(word in text for word in words):
            yield path.relative_to(SOURCE).as_posix(), ast.parse(text)


class Family(NamedTuple):
    """Kinds that stand in for one another."""

    names: frozenset[str]
    room: str
    """Where they are defined, and may be told apart."""


ELEMENTS = frozenset(
    name for name, each in vars(elements).items() if isinstance(each, type) and issubclass(each, Element)
) - {"Element"}
FAMILIES = (
    Family(ELEMENTS, "mechanics/linkages/elements.py"),
    Family(frozenset({"FourBar", "SliderCrank", "InvertedSliderCrank"}), "mechanics/fourbar"),
    Family(frozenset({"Flat", "Roller"}), "machines/cams"),
    Family(frozenset({"FOUR_BAR", "SLIDER_CRANK"}), "design/synthesis/four_bar_kinds.py"),
)
ALLOWED = {
    "mechanics/linkages/wheels.py": "radii from tooth numbers, meshes that repeat others: of toothed wheels only",
}
"""Files that ask for a kind all the same, and why."""


def kinds_in(node: ast.AST, known: set[str]) -> bool:
    """Whether an expression names a kind, other than by making one."""
    if isinstance(node, ast.Call):
        return False
    named = (isinstance(node, ast.Name) and node.id in known) or (
        isinstance(node, ast.Attribute) and node.attr in known
    )
    return named or any(kinds_in(child, known) for child in ast.iter_child_nodes(node))


def refusals(tree: ast.Module) -> Iterator[ast.expr]:
    """The conditions of what does nothing but raise."""
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and not node.orelse and all(isinstance(each, ast.Raise) for each in node.body):
            yield from ast.walk(node.test)


def questions(tree: ast.Module, names: frozenset[str]) -> Iterator[int]:
    """The lines in which a module asks for a kind."""
    known = {
        alias.asname or alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("gruebler")
        for alias in node.names
        if alias.name in names
    }
    known |= {
        target.id
        for node in tree.body
        if isinstance(node, ast.Assign)
        and isinstance(node.value, ast.BinOp | ast.Tuple)
        and kinds_in(node.value, known)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    refused = set(refusals(tree))
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Name("isinstance" | "issubclass"), args=[_, asked]):
                if node not in refused and kinds_in(asked, known):
                    yield node.lineno
            case ast.Compare() if any(kinds_in(side, known) for side in (node.left, *node.comparators)):
                yield node.lineno
            case ast.MatchClass() if kinds_in(node.cls, known):
                yield node.lineno


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.room)
def test_no_code_asks_for_a_kind(family):
    asked = {}
    for path, tree in trees(family.names):
        lines = [*questions(tree, family.names)]
        if lines and not path.startswith(family.room):
            asked[path] = lines
    assert {name: lines for name, lines in asked.items() if name not in ALLOWED} == {}
    assert family.names != ELEMENTS or {*ALLOWED} == {*asked}


def named_kinds(tree: ast.Module) -> Iterator[int]:
    """The lines in which the kind of a mesh, or a variable called so, is compared with the name of a kind."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            asked, *given = (node.left, *node.comparators)
            name = asked.attr if isinstance(asked, ast.Attribute) else getattr(asked, "id", "")
            texts = {each.value for side in given for each in ast.walk(side) if isinstance(each, ast.Constant)}
            if name == "kind" and texts & {*MESHES}:
                yield node.lineno


def test_no_code_asks_for_the_name_of_a_kind_of_mesh():
    """What it does stands in its row; "rack" and others are words of files, too, so only comparisons count."""
    assert {path: lines for path, tree in trees(["kind"]) if (lines := [*named_kinds(tree)])} == {}
    assert [*named_kinds(ast.parse('mesh.kind == "bevel"\nkind in ("belt", "chain")\nkind in KINDS'))] == [1, 2]


def test_every_kind_of_mesh_without_touching_wheels_has_a_picture():
    assert {*BETWEEN} == {name for name, kind in MESHES.items() if not kind.touching and not kind.crossing}


IMPORT = "from gruebler.mechanics.linkages import Line, Pin\n"


@pytest.mark.parametrize(
    "line",
    [
        "isinstance(e, Pin)",
        "not isinstance(e, (Line, Pin))",
        "isinstance(e, Pin | Line)",
        "type(e) is Pin",
        "type(e) in {Pin}",
        "{type(a), type(b)} == {Pin, Line}",
        "ROUND = (Pin, Line)\nisinstance(e, ROUND)",
        "match e:\n    case Pin(x, y):\n        pass",
        "if isinstance(e, Pin):\n    x = 1",
        "if not isinstance(e, Pin):\n    raise E\nelse:\n    x = 1",
    ],
)
def test_such_questions_are_found(line):
    assert [*questions(ast.parse(IMPORT + line), ELEMENTS)]


@pytest.mark.parametrize(
    "line",
    [
        "e.is_pin",
        "e == Pin(1, 2)",
        "ROWS = {Pin: 1}",
        "made = Pin(1, 2)",
        "if not isinstance(e, Pin):\n    raise E",
    ],
)
def test_other_lines_are_none(line):
    assert not [*questions(ast.parse(IMPORT + line), ELEMENTS)]
