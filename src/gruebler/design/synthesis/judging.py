"""Whether a design does what was wanted: one judgement for every kind of task, by following the whole circuit.

docs/theory/synthesis.md defines the criteria. What a synthesis computed is not believed: the circuit is followed from
the linkage's reference pose without regard to the drive, the places where it meets each target are sought on it, and
`move` carries the linkage through them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, joined, message
from gruebler.design.synthesis.demands import (
    EXACT_AT_MOST,
    Demands,
    across_direction,
    distance_of_pivots,
    inside_region,
)
from gruebler.design.synthesis.results import EXACT, TOO_SLENDER, Design, DesignVerdict, ranked
from gruebler.design.synthesis.target_paths import TargetPath, path_through, place_on_branch
from gruebler.design.synthesis.target_places import places_approached, places_met
from gruebler.design.synthesis.targets import GuidedCurve, Targets
from gruebler.mechanics.analysis import transmission_angle
from gruebler.mechanics.fourbar import grashof
from gruebler.mechanics.kinematics import Circuit, circuit
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage

_ROUNDING = 1e-13  # of the linkage's size: what the poses of a large linkage for a small task cannot promise
_FAR = 100.0
"""Sizes of linkage and targets: an open circuit is followed so far, and farther only where it is still near them."""
_STEP = 0.05  # along a circuit, in sizes and radians
_FINE = 64
_APART = 1e-6  # of the drive: poses that are not one and the same
_ROWS = 16  # poses from one target to the next, with several drives
OTHER_LENGTH = message("the length of the {link} is not {wanted}, but {found}")
NO_LENGTH = message("{link}: no length, since this link has fewer than two pins")
OTHER_DIRECTION = message("the direction of the frame is not {wanted:.5g}°, but {found}")
ONE_PIVOT = message("the frame has no direction, since it has fewer than two pivots")
MISSED = message(
    "target {target} cannot be reached without taking the linkage apart: the circuit comes no nearer than "
    "{error:.3g} of the size"
)
TOO_FAR = message("a target is missed by {error:.3g} of the size")
SEVERAL_MISSED = message(
    "targets {targets} cannot be reached without taking the linkage apart: the circuit comes no nearer than "
    "{error:.3g} of the size"
)
ANOTHER_ORDER = message(
    "the targets are met in another order; in that of the task one is missed by {error:.3g} of the size"
)
_DIGITS = range(6, 18)  # of a length: as many as tell it from the one that is given


def best_of(linkages: Iterable[Linkage], targets: Callable[[Linkage], Targets], demands: Demands, form: str) -> Design:
    """The best of linkages that differ in their drive, as designs are ranked: an accepted one if there is any."""
    accepted, rejected = ranked(judged_by_drive(linkages, targets, demands, form))
    return (*accepted, *rejected)[0]


def judged_by_drive(
    linkages: Iterable[Linkage], targets: Callable[[Linkage], Targets], demands: Demands, form: str
) -> Iterator[Design]:
    """The designs of linkages that differ in their drive; of those whose circuit decides, the first one."""
    for linkage in linkages:
        design = judge_design(linkage, targets(linkage), demands, form)
        yield design
        if decided_by_path(design.verdict, demands):
            break


def decided_by_path(verdict: DesignVerdict, demands: Demands) -> bool:
    """Whether a circuit was followed and rejected for itself, whatever drives it: for a target, or for their order."""
    return verdict.assembles and not (verdict.one_circuit and (verdict.in_order or not demands.in_order))


def rejected_alike(linkage: Linkage, other: Design, demands: Demands) -> Design:
    """The design of a linkage whose point has the path of another one, a cognate of it, that its path decided."""
    own = verdict_at_rest(linkage, demands)
    verdict = replace(
        other.verdict,
        turns_fully=_crank_turns(linkage),
        size_ratio=own.size_ratio,
        inside=own.inside,
        pivot_distance=own.pivot_distance,
        reasons=(*own.reasons, other.verdict.reasons[-1]),
    )
    return replace(other, linkage=linkage, verdict=verdict)


def _crank_turns(four_bar: Linkage) -> bool:
    """Whether the crank of a four-bar turns fully, by Grashof's condition, whatever its circuit."""
    crank, coupler, rocker, frame = (
        distances_of_pins(four_bar, link)[0] for link in ("crank", "coupler", "rocker", "frame")
    )
    return "a" in grashof(crank, coupler, rocker, frame).turning


