"""What the sheet of a machine in space says of its motion and dimensions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.text import error_in_language, translate
from gruebler.mechanics.screws import SpatialLinkage, freedoms
from gruebler.mechanics.space import assembly_modes, measures
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.space import plot_point, plot_spatial
from gruebler.structure.chain.pairs import Alphabet
from gruebler.teaching.worksheets.blocks import Block, Heading, Paragraph, Pictures, Rows
from gruebler.teaching.worksheets.places_in_space import headers_in_space, lengths_in_space, places_in_space

_DIAGRAMS = 2  # drives over which the output is shown


def blocks_in_space(linkage: SpatialLinkage, lang: str, between: tuple[float, float] | None) -> Iterator[Block]:
    """Mobility, measures, assembly modes, dimensions, places in the reference pose, the diagram of the output.

    ``between`` are the values of its drive, in radians or the unit, over which the diagram goes. Cost: 1 to 3 s.
    """
    yield Heading(translate("Values", lang))
    yield Paragraph("\n".join(_values(linkage, lang)))
    rows = tuple(lengths_in_space(linkage, lang))
    if rows:
        yield Heading(translate("Dimensions in {unit} and degrees", lang, unit=linkage.unit))
        heads = ("link", "joints or points", "distance", "angle")
        yield Rows(tuple(translate(head, lang) for head in heads), rows)
    yield Heading(translate("Places in the reference pose, in {unit} and degrees", lang, unit=linkage.unit))
    yield Paragraph(translate("All drives are 0 here; axes may have any length.", lang))
    yield Rows(headers_in_space(lang), tuple(places_in_space(linkage, lang)))
    diagrams = dict(_diagrams(linkage, between, lang))
    if diagrams:
        yield Heading(translate("Main diagram", lang))
    for caption, diagram in diagrams.items():
        yield Pictures((diagram,), (caption,) if len(linkage.mechanism.drives) > 1 else (), 420.0)


def _diagrams(linkage: SpatialLinkage, between: tuple[float, float] | None, lang: str) -> Iterator[tuple[str, Figure]]:
    """The output over the drive, or over each of two; of more drives only over the first.

    Where no joint measures the output (a platform on balls), the places of its named points.
    """
    names = linkage.mechanism.drive_names(Alphabet.of_language(lang))
    of_one = linkage.mechanism.drive_names()
    for number, drive in enumerate(of_one[: 1 if len(names) > _DIAGRAMS else None]):
        caption = translate("{drive} moves; the other drives stay at 0", lang, drive=names[number])
        try:
            yield caption, plot_spatial(linkage, drive=drive, between=None if number else between, lang=lang)
        except GrueblerError:
            if between is None or number:
                continue
            for point in linkage.points:
                yield f"{point}: {caption}", plot_point(linkage, point, between, lang=lang)


def _values(linkage: SpatialLinkage, lang: str) -> Iterator[str]:
    """The four numbers of mobility, what is idle, what the one drive does, how many assembly modes there are."""
    yield freedoms(linkage).summary(lang)
    drives = linkage.mechanism.drives
    if len(drives) == 1:
        yield measures(linkage).explain(lang)
    try:
        yield assembly_modes(linkage, [np.zeros(len(drives))]).explain(lang)
    except LinkageError as error:
        if drives:
            yield translate("Assembly modes are not known: {reason}.", lang, reason=error_in_language(error, lang))
