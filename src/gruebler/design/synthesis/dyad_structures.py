"""A crank at the frame and dyads on it: the solving order, and how the planes of many such linkages move at once.

docs/theory/synthesis-any.md. A linkage is drawn in one position, with every joint a place in the plane of all links, or
its links have planes of their own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gruebler import _core
from gruebler.base.arrays import Complexes, Reals
from gruebler.structure.assur import DYADS, AssurError, decompose
from gruebler.structure.mechanism import Mechanism

NO_LINES = np.zeros((0, 0), np.complex128)
"""Of linkages in which nothing slides."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnDyad:
    """Two links, the numbers of their outer joints and of the joint between them, and what the outer joints hang on."""

    links: tuple[str, str]
    outer: tuple[int, int]
    inner: int
    base: tuple[str, str]
    form: int = 0
    """Which joints slide; only turning ones in a drawing."""


class DyadProgram(NamedTuple):
    """What the core is told of a structure: the drive, then a row for each dyad."""

    drive: NDArray[np.int64]
    dyads: NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class DyadStructure:
    """The solving order of a mechanism of a crank and dyads."""

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

    def force_path(self, guided: str) -> tuple[DrawnDyad, ...]:
        """The dyads of the output and of a guided link, and those that hang on the frame on the way from the drive."""
        ends = {self.output, guided}
        loaded, path = {*ends}, []
        for dyad in reversed(self.dyads):
            if loaded & set(dyad.links):
                loaded |= set(dyad.base) - {self.mechanism.frame}
                if ends & set(dyad.links) or self.mechanism.frame in dyad.base:
                    path.append(dyad)
        return tuple(path)

    @property
    def coupler_links(self) -> tuple[str, ...]:
        """The links whose points do not move on circles: those without a joint at the frame."""
        chain, frame = self.mechanism.chain, self.mechanism.frame
        held = {link for joint in chain.joints if frame in joint.links for link in joint.links}
        return tuple(link for link in chain.links if link not in held)

    @cached_property
    def placed_links(self) -> tuple[str, ...]:
        """All links in the order in which they are placed, which is that of the core."""
        return (self.mechanism.frame, self.crank, *(link for dyad in self.dyads for link in dyad.links))

    @cached_property
    def drawn_program(self) -> DyadProgram:
        """Of drawings: the element of a joint is its number on every link."""
        return self.program(lambda joint, _: joint)

    def program(self, element: Callable[[int, str], int]) -> DyadProgram:
        """Of linkages whose elements have numbers, which are told for each joint on each link."""
        number = {link: k for k, link in enumerate(self.placed_links)}
        frame, crank = self.mechanism.frame, self.crank
        drive = [number[frame], number[crank], element(self.pivot, frame), element(self.pivot, crank)]
        rows = [
            [
                dyad.form,
                *(number[link] for link in (*dyad.links, *dyad.base)),
                *(element(joint, base) for joint, base in zip(dyad.outer, dyad.base, strict=True)),
                *(element(joint, link) for joint, link in zip(dyad.outer, dyad.links, strict=True)),
                *(element(dyad.inner, link) for link in dyad.links),
            ]
            for dyad in self.dyads
        ]
        return DyadProgram(np.array(drive, np.int64), np.array(rows, np.int64).reshape(-1, 11))


def dyad_structure(mechanism: Mechanism, *, sliding: bool = False) -> DyadStructure | None:
    """The solving order, if the mechanism is a crank at the frame and dyads of simple joints; None else.

    Args:
        mechanism: driven.
        sliding: whether joints of dyads may slide; else all of them turn.
    """
    chain, frame = mechanism.chain, mechanism.frame
    if len(mechanism.drives) != 1 or frame not in chain.joints[mechanism.drives[0].joint].links:
        return None
    pivot = mechanism.drives[0].joint
    if not chain.joints[pivot].pair.is_turning or any(len(joint.links) != 2 for joint in chain.joints):
        return None
    if any(not joint.pair.is_turning and not (sliding and joint.pair.is_sliding) for joint in chain.joints):
        return None
    try:
        order = decompose(mechanism)
    except AssurError:
        return None
    crank = next(link for link in chain.joints[pivot].links if link != frame)
    dyads = []
    for group in order.groups:
        if len(group.links) != 2:  # no dyad
            return None
        links = group.bodies[0][0], group.bodies[1][0]
        outer = [next(n for n in group.outer if link in chain.joints[n].links) for link in links]
        letters = "".join("P" if chain.joints[n].pair.is_sliding else "R" for n in (outer[0], group.inner[0], outer[1]))
        if letters not in DYADS:
            letters, links, outer = letters[::-1], links[::-1], outer[::-1]
        base = [
            next(other for other in chain.joints[joint].links if other != link)
            for joint, link in zip(outer, links, strict=True)
        ]
        dyads.append(
            DrawnDyad(
                links=links,
                outer=(outer[0], outer[1]),
                inner=group.inner[0],
                base=(base[0], base[1]),
                form=DYADS.index(letters),  # the number of the core
            )
        )
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
        structure: the solving order, of turning joints.
        drawn: (joints, ...) places of the joints in the drawing.
        turned: (..., angles) how far the crank has turned from the drawing.
        sides: (dyads, ...) on which each dyad is assembled: as drawn by default.

    Returns (..., angles) each; NaN where a dyad cannot be assembled. Cost: 0.05 us for each dyad and angle.
    """
    sides = assembled_sides(structure, drawn) if sides is None else sides
    shape = (*drawn.shape[1:], turned.shape[-1])
    points, own = in_rows(drawn), np.ascontiguousarray(sides.reshape(len(sides), -1))
    angles = np.ascontiguousarray(np.broadcast_to(turned, shape)).reshape(len(points), -1)
    turns, shifts = _core.move_planes(*structure.drawn_program, points, NO_LINES, own, angles)
    return {
        link: (turn.reshape(shape), shift.reshape(shape))
        for link, turn, shift in zip(structure.placed_links, turns, shifts, strict=True)
    }


def in_rows(columns: Complexes) -> Complexes:
    """Of (numbers, ...) a row for each linkage, as the core takes them."""
    return np.ascontiguousarray(columns.reshape(len(columns), -1).T)
