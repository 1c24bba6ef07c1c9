"""The linear transfer function of a pair of wheels, step by step."""

from __future__ import annotations

from gruebler.base.errors import LinkageError
from gruebler.base.text import message
from gruebler.machines.gears import read_train, speeds
from gruebler.mechanics.linkages.quantities import as_positive
from gruebler.teaching.exercises.solution import (
    Solution,
    SolutionBuilder,
    SolutionStep,
    as_step,
    figure,
    formula_number,
)

_MOST = 10_000  # rows


def gear_pair(i: float, step: float = 90) -> Solution:
    """The transfer function of one pair of gears with the ratio i, over one turn of the driven wheel.

    >>> gear_pair(2).number("slope")
    0.5
    """
    if as_positive("i", i) * 360 > _MOST * as_step(step):
        raise LinkageError(
            "the table has at most {most} rows, too few for i = {i:g} in steps of {step:g} degrees",
            most=_MOST,
            i=i,
            step=step,
        )
    builder = SolutionBuilder()
    name = message("slope of the transfer function, magnitude")
    numbers = f"1/{formula_number(i)}"
    builder.parts.append(SolutionStep(text=name, formula="|ψ'| = 1/|i|", numbers=numbers, value=1 / i))
    builder.keep("slope", name, 1 / i, symbol="|ψ'|")
    builder.say(
        "ψ grows evenly with φ: the graph is a straight line through the origin. An external pair turns in "
        "opposite senses; with signs i is negative and the line falls, ψ = −φ/|i|.",
        "|ψ| = |φ|/|i|",
    )
    rows = [(k * step, k * step / i) for k in range(int(360 * i / step + 1e-9) + 1)]
    title = message("Transfer function, magnitudes")
    builder.table(title, ["φ [°]", "ψ [°]"], rows)
    builder.keep("turns", message("turns of the drive for one of the output"), i)
    teeth = 20
    reading = (
        read_train(f"drive:{teeth} wheel:{formula_number(teeth * i)}; drive=1")
        if float(teeth * i).is_integer()
        else None
    )
    if reading is not None:
        speed = speeds(reading.train, {"drive": 1}).values["wheel"]
        builder.check(
            "Slope by the gear train {driver}:{wheel}",
            1 / i,
            abs(float(speed or 0)),
            "",
            driver=teeth,
            wheel=figure(teeth * i),
        )
    builder.mistake(
        "slope", float(i), message("i is input divided by output; the slope is output divided by input, 1/|i|.")
    )
    builder.mistake("slope", -1 / i, message("The magnitude is asked for; with signs an external pair has −1/|i|."))
    return builder.done()
