"""`gruebler dynamics` and `gruebler simulate` as a user meets them: an engine with a mass in its slider alone.

At constant speed the torque is m x'' dx/dq; left to itself, without loads, it keeps (J + m (dx/dq)²) ω² / 2.
"""

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest

from tests.commands import run_command

ENGINE = str(Path(__file__).with_name("engine.toml"))
MASS, INERTIA = 2.0, 500.0  # kg, kg mm²


def slopes(q):
    """dx/dq and d²x/dq² of x = r cos q + √(l² - r² sin² q), r = 30, l = 50."""
    root = np.sqrt(2500 - 900 * np.sin(q) ** 2)
    first = -30 * np.sin(q) - 450 * np.sin(2 * q) / root
    return first, -30 * np.cos(q) - 900 * np.cos(2 * q) / root - 450**2 * np.sin(2 * q) ** 2 / root**3


def document(capsys, *arguments):
    status, out, err = run_command(capsys, *arguments, "--json")
    assert err == ""
    found = json.loads(out)
    return (
        status,
        found,
        {c["name"]: np.array([row[k] for row in found["rows"]]) for k, c in enumerate(found["columns"])},
    )


def test_an_engine_at_constant_speed(capsys):
    status, found, columns = document(capsys, "dynamics", ENGINE, "--speed", "300")
    speed = 300 * math.pi / 30
    q = np.radians(columns["R(frame-crank)"])
    first, second = slopes(q)
    torque = MASS * speed**2 * second * first / 1000  # N mm: the acceleration in m/s²
    assert (status, len(q), found["complete"]) == (0, 25, True)
    assert columns["torque R(frame-crank)"] == pytest.approx(torque, abs=1e-9 * abs(torque).max())
    assert columns["power R(frame-crank)"] == pytest.approx(torque * speed / 1000, abs=1e-9 * abs(torque).max())
    assert columns["shaking force x"] == pytest.approx(-MASS * speed**2 * second / 1000, rel=1e-9)
    assert found["peak"] == [pytest.approx(abs(torque).max())]
    assert found["root_mean_square"] == [pytest.approx(math.sqrt((torque[:-1] ** 2).mean()))]  # 360° is 0°
    assert found["disagreement"] < 1e-12


def test_what_it_prints(capsys):
    status, out, _ = run_command(capsys, "dynamics", ENGINE, "--speed", "300", "--range", "0:90:30")
    first, second = slopes(math.radians(30))
    torque = MASS * (300 * math.pi / 30) ** 2 * first * second / 1000
    assert status == 0
    assert f"Largest effort: torque R(frame-crank) = {torque:.0f} N·mm at R(frame-crank) = 30°; effective" in out
    assert "Equilibrium and equations of motion agree to" in out


def test_an_engine_left_to_itself(capsys, tmp_path):
    arguments = ("simulate", ENGINE, "--until", "0.5", "--at", "10", "--speed", "300")
    status, found, columns = document(capsys, *arguments)
    assert (status, found["complete"], found["message"]) == (0, True, "")
    assert columns["time"] == pytest.approx(np.linspace(0, 0.5, 21))
    energy = (INERTIA + MASS * slopes(math.radians(10))[0] ** 2) * (300 * math.pi / 30) ** 2 / 2
    first = slopes(np.radians(columns["R(frame-crank)"]))[0]
    speed = np.sqrt(2 * energy / (INERTIA + MASS * first**2))
    assert columns["v slider"] == pytest.approx(first * speed, abs=1e-6 * abs(first * speed).max())
    assert columns["kinetic energy"] == pytest.approx(np.full(21, energy / 1e6), rel=1e-8)  # J
    assert found["defect"] < 1e-7
    status, _, _ = run_command(capsys, *arguments, "-o", str(tmp_path / "run.csv"))
    with (tmp_path / "run.csv").open(encoding="utf-8-sig", newline="") as file:
        rows = list(csv.reader(file))
    assert (status, len(rows), rows[0][0]) == (0, 22, "time [s]")


def test_it_says_how_well_energy_is_kept(capsys):
    status, out, _ = run_command(capsys, "simulate", ENGINE, "--until", "0.1", "--speed", "300", "--at", "10")
    assert status == 0
    assert "Energy is kept to" in out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["dynamics", ENGINE], "--speed is missing"),
        (["dynamics", ENGINE, "--speed", "0"], "--speed: expected a number that is not 0"),
        (["simulate", ENGINE, "--until", "-1"], "--until: expected a time in seconds after 0"),
        (["simulate", ENGINE, "--until", "1", "--rows", "1"], "--rows: expected a number from 2 to 100000"),
        (["dynamics", "lambda", "--speed", "60"], "'lambda' has no masses and no loads; the table [loads]"),
        (["dynamics", "25,70,40,70", "--speed", "60"], "'25,70,40,70' has no masses and no loads"),
        (["simulate", ENGINE, "--until", "1"], "engine.toml has no position to start from"),
        (["dynamics", "lambada", "--speed", "60"], "the catalog has no entry 'lambada'; did you mean lambda, lamp?"),
        (["dynamics", "delta", "--speed", "60"], "'delta' does not move in a plane, and this command takes linkages"),
        (["dynamics", "tri", "--speed", "60"], "'tri' has the screws of its joints in one position"),
        (["dynamics", "lost.csv", "--speed", "60"], "'lost.csv' is neither a file here nor a catalog entry"),
        (["dynamics", "lost.toml", "--speed", "60"], "lost.toml: cannot be read"),
    ],
)
def test_absurd_input(capsys, arguments, sentence):
    status, out, err = run_command(capsys, *arguments)
    assert (status, out) == (2, "")
    assert sentence in err


