"""The tables of `gruebler synthesise`: designs with their lengths and angles, rejected ones, the Pareto table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import degrees, isnan

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.base.events import GOOD, JAMMING
from gruebler.base.text import Message, joined, message, number, number_separator, numbers, plural, translate
from gruebler.cli.tables import Cell, print_table, print_text
from gruebler.design.synthesis import Design, PathTask, PositionTask, SynthesisResult, pareto
from gruebler.design.synthesis.coordination import Minimax
from gruebler.design.synthesis.formulas import FunctionLaw
from gruebler.design.synthesis.minimax_search import digits_for_error
from gruebler.design.synthesis.results import EXACT, FITTED, DesignVerdict, SolutionCount
from gruebler.design.synthesis.sensitivity import slide_offsets
from gruebler.design.synthesis.tasks import gives_lengths, output_travels
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.mechanism.inversion import family

_REJECTED = 5  # rejected designs that are listed without --rejected, if no other is there
_COLUMNS = (
    *(message("design"), message("drive"), message("full turn"), message("µ on the way"), message("µ of range")),
    message("lengths"),
)
_ERROR, _SHIFTED, _AWAY = message("error"), message("shift"), message("from preferred pivots")
_OF_FUNCTION = message("error at pairs"), message("over interval")
_SHIFT = message(
    "Shift: how far the most sensitive target moves if all lengths are wrong by 0.1 %, in the worst case; each drive "
    "keeps its value."
)
_SHIFT_OF_DEAD_CENTRES = message(
    "Shift: by how much swing or stroke and the crank angle between the dead centres change if all lengths are wrong "
    "by 0.1 %, in the worst case."
)
_PLAY = message(
    "Lengths wrong by up to 0.1 %, pins {clearance:g} beside the middle of their holes, to first order; each drive "
    "keeps its value."
)
_PLAY_OF_DEAD_CENTRES = message(
    "Lengths wrong by up to 0.1 %, pins {clearance:g} beside the middle of their holes, to first order; in each dead "
    "centre they may lie in another direction."
)
_ANGLES = message(
    "µ on the way: the smallest transmission angle on the way through all targets, at them and between them; "
    "µ of range: over the whole range of the drive, as `analyse` gives it."
)
_LOW = message("!: below 40°.")
_JAMS = message("!!: below 5°, where friction and play let it jam; a demanded transmission angle leaves these out.")
_FULL_TURNS = message(
    "Designs whose drive turns fully come first; `--sort transmission` begins with the largest transmission angle."
)
_PARETO = (message("µ on the way"), message("µ of range"))
_LETTERS = {"crank": "a", "coupler": "b", "rocker": "c", "frame": "d"}
"""Lengths as the closed forms name them; those of other links have the names of their links."""


def print_designs(result: SynthesisResult, shown: SynthesisResult, rejected: bool, lang: str) -> None:
    """Print how many solutions there are, the designs that are shown, and the reasons of rejected ones.

    Rejected designs are all listed if asked for, otherwise only where there are no others, and some of them.
    """
    print_solutions(result.count, result.remarks, (len(result.designs), len(result.rejected)), lang)
    if result.designs:
        headers = [*_COLUMNS, *_error_headers(shown), _SHIFTED]
        rows = [_row(k, design, shown, lang) for k, design in enumerate(shown.designs, 1)]
        if isinstance(result.task, PositionTask | PathTask):  # they stand in the plane of the task
            headers += [message("fixed pivots"), _AWAY]
            rows = [
                [*row, _pivots(design, lang), _away(design, lang)]
                for row, design in zip(rows, shown.designs, strict=True)
            ]
        print_table(*_without_empty(headers, rows), lang=lang)
        more = len(result.designs) - len(shown.designs)
        if more:
            print(plural("and {count} more", "and {count} more", more, lang))
        print_notes(shown, lang)
        _print_missing_optima(shown, lang)
        if any(design.form == FITTED for design in shown.designs):
            print_pareto(shown, lang)
    else:
        print(translate("None of the designs examined meets the task.", lang))
    reasons = [(design.form_in_language(lang), design.verdict.reasons) for design in result.rejected]
    print_rejected(reasons, not result.designs, rejected, lang)


def print_solutions(count: SolutionCount, notes: Iterable[Message], judged: tuple[int, int], lang: str) -> None:
    """Print how many solutions there are, what has to be known, and how many were accepted and rejected."""
    if count.theorem is None:
        print(translate("Solutions: infinitely many ({kind}), {real} taken.", lang, kind=count.what, real=count.real))
    elif count.theorem:  # 0: nothing exact is to be had, the notes say so
        print(
            translate(
                "Solutions: {theorem} by theorem ({kind}), {found} found: {finite} finite, {real} of them real, and "
                "{infinite} at infinity, which are no linkages."
                if count.infinite
                else "Solutions: {theorem} by theorem ({kind}), {found} found, {real} real.",
                lang,
                theorem=count.theorem,
                kind=count.what,
                found=count.found,
                finite=count.finite,
                infinite=count.infinite,
                real=count.real,
            )
        )
    for note in notes:
        print(note.in_language(lang))
    accepted, rejected = judged
    print(translate("Designs: {accepted} accepted, {rejected} rejected.", lang, accepted=accepted, rejected=rejected))


def print_rejected(designs: Sequence[tuple[str, Iterable[Message]]], only: bool, asked_for: bool, lang: str) -> None:
    """Print rejected designs with their reasons: all if asked for, some where there are no others."""
    if not designs or not (only or asked_for):
        return
    print()
    shown = designs if asked_for else designs[:_REJECTED]
    rows: list[list[Cell]] = [[form, joined(reasons, "; ")] for form, reasons in shown]
    print_table((message("rejected"), message("reason")), rows, lang=lang)
    more = len(designs) - len(shown)
    if more:
        print(
            plural("and {count} more, which --rejected lists", "and {count} more, which --rejected lists", more, lang)
        )


def print_notes(shown: SynthesisResult, lang: str) -> None:
    """What the columns of transmission angles and shifts mean, if there are such."""
    angles = [mu for design in shown.designs for mu in (design.verdict.transmission, design.transmission_over_range)]
    print_text(joined([_ANGLES, *marks_in_words(angles)], " ").in_language(lang))
    if any(design.sensitivity is not None for design in shown.designs):
        print_text((_SHIFT_OF_DEAD_CENTRES if _of_dead_centres(shown) else _SHIFT).in_language(lang))
    if _turning_before_better([design.verdict for design in shown.designs]):
        print_text(_FULL_TURNS.in_language(lang))


def _of_dead_centres(shown: SynthesisResult) -> bool:
    return any(design.reach is not None for design in shown.designs)


def _turning_before_better(verdicts: Sequence[DesignVerdict]) -> bool:
    """Whether designs with a full turn stand before others that have a larger transmission angle."""
    turning = [verdict.turns_fully for verdict in verdicts]
    others = [verdict.transmission for verdict in verdicts if not verdict.turns_fully]
    first = bool(others) and any(turning) and turning == sorted(turning, reverse=True)
    return first and verdicts[0].transmission < max(others)


def print_pareto(result: SynthesisResult, lang: str) -> None:
    """The designs that no other one beats in everything."""
    numbers_of = {id(design): number for number, design in enumerate(result.designs, 1)}
    rows: list[list[Cell]] = [
        [
            str(numbers_of[id(row.design)]),
            *_errors(row.design, result, lang),
            transmission_text(row.transmission, lang),
            transmission_text(row.design.transmission_over_range, lang),
            number(row.size, lang, "n"),
            str(row.links),
            _shift(row.design, lang),
            _away(row.design, lang),
            _structure(row.design.linkage, lang),
        ]
        for row in pareto(result)
    ]
    size = message("size") if gives_lengths(result.task) else message("size ratio")
    print()
    print(translate("Not beaten in error, transmission angle, size and number of links at once:", lang))
    errors = _error_headers(result)
    headers = [message("design"), *errors, *_PARETO, size, message("links"), _SHIFTED, _AWAY, message("structure")]
    print_table(*_without_empty(headers, rows), numbers=range(5 + len(errors)), lang=lang)


def _without_empty(headers: list[Message], rows: list[list[Cell]]) -> tuple[list[Message], list[list[Cell]]]:
    """A table without columns of shifts and of distances of pivots where no row has one."""
    kept = [k for k in range(len(headers)) if headers[k] not in (_SHIFTED, _AWAY) or any(row[k] for row in rows)]
    return [headers[k] for k in kept], [[row[k] for k in kept] for row in rows]


def _error_headers(result: SynthesisResult) -> tuple[Message, ...]:
    """Of a function that is an expression there are two errors, of its minimax optima only that over the interval."""
    if any(design.optimum is not None for design in result.designs):
        return _OF_FUNCTION[1:]
    return _OF_FUNCTION if any(not isnan(each.verdict.over_interval) for each in result.designs) else (_ERROR,)


def _structure(linkage: Linkage, lang: str) -> str:
    """The family of a mechanism and its drives; of one without a name all its joints."""
    mechanism, alphabet = _named(linkage, lang).mechanism, Alphabet.of_language(lang)
    known = family(linkage.mechanism, lang)
    return f"{known}: {', '.join(mechanism.drive_names(alphabet))}" if known else mechanism.text(alphabet)


def _row(position: int, design: Design, shown: SynthesisResult, lang: str) -> list[Cell]:
    verdict = design.verdict
    return [
        f"{position} {design.form_in_language(lang)}",
        ", ".join(_named(design.linkage, lang).mechanism.drive_names(Alphabet.of_language(lang))),
        message("yes") if verdict.turns_fully else message("no"),
        *(transmission_text(mu, lang) for mu in (verdict.transmission, design.transmission_over_range)),
        _lengths(design.linkage, lang),
        *_errors(design, shown, lang),
        _shift(design, lang),
    ]


def _shift(design: Design, lang: str) -> str:
    """How far a target moves at most for each quantity that is not the drive's own: lengths, and angles in degrees."""
    if design.sensitivity is None:
        return ""
    return _by_probe(design, design.sensitivity.worst, lang)


