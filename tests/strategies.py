"""Random chains for Hypothesis, used by all laws."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from gruebler import Chain
from gruebler.mechanics.linkages import Linkage
from gruebler.structure.chain.pairs import PAIRS
from gruebler.structure.chain.spaces import Space
from gruebler.structure.mechanism import Mechanism

REVOLUTE = ("revolute",)
PLANAR = ("revolute", "revolute", "prismatic", "rolling", "roll_slide", "double_slide")
LICENSED = ("revolute", "revolute", "rolling", "roll_slide")
SPHERICAL = ("revolute", "rolling", "roll_slide")
SPATIAL = tuple(p.name for p in PAIRS if Space.SPATIAL in p.freedoms)

_GROUPS = {p.name for p in PAIRS if p.is_group}


@st.composite
def chains(
    draw: st.DrawFn,
    *,
    pairs: tuple[str, ...] = PLANAR,
    space: str = "planar",
    most_links: int = 8,
    multiple: bool = True,
) -> Chain:
    """A connected chain: a random tree of joints, and some more joints, multiple ones among them."""
    n = draw(st.integers(3, most_links))
    kind = st.sampled_from(pairs)
    joints = [(draw(kind), [draw(st.integers(0, v - 1)), v]) for v in range(1, n)]
    for _ in range(draw(st.integers(0, n))):
        name = draw(kind)
        most = 4 if multiple and name in _GROUPS else 2
        links = draw(st.lists(st.integers(0, n - 1), min_size=2, max_size=min(most, n), unique=True))
        joints.append((name, links))
    return Chain(joints, links=range(n), space=space)


@st.composite
def renumbered(draw: st.DrawFn, chain: Chain) -> Chain:
    """The same structure: links renamed, links and joints and the links within joints in another order."""
    names = draw(st.permutations([f"link {i}" for i in range(chain.n)]))
    new = dict(zip(chain.links, names, strict=True))
    joints = [(j.pair, draw(st.permutations([new[link] for link in j.links]))) for j in chain.joints]
    return Chain(draw(st.permutations(joints)), links=draw(st.permutations(names)), space=chain.space)


# Assur groups as joints between their links 1, 2, ... and places outside a, b, ...
GROUPS = (
    "R(a-1) R(1-2) R(2-b)",
    "R(a-1) R(1-2) P(2-b)",
    "R(a-1) P(1-2) R(2-b)",
    "P(a-1) R(1-2) P(2-b)",
    "R(a-1) P(1-2) P(2-b)",
    "R(a-1) G(1-b)",
    "G(a-1) G(b-1) G(c-1)",
    "R(a-1) R(1-2) R(2-3) R(3-b) R(2-4) R(4-c)",
    "R(a-1) P(1-2) R(2-3) R(3-b) R(2-4) P(4-c)",
    "R(a-1) R(1-2) R(2-3) R(3-4) R(4-1) R(3-b)",
    "R(a-1-3) R(b-2) R(c-4) R(1-5) R(2-5) R(3-6) R(4-6) R(5-6)",
)


@dataclass(frozen=True)
class Built:
    """A mechanism and the sets of links that were put together to make it."""

    mechanism: Mechanism
    driven: frozenset[str]
    groups: tuple[frozenset[str], ...]


@st.composite
def built_mechanisms(draw: st.DrawFn, *, most_groups: int = 4, groups: tuple[str, ...] = GROUPS) -> Built:
    """Cranks on the frame, then Assur groups, each attached to links or turning joints that are there already."""
    cranks = [f"crank{k}" for k in range(draw(st.integers(1, 2)))]
    joints: list[tuple[str, list[str]]] = [("revolute", ["frame", crank]) for crank in cranks]
    links = ["frame", *cranks]
    parts = []
    for number in range(draw(st.integers(1, most_groups))):
        group = Chain.parse(draw(st.sampled_from(groups)))
        names = {link: f"{number}.{link}" for link in group.links if link.isdigit()}
        pins = [k for k, (pair, _) in enumerate(joints) if pair == "revolute" and k >= len(cranks)]
        for joint in group.joints:
            mine = [names[link] for link in joint.links if link in names]
            if len(mine) == len(joint.links):
                joints.append((joint.pair.name, mine))
            elif joint.pair.name == "revolute" and pins and draw(st.booleans()):
                joints[pins.pop(draw(st.integers(0, len(pins) - 1)))][1].extend(mine)
            else:
                joints.append((joint.pair.name, [draw(st.sampled_from(links)), *mine]))
        links += names.values()
        parts.append(frozenset(names.values()))
    chain = Chain(joints)
    return Built(Mechanism(chain, "frame", range(len(cranks))), frozenset(cranks), tuple(parts))


def parallelograms(cranks: list[float], frames: list[float], bends: list[float]) -> Linkage:
    """Parallelograms in a row: each follower is the crank of the next, by an arm turned by its bend."""
    foot, arm, driven = 0.0, cranks[0] * np.exp(1j), "0"
    places = {"R(frame-0)": complex(foot)}
    for k, (crank, frame, bend) in enumerate(zip(cranks[1:], frames, bends, strict=True), 1):
        places[f"R({driven}-rod{k})"] = foot + arm
        places[f"R(rod{k}-{k})"] = foot + frame + arm
        foot, driven = foot + frame, str(k)
        places[f"R(frame-{k})"] = complex(foot)
        arm = crank * np.exp(1j * (1 + bend))
    mechanism = Mechanism.parse(" ".join(places) + "; frame=frame; drive=R(frame-0)")
    return Linkage.from_drawing(mechanism, {joint: (z.real, z.imag) for joint, z in places.items()})
