"""The command synthesise, as a user calls it."""

import json

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.formats import read_linkage
from gruebler.kinematics import move
from gruebler.synthesis import task_from_json
from gruebler.synthesis.positions import guiding_dyads

FIVE = """x,y,angle
1.167361074190,1.604268422500,49.038042711511
1.240884121745,1.952758097643,39.307123821808
1.092655156025,2.180848534870,32.046511404316
0.781012337917,2.260537620459,27.552467844777
0.397905079691,2.177638768380,25.443007501302
"""


@pytest.fixture
def five(tmp_path):
    path = tmp_path / "five.csv"
    path.write_text(FIVE, encoding="utf-8")
    return path


def test_positions_give_a_linkage_that_the_other_commands_take(five, tmp_path, capsys):
    best, page = tmp_path / "best.toml", tmp_path / "designs.html"
    assert main(["synthesise", "positions", str(five), "-o", str(best), "--draw", str(page)]) == 0
    out = capsys.readouterr().out
    assert "Solutions: 4 by theorem (dyads), 4 found, 2 real." in out
    assert "Designs: 1 accepted, 0 rejected." in out
    assert read_linkage(best).length("coupler", 1, 2) == pytest.approx(3, rel=1e-8)
    assert "<svg" in page.read_text(encoding="utf-8")
    assert main(["analyse", str(best)]) == 0


def test_json_has_counts_verdicts_and_linkages(five, capsys):
    assert main(["synthesise", "positions", str(five), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["count"] == {"what": "dyads", "theorem": 4, "found": 4, "real": 2}
    design = document["designs"][0]
    assert design["accepted"]
    assert design["turns_fully"]
    assert design["drives"] == pytest.approx([10, 35, 60, 85, 110], abs=1e-6)
    assert design["linkage"]["frame"] == "frame"


FOUR = "0,0,0\n2.1,0.9,20\n3.2,1.0,46\n4.0,0.2,86\n"


def test_pivots_of_four_positions_are_picked_and_designs_sorted(tmp_path, capsys):
    task = tmp_path / "four.csv"  # without a header
    task.write_text(FOUR, encoding="utf-8")
    words = ["synthesise", "positions", str(task), "--json"]
    assert main([*words, "--number", "5", "--sort", "size"]) == 0
    designs = json.loads(capsys.readouterr().out)["designs"]
    assert [d["size"] for d in designs] == sorted(d["size"] for d in designs)
    for design in designs:
        assert design["transmission_over_range"] <= design["transmission_through_targets"] + 1e-6
    main([*words, "--curve-parameter", "0.21", "--curve-parameter", "0.4"])
    by_parameter = json.loads(capsys.readouterr().out)
    assert by_parameter["task"]["curve_parameters"] == [0.21, 0.4]
    assert by_parameter["count"]["found"] == 2
    (design,) = [*by_parameter["designs"], *by_parameter["rejected"]]
    one, two = guiding_dyads(task_from_json(by_parameter["task"]))
    places = [f"{v:.12f}" for v in (one.moving.real, one.moving.imag, two.fixed.real, two.fixed.imag)]
    main([*words, "--moving-pivot", *places[:2], "--fixed-pivot", *places[2:]])
    by_pivot = json.loads(capsys.readouterr().out)
    (again,) = [*by_pivot["designs"], *by_pivot["rejected"]]
    assert again["size"] == pytest.approx(design["size"], rel=1e-9)
    assert again["size_ratio"] == pytest.approx(design["size_ratio"], rel=1e-9)


def test_an_unknown_order_is_refused_with_those_there_are(five, capsys):
    assert main(["synthesise", "positions", str(five), "--sort", "size,beauty"]) == 2
    assert "sorted by error, transmission, range-transmission, size" in capsys.readouterr().err


def test_a_region_without_designs_is_status_1_with_the_reason(five, capsys):
    assert main(["synthesise", "positions", str(five), "--region", "10", "10", "20", "20"]) == 1
    out = capsys.readouterr().out
    assert "None of the designs examined meets the task." in out
    assert "a fixed pivot lies outside the region" in out


def test_an_expression_and_its_minimax_optimum(capsys):
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60", "--minimax"]
    assert main(words) == 0
    assert "Minimax optimum, which -o writes: largest error 0.0036" in capsys.readouterr().out


def test_the_file_holds_the_minimax_optimum(tmp_path, capsys):
    path = tmp_path / "best.toml"
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60", "--minimax"]
    assert main([*words, "-o", str(path)]) == 0
    out = capsys.readouterr().out
    linkage = read_linkage(path)
    length = linkage.length("crank", "R(frame-crank)", "R(crank-coupler)")
    assert f"a = {length:.6g}, b = " in out
    x = np.linspace(1, 2, 201)
    begin = linkage.reference_pose["crank"].angle
    rocker = move(linkage, begin + np.radians(60) * (x - 1)).angle("rocker")
    error = np.degrees(rocker) - 60 * np.log10(x) / np.log10(2)
    assert np.ptp(error) / 2 == pytest.approx(0.0036657, rel=2e-3)  # as printed, from fewer values of x


def test_a_function_file_gives_the_same_optimum(tmp_path, capsys):
    path = tmp_path / "log.toml"
    path.write_text('function = "log10(x)"\ninterval = [1, 2]\ninput_swing = 60\noutput_swing = 60\n', encoding="utf-8")
    assert main(["synthesise", "function", str(path), "--minimax"]) == 0
    assert "Minimax optimum, which -o writes: largest error 0.0036" in capsys.readouterr().out


@pytest.mark.parametrize("options", ["--swing 60 --crank-angle 200", "--stroke 50 --time-ratio 1"])
def test_a_page_of_dead_centres_has_the_construction_and_moving_designs(options, tmp_path):
    page = tmp_path / "page.html"
    assert main(["synthesise", "dead-centres", *options.split(), "--number", "3", "--draw", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert all(f"{step}. " in text for step in range(1, 6))
    assert text.count("<svg") >= 8
    assert "<animateTransform" in text


def test_dead_centres_in_german(capsys):
    assert main(["synthesise", "dead-centres", "--swing", "60", "--crank-angle", "200", "--lang", "de"]) == 0
    assert "unendlich viele" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["dead-centres", "--swing", "60", "--crank-angle", "110"], "between 120 and 300 degrees"),
        (["dead-centres"], "expected one of swing and stroke"),
        (["function", "log10(x", "--interval", "1", "2", "--swings", "60", "60"], "cannot be read"),
        (["function", "log10(x)"], "needs --interval"),
        (["function", "x", "--interval", "2", "1", "--swings", "60", "60"], "begin before its end"),
        (["positions", "nothing.csv"], "nothing.csv: cannot be read"),
        (["positions", "task.txt"], "a task is in a .toml, .json or .csv file"),
    ],
)
def test_wrong_input_is_one_sentence(words, sentence, capsys):
    assert main(["synthesise", *words]) == 2
    error = capsys.readouterr().err
    assert sentence in error
    assert error.count("\n") == 1


def test_a_task_of_another_kind_names_its_command(five, capsys):
    assert main(["synthesise", "path", str(five)]) == 2
    assert "this is a task for 'synthesise positions'" in capsys.readouterr().err
