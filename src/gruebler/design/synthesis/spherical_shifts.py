"""How far the targets of four-bars on the sphere move when arcs are wrong: exact, for one linkage or many.

docs/theory/synthesis-sphere.md, "Sensitivity".
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from gruebler.base.arrays import Reals, compared_by_value
from gruebler.design.synthesis.sensitivity import LENGTH_ERROR

_NEIGHBOURS = (3, 0, 1, 0)
"""For A0, A, B and B0 the other axis on frame, crank, coupler, frame: directions that move with the link."""


@compared_by_value
@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class SphericalSensitivity:
    """How far each target turns when each arc grows by 0.1 %, to first order, the crank held at its angle."""

    moves: Reals
    """(targets, 4, 3) a small rotation of the body for each of a, b, c, d; (targets, 4, 1) of an output, its angle."""
    plays: Reals
    """(targets, 4 joints, 2, 3 or 1) likewise for an axis tilted by one radian in its bearing: about the normal of the
    arc to its neighbour on frame, crank or coupler, and about what is at right angles to both."""

    @property
    def worst(self) -> Reals:
        """(targets,) the angle by which the target is turned at most if every arc is wrong by up to 0.1 %."""
        return largest_turn(self.moves)

    def of_errors(self, error: float = LENGTH_ERROR, clearance: float = 0.0) -> Reals:
        """(targets,) a bound of the angle, with arcs wrong by a part and axes tilted by a clearance in radians."""
        along = np.linalg.svd(self.plays, compute_uv=False)[..., 0].sum(axis=1)
        return np.asarray(self.worst * (error / LENGTH_ERROR) + clearance * along)

    def sampled(
        self, error: float = LENGTH_ERROR, clearance: float = 0.0, *, samples: int = 10_000, seed: int = 0
    ) -> Reals:
        """(samples, targets) the angle in random linkages, as `Sensitivity.sampled`: a Monte Carlo study."""
        rng = np.random.default_rng(seed)
        wrong = rng.uniform(-error / LENGTH_ERROR, error / LENGTH_ERROR, (samples, self.moves.shape[1]))
        moved = np.einsum("tax,sa->stx", self.moves, wrong)
        turns = rng.uniform(0, 2 * np.pi, (samples, self.plays.shape[1]))
        tilts = np.stack([np.cos(turns), np.sin(turns)], axis=-1)
        return np.asarray(np.linalg.norm(moved + clearance * np.einsum("tjkx,sjk->stx", self.plays, tilts), axis=-1))


def largest_turn(moves: Reals) -> Reals:
    """How long the sum of rotations of the second last axis is at most, each taken forwards or backwards."""
    signs = np.array([(1, *others) for others in product((1, -1), repeat=moves.shape[-2] - 1)])
    return np.asarray(np.linalg.norm(np.einsum("sa,...ax->...sx", signs, moves), axis=-1).max(axis=-1))


def arc_moves(axes: Reals, arcs: Reals, *, coordinates: bool) -> Reals:
    """How far the coupler turns, (..., 4, 3), or the output, (..., 4, 1), for 0.1 % of a, b, c, d.

    Args:
        axes: (..., 4, 3) A0, A, B, B0 at a target.
        arcs: (..., 4) a, b, c, d.
        coordinates: whether the output is looked at, not the coupler.

    A0 and the direction from it to B0 stay, on the coupler A and the direction to B.
    """
    a0, a, b, b0 = np.moveaxis(axes, -2, 0)
    ends = ((a0, a), (a, b), (b0, b), (a0, b0))
    normals = [_unit(np.cross(first, second)) for first, second in ends]
    moves = [
        _follow(axes, normal, before=k < 2, carried=k == 0, coordinates=coordinates) for k, normal in enumerate(normals)
    ]
    return np.asarray(LENGTH_ERROR * arcs[..., None] * np.stack(moves, axis=-2))


def spherical_sensitivity(axes: Reals, arcs: Reals, *, coordinates: bool) -> SphericalSensitivity:
    """Of the axes at all targets, (targets, 4, 3), and the arcs (4,); see `arc_moves`. Cost: 0.2 ms.

    With all four arcs a quarter of a circle the coupler turns about A as the crank's arc does.

    >>> axes = np.array([[[0, 0, 1], [1, 0, 0], [0, 0.6, -0.8], [0, 0.8, 0.6]]])
    >>> found = spherical_sensitivity(axes, np.full(4, np.pi / 2), coordinates=False)
    >>> found.moves.shape, found.plays.shape
    ((1, 4, 3), (1, 4, 2, 3))
    """
    plays = []
    for k, neighbour in enumerate(_NEIGHBOURS):
        axis = axes[:, k]
        first = _unit(np.cross(axis, axes[:, neighbour]))
        for tilt in (first, np.cross(axis, first)):
            plays.append(_follow(axes, tilt, before=k < 2, carried=k < 2, coordinates=coordinates))
    stacked = np.stack(plays, axis=1)
    return SphericalSensitivity(
        moves=arc_moves(axes, np.broadcast_to(arcs, axes.shape[:-1]), coordinates=coordinates),
        plays=stacked.reshape(len(axes), 4, 2, -1),
    )


def _follow(axes: Reals, turn: Reals, *, before: bool, carried: bool, coordinates: bool) -> Reals:
    """How coupler or output give way to a small rotation in the chain of links, so that it stays closed.

    Args:
        axes: A0, A, B, B0.
        turn: the rotation.
        before: whether it lies between A0 and B, not between B and B0.
        carried: whether the coupler takes part in it.
        coordinates: whether the output is looked at.
    """
    _, a, b, b0 = np.moveaxis(axes, -2, 0)
    volume = np.sum(a * np.cross(b, b0), axis=-1, keepdims=True)
    due = -turn if before else turn  # the turns about A, B and B0 make up for it
    with np.errstate(divide="ignore", invalid="ignore"):  # in a dead centre nothing does
        if coordinates:
            return np.asarray(-np.sum(due * np.cross(a, b), axis=-1, keepdims=True) / volume)
        own = np.sum(due * np.cross(b, b0), axis=-1, keepdims=True) / volume * a
    return np.asarray(own + turn if carried else own)


def _unit(vectors: Reals) -> Reals:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))
