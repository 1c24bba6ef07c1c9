"""Limits of linkages by their dimensions: places, lengths, and a crank that turns fully with the dyads that hang on it.

docs/theory/synthesis-any.md. The numbers are those of the pins of every link in its own plane.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.closure import DesignClosure
from gruebler.design.synthesis.demands import Demands
from gruebler.design.synthesis.drawing_limits import SAFE, at_tops, beyond_cosine, cosine, top_angles
from gruebler.design.synthesis.fit_limits import FitLimits
from gruebler.design.synthesis.place_limits import PlaceLimits
from gruebler.design.synthesis.structure_atlas import (
    DyadStructure,
    PinPlaces,
    assembled_sides,
    dyad_structure,
    plane_motions,
)

_ROUND = np.linspace(0, 2 * np.pi, 240, endpoint=False)  # of the crank: a dyad beside one that is stretched is fast
_STEP = 1e-6  # sizes: of a difference on either side


@dataclass(frozen=True, slots=True, kw_only=True)
class TurningCrank:
    """A crank and the dyads that have to be assembled at each of its angles."""

    structure: DyadStructure
    pins: dict[tuple[int, str], int]
    """Of each joint on each link the number that is its x."""
    sides: tuple[float, ...]
    """On which side each dyad is assembled."""

    def places(self, rows: Reals) -> PinPlaces:
        """(..., starts, 1) of the pins, for numbers (numbers, ..., starts)."""

        def pin(joint: int, link: str) -> Complexes:
            x = self.pins[joint, link]
            return np.asarray((rows[x] + 1j * rows[x + 1])[..., None])

        return pin

    def tops(self, rows: Reals) -> Reals:
        """(starts, tops) the crank angles where the cosine of each dyad is largest, and where least."""
        angles = np.broadcast_to(_ROUND, (rows.shape[1], len(_ROUND)))
        pin = self.places(rows)
        motions = plane_motions(self.structure, pin, angles, self._sides(rows))
        tops = (top_angles(cosine(dyad, pin, motions), angles, between=True) for dyad in self.structure.dyads)
        return np.concatenate([top for both in tops for top in both], axis=1)

    def beyond(self, rows: Reals, tops: Reals) -> Iterator[Reals]:
        """(2, ..., starts) of each dyad, by how much its cosine passes both limits at their tops."""
        pin = self.places(rows)
        motions = plane_motions(self.structure, pin, tops, self._sides(rows))
        for n, dyad in enumerate(self.structure.dyads):
            yield beyond_cosine(cosine(dyad, pin, at_tops(motions, n)), 1 - SAFE)

    def _sides(self, rows: Reals) -> Reals:
        sides = np.array(self.sides).reshape(-1, *(1 for _ in rows.shape[1:]))
        return np.broadcast_to(sides, (len(sides), *rows.shape[1:]))


@dataclass(frozen=True, slots=True, kw_only=True)
class SizeLimits(FitLimits):
    """What the dimensions of a linkage keep to."""

    places: PlaceLimits
    crank: TurningCrank | None

    @property
    def unit(self) -> float:
        """The size by which limits are measured."""
        return self.places.unit

    def values(self, rows: Reals, phi: Reals) -> Reals:
        """Of numbers (numbers, starts)."""
        values = self.places.values(rows, phi)
        if self.crank is None:
            return values
        return np.concatenate([values, *self.crank.beyond(rows, self.crank.tops(rows))])

    def linearised(self, rows: Reals, phi: Reals) -> tuple[Reals, Reals]:
        """Of a crank by differences; a top does not move as long as it is one."""
        values, slopes = self.places.linearised(rows, phi)
        if self.crank is None:
            return values, slopes
        tops, step = self.crank.tops(rows), _STEP * self.unit
        values = np.concatenate([values, *self.crank.beyond(rows, tops)])
        aside = step * np.eye(len(rows))[:, :, None]
        ends = (self.crank.beyond(rows[:, None, :] + sign * aside, tops) for sign in (1, -1))
        turning = np.concatenate([(more - less) / (2 * step) for more, less in zip(*ends, strict=True)])
        turning[:, [*self.places.held]] = 0
        return values, np.concatenate([slopes, turning])


def limits_of_sizes(
    closure: DesignClosure, demands: Demands, pose: Reals, p: Reals, *, held: frozenset[int], unit: float
) -> SizeLimits:
    """What dimensions p keep to; the crank turns fully with dyads on the side on which they are in a pose."""
    linkage = closure.linkage
    mechanism, at = linkage.mechanism, closure.start
    pins = {key: at[key] for key in closure.keys if linkage.elements[key].is_pin}
    places = PlaceLimits(
        pins={link: tuple(x for (_, own), x in pins.items() if own == link) for link in mechanism.chain.links},
        frame=mechanism.frame,
        demands=demands,
        unit=unit,
        held=held,
    )
    structure = dyad_structure(mechanism) if demands.crank else None
    if structure is None:
        return SizeLimits(places=places, crank=None)
    drawn = []
    for number, joint in enumerate(mechanism.chain.joints):
        link = joint.links[0]
        place = complex(*p[pins[number, link] : pins[number, link] + 2])
        if (c := closure.column.get(link)) is not None:
            place = complex(pose[c], pose[c + 1]) + np.exp(1j * pose[c + 2]) * place
        drawn.append(place)
    sides = tuple(assembled_sides(structure, np.array(drawn)).tolist())
    return SizeLimits(places=places, crank=TurningCrank(structure=structure, pins=pins, sides=sides))
