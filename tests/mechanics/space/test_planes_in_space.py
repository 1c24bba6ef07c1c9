"""Linkages in the plane, put into space anywhere and turned: the motion and the modes are those of the plane."""

from math import cos, pi, sin

import numpy as np
import pytest

from gruebler.mechanics.kinematics import move as move_in_plane
from gruebler.mechanics.linkages import Line, Linkage
from gruebler.mechanics.screws import SpatialLinkage, exponential
from gruebler.mechanics.space import move
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries, entry

SOMEWHERE = exponential([0.4, -0.9, 1.3, 30.0, -20.0, 8.0])


def machines():
    """The machines of the catalog with pins and slides only, one drive, and the values that it runs through."""
    for id in entries():
        linkage = entry(id).placed()
        if not isinstance(linkage, Linkage) or len(linkage.mechanism.drives) != 1:
            continue
        if all(joint.pair.is_turning or joint.pair.is_sliding for joint in linkage.mechanism.chain.joints):
            low, high = entry(id).between or (0.0, 2 * pi)
            yield id, linkage, low + np.linspace(0.02, 0.98, 24) * (high - low)


def places(linkage, pose, somewhere):
    """The joints in a pose of the plane, (x, y, angle) of each link, put into space."""
    for number, joint in enumerate(linkage.mechanism.chain.joints):
        element, link = linkage.elements[number, joint.links[0]], pose[joint.links[0]]
        c, s = cos(link.angle), sin(link.angle)
        at = somewhere @ (link.x + c * element.x - s * element.y, link.y + s * element.x + c * element.y, 0, 1)
        if isinstance(element, Line):
            turn = element.angle + link.angle
            yield {"at": tuple(at[:3]), "x": tuple(somewhere[:3, :2] @ (cos(turn), sin(turn)))}
        else:
            yield {"at": tuple(at[:3]), "z": tuple(somewhere[:3, 2])}


@pytest.mark.parametrize(("id", "linkage", "rows"), [pytest.param(*each, id=each[0]) for each in machines()])
def test_the_machines_of_the_catalog_move_as_in_their_plane(id, linkage, rows):
    plane = move_in_plane(linkage, rows, order=2)
    assert plane.complete
    chain = linkage.mechanism.chain
    home = plane.pose(0)
    joints = dict(enumerate(places(linkage, home, SOMEWHERE)))
    spatial = SpatialLinkage(Mechanism.parse(f"spatial: {linkage.mechanism.text()}"), joints)
    motion = move(spatial, rows - rows[0], order=2)
    assert motion.complete
    assert motion.rank == chain.n - 2  # joints of a tree of all links, the drive left out: each is fixed by the loops
    within = max(1e-12, 1e-15 / motion.smallest.min() ** 2)  # accelerations lose digits where two modes are near
    for order in range(3):
        for name, joint in zip(chain.joint_names(), chain.joints, strict=True):
            if joint.pair.is_turning:
                flat = np.zeros((len(rows), 4))
                flat[:, :2], flat[:, 3] = plane.point(name, order=order), order == 0
                scale = spatial.size + abs(flat).max()
                assert abs(motion.point(name, order=order) - (flat @ SOMEWHERE.T)[:, :3]).max() < within * scale
    for link in chain.links:
        if link != linkage.mechanism.frame:
            for order in (1, 2):
                flat = np.outer(plane.angular(link, order=order), SOMEWHERE[:3, 2])
                assert abs(motion.angular(link, order=order) - flat).max() < within * (1 + abs(flat).max())
