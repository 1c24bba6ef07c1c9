"""`gruebler check`: chains from the command line, the catalog or files, counted and checked."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import joined, message, number, translate
from gruebler.cli.drive_rows import pose_of
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import linkage_of_word, value_of_another_program
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.files import Claims, Entry
from gruebler.files.structures import (
    STRUCTURE_ENDINGS,
    Structure,
    chain_of_text,
    is_structure_text,
    read_structures,
    structures_of_json,
    structures_of_lines,
)
from gruebler.mechanics.fourbar.length_texts import is_lengths
from gruebler.mechanics.linkages import Linkage, has_only_lower_pairs
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism.inversion import of_family
from gruebler.structure.mobility import mobility_report
from gruebler.structure.mobility.report import verdict_word
from gruebler.teaching.catalog import CheckedEntry, check_all, check_entry, check_exercise, entries, entry, exercises

_WIDEST_NAME = 44
_MOST_LISTED, _MOST_NAMED = 50, 20
"""More chains are summed up; of those that fail so many are named."""


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Count the freedoms of chains and check whether the count is right. For linkages with dimensions "
        "or joint screws, also find the mobility at a pose and the finite mobility. Without arguments, check "
        "every machine and exercise of the catalog.",
        epilog="Examples: gruebler check winch_screw --explain; gruebler check four-bar:2,5,2,5 --at 0; gruebler "
        "variants --links 6 --prismatic 1 | gruebler check -. Exit status: 0 success, 1 a claim of a catalog entry is "
        "wrong, 2 wrong usage or unreadable input.",
    )
    parser.take(
        """
        chains CHAIN|ID|FILE *  a chain such as 'R(0-1) R(1-2) R(2-3) R(3-0)', g6:CODE, a catalog entry, lengths such
            as four-bar:25,70,40,70, a file (.toml: entry or linkage; .json: chains or linkages; .g6; otherwise one
            chain per line), or - for lines or JSON on standard input
        --space {planar,spherical,spatial}  space of the chains (default: planar)
        --b B int  freedoms of a free link in the formula (2 for a screw group)
        --frame
        --at VALUE[,VALUE]  with dimensions: the pose, one value per drive in degrees or the unit; joint screws count
            from their given position (default: the given position, otherwise a regular pose)
        --branch LABELS  with dimensions: the assembly mode, such as +- (write --branch=-+)
        --tolerance T float  with dimensions: singular values below T times the largest count as zero (default: 1e-8)
        --explain  explain the result step by step
        --yes
        """
    )
    parser.add_printed(help="print a list of objects, one per chain")


def run(arguments: argparse.Namespace) -> int:
    """Check what the arguments name; 1 if a claim fails."""
    checked_entries = (
        [checked_entry for word in arguments.chains for checked_entry in _checked(word, arguments)]
        if arguments.chains
        else check_all()
    )
    if arguments.json:
        print_json([checked_as_dict(each) for each in checked_entries])
    elif arguments.explain:
        print_text("\n\n".join(explanation(each, arguments.lang) for each in checked_entries))
    elif len(checked_entries) > _MOST_LISTED and not (arguments.all or arguments.out):
        print_summary(checked_entries, arguments.lang)
    else:
        print_checked(checked_entries, arguments.lang)
    _complain(checked_entries, arguments.lang)
    return int(any(not each.holds for each in checked_entries))


def checked_as_dict(checked_entry: CheckedEntry) -> dict[str, Any]:
    """One object of the list that --json prints."""
    holds = None if checked_entry.claims == Claims() else checked_entry.holds
    sized = {} if checked_entry.freedoms is None else checked_entry.freedoms.to_json()
    return {
        "name": checked_entry.id,
        **checked_entry.report.to_json(),
        **{key: sized.get(key) for key in ("instant", "finite", "reasons")},
        "claims_hold": holds,
    }


def print_summary(checked_entries: Sequence[CheckedEntry], lang: str) -> None:
    """How many chains there are of each mobility and verdict, and of which the count is wrong."""
    kinds = Counter((each.report.counted, each.report.generic, each.report.verdict) for each in checked_entries)
    rows = [
        (str(counted), str(generic), verdict_word(verdict, lang), number(chains, lang, ","))
        for (counted, generic, verdict), chains in sorted(kinds.items(), key=lambda kind: -kind[1])
    ]
    headers = (message("F counted"), message("generic"), message("verdict"), message("chains"))
    print_table(headers, rows, numbers=(0, 1, 3), lang=lang)
    print()
    failing = [each.id for each in checked_entries if not each.holds or each.report.counted != each.report.generic]
    if failing:
        named = joined([_shortened(name) for name in failing[:_MOST_NAMED]] + ["..."] * (len(failing) > _MOST_NAMED))
        print(translate("The count is not right of {count:,}: {names}.", lang, count=len(failing), names=named))
    else:
        print(translate("The count is right for all of them.", lang))
    _print_claims([None if each.claims == Claims() else each.holds for each in checked_entries], lang)
    print(translate("Chains: {count:,}; --all lists them, --json has them.", lang, count=len(checked_entries)))


def _shortened(name: str) -> str:
    return name if len(name) <= _WIDEST_NAME else name[: _WIDEST_NAME - 3] + "..."


def print_checked(checked_entries: Iterable[CheckedEntry], lang: str) -> None:
    """The table, and a line that sums it up where there are claims."""
    claims = {True: translate("hold", lang), False: translate("WRONG", lang), None: "-"}
    rows = []
    holding = []
    for checked in checked_entries:
        holding.append(None if checked.claims == Claims() else checked.holds)
        rows.append(
            (
                _shortened(checked.id),
                str(checked.report.chain.n),
                " ".join(f"g{f}={g}" for f, g in checked.report.count.by_freedom),
                str(checked.report.counted),
                str(checked.report.generic),
                verdict_word(checked.report.verdict, lang),
                _moving(_special_mobility(checked), lang),
                claims[holding[-1]],
            )
        )
    headers = [
        translate("chain", lang),
        "n",
        translate("joints", lang),
        translate("F counted", lang),
        translate("generic", lang),
        translate("verdict", lang),
        translate("special dimensions", lang),
        translate("claims", lang),
    ]
    print_table(headers, rows, numbers=(1, 3, 4))
    if any(each is not None for each in holding):
        print()
        _print_claims(holding, lang)


def _print_claims(holding: Sequence[bool | None], lang: str) -> None:
    """Whether the claims hold; nothing where there are none."""
    if wrong := holding.count(False):
        print(translate("Chains: {count}; with wrong claims: {wrong}.", lang, count=len(holding), wrong=wrong))
    elif any(holding):
        print(translate("Chains: {count}; every claim holds.", lang, count=len(holding)))


def explanation(checked: CheckedEntry, lang: str) -> str:
    """The report in words under the entry's name, with what the entry and its dimensions add to it."""
    known = entries().get(checked.id) if checked.origin else None
    title = f"{known.name.in_language(lang)} ({checked.id})" if known else checked.id
    lines = [title, "-" * len(title), checked.report.explain(lang)]
    claims = checked.claims
    if claims.reason is not None and claims.mobility not in (None, checked.report.generic):
        clusters = checked.report.rigid_clusters or (checked.report.chain.links,)
        lines.append(
            translate(
                "Dimensions decide: the entry's machine moves with mobility {mobility}, not {generic}. {reason} "
                "Links concerned: {links}.",
                lang,
                mobility=claims.mobility,
                generic=checked.report.generic,
                reason=claims.reason.in_language(lang),
                links=", ".join(link for cluster in clusters for link in cluster),
            )
        )
    if claims.group is not None:
        lines.append(
            translate(
                "With b = {b} the count gives {counted}. {reason}",
                lang,
                b=claims.group.b,
                counted=claims.group.counted,
                reason=claims.group.reason.in_language(lang),
            )
        )
    if claims.says_motion:
        from gruebler.teaching.catalog.motion_claims import motion_lines  # moves linkages: loaded where it is needed

        lines += motion_lines(claims, lang)
    if checked.freedoms is not None:
        counted = checked.report.count.formula()  # has its line above
        lines += [line for line in checked.freedoms.explain(lang).splitlines() if not line.endswith(counted)]
    return "\n".join(lines)


