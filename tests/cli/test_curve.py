"""`gruebler curve` as a user meets it."""

import csv
import json
import math

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.mechanics.kinematics import move
from gruebler.teaching.catalog import entry
from tests.commands import run_command


def run(capsys, *arguments):
    status, out, err = run_command(capsys, "curve", *arguments)
    return status, out or err


def test_a_path_in_words(capsys):
    status, out = run(capsys, "inverted-slider-crank:30,50", "coupler:90,0")
    assert status == 0
    assert "The path is closed: length 190.3, area 2529, run through clockwise." in out
    # E17: inflections at 80.55 and 147.09 degrees, mirrored; curvature 0.021088 and 1.233333 at 0 and 180
    rows = [line.split() for line in out.splitlines()]
    assert [row[1] for row in rows if row[:1] == ["inflection"]] == [
        "80.56°",
        "147.1°",
        "212.9°",
        "279.4°",
    ]
    assert ["vertex", "180°", "60", "0", "radius", "-0.8108"] in rows


def test_a_six_point_contact_in_german(capsys):
    status, out = run(capsys, "mzc", "K", "--contact", "180", "--lang", "de")
    assert status == 0
    assert "Bei 180° haben Bahn und Tangente 6 Punkte gemeinsam: y = -0,000155 x^6." in out
    assert "Flachpunkt  " in out
    assert "Radius ∞" in out


def test_between_limits_and_back(capsys):
    status, out = run(capsys, "four-bar:60,30,30,70", "coupler:15,20")
    assert status == 0
    assert "The path goes from -54.31° to 54.31°" in out
    assert "double point       -54.25°, -33.09°" in out
    _, out = run(capsys, "slider-crank:20,50", "R(coupler-slider)", "--contact", "60", "--direction", "90")
    assert "agrees with its tangent up to order 10" in out
    assert "The point returns on the same path." in out
    assert "extreme" not in out


def test_json_and_csv(capsys, tmp_path):
    path = tmp_path / "path.csv"
    status, out = run(capsys, "four-bar:25,70,40,70", "coupler:45,40", "--json", "-o", str(path), "--direction", "30")
    found = json.loads(out)
    assert status == 0
    assert found["closed"]
    assert list(found["turning_points"]) == ["30"]
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["R(frame-crank) [°]", "x [mm]", "y [mm]", "s [mm]"]
    points = [complex(float(row[1]), float(row[2])) for row in rows]
    assert points[0] == pytest.approx(points[-1])
    assert float(rows[-1][3]) == pytest.approx(found["length"], rel=1e-3)
    assert math.isclose(found["length"], 145.03082809, rel_tol=1e-8)


@pytest.mark.parametrize(
    ("point", "message"),
    [
        ("coupler:45", "expected a point LINK:X,Y"),
        ("coupler:45,inf", "finite coordinates"),
        ("copler:45,1", "did you mean 'coupler'"),
        ("frame:45,1", "lies on the frame"),
        ("K", "there is no point 'K'"),
    ],
)
def test_refusals(capsys, point, message):
    status, error = run(capsys, "four-bar:25,70,40,70", point)
    assert status == 2
    assert message in error
    assert run(capsys, "four-bar:25,70,40,70", "coupler:1,2", "--tolerance", "0")[0] == 2


def test_a_far_point_and_a_far_drive_value(capsys):
    assert run(capsys, "four-bar:25,70,40,70", "coupler:1e10,40")[0] == 0
    status, out = run(capsys, "four-bar:25,70,40,70", "coupler:45,40", "--contact", "401")
    assert status == 0
    assert out.splitlines()[1].split(":")[1] == " y = 0.09972 x^2."
    status, said = run(capsys, "four-bar:40,70,25,70", "coupler:45,40", "--contact", "179")
    assert (status, "not to 179°" in said) == (2, True)
    status, said = run(capsys, "four-bar:25,70,40,70", "coupler:45,40", "--tolerance", "1e9")
    assert (status, "tolerance must lie between" in said) == (2, True)


