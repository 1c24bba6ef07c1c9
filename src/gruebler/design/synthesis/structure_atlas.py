"""An atlas of coupler curves of one structure: a crank and dyads of turning joints, moved in closed form.

A linkage is drawn in one position: every joint is a place in the plane. All linkages of the atlas move at once;
docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.curve_matching import PLACES, evenly_along
from gruebler.design.synthesis.dyad_structures import NO_LINES, DyadStructure, assembled_sides, in_rows

_TRIALS = 120_000
_LARGEST = 6.0  # places of joints, in crank lengths
_SAFE = 0.15  # the least sine of an angle between two links of a dyad, so that small changes do not stop the motion
_CURVES = 24_000
_BLOCK = 1 << 15  # places of linkages that are looked at together


@dataclass(frozen=True, slots=True, kw_only=True)
class StructureAtlas:
    """Curves of points of links that no joint holds at the frame; the crank turns fully and has the length 1."""

    structure: DyadStructure
    drawn: Complexes
    """(curves, joints) where the joints lie in the drawing."""
    link: NDArray[np.int64]
    """(curves,) which of the coupler links carries the point."""
    point: Complexes
    """(curves,) where the point lies in the drawing."""
    turned: Reals
    """(curves, places) how far the crank has turned at places evenly along the curve."""
    z: Complexes
    """(curves, places)"""


@cache
def structure_atlas(structure: DyadStructure) -> StructureAtlas:
    """The atlas of a structure, made at its first use from evenly spread drawings. Cost: 1 s for six links."""
    joints = structure.joints
    unit = _evenly_spread(_TRIALS, 2 * joints + 3)
    drawn = np.exp(np.log(_LARGEST) * unit[0::2][:joints]) * np.exp(2j * np.pi * unit[1::2][:joints])
    drawn[structure.pivot] = 0
    chain = structure.mechanism.chain
    own = [n for n, joint in enumerate(chain.joints) if structure.crank in joint.links and n != structure.pivot]
    drawn[own] /= np.abs(drawn[own[0]])
    phi, coarse = np.linspace(0, 2 * np.pi, 2 * PLACES + 1), np.linspace(0, 2 * np.pi, 25)[:-1]
    for angles in (coarse[::6], coarse, phi[:-1]):  # most fail at the first ones
        safe = _safe(structure, drawn, angles)
        drawn, unit = drawn[:, safe], unit[:, safe]
    links = structure.coupler_links
    drawings, each = drawn.shape[1], _CURVES // max(1, len(links))
    row, lap = np.arange(each) % drawings, np.arange(each) // drawings
    reach, angle = (unit[-3, row] + 0.618034 * lap) % 1.0, (unit[-2, row] + 0.754878 * lap) % 1.0
    points = []
    for link in links:
        near = [n for n, joint in enumerate(chain.joints) if link in joint.links]
        spread = np.abs(drawn[near[0], row] - drawn[near[1], row])
        middle = drawn[near].mean(axis=0)[row]
        points.append(middle + 1.5 * spread * np.sqrt(reach) * np.exp(2j * np.pi * angle))
    row = np.tile(row, len(links))
    places = in_rows(np.concatenate([drawn[:, row], np.concatenate(points)[None]]))
    turned, z = np.empty((len(row), PLACES)), np.empty((len(row), PLACES), np.complex128)
    for number, link in enumerate(links):
        for block in _blocks(each, len(phi)):
            rows = slice(number * each + block.start, number * each + min(block.stop, each))
            some = places[rows]
            turned[rows] = evenly_along(_curves(structure, link, some, np.tile(phi, (len(some), 1))), phi)
            z[rows] = _curves(structure, link, some, turned[rows])
    return StructureAtlas(
        structure=structure,
        drawn=places[:, :-1],
        link=np.repeat(np.arange(len(links)), each),
        point=places[:, -1],
        turned=turned,
        z=z,
    )


def _evenly_spread(count: int, dimensions: int) -> Reals:
    """(dimensions, count) numbers of the unit cube: multiples of the powers of a root of x^(n + 1) = x + 1, less 1."""
    root = 2.0
    for _ in range(60):
        root = (1 + root) ** (1 / (dimensions + 1))
    steps = root ** -np.arange(1.0, dimensions + 1)
    return np.asarray((0.5 + steps[:, None] * np.arange(1, count + 1)) % 1.0)


def _safe(structure: DyadStructure, drawn: Complexes, phi: Reals) -> NDArray[np.bool_]:
    """Which linkages the crank turns fully, with no dyad near its limit."""
    points, sides = in_rows(drawn), assembled_sides(structure, drawn)
    linkages = *structure.drawn_program, points, NO_LINES, sides
    every = np.arange(len(structure.dyads))
    tops = _core.find_tops(*linkages, np.tile(phi, (len(points), 1)), every, between=False)
    cosines = _core.find_cosines(*linkages, tops, every)
    return np.asarray((np.abs(cosines) < np.sqrt(1 - _SAFE**2)).all(axis=(0, 1)))


def _blocks(count: int, each: int) -> Iterator[slice]:
    """Parts of so many rows that their numbers stay near the processor."""
    size = max(1, _BLOCK // each)
    return (slice(k, k + size) for k in range(0, count, size))


def _curves(structure: DyadStructure, link: str, places: Complexes, turned: Reals) -> Complexes:
    """(curves, angles) of points of a link, the last of their places."""
    sides = assembled_sides(structure, places.T[:-1])
    return _core.trace_point(*structure.drawn_program, places, sides, turned, structure.placed_links.index(link))
