"""Inverse dynamics: what drives and joints carry in a given motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.columns import Tabled
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.text import Message, message
from gruebler.mechanics.dynamics.equations import EquationsOfMotion, ReducedEquations, reduced_equations, speeds_of
from gruebler.mechanics.forces.acting import Wrench
from gruebler.mechanics.forces.friction import Friction, PerJoint
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.solution import Statics, equilibrium
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.messages import drive_name, drive_values
from gruebler.mechanics.linkages import LinkPoint

_TORQUE, _FORCE = message("torque {joint}"), message("force {joint}")
_LARGEST = message("Largest effort: {name} = {value:n} {unit} at {place}; effective (root mean square) {rms:n}.")
_ROUNDING = float(np.finfo(np.float64).eps)  # nothing agrees better than numbers are written
_AGREE = message("Equilibrium and equations of motion agree to {part:.1e} of the largest load.")


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class InverseDynamics(Tabled):
    """Efforts of the drives and forces of the joints in a motion, masses included, at each row."""

    statics: Statics
    """All joint forces and drive efforts, from the equilibrium of every link with the forces of its inertia."""
    inertia: tuple[Wrench, ...]
    """The forces and moments of inertia: - m a at each mass and centre, - J alpha on each body."""
    loads: Loads
    times: ArrayLike = 0.0

    @property
    def motion(self) -> Motion:
        """The motion."""
        return self.statics.motion

    @property
    def drive(self) -> Reals:
        """The torque of a driven joint, or the force of a driven slide, by equilibrium; (rows, drives)."""
        return self.statics.drive

    @property
    def motion_effort(self) -> Reals:
        """M q'' + h - Q, without friction, by the power of loads and inertia: the second way to the drives' efforts.

        (rows, drives).
        """
        return self.statics.work if self.statics.friction is None else self.statics.friction.frictionless

    @cached_property
    def equations(self) -> ReducedEquations:
        """M, h, Q and the energies over the rows."""
        return reduced_equations(self.motion, self.loads, times=self.times)

    @cached_property
    def disagreement(self) -> float:
        """The largest difference between equilibrium and the equations of motion, by the largest effort or load.

        Both without friction; NaN if no row has both answers.
        """
        rubbing = self.statics.friction
        first = self.statics.drive if rubbing is None else rubbing.frictionless
        both = np.isfinite(first) & np.isfinite(self.motion_effort)
        if not both.any():
            return float("nan")
        apart = np.where(both, first - self.motion_effort, 0.0) / self.statics.load
        largest = np.abs(np.where(both, first, 0.0) / self.statics.load).max()
        return float(np.abs(apart).max() / max(largest, 1.0))

    @cached_property
    def power(self) -> Reals:
        """The power of each drive, in newtons times the linkage's unit a second; (rows, drives)."""
        return np.asarray(self.drive * speeds_of(self.motion))

    @cached_property
    def mean_power(self) -> Reals:
        """The mean of each drive's power over time; (drives,). 0 over a closed turn on which only masses act."""
        return self._mean(self.power)

    @cached_property
    def shaking_force(self) -> Reals:
        """The force of inertia of all links together, which shakes the foundation, in newtons; (rows, 2)."""
        total = sum((wrench.force for wrench in self.inertia), np.zeros(len(self.motion), np.complex128))
        return np.stack([total.real, total.imag], axis=1)

    def shaking_moment(self, about: tuple[float, float] = (0.0, 0.0)) -> Reals:
        """The moment of inertia forces about a place of the frame, in newtons times the linkage's unit; (rows,)."""
        moment, origin = np.zeros(len(self.motion)), self._frame_point(about)
        for wrench in self.inertia:
            arm = self.motion.complex_point(wrench.place) - origin
            moment += (np.conj(arm) * wrench.force).imag + wrench.moment
        return moment

    @cached_property
    def peak(self) -> Reals:
        """The largest size of each drive's effort; (drives,)."""
        return np.asarray(np.nanmax(np.abs(self.drive), axis=0))

    @cached_property
    def root_mean_square(self) -> Reals:
        """The effective effort of each drive; (drives,): by it motors are chosen for heat.

        The mean over time, by the trapezoidal rule: a closed turn counts its first row, which is its last, once.
        """
        return np.asarray(np.sqrt(self._mean(self.drive**2)))

    def explain(self, lang: str = "en") -> str:
        """Each drive's largest effort and where, and what `remarks` has."""
        linkage, lines = self.motion.linkage, list[Message]()
        for k, drive in enumerate(linkage.mechanism.drives):
            if not np.isfinite(self.drive[:, k]).any():
                continue
            row = int(np.nanargmax(np.abs(self.drive[:, k])))
            lines.append(
                _LARGEST.filled(
                    name=(_TORQUE if drive.turning else _FORCE).filled(joint=drive_name(linkage.mechanism, k)),
                    value=float(self.drive[row, k]),
                    unit=f"N·{linkage.unit}" if drive.turning else "N",
                    place=drive_values(linkage, tuple(map(float, self.motion.drives[row]))),
                    rms=float(self.root_mean_square[k]),
                )
            )
        return "\n".join([*(line.in_language(lang) for line in lines), *self.remarks(lang)])

    def remarks(self, lang: str = "en") -> tuple[str, ...]:
        """How well two methods agree, where the motion ends, and where forces are not determined."""
        known = np.isfinite(self.disagreement)
        agree = _AGREE.filled(part=max(self.disagreement, _ROUNDING)).in_language(lang) if known else ""
        return tuple(filter(None, [agree, self.motion.message(lang), self.statics.message(lang)]))

    def _mean(self, values: Reals) -> Reals:
        """Over time, of the rows where the drives' efforts are known; (drives,)."""
        held = np.where(np.isfinite(values), self._durations[:, None], 0.0)
        with np.errstate(invalid="ignore"):
            return np.asarray((held * np.nan_to_num(values)).sum(axis=0) / held.sum(axis=0))

    @property
    def _durations(self) -> Reals:
        """(rows,): the half of the time to the row before and to the one behind, from drives and speeds; else ones."""
        speeds = speeds_of(self.motion)
        fastest = np.abs(speeds).max(axis=0, initial=0.0)
        scale = np.where(fastest > 0, fastest, np.inf)  # a drive at rest says nothing of the time
        speed = np.linalg.norm(speeds / scale, axis=1)
        travelled, both = np.linalg.norm(np.diff(self.motion.drives, axis=0) / scale, axis=1), speed[1:] + speed[:-1]
        times = np.divide(travelled, both, out=np.zeros_like(travelled), where=both > 0)
        weights = np.append(times, 0.0) + np.append(0.0, times)
        return weights if weights.any() else np.ones_like(weights)

    def _frame_point(self, about: tuple[float, float]) -> Complexes:
        frame = self.motion.linkage.mechanism.frame
        return self.motion.complex_point(LinkPoint(frame, *map(float, about)))


