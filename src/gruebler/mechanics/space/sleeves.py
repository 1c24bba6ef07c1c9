"""Which link of a sliding joint has the sleeve, and how far it goes along the shaft or the plane of the other one."""

from __future__ import annotations

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.structure.chain import Joint


def shaft_first(joint: Joint, frame: str) -> tuple[str, ...]:
    """The links of a joint in the order of its symbol: the frame, which has the sleeve, last; of others as written."""
    if joint.pair.has_contours or joint.pair.is_cross:
        return joint.links
    return tuple(sorted(joint.links, key=lambda link: link == frame))


def sleeve_travels(linkage: SpatialLinkage, poses: Reals) -> dict[int, tuple[float, float]]:
    """Between which values the sleeve of each sliding joint goes along its shaft, over poses (rows, links, 4, 4).

    0 is the reference pose and always among them.
    """
    chain = linkage.mechanism.chain
    travels: dict[int, tuple[float, float]] = {}
    for number, joint in enumerate(chain.joints):
        sliding = [f.axis for f in joint.pair.freedoms[chain.space] if f.travels or f.has_pitch]
        if len(sliding) != 1 or joint.pair.has_contours or joint.pair.has_body_between:
            continue
        shaft, *others = (chain.index(link) for link in shaft_first(joint, linkage.mechanism.frame))
        frame = linkage.frames[number]
        back = np.linalg.inv(poses[:, shaft] @ frame)
        along = [(back @ poses[:, k] @ frame)[:, "xyz".index(sliding[0]), 3] for k in others]
        travels[number] = float(min(0.0, np.min(along))), float(max(0.0, np.max(along)))
    return travels


def plane_travels(linkage: SpatialLinkage, poses: Reals) -> dict[int, Reals]:
    """How far one link of a joint that slides both ways goes on the plane of the other, over poses (rows, links, 4, 4).

    Least and most along the axes of the joint, (2, 3); the reference pose, 0, is always among them.
    """
    chain = linkage.mechanism.chain
    travels: dict[int, Reals] = {}
    for number, joint in enumerate(chain.joints):
        ways = ["xyz".index(f.axis) for f in joint.pair.freedoms[chain.space] if f.travels]
        if len(ways) != 2 or joint.pair.has_contours or joint.pair.has_body_between:
            continue
        slider, plane = (chain.index(link) for link in shaft_first(joint, linkage.mechanism.frame)[:2])
        frame = linkage.frames[number]
        along = (np.linalg.inv(poses[:, plane] @ frame) @ poses[:, slider] @ frame)[:, ways, 3]
        travels[number] = np.zeros((2, 3))
        travels[number][:, ways] = np.minimum(0, along.min(axis=0)), np.maximum(0, along.max(axis=0))
    return travels
