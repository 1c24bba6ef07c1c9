"""Other sizes of cams and rollers: the linkage with them in the pose that is nearest to the one before."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from math import copysign, cos, sin
from typing import Any, cast

from gruebler.base.errors import LinkageError
from gruebler.mechanics.kinematics.contours import cam_of
from gruebler.mechanics.kinematics.solve import move_quietly
from gruebler.mechanics.linkages import CamDisc, Element, Linkage, Pose2D

_MOST_STEPS = 64


def with_round_sizes(
    linkage: Linkage, joint: str, link: str, sizes: Mapping[str, float | str], drives: list[float]
) -> Linkage:
    """The linkage with another ``base``, ``lift`` or ``circle`` of an element, at the same values of its drives.

    The sizes go evenly from the old ones to the new ones, and each pose comes from the one before, so that the linkage
    stays in its assembly mode. A roller is the same size for its cam. Raises `LinkageError` for a size that the element
    does not have, for a cam that cannot be, and where the linkage cannot be assembled on the way.

    >>> from gruebler.teaching.catalog import entry
    >>> larger = with_round_sizes(entry("cam_roller").linkage(), "G(cam-roller)", "roller", {"circle": 15.0}, [0.0])
    >>> larger.element("G(cam-roller)", "cam").roller, round(larger.required_pose["roller"].y, 6)
    (15.0, 55.0)
    """
    number = linkage.mechanism.chain.joint_number(joint, error=LinkageError)
    own = linkage.element(number, link)
    for key in sizes:
        if key not in own.own_sizes:
            raise LinkageError("{link} has no such size", link=link)
    before = {owner: linkage.element(number, owner) for owner in linkage.mechanism.chain.joints[number].links}

    def at(part: float) -> dict[str, Element]:
        return {owner: _between(element, owner == link, sizes, part) for owner, element in before.items()}

    for cam in _cams(at(1.0)).values():
        cam_of(cam)  # one that cannot be is told as such
    for guess in _guesses(linkage, number, at(1.0)):
        with suppress(LinkageError):
            return _counted_from_lowest(linkage, _placed(guess, number, at(1.0), drives), number)
    steps = 4
    while True:
        try:
            changed = linkage
            for step in range(1, steps + 1):
                changed = _placed(changed, number, at(step / steps), drives)
            return _counted_from_lowest(linkage, changed, number)
        except LinkageError:
            if steps >= _MOST_STEPS:
                raise
            steps *= 4


def _guesses(linkage: Linkage, number: int, elements: Mapping[str, Element]) -> Iterator[Linkage]:
    """The linkage in poses near that with other elements of a joint, as far as they are simple to tell."""
    yield linkage
    follower = _follower(linkage, number)
    if follower is None:
        return
    old, links, guide = follower
    new = next(iter(_cams(elements).values()))
    further = cam_of(new).start - cam_of(old).start
    frame, pose = linkage.required_pose[linkage.mechanism.frame], linkage.required_pose
    for sign in (1, -1):
        moved = dict(pose)
        for link in links:
            x, y, angle = pose[link]
            if guide.is_line:
                far, along = sign * new.scale * further, frame.angle + guide.direction
                moved[link] = Pose2D(x + far * cos(along), y + far * sin(along), angle)
            else:
                pivot, turn = frame.put(guide.x, guide.y), sign * further
                about = Pose2D(*pivot, turn).put(x - pivot[0], y - pivot[1])
                moved[link] = Pose2D(*about, angle + turn)
        yield linkage.with_reference_pose(moved)


def _follower(linkage: Linkage, number: int) -> tuple[CamDisc, set[str], Element] | None:
    """The cam of a joint, the links that it moves, a roller included, and what guides them in the frame."""
    joints, frame = linkage.mechanism.chain.joints, linkage.mechanism.frame
    cams = _cams({link: linkage.elements[number, link] for link in joints[number].links})
    touching = {*joints[number].links} - {*cams}
    links = {link for joint in joints if touching & {*joint.links} for link in joint.links} - {frame, *cams}
    guides = [
        element
        for (joint, link), element in linkage.elements.items()
        if link == frame and not element.is_round and links & {*joints[joint].links}
    ]
    return (next(iter(cams.values())), links, guides[0]) if cams and len(guides) == 1 else None


def _cams(elements: Mapping[str, Element]) -> dict[str, CamDisc]:
    return {link: cast("CamDisc", element) for link, element in elements.items() if "lift" in element.own_sizes}


def _placed(linkage: Linkage, number: int, elements: Mapping[str, Element], drives: list[float]) -> Linkage:
    changed = _with_elements(linkage, {(number, link): element for link, element in elements.items()})
    motion = move_quietly(changed, [drives])
    if not motion.complete:
        raise LinkageError("with these sizes the linkage cannot be assembled here; try another position of the drive")
    return changed.with_reference_pose(motion.pose())


def _counted_from_lowest(before: Linkage, after: Linkage, number: int) -> Linkage:
    """The way of a follower that slides in the frame is counted from as far as before beyond its lowest position."""
    follower, old = _follower(after, number), _follower(before, number)
    if follower is None or old is None or not follower[2].is_line:
        return after
    cam, _, guide = follower
    further = cam.scale * (cam_of(cam).start - cam_of(old[0]).start)
    owner = next(link for (joint, link), element in after.elements.items() if joint == number and element is cam)
    x, y = after.required_pose[owner].put(cam.x, cam.y)
    x, y = after.required_pose[after.mechanism.frame].to_local(x, y)
    along = cos(guide.direction), sin(guide.direction)
    far = copysign(1.0, along[0] * (guide.x - x) + along[1] * (guide.y - y)) * further
    shifted = guide.placed(guide.x + far * along[0], guide.y + far * along[1], guide.direction)
    return _with_elements(after, {key: shifted for key, element in after.elements.items() if element is guide})


def _with_elements(linkage: Linkage, elements: Mapping[tuple[int, str], Element]) -> Linkage:
    by_link: dict[str, dict[str | int, object]] = {link: {} for link in linkage.mechanism.chain.links}
    for (joint, link), element in linkage.elements.items():
        by_link[link][joint] = elements.get((joint, link), element)
    return Linkage(
        linkage.mechanism,
        by_link,
        points={name: (point.link, point.x, point.y) for name, point in linkage.points.items()},
        unit=linkage.unit,
        reference_pose=linkage.reference_pose,
        outputs=linkage.outputs,
        outlines=linkage.outlines,
    )


def _between(element: Element, own: bool, sizes: Mapping[str, float | str], part: float) -> Element:
    """An element part of the way to the new sizes."""
    if not own:
        cam = _cams({"": element}).get("")
        if cam is None or not cam.roller or "circle" not in sizes:
            return element
        size = float(sizes["circle"]) / cam.scale
        return replace(cam, roller=cam.roller + part * (size - cam.roller))
    changes: dict[str, Any] = {}
    for key, wanted in sizes.items():
        name = element.own_sizes[key]
        old = getattr(element, name)
        changes[name] = _law_between(old, str(wanted), part) if key == "lift" else old + part * (float(wanted) - old)
    return replace(element, **changes)


def _law_between(old: str, new: str, part: float) -> str:
    """A lift part of the way to another one of the same parts, as text."""
    if part == 1 or len(old.split()) != len(new.split()):
        return new
    words = zip(old.split(), new.split(), strict=True)
    return " ".join(_number_between(first, other, part) for first, other in words)


def _number_between(first: str, other: str, part: float) -> str:
    try:
        old, new = (float(word.rstrip(";")) for word in (first, other))
    except ValueError:
        return other
    return f"{old + part * (new - old)!r}{';' * other.endswith(';')}"
