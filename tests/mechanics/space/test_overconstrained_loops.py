"""Linkages that the count holds, or holds too often, and that move: closed to rounding as far as they go."""

from math import pi, sqrt

import numpy as np
import pytest

from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws import SpatialLinkage, exponential, freedoms
from gruebler.mechanics.space import move
from gruebler.mechanics.space.drive_ranges import followed, spatial_range
from tests.mechanics.screws import machines
from tests.mechanics.screws.following import follow_joint

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


@pytest.mark.parametrize(
    ("make", "drive", "counted", "full"),
    [
        (lambda: machines.bennett()[0], 0, -2, True),
        (lambda: machines.goldberg(5), 0, -1, True),
        (lambda: machines.goldberg(6), 0, 0, True),
        (machines.sarrus, 0, 0, True),
        (lambda: machines.bricard("line"), 1, 0, False),
        (lambda: machines.bricard("plane"), 1, 0, False),
        (trihedral, 0, 0, False),
        (schatz, 0, 0, True),
        (machines.strut, 0, 0, True),
        (lambda: machines.locomotive(4), 0, -1, True),
    ],
    ids=["bennett", "goldberg 5R", "goldberg 6R", "sarrus", "bricard line", "bricard plane", "bricard trihedral",
         "schatz", "parallelogram with a strut", "four cranks on a rod"],
)  # fmt: skip
def test_it_moves_closed_with_one_freedom_and_constant_rank_as_far_as_it_goes(make, drive, counted, full):
    linkage = make().with_drives([drive])
    mobility = freedoms(linkage)
    assert (mobility.counted, mobility.instant.mobility, mobility.finite.mobility) == (counted, 1, 1)
    reach = spatial_range(linkage)
    assert reach.full is full
    assert all((stop is None) is full for stop in reach.stops)
    motion = followed(linkage, reach.inside(73)[:, None])
    assert motion.gap < 1e-12
    assert motion.conditions - motion.rank == 1 - counted
    chain = linkage.mechanism.chain
    places, ways = np.array([p.at for p in linkage.places]), linkage.frames[:, :3, 2]
    screws = np.zeros((73, 6, len(places)))
    for k, joint in enumerate(chain.joints):
        first, second = (motion.pose(link) for link in joint.links)
        z = first[:, :3, :3] @ ways[k]
        at = first[:, :3, :3] @ places[k] + first[:, :3, 3]
        # the joint is closed, by the poses of both its links
        assert abs(at - second[:, :3, :3] @ places[k] - second[:, :3, 3]).max() < 1e-12 * linkage.size
        assert abs(z - second[:, :3, :3] @ ways[k]).max() < 1e-12
        screws[:, :3, k], screws[:, 3:, k] = z, np.cross((at - linkage.centre) / linkage.size, z)
    if len(places) == chain.n:  # one loop: its screws have one relation, in every pose
        singular = np.linalg.svd(screws, compute_uv=False)
        assert singular[:, -1].max() < 1e-12
        assert singular[:, -2].min() > 1e-4
    if full:
        assert abs(motion.poses[0, -1] - motion.poses[0, 0]).max() < 1e-11 * linkage.size
    turns = np.linspace(0, min(reach.highest, 1.0), 4)[1:-1]
    poses = follow_joint(linkage, drive, turns)  # the other solver: poses of links, all joints closed by least squares
    poses[..., :3, 3] *= linkage.size
    poses[..., :3, 3] += linkage.centre - poses[..., :3, :3] @ linkage.centre
    assert abs(move(linkage, turns).poses[0] - poses).max() < 1e-9 * linkage.size


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
