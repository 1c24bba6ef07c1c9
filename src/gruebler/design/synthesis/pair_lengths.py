"""Lengths of all four-bars of two cells of dyads, and what follows for the way of the crank.

The fixed pivot of one dyad may be infinitely far away. docs/theory/synthesis-positions.md, "Pivots that are far away".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Flags
from gruebler.design.synthesis.enclosures import Enclosure
from gruebler.design.synthesis.results import EXACT


class Ranges(NamedTuple):
    """Whether the crank certainly passes the crank angles 0 and pi, and whether it certainly does not."""

    pi_free: Flags
    pi_shut: Flags
    zero_free: Flags
    zero_shut: Flags


@dataclass(frozen=True, slots=True, kw_only=True)
class PairLengths:
    """Lengths a, b, c, d of crank, coupler, rocker and frame; those to the far pivot times a weight above zero."""

    coupler: Enclosure
    near: Enclosure
    """Of the link to the other pivot: the crank, or the rocker where the crank's pivot is the far one."""
    far: Enclosure
    """Of the link to the far pivot, times the weight."""
    frame: Enclosure
    """Times the weight."""
    weight: Enclosure
    squares: Enclosure
    """The square of the far link less that of the frame, times the weight."""
    crank_far: bool

    @classmethod
    def of(
        cls, coupler: Enclosure, near: Enclosure, link: Enclosure, away: Enclosure, weight: Enclosure, crank_far: bool
    ) -> PairLengths:
        """From the far link and the way from the near pivot to its pin: |u|² - |u - v|² = Re(v* (2 u - v))."""
        return cls(
            coupler=coupler.modulus,
            near=near,
            far=link.modulus,
            frame=(weight * away - link).modulus,
            weight=weight,
            squares=(away.conjugate * (2 * link - weight * away)).real,
            crank_far=crank_far,
        )

    def too_slender(self, most: float) -> Flags:
        """Whether the longest length is certainly more than so many times the shortest."""
        here = [self.coupler, self.near]
        weighted = [self.far, self.frame, *(self.weight * length for length in here)]
        slender = [
            np.maximum.reduce([length.low for length in some]) > most * np.minimum.reduce([each.high for each in some])
            for some in (here, weighted)
        ]
        return np.asarray(slender[0] | slender[1])

    def have_others(self, lengths: Sequence[tuple[str, float]]) -> Flags:
        """Whether links certainly have other lengths than those that are demanded."""
        near, far = ("rocker", "crank") if self.crank_far else ("crank", "rocker")
        links = {"coupler": self.coupler, near: self.near, far: self.far, "frame": self.frame}
        other = np.zeros(len(self.weight.value), bool)
        for link, length in lengths:
            other |= is_other(links[link], self.weight if link in (far, "frame") else 1.0, length)
        return other

    @property
    def ranges(self) -> Ranges:
        """The crank passes pi if b + c > a + d, and 0 if |a - d| < |b - c| does not hold: a product of two factors."""
        coupler, near = self.coupler, self.near
        difference = self.squares * (self.far + self.frame).inverse
        first, second = near - coupler + difference, coupler - near + difference
        third = self.weight * (coupler + near) - self.far - self.frame
        inner, second = (third, second) if self.crank_far else (second, third)
        plus, minus = (first.low > 0, second.low > 0), (first.high < 0, second.high < 0)
        return Ranges(
            pi_free=inner.low > 0,
            pi_shut=inner.high <= 0,
            zero_free=(plus[0] & plus[1]) | (minus[0] & minus[1]),
            zero_shut=(plus[0] & minus[1]) | (minus[0] & plus[1]),
        )

    def too_flat(self, cosine: float) -> tuple[Flags, Flags]:
        """Whether the transmission angle is certainly too small where the crank passes 0, and where it passes pi.

        That is |b² + c² - (d -+ a)²| > 2 b c cos(mu).
        """
        coupler, near, far, frame, weight = self.coupler, self.near, self.far, self.frame, self.weight
        if not self.crank_far:
            middle = weight * (coupler * coupler - near * near) + self.squares
            allowed, twice = 2 * cosine * (coupler * far), 2 * (near * frame)
            return off(middle + twice, allowed), off(middle - twice, allowed)
        middle, allowed, both = coupler * coupler + near * near, 2 * cosine * (coupler * near), far + frame
        difference = self.squares * both.inverse
        part = weight * weight
        return off(middle - difference * difference, allowed), off(part * middle - both * both, part * allowed)


def off(value: Enclosure, allowed: Enclosure) -> Flags:
    """Whether a number is certainly larger in size than what is allowed."""
    return np.asarray(((value - allowed).low > 0) | ((value + allowed).high < 0))


def is_other(measured: Enclosure, weight: Enclosure | float, length: float) -> Flags:
    """Whether a length, times a weight, is certainly another one."""
    slack = EXACT * max(1.0, length)
    long, short = measured - weight * (length + slack), measured - weight * (length - slack)
    return np.asarray((long.low > 0) | (short.high < 0))
