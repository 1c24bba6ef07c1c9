"""`gruebler draw`: the structure picture of a chain or mechanism, its graph, contracted graph or loops; or a linkage.

Files, lengths such as four-bar:25,70,40,70 and catalog entries with dimensions are drawn to scale.
"""

from __future__ import annotations

import argparse
import math
import re
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from itertools import chain, count
from pathlib import Path
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import joined, translate
from gruebler.cli.arguments import take
from gruebler.cli.drive_rows import pose_of
from gruebler.cli.inputs import chain_from_word, mechanism_of
from gruebler.cli.linkage_inputs import SpatialWord, linkage_of_word, loads_and_speed, spatial_of_word, with_points
from gruebler.cli.output import print_svg, write_file
from gruebler.cli.parser import Parser
from gruebler.files import Entry
from gruebler.files.structures import is_structure_text
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.canvas import Figure
from gruebler.pictures.canvas.files import SUFFIXES, picture_bytes, suffix_of
from gruebler.pictures.canvas.textbook import textbook
from gruebler.pictures.structure import (
    draw_block,
    draw_contracted,
    draw_graph,
    draw_loops,
    draw_side_view,
    draw_structure,
)
from gruebler.structure.chain import Chain
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries

_VIEWS: dict[str, Callable[..., Figure]] = {
    "graph": draw_graph,
    "contracted": draw_contracted,
    "loops": draw_loops,
    "side": draw_side_view,
    "block": draw_block,
}


_OF_MOTION: Mapping[str, Any] = {
    "at": None,
    "loads": False,
    "curve": [],
    "show": [],
    "ghosts": None,
    "branch": None,
    "output": None,
}
"""Options that only linkages have."""
_OF_A_LINK = ("dead-centres", "transmission", "centrodes", "inflection")
"""What is shown of the link named by --output."""


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Draw the structure of a chain or mechanism: links as bodies, joints by their symbols, the frame "
        "hatched, drives as arrows. Linkages and catalog entries with dimensions are drawn to scale; with --structure "
        "entries are not.",
        epilog="Examples: gruebler draw geartrain -o geartrain.svg; gruebler draw four-bar:25,70,40,70 --at 30 --show "
        "poles. Without -o, the SVG goes to standard output, on a "
        "terminal into a new file. PNG and PDF need matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.take(
        """
        chain CHAIN|ID|FILE  a chain such as 'R(0-1) R(1-2) R(2-3) R(3-0)', a code, g6:CODE, a catalog entry, a linkage
            file, or lengths such as four-bar:25,70,40,70
        --at VALUE[,VALUE] ? :  draw to scale, in the pose at these drive values, in degrees or the unit (--at=-30,20
            for two drives; without a value: a typical pose)
        --loads
        --curve
        --show {dead-centres,transmission,velocities,accelerations,poles,centrodes,inflection,planes,dimensions,scale}
            {joints,angles,lengths} ...  also draw this (repeatable)
        --ghosts N int  also draw N other positions in thin lines
        --output LINK  the output link: its dead centres, transmission angle, centrodes or inflection circle are drawn
        --branch
        """
    )
    parser.add_out(help="the picture: .svg, .png, .pdf, or .tex for TikZ")
    parser.take(
        """
        --space
        --frame
        --drive
        --labels
        --names joints|NAME,...  joints: letters A₀, A, B, B₀ at the joints of a linkage; or own names of its turning
            joints in their order, such as O2,A,B,O4
        --angles  mark the angles φ, ψ and μ of a linkage
        --lengths {letters,values}  write the lengths of a linkage as letters or as dimensions
        --style {colour,textbook} =colour  textbook: black, lines of 0.7 and 0.35 mm
        --view
        --dark  dark background for PNG and PDF
        """
    )
    take(
        parser.add_mutually_exclusive_group(),
        """
        --structure
        --graph  draw the link graph instead
        --contracted  draw the contracted graph instead
        --loops  draw the independent loops instead
        --side  draw a gear train from the side, its axes as lines; bevel wheels also from the front
        --block  draw drive, mechanism and output as blocks instead
        """,
    )


