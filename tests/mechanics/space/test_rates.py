"""Poses and rates of all links against the joints themselves: what every joint forbids stays 0 in every order."""

import numpy as np
import pytest

from gruebler.mechanics.space import move
from gruebler.mechanics.space.motion import inverse_of_series
from gruebler.mechanics.space.power_series import product
from gruebler.teaching.catalog import entry
from tests.mechanics.screws import machines

FACTORIALS = np.array([1.0, 1, 2, 6])
ORDERS = 3


def forbidden(pair, e):
    """What a joint keeps at 0 in the frame e (orders, rows, 4, 4) of its second link seen from that of its first."""
    offset = [e[..., i, 3] for i in range(3)]
    turn = e[..., :3, :3] - np.eye(4)[:3, :3] * (np.arange(len(e)) == 0)[:, None, None, None]
    about_z = [turn[..., 2, i] for i in range(3)] + [turn[..., i, 2] for i in range(2)]
    everything = [turn[..., i, j] for i in range(3) for j in range(3)]
    kept = {
        "revolute": about_z + offset,
        "prismatic": everything + offset[1:],
        "universal": [e[..., 0, 1], *offset],
        "spherical": offset,
        "ball_plane": [],  # it lies on another one's plane: no frame of the link tells where
    }
    return np.array(kept[pair])


CASES = {
    "bennett": (lambda: machines.bennett(alpha=0.7, beta=1.1, turn=1.0)[0].with_drives([0]), [1.0]),
    "cardan": (lambda: machines.cardan(0.5, 0.5), [1.0]),
    "sarrus": (lambda: machines.sarrus().with_drives([0]), [0.4]),
    "schatz": (lambda: entry("schatz").placed(), [1.0]),
    "wiper_rssr": (lambda: entry("wiper_rssr").placed(), [1.0]),
    "gough": (lambda: entry("gough").placed(), [9.0, -7, 5, 8, -6, 4]),
    "susp_spatial": (lambda: entry("susp_spatial").placed(), [0.2]),
    "susp_5link_lift": (lambda: entry("susp_5link_lift").placed(), [50.0]),
}


@pytest.mark.parametrize("name", CASES)
def test_joints_hold_in_every_order(name):
    make, reach = CASES[name]
    linkage = make()
    mechanism = linkage.mechanism
    chain = mechanism.chain
    reach = np.resize(reach, len(mechanism.drives))
    speeds = [np.broadcast_to(factor * reach, (7, len(reach))) for factor in (1.0, 0.3, -0.2)]
    path = np.linspace(0, 1, 7)[:, None] * reach
    motion = move(linkage, path, speed=speeds[0], acceleration=speeds[1], jerk=speeds[2], order=ORDERS)
    assert motion.complete
    series = motion.poses / FACTORIALS[:, None, None, None, None]
    rotation = series[..., :3, :3]
    rigid = product(rotation, np.swapaxes(rotation, -1, -2), np.matmul)
    assert abs(rigid[0] - np.eye(3)).max() < 1e-11  # the axes of the platform are printed to twelve digits
    scale = abs(rotation).max(axis=(1, 2, 3, 4)) + 1
    assert (abs(rigid[1:]).max(axis=(1, 2, 3, 4)) < 1e-12 * scale[1:] * scale[1:].max()).all()
    for joint, frame in zip(chain.joints, linkage.frames, strict=True):
        for link in joint.links[1:]:
            first, second = (series[:, :, chain.index(name)] @ frame for name in (joint.links[0], link))
            open_by = forbidden(joint.pair.name, product(inverse_of_series(first), second, np.matmul))
            size = 1 + max(abs(first).max(), abs(second).max())
            assert abs(open_by).max(initial=0.0) < 1e-10 * size, joint
    for k, drive in enumerate(mechanism.drives):
        pair = chain.joints[drive.joint].pair
        side = -1 if chain.joints[drive.joint].links[1] == mechanism.frame else 1
        direction = None if pair.f(chain.space) == 1 else drive.direction
        for order, values in enumerate([path, *speeds]):
            value = side * motion.joint(drive.joint, direction, order)
            assert value == pytest.approx(values[:, k], abs=1e-9 * abs(reach).max())
