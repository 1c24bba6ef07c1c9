"""Four-bars on the sphere that turn a body through orientations, and what any of them does.

docs/theory/synthesis-sphere.md has the equations and the counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import permutations
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.judging import transmission_fault
from gruebler.design.synthesis.pair_facts import shortest_arc
from gruebler.design.synthesis.results import TOO_SLENDER, DesignVerdict, SolutionCount
from gruebler.design.synthesis.spherical_dyads import (
    COMPLEX_DYADS,
    MOST_ORIENTATIONS,
    SphericalDyad,
    displacements,
    family_dyads,
    five_orientation_dyads,
)
from gruebler.design.synthesis.spherical_search import USUAL_ON_SPHERE, best_sphere_pairs
from gruebler.design.synthesis.spherical_shifts import (
    SphericalSensitivity,
    spherical_sensitivity,
)
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.spherical_four_bar import SphericalFourBar
from gruebler.structure.mechanism import Mechanism

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
        pairs = best_sphere_pairs(dyads, turns, wanted, number, notes, sought)
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
    values = (SPHERICAL_ORDERS[name](design) for name in (*sort, *USUAL_ON_SPHERE))
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
