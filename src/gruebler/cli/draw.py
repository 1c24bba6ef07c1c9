"""`gruebler draw`: the structure picture of a chain or mechanism, its graph, contracted graph or loops; or a linkage.

What has sizes is drawn to scale: files, lengths such as four-bar:25,70,40,70, and entries of the catalog when a pose, a
curve or something else of the motion is asked for.
"""

from __future__ import annotations

import argparse
import math
import sys
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from gruebler.catalog import entries
from gruebler.chain import Chain
from gruebler.cli.inputs import chain_from_word, is_text, mechanism_of
from gruebler.cli.linkage_inputs import linkage_of
from gruebler.cli.output import print_svg, write_file
from gruebler.cli.parser import Parser
from gruebler.drawing.canvas import Figure
from gruebler.drawing.canvas.files import SUFFIXES, picture_bytes, suffix_of
from gruebler.drawing.structure import draw, draw_contracted, draw_graph, draw_loops
from gruebler.errors import GrueblerError
from gruebler.formats import Entry
from gruebler.linkages import Linkage
from gruebler.mechanism import Mechanism
from gruebler.text import message

__all__ = ["add", "entry_of", "german", "linkage_and_range", "picture_suffix", "run", "subject", "told_picture"]

_VIEWS: dict[str, Callable[..., Figure]] = {
    "graph": draw_graph,
    "contracted": draw_contracted,
    "loops": draw_loops,
}