def test_a_file_without_masses(capsys, tmp_path):
    path = tmp_path / "bare.toml"
    path.write_text('unit = "mm"\nfour_bar = { a = 25, b = 70, c = 40, d = 70 }\n')
    status, _, err = run_command(capsys, "dynamics", str(path), "--speed", "60")
    assert status == 2
    assert "has no masses and no loads; a table [loads] has them" in err


def test_a_drive_that_swings_needs_a_range(capsys, tmp_path):
    path = tmp_path / "swing.toml"
    path.write_text(
        'unit = "mm"\nfour_bar = { a = 60, b = 40, c = 60, d = 90 }\n[loads.bodies]\ncoupler = { mass = "1 kg" }\n'
    )
    status, _, err = run_command(capsys, "dynamics", str(path), "--speed", "60")
    assert status == 2
    assert "cannot keep its speed at its limits" in err
    assert run_command(capsys, "dynamics", str(path), "--speed", "60", "--range", "40:60:10")[0] == 0


def test_machines_of_the_catalog(capsys):
    """Their usual speed is taken, their names are German in German, and they stop at the ends of their range."""
    status, out, err = run_command(capsys, "dynamics", "compressor", "--range", "0:360:90")
    assert (status, err) == (0, "")
    assert "Largest effort: torque R(frame-crank)" in out
    _, twice, _ = run_command(capsys, "dynamics", "compressor", "--range", "0:360:90", "--speed", "1450")
    assert twice == out
    assert "D(Kurbel-Pleuel)" in run_command(capsys, "dynamics", "compressor", "--at", "30", "--lang", "de")[1]
    status, out, _ = run_command(capsys, "simulate", "hood", "--until", "3", "--at", "125", "--tolerance", "1e-5")
    assert status == 1
    assert "R(body-link1) reaches the end of its range" in out


def test_friction_takes_its_power(capsys):
    """What the drive gives more than without friction is friction times the speed of the piston, by the closed form."""
    asked = ("dynamics", ENGINE, "--speed", "300", "--range", "25:335:45", "--friction", "P(frame-slider)=0.2")
    status, found, columns = document(capsys, *asked)
    assert (status, found["locked"]) == (0, [])
    rubbing = np.abs(columns["friction P(frame-slider)"])
    assert rubbing.min() > 0
    first, _ = slopes(np.radians(columns["R(frame-crank)"]))
    more = columns["torque R(frame-crank) with friction"] - columns["torque R(frame-crank)"]
    assert more == pytest.approx(rubbing * np.abs(first), rel=1e-9)
    assert run_command(capsys, "dynamics", ENGINE, "--speed", "300", "--pin-radius", "3")[0] == 2


@pytest.mark.parametrize(
    ("loads", "words"),
    [
        ('bodies = { slider = { mass = "-2 kg" } }', "the mass must be a finite number that is not negative"),
        (
            'bodies = { crank = { mass = "2 kg", centre = [9, 0], about = [0, 0], inertia = "1 kg mm2" } }',
            "mass times distance squared, 162, not 1",
        ),
        ('forces = { "R(x-y)" = ["1 N", "0 N"] }', "R(x-y)"),
        ('bodies = { slider = { mass = "2" } }', "loads.bodies.slider.mass: "),
        ('springs = [{ between = ["frame:0,0", "crank:1,0"], free_length = -3 }]', "the free length"),
    ],
)
def test_loads_that_cannot_be_are_one_sentence(loads, words, tmp_path, capsys):
    path = tmp_path / "engine.toml"
    path.write_text(f'unit = "mm"\nslider_crank = {{ a = 30, b = 50 }}\n[loads]\n{loads}\n', encoding="utf-8")
    status, out, err = run_command(capsys, "dynamics", str(path), "--speed", "60")
    assert (status, out) == (2, "")
    assert err.startswith(f"{path}: ")
    assert "\n" not in err
    assert words in err


def test_an_entry_goes_past_the_ends_of_its_range(capsys):
    """A treadle passes its dead centres, which its range keeps away from pictures."""
    words = ("simulate", "sewing", "--until", "1", "--at", "85", "--speed=-10", "--tolerance", "1e-6")
    status, out, _ = run_command(capsys, *words)
    assert status == 1
    assert "reaches the end of its range" in out
    assert run_command(capsys, *words, "--no-ends")[0] == 0


def test_the_phase_plane_of_a_free_motion_is_drawn(capsys, tmp_path):
    """The pumpjack starts at half a turn; the curve has 401 places."""
    picture = tmp_path / "phase.svg"
    words = ("simulate", "pumpjack", "--until", "6", "--speed", "5", "--json")
    status, out, _ = run_command(capsys, *words, "--draw", str(picture))
    assert (status, len(json.loads(out)["rows"])) == (0, 401)
    text = picture.read_text("utf-8")
    assert "ω in rad/s" in text
    assert "φ in °" in text
    status, _, err = run_command(capsys, *words, "--draw", str(tmp_path / "a.doc"))
    assert status == 2
    assert "a.doc" in err
    status, _, err = run_command(capsys, "simulate", "lamp", "--until", "1", "--draw", str(picture))
    assert status == 2
    assert "the phase plane has one drive, but there are 2" in err
