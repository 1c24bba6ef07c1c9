"""`gruebler enumerate` as a user meets them."""

import json
import os
import subprocess
import sys

import pytest

from gruebler import Chain
from gruebler.cli import main
from gruebler.structure.enumeration.listing import chains
from tests.commands import run_main as run


def test_a_list_is_taken_back_by_the_parser(capfd):
    status, out, err = run(capfd, "enumerate", "--links", "8")
    assert (status, err) == (0, "")
    assert [Chain.parse(line) for line in out.splitlines()] == list(chains(8))


def test_json_is_a_list_of_chains_that_check_reads(capfd, tmp_path):
    path = tmp_path / "chains.json"
    status, out, err = run(
        capfd, "enumerate", "--links", "8", "--multiple-joints", "2", "--format", "json", "-o", str(path)
    )
    assert (status, out, err) == (0, "", f"Written: {path}, 18 chains\n")
    found = [Chain.from_json(one) for one in json.loads(path.read_text(encoding="utf-8"))]
    assert found == list(chains(8, multiple_joints=2))
    assert len(found) == 18
    status, out, _ = run(capfd, "check", str(path), "--json")
    assert status == 0
    assert {one["verdict"] for one in json.loads(out)} == {"constrained"}
    assert json.loads(run(capfd, "enumerate", "--links", "7", "--json")[1]) == []


def test_graph6(capfd):
    _, out, _ = run(capfd, "enumerate", "--links", "6", "--format", "graph6")
    assert [Chain.from_graph6(line) for line in out.split()] == list(chains(6))


def test_classes_are_labelled(capfd):
    _, out, _ = run(capfd, "enumerate", "--links", "8", "--mobility", "3", "--fractionated", "all")
    lines = out.splitlines()
    assert [line for line in lines if line.startswith("#")] == ["# none", "# link", "# joint"]
    assert len(lines) == 3 + 7
    _, out, _ = run(capfd, "enumerate", "--links", "8", "--mobility", "3", "--fractionated", "all", "--json")
    assert [one["fractionation"] for one in json.loads(out)] == ["none"] * 5 + ["link", "joint"]


def test_counts_as_json(capfd):
    _, out, _ = run(capfd, "enumerate", "--links", "8", "--count", "--json")
    assert json.loads(out) == {
        "links": 8,
        "mobility": 1,
        "chains": 16,
        "by_assortment": {"4,4": 9, "5,2,1": 5, "6,0,2": 2},
    }
    _, out, _ = run(capfd, "enumerate", "--links", "10", "--count", "--orbits", "--json")
    found = json.loads(out)
    assert (found["chains"], found["inversions"], found["drives"], found["joint_orbits"]) == (230, 1834, 4506, 2307)
    _, out, _ = run(
        capfd, "enumerate", "--links", "10", "--mobility", "3", "--fractionated", "all", "--count", "--json"
    )
    assert json.loads(out)["by_fractionation"] == {"none": 74, "link": 19, "joint": 5}
    assert json.loads(out)["chains"] == 98
    _, out, _ = run(capfd, "enumerate", "--links", "8", "--assortment", "6,0,2", "--count", "--json")
    assert json.loads(out)["chains"] == 2


def test_counts_in_words_in_both_languages(capfd):
    arguments = ["enumerate", "--links", "9", "--mobility", "2", "--fractionated", "all", "--count", "--orbits"]
    _, english, _ = run(capfd, *arguments)
    assert "fractionated at a link: 5\n" in english
    assert english.endswith("chains: 40\ninversions (frame): 254\n" + english.split("254\n")[1])
    _, german, _ = run(capfd, *arguments, "--lang", "de")
    assert "an einem Glied zerlegbar: 5\n" in german
    assert "Ketten: 40\n" in german


def test_jobs_and_checkpoint_change_nothing(capfd, tmp_path):
    alone = run(capfd, "enumerate", "--links", "12", "--format", "graph6")
    kept = ["enumerate", "--links", "12", "--format", "graph6", "--jobs", "2", "--checkpoint", str(tmp_path / "kept")]
    assert run(capfd, *kept) == alone
    assert run(capfd, *kept) == alone
    status, out, err = run(capfd, "enumerate", "--links", "10", "--count", "--checkpoint", str(tmp_path / "kept"))
    assert (status, out) == (2, "")
    assert "another task" in err
    assert len(err.splitlines()) == 1


