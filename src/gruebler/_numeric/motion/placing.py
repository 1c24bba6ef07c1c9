"""One pose of a linkage: everything placed in solving order, and whether that may be trusted."""

from __future__ import annotations

from math import cos, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.motion.closure import MESH, Conditions, closing, unwound_angle
from gruebler._numeric.motion.closure_rates import RateScratch, closing_rates
from gruebler._numeric.motion.dyads import dyad_place, dyad_rates, dyad_square, meeting
from gruebler._numeric.motion.newton import NewtonScratch, close_near_singular, factor, newton, solve_factored
from gruebler._numeric.motion.planar_jets import BodyJets, ElementJets, carry, rotated_derivative, set_element_jet
from gruebler._numeric.motion.program import (
    APART,
    APPROACH,
    EXPECTED,
    FARTHEST,
    GOOD,
    GROUP,
    KEPT,
    LOST,
    MEET,
    NEAREST,
    PRP,
    RPP,
    RPR,
    RRP,
    RRR,
    TURN,
    MotionScratch,
    PoseMemory,
    Program,
)

Reals = NDArray[np.float64]
Ints = NDArray[np.int64]

_ROUNDED = 1e-13  # a squared root that is negative by less is zero but for some hundred roundings of lengths
_PARALLEL = 1e-12  # the sine of lines that are parallel but for rounding: a dyad of one mode does not close there
_NEWTON_STEPS = 8  # from so good a prediction it arrives in 3 to 5
_SAME_PLACE = 1e-6  # of the last step: a pose so near an older one says nothing of the bend between them
_DEVIATION = 0.25  # of the way moved: poses farther from the prediction may be another assembly mode
_FIRST_DEVIATION = 0.01  # of the size: the same for the second pose, which the first alone lets expect
_STRAIGHT_DEVIATION = 0.02  # of the way moved: the same behind a change point, crossed on a straight line
_NO_DEVIATION = 1e-7  # of the size: nearer to the prediction nothing has jumped, however short the way
_AHEAD = 0.5  # of the way to the expected zero of a determinant: no step leads farther
_DETERMINANT_KEPT = 0.1  # of its last value: a determinant that keeps less may have come through zero


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _drive(kind: int, operation: Ints, program: Program, order: int, s: MotionScratch) -> None:
    """Place a driven link against the link that its drive holds on to."""
    on_near, on_far = operation[2], operation[3]
    near, far = program.links[on_near], program.links[on_far]
    sign, d = operation[4], operation[1]
    drives, places, turns, rates, points = s.drives, s.places, s.turns, s.rates, s.points
    links, elements = BodyJets(places, turns, rates), ElementJets(points, s.lines, s.spins)
    set_element_jet(order, near, program.points[on_near], program.lines[on_near], links, 0, elements)
    point = program.points[on_far]
    if kind == TURN:
        angle = sign * drives[0, d]
        turn = turns[near] * complex(cos(angle), sin(angle))
        turns[far] = turn
        places[far, 0] = points[0, 0] - turn * point
        if order == 0:
            return
        for k in range(order):
            rates[far, k] = rates[near, k] + sign * drives[k + 1, d]
        w, a, j = rates[far, 0], rates[far, 1], rates[far, 2]
        for k in range(1, order + 1):
            places[far, k] = points[0, k] - rotated_derivative(k, turn, w, a, j, point, 0j, 0j, 0j)
        return
    line = s.lines[0]
    turn = line * program.lines[on_far].conjugate()
    turns[far] = turn
    slide0, slide1, slide2, slide3 = drives[0, d] + 0j, drives[1, d] + 0j, drives[2, d] + 0j, drives[3, d] + 0j
    if sign < 0:  # the drive is measured along the far link's line, to the near link's point
        slide0, slide1, slide2, slide3 = -slide0, -slide1, -slide2, -slide3
    for k in range(order):
        rates[far, k] = rates[near, k]
    w, a, j = rates[near, 0], rates[near, 1], rates[near, 2]
    for k in range(order + 1):
        places[far, k] = (
            points[0, k]
            + rotated_derivative(k, line, w, a, j, slide0, slide1, slide2, slide3)
            - rotated_derivative(k, turn, w, a, j, point, 0j, 0j, 0j)
        )


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _root(square: float, number: int, at: float, memory: PoseMemory) -> tuple[int, float]:
    """The signed root of a dyad at a place on the path, and whether it may be trusted."""
    if not square >= -_ROUNDED:
        return APART, 0.0
    root = sqrt(square) if square > 0 else 0.0
    sign = memory.signs[number]
    change = memory.change[number]
    if not np.isnan(change):
        sign = sign if at <= change else memory.after[number]  # 0 if nothing is known of what lies there
        return GOOD if sign != 0 else APPROACH, root * sign
    count = memory.filled[0]
    if count == 0:
        return GOOD, root * sign
    now = memory.roots[0, number]
    if count > 1:
        slope = (now - memory.roots[1, number]) / (memory.at[0] - memory.at[1])
        predicted = now + slope * (at - memory.at[0])
        if sign * predicted < EXPECTED * sign * now:
            return APPROACH, root * sign
    if root < KEPT * abs(now):
        return APPROACH, root * sign
    return GOOD, root * sign


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _sine(sine: float, number: int, memory: PoseMemory) -> tuple[int, float]:
    """The same for a dyad of one mode: its lines may not become parallel."""
    if not abs(sine) > _PARALLEL or (memory.filled[0] > 0 and sine * memory.roots[0, number] < 0):
        return APART, sine
    return GOOD, sine


