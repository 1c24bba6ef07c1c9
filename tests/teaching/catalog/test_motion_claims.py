"""Claims on the motion of a machine: what is stated wrongly is named, and what is altered contradicts the claims."""

import pytest

from gruebler.base.errors import CatalogError
from gruebler.files import read_entry
from gruebler.teaching.catalog import catalog_folder, check_entry, entries
from tests.commands import run_command

STATED = [id for id, machine in entries().items() if machine.claims.says_motion]


def altered(tmp_path, id, *changes):
    """A machine of the catalog with other texts in its file."""
    text = (catalog_folder() / "machines" / f"{id}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / f"{id}.toml"
    path.write_text(text, encoding="utf-8")
    return path


def wrong(path):
    return [str(each) for each in check_entry(read_entry(path)).wrong]


def test_machines_that_say_how_they_move():
    assert len(STATED) > 25
    assert {"vcomp", "crankrocker", "wiper", "loco3", "geneva"} <= {*STATED}


@pytest.mark.parametrize(
    ("id", "old", "new", "sentence"),
    [
        # what is stated
        (
            "crankrocker",
            'rocker = "swings"',
            'rocker = "turns"',
            "claims.motion.rocker: printed turns fully, derived swings",
        ),
        (
            "crankrocker",
            'crank = "turns"',
            'crank = "swings"',
            "claims.motion.crank: printed swings, derived turns fully",
        ),
        (
            "wiper",
            'blade = "parallel"',
            'blade = "swings"',
            "claims.motion.blade: printed swings, derived does not turn",
        ),
        (
            "vcomp",
            'piston2 = "slides"',
            'piston2 = "parallel"',
            "claims.motion.piston2: printed does not turn, derived slides",
        ),
        ("vcomp", "piston2 = 60", "piston2 = 61", "claims.travel.piston2: printed 61, derived 60"),
        ("vcomp", "[135, 315]", "[135]", "claims.dead_centres.piston2: printed 135, derived 135, 315"),
        (
            "loco2",
            'rod = "parallel"',
            'rod = "parallel" }\ntravel = { wheel2 = 90',
            "claims.travel.wheel2: printed 90, derived none",
        ),
        # what is altered: the angle of the V, a crank, a pin of the blade
        ("vcomp", "[0, 0, 135]", "[0, 0, 120]", "claims.dead_centres.piston2: printed 135, 315, derived 120, 300"),
        (
            "vcomp",
            '"R(crank-conrod1-conrod2)" = [30, 0]',
            '"R(crank-conrod1-conrod2)" = [31, 0]',
            "claims.travel.piston1: printed 60, derived 62",
        ),
        ("wiper", "[300, 120]", "[301, 120]", "claims.motion.blade: printed does not turn, derived swings"),
        ("crankrocker", "d = 70", "d = 30", "claims.motion.crank: printed turns fully, derived swings"),
    ],
)
def test_what_does_not_hold_is_named(tmp_path, id, old, new, sentence):
    assert sentence in wrong(altered(tmp_path, id, (old, new)))


def test_check_ends_with_1(tmp_path, capsys):
    path = altered(tmp_path, "vcomp", ("[0, 0, 135]", "[0, 0, 120]"))
    status, out, err = run_command(capsys, "check", str(path), "--lang", "de")
    assert (status, "FALSCH" in out) == (1, True)
    assert "claims.dead_centres.piston2: gedruckt 135; 315, hergeleitet 120; 300" in err


def test_the_explanation_says_what_is_stated(capsys):
    status, out, _ = run_command(capsys, "check", "vcomp", "--explain")
    assert status == 0
    assert "Stated motion: crank turns fully, piston1 slides, piston2 slides." in out
    assert "Stated travel, in degrees or the unit: piston1 60, piston2 60." in out
    assert "Stated dead centres, as values of the drive: piston1 45, 225; piston2 135, 315." in out
    _, german, _ = run_command(capsys, "check", "vcomp", "--explain", "--lang", "de")
    assert "Angegebene Bewegung: Kurbel läuft um, Kolben 1 gleitet, Kolben 2 gleitet." in german


@pytest.mark.parametrize(
    ("id", "old", "new", "problem"),
    [
        ("vcomp", 'piston2 = "slides"', 'piston3 = "slides"', "claims.motion: "),
        ("vcomp", 'piston2 = "slides"', 'piston2 = "jumps"', "claims.motion"),
        ("vcomp", "piston2 = 60", "piston3 = 60", "claims.travel: "),
        (
            "tri",
            "counted = 0",
            'counted = 0\nmotion = { 1 = "turns" }',
            "claims.motion: needs dimensions and one drive",
        ),
        (
            "pent",
            "counted = 2",
            'counted = 2\nmotion = { 2 = "turns" }',
            "claims.motion: needs dimensions and one drive",
        ),
    ],
)
def test_claims_that_cannot_be_derived_are_refused(tmp_path, id, old, new, problem):
    with pytest.raises(CatalogError, match=problem):
        read_entry(altered(tmp_path, id, (old, new)))
