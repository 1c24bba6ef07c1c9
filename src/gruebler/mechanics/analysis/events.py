"""Events of a motion, found as roots: dead centres, change points, zeros of the transfer functions.

The transfer functions are those of the geometry: the output over the drive, its first and its second derivative with
respect to the drive. Definitions, method and errors: docs/theory/events.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import pi

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.events import ChangePoint, DeadCentre
from gruebler.mechanics.analysis.cam_contacts import bodies_of, cam_contacts
from gruebler.mechanics.analysis.courses import Course
from gruebler.mechanics.analysis.outputs import Output
from gruebler.mechanics.kinematics.circuits import Circuit, circuit
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.kinematics.plan import Dyad
from gruebler.mechanics.kinematics.redundancy import ReferenceConditions
from gruebler.mechanics.kinematics.root_finding import Zero, bracketed_root, find_zeros, vanishing
from gruebler.structure.assur import SolvedGroup

_STILL = 1e-11  # a velocity (lengths in sizes) that is hardly ever larger is none
_ASIDE = np.array(
    [0.5**k for k in range(6, 0, -1)]
)  # of the way from a dwell to the next joint: where the output is seen to move
_NEAR = 1e-9  # of the range: joints of a law that are nearer are one
_EVEN = 1e-9  # the same for its derivatives
_EQUAL = 1e-9  # two distances that differ by less (of the size) say nothing about inner and outer
_THERE = 1e-5  # radians: a pose that differs by less is the same
_LOST = 1e-6  # of the largest singular value: less is zero
_AROUND = np.array([-4, -3, -2, -1, 1, 2, 3, 4.0])  # places about a change point, in steps
_STEP = 0.02  # radians, or parts of the size


@dataclass(frozen=True, slots=True, kw_only=True)
class Dwell:
    """A stretch of the drive on which the output rests: behind a cam or a Geneva drive."""

    begin: float
    """The drive's value; of full turns in 0 to the period."""
    end: float
    """The same, larger than ``begin``: beyond the period if the dwell goes over its end."""
    output: float
    kind: str
    """``maximum`` or ``minimum`` of the output, or ``flat``: it goes on in the same direction."""
    side: str
    """``inner`` or ``outer`` for the two extreme ones, dead centres among them, else empty."""

    @property
    def duration(self) -> float:
        """How far the drive moves meanwhile."""
        return self.end - self.begin

    @property
    def drive(self) -> float:
        """The drive's value in the middle; it may lie beyond the period."""
        return (self.begin + self.end) / 2


@dataclass(frozen=True, slots=True)
class Crossing:
    """A zero of a transfer function of order 0, 1 or 2, or of the next derivative."""

    drive: float
    order: int
    value: float
    """The transfer function of one order less: the extreme, if the order is 1 or more; for order 0 the slope."""
    kind: str
    """``maximum``, ``minimum`` or ``flat`` of that function; for order 0 ``rising``, ``falling`` or ``touching``."""


def transfer_function(cycle: Course, output: Output, drives: Reals, order: int = 0) -> Reals:
    """The transfer function of order 0 to 3 at drive values: psi, psi', psi'', psi''' in radians or lengths; (n,)."""
    return output.values(cycle.at(np.asarray(drives, np.float64), max(order, 1)), order)


def natural_speed(cycle: Course, output: Output) -> float:
    """The usual size of output over drive: 1 for angle by angle, the linkage's size for a way by an angle, ..."""
    return (1.0 if output.turning else cycle.size) / cycle.drive_size


