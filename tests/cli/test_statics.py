"""`gruebler statics` as a user meets it."""

import csv
import json

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.mechanics.forces import statics
from gruebler.mechanics.kinematics import move
from gruebler.teaching.catalog import entry
from tests.commands import run_command


def run(capsys, *arguments):
    return run_command(capsys, "statics", *arguments)


def document(capsys, *arguments):
    status, out, _ = run(capsys, *arguments, "--json")
    found = json.loads(out)
    return status, found, {c["name"]: [row[k] for row in found["rows"]] for k, c in enumerate(found["columns"])}


def test_a_press_over_a_turn(capsys):
    status, out, _ = run(capsys, "slider-crank:20,50", "--load", "R(coupler-slider)=-100,0", "--friction", "0.1")
    assert status == 0
    assert "Largest effort, without friction: torque R(frame-crank) = -2149 N·length at 75°." in out
    assert "Largest effort: torque R(frame-crank) with friction = 2243 N·length at 285°." in out
    # 1/(0.1 tan(alpha)), sin(alpha) = 0.4, as the slider goes forth against its load
    assert "Least safety against self-locking: 22.91 at 270°, by P(frame-slider)." in out
    row = next(line.split() for line in out.splitlines() if line.strip()[:2] == "90")
    slope = 0.4 / 0.84**0.5
    rod = 100 / (0.84**0.5 * (1 + 0.1 * slope))  # the slider goes back, with its load
    numbers = [
        90,
        -2000,
        -20 * rod * 0.84**0.5,
        1 / (1 + 0.1 * slope),
        rod,
        rod,
        rod,
        rod * 0.4 * 1.01**0.5,
        rod * 0.04,
    ]
    assert row.pop(4) == "∞"
    assert [float(cell) for cell in row] == pytest.approx(numbers, rel=5e-4)


def test_self_locking(capsys):
    """As in tests/mechanics/forces/test_friction.py: with a coefficient of 1 it locks from 238 to 302 degrees."""
    arguments = (
        "slider-crank:30,50,10",
        "--load",
        "R(coupler-slider)=-100,0",
        "--friction",
        "1",
        "--range",
        "236:240:1",
    )
    status, out, _ = run(capsys, *arguments)
    assert status == 1
    assert "At the drive values 238°, 239°, 240° the linkage is self-locking, it jams" in out
    assert "mainly because of P(frame-slider)" in out
    rows = [line.split() for line in out.splitlines() if line.strip()[:2] in ("23", "24")]
    assert [row[2] == "–" for row in rows] == [False, False, True, True, True]
    status, found, columns = document(capsys, *arguments)
    assert found["locked"] == [2, 3, 4]
    torques = columns["torque R(frame-crank) with friction"]
    assert [torque is None for torque in torques] == [False, False, True, True, True]
    status, out, _ = run(capsys, *arguments, "--lang", "de")
    assert "ist das Getriebe selbsthemmend, es klemmt" in out
    assert "Sicherheit gegen Selbsthemmung" in out


def test_pins_and_guides(capsys):
    """Sizes for all joints and for one; what rubs has a column."""
    arguments = ("slider-crank:20,50", "--load", "R(coupler-slider)=-100,0", "--friction", "0.1", "--at", "300")
    _, _, plain = document(capsys, *arguments)
    pins = ("--pin-radius", "5", "--pin-radius", "R(frame-crank)=8")
    _, _, columns = document(capsys, *arguments, *pins, "--guide-length", "40", "--guide-height=12")
    force = columns["force of R(frame-crank) on crank"][0]
    assert columns["friction moment R(frame-crank)"] == [pytest.approx(0.1 * 8 * force)]
    assert columns["moment of R(frame-crank) on crank"] == [pytest.approx(-0.1 * 8 * force)]
    assert columns["friction moment R(crank-coupler)"] == [pytest.approx(0.1 * 5 * force)]
    assert columns["torque R(frame-crank) with friction"] > plain["torque R(frame-crank) with friction"]
    assert columns["torque R(frame-crank)"] == plain["torque R(frame-crank)"]
    only = document(capsys, *arguments[:3], "--friction", "R(frame-crank)=0.1", *pins, *arguments[5:])[2]
    assert "friction P(frame-slider)" not in only
    back = document(capsys, *arguments, "--backward")[2]["torque R(frame-crank) with friction"]
    assert back[0] < plain["torque R(frame-crank)"][0] < plain["torque R(frame-crank) with friction"][0]
    bush = document(capsys, *arguments, "--guide-length", "40", "--guide-on", "P(frame-slider)=frame")[2]
    # the pin lies 56.9 mm from the bush's middle, on the crank's axis: both edges bear, 2 * 56.9/40 times the force
    assert bush["friction P(frame-slider)"][0] > 2 * plain["friction P(frame-slider)"][0]
    sleeve = document(capsys, *arguments, "--guide-length=40", "--guide-height=12", "--sleeve", "P(frame-slider)")
    assert sleeve[0] == 0


