"""The atlas kernels of the core: print, codes made chain by chain, wrong calls.

Other methods for each column: tests/structure/atlas/test_columns.py.
"""

from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler import Chain
from gruebler.structure.atlas.chain_table import ChainArrays
from gruebler.structure.enumeration import edge_blocks
from gruebler.structure.isomorphism import code

LETTERS = np.frombuffer(b"RPHCSEGTUW", np.uint8)


def described(core, arrays):
    n = arrays.links
    loops = (n - 1 - arrays.mobility) // 2
    return core.describe_chains(
        n, arrays.mobility, loops, arrays.hubs, arrays.sizes, arrays.edges, arrays.pairs, LETTERS
    )


@cache
def simple(links, mobility):
    return ChainArrays.of_edges(links, mobility, np.concatenate(list(edge_blocks(links, mobility)))[:6000])


def codes(core, arrays):
    _, ends, text, _, _ = described(core, arrays)
    return ends, text


@pytest.mark.parametrize(("links", "inversions", "drives"), [(6, 5, 9), (8, 71, 153)])
def test_numbers_in_print(core, links, inversions, drives):
    arrays = simple(links, 1)
    ends, text = codes(core, arrays)
    frames, rows, _ = core.list_mechanisms(links, arrays.edges.shape[1], text, ends, True)
    assert len(frames) == inversions
    assert len(rows) == drives


def test_codes_as_chain_by_chain(core):
    for links in 4, 6, 8:
        arrays = simple(links, 1)
        ends, text = codes(core, arrays)
        texts = [part.tobytes().decode() for part in np.split(text, ends[:-1])]
        joints = [" ".join(f"R({u}-{v})" for u, v in row) for row in arrays.edges.tolist()]
        assert texts == [code(Chain.parse(row)) for row in joints]


RING = (
    4, 1, 1, np.zeros(1, np.int64), np.full(1, 4),
    np.array([[[0, 1], [1, 2], [2, 3], [3, 0]]], np.int32), np.zeros((1, 4), np.int32), LETTERS,
)  # fmt: skip


def ring(**changes):
    names = ["n", "mobility", "loops", "hubs", "sizes", "edges", "pairs", "letters"]
    return [changes.get(name, value) for name, value in zip(names, RING, strict=True)]


def test_a_ring(core):
    numbers, ends, text, lines, certificates = core.describe_chains(*RING)
    assert numbers.tolist() == [[8, 1, 1, 1, 4, 4, 2, 1]]
    assert text.tobytes() == b"gr1:R(0-1)R(0-2)R(1-3)R(2-3)"
    assert ends.tolist() == [len(text)]
    assert lines.tobytes() == b"Cr"  # 0-1, 0-2, 1-3, 2-3 of the pairs 01 02 12 03 13 23: 110011
    assert set(certificates.tobytes()) <= set(b"012")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"n": 0}, "1 to 40 links"),
        ({"n": 41}, "1 to 40 links"),
        ({"n": 3}, "chain 0 has a vertex"),
        ({"n": 5}, "chain 0 has a vertex"),
        ({"hubs": np.zeros(2, np.int64)}, "same chains"),
        ({"pairs": np.zeros((1, 3), np.int32)}, "same chains"),
        ({"hubs": np.full(1, 59)}, "chain 0 has a vertex"),
        ({"hubs": np.full(1, -1)}, "chain 0 has a vertex"),
        ({"sizes": np.full(1, 5)}, "chain 0 has a vertex"),
        ({"sizes": np.full(1, 3)}, "chain 0 has a vertex"),
        ({"sizes": np.full(1, -1)}, "chain 0 has a vertex"),
        ({"pairs": np.full((1, 4), 10, np.int32)}, "chain 0 has a vertex"),
        ({"pairs": np.full((1, 4), -1, np.int32)}, "chain 0 has a vertex"),
        ({"edges": np.zeros((1, 4, 2), np.int32)}, "chain 0 has a vertex"),
    ],
)
def test_wrong_chains(core, changes, words):
    with pytest.raises(ValueError, match=words):
        core.describe_chains(*ring(**changes))


@pytest.mark.parametrize("name", ["hubs", "sizes", "edges", "pairs", "letters"])
def test_wrong_kinds_of_chains(core, name):
    value = dict(zip(["n", "mobility", "loops", "hubs", "sizes", "edges", "pairs", "letters"], RING, strict=True))[name]
    for wrong in (None, value.astype(float), value[None]):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            core.describe_chains(*ring(**{name: wrong}))