def test_a_file_appears_whole_or_not_at_all(capfd, tmp_path):
    path = tmp_path / "count.json"
    assert run(capfd, "enumerate", "--links", "8", "--count", "-o", str(path)) == (0, "", f"Written: {path}\n")
    assert json.loads(path.read_text(encoding="utf-8"))["chains"] == 16
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--links", "20"], "32 TB of output"),
        (["--links", "18", "--format", "graph6"], "1,535,380,884 chains, 43 GB of output"),
        (["--links", "22", "--count"], "about 15,000,000,000,000 chains, about 13 h; use --yes"),
        (["--links", "20", "--lang", "de"], "mit --yes wird trotzdem begonnen"),
        (["--links", "2"], "at least three links"),
        (["--links", "8", "--assortment", "4;4"], "such as 4,4"),
        (["--links", "8", "--assortment", "4,3"], "7 links in all, not 8"),
        (["--links", "8", "--multiple-joints", "few"], "a number, a range"),
        (["--links", "8", "--multiple-joints", "1", "--format", "graph6"], "simple joints only"),
        (["--links", "8", "--orbits"], "--orbits needs --count"),
        (["--links", "8", "--json", "--format", "text"], "does not go with --format text"),
        (["--links", "8", "--jobs", "0"], "at least one process"),
        (["--links", "8", "-o", "no/such/directory/x"], "there is no directory"),
        (["--links", "8", "-o", "chains.parquet"], "ends with .txt, .g6 or .json, not with .parquet"),
        (["--links", "8", "-o", "chains.g6", "--format", "json"], "--format json and the ending .g6 do not agree"),
        (["--links", "8", "-o", "count.txt", "--count"], "a count is written as JSON"),
        (["--links", "8", "--fractionated", "some"], "invalid choice"),
        (["--mobility", "1"], "required"),
    ],
)
def test_wrong_usage_is_one_sentence_and_status_2(capfd, arguments, words):
    status, out, err = run(capfd, "enumerate", *arguments)
    assert (status, out) == (2, "")
    assert words in err
    assert len(err.strip().splitlines()) == 1


def test_a_long_request_is_begun_with_yes(capfd):
    """A list of 18 links is long, but that there is none of a rare assortment comes at once."""
    arguments = ["enumerate", "--links", "18", "--assortment", "15,0,0,0,0,0,3", "--count", "--fractionated", "none"]
    assert run(capfd, *arguments)[:2] == (1, "chains: 0\n")
    status, out, err = run(capfd, *arguments[:5], "--format", "graph6", "--yes")
    assert status == 1
    assert out == ""
    assert "of output" in err


