"""Calls of every door of the core that are wrong, senseless or huge, for test_doors.py.

A door answers or raises TypeError, ValueError or MemoryError in words, and hears a signal. Each call is told
before it is made, by the number of what is changed: after a crash the last line says which it was.
"""

import copy
import os
import resource
import signal
import sys
import time
import warnings
from pathlib import Path
from unittest import mock

import numpy as np

import gruebler as gr
from gruebler import _core
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.kinematics.assembly_modes import GroupSolver, conditions
from gruebler.mechanics.kinematics.kernel_records import Conditions
from tests.samples import CLASS_III

SANITIZED = "asan" in os.environ.get("LD_PRELOAD", "")
"""Sanitizers reserve terabytes of addresses, and end the process themselves where memory is refused."""
ROOM = 1 << 30  # bytes, beyond those that are taken: a call that wants more gets MemoryError
PATIENCE = 0.02  # seconds of the processor until a call that is still at work gets a signal
LATEST = 10.0  # seconds of the processor until it must have heard it, in a build with sanitizers too

THETA = np.zeros((1, 16), np.int64)
THETA[0, :2] = 3 << 4, 3
RING = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
PAIRS = np.array([[3, 6, 12, 9]])
PIN = Conditions(
    np.zeros(1, np.int64), np.zeros((1, 8)), np.zeros((0, 14)), np.array([-1, 0]),
    np.zeros((2, 1), complex), np.ones(2, complex), np.zeros((0, 3)), 1.0,
)  # fmt: skip
DYAD = GroupSolver(conditions([(0, -1, 0, 0j, 1, 0j, 1), (0, 0, 1, 1, 1, 0j, 1), (0, 1, -1, 1, 1, 1.2, 1)]))._conditions
CURVE = np.zeros(4), np.zeros((4, 3)), np.eye(4, 3), np.zeros(4)
STILL = np.tile(np.eye(4, dtype=complex), (3, 1, 1))
MODES = (
    np.array([[-1, 0, 0, 1, -1, -1], [0, 1, 2, 1, 0, -1], [0, 0, 0, 1, -1, -1]]), np.array([[1, 2, 1, 0, 1]]), STILL,
    np.full((3, 6), 0.1, complex), np.zeros((2, 1), complex), np.zeros((2, 3), complex), np.zeros((1, 1), complex),
    np.zeros((1, 0, 3, 3), complex), 1e-3,
)  # fmt: skip
# A crank that turns about z, and a body on a ball that three rods tie to it.
BODY = (
    np.array([[-1, 0, 0, 1, -1, -1], [0, 1, 2, 1, 0, -1], [0, 1, 0, 1, 1, 0], [2, 1, 1, 1, 2, -1], [3, 1, 2, 1, 3, -1],
              *([k, 0, 0, 1, -1, -1] for k in (4, 4, 1, 1))]),
    np.array([[2, 5, 7, 0, 0], [2, 5, 8, 0, 0], [2, 6, 7, 0, 0]]), np.tile(np.eye(4), (9, 1, 1)), np.zeros(9),
    np.sqrt([3, 5, 5]), np.zeros((0, 4)),
)  # fmt: skip
BODY[2][5:, :3, 3] = [1, 0, 0], [0, 1, 0], [2, 1, 1], [1, -1, 2]
ROD = np.array([[1, 0, 2]]), np.arange(15.0).reshape(1, 5, 3)
CALLS_IN_SPACE = (
    ("follow_modes", MODES),
    ("open_linkage", (*BODY, np.zeros(4), np.eye(3)[None])),
    ("follow_linkage", (*BODY, np.zeros(4), np.eye(3)[None], np.array([1, 2, 3]), np.zeros(1, np.int64),
                        np.array([4, -1, 1]), *ROD, np.array([2.0, 1, 1, 0]), np.array([[0.0], [0.3]]),
                        np.ones((3, 2, 1)))),
    ("place_rods", (*ROD, np.tile(np.eye(4), (2, 3, 1, 1)))),
)  # fmt: skip
# A four-bar as it is drawn, and as each of its links has a plane of its own and the last one slides.
DRAWN = np.array([0, 1, 0, 0]), np.array([[0, 2, 3, 1, 0, 1, 3, 1, 3, 2, 2]]), np.array([[0, 1j, 2 + 2j, 2, 1 + 1j]])
SLIDING = (
    np.array([0, 1, 0, 1]), np.array([[1, 2, 3, 1, 0, 2, 6, 3, 7, 4, 5]]),
    np.array([[0, 0, 1, 0, 3, 0, 0.2j, 0]]), np.ones((1, 8), complex),
)  # fmt: skip
MODE, TURNED = np.ones((1, 1)), np.array([[0.0, 0.5]])
# A body on a pin of the frame.
PINNED = np.array([[1, 0, 0, 2, 0]]), np.zeros((1, 3)), np.zeros(4), 1.0
CALLS_OF_DESIGN = (
    ("move_planes", (*SLIDING, MODE, TURNED)),
    ("find_tops", (*SLIDING, MODE, TURNED, np.zeros(1, np.int64), True)),
    ("find_cosines", (*SLIDING, MODE, TURNED, np.zeros(1, np.int64))),
    ("cosine_slopes", (*DRAWN, MODE, TURNED, np.zeros(1, np.int64))),
    ("trace_point", (*DRAWN, MODE, TURNED, 2)),
    ("trace_slopes", (*DRAWN, MODE, TURNED, 2, True)),
    ("close_poses", (*PINNED, 12)),
    ("pose_slopes", PINNED[:3]),
    ("move_poses", PINNED),
    ("pose_gradients", (*PINNED, np.ones((1, 2, 3)))),
    ("settle_arcs", (np.arange(3.0), np.arange(3.0)[:, None] + 0j, np.ones((3, 1), complex), False,
                     np.array([[0.7 + 1j]]), np.zeros(1, np.int64), np.zeros(1), np.ones(1), np.ones(1) / 2,
                     np.zeros(0), 1.0)),
    ("spread_evenly", (np.exp(1j * np.arange(8.0))[None], np.arange(8.0), 5)),
    ("limit_steps", (np.tile(np.eye(2), (2, 1, 1)), np.ones((2, 2)), np.zeros((1, 2)), np.ones((1, 2, 2)), 0.0)),
)  # fmt: skip
ROWS = np.array([0, 2, 3]), np.array([0, 1, 1]), np.array([1, 2, 3])
UNKNOWNS, TASK = np.ones((3, 8), complex), np.ones((4, 8), complex)


