"""A linkage moved along a path of its drives: every group after the other, every step checked for continuity.

`run_path` takes a `Program` (what to place in which order) and rows of drive values, and walks from row to row.
Between rows the drives move on straight lines; a step is halved until the pose is near the one that the last poses let
expect, so that nothing jumps. Where rows are close and nothing special happens, `sweep` takes many of them at once. The
theorems behind the checks are in docs/theory/kinematics.md.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import for_work, njit
from gruebler._numeric.motion.dyads import dyad_square
from gruebler._numeric.motion.placing import accept_pose, driven_arm, forget_poses, set_drives, try_pose, zero_ahead
from gruebler._numeric.motion.planar_jets import ElementJets
from gruebler._numeric.motion.program import (
    APART,
    APPROACH,
    DONE,
    FLAT,
    GOOD,
    GROUP,
    LEAST,
    LIMIT,
    LOST,
    MEET,
    NEAR,
    NEAREST,
    RPR,
    SINGULAR,
    START,
    MotionScratch,
    PoseBuffer,
    PoseMemory,
    Program,
    new_motion_scratch,
    new_pose_memory,
)
from gruebler._numeric.motion.registers import REGISTERS
from gruebler._numeric.motion.sweep import SWEPT_ROWS, steady, sweep, swept_links
from gruebler._numeric.work_estimates import walking

Reals = NDArray[np.float64]
_NOISE = 1e-14  # of squared roots: a hundred roundings
_PAUSE = 16  # rows to walk after a sweep was stopped
_GOLDEN = 0.6180339887498949  # of an interval: the golden section
_SECTIONS = 200  # more than the golden section takes from any interval down to neighbouring numbers
_NARROW = 1e-9  # of the way searched: the place of a least square is not known better, since squares are flat there
_ROUNDING = 1e-15  # of a place on the path: shorter intervals have no number inside
_RISEN = 1.5  # times the least square: an end above it lies behind the least place
_KNOWN = 1e-3  # of the way: the least step on where nothing farther is known
_FALLING = 0.9  # of the way on which a square falls to its end: nothing is decided yet, no step leads farther
_FIRST_STEP = 0.01  # of the longest step, where no poses let expect the next one
_REACHED = 1e-9  # of what is left of the way: a step that misses the row by less goes to it
_CROSSED = 1 / 64  # of the longest step: the step behind a change point
_IN_LINE = 1e-9  # of the longest drive: directions of two rows that differ by less are one line
_LONGEST_STEP = 1e6  # rows, where the drives rest
_BEFORE_MEETING = 1e-3  # of the longest step: poses so far from the place where outer joints meet show their direction
_BEFORE_MEETING_ROWS = 0.3  # rows at most: three such poses lie within one row
_EXTRAPOLATION = (3.0, -3.0, 1.0)  # weights of a parabola through three poses at equal steps, one step ahead
_SINGULAR_FROM = 10 * NEAREST  # of the longest step: nearer to a singular place rates have too few digits to judge by
_SINGULAR_TO = 1e-3  # of the longest step: farther from it the determinant does not fall on a line yet
_GROWTH = 0.05  # of a determinant: how much it has to fall over three poses, for rates to be compared with it
_STEADY_RATES = 0.1  # of that fall: rates that change by less stay, and the place is a change point
_AROUND = 6.0  # times the way to a change point: a row nearer than that is placed between both sides
_BOTH_SIDES = 3e-5  # of the longest step: before a row is placed so, the near side is as near as that
_FAR_SIDE = 1e-2  # of the longest step: the far side then, where rounding no longer matters
_FAR_SIDE_ROWS = 0.5  # rows at most: not up to the next row
_BEYOND = (
    8.0  # times the expected way to a change point, which is an r-th of the way where r ranks are lost: twice for 4
)
_SEARCHED = 4.0  # times the way to the expected zero of a root: as far its least square is looked for
_SEARCHED_LEAST = 1e-13  # of a place on the path: the least way to search, some hundred roundings
_ACROSS = 2.0  # times the way to the zero of a root: a step that leads to the other side
_ACROSS_LEAST = 1e-12  # rows: the same, where the zero is as near as rounding


@njit(cache=True, error_model="numpy", _nrt=False)
def _square_at(
    program: Program, path: Reals, speeds: Reals, at: float, number: int, memory: PoseMemory, s: MotionScratch
) -> float:
    """The squared root of one dyad somewhere near the last pose; NaN where something before it cannot be placed."""
    set_drives(path, speeds, at, s)
    memory.roots[3, number] = np.nan
    verdict = try_pose(program, 0, at, memory, s)
    if verdict in (APPROACH, APART) and memory.which[0] == number:
        for operation in program.operations:
            if 2 <= operation[0] < GROUP and operation[9] == number:
                elements = ElementJets(s.points, s.lines, s.spins)
                return dyad_square(operation[0], elements, program.size, driven_arm(operation, program))
    return float(memory.roots[3, number] ** 2)  # it is known if only something behind it cannot be placed


@njit(cache=True, error_model="numpy", _nrt=False)
def _look_for_change(
    program: Program,
    path: Reals,
    speeds: Reals,
    reach: float,
    turn: float,
    number: int,
    memory: PoseMemory,
    s: MotionScratch,
) -> tuple[float, bool]:
    """Where the square of a small root is least ahead of the last pose, and the sign behind that place.

    If the least square is zero the root goes through zero (an exact change point) and changes its sign; if it is above
    zero the linkage only passes near one. If it is below zero, there is a limit: returns where the square is negative.
    """
    low, high = memory.at[0], reach
    inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_inner = _square_at(program, path, speeds, inner, number, memory, s)
    at_outer = _square_at(program, path, speeds, outer, number, memory, s)
    at, least = reach, np.inf  # the best so far: next to the zero dyads before this one may not be placed at all
    far, beyond = low, -np.inf  # the farthest place at which they are, and the square there
    for _ in range(_SECTIONS):
        if at_inner < least:
            at, least = inner, at_inner
        if at_outer < least:
            at, least = outer, at_outer
        if inner > far and not np.isnan(at_inner):
            far, beyond = inner, at_inner
        if outer > far and not np.isnan(at_outer):
            far, beyond = outer, at_outer
        if at_inner < -FLAT:
            return inner, True
        if at_outer < -FLAT:
            return outer, True
        if high - low < _NARROW * (reach - memory.at[0]) or high - low < _ROUNDING * (1 + abs(high)):
            break
        if not at_inner > at_outer:  # or one of them is NaN: what cannot be placed lies farther on
            high, outer, at_outer = outer, inner, at_inner
            inner = high - _GOLDEN * (high - low)
            at_inner = _square_at(program, path, speeds, inner, number, memory, s)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + _GOLDEN * (high - low)
            at_outer = _square_at(program, path, speeds, outer, number, memory, s)
    end = _square_at(program, path, speeds, reach, number, memory, s)
    if np.isnan(end):
        if beyond <= _RISEN * least + _NOISE:  # nothing is decided as far as anything is known
            return max(far, memory.at[0] + _KNOWN * (reach - memory.at[0])), False
    elif end <= _RISEN * least + _NOISE:  # still falling up to there: nothing is decided yet
        return reach if reach == turn else memory.at[0] + _FALLING * (reach - memory.at[0]), False
    memory.change[number] = at
    memory.after[number] = -memory.signs[number] if least < FLAT else memory.signs[number]
    return at, False


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _record(row: int, poses: PoseBuffer, memory: PoseMemory, s: MotionScratch) -> None:
    """Count whole turns, and write a row if it is one."""
    order = len(poses.rates)
    for link in range(len(s.turns)):
        turn, last = s.turns[link], s.last_turns[link]
        if (turn.imag < 0) != (last.imag < 0) and last.real * abs(turn.imag) + turn.real * abs(last.imag) < 0:
            s.whole_turns[link] += 1 if turn.imag < 0 else -1
        s.last_turns[link] = turn
        if row < 0:
            continue
        poses.turns[link, row] = turn
        poses.whole[link, row] = s.whole_turns[link]
        for k in range(order + 1):
            poses.places[k, link, row] = s.places[link, k]
        for k in range(order):
            poses.rates[k, link, row] = s.rates[link, k]
    if row >= 0:
        for m in range(len(poses.roots)):
            poses.roots[m, row] = memory.roots[3, m]
        for m in range(len(poses.unknowns)):
            poses.unknowns[m, row] = memory.unknowns[3, m]


@njit(cache=True, error_model="numpy", _nrt=False)
def _recall(row: int, poses: PoseBuffer, memory: PoseMemory, s: MotionScratch) -> None:
    """Remember the rows up to this one as if they had been walked."""
    memory.filled[0] = min(row + 1, 3)
    for k in range(memory.filled[0]):
        memory.at[k] = row - k
        for m in range(len(poses.roots)):
            memory.roots[k, m] = poses.roots[m, row - k]
    for link in range(len(s.last_turns)):
        s.last_turns[link] = poses.turns[link, row]
        s.whole_turns[link] = poses.whole[link, row]


@njit(cache=True, error_model="numpy", _nrt=False)
def _least_root(memory: PoseMemory) -> float:
    """The least of the roots, at most 1; 1 too if it is zero, since then nothing is lost."""
    least = 1.0
    for m in range(memory.roots.shape[1]):
        root = abs(memory.roots[0, m])
        if 0 < root < least:
            least = root
    return least


@njit(cache=True, error_model="numpy", _nrt=False)
def _expecting(memory: PoseMemory) -> bool:
    """Whether a root is going to be zero, or least, at a place that is known."""
    for change in memory.change:
        if change < np.inf:
            return True
    return False


@njit(cache=True, error_model="numpy", _nrt=False)
def _fill_fixed(placed: int, poses: PoseBuffer) -> None:
    """The links that nothing places rest, for a sweep."""
    for link in range(len(poses.turns)):
        if placed >> link & 1:
            continue
        poses.turns[link] = 1
        for k in range(len(poses.places)):
            poses.places[k, link] = 0
        for k in range(len(poses.rates)):
            poses.rates[k, link] = 0


def run_path(
    program: Program, path: Reals, speeds: Reals, signs: Reals, start: Reals, poses: PoseBuffer
) -> tuple[int, int, float, int]:
    """Move along the path.

    Args:
        program: the linkage.
        path: (rows, drives) drive values.
        speeds: (order, rows, drives) their time derivatives.
        signs: (dyads,) the signs of the assembly modes at the first row.
        start: (3 bodies and windings,) near the unknowns of larger groups at the first row.
        poses: written.

    Returns how it ended, how many rows are written, where on the path it stopped (in rows), and what is at fault: the
    number of the dyad, or -1 minus the number of the larger group.
    """
    memory = new_pose_memory(len(signs), len(start), len(program.conditions) - 1)
    s = new_motion_scratch(len(poses.turns), len(program.kinds), len(program.roots), path.shape[1])
    move = for_work(walk_path, walking(program, len(path), len(poses.rates)))
    return move(program, path, speeds, signs, start, poses, memory, s, np.zeros(REGISTERS))


@njit(cache=True, error_model="numpy", _nrt=False, nogil=True)
def walk_path(
    program: Program,
    path: Reals,
    speeds: Reals,
    signs: Reals,
    start: Reals,
    poses: PoseBuffer,
    memory: PoseMemory,
    s: MotionScratch,
    registers: Reals,
) -> tuple[int, int, float, int]:
    """`run_path` with arrays to work in."""
    memory.filled[0] = 0
    for k in range(len(signs)):
        memory.signs[k] = signs[k]
        memory.change[k] = memory.met[k] = np.nan
    memory.singular[0] = 0
    for k in range(len(start)):
        memory.unknowns[0, k] = start[k]
    order = len(poses.rates)
    set_drives(path, speeds, 0.0, s)
    verdict = try_pose(program, order, 0.0, memory, s)
    while verdict == MEET:
        _meet(program, path, speeds, 0.0, memory, s)
        set_drives(path, speeds, 0.0, s)
        verdict = try_pose(program, order, 0.0, memory, s)
    if verdict != GOOD:
        return START, 0, 0.0, memory.which[0] if verdict == APART else -1 - memory.which[0]
    for link in range(len(s.last_turns)):
        s.last_turns[link] = s.turns[link]
        s.whole_turns[link] = 0
    accept_pose(0.0, memory)
    _record(0, poses, memory, s)
    placed = swept_links(program) if len(path) > SWEPT_ROWS else 0
    if placed:
        _fill_fixed(placed, poses)
    row, pause = 1, 2
    step, fault = 1.0, np.inf
    while row < len(path):
        if placed and row >= pause and fault == np.inf and not _expecting(memory):
            reached = sweep(program, path, speeds, memory.signs, row, placed, poses, registers)
            pause = reached + _PAUSE
            if reached > row:
                row, step, pause = reached, 1.0, reached
                _recall(row - 1, poses, memory, s)
                continue
        status, at, step, fault, number = _walk_to(program, path, speeds, row, step, fault, poses, memory, s)
        if status != DONE:
            return status, row, at, number
        row += 1
    return DONE, row, float(row - 1), 0


@njit(cache=True, error_model="numpy", _nrt=False)
def _walk_to(
    program: Program,
    path: Reals,
    speeds: Reals,
    row: int,
    step: float,
    fault: float,
    poses: PoseBuffer,
    memory: PoseMemory,
    s: MotionScratch,
) -> tuple[int, float, float, float, int]:
    """From the last pose to a row, in as many steps as are needed.

    Returns the status, the place on the path, the next step, where ahead something cannot be assembled, and what.
    """
    unit = memory.unit[0] = _unit(program, path, row)
    at, longest = memory.at[0], min(1.0, unit)
    step = min(step, longest)  # it is measured in rows, and this row may be longer than the last one
    if not _remembered(path, row, memory):
        memory.filled[0] = 1
        step = min(step, _FIRST_STEP * unit * _least_root(memory))
    while at < row:
        left = row - at
        full = step >= left * (1 - _REACHED)
        trial = float(row) if full else at + step
        set_drives(path, speeds, trial, s)
        verdict = try_pose(program, len(poses.rates) if full else 0, trial, memory, s)
        if verdict == GOOD:
            number = _reversed(program, memory, s)
            if number >= 0:
                memory.change[number], memory.after[number] = at, -1.0 if memory.roots[3, number] > 0 else 1.0
                verdict = try_pose(program, len(poses.rates) if full else 0, trial, memory, s)
                if verdict != GOOD or _reversed(program, memory, s) >= 0:
                    return SINGULAR, at, step, fault, number
            accept_pose(trial, memory)
            _record(row if full else -1, poses, memory, s)
            at = trial
            if at >= fault:
                fault = np.inf
            step = min(2 * step, longest) if fault == np.inf else (fault - at) / 2
            if step < LEAST * (1 + abs(at)) and at < row:
                return LIMIT, at, step, fault, memory.which[0]
            continue
        number = memory.which[0]
        if verdict == APPROACH and abs(memory.roots[0, number]) < NEAR and fault == np.inf:
            step, fault = _approach(program, path, speeds, step, number, memory, s)
            continue
        if verdict == MEET:
            _meet(program, path, speeds, trial, memory, s)
            continue
        if verdict == APART:
            fault = min(fault, trial)
        step = min(step, left) / 2
        if verdict == LOST and _straight(number, program, memory):
            if _cross(program, path, speeds, row, number, poses, memory, s):
                at, step = memory.at[0], max(memory.at[0] - at, longest * _CROSSED)
                continue
        if step < LEAST * (1 + abs(at)):
            if verdict == LOST:
                return SINGULAR, at, step, fault, -1 - number
            return LIMIT, at, step, fault, number
    return DONE, at, step, fault, 0


@njit(cache=True, error_model="numpy", _nrt=False)
def _reversed(program: Program, memory: PoseMemory, s: MotionScratch) -> int:
    """The number of an RPR dyad near a change point that a step has turned by more than a right angle, or -1.

    Where its outer joints meet, their line reverses; the slide goes straight on, and it is the assembly mode that
    changes. Steps are too short for any other turn like that. A driven arm of an RRP that comes through the length 0
    reverses in the same way.
    """
    for operation in program.operations:
        if operation[0] == RPR or driven_arm(operation, program):
            number, body = operation[9], operation[7]
            if memory.change[number] < np.inf and memory.after[number] == memory.signs[number]:
                continue  # it has only passed near a change point, and may turn fast
            turn, last = s.turns[body], s.last_turns[body]
            if abs(memory.roots[3, number]) < NEAR and turn.real * last.real + turn.imag * last.imag < 0:
                return int(number)
    return -1


@njit(cache=True, error_model="numpy", _nrt=False)
def _remembered(path: Reals, row: int, memory: PoseMemory) -> bool:
    """Measure the past in the step to this row, on one straight line with it or back; false if it predicts nothing."""
    if row < 2:
        return False
    longest, ratio, off = 0.0, 0.0, 0.0
    for d in range(path.shape[1]):
        past = path[row - 1, d] - path[row - 2, d]
        if abs(past) > longest:
            longest, ratio = abs(past), (path[row, d] - path[row - 1, d]) / past
    for d in range(path.shape[1]):
        change, past = path[row, d] - path[row - 1, d], path[row - 1, d] - path[row - 2, d]
        off = max(off, abs(change - ratio * past))
    if ratio == 0 or off > _IN_LINE * longest:
        return steady(path, row)
    for k in range(memory.filled[0]):
        memory.at[k] = row - 1 + (memory.at[k] - (row - 1)) / ratio
    if memory.filled[0] > 1 and (memory.at[0] > row or (memory.at[0] < row - 1 and ratio < 0)):
        forget_poses(memory)  # a pose behind a change point, where this way does not come from or lead to
    return True


@njit(cache=True, error_model="numpy", _nrt=False)
def _unit(program: Program, path: Reals, row: int) -> float:
    """The longest step of the drives, in rows, on the way to a row."""
    longest = _LONGEST_STEP
    for d in range(path.shape[1]):
        change = abs(path[row, d] - path[row - 1, d])
        if change * longest > program.most[d]:
            longest = program.most[d] / change
    return longest


@njit(cache=True, error_model="numpy", _nrt=False)
def _meet(program: Program, path: Reals, speeds: Reals, at: float, memory: PoseMemory, s: MotionScratch) -> None:
    """Find the direction of a dyad whose outer joints meet, from poses shortly before (at the start: after) it."""
    number, body = memory.which[0], 0
    for operation in program.operations:
        if 2 <= operation[0] < GROUP and operation[9] == number:
            body = operation[7]
    turn = 0j
    for k in range(3):
        if len(path) > 1:
            row = max(1, int(np.ceil(at)))
            step = min(_BEFORE_MEETING_ROWS, _BEFORE_MEETING * _unit(program, path, row)) * (k + 1)
            place = at + step if at < 1 and at - step < 0 else at - step
            set_drives(path, speeds, place, s)
            if try_pose(program, 0, place, memory, s) == GOOD:
                turn += _EXTRAPOLATION[k] * s.turns[body]
                continue
        turn = s.last_turns[body] if at > 0 else 1 + 0j
        break
    memory.direction[number] = turn / abs(turn)
    memory.met[number] = at


@njit(cache=True, error_model="numpy", _nrt=False)
def _straight(number: int, program: Program, memory: PoseMemory) -> bool:
    """Whether a larger group comes straight to a singular position: then it is a change point, else a limit.

    At a limit the rates of the unknowns grow as the determinant falls, one over the other; at a change point they stay.
    """
    if memory.filled[0] < 3 or not _SINGULAR_FROM < zero_ahead(number, memory) / memory.unit[0] < _SINGULAR_TO:
        return False
    t, y, d = memory.at, memory.unknowns, memory.determinants
    growth = (d[2, number] - d[0, number]) / (d[0, number] + d[1, number])
    bend = slope = 0.0
    for k in range(3 * program.bodies[number], 3 * program.bodies[number + 1]):
        scale = program.size if k % 3 == 2 else 1.0
        late, early = (y[0, k] - y[1, k]) / (t[0] - t[1]), (y[1, k] - y[2, k]) / (t[1] - t[2])
        bend, slope = max(bend, scale * abs(late - early)), max(slope, scale * abs(early))
    straight: bool = growth > _GROWTH and bend < _STEADY_RATES * growth * slope
    return straight


@njit(cache=True, error_model="numpy", _nrt=False)
def _cross(
    program: Program,
    path: Reals,
    speeds: Reals,
    row: int,
    number: int,
    poses: PoseBuffer,
    memory: PoseMemory,
    s: MotionScratch,
) -> bool:
    """Go straight through a change point of a larger group; a row that lies in it is placed between both sides."""
    at, unit, order = memory.at[0], memory.unit[0], len(poses.rates)
    ahead, left = zero_ahead(number, memory), row - at
    inside = left < _AROUND * ahead
    if inside and ahead > _BOTH_SIDES * unit:
        return False
    beyond = row + min(_FAR_SIDE * unit, _FAR_SIDE_ROWS) if inside else min(at + _BEYOND * ahead, float(row))
    full = beyond == row
    memory.singular[0] = 1 + number
    if inside:
        for d in range(path.shape[1]):
            s.drives[0, d] = path[row, d] + (beyond - row) * (path[row, d] - path[row - 1, d])
    else:
        set_drives(path, speeds, beyond, s)
    verdict = try_pose(program, order if full else 0, beyond, memory, s)
    memory.singular[0] = 0
    if verdict == GOOD:
        accept_pose(beyond, memory)
        if not inside:
            _record(row if full else -1, poses, memory, s)
            return True
    elif not inside or row < len(path) - 1:
        return False
    memory.singular[0] = -1 - number
    set_drives(path, speeds, float(row), s)
    verdict = try_pose(program, order, float(row), memory, s)
    memory.singular[0] = 0
    if verdict != GOOD:
        return False
    if memory.at[0] < row:
        accept_pose(float(row), memory)
    _record(row, poses, memory, s)
    return True


@njit(cache=True, error_model="numpy", _nrt=False)
def _turn_ahead(path: Reals, at: float, reach: float) -> float:
    """The first row ahead at which the drives turn back or rest, or the last one, as far as the reach needs it.

    Behind it a root comes to the same change point once more, and its square has a second least value there.
    """
    row = int(np.floor(at)) + 1
    while row < len(path) - 1 and row < reach:
        forth = 0.0
        for d in range(path.shape[1]):
            forth += (path[row + 1, d] - path[row, d]) * (path[row, d] - path[row - 1, d])
        if forth <= 0:
            return float(row)
        row += 1
    return float(len(path) - 1)


@njit(cache=True, error_model="numpy", _nrt=False)
def _approach(
    program: Program, path: Reals, speeds: Reals, step: float, number: int, memory: PoseMemory, s: MotionScratch
) -> tuple[float, float]:
    """A small root that falls: look ahead for the place where it is least. Returns the next step and fault."""
    at, now, past = memory.at[0], memory.roots[0, number], memory.roots[1, number]
    slope = (now - past) / (at - memory.at[1])
    ahead = abs(now / slope) if slope != 0 else step
    memory.change[number] = np.nan
    turn = _turn_ahead(path, at, at + _SEARCHED * ahead)
    if now * now < _NOISE and at + ahead < turn:  # an exact change point: squares do not tell its place
        memory.change[number], memory.after[number] = at + ahead, -memory.signs[number]
        return max(_ACROSS * ahead, _ACROSS_LEAST), np.inf
    reach = min(at + max(_SEARCHED * ahead, _SEARCHED_LEAST * (1 + at)), turn)
    place, negative = _look_for_change(program, path, speeds, reach, turn, number, memory, s)
    if negative:
        return place - at, place
    if not np.isnan(memory.change[number]):
        return max(_ACROSS * (place - at), _ACROSS_LEAST), np.inf
    memory.change[number] = place  # falling all the way: as it was, up to there and no further
    memory.after[number] = 0
    return place - at, np.inf
