"""Poses in which the joints can only just be closed: Newton's method stops beside them.

Where a constraint becomes redundant, a pose that is closed up to a residual r is off by about the root of r, and so is
the singular value that should be zero. docs/theory/freedoms.md.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.closing import Closing
from gruebler.mechanics.screws.instant_mobility import InstantMobility, instant_mobility
from gruebler.mechanics.screws.obstruction import ObstructionMap

_ROUNDING = 1e-16  # no residual is known better
_SAFETY = 3.0  # by which the root of the residual is taken larger
_WORSE = 4.0  # by how much the residual may grow on the way to the double root
_MOST = 12  # steps of Newton's method: at a simple zero of F' five reach the rounding
_FORMS_RANK = 1e-6  # of the largest: second derivatives by differences are known to that, so less is zero
_ZERO = 1e-10  # singular values at a double root, against the largest: such a pose is found to rounding


def _gap(closing: Closing, pose: Reals) -> float:
    """By how much the joints are open, as far as that can be known."""
    return max(float(abs(closing.residual(pose)).max(initial=0.0)), _ROUNDING)


def _blur(closing: Closing, pose: Reals) -> float:
    """Singular values, against the largest, that the error of a pose may have made out of zero."""
    return _SAFETY * math.sqrt(_gap(closing, pose))


def is_near_double_root(instant: InstantMobility) -> bool:
    """Whether the smallest singular value that counts may be zero as well."""
    return instant.rank > 0 and instant.gap[0] < _blur(instant.closing, instant.pose)


def refined_at_double_root(closing: Closing, pose: Reals) -> Reals:
    """The pose beside this one in which the constraints that the blur may hide are redundant; itself if there is none.

    In the map F of `ObstructionMap` such a pose is a point with F = 0 and F' = 0: F' is made zero by Newton's method.
    """
    instant = instant_mobility(closing, pose, _ZERO)
    if not is_near_double_root(instant):
        return pose
    loose = replace(instant, tolerance=_blur(closing, pose))
    excess = ObstructionMap(loose)
    forms, k = excess.second(), np.zeros(loose.mobility)
    point = excess(k)
    for _ in range(_MOST):
        if forms is None or point is None:
            return pose
        k = k - np.linalg.lstsq(forms.reshape(-1, loose.mobility), point.slope.ravel(), rcond=_FORMS_RANK)[0]
        point = excess(k)
    if point is None:
        return pose
    refined = closing.moved(pose, point.motion)
    closed = _gap(closing, refined) <= _WORSE * _gap(closing, pose)
    return refined if closed and instant_mobility(closing, refined, _ZERO).rank == loose.rank else pose
