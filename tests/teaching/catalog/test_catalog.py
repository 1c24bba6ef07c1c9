"""Every claim of the catalog is derived again, and wrong files are refused in a sentence that names file and key."""

import json
import re
from pathlib import Path

import msgspec
import numpy as np
import pytest

from gruebler import Chain, rotatability
from gruebler.base.errors import CatalogError
from gruebler.files import Claims, read_entry
from gruebler.files.linkages import linkage_from_json, linkage_to_json
from gruebler.mechanics.kinematics import move
from gruebler.structure.isomorphism import is_isomorphic
from gruebler.structure.mobility import pebble_mobility, theorem
from gruebler.teaching.catalog import (
    Query,
    catalog_folder,
    check_claims,
    check_entry,
    check_exercise,
    entries,
    entry,
    exercises,
    search,
)

# REFERENCE A3, computed independently of this project: id, b, n, g1, g2, F, mobility with the real dimensions.
# (M is given where it differs from max(F, 0).)
REFERENCE = json.loads((Path(__file__).parent / "reference_machines.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("machine", entries().values(), ids=entries())
def test_every_claim_of_a_machine_holds(machine):
    checked = check_entry(machine)
    assert [str(w) for w in checked.wrong] == []
    assert checked.report.exact


@pytest.mark.parametrize("exercise", exercises().values(), ids=exercises())
def test_every_claim_of_an_exercise_holds(exercise):
    for checked in check_exercise(exercise):
        assert [str(w) for w in checked.wrong] == []
        assert checked.report.exact


@pytest.mark.parametrize("row", REFERENCE, ids=lambda row: row["id"])
def test_the_machines_of_the_reference(row):
    machine = entry(row["id"])
    chain = machine.chain()
    report = check_entry(machine).report
    assert chain.n == row["n"]
    assert chain.joints_by_freedom == {int(f): g for f, g in row["by_f"].items()}
    assert report.counted == row["F"]
    assert report.generic == max(row["F"], 0)
    assert (machine.claims.mobility if machine.claims.mobility is not None else report.generic) == row["M"]
    assert machine.figure_lost == row["figure_lost"]
    if theorem(chain):
        assert pebble_mobility(chain) == report.generic


def test_the_structural_exercises():
    assert set(exercises()) == {"exercise-3", "exercise-4", "exercise-5", "exercise-5b", "exercise-6"}
    watt, stephenson, with_coupler = (entry(id).chain() for id in ("e3_watt", "e3_steph", "e4"))
    assert not is_isomorphic(watt, stephenson)
    assert is_isomorphic(with_coupler, stephenson)  # the coupler joins links that are not neighbours
    cases = {c.id: c.report for exercise in exercises().values() for c in check_exercise(exercise)}
    assert len(cases) >= 11
    machines = {case.machine for exercise in exercises().values() for case in exercise.cases}
    assert {"quad", "e3_watt", "e3_steph", "pent", "e4", "garage_norail", "diff", "vcomp"} <= machines


def test_both_languages_everywhere():
    for record in [*entries().values(), *exercises().values()]:
        texts = [record.name, getattr(record, "remark", None), getattr(record, "task", None)]
        for text in filter(None, texts):
            assert text.en.strip()
            assert text.de.strip()
            assert not any(wrong in text.de for wrong in ("ae ", "fuer", "ueber", "Getriebegrad")), record.id


def test_points_named_by_a_word_have_a_german_name():
    for record in entries().values():
        sizes = [each for each in (record.dimensions, record.screws) if each is not None]
        words = {point for each in sizes for point in each.points if len(point) > 1}
        assert words == set(record.points), record.id
    german = entry("loader_full").in_language("de")
    assert list(german.linkage().points) == list(german.points) == ["Schneide"]


@pytest.mark.parametrize(
    ("query", "ids"),
    [
        (Query(words=("Kompressor",), pairs=("P",)), {"compressor", "vcomp", "wobble_plate"}),
        (Query(words=("scissor",), links=4), {"hubpodium"}),
        (Query(mobility=3), {"drafting3", "excavator", "susp_rack"}),
        (Query(pairs=("helical",)), {"winch_screw"}),
        (Query(pairs=("Wälzgelenk",), joints=4), {"friction_forced"}),
        (Query(words=("no such thing",)), set()),
    ],
)
def test_search(query, ids):
    assert {e.id for e in search(query)} == ids


@pytest.mark.parametrize("word", ["in space", "räumlich"])
def test_machines_in_space_are_found_as_such(word):
    found = {e.id for e in search(Query(words=(word,)))}
    assert {e.id for e in entries().values() if e.in_space} <= found
    assert {"bennett", "gough", "delta"} <= found
    assert "lambda" not in found


def test_space_is_found_in_both_languages():
    """Also where only a remark has the word: all these machines move in space."""
    english, german = ({e.id for e in search(Query(words=(word,)))} for word in ("space", "Raum"))
    assert english == german == {e.id for e in entries().values() if e.in_space}


def test_search_by_purpose():
    """The entries that a reader of the teaching documents looks for and did not find by this word."""
    guides = {e.id for e in search(Query(words=("Führungsgetriebe",)))}
    assert {"mzc", "conchoid", "crane", "toolbox"} <= guides
    assert not {"crankrocker", "geneva", "geartrain", "vcomp"} & guides


def test_those_that_are_called_so_come_first():
    """A press was third, after a compressor."""
    ids = [each.id for each in search(Query(words=("press",)))]
    names = {id: entries()[id].name.en for id in ids}
    called = [id for id in ids if re.search(r"\bpress", names[id], re.IGNORECASE)]
    assert "toggle_press" in called
    assert {"compressor", "vcomp"} <= set(ids) - set(called)
    assert ids[: len(called)] == called == sorted(called)


@pytest.mark.parametrize(
    ("words", "found", "others"),
    [
        (
            "six-bar sixbar 6-bar SIX-BAR Sechsgelenk 6gelenk sechsgliedrig",
            "e3_watt klann whitworth",
            "quad belt jansen",
        ),
        ("four-bar 4-bar Viergelenk Viergelenkgetriebe", "crankrocker bennett slidercrank", "klann cam_rocker"),
        ("slider-crank slidercrank Schubkurbel", "slidercrank compressor", "crankrocker"),
        ("Führungsgetriebe Fuhrungsgetriebe", "mzc crane", "geneva belt"),
    ],
)
def test_search_by_what_a_linkage_is_called(words, found, others):
    """By the number of its links, which are in the file as rows only; spelled in any way."""
    for word in words.split():
        ids = {e.id for e in search(Query(words=(word,)))}
        assert set(found.split()) <= ids, word
        assert not set(others.split()) & ids, word


def test_search_by_drive():
    driven = {e.id for e in search(Query(drive="P"))}
    assert {"loader", "crane_cyl", "hubpodium_blocks"} <= driven
    assert "vcomp" not in driven


def test_stops_are_of_driven_joints_and_about_the_drawing():
    """A cylinder is as long as its pins lie apart."""
    arm = entry("excavator")
    places = arm.dimensions.places
    cylinders = [
        ("R(upper_structure-boom_cylinder)", "R(boom_piston-boom)"),
        ("R(boom-stick_cylinder)", "R(stick_piston-stick)"),
        ("R(stick-bucket_cylinder)", "R(bucket_piston-rocker-push_link)"),
    ]
    for (one, other), (low, high) in zip(cylinders, arm.stops, strict=True):
        assert low < np.hypot(*np.subtract(places[one], places[other])) < high
        assert high < 2 * low  # a rod has room in its cylinder
    wrong = msgspec.structs.replace(arm.dimensions, stops={"R(upper_structure-boom)": (0.0, 1.0)})
    with pytest.raises(CatalogError, match=r"no joint .R.upper_structure-boom.. is driven"):
        _ = msgspec.structs.replace(arm, dimensions=wrong).stops


GOOD = """
id = "it"
name.en = "Four-bar"
name.de = "Viergelenk"
source = "test"
joints = "R(frame-crank) R(crank-rod) R(rod-rocker) R(rocker-frame)"
frame = "frame"
drives = ["R(crank-frame)"]
outputs = ["rocker"]

[links]
frame = "Gestell"
crank = "Kurbel"
rod = "Koppel"
rocker = "Schwinge"

[claims]
n = 4
g1 = 4
g2 = 0
counted = 1
"""

TEN_MISTAKES = [
    ("not TOML", "[links]", "[links", "is not TOML"),
    ("unknown key", 'frame = "frame"', 'fram = "frame"', "unknown key 'fram'; did you mean 'frame'?"),
    ("unknown inner key", "counted = 1", "countd = 1", "unknown key 'claims.countd'; did you mean 'counted'?"),
    ("wrong type", "n = 4", 'n = "four"', "claims.n: expected"),
    ("missing key", 'source = "test"', "", "source"),
    ("unknown symbol", "R(crank-rod)", "Q(crank-rod)", "joints: unknown joint symbol 'Q'"),
    ("a slip in a name", "R(crank-rod)", "R(cranc-rod)", "did you mean 'crank'?"),
    ("a strange frame", 'frame = "frame"', 'frame = "wall"', "frame: the chain has no link 'wall'"),
    ("a strange drive", "R(crank-frame)", "P(crank-frame)", "drives: 'P(crank-frame)' is not one of the joints"),
    ("a strange space", 'source = "test"', 'source = "test"\nspace = "flat"', "space: "),
    ("one language only", 'name.de = "Viergelenk"', "", "de"),
    ("a strange point", "[claims]", '[points]\ntip = "Spitze"\n\n[claims]', "points: there is no point 'tip'"),
    ("a link without joint", 'rocker = "Schwinge"', 'rocker = "Schwinge"\nextra = "Zusatz"', "'extra' has no joint"),
]


def test_the_good_file_is_good(tmp_path):
    path = tmp_path / "it.toml"
    path.write_text(GOOD, encoding="utf-8")
    assert check_entry(read_entry(path)).holds


@pytest.mark.parametrize(("right", "wrong", "words"), [m[1:] for m in TEN_MISTAKES], ids=[m[0] for m in TEN_MISTAKES])
def test_mistakes_one_by_one(tmp_path, right, wrong, words):
    path = tmp_path / "it.toml"
    assert right in GOOD
    path.write_text(GOOD.replace(right, wrong, 1), encoding="utf-8")
    with pytest.raises(CatalogError) as caught:
        read_entry(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert words in str(caught.value)
    assert "\n" not in str(caught.value).strip()


def test_a_wrong_claim_names_key_printed_and_derived(tmp_path):
    path = tmp_path / "it.toml"
    path.write_text(GOOD.replace("counted = 1", "counted = 2\nmobility = 2"), encoding="utf-8")
    checked = check_entry(read_entry(path), origin=str(path))
    assert [str(w) for w in checked.wrong] == [
        "claims.counted: printed 2, derived 1",
        "claims.reason: printed none, derived a mobility other than the generic one needs a reason",
    ]
    low = check_claims(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), Claims(mobility=0), id="x")
    assert str(low.wrong[0]) == "claims.mobility: printed 0, derived at least 1"


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(CatalogError, match=r"cannot be read"):
        read_entry(tmp_path / "none.toml")
    (tmp_path / "latin.toml").write_bytes(b'id = "\xe9"')
    with pytest.raises(CatalogError, match=r"not UTF-8"):
        read_entry(tmp_path / "latin.toml")
    (tmp_path / "big.toml").write_bytes(b"#" * 1_000_001)
    with pytest.raises(CatalogError, match=r"larger than"):
        read_entry(tmp_path / "big.toml")
    (tmp_path / "deep.toml").write_text("a = " + "[" * 5000 + "]" * 5000, encoding="utf-8")
    with pytest.raises(CatalogError):
        read_entry(tmp_path / "deep.toml")


def test_an_unknown_id_gets_the_nearest_ones():
    with pytest.raises(CatalogError, match=r"no entry 'vcom'; did you mean vcomp"):
        entry("vcom")
    with pytest.raises(CatalogError, match=r"'nope\.csv' is neither a file here nor a catalog entry"):
        entry("nope.csv")


def test_files_are_named_as_their_entries():
    for folder, records in (("machines", entries()), ("exercises", exercises())):
        assert {p.stem for p in (catalog_folder() / folder).iterdir()} == set(records)


# --- dimensions -------------------------------------------------------------------------------------

SIZED = [one for one in entries().values() if one.dimensions is not None]
ONE_DRIVE = [one for one in SIZED if len(one.linkage().mechanism.drives) < 2]  # of several: test_several_drives.py


def moved(id, path=None, rows=73, **options):
    """A machine over the range that its entry names, or a full turn."""
    record = entry(id)
    linkage = record.linkage()
    low, high = record.dimensions.range or (0, 360)
    path = np.linspace(low, high, rows) if path is None else np.asarray(path, float)
    turning = linkage.mechanism.drives[0].turning
    shares = [1 / (1 + k) for k in range(len(linkage.mechanism.drives))]
    return move(linkage, np.outer(np.radians(path) if turning else path, shares), **options)


@pytest.mark.parametrize("record", ONE_DRIVE, ids=lambda record: record.id)
def test_every_machine_with_dimensions_moves(record):
    motion = moved(record.id)
    assert motion.complete, motion.message()
    assert motion.closure_error < 1e-12
    output = motion.linkage.outputs[0] if motion.linkage.outputs else record.chain().links[-1]
    k = motion.linkage.mechanism.chain.index(output)
    assert (
        abs(motion.places[0, :, k] - motion.places[0, 0, k]).max() + abs(motion.turns[:, k] - motion.turns[0, k]).max()
        > 0.1
    )
    assert linkage_from_json(linkage_to_json(motion.linkage)) == motion.linkage


def test_dimensions_say_where_they_come_from():
    assert len(SIZED) >= 43
    printed = {record.id for record in SIZED if record.dimensions.source}
    assert printed == {
        "chebyshev",
        "conchoid",
        "crane",
        "crane_cyl",
        "crankrocker",
        "hoecken",
        "jansen",
        "klann",
        "kurbelschleife",
        "lambda",
        "mzc",
        "slidercrank",
        "strider",
        "watt_axle",
    }


POINTS = [
    # machine, drive in degrees, point, its place: REFERENCE B4 and B3
    ("conchoid", 60, "C", (87.265956, -27.662798)),
    ("conchoid", 240, "C", (68.571429, 7.423075)),
    ("lambda", 30, "C", (79.085955, 88.644959)),
    ("lambda", 270, "C", (0.0, 80.0)),
    ("watt_axle", 15, "F", (0.039364, 15.674591)),
    ("watt_axle", -35, "F", (-1.848841, -31.413059)),
    ("crane", 80, "C", (43.677859, 84.071616)),  # with horizontal and vertical exchanged: exercise 19 at 10 degrees
    ("crane", 60, "C", (79.907617, 84.250006)),
    ("mzc", 180, "K", (1.7777777777777777, 7.856742013183862)),
    ("mzc", 0, "K", (1.6501619827636897, 8.30793198338872)),
]


@pytest.mark.parametrize(("id", "drive", "name", "expected"), POINTS)
def test_coupler_points_of_the_reference(id, drive, name, expected):
    assert moved(id, [drive]).point(name)[0] == pytest.approx(expected, abs=6e-7)


def test_the_hood_is_a_double_rocker():
    """Neither link at the body turns fully, the lid does (Grashof, shortest link the coupler)."""
    linkage = entry("hood").linkage()
    assert [row.full for row in rotatability(linkage)] == [False, True, True, False]


def test_what_special_dimensions_give():
    assert abs(moved("scottrussell").point("C")[:, 0]).max() < 1e-12  # exactly straight
    assert abs(moved("garage_rail").point("bottom")[:, 0]).max() < 1e-12
    for id, link in (("toolbox", "tray"), ("hubpodium_par", "platform"), ("hubpodium", "platform"), ("wiper", "blade")):
        motion = moved(id)
        turned = motion.angle(link) - motion.angle(link)[0]
        assert abs(turned).max() < 1e-12, id  # guided without turning
    wheels = moved("loco2")
    assert abs(wheels.angle("wheel2") - wheels.drives[:, 0]).max() < 1e-12  # through both change points


def test_gears_of_the_catalog_turn_as_their_teeth_say():
    for id in ("diff", "diff2p"):
        motion = moved(id, speed=[[1.0, 0.5]])
        wanted = (30 * 1 + 60 * 0.5) / 90  # Willis: internal ring of 60, sun of 30 teeth
        assert abs(motion.angular("carrier") - wanted).max() < 1e-13, id
    for id, link, ratio in (
        ("geartrain", "gear2", -3 / 2),
        ("belt", "pulley2", 1 / 2),
        ("friction_forced", "wheel2", -2 / 3),
        ("friction_rigid", "wheel2", -2 / 3),
    ):
        motion = moved(id)
        assert abs(motion.angle(link) - ratio * motion.drives[:, 0]).max() < 1e-13, id
    guide = moved("winch_plane")
    assert abs(np.diff(guide.displacement("P(frame-rope_guide)")) - 30 * np.diff(guide.drives[:, 0])).max() < 1e-12


@pytest.mark.filterwarnings("ignore::gruebler.base.errors.UnitWarning")  # rows far apart
def test_cams_and_the_geneva_drive_of_the_catalog():
    valve, tappet = moved("cam", [0, 75, 150, 360]), moved("cam_roller", [0, 90, 150, 360])
    assert valve.displacement("P(frame-valve)") == pytest.approx([0, 8, 0, 0], abs=1e-12)
    assert tappet.displacement("P(frame-tappet)") == pytest.approx([0, 20, 20, 0], abs=1e-11)  # from the low dwell on
    cross = moved("geneva", [0, 45, 180, 360]).angle("cross")
    assert cross - cross[0] == pytest.approx([0, -np.pi / 4, -np.pi / 4, -np.pi / 2], abs=1e-13)


SIZES = """
[dimensions]
unit = "mm"
assumed = true
four_bar = { a = 25, b = 70, c = 40, d = 70 }
"""


@pytest.mark.parametrize(
    ("right", "wrong", "words"),
    [
        ("assumed = true", "", "dimensions: either assumed = true, or a source"),
        ("assumed = true", 'assumed = true\nsource = "page 3"', "dimensions: either assumed = true, or a source"),
        ("a = 25", "a = 0", "dimensions: four_bar: a must be positive, not 0.0"),
        ("a = 25", "a = 25, brnch = 1", "unknown key 'dimensions.four_bar.brnch'; did you mean 'branch'?"),
        ('unit = "mm"', "", "dimensions: the key 'unit' is missing"),
        ("four_bar", "places", "dimensions: places: 'a' is not one of the joints"),
        ('unit = "mm"', 'unit = "mm"\ndrive = "R(frame-crank)"', "dimensions.drive: for an entry without drives"),
        ('unit = "mm"', 'unit = "mm"\nrange = [0, nan]', "dimensions.range: expected two numbers"),
    ],
)
def test_mistakes_in_dimensions(tmp_path, right, wrong, words):
    path = tmp_path / "it.toml"
    path.write_text(GOOD + SIZES, encoding="utf-8")
    assert read_entry(path).linkage().length("crank", 0, 1) == 25
    path.write_text(GOOD + SIZES.replace(right, wrong, 1), encoding="utf-8")
    with pytest.raises(CatalogError) as caught:
        read_entry(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert words in str(caught.value)


def test_an_entry_without_dimensions_is_no_linkage():
    with pytest.raises(CatalogError, match=r"'tri' has no dimensions"):
        entry("tri").linkage()
