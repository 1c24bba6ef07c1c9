"""Multiple joints, sliding joints and Assur groups of the core: laws and print; wrong calls raise.

Other methods: tests/structure/enumeration/test_multiple.py, type_synthesis/test_sliding.py, assur/test_groups.py.
"""

import signal
import threading
from functools import cache
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gruebler import Chain
from gruebler.structure.enumeration import edge_blocks
from gruebler.structure.enumeration.fractionation_class import joint_masks
from gruebler.structure.enumeration.listing import chains
from gruebler.structure.type_synthesis import sliding

EVERY = (0, 99, 99)


@cache
def simple(links, mobility=1):
    """int64[k, joints]: the chains of simple joints, fractionated ones included."""
    return np.array([joint_masks(chain) for chain in chains(links, mobility, fractionated="all")], np.int64)


@pytest.mark.parametrize(("links", "numbers"), [(4, [1]), (6, [2, 1, 1]), (8, [16, 22, 18, 3, 1])])
def test_multiple_joints_in_print(core, links, numbers):
    rows = core.MultipleJoints(links, simple(links), *EVERY).next(1000)[:, 1:]
    multiple = [sum(joint.bit_count() > 2 for joint in row) for row in rows.tolist()]
    assert np.bincount(multiple).tolist() == numbers


def test_growth_in_parts(core):
    masks = simple(8)
    whole = core.MultipleJoints(8, masks, *EVERY).next(1000)
    search = core.MultipleJoints(8, masks, *EVERY)
    parts = [search.next(7)]
    while len(parts[-1]) == 7:
        parts.append(search.next(7))
    assert len(parts) > 3
    assert (np.concatenate(parts) == whole).all()
    assert search.next(7).shape == (0, 11)


