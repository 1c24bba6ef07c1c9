"""`gruebler curve --straight`: how straight the path of a point is."""

from __future__ import annotations

import argparse
import math

from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.base.text import translate
from gruebler.cli.coupler_inputs import coupler_point
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import linkage_of_word
from gruebler.cli.output import print_json
from gruebler.cli.point_inputs import point_of
from gruebler.files.measured_lengths import length_of, same_unit
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.fourbar.length_texts import size_of
from gruebler.mechanics.geometry.straight import (
    Path,
    PathPiece,
    coupler_path,
    linkage_path,
    longest_piece,
    path_piece,
    piece_of_ratio,
)

_FROM_LIMITS = 1e-9  # of the range: a limit of the drive is approached so far


def run(arguments: argparse.Namespace) -> int:
    """The piece asked for; status 1 if there is none."""
    lang, centre = arguments.lang, 180.0 if arguments.centre is None else arguments.centre
    piece = _piece(arguments, centre)
    if piece is None:
        print(
            translate(
                "Every window up to a full turn about {centre:g}° is straighter than Q_G = {ratio:g}.",
                lang,
                centre=centre,
                ratio=arguments.ratio,
            )
        )
        return 1
    start, end = math.degrees(piece.start), math.degrees(piece.end)
    if arguments.json:
        print_json(plain(piece, "start_deg end_deg length band ratio direction_deg"))
        return 0
    print(translate("crank angle: {start:n}° to {end:n}° ({width:n}°)", lang, start=start, end=end, width=end - start))
    print(translate("length along the line: {length:n}", lang, length=piece.length))
    print(translate("band across the line: {band:n}", lang, band=piece.band))
    print(translate("relative deviation Q_G: {ratio:n}", lang, ratio=piece.ratio))
    print(translate("direction of the line: {angle:n}°", lang, angle=round(math.degrees(piece.direction), 9) % 180))
    return 0


def _piece(arguments: argparse.Namespace, centre: float) -> PathPiece | None:
    path, unit, ranges = _path(arguments, math.radians(centre))
    direction = None if arguments.direction is None else math.radians(arguments.direction)
    if sum(given is not None for given in (arguments.ratio, arguments.band, arguments.window)) != 1:
        raise GrueblerError("--straight: give one of --ratio Q, --band WIDTH and --window FROM TO")
    if arguments.ratio is not None:
        return piece_of_ratio(path, math.radians(centre), arguments.ratio, direction)
    if arguments.window is not None:
        first, last = arguments.window
        if not 0 < abs(last - first) <= 360:
            raise GrueblerError(
                "--window: expected two crank angles at most a full turn apart, but found {first:g} and {last:g}",
                first=first,
                last=last,
            )
        return path_piece(path, math.radians(first), math.radians(last), direction)
    if direction is not None:
        raise GrueblerError("--direction does not go with --band, which finds the best line")
    if not ranges:
        raise GrueblerError("{lengths} cannot be assembled in any position", lengths=arguments.linkage)
    band, band_unit = length_of("--band", arguments.band)
    width = same_unit(band, band_unit, unit) if band_unit and unit else band  # lengths have the unit of the band
    return max((longest_piece(path, *ends, width) for ends in ranges), key=lambda piece: piece.length)


def _path(arguments: argparse.Namespace, centre: float) -> tuple[Path, str, list[tuple[float, float]]]:
    """The path of the point over crank angles, the unit of length, and the ranges of the crank."""
    turn = (centre - math.pi, centre + math.pi)
    if (size := size_of(arguments.linkage)) is not None:
        path = coupler_path(size, *coupler_point(size, arguments.point), branch=arguments.branch)
        return path, "", [turn if arc.full else (arc.start, arc.end) for arc in size.limits]
    linkage, _ = linkage_of_word(arguments.linkage, language_of_names(arguments))
    span = drive_cycle(linkage, branch=arguments.branch).span
    if not linkage.mechanism.drives[0].turning:
        raise GrueblerError("--straight needs a driven joint that turns")
    margin = _FROM_LIMITS * span.width
    ends = turn if span.full else (span.low + margin, span.high - margin)
    return linkage_path(linkage, point_of(arguments.point), branch=arguments.branch), linkage.unit, [ends]
