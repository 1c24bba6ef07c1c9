"""`gruebler assur`: the drives and Assur groups of a mechanism, or all groups with a given number of links."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import message, translate
from gruebler.cli.inputs import mechanism_of
from gruebler.cli.link_names import language_of_names
from gruebler.cli.long_work import ask_before, progress
from gruebler.cli.output import print_count, print_items
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.structure.assur import AssurGroup, Decomposition, SolvedGroup, count_modes, decompose, drive_choices
from gruebler.structure.assur.forms import roman
from gruebler.structure.assur.listing import GroupRow, count_assur_groups, expected_seconds_of_groups, group_rows
from gruebler.structure.assur.modes import modes_of_rows
from gruebler.structure.chain.pairs import Alphabet, pair
from gruebler.structure.mechanism import Mechanism

_NAMED = 4  # groups of more links have no names
_PROGRESS = message("{n} groups, {seconds:.0f} s")


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Decompose a mechanism into drives and Assur groups, in the order in which they are solved, with "
        "form, class and order. Without a drive, compare all drives. With --list, list all groups of a size.",
        epilog="Examples: gruebler assur loader; gruebler assur --list 4 --count; gruebler assur --list 6 --modes. "
        "Exit status: 0 the drives determine "
        "the motion, 1 they do not, 2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        mechanism MECHANISM ?  a mechanism such as 'R(0-1) R(1-2) R(2-3) R(3-0); frame=0; drive=R(0-1)', a code,
            g6:CODE, a catalog entry or a linkage file
        --frame
        --drive
        --anywhere  without a drive: also drives between moving links
        --list N int  list all groups with N links
        --count
        --modes  also the number of assembly modes of each group, complex ones included, in the plane and on the sphere
        --yes
        """
    )
    parser.add_printed(help="print an object with count and items")


def run(arguments: argparse.Namespace) -> int:
    """Take a mechanism apart (1 if its drives leave something undetermined), compare drives, or list groups."""
    if (arguments.list is None) == (arguments.mechanism is None):
        raise GrueblerError("give either a mechanism or --list N for all groups with N links")
    if arguments.list is not None:
        return _list_groups(arguments)
    mechanism = mechanism_of(arguments.mechanism, arguments.frame, arguments.drive, language_of_names(arguments))
    if not mechanism.drives:
        choices = list(drive_choices(mechanism.chain, mechanism.frame, anywhere=arguments.anywhere))
        print_items(
            arguments,
            choices,
            lambda choice: {"code": _code(choice.mechanism), "text": str(choice.mechanism), **_verdict(choice)},
            lambda: _compare(choices, arguments.lang),
        )
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
    modes = [_modes_of(group.shape) for group in decomposition.groups] if arguments.modes else []

    def show() -> None:
        print_text(decomposition.explain(arguments.lang))
        if modes:
            print()
            _show_modes(decomposition.groups, modes, arguments.lang)

    keys = ("modes", "spherical_modes")
    print_items(
        arguments,
        list(enumerate(decomposition.groups)),
        lambda item: _item(item[1], names) | (dict(zip(keys, modes[item[0]], strict=True)) if modes else {}),
        show,
        about,
    )
    return int(not decomposition.complete)


def _modes_of(group: AssurGroup) -> tuple[int | None, int | None]:
    """In the plane and on the sphere; None where a joint does not turn."""
    if not all(joint.pair.is_turning for joint in group.chain.joints):
        return None, None
    return count_modes(group), count_modes(group, spherical=True)


def _show_modes(groups: Sequence[SolvedGroup], modes: list[tuple[int | None, int | None]], lang: str) -> None:
    rows = [
        (", ".join(group.links), *("-" if number is None else str(number) for number in numbers))
        for group, numbers in zip(groups, modes, strict=True)
    ]
    print_table([translate("group", lang), *_mode_headers(lang)], rows, numbers=(1, 2))


def _mode_headers(lang: str) -> list[str]:
    return [translate("modes in the plane", lang), translate("modes on the sphere", lang)]


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


def _list_groups(arguments: argparse.Namespace) -> int:
    """All groups of a size: counted without a list, listed without an object for each."""
    if arguments.count:
        print_count(arguments, count_assur_groups(arguments.list))
        return 0
    ask_before(expected_seconds_of_groups(arguments.list), arguments.yes)
    rows = list(progress(group_rows(arguments.list), _PROGRESS.in_language(arguments.lang)))
    modes: list[tuple[int, int]] = []
    if arguments.modes:
        modes = list(zip(modes_of_rows(rows), modes_of_rows(rows, spherical=True), strict=True))
    keys = ("modes", "spherical_modes")
    print_items(
        arguments,
        list(enumerate(rows)),
        lambda item: _group_item(item[1].group()) | (dict(zip(keys, modes[item[0]], strict=True)) if modes else {}),
        lambda: _list(rows, modes, arguments.list, arguments.lang),
    )
    return 0


def _list(groups: list[GroupRow], modes: list[tuple[int, int]], links: int, lang: str) -> None:
    alphabet = Alphabet.of_language(lang)
    symbol = pair("revolute").symbol(alphabet)
    rows = []
    for number, group in enumerate(groups):
        form = group.group() if links <= _NAMED else None
        named = "" if form is None or form.form == form.code else form.named(alphabet)
        counted = map(str, modes[number]) if modes else ()
        rows.append((named, roman(group.class_number), str(group.order), *counted, group.text(symbol)))
    headers = [translate("form", lang), translate("class", lang), translate("order", lang)]
    headers += [*(_mode_headers(lang) if modes else []), translate("group", lang)]
    first = 0 if any(form for form, *_ in rows) else 1  # groups of more than four links have no names
    numbers = range(2 - first, len(headers) - first - 1)
    print_table(headers[first:], [row[first:] for row in rows], numbers=numbers)


def _compare(choices: list[Decomposition], lang: str) -> None:
    alphabet = Alphabet.of_language(lang)
    rows = [
        (
            ", ".join(decomposition.mechanism.drive_names(alphabet)),
            roman(decomposition.class_number) if decomposition.complete else "-",
            decomposition.formula(lang).partition(" -> ")[2],
        )
        for decomposition in choices
    ]
    print_table([translate("drive", lang), translate("class", lang), translate("formula", lang)], rows)