def test_a_signal_ends_growth(core):
    if not hasattr(signal, "setitimer"):
        pytest.skip("Windows has no interval timer")
    search = core.MultipleJoints(20, np.array([[3, 6, 12, 24, 48, 96, 192, 129]], np.int64), *EVERY)
    assert len(search.next(5)) == 1  # a ring alone grows into nothing
    many = np.tile(simple(10), (200, 1))
    search = core.MultipleJoints(10, many, *EVERY)

    def stop(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(KeyboardInterrupt):
            search.next(1 << 30)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert len(search.next(5)) == 0


def test_growth_in_two_threads(core):
    """One of them is refused, or they come one after the other; no chain is lost or comes twice."""
    masks = simple(8)
    search = core.MultipleJoints(8, np.tile(masks, (50, 1)), *EVERY)
    found, refused = [], []

    def work():
        while True:
            try:
                rows = search.next(100)
            except ValueError as error:
                refused.append(str(error))
                continue
            found.append(rows)
            if len(rows) < 100:
                return

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sum(map(len, found)) == 50 * 60
    assert set(refused) <= {"another thread grows these chains"}


@pytest.mark.parametrize(
    ("links", "joints", "words"),
    [
        (0, [], "1 to 20 links"),
        (21, [3], "1 to 20 links"),
        (4, [3, 6, 12, 9, 5], "more joints than a chain"),
        (4, [3, 3], "chain 0 has a joint"),
        (4, [7], "chain 0 has a joint"),
        (4, [0], "chain 0 has a joint"),
        (4, [-1], "chain 0 has a joint"),
        (4, [17], "chain 0 has a joint"),
    ],
)
def test_wrong_chains(core, links, joints, words):
    with pytest.raises(ValueError, match=words):
        core.MultipleJoints(links, np.array([joints], np.int64), *EVERY)


def test_wrong_kinds_of_chains(core):
    for wrong in (None, np.zeros((1, 4), np.int32), np.zeros(4, np.int64), [[3, 6]]):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            core.MultipleJoints(4, wrong, *EVERY)
    with pytest.raises(ValueError, match="number of chains"):
        core.MultipleJoints(4, simple(4), *EVERY).next(-1)
    assert core.MultipleJoints(4, np.zeros((0, 4), np.int64), *EVERY).next(3).shape == (0, 5)
    assert core.MultipleJoints(4, np.zeros((2, 0), np.int64), *EVERY).next(3).shape[1] == 1


@given(st.integers(1, 9), st.data())
def test_any_joints(core, links, data):
    """Chains or not: an end, and every row as many links in its joints as before."""
    pairs = [1 << u | 1 << v for v in range(links) for u in range(v)]
    most = 3 * (links - 1) // 2
    joints = data.draw(st.lists(st.sampled_from(pairs), max_size=most, unique=True)) if pairs else []
    rows = core.MultipleJoints(links, np.array([joints], np.int64).reshape(1, -1), *EVERY).next(300)
    for row in rows[:, 1:].tolist():
        assert sum(joint.bit_count() - 1 for joint in row if joint) == len(joints)


# --- sliding joints


def of_chain(text):
    """The arguments of the kernel, as `sliding_numbers` makes them."""
    chain = Chain.parse(text)
    columns = sliding._ordered(sliding._loops(chain))
    number = sum(chain.joints[column.joint].count == 1 for column in columns)
    joint = np.array([column.joint for column in columns], np.int64)
    group = sliding._group(chain, joint[:number].tolist())
    return sliding._vectors(columns, joint, 1), number, joint, 3 * (chain.n - 1) - 2 * len(columns), group


SLIDING = [
    "R(0-1) R(1-2) R(2-3) R(3-0)",
    "R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-2)",
    "R(0-1) R(1-2) R(2-3) R(3-0) R(0-4) R(4-5) R(5-1)",
    "R(0-1) R(0-2) R(1-2-3) R(0-3) R(1-4) R(4-5) R(5-3)",
    "R(0-1) R(0-2) R(0-3) R(1-4) R(2-5) R(3-6) R(4-5-7) R(6-7)",
]


def test_sliding_in_print(core):
    """Four-bars: turning alone, one slide, two slides side by side or opposite."""
    vectors, number, joint, mobility, group = of_chain(SLIDING[0])
    assert (core.count_sliding(vectors, number, joint, mobility, group) / len(group)).tolist() == [1, 1, 2, 0, 0]


def residues(columns=4, rows=3):
    return np.ones((2, columns, rows), np.int64)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((residues(0), 0, np.zeros(0, np.int64), 1, np.zeros((1, 0), np.int64)), "1 to 62 columns"),
        ((residues(63), 0, np.zeros(63, np.int64), 1, np.zeros((1, 0), np.int64)), "1 to 62 columns"),
        ((residues(), 5, np.zeros(4, np.int64), 1, np.zeros((1, 5), np.int64)), "all columns are simple"),
        ((residues(), -1, np.zeros(4, np.int64), 1, np.zeros((1, 0), np.int64)), "all columns are simple"),
        ((residues(), 0, np.zeros(3, np.int64), 1, np.zeros((1, 0), np.int64)), "each column has a joint"),
        ((residues(), 0, np.full(4, 62), 1, np.zeros((1, 0), np.int64)), "numbered from 0 to 61"),
        ((residues() * (2**31 - 1), 0, np.zeros(4, np.int64), 1, np.zeros((1, 0), np.int64)), "numbers from 0"),
        ((-residues(), 0, np.zeros(4, np.int64), 1, np.zeros((1, 0), np.int64)), "numbers from 0"),
        ((residues(), 2, np.zeros(4, np.int64), 1, np.zeros((0, 2), np.int64)), "has an image"),
        ((residues(), 2, np.zeros(4, np.int64), 1, np.zeros((1, 3), np.int64)), "has an image"),
        ((residues(), 2, np.zeros(4, np.int64), 1, np.array([[0, 1], [1, 1]])), "automorphism 1 is no permutation"),
        ((residues(), 2, np.zeros(4, np.int64), 1, np.array([[0, 2]])), "automorphism 0 is no permutation"),
    ],
)
def test_wrong_closures(core, arguments, words):
    with pytest.raises(ValueError, match=words):
        core.count_sliding(*arguments)


