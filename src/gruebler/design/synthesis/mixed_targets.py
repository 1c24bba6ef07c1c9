"""Targets of several kinds at once: points, coupler, crank and output angles, exactly, within a band or nearly.

docs/theory/synthesis-points.md, "Targets of several kinds".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Integers, Reals
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import message
from gruebler.design.synthesis.curve_starts import atlas, neighbours
from gruebler.design.synthesis.curves import ACCEPTED, limits_of
from gruebler.design.synthesis.dyads import CRANK, GuidingDyad
from gruebler.design.synthesis.fit_limits import FitLimits
from gruebler.design.synthesis.four_bar_kinds import FOUR_BAR
from gruebler.design.synthesis.judging import EXACT_AT_MOST, Demands, judge_design
from gruebler.design.synthesis.positions import linkage_of_dyads, ranked
from gruebler.design.synthesis.results import Design, Progress, SolutionCount, SynthesisResult, in_order_of
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.design.synthesis.tasks import PathTask

_PLACED = 80  # curves of the atlas that are put onto the points
_SCATTERED = 4000  # linkages of the atlas that are put near the targets, of which the nearest are taken
_NEAREST = 160
_STEPS = 120
_HARD = (10.0, 1e3, 1e5)  # stages: weights of what is met exactly or within its band, by that of what is met nearly
_INSIDE = 1 - 1e-6  # of a band: least squares end a little outside of what they keep to
_KEPT = 80  # linkages that go on after the first stage
_STUCK = 1e7  # where so much damping does not help, nothing does
_MET = 1e-18  # of the cost: all is met
_TURN = 0.3  # radians: how far a crank goes at once
_LEAST, _MOST = 1e-3, 100.0  # sizes of lengths and places
_GAIN = 1e-12  # of the cost: a smaller gain ends the search
_APART = 0.01  # of a length: designs that differ less are one
_OWN = 9  # numbers of a four-bar with a point of its coupler


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class _Wanted:
    """A task in units of its size about the middle of its points."""

    z: Complexes
    """(targets,) NaN where free."""
    angles: Reals
    """(3, targets) of coupler, crank and output; NaN where free."""
    band: Reals
    """(targets,) how far a target may be missed; infinite where it is met as nearly as possible."""
    weight: Reals
    hard: float = _HARD[0]
    """The weight of what is not met as nearly as possible."""


class _State(NamedTuple):
    """Linkages that are improved together."""

    rows: Reals
    """(9 + 3, linkages) the numbers of the four-bar and the constants of the angles."""
    phi: Reals
    """(linkages, targets) crank angles in the plane."""
    side: Reals

    def at(self, which: list[int] | Integers) -> _State:
        """Some of the linkages."""
        return _State(self.rows[:, which], self.phi[which], self.side[which])


def synthesise_mixed(
    task: PathTask, demands: Demands, *, number: int = 6, progress: Progress | None = None
) -> SynthesisResult:
    """Four-bars that meet targets of several kinds, each exactly, within its tolerance, or as nearly as possible.

    Raises `SynthesisError` for more exact conditions than a four-bar can meet. Cost: 2 s.
    """
    size, middle = task.size, complex(np.nanmean(task.z.real), np.nanmean(task.z.imag))
    wanted = _wanted(task, size, middle)
    _check_count(wanted, 2 * len(task.fixed_pivots) + len(demands.lengths))
    designs: list[Design] = []
    pivots = tuple(complex(*p) for p in task.fixed_pivots)
    for limits in limits_of(demands, pivots, (FOUR_BAR,), task.closed, (middle, size)):
        state = _starts(wanted, limits)
        for hard in _HARD:
            state, costs = _improved(replace(wanted, hard=hard), limits, state)
            best = np.argsort(costs, kind="stable")[:_KEPT]
            state, costs = state.at(best), costs[best]
        for n in _different(state, costs)[: 4 * number]:
            designs += _judged(task, demands, wanted, state.at([n]), (middle, size))
            if progress is not None:
                progress(len(designs), 4 * number)
            if sum(design.verdict.accepted for design in designs) >= number:
                break
    accepted, rejected = ranked(designs)
    nearly = bool(np.isinf(wanted.band).any())
    if nearly:
        accepted = in_order_of(accepted, ["error"])
    note = message(
        "Targets of several kinds are met by least squares from {starts} four-bars; there may be others.",
        starts=_PLACED + _NEAREST,
    )
    count = SolutionCount(
        what=message("four-bars"), theorem=0 if nearly else None, found=len(designs), real=len(designs)
    )
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=(note,))


def _wanted(task: PathTask, size: float, middle: complex) -> _Wanted:
    count = len(task)

    def numbers(values: Sequence[float | None], free: float) -> Reals:
        return np.array([free if value is None else value for value in values] or [free] * count, np.float64)

    given = (task.angles, task.crank_angles, task.output_angles)
    return _Wanted(
        z=(task.z - middle) / size,
        angles=np.stack([numbers(values, np.nan) for values in given]),
        band=numbers(task.tolerances, np.inf) / size,
        weight=numbers(task.weights, 1.0),
    )


def _check_count(wanted: _Wanted, held: int) -> None:
    """Refuse more exact conditions than free numbers: each angle has a constant, each target a crank angle."""
    exact = wanted.band == 0
    angles = ~np.isnan(wanted.angles[:, exact])
    conditions = 2 * int(np.count_nonzero(~np.isnan(wanted.z[exact]))) + int(np.count_nonzero(angles))
    unknowns = _OWN - held + int(np.count_nonzero(exact)) + int(np.count_nonzero(angles.any(axis=1)))
    if conditions > unknowns:
        raise SynthesisError(
            "tolerances: the targets that are to be met exactly are {conditions} conditions, but a four-bar can meet "
            "{most} of this kind",
            conditions=conditions,
            most=unknowns,
        )


class _Moved(NamedTuple):
    """What four-bars do at crank angles, with derivatives by their numbers and the crank angle, in this order."""

    values: Complexes
    """(4, linkages, targets) the place of the point, and the directions of coupler, crank and rocker."""
    slopes: Complexes
    """(10, 4, linkages, targets) of the place, and of the angles."""


def _moved(state: _State) -> _Moved:
    """In closed form; NaN where a linkage cannot be assembled."""
    a0x, a0y, b0x, b0y, a, b, c, u, v = state.rows[:_OWN, :, None]
    crank, far, arm = np.exp(1j * state.phi), b0x + 1j * b0y, u + 1j * v
    pin = a0x + 1j * a0y + a * crank
    with np.errstate(invalid="ignore", divide="ignore"):
        coupler, _ = FOUR_BAR.coupler(FOUR_BAR.named(state.rows[:_OWN, :, None]), pin, state.side[:, None])
        coupler = coupler / np.abs(coupler)
        rocker = (pin + b * coupler - far) / c
        # d pin + (db + i b dtheta) coupler = d far + (dc + i c dpsi) rocker, split along both directions
        zero, unit = np.zeros_like(crank), np.ones_like(crank)
        d_pin = np.stack([unit, 1j * unit, zero, zero, crank, zero, zero, zero, zero, 1j * a * crank])
        rest = -d_pin
        rest[2], rest[3], rest[5], rest[6] = unit, 1j * unit, -coupler, rocker
        sine = np.imag(np.conj(coupler) * rocker)
        by_coupler = np.real(np.conj(rocker) * rest) / (b * sine)
        by_rocker = np.real(np.conj(coupler) * rest) / (c * sine)
        place = d_pin + 1j * arm * coupler * by_coupler
        place[7] += coupler
        place[8] += 1j * coupler
        by_crank = np.zeros_like(by_coupler)
        by_crank[9] = 1
    values = np.stack([pin + arm * coupler, coupler, crank, rocker])
    return _Moved(values, np.stack([place, by_coupler, by_crank, by_rocker], axis=1))


class _Rest(NamedTuple):
    """What is left of the targets, weighed, and how it changes."""

    errors: Reals
    """(linkages, targets, 5)"""
    slopes: Reals
    """(linkages, targets, 5, 13) by the numbers, the constants, and the crank angle at the target."""


def _rest(wanted: _Wanted, state: _State) -> _Rest:
    """Errors of place and angles; what is met within its band counts nothing, a band that is passed by how much."""
    moved = _moved(state)
    gap = moved.values[0] - wanted.z
    off = np.angle(moved.values[1:] * np.exp(1j * (state.rows[_OWN:, :, None] - wanted.angles[:, None, :])))
    errors = np.concatenate([[gap.real, gap.imag], off])
    slopes = np.zeros((_OWN + 4, *errors.shape))
    by_own = np.stack([moved.slopes[:, 0].real, moved.slopes[:, 0].imag, *moved.slopes[:, 1:].real.swapaxes(0, 1)], 1)
    slopes[:_OWN], slopes[-1] = by_own[:_OWN], by_own[_OWN]
    for k in range(3):
        slopes[_OWN + k, 2 + k] = 1
    given = np.concatenate([[~np.isnan(wanted.z)] * 2, ~np.isnan(wanted.angles)])
    free = ~given[:, None, :]
    errors, slopes = np.where(free, 0, errors), np.where(free, 0, slopes)
    size = np.sqrt(np.sum(errors**2, axis=0))
    hard = np.isfinite(wanted.band)
    band = np.where(hard, _INSIDE * wanted.band, 0)
    share = np.maximum(1 - band / np.maximum(size, 1e-300), 0)
    along = np.sum(errors * slopes, axis=1, keepdims=True) * errors
    bent = np.where(share > 0, band / np.maximum(size, 1e-300) ** 3, 0)
    weight = np.where(hard, wanted.hard, wanted.weight)
    return _Rest(
        np.moveaxis(weight * share * errors, 0, -1),
        np.moveaxis(weight * (share * slopes + bent * along), (0, 1), (3, 2)),
    )


def _cost(wanted: _Wanted, limits: FitLimits, state: _State) -> Reals:
    """(linkages,) the sum of squares, infinite where a linkage cannot be assembled or has no lengths."""
    cost = np.sum(_rest(wanted, state).errors ** 2, axis=(1, 2))
    beyond = limits.values(state.rows[:_OWN], state.phi)
    cost = cost + wanted.hard**2 * np.sum(np.maximum(beyond, 0) ** 2, axis=0)
    bad = (state.rows[4:7] < _LEAST).any(axis=0) | (np.abs(state.rows[:_OWN]) > _MOST).any(axis=0)
    return np.where(np.isfinite(cost) & ~bad, cost, np.inf)


def _improved(wanted: _Wanted, limits: FitLimits, state: _State) -> tuple[_State, Reals]:
    """Levenberg and Marquardt's method for all at once; the crank angles are eliminated target by target."""
    cost, damping = _cost(wanted, limits, state), np.full(len(state.side), 1e-3)
    open_ = np.flatnonzero(np.isfinite(cost))
    for _ in range(_STEPS):
        if not len(open_):
            break
        here = state.at(open_)
        trial = _stepped(wanted, limits, here, damping[open_])
        new = _cost(wanted, limits, trial)
        better = new < cost[open_]
        done = better & (cost[open_] - new <= _GAIN * cost[open_])
        at = open_[better]
        state.rows[:, at], state.phi[at] = trial.rows[:, better], trial.phi[better]
        cost[at] = new[better]
        damping[open_] = np.clip(damping[open_] * np.where(better, 0.2, 5.0), 1e-14, 1e8)
        open_ = open_[~(done | (damping[open_] >= _STUCK) | (cost[open_] < _MET))]
    return state, cost


