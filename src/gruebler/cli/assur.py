"""`gruebler assur`: a mechanism taken apart into drives and Assur groups, or all groups with so many links."""

from __future__ import annotations

import argparse
from typing import Any

from gruebler.assur import AssurGroup, Decomposition, SolvedGroup, assur_groups, decompose, drive_choices
from gruebler.assur.forms import roman
from gruebler.assur.listing import expected_seconds_of_groups
from gruebler.cli.inputs import mechanism_of
from gruebler.cli.long_work import ask_before, progress
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.errors import GrueblerError
from gruebler.mechanism import Mechanism

__all__ = ["add", "run"]

_GROUPS = {"en": ("form", "class", "order", "group"), "de": ("Form", "Klasse", "Ordnung", "Gruppe")}
_PROGRESS = {"en": "{n} groups, {seconds:.0f} s", "de": "{n} Gruppen, {seconds:.0f} s"}
_CHOICES = {"en": ("drive", "class", "formula"), "de": ("Antrieb", "Klasse", "Formel")}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Drives and Assur groups in solving order, with form, class and order; without a drive: how they "
        "change with it.",
        epilog="Exit status: 0 determined, 1 something stays undetermined, 2 wrong usage or unreadable input.",
    )
    parser.add_argument(
        "mechanism",
        nargs="?",
        metavar="MECHANISM",
        help="a text with '; frame=..; drive=..', a code, g6:CODE or the id of a catalog entry",
    )
    parser.add_argument("--frame", metavar="LINK", help="the link that stands still")
    parser.add_argument("--drive", action="append", default=[], metavar="JOINT", help="a driven joint; repeatable")
    parser.add_argument("--anywhere", action="store_true", help="without a drive: drives between moving links too")
    parser.add_argument("--list", type=int, metavar="N", help="all groups with N links instead")
    parser.add_argument("--count", action="store_true", help="only how many")
    parser.add_argument("--yes", action="store_true", help="with --list: begin even if it will be long")
    parser.add_argument("--json", action="store_true", help="an object with count and items")


def run(arguments: argparse.Namespace) -> int:
    """Take a mechanism apart (1 if its drives leave something undetermined), compare drives, or list groups."""
    if (arguments.list is None) == (arguments.mechanism is None):
        raise GrueblerError("name one mechanism, or ask for --list N: all groups with N links")
    if arguments.list is not None:
        ask_before(expected_seconds_of_groups(arguments.list), arguments.yes)
        found = list(progress(assur_groups(arguments.list), _PROGRESS[arguments.lang]))
        _print([_group_item(group) for group in found], arguments, lambda: _list(found, arguments.lang))
        return 0
    mechanism = mechanism_of(arguments.mechanism, arguments.frame, arguments.drive)
    if not mechanism.drives:
        choices = list(drive_choices(mechanism.chain, mechanism.frame, anywhere=arguments.anywhere))
        items = [{"code": _code(one.mechanism), "text": str(one.mechanism), **_verdict(one)} for one in choices]
        _print(items, arguments, lambda: _compare(choices, arguments.lang))
        return 0
    decomposition = decompose(mechanism)
    about = {"code": _code(mechanism), "text": str(mechanism), **_verdict(decomposition)}
    about |= {
        "drives": list(mechanism.drive_names()),
        "driven": list(decomposition.driven),
        "rest": list(decomposition.rest),
    }
    if not decomposition.complete:
        about["message"] = decomposition.message(arguments.lang)
    names = mechanism.chain.joint_names()
    items = [_item(group, names) for group in decomposition.groups]
    _print(items, arguments, lambda: print_text(decomposition.explain(arguments.lang)), about)
    return int(not decomposition.complete)


def _print(
    items: list[dict[str, Any]], arguments: argparse.Namespace, say: Any, about: dict[str, Any] | None = None
) -> None:
    if arguments.json:
        document = {**(about or {}), "count": len(items)}
        if not arguments.count:
            document["items"] = items
        print_json(document)
    elif arguments.count:
        print(len(items))
    else:
        say()


def _verdict(decomposition: Decomposition) -> dict[str, Any]:
    return {"formula": decomposition.formula(), "class": decomposition.class_number, "complete": decomposition.complete}


def _item(group: SolvedGroup, names: tuple[str, ...]) -> dict[str, Any]:
    return {
        **_group_item(group.shape),
        "links": list(group.links),
        "inner": [names[k] for k in group.inner],
        "outer": [names[k] for k in group.outer],
        "after": list(group.after),
    }


def _group_item(group: AssurGroup) -> dict[str, Any]:
    return {
        "code": group.code,
        "text": str(group),
        "form": group.form,
        "class": group.class_number,
        "order": group.order,
    }


def _code(mechanism: Mechanism) -> str | None:
    try:
        return mechanism.code()
    except GrueblerError:
        return None  # codes have no place for drives of single freedoms or within multiple joints


def _list(found: list[AssurGroup], lang: str) -> None:
    alphabet = "german" if lang == "de" else "international"
    rows = []
    for group in found:
        form = group.named(alphabet)
        named = "" if form == group.code else form
        rows.append((named, roman(group.class_number), str(group.order), group.chain.text(alphabet)))
    print_table(_GROUPS[lang], rows, numbers=(2,))


def _compare(choices: list[Decomposition], lang: str) -> None:
    alphabet = "german" if lang == "de" else "international"
    rows = [
        (
            ", ".join(decomposition.mechanism.drive_names(alphabet)),
            roman(decomposition.class_number) if decomposition.complete else "-",
            _after(decomposition, lang),
        )
        for decomposition in choices
    ]
    print_table(_CHOICES[lang], rows)


def _after(decomposition: Decomposition, lang: str) -> str:
    return decomposition.formula(lang).partition(" -> ")[2]
