"""What the commands of synthesis say beside the tables, in both languages, as a user reads it."""

import json
import re

import numpy as np
import pytest

from gruebler.cli import main
from gruebler.files import linkage_from_json
from gruebler.files.tasks import read_task

LINKS = ("crank", 0, 1), ("coupler", 1, 2), ("rocker", 2, 3), ("frame", 0, 3)
ROWS = ("0,0,0", "2.1,0.9,20", "3.2,1,46", "4,0.2,86")


@pytest.fixture
def said(tmp_path, capsys):
    """What a synthesis of positions, so many of the usual ones or those given, prints, or the sentence of its error."""

    def of(positions, words="", lang="en", *, action="positions"):
        rows = ROWS[:positions] if isinstance(positions, int) else positions
        task = tmp_path / "task.csv"
        task.write_text("\n".join(("x,y,angle", *rows)), encoding="utf-8")
        words = words.split() if isinstance(words, str) else words
        main(["synthesise", action, str(task), *words, "--lang", lang])
        printed = capsys.readouterr()
        return printed.out + printed.err

    return of


@pytest.mark.parametrize(
    ("lang", "improved", "pairs"),
    [
        ("en", "The best of these are improved: their pivots are moved", "Linkages of a crank and a dyad PR that meet"),
        (
            "de",
            "Die besten davon werden verbessert: Ihre Gelenkpunkte",
            "Getriebe aus einer Kurbel und einem Zweischlag",
        ),
    ],
)
def test_that_designs_are_improved_is_said_once(said, lang, improved, pairs):
    out = said(4, lang=lang)
    assert out.count(improved) == 1
    assert pairs in out


@pytest.mark.parametrize(
    ("demands", "english", "german"),
    [
        ("", "has a larger transmission angle than the best here.", "als das beste hier."),
        ("--crank --region 0 0 0.01 0.01", "with the given pivot meets all demands.", "alle Forderungen erfüllt."),
    ],
)
def test_a_bound_that_is_not_proved_beside_a_given_pivot_is_not_that_of_a_dyad(said, demands, english, german):
    for lang, begin, end in (
        ("en", "whether a four-bar with", english),
        ("de", "ob ein Viergelenkgetriebe mit", german),
    ):
        (line,) = [line for line in said(2, f"--moving-pivot -8.1 -0.9 {demands}", lang).splitlines() if begin in line]
        assert line.endswith(end)


def test_finitely_many_linkages_are_not_said_to_be_infinitely_many(said):
    # Three positions leave a four-bar 8 - 4 numbers: four lengths leave finitely many. Lengths of a four-bar of ROWS.
    words = "--length crank 3 --length coupler 5 --length rocker 4 --length frame 6"
    for lang, finite, infinite, improved in (
        ("en", "leave finitely many linkages", "infinitely many", "improved"),
        ("de", "nur endlich viele Getriebe", "unendlich viele", "verbessert"),
    ):
        out = said(3, words, lang)
        assert finite in out
        assert infinite not in out
        assert improved not in out
    assert "infinitely many" in said(3, words.replace(" --length frame 6", ""))


def test_a_proof_has_the_best_angle_beside_its_bound(said):
    out = said(3, "--moving-pivot 1 1")
    (line,) = [line for line in out.splitlines() if line.startswith("Proved: no four-bar with the given pivot")]
    bound, best = (float(part.split("°")[0]) for part in (line.split("above ")[1], line.split("best one here has ")[1]))
    listed = [row.split()[4].rstrip("°") for row in out.splitlines() if re.match(r"\d+ RR-RR", row)]
    assert max(map(float, listed)) == best
    assert best < bound <= best + 0.2


