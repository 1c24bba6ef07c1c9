"""The table of a motion against closed forms and against the motion itself."""

import numpy as np
import pytest

from gruebler.analysis import motion_table
from gruebler.errors import GrueblerError
from gruebler.fourbar import FourBar, SliderCrank
from gruebler.kinematics import from_degrees, move

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
    judge = SIZE.motion(np.radians(found["R(frame-crank)"]), omega=w, alpha=a, jerk=q, branch=1).output
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
