"""Linkages that coordinate pairs exactly: linear conditions in numbers of the linkage, after Freudenstein.

docs/theory/synthesis-functions.md: each kind is linear in as many numbers of its own; one start that is free adds one
pair and makes the condition quadratic.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from math import degrees
from typing import Any

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.plain_data import plain
from gruebler.base.text import Message
from gruebler.design.synthesis.dyads import BLOCK, CRANK, GuidingDyad
from gruebler.design.synthesis.tasks import FunctionTask
from gruebler.mechanics.fourbar import FourBar, InvertedSliderCrank, SliderCrank
from gruebler.mechanics.fourbar.length_texts import ClosedForm
from gruebler.mechanics.kinematics import Motion
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.branch import branch_of_side

_SMALL = 1e-9  # a length smaller than this part of the frame (or of the travel) is none


@dataclass(frozen=True, slots=True)
class Coordination:
    """A linkage by its lengths, and where its input and output begin."""

    kind: str
    """``four-bar``, ``slider-crank`` or ``inverted-slider-crank``."""
    _: KW_ONLY
    lengths: tuple[float, ...]
    """a, b, c, d; a, b, e; a, d, e. Lengths of links are positive."""
    input_start: float
    """The crank angle of the first pair."""
    output_start: float
    """The angle or travel of the output in the first pair."""
    side: int
    """The side of the first pair: 1 on the branch ``+``, -1 on ``-``."""

    def linkage(self) -> ClosedForm:
        """The linkage by its usual lengths."""
        return self.row.size(*self.lengths)

    def placed(self, unit: str = "mm") -> Linkage:
        """The linkage with its crank at the angle of the first pair, on its branch; its frame lies on the x axis."""
        own = self.linkage().linkage(unit=unit)
        return own.with_reference_pose(self._first(own).pose(0))

    @property
    def can_start(self) -> bool:
        """Whether it can be put together at the first pair: at a dead centre rounding may part it."""
        return self._first(self.linkage().linkage()).complete

    def _first(self, own: Linkage) -> Motion:
        return move_quietly(own, [self.input_start], branch=branch_of_side(self.side))

    def is_near(self, other: Coordination, tolerance: float) -> bool:
        """Whether both are one linkage at one start: lengths relative to the longest, crank angles in radians."""
        if (self.kind, self.side) != (other.kind, other.side):
            return False
        turn = np.exp(1j * self.input_start) - np.exp(1j * other.input_start)
        gaps = np.abs(np.subtract(self.lengths, other.lengths))
        return bool(abs(turn) < tolerance and (gaps < tolerance * max(map(abs, self.lengths))).all())

    @property
    def row(self) -> CoordinationKind:
        """What its kind does."""
        return next(kind for kind in KINDS if kind.name == self.kind)

    @property
    def unit(self) -> float:
        """What an angle or travel of the output is multiplied with for a reader: angles are read in degrees."""
        return 180 / np.pi if self.row.output == "angle" else 1.0

    @property
    def named(self) -> dict[str, float]:
        """Its lengths by name."""
        return dict(zip(self.row.names, self.lengths, strict=True))


@dataclass(frozen=True, kw_only=True)
class MinimaxCertificate:
    """Whether the largest structural error of a linkage is a strict local minimum, and by what this is seen.

    docs/theory/synthesis-functions.md has the theorem and the meaning of each number.
    """

    x: tuple[float, ...]
    """Where the error has its largest size, to one part in a million."""
    signs: tuple[int, ...]
    """The signs of the error there."""
    multipliers: tuple[float, ...]
    """Weights of these places, not negative, with the sum 1: with them the gradients of the sizes cancel."""
    parameters: int
    """How many numbers of the linkage are free."""
    residual: float
    """How far the weighted gradients are from cancelling, as a part of the error for a change of the numbers by 1."""
    decrease: float
    """By how much the largest error may still fall, to first order, within a tenth of the numbers, in its unit; NaN
    in a dead centre, where no linear model holds."""
    curvature: float | None
    """The least curvature of the weighted errors along changes that keep the sizes equal, as a part of the error; None
    where there is no such change."""
    reason: Message | None = None
    """Why the linkage is not shown to be an optimum; None if it is one."""

    @property
    def optimum(self) -> bool:
        """Whether no linkage nearby has a smaller largest error."""
        return self.reason is None

    @property
    def alternations(self) -> int:
        """How many of the largest errors follow each other with alternating signs."""
        return sum(1 for k, sign in enumerate(self.signs) if k == 0 or sign != self.signs[k - 1])


@dataclass(frozen=True, kw_only=True)
class Minimax:
    """What the search for the least largest structural error found near a linkage, with its certificate."""

    solution: Coordination
    error: float
    """The largest structural error, in radians or the unit of the travel."""
    start_error: float
    """The same of the linkage from which the search began."""
    certificate: MinimaxCertificate

    def linkage(self, unit: str = "mm") -> Linkage:
        """The linkage in the position where the interval begins, on its branch."""
        return self.solution.placed(unit)

    def to_json(self) -> dict[str, Any]:
        """Plain data: lengths, starts, errors and the certificate; angles in degrees."""
        unit = self.solution.unit
        units = dict.fromkeys(("output_start", "error", "start_error", "decrease"), unit.__rmul__)
        certificate = plain(
            self.certificate,
            "optimum reason decrease x signs alternations multipliers parameters residual curvature",
            units=units,
        )
        return {
            **plain(self.solution, "kind lengths input_start output_start", units=units | {"input_start": degrees}),
            "branch": branch_of_side(self.solution.side),
            **plain(self, "error start_error", units=units),
            "possible_decrease": certificate.pop("decrease"),
            "equal_extremes": certificate.pop("x"),
            **certificate,
        }


@dataclass(frozen=True)
class CoordinationKind:
    """A kind of linkage: linear conditions in some numbers of its own."""

    name: str
    _: KW_ONLY
    size: Callable[..., ClosedForm]
    names: str
    """Of its lengths, a letter each."""
    output: str
    """``angle`` or ``travel``."""
    unknowns: int
    columns: Callable[[Reals, Reals], Reals]
    """(..., pairs, unknowns + 1): the conditions say that a combination of the first columns is the last one."""
    lengths: Callable[[Reals], tuple[float, ...] | None]
    """From the factors of that combination to signed lengths."""
    positive: Callable[[tuple[float, ...], complex, float], tuple[tuple[float, ...], float, float]]
    """From signed lengths, the joint of crank and coupler, and the output: the lengths but a, of links positive, the
    output that goes with them, and a number that is not negative on the branch ``+``."""
    dyad: Callable[[tuple[float, ...], complex, float], tuple[complex, GuidingDyad]]
    """From lengths, the joint of crank and coupler, and the output: the output's pivot, or a point of its slide, and
    the dyad between crank and output."""
    input_degree: int = 2
    """In how many columns the input enters: the degree of the condition for a free input start."""


def _four_bar_columns(phi: Reals, psi: Reals) -> Reals:
    return np.stack([np.cos(psi), -np.cos(phi), np.ones_like(phi), np.cos(phi - psi)], axis=-1)


def _four_bar_lengths(k: Reals) -> tuple[float, ...] | None:
    if min(abs(k[0]), abs(k[1])) < _SMALL or max(abs(k[0]), abs(k[1])) > 1 / _SMALL:
        return None
    a, c = 1 / k[0], 1 / k[1]
    square = a * a + c * c + 1 - 2 * a * c * k[2]
    return (a, float(np.sqrt(square)), c, 1.0) if square > _SMALL**2 else None


def _four_bar_positive(signed: tuple[float, ...], pin: complex, psi: float) -> tuple[tuple[float, ...], float, float]:
    _, b, c, d = signed
    side = float(np.imag(np.conj(d - pin) * (d + c * np.exp(1j * psi) - pin)))
    return (b, abs(c), d), psi + (np.pi if c < 0 else 0.0), side


def _four_bar_dyad(lengths: tuple[float, ...], pin: complex, psi: float) -> tuple[complex, GuidingDyad]:
    _, _, c, d = lengths
    return complex(d), GuidingDyad(CRANK, d + c * complex(np.exp(1j * psi)), pin)


def _slider_columns(phi: Reals, s: Reals) -> Reals:
    return np.stack([s * np.cos(phi), np.sin(phi), np.ones_like(phi), s * s], axis=-1)


def _slider_lengths(k: Reals) -> tuple[float, ...] | None:
    if abs(k[0]) < _SMALL:
        return None
    a = k[0] / 2
    e = k[1] / k[0]
    square = k[2] + a * a + e * e
    return (a, float(np.sqrt(square)), e) if square > 0 else None


def _slider_positive(signed: tuple[float, ...], pin: complex, s: float) -> tuple[tuple[float, ...], float, float]:
    return signed[1:], s, s - pin.real


def _slider_dyad(lengths: tuple[float, ...], pin: complex, s: float) -> tuple[complex, GuidingDyad]:
    far = complex(s, lengths[2])
    return far, GuidingDyad(CRANK, far, pin)


def _inverted_columns(phi: Reals, psi: Reals) -> Reals:
    return np.stack([np.sin(phi - psi), np.ones_like(phi), -np.sin(psi)], axis=-1)


def _inverted_lengths(k: Reals) -> tuple[float, ...] | None:
    return (k[0], 1.0, k[1]) if abs(k[0]) > _SMALL else None


def _inverted_positive(signed: tuple[float, ...], pin: complex, psi: float) -> tuple[tuple[float, ...], float, float]:
    """The guide has the direction psi; B0 lies on it towards the block for the branch ``+``."""
    return signed[1:], psi, float(np.real((signed[1] - pin) * np.exp(-1j * psi)))


def _inverted_dyad(lengths: tuple[float, ...], pin: complex, psi: float) -> tuple[complex, GuidingDyad]:
    return complex(lengths[1]), GuidingDyad(BLOCK, pin, pin, complex(np.exp(1j * psi)))


KINDS = (
    CoordinationKind(
        "four-bar",
        size=FourBar,
        names="abcd",
        output="angle",
        unknowns=3,
        columns=_four_bar_columns,
        lengths=_four_bar_lengths,
        positive=_four_bar_positive,
        dyad=_four_bar_dyad,
    ),
    CoordinationKind(
        "slider-crank",
        size=SliderCrank,
        names="abe",
        output="travel",
        unknowns=3,
        columns=_slider_columns,
        lengths=_slider_lengths,
        positive=_slider_positive,
        dyad=_slider_dyad,
    ),
    CoordinationKind(
        "inverted-slider-crank",
        size=InvertedSliderCrank,
        names="ade",
        output="angle",
        unknowns=2,
        columns=_inverted_columns,
        lengths=_inverted_lengths,
        positive=_inverted_positive,
        dyad=_inverted_dyad,
        input_degree=1,
    ),
)


def turning_kind(task: FunctionTask) -> CoordinationKind:
    """Four-bars, or slider-cranks for travels."""
    return next(kind for kind in KINDS if kind.output == task.output and kind.unknowns == 3)


@dataclass(frozen=True, slots=True)
class Coordinations:
    """The linkages of one kind for a task."""

    real: tuple[Coordination, ...]
    complex: int
    """How many complex solutions there are."""


def pair_arrays(task: FunctionTask) -> tuple[Reals, Reals]:
    """(pairs,) inputs and outputs."""
    return np.array(task.inputs), np.array(task.outputs)


def coordinations_with_fixed_starts(kind: CoordinationKind, task: FunctionTask) -> Coordinations:
    """As many pairs as the kind has unknowns: one solution, if its lengths are real."""
    phi, output = pair_arrays(task)
    return Coordinations(tuple(_solved(kind, phi, output)), 1)


def coordinations_with_one_free_start(kind: CoordinationKind, task: FunctionTask) -> Coordinations:
    """One start is free: the determinant of the conditions is a quadratic in its tangent, or in the travel itself."""
    phi, output = pair_arrays(task)
    travel = kind.output == "travel" and not task.start_output

    def shifted(start: float) -> tuple[Reals, Reals]:
        return (phi, output + start) if task.start_input else (phi + start, output)

    if travel:
        size = float(np.ptp(output)) or 1.0
        at = size * np.array([-1.0, 0.0, 1.0])

        def plain(start: float) -> float:
            return float(np.linalg.det(kind.columns(*shifted(start)) / np.array([size, 1, 1, size**2])))

        starts = np.roots(np.polyfit(at, [plain(v) for v in at], 2))
    elif not task.start_input and kind.input_degree == 1:
        first, second = (np.linalg.det(kind.columns(*shifted(v))) for v in (0.0, np.pi / 2))
        starts = np.array([np.arctan2(-first, second)])
    else:
        # A quadratic form in cosine and sine of the start: constant, cos 2t, sin 2t, from three values.
        angles = np.pi * np.arange(3) / 3
        values = np.array([np.linalg.det(kind.columns(*shifted(v))) for v in angles])
        mean, c, s = np.linalg.solve(np.stack([np.ones(3), np.cos(2 * angles), np.sin(2 * angles)], axis=1), values)
        reach = np.hypot(c, s)
        if reach < 1e-14 * abs(mean):
            return Coordinations((), 0)
        if abs(mean) > reach * (1 + 1e-10):  # less is a double root with rounding
            return Coordinations((), 2)
        middle, half = np.arctan2(s, c), np.arccos(np.clip(-mean / reach, -1, 1))
        starts = np.array([(middle + half) / 2, (middle - half) / 2])
    real = []
    for start in starts:
        if abs(start.imag) < 1e-9 * (1 + abs(start)):
            real += _solved(kind, *shifted(float(start.real)))
    return Coordinations(tuple(real), len(starts))


def _solved(kind: CoordinationKind, phi: Reals, output: Reals) -> list[Coordination]:
    """The linkage of these pairs, negative lengths turned round; none if a length is zero or not real."""
    columns = kind.columns(phi, output)
    scale = np.abs(columns).max(axis=0).clip(1e-300)
    factors, *_ = np.linalg.lstsq(columns[:, :-1] / scale[:-1], columns[:, -1], rcond=1e-14)
    if np.abs(columns[:, :-1] / scale[:-1] @ factors - columns[:, -1]).max() > 1e-8 * scale[-1]:
        return []
    signed = kind.lengths(factors / scale[:-1])
    if signed is None:
        return []
    return [as_coordination(kind.name, signed, float(phi[0]), float(output[0]))]


def as_coordination(kind: str, signed: tuple[float, ...], phi: float, output: float) -> Coordination:
    """The linkage of signed lengths in a position: a negative length stands for the link turned by 180 degrees."""
    a = signed[0]
    row = next(row for row in KINDS if row.name == kind)
    lengths, own_output, side = row.positive(signed, a * np.exp(1j * phi), output)
    return Coordination(
        kind,
        lengths=(abs(a), *lengths),
        input_start=phi + (np.pi if a < 0 else 0.0),
        output_start=own_output,
        side=1 if side >= 0 else -1,
    )
