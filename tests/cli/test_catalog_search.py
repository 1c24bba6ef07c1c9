"""`gruebler catalog search` and `catalog show --full` as a user meets them."""

import json
import subprocess
import sys

import pytest

from gruebler.teaching.catalog import entries
from tests.commands import run_command

SHEET = ("--links", "4", "--drives", "1", "--drives-at-frame", "1", "--output-links-at-frame", "0")
SHEET += ("--pairs", "D:4", "--binary", "4")


def run(capsys, *arguments):
    return run_command(capsys, "catalog", *arguments)


def test_features_in_both_languages(capsys):
    status, out, err = run(capsys, "search", *SHEET)
    assert (status, err) == (0, "")
    lines = out.splitlines()
    assert lines[0].split()[:6] == ["id", "name", "n", "F", "finite", "mobility"]
    assert any(line.startswith("mzc ") and " ".join(line.split()).endswith("1 (1) 1 (0) n2=4 R:4") for line in lines)
    _, german, _ = run(capsys, "search", *SHEET, "--lang", "de")
    assert "Antriebe (am Gestell)" in german
    assert "D:4" in german
    _, counted, _ = run(capsys, "search", *SHEET, "--count")
    assert int(counted) == len(lines) - 1


def test_words_and_pairs_as_before(capsys):
    _, out, _ = run(capsys, "search", "compressor", "--links", "6", "--json")
    (found,) = json.loads(out)
    assert found["id"] == "vcomp"
    assert found["features"]["joints_by_pair"] == {"revolute": 5, "prismatic": 2}
    _, out, _ = run(capsys, "search", "Kurbel", "--text", "Nähmaschine", "--joints", "4")
    assert out.splitlines()[1].startswith("sewing")
    _, out, _ = run(capsys, "search", "unicorn")
    assert out == "No entry of the catalog matches.\n"
    _, out, _ = run(capsys, "search", "--pair", "P", "--drive-pair", "P", "--count", "--json")
    assert json.loads(out)["count"] >= 5


def test_where_claim_and_count_differ(capsys):
    _, out, _ = run(capsys, "search", "--claims", "--json")
    found = {one["id"]: one for one in json.loads(out)}
    assert {"loco3", "loco4", "winch_screw", "toolbox2", "diff2p", "scissor_lr"} <= set(found)
    assert found["loco4"]["moves"] == 1
    assert not {"wiper", "quad_strut", "pumpjack_rod"} & set(found)


def test_every_structure(capsys):
    status, out, err = run(capsys, "search", "--enumerate", "--lang", "de", *SHEET)
    assert (status, err) == (0, "")
    assert out.splitlines() == [
        "1  D(0-1) D(1-2) D(2-3) D(3-0); frame=0; drive=D(0-1); Abtrieb 2  (Viergelenkgetriebe)",
        "1 gefunden.",
    ]
    _, out, _ = run(capsys, "search", "--enumerate", "--links", "8", "--count")
    assert out == "71\n"
    _, out, _ = run(capsys, "search", "--enumerate", "--links", "8", "--limit", "71")
    assert out.splitlines()[-1] == "71 found."
    _, out, _ = run(capsys, "search", "--enumerate", "--links", "8", "--limit", "70")
    assert out.splitlines()[-1] == "70 listed; there are more."
    _, out, _ = run(capsys, "search", "--enumerate", "--link-kinds", "4,2", "--json")
    document = json.loads(out)
    assert (document["count"], document["complete"], len(document["items"])) == (5, True, 5)
    _, out, _ = run(capsys, "search", "--enumerate", "--links", "6", "--multiple-joints", "4")
    assert out == "No mechanism has these features.\n"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("--links four", "expected a whole number"),
        ("--pairs D", "expected joints with their numbers"),
        ("--pairs D:1,P:1", "mix two alphabets"),
        ("--pair revolut", "did you mean 'revolute'"),
        ("--link-kinds 4,2 --binary 4", "does not go with"),
        ("--link-kinds 4;2", "expected the numbers of binary"),
        ("--link-kinds 4,2 --links 5", "are 6 links, not 5"),
        ("--links 4 --binary 5", "those are 5"),
        ("--limit 3", "--limit needs --enumerate"),
        ("--enumerate", "the number of links is needed"),
        ("--enumerate --links 6 --limit 0", "expected a number from 1, but found 0"),
        ("--enumerate --links 6 --claims", "does not go with --enumerate"),
        ("--enumerate --links 6 crank", "WORD searches the catalog"),
        ("--enumerate --links 6 --pairs D:5", "the other 2"),
    ],
)
def test_wrong_usage(capsys, arguments, words):
    status, out, err = run(capsys, "search", *arguments.split())
    assert (status, out) == (2, "")
    assert words in err
    assert "Traceback" not in err


def test_show_in_full(capsys):
    status, out, _ = run(capsys, "show", "lambda", "loco3", "--full", "--lang", "de")
    assert status == 0
    for words in (
        "Zählung: F = 3(n - 1)",
        "Der Abtrieb kehrt um bei 90°",
        "Geführte Punkte:",
        "17,9796 hoch",
        "Kuppelstange",
    ):
        assert words in out
    _, out, _ = run(capsys, "show", "vcomp", "--full", "--json")
    (document,) = json.loads(out)
    assert document["measures"]["drive"]["full"]
    _, plain, _ = run(capsys, "show", "exercise-6")
    assert run(capsys, "show", "exercise-6", "--full")[1] == plain  # an exercise has nothing to be derived here
    _, out, _ = run(capsys, "list")
    assert len(out.splitlines()) > len(entries())


def test_guide_mechanisms_name_the_guided_link_and_no_transfer_function(capsys):
    # Chapter 1: links of a guide mechanism guide or are guided; the word transfer function is not used for it.
    out = run(capsys, "show", "mzc", "--full")[1]
    assert "Guided link: coupler; guiding links: crank, rocker." in out
    assert "Transfer function" not in out
    out = run(capsys, "show", "crankrocker", "--full")[1]
    assert "Transfer function:" in out
    assert "Guide mechanism" not in out
    assert "Guide mechanism" not in run(capsys, "show", "friction_forced", "--full")[1]


def test_conditions_on_the_atlas(capsys):
    pytest.importorskip("duckdb")
    words = ("search", "--enumerate", "--links", "6", "--drives", "1", "--drives-at-frame", "1")
    status, out, err = run(capsys, *words, "--where", "highest_class = 3 and family = 'Stephenson III'")
    assert (status, err) == (0, "")
    assert out.splitlines()[0].endswith("; frame=0; drive=R(0-4)  (Stephenson III)")
    assert out.splitlines()[1:] == ["1 found."]
    assert run(capsys, *words, "--atlas", "--count")[1] == "9\n"
    status, _, err = run(capsys, *words, "--where", "colour")
    assert status == 2
    assert "cannot be answered" in err
    status, _, err = run(capsys, "search", "--where", "planar")
    assert (status, err) == (2, "--where needs --enumerate")


def test_the_catalog_is_listed_without_the_solver():
    """Entries have loads, which are values; what computes with them is loaded when it is asked for."""
    script = (
        "import sys; from gruebler.cli import main; status = main(['catalog', 'list']); "
        "heavy = {'gruebler.mechanics.kinematics', 'gruebler.mechanics.forces.solution'} & set(sys.modules); "
        "sys.exit(', '.join(heavy) or status)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "Belt drive" in done.stdout
