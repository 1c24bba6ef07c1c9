"""The universal (Cardan, Hooke's) joint between two shafts that meet, and two of them in series."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.immutable import settle
from gruebler.base.notebook import explained
from gruebler.base.text import message
from gruebler.mechanics.fourbar.crank_motion import CrankRates, crank_rates
from gruebler.mechanics.linkages.quantities import as_finite
from gruebler.mechanics.space.crank_output import OutputMotion, rates_of, series_of
from gruebler.mechanics.space.power_series import cosine_and_sine, product, reciprocal
from gruebler.mechanics.space.spherical_four_bar import SphericalFourBar

_RIGHT = math.pi / 2


@explained
@dataclass(frozen=True, slots=True)
class UniversalJoint:
    """A universal joint: two shafts at an angle, joined by a cross.

    phi is the angle of the input shaft, 0 where its fork lies in the plane of the shafts; the output's psi is 0 there,
    too: tan psi = tan phi / cos angle. As a four-bar on the sphere its crank, coupler and rocker are right angles.

    Args:
        angle: between the shafts, in radians, at least 0 and below pi/2.

    Raises:
        LinkageError: another angle.

    Example:
        >>> joint = UniversalJoint(math.radians(30))
        >>> [round(ratio, 7) for ratio in joint.speed_ratios], round(math.degrees(joint.phase_error), 4)
        ([0.8660254, 1.1547005], 4.1172)

    See Also:
        `SphericalFourBar`, `DoubleUniversalJoint`

    Theory:
        docs/theory/closed-forms-in-space.md
    """

    angle: float

    def __post_init__(self) -> None:
        if not 0 <= as_finite("angle", self.angle) < _RIGHT - 1e-9:
            raise LinkageError("the angle must be at least 0 and below pi/2, not {angle!r}", angle=self.angle)
        settle(self, angle=float(self.angle))

    @property
    def four_bar(self) -> SphericalFourBar:
        """The same joint as a spherical four-bar; its output's angle is psi - pi/2 on the branch ``+``."""
        return SphericalFourBar(_RIGHT, _RIGHT, _RIGHT, self.angle)

    @property
    def speed_ratios(self) -> tuple[float, float]:
        """The smallest and the largest speed of the output by that of the input: cos angle and 1/cos angle."""
        cosine = math.cos(self.angle)
        return cosine, 1 / cosine

    @property
    def irregularity(self) -> float:
        """The difference of the largest and smallest output speed by the mean: sin angle · tan angle."""
        return math.sin(self.angle) * math.tan(self.angle)

    @property
    def phase_error(self) -> float:
        """The most by which the output leads or lags, in radians: sin = tan²(angle/2)."""
        return math.asin(math.tan(self.angle / 2) ** 2)

    @property
    def phase_error_at(self) -> float:
        """The input angle at which the output leads most, in 0..pi/2; at pi less it, it lags most."""
        return math.atan(math.sqrt(math.cos(self.angle)))

    def motion(
        self,
        phi: npt.ArrayLike,
        *,
        omega: npt.ArrayLike = 1.0,
        alpha: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
    ) -> OutputMotion:
        """The output shaft with whole turns, velocity, acceleration and jerk over input angles of any shape.

        >>> round(float(UniversalJoint(math.radians(30)).motion(0.0).output.velocity), 7)
        1.1547005
        """
        return _shafts(crank_rates(phi, omega, alpha, jerk), [(0.0, math.cos(self.angle))], self.angle)

    def explain(self, lang: str = "en") -> str:
        """Speed ratios and phase error: lines in English or German (``de``)."""
        low, high = self.speed_ratios
        lines = [
            message("speed ratio: {low:n} to {high:n}", low=low, high=high),
            message("largest phase error: {angle:n}°", angle=math.degrees(self.phase_error)),
        ]
        return "\n".join(line.in_language(lang) for line in lines)


@dataclass(frozen=True, slots=True)
class DoubleUniversalJoint:
    """Two universal joints with a shaft between them.

    Args:
        first: the joint at the input.
        second: the joint at the output.
        phase: the angle by which the forks of the middle shaft, and the planes of the two bends, are turned against the
            right arrangement (both forks in one plane while all three shafts lie in one), in radians.

    Example:
        >>> bend = UniversalJoint(math.radians(25))
        >>> right, wrong = DoubleUniversalJoint(bend, bend), DoubleUniversalJoint(bend, bend, phase=math.pi / 2)
        >>> phi = np.linspace(0, 6, 50)
        >>> bool(abs(right.motion(phi).output.value - phi).max() < 1e-14)
        True
        >>> round(float(wrong.motion(0.0).output.velocity), 6), round(1 / math.cos(math.radians(25)) ** 2, 6)
        (1.217443, 1.217443)

    See Also:
        `UniversalJoint`
    """

    first: UniversalJoint
    second: UniversalJoint
    phase: float = 0.0

    def __post_init__(self) -> None:
        for name in ("first", "second"):
            if not isinstance(getattr(self, name), UniversalJoint):
                raise LinkageError(
                    "{name} must be a UniversalJoint, not {value!r}", name=name, value=getattr(self, name)
                )
        settle(self, phase=as_finite("phase", self.phase))

    def motion(
        self,
        phi: npt.ArrayLike,
        *,
        omega: npt.ArrayLike = 1.0,
        alpha: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
    ) -> OutputMotion:
        """The output shaft with whole turns, velocity, acceleration and jerk over input angles of any shape."""
        bends = [(0.0, math.cos(self.first.angle)), (_RIGHT + self.phase, math.cos(self.second.angle))]
        return _shafts(crank_rates(phi, omega, alpha, jerk), bends, max(self.first.angle, self.second.angle))


def _shafts(crank: CrankRates, bends: list[tuple[float, float]], most: float) -> OutputMotion:
    """The motion through joints with the cosine of each, whose input fork is turned by an angle."""
    series = series_of(crank)
    for turned, cosine in bends:
        series = _through(series, turned, cosine)
    # A cross takes the torque of a shaft at the angle between its plane and the other shaft, at worst pi/2 - angle.
    return OutputMotion(
        crank=crank, output=rates_of(series), transmission_angle=np.full(np.shape(crank.value), _RIGHT - most)
    )


def _through(phi: Reals, turned: float, cosine: float) -> Reals:
    """The series of the output: psi' = phi' cos angle / (cos² phi cos² angle + sin² phi), phi from the fork's plane."""
    shifted = phi.copy()
    shifted[0] += turned
    c, s = cosine_and_sine(shifted)
    order = np.arange(1, len(phi)).reshape(-1, *[1] * (phi.ndim - 1))
    below = cosine**2 * product(c, c, np.multiply) + product(s, s, np.multiply)
    psi = np.zeros(phi.shape)
    psi[0] = phi[0] + _lead(c[0], s[0], cosine) - _lead(math.cos(turned), math.sin(turned), cosine)
    psi[1:] = cosine * product(reciprocal(below)[:-1], phi[1:] * order, np.multiply) / order
    return psi


def _lead(c: npt.ArrayLike, s: npt.ArrayLike, cosine: float) -> Reals:
    """The lead psi - phi, without a jump at any turn."""
    c, s = np.asarray(c), np.asarray(s)
    return np.asarray(np.arctan2((1 - cosine) * s * c, cosine * c**2 + s**2))
