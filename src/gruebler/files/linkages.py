"""Linkages in files and as plain data: TOML and JSON, read and written without losing a bit.

Lengths are in the unit that the file names, angles in degrees; docs/theory/linkage-files.md has every key.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gruebler.base.atomic_files import write_whole
from gruebler.base.documents import convert_document, load_document
from gruebler.base.errors import LinkageError, naming
from gruebler.files.element_records import write_element
from gruebler.files.linkage_records import Dimensions, linkage_from_record
from gruebler.files.load_records import LoadsRecord
from gruebler.mechanics.linkages.conversion import LinkageLike, as_linkage
from gruebler.mechanics.linkages.elements import Line, Outline
from gruebler.mechanics.linkages.model import Linkage
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism

if TYPE_CHECKING:
    from gruebler.mechanics.forces.loads import Loads

_LONGEST = 50_000  # characters of the joints; a linkage of a thousand links fits


class LinkageRecord(Dimensions, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A file: the mechanism and its sizes."""

    joints: str | None = None
    links: tuple[str, ...] | None = None
    frame: str | None = None
    drives: tuple[str, ...] | None = None
    outputs: tuple[str, ...] | None = None
    loads: LoadsRecord | None = None
    page: dict[str, Any] | None = None
    """What the page of `gruebler explore` shows beside the linkage; nothing else reads it."""


def read_linkage(path: Path | str) -> Linkage:
    """The linkage in a ``.toml`` or ``.json`` file.

    Raises `LinkageError` with file and key of the first thing that does not fit, and the nearest key that would.
    """
    path = Path(path)
    data = linkage_document(path)
    if isinstance(data, Mapping) and "screws" in data:
        raise LinkageError(
            "{path}: has the screws of its joints in one position, not the dimensions of its links: `gruebler check "
            "{path} --explain` shows how it moves",
            path=path,
        )
    refuse_entry(data, path)
    with naming(path, LinkageError):
        return linkage_from_json(data)


def linkage_document(path: Path) -> Any:
    """The plain data in the file of a linkage; `LinkageError` for another file and for one that cannot be read."""
    if path.suffix.lower() not in (".toml", ".json"):
        raise LinkageError("{path}: a linkage is in a .toml or .json file", path=path)
    return load_document(path, lambda problem: LinkageError("{path}: {problem}", path=path, problem=problem))


def refuse_entry(data: object, path: Path) -> None:
    """`LinkageError` for the document of a catalog entry, which a linkage file resembles."""
    if isinstance(data, Mapping) and {"id", "name", "joints"} <= data.keys():
        raise LinkageError(
            "{path}: is a catalog entry; a linkage file has its joints, frame and drives, and beside them the keys of "
            "its table [dimensions]",
            path=path,
        )


def read_loads(path: Path | str) -> Loads:
    """The loads in the file of a linkage; none if it has no table ``[loads]``.

    Raises `LinkageError` with file and key of the first thing that does not fit.
    """
    return read_loaded(path)[1]


def read_loaded(path: Path | str) -> tuple[Linkage, Loads, float | None]:
    """The linkage in a file, its loads, and the speed at which its drive usually runs, as for `read_loads`."""
    from gruebler.files.load_reading import loads_of_document

    linkage, path = read_linkage(path), Path(path)
    data = linkage_document(path)
    with naming(path, LinkageError):
        return linkage, *loads_of_document(data, linkage)


def linkage_from_json(document: Mapping[str, Any]) -> Linkage:
    """The linkage of plain data, such as `linkage_to_json` makes.

    >>> linkage_from_json({"unit": "mm", "four_bar": {"a": 25, "b": 70, "c": 40, "d": 70}})
    <linkage R(frame-crank) R(crank-coupler) R(coupler-rocker) R(frame-rocker); frame=frame; drive=R(frame-crank);
    crank (0, 0) (25, 0); frame (0, 0) (70, 0); coupler (0, 0) (70, 0); rocker (40, 0) (0, 0); mm>
    """
    record = convert_document(document, LinkageRecord, LinkageError)
    mechanism = _mechanism(record)
    linkage = linkage_from_record(record, mechanism, record.outputs)
    if record.joints is None and record.drives is not None:
        linkage = linkage.with_mechanism(_driven(linkage.mechanism.chain, linkage.mechanism.frame, record.drives))
    return linkage


def _mechanism(record: LinkageRecord) -> Mechanism | None:
    if record.joints is None:
        for key in ("links", "frame"):
            if getattr(record, key) is not None:
                raise LinkageError("{key}: goes with joints, which are missing", key=key)
        return None
    if len(record.joints) > _LONGEST:
        raise LinkageError(
            "joints: {count:,} characters are more than {longest:,}", count=len(record.joints), longest=_LONGEST
        )
    with naming("joints", LinkageError):
        chain = Chain.parse(record.joints)
    if record.links is not None:
        with naming("links", LinkageError):
            chain = Chain(chain.joints, links=record.links, space=chain.space)
    frame = chain.links[0] if record.frame is None else record.frame
    with naming("frame", LinkageError):
        chain.index(frame)
    return _driven(chain, frame, record.drives or ())


