"""The dyads of a task of positions: all of five, a sample of the infinitely many of fewer, the nearest ones of more.

Two and three positions leave pivots to be chosen, four leave curves. docs/theory/synthesis-positions.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.errors import SynthesisError
from gruebler.design.synthesis.burmester import burmester_curves
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.dyads import (
    BLOCK,
    CRANK,
    Displacements,
    DyadKind,
    GuidingDyad,
    all_dyads,
    dyad_of_fixed_pivot,
    dyad_of_moving_pivot,
    misfit,
    sliding_dyads,
)
from gruebler.design.synthesis.pair_search import Nearby
from gruebler.design.synthesis.tasks import SAME, PositionTask

_FARTHEST = 1e3
"""Sizes. A circle about a pivot farther away is a line within some 1e-4 sizes; the search for it creeps to infinity and
stops anywhere, while the sliding dyad that is meant is fitted as such."""
SLIDES = 64
"""Sliding dyads of each kind that are taken of two or three positions."""
SLIDES_BESIDE = 1024
"""Those of three positions that are tried with one given crank."""
_REACH = 1.5  # sizes of the task, in which pivots of the body are taken
_BULGES = (0.25, -0.25, 1.0, -1.0)
"""How far a third position between two lies beside them, by their distance: four pivots for a point of the plane."""
_ENDS = 64
"""Dyads of a pivot that are taken of two positions."""
_RINGS = np.array([0.03 * 2.5**k for k in range(6)])
"""Sizes: circles about a pivot that is preferred on which others are taken."""
PLANE = 40.0  # sizes of the task: the plane in which pivots are sought counts as so long


def guiding_dyads(
    task: PositionTask,
    number: int = 24,
    region: tuple[float, float, float, float] | None = None,
    *,
    reach: float = _REACH,
) -> tuple[GuidingDyad, ...]:
    """The dyads that guide the body: all four of five positions, else those chosen or so many of infinitely many.

    Of infinitely many only those are taken whose fixed pivots lie in the region, where one is given; of four positions
    all, if the curve does not pass through it. Without a region those of two and three positions have their pivots on
    the body within so many sizes of the task.

    Raises `SynthesisError` where a chosen pivot serves no dyad or any.
    """
    displacements, origin, size = Displacements.of(task.origins, task.turns)
    count = len(task)
    if count == 5:
        return tuple(dyad.moved(size, origin) for dyad in all_dyads(displacements).real)
    if count == 4:
        curves = burmester_curves(task)
        if not curves.pieces:
            return curves.sliding
        picked = [curves.nearest(complex(*p)) for p in task.moving_pivots]
        picked += [curves.nearest(complex(*p), fixed=True) for p in task.fixed_pivots]
        picked += [curves.at(place) for place in task.curve_parameters]
        return tuple(picked) or curves.dyads(number, region)
    if count > 5:
        return tuple(dyad.moved(size, origin) for dyad in fitted_dyads(displacements))
    chosen: list[tuple[Callable[[Displacements, complex], GuidingDyad], complex]]
    chosen = [(dyad_of_moving_pivot, complex(*p)) for p in task.moving_pivots]
    chosen += [(dyad_of_fixed_pivot, complex(*p)) for p in task.fixed_pivots]
    if not chosen:
        construct = dyad_of_moving_pivot if region is None else dyad_of_fixed_pivot
        chosen = [(construct, pivot) for pivot in _grid(task, number, region, reach)]
    given = [displacements]
    if count == 2:
        bulges = _BULGES[:1] if task.moving_pivots or task.fixed_pivots else _BULGES
        given = [_with_third(displacements, bulge) for bulge in bulges]
    dyads = []
    for k, (construct, pivot) in enumerate(chosen):
        try:
            part = given[(k + k // round(len(chosen) ** 0.5)) % len(given)]
            dyads.append(construct(part, (pivot - origin) / size).moved(size, origin))
        except SynthesisError:
            if task.moving_pivots or task.fixed_pivots:
                raise
    return tuple(dyads)


def dyads_of_one_pivot(task: PositionTask) -> list[GuidingDyad]:
    """The dyad of the one pivot that is given; of two positions, which leave one of its ends to choose, some."""
    if len(task) > 2:
        return list(guiding_dyads(task))
    displacements, origin, size = Displacements.of(task.origins, task.turns)
    construct = dyad_of_moving_pivot if task.moving_pivots else dyad_of_fixed_pivot
    (pivot,) = (complex(*p) for p in (*task.moving_pivots, *task.fixed_pivots))
    dyads = []
    for k in range(_ENDS):
        bulge = np.tan(np.pi * ((k + 0.5) / _ENDS - 0.5))
        part = _with_third(displacements, bulge)
        with suppress(SynthesisError):  # it serves any dyad
            dyads.append(construct(part, (pivot - origin) / size).moved(size, origin))
    return dyads


def dyads_near_pivots(task: PositionTask, demands: Demands) -> list[GuidingDyad]:
    """Dyads of two to four positions whose fixed pivots are those that are preferred, or lie about them."""
    places = [complex(*place) for place in demands.near_pivots]
    if len(task) == 4:
        curves = burmester_curves(task)
        return [curves.nearest(place, fixed=True) for place in places if curves.pieces]
    return [dyad for place in places for dyad in _with_fixed_pivots(task, place, _RINGS * task.size)]


def near_fixed_in_plane(task: PositionTask, dyad: GuidingDyad, width: float) -> list[GuidingDyad]:
    """As `near_in_plane`, with dyads whose pivots on the frame lie about its own besides."""
    others = near_in_plane(task, dyad, width)
    if dyad.slides:
        return others
    radii = np.array([0.5, 1.0]) * (PLANE * width * task.size)
    if len(task) > 2:
        return others + _with_fixed_pivots(task, dyad.fixed, radii)
    turn = task.turns[1] / task.turns[0]
    for fixed in _about(dyad.fixed, radii):  # the pivot on the body lies on a line: that of the nearest place is taken
        seen = task.origins[0] + (fixed - task.origins[1]) / turn
        along = 1j * (seen - fixed)
        if along:
            middle, gap = (seen + fixed) / 2, dyad.moving - (seen + fixed) / 2
            moving = middle + along * np.real(np.conj(along) * gap) / abs(along) ** 2
            others.append(replace(dyad, fixed=fixed, moving=complex(moving)))
    return others


def _about(place: complex, radii: Reals) -> list[complex]:
    """A place and others on circles about it."""
    turns = np.exp(2j * np.pi * np.arange(8) / 8)
    return [place, *map(complex, (place + radii[:, None] * turns).ravel())]


def _with_fixed_pivots(task: PositionTask, place: complex, radii: Reals) -> list[GuidingDyad]:
    """Dyads with a fixed pivot at a place and on circles about it; of two positions some of each."""
    given, origin, size = Displacements.of(task.origins, task.turns)
    parts = [given] if len(task) > 2 else [_with_third(given, bulge) for bulge in _BULGES]
    dyads = []
    for pivot in _about(place, radii):
        for part in parts:
            with suppress(SynthesisError):  # it serves any dyad
                dyads.append(dyad_of_fixed_pivot(part, (pivot - origin) / size).moved(size, origin))
    return [dyad for dyad in dyads if not dyad.slides]


def _with_third(given: Displacements, bulge: float) -> Displacements:
    """With a third position between two, which chooses the pivot of the frame on the bisector, or that of the body."""
    q, t = given
    shift = complex(t[0])
    third = shift * (0.5 + 1j * bulge) if abs(shift) > 0 else complex(bulge)
    # Half the rotation: with it two positions become three of the rotation about their pole, or of the shift.
    return Displacements(np.append(q, np.exp(0.5j * np.angle(q[0]))), np.append(t, third))


def _grid(
    task: PositionTask, number: int, region: tuple[float, float, float, float] | None, reach: float = _REACH
) -> list[complex]:
    """So many places about the positions, or in the region."""
    side = max(2, round(number**0.5))
    if region is None:
        centre, reach = task.origins.mean(), reach * task.size
        steps = np.linspace(-1, 1, side)
        return [complex(centre + reach * complex(a, b)) for a in steps for b in steps]
    # The middles of its fields: a pivot on the edge could fall outside by the last bit.
    x, y = (low + (high - low) * (np.arange(side) + 0.5) / side for low, high in (region[::2], region[1::2]))
    return [complex(a, b) for a in x for b in y]


def sliding_family(task: PositionTask, kind: DyadKind, places: Iterable[complex]) -> list[GuidingDyad]:
    """Sliding dyads of two or three positions: for two a pivot at each place, for three a slide in each direction.

    >>> from gruebler.design.synthesis.dyads import SLIDER
    >>> task = PositionTask([(0, 0, 0), (2, 1, 0.4), (3, 1, 0.9)])
    >>> [dyad.moving for dyad in sliding_family(task, SLIDER, [1])]
    [(-3.50...-4.60...j)]
    """
    displacements, origin, size = Displacements.of(task.origins, task.turns)
    assert kind.seen is not None
    seen = kind.seen(displacements)
    dyads = []
    for place in places:
        if len(task) == 2:
            point = (place - origin) / size
            along = complex(seen.q[0] * point + seen.t[0] - point)
        else:  # Re(n* (q - 1) x) = -Re(n* t) with the normal n: linear in x
            along = place
            rows = np.conj(1j * along) * (seen.q - 1)
            matrix = np.stack([rows.real, -rows.imag], axis=1)
            if abs(np.linalg.det(matrix)) <= SAME * np.abs(matrix).max() ** 2:  # or the body is only shifted
                continue
            point = complex(*np.linalg.solve(matrix, -np.real(np.conj(1j * along) * seen.t)))
        if abs(along) > SAME and abs(point) < _FARTHEST:
            dyads.append(GuidingDyad(kind, point, point, along / abs(along)).moved(size, origin))
    return dyads


def sliding_sample(task: PositionTask, kind: DyadKind, demands: Demands, number: int = SLIDES) -> list[GuidingDyad]:
    """A sample of the sliding dyads of two or three positions, in the order of their family."""
    if len(task) == 2:
        places = _grid(task, number, demands.region if kind == BLOCK else None)
    else:
        places = [complex(np.exp(1j * np.pi * k / number)) for k in range(number)]
    return sliding_family(task, kind, places)


def near_on_curve(task: PositionTask) -> Nearby:
    """Dyads of four positions near one of them, by their places along the circle-point curve."""
    curves = burmester_curves(task)
    moving = np.concatenate([piece.moving for piece in curves.pieces])
    along = np.concatenate(curves.parameters())
    places: dict[GuidingDyad, float] = {}

    def near(dyad: GuidingDyad, width: float) -> list[GuidingDyad]:
        if dyad.slides:
            return []  # the only one of its kind
        at = places.get(dyad)
        if at is None:
            at = float(along[np.abs(moving - dyad.moving).argmin()])
        others: list[GuidingDyad] = []
        for place in (at + share * width for share in (-1.0, -0.5, 0.5, 1.0)):
            if 0 <= place <= 1:
                with suppress(SynthesisError):  # the curve has a gap there
                    places[other := curves.at(place)] = place
                    others.append(other)
        return others

    return near


def near_in_plane(task: PositionTask, dyad: GuidingDyad, width: float) -> list[GuidingDyad]:
    """Dyads of two or three positions near one: their pivots on the body, or the directions of their slides."""
    reach = PLANE * width * task.size
    if dyad.slides and len(task) == 3:
        turns = (dyad.direction * np.exp(1j * np.pi * width * share) for share in (-1.0, -0.5, 0.5, 1.0))
        return sliding_family(task, dyad.kind, map(complex, turns))
    pivots = [dyad.moving + reach * turn for turn in (1, 1j, -1, -1j, 0.5, 0.5j, -0.5, -0.5j)]
    if dyad.slides:
        return sliding_family(task, dyad.kind, pivots)
    others: list[GuidingDyad] = []
    if len(task) == 2:  # along the bisector of the two places of the pivot
        turn = task.turns[1] / task.turns[0]
        along = 1j * (task.origins[1] + turn * (dyad.moving - task.origins[0]) - dyad.moving)
        if along:
            steps = (reach * share * along / abs(along) for share in (-1.0, -0.5, 0.5, 1.0))
            others += [replace(dyad, fixed=dyad.fixed + step) for step in steps]
    given, origin, size = Displacements.of(task.origins, task.turns)
    if len(task) == 2:
        given = _with_third(given, _BULGES[0])
    for pivot in pivots:
        with suppress(SynthesisError):  # it serves any dyad
            others.append(dyad_of_moving_pivot(given, (pivot - origin) / size).moved(size, origin))
    return [other for other in others if not other.slides]


def fitted_dyads(given: Displacements) -> list[GuidingDyad]:
    """Dyads of more than four displacements by least squares, the best first: RR, PR, RP."""
    from scipy.optimize import least_squares

    count = len(given.q)
    starts: list[GuidingDyad] = []
    for chosen in list(combinations(range(count), 4))[:35]:
        part = Displacements(given.q[list(chosen)], given.t[list(chosen)])
        try:
            starts += all_dyads(part).real
            starts += sliding_dyads(Displacements(part.q[:3], part.t[:3]))
        except SynthesisError:
            continue
    steps = np.linspace(-2, 2, 4)
    starts += [
        GuidingDyad(CRANK, complex(a, b), complex(c, d))
        for a in steps
        for b in steps
        for c in steps[1:3]
        for d in steps[1:3]
    ]
    best: list[tuple[float, GuidingDyad]] = []
    for dyad in starts:
        if dyad.kind.seen is None:
            if max(abs(dyad.moving), abs(dyad.fixed)) > 50:
                continue

            def gaps(p: NDArray[np.float64]) -> NDArray[np.float64]:
                lengths = np.abs(given.images(complex(p[0], p[1])) - complex(p[2], p[3]))
                return np.asarray(lengths - lengths.mean())

            start = [dyad.moving.real, dyad.moving.imag, dyad.fixed.real, dyad.fixed.imag]
            p = least_squares(gaps, start, method="lm", xtol=1e-15, ftol=1e-15, max_nfev=200).x
            fitted = GuidingDyad(CRANK, complex(p[0], p[1]), complex(p[2], p[3]))
            if fitted.length < 1e-6 or max(abs(fitted.moving), abs(fitted.fixed)) > _FARTHEST:
                continue
        else:
            seen = dyad.kind.seen(given)

            def offsets(p: NDArray[np.float64], seen: Displacements = seen) -> NDArray[np.float64]:
                across = np.imag(np.exp(-1j * p[2]) * seen.images(complex(p[0], p[1])))
                return np.asarray(across - across.mean())

            start = [dyad.moving.real, dyad.moving.imag, float(np.angle(dyad.direction))]
            p = least_squares(offsets, start, method="lm", xtol=1e-15, ftol=1e-15, max_nfev=200).x
            point = complex(p[0], p[1])
            fitted = GuidingDyad(dyad.kind, point, point, complex(np.exp(1j * p[2])))
        best.append((misfit(given, fitted), fitted))
    best.sort(key=lambda row: row[0])
    distinct: list[GuidingDyad] = []
    for _, dyad in best:
        if all(_apart(dyad, other) for other in distinct):
            distinct.append(dyad)
        if len(distinct) == 8:
            break
    return distinct


def _apart(first: GuidingDyad, second: GuidingDyad) -> bool:
    gap = abs(first.moving - second.moving) + abs(first.fixed - second.fixed)
    return first.kind != second.kind or gap > 1e-3 * (1 + abs(first.moving) + abs(first.fixed))
