"""`gruebler inversions`: the mechanisms that a chain gives with another frame, or with another frame and drive."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from gruebler.cli.inputs import chain_from_word
from gruebler.cli.output import print_json
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.mechanism.inversion import DrivenMechanism, driven_mechanisms, family, inversions

__all__ = ["item", "run"]

_HEADERS = {
    "en": {"frame": "frame", "drive": "drive", "output": "output", "family": "family"},
    "de": {"frame": "Gestell", "drive": "Antrieb", "output": "Abtrieb", "family": "Familie"},
}


def run(arguments: argparse.Namespace) -> int:
    """List or count the inversions of one chain."""
    chain = chain_from_word(arguments.chain, arguments.space)
    if not arguments.drives:
        for option, given in (
            ("--output", arguments.output),
            ("--anywhere", arguments.anywhere),
            ("--number", arguments.number != 1),
        ):
            if given:
                raise GrueblerError("{option} goes with --drives: it is said of a driven mechanism", option=option)
    if arguments.drives:
        drivens = list(
            driven_mechanisms(chain, drives=arguments.number, at_frame=not arguments.anywhere, output=arguments.output)
        )
    else:
        drivens = [DrivenMechanism(mechanism) for mechanism in inversions(chain)]
    if arguments.json:
        document: dict[str, object] = {"count": len(drivens)}
        if not arguments.count:
            document["items"] = [item(driven) for driven in drivens]
        print_json(document)
    elif arguments.count:
        print(len(drivens))
    elif arguments.text:
        for driven in drivens:
            print(driven)
    else:
        _print(drivens, arguments.lang)
    return 0


def item(driven: DrivenMechanism) -> dict[str, object]:
    """One item of a JSON list: code, text, and family and output if there are any."""
    mechanism = driven.mechanism
    out: dict[str, object] = {"code": mechanism.code(), "text": driven.text()}
    if (name := family(mechanism)) is not None:
        out["family"] = name
    if driven.output is not None:
        out["output"] = driven.output
    return out


def _row(driven: DrivenMechanism, lang: str) -> dict[str, str]:
    mechanism = driven.mechanism
    return {
        "frame": mechanism.frame,
        "drive": ", ".join(mechanism.drive_names()),
        "output": driven.output or "",
        "family": family(mechanism, lang) or "",
    }


def _print(found: Sequence[DrivenMechanism], lang: str) -> None:
    """The table, without a column that is empty in every row."""
    rows = [_row(driven, lang) for driven in found]
    keys = [key for key in _HEADERS[lang] if key == "frame" or any(row[key] for row in rows)]
    print_table([_HEADERS[lang][key] for key in keys], [[row[key] for key in keys] for row in rows])
