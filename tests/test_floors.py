"""The plan of the house is kept: every module stands on a floor, and imports run downward only."""

import ast
import re
from pathlib import Path

import pytest

import gruebler

PACKAGE = Path(gruebler.__file__).parent
ROOT = Path(__file__).parents[1]

# From the ground up. A room may import rooms on lower floors and its own files.
FLOORS = [
    {"errors", "views", "_numeric"},
    {"pairs", "atomic_files"},
    {"notation"},
    {"chain"},
    {"mobility", "isomorphism"},
    {"enumeration", "mechanism"},
    {"assur", "inversion", "linkages", "gears", "cams", "geneva", "screws"},
    {"transformation", "specialisation", "kinematics"},
    {"drawing", "geometry", "realisation", "freedoms", "statics"},
    {"catalog", "synthesis"},
    {"exercises", "sheets"},
    {"cli"},
]
ENTRANCES = {"", "__main__"}  # the front door looks into every room, lazily; python -m opens the command line
HEAVY = {"numba", "networkx", "scipy", "rich", "msgspec"}  # never at the top of the modules behind `import gruebler`


def room(module):
    return module.split(".")[0]


def floor(module):
    return next((k for k, rooms in enumerate(FLOORS) if room(module) in rooms), None)


def modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), path


def imported(path):
    """The modules of this package that a file imports anywhere, also inside functions."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "gruebler":
            rest = node.module.removeprefix("gruebler").lstrip(".")
            yield from [rest] if rest else [alias.name for alias in node.names]
        elif isinstance(node, ast.Import):
            yield from (a.name.removeprefix("gruebler.") for a in node.names if a.name.startswith("gruebler."))


def test_every_module_has_a_floor():
    homeless = [name for name, _ in modules() if name not in ENTRANCES and floor(name) is None]
    assert homeless == []


def test_imports_run_downward():
    wrong = [
        f"{name} imports {other}"
        for name, path in modules()
        if name not in ENTRANCES
        for other in imported(path)
        if floor(other) is not None and room(other) != room(name) and floor(other) >= floor(name)
    ]
    assert wrong == []


def test_rooms_have_no_circles():
    """Within a room too: the files that it imports at their top form no circle."""
    graph = {}
    for name, path in modules():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        top = [node for node in tree.body if isinstance(node, ast.ImportFrom) and node.module]
        graph[name] = {node.module.removeprefix("gruebler.") for node in top if node.module.startswith("gruebler.")}
    done = set()

    def visit(name, path):
        assert name not in path, " -> ".join([*path, name])
        if name in graph and name not in done:
            for other in graph[name]:
                visit(other, [*path, name])
            done.add(name)

    for name in graph:
        visit(name, [])


def test_architecture_tells_the_same_floors():
    page = ROOT / "ARCHITECTURE.md"
    rows = re.findall(r"^\| (\d+) \| ([^|]*) \|", page.read_text(encoding="utf-8"), re.MULTILINE)
    told = {int(number) - 1: set(re.findall(r"`([a-z_]+)/?`", rooms)) for number, rooms in rows}
    assert told == dict(enumerate(FLOORS))


def test_the_front_door_is_light():
    """What `import gruebler` and the parser load imports nothing heavy at its top."""
    for name in ("", "errors", "pairs", "notation", "chain", "cli"):
        path = dict(modules())[name]
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names = {alias.name.split(".")[0] for node in tree.body if isinstance(node, ast.Import) for alias in node.names}
        names |= {(node.module or "").split(".")[0] for node in tree.body if isinstance(node, ast.ImportFrom)}
        assert not names & (HEAVY | {"numpy"}), name


def test_the_front_door_opens_every_name():
    assert sorted(gruebler.__all__) == sorted(gruebler._HOME)
    for name in gruebler.__all__:
        assert getattr(gruebler, name) is not None
    with pytest.raises(AttributeError, match=r"no attribute 'chian'"):
        gruebler.chian  # noqa: B018
