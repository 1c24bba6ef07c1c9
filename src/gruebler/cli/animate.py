"""`gruebler animate`: a linkage that moves by itself, as SVG, as one HTML page with a slider, or as GIF, WebP, APNG."""

from __future__ import annotations

import argparse
from pathlib import Path

from gruebler.cli.draw import entry_of, linkage_and_range, picture_suffix
from gruebler.cli.drive_rows import add_drive_path, driven_path
from gruebler.cli.output import print_svg, write_file
from gruebler.cli.parser import Parser
from gruebler.drawing.linkage.animation import AnimationOptions, animated_svg
from gruebler.drawing.linkage.animation_page import animated_page
from gruebler.linkages import Linkage

__all__ = ["add", "run"]

_SUFFIXES = ("svg", "html", "gif", "webp", "png")


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A full turn of the drive, or to and fro where it has limits, over and over. SVG without script; "
        "one HTML page with play, pause and a slider for the drive; pictures as .gif, .webp or .png (APNG).",
        epilog="Example: gruebler animate wiper -o wiper.html --seconds 3. Without -o the SVG goes to standard output. "
        "GIF, WebP and PNG need matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.add_argument(
        "linkage", metavar="FILE|ID", help="a file, a catalog entry, or lengths such as four-bar:25,70,40,70"
    )
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="a file .svg, .html, .gif, .webp or .png (APNG)"
    )
    parser.add_argument(
        "--curve", action="append", default=[], metavar="POINT", help="the path of a point or joint; repeatable"
    )
    parser.add_argument(
        "--seconds", type=float, default=4.0, metavar="S", help="for a turn, or for there and back (default: 4)"
    )
    parser.add_argument("--branch", metavar="LABELS", help="the assembly mode, such as +-")
    add_drive_path(parser)
    parser.add_argument("--dark", action="store_true", help="GIF, WebP and PNG on dark ground")


def run(arguments: argparse.Namespace) -> int:
    """Write the animation into a file, or as SVG on standard output."""
    dark = getattr(arguments, "dark", False)
    suffix = picture_suffix(arguments.output, dark, _SUFFIXES)
    linkage, between = linkage_and_range(arguments.linkage)
    record = entry_of(arguments.linkage)
    options = AnimationOptions(
        branch=arguments.branch,
        between=between,
        drives=driven_path(arguments.drive, linkage),
        curves=arguments.curve,
        seconds=arguments.seconds,
        lang=arguments.lang,
        name="" if record is None else record.name.in_language(arguments.lang),
    )
    content = _content(linkage, suffix, options, dark)
    if arguments.output is None:
        print_svg(content.decode("utf-8"))
    else:
        write_file(arguments.output, content, arguments.lang)
    return 0


def _content(linkage: Linkage, suffix: str, options: AnimationOptions, dark: bool) -> bytes:
    if suffix in ("svg", "html"):
        text = animated_svg(linkage, **options) if suffix == "svg" else animated_page(linkage, **options)
        return text.encode("utf-8")
    from gruebler.drawing.linkage.animation_frames import animated_frames

    return animated_frames(linkage, suffix, dark=dark, **options)
