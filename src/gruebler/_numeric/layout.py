"""Kernels for layouts of points and segments in the plane; see docs/theory/drawing.md.

A layout is float64[n, 2]. Segments are int64[m, 2] of points, watched pairs int64[k, 2] of (segment, point) whose
distance must not vanish.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gruebler._numeric.compiling import njit
from gruebler._numeric.lanes import give_back, taken

_SMALLEST = 1e-12


@njit(cache=True)
def _offset(x: Any, a: int, b: int, p: int) -> tuple[float, float, float]:
    """The place t in [0, 1] on the segment that is nearest to the point, and the vector from there to the point."""
    start, end, point = x[a], x[b], x[p]
    ux, uy = end[0] - start[0], end[1] - start[1]
    wx, wy = point[0] - start[0], point[1] - start[1]
    square = ux * ux + uy * uy
    t = 0.0 if square == 0.0 else (ux * wx + uy * wy) / square
    t = min(1.0, max(0.0, t))
    return t, wx - t * ux, wy - t * uy


@njit(cache=True)
def _forces(x: Any, segments: Any, pull: Any, watched: Any, power: float, slope: Any, room: Any) -> float:
    """Energy, its gradient, and for every point how far it may go; energy = sum pull |s|^2 + sum d^-power."""
    for p in range(len(x)):
        slope[p][0] = slope[p][1] = 0.0
        room[p] = np.inf
    energy = 0.0
    for k in range(len(segments)):
        a, b = segments[k][0], segments[k][1]
        ux, uy = x[b][0] - x[a][0], x[b][1] - x[a][1]
        energy += pull[k] * (ux * ux + uy * uy)
        slope[a][0] -= 2.0 * pull[k] * ux
        slope[a][1] -= 2.0 * pull[k] * uy
        slope[b][0] += 2.0 * pull[k] * ux
        slope[b][1] += 2.0 * pull[k] * uy
    for k in range(len(watched)):
        number, p = watched[k][0], watched[k][1]
        a, b = segments[number][0], segments[number][1]
        t, dx, dy = _offset(x, a, b, p)
        d = max(math.sqrt(dx * dx + dy * dy), _SMALLEST)
        step = d / 3.0
        room[a] = min(room[a], step)
        room[b] = min(room[b], step)
        room[p] = min(room[p], step)
        value = d**-power
        energy += value
        push = power * value / (d * d)
        slope[p][0] -= push * dx
        slope[p][1] -= push * dy
        slope[a][0] += (1.0 - t) * push * dx
        slope[a][1] += (1.0 - t) * push * dy
        slope[b][0] += t * push * dx
        slope[b][1] += t * push * dy
    return energy


@njit(cache=True)
def symmetrise(x: Any, images: Any, turns: Any, symmetric: Any) -> None:
    """The mean of the layout over a group: point p goes to images[g, p] as the plane moves by turns[g]."""
    for p in range(len(x)):
        symmetric[p][0] = symmetric[p][1] = 0.0
    for g in range(len(images)):
        turn = turns[g]
        for p in range(len(x)):
            image = x[images[g][p]]
            symmetric[p][0] += turn[0][0] * image[0] + turn[1][0] * image[1]
            symmetric[p][1] += turn[0][1] * image[0] + turn[1][1] * image[1]
    for p in range(len(x)):
        symmetric[p][0] /= len(images)
        symmetric[p][1] /= len(images)


@njit(cache=True)
def relax(
    layout: NDArray[np.float64],
    segments: NDArray[np.int64],
    pull: NDArray[np.float64],
    watched: NDArray[np.int64],
    images: NDArray[np.int64],
    turns: NDArray[np.float64],
    power: float,
    rounds: int,
) -> float:
    """Lower the energy in place by steps so short that no watched point can pass its segment; returns the energy.

    Descent with momentum; a step that raises the energy is taken back, its length halved.
    """
    n = len(layout)
    x, bars, pulls, pairs, group, plane = (
        taken(layout), taken(segments), taken(pull), taken(watched), taken(images), taken(turns),
    )  # fmt: skip
    slope, fresh = taken(np.empty((n, 2))), taken(np.empty((n, 2)))
    room, new_room = taken(np.empty(n)), taken(np.empty(n))
    move, trial, mean = taken(np.zeros((n, 2))), taken(np.empty((n, 2))), taken(np.empty((n, 2)))
    energy = _forces(x, bars, pulls, pairs, power, slope, room)
    length = 0.05
    keep = 0.0
    for _ in range(rounds):
        for p in range(n):
            for c in range(2):
                move[p][c] = keep * move[p][c] - length * slope[p][c]
            size = math.sqrt(move[p][0] ** 2 + move[p][1] ** 2)
            if size > room[p]:
                move[p][0] *= room[p] / size
                move[p][1] *= room[p] / size
            trial[p][0] = x[p][0] + move[p][0]
            trial[p][1] = x[p][1] + move[p][1]
        if len(group) > 1:
            symmetrise(trial, group, plane, mean)
            trial, mean = mean, trial
        value = _forces(trial, bars, pulls, pairs, power, fresh, new_room)
        if value <= energy:
            done = energy - value <= 1e-7 * value and keep > 0.0
            for p in range(n):
                x[p][0], x[p][1] = trial[p][0], trial[p][1]
            slope, fresh = fresh, slope
            room, new_room = new_room, room
            energy = value
            length *= 1.3
            keep = 0.8
            if done:
                break
        else:
            for p in range(n):
                move[p][0] = move[p][1] = 0.0
            keep = 0.0
            length *= 0.4
            if length < 1e-14:
                break
    give_back(layout, x)
    return energy


@njit(cache=True)
def closest(x: NDArray[np.float64], segments: NDArray[np.int64], watched: NDArray[np.int64]) -> float:
    """The smallest distance of a watched pair."""
    best = np.inf
    for k in range(len(watched)):
        s = watched[k, 0]
        _, dx, dy = _offset(x, segments[s, 0], segments[s, 1], watched[k, 1])
        best = min(best, dx * dx + dy * dy)
    return math.sqrt(best)


@njit(cache=True)
def _side(x: NDArray[np.float64], a: int, b: int, c: int) -> float:
    side: float = (x[b, 0] - x[a, 0]) * (x[c, 1] - x[a, 1]) - (x[b, 1] - x[a, 1]) * (x[c, 0] - x[a, 0])
    return side


@njit(cache=True)
def crossing_segments(x: NDArray[np.float64], segments: NDArray[np.int64]) -> NDArray[np.int64]:
    """int64[k, 2]: the pairs of segments without common point that cross."""
    pairs = np.empty((len(segments) * (len(segments) - 1) // 2, 2), np.int64)
    number = 0
    for i in range(len(segments)):
        a, b = segments[i, 0], segments[i, 1]
        for j in range(i):
            c, d = segments[j, 0], segments[j, 1]
            if a == c or a == d or b == c or b == d:
                continue
            if _side(x, a, b, c) * _side(x, a, b, d) < 0.0 and _side(x, c, d, a) * _side(x, c, d, b) < 0.0:
                pairs[number, 0], pairs[number, 1] = j, i
                number += 1
    return pairs[:number]