def order_notes(designs: Iterable[Design], demands: Demands) -> tuple[Message, ...]:
    """How many designs are rejected only for the order of the targets, where none is accepted.

    Cost: up to 30 ms for each one that meets the targets in another order, only where none is accepted.
    """
    designs = [*designs]
    if not demands.in_order or any(design.verdict.accepted for design in designs):
        return ()
    free, count = replace(demands, in_order=False), 0
    for each in designs:
        if each.targets is not None and each.verdict.one_circuit and not each.verdict.in_order:
            driven = (each.linkage, *_driven_elsewhere(each.linkage, each.targets))
            count += any(judge_design(some, each.targets, free, each.form).verdict.accepted for some in driven)
    return (message("Designs rejected only for the order of the targets: {count}.", count=count),) if count else ()


def _driven_elsewhere(linkage: Linkage, targets: Targets) -> Iterator[Linkage]:
    """A four-bar driven at its other pivot, unless its targets are of a link that turns there."""
    mechanism = linkage.mechanism
    chain, frame = mechanism.chain, mechanism.frame
    held = {other for joint in chain.joints if frame in joint.links for other in joint.links} - {frame}
    turning = not any(joint.pair.is_sliding for joint in chain.joints)
    if turning and len(chain.links) == len(chain.joints) == 4 and held.isdisjoint(p.link for p in targets.probes):
        (drive,) = mechanism.drives
        yield from (linkage.with_frame(frame, other) for other in held - {*drive.between})


def judge_design(linkage: Linkage, targets: Targets, demands: Demands, form: str) -> Design:
    """The design of a linkage with a reference pose, and its verdict. Cost: 3 to 30 ms, most for the circuit.

    >>> from math import radians
    >>> from gruebler.design.synthesis.targets import point_targets
    >>> from gruebler.mechanics.fourbar import FourBar
    >>> from gruebler.mechanics.kinematics import move
    >>> bar = FourBar(1, 3, 2.5, 3.5).linkage({"P": (1.2, 0.8)})
    >>> motion = move(bar, [radians(10), radians(35), radians(60)])
    >>> bar = bar.with_reference_pose(motion.pose(0))
    >>> judge_design(bar, point_targets("P", motion.complex_point("P"), 1.0), Demands(), "four-bar").verdict.accepted
    True
    """
    known = verdict_at_rest(linkage, demands, travel=targets.travel)
    reasons = [*known.reasons]
    if targets.in_any_order:
        demands = replace(demands, in_order=False)
    try:
        course = circuit_near(linkage, targets)
        known = replace(known, turns_fully=_turns_fully(course))
        limit = demands.tolerance + _ROUNDING * linkage.size / targets.size
        if demands.tolerance <= EXACT_AT_MOST:
            met = places_met(course, targets, limit)
        else:
            met = places_approached(course, targets, limit, in_order=demands.in_order)
        if met.places.empty:
            reasons.append(_missed([k + 1 for k in met.places.empty], met.error))
            verdict = replace(known, assembles=True, error=met.error, reasons=tuple(reasons))
            return Design(linkage=linkage, verdict=verdict, form=form, targets=targets)
        if demands.in_order and not met.ordered:
            reasons.append(_in_another_order(np.nan))
            verdict = replace(known, assembles=True, one_circuit=True, error=met.error, reasons=tuple(reasons))
            return Design(linkage=linkage, verdict=verdict, form=form, targets=targets)
        # Of two targets each way is in order.
        both_ways = len(targets.values) == 2 and not targets.there_and_back
        any_order = targets.curve is GuidedCurve.NONE and (both_ways or not demands.in_order)
        shortest = targets.order if any_order else None
        path = path_through(course, met, limit, in_order=demands.in_order, shortest=shortest)
        drives: tuple[float, ...] = ()
        missed_by, transmission = met.error if path.in_order else path.error, np.nan
        misses = np.full(len(targets.values), np.nan)
        if path.one_branch:
            if (begin := place_on_branch(course, path)) is not None:
                linkage = linkage.with_reference_pose(course.at(np.array([begin])).pose(0))
            drives, misses, transmission = _carried(linkage, course, path, targets)
            missed_by = float(misses.max())
    except LinkageError as error:
        reasons.append(message("it cannot be followed from its first position: {error}", error=error))
        return Design(linkage=linkage, verdict=replace(known, reasons=tuple(reasons)), form=form)
    if not path.in_order and demands.in_order:
        reasons.append(_in_another_order(path.error))
        missed_by = max(missed_by, path.error)
    reasons += _faults_of_way(path, misses, targets, demands, limit)
    piece = _way_between(course, path, targets)
    if piece.excess > limit:
        reasons.append(
            message(
                "between targets {first} and {second} the point leaves the curve: it goes {distance:.3g} of the size "
                "from the line between them",
                first=piece.target + 1,
                second=(piece.target + 1) % len(targets.values) + 1,
                distance=piece.distance,
            )
        )
    reasons += _faults_of_drive(path, misses, demands, full=known.turns_fully, transmission=float(transmission))
    verdict = replace(
        known,
        assembles=True,
        one_circuit=True,
        one_branch=path.one_branch,
        in_order=path.in_order,
        transmission=float(transmission),
        error=float(missed_by),
        between=piece.distance,
        reasons=tuple(reasons),
    )
    return Design(linkage=linkage, verdict=verdict, form=form, drives=drives, targets=targets)


