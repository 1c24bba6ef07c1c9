"""Freudenstein's equation of four-bars and slider-cranks: outputs, errors and their derivatives by five numbers.

docs/theory/synthesis-functions.md. The numbers are the three of the equation, then input and output in the first pair;
lengths and travels of slider-cranks are parts of a unit. Numbers of many linkages stand in rows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from gruebler.base.arrays import Integers, Reals
from gruebler.design.synthesis.coordination import Coordination, CoordinationKind, as_coordination

_ROUNDING = 1e-13
"""By so much a cosine may exceed 1 where the linkage is stretched."""
LEAST_NUMBER = 0.1
"""Numbers smaller than this change by parts of it: they may pass through zero."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Equation:
    """What Freudenstein's equation says of a kind of linkage."""

    numbers: Callable[[tuple[float, ...], float], list[float]]
    """The three of a linkage, from its lengths and the unit of travels."""
    outputs: Callable[[Reals, Reals, Reals, int | Integers], Reals]
    """What solves it, from the numbers, the inputs, the outputs wanted and the branch."""
    derivatives: Callable[[Reals, Reals, Reals], tuple[Reals, Reals]]
    """By the input and by the output."""
    turned: Callable[[Reals], int]
    """-1 where numbers stand for a linkage on the other branch, of positive lengths."""
    narrowest: float
    """The crank angle, and that angle by half a turn later, at which the room that is left has an extreme."""


def _four_bar_numbers(lengths: tuple[float, ...], _: float) -> list[float]:
    a, b, c = (v / lengths[3] for v in lengths[:3])
    return [1 / a, 1 / c, (a * a + c * c + 1 - b * b) / (2 * a * c)]


def _four_bar_outputs(numbers: Reals, inputs: Reals, wanted: Reals, side: int | Integers) -> Reals:
    """Re(conj(w) exp(i psi)) = K2 cos phi - K3; of the angles the value nearest to the one wanted."""
    k1, k2, k3 = numbers[:3]
    c, s = np.cos(inputs), np.sin(inputs)
    w = k1 - c - 1j * s
    cosine = (k2 * c - k3) / np.abs(w)
    cosine = np.where(np.abs(cosine) < 1 + _ROUNDING, np.clip(cosine, -1, 1), np.nan)
    output = np.angle(w) + side * np.arccos(cosine)
    return np.asarray(wanted + np.angle(np.exp(1j * (output - wanted))))


def _four_bar_derivatives(numbers: Reals, inputs: Reals, output: Reals) -> tuple[Reals, Reals]:
    k1, k2 = numbers[:2]
    turned = np.sin(inputs - output)
    return k2 * np.sin(inputs) + turned, -k1 * np.sin(output) - turned


def _slider_numbers(lengths: tuple[float, ...], unit: float) -> list[float]:
    a, b, e = (v / unit for v in lengths)
    return [2 * a, 2 * a * e, b * b - a * a - e * e]


def _slider_outputs(numbers: Reals, inputs: Reals, _: Reals, side: int | Integers) -> Reals:
    k1, k2, k3 = numbers[:3]
    c, s = np.cos(inputs), np.sin(inputs)
    return np.asarray(k1 * c / 2 + side * np.sqrt((k1 * c / 2) ** 2 + k2 * s + k3))


def _slider_derivatives(numbers: Reals, inputs: Reals, output: Reals) -> tuple[Reals, Reals]:
    k1, k2 = numbers[:2]
    return k2 * np.cos(inputs) - k1 * output * np.sin(inputs), k1 * np.cos(inputs) - 2 * output


EQUATIONS = {
    "four-bar": Equation(
        numbers=_four_bar_numbers,
        outputs=_four_bar_outputs,
        derivatives=_four_bar_derivatives,
        turned=lambda numbers: int(np.sign(numbers[0] * numbers[1])),
        narrowest=0.0,
    ),
    "slider-crank": Equation(
        numbers=_slider_numbers,
        outputs=_slider_outputs,
        derivatives=_slider_derivatives,
        turned=lambda _: 1,
        narrowest=np.pi / 2,
    ),
}


def errors_and_slopes(
    kind: CoordinationKind, side: int | Integers, numbers: Reals, inputs: Reals, wanted: Reals
) -> tuple[Reals, Reals]:
    """(..., pairs) outputs less those wanted, and (..., pairs, 5) their derivatives by (..., 5) numbers.

    The equation holds whatever the numbers are, which gives the derivatives; NaN where there is no output.
    """
    equation = EQUATIONS[kind.name]
    apart = np.moveaxis(numbers, -1, 0)[..., None]
    with np.errstate(all="ignore"):
        output = equation.outputs(apart, inputs, wanted, side)
        columns = kind.columns(inputs, output)
        by_input, by_output = equation.derivatives(apart, inputs, output)
        moved = -np.concatenate([columns[..., :3], by_input[..., None]], axis=-1) / by_output[..., None]
    return output - wanted, np.concatenate([moved, np.full((*output.shape, 1), -1.0)], axis=-1)


def linkage_of_numbers(kind: CoordinationKind, numbers: Reals, side: int, unit: float) -> Coordination | None:
    """The linkage of (5,) numbers, the frame of a four-bar 1; None if it has none, or cannot be assembled at its start.

    Its output starts where it is wanted to, not where it is nearly.
    """
    signed, equation = kind.lengths(numbers[:3]), EQUATIONS[kind.name]
    with np.errstate(all="ignore"):
        (output,) = equation.outputs(numbers, numbers[3:4], numbers[4:], side)
    if signed is None or not np.isfinite(output):
        return None
    linkage = as_coordination(kind.name, signed, float(numbers[3]), float(output))
    return replace(
        linkage,
        lengths=tuple(float(unit * length) for length in linkage.lengths),
        output_start=unit * float(linkage.output_start + numbers[4] - output),
        side=side * equation.turned(numbers),
    )


def output_errors(solution: Coordination, turned: Reals, moved: Reals) -> Reals:
    """(pairs,) outputs less those wanted, where crank and output have moved so far from its starts; NaN without any."""
    equation = EQUATIONS[solution.kind]
    numbers, wanted = np.array(equation.numbers(solution.lengths, 1.0)), solution.output_start + moved
    with np.errstate(all="ignore"):
        return equation.outputs(numbers, solution.input_start + turned, wanted, solution.side) - wanted
