"""A linkage moved along a path of its drives: every group after the other, every step checked for continuity.

`run` takes a `Program` (what to place in which order) and rows of drive values, and walks from row to row. Between rows
the drives move on straight lines; a step is halved until what is found is near what was foretold, so that nothing
jumps. The theorems behind the checks are in docs/theory/kinematics.md.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.closure import closing, closing_rates, factor, newton, solve_factored
from gruebler._numeric.compiling import njit
from gruebler._numeric.dyads import PRP, RPP, dyad_place, dyad_rates, dyad_square
from gruebler._numeric.planar_jets import carry, element, turned

__all__ = ["CARRY", "DONE", "GROUP", "LIMIT", "PUSH", "SINGULAR", "START", "TURN", "Program", "run", "run_many"]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]

TURN, PUSH = 0, 1  # then the dyads, 2 to 6
GROUP, CARRY = 7, 8

DONE, LIMIT, SINGULAR, START = range(4)
"""How a run ended: at its last row; where a dyad cannot be assembled any more; where a larger group cannot be followed;
or at its first row already."""

_GOOD, _TOO_FAR, _APPROACH, _APART, _LOST = range(5)
_FLAT = 1e-12  # a squared root below this is zero: an exact change point
_NEAR = 1e-3  # below this root a change point is looked for
_LEAST = 1e-14  # the smallest step, in rows


class Program(NamedTuple):
    """What a linkage is to the kernel."""

    operations: Ints
    """(operations, 10) whole numbers: what to do, then its arguments."""
    links: Ints
    """(elements,) the link of each joint element."""
    points: Complexes
    """(elements,) complex: the element's point in its link."""
    lines: Complexes
    """(elements,) complex of modulus 1: the element's direction in its link."""
    conditions: Ints
    """(groups + 1,) where the closing conditions of each larger group start."""
    kinds: Ints
    """(conditions,) their kinds."""
    sides: Ints
    """(2 conditions,) their elements."""
    owners: Ints
    """(2 conditions,) the body of the group that carries the element, -1 for what is known."""
    bodies: Ints
    """(groups + 1,) where the bodies of each larger group start."""
    roots: Ints
    """(bodies,) the link that stands for the body."""
    most: Reals
    """(drives,) the longest step of each drive."""
    size: float
    """A length of the order of the linkage."""


class _Memory(NamedTuple):
    """What the last poses were, newest first; index 3 is the trial."""

    at: Reals  # (4,) their places on the path
    filled: Ints  # (1,) how many there are
    roots: Reals  # (4, dyads) signed roots
    unknowns: Reals  # (4, 3 bodies)
    determinants: Reals  # (4, groups)
    signs: Reals  # (dyads,) the sign that holds from here on
    change: Reals  # (dyads,) where the root goes through zero, NaN if that is not known
    after: Reals  # (dyads,) the sign behind that
    which: Ints  # (1,) the dyad or group that spoils the trial


class _Scratch(NamedTuple):
    places: Complexes
    turns: Complexes
    rates: Reals
    points: Complexes
    lines: Complexes
    spins: Reals
    group_points: Complexes
    group_lines: Complexes
    group_spins: Reals
    residual: Reals
    jacobian: Reals
    pivots: Ints
    values: Reals
    body_places: Complexes
    body_turns: Complexes
    body_rates: Reals
    drives: Reals
    gap: Complexes
    foretold: Reals
    before: Complexes
    turned: Ints


def _memory(dyads: int, bodies: int, groups: int) -> _Memory:
    return _Memory(
        np.zeros(4),
        np.zeros(1, np.int64),
        np.zeros((4, dyads)),
        np.zeros((4, 3 * bodies)),
        np.zeros((4, groups)),
        np.ones(dyads),
        np.full(dyads, np.nan),
        np.ones(dyads),
        np.zeros(1, np.int64),
    )


