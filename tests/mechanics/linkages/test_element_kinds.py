"""Kinds of elements: every table has a row for each; `tests/test_kinds.py` sees to it that no other code asks."""

import inspect
from dataclasses import replace

import pytest

from gruebler.base.errors import LinkageError
from gruebler.files.element_records import FORMS, ElementRecord, read_element_table, write_element
from gruebler.mechanics.kinematics.contacts import CONTACT_MOTIONS
from gruebler.mechanics.linkages import elements
from gruebler.mechanics.linkages.contacts import CONTACTS
from gruebler.mechanics.linkages.elements import (
    INVERSE,
    CamDisc,
    Circle,
    Element,
    GenevaDriver,
    GenevaWheel,
    Line,
    NonCircular,
    Pin,
    Wheel,
    read_element,
)
from gruebler.pictures.canvas.contacts import CONTACTS as SIGNS
from gruebler.pictures.linkage.element_pictures import PICTURES
from gruebler.structure.chain.pairs import PAIRS

KINDS = {
    each for each in vars(elements).values() if inspect.isclass(each) and issubclass(each, Element) and each != Element
}
SAMPLES = [
    Pin(1.0, 2.0),
    Line(1.0, 2.0, 0.5),
    Wheel(1.0, 2.0, -30.0, teeth=-60),
    Wheel(1.0, 2.0, 30.0, belt="crossed"),
    Circle(1.0, 2.0, 5.0),
    CamDisc(1.0, 2.0, 0.5, lift="rise 10 180; fall 10 180", base=30.0, roller=4.0, offset=3.0, arm=50.0, distance=60.0),
    CamDisc(1.0, 2.0, 0.5, lift="rise 10 180; fall 10 180", base=30.0, flat=True, scale=2.0, face=3.0),
    GenevaDriver(1.0, 2.0, 0.5, 2),
    GenevaWheel(1.0, 2.0, 0.5, slots=5, internal=True),
    NonCircular(1.0, 2.0, 0.5, transfer="ellipse 0.5", teeth=30),
    NonCircular(1.0, 2.0, 0.5, transfer=INVERSE, teeth=30),
]


def test_every_kind_has_its_rows():
    assert {type(sample) for sample in SAMPLES} == KINDS
    assert {*FORMS} == KINDS
    assert {*PICTURES} == KINDS
    assert {kind for row in CONTACTS for kind in row.kinds} == KINDS
    assert {kind for kind in KINDS if kind.form == "round"} == {kind for kind in KINDS if PICTURES[kind].part}
    assert {kind for kind in KINDS if kind.form == "round"} == {kind for kind in KINDS if FORMS[kind].read}


def test_every_contact_has_its_motion():
    touching = {row.kinds for row in CONTACTS if any(kind.form == "round" for kind in row.kinds)}
    assert {*CONTACT_MOTIONS} == touching
    assert len({frozenset(row.kinds) for row in CONTACTS}) == len(CONTACTS)
    assert {name for row in CONTACTS for name in row.pairs} <= {pair.name for pair in PAIRS}


def test_every_key_of_a_file_belongs_to_a_kind():
    keys = {key for form in FORMS.values() for key in form.keys}
    assert {"at", *keys} == {*ElementRecord.__struct_fields__}
    first = [form.keys[0] for form in FORMS.values() if form.keys]
    assert len({*first}) == len(first)


@pytest.mark.parametrize("sample", SAMPLES, ids=repr)
def test_what_a_kind_says_of_its_numbers(sample):
    assert type(sample).__dataclass_params__.frozen
    assert sample.placed(*sample.place) == sample == sample.checked("here") == read_element(sample, "here")
    assert sample.placed(7.0, 8.0, 0.25).place == (7.0, 8.0, 0.25)[: len(sample.place)]
    assert sample.direction == (0.5 if len(sample.place) == 3 else 0.0)
    assert sample.scaled(2.0).place == (2.0, 4.0, 0.5)[: len(sample.place)]
    assert sample.scaled(2.0).scaled(0.5) == sample
    with pytest.raises(LinkageError, match="here"):
        replace(sample, y=float("nan")).checked("here")


@pytest.mark.parametrize("sample", SAMPLES, ids=repr)
def test_what_is_written_is_read_again(sample):
    written = write_element(sample)
    if isinstance(written, list):
        assert written == [1.0, 2.0, pytest.approx(28.64788975654116)][: len(sample.place)]
    else:
        assert read_element_table(written, "here") == sample


@pytest.mark.parametrize("sample", SAMPLES, ids=repr)
def test_every_contact_has_a_sign(sample):
    for kinds in (row.kinds for row in CONTACTS if type(sample) in row.kinds and "roll_slide" in row.pairs):
        other = kinds[1 - kinds.index(type(sample))]
        for partner in (each for each in SAMPLES if type(each) is other):
            assert PICTURES[type(sample)].sign(sample, partner, False) in SIGNS


def test_scaling_and_mirroring_by_hand():
    assert Wheel(1, 2, 3, teeth=20).scaled(2) == Wheel(2, 4, 6, teeth=20)
    assert CamDisc(1, 2, 0.5, lift="rise 10 360", base=30).scaled(2) == CamDisc(
        2, 4, 0.5, lift="rise 10 360", base=30, scale=2
    )
    assert Line(1, 2, 0.5).mirrored() == Line(1, -2, -0.5)
    assert Circle(1, 2, 3).mirrored() == Circle(1, -2, 3)
    assert GenevaWheel(1, 2, 0.5, slots=4).mirrored() == GenevaWheel(1, -2, -0.5, slots=4)
    for one_sided in (
        CamDisc(1, 2, 0.5, lift="rise 10 360", base=30),
        NonCircular(1, 2, 0.5, transfer="rise 20 180; fall 20 180"),
    ):
        with pytest.raises(LinkageError, match="mirror image"):
            one_sided.mirrored()
    assert NonCircular(1, 2, 0.5, transfer="ellipse 0.5").mirrored() == NonCircular(1, -2, -0.5, transfer="ellipse 0.5")


def test_a_key_without_a_value_is_not_given():
    with pytest.raises(LinkageError, match="circle: does not go with a wheel"):
        read_element_table({"at": [0, 0], "circle": None}, "here")
