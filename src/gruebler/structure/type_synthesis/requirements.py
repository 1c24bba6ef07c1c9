"""Requirements for a mechanism as data, and the test whether a mechanism satisfies them."""

from __future__ import annotations

import re
from dataclasses import KW_ONLY, dataclass
from enum import StrEnum

from gruebler.base.doors import door
from gruebler.base.errors import GrueblerError
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import PAIRS, Pair, pair
from gruebler.structure.mechanism.inversion import DrivenMechanism


class JointLocation(StrEnum):
    """Where a joint is: at the frame, between moving links, or anywhere."""

    FRAME = "frame"
    MOVING = "moving"
    ANY = "any"


@dataclass(frozen=True, slots=True)
class JointRequirement:
    """A kind of joint at a place: ``R@frame``, ``P@moving``, ``P``, ``@frame``."""

    pairs: frozenset[Pair] | None
    """Any of these pairs; None: any pair."""
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
        pairs = None
        if symbol and symbol != "any":
            pairs = frozenset(p for p in PAIRS if symbol in p.symbols.values()) or frozenset({pair(symbol)})
        return cls(pairs, JointLocation(place))

    def fits(self, joint: Joint, frame: str) -> bool:
        """Whether the joint is of the kind and at the place, given the frame."""
        at_frame = frame in joint.links
        return (self.pairs is None or joint.pair in self.pairs) and (
            self.place is JointLocation.ANY or at_frame == (self.place is JointLocation.FRAME)
        )


@door
@dataclass(frozen=True, slots=True)
class Requirements:
    """All requirements; a field that is left out means no requirement.

    See Also:
        `variants`, `Mechanism`

    Theory:
        docs/theory/joint-types.md
    """

    links: int
    _: KW_ONLY
    mobility: int = 1
    prismatic: int = 0
    """The exact number of sliding joints; the other counts likewise."""
    rolling: int = 0
    roll_slide: int = 0
    assortment: tuple[int, ...] | None = None
    """The numbers of binary, ternary, ... links of the typed chain."""
    multiple_joints: int = 0
    """The exact number of joints of more than two links."""
    drives: tuple[JointRequirement, ...] = ()
    at_frame: tuple[tuple[JointRequirement, int], ...] = ()
    """The least number of joints of each kind at the frame."""
    frame_joints: int | None = None
    """The number of joints on the frame: 3 for a ternary frame."""
    output: JointRequirement | None = None
    """The joint that joins the output link to the frame (place frame), or to none of the frame (place moving)."""
    output_at_drive: bool | None = None
    """Whether the output link may or must not (False) be a neighbour of a driven link."""

    @property
    def about_mechanisms(self) -> bool:
        """Whether frame, drive or output matter, so that the results are mechanisms rather than chains."""
        return self.about_drives or bool(self.at_frame) or self.frame_joints is not None

    @property
    def about_drives(self) -> bool:
        """Whether the results have drives."""
        return bool(self.drives or self.output or self.output_at_drive is not None)

    def fits_frame(self, chain: Chain, frame: str) -> bool:
        """Whether this link may be the frame."""
        joints = chain.joints_of(frame)
        return (self.frame_joints is None or len(joints) == self.frame_joints) and all(
            sum(requirement.fits(joint, frame) for joint in joints) >= number for requirement, number in self.at_frame
        )

    def fits_driven(self, driven: DrivenMechanism) -> bool:
        """Whether drives and output satisfy the requirements."""
        chain, frame = driven.mechanism.chain, driven.mechanism.frame
        joints = [chain.joints[d.joint] for d in driven.mechanism.drives]
        if self.drives and not _matched(list(self.drives), joints, frame):
            return False
        if driven.output is None:
            return True
        output_joints = chain.joints_of(driven.output)
        if self.output is not None and not self._output_fits(output_joints, frame):
            return False
        inputs = {link for d in driven.mechanism.drives for link in d.between} - {frame}
        near = any(inputs & set(joint.links) for joint in output_joints) or driven.output in inputs
        return self.output_at_drive is None or near == self.output_at_drive

    def _output_fits(self, output_joints: tuple[Joint, ...], frame: str) -> bool:
        assert self.output is not None  # called only then
        if self.output.place is JointLocation.MOVING and any(frame in joint.links for joint in output_joints):
            return False
        return any(self.output.fits(joint, frame) for joint in output_joints)


def _matched(requirements: list[JointRequirement], joints: list[Joint], frame: str) -> bool:
    """Whether the required kinds can be assigned to different joints."""
    if not requirements:
        return True
    return any(
        requirements[0].fits(joint, frame) and _matched(requirements[1:], joints[:k] + joints[k + 1 :], frame)
        for k, joint in enumerate(joints)
    )