def _scratch(links: int, conditions: int, bodies: int, drives: int) -> _Scratch:
    c, b = max(conditions, 1), max(bodies, 1)
    return _Scratch(
        np.zeros((links, 4), np.complex128),
        np.ones(links, np.complex128),
        np.zeros((links, 3)),
        np.zeros((6, 4), np.complex128),
        np.zeros(6, np.complex128),
        np.zeros((6, 3)),
        np.zeros((2 * c, 4), np.complex128),
        np.zeros(2 * c, np.complex128),
        np.zeros((2 * c, 3)),
        np.zeros(3 * b + 2),
        np.zeros((3 * b + 2, 3 * b)),
        np.zeros(3 * b + 2, np.int64),
        np.zeros((c, 3)),
        np.zeros((b, 4), np.complex128),
        np.ones(b, np.complex128),
        np.zeros((b, 3)),
        np.zeros((4, drives)),
        np.zeros(4, np.complex128),
        np.zeros(3 * b),
        np.ones(links, np.complex128),
        np.zeros(links, np.int64),
    )


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _drive(kind: int, operation: Ints, program: Program, order: int, s: _Scratch) -> None:
    """Place a driven link against the link that its drive holds on to."""
    near, far = program.links[operation[2]], program.links[operation[3]]
    one, other = operation[2], operation[3]
    sign, d = operation[4], operation[1]
    element(
        order, near, program.points[one], program.lines[one], s.places, s.turns, s.rates, 0, s.points, s.lines, s.spins
    )
    point = program.points[other]
    if kind == TURN:
        angle = sign * s.drives[0, d]
        turn = s.turns[near] * complex(cos(angle), sin(angle))
        s.turns[far] = turn
        s.places[far, 0] = s.points[0, 0] - turn * point
        if order == 0:
            return
        for k in range(order):
            s.rates[far, k] = s.rates[near, k] + sign * s.drives[k + 1, d]
        w, a, j = s.rates[far, 0], s.rates[far, 1], s.rates[far, 2]
        for k in range(1, order + 1):
            s.places[far, k] = s.points[0, k] - turned(k, turn, w, a, j, point, 0j, 0j, 0j)
        return
    line = s.lines[0]
    turn = line * program.lines[other].conjugate()
    s.turns[far] = turn
    way0, way1, way2, way3 = s.drives[0, d] + 0j, s.drives[1, d] + 0j, s.drives[2, d] + 0j, s.drives[3, d] + 0j
    if sign < 0:  # the way is measured along the far link's line, to the near link's point
        way0, way1, way2, way3 = -way0, -way1, -way2, -way3
    for k in range(order):
        s.rates[far, k] = s.rates[near, k]
    w, a, j = s.rates[near, 0], s.rates[near, 1], s.rates[near, 2]
    for k in range(order + 1):
        s.places[far, k] = (
            s.points[0, k]
            + turned(k, line, w, a, j, way0, way1, way2, way3)
            - turned(k, turn, w, a, j, point, 0j, 0j, 0j)
        )


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _root(square: float, number: int, at: float, memory: _Memory) -> tuple[int, float]:
    """The signed root of a dyad at a place on the path, and whether it may be trusted."""
    if not square >= -1e-13:
        return _APART, 0.0
    root = sqrt(square) if square > 0 else 0.0
    sign = memory.signs[number]
    change = memory.change[number]
    if not np.isnan(change):
        return _GOOD, root * (sign if at <= change else memory.after[number])
    count = memory.filled[0]
    if count == 0:
        return _GOOD, root * sign
    now = memory.roots[0, number]
    if count > 1:
        slope = (now - memory.roots[1, number]) / (memory.at[0] - memory.at[1])
        foretold = now + slope * (at - memory.at[0])
        if sign * foretold < 0.5 * sign * now:
            return _APPROACH, root * sign
    if root < 0.25 * abs(now):
        return _APPROACH, root * sign
    return _GOOD, root * sign


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _sine(sine: float, number: int, memory: _Memory) -> tuple[int, float]:
    """The same for a dyad of one mode: its lines may not become parallel."""
    if not abs(sine) > 1e-12 or (memory.filled[0] > 0 and sine * memory.roots[0, number] < 0):
        return _APART, sine
    return _GOOD, sine


@njit(cache=True, error_model="numpy", _nrt=False)
def _foretell(at: float, first: int, last: int, memory: _Memory) -> None:
    """Extrapolate the unknowns of a larger group from the last three poses into the trial."""
    t = memory.at
    count = memory.filled[0]
    for k in range(first, last):
        y = memory.unknowns[0, k]
        if count > 1:
            d01 = (y - memory.unknowns[1, k]) / (t[0] - t[1])
            y += d01 * (at - t[0])
            if count > 2:
                d12 = (memory.unknowns[1, k] - memory.unknowns[2, k]) / (t[1] - t[2])
                y += (d01 - d12) / (t[0] - t[2]) * (at - t[0]) * (at - t[1])
        memory.unknowns[3, k] = y


