"""Links by their names in the reader's language: those of catalog entries and of linkages given by lengths.

What a person reads has German names with ``--lang de``; JSON, .json and .toml are for programs and keep the names of
the catalog. Options that name links, joints or points may be written with the names of any language.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterable, Mapping
from typing import Any

from gruebler.base.text import LANGUAGES
from gruebler.cli.parser import Parser
from gruebler.structure.chain.notation import renamed_links

_ON_THE_COUPLER = re.compile(r"[-+.\deE]+,[-+.\deE]+")
_FOR_PROGRAMS = (".json", ".toml")


def language_of_names(arguments: argparse.Namespace) -> str:
    """The language of the links in what a command gives: English in JSON and in files that programs read."""
    path = getattr(arguments, "out", None)
    for_programs = getattr(arguments, "json", False) or (path is not None and path.suffix.lower() in _FOR_PROGRAMS)
    return LANGUAGES[0] if for_programs else str(arguments.lang)


def spell_links_alike(parser: Parser, arguments: argparse.Namespace) -> None:
    """Give options that name links, joints or points the names that the command's linkage has in its language."""
    naming = parser.names_of_links or []
    if not any(getattr(arguments, dest, None) for dest in naming):
        return
    words = [getattr(arguments, action.dest, None) for action in parser._get_positional_actions()]
    names = _names(words, language_of_names(arguments))
    if names:
        for dest in naming:
            setattr(arguments, dest, _spelled(getattr(arguments, dest, None), names))


def _names(words: Iterable[Any], lang: str) -> dict[str, str]:
    """For each link of the catalog entries and lengths among the words, the name of each language: that in this one."""
    from gruebler.cli.linkage_inputs import linkage_of_lengths
    from gruebler.mechanics.fourbar.length_texts import size_of
    from gruebler.teaching.catalog import entries

    names: dict[str, str] = {}
    for word in (each for value in words for each in (value if isinstance(value, list) else [value])):
        if not isinstance(word, str):
            continue
        if word in entries():
            spoken = {each: entries()[word].in_language(each) for each in LANGUAGES}
            known = {each: [*record.links, *record.points] for each, record in spoken.items()}
        elif (size := size_of(word)) is not None:
            known = {each: list(linkage_of_lengths(size, each).mechanism.chain.links) for each in LANGUAGES}
        else:
            continue
        for spelled in known.values():
            names |= dict(zip(spelled, known[lang], strict=True))
    return names


def _spelled(value: Any, names: Mapping[str, str]) -> Any:
    if isinstance(value, list):
        return [_spelled(each, names) for each in value]
    if not isinstance(value, str):
        return value
    name, sign, numbers = value.partition("=")
    if _ON_THE_COUPLER.fullmatch(name) and "coupler" in names:
        name = f"coupler:{name}"
    return f"{renamed_links(name, names)}{sign}{numbers}"
