"""Numbers of typed chains by the number of sliding joints, against the list of them all."""

import pytest

import gruebler as gr
from gruebler.base.errors import ChainError
from gruebler.cli import main
from gruebler.structure.enumeration import Request
from gruebler.structure.enumeration.worker_pool import ProcessPools
from gruebler.structure.type_synthesis import count_sliding_variants, joint_types, sliding_numbers


def listed(chain):
    """By exact rank of the constraints of all links, one typed chain after the other."""
    simple = sum(joint.count == 1 for joint in chain.joints)
    return tuple(sum(1 for _ in joint_types(chain, {"prismatic": k})) for k in range(simple + 1))


@pytest.mark.parametrize(
    ("links", "mobility", "joints"),
    [
        (4, 1, "0"),
        (6, 1, "any"),
        (5, 2, "any"),
        (7, 2, "any"),
        (6, 3, "0"),
        pytest.param(8, 3, "0", marks=pytest.mark.slow),
        (7, 4, "any"),
        (8, 5, "any"),
    ],
)
def test_every_chain_against_the_list(links, mobility, joints):
    chains = list(gr.chains(links, mobility, fractionated="all", multiple_joints=joints))
    assert chains
    total = [0] * 20
    for chain in chains:
        numbers = sliding_numbers(chain)
        assert numbers == listed(chain), chain
        total = [a + b for a, b in zip(total, [*numbers, *[0] * 20], strict=False)]
    counted = count_sliding_variants(
        Request(links, mobility=mobility, fractionated="all", assortment=None, multiple_joints=joints)
    )
    assert list(counted) == total[: len(counted)]
    assert not any(total[len(counted) :])


@pytest.mark.parametrize("number", range(0, 16, 5))
def test_chains_of_eight_links(number):
    chain = list(gr.chains(8))[number]
    assert sliding_numbers(chain) == listed(chain)


@pytest.mark.slow
def test_all_chains_of_eight_links():
    assert count_sliding_variants(Request(8)) == (16, 84, 345, 776, 1069, 677, 140)
    for chain in gr.chains(8):
        assert sliding_numbers(chain) == listed(chain)


def test_executors_and_wrong_chains():
    assert count_sliding_variants(Request(6), executor=ProcessPools(2)) == (2, 6, 16, 19, 9)
    with pytest.raises(ChainError, match="expected a planar chain of turning joints"):
        sliding_numbers(gr.Chain.parse("R(0-1) R(1-2) R(2-3) P(3-0)"))


def test_the_command(capsys):
    assert main(["variants", "--links", "6", "--prismatic", "any", "--count"]) == 0
    assert [line.split() for line in capsys.readouterr().out.splitlines()[1:]] == [
        ["0", "2"], ["1", "6"], ["2", "16"], ["3", "19"], ["4", "9"],
    ]  # fmt: skip
    for k, number in (("3", 19), ("7", 0)):
        assert main(["variants", "--links", "6", "--prismatic", k, "--count"]) == 0
        assert capsys.readouterr().out == f"{number}\n"
    assert main(["variants", "--links", "6", "--prismatic", "any"]) == 2
    assert "--prismatic any goes with --count" in capsys.readouterr().err
