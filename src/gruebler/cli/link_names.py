"""Links by their names in the reader's language: those of catalog entries and of linkages given by lengths.

What a person reads has German names with ``--lang de``; JSON, .json and .toml are for programs and keep the names of
the catalog. Options that name links, joints or points may be written with either names.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterable, Mapping
from typing import Any

from gruebler.catalog import entries, entry
from gruebler.chain.notation import renamed_links
from gruebler.formats import Entry
from gruebler.linkages import Linkage
from gruebler.text import LANGUAGES, translate

__all__ = ["entry_in_language", "language_of_names", "linkage_in_language", "spell_links_alike"]

_NAMES_A_LINK = re.compile(r"\b(LINK|JOINT|POINT)\b")
_ON_THE_COUPLER = re.compile(r"[-+.\deE]+,[-+.\deE]+")
_FOR_PROGRAMS = (".json", ".toml")


def language_of_names(arguments: argparse.Namespace) -> str:
    """The language of the links in what a command gives: English in JSON and in files that programs read."""
    path = getattr(arguments, "out", None)
    for_programs = getattr(arguments, "json", False) or (path is not None and path.suffix.lower() in _FOR_PROGRAMS)
    return LANGUAGES[0] if for_programs else str(arguments.lang)


def entry_in_language(id: str, lang: str) -> Entry:
    """A catalog entry, its links by their names in a language; `CatalogError` for an unknown one."""
    return entry(id).in_language(lang)


def linkage_in_language(linkage: Linkage, lang: str) -> Linkage:
    """A linkage of lengths such as four-bar:25,70,40,70, its links by their names in a language."""
    return linkage.renamed(_names_of_lengths(linkage, lang))


def _names_of_lengths(linkage: Linkage, lang: str) -> dict[str, str]:
    return {link: translate(link, lang) for link in linkage.mechanism.chain.links}


def spell_links_alike(actions: Iterable[argparse.Action], arguments: argparse.Namespace) -> None:
    """Give options that name links, joints or points the names that the command's linkage has in its language."""
    actions = list(actions)
    naming = [action.dest for action in actions if _NAMES_A_LINK.search(str(action.metavar))]
    if not any(getattr(arguments, dest, None) for dest in naming):
        return
    words = [getattr(arguments, action.dest, None) for action in actions if not action.option_strings]
    names = _names(words, language_of_names(arguments))
    if names:
        for dest in naming:
            setattr(arguments, dest, _spelled(getattr(arguments, dest, None), names))


def _names(words: Iterable[Any], lang: str) -> dict[str, str]:
    """For each link of the catalog entries and lengths among the words, the name of each language: that in this one."""
    from gruebler.cli.linkage_inputs import size_of

    names: dict[str, str] = {}
    for word in (each for value in words for each in (value if isinstance(value, list) else [value])):
        if not isinstance(word, str):
            continue
        if word in entries():
            known = {each: list(entries()[word].in_language(each).links) for each in LANGUAGES}
        elif (size := size_of(word)) is not None:
            linkage = size.linkage()
            known = {each: list(_names_of_lengths(linkage, each).values()) for each in LANGUAGES}
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
