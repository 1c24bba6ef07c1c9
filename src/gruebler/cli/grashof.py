"""`gruebler grashof`: the type of a four-bar, which links turn fully, and for which values of one length."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.errors import GrueblerError
from gruebler.fourbar.extremes import CrankRange
from gruebler.fourbar.four_bar import FourBar
from gruebler.fourbar.grashof import Grashof, LengthRange, turning_ranges, types_along
from gruebler.text import Message, joined_by_or, message, number, translate

__all__ = ["add", "run"]

_HEADERS = (message("from"), message("to"), message("type"), message("below"), message("above"))


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Crank A, coupler B, rocker C, frame D: type, fully rotating links, limits, swing, transmission "
        "angle. With --free: the types along one length, the others given in order; with --turns too: only where that "
        "link turns fully.",
        epilog="Exit status: 0 yes, 1 cannot be assembled, or the link does not turn fully, 2 wrong usage. "
        "Example: gruebler grashof 25 40 70 --free d --turns a",
    )
    parser.add_argument(
        "lengths", nargs="+", metavar="LENGTH", help="A B C D; with --free the other three, or all four"
    )
    parser.add_argument("--free", choices=("a", "b", "c", "d"), help="vary this length")
    parser.add_argument(
        "--turns", choices=("a", "b", "c"), metavar="LINK", help="a, b or c: ask whether this link turns fully"
    )
    parser.add_printed(help="print an object; with --free, its items")


def run(arguments: argparse.Namespace) -> int:
    """Classify one four-bar, or go through the values of one length.

    Status 1: it cannot be assembled, or the link asked about does not turn fully.
    """
    lengths = [_number(text) for text in arguments.lengths]
    if arguments.free:
        return _along(_three(lengths, arguments.free), arguments)
    if len(lengths) != 4:
        raise GrueblerError("four lengths A B C D are needed (three go with --free), not {count}", count=len(lengths))
    four_bar = FourBar(*lengths)
    if arguments.json:
        print_json(_document(four_bar))
    else:
        _print(four_bar, arguments.lang)
    grashof = four_bar.grashof
    if arguments.turns is None:
        return 0 if grashof.assemblable else 1
    turning = arguments.turns in grashof.turning
    if not arguments.json:
        print(
            translate(
                "{link} turns fully: {answer}",
                arguments.lang,
                link=arguments.turns,
                answer=message("yes") if turning else message("no"),
            )
        )
    return 0 if turning else 1


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise GrueblerError("expected a length, but found {found!r}", found=text) from None


def _three(lengths: Sequence[float], free: str) -> dict[str, float]:
    names = [name for name in "abcd" if name != free]
    if len(lengths) == 4:
        lengths = [length for name, length in zip("abcd", lengths, strict=True) if name != free]
    if len(lengths) != 3:
        raise GrueblerError(
            "--free {free} takes the lengths {names} (or all four), not {count}",
            free=free,
            names=", ".join(names),
            count=len(lengths),
        )
    return dict(zip(names, lengths, strict=True))


def _along(given: dict[str, float], arguments: argparse.Namespace) -> int:
    free, turns, lang = arguments.free, arguments.turns, arguments.lang
    length_ranges = turning_ranges(turns, **given) if turns else types_along(**given)
    if arguments.json:
        items = [_range_item(part) for part in length_ranges]
        print_json({**given, "free": free, "turns": turns, "items": items})
    elif not length_ranges:
        print(translate("No value of {free} lets {link} turn fully.", lang, free=free, link=turns))
    else:
        if turns:
            print(translate("{link} turns fully for", lang, link=turns))
        rows = [_range_row(part, free, lang) for part in length_ranges]
        print_table(_HEADERS, rows, numbers=(0, 1), lang=lang)
    return 0 if length_ranges else 1


def _range_row(part: LengthRange, free: str, lang: str) -> tuple[str, ...]:
    lower = f"{number(part.lower, lang)} {'<' if part.lower == 0 else '<='} {free}"
    upper = "" if math.isinf(part.upper) else f"<= {number(part.upper, lang)}"
    beyond = ("" if kind is None else kind.name(lang) for kind in (part.below, part.above))
    return lower, upper, part.type.name(lang), *beyond


def _range_item(part: LengthRange) -> dict[str, object]:
    return {
        "lower": part.lower,
        "upper": None if math.isinf(part.upper) else part.upper,
        "type": part.type.key,
        "turning": list(part.grashof.turning),
        "below": part.below.key if part.below else None,
        "above": part.above.key if part.above else None,
    }


def _print(four_bar: FourBar, lang: str) -> None:
    print_text(four_bar.grashof.explain(lang))
    if not four_bar.limits:
        return
    ranges = [_crank_range(arc) for arc in four_bar.limits]
    print(translate("crank angle: {ranges}", lang, ranges=joined_by_or(ranges)))
    if (centres := four_bar.dead_centres) is not None:
        print(translate("swing of the output: {angle:.4f}°", lang, angle=math.degrees(centres.travel)))
        print(translate("time ratio: {ratio:.6f}", lang, ratio=centres.time_ratio))
    smallest = math.degrees(four_bar.transmission_angle.smallest)
    print(translate("smallest transmission angle: {angle:.4f}°", lang, angle=smallest))


def _crank_range(arc: CrankRange) -> Message:
    if arc.full:
        return message("full turn")
    return message("{start:.4f}°..{end:.4f}°", start=math.degrees(arc.start), end=math.degrees(arc.end))


def _document(four_bar: FourBar) -> dict[str, object]:
    grashof: Grashof = four_bar.grashof
    centres = four_bar.dead_centres
    document: dict[str, object] = {
        **grashof.lengths,
        "type": grashof.type.key,
        "english": grashof.type.name("en"),
        "german": grashof.type.name("de"),
        "condition": grashof.condition,
        "excess": grashof.excess,
        "shortest": list(grashof.shortest),
        "turning": list(grashof.turning),
        "limits_deg": [[math.degrees(end) for end in arc] for arc in four_bar.limits],
    }
    if centres is not None:
        document["swing_deg"] = math.degrees(centres.travel)
        document["time_ratio"] = centres.time_ratio
    if four_bar.limits:
        document["smallest_transmission_angle_deg"] = math.degrees(four_bar.transmission_angle.smallest)
    return document
