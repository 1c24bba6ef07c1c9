"""Files that the page opens and saves: all that `files.read` and `files.write` know of a linkage."""

from __future__ import annotations

import base64
import binascii
import json
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gruebler.base.atomic_files import temporary_directory, write_whole
from gruebler.base.documents import load_document
from gruebler.base.errors import GrueblerError
from gruebler.base.text import Message, error_in_language, joined, message, translate
from gruebler.files.documents import KINDS, LINKAGES, LOADS
from gruebler.files.formats import FORMATS, Format, loads_document
from gruebler.files.linkage_records import WAYS
from gruebler.files.linkages import LinkageRecord, toml_key, toml_value
from gruebler.files.load_reading import loads_of_document
from gruebler.files.values import format_of, read, write, write_loaded
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage

_OWN = ("toml", "json")
_NO_LINKAGES = frozenset({"csv", "spreadsheet", "parquet", "dxf-links", "glb", "stl"})
"""Formats of tables and folders; the page writes its table by itself."""
_IN_SPACE = frozenset({*_OWN, "urdf", "glb"})
"""Formats of one file that hold a linkage in space."""
_EMPTY = message("The file {name} is empty.")
_DAMAGED = message("The file {name} cannot be read as {form}; it is damaged or something else.")
_DAMAGED_AT = message("The file {name} cannot be read as {form} from line {line} on; it is damaged or something else.")
_SIZELESS = message("The file {name} has links and joints, but no sizes.")
_JOINTLESS = message("The file {name} has sizes, but no joints.")
_FOREIGN = message("The file {name} holds no linkage, nor a chain or points of a path.")
_NEWER = message('This version of gruebler does not know "{keys}" in the file {name}; a newer one may have written it.')
_WRONG = message("The file {name} cannot be opened: {problem}.")
_WRONG_THERE = message("In the file {name}, {where} is wrong: {problem}.")
_UNKNOWN = message("{path}: expected {usual} or one of {count} other endings, not {suffix!r}")
_USUAL = (".json", ".toml", ".csv", ".txt", ".linkage2")
_WITH_BUTTONS = frozenset({*_OWN, "dxf", "mjcf", "urdf"})


def saved_kinds(lang: str) -> list[dict[str, str]]:
    """The formats of other programs that hold a linkage, those of its chain last, with what they are called."""
    return [
        {"name": form.name, "title": f"{form.title.in_language(lang)} ({_ending(form)})"}
        for form in sorted(FORMATS, key=lambda form: form.lengths is None)
        if form.name not in _NO_LINKAGES | _WITH_BUTTONS
    ]


def _ending(form: Format) -> str:
    return form.suffixes[0] if form.suffixes else ".json"


def opened_file(name: str, content: str, lang: str) -> dict[str, Any]:
    """What a file in base64 holds, for the view that shows it: ``model``, the ``text`` of a chain, or ``points``.

    Raises `GrueblerError` that names the file for what cannot be read or shown.
    """
    from gruebler.design.synthesis import PathTask
    from gruebler.page.model import model_of, with_document
    from gruebler.structure.chain import Chain

    try:
        data = base64.b64decode(content, validate=True)
    except binascii.Error:
        raise GrueblerError("{path}: expected base64", path=name) from None
    notes: list[Message] = []
    with temporary_directory() as folder:
        file = folder / (re.sub(r'[\x00-\x1f/\\:*?"<>|]', "_", name).strip(". ") or "file")
        write_whole(file, data)
        try:
            value: Any = read(file, left_out=notes)
        except GrueblerError as error:
            text = error_in_language(error, lang).replace(f"{folder}{os.sep}", "")
            raise GrueblerError("{message}", message=_why_not(file, text)) from None
        document = document_of(file, value) if isinstance(value, Linkage) else {}
    chains = value if isinstance(value, list) else [value]
    shown: dict[str, Any]
    if isinstance(value, Linkage):
        shown = {"model": with_document(model_of(value, name=Path(name).stem), value, document)}
        notes = [note for note in notes if note != LOADS]
    elif chains and isinstance(chains[0], Chain):
        shown = {"text": chains[0].text()}
    elif isinstance(value, PathTask):
        places = [list(point) for point in value.points if point]
        order = value.order if len(places) == len(value) else ()
        shown = {"points": places, "closed": value.closed, "order": list(order)}
    else:
        raise GrueblerError("{path}: the page shows planar linkages, chains and points of a path", path=name)
    return shown | {"note": _note(notes, lang)}


