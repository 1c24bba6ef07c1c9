"""All assembly modes of a linkage in space or on the sphere, its drives held."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from math import tau
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.base.doors import door_that_raises
from gruebler.base.errors import LinkageError
from gruebler.base.notebook import brief, explained
from gruebler.base.text import message
from gruebler.mechanics.kinematics import solve
from gruebler.mechanics.kinematics.drive_rows import row_of_values, warn_of_angles
from gruebler.mechanics.kinematics.messages import drive_values
from gruebler.mechanics.linkages.conversion import LinkageLike, linkage_made
from gruebler.mechanics.screws.conversion import SpatialLike
from gruebler.mechanics.screws.joint_places import Vector
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.closure import ClosingConditions
from gruebler.mechanics.space.following import most_idle, setting
from gruebler.mechanics.space.generic_modes import (
    ClosureStructure,
    ComplexDimensions,
    GenericModes,
    Positions,
    arrived,
    arrived_or_far,
    generic_modes,
    is_regular,
    shifted,
    structure_of,
)
from gruebler.mechanics.space.mode_numbers import known_number
from gruebler.mechanics.space.moving import moved
from gruebler.mechanics.space.rods import place_rods
from gruebler.mechanics.space.tree import ClosureTree, locked_tree
from gruebler.structure.chain.spaces import Space

_WAYS = 20  # of the dimensions, for paths that are missing
_VAIN = 3  # of them that show nothing new end the search
_NEXT = 0.3  # sizes and radians: how far dimensions next to the target lie from it
_REAL = 1e-7  # of the largest entry: imaginary parts that are rounding
_CLOSED = 1e-9
_SAME = 1e-5  # radians and sizes: poses that differ by less are one, where two modes almost meet

_REFERENCE = message("In the reference pose")
_AT = message("At {drives}")
_ALL = message("{where}: {found} assembly modes, {real} of them real; these are all.")
_OTHERS_FAR = message(
    "{where}: {found} assembly modes, {real} of them real; these are all: the others of the {generic} that almost all "
    "dimensions have lie at infinity for these, or beyond a thousand sizes."
)
_FOUND = message(
    "{where}: {found} assembly modes were found, {real} of them real; no theorem says how many there are, and "
    "{loops} loops of the dimensions found {generic} for almost all of them."
)
_SPECIAL = message(
    "{where}: {found} assembly modes, {real} of them real, where almost all dimensions have {generic}: for these, "
    "{far} lie at infinity or beyond a thousand sizes, the others together, or they were not found."
)
_MISSED = message(
    "{where}: {found} assembly modes were found, {real} of them real, and the position in which the linkage stands is "
    "none of them: modes that are not isolated, or that meet, are not found. These are not all."
)
_LOOSE = message(
    "{where}: {found} assembly modes were found, {real} of them real; at {singular} of them the closing conditions "
    "repeat each other: they are not isolated, or they meet others. These may not be all."
)


@compared_by_value
@explained
@brief
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class SpatialModes:
    """The assembly modes of a linkage in space at values of its drives; its length is the number of real ones."""

    linkage: SpatialLinkage
    drives: tuple[float, ...]
    """The values of the drives."""
    poses: Reals
    """(modes, links, 4, 4): where each link is against the reference pose, in real modes; in a fixed order."""
    number: int
    """How many modes were found, complex ones included."""
    generic: int
    """How many almost all dimensions of this structure have, complex ones included; none have more isolated ones."""
    far: int
    """How many of these lie at infinity for the linkage's own dimensions, or entries of their frames are beyond 1000:
    paths lead there. None of them is real, unless parts shift so far."""
    known: bool
    """Whether a theorem says so; else loops of the dimensions in vain ended a search, which may have missed some."""
    loops: int
    """How many loops of the dimensions the search for the generic modes took."""
    gap: float
    """By how much joints of the modes are open at most, of the size."""
    singular: int = 0
    """At how many of them the closing conditions repeat each other: they are not isolated, or they meet others."""
    reached: bool | None = None
    """Whether the position is among them to which the reference pose leads; None where that is not known."""

    def __len__(self) -> int:
        return len(self.poses)

    @property
    def exact(self) -> bool:
        """Whether these are all: with those far out as many as the theorem says, the reference pose among them."""
        return self.known and self.number + self.far == self.generic and not self.singular and self.reached is not False

    def pose(self, link: str) -> Reals:
        """Where a link is, (modes, 4, 4), against the reference pose."""
        return np.asarray(self.poses[:, self.linkage.mechanism.chain.index(link)])

    def linkage_in(self, mode: int) -> SpatialLinkage:
        """The linkage with this mode as its reference pose: its drives are 0 there; `LinkageError` for no such mode."""
        if not -len(self) <= mode < len(self):
            raise LinkageError("there is no mode {mode}: counted from 0, {count} are real", mode=mode, count=len(self))
        chain, poses = self.linkage.mechanism.chain, self.poses[mode]

        def moved(vector: Vector | None, link: str, whole: bool = False) -> Vector | None:
            if vector is None:
                return None
            pose = poses[chain.index(link)]
            x, y, z = (pose[:3, :3] @ vector + whole * pose[:3, 3]).tolist()
            return x, y, 0.0 if chain.space is Space.PLANAR else z

        places = []
        for joint, place, frame in zip(chain.joints, self.linkage.places, self.linkage.frames, strict=True):
            first, last = joint.links[0], joint.links[-1]
            x, y, z = place.x, place.y, place.z
            if joint.pair.has_body_between:
                x, y, z = tuple(frame[:3, 0]), tuple(frame[:3, 1]), None
                y = moved(y, last)
            else:
                y = moved(y, first)
            at = moved(place.at, first, True) or place.at
            places.append(replace(place, at=at, x=moved(x, first), y=y, z=moved(z, first)))
        points = {name: (link, *(moved(at, link, True) or at)) for name, (link, at) in self.linkage.points.items()}
        bodies = {
            name: replace(body, at=moved(body.at, body.link, True) or body.at, z=moved(body.z, body.link) or body.z)
            for name, body in self.linkage.round_bodies.items()
        }
        return SpatialLinkage(
            self.linkage.mechanism,
            tuple(places),
            unit=self.linkage.unit,
            points=points,
            outputs=self.linkage.outputs,
            round_bodies=bodies,
        )

    def explain(self, lang: str = "en") -> str:
        """How many modes there are and were found, a sentence in English or German (``de``)."""
        if self.reached is False:
            text = _MISSED
        elif self.singular and self.number + self.far == self.generic:
            text = _LOOSE
        elif self.exact:
            text = _OTHERS_FAR if self.far else _ALL
        else:
            text = _FOUND if self.number == self.generic else _SPECIAL
        at = _AT.filled(drives=drive_values(self.linkage, self.drives)) if any(self.drives) else _REFERENCE
        return text.filled(
            where=at,
            far=self.far,
            found=self.number,
            real=len(self),
            generic=self.generic,
            loops=self.loops,
            singular=self.singular,
        ).in_language(lang)


@overload
def assembly_modes(linkage: SpatialLike, drives: float | ArrayLike) -> SpatialModes: ...


@overload
def assembly_modes(linkage: LinkageLike, drives: float | ArrayLike) -> list[str]: ...


@door_that_raises(LinkageError)
def assembly_modes(linkage: LinkageLike | SpatialLike, drives: float | ArrayLike) -> list[str] | SpatialModes:
    """Every assembly mode that a linkage has at a drive value, in the plane as `move` takes it for ``branch``.

    Args:
        linkage: whose drives fix the motion.
        drives: a value for each drive: angles in radians, displacements in the linkage's unit.

    Returns:
        In the plane the modes as texts that ``branch`` takes, such as ``"+-"``; `possible_modes` of the room says how
        many there can be. In space `SpatialModes`: the poses of all links in each real mode, how many there are with
        complex ones, and whether these are all.

    Raises:
        LinkageError: drives that do not fix the motion, values that are no numbers; in space overconstrained linkages,
            screws and wheels.

    Cost:
        In the plane one solution for each mode. In space some milliseconds a mode, and once for each structure a search
        for the modes of almost all dimensions: 0.1 s for 16 modes, 0.7 s for 40.

    Example:
        >>> from gruebler.mechanics.fourbar import FourBar
        >>> from gruebler.mechanics.space import RSSR
        >>> assembly_modes(FourBar(25, 70, 40, 70), 1.0)
        ['+', '-']

    See Also:
        `move`, `circuit`

    Theory:
        docs/theory/modes-in-space.md
    """
    placed = linkage_made(linkage)
    if not isinstance(placed, SpatialLinkage):
        return solve.assembly_modes(placed, drives)
    mechanism = placed.mechanism
    row = row_of_values(drives, len(mechanism.drives))
    warn_of_angles(mechanism, row)
    _check(placed)
    tree, held, values = _held(placed, row[0])
    structure, target = structure_of(tree, held)
    for unknown, value in values.items():
        target.given[structure.node_of[unknown + 1]] = value
    known = known_number(tree)
    generic = _generic(structure, known)
    ends, far = _all_ends(structure, generic, target)
    return _modes(placed, tuple(map(float, row[0])), tree, structure, target, generic, known, ends, far)


def _check(linkage: SpatialLinkage) -> None:
    """Refuse what has infinitely many modes, or several for each pose of its links."""
    chain = linkage.mechanism.chain
    for number, joint in enumerate(chain.joints):
        if joint.pair.has_pitch and linkage.places[number].pitch:
            raise LinkageError(
                "{joint}: a linkage with a screw has infinitely many complex assembly modes; they are not listed",
                joint=chain.joint_title(number),
            )
        if joint.pair.has_contours:
            raise LinkageError(
                "{joint}: assembly modes are listed of linkages without wheels and cams",
                joint=chain.joint_title(number),
            )


def _held(linkage: SpatialLinkage, row: Reals) -> tuple[ClosureTree, frozenset[int], dict[int, float]]:
    """The tree with its drives held, the unknowns that are given besides, and the values of those not 0."""
    mechanism = linkage.mechanism
    chain = mechanism.chain
    setting(linkage)
    locked: dict[int, float] = {}
    others: list[float] = []
    for drive, value in zip(mechanism.drives, row.tolist(), strict=True):
        joint = chain.joints[drive.joint]
        turns = next(f.turns for f in joint.pair.freedoms[chain.space] if f.axis == drive.direction[-1])
        own = value / (1.0 if turns else linkage.size)
        if joint.pair.f(chain.space) == 1:
            locked[drive.joint] = -own if joint.links[1] == mechanism.frame else own
        else:
            others.append(own)
    tree = locked_tree(linkage, locked)
    closure = ClosingConditions(tree)
    passive = np.setdiff1d(np.arange(tree.unknowns), tree.drives)
    free = len(passive) - len(tree.rows)
    if free < 0:
        raise LinkageError(
            "the linkage is overconstrained ({rows} closing conditions for {unknowns} unknowns) and closes with "
            "special dimensions only; all modes can be found only of linkages that close with almost any dimensions",
            rows=len(tree.rows),
            unknowns=len(passive),
        )
    by_unknown = closure.linearised(closure.reference)[1]
    held = most_idle(by_unknown[:, passive], passive, free) if free else []
    values = dict(zip(tree.drives, (np.array(others) * tree.signs).tolist(), strict=True))
    return tree, frozenset({*held, *tree.drives}), values


@lru_cache(maxsize=32)
def _generic(structure: ClosureStructure, known: int | None) -> GenericModes:
    return generic_modes(structure, known)


def _all_ends(structure: ClosureStructure, generic: GenericModes, target: ComplexDimensions) -> tuple[Positions, int]:
    """Where the paths from the generic modes end, and how many go far out.

    If some do not arrive straight on, ways over dimensions next to the target follow, until on one of them every path
    has arrived or goes far out, or a few have shown nothing new.
    """
    rng = np.random.default_rng(7)
    begin, starts = generic.dimensions, generic.positions
    distinct, far = starts.at([]), 0
    here, at, vain = starts, begin, 0
    for _ in range(_WAYS):
        if here.number == starts.number:
            ends, beyond = arrived_or_far(structure, at, target, here)
            ends = ends.at(structure.openings(target, ends.frames) < _CLOSED)
            new = structure.new_among(distinct, ends)
            vain = 0 if new or beyond > far else vain + 1
            distinct, far = distinct.joined(ends.at(new)), max(far, beyond)
            if len(structure.new_among(starts.at([]), ends)) + beyond == starts.number:
                return distinct, starts.number - distinct.number
            if vain == _VAIN:
                break
        at = shifted(structure, target, rng, _NEXT)
        here = arrived(structure, begin, at, starts)
    return distinct, min(far, starts.number - distinct.number)


def _modes(
    linkage: SpatialLinkage,
    drives: tuple[float, ...],
    tree: ClosureTree,
    structure: ClosureStructure,
    target: ComplexDimensions,
    generic: GenericModes,
    known: int | None,
    ends: Positions,
    far: int,
) -> SpatialModes:
    places = structure.nodes[:, 1] == 0
    size = 1 + abs(ends.frames).max(axis=(1, 2, 3), initial=0.0)
    imaginary = abs(ends.frames[:, places].imag).max(axis=(1, 2, 3), initial=0.0)
    real = ends.at(imaginary < _REAL * size)
    poses = _poses(tree, real.frames.real[:, list(structure.node_of)])
    order = np.lexsort(np.round(poses.reshape(len(poses), -1), 6).T[::-1]) if len(poses) else np.zeros(0, np.intp)
    poses = poses[order]
    scale, centre = tree.scale, linkage.centre
    poses[..., :3, 3] *= scale
    poses[..., :3, 3] += centre - poses[..., :3, :3] @ centre
    singular = [k for k in range(ends.number) if not is_regular(structure, target, ends.at([k]))]
    there = _led_to(linkage, np.array(drives), structure.unknowns == tree.unknowns)
    return SpatialModes(
        linkage=linkage,
        drives=drives,
        poses=poses,
        number=ends.number,
        generic=generic.positions.number,
        far=far,
        known=known is not None and generic.positions.number == known,
        loops=generic.loops,
        gap=float(structure.openings(target, ends.frames).max(initial=0.0)),
        singular=len(singular),
        reached=None if there is None else _is_among(there, poses, tree),
    )


def _led_to(linkage: SpatialLinkage, drives: Reals, unique: bool) -> Reals | None:
    """The poses (links, 4, 4) to which a motion leads from the reference pose, within a turn of the drives.

    None if it ends before; where unknowns are held that are idle, a motion may hold others.
    """
    if not drives.any():
        return np.tile(np.eye(4), (linkage.mechanism.chain.n, 1, 1))
    turning = np.array([drive.turning for drive in linkage.mechanism.drives])
    if not unique or (abs(drives) > np.where(turning, tau, 3 * linkage.size)).any():
        return None
    motion = moved(setting(linkage), drives[None], np.zeros((0, 1, len(drives))))
    return motion.poses[0, -1] if motion.complete else None


def _is_among(there: Reals, poses: Reals, tree: ClosureTree) -> bool:
    """Whether poses (links, 4, 4) are one of those (modes, links, 4, 4); rods may lie as they do."""
    links = [link for link, place in enumerate(tree.links) if place is not None]
    apart = abs(poses[:, links] - there[links])
    apart[..., :3, 3] /= tree.scale + abs(there[links][..., :3, 3]).max(initial=0.0)
    return bool((apart.max(axis=(1, 2, 3), initial=0.0) < _SAME).any())


def _poses(tree: ClosureTree, g: Reals) -> Reals:
    """The poses of all links (modes, links, 4, 4) from frames of the nodes of the tree."""
    poses = np.zeros((len(g), len(tree.links), 4, 4))
    for link, place in enumerate(tree.links):
        if place is not None:
            poses[:, link] = g[:, place.node] @ place.at
    if tree.rods:
        place_rods(tree, poses)
        for link in tree.bodies.links_of_rods(tree.rods):
            poses[:, link] = poses[:, tree.bodies.of[link]] @ tree.bodies.poses[link]
    return poses
