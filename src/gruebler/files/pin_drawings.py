"""Mechanisms as other programs store them: pins and slots at places of one drawing, and the links that meet there.

`linkage_of` makes a linkage of such a drawing, `drawing_of` a drawing of a linkage. What a linkage has and the drawing
has not is a message in a list that the caller passes, so that nothing is lost in silence.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from itertools import chain as chain_of
from itertools import combinations
from itertools import count as count_from
from math import cos, hypot, isfinite, pi, remainder, sin
from string import ascii_uppercase
from typing import Any

from gruebler.base.disjoint_sets import DisjointSets
from gruebler.base.errors import LinkageError
from gruebler.base.text import Message, message
from gruebler.base.units import MILLIMETRES
from gruebler.files.measured_lengths import in_unit
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import Linkage, with_lower_pairs
from gruebler.mechanics.linkages.elements import Pose2D
from gruebler.structure.chain import Chain, Joint
from gruebler.structure.chain.pairs import Pair, pair
from gruebler.structure.mechanism import Drive, Mechanism

NO_UNIT_WRITTEN = message("the unit of the numbers, which are mm")
"""What writers of formats without a unit say; their readers say `no_unit`."""
_MOST = 600  # joints, and links; real mechanisms have fewer than a hundred
_MOST_AT_A_PIN = 60
_SAME = 1e-9  # of the size of the drawing: places that are nearer are one place
_PARALLEL = 1e-6  # radians
_LEAST = 3  # links of a chain
_PIN, _SLIDE = pair("revolute"), pair("prismatic")
_TRIALS = 72
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


# --- from a drawing to a linkage ---------------------------------------------------------------------


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


def _extent(joints: Iterable[DrawnJoint]) -> float:
    """A length of the order of the drawing."""
    places = [(joint.x, joint.y) for joint in joints]
    if not places:
        return 1.0
    xs, ys = zip(*places, strict=True)
    return max(max(xs) - min(xs), max(ys) - min(ys)) or 1.0


def _rigid_links_united(drawing: PinDrawing) -> tuple[list[DrawnJoint], DisjointSets[str]]:
    """The joints with one name for links that share two pins or are fastened: they cannot move against each other."""
    links = dict.fromkeys([drawing.frame, *(link for joint in drawing.joints for link in joint.links)])
    links |= dict.fromkeys(link for drive in drawing.drives or () for link in (drive.fixed, drive.moved))
    names = DisjointSets(links | dict.fromkeys(link for both in drawing.rigid for link in both))
    for kept, joined in drawing.rigid:
        _unite(names, kept, joined, drawing.frame)
    near = _SAME * _extent(drawing.joints)
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
    near = 1e-7 * _extent(joints)  # places in files have fewer digits than numbers
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


# --- from a linkage to a drawing ---------------------------------------------------------------------


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
        if abs(across) <= _SAME * lower.size and base not in pin.links:
            slots[others[0]] = slide
    return slots


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
    reach = _extent(drawing.joints) / 2
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
