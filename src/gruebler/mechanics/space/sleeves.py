"""Which link of a sliding joint has the sleeve, and how far it goes along the shaft of the other one."""

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
