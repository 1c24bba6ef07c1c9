"""The command line as a user meets it: output, JSON, exit statuses, and one sentence for every mistake."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from gruebler.cli.commands import command as command_named
from gruebler.cli.commands import command_names
from gruebler.teaching.catalog import check_all, entries
from tests.commands import run_main as run

FOUR_BAR = "R(frame-crank) R(crank-rod) R(rod-rocker) R(rocker-frame)"
KEYS = {
    "finite",
    "method",
    "name",
    "links",
    "joints",
    "space",
    "counted",
    "generic",
    "verdict",
    "exact",
    "overconstrained",
    "rigid_clusters",
    "immobile_joints",
    "idle_freedoms",
    "instant",
    "reasons",
    "claims_hold",
}


@pytest.fixture(scope="module")
def checked_catalog():
    return check_all()


def test_the_whole_catalog(capsys, monkeypatch, checked_catalog):
    monkeypatch.setattr("gruebler.cli.check.check_all", lambda: checked_catalog)
    summary = run(capsys, "check")
    status, out, err = run(capsys, "check", "--all")
    assert (status, err) == (0, "")
    assert (summary[0], summary[2]) == (0, "")
    assert f"Chains: {out.rpartition('Chains: ')[2]}" in summary[1]  # every claim holds
    for id in entries():
        assert f"\n{id} " in out
    assert "every claim holds" in out
    assert "\x1b" not in out


def test_json_has_its_keys(capsys):
    status, out, _ = run(capsys, "check", "--json", "vcomp", FOUR_BAR, "g6:C~")
    assert status == 0
    machine, chain, braced = json.loads(out)
    assert set(machine) == set(chain) == set(braced) == KEYS
    assert machine["claims_hold"] is True
    assert chain["claims_hold"] is None
    assert braced["overconstrained"][0]["redundancy"] == 3
    assert braced["rigid_clusters"] == [["0", "1", "2", "3"]]
    assert braced["verdict"] == "overconstrained"


def test_explanations_in_both_languages(capsys):
    _, english, _ = run(capsys, "check", "loco3", "--explain")
    assert "Dimensions decide" in english
    assert "F = 3(n - 1) - 2 g1 = 3(5 - 1) - 2·6 = 0" in english
    _, german, _ = run(capsys, "check", "loco3", "--explain", "--lang", "de")
    assert "Die Abmessungen entscheiden" in german
    _, winch, _ = run(capsys, "check", "winch_screw", "--explain")
    assert "With b = 2 the count gives 1" in winch
    _, own, _ = run(capsys, "check", "winch_screw", "--b", "2", "--explain")
    assert "F = 2(n - 1) - g1 = 2(3 - 1) - 3 = 1" in own


def test_demo(capsys, monkeypatch, checked_catalog):
    monkeypatch.setattr("gruebler.cli.demo.check_all", lambda: checked_catalog)
    status, out, _ = run(capsys, "demo")
    assert status == 0
    for title in ("(vcomp)", "(diff)", "(loco3)", "(quad_strut)"):
        assert title in out


def test_catalog_list_show_search(capsys):
    status, out, _ = run(capsys, "catalog", "list", "--lang", "de")
    assert status == 0
    assert "exercise-5b" in out
    assert "003, Bild 3.3; 000/003, Abschnitt 3.5.4 und Aufgabe 19" in out
    _, out, _ = run(capsys, "catalog", "show", "vcomp", "exercise-6", "--lang", "de")
    assert 'D(Kurbel-"Pleuel 1"-"Pleuel 2")' in out
    assert "Aufgabe" in out
    _, out, _ = run(capsys, "catalog", "search", "compressor", "--links", "6", "--json")
    assert [e["id"] for e in json.loads(out)] == ["vcomp"]
    _, out, _ = run(capsys, "catalog", "search", "unicorn")
    assert out == "No entry of the catalog matches.\n"


def test_files(capsys, tmp_path):
    lines = tmp_path / "chains.txt"
    lines.write_text(f"# two chains\n{FOUR_BAR}\n\ng6:C~\n", encoding="utf-8")
    document = tmp_path / "chain.json"
    joint = {"pair": "revolute", "links": ["a", "b"]}
    document.write_text(json.dumps([{"joints": [joint, joint, {**joint, "links": ["b", "c"]}]}]), encoding="utf-8")
    status, out, _ = run(capsys, "check", str(lines), str(document), "--json")
    assert status == 0
    assert [one["counted"] for one in json.loads(out)] == [1, -3, 0]


@pytest.mark.parametrize("arguments", [["--help"], ["help"], ["-h"], ["--lang", "en", "--help"]])
def test_the_overview_names_every_command_in_a_group(capsys, arguments):
    status, out, _ = run(capsys, *arguments)
    assert status == 0
    assert [line for line in out.splitlines() if line == "Pictures"]
    assert all(f"\n  {name} " in out for name in command_names())


@pytest.mark.parametrize("words", [["help", "curve"], ["curve", "--help"], ["--lang", "en", "curve", "-h"]])
def test_help_of_a_command(capsys, words):
    status, out, _ = run(capsys, *words)
    assert status == 0
    assert out.startswith("usage: gruebler curve ")
    assert "--contact VALUE" in out


def test_every_command_has_a_module_with_add_and_run():
    for name in command_names():
        parser = command_named(name).parser()
        assert parser.description, name
        assert callable(command_named(name).module().run), name


def test_the_language_of_the_environment(capsys, monkeypatch):
    monkeypatch.setenv("GRUEBLER_LANG", "de")
    assert "Urteil: zwangläufig" in run(capsys, "check", FOUR_BAR, "--explain")[1]
    assert "Urteil: zwangläufig" not in run(capsys, "check", FOUR_BAR, "--explain", "--lang", "en")[1]
    monkeypatch.setenv("GRUEBLER_LANG", "fr")
    assert run(capsys, "check", FOUR_BAR)[::2] == (
        2,
        "gruebler check: GRUEBLER_LANG: expected en or de, but found 'fr'\n",
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["check", "R(0-1) R(1-2"], "')' at character 13"),
        (["check", "R(0-1) S(1-2)"], "spherical"),
        (["check", "no-such-machine"], "the catalog has no entry 'no-such-machine'"),
        (["check", "missing.toml"], "missing.toml: cannot be read"),
        (["check", "missing.json"], "missing.json: cannot be read"),
        (["check", "vcomp", "--frame", "wall"], "no link 'wall'"),
        (["check", "vcomp", "--b", "9"], "1 to 6"),
        (["check", "vcomp", "--b", "x"], "expected a whole number"),
        (["check", "--lang", "fr"], "invalid choice"),
        (["check", "--nonsense"], "unknown arguments: --nonsense"),
        (["check", "--explian", "vcomp"], "did you mean '--explain'?"),
        (["enumerate", "--likns", "4"], "unknown arguments: --likns (did you mean '--links'?)"),
        (["synthesise", "path", "--swing", "4"], "unknown arguments: --swing (see"),
        (
            ["synthesise", "positions", "a.csv", "--structure", "Watt I", "Watt II"],
            "unknown arguments: Watt II (give --structure before each of its values) (see",
        ),
        (["check", "foo"], "the catalog has no entry 'foo'; `gruebler catalog list` shows them all"),
        (
            ["exercise", "sheet", "--kind", "mobility", "-o", "x.pdf", "--solutions"],
            "unknown arguments: --solutions (see",
        ),
        (["chek"], "there is no command 'chek' (did you mean 'check'?); see gruebler --help"),
        (["help", "chek"], "did you mean 'check'?"),
        (["catalog", "sho"], "did you mean 'show'?"),
        (["synthesise", "position", "a.csv"], "did you mean 'positions'?"),
        (["check", "--space", "sphere"], "did you mean 'spherical'?"),
        (["check", "."], "'.' is a folder; expected a file"),
        (["analyse", "."], "'.' is a folder; expected a file"),
        # from Python 3.14 on, such a name is one of no file
        (["check", "a" * 3000], "File name too long" if sys.version_info < (3, 14) else "no entry 'aaa"),
        (["atlas"], "required"),
        (["catalog", "show", "nothing"], "no entry 'nothing'"),
        (["catalog", "search", "--pair", "revolut"], "did you mean 'revolute'"),
    ],
)
def test_wrong_usage_is_one_sentence_and_status_2(capsys, arguments, words):
    status, out, err = run(capsys, *arguments)
    assert status == 2
    assert out == ""
    assert words in err
    assert len(err.strip().splitlines()) == 1


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.json", "{", "is not JSON"),
        ("empty.json", " \n", "empty.json: is empty"),
        ("empty.toml", "", "empty.toml: is empty"),
        ("almost.toml", "# a comment\n", "almost.toml: the key 'id' is missing"),
        ("named.json", '[{"name": "watt", "joints": 3}]', "named.json[1] (watt): "),
        ("b.json", "[[]]", "b.json[1]: a chain is a JSON object"),
        ("c.txt", "R(0-1) R(1-2) R(2-0)\nR(0-1)\n", "c.txt, line 2: a kinematic chain has at least three links"),
        ("d.txt", "\n# nothing\n", "no chain in it"),
    ],
)
def test_bad_files_are_named(capsys, tmp_path, name, text, words):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    status, _, err = run(capsys, "check", str(path))
    assert status == 2
    assert words in err
    assert name in err


def test_a_wrong_claim_is_status_1_and_says_file_key_printed_derived(capsys, tmp_path):
    source = entries()["quad"]
    path = tmp_path / "quad.toml"
    links = "\n".join(f'"{link}" = "{german}"' for link, german in source.links.items())
    path.write_text(
        f'id = "quad"\nname.en = "x"\nname.de = "x"\nsource = "x"\njoints = """{source.joints}"""\n'
        f"[links]\n{links}\n[claims]\nn = 5\n",
        encoding="utf-8",
    )
    status, out, err = run(capsys, "check", str(path))
    assert status == 1
    assert "WRONG" in out
    assert err == f"{path}: claims.n: printed 5, derived 4\n"


def test_catalog_alone_lists_it(capsys):
    assert run(capsys, "catalog") == run(capsys, "catalog", "list")


def test_a_path_that_cannot_be_written_is_named_as_it_was_given(capsys):
    status, _, err = run(capsys, "draw", "quad", "-o", "no/such/k.svg")
    assert (status, err.count("no/such/k.svg")) == (2, 1)
    assert str(Path.cwd()) not in err


def test_the_columns_of_the_atlas_in_german(capsys):
    german, english = (
        json.loads(run(capsys, "atlas", "columns", "--json", "--lang", lang)[1]) for lang in ("de", "en")
    )
    assert [row["name"] for row in german] == [row["name"] for row in english]
    assert all(own["definition"] != other["definition"] for own, other in zip(german, english, strict=True))


def test_standard_input_and_a_closed_pipe():
    command = [sys.executable, "-m", "gruebler"]
    done = subprocess.run([*command, "check", "-"], input=FOUR_BAR, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "constrained" in done.stdout
    piped = subprocess.run(
        f"{sys.executable} -m gruebler catalog list | head -n 1",
        shell=True,
        capture_output=True,
        text=True,
        check=False,
    )
    assert piped.stderr == ""


def test_help_names_every_command(capsys):
    status, out, _ = run(capsys, "--help")
    assert status == 0
    for command in ("check", "catalog", "demo"):
        assert command in out
    assert run(capsys, "--version")[1].startswith("gruebler ")
    assert run(capsys, "version") == run(capsys, "--version")


def command(script, **options):
    return subprocess.run(
        f"{sys.executable} -m gruebler {script}", shell=True, capture_output=True, text=True, check=False, **options
    )


def test_a_closed_or_narrow_output_is_no_traceback():
    closed = command("check vcomp >&-")
    assert (closed.returncode, closed.stderr) == (0, "")
    narrow = command("check vcomp --lang de --explain", env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert narrow.returncode == 0
    assert "z\\xe4hlt" in narrow.stdout


def test_files_from_other_editors_and_with_absurd_numbers(capsys, tmp_path):
    marked = tmp_path / "marked.txt"
    marked.write_text(FOUR_BAR, encoding="utf-8-sig")
    assert run(capsys, "check", str(marked))[0] == 0
    for name, text in (("long.json", f'{{"joints": {"9" * 5000}}}'), ("empty.json", "[]"), ("deep.json", "[" * 10**5)):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        status, _, err = run(capsys, "check", str(path))
        assert status == 2
        assert len(err.strip().splitlines()) == 1


def test_a_mechanism_is_checked_as_its_chain(capsys):
    status, out, _ = run(capsys, "check", f"{FOUR_BAR}; frame=frame; drive=R(frame-crank)", "--json")
    assert status == 0
    assert json.loads(out)[0]["counted"] == 1


def test_the_file_of_a_linkage_is_taken_wherever_a_chain_is(capsys, tmp_path):
    from gruebler.files.linkages import write_linkage
    from gruebler.mechanics.fourbar import FourBar

    for suffix in ("toml", "json"):
        path = tmp_path / f"rocker.{suffix}"
        write_linkage(path, FourBar(25, 70, 40, 70).linkage())
        for command, told in (("assur", "drive R(frame-crank) -> RRR{coupler, rocker}"), ("inversions", "four-bar")):
            status, out, err = run(capsys, command, str(path))
            assert (status, err) == (0, ""), command
            assert told in out
    status, out, _ = run(capsys, "check", str(tmp_path / "rocker.toml"))
    assert status == 0
    assert "constrained" in out


def test_a_table_is_not_written_under_the_name_of_a_picture(capsys, tmp_path):
    for command in (("analyse", "lambda"), ("statics", "slider-crank:20,60", "--load", "R(coupler-slider)=-1,0")):
        status, _, err = run(capsys, *command, "-o", str(tmp_path / "x.svg"))
        assert status == 2
        assert "expected a name that ends with .txt, .json, .csv or .parquet" in err
    assert list(tmp_path.iterdir()) == []


def test_units_and_origins_of_atlas_columns_are_german_but_not_their_names(capsys):
    lines = run(capsys, "atlas", "columns", "--all", "--lang", "de")[1].splitlines()
    row = next(line.split() for line in lines if line.split()[:2] == ["chains", "joints"])
    assert (row[3], row[-2:]) == ("Gelenke", ["die", "Kette"])
