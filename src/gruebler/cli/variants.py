"""`gruebler variants`: every typed chain or mechanism that answers a set of requirements."""

from __future__ import annotations

import argparse
import json
import sys

from gruebler.chain import Chain
from gruebler.cli.inputs import assortment_of
from gruebler.cli.inversions import item
from gruebler.cli.long_work import ask_before, progress
from gruebler.cli.output import print_json
from gruebler.errors import GrueblerError
from gruebler.isomorphism import code
from gruebler.mechanism.inversion import DrivenMechanism
from gruebler.type_synthesis import JointRequirement, Requirements, expected_seconds_of_variants, variants

__all__ = ["run"]

_PROGRESS = {"en": "{n} found, {seconds:.0f} s", "de": "{n} gefunden, {seconds:.0f} s"}
_FOUND = {"en": "{n} found.", "de": "{n} gefunden."}


def run(arguments: argparse.Namespace) -> int:
    """List or count the variants."""
    wanted = Requirements(
        links=arguments.links,
        mobility=arguments.mobility,
        prismatic=arguments.prismatic,
        rolling=arguments.rolling,
        roll_slide=arguments.roll_slide,
        assortment=assortment_of(arguments.assortment),
        multiple_joints=arguments.multiple_joints,
        drives=tuple(JointRequirement.parse(text) for text in arguments.drive),
        at_frame=tuple(_at_frame(text) for text in arguments.at_frame),
        frame_joints=arguments.frame_joints,
        output=None if arguments.output is None else JointRequirement.parse(arguments.output),
        output_at_drive={"yes": True, "no": False, None: None}[arguments.output_at_drive],
    )
    seconds = expected_seconds_of_variants(wanted, mechanisms=wanted.about_mechanisms, drives=wanted.about_drives)
    ask_before(seconds, arguments.yes)
    quiet = arguments.count or arguments.json or not sys.stdout.isatty()
    all_found = progress(variants(wanted), _PROGRESS[arguments.lang] if quiet else "")
    if arguments.count:
        number = sum(1 for _ in all_found)
        print(json.dumps({"count": number}) if arguments.json else number)
        return 0
    if arguments.json:
        items = [_item(one) for one in all_found]
        print_json({"count": len(items), "items": items})
        return 0
    number = 0
    for one in all_found:
        print(one)
        number += 1
    print(_FOUND[arguments.lang].format(n=number), file=sys.stderr)
    return 0


def _item(one: Chain | DrivenMechanism) -> dict[str, object]:
    return item(one) if isinstance(one, DrivenMechanism) else {"code": code(one), "text": str(one)}


def _at_frame(text: str) -> tuple[JointRequirement, int]:
    symbol, _, number = text.partition(":")
    if number and not number.isdecimal():
        raise GrueblerError("--at-frame {text_!r}: expected a pair, or a pair and a number such as P:2", text_=text)
    return JointRequirement.parse(f"{symbol}@frame"), int(number or 1)
