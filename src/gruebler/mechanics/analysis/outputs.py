"""What is looked at in a motion: the angle of a link, or the way of a sliding joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.errors import LinkageError, unknown
from gruebler.mechanics.kinematics.motion import Motion
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.linkages.wheels import sliding_joint
from gruebler.structure.mechanism import Mechanism


@dataclass(frozen=True, slots=True)
class Output:
    """An output of a linkage."""

    name: str
    """The link or the joint, as it was asked for."""
    link: str
    """The link that is looked at."""
    joint: int | None
    """The sliding joint whose way is meant; None if it is the link's angle."""

    @property
    def turning(self) -> bool:
        """Whether it is an angle, in radians; else a way in the linkage's unit."""
        return self.joint is None

    def values(self, motion: Motion, order: int = 0) -> Reals:
        """The output in a motion, or its derivative; (rows,)."""
        return (
            motion.angular(self.link, order=order)
            if self.joint is None
            else motion.displacement(self.joint, order=order)
        )

    def shift(self, motion: Motion) -> float:
        """How far apart the places of the link's origin are in a motion; of a link that only travels, of any point."""
        path = motion.places[0, :, motion.link_index(self.link)]
        return float(np.abs(path[:, None] - path).max(initial=0.0))


def find_output(linkage: Linkage, output: str | None = None) -> Output:
    """The output that a name means; without one, the linkage's first output, else the last link at the frame.

    Where drives move all links at the frame, it is the last link that none of them sets alone. A link that slides on
    the frame is looked at by its way, any other link by its angle; a sliding joint by its way.

    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> find_output(SliderCrank(20, 50).linkage())
    Output(name='slider', link='slider', joint=3)
    """
    mechanism = linkage.mechanism
    name = output if output is not None else _default(linkage)
    if name in mechanism.chain.links:
        return Output(name, name, _slide_at_frame(mechanism, name))
    number = mechanism.chain.find_joint(name) if isinstance(name, str) else None
    if number is not None and sliding_joint(linkage, number):
        first, other = mechanism.chain.joints[number].links[:2]
        return Output(name, first if other == mechanism.frame else other, number)
    sliding = [text for k, text in enumerate(mechanism.chain.joint_names()) if sliding_joint(linkage, k)]
    known = [*mechanism.chain.links, *sliding]
    raise LinkageError(
        "an output is a link or a sliding joint{suggestion}; {word!r} is none of {known}", **unknown(name, known)
    )


def _default(linkage: Linkage) -> str:
    if linkage.outputs:
        return linkage.outputs[0]
    mechanism = linkage.mechanism
    driven = {link for drive in mechanism.drives for link in drive.between}
    alone = {mechanism.frame}.union(*(drive.between for drive in mechanism.drives if mechanism.frame in drive.between))
    at_frame = [
        link
        for link in mechanism.chain.links
        if link != mechanism.frame
        and any(link in joint.links and mechanism.frame in joint.links for joint in mechanism.chain.joints)
    ]
    free = [link for link in at_frame if link not in driven]
    shared = [link for link in mechanism.chain.links if link not in alone]
    return (free or shared or at_frame)[-1]


def _slide_at_frame(mechanism: Mechanism, link: str) -> int | None:
    for number, joint in enumerate(mechanism.chain.joints):
        if joint.pair.is_sliding and set(joint.links) == {link, mechanism.frame}:
            return number
    return None
