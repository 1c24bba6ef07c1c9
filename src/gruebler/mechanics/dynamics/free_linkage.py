"""A linkage that moves freely, at one instant: where it is, what acts on it, how it accelerates."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.dynamics.charts import Jets
from gruebler.mechanics.dynamics.coordinates import Coordinates, CoordinateSets
from gruebler.mechanics.dynamics.equations import EquationsOfMotion, Influences
from gruebler.mechanics.dynamics.reduced_series import ReducedSeries
from gruebler.mechanics.forces.acting import MovingLinks
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.kinematics.plan import Plan
from gruebler.mechanics.kinematics.reference_pose import ReferencePose


@dataclass(frozen=True, eq=False, kw_only=True)
class Instant:
    """A pose with speeds."""

    time: float
    jets: Jets
    influences: Influences
    moving: MovingLinks
    """With values and speeds of the linkage's own drives."""
    speeds: Reals
    """(coordinates,)."""

    @property
    def angles(self) -> Reals:
        """(links,): continuous."""
        return np.asarray(self.influences.angles[0])

    def derivatives(self, acceleration: Reals) -> tuple[Complexes, Reals]:
        """(3, links) origins, velocities, accelerations; (2, links) rates, at an acceleration of the coordinates."""
        its, moving = self.influences, self.moving
        places = [its.places[0], moving.velocities[0], its.drift_places[0] + acceleration @ its.unit_places[:, 0]]
        rates = [moving.rates[0], its.drift_rates[0] + acceleration @ its.unit_rates[:, 0]]
        return np.array(places), np.array(rates)


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
        self.last: Instant | None = None
        self.evaluations = 0

    def instant(self, time: float, q: Reals, v: Reals) -> Instant:
        """The pose and speeds at values of the coordinates. Raises `Blocked` where these do not lead."""
        jets = self.coordinates.jets(q, v)
        count = self.coordinates.count
        rates = jets.rates[0, :count]
        if count == 1:
            square = float(v[0]) ** 2
            drift_places, drift_rates = jets.places[2] * square, jets.rates[1] * square
        else:
            drift_places, drift_rates = jets.places[2, -1:], jets.rates[1, -1:]
        influences = Influences(
            places=jets.places[0, :1],
            turns=jets.turns[None],
            angles=self._continuous(time, np.angle(jets.turns), v @ rates)[None],
            unit_places=jets.places[1, :count, None],
            unit_rates=rates[:, None],
            drift_places=drift_places,
            drift_rates=drift_rates,
        )
        moving = influences.moving(time, q[None], v[None])
        if self.coordinates is not self._own:
            speeds = np.array([freedom.speeds(jets)[:count] @ v for freedom in self.sets.drives])
            moving = replace(moving, drives=self._drives(time, jets, speeds)[None], speeds=speeds[None])
        return Instant(time=time, jets=jets, influences=influences, moving=moving, speeds=v)

    def keep(self, instant: Instant) -> None:
        """Angles near this instant are counted on from it."""
        self.last = instant

    def _continuous(self, time: float, angles: Reals, rates: Reals) -> Reals:
        """The angles with those whole turns that the rates since the last instant kept make likely."""
        if self.last is None:
            return angles
        last = self.last
        likely = last.angles + (time - last.time) * (last.moving.rates[0] + rates) / 2
        return np.asarray(angles + 2 * np.pi * np.round((likely - angles) / (2 * np.pi)))

    def _drives(self, time: float, jets: Jets, speeds: Reals) -> Reals:
        """The values of the linkage's own drives, where others are coordinates."""
        values = np.array([freedom.value(jets) for freedom in self.sets.drives])
        if self.last is not None:
            turns = np.array([freedom.drive.turning for freedom in self.sets.drives])
            last = self.last
            likely = last.moving.drives[0] + (time - last.time) * (last.moving.speeds[0] + speeds) / 2
            values = values + turns * 2 * np.pi * np.round((likely - values) / (2 * np.pi))
        return values

    # --- what acts -----------------------------------------------------------------------------------

    def rates(self, time: float, q: Reals, v: Reals) -> tuple[Reals, float]:
        """Q'' of the coordinates and the power of what has no potential; from series where these are known."""
        series = self.series
        reduced = None if series is None else series.at(float(q[0]), float(v[0]))
        if reduced is None:
            now = self.instant(time, q, v)
            return self.acceleration(now), self.power(now)
        mass, force, power = reduced
        self.evaluations += 1
        return np.array([force / mass]), power * float(v[0])

    @property
    def series(self) -> ReducedSeries | None:
        """Those of one freedom whose forces depend on the pose alone, and linearly on the speed."""
        charts = self.coordinates.charts
        if charts is None or not self.equations.acting.of_the_pose:
            return None
        if self.coordinates not in self._series:
            self._series[self.coordinates] = ReducedSeries(charts, self.equations, self._lossy)
        return self._series[self.coordinates]

    def acceleration(self, instant: Instant) -> Reals:
        """Q'' of the coordinates."""
        self.evaluations += 1
        mass, bias = self.equations.inertia(instant.influences, instant.moving)
        force = self.force(instant)
        if len(mass[0]) == 1:
            return np.asarray((force - bias[0]) / mass[0, 0])
        return np.asarray(np.linalg.solve(mass[0], force - bias[0]))

    def force(self, instant: Instant) -> Reals:
        """Q of all loads and motors; (coordinates,)."""
        return np.asarray(self.equations.generalised(instant.influences, instant.moving)[0] + self.motors(instant))

    def motors(self, instant: Instant) -> Reals:
        """What motors do in the coordinates; (coordinates,)."""
        if not self.loads.motors:
            return np.zeros(self.coordinates.count)
        efforts = self.equations.acting.motor_efforts(instant.moving)[0]
        if self.coordinates is self._own:
            return np.asarray(efforts)
        count = self.coordinates.count
        return np.asarray(efforts @ np.array([f.speeds(instant.jets)[:count] for f in self.sets.drives]))

    def power(self, instant: Instant) -> float:
        """What loads and motors without potential, and dampers, give in a second."""
        if self.conservative:
            return 0.0
        force = self._lossy.generalised(instant.influences, instant.moving)[0] + self.motors(instant)
        return float(force @ instant.speeds)

    def own_acceleration(self, instant: Instant, acceleration: Reals) -> Reals:
        """Q'' of the linkage's own drives, from places and rates; (drives,)."""
        places, rates = instant.derivatives(acceleration)
        return np.array([freedom.derivative(places, instant.jets.turns, rates, 2) for freedom in self.sets.drives])

    def energies(self, instant: Instant) -> tuple[float, float]:
        """Kinetic and potential."""
        kinetic = self.equations.kinetic(instant.influences, instant.speeds[None])
        return float(kinetic[0]), float(self.equations.potential(instant.influences, instant.moving.drives)[0])

    def check(self, instant: Instant) -> None:
        """`LinkageError` unless every coordinate moves something that has mass."""
        mass = self.equations.inertia(instant.influences, instant.moving)[0][0]
        if not np.linalg.eigvalsh(mass)[0] > 1e-14 * np.abs(mass).max():
            raise LinkageError("a free motion needs masses that each drive moves: give bodies or masses in the loads")


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
