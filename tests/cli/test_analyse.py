"""`gruebler analyse` as a user meets it: words, files, entries; measures, tables, refusals."""

import csv
import json
import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.files.linkages import write_linkage
from gruebler.files.screws import screws_to_json
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import move
from gruebler.teaching.catalog import entries, entry
from tests.commands import run_main

CRANK_ROCKER = "four-bar:25,70,40,70"


def run(capsys, *arguments):
    return run_main(capsys, "analyse", *arguments)


def table(capsys, *arguments):
    """Columns by header, from the JSON answer."""
    status, out, err = run(capsys, *arguments, "--json")
    assert (status, err) == (0, "")
    document = json.loads(out)
    columns = {
        f"{c['name']} {c['unit']}".strip(): [row[k] for row in document["rows"]]
        for k, c in enumerate(document["columns"])
    }
    return document, columns


def test_a_four_bar_in_words(capsys):
    status, out, err = run(capsys, CRANK_ROCKER, "--speed", "95.5")
    assert (status, err) == (0, "")
    assert "Roles:" not in out  # they have the names of their roles
    assert "time ratio 1.12." in out
    assert "Other assembly modes there: -." in out
    assert "These are 2 of at most 2 assembly modes, complex ones included." in out
    rows = [line for line in out.splitlines() if line.split() and line.split()[0].isdigit()]
    assert [int(row.split()[0]) for row in rows] == list(range(0, 361, 15))


@pytest.mark.parametrize(
    ("machine", "possible", "most"), [("pumpjack", 6, 6), ("jansen", 8, 8), ("slidercrank", None, 2)]
)
def test_real_modes_and_possible_ones(capsys, machine, possible, most):
    """A triad has six modes (Hunt 1983), three dyads have 2^3; with a slide the number is not known."""
    document, _ = table(capsys, machine)
    assert document["possible_modes"] == possible
    assert 1 <= len(document["other_branches"]) + 1 <= most


def test_lengths_without_a_unit_get_none(capsys):
    status, out, _ = run(capsys, "slider-crank:20,50,5", "--speed", "60", "--point", "coupler:10,5")
    assert status == 0
    assert "mm" not in out
    assert "stroke of 40.24." in out  # sqrt(70² - 5²) - sqrt(30² - 5²)
    assert "slider′ [1/rad]" in out
    assert "a slider [1/s²]" in out


def test_german(capsys):
    status, out, _ = run(capsys, "slidercrank", "--lang", "de", "--at", "55", "--speed", "60")
    assert status == 0
    assert "Funktion der Glieder: Pleuel = Koppel, Gleitstein = Schieber." in out
    assert "Übertragungswinkel [°]" in out


def test_the_velocities_of_the_reference(capsys):
    # REFERENCE C: crank at 55 degrees, 10 radians a second
    _, found = table(
        capsys, CRANK_ROCKER, "--at", "55", "--speed", repr(10 * 30 / math.pi), "--point", "R(coupler-rocker)"
    )
    expected = {
        "R(frame-crank) °": 55,
        "rocker °": 72.42747938634542,
        "ω rocker rad/s": 4.785205278035138,
        "α rocker rad/s²": 45.135747093926994,
        "rocker′": 0.4785205278035138,
        "transmission angle °": 57.819218178233285,
        "R(coupler-rocker) x mm": 82.07650800998915,
        "R(coupler-rocker) vx mm/s": -182.47625729699473,
        "R(coupler-rocker) ay mm/s²": -328.1041382170231,
    }
    assert {key: found[key][0] for key in expected} == pytest.approx(expected, rel=1e-9)
    _, crossed = table(capsys, CRANK_ROCKER, "--at", "55", "--branch=-")
    assert crossed["rocker °"] == pytest.approx([-112.82692058537805])


def test_a_slider_crank_of_the_reference(capsys):
    # exercise 15: a = 35, b = 100, e = 20 below; measures and the way from the outer dead centre
    document, found = table(capsys, "slider-crank:35,100,-20", "--range", "21.480375745856954:111.5:30")
    assert found["slider mm"] == pytest.approx(
        [127.0310869521984, 109.85858439843634, 88.95471958850746, 72.25122900078529][: len(found["slider mm"])]
    )
    measures = document["measures"]
    assert {centre["side"]: centre["output"] for centre in measures["dead_centres"]} == pytest.approx(
        {"inner": 61.84658438426491, "outer": 133.51029922818688}
    )


