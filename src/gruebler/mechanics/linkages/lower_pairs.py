"""The same linkage with joints as simple as can be: a pin in a slot becomes a block that turns and slides.

Pairs of wheels and circles stay, but for what others say already.
"""

from __future__ import annotations

from math import cos, pi, sin

from gruebler.mechanics.linkages.elements import Element, Line, Pin
from gruebler.mechanics.linkages.model import Linkage
from gruebler.mechanics.linkages.wheels import carriers, redundant_wheels, round_joints
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import pair
from gruebler.structure.mechanism import Drive, Mechanism


def has_only_lower_pairs(linkage: Linkage) -> bool:
    """Whether all its joints are pins and lines; others are given by their screws."""
    return not any(element.is_round for element in linkage.elements.values())


def with_lower_pairs(linkage: Linkage) -> Linkage:
    """The linkage with a further link for each pin in a slot and each double slide; the other links keep their names.

    Drives keep their order. A pin in a slot is the pin on a block that slides in the slot; a double slide is a block
    that slides along the first link's line, and at right angles to it in the second link. Wheels that roll on each
    other while a link holds their centres are a roll-slide pair, since the link repeats what holds them together; pairs
    of wheels or circles that say nothing new are left out. The pin of a round roller whose spin moves nothing gets a
    drive of its own, behind the others, that holds it.
    """
    mechanism = linkage.mechanism
    chain = mechanism.chain
    split, idle, eased = _to_do(linkage)
    rollers = _idle_rollers(linkage)
    if not split and not idle and not eased and not rollers:
        return linkage
    joints: list[Joint] = []
    names = chain.joint_names()
    elements: dict[str, dict[str | int, object]] = {link: {} for link in chain.links}
    place: dict[tuple[int, str], tuple[int, tuple[str, str]]] = {}  # (joint, direction) -> new joint and its links
    for number, joint in enumerate(chain.joints):
        if number in idle:
            continue
        if number not in split:
            for link in joint.links:
                elements[link][len(joints)] = linkage.elements[number, link]
            place[number, ""] = len(joints), (joint.links[0], joint.links[1])
            joints.append(Joint(pair("roll_slide"), joint.links) if number in eased else joint)
            continue
        block = f"block {names[number]}"
        elements[block] = {}
        parts = _halves(linkage, number)
        measured_from = mechanism.frame if mechanism.frame in joint.links else joint.links[0]
        for direction, kind, link, on_link, on_block in parts:
            links = (link, block) if link == measured_from else (block, link)
            place[number, direction] = len(joints), links
            elements[link][len(joints)] = on_link
            elements[block][len(joints)] = on_block
            joints.append(Joint(pair(kind), links))
    drives = []
    for drive in mechanism.drives:
        key = (drive.joint, drive.direction if drive.joint in split else "")
        new, links = place[key]
        between = links if drive.joint in split else drive.between
        drives.append(Drive(new, joints[new].pair.freedoms[chain.space][0], between))
    for number in rollers:
        new, links = place[number, ""]
        drives.append(Drive(new, joints[new].pair.freedoms[chain.space][0], links))
    blocks = [link for link in elements if link not in chain.links]
    lower_chain = Chain(joints, links=[*chain.links, *blocks], space=chain.space)
    poses = None
    if linkage.reference_pose is not None:
        poses = {link: tuple(at) for link, at in linkage.reference_pose.items()}
        for number in split:
            block = f"block {names[number]}"
            poses[block] = _block_pose(linkage, number)
    points = {name: (point.link, point.x, point.y) for name, point in linkage.points.items()}
    return Linkage(
        Mechanism(lower_chain, mechanism.frame, drives),
        elements,
        points=points,
        unit=linkage.unit,
        reference_pose=poses,  # type: ignore[arg-type]
        outputs=linkage.outputs,
    )


