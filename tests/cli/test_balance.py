"""`gruebler balance` as a user meets it: the engine of test_dynamics.py, a mass of 2 kg in its slider alone."""

import json
import math
from pathlib import Path

import pytest

from tests.commands import run_command

ENGINE = str(Path(__file__).with_name("engine.toml"))
# The drive of this four-bar does not reach 90°: its links have 65 mm for 80.6.
BEAM = """
unit = "mm"
four_bar = { a = 40, b = 25, c = 40, d = 70 }
[loads.bodies]
crank = { mass = "2 kg", bar = [[0, 0], [40, 0]] }
coupler = { mass = "1 kg", bar = [[0, 0], [25, 0]] }
[[loads.springs]]
between = ["frame:0,60", "crank:20,0"]
free_length = 30
[[loads.springs]]
between = ["frame:0,60", "crank:20,0"]
damping = "1 N s/mm"
[[loads.springs]]
between = ["frame:70,-60", "rocker:20,0"]
gas = { force = "5 N", extended = 90, stroke = 60 }
"""


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


def test_springs_of_the_loads_are_fitted(capsys, tmp_path):
    """Of free length 0 by hand: 76 * 55 cm² of the stiffness are (36 kg * 110 cm + 4 kg * 55 cm) g."""
    found = json.loads(run_command(capsys, "balance", "garage_rail", "--fit-springs", "--json")[1])["fitted"]
    (spring,) = found["springs"]
    assert spring["stiffness"] == pytest.approx((36 * 110 + 4 * 55) * 9.80665 / (76 * 55), rel=1e-12)
    assert (found["mean_after"], found["largest_after"]) == (0, 0)
    path = tmp_path / "beam.toml"
    path.write_text(BEAM)
    arguments = ("balance", str(path), "--fit-springs", "--range", "0:60:5")
    mean, most = (
        json.loads(run_command(capsys, *arguments, *more, "--json")[1])["fitted"] for more in ((), ("--minimax",))
    )
    assert mean["mean_after"] == pytest.approx(mean["bound"])
    assert most["largest_after"] == pytest.approx(most["bound"])
    assert mean["mean_after"] < most["mean_after"] < 0.5 * mean["mean_before"]
    assert most["largest_after"] < mean["largest_after"] < 0.5 * mean["largest_before"]
    assert len(mean["springs"]) == 1  # neither the damper nor the gas spring
    status, out, _ = run_command(capsys, *arguments, "--lang", "de")
    assert status == 0
    assert "von frame:0,60 nach crank:20,0: " in out
    assert "Antriebe in N·mm: ohne Federn" in out
    status, _, err = run_command(capsys, *arguments[:-1], "0:90:5")
    assert (status, err) == (2, "the drives do not reach all values of --range")


ARM = """
unit = "mm"
joints = "R(frame-upper) R(upper-lower)"
drives = ["R(frame-upper)", "R(upper-lower)"]

[elements]
frame = { "R(frame-upper)" = [0, 0] }
upper = { "R(frame-upper)" = [0, 0], "R(upper-lower)" = [30, 0] }
lower = { "R(upper-lower)" = [0, 0] }

[loads]
bodies = { lower = { mass = "2 kg", centre = [20, 0] } }
springs = [{ between = ["frame:0,40", "upper:10,0"] }]
"""


def test_ranges_of_two_drives_are_combined(capsys, tmp_path):
    """Stretched out level, which the ranges side by side do not contain, the shoulder holds 2 kg at 50 mm."""
    path = tmp_path / "arm.toml"
    path.write_text(ARM)
    arguments = ("balance", str(path), "--fit-springs", "--range", "0:60:30", "--range=-60:0:20", "--json")
    whole = json.loads(run_command(capsys, *arguments)[1])
    # an open chain: 2 kg at 20 mm behind the elbow, and all that behind the shoulder at 30 mm
    weights = {each["link"]: each for each in whole["counterweights"]}
    assert weights["lower"]["product"] == pytest.approx(2 * 20)
    assert weights["upper"]["product"] == pytest.approx((2 + weights["lower"]["mass"]) * 30)
    found = whole["fitted"]
    assert found["largest_before"] == pytest.approx(2 * 9.80665 * 50)
    pairs = [(upper, lower) for upper in (0, 30, 60) for lower in (-60, -40, -20, 0)]
    elbow = [2 * 9.80665 * 20 * math.cos(math.radians(upper + lower)) for upper, lower in pairs]
    upper = [2 * 9.80665 * 30 * math.cos(math.radians(angle)) for angle, _ in pairs]
    shoulder = [a + b for a, b in zip(elbow, upper, strict=True)]
    assert found["mean_before"] == pytest.approx(math.sqrt(sum(x * x for x in elbow + shoulder) / 24))


def test_springs_that_cannot_help_are_called_so(capsys, tmp_path):
    """A spring below the weight pulls it down; its preload stays when its stiffness is 0."""
    path = tmp_path / "pulled.toml"
    path.write_text(
        'unit = "mm"\nfour_bar = { a = 25, b = 70, c = 40, d = 70 }\n[loads]\n'
        'springs = [{ between = ["frame:0,-60", "crank:20,0"], stiffness = "1 N/mm", preload = "5 N" }]\n'
        'bodies = { crank = { mass = "1 kg", centre = [20, 0] } }\n'
    )
    status, out, _ = run_command(capsys, "balance", str(path), "--fit-springs", "--range", "0:60:10")
    assert status == 0
    assert "crank:20,0: 0 N/mm" in out
    assert "They are no help at any stiffness" in out


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ([ENGINE, "--minimax"], "--minimax needs --partly or --fit-springs"),
        ([ENGINE, "--partly", "crank", "--on", "crank"], "--partly has its own links and no radius"),
        ([ENGINE, "--partly", "crank"], "--speed is missing"),
        ([ENGINE, "--partly", "coupler", "--speed", "60"], "'coupler' is not pinned to the frame"),
        ([ENGINE, "--on", "frame"], "a counterweight needs a link that moves"),
        ([ENGINE, "--irregularity", "2", "--speed", "60"], "the irregularity is a number between 0 and 2"),
        (["hood", "--partly", "link1", "--speed", "60"], "the drive does not turn fully"),
        (["lamp", "--fit-springs"], "2 drives: give --range FROM:TO:STEP once for each"),
        (["wiper", "--fit-springs"], "the loads have no spring"),
        (["garage_rail", "--range", "0:10:1"], "--range needs --fit-springs"),
        (["lambda"], "has no masses and no loads"),
    ],
)
def test_refusals(capsys, arguments, text):
    status, _, err = run_command(capsys, "balance", *arguments)
    assert status == 2
    assert text in err
