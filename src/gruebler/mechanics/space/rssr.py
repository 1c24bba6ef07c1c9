"""The RSSR in closed form: two cranks on skew axes, and a rod with a ball at each end."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.events import DeadCentre
from gruebler.base.immutable import settle
from gruebler.base.notebook import explained
from gruebler.base.text import joined_by_or, message
from gruebler.mechanics.fourbar.extremes import TURN, CrankRange
from gruebler.mechanics.fourbar.four_bar_types import FOUR_BAR_TYPES, NOT_ASSEMBLABLE, LinkageType
from gruebler.mechanics.linkages.branch import Branch, branch_side
from gruebler.mechanics.linkages.quantities import as_finite, as_lengths
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.crank_output import OutputMotion, assembly_arcs, output_motion
from gruebler.structure.mechanism import Mechanism

_TEXT = "spatial: R(frame-crank) S(crank-rod) S(rod-rocker) R(frame-rocker); drive=R(frame-crank)"
_TYPES = {(True, False): ("<", "a"), (False, True): ("<", "c"), (True, True): ("<", "d"), (False, False): (">", "")}


@explained
@dataclass(frozen=True, slots=True, kw_only=True)
class RSSR:
    """Two cranks a and c on skew axes and a rod b with a ball at each end: such as a wiper drive across a car.

    The crank turns about z, its ball A is at (a cos phi, a sin phi, crank_offset). The rocker's axis is
    (0, -sin twist, cos twist) through (d, 0, 0): d along x is the common normal of the axes. The rocker's ball is
    rocker_offset along that axis and c from it, at the angle psi from x. With twist and offsets 0 it is the `FourBar`
    of these lengths; branch ``+`` is that of the four-bar then.

    Args:
        a: the crank's radius, a length.
        b: the rod between the centres of its balls.
        c: the rocker's radius.
        d: the distance of the axes; 0 if they meet.
        twist: the angle between the axes in radians, about x.
        crank_offset: of the crank's plane along its axis, from the common normal.
        rocker_offset: of the rocker's plane along its axis.

    Raises:
        LinkageError: a length that is not positive, a number that is not finite.

    Example:
        >>> wiper = RSSR(a=30, b=140, c=80, d=100, twist=math.radians(40), rocker_offset=40)
        >>> print(wiper.type, round(math.degrees(wiper.swing()), 3))
        crank-rocker 53.344

    See Also:
        `FourBar`, `SphericalFourBar`, `move`

    Theory:
        docs/theory/closed-forms-in-space.md
    """

    a: float
    b: float
    c: float
    d: float
    twist: float = 0.0
    crank_offset: float = 0.0
    rocker_offset: float = 0.0

    def __post_init__(self) -> None:
        checked = as_lengths(a=self.a, b=self.b, c=self.c)
        others = {
            name: as_finite(name, getattr(self, name)) for name in ("d", "twist", "crank_offset", "rocker_offset")
        }
        if others["d"] < 0:
            raise LinkageError("d must not be negative, but is {d:g}", d=others["d"])
        settle(self, **checked, **others)

    def reversed(self) -> RSSR:
        """The same linkage driven at the rocker, seen from its axis: its angles are pi - psi and pi - phi."""
        return RSSR(
            a=self.c,
            b=self.b,
            c=self.a,
            d=self.d,
            twist=-self.twist,
            crank_offset=self.rocker_offset,
            rocker_offset=self.crank_offset,
        )

    @property
    def limits(self) -> tuple[CrankRange, ...]:
        """The crank angles for which it can be assembled."""
        return assembly_arcs(self._condition)

    @property
    def type(self) -> LinkageType:
        """Which of crank and rocker turn fully, named as in the plane."""
        own, other = self.limits, self.reversed().limits
        if not own:
            return NOT_ASSEMBLABLE
        return FOUR_BAR_TYPES[_TYPES[own[0].full, other[0].full]]

    def dead_centres(self, branch: Branch = None) -> tuple[DeadCentre, DeadCentre] | None:
        """Where the rocker turns back, the smaller psi first; None unless the crank turns fully and it does not.

        The modes of a branch are no mirror images here, so each has its own.
        """
        if self.type.key != "crank_rocker":
            return None
        back = self.reversed()
        at = float(self.motion(0.0, branch=branch).output.value)
        # A dead centre at phi = 0 lies at the end of its arc, and by rounding beyond it: the arc that comes nearest.
        arc = min(
            back.limits,
            key=lambda arc: abs(math.remainder(math.pi - at - (arc.start + arc.end) / 2, TURN)) - arc.width / 2,
        )
        centres = []
        for psi, kind in ((math.pi - arc.end, "minimum"), (math.pi - arc.start, "maximum")):
            cosine, sine = (np.array([part(math.pi - psi)]) for part in (np.cos, np.sin))
            p, q, k = (float(part[0]) for part in back._condition(cosine, sine))
            phi = math.pi - (math.atan2(q, p) if k > 0 else math.atan2(-q, -p))
            centres.append(DeadCentre(drive=phi % TURN, output=psi, kind=kind))
        return centres[0], centres[1]

    def swing(self, branch: Branch = None) -> float | None:
        """The angle between the dead centres; None if there are none."""
        centres = self.dead_centres(branch)
        return None if centres is None else centres[1].output - centres[0].output

    def _condition(self, cosine: Reals, sine: Reals) -> tuple[Reals, Reals, Reals]:
        """P, Q, K of |B - A|² = b²: 2c(w·x cos psi + w·y sin psi) = |w|² + c² - b², w from the rocker's centre to A."""
        unit = np.zeros(cosine.shape)
        unit[0] = 1
        up, aside = math.cos(self.twist), math.sin(self.twist)
        x = self.a * cosine - self.d * unit
        y = self.a * up * sine + self.crank_offset * aside * unit
        square = (
            (self.a**2 + self.d**2 + self.crank_offset**2 + self.rocker_offset**2 + self.c**2 - self.b**2) * unit
            - 2 * self.a * self.d * cosine
            - 2 * self.rocker_offset * (self.crank_offset * up * unit - self.a * aside * sine)
        )
        return 2 * self.c * x, 2 * self.c * y, square

    def motion(
        self,
        phi: npt.ArrayLike,
        *,
        omega: npt.ArrayLike = 1.0,
        alpha: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
        branch: Branch = None,
    ) -> OutputMotion:
        """The output with velocity, acceleration and jerk over crank angles of any shape, in closed form.

        >>> plane = RSSR(a=25, b=70, c=40, d=70)
        >>> round(float(plane.motion(math.radians(55), omega=10).output.velocity), 9)
        4.785205278
        """

        def transmission(root: Reals, _: Reals) -> Reals:
            return np.asarray(np.arcsin(np.minimum(1.0, root / (2 * self.b * self.c))))

        size = (self.a + self.b + self.c + self.d + abs(self.crank_offset) + abs(self.rocker_offset)) ** 2
        return output_motion(
            self._condition, transmission, self.limits, branch_side(branch), (phi, omega, alpha, jerk), size
        )

    def linkage(
        self,
        phi: float = 0.0,
        *,
        branch: Branch = None,
        points: Mapping[str, tuple[str, float, float, float]] | None = None,
        unit: str = "mm",
    ) -> SpatialLinkage:
        """The linkage with the crank at phi as its reference pose; points (link, x, y, z) in that pose.

        Raises `LinkageError` if it cannot be assembled there.
        """
        psi = float(self.motion(as_finite("phi", phi), branch=branch).output.value)
        if not math.isfinite(psi):
            raise LinkageError("the linkage cannot be assembled at phi = {angle:g} degrees", angle=math.degrees(phi))
        up, aside = math.cos(self.twist), math.sin(self.twist)
        axis, across = np.array([0, -aside, up]), np.array([0, up, aside])
        foot = np.array([self.d, 0.0, 0.0])
        ball = foot + self.rocker_offset * axis
        ball = ball + self.c * (math.cos(psi) * np.array([1.0, 0, 0]) + math.sin(psi) * across)
        places: dict[str | int, object] = {
            0: {"z": (0.0, 0.0, 1.0)},
            1: (self.a * math.cos(phi), self.a * math.sin(phi), self.crank_offset),
            2: tuple(map(float, ball)),
            3: {"at": tuple(map(float, foot)), "z": tuple(map(float, axis))},
        }
        return SpatialLinkage(Mechanism.parse(_TEXT), places, unit=unit, points=points, outputs=["rocker"])

    def explain(self, lang: str = "en") -> str:
        """Its type, where the crank turns, how far the rocker swings: lines in English or German (``de``)."""
        lines = [self.type.title]
        if self.limits:
            lines.append(message("crank angle: {ranges}", ranges=joined_by_or([arc.title for arc in self.limits])))
            swing = self.swing()
            if swing is not None:
                lines.append(message("swing of the output: {angle:n}°", angle=math.degrees(swing)))
        return "\n".join(line.in_language(lang) for line in lines)