def test_a_path_of_several_drives(capsys, tmp_path):
    path = tmp_path / "path.csv"
    arguments = ("pent", "R(3-4)", "--range=0:90:5", "--range=0:180:10")
    status, out = run(capsys, *arguments)
    assert run(capsys, *arguments, "-o", str(path))[0] == status == 0
    assert "The path goes from 0° / 0° to 90° / 180°: length 264 mm" in out
    with path.open(encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert header == ["R(1-2) [°]", "R(1-5) [°]", "x [mm]", "y [mm]", "s [mm]"]
    table = np.array(rows, float)
    assert table[-1, :2].tolist() == [90, 180]
    motion = move(entry("pent").linkage(), np.radians(table[:, :2]))  # the polygon, row by row
    assert motion.point("R(3-4)") == pytest.approx(table[:, 2:4], abs=1e-9)
    fine = move(entry("pent").linkage(), np.radians(np.linspace([0, 0], [90, 180], 20_001))).point("R(3-4)")
    assert np.hypot(*np.diff(fine, axis=0).T).sum() == pytest.approx(264.028273, abs=1e-4)
    _, out = run(capsys, *arguments, "--json", "--direction", "0")
    turns = json.loads(out)["turning_points"]["0"]
    assert [turn["drive"][1] for turn in turns] == pytest.approx([2 * turn["drive"][0] for turn in turns])
    assert [turn["at"][0] for turn in turns] == pytest.approx([fine[:, 0].min(), fine[:, 0].max()], abs=1e-5)


def test_a_drive_is_held_and_one_drive_goes_a_part(capsys):
    _, out = run(capsys, "pent", "R(2-3)", "--range=0:90:5", "--range=40")
    crank = entry("pent").linkage().length("2", "R(1-2)", "R(2-3)")
    assert f"length {crank * math.pi / 2:.4g} mm" in out
    _, out = run(capsys, "four-bar:25,70,40,70", "R(crank-coupler)", "--range=30:90:5")
    assert f"from 30° to 90°: length {25 * math.pi / 3:.4g}." in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "the linkage has 2 drives: give --range FROM:TO:STEP once for each"),
        (
            ["--range=0:90:5"],
            "expected --range once for each drive, in the order R(1-2), R(1-5), but it was given once",
        ),
        (["--range=0:90:5", "--range=0:90:10"], "10 rows where another drive has 19"),
        (["--range=10", "--range=20"], "has no length"),
        (["--range=0:90:5", "--range=0:90:5", "--contact=3"], "leave --range out"),
    ],
)
def test_refused_paths(capsys, arguments, words):
    status, out = run(capsys, "pent", "R(3-4)", *arguments)
    assert status == 2
    assert words in out


def test_lengths_and_points_are_written_as_everywhere(capsys):
    long = run(capsys, "four-bar:25,70,40,70", "coupler:45,40")
    assert run(capsys, "25,70,40,70", "45,40") == long
    assert run(capsys, "25,70,40,70", "coupler:45,40", "--branch=+") == long
    assert run(capsys, "25,70,40,70", "45,40", "--branch=-")[1] != long[1]


def test_files_of_what_is_printed(capsys, tmp_path):
    text, data = tmp_path / "path.txt", tmp_path / "path.json"
    words = ["curve", "25,70,40,70", "45,40"]
    assert main([*words]) == 0
    printed = capsys.readouterr().out
    assert main([*words, "-o", str(text)]) == main([*words, "-o", str(data)]) == 0
    assert text.read_text(encoding="utf-8") == printed
    assert json.loads(data.read_text(encoding="utf-8"))["closed"]
    assert main([*words, "-o", str(tmp_path / "path.pdf")]) == 2
    assert main([*words, "--cognates", "-o", str(tmp_path / "path.csv")]) == 2
    assert not (tmp_path / "path.csv").exists()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["lambda"], "expected a linkage and a point"),
        (["lambda", "C", "--kappa", "20"], "--kappa goes with --guidance"),
        (["lambda", "C", "--straight", "--contact", "3"], "--contact goes with the path of a point"),
        (["lambda", "C", "--cognates", "--direction", "3"], "--direction goes with the path of a point or --straight"),
        (["--guidance", "lambda", "watt"], "--guidance takes one name and no linkage, but found 'watt'"),
        (["lambda", "C", "--straight", "--cognates"], "not allowed with argument"),
    ],
)
def test_options_go_with_their_question(capsys, words, sentence):
    status, said = run(capsys, *words)
    assert status == 2
    assert sentence in said
