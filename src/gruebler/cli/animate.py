"""`gruebler animate`: a linkage that moves by itself, as SVG, as one HTML page with a slider, or as GIF, WebP, APNG."""

from __future__ import annotations

import argparse

from gruebler.base.errors import GrueblerError
from gruebler.cli.draw import entry_of, linkage_and_range, picture_path, picture_suffix
from gruebler.cli.drive_rows import driven_path
from gruebler.cli.linkage_inputs import SpatialWord, loads_and_speed, spatial_of_word, with_points
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
        --loads
        --curve
        --seconds S float =4  duration of a turn, or of back and forth (default: 4)
        --branch
        --range
        --view
        --dark  dark background for GIF, WebP and PNG
        """
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the animation into a file, on a terminal into a new one; else as SVG on standard output."""
    dark = arguments.dark
    arguments.out = picture_path(arguments.out, arguments.linkage, "moving")
    suffix = picture_suffix(arguments.out, dark, _SUFFIXES)
    record = entry_of(arguments.linkage, arguments.lang)
    name = "" if record is None else record.name.in_language(arguments.lang)
    spatial = spatial_of_word(arguments.linkage, arguments.lang)
    if spatial is not None:
        content = _in_space(arguments, spatial, suffix, name)
        return _written(arguments, content)
    if arguments.view:
        raise GrueblerError("--view needs a linkage in space or on the sphere with the screws of its joints")
    linkage, between = linkage_and_range(arguments.linkage, arguments.lang)
    linkage = with_points(linkage, arguments.curve)
    loads, speed = loads_and_speed(arguments.linkage, arguments.lang) if arguments.loads else (None, None)
    options = AnimationOptions(
        branch=arguments.branch,
        between=between,
        loads=loads,
        speed=speed,
        drives=driven_path(arguments.range, linkage),
        curves=arguments.curve,
        seconds=arguments.seconds,
        lang=arguments.lang,
        name=name,
    )
    return _written(arguments, _content(linkage, suffix, options, dark))


def _written(arguments: argparse.Namespace, content: bytes) -> int:
    if arguments.out is None:
        print_svg(content.decode("utf-8"))
    else:
        write_file(arguments.out, content, arguments.lang)
    return 0


def _in_space(arguments: argparse.Namespace, spatial: SpatialWord, suffix: str, name: str) -> bytes:
    from gruebler.pictures.canvas.moving_files import moving_bytes
    from gruebler.pictures.space import animate_spatial

    for option in ("branch", "loads"):
        if getattr(arguments, option):
            raise GrueblerError("--{option} does not go with a linkage in space", option=option)
    own = spatial.range is not None and not arguments.range
    rows = None if own else driven_path(arguments.range, spatial.linkage)
    shown = animate_spatial(
        spatial.linkage,
        between=spatial.range,
        drives=rows,
        curves=arguments.curve,
        view=arguments.view or "",
        seconds=arguments.seconds,
        lang=arguments.lang,
        name=name,
    )
    return moving_bytes(shown, suffix, dark=arguments.dark, lang=arguments.lang)


def _content(linkage: Linkage, suffix: str, options: AnimationOptions, dark: bool) -> bytes:
    if suffix in ("svg", "html"):
        text = animated_svg(linkage, **options) if suffix == "svg" else animated_page(linkage, **options)
        return text.encode("utf-8")
    from gruebler.pictures.linkage.animation_frames import animated_frames

    return animated_frames(linkage, suffix, dark=dark, **options)
