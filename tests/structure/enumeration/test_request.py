"""The front of the enumeration: what is asked, listed and counted agrees in every combination."""

from itertools import pairwise

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.structure.enumeration.estimates import estimate, expected_chains
from gruebler.structure.enumeration.listing import chains, count_chains
from gruebler.structure.enumeration.request import Request, RequestError
from gruebler.structure.enumeration.work_units import _orbits
from gruebler.structure.isomorphism import symmetry
from gruebler.structure.mechanism.inversion import driven_mechanisms, inversions

REQUESTS = [
    {"links": 4},
    {"links": 8},
    {"links": 10, "assortment": (5, 4, 1)},
    {"links": 9, "mobility": 0},
    {"links": 8, "mobility": 2},
    {"links": 9, "mobility": 2, "fractionated": "all"},
    {"links": 9, "mobility": 2, "fractionated": "link", "assortment": (7, 1, 0, 1)},
    {"links": 10, "mobility": 3, "fractionated": "joint"},
    {"links": 8, "multiple_joints": "any"},
    {"links": 8, "multiple_joints": 2, "assortment": (6, 2, 0)},
    {"links": 7, "mobility": 2, "multiple_joints": "0-1", "fractionated": "all"},
]


def assortment(chain):
    return tuple(chain.link_kinds.get(k, 0) for k in range(2, max(chain.link_kinds) + 1))


@pytest.mark.parametrize("asked", REQUESTS, ids=str)
def test_the_list_agrees_with_the_count(asked):
    found = list(chains(**asked))
    counted = count_chains(**asked, orbits=True)
    assert counted.chains == len(found)
    assert sum(counted.by_assortment.values()) == sum(counted.by_fractionation.values()) == len(found)
    for numbers, number in counted.by_assortment.items():
        assert number == sum(assortment(chain) == numbers for chain in found)
    orbits = [symmetry(chain) for chain in found]
    assert counted.inversions == sum(len(one.link_orbits) for one in orbits)
    assert counted.joint_orbits == sum(len(one.joint_orbits) for one in orbits)
    plain = count_chains(**asked)
    assert (plain.chains, plain.inversions, plain.drives) == (counted.chains, None, None)
    assert count_chains(**asked, method="list") == count_chains(**asked, method="both") == plain
    assert count_chains(**asked, method="list", orbits=True) == counted
    if "assortment" in asked:
        wanted = asked["assortment"]
        assert all(assortment(chain) == tuple(wanted)[: len(assortment(chain))] for chain in found)


@pytest.mark.parametrize(
    "asked",
    [{"links": 6, "multiple_joints": "any"}, {"links": 7, "mobility": 2, "fractionated": "all"}, {"links": 8}],
    ids=str,
)
def test_orbits_are_those_of_the_mechanisms(asked):
    found = list(chains(**asked))
    counted = count_chains(**asked, orbits=True)
    assert counted.inversions == sum(len(inversions(chain)) for chain in found)
    assert counted.drives == sum(sum(1 for _ in driven_mechanisms(chain)) for chain in found)
    assert counted.drives == sum(_orbits(chain)[2] for chain in found)


def test_methods_that_differ_are_no_count(monkeypatch):
    from gruebler.structure.enumeration import work_units

    real = work_units.list_piece
    monkeypatch.setattr(work_units, "list_piece", lambda piece: real(piece)[1:])
    with pytest.raises(GrueblerError, match="the methods differ: 2 chains counted, 1 listed"):
        count_chains(6, method="both")
    with pytest.raises(GrueblerError, match=r"no method 'lst' \(did you mean 'list'\?\); there are count, list, both"):
        count_chains(6, method="lst")


def test_json_of_a_count():
    assert count_chains(6, orbits=True).to_json() == {
        "links": 6,
        "mobility": 1,
        "chains": 2,
        "by_assortment": {"4,2": 2},
        "inversions": 5,
        "drives": 9,
        "joint_orbits": 6,
    }
    assert count_chains(7, 2, fractionated="all").to_json()["by_fractionation"] == {"none": 3, "link": 1, "joint": 0}


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"links": 2}, "at least three links"),
        ({"links": "8"}, "whole number"),
        ({"links": 8, "mobility": -1}, "mobility 0 or more"),
        ({"links": 8, "mobility": 1.0}, "whole number"),
        ({"links": 8, "fractionated": "some"}, "none, link, joint or all"),
        ({"links": 8, "assortment": (4, 5)}, "9 links in all, not 8"),
        ({"links": 8, "assortment": (9, -1)}, "numbers of binary"),
        ({"links": 8, "assortment": ()}, "0 links in all"),
        ({"links": 8, "multiple_joints": -1}, "a number, a range"),
        ({"links": 8, "multiple_joints": True}, "a number, a range"),
        ({"links": 8, "multiple_joints": "many"}, "a number, a range"),
        ({"links": 8, "multiple_joints": "3-1"}, "ends before it begins"),
        ({"links": 8, "multiple_joints": "1-0"}, "ends before it begins"),
    ],
)
def test_a_senseless_request_is_one_sentence(asked, words):
    with pytest.raises(RequestError, match=words) as caught:
        Request(**asked)
    assert isinstance(caught.value, GrueblerError)
    assert "\n" not in str(caught.value)


def test_requests_that_ask_the_same_are_the_same_task():
    assert Request(8, assortment=(4, 4)).to_json() == Request(8, assortment=(4, 4, 0)).to_json()
    assert Request(8, multiple_joints=2).to_json() == Request(8, multiple_joints="2-2").to_json()


@pytest.mark.parametrize("asked", [r for r in REQUESTS if "assortment" not in r and r.get("multiple_joints", 0) == 0])
def test_known_sizes_are_right(asked):
    known, exact = expected_chains(Request(**asked))
    assert exact
    assert known == count_chains(**asked).chains


def test_estimates_grow():
    sizes = [estimate(Request(n), "graph6") for n in (12, 14, 16, 18, 20)]
    assert all(a.chains < b.chains and a.seconds < b.seconds and a.bytes < b.bytes for a, b in pairwise(sizes))
    assert sizes[-1].exact
    assert not estimate(Request(21, mobility=2), None).exact
    assert estimate(Request(18), None).bytes == 0
    assert expected_chains(Request(8, mobility=2)) == (0, True)
    assert expected_chains(Request(30, mobility=7, fractionated="all"))[0] > 0
    assert expected_chains(Request(14, multiple_joints="any"))[0] > expected_chains(Request(14))[0]
