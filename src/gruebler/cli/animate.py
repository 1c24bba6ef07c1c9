"""`gruebler animate`: a linkage that moves by itself, as SVG, as one HTML page with a slider, or as GIF, WebP, APNG."""

from __future__ import annotations

import argparse

from gruebler.cli.draw import entry_of, linkage_and_range, picture_suffix
from gruebler.cli.drive_rows import driven_path
from gruebler.cli.output import print_svg, write_file
from gruebler.drawing.linkage.animation import AnimationOptions, animated_svg
from gruebler.drawing.linkage.animation_page import animated_page
from gruebler.linkages import Linkage

__all__ = ["run"]

_SUFFIXES = ("svg", "html", "gif", "webp", "png")


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
