"""`gruebler enumerate`: every chain of so many links, listed or counted."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import closing, contextmanager
from pathlib import Path
from typing import BinaryIO

from gruebler.atomic_files import atomic_file
from gruebler.cli.inputs import assortment_of
from gruebler.cli.long_work import time_text
from gruebler.cli.output import print_json, say_written, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.enumeration.estimates import Estimate, estimate
from gruebler.enumeration.request import Request, RequestCount
from gruebler.enumeration.run_request import run_count, run_list
from gruebler.enumeration.work_units import PieceListing
from gruebler.enumeration.worker_pool import ProcessPools, Progress
from gruebler.errors import GrueblerError, RunError

__all__ = ["add", "run"]

_LONG = 900.0  # seconds; what takes longer, or fills more than the following, is told and asked for again
_LARGE = 8 * 10**9
_ENDINGS = {".txt": "text", ".g6": "graph6", ".json": "json"}

_WORDS = {
    "en": {
        "none": "not fractionated",
        "link": "fractionated at a link",
        "joint": "fractionated at a joint",
        "assortment": "binary, ternary, ...",
        "chains": "chains",
        "inversions": "inversions (frame)",
        "drives": "driven mechanisms (frame, drive at the frame)",
        "joint_orbits": "joint orbits",
        "found": ", {n} chains",
        "progress": "{pieces} pieces  {chains:,} chains  {rate:,.0f}/s  {left}",
        "left": "about {time} left",
        "size": "{about}{chains:,} chains",
        "bytes": ", {size} of output",
        "time": ", about {time}",
        "refused": "{what}; say --yes to begin it nevertheless",
    },
    "de": {
        "none": "nicht zerlegbar",
        "link": "an einem Glied zerlegbar",
        "joint": "an einem Gelenk zerlegbar",
        "assortment": "binär, ternär, ...",
        "chains": "Ketten",
        "inversions": "Inversionen (Gestell)",
        "drives": "angetriebene Getriebe (Gestell, Antrieb am Gestell)",
        "joint_orbits": "Gelenkklassen (Symmetrie)",
        "found": ", {n} Ketten",
        "progress": "{pieces} Teile  {chains:,} Ketten  {rate:,.0f}/s  {left}",
        "left": "noch etwa {time}",
        "size": "{about}{chains:,} Ketten",
        "bytes": ", {size} Ausgabe",
        "time": ", etwa {time}",
        "refused": "{what}; mit --yes wird trotzdem begonnen",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Planar chains of revolute joints without any rigid part, each once, listed or counted.",
        epilog="Example: gruebler enumerate --links 8 --count --orbits. Killed at any moment, a run with --checkpoint "
        "goes on when the same command is given again.",
    )
    parser.add_argument("--links", type=int, required=True, metavar="N", help="number of links")
    parser.add_argument("--mobility", type=int, default=1, metavar="F", help="mobility (default: 1)")
    parser.add_argument(
        "--fractionated",
        choices=("none", "link", "joint", "all"),
        default="none",
        help="chains that do not fall apart (default), that do at a link only, at some joint, or all of them",
    )
    parser.add_argument("--assortment", metavar="N2,N3,...", help="numbers of binary, ternary, ... links")
    parser.add_argument(
        "--multiple-joints", default="0", metavar="K|any", help="exactly K, K to M (K-M), or any number (default: 0)"
    )
    parser.add_argument("--count", action="store_true", help="only how many, by assortment")
    parser.add_argument("--orbits", action="store_true", help="with --count: inversions and driven mechanisms too")
    parser.add_argument("--format", choices=("text", "graph6", "json"), help="of a list (default: text)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="it appears whole or not at all")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="processes (default: 1)")
    parser.add_argument("--checkpoint", type=Path, metavar="DIR", help="where finished pieces are kept")
    parser.add_argument("--yes", action="store_true", help="begin even if it will be long or large")
    parser.add_argument("--json", action="store_true", help="the count, or the list, as JSON")


def run(arguments: argparse.Namespace) -> int:
    """List or count what the arguments ask for."""
    request = Request(
        arguments.links,
        arguments.mobility,
        arguments.fractionated,
        assortment_of(arguments.assortment),
        arguments.multiple_joints,
    )
    form = None if arguments.count else _format(arguments, request)
    if arguments.orbits and form is not None:
        raise GrueblerError("--orbits goes with --count: it adds the numbers of mechanisms to the number of chains")
    if form is None and arguments.format not in (None, "json"):
        raise GrueblerError(
            "--format {format} goes with a list: a count is a table, or JSON with --json", format=arguments.format
        )
    if form is None and arguments.format == "json":
        arguments.json = True
    if form is None and _form_of_ending(arguments.output) not in (None, "json"):
        raise GrueblerError("{output}: a count is written as JSON; end the name with .json", output=arguments.output)
    if arguments.output is not None and not arguments.output.name:
        raise RunError("--output {output!r} names no file", output=str(arguments.output))
    if arguments.output is not None and not arguments.output.parent.is_dir():
        raise RunError(
            "{output} cannot be written: there is no directory {parent}",
            output=arguments.output,
            parent=arguments.output.parent,
        )
    executor = None if arguments.jobs == 1 else ProcessPools(min(arguments.jobs, 4 * (os.cpu_count() or 1)))
    size = estimate(request, form)
    _check_size(size, arguments)
    if form is None:
        return _count(request, arguments, executor, size)
    return _list(request, form, arguments, executor, size)


def _format(arguments: argparse.Namespace, request: Request) -> str:
    form = arguments.format or ("json" if arguments.json else _form_of_ending(arguments.output) or "text")
    if arguments.json and form != "json":
        raise GrueblerError("--json is the same as --format json and does not go with --format {form}", form=form)
    if form == "graph6" and not request.only_simple:
        raise GrueblerError("graph6 describes chains with simple joints only: take --format text or json here")
    if _form_of_ending(arguments.output) not in (None, form):
        raise GrueblerError(
            "{output}: --format {form} and the ending {suffix} do not agree",
            output=arguments.output,
            form=form,
            suffix=arguments.output.suffix,
        )
    return str(form)


def _form_of_ending(path: Path | None) -> str | None:
    """The format that the name of a file asks for; None without an ending, `GrueblerError` for an unknown one."""
    if path is None or not path.suffix:
        return None
    form = _ENDINGS.get(path.suffix.lower())
    if form is None:
        raise GrueblerError(
            "{path}: chains are written as .txt, .g6 or .json, not as {suffix}", path=path, suffix=path.suffix
        )
    return form


def _check_size(size: Estimate, arguments: argparse.Namespace) -> None:
    """Refuse what would not fit, and say how much it is; say it too where it is begun with --yes."""
    seconds = size.seconds / arguments.jobs
    if seconds <= _LONG and size.bytes <= _LARGE:
        return
    words = _WORDS[arguments.lang]
    what = words["size"].format(about="" if size.exact else "~ ", chains=size.chains)
    if size.bytes:
        what += words["bytes"].format(size=_bytes(size.bytes))
    what += words["time"].format(time=time_text(seconds))
    if not arguments.yes:
        raise GrueblerError(words["refused"].format(what=what))
    print(f"gruebler enumerate: {what}", file=sys.stderr)


def _bytes(number: float) -> str:
    for unit in ("B", "kB", "MB", "GB", "TB"):
        if number < 1000:
            return f"{number:.0f} {unit}"
        number /= 1000
    return f"{number:.0f} PB"


def _count(
    request: Request,
    arguments: argparse.Namespace,
    executor: Callable[[], Executor] | None,
    size: Estimate,
) -> int:
    with _drawn(arguments.lang) as draw:
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
    if arguments.output is not None:
        write_file(arguments.output, (json.dumps(document, indent=2) + "\n").encode(), arguments.lang)
    elif arguments.json:
        print_json(document)
    else:
        _print_count(count, request, arguments.lang)
    return 0


def _print_count(found: RequestCount, request: Request, lang: str) -> None:
    words = _WORDS[lang]
    if found.by_assortment:
        rows = [(",".join(map(str, numbers)), str(n)) for numbers, n in found.by_assortment.items()]
        print_table([words["assortment"], words["chains"]], rows, numbers=(1,))
        print()
    if request.fractionated == "all":
        for kind, number in found.by_fractionation.items():
            print(f"{words[kind]}: {number}")
    for name in ("chains", "inversions", "drives", "joint_orbits"):
        number = getattr(found, name)
        if number is not None:
            print(f"{words[name]}: {number}")


def _list(
    request: Request,
    form: str,
    arguments: argparse.Namespace,
    executor: Callable[[], Executor] | None,
    size: Estimate,
) -> int:
    with (
        _drawn(arguments.lang) as draw,
        closing(
            run_list(
                request,
                form,
                executor=executor,
                checkpoint=arguments.checkpoint,
                progress=draw,
                expected=size.chains,
            )
        ) as listings,
    ):
        if arguments.output is None:
            sys.stdout.flush()  # what follows goes past its buffer
            _write(listings, form, request, sys.stdout.buffer)
            return 0
        with atomic_file(arguments.output) as file:
            number = _write(listings, form, request, file)
    say_written(arguments.output, arguments.lang, _WORDS[arguments.lang]["found"].format(n=number))
    return 0


def _write(listings: Iterator[PieceListing], form: str, request: Request, file: BinaryIO) -> int:
    """Write the chains; returns their number. Text says in a comment where chains of another class begin."""
    number = 0
    last = ""
    for listing in listings:
        if not listing.chains:
            continue
        text = listing.text
        if form == "json":
            file.write(b",\n" if number else b"[\n")
            text = text.rstrip(b"\n").replace(b"\n", b",\n")
        elif form == "text" and request.fractionated == "all" and listing.kind != last:
            file.write(f"# {listing.kind}\n".encode())
            last = listing.kind
        file.write(text)
        number += listing.chains
    if form == "json":
        file.write(b"\n]\n" if number else b"[]\n")
    return number


@contextmanager
def _drawn(lang: str) -> Iterator[Callable[[Progress], None] | None]:
    """Something that draws the progress on a terminal; None elsewhere."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.live import Live
    from rich.text import Text

    words = _WORDS[lang]
    # Without a thread of its own, so that worker processes can be forked.
    with Live(console=Console(stderr=True), auto_refresh=False, transient=True) as live:
        shown = 0.0

        def draw(progress: Progress) -> None:
            nonlocal shown
            if progress.seconds - shown < 0.2:
                return
            shown = progress.seconds
            seconds = progress.seconds_left
            left = "" if seconds is None else words["left"].format(time=time_text(seconds))
            line = words["progress"].format(
                pieces=progress.pieces, chains=progress.chains, rate=progress.rate, left=left
            )
            live.update(Text(line), refresh=True)

        yield draw