def _stepped(wanted: _Wanted, limits: FitLimits, state: _State, damping: Reals) -> _State:
    errors, slopes = _rest(wanted, state)
    slopes[..., :_OWN] *= limits.free
    own, by_crank = slopes[..., :-1], slopes[..., -1]
    square = np.sum(by_crank**2, axis=2)[:, :, None] + 1e-300
    left = errors - by_crank * (np.sum(by_crank * errors, axis=2)[:, :, None] / square)
    matrix = own - by_crank[..., None] * (np.einsum("stk,stkj->stj", by_crank, own) / square)[:, :, None, :]
    count, numbers = len(damping), _OWN + 3
    rows, value = [matrix.reshape(count, -1, numbers)], [left.reshape(count, -1)]
    beyond = limits.values(state.rows[:_OWN], state.phi)
    if len(beyond):
        passed = np.maximum(beyond, 0)
        bounds = np.where(passed > 0, wanted.hard, 0)[:, None] * limits.slopes(state.rows[:_OWN], state.phi)
        rows.append(np.concatenate([bounds, np.zeros((len(beyond), 3, count))], axis=1).transpose(2, 0, 1))
        value.append((wanted.hard * passed).T)
    scale = np.sqrt(sum(np.sum(part**2, axis=1) for part in rows)) + 1e-6
    rows.append(np.sqrt(damping)[:, None, None] * scale[:, :, None] * np.eye(numbers))
    value.append(np.zeros((count, numbers)))
    q, r = np.linalg.qr(np.concatenate(rows, axis=1))
    step = -np.linalg.solve(r, np.einsum("smn,sm->sn", q, np.concatenate(value, axis=1))[..., None])[..., 0]
    after = errors + np.einsum("stkj,sj->stk", own, step)
    turn = np.clip(-np.sum(by_crank * after, axis=2) / square[:, :, 0], -_TURN, _TURN)
    return _State(state.rows + step.T, state.phi + turn, state.side)


