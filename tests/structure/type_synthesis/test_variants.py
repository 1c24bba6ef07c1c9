"""Variants against brute force: every typed chain, frame and drive, judged one by one and told apart by codes."""

from concurrent.futures import ThreadPoolExecutor
from itertools import product

import pytest

from gruebler import GrueblerError, code
from gruebler.structure.enumeration.worker_pool import ProcessPools
from gruebler.structure.mechanism import Mechanism, check_drives
from gruebler.structure.mechanism.inversion import DrivenMechanism
from gruebler.structure.type_synthesis import JointRequirement, Requirements, typed_chains, variants


def mechanisms_by_brute_force(links, prismatic, accept):
    found = set()
    for chain in typed_chains(Requirements(links, prismatic=prismatic)):
        for frame, number in product(chain.links, range(len(chain.joints))):
            mechanism = Mechanism(chain, frame, [number])
            if check_drives(mechanism).fixed and accept(mechanism, chain.joints[number]):
                found.add(mechanism.code())
    return found


CASES = [
    ({"drives": ("R@frame",)}, lambda m, j: j.pair.name == "revolute" and m.frame in j.links),
    ({"drives": ("P@moving",)}, lambda m, j: j.pair.name == "prismatic" and m.frame not in j.links),
    ({"drives": ("@any",), "frame_joints": 3}, lambda m, _: m.chain.degrees[m.frame] == 3),
    (
        {"drives": ("R@frame",), "at_frame": ("P", 1)},
        lambda m, j: (
            j.pair.name == "revolute"
            and m.frame in j.links
            and any(x.pair.name == "prismatic" for x in m.chain.joints_of(m.frame))
        ),
    ),
]


@pytest.mark.parametrize(("asked", "accept"), CASES)
@pytest.mark.parametrize(("links", "prismatic"), [(4, 1), (4, 2), (6, 1)])
def test_driven_mechanisms(asked, accept, links, prismatic):
    asked = dict(asked)
    asked["drives"] = tuple(JointRequirement.parse(text) for text in asked["drives"])
    if "at_frame" in asked:
        symbol, number = asked["at_frame"]
        asked["at_frame"] = ((JointRequirement.parse(f"{symbol}@frame"), number),)
    found = [d.mechanism.code() for d in variants(Requirements(links, prismatic=prismatic, **asked))]
    assert len(found) == len(set(found))
    assert set(found) == mechanisms_by_brute_force(links, prismatic, accept)


def _thread_pool():
    return ThreadPoolExecutor(2)


@pytest.mark.parametrize("executor", [_thread_pool, ProcessPools(2)], ids=["threads", "processes"])
@pytest.mark.parametrize(
    "wanted",
    [Requirements(6, prismatic=2, drives=(JointRequirement.parse("@frame"),)), Requirements(5, roll_slide=1)],
    ids=["mechanisms", "chains"],
)
def test_any_executor_lists_the_same(executor, wanted):
    listed = [str(each) for each in variants(wanted)]
    assert listed
    assert [str(each) for each in variants(wanted, executor=executor)] == listed


def test_typed_chains_are_counted_as_computed_independently():
    assert [len(list(typed_chains(Requirements(6, prismatic=k)))) for k in range(5)] == [2, 6, 16, 19, 9]
    assert len(list(typed_chains(Requirements(6, prismatic=1, assortment=(4, 2))))) == 6
    assert list(typed_chains(Requirements(6, prismatic=1, assortment=(5, 1)))) == []


def test_nothing_is_repeated():
    for wanted in (
        Requirements(5, roll_slide=1),
        Requirements(6, prismatic=1, rolling=1),
        Requirements(4, roll_slide=2),
    ):
        codes = [code(chain) for chain in typed_chains(wanted)]
        assert codes
        assert len(codes) == len(set(codes))


def test_gears_and_cams_of_three_links():
    """The seeds' gear pair, cam with valve and winch are what three links with one contact give."""
    with_slider = {code(c) for c in typed_chains(Requirements(3, roll_slide=1, prismatic=1))}
    with_both = {code(c) for c in typed_chains(Requirements(3, roll_slide=1, prismatic=2))}
    assert (len(with_slider), len(with_both)) == (1, 1)
    assert len(list(typed_chains(Requirements(3, roll_slide=1)))) == 1


def test_outputs():
    """The four-bar with the far link as output: not next to the crank, and joined to the frame by a revolute."""
    wanted = Requirements(
        4, drives=(JointRequirement.parse("R@frame"),), output=JointRequirement.parse("R@frame"), output_at_drive=False
    )
    (only,) = variants(wanted)
    assert isinstance(only, DrivenMechanism)
    assert (only.mechanism.frame, only.output) == ("0", "3")
    coupler = Requirements(4, drives=(JointRequirement.parse("R@frame"),), output=JointRequirement.parse("@moving"))
    assert [d.output for d in variants(coupler)] == ["2"]


def test_frames_without_drives():
    """Of Watt's and Stephenson's chains two inversions have a ternary frame."""
    found = list(variants(Requirements(6, frame_joints=3)))
    assert len(found) == 2
    assert all(d.mechanism.drives == () for d in found)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: JointRequirement.parse("R@wall"), "frame, moving or any, not 'wall'"),
        (lambda: JointRequirement.parse("Q@frame"), "unknown pair 'Q'"),
        (lambda: JointRequirement.parse("R frame"), "not PAIR@PLACE"),
        (lambda: JointRequirement.parse(""), "not PAIR@PLACE"),
        (lambda: list(variants(Requirements(2))), "at least three links, not 2"),
        (
            lambda: list(variants(Requirements(4, drives=(JointRequirement.parse("R"), JointRequirement.parse("R"))))),
            "as many drives, not 2",
        ),
    ],
)
def test_mistakes(make, words):
    with pytest.raises(GrueblerError) as caught:
        make()
    assert words in str(caught.value)
