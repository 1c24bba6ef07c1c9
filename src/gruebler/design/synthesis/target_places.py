"""Where a circuit meets targets: exactly, or as near as it comes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Integers, Reals
from gruebler.design.synthesis.ordered_matching import OrderedMatch, SmoothCurve, TargetDistances, preferred
from gruebler.design.synthesis.ordered_places import Places, lap_about, with_free
from gruebler.design.synthesis.targets import Targets
from gruebler.mechanics.kinematics import Circuit, Poses

_REFINEMENTS = 8
_ARRIVED = 1e-15  # of the length: steps as short as rounding
_BENDS = 1e-7  # of the length: the slope over shorter steps is rounding
_SHARPENINGS = 3
_OF_CURVE = 1e-8  # of the size: how far a circuit lies from the polynomials between its samples
_INSIDE = 1e-6  # of the length: `move` cannot be led to a limit of the drive itself

Piece = tuple[float, float] | None
"""From which arc of a circuit to which; None for a whole closed circuit, from any start."""


class TargetPlaces(NamedTuple):
    """Where a circuit meets the targets."""

    places: Places
    error: float
    """The largest over the targets of the smallest deviation, relative to the size."""
    in_order: Callable[[Piece], OrderedMatch | None]
    """The best match in order on a piece of the circuit, its error relative to the size."""
    ordered: bool = True
    """False if no match in order exists on the whole circuit; True where one is approached."""


def places_met(course: Circuit, targets: Targets, limit: float) -> TargetPlaces:
    """Where the circuit meets each target exactly: zeros of the derivative of the squared distance, refined."""
    samples, count = course.samples, len(targets.values)
    gaps, rates = _against_all(samples, targets)
    square = np.sum(np.abs(gaps) ** 2, axis=2)
    slope = np.sum(np.real(np.conj(gaps) * rates), axis=2)
    target, segment = np.nonzero((slope[:, :-1] <= 0) & (slope[:, 1:] >= 0))
    arcs = course.arcs
    low, high = arcs[segment], arcs[segment + 1]
    falls, rises = -slope[target, segment], slope[target, segment + 1]
    speed = np.sqrt(np.sum(np.abs(rates[target, segment]) ** 2, axis=1))
    near = np.sqrt(np.minimum(square[target, segment], square[target, segment + 1]))
    nearest = np.full(count, np.inf)
    np.minimum.at(nearest, target, near)
    # Of a target that is missed the nearest place is refined all the same: the verdict says how near it is.
    keep = near <= np.maximum(2 * (high - low) * speed + 2e-3 * targets.size, nearest[target])
    target, low, high, falls, rises = (v[keep] for v in (target, low, high, falls, rises))
    with np.errstate(invalid="ignore", divide="ignore"):
        at = low + (high - low) * np.nan_to_num(falls / (falls + rises), nan=0.5)
    at = _refined(course, targets, target, at, (low, high))
    ends = np.full(len(at), np.inf)
    if len(at):
        gap, _ = targets.gaps(course.at(at), target)
        ends = np.sqrt(np.sum(np.abs(gap) ** 2, axis=1)) / targets.size
    found_at, error = [], 0.0
    for k in range(count):
        of_target = target == k
        # Where an open or closed circuit begins exactly at a target, both ends of it are looked at too.
        border = np.sqrt(square[k, [0, -1]]) / targets.size
        all_arcs = np.concatenate([at[of_target], arcs[[0, -1]]])
        misses = np.concatenate([ends[of_target], border])
        error = max(error, min(float(misses.min()), float(np.sqrt(square[k].min())) / targets.size))
        found_at.append(_distinct(np.sort(all_arcs[misses <= limit]), course))
    places = Places.of_points(found_at, course.length, closed=course.closed)
    order, laps = targets.order, course.length * np.arange(-2, 3) if course.closed else np.zeros(1)

    def in_order(piece: Piece) -> OrderedMatch | None:
        matches = []
        for arcs in places.matches(piece, groups=order.groups):
            window = piece or lap_about(arcs, course.length)
            free = [(places.best_of_each[k][:, None] + laps).ravel() for k in order.free]
            most = course.length if piece is None else np.inf
            if (whole := with_free(arcs, order.free, free, window, most)) is not None:
                matches.append(OrderedMatch(0.0, 0.0, whole))
        return preferred(matches, 1.0) if matches else None

    whole = None if course.closed else (0.0, course.length)
    return TargetPlaces(places, error, in_order, not places.empty and in_order(whole) is not None)


def _refined(course: Circuit, targets: Targets, target: Integers, at: Reals, within: tuple[Reals, Reals]) -> Reals:
    """Arcs near which targets are nearest, put right by steps of Newton's method, within bounds."""
    moved, level = np.zeros(len(at)), np.zeros(len(at))
    for _ in range(_REFINEMENTS if len(at) else 0):
        gap, rate = targets.gaps(course.at(at), target)
        before, level = level, np.sum(np.real(np.conj(gap) * rate), axis=1)
        bend = np.sum(np.abs(rate) ** 2, axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            secant = (level - before) / moved
            # Far from a target the curve bends towards it or away from it: its distance grows otherwise than its way.
            bend = np.where((np.abs(moved) > _BENDS * course.length) & (secant > 0), secant, bend)
            step = np.clip(at - np.nan_to_num(level / bend), *within) - at
        moved, at = step, at + step
        if np.abs(moved).max() <= _ARRIVED * course.length:
            break
    return at


def places_approached(course: Circuit, targets: Targets, limit: float, *, in_order: bool = True) -> TargetPlaces:
    """Where the circuit comes near the targets; in order, so that the farthest of them is as near as possible.

    Where each can be met within its own tolerance, it is; in order only if that is asked.
    """
    size, order = targets.size, targets.order
    arcs = np.insert(course.arcs, slice(1, None), (course.arcs[:-1] + course.arcs[1:]) / 2)
    poses = course.at(arcs)
    values, rates = (np.stack([probe.value(poses, n) for probe in targets.probes], axis=1) for n in (0, 1))
    distances = TargetDistances(SmoothCurve(arcs, values, rates, course.closed), targets.values, size)

    most = None if targets.allowed is None else size * np.minimum(np.maximum(targets.allowed, _OF_CURVE), limit)
    whole = None if course.closed else (0.0, course.length)
    if most is not None:
        within = distances.within(whole, order, most) if in_order else bool((distances.nearest <= most).all())
        most = most if within else None

    def best_in_order(piece: Piece) -> OrderedMatch | None:
        if most is not None and not distances.within(piece, order, most):
            return None
        match = distances.best_in_order(piece, order, most)
        arcs = _sharpened(course, targets, distances, match.arcs, piece)
        return OrderedMatch(match.error / size, match.mean / size, arcs)

    places = _exactly_met(course, targets, distances.places(limit * size if most is None else most))
    return TargetPlaces(places, float(distances.nearest.max()) / size, best_in_order)


def _exactly_met(course: Circuit, targets: Targets, places: Places) -> Places:
    """Places whose best ones of targets without tolerance are put right by the circuit itself."""
    if targets.allowed is None:
        return places
    which = np.repeat(np.arange(len(targets.values)), np.diff(places.starts))
    own = np.flatnonzero(targets.allowed[which] == 0)
    best, low, high = (np.array(each, np.float64) for each in (places.best, places.low, places.high))
    for _ in range(_SHARPENINGS if len(own) else 0):
        gap, rate = targets.gaps(course.at(best[own]), which[own])
        with np.errstate(invalid="ignore", divide="ignore"):
            step = np.sum(np.real(np.conj(gap) * rate), axis=1) / np.sum(np.abs(rate) ** 2, axis=1)
        best[own] -= np.nan_to_num(step)
    return replace(places, best=np.clip(best, low, high).tolist())


def _sharpened(course: Circuit, targets: Targets, distances: TargetDistances, arcs: Reals, piece: Piece) -> Reals:
    """Places put right by the circuit itself, between their neighbours: a target that is met is met exactly."""
    order = targets.order
    sense = 1 if max(arcs[list(order.groups[-1])]) >= min(arcs[list(order.groups[0])]) else -1
    rows = np.lexsort((sense * order.ranks, arcs))
    low, high = (-np.inf, np.inf) if piece is None else piece
    if piece is not None and not course.closed:
        low, high = max(low, 0.0), min(high, course.length)
    inside = _INSIDE * course.length if course.drive_limits else 0.0
    arcs = np.clip(arcs, low + inside, high - inside)
    which = np.arange(len(arcs))
    firm = np.flatnonzero(targets.allowed[rows] == 0) if targets.allowed is not None else rows[:0]
    for _ in range(_SHARPENINGS):
        gap, rate = targets.gaps(course.at(arcs), which)
        slope = np.sum(np.real(np.conj(gap) * rate), axis=1)
        bend = distances.bend(arcs)
        with np.errstate(invalid="ignore", divide="ignore"):
            step = np.where(bend > 0, -slope / bend, 0.0)
        rising, step, lap = arcs[rows], np.nan_to_num(step)[rows], course.length if piece is None else np.inf
        if len(firm):  # what is met exactly goes first, the others leave it room
            own = _between_neighbours(rising[firm], step[firm], lap)
            behind = np.searchsorted(firm, np.arange(len(rows)))
            rising = np.clip(rising, np.append(own[-1] - lap, own)[behind], np.append(own, own[0] + lap)[behind])
            rising[firm], step[firm] = own, 0
        rising = _between_neighbours(rising, step, lap)
        arcs[rows] = np.clip(rising, low + inside, high - inside)
    return arcs


def _between_neighbours(rising: Reals, step: Reals, lap: float) -> Reals:
    """Places after a step each, none beyond those beside it."""
    before, after = np.append(rising[-1] - lap, rising[:-1]), np.append(rising[1:], rising[0] + lap)
    rising = np.maximum.accumulate(np.clip(rising + step, before, after))
    return np.asarray(np.minimum(rising, rising[0] + lap))


def _against_all(samples: Poses, targets: Targets) -> tuple[Complexes, Complexes]:
    """(targets, samples, probes): the distance of every sample from every target, and the derivatives by the arc."""
    values = np.stack([probe.value(samples, 0) for probe in targets.probes], axis=1)
    rates = np.stack([probe.value(samples, 1) for probe in targets.probes], axis=1)
    gaps = values[None] - targets.values[:, None, :]
    free = np.isnan(gaps)
    return np.where(free, 0, gaps), np.where(free, 0, np.broadcast_to(rates, gaps.shape))


def _distinct(arcs: Reals, course: Circuit) -> Reals:
    """Arcs without those that stand for one place: neighbours by rounding, and both ends of a closed circuit."""
    distinct: list[float] = []
    for arc in arcs % course.length if course.closed else arcs:
        gaps = [abs(arc - other) for other in distinct]
        if course.closed:
            gaps += [course.length - gap for gap in gaps]
        if not gaps or min(gaps) > 1e-6 * course.length:
            distinct.append(float(arc))
    return np.sort(np.array(distinct))