def run(arguments: argparse.Namespace) -> int:
    """Draw one chain, mechanism or linkage into a file, or as SVG on standard output."""
    view = [key for key in _VIEWS if getattr(arguments, key)]
    arguments.out = picture_path(arguments.out, arguments.chain, *view)
    suffix = picture_suffix(arguments.out, arguments.dark)
    figure = _figure(arguments)
    if arguments.style == "textbook":
        figure = textbook(figure)
    write_picture(figure, arguments.out, suffix, arguments.dark, arguments.lang)
    return 0


def picture_path(given: Path | None, word: str, *kind: str) -> Path | None:
    """The file for a picture: the one given, on a terminal a new one in this folder, else None for standard output.

    >>> picture_path(Path("a.svg"), "wiper")
    PosixPath('a.svg')
    """
    if given is not None or not sys.stdout.isatty():
        return given
    word = Path(word).stem if Path(word).is_file() else word
    name = "chain" if "(" in word else re.sub(r"[^\w.]+", "-", word).strip("-.") or "picture"
    stem = "-".join([name[:60], *kind])
    names = chain([stem], (f"{stem}-{number}" for number in count(2)))
    return next(path for name in names if not (path := Path(f"{name}.svg")).exists())


def picture_suffix(path: Path | None, dark: bool, known: tuple[str, ...] = SUFFIXES) -> str:
    """The kind of the file; `GrueblerError` for --dark with SVG or HTML, which follow their viewer's dark mode."""
    suffix = "svg" if path is None else suffix_of(path, known)
    if dark and suffix in ("svg", "html"):
        raise GrueblerError(
            "--dark does not go with {kind}: its colours follow the viewer's light or dark mode", kind=suffix.upper()
        )
    return suffix


def write_picture(figure: Figure, path: Path | None, suffix: str, dark: bool, lang: str) -> None:
    """Write a picture into a file, or as SVG on standard output; notes on what is not shown go to standard error."""
    notes = list(figure.notes)
    if path is None:
        print_svg(figure.svg())
    else:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            content = picture_bytes(figure, suffix, dark=dark)
        if any("missing from" in str(warning.message) for warning in caught):
            notes.append(translate("some letters are missing in the font of PNG and PDF; use SVG instead", lang))
        write_file(path, content, lang)
    for note in notes:
        print(note, file=sys.stderr)


def _figure(arguments: argparse.Namespace) -> Figure:
    moving = {key: getattr(arguments, key) for key in _OF_MOTION}
    moving["show"] = [*moving["show"], *_letters(arguments)]
    view = next((_VIEWS[key] for key in _VIEWS if getattr(arguments, key)), None)
    asked = [f"--{key}" for key, none in _OF_MOTION.items() if moving[key] != none]
    if view is draw_block:
        asked = [option for option in asked if option != "--output"]
    if (view is not None or arguments.structure) and asked:
        raise GrueblerError(
            "{option} needs a drawing to scale and does not go with --structure, --graph, --contracted, --loops, "
            "--side and --block",
            option=asked[0],
        )
    if view is not None and arguments.labels:
        raise GrueblerError(
            "--labels does not go with --graph, --contracted, --loops, --side and --block, which always label the links"
        )
    if moving["output"] is not None and view is not draw_block and not set(moving["show"]) & set(_OF_A_LINK):
        raise GrueblerError("--output needs --show {views} or --block", views=joined(_OF_A_LINK, ", "))
    as_it_is = not (arguments.structure or arguments.space or arguments.frame or arguments.drive)
    if as_it_is and view in (None, draw_side_view):
        spatial = spatial_of_word(arguments.chain, arguments.lang)
        if spatial is not None:
            return _in_space(arguments, spatial, moving) if view is None else _bevel_train(arguments, spatial)
    if arguments.view:
        raise GrueblerError("--view needs a linkage in space or on the sphere with the screws of its joints")
    has_sizes = _has_sizes(arguments.chain)
    if view is None and not arguments.structure and (has_sizes or asked or _is_sized_entry(arguments)):
        return _to_scale(arguments, moving)
    record = entry_of(arguments.chain, arguments.lang)
    name, names = called(record, arguments.lang)
    if has_sizes:
        in_space = spatial_of_word(arguments.chain, arguments.lang)
        placed = linkage_of_word(arguments.chain, arguments.lang)[0] if in_space is None else in_space.linkage
        thing: Chain | Mechanism = placed.mechanism
    else:
        thing = subject(arguments.chain, arguments.space, arguments.frame, arguments.drive, arguments.lang)
    if view is draw_block:
        return _block(thing, record, arguments, name, names)
    if view is not None:
        return view(thing, lang=arguments.lang, name=name)
    still = _standing_still(arguments, record)
    contacts = contacts_of(record) if isinstance(thing, Mechanism) else None
    return still or draw_structure(
        thing, labels=arguments.labels, contacts=contacts, lang=arguments.lang, name=name, names=names
    )


