"""Whole curves: linkages whose coupler point comes as near as possible to many points.

An atlas of normalised coupler curves gives the neighbours of the curve wanted, whatever its place, size, rotation and
mirror image; least squares with exact derivatives makes the best of each. docs/theory/synthesis-curves.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import message
from gruebler.design.synthesis.curve_matching import PLACES, CurveMatch, best_matches, drive_angles, evenly_along
from gruebler.design.synthesis.dyads import CRANK, SLIDER, GuidingDyad
from gruebler.design.synthesis.four_bar_curves import FOUR_BAR, SLIDER_CRANK, FourBarKind, curve_points
from gruebler.design.synthesis.judging import Demands, best_of
from gruebler.design.synthesis.positions import four_bar_linkages, linkage_of_dyads, ranked
from gruebler.design.synthesis.results import Design, Progress, SolutionCount, SynthesisResult, in_order_of
from gruebler.design.synthesis.targets import Probe, Targets
from gruebler.design.synthesis.tasks import MOST_POINTS, PathTask
from gruebler.mechanics.linkages import Linkage

_STARTS = (40, 240)  # neighbours that are made better; a triangle needs the more
_NEAR = 1e-3  # of the size: if the best of the first come nearer, more are not tried
_STEPS = 300
_MARGIN = 1e-6  # sizes: so far from the limit of a crank that turns fully
_MET = 1e-10  # of the size: fits that come so near are equally good, and the most alike at the start comes first
ACCEPTED = 0.05
"""A whole curve is accepted if it is missed by less than this part of its size, unless the caller says otherwise."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveAtlas:
    """Coupler curves of linkages whose crank turns fully: crank 1, its pivot at the origin."""

    kind: FourBarKind
    rows: Reals
    """(unknowns, linkages)"""
    side: Reals
    phi: Reals
    """(linkages, places) crank angles of places evenly along the curve."""
    z: Complexes
    """(linkages, places)"""


def _halton(count: int, base: int) -> Reals:
    """Van der Corput's numbers: spread evenly, the same everywhere."""
    n = np.arange(1, count + 1)
    values, part = np.zeros(count), 1.0
    while n.any():
        part /= base
        values += part * (n % base)
        n = n // base
    return values


@cache
def atlas(kind: FourBarKind, count: int = 0) -> CurveAtlas:
    """The atlas, made at its first use from so many trials; of the four-bars the tenth part turns fully. Cost: 1 s."""
    count = count or (90_000 if kind is FOUR_BAR else 12_000)
    first, second, third, fourth, fifth = (_halton(count, base) for base in (2, 3, 5, 7, 11))
    spread = np.log(6.0)
    if kind is FOUR_BAR:
        b, c, d = (np.exp(spread * (2 * v - 0.7)) for v in (first, second, third))
        zero = 0 * b
        rows = np.stack([zero, zero, d, zero, zero + 1, b, c, zero, zero])
    else:
        b, h = np.exp(spread * first) * 1.05, 3 * second
        zero = 0 * b
        rows = np.stack([zero, zero, zero, h, zero + 1, b, zero, zero])
    reach = np.maximum(rows[kind.unknowns.index("b")], 1.0)
    w = reach * (0.5 + 2.0 * np.sqrt(fourth) * np.exp(2j * np.pi * fifth))
    rows[kind.unknowns.index("u")], rows[kind.unknowns.index("v")] = w.real, w.imag
    rows = rows[:, _turns(kind, rows)]
    side = np.where(np.arange(rows.shape[1]) % 2, 1.0, -1.0)
    phi = np.linspace(0, 2 * np.pi, 2 * PLACES + 1)
    z = curve_points(kind, rows[:, :, None], phi[None, :], side[:, None]).z
    good = np.isfinite(z).all(axis=1)
    rows, side, z = rows[:, good], side[good], z[good]
    at = evenly_along(z, phi)
    return CurveAtlas(
        kind=kind, rows=rows, side=side, phi=at, z=curve_points(kind, rows[:, :, None], at, side[:, None]).z
    )


class _Start(NamedTuple):
    """A neighbour of the target, placed on it."""

    gap: float
    """What the best similarity leaves, relative to the target's spread."""
    row: Reals
    side: float
    phi: Reals
    """(points,) crank angles of the target's points, in the plane."""


