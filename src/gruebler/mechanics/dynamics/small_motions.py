"""Positions in which a linkage stays at rest, whether it comes back to them, and how fast it swings about them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief, explained
from gruebler.base.text import message
from gruebler.mechanics.dynamics.charts import Blocked
from gruebler.mechanics.dynamics.equations import EquationsOfMotion, Influences
from gruebler.mechanics.dynamics.free_linkage import FreeLinkage
from gruebler.mechanics.dynamics.starts import starting_pose
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.kinematics.circuits import circuit
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.kinematics.poses import Poses
from gruebler.mechanics.kinematics.solve import cached_plan
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import Branch
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage

_OFFSETS = np.array([4, 3, 2, 1, -1, -2, -3, -4.0])
_SLOPE = np.array([-3, 32, -168, 672, -672, 168, -32, 3]) / 840  # of values at these offsets, for the slope between
_STEP = 0.02  # radians, or sizes of the linkage
_NONE = 1e-11  # of the largest effort of any single load: less is none
_GROWS = 1e-9  # of the largest eigenvalue: a part that grows by less is rounding

_STABLE = message("{values}: stable, {frequency:n} Hz")
_CREEPS = message("{values}: stable, without swinging")
_UNSTABLE = message("{values}: unstable")
_EVERYWHERE = message("Every position is an equilibrium.")
_NOWHERE = message("There is no position of equilibrium.")


@explained
@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Linearised:
    """Small motions about a position: M x'' + C x' + K x = Q, in newtons times the linkage's unit."""

    linkage: Linkage
    drives: Reals
    """(drives,): the position."""
    mass: Reals
    """M, (coordinates, coordinates)."""
    damping: Reals
    """C: less the slope of the generalised forces over the speeds."""
    stiffness: Reals
    """K: less the slope of the generalised forces over the coordinates."""
    force: Reals
    """Q, which is 0 in an equilibrium; (coordinates,)."""
    eigenvalues: Complexes
    """(2 coordinates,), by their size: x = exp(eigenvalue t)."""

    @property
    def stable(self) -> bool:
        """Whether no small motion grows."""
        return bool((self.eigenvalues.real <= _GROWS * np.abs(self.eigenvalues).max()).all()) and self._stiff

    @property
    def _stiff(self) -> bool:
        return bool(np.abs(self.eigenvalues).min() > 0)

    @property
    def frequencies(self) -> Reals:
        """In hertz, of the motions that swing, from below."""
        swinging = self.eigenvalues.imag[self.eigenvalues.imag > _GROWS * np.abs(self.eigenvalues).max()]
        return np.sort(swinging) / (2 * np.pi)

    def explain(self, lang: str = "en") -> str:
        """The position, whether it is stable, its frequencies: a line in English or German (``de``)."""
        values = drive_values(self.linkage, tuple(self.drives.tolist()))
        if not self.stable:
            return _UNSTABLE.filled(values=values).in_language(lang)
        if not len(self.frequencies):
            return _CREEPS.filled(values=values).in_language(lang)
        return _STABLE.filled(values=values, frequency=float(self.frequencies[0])).in_language(lang)


@explained
@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Equilibria:
    """All equilibria of a linkage with one freedom on its circuit, in the order in which the circuit meets them."""

    positions: tuple[Linearised, ...]
    arcs: tuple[float, ...]
    """Where they lie on the circuit."""
    everywhere: bool
    """Whether the loads balance each other in every position; then none is listed."""

    def __len__(self) -> int:
        return len(self.positions)

    def __iter__(self) -> Iterator[Linearised]:
        return iter(self.positions)

    def __getitem__(self, number: int) -> Linearised:
        return self.positions[number]

    def explain(self, lang: str = "en") -> str:
        """A line for each, in English or German (``de``)."""
        if not self.positions:
            return (_EVERYWHERE if self.everywhere else _NOWHERE).in_language(lang)
        return "\n".join(position.explain(lang) for position in self.positions)


@door_that_raises(LinkageError)
def equilibria(linkage: LinkageLike, loads: Loads, *, branch: Branch = None, at: float | None = None) -> Equilibria:
    """All positions of a linkage with one freedom in which loads, weights, springs and motors balance.

    They are sought along the whole circuit, limits of the drive and change points among them. Torsion springs are
    taken as wound in the first lap.

    Args:
        linkage: With one drive.
        loads: What acts; laws of the time are taken at 0.
        branch: The assembly mode by which the circuit is chosen, as for `circuit`.
        at: The drive value at which it is, in radians or the linkage's unit.

    Returns:
        `Equilibria`: for each position its drive value, M, C, K and eigenvalues.

    Raises:
        LinkageError: Drives that do not fix the motion, several drives, loads on points that are not there.

    Cost:
        The circuit, then some 50 us for each of its samples.

    Example:
        >>> from gruebler.mechanics.forces import RigidBody
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> loads = Loads(bodies={"coupler": RigidBody(0.5, (35, 0), 200.0)})
        >>> print(equilibria(FourBar(25, 70, 40, 70), loads))
        R(frame-crank) = 88.58°: unstable
        R(frame-crank) = 251.6°: stable, 3.814 Hz

    See Also:
        `linearised`, `simulate`, `circuit`

    Theory:
        docs/theory/free-motion.md
    """
    given = as_linkage(linkage)
    if len(given.mechanism.drives) != 1:
        raise LinkageError("equilibria are sought of linkages with one drive; of several `linearised` takes a position")
    curve = circuit(given, branch=branch, at=at)
    balance = _Balance(given, curve.at([curve.start]).links, loads)
    if not np.abs(balance.efforts(curve.samples)).max() > _NONE * balance.largest(curve.samples):
        return Equilibria(positions=(), arcs=(), everywhere=True)

    def beside(poses: Poses) -> Poses:
        arcs = (poses.arcs[:, None] + _STEP * _OFFSETS).ravel()
        return curve.at(arcs if curve.closed else np.clip(arcs, 0.0, curve.length))

    def quantity(poses: Poses, order: int) -> Reals:
        if order == 0:
            return balance.efforts(poses)
        return np.asarray(balance.efforts(beside(poses)).reshape(-1, len(_OFFSETS)) @ _SLOPE / _STEP)

    arcs, positions = curve.roots(quantity), []
    for arc in arcs:
        there = curve.at([arc])
        length = _length(beside(there), there.size)  # of the curve by its arc, which is known to some 1e-6 only
        stiffness = -quantity(there, 1)[:, None] / length
        damping = -balance.slope_over_speed(there)
        positions.append(
            _linearised(given, there.drive(), balance.mass(there), damping, stiffness, balance.efforts(there))
        )
    return Equilibria(positions=tuple(positions), arcs=arcs, everywhere=False)


class _Balance:
    """Generalised forces along a circuit, for a unit of its arc."""

    def __init__(self, linkage: Linkage, links: tuple[str, ...], loads: Loads) -> None:
        self.equations = EquationsOfMotion(linkage, links, loads)

    def efforts(self, poses: Poses, speed: float = 0.0) -> Reals:
        """At a speed along the arc; (rows,)."""
        influences, drive, slope = _influences(poses), poses.drive()[:, None], poses.drive(1)[:, None]
        moving = replace(influences.moving(0.0, drive, np.full_like(drive, speed)), speeds=speed * slope)
        effort = self.equations.generalised(influences, moving)[:, 0]
        if self.equations.loads.motors:
            effort = effort + (self.equations.acting.motor_efforts(moving) * slope)[:, 0]
        return effort

    def largest(self, poses: Poses) -> float:
        """The largest effort of a single force, weight or moment at any pose."""
        influences, drive = _influences(poses), poses.drive()[:, None]
        moving = influences.moving(0.0, drive, np.zeros_like(drive))
        acting = self.equations.acting
        forces = np.abs(acting.forces_at(moving)) * np.abs(influences.unit_places[0]).max()
        turned = np.abs(acting.moments_on(moving)) * np.abs(influences.unit_rates[0]).max()
        return max(float(forces.max(initial=0.0)), float(turned.max(initial=0.0)))

    def mass(self, poses: Poses) -> Reals:
        influences, drive = _influences(poses), poses.drive()[:, None]
        return np.asarray(self.equations.inertia(influences, influences.moving(0.0, drive, 0 * drive))[0][0])

    def slope_over_speed(self, poses: Poses) -> Reals:
        efforts = np.array([self.efforts(poses, _STEP * k) for k in _OFFSETS])
        return np.asarray(_SLOPE @ efforts / _STEP)[:, None]


def _length(beside: Poses, size: float) -> float:
    """How far poses move for a unit of their arcs, from eight poses beside one."""
    ways = np.hstack([beside.places[0].real / size, beside.places[0].imag / size, beside.angles])
    return float(np.linalg.norm(_SLOPE @ ways) / _STEP)


def _influences(poses: Poses) -> Influences:
    return Influences(
        places=poses.places[0],
        turns=poses.turns,
        angles=poses.angles,
        unit_places=poses.places[1:],
        unit_rates=poses.rates,
        drift_places=np.zeros_like(poses.places[0]),
        drift_rates=np.zeros_like(poses.angles),
    )


@door_that_raises(LinkageError)
def linearised(linkage: LinkageLike, loads: Loads, *, branch: Branch = None, at: ArrayLike | None = None) -> Linearised:
    """Small motions of a linkage about a position: its mass, damping and stiffness matrices and their eigenvalues.

    Args:
        linkage: With one drive or several.
        loads: What acts, and the masses; laws of the time are taken at 0.
        branch: The assembly mode; without it the one of the reference pose.
        at: The drives there, in radians or the linkage's unit; without it those of the reference pose. Eigenvalues mean
            something in an equilibrium: see `Linearised.force`.

    Returns:
        `Linearised`: M, C, K (coordinates, coordinates), Q, and the eigenvalues (2 coordinates,).

    Raises:
        LinkageError: Drives that do not fix the motion, nothing that has mass, a position that cannot be assembled.

    Cost:
        16 evaluations of the forces for each drive.

    Example:
        >>> from gruebler.mechanics.forces import RigidBody
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> loads = Loads(bodies={"coupler": RigidBody(0.5, (35, 0), 200.0)})
        >>> hanging = equilibria(FourBar(25, 70, 40, 70), loads)[1]
        >>> linearised(FourBar(25, 70, 40, 70), loads, branch="+", at=hanging.drives).frequencies.round(4).tolist()
        [3.8139]

    See Also:
        `equilibria`, `simulate`

    Theory:
        docs/theory/free-motion.md
    """
    solving = cached_plan(as_linkage(linkage))
    drives, start = starting_pose(solving, branch, at)
    free = FreeLinkage(solving, loads, start)
    still = np.zeros(len(drives))
    try:
        start_instant = free.instant(0.0, drives, still)
        free.keep(start_instant)
        other = free.sets.exchanged(free.coordinates, start_instant.jets, still)
        q = drives
        if other is not None:
            free.coordinates, q, _ = other
        here = free.instant(0.0, q, still)
        free.check(here)
        scale = free.coordinates.scale
        stiffness = -_slopes(lambda x: free.force(free.instant(0.0, x, still))[0], q, scale)
        damping = -_slopes(lambda v: free.force(free.instant(0.0, q, v))[0], still, scale)
    except Blocked:
        values = drive_values(solving.linkage, tuple(drives.tolist()))
        raise LinkageError(
            "at {values} the linkage branches, so it has no small motions there", values=values
        ) from None
    mass = free.equations.inertia(here.influences, here.moving)[0][0]
    return _linearised(solving.linkage, drives, mass, damping, stiffness, free.force(here)[0])


def _slopes(function: Callable[[Reals], Reals], at: Reals, scale: Reals) -> Reals:
    """The derivative matrix, column by column, from eight values each: exact for polynomials of degree 8."""
    columns = []
    for k, size in enumerate(scale):
        step = np.eye(len(at))[k] * size * _STEP
        columns.append(_SLOPE @ np.array([function(at + offset * step) for offset in _OFFSETS]) / (size * _STEP))
    return np.stack(columns, axis=1)


def _linearised(
    linkage: Linkage, drives: Reals, mass: Reals, damping: Reals, stiffness: Reals, force: Reals
) -> Linearised:
    n = len(mass)
    system = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(mass, np.hstack([stiffness, damping]))]])
    values = np.linalg.eigvals(system).astype(np.complex128)
    return Linearised(
        linkage=linkage,
        drives=drives,
        mass=mass,
        damping=damping,
        stiffness=stiffness,
        force=force,
        eigenvalues=values[np.lexsort((values.imag, np.abs(values).round(12)))],
    )
