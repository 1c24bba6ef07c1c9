"""`gruebler analyse --poles --curvature`."""

import numpy as np
import pytest

from gruebler.files.linkages import write_linkage
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.geometry.columns import curvature_columns
from gruebler.mechanics.kinematics import move
from gruebler.mechanics.linkages import Linkage, LinkPoint
from gruebler.structure.mechanism import Mechanism
from tests.cli.test_analyse import CRANK_ROCKER, run, table


def test_poles_of_all_pairs_as_a_list(capsys):
    # the polygon of velocities at 55 degrees (documents 000/003, four-bar 25, 70, 40, 70)
    status, out, err = run(capsys, CRANK_ROCKER, "--at", "55", "--poles")
    assert (status, err) == (0, "")
    told = [line.split() for line in out.splitlines()]
    assert ["frame/coupler", "127.802871,", "182.521416"] in told
    assert ["crank/rocker", "-64.233472,", "0.000000"] in told
    assert sum(line[0].count("/") == 1 and len(line) == 3 for line in told if line) == 6


def test_a_pole_at_infinity_is_a_direction(capsys):
    status, out, _ = run(capsys, "slider-crank:25,70", "--at", "90", "--poles")
    assert status == 0
    assert "frame/coupler   at infinity, direction 90°" in out
    assert "frame/slider    at infinity, direction 90°" in out
    _, out, _ = run(capsys, "slider-crank:25,70", "--at", "0", "--poles", "--lang", "de")
    assert "keiner: gegeneinander in Ruhe" in out


def test_poles_as_columns(capsys):
    _, found = table(capsys, "slider-crank:25,70", "--range", "45:90:45", "--poles")
    assert found["pole frame/coupler x mm"][0] == pytest.approx(17.67766952966369 + 4587.5**0.5)
    assert found["pole frame/coupler y mm"] == [pytest.approx(85.408755450384), None]
    assert found["pole frame/coupler direction °"] == [None, pytest.approx(90)]


def test_curvature_of_points_and_inflection_circles(capsys):
    """The rocker's joint goes round B0; two ways to the centre of curvature meet in the columns' numbers."""
    _, found = table(capsys, CRANK_ROCKER, "--at", "55", "--curvature", "--point", "R(coupler-rocker)")
    assert abs(found["R(coupler-rocker) radius of curvature mm"][0]) == pytest.approx(40)
    assert found["R(coupler-rocker) centre of curvature x mm"] == [pytest.approx(70)]
    assert found["R(coupler-rocker) centre of curvature y mm"] == [pytest.approx(0, abs=1e-9)]
    assert found["inflection circle rocker mm"] == [pytest.approx(0, abs=1e-9)]
    _, found = table(capsys, "slider-crank:1,1.5", "--at", "0", "--curvature", "--point", "R(crank-coupler)")
    # E at the dead centre: pole in B, A runs on the circle r = 1, so PA^2 = AW AA0 gives D = b (1 + b/a)
    assert found["inflection circle coupler mm"] == [pytest.approx(1.5 * 2.5)]
    assert "inflection circle slider mm" not in found


def test_inflection_circles_of_all_floating_links(capsys):
    """Without a point those of the links that have no joint with the frame; a rocker's, a point, is left out."""
    _, found = table(capsys, CRANK_ROCKER, "--at", "55", "--curvature")
    assert [name for name in found if "inflection" in name] == ["inflection circle coupler mm"]
    motion = move(FourBar(25, 70, 40, 70).linkage(), np.radians([55.0]), order=2)
    made = curvature_columns(motion, [LinkPoint("coupler", 45.0, 40.0)])
    assert made[0].name == "coupler:45,40 radius of curvature"
    assert made[-1].values == pytest.approx(found["inflection circle coupler mm"])


def test_a_straight_path_has_no_centre(capsys):
    _, out, _ = run(capsys, "slider-crank:25,70", "--at", "60", "--curvature", "--point", "R(coupler-slider)")
    assert "∞" in out


def test_several_drives(capsys, tmp_path):
    mechanism = Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); frame=0; drive=R(0-1); drive=R(0-4)")
    places = {0: (0, 0), 1: (0, 2), 2: (2, 4), 3: (4, 2), 4: (4, 0)}
    write_linkage(tmp_path / "five.toml", Linkage.from_drawing(mechanism, places))
    status, _, err = run(capsys, str(tmp_path / "five.toml"), "--at", "90,90", "--poles")
    assert status == 2
    assert "--poles, --curvature and --planes need a linkage with one drive" in err