_OF_MOTION: Mapping[str, Any] = {"pose": None, "curve": [], "show": [], "ghosts": None, "branch": None, "of": None}
"""Options that only linkages have."""
_OF_A_LINK = ("dead-centres", "transmission", "centrodes", "inflection")
"""What is shown of the link named by --of."""


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="The structure picture of a chain or mechanism: links as bodies, joints by their signs, the frame "
        "hatched, drives as arrows. With --pose, --curve, --show or --ghosts, or of a linkage: to scale.",
        epilog="Without -o the SVG goes to standard output. PNG and PDF need matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.add_argument(
        "chain",
        metavar="CHAIN|ID|FILE",
        help="a text, a code, g6:CODE, the id of a catalog entry, the file of a linkage, or lengths such as "
        "four-bar:25,70,40,70",
    )
    parser.add_argument(
        "--pose",
        nargs="?",
        const="",
        metavar="VALUE[,VALUE]",
        help="to scale, at this drive value (degrees, or a way; --pose=-30,20 for several drives); alone: a good pose",
    )
    parser.add_argument(
        "--curve", action="append", default=[], metavar="POINT", help="the path of a point or joint; repeatable"
    )
    parser.add_argument(
        "--show",
        action="append",
        default=[],
        choices=(
            "dead-centres",
            "transmission",
            "velocities",
            "accelerations",
            "poles",
            "centrodes",
            "inflection",
            "dimensions",
            "scale",
        ),
        help="also show this; repeatable",
    )
    parser.add_argument("--ghosts", type=int, metavar="N", help="so many other positions thinly, for print")
    parser.add_argument(
        "--of", metavar="LINK", help="the link whose dead centres, transmission angle, centrodes, ... are shown"
    )
    parser.add_argument("--branch", metavar="LABELS", help="the assembly mode, such as +- (write --branch=-+)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="a file .svg, .png or .pdf")
    parser.add_argument("--space", choices=("planar", "spherical", "spatial"), help="where a text lives")
    parser.add_argument("--frame", metavar="LINK", help="the link that stands still")
    parser.add_argument("--drive", action="append", default=[], metavar="JOINT", help="a driven joint; repeatable")
    parser.add_argument("--labels", action="store_true", help="name the links")
    parser.add_argument("--dark", action="store_true", help="PNG and PDF on dark ground; an SVG is on the reader's")
    view = parser.add_mutually_exclusive_group()
    view.add_argument("--graph", action="store_true", help="the link graph instead")
    view.add_argument("--contracted", action="store_true", help="the contracted graph instead")
    view.add_argument("--loops", action="store_true", help="mark the independent loops")


def run(arguments: argparse.Namespace) -> int:
    """Draw one chain, mechanism or linkage into a file, or as SVG on standard output."""
    suffix = picture_suffix(arguments.output, getattr(arguments, "dark", False))
    figure = _figure(arguments)
    told_picture(figure, arguments.output, suffix, getattr(arguments, "dark", False), arguments.lang)
    return 0


def picture_suffix(path: Path | None, dark: bool, known: tuple[str, ...] = SUFFIXES) -> str:
    """The kind of file that is asked for; `GrueblerError` for a dark ground that it has not."""
    suffix = "svg" if path is None else suffix_of(path, known)
    if dark and suffix in ("svg", "html"):
        raise GrueblerError(
            "--dark is for pictures of pixels and PDF: {upper} is on the ground of its reader, light or dark",
            upper=suffix.upper(),
        )
    return suffix


_LETTERS = {
    "en": "some letters are missing in the font of PNG and PDF; an SVG has them",
    "de": "einige Buchstaben fehlen in der Schrift von PNG und PDF; ein SVG hat sie",
}


def told_picture(figure: Figure, path: Path | None, suffix: str, dark: bool, lang: str) -> None:
    """Write a picture into a file, or as SVG on standard output; say what could not be shown on standard error."""
    notes = list(figure.notes)
    if path is None:
        print_svg(figure.svg())
    else:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            content = picture_bytes(figure, suffix, dark=dark)
        if any("missing from" in str(one.message) for one in caught):
            notes.append(_LETTERS[lang])
        write_file(path, content, lang)
    for note in notes:
        print(note, file=sys.stderr)


def _figure(arguments: argparse.Namespace) -> Figure:
    moving = {key: getattr(arguments, key, none) for key, none in _OF_MOTION.items()}
    view = next((_VIEWS[key] for key in _VIEWS if getattr(arguments, key)), None)
    asked = [f"--{key}" for key, none in _OF_MOTION.items() if moving[key] != none]
    if view is not None and asked:
        raise GrueblerError("graphs and loops show no sizes: they do not go together with {asked}", asked=asked[0])
    if view is not None and arguments.labels:
        raise GrueblerError("--labels names the links of a picture of bodies; graphs and loops name them by themselves")
    if moving["of"] is not None and not set(moving["show"]) & set(_OF_A_LINK):
        shown = ", ".join(_OF_A_LINK)
        raise GrueblerError("--of says of which link something is shown: it goes with --show {shown}", shown=shown)
    has_sizes = _has_sizes(arguments.chain)
    if view is None and (has_sizes or asked):
        return _to_scale(arguments, moving)
    record = entry_of(arguments.chain)
    name = "" if record is None else record.name.in_language(arguments.lang)
    if has_sizes:
        thing: Chain | Mechanism = linkage_of(arguments.chain)[0].mechanism
    else:
        thing = subject(arguments.chain, arguments.space, arguments.frame, arguments.drive)
    if view is not None:
        return view(thing, lang=arguments.lang, name=name)
    return draw(thing, labels=arguments.labels, lang=arguments.lang, name=name, names=german(record, arguments.lang))


def _to_scale(arguments: argparse.Namespace, moving: Mapping[str, Any]) -> Figure:
    from gruebler.drawing.linkage.picture import draw_linkage

    for option in ("space", "frame", "drive"):
        if getattr(arguments, option):
            raise GrueblerError(
                "a linkage with sizes has its own frame and drives: it is drawn without --{option}", option=option
            )
    linkage, between = linkage_and_range(arguments.chain)
    record = entry_of(arguments.chain)
    return draw_linkage(
        linkage,
        _pose(linkage, moving["pose"]),
        branch=moving["branch"],
        between=between,
        curves=moving["curve"],
        show=moving["show"],
        output=moving["of"],
        ghost=moving["ghosts"],
        labels=arguments.labels,
        lang=arguments.lang,
        name="" if record is None else record.name.in_language(arguments.lang),
        names=german(record, arguments.lang),
    )


def linkage_and_range(word: str) -> tuple[Linkage, tuple[float, float] | None]:
    """The linkage of a word, and the drive values between which it is shown, in radians where the drive turns."""
    linkage, shown = linkage_of(word)
    drives = linkage.mechanism.drives
    if shown is None or not drives or not drives[0].turning:
        return linkage, shown
    return linkage, (math.radians(shown[0]), math.radians(shown[1]))


def _has_sizes(word: str) -> bool:
    """Whether a word stands for a linkage without being asked: a file, or lengths."""
    if is_text(word) or word in entries():
        return False
    return ":" in word or Path(word).suffix.lower() in (".toml", ".json") or Path(word).is_file()


def _pose(linkage: Linkage, text: str | None) -> list[float] | None:
    """Drive values, in radians where the drive turns; None for the linkage's own pose."""
    if not text:
        return None
    drives = linkage.mechanism.drives
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != len(drives) or not all(math.isfinite(value) and abs(value) < 1e9 for value in values):
        raise GrueblerError(
            "--pose: expected {numbers}, degrees where a drive turns, but found {found!r}",
            numbers=message("one number")
            if len(drives) == 1
            else message("{count} numbers with commas", count=len(drives)),
            found=text,
        )
    turning = [drive.turning for drive in drives]
    return [math.radians(value) if turns else value for value, turns in zip(values, turning, strict=True)]


def entry_of(word: str) -> Entry | None:
    """The catalog entry of that name, if there is one."""
    return None if is_text(word) else entries().get(word)


def german(record: Entry | None, lang: str) -> Mapping[str, str]:
    """What a catalog entry calls its links in this language."""
    return record.links if record is not None and lang == "de" else {}


def subject(word: str, space: str | None, frame: str | None, drives: list[str]) -> Chain | Mechanism:
    """What a word stands for: a mechanism if it, or an option, says which link stands still, else a chain."""
    record = None if is_text(word) else entries().get(word)
    marked = ";" in word if record is None else record.frame is not None
    if marked and space is None:
        return mechanism_of(word, frame, drives)
    chain = chain_from_word(word, space)
    if frame is None and not drives:
        return chain
    return Mechanism(chain, chain.links[0] if frame is None else frame, drives)
