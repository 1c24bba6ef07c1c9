"""The swash plate: a plate fixed aslant on a shaft moves pistons along it, as in pumps and hydraulic motors."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gruebler.base.errors import LinkageError
from gruebler.base.events import DeadCentre
from gruebler.base.immutable import settle
from gruebler.base.notebook import explained
from gruebler.base.text import message
from gruebler.mechanics.fourbar.crank_motion import crank_rates
from gruebler.mechanics.linkages.quantities import as_finite, as_lengths
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.crank_output import OutputMotion, rates_of, series_of
from gruebler.mechanics.space.power_series import cosine_and_sine
from gruebler.structure.mechanism import Mechanism

_TEXT = "spatial: R(frame-plate) ball_plane(plate-piston) P(frame-piston); drive=R(frame-plate)"


@explained
@dataclass(frozen=True, slots=True)
class SwashPlate:
    """A plane plate on a shaft, tilted against it, and a piston along the shaft whose ball slides on the plate.

    phi is the angle of the shaft, 0 where the plate is highest under the piston; the piston's way from the middle is
    s = radius · tan tilt · cos phi. In many pumps the barrel with the pistons turns and the plate stands; the motion
    against the barrel is the same.

    Args:
        radius: of the piston's axis from the shaft's, a length.
        tilt: between the plate's normal and the shaft, in radians, at least 0 and below pi/2.

    Raises:
        LinkageError: a radius that is not positive, another tilt.

    Example:
        >>> pump = SwashPlate(40, math.radians(18))
        >>> round(pump.stroke, 4), [centre.kind for centre in pump.dead_centres]
        (25.9936, ['maximum', 'minimum'])

    See Also:
        `UniversalJoint`, `RSSR`, `move`

    Theory:
        docs/theory/closed-forms-in-space.md
    """

    radius: float
    tilt: float

    def __post_init__(self) -> None:
        if not 0 <= as_finite("tilt", self.tilt) < math.pi / 2 - 1e-9:
            raise LinkageError("the tilt must be at least 0 and below pi/2, not {angle!r}", angle=self.tilt)
        settle(self, **as_lengths(radius=self.radius), tilt=float(self.tilt))

    @property
    def amplitude(self) -> float:
        """The largest way from the middle, half the stroke: radius · tan tilt."""
        return self.radius * math.tan(self.tilt)

    @property
    def stroke(self) -> float:
        """The way between the dead centres."""
        return 2 * self.amplitude

    @property
    def dead_centres(self) -> tuple[DeadCentre, ...]:
        """At 0 and pi; none without a tilt."""
        if not self.amplitude:
            return ()
        return (
            DeadCentre(drive=0.0, output=self.amplitude, kind="maximum"),
            DeadCentre(drive=math.pi, output=-self.amplitude, kind="minimum"),
        )

    def motion(
        self,
        phi: npt.ArrayLike,
        *,
        omega: npt.ArrayLike = 1.0,
        alpha: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
    ) -> OutputMotion:
        """The piston's way with velocity, acceleration and jerk over angles of the shaft of any shape.

        >>> round(float(SwashPlate(40, math.radians(18)).motion(math.pi / 2, omega=100).output.velocity), 2)
        -1299.68
        """
        crank = crank_rates(phi, omega, alpha, jerk)
        cosine, _ = cosine_and_sine(series_of(crank))
        return OutputMotion(
            crank=crank,
            output=rates_of(self.amplitude * cosine),
            transmission_angle=np.full(np.shape(crank.value), math.pi / 2 - self.tilt),
        )

    def linkage(self, phi: float = 0.0, *, unit: str = "mm") -> SpatialLinkage:
        """The linkage with the shaft at phi as its reference pose: the shaft along z, the piston over the x axis."""
        cosine, sine, slope = math.cos(as_finite("phi", phi)), math.sin(phi), math.tan(self.tilt)
        ball = (self.radius, 0.0, self.amplitude * cosine)
        places: dict[str | int, object] = {
            0: {"z": (0.0, 0.0, 1.0)},
            1: {"at": ball, "y": (-slope * cosine, -slope * sine, 1.0)},
            2: {"at": ball, "x": (0.0, 0.0, 1.0)},
        }
        return SpatialLinkage(Mechanism.parse(_TEXT), places, unit=unit, outputs=["piston"])

    def explain(self, lang: str = "en") -> str:
        """Stroke and smallest transmission angle: lines in English or German (``de``)."""
        lines = [
            message("stroke: {length:n}", length=self.stroke),
            message("smallest transmission angle: {angle:n}°", angle=90 - math.degrees(self.tilt)),
        ]
        return "\n".join(line.in_language(lang) for line in lines)
