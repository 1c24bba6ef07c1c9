"""The kinds of meshes: a row for each says what it does to the speeds of its links, how it is written and built."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from types import MappingProxyType
from typing import Literal


class Unit(StrEnum):
    """The unit of a link's speed, if wheels turn with one unit of angle."""

    TURNING = "turning"
    PER_RADIAN = "per radian"
    """Length: a rack moves radius times angle."""
    PER_TURN = "per turn"
    """Length: a nut moves its lead in a full turn. Per radian and per turn differ by 2 pi and are never mixed."""


Equation = Callable[[Fraction, Fraction], tuple[Fraction, Fraction, Fraction]]
"""What the speeds of the first link, the second and the carrier are multiplied by, from both sizes: their sum is 0."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshKind:
    """What a kind of mesh does. Wheels: size_a (w_a - w_c) ± size_b (w_b - w_c) = 0; slides: travel = size_a turn a."""

    equation: Equation
    unit: Unit = Unit.TURNING
    """Of the second link."""
    signed: bool = True
    """Whether a negative size has a meaning: internal toothing, an opposite bevel gear, a left-hand screw."""
    wheels: Literal[0, 1, 2] = 2
    """How many of the two links are wheels: both, the one of a rack or a drum, or none."""
    toothed: bool = False
    belt: Literal["", "open", "crossed"] = ""
    """How a belt or chain runs around both wheels, if there is one."""
    rack: bool = False
    """Whether a wheel rolls along a straight line."""
    crossing: bool = False
    """Whether the axes of the wheels cross."""
    carries: bool = False
    """Whether the second link slides against a carrier that slides, too."""
    form: str = "{kind} {a}:{size_a} {b}:{size_b}"
    """The mesh as text."""

    @property
    def parallel(self) -> bool:
        """Whether it has two wheels on parallel axes."""
        return self.wheels == 2 and not self.crossing

    @property
    def touching(self) -> bool:
        """Whether it has two wheels on parallel axes that touch."""
        return self.parallel and not self.belt

    @property
    def spur(self) -> bool:
        """Whether it has two toothed wheels on parallel axes that touch."""
        return self.touching and self.toothed


def _outside(a: Fraction, b: Fraction) -> tuple[Fraction, Fraction, Fraction]:
    return a, b, -a - b


def _around(a: Fraction, b: Fraction) -> tuple[Fraction, Fraction, Fraction]:
    return a, -b, b - a


def _bevel(a: Fraction, b: Fraction) -> tuple[Fraction, Fraction, Fraction]:
    return a, b, -a


def _slide(a: Fraction, _: Fraction) -> tuple[Fraction, Fraction, Fraction]:
    return -a, Fraction(1), Fraction(-1)


def _screw(a: Fraction, _: Fraction) -> tuple[Fraction, Fraction, Fraction]:
    return -a, Fraction(1), a


_DRUM = "{kind} {a}:{size_a} {b}"

KINDS = MappingProxyType(
    {
        "gear": MeshKind(equation=_outside, toothed=True),
        "friction": MeshKind(equation=_outside),
        "bevel": MeshKind(equation=_bevel, toothed=True, crossing=True),
        "belt": MeshKind(equation=_around, signed=False, belt="open"),
        "chain": MeshKind(equation=_around, signed=False, toothed=True, belt="open"),
        "crossed": MeshKind(equation=_outside, signed=False, belt="crossed"),
        "rack": MeshKind(
            equation=_slide, unit=Unit.PER_RADIAN, wheels=1, toothed=True, rack=True, carries=True, form=_DRUM
        ),
        "rack by pitch": MeshKind(
            equation=_slide,
            unit=Unit.PER_TURN,
            wheels=1,
            toothed=True,
            rack=True,
            carries=True,
            form="rack {a}:1 {b} pitch={size_a}",
        ),
        "winch": MeshKind(equation=_slide, unit=Unit.PER_RADIAN, wheels=1, carries=True, form=_DRUM),
        "screw": MeshKind(equation=_screw, unit=Unit.PER_TURN, wheels=0, form="screw {a} {b} lead={size_a}"),
    }
)
"""A kind of mesh is a row; pictures have one more where something is drawn between its links."""
