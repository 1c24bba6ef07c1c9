"""The command synthesise, as a user calls it."""

import json
import re
import tomllib
from dataclasses import astuple, replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import gruebler as gr
from gruebler.cli import main
from gruebler.cli.design_tables import _lengths, print_designs
from gruebler.design.synthesis import DeadCentreTask, synthesise
from gruebler.design.synthesis.dyad_families import guiding_dyads
from gruebler.files import linkage_from_json, read_linkage
from gruebler.files.tasks import task_from_json
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.mechanism import Mechanism
from tests.design.synthesis.searches import made_once

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
    assert "fixed pivots" in out
    assert "  (0, 0) (3.5, 0)\n" in out  # not 1e-11
    assert read_linkage(best).length("coupler", 1, 2) == pytest.approx(3, rel=1e-8)
    assert "<svg" in page.read_text(encoding="utf-8")
    assert main(["analyse", str(best)]) == 0


def test_six_bars_carry_a_body_through_five_positions(tmp_path, capsys):
    task, best = tmp_path / "task.csv", tmp_path / "best.json"
    rows = ("0.5,0.25,0", "-0.18,1.22,34.4", "-0.87,1.43,44.7", "-1.48,1.26,53.3", "-1.86,0.85,64.7")
    task.write_text("\n".join(("x,y,angle", *rows)), encoding="utf-8")
    pivots = "--fixed-pivot -1.5 0 --fixed-pivot 0 0 --moving-pivot -0.46 -0.77"
    words = ["synthesise", "positions", str(task), "--six-bars", *pivots.split(), "--size-ratio", "99", "-o", str(best)]
    assert main(words) == 0
    assert "5 general positions with these pivots: 108 complex solutions" in capsys.readouterr().out
    assert read_linkage(best).length("frame", 0, 3) == pytest.approx(1.5)


def test_any_order_is_said_instead_of_that_of_the_file(five, capsys):
    rows = FIVE.splitlines()
    ranks = ["order", 5, 1, 2, 3, 4]
    five.write_text("\n".join(f"{row},{rank}" for row, rank in zip(rows, ranks, strict=True)), encoding="utf-8")
    assert main(["synthesise", "positions", str(five), "--any-order"]) == 0
    out = capsys.readouterr().out
    assert "The targets may be met in any order." in out
    assert "Order of the targets" not in out


