"""`circuit` of every linkage: all connected positions as one curve, in the plane or in space.

In space the curve is followed by its length, as in the plane: the drive is an unknown like the others, so that
positions in which it turns back are points like any others. docs/theory/space.md has the method.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import tau
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.events import ChangePoint, DeadCentre, Extremum
from gruebler.base.notebook import brief, explained
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, joined, joined_by_and, message
from gruebler.mechanics.kinematics import circuits as plane
from gruebler.mechanics.kinematics.circuits import Circuit, MonotonePiece
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.kinematics.root_finding import FunctionSamples, find_zeros
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, linkage_made
from gruebler.mechanics.screws.conversion import SpatialLike
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.curve import ConfigurationCurve, CurvePoint, TracedPoints
from gruebler.mechanics.space.following import setting
from gruebler.mechanics.space.motion import SpatialMotion
from gruebler.mechanics.space.outputs import against_frame, output_freedom
from gruebler.structure.chain.spaces import Freedom

_CONSTANT = 1e-11  # of the natural size: a derivative that is nowhere larger is none
_NEAR_CHANGE = 1e-4  # radians and sizes: so near a change point positions are interpolated
_BESIDE = np.array([-3e-3, -1e-3, 1e-3, 3e-3])  # radians and sizes: where a change point is interpolated between
_SHARES = np.array([-1, 9, 9, -1]) / 16
_SHAKY = 1e-3  # radians and sizes: a shaky linkage moves less, within what counts as full rank

_CENTRES = message("Dead centres of the output {joint} at {centres}.")
_NO_CENTRES = message("The output {joint} never turns back.")

Quantity = Callable[[SpatialMotion, int], Reals]
"""From a motion along the curve and 0, 1 or 2 to the value of something, or to its derivative by the arc; (rows,)."""


@compared_by_value
@explained
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class SpatialCircuit:
    """All positions of a linkage in space with one drive on one curve, with the reference pose.

    Places on the curve are given by the arc: its length from the first sample, in radians and sizes of all unknowns. On
    a closed circuit arcs below 0 or above `length` wrap around.

    See Also:
        `circuit`, `gruebler.mechanics.kinematics.Circuit`

    Theory:
        docs/theory/space.md
    """

    linkage: SpatialLinkage
    curve: ConfigurationCurve = field(compare=False, repr=False)
    traced: TracedPoints = field(compare=False, repr=False)
    arcs: Reals
    """(samples,) where the samples are; a closed circuit has its first position once more at the end."""
    start: float
    """The arc of the reference pose; 0 on a closed circuit."""

    def __len__(self) -> int:
        return len(self.arcs)

    @property
    def closed(self) -> bool:
        """Whether it comes back to the reference pose."""
        return not self.traced.ended

    @property
    def length(self) -> float:
        """The length of the curve, in radians and sizes."""
        return float(self.arcs[-1])

    @cached_property
    def samples(self) -> SpatialMotion:
        """The positions at `arcs`; derivatives up to the second are those by the arc."""
        return self.curve.motion(self.traced.points)

    @property
    def drive(self) -> Reals:
        """(samples,) the drive's value, with whole turns, 0 in the reference pose."""
        return np.asarray(self.samples.drives[:, 0])

    def at(self, arcs: ArrayLike) -> SpatialMotion:
        """The positions at given arcs, (k,) or one number, each exact; derivatives up to the second by the arc.

        At and beside a change point they are interpolated between four positions beside it; relative error some 1e-12.
        Raises `LinkageError` for places off the end of an open circuit. Cost: some 0.5 ms a position.
        """
        given = np.asarray(arcs, np.float64).ravel()
        places, laps = plane.places_and_laps(arcs, self.length, self.closed)
        points, shares = list[CurvePoint](), list[tuple[int, int, float]]()
        changes = np.array([change.arc for change in self.change_points])
        for row, each in enumerate(zip(places.tolist(), laps.tolist(), strict=True)):
            # Beside a change point a position can be found, but its rates are wrong by rounding over the distance.
            point = None if (np.abs(changes - each[0]) < _NEAR_CHANGE).any() else self._point(*each)
            beside = [] if point else [self._beside(given[row] + step) for step in _BESIDE]
            for share, near in [(1.0, point)] if point else zip(_SHARES, beside, strict=True):
                shares.append((row, len(points), share))
                points.append(near)
        motion = self.curve.motion(points)
        if len(points) == len(given):
            return motion
        rows, columns, parts = zip(*shares, strict=True)
        weights = np.zeros((len(given), len(points)))
        weights[rows, columns] = parts
        return replace(
            motion,
            drives=weights @ motion.drives,
            poses=np.einsum("rp,opl...->orl...", weights, motion.poses),
            unknowns={key: values @ weights.T for key, values in motion.unknowns.items()},
            derivatives=np.tensordot(weights, motion.derivatives, 1),
        )

    def _beside(self, arc: float) -> CurvePoint:
        """The position at an arc beside a change point."""
        (place,), (laps,) = plane.places_and_laps(arc, self.length, self.closed)
        point = self._point(float(place), float(laps))
        if point is None:
            raise LinkageError(
                "the position at {where:.9g} of the circuit cannot be found: it is singular there", where=arc
            )
        return point

    def _point(self, arc: float, laps: float) -> CurvePoint | None:
        points = self.traced.points
        k = int(np.clip(np.searchsorted(self.arcs, arc, side="right") - 1, 0, len(points) - 2))
        point = self.curve.within(points[k], points[k + 1], (arc - self.arcs[k]) / (self.arcs[k + 1] - self.arcs[k]))
        if point is None:
            return None
        whole = self.curve.whole_turns(points[-1].place) * laps
        return point._replace(place=self.curve.moved(point.place, whole))

    # --- events --------------------------------------------------------------------------------------

    def extremes(self, quantity: Quantity, *, natural: float = 1.0) -> tuple[Extremum, ...]:
        """All extremes of something along the curve, in order; values to rounding.

        ``natural`` is the size that it usually has: 1 for an angle, the linkage's size for a length.

        >>> from gruebler.mechanics.space import RSSR
        >>> wiper = RSSR(a=30, b=140, c=80, d=100, twist=0.7, rocker_offset=40)
        >>> extremes = circuit(wiper.linkage(0.4)).extremes(lambda motion, order: motion.joint(3, order=order))
        >>> least, most = sorted(extreme.value for extreme in extremes)
        >>> abs(most - least - wiper.swing()) < 5e-10
        True
        """
        known = np.array([quantity(self.samples, order) for order in (1, 2)])

        def rates(arcs: Reals) -> Reals:
            k = np.minimum(np.searchsorted(self.arcs, arcs), len(self) - 1)
            new = self.arcs[k] != arcs
            values = known[:, k]
            if new.any():
                motion = self.at(arcs[new])
                values[:, new] = quantity(motion, 1), quantity(motion, 2)
            return values

        samples = FunctionSamples(grid=self.arcs, period=self.length if self.closed else None)
        zeros = [zero for zero in find_zeros(rates, samples, least=_CONSTANT * natural) if zero.multiplicity != 2]
        arcs = [plane.wrapped(zero.at, self.length) if self.closed else zero.at for zero in zeros]
        kinds = ["minimum" if zero.rises else "maximum" for zero in zeros]
        values = self._values(quantity, np.array(arcs)).tolist() if arcs else []
        return tuple(sorted(map(Extremum, arcs, values, kinds), key=lambda extremum: extremum.at))

    def _values(self, quantity: Quantity, arcs: Reals) -> Reals:
        """Values at arcs: of an angle with the whole turns of the samples."""
        values = quantity(self.at(arcs), 0)
        near = np.interp(arcs, self.arcs, quantity(self.samples, 0))
        return np.where(abs(values - near) < tau / 2, values, values + tau * np.round((near - values) / tau))

    @cached_property
    def drive_limits(self) -> tuple[Extremum, ...]:
        """Where the drive turns back: dead centres of the linkage for this drive."""
        (drive,) = self.linkage.mechanism.drives
        sign = float(self.curve.closure.tree.signs[0])
        return self.extremes(
            lambda motion, order: sign * motion.joint(drive.joint, drive.direction, order),
            natural=1.0 if drive.turning else self.linkage.size,
        )

    def dead_centres(self, output: str | None = None) -> tuple[DeadCentre, ...]:
        """Where a joint turns back, in order along the curve, on all branches.

        Args:
            output: a joint; without it that of the first output at the frame, else the last one of the frame.

        Returns:
            The drive's value (of a turning drive with whole turns), the joint's value from the reference pose, and
            whether it is a maximum or minimum; radians and lengths. Motion at the frame is counted against the frame.
        """
        number, freedom = output_freedom(self.linkage, output)
        sign = against_frame(self.linkage, number)
        extremes = self.extremes(
            lambda motion, order: sign * motion.joint(number, freedom, order),
            natural=1.0 if Freedom(freedom).turns else self.linkage.size,
        )
        drives = self.at([each.at for each in extremes]).drives[:, 0].tolist() if extremes else []
        return tuple(
            DeadCentre(drive=drive, output=each.value, kind=each.kind)
            for drive, each in zip(drives, extremes, strict=True)
        )

    @property
    def monotone_pieces(self) -> tuple[MonotonePiece, ...]:
        """The pieces between limits of the drive, in order; the first one contains the first sample."""
        ends = plane.ends_of_pieces(self.drive_limits, self.length, self.closed)
        return plane.monotone_pieces(ends, self.at(ends).drives[:, 0])

    @cached_property
    def change_points(self) -> tuple[ChangePoint, ...]:
        """Where other curves of positions cross this one; it goes straight on there.

        To some 1e-11 where it is smooth over 0.08 radians and crossed once there, else to 1e-6.
        """
        changes, closure = [], self.curve.closure
        drive = int(self.curve.columns[0])
        unit = float(closure.units[drive] * closure.tree.signs[0])
        for k, point in self.traced.crossings:
            here, there = self.traced.points[k : k + 2]
            chord = self.curve.way(here, there)
            share = float(chord @ self.curve.way(here, point)) / float(chord @ chord)
            arc = float(self.arcs[k] + share * (self.arcs[k + 1] - self.arcs[k]))
            changes.append(ChangePoint(drive=float(point.place.q[drive]) * unit, arc=arc))
        return tuple(changes)

    def explain(self, lang: str = "en") -> str:
        """Whether it is closed, and where drive and output turn back: lines in English or German (``de``)."""
        return "\n".join(line.in_language(lang) for line in self._lines())

    def summary(self, lang: str = "en") -> str:
        """Whether it is closed, how long it is, and how many change points it has: lines as of `explain`."""
        lines = [*self._first_lines(None), *plane.why_open(self.traced.ended)]
        return "\n".join(line.in_language(lang) for line in lines)

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`; angles in radians, dead centres those of the first output."""
        document: dict[str, Any] = plain(self, "closed length drive_limits change_points")
        return document | {"dead_centres": plain(list(self.dead_centres()), "drive output kind")}

    def _lines(self) -> list[Message]:
        lines = self._first_lines([limit.value for limit in self.drive_limits])
        try:
            number, _ = output_freedom(self.linkage)
        except LinkageError:  # a linkage whose joints have no values
            return [*lines, *plane.why_open(self.traced.ended)]
        joint = joined([self.linkage.mechanism.chain.joint_title(number)])
        centres = [drive_values(self.linkage, (each.drive,)) for each in self.dead_centres()]
        lines.append(
            _CENTRES.filled(joint=joint, centres=joined_by_and(centres)) if centres else _NO_CENTRES.filled(joint=joint)
        )
        return [*lines, *plane.why_open(self.traced.ended)]

    def _first_lines(self, limits: list[float] | None) -> list[Message]:
        return plane.circuit_lines(
            self.linkage,
            closed=self.closed,
            length=self.length,
            count=len(self),
            limits=limits,
            change_points=len(self.change_points),
        )

    def message(self, lang: str = "en") -> str:
        """Why it is not closed; empty if it is."""
        return "\n".join(line.in_language(lang) for line in plane.why_open(self.traced.ended))


@overload
def circuit(
    linkage: SpatialLike, *, branch: Branch = None, at: float | None = None, step: float = 0.1, most: float = 1000.0
) -> SpatialCircuit: ...


@overload
def circuit(
    linkage: LinkageLike, *, branch: Branch = None, at: float | None = None, step: float = 0.1, most: float = 1000.0
) -> Circuit: ...


@door_that_raises(LinkageError)
def circuit(
    linkage: LinkageLike | SpatialLike,
    *,
    branch: Branch = None,
    at: float | None = None,
    step: float = 0.1,
    most: float = 1000.0,
) -> Circuit | SpatialCircuit:
    """The circuit of a linkage with one freedom: all positions that it can reach without being taken apart.

    In the plane it starts from the linkage's reference pose if there is one and neither a branch nor a drive value is
    asked for; else from the drive value, or from the first value of a fixed list at which the branch can be assembled.
    Redundant joints are allowed from a reference pose. In space it starts from the reference pose. It begins in the
    direction in which the drive increases.

    Args:
        linkage: with one drive, or in the plane with a reference pose and none.
        branch: the assembly mode at the start, as for `move`. Not in space.
        at: the drive value at the start, in radians or the unit. Not in space.
        step: the longest distance of samples, in sizes (and in space radians); extremes nearer to each other than that
            may be missed in pairs.
        most: the length at which to give up, in sizes.

    Returns:
        `Circuit`: the closed curve of all connected positions by arc length (in sizes of the linkage), with limits of
        the drive and change points. In space `SpatialCircuit`, with dead centres of every joint too.

    Raises:
        LinkageError: no start, several drives or freedoms, a start that cannot move or that is singular.

    Cost:
        10 (four-bar) to 200 us (ten links) a sample, some 100 to 1000 samples. In space 0.3 to 1 ms a sample.

    Example:
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> made = circuit(FourBar(30, 30, 50, 60).linkage())
        >>> made.closed, np.degrees([limit.value for limit in made.drive_limits]).round(6).tolist()
        (True, [121.855431, -121.855431])
        >>> from gruebler.mechanics.space import RSSR
        >>> rssr = RSSR(a=60, b=90, c=50, d=70, crank_offset=10, rocker_offset=15, twist=0.9)
        >>> print(circuit(rssr.linkage(3.0)).explain().splitlines()[1])
        The drive turns back at R(frame-crank) = 139.9° and R(frame-crank) = -140°.

    See Also:
        `Circuit`, `move`, `rotatability`, `drive_range`

    Theory:
        docs/theory/circuits.md
    """
    placed = linkage_made(linkage, unit="")
    if not isinstance(placed, SpatialLinkage):
        return plane.circuit(placed, branch=branch, at=at, step=step, most=most)
    if branch is not None or at is not None:
        raise LinkageError("a circuit in space starts at the reference pose, without branch and without a drive value")
    plane.check_steps(step, most)
    set_up = setting(placed)
    if len(set_up.drives) != 1:
        raise LinkageError(
            "a circuit needs one drive, but the mechanism has {count}: {drives}",
            count=len(set_up.drives),
            drives=", ".join(placed.mechanism.drive_names()),
        )
    curve = ConfigurationCurve(set_up)
    first = curve.begin()
    traced = curve.traced(first, float(step), float(most))
    start = 0.0
    if traced.ended:
        traced, start = curve.both_ways(traced, curve.traced(first._replace(tangent=-first.tangent), step, most))
    plane.check_moves(not traced.ended, float(traced.arcs[-1]), _SHAKY)
    return SpatialCircuit(linkage=placed, curve=curve, traced=traced, arcs=traced.arcs, start=start)
