"""An atlas of coupler curves of one structure: a crank and dyads of turning joints, moved in closed form.

A linkage is drawn in one position: every joint is a place in the plane. All linkages of the atlas move at once;
docs/theory/synthesis-any.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler.base.arrays import Complexes, Reals
from gruebler.design.synthesis.curve_matching import PLACES, evenly_along
from gruebler.structure.assur import AssurError, decompose
from gruebler.structure.mechanism import Mechanism

_TRIALS = 120_000
_LARGEST = 6.0  # places of joints, in crank lengths
_SAFE = 0.15  # the least sine of an angle between two links of a dyad, so that small changes do not stop the motion
_CURVES = 24_000
_BLOCK = 1 << 15  # places of linkages that are looked at together


class DrawnDyad(NamedTuple):
    """Two links, the numbers of their outer joints and of the joint between them, and what the outer joints hang on."""

    links: tuple[str, str]
    outer: tuple[int, int]
    inner: int
    base: tuple[str, str]


@dataclass(frozen=True, kw_only=True)
class DyadStructure:
    """The solving order of a mechanism of a crank and RRR dyads."""

    mechanism: Mechanism
    written_form: tuple[object, ...]
    """Of the mechanism: the numbers of joints hold for it only."""
    pivot: int
    """The driven joint."""
    crank: str
    dyads: tuple[DrawnDyad, ...]
    joints: int

    @property
    def output(self) -> str:
        """The link whose transmission angle counts: the last one at the frame that is not driven."""
        chain, frame = self.mechanism.chain, self.mechanism.frame
        held = {link for joint in chain.joints if frame in joint.links for link in joint.links}
        return [link for link in chain.links if link in held - {frame, self.crank}][-1]

    @property
    def force_path(self) -> tuple[DrawnDyad, ...]:
        """The dyad of the output, and those that hang on the frame on the way from the drive to it."""
        loaded, path = {self.output}, []
        for dyad in reversed(self.dyads):
            if loaded & set(dyad.links):
                loaded |= set(dyad.base) - {self.mechanism.frame}
                if self.output in dyad.links or self.mechanism.frame in dyad.base:
                    path.append(dyad)
        return tuple(path)

    @property
    def coupler_links(self) -> tuple[str, ...]:
        """The links whose points do not move on circles: those without a joint at the frame."""
        chain, frame = self.mechanism.chain, self.mechanism.frame
        held = {link for joint in chain.joints if frame in joint.links for link in joint.links}
        return tuple(link for link in chain.links if link not in held)


def dyad_structure(mechanism: Mechanism) -> DyadStructure | None:
    """The solving order, if the mechanism is a crank at the frame and dyads of simple turning joints; None else."""
    chain, frame = mechanism.chain, mechanism.frame
    if len(mechanism.drives) != 1 or frame not in chain.joints[mechanism.drives[0].joint].links:
        return None
    if any(not joint.pair.is_turning or len(joint.links) != 2 for joint in chain.joints):
        return None
    try:
        order = decompose(mechanism)
    except AssurError:
        return None
    pivot = mechanism.drives[0].joint
    crank = next(link for link in chain.joints[pivot].links if link != frame)
    dyads = []
    for group in order.groups:
        if len(group.links) != 2:  # no dyad
            return None
        links = group.bodies[0][0], group.bodies[1][0]
        outer, base = [], []
        for link in links:
            joint = next(n for n in group.outer if link in chain.joints[n].links)
            outer.append(joint)
            base.append(next(other for other in chain.joints[joint].links if other != link))
        dyads.append(DrawnDyad(links, (outer[0], outer[1]), group.inner[0], (base[0], base[1])))
    return DyadStructure(
        mechanism=mechanism,
        written_form=mechanism.written_form,
        pivot=pivot,
        crank=crank,
        dyads=tuple(dyads),
        joints=len(chain.joints),
    )


LinkMotions = dict[str, tuple[Complexes, Complexes]]
"""Of each link how its plane has moved: rotation and shift."""
PinPlaces = Callable[[int, str], Complexes]
"""(..., 1) where a joint, by its number, lies in the plane of a link."""


def assembled_sides(structure: DyadStructure, drawn: Complexes) -> Reals:
    """(dyads, ...) on which side of the line between its outer joints each dyad is drawn: 1 left, -1 right."""
    return np.array(
        [
            np.sign(np.imag(np.conj(drawn[far] - drawn[own]) * (drawn[dyad.inner] - drawn[own])))
            for dyad in structure.dyads
            for own, far in (dyad.outer,)
        ]
    )


def link_motions(structure: DyadStructure, drawn: Complexes, turned: Reals, sides: Reals | None = None) -> LinkMotions:
    """How each link moves away from the drawing: a point w of it goes to rotation w + shift.

    Args:
        structure: the solving order.
        drawn: (joints, ...) places of the joints in the drawing.
        turned: (..., angles) how far the crank has turned from the drawing.
        sides: (dyads, ...) on which each dyad is assembled: as drawn by default.

    Returns (..., angles) each; NaN where a dyad cannot be assembled. Cost: 0.1 us for each dyad and angle.
    """
    sides = assembled_sides(structure, drawn) if sides is None else sides
    return plane_motions(structure, pins_of_drawing(drawn[..., None]), turned, sides)


def pins_of_drawing(places: Complexes) -> PinPlaces:
    """All links have the plane of the drawing."""
    return lambda joint, _: places[joint]


def plane_motions(structure: DyadStructure, pin: PinPlaces, turned: Reals, sides: Reals) -> LinkMotions:
    """How the plane of each link moves, which may have coordinates of its own, as `link_motions`."""
    frame, crank = structure.mechanism.frame, structure.crank
    own, far = pin(structure.pivot, frame), pin(structure.pivot, crank)
    ones = np.ones(np.broadcast_shapes(own.shape, turned.shape), np.complex128)
    spin = np.exp(1j * turned) * ones
    motions = {frame: (ones, 0 * ones), crank: (spin, own * (1 - spin) + spin * (own - far))}
    with np.errstate(invalid="ignore", divide="ignore"):
        for dyad, side in zip(structure.dyads, sides[..., None], strict=True):
            ends = [
                rotation * pin(joint, base) + shift
                for joint, base in zip(dyad.outer, dyad.base, strict=True)
                for rotation, shift in (motions[base],)
            ]
            arms = dyad_arms(dyad, pin)
            gap = ends[1] - ends[0]
            distance, squared = np.abs(gap), np.abs(arms[0]) ** 2
            along = (squared - np.abs(arms[1]) ** 2 + distance**2) / (2 * distance)
            across = side * np.sqrt(squared - along**2)
            inner = ends[0] + gap / distance * (along + 1j * across)
            for link, end, joint, arm in zip(dyad.links, ends, dyad.outer, arms, strict=True):
                rotation = (inner - end) / arm
                motions[link] = rotation, end - rotation * pin(joint, link)
    return motions


def dyad_arms(dyad: DrawnDyad, pin: PinPlaces) -> list[Complexes]:
    """From the outer joint of each link of a dyad to the inner one, in the plane of the link."""
    return [pin(dyad.inner, link) - pin(joint, link) for link, joint in zip(dyad.links, dyad.outer, strict=True)]


def link_slopes(
    structure: DyadStructure, columns: Complexes, motions: LinkMotions, *, by_places: bool
) -> dict[str, tuple[Complexes, Complexes]]:
    """How rotation and shift of each link change with the crank; before that, if wanted, with x, y of all joints.

    An inner joint of a dyad moves by v with Re(conj(m) v) given for both of its links m; so v follows from two
    linear equations.

    Args:
        structure: the solving order.
        columns: (joints or more, linkages, 1) places in the drawing.
        motions: of the links, (linkages, angles).
        by_places: whether the places change, too.

    Returns (numbers, linkages, angles) each.
    """
    count = 2 * structure.joints if by_places else 0

    def with_place(slopes: Complexes, joint: int, factor: Complexes) -> Complexes:
        if by_places:
            slopes[2 * joint] += factor
            slopes[2 * joint + 1] += 1j * factor
        return slopes

    spin = motions[structure.crank][0]
    still = np.zeros((count + 1, *spin.shape), np.complex128)
    pivot = columns[structure.pivot]
    turn, shift = still.copy(), still.copy()
    turn[-1], shift[-1] = 1j * spin, -1j * spin * pivot
    slopes = {
        structure.mechanism.frame: (still, still),
        structure.crank: (turn, with_place(shift, structure.pivot, 1 - spin)),
    }
    for dyad in structure.dyads:
        moved, across, along = [], [], []
        for joint, base, link in zip(dyad.outer, dyad.base, dyad.links, strict=True):
            by_turn, by_shift = slopes[base]
            moved.append(with_place(by_turn * columns[joint] + by_shift, joint, motions[base][0]))
            arm = columns[dyad.inner] - columns[joint]
            across.append(motions[link][0] * arm)
            given = np.real(np.conj(across[-1]) * moved[-1])
            if by_places:
                for other, sign in ((dyad.inner, 1.0), (joint, -1.0)):
                    given[2 * other] += sign * arm.real
                    given[2 * other + 1] += sign * arm.imag
            along.append(given)
        first, second = across
        inner = 1j * (along[1] * first - along[0] * second) / np.imag(np.conj(first) * second)
        for joint, link, by_outer in zip(dyad.outer, dyad.links, moved, strict=True):
            rotation, arm = motions[link][0], columns[dyad.inner] - columns[joint]
            by_turn = (inner - by_outer) / arm
            with_place(by_turn, dyad.inner, -rotation / arm)
            with_place(by_turn, joint, rotation / arm)
            slopes[link] = by_turn, with_place(by_outer - by_turn * columns[joint], joint, -rotation)
    return slopes


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
    owner, row, point = np.repeat(np.arange(len(links)), each), np.tile(row, len(links)), np.concatenate(points)
    drawn = drawn[:, row]
    turned = evenly_along(_curves(structure, drawn, owner, point, np.broadcast_to(phi, (len(row), len(phi)))), phi)
    return StructureAtlas(
        structure=structure,
        drawn=drawn.T,
        link=owner,
        point=point,
        turned=turned,
        z=_curves(structure, drawn, owner, point, turned),
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
    safe = np.ones(drawn.shape[1], bool)
    for block in _blocks(drawn.shape[1], len(phi)):
        some = drawn[:, block]
        motions = link_motions(structure, some, phi[None, :])
        for dyad in structure.dyads:
            arms = [some[dyad.inner] - some[joint] for joint in dyad.outer]
            units = [arm / np.abs(arm) for arm in arms]
            turned = [motions[link][0] * unit[:, None] for link, unit in zip(dyad.links, units, strict=True)]
            with np.errstate(invalid="ignore"):
                safe[block] &= (np.abs(np.imag(np.conj(turned[0]) * turned[1])) > _SAFE).all(axis=1)
    return safe


def _blocks(count: int, each: int) -> Iterator[slice]:
    """Parts of so many rows that their numbers stay near the processor."""
    size = max(1, _BLOCK // each)
    return (slice(k, k + size) for k in range(0, count, size))


def _curves(
    structure: DyadStructure, drawn: Complexes, owner: NDArray[np.int64], point: Complexes, turned: Reals
) -> Complexes:
    curves = np.empty(turned.shape, np.complex128)
    for number, link in enumerate(structure.coupler_links):
        rows = np.flatnonzero(owner == number)
        for block in _blocks(len(rows), turned.shape[1]):
            some = rows[block]
            rotation, shift = link_motions(structure, drawn[:, some], turned[some])[link]
            curves[some] = rotation * point[some, None] + shift
    return curves