def recorded(name, work):
    """The arguments of the first call of a door while a function works."""
    with mock.patch.object(_core, name, wraps=getattr(_core, name)) as door:
        work()
    return tuple(np.ascontiguousarray(a) if isinstance(a, np.ndarray) else a for a in door.call_args_list[0].args)


def motion(linkage):
    return recorded("run_path", lambda: gr.move(linkage, np.linspace(0.8, 1, 12), speed=1.0))


def designs():
    linkages = [FourBar(25, 70, 40, last).linkage() for last in (70, 71)]
    return recorded("run_designs", lambda: gr.move_many(linkages, np.linspace(0.8, 1, 12), threads=1))


def grow_joints(many, *arguments):
    search = _core.MultipleJoints(*arguments)
    search.next(many)
    return search.next(many)


def good_calls():
    """A sound call of each door, by the name of the door."""
    yield "level_names", ()
    yield "take_census", (THETA, 2, 1, True)
    yield "add_loop", (THETA, 2, 0, 100)
    yield "list_chains", (THETA, 2, 1)
    yield "list_graph6", (THETA, 2, 1)
    yield "write_graph6", (RING[None].astype(np.uint8), 4)
    yield "canonical_rows", (THETA[0],)
    yield "find_automorphisms", (THETA[0],)
    yield "canonical_form", (4, np.zeros(4, np.int64), RING.astype(np.int32), np.zeros(4, np.int32))
    yield "canonical_bulk", (4, RING.astype(np.int32), np.array([0, 4]))
    yield "run_path", motion(FourBar(25, 70, 40, 70).linkage())
    yield "run_path", motion(CLASS_III)
    yield "run_designs", designs()
    yield "closing", (DYAD, np.zeros(6), np.zeros(6), np.zeros((6, 6)))
    yield "newton", (DYAD, np.ones(6), 5)
    yield "close_near_singular", (DYAD, np.ones(6))
    yield "jacobian", (PIN, np.zeros(3))
    yield "settle_on_curve", (PIN, np.zeros(3), np.eye(3)[2])
    yield "trace_curve", (PIN, CURVE, 1, 0.1, 0.2, 1.0)
    yield "evaluate_pose", (PIN, CURVE, np.zeros(1), np.zeros(1, np.int64), np.zeros((1, 3)), np.zeros((1, 3)))
    yield "MultipleJoints", (9, 4, PAIRS, 0, 2, 9)
    yield "count_sliding", (np.ones((2, 4, 3), np.int64), 4, np.arange(4), 1, np.arange(4)[None])
    yield "describe_groups", (4, RING[None].astype(np.uint8))
    yield "count_modes", (3, np.array([[3, 5, 6]]), False)
    yield "count_modes", (3, np.array([[3, 5, 6]]), True)
    yield "track", (UNKNOWNS, TASK, TASK * 2, 0, 8, 1e-3)
    yield "refine_solutions", (UNKNOWNS, TASK, 0, 8)
    yield "certify", (UNKNOWNS, TASK, 0, 8)
    yield "evaluate_equations", (UNKNOWNS, TASK, 0, 8)
    yield "eliminate", (*ROWS, 2, 1e9, 1e9)
    yield "solve_back", (np.array([0]), np.array([0, 1]), np.array([1]), np.array([5]), np.ones((2, 1), np.int64))
    yield "reduce", (np.arange(6).reshape(2, 3),)
    yield from CALLS_OF_DESIGN
    yield from CALLS_IN_SPACE
    series = np.array([[-1.0, 1, 0, 1], [1, 3, 2, 1]]), np.arange(1.0, 25).reshape(2, 2, 6), -1.0
    yield "reduced_forces", (*series, 0.5, 2.0)
    method = np.tri(12) / 12, np.full(12, 1 / 12), np.full(13, 1e-3), np.full(13, 1e-3)
    state = np.array([0.5, 0.1, 0.0])
    yield "free_step", (*series, *method, 0.0, state, state, 0.01, 1.0, 1e-9, state)
    many = (*method, np.full((3, 16), 0.01), np.full((4, 16), 0.01), np.ones(2, np.uint8))
    yield "free_run", (*series, *many, 0.0, state, state, 0.01, 1.0, 1e-9, state, 100, np.array([0.3, 0.7]))
    layout = np.array([[0.0, 0], [1, 0], [0, 1]]), RING[:2], np.ones(2), np.array([[0, 2], [1, 0]])
    yield "relax", (*layout, np.arange(3)[None], np.eye(2)[None], 2, 5)
    yield from (("closest", (*layout[:2], layout[3])), ("crossing_segments", layout[:2]))
    chain = np.zeros(1, np.int64), np.array([4]), RING[None].astype(np.int32), np.zeros((1, 4), np.int32)
    ring = (4, 1, 1, *chain, np.frombuffer(b"RP", np.uint8))
    yield "describe_chains", ring
    _, ends, text, *_ = _core.describe_chains(*ring)
    yield "list_mechanisms", (4, 4, text, ends, True)


