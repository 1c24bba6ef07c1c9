"""Searching by access features: the sheet of seed 001, known counts, and a brute force against the enumeration."""

from collections import Counter
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gruebler import GrueblerError
from gruebler.structure.assur import decompose
from gruebler.structure.atlas import open as open_atlas
from gruebler.structure.chain.pairs import pair
from gruebler.structure.enumeration import count_chains
from gruebler.structure.isomorphism import symmetry
from gruebler.structure.mechanism.inversion import inversions
from gruebler.structure.type_synthesis import JointRequirement, Requirements, typed_chains, variants
from gruebler.teaching.catalog import entries
from gruebler.teaching.catalog.feature_query import (
    FeatureQuery,
    entry_features,
    entry_mechanism,
    features_to_json,
    read_pairs,
    structures,
)
from gruebler.teaching.catalog.features import access_features


def number(**features):
    return sum(1 for _ in structures(FeatureQuery(**features)))


def test_the_collection_sheet_001():
    """1 drive joint (1 at the frame), 1 output link (0 at the frame), 4 links (4 binary), 4 joints (4 D)."""
    query = FeatureQuery(
        links=4,
        drive_joints=1,
        drive_joints_at_frame=1,
        output_links=1,
        output_links_at_frame=0,
        pairs=read_pairs("D:4"),
        kinds=((2, 4),),
    )
    found = {one.id for one in entries().values() if query.fits(entry_mechanism(one), entry_features(one))}
    assert {"mzc", "lambda", "kneader", "crane"} <= found
    assert not found & {"crankrocker", "quad", "wiper", "conchoid"}  # output at the frame, none, more links, a slide
    (only,) = structures(query)
    assert only.output == "2"


# Inversions: Mruthyunjaya, Mechanism and Machine Theory 38 (2003); driven mechanisms counted by another road.
@pytest.mark.parametrize(("links", "chains", "frames"), [(4, 1, 1), (6, 2, 5), (8, 16, 71), (10, 230, 1834)])
def test_known_counts(links, chains, frames):
    assert number(links=links) == frames
    found = count_chains(links, orbits=True)
    assert (found.chains, found.inversions) == (chains, frames)
    if links < 10:
        assert number(links=links, drive_joints=1, drive_joints_at_frame=1) == found.drives


def test_against_the_variants():
    """Two roads to one number, with slides, contacts, outputs."""
    drive = (JointRequirement.parse("@frame"),)
    for features, wanted in (
        ({"pairs": read_pairs("S:1")}, Requirements(6, prismatic=1, drives=drive)),
        ({"pairs": read_pairs("P:2"), "output_links_at_frame": 0},
         Requirements(6, prismatic=2, drives=drive, output=JointRequirement.parse("@moving"))),
        ({"links": 5, "pairs": read_pairs("G:1")}, Requirements(5, roll_slide=1, drives=drive)),
        ({"multiple_joints": 1}, Requirements(6, multiple_joints=1, drives=drive)),
    ):  # fmt: skip
        asked = {"links": 6, "drive_joints": 1, "drive_joints_at_frame": 1} | features
        assert number(**asked) == sum(1 for _ in variants(wanted)) > 0


@pytest.mark.parametrize(
    "features",
    [
        {"links": 8},
        {"links": 8, "drive_joints": 1, "drive_joints_at_frame": 1},
        {"links": 6, "drive_joints": 1},
        {"links": 6, "drive_joints": 1, "drive_joints_at_frame": 1, "output_links_at_frame": 0},
        {"links": 7, "mobility": 2, "drive_joints": 2},
        {"links": 8, "kinds": ((2, 4), (3, 4))},
    ],
    ids=str,
)
def test_an_atlas_has_the_same_structures(features):
    pytest.importorskip("duckdb")
    atlas = open_atlas()
    query = FeatureQuery(**features)

    def codes(found):
        outputs = [() if driven.output is None else (driven.output,) for driven in found]
        return Counter(
            (driven.mechanism.code(), access_features(driven.mechanism, chosen))
            for driven, chosen in zip(found, outputs, strict=True)
        )

    known = codes(list(structures(query)))
    assert known
    assert codes(list(structures(query, atlas))) == known
    assert codes(list(structures(query, atlas, "true"))) == known


def test_conditions_on_columns_are_what_the_mechanisms_have():
    pytest.importorskip("duckdb")
    query = FeatureQuery(links=8, drive_joints=1, drive_joints_at_frame=1)
    dyads = [
        driven.mechanism.code()
        for driven in structures(query)
        if all(len(group.bodies) == 2 for group in decompose(driven.mechanism).groups)
        and symmetry(driven.mechanism.chain).order == 2
    ]
    found = structures(query, open_atlas(), "dyads_only and group_order = 2 -- a remark")
    assert sorted(driven.mechanism.code() for driven in found) == sorted(dyads)
    assert dyads


@pytest.mark.parametrize(
    ("features", "words"),
    [
        ({"links": 11, "mobility": 2}, "does not have all these chains"),
        ({"links": 6, "multiple_joints": 1}, "does not have all these chains"),
        ({"links": 6, "pairs": read_pairs("S:1")}, "does not have all these chains"),
        ({"links": 5, "pairs": read_pairs("G:1")}, "does not have all these chains"),
    ],
)
def test_an_atlas_without_these_chains_is_refused(features, words):
    pytest.importorskip("duckdb")
    with pytest.raises(GrueblerError, match=words):
        list(structures(FeatureQuery(**features), open_atlas()))
    with pytest.raises(GrueblerError, match="needs an atlas"):
        structures(FeatureQuery(**features), where="planar")


