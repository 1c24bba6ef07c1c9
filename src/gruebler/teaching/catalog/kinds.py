"""Kinds of machines, by what a machine has: slides, gear teeth, cams, cylinders; not by words of its description."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from gruebler.base.text import Message, message
from gruebler.files.catalog_records import Entry
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog.features import guided_links
from gruebler.teaching.catalog.record_folders import told_once


@told_once
def machine_kinds(machine: Entry) -> tuple[str, ...]:
    """The kinds of `KINDS` that a machine is of.

    >>> from gruebler.teaching.catalog import entry
    >>> machine_kinds(entry("excavator")), machine_kinds(entry("geartrain"))
    (('slider', 'cylinder', 'guide'), ('gear',))
    """
    return tuple(kind for kind, (_, is_one) in KINDS.items() if is_one(machine))


def _has_crank(machine: Entry) -> bool:
    """A link at the frame that is called a crank, or that turns fully and carries turning and sliding pairs alone."""
    chain = machine.chain()
    turning = {link for link, motion in machine.claims.motion.items() if motion == "turns"}
    at_frame = {link for joint in chain.joints_of(_frame(machine)) for link in joint.links}
    return any(
        link == "crank"
        or "kurbel" in machine.links[link].casefold()
        or (link in turning and all(joint.pair.is_basic for joint in chain.joints_of(link)))
        for link in at_frame
    )


def _has_slider(machine: Entry) -> bool:
    return any(joint.pair.guides for joint in machine.chain().joints)


def _has_gears(machine: Entry) -> bool:
    """Wheels with teeth, or one and its rack: placed with their angle of pressure, or drawn to scale."""
    places = () if machine.screws is None else machine.screws.joints.values()
    return any("pressure" in place for place in places) or not _contacts(machine).isdisjoint({"gear", "oval"})


def _has_belt(machine: Entry) -> bool:
    return not _contacts(machine).isdisjoint({"belt", "crossed"})


def _has_cam(machine: Entry) -> bool:
    return "cam" in _contacts(machine)


@told_once
def _contacts(machine: Entry) -> set[str]:
    """What its links touch each other with, as the pictures tell it apart."""
    if machine.dimensions is None:
        return set()
    from gruebler.pictures.linkage.element_pictures import contact_shapes  # loaded where machines are searched

    return set(contact_shapes(machine.linkage()).values())


def _has_cylinder(machine: Entry) -> bool:
    """A driven slide between two links that both move: a cylinder with its piston."""
    drives = Mechanism(machine.chain(), _frame(machine), machine.drives).drives
    joints = machine.chain().joints
    return any(joints[drive.joint].pair.is_sliding and _frame(machine) not in drive.between for drive in drives)


def _draws_straight(machine: Entry) -> bool:
    """A named point with a straight path, as the entry claims with numbers; the pin of a slider has one anyhow."""
    return any(each.kind == "straight" and "(" not in each.of for each in machine.quantities)


def _guides(machine: Entry) -> bool:
    return bool(guided_links(Mechanism(machine.chain(), _frame(machine)), machine.outputs))


def _frame(machine: Entry) -> str:
    return machine.frame or machine.chain().links[0]


KINDS: Mapping[str, tuple[Message, Callable[[Entry], bool]]] = {
    "crank": (message("crank, cranks"), _has_crank),
    "slider": (message("slider, sliders"), _has_slider),
    "gear": (message("gears, gear drive"), _has_gears),
    "belt": (message("belt, belt drive"), _has_belt),
    "cam": (message("cams, cam mechanism"), _has_cam),
    "cylinder": (message("driven by hydraulic cylinders"), _has_cylinder),
    "straight": (message("straight lines"), _draws_straight),
    "guide": (message("guide mechanism"), _guides),
    "space": (message("in space"), lambda machine: machine.in_space),
}
"""Each kind with the words by which a search finds its machines, and what makes a machine one of it."""
