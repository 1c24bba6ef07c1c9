"""`gruebler balance` as a user meets it: the engine of test_dynamics.py, a mass of 2 kg in its slider alone."""

import json
import math
from pathlib import Path

import pytest

from tests.commands import run_command

ENGINE = str(Path(__file__).with_name("engine.toml"))


def test_an_engine_is_balanced_behind_both_pins(capsys):
    """By hand: 2 kg at 50 mm need 10/3 kg at 30 mm; both on the crank, at 30 mm, need as much on its other side."""
    status, out, err = run_command(capsys, "balance", ENGINE, "--radius", "30", "--json")
    found = json.loads(out)
    assert (status, err, found["possible"], found["blocked"]) == (0, "", True, [])
    crank, rod = found["counterweights"]
    assert rod == {"link": "coupler", "mass": pytest.approx(10 / 3), "place": [-30, 0], "product": pytest.approx(100)}
    assert crank == {"link": "crank", "mass": pytest.approx(16 / 3), "place": [-30, 0], "product": pytest.approx(160)}
    status, out, _ = run_command(capsys, "balance", ENGINE, "--lang", "de")
    assert out.startswith("Mit diesen Gegenmassen bleibt der Schwerpunkt aller Massen in Ruhe:")
    assert "4 kg bei (-30; 0), 120 kg·mm" in out  # each weight at the length of its link


def test_partly_with_a_flywheel(capsys):
    arguments = ("balance", ENGINE, "--speed", "300", "--partly", "crank", "--minimax", "--irregularity", "0.1")
    status, out, _ = run_command(capsys, *arguments)
    assert status == 0
    assert "crank: mass times radius " in out
    largest = 2 * 0.03 * (10 * math.pi) ** 2 * 1.6  # by hand: m r w² (1 + r/l)
    assert f"Largest shaking force: {largest:.4g} N without" in out
    assert "Flywheel on the drive: moment of inertia" in out
    found = json.loads(run_command(capsys, *arguments, "--json")[1])
    assert found["largest_after"] < found["largest_before"] == pytest.approx(largest, rel=1e-12)
    assert found["bound"] == pytest.approx(found["largest_after"], rel=1e-6)
    assert found["flywheel"]["torque"] == pytest.approx(0, abs=1e-9)
    assert set(found["harmonics"]) == {str(n) for n in range(-4, 5)}


def test_springs(capsys):
    status, out, _ = run_command(capsys, "balance", "pumpjack", "--springs", "1000")
    assert status == 0
    assert out.count("N/dm") == 3


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ([ENGINE, "--minimax"], "--minimax needs --partly"),
        ([ENGINE, "--partly", "crank", "--on", "crank"], "--partly has its own links and no radius"),
        ([ENGINE, "--partly", "crank"], "--speed is missing"),
        ([ENGINE, "--partly", "coupler", "--speed", "60"], "'coupler' is not pinned to the frame"),
        ([ENGINE, "--on", "frame"], "a counterweight needs a link that moves"),
        ([ENGINE, "--irregularity", "2", "--speed", "60"], "the irregularity is a number between 0 and 2"),
        (["hood", "--partly", "link1", "--speed", "60"], "the drive does not turn fully"),
        (["lambda"], "has no masses and no loads"),
    ],
)
def test_refusals(capsys, arguments, text):
    status, _, err = run_command(capsys, "balance", *arguments)
    assert status == 2
    assert text in err