@cache
def everything():
    """All mechanisms with 3 to 6 links, F = 1, up to two slides and one contact: brute force."""
    return [
        (mechanism, access_features(mechanism))
        for links in range(3, 7)
        for slides in range(3)
        for contacts in range(2)
        for chain in typed_chains(Requirements(links, prismatic=slides, roll_slide=contacts))
        for mechanism in inversions(chain)
    ]


counts = st.none() | st.integers(0, 6)


@settings(max_examples=120)
@given(
    links=st.integers(3, 6),
    slides=st.integers(0, 2),
    contacts=st.integers(0, 1),
    turning=counts,
    kinds=st.dictionaries(st.integers(2, 4), st.integers(0, 6), max_size=3),
)
def test_what_is_refused_does_not_exist(links, slides, contacts, turning, kinds):
    """A contradiction is told only where nothing fits, and what is found is everything that fits."""
    pairs = {pair("prismatic"): slides, pair("roll_slide"): contacts}
    if turning is not None:
        pairs[pair("revolute")] = turning
    wanted = {"links": links, "pairs": tuple(pairs.items()), "kinds": tuple(kinds.items())}
    try:
        query = FeatureQuery(**wanted)
        found = [one.mechanism for one in structures(query)]
    except GrueblerError:
        found = []
    told = FeatureQuery(links=links, pairs=wanted["pairs"])
    fitting = [
        mechanism
        for mechanism, features in everything()
        if told.fits(mechanism, features)
        and all(dict(features.links_by_joints).get(k, 0) == n for k, n in kinds.items())
    ]
    assert sorted(m.code() for m in found) == sorted(m.code() for m in fitting)


@pytest.mark.parametrize(
    ("features", "words"),
    [
        ({"drive_joints": 1, "drive_joints_at_frame": 2}, "1 drive joints cannot be 2 at the frame"),
        ({"output_links": 0, "output_links_at_frame": 1}, "0 output links cannot be 1 at the frame"),
        ({"links": 4, "kinds": ((2, 4), (3, 1))}, "those are 5"),
        ({"links": -1}, "0 or more"),
        ({"kinds": ((2, -1),)}, "0 or more"),
    ],
)
def test_contradictions_at_once(features, words):
    with pytest.raises(GrueblerError, match=words):
        FeatureQuery(**features)


@pytest.mark.parametrize(
    ("features", "words"),
    [
        ({}, "number of links is needed"),
        ({"links": 5}, "2 g1 \\+ g2 = 11, which no g1 gives"),
        ({"links": 6, "pairs": read_pairs("D:5")}, "g1 = 7, but 5 .*: name the kinds of the other 2"),
        ({"links": 4, "pairs": read_pairs("D:4,S:1")}, "g1 = 4, but 5"),
        ({"links": 6, "kinds": ((2, 5), (3, 1))}, "13 joint elements, but 6 links take 7 joints, so 2 g = 14"),
        ({"links": 6, "kinds": ((4, 2),)}, "2 quaternary links and 4 more with at least 2 joints have 16"),
        ({"links": 6, "kinds": ((2, 3), (4, 1))}, "2 more with at least 3 joints have 16"),
        ({"links": 6, "mobility": -1}, "F = -1"),
        ({"links": 6, "drive_joints": 2}, "mobility 1 needs as many drives"),
        ({"links": 6, "drive_joints_at_frame": 2}, "2 are too many"),
        ({"links": 6, "output_links": 2}, "one output link at most"),
        ({"links": 6, "drive_joints": 0, "output_links": 1}, "an output link takes a drive"),
        ({"links": 6, "pairs": read_pairs("D3:1")}, "not with spherical"),
        ({"links": 2, "mobility": 3}, "from 3 links"),
    ],
)  # fmt: skip
def test_contradictions_of_structures(features, words):
    with pytest.raises(GrueblerError, match=words):
        next(structures(FeatureQuery(**features)))


def test_reading_pairs():
    assert read_pairs("D:4,S:0") == read_pairs("R:4, P:0") == ((pair("revolute"), 4), (pair("prismatic"), 0))
    assert read_pairs("helical:1") == ((pair("helical"), 1),)
    for text, words in (("D", "expected joints with their numbers"), ("D:x", "D:x"), ("D:1,D:2", "twice"), ("", "R:4")):
        with pytest.raises(GrueblerError, match=words):
            read_pairs(text)


def test_at_the_frame_means_that_there_is_one():
    query = FeatureQuery(output_links_at_frame=0, drive_joints_at_frame=0)
    found = {one.id for one in entries().values() if query.fits(entry_mechanism(one), entry_features(one))}
    assert "loader_full" in found
    assert not found & {"quad", "steering", "crankrocker"}


def test_features_as_data():
    document = features_to_json(entry_features(entries()["vcomp"]))
    assert document["joints_by_pair"] == {"revolute": 5, "prismatic": 2}
    assert document["links_by_joints"] == {"2": 5, "3": 1}
