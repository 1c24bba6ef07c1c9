"""`gruebler derive`: how a chain grows from a closed loop by dyads, or why it does not."""

from __future__ import annotations

import argparse

from gruebler.cli.inputs import chain_from_word
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_text
from gruebler.isomorphism import code
from gruebler.transformations import derive

__all__ = ["add", "run"]


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="The dyads in order, or the core that is left when no dyad can be taken away.",
    )
    parser.add_argument("chain", metavar="CHAIN", help="a text, a code, g6:CODE or the id of a catalog entry")
    parser.add_argument("--json", action="store_true", help="an object with core, count, items and the derivation")


def run(arguments: argparse.Namespace) -> int:
    """Tell how the chain grows."""
    growth = derive(chain_from_word(arguments.chain))
    if not arguments.json:
        print_text(growth.explain(arguments.lang))
        return 0
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
    return 0
