"""The circuit of a linkage: all positions that it can reach without being taken apart, as one curve.

The curve is followed by its length, not by the drive, so that limits of the drive and dead centres are points like any
others; nothing of the Assur decomposition is used on the way. docs/theory/circuits.md has the method.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite

import numpy as np
from numpy.typing import ArrayLike

from gruebler import _core
from gruebler.base.angles import warn_of_degrees
from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.events import ChangePoint, Extremum
from gruebler.base.notebook import brief
from gruebler.base.text import Message, joined_by_and, message
from gruebler.mechanics.kinematics.configuration_curve import (
    ClosureSystem,
    TracedCurve,
    closure_system,
    nearest_on_curve,
    trace_circuit,
)
from gruebler.mechanics.kinematics.kernel_records import SampleBuffer
from gruebler.mechanics.kinematics.messages import Driven, drive_values
from gruebler.mechanics.kinematics.poses import Poses
from gruebler.mechanics.kinematics.root_finding import FunctionSamples, find_zeros
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage, with_lower_pairs
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.mechanics.linkages.points import PointLike

Quantity = Callable[[Poses, int], Reals]
"""From poses and 0 or 1 to the value of something, or to its derivative by the arc: one number for each pose."""

_CONSTANT = 1e-11  # of the natural size: a derivative that is nowhere larger is none
_AGAIN = 1e-9  # of the natural size: a value after a lap that differs by less is the same
_ROUND = 1e-12  # of the length: a place so near the end of a closed circuit is its beginning
_SINGULAR = 1e-3  # a start with a smaller gauge is taken only if there is no better one
_SHAKY = 1e-4  # a shaky linkage moves less, within what counts as closed joints
_TRIALS = 1024  # values of the drive that are tried for a start
_REACH = 4.0  # ways of a driven slide up to that many sizes are tried


@dataclass(frozen=True, slots=True)
class MonotonePiece:
    """A piece of the circuit on which the drive never turns back."""

    start: float
    """The arc at which it begins; it may lie before 0 on a closed circuit."""
    end: float
    drives: tuple[float, float]
    """The drive values at both."""


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False)
class Circuit:
    """All positions of a linkage on one curve.

    Places on the curve are given by the arc: its length from the first sample in sizes of the linkage, an angle
    counting as the way of a point at that distance. On a closed circuit arcs below 0 or above `length` wrap around.

    See Also:
        `circuit`, `Motion`, `rotatability`

    Theory:
        docs/theory/circuits.md
    """

    linkage: Linkage
    system: ClosureSystem = field(compare=False)
    """That of the linkage, with arrays to work in."""
    traced: TracedCurve
    turned: float
    """What is added to the drive's angle so that it begins near the value asked for."""

    def __len__(self) -> int:
        return len(self.traced.arcs)

    @property
    def closed(self) -> bool:
        """Whether it comes back to where it began."""
        return self.traced.closed

    @property
    def length(self) -> float:
        """The length of the curve, in sizes; to about 1e-6 of itself."""
        return float(self.traced.arcs[-1])

    @property
    def start(self) -> float:
        """The arc of the position from which it was followed; 0 on a closed circuit."""
        return self.traced.start

    @property
    def arcs(self) -> Reals:
        """(samples,) where the samples are; a closed circuit has its first position once more at the end."""
        return self.traced.arcs

    @cached_property
    def samples(self) -> Poses:
        """The positions at `arcs`."""
        return self._poses(self.traced.arcs, self.traced.poses, self.traced.tangents)

    def at(self, arcs: ArrayLike) -> Poses:
        """The positions at given arcs, each exact; (k,) or one number.

        Raises `LinkageError` for places off the end of an open circuit. Cost: 10 to 100 us a position.
        """
        traced = self.traced
        place, laps = places_and_laps(arcs, self.length, self.closed)
        given = np.atleast_1d(np.asarray(arcs, np.float64))
        segments = np.clip(np.searchsorted(traced.arcs, place, side="right") - 1, 0, len(self) - 2)
        x, t = traced.poses[segments], traced.tangents[segments]
        between = np.flatnonzero(traced.arcs[segments] != place)
        if len(between):
            curve, n = SampleBuffer(traced.arcs, traced.poses, traced.tangents, np.zeros(0)), self.system.unknowns
            near, slopes = np.empty((2, len(between), n))
            count = _core.evaluate_pose(self.system.conditions, curve, place[between], segments[between], near, slopes)
            if count < len(between):
                where = place[between[count]]
                raise LinkageError(
                    "the position at {where:.9g} of the circuit cannot be found: it is singular there", where=where
                )
            x[between], t[between] = near, slopes
        x += laps[:, None] * (traced.poses[-1] - traced.poses[0])
        return self._poses(given, x, t)

    def _poses(self, arcs: Reals, x: Reals, t: Reals) -> Poses:
        lower = self.system.lower
        links = lower.mechanism.chain.links
        places, angles = np.zeros((2, len(arcs), len(links)), np.complex128), np.zeros((2, len(arcs), len(links)))
        for body, link in enumerate(self.system.bodies):
            k = links.index(link)
            for order, part in enumerate((x, t)):
                places[order, :, k] = lower.size * (part[:, 3 * body] + 1j * part[:, 3 * body + 1])
                angles[order, :, k] = part[:, 3 * body + 2]
        return Poses(
            linkage=self.linkage,
            lower=lower,
            arcs=arcs,
            places=places,
            turns=np.exp(1j * angles[0]),
            rates=angles[1:],
            angles=angles[0],
            turned=self.turned,
        )

    # --- along it ------------------------------------------------------------------------------------

    def angle(self, link: str) -> Reals:
        """The angle of a link at the samples, continuous; (samples,)."""
        return self.samples.angle(link)

    def point(self, name: PointLike) -> Reals:
        """A named point or a joint at the samples; (samples, 2)."""
        return self.samples.point(name)

    def displacement(self, joint: str | int) -> Reals:
        """The way of a sliding joint at the samples; (samples,)."""
        return self.samples.displacement(joint)

    @property
    def drive(self) -> Reals:
        """The drive value at the samples; a turning drive begins in (-pi, pi], or near the value asked for."""
        return self.samples.drive()

    @cached_property
    def closure(self) -> float:
        """The largest distance by which a joint of any sample is open, in sizes."""
        return max(float(np.abs(self.system.linearised(x)[0]).max()) for x in self.traced.poses)

    # --- events --------------------------------------------------------------------------------------

    def roots(self, quantity: Quantity) -> tuple[float, ...]:
        """The arcs at which something is zero, in order; touches (double roots) among them.

        ``quantity(poses, order)`` is the value (order 0) or its derivative by the arc (order 1) for each pose.

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> made = circuit(FourBar(25, 70, 40, 70).linkage())
        >>> upright = made.roots(lambda poses, order: poses.angle("crank", order) - (order == 0) * np.pi / 2)
        >>> np.degrees(made.at(upright).angle("crank")).round(9).tolist()
        [90.0]
        """
        ends = quantity(self.samples, 0)[[0, -1]]
        again = self.closed and abs(ends[1] - ends[0]) <= _AGAIN * np.abs(quantity(self.samples, 0)).max()
        samples = FunctionSamples(grid=self.arcs, period=self.length if again else None, ends=True)
        zeros = find_zeros(lambda s: np.stack([quantity(p := self.at(s), 0), quantity(p, 1)]), samples)
        return tuple(sorted(wrapped(zero.at, self.length) if again else zero.at for zero in zeros))

    def extremes(self, quantity: Quantity, *, natural: float = 1.0) -> tuple[Extremum, ...]:
        """All extremes of something along the curve, in order; values to rounding.

        ``natural`` is the size that it usually has: 1 for an angle, the linkage's size for a length.
        """
        samples = FunctionSamples(grid=self.arcs, period=self.length if self.closed else None)
        zeros = find_zeros(lambda s: quantity(self.at(s), 1)[None], samples, least=_CONSTANT * natural)
        arcs = [wrapped(zero.at, self.length) if self.closed else zero.at for zero in zeros]
        values = quantity(self.at(arcs), 0)
        kinds = ["minimum" if zero.rises else "maximum" for zero in zeros]
        return tuple(sorted(map(Extremum, arcs, values.tolist(), kinds), key=lambda extremum: extremum.at))

    def range(self, quantity: Quantity, *, natural: float = 1.0) -> tuple[float, float]:
        """The smallest and the largest value of something along the curve; ``natural`` as for `extremes`."""
        values = [extreme.value for extreme in self.extremes(quantity, natural=natural)]
        values += quantity(self.samples, 0).tolist()
        return min(values), max(values)

    @cached_property
    def drive_limits(self) -> tuple[Extremum, ...]:
        """Where the drive turns back: dead centres of the linkage for this drive."""
        turns = all(drive.turning for drive in self.system.lower.mechanism.drives)
        return self.extremes(lambda poses, order: poses.drive(order), natural=1.0 if turns else self.system.lower.size)

    @property
    def monotone_pieces(self) -> tuple[MonotonePiece, ...]:
        """The pieces between limits of the drive, in order; the first one contains the first sample."""
        ends = ends_of_pieces(self.drive_limits, self.length, self.closed)
        return monotone_pieces(ends, self.at(ends).drive())

    @cached_property
    def change_points(self) -> tuple[ChangePoint, ...]:
        """Where other curves of positions cross this one; it goes straight on there."""
        poses = self.poses_at_change_points
        driven = bool(len(poses) and self.system.lower.mechanism.drives)
        drives = poses.drive().tolist() if driven else [float("nan")] * len(poses)
        crossing_several = [several for _, _, several in self.traced.changes]
        return tuple(
            ChangePoint(drive=drive, several=several, arc=arc)
            for drive, several, arc in zip(drives, crossing_several, poses.arcs.tolist(), strict=True)
        )

    @cached_property
    def poses_at_change_points(self) -> Poses:
        """The positions at `change_points`, a row for each, exactly."""
        traced, bodies = self.traced, self.system.bodies
        exact = np.array([pose for pose, _, _ in traced.changes]).reshape(-1, self.system.unknowns)
        arcs, slopes = np.zeros(len(exact)), np.zeros_like(exact)
        for row, (pose, k, _) in enumerate(traced.changes):
            chord = traced.poses[k + 1] - traced.poses[k]
            part = float((pose - traced.poses[k]) @ chord / (chord @ chord))
            arcs[row] = traced.arcs[k] + part * (traced.arcs[k + 1] - traced.arcs[k])
        if len(exact):
            slopes[:, : 3 * len(bodies)] = self.at(arcs).tangents(bodies)
        return self._poses(arcs, exact, slopes)

    def explain(self, lang: str = "en") -> str:
        """Whether it is closed, its length and what is on it: a few lines in English or German (``de``).

        >>> from gruebler.mechanics.fourbar import FourBar
        >>> circuit(FourBar(30, 30, 50, 60).linkage()).explain().splitlines()[1]
        'The drive turns back at R(frame-crank) = 121.9° and R(frame-crank) = -121.9°.'
        """
        driven = len(self.linkage.mechanism.drives) == 1
        limits = [limit.value for limit in self.drive_limits] if driven else None
        lines = circuit_lines(
            self.linkage,
            closed=self.closed,
            length=self.length,
            count=len(self),
            limits=limits,
            change_points=len(self.change_points),
        )
        return "\n".join(line.in_language(lang) for line in [*lines, *why_open(self.traced.ended)])

    def message(self, lang: str = "en") -> str:
        """Why it is not closed; empty if it is."""
        return "".join(line.in_language(lang) for line in why_open(self.traced.ended))


