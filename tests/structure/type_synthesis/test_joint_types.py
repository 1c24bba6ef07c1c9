"""Joint types and contacts against brute force over all assignments, and against independently computed counts."""

from itertools import combinations, product

import networkx as nx
import pytest

from gruebler import Chain, code
from gruebler.base.errors import ChainError
from gruebler.structure.mobility import counted, mobility_report
from gruebler.structure.type_synthesis import every_joint_moves, joint_types, with_contacts

FOUR = [Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)")]
SIX = [
    Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(2-4) R(4-5) R(5-3)"),
    Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)"),
]

# Computed independently of this project: k joints prismatic, mobility 1 and every joint moves; then without conditions.
MOVING = {4: [1, 1, 2, 0, 0], 6: [2, 6, 16, 19, 9, 0, 0, 0]}
ALL = {4: [1, 1, 2, 1, 1], 6: [2, 6, 16, 24, 24, 16, 6, 2]}


@pytest.mark.parametrize("bases", [FOUR, SIX], ids=["four links", "six links"])
def test_counts(bases):
    n = bases[0].n
    for conditions, expected in ((True, MOVING[n]), (False, ALL[n])):
        found = [
            sum(1 for base in bases for _ in joint_types(base, {"prismatic": k}, conditions=conditions))
            for k in range(len(expected))
        ]
        assert found == expected


@pytest.mark.parametrize("base", [*FOUR, *SIX], ids=["four-bar", "Watt", "Stephenson"])
def test_against_all_assignments(base):
    """Every assignment written down, judged by the full report, told apart by codes."""
    brute = {}
    for kinds in product(("revolute", "prismatic"), repeat=len(base.joints)):
        typed = Chain([(kind, j.links) for kind, j in zip(kinds, base.joints, strict=True)])
        report = mobility_report(typed)
        if report.generic == 1 and not report.immobile_joints:
            brute.setdefault(kinds.count("prismatic"), set()).add(code(typed))
    for k in range(len(base.joints) + 1):
        found = [code(typed) for typed in joint_types(base, {"prismatic": k})]
        assert len(found) == len(set(found))
        assert set(found) == brute.get(k, set())


def test_several_kinds_at_once():
    found = [code(typed) for typed in joint_types(FOUR[0], {"prismatic": 1, "rolling": 1})]
    assert len(found) == len(set(found)) == 2
    with pytest.raises(ChainError, match=r"f = 2"):
        next(joint_types(FOUR[0], {"roll_slide": 1}))
    with pytest.raises(ChainError, match=r"5 joints cannot be exchanged"):
        next(joint_types(FOUR[0], {"prismatic": 5}))


def contacts_by_brute_force(n, contacts):
    """All simple graphs on n links whose joints can be revolutes and so many roll-slides with F = 1 and all moving."""
    found = set()
    joints = (3 * (n - 1) - 1 + contacts) // 2
    if (3 * (n - 1) - 1 + contacts) % 2:
        return found
    for edges in combinations(combinations(range(n), 2), joints):
        graph = nx.Graph(edges)
        if len(graph) < n or not nx.is_connected(graph) or min(d for _, d in graph.degree) < 2:
            continue
        for rolling in combinations(range(joints), contacts):
            typed = Chain([("roll_slide" if k in rolling else "revolute", e) for k, e in enumerate(edges)])
            if every_joint_moves(typed, 1):
                found.add(code(typed))
    return found


@pytest.mark.parametrize(("bases", "contacts"), [(FOUR, 1), (SIX, 1), (SIX, 2)])
def test_contacts_against_brute_force(bases, contacts):
    """Contacts taken for binary links give every chain with so many contacts, each once."""
    made = [chain for base in bases for chain in with_contacts(base, contacts)]
    assert all(counted(chain) == 1 for chain in made)
    codes = [code(chain) for chain in made]
    assert len(codes) == len(set(codes))
    doubled = {c for c, x in zip(codes, made, strict=True) if len({frozenset(j.links) for j in x.joints}) < x.g}
    assert set(codes) - doubled == contacts_by_brute_force(bases[0].n - contacts, contacts)


def test_gears_come_from_the_four_bar():
    (gears,) = with_contacts(FOUR[0], 1)
    assert code(gears) == code(Chain.parse("R(frame-gear1) R(frame-gear2) G(gear1-gear2)"))
    assert list(with_contacts(FOUR[0], 2)) == []
    with pytest.raises(ChainError, match=r"0 or more, not -1"):
        next(with_contacts(FOUR[0], -1))