def circuit_near(linkage: Linkage, targets: Targets) -> Circuit:
    """The circuit of a linkage; where its slides leave the targets for good, only the part near them."""
    far = min(_FAR * (1 + targets.size / linkage.size), 1000.0)
    course = circuit(linkage, step=_STEP, most=far)
    places = np.delete(course.traced.poses, np.s_[2::3], axis=1)  # without angles
    gone = np.ptp(places, axis=0).max() > far / 4
    return course if gone or course.traced.ended != "long" else circuit(linkage, step=_STEP)


class _WayBetween(NamedTuple):
    """Where the way between two neighbouring targets lies worst."""

    target: int
    distance: float
    """From the line between them, relative to the size."""
    excess: float
    """Beyond half that line: an arc up to a half circle is as good as any other between two points of a curve."""


def _way_between(course: Circuit, path: TargetPath, targets: Targets) -> _WayBetween:
    """The worst piece of the way along a curve, at the samples of the circuit; nothing where the way is free."""
    if targets.curve is GuidedCurve.NONE or not path.in_order:
        return _WayBetween(0, np.nan, 0.0)
    sense = 1.0 if path.arcs[-1] >= path.arcs[0] else -1.0
    arcs, places = sense * path.arcs, targets.values[:, 0]
    if targets.curve is GuidedCurve.CLOSED and course.closed:
        arcs, places = np.append(arcs, arcs[0] + course.length), np.append(places, places[0])
    laps = (-2, -1, 0, 1, 2) if course.closed else (0,)
    between = np.sort(np.concatenate([sense * course.arcs + k * course.length for k in laps]))
    between = between[(between > arcs[0]) & (between < arcs[-1])]
    if not len(between):
        return _WayBetween(0, 0.0, 0.0)
    target = np.clip(np.searchsorted(arcs, between, side="right") - 1, 0, len(places) - 2)
    start, line = places[target], (places[1:] - places[:-1])[target]
    gone = targets.probes[0].value(course.at(sense * between), 0) - start
    share = np.clip(np.real(gone * np.conj(line)) / np.maximum(np.abs(line) ** 2, 1e-300), 0, 1)
    distance = np.abs(gone - share * line)
    excess = distance - np.abs(line) / 2
    worst = int(excess.argmax())
    return _WayBetween(
        int(target[worst]), float(distance[worst]) / targets.size, max(0.0, float(excess[worst]) / targets.size)
    )


