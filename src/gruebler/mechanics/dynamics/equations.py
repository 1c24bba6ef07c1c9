"""The equations of motion of a linkage in the values of its drives: M q'' + h = Q, as sums over its bodies."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Complexes, Flags, Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.units import metres_of
from gruebler.mechanics.forces.acting import ActingLoads, MovingLinks
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.motion_rates import with_velocities
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class Influences:
    """How the links of a linkage move with its drives, in rows; links in the order in which the linkage is solved."""

    places: Complexes
    """(rows, links)."""
    turns: Complexes
    """(rows, links)."""
    angles: Reals
    """(rows, links), continuous: torsion springs and laws of an angle look at them."""
    unit_places: Complexes
    """(drives, rows, links): velocities of the origins for a unit speed of each drive."""
    unit_rates: Reals
    """(drives, rows, links): angular velocities likewise."""
    drift_places: Complexes
    """(rows, links): accelerations of the origins at the speeds of the drives, without acceleration of the drives."""
    drift_rates: Reals
    """(rows, links): angular accelerations likewise."""

    def picked(self, rows: Flags) -> Influences:
        """Those rows that are asked for."""
        of_drives = ("unit_places", "unit_rates")
        columns = {f.name: getattr(self, f.name) for f in fields(self)}
        return Influences(**{name: c[:, rows] if name in of_drives else c[rows] for name, c in columns.items()})

    def moving(self, time: ArrayLike, drives: Reals, speeds: Reals) -> MovingLinks:
        """The links with the velocities that the drives' speeds give."""
        return MovingLinks(
            places=self.places,
            turns=self.turns,
            angles=self.angles,
            velocities=np.einsum("rf,frl->rl", speeds, self.unit_places),
            rates=np.einsum("rf,frl->rl", speeds, self.unit_rates),
            time=np.broadcast_to(np.asarray(time, np.float64), (len(drives),)),
            drives=drives,
            speeds=speeds,
        )


@compared_by_value
@dataclass(frozen=True, eq=False)
class Terms:
    """M q'' + h = Q in rows, in the units of the drives' efforts: N times the unit of length, of slides N."""

    mass: Reals
    """(rows, drives, drives): M."""
    bias: Reals
    """(rows, drives): h, from the products of speeds."""
    force: Reals
    """(rows, drives): Q, what loads, springs and dampers do."""


@dataclass(frozen=True, eq=False)
class EquationsOfMotion:
    """The equations of motion of a linkage under loads, for poses and influences of any origin.

    The factor between the unit of length and metres stands in the masses here, and nowhere else.
    """

    linkage: Linkage
    links: tuple[str, ...]
    """In the order in which the linkage is solved."""
    loads: Loads

    @cached_property
    def acting(self) -> ActingLoads:
        """What acts."""
        return ActingLoads(self.linkage, self.links, self.loads)

    @cached_property
    def metres(self) -> float:
        """Metres in the linkage's unit; 1 where nothing has mass. `LinkageError` for an unknown unit."""
        if not (self.loads.masses or self.loads.bodies):
            return 1.0
        try:
            return metres_of(self.linkage.unit)
        except GrueblerError as error:
            raise LinkageError(error.text, **error.values) from None

    def terms(
        self, influences: Influences, time: ArrayLike, drives: Reals, speeds: Reals, *, motors: bool = False
    ) -> Terms:
        """M, h and Q in rows of drive values and speeds, (rows, drives) each."""
        moving = influences.moving(time, drives, speeds)
        mass, bias = self.inertia(influences, moving)
        force = self.generalised(influences, moving)
        if motors:
            force += self.acting.motor_efforts(moving)
        return Terms(mass, bias, force)

    def inertia(self, influences: Influences, moving: MovingLinks) -> tuple[Reals, Reals]:
        """M (rows, drives, drives) and h (rows, drives)."""
        at = self._turned(influences)
        unit, spin = self._unit(influences, at), influences.unit_rates
        weight, inertia = self._weights(len(moving.time))
        heavy = self.acting.heavy
        drift = self._drift(influences, moving, at)[:, heavy]
        moved = unit[:, :, heavy]
        mass = np.einsum("rs,frs,grs->rfg", weight, np.conj(moved), moved).real
        mass += np.einsum("l,frl,grl->rfg", inertia, spin, spin)
        bias = np.einsum("rs,frs,rs->rf", weight, np.conj(moved), drift).real
        bias += np.einsum("l,frl,rl->rf", inertia, spin, influences.drift_rates)
        return mass, bias

    def generalised(self, influences: Influences, moving: MovingLinks) -> Reals:
        """Q (rows, drives) of all loads but motors."""
        unit = self._unit(influences, self._turned(influences))
        force: Reals = np.einsum("frs,rs->rf", np.conj(unit), self.acting.forces_at(moving)).real
        force += np.einsum("frl,rl->rf", influences.unit_rates, self.acting.moments_on(moving))
        return force

    def kinetic(self, influences: Influences, speeds: Reals) -> Reals:
        """The kinetic energy; (rows,)."""
        unit = self._unit(influences, self._turned(influences))[:, :, self.acting.heavy]
        weight, inertia = self._weights(len(speeds))
        velocities = np.einsum("rf,frs->rs", speeds, unit)
        rates = np.einsum("rf,frl->rl", speeds, influences.unit_rates)
        return np.asarray((weight * np.abs(velocities) ** 2).sum(axis=1) / 2 + (inertia * rates**2).sum(axis=1) / 2)

    def potential(self, influences: Influences, drives: Reals) -> Reals:
        """The energy of weights and springs; (rows,)."""
        return self.acting.potential(influences.moving(0.0, drives, drives * 0.0))

    def _weights(self, rows: int) -> tuple[Reals, Reals]:
        """Masses (rows, heavy spots) and moments of inertia (links,), for forces in newtons."""
        return self.metres * self.acting.masses(rows), self.metres * self.acting.inertias

    def _turned(self, influences: Influences) -> Complexes:
        """The arms of all spots as they are turned; (rows, spots)."""
        return np.asarray(influences.turns[:, self.acting.of] * self.acting.arms)

    def _unit(self, influences: Influences, arms: Complexes) -> Complexes:
        """(drives, rows, spots): velocities of all spots for unit speeds."""
        of = self.acting.of
        return np.asarray(influences.unit_places[:, :, of] + 1j * influences.unit_rates[:, :, of] * arms)

    def _drift(self, influences: Influences, moving: MovingLinks, arms: Complexes) -> Complexes:
        """(rows, spots): accelerations without acceleration of the drives."""
        of = self.acting.of
        turned = 1j * influences.drift_rates[:, of] - moving.rates[:, of] ** 2
        return np.asarray(influences.drift_places[:, of] + turned * arms)


