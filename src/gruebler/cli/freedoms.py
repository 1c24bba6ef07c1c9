"""`gruebler freedoms`: mobility with dimensions."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from gruebler.catalog import entries
from gruebler.cli.linkage_inputs import linkage_of
from gruebler.cli.output import print_json
from gruebler.cli.tables import print_text
from gruebler.errors import GrueblerError
from gruebler.formats import read_entry
from gruebler.linkages import Linkage
from gruebler.screws import SpatialLinkage, freedoms

__all__ = ["run"]


def run(arguments: argparse.Namespace) -> int:
    """Print the report; 1 if nothing moves."""
    linkage = _linkage(arguments.linkage)
    found = freedoms(linkage, at=_pose(linkage, arguments.at), branch=arguments.branch, tolerance=arguments.tolerance)
    if arguments.json:
        print_json({"linkage": arguments.linkage, **found.to_json()})
    else:
        print_text(found.explain(arguments.lang))
    return int(found.mobility == 0)


def _linkage(word: str) -> Linkage | SpatialLinkage:
    path = Path(word)
    if word in entries() and not path.is_file():
        record = entries()[word]
    elif path.suffix.lower() in (".toml", ".json") and path.is_file():
        from gruebler.documents import load_document
        from gruebler.formats.screws import read_any_linkage

        document = load_document(path, lambda text: GrueblerError("{path}: {text_}", path=path, text_=text))
        if not (isinstance(document, dict) and "id" in document):
            return read_any_linkage(path)
        record = read_entry(path)
    else:
        return linkage_of(word)[0]
    made = record.placed()
    if made is None and record.dimensions is not None:
        raise GrueblerError(
            "the belts, cams and non-circular wheels of {word!r} have no place in this report; its joints "
            "may be given by screws ([screws] in its file), and gruebler check counts it",
            word=word,
        )
    if made is None:
        placed = [entry.id for entry in entries().values() if entry.dimensions is not None or entry.screws is not None]
        raise GrueblerError(
            "the catalog entry {word!r} has no dimensions; these have: {placed}", word=word, placed=", ".join(placed)
        )
    return made


def _pose(linkage: Linkage | SpatialLinkage, at: list[float] | None) -> list[float] | None:
    """The drive values in radians where they are angles."""
    if at is None:
        return None
    turns = [drive.turning for drive in linkage.mechanism.drives]
    turns += [False] * (len(at) - len(turns))
    return [math.radians(value) if angle else value for value, angle in zip(at, turns, strict=False)]
