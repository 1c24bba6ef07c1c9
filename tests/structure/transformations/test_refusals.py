"""Where a transformation is not possible, one sentence says why."""

import pytest

from gruebler import Chain, GrueblerError
from gruebler.base.errors import NotationError, TransformationError
from gruebler.structure.transformations import (
    OPERATIONS,
    Derivation,
    contract,
    expand,
    extend,
    insert_coupler,
    insert_dyad,
    insert_group,
    remove_coupler,
    remove_dyad,
    remove_group,
    replace_roll_slide,
    replay,
    restore_roll_slide,
)
from gruebler.structure.transformations.dyads import coupler_at, dyad_at

FOUR_BAR = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")
WATT = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)")
BRACED = Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-1)")
GEARS = Chain.parse("R(0-1) R(0-2) G(1-2)")
SPATIAL = Chain.parse("spatial: R(0-1) R(1-2) R(2-0)")


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: insert_dyad(FOUR_BAR, "PPP", ["0", "1"]), "forms are RRR"),
        (lambda: insert_dyad(FOUR_BAR, "RR", ["0", "1"]), "expected 3 letters"),
        (lambda: insert_dyad(FOUR_BAR, "RGR", ["0", "1"]), "each R, P or W"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", ["0", "0"]), "all lie on the link '0'"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", ["0", 0]), "all lie on the link '0'"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", [1, 1]), "same joint"),
        (lambda: insert_dyad(FOUR_BAR, "PRR", [0, "3"]), "no further link can join R"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", [9, "3"]), "joints 0 to 3"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", ["0", "7"]), "no link '7'"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", ["0"]), "two places"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", "01"), "two places"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", ["0", "2"], ["3", "4"]), "a link '3' already"),
        (lambda: insert_dyad(FOUR_BAR, "RRR", ["0", "2"], ["4"]), "2 different names"),
        (lambda: insert_dyad(SPATIAL, "RRR", ["0", "1"]), "this chain is spatial"),
        (lambda: remove_dyad(WATT, ["0", "2"]), "2 cannot belong to a dyad: it carries 3 joints"),
        (lambda: remove_dyad(WATT, ["0", "4"]), "share just one joint"),
        (lambda: remove_dyad(WATT, ["0"]), "two links, not 1"),
        (lambda: remove_dyad(FOUR_BAR, ["0", "1"]), "at least three links"),
        (lambda: remove_dyad(GEARS, ["1", "2"]), "these joints are revolute, roll_slide, revolute"),
        (lambda: remove_dyad(Chain.parse("R(0-1) R(1-2) R(2-0) R(0-3) R(3-4) R(4-0)"), ["1", "2"]), "are on '0'"),
        (lambda: insert_coupler(FOUR_BAR, ["0", "2"], "RG"), "form of a coupler"),
        (lambda: insert_coupler(FOUR_BAR, ["1", "1"]), "all lie on the link '1'"),
        (lambda: remove_coupler(WATT, "2"), "carries 3 joints"),
        (lambda: remove_coupler(GEARS, "1"), "one freedom each, and they are revolute and roll_slide"),
        (lambda: remove_coupler(Chain.parse("R(0-1) R(0-1) R(1-2) R(2-0)"), "9"), "no link '9'"),
        (lambda: insert_group(FOUR_BAR, "RRR", ["0"]), "2 outer joints; 1 places were given"),
        (lambda: insert_group(FOUR_BAR, "RRR", ["0", "0"]), "rigid against it"),
        (lambda: insert_group(FOUR_BAR, "PPP", ["0", "1"]), "PPP"),
        (lambda: remove_group(WATT, ["2", "3"]), "not an Assur group"),
        (lambda: remove_group(WATT, ["0", "4"]), "not an Assur group"),
        (lambda: remove_group(WATT, []), "each once"),
        (lambda: remove_group(WATT, list(WATT.links)), "all the links"),
        (lambda: remove_group(Chain.parse("R(0-1) R(1-2) R(2-0) R(0-3) R(3-4) R(4-0)"), ["1", "2"]), "'0' alone"),
        (lambda: contract(FOUR_BAR, 7), "joints 0 to 3"),
        (lambda: contract(Chain.parse("R(0-1) R(0-1) R(1-2) R(2-3)"), 0), r"they meet in R\(0-1\) too"),
        (lambda: contract(Chain.parse("R(0-1-2) R(1-3) R(2-3)"), 0), "which two links"),
        (lambda: contract(FOUR_BAR, 0, ["0", "2"]), "which two links"),
        (lambda: contract(Chain.parse("R(0-1) R(1-2) R(2-0)"), 0), "at least three links"),
        (lambda: expand(FOUR_BAR, "0", [1]), "not one of 0's"),
        (lambda: expand(FOUR_BAR, "0", [0], at=0), "does not move"),
        (lambda: expand(FOUR_BAR, "0", [0], at=3, pair="revolute"), "joined by a new joint"),
        (lambda: expand(FOUR_BAR, "0", [0], pair="revolut"), "did you mean 'revolute'"),
        (lambda: replace_roll_slide(FOUR_BAR, 0), "not a roll-slide joint"),
        (lambda: replace_roll_slide(GEARS, 2, "PP"), "RR, RP or PR"),
        (lambda: restore_roll_slide(WATT, "2"), "must be a binary link"),
        (lambda: restore_roll_slide(Chain.parse("R(0-1) R(1-2) R(0-1) R(2-3) R(3-0) P(3-4) P(4-0)"), "4"), "must be"),
        (lambda: restore_roll_slide(Chain.parse("R(0-1) R(1-0) R(0-2) R(2-3)"), "1"), "both its joints are on '0'"),
        (lambda: extend(FOUR_BAR), "a dyad of some form, or a coupler"),
        (lambda: extend(FOUR_BAR, dyad="RRR", coupler="RR"), "a dyad of some form, or a coupler"),
        (lambda: extend(FOUR_BAR, dyad="XYZ"), "expected 3 letters"),
        (lambda: extend(SPATIAL, coupler="RR"), "spatial"),
        (lambda: replay(FOUR_BAR, "insert_triad", {}), "there is no transformation 'insert_triad'"),
        (lambda: replay(FOUR_BAR, "insert_dyad", {"form": "RRR"}), "does not fit"),
        (lambda: replay(FOUR_BAR, "insert_dyad", {"form": "RRR", "between": 5}), "does not fit"),
        (lambda: Derivation(FOUR_BAR).then("insert_dyad", form="RRR", between=["0", "2"], size=3), "does not fit"),
    ],
)
def test_one_sentence(call, words):
    with pytest.raises(GrueblerError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "document",
    [
        "{",
        "[]",
        {"start": FOUR_BAR.to_json()},
        {"start": FOUR_BAR.to_json(), "steps": [{"kind": "contract"}]},
        {"start": FOUR_BAR.to_json(), "steps": [{"kind": 3, "where": {}}]},
        {"start": FOUR_BAR.to_json(), "steps": [], "end": 0},
    ],
)
def test_what_is_no_derivation(document):
    with pytest.raises(NotationError, match=r"^[^\n]+$"):
        Derivation.from_json(document)


def test_a_document_that_says_another_result_is_refused():
    way = Derivation(FOUR_BAR).then("insert_dyad", form="RRR", between=["0", "2"])
    document = way.to_json()
    document["steps"][0]["result"] = str(WATT)
    with pytest.raises(TransformationError, match=r"but the document says"):
        Derivation.from_json(document)
    with pytest.raises(TransformationError, match=r"step 1 starts from"):
        Derivation(WATT, way.steps)


def test_every_operation_is_named_like_its_function():
    assert all(function.__name__ == name for name, function in OPERATIONS.items())
    assert len(OPERATIONS) == 10


def test_braced_four_bar_loses_its_brace():
    assert remove_coupler(BRACED, "4").chain == FOUR_BAR


def test_ends_on_one_link_are_refused_in_the_words_of_what_was_asked():
    with pytest.raises(TransformationError, match="1 and 2 are not a dyad between different links: both ends are on"):
        dyad_at(Chain.parse("R(0-1) R(1-2) R(2-0)"), ("1", "2"))
    with pytest.raises(TransformationError, match="1 is not a coupler between different links: both ends are on"):
        coupler_at(Chain.parse("R(0-1) R(1-0) R(0-2)"), "1")
