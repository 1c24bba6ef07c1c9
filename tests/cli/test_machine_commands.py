"""`gruebler gears`, `gruebler cam` and `gruebler geneva` as a user meets them."""

import json
import math
import re

import pytest

from tests.commands import run_main as run

PLANETARY = "sun:24 planet:18 ring:-60 on arm"
LIFT = "rise 20 60 3-4-5; dwell 30; fall 20 90 cycloidal; dwell"


def test_gears_in_words(capsys):
    text = f"{PLANETARY} planets=3; hold ring; drive sun=7; load arm=-70"
    status, out, err = run(capsys, "gears", text)
    assert (status, err) == (0, "")
    assert "Speeds: 2 sun - 7 arm + 5 ring = 0" in out
    rows = {line.split()[0]: line.split()[1:] for line in out.splitlines() if line}
    assert rows["arm"] == ["2", "2/7", "(0.285714)", "-70", "-14.6608"]  # -70 N m at 2/min: P = T n / 9.549
    assert "torque in N m, force in N  power in W" in out
    _, german, _ = run(capsys, "gears", text, "--lang", "de")
    assert "Laufgrad 2" in german
    assert "Moment in N m, Kraft in N  Leistung in W" in german
    assert "Drehzahl in 1/min" in german


def test_gears_of_a_machine_of_the_catalog(capsys):
    """Willis with a sun of 30 and a ring gear of 60: sun + 2 ring_gear = 3 carrier, as the entry's wheels have it."""
    status, out, _ = run(capsys, "gears", "diff; sun=90; ring_gear=30")
    assert status == 0
    assert "Speeds: sun - 3 carrier + 2 ring_gear = 0" in out
    assert re.search(r"^carrier +50$", out, re.MULTILINE)
    assert run(capsys, "gears", "cam")[0] == 2
    assert "Speeds: sun1 - 2 carrier + sun2 = 0" in run(capsys, "gears", "diff_bevel")[1]  # Willis, equal suns


def test_gears_from_files_and_as_json(capsys, tmp_path):
    lines = tmp_path / "train.txt"
    lines.write_text(f"{PLANETARY}  # a planetary stage\nhold ring\nsun=7\nload arm=-70\n", encoding="utf-8")
    table = tmp_path / "train.toml"
    table.write_text(f'train = "{PLANETARY}"\nhold = ["ring"]\ndrive.sun = 7\nload.arm = -70\n', encoding="utf-8")
    one, other = (json.loads(run(capsys, "gears", str(path), "--json")[1]) for path in (lines, table))
    assert one == other
    assert {link["link"]: link["speed"]["exact"] for link in one["links"]}["planet"] == "-14/3"
    assert one["powers_w"] == pytest.approx(
        {"ring": 0, "sun": 20 * 7 * 0.1047198, "arm": -70 * 2 * 0.1047198}, rel=1e-6
    )
    assert one["units"] == {"speed": "1/min", "torque": "N m", "force": "N", "length": "m", "power": "W"}
    assert one["mobility"] == 2


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"{PLANETARY}; sun=1", "Not determined: planet, arm, ring; 1 more"),
        ("a:10 b:20; a=1; b=1", "b cannot have 1: it follows from the other drives as -1/2"),
        (f"{PLANETARY} planets=5", "cannot be put in"),
    ],
)
def test_gears_status_1(capsys, text, words):
    status, out, err = run(capsys, "gears", text)
    assert (status, err) == (1, "")
    assert words in out


