"""A linkage that moves freely, at one instant: where it is, what acts on it, how it accelerates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals, angles_of_turns, whole_turns
from gruebler.base.errors import LinkageError
from gruebler.mechanics.dynamics.charts import Blocked, Jets
from gruebler.mechanics.dynamics.coordinates import Coordinates, CoordinateSets
from gruebler.mechanics.dynamics.equations import EquationsOfMotion, Influences
from gruebler.mechanics.dynamics.reduced_series import ReducedSeries
from gruebler.mechanics.forces.acting import MovingLinks
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose


@dataclass(frozen=True, eq=False, kw_only=True)
class Instants:
    """Poses with speeds, a row each."""

    influences: Influences
    moving: MovingLinks
    """With values and speeds of the linkage's own drives."""
    speeds: Reals
    """(rows, coordinates)."""

    def derivatives(self, acceleration: Reals) -> tuple[Complexes, Reals]:
        """(3, rows, links) origins, velocities, accelerations; (2, rows, links) rates.

        Taken at accelerations of the coordinates, (rows, coordinates).
        """
        its, moving = self.influences, self.moving
        places = its.drift_places + np.einsum("rc,crl->rl", acceleration, its.unit_places)
        rates = its.drift_rates + np.einsum("rc,crl->rl", acceleration, its.unit_rates)
        return np.array([its.places, moving.velocities, places]), np.array([moving.rates, rates])

    @property
    def time(self) -> float:
        """Of the first."""
        return float(self.moving.time[0])

    @property
    def angles(self) -> Reals:
        """(links,): of the first, continuous."""
        return np.asarray(self.influences.angles[0])

    @property
    def units(self) -> Jets:
        """Poses and speeds for unit speeds of each coordinate: (2, coordinates, rows, links)."""
        its = self.influences
        places = np.broadcast_to(its.places, its.unit_places.shape)
        return Jets(np.array([places, its.unit_places]), its.turns, its.unit_rates[None])

    @property
    def jets(self) -> Jets:
        """The same of the first."""
        places, turns, rates = self.units
        return Jets(places[:, :, 0], turns[0], rates[:, :, 0])

    def picked(self, rows: Flags) -> Instants:
        """Those that are asked for."""
        return Instants(
            influences=self.influences.picked(rows), moving=self.moving.picked(rows), speeds=self.speeds[rows]
        )


class Kept(NamedTuple):
    """What angles are counted on from."""

    time: float
    angles: tuple[Reals, Reals]
    """(links,), and their rates."""
    drives: tuple[Reals, Reals]
    """(drives,), and their speeds."""


