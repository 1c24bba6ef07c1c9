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

_TRIALS, _BLOCKS_OF_TRIALS = 60_000, 16  # drawings at once; how often at most, until enough of them turn
_LARGEST = 6.0  # places of joints, in crank lengths, where the crank is short
_SAFE, _SAFE_WHERE_SHORT = 0.05, 0.15  # the least sine of an angle between two links of a dyad
_CURVES = 24_000  # of each kind of drawings
_BLOCK = 1 << 15  # places of linkages that are looked at together


@dataclass(frozen=True, slots=True, kw_only=True)
class StructureAtlas:
    """Curves of points of links that no joint holds at the frame; the crank turns fully and has the length 1."""

    structure: DyadStructure
    drawn: Complexes
    """(curves, joints) where the joints lie in the drawing."""
    short: NDArray[np.bool_]
    """(curves,) whether the crank is short: no joint is nearer to its pivot than its own end."""
    link: NDArray[np.int64]
    """(curves,) which of the coupler links carries the point."""
    point: Complexes
    """(curves,) where the point lies in the drawing."""
    turned: NDArray[np.float32]
    """(curves, places) how far the crank has turned at places evenly along the curve."""
    z: NDArray[np.complex64]
    """(curves, places)"""


@cache
def structure_atlas(structure: DyadStructure) -> StructureAtlas:
    """The atlas of a structure, made at its first use from evenly spread drawings. Cost: 1 s, 40 MB for six links.

    Without curves where no drawing turns.
    """
    links, chain = structure.coupler_links, structure.mechanism.chain
    each = _CURVES // max(1, len(links))
    parts, kinds = [], []
    for short in (True, False):
        drawn, chance = _turning_drawings(structure, each, short=short)
        if not drawn.shape[1]:
            continue
        row, lap = np.arange(each) % drawn.shape[1], np.arange(each) // drawn.shape[1]
        parts.append((drawn[:, row], (chance[:, row] + np.array([[0.618034], [0.754878]]) * lap) % 1.0))
        kinds += [short] * each
    nothing = np.zeros((structure.joints, 0), np.complex128), np.zeros((2, 0))
    drawn, (reach, angle) = (np.concatenate(both, axis=1) for both in zip(*(parts or [nothing]), strict=True))
    points = []
    for link in links:
        near = [n for n, joint in enumerate(chain.joints) if link in joint.links]
        spread, middle = np.abs(drawn[near[0]] - drawn[near[1]]), drawn[near].mean(axis=0)
        points.append(middle + 1.5 * spread * np.sqrt(reach) * np.exp(2j * np.pi * angle))
    places = in_rows(np.concatenate([np.tile(drawn, len(links)), np.concatenate(points)[None]]))
    turned, z = np.empty((len(places), PLACES), np.float32), np.empty((len(places), PLACES), np.complex64)
    phi, every = np.linspace(0, 2 * np.pi, 2 * PLACES + 1), len(kinds)
    for number, link in enumerate(links):
        for block in _blocks(every, len(phi)):
            rows = slice(number * every + block.start, number * every + min(block.stop, every))
            some = places[rows]
            angles = evenly_along(_curves(structure, link, some, np.tile(phi, (len(some), 1))), phi)
            turned[rows], z[rows] = angles, _curves(structure, link, some, angles)
    return StructureAtlas(
        structure=structure,
        drawn=places[:, :-1],
        short=np.tile(np.array(kinds, np.bool_), len(links)),
        link=np.repeat(np.arange(len(links)), every),
        point=places[:, -1],
        turned=turned,
        z=z,
    )


def _turning_drawings(structure: DyadStructure, count: int, *, short: bool) -> tuple[Complexes, Reals]:
    """(joints, drawings) whose cranks turn fully and have the length 1, and two more numbers spread with each.

    Fewer than so many where they are rare. Cost: 0.2 s for 60,000 trials.

    Args:
        structure: the solving order.
        count: how many are enough.
        short: whether all joints lie outside the circle of the crank; else their places are normally distributed, which
            prefers no joint: those of a double crank lie around the pivot of its crank.
    """
    chain, joints, pivot = structure.mechanism.chain, structure.joints, structure.pivot
    own = [n for n, joint in enumerate(chain.joints) if structure.crank in joint.links and n != pivot]
    coarse, fine = np.linspace(0, 2 * np.pi, 25)[:-1], np.linspace(0, 2 * np.pi, 2 * PLACES + 1)[:-1]
    kept: list[Complexes] = []
    spread: list[Reals] = []
    safe_sine = _SAFE_WHERE_SHORT if short else _SAFE
    for block in range(_BLOCKS_OF_TRIALS):
        unit = _evenly_spread(np.arange(1, _TRIALS + 1) + block * _TRIALS, 2 * joints + 3)
        away, spin = unit[0::2][:joints], np.exp(2j * np.pi * unit[1::2][:joints])
        if short:
            drawn = np.exp(np.log(_LARGEST) * away) * spin
            drawn[pivot], drawn[own] = 0, drawn[own] / np.abs(drawn[own[0]])
        else:
            drawn = np.sqrt(-2 * np.log1p(-away)) * spin
            drawn = (drawn - drawn[pivot]) / np.abs(drawn[own[0]] - drawn[pivot])
        for angles in (coarse[::6], coarse, fine):  # most fail at the first ones
            safe = _safe(structure, drawn, angles, safe_sine, between=angles is fine)
            drawn, unit = drawn[:, safe], unit[:, safe]
        kept.append(drawn)
        spread.append(unit[-3:-1])
        if sum(each.shape[1] for each in kept) >= count:
            break
    return np.concatenate(kept, axis=1), np.concatenate(spread, axis=1)


def _evenly_spread(numbers: NDArray[np.int64], dimensions: int) -> Reals:
    """(dimensions, numbers) of the unit cube: multiples of the powers of a root of x^(n + 1) = x + 1, less 1."""
    root = 2.0
    for _ in range(60):
        root = (1 + root) ** (1 / (dimensions + 1))
    steps = root ** -np.arange(1.0, dimensions + 1)
    return np.asarray((0.5 + steps[:, None] * numbers) % 1.0)


def _safe(structure: DyadStructure, drawn: Complexes, phi: Reals, sine: float, *, between: bool) -> NDArray[np.bool_]:
    """Which linkages the crank turns fully, so that the angle of no dyad has a smaller sine."""
    points, sides = in_rows(drawn), assembled_sides(structure, drawn)
    linkages = *structure.drawn_program, points, NO_LINES, sides
    every = np.arange(len(structure.dyads))
    tops = _core.find_tops(*linkages, np.tile(phi, (len(points), 1)), every, between=between)
    cosines = _core.find_cosines(*linkages, tops, every)
    return np.asarray((np.abs(cosines) < np.sqrt(1 - sine**2)).all(axis=(0, 1)))


def _blocks(count: int, each: int) -> Iterator[slice]:
    """Parts of so many rows that their numbers stay near the processor."""
    size = max(1, _BLOCK // each)
    return (slice(k, k + size) for k in range(0, count, size))


def _curves(structure: DyadStructure, link: str, places: Complexes, turned: Reals) -> Complexes:
    """(curves, angles) of points of a link, the last of their places."""
    sides = assembled_sides(structure, places.T[:-1])
    return _core.trace_point(*structure.drawn_program, places, sides, turned, structure.placed_links.index(link))
