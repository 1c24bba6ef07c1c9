"""Targets of several kinds at once: points, coupler, crank and output angles, exactly, within a band or nearly.

docs/theory/synthesis-points.md, "Targets of several kinds".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import zip_longest
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Integers, Reals
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import joined, message
from gruebler.design.synthesis.curve_starts import atlas, neighbours, transformed
from gruebler.design.synthesis.curves import ACCEPTED, limits_of
from gruebler.design.synthesis.demands import EXACT_AT_MOST, Demands, sought_order
from gruebler.design.synthesis.dyad_linkages import linkage_of_dyads
from gruebler.design.synthesis.dyads import CRANK, GuidingDyad
from gruebler.design.synthesis.fit_limits import FourBarLimits, crank_turns
from gruebler.design.synthesis.four_bar_kinds import FOUR_BAR, SLIDER_CRANK, FourBarKind
from gruebler.design.synthesis.judging import judge_design, order_notes
from gruebler.design.synthesis.results import Design, Progress, SolutionCount, SynthesisResult, in_order_of, ranked
from gruebler.design.synthesis.target_bands import STAGES, TargetBands, numbers_or
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.design.synthesis.tasks import PathTask
from gruebler.design.synthesis.tightest_demands import tightest_sought

_PLACED = 80  # curves of the atlas that are put onto the points
_SCATTERED = 4000  # linkages of the atlas that are put near the targets, of which the nearest are taken
_NEAREST = 160
_LOOKED_AT, _SEQUENCES = 400, 3  # of targets with an order of their own: sequences, and those that crank angles allow
_STEPS = 120
_KEPT = 80  # linkages that go on after the first stage
_STUCK = 1e7  # where so much damping does not help, nothing does
_MET = 1e-18  # of the cost: all is met
_TURN = 0.3  # radians: how far a crank goes at once
_LEAST, _MOST = 1e-3, 100.0  # sizes of lengths and places
_GAIN = 1e-12  # of the cost: a smaller gain ends the search
_APART = 0.01  # of a length: designs that differ less are one


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class _Wanted:
    """A task in units of its size about the middle of its points."""

    z: Complexes
    """(targets,) NaN where free."""
    angles: Reals
    """(3, targets) of coupler, crank and output; NaN where free."""
    bands: TargetBands


class _State(NamedTuple):
    """Linkages that are improved together."""

    kind: FourBarKind
    rows: Reals
    """(own + 3, linkages) the numbers of its kind and the constants of the angles."""
    phi: Reals
    """(linkages, targets) crank angles in the plane."""
    side: Reals

    def at(self, which: list[int] | Integers) -> _State:
        """Some of the linkages."""
        return self._replace(rows=self.rows[:, which], phi=self.phi[which], side=self.side[which])

    @property
    def own(self) -> Reals:
        """(own, linkages) the numbers of the linkages alone."""
        return self.rows[: len(self.kind.unknowns)]

    @property
    def constants(self) -> Reals:
        """(3, linkages) of the angles of coupler, crank and output."""
        return self.rows[len(self.kind.unknowns) :]


def synthesise_mixed(
    task: PathTask, demands: Demands, *, number: int = 6, sliders: bool = True, progress: Progress | None = None
) -> SynthesisResult:
    """Four-bars and slider-cranks that meet targets of several kinds: exactly, within a tolerance, or nearly.

    A slider has no output angle: where one is given, and where only a four-bar has numbers enough, there are four-bars
    alone, as without ``sliders``. Raises `SynthesisError` for more exact conditions than a four-bar can meet. Cost: 2 s
    for each kind.
    """
    search = partial(_sought, number=number, sliders=sliders)
    every, kinds = search(task, demands, demands, progress=progress)
    accepted, rejected = ranked(every)
    nearly = bool(np.isinf(TargetBands.of(task, task.size).band).any())
    if nearly:
        accepted = in_order_of(accepted, ["error"])
    note = message(
        "Targets of several kinds are met by least squares from {starts} linkages of each kind ({kinds}); there may be "
        "others.",
        starts=_PLACED + _NEAREST,
        kinds=joined(message(kind.name) for kind in kinds),
    )
    notes = [note, *order_notes(every, demands)]
    if not accepted:
        notes += tightest_sought(task, demands, lambda *asked: search(*asked)[0])
    count = SolutionCount(what=message("linkages"), theorem=0 if nearly else None, found=len(every), real=len(every))
    return SynthesisResult(task=task, designs=accepted[:number], rejected=rejected, count=count, notes=tuple(notes))


def _sought(
    task: PathTask, demands: Demands, limits: Demands, *, number: int, sliders: bool, progress: Progress | None = None
) -> tuple[list[Design], tuple[FourBarKind, ...]]:
    """Designs of the kinds that have numbers enough, sought within limits and judged by the demands."""
    size, middle = task.size, complex(np.nanmean(task.z.real), np.nanmean(task.z.imag))
    wanted = _wanted(task, size, middle)
    kinds = _kinds(wanted, 2 * len(task.fixed_pivots) + limits.given_sizes)
    kinds = kinds if sliders else (FOUR_BAR,)
    every: list[Design] = []
    pivots = tuple(complex(*p) for p in task.fixed_pivots)
    order = sought_order(task, limits)
    for kept in limits_of(limits, pivots, kinds, task.closed, (middle, size)):
        designs: list[Design] = []
        state = _starts(wanted, kept, order)
        for hard in STAGES:
            state, costs = _improved(replace(wanted, bands=replace(wanted.bands, hard=hard)), kept, state)
            best = _in_turn(np.argsort(costs, kind="stable"), state, order)[:_KEPT]
            state, costs = state.at(best), costs[best]
        for n in _in_turn(_different(state, costs), state, order)[: 4 * number]:
            designs += _judged(task, demands, wanted, state.at([n]), (middle, size))
            if progress is not None:
                progress(len(designs), 4 * number)
            if sum(design.verdict.accepted for design in designs) >= number:
                break
        every += designs
    return every, kinds


def _wanted(task: PathTask, size: float, middle: complex) -> _Wanted:
    given = (task.angles, task.crank_angles, task.output_angles)
    return _Wanted(
        z=(task.z - middle) / size,
        angles=np.stack([numbers_or(values, np.nan, len(task)) for values in given]),
        bands=TargetBands.of(task, size),
    )


def _kinds(wanted: _Wanted, held: int) -> tuple[FourBarKind, ...]:
    """The kinds of linkages that have all outputs, and free numbers enough for what is to be met exactly.

    Each angle has a constant, each target a crank angle.
    """
    exact = wanted.bands.exact
    angles = ~np.isnan(wanted.angles[:, exact])
    conditions = 2 * int(np.count_nonzero(~np.isnan(wanted.z[exact]))) + int(np.count_nonzero(angles))
    free = int(np.count_nonzero(exact)) + int(np.count_nonzero(angles.any(axis=1))) - held
    if conditions > len(FOUR_BAR.unknowns) + free:
        raise SynthesisError(
            "tolerances: the targets that are to be met exactly are {conditions} conditions, but a four-bar can meet "
            "{most} of this kind",
            conditions=conditions,
            most=len(FOUR_BAR.unknowns) + free,
        )
    turned = not np.isnan(wanted.angles[2]).all()
    return tuple(
        kind
        for kind in (FOUR_BAR, SLIDER_CRANK)
        if conditions <= len(kind.unknowns) + free and (kind.output_turns or not turned)
    )


class _Moved(NamedTuple):
    """What linkages do at crank angles, with derivatives by their numbers and the crank angle, in this order."""

    values: Complexes
    """(4, linkages, targets) the place of the point, and the directions of coupler, crank and rocker."""
    slopes: Complexes
    """(own + 1, 4, linkages, targets) of the place, and of the angles."""


def _moved(state: _State) -> _Moved:
    """In closed form; NaN where a linkage cannot be assembled. The output of a slider has the direction 1."""
    kind, crank = state.kind, np.exp(1j * state.phi)
    r = kind.named(state.own[:, :, None])
    pin, arm, none = r["a0x"] + 1j * r["a0y"] + r["a"] * crank, r["u"] + 1j * r["v"], np.zeros_like(crank)
    with np.errstate(invalid="ignore", divide="ignore"):
        coupler, normal = kind.coupler(r, pin, state.side[:, None])
        coupler = coupler / np.abs(coupler)
        far = pin + r["b"] * coupler
        # How far the pin goes with each number, and how far it takes B while the coupler does not turn.
        d_pin = {"a0x": none + 1, "a0y": none + 1j, "a": crank, "phi": 1j * r["a"] * crank}
        d_far, given = d_pin | {"b": coupler}, kind.carried(far, normal)
        divisor = -np.real(normal * 1j * r["b"] * coupler)
        names = (*kind.unknowns, "phi")
        turns = np.stack([(np.real(normal * d_far.get(name, none)) - given.get(name, 0.0)) / divisor for name in names])
        place = 1j * arm * coupler * turns + np.stack([d_pin.get(name, none) for name in names])
        place[names.index("u")] += coupler
        place[names.index("v")] += 1j * coupler
        by_rocker, rocker = np.zeros_like(turns), none + 1
        if kind.output_turns:
            gone = 1j * r["b"] * coupler * turns + np.stack([d_far.get(name, none) for name in names])
            gone[names.index("b0x")] -= 1
            gone[names.index("b0y")] -= 1j
            rocker = (far - r["b0x"] - 1j * r["b0y"]) / r["c"]
            by_rocker = np.imag(np.conj(rocker) * gone) / r["c"]
        by_crank = np.zeros_like(turns)
        by_crank[-1] = 1
    return _Moved(
        np.stack([pin + arm * coupler, coupler, crank, rocker]), np.stack([place, turns, by_crank, by_rocker], 1)
    )


class _Rest(NamedTuple):
    """What is left of the targets, weighed, and how it changes."""

    errors: Reals
    """(linkages, targets, 5)"""
    slopes: Reals
    """(linkages, targets, 5, own + 4) by the numbers, the constants, and the crank angle at the target."""


def _rest(wanted: _Wanted, state: _State) -> _Rest:
    """Errors of place and angles; what is met within its band counts nothing, a band that is passed by how much."""
    moved = _moved(state)
    gap = moved.values[0] - wanted.z
    off = np.angle(moved.values[1:] * np.exp(1j * (state.constants[:, :, None] - wanted.angles[:, None, :])))
    errors = np.concatenate([[gap.real, gap.imag], off])
    own = len(state.own)
    slopes = np.zeros((own + 4, *errors.shape))
    by_own = np.stack([moved.slopes[:, 0].real, moved.slopes[:, 0].imag, *moved.slopes[:, 1:].real.swapaxes(0, 1)], 1)
    slopes[:own], slopes[-1] = by_own[:own], by_own[own]
    for k in range(3):
        slopes[own + k, 2 + k] = 1
    given = np.concatenate([[~np.isnan(wanted.z)] * 2, ~np.isnan(wanted.angles)])
    free = ~given[:, None, :]
    errors, slopes = np.where(free, 0, errors), np.where(free, 0, slopes)
    return _Rest(*wanted.bands.weighed(np.moveaxis(errors, 0, -1), np.moveaxis(slopes, (0, 1), (3, 2))))


def _cost(wanted: _Wanted, limits: FourBarLimits, state: _State) -> Reals:
    """(linkages,) the sum of squares, infinite where a linkage cannot be assembled or has no lengths."""
    cost = np.sum(_rest(wanted, state).errors ** 2, axis=(1, 2))
    beyond = limits.values(state.own, state.phi)
    cost = cost + wanted.bands.hard**2 * np.sum(np.maximum(beyond, 0) ** 2, axis=0)
    numbers = state.kind.named(state.own)
    short = np.any([numbers[name] < _LEAST for name in state.kind.links if name in numbers], axis=0)
    bad = short | (np.abs(state.own) > _MOST).any(axis=0)
    return np.where(np.isfinite(cost) & ~bad, cost, np.inf)


def _improved(wanted: _Wanted, limits: FourBarLimits, state: _State) -> tuple[_State, Reals]:
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


def _stepped(wanted: _Wanted, limits: FourBarLimits, state: _State, damping: Reals) -> _State:
    errors, slopes = _rest(wanted, state)
    slopes[..., : len(state.own)] *= limits.free
    own, by_crank = slopes[..., :-1], slopes[..., -1]
    square = np.sum(by_crank**2, axis=2)[:, :, None] + 1e-300
    left = errors - by_crank * (np.sum(by_crank * errors, axis=2)[:, :, None] / square)
    matrix = own - by_crank[..., None] * (np.einsum("stk,stkj->stj", by_crank, own) / square)[:, :, None, :]
    count, numbers = len(damping), len(state.rows)
    rows, value = [matrix.reshape(count, -1, numbers)], [left.reshape(count, -1)]
    beyond = limits.values(state.own, state.phi)
    if len(beyond):
        passed = np.maximum(beyond, 0)
        bounds = np.where(passed > 0, wanted.bands.hard, 0)[:, None] * limits.linearised(state.own, state.phi)[1]
        rows.append(np.concatenate([bounds, np.zeros((len(beyond), 3, count))], axis=1).transpose(2, 0, 1))
        value.append((wanted.bands.hard * passed).T)
    scale = np.sqrt(sum(np.sum(part**2, axis=1) for part in rows)) + 1e-6
    rows.append(np.sqrt(damping)[:, None, None] * scale[:, :, None] * np.eye(numbers))
    value.append(np.zeros((count, numbers)))
    q, r = np.linalg.qr(np.concatenate(rows, axis=1))
    step = -np.linalg.solve(r, np.einsum("smn,sm->sn", q, np.concatenate(value, axis=1))[..., None])[..., 0]
    after = errors + np.einsum("stkj,sj->stk", own, step)
    turn = np.clip(-np.sum(by_crank * after, axis=2) / square[:, :, 0], -_TURN, _TURN)
    return state._replace(rows=state.rows + step.T, phi=state.phi + turn)


def _in_turn(ranked: Sequence[int] | Integers, state: _State, order: TargetOrder | None) -> list[int]:
    """Linkages, by their costs, so that those in order and all take turns."""
    every = list(map(int, ranked))
    if order is None:
        return every
    turns = crank_turns(state.kind, state.own)
    kept = np.where(turns, order.kept_along(state.phi, 2 * np.pi), order.kept_along(state.phi))
    in_order = [n for n in every if kept[n]]
    return list(dict.fromkeys(n for pair in zip_longest(in_order, every) for n in pair if n is not None))


def _starts(wanted: _Wanted, limits: FourBarLimits, order: TargetOrder | None = None) -> _State:
    """Curves of the atlas on the points, and linkages of it turned and shifted so that they come near."""
    kind = limits.kind
    timings = _timings(wanted, order)
    near = _scattered(wanted, kind, timings)
    placed = ~np.isnan(wanted.z)
    if np.count_nonzero(placed) > 2:
        phi, alike = [], []
        for after, _ in timings:
            rising = np.argsort(after)
            own = rising[placed[rising]]
            for start in neighbours(wanted.z[own], limits, closed=False, number=-(-_PLACED // len(timings))):
                phi.append(np.interp(after, after[own], np.unwrap(start.phi)))
                alike.append(start)
        rows, side = np.array([start.row for start in alike]).T, np.array([start.side for start in alike])
        rows = np.concatenate([np.concatenate([rows, np.zeros((3, len(side)))]), near.rows], axis=1)
        near = _State(kind, rows, np.concatenate([np.array(phi), near.phi]), np.concatenate([side, near.side]))
    for name, value in limits.held.items():
        near.rows[kind.unknowns.index(name)] = value
    return _with_constants(wanted, near)


def _timings(wanted: _Wanted, order: TargetOrder | None) -> list[tuple[Integers, Reals | None]]:
    """In likely sequences how many targets lie before each, and crank angles as given, evenly between; None if free."""
    sequences = [np.arange(len(wanted.z))] if order is None else order.likely(wanted.z, _LOOKED_AT)
    timings: list[tuple[Integers, Reals | None]] = []
    for sequence in sequences:
        after, own = np.argsort(sequence), sequence[~np.isnan(wanted.angles[1, sequence])]
        if len(own) < 2:  # one alone says nothing, its constant is free
            timings.append((after, None))
            continue
        steps = np.diff(wanted.angles[1, own])
        for turned in (steps, steps % (2 * np.pi), -(-steps % (2 * np.pi))):
            if (np.sign(turned) == np.sign(turned[0])).all() and abs(turned.sum()) < 2 * np.pi:
                timings.append((after, np.interp(after, after[own], np.append(0, np.cumsum(turned)))))
                break
    return timings[:_SEQUENCES] or [(np.arange(len(wanted.z)), None)]


def _scattered(wanted: _Wanted, kind: FourBarKind, timings: list[tuple[Integers, Reals | None]]) -> _State:
    """The nearest of many linkages, with crank angles as given or evenly along a part of a turn."""
    book, rng = atlas(kind), np.random.default_rng(0)
    chosen = rng.integers(0, len(book.side), _SCATTERED)
    turned = rng.uniform(0.5, 5, _SCATTERED) * rng.choice([-1.0, 1.0], _SCATTERED)
    phi = np.empty((_SCATTERED, len(wanted.z)))
    for k, (after, timing) in enumerate(timings):
        own = slice(k, None, len(timings))
        phi[own] = turned[own, None] * after / (len(after) - 1) if timing is None else timing
    phi = phi + rng.uniform(0, 2 * np.pi, (_SCATTERED, 1))
    state = _State(kind, np.concatenate([book.rows[:, chosen], np.zeros((3, _SCATTERED))]), phi, book.side[chosen])
    # The best similarity to the points, by least squares.
    placed = ~np.isnan(wanted.z)
    own, z = _moved(state).values[0][:, placed], wanted.z[placed]
    about, centre = own.mean(axis=1, keepdims=True), z.mean()
    turn = np.sum(np.conj(own - about) * (z - centre), axis=1) / np.sum(np.abs(own - about) ** 2, axis=1)
    shift = centre - turn * about[:, 0]
    state.own[:] = transformed(kind, state.own, turn, shift)
    state = _with_constants(wanted, state._replace(phi=phi + np.angle(turn)[:, None]))
    nearly = replace(wanted, bands=replace(wanted.bands, band=np.full(len(wanted.z), np.inf)))
    rest = np.sum(_rest(nearly, state).errors ** 2, axis=(1, 2))
    return state.at(np.argsort(np.nan_to_num(rest, nan=np.inf), kind="stable")[:_NEAREST])


def _with_constants(wanted: _Wanted, state: _State) -> _State:
    """With the constants of the angles that fit best in the mean."""
    gaps = np.exp(1j * wanted.angles[:, None, :]) * np.conj(_moved(state).values[1:])
    state.constants[:] = np.angle(np.nansum(gaps, axis=2))
    return state


def _different(state: _State, costs: Reals) -> list[int]:
    """The linkages in the order of their costs, each once."""
    chosen: list[int] = []
    rows = state.own
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
    moved, kind = _moved(state).values[:, 0, 0], state.kind
    row = transformed(kind, state.own[:, 0], complex(size), middle)
    r = {name: float(value) for name, value in kind.named(row).items()}
    pivot, (point, coupler, crank, _) = complex(r["a0x"], r["a0y"]), map(complex, moved)
    pin = pivot + r["a"] * crank
    guide = kind.guide(r, complex(pin + r["b"] * coupler))
    try:
        linkage = linkage_of_dyads(GuidingDyad(CRANK, pin, pivot), guide, middle + size * point, task.unit)
    except LinkageError:
        return
    values = [task.z]
    probes = [Probe("P")]
    for k, link in enumerate(("coupler", "crank", "rocker")):
        if np.isnan(wanted.angles[k]).all():
            continue
        turned = wanted.angles[k] - state.constants[k, 0] - float(np.angle(moved[1 + k]))
        values.append(size * np.exp(1j * (linkage.required_pose[link].angle + turned)))
        probes.append(Probe(link=link, length=size))
    targets = Targets(tuple(probes), np.stack(values, axis=1), size, allowed=wanted.bands.band, ranks=task.order)
    limit = wanted.bands.tolerance(demands.tolerance, EXACT_AT_MOST, ACCEPTED)
    yield judge_design(linkage, targets, replace(demands, tolerance=limit), kind.name)
