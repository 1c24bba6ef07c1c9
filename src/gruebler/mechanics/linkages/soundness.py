"""Whether dimensions fit a mechanism: elements for every joint, pins apart, points and poses of links that it has."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import hypot, pi

from gruebler.base.errors import LinkageError, unknown
from gruebler.base.text import Message, message
from gruebler.mechanics.linkages.contacts import check_contacts, check_elements_fit
from gruebler.mechanics.linkages.elements import Element, LinkPoint, Outline, Pose2D, read_element
from gruebler.mechanics.linkages.wheels import resolve_wheels
from gruebler.structure.mechanism import Mechanism


def checked_elements(
    mechanism: Mechanism, elements: Mapping[str, Mapping[str | int, object]]
) -> dict[tuple[int, str], Element]:
    """What each joint is on each of its links, from what was given by link and joint, in that order."""
    chain = mechanism.chain
    names = chain.joint_names()
    checked: dict[tuple[int, str], Element] = {}
    for link, by_joint in elements.items():
        for joint, raw in by_joint.items():
            number = chain.joint_number(joint, error=LinkageError)
            if link not in chain.joints[number].links:
                raise LinkageError("{joint} is not a joint of {link!r}", joint=chain.joint_title(number), link=link)
            checked[number, link] = read_element(raw, f"{link}, {names[number]}")
    _check_joints(mechanism, checked)
    checked = resolve_wheels(mechanism, checked)
    check_contacts(mechanism, checked)
    return checked


def _check_joints(mechanism: Mechanism, elements: Mapping[tuple[int, str], Element]) -> None:
    names = mechanism.chain.joint_names()
    for number, joint in enumerate(mechanism.chain.joints):
        for link in joint.links:
            if (number, link) not in elements:
                raise LinkageError(
                    "the place of {joint} on {link!r} is missing", joint=mechanism.chain.joint_title(number), link=link
                )
        check_elements_fit(joint.pair, names[number], {link: elements[number, link] for link in joint.links})
    if any(element.is_round for element in elements.values()):
        return  # shafts on one axis
    for link in mechanism.chain.links:
        pins = [(n, e) for (n, owner), e in elements.items() if owner == link and e.is_pin]
        for k, (n, pin) in enumerate(pins):
            for m, other in pins[:k]:
                size = max(hypot(pin.x, pin.y), hypot(other.x, other.y), 1e-300)
                if hypot(pin.x - other.x, pin.y - other.y) <= 1e-12 * size or pin == other:
                    raise LinkageError(
                        "on {link!r} the points of {joint} and {other} coincide: a link needs a length "
                        "(turning joints of several links at one place are written as one, such as R(a-b-c))",
                        link=link,
                        joint=mechanism.chain.joint_title(m),
                        other=mechanism.chain.joint_title(n),
                    )


def checked_link(mechanism: Mechanism, link: str, where: str | Message) -> str:
    """The name of a link that the mechanism has."""
    if link not in mechanism.chain.links:
        known = mechanism.chain.links
        raise LinkageError(
            "{where}: there is no link {word!r}{suggestion}; links are {known}", where=where, **unknown(link, known)
        )
    return link


def checked_points(mechanism: Mechanism, points: Mapping[str, tuple[str, float, float]]) -> dict[str, LinkPoint]:
    """Points by names that no link and no joint has."""
    checked = {}
    for name, place in points.items():
        if len(place) != 3:
            raise LinkageError("the point {name!r} needs a link and two coordinates", name=name)
        link, x, y = place
        what = message("the point {name!r}", name=name)
        pin = read_element([x, y], what)
        checked[name] = LinkPoint(checked_link(mechanism, link, what), pin.x, pin.y)
    for name in checked:
        if name in mechanism.chain.links or mechanism.chain.find_joint(name) is not None:
            raise LinkageError("the point {name!r} has the name of a link or joint", name=name)
    return checked


def checked_outlines(mechanism: Mechanism, outlines: Mapping[str, Iterable[Outline]]) -> dict[str, tuple[Outline, ...]]:
    """Outlines by link, in the order of the links."""
    what = "outlines"
    given = {checked_link(mechanism, link, what): of for link, of in outlines.items()}
    return {
        link: tuple(outline.checked(f"{what}.{link}") for outline in given[link])
        for link in mechanism.chain.links
        if link in given
    }


def checked_pose(mechanism: Mechanism, poses_given: Mapping[str, tuple[float, float, float]]) -> dict[str, Pose2D]:
    """Where every link lies, the frame at 0, 0, 0."""
    poses = {}
    for link in mechanism.chain.links:
        if link not in poses_given and link != mechanism.frame:
            raise LinkageError("reference pose: the position of {link!r} is missing", link=link)
        line = read_element(tuple(poses_given.get(link, (0.0, 0.0, 0.0))), message("reference pose, {link}", link=link))
        if not line.is_line:
            raise LinkageError("reference pose, {link}: expected x, y and an angle", link=link)
        poses[link] = Pose2D(line.x, line.y, line.direction)
    for link in poses_given:
        checked_link(mechanism, link, message("reference pose"))
    if any(abs(v) > 1e-12 for v in (*poses[mechanism.frame][:2], poses[mechanism.frame].angle % (2 * pi))):
        raise LinkageError("reference pose: the frame lies at 0, 0, 0; its coordinates are those of the plane")
    return poses
