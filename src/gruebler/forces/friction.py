"""What a slide rubs: estimates from the forces without friction."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from gruebler.arrays import Reals
from gruebler.errors import LinkageError
from gruebler.forces.motion_rates import with_velocities
from gruebler.forces.solution import Statics
from gruebler.fourbar import SliderCrank
from gruebler.linkages.quantities import as_finite

__all__ = ["SlideFriction", "SliderFriction", "as_friction", "slide_friction", "slider_friction"]


class SliderFriction(NamedTuple):
    """Forces of a slider-crank whose slider carries a load along its path; all of the shape of the crank angles."""

    alpha: Reals
    """The deviation angle of the coupler from the path, in radians; positive where the coupler rises to the slider's
    side."""
    coupler: Reals
    """F_K along the coupler."""
    side: Reals
    """F_N = F_K sin(alpha), at right angles to the path."""
    friction: Reals
    """F_R = mu_R F_N, a magnitude."""


class SlideFriction(NamedTuple):
    """What a slide of any linkage rubs; all arrays are (rows,)."""

    side: Reals
    """The size of the normal force."""
    friction: Reals
    """mu_R times that."""
    effort: Reals
    """What the friction adds to the drive's torque or force while the drive goes forward."""


def slider_friction(size: SliderCrank, phi: npt.ArrayLike, load: float, coefficient: float) -> SliderFriction:
    """Side force and friction of a slider-crank, F_K = F/cos(alpha), F_N = F_K sin(alpha), F_R = mu_R F_N.

    An estimate: the friction itself is left out of the equilibrium, an error of the part mu_R tan(alpha).

    Args:
        size: the slider-crank.
        phi: crank angles in radians.
        load: F, the force along the slider's path.
        coefficient: mu_R, not to be mixed up with the transmission angle mu.

    Raises `LinkageError` at crank angles that cannot be assembled, or where the coupler is at right angles to the path.

    >>> found = slider_friction(SliderCrank(2, 5), np.pi / 2, load=100, coefficient=0.1)
    >>> round(float(np.degrees(found.alpha)), 6), round(float(found.side / found.coupler), 9)
    (23.578178, 0.4)
    """
    force, mu = as_finite("load", load), as_friction(coefficient)
    angles = np.asarray(phi, np.float64)
    sine = (size.a * np.sin(angles) - size.e) / size.b
    if not (np.abs(sine) < 1).all():
        raise LinkageError(
            "the slider-crank transmits no force, or cannot be assembled, at some of the crank angles: "
            "sin(alpha) = {sine:.6g}",
            sine=float(np.abs(sine).max()),
        )
    alpha = np.arcsin(sine)
    coupler = force / np.cos(alpha)
    return SliderFriction(alpha, coupler, coupler * sine, mu * np.abs(coupler * sine))


def slide_friction(statics: Statics, joint: str | int, coefficient: float) -> SlideFriction:
    """Side force and friction of any sliding joint, from the equilibrium without friction.

    Raises `LinkageError` for a joint that does not slide and for a linkage with several drives.
    """
    linkage = statics.motion.linkage
    number, mu = linkage.mechanism.chain.joint_number(joint, LinkageError), as_friction(coefficient)
    if not linkage.mechanism.chain.joints[number].pair.slides_along_one_line:
        raise LinkageError("{joint} does not slide along one line", joint=linkage.mechanism.chain.joint_title(number))
    if len(linkage.mechanism.drives) != 1:
        raise LinkageError(
            "friction is computed for one drive; this linkage has {count}", count=len(linkage.mechanism.drives)
        )
    side: Reals = np.hypot(*statics.force(number).T)
    rate = np.full(len(side), np.nan)
    for rows, moved in with_velocities(statics.motion, np.ones(1)):
        rate[rows] = np.abs(moved.displacement(number, 1))
    return SlideFriction(side, mu * side, mu * side * rate)


def as_friction(value: float) -> float:
    """A coefficient of friction; `LinkageError` for one that is negative or not finite."""
    mu = as_finite("coefficient", value)
    if mu < 0:
        raise LinkageError("a coefficient of friction is not negative, but found {found!r}", found=value)
    return mu
