"""What a designer asks of a mechanism, as data, and whether a mechanism answers it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum

from gruebler.chain import Chain, Joint
from gruebler.chain.pairs import PAIRS, Pair, pair
from gruebler.errors import GrueblerError
from gruebler.mechanism.inversion import DrivenMechanism

__all__ = ["JointLocation", "JointRequirement", "Requirements"]


class JointLocation(StrEnum):
    """Where a joint is: at the frame, between moving links, or anywhere."""

    FRAME = "frame"
    MOVING = "moving"
    ANY = "any"


@dataclass(frozen=True, slots=True)
class JointRequirement:
    """A kind of joint at a place: ``R@frame``, ``P@moving``, ``P``, ``@frame``."""

    pairs: frozenset[Pair] | None
    """Any of these pairs; None: whatever pair."""
    place: JointLocation

    @classmethod
    def parse(cls, text: str) -> JointRequirement:
        """Read ``PAIR@PLACE``; either part may be missing.

        >>> JointRequirement.parse("P@moving").place
        <JointLocation.MOVING: 'moving'>
        """
        match = re.fullmatch(r"(\w*)(?:@(\w+))?", text.strip())
        if match is None or not text.strip():
            raise GrueblerError("{text!r} is not PAIR@PLACE such as R@frame, P@moving or P", text=text)
        symbol, place = match[1], match[2] or "any"
        if place not in set(JointLocation):
            raise GrueblerError("{text!r}: the place is frame, moving or any, not {place!r}", text=text, place=place)
        meant = None
        if symbol and symbol != "any":
            meant = frozenset(p for p in PAIRS if symbol in p.symbols.values()) or frozenset({pair(symbol)})
        return cls(meant, JointLocation(place))

    def fits(self, joint: Joint, frame: str) -> bool:
        """Whether the joint is of the kind and at the place, given the frame."""
        at_frame = frame in joint.links
        return (self.pairs is None or joint.pair in self.pairs) and (
            self.place is JointLocation.ANY or at_frame == (self.place is JointLocation.FRAME)
        )


@dataclass(frozen=True, slots=True)
class Requirements:
    """Requirements of `variants` on chains and mechanisms; what is left out may be anything."""

    links: int
    mobility: int = 1
    prismatic: int = 0
    """Exactly so many sliding joints; the other counts likewise."""
    rolling: int = 0
    roll_slide: int = 0
    assortment: tuple[int, ...] | None = None
    """The numbers of binary, ternary, ... links of the typed chain."""
    multiple_joints: int = 0
    """Exactly so many joints of more than two links."""
    drives: tuple[JointRequirement, ...] = ()
    at_frame: tuple[tuple[JointRequirement, int], ...] = ()
    """At least so many joints of the kind at the frame."""
    frame_joints: int | None = None
    """The number of joints on the frame: 3 for a ternary frame."""
    output: JointRequirement | None = None
    """The joint that joins the output link to the frame (place frame), or to none of the frame (place moving)."""
    output_at_drive: bool | None = None
    """Whether the output link may or must not (False) be a neighbour of a driven link."""

    @property
    def about_mechanisms(self) -> bool:
        """Whether frame, drive or output matter, so that the answers are mechanisms rather than chains."""
        return self.about_drives or bool(self.at_frame) or self.frame_joints is not None

    @property
    def about_drives(self) -> bool:
        """Whether the answers carry drives."""
        return bool(self.drives or self.output or self.output_at_drive is not None)

    def fits_frame(self, chain: Chain, frame: str) -> bool:
        """Whether this link may be the frame."""
        joints = chain.joints_of(frame)
        return (self.frame_joints is None or len(joints) == self.frame_joints) and all(
            sum(wanted.fits(joint, frame) for joint in joints) >= number for wanted, number in self.at_frame
        )

    def fits_driven(self, driven: DrivenMechanism) -> bool:
        """Whether drives and output are as wanted."""
        chain, frame = driven.mechanism.chain, driven.mechanism.frame
        joints = [chain.joints[d.joint] for d in driven.mechanism.drives]
        if self.drives and not _matched(list(self.drives), joints, frame):
            return False
        if driven.output is None:
            return True
        out = chain.joints_of(driven.output)
        if self.output is not None and not self._output_fits(out, frame):
            return False
        inputs = {link for d in driven.mechanism.drives for link in d.between} - {frame}
        near = any(inputs & set(joint.links) for joint in out) or driven.output in inputs
        return self.output_at_drive is None or near == self.output_at_drive

    def _output_fits(self, out: tuple[Joint, ...], frame: str) -> bool:
        assert self.output is not None  # asked only then
        if self.output.place is JointLocation.MOVING and any(frame in joint.links for joint in out):
            return False
        return any(self.output.fits(joint, frame) for joint in out)


def _matched(wanted: list[JointRequirement], joints: list[Joint], frame: str) -> bool:
    """Whether the drives can be told off to the wanted kinds one by one."""
    if not wanted:
        return True
    return any(
        wanted[0].fits(joint, frame) and _matched(wanted[1:], joints[:k] + joints[k + 1 :], frame)
        for k, joint in enumerate(joints)
    )
