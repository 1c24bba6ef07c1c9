"""Multiple joints: the counts of the literature, the theorems of docs/theory/multiple-joints.md, and other ways."""

from collections import Counter
from itertools import combinations, permutations

import pytest

import gruebler as gr
from gruebler import Chain, code, mobility_report
from gruebler.structure.enumeration.fractionation_class import fractionation, joint_masks
from gruebler.structure.enumeration.listing import chains
from gruebler.structure.enumeration.multiple import grown_joints, with_multiple_joints
from gruebler.structure.enumeration.multiple_assortment import joint_assortments
from tests.structure.enumeration.definition_oracle import is_constrained
from tests.structure.enumeration.growth_oracle import grown_one_by_one, merge_joints, split_multiple_joints


def simple(links, mobility=1):
    return list(chains(links, mobility, fractionated="all"))


def grown(links, mobility=1):
    return list(with_multiple_joints(simple(links, mobility)))


def revolutes(joints, links):
    return Chain([("revolute", sorted(joint)) for joint in joints], links=range(links))


@pytest.mark.parametrize(("links", "numbers"), [(4, [1]), (6, [2, 1, 1]), (8, [16, 22, 18, 3, 1])])
def test_known_numbers(links, numbers):
    found = grown(links)
    assert len({code(chain) for chain in found}) == len(found) == sum(numbers)
    assert Counter(len(chain.multiple_joints) for chain in found) == dict(enumerate(numbers))


@pytest.mark.parametrize(
    ("links", "mobility"), [(6, 1), (8, 1), (7, 2), (7, 0), (8, 3), (7, 4), pytest.param(9, 0, marks=pytest.mark.slow)]
)
def test_the_kernel_against_codes_of_all_chains_and_splits(links, mobility):
    kernel = [code(chain) for chain in grown(links, mobility)]
    assert sorted(kernel) == sorted(code(chain) for chain in grown_one_by_one(simple(links, mobility)))
    for fewest, most, largest in ((1, 2, None), (0, None, 3), (2, 2, 4)):
        limits = {"fewest": fewest, "most": most, "largest": largest}
        some = {code(chain) for chain in with_multiple_joints(simple(links, mobility), **limits)}
        assert some == {code(chain) for chain in grown_one_by_one(simple(links, mobility), **limits)}


def test_numbers_of_larger_chains():
    for links, mobility, number in ((10, 1, 2645), (9, 2, 219), (11, 2, 13450)):
        masks = [joint_masks(chain) for chain in simple(links, mobility)]
        assert sum(len(block) for block in grown_joints(links, masks)) == number
    assert gr.count_chains(10, 1, multiple_joints="any").chains == 2645
    assert gr.count_chains(10, 1, multiple_joints="2-3").chains == 1009 + 511


@pytest.mark.parametrize(("links", "mobility"), [(6, 1), (8, 1), (7, 2), (7, 0)])
def test_every_chain_is_one(links, mobility):
    for chain in grown(links, mobility):
        assert is_constrained(chain, mobility)
        report = mobility_report(chain)
        assert (report.counted, report.generic) == (mobility, mobility)
        assert not report.overconstrained
        if mobility:
            assert not report.rigid_clusters


def joint_systems(links, joints):
    """Every set of joints on so many links that counts so many and in which no two joints share two links."""
    places = [set(some) for size in range(2, links + 1) for some in combinations(range(links), size)]

    def extend(chosen, begin, left):
        if left == 0:
            yield chosen
            return
        for k in range(begin, len(places)):
            joint = places[k]
            if len(joint) - 1 <= left and all(len(joint & other) < 2 for other in chosen):
                more = [*chosen, joint]
                touched = sum(len(other) for other in more)
                if touched + 2 * (left - len(joint) + 1) >= 2 * links:
                    yield from extend(more, k + 1, left - len(joint) + 1)

    yield from extend([], 0, joints)


def obvious(joints, links):
    """The definition, set by set."""
    if any(sum(link in joint for joint in joints) < 2 for link in range(links)):
        return False
    return all(
        3 * (size - 1) - 2 * sum(max(0, len(joint & set(some)) - 1) for joint in joints) >= 1
        for size in range(2, links)
        for some in combinations(range(links), size)
    )


def test_brute_force_over_all_joint_systems_of_six_links():
    found = {code(revolutes(joints, 6)) for joints in joint_systems(6, 7) if obvious(joints, 6)}
    assert found == {code(chain) for chain in grown(6)}


def stars(joints, used=()):
    """Every way to merge simple joints at their common links into stars, several at once."""
    yield []
    for link in sorted({link for joint in joints for link in joint}):
        mine = [joint for joint in joints if link in joint and joint not in used]
        for size in range(2, len(mine) + 1):
            for star in combinations(mine, size):
                rest = [joint for joint in joints if joint not in star]
                # A later star begins at the same or a higher link, so that each choice comes up once or twice only.
                for more in stars([joint for joint in rest if max(joint) >= link], (*used, *star)):
                    yield [star, *more]