def test_json_has_counts_verdicts_and_linkages(five, capsys):
    assert main(["synthesise", "positions", str(five), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["count"] == {"what": "dyads", "theorem": 4, "found": 4, "infinite": 0, "real": 2}
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
    design, *driven_there = [*by_parameter["designs"], *by_parameter["rejected"]]
    assert all(other["size"] == pytest.approx(design["size"], rel=1e-9) for other in driven_there)
    one, two = guiding_dyads(task_from_json(by_parameter["task"]))
    places = [f"{v:.12f}" for v in (one.moving.real, one.moving.imag, two.fixed.real, two.fixed.imag)]
    main([*words, "--moving-pivot", *places[:2], "--fixed-pivot", *places[2:]])
    by_pivot = json.loads(capsys.readouterr().out)
    again, *others = [*by_pivot["designs"], *by_pivot["rejected"]]
    assert len(others) == len(driven_there)
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


@pytest.mark.parametrize(
    ("mu", "cell", "words"),
    [
        (40, "40.0°", []),
        (39.9, "39.9° !", ["!: below 40°."]),
        (5, "5.0° !", ["!: below 40°."]),
        (4.9, "4.9° !!", ["!!: below 5°, where friction and play let it jam"]),
    ],
)
def test_angles_are_marked_below_the_rule_of_thumb_and_where_it_jams(mu, cell, words, capsys):
    """Of a whole turn, too: a design for a closed curve may have its least angle anywhere."""
    result = synthesise(DeadCentreTask(swing=1.0, time_ratio=1.2), number=1)
    design = replace(result.designs[0], verdict=replace(result.designs[0].verdict, transmission=np.radians(mu)))
    vars(design)["transmission_over_range"] = np.pi / 3
    print_designs(result, replace(result, designs=(design,)), rejected=False, lang="en")
    out = " ".join(capsys.readouterr().out.split())
    assert f" {cell} 60.0° " in out
    assert [
        mark for mark in ("!: below 40°.", "!!: below 5°, where friction and play let it jam") if mark in out
    ] == words


def test_an_expression_and_its_minimax_optimum(capsys):
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60", "--minimax"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert "Minimax optimum 1: largest error 0.00367° (before: 0.01186°)" in out
    assert "0.00367°" in out.partition("\nMinimax")[0]  # the table, too, has the optimum
    assert "35.9° !" in out
    assert "over the whole range of the drive, as `analyse` gives it. !: below 40°." in out
    assert "error at pairs" not in out
    assert main(words[:-1]) == 0  # five pairs exactly; of the largest error between them the optimum began
    heads, first = capsys.readouterr().out.partition("design  ")[2].splitlines()[:2]
    assert re.search(r"error at pairs  over interval", heads)
    assert re.search(r"< 1e-9 +0\.012° ", first)


def test_the_printed_dimensions_of_an_optimum_have_the_error_that_is_stated(capsys):
    """From the printed text alone: Freudenstein's equation at 20,001 places of the interval."""
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60", "--minimax"]
    assert main(words) == 0
    line = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("Minimax optimum 1"))
    a, b, c, d, phi, psi = (float(text) for text in re.findall(r"(?: = |from )(-?[\d.]+)", line.partition("It is")[0]))
    x = np.linspace(1, 2, 20_001)
    inner, outer = np.radians(phi + 60 * (x - 1)), np.radians(psi + 60 * np.log10(x) / np.log10(2))
    # the coupler from the crank's pin to the circle of the rocker's: the root nearest to the wanted output
    p, q = d - a * np.cos(inner), -a * np.sin(inner)
    s, w = np.hypot(p, q), np.arctan2(q, p)
    bend = np.arccos((b * b - c * c - s * s) / (2 * c * s))
    misses = np.abs(np.angle(np.exp(1j * (np.stack([w + bend, w - bend]) - outer)))).min(axis=0)
    assert np.degrees(misses.max()) == pytest.approx(0.0036697, rel=2e-4)


def test_an_optimum_is_printed_with_what_proves_it(capsys):
    """The least error is the 0.006971 degrees of 1,500 linear programmes; 60 of them stopped at 0.012998."""
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "90", "--minimax"]
    assert main([*words]) == 0
    out = capsys.readouterr().out
    assert "Minimax optimum 1: largest error 0.006971°" in out
    assert "It is taken at 6 places, 6 of them with alternating signs; 5 dimensions are free." in out
    assert main([*words, "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)["designs"][0]["minimax"]
    assert (shown["optimum"], shown["reason"], shown["alternations"], shown["parameters"]) == (True, None, 6, 5)
    assert sum(shown["multipliers"]) == pytest.approx(1)
    assert 0 <= shown["possible_decrease"] < 1e-7 * shown["error"]


def test_what_is_no_optimum_is_not_called_one(capsys):
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "90", "--minimax"]
    assert main([*words, "--points", "4"]) == 0
    out = capsys.readouterr().out
    assert "8.453° *" in out
    assert (
        "* Design 3 is no minimax optimum: it comes to a dead centre. To first order, dimensions within a tenth" in out
    )


def test_a_first_design_that_is_no_optimum_says_so(capsys):
    """One degree of freedom less than a dead centre leaves: the best of the list is no optimum."""
    words = ["synthesise", "function", "x^2", "--interval", "0", "1", "--swings", "60", "60", "--starts", "60", "60"]
    assert main([*words, "--minimax"]) in (0, 1)
    out = capsys.readouterr().out
    assert "Minimax optimum 1" not in out


def test_the_picture_of_a_minimax_optimum_shows_it(tmp_path):
    """The axis of the structural error reaches as far as that of the optimum, not of the design before it."""
    path = tmp_path / "designs.svg"
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60", "--draw", str(path)]
    assert main(words) == 0
    before = path.read_text(encoding="utf-8")
    assert ">−0.010<" in before
    assert main([*words, "--minimax"]) == 0
    after = path.read_text(encoding="utf-8")
    assert ">−0.004<" in after
    assert ">−0.010<" not in after
    assert "targets 37.4°" in before
    assert "targets 35.9°" in after


def test_the_file_holds_the_minimax_optimum(tmp_path, capsys):
    path = tmp_path / "best.toml"
    words = ["synthesise", "function", "log10(x)", "--interval", "1", "2", "--swings", "60", "60", "--minimax"]
    assert main([*words, "-o", str(path)]) == 0
    out = capsys.readouterr().out
    linkage = read_linkage(path)
    length = linkage.length("crank", "R(frame-crank)", "R(crank-coupler)")
    assert f"a = {length:.9g}, b = " in out
    x = np.linspace(1, 2, 201)
    begin = linkage.reference_pose["crank"].angle
    rocker = move(linkage, begin + np.radians(60) * (x - 1)).angle("rocker")
    error = np.degrees(rocker) - 60 * np.log10(x) / np.log10(2)
    assert np.ptp(error) / 2 == pytest.approx(0.0036697, rel=1e-4)  # as printed


def test_a_function_file_gives_the_same_optimum(tmp_path, capsys):
    path = tmp_path / "log.toml"
    path.write_text('function = "log10(x)"\ninterval = [1, 2]\ninput_swing = 60\noutput_swing = 60\n', encoding="utf-8")
    assert main(["synthesise", "function", str(path), "--minimax"]) == 0
    assert "Minimax optimum 1: largest error 0.00367" in capsys.readouterr().out


def test_fixed_starts_have_three_precision_points(capsys):
    words = ["synthesise", "function", "x**2", "--interval", "0", "1", "--swings", "90", "40", "--travel"]
    assert main([*words, "--starts", "0", "50", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["task"]["precision_points"] == 3
    assert main([*words, "--starts", "0", "50", "--points", "5"]) == 2
    assert "at most 3" in capsys.readouterr().err


def test_pairs_of_a_file_with_free_starts(tmp_path, capsys):
    path = tmp_path / "pairs.csv"
    path.write_text("input,output\n0,0\n20,15\n40,38\n", encoding="utf-8")
    assert main(["synthesise", "function", str(path)]) == 1
    capsys.readouterr()
    assert main(["synthesise", "function", str(path), "--free-starts", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert not document["task"]["start_input"]
    assert document["designs"]


FAMILIES = {
    "positions": "x,y,angle\n0,0,0\n2.1,0.9,20\n3.2,1.0,46\n",
    "function": "input,travel\n0,0\n20,15\n",
    "dead-centres": "stroke,time_ratio\n50,1.2\n",
    "path": "x,y\n0,0\n2,1\n",
}


@pytest.mark.parametrize("kind", FAMILIES)
def test_the_number_is_that_of_designs(kind, tmp_path, capsys):
    path = tmp_path / "task.csv"
    path.write_text(FAMILIES[kind], encoding="utf-8")
    words = ["synthesise", kind, str(path), *(["--free-starts"] if kind == "function" else [])]
    assert main([*words, "--number", "2", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["designs"]) == 2


def test_a_page_of_so_many_designs_counts_all(tmp_path, capsys):
    task, page = tmp_path / "four.csv", tmp_path / "page.html"
    task.write_text(FOUR, encoding="utf-8")
    assert main(["synthesise", "positions", str(task), "--number", "2", "--draw", str(page)]) == 0
    accepted = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("Designs: "))
    assert not accepted.startswith("Designs: 2 ")
    text = page.read_text(encoding="utf-8")
    assert accepted in text
    assert "2. RR-RR, " in text
    assert "3. RR-" not in text


def test_the_number_leaves_a_finite_list_whole(tmp_path, capsys):
    path = tmp_path / "five.toml"
    path.write_text("points = [[0, 0], [1, 0.6], [2, 0.8], [3, 0.6], [4, 0.1]]\nfixed_pivots = [[0, -3], [4, -2]]\n")
    assert main(["synthesise", "path", str(path), "--number", "1"]) == 0
    out = capsys.readouterr().out
    assert "36 found, 14 real" in out
    # Both were confirmed by intersecting circles: five points, one side, the crank by 236 and 203 degrees one way.
    assert "Designs: 2 accepted, 12 rejected." in out


def test_lengths_have_their_letters_and_german_names_their_language(capsys):
    words = ["synthesise", "dead-centres", "--stroke", "50", "--time-ratio", "1.2", "--number", "1"]
    assert main(words) == 0
    assert "a = 23.52, b = 63.96, e = -19.93" in capsys.readouterr().out
    assert main([*words, "--lang", "de"]) == 0
    out = capsys.readouterr().out
    assert "D(Gestell-Kurbel)" in out
    assert "a = 23,52; b = 63,96; e = -19,93" in out


def test_offsets_of_several_slides_have_the_names_of_their_joints():
    """Pins at (0, 0) and (4, 1): the second lies 1 to the left of a level way and 4 to the right of an upright one."""
    mechanism = Mechanism.parse("R(frame-crank) P(crank-coupler) R(coupler-slider) P(frame-slider); frame=frame")
    places = {
        "R(frame-crank)": (0, 0),
        "P(crank-coupler)": (4, 2, 0),
        "R(coupler-slider)": (4, 1),
        3: (3, 9, np.pi / 2),
    }
    linkage = Linkage.from_drawing(mechanism, places)
    assert _lengths(linkage, "en") == "e P(crank-coupler) = 1, e P(frame-slider) = -4"
    assert _lengths(linkage, "de") == "e S(Kurbel-Koppel) = 1; e S(Gestell-Schieber) = -4"


def test_the_two_sides_of_a_design_have_the_symbols_of_the_language(five, capsys):
    assert main(["synthesise", "positions", str(five), "--lang", "de"]) == 0
    out = capsys.readouterr().out
    assert "1 DD-DD" in out
    assert "RR-RR" not in out


def test_rejected_designs_are_drawn_if_there_are_no_others(five, tmp_path, capsys):
    page, best = tmp_path / "designs.html", tmp_path / "best.toml"
    words = ["synthesise", "positions", str(five), "--region", "10", "10", "20", "20", "-o", str(best)]
    assert main([*words, "--draw", str(page)]) == 1
    assert "best.toml is not written: no design was accepted" in capsys.readouterr().out
    assert "a fixed pivot lies outside the region" in page.read_text(encoding="utf-8")
    assert not best.exists()


@pytest.mark.parametrize("options", ["--swing 60 --crank-angle 200", "--stroke 50 --time-ratio 1"])
def test_a_page_of_dead_centres_has_the_construction_and_moving_designs(options, tmp_path):
    page = tmp_path / "page.html"
    assert main(["synthesise", "dead-centres", *options.split(), "--number", "3", "--draw", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert all(f"{step}. " in text for step in range(1, 6))
    assert text.count("<svg") >= 8
    assert "<animateTransform" in text


def test_the_best_dead_centres_are_the_same_however_many_are_listed(capsys):
    angles = {}
    for number in (2, 12):
        words = ["synthesise", "dead-centres", "--swing", "60", "--time-ratio", "1.2", "--json"]
        assert main([*words, "--number", str(number)]) == 0
        designs = json.loads(capsys.readouterr().out)["designs"]
        angles[number] = [design["transmission_over_range"] for design in designs]
    assert angles[2] == angles[12][:2]


def test_no_more_rows_are_printed_than_are_asked_for(capsys):
    """Of finitely many, too."""
    law = ["x^2", "--interval", "0", "1", "--swings", "60", "10", "--points", "5", "--travel"]
    assert main(["synthesise", "function", *law, "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["designs"]) > 1
    assert main(["synthesise", "function", *law, "--number", "1"]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert [row.split()[0] for row in rows if row[:1].isdigit()] == ["1"]
    assert any(row.startswith("and ") for row in rows)


def test_dead_centres_in_german(capsys):
    assert main(["synthesise", "dead-centres", "--swing", "60", "--crank-angle", "200", "--lang", "de"]) == 0
    out = capsys.readouterr().out
    assert "unendlich viele" in out
    assert "Kurbelwinkel zwischen den Totlagen ändern" in out


SIX_BARS = ["function", "x", "--interval", "1", "2", "--swings", "5", "60", "--six-bars"]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["dead-centres", "--swing", "60", "--crank-angle", "110"], "more than 120° and less than 300°"),
        (["dead-centres"], "expected exactly one of --swing and --stroke, but found none"),
        (["dead-centres", "--swing", "60", "--crank-angle", "400"], "--crank-angle: expected an angle between 0 and"),
        (["dead-centres", "--stroke", "5", "--time-ratio", "0.5"], "--time-ratio: expected slow to quick"),
        (["function", "x", "--interval", "1", "2", "--swings", "5", "60", "--points", "0"], "expected 2 to 11"),
        ([*SIX_BARS, "--minimax"], "not with --six"),
        ([*SIX_BARS, "--scheduler", "local"], "--jobs, --scheduler: only of eleven pairs"),
        ([*SIX_BARS, "--six-bar-type", "watt ii", "--shape", "1", "30"], "--shape: only with a type of Stephenson's"),
        (["function", "x", "--interval", "1", "2", "--swings", "0", "60"], "--swings: expected a number that is not 0"),
        (
            ["function", "x", "--interval", "1", "2", "--swings", "5", "60", "--points", "12"],
            "--points: expected 2 to 11",
        ),
        (
            ["function", "x", "--interval", "1", "2", "--swings", "5", "6", "--minimax", "--structure", "quad"],
            "--minimax",
        ),
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


@pytest.mark.parametrize(
    ("kind", "content", "options", "sentence"),
    [
        ("function", "input,output\n0,0\n20,15\n", "--points 3 --travel", "--points and --travel: the file"),
        ("dead-centres", "stroke,time_ratio\n50,1.2\n", "--swing 30", "--swing: the file"),
        ("positions", FIVE, "--link coupler", "--link: only with --structure"),
        ("positions", FIVE, "--design 2", "--design: only with -o"),
        ("positions", FIVE, "--design 0 -o x.toml", "--design: expected at least 1"),
        ("positions", FIVE, "--design 2 -o x.toml", "--design: expected 1 to 1, but found 2"),
        ("positions", FIVE, "--jobs 2", "--jobs: only with --structure, or where --six-bars takes --start-solutions\n"),
        ("positions", FIVE, "--scheduler local", "--scheduler: only with --structure, or where --six-bars takes"),
        ("dead-centres", "stroke,time_ratio\n50,1.2\n", "--jobs 2", "--jobs: only with --structure\n"),
        ("positions", FIVE, "--six-bars --link coupler", "--link: only with --structure"),
        ("positions", FIVE, "--structure quad --jobs 0", "at least one process, not 0"),
        ("positions", FIVE, "--number 0", "--number: expected at least 1"),
        ("positions", FIVE, "--start-solutions 9", "--start-solutions: only with --six-bars"),
        ("positions", FIVE, "--six-bars --structure quad", "--structure: not with --six-bars"),
        ("positions", FIVE, "--six-bars", "the task has 5 positions, 0 fixed pivots and 0 moving ones"),
    ],
)
def test_options_that_would_do_nothing_are_refused(kind, content, options, sentence, tmp_path, capsys):
    path = tmp_path / "task.csv"
    path.write_text(content, encoding="utf-8")
    assert main(["synthesise", kind, str(path), *options.split()]) == 2
    assert sentence in capsys.readouterr().err


def test_any_design_of_the_list_is_written(tmp_path, capsys, monkeypatch):
    searches = made_once(monkeypatch, "synthesise_positions")
    task, path = tmp_path / "four.csv", tmp_path / "third.toml"
    task.write_text(FOUR, encoding="utf-8")
    words = ["synthesise", "positions", str(task)]
    assert main([*words, "--json"]) == 0
    third = json.loads(capsys.readouterr().out)["designs"][2]["linkage"]
    assert main([*words, "--design", "3", "-o", str(path)]) == 0
    assert read_linkage(path) == linkage_from_json(third)
    assert len(searches) == 1
    assert main(["analyse", str(path)]) == 0


@pytest.mark.slow
def test_processes_fit_the_same_designs(five, tmp_path, capsys):
    words = ["synthesise", "positions", str(five), "--structure", "quad", "--initial-designs", "2"]
    files = [tmp_path / f"{jobs}.toml" for jobs in (1, 2)]
    for jobs, path in enumerate(files, 1):
        assert main([*words, "--jobs", str(jobs), "-o", str(path)]) == 0
    linkages = [read_linkage(path) for path in files]
    assert linkages[0].mechanism == linkages[1].mechanism
    for key, element in linkages[0].elements.items():
        assert astuple(element) == pytest.approx(astuple(linkages[1].elements[key]), rel=1e-6, abs=1e-9)


def test_a_task_of_another_kind_names_its_command(five, capsys):
    assert main(["synthesise", "path", str(five)]) == 2
    assert "this is a task for 'synthesise positions'" in capsys.readouterr().err


def test_clearance_moves_the_targets_further(five, capsys):
    def worst(clearance):
        assert main(["synthesise", "positions", str(five), "--clearance", clearance]) == 0
        out = capsys.readouterr().out
        assert "99 % of random linkages" in out
        return float(out.split("random linkages")[1].split()[1])

    assert 0 < worst("0") < worst("0.01") < worst("0.02")
    assert main(["synthesise", "positions", str(five), "--clearance", "-1"]) == 2
    assert "--clearance: expected at least 0, but found -1" in capsys.readouterr().err


TURNS = "orientations = [[0, 0, 1, 0], [1, 0.5, 2, 20], [0.4, 0.2, 1, 45], [0, -0.3, 1, 70]]"


def test_orientations_give_a_four_bar_on_the_sphere(tmp_path, capsys):
    """Its coupler takes the orientations, by `move` and by rotations of another library."""
    task, best, picture = tmp_path / "turns.toml", tmp_path / "best.toml", tmp_path / "best.svg"
    task.write_text(TURNS, encoding="utf-8")
    options = ["--crank", "--transmission", "30", "--number", "2"]
    files = ["-o", str(best), "--design", "2", "--draw", str(picture)]
    assert main(["synthesise", "orientations", str(task), *options, *files]) == 0
    out = capsys.readouterr().out
    assert "Designs: 2 accepted, 0 rejected." in out
    assert "°" in picture.read_text(encoding="utf-8")
    assert main(["synthesise", "orientations", str(task), *options, "--json"]) == 0
    design = json.loads(capsys.readouterr().out)["designs"][1]
    assert design["transmission_through_targets"] >= 30
    drives = np.radians(design["drives"])
    steps = np.interp(np.arange(25) / 8, np.arange(4), drives - drives[0])
    turns = gr.move(gr.read(best), steps).pose("coupler")[::8, :3, :3]
    rows = np.array(tomllib.loads(TURNS)["orientations"])
    axes = rows[:, :3] / np.linalg.norm(rows[:, :3], axis=1, keepdims=True)
    wanted = Rotation.from_rotvec(np.radians(rows[:, 3:]) * axes).as_matrix()
    assert turns == pytest.approx(wanted @ wanted[0].T, abs=1e-7)


def test_orientations_without_a_design_say_why(tmp_path, capsys):
    task = tmp_path / "turns.toml"
    task.write_text(TURNS, encoding="utf-8")
    assert main(["--lang", "de", "synthesise", "orientations", str(task), "--transmission", "89.9"]) == 1
    out = capsys.readouterr().out
    assert "Keiner der untersuchten Entwürfe erfüllt die Aufgabe." in out
    assert "der Übertragungswinkel sinkt auf" in out


@pytest.mark.parametrize(
    ("text", "options", "sentence"),
    [
        (
            "orientations = [[0, 0, 0, 5], [1, 0, 0, 9], [0, 1, 0, 9]]",
            [],
            "orientation 1: expected an axis and an angle",
        ),
        ("orientations = [[0, 0, 1], [1, 0, 0, 9], [0, 1, 0, 9]]", [], "orientation 1: expected an axis"),
        ("orientations = [[0, 0, 1, 0], [1, 0, 0, 9]]", [], "expected three to five orientations, but found 2"),
        ("positions = [[0, 0, 1]]", [], "positions"),
        (TURNS, ["--transmission", "91"], "--transmission: expected 0 to 90 degrees"),
        (TURNS, ["--number", "0"], "--number: expected at least 1"),
    ],
)
def test_bad_orientations_are_told_in_a_sentence(tmp_path, capsys, text, options, sentence):
    task = tmp_path / "turns.toml"
    task.write_text(text, encoding="utf-8")
    assert main(["synthesise", "orientations", str(task), *options]) == 2
    error = capsys.readouterr().err
    assert sentence in error
    assert error.count("\n") == 1


@pytest.mark.parametrize("task", ["a file", "an expression"])
def test_pairs_give_a_four_bar_on_the_sphere(tmp_path, capsys, task):
    """Its output link turns as x^2 asks at Chebyshev's points, by `move`."""
    best, pairs = tmp_path / "best.toml", tmp_path / "pairs.csv"
    x = 0.5 - 0.5 * np.cos((2 * np.arange(1, 6) - 1) * np.pi / 10)
    rows = [f"{60 * value!r},{60 * value**2!r}" for value in x.tolist()]
    pairs.write_text("input,output\n" + "\n".join(rows), encoding="utf-8")
    expression = ["x^2", "--interval", "0", "1", "--swings", "60", "60"]
    given = [str(pairs), "--free-starts"] if task == "a file" else expression
    assert main(["synthesise", "spherical-function", *given, "--frame", "90", "-o", str(best)]) == 0
    out = capsys.readouterr().out
    assert "Solutions: 5 by theorem (linkages), 5 found, 1 real." in out
    steps = np.radians(60) * np.interp(np.arange(33) / 8, np.arange(5), x - x[0])
    motion = gr.move(gr.read(best), steps)
    turned = Rotation.from_matrix(motion.pose("rocker")[::8, :3, :3]).magnitude()
    assert turned == pytest.approx(np.radians(60) * (x**2 - x[0] ** 2), abs=1e-7)


@pytest.mark.parametrize(
    ("text", "options", "sentence"),
    [
        ("0,0\n10,5\n20,15\n30,30", ["--free-starts"], "free starts need the arc of the frame"),
        ("0,0\n10,5\n20,15\n30,30", ["--frame", "80"], "expected 3 pairs of angles, but found 4 inputs"),
        ("0,0\n10,5\n20,15\n30,30", ["--starts", "0", "0"], "--starts: the file"),
        ("0,0\n10,5\n20,15", ["--frame", "180"], "frame: expected an angle between 0 and 180 degrees"),
    ],
)
def test_bad_pairs_for_the_sphere_are_told_in_a_sentence(tmp_path, capsys, text, options, sentence):
    task = tmp_path / "pairs.csv"
    task.write_text(f"input,output\n{text}", encoding="utf-8")
    assert main(["synthesise", "spherical-function", str(task), *options]) == 2
    error = capsys.readouterr().err
    assert sentence in error
    assert error.count("\n") == 1


def test_a_travel_is_nothing_on_the_sphere(tmp_path, capsys):
    task = tmp_path / "pairs.csv"
    task.write_text("input,travel\n0,0\n10,5\n20,15\n30,25", encoding="utf-8")
    assert main(["synthesise", "spherical-function", str(task)]) == 2
    assert "coordinate angles, not a travel" in capsys.readouterr().err


def test_an_order_leads_the_search_of_paths_too(tmp_path, capsys):
    """Three positions with crank angles: of random partners of the crank the best has 82 degrees, not 74."""
    task = tmp_path / "timed.toml"
    task.write_text(
        "points = [[3.0350203, 0.2680028], [3.2871601, 0.476936], [4.4401962, 2.1331895]]\n"
        "angles = [0, 2.570899, 17.0984657]\ncrank_angles = [0, 4.5736834, 30.8920742]\n",
        encoding="utf-8",
    )
    options = ["--length", "rocker", "6.2788859", "--sort", "transmission", "--json"]
    assert main(["synthesise", "path", str(task), *options]) == 0
    found = json.loads(capsys.readouterr().out)["designs"]
    best, second = (design["transmission_through_targets"] for design in found[:2])
    assert best > 82
    assert second > 78  # 74 where the order came after the search
