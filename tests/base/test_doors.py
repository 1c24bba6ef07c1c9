"""Every function, constructor and classmethod of the front door, called with one wrong argument after the other.

The law: what comes back is an answer or a `GrueblerError`, one line that a user can read. Errors of Python, NumPy and
others that come from within are foreign; only Python itself says what does not fit a signature.
"""

import inspect
import subprocess
import sys
import types
import warnings
from collections.abc import Iterator
from itertools import islice

import networkx as nx
import numpy as np
import pytest

import gruebler as gr
from gruebler.design.synthesis import PathTask
from gruebler.machines.cams import Roller, read_lift
from gruebler.machines.gears import Mesh

CHAIN = gr.Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
MECHANISM = gr.Mechanism(CHAIN, "0", [0])
LENGTHS = gr.FourBar(25, 70, 40, 70)
LINKAGE = LENGTHS.linkage({"K": (45, 40)})
MOTION = gr.move(LENGTHS, [1.0, 1.1])
WEIGHT = gr.Loads(bodies={"coupler": gr.RigidBody(0.5, (35, 0), 200.0)})
WRONG = {
    "None": None,
    "True": True,
    "-1": -1,
    "0": 0,
    "7": 7,
    "2.5": 2.5,
    "nan": float("nan"),
    "inf": float("inf"),
    "1e308": 1e308,
    "a huge number": 10**400,
    "a complex number": 1 + 2j,
    "a text": "x",
    "no text": "",
    "bytes": b"x",
    "an empty list": [],
    "a list of None": [None],
    "a list of texts": ["x", "y"],
    "a ragged list": [[1, 2], [3]],
    "a list of a list": [["x", 1, 2]],
    "an empty dict": {},
    "a dict": {"x": 1},
    "a dict of a list": {"x": [1, None]},
    "an object": object(),
    "an empty array": np.array([]),
    "an array of texts": np.array(["x"]),
    "an array of three axes": np.zeros((2, 2, 2)),
    "a set": {1, 2},
    "a function": lambda: None,
    "a class": int,
    "a Chain": CHAIN,
    "a Mechanism": MECHANISM,
    "a FourBar": LENGTHS,
    "a Linkage": LINKAGE,
    "a Motion": MOTION,
    "a graph": nx.path_graph(3),
}
TASK = PathTask([(0, 0), (1, 2), (3, 1)], fixed_pivots=[(0, -3), (3, -3)])
SQUARE = gr.Mechanism.parse("R(0-1) R(1-2) R(2-3) R(0-3)")
ELEMENTS = {
    "frame": {"R(frame-crank)": (0, 0), "R(frame-rocker)": (70, 0)},
    "crank": {"R(frame-crank)": (0, 0), "R(crank-coupler)": (25, 0)},
    "coupler": {"R(crank-coupler)": (0, 0), "R(coupler-rocker)": (70, 0)},
    "rocker": {"R(frame-rocker)": (0, 0), "R(coupler-rocker)": (40, 0)},
}
PLACES = {0: (0, 0), 1: (0, 2), 2: (6, 4), 3: (6, 0)}
PICTURE = {"branch": None, "between": None, "lang": "en", "name": ""}
GOOD = {
    "Cam": {"lift": read_lift("rise 20 90; dwell 90; fall 20 90; dwell"), "base": 40, "follower": Roller(10)},
    "Chain": {"joints": [("revolute", ["0", "1"]), ("revolute", ["1", "2"]), ("revolute", ["2", "0"])], "links": None},
    "Chain.parse": {"text": "R(0-1) R(1-2) R(2-0)"},
    "Chain.from_edges": {"edges": [(0, 1), (1, 2), (2, 0)]},
    "Chain.from_graph6": {"code": "Cr"},
    "Chain.from_json": {"document": CHAIN.to_json()},
    "Chain.from_networkx": {"graph": CHAIN.link_graph()},
    "FourBar": {"a": 25, "b": 70, "c": 40, "d": 70},
    "FourBar.central": {"a": 30, "b": 75, "c": 60},
    "FourBar.central_for_swing": {"swing": 1.0, "c": 60, "b": 75},
    "Gas": {"force": 400, "extended": 500, "stroke": 200},
    "Geneva": {"slots": 4},
    "InvertedSliderCrank": {"a": 25, "d": 70},
    "InvertedSliderCrank.for_time_ratio": {"time_ratio": 1.5, "d": 70},
    "Joint": {"pair": CHAIN.joints[0].pair, "links": ("0", "1")},
    "Linkage": {"mechanism": LINKAGE.mechanism, "elements": ELEMENTS},
    "Linkage.from_drawing": {"mechanism": MECHANISM, "places": PLACES},
    "Loads": {"forces": {"K": (1, 2)}},
    "Mechanism": {"chain": CHAIN, "frame": "0", "drives": [0]},
    "Mechanism.parse": {"text": str(MECHANISM)},
    "Mechanism.parse_with_output": {"text": str(MECHANISM)},
    "Mechanism.from_json": {"document": MECHANISM.to_json()},
    "Mechanism.from_networkx": {"graph": MECHANISM.link_graph()},
    "Motor": {"stall": 12, "idle_speed": 100},
    "Requirements": {"links": 4},
    "RigidBody": {"mass": 2, "centre": (30, 0), "inertia": 600},
    "RigidBody.about": {"place": (0, 0), "mass": 2, "centre": (30, 0), "inertia": 2400},
    "RigidBody.bar": {"mass": 2, "start": (0, 0), "end": (60, 0)},
    "RigidBody.disc": {"mass": 2, "radius": 10},
    "RigidBody.plate": {"outline": [(0, 0), (30, 0), (30, 20)], "thickness": 10, "density": 7850},
    "SliderCrank": {"a": 25, "b": 70},
    "SliderCrank.from_ratio": {"a": 25, "ratio": 0.3},
    "SliderCrank.from_dead_centres": {"inner": 40, "outer": 90},
    "SliderCrank.from_stroke": {"stroke": 50, "ratio": 0.3},
    "SpatialLinkage": {"mechanism": SQUARE, "joints": PLACES},
    "SpatialLinkage.from_dh": {"rows": [(np.pi / 2, 0, 1, 0)] * 4},
    "Spring": {"between": ("frame:0,40", "K"), "stiffness": 2},
    "TorsionSpring": {"between": ("frame", "crank"), "stiffness": 10},
    "Train": {
        "meshes": [
            Mesh(a="sun", b="planet", size_a=24, size_b=18, carrier="arm"),
            Mesh(a="planet", b="ring", size_a=18, size_b=-60, carrier="arm"),
        ]
    },
    "animate": {"value": LENGTHS, "seconds": 0.1, "drives": None, "curves": (), **PICTURE},
    "assembly_modes": {"linkage": LENGTHS, "drives": 1.0},
    "assur_groups": {"links": 2},
    "chains": {"links": 4},
    "circuit": {"linkage": LENGTHS},
    "code": {"chain": CHAIN},
    "count_chains": {"links": 4},
    "coupler_curve": {"linkage": LENGTHS, "point": (45, 40)},
    "decode": {"text": gr.code(CHAIN)},
    "decompose": {"mechanism": MECHANISM},
    "derive": {"chain": CHAIN},
    "draw": {
        "value": LENGTHS,
        "at": 1.0,
        "curves": (),
        "show": (),
        "output": None,
        "ghost": None,
        "labels": False,
        "names": None,
        **PICTURE,
    },
    "drive_range": {"linkage": LENGTHS},
    "driven_mechanisms": {"chain": CHAIN},
    "equilibria": {"linkage": LENGTHS, "loads": WEIGHT},
    "extend": {"chain": CHAIN, "dyad": "RRR"},
    "freedoms": {"linkage": LENGTHS},
    "from_degrees": {"start": 0, "stop": 90, "step": 30},
    "inverse_dynamics": {"motion": gr.move(LENGTHS, [1.0, 1.1], speed=10.0), "loads": WEIGHT},
    "inversions": {"chain": CHAIN},
    "is_isomorphic": {"first": CHAIN, "second": CHAIN},
    "linearised": {"linkage": LENGTHS, "loads": WEIGHT, "branch": "+", "at": 1.0},
    "measures": {"linkage": LENGTHS},
    "mobility_report": {"chain": CHAIN},
    "motion_roles": {"linkage": LENGTHS},
    "move": {"linkage": LENGTHS, "drives": [1.0, 1.1]},
    "move_many": {"many": [LINKAGE], "drives": [1.0, 1.1]},
    "plot": {"linkage": LENGTHS, "kind": "transfer", "output": None, **PICTURE},
    "rpm": {"value": 60},
    "read": {"path": "missing.toml"},
    "realise": {"mechanism": LINKAGE.mechanism, "budget": 20},
    "rotatability": {"linkage": LENGTHS},
    "simulate": {"linkage": LENGTHS, "loads": WEIGHT, "until": 0.002, "at": 1.0, "tolerance": 1e-4},
    "statics": {"motion": MOTION, "loads": gr.Loads(forces={"R(coupler-rocker)": (1, 2)})},
    "symmetry": {"chain": CHAIN},
    "synthesise": {"task": TASK},
    "variants": {"requirements": gr.Requirements(4)},
    "write": {"value": CHAIN, "path": "chain.txt"},
}
"""A good call of each; parameters that are not there are tried as well."""
ELSEWHERE = {
    **dict.fromkeys(
        ("Circuit", "Measures", "Motion", "Statics"), "made by functions of the library, from their own parts"
    ),
    "GrueblerError": "raised, not called",
    "UnitWarning": "given, not called",
    "explore": "opens a page",
}