@njit(cache=True, error_model="numpy", _nrt=False)
def _group(number: int, program: Program, order: int, at: float, memory: _Memory, s: _Scratch) -> bool:
    """Place the bodies of a larger group by Newton's method from what is foretold."""
    start, end = program.conditions[number], program.conditions[number + 1]
    first, last = program.bodies[number], program.bodies[number + 1]
    kinds, owners = program.kinds[start:end], program.owners[2 * start : 2 * end]
    points, lines, spins = s.group_points, s.group_lines, s.group_spins
    for slot in range(2 * (end - start)):
        e = program.sides[2 * start + slot]
        link = program.links[e]
        element(
            order, link, program.points[e], program.lines[e], s.places, s.turns, s.rates, slot, points, lines, spins
        )
    _foretell(at, 3 * first, 3 * last, memory)
    unknowns = memory.unknowns[3, 3 * first : 3 * last]
    foretold = s.foretold
    for k in range(len(unknowns)):
        foretold[k] = unknowns[k]
    size = program.size
    steps, determinant = newton(
        kinds, s.values[:, 0], owners, points, lines, unknowns, size, s.residual, s.jacobian, s.pivots, 8
    )
    if steps < 0:
        return False
    memory.determinants[3, number] = determinant
    if memory.filled[0] > 0:
        missed = moved = 0.0
        for k in range(3 * (last - first)):
            scale = size if k % 3 == 2 else 1.0
            missed = max(missed, scale * abs(unknowns[k] - foretold[k]))
            moved = max(moved, scale * abs(unknowns[k] - memory.unknowns[0, 3 * first + k]))
        if missed > 1e-7 * size and missed > (0.25 * moved if memory.filled[0] > 1 else 0.01 * size):
            return False
        if determinant * memory.determinants[0, number] < 0:
            return False
    n = 3 * (last - first)
    for k in range(last - first):
        turn = complex(cos(unknowns[3 * k + 2]), sin(unknowns[3 * k + 2]))
        s.body_turns[k] = turn
        for m in range(4):
            s.body_places[k, m] = 0
        for m in range(3):
            s.body_rates[k, m] = 0
        s.body_places[k, 0] = complex(unknowns[3 * k], unknowns[3 * k + 1])
    if order > 0:
        closing(kinds, s.values[:, 0], owners, points, lines, unknowns, size, s.residual, s.jacobian)
        factor(s.jacobian, n, s.pivots)
        for k in range(1, order + 1):
            closing_rates(
                k,
                kinds,
                s.values,
                owners,
                points,
                lines,
                spins,
                s.body_turns,
                s.body_rates,
                s.body_places,
                size,
                s.gap,
                s.residual,
            )
            solve_factored(s.jacobian, n, s.pivots, s.residual)
            for b in range(last - first):
                s.body_places[b, k] = complex(s.residual[3 * b], s.residual[3 * b + 1])
                s.body_rates[b, k - 1] = s.residual[3 * b + 2]
    for k in range(last - first):
        link = program.roots[first + k]
        s.turns[link] = s.body_turns[k]
        for m in range(order + 1):
            s.places[link, m] = s.body_places[k, m]
        for m in range(order):
            s.rates[link, m] = s.body_rates[k, m]
    return True


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _attempt(program: Program, order: int, at: float, memory: _Memory, s: _Scratch) -> int:
    """Place everything at a place on the path; the drives stand in the scratch. Returns whether to trust it."""
    for link in range(len(s.turns)):
        s.turns[link] = 1
        s.places[link, 0] = 0
        for k in range(order):
            s.places[link, k + 1] = 0
            s.rates[link, k] = 0
    for o in range(len(program.operations)):
        operation = program.operations[o]
        kind = operation[0]
        if kind in (TURN, PUSH):
            _drive(kind, operation, program, order, s)
        elif kind < GROUP:
            for slot in range(6):
                e = operation[1 + slot]
                link = program.links[e]
                element(
                    order,
                    link,
                    program.points[e],
                    program.lines[e],
                    s.places,
                    s.turns,
                    s.rates,
                    slot,
                    s.points,
                    s.lines,
                    s.spins,
                )
            number = operation[9]
            square = dyad_square(kind, s.points, s.lines, program.size)
            if kind in (PRP, RPP):
                verdict, root = _sine(square, number, memory)
            else:
                verdict, root = _root(square, number, at, memory)
            memory.roots[3, number] = root
            if verdict != _GOOD:
                memory.which[0] = number
                return verdict
            one, two = operation[7], operation[8]
            dyad_place(kind, root, s.points, s.lines, one, two, s.places, s.turns, program.size)
            if order > 0:
                dyad_rates(kind, order, s.points, s.lines, s.spins, one, two, s.places, s.turns, s.rates)
        elif kind == GROUP:
            if not _group(operation[1], program, order, at, memory, s):
                memory.which[0] = operation[1]
                return _LOST
        else:
            carry(order, operation[1], operation[2], s.places, s.turns, s.rates)
    return _GOOD


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _set_drives(path: Reals, speeds: Reals, at: float, s: _Scratch) -> None:
    row = min(int(at), len(path) - 1)
    part = at - row
    for d in range(path.shape[1]):
        s.drives[0, d] = path[row, d]
        if part > 0:
            s.drives[0, d] += part * (path[row + 1, d] - path[row, d])
    if part == 0:
        for k in range(len(speeds)):
            for d in range(path.shape[1]):
                s.drives[k + 1, d] = speeds[k, row, d]


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _commit(at: float, memory: _Memory) -> None:
    for k in (2, 1, 0):
        source = 3 if k == 0 else k - 1
        memory.at[k] = at if k == 0 else memory.at[k - 1]
        for m in range(memory.roots.shape[1]):
            memory.roots[k, m] = memory.roots[source, m]
        for m in range(memory.unknowns.shape[1]):
            memory.unknowns[k, m] = memory.unknowns[source, m]
        for m in range(memory.determinants.shape[1]):
            memory.determinants[k, m] = memory.determinants[source, m]
    memory.filled[0] = min(memory.filled[0] + 1, 3)
    for number in range(len(memory.signs)):
        change = memory.change[number]
        if at >= change:  # not if it is NaN
            memory.signs[number] = memory.after[number]
            memory.change[number] = np.nan


