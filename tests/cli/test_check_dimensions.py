"""`gruebler check` of linkages with dimensions or joint screws."""

import json

import pytest

from gruebler import GrueblerError
from gruebler.files import read_entry
from gruebler.teaching.catalog import check_entry, entry
from tests.commands import run_command


def run(capsys, *arguments):
    return run_command(capsys, "check", *arguments)


def test_an_entry_in_both_languages(capsys):
    status, out, err = run(capsys, "winch_screw", "--explain")
    assert (status, err) == (0, "")
    assert "Mobility: counted -3, generic 0, instant 1, finite 1." in out
    assert "with b = 2 the count gives 1" in out
    _, german, _ = run(capsys, "loco3", "--explain", "--lang", "de")
    assert "Blindwelle, Treibrad 1, Treibrad 2 sind 3 gleiche und parallele Kurbeln" in german


def test_lengths_at_a_pose(capsys):
    _, out, _ = run(capsys, "four-bar:2,5,2,5", "--at", "180", "--explain")
    assert "instant 2, finite 1" in out
    _, out, _ = run(capsys, "four-bar:2,5,2,5", "--at", "90", "--explain")
    assert "instant 1, finite 1" in out
    _, out, _ = run(capsys, "loader", "--at", "70", "--explain")  # centimetres, not degrees
    assert "finite 1" in out


def test_json_and_a_shaky_linkage(capsys, tmp_path):
    status, out, _ = run(capsys, "loco4", "--json")
    (document,) = json.loads(out)
    assert status == 0
    assert (document["counted"], document["finite"]["mobility"], document["instant"]["redundancy"]) == (-1, 1, 2)
    path = tmp_path / "tri.toml"
    path.write_text(
        'joints = "R(0-1) R(1-2) R(0-2)"\n[screws]\nunit = "mm"\n[screws.joints]\n'
        '"R(0-1)" = { at = [0, 0] }\n"R(1-2)" = { at = [1, 0] }\n"R(0-2)" = { at = [3, 0] }\n',
        encoding="utf-8",
    )
    status, out, _ = run(capsys, str(path), "--explain")
    assert status == 0
    assert "only shaky" in out
    assert "rigid" in run(capsys, str(path))[1].splitlines()[1].split()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["nonsense"], "no entry 'nonsense'"),
        (["missing.toml"], "cannot be read"),
        (["R(0-1) R(1-2) R(2-0)", "--at", "3"], "has no dimensions"),
        (["four-bar:1,2"], "expected a,b,c,d, but found 2 numbers"),
        (["belt", "--at", "0"], "cannot be found at a pose"),
        (["winch_screw", "--tolerance", "1"], "between 0 and 0.01"),
        (["winch_screw", "--at", "nan"], "one finite number"),
        (["winch_screw", "--branch", "+"], "no assembly mode"),
        (["diff", "--at", "3"], "expected 2 finite numbers"),
        (["four-bar:1,1,1,10"], "stay open by"),
    ],
)
def test_refusals(capsys, arguments, words):
    status, _, err = run(capsys, *arguments)
    assert status == 2
    assert words in err


def test_entries_are_checked_by_their_dimensions(tmp_path):
    for id in ("winch_screw", "loco3", "diff_bevel2p", "susp_5link", "crankrocker"):
        checked = check_entry(entry(id))
        assert checked.holds
        assert checked.freedoms is not None
        assert checked.freedoms.mobility == (checked.claims.mobility or checked.report.generic)
    text = entry_text("loco3")
    bored = tmp_path / "loco3.toml"
    bored.write_text(text.replace("at = [3320, 90]", "at = [3330, 90]"), encoding="utf-8")
    assert [str(w) for w in check_entry(read_entry(bored)).wrong] == ["claims.mobility: printed 1, derived 0"]
    bored.write_text(text.replace("assumed = true\n", ""), encoding="utf-8")
    with pytest.raises(GrueblerError, match="screws: either assumed = true, or a source"):
        read_entry(bored)
    bored.write_text(text.replace("at = [3320, 90]", "at = [3320]"), encoding="utf-8")
    with pytest.raises(GrueblerError, match=r"R\(wheel2-rod\), at: expected 2 or 3 numbers"):
        read_entry(bored)


def test_an_entry_without_dimensions(capsys, tmp_path):
    path = tmp_path / "loop.toml"
    path.write_text(
        'id = "loop"\nname = { en = "loop", de = "Masche" }\nsource = "none"\njoints = "R(0-1) R(1-2) R(0-2)"\n'
        '[links]\n0 = "a"\n1 = "b"\n2 = "c"\n',
        encoding="utf-8",
    )
    assert check_entry(read_entry(path)).freedoms is None
    assert run(capsys, str(path))[0] == 0
    status, _, err = run(capsys, str(path), "--branch", "+")
    assert status == 2
    assert "'loop' has no dimensions; --at, --branch and --tolerance need" in err


def entry_text(id):
    from gruebler.teaching.catalog import catalog_folder

    return (catalog_folder() / "machines" / f"{id}.toml").read_text(encoding="utf-8")


def test_a_value_for_each_drive(capsys):
    for linkage in ("drafting", "diff2p"):
        status, out, _ = run(capsys, linkage, "--at", "10,20", "--explain")
        assert status == 0
        assert "finite 2" in out
