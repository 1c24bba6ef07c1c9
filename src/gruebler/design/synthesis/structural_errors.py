"""By how much a linkage misses a function: the error over the whole interval, its extremes, its derivatives.

docs/theory/synthesis-functions.md: the output angle or travel solves Freudenstein's equation, which is linear in three
numbers of the linkage.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals
from gruebler.base.errors import SynthesisError
from gruebler.base.formulas import Formula
from gruebler.design.synthesis.coordination import KINDS, Coordination, CoordinationKind
from gruebler.design.synthesis.formulas import FunctionLaw, chebyshev_spacing
from gruebler.design.synthesis.freudenstein import EQUATIONS, Equation, errors_and_slopes, linkage_of_numbers
from gruebler.design.synthesis.results import Design
from gruebler.design.synthesis.tasks import FunctionTask

_SAMPLES = 121
_ZOOMS, _PARTS = 4, 20
"""How often the surroundings of an extreme are divided, and into how many parts: 1e-5 of the samples' distance is left,
which changes the extreme by less than 1e-9 of itself."""
_WIDTH = 2e-3
"""Of the interval: the distance of values from which derivatives by x are taken."""


def coordination_of(design: Design, task: FunctionTask, law: FunctionLaw) -> Coordination | None:
    """The lengths and starts of a four-bar or slider-crank that was made for a function; None for another linkage.

    The starts are those of x at the begin of the interval.
    """
    places = _pins(design)
    if places is None:
        return None
    pivot, pin, far, other = places
    x = chebyshev_spacing(*law.interval, len(task))[:1]
    free = replace(law, input_start=0.0, output_start=0.0)
    crank = float(np.angle(pin - pivot)) - float(free.inputs(x)[0])
    if task.output == "angle":
        lengths = (abs(pin - pivot), abs(far - pin), abs(far - other), abs(other - pivot))
        side = np.imag(np.conj(other - pin) * (far - pin))
        output = float(np.angle((far - other) / (other - pivot))) - float(free.outputs(x)[0])
        return Coordination(
            "four-bar", lengths=lengths, input_start=crank, output_start=output, side=1 if side >= 0 else -1
        )
    output = far.real - float(free.outputs(x)[0])
    lengths_ = (abs(pin - pivot), abs(far - pin), far.imag - pivot.imag)
    return Coordination(
        "slider-crank", lengths=lengths_, input_start=crank, output_start=output, side=1 if far.real >= pin.real else -1
    )


def _pins(design: Design) -> tuple[complex, complex, complex, complex] | None:
    """Pivot and pin of the crank, the other pin of the coupler, the pivot of the rocker or a point of its slide."""
    linkage = design.linkage
    chain, pose = linkage.mechanism.chain, linkage.reference_pose
    if pose is None or any(not joint.pair.is_turning for joint in chain.joints[:3]):
        return None
    a0, a, b, b0 = (
        complex(*pose[link].put(linkage.elements[number, link].x, linkage.elements[number, link].y))
        for number, link in ((0, "frame"), (1, "crank"), (2, "coupler"), (3, "frame"))
    )
    return a0, a, b, b0


def links_turned_round(design: Design, task: FunctionTask) -> list[str]:
    """Which of crank and rocker point away from the angle that a task of given starts has for them.

    The condition holds for the lines of the links, so that a link may lie at 180 degrees to the angle of its shaft.
    """
    places = _pins(design)
    if places is None:
        return []
    pivot, pin, far, other = places
    away = []
    if task.start_input and np.real((pin - pivot) * np.exp(-1j * task.inputs[0])) < 0:
        away.append("crank")
    if task.start_output and task.output == "angle" and np.real((far - other) * np.exp(-1j * task.outputs[0])) < 0:
        away.append("rocker")
    return away


def structural_error(solution: Coordination, law: FunctionLaw, x: ArrayLike) -> Reals:
    """The output of a linkage less the output wanted, over x; angles in radians. NaN where it cannot be assembled.

    The linkage starts as its first precision pair says. Raises `SynthesisError` for inverted slider-cranks.
    Cost: 50 us and 0.1 us a point.
    """
    family = ErrorFamily(solution.kind, solution.side, law)
    return family.unit * family.errors(family.numbers_of(solution), np.atleast_1d(np.asarray(x, np.float64)))


def error_extremes(solution: Coordination, law: FunctionLaw) -> Reals:
    """(extremes,) x where the structural error has an extreme, and both ends of the interval.

    Empty if the linkage cannot be assembled throughout.
    """
    family = ErrorFamily(solution.kind, solution.side, law)
    return family.extremes(family.numbers_of(solution))[0]


@dataclass(frozen=True, eq=False)
class ErrorFamily:
    """The structural errors for a law of all linkages of a kind, by five numbers of the linkage.

    The numbers are the three of Freudenstein's equation, then input and output at the begin of the interval; travels
    and lengths of slider-cranks are parts of the wanted travel, so that nothing depends on units. The first two numbers
    of a four-bar (the first of a slider-crank) may be negative: these are linkages whose crank or rocker is turned by
    180 degrees, reached through infinite length.
    """

    kind: str
    side: int
    """+1 or -1: which of the two outputs that solve the equation."""
    law: FunctionLaw

    def __post_init__(self) -> None:
        if self.kind not in EQUATIONS:
            raise SynthesisError("the minimax optimum is sought of four-bars and slider-cranks")

    @cached_property
    def unit(self) -> float:
        """What errors and travels are parts of: one radian, or the wanted travel."""
        return abs(self.law.output_swing) if self._row.output == "travel" else 1.0

    @cached_property
    def _row(self) -> CoordinationKind:
        return next(kind for kind in KINDS if kind.name == self.kind)

    @property
    def _equation(self) -> Equation:
        return EQUATIONS[self.kind]

    def links_of(self, solution: Coordination) -> tuple[float, ...]:
        """What the lengths of a linkage are compared with: all links, or crank, coupler and the wanted travel."""
        return (*solution.lengths[:2], self.unit) if self._row.output == "travel" else solution.lengths

    @cached_property
    def samples(self) -> Reals:
        """(samples,) values of x over the interval, its ends among them, denser there."""
        low, high = self.law.interval
        turns = np.cos(np.pi * np.arange(_SAMPLES) / (_SAMPLES - 1))
        return np.asarray((low + high) / 2 - (high - low) / 2 * turns)

    @cached_property
    def _formula(self) -> tuple[Formula, float, float]:
        """The function, its value at the begin of the interval, and the output by its change."""
        formula = self.law.formula
        begin, end = (float(v) for v in formula(x=self.law.interval))
        return formula, begin, self.law.output_swing / self.unit / (end - begin)

    def numbers_of(self, solution: Coordination) -> Reals:
        """(5,) the numbers of a linkage of this kind."""
        own = self._equation.numbers(solution.lengths, self.unit)
        return np.array([*own, solution.input_start, solution.output_start / self.unit])

    def linkage_of(self, numbers: Reals) -> Coordination | None:
        """The linkage of these numbers, the frame of a four-bar 1; None if it has none that can be assembled."""
        return linkage_of_numbers(self._row, numbers, self.side, self.unit)

    def inputs(self, numbers: Reals, x: Reals) -> Reals:
        """The crank angles at x."""
        low, high = self.law.interval
        return np.asarray(numbers[3] + self.law.input_swing * ((x - low) / (high - low)))

    def _wanted(self, numbers: Reals, x: Reals) -> tuple[Reals, Reals]:
        """Inputs and outputs wanted at x."""
        formula, begin, factor = self._formula
        return self.inputs(numbers, x), numbers[4] + factor * (formula(x=x) - begin)

    def _outputs(self, numbers: Reals, inputs: Reals, wanted: Reals) -> Reals:
        """What solves the equation on the branch; of angles the value nearest to the one wanted."""
        with np.errstate(all="ignore"):
            return self._equation.outputs(numbers, inputs, wanted, self.side)

    def errors(self, numbers: Reals, x: Reals) -> Reals:
        """(x,) the outputs less those wanted, in radians or parts of the wanted travel; NaN where there is none."""
        inputs, wanted = self._wanted(numbers, x)
        return self._outputs(numbers, inputs, wanted) - wanted

    def slopes(self, numbers: Reals, x: Reals) -> tuple[Reals, Reals]:
        """The errors and (x, 5) their derivatives by the numbers: the equation holds whatever the numbers are."""
        return errors_and_slopes(self._row, self.side, numbers, *self._wanted(numbers, x))

    def _narrowest(self, numbers: Reals) -> Reals:
        """Where within the interval the crank is in line with the frame; of slider-cranks at right angles to the path.

        There and at the ends of the interval the linkage comes nearest to the limit of its range, as the room that is
        left is a concave function of the cosine (the sine) of the crank angle.
        """
        low, high = self.law.interval
        first = self._equation.narrowest - numbers[3]
        ends = np.sort([first, first - self.law.input_swing]) / -np.pi
        turned = first + np.pi * np.arange(np.ceil(ends.min()), np.floor(ends.max()) + 1)
        return np.asarray(low + (high - low) * np.clip(turned / self.law.input_swing, 0, 1))

    def largest(self, numbers: Reals) -> float:
        """The largest error over the whole interval; infinite where the linkage cannot be assembled throughout."""
        _, errors = self.extremes(numbers)
        return float(np.abs(errors).max()) if len(errors) else float("inf")

    def extremes(self, numbers: Reals) -> tuple[Reals, Reals]:
        """(extremes,) x at every extreme of the error and both ends, and the errors; empty if there is a gap."""
        x = self.samples
        size = np.abs(self.errors(numbers, x))
        if not np.isfinite(size).all() or not np.isfinite(self.errors(numbers, self._narrowest(numbers))).all():
            return np.empty(0), np.empty(0)
        rises = np.concatenate([[True], size[1:] >= size[:-1]])
        falls = np.concatenate([size[:-1] >= size[1:], [True]])
        peaks = np.flatnonzero(rises & falls | (np.arange(len(x)) % (len(x) - 1) == 0))
        low, high = x[np.maximum(peaks - 1, 0)], x[np.minimum(peaks + 1, len(x) - 1)]
        rows = np.arange(len(peaks))
        for _ in range(_ZOOMS):
            near = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, _PARTS + 1)
            near[:, -1] = high
            errors = self.errors(numbers, near.ravel()).reshape(near.shape)
            if not np.isfinite(errors).all():
                return np.empty(0), np.empty(0)
            best = np.abs(errors).argmax(axis=1)
            low, high = near[rows, np.maximum(best - 1, 0)], near[rows, np.minimum(best + 1, _PARTS)]
        return self._sharpened(numbers, near[rows, best], errors[rows, best])

    def _sharpened(self, numbers: Reals, x: Reals, errors: Reals) -> tuple[Reals, Reals]:
        """Extremes within the interval by one step of Newton's method, where the error is smooth.

        Values alone give the place of an extreme to half of the digits only, its gradient needs more of them.
        """
        low, high = self.law.interval
        width = np.minimum(_WIDTH * (high - low), np.minimum(x - low, high - x) / 2)
        inside = width > 1e-3 * _WIDTH * (high - low)
        at, width = x[inside], width[inside]
        e = self.errors(numbers, (at + np.arange(-2, 3)[:, None] * width).ravel()).reshape(5, -1)
        slope = (e[0] - 8 * e[1] + 8 * e[3] - e[4]) / 12
        bend = (-e[0] + 16 * e[1] - 30 * e[2] + 16 * e[3] - e[4]) / 12
        with np.errstate(divide="ignore", invalid="ignore"):
            moved = at - np.clip(np.nan_to_num(slope / bend), -1e-3, 1e-3) * width
        values = self.errors(numbers, moved)
        kept = np.abs(values) >= np.abs(errors[inside]) - 1e-14
        sharp, its = x.copy(), errors.copy()
        sharp[inside], its[inside] = np.where(kept, moved, at), np.where(kept, values, errors[inside])
        return sharp, its
