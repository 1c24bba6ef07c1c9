"""Kinds of machines: what a machine has, not the words of its name."""

import pytest

from gruebler.teaching.catalog import entries, entry, kinds, loader
from gruebler.teaching.catalog.kinds import KINDS, machine_kinds
from gruebler.teaching.catalog.loader import Query, search

WITH_CYLINDERS = {"crane_cyl", "excavator", "gough", "hubpodium_blocks", "loader", "loader_full", "scissor2_cyl"}


def of_kind(kind: str) -> set[str]:
    return {id for id, machine in entries().items() if kind in machine_kinds(machine)}


def test_what_machines_have_is_found_once_for_all_searches(monkeypatch):
    search(Query(words=("crank",)))
    monkeypatch.setattr(kinds, "guided_links", None)  # nothing can be found any more
    monkeypatch.setattr(loader, "family", None)
    assert {each.id for each in search(Query(words=("hydraulic",)))} == WITH_CYLINDERS


def test_machines_that_are_called_gears_or_level_have_none():
    """The valve gears, the level-luffing crane, the summing lever "like a differential gear", friction wheels."""
    assert of_kind("gear") == {
        "geartrain", "elliptic_gears", "diff", "diff2p", "diff_bevel", "diff_bevel2p",
        "winch_plane",  # a pinion and its rack
    }  # fmt: skip
    assert of_kind("belt") == {"belt"}


def test_machines_whose_slides_have_other_names_are_sliders():
    """The ram and the block of the Whitworth drive, the piston rod of Walschaerts' gear, the runner of the umbrella."""
    assert {"whitworth", "walschaerts_gear", "umbrella", "slidercrank", "winch_screw"} <= of_kind("slider")
    assert not {"crankrocker", "scissor2", "cam_rocker"} & of_kind("slider")


def test_cams_are_discs_with_a_follower():
    assert of_kind("cam") == {"cam", "cam_roller", "cam_rocker", "cam_rocker_flat"}


def test_cranks_turn_about_a_bearing_of_the_frame():
    assert {"crankrocker", "whitworth", "loco2", "wiper_rssr", "vcomp"} <= of_kind("crank")
    assert not {"loader", "loader_full", "crane", "geartrain"} & of_kind("crank")  # a bell crank swings


def test_straight_lines_are_paths_of_points_that_no_slide_guides():
    assert {"watt_engine", "peaucellier", "sarrus", "scottrussell"} <= of_kind("straight")
    assert not {"vcomp", "diff_lever", "toggle_press", "stephenson_gear"} & of_kind("straight")


def test_machines_in_space_are_those_that_have_a_page_of_their_own():
    assert of_kind("space") == {id for id, machine in entries().items() if machine.in_space}


@pytest.mark.parametrize("word", ["hydraulic", "Hydraulik", "hydraulisch"])
def test_a_search_for_hydraulics_finds_what_cylinders_drive(word):
    assert of_kind("cylinder") == WITH_CYLINDERS
    assert {machine.id for machine in search(Query(words=(word,)))} == WITH_CYLINDERS


@pytest.mark.parametrize("word", ["cylinder", "Zylinder"])
def test_a_search_for_cylinders_finds_them_all(word):
    assert {machine.id for machine in search(Query(words=(word,)))} >= WITH_CYLINDERS


@pytest.mark.parametrize(("word", "kind"), [("gears", "gear"), ("Zahnräder", "gear"), ("Schieber", "slider")])
def test_the_words_of_a_kind_find_its_machines(word, kind):
    assert {machine.id for machine in search(Query(words=(word,)))} >= of_kind(kind)


def test_each_kind_has_a_machine_and_words_in_both_languages():
    for kind, (words, _) in KINDS.items():
        assert of_kind(kind)
        assert words.in_language("en") != words.in_language("de")
    assert machine_kinds(entry("tri")) == ()
