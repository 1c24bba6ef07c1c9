"""Loops of six turning joints that the count holds and that move: Schatz's and Bricard's trihedral one."""

from math import pi, sqrt

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import SpatialLinkage, exponential, follow_joint
from gruebler.mechanics.space import move

QUARTER = pi / 2


def loop(turns, rows):
    pose = np.eye(4)
    for turn, (d, a, alpha) in zip(turns, rows, strict=True):
        pose = pose @ exponential([0, 0, turn, 0, 0, d]) @ exponential([alpha, 0, 0, a, 0, 0])
    return np.concatenate([pose[:3, 3], (pose[:3, :3] - np.eye(3)).ravel()])


def closed(rows, turns):
    """The loop with the first turn given, the others closed by Gauss-Newton on differences from near values."""
    turns = np.array(turns, float)
    for _ in range(20):
        steps = 1e-6 * np.eye(6)[1:]
        slopes = np.array([(loop(turns + s, rows) - loop(turns - s, rows)) / 2e-6 for s in steps]).T
        turns[1:] -= np.linalg.lstsq(slopes, loop(turns, rows), rcond=1e-9)[0]
    assert abs(loop(turns, rows)).max() < 1e-12
    return SpatialLinkage.from_dh([(turn, *row) for turn, row in zip(turns, rows, strict=True)])


def schatz():
    """Parallel shafts √3 apart, three links of length 1, axes at right angles: P. Schatz, US patent 2302804, 1942."""
    rows = [(0.3, 0, QUARTER), *[(0, 1, QUARTER)] * 3, (0, 0, QUARTER), (-0.3, sqrt(3), 0)]
    return closed(rows, [0.6, 3.9161, -1.5485, 1.5926, -3.9381, -0.6311])


def trihedral():
    """Axes at right angles, a1² + a3² + a5² = a2² + a4² + a6²: R. Bricard, Leçons de cinématique II, 1927."""
    lengths = [1.0, 0.7, 1.2, 0.9, 0.8]
    lengths.append(sqrt(1.0**2 + 1.2**2 + 0.8**2 - 0.7**2 - 0.9**2))
    rows = [(0, length, QUARTER if k % 2 == 0 else -QUARTER) for k, length in enumerate(lengths)]
    return closed(rows, [1.0, 2.1442, 0.8442, 1.7121, 0.7952, 2.067])


@pytest.mark.parametrize(("make", "reach"), [(schatz, 2 * pi), (trihedral, 0.9)], ids=["schatz", "trihedral"])
def test_it_moves_closed_and_with_constant_rank(make, reach):
    linkage = make()
    motion = move(linkage, np.linspace(0, reach, 37))
    assert motion.complete
    assert motion.gap < 1e-12
    assert (motion.conditions, motion.rank) == (5, 4)
    assert motion.smallest.min() > 1e-3
    turns = np.linspace(0, min(reach, 1.0), 4)[1:]
    poses = follow_joint(linkage, 0, turns)  # the other solver: poses of links, all joints closed by least squares
    poses[..., :3, 3] *= linkage.size
    poses[..., :3, 3] += linkage.centre - poses[..., :3, :3] @ linkage.centre
    assert abs(move(linkage, turns).poses[0] - poses).max() < 1e-9


def test_schatzs_shafts_turn_fully_and_come_back():
    motion = move(schatz(), np.linspace(0, 2 * pi, 37))
    assert abs(motion.poses[0, -1] - motion.poses[0, 0]).max() < 1e-11
    assert abs(motion.joint("R(5-0)")[-1]) == pytest.approx(2 * pi, abs=1e-11)


def test_a_length_that_breaks_the_condition_holds_the_loop():
    """Without Bricard's condition six axes in a loop have no freedom but the closed pose itself."""
    places = list(trihedral().places)
    places[2] = type(places[2])((places[2].at[0] + 0.05, *places[2].at[1:]), z=places[2].z)
    held = SpatialLinkage(trihedral().mechanism, tuple(places))
    with pytest.raises(LinkageError, match="drives"):
        move(held, [0.0, 0.1])
