"""The drawings that an exercise asks for: chains of its machines, chains found, transfer functions to scale."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gruebler.base.text import Readable, translate
from gruebler.files import Exercise
from gruebler.mechanics.fourbar import SliderCrank
from gruebler.pictures.canvas.axes import Axis, angles, decimals
from gruebler.pictures.canvas.figure import Figure
from gruebler.pictures.canvas.panels import Panel, PlottedCurve, PointMarker, draw_panels
from gruebler.pictures.canvas.shapes import Point
from gruebler.pictures.structure import draw_structure
from gruebler.structure.chain import Chain
from gruebler.teaching.catalog import entry
from gruebler.teaching.exercises import PartHeading, Solution, TeachingTable

_SIZE = Point(460.0, 230.0)
_FINE = 361  # points of a curve


@dataclass(frozen=True, slots=True)
class SolutionFigure:
    """A drawing that an exercise asks for."""

    figure: Figure
    caption: str
    before: int
    """The number of the part before which it stands: that of the steps that count the drawn chain, or the part after a
    table that it shows."""


def solution_figures(exercise: Exercise, solution: Solution, lang: str = "en") -> Iterator[SolutionFigure]:
    """Each drawing with its place among the parts; the linkage itself is drawn by `linkage_figure`.

    >>> from gruebler.teaching.exercises import exercise, solve
    >>> [(drawing.caption, drawing.before) for drawing in solution_figures(exercise("6"), solve(exercise("6")))]
    [('Double joint at the crank pin', 0)]
    """
    if exercise.method == "mobility.machines":
        begins = [k + 1 for k, part in enumerate(solution.parts) if isinstance(part, PartHeading)] or [0]
        for case, before in zip(exercise.cases, begins, strict=True):
            machine, name = entry(case.machine), case.name.in_language(lang)
            names = machine.link_names(lang)
            figure = draw_structure(machine.chain(), labels=True, lang=lang, name=name, names=names)
            yield SolutionFigure(figure, name, before)
    for after, table in enumerate(solution.parts, 1):
        if not isinstance(table, TeachingTable):
            continue
        if exercise.method in ("transfer.gear_pair", "dead_centres.stroke_table"):
            yield SolutionFigure(_transfer_function(exercise, table, lang), table.title.in_language(lang), after)
        elif exercise.method in ("dyads.dyad", "dyads.coupler"):
            for called, chain, *_ in table.rows:
                figure = draw_structure(Chain.parse(str(chain)), labels=True, lang=lang)
                yield SolutionFigure(figure, str(called), after)


def _transfer_function(exercise: Exercise, table: TeachingTable, lang: str) -> Figure:
    """The rows of the table as points on the curve, which the closed form gives between them."""
    stroke = exercise.method == "dead_centres.stroke_table"
    column = -2 if stroke else -1
    rows = np.array([[float(str(value)) for value in row] for row in table.rows])
    x, y = rows[:, 0], rows[:, column]
    fine = np.linspace(x[0], x[-1], _FINE)
    curve = np.interp(fine, x, y)
    if stroke:
        given = {key: float(value) for key, value in exercise.given.items() if isinstance(value, int | float)}
        size = SliderCrank(given["a"], given.get("b", given["a"] / given.get("ratio", 1.0)), given.get("e", 0.0))
        curve = size.motion(np.radians(np.interp(fine, x, rows[:, 1]))).output.value
    across, upward = (_word(table.headers[k], lang) for k in (0, column))
    panel = Panel(
        across=Axis(across, angles(x[0], x[-1])),
        up=Axis(upward, decimals(min(0.0, float(curve.min())), float(curve.max()), few=6)),
        curves=(PlottedCurve(x=fine, y=np.asarray(curve, float), name="", style="line-1"),),
        spots=tuple(PointMarker(x=a, y=b, text="") for a, b in zip(x, y, strict=True)),
        size=_SIZE,
    )
    about = translate("The points are the rows of the table.", lang)
    return draw_panels([panel], table.title.in_language(lang), about, lang)


def _word(header: str | Readable, lang: str) -> str:
    return header if isinstance(header, str) else header.in_language(lang)