def crossings(cycle: Course, output: Output, order: int) -> tuple[Crossing, ...]:
    """The zeros of a transfer function: of order 0; 1, the output's extremes; 2, those of its velocity; 3, of psi''.

    Of an angle the zeros of order 0 are the multiples of a full turn. None for an output that stands still.
    """
    least = (_EVEN if order > 1 else _STILL) * natural_speed(cycle, output)
    least /= cycle.drive_size ** max(order - 1, 0)

    def jet(drives: Reals) -> Reals:
        motion = cycle.at(drives)
        rows = [output.values(motion, k) for k in range(order, 4)]
        if order == 0 and output.turning:
            half = rows[0] / 2
            sine, cosine = np.sin(half), np.cos(half)
            rows = [2 * sine, rows[1] * cosine, rows[2] * cosine - rows[1] ** 2 * sine / 2]
        return np.stack(rows[:3])

    samples = cycle.samples(order)
    if order == 0:  # the sine of half an angle does not repeat after an odd number of turns
        samples = replace(samples, period=None)
    zeros = _inside(cycle, find_zeros(jet, samples, least))
    if order == 0 and output.turning and zeros:  # that sine falls where the angle rises through an odd multiple
        turned = np.round(transfer_function(cycle, output, np.array([zero.at for zero in zeros])) / (2 * pi)) % 2 == 1
        zeros = tuple(zero._replace(rises=zero.rises != odd) for zero, odd in zip(zeros, turned.tolist(), strict=True))
    before = _before(cycle, output, zeros, order)
    words = ("falling", "rising", "touching") if order == 0 else ("maximum", "minimum", "flat")
    return tuple(
        Crossing(cycle.span.wrapped(zero.at), order, float(value), words[2 if zero.multiplicity == 2 else zero.rises])
        for zero, value in zip(zeros, before, strict=True)
    )


def _before(cycle: Course, output: Output, zeros: tuple[Zero, ...], order: int) -> Reals:
    if not zeros:
        return np.empty(0)
    return transfer_function(cycle, output, np.array([zero.at for zero in zeros]), order - 1 if order else 1)


def _inside(cycle: Course, zeros: tuple[Zero, ...]) -> tuple[Zero, ...]:
    """The zeros in the order in which they are reported."""
    return tuple(sorted(zeros, key=lambda zero: cycle.span.wrapped(zero.at)))


def dead_centres(cycle: Course, output: Output) -> tuple[DeadCentre, ...]:
    """All positions in which the output stops without resting, with the extreme ones told apart as inner and outer.

    A dead centre is a zero of psi' that is not in a dwell. The outer one is that in which the point that drives the
    output lies farther from the pivot of the drive, be it the maximum or the minimum of the output. Where there is no
    such pivot or point, or both lie as far, the maximum of an angle is the inner one, the maximum of a way the outer
    one. Dwells at the largest or smallest output are inner and outer in the same sense. Error of the drive
    value: some 1e-15 by the curvature psi'', relative to its usual size; of multiple zeros some 1e-12.
    """
    return stops(cycle, output)[0]


def dwells(cycle: Course, output: Output) -> tuple[Dwell, ...]:
    """The stretches on which the output rests; none of an output that never moves.

    An output can only begin or end to rest where a cam or Geneva drive passes to the next piece of its law: between
    these places the motion is analytic. Error of begin and end: some 1e-14 of a turn.
    """
    return stops(cycle, output)[1]


def stops(cycle: Course, output: Output) -> tuple[tuple[DeadCentre, ...], tuple[Dwell, ...]]:
    """`dead_centres` and `dwells`."""

    def jet(drives: Reals) -> Reals:
        motion = cycle.at(drives)
        return np.stack([output.values(motion, k) for k in (1, 2, 3)])

    least, samples = _STILL * natural_speed(cycle, output), cycle.samples(1)
    zeros = _inside(cycle, find_zeros(jet, samples, least))
    resting = vanishing(jet, samples, least) if cycle.joints else ()
    values = transfer_function(cycle, output, np.array([zero.at for zero in zeros])) if zeros else np.empty(0)
    centres = [
        DeadCentre(
            drive=cycle.span.wrapped(zero.at),
            output=float(value),
            kind="flat" if zero.multiplicity == 2 else "minimum" if zero.rises else "maximum",
            flat=zero.multiplicity > 1,
        )
        for zero, value in zip(zeros, values, strict=True)
    ]
    rests = sorted((_dwell(cycle, output, begin, end) for begin, end in resting), key=lambda dwell: dwell.begin)
    sides = _sides(cycle, output, [*centres, *rests])
    return (
        tuple(replace(dead_centre, side=side) for dead_centre, side in zip(centres, sides, strict=False)),
        tuple(replace(dwell, side=side) for dwell, side in zip(rests, sides[len(centres) :], strict=True)),
    )


