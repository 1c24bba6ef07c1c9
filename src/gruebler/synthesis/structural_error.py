"""By how much a linkage misses a function, and the linkage nearby that misses it least.

docs/theory/synthesis-functions.md has the derivatives and the method.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from gruebler.arrays import Reals
from gruebler.errors import SynthesisError
from gruebler.synthesis.coordination import Coordination, Minimax
from gruebler.synthesis.formulas import FunctionLaw, chebyshev_spacing
from gruebler.synthesis.results import Design
from gruebler.synthesis.tasks import FunctionTask

__all__ = ["coordination_of", "error_extremes", "largest_error", "minimax", "structural_error"]

_SAMPLES = 121
_ZOOMS, _PARTS = 4, 20
"""How often the surroundings of an extreme are divided, and into how many parts: 1e-5 of the samples' distance is left,
which changes the extreme by less than 1e-9 of itself."""


def coordination_of(design: Design, task: FunctionTask, law: FunctionLaw) -> Coordination | None:
    """The lengths and starts of a four-bar or slider-crank that was made for a function; None for another linkage.

    The starts are those of x at the begin of the interval.
    """
    linkage = design.linkage
    chain, reference_pose = linkage.mechanism.chain, linkage.reference_pose
    if reference_pose is None or any(not joint.pair.is_revolute for joint in chain.joints[:3]):
        return None
    places = [
        complex(*reference_pose[link].put(linkage.elements[number, link].x, linkage.elements[number, link].y))
        for number, link in ((0, "frame"), (0, "crank"), (1, "crank"), (2, "coupler"), (3, "frame"))
    ]
    pivot, pin, far, other = places[0], places[2], places[3], places[4]
    x = chebyshev_spacing(*law.interval, len(task))[:1]
    free = replace(law, input_start=0.0, output_start=0.0)
    crank = float(np.angle(pin - pivot)) - float(free.inputs(x)[0])
    if task.output == "angle":
        lengths = (abs(pin - pivot), abs(far - pin), abs(far - other), abs(other - pivot))
        side = np.imag(np.conj(other - pin) * (far - pin))
        output = float(np.angle((far - other) / (other - pivot))) - float(free.outputs(x)[0])
        return Coordination("four-bar", lengths, crank, output, 1 if side >= 0 else -1)
    output = far.real - float(free.outputs(x)[0])
    lengths_ = (abs(pin - pivot), abs(far - pin), far.imag - pivot.imag)
    return Coordination("slider-crank", lengths_, crank, output, 1 if far.real >= pin.real else -1)


def structural_error(solution: Coordination, law: FunctionLaw, x: ArrayLike) -> Reals:
    """The output of a linkage less the output wanted, over x; angles in radians. NaN where it cannot be assembled.

    The linkage starts as its first precision pair says. Cost: 50 us and 0.1 us a point.
    """
    return _errors(solution, law, np.atleast_1d(np.asarray(x, np.float64)))[0]


def _errors(solution: Coordination, law: FunctionLaw, x: Reals) -> tuple[Reals, Reals]:
    """Errors and their derivatives by the lengths (without d), input start and output start."""
    free_law = replace(law, input_start=0.0, output_start=0.0)
    phi = solution.input_start + free_law.inputs(x)
    wanted = solution.output_start + free_law.outputs(x)
    motion = solution.linkage().motion(phi, branch=solution.branch)
    theta, output = np.asarray(motion.coupler.value), np.asarray(motion.output.value)
    a = solution.lengths[0]
    if solution.kind == "four-bar":
        error = np.angle(np.exp(1j * (output - wanted)))
        c = solution.lengths[2]
        divisor = c * np.sin(output - theta)
        rows = [-np.cos(phi - theta), -np.ones_like(phi), np.cos(output - theta), a * np.sin(phi - theta)]
    else:
        error = output - wanted
        divisor = np.cos(theta)
        rows = [np.cos(phi - theta), np.ones_like(phi), -np.sin(theta), -a * np.sin(phi - theta)]
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = np.stack([*(row / divisor for row in rows), -np.ones_like(phi)], axis=1)
    return error, slopes


def largest_error(solution: Coordination, law: FunctionLaw) -> float:
    """The largest structural error over the whole interval, in radians or the unit of the travel.

    Infinite where the linkage cannot be assembled throughout. Cost: 1 ms.

    >>> law = FunctionLaw("x**2", (0, 1), np.pi / 2, np.pi / 2)
    >>> linkage = Coordination("four-bar", (0.8, 1.1, 0.9, 1.0), 0.5, 0.9, 1)
    >>> round(largest_error(linkage, law), 6) >= round(float(np.abs(structural_error(linkage, law, 0.3))[0]), 6)
    True
    """
    return _extremes(solution, law)[0]


def error_extremes(solution: Coordination, law: FunctionLaw) -> Reals:
    """(extremes,) x where the structural error has an extreme, and both ends of the interval.

    Empty if the linkage cannot be assembled throughout.
    """
    return _extremes(solution, law)[1]


def _sample_points(law: FunctionLaw) -> Reals:
    """(samples,) values of x over the interval, its ends among them, denser there."""
    low, high = law.interval
    return np.asarray((low + high) / 2 - (high - low) / 2 * np.cos(np.pi * np.arange(_SAMPLES) / (_SAMPLES - 1)))


def _extremes(solution: Coordination, law: FunctionLaw) -> tuple[float, Reals]:
    """The largest structural error, and x at every extreme and both ends; infinite and no x if there is a gap."""
    x = _sample_points(law)
    size = np.abs(structural_error(solution, law, x))
    if not np.isfinite(size).all():
        return float("inf"), np.empty(0)
    rises = np.concatenate([[True], size[1:] >= size[:-1]])
    falls = np.concatenate([size[:-1] >= size[1:], [True]])
    peaks = np.flatnonzero(rises & falls | (np.arange(len(x)) % (len(x) - 1) == 0))
    low, high = x[np.maximum(peaks - 1, 0)], x[np.minimum(peaks + 1, len(x) - 1)]
    rows = np.arange(len(peaks))
    for _ in range(_ZOOMS):
        near = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, _PARTS + 1)
        size = np.abs(structural_error(solution, law, near.ravel())).reshape(near.shape)
        size[np.isnan(size)] = np.inf
        best = size.argmax(axis=1)
        low, high = near[rows, np.maximum(best - 1, 0)], near[rows, np.minimum(best + 1, _PARTS)]
    return float(size.max()), near[rows, best]


def minimax(start: Coordination, law: FunctionLaw, *, steps: int = 60) -> Minimax:
    """Make the largest structural error as small as possible, from a linkage nearby.

    Each step is a linear programme in a region that shrinks when it does not help; its conditions stand at samples of
    the interval and at all extremes of the error. The starts that the law gives stay fixed. Cost: 6 ms a step. Raises
    `SynthesisError` if the start cannot be assembled throughout.

    >>> law = FunctionLaw("x**2", (0, 1), np.pi / 2, np.pi / 2)
    >>> begin = Coordination("four-bar", (0.8, 1.1, 0.9, 1.0), 0.5, 0.9, 1)
    >>> best = minimax(begin, law, steps=5)
    >>> best.error < best.start_error
    True
    """
    from scipy.optimize import linprog

    if start.kind == "inverted-slider-crank":
        raise SynthesisError("the minimax optimum is sought of four-bars and slider-cranks")
    (error, peaks), best = _extremes(start, law), start
    if not np.isfinite(error):
        raise SynthesisError("the linkage from which the search is to begin cannot be assembled throughout")
    first, radius = error, 0.05
    scale = np.array([max(abs(v), 0.1) for v in start.lengths[:3]] + [1.0, 1.0 if start.kind == "four-bar" else 0.1])
    if start.kind == "slider-crank":
        scale[:3] = max(start.lengths[1], abs(law.output_swing))
        scale[4] = abs(law.output_swing)
    held = [law.input_start is not None, law.output_start is not None]
    for _ in range(steps):
        values, slopes = _errors(best, law, np.concatenate([_sample_points(law), peaks]))
        slopes = slopes * scale
        ones = np.ones((len(values), 1))
        matrix = np.block([[slopes, -ones], [-slopes, -ones]])
        limits = [(-radius, radius)] * 3 + [(0, 0) if h else (-radius, radius) for h in held] + [(0, None)]
        answer = linprog([0] * 5 + [1], A_ub=matrix, b_ub=np.concatenate([-values, values]), bounds=limits)
        if answer.status != 0:
            break
        moved = _moved(best, answer.x[:5] * scale)
        trial, its = (float("inf"), peaks) if moved is None else _extremes(moved, law)
        if moved is not None and trial < error:
            gained, best, error, peaks = error - trial, moved, trial, its
            radius = min(radius * 1.5, 0.3)
            if gained < 1e-10 * error:
                break
        else:
            radius *= 0.35
            if radius < 1e-10:
                break
    return Minimax(best, error, first)


def _moved(solution: Coordination, step: Reals) -> Coordination | None:
    lengths = [*(v + s for v, s in zip(solution.lengths[:3], step[:3], strict=True)), *solution.lengths[3:]]
    positive: Sequence[float] = lengths if solution.kind == "four-bar" else lengths[:2]
    if min(positive) <= 0:
        return None
    return solution._replace(
        lengths=tuple(float(v) for v in lengths),
        input_start=solution.input_start + float(step[3]),
        output_start=solution.output_start + float(step[4]),
    )