def _neighbours(kind: FourBarKind, z: Complexes, closed: bool, number: int) -> list[_Start]:
    """The nearest curves of the atlas, or pieces of them, up to a similarity."""
    book = atlas(kind)
    return [_placed(book, match) for match in best_matches(book.z, z, number, closed=closed)]


def _placed(book: CurveAtlas, match: CurveMatch) -> _Start:
    """A curve of the atlas turned, scaled and shifted onto the target."""
    n = match.number
    row = _transformed(book.kind, book.rows[:, n], match.turn, match.shift)
    angle = drive_angles(book.phi[n], match.at) + float(np.angle(match.turn))
    side = float(book.side[n])
    if match.mirrored:
        row, angle, side = _mirrored(book.kind, row), -angle, -side
    return _Start(match.gap, row, side, angle)


def _transformed(kind: FourBarKind, row: Reals, turn: complex, shift: complex) -> Reals:
    r = dict(zip(kind.unknowns, row, strict=True))
    scale = abs(turn)
    for name in ("a", "b", "c", "u", "v"):
        if name in r:
            r[name] *= scale
    pairs = [("a0x", "a0y")] + ([("b0x", "b0y")] if "b0x" in r else [])
    for x, y in pairs:
        z = turn * complex(r[x], r[y]) + shift
        r[x], r[y] = z.real, z.imag
    if "h" in r:
        r["angle"] += float(np.angle(turn))
        r["h"] = r["h"] * scale + float(np.imag(np.exp(-1j * r["angle"]) * shift))
    return np.array([r[name] for name in kind.unknowns])


def _mirrored(kind: FourBarKind, row: Reals) -> Reals:
    """In the x axis; the branch of a four-bar changes, and that of a slider-crank stays but for the direction."""
    r = dict(zip(kind.unknowns, row, strict=True))
    for name in ("a0y", "b0y", "v", "h", "angle"):
        if name in r:
            r[name] = -r[name]
    return np.array([r[name] for name in kind.unknowns])


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
) -> list[Fit]:
    """The linkages whose coupler curves come nearest to points in the mean, the best first.

    Args:
        z: (points,) x + iy, in order.
        closed: whether the curve returns to its begin.
        timing: (points,) crank angles, of which differences count; without them the crank angle of each point is free.
        kinds: of linkages.
        starts: how many neighbours of each kind are made better; by default 40, and 240 if these do not come near, or
            too few of them meet fewer than nine points of an open curve exactly.
        number: how many are returned.

    Cost: 1 s for the atlas at the first call, then about 0.5 s, 2 s for curves that no linkage comes near.
    """
    if starts is None:
        first, more = _STARTS
        fits = fit_curve(z, closed=closed, timing=timing, kinds=kinds, starts=first, number=number)
        enough, near = (number, _MET) if not closed and len(z) < MOST_POINTS else (1, _NEAR)
        if timing is not None or (len(fits) >= enough and fits[enough - 1].error < near):
            return fits
        return fit_curve(z, closed=closed, timing=timing, kinds=kinds, starts=more, number=number)
    size = _extent(z)
    middle = z.mean()
    reduced = (z - middle) / size
    fits = []
    for kind in kinds:
        _starts = (
            _neighbours(kind, reduced, closed, starts)
            if timing is None
            else _timed_neighbours(kind, reduced, timing, starts)
        )
        fits += _improved(kind, reduced, _starts, timing, turning=closed)
    fits.sort(key=lambda fit: max(fit.error, _MET))
    chosen: list[Fit] = []
    for fit in fits:
        if all(fit.kind is not o.kind or np.abs(_shape(fit) - _shape(o)).max() > 0.02 for o in chosen):
            chosen.append(fit)
        if len(chosen) == number:
            break
    return [replace(fit, row=_transformed(fit.kind, fit.row, complex(size), complex(middle))) for fit in chosen]


def _shape(fit: Fit) -> Reals:
    """Lengths that do not depend on place and rotation, logarithmically."""
    r = dict(zip(fit.kind.unknowns, fit.row, strict=True))
    frame = np.hypot(r["b0x"] - r["a0x"], r["b0y"] - r["a0y"]) if "b0x" in r else 1.0
    lengths = [r["a"], r["b"], r.get("c", 1.0), frame, np.hypot(r["u"], r["v"])]
    return np.asarray(np.log(np.array(lengths) + 1e-3))