def _away(design: Design, lang: str) -> str:
    """How far its pivots lie from those that are preferred; nothing where there are none."""
    away = design.verdict.pivot_distance
    return "" if isnan(away) else number(_without_rounding(away, design.linkage), lang, ".3g")


def _by_probe(design: Design, moved: Reals, lang: str) -> str:
    """The largest over the targets of what each quantity moves by, (targets, probes)."""
    shifts = zip(design.probes, map(float, moved.max(axis=0, initial=0.0)), strict=True)
    return " ".join(
        f"{number(degrees(shift / probe.length), lang, '.2g')}°" if probe.link else number(shift, lang, ".2g")
        for probe, shift in shifts
        if shift > EXACT * design.task_size
    )


def print_clearance(shown: SynthesisResult, clearance: float, lang: str) -> None:
    """Print how far the targets of each design move with wrong lengths and play: at most, and in random linkages."""
    rows: list[list[Cell]] = []
    for k, design in enumerate(shown.designs, 1):
        if (sensitivity := design.sensitivity) is not None:
            usual = np.quantile(sensitivity.sampled(clearance=clearance), 0.99, axis=0)
            worst = sensitivity.of_errors(clearance=clearance)
            rows.append([str(k), _by_probe(design, worst, lang), _by_probe(design, usual, lang)])
    if rows:
        print()
        print_table((message("design"), message("worst case"), message("99 % of random linkages")), rows, lang=lang)
        said = _PLAY_OF_DEAD_CENTRES if _of_dead_centres(shown) else _PLAY
        print_text(said.filled(clearance=clearance).in_language(lang))


