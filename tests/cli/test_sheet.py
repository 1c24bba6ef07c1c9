"""`gruebler sheet` and `gruebler curve --guidance` as a user meets them."""

import json
import re

import pytest

from tests.commands import run_command


def run(capsys, *arguments):
    return run_command(capsys, *arguments)


def test_list(capsys):
    status, out, _ = run(capsys, "sheet", "list", "--lang", "de")
    assert status == 0
    assert "Kurbelschwinge als Ersatzgetriebe eines Meyer-zur-Capellen-Lenkers" in out
    assert [one["id"] for one in json.loads(run(capsys, "sheet", "list", "--json")[1])] == ["lambda", "mzc"]


def test_show(capsys):
    status, out, _ = run(capsys, "sheet", "show", "mzc")
    assert status == 0
    assert "Drive joints: 1, 1 of them at the frame" in out
    rows = [line.split() for line in out.splitlines() if line.startswith(("κ", "l₄*", "h"))]
    assert rows[0][-4:] == ["15.793169°", "15.79", "as", "printed"]
    assert "0.468890" in rows[1]
    assert rows[2][3:6] == ["40/9·√3", "7.698004", "40/3·√3"]
    assert "φ_G = 163.3248°, from φ_A = 98.3376° to φ_E = 261.6624°, L/l₁ = 3.907352" in out
    german = run(capsys, "sheet", "show", "mzc", "--lang", "de")[1]
    assert "davon 4 Drehgelenke (D)" in german
    assert "κ = 15,79°" in german.replace("\u00a0", " ")


def test_show_as_json(capsys):
    status, out, _ = run(capsys, "sheet", "show", "mzc", "--json")
    found = json.loads(out)
    assert status == 0
    assert found["features"]["links_by_joints"] == {"2": 4}
    assert found["dimensions"][1]["exact"] == "5/2*sqrt(3)"
    assert [row["symbol"] for row in found["quantities"] if not row["as_printed"]] == ["l₄*"]
    assert len(found["diagram"]["phi_G_deg"]) == len(found["diagram"]["ratio"]) == len(found["diagram"]["length"])


@pytest.mark.parametrize("wanted", [("--ratio", "0.005"), ("--band", "0.75mm"), ("--band", "0.075")])
def test_size(capsys, wanted):
    """L = 15 cm: l1 = 3.8389 cm."""
    status, out, _ = run(capsys, "sheet", "size", "mzc", "--length", "15cm", *wanted)
    assert status == 0
    assert "l₁ = 3.8389 cm\nl₂ = 5/2·√3·l₁ = 16.6230 cm" in out
    found = json.loads(run(capsys, "sheet", "size", "mzc", "--length", "15cm", *wanted, "--json")[1])
    assert abs(found["lengths"]["l₁"] - 3.838916653) < 1e-8
    assert found["unit"] == "cm"


@pytest.mark.parametrize("suffix", ["html", "pdf"])
def test_draw(capsys, tmp_path, suffix):
    path = tmp_path / f"sheet.{suffix}"
    assert run(capsys, "sheet", "draw", "mzc", "-o", str(path), "--lang", "de")[0] == 0
    assert path.stat().st_size > 10_000


def test_draw_to_standard_output(capsys):
    status, out, _ = run(capsys, "sheet", "draw", "lambda")
    assert status == 0
    assert out.startswith("<svg")


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (("sheet", "show", "mzk"), 2, "did you mean 'mzc'"),
        (("sheet", "draw", "mzc", "-o", "x.gif"), 2, ".svg, .html, .pdf, .png"),
        (("sheet", "draw", "mzc", "-o", "x.md"), 2, "a page of its own"),
        (("sheet", "draw", "mzc", "-o", "/nowhere/x.svg"), 2, "cannot be written"),
        (("sheet", "size", "mzc", "--length", "15 parsec", "--ratio", "0.1"), 2, "a positive length such as 15cm"),
        (("sheet", "size", "mzc", "--length", "0", "--ratio", "0.1"), 2, "a positive length"),
        (("sheet", "size", "mzc", "--length", "1..2", "--ratio", "0.1"), 2, "a positive length"),
        (("sheet", "size", "mzc", "--length", "1", "--ratio", "nan"), 2, "between 0 and 1"),
        (("sheet", "size", "mzc", "--length", "1", "--band", "1mm"), 2, "the other has no unit"),
        (("sheet", "size", "mzc", "--length", "1", "--ratio", "1e-30"), 1, "1e-30 or less"),
        (("curve", "--guidance", "wat"), 2, "did you mean 'watt'"),
        (("curve", "--guidance", "watt", "--length", "5"), 2, "both --length and --band"),
        (("curve", "--guidance", "--lambda", "1.5"), 2, "between 0.5 and 1.5"),
        (("curve", "--guidance", "--lambda", "0.7", "--kappa", "20"), 2, "one of --lambda and --kappa"),
        (("curve", "--guidance", "--phi0", "50"), 2, "--phi0 goes with --lambda"),
        (("curve", "--guidance", "--kappa", "20", "--phi0", "50"), 2, "leave --phi0 out"),
        (("curve", "--guidance", "--kappa", "95"), 2, "from 0 to 88.78 degrees"),
        (("curve", "--guidance", "--kappa", "89.9999999"), 2, "from 0 to 88.78 degrees"),
        (("curve", "--guidance", "--lambda", "0.5000000000000001"), 2, "no finite length"),
        (("curve", "--guidance", "--diameter", "3"), 2, "goes with --lambda or --kappa"),
        (("curve", "--guidance", "watt", "--kappa", "20"), 2, "leave out the name"),
        (("curve", "--guidance", "--lambda", "0.7", "--diameter", "-1"), 2, "D must be positive"),
        (("curve", "--guidance", "--length", "5", "--band", "1"), 2, "give its name"),
        (("curve", "--guidance", "watt", "--length", "5", "--band", "1e-40"), 1, "or less"),
    ],
)
def test_what_is_wrong(capsys, arguments, status, words):
    found, out, err = run(capsys, *arguments)
    assert found == status
    assert words in out + err


