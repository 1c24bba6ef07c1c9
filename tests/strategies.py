"""Random chains for Hypothesis, used by all laws."""

from __future__ import annotations

from hypothesis import strategies as st

from gruebler import PAIRS, Chain, Space

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
