"""Files that would take much memory or time: each in a process of its own, which measures itself."""

import gzip
import json
import random
import re
import subprocess
import sys
import tracemalloc
from pathlib import Path

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.files import values as files
from gruebler.mechanics.linkages import Linkage

PROGRAM = """
import json, re, sys, time
from pathlib import Path
from gruebler.files import values as files
from gruebler.base.errors import GrueblerError

begin = time.process_time()
try:
    said = type(files.read(Path(sys.argv[1]), left_out=[])).__name__
except GrueblerError as error:
    said = str(error)
memory = int(re.search(r"VmHWM:\\s*(\\d+)", Path("/proc/self/status").read_text())[1]) / 1024
print(json.dumps({"said": said, "memory": memory, "time": time.process_time() - begin}))
"""
ENTITIES = "".join(f'<!ENTITY x{k + 1} "{f"&x{k};" * 10}">' for k in range(12))
BOMB = f'<?xml version="1.0"?><!DOCTYPE a [{ENTITIES}]><linkage2>&x12;</linkage2>'
GRAPHML = '<graphml xmlns="http://graphml.graphdrawing.org/xmlns"><graph edgedefault="undirected">{}</graph></graphml>'
SLOTS = ",".join(f"J[RP, A[30.0], P[{k}.0, {k * k % 7}.0], L[ground, L{k % 9}, L{k % 11 + 9}]]" for k in range(590))


def _edges(count):
    return "".join(f"{k % 900} {k * 7 % 901 + 900}\n" for k in range(count))


HOSTILE = {
    "bomb.linkage2": lambda: BOMB,
    "bomb.graphml": lambda: BOMB,
    "utf-16.linkage2": lambda: BOMB.encode("utf-16"),
    "elements.linkage2": lambda: "<linkage2>" + "<a/>" * 480_000 + "</linkage2>",
    "connectors.linkage2": lambda: "<linkage2>" + '<connector x="1" y="2" id="3"/>' * 60_000 + "</linkage2>",
    "slots.pyslvs": lambda: f"M[{SLOTS}]",
    "deep.pyslvs": lambda: "M[" * 900_000,
    "deep.dot": lambda: "graph {" + "{" * 900_000,
    "long.dot": lambda: "graph {" + "--".join(f"a{k}" for k in range(200_000)) + "}",
    "deep.gml": lambda: "graph [ " + "a [ " * 450_000,
    "nodes.gml": lambda: "graph [ " + "".join(f'node [ id {k} label "{k}" ] ' for k in range(55_000)) + "]",
    "nodes.graphml": lambda: GRAPHML.format("".join(f'<node id="{k}"/>' for k in range(80_000))),
    "edges.graphml": lambda: GRAPHML.format(
        "".join(f'<edge source="{k % 2000}" target="{k * 7 % 2000}"/>' for k in range(45_000))
    ),
    "edges.edgelist": lambda: _edges(190_000),
    "most-edges.edgelist": lambda: _edges(49_000),
    "complete.adj": lambda: "\n".join(" ".join("1" if i != j else "0" for j in range(990)) for i in range(990)),
    "large.g6": lambda: "~?@~" + "~" * 650_000,
    "complete.g6": lambda: "~?mw" + "~" * 749_750,  # 3,000 links, each joined with each: 4.5 million joints
    "announced.s6": lambda: ":~~?@????",  # 16 million links in nine letters
    "announced.g6": lambda: "~~~~~~~~",
    "edges.s6": lambda: ":~?mw" + "?" * 900_000,
    "long.pmks": lambda: "?2v." + "1.0A," * 390_000,
    "deep.ron": lambda: "(" * 1_990_000,
    "deep.json": lambda: "[" * 990_000,
    "rows.csv": lambda: "x,y\n" + "1,2\n" * 240_000,
    "line.g6.gz": lambda: gzip.compress(b"A" * 300_000_000, 1),
    "chains.txt.gz": lambda: gzip.compress(b"R(0-1) R(1-2) R(2-3) R(3-0)\n" * 5_000_000, 1),
}


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not say how much memory was used")
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_take_less_than_500_megabytes(name, tmp_path):
    path = tmp_path / name
    content = HOSTILE[name]()
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    done = subprocess.run([sys.executable, "-c", PROGRAM, str(path)], capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    print(f"{name}: {found['time']:.2f} s, {found['memory']:.0f} MB, {found['said'][:80]}")
    assert found["memory"] < 500
    assert len(found["said"]) < 700
    assert "\n" not in found["said"]


@pytest.mark.parametrize("name", ["complete.g6", "announced.s6", "announced.g6"])
def test_codes_are_refused_before_they_are_unpacked(name, tmp_path):
    path = tmp_path / name
    path.write_text(HOSTILE[name]())
    tracemalloc.start()
    with pytest.raises(GrueblerError, match="at most") as refused:
        files.read(path)
    largest = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert str(path) in str(refused.value)
    assert largest < 60_000_000  # bytes; the modules that are loaded for it included


NUMBERS = re.compile(r"-?\d+\.\d+|(?<=[ \",\[(])-?\d+(?=[ \",\])])")
OF_OTHERS = [path for path in sorted(Path(__file__).with_name("samples").iterdir()) if NUMBERS.search(path.read_text())]


@pytest.mark.parametrize("source", OF_OTHERS, ids=lambda path: path.name)
def test_numbers_that_have_no_square_are_refused_or_read(source, tmp_path):
    """One number of a file becomes too large or too small to be squared; anything but `GrueblerError` fails."""
    text, rng = source.read_text(), random.Random(source.name)
    spots = [found.span() for found in NUMBERS.finditer(text)]
    path = tmp_path / source.name
    for word in ("1e308", "-1e160", "1e-320"):
        for begin, end in rng.sample(spots, min(len(spots), 4)):
            path.write_text(text[:begin] + word + text[end:])
            said = ""
            try:
                read = files.read(path, left_out=[])
            except GrueblerError as error:
                said = str(error)
            assert len(said.splitlines()) == 1 if said else isinstance(read, Linkage)


def test_a_crank_too_long_to_be_squared_is_named(tmp_path):
    joints = [
        {"type": "Static", "name": "A", "x": 1, "y": 0},
        {"type": "Static", "name": "D", "x": 3, "y": 0},
        {"type": "Crank", "name": "B", "joint0": {"ref": "A"}, "distance": 1e308, "angle": 0.3},
        {
            "type": "Revolute",
            "name": "C",
            "x": 3,
            "y": 2,
            "joint0": {"ref": "B"},
            "joint1": {"ref": "D"},
            "distance0": 3,
            "distance1": 2,
        },
    ]
    path = tmp_path / "long.json"
    path.write_text(json.dumps({"name": "long", "joints": joints, "solve_order": ["B", "C"]}))
    with pytest.raises(GrueblerError, match=r"long\.json: it has numbers that are too large to be lengths"):
        files.read(path)
