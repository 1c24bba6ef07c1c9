"""What the slider of a slider-crank rubs, in closed form."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class SliderFriction(NamedTuple):
    """Forces of a slider-crank whose slider carries a load along its path; all of the shape of the crank angles."""

    alpha: np.ndarray
    """The deviation angle of the coupler from the path, in radians; positive where the coupler rises to the slider's
    side."""
    coupler: np.ndarray
    """F_K along the coupler, in the unit of the load."""
    side: np.ndarray
    """F_N = F_K sin(alpha), at right angles to the path, in the unit of the load."""
    friction: np.ndarray
    """F_R = mu_R |F_N|, a magnitude, in the unit of the load."""


def slider_friction(size, phi, load, coefficient, *, backward=False):
    """Side force and friction of a slider-crank, F_K cos(alpha) = F ± mu_R |F_N|, F_N = F_K sin(alpha).

    Plus where the slider moves against the load. Solved: F_K = F/(cos(alpha) ∓ mu_R |sin(alpha)|). In a dead centre
    there is no friction. The pins do not rub, the guide is long.

    Args:
        size: the slider-crank.
        phi: crank angles in radians.
        load: F, the force along the slider's path, positive towards the crank.
        coefficient: mu_R, not to be mixed up with the transmission angle mu.
        backward: whether the crank turns clockwise.
    """
    angles = np.asarray(phi, np.float64)
    sine = (size.a * np.sin(angles) - size.e) / size.b
    alpha = np.arcsin(sine)
    rate = np.sin(angles + alpha) * (1 if backward else -1)  # ds/dphi = -a sin(phi + alpha)/cos(alpha)
    away = np.where(np.abs(rate) <= 1e-9, 0.0, np.sign(rate))  # a slower slider has no direction
    coupler = load / (np.cos(alpha) - coefficient * np.abs(sine) * away * np.sign(load))
    return SliderFriction(alpha, coupler, coupler * sine, coefficient * np.abs(coupler * sine * away))
