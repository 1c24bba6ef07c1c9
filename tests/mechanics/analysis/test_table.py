"""The table of a motion against closed forms and against the motion itself."""

import csv
import io
import sys

import numpy as np
import pytest

import gruebler as gr
from gruebler.base.errors import GrueblerError
from gruebler.mechanics.analysis import motion_table
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.kinematics import from_degrees, move

SIZE = SliderCrank(20, 50)


def table(**options):
    motion = move(SIZE.linkage(), from_degrees(0, 350, 10), speed=1.0, order=3)
    return motion_table(motion, points=["R(crank-coupler)"], **options)


def test_a_slider_crank_in_closed_form():
    """s = a cos φ + √(b² - a² sin² φ), s' = -a sin φ - a² sin φ cos φ / √(b² - a² sin² φ)."""
    found = table()
    phi = np.radians(found["R(frame-crank)"])
    root = np.sqrt(50**2 - (20 * np.sin(phi)) ** 2)
    assert found["slider"] == pytest.approx(20 * np.cos(phi) + root, rel=1e-12)
    slope = -20 * np.sin(phi) - 400 * np.sin(phi) * np.cos(phi) / root
    assert found["slider′"] == pytest.approx(slope, abs=1e-10)
    assert found["R(crank-coupler) x"] == pytest.approx(20 * np.cos(phi), abs=1e-12)
    assert found["R(crank-coupler) ax"] == pytest.approx(-20 * np.cos(phi), abs=1e-11)  # by the drive's angle


def test_rates_in_time_follow_from_those_by_the_drive():
    """v = s' ω, a = s'' ω² + s' α, j = s''' ω³ + 3 s'' ω α + s' q, as the closed form of the slider-crank has them."""
    w, a, q = 3.0, 2.0, -5.0
    found = table(rates=(w, a, q))
    judge = SIZE.motion(np.radians(found["R(frame-crank)"]), omega=w, alpha=a, jerk=q, branch="+").output
    for name, values in (("v", judge.velocity), ("a", judge.acceleration), ("j", judge.jerk)):
        assert found[f"{name} slider"] == pytest.approx(values, rel=1e-9, abs=1e-8)


def test_shape_units_and_language():
    motion = move(FourBar(25, 70, 40, 70).linkage(), from_degrees(0, 90, 30), speed=1.0)
    german = motion_table(motion, ["rocker"], transmission="rocker", lang="de")
    assert [column.header for column in german] == [
        "D(frame-crank) [°]",
        "rocker [°]",
        "rocker′",
        "rocker′′ [1/rad]",
        "Übertragungswinkel [°]",
    ]
    assert german.rows.shape == (len(german), 5) == (4, 5)
    assert german.rows[:, 1].tolist() == german["rocker"].tolist()
    # cos μ = (b² + c² - a² - d² + 2 a d cos φ) / 2 b c for the crank at 90 degrees, the acute angle
    cosine = (70**2 + 40**2 - 25**2 - 70**2) / (2 * 70 * 40)
    assert german["Übertragungswinkel"][-1] == pytest.approx(np.degrees(np.arccos(abs(cosine))))
    assert german.without(3).rows.tolist() == german.rows[3:].tolist()
    assert german.csv().splitlines()[0].startswith("D(frame-crank) [°],rocker [°],")


def test_an_unknown_column_is_answered_by_the_nearest():
    with pytest.raises(
        GrueblerError, match=r"no column 'slidr' \(did you mean 'slider'\?\); it has R\(frame-crank\), slider"
    ):
        table()["slidr"]


def test_a_motion_of_any_speed_has_the_same_derivatives_by_the_drive():
    """s' and s'' do not depend on velocity and acceleration of the drive, which change from row to row."""
    path = from_degrees(0, 350, 10)
    speed, acceleration = np.linspace(2.0, 5.0, len(path)), np.linspace(-1.0, 3.0, len(path))
    plain = move(SIZE.linkage(), path, speed=1.0).table()
    driven = move(SIZE.linkage(), path, speed=speed, acceleration=acceleration).table()
    for name in ("slider", "slider′", "slider′′"):
        assert driven[name] == pytest.approx(plain[name], rel=1e-12, abs=1e-9)
    judge = SIZE.motion(path, omega=speed, alpha=acceleration, branch="+").output
    assert driven["v slider"] == pytest.approx(judge.velocity, rel=1e-9, abs=1e-8)
    assert driven["a slider"] == pytest.approx(judge.acceleration, rel=1e-9, abs=1e-8)
    assert not {"v slider", "a slider"} & {column.name for column in plain}


