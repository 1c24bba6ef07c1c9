"""`gruebler curve --guidance`: straight-line linkages by name."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Sequence
from itertools import combinations

from gruebler.base.errors import GrueblerError, LinkageError
from gruebler.base.plain_data import plain
from gruebler.base.text import LANGUAGES, error_in_language, message, number, number_separator, translate
from gruebler.cli import curve_capellen
from gruebler.cli.output import print_json
from gruebler.cli.tables import Cell, print_table
from gruebler.files.measured_lengths import length_of, same_unit
from gruebler.mechanics.geometry.guidance import GUIDANCES, Guidance, guidance
from gruebler.mechanics.geometry.sizing import Sizing
from gruebler.structure.chain.pairs import Alphabet

_HEADERS = (
    *(
        message("name"),
        message("inventor"),
        "n",
        message("kind"),
        message("contact with its tangent"),
        message("length"),
    ),
    *(message("band"), "Q_G", message("drive")),
)
_LINKS = {
    "frame": message("frame"),
    "crank": message("crank"),
    "coupler": message("coupler"),
    "rocker": message("rocker"),
    "slider": message("slider"),
    "block": message("block"),
    "arm": message("arm"),
    "bar": message("bar"),
    "long": message("long"),
    "short": message("short"),
}
"""The links of the linkages; a number may follow."""


def run(arguments: argparse.Namespace) -> int:
    """The table of all, or one of them, or what is constructed."""
    task, lang = _task(arguments), arguments.lang
    if any(getattr(arguments, key) is not None for key in ("lambda", "kappa", "phi0")):
        if arguments.guidance or task:
            raise GrueblerError(
                "--lambda, --kappa and --phi0 construct a linkage: leave out the name, --length and --band"
            )
        return curve_capellen.run(arguments)
    if arguments.diameter is not None:
        raise GrueblerError("--diameter goes with --lambda or --kappa")
    if not arguments.guidance:
        if task:
            raise GrueblerError("--length and --band size one linkage: give its name after --guidance")
        if arguments.json:
            print_json([_item(each) for each in GUIDANCES])
        else:
            _print_table(GUIDANCES, lang)
        return 0
    named = guidance(arguments.guidance)
    try:
        sizing = named.sized(*task[:2]) if task else None
    except LinkageError as error:
        print(error_in_language(error, lang))
        return 1
    if arguments.json:
        print_json(_item(named) | (_sized_item(named, sizing) if sizing else {}))
        return 0
    _print_table([named], lang)
    print()
    print(translate("Proportions: {proportions}.", lang, proportions=named.proportions.in_language(lang)))
    if named.contact:
        print(
            translate(
                "In the reference position ({angle:g}°) curve and tangent have {points} points in common: "
                "y = {coefficient:n} x^{points}.",
                lang,
                angle=round(named.degrees[1], 4),
                points=named.contact.points,
                coefficient=named.contact.coefficient,
            )
        )
    if task and sizing:
        _print_size(named, sizing, task, lang)
    return 0


def _task(arguments: argparse.Namespace) -> tuple[float, float, str] | None:
    """Length, width of the band, and their unit."""
    if arguments.length is None and arguments.band is None:
        return None
    if arguments.length is None or arguments.band is None:
        raise GrueblerError("a size needs both --length and --band")
    length, unit = length_of("--length", arguments.length)
    return length, same_unit(*length_of("--band", arguments.band), unit), unit


def _print_table(linkages: Sequence[Guidance], lang: str) -> None:
    print_table(_HEADERS, [_row(each, lang) for each in linkages], numbers=(2, 5, 6, 7), lang=lang)


def _row(linkage: Guidance, lang: str) -> tuple[Cell, ...]:
    start, _, end = linkage.degrees
    exact, piece = linkage.is_exact, linkage.piece
    return (
        linkage.key,
        linkage.name.in_language(lang),
        str(linkage.linkage.mechanism.chain.n),
        message("exact") if exact else message("approximate"),
        message("{points} points", points=linkage.contact.points) if linkage.contact else "",
        number(piece.length, lang, "n"),
        *("0" if exact else number(value, lang, "n") for value in (piece.band, piece.ratio)),
        f"{number(start, lang, 'n')}° ... {number(end, lang, 'n')}°",
    )


def _print_size(linkage: Guidance, sizing: Sizing, task: tuple[float, float, str], lang: str) -> None:
    length, band, unit = task
    unit = f" {unit}" if unit else ""
    print(
        translate(
            "For {length:g}{unit} within {band:g}{unit} (Q_G = {ratio:g}) multiply the proportions by "
            "{factor:n}{unit}: drive from {start:n}° to {end:n}°, {used:n} long in the proportions.",
            lang,
            length=length,
            band=band,
            ratio=band / length,
            unit=unit,
            factor=sizing.factor,
            start=math.degrees(sizing.piece.start),
            end=math.degrees(sizing.piece.end),
            used=sizing.piece.length,
        )
    )
    lengths = (
        f"{_in_language(key, lang)} = {number(value, lang, 'n')}"
        for key, value in _lengths(linkage, sizing.factor, Alphabet.of_language(lang)).items()
    )
    print(translate("Lengths: {lengths}{unit}.", lang, lengths=number_separator(lang).join(lengths), unit=unit))


def _in_language(key: str, lang: str) -> str:
    """A length's key, its links in a language."""
    if lang == LANGUAGES[0]:
        return key
    return re.sub(r"[a-z]+", lambda match: _LINKS[match[0]].in_language(lang) if match[0] in _LINKS else match[0], key)


def _lengths(linkage: Guidance, factor: float, alphabet: Alphabet = Alphabet.INTERNATIONAL) -> dict[str, float]:
    """Distances of the joints on every link, by link and joints."""
    chain, names = linkage.linkage.mechanism.chain, linkage.linkage.mechanism.chain.joint_names(alphabet)
    lengths: dict[str, float] = {}
    for link in chain.links:
        joints = [k for k, joint in enumerate(chain.joints) if link in joint.links]
        pairs = list(combinations([k for k in joints if chain.joints[k].pair.is_turning], 2))
        for a, b in pairs:
            key = link if len(pairs) == 1 else f"{link} {names[a]}-{names[b]}"
            lengths[key] = factor * linkage.linkage.length(link, a, b)
    return lengths


def _item(linkage: Guidance) -> dict[str, object]:
    return {
        "name": linkage.key,
        "finder": {lang: linkage.name.in_language(lang) for lang in LANGUAGES},
        "proportions": {lang: linkage.proportions.in_language(lang) for lang in LANGUAGES},
        "mechanism": str(linkage.linkage.mechanism),
        "exact": linkage.is_exact,
        **plain(linkage.piece, "length band ratio"),
        "drive_deg": list(linkage.degrees),
        **plain(linkage, "direction_deg"),
        "contact": plain(linkage.contact, "points coefficient"),
        "lengths": _lengths(linkage, 1.0),
    }


def _sized_item(linkage: Guidance, sizing: Sizing) -> dict[str, object]:
    return {
        "sized": {
            **plain(sizing, "factor"),
            **plain(sizing.piece, "start_deg end_deg"),
            "lengths": _lengths(linkage, sizing.factor),
        }
    }
