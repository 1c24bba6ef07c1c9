import pickle
from itertools import combinations

import numpy as np
import pytest

from gruebler.base.errors import PairError
from gruebler.base.text import error_in_language
from gruebler.structure.chain.pairs import PAIRS, Alphabet, Contact, pair
from gruebler.structure.chain.spaces import Space
from gruebler.structure.chain.symbols import read_symbols

# Table 2.2 of the seeds as reconstructed: German symbol -> f in space (f = sum of the indices, W counts 1).
TABLE_2_2 = {
    "D": 1,
    "S": 1,
    "W": 1,
    "DS": 2,
    "S2": 2,
    "D2": 2,
    "D3": 3,
    "DS2": 3,
    "D2S": 3,
    "D3S": 4,
    "D2S2": 4,
    "D3S2": 5,
}


def indices(symbol: str) -> int:
    """The rule of the table: add the index of every letter, 1 where none is written."""
    total = 0
    for k, letter in enumerate(symbol):
        if letter.isalpha():
            following = symbol[k + 1 : k + 2]
            total += int(following) if following.isdigit() else 1
    return total


@pytest.mark.parametrize(("symbol", "f"), TABLE_2_2.items())
def test_every_row_of_the_seeds_table_is_there_with_its_freedoms(symbol, f):
    rows = [p for p in PAIRS if p.symbols.get(Alphabet.GERMAN) == symbol and Space.SPATIAL in p.freedoms]
    assert rows
    for row in rows:
        assert row.f(Space.SPATIAL) == f == indices(symbol)
        assert row.u(Space.SPATIAL) == 6 - f


# The motion directions in each space, as the seeds list them (2.5 and 2.6 for the plane and the sphere): what the rows
# state as one motion must give these.
LISTED = {
    "revolute": {"planar": "Rz", "spherical": "Rz", "spatial": "Rz"},
    "prismatic": {"planar": "Tx", "spatial": "Tx"},
    "helical": {"spatial": "Hz"},
    "rolling": {"planar": "Rz", "spherical": "Rz"},
    "cylindrical": {"spatial": "Rz Tz"},
    "roll_slide": {"planar": "Rz Tx", "spherical": "Rz Ry", "spatial": "Rz Tx"},  # slipping round the sphere's centre
    "double_slide": {"planar": "Tx Ty", "spatial": "Tx Ty"},
    "universal": {"spatial": "Rx Ry"},
    "spherical": {"spatial": "Rx Ry Rz"},
    "planar": {"spatial": "Rz Tx Ty"},
    "ball_groove": {"spatial": "Ry Rz Tx"},
    "ball_cylinder": {"spatial": "Rx Ry Rz Tx"},
    "cylinder_plane": {"spatial": "Ry Rz Tx Tz"},
    "double_cylindrical": {"spatial": "Rx Ry Tx Ty"},
    "ball_plane": {"spatial": "Rx Ry Rz Tx Tz"},
}


@pytest.mark.parametrize("name", LISTED)
def test_the_freedoms_in_each_space_follow_from_the_motion(name):
    assert {str(s): " ".join(f) for s, f in pair(name).freedoms.items()} == LISTED[name]


IN_SPACES = [(p, space) for p in PAIRS for space in p.freedoms]
NOT_IN_SPACES = [(p, space) for p in PAIRS for space in Space if space not in p.freedoms]


def name_of(value):
    return value.name if hasattr(value, "name") else str(value)


@pytest.mark.parametrize(("p", "space"), NOT_IN_SPACES, ids=name_of)
def test_a_pair_has_no_freedoms_in_other_spaces(p, space):
    with pytest.raises(PairError, match=p.german):
        p.f(space)


@pytest.mark.parametrize(("p", "space"), IN_SPACES, ids=name_of)
def test_laws_of_the_table(p, space):
    freedoms = p.freedoms[space]
    assert len(set(freedoms)) == len(freedoms) == p.f(space)
    assert {d.replace("H", "R") for d in freedoms} <= set(space.directions)
    assert 1 <= p.f(space) <= space.b - 1
    assert p.f(space) + p.u(space) == space.b


