"""Whatever file holds chains, linkages or entries, its structures come out with name and place."""

import json

import pytest

from gruebler.base.errors import CatalogError, NotationError
from gruebler.files import Entry, linkage_to_json, write_linkage
from gruebler.files.screws import screws_to_json
from gruebler.files.structures import chain_of_text, is_structure_text, read_structures, structures_of_json
from gruebler.mechanics.fourbar import FourBar
from gruebler.mechanics.linkages import Linkage
from gruebler.mechanics.screws import SpatialLinkage
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import code
from gruebler.teaching.catalog import catalog_folder, entry

FOUR_BAR = "R(0-1) R(1-2) R(2-3) R(3-0)"


def test_every_kind_of_file(tmp_path):
    linkage = FourBar(25, 70, 40, 70).linkage()
    write_linkage(tmp_path / "mine.toml", linkage)
    (structure,) = read_structures(tmp_path / "mine.toml")
    assert (structure.name, type(structure.value)) == ("mine", Linkage)
    (structure,) = read_structures(catalog_folder() / "machines" / "vcomp.toml")
    assert isinstance(structure.value, Entry)
    assert structure.value == entry("vcomp")
    documents = [
        Chain.parse(FOUR_BAR).to_json(),
        {"text": f"{FOUR_BAR}; frame=1"},
        linkage_to_json(linkage),
        screws_to_json(entry("winch_screw").placed()),
    ]
    (tmp_path / "all.json").write_text(json.dumps({"items": documents}), encoding="utf-8")
    found = list(read_structures(tmp_path / "all.json"))
    assert [type(structure.value) for structure in found] == [Chain, Chain, Linkage, SpatialLinkage]
    assert [structure.place for structure in found] == [f"{tmp_path / 'all.json'}[{k}]" for k in (1, 2, 3, 4)]
    (tmp_path / "two.g6").write_text("Cr\nEEh_\n", encoding="utf-8")
    assert [structure.value.n for structure in read_structures(tmp_path / "two.g6")] == [4, 6]
    (tmp_path / "lines").write_text(f"# chains\n{FOUR_BAR}\n\n{code(Chain.parse(FOUR_BAR))}\n", encoding="utf-8")
    assert [code(structure.value) for structure in read_structures(tmp_path / "lines")] == [
        code(Chain.parse(FOUR_BAR))
    ] * 2


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("x.parquet", "", "expected a file that ends with .toml, .json, .txt, .g6, not with .parquet"),
        ("x.txt", "# nothing\n", "no chain in it; expected one per line"),
        ("x.txt", f"{FOUR_BAR}\nR(0-1\n", "x.txt, line 2: "),
        ("x.json", "", "is empty"),
        ("x.json", "[]", "no chain in it"),
        ("x.json", '[{"name": "mine", "joints": 3}]', r"x.json\[1\] \(mine\): "),
        ("x.json", "{", "is not JSON"),
    ],
)
def test_errors_name_the_place(tmp_path, name, content, words):
    (tmp_path / name).write_text(content, encoding="utf-8")
    with pytest.raises((CatalogError, NotationError), match=words):
        list(read_structures(tmp_path / name))


def test_a_missing_file_and_a_name_within_json(tmp_path):
    with pytest.raises(CatalogError, match="cannot be read"):
        list(read_structures(tmp_path / "none.txt"))
    document = {"text": FOUR_BAR, "name": "window"}
    (structure,) = structures_of_json(json.dumps(document), "here")
    assert (structure.name, structure.place) == ("window", "here (window)")


@pytest.mark.parametrize(
    ("text", "structure"), [(FOUR_BAR, True), ("g6:Cr", True), ("vcomp", False), ("chains.txt", False)]
)
def test_texts_are_told_from_names(text, structure):
    assert is_structure_text(text) == structure
    assert not structure or chain_of_text(text).n == 4
