"""Crank-rockers and slider-cranks with given dead centres (Alt's construction), and the best transmission angle.

docs/theory/synthesis-dead-centres.md derives the one-parameter family and its limits.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, degrees, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError, SynthesisError
from gruebler.base.text import Message, message
from gruebler.design.synthesis.demands import Demands, tightest
from gruebler.design.synthesis.given_lengths import scale_to_length
from gruebler.design.synthesis.judging import faults_of_size, pivots_inside, size_ratio, transmission_fault
from gruebler.design.synthesis.results import PASSED, Design, SolutionCount, SynthesisResult, in_order_of
from gruebler.design.synthesis.tasks import DeadCentreTask
from gruebler.mechanics.fourbar import FourBar, SliderCrank

_SAMPLES = 720
_FINEST = 1e-10  # of the parameter: so near to the best of its neighbours a member is
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
    from scipy.optimize import minimize_scalar

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
    best = max(members, key=lambda member: member.transmission)
    k = int(np.argmin(np.abs(grid - best.parameter)))
    bounds = (float(grid[max(k - 1, 0)]), float(grid[min(k + 1, len(grid) - 1)]))

    def cost(value: float) -> float:
        member = _member(task, float(value))
        return 0.0 if member is None else -member.transmission

    answer = minimize_scalar(cost, bounds=bounds, method="bounded", options={"xatol": 1e-12})
    refined = _member(task, float(answer.x))
    if refined is not None and refined.transmission > best.transmission:
        best = refined
    return DeadCentreFamily(task, members, best)


def _parameters(task: DeadCentreTask) -> Reals:
    """Values of the parameter, denser at the ends; the chord of the dead centres is that of a rocker or stroke of 1."""
    share = (1 - np.cos(np.pi * (np.arange(_SAMPLES) + 0.5) / _SAMPLES)) / 2
    chord = _chord(task)
    half = (task.angle - pi) / 2
    if abs(half) < 1e-12:
        return np.asarray(chord * (0.5 + 20 * share**2))  # the coupler, up to twenty times the chord
    return np.asarray(chord / (2 * cos(half)) * share)


def _chord(task: DeadCentreTask) -> float:
    return 1.0 if task.swing is None else 2 * sin(task.swing / 2)


def _lengths(task: DeadCentreTask, parameter: float) -> tuple[float, float] | None:
    """Crank and coupler: chord^2 = 4 a^2 cos^2(h) + 4 b^2 sin^2(h), with h half of what exceeds half a turn."""
    chord, half = _chord(task), (task.angle - pi) / 2
    if abs(half) < 1e-12:
        return chord / 2, parameter
    square = chord**2 / 4 - (parameter * cos(half)) ** 2
    return (parameter, sqrt(square) / abs(sin(half))) if square > 0 else None


def _member(task: DeadCentreTask, parameter: float) -> FamilyMember | None:
    """The linkage of a parameter, checked by its closed form; None if it has other dead centres."""
    sizes = _lengths(task, parameter)
    if sizes is None or not 0 < sizes[0] < sizes[1]:
        return None
    a, b = sizes
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
        return FamilyMember(parameter, linkage, float(linkage.transmission_angle.smallest.mu))
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
        _NOTES[abs(task.angle - pi) < 1e-12, task.swing is not None].filled(
            low=low * scale, high=high * scale, angle=degrees(family.best.transmission)
        )
    ]
    notes += _other_sense(task)
    chosen = _spread(family.members, family.best, number)
    lengths = _named_lengths(family.best.linkage).values()
    if wanted.limits_of_size or orders or max(lengths) > wanted.size_ratio * min(lengths):
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
    """Members that meet the demands, the best of them improved; some of all where none does, with the reason."""
    task = family.task
    of_lengths = _of_given_lengths(family, demands)
    members = [*family.members, family.best] if of_lengths is None else of_lengths
    designs = [_design(task, member, demands) for member in members]
    good = [k for k, design in enumerate(designs) if design.verdict.accepted]
    if of_lengths == []:
        notes.append(message("No member has the given lengths."))
        return _spread(family.members, family.best, number)
    notes.append(
        message(
            "Linkages of the family that meet all demands: {count:,} of {members:,}.",
            members=len(members),
            count=len(good),
        )
    )
    if not good:
        notes += tightest(_met(designs, demands))
        return _spread(members, max(members, key=lambda member: member.transmission), number)
    if of_lengths is not None:
        return members
    orders = (*orders, "transmission")
    best = members[next(k for k in good if designs[k] is in_order_of([designs[k] for k in good], orders)[0])]
    width = (family.range[1] - family.range[0]) / 50  # more than between any two members
    while width > _FINEST * best.parameter:
        places = best.parameter + np.linspace(-1, 1, 9) * width
        near = [m for place in places if place > 0 and (m := _member(task, float(place))) is not None]
        nearby = [_design(task, member, demands) for member in (best, *near)]
        first = in_order_of([design for design in nearby if design.verdict.accepted], orders)[0]
        best = (best, *near)[next(k for k, design in enumerate(nearby) if design is first)]
        width /= 3
    return _spread([members[k] for k in good], best, number)


def _met(designs: Sequence[Design], demands: Demands) -> list[tuple[Message, NDArray[np.bool_]]]:
    """The demands by their names, each with the designs that meet it; the first is the task itself."""
    verdicts = [design.verdict for design in designs]
    ratio = message("a size ratio of {ratio:g}", ratio=demands.size_ratio)
    met = [
        (message("dead centres"), np.ones(len(designs), bool)),
        (ratio, np.array([verdict.size_ratio <= demands.size_ratio for verdict in verdicts])),
        (message("the region"), np.array([verdict.inside for verdict in verdicts])),
    ]
    if demands.transmission > 0:
        angle = message("a transmission angle of {angle:g}°", angle=degrees(demands.transmission))
        met.append((angle, np.array([verdict.transmission >= demands.transmission for verdict in verdicts])))
    return met


_LINKS = {"a": "crank", "b": "coupler", "c": "rocker", "d": "frame"}


def _named_lengths(linkage: FourBar | SliderCrank) -> dict[str, float]:
    return {_LINKS[letter]: length for letter, length in linkage.named.items() if letter in _LINKS}


def _of_given_lengths(family: DeadCentreFamily, demands: Demands) -> list[FamilyMember] | None:
    """The members with the given lengths: two of them fix a crank-rocker, one a slider-crank; None where fewer do."""
    from scipy.optimize import brentq

    task = family.task
    known = [row for row in demands.lengths if row[0] in _named_lengths(family.best.linkage)]
    if len(known) < (1 if task.swing is None else 2):
        return None
    link, wanted = known[0]

    def gap(member: FamilyMember) -> float:
        lengths = _named_lengths(member.linkage)
        if task.stroke is not None:
            return lengths[link] * task.stroke / wanted - 1
        other, its = known[1]
        return lengths[link] * its / (lengths[other] * wanted) - 1

    def gap_at(parameter: float) -> float:
        member = _member(task, parameter)
        return float("nan") if member is None else gap(member)

    exact: list[FamilyMember] = []
    gaps = [gap(member) for member in family.members]
    for k, (first, second) in enumerate(pairwise(gaps)):
        if first * second <= 0:
            ends = family.members[k].parameter, family.members[k + 1].parameter
            member = _member(task, float(brentq(gap_at, *ends, xtol=1e-15 * ends[1], rtol=1e-15)))
            if member is not None and abs(gap(member)) < _SAME:
                exact.append(member)
    return exact


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
        "There are infinitely many solutions, one for each coupler length, here from {low:.4g} to {high:.4g}; the best "
        "minimum transmission angle is {angle:.2f}°."
    ),
    (True, True): message(
        "There are infinitely many solutions, one for each coupler length, here from {low:.4g} to {high:.4g} (rocker "
        "1); the best minimum transmission angle is {angle:.2f}°."
    ),
}
"""By whether the dead centres are half a turn apart, and whether the output is a rocker."""


def _design(task: DeadCentreTask, member: FamilyMember, demands: Demands) -> Design:
    linkage = member.linkage.linkage(unit=task.unit)
    linkage = linkage.scaled(task.stroke or scale_to_length(linkage, demands))
    ratio, inside = size_ratio(linkage), pivots_inside(linkage, demands.region)
    reasons = faults_of_size(linkage, ratio, inside, demands)
    if member.transmission < demands.transmission:
        reasons.append(transmission_fault(member.transmission))
    centres = member.linkage.dead_centres
    assert centres is not None
    error = abs(centres.travel - (task.swing if task.swing is not None else 1.0))
    verdict = replace(
        PASSED,
        turns_fully=True,
        transmission=member.transmission,
        size_ratio=ratio,
        inside=inside,
        error=error,
        reasons=tuple(reasons),
    )
    kind = "four-bar" if task.swing is not None else "slider-crank"
    return Design(linkage=linkage, verdict=verdict, form=kind, drives=(centres.outer.drive, centres.inner.drive))