def _starts(wanted: _Wanted, limits: FitLimits) -> _State:
    """Curves of the atlas on the points, and linkages of it turned and shifted so that they come near."""
    near = _scattered(wanted)
    placed = np.flatnonzero(~np.isnan(wanted.z))
    if len(placed) > 2:
        alike = neighbours(wanted.z[placed], limits, closed=False, number=_PLACED)
        rows, side = np.array([start.row for start in alike]).T, np.array([start.side for start in alike])
        targets = np.arange(len(wanted.z))
        phi = np.array([np.interp(targets, placed, np.unwrap(start.phi)) for start in alike])
        own = _State(np.concatenate([rows, np.zeros((3, len(side)))]), phi, side)
        near = _State(*(np.concatenate([a, b], axis=axis) for a, b, axis in zip(own, near, (1, 0, 0), strict=True)))
    for name, value in limits.held.items():
        near.rows[FOUR_BAR.unknowns.index(name)] = value
    return _with_constants(wanted, near)


def _scattered(wanted: _Wanted) -> _State:
    """The nearest of many linkages, with crank angles as given or evenly along a part of a turn."""
    book, rng = atlas(FOUR_BAR), np.random.default_rng(0)
    chosen = rng.integers(0, len(book.side), _SCATTERED)
    targets = np.arange(len(wanted.z))
    given = ~np.isnan(wanted.angles[1])
    turned = rng.uniform(0.5, 5, _SCATTERED) * rng.choice([-1.0, 1.0], _SCATTERED)
    phi = turned[:, None] * targets / targets[-1]
    if given.any():
        timing = np.interp(targets, targets[given], wanted.angles[1, given])
        phi = np.broadcast_to(timing - timing[0], phi.shape)
    phi = phi + rng.uniform(0, 2 * np.pi, (_SCATTERED, 1))
    state = _State(np.concatenate([book.rows[:, chosen], np.zeros((3, _SCATTERED))]), phi, book.side[chosen])
    # The best similarity to the points, by least squares.
    placed = ~np.isnan(wanted.z)
    own, z = _moved(state).values[0][:, placed], wanted.z[placed]
    about, centre = own.mean(axis=1, keepdims=True), z.mean()
    turn = np.sum(np.conj(own - about) * (z - centre), axis=1) / np.sum(np.abs(own - about) ** 2, axis=1)
    shift = centre - turn * about[:, 0]
    rows = state.rows.copy()
    for x in (0, 2):
        pivot = turn * (rows[x] + 1j * rows[x + 1]) + shift
        rows[x], rows[x + 1] = pivot.real, pivot.imag
    rows[4:_OWN] *= np.abs(turn)
    state = _with_constants(wanted, _State(rows, phi + np.angle(turn)[:, None], state.side))
    nearly = replace(wanted, band=np.full(len(wanted.band), np.inf))
    rest = np.sum(_rest(nearly, state).errors ** 2, axis=(1, 2))
    return state.at(np.argsort(np.nan_to_num(rest, nan=np.inf), kind="stable")[:_NEAREST])