@njit(cache=True, error_model="numpy", _nrt=False)
def _square_at(
    program: Program, path: Reals, speeds: Reals, at: float, wanted: int, memory: _Memory, s: _Scratch
) -> float:
    """The squared root of one dyad somewhere near the last pose; NaN where something before it cannot be placed."""
    _set_drives(path, speeds, at, s)
    verdict = _attempt(program, 0, at, memory, s)
    if verdict in (_APPROACH, _APART) and memory.which[0] == wanted:
        for operation in program.operations:
            if 2 <= operation[0] < GROUP and operation[9] == wanted:
                return dyad_square(operation[0], s.points, s.lines, program.size)
    if verdict == _GOOD:
        return float(memory.roots[3, wanted] ** 2)
    return np.nan


@njit(cache=True, error_model="numpy", _nrt=False)
def _look_for_change(
    program: Program, path: Reals, speeds: Reals, reach: float, number: int, memory: _Memory, s: _Scratch
) -> tuple[float, bool]:
    """Where the square of a small root is least ahead of the last pose, and the sign behind that place.

    If the least square is zero the root goes through zero (an exact change point) and changes its sign; if it is above
    zero the linkage only passes near one. If it is below zero, there is a limit: returns where the square is negative.
    """
    low, high = memory.at[0], reach
    ratio = 0.6180339887498949
    inner, outer = high - ratio * (high - low), low + ratio * (high - low)
    at_inner = _square_at(program, path, speeds, inner, number, memory, s)
    at_outer = _square_at(program, path, speeds, outer, number, memory, s)
    for _ in range(200):
        if at_inner < -_FLAT:
            return inner, True
        if at_outer < -_FLAT:
            return outer, True
        if high - low < 1e-9 * (reach - memory.at[0]) or high - low < 1e-15 * (1 + abs(high)):
            break
        if at_inner <= at_outer or np.isnan(at_inner):
            high, outer, at_outer = outer, inner, at_inner
            inner = high - ratio * (high - low)
            at_inner = _square_at(program, path, speeds, inner, number, memory, s)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + ratio * (high - low)
            at_outer = _square_at(program, path, speeds, outer, number, memory, s)
    at, least = (inner, at_inner) if at_inner <= at_outer else (outer, at_outer)
    if np.isnan(least) or at >= reach - 1e-6 * (reach - memory.at[0]):
        return reach, False  # still falling: nothing is decided yet
    memory.change[number] = at
    memory.after[number] = -memory.signs[number] if least < _FLAT else memory.signs[number]
    return at, False


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _record(row: int, order: int, places: Complexes, turns: Complexes, rates: Reals, whole: Ints, s: _Scratch) -> None:
    for link in range(len(s.turns)):
        turn, last = s.turns[link], s.before[link]
        if (turn.imag < 0) != (last.imag < 0) and last.real * abs(turn.imag) + turn.real * abs(last.imag) < 0:
            s.turned[link] += 1 if turn.imag < 0 else -1
        s.before[link] = turn
        if row >= 0:
            turns[row, link] = turn
            whole[row, link] = s.turned[link]
            for k in range(order + 1):
                places[k, row, link] = s.places[link, k]
            for k in range(order):
                rates[k, row, link] = s.rates[link, k]


