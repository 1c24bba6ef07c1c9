"""A body carried through positions: the best four-bars, slider-cranks and inverted slider-cranks that do it.

docs/theory/synthesis-positions.md has the counts: two and three positions leave pivots to be chosen, four leave curves,
five leave four dyads, and more are met by least squares.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import combinations, permutations
from math import comb, degrees

import numpy as np

from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.events import JAMMING
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import WITHOUT, Demands
from gruebler.design.synthesis.dyad_families import (
    PLANE,
    SLIDES,
    SLIDES_BESIDE,
    dyads_near_pivots,
    dyads_of_one_pivot,
    guiding_dyads,
    near_fixed_in_plane,
    near_in_plane,
    near_on_curve,
    sliding_sample,
)
from gruebler.design.synthesis.dyad_linkages import four_bar_linkages, linkage_of_dyads
from gruebler.design.synthesis.dyads import (
    BLOCK,
    CRANK,
    SLIDER,
    Displacements,
    GuidingDyad,
    all_dyads,
)
from gruebler.design.synthesis.family_bounds import bound_notes
from gruebler.design.synthesis.given_pivots import notes_on_pivots
from gruebler.design.synthesis.judging import best_of, judge_design, judged_by_drive, order_notes
from gruebler.design.synthesis.length_search import FINEST_STEP, best_linkages, best_members, has_lengths
from gruebler.design.synthesis.pair_facts import KNOWN, USUAL
from gruebler.design.synthesis.pair_search import (
    FINE_WIDTHS,
    IMPROVED,
    WIDTHS,
    FoundPairs,
    Pair,
    SoughtPairs,
    best_first,
    distinct_pairs,
)
from gruebler.design.synthesis.pair_starts import PairStarts
from gruebler.design.synthesis.partner_bounds import (
    angle_of_pair,
    best_beside,
    best_beside_ends,
    improved_pairs,
    of_turning,
    slide_notes,
)
from gruebler.design.synthesis.random_starts import random_search
from gruebler.design.synthesis.results import (
    NEAR_PIVOTS,
    Design,
    Progress,
    SolutionCount,
    SynthesisResult,
    in_order_of,
    ranked,
    resolution,
)
from gruebler.design.synthesis.special_tasks import (
    nearly_one_joint,
    refuse_one_joint,
    refuse_parallelograms,
    solved_where_it_lies,
)
from gruebler.design.synthesis.targets import body_targets
from gruebler.design.synthesis.tasks import PositionTask

NEAR = 0.05
"""More than five positions are met if they are missed by less than this part of the size."""
_SAMPLE = {2: 256, 3: 256, 4: 300}
"""Dyads of a family that are taken, by the number of positions: each is tried with each."""
_ENDS_IN_DEAD_CENTRES = {NEAR_PIVOTS, "size"}
"""What would be best in a dead centre: angles at which linkages jam are left out."""
_FARTHER = (6.0, 20.0)  # likewise, of two positions with a given pivot
_FOUR_BAR = f"{CRANK.form}-{CRANK.form}"
DYADS = message("dyads")
_FAMILIES = {
    2: message(
        "Every point of the body and every point of the frame is a pivot of infinitely many dyads; {count} dyads were "
        "taken."
    ),
    3: message(
        "Every point of the body is the pivot of one dyad, likewise every point of the frame; {count} dyads were taken."
    ),
    4: message("The pivots lie on Burmester's cubics, one dyad for each point of them; {count} dyads were taken."),
}

_FINITE = message(
    "The positions and what is given leave finitely many linkages, or none. They were sought from pairs of {count} "
    "dyads and from random pivots, so that one may be missing."
)
_PAIRS = message(
    "{dyads} complex dyads are {pairs} solutions as ordered pairs, each dyad also with itself, and {linkages} linkages."
)

THEOREM = {2: None, 3: None, 4: None, 5: 4}
"""How many complex dyads a general task has, by the number of positions."""


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
    if _ENDS_IN_DEAD_CENTRES & {*sort}:
        wanted = replace(wanted, transmission=max(wanted.transmission, JAMMING))
    refuse_one_joint(task, wanted)
    refuse_parallelograms(task)
    chosen = len(task.moving_pivots) + len(task.fixed_pivots) + len(task.curve_parameters)
    searched = len(task) < 5 and chosen < 2
    given = dyads_of_one_pivot(task) if searched and chosen else []
    free = replace(task, moving_pivots=(), fixed_pivots=(), curve_parameters=()) if searched else task
    dyads = (*given, *guiding_dyads(free, _SAMPLE[len(task)] if searched else number, wanted.region))
    dyads += tuple(_more_dyads(free, wanted, given)) if searched else ()
    if len(task) > 5:
        return _approximate(task, wanted, dyads, progress)
    notes = [*nearly_one_joint(task)]
    notes += [*notes_on_pivots(task, given or dyads, wanted)] if chosen and len(task) in (3, 4) else []
    finite = searched and _freedoms(task) <= wanted.given_sizes
    if searched:
        candidates = _judged_best(free, wanted, dyads, given, number, sort, progress, notes)
        if candidates and not finite:
            notes += [IMPROVED.filled(step=WIDTHS[-1]), *_resolution(task, wanted, given, sort)]
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
        notes.append((_FINITE if finite else _FAMILIES[len(task)]).filled(count=len(dyads)))
    if len(dyads) < 2:
        notes.append(message("A linkage needs two dyads."))
    designs, rejected = ranked(candidates)
    if not searched:
        notes += order_notes(candidates, wanted)
    if searched and not given and len(task) == 4 and sum(not dyad.slides for dyad in dyads) > 1:
        notes += _proved(task, wanted, dyads, designs, sort)
    return SynthesisResult(
        task=task,
        designs=designs,
        rejected=rejected,
        count=SolutionCount(
            what=DYADS, theorem=0 if finite else THEOREM[len(task)], found=complex_dyads, real=len(dyads)
        ),
        notes=tuple(notes),
    )


def _more_dyads(task: PositionTask, demands: Demands, given: Sequence[GuidingDyad]) -> Iterator[GuidingDyad]:
    """Dyads besides those near the positions: about pivots that are preferred, and far ones beside a given pivot."""
    if given and len(task) == 2 and demands.region is None:
        for reach in _FARTHER:
            yield from guiding_dyads(task, _SAMPLE[2], reach=reach)
    yield from dyads_near_pivots(task, demands)


def _resolution(
    task: PositionTask, demands: Demands, given: Sequence[GuidingDyad], sort: Sequence[str]
) -> Iterator[Message]:
    """How finely the best is sought by what is asked for."""
    step = FINEST_STEP if demands.given_sizes or (given and len(task) == 2) else PLANE * FINE_WIDTHS[-1]
    yield from resolution([name for name in sort if name != "transmission" or given], step)
    if _ENDS_IN_DEAD_CENTRES & {*sort} and demands.transmission == JAMMING:
        yield message("Transmission angles below {angle:g}° are left out.", angle=degrees(JAMMING))


def _freedoms(task: PositionTask) -> int:
    """How many numbers of a four-bar through two to four positions, with at most one given pivot, are free."""
    of_dyad = 5 - len(task)  # four numbers, and an equation for each position after the first
    given = len(task.moving_pivots) + len(task.fixed_pivots) + len(task.curve_parameters)
    return 2 * of_dyad - given * min(2, of_dyad)


def _proved(
    task: PositionTask,
    demands: Demands,
    dyads: Sequence[GuidingDyad],
    designs: Sequence[Design],
    sort: Sequence[str],
) -> Iterator[Message]:
    """What no linkage of the family of four positions does better than these designs.

    First of those whose crank turns fully, where there are any and designs are sorted by that.
    """

    def best(form: str, *, crank: bool = False) -> float | None:
        some = [each.verdict for each in designs if each.form == form and (each.verdict.turns_fully or not crank)]
        return max((verdict.transmission for verdict in some), default=None)

    turning = replace(demands, crank=True)
    first = not demands.crank and sort[:1] in ((), ("full-turn",))
    own = best(_FOUR_BAR, crank=True)
    if first and own is not None:
        yield from of_turning(bound_notes(task, turning, own))
    yield from bound_notes(task, demands, best(_FOUR_BAR))
    for kind in (SLIDER, BLOCK):
        form, slides = f"{CRANK.form}-{kind.form}", [dyad for dyad in dyads if dyad.kind == kind]
        if slides and has_lengths(kind, demands):
            own = best(form, crank=True)
            if first and own is not None:
                yield from of_turning(slide_notes(task, turning, slides, own, form))
            yield from slide_notes(task, demands, slides, best(form), form)


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
    in_plane = near_fixed_in_plane if sort else near_in_plane
    of_family = near_on_curve(task) if len(task) == 4 and turning else partial(in_plane, task)

    def near(dyad: GuidingDyad, width: float) -> list[GuidingDyad]:
        return [] if dyad in given else of_family(dyad, width)

    family = SoughtPairs(task=task, dyads=turning, demands=demands, near=near, given=given, orders=sort, number=number)
    asked: list[SoughtPairs] = []
    if given and given[0].slides:
        asked.append(replace(family, second=given))
    elif len(turning) > 1:
        asked.append(family)
    for kind in () if given and given[0].slides else (SLIDER, BLOCK):
        second = (
            [dyad for dyad in dyads if dyad.kind == kind]
            if len(task) == 4
            else sliding_sample(task, kind, demands, SLIDES_BESIDE if len(given) == 1 else SLIDES)
        )
        sliding += second[:: max(1, len(second) // 2)]
        if second and (cranks := list(given or turning)):
            asked.append(replace(family, dyads=cranks, second=second, number=max(1, number // 4)))
    pairs: list[Pair] = []
    for sought in asked:
        some, said = _best_pairs(sought)
        pairs += some
        notes += said
    designs = _judged_as_driven(task, demands, pairs, progress)
    if given or demands.given_sizes:
        return designs
    return designs + _judged_pairs(task, demands, list(combinations(sliding, 2)), None)


def _best_pairs(sought: SoughtPairs) -> tuple[list[Pair], list[Message]]:
    """The best of a sample, before them better ones that follow from the proof that none is better by much."""
    task, demands, given = sought.task, sought.demands, sought.given
    search = best_linkages(sought)
    if demands.transmission > 0 and not _having(task, demands, search.pairs):
        # Where none of the sample has the angle, the best without the demand may have it.
        freed, _ = _best_pairs(replace(sought, demands=replace(demands, transmission=0.0)))
        if having := _having(task, demands, freed):
            said = tuple(note for note in search.notes if note.text != WITHOUT.text)
            search = FoundPairs(pairs=(*having, *search.pairs), notes=said)
    turns = given and not given[0].slides
    if (turns and sought.second) or (not turns and (len(task) == 4 or not search.pairs)):
        return [*search.pairs], [*search.notes]
    if turns and len(task) == 2:
        better, proved = best_beside_ends(task, demands, given, search.pairs)
    elif turns:
        better, proved = best_beside(task, demands, given[0], search.pairs)
    else:
        starts = _starts(sought)
        random = random_search(starts, demands, _known(sought)) if starts else None
        if starts and random:
            search = replace(search, pairs=(*map(starts.family.dyads, random.best), *search.pairs))
        first = sought.orders[:1] in ((), ("full-turn",))
        better, proved = improved_pairs(task, demands, search.pairs, turning_first=first)
        if starts and random:
            known = [starts.family.rows(pair[:1], pair[1:]) for pair in (*better, *search.pairs)]
            proved += random.note(np.concatenate(known))
    pairs = [*better, *search.pairs]
    if sought.orders:
        pairs = best_first(task, demands, pairs, sought.orders)
    return distinct_pairs(pairs, task.size)[: sought.number], [*search.notes, *proved]


def _known(sought: SoughtPairs) -> tuple[str, ...]:
    """By what pairs are told apart."""
    return tuple(name for name in sought.orders if name in KNOWN) or USUAL


def _starts(sought: SoughtPairs) -> PairStarts | None:
    """Where linkages are sought from random starts: the whole family is free and the best one has a size.

    Beside slides, whose families are smaller, only by what is asked for.
    """
    smallest = _known(sought)[0] == "size" and len(sought.task) == 2  # they shrink to the pole
    if sought.given or sought.demands.given_sizes or smallest or (sought.second and not sought.orders):
        return None
    return PairStarts(sought.task, sought.others[0].kind)


def _having(task: PositionTask, demands: Demands, pairs: Sequence[Pair]) -> list[Pair]:
    """Pairs that meet the demands."""
    return [pair for pair in pairs if angle_of_pair(task, demands, pair) > -np.inf]


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
    ends = [[dyad for dyad in dyads_of_one_pivot(each) if not dyad.slides] for each in alone]
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
