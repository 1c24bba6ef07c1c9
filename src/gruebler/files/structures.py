"""What texts, lines and files describe: chains, linkages with dimensions or joint screws, catalog entries."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gruebler.base.documents import load_document
from gruebler.base.errors import CatalogError, NotationError, naming
from gruebler.base.text import message, reason_of
from gruebler.files.catalog_records import Entry, entry_of_data, read_entry
from gruebler.files.linkages import linkage_from_json
from gruebler.files.screws import read_any_linkage, spatial_from_json
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import decode
from gruebler.structure.mechanism import Mechanism

STRUCTURE_ENDINGS = (".toml", ".json", ".txt", ".g6")
"""Endings of files with structures; a file without ending has one chain per line."""


@dataclass(frozen=True, slots=True)
class Structure:
    """A chain, linkage or entry, and where it stands."""

    name: str
    """What a table calls it."""
    place: str
    """Its file, with the line or the number in a list; empty for a word."""
    value: Chain | Linkage | SpatialLinkage | Entry


def is_code(text: str) -> bool:
    """Whether a text is a canonical code, with marks or without."""
    return re.match(r"\s*gr\d+:", text) is not None


def is_structure_text(text: str) -> bool:
    """Whether a text describes a chain itself, rather than naming an entry or a file."""
    return "(" in text or text.lstrip().lower().startswith("g6:") or is_code(text)


def chain_of_text(text: str, space: str | None = None) -> Chain:
    """The chain of a text, a code or a graph6 code; marks of frame, drives and output are left out.

    >>> chain_of_text("R(0-1) R(1-2) R(2-3) R(3-0); frame=1; output=2").n
    4
    """
    if is_code(text):
        return decode(text.strip()).chain
    if ";" in text:
        return Mechanism.parse(text).chain
    return Chain.parse(text, space=space)


def read_structures(path: Path, space: str | None = None) -> Iterator[Structure]:
    """The structures of a file: an entry or a linkage (.toml), a list of them (.json), or a chain per line.

    Raises:
        CatalogError: the file cannot be read, or its ending is not in `STRUCTURE_ENDINGS`.
        GrueblerError: a structure cannot be understood; the message names file and line or key.
    """
    ending = path.suffix.lower()
    if ending not in ("", *STRUCTURE_ENDINGS):
        raise CatalogError(
            "{path}: expected a file that ends with {endings}, not with {suffix}",
            path=path,
            endings=", ".join(STRUCTURE_ENDINGS),
            suffix=path.suffix,
        )
    if ending == ".toml":
        if _is_linkage(path):
            yield Structure(path.stem, str(path), read_any_linkage(path))
        else:
            yield Structure(path.stem, str(path), read_entry(path))
        return
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise CatalogError("{path}: cannot be read ({reason})", path=path, reason=reason_of(error)) from None
    except UnicodeDecodeError:
        raise CatalogError("{path}: is not UTF-8 text", path=path) from None
    if ending == ".json":
        yield from structures_of_json(text, str(path))
    elif ending == ".g6":
        yield from structures_of_lines("".join(f"g6:{line}\n" for line in text.split()), str(path))
    else:
        yield from structures_of_lines(text, str(path), space)


def _is_linkage(path: Path) -> bool:
    """Whether a TOML file holds a linkage rather than an entry: it has a unit or screws, but no id."""
    document = load_document(path, lambda text: CatalogError("{path}: {problem}", path=path, problem=text))
    return isinstance(document, dict) and "id" not in document and ("unit" in document or "screws" in document)


def structures_of_json(text: str, source: str) -> Iterator[Structure]:
    """The structures of a JSON object, of a list of objects, or of an object with such a list under ``items``."""
    if not text.strip():
        raise NotationError("{path}: is empty", path=source)
    try:
        document = json.loads(text)
    except RecursionError:
        raise NotationError("{path}: is nested too deeply", path=source) from None
    except ValueError as error:  # JSONDecodeError, or a number of thousands of digits
        raise NotationError("{path}: is not JSON: {error}", path=source, error=error) from None
    if isinstance(document, dict) and "items" in document:
        document = document["items"]
    if document == []:
        raise NotationError("{path}: no chain in it; expected an object or a list of objects", path=source)
    documents = document if isinstance(document, list) else [document]
    for number, each in enumerate(documents, 1):
        name = place = f"{source}[{number}]" if isinstance(document, list) else source
        if isinstance(each, dict) and isinstance(each.get("name"), str) and each["name"].strip():
            name = each["name"].strip()
            place += f" ({name})"
        if isinstance(each, dict) and "id" in each:
            yield Structure(name, place, entry_of_data(each, place))
            continue
        with naming(place, NotationError):
            structure = _structure_of_document(each)
        yield Structure(name, place, structure)


def _structure_of_document(document: Any) -> Chain | Linkage | SpatialLinkage:
    """A linkage with dimensions or screws, or the chain of an item of a list, of a report, or of its own object."""
    if isinstance(document, dict) and isinstance(document.get("text"), str):
        return chain_of_text(document["text"])
    if isinstance(document, dict) and "screws" in document:
        return spatial_from_json(document)
    if isinstance(document, dict) and "unit" in document:
        return linkage_from_json(document)
    return Chain.from_json(document)


def structures_of_lines(text: str, source: str, space: str | None = None) -> Iterator[Structure]:
    r"""The chains of lines; empty lines and lines that begin with # are skipped.

    >>> [found.place for found in structures_of_lines("# two\nR(0-1) R(1-2) R(2-0)\n\nR(0-1) P(1-2) P(2-0)", "a.txt")]
    ['a.txt, line 2', 'a.txt, line 4']
    """
    empty = True
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        empty = False
        with naming(message("{source}, line {number}", source=source, number=number), NotationError):
            chain = chain_of_text(line, space)
        yield Structure(line.strip(), f"{source}, line {number}", chain)
    if empty:
        raise NotationError("{source}: no chain in it; expected one per line", source=source)