@njit(cache=True, error_model="numpy", _nrt=False)
def _predict(at: float, first: int, last: int, memory: PoseMemory) -> None:
    """Extrapolate the unknowns of a larger group from the last poses into the trial."""
    t = memory.at
    count = memory.filled[0]
    if count > 2 and abs(t[0] - t[2]) < _SAME_PLACE * abs(t[0] - t[1]):  # there and back by equal steps
        count = 2
    for k in range(first, last):
        y = memory.unknowns[0, k]
        if count > 2 and memory.singular[0] > 0:  # a straight line: near poses are too near one another for more
            y += (y - memory.unknowns[2, k]) / (t[0] - t[2]) * (at - t[0])
        elif count > 1:
            d01 = (y - memory.unknowns[1, k]) / (t[0] - t[1])
            y += d01 * (at - t[0])
            if count > 2:
                d12 = (memory.unknowns[1, k] - memory.unknowns[2, k]) / (t[1] - t[2])
                y += (d01 - d12) / (t[0] - t[2]) * (at - t[0]) * (at - t[1])
        memory.unknowns[3, k] = y


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def zero_ahead(number: int, memory: PoseMemory) -> float:
    """How far ahead of the last pose the determinant of a larger group is zero if it falls on so, or infinity."""
    now, past = memory.determinants[0, number], memory.determinants[1, number]
    if now * past <= 0 or abs(now) >= abs(past) or memory.at[0] <= memory.at[1]:
        return np.inf
    return float((memory.at[0] - memory.at[1]) * now / (past - now))


@njit(cache=True, error_model="numpy", _nrt=False)
def _expected(number: int, first: int, last: int, size: float, at: float, memory: PoseMemory, s: MotionScratch) -> bool:
    """Whether the trial of a larger group is near its prediction, and on the same side of singular positions."""
    missed = moved = 0.0
    for k in range(first, last):
        scale = size if k % 3 == 2 else 1.0
        missed = max(missed, scale * abs(memory.unknowns[3, k] - s.predicted[k - first]))
        moved = max(moved, scale * abs(memory.unknowns[3, k] - memory.unknowns[0, k]))
    if memory.singular[0] == 1 + number:
        return missed <= _STRAIGHT_DEVIATION * moved
    if missed > _NO_DEVIATION * size:
        if missed > (_DEVIATION * moved if memory.filled[0] > 1 else _FIRST_DEVIATION * size):
            return False
    ahead = zero_ahead(number, memory) if memory.filled[0] > 1 else np.inf
    if at - memory.at[0] > _AHEAD * ahead and ahead > NEAREST * memory.unit[0]:
        return False
    kept: bool = memory.determinants[3, number] / memory.determinants[0, number] > _DETERMINANT_KEPT
    return kept


@njit(cache=True, error_model="numpy", _nrt=False)
def _set_values(start: int, end: int, program: Program, memory: PoseMemory, values: Reals) -> None:
    """Write the numbers of the closing conditions; angles that count whole turns as they were in the last pose."""
    for c in range(start, end):
        for k in range(3):
            values[c - start, k], values[c - start, 5 + k] = program.values[c, k], program.values[c, 3 + k]
        first = program.windings[c]
        if first >= 0:
            values[c - start, 3], values[c - start, 4] = memory.unknowns[0, first], memory.unknowns[0, first + 1]