def judge_with_drives(linkage: Linkage, targets: Targets, demands: Demands, form: str, drives: Reals) -> Design:
    """The verdict on a linkage with several drives, which `move` carries from target to target.

    Args:
        linkage: in the position of the first target.
        targets: as for `judge_design`.
        demands: of order and branch nothing is left, since the drives choose the way; a full turn is refused.
        form: of the design.
        drives: (targets, drives) their values at the targets; between two targets they go evenly.
    """
    known = verdict_at_rest(linkage, demands)
    reasons = [*known.reasons]
    between = np.linspace(0, len(drives) - 1, _ROWS * (len(drives) - 1) + 1)
    rows = np.stack([np.interp(between, np.arange(len(drives)), column) for column in drives.T], axis=1)
    misses, rounding = np.full(len(drives), np.inf), _ROUNDING * linkage.size / targets.size
    try:
        motion = move_quietly(linkage, rows)
        if motion.complete:
            values = np.stack([probe.of_motion(motion)[::_ROWS] for probe in targets.probes], axis=1)
            misses = np.sqrt(np.nansum(np.abs(values - targets.values) ** 2, axis=1)) / targets.size
    except LinkageError as fault:
        reasons.append(message("it cannot be followed from its first position: {error}", error=fault))
    error = float(misses.max())
    if not np.isfinite(error):
        reasons.append(message("`move` does not lead through all targets"))
    elif error > demands.tolerance + rounding:
        reasons.append(TOO_FAR.filled(error=error))
    elif targets.allowed is not None:
        reasons += _beyond_tolerance(misses, targets.allowed, rounding)
    if demands.crank:
        reasons.append(message("with several drives none has to turn fully"))
    if demands.transmission > 0:
        reasons.append(message("with several drives there is no transmission angle"))
    moved = bool(np.isfinite(error))
    verdict = replace(
        known,
        assembles=moved,
        one_circuit=moved,
        one_branch=moved,
        in_order=moved,
        error=error if moved else np.nan,
        reasons=tuple(reasons),
    )
    return Design(
        linkage=linkage,
        verdict=verdict,
        form=form,
        drive_rows=tuple(tuple(map(float, row)) for row in drives),
        targets=targets,
    )


def verdict_at_rest(linkage: Linkage, demands: Demands, *, travel: float = np.inf) -> DesignVerdict:
    """What is known of a linkage before it moves: the place of its pivots, its lengths and their ratio."""
    frame = linkage.mechanism.frame
    pins = [e for (_, owner), e in linkage.elements.items() if owner == frame and not e.is_line]
    pivots = [np.array(complex(e.x, e.y)) for e in pins]
    ratio, inside = size_ratio(linkage, travel), all(inside_region(pivot, demands) for pivot in pivots)
    away = float(distance_of_pivots(pivots, demands))
    return DesignVerdict(
        size_ratio=ratio,
        inside=inside,
        pivot_distance=away if np.isfinite(away) else np.nan,
        reasons=tuple(_faults_of_size(linkage, ratio, inside, demands)),
    )


def _faults_of_size(linkage: Linkage, ratio: float, inside: bool, demands: Demands) -> list[Message]:
    """What speaks against it."""
    faults = []
    for link, wanted in demands.lengths:
        distances = distances_of_pins(linkage, link)
        if not distances:
            faults.append(NO_LENGTH.filled(link=message(link)))
        elif not any(abs(length - wanted) <= EXACT * max(wanted, linkage.size) for length in distances):
            own, *others = _told_apart(wanted, *distances)
            faults.append(OTHER_LENGTH.filled(link=message(link), wanted=own, found=joined(others, "; ")))
    if demands.frame_direction is not None:
        faults += _faults_of_direction(linkage, demands.frame_direction)
    if not inside:
        faults.append(message("a fixed pivot lies outside the region"))
    if ratio > demands.size_ratio:
        faults.append(TOO_SLENDER.filled(ratio=ratio))
    return faults


def _faults_of_direction(linkage: Linkage, direction: float) -> Iterator[Message]:
    """What speaks against the frame: no two of its pivots lie in the direction."""
    gaps = gaps_of_pins(linkage, linkage.mechanism.frame)
    if not gaps:
        yield ONE_PIVOT
    elif not any(abs(across_direction(gap, direction)) <= EXACT * np.hypot(*gap) for gap in np.array(gaps)):
        angles = [Message("{angle:.5g}°", {"angle": np.degrees(np.arctan2(y, x)) % 180}) for x, y in gaps]
        yield OTHER_DIRECTION.filled(wanted=np.degrees(direction), found=joined(angles, "; "))


def _told_apart(wanted: float, *lengths: float) -> list[Message]:
    """A length and others with six digits, or as many as differ.

    >>> print(joined(_told_apart(3.558, 3.5580558)), joined(_told_apart(3.55806, 3.5580558)), sep=", ")
    3.558, 3.55806, 3.55806, 3.558056
    """
    digits = next(
        (n for n in _DIGITS if all(f"{wanted:.{n}g}" != f"{length:.{n}g}" for length in lengths)), _DIGITS[-1]
    )
    return [Message(f"{{length:.{digits}g}}", {"length": length}) for length in (wanted, *lengths)]