def _extent(z: Complexes) -> float:
    """The longest side of the smallest upright rectangle about points."""
    return float(max(np.ptp(z.real), np.ptp(z.imag)))


def _timed_neighbours(kind: FourBarKind, z: Complexes, timing: Reals, number: int) -> list[_Start]:
    """Curves of the atlas whose points at these crank angles are similar to the target."""
    book = atlas(kind, 12000)
    starts = []
    target = z - z.mean()
    energy = float(np.sum(np.abs(target) ** 2))
    for mirrored in (False, True):
        wanted, turned = (np.conj(target), -(timing - timing[0])) if mirrored else (target, timing - timing[0])
        for begin in 2 * np.pi * np.arange(24) / 24:
            angles = begin + turned
            w = curve_points(kind, book.rows[:, :, None], angles[None, :], book.side[:, None]).z
            mean = w.mean(axis=1)
            inner = np.conj(w - mean[:, None]) @ wanted
            spread = np.sum(np.abs(w - mean[:, None]) ** 2, axis=1)
            likeness = np.abs(inner) ** 2 / (spread * energy)
            for n in np.argsort(-likeness)[: max(3, number // 8)]:
                turn = complex(inner[n] / spread[n])
                middle = np.conj(z.mean()) if mirrored else z.mean()
                row = _transformed(kind, book.rows[:, n], turn, complex(middle - turn * mean[n]))
                phi, side = angles + float(np.angle(turn)), float(book.side[n])
                if mirrored:
                    row, phi, side = _mirrored(kind, row), -phi, -side
                starts.append(_Start(1 - float(likeness[n]), row, side, phi))
    starts.sort(key=lambda start: start.gap)
    return starts[:number]


def _improved(
    kind: FourBarKind, z: Complexes, starts: list[_Start], timing: Reals | None, *, turning: bool
) -> list[Fit]:
    """Levenberg and Marquardt's method for all starts at once; free crank angles are eliminated point by point.

    With ``turning`` the crank has to stay one that turns fully.
    """
    if not starts:
        return []
    rows = np.array([start.row for start in starts]).T  # (unknowns, starts)
    phi = np.array([start.phi for start in starts])
    side = np.array([start.side for start in starts])
    if kind is SLIDER_CRANK:
        side = _slider_branches(rows, phi, side, z)
    damping = np.full(len(starts), 1e-3)
    cost = _cost(kind, rows, phi, side, z, turning=turning)
    unknowns = len(kind.unknowns)
    for _ in range(_STEPS):
        curve = curve_points(kind, rows[:, :, None], phi, side[:, None], slopes=True)
        rest = curve.z - z
        if timing is None:
            normal = 1j * curve.by_crank / np.maximum(np.abs(curve.by_crank), 1e-12)
            value = np.real(np.conj(normal) * rest)
            matrix = np.real(np.conj(normal) * curve.by_sizes).transpose(1, 2, 0)
        else:
            slopes = np.concatenate([curve.by_sizes, curve.by_crank[None]]).transpose(1, 2, 0)
            value = np.concatenate([rest.real, rest.imag], axis=1)
            matrix = np.concatenate([slopes.real, slopes.imag], axis=1)
        value, matrix = np.nan_to_num(value), np.nan_to_num(matrix)
        gram = np.einsum("nij,nik->njk", matrix, matrix)
        right = np.einsum("nij,ni->nj", matrix, value)
        weight = np.einsum("njj->nj", gram) + 1e-9
        gram = gram + damping[:, None, None] * np.einsum("nj,jk->njk", weight, np.eye(weight.shape[1]))
        step = -np.linalg.solve(gram, right[:, :, None])[:, :, 0]
        if turning:
            step = _within_limit(kind, rows, gram, step)
        trial_rows = rows + step[:, :unknowns].T
        if timing is None:
            moved = rest + np.einsum("knm,nk->nm", curve.by_sizes, step)
            along = -np.real(np.conj(curve.by_crank) * moved) / np.maximum(np.abs(curve.by_crank) ** 2, 1e-12)
            trial_phi = phi + np.clip(np.nan_to_num(along), -0.3, 0.3)
        else:
            trial_phi = phi + step[:, -1:]
        trial = _cost(kind, trial_rows, trial_phi, side, z, turning=turning)
        better = trial < cost
        rows = np.where(better, trial_rows, rows)
        phi = np.where(better[:, None], trial_phi, phi)
        gain = np.where(better, cost - trial, 0.0)
        cost = np.where(better, trial, cost)
        damping = np.clip(np.where(better, damping * 0.3, damping * 4.0), 1e-12, 1e6)
        met = cost < 1e-28
        if not (((gain > 1e-10 * cost) | (damping < 1e5)) & ~met).any() or (met.any() and len(z) > unknowns):
            break
    errors = np.sqrt(cost / len(z))
    return [
        Fit(kind=kind, row=rows[:, n], side=float(side[n]), phi=phi[n], error=float(errors[n]))
        for n in np.flatnonzero(errors < np.inf)
    ]


def _slider_branches(rows: Reals, phi: Reals, side: Reals, z: Complexes) -> Reals:
    """The branch that lies nearer to the target: a mirror image may or may not change it."""
    costs = [_cost(SLIDER_CRANK, rows, phi, sign * np.ones_like(side), z, turning=False) for sign in (1.0, -1.0)]
    return np.where(costs[0] <= costs[1], 1.0, -1.0)


def _cost(kind: FourBarKind, rows: Reals, phi: Reals, side: Reals, z: Complexes, *, turning: bool) -> Reals:
    """The sum of squared distances of each start; infinite where it cannot be assembled or a length is not positive."""
    w = curve_points(kind, rows[:, :, None], phi, side[:, None]).z
    cost = np.sum(np.abs(w - z) ** 2, axis=1)
    lengths = rows[[kind.unknowns.index(name) for name in ("a", "b", "c") if name in kind.unknowns]]
    bad = ~np.isfinite(cost) | (lengths < 1e-3).any(axis=0) | (np.abs(rows) > 100).any(axis=0)
    if turning:
        bad |= ~_turns(kind, rows)
    return np.where(bad, np.inf, cost)


def _within_limit(kind: FourBarKind, rows: Reals, gram: Reals, step: Reals) -> Reals:
    """(starts, numbers) the steps, those beyond the limit of a crank that turns fully changed to the best along it.

    Curves with corners are drawn by linkages at this limit; a step that is only refused there ends the search.
    """
    step = step.copy()
    unknowns = len(rows)
    slack, slope = _limit_of_turning(kind, rows)
    normal = np.zeros_like(step)
    normal[:, :unknowns] = slope.T
    beyond = slack + np.einsum("nk,nk->n", normal, step) + _MARGIN
    at_limit = (beyond > 0) & np.isfinite(beyond)
    if not at_limit.any():
        return step
    along = np.linalg.solve(gram[at_limit], normal[at_limit][:, :, None])[:, :, 0]
    step[at_limit] -= along * (beyond[at_limit] / np.einsum("nk,nk->n", normal[at_limit], along))[:, None]
    for _ in range(3):  # the limit is curved: back to it
        slack, slope = _limit_of_turning(kind, rows + step[:, :unknowns].T)
        excess = np.where(at_limit, np.maximum(slack + _MARGIN, 0), 0)
        step[:, :unknowns] -= (slope * (excess / np.sum(slope**2, axis=0))).T
    return step


def _limit_of_turning(kind: FourBarKind, rows: Reals) -> tuple[Reals, Reals]:
    """(starts,) a length that is negative where the crank turns fully, by Grashof; (unknowns, starts) its slopes."""
    r = dict(zip(kind.unknowns, rows, strict=True))
    slope = dict.fromkeys(kind.unknowns, np.zeros(rows.shape[1]))
    if kind is SLIDER_CRANK:
        sine, cosine = np.sin(r["angle"]), np.cos(r["angle"])
        offset = r["h"] - (cosine * r["a0y"] - sine * r["a0x"])
        side = np.sign(offset)
        slope |= {"a": np.ones_like(side), "b": -np.ones_like(side), "h": side, "a0x": side * sine}
        slope |= {"a0y": -side * cosine, "angle": side * (sine * r["a0y"] + cosine * r["a0x"])}
        slack = r["a"] + np.abs(offset) - r["b"]
    else:
        x, y = r["b0x"] - r["a0x"], r["b0y"] - r["a0y"]
        frame = np.hypot(x, y)
        lengths = np.stack([r["a"], r["b"], r["c"], frame])
        place = np.arange(4)[:, None]
        shortest = np.where(r["a"] <= frame, 0, 3)  # another one makes the length positive
        sign = -1.0 + 2 * (place == lengths.argmax(axis=0)) + 2 * (place == shortest)
        slack = np.sum(sign * lengths, axis=0)
        slope |= {name: sign[k] for k, name in enumerate("abc")}
        slope |= {"a0x": -sign[3] * x / frame, "a0y": -sign[3] * y / frame}
        slope |= {"b0x": sign[3] * x / frame, "b0y": sign[3] * y / frame}
    return slack, np.array([slope[name] for name in kind.unknowns])


def _turns(kind: FourBarKind, rows: Reals) -> NDArray[np.bool_]:
    """Whether the crank turns fully."""
    return np.asarray(_limit_of_turning(kind, rows)[0] < 0)


def fit_path(task: PathTask, demands: Demands, *, number: int = 6, progress: Progress | None = None) -> SynthesisResult:
    """The linkages nearest to many points or a closed curve, judged by how near they really come.

    Raises `SynthesisError` for fewer than five points.
    """
    if len(task) < 5:
        raise SynthesisError("a whole curve needs at least five points, not {count}", count=len(task))
    timing = np.array(task.crank_angles) if task.crank_angles else None
    fits = fit_curve(task.z, closed=task.closed, timing=timing, number=4 * number)
    limit = demands.tolerance if demands.tolerance > 1e-6 else ACCEPTED
    accepted, rejected = _judged_fits(task, replace(demands, tolerance=limit), fits, number, progress)
    accepted = in_order_of(accepted, ["error"])
    note = message(
        "So many points are met by least squares; designs that come nearer than {limit:g} of the size are accepted.",
        limit=limit,
    )
    count = SolutionCount(what=message("linkages"), theorem=0, found=len(fits), real=len(fits))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=(note,))


def fit_open_points(
    task: PathTask, demands: Demands, *, number: int = 6, progress: Progress | None = None
) -> SynthesisResult:
    """Six to eight points of an open curve: some of the infinitely many linkages that meet them exactly.

    Curves of the atlas, or pieces of them, pass similar points in their order; least squares makes many of them meet
    the points. If none does, the nearest are rejected designs.
    """
    fits = fit_curve(task.z, closed=False, number=4 * number)
    exact = [fit for fit in fits if fit.error < _MET]
    accepted, rejected = _judged_fits(task, demands, exact or fits[:number], len(fits), progress)
    note = message(
        "There are infinitely many solutions, a family of {parameters} parameters: {count} of them were found by least "
        "squares from linkages with similar curves.",
        parameters=MOST_POINTS - len(task),
        count=len(exact),
    )
    count = SolutionCount(what=message("linkages"), theorem=None, found=len(exact), real=len(exact))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=(note,))


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