@njit(cache=True, error_model="numpy", _nrt=False)
def _wind(start: int, end: int, root: int, program: Program, memory: PoseMemory, s: MotionScratch) -> bool:
    """Write the angles that count whole turns into the trial; false if one has turned too far to be sure of them."""
    for c in range(start, end):
        first = program.windings[c]
        if first < 0:
            continue
        points, lines = s.ends, s.directions
        for side in range(2):
            slot = 2 * (c - start) + side
            body = program.owners[2 * c + side]
            points[side], lines[side] = s.group_points[slot, 0], s.group_lines[slot]
            if body >= 0:
                k = 3 * (root + body)
                turn = complex(cos(memory.unknowns[3, k + 2]), sin(memory.unknowns[3, k + 2]))
                points[side] = complex(memory.unknowns[3, k], memory.unknowns[3, k + 1]) + turn * points[side]
                lines[side] = turn * lines[side]
        near = memory.unknowns[0, first], memory.unknowns[0, first + 1]
        if program.kinds[c] == MESH:
            along = (points[1] - points[0]).conjugate()
            memory.unknowns[3, first] = unwound_angle(lines[0] * along, near[0])
            memory.unknowns[3, first + 1] = unwound_angle(lines[1] * along, near[1])
        else:
            memory.unknowns[3, first] = unwound_angle(lines[0].conjugate() * lines[1], near[0])
            memory.unknowns[3, first + 1] = 0
        for k in range(2):
            if memory.filled[0] > 0 and abs(memory.unknowns[3, first + k] - near[k]) > FARTHEST:
                return False
    return True


@njit(cache=True, error_model="numpy", _nrt=False)
def _group(number: int, program: Program, order: int, at: float, memory: PoseMemory, s: MotionScratch) -> bool:
    """Place the bodies of a larger group by Newton's method from what the last poses let expect."""
    start, end = program.conditions[number], program.conditions[number + 1]
    first, last = program.bodies[number], program.bodies[number + 1]
    links = BodyJets(s.places, s.turns, s.rates)
    elements = ElementJets(s.group_points, s.group_lines, s.group_spins)
    bodies = BodyJets(s.body_places, s.body_turns, s.body_rates)
    work = NewtonScratch(s.residual, s.jacobian, s.normal, s.pivots)
    for slot in range(2 * (end - start)):
        e = program.sides[2 * start + slot]
        link = program.links[e]
        set_element_jet(order, link, program.points[e], program.lines[e], links, slot, elements)
    _predict(at, 3 * first, 3 * last, memory)
    unknowns = memory.unknowns[3, 3 * first : 3 * last]
    for k in range(len(unknowns)):
        s.predicted[k] = unknowns[k]
    _set_values(start, end, program, memory, s.values)
    conditions = Conditions(
        program.kinds[start:end],
        s.values,
        program.pieces,
        program.owners[2 * start : 2 * end],
        s.group_points,
        s.group_lines,
        s.group_spins,
        program.size,
    )
    singular = memory.singular[0] == -1 - number
    if singular:
        close_near_singular(conditions, unknowns, work)
    else:
        steps, determinant = newton(conditions, unknowns, _NEWTON_STEPS, work)
        memory.determinants[3, number] = determinant
        if steps < 0:
            return False
        if memory.filled[0] > 0 and not _expected(number, 3 * first, 3 * last, program.size, at, memory, s):
            return False
    if not _wind(start, end, first, program, memory, s):
        return False
    for k in range(last - first):
        bodies.turns[k] = complex(cos(unknowns[3 * k + 2]), sin(unknowns[3 * k + 2]))
        for m in range(4):
            bodies.places[k, m] = 0
        for m in range(3):
            bodies.rates[k, m] = 0
        bodies.places[k, 0] = complex(unknowns[3 * k], unknowns[3 * k + 1])
    if order > 0:
        n, jacobian, pivots, target = 3 * (last - first), s.jacobian, s.pivots, s.residual
        closing(conditions, unknowns, target, jacobian)
        factor(jacobian, n, pivots)
        for k in range(1, order + 1):
            closing_rates(k, conditions, bodies, RateScratch(s.gap, s.gap_spins), target)
            solve_factored(jacobian, n, pivots, target)
            for b in range(last - first):
                bodies.places[b, k] = complex(target[3 * b], target[3 * b + 1])
                bodies.rates[b, k - 1] = np.nan if singular else target[3 * b + 2]
    for k in range(last - first):
        link = program.roots[first + k]
        links.turns[link] = bodies.turns[k]
        for m in range(order + 1):
            links.places[link, m] = bodies.places[k, m]
        for m in range(order):
            links.rates[link, m] = bodies.rates[k, m]
    return True


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def driven_arm(operation: Ints, program: Program) -> bool:
    """Whether a drive holds the two ends of the arm of an RRP, which are on two links then, and changes its length."""
    driven: bool = operation[0] == RRP and program.links[operation[2]] != program.links[operation[3]]
    return driven


