"""One name, one thing: a class or a public function has its name alone, unless both are the same thing."""

import ast
from collections import defaultdict
from functools import cache
from pathlib import Path

import pytest

import gruebler
from tests.test_floors import FILES, room, tree

SOURCE = Path(gruebler.__file__).parent

# Names that several files define, with the reason why a reader is not led astray.
SHARED = {
    "add": "the protocol of a command: its arguments",
    "run": "the protocol of a command: what it does",
    "read": "one word: of a file, and at the front door of a catalog entry or lengths as well",
    "measures": "one question: in the plane, and at the front door in space as well (typed twice, for each answer)",
    "move": "one question: in the plane, and at the front door in space as well (typed twice, for each answer)",
    "assembly_modes": "one question: in the plane, and at the front door in space as well (typed twice, as `move`)",
    "circuit": "one question: in the plane, and at the front door in space as well (typed twice, as `move`)",
    "drive_range": "one question: in the plane, and at the front door in space as well (typed twice, as `move`)",
    "rotatability": "one question: in the plane, and at the front door in space as well (typed twice, as `move`)",
    "main": "where a process begins",
    "central_crank_rocker": "a fact of dead centres: constructed, and as an exercise",
    "inflection_circle": "one circle: computed, and constructed step by step",
    "four_bar": "methods of exercises are called by file and name: velocities.four_bar",
    "slider_crank": "methods of exercises are called by file and name: velocities.slider_crank",
}


# Names that say nothing of what they name. Arrays that a kernel fills are `out`, as in numpy.
EMPTY = {"found", "made", "mine", "one", "out", "told", "way"}
ALLOWED = {
    ("design.synthesis.dyads", "found"),  # fields of results: how many were found
    ("design.synthesis.results", "found"),
    ("base.text", "one"),  # the singular of `plural(one, many)`
}


@cache
def all_definitions():
    """The public classes and functions at the top of all files: kind, name, file."""
    kinds = ast.ClassDef | ast.FunctionDef
    tops = ((module, node) for module in FILES for node in tree(module).body if isinstance(node, kinds))
    return [(type(node), node.name, module) for module, node in tops if not node.name.startswith("_")]


def definitions(kind):
    """The public classes or functions, each with the files that define it."""
    places = defaultdict(list)
    for other, name, module in all_definitions():
        if other is kind:
            places[name].append(module)
    return places


def repeated(kinds):
    return {name: modules for name, modules in definitions(kinds).items() if len({*modules}) > 1}


def test_a_class_has_its_name_alone():
    assert repeated(ast.ClassDef) == {}


def test_a_public_function_has_its_name_alone():
    assert {name: modules for name, modules in repeated(ast.FunctionDef).items() if name not in SHARED} == {}


def bound_names(module):
    for node in ast.walk(tree(module)):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.arg):
            yield node.arg


def test_local_names_say_what_they_name():
    empty = {(module, name) for module in FILES for name in EMPTY & set(bound_names(module))}
    assert empty == ALLOWED


def test_no_class_has_the_name_of_a_function_but_for_capitals():
    functions = definitions(ast.FunctionDef)
    assert [name for name in definitions(ast.ClassDef) if name in functions] == []


@pytest.mark.parametrize("name", SHARED)
def test_shared_names_are_shared(name):
    assert len(repeated(ast.FunctionDef)[name]) > 1


def test_methods_of_exercises_are_in_their_room():
    for name in ("four_bar", "slider_crank"):
        assert {room(module) for module in definitions(ast.FunctionDef)[name]} == {"teaching/exercises"}


def test_no_module_stands_beside_a_function_of_the_same_word():
    """What a room gives is not hidden by its own file: ``room.word`` is one thing, whatever was imported before."""
    hidden = {
        f"{door.parent.relative_to(SOURCE)}/{name}.py"
        for door in SOURCE.rglob("__init__.py*")
        for name in imported(door)
        if (door.parent / f"{name}.py").is_file()
    }
    assert hidden == set()


def imported(door):
    """The functions and classes that the door of a room takes from files."""
    for node in ast.walk(ast.parse(door.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").strip("."):
            yield from (alias.asname or alias.name for alias in node.names)


def test_only_doors_list_their_names():
    """`__all__` says what a wing or room shows; in any other file the underscore says it."""
    files = [*SOURCE.rglob("*.py"), SOURCE.with_name("gruebler_command.py")]
    listing = [path for path in files if "__all__" in path.read_text("utf-8")]
    assert [path for path in listing if path.name != "__init__.py"] == []
    assert len(listing) > 30