def _why_not(file: Path, problem: str) -> Message:
    """Why a file cannot be opened, in one sentence for those who do not know how our documents are made."""
    said = {"name": file.name, "problem": problem.removeprefix(f"{file.name}: ")}
    form = file.suffix.lower().lstrip(".")
    if not file.read_bytes().strip():
        return _EMPTY.filled(**said)
    if not any(file.name.lower().endswith(each.suffixes) for each in FORMATS):
        read = [ending for each in FORMATS if each.read for ending in each.suffixes if not ending.endswith(".gz")]
        more = len({*read} - {*_USUAL})
        return _UNKNOWN.filled(path=file.name, usual=", ".join(_USUAL), count=more, suffix=file.suffix)
    if form not in _OWN:
        return message("{problem}", problem=problem)
    try:
        document = load_document(file, lambda problem: GrueblerError("{problem}", problem=problem))
    except GrueblerError:
        line = re.search(r"line (\d+)", problem)
        broken = _DAMAGED_AT.filled(line=line[1]) if line else _DAMAGED
        return broken.filled(form=form.upper(), **said)
    fault, (where, _, problem) = _fault(document), said["problem"].partition(": ")
    if fault is _WRONG and where.split(".")[0] in document:
        return _WRONG_THERE.filled(name=file.name, where=where, problem=problem)
    return fault.filled(keys=joined(_unknown(document)), **said)


def _unknown(document: Mapping[str, Any]) -> list[str]:
    """The keys that no document of a linkage has."""
    return [key for key in document if key not in LinkageRecord.__struct_fields__]


def _fault(document: Any) -> Message:
    """What is wrong with a document that was refused."""
    if not isinstance(document, dict) or KINDS.isdisjoint(document):
        return _FOREIGN
    sized = not {*WAYS}.isdisjoint(document)
    if LINKAGES.isdisjoint(document):
        return _JOINTLESS if sized else _WRONG
    if _unknown(document):
        return _NEWER
    return _WRONG if sized else _SIZELESS


def _with_page(data: bytes, form: str, page: dict[str, Any]) -> bytes:
    if form == "json":
        return json.dumps(json.loads(data) | {"page": page}, ensure_ascii=False, indent=2).encode()
    # a target a line: a line of TOML has a hundred points at most
    rows = [f"    {toml_value(row)},\n" for row in page.get("targets", [])]
    targets = f"targets = [\n{''.join(rows)}]\n" if rows else ""
    table = [f"{toml_key(key)} = {toml_value(value)}\n" for key, value in page.items() if key != "targets"]
    return data + f"\n[page]\n{targets}{''.join(table)}".encode()


def document_of(file: Path, linkage: Linkage) -> dict[str, Any]:
    """What stands in a file of ours; of those of other programs what acts on the linkage."""
    if file.suffix.lower().lstrip(".") not in _OWN:
        return loads_document(file, format_of(file, to_read=True), linkage)
    document = load_document(file, lambda problem: GrueblerError("{problem}", problem=problem))
    return document if isinstance(document, dict) else {}


def saved_file(linkage: Linkage | SpatialLinkage, kind: str, lang: str, document: Mapping[str, Any]) -> dict[str, str]:
    """A linkage in a format as base64, the ending of the file, and what was left out.

    Our own formats keep its loads and what the page shows beside it.
    """
    form = format_of("", kind)
    spatial = isinstance(linkage, SpatialLinkage)
    if form.name not in _IN_SPACE if spatial else form.name in _NO_LINKAGES:
        raise GrueblerError("the format {name} holds no linkage", name=form.name)
    notes: list[Message] = []
    with temporary_directory() as folder:
        file = folder / f"linkage{_ending(form)}"
        try:
            if isinstance(linkage, Linkage) and document.get("loads"):
                write_loaded(linkage, *loads_of_document(document, linkage), file, kind, notes)
            else:
                write(linkage, file, format_name=kind, left_out=notes)
        except GrueblerError as error:
            text = error_in_language(error, lang).replace(f"{folder}{os.sep}", "")
            raise GrueblerError("{message}", message=text) from None
        data = file.read_bytes()
        if document.get("page") and form.name in _OWN:
            data = _with_page(data, form.name, document["page"])
        content = base64.b64encode(data).decode("ascii")
    return {"base64": content, "type": "application/octet-stream", "ending": _ending(form), "note": _note(notes, lang)}


def _note(notes: list[Message], lang: str) -> str:
    return translate("Left out: {what}", lang, what=joined(notes, "; ")) if notes else ""
