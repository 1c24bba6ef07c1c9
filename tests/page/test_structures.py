"""The structure view tells higher pairs apart: gears, belts, cams, Geneva drives have pictures of their own."""

from gruebler.files import linkage_to_json
from gruebler.page.requests import answer
from gruebler.page.structures import structure_record
from gruebler.teaching.catalog import entries

MACHINES = ("geartrain", "belt", "cam", "geneva")


def test_pictures_of_higher_pairs_differ():
    linkages = {id: entries()[id].linkage() for id in MACHINES}
    same = "R(frame-a) R(frame-b) G(a-b); frame=frame; drive=R(frame-a)"
    bare = {structure_record(same, "en")["picture"]}
    pictures = set(bare)
    for linkage in linkages.values():
        asked = {"text": linkage.mechanism.text(), "document": linkage_to_json(linkage)}
        found = answer("structure", asked, "en", print)
        pictures.add(found["picture"])
        assert any(
            each["picture"] != structure_record(asked["text"], "en")["inversions"][0]["picture"]
            for each in found["inversions"]
        )
    assert len(pictures) == len(MACHINES) + 1


def test_a_linkage_of_another_chain_says_nothing():
    text = "R(0-1) R(1-2) G(2-0); frame=0; drive=R(0-1)"
    alone = structure_record(text, "en")
    assert structure_record(text, "en", linkage=entries()["geneva"].linkage())["picture"] == alone["picture"]
