"""Symmetric double rockers whose coupler point has a path of high contact (Meyer zur Capellen 1956).

In the crossed position of symmetry the velocity pole P is where the rockers' lines meet; t and n are pole tangent and
pole normal. The coupler line lies lambda D from t, the joints A, B on rays from P at the angle phi0 to t; the coupler
point is the inflection pole, D from P. Proofs: docs/theory/straight-line-guidance.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.geometry.lever_contact import LeverContact, lever_contact
from gruebler.mechanics.linkages.branch import branch_of_side
from gruebler.mechanics.linkages.quantities import as_finite, as_positive

_LEAST, _MOST = 0.501, 1.4999  # lambda: towards 0.5 links grow beyond all bounds, towards 1.5 they shrink to nothing
_WIDEST = 2000.0  # longest link by the shortest


@dataclass(frozen=True)
class CouplerLever:
    """A four-bar with a coupler point K: u from A along the coupler, v to its left."""

    size: FourBar
    u: float
    v: float
    branch: str = "+"

    @property
    def k(self) -> float:
        """The side AK of the coupler triangle."""
        return math.hypot(self.u, self.v)

    @property
    def l(self) -> float:  # noqa: E743  the sheet's own letter
        """The side BK of the coupler triangle."""
        return math.hypot(self.size.b - self.u, self.v)

    @property
    def kappa(self) -> float:
        """The angle BAK, positive to the left of AB."""
        return math.atan2(self.v, self.u)


@dataclass(frozen=True)
class SymmetricRocker:
    """A symmetric double rocker with its coupler point in the inflection pole.

    >>> made = symmetric_rocker(5 / 6)
    >>> made.lever.size.type.key, round(made.lever.size.d, 9), round(math.degrees(made.lever.kappa), 6)
    ('grashof_double_rocker', 4.714045208, 15.793169)
    """

    ratio: float
    """The distance of the coupler line from the pole tangent, by D: lambda."""
    phi0: float
    """The angle of the pole rays against the pole tangent."""
    diameter: float
    """Of the inflection circle: D."""

    @property
    def is_six_point(self) -> bool:
        """Whether the tangent in K touches in six points: sin^2 phi0 = (1 + 2 lambda)/4."""
        return abs(math.sin(self.phi0) ** 2 - (1 + 2 * self.ratio) / 4) < 1e-12

    @property
    def pins(self) -> tuple[complex, complex, complex, complex]:
        """A0, A, B, B0 in the position of symmetry, in coordinates t + in with the pole at 0."""
        ray = complex(-math.cos(self.phi0), math.sin(self.phi0))
        from_contact = self.ratio * self.diameter / math.sin(self.phi0)
        from_pole = from_contact - self.savary
        a0, a = ray * from_pole, ray * from_contact
        return a0, a, -a.conjugate(), -a0.conjugate()

    @property
    def savary(self) -> float:
        """The way from A to A0 towards the pole, by Euler and Savary: PA^2/(PA - D sin phi0)."""
        sine = math.sin(self.phi0)
        return self.ratio**2 * self.diameter / (sine * (self.ratio - sine**2))

    @property
    def point(self) -> complex:
        """K, the inflection pole, in the same coordinates."""
        return 1j * self.diameter

    @property
    def lever(self) -> CouplerLever:
        """The double rocker as a four-bar with its coupler point."""
        a0, a, b, b0 = self.pins
        along = (b - a) / abs(b - a)
        arm = (self.point - a) / along
        size = FourBar(abs(a - a0), abs(b - a), abs(b - b0), abs(b0 - a0))
        side = ((b0 - a).conjugate() * (b - a)).imag
        return CouplerLever(size, arm.real, arm.imag, branch_of_side(side))

    @property
    def phi(self) -> float:
        """The angle of A0A against A0B0 in the position of symmetry."""
        a0, a, _, b0 = self.pins
        turned = (a - a0) / (b0 - a0)
        return math.atan2(turned.imag, turned.real) % (2 * math.pi)

    def contact(self) -> LeverContact:
        """How the path of K touches its tangent there: points in common, coefficient."""
        lever = self.lever
        return lever_contact(lever.size, lever.u, lever.v, self.phi, branch=lever.branch)

    def replacement(self, crank: float = 1.0) -> CouplerLever:
        """The isosceles four-bar that draws the same coupler curve, with l1 = ``crank``; the third is its mirror image.

        With k' = KA, l1' ... l4' of the double rocker and s = crank/k':
        l1 = k's, l2 = l3 = l = l1'k's/l2', l4 = l4'k's/l2', k = l1's.

        >>> made = symmetric_rocker(0.75).replacement()
        >>> made.size.a, round(made.size.b**2, 9), round(made.size.d, 9), round(made.k, 9)
        (1.0, 24.0, 5.0, 9.0)
        """
        lever = self.lever
        scale = as_positive("crank", crank) / lever.k
        side = lever.size.a * lever.k / lever.size.b * scale
        size = FourBar(as_positive("crank", crank), side, side, lever.size.d * lever.k / lever.size.b * scale)
        kappa = lever.kappa
        arm = lever.size.a * scale
        return CouplerLever(size, arm * math.cos(kappa), arm * math.sin(kappa))


def symmetric_rocker(ratio: float, phi0: float | None = None, diameter: float = 1.0) -> SymmetricRocker:
    """The double rocker of a ratio lambda; without ``phi0`` (radians) the one with contact in six points.

    With another phi0 the contact has four points (*Zykloidenlenker*).

    Raises `LinkageError` for lambda outside 0.5 ... 1.5 (the ends give no linkage), an angle outside 0 ... 90 degrees,
    or where lengths run away: rockers of infinite length (sin^2 phi0 = lambda), links 2000 times as long as others.

    >>> symmetric_rocker(5 / 6).contact().points, symmetric_rocker(0.8, math.radians(50)).contact().points
    (6, 4)
    """
    place = as_finite("lambda", ratio)
    length = as_positive("D", diameter)
    if phi0 is None:
        if not 0.5 < place < 1.5:
            raise LinkageError("lambda must lie between 0.5 and 1.5, both excluded, not {ratio!r}", ratio=ratio)
        return _sound(SymmetricRocker(place, math.asin(math.sqrt((1 + 2 * place) / 4)), length))
    angle = as_finite("phi0", phi0)
    if not 0 < angle < math.pi / 2:
        raise LinkageError(
            "phi0 must lie between 0 and 90 degrees, both excluded, not {angle:g} degrees", angle=math.degrees(angle)
        )
    if place <= 0:
        raise LinkageError("lambda must be positive, not {ratio!r}", ratio=ratio)
    return _sound(SymmetricRocker(place, angle, length))


def _sound(rocker: SymmetricRocker) -> SymmetricRocker:
    """The same, unless its proportions run away."""
    if abs(rocker.ratio - math.sin(rocker.phi0) ** 2) < 1e-9:
        raise LinkageError("the rockers have no finite length: sin^2 phi0 = lambda")
    a0, a, b, b0 = rocker.pins
    lengths = abs(a - a0), abs(b - a), abs(b0 - a0)
    if not max(lengths) < _WIDEST * min(lengths):
        raise LinkageError(
            "lambda = {ratio:.9g} and phi0 = {phi0:.9g} degrees make no linkage that can be built: its links "
            "differ more than {widest:g}-fold in length",
            ratio=rocker.ratio,
            phi0=math.degrees(rocker.phi0),
            widest=_WIDEST,
        )
    return rocker


def lambdas_for(kappa: float) -> tuple[float, ...]:
    """The ratios lambda for which the straight line makes the angle kappa (radians) with A0B0, the smaller first.

    lambda^2 (3 - 2 lambda) = cos^2 kappa has the roots 1/2 + cos((pi + 2 kappa)/3), and that with -kappa; the first
    has the coupler point to the left of AB, the second to the right. From 45 degrees on only the second is left; a
    root below 0.501 (from 44.914 degrees on) makes no sensible linkage, nor does one above 1.4999.

    Raises `LinkageError` for an angle outside 0 ... 88.78 degrees.

    >>> [round(value, 9) for value in lambdas_for(math.radians(30))]
    [0.673648178, 1.266044443]
    """
    angle = as_finite("kappa", kappa)
    both = [0.5 + math.cos((math.pi + side * angle) / 3) for side in (2, -2)]
    lambdas = tuple(dict.fromkeys(value for value in both if _LEAST <= value <= _MOST))
    if not 0 <= angle < math.pi / 2 or not lambdas:
        raise LinkageError("kappa must lie from 0 to 88.78 degrees, not {angle:.9g} degrees", angle=math.degrees(angle))
    return lambdas