@given(st.integers(1, 5), st.integers(0, 4), st.integers(-1, 4), st.data())
def test_any_residues(core, columns, rows, mobility, data):
    numbers = st.sampled_from([0, 1, 2, 2**31 - 2, 12345])
    size = 2 * columns * rows
    vectors = np.array(data.draw(st.lists(numbers, min_size=size, max_size=size)), np.int64).reshape(2, columns, rows)
    number = data.draw(st.integers(0, columns))
    joint = np.arange(columns)
    sums = core.count_sliding(vectors, number, joint, mobility, np.arange(number).reshape(1, -1))
    assert sums.shape == (number + 1,)
    expected = np.zeros(number + 1, np.int64)
    for chosen in product((0, 1), repeat=number):
        rest = (*chosen, *[0] * (columns - number))
        matrix = [[int(x) for x in vectors[side, k]] for k, side in enumerate(rest)]
        if columns - modular_rank(matrix) == mobility:
            moving = all(modular_rank(matrix[:k] + matrix[k + 1 :]) == modular_rank(matrix) for k in range(columns))
            expected[sum(chosen)] += moving
    assert sums.tolist() == expected.tolist()


def modular_rank(rows):
    """The rank modulo 2**31 - 1."""
    prime = 2**31 - 1
    rows, rank = [list(row) for row in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((k for k in range(rank, len(rows)) if rows[k][column] % prime), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        inverse = pow(rows[rank][column], -1, prime)
        for k in range(rank + 1, len(rows)):
            factor = rows[k][column] * inverse % prime
            rows[k] = [(x - factor * y) % prime for x, y in zip(rows[k], rows[rank], strict=True)]
        rank += 1
    return rank


# --- Assur groups


@cache
def trusses(links):
    return np.concatenate(list(edge_blocks(links, 0)))[:5000]


@pytest.mark.parametrize(("links", "number"), [(2, 1), (4, 2), (6, 10), (8, 173)])
def test_numbers_of_groups_in_print(core, links, number):
    assert len(core.describe_groups(links + 1, trusses(links + 1))) == number


@pytest.mark.parametrize(
    ("n", "ends", "words"),
    [
        (0, [], "1 to 32 links"),
        (33, [], "1 to 32 links"),
        (3, [[0, 3]], "truss 0 has a joint"),
        (3, [[1, 1]], "truss 0 has a joint"),
        (3, [[0, 1]] * 63, "at most 62 joints"),
    ],
)
def test_wrong_trusses(core, n, ends, words):
    with pytest.raises(ValueError, match=words):
        core.describe_groups(n, np.array([ends], np.uint8).reshape(1, -1, 2))


def test_wrong_kinds_of_trusses(core):
    for wrong in (None, trusses(5).astype(np.int64), trusses(5)[:, :, :1], trusses(5)[0]):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            core.describe_groups(5, wrong)
    assert core.describe_groups(5, trusses(5)[:0]).shape == (0, 14)


@given(st.integers(2, 8), st.data())
def test_any_trusses(core, n, data):
    pairs = [(u, v) for v in range(n) for u in range(v)]
    ends = data.draw(st.lists(st.sampled_from(pairs), max_size=20))
    rows = core.describe_groups(n, np.array([ends], np.uint8).reshape(1, -1, 2))
    assert 1 <= len(rows) <= n
    assert (rows[:, 2:] < n).all()


@pytest.mark.parametrize(
    ("n", "joints", "words"),
    [
        (0, [3], "1 to 21 links"),
        (22, [3], "1 to 21 links"),
        (3, [3, 6], "truss 0 has joints"),
        (3, [3, 6, 8], "truss 0 has joints"),
        (3, [3, 6, 1], "truss 0 has joints"),
        (3, [3, 6, -3], "truss 0 has joints"),
        (21, [3] * 31, "at most 30 joints"),
    ],
)
def test_wrong_trusses_for_modes(core, n, joints, words):
    with pytest.raises(ValueError, match=words):
        core.count_modes(n, np.array([joints], np.int64), False)


@given(st.sampled_from([3, 5, 7, 9]), st.booleans(), st.data())
def test_any_joints_have_modes(core, n, spherical, data):
    """Loose links and joints that stand there twice included."""
    pairs = [1 << u | 1 << v for v in range(n) for u in range(v)]
    joints = 3 * (n - 1) // 2
    sets = data.draw(st.lists(st.sampled_from(pairs), min_size=joints, max_size=joints))
    assert core.count_modes(n, np.array([sets], np.int64), spherical)[0] >= 0