class FreeLinkage:
    """M q'' + h = Q of a linkage in the coordinates of the moment, and the work of what has no potential."""

    def __init__(self, plan: Plan, loads: Loads, start: ReferencePose) -> None:
        self.plan, self.loads = plan, loads
        self.coordinates = self._own = Coordinates(plan, start)
        self.sets = CoordinateSets(self.coordinates)
        self.equations = EquationsOfMotion(plan.linkage, self.coordinates.links, loads)
        self.conservative = self.equations.acting.conservative
        self._lossy = EquationsOfMotion(plan.linkage, self.coordinates.links, _without_potential(loads))
        self._series = dict[Coordinates, ReducedSeries]()
        self.last: Kept | None = None
        self.evaluations = 0

    def instant(self, time: float, q: Reals, v: Reals) -> Instants:
        """The pose and speeds at values of the coordinates. Raises `Blocked` where these do not lead."""
        jets = self.coordinates.jets(q, v)
        several = Jets(jets.places[:, :, None], jets.turns[None], jets.rates[:, :, None])
        influences, moving = self._moving(np.array([time]), several, q[None], v[None])
        return Instants(influences=influences, moving=moving, speeds=v[None])

    def beginning(self, q: Reals, v: Reals) -> tuple[Reals, Reals, Instants]:
        """Values and speeds of the coordinates with which a motion starts: others next to a limit of the drive."""
        try:
            return q, v, self.instant(0.0, q, v)
        except Blocked:
            charts = self.coordinates.charts
            other = charts and self.sets.exchanged(self.coordinates, charts.walked(float(q[0])), v)
            if not other:
                raise
        self.coordinates, values, speeds = other
        moving = self.instant(0.0, values, speeds).moving
        self.last = Kept(0.0, (moving.angles[0], moving.rates[0]), (q, v))  # that the drive is counted on from q
        return values, speeds, self.instant(0.0, values, speeds)

    def instants(self, times: Reals, q: Reals, v: Reals) -> Instants:
        """Those at increasing times after the one that was kept last; q and v are (rows, coordinates)."""
        influences, moving = self._moving(times, self.coordinates.jets_at(q, v), q, v)
        return Instants(influences=influences, moving=moving, speeds=v)

    def keep(self, instants: Instants) -> None:
        """Angles near the last of these instants are counted on from it."""
        moving = instants.moving
        angles, drives = (moving.angles[-1], moving.rates[-1]), (moving.drives[-1], moving.speeds[-1])
        self.last = Kept(float(moving.time[-1]), angles, drives)

    def _moving(self, times: Reals, jets: Jets, q: Reals, v: Reals) -> tuple[Influences, MovingLinks]:
        """At poses (3, speeds, rows, links) for unit speeds of each drive, and of several for their speeds at the end.

        Angles and drives go on from those kept: with the whole turns that the rates make likely.
        """
        count, last = self.coordinates.count, self.last
        places, turns, rates = jets
        square = v**2 if count == 1 else 1.0
        influences = Influences(
            places=places[0, 0],
            turns=turns,
            angles=angles_of_turns(turns),
            unit_places=places[1, :count],
            unit_rates=rates[0, :count],
            drift_places=places[2, -1] * square,
            drift_rates=rates[1, -1] * square,
        )
        moving = influences.moving(times, q, v)
        if last is not None:
            angles = _continued(times, moving.angles, moving.rates, last.time, last.angles)
            influences, moving = replace(influences, angles=angles), replace(moving, angles=angles)
        if self.coordinates is not self._own:
            freedoms = self.sets.drives
            moved = Jets(np.array([moving.places, moving.velocities])[:, None], turns, moving.rates[None, None])
            speeds = np.stack([freedom.speeds(moved)[0] for freedom in freedoms], axis=1)
            drives = np.stack([freedom.value(moved) for freedom in freedoms], axis=1)
            if last is not None:
                turning = np.array([freedom.drive.turning for freedom in freedoms])
                drives = _continued(times, drives, speeds, last.time, last.drives, turning)
            moving = replace(moving, drives=drives, speeds=speeds)
        return influences, moving

    # --- what acts -----------------------------------------------------------------------------------

    def rates(self, time: float, q: Reals, v: Reals) -> tuple[Reals, float]:
        """Q'' of the coordinates and the power of what has no potential; from series where these are known."""
        series = self.series
        reduced = None if series is None else series.at(float(q[0]), float(v[0]))
        if reduced is None:
            now = self.instant(time, q, v)
            return self.acceleration(now)[0], self.power(now)
        mass, force, power = reduced
        self.evaluations += 1
        if not mass:
            raise _without_mass()
        return np.array([force / mass]), power * float(v[0])

    @property
    def series(self) -> ReducedSeries | None:
        """Those of one freedom whose forces depend on the pose alone, and linearly on the speed."""
        charts = self.coordinates.charts
        if charts is None or not self.equations.acting.of_the_pose:
            return None
        if self.coordinates not in self._series:
            self._series[self.coordinates] = ReducedSeries(charts, self.equations, self._lossy, self.sets.is_calm)
        return self._series[self.coordinates]

    def acceleration(self, instants: Instants) -> Reals:
        """Q'' of the coordinates; (rows, coordinates)."""
        self.evaluations += len(instants.speeds)
        mass, bias = self.equations.inertia(instants.influences, instants.moving)
        excess = self.force(instants) - bias
        if excess.shape[1] == 1:
            return np.asarray(excess / mass[:, 0])
        return np.asarray(np.linalg.solve(mass, excess[..., None])[..., 0])

    def force(self, instants: Instants) -> Reals:
        """Q of all loads and motors; (rows, coordinates)."""
        return np.asarray(self.equations.generalised(instants.influences, instants.moving) + self.motors(instants))

    def motors(self, instants: Instants) -> Reals:
        """What motors do in the coordinates; (rows, coordinates)."""
        if not self.loads.motors:
            return np.zeros(instants.speeds.shape)
        efforts = self.equations.acting.motor_efforts(instants.moving)
        if self.coordinates is self._own:
            return np.asarray(efforts)
        speeds = np.array([freedom.speeds(instants.units) for freedom in self.sets.drives])
        return np.asarray(np.einsum("rd,dcr->rc", efforts, speeds))

    def power(self, instant: Instants) -> float:
        """What loads and motors without potential, and dampers, give in a second."""
        if self.conservative:
            return 0.0
        force = self._lossy.generalised(instant.influences, instant.moving) + self.motors(instant)
        return float(force[0] @ instant.speeds[0])

    def own_acceleration(self, instants: Instants, acceleration: Reals) -> Reals:
        """Q'' of the linkage's own drives, from places and rates; (rows, drives)."""
        places, rates = instants.derivatives(acceleration)
        turns = instants.influences.turns
        return np.stack([freedom.derivative(places, turns, rates, 2) for freedom in self.sets.drives], axis=1)

    def energies(self, instants: Instants) -> tuple[Reals, Reals]:
        """Kinetic and potential; (rows,) each."""
        kinetic = self.equations.kinetic(instants.influences, instants.speeds)
        return kinetic, self.equations.potential(instants.influences, instants.moving.drives)

    def check(self, instant: Instants) -> None:
        """`LinkageError` unless every coordinate moves something that has mass."""
        mass = self.equations.inertia(instant.influences, instant.moving)[0][0]
        if not np.linalg.eigvalsh(mass)[0] > 1e-14 * np.abs(mass).max():
            raise _without_mass()


