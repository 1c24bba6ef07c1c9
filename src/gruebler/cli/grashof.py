"""`gruebler grashof`: the type of a four-bar or slider-crank, which links turn fully, for which lengths."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from gruebler.base.errors import GrueblerError
from gruebler.base.plain_data import plain
from gruebler.base.text import message, number, translate
from gruebler.cli.output import print_json
from gruebler.cli.parser import Parser
from gruebler.cli.tables import print_table, print_text
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.fourbar.four_bar_types import LengthRange, turning_ranges, types_along
from gruebler.mechanics.fourbar.length_texts import ClosedForm, size_of

_HEADERS = (message("from"), message("to"), message("type"), message("below"), message("above"))


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Type, fully rotating links, limits, swing, transmission angle of a four-bar with crank A, coupler "
        "B, rocker C, frame D, or of a slider-crank. With --free: the types of four-bars along one length, the others "
        "given in order; with --turns too: only where that link turns fully.",
        epilog="Exit status: 0 yes, 1 cannot be assembled, or the link does not turn fully, 2 wrong usage. "
        "Examples: gruebler grashof 25 40 70 --free d --turns a; gruebler grashof slider-crank:25,70,10",
    )
    parser.take(
        """
        lengths LENGTH +  A B C D; with --free the other three, or all four; or one word: four-bar:A,B,C,D,
            slider-crank:A,B[,E], inverted-slider-crank:A,D[,E]
        --free {a,b,c,d}  vary this length
        --turns LINK {a,b,c,guide}  a, b, c or guide: ask whether it turns fully
        """
    )
    parser.add_printed(help="print an object; with --free, its items")


def run(arguments: argparse.Namespace) -> int:
    """Classify one linkage, or go through the values of one length.

    Status 1: it cannot be assembled, or the link asked about does not turn fully.
    """
    size = size_of(arguments.lengths[0]) if len(arguments.lengths) == 1 else None
    if arguments.free:
        given = [_number(text) for text in arguments.lengths] if size is None else _four_lengths(size)
        return _along(_three(given, arguments.free), arguments)
    if size is None:
        lengths = [_number(text) for text in arguments.lengths]
        if len(lengths) != 4:
            raise GrueblerError(
                "four lengths A B C D are needed (three go with --free), not {count}", count=len(lengths)
            )
        size = FourBar(*lengths)
    if arguments.json:
        print_json(_document(size))
    else:
        print_text(size.explain(arguments.lang))
    if arguments.turns is None:
        return 0 if size.assemblable else 1
    turning = arguments.turns in size.turning
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


def _four_lengths(size: ClosedForm) -> list[float]:
    if not isinstance(size, FourBar):
        raise GrueblerError("--free goes with the lengths of a four-bar")
    return [size.a, size.b, size.c, size.d]


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
    lower = f"{number(part.lower, lang, 'n')} {'<' if part.lower == 0 else '<='} {free}"
    upper = "" if math.isinf(part.upper) else f"<= {number(part.upper, lang, 'n')}"
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


def _document(size: ClosedForm) -> dict[str, object]:
    document: dict[str, object] = {
        **size.named,
        "type": size.type.key,
        "english": size.type.name("en"),
        "german": size.type.name("de"),
    }
    if size.grashof is not None:
        document |= plain(size.grashof, "condition excess shortest")
    document |= plain(size, "turning limits_deg")
    if (centres := size.dead_centres) is not None:
        name, travel = ("stroke", centres.travel) if size.output_slides else ("swing_deg", math.degrees(centres.travel))
        document[name] = travel
        document["time_ratio"] = centres.time_ratio
    if size.limits:
        document["smallest_transmission_angle_deg"] = math.degrees(size.transmission_angle.smallest.mu)
    return document
