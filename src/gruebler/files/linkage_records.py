"""What stands in a file of a linkage: the keys, and what they make of a mechanism.

Lengths are in the unit that the file names, angles in degrees; docs/theory/linkage-files.md has every key.
"""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from gruebler.base.documents import convert_document
from gruebler.base.errors import LinkageError, UnitWarning, naming, unknown
from gruebler.base.text import joined_by_and, message
from gruebler.files.angles import in_degrees
from gruebler.files.element_records import in_short, read_element_table, read_numbers
from gruebler.mechanics.fourbar.four_bar import FourBar
from gruebler.mechanics.fourbar.inverted_slider_crank import InvertedSliderCrank
from gruebler.mechanics.fourbar.length_forms import linkage_on_mechanism
from gruebler.mechanics.fourbar.length_texts import ClosedForm
from gruebler.mechanics.fourbar.slider_crank import SliderCrank
from gruebler.mechanics.linkages.elements import Outline, Pose2D
from gruebler.mechanics.linkages.model import Linkage
from gruebler.structure.mechanism import Mechanism


class FourBarLengths(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Crank a, coupler b, rocker c, frame d."""

    a: float
    b: float
    c: float
    d: float
    branch: str = "+"


class SliderCrankLengths(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Crank a, connecting rod b, eccentricity e."""

    a: float
    b: float
    e: float = 0.0
    branch: str = "+"


class InvertedSliderCrankLengths(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Crank a, frame d, eccentricity e."""

    a: float
    d: float
    e: float = 0.0
    branch: str = "+"


class PointRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A named point: its link, and where it lies."""

    link: str
    at: list[float]


class OutlineRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What a link looks like besides its joints: a disc about a place, or a line or polygon through several."""

    link: str
    at: list[float] | None = None
    radius: float = 0.0
    through: list[list[float]] = []


class Dimensions(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The sizes of a mechanism, given in one of several ways."""

    unit: str
    elements: dict[str, Any] | None = None
    reference_pose: dict[str, Any] | None = None
    places: dict[str, Any] | None = None
    four_bar: FourBarLengths | None = None
    slider_crank: SliderCrankLengths | None = None
    inverted_slider_crank: InvertedSliderCrankLengths | None = None
    points: dict[str, Any] = {}
    outlines: list[OutlineRecord] = []


_DOORS = {"four_bar": FourBar, "slider_crank": SliderCrank, "inverted_slider_crank": InvertedSliderCrank}
WAYS = ("elements", "places", *_DOORS)
"""How a document gives its sizes: it has one of these keys."""


def linkage_from_record(sizes: Dimensions, mechanism: Mechanism | None, outputs: tuple[str, ...] | None) -> Linkage:
    """The linkage of these sizes; without a mechanism the one that four_bar, slider_crank, ... bring along.

    Raises `LinkageError` with the key of the first thing that does not fit.
    """
    linkage = _linkage(sizes, mechanism, outputs)
    if not sizes.outlines:
        return linkage
    poses = (linkage.reference_pose or {}) if sizes.places is not None else {}
    return linkage.with_outlines(_outlines(sizes.outlines, linkage.mechanism.chain.links, poses))


def _linkage(sizes: Dimensions, mechanism: Mechanism | None, outputs: tuple[str, ...] | None) -> Linkage:
    given = [form for form in WAYS if getattr(sizes, form) is not None]
    if len(given) != 1:
        raise LinkageError(
            "expected one of {ways}, but found {found}",
            ways=", ".join(WAYS),
            found=joined_by_and(given) if given else message("none"),
        )
    form = given[0]
    if sizes.reference_pose is not None and form != "elements":
        raise LinkageError(
            "{key} is allowed with elements only; {form} itself decides how the linkage is assembled",
            key="reference_pose",
            form=form,
        )
    if (sizes.unit and not sizes.unit.strip()) or len(sizes.unit) > 20 or not sizes.unit.isprintable():
        raise LinkageError(
            "unit: expected the name of a unit of length such as 'mm', but found {unit!r}", unit=sizes.unit[:20]
        )
    if mechanism is None and form not in _DOORS:
        raise LinkageError("joints: missing; {way} needs them, such as R(frame-crank) R(crank-coupler) ...", way=form)
    if form in _DOORS:
        return _door(form, getattr(sizes, form), sizes, mechanism, outputs)
    assert mechanism is not None
    points = _points(sizes.points, mechanism.chain.links)
    chosen = outputs or ()
    if form == "places":
        assert sizes.places is not None
        places = _by_joint(mechanism, _aimed(mechanism, sizes.places), "places", slots=True)
        _refuse_rounded_axes(mechanism, places)
        return Linkage.from_drawing(mechanism, places, points=points, unit=sizes.unit, outputs=chosen)
    assert sizes.elements is not None
    elements: dict[str, Mapping[str | int, object]] = {}
    for link, values in sizes.elements.items():
        _check_link(link, mechanism.chain.links, "elements")
        if not isinstance(values, Mapping):
            raise LinkageError(
                "elements.{link}: expected a table of joints, but found {found}", link=link, found=in_short(values)
            )
        elements[link] = _by_joint(mechanism, values, f"elements.{link}")
    raw = sizes.reference_pose
    pose = None if raw is None else _reference_pose(raw, mechanism.chain.links)
    with warnings.catch_warnings(action="ignore", category=UnitWarning):  # these were degrees
        return Linkage(mechanism, elements, points=points, unit=sizes.unit, reference_pose=pose, outputs=chosen)


def _door(
    form: str, lengths: Any, sizes: Dimensions, mechanism: Mechanism | None, outputs: tuple[str, ...] | None
) -> Linkage:
    given = msgspec.structs.asdict(lengths)
    branch = given.pop("branch")
    if branch not in ("+", "-"):
        raise LinkageError("{way}.branch: expected + or -, but found {branch!r}", way=form, branch=branch)
    with naming(form, LinkageError):
        door: ClosedForm = _DOORS[form](**given)
    linkage = linkage_on_mechanism(form, door, branch, mechanism, unit=sizes.unit, outputs=outputs)
    points = _points(sizes.points, linkage.mechanism.chain.links)
    return linkage.with_points(points) if points else linkage


def _by_joint(
    mechanism: Mechanism, values: Mapping[str, Any], where: str, *, slots: bool = False
) -> dict[str | int, object]:
    elements: dict[str | int, object] = {}
    for joint, raw in values.items():
        with naming(where, LinkageError):
            number = mechanism.chain.joint_number(joint, error=LinkageError)
        if number in elements:
            raise LinkageError("{where}.{joint}: this joint is given twice", where=where, joint=joint)
        elements[number] = _element(raw, f"{where}.{joint}", slots)
    return elements


def _aimed(mechanism: Mechanism, places: Mapping[str, Any]) -> dict[str, Any]:
    """The places with degrees instead of the joint through which a slide passes: ``[x, y, "R(piston-boom)"]``."""
    chain = mechanism.chain
    by_number = {chain.find_joint(joint): raw for joint, raw in places.items()}
    aimed = dict(places)
    for joint, raw in places.items():
        if not (isinstance(raw, list) and len(raw) == 3 and isinstance(raw[2], str) and "(" in raw[2]):
            continue
        where, target = f"places.{joint}", by_number.get(chain.find_joint(raw[2]))
        if not isinstance(target, list):
            raise LinkageError(
                "{where}: {joint!r} has no place through which the slide could pass", where=where, joint=raw[2][:60]
            )
        (x, y), (u, v) = read_numbers(raw[:2], where, (2,)), read_numbers(target[:2], f"places.{raw[2]}", (2,))
        if (x, y) == (u, v):
            raise LinkageError(
                "{where}: {joint} is at the slide's own point; give another point of its line",
                where=where,
                joint=raw[2],
            )
        aimed[joint] = [raw[0], raw[1], in_degrees(math.atan2(v - y, u - x))]
    return aimed


_ROUNDED, _MEANT = 1e-9, 1e-3  # of the distance of two pins: what rounding to all digits and to three leaves open


def _refuse_rounded_axes(mechanism: Mechanism, places: Mapping[str | int, object]) -> None:
    """Refuse a slide between moving links that all but passes through a pin of each: its angle has too few digits.

    A cylinder drawn so would have an offset that nobody meant.
    """
    chain, names = mechanism.chain, mechanism.chain.joint_names()
    pins = {k: raw for k, raw in places.items() if isinstance(raw, tuple) and len(raw) == 2}
    for number, joint in enumerate(chain.joints):
        raw = places.get(number)
        if not joint.pair.is_sliding or mechanism.frame in joint.links or not isinstance(raw, tuple):
            continue
        angle = raw[2] if len(raw) == 3 else 0.0
        on = [[k for k in pins if isinstance(k, int) and link in chain.joints[k].links] for link in joint.links]
        for pin, other in itertools.product(*on[:2]):
            across = (pins[other][0] - pins[pin][0], pins[other][1] - pins[pin][1])
            far, miss = math.hypot(*across), abs(math.cos(angle) * across[1] - math.sin(angle) * across[0])
            if _ROUNDED * far < miss < _MEANT * far:
                raise LinkageError(
                    'places.{slide}: the slide through {pin} misses {other} by {miss:.2g}; write "{other}" '
                    "instead of the angle, or the angle with all its digits",
                    slide=names[number],
                    pin=names[pin],
                    other=names[other],
                    miss=miss,
                )


def _element(raw: Any, where: str, slots: bool) -> object:
    if slots and isinstance(raw, Mapping):
        return {link: _element(value, f"{where}.{link}", False) for link, value in raw.items()}
    if isinstance(raw, Mapping):
        return read_element_table(raw, where)
    if slots and isinstance(raw, list) and len(raw) == 4 and isinstance(raw[3], str):
        return (*read_numbers(raw[:3], where, (3,)), raw[3])
    return read_numbers(raw, where, (2, 3))


def _reference_pose(pose: Mapping[str, Any], links: tuple[str, ...]) -> dict[str, Pose2D]:
    for link in pose:
        _check_link(link, links, "reference_pose")
    return {link: Pose2D(*read_numbers(raw, f"reference_pose.{link}", (3,))) for link, raw in pose.items()}


def _points(points: Mapping[str, Any], links: tuple[str, ...]) -> dict[str, tuple[str, float, float]]:
    places = {}
    for name, raw in points.items():
        where = f"points.{name}"
        if not name.strip() or not name.isprintable():
            raise LinkageError("points: {name!r} cannot name a point", name=name)
        point = convert_document(raw, PointRecord, LinkageError, where)
        _check_link(point.link, links, where)
        x, y = read_numbers(point.at, f"{where}.at", (2,))
        places[name] = (point.link, x, y)
    return places


def _outlines(
    records: Sequence[OutlineRecord], links: tuple[str, ...], poses: Mapping[str, Pose2D]
) -> dict[str, list[Outline]]:
    """Outlines by link; those of a drawing in the coordinates of their links."""
    by_link: dict[str, list[Outline]] = {}
    for number, record in enumerate(records):
        where = f"outlines[{number}]"
        _check_link(record.link, links, where)
        corners = record.through if record.at is None else [record.at, *record.through]
        places = tuple((x, y) for x, y in (read_numbers(raw, where, (2,)) for raw in corners))
        outline = Outline(places, record.radius).checked(where)
        pose = poses.get(record.link)
        by_link.setdefault(record.link, []).append(outline if pose is None else outline.seen_from(pose))
    return by_link


def _check_link(link: str, links: tuple[str, ...], where: str) -> None:
    if link not in links:
        known = ", ".join(links[:12]) + (", ..." if len(links) > 12 else "")
        raise LinkageError(
            "{where}: there is no link {word!r}{suggestion}; links are {known}",
            where=where,
            **unknown(link, links) | {"known": known},
        )
