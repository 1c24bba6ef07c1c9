"""The number of assembly modes: against print, other programs, another method, and laws."""

import numpy as np
import pytest

from gruebler import Chain
from gruebler.mechanics.kinematics.assembly_modes import conditions, search_modes
from gruebler.mechanics.kinematics.kernel_records import PIN
from gruebler.structure.assur import AssurError, assur_groups, count_modes
from gruebler.structure.assur.listing import group_rows
from gruebler.structure.assur.modes import modes_of_rows, modes_of_trusses, sets_of_ends
from gruebler.structure.enumeration import chains, edge_blocks
from tests.structure.assur.cross_ratio_oracle import count_by_cross_ratios
from tests.structure.assur.monodromy_oracle import count_by_monodromy
from tests.structure.assur.oracles import group_of_truss
from tests.structure.assur.spherical_monodromy_oracle import count_by_spherical_monodromy

# lnumber 0.20 (J. Capco), planar and spherical Laman numbers of the triangulated trusses over 2 ** sum (k - 2), in the
# order of `chains(n, 0)`.
LNUMBER = {
    (3, False): "2",
    (3, True): "2",
    (5, False): "6",
    (5, True): "8",
    (7, False): "18 14 16",
    (7, True): "32 16 24",
    (9, False): "54 52 54 42 48 48 48 48 42 48 30 36 40 44 40 42 44 52 56 50 46 40 46 38 50 46 50 58",
    (9, True): "128 128 128 64 96 96 96 96 64 96 32 48 64 80 64 64 80 112 128 96 80 64 80 48 96 80 96 128",
}
# The same program for the plane, 11 links: number of trusses with so many modes.
ELEVEN = {
    62: 1, 76: 1, 80: 1, 82: 1, 88: 6, 90: 3, 92: 2, 94: 4, 96: 9, 98: 2, 100: 7, 102: 6,
    104: 11, 106: 3, 108: 22, 110: 5, 112: 26, 114: 12, 116: 17, 118: 5, 120: 40, 122: 5, 124: 18, 126: 32,
    128: 21, 130: 17, 132: 29, 134: 17, 136: 12, 138: 35, 140: 20, 142: 10, 144: 32, 146: 4, 148: 15, 150: 31,
    152: 12, 154: 7, 156: 14, 158: 6, 160: 3, 162: 11, 164: 2, 166: 4, 168: 3, 170: 7, 172: 1, 174: 2,
    180: 2, 184: 2, 186: 1, 188: 2, 200: 1,
}  # fmt: skip
# And for 13 links: the least, the most, and some drawn at random; joints as pairs of links, 10 to 12 as a to c.
THIRTEEN = {
    "01 02 17 72 03 18 83 04 29 94 05 3a a5 06 4b b6 5c c6": 126,
    "23 14 35 45 16 26 07 57 6a a7 08 18 3b b8 09 29 4c c9": 700,
    "02 16 62 07 73 18 83 23 09 94 14 2a a4 0b b5 1c c5 35": 400,
    "08 81 23 14 24 05 29 95 4a a5 06 16 36 0b b7 1c c7 37": 404,
    "08 81 09 91 04 2a a4 34 15 25 3b b5 06 26 17 37 6c c7": 540,
    "23 14 34 05 15 06 29 96 5a a6 07 37 4b b7 0c c8 18 28": 444,
    "03 28 83 19 94 24 34 05 1a a5 0b b6 16 56 0c c7 17 27": 400,
    "01 07 72 08 82 09 93 1a a3 0b b4 34 15 25 1c c6 46 56": 420,
    "08 81 23 14 24 05 29 95 45 0a a6 16 36 0b b7 17 3c c7": 420,
    "13 24 39 94 0a a5 25 06 36 56 07 17 47 0b b8 18 2c c8": 472,
    "01 07 72 18 82 09 93 1a a3 23 24 15 4b b5 06 4c c6 56": 428,
    "08 81 02 03 29 93 0a a4 15 3b b5 1c c6 46 56 17 27 47": 406,
    "23 14 34 05 25 06 29 96 5a a6 07 1b b7 37 08 18 4c c8": 400,
    "03 18 83 19 93 04 2a a4 0b b5 25 45 16 26 07 17 6c c7": 384,
    "08 81 02 09 93 23 04 15 3a a5 1b b6 46 56 17 27 4c c7": 444,
    "07 71 02 12 03 18 83 04 05 39 95 4a a5 1b b6 2c c6 46": 256,
    "08 81 04 24 39 94 15 25 3a a5 06 16 2b b6 07 1c c7 37": 408,
    "01 13 23 08 84 24 19 95 25 06 4a a6 56 07 1b b7 3c c7": 420,
    "01 18 83 23 04 24 19 95 25 0a a6 46 56 0b b7 1c c7 37": 396,
    "03 13 08 84 24 05 39 95 4a a5 0b b6 16 26 0c c7 17 27": 392,
    "17 72 03 13 28 83 09 94 1a a4 24 0b b5 15 06 2c c6 56": 468,
}


def truss_sets(links):
    return np.concatenate([sets_of_ends(block) for block in edge_blocks(links, 0)])


@pytest.mark.parametrize(("links", "spherical"), LNUMBER)
def test_another_program(links, spherical):
    assert modes_of_trusses(links, truss_sets(links), spherical=spherical).tolist() == [
        int(modes) for modes in LNUMBER[links, spherical].split()
    ]


def test_another_program_for_eleven_links():
    numbers, times = np.unique(modes_of_trusses(11, truss_sets(11)), return_counts=True)
    assert dict(zip(numbers.tolist(), times.tolist(), strict=True)) == ELEVEN


