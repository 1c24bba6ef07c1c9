"""The freedoms of joints in space that have values, and which of them is the output."""

from __future__ import annotations

from collections.abc import Iterator

from gruebler.base.errors import LinkageError
from gruebler.mechanics.screws.model import SpatialLinkage
from gruebler.mechanics.space.bodies import motions


def valued_freedoms(linkage: SpatialLinkage) -> Iterator[tuple[int, str]]:
    """The freedoms that have values."""
    chain = linkage.mechanism.chain
    for number, joint in enumerate(chain.joints):
        if joint.pair.is_ball or joint.pair.has_body_between or joint.pair.has_contours or len(joint.links) > 2:
            continue
        for each in motions(joint.pair, chain.space):
            yield number, str(each)


def output_freedom(linkage: SpatialLinkage, output: str | None = None) -> tuple[int, str]:
    """The joint of the output and its first freedom; `LinkageError` for a joint that has no values."""
    chain, frame = linkage.mechanism.chain, linkage.mechanism.frame
    known = dict(reversed(list(valued_freedoms(linkage))))  # the first freedom of each joint
    if output is not None:
        number = chain.joint_number(output, error=LinkageError)
        if number not in known:
            raise LinkageError(
                "{joint}: expected a joint of two links that is no ball and no contact", joint=chain.joint_title(number)
            )
        return number, known[number]
    driven = {drive.joint for drive in linkage.mechanism.drives}
    at_frame = [k for k in sorted(known) if frame in chain.joints[k].links and k not in driven]
    wanted = [k for k in at_frame if set(chain.joints[k].links) & set(linkage.outputs)]
    others = [k for k in sorted(known) if k not in driven]
    if not (wanted or at_frame or others):
        raise LinkageError("no joint besides the drive has a motion that can be measured")
    number = wanted[0] if wanted else (at_frame or others)[-1]
    return number, known[number]


def against_frame(linkage: SpatialLinkage, number: int) -> float:
    """1 or -1: the motion of a joint of the frame is counted against the frame."""
    return -1.0 if linkage.mechanism.chain.joints[number].links[1] == linkage.mechanism.frame else 1.0
