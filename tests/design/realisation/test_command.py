"""`gruebler realise`: what it prints, writes and returns."""

import json

import pytest

from gruebler.cli.commands import command
from gruebler.design.realisation import realise
from gruebler.files.linkages import linkage_from_json, read_linkage
from gruebler.mechanics.kinematics import move
from gruebler.structure.mechanism import Mechanism

FOUR = "R(0-1) R(1-2) R(2-3) R(3-0)"


def called(chain, *options):
    chosen = command("realise")
    return chosen.module().run(chosen.parser().parse_args([chain, "--tries", "200", *options]))


def test_it_prints_a_linkage(capsys, tmp_path):
    assert called(FOUR) == 0
    said, _, document = capsys.readouterr().out.partition("\n\n")
    assert "R(0-1) turns fully" in said
    file = tmp_path / "four.toml"
    file.write_text(document, encoding="utf-8")
    assert read_linkage(file).size == pytest.approx(100, rel=0.05)


@pytest.mark.parametrize("name", ["four.toml", "four.json"])
def test_what_it_writes_moves(capsys, tmp_path, name):
    assert called(FOUR, "--drive", "R(3-0)", "--seed", "3", "-o", str(tmp_path / name), "--lang", "de") == 0
    assert "D(3-0) läuft um" in capsys.readouterr().out
    found = realise(Mechanism.parse(f"{FOUR}; drive=R(3-0)"), seed=3, budget=200)
    motion = move(read_linkage(tmp_path / name), found.path())
    assert motion.complete
    assert motion.closure_error < 1e-12


def test_json(capsys):
    assert called("R(0-1) R(1-2) R(2-3) P(3-0)", "--json", "--drive", "P(3-0)") == 0
    document = json.loads(capsys.readouterr().out)
    (drive,) = document["drives"]
    assert drive["joint"] == "P(3-0)"
    linkage = linkage_from_json(document["linkage"])
    assert move(linkage, drive["range"]).complete


def test_a_failure_is_said(capsys):
    assert called("R(0-1) R(1-2) R(2-0)") == 1
    assert "no mobility" in capsys.readouterr().out
    assert called("R(0-1) R(1-2) R(2-0)", "--json", "--lang", "de") == 1
    assert json.loads(capsys.readouterr().out)["found"] is False
