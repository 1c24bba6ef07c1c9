"""Mechanisms as other programs store them: pins and slots at places of one drawing, and the links that meet there.

`drawing_linkages` makes a linkage of such a drawing, `linkage_drawings` a drawing of a linkage. What a linkage has and
the drawing has not is a message in a list that the caller passes, so that nothing is lost in silence.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import KW_ONLY, dataclass, field, replace
from math import cos, sin
from typing import Any

from gruebler.base.text import Message, message
from gruebler.base.units import MILLIMETRES
from gruebler.files.measured_lengths import in_unit
from gruebler.mechanics.linkages.elements import Pose2D

NO_UNIT_WRITTEN = message("the unit of the numbers, which are mm")
"""What writers of formats without a unit say; their readers say `no_unit`."""
SAME = 1e-9  # of the size of the drawing: places that are nearer are one place
_DIGITS = 12  # of places of forces, whose poses have rounding


@dataclass(frozen=True)
class DrawnJoint:
    """A pin, a slide or a pin in a slot; with one link it is a point of that link."""

    name: str
    x: float
    y: float
    links: tuple[str, ...]
    """The first one has the slot, if there is one."""
    _: KW_ONLY
    slot: float | None = None
    """The direction of the slot in the drawing, in radians; None without a slot."""
    turns: bool = True
    """Whether the other links turn about the pin."""


@dataclass(frozen=True)
class DrawnDrive:
    """A driven joint: the second link is moved against the first."""

    joint: str
    fixed: str
    moved: str


@dataclass(frozen=True, kw_only=True)
class DrawnForce:
    """A force on a link, at a place of the drawing."""

    link: str
    at: tuple[float, float]
    force: tuple[float, float]
    """Its components in the position that is drawn."""
    unit: str
    turns: bool
    """Whether it keeps its direction in the link, not in the plane."""

    def load(self, pose: Pose2D) -> tuple[str, list[Any]]:
        """The point and both components as in ``[loads.forces]``, with the pose in which the link is drawn.

        >>> DrawnForce(link="rod", at=(3.0, 2.0), force=(0.0, -5.0), unit="N", turns=False).load(Pose2D(1.0, 2.0, 0.0))
        ('rod:2.0,0.0', ['0.0 N', '-5.0 N'])
        """
        x, y = (round(part, _DIGITS) + 0.0 for part in pose.to_local(*self.at))
        point, (u, v) = f"{self.link}:{x!r},{y!r}", self.force
        if not self.turns:
            return point, [f"{u!r} {self.unit}", f"{v!r} {self.unit}"]
        c, s = cos(pose.angle), sin(pose.angle)
        along, across = c * u + s * v, c * v - s * u
        formulas = f"{along!r}*cos(angle) + {-across!r}*sin(angle)", f"{along!r}*sin(angle) + {across!r}*cos(angle)"
        return point, [{"formula": formula, "unit": self.unit} for formula in formulas]


@dataclass(frozen=True, kw_only=True)
class PinDrawing:
    """Everything that is drawn, in one position."""

    frame: str
    joints: tuple[DrawnJoint, ...]
    drives: tuple[DrawnDrive, ...] | None = ()
    """None if the source does not say: then pins on the frame are driven, as many as the count of freedoms asks for."""
    unit: str = "mm"
    rigid: tuple[tuple[str, str], ...] = ()
    """Links that are fastened to each other."""
    loads: Mapping[str, Any] = field(default_factory=dict)
    """What stands in a table ``[loads]``: the ``speed`` of the only drive, ``bodies`` with centres in the drawing; and
    ``forces``, each a `DrawnForce`."""


SENSE = message("the sense of rotation of the drive")
"""What readers leave out of a speed."""


def extent(joints: Iterable[DrawnJoint]) -> float:
    """A length of the order of the drawing."""
    places = [(joint.x, joint.y) for joint in joints]
    if not places:
        return 1.0
    xs, ys = zip(*places, strict=True)
    return max(max(xs) - min(xs), max(ys) - min(ys)) or 1.0


def no_unit(taken: str = "mm") -> Message:
    """What a reader says of a file without a unit: for which its numbers are taken."""
    return message("a unit, which the file does not have: its numbers are taken for {unit}", unit=taken)


def drawing_in(drawing: PinDrawing, unit: str, left_out: list[Message]) -> PinDrawing:
    """The drawing with its places in another unit; those in a unit that is not known stay as they are, which is said.

    >>> joints = (DrawnJoint("A", 3.5, 0.0, ("frame",)),)
    >>> drawing_in(PinDrawing(frame="frame", joints=joints, unit="cm"), "mm", []).joints[0].x
    35.0
    """
    known = drawing.unit if drawing.unit in MILLIMETRES else unit
    if known != drawing.unit:
        said = (
            message("the unit {unit}: the numbers are written as {wanted}", unit=drawing.unit)
            if drawing.unit
            else message("no unit: the numbers are written as {wanted}")
        )
        left_out.append(said.filled(wanted=unit))
    joints = (
        replace(joint, x=in_unit(joint.x, known, unit), y=in_unit(joint.y, known, unit)) for joint in drawing.joints
    )
    return replace(drawing, joints=tuple(joints), unit=unit)


def one_drive_a_joint(drawing: PinDrawing, left_out: list[Message]) -> dict[str, DrawnDrive]:
    """The drives by their joints; what a joint has more than one is left out."""
    drives: dict[str, DrawnDrive] = {}
    for drive in drawing.drives or ():
        if drives.setdefault(drive.joint, drive) is not drive:
            left_out.append(
                message("the second drive at joint {joint}, of link {link}", joint=drive.joint, link=drive.moved)
            )
    return drives


def with_slot_ends(drawing: PinDrawing) -> tuple[PinDrawing, dict[str, tuple[str, str]]]:
    """The same drawing for formats in which a slot runs between two points of its link; and the ends of each slot.

    The ends are further points, and a slide has two pins in the slot, which keep it from turning.

    >>> slide = DrawnJoint("A", 0.0, 0.0, ("frame", "block"), slot=0.0, turns=False)
    >>> drawing, slots = with_slot_ends(
    ...     PinDrawing(frame="frame", joints=(slide, DrawnJoint("B", 4.0, 0.0, ("block",)))))
    >>> [(joint.name, joint.x, joint.slot) for joint in drawing.joints if joint.slot is not None], slots["A"]
    ([('A', 0.0, 0.0), ('A pin', 1.0, 0.0)], ('A start', 'A end'))
    """
    reach = extent(drawing.joints) / 2
    joints: list[DrawnJoint] = []
    slots: dict[str, tuple[str, str]] = {}
    for joint in drawing.joints:
        if joint.slot is None:
            joints.append(joint)
            continue
        dx, dy = reach * cos(joint.slot), reach * sin(joint.slot)
        ends = (f"{joint.name} start", f"{joint.name} end")
        base = joint.links[:1]
        joints.append(DrawnJoint(name=ends[0], x=joint.x - dx, y=joint.y - dy, links=base))
        joints.append(DrawnJoint(name=ends[1], x=joint.x + dx, y=joint.y + dy, links=base))
        joints.append(replace(joint, turns=True))
        slots[joint.name] = ends
        if not joint.turns:
            pin = replace(joint, name=f"{joint.name} pin", x=joint.x + dx / 2, y=joint.y + dy / 2, turns=True)
            joints.append(pin)
            slots[pin.name] = ends
    return replace(drawing, joints=tuple(joints)), slots
