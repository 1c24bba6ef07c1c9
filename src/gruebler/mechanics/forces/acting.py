"""Loads on the links of a linkage in given rows: what acts where, evaluated from poses and speeds."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gruebler.base.arrays import Complexes, Flags, Reals, compared_by_value
from gruebler.base.errors import LinkageError, unknown
from gruebler.base.text import Message, message
from gruebler.mechanics.forces.laws import Law, LoadFormula, State
from gruebler.mechanics.forces.loads import Loads
from gruebler.mechanics.forces.springs import Spring, TorsionSpring, check_between_links
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.mechanics.linkages.points import PointLike, place_of, point_name

Rows = NDArray[np.int64]
_LARGEST = 1e100


@compared_by_value
@dataclass(frozen=True, eq=False)
class Wrench:
    """A force on a link at each row, and a moment beside it."""

    place: LinkPoint
    force: Complexes
    """(rows,)."""
    moment: Reals
    """(rows,): a free moment."""


@compared_by_value
@dataclass(frozen=True, eq=False, kw_only=True)
class MovingLinks:
    """The links of a linkage in rows, as loads see them: (rows, links), in the order of the linkage as it is solved."""

    places: Complexes
    turns: Complexes
    angles: Reals
    """Continuous, in radians."""
    velocities: Complexes
    """Of the origins."""
    rates: Reals
    time: Reals
    """(rows,)."""
    drives: Reals
    """(rows, drives)."""
    speeds: Reals
    """(rows, drives)."""

    def at(self, link: int, arm: complex) -> tuple[Complexes, Complexes]:
        """Place and velocity of a point of a link; (rows,) each."""
        turned = self.turns[:, link] * arm
        return self.places[:, link] + turned, self.velocities[:, link] + 1j * self.rates[:, link] * turned

    def picked(self, rows: Flags) -> MovingLinks:
        """Those rows that are asked for."""
        return MovingLinks(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})

    def state(self, link: int, arm: complex) -> State:
        """What a load at a point of a link may depend on."""
        at, moving = self.at(link, arm)
        return State(
            time=self.time,
            drives=self.drives,
            speeds=self.speeds,
            x=at.real,
            y=at.imag,
            vx=moving.real,
            vy=moving.imag,
            angle=self.angles[:, link],
            omega=self.rates[:, link],
        )


def moving_links(motion: Motion, time: ArrayLike = 0.0, *, angles: bool = True) -> MovingLinks:
    """The links of a motion; without velocities all stand still. Angles that nobody asks for are NaN."""
    rows, links = motion.turns.shape
    known = [motion.angle(link) for link in motion.links] if angles else [np.full(rows, np.nan)] * links
    speeds = motion.drives * 0.0 if motion.speeds is None or not motion.order else motion.speeds[0]
    return MovingLinks(
        places=motion.places[0],
        turns=motion.turns,
        angles=np.stack(known, axis=1),
        velocities=motion.places[1] if motion.order else np.zeros((rows, links), np.complex128),
        rates=motion.rates[0] if motion.order else np.zeros((rows, links)),
        time=np.broadcast_to(np.asarray(time, np.float64), (rows,)),
        drives=motion.drives,
        speeds=speeds,
    )


@dataclass(frozen=True, eq=False)
class ActingLoads:
    """Loads with the numbers of their links: `forces_at` and `moments_on` tell what acts in given rows."""

    linkage: Linkage
    """Which has the points that loads name."""
    links: tuple[str, ...]
    """Of the linkage as it is solved, in their order."""
    loads: Loads

    # --- where ---------------------------------------------------------------------------------------

    @cached_property
    def spots(self) -> tuple[LinkPoint, ...]:
        """Where forces act: at forces, masses, the centres of bodies, the two ends of each spring, in this order."""
        loads = self.loads
        for number, spring in enumerate(loads.springs):
            check_between_links(self.linkage, spring, f"springs[{number}]")
        named = [*(self._place(name) for name in loads.forces), *(self._place(name) for name in loads.masses)]
        return (*named, *self._centres, *(self._place(end) for spring in loads.springs for end in spring.between))

    @cached_property
    def of(self) -> NDArray[np.int64]:
        """(spots,): the links of the spots."""
        return np.array([self.links.index(spot.link) for spot in self.spots], np.int64)

    @cached_property
    def arms(self) -> Complexes:
        """(spots,): their places in the links' coordinates."""
        return np.array([complex(spot.x, spot.y) for spot in self.spots], np.complex128)

    @cached_property
    def heavy(self) -> slice:
        """The spots that have mass."""
        first = len(self.loads.forces)
        return slice(first, first + len(self.loads.masses) + len(self.loads.bodies))

    @cached_property
    def inertias(self) -> Reals:
        """(links,): the moments of inertia of the bodies about their centres."""
        inertias = np.zeros(len(self.links))
        for link, body in self.loads.bodies.items():
            inertias[self._link(link, message("a body is a link"))] = body.inertia
        return inertias

    def masses(self, rows: int) -> Reals:
        """(rows, heavy spots)."""
        loads, columns = self.loads, []
        for name, given in loads.masses.items():
            mass = _over_rows(message("the mass at {point}", point=_point_text(name)), given, (rows,))
            if (mass < 0).any():
                raise LinkageError(
                    "the mass at {point} is negative: {mass:g}", point=_point_text(name), mass=mass.min()
                )
            columns.append(mass)
        columns += [np.full(rows, body.mass) for body in loads.bodies.values()]
        return np.stack(columns, axis=1) if columns else np.zeros((rows, 0))

    # --- how much ------------------------------------------------------------------------------------

    def forces_at(self, moving: MovingLinks) -> Complexes:
        """(rows, spots): forces, weights, and what springs and dampers pull."""
        loads, rows = self.loads, len(moving.time)
        forces = np.zeros((rows, len(self.spots)), np.complex128)
        for k, (name, given) in enumerate(loads.forces.items()):
            forces[:, k] = self._force(moving, k, name, given)
        gravity = _over_rows(message("gravity"), loads.gravity, (2,))
        forces[:, self.heavy] = self.masses(rows) * complex(*gravity)
        for k, spring in enumerate(loads.springs):
            first = self.heavy.stop + 2 * k
            pull = self._pull(spring, moving, first)
            forces[:, first], forces[:, first + 1] = pull, -pull
        return forces

    def moments_on(self, moving: MovingLinks) -> Reals:
        """(rows, links): moments given, and those of torsion springs."""
        moments = np.zeros((len(moving.time), len(self.links)))
        for link, given in self.loads.moments.items():
            k = self._link(link, message("a moment acts on a link"))
            moments[:, k] += self._amount(message("the moment on {link!r}", link=link), given, moving, k, 0j)
        for spring in self.loads.torsion_springs:
            first, second = self._ends(spring)
            angle = moving.angles[:, second] - moving.angles[:, first]
            moment = spring.moment(angle, moving.rates[:, second] - moving.rates[:, first])
            moments[:, second] -= moment
            moments[:, first] += moment
        return moments

    def motor_efforts(self, moving: MovingLinks) -> Reals:
        """(rows, drives): what motors give at the speeds of their drives."""
        efforts = np.zeros(moving.speeds.shape)
        for joint, law in self.loads.motors.items():
            k, state = self._of_motor(joint, moving)
            efforts[:, k] += _of_law(message("the motor of {joint}", joint=joint), law, state)
        return efforts

    def _of_motor(self, joint: str, moving: MovingLinks) -> tuple[int, State]:
        """The drive that a motor drives, and what its law may depend on."""
        mechanism = self.linkage.mechanism
        number = mechanism.chain.joint_number(joint, error=LinkageError)
        driven = [drive.joint for drive in mechanism.drives]
        if number not in driven:
            raise LinkageError("{joint} has a motor, but is not driven", joint=mechanism.chain.joint_title(number))
        k, none = driven.index(number), moving.time * 0
        return k, State(
            time=moving.time,
            drives=moving.drives[:, k:],
            speeds=moving.speeds[:, k:],
            x=none,
            y=none,
            vx=none,
            vy=none,
            angle=moving.drives[:, k],
            omega=moving.speeds[:, k],
        )

    def potential(self, moving: MovingLinks) -> Reals:
        """(rows,): the energy of weights and springs; that of other loads is not counted."""
        rows = len(moving.time)
        heights = np.stack(
            [moving.at(self.of[k], self.arms[k])[0] for k in range(len(self.spots))] or [np.zeros(rows, np.complex128)]
        )
        weights = self.masses(rows).T * complex(*self.loads.gravity)
        energy = -(np.conj(weights) * heights[self.heavy]).real.sum(axis=0) if self.spots else np.zeros(rows)
        for k, spring in enumerate(self.loads.springs):
            first = self.heavy.stop + 2 * k
            energy = energy + spring.energy(np.abs(heights[first + 1] - heights[first]))
        for turning in self.loads.torsion_springs:
            first, second = self._ends(turning)
            energy = energy + turning.energy(moving.angles[:, second] - moving.angles[:, first])
        return np.asarray(energy, np.float64)

    @property
    def conservative(self) -> bool:
        """Whether all that acts has a potential: weights and springs without damping."""
        loads = self.loads
        damped = any(spring.damping for spring in loads.springs) or any(s.damping for s in loads.torsion_springs)
        return not (damped or loads.forces or loads.moments or loads.motors)

    @cached_property
    def of_the_pose(self) -> bool:
        """Whether all that acts depends on places alone, and of dampers linearly on velocities: no law, no motor.

        Torsion springs are left out, since they count whole turns.
        """
        loads = self.loads
        parts = [
            part for given in loads.forces.values() for part in (given if isinstance(given, tuple | list) else [given])
        ]
        return not (loads.motors or loads.torsion_springs or any(map(_varies, [*parts, *loads.moments.values()])))

    def laws(self, moving: MovingLinks) -> Iterator[tuple[Message, Any, State]]:
        """The laws of forces, moments, motors: the name of the load, the law, and what it depends on now."""
        for k, (name, given) in enumerate(self.loads.forces.items()):
            for part in given if isinstance(given, tuple | list) else (given,):
                what = message("the force at {point}", point=_point_text(name))
                yield what, part, moving.state(int(self.of[k]), complex(self.arms[k]))
        for link, given in self.loads.moments.items():
            yield message("the moment on {link!r}", link=link), given, moving.state(self.links.index(link), 0j)
        for joint, law in self.loads.motors.items():
            yield message("the motor of {joint}", joint=joint), law, self._of_motor(joint, moving)[1]

    # --- parts ---------------------------------------------------------------------------------------

    @cached_property
    def _centres(self) -> tuple[LinkPoint, ...]:
        for link in self.loads.bodies:
            self._link(link, message("a body is a link"))
        return tuple(LinkPoint(link, *body.centre) for link, body in self.loads.bodies.items())

    def _place(self, name: PointLike) -> LinkPoint:
        place = place_of(self.linkage, name)
        if place.link not in self.links:
            raise LinkageError(
                "a force acts on a link, but there is no link {link!r}; they are {links}",
                link=place.link,
                links=", ".join(self.links),
            )
        return place

    def _link(self, link: str, why: Message) -> int:
        links = self.linkage.mechanism.chain.links
        if link not in links:
            raise LinkageError(
                "{why}, but there is no link {word!r}{suggestion}; the links are {known}",
                why=why,
                **unknown(link, links),
            )
        return self.links.index(link)

    def _ends(self, spring: TorsionSpring) -> tuple[int, int]:
        first, second = (self._link(link, message("a torsion spring is between links")) for link in spring.between)
        return first, second

    def _force(self, moving: MovingLinks, spot: int, name: PointLike, given: Any) -> Complexes:
        what, rows = message("the force at {point}", point=_point_text(name)), len(moving.time)
        if isinstance(given, tuple | list) and len(given) == 2 and any(map(_varies, given)):
            x, y = (self._amount(what, part, moving, self.of[spot], self.arms[spot]) for part in given)
            return np.asarray(x + 1j * y)
        if _varies(given):
            given = given(moving.state(self.of[spot], self.arms[spot])) if callable(given) else given
        force = _over_rows(what, given, (rows, 2))
        return np.ascontiguousarray(force).view(np.complex128)[:, 0]

    def _amount(self, what: Message, given: Any, moving: MovingLinks, link: int, arm: complex) -> Reals:
        if _varies(given):
            return _of_law(what, given, moving.state(link, arm))
        return _over_rows(what, given, (len(moving.time),))

    def _pull(self, spring: Spring, moving: MovingLinks, first: int) -> Complexes:
        """The force on the first end; exact for a free length 0 even where both ends meet."""
        (near, slow), (far, fast) = (moving.at(self.of[k], self.arms[k]) for k in (first, first + 1))
        gap = far - near
        length = np.abs(gap)
        along = np.where(length > 0, gap / np.where(length > 0, length, 1.0), 0.0)
        rate = (np.conj(along) * (fast - slow)).real
        return np.asarray(spring.stiffness * gap + (spring.tension(length, rate) - spring.stiffness * length) * along)


