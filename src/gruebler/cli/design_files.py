"""Designs written to files: one of them as a linkage, the best as a picture or a page."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TypeVar

from gruebler.base.errors import SynthesisError
from gruebler.cli.output import write_file
from gruebler.design.synthesis import Design, SynthesisResult
from gruebler.design.synthesis.results import MOST_DESIGNS
from gruebler.design.synthesis.specification import Clearance
from gruebler.pictures.canvas.files import SUFFIXES, picture_bytes, suffix_of

_Made = TypeVar("_Made")
_ON_A_PAGE, _IN_A_PICTURE = 24, 6  # designs that are drawn


def design_to_write(arguments: argparse.Namespace, shown: SynthesisResult) -> Design | None:
    """The best design or the one that was asked for; None without a file or a design."""
    return chosen_design(arguments, shown.designs)


def chosen_design(arguments: argparse.Namespace, designs: Sequence[_Made]) -> _Made | None:
    """The first of some designs or the one that was asked for; None without a file or a design."""
    if arguments.out is None or not designs:
        return None
    number, count = 1 if arguments.design is None else arguments.design, len(designs)
    if not 1 <= number <= count:
        raise SynthesisError("--design: expected 1 to {count}, but found {number}", count=count, number=number)
    return designs[number - 1]


def check_demands(arguments: argparse.Namespace) -> None:
    """Refuse numbers that no design could be held to, before the work."""
    if not 0 <= arguments.transmission <= 90:
        raise SynthesisError(
            "--transmission: expected 0 to 90 degrees, but found {transmission:g}", transmission=arguments.transmission
        )
    if not arguments.size_ratio >= 1:
        raise SynthesisError(
            "--size-ratio: expected at least 1, but found {size_ratio:g}", size_ratio=arguments.size_ratio
        )
    if arguments.design is not None and arguments.out is None:
        raise SynthesisError("--design: only with -o")
    for option in ("--number", "--initial-designs", "--design"):
        count = getattr(arguments, option.removeprefix("--").replace("-", "_"), None)
        if count is not None and count < 1:
            raise SynthesisError("{option}: expected at least 1, but found {count}", option=option, count=count)
    if (getattr(arguments, "number", None) or 0) > MOST_DESIGNS:
        raise SynthesisError(
            "{key}: expected a whole number from 1 to {most:,}, but found {found}",
            key="--number",
            most=MOST_DESIGNS,
            found=arguments.number,
        )


def check_picture(path: Path, suffixes: Sequence[str] = (*SUFFIXES, "html")) -> None:
    """Refuse a picture that cannot be written, before the work."""
    suffix_of(path, tuple(suffixes))
    if not path.parent.is_dir():
        raise SynthesisError("{path}: there is no folder {parent!r}", path=path, parent=str(path.parent))


def draw_designs(
    path: Path, result: SynthesisResult, lang: str, *, most: int = 0, clear: Sequence[Clearance] = ()
) -> None:
    """The best designs side by side, or all on a page; so many at most, if there are any."""
    from gruebler.pictures.designs.picture import designs_figure, designs_page

    suffix = suffix_of(path, (*SUFFIXES, "html"))
    if suffix == "html":
        page = designs_page(result, lang=lang, most=min(most or _ON_A_PAGE, _ON_A_PAGE), clear=clear)
        content = page.encode("utf-8")
    else:
        figure = designs_figure(result, lang=lang, most=min(most or _IN_A_PICTURE, _IN_A_PICTURE), clear=clear)
        content = picture_bytes(figure, suffix)
    write_file(path, content, lang)