def test_a_closed_pipe_is_no_fault():
    done = subprocess.run(
        f"{sys.executable} -m gruebler enumerate --links 12 --jobs 2 | head -n 1",
        shell=True,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    assert Chain.parse(done.stdout).n == 12


def test_assortments(capfd):
    _, out, _ = run(capfd, "enumerate", "--assortments", "--links", "8")
    assert out.split() == ["binary", "ternary", "quaternary", "4", "4", "0", "5", "2", "1", "6", "0", "2"]
    _, out, _ = run(capfd, "enumerate", "--assortments", "--links", "8", "--json")
    assert json.loads(out) == {"links": 8, "mobility": 1, "assortments": [[4, 4], [5, 2, 1], [6, 0, 2]]}
    _, out, _ = run(capfd, "enumerate", "--assortments", "--links", "6", "--multiple-joints", "--json")
    assert json.loads(out)["assortments"] == [
        {"links": [4, 2], "joints": [7]},
        {"links": [5, 1], "joints": [5, 1]},
        {"links": [6], "joints": [3, 2]},
    ]
    _, out, _ = run(capfd, "enumerate", "--assortments", "--links", "6", "--multiple-joints", "--lang", "de")
    assert out.splitlines()[0].split("  ") == ["binär", "ternär", "Gelenke mit 2 Gliedern", "Gelenke mit 3 Gliedern"]
    _, out, _ = run(capfd, "enumerate", "--assortments", "--links", "7")
    assert out == "No closed chain of 7 links has mobility 1.\n"
    status, _, err = run(capfd, "enumerate", "--assortments", "--links", "0")
    assert status == 2
    assert "at least one link" in err


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Windows has no pipes with names in folders")
def test_the_output_goes_to_ordinary_files_only(tmp_path, capsys):
    """A pipe is refused and stays one; a link's target gets the content and keeps its rights."""
    pipe, target, link = tmp_path / "pipe", tmp_path / "target.txt", tmp_path / "link.txt"
    os.mkfifo(pipe)
    assert main(["enumerate", "--links", "6", "-o", str(pipe)]) == 2
    assert pipe.is_fifo()
    target.write_text("before")
    target.chmod(0o600)
    link.symlink_to(target)
    assert main(["enumerate", "--links", "6", "-o", str(link)]) == 0
    assert link.is_symlink()
    assert len(target.read_text().splitlines()) == 2
    assert target.stat().st_mode & 0o777 == 0o600
    assert main(["enumerate", "--links", "6", "-o", ""]) == 2
    assert "cannot be written" in capsys.readouterr().err


@pytest.mark.parametrize(("ending", "beginning"), [(".txt", "R("), (".g6", "G"), (".json", "["), ("", "R(")])
def test_the_ending_decides_the_format(tmp_path, capsys, ending, beginning):
    path = tmp_path / f"chains{ending}"
    assert main(["enumerate", "--links", "8", "-o", str(path)]) == 0
    assert path.read_text().startswith(beginning)
    assert capsys.readouterr() == ("", f"Written: {path}, 16 chains\n")
    assert main(["check", str(path), "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)) == 16


def test_graph6_files_are_taken_back(tmp_path, capsys):
    path = tmp_path / "eight.g6"
    assert main(["enumerate", "--links", "8", "--format", "graph6", "-o", str(path)]) == 0
    capsys.readouterr()
    assert main(["check", str(path), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [one["verdict"] for one in found] == ["constrained"] * 16


@pytest.mark.parametrize(
    ("links", "mobility", "why"),
    [
        ("7", "1", "there is no chain of 7 links with mobility 1: F = 3(n - 1) - 2 g1 makes n + F odd."),
        ("4", "3", "there is no such chain of 4 links with mobility 3."),
    ],
)
def test_an_empty_list_gives_its_reason(capfd, links, mobility, why):
    status, out, err = run(capfd, "enumerate", "--links", links, "--mobility", mobility)
    assert (status, out, err) == (1, "", f"gruebler enumerate: {why}\n")
    status, out, err = run(capfd, "enumerate", "--links", links, "--mobility", mobility, "--count")
    assert (status, out, err) == (1, "chains: 0\n", f"gruebler enumerate: {why}\n")
    assert json.loads(run(capfd, "enumerate", "--links", links, "--mobility", mobility, "--json")[1]) == []


def test_a_terminal_gets_the_first_chains(capfd, monkeypatch):
    """Of the 230 chains of ten links 20 are shown; a pipe gets all, and so does --all."""
    _, whole, _ = run(capfd, "enumerate", "--links", "10")
    assert len(whole.splitlines()) == 230
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    _, out, _ = run(capfd, "enumerate", "--links", "10")
    assert out.splitlines()[:20] == whole.splitlines()[:20]
    assert out.splitlines()[20:] == ["... and 210 more chains: --all prints them, -o writes them."]
    _, out, _ = run(capfd, "enumerate", "--links", "10", "--all")
    assert out == whole
    _, out, _ = run(capfd, "enumerate", "--links", "8")
    assert len(out.splitlines()) == 16  # a few more than 20 would not be cut either


def test_long_lists_of_assortments_are_cut(capfd):
    """Partitions: 40 links have 16,765 assortments."""
    _, count, _ = run(capfd, "enumerate", "--links", "40", "--assortments", "--count")
    _, out, _ = run(capfd, "enumerate", "--links", "40", "--assortments")
    assert len(out.splitlines()) == 1 + 20 + 1
    assert out.splitlines()[-1] == f"... and {int(count) - 20:,} more rows: --all prints them."
    _, out, _ = run(capfd, "enumerate", "--links", "40", "--assortments", "--all")
    assert len(out.splitlines()) == 1 + int(count)
