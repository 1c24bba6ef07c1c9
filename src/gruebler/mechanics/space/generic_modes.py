"""Linkages with random complex dimensions, and all their closed positions: where paths to given dimensions begin.

The core follows paths of modes. Theorem, method, what may err: docs/theory/modes-in-space.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gruebler import _core
from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError
from gruebler.mechanics.space.following import RANK
from gruebler.mechanics.space.tables import tables_of
from gruebler.mechanics.space.tree import ACROSS, LENGTH, ClosureTree, Dimension
from gruebler.structure.chain.spaces import Space

Complexes = NDArray[np.complex128]

_NEAR = 0.3j  # imaginary parts of random dimensions, of the real ones: far from real ones frames grow large, paths long
_SPREAD = 0.8  # sizes and radians: how far random dimensions lie apart
_LOOP = 0.6  # the same for the corners of a loop
_LENGTHS = 0.7  # of a length, for the corners of a loop
QUICK, CAREFUL = 1e-3, 1e-6  # how far the corrector may change a prediction
_SAME = 1e-6  # of the largest entry: poses of all links that differ by less are one mode
_CLOSED = 1e-8  # residuals, of the square of the largest entry
_BEFORE = 0.5 * 0.6 ** np.arange(13)  # of the way, before its end: there the growth of paths shows
_NEARLY = 0.1  # of the way: growth counts from there on only, since before it paths may come back
_POWER = 0.6  # of what is left of the way: poles have 1 at least
_FAR = 1e3  # of the largest entry: no real pose has such, and beyond it paths lose their digits
QUIET = 15  # loops in vain that end a search
MOST_MODES = 400  # of a structure: a search for more takes minutes


class ComplexDimensions(NamedTuple):
    """Dimensions of a structure: frames of its nodes (nodes, 4, 4), lengths of its rows, values that are given."""

    frames: Complexes
    lengths: Complexes
    given: Complexes


class Positions(NamedTuple):
    """Positions: unknowns (n, unknowns), where turns of balls are counted from, frames of nodes (n, nodes, 4, 4)."""

    q: Complexes
    turns: Complexes
    frames: Complexes

    def at(self, chosen: ArrayLike) -> Positions:
        """Those of these numbers, or where it is true."""
        chosen = np.asarray(chosen) if np.size(chosen) else np.zeros(0, np.intp)
        return Positions(self.q[chosen], self.turns[chosen], self.frames[chosen])

    @property
    def number(self) -> int:
        """How many they are."""
        return len(self.q)

    def joined(self, other: Positions) -> Positions:
        """Both."""
        return Positions(*(np.concatenate(parts) for parts in zip(self, other, strict=True)))


@dataclass(frozen=True, eq=False, kw_only=True)
class ClosureStructure:
    """A closure tree without dimensions, as the core takes it. Trees of one structure differ by dimensions alone."""

    nodes: NDArray[np.int64]
    rows: NDArray[np.int64]
    dimension: tuple[Dimension | None, ...]
    """Of each node the joint and link whose place it is."""
    space: Space
    unknowns: int
    balls: int
    node_of: tuple[int, ...]
    """The node of each node of the tree."""

    def _key(self) -> tuple[object, ...]:
        return self.nodes.tobytes(), self.rows.tobytes(), self.dimension, self.space

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ClosureStructure) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def follow(
        self, begin: ComplexDimensions, end: ComplexDimensions, starts: Positions, loose: float
    ) -> tuple[Positions, Reals, int]:
        """Where paths end on a straight way of the dimensions, the times that they reached, the steps taken."""
        twists = twists_between(begin.frames, end.frames)
        lengths = np.stack([begin.lengths, end.lengths - begin.lengths])
        given = np.stack([begin.given, end.given - begin.given])
        q, turns, frames, times, steps = _core.follow_modes(
            self.nodes, self.rows, begin.frames, twists, lengths, given, starts.q, starts.turns, loose
        )
        return Positions(q, turns, frames), times, int(steps.sum())

    def openings(self, dimensions: ComplexDimensions, frames: Complexes) -> Reals:
        """By how much positions are open, relative to the largest entry of their frames: (n,)."""
        value = _values(self, dimensions, frames)
        size = 1 + abs(frames).max(axis=(1, 2, 3)) ** 2
        return np.asarray(abs(value).max(axis=1, initial=0.0) / size)

    def new_among(self, known: Positions, others: Positions) -> list[int]:
        """The numbers of the others that are none of the known ones, each once."""
        places = self.nodes[:, 1] == 0  # those within a joint depend on where its turns are counted from
        marks = [frames.ravel() for frames in known.frames[:, places]]
        new: list[int] = []
        for k, mark in enumerate(frames.ravel() for frames in others.frames[:, places]):
            far = _SAME * (1 + abs(mark).max())
            if not marks or abs(np.array(marks) - mark).max(axis=1).min() > far:
                marks.append(mark)
                new.append(k)
        return new


def structure_of(tree: ClosureTree, held: frozenset[int]) -> tuple[ClosureStructure, ComplexDimensions]:
    """The structure of a tree and its dimensions; the unknowns that are held keep the value 0."""
    tables = tables_of(tree, held)
    structure = ClosureStructure(
        nodes=tables.nodes,
        rows=tables.rows,
        dimension=tables.dimension,
        space=tree.linkage.mechanism.chain.space,
        unknowns=tree.unknowns - len(held),
        balls=tables.balls,
        node_of=tables.node_of,
    )
    given = np.zeros(len(tables.nodes), complex)
    return structure, ComplexDimensions(tables.frames.astype(complex), tables.lengths.astype(complex), given)


# --- motions with complex entries ------------------------------------------------------------------------------------


def exponentials(twists: Complexes) -> Complexes:
    """The motions (n, 4, 4) of complex twists (n, 6)."""
    x = np.zeros((len(twists), 4, 4), complex)
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        x[:, b, a], x[:, a, b] = twists[:, i], -twists[:, i]
    x[:, :3, 3] = twists[:, 3:]
    square = (twists[:, :3] ** 2).sum(axis=1)[:, None, None]
    root = np.sqrt(np.where(abs(square) < 1e-8, 1.0, square))
    second = np.where(abs(square) < 1e-8, 0.5 - square / 24, (1 - np.cos(root)) / root**2)
    third = np.where(abs(square) < 1e-8, 1 / 6 - square / 120, (root - np.sin(root)) / root**3)
    return np.asarray(np.eye(4) + x + second * (x @ x) + third * (x @ x @ x))


def twists_between(begin: Complexes, end: Complexes) -> Complexes:
    """Twists (n, 6) with end = begin exp(twist), (n, 4, 4) each."""
    between = _inverse(begin) @ end
    cosine = (np.trace(between[:, :3, :3], axis1=1, axis2=2) - 1) / 2
    angle = np.arccos(cosine + 0j)
    small = abs(angle) < 1e-6
    safe = np.where(small, 1.0, angle)
    factor = np.where(small, 1 + angle**2 / 6, safe / np.sin(safe))[:, None, None] / 2
    k = factor * (between[:, :3, :3] - np.swapaxes(between[:, :3, :3], 1, 2))
    second = np.where(small, 0.5, (1 - np.cos(safe)) / safe**2)[:, None, None]
    third = np.where(small, 1 / 6, (safe - np.sin(safe)) / safe**3)[:, None, None]
    left = np.eye(3) + second * k + third * (k @ k)
    twists = np.zeros((len(between), 6), complex)
    twists[:, 0], twists[:, 1], twists[:, 2] = k[:, 2, 1], k[:, 0, 2], k[:, 1, 0]
    twists[:, 3:] = np.linalg.solve(left, between[:, :3, 3:])[..., 0]
    return twists


def _inverse(motions: Complexes) -> Complexes:
    inverse = np.zeros_like(motions)
    inverse[:, :3, :3] = np.swapaxes(motions[:, :3, :3], 1, 2)
    inverse[:, :3, 3:] = -inverse[:, :3, :3] @ motions[:, :3, 3:]
    inverse[:, 3, 3] = 1
    return inverse


# --- random dimensions -----------------------------------------------------------------------------------------------


def _random(rng: np.random.Generator, shape: tuple[int, ...]) -> Complexes:
    return np.asarray(rng.normal(size=shape) + _NEAR * rng.normal(size=shape))


def _in_space(space: Space) -> Reals:
    """1 for each component of a twist in a space, 0 for the others."""
    return np.array([sum(parts) for parts in zip(*(freedom.twist() for freedom in space.directions), strict=True)])


def shifted(
    structure: ClosureStructure, dimensions: ComplexDimensions, rng: np.random.Generator, size: float
) -> ComplexDimensions:
    """Random dimensions around these; the place of one joint on one link stays the same wherever it stands."""
    own = {what: _random(rng, (6,)) for what in dict.fromkeys(structure.dimension) if what is not None}
    twists = np.array([np.zeros(6) if what is None else size * own[what] for what in structure.dimension], complex)
    twists *= _in_space(structure.space)
    change = _LENGTHS * abs(dimensions.lengths) * _random(rng, dimensions.lengths.shape)
    return ComplexDimensions(
        dimensions.frames @ exponentials(twists), dimensions.lengths + change * size / _LOOP, dimensions.given
    )


def random_position(structure: ClosureStructure, rng: np.random.Generator) -> tuple[ComplexDimensions, Positions]:
    """Random dimensions and a position that they close: what is cut is put where it lies.

    Raises `LinkageError` where rows repeat others for almost all dimensions.
    """
    count = len(structure.nodes)
    identities = np.tile(np.eye(4, dtype=complex), (count, 1, 1))
    unit = ComplexDimensions(identities, np.zeros(structure.unknowns, complex), np.zeros(count, complex))
    dimensions = shifted(structure, unit, rng, _SPREAD)
    q = 0.6 * _random(rng, (1, structure.unknowns))
    turns = np.tile(np.eye(3, dtype=complex), (1, structure.balls, 1, 1))
    frames, lengths = dimensions.frames, dimensions.lengths.copy()
    start = Positions(q, turns, _placed(structure, dimensions, q, turns))
    parents = structure.nodes[:, 0]
    g = start.frames[0]
    for r, (kind, first, second, _, _) in enumerate(structure.rows.tolist()):
        if kind == LENGTH:
            gap = g[second, :3, 3] - g[first, :3, 3]
            lengths[r] = np.sqrt((gap * gap).sum() + 0j)
        elif structure.dimension[second] is not None and structure.nodes[second, 1] == 0:
            above = g[parents[second]]
            frames[second] = (_inverse(above[None]) @ g[first][None])[0]
        else:
            raise LinkageError("the loops of this linkage share joints in a way whose assembly modes are not counted")
    closed = ComplexDimensions(frames, lengths, dimensions.given)
    start = Positions(q, turns, _placed(structure, closed, q, turns))
    return closed, start


def _placed(structure: ClosureStructure, dimensions: ComplexDimensions, q: Complexes, turns: Complexes) -> Complexes:
    """Frames of all nodes: where a way of no length ends."""
    count = len(structure.nodes)
    g = np.zeros((len(q), count, 4, 4), complex)
    for k, (parent, kind, axis, sign, unknown, ball) in enumerate(structure.nodes.tolist()):
        above = g[:, parent] if parent >= 0 else np.eye(4, dtype=complex)
        step = np.tile(np.eye(4, dtype=complex), (len(q), 1, 1))
        if kind == 0:
            step[:] = dimensions.frames[k]
        else:
            value = sign * (q[:, unknown] if unknown >= 0 else np.broadcast_to(dimensions.given[k], len(q)))
            twist = np.zeros((len(q), 6), complex)
            twist[:, axis if kind == 1 else 3 + axis] = value
            step = exponentials(twist)
            if ball >= 0:
                step[:, :3, :3] = turns[:, ball] @ step[:, :3, :3]
        g[:, k] = above @ step
    return g


@dataclass(frozen=True, eq=False, kw_only=True)
class GenericModes:
    """Random dimensions of a structure and their closed positions."""

    dimensions: ComplexDimensions
    positions: Positions
    loops: int
    """How many loops of the dimensions the search took; the last `QUIET` found nothing, unless the number was known."""


def generic_modes(structure: ClosureStructure, known: int | None) -> GenericModes:
    """All closed positions of a random linkage of a structure: loops of its dimensions permute them.

    The search ends when the known number is reached, else when loops in vain do.
    """
    rng = np.random.default_rng(1)
    dimensions, modes = random_position(structure, rng)
    if not is_regular(structure, dimensions, modes):
        raise LinkageError(
            "the closing conditions repeat each other with almost all dimensions: in such a structure assembly modes "
            "are not isolated, or not counted"
        )
    loops = quiet = 0
    while quiet < QUIET and modes.number != known:
        here, at = modes, dimensions
        for corner in range(3):
            there = dimensions if corner == 2 else shifted(structure, dimensions, rng, _LOOP)
            here, at = arrived(structure, at, there, here), there
        loops += 1
        here = here.at(structure.openings(dimensions, here.frames) < _CLOSED)
        new = structure.new_among(modes, here)
        quiet = 0 if new else quiet + 1
        modes = modes.joined(here.at(new))
        if modes.number > MOST_MODES:
            raise LinkageError(
                "a linkage of this structure has more than {most} assembly modes, complex ones included; they are not "
                "listed",
                most=MOST_MODES,
            )
    return GenericModes(dimensions=dimensions, positions=modes, loops=loops)


def arrived(
    structure: ClosureStructure, begin: ComplexDimensions, end: ComplexDimensions, starts: Positions
) -> Positions:
    """Where those paths end that arrive, lost ones followed again in finer steps."""
    ends, arrives = _followed(structure, begin, end, starts)
    return ends.at(arrives)


def _followed(
    structure: ClosureStructure, begin: ComplexDimensions, end: ComplexDimensions, starts: Positions
) -> tuple[Positions, NDArray[np.bool_]]:
    ends, times, _ = structure.follow(begin, end, starts, QUICK)
    late = np.flatnonzero(times < 1)
    if len(late):
        again, when, _ = structure.follow(begin, end, starts.at(late), CAREFUL)
        ends = Positions(*(_replaced(a, late, b) for a, b in zip(ends, again, strict=True)))
        times = _replaced(times, late, when)
    return ends, times == 1


def arrived_or_far(
    structure: ClosureStructure, begin: ComplexDimensions, end: ComplexDimensions, starts: Positions
) -> tuple[Positions, int]:
    """Where those paths end that arrive, and how many of the others go far out, to infinity or short of it.

    They end there, or the largest entry of their frames grows like a negative power of what is left of the way. If all
    arrive, none is far.
    """
    ends, arrives = _followed(structure, begin, end, starts)
    if arrives.all():
        return ends, 0
    here, at = starts.at(~arrives), begin
    left = np.arange(here.number)
    sizes = np.zeros((len(_BEFORE), here.number))
    twists = twists_between(begin.frames, end.frames)
    for place, before in enumerate(_BEFORE):
        share = 1 - before
        there = ComplexDimensions(
            begin.frames @ exponentials(share * twists),
            begin.lengths + share * (end.lengths - begin.lengths),
            begin.given + share * (end.given - begin.given),
        )
        here, times, _ = structure.follow(at, there, here, QUICK)
        here, left, at = here.at(times == 1), left[times == 1], there
        sizes[place, left] = abs(here.frames).max(axis=(1, 2, 3), initial=0.0)
    near = abs(ends.frames).max(axis=(1, 2, 3), initial=0.0) < _FAR
    return ends.at(arrives & near), int((arrives & ~near).sum()) + sum(map(_goes_far, sizes.T))


def _goes_far(sizes: Reals) -> bool:
    """Whether a path goes far out, by its sizes at the places before the end of its way; 0 where it was lost before."""
    known = sizes[sizes > 0]
    count = len(known)
    if count < 3 or (count < len(sizes) and (known[-1] < _FAR or _BEFORE[count - 1] > _NEARLY)):
        return False
    return bool(np.log(known[-1] / known[-3]) > _POWER * np.log(_BEFORE[count - 3] / _BEFORE[count - 1]))


def _replaced(a: NDArray, rows: NDArray[np.intp], b: NDArray) -> NDArray:  # type: ignore[type-arg]
    a = a.copy()
    a[rows] = b
    return a


def is_regular(structure: ClosureStructure, dimensions: ComplexDimensions, position: Positions) -> bool:
    """Whether the derivatives at a position have full rank, by differences."""
    step = 1e-6
    size = structure.unknowns
    q = np.tile(position.q, (2 * size, 1))
    q[np.arange(size), np.arange(size)] += step
    q[size + np.arange(size), np.arange(size)] -= step
    turns = np.tile(position.turns, (2 * size, 1, 1, 1))
    values = _values(structure, dimensions, _placed(structure, dimensions, q, turns))
    matrix = (values[:size] - values[size:]).T / (2 * step)
    singular = np.linalg.svd(matrix, compute_uv=False)
    return bool(singular[-1] > RANK * singular[0]) if size else True


def _values(structure: ClosureStructure, dimensions: ComplexDimensions, frames: Complexes) -> Complexes:
    """The values of the rows, (n, rows), for frames of the nodes (n, nodes, 4, 4)."""
    kind, first, second, axis, other = structure.rows.T
    every = np.arange(len(kind))
    columns = np.swapaxes(frames, 2, 3)
    u, v = columns[:, first][:, every, axis, :3], columns[:, second][:, every, other, :3]
    gap = columns[:, second, 3, :3] - columns[:, first, 3, :3]
    value = np.where(kind == ACROSS, (u * v).sum(-1), (u * gap).sum(-1))
    return np.asarray(np.where(kind == LENGTH, ((gap * gap).sum(-1) - dimensions.lengths**2) / 2, value))
