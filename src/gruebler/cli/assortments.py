"""`gruebler assortments`: how many binary, ternary, ... links a chain can have."""

from __future__ import annotations

import argparse

from gruebler.cli.output import print_json
from gruebler.cli.tables import print_table
from gruebler.enumeration import assortments
from gruebler.enumeration.multiple_assortment import joint_assortments

__all__ = ["run"]

_LINKS = {
    "en": ("binary", "ternary", "quaternary"),
    "de": ("binär", "ternär", "quaternär"),
}
_MORE = {"en": "{k} joints", "de": "{k} Gelenke"}
_JOINTS = {"en": "joints of {k}", "de": "Gelenke zu {k}"}
_NONE = {
    "en": "No closed chain of {n} links has mobility {f}.",
    "de": "Keine geschlossene Kette aus {n} Gliedern hat den Laufgrad {f}.",
}


def run(arguments: argparse.Namespace) -> int:
    """Print the link assortments, with the joint assortments if multiple joints are allowed."""
    n, f, lang = arguments.links, arguments.mobility, arguments.lang
    fractionated = arguments.fractionated
    if arguments.multiple_joints:
        found = [(a.links, a.joints) for a in joint_assortments(n, f, fractionated=fractionated)]
    else:
        found = [(numbers, ()) for numbers in assortments(n, f, fractionated=fractionated)]
    if arguments.json:
        document: dict[str, object] = {"links": n, "mobility": f}
        document["assortments"] = (
            [{"links": list(links), "joints": list(joints)} for links, joints in found]
            if arguments.multiple_joints
            else [list(links) for links, _ in found]
        )
        print_json(document, indent=None)
    elif not found:
        print(_NONE[lang].format(n=n, f=f))
    else:
        _print(found, lang)
    return 0


def _print(found: list[tuple[tuple[int, ...], tuple[int, ...]]], lang: str) -> None:
    degrees = max(len(links) for links, _ in found)
    sizes = max(len(joints) for _, joints in found)
    headers = [_LINKS[lang][i] if i < 3 else _MORE[lang].format(k=i + 2) for i in range(degrees)]
    headers += [_JOINTS[lang].format(k=k + 2) for k in range(sizes)]
    rows = [[*_filled(links, degrees), *_filled(joints, sizes)] for links, joints in found]
    print_table(headers, rows, numbers=range(degrees + sizes))


def _filled(numbers: tuple[int, ...], width: int) -> list[str]:
    return [str(k) for k in numbers] + ["0"] * (width - len(numbers))
