"""`gruebler inversions`: the mechanisms that a chain gives with another frame, or with another frame and drive."""

from __future__ import annotations

import argparse

from gruebler.cli.inputs import chain_of
from gruebler.cli.output import print_json
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.inversion import Driven, driven_mechanisms, family, inversions
from gruebler.mechanism import Mechanism

__all__ = ["item", "run"]

_HEADERS = {"en": ("frame", "drive", "output", "family"), "de": ("Gestell", "Antrieb", "Abtrieb", "Familie")}


def run(arguments: argparse.Namespace) -> int:
    """List or count the inversions of one chain."""
    chain = chain_of(arguments.chain, arguments.space)
    if not arguments.drives:
        for option, given in (
            ("--output", arguments.output),
            ("--anywhere", arguments.anywhere),
            ("--number", arguments.number != 1),
        ):
            if given:
                raise GrueblerError(f"{option} goes with --drives: it is said of a driven mechanism")
    if arguments.drives:
        found = list(
            driven_mechanisms(chain, drives=arguments.number, at_frame=not arguments.anywhere, output=arguments.output)
        )
    else:
        found = [Driven(mechanism) for mechanism in inversions(chain)]
    if arguments.json:
        document: dict[str, object] = {"count": len(found)}
        if not arguments.count:
            document["items"] = [item(driven) for driven in found]
        print_json(document)
    elif arguments.count:
        print(len(found))
    else:
        print_table(_HEADERS[arguments.lang], [_row(driven, arguments.lang) for driven in found])
    return 0


def item(driven: Driven) -> dict[str, object]:
    """One item of a JSON list: code (None where codes have no place for a drive), text, family if it has one."""
    mechanism = driven.mechanism
    out: dict[str, object] = {"code": _code(mechanism), "text": str(mechanism)}
    if (name := family(mechanism)) is not None:
        out["family"] = name
    if driven.output is not None:
        out["output"] = driven.output
    return out


def _code(mechanism: Mechanism) -> str | None:
    try:
        return mechanism.code()
    except GrueblerError:
        return None


def _row(driven: Driven, lang: str) -> tuple[str, str, str, str]:
    mechanism = driven.mechanism
    drives = ", ".join(mechanism.drive_names())
    return mechanism.frame, drives, driven.output or "", family(mechanism, lang) or ""
