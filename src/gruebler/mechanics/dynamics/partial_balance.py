"""What is left when forces and moments cannot be balanced completely: best counterweights, shafts, wheels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Complexes, Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief
from gruebler.base.units import metres_of
from gruebler.mechanics.dynamics.inverse import InverseDynamics
from gruebler.mechanics.dynamics.mass_moments import frame_pin
from gruebler.mechanics.kinematics import Motion

_GAP = 1e-9  # of the largest force: so near is the best
_ROUNDS = 60


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class PartialBalance:
    """The best that counterweights on given links can do in a motion."""

    products: dict[str, tuple[float, float]]
    """By link: mass times the way from its pin on the frame, in its coordinates; kg times the linkage's unit."""
    before: Reals
    """The shaking force without them; (rows, 2), newtons."""
    after: Reals
    """With them; (rows, 2)."""
    bound: float
    """No such counterweights come below this: largest force of `minimax`, else root mean square; newtons."""

    @property
    def largest(self) -> tuple[float, float]:
        """The largest shaking force before and after."""
        return float(np.hypot(*self.before.T).max()), float(np.hypot(*self.after.T).max())


@door_that_raises(LinkageError)
def balance_partly(run: InverseDynamics, on: Sequence[str], *, minimax: bool = False) -> PartialBalance:
    """The counterweights on links pinned to the frame that leave the least shaking force in a motion.

    The problem is convex. Least squares over the rows is solved at once; the least largest force by linear programs,
    until their bound proves it to a part of 1e-9, or after 60 of them with the bound that was reached.

    Args:
        run: Forces of inertia over the motion.
        on: Links that are pinned to the frame.
        minimax: Least largest force, in place of least mean square.

    Returns:
        `PartialBalance`: products of mass and radius, shaking forces before and after, a bound.

    Raises:
        LinkageError: a link that no pin joins to the frame, rows without forces.

    Cost:
        Rows times links; `minimax` some ten linear programs, 10 ms for 72 rows.

    Example:
        >>> from gruebler.mechanics.dynamics import inverse_dynamics
        >>> from gruebler.mechanics.forces import Loads, RigidBody
        >>> from gruebler.mechanics.fourbar import SliderCrank
        >>> from gruebler.mechanics.kinematics import move
        >>> turn = np.linspace(0, 2 * np.pi, 72, endpoint=False)
        >>> engine = inverse_dynamics(
        ...     move(SliderCrank(30, 3e5), turn, speed=100.0), Loads(bodies={"slider": RigidBody(2.0)})
        ... )
        >>> best = balance_partly(engine, ["crank"])  # half of the mass that goes to and fro: 1 kg · 30 mm
        >>> round(best.products["crank"][0], 2), round(best.largest[1] / best.largest[0], 3)
        (-30.0, 0.5)

    See Also:
        `balance_forces`, `shaking_harmonics`

    Theory:
        docs/theory/balancing.md
    """
    motion, force = run.motion, run.shaking_force @ np.array([1, 1j])
    if not len(force) or not np.isfinite(force).all():
        raise LinkageError("a balance needs a motion with forces of inertia in every row")
    units = np.stack([_unit_force(motion, link) for link in on], axis=1)
    sizes = np.abs(units).max(axis=0, initial=0.0)
    if not (sizes > 0).all():
        raise LinkageError("a counterweight acts on a link that turns, with a speed")
    best, bound = (_least_largest if minimax else _least_squares)(units / sizes, force)
    best = best / sizes
    after = force + units @ best
    return PartialBalance(
        products={link: (float(w.real), float(w.imag)) for link, w in zip(on, best, strict=True)},
        before=run.shaking_force,
        after=np.stack([after.real, after.imag], axis=1),
        bound=bound,
    )


def _least_squares(units: Complexes, force: Complexes) -> tuple[Complexes, float]:
    """Products with the least mean square of force + units products, and its root."""
    products = np.asarray(np.linalg.lstsq(units, -force, rcond=1e-12)[0])
    return products, float(np.sqrt((np.abs(force + units @ products) ** 2).mean()))


def _least_largest(units: Complexes, force: Complexes) -> tuple[Complexes, float]:
    """Products with the least largest force, and a bound below it, by cutting planes.

    A force is as long as its longest shadow; each linear program knows some shadows, so its optimum is a bound, and
    hears of the shadows along the forces that it leaves.
    """
    from scipy.optimize import linprog

    count = units.shape[1]
    scale = float(np.abs(force).max()) or 1.0
    ways = [np.full(len(force), 1j**quarter) for quarter in range(4)]
    shadows, limits = _shadows(units / scale, force / scale, np.concatenate(ways))
    best, least, bound = np.zeros(count, np.complex128), np.inf, 0.0
    for _ in range(_ROUNDS):
        answer = linprog(np.eye(2 * count + 1)[-1], shadows, limits, bounds=(None, None), method="highs")
        if answer.x is None:
            break
        products, bound = answer.x[:count] + 1j * answer.x[count:-1], scale * float(answer.x[-1])
        rest = force + units @ products
        if (largest := float(np.abs(rest).max())) < least:
            best, least = products, largest
        if least - bound <= _GAP * least:
            break
        near = np.abs(rest) > bound
        more, further = _shadows(units[near] / scale, force[near] / scale, rest[near] / np.abs(rest[near]))
        shadows, limits = np.concatenate([shadows, more]), np.concatenate([limits, further])
    return best, min(bound, least)


