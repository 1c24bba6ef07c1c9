"""Access features, derived."""

import pytest
from hypothesis import given

from gruebler.base.errors import ChainError
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import pair
from gruebler.structure.mechanism import Mechanism
from gruebler.teaching.catalog import entries, entry
from gruebler.teaching.catalog.features import access_features
from tests import strategies


def test_the_collection_sheet_001():
    """1 drive joint, 1 of them at the frame; 1 output link, 0 at the frame; 4 links, 4 binary; 4 joints, 4 D."""
    record = entry("mzc")
    found = access_features(record.linkage().mechanism, record.outputs)
    assert (found.drive_joints, found.drive_joints_at_frame) == (1, 1)
    assert (found.output_links, found.output_links_at_frame) == (1, 0)
    assert (found.links, found.links_by_joints) == (4, ((2, 4),))
    assert (found.joints, found.joints_by_pair) == (4, ((pair("revolute"), 4),))
    assert found.described("de") == (
        ("Antriebsgelenke", "1, davon 1 am Gestell"),
        ("Abtriebsglieder", "1, davon 0 am Gestell"),
        ("Glieder", "4, davon 4 binär"),
        ("Gelenke", "4, davon 4 Drehgelenke (D)"),
    )
    assert found.described("en")[2] == ("Links", "4, of these 4 binary")


def test_multiple_joints_and_drives_away_from_the_frame():
    mechanism = Mechanism.parse("R(0-1) R(1-2-3) P(0-2) P(0-3); drive=R(0-1)")
    found = access_features(mechanism, ["2", "3", "2"])
    assert found.by_symbol("german") == (("D", 3), ("S", 2))
    assert (found.joints, found.links_by_joints) == (5, ((2, 3), (3, 1)))
    assert (found.output_links, found.output_links_at_frame) == (2, 2)
    cylinder = Mechanism.parse("R(0-1) R(0-4) R(4-2) P(1-2); frame=0; drive=P(1-2)")
    assert access_features(cylinder).drive_joints_at_frame == 0


def test_the_whole_catalog_has_features():
    for record in entries().values():
        chain = record.chain()
        found = access_features(Mechanism(chain, record.frame or chain.links[0], record.drives), record.outputs)
        assert found.links == chain.n
        for lang in ("en", "de"):
            assert all(value for _, value in found.described(lang))


@given(strategies.chains())
def test_counting_laws(chain: Chain):
    """2g = sum of i n_i with multiple joints resolved is a law of elements; here: elements = g + number of joints."""
    found = access_features(Mechanism(chain, chain.links[0]))
    assert sum(count for _, count in found.links_by_joints) == found.links == chain.n
    assert sum(k * count for k, count in found.links_by_joints) == found.joints + len(chain.joints)
    assert sum(count for _, count in found.joints_by_pair) == found.joints


def test_outputs_are_links():
    with pytest.raises(ChainError, match="'x'"):
        access_features(Mechanism.parse("R(0-1) R(1-2) R(0-2)"), ["x"])