def transmission_text(mu: float, lang: str) -> str:
    """A minimum transmission angle, marked where the motion passes badly; nothing where there is none."""
    mark = " !!" if mu < JAMMING else " !" if mu < GOOD else ""
    return "" if isnan(mu) else f"{number(degrees(mu), lang, '.1f')}°{mark}"


def marks_in_words(angles: Iterable[float]) -> list[Message]:
    """What the marks of these transmission angles mean."""
    low = [mu for mu in angles if mu < GOOD]
    return [_LOW] * any(mu >= JAMMING for mu in low) + [_JAMS] * any(mu < JAMMING for mu in low)


def _named(linkage: Linkage, lang: str) -> Linkage:
    """The linkage with the names of its links in a language."""
    names = {link: translate(link, lang) for link in linkage.mechanism.chain.links}
    return linkage.renamed(names) if len(set(names.values())) == len(names) else linkage


def _lengths(linkage: Linkage, lang: str) -> str:
    """The distances of the pins of each link, and the offset e of each slide."""
    lengths = list[str]()
    named = _named(linkage, lang).mechanism.chain
    for link, name in sorted(zip(linkage.mechanism.chain.links, named.links, strict=True), key=_by_letter):
        own = [element for (_, owner), element in linkage.elements.items() if owner == link]
        pins = [complex(e.x, e.y) for e in own if e.is_pin]
        between = [abs(p - q) for k, p in enumerate(pins) for q in pins[:k]]
        if between:
            values = " ".join(number(length, lang, "n") for length in between)
            lengths.append(f"{_LETTERS.get(link, name)} = {values}")
    slides = slide_offsets(linkage)
    joints = named.joint_names(Alphabet.of_language(lang))
    for slide in slides:
        offset = _without_rounding(slide.offset, linkage)
        if offset or slide.link == linkage.mechanism.frame:
            name = "e" if len(slides) == 1 else f"e {joints[slide.joint]}"
            lengths.append(f"{name} = {number(offset, lang, 'n')}")
    return number_separator(lang).join(lengths)


