"""The commands assur and extend through their run functions: text, JSON, counts, statuses, both languages."""

import json
import subprocess
import sys
from argparse import Namespace

import pytest

from gruebler import Chain, GrueblerError, code
from gruebler.cli import assur, extend, main
from gruebler.structure.assur import AssurGroup
from gruebler.structure.transformations import Derivation

WATT = "R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"
FOUR_BAR = "R(0-1) R(1-2) R(2-3) R(3-0)"
FIVE_BAR = "R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)"

DEFAULTS = {
    assur: {
        "mechanism": None,
        "frame": None,
        "drive": [],
        "anywhere": False,
        "list": None,
        "count": False,
        "modes": False,
    },
    extend: {"chain": None, "dyad": None, "coupler": None, "at_joints": False, "derivation": False, "count": False},
}


def run(capsys, command, **arguments):
    known = {**DEFAULTS[command], "json": False, "lang": "en", "yes": False}
    assert set(arguments) <= set(known)
    status = command.run(Namespace(**{**known, **arguments}))
    out, err = capsys.readouterr()
    assert err == ""
    return status, out


def test_assur_says_the_groups(capsys):
    status, out = run(capsys, assur, mechanism=f"{WATT}; frame=0; drive=R(0-1)")
    assert status == 0
    assert out.splitlines()[0] == "drive R(0-1) -> RRR{2, 3} -> RRR{4, 5}"
    assert "Class II, order 2" in out
    status, german = run(capsys, assur, mechanism=f"{WATT}; frame=0; drive=R(0-1)", lang="de")
    assert german.splitlines()[0] == "Antrieb D(0-1) -> DDD{2, 3} -> DDD{4, 5}"
    assert "Klasse II, Ordnung 2" in german
    assert "Class" not in german


def test_assur_in_json(capsys):
    status, out = run(capsys, assur, mechanism=WATT, frame="2", drive=["R(1-2)"], json=True)
    assert status == 0
    found = json.loads(out)
    assert found["count"] == len(found["items"]) == 2
    assert (found["formula"], found["class"], found["complete"]) == ("drive R(1-2) -> RRR{0, 3} -> RRR{4, 5}", 2, True)
    assert [item["links"] for item in found["items"]] == [["0", "3"], ["4", "5"]]
    assert found["items"][1]["after"] == [0]
    for item in found["items"]:
        assert AssurGroup.parse(item["text"]).code == item["code"]
        assert len(item["outer"]) == item["order"] == 2


def test_assur_of_catalog_entries_and_codes(capsys):
    status, out = run(capsys, assur, mechanism="vcomp")
    assert status == 0
    assert out.splitlines()[0].startswith("drive R(frame-crank) -> RRP{conrod1, piston1} -> RRP{conrod2, piston2}")
    status, out = run(capsys, assur, mechanism=code(Chain.parse(FOUR_BAR), frame="0", drives=[0]))
    assert status == 0
    assert "-> RRR{" in out


def test_assur_compares_drives_where_none_is_named(capsys):
    status, out = run(
        capsys, assur, mechanism="R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)", frame="4", anywhere=True
    )
    assert status == 0
    assert [line.split()[1] for line in out.splitlines()] == ["class", "II", "II", "II", "II", "III", "IV", "IV"]
    _, out = run(capsys, assur, mechanism=WATT, json=True)
    found = json.loads(out)
    assert found["count"] == len(found["items"]) == 2
    assert all(item["text"].startswith(f"{WATT}; frame=0; drive=") for item in found["items"])
    _, out = run(capsys, assur, mechanism=WATT, count=True)
    assert out == "2\n"


def test_assur_says_what_drives_leave_free(capsys):
    status, out = run(capsys, assur, mechanism=f"{FIVE_BAR}; drive=R(0-1)")
    assert status == 1
    assert "Not determined: 2, 3, 4." in out
    status, out = run(capsys, assur, mechanism=f"{FIVE_BAR}; drive=R(0-1)", json=True, lang="de")
    found = json.loads(out)
    assert (status, found["complete"], found["rest"]) == (1, False, ["2", "3", "4"])
    assert "noch beweglich" in found["message"]


@pytest.mark.parametrize(("links", "number"), [(2, 1), (4, 2), (6, 10)])
def test_assur_lists_groups(capsys, links, number):
    assert run(capsys, assur, list=links, count=True) == (0, f"{number}\n")
    _, out = run(capsys, assur, list=links, json=True)
    found = json.loads(out)
    assert found["count"] == len(found["items"]) == number
    assert all(AssurGroup.parse(item["text"]).code == item["code"] for item in found["items"])
    assert json.loads(run(capsys, assur, list=links, json=True, count=True)[1]) == {"count": number}
    _, out = run(capsys, assur, list=links, lang="de")
    assert len(out.splitlines()) == number + 1
    assert "Ordnung" in out


def test_derive(capsys):
    status, out = run(capsys, extend, derivation=True, chain=WATT)
    assert status == 0
    assert out.startswith("The chain grows from the closed loop of 4 links")
    _, german = run(capsys, extend, derivation=True, chain=WATT, lang="de")
    assert "durch einen Zweischlag" in german
    _, out = run(capsys, extend, derivation=True, chain=WATT, json=True)
    found = json.loads(out)
    assert found["from_loop"]
    assert found["count"] == len(found["items"]) == 1
    assert found["items"][-1]["code"] == code(Chain.parse(WATT))
    assert Derivation.from_json(found["derivation"]).chain == Chain.parse(WATT)