def _dwell(cycle: Course, output: Output, begin: float, end: float) -> Dwell:
    """The rest of the output between two joints of laws."""
    span, joints = cycle.span, np.array(cycle.joints)
    if span.full:
        first = span.wrapped(begin)
        begin, end = first, first + end - begin
        joints = np.concatenate([joints + k * span.period for k in (-2, -1, 0, 1, 2)])
    else:
        begin, end = (span.low if begin == cycle.grid[0] else begin), (span.high if end == cycle.grid[-1] else end)
        joints = np.concatenate([[span.low], joints, [span.high]])
    near = _NEAR * span.width
    before = _way(cycle, output, begin, joints[joints < begin - near].max(initial=-np.inf))
    after = _way(cycle, output, end, joints[joints > end + near].min(initial=np.inf))
    kinds = {(1, -1): "maximum", (1, 0): "maximum", (0, -1): "maximum", (-1, 1): "minimum", (-1, 0): "minimum"}
    kind = "flat" if before == after else kinds.get((before, after), "minimum")
    value = float(transfer_function(cycle, output, np.array([(begin + end) / 2]))[0])
    return Dwell(begin=begin, end=end, output=value, kind=kind, side="")


def _way(cycle: Course, output: Output, edge: float, joint: float) -> int:
    """In which direction the output moves beside a dwell, on the way to the next joint: 1, -1; 0 if there is none."""
    if not np.isfinite(joint):
        return 0
    rates = transfer_function(cycle, output, np.asarray(edge + (joint - edge) * _ASIDE), 1)
    return int(np.sign(rates[np.argmax(np.abs(rates) > _EVEN * np.abs(rates).max())]))


def _sides(cycle: Course, output: Output, stops: Sequence[DeadCentre | Dwell]) -> list[str]:
    """Which of the stops is the inner and which the outer one; of several that are as far out the first."""
    sides = [""] * len(stops)
    turning = [k for k, stop in enumerate(stops) if stop.kind != "flat"]
    kinds = {stops[k].kind for k in turning}
    if len(kinds) < 2 or (cycle.span.full and output.turning and output_turns(cycle, output)):
        return sides
    outputs = [stops[k].output for k in turning]
    high, low = max(outputs), min(outputs)
    near = _EQUAL * (high - low)

    def first(value: float) -> int:
        return min((k for k in turning if abs(stops[k].output - value) <= near), key=lambda k: stops[k].drive)

    top, bottom = first(high), first(low)
    far = _distances(cycle, output, np.array([stops[top].drive, stops[bottom].drive]))
    if far is None or abs(far[0] - far[1]) < _EQUAL * cycle.size:
        top_is_outer = not output.turning
    else:
        top_is_outer = bool(far[0] > far[1])
    sides[top], sides[bottom] = ("outer", "inner") if top_is_outer else ("inner", "outer")
    return sides


def output_turns(cycle: Course, output: Output) -> int:
    """How many full turns an angle makes while everything repeats."""
    if not (cycle.span.full and output.turning):
        return 0
    track = output.values(cycle.at(np.array([cycle.grid[0], cycle.grid[0] + cycle.span.width]), 0))
    return round(float(track[1] - track[0]) / (2 * pi))


