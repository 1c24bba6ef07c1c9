"""By how much a linkage misses a function, and the linkage nearby that misses it least.

docs/theory/synthesis-functions.md has the derivatives and the method.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gruebler.arrays import Reals
from gruebler.errors import SynthesisError
from gruebler.kinematics import move
from gruebler.linkages import Linkage
from gruebler.synthesis.coordination import Coordination
from gruebler.synthesis.formulas import FunctionLaw, chebyshev_spacing
from gruebler.synthesis.results import Design
from gruebler.synthesis.tasks import FunctionTask

__all__ = ["Minimax", "coordination_of", "minimax", "structural_error"]


def coordination_of(design: Design, task: FunctionTask, law: FunctionLaw) -> Coordination | None:
    """The lengths and starts of a four-bar or slider-crank that was made for a function; None for another linkage.

    The starts are those of x at the begin of the interval.
    """
    linkage = design.linkage
    chain, reference_pose = linkage.mechanism.chain, linkage.reference_pose
    if reference_pose is None or any(not joint.pair.is_revolute for joint in chain.joints[:3]):
        return None
    places = [
        complex(*reference_pose[link].put(*linkage.elements[number, link][:2]))
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


class Minimax(NamedTuple):
    """A linkage whose largest structural error is as small as possible nearby."""

    solution: Coordination
    error: float
    """The largest structural error, in radians or the unit of the travel."""
    start_error: float
    """The same of the linkage from which the search began."""

    def linkage(self, unit: str = "mm") -> Linkage:
        """The linkage in the position where the interval begins, on its branch."""
        solution = self.solution
        own = solution.linkage().linkage(unit=unit)
        start = move(own, [solution.input_start], branch="+" if solution.branch > 0 else "-")
        return own.with_reference_pose(start.pose(0))


def minimax(start: Coordination, law: FunctionLaw, *, samples: int = 121, steps: int = 60) -> Minimax:
    """Make the largest structural error as small as possible, from a linkage nearby.

    Each step is a linear programme in a region that shrinks when it does not help. The starts that the law gives stay
    fixed. Cost: 5 ms a step. Raises `SynthesisError` if the start cannot be assembled throughout.

    >>> law = FunctionLaw("x**2", (0, 1), np.pi / 2, np.pi / 2)
    >>> begin = Coordination("four-bar", (0.8, 1.1, 0.9, 1.0), 0.5, 0.9, 1)
    >>> best = minimax(begin, law, steps=5)
    >>> best.error < best.start_error
    True
    """
    from scipy.optimize import linprog

    if start.kind == "inverted-slider-crank":
        raise SynthesisError("the minimax optimum is sought of four-bars and slider-cranks")
    k = np.arange(samples)
    low, high = law.interval
    x = (low + high) / 2 - (high - low) / 2 * np.cos(np.pi * k / (samples - 1))  # the ends count

    def worst(solution: Coordination) -> float:
        error = structural_error(solution, law, x)
        return float(np.abs(error).max()) if np.isfinite(error).all() else float("inf")

    best, error = start, worst(start)
    if not np.isfinite(error):
        raise SynthesisError("the linkage from which the search is to begin cannot be assembled throughout")
    first, radius = error, 0.05
    scale = np.array([max(abs(v), 0.1) for v in start.lengths[:3]] + [1.0, 1.0 if start.kind == "four-bar" else 0.1])
    if start.kind == "slider-crank":
        scale[:3] = max(start.lengths[1], abs(law.output_swing))
        scale[4] = abs(law.output_swing)
    held = [law.input_start is not None, law.output_start is not None]
    for _ in range(steps):
        values, slopes = _errors(best, law, x)
        slopes = slopes * scale
        ones = np.ones((samples, 1))
        matrix = np.block([[slopes, -ones], [-slopes, -ones]])
        limits = [(-radius, radius)] * 3 + [(0, 0) if h else (-radius, radius) for h in held] + [(0, None)]
        answer = linprog([0] * 5 + [1], A_ub=matrix, b_ub=np.concatenate([-values, values]), bounds=limits)
        if answer.status != 0:
            break
        moved = _moved(best, answer.x[:5] * scale)
        trial = float("inf") if moved is None else worst(moved)
        if moved is not None and trial < error:
            gained, best, error = error - trial, moved, trial
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
