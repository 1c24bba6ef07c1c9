"""`gruebler straight`: how straight a coupler curve is."""

from __future__ import annotations

import argparse
import math

from gruebler.cli.coupler_inputs import add_coupler_point, coupler_point, sizes
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.errors import GrueblerError
from gruebler.geometry.straight import PathPiece, coupler_path, longest_piece, path_piece, piece_of_ratio

__all__ = ["add", "run"]

_WORDS = {
    "en": {
        "angles": "crank angle",
        "window": "{start:.6f}° to {end:.6f}° ({width:.6f}°)",
        "length": "length along the line",
        "band": "band across the line",
        "ratio": "relative deviation Q_G",
        "direction": "direction of the line",
        "none": "Every window up to a full turn about {centre:g}° is straighter than Q_G = {ratio:g}.",
    },
    "de": {
        "angles": "Kurbelwinkel",
        "window": "{start:.6f}° bis {end:.6f}° ({width:.6f}°)",
        "length": "Länge längs der Geraden",
        "band": "Band quer zur Geraden",
        "ratio": "bezogene Geradführungsabweichung Q_G",
        "direction": "Richtung der Geraden",
        "none": "Jedes Fenster bis zu einer vollen Umdrehung um {centre:g}° ist gerader als Q_G = {ratio:g}.",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="The piece of a coupler curve symmetric about a crank angle that has a given relative deviation "
        "Q_G = deviation/length; the longest piece in a band; or length and band of a given piece.",
        epilog="Example: gruebler straight 20,50,50,40 100,0 --window 90 270 --direction 0; "
        "gruebler straight 20,50,50,40 100,0 --band 0.2. Exit status: 0, 1 no such piece, 2 wrong usage.",
    )
    add_coupler_point(parser)
    parser.add_argument("--ratio", type=float, metavar="Q", help="the window about --centre with this Q_G")
    parser.add_argument("--band", type=float, metavar="WIDTH", help="the longest piece in a band of this width")
    parser.add_argument("--window", type=float, nargs=2, metavar=("FROM", "TO"), help="the piece between two angles")
    parser.add_argument("--centre", type=float, default=180.0, metavar="DEG", help="crank angle (default: 180)")
    parser.add_argument("--direction", type=float, metavar="DEG", help="of the line (default: tangent, best line)")
    parser.add_argument("--json", action="store_true", help="as JSON")


def run(arguments: argparse.Namespace) -> int:
    """The piece asked for; status 1 if there is none."""
    words = _WORDS[arguments.lang]
    piece = _found(arguments)
    if piece is None:
        print(words["none"].format(centre=arguments.centre, ratio=arguments.ratio))
        return 1
    start, end = math.degrees(piece.start), math.degrees(piece.end)
    if arguments.json:
        document = {
            "start_deg": start,
            "end_deg": end,
            "length": piece.length,
            "band": piece.band,
            "ratio": piece.ratio if piece.length else None,
            "direction_deg": math.degrees(piece.direction),
        }
        print_json(document)
        return 0
    rows = (
        ("angles", words["window"].format(start=start, end=end, width=end - start)),
        ("length", f"{piece.length:.9g}"),
        ("band", f"{piece.band:.6g}"),
        ("ratio", f"{piece.ratio:.6g}"),
        ("direction", f"{math.degrees(piece.direction):.6f}°"),
    )
    for key, value in rows:
        print(f"{words[key]}: {value}")
    return 0


def _found(arguments: argparse.Namespace) -> PathPiece | None:
    size = sizes(arguments.lengths)
    path = coupler_path(size, *coupler_point(arguments.point), branch=arguments.branch)
    direction = None if arguments.direction is None else math.radians(arguments.direction)
    if sum(given is not None for given in (arguments.ratio, arguments.band, arguments.window)) != 1:
        raise GrueblerError("ask for one of --ratio Q, --band WIDTH and --window FROM TO")
    if arguments.ratio is not None:
        return piece_of_ratio(path, math.radians(arguments.centre), arguments.ratio, direction)
    if arguments.window is not None:
        if not 0 < abs(arguments.window[1] - arguments.window[0]) <= 360:
            raise GrueblerError(
                "--window: expected two crank angles at most a full turn apart, but found {window:g} and {window_2:g}",
                window=arguments.window[0],
                window_2=arguments.window[1],
            )
        start, end = (math.radians(angle) for angle in arguments.window)
        return path_piece(path, start, end, direction)
    if direction is not None:
        raise GrueblerError("--direction does not go with --band: the line of the longest piece is found")
    if not size.limits:
        raise GrueblerError("{lengths} cannot be assembled in any position", lengths=arguments.lengths)
    begin = math.radians(arguments.centre) - math.pi
    ranges = [(begin, begin + 2 * math.pi) if arc.full else (arc.start, arc.end) for arc in size.limits]
    return max((longest_piece(path, *ends, arguments.band) for ends in ranges), key=lambda found: found.length)