_NEVER = message("The drive never turns back.")
_CLOSED = message("A closed circuit {length:.4g} sizes of the linkage long, {count} samples.")
_OPENED = message("An open circuit {length:.4g} sizes of the linkage long, {count} samples.")
_OPEN = {
    "long": message("The circuit was not followed to its end: it is longer than what was asked for."),
    "singular": message("The circuit ends in a singular position from which it cannot be followed."),
}


def circuit_lines(
    linkage: Driven, *, closed: bool, length: float, count: int, limits: Sequence[float] | None, change_points: int
) -> list[Message]:
    """What is said of a circuit in the plane or in space; the limits of its drive are None without one."""
    lines = [(_CLOSED if closed else _OPENED).filled(length=length, count=count)]
    if limits is not None:
        values = joined_by_and([drive_values(linkage, (value,)) for value in limits])
        lines.append(message("The drive turns back at {values}.", values=values) if limits else _NEVER)
    if change_points:
        lines.append(message("Change points: {count}.", count=change_points))
    return lines


def ends_of_pieces(limits: Sequence[Extremum], length: float, closed: bool) -> list[float]:
    """The arcs between which the drive of a circuit never turns back."""
    ends = [limit.at for limit in limits]
    if not closed:
        return [0.0, *ends, length]
    return [ends[-1] - length, *ends] if ends else [0.0, length]


