"""`gruebler curve --cognates`: the other linkages that trace the same coupler curve."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from gruebler.base.plain_data import plain
from gruebler.base.text import joined, message, number, translate
from gruebler.cli.coupler_inputs import coupler_point
from gruebler.cli.link_names import language_of_names
from gruebler.cli.linkage_inputs import linkage_of_word, with_points
from gruebler.cli.output import print_json
from gruebler.cli.tables import Cell, print_table
from gruebler.mechanics.analysis.drive_cycles import drive_cycle
from gruebler.mechanics.fourbar.length_texts import ClosedForm, size_of
from gruebler.mechanics.geometry.lever_contact import lever_pose
from gruebler.mechanics.geometry.roberts import Cognate, all_cognates

_INSIDE = 0.4  # of the range of the crank: a pose away from its limits
_LINKS = {"crank": message("crank"), "coupler": message("coupler"), "rocker": message("rocker")}


def run(arguments: argparse.Namespace) -> int:
    """Lengths, coupler point and place of every cognate."""
    size, u, v, branch, phi = _given(arguments)
    linkages = all_cognates(size, u, v, branch=branch, phi=phi)
    if arguments.json:
        print_json({"cognates": [_item(cognate) for cognate in linkages]})
    else:
        _print(linkages, arguments.lang)
    return 0


def _given(
    arguments: argparse.Namespace,
) -> tuple[ClosedForm, float, float, str | None, float | None]:
    """The linkage by its lengths, the coupler point, the assembly mode, and the crank angle of the pose."""
    size = size_of(arguments.linkage)
    if size is not None:
        u, v = coupler_point(size, arguments.point)
        return size, u, v, arguments.branch, _radians(arguments.at)
    linkage = with_points(linkage_of_word(arguments.linkage, language_of_names(arguments))[0], [arguments.point])
    drive = _radians(arguments.at)
    if drive is None:
        span = drive_cycle(linkage, branch=arguments.branch).span
        drive = span.low + _INSIDE * span.width
    size, u, v, phi, branch = lever_pose(linkage, arguments.point, drive, branch=arguments.branch)
    return size, u, v, branch, phi


def _radians(degrees: float | None) -> float | None:
    return None if degrees is None else math.radians(degrees)


def _print(linkages: Sequence[Cognate], lang: str) -> None:
    rows = [
        (
            str(n),
            *(number(value, lang, "n") for value in (*cognate.size.named.values(), cognate.u, cognate.v)),
            translate("{x:n}; {y:n}", lang, x=cognate.pivot.real, y=cognate.pivot.imag),
            number(_degrees(cognate.turn), lang, "n") + "°",
            cognate.size.type.name(lang),
        )
        for n, cognate in enumerate(linkages, 1)
    ]
    headers: tuple[Cell, ...] = (
        "",
        *linkages[0].size.named,
        "u",
        "v",
        message("pivot"),
        message("direction"),
        message("type"),
    )
    print_table(headers, rows, numbers=range(len(headers) - 1), lang=lang)
    print()
    if len(linkages) == 3:
        third = linkages[1].pins[3]
        print(
            translate(
                "Third pivot C0 at {x:n}, {y:n}, distance {distance:n} from A0.",
                lang,
                x=third.real,
                y=third.imag,
                distance=abs(third),
            )
        )
    else:
        print(translate("The third pivot lies at infinity: a slider-crank has one further cognate.", lang))
    for n, cognate in enumerate(linkages[1:], 2):
        pairs = zip(_LINKS, cognate.turns_with, strict=False)
        turning = [
            message("{link} turns with the given {given}", link=_LINKS[own], given=_LINKS[other])
            for own, other in pairs
        ]
        print(translate("Cognate {number}: {links}.", lang, number=n, links=joined(turning)))


def _item(cognate: Cognate) -> dict[str, object]:
    return {
        **cognate.size.named,
        **plain(cognate, "u v"),
        "type": cognate.size.type.key,
        "direction_deg": _degrees(cognate.turn),
        **plain(cognate, "pins point phi_deg branch turns_with"),
    }


def _degrees(turn: complex) -> float:
    return math.degrees(math.atan2(turn.imag, turn.real)) + 0.0
