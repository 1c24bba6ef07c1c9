"""Designs written to files: one of them as a linkage, the best as a picture or a page."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from gruebler.base.errors import SynthesisError
from gruebler.cli.output import write_file
from gruebler.design.synthesis import Design, SynthesisResult
from gruebler.design.synthesis.specification import Clearance
from gruebler.pictures.canvas.files import SUFFIXES, picture_bytes, suffix_of

_ON_A_PAGE, _IN_A_PICTURE = 24, 6  # designs that are drawn


def design_to_write(arguments: argparse.Namespace, shown: SynthesisResult) -> Design | None:
    """The best design or the one that was asked for; None without a file or a design."""
    if arguments.out is None or not shown.designs:
        return None
    number, count = 1 if arguments.design is None else arguments.design, len(shown.designs)
    if not 1 <= number <= count:
        raise SynthesisError("--design: expected 1 to {count}, but found {number}", count=count, number=number)
    return shown.designs[number - 1]


def check_picture(path: Path) -> None:
    """Refuse a picture that cannot be written, before the work."""
    suffix_of(path, (*SUFFIXES, "html"))
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