def joints_before(linkage: Linkage) -> tuple[int, ...]:
    """For each joint of `with_lower_pairs` that of the linkage: one that a block splits stands for two in a row."""
    split, idle, _ = _to_do(linkage)
    kept = [number for number in range(len(linkage.mechanism.chain.joints)) if number not in idle]
    return tuple(number for number in kept for _ in range(1 + (number in split)))


def joints_left_out(linkage: Linkage) -> bool:
    """Whether `with_lower_pairs` leaves contacts out that say nothing new."""
    return bool(_to_do(linkage)[1])


def _to_do(linkage: Linkage) -> tuple[list[int], set[int], set[int]]:
    """The joints to split, to leave out, and to take for a roll-slide pair."""
    mechanism, elements = linkage.mechanism, linkage.elements
    joints = mechanism.chain.joints
    wheels, held = round_joints(mechanism, elements), carriers(mechanism, elements)
    idle = redundant_wheels(mechanism, elements) | {
        n for n in held if all(elements[n, link].is_smooth for link in wheels[n])
    }
    eased = {n for n in held if n not in idle and joints[n].pair.rolls}
    return [n for n, joint in enumerate(joints) if len(joint.pair.lower_pairs) > 1 and n not in wheels], idle, eased


def _idle_rollers(linkage: Linkage) -> list[int]:
    """The turning joints in the centre of a circle on a link that has no other joint but its contact."""
    chain, elements = linkage.mechanism.chain, linkage.elements
    driven = {drive.joint for drive in linkage.mechanism.drives}
    idle = []
    for (number, link), circle in elements.items():
        if not circle.is_smooth:
            continue
        own_joints = [n for n, joint in enumerate(chain.joints) if link in joint.links and n != number]
        if len(own_joints) == 1 and own_joints[0] not in driven:
            pin = elements[own_joints[0], link]
            if pin == Pin(circle.x, circle.y) and len(chain.joints[own_joints[0]].links) == 2:
                idle.append(own_joints[0])
    return idle


def _halves(linkage: Linkage, number: int) -> list[tuple[str, str, str, Element, Element]]:
    """The two joints that a block makes of one: direction of a drive, pair, link, its element and the block's."""
    joint = linkage.mechanism.chain.joints[number]
    first, second = joint.links
    element, other_element = linkage.elements[number, first], linkage.elements[number, second]
    if joint.pair.rolls_and_slides:
        slotted, pinned = (first, second) if element.is_line else (second, first)
        line, pin = (element, other_element) if element.is_line else (other_element, element)
        return [
            ("Tx", "prismatic", slotted, line, Line(0, 0, line.direction)),
            ("Rz", "revolute", pinned, pin, Pin(0, 0)),
        ]
    turned = Line(other_element.x, other_element.y, other_element.direction + pi / 2)
    return [
        ("Tx", "prismatic", first, element, Line(0, 0, element.direction)),
        ("Ty", "prismatic", second, turned, Line(0, 0, element.direction + pi / 2)),
    ]


def _block_pose(linkage: Linkage, number: int) -> tuple[float, float, float]:
    """Where the block of a split joint lies in the reference pose: on the line, at the pin or where the lines cross."""
    first, second = linkage.mechanism.chain.joints[number].links
    element, other_element = linkage.elements[number, first], linkage.elements[number, second]
    lined, line = (first, element) if element.is_line else (second, other_element)
    turned = linkage.required_pose[lined].angle
    angle = turned + line.direction
    if element.is_pin or other_element.is_pin:
        pinned, pin = (first, element) if element.is_pin else (second, other_element)
        return (*linkage.required_pose[pinned].put(pin.x, pin.y), turned)
    x, y = linkage.required_pose[first].put(element.x, element.y)
    u, v = linkage.required_pose[second].put(other_element.x, other_element.y)
    displacement = cos(angle) * (u - x) + sin(angle) * (v - y)
    return x + displacement * cos(angle), y + displacement * sin(angle), turned