def _moving(mobility: int | None, lang: str) -> str:
    if mobility is None:
        return ""
    return translate("moves with {mobility}", lang, mobility=mobility) if mobility else translate("rigid", lang)


def _special_mobility(checked: CheckedEntry) -> int | None:
    """The mobility that only special dimensions give, derived or claimed; None if they are not special."""
    mobility = checked.claims.mobility if checked.freedoms is None else checked.freedoms.mobility
    return None if mobility == checked.report.generic else mobility


def _complain(checked_entries: Iterable[CheckedEntry], lang: str) -> None:
    for checked in checked_entries:
        for claim in checked.wrong:
            print(f"{checked.origin or checked.id}: {claim.in_language(lang)}", file=sys.stderr)


def _checked(word: str, arguments: argparse.Namespace) -> Iterator[CheckedEntry]:
    """What one argument names: a chain, a catalog entry, an exercise or a file."""
    if not is_structure_text(word) and word in exercises() and not Path(word).is_file():
        yield from check_exercise(exercises()[word])
        return
    for structure in _structures(word, arguments.space, language_of_names(arguments)):
        try:
            yield _checked_structure(structure, arguments)
        except GrueblerError as error:
            if not structure.place:
                raise
            raise GrueblerError("{place}: {error}", place=structure.place, error=error) from None


