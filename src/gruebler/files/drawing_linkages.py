"""The linkage of a drawing of pins and slots: links that share two pins are one, blocks in slots are links."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import chain as chain_of
from itertools import combinations
from itertools import count as count_from
from math import cos, hypot, isfinite, sin

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.files.pin_drawings import SAME, DrawnDrive, DrawnJoint, PinDrawing, extent
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import Pair, pair
from gruebler.structure.mechanism import Drive, Mechanism

_MOST = 600  # joints, and links; real mechanisms have fewer than a hundred
_MOST_AT_A_PIN = 60
_PARALLEL = 1e-6  # radians
_LEAST = 3  # links of a chain
_PIN, _SLIDE = pair("revolute"), pair("prismatic")


def linkage_of_drawing(drawing: PinDrawing, left_out: list[Message]) -> Linkage:
    """The linkage of a drawing; links that share two pins become one, links that hang freely are left out.

    Args:
        drawing: what another program has stored.
        left_out: gets a message for each thing that the linkage does not have.

    Raises `LinkageError` for numbers that are not finite, too many joints, or what is no mechanism.

    >>> pins = [("a", 0, 0, "frame crank"), ("b", 0, 2, "crank rod"), ("c", 6, 4, "rod rocker"),
    ...         ("d", 6, 0, "frame rocker"), ("pen", 3, 5, "rod")]
    >>> joints = tuple(DrawnJoint(name, x, y, tuple(links.split())) for name, x, y, links in pins)
    >>> drives = (DrawnDrive("a", "frame", "crank"),)
    >>> linkage = linkage_of_drawing(PinDrawing(frame="frame", joints=joints, drives=drives), [])
    >>> round(linkage.length("rod", "R(crank-rod)", "R(rod-rocker)"), 9), list(linkage.points)
    (6.32455532, ['pen'])
    """
    _check(drawing)
    joints, names = _rigid_links_united(drawing)
    drives = [
        replace(drive, fixed=names.find(drive.fixed), moved=names.find(drive.moved)) for drive in drawing.drives or ()
    ]
    joints = _without_loose_links(drawing.frame, joints, drives, left_out)
    joints, slide_of = _with_slides(drawing.frame, joints)
    drives = [replace(drive, joint=slide_of.get(drive.joint, drive.joint)) for drive in drives]
    known = None if drawing.drives is None else tuple(drives)
    return _built(replace(drawing, joints=tuple(joints), drives=known), left_out)


def _check(drawing: PinDrawing) -> None:
    links = {link for joint in drawing.joints for link in joint.links}
    if len(drawing.joints) > _MOST or len(links) > _MOST:
        raise LinkageError(
            "{joints:,} joints and {links:,} links are more than {most:,}",
            joints=len(drawing.joints),
            links=len(links),
            most=_MOST,
        )
    names: set[str] = set()
    for joint in drawing.joints:
        if not (isfinite(joint.x) and isfinite(joint.y) and isfinite(joint.slot or 0.0)):
            raise LinkageError("joint {joint!r}: its place is not finite numbers", joint=joint.name)
        if len(joint.links) > _MOST_AT_A_PIN:
            raise LinkageError(
                "joint {joint!r} joins {count} links; at most {most}",
                joint=joint.name,
                count=len(joint.links),
                most=_MOST_AT_A_PIN,
            )
        if joint.name in names:
            raise LinkageError("two joints are called {joint!r}", joint=joint.name)
        names.add(joint.name)


def _rigid_links_united(drawing: PinDrawing) -> tuple[list[DrawnJoint], DisjointSets[str]]:
    """The joints with one name for links that share two pins or are fastened: they cannot move against each other."""
    links = dict.fromkeys([drawing.frame, *(link for joint in drawing.joints for link in joint.links)])
    links |= dict.fromkeys(link for drive in drawing.drives or () for link in (drive.fixed, drive.moved))
    names = DisjointSets(links | dict.fromkeys(link for both in drawing.rigid for link in both))
    for kept, joined in drawing.rigid:
        _unite(names, kept, joined, drawing.frame)
    near = SAME * extent(drawing.joints)
    joints = list(drawing.joints)
    united = True
    while united:
        joints = [replace(joint, links=tuple(dict.fromkeys(map(names.find, joint.links)))) for joint in joints]
        united = False
        shared: dict[frozenset[str], DrawnJoint] = {}
        for joint in joints:
            for kept, joined in combinations(joint.links if joint.slot is None else (), 2):
                first = shared.setdefault(frozenset((kept, joined)), joint)
                apart = hypot(first.x - joint.x, first.y - joint.y) > near
                if apart and names.find(kept) != names.find(joined):
                    _unite(names, kept, joined, drawing.frame)
                    united = True
    return joints, names


def _unite(names: DisjointSets[str], first: str, second: str, frame: str) -> None:
    names.unite(*((second, first) if names.find(second) == names.find(frame) else (first, second)))


def _without_loose_links(
    frame: str, joints: list[DrawnJoint], drives: Sequence[DrawnDrive], left_out: list[Message]
) -> list[DrawnJoint]:
    """The joints without links that only hang on one joint, unless a drive moves them."""
    kept = {frame, *(link for drive in drives for link in (drive.fixed, drive.moved))}
    while True:
        count = Counter(link for joint in joints if len(joint.links) > 1 for link in joint.links)
        loose = {link for joint in joints for link in joint.links if count[link] < 2} - kept
        if not loose:
            return joints
        left_out.append(message("links that hang on one joint only: {links}", links=", ".join(sorted(loose))))
        joints = [
            replace(joint, links=tuple(link for link in joint.links if link not in loose))
            for joint in joints
            if not (joint.slot is not None and joint.links[0] in loose)
        ]
        joints = [joint for joint in joints if joint.links]


def _with_slides(frame: str, joints: list[DrawnJoint]) -> tuple[list[DrawnJoint], dict[str, str]]:
    """The joints in which two pins of a link in one slot are a slide: the link moves along it without turning.

    And the slide of each such pin, by names: what drives the pin along the slot drives the slide.
    """
    near = 1e-7 * extent(joints)  # places in files have fewer digits than numbers
    taken: set[tuple[str, str]] = set()
    drawn, slides, slide_of = list(joints), [], {}
    in_slots = [k for k, joint in enumerate(drawn) if joint.slot is not None and joint.turns]
    for first, second in combinations(in_slots, 2):
        joint_a, joint_b = drawn[first], drawn[second]
        if joint_a.slot is None or joint_b.slot is None or joint_a.links[0] != joint_b.links[0]:
            continue
        across = abs(cos(joint_a.slot) * (joint_b.y - joint_a.y) - sin(joint_a.slot) * (joint_b.x - joint_a.x))
        both = [
            link for link in joint_a.links[1:] if link in joint_b.links[1:] and (joint_a.links[0], link) not in taken
        ]
        if not both or across > near or abs(sin(joint_a.slot - joint_b.slot)) > _PARALLEL:
            continue
        base, link = joint_a.links[0], min(both, key=lambda name: name != frame)
        taken.add((base, link))
        slides.append(
            DrawnJoint(
                name=f"{joint_a.name} slide",
                x=joint_a.x,
                y=joint_a.y,
                links=(base, link),
                slot=joint_a.slot,
                turns=False,
            )
        )
        for k in (first, second):
            others = [name for name in drawn[k].links[1:] if name != link]
            drawn[k] = replace(drawn[k], links=(link, *others), slot=None)
            slide_of[drawn[k].name] = slides[-1].name
    return drawn + slides, slide_of


def _built(drawing: PinDrawing, left_out: list[Message]) -> Linkage:
    joints: list[tuple[Pair, tuple[str, ...], object]] = []  # pair, links, place
    of_joint: dict[str, list[int]] = {}
    points: dict[str, tuple[str, float, float]] = {}
    used = {link for joint in drawing.joints for link in joint.links}
    for joint in drawing.joints:
        first = len(joints)
        if len(joint.links) == 1:
            if joint.slot is None:
                points[_free_name(joint.name, used | points.keys())] = (joint.links[0], joint.x, joint.y)
            continue
        if joint.slot is None:
            joints.append((_PIN, joint.links, (joint.x, joint.y)))
        else:
            base, *others = joint.links
            line = (joint.x, joint.y, joint.slot)
            if joint.turns:
                block = _free_name(f"block {joint.name}", used)
                used.add(block)
                joints += [(_SLIDE, (base, block), line), (_PIN, (block, *others), line[:2])]
            else:
                joints += [(_SLIDE, (base, other), line) for other in others]
        of_joint[joint.name] = list(range(first, len(joints)))
    chain = _connected(drawing.frame, joints, points, left_out)
    drives = []
    for drive in drawing.drives or ():
        driven = _drive(drive, joints, of_joint.get(drive.joint, []))
        if driven is None:
            left_out.append(message("the drive of joint {joint}, which moves nothing", joint=drive.joint))
        elif joints[driven.joint] in chain:
            drives.append(replace(driven, joint=chain.index(joints[driven.joint])))
    made_chain = Chain([Joint(kind, links) for kind, links, _ in chain])
    if drawing.drives is None:
        drives = _likely_drives(made_chain, drawing.frame)
    mechanism = Mechanism(made_chain, drawing.frame, drives)
    places: dict[str | int, object] = {number: place for number, (_, _, place) in enumerate(chain)}
    return Linkage.from_drawing(mechanism, places, points=points, unit=drawing.unit)


def _connected(
    frame: str,
    joints: list[tuple[Pair, tuple[str, ...], object]],
    points: dict[str, tuple[str, float, float]],
    left_out: list[Message],
) -> list[tuple[Pair, tuple[str, ...], object]]:
    """The joints of the part that stands on the frame; points of the others are removed."""
    sets = DisjointSets(dict.fromkeys([frame, *(link for _, links, _ in joints for link in links)]))
    for _, links, _ in joints:
        for other in links[1:]:
            sets.unite(links[0], other)
    chain = [joint for joint in joints if sets.find(joint[1][0]) == sets.find(frame)]
    links_there = dict.fromkeys([frame, *(link for _, links, _ in chain for link in links)])
    if len(links_there) < _LEAST:
        raise LinkageError(
            "there is no mechanism on the frame: a mechanism has at least three links, and here are only {links}",
            links=", ".join(links_there),
        )
    if len(chain) < len(joints):
        others = {link for joint in joints if joint not in chain for link in joint[1]}
        left_out.append(message("links that the frame does not hold: {links}", links=", ".join(sorted(others))))
    standing = {link for _, links, _ in chain for link in links}
    for name in [name for name, (link, _, _) in points.items() if link not in standing]:
        del points[name]
    return chain


def _drive(
    drive: DrawnDrive, joints: Sequence[tuple[Pair, tuple[str, ...], object]], numbers: Sequence[int]
) -> Drive | None:
    """The drive, its joint by its number; None if its links do not move against each other there."""
    for number in numbers:
        kind, links, _ = joints[number]
        if kind.is_sliding and drive.fixed == links[0]:
            return Drive(number, kind.motion[0], (links[0], links[1]))
        others = [link for link in (drive.moved, *links) if link in links and link != drive.fixed]
        if kind.is_turning and drive.fixed in links and others:  # a link that is fastened there cannot be meant
            return Drive(number, kind.motion[0], (drive.fixed, others[0]))
    return None


def _likely_drives(chain: Chain, frame: str) -> list[Drive]:
    """Pins on the frame, else slides, as many as the count of freedoms asks for, at least one."""
    candidates = [
        Drive(number, joint.pair.freedoms[chain.space][0], (frame, link))
        for kind in (_PIN, _SLIDE)
        for number, joint in enumerate(chain.joints)
        if joint.pair == kind and frame in joint.links
        for link in joint.links
        if link != frame and chain.degrees[link] > 1
    ]
    return candidates[: max(1, 3 * (chain.n - 1) - 2 * chain.g)]


def _free_name(name: str, used: Collection[str]) -> str:
    """The name, or the first one like it that is not used."""
    return next(each for each in chain_of([name], (f"{name} ({k})" for k in count_from(2))) if each not in used)
