"""`gruebler check`: chains from the command line, the catalog or files, counted and checked."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from gruebler.catalog import CheckedEntry, check_all, check_entry, check_exercise, entries, entry, exercises
from gruebler.chain import Chain
from gruebler.cli.inputs import chain_from_word, is_text
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.documents import load_document
from gruebler.errors import CatalogError, GrueblerError, NotationError
from gruebler.formats import Claims, read_entry
from gruebler.formats.catalog_records import entry_of_data
from gruebler.formats.linkages import linkage_from_json
from gruebler.formats.screws import read_any_linkage, spatial_from_json
from gruebler.mobility import mobility_report
from gruebler.mobility.report import verdict_word

__all__ = ["add", "explanation", "print_checked", "run"]

_HEADERS = {
    "en": ("chain", "n", "joints", "F counted", "generic", "verdict", "special dimensions", "claims"),
    "de": ("Kette", "n", "Gelenke", "F gezählt", "generisch", "Urteil", "besondere Abmessungen", "Angaben"),
}
_CLAIMS = {"en": {True: "hold", False: "WRONG", None: "-"}, "de": {True: "stimmen", False: "FALSCH", None: "-"}}
_MOVES = {"en": "moves with {}", "de": "bewegt sich mit {}"}
_SUMMARY = {
    "en": ("Chains: {n}; every claim holds.", "Chains: {n}; with wrong claims: {wrong}."),
    "de": ("Ketten: {n}; alle Angaben stimmen.", "Ketten: {n}; mit falschen Angaben: {wrong}."),
}
_TRUTH = {
    "en": "Dimensions decide: the entry's machine moves with mobility {mobility}, not {generic}. {reason} "
    "Links concerned: {links}.",
    "de": "Die Abmessungen entscheiden: Die Maschine des Eintrags hat den Laufgrad {mobility}, nicht {generic}. "
    "{reason} Betroffene Glieder: {links}.",
}
_GROUP = {
    "en": "With b = {b} the count gives {counted}. {reason}",
    "de": "Mit b = {b} ergibt die Zählung {counted}. {reason}",
}
_WIDEST_NAME = 44

_ENDINGS = (".toml", ".json", ".txt", ".g6")  # of files with chains; without an ending: one chain a line


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Count the freedoms of chains, check the count and name what is wrong. Without an argument: "
        "every machine and exercise of the catalog.",
        epilog="Exit status: 0 all good, 1 a claim of an entry fails, 2 wrong usage or unreadable input.",
    )
    parser.add_argument(
        "chains",
        nargs="*",
        metavar="CHAIN|ID|FILE",
        help="a text such as 'R(0-1) R(1-2) R(2-3) R(3-0)', g6:CODE, the id of a catalog entry, a file (.toml entry, "
        ".json chain or list of chains, .g6 lines, otherwise one chain a line), or - for lines on standard input",
    )
    parser.add_argument(
        "--space", choices=("planar", "spherical", "spatial"), help="where texts live (default: planar)"
    )
    parser.add_argument("--b", type=int, metavar="B", help="motions of a free link for the count (2 for a screw group)")
    parser.add_argument("--frame", metavar="LINK", help="the link that stands still (default: the first)")
    parser.add_argument("--explain", action="store_true", help="say in words, step by step")
    parser.add_argument("--yes", action="store_true", help="begin even if it will be long or take much memory")
    parser.add_argument("--json", action="store_true", help="a list of objects, one for each chain")


def run(arguments: argparse.Namespace) -> int:
    """Check what the arguments name; 1 if a claim fails."""
    checked_entries = (
        [checked_entry for word in arguments.chains for checked_entry in _checked(word, arguments)]
        if arguments.chains
        else check_all()
    )
    if arguments.json:
        print_json([checked_as_dict(one) for one in checked_entries])
    elif arguments.explain:
        print_text("\n\n".join(explanation(one, arguments.lang) for one in checked_entries))
    else:
        print_checked(checked_entries, arguments.lang)
    _complain(checked_entries)
    return int(any(not one.holds for one in checked_entries))


def checked_as_dict(checked_entry: CheckedEntry) -> dict[str, Any]:
    """One object of the list that --json prints."""
    holds = None if checked_entry.claims == Claims() else checked_entry.holds
    finite = None if checked_entry.freedoms is None else checked_entry.freedoms.to_json()["finite"]
    return {"name": checked_entry.id, **checked_entry.report.to_json(), "finite": finite, "claims_hold": holds}


def print_checked(found: Iterable[CheckedEntry], lang: str) -> None:
    """The table, and a line that sums it up where there are claims."""
    rows = []
    claims = []
    for checked_entry in found:
        holds = None if checked_entry.claims == Claims() else checked_entry.holds
        claims.append(holds)
        rows.append(
            (
                checked_entry.id
                if len(checked_entry.id) <= _WIDEST_NAME
                else checked_entry.id[: _WIDEST_NAME - 3] + "...",
                str(checked_entry.report.chain.n),
                " ".join(f"g{f}={g}" for f, g in checked_entry.report.count.by_freedom),
                str(checked_entry.report.counted),
                str(checked_entry.report.generic),
                verdict_word(checked_entry.report.verdict, lang),
                _MOVES[lang].format(checked_entry.claims.mobility) if _moves_otherwise(checked_entry) else "",
                _CLAIMS[lang][holds],
            )
        )
    print_table(_HEADERS[lang], rows, numbers=(1, 3, 4))
    wrong = claims.count(False)
    if any(holds is not None for holds in claims):
        print("\n" + _SUMMARY[lang][wrong > 0].format(n=len(rows), wrong=wrong))


def explanation(checked_entry: CheckedEntry, lang: str) -> str:
    """The report in words under the entry's name, with what the entry adds to it."""
    known = entries().get(checked_entry.id) if checked_entry.origin else None
    title = f"{known.name.in_language(lang)} ({checked_entry.id})" if known else checked_entry.id
    lines = [title, "-" * len(title), checked_entry.report.explain(lang)]
    claims = checked_entry.claims
    if claims.reason is not None and _moves_otherwise(checked_entry):
        clusters = checked_entry.report.rigid_clusters or (checked_entry.report.chain.links,)
        lines.append(
            _TRUTH[lang].format(
                mobility=claims.mobility,
                generic=checked_entry.report.generic,
                reason=claims.reason.in_language(lang),
                links=", ".join(link for cluster in clusters for link in cluster),
            )
        )
    if claims.group is not None:
        lines.append(
            _GROUP[lang].format(
                b=claims.group.b, counted=claims.group.counted, reason=claims.group.reason.in_language(lang)
            )
        )
    if checked_entry.freedoms is not None:
        lines.append(checked_entry.freedoms.summary(lang))
    return "\n".join(lines)


