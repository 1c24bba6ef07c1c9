"""`gruebler analyse` of linkages in space."""

import json
from math import cos

import pytest

from gruebler.files.screws import write_screws
from tests.commands import run_command
from tests.mechanics.screws import machines


@pytest.fixture
def hooke(tmp_path):
    path = tmp_path / "hooke.toml"
    write_screws(path, machines.hooke(0.5).with_drives([0]))
    return str(path)


def test_measures_and_table(capsys, hooke):
    status, text, _ = run_command(capsys, "analyse", hooke, "--range", "0:90:45")
    assert status == 0
    assert text.startswith("Mobility: counted -2, generic 0, instant 1, finite 1.")
    assert f"from {cos(0.5):.4g} at" in text
    assert "R(0-out)" in text.splitlines()[-4]


def test_json_has_all_digits(capsys, hooke):
    status, text, _ = run_command(capsys, "analyse", hooke, "--json", "--range", "0:90:45")
    document = json.loads(text)
    assert status == 0
    assert document["measures"]["least_ratio"]["value"] == pytest.approx(cos(0.5), abs=1e-12)
    assert [row[0] for row in document["rows"]] == pytest.approx([0, 45, 90])
    assert document["columns"][1] == {"name": "R(0-out)", "unit": "°"}


def test_the_assembly_modes_are_shown_or_why_there_is_no_list(capsys):
    _, text, _ = run_command(capsys, "analyse", "wiper_rssr", "--range", "0:10:10")
    assert "In the reference pose: 2 assembly modes, 2 of them real; these are all." in text
    _, text, _ = run_command(capsys, "analyse", "wiper_rssr", "--range", "0:10:10", "--json")
    assert json.loads(text)["assembly_modes"] == {"found": 2, "real": 2, "exact": True, "generic": 2, "far": 0}
    _, text, _ = run_command(capsys, "analyse", "bennett", "--range", "0:10:10", "--lang", "de")
    assert "Einbaulagen sind nicht bekannt: " in text


@pytest.mark.parametrize(
    ("machine", "told"),
    [  # a body between two balls spins about their line
        ("susp_spatial", "Idle: tie_rod spins for itself alone; without idle freedoms the mobility is 1."),
        ("wobble_plate", "Idle: rod1, rod2, rod3 spin for themselves alone; without idle freedoms the mobility is 1."),
        ("bennett", None),
    ],
)
def test_idle_freedoms_are_told(capsys, machine, told):
    _, text, _ = run_command(capsys, "analyse", machine, "--at", "0")
    lines = [line for line in text.splitlines() if line.startswith("Idle")]
    assert lines == [told] * (told is not None)


def test_the_circuit_is_told(capsys):
    _, text, _ = run_command(capsys, "analyse", "susp_spatial", "--at", "0")
    assert "A closed circuit" in text
    assert text.count("The drive turns back at R(body-lower_wishbone) = ") == 1
    assert "Dead centres of the output R(body-upper_wishbone) at" in text
    _, text, _ = run_command(capsys, "analyse", "susp_spatial", "--at", "0", "--json")
    circuit, measures = (json.loads(text)[key] for key in ("circuit", "measures"))
    assert circuit["closed"] is True
    limits = sorted(limit["value"] for limit in circuit["drive_limits"])
    assert limits == pytest.approx([measures["low"], measures["high"]], abs=1e-9)  # followed along the drive
    assert {centre["kind"] for centre in circuit["dead_centres"]} == {"minimum", "maximum"}


def test_without_drives_the_freedoms_are_said(capsys):
    status, text, _ = run_command(capsys, "analyse", "susp_5link", "--lang", "de")
    assert status == 0
    assert text.startswith("Laufgrad: gezählt 6")


def test_what_does_not_go_is_said(capsys, hooke):
    status, _, refused = run_command(capsys, "analyse", hooke, "--poles")
    assert status == 2
    assert "--poles does not go with a linkage in space" in refused


def test_rounding_is_printed_as_zero(capsys):
    """Schatz's second shaft has its largest speed at 120 degrees; the second derivative was printed as 3.3e-12."""
    _, text, _ = run_command(capsys, "analyse", "schatz", "--range", "0:120:120")
    assert text.splitlines()[-1].split() == ["120", "-106.1", "-2", "0"]


def test_without_rows_it_says_what_a_motion_needs(capsys):
    """The five rods of susp_5link hold the wheel by balls, which nothing drives; on the lift it moves."""
    _, text, _ = run_command(capsys, "analyse", "susp_5link")
    assert "No joint is driven, and a ball cannot be" in text
    assert text.rstrip().endswith("With a drive: susp_5link_lift.")
    status, _, message = run_command(capsys, "analyse", "susp_5link", "--range", "0:1:1")
    assert (status, "no joint is driven" in message) == (2, True)
    _, text, _ = run_command(capsys, "analyse", "diff_bevel")
    assert "give --range FROM:TO:STEP for each drive, in the order R(frame-carrier), R(frame-sun1)" in text


def test_ranges_go_to_the_drives_as_the_file_names_them(capsys):
    """drive = ["R(frame-carrier)", "R(frame-sun1)"]; by Willis sun2 = 2 carrier - sun1."""
    _, text, _ = run_command(capsys, "analyse", "diff_bevel", "--range", "10", "--range", "4", "--json")
    document = json.loads(text)
    assert [column["name"] for column in document["columns"]][:2] == ["R(frame-carrier)", "R(frame-sun1)"]
    assert document["rows"][0][:3] == pytest.approx([10, 4, 16])
    status, _, message = run_command(capsys, "analyse", "diff_bevel", "--range", "0:10:5")
    assert status == 2
    assert "expected --range once for each drive, in the order R(frame-carrier), R(frame-sun1), but it was" in message
    assert message.rstrip().endswith("given once")
    _, _, message = run_command(capsys, "analyse", "diff_bevel", "--at", "1")
    assert "2 finite numbers separated by commas, for R(frame-carrier), R(frame-sun1)," in message
