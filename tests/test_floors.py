"""The layers of the library are kept: every module has a floor, imports run downward only, no two files need each
other."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

import gruebler

PACKAGE = Path(gruebler.__file__).parent
ROOT = Path(__file__).parents[1]

# From the ground up. A wing imports the wings before it; a room within it the rooms on lower floors and its own files.
WINGS = {
    "_core": [{"_core"}],
    "base": [
        {"errors"},
        {"text"},
        {
            "angles",
            "arrays",
            "atomic_files",
            "convex_hull",
            "disjoint_sets",
            "documents",
            "doors",
            "events",
            "immutable",
            "notebook",
            "plain_data",
            "private_folder",
            "units",
        },
        {"columns", "formulas", "jets"},
    ],
    "structure": [
        {"chain"},
        {"mobility", "isomorphism"},
        {"enumeration", "mechanism"},
        {"assur"},
        {"transformations", "type_synthesis"},
        {"atlas"},
        {"count_tables"},
    ],
    "machines": [{"cams", "gears", "geneva"}],
    "mechanics": [
        {"linkages"},
        {"fourbar"},
        {"kinematics"},
        {"analysis", "screws", "forces"},
        {"dynamics", "geometry", "space"},
    ],
    "design": [{"realisation"}, {"synthesis"}],
    "files": [{"files"}],
    "pictures": [{"canvas"}, {"machines", "structure"}, {"linkage", "space"}, {"designs", "values"}],
    "teaching": [{"catalog"}, {"constructions", "exercises", "sheets"}, {"worksheets"}],
    "page": [{"page"}],
    "cli": [{"cli"}],
}
WHOLE = {"_core", "files", "page", "cli"}  # wings of one room: their files
FLOORS = {
    f"{wing}/{room}" if wing not in WHOLE else wing: (k, floor)
    for k, (wing, floors) in enumerate(WINGS.items())
    for floor, rooms in enumerate(floors)
    for room in rooms
}
ENTRANCES = {"", "__main__"}  # the front door looks into every room, lazily; python -m opens the command line
DOORS = set(WINGS) - WHOLE  # a wing's own file opens its rooms, lazily
HEAVY = {"numba", "networkx", "scipy", "rich", "msgspec"}  # never at the top of the modules behind `import gruebler`


def room(module):
    """Where a module stands: wing and room, as mechanics/kinematics; a wing of one room is that room."""
    parts = module.split(".")
    return parts[0] if parts[0] in WHOLE else "/".join(parts[:2])


def depth(module):
    """How high a module stands: its wing, then its floor; what has no floor above all."""
    return FLOORS.get(room(module), (len(WINGS), 0))


def modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), path


FILES = dict(modules())


def tree(module):
    """The syntax of a file."""
    return ast.parse(FILES[module].read_text(encoding="utf-8"))


def imports(top):
    """The statements of a file that import, anywhere in it; each with whether it stands in a function."""
    open_nodes = [(top, False)]
    while open_nodes:
        node, inside = open_nodes.pop()
        if isinstance(node, ast.Import | ast.ImportFrom):
            yield node, inside
        elif not isinstance(node, ast.expr):  # no expression holds a statement
            inside = inside or isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
            open_nodes += [(child, inside) for child in ast.iter_child_nodes(node)]


@cache
def all_edges():
    """What each file imports of this package: anywhere, in functions and for type checking too.

    By names of modules, each with whether the import stands in a function.
    """
    trees = {name: tree(name) for name in FILES}
    defined = {name: {*names_of(top)} for name, top in trees.items() if name}

    def meant(node):
        if isinstance(node, ast.Import):
            return [alias.name.removeprefix("gruebler.") for alias in node.names if alias.name.startswith("gruebler.")]
        if not node.module or node.module.split(".")[0] != "gruebler":
            return []
        base = node.module.removeprefix("gruebler").lstrip(".")
        full = {alias.name: f"{base}.{alias.name}".lstrip(".") for alias in node.names}
        # a function of a package may have the name of its file: the file is meant only where a name is not
        return [path if path in FILES and name not in defined.get(base, ()) else base for name, path in full.items()]

    return {
        name: sorted({(other, inside) for node, inside in imports(top) for other in meant(node) if other})
        for name, top in trees.items()
    }


def names_of(top):
    """What a file defines, or imports by name, at its top."""
    for node in top.body:
        if isinstance(node, ast.ImportFrom):
            yield from (alias.asname or alias.name for alias in node.names)
        elif hasattr(node, "name"):
            yield node.name


def test_every_module_has_a_floor():
    without = [name for name in FILES if name not in ENTRANCES | DOORS and room(name) not in FLOORS]
    assert without == []


def test_imports_run_downward():
    wrong = [
        f"{name} imports {other}"
        for name, edges in all_edges().items()
        if name not in ENTRANCES | DOORS
        for other, _ in edges
        if room(other) != room(name) and depth(other) >= depth(name)
    ]
    assert wrong == []


def test_no_two_files_need_each_other():
    """Within a room no imports form a circle, those in functions and for type checking included."""
    graph = {
        name: [other for other, _ in edges if room(other) == room(name)]
        for name, edges in all_edges().items()
        if name not in ENTRANCES
    }
    done = set()

    def visit(name, path):
        assert name not in path, " -> ".join([*path, name])
        if name not in done:
            for other in graph.get(name, ()):
                visit(other, [*path, name])
            done.add(name)

    for name in graph:
        visit(name, [])


def test_architecture_has_the_same_floors():
    page = ROOT / "ARCHITECTURE.md"
    rows = re.findall(r"^\| `(\w+)/?` \| ([^|]*)\|", page.read_text(encoding="utf-8"), re.MULTILINE)
    written = {wing: [set(re.findall(r"`([a-z_]+?)/?`", floor)) for floor in rooms.split("→")] for wing, rooms in rows}
    assert written == {wing: [set()] if wing in WHOLE else floors for wing, floors in WINGS.items()}


def test_the_package_has_few_entries():
    modules = {file.name for file in PACKAGE.glob("_core.*") if file.suffix in {".so", ".pyd"}}  # one a Python
    entries = {path.name for path in PACKAGE.iterdir()} - {"__pycache__"} - modules
    assert entries == {*WINGS} - {"_core"} | {"_core.pyi", "__init__.py", "__init__.pyi", "__main__.py", "py.typed"}


def test_no_module_of_the_front_door_has_the_word_of_a_class_or_function():
    words = [name for name in gruebler.__all__ if name not in WINGS]
    assert not {word.lower() for word in words} & set(WINGS)


def test_the_front_door_is_light():
    """What `import gruebler` and the parser load imports nothing heavy at its top."""
    for name in ("", "base.errors", "structure.chain.pairs", "structure.chain.notation", "structure.chain", "cli"):
        top = tree(name).body
        names = {alias.name.split(".")[0] for node in top if isinstance(node, ast.Import) for alias in node.names}
        names |= {(node.module or "").split(".")[0] for node in top if isinstance(node, ast.ImportFrom)}
        assert not names & (HEAVY | {"numpy"}), name


def test_the_front_door_has_no_other_names():
    with pytest.raises(AttributeError, match=r"attribute 'chian'"):
        gruebler.chian  # noqa: B018