def _structures(word: str, space: str | None, lang: str) -> Iterator[Structure]:
    path = Path(word)
    if word == "-":
        text = sys.stdin.read()
        if text.lstrip().startswith(("[", "{")):
            yield from structures_of_json(text, "standard input")
        else:
            yield from structures_of_lines(text, "standard input", space)
    elif is_structure_text(word):
        yield Structure(word, "", chain_of_text(word, space))
    elif (foreign := value_of_another_program(word, lang)) is not None:
        for number, value in enumerate(foreign if isinstance(foreign, list) else [foreign], 1):
            name = f"{path.stem} {number}" if isinstance(foreign, list) else path.stem
            yield Structure(name, str(path), value)
    elif path.is_file() or path.suffix.lower() in STRUCTURE_ENDINGS:
        yield from read_structures(path, space)
    elif is_lengths(word):
        yield Structure(word, "", linkage_of_word(word, lang)[0])
    elif (named := of_family(word)) is not None:
        yield Structure(word, "", named.chain)
    else:
        yield Structure(word, "", entry(word).in_language(lang))


def _checked_structure(structure: Structure, arguments: argparse.Namespace) -> CheckedEntry:
    """The count checked, claims derived again, and the mobility with dimensions where there are any."""
    name, place, value = structure.name, structure.place, structure.value
    placed: Linkage | SpatialLinkage | None = None
    if isinstance(value, Entry):
        placed = value.placed()
        chain, frame = value.chain(), None
        has_sizes = value.dimensions is not None
    elif isinstance(value, Chain):
        chain, frame, has_sizes = value, None, False
    else:
        placed = value if isinstance(value, SpatialLinkage) or has_only_lower_pairs(value) else None
        chain, frame, has_sizes = value.mechanism.chain, value.mechanism.frame, True
    at_pose = (arguments.at, arguments.branch, arguments.tolerance) != (None, None, None)
    if at_pose and placed is None:
        if has_sizes:
            raise GrueblerError(
                "the mobility of {name!r} with its belts, cams or non-circular wheels cannot be found at a pose; give "
                "its joints as screws, or leave out --at, --branch and --tolerance",
                name=name,
            )
        raise GrueblerError(
            "{name!r} has no dimensions; --at, --branch and --tolerance need a linkage with dimensions or joint screws",
            name=name,
        )
    if isinstance(value, Entry) and arguments.b is None and arguments.frame is None:
        checked = check_entry(value, place or None)
        if not at_pose:
            return checked
    else:
        report = mobility_report(chain, b=arguments.b, frame=arguments.frame or frame, large=arguments.yes)
        checked = CheckedEntry(id=name, origin="", report=report, claims=Claims(), wrong=())
    if placed is None:
        return checked
    from gruebler.mechanics.screws import freedoms  # loaded for what has dimensions

    at = None if arguments.at is None else pose_of(arguments.at, placed.mechanism)
    tolerance = 1e-8 if arguments.tolerance is None else arguments.tolerance
    return replace(checked, freedoms=freedoms(placed, at=at, branch=arguments.branch, tolerance=tolerance))
