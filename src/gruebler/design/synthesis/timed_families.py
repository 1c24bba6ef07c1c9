"""Linkages through three and four points at given crank angles: the best of their families by what is asked for.

Three points leave four parameters, or three beside a slide, four points two, or one. Where the crank angles of three
points are free, they are two parameters more. docs/theory/synthesis-points.md,
"Points with crank angles".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from gruebler.base.arrays import Complexes, Flags, Reals
from gruebler.base.text import Message
from gruebler.design.synthesis.demands import Demands, demands_failed
from gruebler.design.synthesis.dyad_families import guiding_dyads
from gruebler.design.synthesis.dyads import BLOCK, CRANK, SLIDER, Displacements, DyadKind, GuidingDyad
from gruebler.design.synthesis.length_search import (
    FINEST_STEP,
    dyad_numbers,
    has_lengths,
    improved_rows,
    pivots_of_rows,
)
from gruebler.design.synthesis.pair_facts import KNOWN
from gruebler.design.synthesis.pair_starts import cranks_of_pivots, slides_of_places
from gruebler.design.synthesis.point_families import ALIKE, IN_STEPS, PointFamily, rows_apart
from gruebler.design.synthesis.random_starts import DRAWN, StartFamily, random_search
from gruebler.design.synthesis.results import resolution
from gruebler.design.synthesis.tasks import PathTask, PositionTask

_CRANKS, _OTHERS = 60, 60  # dyads of four points that are taken, of each family
_IMPROVED = 12  # linkages
_SAME = 1e-6  # sizes: a dyad that is the crank again


def best_timed(
    task: PathTask, demands: Demands, orders: Sequence[str], number: int
) -> tuple[list[tuple[GuidingDyad, GuidingDyad]], list[Message]]:
    """The best cranks with other dyads, so many of each kind, and how finely they were sought.

    Args:
        task: three or four points with their crank angles, or three without.
        demands: what counts first.
        orders: by what the best is sought, the most important first.
        number: of each kind.

    Cost: 1 to 3 s.
    """
    pairs: list[tuple[GuidingDyad, GuidingDyad]] = []
    notes: list[Message] = []
    known = tuple(name for name in orders if name in KNOWN)
    for kind in (CRANK, SLIDER, BLOCK):
        if not has_lengths(kind, demands):
            continue
        starts = TimedStarts(task, kind, demands)
        if len(task) == 3 and not demands.given_sizes:
            search = random_search(starts, demands, known)
            rows = search.ends[search.costs[:, 0] == 0]
            notes += search.note(search.ends)
        else:
            rows = _improved(starts, demands, known)
        pairs += map(starts.family.dyads, rows_apart(rows, number))
    said = resolution(known, FINEST_STEP, IN_STEPS) if len(task) == 4 or demands.given_sizes else []
    return pairs, [*notes, *said]


class TimedStarts(StartFamily):
    """Linkages through three or four points, at crank angles where they are given; how those of three move at random.

    With the coupler point at rest the pin goes around the crank's pivot, which is shifted against the points.
    """

    family: PointFamily

    def __init__(self, task: PathTask, kind: DyadKind, demands: Demands) -> None:
        lengths, direction = demands.lengths, demands.frame_direction
        self.family = PointFamily(task=task, kind=kind, lengths=lengths, frame_direction=direction)
        self.kind, self.origin, self.size = kind, complex(task.z[0]), self.family.size
        self.places = self.family.places
        angles = np.array(task.crank_angles, np.float64)
        self.turned = angles[1:] - angles[:1]  # of no angles none

    def drawn(self, rng: np.random.Generator, demands: Demands) -> Reals:
        """Slides and free turns at any angle."""
        pivots = self.pivots(rng, demands)
        fixed = (rng.random((DRAWN, 2)) < 0.5) | (demands.region is not None)
        turns = rng.uniform(-np.pi, np.pi, (DRAWN, len(self.places) - 1))
        return self._members(pivots, np.pi * rng.random(DRAWN), fixed, turns)

    def neighbours(self, rng: np.random.Generator, demands: Demands, rows: Reals, width: Reals) -> Reals:
        """The crank is moved, at either pivot, or the other dyad, or both; a crank that moves turns the coupler."""
        points, own = self.family.points, self.family.own
        pivots = pivots_of_rows(rows, points)
        steps = rng.normal(size=(*pivots.shape, 2)).view(np.complex128)[..., 0] * (1 + np.abs(pivots))
        wide = width * np.exp(-2 * rng.random(len(rows)))
        still = rng.random((len(rows), 1)) < 0.5
        steps = np.where(still & (np.arange(points) < 2), 0, steps * wide[:, None])
        turns = rows[:, own:] + np.where(still, 0, wide[:, None] * rng.normal(size=(len(rows), len(self.places) - 1)))
        angles = rows[:, own - 1] + wide * rng.normal(size=len(rows))
        fixed = (rng.random((len(rows), 2)) < 0.5) | (demands.region is not None)
        return self._members(self.within(demands, pivots + steps), angles, fixed, turns)

    def sample(self) -> Reals:
        """(linkages, numbers) of four points: other dyads with cranks along the curve of these."""
        z = self.places
        turned = self._angles(np.append(0, self.turned))
        seen = PositionTask(tuple((-w.real, -w.imag, a) for w, a in zip(z, turned, strict=True)))
        rows = []
        for crank in guiding_dyads(seen, _CRANKS):
            pin, pivot = crank.moving - crank.fixed, -crank.fixed
            if crank.slides or abs(pin) < _SAME:
                continue
            coupler = self._carried(np.array([pin]), np.array([pivot]), self.turned[None])[0]
            angles = self._angles(np.angle(np.append(1, coupler)))
            carried = PositionTask(tuple((w.real, w.imag, a) for w, a in zip(z, angles, strict=True)))
            others = [
                dyad
                for dyad in guiding_dyads(carried, _OTHERS)
                if dyad.kind == self.kind and abs(dyad.moving - pin) + abs(dyad.fixed - pivot) > _SAME
            ]
            if others:
                own = np.array([[pin, pivot]]).view(np.float64)
                rows.append(np.concatenate([np.repeat(own, len(others), axis=0), dyad_numbers(others)], axis=1))
        own = np.concatenate(rows) if rows else np.empty((0, self.family.own))
        return np.concatenate([own, np.broadcast_to(self.turned, (len(own), len(z) - 1))], axis=1)

    def _members(self, pivots: Complexes, angles: Reals, fixed: Flags, turns: Reals) -> Reals:
        if len(self.turned):
            turns = np.broadcast_to(self.turned, turns.shape)
        seen = Displacements(np.exp(1j * turns), -self.places[1:])
        crank = np.stack([pivots[:, 0] - pivots[:, 1], -pivots[:, 1]], axis=1)
        arm, pivot = cranks_of_pivots(seen, crank, fixed[:, 0]).view(np.complex128).T
        pin, pivot = arm - pivot, -pivot
        with np.errstate(divide="ignore", invalid="ignore"):
            carried = Displacements(self._carried(pin, pivot, turns), self.places[1:])
        if self.kind.seen is None:
            other = cranks_of_pivots(carried, pivots[:, 2:], fixed[:, 1])
        else:
            other = slides_of_places(self.kind.seen(carried), pivots[:, 2], angles)
        return np.concatenate([np.stack([pin, pivot], axis=1).view(np.float64), other, turns], axis=1)

    def _carried(self, pin: Complexes, pivot: Complexes, turns: Reals) -> Complexes:
        """(linkages, points - 1) how the coupler has turned from the first point to each of the others."""
        pins = pivot[:, None] + (pin - pivot)[:, None] * np.exp(1j * turns)
        turned = (self.places[1:] - pins) / -pin[:, None]
        return np.asarray(turned / np.abs(turned))

    @staticmethod
    def _angles(angles: Reals) -> Iterator[float]:
        """A body looks the same after a whole turn."""
        return map(float, np.angle(np.exp(1j * angles)))


def _improved(starts: TimedStarts, demands: Demands, orders: Sequence[str]) -> Reals:
    """(linkages, numbers) the best of a sample, with the given lengths, improved within the family."""
    family = starts.family
    if len(starts.places) == 3:
        rows = starts.drawn(np.random.default_rng(0), demands)
        rows = rows[np.isfinite(rows).all(axis=1)][: DRAWN // 4]
    else:
        rows = starts.sample()
    held = np.zeros(rows.shape, bool)
    held[:, family.own :] = True
    rows, good = family.members(rows, held)
    rows = rows[good]
    if not len(rows):
        return rows
    facts = family.facts(rows, demands)
    ranks = facts.ranks(demands_failed(facts.met(demands)), orders)
    chosen = np.array(rows_apart(rows[ranks], _IMPROVED, gap=4 * ALIKE))
    rows, meets = improved_rows(family, chosen, held[: len(chosen)], demands, orders)
    return rows[meets]
