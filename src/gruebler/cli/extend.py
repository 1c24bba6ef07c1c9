"""`gruebler extend`: all different chains that one more dyad or coupler gives, and how a chain is built from dyads."""

from __future__ import annotations

import argparse
from typing import Any

from gruebler.base.text import message
from gruebler.cli.arguments import take
from gruebler.cli.inputs import chain_from_word
from gruebler.cli.link_names import language_of_names
from gruebler.cli.output import print_items, print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.isomorphism import code
from gruebler.structure.mobility import mobility_report
from gruebler.structure.transformations import Attachment, Extension, derive, extend

_HEADERS = (
    *(message("chain"), message("F counted"), message("generic"), message("places")),
    message("joints that cannot move"),
)


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Add a dyad or a coupler to a chain: every different structure once, with the places where it "
        "can be added. With --derivation: how the chain is built from a closed loop by adding dyads, or the core "
        "that remains when no dyad can be removed.",
        epilog="Examples: gruebler extend 'R(0-1) R(1-2) R(2-3) R(3-0)' --dyad; gruebler extend wiper --derivation.",
    )
    parser.take("chain")
    take(
        parser.add_mutually_exclusive_group(required=True),
        """
        --dyad FORM ? :RRR  RRR (default), RRP, RPR, PRP or RPP
        --coupler PAIRS ? :RR  a link with these two joints (default: RR)
        --derivation  show how the chain is built from dyads
        """,
    )
    parser.take(
        """
        --at-joints  also attach new links to existing joints
        --count
        """
    )
    parser.add_printed(help="print an object with count and items")


def run(arguments: argparse.Namespace) -> int:
    """List or count the extensions, or explain how the chain is built."""
    chain = chain_from_word(arguments.chain, lang=language_of_names(arguments))
    if arguments.derivation:
        _derive(chain, arguments)
        return 0
    extensions = extend(chain, dyad=arguments.dyad, coupler=arguments.coupler, at_joints=arguments.at_joints)
    lang = arguments.lang
    print_items(
        arguments,
        extensions,
        lambda extension: _item(chain, extension),
        lambda: print_table(_HEADERS, [_row(chain, each, lang) for each in extensions], numbers=(1, 2), lang=lang),
    )
    return 0


def _derive(chain: Chain, arguments: argparse.Namespace) -> None:
    growth = derive(chain)
    if not arguments.json:
        print_text(growth.explain(arguments.lang))
        return
    core, steps = growth.core, growth.derivation.steps
    document = {
        "from_loop": growth.from_loop,
        "exact": growth.exact,
        "core": {"code": code(core), "text": str(core), "links": list(core.links)},
        "count": len(steps),
        "items": [
            {"code": code(step.chain), "text": str(step.chain), "step": step.explain(arguments.lang)} for step in steps
        ],
        "derivation": growth.derivation.to_json(),
    }
    print_json(document)


def _item(chain: Chain, extension: Extension) -> dict[str, Any]:
    report = mobility_report(extension.chain)
    names = extension.chain.joint_names()
    return {
        "code": extension.code,
        "text": str(extension.chain),
        "counted": report.counted,
        "generic": report.generic,
        "immobile_joints": [names[k] for k in report.immobile_joints],
        "places": [_places(chain, pair) for pair in extension.places],
    }


def _row(chain: Chain, extension: Extension, lang: str) -> tuple[str, str, str, str, str]:
    report = mobility_report(extension.chain)
    alphabet = Alphabet.of_language(lang)
    names = extension.chain.joint_names(alphabet)
    return (
        extension.chain.text(alphabet),
        str(report.counted),
        str(report.generic),
        ", ".join("/".join(_places(chain, pair, alphabet)) for pair in extension.places),
        ", ".join(names[k] for k in report.immobile_joints),
    )


def _places(
    chain: Chain, pair: tuple[Attachment, Attachment], alphabet: Alphabet = Alphabet.INTERNATIONAL
) -> list[str]:
    names = chain.joint_names(alphabet)
    return [place if isinstance(place, str) else names[place] for place in pair]
