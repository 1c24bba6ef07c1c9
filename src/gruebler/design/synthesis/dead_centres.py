"""Crank-rockers and slider-cranks with given dead centres (Alt's construction), and the best transmission angle.

docs/theory/synthesis-dead-centres.md derives the one-parameter family and its limits.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, degrees, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, joined_by_and, message
from gruebler.design.synthesis.dead_centre_extremes import LONGEST, LengthSquares, is_half_turn
from gruebler.design.synthesis.demands import LEAST_ANGLE, Demands, tightest
from gruebler.design.synthesis.given_lengths import scale_to_length
from gruebler.design.synthesis.judging import transmission_fault, verdict_at_rest
from gruebler.design.synthesis.results import MEASURES, PASSED, Design, SolutionCount, SynthesisResult, in_order_of
from gruebler.design.synthesis.tasks import DeadCentreTask
from gruebler.mechanics.fourbar import FourBar, SliderCrank

_SAMPLES = 720
_FINEST = 1e-10  # of the parameter: so near to the best of its neighbours a member is
_BESIDE = 1e-11  # of the square of the parameter: where a limit is, rounding does not decide
_SAME = 1e-9  # dead centres of a member agree with the task to this


@dataclass(frozen=True, slots=True)
class FamilyMember:
    """A linkage of the family."""

    parameter: float
    """The crank length, or the coupler length where the dead centres are half a turn apart; rocker (or stroke) is 1."""
    linkage: FourBar | SliderCrank
    transmission: float
    """Its minimum transmission angle, in radians."""


@dataclass(frozen=True)
class DeadCentreFamily:
    """All linkages with given dead centres: a one-parameter family."""

    task: DeadCentreTask
    members: tuple[FamilyMember, ...]
    """Evenly spread over the parameter, in its order."""
    best: FamilyMember
    """The one with the largest minimum transmission angle (VDI 2130)."""

    @property
    def range(self) -> tuple[float, float]:
        """From where to where the parameter goes, as far as it was sampled."""
        values = [member.parameter for member in self.members]
        return min(values), max(values)


def dead_centre_family(task: DeadCentreTask) -> DeadCentreFamily:
    """The family, and its member with the best transmission angle.

    Raises `SynthesisError` with the range of what is possible if there is none. Cost: about 30 ms.

    >>> family = dead_centre_family(DeadCentreTask(swing=np.radians(60), crank_angle=np.radians(160)))
    >>> round(degrees(family.best.transmission), 2), str(family.best.linkage.type)
    (25.01, 'crank-rocker')
    """
    if task.swing is not None:
        low, high = pi / 2 + task.swing / 2, 3 * pi / 2 + task.swing / 2
        if not low < task.angle < high:
            raise SynthesisError(
                "no crank-rocker swings by {swing:g}° with the dead centres {angle:g}° apart: the "
                "crank angle is more than {low:g}° and less than {high:g}°",
                swing=degrees(task.swing),
                angle=degrees(task.angle),
                low=degrees(low),
                high=degrees(high),
            )
    elif not pi / 2 < task.angle < 3 * pi / 2:
        raise SynthesisError(
            "no slider-crank has its dead centres {angle:g}° apart: the crank angle is more "
            "than 90° and less than 270°",
            angle=degrees(task.angle),
        )
    grid = _parameters(task)
    members = tuple(member for value in grid if (member := _member(task, float(value))) is not None)
    if not members:
        raise SynthesisError("no linkage with these dead centres was found")
    squares = LengthSquares.of(task)
    best = max((*members, *_members_at(task, squares, squares.extremes())), key=lambda member: member.transmission)
    return DeadCentreFamily(task, members, best)


def _parameters(task: DeadCentreTask) -> Reals:
    """Values of the parameter, denser at the ends; the chord of the dead centres is that of a rocker or stroke of 1."""
    share = (1 - np.cos(np.pi * (np.arange(_SAMPLES) + 0.5) / _SAMPLES)) / 2
    chord = _chord(task)
    half = (task.angle - pi) / 2
    if is_half_turn(task):
        return np.asarray(chord * (0.5 + (LONGEST - 0.5) * share**2))  # the coupler, up to twenty times the chord
    return np.asarray(chord / (2 * cos(half)) * share)


def _chord(task: DeadCentreTask) -> float:
    return 1.0 if task.swing is None else 2 * sin(task.swing / 2)


def _lengths(task: DeadCentreTask, parameter: float) -> tuple[float, float] | None:
    """Crank and coupler: chord^2 = 4 a^2 cos^2(h) + 4 b^2 sin^2(h), with h half of what exceeds half a turn."""
    chord, half = _chord(task), (task.angle - pi) / 2
    if is_half_turn(task):
        return chord / 2, parameter
    square = chord**2 / 4 - (parameter * cos(half)) ** 2
    return (parameter, sqrt(square) / abs(sin(half))) if square > 0 else None


def _member(task: DeadCentreTask, parameter: float) -> FamilyMember | None:
    """The linkage of a parameter, checked by its closed form; None if it has other dead centres."""
    sizes = _lengths(task, parameter)
    return None if sizes is None else _member_of_lengths(task, *sizes)


def _member_of_lengths(task: DeadCentreTask, a: float, b: float) -> FamilyMember | None:
    """The linkage of crank and coupler, likewise."""
    if not 0 < a < b:
        return None
    outer, inner, pivot = _places(task, a, b)
    chord = inner - outer
    try:
        linkage: FourBar | SliderCrank
        if pivot is None:
            linkage = SliderCrank(a, b, float((np.conj(chord) * outer).imag / abs(chord)))
        else:
            linkage = FourBar(a, b, 1.0, abs(pivot))
        centres = linkage.dead_centres
        if centres is None:
            return None
        if task.swing is None:
            target, reached = (1.0, min(task.angle, 2 * pi - task.angle)), (centres.travel, centres.phi_min)
        else:
            target, reached = (task.swing, task.angle), (centres.travel, centres.phi_back)
        if max(abs(x - y) for x, y in zip(target, reached, strict=True)) > _SAME:
            return None
        if pivot is not None and not _same_sense(pivot, outer, inner):
            return None
        return FamilyMember(b if is_half_turn(task) else a, linkage, float(linkage.transmission_angle.smallest.mu))
    except LinkageError:
        return None


class DeadCentrePlaces(NamedTuple):
    """Where the pin B of rocker or slider lies in the dead centres, and the rocker's pivot; the crank's is 0."""

    outer: complex
    inner: complex
    rocker_pivot: complex | None


def member_places(task: DeadCentreTask, member: FamilyMember) -> DeadCentrePlaces:
    """The dead centres of a member; rocker or stroke have the length 1."""
    return _places(task, member.linkage.a, member.linkage.b)


def _places(task: DeadCentreTask, a: float, b: float) -> DeadCentrePlaces:
    delta = task.angle - pi
    outer, inner = complex(b + a), (b - a) * complex(cos(delta), sin(delta))
    if task.swing is None:
        return DeadCentrePlaces(outer, inner, None)
    # From the outer to the inner dead centre the rocker turns by the swing in the sense of the crank.
    turn = complex(cos(task.swing), sin(task.swing))
    return DeadCentrePlaces(outer, inner, (inner - turn * outer) / (1 - turn))


def _same_sense(centre: complex, outer: complex, inner: complex) -> bool:
    """Whether the pin lies on one side of the frame line in both dead centres, so that they are of one branch."""
    first, second = ((np.conj(centre) * pin).imag for pin in (outer, inner))
    return bool(first * second > 0)


def synthesise_dead_centres(
    task: DeadCentreTask, demands: Demands | None = None, *, number: int = 12, sort: Sequence[str] = ()
) -> SynthesisResult:
    """The best linkage with given dead centres that meets the demands, and others spread over what meets them.

    Args:
        task: the dead centres.
        demands: what counts besides. Given lengths fix the member, and the scale of a crank-rocker.
        number: of designs in all.
        sort: by what the best is sought, by default the transmission angle.

    A slider has the stroke of the task, a rocker the length 1 unless lengths are given. Where no member meets all
    demands, the one without which the most do is named. Raises `SynthesisError` as `dead_centre_family`. Cost: 30 ms,
    with demands 0.5 s.

    >>> found = synthesise_dead_centres(DeadCentreTask(stroke=50, time_ratio=1.2))
    >>> round(found.designs[0].linkage.length("crank", 0, 1), 4)
    23.5237
    """
    wanted = (demands or Demands()).of_task(task)
    orders = tuple("transmission" if name == "range-transmission" else name for name in sort)  # its crank turns fully
    family = dead_centre_family(task)
    low, high = family.range
    scale = task.stroke or 1.0
    notes = [
        _NOTES[is_half_turn(task), task.swing is not None].filled(
            low=low * scale,
            high=high * scale,
            angle=degrees(family.best.transmission),
            limit=90 - degrees(task.swing or 0.0) / 2,
        )
    ]
    notes += _other_sense(task)
    chosen = _spread(family.members, family.best, number)
    if wanted.limits_of_size or orders or not _design(task, family.best, wanted).verdict.accepted:
        chosen = _searched(family, wanted, orders, number, notes)
    designs = [_design(task, member, wanted) for member in chosen]
    accepted = in_order_of((d for d in designs if d.verdict.accepted), (*orders, "transmission"))
    rejected = tuple(d for d in designs if not d.verdict.accepted)
    count = SolutionCount(what=message("linkages"), theorem=None, found=len(designs), real=len(designs))
    return SynthesisResult(task=task, designs=accepted, rejected=rejected, count=count, notes=tuple(notes))


def _other_sense(task: DeadCentreTask) -> Iterator[Message]:
    """What a crank and a rocker with the same dead centres do that turn opposite ways in the given angle."""
    if task.crank_angle is None or task.swing is None or abs(task.crank_angle - pi) < _SAME:
        return
    with suppress(SynthesisError):  # there is none
        other = dead_centre_family(replace(task, crank_angle=2 * pi - task.crank_angle))
        yield message(
            "While the crank turns by {own:.4g}°, the rocker turns the same way; where it turns the opposite way "
            "(crank angle {rest:.4g}°), the best minimum transmission angle is {angle:.4g}°.",
            own=degrees(task.crank_angle),
            rest=degrees(2 * pi - task.crank_angle),
            angle=degrees(other.best.transmission),
        )


def _spread(members: Sequence[FamilyMember], best: FamilyMember, number: int) -> list[FamilyMember]:
    """The best for its part of some members, the middle for each other part: at the limits nothing moves well."""
    parts = np.array_split(np.arange(len(members)), max(number, 1))
    nearest = min(range(len(members)), key=lambda k: abs(members[k].parameter - best.parameter))
    return [best, *(members[part[len(part) // 2]] for part in parts if len(part) and nearest not in part)]


def _searched(
    family: DeadCentreFamily, demands: Demands, orders: Sequence[str], number: int, notes: list[Message]
) -> list[FamilyMember]:
    """Members that meet the demands, the best of them first; some of all where none does, with the reason."""
    task, squares, half_turn = family.task, LengthSquares.of(family.task), is_half_turn(family.task)
    of_lengths = _of_given_lengths(task, squares, demands)
    if of_lengths is not None:
        members = _members_at(task, squares, of_lengths)
        if not members:
            notes.append(message("No member has the given lengths."))
            return _spread(family.members, family.best, number)
        return members
    limits = squares.limits(demands)
    ends = [squares.low, *limits, squares.high]
    middles = [(first + second) / 2 for first, second in pairwise(ends)]
    meets = [any(_design(task, m, demands).verdict.accepted for m in _members_at(task, squares, [t])) for t in middles]
    beside = [t for limit in limits for t in (limit * (1 - _BESIDE), limit, limit * (1 + _BESIDE))]
    tried = _members_at(task, squares, [*middles, *beside, squares.high * (1 - _BESIDE)])
    designs = [_design(task, member, demands) for member in tried]
    good = [k for k, design in enumerate(designs) if design.verdict.accepted]
    if not good:
        members = [*family.members, family.best]
        notes.append(_PROVED_NONE[half_turn].filled(most=(task.stroke or 1.0) * sqrt(squares.high)))
        notes += tightest(_met([_design(task, member, demands) for member in members], demands))
        return _spread(members, max(members, key=lambda member: member.transmission), number)
    of_coupler = [[squares.crank_and_coupler(t)[half_turn] for t in pair] for pair in _joined(ends, meets)]
    ranges = sorted((min(pair), max(pair)) for pair in of_coupler)
    scale = task.stroke or scale_to_length(tried[good[0]].linkage.linkage(), demands)
    said = [_RANGE.filled(low=scale * low, high=scale * high) for low, high in ranges]
    notes.append(_MEET[half_turn].filled(ranges=joined_by_and(said), most=scale * sqrt(squares.high)))
    orders = (*orders, "transmission")
    if orders[0] in MEASURES and orders[0] != _UNEVEN:
        notes.append(_FIRST.filled(measure=MEASURES[orders[0]]))
    first = in_order_of([designs[k] for k in good], orders)[0]
    best = tried[next(k for k in good if designs[k] is first)]
    within = [m for m in family.members if any(low < m.parameter < high for low, high in ranges)]
    if _UNEVEN in orders:
        best = _improved(task, [best, *within[::4]], demands, orders, family.range[1] - family.range[0])
        notes.append(_ON_GRIDS)
    return _spread(within, best, number) if within else [best]


def _members_at(task: DeadCentreTask, squares: LengthSquares, places: Iterable[float]) -> list[FamilyMember]:
    """The members whose couplers have these squares."""
    members = (_member_of_lengths(task, *squares.crank_and_coupler(t)) for t in places)
    return [member for member in members if member is not None]


def _joined(ends: Sequence[float], meets: Sequence[bool]) -> list[tuple[float, float]]:
    """The ranges between ends in which the demands are met, neighbours as one."""
    ranges: list[tuple[float, float]] = []
    for low, high, good in zip(ends, ends[1:], meets, strict=False):
        if good and ranges and ranges[-1][1] == low:
            ranges[-1] = ranges[-1][0], high
        elif good:
            ranges.append((low, high))
    return ranges


def _improved(
    task: DeadCentreTask, begun: Sequence[FamilyMember], demands: Demands, orders: Sequence[str], width: float
) -> FamilyMember:
    """The best of some by what has no extremes in closed form, and then on ever finer grids about it."""

    def best_of(some: Sequence[FamilyMember]) -> FamilyMember:
        designs = [_design(task, member, demands) for member in some]
        first = in_order_of([design for design in designs if design.verdict.accepted], orders)[0]
        return some[next(k for k, design in enumerate(designs) if design is first)]

    best = best_of(begun)
    width /= 50  # more than between two that were begun with
    while width > _FINEST * best.parameter:
        places = best.parameter + np.linspace(-1, 1, 9) * width
        best = best_of([best, *(m for place in places if place > 0 and (m := _member(task, float(place))) is not None)])
        width /= 3
    return best


def _met(designs: Sequence[Design], demands: Demands) -> list[tuple[Message, NDArray[np.bool_]]]:
    """The demands by their names, each with the designs that meet it; the first is the task itself."""
    verdicts = [design.verdict for design in designs]
    ratio = message("a size ratio of {ratio:g}", ratio=demands.size_ratio)
    met = [
        (message("dead centres"), np.ones(len(designs), bool)),
        (ratio, np.array([verdict.size_ratio <= demands.size_ratio for verdict in verdicts])),
    ]
    if demands.transmission > 0:
        angle = LEAST_ANGLE.filled(angle=degrees(demands.transmission))
        met.append((angle, np.array([verdict.transmission >= demands.transmission for verdict in verdicts])))
    return met


def _of_given_lengths(task: DeadCentreTask, squares: LengthSquares, demands: Demands) -> list[float] | None:
    """Where members have the given lengths: two of them fix a crank-rocker, one a slider-crank; None where fewer do."""
    known = [row for row in demands.lengths if row[0] in squares.squares]
    if len(known) < (1 if task.swing is None else 2):
        return None
    link, wanted = known[0]
    other, its = ("stroke", task.stroke) if task.stroke is not None else known[1]
    return squares.with_ratio(link, other, wanted / its)


_PROVED_NONE = {
    False: message("Proved: no member meets all demands."),
    True: message("Proved: no member with a coupler of up to {most:.4g} meets all demands."),
}
_MEET = {
    False: message("Crank lengths that meet all demands: {ranges}; no others do."),
    True: message("Coupler lengths that meet all demands: {ranges}; no others up to {most:.4g} do."),
}
"""By whether the dead centres are half a turn apart."""
_FIRST = message("All members that can be the best by {measure} were compared: it is the first design.")
_RANGE = message("from {low:.4g} to {high:.4g}")
_UNEVEN = "sensitivity"
_ON_GRIDS = message(
    "The least sensitive one was sought among members spread over these and then on ever finer grids about the best of "
    "them; that no other is less sensitive is not proved."
)
_NOTES = {
    (False, False): message(
        "There are infinitely many solutions, one for each crank length from {low:.4g} to {high:.4g}; the best minimum "
        "transmission angle is {angle:.2f}°."
    ),
    (False, True): message(
        "There are infinitely many solutions, one for each crank length from {low:.4g} to {high:.4g} (rocker 1); the "
        "best minimum transmission angle is {angle:.2f}°."
    ),
    (True, False): message(
        "There are infinitely many solutions, one for each coupler length, here from {low:.4g} to {high:.4g}; the "
        "minimum transmission angle grows with it, here to {angle:.2f}°, and always stays below {limit:.4g}°."
    ),
    (True, True): message(
        "There are infinitely many solutions, one for each coupler length, here from {low:.4g} to {high:.4g} (rocker "
        "1); the minimum transmission angle grows with it, here to {angle:.2f}°, and always stays below {limit:.4g}°."
    ),
}
"""By whether the dead centres are half a turn apart, and whether the output is a rocker."""


def _design(task: DeadCentreTask, member: FamilyMember, demands: Demands) -> Design:
    linkage = member.linkage.linkage(unit=task.unit)
    linkage = linkage.scaled(task.stroke or scale_to_length(linkage, demands))
    known = verdict_at_rest(linkage, demands)
    reasons = [*known.reasons]
    if member.transmission < demands.transmission:
        reasons.append(transmission_fault(member.transmission))
    centres = member.linkage.dead_centres
    assert centres is not None
    error = abs(centres.travel - (task.swing if task.swing is not None else 1.0))
    verdict = replace(
        PASSED,
        turns_fully=True,
        transmission=member.transmission,
        size_ratio=known.size_ratio,
        inside=known.inside,
        error=error,
        reasons=tuple(reasons),
    )
    kind = "four-bar" if task.swing is not None else "slider-crank"
    return Design(
        linkage=linkage, verdict=verdict, form=kind, drives=(centres.outer.drive, centres.inner.drive), reach=task.reach
    )
