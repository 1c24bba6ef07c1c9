"""`gruebler animate`: a linkage that moves by itself, as SVG, as one HTML page with a slider, or as GIF, WebP, APNG."""

from __future__ import annotations

import argparse

from gruebler.cli.draw import entry_of, linkage_and_range, picture_suffix
from gruebler.cli.drive_rows import driven_path
from gruebler.cli.linkage_inputs import with_points
from gruebler.cli.output import print_svg, write_file
from gruebler.cli.parser import Parser
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.linkage.animation import AnimationOptions, animated_svg
from gruebler.pictures.linkage.animation_page import animated_page

_SUFFIXES = ("svg", "html", "gif", "webp", "png")


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Animate a linkage over a full turn of its drive, or back and forth between its limits: as SVG "
        "without scripts, as an HTML page with play, pause and a slider, or as GIF, WebP or APNG.",
        epilog="Example: gruebler animate wiper -o wiper.html --seconds 3. Without -o, the SVG is printed. GIF, WebP "
        "and PNG need matplotlib: pip install 'gruebler[plot]'.",
    )
    parser.take("linkage")
    parser.add_out(help="the file: .svg, .html, .gif, .webp or .png (APNG)")
    parser.take(
        """
        --curve
        --seconds S float =4  duration of a turn, or of back and forth (default: 4)
        --branch
        --range
        --dark  dark background for GIF, WebP and PNG
        """
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the animation into a file, or as SVG on standard output."""
    dark = arguments.dark
    suffix = picture_suffix(arguments.out, dark, _SUFFIXES)
    linkage, between = linkage_and_range(arguments.linkage, arguments.lang)
    linkage = with_points(linkage, arguments.curve)
    record = entry_of(arguments.linkage, arguments.lang)
    options = AnimationOptions(
        branch=arguments.branch,
        between=between,
        drives=driven_path(arguments.range, linkage),
        curves=arguments.curve,
        seconds=arguments.seconds,
        lang=arguments.lang,
        name="" if record is None else record.name.in_language(arguments.lang),
    )
    content = _content(linkage, suffix, options, dark)
    if arguments.out is None:
        print_svg(content.decode("utf-8"))
    else:
        write_file(arguments.out, content, arguments.lang)
    return 0


def _content(linkage: Linkage, suffix: str, options: AnimationOptions, dark: bool) -> bytes:
    if suffix in ("svg", "html"):
        text = animated_svg(linkage, **options) if suffix == "svg" else animated_page(linkage, **options)
        return text.encode("utf-8")
    from gruebler.pictures.linkage.animation_frames import animated_frames

    return animated_frames(linkage, suffix, dark=dark, **options)
