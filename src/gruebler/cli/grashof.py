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

__all__ = ["add", "run"]

_WORDS = {
    "en": {
        "limits": "crank angle",
        "swing": "swing of the output",
        "time_ratio": "time ratio",
        "mu": "smallest transmission angle",
        "full": "full turn",
        "or": " or ",
        "none": "No value of {free} lets {turns} turn fully.",
        "some": "{turns} turns fully for",
        "turns": "{0} turns fully: {1}",
        "yes": "yes",
        "no": "no",
    },
    "de": {
        "limits": "Kurbelwinkel",
        "swing": "Schwingwinkel des Abtriebs",
        "time_ratio": "Zeitverhältnis",
        "mu": "kleinster Übertragungswinkel",
        "full": "volle Umdrehung",
        "or": " oder ",
        "none": "Für keinen Wert von {free} ist {turns} umlauffähig.",
        "some": "{turns} ist umlauffähig für",
        "turns": "{0} umlauffähig: {1}",
        "yes": "ja",
        "no": "nein",
    },
}

_HEADERS = {"en": ("from", "to", "type", "below", "above"), "de": ("von", "bis", "Typ", "darunter", "darüber")}


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="Crank A, coupler B, rocker C, frame D: type, links that turn fully, limits, swing, transmission "
        "angle. With --free: the types (with --turns: only where that link turns fully) along one length, the others "
        "given in order.",
        epilog="Exit status: 0 yes, 1 not assemblable, the link does not turn or no value lets it, 2 wrong usage. "
        "Example: gruebler grashof 25 40 70 --free d --turns a",
    )
    parser.add_argument(
        "lengths", nargs="+", metavar="LENGTH", help="A B C D; with --free the other three, or all four"
    )
    parser.add_argument("--free", choices=("a", "b", "c", "d"), help="go through the values of this length")
    parser.add_argument(
        "--turns", choices=("a", "b", "c"), metavar="LINK", help="a, b or c: does it turn fully against the frame"
    )
    parser.add_argument("--json", action="store_true", help="one object; with --free its items")


def run(arguments: argparse.Namespace) -> int:
    """Classify one four-bar, or go through the values of one length.

    Status 1: it cannot be assembled, the link asked about does not turn fully, or no value lets it turn.
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
        _say(four_bar, arguments.lang)
    grashof = four_bar.grashof
    if arguments.turns is None:
        return 0 if grashof.assemblable else 1
    turning = arguments.turns in grashof.turning
    if not arguments.json:
        words = _WORDS[arguments.lang]
        print(words["turns"].format(arguments.turns, words["yes" if turning else "no"]))
    return 0 if turning else 1


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise GrueblerError("a length must be a number, not {text_!r}", text_=text) from None


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
    free, turns, words = arguments.free, arguments.turns, _WORDS[arguments.lang]
    length_ranges = turning_ranges(turns, **given) if turns else types_along(**given)
    if arguments.json:
        items = [_range_item(part) for part in length_ranges]
        print_json({**given, "free": free, "turns": turns, "items": items})
    elif not length_ranges:
        print(words["none"].format(free=free, turns=turns))
    else:
        if turns:
            print(words["some"].format(turns=turns))
        rows = [_range_row(part, free, arguments.lang) for part in length_ranges]
        print_table(_HEADERS[arguments.lang], rows, numbers=(0, 1))
    return 0 if length_ranges else 1


def _range_row(part: LengthRange, free: str, lang: str) -> tuple[str, ...]:
    lower = f"{part.lower:.6g} {'<' if part.lower == 0 else '<='} {free}"
    upper = "" if math.isinf(part.upper) else f"<= {part.upper:.6g}"
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


def _say(four_bar: FourBar, lang: str) -> None:
    words = _WORDS[lang]
    print_text(four_bar.grashof.explain(lang))
    if not four_bar.limits:
        return
    arcs = words["or"].join(_arc(arc, words["full"]) for arc in four_bar.limits)
    rows = [("limits", arcs)]
    if (centres := four_bar.dead_centres) is not None:
        rows += [("swing", f"{math.degrees(centres.travel):.4f}°"), ("time_ratio", f"{centres.time_ratio:.6f}")]
    rows.append(("mu", f"{math.degrees(four_bar.transmission_angle.smallest):.4f}°"))
    for key, value in rows:
        print(f"{words[key]}: {value}")


def _arc(arc: CrankRange, full: str) -> str:
    return full if arc.full else f"{math.degrees(arc.start):.4f}°..{math.degrees(arc.end):.4f}°"


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