def test_all_forces_of_one_pose(capsys):
    status, out, _ = run(capsys, "four-bar:25,70,40,70", "--moment", "rocker=-1000", "--at", "55", "--lang", "de")
    assert status == 0
    rows = [line.rsplit(maxsplit=2) for line in out.splitlines() if line.endswith(("N", "N·Länge"))]
    assert ["Antriebsmoment D(Gestell-Kurbel)", "478,5", "N·Länge"] in rows
    assert ["Kraft von D(Gestell-Kurbel) auf Kurbel y", "-7,45", "N"] in rows


def test_json_and_csv(capsys, tmp_path):
    path = tmp_path / "forces.csv"
    arguments = ("four-bar:25,70,40,70", "--mass", "R(coupler-rocker)=2", "--range", "0:90:45")
    status, found, columns = document(capsys, *arguments)
    assert status == 0
    assert found["complete"]
    assert found["disagreement"] < 1e-12
    assert columns["force of R(coupler-rocker) on rocker x"] == pytest.approx(
        [-x for x in columns["force of R(coupler-rocker) on coupler x"]]
    )
    assert run(capsys, *arguments, "-o", str(path))[:2] == (0, "")
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header[1] == "torque R(frame-crank) [N·length]"
    assert len(rows) == 3
    light = document(capsys, *arguments, "--gravity", "0,-4.903325")[2]
    assert columns["torque R(frame-crank)"] == pytest.approx([2 * t for t in light["torque R(frame-crank)"]])


def test_a_cylinder_has_a_force(capsys):
    """Scissor table: the cylinder's force by the weight's rise for its stroke, F = -W dy/ds."""
    load = ("hubpodium_blocks", "--load", "R(arm2-platform)=0,-100")
    _, _, forces = document(capsys, *load, "--range", "40:60:20")
    main(["analyse", "hubpodium_blocks", "--range", "40:60:20", "--point", "R(arm2-platform)", "--json"])
    found = json.loads(capsys.readouterr().out)
    k = next(k for k, c in enumerate(found["columns"]) if c["name"] == "R(arm2-platform) vy")
    assert forces["force P(cylinder-piston)"] == pytest.approx([100 * row[k] for row in found["rows"]])
    status, out, _ = run(capsys, *load)
    assert status == 0
    assert "Largest effort, without friction: force P(cylinder-piston) = " in out


def test_the_loads_of_a_file_act(capsys, tmp_path):
    """At 90 degrees the slider moves by -30 mm per radian: 100 N against it ask for 3000 N mm; weights by hand."""
    path = tmp_path / "press.toml"
    path.write_text(
        'unit = "mm"\nslider_crank = { a = 30, b = 50 }\n[loads]\ngravity = ["-10 m/s2", "0 m/s2"]\n'
        '[loads.forces]\n"R(coupler-slider)" = ["-100 N", "0 N"]\n',
        encoding="utf-8",
    )
    for options, torque in (
        ((), -3000),
        (("--load", "R(coupler-slider)=-200,0"), -6000),
        (("--moment", "crank=500"), -3500),
        (("--mass", "R(coupler-slider)=2"), -3600),
        (("--mass", "R(coupler-slider)=2", "--gravity=-20,0"), -4200),
    ):
        status, _, found = document(capsys, str(path), *options, "--at", "90")
        assert status == 0
        assert found["torque R(frame-crank)"] == pytest.approx([torque])
    # The entry's own: as the library has them from its record.
    linkage, loads, _ = entry("compressor").loaded()
    drives = np.radians([30.0, 200.0])
    own = statics(move(linkage, drives, order=1), loads).work[:, 0]
    _, _, found = document(capsys, "compressor", "--range", "30:200:170")
    assert found["torque R(frame-crank)"] == pytest.approx(own, rel=1e-9)


