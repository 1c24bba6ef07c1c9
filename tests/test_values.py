"""Values of two classes are never equal, and every public value is equal to its copies.

The first half walks over all classes of the package; the second makes one value, and another one like it, of every
class of the front door and of what its functions return.
"""

import abc
import ast
import copy
import dataclasses
import enum
import importlib
import inspect
import itertools
import math
import os
import pickle
import pkgutil
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import Protocol

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.arrays import same
from gruebler.base.columns import Column
from gruebler.base.errors import LinkageError
from gruebler.base.immutable import Immutable
from gruebler.design.synthesis import DeadCentreTask
from gruebler.machines.cams import Roller, read_lift
from gruebler.machines.gears import Mesh, read_train
from gruebler.mechanics.analysis import motion_table
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.kinematics import four_bars
from gruebler.mechanics.kinematics.link_poses import LinkPoses
from gruebler.mechanics.linkages import Circle, Line

SOURCE = Path(gr.__file__).parent

TUPLES = {
    "Branches": "arrays over the same rows, joined one by one",
    "LeverPose": "what draws a lever, unpacked where it is drawn",
    "PairPlaces": "arrays over the same linkages, from which some are taken one by one",
    "SolvedRows": "the arrays that a kernel fills",
}
"""Named tuples with more than four fields that are no arguments of kernels, and why each is a tuple by nature."""


def modules() -> Iterator[str]:
    """The modules in Python."""
    for found in pkgutil.walk_packages([str(SOURCE)], "gruebler."):
        if not found.name.endswith(("__main__", "._core")):
            yield found.name


def classes() -> list[type]:
    """Every class that the package defines, by module and name."""
    seen = {}
    for name in modules():
        module = importlib.import_module(name)
        for each in vars(module).values():
            if inspect.isclass(each) and each.__module__ == name:
                seen[each.__module__, each.__qualname__] = each
    return [seen[key] for key in sorted(seen)]


CLASSES = classes()
NAMED_TUPLES = [each for each in CLASSES if issubclass(each, tuple) and hasattr(each, "_fields")]


def kernel(each: type) -> bool:
    """Whether it is what the doors of the core take, field by field."""
    room = each.__module__
    return room.endswith(".kernel_records")


RECORDS = {
    "gruebler.files.linkage_records.Dimensions": "the sizes that files of linkages and entries of the catalog have",
    "gruebler.files.tasks._Record": "the unit that every kind of task has",
    "gruebler.page.params.Params": "what all parameters refuse",
    "gruebler.base.notebook.Drawn": "how values draw themselves in notebooks",
}
"""Records of files, and what values have in common, that are never made themselves, only those that have their fields,
too. Their metaclass is none of an ABC."""


def abstract(each: type) -> bool:
    """Whether a class is there to be inherited from: it says that it is abstract, a protocol or an enumeration."""
    return bool({abc.ABC, Protocol} & {*each.__bases__}) or issubclass(each, BaseException | enum.Enum)


def test_every_class_is_abstract_or_final():
    """Nobody inherits to share code, so that what a method of a class does stands in that class."""
    inherited = {base for each in CLASSES for base in each.__bases__ if base.__module__.startswith("gruebler")}
    concrete = {f"{each.__module__}.{each.__qualname__}" for each in inherited if not abstract(each)}
    assert concrete == set(RECORDS)
    assert {Immutable, LinkPoses, Course} < inherited


def test_no_method_is_written_over():
    """What an abstract class has written out stays as it is; of elements of joints it is what most kinds do."""
    wrong = [
        f"{each.__module__}.{each.__qualname__}.{name}"
        for each in CLASSES
        if not issubclass(each, BaseException | enum.Enum)
        for base in each.__mro__[1:]
        if base.__module__.startswith("gruebler") and base.__module__ != "gruebler.mechanics.linkages.elements"
        for name, own in vars(each).items()
        if callable(own) or isinstance(own, property | cached_property)
        if name in vars(base) and not name.startswith("__") and not is_abstract(vars(base)[name])
    ]
    assert wrong == []


def is_abstract(method: object) -> bool:
    return getattr(method, "__isabstractmethod__", False)


def test_records_that_share_fields_are_never_made():
    names = {name.rpartition(".")[2] for name in RECORDS}
    made = [
        f"{name}:{node.lineno}"
        for name in modules()
        for node in ast.walk(ast.parse(inspect.getsource(importlib.import_module(name))))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in names
    ]
    assert made == []