def test_another_program_for_thirteen_links():
    ends = np.array([[[int(end, 13) for end in joint] for joint in text.split()] for text in THIRTEEN], np.uint8)
    assert modes_of_trusses(13, sets_of_ends(ends)).tolist() == list(THIRTEEN.values())


@pytest.mark.parametrize("links", [3, 5, pytest.param(7, marks=pytest.mark.slow)])
def test_monodromy(links):
    for block in edge_blocks(links, 0):
        for ends, modes in zip(block.tolist(), modes_of_trusses(links, sets_of_ends(block)).tolist(), strict=True):
            assert count_by_monodromy(links, ends) == modes


@pytest.mark.parametrize("links", [3, pytest.param(5, marks=pytest.mark.slow)])
def test_spherical_monodromy(links):
    sets = truss_sets(links)
    for joints, modes in zip(sets.tolist(), modes_of_trusses(links, sets, spherical=True).tolist(), strict=True):
        ends = [tuple(k for k in range(links) if joint >> k & 1) for joint in joints]
        assert count_by_spherical_monodromy(ends) == modes


@pytest.mark.parametrize("links", [3, 5, 7, *(pytest.param(n, marks=pytest.mark.slow) for n in (9, 11))])
def test_cross_ratios(links):
    """Every truss; 11 links take some three minutes."""
    sets = truss_sets(links)
    for joints, modes in zip(sets.tolist(), modes_of_trusses(links, sets, spherical=True).tolist(), strict=True):
        assert count_by_cross_ratios([tuple(k for k in range(links) if joint >> k & 1) for joint in joints]) == modes


@pytest.mark.slow
def test_cross_ratios_of_13_links():
    """Drawn at random, 5 s each."""
    sets = truss_sets(13)
    sample = sets[np.random.default_rng(13).choice(len(sets), 20, replace=False)][:16]
    for joints, modes in zip(sample.tolist(), modes_of_trusses(13, sample, spherical=True).tolist(), strict=True):
        assert count_by_cross_ratios([tuple(k for k in range(13) if joint >> k & 1) for joint in joints]) == modes


@pytest.mark.parametrize("spherical", [False, True])
@pytest.mark.parametrize("links", [5, 7, 9, 11])
def test_order_says_nothing(links, spherical):
    """Other numbers of links and joints mean other recursions."""
    rng = np.random.default_rng(links)
    sets = truss_sets(links)[:40]
    ends = np.array([[[k for k in range(links) if joint >> k & 1] for joint in row] for row in sets.tolist()])
    other = sets_of_ends(rng.permutation(links)[ends][:, rng.permutation(ends.shape[1])].astype(np.uint8))
    assert (
        modes_of_trusses(links, other, spherical=spherical) == modes_of_trusses(links, sets, spherical=spherical)
    ).all()


def test_a_chain_of_dyads_doubles():
    """Each dyad that is hung on a truss has two positions: 2 ** dyads for dyads alone, by hand."""
    ends = [(0, 1), (1, 2), (2, 0)]
    for k in range(1, 6):
        new = 2 * k + 1
        ends += [(new - 1, new), (new, new + 1), (new + 1, new - 3)]
        chain = Chain.from_edges(ends)
        assert count_modes(chain) == count_modes(chain, spherical=True) == 2 ** (k + 1)


def test_overconstrained_parts_have_none():
    """A four-bar braced twice beside one that moves: the numbers agree, almost no dimensions assemble."""
    braced = Chain.from_edges(
        [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 2), (1, 5), (5, 3), (5, 6), (6, 7), (7, 8), (8, 5)]
    )
    assert count_modes(braced) == count_modes(braced, spherical=True) == 0


def test_groups_have_the_modes_of_their_truss():
    for truss in chains(7, 0):
        assert {count_modes(group_of_truss(truss, link)) for link in truss.links} == {count_modes(truss)}
    rows = list(group_rows(6))
    assert modes_of_rows(rows) == [count_modes(group) for group in assur_groups(6)]
    assert modes_of_rows([]) == []


def test_a_multiple_joint():
    """Two legs of a hub on one pin: two dyads one after the other, two positions each, by hand."""
    chain = Chain.parse("R(0-1) R(0-2) R(1-2-4) R(0-3) R(3-4)")
    assert count_modes(chain) == count_modes(chain, spherical=True) == 4


def test_no_search_finds_more():
    bars = [(PIN, -1, 0, 0j, 1, 0j, 1), (PIN, -1, 1, 4 + 0j, 1, 0j, 1), (PIN, -1, 2, 2 + 3j, 1, 0j, 1)]
    hub = [
        (PIN, 0, 3, 2.5 + 0j, 1, 0j, 1),
        (PIN, 1, 3, 2.6 + 0j, 1, 1 + 0j, 1),
        (PIN, 2, 3, 2.7 + 0j, 1, 0.4 + 0.9j, 1),
    ]
    modes = search_modes(conditions(bars + hub))
    assert modes.bound == 6 >= len(modes) > 0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("R(0-1) R(1-2) P(2-0)", "does not"),
        ("R(0-1) R(1-2) R(2-3) R(3-0)", "remove 8"),
        (" ".join(f"R({a}-{a + 1}) R({a + 1}-{a + 2}) R({a + 2}-{a})" for a in range(0, 22, 2)), "to 21 links"),
    ],
)  # fmt: skip
def test_wrong_calls(text, words):
    with pytest.raises(AssurError, match=words):
        count_modes(Chain.parse(text))