def test_a_slider_crank_has_no_length_of_the_frame_and_is_not_sought(said):
    out = said(4, "--length frame 5 --rejected")
    assert [line.split()[0] for line in out.splitlines() if "RR-PR" in line] == ["Linkages"]
    assert (
        "Linkages RR-PR are left out: a link whose length or direction is given has fewer than two pins there." in out
    )
    assert "RR-RR" in out
    slider = ["--structure", "slider-crank", "--initial-designs", "4", "--length", "0", "5"]
    assert "the length of a link '0' is given, but only 1 and 2 have one" in said(3, slider)
    both = said(3, [*slider, "--structure", "four-bar linkage"])
    assert "P(3-0); frame=0; drive=R(0-1) – 0: no length, since this link has fewer than two pins" in both
    assert re.search(r"Designs: [1-9]\d* accepted", both)


@pytest.mark.parametrize(
    "kind", ["dead-centres --stroke 50 --time-ratio 1.2", "function x --interval 0 1 --swings 60 9 --travel"]
)
def test_an_output_that_travels_leaves_the_frame_without_a_length(capsys, kind):
    assert main(["synthesise", *kind.split(), "--length", "frame", "5"]) == 2
    assert "the length of a link 'frame' is given, but only crank and coupler have one" in capsys.readouterr().err


@pytest.mark.parametrize("words", ["", "--minimax", "--starts 45 60"])
def test_angles_alone_take_a_given_length_as_their_scale(capsys, words):
    """The ratios are those without it: angles say nothing of the size."""
    found = []
    for demand in ("", "--length rocker 7"):
        options = f"--interval 1 2 --swings 60 60 {words} {demand} --json"
        assert main(["synthesise", "function", "log10(x)", *options.split()]) == 0
        linkage = linkage_from_json(json.loads(capsys.readouterr().out)["designs"][0]["linkage"])
        found.append(np.array([linkage.length(*link) for link in LINKS]))
    free, scaled = found
    assert free[3] == pytest.approx(1)
    assert scaled == pytest.approx(7 / free[2] * free, rel=1e-9)


def test_a_length_that_is_missed_shows_by_how_much(said):
    """The cranks of two pivots: the radii of the circles through their places in three positions."""
    places = np.array([(0, 0), (2.1, 0.9), (3.2, 1)]) @ [1, 1j]
    turns = np.exp(1j * np.radians([0, 20, 46]))
    radii = []
    for pivot in (1 + 0j, 3 + 1j):
        p, q, r = places + turns * pivot
        twice_area = abs(((q - p) * np.conj(r - p)).imag)
        radii.append(abs(q - p) * abs(r - q) * abs(p - r) / (2 * twice_area))
    near = f"{radii[0]:.6g}", f"{radii[0]:.7g}"
    assert near[0] != near[1]
    out = said(3, f"--moving-pivot 1 0 --moving-pivot 3 1 --length crank {near[0]}")
    assert f"the length of the crank is not {near[0]}, but {near[1]}" in out
    out = said(3, "--moving-pivot 1 0 --moving-pivot 3 1 --length crank 2.5", "de")
    assert f"die Länge des Glieds Kurbel ist nicht 2,5, sondern {near[0].replace('.', ',')}" in out


def beside_a_circle(places):
    """Zero for four places on one circle, of one sign on each side of it."""
    return np.linalg.det([[abs(z) ** 2, z.real, z.imag, 1] for z in places])


def test_the_point_that_is_taken_for_a_given_pivot_is_told_with_its_distance(said):
    """Its four places lie on a circle, and on no circle of points about the given one that is smaller."""
    out = said(4, "--moving-pivot 1 1")
    told = re.search(r"\(1, 1\) is not on the circle-point .* \(([-\d.]+), ([-\d.]+)\), at a distance of ([\d.]+)", out)
    x, y, distance = map(float, told.groups())
    rows = np.array([[float(v) for v in row.split(",")] for row in ROWS])
    places, turns = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * np.radians(rows[:, 2]))
    assert abs(beside_a_circle(places + turns * complex(x, y))) < 1e-3
    assert distance == pytest.approx(abs(complex(x, y) - complex(1, 1)), abs=1e-4)
    nearer = 1 + 1j + 0.98 * distance * np.exp(1j * np.linspace(0, 2 * np.pi, 200))
    assert len({np.sign(beside_a_circle(places + turns * z)) for z in (1 + 1j, *nearer)}) == 1
    assert "Der gegebene Gelenkpunkt (1; 1) liegt nicht auf der Kreispunktkurve" in said(4, "--moving-pivot 1 1", "de")
    assert "centre-point curve" in said(4, "--fixed-pivot 0 -3")
    assert "is not on" not in said(3, "--fixed-pivot 0 -3")