def test_files_entries_and_csv(capsys, tmp_path):
    path, out = tmp_path / "mine.toml", tmp_path / "table.csv"
    write_linkage(path, FourBar(25, 70, 40, 70).linkage({"K": (35, 10)}, unit="in"))
    status, said, _ = run(capsys, str(path), "--point", "K", "--range", "0:90:45", "-o", str(out))
    assert status == 0
    assert "Assembly mode" in said
    assert "K x" not in said  # the table is in the file
    header, *rows = list(csv.reader(out.read_text(encoding="utf-8").splitlines()))
    assert header[:2] == ["R(frame-crank) [°]", "rocker [°]"]
    assert "K vx [in/rad]" in header
    assert [row[0] for row in rows] == ["0.0", "45.0", "90.0"]
    _, found = table(capsys, "conchoid", "--point", "C", "--at", "60")
    assert (found["C x mm"][0], found["C y mm"][0]) == pytest.approx((87.265956, -27.662798))


def test_a_range_of_the_drive(capsys):
    document, found = table(capsys, "four-bar:40,25,40,60")
    assert max(found["R(frame-crank) °"]) < 78.2802397
    assert document["complete"]
    status, out, _ = run(capsys, "four-bar:40,25,40,60", "--range", "0:90:15")
    assert status == 1
    assert "The motion ends at R(frame-crank) = 78.28°" in out
    _, found = table(capsys, "loader", "--output", "bucket")
    assert found["P(cylinder-piston) cm"][0] == 60
    assert "bucket′ rad/cm" in found


def test_what_cannot_be_assembled(capsys):
    status, out, err = run(capsys, "four-bar:10,20,30,100")
    assert (status, err) == (1, "")
    assert "cannot be assembled" in out


FIVE_BAR = {
    "unit": "mm",
    "joints": "R(0-1) R(1-2) R(2-3) R(3-4) R(0-4)",
    "drives": ["R(0-1)", "R(0-4)"],
    "places": {"R(0-1)": [0, 0], "R(1-2)": [-10, 40], "R(2-3)": [30, 80], "R(3-4)": [70, 40], "R(0-4)": [60, 0]},
}


def five_bar(tmp_path, **other):
    path = tmp_path / "five.json"
    path.write_text(json.dumps(FIVE_BAR | other), encoding="utf-8")
    return str(path)


def test_two_drives_give_poses(capsys, tmp_path):
    path = five_bar(tmp_path)
    document, found = table(capsys, path, "--range", "90:120:10", "--range", "80", "--point", "R(2-3)")
    assert found["R(0-4) °"] == pytest.approx([80] * 4)
    assert len(found["R(2-3) x mm"]) == 4
    assert "measures" not in document
    status, _, err = run(capsys, path)
    assert status == 2
    assert "the linkage has 2 drives: give --range FROM:TO:STEP for each, in the order R(0-1), R(0-4), or --at" in err


def test_too_few_and_too_many_drives(capsys, tmp_path):
    for drives, words in (
        ([], "no joint is driven"),
        (["R(0-1)"], "Mobility 2, drives: 1"),
        (["R(0-1)", "R(1-2)", "R(0-4)"], "Mobility 2, drives 3"),
    ):
        status, _, err = run(capsys, five_bar(tmp_path, drives=drives))
        assert status == 2
        assert words in err
        assert err.count("\n") == 1