def monotone_pieces(ends: Sequence[float], drive: Reals) -> tuple[MonotonePiece, ...]:
    """The pieces between arcs with these values of the drive."""
    pairs = itertools.pairwise(zip(ends, drive.tolist(), strict=True))
    return tuple(MonotonePiece(first, second, (v, w)) for (first, v), (second, w) in pairs)


def wrapped(arc: float, length: float) -> float:
    """The same place of a closed circuit, from 0 to its length."""
    place = arc % length
    return 0.0 if length - place < _ROUND * length else place


def places_and_laps(arcs: ArrayLike, length: float, closed: bool) -> tuple[Reals, Reals]:
    """Arcs (k,) or one number as places from 0 to the length, and whole laps; `LinkageError` off the end of a curve."""
    given = np.atleast_1d(np.asarray(arcs, np.float64))
    if given.ndim != 1 or not np.isfinite(given).all():
        raise LinkageError("expected finite positions on the circuit, but found {arcs!r}", arcs=arcs)
    laps = np.floor(given / length) if closed else np.zeros(len(given))
    places = given - laps * length
    if len(places) and not (places.min() >= 0 and places.max() <= length):
        raise LinkageError(
            "this circuit goes from 0 to {length:.9g} and is not closed, so no {arcs!r} on it", length=length, arcs=arcs
        )
    return places, laps


