"""The spherical four-bar in closed form: four turning joints whose axes meet in one point."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.events import TransmissionExtremes
from gruebler.base.immutable import settle
from gruebler.base.notebook import explained
from gruebler.base.text import joined_by_or, message
from gruebler.mechanics.fourbar.extremes import (
    TURN,
    CrankRange,
    DeadCentres,
    clipped_cosine,
    mirrored_ranges,
    transmission_extremes,
)
from gruebler.mechanics.fourbar.four_bar_types import FOUR_BAR_TYPES, NOT_ASSEMBLABLE, SINGLE_POSITION, LinkageType
from gruebler.mechanics.linkages.branch import Branch, branch_side
from gruebler.mechanics.linkages.quantities import as_finite, as_positive
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.crank_output import OutputMotion, output_motion
from gruebler.structure.mechanism import Mechanism

_CLOSE = 1e-12
_TEXT = "spherical: R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); drive=R(frame-crank)"
CHANGE_POINT = LinkageType("change_point", message("change-point linkage"))
_TYPES = {("a",): "a", ("c",): "c", ("a", "c"): "d", ("b",): "b"}


@explained
@dataclass(frozen=True, slots=True)
class SphericalFourBar:
    """A four-bar on the sphere: crank a = A0A, coupler b = AB, rocker c = B0B, frame d = A0B0, arcs in radians.

    The axis A0 is z, B0 = (sin d, 0, cos d). The crank's angle phi is that at A0 from the arc A0B0 to A0A, the output's
    psi that at B0 from the arc A0B0, carried on beyond B0, to B0B. Of the two assembly modes, branch ``+`` has B to the
    left of the arc from A to B0 as seen from outside. On a small cap it is the `FourBar` of these arcs. Arcs that close
    in no position are a result (``type``), not an error.

    Args:
        a, b, c, d: arcs between 0 and pi, in radians.

    Raises:
        LinkageError: an arc that is not between 0 and pi.

    Example:
        >>> drive = SphericalFourBar(*np.radians([30, 80, 60, 70]))
        >>> print(drive.type, round(math.degrees(drive.swing), 3))
        crank-rocker 74.512

    See Also:
        `FourBar`, `UniversalJoint`, `RSSR`, `move`

    Theory:
        docs/theory/closed-forms-in-space.md
    """

    a: float
    b: float
    c: float
    d: float

    def __post_init__(self) -> None:
        arcs = {name: as_positive(name, getattr(self, name)) for name in "abcd"}
        for name, arc in arcs.items():
            if not 1e-9 < arc < math.pi - 1e-9:
                raise LinkageError("{name} must lie between 0 and pi, not {value!r}", name=name, value=arc)
        settle(self, **arcs)

    # --- which links turn -------------------------------------------------------------------------------------------

    @property
    def joint_excess(self) -> dict[str, float]:
        """How far each joint is from turning fully, in radians: at most 0 if it turns; 0 at a change point."""
        a, b, c, d = self.a, self.b, self.c, self.d
        pairs = {"A0": ((a, d), (b, c)), "A": ((a, b), (c, d)), "B": ((b, c), (a, d)), "B0": ((c, d), (a, b))}
        return {
            joint: max(_least(*far) - _least(*near), _most(*near) - _most(*far)) for joint, (near, far) in pairs.items()
        }

    @property
    def turning(self) -> tuple[str, ...]:
        """The links a, b, c that turn fully; b if the coupler turns against crank and rocker and these do not."""
        excess = self.joint_excess
        if self._gap > _CLOSE:
            return ()
        sides = tuple(link for link, joint in (("a", "A0"), ("c", "B0")) if excess[joint] <= _CLOSE)
        return sides or (("b",) if excess["A"] <= _CLOSE else ())

    @property
    def type(self) -> LinkageType:
        """What it is: crank-rocker, double crank, ..., named as in the plane."""
        if self._gap > _CLOSE:
            return NOT_ASSEMBLABLE
        if abs(self._gap) <= _CLOSE:
            return SINGLE_POSITION
        if any(abs(each) <= _CLOSE for each in self.joint_excess.values()):
            key = _TYPES.get(self.turning)
            # Two joints can be at their limit at once: which links turn then depends on the way through.
            single = sum(each < -_CLOSE for each in self.joint_excess.values()) == 2
            return FOUR_BAR_TYPES["=", key] if key and single else CHANGE_POINT
        return FOUR_BAR_TYPES["<", _TYPES[self.turning]] if self.turning else FOUR_BAR_TYPES[">", ""]

    @property
    def _gap(self) -> float:
        """How far A and the rocker's circle are apart at best; at most 0 if it can be assembled."""
        a, b, c, d = self.a, self.b, self.c, self.d
        return max(_least(a, d), _least(b, c)) - min(_most(a, d), _most(b, c))

    def reversed(self) -> SphericalFourBar:
        """The same four-bar driven at the other side: c is the crank and a the rocker."""
        return SphericalFourBar(self.c, self.b, self.a, self.d)

    # --- extremes ---------------------------------------------------------------------------------------------------

    @property
    def limits(self) -> tuple[CrankRange, ...]:
        """The crank angles for which it can be assembled: one arc, or two mirror images, or none."""
        return _crank_ranges(self.a, self.d, _least(self.b, self.c), _most(self.b, self.c))

    @property
    def dead_centres(self) -> DeadCentres | None:
        """Where the output turns back, on branch ``+`` (the other is its mirror image); None unless a alone turns."""
        if self.turning != ("a",) or self.type is CHANGE_POINT:
            return None
        centres = []
        for reach in (self.a - self.b, self.a + self.b):
            # B is on the great circle of the crank, at the arc `reach` from A0 (negative: on its other side).
            line = (math.cos(self.c) - math.cos(self.d) * math.cos(reach)) / (math.sin(self.d) * math.sin(reach))
            phi = math.copysign(math.acos(clipped_cosine(line)), math.sin(reach))
            psi = math.atan2(
                math.sin(reach) * math.sin(phi),
                math.sin(reach) * math.cos(phi) * math.cos(self.d) - math.cos(reach) * math.sin(self.d),
            )
            centres.append((phi % TURN, psi, phi + math.pi if reach < 0 else phi))
        return DeadCentres.between(*centres)

    @property
    def swing(self) -> float | None:
        """The angle between the dead centres; None if there are none."""
        centres = self.dead_centres
        return None if centres is None else centres.travel

    @property
    def transmission_angle(self) -> TransmissionExtremes:
        """The extremes of the angle between coupler and rocker, at B; `LinkageError` if it cannot be assembled."""
        limits = self.limits
        if not limits:
            arcs = ", ".join(f"{math.degrees(arc):g}" for arc in (self.a, self.b, self.c, self.d))
            raise LinkageError("the spherical four-bar of {arcs} degrees is not assemblable", arcs=arcs)
        first, second = max(limits[0].start, 0.0), min(limits[0].end, math.pi)
        ends = [(phi, self._angle(math.cos(phi))) for phi in (first, second)]
        right = (math.cos(self.b) * math.cos(self.c) - math.cos(self.a) * math.cos(self.d)) / (
            math.sin(self.a) * math.sin(self.d)
        )
        return transmission_extremes(ends[0], ends[1], math.acos(clipped_cosine(right)))

    def _angle(self, cosine: float) -> float:
        """The angle at B for the cosine of the crank's angle, in 0..pi."""
        near, far = self._half(np.array(cosine))
        return 2 * math.atan2(math.sqrt(max(0.0, float(near))), math.sqrt(max(0.0, float(far))))

    def _half(self, cosine: Reals) -> tuple[Reals, Reals]:
        """sin² and cos² of half the angle at B, times sin b sin c: h(f) - h(b - c) and h(b + c) - h(f), f = AB0."""
        across = _h(self.a - self.d) + math.sin(self.a) * math.sin(self.d) * (1 - cosine) / 2
        return np.asarray(across - _h(self.b - self.c)), np.asarray(_h(self.b + self.c) - across)

    # --- motion -----------------------------------------------------------------------------------------------------

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

        >>> cross = SphericalFourBar(*np.radians([90, 90, 90, 30])).motion(0.0, omega=10)
        >>> round(float(cross.output.velocity) * math.cos(math.radians(30)), 9)
        10.0
        """
        a, b, c, d = self.a, self.b, self.c, self.d
        constant = 2 * (_h(c) - _h(b))

        def condition(cosine: Reals, sine: Reals) -> tuple[Reals, Reals, Reals]:
            unit = np.zeros(cosine.shape)
            unit[0] = 1
            across = _h(a - d) * unit + math.sin(a) * math.sin(d) * (unit - cosine) / 2  # sin² of half the arc AB0
            p = math.sin(c) * (math.sin(a) * math.cos(d) * cosine - math.cos(a) * math.sin(d) * unit)
            q = math.sin(c) * math.sin(a) * sine
            return p, q, constant * unit + (2 - 4 * _h(c)) * across

        def transmission(root: Reals, cosine: Reals) -> Reals:
            near, far = self._half(cosine)
            angle = np.arctan2(root, far - near)
            return np.minimum(angle, math.pi - angle)

        size = 2 * (_h(b) + _h(c) + _h(a) + _h(d))
        return output_motion(condition, transmission, self.limits, branch_side(branch), (phi, omega, alpha, jerk), size)

    def linkage(
        self,
        phi: float = 0.0,
        *,
        branch: Branch = None,
        points: Mapping[str, tuple[str, float, float, float]] | None = None,
    ) -> SpatialLinkage:
        """The linkage with the crank at phi as its reference pose; points (link, x, y, z) in that pose.

        Raises `LinkageError` if it cannot be assembled there.
        """
        psi = float(self.motion(as_finite("phi", phi), branch=branch).output.value)
        if not math.isfinite(psi):
            raise LinkageError("the linkage cannot be assembled at phi = {angle:g} degrees", angle=math.degrees(phi))
        a, c, d = self.a, self.c, self.d
        along, across = np.array([math.cos(d), 0, -math.sin(d)]), np.array([0.0, 1, 0])
        b0 = np.array([math.sin(d), 0, math.cos(d)])
        axes = [
            (0.0, 0.0, 1.0),
            (math.sin(a) * math.cos(phi), math.sin(a) * math.sin(phi), math.cos(a)),
            math.cos(c) * b0 + math.sin(c) * (math.cos(psi) * along + math.sin(psi) * across),
            b0,
        ]
        places: dict[str | int, object] = {k: {"z": tuple(axis)} for k, axis in enumerate(np.array(axes).tolist())}
        return SpatialLinkage(Mechanism.parse(_TEXT), places, points=points, outputs=["rocker"])

    def explain(self, lang: str = "en") -> str:
        """Its type, where the crank turns, how far the output swings: lines in English or German (``de``).

        >>> print(SphericalFourBar(*np.radians([30, 80, 60, 70])))
        crank-rocker
        crank angle: full turn
        swing of the output: 74.51°
        smallest transmission angle: ...°
        """
        lines = [self.type.title]
        if self.limits:
            lines.append(message("crank angle: {ranges}", ranges=joined_by_or([arc.title for arc in self.limits])))
            if self.swing is not None:
                lines.append(message("swing of the output: {angle:n}°", angle=math.degrees(self.swing)))
            smallest = math.degrees(self.transmission_angle.smallest.mu)
            lines.append(message("smallest transmission angle: {angle:n}°", angle=smallest))
        return "\n".join(line.in_language(lang) for line in lines)


def _h(arc: float) -> float:
    return math.sin(arc / 2) ** 2


def _least(x: float, y: float) -> float:
    """The shortest arc between the ends of two arcs that turn about a common one."""
    return abs(x - y)


def _most(x: float, y: float) -> float:
    """The longest: beyond half a circle the arc round the other side counts."""
    return min(x + y, TURN - x - y)


def _crank_ranges(a: float, d: float, least: float, most: float) -> tuple[CrankRange, ...]:
    """The crank angles for which A, at the arc a about A0, is between ``least`` and ``most`` from B0."""
    if _most(a, d) < least - _CLOSE or _least(a, d) > most + _CLOSE:
        return ()
    inner, outer = _least(a, d) >= least - _CLOSE, _most(a, d) <= most + _CLOSE

    def angle(reach: float) -> float:
        near, far = _h(reach) - _h(a - d), _h(a + d) - _h(reach)
        return 2 * math.atan2(math.sqrt(max(0.0, near)), math.sqrt(max(0.0, far)))

    return mirrored_ranges(None if inner else angle(least), None if outer else angle(most))