def _faults_of_way(
    path: TargetPath, misses: Reals, targets: Targets, demands: Demands, limit: float
) -> Iterator[Message]:
    """What speaks against the way through the targets, (targets,) of which are missed by so much."""
    carried = float(misses.max())
    if not path.one_branch:
        if demands.one_branch:
            yield message("the drive has to turn back between the targets (two branches)")
    elif not np.isfinite(carried):
        yield message("`move` does not lead through all targets")
    elif not carried <= limit:
        yield TOO_FAR.filled(error=carried)
    elif targets.allowed is not None:
        yield from _beyond_tolerance(misses, targets.allowed, limit - demands.tolerance)


def _faults_of_drive(
    path: TargetPath, misses: Reals, demands: Demands, *, full: bool, transmission: float
) -> Iterator[Message]:
    """A drive that does not turn although it should, a transmission angle that is too small."""
    if demands.crank and not full:
        yield message("the drive does not turn fully")
    if demands.transmission > 0 and np.isfinite(misses).all() and not transmission >= demands.transmission:
        yield transmission_fault(transmission)
    elif demands.transmission > 0 and not (path.one_branch or demands.one_branch):
        yield message("where the drive turns back there is no transmission angle")


def _beyond_tolerance(misses: Reals, allowed: Reals, rounding: float) -> Iterator[Message]:
    """Which target is missed by more than its own tolerance, and by how much."""
    over = misses - allowed - EXACT - rounding
    worst = int(over.argmax())
    if over[worst] > 0:
        yield message(
            "target {number} is missed by {error:.3g} of the size, its tolerance is {tolerance:.3g}",
            number=worst + 1,
            error=float(misses[worst]),
            tolerance=float(allowed[worst]),
        )


def transmission_fault(transmission: float) -> Message:
    """That a transmission angle, in radians, is too small, or that there is none: NaN."""
    if np.isnan(transmission):
        return message("there is no transmission angle, as no dyad drives the output")
    return message("the transmission angle falls to {angle:.1f}°", angle=np.degrees(transmission))


def _missed(targets: list[int], error: float) -> Message:
    """Which targets the circuit misses, at most nine by their numbers, and how near it comes to the worst."""
    if len(targets) == 1:
        return MISSED.filled(target=targets[0], error=error)
    return SEVERAL_MISSED.filled(targets=joined([*targets[:9], *(["..."] if len(targets) > 9 else [])]), error=error)


def _in_another_order(error: float) -> Message:
    """That the circuit passes the targets in another order; by how much one is missed in theirs, if that is known."""
    if np.isnan(error):
        return message("the targets are met in another order")
    return ANOTHER_ORDER.filled(error=error)


def size_ratio(linkage: Linkage, travel: float = np.inf) -> float:
    """The longest distance of two pins of a link by the shortest; points on slides do not count.

    Where something slides, and about how far is known, this travel counts as a length, too.
    """
    lengths = [length for link in linkage.mechanism.chain.links for length in distances_of_pins(linkage, link)]
    if not lengths:
        return 1.0
    slides = any(not element.is_pin for element in linkage.elements.values())
    return max(lengths) / min(*lengths, travel if slides else np.inf)


def distances_of_pins(linkage: Linkage, link: str) -> list[float]:
    """The distances of the pins of a link, each with each."""
    return [abs(complex(*gap)) for gap in gaps_of_pins(linkage, link)]


def gaps_of_pins(linkage: Linkage, link: str) -> list[tuple[float, float]]:
    """From the pins of a link to each before, x and y."""
    pins = [(e.x, e.y) for (_, owner), e in linkage.elements.items() if owner == link and e.is_pin]
    return [(x - u, y - v) for k, (u, v) in enumerate(pins) for x, y in pins[:k]]


def _turns_fully(course: Circuit) -> bool:
    drives = course.linkage.mechanism.drives
    if not drives or not drives[0].turning or not course.closed:
        return False
    turned = float(course.drive[-1] - course.drive[0])
    # Limits are sought last: a drive that turns back, or comes back without a turn, shows it by its samples.
    back = np.diff(course.drive) * np.sign(turned) < -EXACT
    return round(turned / (2 * np.pi)) != 0 and not back.any() and not course.drive_limits