@njit(cache=True, error_model="numpy", _nrt=False)
def try_pose(program: Program, order: int, at: float, memory: PoseMemory, s: MotionScratch) -> int:
    """Place everything at a place on the path; the drives stand in the scratch. Returns whether to trust it."""
    links, elements = BodyJets(s.places, s.turns, s.rates), ElementJets(s.points, s.lines, s.spins)
    for link in range(len(links.turns)):
        links.turns[link] = 1
        links.places[link, 0] = 0
        for k in range(order):
            links.places[link, k + 1] = 0
            links.rates[link, k] = 0
    for o in range(len(program.operations)):
        operation = program.operations[o]
        kind = operation[0]
        if kind < RRR:
            _drive(kind, operation, program, order, s)
        elif kind < GROUP:
            for slot in range(6):
                e = operation[1 + slot]
                link = program.links[e]
                set_element_jet(order, link, program.points[e], program.lines[e], links, slot, elements)
            number = operation[9]
            driven = driven_arm(operation, program)
            square = dyad_square(kind, elements, program.size, driven)
            if kind in (PRP, RPP):
                verdict, root = _sine(square, number, memory)
            else:
                verdict, root = _root(square, number, at, memory)
            memory.roots[3, number] = root
            if verdict != GOOD:
                memory.which[0] = number
                return verdict
            first, second = operation[7], operation[8]
            if (kind in (RRR, RPR) or driven) and meeting(kind, elements, program.size):
                if memory.met[number] != at:
                    memory.which[0] = number
                    return MEET
                links.turns[first] = memory.direction[number]
            dyad_place(kind, root, elements, first, second, links, program.size, driven)
            if order > 0:
                dyad_rates(kind, order, elements, first, second, links)
        elif kind == GROUP:
            if not _group(operation[1], program, order, at, memory, s):
                memory.which[0] = operation[1]
                return LOST
        else:
            carry(order, operation[1], operation[2], links)
    return GOOD


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def set_drives(path: Reals, speeds: Reals, at: float, s: MotionScratch) -> None:
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
def _copy(memory: PoseMemory, source: int, target: int) -> None:
    memory.at[target] = memory.at[source]
    for m in range(memory.roots.shape[1]):
        memory.roots[target, m] = memory.roots[source, m]
    for m in range(memory.unknowns.shape[1]):
        memory.unknowns[target, m] = memory.unknowns[source, m]
    for m in range(memory.determinants.shape[1]):
        memory.determinants[target, m] = memory.determinants[source, m]


@njit(cache=True, error_model="numpy", _nrt=False)
def forget_poses(memory: PoseMemory) -> None:
    """Take the last pose back."""
    _copy(memory, 1, 0)
    _copy(memory, 2, 1)
    memory.filled[0] -= 1


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def accept_pose(at: float, memory: PoseMemory) -> None:
    memory.at[3] = at
    _copy(memory, 1, 2)
    _copy(memory, 0, 1)
    _copy(memory, 3, 0)
    memory.filled[0] = min(memory.filled[0] + 1, 3)
    if (memory.at[0] - memory.at[1]) * (memory.at[1] - memory.at[2]) <= 0:  # turned back: two poses may be one
        memory.filled[0] = min(memory.filled[0], 2)
    for number in range(len(memory.signs)):
        change = memory.change[number]
        if at >= change:  # not if it is NaN
            if memory.after[number] != 0:
                memory.signs[number] = memory.after[number]
            memory.change[number] = np.nan