def test_guidance_table(capsys):
    status, out, _ = run(capsys, "curve", "--guidance", "--lang", "de")
    rows = {line.split()[0]: line for line in out.splitlines()}
    assert status == 0
    assert "exakt" in rows["peaucellier"]
    assert "6-punktig" in rows["meyer-zur-capellen"]
    found = json.loads(run(capsys, "curve", "--guidance", "--json")[1])
    assert {one["name"] for one in found if one["exact"]} == {"scott-russell", "peaucellier", "hart"}


def test_construction(capsys):
    """Lambda = 3/4: 1 : 2 sqrt 6 : 2 sqrt 6 : 5, k = 9; kappa = 20 degrees has two solutions."""
    status, out, _ = run(capsys, "curve", "--guidance", "--lambda", "0.75", "--lang", "de")
    assert status == 0
    row = next(line for line in out.splitlines() if line.startswith("Ersatzgetriebe")).split()
    assert row[1:] == [
        "1",
        "4,899",
        "4,899",
        "5",
        "9",
        "4,899",
        "23,28°",
        "Kurbelschwinge",
    ]
    both = json.loads(run(capsys, "curve", "--guidance", "--kappa", "20", "--json")[1])
    assert [round(one["lambda"], 9) for one in both] == [0.786803233, 1.186241638]
    assert [round(one["rocker"]["kappa_deg"], 6) for one in both] == [20, -20]
    assert "4 points" in run(capsys, "curve", "--guidance", "--lambda", "0.8", "--phi0", "50", "--diameter", "10")[1]


def test_guidance_sized(capsys):
    status, out, _ = run(capsys, "curve", "--guidance", "lambda", "--length", "15cm", "--band", "0.75mm")
    assert status == 0
    assert "Lengths: frame = 7.5, crank = 3.75, coupler = 9.375, rocker = 9.375 cm." in out
    found = json.loads(run(capsys, "curve", "--guidance", "hart", "--length", "1", "--band", "0.1", "--json")[1])
    assert found["contact"] is None
    assert abs(found["sized"]["factor"] - 1 / found["length"]) < 1e-12


def test_in_german_numbers_links_and_sources_are_german(capsys):
    out = run(capsys, "curve", "--guidance", "lambda", "--length", "15cm", "--band", "0.75mm", "--lang", "de")[1]
    assert "Längen: Gestell = 7,5; Kurbel = 3,75; Koppel = 9,375; Schwinge = 9,375 cm." in out
    assert "in den Verhältnissen 4 lang" in out
    hart = run(capsys, "curve", "--guidance", "hart", "--length", "1", "--band", "0.1", "--lang", "de")[1]
    assert "Lang1 D(Gestell-Lang1)-D(Lang1-Kurz2)" in hart
    for text in (out, hart, run(capsys, "curve", "--guidance", "--kappa", "45", "--lang", "de")[1]):
        assert not re.search(r"\d\.\d|frame|crank|lambda =", text)
    for arguments in (("show", "lambda"), ("list",)):
        assert "000/003, Abschnitt 3.5.4 und Aufgabe 20" in run(capsys, "sheet", *arguments, "--lang", "de")[1]


def test_an_angle_of_45_degrees_has_one_linkage(capsys):
    status, out, err = run(capsys, "curve", "--guidance", "--kappa", "45")
    assert (status, err) == (0, "")
    assert out.count("6 points") == 1
