"""`gruebler guidance --lambda` and `--kappa`: Meyer zur Capellen's double rockers and their replacements."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from typing import Any

from gruebler.cli.measured import numbers_in_language
from gruebler.cli.output import print_json
from gruebler.cli.tables import print_table
from gruebler.errors import GrueblerError
from gruebler.geometry.meyer_zur_capellen import CouplerLever, SymmetricRocker, lambdas_for, symmetric_rocker

__all__ = ["run"]

_WORDS: dict[str, dict[str, Any]] = {
    "en": {
        "headers": ("", "l1", "l2", "l3", "l4", "k", "l", "κ", "type"),
        "rocker": "double rocker",
        "replacement": "replacement",
        "about": "λ = {ratio:.9g}, φ0 = {phi0:.6f}°, D = {diameter:g}: tangent touched in {points} points, "
        "y = {coefficient:.6g} x^{points}.",
    },
    "de": {
        "headers": ("", "l1", "l2", "l3", "l4", "k", "l", "κ", "Typ"),
        "rocker": "Doppelschwinge",
        "replacement": "Ersatzgetriebe",
        "about": "λ = {ratio:.9g}, φ0 = {phi0:.6f}°, D = {diameter:g}: {points}-punktig berührende Tangente, "
        "y = {coefficient:.6g} x^{points}.",
    },
}


def run(arguments: argparse.Namespace) -> int:
    """The double rocker of a ratio, or both of an angle."""
    symmetric_rockers = _made(arguments)
    if arguments.json:
        print_json([_item(one) for one in symmetric_rockers])
        return 0
    words = _WORDS[arguments.lang]
    for number, one in enumerate(symmetric_rockers):
        lever_contact = one.contact()
        print("\n" * (number > 0), end="")
        said = words["about"].format(**_about(one), points=lever_contact.points, coefficient=lever_contact.coefficient)
        print(numbers_in_language(said, arguments.lang))
        rows = [_row(words[key], lever, arguments.lang) for key, lever in _levers(one)]
        print_table(words["headers"], rows, numbers=range(1, 8))
    return 0


def _made(arguments: argparse.Namespace) -> Sequence[SymmetricRocker]:
    phi0 = None if arguments.phi0 is None else math.radians(arguments.phi0)
    diameter = 1.0 if arguments.diameter is None else arguments.diameter
    if arguments.ratio is not None:
        if arguments.kappa is not None:
            raise GrueblerError("kappa follows from lambda: give one of --lambda and --kappa")
        return [symmetric_rocker(arguments.ratio, phi0, diameter)]
    if arguments.kappa is None:
        raise GrueblerError("--phi0 goes with --lambda")
    if phi0 is not None:
        raise GrueblerError("--kappa asks for contact in six points, which fixes phi0: leave --phi0 out")
    return [symmetric_rocker(ratio, None, diameter) for ratio in lambdas_for(math.radians(arguments.kappa))]


def _levers(one: SymmetricRocker) -> tuple[tuple[str, CouplerLever], ...]:
    return ("rocker", one.lever), ("replacement", one.replacement())


def _lengths(lever: CouplerLever) -> dict[str, float]:
    size = lever.size
    return {"l1": size.a, "l2": size.b, "l3": size.c, "l4": size.d, "k": lever.k, "l": lever.l}


def _row(name: str, lever: CouplerLever, lang: str) -> tuple[str, ...]:
    values = [*(f"{length:.6f}" for length in _lengths(lever).values()), f"{math.degrees(lever.kappa):.6f}°"]
    return name, *(numbers_in_language(value, lang) for value in values), lever.size.type.name(lang)


def _about(one: SymmetricRocker) -> dict[str, float]:
    return {"ratio": one.ratio, "phi0": math.degrees(one.phi0), "diameter": one.diameter}


def _item(one: SymmetricRocker) -> dict[str, Any]:
    lever_contact = one.contact()
    out: dict[str, Any] = {"lambda": one.ratio, "phi0_deg": math.degrees(one.phi0), "D": one.diameter}
    out["contact"] = {"points": lever_contact.points, "coefficient": lever_contact.coefficient}
    for key, lever in _levers(one):
        out[key] = _lengths(lever) | {"kappa_deg": math.degrees(lever.kappa), "type": lever.size.type.key}
    return out
