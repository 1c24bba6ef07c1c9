"""Kinds of linkages whose coupler curves are fitted: four-bar and slider-crank, each a row of numbers in the plane.

What is asked of a kind stands in its class; nothing else compares kinds. docs/theory/synthesis-curves.md.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.dyads import CRANK, SLIDER, GuidingDyad

Numbers = Mapping[str, NDArray[Any]]
"""The numbers of linkages by their names, complex ones where derivatives come from a complex step."""

_ENDS = np.array([1.0, -1.0])  # the crank along the frame and against it, or square to the slide


@dataclass(frozen=True, slots=True)
class FourBarKind(ABC):
    """What the numbers of a row are, and what follows from them."""

    name: ClassVar[str]
    unknowns: ClassVar[tuple[str, ...]]
    """A0 (a0x, a0y), crank a, coupler b, coupler point u along AB and v to its left; what guides B by its kind."""
    pivots: ClassVar[tuple[str, ...]]
    """The points that stand still, each of which a crank may have: two begins of names of numbers, or one."""
    links: ClassVar[tuple[str, ...]]
    """The names of the lengths between pins."""
    output_turns: ClassVar[bool]
    """Whether B turns about a fixed pivot b0 at the distance c."""
    mirrored_side: ClassVar[float]
    """The branch of the mirror image, by the own one."""
    trials: ClassVar[int]
    """How many linkages are tried for the atlas."""

    def named(self, rows: NDArray[Any]) -> dict[str, NDArray[Any]]:
        """The numbers of (unknowns, ...) rows by their names."""
        return dict(zip(self.unknowns, rows, strict=True))

    def lengths(self, r: Numbers) -> list[NDArray[Any]]:
        """The distances of the pins of each link, in the order of ``links``."""
        return [self.frame(r) if name == "frame" else r[name] for name in self.links]

    @abstractmethod
    def scattered(self, parts: Sequence[Reals]) -> Reals:
        """(unknowns, linkages) rows of linkages with crank 1 from the origin, by three numbers between 0 and 1."""

    @abstractmethod
    def frame(self, r: Numbers) -> NDArray[Any]:
        """The distance of the two pivots; 1 where there is one only."""

    @abstractmethod
    def coupler(self, r: Numbers, pin: Complexes, side: Reals | float) -> tuple[Complexes, Complexes]:
        """The direction of the coupler where the crank's pin is, NaN out of reach; in which direction B cannot move."""

    @abstractmethod
    def carried(self, far: Complexes, normal: Complexes) -> dict[str, Reals | float]:
        """How far B at ``far`` goes in that direction with each number of what guides it."""

    @abstractmethod
    def moved_guide(self, r: Numbers, turn: Complexes | complex, shift: Complexes | complex) -> dict[str, Any]:
        """The numbers of what guides B after similarities; lengths apart."""

    @abstractmethod
    def guide(self, r: Mapping[str, float], far: complex) -> GuidingDyad:
        """What guides B, which lies at ``far``."""

    @abstractmethod
    def turning_excess(self, r: Numbers) -> NDArray[Any]:
        """A length that is negative where the crank turns fully."""

    @abstractmethod
    def cosines(self, r: Numbers, phi: Reals | None) -> NDArray[Any]:
        """(..., starts, places) of the transmission angle: at crank angles, or where it is extreme over a turn."""


