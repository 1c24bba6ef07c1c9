"""Linkages given by the screws of their joints, in files and as plain data.

Angles are in degrees, the advance of a screw for a whole turn; docs/theory/freedoms.md has every key.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, Literal

import msgspec

from gruebler.base.atomic_files import write_whole
from gruebler.base.documents import convert_document, infinities_as_words
from gruebler.base.errors import LinkageError, naming
from gruebler.base.text import message
from gruebler.files.linkage_records import PointRecord
from gruebler.files.linkages import (
    check_linkage_path,
    linkage_document,
    linkage_from_json,
    refuse_entry,
    toml_key,
    toml_value,
)
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import JointPlace, SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism


class JointRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A joint in the reference pose."""

    at: list[float] | None = None
    x: list[float] | None = None
    y: list[float] | None = None
    z: list[float] | None = None
    lead: float | None = None
    """Of a screw, the way along z for a whole turn."""
    radii: list[float | Literal["inf", "-inf"]] | None = None
    """A flat contour has ``inf``, in JSON the text ``"inf"``."""
    pressure: float | None = None


class ScrewsRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The joints of a mechanism in one position."""

    unit: str
    joints: dict[str, Any]
    points: dict[str, Any] = {}
    """Named points of links, their coordinates in that position."""
    round_bodies: dict[str, Any] = {}
    """Cylinders on links, for pictures."""


class TurnedBodyRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A cylinder on a link: its middle, its axis, its size."""

    link: str
    at: tuple[float, float, float]
    z: tuple[float, float, float]
    radius: float
    length: float


class SpatialRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A file: the mechanism and the screws of its joints."""

    joints: str
    screws: ScrewsRecord
    space: str | None = None
    links: tuple[str, ...] | None = None
    frame: str | None = None
    drives: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()


def spatial_linkage_from_record(
    screws: ScrewsRecord, mechanism: Mechanism, outputs: Sequence[str] = ()
) -> SpatialLinkage:
    """The linkage of a mechanism with these screws; `LinkageError` names the first key that does not fit."""
    spherical = mechanism.chain.space is Space.SPHERICAL
    places: dict[str | int, object] = {}
    for name, raw in screws.joints.items():
        record = convert_document(raw, JointRecord, LinkageError, f"screws.joints.{name}")
        given = {key: value for key, value in msgspec.structs.asdict(record).items() if value is not None}
        if "lead" in given:
            given["pitch"] = given.pop("lead") / (2 * math.pi)
        if "radii" in given:
            given["radii"] = [float(radius) for radius in given["radii"]]
        if "pressure" in given:
            given["pressure"] = math.radians(given["pressure"])
        if spherical and "radii" in given:
            given["radii"] = [math.radians(r) for r in given["radii"]]
        places[name] = given
    points = {}
    for name, raw in screws.points.items():
        point = convert_document(raw, PointRecord, LinkageError, f"screws.points.{name}")
        points[name] = (point.link, *point.at)
    bodies = {
        name: msgspec.structs.asdict(
            convert_document(raw, TurnedBodyRecord, LinkageError, f"screws.round_bodies.{name}")
        )
        for name, raw in screws.round_bodies.items()
    }
    return SpatialLinkage(mechanism, places, unit=screws.unit, points=points, outputs=outputs, round_bodies=bodies)


def spatial_from_json(document: Mapping[str, Any]) -> SpatialLinkage:
    """The linkage of plain data, such as `screws_to_json` makes.

    >>> z = [0, 0, 1]
    >>> spatial_from_json({"joints": "spatial: R(0-1) H(1-2) P(0-2)", "screws": {"unit": "mm", "joints": {
    ...     "R(0-1)": {"z": z}, "H(1-2)": {"z": z, "lead": 5}, "P(0-2)": {"x": z, "at": [0, 50, 0]}}}})
    <spatial linkage spatial: R(0-1) H(1-2) P(0-2); frame=0; (0, 0, 0) (0, 0, 0) (0, 50, 0)>
    """
    record = convert_document(document, SpatialRecord, LinkageError)
    with naming(message("joints, links, frame or drives"), LinkageError):
        chain = Chain.parse(record.joints, space=record.space)
        if record.links is not None:
            chain = Chain(chain.joints, links=record.links, space=chain.space)
        mechanism = Mechanism(chain, chain.links[0] if record.frame is None else record.frame, record.drives)
    return spatial_linkage_from_record(record.screws, mechanism, record.outputs)


def screws_to_json(linkage: SpatialLinkage) -> dict[str, Any]:
    """Plain data for `json.dumps`; `spatial_from_json` takes it back, angles to rounding."""
    mechanism, chain = linkage.mechanism, linkage.mechanism.chain
    names = chain.joint_names()
    angles = chain.space is Space.SPHERICAL
    written = Chain.parse(chain.text(), space=str(chain.space))
    links = {} if written.links == chain.links else {"links": list(chain.links)}
    return {
        "joints": chain.text(),
        **links,
        "space": str(chain.space),
        "frame": mechanism.frame,
        "drives": list(mechanism.drive_names()),
        "outputs": list(linkage.outputs),
        "screws": {
            "unit": linkage.unit,
            "joints": {name: _plain(place, angles) for name, place in zip(names, linkage.places, strict=True)},
            "points": {name: {"link": link, "at": list(at)} for name, (link, at) in linkage.points.items()},
            **({"round_bodies": bodies} if (bodies := _bodies(linkage)) else {}),
        },
    }


def write_screws(path: Path, linkage: SpatialLinkage) -> None:
    """Write a linkage into a ``.toml`` or ``.json`` file, complete or not at all; `read_any_linkage` takes it back."""
    check_linkage_path(path)
    document = screws_to_json(linkage)
    if path.suffix.lower() == ".json":
        text = json.dumps(document, ensure_ascii=False, indent=1) + "\n"
    else:
        screws = document.pop("screws")
        lines = [f"{key} = {toml_value(value)}" for key, value in document.items()]
        lines += ["", "[screws]", f"unit = {toml_value(screws['unit'])}"]
        for name in [key for key in screws if key != "unit"]:
            lines += ["", f"[screws.{name}]"]
            lines += [f"{toml_key(key)} = {toml_value(value)}" for key, value in screws[name].items()]
        text = "\n".join(lines) + "\n"
    write_whole(path, text)


def _bodies(linkage: SpatialLinkage) -> dict[str, dict[str, Any]]:
    return {
        name: asdict(body) | {"at": list(body.at), "z": list(body.z)} for name, body in linkage.round_bodies.items()
    }


def _plain(place: JointPlace, angles: bool) -> dict[str, Any]:
    table: dict[str, Any] = {"at": list(place.at)}
    table |= {axis: list(v) for axis in "xyz" if (v := getattr(place, axis)) is not None}
    if place.pitch:
        table["lead"] = place.pitch * 2 * math.pi
    if place.radii is not None:
        table["radii"] = infinities_as_words([math.degrees(r) if angles else r for r in place.radii])
    if place.pressure is not None:
        table["pressure"] = math.degrees(place.pressure)
    return table


def read_any_linkage(path: Path | str) -> Linkage | SpatialLinkage:
    """The linkage in a ``.toml`` or ``.json`` file, with sizes of its links or with the screws of its joints.

    Raises `LinkageError` with file and key of the first thing that does not fit.
    """
    path = Path(path)
    data = linkage_document(path)
    refuse_entry(data, path)
    with naming(path, LinkageError):
        return any_linkage_from_json(data)


def any_linkage_from_json(document: Mapping[str, Any]) -> Linkage | SpatialLinkage:
    """The linkage of plain data, with sizes of its links or with the screws of its joints."""
    if isinstance(document, Mapping) and "screws" in document:
        return spatial_from_json(document)
    return linkage_from_json(document)