def drive_pivot(cycle: Course) -> complex | None:
    """Where a turning drive has its axis in the frame; None for any other drive."""
    lower = cycle.lower_linkage
    first, _ = lower.reference(0)
    if first != lower.mechanism.frame or not cycle.turning_drive:
        return None
    e = lower.elements[lower.mechanism.drives[0].joint, first]
    return complex(e.x, e.y)


def _distances(cycle: Course, output: Output, drives: Reals) -> Reals | None:
    """How far the point that drives the output lies from the pivot of the drive, or from the axis of its cam."""
    for group in cycle.plan.decomposition.groups:
        for contact in cam_contacts(cycle.plan, group):
            if output.link in bodies_of(group)[contact.body]:
                return contact.reach(cycle.at(drives, 2))
    pivot, place = drive_pivot(cycle), _driving_point(cycle, output)
    if pivot is None or place is None:
        return None
    motion = cycle.at(drives, 0)
    k = cycle.start.link_index(place[0])
    point = motion.places[0, :, k] + motion.turns[:, k] * place[1]
    return np.asarray(np.abs(point - pivot))


def _driving_point(cycle: Course, output: Output) -> tuple[str, complex] | None:
    """The one pin by which the rest of its group takes hold of the output link."""
    plan = cycle.plan
    for group in plan.decomposition.groups:
        own = [k for k, body in enumerate(group.bodies) if output.link in (*body, *group.carried[k])]
        if not own:
            continue
        inner = [(n, m) for n, m in group.joints if not m.outer and own[0] in m.links]
        if len(inner) != 1 or not inner[0][1].pair.is_turning:
            return None
        number = inner[0][0]
        body = (*group.bodies[own[0]], *group.carried[own[0]])
        link = next(link for link in plan.lower.mechanism.chain.joints[number].links if link in body)
        e = plan.lower.elements[number, link]
        return link, complex(e.x, e.y)
    return None


def change_points(cycle: Course) -> tuple[ChangePoint, ...]:
    """Where the motion goes through a position in which two assembly modes of a group meet.

    The signed root of a dyad (twice the area of its triangle, ...) goes through zero there. It loses half its digits
    near by, so the zero is that of a polynomial of degree 7 through eight poses around it; error some 1e-12. Those of
    larger groups are the places where another curve meets the `circuit`. Where several groups have one at once, more
    than two curves meet. Raises `LinkageError` if there are larger groups whose circuit cannot be followed.
    """
    larger = _of_larger_groups(cycle) if cycle.plan.higher_groups else ()
    return _meetings(cycle, [*larger, *dyad_change_points(cycle)])


def _meetings(cycle: Course, change_points: Iterable[ChangePoint]) -> tuple[ChangePoint, ...]:
    """The same in order, with those marked that several groups have at the same place."""
    return tuple(
        replace(change_point, several=change_point.several or len(together) > 1)
        for together in cycle.by_place(change_points)
        for change_point in together
    )


def dyad_change_points(cycle: Course) -> tuple[ChangePoint, ...]:
    """Those of dyads alone."""
    meetings = []
    roots = cycle.at(cycle.grid, 0).roots
    for dyad in (dyad for dyad in cycle.plan.dyads if dyad.branching):
        dyad_roots = roots[:, dyad.number]
        for cell in np.flatnonzero(np.sign(dyad_roots[:-1]) * np.sign(dyad_roots[1:]) < 0):
            meetings.append(_change_point(cycle, dyad, cycle.grid[cell : cell + 2]))
    if cycle.plan.released and meetings:  # one of the independent part may be none of the linkage
        meetings = [point for point in meetings if not _is_regular(cycle.at(np.array([point.drive]), 0), 0)]
    return _meetings(cycle, meetings)