WHOLE = (-(2**63), -(2**31), -2, -1, 0, 1, 2, 3, 5, 9, 16, 33, 63, 64, 1000, 10**6, 2**31 - 1, 2**31, 2**62, 2**63 - 1)
REAL = (0.0, -1.0, 0.5, 1e-320, 1e160, 1e308, np.inf, -np.inf, np.nan)
KINDS = (np.int32, np.int64, np.uint8, np.uint64, np.float32, np.float64, np.complex128, object, "U3")


def other_shapes(array):
    yield from (array[None], array.ravel(), array[..., None], array[:0], array[:1], array[..., :0].copy())
    yield from (array[..., :-1].copy(), array[..., ::-1], array.T, np.asfortranarray(array), array[()].copy()[None][:0])
    for axis in range(array.ndim):
        yield np.concatenate([array] * 2, axis)
        yield np.repeat(array, 40, axis)
    yield np.zeros((0,) * array.ndim, array.dtype)
    if len(array):
        yield np.broadcast_to(array[:1], (3, *array.shape[1:]))


def other_numbers(array, random):
    """The numbers all replaced, and one of them."""
    limits = np.iinfo(array.dtype) if array.dtype.kind in "iu" else None
    numbers = [k for k in WHOLE if limits.min <= k <= limits.max] if limits else REAL
    for number in numbers:
        yield np.full_like(array, number)
        if array.size:
            one = array.copy()
            one.flat[random.integers(array.size)] = number
            yield one


