"""A body carried through positions: all four-bars, slider-cranks and inverted slider-cranks that do it.

docs/theory/synthesis-positions.md has the counts: two and three positions leave pivots to be chosen, four leave curves,
five leave four dyads, and more are met by least squares.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cache, partial
from itertools import combinations, permutations
from math import comb

import numpy as np
from numpy.typing import NDArray

from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.burmester import burmester_curves
from gruebler.design.synthesis.dyads import (
    BLOCK,
    CRANK,
    SLIDER,
    Displacements,
    DyadKind,
    GuidingDyad,
    all_dyads,
    dyad_of_fixed_pivot,
    dyad_of_moving_pivot,
    misfit,
    sliding_dyads,
)
from gruebler.design.synthesis.family_bounds import bound_notes
from gruebler.design.synthesis.given_pivots import notes_on_pivots
from gruebler.design.synthesis.judging import Demands, best_of, judge_design, judged_by_drive, order_notes
from gruebler.design.synthesis.length_search import best_linkages, best_members, has_lengths
from gruebler.design.synthesis.pair_search import IMPROVED, Nearby
from gruebler.design.synthesis.partner_bounds import (
    Pair,
    angle_of_pair,
    best_beside,
    best_beside_ends,
    improved_pair,
    slide_notes,
)
from gruebler.design.synthesis.results import (
    Design,
    Progress,
    SolutionCount,
    SynthesisResult,
    in_order_of,
    ranked,
)
from gruebler.design.synthesis.special_tasks import (
    nearly_one_joint,
    refuse_one_joint,
    refuse_parallelograms,
    solved_where_it_lies,
)
from gruebler.design.synthesis.targets import Targets, position_targets
from gruebler.design.synthesis.tasks import SAME, PositionTask
from gruebler.mechanics.fourbar import grashof
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism

NEAR = 0.05
"""More than five positions are met if they are missed by less than this part of the size."""
_FARTHEST = 1e3
"""Sizes. A circle about a pivot farther away is a line within some 1e-4 sizes; the search for it creeps to infinity and
stops anywhere, while the sliding dyad that is meant is fitted as such."""

_SAMPLE = {2: 256, 3: 256, 4: 300}
"""Dyads of a family that are taken, by the number of positions: each is tried with each."""
_SLIDES = 64
"""Sliding dyads of each kind that are taken of two or three positions."""
SLIDES_BESIDE = 1024
"""Those of three positions that are tried with one given crank."""
_REACH = 1.5  # sizes of the task, in which pivots of the body are taken
_FARTHER = (6.0, 20.0)  # likewise, of two positions with a given pivot
_BULGES = (0.25, -0.25, 1.0, -1.0)
"""How far a third position between two lies beside them, by their distance: four pivots for a point of the plane."""
_ENDS = 64
"""Dyads of a pivot that are taken of two positions."""
_PLANE = 40.0  # sizes of the task: the plane in which pivots are sought counts as so long

_FOUR_BAR = f"{CRANK.form}-{CRANK.form}"
DYADS = message("dyads")
_FAMILIES = {
    2: message(
        "There are infinitely many solutions: every point of the body and every point of the frame is a pivot of "
        "infinitely many dyads; {count} dyads were taken."
    ),
    3: message(
        "There are infinitely many solutions: every point of the body is the pivot of one dyad, likewise every point "
        "of the frame; {count} dyads were taken."
    ),
    4: message(
        "There are infinitely many solutions: the pivots lie on Burmester's cubics, one dyad for each point of them; "
        "{count} dyads were taken."
    ),
}

_PAIRS = message(
    "{dyads} complex dyads are {pairs} solutions as ordered pairs, each dyad also with itself, and {linkages} linkages."
)

THEOREM = {2: None, 3: None, 4: None, 5: 4}
"""How many complex dyads a general task has, by the number of positions."""


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
        return tuple(dyad.moved(size, origin) for dyad in _fitted_dyads(displacements))
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


def _of_one_pivot(task: PositionTask) -> list[GuidingDyad]:
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


@solved_where_it_lies
def synthesise_positions(
    task: PositionTask,
    demands: Demands | None = None,
    *,
    number: int = 16,
    sort: Sequence[str] = (),
    progress: Progress | None = None,
) -> SynthesisResult:
    """All linkages of two dyads that carry a body through positions.

    Args:
        task: the positions.
        demands: what a design has to do besides; by default one branch and the order of the task.
        number: of designs that are taken from an infinite family (two to four positions).
        sort: by what the best of a family are sought: names as for `SynthesisResult.sorted_by`.
        progress: called with the pairs of dyads that are judged, and their number.

    Raises `SynthesisError` for positions that infinitely many dyads of no known family serve. Cost: 1 ms for the dyads
    of five positions, 2 to 7 s for search and proof of two and three, about 10 ms for the verdict on each design.

    >>> task = PositionTask([(0, 0, 0), (-2, 3.8, np.radians(81)), (-0.1, 3.4, np.radians(-16)),
    ...                      (1.5, 0.8, np.radians(-32)), (-1.8, 2.2, np.radians(55))])
    >>> found = synthesise_positions(task)
    >>> found.count.found, found.count.real, len(found.designs) + len(found.rejected)
    (4, 4, 6)
    """
    wanted = (demands or Demands()).of_task(task)
    if len(task) > 4 and task.fixed_pivots:
        raise SynthesisError("four-bars have no pivots to choose for more than four positions; six-bars have some")
    refuse_one_joint(task, wanted)
    refuse_parallelograms(task)
    chosen = len(task.moving_pivots) + len(task.fixed_pivots) + len(task.curve_parameters)
    searched = len(task) < 5 and chosen < 2
    given = _of_one_pivot(task) if searched and chosen else []
    free = replace(task, moving_pivots=(), fixed_pivots=(), curve_parameters=()) if searched else task
    dyads = (*given, *guiding_dyads(free, _SAMPLE[len(task)] if searched else number, wanted.region))
    if given and len(task) == 2 and wanted.region is None:
        dyads += tuple(dyad for reach in _FARTHER for dyad in guiding_dyads(free, _SAMPLE[2], reach=reach))
    if len(task) > 5:
        return _approximate(task, wanted, dyads, progress)
    notes = [*nearly_one_joint(task)]
    notes += [*notes_on_pivots(task, given or dyads, wanted)] if chosen and len(task) in (3, 4) else []
    if searched:
        candidates = _judged_best(free, wanted, dyads, given, number, sort, progress, notes)
    elif len(task) == 2:
        candidates = _judged_ends(task, wanted, number, sort, progress, notes)
    else:
        pairs = list(combinations(dyads, 2))
        candidates = _judged_pairs(task, wanted, pairs, progress, each_drive=len(task) < 5)
    complex_dyads = len(dyads)
    if len(task) == 5:
        displacements, *_ = Displacements.of(task.origins, task.turns)
        complex_dyads = all_dyads(displacements).found
        notes.append(_PAIRS.filled(dyads=complex_dyads, pairs=complex_dyads**2, linkages=comb(complex_dyads, 2)))
    else:
        notes.append(_FAMILIES[len(task)].filled(count=len(dyads)))
    if len(dyads) < 2:
        notes.append(message("A linkage needs two dyads."))
    designs, rejected = ranked(candidates)
    if not searched:
        notes += order_notes(candidates, wanted)
    if searched and not given and len(task) == 4 and sum(not dyad.slides for dyad in dyads) > 1:
        notes += _proved(task, wanted, dyads, designs)
    return SynthesisResult(
        task=task,
        designs=designs,
        rejected=rejected,
        count=SolutionCount(what=DYADS, theorem=THEOREM[len(task)], found=complex_dyads, real=len(dyads)),
        notes=tuple(notes),
    )


def _proved(
    task: PositionTask, demands: Demands, dyads: Sequence[GuidingDyad], designs: Sequence[Design]
) -> Iterator[Message]:
    """What no linkage of the family of four positions does better than these designs."""
    angles = [design.verdict.transmission for design in designs if design.form == _FOUR_BAR]
    yield from bound_notes(task, demands, max(angles, default=None))
    for kind in (SLIDER, BLOCK):
        form, slides = f"{CRANK.form}-{kind.form}", [dyad for dyad in dyads if dyad.kind == kind]
        angles = [design.verdict.transmission for design in designs if design.form == form]
        if slides and has_lengths(kind, demands):
            yield from slide_notes(task, demands, slides, max(angles, default=None), form)


def _judged_pairs(
    task: PositionTask,
    demands: Demands,
    pairs: Sequence[Pair],
    progress: Progress | None,
    *,
    each_drive: bool = False,
) -> list[Design]:
    """The designs of pairs, driven where it does best; or at each side, as where pivots were chosen."""
    designs: list[Design] = []
    for done, (guiding_dyad, two) in enumerate(pairs, 1):
        if progress is not None:
            progress(done, len(pairs))
        form = f"{guiding_dyad.kind.form}-{two.kind.form}"
        with suppress(LinkageError):  # two dyads with a common pivot are no linkage
            linkages = four_bar_linkages(guiding_dyad, two, complex(task.origins[0]), unit=task.unit)
            if each_drive and form == _FOUR_BAR:
                designs += judged_by_drive(linkages, partial(body_targets, task), demands, form)
            else:
                designs.append(best_of(linkages, partial(body_targets, task), demands, form))
    return designs


def _judged_best(
    task: PositionTask,
    demands: Demands,
    dyads: Sequence[GuidingDyad],
    given: Sequence[GuidingDyad],
    number: int,
    sort: Sequence[str],
    progress: Progress | None,
    notes: list[Message],
) -> list[Design]:
    """The designs of the best pairs of a family, and of its sliding dyads with some of it; notes on the search.

    Of dyads that are given each pair has one.
    """
    turning = [dyad for dyad in dyads if not dyad.slides]
    sliding: list[GuidingDyad] = []
    of_family = near_on_curve(task) if len(task) == 4 and turning else partial(near_in_plane, task)

    def near(dyad: GuidingDyad, width: float) -> list[GuidingDyad]:
        return [] if dyad in given else of_family(dyad, width)

    def sought(
        cranks: Sequence[GuidingDyad], second: Sequence[GuidingDyad], count: int, wished: Demands
    ) -> tuple[list[Pair], list[Message]]:
        search = best_linkages(task, cranks, wished, near, second=second, given=given, orders=sort, number=count)
        turns = given and not given[0].slides
        if (turns and second) or (not turns and (len(task) == 4 or not search.pairs)):
            return [*search.pairs], [*search.notes]
        if turns and len(task) == 2:
            better, proved = best_beside_ends(task, wished, given, search.pairs)
        elif turns:
            better, proved = best_beside(task, wished, given[0], search.pairs)
        else:
            improved, proved = improved_pair(task, wished, search.pairs)
            better = [improved] if improved else []
        return [*better, *search.pairs], [*search.notes, *proved]

    asked: list[tuple[Sequence[GuidingDyad], Sequence[GuidingDyad], int]] = []
    if given and given[0].slides:
        asked.append((turning, given, number))
    elif len(turning) > 1:
        asked.append((turning, (), number))
    for kind in () if given and given[0].slides else (SLIDER, BLOCK):
        second = (
            [dyad for dyad in dyads if dyad.kind == kind]
            if len(task) == 4
            else sliding_sample(task, kind, demands, SLIDES_BESIDE if len(given) == 1 else _SLIDES)
        )
        sliding += second[:: max(1, len(second) // 2)]
        if second and (cranks := list(given or turning)):
            asked.append((cranks, second, max(1, number // 4)))
    pairs: list[Pair] = []
    for drivers, partners, count in asked:
        some, said = sought(drivers, partners, count, demands)
        if demands.transmission > 0 and not any(angle_of_pair(task, demands, pair) > -np.inf for pair in some):
            # Where none of the sample has the angle, the best without the demand may have it.
            freed, _ = sought(drivers, partners, count, replace(demands, transmission=0.0))
            some = [pair for pair in freed if angle_of_pair(task, demands, pair) > -np.inf] + some
        pairs += some
        notes += said
    notes += [IMPROVED] if pairs else []
    designs = _judged_as_driven(task, demands, pairs, progress)
    if given or demands.lengths:
        return designs
    return designs + _judged_pairs(task, demands, list(combinations(sliding, 2)), None)


def _judged_ends(
    task: PositionTask,
    demands: Demands,
    number: int,
    sort: Sequence[str],
    progress: Progress | None,
    notes: list[Message],
) -> list[Design]:
    """The designs of the best pairs of two positions with several given pivots, whose other ends lie along lines."""
    alone = [replace(task, moving_pivots=(pivot,), fixed_pivots=()) for pivot in task.moving_pivots]
    alone += [replace(task, moving_pivots=(), fixed_pivots=(pivot,)) for pivot in task.fixed_pivots]
    ends = [[dyad for dyad in _of_one_pivot(each) if not dyad.slides] for each in alone]
    search = best_members(task, list(permutations(ends, 2)), demands, orders=sort, number=number)
    notes += search.notes
    return _judged_as_driven(task, demands, search.pairs, progress)


def _judged_as_driven(
    task: PositionTask, demands: Demands, pairs: Sequence[Pair], progress: Progress | None
) -> list[Design]:
    """The designs of pairs, the driven dyad first."""
    designs: list[Design] = []
    for done, (first, second) in enumerate(pairs, 1):
        with suppress(LinkageError):  # two dyads with a common pivot are no linkage
            linkage = linkage_of_dyads(first, second, complex(task.origins[0]), task.unit)
            form = f"{first.kind.form}-{second.kind.form}"
            designs.append(judge_design(linkage, body_targets(task, linkage), demands, form))
        if progress is not None:
            progress(done, len(pairs))
    return designs


def sliding_sample(task: PositionTask, kind: DyadKind, demands: Demands, number: int = _SLIDES) -> list[GuidingDyad]:
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
    reach = _PLANE * width * task.size
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
    for pivot in pivots:
        with suppress(SynthesisError):  # it serves any dyad
            others += guiding_dyads(replace(task, moving_pivots=((pivot.real, pivot.imag),), fixed_pivots=()))
    return [other for other in others if not other.slides]


def body_targets(task: PositionTask, linkage: Linkage, link: str = "coupler") -> Targets:
    """The positions of the link that is the body, with its point P at the origin."""
    first = linkage.required_pose[link].angle
    targets = position_targets("P", link, task.origins, first + task.angles - task.angles[0], task.size)
    return replace(targets, ranks=task.order, travel=task.size if np.ptp(task.origins) else np.inf)


def four_bar_linkages(
    first_dyad: GuidingDyad, second_dyad: GuidingDyad, point: complex, *, unit: str = "mm"
) -> Iterator[Linkage]:
    """The linkage of two dyads in its first position with a coupler point P, driven at each side: the better first.

    A side that turns fully drives first. Each is built when it is asked for. Raises `LinkageError` if pivots coincide.
    """
    orders = [(first_dyad, second_dyad), (second_dyad, first_dyad)]
    if not (first_dyad.slides or second_dyad.slides):
        turning = grashof(
            first_dyad.length,
            abs(first_dyad.moving - second_dyad.moving),
            second_dyad.length,
            abs(first_dyad.fixed - second_dyad.fixed),
        ).turning
        if "c" in turning and "a" not in turning:
            orders.reverse()
    elif first_dyad.kind.pairs[0].is_sliding and not second_dyad.kind.pairs[0].is_sliding:
        orders.reverse()
    return (linkage_of_dyads(first, second, point, unit) for first, second in orders)


def linkage_of_dyads(first_dyad: GuidingDyad, other_dyad: GuidingDyad, point: complex, unit: str) -> Linkage:
    """The linkage of two dyads in its first position, driven at the first; P lies on the coupler.

    Raises `LinkageError` if pivots of a link coincide.
    """
    first = first_dyad.kind.sides[0]
    second = other_dyad.kind.sides[1 if first_dyad.kind == other_dyad.kind or not other_dyad.slides else 0]
    parts: list[str] = []
    places: dict[str | int, object] = {}
    for side, dyad in ((first, first_dyad), (second, other_dyad)):
        for (symbol, place), links in zip(dyad.joints, (f"frame-{side}", f"{side}-coupler"), strict=True):
            parts.append(f"{symbol}({links})")
            places[parts[-1]] = place
    mechanism = _mechanism(f"{parts[0]} {parts[1]} {parts[3]} {parts[2]}; frame=frame; drive={parts[0]}")
    points = {"P": ("coupler", point.real, point.imag)}
    return Linkage.from_drawing(mechanism, places, points=points, unit=unit, outputs=[second])


_mechanism = cache(Mechanism.parse)
"""A synthesis gives some hundred linkages of few mechanisms."""


def _fitted_dyads(given: Displacements) -> list[GuidingDyad]:
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


def _approximate(
    task: PositionTask, demands: Demands, dyads: Sequence[GuidingDyad], progress: Progress | None
) -> SynthesisResult:
    """More than five positions: the pairs of fitted dyads, judged by how near they come to each position."""
    tolerance = demands.tolerance if demands.tolerance > 1e-6 else NEAR
    designs = _judged_pairs(task, replace(demands, tolerance=tolerance), list(combinations(dyads, 2)), progress)
    accepted, rejected = ranked(designs)
    accepted = in_order_of(accepted, ["error"])
    note = message(
        "More than five positions are met by least squares; designs that come nearer than {tolerance:g} are accepted.",
        tolerance=tolerance,
    )
    return SynthesisResult(
        task=task,
        designs=accepted,
        rejected=rejected,
        count=SolutionCount(what=DYADS, theorem=0, found=len(dyads), real=len(dyads)),
        notes=(note, *order_notes(designs, demands)),
    )