def _standing_still(arguments: argparse.Namespace, record: Entry | None) -> Figure | None:
    """The picture of a catalog entry that has places for it alone; None if an option changes its roles."""
    changed = arguments.structure or arguments.space or arguments.frame or arguments.drive
    still = None if record is None or changed else record.in_language(arguments.lang).pictured()
    if still is None:
        return None
    from gruebler.pictures.linkage.picture import draw_linkage

    name, names = called(record, arguments.lang)
    return draw_linkage(still, labels=arguments.labels, lang=arguments.lang, name=name, names=names)


def _letters(arguments: argparse.Namespace) -> list[str]:
    """The layers that --names, --angles and --lengths stand for."""
    lengths = {"letters": ["lengths"], "values": ["dimensions"]}.get(arguments.lengths, [])
    angles = ["angles", "transmission"] if arguments.angles else []
    return [*angles, *lengths, *["joints"] * bool(arguments.names)]


def _is_sized_entry(arguments: argparse.Namespace) -> bool:
    """Whether a catalog entry is drawn as its machine: it has dimensions, and no option changes its roles."""
    record = entry_of(arguments.chain, arguments.lang)
    changed = arguments.space or arguments.frame or arguments.drive
    return record is not None and record.dimensions is not None and not changed


def _block(
    thing: Chain | Mechanism, record: Entry | None, arguments: argparse.Namespace, name: str, names: Mapping[str, str]
) -> Figure:
    """The block picture, with the output that is given, else that of the catalog entry or of the linkage."""
    if isinstance(thing, Chain):
        raise GrueblerError("--block needs a mechanism; give its frame by --frame LINK")
    outputs: Sequence[str] = [] if record is None else record.outputs
    if _has_sizes(arguments.chain):
        outputs = linkage_of_word(arguments.chain, arguments.lang)[0].outputs
    if arguments.output is not None:
        if arguments.output not in thing.chain.links:
            raise GrueblerError(
                "--output {link!r}: expected a link among {links}",
                link=arguments.output,
                links=", ".join(thing.chain.links),
            )
        outputs = [arguments.output]
    return draw_block(thing, outputs=outputs, lang=arguments.lang, name=name, names=names)


def contacts_of(record: Entry | None) -> Mapping[tuple[int, str], str] | None:
    """What the bodies of the higher pairs of a catalog entry are; None without dimensions."""
    if record is None or record.dimensions is None:
        return None
    from gruebler.pictures.linkage.element_pictures import contact_shapes

    return contact_shapes(record.linkage())


