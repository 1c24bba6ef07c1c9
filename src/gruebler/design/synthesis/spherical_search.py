"""The best four-bars on the sphere of a family: a sample of pairs of dyads in closed form, the best of them improved.

docs/theory/synthesis-sphere.md has the equations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from gruebler.base.arrays import Flags, Reals
from gruebler.base.text import Message, joined_by_and, message
from gruebler.design.synthesis.demands import Demands, demands_failed, demands_met, tightest
from gruebler.design.synthesis.pair_facts import PairClosure, motion_of_pairs
from gruebler.design.synthesis.results import MEASURES
from gruebler.design.synthesis.spherical_dyads import GREAT_CIRCLES, SphericalDyad, near_dyads
from gruebler.design.synthesis.spherical_shifts import arc_moves, largest_turn
from gruebler.design.synthesis.target_orders import TargetOrder

LEAST_ARC = 1e-6
APART = 0.02  # radians: axes of two designs that are listed differ by more
_WIDTHS = tuple(0.2 * 0.4**k for k in range(7))  # radians: from the distance of two dyads of a sample down
_MOVES = 8  # to a better pair of dyads of each width
USUAL_ON_SPHERE = ("full-turn", "transmission")
"""By what designs are sorted unless the caller says otherwise."""


def best_sphere_pairs(
    dyads: Sequence[SphericalDyad],
    turns: Reals,
    demands: Demands,
    number: int,
    notes: list[Message],
    sort: Sequence[str],
) -> list[tuple[SphericalDyad, SphericalDyad]]:
    """The pairs of a family that meet the demands, in closed form: the best that differ; those that fail least."""
    costs = _costs(dyads, dyads, turns, demands, sort)
    fails = costs[0]
    notes.append(
        message(
            "Four-bars that meet all demands: {count:,} of {pairs:,} "
            "({dyads} dyads, each with each, driven at either).",
            dyads=len(dyads),
            pairs=len(dyads) * (len(dyads) - 1),
            count=int(np.count_nonzero(fails == 0)),
        )
    )
    notes.append(sphere_resolution(len(dyads), len(turns) + 1, sort))
    if not (fails == 0).any():
        notes += tightest_on_sphere(dyads, dyads, turns, demands)
    ranks = np.lexsort([cost.ravel() for cost in reversed(costs)])
    sampled: list[tuple[SphericalDyad, SphericalDyad]] = []
    for rank in ranks[: 200 * number]:
        i, j = divmod(int(rank), len(dyads))
        pair = dyads[i], dyads[j]
        if i != j and fails[i, j] == fails.ravel()[ranks[0]] and _differs(pair, sampled):
            sampled.append(pair)
        if len(sampled) == number:
            break
    best: list[tuple[SphericalDyad, SphericalDyad]] = []
    for pair in _best_first(
        [*(_improved(pair, turns, demands, sort) for pair in sampled), *sampled], turns, demands, sort
    ):
        if len(best) < number and _differs(pair, best):
            best.append(pair)
    return best


def _improved(
    pair: tuple[SphericalDyad, SphericalDyad],
    turns: Reals,
    demands: Demands,
    sort: Sequence[str],
    *,
    given_first: bool = False,
    to_turn: bool = False,
) -> tuple[SphericalDyad, SphericalDyad]:
    """The best pair nearby: dyads are moved within the family, in ever smaller steps, as long as that helps.

    Both are, or the second alone if the first is given; `to_turn` as of `_costs`.
    """
    for width in _WIDTHS:
        for _ in range(_MOVES):
            first, second = ([dyad, *near_dyads(turns, dyad, width)] for dyad in pair)
            first = first[:1] if given_first else first
            costs = _costs(first, second, turns, demands, sort, given_first=given_first, to_turn=to_turn)
            best = int(np.lexsort([cost.ravel() for cost in reversed(costs)])[0])
            if best == 0:
                break
            pair = first[best // len(second)], second[best % len(second)]
    return pair


def improved_function_dyads(
    frame: SphericalDyad,
    dyads: Sequence[SphericalDyad],
    turns: Reals,
    demands: Demands,
    number: int,
    sort: Sequence[str],
) -> list[SphericalDyad]:
    """Couplers better than those of a sample, in a family that coordinates pairs: the best that differ, each improved.

    Args:
        frame: the arc between the fixed axes, as seen from the crank.
        dyads: the sample: couplers, likewise.
        turns: of the output link as seen from the crank.
        demands: what counts first.
        number: how many of the sample are improved; as many more are led to where their crank turns fully first, since
            that part of the family may be narrower than the sample is fine.
        sort: what is asked for.
    """
    better = []
    for to_turn in (False, True):
        costs = _costs([frame], dyads, turns, demands, sort, given_first=True, to_turn=to_turn)
        chosen: list[tuple[SphericalDyad, SphericalDyad]] = []
        for k in np.lexsort([cost[0] for cost in reversed(costs)]):
            if len(chosen) < number and _differs((frame, dyads[int(k)]), chosen):
                chosen.append((frame, dyads[int(k)]))
        for pair in chosen:
            led = _improved(pair, turns, demands, sort, given_first=True, to_turn=True) if to_turn else pair
            better.append(_improved(led, turns, demands, sort, given_first=True)[1])
    return better


def _costs(
    first: Sequence[SphericalDyad],
    second: Sequence[SphericalDyad],
    turns: Reals,
    demands: Demands,
    sort: Sequence[str],
    *,
    given_first: bool = False,
    to_turn: bool = False,
) -> list[Reals]:
    """(first, second) what is to be small, the most important first: demands that are not met, then what is better.

    Where cranks are led to turn fully, what they lack of it comes before all but the branch.
    """
    looked = _looked_at(first, second, turns, demands, given_first=given_first)
    fails = np.where(looked.folded > LEAST_ARC, demands_failed(looked.met), 99)
    # An arc near 0 or half a circle folds the linkage to a point, as a large ratio does in the plane.
    worst = np.where(np.isnan(looked.transmission), 0.0, np.round(looked.transmission, 6))
    best = fails == fails.min()
    known: Mapping[str, Callable[[], Reals]] = {
        "transmission": lambda: -worst,
        "size-ratio": lambda: _ratio(looked.arcs),
        "sensitivity": lambda: _shifts(first, second, turns, looked.arcs, best, given_first=given_first),
        "full-turn": lambda: np.asarray(1.0 - looked.full, np.float64),
    }
    costs = [fails.astype(np.float64), *(known[name]() for name in (*sort, *USUAL_ON_SPHERE)), -looked.folded]
    if not to_turn:
        return costs
    low, high = looked.closure.low, looked.closure.high
    lack = np.where(looked.full, 0.0, np.maximum(low + 1, 0) + np.maximum(1 - high, 0))
    return [1.0 - (looked.met[0][1] & (looked.folded > LEAST_ARC)), np.nan_to_num(lack, nan=np.inf), *costs]


def tightest_on_sphere(
    first: Sequence[SphericalDyad],
    second: Sequence[SphericalDyad],
    turns: Reals,
    demands: Demands,
    *,
    given_first: bool = False,
) -> list[Message]:
    """The demand without which the most pairs of a sample remain, where none meets all."""
    looked = _looked_at(first, second, turns, demands, given_first=given_first)
    (name, path), *others = looked.met
    return tightest([(name, path & (looked.folded > LEAST_ARC)), *others])


@dataclass(frozen=True, slots=True, kw_only=True)
class _Looked:
    """What the linkages of pairs of dyads do."""

    closure: PairClosure
    arcs: Reals
    met: list[tuple[Message, Flags]]
    """The demands by their names, branch and order first."""
    full: Flags
    transmission: Reals
    folded: Reals
    """How far the arcs are from none, or half a circle."""


def _looked_at(
    first: Sequence[SphericalDyad],
    second: Sequence[SphericalDyad],
    turns: Reals,
    demands: Demands,
    *,
    given_first: bool,
) -> _Looked:
    closure = _closures(first, second, turns)
    with np.errstate(invalid="ignore", divide="ignore"):
        order = None if demands.in_order else TargetOrder.of((None,) * (len(turns) + 1), len(turns) + 1)
        branch, moves, full, transmission = motion_of_pairs(closure, order)
    # Of each axis the end is taken that is nearer to the axis before, as `_axes_of` does; beside a given arc both
    # neighbours are shorter than a quarter of a circle.
    cosines = np.cos(closure.lengths)
    shorter, last = ([1, 3], 2) if given_first else ([0, 1, 2], 3)
    signs = np.prod(np.sign(cosines[shorter]), axis=0)
    cosines[shorter], cosines[last] = np.abs(cosines[shorter]), signs * cosines[last]
    arcs = np.arccos(cosines)
    folded = np.minimum(arcs, pi - arcs).min(axis=0)
    path = (moves if demands.in_order else branch) & np.isfinite(transmission)
    name = message("one branch in the order of the targets") if demands.in_order else message("one branch")
    met = [(name, path | (not demands.one_branch))]
    met += demands_met(demands, full, transmission, _ratio(arcs), np.ones_like(full))
    return _Looked(closure=closure, arcs=arcs, met=met, full=full, transmission=transmission, folded=folded)


def _ratio(arcs: Reals) -> Reals:
    """The longest arc by the shortest."""
    return np.asarray(arcs.max(axis=0) / np.maximum(arcs.min(axis=0), 1e-300))


def _shifts(
    first: Sequence[SphericalDyad],
    second: Sequence[SphericalDyad],
    turns: Reals,
    arcs: Reals,
    which: Flags,
    *,
    given_first: bool,
) -> Reals:
    """(first, second) how far the most sensitive target turns; infinite where it is not asked for."""
    every = np.concatenate([np.eye(3)[None], turns])
    (own, moving), (far, far_moving) = (
        (np.array([dyad.fixed for dyad in dyads]), np.einsum("kij,nj->nki", every, [dyad.moving for dyad in dyads]))
        for dyads in (first, second)
    )
    parts = own[:, None, None], moving[:, None], far_moving[None], far[None, :, None]
    own, pins, far_pins, far = (np.broadcast_to(part, (*which.shape, len(every), 3))[which] for part in parts)
    # Seen from the crank, the frame is the first dyad and the crank the link between the fixed axes.
    axes = np.stack([own, far, far_pins, pins] if given_first else [own, pins, far_pins, far], axis=-2)
    lengths = np.moveaxis(arcs[[3, 2, 1, 0]] if given_first else arcs, 0, -1)[which]
    shifts = np.full(which.shape, np.inf)
    with np.errstate(invalid="ignore", divide="ignore"):
        turned = largest_turn(arc_moves(axes, lengths[:, None], coordinates=given_first))
    shifts[which] = np.nan_to_num(turned.max(axis=-1), nan=np.inf)
    return shifts


def _best_first(
    pairs: Sequence[tuple[SphericalDyad, SphericalDyad]], turns: Reals, demands: Demands, sort: Sequence[str]
) -> list[tuple[SphericalDyad, SphericalDyad]]:
    """The pairs by what is asked for; as they are where nothing is."""
    costs = [[float(cost[0, 0]) for cost in _costs(pair[:1], pair[1:], turns, demands, sort)] for pair in pairs if sort]
    return [pairs[k] for k in sorted(range(len(pairs)), key=costs.__getitem__)] if sort else list(pairs)


def _differs(pair: tuple[SphericalDyad, SphericalDyad], others: Iterable[tuple[SphericalDyad, SphericalDyad]]) -> bool:
    """Whether the axes on the body lie elsewhere than those of other pairs."""
    return all(sum(_gap(p.moving, q.moving) for p, q in zip(pair, other, strict=True)) >= APART for other in others)


def _gap(first: Reals, second: Reals) -> float:
    """The angle of two axes."""
    return float(np.arccos(min(1.0, abs(float(first @ second)))))


def _closures(first: Sequence[SphericalDyad], second: Sequence[SphericalDyad], turns: Reals) -> PairClosure:
    """Where the crank of each pair of dyads can be assembled: cos(A B0) = cos a cos d + sin a sin d cos(phi)."""
    (own, moving), (far, far_moving) = (
        (np.array([dyad.fixed for dyad in dyads]), np.array([dyad.moving for dyad in dyads]))
        for dyads in (first, second)
    )
    # (targets, dyads, 3)
    pins, far_pins = (np.concatenate([p[None], np.einsum("kij,nj->kni", turns, p)]) for p in (moving, far_moving))
    cosines = [
        np.sum(own * moving, axis=1)[:, None],
        moving @ far_moving.T,
        np.sum(far * far_moving, axis=1),
        own @ far.T,
    ]
    a, b, c, d = np.broadcast_arrays(*(np.arccos(np.clip(each, -1, 1)) for each in cosines))
    with np.errstate(invalid="ignore", divide="ignore"):
        low, high = ((np.cos(arc) - np.cos(a) * np.cos(d)) / (np.sin(a) * np.sin(d)) for arc in (b + c, b - c))
        normals = np.cross(own[:, None], far[None])
        across = np.einsum("ijx,kix->ijk", normals, pins) / np.sin(d)[..., None]
        ahead = np.einsum("jx,kix->ijk", far, pins) - np.cos(d)[..., None] * np.cos(a)[..., None]
        angle = np.arctan2(across, ahead / np.sin(d)[..., None])
        arms = np.cross(pins[:, :, None], far[None, None])  # (targets, i, j, 3): A x B0
        side = np.sign(np.einsum("kijx,kjx->ijk", arms, far_pins))
    return PairClosure(
        lengths=np.array([a, b, c, d]),
        low=low,
        high=high,
        angle=angle,
        side=side,
        cosine=lambda x: (
            (np.cos(a) * np.cos(d) + np.sin(a) * np.sin(d) * x - np.cos(b) * np.cos(c)) / (np.sin(b) * np.sin(c))
        ),
    )


_SAMPLED = message(
    "The family was sampled with {dyads:,} dyads, {apart:.1f}° apart on average, and the best that differ by {measure} "
    "improved in steps from {first:.2g} down to {last:.1g} radians; that no other is better is not proved, and "
    "narrower parts of the family can be missed."
)
_ON_CURVE = message(
    "The family was sampled with the {dyads:,} dyads on {circles} great circles, and the best that differ by {measure} "
    "improved in steps from {first:.2g} down to {last:.1g} radians; that no other is better is not proved, and "
    "narrower parts of the family can be missed."
)
_MEASURES = {
    "transmission": MEASURES["transmission"],
    "size-ratio": message("the ratio of the arcs"),
    "sensitivity": message("the sensitivity to wrong arcs"),
    "full-turn": message("the full turn"),
}


def sphere_resolution(dyads: int, positions: int, sort: Sequence[str], times: int = 1) -> Message:
    """How finely the best of a family of three or four orientations are sought.

    Args:
        dyads: how many were taken.
        positions: the number of orientations.
        sort: what is asked for.
        times: how many times the usual sample.
    """
    measures = joined_by_and([_MEASURES[name] for name in sort or USUAL_ON_SPHERE])
    steps = {"measure": measures, "first": _WIDTHS[0], "last": _WIDTHS[-1], "dyads": dyads}
    if positions > 3:
        return _ON_CURVE.filled(circles=GREAT_CIRCLES * times, **steps)
    return _SAMPLED.filled(apart=np.degrees(np.sqrt(2 * pi / dyads)), **steps)
