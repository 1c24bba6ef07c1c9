"""`gruebler curve --guidance --lambda` and `--kappa`: Meyer zur Capellen's double rockers and their replacements."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.base.text import Message, message, number, translate
from gruebler.cli.output import print_json
from gruebler.cli.tables import Cell, print_table
from gruebler.mechanics.geometry.meyer_zur_capellen import CouplerLever, SymmetricRocker, lambdas_for, symmetric_rocker

_HEADERS = ("", "l1", "l2", "l3", "l4", "k", "l", "κ", message("type"))


def run(arguments: argparse.Namespace) -> int:
    """The double rocker of a ratio, or both of an angle."""
    rockers, lang = _rockers(arguments), arguments.lang
    if arguments.json:
        print_json([_item(rocker) for rocker in rockers])
        return 0
    for number_before, rocker in enumerate(rockers):
        print("\n" * (number_before > 0), end="")
        contact = rocker.contact()
        print(
            translate(
                "λ = {ratio:n}, φ0 = {phi0:n}°, D = {diameter:g}: curve and tangent have {points} points in "
                "common, y = {coefficient:n} x^{points}.",
                lang,
                ratio=rocker.ratio,
                phi0=math.degrees(rocker.phi0),
                diameter=rocker.diameter,
                points=contact.points,
                coefficient=contact.coefficient,
            )
        )
        rows = [
            _row(message("double rocker"), rocker.lever, lang),
            _row(message("replacement"), rocker.replacement(), lang),
        ]
        print_table(_HEADERS, rows, numbers=range(1, 8), lang=lang)
    return 0


def _rockers(arguments: argparse.Namespace) -> Sequence[SymmetricRocker]:
    ratio = getattr(arguments, "lambda")
    phi0 = None if arguments.phi0 is None else math.radians(arguments.phi0)
    diameter = 1.0 if arguments.diameter is None else arguments.diameter
    if ratio is not None:
        if arguments.kappa is not None:
            raise GrueblerError("kappa follows from lambda: give one of --lambda and --kappa")
        return [symmetric_rocker(ratio, phi0, diameter)]
    if arguments.kappa is None:
        raise GrueblerError("--phi0 goes with --lambda")
    if phi0 is not None:
        raise GrueblerError("--kappa asks for contact in six points, which fixes phi0: leave --phi0 out")
    return [symmetric_rocker(ratio, None, diameter) for ratio in lambdas_for(math.radians(arguments.kappa))]


def _lengths(lever: CouplerLever) -> dict[str, float]:
    size = lever.size
    return {"l1": size.a, "l2": size.b, "l3": size.c, "l4": size.d, "k": lever.k, "l": lever.l}


def _row(name: Message, lever: CouplerLever, lang: str) -> tuple[Cell, ...]:
    lengths = (number(length, lang, "n") for length in _lengths(lever).values())
    return name, *lengths, number(math.degrees(lever.kappa), lang, "n") + "°", lever.size.type.name(lang)


def _item(rocker: SymmetricRocker) -> dict[str, Any]:
    item: dict[str, Any] = {"lambda": rocker.ratio, "phi0_deg": math.degrees(rocker.phi0), "D": rocker.diameter}
    item["contact"] = plain(rocker.contact(), "points coefficient")
    for key, lever in (("rocker", rocker.lever), ("replacement", rocker.replacement())):
        item[key] = _lengths(lever) | {"kappa_deg": math.degrees(lever.kappa), "type": lever.size.type.key}
    return item