def run(
    program: Program,
    path: Reals,
    speeds: Reals,
    order: int,
    signs: Reals,
    start: Reals,
    places: Complexes,
    turns: Complexes,
    rates: Reals,
    whole: Ints,
    roots: Reals,
    unknowns: Reals,
) -> tuple[int, int, float, int]:
    """Move along the path.

    Args:
        program: the linkage.
        path: (rows, drives) drive values.
        speeds: (order, rows, drives) their time derivatives.
        order: 0 positions, 1 velocities, 2 accelerations, 3 jerks.
        signs: (dyads,) the signs of the assembly modes at the first row.
        start: (3 bodies,) near the unknowns of larger groups at the first row.
        places: (order + 1, rows, links) complex, written.
        turns: (rows, links) complex, written.
        rates: (order, rows, links), written.
        whole: (rows, links) whole turns since the first row, for angles without jumps, written.
        roots: (rows, dyads) signed roots, written.
        unknowns: (rows, 3 bodies), written.

    Returns how it ended, how many rows are written, where on the path it stopped (in rows), and what is at fault: the
    number of the dyad, or -1 minus the number of the larger group.
    """
    memory = _memory(len(signs), len(start) // 3, len(program.conditions) - 1)
    s = _scratch(places.shape[2], len(program.kinds), len(start) // 3, path.shape[1])
    return _run(program, path, speeds, order, signs, start, places, turns, rates, whole, roots, unknowns, memory, s)


@njit(cache=True, error_model="numpy", _nrt=False)
def _run(
    program: Program,
    path: Reals,
    speeds: Reals,
    order: int,
    signs: Reals,
    start: Reals,
    places: Complexes,
    turns: Complexes,
    rates: Reals,
    whole: Ints,
    roots: Reals,
    unknowns: Reals,
    memory: _Memory,
    s: _Scratch,
) -> tuple[int, int, float, int]:
    rows = len(path)
    memory.filled[0] = 0
    for k in range(len(signs)):
        memory.signs[k] = signs[k]
        memory.change[k] = np.nan
    for k in range(len(start)):
        memory.unknowns[0, k] = start[k]
    _set_drives(path, speeds, 0.0, s)
    verdict = _attempt(program, order, 0.0, memory, s)
    if verdict != _GOOD:
        return START, 0, 0.0, memory.which[0] if verdict == _APART else -1 - memory.which[0]
    for link in range(len(s.turns)):
        s.before[link] = s.turns[link]
        s.turned[link] = 0
    _commit(0.0, memory)
    _record(0, order, places, turns, rates, whole, s)
    for m in range(roots.shape[1]):
        roots[0, m] = memory.roots[0, m]
    for m in range(unknowns.shape[1]):
        unknowns[0, m] = memory.unknowns[0, m]
    at, step, fault = 0.0, 1e-3, np.inf
    for row in range(1, rows):
        longest = 1.0
        for d in range(path.shape[1]):
            way = abs(path[row, d] - path[row - 1, d])
            if way > program.most[d]:
                longest = min(longest, program.most[d] / way)
        while at < row:
            left = row - at
            full = step >= left * (1 - 1e-9)
            trial = float(row) if full else at + step
            _set_drives(path, speeds, trial, s)
            verdict = _attempt(program, order if full else 0, trial, memory, s)
            if verdict == _GOOD:
                _commit(trial, memory)
                _record(row if full else -1, order, places, turns, rates, whole, s)
                at = trial
                if at >= fault:
                    fault = np.inf
                step = min(2 * step, longest) if fault == np.inf else (fault - at) / 2
                continue
            number = memory.which[0]
            if verdict == _APPROACH and abs(memory.roots[0, number]) < _NEAR and fault == np.inf:
                now, past = memory.roots[0, number], memory.roots[1, number]
                slope = (now - past) / (memory.at[0] - memory.at[1])
                ahead = abs(now / slope) if slope != 0 else step
                reach = min(at + max(4 * ahead, 1e-13 * (1 + at)), float(rows - 1))
                place, negative = _look_for_change(program, path, speeds, reach, number, memory, s)
                if negative:
                    fault, step = place, place - at
                elif not np.isnan(memory.change[number]):
                    step = max(2 * (place - at), 1e-12)
                else:
                    memory.change[number] = place  # falling all the way: as it was, up to there
                    memory.after[number] = memory.signs[number]
                    step = place - at
                continue
            if verdict == _APART:
                fault = min(fault, trial)
            step = min(step, left) / 2
            if step < _LEAST * (1 + abs(at)):
                if verdict == _LOST:
                    return SINGULAR, row, at, -1 - number
                return LIMIT, row, at, number
        for m in range(roots.shape[1]):
            roots[row, m] = memory.roots[0, m]
        for m in range(unknowns.shape[1]):
            unknowns[row, m] = memory.unknowns[0, m]
    return DONE, rows, float(rows - 1), 0


def run_many(
    program: Program, points: Complexes, lines: Complexes, sizes: Reals, path: Reals, signs: Reals, start: Reals
) -> tuple[Complexes, Complexes, Ints]:
    """Move many designs of one mechanism along one path.

    ``points`` and ``lines`` are (designs, elements), ``sizes`` and the rest of `Program` as there. Returns places
    (designs, rows, links), turns (designs, rows, links) and the number of rows that each design reached; what lies
    behind is NaN.
    """
    designs, rows = len(points), len(path)
    links = 1 + max(int(program.links.max()), int(program.roots.max(initial=0)))
    places = np.full((designs, 1, rows, links), np.nan, np.complex128)
    turns = np.full((designs, rows, links), np.nan, np.complex128)
    ends = np.zeros(designs, np.int64)
    memory = _memory(len(signs), len(start) // 3, len(program.conditions) - 1)
    s = _scratch(links, len(program.kinds), len(start) // 3, path.shape[1])
    spare = (
        np.zeros((0, rows, path.shape[1])),
        np.zeros((0, rows, links)),
        np.zeros((rows, links), np.int64),
        np.zeros((rows, len(signs))),
        np.zeros((rows, len(start))),
    )
    _run_many(program, points, lines, sizes, path, signs, start, places, turns, ends, spare, memory, s)
    return places[:, 0], turns, ends


@njit(cache=True, error_model="numpy", _nrt=False)
def _run_many(
    program: Program,
    points: Complexes,
    lines: Complexes,
    sizes: Reals,
    path: Reals,
    signs: Reals,
    start: Reals,
    places: Complexes,
    turns: Complexes,
    ends: Ints,
    spare: tuple[Reals, Reals, Ints, Reals, Reals],
    memory: _Memory,
    s: _Scratch,
) -> None:
    for design in range(len(points)):
        mine = Program(
            program.operations,
            program.links,
            points[design],
            lines[design],
            program.conditions,
            program.kinds,
            program.sides,
            program.owners,
            program.bodies,
            program.roots,
            program.most,
            sizes[design],
        )
        speeds, rates, whole, roots, unknowns = spare
        end = _run(
            mine,
            path,
            speeds,
            0,
            signs,
            start,
            places[design],
            turns[design],
            rates,
            whole,
            roots,
            unknowns,
            memory,
            s,
        )
        ends[design] = end[1]