@pytest.mark.parametrize(("links", "mobility"), [(6, 1), pytest.param(8, 1, marks=pytest.mark.slow), (7, 2), (7, 0)])
def test_stars_merged_in_one_go_give_the_same(links, mobility):
    found = set()
    for chain in simple(links, mobility):
        joints = [frozenset(map(chain.index, joint.links)) for joint in chain.joints]
        for chosen in stars(joints):
            loose = [joint for joint in joints if not any(joint in star for star in chosen)]
            made = [*loose, *(frozenset().union(*star) for star in chosen)]
            if all(len(a & b) < 2 for a, b in combinations(made, 2)) and obvious(made, links):
                found.add(code(revolutes(made, links)))
    assert found == {code(chain) for chain in grown(links, mobility)}


@pytest.mark.parametrize(("links", "mobility"), [(8, 1), (9, 2)])
def test_every_split_keeps_the_conditions(links, mobility):
    chains = grown(links, mobility)[::3]
    assert sum(bool(chain.multiple_joints) for chain in chains) > len(chains) // 3
    for chain in chains:
        for k in (chain.joints.index(joint) for joint in chain.multiple_joints):
            for a, b in permutations(chain.joints[k].links, 2):
                rest = [
                    j.links if m != k else [link for link in j.links if link != b] for m, j in enumerate(chain.joints)
                ]
                parted = Chain([("revolute", links_) for links_ in [*rest, [a, b]]], links=chain.links)
                assert is_constrained(parted, mobility)


def test_merging_tests_exactly_the_definition():
    for chain in grown(8)[::2]:
        every = set()
        for k, big in enumerate(chain.joints):
            for m, small in enumerate(chain.joints):
                if k != m and len(small.links) == 2 and len(set(big.links) & set(small.links)) == 1:
                    rest = [j.links for i, j in enumerate(chain.joints) if i not in (k, m)]
                    made = [*rest, tuple(dict.fromkeys([*big.links, *small.links]))]
                    candidate = Chain([("revolute", links) for links in made], links=chain.links)
                    if is_constrained(candidate, 1):
                        every.add(code(candidate))
        assert {code(child) for child in merge_joints(chain)} == every
        assert {code(child) for child in merge_joints(chain, preferred=True)} <= every


def test_the_chosen_split_is_blind_to_names():
    several = [chain for chain in grown(8) if chain.multiple_joints]
    assert len(several) > 10
    for chain in several:
        turned = chain.renamed({link: f"link {k}" for k, link in enumerate(reversed(chain.links))})
        mixed = Chain(list(turned.joints)[::-1], links=sorted(turned.links))
        assert code(split_multiple_joints(mixed)) == code(split_multiple_joints(chain))


def test_exactly_at_most_and_any():
    every = {code(chain): len(chain.multiple_joints) for chain in chains(8, multiple_joints="any")}
    for fewest, most in [(0, 0), (1, 1), (2, 2), (4, 4), (5, 5), (0, 2), (1, 3)]:
        found = [code(chain) for chain in chains(8, multiple_joints=f"{fewest}-{most}")]
        assert sorted(found) == sorted(name for name, number in every.items() if fewest <= number <= most)
    assert [str(c) for c in chains(8, multiple_joints=1)] == [str(c) for c in chains(8, multiple_joints="1-1")]
    small = list(with_multiple_joints(simple(8), largest=3))
    assert {code(c) for c in small} == {code(c) for c in grown(8) if all(len(joint.links) <= 3 for joint in c.joints)}


def test_classes_of_chains_with_multiple_joints():
    every = grown(9, 2)
    for kind in ("none", "link", "joint"):
        found = {code(chain) for chain in chains(9, 2, fractionated=kind, multiple_joints="any")}
        assert found == {code(chain) for chain in every if fractionation(chain) == kind}


@pytest.mark.parametrize(("links", "mobility"), [(4, 1), (6, 1), (8, 1), (7, 2), (9, 2), (7, 0), (8, 3)])
def test_every_chain_has_one_of_the_assortments(links, mobility):
    allowed = {tuple(found) for found in joint_assortments(links, mobility, fractionated=True)}
    for chain in grown(links, mobility):
        sizes = Counter(len(joint.links) for joint in chain.joints)
        degrees = tuple(chain.link_kinds.get(k, 0) for k in range(2, max(chain.link_kinds) + 1))
        assert (degrees, tuple(sizes[k] for k in range(2, max(sizes) + 1))) in allowed


def test_assortments_by_trying_all_numbers():
    n, joints, largest = 8, 10, 4
    expected = set()
    for twos in range(n + 1):
        for threes in range(n + 1 - twos):
            fours = n - twos - threes
            for g3 in range(joints):
                for g4 in range(joints):
                    g2 = joints - 2 * g3 - 3 * g4
                    if g2 >= 0 and 2 * twos + 3 * threes + 4 * fours == 2 * g2 + 3 * g3 + 4 * g4:
                        expected.add(((twos, threes, fours), (g2, g3, g4)))
    found = joint_assortments(n)
    filled = {
        tuple(tuple(numbers) + (0,) * (largest - 1 - len(numbers)) for numbers in assortment) for assortment in found
    }
    assert len(filled) == len(found)
    assert filled == expected
    assert joint_assortments(7) == []
