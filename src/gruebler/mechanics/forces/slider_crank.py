"""What the slider of a slider-crank rubs, in closed form."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.fourbar import SliderCrank
from gruebler.mechanics.linkages.quantities import as_finite

_AT_REST = 1e-9  # of the crank's speed: a slower slider has no direction


class SliderFriction(NamedTuple):
    """Forces of a slider-crank whose slider carries a load along its path; all of the shape of the crank angles."""

    alpha: Reals
    """The deviation angle of the coupler from the path, in radians; positive where the coupler rises to the slider's
    side."""
    coupler: Reals
    """F_K along the coupler, in the unit of the load."""
    side: Reals
    """F_N = F_K sin(alpha), at right angles to the path, in the unit of the load."""
    friction: Reals
    """F_R = mu_R |F_N|, a magnitude, in the unit of the load."""


def slider_friction(
    size: SliderCrank, phi: npt.ArrayLike, load: float, coefficient: float, *, backward: bool = False
) -> SliderFriction:
    """Side force and friction of a slider-crank, F_K cos(alpha) = F ± mu_R |F_N|, F_N = F_K sin(alpha).

    Plus where the slider moves against the load. Solved: F_K = F/(cos(alpha) ∓ mu_R |sin(alpha)|); NaN where
    mu_R |tan(alpha)| >= 1 against the load, since there the slider-crank locks. In a dead centre there is
    no friction. The pins do not rub, the guide is long.

    Args:
        size: the slider-crank.
        phi: crank angles in radians.
        load: F, the force along the slider's path, positive towards the crank.
        coefficient: mu_R, not to be mixed up with the transmission angle mu.
        backward: whether the crank turns clockwise.

    Raises `LinkageError` at crank angles that cannot be assembled, or where the coupler is at right angles to the path.

    >>> found = slider_friction(SliderCrank(2, 5), -np.pi / 2, load=100, coefficient=0.1)  # the slider goes forth
    >>> round(float(np.degrees(found.alpha)), 6), round(float(found.side / found.coupler), 9)
    (-23.578178, -0.4)
    >>> round(float(found.friction), 6)  # 10 tan(alpha)/(1 - 0.1 tan(alpha))
    4.563526
    """
    force, mu = as_finite("load", load), as_finite("coefficient", coefficient)
    if mu < 0:
        raise LinkageError("{name} is not negative, but found {found!r}", name="coefficient", found=coefficient)
    angles = np.asarray(phi, np.float64)
    sine = (size.a * np.sin(angles) - size.e) / size.b
    if not (np.abs(sine) < 1).all():
        raise LinkageError(
            "the slider-crank transmits no force, or cannot be assembled, at some of the crank angles: "
            "sin(alpha) = {sine:.6g}",
            sine=float(np.abs(sine).max()),
        )
    alpha = np.arcsin(sine)
    rate = np.sin(angles + alpha) * (1 if backward else -1)  # ds/dphi = -a sin(phi + alpha)/cos(alpha)
    away = np.where(np.abs(rate) <= _AT_REST, 0.0, np.sign(rate))
    left = np.cos(alpha) - mu * np.abs(sine) * away * np.sign(force)
    coupler = np.where(left > 0, force / np.where(left > 0, left, 1.0), np.nan)
    return SliderFriction(alpha, coupler, coupler * sine, mu * np.abs(coupler * sine * away))