def test_a_chain_with_an_overconstrained_part_is_not_described(core):
    edges = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]]
    changed = ring(sizes=np.full(1, 6), edges=np.array([edges], np.int32), pairs=np.zeros((1, 6), np.int32))
    assert [len(array) for array in core.describe_chains(*changed)] == [0] * 5


def test_no_chains(core):
    none = ring(**{name: value[:0] for name, value in zip(["hubs", "sizes", "edges", "pairs"], RING[3:7], strict=True)})
    assert [array.shape for array in core.describe_chains(*none)] == [(0, 8), (0,), (0,), (0, 2), (0, 4)]
    nothing = np.zeros(0, np.uint8), np.zeros(0, np.int64)
    assert [array.shape for array in core.list_mechanisms(4, 4, *nothing, True)] == [(0, 4), (0, 5), (0, 12)]


@given(st.integers(2, 9), st.integers(0, 4), st.data())
def test_any_chain(core, n, hubs, data):
    """Chains or not: an answer with whole numbers, or an error in words."""
    ends = [(u, v) for u in range(n) for v in range(n + hubs) if u != v]
    edges = np.array([data.draw(st.lists(st.sampled_from(ends), min_size=1, max_size=20))], np.int32)
    size, loops = edges.shape[1], data.draw(st.integers(-1, 6))
    try:
        numbers, _, text, _, _ = core.describe_chains(
            n, data.draw(st.integers(0, 3)), loops, np.full(1, hubs), np.full(1, size), edges,
            np.zeros((1, size), np.int32), LETTERS,
        )  # fmt: skip
    except ValueError as error:
        assert "chain 0 has" in str(error)  # noqa: PT017
    else:
        assert (numbers >= 0).all()
        assert text.tobytes()[:4] in (b"", b"gr1:")


@pytest.mark.parametrize(
    ("links", "joints", "text", "words"),
    [
        (1, 4, b"", "2 to 40 links"),
        (41, 4, b"", "2 to 40 links"),
        (4, 63, b"", "at most 62 joints"),
        (4, 4, b"gr1:R(0-1)R(0-2)R(1-3)R(2-3)R(2-3)", "another kind"),
        (4, 4, b"gr1:R(0-1)R(0-2)R(1-3)R(2-3", "another kind"),
        (4, 4, b"gr1:R(0-1)R(0-2)R(1-3)R(2-4)", "another kind"),
        (4, 4, b"gr1:R(0-1)R(0-2)R(1-3)R(2-99999999999999999999)", "another kind"),
        (4, 4, b"gr1:R(0-1)R(0-2)R(1-3)R(-)", "another kind"),
        (4, 4, b"gr1:P(0-1)R(0-2)R(1-3)R(2-3)", "another kind"),
        (4, 4, b"", "another kind"),
        (4, 5, b"gr1:R(0-1)R(0-2)R(1-3)R(2-3)R(1-2)", "not determined by one drive"),
    ],
)
def test_wrong_codes(core, links, joints, text, words):
    letters = np.frombuffer(text, np.uint8)
    with pytest.raises(ValueError, match=words):
        core.list_mechanisms(links, joints, letters, np.array([len(text)]), True)


@pytest.mark.parametrize("ends", [[-1], [29], [5, 4]])
def test_wrong_ends(core, ends):
    text = np.frombuffer(b"gr1:R(0-1)R(0-2)R(1-3)R(2-3)", np.uint8)
    with pytest.raises(ValueError, match="ends must ascend"):
        core.list_mechanisms(4, 4, text, np.array(ends), True)


@given(st.binary(max_size=40), st.booleans())
def test_any_text(core, text, prefix):
    letters = np.frombuffer(b"gr1:R(0-1)R(0-2)R(1-3)" * prefix + text, np.uint8)
    with pytest.raises(ValueError, match="chain 0 has a code of another kind"):
        core.list_mechanisms(4, 4, letters, np.array([len(letters)]), True)


@given(st.integers(3, 9), st.data())
def test_any_codes(core, n, data):
    pairs = [(u, v) for v in range(n) for u in range(v)]
    joints = data.draw(st.lists(st.sampled_from(pairs), min_size=1, max_size=14))
    text = "gr1:" + "".join(f"R({u}-{v})" for u, v in joints)
    letters = np.frombuffer(text.encode(), np.uint8)
    try:
        frames, rows, groups = core.list_mechanisms(n, len(joints), letters, np.array([len(text)]), True)
    except ValueError as error:
        assert "not determined by one drive" in str(error)  # noqa: PT017
    else:
        assert frames[:, 3].sum() == n
        assert (rows[:, 3] * 2 <= n).all()
        assert (groups >= 0).all()