def doors():
    """Every callable name of the front door, and the classmethods of its classes."""
    for name in gr.__all__:
        value = getattr(gr, name)
        if isinstance(value, types.ModuleType):
            continue
        yield name, value
        if isinstance(value, type) and name not in ELSEWHERE:
            for word, member in vars(value).items():
                if isinstance(member, classmethod) and not word.startswith("_"):
                    yield f"{name}.{word}", getattr(value, word)


DOORS = {name: value for name, value in doors() if name not in ELSEWHERE}


def parameters(name):
    """All parameters of a door, and the options that its good call has."""
    given = [
        parameter.name
        for parameter in inspect.signature(DOORS[name]).parameters.values()
        if parameter.kind is not parameter.VAR_KEYWORD
    ]
    return dict.fromkeys([*given, *GOOD[name]])


def answer(name, arguments):
    """What a call answers; of what comes piece by piece the first pieces."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        value = DOORS[name](**arguments)
        return list(islice(value, 3)) if isinstance(value, Iterator) else value


def test_every_door_is_tried():
    assert set(DOORS) == set(GOOD)
    assert set(ELSEWHERE) <= {name for name, _ in doors()}


@pytest.mark.parametrize("name", sorted(set(GOOD) - {"read"}))
def test_the_good_call_is_good(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    answer(name, GOOD[name])


@pytest.mark.parametrize(("name", "parameter"), [(name, each) for name in sorted(GOOD) for each in parameters(name)])
def test_a_wrong_argument_is_refused_in_a_sentence(name, parameter, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    foreign = {}
    for words, value in WRONG.items():
        if parameter == "progress" and callable(value):
            continue  # it is called; what it raises is the caller's own
        try:
            answer(name, {**GOOD[name], parameter: value})
        except gr.GrueblerError as error:
            if "\n" in str(error) or not str(error):
                foreign[words] = repr(error)
        except Exception as error:  # every foreign kind is collected here, to be told at once
            foreign[words] = repr(error)[:150]
    assert foreign == {}


def test_chains_are_read_without_numpy():
    """Doors are as light as what they guard: numpy takes longer to load than most chains to read."""
    code = "import sys, gruebler as gr; gr.Chain.parse('R(0-1) R(1-2) R(2-0)'); sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