@final
@dataclass(frozen=True, slots=True)
class _FourBar(FourBarKind):
    """The second fixed pivot B0 and the rocker c."""

    name = "four-bar"
    unknowns = ("a0x", "a0y", "b0x", "b0y", "a", "b", "c", "u", "v")
    pivots = ("a0", "b0")
    links = ("a", "b", "c", "frame")
    output_turns = True
    mirrored_side = -1.0
    trials = 90_000  # of which the tenth part turns fully

    def scattered(self, parts: Sequence[Reals]) -> Reals:
        b, c, d = (np.exp(np.log(6.0) * (2 * v - 0.7)) for v in parts)
        zero = 0 * b
        return np.stack([zero, zero, d, zero, zero + 1, b, c, zero, zero])

    def frame(self, r: Numbers) -> NDArray[Any]:
        return np.asarray(np.sqrt((r["b0x"] - r["a0x"]) ** 2 + (r["b0y"] - r["a0y"]) ** 2))

    def coupler(self, r: Numbers, pin: Complexes, side: Reals | float) -> tuple[Complexes, Complexes]:
        far = r["b0x"] + 1j * r["b0y"]
        gap = far - pin
        f = np.abs(gap)
        along = (r["b"] * r["b"] - r["c"] ** 2 + f * f) / (2 * f)
        across = side * np.sqrt(r["b"] * r["b"] - along * along)
        theta = gap / f * (along + 1j * across) / r["b"]
        return theta, np.conj((pin + r["b"] * theta - far) / r["c"])  # the rocker's pin cannot move along the rocker

    def carried(self, far: Complexes, normal: Complexes) -> dict[str, Reals | float]:  # noqa: ARG002
        return {"b0x": np.real(normal), "b0y": np.real(1j * normal), "c": 1.0}

    def moved_guide(self, r: Numbers, turn: Complexes | complex, shift: Complexes | complex) -> dict[str, Any]:
        far = turn * (r["b0x"] + 1j * r["b0y"]) + shift
        return {"b0x": far.real, "b0y": far.imag}

    def guide(self, r: Mapping[str, float], far: complex) -> GuidingDyad:
        return GuidingDyad(CRANK, far, complex(r["b0x"], r["b0y"]))

    def turning_excess(self, r: Numbers) -> NDArray[Any]:
        lengths = np.array(self.lengths(r))
        place = np.arange(4).reshape(4, *(1,) * (lengths.ndim - 1))
        shortest = np.where(lengths[0].real <= lengths[3].real, 0, 3)  # another one makes the length positive
        sign = -1.0 + 2 * (place == lengths.real.argmax(axis=0)) + 2 * (place == shortest)
        return np.asarray(np.sum(sign * lengths, axis=0))

    def cosines(self, r: Numbers, phi: Reals | None) -> NDArray[Any]:
        a, b, c = (r[name][..., None] for name in "abc")
        if phi is None:
            square = (self.frame(r)[..., None] + a * _ENDS) ** 2
        else:
            x, y = (r["b0" + axis][..., None] - r["a0" + axis][..., None] for axis in "xy")
            square = (x - a * np.cos(phi)) ** 2 + (y - a * np.sin(phi)) ** 2
        return np.asarray((b * b + c * c - square) / (2 * b * c))


@final
@dataclass(frozen=True, slots=True)
class _SliderCrank(FourBarKind):
    """The direction of the slide, as an angle, and its distance h from the origin to its left."""

    name = "slider-crank"
    unknowns = ("a0x", "a0y", "angle", "h", "a", "b", "u", "v")
    pivots = ("a0",)
    links = ("a", "b")
    output_turns = False
    mirrored_side = 1.0
    trials = 12_000

    def scattered(self, parts: Sequence[Reals]) -> Reals:
        b, h = np.exp(np.log(6.0) * parts[0]) * 1.05, 3 * parts[1]
        zero = 0 * b
        return np.stack([zero, zero, zero, h, zero + 1, b, zero, zero])

    def frame(self, r: Numbers) -> NDArray[Any]:
        return np.ones_like(r["a"])

    def coupler(self, r: Numbers, pin: Complexes, side: Reals | float) -> tuple[Complexes, Complexes]:
        slide = np.exp(1j * r["angle"])
        height = r["h"] - np.imag(np.conj(slide) * pin)
        along = side * np.sqrt(r["b"] * r["b"] - height * height)
        return np.asarray(slide * (along + 1j * height) / r["b"], np.complex128), -1j * np.conj(slide)

    def carried(self, far: Complexes, normal: Complexes) -> dict[str, Reals | float]:
        return {"h": 1.0, "angle": np.real(1j * normal * far)}

    def moved_guide(self, r: Numbers, turn: Complexes | complex, shift: Complexes | complex) -> dict[str, Any]:
        angle = r["angle"] + np.angle(turn)
        return {"angle": angle, "h": r["h"] * np.abs(turn) + np.imag(np.exp(-1j * angle) * shift)}

    def guide(self, r: Mapping[str, float], far: complex) -> GuidingDyad:
        return GuidingDyad(SLIDER, far, far, complex(np.exp(1j * r["angle"])))

    def turning_excess(self, r: Numbers) -> NDArray[Any]:
        offset = self._offset(r)
        return np.asarray(r["a"] + np.where(offset.real < 0, -offset, offset) - r["b"])

    def cosines(self, r: Numbers, phi: Reals | None) -> NDArray[Any]:
        a, b = r["a"][..., None], r["b"][..., None]
        pin = a * _ENDS if phi is None else a * np.sin(phi - r["angle"][..., None])
        return np.asarray((self._offset(r)[..., None] - pin) / b)

    @staticmethod
    def _offset(r: Numbers) -> NDArray[Any]:
        """The distance of the slide from the crank's pivot, to its left."""
        return np.asarray(r["h"] - np.cos(r["angle"]) * r["a0y"] + np.sin(r["angle"]) * r["a0x"])


FOUR_BAR: FourBarKind = _FourBar()
SLIDER_CRANK: FourBarKind = _SliderCrank()
