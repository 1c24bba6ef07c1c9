"""Both tiers of every kernel give the same: calls recorded from real work, interpreted and compiled side by side."""

import importlib
import pkgutil
import sys
from collections.abc import Callable
from copy import deepcopy
from functools import cache, wraps
from typing import Any, NamedTuple

import networkx as nx
import numpy as np
import pytest

import gruebler as gr
from gruebler import _numeric
from gruebler._numeric import compiling
from gruebler._numeric.labelling.canonical import canonical_bulk, canonical_form
from gruebler._numeric.motion.tracing import TraceScratch
from gruebler.mechanics.analysis.circuit_ranges import rotatability
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.kinematics.assembly_modes import conditions
from gruebler.mechanics.kinematics.batch import four_bars, move_many
from gruebler.mechanics.kinematics.circuits import circuit
from gruebler.mechanics.kinematics.triads import all_modes
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.enumeration import chains, contracted_graphs, graph6_blocks
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.samples import CLASS_III, parallel_legs

# Integers are equal, and so is every bit of a motion: which tier moves a linkage depends on how much work was done
# before, and the answer must not. Elsewhere numbers may differ in the last digits by powers, by divisions of complex
# numbers and by sums taken in pairs: some units of 2e-16 for each operation, more where a root is near zero.
CLOSE = 1e-11
EXACT = f"{_numeric.__name__}.motion."
DOORS = {
    "walk_path", "_designs", "closing", "newton", "close_near_singular", "settle_on_curve", "trace_curve",
    "evaluate_pose", "jacobian", "label_graph", "adjacency",
    "_label_all", "list_chains", "write_graph6",
    "refine",
}  # fmt: skip
PARTS = {
    "_goes_on",
    "_either",
    "_dot",
    "_subtract",
    "_nothing",
}  # compiled forms of the words in `lanes`, and their like


SLIDING = [
    ("R(0-1) P(1-2) R(2-3) P(0-3); frame=0; drive=R(0-1)", [(0, 0), (2, 1, 0.5), (4, 2), (4, 2.2, 1.4)]),
    ("R(0-1) R(1-2) P(2-3) P(0-3); frame=0; drive=R(0-1)", [(0, 0), (1, 1), (3, 1.5, 1.3), (6, 2, 0.2)]),
]


class Call(NamedTuple):
    """A call of a kernel: its arguments before and after, and what it returned."""

    before: Any
    after: Any
    result: Any


def modules() -> list[Any]:
    found = [
        importlib.import_module(one.name) for one in pkgutil.walk_packages(_numeric.__path__, f"{_numeric.__name__}.")
    ]
    return [*found, *(module for name, module in sys.modules.items() if name == __name__)]


def kernels() -> list[Callable[..., Any]]:
    modules()
    return [kernel for kernel in compiling.kernels() if kernel.__module__.startswith(_numeric.__name__)]


def work() -> None:
    """Something for every kernel to do, small enough to be interpreted."""
    assert sum(len(graph.canonical().automorphisms) for graph in contracted_graphs(4)) > 16
    found = list(chains(8, 1))
    assert len({gr.code(chain) for chain in found}) == len(found) == 16
    two = nx.from_graph6_bytes(
        b"[_GECCoA?gb_WO@K??????????_??_??G??I??K_??O???`???X??GO??A?G??OP"
    )  # leaves are compared
    for graph in (
        two,
        nx.petersen_graph(),
        nx.disjoint_union(nx.hypercube_graph(3), nx.cycle_graph(30)),
        nx.star_graph(40),
    ):
        plain = nx.convert_node_labels_to_integers(graph)
        canonical_form(len(plain), None, np.array(plain.edges()))
    canonical_bulk(4, np.array([[[0, 1], [1, 2], [2, 3]], [[0, 2], [2, 1], [1, 3]]]))
    assert sum(len(lines) for lines in graph6_blocks(8, 1)) == 16
    steady = {"speed": 1.0, "acceleration": 2.0, "jerk": 3.0, "order": 3}
    doors = FourBar(25, 70, 40, 70), FourBar(25, 70, 25, 70), SliderCrank(20, 70, 8), InvertedSliderCrank(50, 30, 3)
    for linkage in (door.linkage() for door in doors):
        gr.move(linkage, gr.from_degrees(0, 200, 2), **steady)
        gr.move(linkage, gr.from_degrees(0, 28, 4), **steady)
        circuit(linkage).at([0.5, 1.5])
    gr.move(FourBar(50, 70, 40, 70).linkage(), gr.from_degrees(60, 360, 3))
    gr.move(FourBar(30, 50, 50, 30).linkage(), gr.from_degrees(-30, 120, 10), **steady)  # a kite: its outer joints meet
    for linkage in (CLASS_III, parallel_legs()):
        gr.move(linkage, gr.from_degrees(40, 140, 5), **steady)
        gr.move(linkage, np.radians([50, 90, 53.2]), **steady)
    gr.move(parallel_legs(), np.radians([150, 180, 150]), order=0)  # back in a change point
    gr.move(FourBar(20, 20, 20, 20).linkage(), np.radians([178.6, 179.4, 180.1, 180.1, 179.4, 178.6]))
    gr.move(FourBar(20, 20, 20, 20).linkage(), np.radians([64.0, 104, 144, 184, 144, 104, 64]))
    rotatability(parallel_legs())
    for text, places in SLIDING:
        gr.move(
            Linkage.from_drawing(Mechanism.parse(text), dict(enumerate(places))), gr.from_degrees(0, 20, 2), **steady
        )
    for name in ("cam", "cam_roller", "geneva", "belt", "friction_forced", "winch_plane"):
        gr.move(entry(name).linkage(), gr.from_degrees(0, 30, 5), **steady)
        circuit(entry(name).linkage())
    gr.move(entry("crane_cyl").linkage(), np.linspace(34.5, 47, 6), **steady)
    all_modes(conditions([(0, -1, 0, 0j, 1, 0j, 1), (0, 0, 1, 1, 1, 0j, 1), (0, 1, -1, 1, 1, 1.2, 1)]))
    move_many(
        four_bars([25, 30], 70, 40, 70), gr.from_degrees(0, 60, 5), speed=1.0, threads=1
    )  # nobody else writes what is compared