def influences_of(motion: Motion) -> Influences:
    """The influences in the rows of a motion, at its speeds; NaN in rows that cannot be solved with speeds.

    Cost: the motion once more for each drive and, of several drives, once for their speeds.
    """
    count, (rows, links) = motion.drives.shape[1], motion.turns.shape
    unit_places = np.full((count, rows, links), np.nan, np.complex128)
    unit_rates = np.full((count, rows, links), np.nan)
    drift_places = np.full((rows, links), np.nan, np.complex128)
    drift_rates = np.full((rows, links), np.nan)
    speeds = speeds_of(motion)
    for k in range(count):
        for picked, moved in with_velocities(motion, np.eye(count)[k], order=2 if count == 1 else 1):
            unit_places[k, picked], unit_rates[k, picked] = moved.places[1], moved.rates[0]
            if count == 1:
                square = speeds[picked] ** 2
                drift_places[picked], drift_rates[picked] = moved.places[2] * square, moved.rates[1] * square
    if count > 1:
        for picked, moved in with_velocities(motion, speeds, order=2):
            drift_places[picked], drift_rates[picked] = moved.places[2], moved.rates[1]
    return Influences(
        places=motion.places[0],
        turns=motion.turns,
        angles=np.stack([motion.angle(link) for link in motion.links], axis=1),
        unit_places=unit_places,
        unit_rates=unit_rates,
        drift_places=drift_places,
        drift_rates=drift_rates,
    )


def speeds_of(motion: Motion) -> Reals:
    """The speeds of the drives in a motion, 0 where it has none; (rows, drives)."""
    if motion.speeds is None or not motion.order:
        return np.zeros(motion.drives.shape)
    speeds: Reals = motion.speeds[0]
    return speeds


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class ReducedEquations:
    """M q'' + h = Q over the rows of a motion, in the values of its drives: newtons times the unit of length.

    NaN at limits of the drives.
    """

    motion: Motion
    mass: Reals
    """(rows, drives, drives): M."""
    bias: Reals
    """(rows, drives): h."""
    force: Reals
    """(rows, drives): Q."""
    slope: Reals
    """(rows,): dM/dq of one drive; of several NaN."""
    kinetic: Reals
    """(rows,): at the motion's speeds."""
    potential: Reals
    """(rows,): of weights and springs."""


@door_that_raises(LinkageError)
def reduced_equations(motion: Motion, loads: Loads, *, times: ArrayLike = 0.0) -> ReducedEquations:
    """The equations of motion of a linkage in the values of its drives, over the rows of a motion.

    Args:
        motion: The poses, with speeds if these matter; its accelerations do not.
        loads: What acts, and the masses.
        times: At which loads are taken that depend on the time; (rows,) or one.

    Returns:
        `ReducedEquations`: M (rows, drives, drives), h and Q (rows, drives), dM/dq, energies (rows,).

    Raises:
        LinkageError: loads on points that are not there, masses in a unit of length that is not known.

    Cost:
        The motion once more for each drive.

    Example:
        >>> from gruebler.mechanics.forces import RigidBody
        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> from gruebler.mechanics.kinematics import move
        >>> press = move(SliderCrank(3, 5).linkage(), np.radians([90.0]), speed=1.0)
        >>> loads = Loads(bodies={"slider": RigidBody(2.0)})
        >>> reduced_equations(press, loads).mass.round(9).tolist()  # 2 kg · (3 mm)², in N mm s²
        [[[0.018]]]

    See Also:
        `dynamics`, `Loads`

    Theory:
        docs/theory/dynamics.md
    """
    equations = EquationsOfMotion(motion.linkage, motion.links, loads)
    speeds, influences = speeds_of(motion), influences_of(motion)
    terms = equations.terms(influences, times, motion.drives, speeds)
    slope = np.full(len(motion), np.nan)
    if speeds.shape[1] == 1:
        unit = influences if (speeds == 1).all() else _at_unit_speed(influences, motion)
        slope = 2 * equations.terms(unit, times, motion.drives, np.ones_like(speeds)).bias[:, 0]
    return ReducedEquations(
        motion=motion,
        mass=terms.mass,
        bias=terms.bias,
        force=terms.force,
        slope=slope,
        kinetic=equations.kinetic(influences, speeds),
        potential=equations.potential(influences, motion.drives),
    )


def _at_unit_speed(influences: Influences, motion: Motion) -> Influences:
    drift, rates = np.full_like(influences.drift_places, np.nan), np.full_like(influences.drift_rates, np.nan)
    for picked, moved in with_velocities(motion, np.ones(1), order=2):
        drift[picked], rates[picked] = moved.places[2], moved.rates[1]
    return replace(influences, drift_places=drift, drift_rates=rates)
