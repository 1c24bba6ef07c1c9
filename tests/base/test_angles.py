"""Angles in radians that look like degrees: which are warned of, at every door, and which are not."""

import re
import warnings
from math import pi
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import gruebler as gr
from gruebler.base.angles import doubt_of_angles
from gruebler.cli import main
from gruebler.design.synthesis import FunctionTask, PathTask, PositionTask
from gruebler.files.tasks import task_from_json
from gruebler.machines.geneva import Geneva
from gruebler.mechanics.kinematics import four_bars

CRANK_ROCKER = gr.FourBar(25, 70, 40, 70)
SLIDER = gr.Linkage.from_drawing(
    gr.Mechanism.parse("R(frame-crank) R(crank-rod) R(rod-piston) P(frame-piston); frame=frame; drive=P(frame-piston)"),
    {"R(frame-crank)": (0, 0), "R(crank-rod)": (300, 400), "R(rod-piston)": (1000, 0), "P(frame-piston)": (1000, 0, 0)},
)

DEGREES = {
    "every degree": np.arange(0, 361),
    "steps of ten degrees": np.linspace(0, 360, 37),
    "fifty values": np.linspace(0, 360, 50),
    "a thousand values": np.linspace(0, 360, 1000),
    "half degrees without the end": np.arange(0, 360, 0.5),
    "tenths of degrees downward": np.arange(90, -90, -0.1),
    "half degrees": np.linspace(-90, 90, 361),
    "a list": [0, 30, 60, 90],
    "one value": [90],
}
RADIANS = {
    "a turn": np.linspace(0, 2 * pi, 361),
    "ten turns in fine steps": np.linspace(0, 20 * pi, 2000),
    "ten turns in half turns": pi * np.arange(21),
    "to and fro": np.concatenate([np.linspace(0, 30, 400), np.linspace(30, 0, 400)]),
    "whole numbers within a turn": np.arange(7.0),
    "a number behind a turn": [7.5],
    "at a constant speed": 12.5 * np.linspace(0, 3, 300),
    "twenty turns in even steps": np.linspace(0, 40 * pi, 4000, endpoint=False),
    "seven turns by tenths": 0.1 * np.arange(450),
}


@pytest.mark.parametrize("values", DEGREES.values(), ids=DEGREES)
def test_degrees_are_doubted(values):
    assert doubt_of_angles(values, path=True)
    with pytest.warns(
        gr.UnitWarning, match=r"^R\(frame-crank\): angles are in radians, but .*from_degrees\(\) converts$"
    ):
        gr.move(CRANK_ROCKER, values)


@pytest.mark.parametrize("values", RADIANS.values(), ids=RADIANS)
def test_long_rotations_in_radians_are_not(values):
    assert doubt_of_angles(values, path=True) is None
    gr.move(CRANK_ROCKER, values)  # pytest makes errors of warnings
    CRANK_ROCKER.motion(values)


@given(
    start=st.integers(-36, 36), stop=st.integers(-36, 36), step=st.sampled_from([0.5, 1, 2, 5, 7.5, 10, 30, 90, 180])
)
def test_what_from_degrees_gives_is_never_doubted(start, stop, step):
    values = gr.from_degrees(10 * start, 10 * stop, step if stop >= start else -step)
    assert doubt_of_angles(values, path=True) is None
    assert doubt_of_angles(values) is None


@given(
    turns=st.floats(-50, 50).filter(lambda turns: abs(turns) > 0.01),
    rows=st.integers(2, 400),
    phase=st.floats(-3, 3),
)
def test_a_path_is_doubted_for_its_steps_alone(turns, rows, phase):
    """No multiple of pi is a whole number or a multiple of 90, so only steps beyond pi are left."""
    values = np.linspace(0, 2 * pi * turns, rows) + phase * 1.1
    coarse = abs(2 * pi * turns) / (rows - 1) > pi * (1 + 1e-8)
    fine = abs(2 * pi * turns) / (rows - 1) < pi * (1 - 1e-8)
    doubt = doubt_of_angles(values, path=True)
    assert doubt is not None if coarse else doubt is None or not fine


