"""`gruebler animate`: a linkage that moves by itself, as SVG without any script."""

from __future__ import annotations

import argparse
import sys

from gruebler.cli.draw import entry_of, sized, written
from gruebler.drawing.animation import animated_svg
from gruebler.drawing.files import suffix_of

__all__ = ["run"]


def run(arguments: argparse.Namespace) -> int:
    """Write the animation into a file, or on standard output."""
    if arguments.output is not None:
        suffix_of(arguments.output, ("svg",))
    linkage, between = sized(arguments.linkage)
    record = entry_of(arguments.linkage)
    text = animated_svg(
        linkage,
        branch=arguments.branch,
        between=between,
        curves=arguments.curve,
        seconds=arguments.seconds,
        lang=arguments.lang,
        name="" if record is None else record.name.said(arguments.lang),
    )
    if arguments.output is None:
        sys.stdout.write(text)
    else:
        written(arguments.output, text.encode("utf-8"))
    return 0