def test_limits_of_the_seeds():
    assert max(p.f(Space.SPATIAL) for p in PAIRS if Space.SPATIAL in p.freedoms) == 5
    assert max(p.f(Space.PLANAR) for p in PAIRS if Space.PLANAR in p.freedoms) == 2


def bracket(a, b):
    """The Lie bracket of two twists (turn, shift)."""
    return np.concatenate([np.cross(a[:3], b[:3]), np.cross(a[:3], b[3:]) + np.cross(a[3:], b[:3])])


@pytest.mark.parametrize(("p", "space"), IN_SPACES, ids=name_of)
def test_a_joint_can_be_shared_exactly_if_its_twists_close_under_the_bracket(p, space):
    """Relative motions of a kind compose to the same kind if and only if they form a subgroup."""
    axes = {d: np.eye(6)[k] for k, d in enumerate(Space.SPATIAL.directions)}
    axes["Hz"] = axes["Rz"] + 0.3 * axes["Tz"]
    twists = [axes[d] for d in p.freedoms[space]]
    rank = np.linalg.matrix_rank(np.array(twists))
    closed = all(np.linalg.matrix_rank(np.array([*twists, bracket(a, b)])) == rank for a, b in combinations(twists, 2))
    assert p.is_group == (closed and p.contact is not Contact.HIGHER)


def test_symbols_are_read_in_one_alphabet():
    assert read_symbols(["D", "S", "G", "W"], Space.PLANAR)["S"] is pair("prismatic")
    assert read_symbols(["R", "S"], Space.SPATIAL)["S"] is pair("spherical")
    assert read_symbols(["D", "S"], Space.SPATIAL)["S"] is pair("prismatic")
    assert read_symbols(["S"], Space.PLANAR)["S"] is pair("prismatic")
    assert read_symbols(["W", "D"], Space.SPATIAL)["W"] is pair("helical")
    assert read_symbols(["W"], Space.PLANAR)["W"] is pair("rolling")
    assert read_symbols(["G"], Space.PLANAR)["G"] is pair("roll_slide")
    assert read_symbols(["revolute", "Schubgelenk", "S"], Space.PLANAR)["Schubgelenk"] is pair("prismatic")


@pytest.mark.parametrize(
    ("symbols", "space", "words"),
    [
        (["D", "R"], "planar", ["mix", "German", "international"]),
        (["D", "P", "H"], "spatial", ["mix"]),
        (["S"], "spatial", ["prismatic", "spherical", "ambiguous"]),
        (["D2S2", "D"], "spatial", ["cylinder_plane", "double_cylindrical"]),
        (["R", "S"], "planar", ["spherical", "'P'", "f = 3"]),
        (["D", "DS"], "planar", ["cylindrical", "at most f = 2"]),
        (["X"], "planar", ["unknown", "'X'"]),
        (["revolut"], "planar", ["did you mean 'revolute'"]),
    ],
)
def test_symbols_that_cannot_be_read_are_refused_with_the_readings(symbols, space, words):
    with pytest.raises(PairError) as caught:
        read_symbols(symbols, Space(space))
    for word in words:
        assert word in str(caught.value)


def test_pairs_are_values():
    for p in PAIRS:
        assert pickle.loads(pickle.dumps(p)) is pair(p.name) is pair(p.german)


def test_an_error_names_pairs_and_spaces_in_the_language_of_the_reader():
    with pytest.raises(PairError) as refused:
        read_symbols(["S"], Space.SPATIAL)
    assert "Schubgelenk" in error_in_language(refused.value, "de")
    assert "Kugelgelenk" in error_in_language(refused.value, "de")
    assert str(pair("prismatic").title) == "prismatic"
    assert pickle.loads(pickle.dumps(pair("prismatic").title)).in_language("de") == "Schubgelenk"


def test_a_pair_that_a_space_does_not_have_is_told_in_german_words():
    with pytest.raises(PairError) as caught:
        read_symbols(["D3", "D"], Space.PLANAR)
    german = error_in_language(caught.value, "de")
    assert "Kugelgelenk" in german
    assert "D (Drehgelenk), S (Schubgelenk)" in german
    assert [pair.name for pair in PAIRS if pair.name in german] == []