REFUSED = [
    (["four-bar:0,1,2,3"], "a must be positive, not 0"),
    (["four-bar:nan,1,2,3"], "a must be a finite number"),
    (["four-bar:1,2"], "four-bar: expected a,b,c,d, but found 2 numbers"),
    (["four-bar:a,b,c,d"], "four-bar: expected numbers a,b,c,d"),
    (["fourbar:1,2,3,4"], "did you mean 'four-bar'?"),
    (["crankroker"], "did you mean crankrocker"),
    (
        ["tri"],
        "the screws of its joints in one position, not the dimensions of its links: `gruebler check tri",
    ),
    (["R(0-1) R(1-2) R(2-0)"], "has no dimensions, which `gruebler realise` finds; give a file"),
    (["none.toml"], "none.toml: cannot be read"),
    ([__file__], "a linkage is in a .toml or .json file"),
    ([CRANK_ROCKER, "--output", "rokcer"], "did you mean 'rocker'?"),
    ([CRANK_ROCKER, "--point", "K"], "there is no point 'K'"),
    ([CRANK_ROCKER, "--branch", "++"], "a branch of this linkage is + or - for RRR {coupler, rocker}; found '++'"),
    ([CRANK_ROCKER, "--range", "0:360"], "expected FROM:TO:STEP such as 0:360:15, but found '0:360'"),
    ([CRANK_ROCKER, "--range", "0:360:0"], "a step other than 0"),
    ([CRANK_ROCKER, "--range", "0:nan:1"], "expected finite numbers"),
    ([CRANK_ROCKER, "--range", "0:10:-1"], "no angles lead from 0 to 10 by steps of -1"),
    ([CRANK_ROCKER, "--range", "0:1e8:0.001"], "more than 1,000,000 rows"),
    ([CRANK_ROCKER, "--speed", "0"], "--speed: expected a number that is not 0"),
    ([CRANK_ROCKER, "--speed", "nan"], "--speed: expected a number that is not 0"),
    ([CRANK_ROCKER, "--at", "inf"], "--at: expected one finite number below 1e9"),
    ([CRANK_ROCKER, "--at", "1,2"], "--at: expected one finite number below 1e9"),
    ([CRANK_ROCKER, "--at", "1", "--range", "0:9:1"], "--range and --at do not go together"),
    ([CRANK_ROCKER, "--at", "1", "-o", "/nonexistent/x.csv"], "/nonexistent/x.csv cannot be written"),
]


