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

# From the ground up. A room may import rooms on lower floors and its own files; errors, then texts, lie beneath them.
BENEATH = ["errors", "text"]
FLOORS = [
    {
        "angles",
        "arrays",
        "convex_hull",
        "disjoint_sets",
        "doors",
        "errors",
        "events",
        "text",
        "atomic_files",
        "documents",
        "notebook",
        "_numeric",
    },
    {"chain", "columns", "jets", "cams", "gears", "geneva", "drawing/canvas"},
    {"mobility", "isomorphism", "drawing/machines"},
    {"enumeration", "mechanism"},
    {"assur", "linkages", "drawing/structure"},
    {"fourbar", "transformations", "type_synthesis"},
    {"atlas", "kinematics"},
    {"analysis", "screws", "forces"},
    {"geometry", "realisation", "formats", "drawing/linkage"},
    {"synthesis", "catalog"},
    {"constructions", "exercises", "file_formats", "sheets"},
    {"files", "pictures", "teaching", "worksheets"},
    {"explorer"},
    {"cli"},
]
ENTRANCES = {"", "__main__"}  # the front door looks into every room, lazily; python -m opens the command line
DIVIDED = {"drawing"}  # its folders are rooms of their own, on floors of their own
HEAVY = {"numba", "networkx", "scipy", "rich", "msgspec"}  # never at the top of the modules behind `import gruebler`


def room(module):
    parts = module.split(".")
    return "/".join(parts[:2]) if parts[0] in DIVIDED else parts[0]


def floor(module):
    return next((k for k, rooms in enumerate(FLOORS) if room(module) in rooms), None)


def depth(module):
    """How high a module stands: what lies beneath the floors below them, what has no floor above all."""
    if module in BENEATH:
        return BENEATH.index(module) - len(BENEATH)
    return len(FLOORS) if floor(module) is None else floor(module)


def modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), path


FILES = dict(modules())


@cache
def tree(module):
    """The syntax of a file."""
    return ast.parse(FILES[module].read_text(encoding="utf-8"))


def imported(module):
    """The modules of this package that a file imports: anywhere, in functions and for type checking too.

    Yields each with whether the import stands in a function.
    """

    def walk(node, inside):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "gruebler":
            base = node.module.removeprefix("gruebler").lstrip(".")
            for alias in node.names:
                full = f"{base}.{alias.name}".lstrip(".")
                # a function of a package may have the name of its file: the file is meant only where a name is not
                yield (full if full in FILES and not defines(base, alias.name) else base), inside
        elif isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name.startswith("gruebler."):
                    yield alias.name.removeprefix("gruebler."), inside
        inside = inside or isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        for child in ast.iter_child_nodes(node):
            yield from walk(child, inside)

    yield from walk(tree(module), False)


def defines(module, name):
    if module not in FILES or module == "":
        return False
    for node in tree(module).body:
        if isinstance(node, ast.ImportFrom) and name in {alias.asname or alias.name for alias in node.names}:
            return True
        if getattr(node, "name", None) == name:
            return True
    return False


EDGES = {name: sorted({edge for edge in imported(name) if edge[0]}) for name in FILES}


def test_every_module_has_a_floor():
    without = [name for name in FILES if name not in ENTRANCES | DIVIDED and floor(name) is None]
    assert without == []


def test_imports_run_downward():
    wrong = [
        f"{name} imports {other}"
        for name, edges in EDGES.items()
        if name not in ENTRANCES
        for other, _ in edges
        if room(other) != room(name) and depth(other) >= depth(name)
    ]
    assert wrong == []


def test_no_two_files_need_each_other():
    """Within a room no imports form a circle, those in functions and for type checking included."""
    graph = {
        name: [other for other, _ in edges if room(other) == room(name)]
        for name, edges in EDGES.items()
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
    rows = re.findall(r"^\| (\d+) \| ([^|]*) \|", page.read_text(encoding="utf-8"), re.MULTILINE)
    written = {int(number) - 1: set(re.findall(r"`([a-z_/]+?)/?`", rooms)) for number, rooms in rows}
    assert written == dict(enumerate(FLOORS))


def test_the_front_door_is_light():
    """What `import gruebler` and the parser load imports nothing heavy at its top."""
    for name in ("", "errors", "chain.pairs", "chain.notation", "chain", "cli"):
        top = tree(name).body
        names = {alias.name.split(".")[0] for node in top if isinstance(node, ast.Import) for alias in node.names}
        names |= {(node.module or "").split(".")[0] for node in top if isinstance(node, ast.ImportFrom)}
        assert not names & (HEAVY | {"numpy"}), name


def test_the_front_door_has_no_other_names():
    with pytest.raises(AttributeError, match=r"attribute chian"):
        gruebler.chian  # noqa: B018
