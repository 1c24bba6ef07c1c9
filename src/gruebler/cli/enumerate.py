"""`gruebler enumerate`: all chains with a given number of links, listed or counted."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import closing
from pathlib import Path
from typing import BinaryIO

from gruebler.base.atomic_files import atomic_file
from gruebler.base.errors import GrueblerError, RunError
from gruebler.base.text import joined, message, number, plural, translate
from gruebler.cli.assortments import print_assortments
from gruebler.cli.executors import executor_of
from gruebler.cli.inputs import assortment_of
from gruebler.cli.long_work import run_progress, time_text
from gruebler.cli.output import print_json, say_written, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.printed_file import printed_to_file
from gruebler.cli.tables import CUT_ABOVE, CUT_TO, print_table
from gruebler.cli.trains import trains
from gruebler.structure.enumeration.counting import ChainCount
from gruebler.structure.enumeration.estimates import Estimate, estimate
from gruebler.structure.enumeration.request import Request
from gruebler.structure.enumeration.run_request import run_count, run_list
from gruebler.structure.enumeration.work_units import PieceListing

_LONG = 900.0  # seconds; what takes longer, or more bytes than the following, needs --yes
_LARGE = 8 * 10**9
_ENDINGS = {".txt": "text", ".g6": "graph6", ".json": "json"}

_FRACTIONATED = {
    "none": message("not fractionated"),
    "link": message("fractionated at a link"),
    "joint": message("fractionated at a joint"),
}
_COUNTS = {
    "chains": message("chains"),
    "inversions": message("inversions (frame)"),
    "drives": message("driven mechanisms (frame, drive at the frame)"),
    "joint_orbits": message("joint orbits"),
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="List or count all planar chains of revolute joints that have no rigid part, each once. With "
        "--assortments, list the numbers of binary, ternary, ... links that such chains can have; with --trains, "
        "list epicyclic gear trains.",
        epilog="Examples: gruebler enumerate --links 8 --count --orbits; gruebler enumerate --links 8 --assortments; "
        "gruebler enumerate --links 5 --trains. A run with --checkpoint can be stopped at any time; the same command "
        "continues it.",
    )
    parser.take(
        """
        --links !
        --mobility
        --fractionated {none,link,joint,all} ? :all =none  chains that are not fractionated (default), fractionated at a
            link, at a joint, or all of them
        --assortment
        --multiple-joints K|any ? :any =0  number of joints of three or more links: K, K-M or any (default: 0)
        --count  print only the numbers, by assortment
        --orbits  with --count: also count inversions and driven mechanisms
        --assortments  list only the link assortments
        --trains  epicyclic gear trains: axes as (multiple) joints, and gear pairs
        --format {text,graph6,json}  format of the list (default: text)
        """
    )
    parser.add_out(help="write into a file instead: .txt, .g6 or .json")
    parser.take(
        """
        --jobs
        --scheduler
        --checkpoint DIR path  folder for finished parts of the work
        --yes
        """
    )
    parser.add_json(help="print JSON")


def run(arguments: argparse.Namespace) -> int:
    """List or count what the arguments ask for."""
    if arguments.assortments:
        arguments.written = ()
        with printed_to_file(arguments):
            return print_assortments(arguments)
    if arguments.trains:
        return trains(arguments)
    request = Request(
        arguments.links,
        mobility=arguments.mobility,
        fractionated=arguments.fractionated,
        assortment=assortment_of(arguments.assortment),
        multiple_joints=arguments.multiple_joints,
    )
    form = None if arguments.count else _format(arguments, request)
    if arguments.orbits and form is not None:
        raise GrueblerError("--orbits needs --count")
    if form is None and arguments.format not in (None, "json"):
        raise GrueblerError(
            "--format {form} is for lists; a count is a table, or JSON with --json", form=arguments.format
        )
    if form is None and arguments.format == "json":
        arguments.json = True
    if form is None and _form_of_ending(arguments.out) not in (None, "json"):
        raise GrueblerError("-o {path}: a count is written as JSON; end the name with .json", path=arguments.out)
    if arguments.out is not None and not arguments.out.name:
        raise RunError("-o {path!r} names no file", path=str(arguments.out))
    if arguments.out is not None and not arguments.out.parent.is_dir():
        raise RunError("-o {path}: there is no directory {parent}", path=arguments.out, parent=arguments.out.parent)
    executor = executor_of(arguments)
    size = estimate(request, form)
    _check_size(size, arguments)
    if form is None:
        return _count(request, arguments, executor, size)
    return _list(request, form, arguments, executor, size)


def _format(arguments: argparse.Namespace, request: Request) -> str:
    form = arguments.format or ("json" if arguments.json else _form_of_ending(arguments.out) or "text")
    if arguments.json and form != "json":
        raise GrueblerError("--json means --format json and does not go with --format {form}", form=form)
    if form == "graph6" and not request.only_simple:
        raise GrueblerError("graph6 describes chains with simple joints only; use --format text or json")
    if _form_of_ending(arguments.out) not in (None, form):
        raise GrueblerError(
            "-o {path}: --format {form} and the ending {suffix} do not agree",
            path=arguments.out,
            form=form,
            suffix=arguments.out.suffix,
        )
    return str(form)


def _form_of_ending(path: Path | None) -> str | None:
    """The format that the name of a file asks for; None without an ending, `GrueblerError` for an unknown one."""
    if path is None or not path.suffix:
        return None
    form = _ENDINGS.get(path.suffix.lower())
    if form is None:
        raise GrueblerError(
            "-o {path}: expected a name that ends with .txt, .g6 or .json, not with {suffix}",
            path=path,
            suffix=path.suffix,
        )
    return form


def _check_size(size: Estimate, arguments: argparse.Namespace) -> None:
    """Refuse what would not fit, and say how much it is; say it too where it is begun with --yes."""
    seconds = size.seconds / arguments.jobs
    if seconds <= _LONG and size.bytes <= _LARGE:
        return
    extent = [
        message("{chains:,} chains", chains=size.chains)
        if size.exact
        else message("about {chains:,} chains", chains=round(size.chains, 2 - len(str(size.chains))))
    ]
    if size.bytes:
        extent.append(message("{size} of output", size=_bytes(size.bytes)))
    extent.append(message("about {time}", time=time_text(seconds)))
    if not arguments.yes:
        raise GrueblerError("{extent}; use --yes to run it anyway", extent=joined(extent))
    print(f"gruebler enumerate: {joined(extent).in_language(arguments.lang)}", file=sys.stderr)


def _bytes(size: float) -> str:
    for unit in ("B", "kB", "MB", "GB", "TB"):
        if size < 1000:
            return f"{size:.0f} {unit}"
        size /= 1000
    return f"{size:.0f} PB"


def _count(
    request: Request, arguments: argparse.Namespace, executor: Callable[[], Executor] | None, size: Estimate
) -> int:
    with run_progress(arguments.lang) as draw:
        count = run_count(
            request,
            orbits=arguments.orbits,
            executor=executor,
            checkpoint=arguments.checkpoint,
            progress=draw,
            expected=size.chains,
        )
    document = count.to_json()
    if request.fractionated == "all":
        document["by_fractionation"] = count.by_fractionation
    if arguments.out is not None:
        write_file(arguments.out, (json.dumps(document, indent=2) + "\n").encode(), arguments.lang)
    elif arguments.json:
        print_json(document)
    else:
        _print_count(count, request, arguments.lang)
    return 0 if count.chains else _say_none(request, arguments.lang)


def _print_count(count: ChainCount, request: Request, lang: str) -> None:
    if count.by_assortment:
        rows = [(",".join(map(str, numbers)), number(n, lang, ",")) for numbers, n in count.by_assortment.items()]
        print_table([translate("binary, ternary, ...", lang), translate("chains", lang)], rows, numbers=(1,))
        print()
    if request.fractionated == "all":
        for kind, chains in count.by_fractionation.items():
            print(f"{_FRACTIONATED[kind].in_language(lang)}: {number(chains, lang, ',')}")
    for name, title in _COUNTS.items():
        if (total := getattr(count, name)) is not None:
            print(f"{title.in_language(lang)}: {number(total, lang, ',')}")


def _list(
    request: Request, form: str, arguments: argparse.Namespace, executor: Callable[[], Executor] | None, size: Estimate
) -> int:
    with (
        run_progress(arguments.lang) as draw,
        closing(
            run_list(
                request, form, executor=executor, checkpoint=arguments.checkpoint, progress=draw, expected=size.chains
            )
        ) as listings,
    ):
        if arguments.out is None and form == "text" and _is_cut(arguments):
            first = _first_chains(listings, request)
        elif arguments.out is None:
            sys.stdout.flush()  # what follows goes past its buffer
            written = _write(listings, form, request, sys.stdout.buffer)
            return 0 if written else _say_none(request, arguments.lang)
        else:
            with atomic_file(arguments.out) as file:
                written = _write(listings, form, request, file)
    if arguments.out is None:
        _print_first(*first, request, size, arguments.lang)
        return 0
    say_written(
        arguments.out, arguments.lang, ", " + plural("{count} chain", "{count} chains", written, arguments.lang)
    )
    return 0 if written else _say_none(request, arguments.lang)


def _is_cut(arguments: argparse.Namespace) -> bool:
    """Whether a person reads the list on a terminal: pipes get all of it, and so do runs that are to be continued."""
    return sys.stdout.isatty() and not arguments.all and arguments.checkpoint is None


def _first_chains(listings: Iterator[PieceListing], request: Request) -> tuple[list[tuple[int, str]], int]:
    """The first lines of a list, each with the number of its chain, and how many chains were seen."""
    lines: list[tuple[int, str]] = []
    last, seen = "", 0
    for listing in listings:
        if listing.chains and (comment := _comment(listing, request)) != last:
            lines.append((seen + 1, comment))
            last = comment
        lines += enumerate(listing.text.decode().splitlines(), seen + 1)
        seen += listing.chains
        if seen > CUT_ABOVE:
            break
    return lines, seen


def _print_first(lines: list[tuple[int, str]], seen: int, request: Request, size: Estimate, lang: str) -> None:
    """Print the first chains, and how many there are besides."""
    shown = seen if seen <= CUT_ABOVE else CUT_TO
    for place, line in lines:
        if place <= shown:
            print(line)
    if not seen:
        _say_none(request, lang)
    elif shown < seen and size.exact:
        more = message("... and {count:,} more chains: --all prints them, -o writes them.")
        print(more.filled(count=size.chains - shown).in_language(lang))
    elif shown < seen:
        print(translate("... and more chains: --all prints them, -o writes them.", lang))


def _comment(listing: PieceListing, request: Request) -> str:
    """The line before chains of a class, where a list has several."""
    return f"# {listing.kind}" if request.fractionated == "all" else ""


def _say_none(request: Request, lang: str) -> int:
    """Say why there is no chain; returns the exit status."""
    values = {"links": request.links, "mobility": request.mobility}
    if (request.links + request.mobility) % 2:
        text = message("there is no such chain of {links} links with mobility {mobility}.")
    else:
        text = message(
            "there is no chain of {links} links with mobility {mobility}: F = 3(n - 1) - 2 g1 makes n + F odd."
        )
    print(f"gruebler enumerate: {text.filled(**values).in_language(lang)}", file=sys.stderr)
    return 1


def _write(listings: Iterator[PieceListing], form: str, request: Request, file: BinaryIO) -> int:
    """Write the chains; returns their number. Text says in a comment where chains of another class begin."""
    written = 0
    last = ""
    for listing in listings:
        if not listing.chains:
            continue
        text = listing.text
        if form == "json":
            file.write(b",\n" if written else b"[\n")
            text = text.rstrip(b"\n").replace(b"\n", b",\n")
        elif form == "text" and (comment := _comment(listing, request)) != last:
            file.write(f"{comment}\n".encode())
            last = comment
        file.write(text)
        written += listing.chains
    if form == "json":
        file.write(b"\n]\n" if written else b"[]\n")
    return written
