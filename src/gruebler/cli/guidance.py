"""`gruebler guidance`: straight-line linkages by name."""

from __future__ import annotations

import argparse
import math
import re
from typing import Any

from gruebler.cli import capellen
from gruebler.cli.measured import length_of, numbers_in_language, same_unit
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError, LinkageError
from gruebler.geometry.guidance import GUIDANCES, Guidance, guidance
from gruebler.geometry.sizing import Sizing
from gruebler.text import LANGUAGES

__all__ = ["add", "run"]

_GERMAN = {
    "frame": "Gestell",
    "crank": "Kurbel",
    "coupler": "Koppel",
    "rocker": "Schwinge",
    "slider": "Schieber",
    "block": "Gleitstein",
    "arm": "Arm",
    "bar": "Stab",
    "long": "Lang",
    "short": "Kurz",
}
_WORDS: dict[str, dict[str, Any]] = {
    "en": {
        "headers": ("name", "finder", "n", "kind", "contact", "length", "band", "Q_G", "drive"),
        "exact": "exact",
        "approximate": "approximate",
        "points": "{n} points",
        "proportions": "Proportions: {text}.",
        "contact": "In the position of reference ({at:g}°) the curve and its tangent have {n} points in common: "
        "y = {c:.6g} x^{n}.",
        "sized": "For {length:g}{unit} within {tolerance:g}{unit} (Q_G = {ratio:g}) the proportions times "
        "{factor:.6g}{unit}: drive from {start:.4f}° to {end:.4f}°, of proportions {used:.6f} long.",
        "lengths": "Lengths: {text}.",
    },
    "de": {
        "headers": ("Name", "Urheber", "n", "Art", "Berührung", "Länge", "Band", "Q_G", "Antrieb"),
        "exact": "exakt",
        "approximate": "angenähert",
        "points": "{n}-punktig",
        "proportions": "Abmessungsverhältnisse: {text}.",
        "contact": "In der Bezugslage ({at:g}°) haben Kurve und Tangente {n} Punkte gemeinsam: y = {c:.6g} x^{n}.",
        "sized": "Für {length:g}{unit} innerhalb von {tolerance:g}{unit} (Q_G = {ratio:g}) die Verhältnisse mal "
        "{factor:.6g}{unit}: Antrieb von {start:.4f}° bis {end:.4f}°, in den Verhältnissen {used:.6f} lang.",
        "lengths": "Längen: {text}.",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Straight-line linkages named after their finders. Without a name all of them; with one its "
        "proportions, and with --length and --tolerance the size that is straight within the tolerance over the "
        "length. With --lambda or --kappa Meyer zur Capellen's double rocker and the four-bar that replaces it.",
        epilog="Example: gruebler guidance lambda --length 15cm --tolerance 0.75mm; gruebler guidance --kappa 20. Exit "
        "status: 0, 1 no piece is so straight, 2 wrong usage.",
    )
    parser.add_argument("name", nargs="?", metavar="NAME", help="such as watt, lambda, peaucellier")
    parser.add_argument("--length", metavar="L", help="of the straight line wanted, with or without unit: 15cm")
    parser.add_argument("--tolerance", metavar="DY", help="the band allowed across the line: 0.75mm")
    parser.add_argument(
        "--lambda",
        dest="ratio",
        type=float,
        metavar="X",
        help="0.5 to 1.5: distance of the coupler from the tangent, by D",
    )
    parser.add_argument(
        "--phi0", type=float, metavar="DEG", help="with --lambda: another angle than that of contact in six points"
    )
    parser.add_argument("--kappa", type=float, metavar="DEG", help="the line's angle against the frame: both lambda")
    parser.add_argument(
        "--diameter", type=float, metavar="D", help="with --lambda or --kappa: of the inflection circle (default: 1)"
    )
    parser.add_argument("--json", action="store_true", help="as JSON")


def run(arguments: argparse.Namespace) -> int:
    """The table of all, or one of them, or what is constructed."""
    words, task = _WORDS[arguments.lang], _task(arguments)
    if any(given is not None for given in (arguments.ratio, arguments.kappa, arguments.phi0)):
        if arguments.name is not None or task:
            raise GrueblerError("--lambda, --kappa and --phi0 construct a linkage: they go without name and task")
        return capellen.run(arguments)
    if arguments.diameter is not None:
        raise GrueblerError("--diameter is that of a construction: it goes with --lambda or --kappa")
    if arguments.name is None:
        if task:
            raise GrueblerError("a size is found for one linkage: give its name")
        if arguments.json:
            print_json([_item(one) for one in GUIDANCES])
        else:
            rows = [_row(one, arguments.lang) for one in GUIDANCES]
            print_table(words["headers"], rows, numbers=(2, 5, 6, 7))
        return 0
    one = guidance(arguments.name)
    try:
        sizing = one.sized(*task[:2]) if task else None
    except LinkageError as error:
        print(error)
        return 1
    if arguments.json:
        print_json(_item(one) | (_sized_item(one, sizing) if sizing else {}))
        return 0
    print_table(words["headers"], [_row(one, arguments.lang)], numbers=(2, 5, 6, 7))
    print(f"\n{words['proportions'].format(text=one.proportions.in_language(arguments.lang))}")
    if one.contact:
        said = words["contact"].format(at=round(one.degrees[1], 4), n=one.contact.points, c=one.contact.coefficient)
        print(numbers_in_language(said, arguments.lang))
    if task and sizing:
        _say_size(one, sizing, task, arguments.lang)
    return 0


def _task(arguments: argparse.Namespace) -> tuple[float, float, str] | None:
    """Length, tolerance, and their unit."""
    if arguments.length is None and arguments.tolerance is None:
        return None
    if arguments.length is None or arguments.tolerance is None:
        raise GrueblerError("a size needs both --length and --tolerance")
    length, unit = length_of("length", arguments.length)
    return length, same_unit(*length_of("tolerance", arguments.tolerance), unit), unit


def _row(one: Guidance, lang: str) -> tuple[str, ...]:
    words = _WORDS[lang]
    start, _, end = one.degrees
    numbers = (
        f"{one.piece.length:.6f}",
        "0" if one.is_exact else f"{one.piece.band:.6f}",
        "0" if one.is_exact else f"{one.piece.ratio:.6f}",
        f"{round(start, 2):g}° ... {round(end, 2):g}°",
    )
    return (
        one.key,
        one.name.in_language(lang),
        str(one.linkage.mechanism.chain.n),
        words["exact" if one.is_exact else "approximate"],
        words["points"].format(n=one.contact.points) if one.contact else "",
        *(numbers_in_language(number, lang) for number in numbers),
    )


def _say_size(one: Guidance, found: Sizing, task: tuple[float, float, str], lang: str) -> None:
    words, (length, tolerance, unit) = _WORDS[lang], task
    said = words["sized"].format(
        length=length,
        tolerance=tolerance,
        ratio=tolerance / length,
        unit=f" {unit}" if unit else "",
        factor=found.factor,
        start=math.degrees(found.piece.start),
        end=math.degrees(found.piece.end),
        used=found.piece.length,
    )
    print(numbers_in_language(said, lang))
    lengths = ("; " if lang == "de" else ", ").join(
        f"{_named(name, lang)} = {value:.6g}" for name, value in _lengths(one, found.factor).items()
    )
    print(numbers_in_language(words["lengths"].format(text=lengths + (f" {unit}" if unit else "")), lang))


def _named(key: str, lang: str) -> str:
    """A length's key with the links in a language."""
    if lang != "de":
        return key
    return re.sub(r"[a-z]+", lambda match: _GERMAN.get(match[0], match[0]), key).replace("R(", "D(")


def _lengths(one: Guidance, factor: float) -> dict[str, float]:
    """Distances of the joints on every link, by link and joints."""
    chain, names = one.linkage.mechanism.chain, one.linkage.mechanism.chain.joint_names()
    out: dict[str, float] = {}
    for link in chain.links:
        mine = [k for k, joint in enumerate(chain.joints) if link in joint.links]
        pairs = [(a, b) for n, a in enumerate(mine) for b in mine[n + 1 :] if names[a][0] == names[b][0] == "R"]
        for a, b in pairs:
            key = link if len(pairs) == 1 else f"{link} {names[a]}-{names[b]}"
            out[key] = factor * one.linkage.length(link, a, b)
    return out


def _item(one: Guidance) -> dict[str, object]:
    contact = one.contact
    return {
        "name": one.key,
        "finder": {lang: one.name.in_language(lang) for lang in LANGUAGES},
        "proportions": {lang: one.proportions.in_language(lang) for lang in LANGUAGES},
        "mechanism": str(one.linkage.mechanism),
        "exact": one.is_exact,
        "length": one.piece.length,
        "band": one.piece.band,
        "ratio": one.piece.ratio,
        "drive_deg": list(one.degrees),
        "direction_deg": math.degrees(one.direction),
        "contact": {"points": contact.points, "coefficient": contact.coefficient} if contact else None,
        "lengths": _lengths(one, 1.0),
    }


def _sized_item(one: Guidance, found: Sizing) -> dict[str, object]:
    return {
        "sized": {
            "factor": found.factor,
            "start_deg": math.degrees(found.piece.start),
            "end_deg": math.degrees(found.piece.end),
            "lengths": _lengths(one, found.factor),
        }
    }