def members(node: ast.expr) -> Iterator[str]:
    """The names between the bars of a union."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
        yield from members(node.left)
        yield from members(node.right)
    elif isinstance(node, ast.Name):
        yield node.id


def unions() -> Iterator[tuple[str, set[object]]]:
    """Every union of two or more things written anywhere in the package: the place and the members."""
    for name in modules():
        module = importlib.import_module(name)
        known = {key: each for key, each in vars(module).items() if inspect.isclass(each)}
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
                yield f"{name}:{node.lineno}", {known.get(each, each) for each in members(node)}


def test_no_member_of_a_union_is_a_named_tuple():
    """Two members with the same numbers in them would be equal."""
    found = list(unions())
    assert len(found) > 500
    wrong = {place: each for place, union in found for each in union if len(union) > 1 and each in NAMED_TUPLES}
    assert wrong == {}


def test_a_named_tuple_has_four_fields_at_most():
    """One with more is an argument of a kernel, or has its reason above."""
    wide = {each.__name__ for each in NAMED_TUPLES if len(each._fields) > 4 and not kernel(each)}
    assert wide == set(TUPLES)


def by_position(each: type) -> list[str]:
    """The types of what may be given by position; x, y and the number that follows them are one place."""
    given = [p for p in inspect.signature(each).parameters.values() if p.kind is p.POSITIONAL_OR_KEYWORD]
    types = [str(p.annotation) for p in given]
    if [p.name for p in given if p.name in "xy"] == ["x", "y"]:
        start = [p.name for p in given].index("x")
        end = next((k for k in range(start, len(types)) if types[k] != "float"), len(types))
        assert end - start <= 3, each
        types[start:end] = ["place"]
    return types


def test_a_dataclass_of_many_fields_is_made_by_keyword():
    """Of more than four fields three at most are given by position, never two of one type: they are soon mistaken."""
    wide = [
        each
        for each in CLASSES
        if dataclasses.is_dataclass(each) and sum(field.init for field in dataclasses.fields(each)) > 4
    ]
    assert len(wide) > 150
    placed = {each.__name__: by_position(each) for each in wide}
    wrong = {name: types for name, types in placed.items() if len(types) > 3 or len(types) > len(set(types))}
    assert wrong == {}


def is_value(each: type) -> bool:
    """Whether it is a frozen dataclass of which there are values."""
    return dataclasses.is_dataclass(each) and each.__dataclass_params__.frozen and not inspect.isabstract(each)


def filled(each: type) -> object:
    """A value of a dataclass with 0, 1, 2, ... in its fields, made without its constructor."""
    value = object.__new__(each)
    for number, field in enumerate(dataclasses.fields(each)):
        object.__setattr__(value, field.name, number)
    return value


def test_values_of_two_classes_are_never_equal():
    values = [filled(each) for each in CLASSES if is_value(each)]
    assert len(values) > 250
    equal = [
        (type(one).__name__, type(other).__name__)
        for one, other in itertools.combinations(values, 2)
        if one == other or other == one
    ]
    assert equal == []


def test_elements_of_a_joint_with_the_same_numbers():
    """What led to it: these two were equal and had one hash, so that one linkage moved with the plan of the other."""
    assert Line(0.0, 0.0, 1.0) != Circle(0.0, 0.0, 1.0)
    assert len({Line(0.0, 0.0, 1.0), Circle(0.0, 0.0, 1.0)}) == 2
    assert Line(0.0, 0.0, 1.0) == Line(0, 0, 1)


# --- every value equals its copies -------------------------------------------------------------------


FOUR_BAR = gr.FourBar(25, 70, 40, 70)
DRIVES = np.linspace(0.3, 0.9, 4)
_AXIS = {"z": (0, 0, 1)}
WINCH = gr.SpatialLinkage(
    gr.Mechanism.parse("spatial: R(frame-spindle) H(spindle-nut) P(frame-nut)"),
    {0: _AXIS, 1: _AXIS | {"pitch": 0.8}, 2: {"x": (0, 0, 1), "at": (0, 5, 0)}},
)
TASK = DeadCentreTask(stroke=50, time_ratio=1.2)


def moved(last: float) -> gr.Motion:
    return gr.move(FOUR_BAR, [0.3, 0.5, last], speed=1.0)


def at_a_limit(first: float) -> gr.Motion:
    """A row at the limit of the drive has rates that are NaN, and then it stops."""
    crank = gr.SliderCrank(50, 40)
    limit = math.asin(40 / 50)
    return gr.move(crank, [first, limit, 1.2], speed=1.0)


def weighing(k: int) -> gr.Loads:
    return gr.Loads(bodies={"coupler": gr.RigidBody(0.5 + k, (35, 0), 200.0)})


PAIRS = {
    "Cam": lambda k: gr.Cam(read_lift("rise 20 90; dwell 90; fall 20 90; dwell"), 40.0 + k, Roller(10.0)),
    "Chain": lambda k: gr.Chain.parse(("R(0-1) R(1-2) R(2-0)", "R(0-1) R(1-2) P(2-0)")[k]),
    "Circuit": lambda k: gr.circuit(FOUR_BAR.linkage(), branch="+-"[k]),
    "Column": lambda k: Column("a", unit="mm", values=np.array([1.0, np.nan, k])),
    "CouplerCurve": lambda k: gr.coupler_curve(FOUR_BAR.linkage({"K": (30, 20 + k)}), "K"),
    "ChainCount": lambda k: gr.count_chains(6 + 2 * k),
    "CycleSpan": lambda k: drive_cycle(gr.FourBar(25 + 40 * k, 70, 40, 70).linkage()).span,
    "DriveCycle": lambda k: drive_cycle(gr.FourBar(25 + k, 70, 40, 70).linkage()),
    "FourBar": lambda k: gr.FourBar(25 + k, 70, 40, 70),
    "DriveRange": lambda k: gr.drive_range(gr.FourBar(65 + k, 70, 40, 70)),
    "Freedoms": lambda k: gr.freedoms(gr.FourBar(25 + k, 70, 40, 70).linkage()),
    "Equilibria": lambda k: gr.equilibria(FOUR_BAR, weighing(k)),
    "Gas": lambda k: gr.Gas(force=400.0 + k, extended=500.0, stroke=200.0),
    "Geneva": lambda k: gr.Geneva(4 + k),
    "GrueblerError": lambda k: LinkageError("there is no link {link!r}", link=("a", "b")[k]),
    "InverseDynamics": lambda k: gr.inverse_dynamics(gr.move(FOUR_BAR, DRIVES, speed=10.0), weighing(k)),
    "InvertedSliderCrank": lambda k: gr.InvertedSliderCrank(25 + k, 60, 5),
    "Joint": lambda k: gr.Chain.parse("R(0-1) R(1-2) R(2-0)").joints[k],
    "Linearised": lambda k: gr.linearised(FOUR_BAR, weighing(k), branch="+", at=1.0),
    "Linkage": lambda k: gr.FourBar(25 + k, 70, 40, 70).linkage(),
    "Loads": lambda k: gr.Loads(moments={"rocker": 3.0 + k}),
    "Measures": lambda k: gr.measures(gr.FourBar(25 + k, 70, 40, 70).linkage()),
    "Mechanism": lambda k: FOUR_BAR.linkage().mechanism.renamed({"crank": "ab"[k]}),
    "MobilityReport": lambda k: gr.mobility_report(gr.Chain.parse("R(0-1) R(1-2) R(2-3) " + ("R(3-0)", "P(3-0)")[k])),
    "Motor": lambda k: gr.Motor(12.0 + k, 100.0),
    "Motion": lambda k: moved(0.9 + k),
    "Motion, stopped": lambda k: at_a_limit(0.1 + k / 10),
    "Motions": lambda k: gr.move_many(four_bars(25, [60 + k, 70], 40, 70), DRIVES),
    "Realisation": lambda k: gr.realise(FOUR_BAR.linkage().mechanism, seed=k, budget=20),
    "Requirements": lambda k: gr.Requirements(k + 1),
    "RigidBody": lambda k: gr.RigidBody(2.0 + k, (30, 0), 600.0),
    "Simulation": lambda k: gr.simulate(FOUR_BAR, weighing(k), until=0.01, branch="+", at=1.0),
    "SliderCrank": lambda k: gr.SliderCrank(25, 70 + k),
    "SpatialLinkage": lambda k: WINCH.scaled(k + 1),
    "Spring": lambda k: gr.Spring(("frame:0,40", "R(crank-coupler)"), stiffness=2.0 + k),
    "Statics": lambda k: gr.statics(moved(0.9), gr.Loads(moments={"rocker": 3.0 + k})),
    "Stop": lambda k: at_a_limit(0.1 + k / 10).stop,
    "Symmetry": lambda k: gr.symmetry(gr.Chain.parse("R(0-1) R(1-2) R(2-3) " + ("R(3-0)", "P(3-0)")[k])),
    "SynthesisResult": lambda k: gr.synthesise(TASK, number=2 + k),
    "Table": lambda k: motion_table(moved(0.9 + k)),
    "TorsionSpring": lambda k: gr.TorsionSpring(("frame", "crank"), stiffness=10.0 + k),
    "Train": lambda k: gr.Train((Mesh(a="sun", b="planet", size_a=24 + k, size_b=18, carrier="arm"),)),
    "TrainReading": lambda k: read_train(f"sun:{24 + k} planet:18 ring:-60 on arm"),
}
"""For each kind of value two that differ."""


def hash_of(value: object) -> int | None:
    """The hash; None of a value that has none, because it holds a dictionary."""
    try:
        return hash(value)
    except TypeError:
        return None


@pytest.mark.parametrize("kind", PAIRS)
def test_a_value_equals_its_copies_and_no_other_value(kind):
    value, again, other = PAIRS[kind](0), PAIRS[kind](0), PAIRS[kind](1)
    for copied in (again, pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
        assert value == copied
        assert copied == value
        assert hash_of(value) == hash_of(copied)
    assert value != other
    assert value != object()
    assert value != ()


def test_every_class_of_the_front_door_is_among_them():
    classes_there = {name for name in dir(gr) if inspect.isclass(getattr(gr, name))}
    assert classes_there - set(PAIRS) == {"UnitWarning"}  # a warning is a kind, not a value


@pytest.mark.parametrize("kind", PAIRS)
def test_a_value_is_printed_for_readers(kind):
    """`repr` is one line; `str` is the explanation where there is one, in few and short lines."""
    value = PAIRS[kind](0)
    assert "\n" not in repr(value)
    assert kind in ONLY_IN_ARRAYS or repr(value) != repr(PAIRS[kind](1))
    if kind not in WRITTEN_OUT:
        assert len(repr(value)) < 1200
    if hasattr(value, "explain"):
        assert str(value) == value.explain()
        assert str(value) == value.explain("en") != value.explain("de")
        assert 0 < len(str(value)) < 1500
        assert "array(" not in str(value)
    assert len(str(value).splitlines()) <= 25


ONLY_IN_ARRAYS = {"Circuit", "DriveCycle", "Motions", "Table"}
"""Of what differs in the numbers of its rows the line says how many there are."""

WRITTEN_OUT = {"Requirements", "Train", "TrainReading"}
"""What is written out in full, as the caller wrote it."""


def test_what_explains_itself():
    assert {kind for kind in PAIRS if hasattr(PAIRS[kind](0), "explain")} == set(PAIRS) - {
        *("Cam", "Chain", "Column", "DriveCycle", "GrueblerError", "Joint", "Loads", "Mechanism", "Requirements"),
        *("SpatialLinkage", "Table", "Train"),
        *("Gas", "Motor", "RigidBody", "Spring", "TorsionSpring"),
    }


def test_what_explains_itself_is_printed_so():
    silent = [each for each in CLASSES if "explain" in vars(each) and each.__str__ is object.__str__]
    assert silent == []


def test_a_stopped_motion_says_where_and_why():
    text = str(at_a_limit(0.1))
    assert "Positions: 1, from R(frame-crank) = 5.7" in text
    assert "The motion ends at R(frame-crank) = 53.13" in text  # asin(40 / 50)
    assert "whole path" not in text


def test_a_statically_loaded_press_is_printed_with_its_efforts():
    """Crank 3, rod 5 at 90 degrees: 100 N on the slider need 100 * 3 N mm; the rod carries 100 / cos, cos = 4/5."""
    press = gr.statics(gr.move(gr.SliderCrank(3, 5), [math.pi / 2]), gr.Loads(forces={"R(coupler-slider)": (-100, 0)}))
    lines = str(press).splitlines()
    assert lines[1].startswith("Effort of the drive R(frame-crank): ")
    assert "300" in lines[1]
    assert lines[2] == "Largest force in a joint: 125 N."


LIKE_CHAINS = [
    (gr.Chain.parse("R(0-1) R(1-2) R(2-0)"), "links"),
    (FOUR_BAR.linkage().mechanism, "frame"),
    (FOUR_BAR.linkage({"K": (30, 20)}), "unit"),
    (WINCH, "places"),
]
"""One value of each class that is immutable in the way of a chain, and one of its fields."""


@pytest.mark.parametrize(("value", "name"), LIKE_CHAINS)
def test_chain_mechanism_and_linkage_are_immutable_alike(value, name):
    assert isinstance(value, Immutable)
    assert copy.copy(value) is value
    assert copy.deepcopy([value])[0] is value
    before = getattr(value, name)
    for field in (name, "unheard_of", "_hash"):
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(value, field, "x")
        with pytest.raises(dataclasses.FrozenInstanceError):
            delattr(value, field)
    assert getattr(value, name) is before


def test_every_class_that_is_immutable_in_this_way_is_tried():
    assert {type(value) for value, _ in LIKE_CHAINS} == {each for each in CLASSES if Immutable in each.__bases__}


@pytest.mark.parametrize(("value", "name"), LIKE_CHAINS)
def test_the_hash_is_computed_once(value, name, monkeypatch):
    fresh = pickle.loads(pickle.dumps(value))
    asked = []
    identity = type(value)._identity
    monkeypatch.setattr(type(value), "_identity", lambda self: asked.append(1) or identity(self))
    assert len({hash(fresh) for _ in range(3)}) == 1
    assert fresh == value
    assert len({fresh, value}) == 1
    assert sum(asked) <= 2  # once each


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_a_pickle_holds_fields_and_no_hash(protocol):
    """The hash of a text differs from process to process: one taken along would lose the value in every set."""
    for value, _ in LIKE_CHAINS:
        hash(value)
        assert set(value.__getstate__()) == {field.name for field in dataclasses.fields(value)}
        again = pickle.loads(pickle.dumps(value, protocol))
        assert not {"_hash", "_key"} & set(vars(again))
        assert again == value
    linkage = pickle.loads(pickle.dumps(LIKE_CHAINS[2][0], protocol))
    for mapping in (linkage.elements, linkage.points, linkage.reference_pose or linkage.points):
        with pytest.raises(TypeError):
            mapping["K"] = None


def test_a_pickle_of_another_process_is_found_in_a_set():
    script = (
        "import pickle, sys; import gruebler as gr; value = gr.FourBar(25, 70, 40, 70).linkage(); hash(value); "
        "sys.stdout.buffer.write(pickle.dumps(value))"
    )
    environment = os.environ | {"PYTHONHASHSEED": "123"}
    other = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, check=True)
    assert pickle.loads(other.stdout) in {FOUR_BAR.linkage()}


def test_the_same_numbers_in_two_classes_are_not_equal():
    @dataclasses.dataclass(frozen=True, eq=False)
    class Left(Immutable):
        number: int

        def _identity(self):
            return (self.number,)

    @dataclasses.dataclass(frozen=True, eq=False)
    class Right(Immutable):
        number: int

        def _identity(self):
            return (self.number,)

    assert Left(1) != Right(1)
    assert Left(1) == Left(1)
    assert Left(1) != Left(2)
    assert Left(1) != (1,)


def test_arrays_are_compared_by_what_they_hold():
    assert same({"a": [np.array([np.nan, 1j])]}, {"a": [np.array([np.nan, 1j])]})
    assert not same(np.array([1, 2]), np.array([1.0, 2.0]))
    assert not same(np.zeros((2, 1)), np.zeros((1, 2)))
    assert not same(np.zeros(2), (0.0, 0.0))
    assert not same({"a": 1.0}, {"b": 1.0})
    assert same(float("nan"), float("nan"))
    assert not same(float("nan"), 0.0)


def test_nothing_is_kept_for_chains_or_mechanisms():
    """They are equal whatever the order of their links and joints, on which numbers and columns depend."""
    kept = [
        f"{path.relative_to(SOURCE)}: {node.name}"
        for path in sorted(SOURCE.rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef)
        and any(re.match(r"(lru_)?cache\b", ast.unparse(by)) for by in node.decorator_list)
        and any(re.search(r"\b(Chain|Mechanism)\b", ast.unparse(each.annotation)) for each in node.args.args)
    ]
    assert kept == []