def _carried(
    linkage: Linkage, course: Circuit, path: TargetPath, targets: Targets
) -> tuple[tuple[float, ...], Reals, float]:
    """`move` through the targets: drive values, how far each is missed, the smallest transmission angle."""
    order = np.argsort(path.arcs, kind="stable")
    low, high = path.arcs[order[0]], path.arcs[order[-1]]
    laps = (-1, 0, 1) if course.closed else (0,)
    between = np.concatenate([course.arcs + k * course.length for k in laps])
    end = low + course.length if targets.all_round and course.closed else high
    between = between[(between > low) & (between < end)]
    arcs = np.concatenate([path.arcs, between])
    ranks = np.argsort(arcs, kind="stable")
    drive = course.at(arcs[ranks]).drive()
    rows = np.empty(len(arcs), np.int64)
    rows[ranks] = np.arange(len(arcs))
    begin = int(rows[0])
    misses, least = np.zeros(len(path.arcs)), np.inf
    values = tuple(float(drive[rows[k]]) for k in range(len(path.arcs)))
    # From target 1, where the reference pose is, to both ends.
    for part, forward in ((drive[begin:], True), (drive[: begin + 1][::-1], False)):
        motion = move_quietly(linkage, part, order=2)
        if not motion.complete:
            return values, np.full(len(misses), np.inf), float("nan")
        least = min(least, _least_transmission(motion, part))
        misses = np.maximum(misses, _misses(motion, targets, rows, begin, forward=forward))
    return values, misses, least if np.isfinite(least) else np.nan


def _misses(motion: Motion, targets: Targets, rows: NDArray[np.int64], begin: int, *, forward: bool) -> Reals:
    """How far each target that lies on this part of the way is missed, relative to the size; 0 for the others."""
    misses = np.zeros(len(targets.values))
    reached = [k for k in range(len(targets.values)) if (rows[k] >= begin if forward else rows[k] <= begin)]
    at = [int(rows[k]) - begin if forward else begin - int(rows[k]) for k in reached]
    if reached:
        gaps = np.stack([probe.of_motion(motion)[at] for probe in targets.probes], axis=1) - targets.values[reached]
        misses[reached] = np.sqrt(np.nansum(np.abs(gaps) ** 2, axis=1)) / targets.size
    return misses


def _least_transmission(motion: Motion, drive: Reals) -> float:
    """Over a motion, its ends included; NaN where there is none.

    About the pose with the smallest one the motion is run again, in `_FINE` steps; between these the cosine is followed
    by a parabola.
    """
    try:
        mu = transmission_angle(motion)
        if not np.isfinite(mu).any():
            return float("nan")
        k = int(np.nanargmin(mu))
        apart = np.flatnonzero(np.abs(drive - drive[k]) > _APART)  # a target at a sample of the circuit is there twice
        first, last = int(apart[apart < k].max(initial=0)), int(apart[apart > k].min(initial=len(mu) - 1))
        rows = np.append(drive[: first + 1], np.linspace(drive[first], drive[last], _FINE + 1)[1:])
        if last > first and (again := move_quietly(motion.linkage, rows, order=2)).complete:
            drive, mu = rows[first:], transmission_angle(again)[first:]
    except LinkageError:
        return float("nan")
    k, cosines = int(np.nanargmin(mu)), np.cos(mu)
    most = cosines[k]
    if 0 < k < len(mu) - 1 and (drive[k] - drive[k - 1]) * (drive[k + 1] - drive[k]) > 0:
        if _passes_zero(*mu[k - 1 : k + 2]):
            return 0.0
        before, after = drive[[k - 1, k + 1]] - drive[k]
        low, high = cosines[[k - 1, k + 1]] - most
        slope, bend = low * after / before - high * before / after, (high / after - low / before) * (after - before)
        if bend < 0:
            most -= slope**2 / (4 * bend)
    return float(np.arccos(min(most, 1.0)))


def _passes_zero(before: float, least: float, after: float) -> bool:
    """Whether an angle without sign goes through zero beside the least of three: with a sign it is nearly straight."""
    bend = abs(before - 2 * least + after) / 4
    return abs(before - 2 * least - after) < bend or abs(after - 2 * least - before) < bend
