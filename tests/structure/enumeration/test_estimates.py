"""The table that estimates lean on is counted again; the doors call its numbers known."""

import pytest

from gruebler.structure.enumeration import chains, count_chains
from gruebler.structure.enumeration.estimates import _ANY_JOINTS, _JOINT, _LINK, _NOT_FRACTIONATED
from tests.structure.enumeration.fractionated_oracle import count_fractionated


def rows(table):
    """(links, mobility, number): the k-th entry of a row has k loops, which is F + 1 + 2 k links."""
    return [(f + 1 + 2 * k, f, n) for f, row in table.items() for k, n in enumerate(row, 1)]


def plain_count(links, mobility):
    found = count_chains(links, mobility, orbits=True)
    return found.chains, found.inversions


@pytest.mark.parametrize(("links", "mobility", "number"), [r for r in rows(_NOT_FRACTIONATED) if r[2] < 10**7])
def test_chains_that_do_not_fall_apart(links, mobility, number):
    assert count_chains(links, mobility).chains == number


@pytest.mark.parametrize("most", [10**4, pytest.param(10**9, marks=pytest.mark.slow)])
@pytest.mark.parametrize(("table", "kind"), [(_LINK, "link"), (_JOINT, "joint")])
def test_fractionated_chains(table, kind, most):
    chosen = [row for row in rows(table) if row[2] <= most]
    assert len(chosen) > 5
    for links, mobility, number in chosen:
        assert count_fractionated(links, mobility, chains, plain_count)[kind] == number, (links, mobility)


@pytest.mark.parametrize(("links", "mobility", "number"), [r for r in rows(_ANY_JOINTS) if r[2] < 300])
def test_chains_with_any_joints(links, mobility, number):
    assert count_chains(links, mobility, fractionated="all", multiple_joints="any").chains == number


@pytest.mark.slow
def test_chains_with_any_joints_of_ten_links():
    assert count_chains(10, 1, fractionated="all", multiple_joints="any").chains == 2645