def test_poses_that_are_not_held(capsys):
    status, out, _ = run(capsys, "loco2", "--moment", "wheel2=5", "--range=-15:15:15")
    assert status == 1
    assert "At the drive values 0° the joint forces are not determined" in out
    assert run(capsys, "four-bar:60,30,30,70", "--moment", "rocker=1", "--at", "170")[0] == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((), "no load is given"),
        (("--load", "K"), "--load: expected POINT=FX,FY, but found 'K'"),
        (("--load", "R(crank-coupler)=1"), "--load: expected two numbers X,Y"),
        (("--moment", "rocker=x"), "--moment: expected a number, but found 'x'"),
        (("--moment", "roker=1"), "did you mean 'rocker'"),
        (("--mass", "R(crank-coupler)=nan"), "--mass: expected a number"),
        (("--mass", "R(crank-coupler)=1", "--gravity", "1"), "--gravity: expected two numbers"),
        (("--moment", "rocker=1", "--friction", "-1", "--at", "0"), "not negative, but found -1"),
        (("--moment", "rocker=1", "--friction", "R(a)=0.1", "--at", "0"), "'R(a)' is not one of the joints"),
        (("--moment", "rocker=1", "--friction", "much"), "--friction: expected a number, but found 'much'"),
        (("--moment", "rocker=1", "--pin-radius", "3"), "--pin-radius needs --friction"),
        (("--moment", "rocker=1", "--backward"), "--backward needs --friction"),
        (
            ("--moment", "rocker=1", "--friction", "1", "--pin-radius", "-3", "--at", "0"),
            "--pin-radius is not negative",
        ),
        (("--moment", "rocker=1", "--friction", "1", "--guide-on", "slider"), "--guide-on: expected JOINT=LINK"),
        (("--moment", "rocker=1", "--friction", "nan"), "--friction: expected a number"),
        (("--moment", "rocker=1", "--at", "nan"), "expected one finite number"),
    ],
)
def test_refusals(capsys, arguments, message):
    status, _, error = run(capsys, "four-bar:25,70,40,70", *arguments)
    assert status == 2
    assert message in error
    assert run(capsys, "slider-crank:2,5", "--moment", "crank=1", "--friction", "-1")[0] == 2


def test_a_change_point_of_a_branch(capsys):
    arguments = ("four-bar:2,5,2,5", "--branch=-", "--moment", "rocker=1", "--at", "0")
    status, out, _ = run(capsys, *arguments)
    assert status == 1
    assert "2.333" in out
    assert "agree" not in out
    _, found, columns = document(capsys, *arguments)
    assert found["disagreement"] is None
    assert columns["torque R(frame-crank)"] == [pytest.approx(7 / 3)]


@pytest.mark.parametrize(
    ("twice", "once"),
    [
        (["--load", "R(coupler-rocker)=3,4", "--load", "R(coupler-rocker)=-1,2"], ["--load", "R(coupler-rocker)=2,6"]),
        (["--moment", "rocker=3", "--moment", "rocker=-8"], ["--moment", "rocker=-5"]),
        (["--mass", "R(crank-coupler)=3", "--mass", "R(crank-coupler)=2"], ["--mass", "R(crank-coupler)=5"]),
    ],
)
def test_loads_at_one_place_add_up(capsys, twice, once):
    given, expected = (document(capsys, "four-bar:25,70,40,70", *loads, "--at", "55")[2] for loads in (twice, once))
    assert given.keys() == expected.keys()
    assert all(given[name] == pytest.approx(expected[name]) for name in given)


def test_points_are_written_as_for_analyse(capsys):
    """A load at LINK:X,Y is that at the joint there, and several at one point add up."""
    at_joint = document(capsys, "slider-crank:25,70", "--load", "R(coupler-slider)=-3,-100", "--range", "0:90:45")[2]
    pieces = ("--load", "coupler:70,0=-3,0", "--load", "coupler:70,0=0,-100", "--mass", "crank:0,0=5")
    at_point = document(capsys, "slider-crank:25,70", *pieces, "--range", "0:90:45")[2]
    name = "torque R(frame-crank)"
    assert at_point[name] == pytest.approx(at_joint[name], abs=1e-9)
    assert run(capsys, "slider-crank:25,70", "--load", "coupler:7=0,1")[2].startswith("expected a point LINK:X,Y")


def test_the_table_is_narrow_and_dust_is_zero(capsys):
    """A load across the guide, at the pin of the slider: the guide holds it."""
    status, out, _ = run(capsys, "slider-crank:25,70", "--load", "slider:0,0=0,-100")
    assert status == 0
    table = out.splitlines()
    assert max(map(len, table)) < 120
    rows = [cells for line in table if (cells := line.split()) and cells[0].isdigit()]
    assert len(rows) == 25
    assert all(row[1:] == ["0", "0", "0", "0", "100"] for row in rows)
