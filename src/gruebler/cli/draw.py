"""`gruebler draw`: the structure picture of a chain or mechanism, its graph, contracted graph or loops."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

from gruebler.catalog import Entry, entries
from gruebler.chain import Chain
from gruebler.cli.inputs import chain_of, is_text, mechanism_of
from gruebler.drawing import Figure, draw, draw_contracted, draw_graph, draw_loops
from gruebler.drawing.files import picture_bytes, suffix_of
from gruebler.enumeration.checkpoint import whole_file
from gruebler.mechanism import Mechanism

__all__ = ["german", "run", "subject", "written"]

_VIEWS: dict[str, Callable[..., Figure]] = {
    "graph": draw_graph,
    "contracted": draw_contracted,
    "loops": draw_loops,
}


def run(arguments: argparse.Namespace) -> int:
    """Draw one chain or mechanism into a file, or as SVG on standard output."""
    suffix = "svg" if arguments.output is None else suffix_of(arguments.output)
    thing = subject(arguments.chain, arguments.space, arguments.frame, arguments.drive)
    record = None if is_text(arguments.chain) else entries().get(arguments.chain)
    name = "" if record is None else record.name.said(arguments.lang)
    view = next((_VIEWS[key] for key in _VIEWS if getattr(arguments, key)), None)
    if view is None:
        figure = draw(
            thing, labels=arguments.labels, lang=arguments.lang, name=name, names=german(record, arguments.lang)
        )
    else:
        figure = view(thing, lang=arguments.lang, name=name)
    if arguments.output is None:
        sys.stdout.write(figure.svg())
    else:
        written(arguments.output, picture_bytes(figure, suffix))
    return 0


def german(record: Entry | None, lang: str) -> Mapping[str, str]:
    """What a catalog entry calls its links in this language."""
    return record.links if record is not None and lang == "de" else {}


def subject(word: str, space: str | None, frame: str | None, drives: list[str]) -> Chain | Mechanism:
    """What a word stands for: a mechanism if it, or an option, says which link stands still, else a chain."""
    record = None if is_text(word) else entries().get(word)
    marked = ";" in word if record is None else record.frame is not None
    if marked and space is None:
        return mechanism_of(word, frame, drives)
    chain = chain_of(word, space)
    if frame is None and not drives:
        return chain
    return Mechanism(chain, chain.links[0] if frame is None else frame, drives)


def written(path: Path, content: bytes) -> None:
    """Write a file whole or not at all; `RunError` if it cannot be written."""
    with whole_file(path, durable=False) as file:
        file.write(content)