def check_moves(closed: bool, length: float, least: float) -> None:
    """`LinkageError` for an open curve that is shorter than the least."""
    if not closed and length < least:
        raise LinkageError("the linkage cannot be moved from its start: it is shaky there, or the position is isolated")


def why_open(ended: str) -> list[Message]:
    """Why a circuit is not closed: a line, or none."""
    return [_OPEN[ended]] if ended else []


def check_steps(step: float, most: float) -> None:
    """`LinkageError` for steps along a circuit that are too long or too short, or for no length."""
    for name, value in {"step": step, "most": most}.items():
        _check_number(name, value)
    if not 1e-4 <= step <= 0.2 or not most > 0:
        raise LinkageError(
            "the step lies between 0.0001 and 0.2, the greatest length above 0, not {step:g}, {most:g}",
            step=step,
            most=most,
        )


def _check_number(name: str, value: float) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float | np.number) or not isfinite(value):
        raise LinkageError("{name}: expected a finite number, but found {value!r}", name=name, value=value)


@door_that_raises(LinkageError)
def circuit(
    linkage: LinkageLike,
    *,
    branch: Branch = None,
    at: float | None = None,
    step: float = 0.1,
    most: float = 1000.0,
) -> Circuit:
    """As `gruebler.circuit` in the plane."""
    linkage = as_linkage(linkage, unit="")
    check_steps(step, most)
    if at is not None:
        _check_number("at", at)
        if [each.turning for each in linkage.mechanism.drives] == [True]:
            warn_of_degrees("at", at)
    lower = with_lower_pairs(linkage)
    count = len(linkage.mechanism.drives)
    if count > 1:
        raise LinkageError("a circuit has one drive at most, but this linkage has {count}", count=count)
    system = closure_system(lower, [drive.between for drive in lower.mechanism.drives[count:]])
    pose, tangent = _start(linkage, system, branch, at)
    start = Circuit(
        linkage,
        system,
        TracedCurve(
            arcs=np.zeros(1), poses=pose[None], tangents=tangent[None], closed=False, ended="", changes=(), start=0.0
        ),
        0.0,
    )
    turned = 0.0
    if lower.mechanism.drives:
        value, ahead = float(start.drive[0]), float(start.samples.drive(1)[0])
        tangent = -tangent if ahead < 0 else tangent
        if lower.mechanism.drives[0].turning:
            turned = 2 * np.pi * round(((at or 0.0) - value) / (2 * np.pi))
    traced = trace_circuit(system, pose, tangent, float(step), float(most))
    check_moves(traced.closed, float(traced.arcs[-1]), _SHAKY)
    return Circuit(linkage, system, traced, turned)


