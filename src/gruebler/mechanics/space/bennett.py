"""Bennett's linkage in closed form: four turning joints on skew axes that move although they should not."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.base.immutable import settle
from gruebler.mechanics.linkages.quantities import as_finite, as_positive
from gruebler.mechanics.screws.model import SpatialLinkage


@dataclass(frozen=True, slots=True)
class Bennett:
    """Bennett's linkage: opposite links alike, lengths a and b in the ratio of the sines of their twists.

    Links and twists in turn: (a, alpha), (b, beta), (a, alpha), (b, beta), a : b = sin alpha : sin beta.

    Args:
        a: the common normal of the axes of the first link, a length.
        alpha: the angle between these axes, in radians, between 0 and pi.
        beta: that of the second link, not alpha.

    Raises:
        LinkageError: angles outside 0 and pi, or equal (a rhombus on skew axes, whose two motions meet in a position).

    Example:
        >>> linkage = Bennett(2.0, 0.7, 1.1)
        >>> round(linkage.b, 6), round(float(linkage.second_angle(1.0)), 6)
        (2.766789, 2.866237)

    See Also:
        `SphericalFourBar`, `move`

    Theory:
        docs/theory/closed-forms-in-space.md
    """

    a: float
    alpha: float
    beta: float

    def __post_init__(self) -> None:
        settle(self, a=as_positive("a", self.a))
        for name in ("alpha", "beta"):
            angle = as_finite(name, getattr(self, name))
            if not 1e-9 < angle < math.pi - 1e-9:
                raise LinkageError("{name} must lie between 0 and pi, not {value!r}", name=name, value=angle)
            settle(self, **{name: angle})
        if abs(self.alpha - self.beta) < 1e-9:
            raise LinkageError("alpha and beta must differ: with equal ones two motions meet where both angles are pi")

    @property
    def b(self) -> float:
        """The common normal of the second link: a sin beta / sin alpha."""
        return self.a * math.sin(self.beta) / math.sin(self.alpha)

    @property
    def product(self) -> float:
        """tan(θ₁/2) tan(θ₂/2), constant: sin((beta + alpha)/2) / sin((beta - alpha)/2)."""
        return math.sin((self.beta + self.alpha) / 2) / math.sin((self.beta - self.alpha) / 2)

    def second_angle(self, first: npt.ArrayLike) -> Reals:
        """The Denavit-Hartenberg angle θ₂ for θ₁, in radians, in -pi..pi; θ₃ = -θ₁, θ₄ = -θ₂."""
        half = np.asarray(first, float) / 2
        above, below = (math.sin((self.beta + sign * self.alpha) / 2) for sign in (1, -1))
        second = 2 * np.arctan2(above * np.cos(half), below * np.sin(half))
        return np.asarray((second + math.pi) % (2 * math.pi) - math.pi)

    def speed_ratio(self, first: npt.ArrayLike) -> Reals:
        """dθ₂/dθ₁, of any shape: -k / (k² cos² + sin²) of half θ₁, with k = ``product``."""
        half = np.asarray(first, float) / 2
        k = self.product
        return np.asarray(-k / (k**2 * np.cos(half) ** 2 + np.sin(half) ** 2))

    def linkage(self, first: float = 1.0, *, unit: str = "mm") -> SpatialLinkage:
        """The linkage with θ₁ in its reference pose; the drive is that joint."""
        theta = as_finite("first", first)
        two = float(self.second_angle(theta))
        turns, lengths, twists = (theta, two, -theta, -two), (self.a, self.b) * 2, (self.alpha, self.beta) * 2
        rows = [(turns[k], 0.0, lengths[k], twists[k]) for k in range(4)]
        return SpatialLinkage.from_dh(rows, unit=unit)
