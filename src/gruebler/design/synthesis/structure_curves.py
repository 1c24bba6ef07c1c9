"""Whole curves fitted by linkages of a crank and dyads, all starts at once, with exact derivatives.

A linkage is its drawing in one position, with the point that traces the curve; docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.curve_matching import Anchors, CurveMatch, best_matches, drive_angles
from gruebler.design.synthesis.drawing_limits import DrawingLimits
from gruebler.design.synthesis.dyad_structures import DyadStructure, assembled_sides, link_motions
from gruebler.design.synthesis.structure_atlas import structure_atlas

_FIRST, _SECOND, _LAST = (1, 10), (3, 30), (16, 300)
"""Of the neighbours each so many-th is improved, by so many steps; the first two at some points of the target."""
_ISLAND = 400  # neighbours whose descendants do not mix with those of others, until all have some
_NEAR = 1e-6  # of the size: a linkage that is nearer and passes all targets in order ends the search
_TRIES, _TRIES_ON_PIVOTS = 2, 4  # with other descendants of the same neighbours, until the curve is met
_WORTH = 5e-3  # of the size: only where the best of a try is as near
_BRED, _BRED_ON_PIVOTS = 4, 8  # times: new linkages from those that there are; those of the atlas have other pivots
_CHILDREN, _POOL = 400, 100  # at most, and no more than there are neighbours; those that have descendants
_BRED_OF_ALL, _POOL_OF_ALL = 6, 30  # the same of all islands together; of each island
_APART = 0.03  # of the size: those of the pool differ by more
_FAVOUR = 1.5  # the better half of the pool has 63 % of the descendants
_SHARES, _STEPS = (0.3, 0.5, 0.7), (0.5, 0.8)  # of places from another one; of a difference of two
_SCATTER = 0.02  # of the size
_CANDIDATES = 4000  # neighbours that are placed to see which of them keep within limits
_ROUND = np.linspace(0, 2 * np.pi, 64, endpoint=False)  # of the crank
_THIN = 40  # points of the target that the first stages look at
_BLOCK = 8_000  # points of curves that are computed at once: their derivatives stay near the processor
_FARTHEST = 0.2  # radians: how far a crank moves at once
_PROBE = 0.1  # of a step: where its curvature is measured
_BENT = 0.375  # of a step: a longer correction for its curvature is not believed
_LEAST, _MOST = 1e-13, 1e8  # damping, relative
_MET, _STILL = 1e-28, 1e-10  # of the squared size; of the cost
_SAME = 1e-4  # of the size: linkages nearer to each other are one


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnCurves:
    """Linkages whose point on one link passes targets; all arrays have one row a linkage."""

    places: Complexes
    """(linkages, joints + 1) of the joints in the drawing, then of the point."""
    turned: Reals
    """(linkages, targets) how far the crank has turned from the drawing at each target."""
    cost: Reals
    """(linkages,) the sum of squared distances."""

    def __getitem__(self, which: NDArray[np.int64]) -> DrawnCurves:
        return DrawnCurves(places=self.places[which], turned=self.turned[which], cost=self.cost[which])


def fit_drawings(limits: DrawingLimits, link: str, z: Complexes, *, closed: bool, number: int) -> DrawnCurves:
    """Linkages whose point on a link is as near to all targets as possible, the best first, each once.

    Args:
        limits: of linkages of a structure, which all of them keep to.
        link: that carries the point.
        z: (targets,) in the order in which they are passed.
        closed: whether the last is followed by the first.
        number: how many neighbours from the atlas are improved.

    Each stands at the first target. None where the atlas has no curves. Cost: 2 to 3 ms a neighbour with what descends
    from it, less where one meets the curve soon, twice as much where the best of them nearly do.
    """
    thin = np.unique(np.linspace(0, len(z) - 1, min(_THIN, len(z))).round().astype(np.int64))
    structure = limits.structure
    fit = _CurveFit(limits, link, z)
    rough = _CurveFit(limits, link, z[thin])

    def improved(curves: DrawnCurves) -> DrawnCurves:
        """The best of them by the first two stages, each once, drawn where they meet the first target."""
        sides, count = assembled_sides(structure, curves.places[:, :-1].T), len(curves.cost)
        for share, steps in (_FIRST, _SECOND):
            own = np.argsort(curves.cost, kind="stable")[: max(1, count // share)]
            sides, before = sides[:, own], curves.turned[own]
            curves = rough.improved_in_parts(curves.places[own], before[:, thin], sides, steps)
            curves = replace(curves, turned=_spread(curves.turned, thin, before))
        return _each_once(_at_first_target(structure, link, curves, sides), _APART * fit.size)

    def bred(pool: DrawnCurves, seed: int, size: int, times: int) -> DrawnCurves:
        """The pool after so many times descendants, of which so many linkages have some."""
        chance = np.random.default_rng(seed)
        for _ in range(times if len(pool.cost) else 0):
            pool = _chosen(structure, pool, size, closed=closed)
            both = [pool, improved(_bred(limits, pool, min(number, _CHILDREN), chance))]
            pool = _each_once(together(both), _APART * fit.size)
        return pool

    def grown(seed: int) -> Iterator[DrawnCurves]:
        """The pools of all islands, then that of their best together."""
        parts = []
        for n, island in enumerate(islands):
            if n == len(firsts):
                firsts.append(improved(island))
            parts.append(bred(firsts[n], seed, _POOL, _BRED_ON_PIVOTS if limits.pivots else _BRED))
            yield parts[-1]
        if len(parts) > 1:
            best = [_chosen(structure, pool, _POOL_OF_ALL, closed=closed) for pool in parts]
            yield bred(_each_once(together(best), _APART * fit.size), seed, _POOL_OF_ALL * len(parts), _BRED_OF_ALL)

    def within(pool: DrawnCurves, share: float) -> NDArray[np.bool_]:
        return pool.cost < len(thin) * (share * fit.size) ** 2

    kinds = _neighbours(limits, link, z, closed=closed, number=number)
    if not kinds:
        nothing = np.zeros((0, structure.joints + 1), np.complex128)
        return DrawnCurves(places=nothing, turned=np.zeros((0, len(z))), cost=np.zeros(0))
    few = number * len(kinds) < _ISLAND
    islands = [together(kinds)] if few or limits.pivots else _islands(kinds, number)
    firsts: list[DrawnCurves] = []
    pools: list[DrawnCurves] = []
    tries = _TRIES_ON_PIVOTS if limits.pivots else 1 if few else _TRIES
    for seed in range(1, 1 + tries):
        for pool in grown(seed):
            pools.append(pool)
            if met := bool((within(pool, _NEAR) & _led_through(structure, pool, closed=closed)).any()):
                break
        if met or not within(pool, _WORTH).any():
            break
    pools += firsts
    share = max(1, min(number, _ISLAND) // _LAST[0])
    best = _each_once(together([_chosen(structure, each, share, closed=closed) for each in pools]), _APART * fit.size)
    if not len(best.cost):
        return best
    sides = assembled_sides(structure, best.places[:, :-1].T)
    best = fit.improved_in_parts(best.places, best.turned, sides, _LAST[1])
    best = _at_first_target(structure, link, best, sides)
    beyond = limits.passed(_rows(best.places), best.turned) > 0
    return _each_once(replace(best, cost=np.where(beyond, np.inf, best.cost)), _SAME * fit.size)


def _islands(kinds: list[DrawnCurves], number: int) -> list[DrawnCurves]:
    """Parts of the neighbours whose descendants do not mix, the most similar ones first, of each kind in turn."""
    parts = [(each, np.arange(len(each.cost))[k : k + _ISLAND]) for k in range(0, number, _ISLAND) for each in kinds]
    return [curves[own] for curves, own in parts if len(own)]


def _bred(limits: DrawingLimits, pool: DrawnCurves, count: int, chance: np.random.Generator) -> DrawnCurves:
    """Linkages with some places of another one, or moved by a part of the difference of two, as much each time."""
    rows, joints = pool.places.shape
    own, other, third = (rows * chance.random((3, count)) ** _FAVOUR).astype(np.int64)
    a, b, c = (pool.places[which] for which in (own, other, third))
    share, step = chance.choice(_SHARES, (count, 1)), chance.choice(_STEPS, (count, 1))
    taken = chance.random((count, joints)) < share
    given = np.where(chance.random((count, 1)) < 1 / 2, b, a + step * (b - c))
    scatter = chance.normal(size=(2, count, joints))
    free = limits.free[::2]
    places = np.where(taken, given, a) + _SCATTER * limits.places.unit * free * (scatter[0] + 1j * scatter[1])
    return DrawnCurves(places=places, turned=pool.turned[own], cost=np.zeros(count))


def _neighbours(limits: DrawingLimits, link: str, z: Complexes, *, closed: bool, number: int) -> list[DrawnCurves]:
    """So many of each kind of drawings: curves are more alike among some kinds than after the improvement."""
    book = structure_atlas(limits.structure)
    of_link = book.link == limits.structure.coupler_links.index(link)
    kinds = [np.flatnonzero(of_link & (book.short == short)) for short in (False, True)]
    return [_alike(limits, own, z, closed=closed, number=number) for own in kinds if len(own)]


def _alike(limits: DrawingLimits, own: NDArray[np.int64], z: Complexes, *, closed: bool, number: int) -> DrawnCurves:
    """Of some curves of the atlas those that are most like the target, placed on it, no drawing twice.

    A given pivot is the origin of the comparison; several are compared as well as the curve, then the joints lie there.
    Where limits are narrow, those come first that are both alike and hardly beyond.
    """
    book = structure_atlas(limits.structure)
    joints, pivots = [*limits.pivots], np.array([*limits.pivots.values()], np.complex128)
    drawn = np.concatenate([book.drawn[own], book.point[own, None]], axis=1)
    single = len(joints) == 1
    origin, given = (drawn[:, joints], pivots[0]) if single else (np.zeros((len(own), 1)), 0j)
    drawn, traced = drawn - origin, np.asarray(book.z[own] - origin, np.complex128)
    anchors = None if single else Anchors(drawn[:, joints], pivots)
    kept: dict[tuple[bytes, bool], CurveMatch] = {}
    most = max(number, _CANDIDATES) if limits.narrow else number
    for match in best_matches(traced, z - given, 2 * most, closed=closed, about_origin=single, anchors=anchors):
        if len(kept) < most:
            kept.setdefault((book.drawn[own[match.number]].tobytes(), match.mirrored), match)
    matches = [*kept.values()]
    numbers, mirrored = np.array([m.number for m in matches]), np.array([[m.mirrored] for m in matches])
    turn, shift = (np.array(each)[:, None] for each in zip(*((m.turn, m.shift) for m in matches), strict=True))
    at = turn * drawn[numbers] + shift
    angles = drive_angles(book.turned[own[numbers]].astype(np.float64), np.array([m.at for m in matches]))
    places = np.where(mirrored, np.conj(at), at) + given
    places[:, joints] = pivots
    gaps = np.array([m.gap for m in matches])
    curves = DrawnCurves(places=places, turned=np.where(mirrored, -angles, angles), cost=gaps)
    if not limits.narrow:
        return curves
    beyond = limits.passed(_rows(curves.places), curves.turned)
    return curves[np.argsort(np.sqrt(np.maximum(curves.cost, 0)) + beyond, kind="stable")[:number]]


def _spread(turned: Reals, thin: NDArray[np.int64], before: Reals) -> Reals:
    """Crank angles at all targets from new ones at some: what has changed there, between them in proportion."""
    every = np.arange(before.shape[1])
    return np.asarray(before + np.stack([np.interp(every, thin, row) for row in turned - before[:, thin]]))


def _at_first_target(structure: DyadStructure, link: str, curves: DrawnCurves, sides: Reals) -> DrawnCurves:
    """The same linkages drawn where they meet the first target, on the sides on which they meet all of them."""
    chain = structure.mechanism.chain
    drawn = curves.places[:, :-1].T
    motions = link_motions(structure, drawn, curves.turned[:, :1], sides)
    owners = [joint.links[0] for joint in chain.joints] + [link]
    places = [
        (rotation * place[:, None] + shift)[:, 0]
        for place, (rotation, shift) in zip(curves.places.T, (motions[owner] for owner in owners), strict=True)
    ]
    return DrawnCurves(places=np.stack(places, axis=1), turned=curves.turned - curves.turned[:, :1], cost=curves.cost)


def together(parts: list[DrawnCurves]) -> DrawnCurves:
    """All linkages of the parts."""
    columns = zip(*((part.places, part.turned, part.cost) for part in parts), strict=True)
    places, turned, cost = map(np.concatenate, columns)
    return DrawnCurves(places=places, turned=turned, cost=cost)


def _led_through(structure: DyadStructure, curves: DrawnCurves, *, closed: bool) -> NDArray[np.bool_]:
    """Whether the crank turns one way from target to target, of a closed curve once round without stopping."""
    turned = np.where(curves.turned[:, -1:] < curves.turned[:, :1], -curves.turned, curves.turned)
    if not closed:
        return np.asarray((np.diff(turned) > 0).all(axis=1))
    turned = np.append(turned, turned[:, :1] + 2 * np.pi, axis=1)
    motions = link_motions(structure, curves.places[:, :-1].T, _ROUND[None])
    assembled = np.isfinite(sum(rotation for rotation, _ in motions.values())).all(axis=1)
    return np.asarray((np.diff(turned) > 0).all(axis=1) & assembled)


def _chosen(structure: DyadStructure, curves: DrawnCurves, count: int, *, closed: bool) -> DrawnCurves:
    """The first ones, half of them such as are led through all targets, if there are so many."""
    led = np.flatnonzero(_led_through(structure, curves, closed=closed))[: count // 2]
    return curves[np.array([*dict.fromkeys([*led, *range(len(curves.cost))])][:count], np.int64)]


def _each_once(curves: DrawnCurves, apart: float) -> DrawnCurves:
    """The best first, without those that cannot be assembled, and without any that is no further from a better one."""
    kept: list[int] = []
    for n in np.argsort(curves.cost, kind="stable"):
        if not np.isfinite(curves.cost[n]):
            break
        if not kept or np.abs(curves.places[kept] - curves.places[n]).max(axis=1).min() > apart:
            kept.append(int(n))
    return curves[np.array(kept, np.int64)]


class _CurveFit:
    """Linkages improved by least squares: Levenberg and Marquardt's method with geodesic acceleration.

    The crank angle of each target is eliminated: only the distance across the curve counts. A linkage beyond a limit
    comes back first, with the least change of its curve; then no step passes a limit.
    """

    def __init__(self, limits: DrawingLimits, link: str, z: Complexes) -> None:
        self.limits, self.structure, self.link, self.z = limits, limits.structure, link, z
        self.size = float(max(np.ptp(z.real), np.ptp(z.imag)))

    def _drawn(
        self, places: Complexes, turned: Reals, sides: Reals
    ) -> tuple[NDArray[np.int64], NDArray[np.int64], Complexes, Reals, Reals, int]:
        """What the core takes of linkages."""
        drive, dyads = self.structure.drawn_program
        own = np.ascontiguousarray(places), np.ascontiguousarray(sides), np.ascontiguousarray(turned)
        return drive, dyads, *own, self.structure.placed_links.index(self.link)

    def slid(self, places: Complexes, turned: Reals, sides: Reals, times: int) -> tuple[Reals, Reals]:
        """Crank angles nearer to where the point is nearest to its targets, and the cost there."""
        for _ in range(times):
            points, (rate,) = _core.trace_slopes(*self._drawn(places, turned, sides), False)
            turned = turned + _towards(rate, points - self.z)
        cost = np.sum(np.abs(_core.trace_point(*self._drawn(places, turned, sides)) - self.z) ** 2, axis=1)
        return turned, np.where(np.isfinite(cost), cost, np.inf)

    def improved_in_parts(self, places: Complexes, turned: Reals, sides: Reals, steps: int) -> DrawnCurves:
        """The same for many linkages, some at once, so that their numbers stay near the processor."""
        rows = max(1, _BLOCK // turned.shape[1])
        parts = [slice(k, k + rows) for k in range(0, len(places), rows)]
        done = [self.improved(places[part], turned[part], sides[:, part], steps) for part in parts]
        return together([DrawnCurves(places=p, turned=t, cost=c) for p, t, c in done])

    def improved(self, places: Complexes, turned: Reals, sides: Reals, steps: int) -> tuple[Complexes, Reals, Reals]:
        """Places, crank angles and costs after so many steps, fewer where nothing is gained any more.

        What passes limits is part of the costs.
        """
        places = places.copy()
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            turned, cost = self.slid(places, turned, sides, 3)
            passed = self.limits.passed(_rows(places), turned)
            damping = np.full(len(places), 1e-3)
            active = np.isfinite(cost)
            for _ in range(steps):
                own = np.flatnonzero(active)
                if not len(own):
                    break
                change, angles = self._step(places[own], turned[own], sides[:, own], damping[own], passed[own])
                trial = places[own] + change
                angles, least = self.slid(trial, angles, sides[:, own], 1)
                beyond, outside = self.limits.passed(_rows(trial), angles), passed[own] > 0
                good = np.where(outside, beyond < passed[own], (beyond == 0) & (least < cost[own])) & np.isfinite(least)
                still = good & ~outside & (cost[own] - least < _STILL * least)
                damping[own] = np.where(good, np.maximum(0.3 * damping[own], _LEAST), 5 * damping[own])
                better = own[good]
                places[better], turned[better], cost[better] = trial[good], angles[good], least[good]
                passed[better] = beyond[good]
                met = (passed[own] == 0) & (cost[own] < _MET * self.size**2 * len(self.z))
                active[own[still | met | (damping[own] > _MOST)]] = False
        return places, turned, cost + len(self.z) * (self.size * passed) ** 2

    def _step(
        self, places: Complexes, turned: Reals, sides: Reals, damping: Reals, passed: Reals
    ) -> tuple[Complexes, Reals]:
        """The change of all places, and the crank angles after it."""
        points, slopes = _core.trace_slopes(*self._drawn(places, turned, sides), True)
        by_places, rate = slopes[:-1] * self.limits.free[:, None, None], slopes[-1]
        normal = 1j * rate / (np.abs(rate) + 1e-300)
        across = np.real(np.conj(normal) * by_places).transpose(1, 0, 2)
        gram = across @ across.transpose(0, 2, 1)
        numbers = gram.shape[1]
        weight = np.einsum("nkk->n", gram) / numbers + 1e-300
        gram += (damping * weight)[:, None, None] * np.eye(numbers)
        gram[~np.isfinite(gram).all(axis=(1, 2))] = np.eye(numbers)

        def solved(errors: Complexes) -> tuple[Reals, Complexes, Reals]:
            """The change of places that takes errors away, what it leaves of them, how the cranks make up for it."""
            right = across @ np.real(np.conj(normal) * errors)[:, :, None]
            change = -np.nan_to_num(np.linalg.solve(gram, right)[:, :, 0])
            left = errors + np.einsum("kni,nk->ni", by_places, change)
            return change, left, _towards(rate, left)

        errors = points - self.z
        change, left, slide = solved(errors)
        # The curvature along the step, and the correction for it: steps in curved valleys become longer.
        near = _core.trace_point(*self._drawn(places + _PROBE * _paired(change), turned + _PROBE * slide, sides))
        straight = left - errors + rate * slide
        bend = 2 / _PROBE * ((near - points) / _PROBE - straight)
        further, _, more = solved(bend)
        believed = np.linalg.norm(further, axis=1) < 2 * _BENT * np.linalg.norm(change, axis=1)
        believed &= np.isfinite(bend).all(axis=1)
        change += np.where(believed[:, None], further / 2, 0.0)
        slide += np.where(believed[:, None], more / 2, 0.0)
        share = np.where(passed > 0, 1 / (1 + 100 * damping), 1.0)
        kept = self.limits.kept(_rows(places), turned, gram, change, share)
        if len(bent := np.flatnonzero((kept != change).any(axis=1))):
            change[bent] = kept[bent]
            left = errors[bent] + np.einsum("kni,nk->ni", by_places[:, bent], change[bent])
            slide[bent] = _towards(rate[bent], left)
        return _paired(change), turned + np.clip(slide, -_FARTHEST, _FARTHEST)


def _towards(rate: Complexes, errors: Complexes) -> Reals:
    """How far a crank turns until the point is nearest to its target."""
    turn = -np.real(np.conj(rate) * errors) / (np.abs(rate) ** 2 + 1e-300)
    return np.asarray(np.clip(turn, -_FARTHEST, _FARTHEST))


def _rows(places: Complexes) -> Reals:
    """(numbers, linkages) x, y of places in turn."""
    return np.stack([places.real, places.imag], axis=2).reshape(len(places), -1).T


def _paired(numbers: Reals) -> Complexes:
    """x, y of places as complex numbers."""
    return np.asarray(numbers[:, 0::2] + 1j * numbers[:, 1::2])