def test_a_pivot_of_the_body_that_turns_outside_the_region_is_named(said):
    """The centre of the circle through the three places of (1, 1), from the mid-perpendiculars."""
    rows = np.array([[float(v) for v in row.split(",")] for row in ROWS[:3]])
    p, q, r = rows[:, 0] + 1j * rows[:, 1] + np.exp(1j * np.radians(rows[:, 2])) * (1 + 1j)
    sides = np.array([[(q - p).real, (q - p).imag], [(r - p).real, (r - p).imag]])
    u, v = np.linalg.solve(sides, np.array([abs(q) ** 2 - abs(p) ** 2, abs(r) ** 2 - abs(p) ** 2]) / 2)
    out = said(3, "--moving-pivot 1 1 --region -1 -1 2 2")
    assert f"With the given pivot (1, 1) a pivot of the frame is at ({u:.6g}, {v:.6g}), outside the region" in out
    assert "outside the region: no" not in said(3, f"--moving-pivot 1 1 --region -1 {v - 1} {u + 1} 2")


def test_german_names_of_demands_and_families(said):
    out = said(3, "--moving-pivot 1 1 --region -1 -1 2 2", "de")
    assert "Entwürfe, die alle Forderungen bis auf diese erfüllen (Bereich der Gestellpunkte): " in out
    assert "Jeder Punkt des Körpers ist Gelenkpunkt eines Zweischlags, ebenso jeder Punkt des Gestells" in out
    assert "im Umkreis der 30-fachen Aufgabengröße" in out
    assert "ein Gestellpunkt liegt außerhalb des Bereichs" in out


HINGE = "2,0,0", "1.7320508075688772,1,30", "0,2,90"


def test_a_hinge_outside_the_region_is_no_answer(said):
    """Three pure turns about the origin: every crank has its pivot there."""
    assert "turns about (0, 0): a link on one pivot there passes them" in said(HINGE)
    assert "turns about (0, 0): a link" in said(HINGE, "--region -1 -1 1 1")
    assert "turns about (0, 0), outside the region: a link" in said(HINGE, "--region 3 3 5 5")
    assert "sind Drehungen um (0; 0), außerhalb des Bereichs" in said(HINGE, "--region 3 3 5 5", "de")


def test_positions_that_are_nearly_those_of_one_joint_are_named(said):
    """(2 cos 30°, 1) with four digits is 5.1e-5 beside it, by 2.83; (3, 6.001) 0.00045 beside a line of 8.94."""
    out = said((HINGE[0], "1.732,1,30", HINGE[2]))
    assert "All positions are turns about (0, 0) to within 1.8e-05 of the size: a link on one pivot" in out
    out = said(("0,0,5", "1,2,5", "3,6.001,5", "4,8,5"))
    assert "keeps its angle on a straight line, inclined by 63.4349°, to within 5e-05 of the size" in out


def test_six_bars_are_tried_where_no_four_bar_has_its_pivots_in_the_region(tmp_path, capsys):
    """One of them carries the body through the turns, each kind from one start."""
    task = tmp_path / "task.toml"
    rows = [[float(v) for v in row.split(",")] for row in HINGE]
    task.write_text(f"positions = {rows}\n[demands]\nregion = [3, 3, 9, 9]\ntransmission = 0\n", encoding="utf-8")
    assert main(["design", str(task), "--initial-designs", "1", "--links", "4"]) == 1
    assert re.search(r"slider-cranks +4 +0  all positions are turns about \(0, 0\), outside", capsys.readouterr().out)