def _to_scale(arguments: argparse.Namespace, moving: Mapping[str, Any]) -> Figure:
    from gruebler.pictures.linkage.picture import draw_linkage

    for option in ("space", "frame", "drive"):
        if getattr(arguments, option):
            raise GrueblerError(
                "a linkage with dimensions has its own frame and drives; leave out --{option}", option=option
            )
    linkage, between = linkage_and_range(arguments.chain, arguments.lang)
    linkage = with_points(linkage, moving["curve"])
    loads, speed = loads_and_speed(arguments.chain, arguments.lang) if moving["loads"] else (None, None)
    name, names = called(entry_of(arguments.chain, arguments.lang), arguments.lang)
    return draw_linkage(
        linkage,
        branch=moving["branch"],
        at=pose_of(moving["at"], linkage.mechanism) if moving["at"] else None,
        between=between,
        curves=moving["curve"],
        loads=loads,
        speed=speed,
        show=moving["show"],
        output=moving["output"],
        ghost=moving["ghosts"],
        labels=arguments.labels,
        lang=arguments.lang,
        name=name,
        names=names,
        letters=[] if arguments.names in (None, "joints") else [name.strip() for name in arguments.names.split(",")],
    )


def _in_space(arguments: argparse.Namespace, spatial: SpatialWord, moving: Mapping[str, Any]) -> Figure:
    """The picture of a linkage in space, in isometric or oblique view."""
    from gruebler.pictures.space import draw_spatial

    asked = {key: moving[key] for key in ("loads", "ghosts", "branch", "output")}
    asked |= {key: getattr(arguments, key) for key in ("show", "names", "angles", "lengths")}
    for option, given in asked.items():
        if given not in (None, [], False):
            raise GrueblerError("--{option} does not go with a linkage in space", option=option)
    name, names = called(entry_of(arguments.chain, arguments.lang), arguments.lang)
    return draw_spatial(
        spatial.linkage,
        at=pose_of(moving["at"], spatial.linkage.mechanism) if moving["at"] else None,
        between=spatial.range,
        curves=moving["curve"],
        view=arguments.view or "",
        labels=arguments.labels,
        lang=arguments.lang,
        name=name,
        names=names,
    )


def _bevel_train(arguments: argparse.Namespace, spatial: SpatialWord) -> Figure:
    """Bevel wheels from the side and along their axis."""
    from gruebler.mechanics.screws.wheels import bevel_train
    from gruebler.pictures.machines.train_picture import draw_train

    name, _ = called(entry_of(arguments.chain, arguments.lang), arguments.lang)
    return draw_train(bevel_train(spatial.linkage), lang=arguments.lang, name=name)


def linkage_and_range(word: str, lang: str = "en", *, unit: str = "") -> tuple[Linkage, tuple[float, float] | None]:
    """The linkage of a word, and the drive values between which it is shown, in radians where the drive turns."""
    linkage, shown = linkage_of_word(word, lang, unit=unit)
    drives = linkage.mechanism.drives
    if shown is None or not drives or not drives[0].turning:
        return linkage, shown
    return linkage, (math.radians(shown[0]), math.radians(shown[1]))


def _has_sizes(word: str) -> bool:
    """Whether a word always stands for a linkage with dimensions: a file, or lengths."""
    if is_structure_text(word) or word in entries():
        return False
    return ":" in word or Path(word).suffix.lower() in (".toml", ".json") or Path(word).is_file()


def entry_of(word: str, lang: str = "en") -> Entry | None:
    """The catalog entry of that name, if there is one, its links by their names in the language."""
    return None if is_structure_text(word) or word not in entries() else entries()[word].in_language(lang)


def called(record: Entry | None, lang: str) -> tuple[str, Mapping[str, str]]:
    """What a catalog entry is called in a language, and its links; nothing without an entry."""
    return ("", {}) if record is None else (record.name.in_language(lang), record.link_names(lang))


def subject(word: str, space: str | None, frame: str | None, drives: list[str], lang: str = "en") -> Chain | Mechanism:
    """What a word stands for: a mechanism if it, or an option, says which link stands still, else a chain."""
    record = None if is_structure_text(word) else entries().get(word)
    marked = ";" in word if record is None else record.frame is not None
    if marked and space is None:
        return mechanism_of(word, frame, drives, lang)
    chain = chain_from_word(word, space, lang)
    if frame is None and not drives:
        return chain
    return Mechanism(chain, chain.links[0] if frame is None else frame, drives)
