"""Pictures of tasks: Burmester's curves, structural errors, the best designs side by side."""

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.design.synthesis import (
    FunctionLaw,
    FunctionTask,
    PositionTask,
    function_task,
    structural_error,
    synthesise,
)
from gruebler.design.synthesis.burmester import burmester_curves
from gruebler.design.synthesis.structural_errors import coordination_of
from gruebler.pictures.canvas.shapes import TextShape
from gruebler.pictures.designs.picture import design_figure, designs_figure, designs_page
from gruebler.pictures.designs.plots import burmester_plot, finite_poles, function_plot, output_of

FOUR = PositionTask([(0, 0, 0), (2.1, 0.9, 0.35), (3.2, 1.0, 0.8), (4.0, 0.2, 1.5)])
LAW = FunctionLaw("log10(x)", interval=(1, 2), input_swing=np.pi / 3, output_swing=np.pi / 3)


def texts(figure):
    return [shape.text for shape in figure.shapes if isinstance(shape, TextShape)]


def test_burmesters_curves_pass_through_the_poles():
    """The centre-point curve through all six, the circle-point curve through those of the first position."""
    curves = burmester_curves(FOUR, points=4000)
    moving = np.concatenate([piece.moving for piece in curves.pieces])
    fixed = np.concatenate([piece.fixed for piece in curves.pieces])
    places = finite_poles(FOUR)
    assert len(places) == 6
    for name, pole in places.items():
        assert np.abs(fixed - pole).min() < 0.01
        if name.startswith("P₁"):
            assert np.abs(moving - pole).min() < 0.01
    turn = FOUR.turns[1]
    assert FOUR.origins[1] - turn * FOUR.origins[0] == pytest.approx(places["P₁₂"] * (1 - turn))


@pytest.mark.parametrize("lang", [pytest.param("en", marks=pytest.mark.slow), "de"])
def test_the_plot_of_burmesters_curves_names_poles_positions_and_pivots(lang):
    result = synthesise(FOUR, number=6, sort="size")  # a pivot far away lies outside of the plot
    design = next(design for design in result.designs if design.form == "RR-RR")
    written = texts(burmester_plot(FOUR, design, lang=lang))
    assert {"P₁₂", "P₃₄", "1", "4", "A", "A₀"} <= set(written)
    assert sum("." in text or "," in text for text in written if text[:1] == "0") >= 4  # tenths of the parameter


@pytest.mark.parametrize("output", ["angle", "travel"])
def test_the_plotted_output_is_that_of_the_closed_form(output):
    """By the solver of motion, against the formulas of four-bar and slider-crank; the pairs are met."""
    swing = np.pi / 3 if output == "angle" else 1.5
    task = function_task(
        FunctionLaw("log10(x)", interval=(1, 2), input_swing=np.pi / 3, output_swing=swing), 5, output=output
    )
    law = task.law
    checked = 0
    for design in synthesise(task).designs:
        pairs = output_of(design, np.array(task.inputs) - task.inputs[0])
        assert np.abs(pairs - np.array(task.outputs) + task.outputs[0]).max() < 1e-9
        solution = coordination_of(design, task, law)
        if solution is None:
            continue
        x = np.linspace(1, 2, 15)
        inputs, outputs = law.inputs(x), law.outputs(x)
        own = output_of(design, inputs - task.inputs[0]) - (outputs - task.outputs[0])
        assert own == pytest.approx(structural_error(solution, law, x), abs=1e-9)
        checked += 1
    assert checked


def test_the_plot_of_a_function_marks_its_pairs():
    task = function_task(LAW, 5)
    design = synthesise(task).designs[0]
    written = texts(function_plot(task, design))
    assert written.count("3") == 2  # on the output and on the structural error
    assert "structural error in °" in written
    marks = texts(design_figure(task, design))
    assert {"1", "5", "1′", "5′"} <= set(marks)
    table = FunctionTask(task.inputs, outputs=task.outputs, start_input=False, start_output=False)
    assert not any("error" in text for text in texts(function_plot(table, synthesise(table).designs[0])))


def test_the_best_designs_stand_side_by_side(tmp_path):
    result = synthesise(FOUR, number=4)
    figure = designs_figure(result, most=2)
    captions = [text for text in texts(figure) if text[:3] in ("1. ", "2. ", "3. ")]
    assert [text[0] for text in captions] == ["1", "2"]
    assert figure.width >= 2 * design_figure(FOUR, result.designs[0]).width - 1
    page = designs_page(result, most=1)
    assert "circle-point curve" in page
    task = tmp_path / "four.csv"
    task.write_text("".join(f"{x},{y},{np.degrees(a)}\n" for x, y, a in FOUR.positions), encoding="utf-8")
    picture = tmp_path / "designs.svg"
    assert main(["synthesise", "positions", str(task), "--number", "3", "--draw", str(picture)]) == 0
    assert "centre-point curve" in picture.read_text(encoding="utf-8")
