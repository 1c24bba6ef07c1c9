"""Whole curves: linkages whose coupler point comes as near as possible to many points.

An atlas of normalised coupler curves gives the neighbours of the curve wanted, whatever its place, size, rotation and
mirror image; least squares with exact derivatives makes the best of each. docs/theory/synthesis-curves.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import count, permutations
from typing import Any

import numpy as np

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.curve_matching import passes
from gruebler.design.synthesis.curve_starts import CurveStart, neighbours, timed_neighbours, transformed
from gruebler.design.synthesis.demands import Demands, sought_order
from gruebler.design.synthesis.dyad_linkages import four_bar_linkages, linkage_of_dyads
from gruebler.design.synthesis.dyads import CRANK, GuidingDyad
from gruebler.design.synthesis.fit_limits import FourBarLimits, crank_turns
from gruebler.design.synthesis.four_bar_curves import curve_points
from gruebler.design.synthesis.four_bar_kinds import FOUR_BAR, SLIDER_CRANK, FourBarKind
from gruebler.design.synthesis.judging import best_of, order_notes
from gruebler.design.synthesis.results import Design, Progress, SolutionCount, SynthesisResult, in_order_of, ranked
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.design.synthesis.targets import GuidedCurve, Probe, Targets
from gruebler.design.synthesis.tasks import MOST_POINTS, PathTask
from gruebler.design.synthesis.tightest_demands import tightest_sought
from gruebler.mechanics.linkages import Linkage

_STARTS = (40, 240)  # neighbours that are made better; a triangle needs the more
_STARTS_ON_PIVOTS = (12, 240)  # if both fixed pivots are given: these are near already
_NEAR = 1e-3  # of the size: if the best of the first come nearer, more are not tried
_SEQUENCES = 3  # of points with an order of their own, in which curves of the atlas are put onto them
_STEPS = 300
_GAIN = 1e-9  # of the sum of squares: a smaller gain ends the search
_POWER = 8  # of distances: designs are judged by the largest one
_STUCK = 1e5  # where so much damping does not help, nothing does
_MET = 1e-10  # of the size: fits that come so near are equally good, and the most alike at the start comes first
ACCEPTED = 0.05
"""A whole curve is accepted if it is missed by less than this part of its size, unless the caller says otherwise."""


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Fit:
    """A linkage fitted to points."""

    kind: FourBarKind
    row: Reals
    side: float
    phi: Reals
    """(points,) crank angles, in the plane."""
    error: float
    """The root of the mean square distance, relative to the size of the target."""


def fit_curve(
    z: Complexes,
    *,
    closed: bool,
    timing: Reals | None = None,
    kinds: tuple[FourBarKind, ...] = (FOUR_BAR, SLIDER_CRANK),
    starts: int | None = None,
    number: int = 6,
    demands: Demands | None = None,
    pivots: tuple[complex, ...] = (),
    power: int = 2,
    order: TargetOrder | None = None,
    progress: Progress | None = None,
) -> list[Fit]:
    """The linkages whose coupler curves come nearest to points in the mean, the best first.

    Args:
        z: (points,) x + iy, in order.
        closed: whether the curve returns to its begin.
        timing: (points,) crank angles, of which differences count; without them the crank angle of each point is free.
        kinds: of linkages.
        starts: how many neighbours of each kind are made better; by default 40, and 240 if these do not come near, or
            too few of them meet fewer than nine points of an open curve exactly; with both pivots given 12 and 240.
        number: how many are returned.
        demands: limits that no linkage passes: region, size ratio, transmission angle, lengths, a crank that turns.
        pivots: one or both of the fixed pivots, in the plane of the points.
        power: of the distances whose sum is made as small as possible at the end; a high one lowers the largest.
        order: of the points, if it is not that of the list: starts pass them in likely sequences, and fits that
            keep it are the first.
        progress: called with how often the curves of the atlas were gone through, and how often that is done; anew
            where more neighbours are needed.

    Cost: 1 s for the atlas at the first call, then about 0.5 s, 2 s for curves that no linkage comes near.
    """
    if starts is None:
        fitted = partial(fit_curve, z, closed=closed, timing=timing, kinds=kinds, number=number)
        fitted = partial(fitted, demands=demands, pivots=pivots, power=power, order=order, progress=progress)
        first, more = _STARTS if len(pivots) < 2 else _STARTS_ON_PIVOTS
        fits = fitted(starts=first)
        enough, near = (number, _MET) if not closed and len(z) < MOST_POINTS else (1, _NEAR)
        if timing is not None or (len(fits) >= enough and fits[enough - 1].error < near):
            return fits
        return fitted(starts=more)
    size = _extent(z)
    middle = z.mean()
    reduced = (z - middle) / size
    sequences = order.likely(reduced, _SEQUENCES) if order else [np.arange(len(z))]
    placed: list[tuple[Fit, FourBarLimits]] = []
    all_limits = list(limits_of(demands, pivots, kinds, closed, (complex(middle), size)))
    done, total = count(1), len(all_limits) * len(sequences) * passes(closed=closed)
    passed = None if progress is None else lambda: progress(next(done), total)
    for limits in all_limits:
        begins = (
            [
                start._replace(phi=start.phi[np.argsort(sequence)])
                for sequence in sequences
                for start in neighbours(
                    reduced[sequence], limits, closed=closed, number=-(-starts // len(sequences)), passed=passed
                )
            ]
            if timing is None
            else timed_neighbours(limits.kind, reduced, timing, starts)
        )
        placed += [(fit, limits) for fit in _improved(reduced, begins, timing, limits)]
    chosen = _different(placed, number, order)
    if power > 2:
        chosen = _different(_evened(reduced, timing, power, chosen), number)  # some of them end at the same linkage
    return [replace(fit, row=transformed(fit.kind, fit.row, complex(size), complex(middle))) for fit, _ in chosen]


def _different(
    fits: list[tuple[Fit, FourBarLimits]], number: int, order: TargetOrder | None = None
) -> list[tuple[Fit, FourBarLimits]]:
    """The best fits of different shapes, so many, those that meet points in order first; then the best of each kind."""
    fits.sort(key=lambda each: max(each[0].error, _MET))
    if order is not None:
        fits = [fits[k] for k in np.argsort([not _meets_in_order(fit, order) for fit, _ in fits], kind="stable")]
    firsts = {fit.kind.name: k for k, (fit, _) in reversed([*enumerate(fits)])}.values()
    chosen: list[tuple[Fit, FourBarLimits]] = []
    for k in sorted(range(len(fits)), key=lambda k: (k not in firsts, k)):
        fit = fits[k][0]
        if all(fit.kind != o.kind or np.abs(_shape(fit) - _shape(o)).max() > 0.02 for o, _ in chosen):
            chosen.append(fits[k])
        if len(chosen) == number:
            break
    return chosen


def _meets_in_order(fit: Fit, order: TargetOrder) -> bool:
    """Whether a fit passes exactly through points and keeps their order."""
    lap = 2 * np.pi if crank_turns(fit.kind, fit.row[:, None])[0] else np.inf
    return fit.error < _MET and bool(order.kept_along(fit.phi[None], lap)[0])


def _evened(
    z: Complexes, timing: Reals | None, power: int, fits: list[tuple[Fit, FourBarLimits]]
) -> list[tuple[Fit, FourBarLimits]]:
    """The fits with a higher mean of their distances made small, in the same order: the largest distances fall."""
    evened = list(fits)
    for limits in {id(limits): limits for _, limits in fits}.values():
        of_limits = [k for k, (_, own) in enumerate(fits) if own is limits]
        starts = [CurveStart(0.0, fits[k][0].row, fits[k][0].side, fits[k][0].phi) for k in of_limits]
        for k, fit in zip(of_limits, _improved(z, starts, timing, limits, power), strict=True):
            evened[k] = fit, limits
    return evened


def _shape(fit: Fit) -> Reals:
    """Lengths that do not depend on place and rotation, logarithmically."""
    r = fit.kind.named(fit.row)
    lengths = [*fit.kind.lengths(r), np.hypot(r["u"], r["v"])]
    return np.asarray(np.log(np.array(lengths) + 1e-3))


_LENGTHS = {"crank": "a", "coupler": "b", "rocker": "c", "frame": "frame"}
"""The names of lengths that a demand may give, as the numbers of a fit."""


def limits_of(
    demands: Demands | None,
    pivots: Sequence[complex],
    kinds: Iterable[FourBarKind],
    closed: bool,
    unit: tuple[complex, float],
) -> Iterator[FourBarLimits]:
    """What linkages of the kinds keep to, about an origin and in units of a size; for each side that a pivot can be."""
    wanted, (origin, size) = demands or Demands(), unit
    region = None
    if wanted.region is not None:
        low, high = ((complex(*wanted.region[k : k + 2]) - origin) / size for k in (0, 2))
        region = low.real, low.imag, high.real, high.imag
    lengths = {_LENGTHS[name]: length / size for name, length in wanted.lengths if name in _LENGTHS}
    places = [(p - origin) / size for p in pivots]
    for kind in kinds:
        if len(places) > len(kind.pivots) or {_LENGTHS[link] for link in wanted.links_with_sizes} - {*kind.links}:
            continue
        sides = [dict(zip(names, places, strict=False)) for names in permutations(kind.pivots)] if places else [{}]
        for given in sides:
            held = {name: value for name, value in lengths.items() if name in kind.unknowns}
            for name, place in given.items():
                held |= {name + "x": place.real, name + "y": place.imag}
            yield FourBarLimits(
                kind=kind,
                turning=closed or wanted.crank,
                region=region,
                size_ratio=wanted.size_ratio,
                transmission=wanted.transmission,
                frame=lengths.get("frame", 0.0),
                frame_direction=wanted.frame_direction,
                held=held,
            )


def _extent(z: Complexes) -> float:
    """The longest side of the smallest upright rectangle about points."""
    return float(max(np.ptp(z.real), np.ptp(z.imag)))


def _improved(
    z: Complexes, starts: list[CurveStart], timing: Reals | None, limits: FourBarLimits, power: int = 2
) -> list[Fit]:
    """Levenberg and Marquardt's method for all starts at once; free crank angles are eliminated point by point.

    A start beyond a limit comes back first, with the least change of its curve; then no step passes a limit.
    """
    if not starts:
        return []
    kind = limits.kind
    rows = np.array([start.row for start in starts]).T  # (unknowns, starts)
    phi = np.array([start.phi for start in starts])
    side = np.array([start.side for start in starts])
    for name, value in limits.held.items():
        rows[kind.unknowns.index(name)] = value
    damping = np.full(len(starts), 1e-3)
    cost, passed = _cost(kind, rows, phi, side, z, power), limits.passed(rows, phi)
    open_ = np.arange(len(starts))
    for _ in range(_STEPS):
        here = rows[:, open_], phi[open_], side[open_], damping[open_]
        trial_rows, trial_phi = _step(z, timing, limits, here, passed[open_], power)
        trial, beyond = _cost(kind, trial_rows, trial_phi, side[open_], z, power), limits.passed(trial_rows, trial_phi)
        outside = passed[open_] > 0
        nearer = np.where(outside, beyond < passed[open_], (beyond == 0) & (trial < cost[open_]))
        better = nearer & np.isfinite(trial)
        with np.errstate(invalid="ignore"):
            small = better & ~outside & (cost[open_] - trial <= _GAIN * cost[open_])
        at = open_[better]
        rows[:, at], phi[at], cost[at], passed[at] = (
            trial_rows[:, better],
            trial_phi[better],
            trial[better],
            beyond[better],
        )
        damping[open_] = np.clip(np.where(better, here[3] * 0.3, here[3] * 4.0), 1e-12, 1e6)
        met = (cost[open_] < 1e-14**power) & (passed[open_] == 0)
        open_ = open_[~(small | met | (damping[open_] >= _STUCK))]
        if not len(open_) or (met.any() and len(z) > len(rows)):
            break
    errors = np.where(passed == 0, np.sqrt(_cost(kind, rows, phi, side, z) / len(z)), np.inf)
    return [
        Fit(kind=kind, row=rows[:, n], side=float(side[n]), phi=phi[n], error=float(errors[n]))
        for n in np.flatnonzero(errors < np.inf)
    ]


def _step(
    z: Complexes,
    timing: Reals | None,
    limits: FourBarLimits,
    here: tuple[Reals, Reals, Reals, Reals],
    passed: Reals,
    power: int,
) -> tuple[Reals, Reals]:
    """The next numbers and crank angles of linkages, from their numbers, crank angles, branches and dampings."""
    rows, phi, side, damping = here
    curve = curve_points(limits.kind, rows[:, :, None], phi, side[:, None], slopes=True)
    by_sizes, by_crank = np.nan_to_num(curve.by_sizes) * limits.free[:, None, None], np.nan_to_num(curve.by_crank)
    rest = np.nan_to_num(curve.z - z)
    if timing is None:
        normal = 1j * by_crank / np.maximum(np.abs(by_crank), 1e-12)
        value = np.real(np.conj(normal) * rest)
        matrix = np.real(np.conj(normal) * by_sizes).transpose(1, 2, 0)
    else:
        slopes = np.concatenate([by_sizes, by_crank[None]]).transpose(1, 2, 0)
        value = np.concatenate([rest.real, rest.imag], axis=1)
        matrix = np.concatenate([slopes.real, slopes.imag], axis=1)
    if power > 2:  # weights that make squares powers; by the second derivative, so that no step is too long
        distance = np.abs(rest) / np.maximum(np.abs(rest).max(axis=1, keepdims=True), 1e-300)
        weights = np.tile(distance ** (power / 2 - 1), (1, value.shape[1] // len(z)))
        value, matrix = value * weights / np.sqrt(power - 1), matrix * weights[:, :, None] * np.sqrt(power - 1)
    gram = matrix.transpose(0, 2, 1) @ matrix
    right = np.einsum("nij,ni->nj", matrix, value)
    weight = np.einsum("njj->nj", gram) + 1e-9
    gram = gram + damping[:, None, None] * np.einsum("nj,jk->njk", weight, np.eye(weight.shape[1]))
    step = -np.linalg.solve(gram, right[:, :, None])[:, :, 0]
    step = limits.kept(rows, phi, gram, step, np.where(passed > 0, 1 / (1 + 100 * damping), 1.0))
    change = step[:, : len(rows)]
    if timing is not None:
        return rows + change.T, phi + step[:, -1:]
    moved = rest + np.einsum("knm,nk->nm", by_sizes, change)
    along = -np.real(np.conj(by_crank) * moved) / np.maximum(np.abs(by_crank) ** 2, 1e-12)
    return rows + change.T, phi + np.clip(along, -0.3, 0.3)


def _cost(kind: FourBarKind, rows: Reals, phi: Reals, side: Reals, z: Complexes, power: int = 2) -> Reals:
    """The sum of powers of distances of each start; infinite where it cannot be assembled or a length is too small."""
    w = curve_points(kind, rows[:, :, None], phi, side[:, None]).z
    cost = np.sum(np.abs(w - z) ** power, axis=1)
    lengths = rows[[kind.unknowns.index(name) for name in kind.links if name in kind.unknowns]]
    bad = ~np.isfinite(cost) | (lengths < 1e-3).any(axis=0) | (np.abs(rows) > 100).any(axis=0)
    return np.where(bad, np.inf, cost)


def fit_path(
    task: PathTask, demands: Demands, *, number: int = 6, sliders: bool = True, progress: Progress | None = None
) -> SynthesisResult:
    """The linkages nearest to many points or a closed curve, judged by how near they really come.

    Raises `SynthesisError` for fewer than five points.
    """
    if len(task) < 5:
        raise SynthesisError("a whole curve needs at least five points, not {count}", count=len(task))
    timing = np.array(task.crank_angles) if task.crank_angles else None
    fits = _fits(task, demands, timing, 4 * number, kinds=_kinds(sliders=sliders), power=_POWER, progress=progress)
    limit = demands.tolerance if demands.tolerance > 1e-6 else ACCEPTED
    accepted, rejected = _judged_fits(task, replace(demands, tolerance=limit), fits, number, progress)
    accepted = in_order_of(accepted, ["error"])
    note = message(
        "So many points are met by least squares; designs that come nearer than {limit:g} of the size are accepted.",
        limit=limit,
    )
    counted = SolutionCount(what=message("linkages"), theorem=0, found=len(fits), real=len(fits))
    notes = [note, *order_notes((*accepted, *rejected), demands)]
    if not accepted:

        def again(task: PathTask, demands: Demands, limits: Demands) -> list[Design]:
            fits = _fits(task, limits, timing, 4 * number, kinds=_kinds(sliders=sliders), power=_POWER)
            return [each for fit in fits for each in _judged(task, replace(demands, tolerance=limit), fit)]

        notes += tightest_sought(task, demands, again)
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=counted, notes=tuple(notes))


def _kinds(*, sliders: bool) -> tuple[FourBarKind, ...]:
    return (FOUR_BAR, SLIDER_CRANK) if sliders else (FOUR_BAR,)


def _fits(task: PathTask, demands: Demands, timing: Reals | None, number: int, **more: Any) -> list[Fit]:
    pivots = tuple(complex(*p) for p in task.fixed_pivots)
    return fit_curve(task.z, closed=task.closed, timing=timing, number=number, demands=demands, pivots=pivots, **more)


def fit_open_points(
    task: PathTask,
    demands: Demands,
    parameters: int,
    *,
    number: int = 6,
    sliders: bool = True,
    progress: Progress | None = None,
) -> SynthesisResult:
    """Up to eight points of an open curve: some of the infinitely many linkages that meet them exactly.

    So many parameters of the four-bars are left free by points, pivots and lengths.

    Curves of the atlas, or pieces of them, pass similar points in their order; least squares makes many of them meet
    the points. If none does, the nearest are rejected designs.
    """
    order = sought_order(task, demands)
    fits = _fits(task, demands, None, 4 * number, kinds=_kinds(sliders=sliders), order=order, progress=progress)
    exact = [fit for fit in fits if fit.error < _MET]
    accepted, rejected = _judged_fits(task, demands, exact or fits[:number], len(fits), progress)
    note = message(
        "The points and what is given leave finitely many linkages, or none; least squares from linkages with similar "
        "curves led to {count} of them."
        if parameters <= 0
        else "There are infinitely many solutions (free parameters: {parameters}): {count} of them were found by least "
        "squares from linkages with similar curves; others may be better."
        if exact
        else "Without demands there are infinitely many solutions (free parameters: {parameters}); least squares from "
        "linkages with similar curves led to none that passes the points within the demands.",
        parameters=parameters,
        count=len(exact),
    )
    theorem = None if parameters > 0 else 0
    counted = SolutionCount(what=message("linkages"), theorem=theorem, found=len(exact), real=len(exact))
    notes = (note, *order_notes((*accepted, *rejected), demands))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=counted, notes=notes)


def tightest_of_points(
    task: PathTask, demands: Demands, *, number: int, sliders: bool, progress: Progress | None
) -> list[Message]:
    """Of points that no design passes within the demands: the one without which the most are found, sought freely."""

    def again(task: PathTask, demands: Demands, limits: Demands) -> list[Design]:
        order = sought_order(task, limits)
        fits = _fits(task, limits, None, 4 * number, kinds=_kinds(sliders=sliders), order=order, progress=progress)
        return [each for fit in fits if fit.error < _MET for each in _judged(task, demands, fit)]

    return tightest_sought(task, demands, again)


def _judged_fits(
    task: PathTask, demands: Demands, fits: list[Fit], number: int, progress: Progress | None
) -> tuple[tuple[Design, ...], tuple[Design, ...]]:
    """Accepted and rejected designs of fits, until so many are accepted."""
    designs: list[Design] = []
    for k, fit in enumerate(fits, 1):
        designs += _judged(task, demands, fit)
        if progress is not None:
            progress(k, len(fits))
        if sum(design.verdict.accepted for design in designs) == number:
            break
    return ranked(designs)


def linkages_of(fit: Fit, *, unit: str = "mm", named: bool = False) -> list[Linkage]:
    """The linkage of a fit in the position of its first point; with ``named`` its crank is the link that drives."""
    r = {name: float(value) for name, value in fit.kind.named(fit.row).items()}
    phi = float(fit.phi[0])
    pivot = complex(r["a0x"], r["a0y"])
    pin = pivot + r["a"] * complex(np.exp(1j * phi))
    point = complex(curve_points(fit.kind, fit.row[:, None], fit.phi[:1], fit.side).z[0])
    theta = (point - pin) / complex(r["u"], r["v"])
    far = pin + r["b"] * theta
    own = GuidingDyad(CRANK, pin, pivot)
    guide = fit.kind.guide(r, far)
    if named or len(fit.kind.pivots) < 2:
        return [linkage_of_dyads(own, guide, point, unit)]
    return list(four_bar_linkages(own, guide, point, unit=unit))


def _judged(task: PathTask, demands: Demands, fit: Fit) -> list[Design]:
    try:
        linkages = linkages_of(fit, unit=task.unit, named=bool(demands.lengths))
    except LinkageError:
        return []

    def targets(linkage: Linkage) -> Targets:
        size, curve = _extent(task.z), GuidedCurve.of(task)
        if not task.crank_angles:
            return Targets((Probe("P"),), task.z[:, None], size, curve=curve, ranks=task.order)
        timing = np.array(task.crank_angles)
        crank = size * np.exp(1j * (linkage.required_pose["crank"].angle + timing - timing[0]))
        return Targets(
            (Probe("P"), Probe(link="crank", length=size)), np.stack([task.z, crank], axis=1), size, curve=curve
        )

    return [best_of(linkages[:1] if task.crank_angles else linkages, targets, demands, fit.kind.name)]