def test_derive_says_why_not(capsys):
    rigid = "R(0-1) R(1-2) R(2-3) R(3-0) R(0-2) R(1-3)"
    status, out = run(capsys, extend, derivation=True, chain=rigid)
    assert status == 0
    assert "does not grow by dyads" in out
    found = json.loads(run(capsys, extend, derivation=True, chain=rigid, json=True)[1])
    assert (found["from_loop"], found["exact"], found["count"]) == (False, True, 0)
    assert found["core"]["code"] == code(Chain.parse(rigid))


def test_extend(capsys):
    assert run(capsys, extend, chain=FOUR_BAR, dyad="RRR", count=True) == (0, "2\n")
    _, out = run(capsys, extend, chain=FOUR_BAR, dyad="RRP", json=True)
    found = json.loads(out)
    assert found["count"] == len(found["items"]) == 2
    for item in found["items"]:
        assert code(Chain.parse(item["text"])) == item["code"]
        assert (item["counted"], item["generic"], item["immobile_joints"]) == (1, 1, [])
    _, out = run(capsys, extend, chain=FIVE_BAR, coupler="RR", lang="de")
    lines = out.splitlines()
    assert lines[0].startswith("Kette")
    assert "D(0-1), D(0-5), D(5-1)" in lines[1]
    assert lines[2].endswith("2/4")
    assert run(capsys, extend, chain=FOUR_BAR, dyad="RRR", at_joints=True, count=True)[1] == "4\n"


@pytest.mark.parametrize(
    ("command", "arguments", "words"),
    [
        (assur, {}, "give either a mechanism or --list N"),
        (assur, {"mechanism": WATT, "list": 4}, "give either a mechanism or --list N"),
        (assur, {"list": 3}, "2, 4, 6"),
        (assur, {"mechanism": "R(0-1) R(1-2"}, "character 13"),
        (assur, {"mechanism": "nothing"}, "no entry 'nothing'"),
        (assur, {"mechanism": WATT, "frame": "9"}, "no link '9'"),
        (assur, {"mechanism": WATT, "drive": ["R(0-9)"]}, "not one of the joints"),
        (assur, {"mechanism": "R(0-1) R(1-2) R(2-0)"}, "does not move"),
        (assur, {"mechanism": "spatial: R(0-1) R(1-2) R(2-0); drive=R(0-1)"}, "spatial"),
        (extend, {"chain": "R(0-1)", "derivation": True}, "at least three links"),
        (extend, {"chain": FOUR_BAR, "dyad": "PPP"}, "the forms are RRR"),
        (extend, {"chain": FOUR_BAR, "coupler": "RG"}, "each R, P or W"),
        (extend, {"chain": "spatial: R(0-1) R(1-2) R(2-0)", "dyad": "RRR"}, "spatial"),
    ],
)
def test_mistakes_are_one_sentence(capsys, command, arguments, words):
    with pytest.raises(GrueblerError, match=words) as caught:
        run(capsys, command, **arguments)
    assert "\n" not in str(caught.value)


def test_a_list_without_names_has_no_column_for_them(capsys):
    """Of six links none of the groups has the name of a form, of four links one has."""
    assert run(capsys, assur, list=6)[1].splitlines()[0].split() == ["class", "order", "group"]
    _, out = run(capsys, assur, list=4)
    assert [line.split()[0] for line in out.splitlines()] == ["form", "3-RR", "IV"]


def test_many_chains_are_summed_up_and_those_that_fail_are_named(capsys, tmp_path):
    path = tmp_path / "chains.txt"
    four, three = "R(0-1) R(1-2) R(2-3) R(3-0)", "P(0-1) P(1-2) P(2-0)"  # a wedge moves, its count is 0
    path.write_text(f"{four}\n" * 50 + f"{three}\n", encoding="utf-8")
    assert main(["check", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[:2] + line.split()[-1:] for line in lines[1:3]] == [["1", "1", "50"], ["0", "1", "1"]]
    assert lines[4].startswith("The count is not right of 1: ")
    assert lines[5] == "Chains: 51; --all lists them, --json has them."
    assert main(["check", str(path), "--all"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 52


def test_assur_counts_modes(capsys):
    """3-RR: six in the plane (Hunt 1983), eight on the sphere (Gosselin, Sefrioui and Richard 1994)."""
    status, out = run(capsys, assur, list=4, modes=True, json=True)
    assert status == 0
    assert [(item["modes"], item["spherical_modes"]) for item in json.loads(out)["items"]] == [(6, 8), (6, 8)]
    status, out = run(capsys, assur, mechanism="R(0-1) R(1-2) P(2-3) R(3-0); frame=0; drive=R(0-1)", modes=True)
    assert status == 0
    assert out.splitlines()[-1].split()[-2:] == ["-", "-"]


def test_a_chain_is_checked_without_the_solver_and_without_the_catalog():
    """What asks for structure only waits neither for the solver nor for 70 machines to be read."""
    script = (
        "import sys; from gruebler.cli import main; from gruebler.files import catalog_records; "
        "catalog_records.load_document = lambda *_: sys.exit('a file of the catalog was read'); "
        "status = main(['check', 'R(0-1) R(1-2) R(2-3) R(3-0)']); "
        "heavy = {'gruebler.mechanics.kinematics.plan', 'gruebler.mechanics.screws.mobility_report', 'scipy', "
        "'networkx'} & set(sys.modules); sys.exit(', '.join(heavy) or status)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "constrained" in done.stdout
