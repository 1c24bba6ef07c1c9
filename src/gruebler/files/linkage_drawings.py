"""The drawing of a linkage in its reference pose: a block between a slide and a pin is a pin in a slot."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import count as count_from
from math import cos, pi, remainder, sin
from string import ascii_uppercase

from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.files.pin_drawings import SAME, DrawnDrive, DrawnJoint, PinDrawing
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage, with_lower_pairs

_TRIALS = 72


def drawing_of(linkage: Linkage, left_out: list[Message]) -> PinDrawing:
    """The drawing of a linkage in its reference pose, without one in a pose that it can be assembled in.

    A block between a slide and a pin on its line becomes a pin in a slot; joints are called A, B, ..., points as they
    are. The list gets a message for what a drawing does not have.

    Raises `LinkageError` if a joint neither turns nor slides (wheels, cams), or if no pose is found.

    >>> from gruebler.mechanics.fourbar import SliderCrank
    >>> drawing = drawing_of(SliderCrank(25, 70).linkage(), [])
    >>> [(joint.name, joint.links, joint.slot) for joint in drawing.joints][-1]
    ('C', ('frame', 'coupler'), 0.0)
    """
    lower = lower_linkage(linkage)
    chain, frame = lower.mechanism.chain, lower.mechanism.frame
    if linkage.outputs:
        left_out.append(message("which links are outputs: {links}", links=", ".join(linkage.outputs)))
    names = _letters(lower.points)
    placed = [placed_joint(lower, number) for number in range(len(chain.joints))]
    in_slots = _pins_in_slots(lower, placed)
    joints: dict[int, DrawnJoint] = {}
    for number, pin in enumerate(placed):
        if number in in_slots:
            slide = placed[in_slots[number]]
            links = (slide.links[0], *(link for link in pin.links if link != slide.links[1]))
            joints[number] = replace(pin, name=next(names), links=links, slot=slide.slot)
        elif number not in in_slots.values():
            joints[number] = replace(pin, name=next(names))
    pin_of = {slide: pin for pin, slide in in_slots.items()}
    drives = []
    for drive in lower.mechanism.drives:
        driven = joints[pin_of.get(drive.joint, drive.joint)]
        between = drive.between if drive.between[1] != frame else drive.between[::-1]
        drives.append(DrawnDrive(driven.name, *(between if driven.slot is None else driven.links[:2])))
    points = [
        DrawnJoint(name, *lower.required_pose[point.link].put(point.x, point.y), (point.link,))
        for name, point in lower.points.items()
    ]
    return PinDrawing(frame=frame, joints=(*joints.values(), *points), drives=tuple(drives), unit=lower.unit)


def lower_linkage(linkage: Linkage) -> Linkage:
    """The linkage with turning and sliding joints only and a reference pose; `LinkageError` if it has others."""
    lower = with_lower_pairs(_posed(linkage))
    for joint in lower.mechanism.chain.joints:
        if not joint.pair.is_basic:
            raise LinkageError("the format holds turning and sliding joints only, not {joint}", joint=joint)
    return lower


def placed_joint(lower: Linkage, number: int) -> DrawnJoint:
    """A joint where it lies in the reference pose; of a slide the frame, else the first link has the slot."""
    joint, poses = lower.mechanism.chain.joints[number], lower.required_pose
    first, *others = joint.links
    element = lower.elements[number, first]
    if not element.is_line:
        return DrawnJoint("", *poses[first].put(element.x, element.y), joint.links)
    if others[0] == lower.mechanism.frame:
        first, others = others[0], [first]
    line, block = lower.elements[number, first], lower.elements[number, others[0]]
    slot = remainder(poses[first].angle + line.direction, 2 * pi)
    return DrawnJoint("", *poses[others[0]].put(block.x, block.y), (first, others[0]), slot=slot, turns=False)


def _pins_in_slots(lower: Linkage, placed: Sequence[DrawnJoint]) -> dict[int, int]:
    """The pins on blocks that do nothing but turn and slide: for the number of each pin that of the slide."""
    mechanism = lower.mechanism
    busy = {mechanism.frame, *(point.link for point in lower.points.values())}
    busy |= {link for drive in mechanism.drives if drive.turning for link in drive.between}
    bases = {joint.links[0] for joint in placed if joint.slot is not None}
    slots: dict[int, int] = {}
    for slide, joint in enumerate(placed):
        if joint.slot is None or joint.links[1] in busy | bases:
            continue
        base, block = joint.links
        others = [k for k, other in enumerate(placed) if block in other.links and k != slide]
        if len(others) != 1 or placed[others[0]].slot is not None or others[0] in slots:
            continue
        pin = placed[others[0]]
        across = cos(joint.slot) * (pin.y - joint.y) - sin(joint.slot) * (pin.x - joint.x)
        if abs(across) <= SAME * lower.size and base not in pin.links:
            slots[others[0]] = slide
    return slots


def _posed(linkage: Linkage) -> Linkage:
    """The linkage with a reference pose."""
    if linkage.reference_pose is not None:
        return linkage
    drives = linkage.mechanism.drives
    for k in range(_TRIALS):
        motion = move_quietly(
            linkage, [[(2 * pi if drive.turning else linkage.size) * k / _TRIALS for drive in drives]]
        )
        if motion.complete:
            return linkage.with_reference_pose(motion.pose())
    raise LinkageError("no pose of the linkage was found in which its joints are closed: give it a reference pose")


def _letters(used: Collection[str]) -> Iterator[str]:
    """A, B, ..., Z, A1, B1, ...: names that are not used."""
    for k in count_from():
        name = ascii_uppercase[k % 26] + (str(k // 26) if k >= 26 else "")
        if name not in used:
            yield name
