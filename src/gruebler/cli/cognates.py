"""`gruebler cognates`: the other linkages that trace the same coupler curve."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from typing import Any

from gruebler.cli.coupler_inputs import add_coupler_point, coupler_point, sizes
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.fourbar import FourBar, SliderCrank
from gruebler.geometry.roberts import Cognate, cognates, slider_cognates

__all__ = ["add", "run"]

_WORDS = {
    "en": {
        "crank": "crank",
        "coupler": "coupler",
        "rocker": "rocker",
        "headers": ("pivot", "direction", "type"),
        "third": "Third pivot C0 at {x:.6g}, {y:.6g}, {far:.9g} from A0.",
        "infinity": "The third pivot lies at infinity: a slider-crank has one further cognate.",
        "turning": "Cognate {n}: {links}.",
        "like": "{link} turns with the given {other}",
    },
    "de": {
        "crank": "Kurbel",
        "coupler": "Koppel",
        "rocker": "Schwinge",
        "headers": ("Lagerpunkt", "Richtung", "Typ"),
        "third": "Dritter Lagerpunkt C0 bei {x:.6g}, {y:.6g}, {far:.9g} von A0.",
        "infinity": "Der dritte Lagerpunkt liegt im Unendlichen: eine Schubkurbel hat ein weiteres Ersatzgetriebe.",
        "turning": "Ersatzgetriebe {n}: {links}.",
        "like": "{link} dreht sich wie die gegebene {other}",
    },
}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="The three cognates of a four-bar with a coupler point, or the two of a slider-crank: lengths, "
        "coupler point, where they stand (A0 = 0, B0 on the x axis), which links turn with which.",
        epilog="Example: gruebler cognates 25,70,40,70 45,40; gruebler cognates slider-crank:25,70,10 35,40. "
        "A point with a negative U is written after two dashes: gruebler cognates 25,70,40,70 -- -10,40",
    )
    add_coupler_point(parser)
    parser.add_argument("--at", type=float, metavar="DEG", help="crank angle of the pose that is told (home pose)")
    parser.add_argument("--json", action="store_true", help="as JSON, with the pins of the pose")


def run(arguments: argparse.Namespace) -> int:
    """Lengths, coupler point and place of every cognate."""
    size, (u, v) = sizes(arguments.lengths), coupler_point(arguments.point)
    found: Sequence[Cognate]
    if isinstance(size, FourBar):
        found = cognates(size, u, v, branch=arguments.branch, phi=_radians(arguments.at))
    elif isinstance(size, SliderCrank):
        found = slider_cognates(size, u, v, branch=arguments.branch, phi=_radians(arguments.at))
    else:
        raise GrueblerError("cognates are known of the four-bar and the slider-crank, not of its inversion")
    if arguments.json:
        print_json({"cognates": [_item(cognate) for cognate in found]})
    else:
        _say(found, arguments.lang)
    return 0


def _radians(degrees: float | None) -> float | None:
    return None if degrees is None else math.radians(degrees)


def _lengths(one: Cognate) -> dict[str, float]:
    return {name: getattr(one.size, name) for name in ("abcd" if isinstance(one.size, FourBar) else "abe")}


def _say(found: Sequence[Cognate], lang: str) -> None:
    words: dict[str, Any] = _WORDS[lang]
    rows = [
        (
            str(n),
            *(f"{value:.6f}" for value in (*_lengths(one).values(), one.u, one.v)),
            f"{one.pivot.real:.6g}, {one.pivot.imag:.6g}",
            f"{_degrees(one.turn):.4f}°",
            one.size.type.name(lang),
        )
        for n, one in enumerate(found, 1)
    ]
    headers = ("", *_lengths(found[0]), "u", "v", *words["headers"])
    print_table(headers, rows, numbers=range(len(headers) - 1))
    print()
    if isinstance(found[0].size, FourBar):
        third = found[1].pins[3]
        print(words["third"].format(x=third.real, y=third.imag, far=abs(third)))
    else:
        print(words["infinity"])
    for n, cognate in enumerate(found[1:], 2):
        pairs = zip(("crank", "coupler", "rocker"), cognate.turns_with, strict=False)
        links = ", ".join(words["like"].format(link=words[own], other=words[other]) for own, other in pairs)
        print(words["turning"].format(n=n, links=links))


def _item(one: Cognate) -> dict[str, object]:
    return {
        **_lengths(one),
        "u": one.u,
        "v": one.v,
        "type": one.size.type.key,
        "direction_deg": _degrees(one.turn),
        "pins": [[pin.real, pin.imag] for pin in one.pins],
        "point": [one.point.real, one.point.imag],
        "phi_deg": math.degrees(one.phi),
        "branch": one.branch,
        "turns_with": list(one.turns_with),
    }


def _degrees(turn: complex) -> float:
    return math.degrees(math.atan2(turn.imag, turn.real)) + 0.0
