"""Elements that meet in a joint: which kinds make which pairs, and what must fit between them.

One row for each two kinds. What they ask of a motion stands in `gruebler.mechanics.kinematics.contacts`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import hypot
from typing import Any, Generic, TypeVar

from gruebler.base.errors import LinkageError
from gruebler.base.text import Readable, joined_by_or, message
from gruebler.mechanics.linkages.elements import (
    INVERSE,
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    NonCircular,
    Pin,
    Wheel,
)
from gruebler.mechanics.linkages.wheels import Carrier, Elements, carriers, round_joints
from gruebler.structure.chain.pairs import Pair
from gruebler.structure.mechanism import Mechanism

_SAME = 1e-9  # of a length: a distance that fits
First_co = TypeVar("First_co", bound=Element, covariant=True)
Second_co = TypeVar("Second_co", bound=Element, covariant=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class JoinedElements(Generic[First_co, Second_co]):
    """Two elements that meet in a joint, as they are checked; in the order of their row."""

    name: Readable
    first: First_co
    second: Second_co
    rolls: bool
    """Whether they roll on each other."""
    held: Carrier | None
    """The link that carries both centres, if there is one."""
    reach: float
    """The largest distance of a joint on that link from its origin."""


@dataclass(frozen=True, slots=True)
class JoinedKinds:
    """Two kinds of elements that make a joint."""

    kinds: tuple[type[Element], type[Element]]
    pairs: tuple[str, ...]
    """The names of the pairs of which they are the elements."""
    check: Callable[[JoinedElements[Any, Any]], None] = lambda _: None
    """`LinkageError` for elements that do not fit together."""


Disc = Wheel | Circle


def _check_discs(joined: JoinedElements[Disc, Disc]) -> None:
    """Beside or inside each other."""
    low, high = sorted((joined.first.radius, joined.second.radius))
    if high < 0:
        raise LinkageError("{name}: two internal wheels do not touch", name=joined.name)
    if low < 0 <= low + high:
        raise LinkageError(
            "{name}: the internal wheel (minus) must be larger than the one in it: {low:g} and {high:g}",
            name=joined.name,
            low=low,
            high=high,
        )


def _check_apart(joined: JoinedElements[Disc, Disc]) -> None:
    """Where a link holds the centres, it holds them as far apart as the radii make it."""
    apart = abs(joined.first.radius + joined.second.radius)
    if joined.held is not None and abs(joined.held.distance - apart) > _SAME * apart:
        raise LinkageError(
            "{name}: the centres are {distance:.12g} apart on {link!r}, but the radii make {apart:.12g}",
            name=joined.name,
            distance=joined.held.distance,
            link=joined.held.link,
            apart=apart,
        )


def _check_circles(joined: JoinedElements[Circle, Circle]) -> None:
    _check_discs(joined)
    _check_apart(joined)


def _check_wheels(joined: JoinedElements[Wheel, Wheel]) -> None:
    _check_discs(joined)
    name, first, second = joined.name, joined.first, joined.second
    if first.belt != second.belt:
        raise LinkageError("{name}: both wheels of a belt are 'open' or both 'crossed'", name=name)
    if first.belt and joined.rolls:
        raise LinkageError("{name}: a belt is not a rolling contact; write it as a roll-slide joint G", name=name)
    if bool(first.teeth) != bool(second.teeth):
        raise LinkageError("{name}: tooth numbers on both wheels or on none", name=name)
    if first.pressure_angle != second.pressure_angle:
        raise LinkageError("{name}: teeth that mesh have one pressure angle", name=name)
    if first.teeth and abs(first.radius / first.teeth - second.radius / second.teeth) > _SAME * abs(
        first.radius / first.teeth
    ):
        modules = " and ".join(f"{2 * wheel.radius / wheel.teeth:.9g}" for wheel in (first, second))
        raise LinkageError("{name}: the modules differ: {modules}", name=name, modules=modules)
    if joined.rolls:
        _check_apart(joined)


def _check_rack(joined: JoinedElements[Wheel, Line]) -> None:
    _check_on_line(joined.name, sound=joined.first.radius > 0 and not joined.first.belt)


def _check_circle_on_line(joined: JoinedElements[Circle, Line]) -> None:
    _check_on_line(joined.name, sound=joined.first.radius > 0)


def _check_on_line(name: Readable, *, sound: bool) -> None:
    if not sound:
        raise LinkageError("{name}: along a line rolls a wheel of positive radius, without a belt", name=name)


def _check_cam_and_circle(joined: JoinedElements[CamDisc, Circle]) -> None:
    _check_follower(joined.name, joined.first, joined.second.radius, flat=False)


def _check_cam_and_pin(joined: JoinedElements[CamDisc, Pin]) -> None:
    _check_follower(joined.name, joined.first, 0.0, flat=False)


def _check_cam_and_line(joined: JoinedElements[CamDisc, Line]) -> None:
    _check_follower(joined.name, joined.first, 0.0, flat=True)


def _check_follower(name: Readable, disc: CamDisc, radius: float, *, flat: bool) -> None:
    if disc.flat != flat:
        raise LinkageError(
            "{name}: a cam for a flat face touches a line, one for a roller a circle or a pin", name=name
        )
    if abs(radius - disc.roller * disc.scale) > _SAME * disc.base * disc.scale:
        raise LinkageError(
            "{name}: the cam is made for a roller of {roller:g}, not {radius:g}",
            name=name,
            roller=disc.roller * disc.scale,
            radius=radius,
        )


def _check_noncircular(joined: JoinedElements[NonCircular, NonCircular]) -> None:
    name, first, second = joined.name, joined.first, joined.second
    if not all(isinstance(wheel.transfer, str) and wheel.transfer.strip() for wheel in (first, second)):
        raise LinkageError(
            "{name}: transfer: expected a text such as 'ellipse 0.5' or 'rise 20 180; fall 20 180'", name=name
        )
    if (first.transfer == INVERSE) == (second.transfer == INVERSE):
        raise LinkageError(
            "{name}: one of two non-circular wheels has a transfer function, the other {inverse!r}",
            name=name,
            inverse=INVERSE,
        )
    if bool(first.teeth) != bool(second.teeth):
        raise LinkageError("{name}: tooth numbers on both wheels or on none", name=name)
    if joined.held is None:
        raise LinkageError("{name}: non-circular wheels need a link that carries both centres by pins", name=name)
    if not joined.held.distance > _SAME * joined.reach:
        raise LinkageError(
            "{name}: the centre distance on {link!r} is too small: it is 0", name=name, link=joined.held.link
        )


CONTACTS = (
    JoinedKinds((Pin, Pin), ("revolute",)),
    JoinedKinds((Line, Line), ("prismatic", "double_slide")),
    JoinedKinds((Line, Pin), ("roll_slide",)),
    JoinedKinds((Wheel, Wheel), ("roll_slide", "rolling"), _check_wheels),
    JoinedKinds((Wheel, Line), ("roll_slide", "rolling"), _check_rack),
    JoinedKinds((Circle, Circle), ("roll_slide",), _check_circles),
    JoinedKinds((Circle, Line), ("roll_slide",), _check_circle_on_line),
    JoinedKinds((CamDisc, Circle), ("roll_slide",), _check_cam_and_circle),
    JoinedKinds((CamDisc, Pin), ("roll_slide",), _check_cam_and_pin),
    JoinedKinds((CamDisc, Line), ("roll_slide",), _check_cam_and_line),
    JoinedKinds((GenevaDriver, GenevaWheel), ("roll_slide",)),
    JoinedKinds((NonCircular, NonCircular), ("roll_slide", "rolling"), _check_noncircular),
)
"""Every two kinds of elements that make a joint, in the order in which messages name them."""

_BY_KINDS = {kinds: row for row in CONTACTS for kinds in (row.kinds, row.kinds[::-1])}


def contact_of(first: Element, second: Element) -> JoinedKinds:
    """The row of two elements of a checked joint, whichever comes first."""
    return _BY_KINDS[type(first), type(second)]


def in_order(contact: JoinedKinds, first: Element) -> bool:
    """Whether an element is of the kind that its row names first."""
    return type(first) is contact.kinds[0]


def check_elements_fit(pair: Pair, name: str, elements: dict[str, Element]) -> None:
    """Check that a joint has the elements of its pair; `LinkageError` names the joint."""
    rows = [row for row in CONTACTS if pair.name in row.pairs]
    if not rows:
        raise LinkageError(
            "{name}: dimensions of this kind of joint ({pair}) are not known here", name=name, pair=pair.title
        )
    given = {type(e) for e in elements.values()}
    if any(given == {*row.kinds} for row in rows):
        return
    wanted = [
        message("{element} on each of its links", element=first.title)
        if first is second
        else message("{one} on one of its links and {other} on the other", one=first.title, other=second.title)
        for first, second in (row.kinds for row in rows)
    ]
    raise LinkageError("{name} needs {elements}", name=name, elements=joined_by_or(wanted))


def check_contacts(mechanism: Mechanism, elements: Elements) -> None:
    """`LinkageError` names the joint whose round elements do not fit together."""
    held = carriers(mechanism, elements)
    for number, links in round_joints(mechanism, elements).items():
        name, joint = mechanism.chain.joint_title(number), mechanism.chain.joints[number]
        if len(joint.links) > 2:
            raise LinkageError("{name}: wheels touch in pairs; write a joint for each two of them", name=name)
        if any(drive.joint == number for drive in mechanism.drives):
            raise LinkageError("{name}: a pair of wheels is not driven; drive a shaft", name=name)
        first, second = (elements[number, link] for link in links)
        contact, arm = contact_of(first, second), held.get(number)
        if not in_order(contact, first):
            first, second = second, first
        reach = 0.0 if arm is None else max(hypot(e.x, e.y) for (_, owner), e in elements.items() if owner == arm.link)
        rolls = joint.pair.rolls
        contact.check(JoinedElements(name=name, first=first, second=second, rolls=rolls, held=arm, reach=reach))