def _shadows(units: Complexes, force: Complexes, ways: Complexes) -> tuple[Reals, Reals]:
    """Rows of the program: Re(conj(way) (force + units products)) <= the largest."""
    times = len(ways) // len(force)
    turned = np.conj(ways)[:, None] * np.tile(units, (times, 1))
    rows = np.concatenate([turned.real, -turned.imag, np.full((len(ways), 1), -1.0)], axis=1)
    return rows, -(np.conj(ways) * np.tile(force, times)).real


def _unit_force(motion: Motion, link: str) -> Complexes:
    """The force of inertia of a product 1 on a link pinned to the frame; (rows,)."""
    frame_pin(motion.lower_linkage, link)
    turned = motion.turns[:, motion.links.index(link)]
    bent = 1j * motion.angular(link, order=2) - motion.angular(link, order=1) ** 2
    return np.asarray(-metres_of(motion.linkage.unit) * bent * turned)


@compared_by_value
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class MomentBalance:
    """Wheels that turn against links pinned to the frame, and the shaking moment with them."""

    inertias: dict[str, float]
    """By link: the moment of inertia of a wheel geared to it 1 : -1, kg times the unit squared."""
    before: Reals
    """The shaking moment about the origin of the frame without them; (rows,), newtons times the unit."""
    after: Reals
    """With them; (rows,)."""


@door_that_raises(LinkageError)
def balance_moments(run: InverseDynamics, on: Sequence[str]) -> MomentBalance:
    """The counter-rotating wheels that leave the least mean square of the shaking moment in a motion.

    With balanced forces the moment is the same about all places; it can be taken away completely where the links that
    are not pinned to the frame act as point masses at pins of links that are.

    Args:
        run: Forces of inertia over the motion.
        on: Links that are pinned to the frame; wheels turn as fast as they, the other way.

    Returns:
        `MomentBalance`: moments of inertia of the wheels, not negative; the shaking moment before and after.

    Raises:
        LinkageError: a link that no pin joins to the frame, rows without forces.

    Example:
        >>> from gruebler.mechanics.dynamics import inverse_dynamics
        >>> from gruebler.mechanics.forces import Loads, RigidBody
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> from gruebler.mechanics.kinematics import move
        >>> rocker = Loads(bodies={"rocker": RigidBody(2.0, (0, 0), 500.0)})
        >>> run = inverse_dynamics(move(FourBar(25, 70, 40, 70), [1.0, 2.0, 3.0], speed=50.0), rocker)
        >>> round(balance_moments(run, ["rocker"]).inertias["rocker"], 6)
        500.0

    See Also:
        `balance_forces`, `balance_partly`

    Theory:
        docs/theory/balancing.md
    """
    from scipy.optimize import nnls

    motion, moment = run.motion, run.shaking_moment()
    if not len(moment) or not np.isfinite(moment).all():
        raise LinkageError("a balance needs a motion with forces of inertia in every row")
    for link in on:
        frame_pin(motion.lower_linkage, link)
    columns = metres_of(motion.linkage.unit) * np.stack([motion.angular(link, order=2) for link in on], axis=1)
    sizes = np.maximum(np.abs(columns).max(axis=0), np.finfo(np.float64).tiny)
    wheels = nnls(columns / sizes, -moment)[0] / sizes
    inertias = {link: float(value) for link, value in zip(on, wheels, strict=True)}
    return MomentBalance(inertias=inertias, before=moment, after=moment + columns @ wheels)


@door_that_raises(LinkageError)
def shaking_harmonics(run: InverseDynamics, highest: int = 4) -> Complexes:
    """The shaking force of a full turn as rotating forces: one for each multiple of the drive's angle, both senses.

    A shaft that turns n times as fast as the drive, with the opposite force, takes away row n; Lanchester's pair of
    shafts does so for n and -n. The sum over all n is the force: sum of F_n exp(i n q).

    Args:
        run: Over one full turn of one drive, rows evenly spaced, the end left out.
        highest: n from -highest to highest.

    Returns:
        F_n (2 highest + 1,), n from below, x + iy in newtons; at constant speed F_n / (n speed)² is a product of mass
        and radius.

    Raises:
        LinkageError: other rows, or too few of them.

    Example:
        >>> from gruebler.mechanics.dynamics import inverse_dynamics
        >>> from gruebler.mechanics.forces import Loads, RigidBody
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> from gruebler.mechanics.kinematics import move
        >>> turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
        >>> crank = Loads(bodies={"crank": RigidBody(2.0, (10, 0))})
        >>> run = inverse_dynamics(move(FourBar(25, 70, 40, 70), turn, speed=50.0), crank)
        >>> abs(shaking_harmonics(run, 1)).round(9).tolist()  # a crank alone: m r w² forward
        [0.0, 0.0, 50.0]

    See Also:
        `balance_partly`

    Theory:
        docs/theory/balancing.md
    """
    drives, rows = run.motion.drives, len(run.motion)
    steps = np.diff(drives[:, 0])
    even = rows > 2 * highest and drives.shape[1] == 1 and np.allclose(np.abs(steps), 2 * np.pi / rows, rtol=1e-9)
    if not (highest >= 0 and even and (np.sign(steps) == np.sign(steps[0])).all()):
        raise LinkageError(
            "harmonics need one drive and more than {count} rows evenly spaced over a full turn, its end left out",
            count=2 * max(highest, 0),
        )
    force = run.shaking_force @ np.array([1, 1j])
    orders = np.arange(-highest, highest + 1)
    return np.asarray(np.exp(-1j * orders[:, None] * drives[:, 0]) @ force / rows)