DOORS = {
    "move": lambda: gr.move(CRANK_ROCKER, [0.0, 4.0]),
    "move_many": lambda: gr.move_many(four_bars(25, np.linspace(60, 80, 3), 40, 70), np.arange(0, 361)),
    "assembly_modes": lambda: gr.assembly_modes(CRANK_ROCKER, 30),
    "circuit": lambda: gr.circuit(CRANK_ROCKER, at=30),
    "draw, drive": lambda: gr.draw(CRANK_ROCKER, at=30),
    "draw, between": lambda: gr.draw(CRANK_ROCKER, between=(10, 60)),
    "animate": lambda: gr.animate(CRANK_ROCKER, between=(10, 60)).svg(),
    "FourBar": lambda: CRANK_ROCKER.motion(30),
    "SliderCrank": lambda: gr.SliderCrank(20, 70).motion(np.linspace(0, 360, 721)),
    "InvertedSliderCrank": lambda: gr.InvertedSliderCrank(20, 70).motion(np.arange(0, 361)),
    "Geneva": lambda: Geneva(4).move(np.arange(0, 361)),
    "PositionTask": lambda: PositionTask([(0, 0, 0), (3, 1, 22.5), (5, 2, 45)]),
    "PathTask": lambda: PathTask([(0, 0), (3, 1), (5, 2)], angles=[None, 10.5, 20.5]),
    "FunctionTask": lambda: FunctionTask([10.5, 20, 30], outputs=[0.1, 0.2, 0.4]),
    "FunctionTask, outputs": lambda: FunctionTask([0.1, 0.2, 0.3], outputs=[10.5, 20, 30]),
    "reference pose": lambda: gr.Linkage(
        CRANK_ROCKER.linkage().mechanism,
        {
            "frame": {0: (0, 0), 3: (70, 0)},
            "crank": {0: (0, 0), 1: (25, 0)},
            "coupler": {1: (0, 0), 2: (70, 0)},
            "rocker": {3: (0, 0), 2: (40, 0)},
        },
        reference_pose={"crank": (0, 0, 30), "coupler": (20, 10, 1), "rocker": (70, 0, 2)},
    ),
    "a slide": lambda: gr.Linkage.from_drawing(
        SLIDER.mechanism,
        {
            "R(frame-crank)": (0, 0),
            "R(crank-rod)": (300, 400),
            "R(rod-piston)": (0, 700),
            "P(frame-piston)": (0, 700, 90),
        },
    ),
}


@pytest.mark.parametrize("call", DOORS.values(), ids=DOORS)
def test_every_door_that_takes_angles_warns_at_the_line_of_the_user(call):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    assert {(each.category, each.filename) for each in caught} == {(gr.UnitWarning, __file__)}
    assert len(caught) == (3 if call is DOORS["a slide"] else 1)  # drawn, and then on each of its two links


def test_the_library_does_not_doubt_its_own_angles(capsys):
    """What it moves for an answer was given in radians already, however far the rows are apart."""
    press = gr.SliderCrank(20, 50).linkage()
    loads = gr.Loads(forces={"R(coupler-slider)": (-100, 0)})
    motion = gr.move(press, np.radians([0.0, 90.0, 180.0, 270.0]))
    assert gr.statics(motion, loads, friction=0.1).drive.shape == (4, 1)
    assert main(["statics", "slider-crank:20,50", "--load", "R(coupler-slider)=-100,0", "--friction", "0.1", *AT]) == 0
    assert "radians" not in capsys.readouterr().err
    FunctionTask(np.linspace(0, 4 * pi, 5), outputs=[0.0, 0.3, 0.5, 0.3, 0.1])  # two turns of the input


AT = ["--at", "0", "--at", "270", "--at", "1000"]


def test_only_the_doors_of_a_motion_doubt_its_angles():
    """Inside the library `move_quietly` is called: what is computed there are radians."""
    sources = Path(gr.__file__).parent
    doors = {"mechanics/geometry/lever_contact.py"}  # that of the room is its stub
    importing = re.compile(
        r"^ *from gruebler\.mechanics\.kinematics(?:\.solve)? import [^(\n]*\bmove\b(?!_)", re.MULTILINE
    )
    found = {str(path.relative_to(sources)) for path in sources.rglob("*.py") if importing.search(path.read_text())}
    assert found == doors


def test_lengths_are_not_angles():
    crane = gr.Linkage.from_drawing(
        gr.Mechanism.parse("R(frame-arm) P(arm-hook) R(hook-rod) R(rod-frame); frame=frame; drive=P(arm-hook)"),
        {"R(frame-arm)": (0, 0), "P(arm-hook)": (700, 0, 0), "R(hook-rod)": (700, 0), "R(rod-frame)": (900, 600)},
    )
    two = gr.Linkage.from_drawing(
        gr.Mechanism.parse(
            "R(frame-arm) P(arm-hook) R(hook-rod) R(rod-lever) R(lever-frame); frame=frame; "
            "drive=R(frame-arm); drive=P(arm-hook)"
        ),
        {
            "R(frame-arm)": (0, 0),
            "P(arm-hook)": (700, 0, 0),
            "R(hook-rod)": (700, 0),
            "R(rod-lever)": (800, 500),
            "R(lever-frame)": (900, 0),
        },
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        gr.move(SLIDER, [900.0, 905.0, 950.0])
        FunctionTask([0.1, 0.2, 0.3], outputs=[10, 20, 30], output="travel")
        gr.draw(crane, at=700.0)
        gr.draw(two, at=[0.0, 700.0])
    assert [each for each in caught if each.category is gr.UnitWarning] == []


def test_degrees_on_the_command_line_and_in_files_are_degrees(tmp_path, capsys):
    assert main(["analyse", "four-bar:25,70,40,70", "--at", "0", "--at", "270", "--at", "720"]) == 0
    assert main(["draw", "four-bar:25,70,40,70", "--at", "405", "-o", str(tmp_path / "a.svg")]) == 0
    assert "radians" not in capsys.readouterr().err
    assert task_from_json({"positions": [[0, 0, 0], [3, 4, 405]]}).angles[1] == pytest.approx(np.radians(405))