def acting_loads(motion: Motion, loads: Loads) -> ActingLoads:
    """The loads on a linkage as a motion has solved it."""
    return ActingLoads(motion.linkage, motion.links, loads)


def loads_over_rows(motion: Motion, loads: Loads, time: ArrayLike = 0.0) -> tuple[Wrench, ...]:
    """The loads over the rows of a motion; dampers and laws of the speed see the velocities of the motion, if any.

    Raises `LinkageError` for a point or link that is not there and for numbers that are not finite.
    """
    acting = acting_loads(motion, loads)
    moving = moving_links(motion, time, angles=not acting.of_the_pose)
    forces, moments = acting.forces_at(moving), acting.moments_on(moving)
    none = np.zeros(len(motion))
    wrenches = [Wrench(spot, forces[:, k], none) for k, spot in enumerate(acting.spots)]
    turned = {*loads.moments, *(link for spring in loads.torsion_springs for link in spring.between)}
    return (
        *wrenches,
        *(
            Wrench(LinkPoint(link, 0.0, 0.0), none.astype(np.complex128), moments[:, motion.links.index(link)])
            for link in motion.links
            if link in turned
        ),
    )


def _varies(given: Any) -> bool:
    return isinstance(given, str) or callable(given)


def _of_law(what: Message, given: str | Callable[[State], Any], state: State) -> Reals:
    law: Law = LoadFormula(given) if isinstance(given, str) else given
    values = _over_rows(what, law(state), state.time.shape, of_law=True)
    if not (np.abs(values) < _LARGEST).all():
        row = int(np.argmin(np.abs(values) < _LARGEST))
        raise LinkageError(
            "{what}: the law is not finite at a time of {time:n} s, where the first drive is at {drive:n}",
            what=what,
            time=float(state.time[row]),
            drive=float(state.drive[row]),
        )
    return values


def _point_text(name: PointLike) -> Message:
    return message("{name!r}", name=point_name(name))


def _over_rows(what: Message, given: ArrayLike, shape: Sequence[int], *, of_law: bool = False) -> Reals:
    each_row = len(shape) == 1
    wanted = message("one number for each row" if each_row else "x and y, for each row if they change")
    try:
        numbers = np.asarray(given, np.float64)
        values: Reals = np.broadcast_to(numbers, tuple(shape))
    except (TypeError, ValueError):
        raise LinkageError(
            "{what}: expected {wanted}, but found {given!r}", what=what, wanted=wanted, given=given
        ) from None
    if numbers.ndim == 0 and len(shape) == 2:
        raise LinkageError("{what}: expected {wanted}, but found {given!r}", what=what, wanted=wanted, given=given)
    if not (of_law or (np.abs(numbers) < _LARGEST).all()):
        raise LinkageError("{what}: expected finite numbers, but found {given!r}", what=what, given=given)
    return values
