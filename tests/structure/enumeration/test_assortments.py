from itertools import islice, product

import pytest

from gruebler.base.errors import GrueblerError
from gruebler.structure.enumeration import (
    assortment_number,
    assortments,
    contracted_graphs,
    count_chains,
    each_assortment,
    each_joint_assortment,
    joint_assortment_number,
    joint_assortments,
    largest_degree,
)
from gruebler.structure.enumeration.assortment import joint_count, loop_count
from gruebler.structure.enumeration.partitions import partition_numbers

SMALL = [(n, f) for n in range(1, 13) for f in range(5)]


@pytest.mark.parametrize(("links", "mobility"), SMALL)
def test_the_three_equations_and_the_bound_and_nothing_else(links, mobility):
    """Oracle: all tuples of numbers that are small enough, tried one by one."""
    twice_joints = 3 * (links - 1) - mobility
    largest = (links - mobility + 1) // 2
    expected = []
    if twice_joints % 2 == 0 and largest >= 2:
        ranges = [range(links + 1 if i < 4 else links // (i - 2) + 1) for i in range(2, largest + 1)]
        for numbers in product(*ranges):
            joints = sum(i * k for i, k in enumerate(numbers, 2))
            if sum(numbers) == links and joints == twice_joints:
                whole = list(numbers)
                while whole[-1] == 0:
                    whole.pop()
                expected.append(tuple(whole))
    assert assortments(links, mobility) == sorted(expected)


def test_assortments_of_the_literature():
    assert assortments(4) == [(4,)]
    assert assortments(6) == [(4, 2)]
    assert assortments(10) == [
        (4, 6),
        (5, 4, 1),
        (6, 2, 2),
        (6, 3, 0, 1),
        (7, 0, 3),
        (7, 1, 1, 1),
        (8, 0, 0, 2),
    ]
    assert assortments(3, 0) == [(3,)]
    assert assortments(7, 0) == [(3, 4), (4, 2, 1), (5, 0, 2)]


@pytest.mark.parametrize(("links", "mobility"), [(8, 1), (10, 1), (9, 2), (10, 3)])
def test_contracted_graphs_realise_just_the_assortments(links, mobility):
    loops = loop_count(links, mobility)
    found = set()
    for graph in contracted_graphs(loops):
        higher = [graph.degrees.count(i) for i in range(3, max(graph.degrees) + 1)]
        found.add((links - graph.nodes, *higher))
    assert sorted(found) == assortments(links, mobility)


@pytest.mark.parametrize(("links", "mobility"), [(10, 1), (12, 1), (11, 2)])
def test_every_assortment_has_chains_and_the_bound_is_attained(links, mobility):
    counted = count_chains(links, mobility).by_assortment
    assert list(counted) == assortments(links, mobility)
    assert max(len(a) + 1 for a in counted) == largest_degree(links, mobility)


def test_with_mobility_0_some_assortments_have_no_chain():
    assert set(count_chains(7, 0).by_assortment) < set(assortments(7, 0))


def test_fractionated_chains_may_have_larger_links():
    """Two four-bars joined at a link of both: seven links, mobility 2, a link of four joints."""
    assert (6, 0, 1) in assortments(7, 2, fractionated=True)
    assert (6, 0, 1) not in assortments(7, 2)
    assert largest_degree(10, 3, fractionated=True) == 6
    assert set(assortments(10, 3)) < set(assortments(10, 3, fractionated=True))


def test_numbers_without_chains():
    assert assortments(5, 1) == []
    assert assortments(2, 1) == []
    assert largest_degree(5, 1) is None
    assert loop_count(4, 3) is None
    assert joint_count(6, 2) is None
    for links, mobility in ((0, 1), (4, -1)):
        with pytest.raises(GrueblerError, match="at least"):
            assortments(links, mobility)


def shared_out(total, largest):
    """(k_1, ..., k_largest) with sum i k_i = total, by trying every k."""
    if largest < 1:
        if total == 0:
            yield ()
        return
    for k in range(total // largest + 1):
        for rest in shared_out(total - k * largest, largest - 1):
            yield (*rest, k)


def trimmed(*numbers):
    kept = list(numbers)
    while len(kept) > 1 and kept[-1] == 0:
        kept.pop()
    return tuple(kept)


@pytest.mark.parametrize("fractionated", [False, True])
@pytest.mark.parametrize("mobility", range(5))
def test_listing_and_counting_agree_with_trying_every_number(mobility, fractionated):
    """Oracle: the search that tries every number of parts, as the library once did."""
    for links in range(1, 19):
        joints, largest = joint_count(links, mobility), largest_degree(links, mobility, fractionated=fractionated)
        expected, multiple = [], []
        if joints is not None:
            merging = 2 * (joints - links)
            expected = sorted(trimmed(links - sum(more), *more) for more in shared_out(merging, largest - 2))
            multiple = [
                (trimmed(links - sum(more), *more), trimmed(joints - merged - sum(together), *together))
                for merged in range(merging + 1)
                for together in shared_out(merged, largest - 2)
                if joints >= merged + sum(together)
                for more in shared_out(merging - merged, largest - 2)
            ]
        assert assortments(links, mobility, fractionated=fractionated) == expected
        assert assortment_number(links, mobility, fractionated=fractionated) == len(expected)
        assert joint_assortments(links, mobility, fractionated=fractionated) == multiple
        assert joint_assortment_number(links, mobility, fractionated=fractionated) == len(multiple)


def test_long_lists_come_one_by_one_and_are_counted_without_them():
    """sum i n_i = 2g holds far down the list, and p(n) of the literature (Hardy and Ramanujan: p(200)) is met."""
    joints = joint_count(3000, 1)
    for numbers in islice(each_assortment(3000), 2000):
        assert sum(numbers) == 3000
        assert sum(i * k for i, k in enumerate(numbers, 2)) == 2 * joints
    for links, together in islice(each_joint_assortment(3000), 2000):
        assert sum(i * k for i, k in enumerate(links, 2)) == sum(i * k for i, k in enumerate(together, 2))
    p = partition_numbers(200)
    assert p[200] == 3_972_999_029_388
    # 204 links with F = 1: partitions of 200 into parts of at most 100.
    assert assortment_number(204) == p[200] - sum(p[:100])