def _moves_otherwise(checked_entry: CheckedEntry) -> bool:
    """Whether the entry claims a mobility that only its special dimensions give."""
    return checked_entry.claims.mobility is not None and checked_entry.claims.mobility != checked_entry.report.generic


def _complain(found: Iterable[CheckedEntry]) -> None:
    for checked_entry in found:
        for claim in checked_entry.wrong:
            print(f"{checked_entry.origin or checked_entry.id}: {claim}", file=sys.stderr)


def _checked(word: str, arguments: argparse.Namespace) -> Iterator[CheckedEntry]:
    """What one argument names: a chain, a catalog entry, an exercise or a file."""
    if word == "-":
        text = sys.stdin.read()
        if text.lstrip().startswith(("[", "{")):
            yield from _json(Path("standard input"), text, arguments)
        else:
            yield from _lines(text, "standard input", arguments)
    elif is_text(word):
        yield _plain(chain_from_word(word, arguments.space), word, arguments)
    elif (path := Path(word)).is_file() or path.suffix.lower() in _ENDINGS:
        yield from _file(path, arguments)
    elif word in exercises():
        yield from check_exercise(exercises()[word])
    else:
        record = entry(word)
        if arguments.b is None and arguments.frame is None:
            yield check_entry(record)
        else:
            yield _plain(record.chain(), word, arguments)