def test_a_drive_that_rests_says_nothing_about_derivatives():
    table = move(SIZE.linkage(), [0.5, 1.0], speed=[0.0, 2.0]).table()
    assert np.isnan(table["slider′"]).tolist() == [True, False]
    assert table["v slider"][0] == 0


def test_rates_do_not_go_with_a_motion_of_another_speed():
    with pytest.raises(GrueblerError, match="solved for speed 1"):
        motion_table(move(SIZE.linkage(), [0.5], speed=2.0), rates=(1.0, 0.0, 0.0))


@pytest.mark.parametrize("lang", ["en", "de"])
def test_the_same_numbers_in_every_form(lang, tmp_path):
    """Structured array and CSV in two forms."""
    motion = move(FourBar(25, 70, 40, 70).linkage(), from_degrees(0, 90, 30), speed=1.0)
    table = motion.table(outputs=["rocker", "rocker"], points=["R(crank-coupler)"], transmission="rocker", lang=lang)
    array = table.structured()
    names = list(array.dtype.names)
    assert names[:3] == [f"{'R' if lang == 'en' else 'D'}(frame-crank) [°]", "rocker [°]", "rocker′"]
    assert "rocker [°] (2)" in names
    assert np.array_equal(np.column_stack([array[name] for name in names]), table.rows)
    with gr.write(table, tmp_path / "t.csv").open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert [float(row[1]) for row in rows] == table["rocker"].tolist()
    assert header[1] == "rocker [°]"
    content = gr.write(table, tmp_path / "s.csv", format_name="spreadsheet").read_bytes()
    assert content.startswith(b"\xef\xbb\xbf")
    header, *rows = csv.reader(io.StringIO(content.decode("utf-8-sig")), delimiter=";")
    assert [float(row[1].replace(",", ".")) for row in rows] == table["rocker"].tolist()
    assert header[-1] == names[-1]


def test_pandas_has_the_headers():
    pytest.importorskip("pandas")
    table = move(SIZE.linkage(), from_degrees(0, 90, 30), speed=1.0).table()
    frame = table.to_dataframe()
    assert list(frame.columns) == [column.header for column in table]
    assert frame["slider [mm]"].tolist() == table["slider"].tolist()


def test_a_frame_of_order_1_has_points_and_velocities():
    """A point on the crank at 20 mm and 3 rad/s has the velocity 60 (-sin, cos)."""
    pytest.importorskip("pandas")
    linkage = gr.FourBar(25, 70, 40, 70).linkage().with_points({"K": ("crank", 20, 0)})
    phi = np.array([0.2, 1.0, 2.5])
    frame = move(linkage, phi, speed=3.0, order=1).to_dataframe()
    np.testing.assert_allclose(frame[["K x [mm]", "K y [mm]"]], 20 * np.column_stack([np.cos(phi), np.sin(phi)]))
    velocities = frame[["K vx [mm/s]", "K vy [mm/s]"]]
    np.testing.assert_allclose(velocities, 60 * np.column_stack([-np.sin(phi), np.cos(phi)]))
    np.testing.assert_allclose(frame["ω rocker [rad/s]"], 3 * frame["rocker′"])
    assert not [name for name in frame.columns if "a" in name.split() or "′′" in name]


def test_parquet_keeps_names_and_units(tmp_path):
    pytest.importorskip("pyarrow")
    from pyarrow import parquet

    table = move(SIZE.linkage(), [0.5, 1.0], speed=[0.0, 2.0]).table()
    read = parquet.read_table(gr.write(table, tmp_path / "t.parquet"))
    assert read.column_names == [column.header for column in table]
    assert read["slider [mm]"].to_pylist() == table["slider"].tolist()
    assert read["slider′ [mm/rad]"].to_pylist() == [None, table["slider′"][1]]
    assert read.schema.field("slider [mm]").metadata == {b"name": b"slider", b"unit": b"mm"}


@pytest.mark.parametrize(
    ("method", "package"), [("to_dataframe", "pandas"), ("arrow", "pyarrow"), ("parquet", "pyarrow")]
)
def test_a_missing_package_is_one_sentence(method, package, monkeypatch):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(GrueblerError, match=f"needs? {package}: pip install"):
        getattr(move(SIZE.linkage(), [0.5]).table(), method)()


def test_a_motion_is_written_and_other_values_are_no_tables(tmp_path):
    motion = move(SIZE.linkage(), [0.5, 1.0])
    lines = gr.write(motion, tmp_path / "m.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "R(frame-crank) [°],slider [mm]"
    with pytest.raises(GrueblerError, match="holds motions and tables, not a Linkage"):
        gr.write(SIZE, tmp_path / "m.parquet")
    with pytest.raises(GrueblerError, match="a synthesis task"):
        gr.write(SIZE, tmp_path / "m.csv")