def test_geneva(capsys):
    status, out, _ = run(capsys, "geneva", "4", "--json", "--distance", "100", "--speed", "60", "--step", "15")
    found = json.loads(out)
    assert status == 0
    assert found["greatest_ratio"] == pytest.approx(2.4142135623730945)
    assert found["greatest_acceleration_at_deg"] == pytest.approx(11.4637449, abs=1e-6)
    assert found["crank"] == pytest.approx(100 / math.sqrt(2))
    assert found["dwell_s"] == pytest.approx(0.75)
    assert (found["moving_deg"], found["motion_ratio"]) == pytest.approx((90, 1 / 3))
    assert found["step_s"] == pytest.approx(0.25)
    assert len(found["motion"]) == 25
    assert found["motion"][-1]["wheel_deg"] == pytest.approx(-90)
    _, out, _ = run(capsys, "geneva", "6", "--internal", "--lang", "de", "--step", "90")
    assert "Rastanteil einer Umdrehung" in out
    rows = [" ".join(line.split()) for line in out.splitlines()]
    assert "Treiberwinkel in Bewegung je Umdrehung 240°" in rows
    assert "Bewegungszeit / Rastzeit 2" in rows
    assert out.splitlines()[-1].split()[:3] == ["360°", "60°", "0,3333"]
    for words, middle in (([], 100 - 50), (["--internal"], 100 + 50)):  # where pin and both axes are in line
        _, out, _ = run(capsys, "geneva", "6", *words, "--distance", "100")
        assert re.search(rf"^distance of the pin from the wheel's axis in the middle of a step +{middle}$", out, re.M)
    _, out, _ = run(capsys, "geneva", "4", "--pins", "4", "--json")  # one pin enters as another leaves
    assert json.loads(out)["motion_ratio"] is None
    assert "inf" not in run(capsys, "geneva", "4", "--pins", "4")[1]


def test_cam(capsys):
    status, out, _ = run(
        capsys, "cam", LIFT, "--base", "60", "--roller", "10", "--offset", "5", "--step", "30", "--json"
    )
    found = json.loads(out)
    assert status == 0
    assert found["undercut"] is False
    assert len(found["table"]) == 12
    assert found["table"][1]["lift"] == pytest.approx(10)
    assert found["table"][1]["velocity"] == pytest.approx(1.875 * 20 / math.radians(60))
    status, out, _ = run(capsys, "cam", LIFT, "--base", "40", "--flat", "--lang", "de")
    assert status == 1
    assert "Unterschnitt" in out
    lift = "rise 15 60 parabolic; fall 15 60; dwell"
    status, out, _ = run(capsys, "cam", lift, "--base", "40", "--knife", "--swing", "80", "100")
    assert status == 0
    assert "At 30° the acceleration jumps" in out
    assert "+15°" in out


def test_cam_laws(capsys):
    _, out, _ = run(capsys, "cam", "--laws", "--json")
    found = {one["law"]: one for one in json.loads(out)}
    assert found["modified-trapezoid"]["acceleration"] == pytest.approx(4.8881, abs=5e-5)
    assert "linear" in found


def test_cam_of_a_contour(capsys, tmp_path):
    path = tmp_path / "points.txt"
    rows = [f"{10 + 30 * math.cos(k / 20 * math.pi)} {30 * math.sin(k / 20 * math.pi)}" for k in range(40)]
    path.write_text("\n".join(["# x y", *rows]), encoding="utf-8")
    status, out, _ = run(capsys, "cam", "--contour", str(path), "--flat", "--step", "90", "--json")
    assert status == 0
    assert [row["follower"] for row in json.loads(out)["motion"]] == pytest.approx([30, 40, 30, 20], abs=1e-3)
    path.write_text("1 2\n3\n", encoding="utf-8")
    status, _, err = run(capsys, "cam", "--contour", str(path), "--flat")
    assert status == 2
    assert "line 2: expected two numbers" in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["gears", "a:0 b:1"], "positive size"),
        (["gears", "nowhere.toml"], "cannot be read"),
        (["gears"], "required"),
        (["cam"], "expected one of"),
        (["cam", LIFT, "--laws"], "expected one of"),
        (["cam", LIFT, "--roller", "5"], "needs --base"),
        (["cam", LIFT, "--base", "40"], "expected one follower"),
        (["cam", LIFT, "--base", "40", "--knife", "--flat"], "expected one follower"),
        (["cam", LIFT, "--base", "-1", "--knife"], "positive radius"),
        (["cam", LIFT, "--base", "40", "--knife", "--step", "0"], "--step"),
        (["cam", LIFT, "--base", "40", "--knife", "--step", "nan"], "--step"),
        (["cam", LIFT, "--base", "40", "--flat", "--offset", "3"], "has no effect"),
        (["cam", LIFT, "--base", "40", "--flat", "--swing", "30", "90"], "no arm"),
        (["cam", "--contour", "nowhere.txt", "--flat"], "cannot be read"),
        (["geneva", "2"], "from 3 to 2,000"),
        (["geneva", "four"], "expected a whole number"),
        (["geneva", "4", "--pins", "9"], "at most 4 pins"),
        (["geneva", "4", "--distance", "-1"], "positive length"),
        (["geneva", "4", "--speed", "0"], "--speed"),
        (["geneva", "4", "--step", "1e-9"], "--step"),
    ],
)
def test_wrong_usage_is_one_sentence_and_status_2(capsys, arguments, words):
    status, out, err = run(capsys, *arguments)
    assert (status, out) == (2, "")
    assert words in err
    assert len(err.strip().splitlines()) == 1


