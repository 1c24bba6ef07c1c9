"""What a free motion gives: poses of a linkage by time, with their energies."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gruebler.base import notebook
from gruebler.base.arrays import Complexes, Reals, angles_of_turns, compared_by_value
from gruebler.base.columns import Tabled
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief, explained
from gruebler.base.text import Message, message
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.link_poses import LinkPoses
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.kinematics.plan import Plan, plan
from gruebler.mechanics.kinematics.reference_pose import pose_at_reference
from gruebler.mechanics.linkages import Linkage

_ONE_ROW = message("At {start} at {begin:n} s, the only row.")
_SUMMARY = message("From {start} at {begin:n} s to {end} at {last:n} s; {count} rows.")
_ENERGY = message("Energy is kept to {defect:.1e} of what is exchanged.")
_COORDINATES = message("Coordinates were exchanged {count} times.")
_ONE_EXCHANGE = message("Coordinates were exchanged once.")


@explained
@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Simulation(LinkPoses, Tabled):
    """A linkage that moves by itself, row by row in time; order 0 are poses, 1 velocities, 2 accelerations."""

    linkage: Linkage
    plan: Plan
    times: Reals
    """(rows,) in seconds."""
    drives: Reals
    """(rows, drives): radians, or the linkage's unit; continuous."""
    speeds: Reals
    """(rows, drives)."""
    accelerations: Reals
    """(rows, drives); NaN at limits of the drives, where their speeds are 0 and links move on."""
    places: Complexes
    """(3, rows, links): origins of the links and their derivatives by the time."""
    turns: Complexes
    """(rows, links): cosine + i sine of the angles."""
    rates: Reals
    """(2, rows, links): angular velocities and accelerations."""
    whole: NDArray[np.int32]
    """(rows, links): whole turns to add to the angle's principal value."""
    kinetic: Reals
    """(rows,): in newtons times the linkage's unit."""
    potential: Reals
    """(rows,): of weights and springs."""
    work: Reals
    """(rows,): done so far by loads, dampers and motors that have no potential."""
    coordinates: tuple[tuple[float, tuple[str, ...]], ...]
    """From which time on the values of which joints were integrated."""
    steps: int
    evaluations: int
    """How often the forces were evaluated."""
    reason: Message | None
    """Why it ended before its time."""

    def __len__(self) -> int:
        return len(self.times)

    @property
    def complete(self) -> bool:
        """Whether it was followed to the time that was asked for."""
        return self.reason is None

    @property
    def lower_linkage(self) -> Linkage:
        """The linkage as it was solved: with lower pairs, and the links that replace higher ones."""
        return self.plan.lower

    def angle(self, link: str) -> Reals:
        """The angle of a link's x axis against the frame's, in radians, continuous; (rows,)."""
        k = self.link_index(link)
        return angles_of_turns(self.turns[:, k], self.whole[:, k])

    def angular(self, link: str, *, order: int = 1) -> Reals:
        """The angular velocity (1) or acceleration (2) of a link; (rows,)."""
        self.check_order(order)
        return self.rates[order - 1, :, self.link_index(link)] if order else self.angle(link)

    def check_order(self, order: int) -> None:
        """`LinkageError` for an order of derivatives that is not there."""
        if order not in (0, 1, 2):
            raise LinkageError("a free motion has derivatives of the orders 0, 1 and 2, not {order!r}", order=order)

    @property
    def energy(self) -> Reals:
        """Kinetic and potential energy less the work done: what should be constant; (rows,)."""
        return self.kinetic + self.potential - self.work

    @cached_property
    def defect(self) -> float:
        """By how much `energy` changes at most, as a part of what is exchanged: kinetic, potential energy and work."""
        scale = self.kinetic.max(initial=0.0) + sum(float(np.ptp(e)) for e in (self.potential, self.work) if len(e))
        lost = float(np.abs(self.energy - self.energy[0]).max())
        rounding = 64 * np.finfo(float).eps * float(np.abs(self.potential).max())
        return lost / scale if lost > rounding else 0.0  # at rest nothing is exchanged but what was rounded

    @cached_property
    def motion(self) -> Motion:
        """The same rows as a motion along a path of the drives: for joint forces, tables, pictures.

        Its roots tell the assembly mode in the first row only.
        """
        posed = plan(self.linkage.with_reference_pose(self.pose(0)))
        start = pose_at_reference(posed, self.drives[0])
        roots, unknowns = np.zeros((len(self), len(self.plan.dyads))), np.zeros((len(self), self.plan.unknowns))
        roots[0], unknowns[0] = start.signs, start.unknowns
        return Motion(
            linkage=self.linkage,
            plan=self.plan,
            drives=self.drives,
            places=self.places,
            turns=self.turns,
            rates=self.rates,
            whole=self.whole,
            roots=roots,
            unknowns=unknowns,
            stop=None,
            speeds=np.array([self.speeds, self.accelerations]),
        )

    def message(self, lang: str = "en") -> str:
        """Why it ended before its time; empty if it did not."""
        return self.reason.in_language(lang) if self.reason else ""

    def explain(self, lang: str = "en") -> str:
        """From where to where, how well energy is kept, and why it ended: a few lines in English or German (``de``)."""
        ends = [drive_values(self.linkage, tuple(map(float, self.drives[row]))) for row in (0, -1)]
        times = [float(self.times[row]) for row in (0, -1)]
        lines = [
            _ONE_ROW.filled(start=ends[0], begin=times[0])
            if len(self) == 1
            else _SUMMARY.filled(start=ends[0], begin=times[0], end=ends[1], last=times[1], count=len(self)),
            _ENERGY.filled(defect=self.defect),
        ]
        exchanges = len(self.coordinates) - 1
        if exchanges:
            lines.append(_ONE_EXCHANGE if exchanges == 1 else _COORDINATES.filled(count=exchanges))
        lines += [self.reason] if self.reason else []
        return "\n".join(line.in_language(lang) for line in lines)

    def _repr_svg_(self) -> str | None:
        """The first pose with some others thinly, for notebooks."""
        return notebook.svg_of(self.motion) if notebook.svg_of else None
