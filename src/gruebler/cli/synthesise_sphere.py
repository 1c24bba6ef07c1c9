"""`gruebler synthesise orientations` and `spherical-function`: four-bars on the sphere."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from math import degrees, radians
from typing import Any

import numpy as np

from gruebler.base.errors import SynthesisError
from gruebler.base.plain_data import plain
from gruebler.base.text import joined, message, number, translate
from gruebler.cli.design_files import check_demands, check_picture, chosen_design
from gruebler.cli.design_tables import marks_in_words, print_rejected, print_solutions, transmission_text
from gruebler.cli.output import print_json, say_written, write_file
from gruebler.cli.parser import Parser
from gruebler.cli.tables import Cell, print_table, print_text
from gruebler.design.synthesis import (
    Demands,
    FunctionTask,
    synthesise_orientations,
    synthesise_spherical_function,
)
from gruebler.design.synthesis.spherical import SphericalDesign, SphericalResult
from gruebler.files.orientations import read_orientations
from gruebler.files.screws import screws_to_json, write_screws
from gruebler.pictures.canvas.files import SUFFIXES, picture_bytes, suffix_of

_DRAWN = 6
_COLUMNS = (
    message("design"),
    message("full turn"),
    message("µ on the way"),
    message("arcs"),
    message("error"),
    message("shift"),
    message("crank angles"),
)
_OUTPUTS = message("output angles")
_SHIFT = message(
    "Shift: how far the most sensitive target turns if all arcs are wrong by 0.1 %, in the worst case; the crank keeps "
    "its angle."
)
_PLAY = message(
    "Arcs wrong by up to 0.1 %, axes tilted by {clearance:g}° in their bearings, to first order; the crank keeps its "
    "angle."
)


def add(parser: Parser) -> None:
    """Add the arguments that both commands have after their tasks."""
    parser.take(
        """
        --crank
        --transmission
        --size-ratio
        --sort KEY[,KEY] =  sort the designs by transmission, size-ratio, sensitivity, full-turn; of equal ones the
            second key decides
        --clearance DEG float  print how far targets turn, arcs wrong by a thousandth and axes tilted by DEG in their
            bearings
        --number N int =16  give the N best designs only
        --rejected
        """
    )
    parser.add_json(help="print an object with all linkages")
    parser.add_out(help="write the best linkage to a file: .toml or .json", endings=("toml", "json"))
    parser.take(
        """
        --design
        --draw FILE path  draw the best six designs: .svg, .png or .pdf
        """
    )


def turn_body(arguments: argparse.Namespace) -> int:
    """The designs for orientations. Status 1: no design was accepted."""
    demands = _demands(arguments)
    result = synthesise_orientations(
        read_orientations(arguments.task), demands, number=arguments.number, sort=_orders(arguments)
    )
    return _tell(arguments, result, coordinates=False)


def coordinate(arguments: argparse.Namespace, task: FunctionTask) -> int:
    """The designs for pairs of angles. Status 1: no design was accepted."""
    demands = _demands(arguments)
    if task.output != "angle":
        raise SynthesisError("output: four-bars on the sphere coordinate angles, not a travel")
    if task.start_input != task.start_output:
        raise SynthesisError("on the sphere both starts are given, or both are free")
    result = synthesise_spherical_function(
        task.inputs,
        task.outputs,
        demands,
        frame=None if arguments.frame is None else radians(arguments.frame),
        free_starts=not task.start_input,
        number=arguments.number,
        sort=_orders(arguments),
    )
    return _tell(arguments, result, coordinates=True)


def _orders(arguments: argparse.Namespace) -> list[str]:
    return [name.strip() for name in arguments.sort.split(",") if name.strip()]


def _demands(arguments: argparse.Namespace) -> Demands:
    if arguments.draw is not None:
        check_picture(arguments.draw, SUFFIXES)
    check_demands(arguments)
    if arguments.clearance is not None and not 0 <= arguments.clearance < 90:
        raise SynthesisError(
            "--clearance: expected at least 0 and less than 90 degrees, but found {clearance:g}",
            clearance=arguments.clearance,
        )
    return Demands(crank=arguments.crank, transmission=radians(arguments.transmission), size_ratio=arguments.size_ratio)


def _tell(arguments: argparse.Namespace, result: SphericalResult, *, coordinates: bool) -> int:
    """Print the designs, write and draw the best."""
    result = replace(result, designs=result.designs[: arguments.number])
    written = chosen_design(arguments, result.designs)
    if written is not None:
        write_screws(arguments.out, written.linkage)
        say_written(arguments.out, arguments.lang)
    if arguments.draw is not None and (shown := (result.designs or result.rejected)[:_DRAWN]):
        _draw(arguments, shown)
    if arguments.json:
        print_json(_document(result))
    else:
        _print(result, arguments.rejected, arguments.lang, coordinates=coordinates)
        if arguments.clearance is not None and result.designs:
            _print_clearance(result.designs, arguments.clearance, arguments.lang)
    return 0 if result.designs else 1


def _draw(arguments: argparse.Namespace, shown: Sequence[SphericalDesign]) -> None:
    from gruebler.pictures.canvas.arrangement import captioned, pictures_in_one
    from gruebler.pictures.space import draw_spatial

    lang = arguments.lang
    figures = [
        captioned(draw_spatial(design.linkage, lang=lang), f"{k}: {_arcs(design, lang)}")
        for k, design in enumerate(shown, 1)
    ]
    figure = pictures_in_one(figures, translate("Designs", lang), min(3, len(figures)))
    write_file(arguments.draw, picture_bytes(figure, suffix_of(arguments.draw, SUFFIXES)), lang)


def _arcs(design: SphericalDesign, lang: str) -> str:
    return ", ".join(f"{arc} = {number(degrees(getattr(design.four_bar, arc)), lang, 'n')}°" for arc in "abcd")


def _turned(angle: float, lang: str) -> str:
    return f"{number(degrees(angle), lang, '.2g')}°"


def _print_clearance(designs: Sequence[SphericalDesign], clearance: float, lang: str) -> None:
    """How far targets turn with wrong arcs and play: at most, and in random linkages."""
    rows: list[list[Cell]] = []
    for k, design in enumerate(designs, 1):
        worst = float(design.sensitivity.of_errors(clearance=radians(clearance)).max())
        sampled = design.sensitivity.sampled(clearance=radians(clearance))
        usual = float(np.quantile(sampled, 0.99, axis=0).max())
        rows.append([str(k), _turned(worst, lang), _turned(usual, lang)])
    print()
    print_table((message("design"), message("worst case"), message("99 % of random linkages")), rows, lang=lang)
    print_text(_PLAY.filled(clearance=clearance).in_language(lang))


def _document(result: SphericalResult) -> dict[str, Any]:
    def listed(designs: Sequence[SphericalDesign]) -> list[dict[str, Any]]:
        return [
            {
                **plain(design.verdict, "accepted reasons one_branch in_order turns_fully size_ratio error"),
                "transmission_through_targets": degrees(design.verdict.transmission),
                "arcs": {arc: degrees(getattr(design.four_bar, arc)) for arc in "abcd"},
                "branch": design.branch,
                "drives": [degrees(value) for value in design.drives],
                "outputs": [degrees(value) for value in design.outputs],
                "sensitivity": {
                    "relative": design.relative_sensitivity,
                    "worst": [degrees(value) for value in design.sensitivity.worst],
                },
                "linkage": screws_to_json(design.linkage),
            }
            for design in designs
        ]

    return {
        "count": plain(result.count, "what theorem found infinite real"),
        "notes": [str(note) for note in result.notes],
        "designs": listed(result.designs),
        "rejected": listed(result.rejected),
    }


def _print(result: SphericalResult, rejected: bool, lang: str, *, coordinates: bool) -> None:
    print_solutions(result.count, result.notes, (len(result.designs), len(result.rejected)), lang)
    rows: list[list[Cell]] = [
        [
            str(k),
            message("yes") if design.verdict.turns_fully else message("no"),
            transmission_text(design.verdict.transmission, lang),
            _arcs(design, lang),
            "< 1e-9" if design.verdict.error < 1e-9 else number(design.verdict.error, lang, ".1e"),
            _turned(design.relative_sensitivity, lang),
            *(
                joined((f"{number(degrees(value), lang, '.1f')}°" for value in values), " ")
                for values in (design.drives, design.outputs)[: 1 + coordinates]
            ),
        ]
        for k, design in enumerate(result.designs, 1)
    ]
    if rows:
        print_table((*_COLUMNS, _OUTPUTS) if coordinates else _COLUMNS, rows, lang=lang)
        marks = marks_in_words(design.verdict.transmission for design in result.designs)
        print_text(joined([*marks, _SHIFT], " ").in_language(lang))
    else:
        print(translate("None of the designs examined meets the task.", lang))
    print_rejected([(f"RR-RR {_arcs(d, lang)}", d.verdict.reasons) for d in result.rejected], not rows, rejected, lang)
