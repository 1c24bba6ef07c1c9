"""What a linkage with one crank does at given crank angles: positions and their first three derivatives in time."""

from __future__ import annotations

from abc import ABC
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from gruebler.base.angles import warn_of_degrees
from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.errors import LinkageError
from gruebler.base.jets import turn_derivative
from gruebler.base.text import Message
from gruebler.mechanics.linkages.quantities import as_finite, as_numbers


class CrankRates(NamedTuple):
    """A quantity at given instants with its velocity, acceleration and jerk; four arrays of one shape."""

    value: Reals
    velocity: Reals
    acceleration: Reals
    jerk: Reals


class CrankAndOutput(ABC):
    """What a crank and an output that follows it say of their motion, in the plane as in space."""

    __slots__ = ()

    crank: CrankRates
    output: CrankRates
    reason: Message | None

    @property
    def message(self) -> str:
        """The reason in English; empty if there is none."""
        return str(self.reason or "")

    @property
    def complete(self) -> bool:
        """Whether every pose is assembled and every rate determined."""
        return self.reason is None

    @property
    def assembled(self) -> npt.NDArray[np.bool_]:
        """Which poses can be assembled."""
        return np.isfinite(self.output.value)

    @property
    def ratio(self) -> Reals:
        """The transmission ratio i, the crank's velocity by the output's; infinite in a dead centre."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(self.crank.velocity / self.output.velocity)


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class CrankMotion(CrankAndOutput):
    """The poses of a linkage over crank angles, in closed form.

    Angles in radians, counted from the x-axis (from A0 to B0, or along the slider's path); rates per unit of the time
    in which ``omega`` was given. Points are arrays with (x, y) in the last axis. A pose that cannot be assembled is
    NaN; so are rates where the output does not determine them (transmission angle 0); ``message`` says so.
    """

    crank: CrankRates
    """The crank's angle phi."""
    coupler: CrankRates
    """The coupler's angle theta, the direction from A to B."""
    output: CrankRates
    """The rocker's angle psi, the direction from B0 to B; for a slider its way s."""
    A: CrankRates
    """The joint of crank and coupler."""
    B: CrankRates
    """The joint of coupler and output."""
    mu: Reals
    """The angle between coupler and output in 0..pi, not folded."""
    side: int
    """1 on the branch ``+``, -1 on ``-``."""
    reason: Message | None
    """Why some pose is not assembled or some rate not determined; None if all are."""
    displacement: CrankRates | None = None
    """Of an inverted slider-crank the way r of the block along the guide, from A to B: the foot of B0 on the guide."""

    @property
    def transmission_angle(self) -> Reals:
        """The transmission angle, folded to at most pi/2."""
        return np.minimum(self.mu, np.pi - self.mu)

    @property
    def deviation_angle(self) -> Reals:
        """The deviation angle alpha, pi/2 less the transmission angle."""
        return np.pi / 2 - self.transmission_angle

    def point(self, u: float, v: float = 0.0) -> CrankRates:
        """The coupler point u along AB from A and v to the left: its path, velocity, acceleration and jerk."""
        arm = complex(as_finite("u", u), as_finite("v", v))
        rates = [arm * rotation_derivative(self.coupler[: k + 1], k) for k in range(4)]
        return CrankRates(*(at + points(rate) for at, rate in zip(self.A, rates, strict=True)))


def points(z: Any) -> Reals:
    """Complex numbers as points: (x, y) in a new last axis."""
    return np.stack([np.real(z), np.imag(z)], axis=-1)


def rotation_derivative(angle: Sequence[Any], order: int) -> Any:
    """The derivative of exp(i x) of an order up to 3, given x and its derivatives; those left out count as zero.

    >>> rotation_derivative([0.0, 2.0], 1)
    np.complex128(2j)
    """
    return turn_derivative([*angle[1:], 0.0, 0.0, 0.0], order) * np.exp(1j * angle[0])


def crank_rates(phi: npt.ArrayLike, omega: npt.ArrayLike, alpha: npt.ArrayLike, jerk: npt.ArrayLike) -> CrankRates:
    """The crank's own motion, checked; rates are spread over all angles."""
    named = {"phi": phi, "omega": omega, "alpha": alpha, "jerk": jerk}
    given = {name: as_numbers(name, value) for name, value in named.items()}
    for name, values in given.items():
        if values.size and np.abs(values).max() > 1e50:
            raise LinkageError("{name} must be below 1e50: choose another unit of time", name=name)
    warn_of_degrees("phi", given["phi"])
    try:
        return CrankRates(*(np.array(part) for part in np.broadcast_arrays(*given.values())))
    except ValueError:
        shapes = ", ".join(f"{name} {values.shape}" for name, values in given.items() if values.ndim)
        raise LinkageError(
            "the crank's angles and rates must fit each other in shape, not {shapes}", shapes=shapes
        ) from None


def determined_rates(rates: Sequence[Reals]) -> CrankRates:
    """A track whose rates are NaN wherever they are not finite."""
    value, *derivatives = rates
    return CrankRates(np.asarray(value), *(np.where(np.isfinite(rate), rate, np.nan) for rate in derivatives))