# --- pictures --------------------------------------------------------------------------------------

MACHINES = {
    "cam": ["cam", LIFT, "--base", "60", "--roller", "10"],
    "geneva": ["geneva", "4"],
    "gears": ["gears", f"{PLANETARY} planets=3; hold ring; drive sun=7"],
}


@pytest.mark.parametrize("name", MACHINES)
def test_pictures_besides_the_table(capsys, tmp_path, name):
    _, table, _ = run(capsys, *MACHINES[name])
    for kind in ("svg", "html"):
        path = tmp_path / f"x.{kind}"
        moving = ["--animate", "--seconds", "2"] if kind == "html" else []
        status, out, err = run(capsys, *MACHINES[name], "-o", str(path), *moving, "--lang", "en")
        assert (status, out, err) == (0, table, f"Written: {path}\n")
        text = path.read_text(encoding="utf-8")
        assert text.startswith("<svg" if kind == "svg" else "<!doctype html>")
        assert ("<animateTransform" in text) == (kind == "html")


def test_options_of_pictures(capsys, tmp_path):
    path = tmp_path / "x.svg"
    run(capsys, *MACHINES["cam"], "-o", str(path), "--plot", "--at", "30", "--lang", "de")
    assert "Bei 30° ist der Hub 10, der Druckwinkel" in path.read_text(encoding="utf-8")
    run(capsys, *MACHINES["geneva"], "-o", str(path), "--at", "180", "--plot")
    assert "The wheel is locked." in path.read_text(encoding="utf-8")
    run(capsys, *MACHINES["gears"], "-o", str(path))
    plain = path.stat().st_size
    run(capsys, *MACHINES["gears"], "-o", str(path), "--teeth")
    assert path.stat().st_size > 2 * plain


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([*MACHINES["geneva"], "--animate"], "-o FILE"),
        ([*MACHINES["geneva"], "--at", "3"], "-o FILE"),
        ([*MACHINES["geneva"], "--seconds", "0"], "-o FILE"),
        ([*MACHINES["gears"], "--teeth"], "-o FILE"),
        (["cam", "--laws", "-o", "x.svg"], "a cam given by its lift"),
        ([*MACHINES["cam"], "-o", "x.html"], "end it with"),
        ([*MACHINES["cam"], "-o", "x.pdf", "--animate"], "end it with"),
        ([*MACHINES["cam"], "-o", "x.svg", "--seconds", "3"], "goes with --animate"),
        ([*MACHINES["cam"], "-o", "x.svg", "--animate", "--at", "3"], "all positions"),
        ([*MACHINES["cam"], "-o", "x.svg", "--at", "inf"], "finite number"),
        ([*MACHINES["cam"], "-o", "x.svg", "--animate", "--seconds", "-1"], "number of seconds"),
        (["gears", "a:10 b:20; c:10 d:20; a=1", "-o", "x.svg", "--animate"], "do not determine"),
        (["gears", "a:10 b:20", "-o", "no/such/folder/x.svg"], "cannot be written"),
    ],
)
def test_pictures_that_cannot_be(capsys, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    status, out, err = run(capsys, *arguments)
    assert (status, out) == (2, "")
    assert words in err
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_written_of_a_train_that_is_refused(capsys, tmp_path):
    train = "sun:-40 planet:18 ring:-45.001 on arm planets=3; hold ring; sun=1"
    status, out, err = run(capsys, "gears", train, "-o", str(tmp_path / "out.svg"))
    assert (status, out) == (2, "")
    assert err.startswith("gruebler gears: the conditions of assembly need whole tooth numbers")
    assert list(tmp_path.iterdir()) == []