def _plain(chain: Chain, name: str, arguments: argparse.Namespace) -> CheckedEntry:
    """A chain that claims nothing."""
    report = mobility_report(chain, b=arguments.b, frame=arguments.frame, large=arguments.yes)
    return CheckedEntry(name, "", report, Claims(), ())


def _file(path: Path, arguments: argparse.Namespace) -> Iterator[CheckedEntry]:
    ending = path.suffix.lower()
    if ending not in ("", *_ENDINGS):
        raise CatalogError(
            "{path}: expected a file that ends with {endings}, not with {suffix}",
            path=path,
            endings=", ".join(_ENDINGS),
            suffix=path.suffix,
        )
    if ending == ".toml":
        if _is_linkage(path):
            yield _plain(read_any_linkage(path).mechanism.chain, path.stem, arguments)
        else:
            yield check_entry(read_entry(path), origin=str(path))
        return
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise CatalogError("{path}: cannot be read ({value})", path=path, value=error.strerror or error) from None
    except UnicodeDecodeError:
        raise CatalogError("{path}: is not UTF-8 text", path=path) from None
    if ending == ".json":
        yield from _json(path, text, arguments)
    elif ending == ".g6":
        yield from _lines("".join(f"g6:{line}\n" for line in text.split()), str(path), arguments)
    else:
        yield from _lines(text, str(path), arguments)


def _is_linkage(path: Path) -> bool:
    """Whether a TOML file holds the dimensions of a linkage rather than an entry: it tells its unit."""
    document = load_document(path, lambda text: CatalogError("{path}: {text_}", path=path, text_=text))
    return isinstance(document, dict) and "id" not in document and ("unit" in document or "screws" in document)


def _json(path: Path, text: str, arguments: argparse.Namespace) -> Iterator[CheckedEntry]:
    if not text.strip():
        raise NotationError(f"{path}: is empty")
    try:
        document = json.loads(text)
    except RecursionError:
        raise NotationError("{path}: is nested too deeply", path=path) from None
    except ValueError as error:  # JSONDecodeError, or a number of thousands of digits
        raise NotationError("{path}: is not JSON: {error}", path=path, error=error) from None
    if isinstance(document, dict) and "items" in document:
        document = document["items"]
    if document == []:
        raise NotationError("{path}: no chain in it; expected an object or a list of objects", path=path)
    documents = document if isinstance(document, list) else [document]
    for number, one in enumerate(documents, 1):
        name = place = f"{path}[{number}]" if isinstance(document, list) else str(path)
        if isinstance(one, dict) and isinstance(one.get("name"), str) and one["name"].strip():
            name = one["name"].strip()
            place += f" ({name})"
        if isinstance(one, dict) and "id" in one:
            yield check_entry(entry_of_data(one, place), origin=place)
            continue
        try:
            yield _plain(_chain_of_json(one), name, arguments)
        except GrueblerError as error:
            raise NotationError("{place}: {error}", place=place, error=error) from None


def _chain_of_json(document: Any) -> Chain:
    """The chain of an object: of a list of mechanisms, a linkage with dimensions or screws, a report, or its own."""
    if isinstance(document, dict) and isinstance(document.get("text"), str):
        return chain_from_word(document["text"])
    if isinstance(document, dict) and "screws" in document:
        return spatial_from_json(document).mechanism.chain
    if isinstance(document, dict) and "unit" in document:
        return linkage_from_json(document).mechanism.chain
    return Chain.from_json(document)


def _lines(text: str, source: str, arguments: argparse.Namespace) -> Iterator[CheckedEntry]:
    empty = True
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        empty = False
        try:
            chain = chain_from_word(line, arguments.space) if is_text(line) else Chain.parse(line, arguments.space)
            yield _plain(chain, line.strip(), arguments)
        except GrueblerError as error:
            raise NotationError("{source}, line {number}: {error}", source=source, number=number, error=error) from None
    if empty:
        raise NotationError("{source}: no chain in it; expected one a line", source=source)
