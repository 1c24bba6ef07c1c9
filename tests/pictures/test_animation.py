"""Animations: read back, every link is where the kinematics put it, and joints stay closed on the way between poses."""

from __future__ import annotations

import cmath
import math
from xml.etree import ElementTree

import numpy as np
import pytest

from gruebler import GrueblerError
from gruebler.base.errors import LinkageError
from gruebler.cli import animate
from gruebler.mechanics.fourbar import FourBar, SliderCrank
from gruebler.mechanics.linkages import Linkage
from gruebler.pictures.linkage.animation import animated_svg, scene
from gruebler.pictures.linkage.animation_page import animated_page
from gruebler.pictures.linkage.posed_linkage import posed_linkage
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entry
from tests.commands import arguments_of

SVG = "{http://www.w3.org/2000/svg}"
CRANK_ROCKER = FourBar(25, 70, 40, 70).linkage({"K": (35, 20)})


def groups(text):
    """Of every moving group: shifts and turns at the keys, and the centres of its circles."""
    for group in ElementTree.fromstring(text).iter(f"{SVG}g"):
        moves = {move.get("type"): move.get("values").split(";") for move in group.findall(f"{SVG}animateTransform")}
        if moves:
            shifts = [complex(*map(float, value.split())) for value in moves["translate"]]
            turns = [math.radians(float(value)) for value in moves["rotate"]]
            keys = max(len(shifts), len(turns))  # what stands still has two equal values
            circles = [complex(float(c.get("cx")), float(c.get("cy"))) for c in group.findall(f"{SVG}circle")]
            yield np.resize(shifts, keys), np.resize(turns, keys), circles


def between(values):
    """Keys and the middles between them, as a viewer interpolates."""
    return np.interp(np.arange(0, len(values) - 0.9, 0.5), np.arange(len(values)), values)


@pytest.mark.parametrize(
    ("linkage", "joints"),
    [
        (CRANK_ROCKER, ["R(crank-coupler)", "R(coupler-rocker)", "K"]),
        (SliderCrank(25, 70).linkage(), ["R(crank-coupler)"]),
    ],
)
def test_joints_are_where_the_kinematics_put_them(linkage, joints):
    stage = posed_linkage(linkage)
    wanted = [stage.path.complex_point(name) * stage.scale for name in joints]
    found = []
    for shifts, turns, circles in groups(animated_svg(linkage)):
        found += [np.conj(shifts + np.exp(1j * turns) * at) for at in circles]
    for path in wanted:
        assert min(np.abs(path - one).max() for one in found if len(one) == len(path)) < 0.25


def test_pins_hardly_move_in_the_links_between_two_keys():
    stage = posed_linkage(CRANK_ROCKER)
    moved = {}
    for link, length in {"crank": 25, "coupler": 70, "rocker": 40}.items():
        origin = stage.scale * stage.path.places[0, :, stage.lower.mechanism.chain.index(link)]
        (body,) = [
            (shifts, turns)
            for shifts, turns, circles in groups(animated_svg(CRANK_ROCKER))
            if not circles and np.abs(np.conj(shifts) - origin).max() < 0.1
        ]
        place = between(body[0].real) - 1j * between(body[0].imag)
        for arm in (0, length):
            moved[link, arm] = place + stage.scale * arm * np.exp(-1j * between(body[1]))
    assert np.abs(moved["crank", 25] - moved["coupler", 0]).max() < 0.4
    assert np.abs(moved["coupler", 70] - moved["rocker", 40]).max() < 0.4


def test_a_full_turn_ends_where_it_began():
    for shifts, turns, _ in groups(animated_svg(CRANK_ROCKER)):
        assert abs(shifts[0] - shifts[-1]) < 0.11
        assert abs(cmath.exp(1j * turns[0]) - cmath.exp(1j * turns[-1])) < 1e-3


def test_to_and_fro_within_limits():
    linkage = entry("watt_axle").linkage()
    text = animated_svg(linkage, between=(math.radians(-55), math.radians(29)), curves=["F"], seconds=3)
    assert "to and fro" in text
    assert 'dur="3s"' in text
    for shifts, turns, _ in groups(text):
        assert np.array_equal(shifts, shifts[::-1])
        assert np.array_equal(turns, turns[::-1])


def test_a_way_of_a_drive_in_its_unit_and_small_files():
    text = animated_svg(entry("loader").linkage(), between=(60.0, 88.0), lang="de")
    assert "hin und her" in text
    assert len(animated_svg(CRANK_ROCKER, curves=["K"])) < 12_000
    assert animated_svg(CRANK_ROCKER) == animated_svg(CRANK_ROCKER)
    assert "<script" not in animated_svg(FourBar(25, 70, 40, 70).linkage({"<script>": (35, 20)}), name="<script>")


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), float("inf")])
def test_a_time_is_positive(seconds):
    with pytest.raises(LinkageError, match="number of seconds"):
        animated_svg(CRANK_ROCKER, seconds=seconds)


def test_several_drives_are_refused():
    five = Linkage.from_drawing(
        Mechanism.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(0-4); drive=R(0-1); drive=R(0-4)"),
        {"R(0-1)": (0, 0), "R(1-2)": (-1, 2), "R(2-3)": (2, 4), "R(3-4)": (5, 2), "R(0-4)": (4, 0)},
    )
    with pytest.raises(LinkageError, match="one drive only"):
        animated_svg(five)


def test_the_command(capsys, tmp_path):
    assert animate.run(arguments_of("animate", "wiper")) == 0
    assert "<animateTransform" in capsys.readouterr().out
    assert animate.run(arguments_of("animate", "four-bar:25,70,40,70", out=tmp_path / "x.svg")) == 0
    assert (tmp_path / "x.svg").read_text("utf-8").startswith("<svg")
    assert animate.run(arguments_of("animate", "wiper", out=tmp_path / "x.html")) == 0
    assert (tmp_path / "x.html").read_text("utf-8").startswith("<!doctype html>")
    with pytest.raises(GrueblerError, match=r"end it with \.svg, \.html, \.gif, \.webp or \.png"):
        animate.run(arguments_of("animate", "wiper", out=tmp_path / "x.bmp"))


def test_a_path_of_several_drives():
    linkage = entry("pent").linkage()
    path = np.radians([[0, 0], [90, 180]])
    text = animated_svg(linkage, drives=path, curves=["R(3-4)"])
    assert "to and fro" in text
    shown = scene(linkage, drives=path)
    assert shown.posed.path.drives[[0, -1]] == pytest.approx(path)
    assert '"low": 0.0, "high": 90.0' in animated_page(linkage, drives=path)
    assert '"unit": " %"' in animated_page(linkage, drives=path[::-1])
    with pytest.raises(LinkageError, match="one drive only"):
        animated_svg(linkage)