def _of_larger_groups(cycle: Course) -> Iterator[ChangePoint]:
    whole = circuit(cycle.linkage, branch=cycle.start.branch, at=float(cycle.start.drives[0, 0]))
    angles = {link: whole.poses_at_change_points.angle(link) for link in whole.system.bodies}
    for row, change in enumerate(whole.change_points):
        groups = list(_singular(cycle, whole, row))
        for turn in range(cycle.span.turns) if cycle.span.full else range(-1, 2) if cycle.turning_drive else (0,):
            drive = float(change.drive % (2 * pi) + 2 * pi * turn if cycle.turning_drive else change.drive)
            if cycle.span.low <= drive <= cycle.span.high or cycle.span.full:
                motion = cycle.at(np.array([drive]), 0)
                away = [motion.angle(link)[0] - angle[row] for link, angle in angles.items()]
                if np.abs(np.exp(1j * np.array(away)) - 1).max() < _THERE:
                    for group in groups:
                        yield ChangePoint(
                            drive=cycle.span.wrapped(drive),
                            links=group.links,
                            form=group.form(),
                            several=change.several,
                        )


def _singular(cycle: Course, circuit: Circuit, row: int) -> Iterator[SolvedGroup]:
    """The larger groups that can move in a change point of the circuit while everything before them stands."""
    plan, bodies, size = cycle.plan, list(circuit.system.bodies), cycle.size
    poses = circuit.poses_at_change_points
    rows = [
        (z.real / size, z.imag / size, angle)
        for link in bodies
        for z, angle in [(poses.places[0, row, poses.link_index(link)], poses.angle(link)[row])]
    ]
    _, matrix = circuit.system.linearised(np.array(rows).ravel())
    _, values, vectors = np.linalg.svd(matrix)
    lost = int((values[: matrix.shape[1] - 1] < _LOST * values[0]).sum())
    ways = vectors[-1 - max(lost, 1) :].reshape(-1, len(bodies) + len(circuit.system.arms), 3)
    placed: list[int] = []
    known = 1  # the motion of the circuit itself
    for number, group in enumerate(plan.decomposition.groups):
        placed += [bodies.index(link) for link in group.links if link in bodies]
        rank = int((np.linalg.svd(ways[:, placed].reshape(len(ways), -1))[1] > _THERE).sum()) if placed else 0
        if rank > known and any(part.group == number for part in plan.higher_groups):
            yield group
        known = max(known, rank)


def _change_point(cycle: Course, dyad: Dyad, cell: Reals) -> ChangePoint:
    span = cycle.span
    step = _STEP * cycle.drive_size

    def root(drives: Reals) -> Reals:
        return cycle.at(drives, 0).roots[:, dyad.number]

    at = float(bracketed_root(root, cell[:1], cell[1:])[0])
    for _ in range(2):
        room = step if span.full else min(step, (at - span.low) / 5, (span.high - at) / 5)
        places = at + _AROUND * room
        y = root(places)
        polynomial = np.polynomial.Polynomial.fit(_AROUND, y, 7)
        near = [z.real for z in polynomial.roots() if abs(z.imag) < 1e-6 and abs(z.real) < 1]
        if not near:
            break
        at += room * float(min(near, key=abs))
    group = cycle.plan.decomposition.groups[dyad.group]
    return ChangePoint(drive=span.wrapped(at), links=group.links, form=group.form())


_SINGULAR = 1e-6  # of the largest singular value: poses at change points are known to some 1e-8 only


def _is_regular(motion: Motion, row: int) -> bool:
    """Whether in a pose all conditions together, with the drives held, fix every link: then it is no change point."""
    conditions = ReferenceConditions(motion.linkage)
    x = []
    for link in conditions.bodies:
        k = motion.link_index(link)
        z = motion.places[0, row, k] / motion.linkage.size
        x += [z.real, z.imag, float(np.angle(motion.turns[row, k]))]
    pose = np.array(x)
    matrix = np.vstack([conditions.linearised(pose)[1], conditions.drives(pose)])
    values = np.linalg.svd(matrix, compute_uv=False)
    return bool(values[matrix.shape[1] - 1] > _SINGULAR * values[0])
