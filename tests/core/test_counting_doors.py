"""Wrong calls of the counting kernels raise; nothing that stands in an array makes them crash."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

THETA = np.zeros((1, 16), np.int64)
THETA[0, :2] = 3 << 4, 3

WRONG_KINDS = [
    None,
    [[48, 3]],
    3,
    "graphs",
    THETA.astype(np.int32),
    THETA.astype(np.uint64),
    THETA.astype(float),
    np.full((1, 16), np.nan),
    THETA.astype(object),
    THETA[0],
    THETA[None],
    np.asfortranarray(np.zeros((3, 16), np.int64)),
    np.zeros((4, 32), np.int64)[:, ::2],
]
WRONG_WIDTHS = [np.zeros((1, width), np.int64) for width in (0, 1, 19, 1000)]


def calls(core):
    """The kernels that take graphs, as functions of the graphs and their number of loops."""
    return [
        lambda rows, loops: core.take_census(rows, loops, 1, True),
        lambda rows, loops: core.add_loop(rows, loops, 0, 1),
    ]


@pytest.mark.parametrize("graphs", WRONG_KINDS, ids=lambda graphs: f"{type(graphs).__name__}")
def test_wrong_kinds(core, graphs):
    for call in calls(core):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            call(graphs, 2)


@pytest.mark.parametrize("graphs", WRONG_WIDTHS, ids=lambda graphs: str(graphs.shape[1]))
def test_wrong_widths(core, graphs):
    for call in calls(core):
        with pytest.raises(ValueError, match="2 to 18 rows"):
            call(graphs, 2)


@pytest.mark.parametrize("loops", [-1, 0, 1, 11, 2**31 - 1])
def test_wrong_loops(core, loops):
    for call in calls(core):
        with pytest.raises(ValueError, match="loops"):
            call(THETA, loops)


@pytest.mark.parametrize("mobility", [-1, 25, 2**31 - 1])
def test_wrong_mobility(core, mobility):
    with pytest.raises(ValueError, match="0 to 24"):
        core.take_census(THETA, 2, mobility, False)


@pytest.mark.parametrize("arguments", [(-1, 1), (2, 1), (2**62, 1), (0, 0), (0, -(2**62))])
def test_wrong_parents(core, arguments):
    with pytest.raises(ValueError, match=r"parent|enough"):
        core.add_loop(THETA, 2, *arguments)


@pytest.mark.parametrize("huge", [2**31, 2**63, -(2**63), 2**200])
def test_huge_numbers(core, huge):
    with pytest.raises(TypeError, match="incompatible function arguments"):
        core.take_census(THETA, huge, 1, True)


def test_unknown_level(core):
    with pytest.raises(ValueError, match="no level v9"):
        core.take_census(THETA, 2, 1, True, level="v9")


def test_no_graphs(core):
    none = np.zeros((0, 18), np.int64)
    assert core.take_census(none, 5, 1, True).shape == (0, 5)
    children, following = core.add_loop(none, 5, 0, 1)
    assert children.shape == (0, 18)
    assert following == 0


def row(*bundles):
    """One packed graph of bundles (u, v, strings)."""
    rows = np.zeros((1, 16), np.uint64)
    for u, v, k in bundles:
        rows[0, u] |= np.uint64(k << 4 * v)
        rows[0, v] |= np.uint64(k << 4 * u)
    return rows.view(np.int64)


ONE_SIDED = row((0, 1, 3))
ONE_SIDED[0, 1] = 2
BEYOND = row((0, 1, 3))
BEYOND[0, 0] |= 1 << 40
LATE = row((0, 1, 3))
LATE[0, 9] = 1


@pytest.mark.parametrize(
    ("graph", "loops"),
    [
        (np.zeros((1, 16), np.int64), 2),
        (row((0, 1, 3)), 3),  # other loops
        (row((0, 1, 2)), 2),  # too few strings
        (row((0, 1, 15)), 9),
        (row((0, 0, 3)), 2),  # joined to itself
        (ONE_SIDED, 2),
        (BEYOND, 2),
        (LATE, 2),
        (row((0, 1, 4), (2, 3, 4)), 5),  # in two parts
        (np.full((1, 16), -1), 9),
    ],
)
def test_other_words_are_no_contracted_graph(core, graph, loops):
    two = np.concatenate([THETA if loops == 2 else graph, graph])
    for call in calls(core)[: 1 if loops == 9 else 2]:
        with pytest.raises(ValueError, match=r"graph \d is not a connected graph of this number of loops"):
            call(np.ascontiguousarray(graph), loops)
        with pytest.raises(ValueError, match="is not a connected graph"):
            call(two, loops) if loops > 2 else core.take_census(two, loops, 1, True)


@given(st.lists(st.integers(-(2**63), 2**63 - 1), min_size=16, max_size=16), st.integers(2, 8))
def test_any_words(core, words, loops):
    for call in calls(core):
        with pytest.raises(ValueError, match="is not a connected graph"):
            call(np.array([words], np.int64), loops)


@given(st.data())
def test_any_multigraph(core, data):
    """Connected or not, two-connected or not: an answer with whole numbers, or an error in words."""
    n = data.draw(st.integers(2, 16))
    pairs = [(u, v) for v in range(n) for u in range(v)]
    chosen = data.draw(st.lists(st.sampled_from(pairs), min_size=n - 1, max_size=24, unique=True))
    graph = row(*((u, v, data.draw(st.integers(1, 4))) for u, v in chosen))
    loops = data.draw(st.integers(2, 8))
    try:
        census = core.take_census(graph, loops, 1, True)
    except ValueError as error:
        assert "graph 0" in str(error)  # noqa: PT017
    else:
        assert (census[0] >= 0).all()
        children, following = core.add_loop(graph, loops, 0, 1)
        assert following == 1
        assert (children != 0).any(axis=1).all()