@pytest.mark.parametrize(("arguments", "words"), REFUSED, ids=[" ".join(a)[:40] for a, _ in REFUSED])
def test_refusals(capsys, arguments, words):
    status, out, err = run(capsys, *arguments)
    assert (status, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1


def test_who_turns_fully_is_told(capsys):
    _, out, _ = run(capsys, "lambda", "--lang", "de")
    assert "D(Kurbel-Koppel) volle Umläufe, D(Koppel-Schwinge) 50,67°" in out
    document, _ = table(capsys, "lambda")
    assert [row["full"] for row in document["rotatability"]] == [True, True, False, False]


def test_a_linkage_with_one_position_says_so_in_both_languages(capsys):
    assert run(capsys, "four-bar:10,20,30,60")[:2] == (
        1,
        "The drive cannot move: the linkage can be assembled in one position only, drive = 0°.\n",
    )
    assert run(capsys, "four-bar:10,20,30,60", "--lang", "de")[1].startswith("Der Antrieb ist unbeweglich: ")


@pytest.mark.parametrize(
    ("machine", "zeros"),
    [
        ("elliptic_gears", (0, 180, 360)),  # the ratio is largest or smallest
        ("cam_rocker", (0, 45, 90, 105, 120, 135, 150, 210, 270, 285, 300, 315, 330, 345, 360)),  # dwells, middles
        ("cam_rocker_flat", (0, 45, 90, 105, 120, 135, 150, 210, 270, 285, 300, 315, 330, 345, 360)),
    ],
)
def test_rounding_noise_of_cams_and_non_circular_wheels_is_shown_as_zero(capsys, machine, zeros):
    assert main(["analyse", machine, "--range", "0:360:15"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines() if re.match(r" *\d+ ", line)]
    assert len(rows) == 25
    assert [int(row[0]) for row in rows if row[3] == "0"] == list(zeros)
    assert all(float(row[3]) == 0 or abs(float(row[3])) > 1e-3 for row in rows)


def test_rounding_noise_is_shown_as_zero(capsys):
    _, out, _ = run(capsys, "four-bar:1,1,1,1")
    rows = [line.split() for line in out.splitlines() if line.split() and line.split()[0].isdigit()]
    assert {row[3] for row in rows} == {"0"}


def test_a_link_that_keeps_its_direction_has_no_rate(capsys):
    """The head of the desk lamp, 2° beside the pose in which the lower arm and its rod lie on one line."""
    speeds = ["--speed", "10", "--speed", "0", "--jerk", "0", "--jerk", "0"]
    assert main(["analyse", "lamp", "--at", "18.26,106.3", *speeds]) == 0
    assert capsys.readouterr().out.splitlines()[1].split()[-3:] == ["0", "0", "0"]


def test_slow_drives_have_rates(capsys):
    """1e-5 rpm: the acceleration is the square of the speed, about 1e-12 rad/s², times a number of about 1."""
    rates = []
    for speed in ("0.00001", "1"):
        assert main(["analyse", "pent", "--at", "90,60", "--speed", speed, "--speed", "0"]) == 0
        rates.append([float(value) for value in capsys.readouterr().out.splitlines()[1].split()[-2:]])
    assert rates[0] == pytest.approx([rates[1][0] * 1e-5, rates[1][1] * 1e-10])


def test_several_drives_with_speeds(capsys, tmp_path):
    """A parallelogram with a kink: equal cranks at one speed shift the kink without turning its links."""
    from gruebler.mechanics.linkages import Linkage
    from gruebler.structure.mechanism import Mechanism

    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)")
    write_linkage(
        tmp_path / "five.toml", Linkage.from_drawing(mechanism, {0: (0, 0), 1: (0, 2), 2: (2, 4), 3: (4, 2), 4: (4, 0)})
    )
    five = [str(tmp_path / "five.toml"), "--at", "90,90", "--output", "2", "--point", "R(2-3)"]
    _, found = table(capsys, *five, "--speed", "60", "--speed", "60")
    assert found["ω 2 rad/s"][0] == pytest.approx(0, abs=1e-9)
    assert found["R(2-3) vx mm/s"][0] == pytest.approx(-2 * 2 * math.pi)
    status, _, err = run(capsys, *five, "--speed", "60")
    assert status == 2
    assert "expected --speed once for each drive, 2 times, but found it once" in err


def test_acceleration_and_jerk_of_one_drive(capsys):
    phi, w, a, j = math.radians(30), 2 * math.pi, 3.0, 7.0
    arguments = ("--speed", "60", "--acceleration", "3", "--jerk", "7", "--at", "30")
    _, columns = table(capsys, "slider-crank:20,50", *arguments, "--point", "R(crank-coupler)")
    judge = SliderCrank(20, 50).motion([phi], omega=w, alpha=a, jerk=j, branch="+").output
    for header, wanted in {
        "v slider mm/s": judge.velocity,
        "a slider mm/s²": judge.acceleration,
        "j slider mm/s³": judge.jerk,
    }.items():
        assert columns[header] == pytest.approx(wanted.tolist(), rel=1e-12)
    pin = 20 * complex(math.cos(phi), math.sin(phi))
    rates = {"v": 1j * w, "a": 1j * a - w**2, "j": 1j * (j - w**3) - 3 * w * a}  # of a turning arm
    for letter, order in (("v", ""), ("a", "²"), ("j", "³")):
        for axis, wanted in (("x", (pin * rates[letter]).real), ("y", (pin * rates[letter]).imag)):
            assert columns[f"R(crank-coupler) {letter}{axis} mm/s{order}"] == pytest.approx([wanted], rel=1e-12)
    _, columns = table(capsys, "slider-crank:20,50", "--speed", "0", "--acceleration", "3", "--at", "30")
    still = SliderCrank(20, 50).motion([phi], omega=0.0, alpha=a, jerk=0.0, branch="+").output
    assert columns["a slider mm/s²"] == pytest.approx(still.acceleration.tolist(), rel=1e-12)
    assert "j slider mm/s³" not in columns


def test_acceleration_and_jerk_of_several_drives(capsys):
    speeds = ("--speed", "10", "--speed", "20", "--acceleration", "1", "--acceleration", "2", "--jerk", "3")
    _, columns = table(capsys, "pent", *speeds, "--jerk", "4", "--at", "10,20", "--output", "2")
    linkage = entry("pent").linkage()
    rates = {"acceleration": [1, 2], "jerk": [3, 4]}
    motion = move(linkage, np.radians([[10, 20]]), speed=np.array([10, 20]) * math.pi / 30, order=3, **rates)
    for order, header in enumerate(("ω 2 rad/s", "α 2 rad/s²", "j 2 rad/s³"), 1):
        assert columns[header] == pytest.approx(motion.angular("2", order=order).tolist(), rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--acceleration", "3"], "--acceleration needs --speed"),
        (
            ["--speed", "1", "--jerk", "3", "--jerk", "4"],
            "expected --jerk once for each --speed, once, but found it 2 times",
        ),
        (["--speed", "1", "--jerk", "nan"], "--jerk: expected a finite number"),
    ],
)
def test_refused_accelerations(capsys, arguments, words):
    status, _, err = run(capsys, CRANK_ROCKER, *arguments)
    assert status == 2
    assert words in err