@pytest.mark.parametrize(
    ("positions", "words", "sentence"),
    [
        (4, "--moving-pivot 1 1 --moving-pivot 1 1", "--moving-pivot: the two pivots coincide"),
        (3, "--fixed-pivot 1 1 --fixed-pivot 0 0 --fixed-pivot 1 1", "--fixed-pivot: the two pivots coincide"),
        (4, "--length crank 3 --length crank 4", "--length: the length of 'crank' is given twice"),
        (4, "--length crank -3", "--length: expected a length above 0 for each link, but found crank = -3"),
        (4, "--number 10001", "--number: expected a whole number from 1 to 10,000, but found 10001"),
    ],
)
def test_what_cannot_be_meant_is_refused_in_a_sentence(said, positions, words, sentence):
    assert said(positions, words) == f"gruebler synthesise: {sentence}\n"


def test_pivots_whose_nearest_points_of_the_curve_are_one_are_no_linkage(said):
    assert "Designs: 0 accepted" in said(4, "--moving-pivot 1 1 --moving-pivot 1 1.0000001")


def test_angles_beyond_a_turn_are_degrees_without_a_warning(said):
    """The same positions as with 40 and 80 degrees."""
    rows = "0,0,0", "2.1,0.9,{}", "3,1,{}"
    once, more = (
        said(
            [row.format(*angles) for row, angles in zip(rows, ((), pair[:1], pair[1:]), strict=True)],
            "--fixed-pivot 0 -3",
        )
        for pair in ((40, 80), (400, 800))
    )
    assert "Warning" not in more
    assert [line for line in more.splitlines() if "meet all" in line] == [
        line for line in once.splitlines() if "meet all" in line
    ]


def test_tabs_stand_between_columns_too(tmp_path):
    path = tmp_path / "task.csv"
    path.write_text("x\ty\tangle\n0\t0\t0\n2,5\t1.5\t90\n", encoding="utf-8")
    assert read_task(path).positions[1] == pytest.approx((2.5, 1.5, np.pi / 2))


def test_points_that_are_not_passed_within_the_demands_are_not_counted_as_solutions(tmp_path, capsys):
    path = tmp_path / "task.csv"
    path.write_text("x,y\n0,0\n10,5\n20,6\n30,0\n", encoding="utf-8")
    assert main(["synthesise", "path", str(path), "--transmission", "90", "--number", "1"]) == 1
    assert "led to none that passes the points within the demands" in capsys.readouterr().out
    assert main(["synthesise", "path", str(path), *["--fixed-pivot", "0", "0", "--fixed-pivot", "9", "0"] * 2]) == 2
    assert "--fixed-pivot: expected one or two, but found 4" in capsys.readouterr().err
    path.write_text("x,y,weight\n0,0,0\n10,5,0\n20,6,0\n", encoding="utf-8")
    assert main(["synthesise", "path", str(path)]) == 2
    assert "weights: expected one above 0 at least" in capsys.readouterr().err


def test_lengths_that_no_crank_rocker_has_are_said_so_alone(capsys):
    words = "dead-centres --swing 60 --crank-angle 180 --length crank 3 --length rocker 3"
    assert main(["synthesise", *words.split()]) == 1
    out = capsys.readouterr().out
    assert "No member has the given lengths." in out
    assert "Of 0 members" not in out


def test_a_list_that_begins_with_full_turns_says_so_where_another_has_a_larger_angle(said):
    rows = ("-40,0,12", "0,25,35", "35,10,70")
    sentence = "Designs whose drive turns fully come first"

    def angles(printed):
        found = re.findall(r"R\(frame-\w+\) +(yes|no) +([\d.]+)°", printed)
        return [turns for turns, _ in found], [float(angle) for _, angle in found]

    usual = said(rows, "--length coupler 60")
    turns, mu = angles(usual)
    assert turns == sorted(turns, reverse=True)
    assert mu[0] < max(mu)
    assert sentence in usual
    largest = said(rows, "--length coupler 60 --sort transmission")
    assert angles(largest)[1][0] == max(angles(largest)[1])
    assert sentence not in largest
