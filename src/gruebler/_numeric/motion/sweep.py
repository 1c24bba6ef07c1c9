"""Many rows of a motion at once: what drives and dyads place.

A sweep does for a block of rows what a walk does for one, operation by operation, in loops without branches (`lanes`).
It makes no decisions: it tells how many of its rows may be trusted, by the same checks as the walk, and the walk goes
on from there. docs/theory/kinematics.md has the equations.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.lanes import lanes, square_root, tally
from gruebler._numeric.motion.program import EXPECTED, KEPT, NEAR, RPR, RRP, RRR, TURN, PoseBuffer, Program
from gruebler._numeric.motion.registers import (
    LANES,
    PAIR,
    ROOT,
    A,
    B,
    D,
    E,
    P,
    Q,
    T,
    U,
    V,
    W,
    circle,
    copy,
    load_register,
    point,
    put,
    rotate,
)

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]

SWEPT_ROWS = 8  # for fewer rows a sweep does not pay
_FASTER = 1.5  # times the last change of a drive: after a larger one the past predicts nothing


@njit(cache=True, error_model="numpy", _nrt=False)
def swept_links(program: Program) -> int:
    """The links that a sweep places, as bits; 0 if it cannot.

    It can if there are only turning drives between placed links, and dyads of two links: RRR, RPR, RRP on the frame.
    """
    if len(program.kinds) > 0:
        return 0
    for link in program.links:
        if link > 62:
            return 0
    placed = 0
    for operation in program.operations:
        kind = operation[0]
        if kind == TURN:
            placed |= 1 << program.links[operation[3]]
            continue
        if kind not in (RRR, RRP, RPR):
            return 0
        body_a, body_b = operation[7], operation[8]
        for slot in range(4):
            if program.links[operation[2 + slot]] != (body_a if slot < 2 else body_b):
                return 0
        if kind == RRP and placed & (1 << program.links[operation[6]]):
            return 0
        placed |= (1 << body_a) | (1 << body_b)
    return placed


@njit(cache=True, error_model="numpy", _nrt=False)
def _drive(
    order: int,
    link: int,
    d: int,
    sign: float,
    path: Reals,
    speeds: Reals,
    poses: PoseBuffer,
    row: int,
    end: int,
    x: Reals,
) -> None:
    """The turn and the rates of a link driven against another."""
    drives = path[row:end]
    for i in lanes(len(drives)):
        x[E + i] = sign * drives[i, d]
    circle(x)
    load_register(poses.turns[link, row:end], x, E)
    for i in lanes(LANES):
        c, s = x[A + i], x[A + LANES + i]
        a, b = x[E + i], x[E + LANES + i]
        x[T + i] = a * c - b * s
        x[T + LANES + i] = a * s + b * c
    for k in range(order):
        rates, fast = poses.rates[k, link, row:end], speeds[k, row:end]
        for i in lanes(len(rates)):
            x[V + k * LANES + i] = rates[i] + sign * fast[i, d]


@njit(cache=True, error_model="numpy", _nrt=False)
def _rrr(order: int, sign: float, first: complex, second: complex, x: Reals) -> None:
    """Turns and rates of both bodies from P and Q; `first` and `second` are their vectors from outer to inner joint."""
    l1, l2 = first.real**2 + first.imag**2, second.real**2 + second.imag**2
    area, scale = sign * sqrt(l1) * sqrt(l2), 1 / l1 / l2
    for i in lanes(LANES):
        dx, dy = x[Q + i] - x[P + i], x[Q + LANES + i] - x[P + LANES + i]
        d = dx * dx + dy * dy
        m = (d + l1 - l2) / 2
        root = square_root((l1 * d - m * m) * scale)
        x[ROOT + i] = sign * root
        inverse = 1 / d
        along, across = m * inverse, area * root * inverse
        x[A + i] = ax = dx * along - dy * across
        x[A + LANES + i] = ay = dx * across + dy * along
        x[B + i] = ax - dx
        x[B + LANES + i] = ay - dy
    rotate(x, A, complex(first.real / l1, -first.imag / l1), T)
    rotate(x, B, complex(second.real / l2, -second.imag / l2), U)
    if order >= 1:
        for i in lanes(LANES):
            ax, ay, bx, by = x[A + i], x[A + LANES + i], x[B + i], x[B + LANES + i]
            x[D + i] = d = 1 / (ax * by - ay * bx)
            tx, ty = x[Q + PAIR + i] - x[P + PAIR + i], x[Q + PAIR + LANES + i] - x[P + PAIR + LANES + i]
            x[V + i] = (tx * bx + ty * by) * d
            x[W + i] = (tx * ax + ty * ay) * d
    if order >= 2:
        for i in lanes(LANES):
            ax, ay, bx, by = x[A + i], x[A + LANES + i], x[B + i], x[B + LANES + i]
            v, w, d = x[V + i] ** 2, x[W + i] ** 2, x[D + i]
            tx = x[Q + 2 * PAIR + i] - x[P + 2 * PAIR + i] + v * ax - w * bx
            ty = x[Q + 2 * PAIR + LANES + i] - x[P + 2 * PAIR + LANES + i] + v * ay - w * by
            x[V + LANES + i] = (tx * bx + ty * by) * d
            x[W + LANES + i] = (tx * ax + ty * ay) * d
    if order >= 3:
        for i in lanes(LANES):
            ax, ay, bx, by = x[A + i], x[A + LANES + i], x[B + i], x[B + LANES + i]
            v, w, d = x[V + i], x[W + i], x[D + i]
            v1, w1, v2, w2 = v * v * v, w * w * w, 3 * v * x[V + LANES + i], 3 * w * x[W + LANES + i]
            tx = x[Q + 3 * PAIR + i] - x[P + 3 * PAIR + i] + v2 * ax - w2 * bx - v1 * ay + w1 * by
            ty = x[Q + 3 * PAIR + LANES + i] - x[P + 3 * PAIR + LANES + i]
            ty += v2 * ay - w2 * by + v1 * ax - w1 * bx
            x[V + 2 * LANES + i] = (tx * bx + ty * by) * d
            x[W + 2 * LANES + i] = (tx * ax + ty * ay) * d


@njit(cache=True, error_model="numpy", _nrt=False)
def _rpr(order: int, sign: float, lines: tuple[complex, complex], off: float, size: float, x: Reals) -> None:
    """Both bodies turn with the slide: Q - P = slide * (way + i off)."""
    for i in lanes(LANES):
        dx, dy = x[Q + i] - x[P + i], x[Q + LANES + i] - x[P + LANES + i]
        d = dx * dx + dy * dy
        travel = sign * square_root(d - off * off)
        x[ROOT + i], x[D + i] = travel / size, 1 / travel
        x[A + i], x[A + LANES + i] = (dx * travel + dy * off) / d, (dy * travel - dx * off) / d
    rotate(x, A, lines[0].conjugate(), T)
    rotate(x, A, lines[1].conjugate(), U)
    for k in range(order):
        for i in lanes(LANES):
            dx = x[Q + (k + 1) * PAIR + i] - x[P + (k + 1) * PAIR + i]
            dy = x[Q + (k + 1) * PAIR + LANES + i] - x[P + (k + 1) * PAIR + LANES + i]
            along, across = x[A + i] * dx + x[A + LANES + i] * dy, x[A + i] * dy - x[A + LANES + i] * dx
            x[E + i], x[E + LANES + i] = along, across
        for i in lanes(LANES):
            along, across, d = x[E + i], x[E + LANES + i], x[D + i]
            if k == 0:
                w = across * d
                x[V + i], x[B + i] = w, along + w * off
            elif k == 1:
                w, travel1 = x[V + i], x[B + i]
                a = (across + w * w * off - 2 * w * travel1) * d
                x[V + LANES + i], x[B + LANES + i] = a, along + a * off + w * w / d
            else:
                w, a, travel1, travel2 = x[V + i], x[V + LANES + i], x[B + i], x[B + LANES + i]
                x[V + 2 * LANES + i] = (across + 3 * (w * a * off - a * travel1 - w * travel2)) * d + w * w * w
        for i in lanes(LANES):
            x[W + k * LANES + i] = x[V + k * LANES + i]


@njit(cache=True, error_model="numpy", _nrt=False)
def _rrp(order: int, sign: float, line: complex, first: complex, second: complex, turn: complex, x: Reals) -> None:
    """The second body slides along a line of the frame; Q is moved along to its point."""
    length = sqrt(first.real**2 + first.imag**2)
    u, v = line.real, line.imag
    for i in lanes(LANES):
        rx, ry = x[Q + i] + second.real - x[P + i], x[Q + LANES + i] + second.imag - x[P + LANES + i]
        across = (u * ry - v * rx) / length
        root = sign * square_root(1 - across * across)
        travel = root * length - u * rx - v * ry
        x[ROOT + i], x[D + i] = root, 1 / (root * length)
        x[A + i], x[A + LANES + i] = rx + travel * u, ry + travel * v
        x[Q + i] += travel * u
        x[Q + LANES + i] += travel * v
        x[U + i], x[U + LANES + i] = turn.real, turn.imag
    square = length * length
    rotate(x, A, complex(first.real / square, -first.imag / square), T)
    for k in range(order):
        for i in lanes(LANES):
            px, py = x[P + (k + 1) * PAIR + i], x[P + (k + 1) * PAIR + LANES + i]
            x[E + i], x[E + LANES + i] = u * px + v * py, u * py - v * px
        for i in lanes(LANES):
            ax, ay = x[A + i], x[A + LANES + i]
            d, along, across = x[D + i], u * ax + v * ay, u * ay - v * ax
            w, a, spin, push = x[V + i], x[V + LANES + i], x[E + LANES + i], x[E + i]
            if k == 0:
                spin = -spin * d
                push -= spin * across
            elif k == 1:
                spin = (w * w * across - spin) * d
                push -= spin * across + w * w * along
            else:
                spin = (3 * w * a * across - spin) * d + w * w * w
                push -= (spin - w * w * w) * across + 3 * w * a * along
            x[V + k * LANES + i], x[W + k * LANES + i] = spin, 0
            x[Q + (k + 1) * PAIR + i] += push * u
            x[Q + (k + 1) * PAIR + LANES + i] += push * v


@njit(cache=True, error_model="numpy", _nrt=False)
def _dyad(order: int, operation: Ints, program: Program, sign: float, x: Reals) -> None:
    p = program.points
    q1, q2, q3, q4 = p[operation[2]], p[operation[3]], p[operation[4]], p[operation[5]]
    lines = program.lines
    if operation[0] == RRR:
        _rrr(order, sign, q2 - q1, q3 - q4, x)
    elif operation[0] == RPR:
        line1, line2 = lines[operation[3]], lines[operation[4]]
        off = (line2.conjugate() * (q4 - q3)).imag - (line1.conjugate() * (q1 - q2)).imag
        _rpr(order, sign, (line1, line2), off, program.size, x)
    else:
        line = lines[operation[6]]
        turn = line * lines[operation[5]].conjugate()
        _rrp(order, sign, line, q2 - q1, turn * (q3 - q4), turn, x)


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def _goes_on(root: float, last: float, before: float) -> bool:
    """Whether a root is not small, and does not change too much."""
    now, past = abs(root), abs(last)
    return (now > NEAR) & (now > KEPT * past) & ((2 - EXPECTED) * past >= abs(before))


@njit(cache=True, error_model="numpy", _nrt=False)
def _trusted(roots: Reals, row: int, end: int) -> int:
    """The first row from `row` on whose root does not go on."""
    now, last, before = roots[row:end], roots[row - 1 : end - 1], roots[row - 2 : end - 2]
    good = 0
    for i in lanes(len(now)):
        good += tally(_goes_on(now[i], last[i], before[i]))
    if good == len(now):
        return end
    for i in range(len(now)):
        if not _goes_on(now[i], last[i], before[i]):
            return row + i
    return end


@njit(cache=True, error_model="numpy", forceinline=True, _nrt=False)
def steady(path: Reals, row: int) -> bool:
    """Whether the drives go on to a row as they came, not back and not much faster: then the past predicts."""
    if row < 2:
        return False
    moved = False
    for d in range(path.shape[1]):
        change, past = path[row, d] - path[row - 1, d], path[row - 1, d] - path[row - 2, d]
        if change * past < 0 or abs(change) > _FASTER * abs(past):
            return False
        moved |= change != 0
    return moved


@njit(cache=True, error_model="numpy", _nrt=False)
def _near(path: Reals, most: Reals, row: int, end: int) -> int:
    """The first row from `row` on that is too far from the one before, or not in line."""
    if row < 2:
        return row
    now, last, before = path[row:end], path[row - 1 : end - 1], path[row - 2 : end - 2]
    near = moving = 0
    for d in range(len(most)):
        moved = 0
        for i in lanes(len(now)):
            change, past = now[i, d] - last[i, d], last[i, d] - before[i, d]
            near += tally((change * past >= 0) & (abs(change) <= _FASTER * abs(past)) & (abs(change) <= most[d]))
            moved += tally(change != 0)
        moving = max(moving, moved)
    if near == len(now) * len(most) and moving == len(now):
        return end
    for r in range(row, end):
        if not steady(path, r):
            return r
        for d in range(len(most)):
            if not abs(path[r, d] - path[r - 1, d]) <= most[d]:
                return r
    return end


@njit(cache=True, error_model="numpy", _nrt=False)
def _count_turns(turns: Complexes, whole: NDArray[np.int32], row: int, end: int) -> None:
    """Whole turns: the negative x axis is crossed upwards or downwards. They are 0 already."""
    now, last, counts = turns[row:end], turns[row - 1 : end - 1], whole[row:end]
    crossed = 0
    for i in lanes(len(now)):
        crossed += tally(((now[i].imag < 0) != (last[i].imag < 0)) & (now[i].real + last[i].real < 0))
    count = whole[row - 1]
    if crossed == 0:
        if count != 0:
            for i in range(len(counts)):
                counts[i] = count
        return
    for i in range(len(now)):
        a, b = now[i], last[i]
        if (a.imag < 0) != (b.imag < 0) and b.real * abs(a.imag) + a.real * abs(b.imag) < 0:
            count += 1 if a.imag < 0 else -1
        counts[i] = count


@njit(cache=True, error_model="numpy", _nrt=False)
def sweep(
    program: Program, path: Reals, speeds: Reals, signs: Reals, row: int, placed: int, poses: PoseBuffer, x: Reals
) -> int:
    """Place everything at up to `LANES` rows from `row` on; returns the first row that is not to be trusted.

    The row before is known, links that are not in `placed` rest. Rows from the returned one on mean nothing.
    """
    end = _near(path, program.most, row, min(row + LANES, len(path)))
    if end == row:
        return row
    order, good = len(poses.rates), end
    for operation in program.operations:
        if operation[0] == TURN:
            near, other = operation[2], operation[3]
            link, far, d, sign = program.links[near], program.links[other], operation[1], operation[4]
            point(order, link, program.points[near], not placed >> link & 1, poses, row, end, x, P)
            _drive(order, link, d, float(sign), path, speeds, poses, row, end, x)
            put(order, far, program.points[other], True, poses, row, end, x)
            continue
        for slot, to in ((0, P), (5, Q)):
            e = operation[1 + slot]
            link = program.links[e]
            point(order, link, program.points[e], not placed >> link & 1, poses, row, end, x, to)
        number = operation[9]
        _dyad(order, operation, program, signs[number], x)
        copy(x[ROOT : ROOT + LANES], poses.roots[number, row:end])
        good = _trusted(poses.roots[number], row, good)
        put(order, operation[7], program.points[operation[2]], True, poses, row, end, x)
        put(order, operation[8], program.points[operation[5]], False, poses, row, end, x)
    for link in range(len(poses.turns)):
        if placed >> link & 1:
            _count_turns(poses.turns[link], poses.whole[link], row, good)
    return good