def _pivots(design: Design, lang: str) -> str:
    """Where the turning joints of the frame lie."""
    linkage = design.linkage
    own = [element for (_, owner), element in linkage.elements.items() if owner == linkage.mechanism.frame]
    pins = [[_without_rounding(v, linkage) for v in (e.x, e.y)] for e in own if e.is_pin]
    return " ".join(f"({numbers(pin, lang, 'n')})" for pin in pins)


def _without_rounding(length: float, linkage: Linkage) -> float:
    """A length, or 0 for what designs are not held to."""
    return length if abs(length) > EXACT * linkage.size else 0.0


def _by_letter(names: tuple[str, str]) -> str:
    """The letter of a link; those without one stay in their order."""
    return _LETTERS.get(names[0], "")


def _errors(design: Design, result: SynthesisResult, lang: str) -> Iterator[str]:
    """What is missed at the targets, relative to the task, and of a function at most over its interval."""
    verdict, optimum = design.verdict, design.optimum
    if optimum is not None:
        yield _output(optimum, optimum.error, lang) + ("" if optimum.certificate.optimum else " *")
        return
    yield "< 1e-9" if verdict.error < EXACT else number(verdict.error, lang, ".1e")
    if len(_error_headers(result)) > 1:
        yield _of_output(verdict.over_interval, lang, ".2g", turns=not output_travels(result.task))


def _output(optimum: Minimax, value: float, lang: str, form: str = "n") -> str:
    """An output angle in degrees, or a travel."""
    return _of_output(value, lang, form, turns=optimum.solution.row.output == "angle")


def _of_output(value: float, lang: str, form: str, *, turns: bool) -> str:
    return number(degrees(value), lang, form) + "°" if turns else number(value, lang, form)


def _print_missing_optima(shown: SynthesisResult, lang: str) -> None:
    """Which designs are not shown to be minimax optima, why, and by how much they may still be bettered."""
    for k, design in enumerate(shown.designs, 1):
        optimum = design.optimum
        if optimum is None or optimum.certificate.reason is None:
            continue
        facts = {"number": k, "reason": optimum.certificate.reason.in_language(lang)}
        if isnan(optimum.certificate.decrease):
            print(translate("* Design {number} is no minimax optimum: {reason}.", lang, **facts))
        else:
            decrease = _output(optimum, optimum.certificate.decrease, lang, ".2g")
            print(
                translate(
                    "* Design {number} is no minimax optimum: {reason}. To first order, dimensions within a tenth of "
                    "its own lower the largest error by up to {decrease}.",
                    lang,
                    decrease=decrease,
                    **facts,
                )
            )


def print_optimum(optimum: Minimax, law: FunctionLaw, lang: str) -> None:
    """Print the best design of a search for the minimax optimum, and what shows that it is one.

    Its dimensions have as many digits as give the stated error again.
    """
    solution, shown = optimum.solution, optimum.certificate
    form = f".{digits_for_error(optimum, law)}g"
    lengths = [f"{name} = {number(length, lang, form)}" for name, length in solution.named.items()]
    facts = {
        "error": _output(optimum, optimum.error, lang),
        "start": _output(optimum, optimum.start_error, lang),
        "lengths": number_separator(lang).join(lengths),
        "phi": number(degrees(solution.input_start), lang, form),
        "psi": _output(optimum, solution.output_start, lang, form),
    }
    if shown.optimum:
        text = translate(
            "Minimax optimum 1: largest error {error} (before: {start}); {lengths}; input from {phi}°, output from "
            "{psi}.",
            lang,
            **facts,
        )
        proof = translate(
            "It is taken at {places} places, {alternations} of them with alternating signs; {free} dimensions are "
            "free.",
            lang,
            places=len(shown.x),
            alternations=shown.alternations,
            free=shown.parameters,
        )
        if shown.curvature is not None:
            proof += " " + translate("Along all changes that keep these sizes equal they rise.", lang)
        print(f"{text} {proof}")
    else:
        print(
            translate(
                "Design 1: largest error {error} (before: {start}); {lengths}; input from {phi}°, output from {psi}.",
                lang,
                **facts,
            )
        )