def test_a_file_of_screws_is_told_from_one_of_sizes(capsys, tmp_path):
    path = tmp_path / "winch.json"
    path.write_text(json.dumps(screws_to_json(entries()["winch_screw"].placed())), encoding="utf-8")
    status, out, _ = run(capsys, str(path), "--range", "0:90:45")
    assert status == 0
    assert "that is 12 mm" in out
    assert main(["statics", str(path), "--moment", "nut=1"]) == 2
    said = capsys.readouterr().err
    assert (
        f"has the screws of its joints in one position, not the dimensions of its links: `gruebler check {path}" in said
    )
    assert main(["check", str(path)]) == main(["check", str(path), "--explain"]) == 0


def test_the_unit_of_an_angle_is_in_its_key(capsys):
    """A crank-slider: angles of the joints in degrees by keys that say so, the way of the slide in its unit."""
    document = json.loads(run(capsys, "slider-crank:25,70", "--json")[1])
    rows = {row["joint"]: row for row in document["rotatability"]}
    assert rows["R(frame-crank)"]["range_deg"] == pytest.approx(360, abs=1e-9)
    swing = 2 * math.degrees(math.asin(25 / 70))
    rod = rows["R(coupler-slider)"]
    assert rod["range_deg"] == pytest.approx(swing, abs=1e-7)
    assert rod["highest_deg"] - rod["lowest_deg"] == pytest.approx(swing, abs=1e-7)
    slide = rows["P(frame-slider)"]
    assert (slide["range"], slide["unit"]) == (pytest.approx(50, abs=1e-9), "mm")
    assert not any(key.endswith("_deg") for key in slide)


def test_a_table_with_decimal_commas_and_german_headers(tmp_path, capsys):
    path = tmp_path / "t.csv"
    words = ["analyse", CRANK_ROCKER, "--range", "0:90:30", "--lang", "de"]
    assert main([*words, "-o", str(path), "--decimal-comma"]) == 0
    head, first, *_ = path.read_text(encoding="utf-8-sig").splitlines()
    assert head.split(";")[:2] == ["D(Gestell-Kurbel) [°]", "Schwinge [°]"]
    assert [cell.count(",") for cell in first.split(";")] == [1] * len(head.split(";"))
    assert main([*words, "--decimal-comma"]) == 2
    assert "--decimal-comma" in capsys.readouterr().err


@pytest.mark.parametrize(("machine", "says"), [("slider-crank:20,50", "fixed"), ("kurbelschleife", "turns")])
def test_the_direction_of_a_slide(capsys, machine, says):
    out = run(capsys, machine)[1]
    assert ("is fixed." if says == "fixed" else "turns.") in next(
        line for line in out.splitlines() if line.startswith("The direction of the slide")
    )


def test_planes_are_printed_and_drawn(tmp_path, capsys):
    words = ["analyse", CRANK_ROCKER, "--planes"]
    assert main(words) == 0
    assert "Planes of the links, from below: 1: frame; 2: crank, rocker; 3: coupler." in capsys.readouterr().out
    assert main([*words, "--json", "--lang", "de"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["planes"]["Koppel" if "Koppel" in document["planes"] else "coupler"] == 3
    assert main(["analyse", "scissor2", "--planes"]) == 0
    assert "cannot lie in planes" in capsys.readouterr().out
    assert main(["analyse", "scissor2", "--planes", "--range", "20:40:5"]) == 0
    assert "Planes of the links" in capsys.readouterr().out
    assert main(["analyse", "pent", "--planes"]) == 2
    assert main(["draw", CRANK_ROCKER, "--show", "planes", "-o", str(tmp_path / "x.svg")]) == 0
    drawn = ElementTree.fromstring((tmp_path / "x.svg").read_text(encoding="utf-8"))
    texts = [element.text for element in drawn.iter() if element.tag.endswith("text")]
    assert sorted(texts) == ["1", "2", "2", "3"]
