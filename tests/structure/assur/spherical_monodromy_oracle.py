"""The complex assembly modes of a spherical truss by another method: marks followed round loops of cross-ratios.

A joint is two marks on a line, a link gives its marks their cross-ratios (docs/theory/counting-modes.md). A
configuration is drawn with its cross-ratios, and closed paths of these lead from it to others. Nothing here knows of
divisors. What is found is a lower bound until it stands still.
"""

from __future__ import annotations

import numpy as np

from tests.structure.assur.monodromy_oracle import noise

LEAST_STEP = 2e-4


class Marks:
    """Two marks a joint, simple joints, and for every link of k joints 2k - 3 cross-ratios of its marks."""

    def __init__(self, joints: list[tuple[int, int]]) -> None:
        self.number = 2 * len(joints)
        on = {link: [] for joint in joints for link in joint}
        for k, joint in enumerate(joints):
            for link in joint:
                on[link] += [2 * k, 2 * k + 1]
        self.fours = np.array([(*marks[:3], other) for marks in on.values() for other in marks[3:]])

    def logarithms(self, places):
        """Of the cross-ratios, up to multiples of 2 pi i."""
        a, b, c, d = (places[:, four] for four in self.fours.T)
        return np.log((a - c) * (b - d) / ((a - d) * (b - c)))

    def step(self, places, wanted):
        """Newton's step to the logarithms that are wanted; three marks are held."""
        a, b, c, d = (places[:, four] for four in self.fours.T)
        ac, bd, ad, bc = 1 / (a - c), 1 / (b - d), 1 / (a - d), 1 / (b - c)
        slopes = np.zeros((len(places), len(self.fours), self.number), complex)
        rows = np.arange(len(self.fours))
        for four, slope in zip(self.fours.T, (ac - ad, bd - bc, bc - ac, ad - bd), strict=True):
            slopes[:, rows, four] = slope
        step = np.zeros_like(places)
        miss = turned(wanted - self.logarithms(places))
        step[:, 3:] = np.linalg.solve(slopes[:, :, 3:], miss[:, :, None])[:, :, 0]
        return step

    def miss(self, places, wanted):
        """The largest error of a logarithm."""
        return np.abs(turned(self.logarithms(places) - wanted)).max(axis=1)


def turned(logarithms):
    """The same with imaginary parts in [-pi, pi]."""
    return logarithms - 2j * np.pi * np.round(logarithms.imag / (2 * np.pi))


def follow(marks, start, end, places):
    """Configurations carried along a segment of the logarithms, each with steps of its own; those that arrive."""
    places, times, steps = places.copy(), np.zeros(len(places)), np.full(len(places), 1 / 8)
    while len(going := np.flatnonzero((times < 1) & (steps > LEAST_STEP))):
        later = np.minimum(times[going] + steps[going], 1)
        wanted = start + later[:, None] * (end - start)
        moved = places[going]
        with np.errstate(all="ignore"):
            moved = moved + marks.step(moved, wanted)
            near = marks.miss(moved, wanted) < 0.7
            for _ in range(2):
                moved = moved + marks.step(moved, wanted)
            near &= marks.miss(moved, wanted) < 1e-9
        places[going[near]], times[going[near]] = moved[near], later[near]
        steps[going] *= np.where(near, 2, 0.5)
    return places[times == 1]


def count_by_spherical_monodromy(joints, seed=1, quiet=12):
    """How many configurations loops lead to, until ``quiet`` loops in turn bring none."""
    rng = np.random.default_rng(seed)
    marks = Marks(joints)
    known = noise(rng, 1, marks.number)
    home = marks.logarithms(known)[0]
    idle = 0
    while idle < quiet:
        first, second = (home + noise(rng, len(home)) for _ in range(2))
        found = follow(marks, second, home, follow(marks, first, second, follow(marks, home, first, known)))
        before = len(known)
        for places in found:
            if np.abs(known - places).max(axis=1).min() > 1e-5 * (1 + np.abs(places).max()):
                known = np.concatenate([known, places[None]])
        idle = 0 if len(known) > before else idle + 1
    return len(known)
