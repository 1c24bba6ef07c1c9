"""Four-bars on the sphere that turn a body through orientations, and what any of them does.

docs/theory/synthesis-sphere.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import permutations
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Flags, Reals, compared_by_value
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.judging import transmission_fault
from gruebler.design.synthesis.pair_facts import PairClosure, motion_of_pairs, shortest_arc
from gruebler.design.synthesis.results import TOO_SLENDER, DesignVerdict, SolutionCount
from gruebler.design.synthesis.spherical_dyads import (
    COMPLEX_DYADS,
    MOST_ORIENTATIONS,
    SphericalDyad,
    displacements,
    family_dyads,
    five_orientation_dyads,
    near_dyads,
)
from gruebler.design.synthesis.spherical_shifts import (
    SphericalSensitivity,
    arc_moves,
    largest_turn,
    spherical_sensitivity,
)
from gruebler.design.synthesis.target_orders import TargetOrder
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.spherical_four_bar import SphericalFourBar
from gruebler.structure.mechanism import Mechanism

LEAST_ARC = 1e-6
APART = 0.02  # radians: axes of two designs that are listed differ by more
_WIDTHS = tuple(0.2 * 0.4**k for k in range(7))  # radians: from the distance of two dyads of a sample down
_MOVES = 8  # to a better pair of dyads of each width
_ROWS = 33  # poses from one target to the next
_TEXT = "spherical: R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); drive=R(frame-crank)"


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class SphericalDesign:
    """A four-bar on the sphere, with what it really does."""

    four_bar: SphericalFourBar
    pins: Reals
    """(targets, 4, 3) the axes A0, A, B, B0 at each target."""
    coordinates: bool
    """Whether it coordinates angles, not turns a body."""
    branch: str
    """+ or -, as of `SphericalFourBar`."""
    drives: tuple[float, ...]
    """The crank angle at each target, counted from the arc of the frame."""
    outputs: tuple[float, ...]
    """The angle of the output there, counted as by `SphericalFourBar`."""
    verdict: DesignVerdict

    @property
    def axes(self) -> Reals:
        """(4, 3) of A0, A, B, B0 at the first target."""
        return np.asarray(self.pins[0])

    @property
    def sensitivity(self) -> SphericalSensitivity:
        """How far each target turns per 0.1 % of each arc while the crank keeps its angle."""
        bar = self.four_bar
        return spherical_sensitivity(self.pins, np.array([bar.a, bar.b, bar.c, bar.d]), coordinates=self.coordinates)

    @property
    def relative_sensitivity(self) -> float:
        """How far the most sensitive target turns at most, in radians, if every arc is wrong by up to 0.1 %."""
        return float(self.sensitivity.worst.max())

    @property
    def linkage(self) -> SpatialLinkage:
        """The linkage at its first target, for `move`, `draw` and files."""
        places: dict[str | int, object] = {k: {"z": tuple(axis)} for k, axis in enumerate(self.axes.tolist())}
        return SpatialLinkage(Mechanism.parse(_TEXT), places, outputs=["rocker"])


SPHERICAL_ORDERS: Mapping[str, Callable[[SphericalDesign], float]] = {
    "transmission": lambda design: -design.verdict.transmission,
    "size-ratio": lambda design: design.verdict.size_ratio,
    "sensitivity": lambda design: design.relative_sensitivity,
    "full-turn": lambda design: float(not design.verdict.turns_fully),
}
"""What designs on the sphere can be sorted by, the better first: the smaller value."""
_USUAL = ("full-turn", "transmission")


@dataclass(frozen=True, kw_only=True)
class SphericalResult:
    """The designs for a task on the sphere: accepted ones, the best first, and rejected ones with their reasons."""

    designs: tuple[SphericalDesign, ...]
    rejected: tuple[SphericalDesign, ...]
    count: SolutionCount
    notes: tuple[Message, ...]


def synthesise_orientations(
    orientations: ArrayLike, demands: Demands | None = None, *, number: int = 16, sort: Sequence[str] = ()
) -> SphericalResult:
    """Four-bars on the sphere whose coupler takes three to five orientations, judged by their motion.

    Args:
        orientations: (targets, 3, 3) rotation matrices.
        demands: a full turn, a transmission angle, a ratio of the arcs; lengths and regions belong to the plane.
        number: of designs that are listed where there are infinitely many.
        sort: by what the best are sought and sorted: some of ``transmission``, ``size-ratio``, ``sensitivity`` (to
            wrong arcs), ``full-turn``; by default the full turn, then the transmission angle.

    Raises:
        SynthesisError: what is no rotation, fewer than three or more than five, orientations that infinitely many
            dyads serve, demands for the plane.

    Cost:
        5 ms for five orientations, 0.2 s for the families.

    >>> def turned(x, z):
    ...     about_z = np.array([[np.cos(z), -np.sin(z), 0], [np.sin(z), np.cos(z), 0], [0, 0, 1]])
    ...     return about_z @ np.array([[1, 0, 0], [0, np.cos(x), -np.sin(x)], [0, np.sin(x), np.cos(x)]])
    >>> task = [turned(0, 0), turned(0.3, 0.2), turned(0.5, 0.6), turned(0.6, 1.1), turned(0.3, 1.6)]
    >>> found = synthesise_orientations(task)
    >>> found.count.theorem, found.count.found, found.count.real
    (6, 6, 4)

    See Also:
        `synthesise_spherical_function`, `synthesise_positions`

    Theory:
        docs/theory/synthesis-sphere.md
    """
    wanted, sought = checked_demands(demands), checked_orders(sort)
    turns = displacements(orientations)
    count = len(turns) + 1
    notes: list[Message] = []
    if count == MOST_ORIENTATIONS:
        dyads, complex_dyads = five_orientation_dyads(turns)
        theorem: int | None = COMPLEX_DYADS
        pairs = list(permutations(dyads, 2))
    else:
        dyads = family_dyads(turns)
        theorem, complex_dyads = None, len(dyads)
        pairs = _best_pairs(dyads, turns, wanted, number, notes, sought)
    designs = [_judged(_axes_of(*pair), turns, wanted) for pair in pairs]
    if theorem is not None:  # each linkage once, driven where it does more
        halves = {frozenset(map(id, pair)): list[SphericalDesign]() for pair in pairs}
        for pair, design in zip(pairs, designs, strict=True):
            halves[frozenset(map(id, pair))].append(design)
        designs = [min(both, key=partial(order_of_designs, sought)) for both in halves.values()]
    return result_of(
        designs,
        SolutionCount(what=message("dyads"), theorem=theorem, found=complex_dyads, real=len(dyads)),
        notes,
        sought,
    )


def arc_between(first: Reals, second: Reals) -> float:
    """The angle of two unit vectors."""
    return float(np.arctan2(np.linalg.norm(np.cross(first, second)), first @ second))


def _best_pairs(
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
    notes += resolution(sort)
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
    ratio = arcs.max(axis=0) / np.maximum(arcs.min(axis=0), 1e-300)
    folded = np.minimum(arcs, pi - arcs).min(axis=0)
    path = moves if demands.in_order else branch
    met = [path | (not demands.one_branch), full | (not demands.crank), ratio <= demands.size_ratio]
    good = np.stack([*met, transmission >= demands.transmission]) & (folded > LEAST_ARC)
    fails = np.where(folded > LEAST_ARC, np.sum(~good, axis=0), 99)
    # An arc near 0 or half a circle folds the linkage to a point, as a large ratio does in the plane.
    worst = np.where(np.isnan(transmission), 0.0, np.round(transmission, 6))
    known: Mapping[str, Callable[[], Reals]] = {
        "transmission": lambda: -worst,
        "size-ratio": lambda: ratio,
        "sensitivity": lambda: _shifts(first, second, turns, arcs, fails == fails.min(), given_first=given_first),
        "full-turn": lambda: np.asarray(1.0 - full, np.float64),
    }
    costs = [fails.astype(np.float64), *(known[name]() for name in (*sort, *_USUAL)), -folded]
    if not to_turn:
        return costs
    lack = np.where(full, 0.0, np.maximum(closure.low + 1, 0) + np.maximum(1 - closure.high, 0))
    return [1.0 - (path & (folded > LEAST_ARC)), np.nan_to_num(lack, nan=np.inf), *costs]


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


def _axes_of(first: SphericalDyad, second: SphericalDyad) -> Reals:
    """(4, 3) A0, A, B, B0, each on the side of the sphere that is nearer to the one before."""
    axes = [first.fixed]
    for axis in (first.moving, second.moving, second.fixed):
        axes.append(axis if axes[-1] @ axis >= 0 else -axis)
    return np.array(axes)


def _judged(axes: Reals, turns: Reals, demands: Demands) -> SphericalDesign:
    """The design of four axes in the first orientation, by the motion of its four-bar."""
    arcs = [arc_between(p, q) for p, q in zip(axes, axes[[1, 2, 3, 0]], strict=True)]
    moved = np.concatenate([axes[None, 1:3], np.einsum("kij,nj->kni", turns, axes[1:3])])
    ends = np.broadcast_to(axes[[0, 3]], (len(moved), 2, 3))
    pins = np.stack([ends[:, 0], moved[:, 0], moved[:, 1], ends[:, 1]], axis=1)
    return judged_four_bar(SphericalFourBar(*arcs), pins, demands, coordinates=False)


def judged_four_bar(
    bar: SphericalFourBar, pins: Reals, demands: Demands, *, coordinates: bool = True
) -> SphericalDesign:
    """What a four-bar does whose axes lie so at the targets, (targets, 4, 3): by `SphericalFourBar.motion`."""
    a0, first, b0 = pins[0, 0], pins[:, 1], pins[0, 3]
    x = (b0 - (a0 @ b0) * a0) / np.linalg.norm(np.cross(a0, b0))
    y = np.cross(a0, x)
    along = np.cross(y, b0)
    phi = np.arctan2(first @ y, first @ x)
    psi = np.arctan2(pins[:, 2] @ y, pins[:, 2] @ along)
    sides = np.sign(np.einsum("nx,nx->n", np.cross(first, b0), pins[:, 2]))
    reasons: list[Message] = []
    ranges = [arc for arc in bar.limits if all(float(angle) in arc for angle in phi)]
    one_branch = bool(ranges) and bool((sides == sides[0]).all() and sides[0] != 0)
    full = bool(bar.limits) and bar.limits[0].full
    path = phi
    in_order, error, transmission = False, np.inf, np.nan
    if one_branch:
        start = 0.0 if full else ranges[0].start
        path = start + (phi - start) % (2 * pi)
        steps = np.diff(path)
        onward, back = (steps % (2 * pi)).sum(), ((-steps) % (2 * pi)).sum()
        in_order = bool(min(onward, back) < 2 * pi if full else (steps > 0).all() or (steps < 0).all())
        if full and in_order and demands.in_order:
            turned = np.cumsum(steps % (2 * pi)) if onward <= back else -np.cumsum((-steps) % (2 * pi))
            path = path[0] + np.append(0.0, turned)
        elif full:
            begin, _ = shortest_arc(phi, closed=True)
            path = begin + (phi - begin) % (2 * pi)
        low, high = path.min(), path.max()
        dead = [k * pi for k in range(int(np.ceil(low / pi)), int(np.floor(high / pi)) + 1)]
        motion = bar.motion(path, branch="+" if sides[0] > 0 else "-")
        error = float(np.abs(np.angle(np.exp(1j * (motion.output.value - psi)))).max())
        rows = np.append(np.linspace(low, high, _ROWS * len(path)), [*path, *dead])
        between = bar.motion(rows, branch="+" if sides[0] > 0 else "-")
        if not np.isfinite(between.output.value).all():
            one_branch = False
        transmission = float(np.min(between.transmission_angle))
    if not one_branch:
        reasons.append(message("not all targets lie on one branch"))
    elif not error <= demands.tolerance:
        reasons.append(message("a target is missed by {error:.3g} of the size", error=error))
    if one_branch and not in_order and demands.in_order:
        reasons.append(message("the targets are met in another order"))
    if demands.crank and not full:
        reasons.append(message("the drive does not turn fully"))
    if one_branch and demands.transmission > 0 and not transmission >= demands.transmission:
        reasons.append(transmission_fault(transmission))
    arcs = [bar.a, bar.b, bar.c, bar.d]
    ratio = max(arcs) / min(arcs)
    if ratio > demands.size_ratio:
        reasons.append(TOO_SLENDER.filled(ratio=ratio))
    return SphericalDesign(
        four_bar=bar,
        pins=pins,
        coordinates=coordinates,
        branch="+" if sides[0] > 0 else "-",
        drives=tuple(map(float, path)),
        outputs=tuple(map(float, psi)),
        verdict=DesignVerdict(
            assembles=True,
            one_circuit=one_branch,
            one_branch=one_branch,
            in_order=in_order,
            turns_fully=full,
            transmission=transmission,
            size_ratio=ratio,
            error=error if one_branch else np.nan,
            reasons=tuple(reasons),
        ),
    )


def order_of_designs(sort: Sequence[str], design: SphericalDesign) -> list[float]:
    """By how many reasons it is rejected, then the better ones first."""
    values = (SPHERICAL_ORDERS[name](design) for name in (*sort, *_USUAL))
    return [len(design.verdict.reasons), *(float(np.nan_to_num(value, nan=0.0)) for value in values)]


def result_of(
    designs: Iterable[SphericalDesign], count: SolutionCount, notes: Iterable[Message], sort: Sequence[str] = ()
) -> SphericalResult:
    """Accepted designs and rejected ones, the best first."""
    ranked = sorted(designs, key=partial(order_of_designs, sort))
    return SphericalResult(
        designs=tuple(design for design in ranked if design.verdict.accepted),
        rejected=tuple(design for design in ranked if not design.verdict.accepted),
        count=count,
        notes=tuple(notes),
    )


def resolution(sort: Sequence[str]) -> Iterator[Message]:
    """How finely the least sensitive are sought, where these are asked for."""
    if "sensitivity" in sort:
        yield message(
            "The least sensitive ones are improved in steps down to {step:.1g} radians; that no other is better is not "
            "proved.",
            step=_WIDTHS[-1],
        )


def checked_orders(sort: Sequence[str]) -> tuple[str, ...]:
    """What is asked for; `SynthesisError` for what designs on the sphere are not sorted by."""
    if wrong := next((name for name in sort if name not in SPHERICAL_ORDERS), None):
        raise SynthesisError(
            "designs are sorted by {orders}, not by {name!r}", orders=", ".join(SPHERICAL_ORDERS), name=wrong[:40]
        )
    return tuple(sort)


def checked_demands(demands: Demands | None) -> Demands:
    """The demands, none by default; `SynthesisError` for those that belong to the plane."""
    wanted = demands or Demands()
    if wanted.given_sizes or wanted.region is not None or wanted.near_pivots:
        raise SynthesisError(
            "lengths, frame_direction, region and near_pivots: demands for the plane; on the sphere arcs have no unit"
        )
    return wanted