def _with_constants(wanted: _Wanted, state: _State) -> _State:
    """With the constants of the angles that fit best in the mean."""
    gaps = np.exp(1j * wanted.angles[:, None, :]) * np.conj(_moved(state).values[1:])
    state.rows[_OWN:] = np.angle(np.nansum(gaps, axis=2))
    return state


def _different(state: _State, costs: Reals) -> list[int]:
    """The linkages in the order of their costs, each once."""
    chosen: list[int] = []
    rows = state.rows[:_OWN]
    for n in np.argsort(np.maximum(costs, _MET), kind="stable"):
        gaps = [np.abs(rows[:, n] - rows[:, m]).max() / np.abs(rows[:, m]).max() for m in chosen]
        if np.isfinite(costs[n]) and min(gaps, default=1.0) > _APART:
            chosen.append(int(n))
    return chosen


def _judged(
    task: PathTask, demands: Demands, wanted: _Wanted, state: _State, unit: tuple[complex, float]
) -> Iterator[Design]:
    """The design of one linkage."""
    middle, size = unit
    a0x, a0y, b0x, b0y, a, b, _, u, v = (float(x) for x in state.rows[:_OWN, 0])
    moved = _moved(state).values[:, 0]
    coupler, crank = complex(moved[1, 0]), complex(moved[2, 0])
    own = complex(a0x, a0y)
    pin = own + a * crank
    places = [
        middle + size * z for z in (own, pin, pin + b * coupler, complex(b0x, b0y), pin + complex(u, v) * coupler)
    ]
    try:
        linkage = linkage_of_dyads(
            GuidingDyad(CRANK, places[1], places[0]), GuidingDyad(CRANK, places[2], places[3]), places[4], task.unit
        )
    except LinkageError:
        return
    values = [task.z]
    probes = [Probe("P")]
    for k, link in enumerate(("coupler", "crank", "rocker")):
        turned = wanted.angles[k] - state.rows[_OWN + k, 0] - float(np.angle(moved[1 + k, 0]))
        values.append(size * np.exp(1j * (linkage.required_pose[link].angle + turned)))
        probes.append(Probe(link=link, length=size))
    targets = Targets(tuple(probes), np.stack(values, axis=1), size, allowed=wanted.band, ranks=task.order)
    exact = bool((wanted.band == 0).all())
    least = demands.tolerance if demands.tolerance > EXACT_AT_MOST else ACCEPTED
    limit = demands.tolerance if exact else max(least, *wanted.band[np.isfinite(wanted.band)].tolist(), 0.0)
    yield judge_design(linkage, targets, replace(demands, tolerance=limit), "four-bar")
