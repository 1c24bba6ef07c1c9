"""What a simulation by another hand says of a design, beside its verdict, reason by reason.

The linkage is followed by `traced_linkage`, the order in which it meets its targets is decided by `simulated_order`,
transmission angles by `pushing_legs`. Of the library only the linkage, the targets and the drive values are taken.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gruebler.design.synthesis.targets import Probe
from gruebler.mechanics.analysis.outputs import find_output

from .pushing_legs import least_transmission, legs_of
from .simulated_order import Distances, places_of_drives
from .traced_linkage import LostError, traced, values_of

NEAR = 1e-4 * np.pi / 180
"""What lies nearer to a demanded transmission angle is not compared."""
ROUNDING = 1e-13
ANGLE = 1e-7
"""Transmission angles agree to this, in radians."""
PLACE = 1e-7
"""Deviations agree to this, by the size of the task."""


def groups_by_rank(ranks, count, in_order):
    """Targets that are passed one after the other, and those at any time."""
    if not in_order:
        return (tuple(range(count)),), ()
    given = ranks or range(count)
    groups = tuple(
        tuple(k for k, own in enumerate(given) if own == rank) for rank in sorted({r for r in given if r is not None})
    )
    return groups, tuple(k for k, own in enumerate(given) if own is None)


@dataclass
class Compared:
    """What was compared, and what differs."""

    kind: str
    tasks: int = 0
    accepted: int = 0
    rejected: int = 0
    lost: int = 0
    near: int = 0
    wrong: list = field(default_factory=list)

    def add(self, where, design, demands, limit, keeps=True):
        """Compare a design whose targets may be missed by a part of the size; it may be told not to keep its modes."""
        verdict = design.verdict
        try:
            faults, near = faults_of(design, demands, limit)
        except LostError:
            self.lost += 1
            return
        if verdict.accepted and not keeps:
            faults.append(("modes", "accepted, but left out by its modes"))
        self.count(where, verdict, faults, near)

    def count(self, where, verdict, faults, near):
        """One design more."""
        self.near += near
        self.accepted += verdict.accepted
        self.rejected += not verdict.accepted
        self.wrong += [(self.kind, where, fault, str(verdict)) for fault in faults]


@dataclass(kw_only=True)
class Seen:
    """What the simulation says of a design."""

    nearest: Any
    """(targets,) by the size of the task."""
    circuit: bool
    order: bool
    passes: bool
    near: bool
    """Whether a bound is too near to tell."""
    turns: bool
    told: Any
    """The places of the drive values of the design, and how far targets are missed there."""
    excess: float
    least: float
    legs: Any
    ratio: float
    inside: bool

    def expected(self, demands):
        """Whether the design is to be accepted."""
        angle = not demands.transmission or self.least >= demands.transmission
        drive = (self.turns or not demands.crank) and angle
        return self.passes and drive and self.ratio <= demands.size_ratio and self.inside


def seen(design, demands, limit):
    """A design simulated, its targets missed by a part of the size at most."""
    targets, linkage = design.targets, design.linkage
    course, scale = traced(linkage), targets.size
    distances = Distances(course, targets.probes, targets.values)
    limit = limit + ROUNDING * linkage.size / scale
    bounds = np.minimum(limit, np.inf if targets.allowed is None else targets.allowed + 1e-9) * np.ones(
        len(targets.values)
    )
    groups, free = groups_by_rank(targets.ranks, len(bounds), demands.in_order)
    nearest = distances.nearest / scale
    circuit = bool((nearest <= limit).all())
    order = circuit and distances.in_order(scale * bounds, groups, free, limits=False)
    passes = order and distances.in_order(scale * bounds, groups, free)
    margin = PLACE if limit > 1e-6 else 0.9 * limit
    tight, wide = (distances.in_order(scale * (bounds + off), groups, free) for off in (-margin, margin))
    near = tight != wide or bool(np.abs(nearest - limit).min() <= margin)
    legs, least, excess, told = legs_of(linkage, find_output(linkage).link), np.nan, np.nan, None
    if design.drives:
        told = places_of_drives(course, design.drives, targets.probes, targets.values, scale)
    if told is not None:
        low, high = told[0].min(), told[0].max()
        high = low + course.length if targets.all_round and course.closed else high
        least = least_transmission(course, legs, low, high) if legs else np.nan
        excess = beyond_lines(course, targets, told[0])
        near |= targets.curve.value != "none" and abs(excess - limit) < 1e-4
        near |= bool(demands.transmission) and abs(least - demands.transmission) < NEAR
        passes &= not (demands.in_order and excess > limit)
    return bounds, Seen(
        nearest=nearest,
        circuit=circuit,
        order=order,
        passes=passes,
        near=near,
        turns=course.turns,
        told=told,
        excess=excess,
        least=least,
        legs=legs,
        ratio=size_ratio(linkage, targets.travel),
        inside=in_region(linkage, demands.region),
    )


def faults_of(design, demands, limit):
    """What of a verdict the simulation denies, and whether a bound is too near to tell."""
    verdict = design.verdict
    if design.targets is None:  # rejected before it was followed
        legs = legs_of(design.linkage, find_output(design.linkage).link)
        untrue = legs or "no transmission angle" not in str(verdict.reasons[0])
        return [("reason", str(verdict.reasons[0]))] * bool(untrue), False
    bounds, own = seen(design, demands, limit)
    differs = {
        "accepted": own.expected(demands) != verdict.accepted and not own.near,
        "circuit": own.circuit != verdict.one_circuit and not own.near,
        "turns": own.turns != verdict.turns_fully,
        "drives": own.passes and verdict.one_branch and own.told is None and not own.near,
    }
    if own.told is not None:
        misses = own.told[1]
        differs["missed"] = verdict.accepted and not (misses <= bounds + PLACE * (limit > 1e-6) + 2e-9).all()
        differs["error"] = verdict.accepted and abs(misses.max() - verdict.error) > PLACE
        differs["transmission"] = not np.isnan(own.least) and abs(own.least - verdict.transmission) > ANGLE
    untrue = [str(reason) for reason in verdict.reasons if not _true(str(reason), own, verdict, demands, bounds)]
    return [(what, own) for what, wrong in differs.items() if wrong] + [
        ("reason", text, own) for text in untrue
    ], own.near


def _true(text, own, verdict, demands, bounds):
    """Whether a reason for which a design is rejected holds."""
    error = abs(own.nearest.max() - verdict.error) < 1e-5 * (1 + verdict.error)
    first = str(np.argmax(own.nearest > max(bounds)) + 1)
    holds = {
        "cannot be reached": not own.circuit and first in text and error,
        "in another order": own.circuit and (not own.order or own.near),
        "two branches": own.circuit and (not own.passes or own.near),
        "does not turn fully": not own.turns,
        "differ too much": own.ratio > demands.size_ratio,
        "outside the region": not own.inside,
        "transmission angle falls": own.least < demands.transmission,
        "no transmission angle": not own.legs,
        "leaves the curve": not own.excess <= max(bounds),
        "is missed by": own.near or own.told is None or bool((own.told[1] > bounds - PLACE).any()),
    }
    return any(key in text and true for key, true in holds.items())


def beyond_lines(course, targets, arcs):
    """Of a curve: how far its point goes from the line between two targets, beyond half of it, by the size."""
    if targets.curve.value == "none":
        return 0.0
    places = targets.values[:, 0]
    sense = 1 if arcs[-1] >= arcs[0] else -1
    pairs = [(arcs[k], arcs[k + 1], places[k], places[k + 1]) for k in range(len(arcs) - 1)]
    if targets.curve.value == "closed" and course.closed:
        pairs.append((arcs[-1], arcs[0] + sense * course.length, places[-1], places[0]))
    worst = 0.0
    for low, high, start, end in pairs:
        between = np.linspace(low, high, 40)
        z = values_of(course.closing, targets.probes[:1], *course.at(between))[0][:, 0]
        line = end - start
        share = np.clip(np.real((z - start) * np.conj(line)) / max(abs(line) ** 2, 1e-300), 0, 1)
        worst = max(worst, float(np.abs(z - start - share * line).max() - abs(line) / 2))
    return worst / targets.size


def size_ratio(linkage, travel):
    """The longest distance of two pins of a link by the shortest; a known travel of what slides counts, too."""
    lengths = []
    for link in linkage.mechanism.chain.links:
        pins = [complex(e.x, e.y) for (_, owner), e in linkage.elements.items() if owner == link and e.is_pin]
        lengths += [abs(a - b) for k, a in enumerate(pins) for b in pins[:k]]
    slides = any(not e.is_pin for e in linkage.elements.values())
    return max(lengths) / min(*lengths, travel if slides else np.inf) if len(lengths) > 1 else 1.0


def in_region(linkage, region):
    """Whether all pivots of the frame lie in a rectangle."""
    if region is None:
        return True
    x1, y1, x2, y2 = region
    pins = [e for (_, owner), e in linkage.elements.items() if owner == linkage.mechanism.frame and e.is_pin]
    return all(x1 <= e.x <= x2 and y1 <= e.y <= y2 for e in pins)


def faults_of_rest(design, task, demands, tolerance):
    """What of the verdict on an output that rests the simulation denies, and whether a bound is too near to tell."""
    verdict, linkage = design.verdict, design.linkage
    course = traced(linkage)
    output = find_output(linkage)
    probe = Probe(link=output.link) if output.joint is None else Probe(joint=output.joint)
    if verdict.turns_fully != course.turns:
        return [("turns", course.turns)], False
    if not course.turns:
        return [("accepted", False)] * verdict.accepted, False
    c = course.closing.column[course.closing.crank] + 2
    sense = np.sign(course.q[-1, c] - course.q[0, c])

    def values(arcs):
        seen = values_of(course.closing, (probe,), *course.at(sense * arcs))[0][:, 0]
        return np.unwrap(np.angle(seen)) if output.joint is None else seen.real

    low, high = 0.0, course.length
    for _ in range(60):
        middle = (low + high) / 2
        short = course.at(sense * middle)[0][0, c] - course.q[0, c] < task.dwell
        low, high = (middle, high) if short else (low, middle)
    wanted = task.swing or task.stroke
    error = float(np.ptp(values(np.linspace(0, low, 3000)))) / 2 / wanted
    swing = float(np.ptp(values(np.linspace(0, course.length, 6000)))) / wanted
    least = least_transmission(course, legs_of(linkage, output.link), 0.0, course.length)
    ratio = size_ratio(linkage, np.inf)
    near = abs(least - demands.transmission) < NEAR or abs(error / tolerance - 1) < 1e-4
    expected = error <= tolerance and least >= demands.transmission and ratio <= demands.size_ratio
    faults = [("accepted", expected, error, least, ratio)] * (expected != verdict.accepted and not near)
    faults += [("error", error)] * (abs(error - verdict.error) > 1e-4 * error + 1e-9)
    faults += [("transmission", least)] * (abs(least - verdict.transmission) > ANGLE)
    faults += [("swing", swing)] * (abs(swing - 1) > 1e-5)
    true = {
        "differ too much": ratio > demands.size_ratio,
        "transmission angle falls": least < demands.transmission,
        "strays from its rest": error > tolerance,
    }
    texts = [str(reason) for reason in verdict.reasons]
    faults += [("reason", text) for text in texts if not any(key in text and true[key] for key in true)]
    return faults, near


def least_gap(design, clearance):
    """How near the outline of a body comes to an obstacle on the way through the targets; 0 where they cross."""
    targets = design.targets
    course = traced(design.linkage)
    arcs, _ = places_of_drives(course, design.drives, targets.probes, targets.values, targets.size)
    link = design.linkage.points["P"].link
    q, along = course.at(np.append(arcs[0], np.linspace(arcs.min(), arcs.max(), 1500)))
    z = values_of(course.closing, (Probe("P"),), q, along)[0][:, 0]
    turn = np.exp(1j * (course.closing.angle(q, link) - course.closing.angle(q, link)[0]))
    body, obstacle = (np.array([complex(*p) for p in line]) for line in (clearance.body, clearance.obstacle))
    lines = (z[:, None] + turn[:, None] * (body - z[0]))[1:]
    a, r = lines[:, :-1, None], np.diff(lines, axis=1)[:, :, None]
    p, s = obstacle[:-1], np.diff(obstacle)
    with np.errstate(all="ignore"):  # a + t r = p + u s
        across = np.imag(np.conj(r) * s)
        t, u = np.imag(np.conj(p - a) * s) / across, np.imag(np.conj(p - a) * r) / across
    if ((t >= 0) & (t <= 1) & (u >= 0) & (u <= 1)).any():
        return 0.0

    def from_points(points, start, way):
        share = np.clip(np.real((points - start) * np.conj(way)) / np.abs(way) ** 2, 0, 1)
        return np.abs(points - start - share * way).min()

    ends = [from_points(point, p, s) for point in (a, a + r)] + [from_points(point, a, r) for point in (p, p + s)]
    return float(min(ends))