def _start(linkage: Linkage, system: ClosureSystem, branch: Branch, drive: float | None) -> tuple[Reals, Reals]:
    """A pose and its tangent."""
    lower = system.lower
    if lower.reference_pose is not None and branch is None and drive is None:
        rows = [lower.reference_pose[link] for link in system.bodies]
        x = np.array([(p.x / lower.size, p.y / lower.size, p.angle) for p in rows]).ravel()
        pose, tangent, _, rank = nearest_on_curve(system, system.with_arms(x))
        return _movable(system, pose, tangent, rank)
    best: tuple[Reals, Reals] | None = None
    largest = 0.0
    for value in _trial_values(lower) if drive is None else [drive]:
        assembled = _assembled(linkage, system, value, branch)
        if assembled is None:
            continue
        pose, tangent, gauge, rank = nearest_on_curve(system, assembled)
        if drive is not None or abs(gauge) > largest:
            best, largest = _movable(system, pose, tangent, rank), abs(gauge)
        if largest > _SINGULAR:
            break
    if best is None:
        raise LinkageError(
            "the linkage cannot be assembled at any of {count} drive values; another drive value or a "
            "reference pose may help"
            if drive is None
            else "the linkage cannot be assembled at {drive:.9g}; another drive value or a reference pose may help",
            count=_TRIALS,
            drive=drive,
        )
    return best


def _movable(system: ClosureSystem, pose: Reals, tangent: Reals, rank: int) -> tuple[Reals, Reals]:
    """Pose and tangent, if there is one way to move on."""
    if rank == system.unknowns:
        raise LinkageError("the linkage cannot move: its joints hold every link")
    if rank < system.unknowns - 1:
        raise LinkageError(
            "the circuit cannot start in a singular position (a change point, or more than one freedom); "
            "another drive value may help"
        )
    return pose, tangent


def _trial_values(lower: Linkage) -> Iterator[float]:
    """Drive values for a start, far apart at first, then closer and closer."""
    if not lower.mechanism.drives:
        raise LinkageError("a circuit starts from a reference pose or from a drive value; this linkage has neither")
    reach = np.pi if lower.mechanism.drives[0].turning else _REACH * lower.size
    for k in range(_TRIALS):
        part = sum(((k >> bit) & 1) / 2 ** (bit + 1) for bit in range(10))
        yield reach * (2 * ((part + 0.637) % 1) - 1)


def _assembled(linkage: Linkage, system: ClosureSystem, value: float, branch: Branch) -> Reals | None:
    """The pose at a drive value, or None."""
    try:
        motion = move_quietly(linkage, [value], branch=branch)
    except LinkageError as error:
        if system.redundant and system.lower.reference_pose is None:
            raise LinkageError(
                "{error} With a reference pose (Linkage.from_drawing) its circuit can be followed all the same.",
                error=error,
            ) from None
        raise
    if not len(motion):
        return None
    rows = []
    for link in system.bodies:
        k = motion.link_index(link)
        z = motion.places[0, 0, k] / system.lower.size
        rows.append((z.real, z.imag, float(np.angle(motion.turns[0, k]))))
    return system.with_arms(np.array(rows).ravel())