def linkages_of(fit: Fit, *, unit: str = "mm") -> list[Linkage]:
    """The linkage of a fit in the position of its first point."""
    r = dict(zip(fit.kind.unknowns, (float(v) for v in fit.row), strict=True))
    phi = float(fit.phi[0])
    pivot = complex(r["a0x"], r["a0y"])
    pin = pivot + r["a"] * complex(np.exp(1j * phi))
    point = complex(curve_points(fit.kind, fit.row[:, None], fit.phi[:1], fit.side).z[0])
    theta = (point - pin) / complex(r["u"], r["v"])
    far = pin + r["b"] * theta
    own = GuidingDyad(CRANK, pin, pivot)
    if fit.kind is FOUR_BAR:
        return four_bar_linkages(own, GuidingDyad(CRANK, far, complex(r["b0x"], r["b0y"])), point, unit=unit)
    slide = complex(np.exp(1j * r["angle"]))
    return [linkage_of_dyads(own, GuidingDyad(SLIDER, far, far, slide), point, unit)]


def _judged(task: PathTask, demands: Demands, fit: Fit) -> list[Design]:
    try:
        linkages = linkages_of(fit, unit=task.unit)
    except LinkageError:
        return []

    def targets(linkage: Linkage) -> Targets:
        size = _extent(task.z)
        if not task.crank_angles:
            return Targets((Probe("P"),), task.z[:, None], size)
        timing = np.array(task.crank_angles)
        crank = size * np.exp(1j * (linkage.required_pose["crank"].angle + timing - timing[0]))
        return Targets((Probe("P"), Probe(link="crank", length=size)), np.stack([task.z, crank], axis=1), size)

    return [best_of(linkages[:1] if task.crank_angles else linkages, targets, demands, fit.kind.name)]