def _driven(chain: Chain, frame: str, drives: tuple[str, ...]) -> Mechanism:
    with naming("drives", LinkageError):
        return Mechanism(chain, frame, drives)


def linkage_to_json(linkage: Linkage, loads: Loads | None = None, speed: float | None = None) -> dict[str, Any]:
    """Plain data for `json.dumps`; `linkage_from_json` takes it back exactly, `read_loaded` loads and speed."""
    mechanism = linkage.mechanism
    chain, names = mechanism.chain, mechanism.chain.joint_names()
    document: dict[str, Any] = {"unit": linkage.unit, "joints": chain.text()}
    if Chain.parse(chain.text()).links != chain.links:
        document["links"] = list(chain.links)
    document |= {
        "frame": mechanism.frame,
        "drives": list(mechanism.drive_names()),
        "outputs": list(linkage.outputs),
        "points": {
            name: {"link": point.link, "at": [point.x + 0.0, point.y + 0.0]} for name, point in linkage.points.items()
        },
        "elements": {
            link: {names[n]: write_element(e) for (n, owner), e in sorted(linkage.elements.items()) if owner == link}
            for link in chain.links
        },
    }
    if linkage.outlines:
        document["outlines"] = [
            {"link": link} | _outline(outline) for link, outlines in linkage.outlines.items() for outline in outlines
        ]
    if linkage.reference_pose is not None:
        document["reference_pose"] = {
            link: write_element(Line(place.x, place.y, place.angle)) for link, place in linkage.reference_pose.items()
        }
    if loads is not None:
        from gruebler.files.load_writing import loads_to_json

        document["loads"] = loads_to_json(loads, linkage, speed)
    return document


def _outline(outline: Outline) -> dict[str, Any]:
    places = [[x + 0.0, y + 0.0] for x, y in outline.places]
    return {"at": places[0], "radius": outline.radius} if outline.radius else {"through": places}


def linkage_to_toml(linkage: Linkage, loads: Loads | None = None, speed: float | None = None) -> str:
    """The text of a TOML file; `read_linkage` takes it back exactly, `read_loaded` with loads and speed.

    >>> from gruebler.mechanics.fourbar import FourBar
    >>> print(linkage_to_toml(FourBar(a=25, b=70, c=40, d=70).linkage()).partition("[elements.frame]")[2])
    <BLANKLINE>
    "R(frame-crank)" = [0.0, 0.0]
    "R(frame-rocker)" = [70.0, 0.0]
    <BLANKLINE>
    [elements.crank]
    "R(frame-crank)" = [0.0, 0.0]
    "R(crank-coupler)" = [25.0, 0.0]
    <BLANKLINE>
    [elements.coupler]
    "R(crank-coupler)" = [0.0, 0.0]
    "R(coupler-rocker)" = [70.0, 0.0]
    <BLANKLINE>
    [elements.rocker]
    "R(coupler-rocker)" = [40.0, 0.0]
    "R(frame-rocker)" = [0.0, 0.0]
    <BLANKLINE>
    """
    document = linkage_to_json(linkage, loads, speed)
    acting = document.pop("loads", {})
    inner = {f"loads.{key}": acting.pop(key) for key in tuple(acting) if isinstance(acting[key], dict)}
    tables = {
        "points": document.pop("points"),
        **{f"elements.{toml_key(link)}": elements for link, elements in document.pop("elements").items()},
        "reference_pose": document.pop("reference_pose", {}),
        "loads": acting,
        **inner,
    }
    lines = [f"{key} = {toml_value(value)}" for key, value in document.items()]
    for name, table in tables.items():
        if table:
            lines += ["", f"[{name}]", *(f"{toml_key(key)} = {toml_value(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def toml_key(key: str) -> str:
    """A key as TOML writes it."""
    bare = key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return key if bare else toml_value(key)


def toml_value(value: Any) -> str:
    """A value in one line, as TOML writes it."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{toml_key(key)} = {toml_value(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def check_linkage_path(path: Path) -> None:
    """`LinkageError` if no linkage can be written there: to be asked before a long search."""
    if path.suffix.lower() not in (".toml", ".json"):
        raise LinkageError("{path}: end the name with .toml or .json", path=path)
    if not path.parent.is_dir():
        raise LinkageError("{path}: there is no folder {parent!r}", path=path, parent=str(path.parent))


def write_linkage(
    path: Path | str, linkage: LinkageLike, loads: Loads | None = None, speed: float | None = None
) -> None:
    """Write a ``.toml`` or ``.json`` file, with loads and usual speed if given; it appears whole or not at all."""
    path = Path(path)
    check_linkage_path(path)
    linkage = as_linkage(linkage)
    if path.suffix.lower() == ".toml":
        text = linkage_to_toml(linkage, loads, speed)
    else:
        text = json.dumps(linkage_to_json(linkage, loads, speed), ensure_ascii=False, indent=2) + "\n"
    write_whole(path, text)