def changes(value, random):
    """What may stand in place of a value, wrong or not."""
    yield from (None, "x", b"x", [], (), 1.5, {}, np.float64(2), object())
    if isinstance(value, np.ndarray):
        yield value.tolist()
        with warnings.catch_warnings(action="ignore"):  # numbers are lost, so they shall be
            yield from (value.astype(kind) for kind in KINDS)
        yield from other_shapes(value)
        yield from other_numbers(value, random)
        locked = value.copy()
        locked.setflags(write=False)
        yield locked
    elif isinstance(value, tuple):
        yield from (tuple(value)[:-1], (*value, None), list(value))
        for k, field in enumerate(value):
            yield from ((*value[:k], other, *value[k + 1 :]) for other in changes(field, random))
    elif isinstance(value, float):
        yield from REAL
    else:
        yield from (*WHOLE, 2**63, 2**64, -(2**70), np.nan, True)


class Heard(Exception):
    """A signal came while a door was at work."""


def hear(*_):
    raise Heard


def tried(door, arguments):
    """How a call ended; anything but an answer, an error in words or a heard signal is raised."""
    arguments = copy.deepcopy(arguments)
    began = time.process_time()
    try:
        signal.setitimer(signal.ITIMER_PROF, PATIENCE, PATIENCE)
        try:
            door(*arguments)
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
    except (TypeError, ValueError, MemoryError) as error:
        return "refused" if str(error) else "without words"
    except Heard:
        assert time.process_time() - began < LATEST, "no signal was heard"
        return "long"
    return "answered"


def main(pairs, behind=0):
    """Every change of one argument, and so many of two, at all doors; of the first `behind` only sound calls."""
    random = np.random.default_rng(27)
    signal.signal(signal.SIGPROF, hear)
    taken = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (taken + ROOM, taken + ROOM))
    count = 0
    for name, good in good_calls():
        door = grow_joints if name == "MultipleJoints" else getattr(_core, name)
        ends = {"answered": 0, "refused": 0, "long": 0}
        alternatives = [list(changes(value, random)) for value in good]
        tries = [{k: other} for k, others in enumerate(alternatives) for other in others]
        for _ in range(pairs if len(good) > 1 else 0):
            both = random.choice(len(good), 2, replace=False)
            tries.append({k: alternatives[k][random.integers(len(alternatives[k]))] for k in both.tolist()})
        for number, changed in enumerate(({}, *tries)):
            count += 1
            if count <= behind and changed:
                continue
            print(f"  {count}: {name}, call {number}, other arguments {list(changed)}", flush=True)
            end = tried(door, tuple(changed.get(k, value) for k, value in enumerate(good)))
            assert end in ends, end
            assert changed or end != "refused", "a sound call is refused"  # its signal may come in a slow build
            ends[end] += 1
        print(name, *(f"{times} {end}" for end, times in ends.items()), flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