@cache
def recorded() -> dict[str, list[Call]]:
    """Up to three calls of each kernel, the first, the third and the tenth."""
    calls: dict[str, list[Call]] = {}
    known = {kernel: recorder(kernel, calls) for kernel in kernels()}
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("GRUEBLER_KERNELS", "interpreted")
        for module in modules():
            for name, value in list(vars(module).items()):
                if callable(value) and getattr(value, "__hash__", None) and value in known:
                    patch.setattr(module, name, known[value])
        work()
    return calls


def recorder(kernel: Callable[..., Any], calls: dict[str, list[Call]]) -> Callable[..., Any]:
    mine = calls.setdefault(f"{kernel.__module__}.{kernel.__name__}", [])
    count = 0

    @wraps(kernel)
    def record(*arguments: Any) -> Any:
        nonlocal count
        count += 1
        if count not in (1, 3, 10):
            return kernel(*arguments)
        before = deepcopy(arguments)
        result = kernel(*arguments)
        mine.append(Call(before, deepcopy(arguments), deepcopy(result)))
        return result

    return record


def numpied(value: Any) -> Any:
    """What a kernel takes when it is compiled: arrays instead of lists."""
    if isinstance(value, list):
        return np.array(value)
    if type(value) is tuple:
        return tuple(numpied(part) for part in value)
    return value


# Room of `tracing._reduce`, whose interpreted form works on lists.
ROOM = {"work", "free", "lengths"}


def agree(one: Any, other: Any, *, exact: bool) -> None:
    if isinstance(one, TraceScratch):
        for name in set(one._fields) - ROOM:
            agree(getattr(one, name), getattr(other, name), exact=exact)
    elif isinstance(one, tuple):
        for a, b in zip(one, other, strict=True):
            agree(a, b, exact=exact)
    elif one is None:
        assert other is None
    else:
        a, b = np.asarray(one), np.asarray(other)
        assert a.shape == b.shape
        if exact or (a.dtype.kind in "iub" and b.dtype.kind in "iub"):
            assert np.array_equal(a, b, equal_nan=a.dtype.kind in "fc")
        else:
            size = max(1.0, np.abs(np.nan_to_num(b, posinf=0, neginf=0)).max(initial=0))
            assert np.allclose(a, b, rtol=CLOSE, atol=CLOSE * size, equal_nan=True)


@pytest.fixture
def kernel_tier() -> None:
    """Not one tier after the other here, but both side by side."""


NAMES = [f"{kernel.__module__}.{kernel.__name__}" for kernel in kernels()]
_BY_NAME = dict(zip(NAMES, kernels(), strict=True))


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=() if name.rpartition(".")[2] in DOORS else pytest.mark.slow)
        for name in NAMES
        if name.rpartition(".")[2] not in PARTS
    ],
)
def test_both_tiers_agree(name: str) -> None:
    calls = recorded()[name]
    assert calls, "no work in this file calls it"
    for call in calls:
        arguments = numpied(deepcopy(call.before))
        exact = name.startswith(EXACT)
        agree(numpied(call.result), compiling.compiled(_BY_NAME[name])(*arguments), exact=exact)
        agree(numpied(call.after), arguments, exact=exact)