def _continued(
    times: Reals, values: Reals, rates: Reals, begin: float, before: tuple[Reals, Reals], turning: Flags | float = 1.0
) -> Reals:
    """Angles (rows, ...) with those whole turns that the rates make likely, on from angles and rates at a time."""
    first, rate = before
    steps = np.diff(times, prepend=begin)[:, None]
    means = (rates + np.concatenate([rate[None], rates[:-1]])) / 2
    moved = np.diff(values, axis=0, prepend=first[None])
    whole = turning * np.round((steps * means - moved) / (2 * np.pi))
    return np.asarray(values + 2 * np.pi * np.cumsum(whole, axis=0))


def motion_of(free: FreeLinkage, now: Instants) -> Motion:
    """Instants as rows of a motion, for joint forces; its assembly mode is not told."""
    acceleration, moving, rows = free.acceleration(now), now.moving, len(now.speeds)
    places, rates = now.derivatives(acceleration)
    return Motion(
        linkage=free.plan.linkage,
        plan=free.plan,
        drives=moving.drives,
        places=places,
        turns=moving.turns,
        rates=rates,
        whole=whole_turns(moving.angles, moving.turns),
        roots=np.zeros((rows, len(free.plan.dyads))),
        unknowns=np.zeros((rows, free.plan.unknowns)),
        stop=None,
        speeds=np.array([moving.speeds, free.own_acceleration(now, acceleration)]),
    )


def _without_potential(loads: Loads) -> Loads:
    """What loads do beside weights and the pull of springs: forces, moments, dampers."""
    return Loads(
        forces=loads.forces,
        moments=loads.moments,
        gravity=(0.0, 0.0),
        springs=tuple(replace(s, stiffness=0.0, preload=0.0, law=None) for s in loads.springs if s.damping),
        torsion_springs=tuple(
            replace(s, stiffness=0.0, preload=0.0, law=None) for s in loads.torsion_springs if s.damping
        ),
    )


def _without_mass() -> LinkageError:
    return LinkageError("a free motion needs masses that each drive moves: give bodies or masses in the loads")