@door_that_raises(LinkageError)
def inverse_dynamics(
    motion: Motion, loads: Loads, *, friction: Friction | PerJoint | None = None, times: ArrayLike = 0.0
) -> InverseDynamics:
    """What drives and joints carry in a motion, by two independent methods.

    Equilibrium of every link, with its forces of inertia, gives all forces; the equations of motion, M q'' + h - Q,
    know nothing of joints and give the drives' efforts once more. Error: that of the poses times the condition of the
    pose.

    Args:
        motion: Solved with speeds and accelerations: ``move(linkage, drives, speed=...)``.
        loads: What acts, and the masses; motors are not asked, since their effort is what is looked for.
        friction: As in `statics`.
        times: At which loads are taken that depend on the time; (rows,) or one.

    Returns:
        `InverseDynamics`: ``drive`` (rows, drives) in N times the unit of length (N of slides), ``statics`` with all
        joint forces, ``shaking_force`` (rows, 2), ``power``, ``disagreement`` of the two methods.

    Raises:
        LinkageError: a motion without accelerations, loads on points that are not there, an unknown unit of length.

    Cost:
        Some 0.5 us a row of a four-bar, 1.2 us of an eight-bar of dyads, two to four times `move`; where not all
        links are dyads or driven, some 20 us. Of several drives, or speeds that are 0, the motion once more for each.

    Example:
        >>> from gruebler.mechanics.forces import RigidBody
        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> from gruebler.mechanics.kinematics import move
        >>> engine = move(SliderCrank(30, 50).linkage(), np.radians([0.0]), speed=100.0)
        >>> run = inverse_dynamics(engine, Loads(bodies={"slider": RigidBody(2.0)}))
        >>> run.shaking_force.round(6).tolist()  # m r w² (1 + r/l) = 2 · 0.03 · 10⁴ · 1.6 N
        [[960.0, 0.0]]

    See Also:
        `statics`, `simulate`, `move`, `Loads`

    Theory:
        docs/theory/dynamics.md
    """
    motion.check_order(2)
    inertia = inertia_of(motion, loads)
    held = equilibrium(motion, loads, friction, times, inertia)
    return InverseDynamics(statics=held, inertia=inertia, loads=loads, times=times)


def inertia_of(motion: Motion, loads: Loads) -> tuple[Wrench, ...]:
    """The forces and moments of inertia of all masses in a motion with accelerations."""
    equations = EquationsOfMotion(motion.linkage, motion.links, loads)
    acting = equations.acting
    weights = equations.metres * acting.masses(len(motion))
    spins = [*(0.0 for _ in loads.masses), *(equations.metres * body.inertia for body in loads.bodies.values())]
    return tuple(
        Wrench(
            spot,
            -weights[:, k] * motion.complex_point(spot, order=2),
            -spin * motion.angular(spot.link, order=2),
        )
        for k, (spot, spin) in enumerate(zip(acting.spots[acting.heavy], spins, strict=True))
    )
